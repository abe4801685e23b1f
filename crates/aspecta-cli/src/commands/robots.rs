//! `aspecta robots`: the catalogue.

use crate::args::format::JsonArg;
use crate::args::help::help;
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, Align, FORMAT_VERSION, Table};
use aspecta::robot::{Platform, catalogue};
use clap::{Args, Subcommand};
use serde::Serialize;
use std::io::Write;

/// Arguments of `robots`.
#[derive(Args)]
#[command(mut_args(help("json", "Print the list as JSON")))]
#[command(args_conflicts_with_subcommands = true)]
pub struct Robots {
    #[command(subcommand)]
    action: Option<Action>,
    #[command(flatten)]
    shown: JsonArg,
}

#[derive(Subcommand)]
enum Action {
    /// Print a robot's file, ready to copy and edit
    Show {
        /// Its name
        name: String,
    },
}

#[derive(Serialize)]
struct List {
    format_version: u32,
    robots: Vec<Entry>,
}

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    platform: Platform,
    dof: usize,
    title: String,
    source: String,
}

impl Robots {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        match &self.action {
            Some(Action::Show { name }) => out.write_all(file_of(name)?.as_bytes())?,
            None if self.shown.json => {
                output::json(out, &List { format_version: FORMAT_VERSION, robots: entries()? })?
            }
            None => print(out)?,
        }
        Ok(Answer::Yes)
    }
}

fn entries() -> Result<Vec<Entry>, Failure> {
    let entry = |e: &catalogue::Entry| {
        let robot = input::robot(e.name)?;
        let (platform, dof) = (robot.platform, robot.dof());
        Ok(Entry { name: e.name, platform, dof, title: robot.title, source: robot.source })
    };
    catalogue::all().iter().map(entry).collect()
}

fn print(out: &mut dyn Write) -> Result<(), Failure> {
    let columns =
        [("name", Align::Left), ("platform", Align::Left), ("legs", Align::Right), ("robot", Align::Left)];
    let mut table = Table::new(columns.map(|(name, align)| (name.to_owned(), align)));
    for e in entries()? {
        table.row([e.name.to_owned(), e.platform.to_string(), e.dof.to_string(), e.title]);
    }
    write!(out, "{table}")?;
    Ok(())
}

fn file_of(name: &str) -> Result<&'static str, Failure> {
    let entry = catalogue::all().iter().find(|e| e.name == name);
    entry.map(|e| e.text).ok_or_else(|| {
        let names: Vec<_> = catalogue::all().iter().map(|e| e.name).collect();
        Failure::Input(format!("no built-in robot is called `{name}`; there are {}", names.join(", ")))
    })
}

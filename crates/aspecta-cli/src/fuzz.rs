//! Doors to the readers of input, for `aspecta-fuzz`. No promise is made about them.

use crate::Cli;
use crate::input::{Columns, Rows};
use aspecta::robot::{Robot, catalogue};
use clap::Parser;
use std::io::Cursor;
use std::iter;

/// The rows of a CSV text, poses or configurations of a robot, up to the first that is bad, which has a
/// message.
pub fn rows(robot: &Robot, text: &[u8]) -> (Vec<Vec<f64>>, Option<String>) {
    let pose = Columns::pose(robot);
    let layouts = [pose.clone().and(&Columns::joints(robot)), pose];
    let rows = Rows::of("fuzz.csv", Box::new(Cursor::new(text.to_vec())), &layouts, false);
    let mut values = Vec::new();
    for row in rows {
        match row {
            Ok(row) => values.push(row.values),
            Err(failure) => return (values, Some(failure.to_string())),
        }
    }
    (values, None)
}

/// What a command line prints, or says where it cannot run. It is run if it computes from its arguments alone:
/// reads no file, writes none, and ends at once.
pub fn answer(arguments: &[&str]) -> Option<Result<Vec<u8>, String>> {
    let cli = Cli::try_parse_from(iter::once("aspecta").chain(arguments.iter().copied())).ok()?;
    let ["ik" | "fk" | "state", robot, options @ ..] = arguments else { return None };
    if catalogue::find(robot).is_none() || options.iter().any(|option| option.starts_with("--file")) {
        return None;
    }
    let mut out = Vec::new();
    let ran = cli.command.run(&mut out);
    Some(ran.map(|_| out).map_err(|failure| failure.to_string()))
}

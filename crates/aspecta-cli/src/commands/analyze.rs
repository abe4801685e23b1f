//! `aspecta analyze`: working modes and generalized aspects.

use crate::args::{budget, fix};
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, Target, note};
use crate::show::summary;
use crate::work::watch::watched;
use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::paving::{Budget, Stop};
use aspecta_view::{file, write_report};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `analyze`.
#[derive(Args)]
pub struct Analyze {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
    /// Print the whole result as JSON, and nothing else, on stdout (angles in radians)
    #[arg(long)]
    json: bool,
    /// Write report.html and its figures into this directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the proof of the count into this file, for `aspecta verify`: of up to 8 working modes (`--mode`)
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// When to stop before the bounds meet, whatever comes first: 30s | 5min | 2e6boxes | depth=9 | res=0.1, separated
    /// by commas.
    ///
    /// Without it the run goes on until the bounds on the number of aspects meet, until boxes are as fine as 1e-8 of the
    /// window, or for 4e7 boxes (4e6 where three rods can be parallel, a spherical leg can fold or det A vanishes everywhere: there
    /// the bounds stay apart); with it never longer. `depth` and `res` (in length units, or in radians where angles alone vary) say how
    /// fine boxes may get, so the bounds may stay apart; they also set how finely the rest is drawn and measured [default: depth 16
    /// for 1 free coordinate, 11 for 2, 7 for 3]. Times depend on the machine, the others do not. Drawing --out comes on top
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    budget: Option<Budget>,
    /// Hold a coordinate at a value and analyse that slice: x=-4, phi=0.5 (radians) or phi=30deg; again, or separated by
    /// commas, for several. det A stays that of the whole robot
    #[arg(long, value_name = "COORDINATE=VALUE", value_delimiter = ',')]
    fix: Vec<String>,
    /// Analyse this working mode only, such as +-+; again, or separated by commas, for several [default: all]. A robot with more than 8 is paved once for every
    /// 8, which share the budget
    #[arg(long, value_name = "SIGNS", value_delimiter = ',', allow_hyphen_values = true)]
    mode: Vec<String>,
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

impl Analyze {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = input::robot(&self.robot)?;
        let fix = fix::parse(&robot, &self.fix)?;
        if let Some(directory) = &self.out {
            file::writable(directory).map_err(Failure::in_directory(directory))?;
        }
        let proof = self.certificate.as_deref().map(|path| Target::new("--certificate", path)).transpose()?;
        let budget = self.budget.unwrap_or_default();
        let modes = input::modes(&robot, &self.mode)?;
        let options = Options { budget, fix, modes, certificate: proof.is_some() };
        let analysis = watched(self.threads, |control| analyze(&robot, &options, control))??;
        self.print(out, &analysis)?;
        if let (Some(target), Some(certificate)) = (&proof, &analysis.certificate) {
            let text = certificate.to_json().map_err(|e| Failure::Input(format!("certificate: {e}")))?;
            let path = target.write(&text)?;
            note(&format!("certificate: {}", path.display()));
        }
        if analysis.run.stop == Stop::Cancelled {
            note("cancelled: this is the result so far");
        }
        Ok(Answer::from(analysis.run.stop != Stop::Cancelled))
    }

    fn print(&self, out: &mut dyn Write, analysis: &Analysis) -> Result<(), Failure> {
        if self.json {
            output::json(out, analysis)?;
        } else {
            summary::print(out, analysis)?;
        }
        let Some(directory) = &self.out else { return Ok(()) };
        // People see the numbers while the figures are drawn.
        out.flush()?;
        write_report(analysis, directory).map_err(Failure::in_directory(directory))?;
        let written = format!("report: {}", directory.join("report.html").display());
        if self.json {
            note(&written);
        } else {
            writeln!(out, "{written}")?;
        }
        Ok(())
    }
}

//! `aspecta analyze`: working modes and generalized aspects.

use crate::args::budget;
use crate::args::fix::{FixArg, OF_FIX_AND_TABLES};
use crate::args::format::TableArgs;
use crate::args::help::help;
use crate::args::out::OutDir;
use crate::args::robot::RobotArg;
use crate::args::threads::{self, Threads};
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, Target, note};
use crate::work::watch::watched;
use aspecta::aspect::{Analysis, Options, Purpose, analyze};
use aspecta::paving::{Budget, Stop};
use aspecta::text::{AnalysisAdvice, AnalysisSummary};
use aspecta_view::write_report;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `analyze`.
#[derive(Args)]
#[command(mut_args(help("out", "Write report.html and its figures into this directory")))]
#[command(mut_args(help("fix", FIX)))]
#[command(mut_args(help(
    "json",
    "Print the whole result as JSON, and nothing else, on stdout (angles in radians)"
)))]
#[command(mut_args(help("threads", threads::OF_NO_WEIGHT)))]
#[command(mut_args(help("deg", OF_FIX_AND_TABLES)))]
#[command(after_help = EXIT_STATUS)]
pub struct Analyze {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    shown: TableArgs,
    #[command(flatten)]
    out: OutDir,
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
    /// for 1 free coordinate, 11 for 2, 7 for 3; without --out as fine as leaves 0.3 % of the measures undecided, for up to 131072 boxes, or a
    /// quarter, more than the counts take]. Times depend on the machine, the others do not. Drawing --out comes on top
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    budget: Option<Budget>,
    #[command(flatten)]
    fix: FixArg,
    /// Analyse this working mode only, such as +-+; again, or separated by commas, for several [default: all]. A robot with more than 8 is paved once for every
    /// 8, which share the budget
    #[arg(long, value_name = "SIGNS", allow_hyphen_values = true)]
    mode: Vec<String>,
    #[command(flatten)]
    threads: Threads,
}

const FIX: &str = "\
    Hold a coordinate at a value and analyse that slice: x=-4, phi=0.5 (radians) or phi=30deg; \
    again, or separated by commas, for several. det A stays that of the whole robot";

const EXIT_STATUS: &str = "\
Exit status: 0 done, however far apart the bounds are; 1 a budget of time or boxes ended the run before any aspect was found, or Ctrl-C did, \
with the result so far; 2 bad input.";

/// Where the rows are that the tables leave out.
const ADVICE: AnalysisAdvice =
    AnalysisAdvice { on_aspects: ": see --json or --out", on_doubts: " (--json lists all)" };

impl Analyze {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let fix = self.fix.coordinates(&robot, self.shown.deg)?;
        self.out.check()?;
        let proof = self.certificate.as_deref().map(|path| Target::new("--certificate", path)).transpose()?;
        let budget = self.budget.unwrap_or_default();
        let modes = input::modes(&robot, &self.mode)?;
        let purpose = if self.out.directory().is_none() { Purpose::Numbers } else { Purpose::Pictures };
        let options = Options { budget, fix, modes, certificate: proof.is_some(), purpose };
        let analysis = watched(self.threads, |control| analyze(&robot, &options, control))??;
        self.print(out, &analysis)?;
        if let (Some(target), Some(certificate)) = (&proof, &analysis.certificate) {
            let text = certificate.to_json().map_err(|e| Failure::Input(format!("certificate: {e}")))?;
            let path = target.write(&text)?;
            note(&format!("certificate: {}", path.display()));
        }
        if analysis.run.stop == Stop::Cancelled {
            note("stopped: this is the result so far");
        }
        Ok(Answer::from(match analysis.run.stop {
            Stop::Exact | Stop::Resolution => true,
            Stop::Boxes | Stop::Time => analysis.aspects.low > 0,
            Stop::Cancelled => false,
        }))
    }

    fn print(&self, out: &mut dyn Write, analysis: &Analysis) -> Result<(), Failure> {
        if self.shown.json() {
            output::json(out, analysis)?;
        } else {
            write!(out, "{}", AnalysisSummary { analysis, degrees: self.shown.deg, advice: ADVICE })?;
        }
        let Some(directory) = self.out.directory() else { return Ok(()) };
        // People see the numbers while the figures are drawn.
        out.flush()?;
        write_report(analysis, directory).map_err(Failure::in_directory(directory))?;
        let written = format!("report: {}", directory.join("report.html").display());
        self.shown.format().say(out, &written)
    }
}

//! `aspecta verify`: whether a certificate proves what it claims.

use crate::args::format::JsonArg;
use crate::args::help::help;
use crate::args::threads::Threads;
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, Align, Table, note};
use crate::work::watch::watched;
use aspecta::certificate::{Certificate, CertificateError, Claim};
use aspecta::robot::Robot;
use aspecta::verify::{Checked, ENOUGH, Verdict, verify};
use aspecta_view::words::count;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Arguments of `verify`.
#[derive(Args)]
#[command(mut_args(help("json", "Print the verdict as JSON, and nothing else, on stdout")))]
pub struct Verify {
    /// The certificate
    file: PathBuf,
    /// The robot that it should be about: a name from `aspecta robots`, or the path of a robot file
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    #[command(flatten)]
    shown: JsonArg,
    #[command(flatten)]
    threads: Threads,
}

impl Verify {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let certificate = certificate(&self.file)?;
        if let Some(name) = &self.robot {
            let robot = input::robot(name)?;
            if !is_same(&robot, &certificate.robot) {
                note(&format!(
                    "not verified: `{}` is about `{}`, which is not the robot `{name}` leg by leg",
                    self.file.display(),
                    certificate.robot.name
                ));
                return Ok(Answer::No);
            }
        }
        let verdict = watched(self.threads, |control| verify(&certificate, control))?;
        if self.shown.json {
            output::json(out, &verdict)?;
        } else {
            print(out, &certificate, &verdict)?;
        }
        if !verdict.complete {
            note("cancelled: nothing is verified");
        }
        Ok(Answer::from(verdict.is_verified()))
    }
}

/// The certificate in a file, which may be another kind of file.
fn certificate(path: &Path) -> Result<Certificate, Failure> {
    Certificate::load(path).map_err(|error| match error {
        CertificateError::Form(_) if is_robot_file(path) => Failure::Input(format!(
            "`{0}`: a robot file, not a certificate; `aspecta analyze {0} --certificate FILE` writes one",
            path.display()
        )),
        CertificateError::Form(_) => Failure::Input(format!(
            "`{}`: {error}; `aspecta analyze ROBOT --certificate FILE` writes certificates",
            path.display()
        )),
        other => other.into(),
    })
}

/// Whether a file that is no JSON is a robot file, by its name if it has mistakes.
fn is_robot_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "toml") || Robot::load(path).is_ok()
}

/// Whether two robots are the same for the arithmetic.
fn is_same(a: &Robot, b: &Robot) -> bool {
    (a.platform, &a.legs, &a.window) == (b.platform, &b.legs, &b.window)
}

fn print(out: &mut dyn Write, certificate: &Certificate, verdict: &Verdict) -> Result<(), Failure> {
    let Verdict { sheets, leaves, claims, boxes, joins, seams, .. } = verdict;
    let (leaves, sheets) = (count(*leaves, "leaf", "leaves"), count(*sheets, "sheet", "sheets"));
    writeln!(out, "certificate for {}: {leaves} in {sheets}", certificate.robot.name)?;
    let held = certificate.window.held();
    let names = certificate.robot.platform.coordinates();
    for (k, value) in held {
        writeln!(out, "  slice {} = {value}", names[k].name)?;
    }
    let (inside, outside, undecided) = (claims.inside, claims.outside, claims.undecided);
    writeln!(out, "  claims: {inside} inside, {outside} outside, {undecided} undecided,")?;
    writeln!(
        out,
        "    {} summitless, {} covered, {}, {}",
        claims.summitless,
        claims.covered,
        count(*joins, "join", "joins"),
        count(*seams, "seam", "seams")
    )?;
    writeln!(out, "  boxes examined: {boxes}")?;
    if !verdict.classes.is_empty() {
        write!(out, "\n{}", table(&verdict.classes))?;
    }
    writeln!(out)?;
    for fault in &verdict.faults {
        writeln!(out, "fault: {}", fault.in_words(&certificate.modes))?;
    }
    if verdict.faults.len() >= ENOUGH {
        writeln!(out, "there may be more: boxes are looked at until {ENOUGH} have faults")?;
    }
    match verdict.is_verified() {
        true => writeln!(out, "verified: {}{}", total(&certificate.claims), restriction(certificate))?,
        false if verdict.is_refuted() => writeln!(out, "not verified: a claim is proved wrong")?,
        false if verdict.complete => {
            writeln!(out, "not verified: not all claims are proved with the effort spent")?;
        }
        false => {}
    }
    Ok(())
}

fn table(classes: &[Checked]) -> Table {
    let columns = ["mode", "det A"].map(|name| (name.to_owned(), Align::Left));
    let bounds = ["claimed", "proved"].map(|name| (name.to_owned(), Align::Right));
    let mut table = Table::new(columns.into_iter().chain(bounds));
    for class in classes {
        let sign = if class.det_a > 0 { "  +" } else { "  -" };
        table.row([class.mode.to_string(), sign.into(), range(class.claimed), range(class.proved)]);
    }
    table
}

fn range(claim: Claim) -> String {
    match claim.high {
        Some(high) if high == claim.low => format!("{high}"),
        Some(high) => format!("{}..{high}", claim.low),
        None => format!("≥ {}", claim.low),
    }
}

/// Returns the restriction under which the total is meant.
fn restriction(certificate: &Certificate) -> &'static str {
    let all = certificate.robot.working_modes().len();
    if certificate.modes.len() < all { ", in the working modes listed" } else { "" }
}

/// Returns the total over all classes, in words.
fn total(claims: &[Claim]) -> String {
    let low: usize = claims.iter().map(|c| c.low).sum();
    let aspects = |n: usize| count(n, "generalized aspect", "generalized aspects");
    match claims.iter().map(|c| c.high).sum::<Option<usize>>() {
        Some(high) if high == low => format!("exactly {}", aspects(low)),
        Some(high) => format!("at least {low} and at most {}", aspects(high)),
        None => format!("at least {}", aspects(low)),
    }
}

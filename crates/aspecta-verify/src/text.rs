//! A verdict for people.

use crate::certificate::Claim;
use crate::{Checked, ENOUGH, Verdict};
use aspecta_robot::num::count;
use std::fmt::{self, Write};

/// Prints what the certificate claims, what is proved of it class by class, the faults, and the verdict.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Options, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(6), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, certificate: true, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
/// let certificate = analysis.certificate.expect("asked for");
///
/// let summary = aspecta_verify::verify(&certificate, &Control::unwatched()).to_string();
/// assert!(summary.contains("verified: at least 2 generalized aspects, in the working modes listed"));
/// # Ok(())
/// # }
/// ```
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        claims(f, self)?;
        if !self.classes.is_empty() {
            writeln!(f)?;
            table(f, &self.classes)?;
        }
        writeln!(f)?;
        for fault in &self.faults {
            writeln!(f, "fault: {}", fault.in_words(&self.modes))?;
        }
        if self.faults.len() >= ENOUGH {
            writeln!(f, "there may be more: boxes are looked at until {ENOUGH} have faults")?;
        }
        match self.is_verified() {
            true => writeln!(f, "verified: {}{}", total(&self.classes), restriction(self)),
            false if self.is_refuted() => writeln!(f, "not verified: a claim is proved wrong"),
            false if self.complete => {
                writeln!(f, "not verified: not all claims are proved with the effort spent")
            }
            false => Ok(()),
        }
    }
}

fn claims(out: &mut dyn Write, verdict: &Verdict) -> fmt::Result {
    let Verdict { robot, window, sheets, leaves, claims, boxes, joins, seams, .. } = verdict;
    let (leaves, sheets) = (count(*leaves, "leaf", "leaves"), count(*sheets, "sheet", "sheets"));
    writeln!(out, "certificate for {}: {leaves} in {sheets}", robot.name)?;
    for (k, value) in window.held() {
        writeln!(out, "  slice {} = {value}", robot.platform.coordinates()[k].name)?;
    }
    let (inside, outside, undecided) = (claims.inside, claims.outside, claims.undecided);
    writeln!(out, "  claims: {inside} inside, {outside} outside, {undecided} undecided,")?;
    let (joins, seams) = (count(*joins, "join", "joins"), count(*seams, "seam", "seams"));
    let (summitless, covered) = (claims.summitless, claims.covered);
    writeln!(out, "    {summitless} summitless, {covered} covered, {joins}, {seams}")?;
    writeln!(out, "  boxes examined: {boxes}")
}

/// A line for each class: text to the left, numbers to the right.
fn table(out: &mut dyn Write, classes: &[Checked]) -> fmt::Result {
    let head = ["mode", "det A", "claimed", "proved"].map(String::from);
    let line = |class: &Checked| {
        let sign = if class.det_a > 0 { "  +" } else { "  -" };
        [class.mode.to_string(), sign.into(), range(class.claimed), range(class.proved)]
    };
    let lines: Vec<[String; 4]> = [head].into_iter().chain(classes.iter().map(line)).collect();
    let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let [a, b, c, d] = [0, 1, 2, 3].map(width);
    for [mode, sign, claimed, proved] in &lines {
        writeln!(out, "  {mode:a$}  {sign:b$}  {claimed:>c$}  {proved:>d$}")?;
    }
    Ok(())
}

fn range(claim: Claim) -> String {
    match claim.high {
        Some(high) if high == claim.low => format!("{high}"),
        Some(high) => format!("{}..{high}", claim.low),
        None => format!("≥ {}", claim.low),
    }
}

/// Returns the restriction under which the total is meant.
fn restriction(verdict: &Verdict) -> &'static str {
    let all = verdict.robot.working_modes().len();
    if verdict.modes.len() < all { ", in the working modes listed" } else { "" }
}

/// Returns the total over all classes, in words.
fn total(classes: &[Checked]) -> String {
    let low: usize = classes.iter().map(|class| class.claimed.low).sum();
    let aspects = |n: usize| count(n, "generalized aspect", "generalized aspects");
    match classes.iter().map(|class| class.claimed.high).sum::<Option<usize>>() {
        Some(high) if high == low => format!("exactly {}", aspects(low)),
        Some(high) => format!("at least {low} and at most {}", aspects(high)),
        None => format!("at least {}", aspects(low)),
    }
}

//! The result of a check.

use crate::certificate::{Certificate, Claim};
use aspecta_robot::{Robot, Window, WorkingMode};
use serde::Serialize;

/// The outcome of a check.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
#[must_use = "a certificate is verified only if the verdict says so"]
pub struct Verdict {
    /// The robot of the certificate.
    #[serde(skip)]
    pub robot: Robot,
    /// Its poses that the certificate is about.
    #[serde(skip)]
    pub window: Window,
    /// Its working modes that the certificate is about, in the order of the classes.
    #[serde(skip)]
    pub modes: Vec<WorkingMode>,
    /// Whether the check was carried to its end.
    pub complete: bool,
    /// Faults found, up to a few dozen: none is a proof of what is claimed, if the check is complete.
    pub faults: Vec<Fault>,
    /// Sheets.
    pub sheets: usize,
    /// Leaves of all sheets.
    pub leaves: usize,
    /// Claims on leaves, counted once per class (once per leaf: covered).
    pub claims: Counts,
    /// Boxes into which leaves were cut to prove them.
    pub boxes: u64,
    /// Paths proved.
    pub joins: usize,
    /// Seams proved.
    pub seams: usize,
    /// Per class, what is claimed and what was found; empty if faults were found before.
    pub classes: Vec<Checked>,
}

/// How many claims of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Inside a class.
    pub inside: usize,
    /// Outside a class.
    pub outside: usize,
    /// Nothing claimed of a class, in leaves that are not covered.
    pub undecided: usize,
    /// Summitless for a class.
    pub summitless: usize,
    /// Covered.
    pub covered: usize,
}

/// One class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Checked {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A, +1 or −1.
    pub det_a: i8,
    /// The bounds claimed.
    pub claimed: Claim,
    /// The bounds that the leaves, joins and seams prove.
    pub proved: Claim,
}

/// A claim that is wrong or not proved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// The sheet, if it is about one.
    pub sheet: Option<usize>,
    /// The leaf, numbered from 0 in the order of the certificate.
    pub leaf: Option<usize>,
    /// The class: 2m for mode m and det A > 0, 2m + 1 for det A < 0.
    pub class: Option<usize>,
    /// The bounds of the leaf's box, per coordinate.
    pub bounds: Vec<(f64, f64)>,
    /// The reason.
    pub reason: String,
    /// Whether the claim is proved wrong; else it could not be proved with the effort spent.
    pub is_wrong: bool,
}

impl Fault {
    pub(super) fn of_sheet(sheet: usize, reason: String) -> Self {
        Self { sheet: Some(sheet), leaf: None, class: None, bounds: Vec::new(), reason, is_wrong: false }
    }

    pub(super) fn of_class(class: usize, reason: String) -> Self {
        Self { sheet: None, leaf: None, class: Some(class), bounds: Vec::new(), reason, is_wrong: false }
    }

    /// A line for people; `modes` are those of the certificate.
    pub fn in_words(&self, modes: &[WorkingMode]) -> String {
        let class = self.class.and_then(|class| Some((modes.get(class / 2)?, class)));
        let class = class.map(|(mode, class)| {
            format!("class {class} ({mode}, det A {} 0)", if class % 2 == 0 { '>' } else { '<' })
        });
        let named = |name: &str, k: Option<usize>| k.map(|k| format!("{name} {k}"));
        let parts: Vec<String> =
            [named("sheet", self.sheet), named("leaf", self.leaf), class].into_iter().flatten().collect();
        let ranges: Vec<String> = self.bounds.iter().map(|(lo, hi)| format!("[{lo}, {hi}]")).collect();
        let place = if ranges.is_empty() { String::new() } else { format!(", in {}", ranges.join(" × ")) };
        format!("{}: {}{place}", parts.join(", "), self.reason)
    }
}

impl Verdict {
    pub(super) fn new(certificate: &Certificate) -> Self {
        let mut claims = Counts::default();
        let mut leaves = 0;
        let classes = 2 * certificate.modes.len();
        for leaf in certificate.leaves() {
            leaves += 1;
            let count = |set: u16| set.count_ones() as usize;
            claims.covered += usize::from(leaf.covered);
            claims.inside += count(leaf.inside);
            if !leaf.covered {
                claims.undecided += count(leaf.undecided);
                claims.summitless += count(leaf.summitless);
                claims.outside += classes - count(leaf.inside | leaf.undecided);
            }
        }
        let (joins, seams) = (certificate.joins.len(), certificate.seams.len());
        let sheets = certificate.sheets.len();
        Self {
            robot: certificate.robot.clone(),
            window: certificate.window.clone(),
            modes: certificate.modes.clone(),
            complete: false,
            faults: vec![],
            sheets,
            leaves,
            claims,
            boxes: 0,
            joins,
            seams,
            classes: vec![],
        }
    }

    /// Whether a claim of the certificate is proved wrong.
    pub fn is_refuted(&self) -> bool {
        self.faults.iter().any(|fault| fault.is_wrong)
    }

    /// Whether all that the certificate claims is proved.
    pub fn is_verified(&self) -> bool {
        self.complete && self.faults.is_empty()
    }
}

//! The claims about a leaf, proved again by cutting it up.

use super::in_mode::Existence;
use super::place::{Coordinates, Place, Setting};
use crate::certificate::Leaf;
use aspecta_robot::ClassSet;
use aspecta_robot::WorkingMode;
use aspecta_robot::chart::Chart;
use aspecta_robot::num::Interval;
use std::sync::atomic::{AtomicBool, Ordering};

/// Most boxes into which the proof of a leaf is cut, before the claim counts as unproved.
const EFFORT: usize = 20_000;

/// Claims still to be proved in a box.
#[derive(Clone, Copy, Debug, Default)]
struct Needs {
    inside: ClassSet,
    outside: ClassSet,
    summitless: ClassSet,
    covered: bool,
}

impl Needs {
    fn none(&self) -> bool {
        self.inside | self.outside | self.summitless == 0 && !self.covered
    }

    /// The first class of which something is to be proved.
    fn first(&self) -> Option<usize> {
        let all = self.inside | self.outside | self.summitless;
        (all != 0).then(|| all.trailing_zeros() as usize)
    }
}

/// A claim that is wrong, or could not be proved.
pub(super) struct Unproved {
    /// The class, if the claim is about one.
    pub class: Option<usize>,
    pub reason: &'static str,
    /// Whether it is proved wrong.
    pub is_wrong: bool,
}

/// The sign of det A of a class.
pub(super) fn sign_of(class: usize) -> f64 {
    if class.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Proves what is claimed of a leaf, which `charts` may cover; returns how many boxes it was cut into. Once
/// `cancelled`, nothing is proved, and the verdict is incomplete.
pub(super) fn prove<const D: usize>(
    setting: &Setting<'_>,
    modes: &[WorkingMode],
    charts: &[&Chart],
    (y, claims): (Coordinates, Leaf),
    cancelled: &AtomicBool,
) -> Result<usize, Unproved> {
    let all = ((1u32 << (2 * modes.len())) - 1) as ClassSet;
    // A covered leaf takes no part in G⁺ and hides no summit: the fold has its configurations.
    let needs = Needs {
        inside: claims.inside,
        outside: if claims.covered { 0 } else { all & !(claims.inside | claims.undecided) },
        summitless: if claims.covered { 0 } else { claims.summitless },
        covered: claims.covered,
    };
    let mut open = vec![(y, needs)];
    let mut spent = 0;
    while let Some((y, mut needs)) = open.pop() {
        if needs.none() {
            continue;
        }
        if cancelled.load(Ordering::Relaxed) {
            return Ok(spent);
        }
        spent += 1;
        let doubt = settle::<D>(setting, y, modes, charts, &mut needs)?;
        if needs.none() {
            continue;
        }
        if spent >= EFFORT {
            let reason = if needs.covered { COVERED } else { doubt };
            let class = if needs.covered { None } else { needs.first() };
            return Err(Unproved { class, reason, is_wrong: false });
        }
        let [low, high] = setting.halves(&y);
        open.extend([(high, needs), (low, needs)]);
    }
    Ok(spent)
}

const COVERED: &str = "claimed covered, but the chart of no fold is proved to hold all configurations";
const NOT_INSIDE: &str = "claimed inside, but a leg may be out of reach here, or a limit broken";
const VANISHES: &str = "claimed inside, but det A may vanish here";
const NOT_OUTSIDE: &str = "claimed outside, but poses of the class may lie here";
const SUMMIT: &str = "claimed summitless, but P may have a maximum here";

/// Strikes from `needs` what is proved of a box, and says what is in doubt with the first of the rest.
fn settle<const D: usize>(
    setting: &Setting<'_>,
    y: Coordinates,
    modes: &[WorkingMode],
    charts: &[&Chart],
    needs: &mut Needs,
) -> Result<&'static str, Unproved> {
    let place = Place::<D>::new(setting, y);
    if needs.covered && (place.cannot_close() || charts.iter().any(|chart| place.is_covered_by(chart))) {
        needs.covered = false;
    }
    let mut doubt = None;
    for (m, &mode) in modes.iter().enumerate() {
        let both: ClassSet = 3 << (2 * m);
        if (needs.inside | needs.outside | needs.summitless) & both == 0 {
            continue;
        }
        let legs = place.in_mode(mode);
        let existence = legs.as_ref().map_or(Existence::Nowhere, |legs| legs.existence());
        let legs = legs.filter(|_| existence != Existence::Nowhere);
        let vanishes = setting.vanishes_in(mode);
        let det = match (setting.known_sign(mode), &legs) {
            (Some(sign), _) => Interval::point(sign),
            (None, Some(legs)) if !vanishes => legs.determinant().range,
            _ => Interval::ENTIRE,
        };
        for class in [2 * m, 2 * m + 1] {
            let bit: ClassSet = 1 << class;
            let signed = det * Interval::point(sign_of(class));
            let inside = existence == Existence::Everywhere && signed.is_positive();
            let outside = existence == Existence::Nowhere || vanishes || signed.hi <= 0.0;
            let wrong = |reason| Err(Unproved { class: Some(class), reason, is_wrong: true });
            match (needs.inside & bit != 0, needs.outside & bit != 0) {
                (true, _) if outside => return wrong("claimed inside, but it is not"),
                (_, true) if inside => return wrong("claimed outside, but it is inside"),
                (true, _) if inside => needs.inside &= !bit,
                (_, true) if outside => needs.outside &= !bit,
                (true, _) if existence == Existence::Everywhere => doubt = doubt.or(Some(VANISHES)),
                (true, _) => doubt = doubt.or(Some(NOT_INSIDE)),
                (_, true) => doubt = doubt.or(Some(NOT_OUTSIDE)),
                _ => {}
            }
            let climbs = || {
                place.is_about_fold_of_twins(mode)
                    || legs.as_ref().is_none_or(|legs| legs.is_summitless(sign_of(class)))
            };
            if needs.summitless & bit != 0 && (outside || climbs()) {
                needs.summitless &= !bit;
            } else if needs.summitless & bit != 0 {
                doubt = doubt.or(Some(SUMMIT));
            }
        }
    }
    Ok(doubt.unwrap_or(COVERED))
}

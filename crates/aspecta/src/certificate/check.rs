//! Whether the parts of a certificate fit together, so that whoever reads on need not look out for nonsense.

use super::{Certificate, TreeError};
use crate::kinematics::chart::{Chain, Chart, Fold};
use crate::num::{Interval, Scalar, cross, dot};
use crate::paving::AXES;
use crate::robot::{Actuator, Leg, Limit, Platform, Robot, RobotError, Window, is_line};

/// Parts that do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsound {
    /// Legs and platform make no robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A constant of the robot that no robot can have.
    #[error("leg {leg} of the robot: {what}")]
    Leg {
        /// Leg number, from 1.
        leg: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// A number of entries that is not the one wanted.
    #[error("{what}: {found} entries where {wanted} are wanted")]
    Count {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// An index beyond the end.
    #[error("{what} {index}: there is none")]
    Index {
        /// Of what.
        what: &'static str,
        /// The index, from 0.
        index: usize,
    },
    /// A bound beyond all that leaves can prove.
    #[error(
        "the claim of class {class} counts {claimed} aspects, more than there are leaves ({leaves}) to prove them"
    )]
    Claim {
        /// The class.
        class: usize,
        /// Aspects claimed.
        claimed: usize,
        /// Leaves of all sheets.
        leaves: usize,
    },
    /// A value that cannot be used.
    #[error("{0}")]
    Value(&'static str),
    /// A tree that is none.
    #[error("sheet {sheet}: {error}")]
    Tree {
        /// The sheet.
        sheet: usize,
        /// Why.
        error: TreeError,
    },
}

/// Numbers beyond this are not those of a robot.
const GREATEST: f64 = 1e7;

pub(crate) fn wanted(what: &'static str, found: usize, wanted: usize) -> Result<(), Unsound> {
    if found == wanted { Ok(()) } else { Err(Unsound::Count { what, found, wanted }) }
}

pub(crate) fn holds(fact: bool, complaint: &'static str) -> Result<(), Unsound> {
    if fact { Ok(()) } else { Err(Unsound::Value(complaint)) }
}

fn usable(x: f64) -> bool {
    x.abs() <= GREATEST
}

impl Certificate {
    pub(super) fn check(&self) -> Result<(), Unsound> {
        check_robot(&self.robot)?;
        let n = self.robot.dof();
        self.check_window(n)?;
        self.check_modes(n)?;
        self.check_scale(n)?;
        let classes = 2 * self.modes.len();
        wanted("claims", self.claims.len(), classes)?;
        self.check_sheets(classes)?;
        self.check_claims()?;
        let class = |index: usize| {
            if index < classes { Ok(()) } else { Err(Unsound::Index { what: "class", index }) }
        };
        let point = |point: &Vec<f64>| {
            wanted("coordinates of a point", point.len(), n)?;
            holds(point.iter().all(|x| usable(*x)), "a point has a coordinate beyond ±1e7")
        };
        for join in &self.joins {
            class(join.class)?;
            if join.sheet >= self.sheets.len() {
                return Err(Unsound::Index { what: "sheet of a join", index: join.sheet });
            }
            holds(join.path.len() >= 2, "a path has fewer than two poses")?;
            join.path.iter().try_for_each(point)?;
        }
        for seam in &self.seams {
            class(seam.class)?;
            point(&seam.point)?;
            if seam.sheet == 0 || seam.sheet >= self.sheets.len() {
                return Err(Unsound::Index { what: "sheet of a seam", index: seam.sheet });
            }
        }
        Ok(())
    }

    fn check_window(&self, n: usize) -> Result<(), Unsound> {
        let window = &self.window;
        for (what, found) in [
            ("window.ranges", window.ranges.len()),
            ("window.glued", window.glued.len()),
            ("window.angles", window.angles.len()),
            ("window.cut", window.cut.len()),
        ] {
            wanted(what, found, n)?;
        }
        let ranges = || window.ranges.iter();
        holds(
            ranges().all(|r| usable(r.0) && usable(r.1) && r.0 <= r.1),
            "a range of the window is empty or beyond ±1e7",
        )?;
        holds(
            ranges().any(|r| r.0 < r.1),
            "all coordinates of the window are held: there is nothing to analyse",
        )?;
        holds(
            ranges().filter(|r| r.0 < r.1).count() <= AXES,
            "more than three coordinates of the window vary",
        )
    }

    fn check_modes(&self, n: usize) -> Result<(), Unsound> {
        let modes = &self.modes;
        holds((1..=8).contains(&modes.len()), "there are 1 to 8 working modes in a certificate")?;
        modes.iter().try_for_each(|mode| wanted("signs of a mode", mode.legs(), n))?;
        holds((1..modes.len()).all(|m| !modes[..m].contains(&modes[m])), "a working mode is listed twice")?;
        let strut = |j: usize| self.robot.legs[j].actuator.postures() == 1;
        holds(
            modes.iter().all(|mode| (0..n).all(|j| !strut(j) || mode.sign(j) < 0)),
            "a strut has the sign + in a working mode",
        )
    }

    fn check_scale(&self, n: usize) -> Result<(), Unsound> {
        let scale = &self.scale;
        wanted("scale.reach", scale.reach.len(), n)?;
        wanted("scale.limits", scale.limits.len(), n)?;
        for (leg, scales) in self.robot.legs.iter().zip(&scale.limits) {
            wanted("scale.limits of a leg", scales.len(), leg.limits.len())?;
        }
        let mut all = scale.limits.iter().flatten().chain(&scale.reach).chain([&scale.det]);
        holds(
            all.all(|x| x.is_normal() && *x > 0.0),
            "a scale is not a positive number: P would not vanish at the boundary",
        )
    }

    fn check_sheets(&self, classes: usize) -> Result<(), Unsound> {
        let axes = self.window.ranges.iter().filter(|r| r.0 < r.1).count();
        holds(
            self.sheets.first().is_some_and(|sheet| sheet.chart == Chart::Pose),
            "sheet 0 is missing, or not in pose coordinates",
        )?;
        for (k, sheet) in self.sheets.iter().enumerate() {
            match &sheet.chart {
                Chart::Pose => holds(k == 0, "there is more than one sheet in pose coordinates")?,
                Chart::Fold(fold) => check_fold(&self.robot, fold)?,
                Chart::Chain(chain) => check_chain(&self.robot, &self.window, chain, k)?,
            }
            sheet.tree.check(axes, classes).map_err(|error| Unsound::Tree { sheet: k, error })?;
        }
        Ok(())
    }

    /// Bounds that could be proved count distinct leaves. Greater ones say nothing, and their sums could overflow.
    fn check_claims(&self) -> Result<(), Unsound> {
        let leaves = self.leaves().count();
        for (class, claim) in self.claims.iter().enumerate() {
            let claimed = claim.low.max(claim.high.unwrap_or(0));
            if claimed > leaves {
                return Err(Unsound::Claim { class, claimed, leaves });
            }
        }
        Ok(())
    }
}

fn check_fold(robot: &Robot, fold: &Fold) -> Result<(), Unsound> {
    let leg = robot.legs.get(fold.leg).ok_or(Unsound::Index { what: "leg of a fold", index: fold.leg })?;
    holds(matches!(leg.actuator, Actuator::Revolute { .. }), "a fold is that of a leg without a crank")?;
    holds(
        matches!(robot.platform, Platform::PlanePoint | Platform::PlaneBody | Platform::TranslatingBody),
        "a fold has a platform that cannot be moved to it without turning",
    )?;
    holds(fold.half_width > 0.0 && fold.half_width < 1.0, "the half-width of a fold is not in (0, 1)")?;
    let axial = match fold.axial {
        None => robot.platform.space() == 2,
        Some((lo, hi)) => robot.platform.space() == 3 && -1.0 <= lo && lo < hi && hi <= 1.0,
    };
    holds(axial, "the axial range of a fold is not one, or one too many in the plane")?;
    holds(
        sane(&fold.crank) && sane(&fold.rod),
        "a length of a fold is not finite, beyond ±1e7, or an empty range",
    )
}

fn check_chain(robot: &Robot, window: &Window, chain: &Chain, sheet: usize) -> Result<(), Unsound> {
    let leg = robot.legs.get(chain.leg).ok_or(Unsound::Index { what: "leg of a chain", index: chain.leg })?;
    holds(
        robot.platform == Platform::TurningBody && matches!(leg.actuator, Actuator::Spherical { .. }),
        "a chain is that of a platform that does not turn about a point, or of a leg that is not spherical",
    )?;
    let whole = window.ranges.len() == 3 && window.cut.iter().all(|cut| *cut == (false, false));
    holds(
        whole && window.held().next().is_none(),
        "a chain holds all orientations, but the window cuts or holds some",
    )?;
    holds(
        chain.bend.is_none() == (sheet == 1),
        "sheet 1 is that of a chain which holds all configurations, and later ones are those of bends",
    )?;
    let width = chain.bend.as_ref().map_or(0.5, |bend| bend.half_width);
    holds(width > 0.0 && width < 1.0, "the half-width of a bend is not in (0, 1)")
}

fn sane(x: &Interval) -> bool {
    usable(x.lo) && usable(x.hi) && x.lo <= x.hi
}

/// Whether a robot that was read from a file of results is one.
pub(crate) fn check_robot(robot: &Robot) -> Result<(), Unsound> {
    Robot::new(&robot.name, robot.platform, robot.legs.clone())?;
    holds(
        [&robot.name, &robot.title, &robot.source, &robot.length_unit]
            .into_iter()
            .all(|words| is_line(words)),
        "the name, title, source or unit of the robot has a line break, tab or other control character",
    )?;
    let n = robot.dof();
    wanted("robot.window", robot.window.len(), n)?;
    holds(
        robot.window.iter().flatten().all(|r| usable(r.0) && usable(r.1) && r.0 <= r.1),
        "a range in the robot's window is empty or beyond ±1e7",
    )?;
    for (j, leg) in robot.legs.iter().enumerate() {
        let what = fault_of_leg(leg, robot.platform);
        if let Some(what) = what {
            return Err(Unsound::Leg { leg: j + 1, what });
        }
    }
    Ok(())
}

/// What is wrong with a leg, if anything is.
fn fault_of_leg(leg: &Leg, platform: Platform) -> Option<&'static str> {
    if !leg.anchor.iter().chain(&leg.attachment).chain(leg.frame.as_flattened()).all(sane) {
        return Some(
            "a coordinate of its points or of its frame is not finite, beyond ±1e7, or an empty range",
        );
    }
    if !(0..3)
        .all(|i| (0..3).all(|k| is_about(dot(&leg.frame[i], &leg.frame[k]), f64::from(u8::from(i == k)))))
    {
        return Some("its frame is not orthonormal");
    }
    let [x, y, z] = &leg.frame;
    if !cross(x, y).iter().zip(z).all(|(across, z)| is_about(*across - *z, 0.0)) {
        return Some("its frame is not right-handed: its angles would turn the other way");
    }
    let out_of_plane = [x[2], y[2], z[0], z[1]];
    if platform.space() == 2 && !out_of_plane.iter().all(|entry| is_about(*entry, 0.0)) {
        return Some("its frame does not lie in the plane");
    }
    if platform == Platform::TurningBody && leg.anchor.iter().any(|a| *a != Interval::point(0.0)) {
        return Some("its anchor is not the centre about which the platform turns");
    }
    if platform == Platform::TurningBody && !is_about(dot(&leg.attachment, &leg.attachment), 1.0) {
        return Some("its platform joint is not a unit vector");
    }
    let lengths = |all: &[Interval]| all.iter().all(|x| sane(x) && x.lo > 0.0);
    let fit = match &leg.actuator {
        Actuator::Revolute { crank, rod } => lengths(&[*crank, *rod]),
        Actuator::Prismatic { rod } => lengths(&[*rod]),
        Actuator::Strut => true,
        Actuator::Spherical { proximal, distal_cos } => {
            is_circular(proximal)
                && proximal.1.lo > 0.0
                && sane(distal_cos)
                && distal_cos.lo > -1.0
                && distal_cos.hi < 1.0
        }
    };
    if !fit {
        return Some(
            "a link length is not positive, not finite, beyond 1e7, or an empty range, or an angle is none",
        );
    }
    let all = leg.limits.iter().all(|limit| is_limit(limit, &leg.actuator, platform.space()));
    (!all).then_some("a limit makes no sense, or belongs to a leg of another kind")
}

/// Whether an enclosure is a narrow one of x.
fn is_about(enclosure: Interval, x: f64) -> bool {
    enclosure.contains(x) && enclosure.width() < 1e-6
}

fn is_circular((cos, sin): &(Interval, Interval)) -> bool {
    sane(cos) && sane(sin) && is_about(cos.square() + sin.square(), 1.0)
}

fn is_limit(limit: &Limit, actuator: &Actuator, space: usize) -> bool {
    let revolute = matches!(actuator, Actuator::Revolute { .. });
    match limit {
        Limit::ActuatorAngle { middle, half_cos } => {
            actuator.is_angle() && is_circular(middle) && sane(half_cos)
        }
        Limit::ActuatorLength { min, max } => {
            let strut = matches!(actuator, Actuator::Strut);
            !actuator.is_angle() && sane(min) && sane(max) && min.hi <= max.hi && (!strut || min.lo >= 0.0)
        }
        Limit::Elbow { middle, half_cos } => revolute && space == 2 && is_circular(middle) && sane(half_cos),
        Limit::SpatialElbow { min_cos, max_cos } => {
            revolute && space == 3 && sane(min_cos) && sane(max_cos) && max_cos.hi <= min_cos.hi
        }
        Limit::BaseCone { axis, half_cos } | Limit::PlatformCone { axis, half_cos } => {
            let unit = axis.iter().all(sane) && is_about(dot(axis, axis), 1.0);
            !matches!(actuator, Actuator::Spherical { .. }) && unit && sane(half_cos)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::catalogue;

    /// Why the five-bar, changed, is no robot.
    fn refusal(change: impl FnOnce(&mut Robot)) -> String {
        let mut robot = catalogue::find("five-bar").unwrap();
        change(&mut robot);
        check_robot(&robot).unwrap_err().to_string()
    }

    #[test]
    fn words_cannot_steer_a_terminal() {
        let changes: [fn(&mut Robot); 4] = [
            |robot| robot.name.push_str("\u{1b}[2J"),
            |robot| robot.title.push('\n'),
            |robot| robot.source.push('\u{7}'),
            |robot| robot.length_unit.push('\t'),
        ];
        for change in changes {
            assert!(refusal(change).contains("control character"));
        }
    }

    #[test]
    fn ranges_that_are_none() {
        for (lo, hi) in [(1.0, 0.0), (0.0, 2e7), (f64::NAN, 1.0)] {
            let said = refusal(|robot| robot.legs[1].anchor[0] = Interval { lo, hi });
            let wanted = "leg 2 of the robot: a coordinate of its points or of its frame is not finite, beyond ±1e7, \
                          or an empty range";
            assert_eq!(said, wanted);
        }
        let said = refusal(|robot| {
            robot.legs[0].actuator =
                Actuator::Revolute { crank: Interval { lo: 9.0, hi: 8.0 }, rod: Interval::point(5.0) };
        });
        assert!(said.contains("or an empty range"), "{said}");
    }
}

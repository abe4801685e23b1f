//! Whether a robot that was read from a file of results (a certificate, a map) makes sense.

use crate::MOST_SHARED;
use crate::file::is_line;
use crate::num::{Interval, Scalar, cross, dot};
use crate::{
    Actuator, GREATEST, Leg, LegIndex, Limit, Platform, Prismatic, Revolute, Robot, RobotError, Spherical,
    Strut,
};

/// Parts that do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsound {
    /// Legs and platform make no robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A constant of the robot that no robot can have.
    #[error("leg {leg} of the robot: {what}")]
    Leg {
        /// The leg.
        leg: LegIndex,
        /// The fault.
        what: &'static str,
    },
    /// A number of entries that is not the one wanted.
    #[error("{what}: {found} entries where {wanted} are wanted")]
    Count {
        /// The quantity.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// An index beyond the end.
    #[error("{what} {index}: there is none")]
    Index {
        /// The quantity.
        what: &'static str,
        /// The index, from 0.
        index: usize,
    },
    /// A value that cannot be used.
    #[error("{0}")]
    Value(&'static str),
}

/// [`Unsound::Count`] unless there are as many entries as wanted.
///
/// # Errors
/// [`Unsound::Count`]
pub fn wanted(what: &'static str, found: usize, wanted: usize) -> Result<(), Unsound> {
    if found == wanted { Ok(()) } else { Err(Unsound::Count { what, found, wanted }) }
}

/// `complaint` unless `fact` holds.
///
/// # Errors
/// [`Unsound::Value`]
pub fn holds(fact: bool, complaint: &'static str) -> Result<(), Unsound> {
    if fact { Ok(()) } else { Err(Unsound::Value(complaint)) }
}

/// Whether a number can be one of a robot.
pub fn usable(x: f64) -> bool {
    x.abs() <= GREATEST
}

impl Robot {
    /// Whether a robot that was read from a file of results is one.
    ///
    /// # Errors
    /// [`Unsound`]: what is wrong with it.
    pub fn check(&self) -> Result<(), Unsound> {
        Self::new(&self.name, self.platform, self.legs.clone())?;
        holds(
            [&self.name, &self.title, &self.source, &self.length_unit]
                .into_iter()
                .all(|words| is_line(words)),
            "the name, title, source or unit of the robot has a line break, tab or other character that cannot be seen",
        )?;
        let n = self.dof();
        wanted("robot.window", self.window.len(), n)?;
        holds(
            self.window.iter().flatten().all(|r| usable(r.0) && usable(r.1) && r.0 <= r.1),
            "a range in the robot's window is empty or beyond ±1e7",
        )?;
        for (j, leg) in self.legs.iter().enumerate() {
            let what = fault_of_leg(leg, self.platform);
            if let Some(what) = what {
                return Err(Unsound::Leg { leg: LegIndex::new(j), what });
            }
        }
        holds(
            self.rod_angles.len() <= MOST_SHARED && self.rod_angles.iter().all(|limit| limit.fits(self)),
            "a limit of the angle between two rods makes no sense, or there are too many of them",
        )?;
        holds(
            self.are_bodies_sound(),
            "a body or a pair of bodies makes no sense, or there are too many of them",
        )
    }
}

/// Whether an interval can be a constant of a robot: finite, within ±1e7 and not empty.
pub fn sane(x: &Interval) -> bool {
    usable(x.lo) && usable(x.hi) && x.lo <= x.hi
}

/// Whether a point or direction of a planar machine lies in the plane; in space any does.
pub(crate) fn is_in_space(v: &[Interval; 3], space: usize) -> bool {
    space == 3 || v[2] == Interval::point(0.0)
}

/// Returns the fault of a leg, if it has one.
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
        Actuator::Revolute(Revolute { crank, rod }) => lengths(&[*crank, *rod]),
        Actuator::Prismatic(Prismatic { rod }) => lengths(&[*rod]),
        Actuator::Strut(Strut) => true,
        Actuator::Spherical(Spherical { proximal, distal_cos }) => {
            is_circular(proximal)
                && proximal.1.lo > 0.0
                && sane(distal_cos)
                && distal_cos.lo > -1.0
                && distal_cos.hi < 1.0
        }
    };
    if !fit {
        return Some(
            "a link length is not positive, not finite, beyond 1e7, or an empty range, \
             or an angle of a link is not within (0, π)",
        );
    }
    let all = leg.limits.iter().all(|limit| is_limit(limit, leg, platform.space()));
    (!all).then_some("a limit makes no sense, or belongs to a leg of another kind")
}

/// Whether an enclosure is a narrow one of x.
fn is_about(enclosure: Interval, x: f64) -> bool {
    enclosure.contains(x) && enclosure.width() < 1e-6
}

fn is_circular((cos, sin): &(Interval, Interval)) -> bool {
    sane(cos) && sane(sin) && is_about(cos.square() + sin.square(), 1.0)
}

/// The quantities of a leg that can be limited.
pub struct Takes {
    /// A driven angle; else a driven length.
    pub angle: bool,
    /// A driven length that is never negative.
    pub positive: bool,
    /// An angle between a crank and a rod.
    pub elbow: bool,
    /// A rod, or itself, that has a direction.
    pub rod: bool,
    /// Whether its links are arcs round the centre about which the platform turns.
    pub on_sphere: bool,
}

/// Returns the quantities that can be limited on a leg of this kind.
pub fn takes(actuator: &Actuator) -> Takes {
    let nothing = Takes { angle: false, positive: false, elbow: false, rod: false, on_sphere: false };
    match actuator {
        Actuator::Revolute(_) => Takes { angle: true, elbow: true, rod: true, ..nothing },
        Actuator::Prismatic(_) => Takes { rod: true, ..nothing },
        Actuator::Strut(_) => Takes { positive: true, rod: true, ..nothing },
        Actuator::Spherical(_) => Takes { angle: true, on_sphere: true, ..nothing },
    }
}

fn is_limit(limit: &Limit, leg: &Leg, space: usize) -> bool {
    let takes = takes(&leg.actuator);
    match limit {
        Limit::ActuatorAngle { middle, half_cos, turns } => {
            takes.angle && is_circular(middle) && sane(half_cos) && turns.abs() <= 2
        }
        Limit::ActuatorLength { min, max } => {
            let least = if takes.positive { 0.0 } else { f64::NEG_INFINITY };
            !takes.angle && sane(min) && sane(max) && min.hi <= max.hi && min.lo >= least
        }
        Limit::Elbow { middle, half_cos } => {
            takes.elbow && space == 2 && is_circular(middle) && sane(half_cos)
        }
        Limit::SpatialElbow { min_cos, max_cos } => {
            takes.elbow && space == 3 && sane(min_cos) && sane(max_cos) && max_cos.hi <= min_cos.hi
        }
        Limit::BaseCone { axis, half_cos } | Limit::PlatformCone { axis, half_cos } => {
            let unit = axis.iter().all(sane) && is_about(dot(axis, axis), 1.0);
            takes.rod && unit && sane(half_cos)
        }
        Limit::Clearance(clearance) => clearance.fits(leg, space),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    /// Why the five-bar, changed, is no robot.
    fn refusal(change: impl FnOnce(&mut Robot)) -> String {
        let mut robot = catalogue::find("five-bar").unwrap();
        change(&mut robot);
        robot.check().unwrap_err().to_string()
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
            assert!(refusal(change).contains("cannot be seen"));
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
                Revolute { crank: Interval { lo: 9.0, hi: 8.0 }, rod: Interval::point(5.0) }.into();
        });
        assert!(said.contains("or an empty range"), "{said}");
    }
}

//! Bodies of the machine itself that keep clear of one another.

use crate::leg_index::as_index;
use crate::num::{Interval, Scalar, TwoLinks, dot};
use crate::sound::is_in_space;
use crate::text::brief;
use crate::{LegIndex, LegSet, MOST_OBSTACLES, Platform, Robot, Shape, Solid, is_one_point, sane};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt;

/// The greatest number of bodies of a robot.
pub const MOST_BODIES: usize = 32;
/// The greatest number of pairs of bodies that are looked at.
pub const MOST_PAIRS: usize = 128;

/// A body: all points at most a radius away from a segment, in the plane as in space (a capsule).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Body {
    /// The driven link of a leg, from A to B.
    Crank(#[serde(with = "as_index")] LegIndex),
    /// The rod of a leg, from B to C, or its strut, from A to C.
    Rod(#[serde(with = "as_index")] LegIndex),
    /// A body of the platform, by its number in the robot file, from 1.
    Platform(usize),
    /// An obstacle with two ends, by its number in the robot file, from 1.
    Obstacle(usize),
}

/// The size of a body.
///
/// # Examples
/// ```
/// use aspecta_robot::{Body, LegIndex, Robot};
///
/// let file = format!("{}\n[bodies]\nradius = 0.5\n", aspecta_robot::catalogue::all()[0].text);
/// let robot = Robot::from_toml(&file, "five-bar.toml")?;
/// let names: Vec<String> = robot.bodies.iter().map(|part| part.body.to_string()).collect();
/// assert_eq!(names, ["crank of leg 1", "rod of leg 1", "crank of leg 2", "rod of leg 2"]);
/// // The rods share a joint, and so do crank and rod of one leg.
/// let pairs: Vec<String> = robot.pairs.iter().map(|pair| pair.to_string()).collect();
/// let expected = [
///     "crank of leg 1 and crank of leg 2",
///     "crank of leg 1 and rod of leg 2",
///     "rod of leg 1 and crank of leg 2",
/// ];
/// assert_eq!(pairs, expected);
/// # Ok::<(), aspecta_robot::FileError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// Which body.
    pub body: Body,
    /// Half its thickness, ≥ 0.
    pub radius: Interval,
    /// Bodies in different layers of a planar machine cannot meet; without one it is in all, as are those in space.
    pub layer: Option<i32>,
    /// Where it is.
    pub shape: Shape,
}

/// Two bodies that keep clear of one another: their axes are farther apart than `distance`. If that is 0, which only bodies in the plane
/// can have, they do not touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyPair {
    /// The bodies.
    pub bodies: [Body; 2],
    /// The least distance of their axes: both radii, and what is to be left besides.
    pub distance: Interval,
}

impl Body {
    /// The leg it is a link of.
    pub fn leg(self) -> Option<LegIndex> {
        match self {
            Self::Crank(leg) | Self::Rod(leg) => Some(leg),
            Self::Platform(_) | Self::Obstacle(_) => None,
        }
    }

    /// The legs of which two bodies are links.
    pub(crate) fn legs(bodies: [Self; 2]) -> LegSet {
        bodies.iter().filter_map(|body| body.leg()).fold(LegSet::NONE, |set, leg| set.and(LegSet::of(leg)))
    }

    /// Whether the motors alone say where it is.
    pub(crate) fn is_driven(self) -> bool {
        match self {
            Self::Crank(_) | Self::Obstacle(_) => true,
            Self::Rod(_) | Self::Platform(_) => false,
        }
    }

    /// Whether a robot's leg has such a link, if it is one.
    fn is_of(self, robot: &Robot) -> bool {
        let facts = |leg: LegIndex| robot.legs.get(leg.index()).map(|leg| leg.actuator.kind().facts());
        match self {
            Self::Crank(leg) => facts(leg).is_some_and(|facts| facts.has_elbow),
            Self::Rod(leg) => facts(leg).is_some_and(|facts| facts.has_rod),
            Self::Platform(number) | Self::Obstacle(number) => {
                number > 0 && robot.platform != Platform::TurningBody
            }
        }
    }
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crank(leg) => write!(f, "crank of leg {leg}"),
            Self::Rod(leg) => write!(f, "rod of leg {leg}"),
            Self::Platform(number) => write!(f, "body {number} of the platform"),
            Self::Obstacle(number) => write!(f, "obstacle {number}"),
        }
    }
}

/// For results: the names of both.
pub(crate) fn names<S: Serializer>(bodies: &[Body; 2], serializer: S) -> Result<S::Ok, S::Error> {
    bodies.map(|body| body.to_string()).serialize(serializer)
}

impl fmt::Display for BodyPair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.bodies;
        write!(f, "{first} and {second}")
    }
}

impl Capsule {
    /// In words: `crank of leg 1, radius 0.5000 cm, layer 2`.
    pub fn in_words(&self, unit: &str) -> String {
        let layer = self.layer.filter(|layer| *layer != 0);
        let layer = layer.map_or(String::new(), |layer| format!(", layer {layer}"));
        match self.radius.hi {
            _ if matches!(self.shape, Shape::Wall { .. }) => format!("{}, a wall{layer}", self.body),
            0.0 => format!("{}, thin{layer}", self.body),
            _ => format!("{}, radius {} {unit}{layer}", self.body, brief(self.radius.mid())),
        }
    }

    /// Whether a point of the base, or of the platform, may be as near to the axis as `distance`.
    pub(crate) fn is_near(&self, point: &[Interval; 3], distance: Interval) -> bool {
        let [from, to] = match self.shape {
            Shape::Axis(ends) => ends,
            Shape::Wall { normal, offset } => {
                return !(dot(&normal, point) - offset - distance).is_positive();
            }
            Shape::Link => return false,
        };
        let links = TwoLinks {
            gap: std::array::from_fn(|k| point[k] - from[k]),
            first: [Interval::point(0.0); 3],
            second: std::array::from_fn(|k| to[k] - from[k]),
        };
        !(Interval::least_square(&links) - distance.square()).is_positive()
    }

    /// Whether it is in this layer.
    pub(crate) fn is_in(&self, layer: Option<i32>) -> bool {
        self.layer.zip(layer).is_none_or(|(one, another)| one == another)
    }

    /// Whether what reaches so far from a point of the base may come to it: anything may be met by a body that moves.
    fn may_be_met_from(&self, point: &[Interval; 3], reach: Interval) -> bool {
        !matches!(self.body, Body::Obstacle(_)) || self.is_near(point, reach)
    }
}

impl BodyPair {
    /// Whether it is the axes themselves that must not meet.
    pub fn is_thin(&self) -> bool {
        self.distance.hi == 0.0
    }

    /// Whether it can be one of a robot's.
    fn fits(&self, robot: &Robot) -> bool {
        let [first, second] = self.bodies;
        let is_clear = self.distance.lo > 0.0 || self.is_thin() && robot.platform.space() == 2;
        let are_long = !self.is_thin()
            || robot.wall_of(self).is_none() && self.bodies.iter().all(|body| !robot.is_point(*body));
        let of_one_leg = first.leg().is_some() && first.leg() == second.leg();
        let is_known =
            |body: &Body| body.is_of(robot) && (body.leg().is_some() || robot.capsule(*body).is_some());
        let are_known = self.bodies.iter().all(is_known);
        first != second && !of_one_leg && are_known && sane(&self.distance) && is_clear && are_long
    }
}

impl Robot {
    /// The pairs of bodies that are kept apart, in words.
    pub fn kept_apart(&self) -> String {
        let pairs: Vec<String> = self.pairs.iter().map(ToString::to_string).collect();
        if pairs.is_empty() { "no two of them can meet".into() } else { pairs.join("; ") }
    }

    /// The size of a body.
    pub fn capsule(&self, body: Body) -> Option<&Capsule> {
        self.bodies.iter().find(|capsule| capsule.body == body)
    }

    /// Whether the axis of a body has no length: a disc or a ball.
    pub fn is_point(&self, body: Body) -> bool {
        self.capsule(body).and_then(|capsule| capsule.shape.ends()).is_some_and(|[from, to]| from == to)
    }

    /// Which of two bodies is a wall, the unit vector out of it and its offset.
    pub fn wall_of(&self, pair: &BodyPair) -> Option<(usize, [Interval; 3], Interval)> {
        pair.bodies.iter().enumerate().find_map(|(slot, body)| match self.capsule(*body)?.shape {
            Shape::Wall { normal, offset } => Some((slot, normal, offset)),
            Shape::Link | Shape::Axis(_) => None,
        })
    }

    /// Whether the bodies and their pairs make sense.
    pub(crate) fn are_bodies_sound(&self) -> bool {
        let is_sound = |capsule: &Capsule| {
            let fits = |end: &[Interval; 3]| end.iter().all(sane) && is_in_space(end, self.platform.space());
            let is_placed = match (capsule.body, &capsule.shape) {
                (Body::Crank(_) | Body::Rod(_), Shape::Link) => true,
                (Body::Platform(_) | Body::Obstacle(_), Shape::Axis(ends)) => ends.iter().all(fits),
                (Body::Obstacle(_), Shape::Wall { normal, offset }) => {
                    let wall = Solid::Wall { normal: *normal, offset: *offset };
                    wall.is_sound(self.platform.space()) && capsule.radius == Interval::point(0.0)
                }
                (Body::Crank(_) | Body::Rod(_), Shape::Axis(_) | Shape::Wall { .. })
                | (Body::Platform(_), Shape::Link | Shape::Wall { .. })
                | (Body::Obstacle(_), Shape::Link) => false,
            };
            let is_numbered = match capsule.body {
                Body::Obstacle(number) => number <= MOST_OBSTACLES,
                Body::Crank(_) | Body::Rod(_) | Body::Platform(_) => true,
            };
            let radius = sane(&capsule.radius) && capsule.radius.lo >= 0.0;
            capsule.body.is_of(self) && is_numbered && is_placed && radius
        };
        let few = self.bodies.len() <= MOST_BODIES && self.pairs.len() <= MOST_PAIRS;
        few && self.bodies.iter().all(is_sound)
            && self.pairs.iter().all(|pair| pair.fits(self))
            && self.are_pairs_complete()
    }

    /// Whether all bodies that can meet are kept apart by their radii at least, and none is there twice. Links and discs, balls or walls beside the robot have limits of the legs instead.
    fn are_pairs_complete(&self) -> bool {
        let zero = Interval::point(0.0);
        let among = |capsule: &Capsule| match capsule.body {
            Body::Obstacle(_) if capsule.as_solid().is_some() => 2,
            Body::Platform(_) => 1,
            Body::Crank(_) | Body::Rod(_) | Body::Obstacle(_) => 0,
        };
        let is_kept = |first: &Capsule, second: &Capsule| {
            let by_limits = [among(first), among(second)];
            let needed = self
                .pair([first, second], zero)
                .filter(|_| first.is_in(second.layer) && by_limits != [0, 2] && by_limits != [2, 0]);
            needed.is_none_or(|needed| {
                let is_it = |pair: &&BodyPair| {
                    pair.bodies == needed.bodies || pair.bodies == [needed.bodies[1], needed.bodies[0]]
                };
                self.pairs.iter().find(is_it).is_some_and(|pair| pair.distance.hi >= needed.distance.lo)
            })
        };
        let others = |i: usize| &self.bodies[i + 1..];
        self.bodies.iter().enumerate().all(|(i, first)| {
            others(i).iter().all(|second| first.body != second.body && is_kept(first, second))
        })
    }

    /// The pairs of its bodies that can meet and are to be kept `clearance` apart: those of one layer that share no joint.
    pub(crate) fn pairs_to_keep_apart(&self, clearance: Interval) -> Vec<BodyPair> {
        let of = |(i, first): (usize, &Capsule)| {
            let (first, others) = (*first, &self.bodies[i + 1..]);
            let others = others.iter().filter(move |second| first.is_in(second.layer));
            others.filter_map(move |second| self.pair([&first, second], clearance)).collect::<Vec<_>>()
        };
        self.bodies.iter().enumerate().flat_map(of).collect()
    }

    /// Two bodies as a pair, unless they share a joint or are too short to meet.
    pub(crate) fn pair(&self, both: [&Capsule; 2], clearance: Interval) -> Option<BodyPair> {
        let sizes = [both[0].radius, both[1].radius, clearance];
        // Zeros are exact, but not what is rounded outward.
        let thin = sizes.iter().all(|size| size.hi == 0.0);
        let distance = if thin { Interval::point(0.0) } else { sizes[0] + sizes[1] + sizes[2] };
        let can_meet = !self.share_a_joint(both) && !self.are_out_of_reach(both, distance);
        can_meet.then_some(BodyPair { bodies: both.map(|capsule| capsule.body), distance })
    }

    /// Whether two bodies are joined, so that they always touch.
    fn share_a_joint(&self, both: [&Capsule; 2]) -> bool {
        use Body::{Crank, Obstacle, Platform, Rod};
        let stands = |j: LegIndex| self.leg(j).actuator.kind().facts().is_positive;
        let one_anchor = |i: LegIndex, j: LegIndex| is_one_point(&self.leg(i).anchor, &self.leg(j).anchor);
        match both.map(|capsule| capsule.body) {
            [Platform(_), Platform(_)] | [Obstacle(_), Obstacle(_)] => true,
            [Crank(i), Crank(j)] => one_anchor(i, j),
            [Crank(i), Rod(j)] | [Rod(j), Crank(i)] => i == j || stands(j) && one_anchor(i, j),
            [Rod(i), Rod(j)] => {
                let one_end = is_one_point(&self.leg(i).attachment, &self.leg(j).attachment);
                one_end || stands(i) && stands(j) && one_anchor(i, j)
            }
            [Rod(leg), Platform(_)] => self.is_jointed(leg, both[1]),
            [Platform(_), Rod(leg)] => self.is_jointed(leg, both[0]),
            [Crank(_) | Rod(_) | Platform(_), Obstacle(_)]
            | [Obstacle(_), Crank(_) | Rod(_) | Platform(_)]
            | [Crank(_), Platform(_)]
            | [Platform(_), Crank(_)] => false,
        }
    }

    /// Two bodies that touch in every configuration: two joints of the base, or of the platform, are too close.
    pub(crate) fn always_touch(&self, pair: &BodyPair) -> bool {
        use Body::{Crank, Obstacle, Platform, Rod};
        let stands = |j: LegIndex| self.leg(j).actuator.kind().facts().is_positive;
        let near = |a: &[Interval; 3], b: &[Interval; 3]| {
            let away: [Interval; 3] = std::array::from_fn(|k| a[k] - b[k]);
            !(dot(&away, &away) - pair.distance.square()).is_positive()
        };
        let anchors = |i: LegIndex, j: LegIndex| near(&self.leg(i).anchor, &self.leg(j).anchor);
        let is_near = |point: &[Interval; 3], body: Body| {
            self.capsule(body).is_some_and(|capsule| capsule.is_near(point, pair.distance))
        };
        let stands_at = |leg: LegIndex, obstacle: Body| is_near(&self.leg(leg).anchor, obstacle);
        match pair.bodies {
            [Crank(i), Crank(j)] => anchors(i, j),
            [Crank(i), Rod(j)] | [Rod(j), Crank(i)] => stands(j) && anchors(i, j),
            [Rod(i), Rod(j)] => {
                let ends = near(&self.leg(i).attachment, &self.leg(j).attachment);
                ends || stands(i) && stands(j) && anchors(i, j)
            }
            [Crank(i), obstacle @ Obstacle(_)] | [obstacle @ Obstacle(_), Crank(i)] => stands_at(i, obstacle),
            [Rod(i), obstacle @ Obstacle(_)] | [obstacle @ Obstacle(_), Rod(i)] => {
                stands(i) && stands_at(i, obstacle)
            }
            [Rod(i), plate @ Platform(_)] | [plate @ Platform(_), Rod(i)] => {
                is_near(&self.leg(i).attachment, plate)
            }
            [Crank(_) | Obstacle(_), Platform(_)]
            | [Platform(_), Crank(_) | Platform(_) | Obstacle(_)]
            | [Obstacle(_), Obstacle(_)] => false,
        }
    }

    /// Whether two bodies are too short to come as near as `distance`.
    fn are_out_of_reach(&self, both: [&Capsule; 2], distance: Interval) -> bool {
        let reaches = both.map(|capsule| self.reach_of(capsule.body));
        match reaches {
            [Some((a, reach)), Some((b, other))] => {
                let away: [Interval; 3] = std::array::from_fn(|k| a[k] - b[k]);
                (dot(&away, &away).sqrt() - reach - other - distance).is_positive()
            }
            [Some((anchor, reach)), None] => !both[1].may_be_met_from(&anchor, reach + distance),
            [None, Some((anchor, reach))] => !both[0].may_be_met_from(&anchor, reach + distance),
            [None, None] => false,
        }
    }

    /// Whether the joint of a leg lies in a body of the platform, so that the rod always touches it.
    fn is_jointed(&self, leg: LegIndex, capsule: &Capsule) -> bool {
        capsule.is_near(&self.leg(leg).attachment, capsule.radius)
    }

    /// The anchor that a link hangs on, and how far it reaches from there at most, if that is known.
    fn reach_of(&self, body: Body) -> Option<([Interval; 3], Interval)> {
        let leg = self.leg(body.leg()?);
        let links = leg.actuator.as_revolute();
        let reach = match body {
            Body::Crank(_) => links?.crank,
            Body::Rod(_) | Body::Platform(_) | Body::Obstacle(_) => match links {
                Some(links) => links.crank + links.rod,
                None if leg.actuator.kind().facts().is_positive => leg.length_range()?.1,
                None => return None,
            },
        };
        Some((leg.anchor, reach))
    }
}

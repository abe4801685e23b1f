//! Paths of joint vectors: the solution is followed from stretch to stretch, and what it meets is enclosed.

use super::clearance::{Measures, Place, Stretch, clearance, modulus};
use super::profile::{self, ProfilePoint};
use super::{Asked, Bound, EFFORT, Joined, Obstacle, PathCheck, PathError, PathOptions, join};
use crate::Kinematics;
use crate::constraints::{Constraint, is_limited};
use crate::follow::{BadInput, Follower, Refusal, Survey};
use crate::path::curve::Curve;
use aspecta_robot::num::Interval;
use aspecta_robot::{LegIndex, Robot};

/// Stretches of t shorter than this are not bisected further.
const SHORTEST: f64 = 1e-9;

/// Checks the path of joint vectors through `joints`, from the direct solution on that `start` means, at least roughly. If there is only one, it may be
/// left out.
///
/// The theorem of [`follow`](crate::follow) proves, stretch by stretch, that the solution goes on, is alone near where it is, and meets no
/// parallel singularity; a spline stays within a proved distance of its chords. Enclosures over the same tubes ([`Follower::survey`]) prove
/// that no B_jj vanishes, that limits are respected and margins kept. The pose path goes on through serial singularities, which
/// do not stop a robot that is driven by its joints: it ends where the proof does, at a parallel singularity.
///
/// # Errors
/// [`PathError`] if the joint vectors do not fit the robot, or if it is not known where the path starts.
///
/// # Examples
/// ```
/// use aspecta_kinematics::Kinematics;
/// use aspecta_kinematics::path::{PathOptions, check_joints};
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let start = [4.0, 7.0];
/// let q = robot.inverse(&start).unwrap()[0].q.clone();
/// let path = [q.clone(), vec![q[0] + 0.1, q[1] - 0.1]];
/// let check = check_joints(&robot, &path, Some(&start), &PathOptions::default())?;
/// assert!(check.is_sound());
/// assert!(check_joints(&robot, &path, None, &PathOptions::default()).is_err()); // two poses fit q
/// # Ok::<(), aspecta_kinematics::path::PathError>(())
/// ```
pub fn check_joints(
    robot: &Robot,
    joints: &[Vec<f64>],
    start: Option<&[f64]>,
    options: &PathOptions,
) -> Result<PathCheck, PathError> {
    options.check()?;
    if options.joined == Joined::None {
        return Err(PathError::Unjoined);
    }
    if joints.len() < 2 {
        return Err(PathError::TooShort { wanted: "two joint vectors", found: joints.len() });
    }
    for (k, q) in joints.iter().enumerate() {
        crate::check_joints(robot, q).map_err(|error| PathError::Sample { row: k + 1, error })?;
    }
    let curves = join::join(joints, &units(robot), options.joined);
    let mut walk = Walk::new(begin(robot, &joints[0], start)?, &curves, options)?;
    let (mode, from) = (walk.follower.mode(), walk.follower.pose().to_vec());
    let arrived = walk.run();
    let to = arrived.then(|| walk.follower.pose().to_vec());
    let found = walk.verdicts.map(|v| v.failed.or(v.doubt));
    Ok(PathCheck {
        samples: joints.len(),
        of_joints: true,
        clearance: clearance(&walk.stretches, robot.dof()),
        ends: [joints.first().cloned(), joints.last().cloned()],
        end_poses: [Some(from), to],
        profile: profile::normalised(walk.points),
        ..PathCheck::new(robot, mode, options, found)
    })
}

/// Returns the units in which joint coordinates are of order one.
fn units(robot: &Robot) -> Vec<f64> {
    let length = robot.characteristic_length();
    robot.legs.iter().map(|leg| if leg.actuator.is_angle() { 1.0 } else { length }).collect()
}

/// At the direct solution meant.
fn begin(robot: &Robot, q: &[f64], start: Option<&[f64]>) -> Result<Follower, PathError> {
    if let Some(pose) = start {
        return Follower::new(robot, pose, q).map_err(PathError::Start);
    }
    let found = robot.direct_certified(q).map_err(|error| PathError::Sample { row: 1, error })?;
    match &found.solutions[..] {
        [] => Err(PathError::NoSolution),
        [only] if found.complete => Follower::new(robot, &only.pose, q).map_err(PathError::Start),
        several => {
            let line = |s: &crate::Solution| {
                let pose = s.pose.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(",");
                format!("  mode {}, pose {pose}", s.mode)
            };
            let list = several.iter().map(line).collect::<Vec<_>>().join("\n");
            Err(PathError::WhichSolution { count: several.len(), list })
        }
    }
}

/// A curve of joint vectors.
#[derive(Clone, Copy)]
struct Joints<'a> {
    curve: &'a Curve,
    dof: usize,
}

impl Joints<'_> {
    fn at(&self, t: f64) -> Vec<f64> {
        self.curve.at(t)[..self.dof].to_vec()
    }

    /// Returns how far joint vectors may be from the straight segment between the doubles at both ends, at
    /// the same share of the way: rounding there, and h²/8 times the second derivative.
    fn deviation(&self, from: f64, to: f64) -> Vec<f64> {
        let bend = self.curve.bend(Interval::new(from, to));
        let rounded = |t: f64, k: usize| {
            let exact = self.curve.over::<6>(Interval::point(t))[k].range;
            (exact - Interval::point(self.curve.at(t)[k])).magnitude()
        };
        let h = Interval::point(to) - Interval::point(from);
        let deviation = |k| (h * h * Interval::point(0.125) * Interval::point(bend[k])).hi;
        (0..self.dof).map(|k| 1.001 * (deviation(k) + rounded(from, k).max(rounded(to, k)))).collect()
    }

    /// Follows it, from `follower` at `from`.
    fn follow(&self, follower: &mut Follower, from: f64, to: f64) -> Result<Survey, Refusal> {
        follower.survey(&self.at(to), &self.deviation(from, to))
    }
}

/// The verdict so far on one demand.
#[derive(Default)]
struct Verdict {
    /// The place where it is proved to fail, or cannot be told because the path ends.
    failed: Option<Obstacle>,
    /// The place where it was first in doubt.
    doubt: Option<Obstacle>,
}

/// Along the path, from stretch to stretch.
struct Walk<'a> {
    follower: Follower,
    curves: &'a [Curve],
    options: &'a PathOptions,
    /// The sign of det A, and those of the B_jj at the start.
    sign: f64,
    signs: Vec<f64>,
    verdicts: [Verdict; 3],
    asked: [(Asked, bool); 3],
    /// All up to the first singularity.
    stretches: Vec<JointStretch<'a>>,
    points: Vec<ProfilePoint>,
}

impl<'a> Walk<'a> {
    fn new(follower: Follower, curves: &'a [Curve], options: &'a PathOptions) -> Result<Self, PathError> {
        let q = follower.q().to_vec();
        let here = follower.clone().survey(&q, &[]).map_err(|_| PathError::StartSingular)?;
        let signs: Vec<_> = here.serial.iter().map(|b| f64::from(b.sign())).collect();
        let sign = f64::from(here.det_a.sign());
        if sign == 0.0 || signs.contains(&0.0) {
            return Err(PathError::StartSingular);
        }
        let limited = is_limited(follower.robot()) || !here.window.is_empty();
        let asked =
            [(Asked::Regular, true), (Asked::Margin, options.margins.are_any()), (Asked::Limit, limited)];
        let verdicts = Default::default();
        let (stretches, points) = (Vec::new(), Vec::new());
        Ok(Self { follower, curves, options, sign, signs, verdicts, asked, stretches, points })
    }

    /// Whether the end was reached.
    fn run(&mut self) -> bool {
        let parts = profile::parts(self.curves.len());
        for (k, curve) in self.curves.iter().enumerate() {
            let joints = Joints { curve, dof: self.follower.robot().dof() };
            self.mark(k, 0.0);
            let mut effort = EFFORT / 10;
            for i in 0..parts {
                let [from, to] = [i, i + 1].map(|i| i as f64 / parts as f64);
                if !self.part(k, joints, [from, to], &mut effort) {
                    return false;
                }
                self.mark(k, to);
            }
        }
        true
    }

    /// Adds a sample of the profile.
    fn mark(&mut self, k: usize, t: f64) {
        let f = &self.follower;
        let (pose, q) = (f.pose().to_vec(), f.q().to_vec());
        self.points.extend(ProfilePoint::new(f.robot(), (k + 1, t), pose, q, f.mode()));
    }

    /// Follows part of segment `k`, bisecting what is not proved. Whether its end was reached.
    fn part(&mut self, k: usize, joints: Joints<'a>, part: [f64; 2], effort: &mut usize) -> bool {
        let mut open = vec![part];
        while let Some([from, to]) = open.pop() {
            let shortest = to - from < SHORTEST || *effort == 0;
            *effort = effort.saturating_sub(1);
            let mut next = self.follower.clone();
            let survey = joints.follow(&mut next, from, to);
            let undecided = match &survey {
                Ok(survey) => self.is_undecided(survey),
                Err(_) => true,
            };
            if undecided && !shortest {
                let middle = 0.5 * (from + to);
                open.extend([[middle, to], [from, middle]]);
                continue;
            }
            match survey {
                Ok(survey) => self.judge(k, [from, to], &survey),
                Err(refusal) => {
                    self.give_up(k, [from, to], &refusal);
                    return false;
                }
            }
            if self.verdicts[0].failed.is_none() && self.verdicts[0].doubt.is_none() {
                let follower = self.follower.clone();
                self.stretches.push(JointStretch { follower, joints, segment: k + 1, from, to });
            }
            self.follower = next;
        }
        true
    }

    /// Returns the functions that are > 0 where the demand on a stretch is met.
    fn demands(&self, asked: Asked, survey: &Survey) -> Vec<(Bound, Interval)> {
        let margins = if asked == Asked::Margin { self.options.margins } else { Default::default() };
        if asked == Asked::Limit {
            let coordinates = self.follower.robot().platform.coordinates();
            let window = |&(k, x): &(usize, Interval)| (Bound::Window { coordinate: coordinates[k].name }, x);
            let limits = survey.limits.iter().map(|&(constraint, x)| (Bound::Constraint(constraint), x));
            return limits.chain(survey.window.iter().map(window)).collect();
        }
        let signed =
            |x: Interval, sign: f64, margin: f64| x * Interval::point(sign) - Interval::point(margin);
        let reach = |j| Bound::Constraint(Constraint::Reach(LegIndex::new(j)));
        let legs = survey.serial.iter().zip(&self.signs).enumerate();
        let mut all: Vec<_> =
            legs.map(|(j, (b, sign))| (reach(j), signed(*b, *sign, margins.serial))).collect();
        // That det A does not vanish is proved already.
        if margins.parallel > 0.0 {
            all.push((
                Bound::Constraint(Constraint::Det),
                signed(survey.parallel, self.sign, margins.parallel),
            ));
        }
        all
    }

    /// Returns the demands that are not known to fail.
    fn pending(&self) -> Vec<(usize, Asked)> {
        let asked = self.asked.iter().enumerate();
        let left = asked.filter(|(k, (_, is))| *is && self.verdicts[*k].failed.is_none());
        left.map(|(k, (asked, _))| (k, *asked)).collect()
    }

    fn is_undecided(&self, survey: &Survey) -> bool {
        self.pending().into_iter().any(|(_, asked)| {
            let demands = self.demands(asked, survey);
            demands.iter().any(|(_, x)| x.sign() == 0) && !demands.iter().any(|(_, x)| x.is_negative())
        })
    }

    fn judge(&mut self, k: usize, [from, to]: [f64; 2], survey: &Survey) {
        for (i, asked) in self.pending() {
            let demands = self.demands(asked, survey);
            let failed = demands.iter().find(|(_, x)| x.is_negative());
            let Some((bound, x)) = failed.or_else(|| demands.iter().find(|(_, x)| x.sign() == 0)) else {
                continue;
            };
            let (segment, pose) = (k + 1, self.follower.pose().to_vec());
            let (t, bound, proved) = ((from, to), *bound, x.is_negative());
            let here = Obstacle { asked, segment, t, pose, bound, proved };
            let verdict = &mut self.verdicts[i];
            match &verdict.doubt {
                // It may begin at the doubt before it.
                Some(doubt) if here.proved && doubt.segment == segment => {
                    let (t, pose) = ((doubt.t.0, to), doubt.pose.clone());
                    verdict.failed = Some(Obstacle { t, pose, ..here });
                }
                _ if here.proved => verdict.failed = Some(here),
                doubt => verdict.doubt = doubt.clone().or(Some(here)),
            }
        }
    }

    /// The path ends: a parallel singularity is not excluded.
    fn give_up(&mut self, k: usize, [from, to]: [f64; 2], refusal: &Refusal) {
        let (constraint, end) = match *refusal {
            Refusal::Input(BadInput::StrutLength { leg, .. }) => (Constraint::Reach(leg), to),
            Refusal::Parallel { singular_at, .. } => (Constraint::Det, from + singular_at * (to - from)),
            Refusal::Input(_) | Refusal::Serial { .. } | Refusal::TooLong { .. } => (Constraint::Det, to),
        };
        let pose = self.follower.pose().to_vec();
        for (i, asked) in self.pending() {
            let t = (from, end.clamp(to, 1.0));
            let (pose, bound) = (pose.clone(), Bound::Constraint(constraint));
            let here = Obstacle { asked, segment: k + 1, t, pose, bound, proved: false };
            self.verdicts[i].doubt.get_or_insert(here);
        }
    }
}

/// Part of a path of joint vectors, with the solution at its start.
#[derive(Clone)]
struct JointStretch<'a> {
    follower: Follower,
    joints: Joints<'a>,
    segment: usize,
    from: f64,
    to: f64,
}

impl JointStretch<'_> {
    /// The solution at `to`, and what is met on the way.
    fn gone(&self, to: f64) -> Option<(Follower, Survey)> {
        let mut follower = self.follower.clone();
        let survey = self.joints.follow(&mut follower, self.from, to).ok()?;
        Some((follower, survey))
    }
}

/// The enclosures where the solution is not proved: anything.
const NOTHING: Measures = [Interval { lo: 0.0, hi: f64::INFINITY }; 8];

fn measures(survey: &Survey) -> Measures {
    let mut all = [Interval::point(0.0); 8];
    let known = [survey.det_a, survey.parallel];
    all.iter_mut().zip(known.iter().chain(&survey.serial)).for_each(|(to, x)| *to = modulus(*x));
    all
}

impl Stretch for JointStretch<'_> {
    fn over(&self) -> Measures {
        self.gone(self.to).map_or(NOTHING, |(_, survey)| measures(&survey))
    }

    fn ends(&self) -> [(Place, Measures); 2] {
        [self.from, self.to].map(|t| {
            let there = self.gone(t).map_or_else(|| self.follower.clone(), |(follower, _)| follower);
            let pose = there.pose().to_vec();
            let here = Self { follower: there, from: t, to: t, ..self.clone() };
            (Place { segment: self.segment, t, pose }, here.over())
        })
    }

    fn halves(&self) -> Option<[Self; 2]> {
        let middle = 0.5 * (self.from + self.to);
        let (follower, _) = self.gone(middle)?;
        let divides = self.from < middle && middle < self.to;
        divides
            .then(|| [Self { to: middle, ..self.clone() }, Self { follower, from: middle, ..self.clone() }])
    }
}

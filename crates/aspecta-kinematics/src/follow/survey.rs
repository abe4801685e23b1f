//! Enclosures of reach, limits and det A over the tube of a stretch that is proved.

use super::direct::{Follower, check_joints};
use super::on_the_way::OnTheWay;
use super::tube::{Model, Stretch};
use super::{Refusal, unpadded};
use crate::constraints::{Configuration, Constraint, window_margins};
use crate::homogeneous::Homogeneous;
use crate::modal::{Folded, LegClosure};
use crate::placement::{determinant, wrench};
use crate::{WorkingMode, for_platform};
use aspecta_robot::legs::Closure;
use aspecta_robot::num::{Ball, Interval, Scalar, Slope, padded};

/// Enclosures of what the robot meets on one certified stretch of joint vectors: they hold the values at
/// every configuration of the solution curve. Whatever `det_a` may hold, det A does not vanish: that is what
/// the stretch is certified for.
#[derive(Clone, Debug)]
pub struct Survey {
    /// det A.
    pub det_a: Interval,
    /// det Â, as [`Margins`](crate::constraints::Margins) defines it.
    pub parallel: Interval,
    /// B_jj / max |B_jj|, with its sign; −1 for struts.
    pub serial: Vec<Interval>,
    /// The limits and what is > 0 strictly within each.
    pub limits: Vec<(Constraint, Interval)>,
    /// The coordinates that the user's window cuts, and what is > 0 strictly within each.
    pub window: Vec<(usize, Interval)>,
    /// The working mode at the end. Proved if no enclosure of `serial` holds 0, else numerical.
    pub mode: WorkingMode,
}

type Over = Slope<Ball, 1>;

impl Follower {
    /// Goes on to the joint vector `q` in one piece, as [`Follower::step`] does in several, and encloses what
    /// is met on the way. What is proved holds for every path of joint vectors that stays within `deviation`
    /// (per joint) of the straight segment, at the same share of the way.
    ///
    /// # Errors
    /// [`Refusal`]; the state is then as before, and a shorter piece may do.
    pub fn survey(&mut self, q: &[f64], deviation: &[f64]) -> Result<Survey, Refusal> {
        check_joints(self.robot(), q)?;
        for_platform!(self.robot().platform, advance(self, q, deviation))
    }
}

fn advance<const D: usize, const N: usize>(
    follower: &mut Follower,
    q: &[f64],
    deviation: &[f64],
) -> Result<Survey, Refusal> {
    let (model, start) = follower.model_and_state::<D, N>();
    let goal = unpadded::<N>(&padded(q));
    let deviation = unpadded::<N>(&padded(deviation));
    let slack: [f64; N] =
        std::array::from_fn(|j| deviation[j] + 4.0 * f64::EPSILON * start.q[j].abs().max(goal[j].abs()));
    let proved = model.prove_and_look(&start, &goal, &slack, |stretch| model.survey(stretch));
    let Some((proof, mut survey)) = proved else {
        return Err(model.refusal(&start, &start.q, &goal, 0.0));
    };
    survey.mode = model.mode(&proof);
    follower.set_state(&proof.end, survey.mode);
    Ok(survey)
}

impl<const D: usize, const N: usize> Model<'_, D, N> {
    fn survey(&self, stretch: &Stretch<'_, D, N>) -> Survey {
        let robot = self.robot;
        let (placement, _) = self.placements::<Over>(stretch);
        let mut rows = [[Over::zero(); N]; N];
        let homogeneous = Homogeneous::of(robot);
        let mut unit = Over::constant(homogeneous.unit_of_moments());
        let mut serial = Vec::with_capacity(N);
        let zero = [Over::zero(); D];
        let open = Closure { reach: Over::zero(), weight: Over::zero(), fixed: zero, swing: zero };
        let mut legs = [LegClosure { arm: zero, span: zero, closure: open, fold: None }; N];
        let mut heights = [[Over::zero(); 2]; N];
        for (j, leg) in robot.legs.iter().enumerate().take(N) {
            let over = stretch.leg(leg, j, &placement);
            rows[j] = wrench(robot.platform, &over.gradient, &over.arm);
            unit = unit * homogeneous.norm(leg.actuator.force(&over.gradient), &rows[j]);
            let sh = leg.actuator.signed_height(over.slope);
            serial.push(match leg.actuator.greatest_reach() {
                Some(most) => range(sh) / most.sqrt(),
                None => Interval::point(-1.0),
            });
            let closure = leg.actuator.eliminate(&over.span);
            let fold = over.turn.map(|(sin, cos)| Folded { cos, sin, b: over.slope });
            legs[j] = LegClosure { arm: over.arm, span: over.span, closure, fold };
            heights[j] = [sh; 2];
        }
        // Whatever the postures are: each s h is the one that the stretch has.
        let mode = WorkingMode::from_signs([]);
        let at = Configuration { robot, placement: &placement, legs: &legs, heights: &heights, mode };
        let limits = at.limits().map(|(constraint, margin)| (constraint, range(margin))).collect();
        let window = window_margins(robot, &placement).into_iter().map(|(k, x)| (k, range(x))).collect();
        let det: Over = determinant(&rows);
        Survey { det_a: range(det), parallel: range(det / unit), serial, limits, window, mode }
    }
}

fn range(x: Over) -> Interval {
    x.range().into()
}

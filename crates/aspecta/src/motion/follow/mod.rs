//! Following one solution in a control loop: which pose belongs to the next joint vector, proved to be on the same
//! branch; and which joint vector to the next pose, in the same working mode.
//!
//! [`Follower`] solves the direct problem, [`InverseFollower`] the inverse one. Both take one step at a time, do not
//! allocate, do not panic and do a bounded amount of work. What they return is proved; where they cannot prove
//! it they refuse, say why, and stay where they were.
//!
//! # The theorem behind a direct step
//!
//! f(X, q) = 0 are the leg equations, X = X₁ ⊞ z the poses near the new pose X₁, z ∈ Rⁿ coordinates without singularity
//! ([`Placement::displaced`](crate::kinematics::placement::Placement::displaced)). Along the stretch from q₀ to q₁ let
//!
//! > q(t) = q₁ + (1 − t)(q₀ − q₁), c(t) = (1 − t) s, t ∈ [0, 1],
//!
//! s ≈ the z of the old pose. B is a box of z, Q the hull of both joint vectors; \[A\] and \[b\] enclose ∂f/∂z and the diagonal of ∂f/∂q
//! over B × Q; Y is any matrix, ‖·‖ a weighted maximum norm. Let
//!
//! > κ ≥ ‖I − Y\[A\]‖, η ≥ ‖Y (f(X₁, q₁) + \[0, 1\] (\[A\] s + \[b\](q₀ − q₁)) + \[b\] e)‖, e ∋ 0 what rounding moves q(t) by.
//!
//! *Theorem.* Let κ < 1, r = η/(1 − κ), and let B hold the tube ‖z − c(t)‖ ≤ r, t ∈ [0, 1]. Then for every t and every q ∈ q(t) + e
//! the equations f(·, q) = 0 have exactly one solution in B; it lies in the tube, depends continuously on q, and A is regular there and
//! on all of B × Q. At q₁ it lies within ‖Y f(X₁, q₁)‖/(1 − κ) of X₁.
//!
//! *Proof.* By the mean-value theorem, row by row along the line, f(c(t), q) lies in the bracket of η. The map z ↦ z − Y f(z, q) contracts B by κ, and so maps the ball of
//! radius r round c(t) into itself: its one fixed point there is a zero, since Y and all matrices of \[A\] are regular
//! (‖I − YA‖ < 1). Two zeros z, z′ in B would give 0 = f(z) − f(z′) = A′(z − z′) with A′ ∈ \[A\] regular. Continuity is the implicit function
//! theorem; the last bound is that of the contraction, started at z = 0. ∎
//!
//! *The same branch.* If the solution at q₀ lies in B it is that one, so the solution curve that starts there ends at the one at q₁, and meets no parallel
//! singularity. The bound of one step is what the next needs to know of its start. A step that cannot be proved at once is cut into stretches, whose
//! curves fit together: on the common part of two neighbourhoods of q, which is convex, both continuous solutions agree at one point, hence
//! everywhere. Robot constants are intervals, so all this holds for every robot within them.
//!
//! If, besides, no \[b_j\] holds zero, no leg meets a serial singularity: the configuration stays in its generalized aspect.
//!
//! # The inverse step
//!
//! Poses are joined by a straight segment in pose coordinates, as in [`check_path`](super::check_path). If H_j > 0 in intervals on stretches that cover it, the solution of each leg is one continuous
//! function ([`eliminate`](crate::kinematics::leg::eliminate)). If the vector (cos q_j, sin q_j) · weight of a stretch lies in a box that does not hold the origin and is seen from there under an angle below π, then
//! q_j changes by less than π, and the difference of its values at both ends, taken without full turns, is the true one.

mod direct;
mod inverse;
mod nearness;
mod newton;
mod refusal;
mod tube;

pub use direct::{Follower, Step};
pub use inverse::{InverseFollower, JointStep};
pub use refusal::{BadInput, Refusal, StartError};

use crate::robot::Robot;

/// Stretches tried before a step is refused: what bounds the work of a step.
const MOST_STRETCHES: usize = 64;
/// Shorter stretches, as a share of the step, are not tried.
const SHORTEST: f64 = 1.0 / (1 << 20) as f64;

/// Up to six coordinates, of which the first n count.
type Padded = [f64; 6];

fn padded(values: &[f64]) -> Padded {
    let mut all = [0.0; 6];
    all.iter_mut().zip(values).for_each(|(a, v)| *a = *v);
    all
}

fn unpadded<const N: usize>(values: &Padded) -> [f64; N] {
    std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0))
}

/// Whether `values` are n numbers a robot can have.
fn check_numbers(robot: &Robot, values: &[f64]) -> Result<(), BadInput> {
    let wanted = robot.dof();
    if values.len() != wanted {
        return Err(BadInput::Length { wanted, found: values.len() });
    }
    // A comparison that is false for NaN too.
    match values.iter().position(|x| !(x.abs() <= 1e7)) {
        Some(k) => Err(BadInput::Number { index: k + 1, value: values[k] }),
        None => Ok(()),
    }
}

/// Walks the parameter t of a step from 0 to 1 in stretches: `prove(from, to)` says whether a stretch holds. Halves what fails, doubles
/// what succeeds. Returns the t reached; 1 is all of it.
fn in_stretches(mut prove: impl FnMut(f64) -> bool) -> (f64, u32) {
    let (mut reached, mut length) = (0.0, 1.0);
    for tried in 1..=MOST_STRETCHES as u32 {
        let to = if reached + length < 1.0 { reached + length } else { 1.0 };
        if prove(to) {
            reached = to;
            length *= 2.0;
            if reached == 1.0 {
                return (1.0, tried);
            }
        } else {
            length *= 0.5;
            if length < SHORTEST {
                return (reached, tried);
            }
        }
    }
    (reached, MOST_STRETCHES as u32)
}

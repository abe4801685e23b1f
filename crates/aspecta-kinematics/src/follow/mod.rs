//! Following one solution in a control loop: which pose belongs to the next joint vector, proved to be on
//! the same branch; and which joint vector to the next pose, in the same working mode.
//!
//! [`Follower`] solves the direct problem, [`InverseFollower`] the inverse one. Both take one step at a
//! time, do not allocate, do not panic and do a bounded amount of work. What they return is proved; where
//! they cannot prove it they refuse, say why, and stay where they were.
//!
//! # The theorem behind a direct step
//!
//! f(X, q) = 0 are the leg equations, X = X₁ ⊞ z the poses near the new pose X₁, z ∈ Rⁿ coordinates without
//! singularity ([`Placement::displaced`](crate::placement::Placement::displaced)). For a
//! stretch from q₀ to q₁ let
//!
//! > q(t) = q₁ + (1 − t)(q₀ − q₁), c(t) = (1 − t) s, 0 ≤ t ≤ 1,
//!
//! s ≈ the z of the old pose. The tube 𝒯 holds all (z, q) with ‖z − c(t)‖ ≤ ρ and |q − q(t)| ≤ e for some
//! t, e being what rounding may move joint vectors by and ‖·‖ a weighted maximum norm. \[A\] and \[b\]
//! enclose ∂f/∂z and the diagonal of ∂f/∂q over 𝒯, Y is any matrix. Let
//!
//! > κ ≥ ‖I − Y\[A\]‖, η ≥ ‖Y f(c(t), q)‖ for all t and all |q − q(t)| ≤ e.
//!
//! *Theorem.* Let κ < 1 and η ≤ (1 − κ) ρ. Then for every t and every such q the equations f(·, q) = 0 have
//! exactly one solution with ‖z − c(t)‖ ≤ ρ; it depends continuously on q, and A is regular on all of 𝒯. At
//! q₁ it lies within ‖Y f(X₁, q₁)‖/(1 − κ) of X₁.
//!
//! *Proof.* A ball is convex, so N(z) = z − Y f(z, q) differs at two of its points by (I − Y Ā) times their
//! difference, Ā a mean of matrices of \[A\]: N contracts by κ. ‖N(z) − c(t)‖ ≤ κρ + η ≤ ρ, so N maps the
//! ball into itself and has one fixed point there. Y and all matrices of \[A\] are regular since ‖I − YA‖ <
//! 1, so the fixed points are the zeros, and by the implicit function theorem they depend continuously on
//! q. The last bound is that of the contraction at t = 1, from z = 0. ∎
//!
//! η comes from f(X₁, q₁) and the integral of \[A\] s + \[b\](q₀ − q₁) along the line (c, q) from t = 1,
//! plus \[b\] e.
//!
//! *The same branch.* If the solution at q₀ lies in the ball at t = 0 it is the one found there: the
//! solution curve that starts with it stays in the tube, ends at the solution at q₁, and meets no parallel
//! singularity. The bound at q₁ is what the next stretch has to hold in its first ball. A step is cut into
//! stretches where need be. Their q are doubles next to the straight segment, but e covers it, and the
//! curves fit together: the joint vectors that two stretches share are the common part of two convex sets,
//! hence connected, and two continuous solutions that agree at one of them, both locally unique, agree at
//! all. Robot constants are enclosed, so all this holds for every robot within them.
//!
//! If, besides, no \[b_j\] holds zero, no leg meets a serial singularity: the configuration stays in its
//! generalized aspect, limits apart.
//!
//! # The inverse step
//!
//! Poses are joined by a straight segment in pose coordinates, as in [`check_path`](crate::path::check_path). If
//! H_j > 0 in intervals on stretches that cover it, the solution of each leg is one continuous function
//! ([`eliminate`](aspecta_robot::legs::Actuator::eliminate)). If the vector (cos q_j, sin q_j) · weight of a
//! stretch lies in a box that does not hold the origin and is seen from there under an angle below π, then
//! q_j changes by less than π, and the difference of its values at both ends, taken without full turns, is
//! the true one.

mod direct;
mod inverse;
mod nearness;
mod newton;
mod on_the_way;
mod refusal;
mod survey;
mod tube;

pub use direct::{Follower, Step};
pub use inverse::{InverseFollower, JointStep};
pub use refusal::{BadInput, Refusal, StartError};
pub use survey::Survey;

use aspecta_robot::Robot;
use aspecta_robot::num::padded;

/// Stretches tried before a step is refused: what bounds the work of a step.
const MOST_STRETCHES: u32 = 64;
/// Shorter stretches, as a share of the step, are not tried.
const SHORTEST: f64 = 1.0 / (1 << 20) as f64;

/// Up to six coordinates, of which the first n count.
type Padded = [f64; 6];

fn unpadded<const N: usize>(values: &Padded) -> [f64; N] {
    padded(values)
}

/// a + t (b − a), exactly b at t = 1.
fn between<const N: usize>(a: &[f64; N], b: &[f64; N], t: f64) -> [f64; N] {
    if t == 1.0 { *b } else { std::array::from_fn(|k| a[k] + t * (b[k] - a[k])) }
}

/// Whether `values` are n numbers a robot can have.
fn check_numbers(robot: &Robot, values: &[f64]) -> Result<(), BadInput> {
    let wanted = robot.dof();
    if values.len() != wanted {
        return Err(BadInput::Length { wanted, found: values.len() });
    }
    match values.iter().position(|x| x.is_nan() || x.abs() > 1e7) {
        Some(k) => Err(BadInput::Number { index: k + 1, value: values[k] }),
        None => Ok(()),
    }
}

/// Walks the parameter t of a step from 0 to 1 in stretches: `prove(from, to)` says whether a stretch holds.
/// Halves what fails, doubles what succeeds. Returns the t reached; 1 is all of it.
fn in_stretches(mut prove: impl FnMut(f64) -> bool) -> (f64, u32) {
    let (mut reached, mut length) = (0.0, 1.0);
    for tried in 1..=MOST_STRETCHES {
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
    (reached, MOST_STRETCHES)
}

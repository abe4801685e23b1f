//! Following another pose of a class while X moves on a slice.

use crate::domain::characteristic::SAME_JOINTS;
use crate::domain::face::Face;
use crate::domain::field::Field;
use crate::domain::grid::Pose;
use crate::domain::sheet::Sheet;
use aspecta_kinematics::constraints::Constraint;
use aspecta_kinematics::for_platform;

/// How often the first step is halved before a solution counts as lost: where it is lost is known to
/// 2^−[`HALVINGS`] of the segment.
const HALVINGS: i32 = 20;
/// A solution followed there and back comes back as near as this, in widths of the window.
const BACK: f64 = 1e-7;
const SINGULAR: Face = Face::Of(Constraint::Det);

/// The loss of a solution on a segment: its place, and the face that is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// The part of the segment until then, in [0, 1].
    pub at: f64,
    /// The boundary of the class that it meets there.
    pub face: Face,
}

/// Follows `other`, a pose of the class with the joint vector of `from`, while X goes straight from `from` to
/// `to`: `None` if it stays in the class.
///
/// *Numerical*: Newton's method, each step of which must converge fast, into the class, and back again.
pub fn loss(sheet: &Sheet<'_>, from: &Pose, to: &Pose, other: &Pose) -> Option<Loss> {
    for_platform!(sheet.robot().platform, lost(sheet, from, to, other))
}

fn lost<const D: usize, const N: usize>(
    sheet: &Sheet<'_>,
    from: &Pose,
    to: &Pose,
    other: &Pose,
) -> Option<Loss> {
    let field = sheet.field::<D, N>(sheet.mode());
    let place = |t: f64| -> [f64; N] { std::array::from_fn(|k| from[k] + t * (to[k] - from[k])) };
    let mut x: [f64; N] = std::array::from_fn(|k| other[k]);
    let (mut t, mut step) = (0.0, 1.0);
    let least = 0.5_f64.powi(HALVINGS);
    while t < 1.0 {
        let next = f64::min(t + step, 1.0);
        let returned = |(there, back): ([f64; N], [f64; N])| {
            if sheet.gap(&x, &back) <= BACK { Ok(there) } else { Err(SINGULAR) }
        };
        match advanced(&field, &x, [&place(t), &place(next)]).and_then(returned) {
            Ok(there) => (x, t, step) = (there, next, 2.0 * step),
            Err(face) if step <= least => return Some(Loss { at: t, face }),
            Err(_) => step *= 0.5,
        }
    }
    None
}

/// The solution x, that of X = `from`, at X = `to`; and from there back at X = `from`.
///
/// # Errors
/// The face that it meets: one of the class, or det A = 0 where Newton's method does not converge.
fn advanced<const D: usize, const N: usize>(
    field: &Field<'_, D, N>,
    x: &[f64; N],
    [from, to]: [&[f64; N]; 2],
) -> Result<([f64; N], [f64; N]), Face> {
    let inside = |pose: &[f64; N]| field.violated(pose, &[]).map_or(Ok(()), Err);
    inside(to)?;
    let [here, there] = [from, to].map(|place| field.joints(place, &[None; 3]));
    let next = field.close(x, &there).ok_or(SINGULAR)?;
    inside(&next)?;
    // The leg equations hold in both postures.
    let same_posture = field.joint_distance(&field.joints(&next, &[None; 3]), &there) <= SAME_JOINTS;
    let back = field.close(&next, &here).filter(|_| same_posture).ok_or(SINGULAR)?;
    Ok((next, back))
}

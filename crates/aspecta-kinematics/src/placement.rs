//! The positions of the attachment points, and the wrench of a force at one of them on the platform.

use super::minors;
use aspecta_robot::num::{Interval, Jet, Scalar, dot, dot_constant, each, without_turns};
use aspecta_robot::{Leg, Platform};

pub use aspecta_robot::{into_frame, out_of_frame};

/// The platform's frame in the base: C_i = origin + rotation · c_i.
#[derive(Clone, Copy, Debug)]
pub struct Placement<T, const D: usize> {
    origin: [T; D],
    rotation: Option<[[T; D]; D]>,
}

impl<T: Scalar, const D: usize> Placement<T, D> {
    /// The placement of the pose `x`; `turn(k)` gives (sin, cos) of the angle `x[k]`.
    pub fn new(platform: Platform, x: &[T], turn: impl Fn(usize) -> (T, T)) -> Self {
        let zero = T::zero();
        let origin = |n: usize| each!(|k| if k < n { x[k] } else { zero });
        match platform {
            Platform::PlanePoint => Self { origin: origin(2), rotation: None },
            Platform::TranslatingBody => Self { origin: origin(3), rotation: None },
            Platform::PlaneBody => {
                let (s, c) = turn(2);
                let mut r = [[zero; D]; D];
                (r[0][0], r[0][1]) = (c, -s);
                (r[1][0], r[1][1]) = (s, c);
                Self { origin: origin(2), rotation: Some(r) }
            }
            Platform::TurningBody => Self { origin: [zero; D], rotation: Some(spatial(turn, 0)) },
            Platform::FreeBody => Self { origin: origin(3), rotation: Some(spatial(turn, 3)) },
        }
    }

    /// The placement that puts the end of `leg` at d = C − A = `span` (base frame); `turn` as in
    /// [`Placement::new`]. For platforms that can be moved anywhere without turning.
    pub fn with_end(platform: Platform, leg: &Leg, span: &[T; D], turn: impl Fn(usize) -> (T, T)) -> Self {
        let still = [T::zero(); D];
        let mut placement = Self::new(platform, &still, turn);
        let arm = placement.arm(leg);
        placement.origin = each!(|k| match placement.rotation {
            None => span[k] + T::constant(leg.anchor[k] - leg.attachment[k]),
            Some(_) => span[k] + T::constant(leg.anchor[k]) - arm[k],
        });
        placement
    }

    /// The placement about the fixed point that takes the orthonormal axes `body` of the platform to those in
    /// `base`.
    pub fn taking(body: &[[Interval; 3]; 3], base: &[[T; D]; 3]) -> Self {
        let mut rotation = [[T::zero(); D]; D];
        for k in 0..D {
            let across = base.map(|axis| axis[k]);
            rotation[k] = each!(|j| dot_constant(&body.map(|axis| axis[j]), &across).tightened());
        }
        Self { origin: [T::zero(); D], rotation: Some(rotation) }
    }

    /// The placement displaced by `z`: moved by its translations and then, about its own origin, turned by
    /// R_z R_y R_x of its angles (by the angle, in the plane) in the axes of the base. `turn[k]` holds (sin,
    /// cos) of the angle z_k. Near z = 0 these are coordinates of the poses without any singularity; see
    /// [`displacement_row`].
    pub fn displaced<const N: usize>(&self, platform: Platform, z: &[T; N], turn: &[(T, T); N]) -> Self {
        let Self { origin, rotation } = Self::new(platform, z, |k| turn[k]);
        let rotation = match (&rotation, &self.rotation) {
            (Some(by), Some(from)) => {
                let column = |j: usize| -> [T; D] { each!(|k| from[k][j]) };
                let mut product = *from;
                for i in 0..D {
                    product[i] = each!(|j| dot(&by[i], &column(j)));
                }
                Some(product)
            }
            _ => None,
        };
        Self { origin: each!(|k| self.origin[k] + origin[k]), rotation }
    }

    /// Converts the placement to another scalar.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> Placement<U, D> {
        let rotation = self.rotation.as_ref().map(|rows| {
            let mut all = [[U::zero(); D]; D];
            for i in 0..D {
                all[i] = each!(|k| to(rows[i][k]));
            }
            all
        });
        Placement { origin: each!(|k| to(self.origin[k])), rotation }
    }

    /// R; `None` for platforms that do not turn.
    pub fn rotation(&self) -> Option<&[[T; D]; D]> {
        self.rotation.as_ref()
    }

    /// Returns the position of the platform's own origin.
    pub fn origin(&self) -> &[T; D] {
        &self.origin
    }

    /// The placement of the pose `x`, with sines and cosines computed here.
    pub fn at(platform: Platform, x: &[T]) -> Self {
        Self::new(platform, x, |k| x[k].sin_cos())
    }

    /// The arm r = R c from the platform's origin to the leg's attachment, base frame.
    pub fn arm(&self, leg: &Leg) -> [T; D] {
        self.turned(&leg.attachment)
    }

    /// A vector fixed in the platform, in the base frame.
    pub fn turned(&self, v: &[Interval; 3]) -> [T; D] {
        match &self.rotation {
            None => each!(|k| T::constant(v[k])),
            Some(r) => each!(|k| dot_constant(&v[..D], &r[k])),
        }
    }

    /// d = C − A in the leg's own frame, `arm` being the leg's arm.
    pub fn span(&self, leg: &Leg, arm: &[T; D]) -> [T; D] {
        let d: [T; D] = each!(|k| {
            // Constants first: for a platform that does not turn, arm and anchor are both constants.
            match self.rotation {
                None => self.origin[k] - T::constant(offset(leg, k)),
                Some(_) => (self.origin[k] + arm[k] - T::constant(leg.anchor[k])).tightened(),
            }
        });
        into_frame(leg, &d)
    }
}

/// A − c. A point platform has c = 0, which costs nothing; 0 − 0, rounded outward, would be subnormal and
/// slow.
fn offset(leg: &Leg, k: usize) -> Interval {
    if leg.attachment[k] == Interval::point(0.0) { leg.anchor[k] } else { leg.anchor[k] - leg.attachment[k] }
}

/// R = R_z(yaw) R_y(pitch) R_x(roll), roll being coordinate `first`.
fn spatial<T: Scalar, const D: usize>(turn: impl Fn(usize) -> (T, T), first: usize) -> [[T; D]; D] {
    let (sr, cr) = turn(first);
    let (sp, cp) = turn(first + 1);
    let (sy, cy) = turn(first + 2);
    let rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ];
    std::array::from_fn(|i| std::array::from_fn(|j| rows[i][j]))
}

/// The angles of R = R_z(yaw) R_y(pitch) R_x(roll), for D = 3. At pitch = ±90°, where only roll ∓ yaw is
/// determined, yaw is 0.
pub fn roll_pitch_yaw<const D: usize>(r: &[[f64; D]; D]) -> [f64; 3] {
    let low = D - 1;
    let level = r[0][0].hypot(r[1][0]);
    let pitch = (-r[low][0]).atan2(level);
    if level < 4.0 * f64::EPSILON {
        return [(-r[1][low]).atan2(r[1][1]), pitch, 0.0];
    }
    // With yaw undone the second row is (0, cos roll, −sin roll): accurate near the pole too, where yaw is
    // not.
    let yaw = r[1][0].atan2(r[0][0]);
    let (s, c) = yaw.sin_cos();
    let row = |k: usize| c * r[1][k] - s * r[0][k];
    [(-row(low)).atan2(row(1)), pitch, yaw]
}

/// The pose displaced by z ([`Placement::displaced`]); roll and yaw stay near what they were.
pub fn moved<const D: usize, const N: usize>(platform: Platform, pose: &[f64; N], z: &[f64; N]) -> [f64; N] {
    let mut to: [f64; N] = each!(|k| pose[k] + z[k]);
    if !platform.turns_in_space() {
        return to;
    }
    let placement = Placement::<f64, D>::at(platform, pose).displaced(platform, z, &z.map(f64::sin_cos));
    if let Some(r) = placement.rotation() {
        for (k, angle) in (N - 3..N).zip(roll_pitch_yaw(r)) {
            to[k] = pose[k] + without_turns(angle - pose[k]);
        }
    }
    to
}

/// The row of A that belongs to the gradient g = ∂f/∂C (base frame) at the end of `arm`: the wrench
/// (g, arm × g) about the platform's origin, in the order (translation, rotation).
///
/// For spatial rotations the derivative is with respect to the angular velocity in the base frame, not
/// to the rates of roll, pitch and yaw, so det A has no singularity of representation.
pub fn wrench<T: Scalar, const D: usize, const N: usize>(
    platform: Platform,
    g: &[T; D],
    arm: &[T; D],
) -> [T; N] {
    let mut row = [T::zero(); N];
    match platform {
        Platform::PlanePoint | Platform::TranslatingBody => row[..D].copy_from_slice(g),
        Platform::PlaneBody => {
            (row[0], row[1]) = (g[0], g[1]);
            row[2] = minor(arm, g, 0, 1);
        }
        Platform::TurningBody => {
            row[0] = minor(arm, g, 1, D - 1);
            row[1] = minor(arm, g, D - 1, 0);
            row[2] = minor(arm, g, 0, 1);
        }
        Platform::FreeBody => {
            row[..D].copy_from_slice(g);
            row[N - 3] = minor(arm, g, 1, D - 1);
            row[N - 2] = minor(arm, g, D - 1, 0);
            row[N - 1] = minor(arm, g, 0, 1);
        }
    }
    row
}

/// The derivatives with respect to the coordinates z of [`Placement::displaced`], from the derivatives `row`
/// with respect to translations and the angular velocity ([`wrench`]), at the displacement whose angles have
/// the (sin, cos) `turn`.
///
/// R_z R_y R_x at rates ż turns with ω = R_z R_y e_x ż_x + R_z e_y ż_y + e_z ż_z.
pub fn displacement_row<T: Scalar, const N: usize>(
    platform: Platform,
    row: &[T; N],
    turn: &[(T, T); N],
) -> [T; N] {
    let mut rates = *row;
    if platform.turns_in_space() {
        let (x, y, z) = (N - 3, N - 2, N - 1);
        let ((sin_y, cos_y), (sin_z, cos_z)) = (turn[y], turn[z]);
        rates[x] = (row[x] * cos_z + row[y] * sin_z) * cos_y - row[z] * sin_y;
        rates[y] = row[y] * cos_z - row[x] * sin_z;
    }
    rates
}

/// ∂f/∂C in the base frame and ∂f/∂q of one leg, by differentiating its equation.
pub fn leg_gradient<T: Scalar, const D: usize>(leg: &Leg, d: &[T; D], q: T) -> (T, [T; D], T) {
    leg_gradient_turned(leg, d, q, || q.sin_cos())
}

/// [`leg_gradient`] with (sin q, cos q) from `turn`, which is asked only where q is an angle.
#[inline]
pub fn leg_gradient_turned<T: Scalar, const D: usize>(
    leg: &Leg,
    d: &[T; D],
    q: T,
    turn: impl FnOnce() -> (T, T),
) -> (T, [T; D], T) {
    // Four variables: up to three components of d, and q last.
    let variable = |x: T, k: usize| Jet::<T, 4>::variable(x, k);
    let jets: [Jet<T, 4>; D] = each!(|k| variable(d[k], k));
    let q = variable(q, 3);
    let f = leg.actuator.equation_turned(&jets, q, || {
        let (sin, cos) = turn();
        (q.chain(sin, cos), q.chain(cos, -sin))
    });
    let local: [T; D] = each!(|k| f.gradient[k]);
    (f.value, out_of_frame(leg, &local), f.gradient[3])
}

/// The determinant, by expansion along the rows with shared minors: no division, so it holds for enclosures.
pub fn determinant<T: Scalar, const N: usize>(m: &[[T; N]; N]) -> T {
    match N {
        2 => minor(&m[0], &m[1], 0, 1),
        3 => {
            let (b, c) = (&m[1], &m[2]);
            m[0][0] * minor(b, c, 1, 2) + m[0][1] * minor(b, c, 2, 0) + m[0][2] * minor(b, c, 0, 1)
        }
        _ => minors::determinant(m),
    }
}

/// The cofactors: entry (j, i) is the derivative of the determinant with respect to `m[j][i]`.
pub fn cofactors<T: Scalar, const N: usize>(m: &[[T; N]; N]) -> [[T; N]; N] {
    if N > 3 {
        return minors::cofactors(m);
    }
    let mut all = [[T::zero(); N]; N];
    for j in 0..N {
        for i in 0..N {
            all[j][i] = match N {
                2 if i == j => m[1 - j][1 - i],
                2 => -m[1 - j][1 - i],
                _ => minor(&m[(j + 1) % N], &m[(j + 2) % N], (i + 1) % N, (i + 2) % N),
            };
        }
    }
    all
}

/// aᵢ bⱼ − aⱼ bᵢ.
pub fn minor<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N], i: usize, j: usize) -> T {
    a[i] * b[j] - a[j] * b[i]
}

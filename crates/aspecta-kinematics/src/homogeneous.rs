//! A without units: Â, which is what distances from parallel singularities are measured in.

use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar};
use nalgebra::DMatrix;

/// The scaling that makes A into Â: moments are divided by the
/// [characteristic length](Robot::characteristic_length), unless the platform only turns, and then every row by
/// its norm. |det Â| ≤ 1, as the product of the norms of the rows bounds a determinant (Hadamard).
#[derive(Clone, Copy, Debug)]
pub struct Homogeneous {
    translations: usize,
    dof: usize,
    /// What moments are divided by.
    length: f64,
}

impl Homogeneous {
    /// That of a robot.
    pub fn of(robot: &Robot) -> Self {
        let translations = robot.platform.coordinates().iter().filter(|c| !c.angle).count();
        let length = if translations > 0 { robot.characteristic_length() } else { 1.0 };
        Self { translations, dof: robot.dof(), length }
    }

    /// Returns the divisor of det A for the moments in it.
    pub fn unit_of_moments(&self) -> Interval {
        let length = Interval::point(self.length);
        (self.translations..self.dof).fold(Interval::point(1.0), |unit, _| unit * length)
    }

    /// The norm of a row of A with its moments divided; `force` is that of its translations.
    pub fn norm<T: Scalar>(&self, force: T, row: &[T]) -> T {
        if self.translations == self.dof {
            return force;
        }
        let length = T::constant(Interval::point(self.length));
        let force = if self.translations > 0 { force.square() } else { T::zero() };
        row[self.translations..].iter().fold(force, |sum, m| sum + (*m / length).square()).sqrt()
    }

    /// Makes a row of A one of Â, in place. A row of zeros stays.
    pub fn scale(&self, row: &mut [f64]) {
        let force = row[..self.translations].iter().fold(0.0, |norm: f64, x| norm.hypot(*x));
        let moment = row[self.translations..].iter().fold(0.0, |norm: f64, x| norm.hypot(*x));
        let norm = force.hypot(moment / self.length);
        for (k, entry) in row.iter_mut().enumerate() {
            let unit = if k < self.translations { norm } else { norm * self.length };
            *entry = if norm > 0.0 { *entry / unit } else { 0.0 };
        }
    }

    /// Â.
    pub(crate) fn matrix(&self, a: &[Vec<f64>]) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.dof, self.dof);
        for (j, row) in a.iter().enumerate() {
            let mut row = row.clone();
            self.scale(&mut row);
            row.iter().enumerate().for_each(|(k, x)| all[(j, k)] = *x);
        }
        all
    }
}

//! Points of complex projective space.

use nalgebra::Complex;

/// V complex numbers: homogeneous coordinates, or a tangent. Real and imaginary parts lie apart, so that
/// loops over them compile to vector instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point<const V: usize> {
    pub re: [f64; V],
    pub im: [f64; V],
}

impl<const V: usize> Point<V> {
    pub const ZERO: Self = Self { re: [0.0; V], im: [0.0; V] };

    pub const fn real(re: [f64; V]) -> Self {
        Self { re, im: [0.0; V] }
    }

    pub fn get(&self, k: usize) -> Complex<f64> {
        Complex::new(self.re[k], self.im[k])
    }

    pub fn from_fn(f: impl Fn(usize) -> Complex<f64>) -> Self {
        let mut point = Self::ZERO;
        for k in 0..V {
            let z = f(k);
            (point.re[k], point.im[k]) = (z.re, z.im);
        }
        point
    }

    /// Whether every coordinate is real.
    pub fn is_real(&self) -> bool {
        self.im.iter().all(|y| *y == 0.0)
    }

    pub fn conjugate(&self) -> Self {
        Self { re: self.re, im: self.im.map(|x| -x) }
    }

    /// Σ aₖ bₖ, without conjugation.
    #[inline(always)]
    pub fn dot(&self, b: &Self) -> Complex<f64> {
        let (mut re, mut im) = (0.0, 0.0);
        for k in 0..V {
            re += self.re[k] * b.re[k] - self.im[k] * b.im[k];
            im += self.re[k] * b.im[k] + self.im[k] * b.re[k];
        }
        Complex::new(re, im)
    }

    /// self += z b.
    #[inline(always)]
    pub fn add_scaled(&mut self, z: Complex<f64>, b: &Self) {
        for k in 0..V {
            self.re[k] += z.re * b.re[k] - z.im * b.im[k];
            self.im[k] += z.re * b.im[k] + z.im * b.re[k];
        }
    }

    #[inline(always)]
    pub fn scaled(&self, z: Complex<f64>) -> Self {
        let mut out = Self::ZERO;
        out.add_scaled(z, self);
        out
    }

    #[inline(always)]
    pub fn norm_squared(&self) -> f64 {
        let mut sum = 0.0;
        for k in 0..V {
            sum += self.re[k] * self.re[k] + self.im[k] * self.im[k];
        }
        sum
    }

    #[inline(always)]
    pub fn norm(&self) -> f64 {
        self.norm_squared().sqrt()
    }

    /// Returns the point with norm 1 and its largest coordinate positive, so that a real point has real
    /// coordinates.
    pub fn normalised(&self) -> Self {
        let largest = (0..V).map(|k| self.get(k)).max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        let largest = largest.unwrap_or_default();
        self.scaled(largest.conj() / (largest.norm() * self.norm()))
    }
}

//! Random robots that close at a random pose, built backwards from the pose.

mod split_mix;

use aspecta::num::{Interval, Scalar};
use aspecta::robot::{Actuator, Frame, Leg, Platform, Prismatic, Revolute, Robot, Strut, point};
use std::f64::consts::PI;

pub use split_mix::Random;

impl Random {
    fn direction(&mut self, space: usize) -> [f64; 3] {
        let (turn, z) = (self.within(-PI, PI), self.within(-1.0, 1.0));
        let across = if space == 2 { 1.0 } else { (1.0 - z * z).sqrt() };
        [across * turn.cos(), across * turn.sin(), if space == 2 { 0.0 } else { z }]
    }

    /// An orthonormal frame, enclosed.
    fn frame(&mut self, space: usize) -> Frame {
        let about = |k: usize, angle: f64| {
            let (s, c) = Interval::point(angle).sin_cos();
            let mut m = [[Interval::point(0.0); 3]; 3];
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            m[k][k] = Interval::point(1.0);
            (m[i][i], m[i][j], m[j][i], m[j][j]) = (c, -s, s, c);
            m
        };
        let times = |a: Frame, b: Frame| -> Frame {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
            })
        };
        let turn = about(2, self.within(-PI, PI));
        if space == 2 {
            return turn;
        }
        let (pitch, roll) = (about(1, self.within(-PI, PI)), about(0, self.within(-PI, PI)));
        times(turn, times(pitch, roll))
    }
}

/// A robot and a configuration (X, q) at which its legs close, to rounding.
#[derive(Clone, Debug)]
pub struct Case {
    pub robot: Robot,
    pub pose: Vec<f64>,
    pub q: Vec<f64>,
}

/// How far from a parallel singularity the configuration is.
#[derive(Clone, Copy, Debug)]
pub enum Spread {
    /// Rods point anywhere.
    Anywhere,
    /// The rods' directions are this far (rad) from a singularity.
    Singular(f64),
}

/// Where a planar or spatial platform puts the attachment `c`.
fn placed(platform: Platform, x: &[f64], c: [f64; 3]) -> [f64; 3] {
    match platform {
        Platform::PlanePoint => [x[0] + c[0], x[1] + c[1], 0.0],
        Platform::TranslatingBody => [x[0] + c[0], x[1] + c[1], x[2] + c[2]],
        _ => {
            let (s, k) = x[2].sin_cos();
            [x[0] + k * c[0] - s * c[1], x[1] + s * c[0] + k * c[1], 0.0]
        }
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let n = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / n)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// Directions of the rods, from B to C.
fn rods(platform: Platform, ends: &[[f64; 3]], spread: Spread, random: &mut Random) -> Vec<[f64; 3]> {
    let space = platform.space();
    let mut rods: Vec<_> = ends.iter().map(|_| random.direction(space)).collect();
    let Spread::Singular(gap) = spread else { return rods };
    match platform {
        // In line.
        Platform::PlanePoint => {
            let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let (s, c) = gap.sin_cos();
            rods[1] =
                [side * (c * rods[0][0] - s * rods[0][1]), side * (s * rods[0][0] + c * rods[0][1]), 0.0];
        }
        // Through one point.
        Platform::PlaneBody => {
            let centre = [random.within(-20.0, 20.0), random.within(-20.0, 20.0), 0.0];
            for (rod, end) in rods.iter_mut().zip(ends) {
                *rod = unit(minus(*end, centre));
            }
            let (s, c) = gap.sin_cos();
            rods[2] = [c * rods[2][0] - s * rods[2][1], s * rods[2][0] + c * rods[2][1], 0.0];
        }
        // In one plane.
        _ => {
            let (a, b) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0));
            let out = rods[2];
            rods[2] = unit(std::array::from_fn(|k| a * rods[0][k] + b * rods[1][k] + gap * out[k]));
        }
    }
    rods
}

/// Draws a case.
pub fn case(platform: Platform, spread: Spread, seed: u64) -> Case {
    let random = &mut Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let space = platform.space();
    let pose: Vec<f64> = platform
        .coordinates()
        .iter()
        .map(|c| if c.angle { random.within(-PI, PI) } else { random.within(-10.0, 10.0) })
        .collect();
    let coordinate = |k: usize, random: &mut Random| if k < space { random.within(-8.0, 8.0) } else { 0.0 };
    let attachments: Vec<[f64; 3]> =
        pose.iter().map(|_| std::array::from_fn(|k| coordinate(k, random))).collect();
    let ends: Vec<_> = attachments.iter().map(|&c| placed(platform, &pose, c)).collect();
    let rods = rods(platform, &ends, spread, random);
    let mut q = Vec::new();
    let mut legs = Vec::new();
    for j in 0..pose.len() {
        let frame = random.frame(space);
        let axis = |k: usize| frame[k].map(Interval::mid);
        let length = random.within(1.0, 12.0);
        let b = minus(ends[j], rods[j].map(|x| x * length));
        let (actuator, drive, anchor) = match random.below(3) {
            0 => {
                let (l, angle) = (random.within(1.0, 12.0), random.within(-PI, PI));
                let crank: [f64; 3] =
                    std::array::from_fn(|k| l * (angle.cos() * axis(0)[k] + angle.sin() * axis(1)[k]));
                let actuator = Actuator::Revolute(Revolute {
                    crank: Interval::decimal(l),
                    rod: Interval::decimal(length),
                });
                (actuator, angle, minus(b, crank))
            }
            1 => {
                let slide = random.within(-12.0, 12.0);
                let actuator = Actuator::Prismatic(Prismatic { rod: Interval::decimal(length) });
                (actuator, slide, minus(b, axis(0).map(|u| slide * u)))
            }
            _ => (Actuator::Strut(Strut), length, b),
        };
        q.push(drive);
        let leg =
            Leg { anchor: point(anchor), attachment: point(attachments[j]), frame, actuator, limits: vec![] };
        legs.push(leg);
    }
    Case { robot: Robot::new("random", platform, legs).unwrap(), pose, q }
}

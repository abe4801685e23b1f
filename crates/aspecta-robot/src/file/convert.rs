//! From the tables of a robot file to a [`Robot`]: numbers to enclosures, vectors to frames, keys checked.

use super::error::Problem;
use super::format::{Angle, At, LegTable, Number, Pair, Range, RobotFile, Unit, Vector};
use super::keys::LegKeys;
use super::locate::Fault;
use super::words;
use crate::frame::{product, sum};
use crate::num::{Interval, Scalar};
use crate::{Leg, Platform, Robot, RobotError, check_legs};
use std::ops::Range as Span;

const ZERO: Interval = Interval::point(0.0);
const HALF: Interval = Interval::point(0.5);
/// Links may be this long, anchors this far away.
const GREATEST: f64 = 1e6;
const SMALLEST: f64 = 1e-6;

/// The facts that the conversion needs besides the tables.
pub(super) struct Context<'a> {
    /// The file, to compare numbers as written with numbers as read.
    pub text: &'a str,
    pub platform: Platform,
}

/// The robot a file describes.
pub(super) fn robot(file: &RobotFile, text: &str) -> Result<Robot, Fault> {
    let platform = file.platform.value;
    let context = Context { text, platform };
    let kinds: Vec<_> = file.legs.iter().map(|l| l.value.actuator.value.kind.value).collect();
    check_legs(platform, &kinds).map_err(|e| misfit(file, e))?;
    let legs = file.legs.iter().map(|leg| context.leg(leg)).collect::<Result<Vec<_>, _>>()?;
    let mut robot = Robot::new(words::name(&file.name)?, platform, legs).map_err(|e| misfit(file, e))?;
    words::set(&mut robot.title, &file.title)?;
    words::set(&mut robot.source, &file.source)?;
    words::set(&mut robot.length_unit, &file.length_unit)?;
    for (name, range) in file.window.entries() {
        if let Some(range) = range {
            let (k, bounds) = context.window(name, range)?;
            robot.window[k] = Some(bounds);
        }
    }
    robot.rod_angles = context.rod_angles(file)?;
    context.add_bodies(file, &mut robot)?;
    context.add_obstacles(file, &mut robot)?;
    check_reach(file, &robot)?;
    Ok(robot)
}

/// Returns the fault of legs that do not fit the platform, placed at the first leg too many, the last of too
/// few, or the kind.
fn misfit(file: &RobotFile, error: RobotError) -> Fault {
    let leg = |k: usize| file.legs.get(k).map(|l| l.span.clone());
    let span = match &error {
        RobotError::LegCount { wanted, .. } => leg(*wanted).or(file.legs.last().map(|l| l.span.clone())),
        RobotError::Mismatch { leg, .. } => {
            file.legs.get(leg.index()).map(|l| l.value.actuator.value.kind.span.clone())
        }
    };
    Fault { span: span.unwrap_or(file.platform.span.clone()), problem: error.into() }
}

/// Some pose must be within reach of all legs and inside the window.
fn check_reach(file: &RobotFile, robot: &Robot) -> Result<(), Fault> {
    let Ok(window) = robot.workspace_window() else { return Ok(()) };
    let Some(k) = window.ranges.iter().position(|(lo, hi)| lo >= hi) else { return Ok(()) };
    let coordinate = robot.platform.coordinates()[k].name;
    let given = file.window.entries().into_iter().find(|(name, _)| *name == coordinate);
    Err(match given.and_then(|(_, range)| range) {
        Some(range) => Fault::new(&range.span, Problem::OutOfReach { coordinate }),
        None => Fault::new(&file.legs[0].span, Problem::NeverMeets { coordinate }),
    })
}

impl Context<'_> {
    fn leg(&self, leg: &At<LegTable>) -> Result<Leg, Fault> {
        let kind = leg.value.actuator.value.kind.value;
        let keys = LegKeys::new(self, leg);
        keys.check()?;
        let mut read = kind.read(&keys)?;
        read.limits = self.limits(&leg.value.limits, kind, &read)?;
        Ok(read)
    }

    /// (cos, sin) of an angle strictly between 0° and 180°.
    pub fn open_angle(
        &self,
        angle: &At<Angle<Number>>,
        what: &'static str,
        range: &'static str,
    ) -> Result<(Interval, Interval), Fault> {
        let Angle { unit, value } = &angle.value;
        let x = self.decimal(value)?;
        if x.lo > 0.0 && x.hi < unit.half_turn() {
            return Ok(unit.cos_sin(x));
        }
        Err(Fault::new(&angle.span, Problem::AngleOutOfRange { what, range }))
    }

    /// The coordinate a window is for, and its bounds (angles in rad, rounded outward).
    fn window(&self, name: &str, range: &At<Range>) -> Result<(usize, (f64, f64)), Fault> {
        let coordinates = self.platform.coordinates();
        let Some(k) = coordinates.iter().position(|c| c.name == name) else {
            let known = coordinates.iter().map(|c| c.name.to_owned()).collect();
            let platform = self.platform.name();
            return Err(Fault::new(&range.span, Problem::UnknownCoordinate { platform, known }));
        };
        let what = || format!("the coordinate `{name}`");
        let bounds = match (coordinates[k].angle, &range.value) {
            (false, Range::Length(pair)) => {
                self.ordered(pair, &range.span)?;
                (pair.0[0].value.0, pair.0[1].value.0)
            }
            (true, Range::Angle(angle)) => {
                let (min, max) = self.turn(angle, &range.span)?;
                let (lo, hi) = (angle.unit.radians(min), angle.unit.radians(max));
                let quarter = angle.unit.quarter();
                let past_vertical = min.lo < -quarter || max.hi > quarter;
                if past_vertical && !coordinates[k].periodic {
                    let problem = Problem::AngleOutOfRange { what: "pitch", range: "within ±90°" };
                    return Err(Fault::new(&range.span, problem));
                }
                (lo.lo, hi.hi)
            }
            (true, _) => return Err(Fault::new(&range.span, Problem::AngleWanted { what: what() })),
            (false, _) => return Err(Fault::new(&range.span, Problem::LengthWanted { what: what() })),
        };
        Ok((k, bounds))
    }

    /// A range of angles of less than a turn, in its own unit.
    pub fn turn(&self, angle: &Angle<Pair>, span: &Span<usize>) -> Result<(Interval, Interval), Fault> {
        let (min, max) = self.ordered(&angle.value, span)?;
        let full = 2.0 * angle.unit.half_turn();
        if max.hi - min.lo >= full {
            let (min, max) = (angle.value.0[0].value.0, angle.value.0[1].value.0);
            let problem = match angle.unit {
                Unit::Rad if min.abs().max(max.abs()) > full => Problem::DegreesAsRadians { min, max },
                Unit::Rad | Unit::Deg => Problem::FullTurn,
            };
            return Err(Fault::new(span, problem));
        }
        if min.lo.abs().max(max.hi.abs()) > 2.0 * full {
            let problem = Problem::AngleOutOfRange { what: "a limit", range: "within two turns of zero" };
            return Err(Fault::new(span, problem));
        }
        Ok((min, max))
    }

    /// min < max.
    pub fn ordered(&self, pair: &Pair, span: &Span<usize>) -> Result<(Interval, Interval), Fault> {
        let (min, max) = (self.decimal(&pair.0[0])?, self.decimal(&pair.0[1])?);
        let (a, b) = (pair.0[0].value.0, pair.0[1].value.0);
        if a < b { Ok((min, max)) } else { Err(Fault::new(span, Problem::Contradiction { min: a, max: b })) }
    }

    /// A length within [1e-6, 1e6].
    pub fn length(&self, number: &Number) -> Result<Interval, Fault> {
        let length = self.decimal(number)?;
        let x = number.value.0;
        if x <= 0.0 {
            return Err(Fault::new(&number.span, Problem::NotPositive));
        }
        if x < SMALLEST { Err(Fault::new(&number.span, Problem::Magnitude)) } else { Ok(length) }
    }

    /// A vector; the third component is 0 in the plane.
    pub fn vector(&self, vector: &At<Vector>) -> Result<[Interval; 3], Fault> {
        let (wanted, found) = (self.platform.space(), vector.value.0.len());
        if found != wanted {
            let platform = self.platform.name();
            return Err(Fault::new(&vector.span, Problem::VectorLength { platform, wanted, found }));
        }
        let mut v = [ZERO; 3];
        for (x, number) in v.iter_mut().zip(&vector.value.0) {
            *x = self.decimal(number)?;
        }
        Ok(v)
    }

    /// The enclosure of the decimal the file shows.
    pub fn decimal(&self, number: &Number) -> Result<Interval, Fault> {
        let x = number.value.0;
        if !x.is_finite() {
            return Err(Fault::new(&number.span, Problem::NotFinite));
        }
        if x.abs() > GREATEST {
            return Err(Fault::new(&number.span, Problem::Magnitude));
        }
        // `Interval::decimal` takes an integer at its word.
        if x == x.trunc() && !is_integer(&self.text[number.span.clone()]) {
            return Err(Fault::new(&number.span, Problem::TooPrecise { nearest: x }));
        }
        Ok(Interval::decimal(x))
    }
}

/// Whether a TOML number is an integer as written: every digit after the point, once the exponent has moved
/// it, is 0.
fn is_integer(literal: &str) -> bool {
    let literal = literal.replace('_', "").to_ascii_lowercase();
    if !literal.contains(['.', 'e']) || literal.starts_with("0x") {
        return true;
    }
    let (mantissa, exponent) = literal.split_once('e').unwrap_or((&literal, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let whole = whole.trim_start_matches(['+', '-']);
    let exponent: i64 = exponent.parse().unwrap_or(i64::MIN);
    let point = (whole.len() as i64).saturating_add(exponent);
    let digits = whole.chars().chain(fraction.chars());
    digits.zip(0i64..).all(|(digit, place)| digit == '0' || place < point)
}

impl Unit {
    /// 180°, rounded down.
    pub fn half_turn(self) -> f64 {
        match self {
            Self::Deg => 180.0,
            Self::Rad => Interval::PI.lo,
        }
    }

    fn quarter(self) -> f64 {
        // Rounded up, so that the decimal 1.5707963267948966 is still within ±90°.
        match self {
            Self::Deg => 90.0,
            Self::Rad => 0.5 * Interval::PI.hi,
        }
    }

    fn radians(self, x: Interval) -> Interval {
        match self {
            Self::Deg => product(x, Interval::PI / Interval::point(180.0)),
            Self::Rad => x,
        }
    }

    /// (cos, sin), exact for multiples of 90 degrees and for 0.
    pub fn cos_sin(self, x: Interval) -> (Interval, Interval) {
        let (o, i) = (ZERO, Interval::point(1.0));
        let quarters = match self {
            Self::Deg if x.lo == x.hi && x.lo % 90.0 == 0.0 => Some((x.lo / 90.0).rem_euclid(4.0)),
            Self::Deg | Self::Rad => (x == o).then_some(0.0),
        };
        match quarters {
            Some(0.0) => (i, o),
            Some(1.0) => (o, i),
            Some(2.0) => (-i, o),
            Some(_) => (o, -i),
            None => {
                let (sin, cos) = self.radians(x).sin_cos();
                (cos, sin)
            }
        }
    }

    /// The middle of a range: rad, rounded.
    pub fn middle(self, (min, max): (Interval, Interval)) -> f64 {
        0.5 * (min.mid() + max.mid()) * std::f64::consts::PI / self.half_turn()
    }

    /// (cos, sin) of the middle of a range and cos of its half-width.
    pub fn middle_and_half(self, (min, max): (Interval, Interval)) -> ((Interval, Interval), Interval) {
        let middle = product(HALF, sum(min, max));
        let half = product(HALF, sum(max, -min));
        (self.cos_sin(middle), self.cos_sin(half).0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_as_written() {
        for yes in ["0", "-5", "1_000", "10.0", "1.50e1", "2e3", "0.0", "0x1F", "+7.000_0", "100e-2"] {
            assert!(is_integer(yes), "{yes}");
        }
        for no in ["1.0000000000000000001", "0.1", "1e-400", "1.55e1", "100e-3", "-3.5"] {
            assert!(!is_integer(no), "{no}");
        }
    }

    #[test]
    fn right_angles_are_exact_and_others_enclosed() {
        let exact = |x: f64| Interval::point(x);
        for (deg, c, s) in
            [(0.0, 1.0, 0.0), (90.0, 0.0, 1.0), (-90.0, 0.0, -1.0), (180.0, -1.0, 0.0), (450.0, 0.0, 1.0)]
        {
            assert_eq!(Unit::Deg.cos_sin(exact(deg)), (exact(c), exact(s)), "{deg}");
        }
        let (c, s) = Unit::Deg.cos_sin(exact(60.0));
        let root = Interval::point(0.75).sqrt();
        assert!(c.contains(0.5) && c.width() < 2e-15);
        assert!(s.lo <= root.hi && root.lo <= s.hi && s.width() < 2e-15);
        let (middle, half) = Unit::Deg.middle_and_half((exact(-90.0), exact(90.0)));
        assert_eq!((middle, half), ((exact(1.0), ZERO), ZERO));
    }
}

//! Joint limits of a robot file.

use super::convert::Context;
use super::error::Problem;
use super::format::{Angle, At, JointTable, LimitsTable, Number, Pair, Range, RobotFile, hint};
use super::locate::Fault;
use super::tables::RodAngleTable;
use crate::frame::{into, unit};
use crate::legs::Kind;
use crate::num::Interval;
use crate::{Leg, LegIndex, Limit, MOST_SHARED, RodAngle};

type Cone = ([Interval; 3], Interval);

fn out_of_place(reason: &str) -> Problem {
    Problem::OutOfPlace { reason: reason.into() }
}

impl Context<'_> {
    /// The limits of `leg`, which is complete but for them.
    pub fn limits(&self, table: &LimitsTable, kind: Kind, leg: &Leg) -> Result<Vec<Limit>, Fault> {
        let mut limits = Vec::new();
        if let Some(range) = &table.actuator {
            limits.push(self.actuator_limit(range, kind)?);
        }
        if let Some(range) = &table.elbow {
            limits.push(self.elbow(range, kind)?);
        }
        if let Some(joint) = &table.base_joint {
            let (axis, half_cos) = self.cone(joint, kind)?;
            limits.push(Limit::BaseCone { axis: into(&leg.frame, &axis), half_cos });
        }
        if let Some(joint) = &table.platform_joint {
            let (axis, half_cos) = self.cone(joint, kind)?;
            limits.push(Limit::PlatformCone { axis, half_cos });
        }
        Ok(limits)
    }

    fn actuator_limit(&self, range: &At<Range>, kind: Kind) -> Result<Limit, Fault> {
        let what = || format!("the driven joint of a `{}` leg", kind.name());
        match (&range.value, kind.facts().is_angle) {
            (Range::Angle(angle), true) => {
                let ends = self.turn(angle, &range.span)?;
                let (middle, half_cos) = angle.unit.middle_and_half(ends);
                let (meant, found) = (angle.unit.middle(ends), middle.1.mid().atan2(middle.0.mid()));
                let turns = ((meant - found) / std::f64::consts::TAU).round() as i32;
                Ok(Limit::ActuatorAngle { middle, half_cos, turns })
            }
            (Range::Length(pair), false) => {
                let (min, max) = self.ordered(pair, &range.span)?;
                if kind.facts().is_positive && min.lo < 0.0 {
                    return Err(Fault::new(&pair.0[0].span, Problem::NegativeMinimum));
                }
                Ok(Limit::ActuatorLength { min, max })
            }
            (Range::Length(_), true) => Err(Fault::new(&range.span, Problem::AngleWanted { what: what() })),
            (Range::Angle(_), false) => Err(Fault::new(&range.span, Problem::LengthWanted { what: what() })),
        }
    }

    /// In the plane the elbow angle has a sign; in space it lies in [0°, 180°].
    fn elbow(&self, range: &At<Angle<Pair>>, kind: Kind) -> Result<Limit, Fault> {
        let Angle { unit, .. } = range.value;
        if !kind.facts().has_elbow {
            let others = if kind.facts().has_rod { "`base-joint` or `platform-joint`" } else { "`actuator`" };
            let reason = format!("only a `revolute` leg has an elbow, between crank and rod: limit {others}");
            return Err(Fault::new(&range.span, out_of_place(&reason)));
        }
        let (min, max) = self.turn(&range.value, &range.span)?;
        if self.platform.space() == 2 {
            let (middle, half_cos) = unit.middle_and_half((min, max));
            return Ok(Limit::Elbow { middle, half_cos });
        }
        if min.lo < 0.0 || max.lo > unit.half_turn() {
            let problem =
                Problem::AngleOutOfRange { what: "an elbow angle in space", range: "from 0° to 180°" };
            return Err(Fault::new(&range.span, problem));
        }
        Ok(Limit::SpatialElbow { min_cos: unit.cos_sin(min).0, max_cos: unit.cos_sin(max).0 })
    }

    /// The limits that two legs share.
    pub fn rod_angles(&self, file: &RobotFile) -> Result<Vec<RodAngle>, Fault> {
        let one = |table: &At<RodAngleTable>| {
            let legs = self.two_legs(file, &table.value.legs)?;
            let Angle { unit, .. } = table.value.angle.value;
            let span = &table.value.angle.span;
            let (min, max) = self.turn(&table.value.angle.value, span)?;
            if min.lo < 0.0 || max.lo > unit.half_turn() {
                let problem =
                    Problem::AngleOutOfRange { what: "an angle between rods", range: "from 0° to 180°" };
                return Err(Fault::new(span, problem));
            }
            let is_whole = |x: Interval| x.hi >= unit.half_turn();
            let min_cos = (min.hi > 0.0).then(|| unit.cos_sin(min).0);
            let max_cos = (!is_whole(max)).then(|| unit.cos_sin(max).0);
            if min_cos.is_none() && max_cos.is_none() {
                let reason = "the angle between two rods is never below 0° or above 180°: this limits nothing, leave it out";
                return Err(Fault::new(span, out_of_place(reason)));
            }
            Ok(RodAngle { legs, min_cos, max_cos })
        };
        if file.rod_angles.len() > MOST_SHARED {
            let reason = format!("a robot has at most {MOST_SHARED} of these limits");
            return Err(Fault::new(&file.rod_angles[MOST_SHARED].span, out_of_place(&reason)));
        }
        file.rod_angles.iter().map(one).collect()
    }

    /// Two legs with rods, told by their numbers.
    fn two_legs(&self, file: &RobotFile, numbers: &At<Vec<Number>>) -> Result<[LegIndex; 2], Fault> {
        let count = file.legs.len();
        let leg = |number: &Number| {
            let x = number.value.0;
            let known = x >= 1.0 && x <= count as f64 && x == x.trunc();
            if !known {
                let reason = format!("there is no such leg: give two numbers from 1 to {count}");
                return Err(Fault::new(&number.span, out_of_place(&reason)));
            }
            let index = x as usize - 1;
            let kind = file.legs[index].value.actuator.value.kind.value;
            if !kind.facts().has_rod || kind.facts().is_positive {
                let reason = format!("leg {x} is a `{}` leg, which has no rod", kind.name());
                return Err(Fault::new(&number.span, out_of_place(&reason)));
            }
            Ok(LegIndex::new(index))
        };
        match &numbers.value[..] {
            [first, second] if first.value.0 != second.value.0 => Ok([leg(first)?, leg(second)?]),
            _ => {
                let reason = format!("name two different legs, legs = [1, {count}]");
                Err(Fault::new(&numbers.span, out_of_place(&reason)))
            }
        }
    }

    /// A unit vector and the cosine of a half-angle about it.
    fn cone(&self, joint: &At<JointTable>, kind: Kind) -> Result<Cone, Fault> {
        let (table, span) = (&joint.value, &joint.span);
        if !kind.facts().has_rod {
            let name = kind.name();
            let reason =
                format!("a `{name}` leg has no rod whose direction could be limited: limit `actuator`");
            return Err(Fault::new(span, out_of_place(&reason)));
        }
        match self.platform.space() {
            2 => self.planar_cone(table, span),
            _ => self.spatial_cone(table, span),
        }
    }

    fn planar_cone(&self, table: &JointTable, span: &std::ops::Range<usize>) -> Result<Cone, Fault> {
        use super::format::Unit::{Deg, Rad};
        let range = match table {
            JointTable { deg: Some(deg), rad: None, axis: None, within: None } => (Deg, deg),
            JointTable { deg: None, rad: Some(rad), axis: None, within: None } => (Rad, rad),
            _ => {
                let reason = "in the plane give the range from the x axis, { deg = [min, max] } or { rad = [min, max] }";
                return Err(Fault::new(span, out_of_place(reason)));
            }
        };
        let angle = Angle { unit: range.0, value: range.1.clone() };
        let ((cos, sin), half_cos) = range.0.middle_and_half(self.turn(&angle, span)?);
        Ok(([cos, sin, Interval::point(0.0)], half_cos))
    }

    fn spatial_cone(&self, table: &JointTable, span: &std::ops::Range<usize>) -> Result<Cone, Fault> {
        if table.deg.is_some() || table.rad.is_some() {
            let reason = "in space give a cone, { axis = [x, y, z], within = { deg = … } }";
            return Err(Fault::new(span, out_of_place(reason)));
        }
        let missing = |key: &str| Problem::MissingKey { key: key.into(), hint: hint(key) };
        let axis = table.axis.as_ref().ok_or_else(|| Fault::new(span, missing("axis")))?;
        let within = table.within.as_ref().ok_or_else(|| Fault::new(span, missing("within")))?;
        let direction =
            unit(&self.vector(axis)?).ok_or_else(|| Fault::new(&axis.span, Problem::ZeroVector))?;
        let (cos, _) =
            self.open_angle(within, "the half-angle of a cone", "between 0° and 180°, ends excluded")?;
        Ok((direction, cos))
    }
}

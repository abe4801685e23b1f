//! Obstacles of a robot file.

use super::convert::Context;
use super::error::Problem;
use super::format::{At, ObstacleTable, RobotFile, hint};
use super::locate::Fault;
use crate::frame::{dot, unit};
use crate::num::Interval;
use crate::{Clearance, Leg, LegIndex, Limit, LinkPart, MOST_OBSTACLES, Platform, Robot, Solid};

impl Context<'_> {
    /// Gives each leg of a robot, which is complete but for them, its limits at the obstacles.
    pub fn add_obstacles(&self, file: &RobotFile, robot: &mut Robot) -> Result<(), Fault> {
        for (k, table) in file.obstacles.iter().enumerate() {
            let out_of_place = |reason: String| Fault::new(&table.span, Problem::OutOfPlace { reason });
            if k >= MOST_OBSTACLES {
                return Err(out_of_place(format!("a robot has at most {MOST_OBSTACLES} obstacles")));
            }
            if self.platform == Platform::TurningBody {
                let reason = "the links of a `turning-body` are arcs round its centre, of any radius: they have no obstacles";
                return Err(out_of_place(reason.into()));
            }
            let solid = self.solid(table)?;
            let clearance = match &table.value.clearance {
                None => Interval::point(0.0),
                Some(number) if number.value.0 == 0.0 => Interval::point(0.0),
                Some(number) if number.value.0 < 0.0 => {
                    let reason = "a clearance is not negative; 0, or leave it out, where the links may come as near as they like";
                    return Err(Fault::new(&number.span, Problem::OutOfPlace { reason: reason.into() }));
                }
                Some(number) => self.length(number)?,
            };
            for (j, leg) in robot.legs.iter_mut().enumerate() {
                if is_at_its_anchor(&solid, clearance, leg) {
                    let leg = LegIndex::new(j);
                    let reason = format!(
                        "it reaches the anchor of leg {leg}, so that no configuration is clear of it: move it, or lessen its clearance"
                    );
                    return Err(out_of_place(reason));
                }
                let of = |&part: &LinkPart| Clearance { obstacle: k + 1, solid, part, distance: clearance };
                let touching =
                    solid.parts_of(leg).iter().map(of).filter(|clearance| clearance.matters_to(leg));
                let limits: Vec<Limit> = touching.map(Limit::Clearance).collect();
                leg.limits.extend(limits);
            }
        }
        Ok(())
    }

    fn solid(&self, table: &At<ObstacleTable>) -> Result<Solid, Fault> {
        let missing =
            |key: &str| Fault::new(&table.span, Problem::MissingKey { key: key.into(), hint: hint(key) });
        let ObstacleTable { centre, radius, face, normal, .. } = &table.value;
        match (centre, radius, face, normal) {
            (Some(centre), Some(radius), None, None) => {
                Ok(Solid::Ball { centre: self.vector(centre)?, radius: self.length(radius)? })
            }
            (None, None, Some(face), Some(given)) => {
                let normal =
                    unit(&self.vector(given)?).ok_or(Fault::new(&given.span, Problem::ZeroVector))?;
                Ok(Solid::Wall { normal, offset: dot(&normal, &self.vector(face)?) })
            }
            (Some(_), None, None, None) => Err(missing("radius")),
            (None, None, Some(_), None) => Err(missing("normal")),
            (of_ball, size, of_wall, out) => {
                let both = (of_ball.is_some() || size.is_some()) && (of_wall.is_some() || out.is_some());
                let reason = match both {
                    true => {
                        "it has keys of two kinds: a disc or ball has `centre` and `radius`, a wall `face` and `normal`; leave those of one out"
                    }
                    false => {
                        "an obstacle is a disc or ball, `centre` and `radius`, or a wall, `face` and `normal`"
                    }
                };
                Err(Fault::new(&table.span, Problem::OutOfPlace { reason: reason.into() }))
            }
        }
    }
}

/// Whether the leg, which stands on its anchor, is never clear of it. Sliders move away from theirs.
fn is_at_its_anchor(solid: &Solid, clearance: Interval, leg: &Leg) -> bool {
    let facts = leg.actuator.kind().facts();
    let stands = facts.has_elbow || facts.is_positive;
    stands && !solid.margin_of(&leg.anchor, clearance).is_positive()
}

//! Obstacles of a robot file.

use super::bodies::{ZERO, out_of_place};
use super::convert::Context;
use super::error::Problem;
use super::format::{At, RobotFile, hint};
use super::locate::Fault;
use super::tables::ObstacleTable;
use crate::frame::{dot, unit};
use crate::num::Interval;
use crate::{
    Body, Capsule, Clearance, Leg, LegIndex, Limit, LinkPart, MOST_BODIES, MOST_OBSTACLES, MOST_PAIRS,
    Platform, Robot, Shape, Solid,
};

/// What an obstacle is.
enum Obstacle {
    /// What a limit of each leg looks at.
    Solid(Solid),
    /// A body with two ends.
    Bar([[Interval; 3]; 2], Interval),
}

impl Context<'_> {
    /// Keeps a robot, which is complete but for them, clear of the obstacles.
    pub fn add_obstacles(&self, file: &RobotFile, robot: &mut Robot) -> Result<(), Fault> {
        let links: Vec<Capsule> = self.links(file)?.into_iter().map(|(link, _)| link).collect();
        for (k, table) in file.obstacles.iter().enumerate() {
            if k >= MOST_OBSTACLES {
                return Err(out_of_place(
                    &table.span,
                    format!("a robot has at most {MOST_OBSTACLES} obstacles"),
                ));
            }
            if self.platform == Platform::TurningBody {
                let reason = "the links of a `turning-body` are arcs round its centre, of any radius: they have no obstacles";
                return Err(out_of_place(&table.span, reason.into()));
            }
            let clearance = self.not_negative(&table.value.clearance, "a clearance")?;
            let layer = table.value.layer.as_ref().map(|layer| self.layer(layer)).transpose()?;
            let near = Near { number: k + 1, clearance, layer };
            let plates: Vec<Capsule> = platform_bodies(robot).collect();
            let as_body = |radius: Interval, shape: Shape| {
                (Capsule { body: Body::Obstacle(near.number), radius, layer, shape }, clearance)
            };
            match self.obstacle(table)? {
                Obstacle::Solid(solid) => {
                    let body = match solid {
                        Solid::Ball { centre, radius } => as_body(radius, Shape::Axis([centre; 2])),
                        Solid::Wall { normal, offset } => as_body(ZERO, Shape::Wall { normal, offset }),
                    };
                    self.keep_clear_of_body(robot, body, &plates, table)?;
                    near.keep_links_clear(robot, solid, &links, table)?;
                }
                Obstacle::Bar(ends, radius) => {
                    let bodies = [&links[..], &plates].concat();
                    self.keep_clear_of_body(robot, as_body(radius, Shape::Axis(ends)), &bodies, table)?;
                }
            }
        }
        Ok(())
    }

    /// Adds an obstacle as a body, and the pairs of it and of these; not if none of them can come to it.
    fn keep_clear_of_body(
        &self,
        robot: &mut Robot,
        (obstacle, clearance): (Capsule, Interval),
        bodies: &[Capsule],
        table: &At<ObstacleTable>,
    ) -> Result<(), Fault> {
        let there = bodies.iter().filter(|capsule| capsule.is_in(obstacle.layer));
        let pairs: Vec<_> = there.filter_map(|capsule| robot.pair([capsule, &obstacle], clearance)).collect();
        if pairs.is_empty() {
            return Ok(());
        }
        robot.bodies.push(obstacle);
        self.check_pairs(&table.span, robot, &pairs)?;
        robot.pairs.extend(pairs);
        if robot.pairs.len() > MOST_PAIRS || robot.bodies.len() > MOST_BODIES {
            let reason = format!(
                "a robot has at most {MOST_BODIES} bodies and {MOST_PAIRS} pairs of them that can meet"
            );
            return Err(out_of_place(&table.span, reason));
        }
        Ok(())
    }

    fn obstacle(&self, table: &At<ObstacleTable>) -> Result<Obstacle, Fault> {
        let missing =
            |key: &str| Fault::new(&table.span, Problem::MissingKey { key: key.into(), hint: hint(key) });
        let ObstacleTable { centre, ends, radius, face, normal, .. } = &table.value;
        match (centre, ends, radius, face, normal) {
            (Some(centre), None, Some(radius), None, None) => {
                let solid = Solid::Ball { centre: self.vector(centre)?, radius: self.length(radius)? };
                Ok(Obstacle::Solid(solid))
            }
            (None, Some(ends), radius, None, None) => {
                let both = self.ends(ends)?;
                if both[0] == both[1] {
                    let reason = "the ends of a bar are two points; a disc or ball has a `centre`";
                    return Err(out_of_place(&ends.span, reason.into()));
                }
                Ok(Obstacle::Bar(both, self.not_negative(radius, "a radius")?))
            }
            (None, None, None, Some(face), Some(given)) => {
                let normal =
                    unit(&self.vector(given)?).ok_or(Fault::new(&given.span, Problem::ZeroVector))?;
                Ok(Obstacle::Solid(Solid::Wall { normal, offset: dot(&normal, &self.vector(face)?) }))
            }
            (Some(_), None, None, None, None) => Err(missing("radius")),
            (None, None, None, Some(_), None) => Err(missing("normal")),
            (centre, ends, radius, face, normal) => {
                let of_wall = face.is_some() || normal.is_some();
                let both = centre.is_some() && ends.is_some()
                    || of_wall && (centre.is_some() || ends.is_some() || radius.is_some());
                let reason = match both {
                    true => {
                        "it has keys of two kinds: a disc or ball has `centre` and `radius`, a bar `ends` and `radius`, a wall `face` and `normal`; leave those of one out"
                    }
                    false => {
                        "an obstacle is a disc or ball, `centre` and `radius`, a bar, `ends` and `radius`, or a wall, `face` and `normal`"
                    }
                };
                Err(out_of_place(&table.span, reason.into()))
            }
        }
    }
}

/// What is said of any obstacle.
struct Near {
    number: usize,
    clearance: Interval,
    /// Its layer; none if it is in all.
    layer: Option<i32>,
}

impl Near {
    /// Gives each leg its limits at the obstacle.
    fn keep_links_clear(
        &self,
        robot: &mut Robot,
        solid: Solid,
        links: &[Capsule],
        table: &At<ObstacleTable>,
    ) -> Result<(), Fault> {
        for (j, leg) in robot.legs.iter_mut().enumerate() {
            let index = LegIndex::new(j);
            if self.is_at_its_anchor(&solid, leg, index, links) {
                let reason = format!(
                    "it reaches the anchor of leg {index}, so that no configuration is clear of it: move it, or lessen its clearance"
                );
                return Err(out_of_place(&table.span, reason));
            }
            for &part in solid.parts_of(leg) {
                // Crank and rod both have the elbow, that of a slider is an end of its rod alone.
                let bodies: &[Body] = match part {
                    LinkPart::Crank => &[Body::Crank(index)],
                    LinkPart::Elbow => &[Body::Crank(index), Body::Rod(index)],
                    LinkPart::Rod | LinkPart::End => &[Body::Rod(index)],
                };
                let there = links.iter().filter(|link| bodies.contains(&link.body) && link.is_in(self.layer));
                let Some(radius) = there.map(|link| link.radius).max_by(|a, b| a.hi.total_cmp(&b.hi)) else {
                    continue;
                };
                let distance = self.distance_from(radius);
                let clearance = Clearance { obstacle: self.number, solid, part, distance };
                if clearance.matters_to(leg) {
                    leg.limits.push(Limit::Clearance(clearance));
                }
            }
        }
        Ok(())
    }

    /// How far the axis of what has this radius stays away.
    fn distance_from(&self, radius: Interval) -> Interval {
        if radius.hi == 0.0 { self.clearance } else { self.clearance + radius }
    }

    /// Whether the link of a leg that stands on its anchor is never clear of it. Sliders move away from theirs.
    fn is_at_its_anchor(&self, solid: &Solid, leg: &Leg, index: LegIndex, links: &[Capsule]) -> bool {
        let facts = leg.actuator.kind().facts();
        let standing = match (facts.has_elbow, facts.is_positive) {
            (true, _) => Body::Crank(index),
            (false, true) => Body::Rod(index),
            (false, false) => return false,
        };
        let link = links.iter().find(|link| link.body == standing && link.is_in(self.layer));
        link.is_some_and(|link| !solid.margin_of(&leg.anchor, self.distance_from(link.radius)).is_positive())
    }
}

/// The bodies of the platform.
fn platform_bodies(robot: &Robot) -> impl Iterator<Item = Capsule> {
    robot.bodies.iter().filter(|capsule| matches!(capsule.body, Body::Platform(_))).copied()
}

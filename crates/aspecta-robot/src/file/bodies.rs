//! Bodies of a robot file.

use super::convert::Context;
use super::error::Problem;
use super::format::{At, LegTable, Number, RobotFile, Vector, hint};
use super::locate::Fault;
use super::tables::{CapsuleTable, LinkTable};
use crate::num::Interval;
use crate::text::brief;
use crate::{Body, BodyPair, Capsule, LegIndex, MOST_BODIES, MOST_PAIRS, Platform, Robot, Shape};
use std::ops::Range as Span;

pub(super) const ZERO: Interval = Interval::point(0.0);

/// The radius and the layer that a table says a link has, if it does.
type Said<'a> = [Option<&'a Number>; 2];

impl Context<'_> {
    /// Gives a robot its bodies and the pairs of them that keep clear, among them obstacles with two ends.
    pub fn add_bodies(&self, file: &RobotFile, robot: &mut Robot) -> Result<(), Fault> {
        let of_leg = file.legs.iter().find_map(|leg| leg.value.bodies.as_ref().map(|table| &table.span));
        let span = file.bodies.as_ref().map(|table| &table.span).or(of_leg);
        if let Some(span) = span.filter(|_| self.platform == Platform::TurningBody) {
            let reason =
                "the links of a `turning-body` are arcs round its centre, of any radius: they have no bodies";
            return Err(out_of_place(span, reason.into()));
        }
        let links = self.links(file)?;
        robot.bodies.extend(links.into_iter().filter(|(_, is_body)| *is_body).map(|(link, _)| link));
        let platform = file.bodies.iter().flat_map(|table| &table.value.platform);
        for (k, table) in platform.enumerate() {
            let capsule = self.capsule(table, Body::Platform(k + 1))?;
            robot.bodies.push(capsule);
        }
        let clearance = match &file.bodies {
            Some(table) => self.not_negative(&table.value.clearance, "a clearance")?,
            None => ZERO,
        };
        robot.pairs = robot.pairs_to_keep_apart(clearance);
        let too_many = match () {
            () if robot.bodies.len() > MOST_BODIES => {
                Some(format!("a robot has at most {MOST_BODIES} bodies"))
            }
            () if robot.pairs.len() > MOST_PAIRS => Some(format!(
                "there are {} pairs of bodies that can meet, and at most {MOST_PAIRS} are looked at: put them in layers, or give fewer links a radius",
                robot.pairs.len()
            )),
            () => None,
        };
        match (too_many, span) {
            (Some(reason), Some(span)) => Err(out_of_place(span, reason)),
            _ => self.check_pairs(span.unwrap_or(&file.platform.span), robot, &robot.pairs),
        }
    }

    /// Some configuration must be allowed; and in space, where two lines hardly ever meet, bodies have some thickness.
    pub fn check_pairs(&self, span: &Span<usize>, robot: &Robot, pairs: &[BodyPair]) -> Result<(), Fault> {
        for pair in pairs {
            if pair.is_thin() && robot.wall_of(pair).is_some() {
                let reason =
                    format!("{pair} have no thickness: give the body a radius, or a clearance above 0");
                return Err(out_of_place(span, reason));
            }
            if pair.is_thin() && self.platform.space() == 3 {
                let reason =
                    format!("{pair} have no thickness: in space, give a radius or a clearance above 0");
                return Err(out_of_place(span, reason));
            }
            if robot.always_touch(pair) {
                let reason = match pair.is_thin() {
                    true => format!(
                        "{pair} touch in every configuration, where they begin or end: move one of them"
                    ),
                    false => format!(
                        "{pair} touch in every configuration: where they begin or end they are nearer to one another than {} {}; lessen their radii or the clearance",
                        brief(pair.distance.mid()),
                        robot.length_unit
                    ),
                };
                return Err(out_of_place(span, reason));
            }
        }
        Ok(())
    }

    /// All links, thin ones where they have no radius, and whether they have one.
    pub fn links(&self, file: &RobotFile) -> Result<Vec<(Capsule, bool)>, Fault> {
        let legs = file.legs.iter().enumerate();
        let all =
            legs.map(|(j, leg)| self.links_of(file, leg, LegIndex::new(j))).collect::<Result<Vec<_>, _>>()?;
        let link = |(radius, thin): (Option<Interval>, Capsule)| {
            (Capsule { radius: radius.unwrap_or(ZERO), ..thin }, radius.is_some())
        };
        Ok(all.into_iter().flatten().map(link).collect())
    }

    /// The links of a leg, and their radii if they have some.
    fn links_of(
        &self,
        file: &RobotFile,
        leg: &At<LegTable>,
        j: LegIndex,
    ) -> Result<Vec<(Option<Interval>, Capsule)>, Fault> {
        let mut links = Vec::new();
        let facts = leg.value.actuator.value.kind.value.facts();
        let own = leg.value.bodies.as_ref().map(|table| &table.value);
        let crank = own.and_then(|own| own.crank.as_ref());
        if let Some(table) = crank.filter(|_| !facts.has_elbow) {
            let reason = format!("a `{}` leg has no crank: its body is the `rod`", facts.name);
            return Err(out_of_place(&table.span, reason));
        }
        let rod = own.and_then(|own| own.rod.as_ref());
        let whole = own.map_or([None; 2], |own| [own.radius.as_ref(), own.layer.as_ref()]);
        let all = file.bodies.as_ref().map(|table| &table.value);
        let all = all.map_or([None; 2], |all| [all.radius.as_ref(), all.layer.as_ref()]);
        for (exists, body, link) in
            [(facts.has_elbow, Body::Crank(j), crank), (facts.has_rod, Body::Rod(j), rod)]
        {
            let said = [link.map_or([None; 2], of_link), whole, all];
            let radius = said.iter().find_map(|[radius, _]| *radius);
            let layer = said.iter().find_map(|[_, layer]| *layer);
            let layer = layer.map(|layer| self.layer(layer)).transpose()?.or(self.first_layer());
            if exists {
                links.push((
                    radius.map(|radius| self.at_least_zero(radius, "a radius")).transpose()?,
                    Capsule { body, radius: ZERO, layer, shape: Shape::Link },
                ));
            }
        }
        Ok(links)
    }

    /// The layer of what is said to be in none.
    fn first_layer(&self) -> Option<i32> {
        (self.platform.space() == 2).then_some(0)
    }

    /// The number of a layer.
    pub fn layer(&self, layer: &Number) -> Result<i32, Fault> {
        let (number, fault) = (layer.value.0, |reason: &str| out_of_place(&layer.span, reason.into()));
        match () {
            () if self.platform.space() == 3 => Err(fault("only planar machines are built in layers")),
            () if number.fract() != 0.0 || number.abs() > 1000.0 => {
                Err(fault("a layer is a whole number, from -1000 to 1000"))
            }
            () => Ok(number as i32),
        }
    }

    /// A body of the platform.
    fn capsule(&self, table: &At<CapsuleTable>, body: Body) -> Result<Capsule, Fault> {
        let CapsuleTable { centre, ends, radius, layer } = &table.value;
        let radius = radius.as_ref().ok_or_else(|| missing(table, "radius"))?;
        let ends = match (centre, ends) {
            (Some(centre), None) => [self.vector(centre)?; 2],
            (None, Some(ends)) => self.ends(ends)?,
            (None, None) => return Err(missing(table, "ends")),
            (Some(_), Some(ends)) => {
                let reason = "a body has a `centre` or two `ends`; leave one out";
                return Err(out_of_place(&ends.span, reason.into()));
            }
        };
        let is_round = ends[0] == ends[1];
        let radius = if is_round { self.length(radius)? } else { self.at_least_zero(radius, "a radius")? };
        let layer = layer.as_ref().map(|layer| self.layer(layer)).transpose()?.or(self.first_layer());
        Ok(Capsule { body, radius, layer, shape: Shape::Axis(ends) })
    }

    /// The two ends of an axis.
    pub fn ends(&self, ends: &At<Vec<At<Vector>>>) -> Result<[[Interval; 3]; 2], Fault> {
        match &ends.value[..] {
            [from, to] => Ok([self.vector(from)?, self.vector(to)?]),
            _ => Err(out_of_place(&ends.span, "a body has two ends, ends = [[…], […]]".into())),
        }
    }

    /// A length that may be 0, which it is if left out.
    pub fn not_negative(&self, number: &Option<Number>, what: &str) -> Result<Interval, Fault> {
        number.as_ref().map_or(Ok(ZERO), |number| self.at_least_zero(number, what))
    }

    fn at_least_zero(&self, number: &Number, what: &str) -> Result<Interval, Fault> {
        match number.value.0 {
            0.0 => Ok(ZERO),
            x if x < 0.0 => Err(out_of_place(&number.span, format!("{what} is not negative"))),
            _ => self.length(number),
        }
    }
}

fn of_link(link: &At<LinkTable>) -> Said<'_> {
    [link.value.radius.as_ref(), link.value.layer.as_ref()]
}

fn missing<T>(table: &At<T>, key: &str) -> Fault {
    Fault::new(&table.span, Problem::MissingKey { key: key.into(), hint: hint(key) })
}

pub(super) fn out_of_place(span: &Span<usize>, reason: String) -> Fault {
    Fault::new(span, Problem::OutOfPlace { reason })
}

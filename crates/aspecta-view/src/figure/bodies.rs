//! Bodies in drawings of the robot: obstacles, and the thickness of what moves.

use super::parts::{BASE, CRANK, PLATFORM, ROD, SOLID};
use super::robot::{Drawing, View};
use super::shape::Shapes;
use super::skeleton::{Point, Skeleton, plus, times};
use aspecta::robot::{Body, Capsule, Robot, Solid};

impl View {
    /// A disc, ball or wall; of a wall in space nothing is drawn.
    fn solid(&self, shapes: &mut Shapes, solid: &Solid) {
        let style = format!("fill:{SOLID};stroke:{BASE};stroke-width:1");
        match solid {
            Solid::Ball { centre, radius } => {
                shapes.circle(self.at(centre.map(|x| x.mid())), self.pixels(radius.mid()), &style);
            }
            Solid::Wall { normal, offset } if self.flat => {
                let [nx, ny, _] = normal.map(|x| x.mid());
                let depth = |p: &[f64; 2]| offset.mid() - nx * p[0] - ny * p[1];
                let (x, y) = (self.chart.x.range, self.chart.y.range);
                let corners = [[x.0, y.0], [x.1, y.0], [x.1, y.1], [x.0, y.1]];
                let behind = cut(&corners, depth);
                let pixels: Vec<[f64; 2]> = behind.iter().map(|p| self.chart.at(*p)).collect();
                if !pixels.is_empty() {
                    shapes.polyline(&pixels, true, &style);
                }
            }
            Solid::Wall { .. } => {}
        }
    }

    /// How many pixels a length has.
    pub fn pixels(&self, length: f64) -> f64 {
        length * self.chart.width / self.chart.x.span()
    }
}

impl Drawing<'_> {
    /// The obstacles.
    pub fn solids(&self, shapes: &mut Shapes) {
        self.robot.obstacles().values().for_each(|solid| self.view.solid(shapes, solid));
        for capsule in &self.robot.bodies {
            if let (Body::Obstacle(_), Some([from, to])) = (capsule.body, bar(capsule)) {
                let ends = [from, to].map(|end| self.view.at(end));
                let width = 2.0 * self.view.pixels(capsule.radius.mid());
                let stroke = |colour: &str, width: f64| {
                    format!("stroke:{colour};stroke-width:{width:.1};stroke-linecap:round")
                };
                shapes.line(ends[0], ends[1], &stroke(BASE, width.max(1.5) + 2.0));
                shapes.line(ends[0], ends[1], &stroke(SOLID, width.max(1.5)));
            }
        }
    }

    /// The thickness of links and of bodies of the platform.
    pub fn thick(&self, shapes: &mut Shapes) {
        for capsule in &self.robot.bodies {
            let leg = capsule.body.leg().map(|j| &self.skeleton.legs[j.index()]);
            let (ends, colour) = match (capsule.body, leg, bar(capsule)) {
                (Body::Crank(_), Some(leg), _) => ([leg.a, leg.b.unwrap_or(leg.a)], CRANK),
                (Body::Rod(_), Some(leg), _) => ([leg.b.unwrap_or(leg.a), leg.c], ROD),
                (Body::Platform(_), _, Some(ends)) => {
                    (ends.map(|end| on_platform(self.skeleton, end)), PLATFORM)
                }
                (Body::Crank(_) | Body::Rod(_) | Body::Platform(_) | Body::Obstacle(_), ..) => continue,
            };
            let [from, to] = ends.map(|end| self.view.at(end));
            let width = 2.0 * self.view.pixels(capsule.radius.mid());
            let style =
                format!("stroke:{colour};stroke-opacity:0.25;stroke-width:{width:.1};stroke-linecap:round");
            shapes.line(from, to, &style);
        }
    }
}

/// The ends of a body that is no link.
fn bar(capsule: &Capsule) -> Option<[Point; 2]> {
    capsule.shape.ends().map(|ends| ends.map(|end| end.map(|x| x.mid())))
}

/// A point of the platform in the base.
fn on_platform(skeleton: &Skeleton, [x, y, z]: Point) -> Point {
    let [i, j, k] = skeleton.axes;
    plus(skeleton.origin, plus(times(x, i), plus(times(y, j), times(z, k))))
}

/// Points of round obstacles and of bars: a picture shows them all.
pub(super) fn solid_points(robot: &Robot) -> Vec<Point> {
    let round = robot.obstacles().into_values().flat_map(|solid| ends(&solid));
    let bars = robot.bodies.iter().filter(|capsule| matches!(capsule.body, Body::Obstacle(_)));
    round.chain(bars.filter_map(bar).flatten()).collect()
}

/// The part of a polygon where a linear function is not negative.
fn cut(polygon: &[[f64; 2]], f: impl Fn(&[f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let next = polygon.iter().cycle().skip(1);
    let side = |(a, b): (&[f64; 2], &[f64; 2])| {
        let (at_a, at_b) = (f(a), f(b));
        let t = at_a / (at_a - at_b);
        let between = (at_a * at_b < 0.0).then(|| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        (at_a >= 0.0).then_some(*a).into_iter().chain(between)
    };
    polygon.iter().zip(next).flat_map(side).collect()
}

/// The ends of a round obstacle along the axes.
fn ends(solid: &Solid) -> Vec<Point> {
    let Solid::Ball { centre, radius } = solid else { return Vec::new() };
    let end = |k: usize, side: f64| {
        std::array::from_fn(|i| centre[i].mid() + if i == k { side * radius.mid() } else { 0.0 })
    };
    (0..3).flat_map(|k| [end(k, 1.0), end(k, -1.0)]).collect()
}

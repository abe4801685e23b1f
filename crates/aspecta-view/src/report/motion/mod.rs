//! A motion to be watched: one standalone page with the robot, its aspect and the determinants together.
//!
//! Everything that is seen is computed here, for each frame; the page's script draws and computes nothing of
//! the robot.

mod backdrop;
mod page;
mod panel;
mod tracks;

use crate::figure::film::film;
use crate::figure::palette::INK;
use crate::figure::profile::{Curve, Plot, along, curves, runs};
use crate::figure::robot::signs;
use crate::figure::shape::Shapes;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, DetSign};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::{Obstacle, ProfilePoint};
use aspecta::robot::Robot;
use panel::Panel;
use tracks::Tracks;

/// Most frames of a page: of longer motions every second sample is shown, or every third, and so on.
const FRAMES: usize = 2000;
/// How long a motion without times is shown: seconds a segment, and the least and most of all.
const SHOWN: (f64, f64, f64) = (3.0, 5.0, 40.0);
/// Paths, and where the robot is.
const PATH: &str = "#8a1fb4";

/// A motion of a robot: its samples, and what is known of it.
pub struct Motion<'a> {
    robot: &'a Robot,
    frames: Vec<Frame>,
    /// Whether the times are those of the motion.
    timed: bool,
    obstacle: Option<&'a Obstacle>,
    analysis: Option<&'a Analysis>,
}

/// A sample.
#[derive(Clone)]
struct Frame {
    mode: WorkingMode,
    /// Determinants as in a profile, but over their largest moduli along the whole motion; segments are
    /// counted through.
    point: ProfilePoint,
    /// The sign of det A; none if it is 0.
    det_a: Option<DetSign>,
    /// Samples with the same number follow each other without a gap.
    run: usize,
    /// When it is shown, seconds from the start.
    seconds: f64,
}

impl<'a> Motion<'a> {
    /// A motion with no samples yet.
    pub fn new(robot: &'a Robot) -> Self {
        Self { robot, frames: Vec::new(), timed: false, obstacle: None, analysis: None }
    }

    /// Goes on in a working mode, from where the motion is. Segments of the profile are counted on from those
    /// before. Samples at which the robot has no determinants are left out.
    #[must_use]
    pub fn then(mut self, mode: WorkingMode, profile: &[ProfilePoint]) -> Self {
        let (before, run) = self.frames.last().map_or((0, 0), |f| (f.point.segment, f.run));
        for (k, samples) in runs(profile).enumerate() {
            for sample in samples {
                let Ok(jacobians) = self.robot.jacobians(&sample.pose, &sample.q) else { continue };
                let det_a = jacobians.det_a();
                let sign = DetSign::of(det_a);
                let point = ProfilePoint {
                    segment: before + sample.segment,
                    relative_det_a: det_a,
                    relative_b: jacobians.b,
                    ..sample.clone()
                };
                let det_a = (det_a != 0.0).then_some(sign);
                self.frames.push(Frame { mode, point, det_a, run: run + k, seconds: 0.0 });
            }
        }
        self
    }

    /// The times of all samples so far, in seconds, never decreasing; ignored if there are more or fewer.
    #[must_use]
    pub fn timed(mut self, seconds: &[f64]) -> Self {
        self.timed = seconds.len() == self.frames.len();
        if self.timed {
            self.frames.iter_mut().zip(seconds).for_each(|(frame, s)| frame.seconds = s - seconds[0]);
        }
        self
    }

    /// Returns the motion, in one working mode, with the place at which it fails, if it does.
    #[must_use]
    pub fn stopped_by(mut self, obstacle: Option<&'a Obstacle>) -> Self {
        self.obstacle = obstacle;
        self
    }

    /// Shows the aspects that the motion is in. Of slices and of robots with more than three coordinates they
    /// are not shown.
    #[must_use]
    pub fn within(mut self, analysis: &'a Analysis) -> Self {
        self.analysis = Some(analysis);
        self
    }

    /// The page: it opens from a file, with no network. Equal motions give equal pages.
    pub fn page(mut self) -> String {
        self.normalise();
        if !self.timed {
            self.pace();
        }
        let every = self.frames.len().div_ceil(FRAMES).max(1);
        let last = self.frames.len().saturating_sub(1);
        let mut k = 0..;
        self.frames.retain(|_| k.next().is_some_and(|k| k % every == 0 || k == last));
        let mut tracks = Tracks::default();
        let pictures = page::Pictures {
            robot: self.robot_panel(&mut tracks),
            aspect: self.analysis.and_then(|a| backdrop::panel(a, &self.frames, &mut tracks)),
            determinants: self.determinants_panel(&mut tracks),
        };
        page::page(&self, every, &pictures, tracks)
    }

    /// Divides the determinants by their largest moduli.
    fn normalise(&mut self) {
        let frames = &mut self.frames;
        let largest = |f: &dyn Fn(&ProfilePoint) -> f64| {
            let most = frames.iter().map(|frame| f(&frame.point).abs()).fold(0.0, f64::max);
            if most > 0.0 { most } else { 1.0 }
        };
        let det = largest(&|p| p.relative_det_a);
        let b: Vec<f64> = (0..self.robot.dof()).map(|j| largest(&|p| p.relative_b[j])).collect();
        for Frame { point, .. } in frames {
            point.relative_det_a /= det;
            point.relative_b.iter_mut().zip(&b).for_each(|(x, most)| *x /= most);
        }
    }

    /// Times at which the platform moves steadily: its translations, and its angles times the robot's
    /// characteristic length.
    fn pace(&mut self) {
        let coordinates = self.robot.platform.coordinates();
        let turns_only = coordinates.iter().all(|c| c.angle);
        let length = if turns_only { 1.0 } else { self.robot.characteristic_length() };
        let mut before: Option<Vec<f64>> = None;
        let mut way = 0.0;
        for frame in &mut self.frames {
            let pose =
                coordinates.iter().zip(&frame.point.pose).map(|(c, x)| if c.angle { x * length } else { *x });
            let pose: Vec<f64> = pose.collect();
            if let Some(before) = before {
                way += pose.iter().zip(before).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            }
            frame.seconds = way;
            before = Some(pose);
        }
        let segments = self.frames.last().map_or(0, |f| f.point.segment) as f64;
        let shown = (SHOWN.0 * segments).clamp(SHOWN.1, SHOWN.2);
        let scale = if way > 0.0 { shown / way } else { 0.0 };
        self.frames.iter_mut().for_each(|frame| frame.seconds *= scale);
    }

    fn robot_panel(&self, tracks: &mut Tracks) -> String {
        let configurations: Vec<(&[f64], &[f64])> =
            self.frames.iter().map(|f| (&f.point.pose[..], &f.point.q[..])).collect();
        let film = film(self.robot, &configurations);
        let mut panel = Panel::new(film.svg, tracks);
        panel.moving(&film.frames);
        panel.trail(&film.path, &breaks(&self.frames, |_, _| false), 3.0);
        panel.svg.finish()
    }

    fn determinants_panel(&self, tracks: &mut Tracks) -> String {
        let points: Vec<Vec<ProfilePoint>> = self
            .frames
            .chunk_by(|a, b| a.run == b.run)
            .map(|run| run.iter().map(|f| f.point.clone()).collect())
            .collect();
        let runs: Vec<&[ProfilePoint]> = points.iter().map(Vec::as_slice).collect();
        let plot = Plot {
            robot: self.robot,
            runs: &runs,
            obstacle: self.obstacle,
            points: usize::MAX,
            apart: false,
        };
        let (svg, chart) = plot.draw("det A and B along the motion");
        let mut panel = Panel::new(svg, tracks);
        for change in self.frames.windows(2).filter(|f| f[0].mode != f[1].mode) {
            let [x, top] = chart.at([along(&change[1].point), chart.y.range.1]);
            let bottom = top + chart.height;
            panel.svg.line(
                [x, top],
                [x, bottom],
                &format!("stroke:{INK};stroke-width:1;stroke-dasharray:1.5 2.5"),
            );
            let name = format!("({})", signs(&change[1].mode.to_string()));
            panel.svg.text([x + 4.0, bottom - 9.0], crate::figure::svg::Anchor::Start, 11.0, "", &name);
        }
        let curves = curves(self.robot);
        let cursor = |frame: &Frame| {
            let at = |value: f64| chart.at([along(&frame.point), value]);
            let mut shapes = Shapes::default();
            let (low, high) = chart.y.range;
            shapes.line(at(low), at(high), &format!("stroke:{PATH};stroke-width:1.5"));
            for Curve { value, colour, .. } in &curves {
                shapes.circle(
                    at(value(&frame.point)),
                    4.0,
                    &format!("fill:{colour};stroke:#fff;stroke-width:1.2"),
                );
            }
            shapes
        };
        panel.moving(&self.frames.iter().map(cursor).collect::<Vec<_>>());
        panel.svg.finish()
    }
}

/// The frames before which there is a gap, or a jump from the frame before.
fn breaks(frames: &[Frame], jumps: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    (1..frames.len()).filter(|&k| frames[k - 1].run != frames[k].run || jumps(k - 1, k)).collect()
}

//! The page of a motion.

use super::tracks::Tracks;
use super::{Frame, Motion};
use crate::figure::profile::curves;
use crate::figure::robot::signs;
use crate::figure::survey::coordinate_name;
use aspecta::text::subscript;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("motion.css");
const SCRIPT: &str = include_str!("motion.js");
/// Decimals of determinants, angles (rad) and times (s).
const DECIMALS: usize = 4;
/// Significant digits of lengths.
const DIGITS: i32 = 6;

/// The pictures of the page, as SVG.
pub struct Pictures {
    pub robot: String,
    pub aspect: Option<String>,
    pub determinants: String,
}

/// The whole page, of every `every`-th sample.
pub fn page(motion: &Motion<'_>, every: usize, pictures: &Pictures, tracks: Tracks) -> String {
    let mut readout = Readout { frames: &motion.frames, tracks };
    let robot = motion.robot;
    let title = if robot.title.is_empty() { &robot.name } else { &robot.title };
    let values = values(motion, &mut readout);
    let controls = controls(motion, &mut readout);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Motion of " (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { "Motion of " (title) }
                    p { (summary(motion, every)) }
                }
                @if motion.frames.is_empty() {
                    p { "No sample of the motion is within reach, so there is nothing to watch." }
                } @else {
                    main {
                        (controls)
                        div.panes.two[pictures.aspect.is_none()] {
                            figure { (PreEscaped(&pictures.robot)) figcaption { "The robot, and the path of its platform." } }
                            @if let Some(aspect) = &pictures.aspect {
                                figure { (PreEscaped(aspect)) figcaption { (aspect_caption(motion)) } }
                            }
                            figure { (PreEscaped(&pictures.determinants)) figcaption {
                                "Near 0 the robot is near a singularity: det A parallel, B" sub { "jj" } " serial. Numerical."
                            } }
                            (values)
                        }
                    }
                    script #motion type="application/json" { (PreEscaped(readout.json())) }
                    script { (PreEscaped(SCRIPT)) }
                }
            }
        }
    };
    page.into_string()
}

fn summary(motion: &Motion<'_>, every: usize) -> Markup {
    let segments = motion.frames.last().map_or(0, |f| f.point.segment);
    let mut modes: Vec<String> =
        motion.frames.iter().map(|f| format!("({})", signs(&f.mode.to_string()))).collect();
    modes.dedup();
    html! {
        (segments) @if segments == 1 { " segment" } @else { " segments" }
        ", working " @if modes.len() == 1 { "mode " } @else { "modes " } (modes.join(", then ")) ". "
        @if every > 1 { "One of " (every) " samples is shown. " }
        @if let Some(obstacle) = motion.obstacle {
            strong { "In segment " (obstacle.segment) ": " (obstacle.in_words(motion.robot)) "." }
        }
    }
}

fn aspect_caption(motion: &Motion<'_>) -> Markup {
    let axes = motion.robot.platform.coordinates();
    html! {
        "Aspects of the current mode and sign of det A: coloured cells, certified; pale are those the robot is not in. "
        @if let Some(third) = axes.get(2) {
            "The section follows " (coordinate_name(third.name)) "."
        }
    }
}

fn controls(motion: &Motion<'_>, readout: &mut Readout<'_>) -> Markup {
    let last = motion.frames.len().saturating_sub(1);
    let seconds = readout.number(3, |f| f.seconds);
    let segment = readout.number(0, |f| f.point.segment as f64);
    let t = readout.number(3, |f| f.point.t);
    html! {
        div.controls role="group" aria-label="Playback" {
            button #play type="button" { "Play" }
            input #slider type="range" min="0" max=(last) value="0" step="1" aria-label="Sample of the motion";
            label { "Speed " select #speed {
                @for (value, text) in [("0.25", "¼×"), ("0.5", "½×"), ("1", "1×"), ("2", "2×"), ("4", "4×")] {
                    option value=(value) selected[value == "1"] { (text) }
                }
            } }
            span.now { "segment " (segment) ", t = " (t) @if motion.timed { ", " (seconds) " s" } }
            span.keys { "Space plays, ← → step, Home and End go to the ends." }
        }
        noscript { p { "Without script the first sample is shown." } }
    }
}

/// The current pose, joints and determinants.
fn values(motion: &Motion<'_>, readout: &mut Readout<'_>) -> Markup {
    let robot = motion.robot;
    let unit = |angle: bool| if angle { "rad" } else { &robot.length_unit };
    let mut curves = curves(robot).into_iter();
    let det = curves.next();
    html! {
        div.values {
            table {
                caption { "Pose and working mode" }
                tbody {
                    @for (k, c) in robot.platform.coordinates().iter().enumerate() {
                        tr {
                            th scope="row" { (coordinate_name(c.name)) }
                            td.number { (readout.quantity(c.angle, |f| f.point.pose[k])) }
                            td { (unit(c.angle)) }
                        }
                    }
                    tr { th scope="row" { "mode" } td.number { (readout.mode()) } td {} }
                    @if let Some(det) = det {
                        tr {
                            th scope="row" { (det.name) }
                            td.number { (readout.number(DECIMALS, |f| f.point.relative_det_a)) }
                            td { "of its largest" }
                        }
                    }
                }
            }
            table {
                caption { "Joints, and B" sub { "jj" } " over their largest" }
                tbody {
                    @for (k, (leg, b)) in robot.legs.iter().zip(curves).enumerate() {
                        tr {
                            th scope="row" { "q" (subscript(k + 1)) }
                            td.number { (readout.quantity(leg.actuator.is_angle(), |f| f.point.q[k])) }
                            td { (unit(leg.actuator.is_angle())) }
                            th scope="row" { span.swatch style={ "background:" (b.colour) } {} (b.name) }
                            td.number { (readout.number(DECIMALS, |f| f.point.relative_b[k])) }
                        }
                    }
                }
            }
        }
    }
}

/// Texts that change with the frame.
struct Readout<'a> {
    frames: &'a [Frame],
    tracks: Tracks,
}

impl Readout<'_> {
    /// A number with so many decimals.
    fn number(&mut self, decimals: usize, value: impl Fn(&Frame) -> f64) -> Markup {
        let scale = 10_f64.powi(decimals as i32);
        let track = self.tracks.add(self.frames.iter().map(&value), scale);
        let first = self.frames.first().map_or(0.0, value);
        let text = format!("{:.decimals$}", (first * scale).round() / scale + 0.0).replace('-', "−");
        html! { span data-number=(track) data-decimals=(decimals) { (text) } }
    }

    /// An angle (rad), or a length with as many decimals as its largest modulus needs.
    fn quantity(&mut self, angle: bool, value: impl Fn(&Frame) -> f64) -> Markup {
        let most = self.frames.iter().map(|f| value(f).abs()).fold(0.0, f64::max);
        let before = if most > 0.0 { most.log10().floor() as i32 + 1 } else { 1 };
        let decimals = if angle { DECIMALS } else { (DIGITS - before).clamp(0, 12) as usize };
        self.number(decimals, value)
    }

    /// The working mode.
    fn mode(&mut self) -> Markup {
        let mut modes: Vec<_> = self.frames.iter().map(|f| f.mode).collect();
        modes.sort_unstable();
        modes.dedup();
        let number = |f: &Frame| modes.iter().position(|m| *m == f.mode).unwrap_or(0);
        let track = self.tracks.add(self.frames.iter().map(|f| number(f) as f64), 1.0);
        let first = self.frames.first().map_or(0, number);
        html! {
            @for (k, mode) in modes.iter().enumerate() {
                span data-switch=(track) data-case=(k) style=[(k != first).then_some("display:none")] {
                    "(" (signs(&mode.to_string())) ")"
                }
            }
        }
    }

    /// Returns the data that the script needs, as JSON.
    fn json(mut self) -> String {
        let clock = self.tracks.add(self.frames.iter().map(|f| f.seconds), 1000.0);
        format!("{{\"frames\":{},\"clock\":{clock},\"tracks\":{}}}", self.frames.len(), self.tracks.json())
    }
}

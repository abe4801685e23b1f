//! The page itself.

use super::doubts;
use super::tables::{self, bounds};
use super::{Figure, Figures, FlatFigures};
use crate::figure::robot::signs;
use crate::figure::survey::{coordinate_name, slice_name};
use crate::words::{self, measure_unit, number};
use aspecta::aspect::{Analysis, Run};
use aspecta::paving::Stop;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("page.css");
const TABS: &str = include_str!("tabs.js");
const VIEWER: &str = include_str!("../../viewer/dist/viewer.js");

/// The whole page. `volume` is the packed volume of a robot with three free coordinates.
pub fn page(analysis: &Analysis, figures: &Figures, volume: Option<&str>) -> String {
    let robot = &analysis.robot;
    let title = if robot.title.is_empty() { &robot.name } else { &robot.title };
    let slice = slice_name(&analysis.fixed).map_or(String::new(), |slice| format!(", {slice}"));
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Aspects of " (title) (slice) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { "Working modes and aspects of " (title) (slice) }
                    @if !robot.source.is_empty() { p { "Figures of the robot: " (robot.source) } }
                    p.lead.result { (summary(analysis)) }
                    (navigation(analysis))
                }
                main {
                    (robot_section(analysis, figures))
                    (modes_section(analysis, figures))
                    (counts_section(analysis))
                    @if let Some(strips) = &figures.strips { (strips_section(strips)) }
                    @if let Some(flat) = &figures.flat { (maps_section(analysis, flat)) }
                    @if let Some(volume) = volume { (volume_section(analysis, figures, volume)) }
                    (earlier_section(analysis, figures))
                    (certified_section())
                    (run_section(&analysis.run, robot.platform.coordinates().iter().map(|c| c.name)))
                }
                script { (PreEscaped(TABS)) }
                @if volume.is_some() { script { (PreEscaped(VIEWER)) } }
            }
        }
    };
    page.into_string()
}

fn summary(analysis: &Analysis) -> Markup {
    let count = analysis.aspects;
    let (measure, undecided) =
        analysis.classes.iter().fold((0.0, 0.0), |s, c| (s.0 + c.measure, s.1 + c.undecided));
    let share = if measure + undecided > 0.0 { 100.0 * undecided / (measure + undecided) } else { 0.0 };
    html! {
        @match slice_name(&analysis.fixed) {
            Some(slice) => { "In the " (slice) " this robot has " }
            None => { "This robot has " }
        }
        strong { (bounds(count.low, count.high)) @if count.high == Some(1) { " generalized aspect" } @else { " generalized aspects" } } " in "
        (words::count(analysis.modes.len(), "working mode", "working modes")) " (proved). "
        "An aspect is a largest domain in which the robot can move without meeting a singularity and without changing the \
         solution of its inverse model. "
        @if !analysis.fixed.is_empty() { "Here the robot moves within the slice, while det A is that of the whole robot: each aspect of the slice lies in \
         one aspect of the robot, and several may lie in the same. " }
        "Of the " (analysis.measure.name) " where aspects can be, "
        (format!("{share:.2}")) " % is undecided at this resolution"
        @if count.high.is_none() { "; the undecided cells may hide or separate further aspects, so no upper bound is proved" }
        "."
    }
}

fn navigation(analysis: &Analysis) -> Markup {
    html! {
        nav aria-label="Sections" {
            a href="#robot" { "Robot" } a href="#modes" { "Working modes" } a href="#counts" { "Aspects in numbers" }
            @match analysis.window.axes().len() {
                3 => a href="#space" { "Slices and 3-D view" },
                2 if has_q(analysis) => a href="#maps" { "W- and Q-aspects" },
                _ => a href="#maps" { "W-aspects" },
            }
            a href="#earlier" { "Definitions 5 and 6" } a href="#certified" { "What is certified" } a href="#run" { "The run" }
        }
    }
}

fn figure(figure: &Figure, caption: Markup) -> Markup {
    html! {
        figure {
            (PreEscaped(&figure.1))
            figcaption { (caption) " " a href={ "figures/" (figure.0) ".svg" } { "SVG" } }
        }
    }
}

fn robot_section(analysis: &Analysis, figures: &Figures) -> Markup {
    html! {
        section #robot {
            h2 { "The robot" }
            @match &figures.robot {
                Some(drawing) => (figure(drawing, html! {
                    "The robot in a sample pose. A" sub { "i" } " are the base joints, B" sub { "i" } " the ends of the driven \
                     links, C" sub { "i" } " the platform's joints; black: base frame" @if analysis.robot.platform.coordinates().iter().any(|c| c.angle) { ", green: platform frame" } "."
                })),
                None => p { "No configuration within the limits was found, so the robot is not drawn." },
            }
            div.scroll { (tables::legs(analysis)) }
        }
    }
}

fn modes_section(analysis: &Analysis, figures: &Figures) -> Markup {
    html! {
        section #modes {
            h2 { "Working modes" }
            p { "A working mode (Definition 7) keeps the sign of every B" sub { "jj" } " = ∂f" sub { "j" } "/∂q" sub { "j" }
                ": each leg keeps its elbow on one side. Within a mode a pose has one joint vector at most." }
            div.scroll { (tables::modes(analysis)) }
            (figure(&figures.postures, html! { "Each working mode in its sample configuration (figure 8 of the paper)." }))
        }
    }
}

fn counts_section(analysis: &Analysis) -> Markup {
    html! {
        section #counts {
            h2 { "Generalized aspects in numbers" }
            p { "A generalized aspect (Definition 8) is a largest connected set of configurations in one working mode with det A ≠ 0. \
                 Its projections are the W-aspect (poses) and the Q-aspect (joint vectors)." }
            div.scroll { (tables::classes(analysis)) }
            @for remark in aspecta::text::remarks(analysis) { p { (remark) } }
            (doubts::table(analysis))
            details open[analysis.aspects.low <= 24] {
                summary { "All " (words::count(analysis.aspects.low, "proved aspect", "proved aspects")) }
                div.scroll { (tables::aspects(analysis)) }
            }
        }
    }
}

/// Whether figures show the joint space: where it is a plane, as the poses are.
fn has_q(analysis: &Analysis) -> bool {
    analysis.robot.dof() == 2
}

fn strips_section(strips: &Figure) -> Markup {
    html! {
        section #maps {
            h2 { "W-aspects" }
            (figure(strips, html! {
                "All aspects along the coordinate that varies: one strip a working mode and sign of det A. A colour and number is one aspect. Parts \
                 shorter than a pixel are drawn a pixel long."
            }))
        }
    }
}

fn maps_section(analysis: &Analysis, flat: &FlatFigures) -> Markup {
    let names: Vec<String> = analysis
        .classes
        .iter()
        .map(|c| format!("({}) {}", signs(&c.mode.to_string()), crate::figure::maps::sign_text(c.det_a)))
        .collect();
    html! {
        section #maps {
            h2 { @if has_q(analysis) { "W-aspects and Q-aspects" } @else { "W-aspects" } }
            (figure(&flat.overview, html! {
                "All aspects" @if analysis.fixed.is_empty() { " (figure 9 of the paper)" }
                ": of each working mode det A > 0 on the left and det A < 0 on the right of it"
                @if has_q(analysis) { "; in each pair the poses (W) and their joint vectors (Q). A colour and number is one aspect, the same in W and \
                 Q. Q wraps round at ±π." } @else { ". A colour and number is one aspect." }
            }))
            p { "One by one:" }
            (tabs("class", &names, &flat.classes, |k| {
                let c = &analysis.classes[k];
                html! { "Mode (" (signs(&c.mode.to_string())) "), " (crate::figure::maps::sign_text(c.det_a)) ": "
                    (bounds(c.low, c.high)) " (certified), " (number(c.measure)) " " (measure_unit(&analysis.measure)) " proved inside, "
                    (number(c.undecided)) " undecided. Solid: parallel singularities, where the platform moves with locked motors; \
                    dashed: serial singularities, where a leg is stretched or folded." }
            }))
        }
    }
}

fn tabs(id: &str, names: &[String], figures: &[Figure], caption: impl Fn(usize) -> Markup) -> Markup {
    html! {
        div.tabs role="tablist" { @for (k, name) in names.iter().enumerate() {
            button type="button" role="tab" id={ (id) "-tab-" (k) } aria-controls={ (id) "-panel-" (k) } { (name) }
        } }
        @for (k, f) in figures.iter().enumerate() {
            div role="tabpanel" id={ (id) "-panel-" (k) } aria-labelledby={ (id) "-tab-" (k) } { (figure(f, caption(k))) }
        }
    }
}

fn volume_section(analysis: &Analysis, figures: &Figures, volume: &str) -> Markup {
    let names: Vec<String> =
        analysis.modes.iter().map(|m| format!("Mf{} ({})", m.number, signs(&m.mode.to_string()))).collect();
    html! {
        section #space {
            h2 { "Slices and 3-D view" }
            p { "Left: a slice of the workspace; move the slider to scroll through it. Right: the certified inner cells of each aspect \
                 as a surface (its stairs smoothed, so the picture is numerical); drag to turn, wheel to zoom. The grey plane is the slice." }
            div #explorer {}
            noscript { p { "The slider and the 3-D view need JavaScript; the slices below do not." } }
            script #volume type="application/json" { (PreEscaped(volume)) }
            p { "Nine slices of each mode, with the singular curves:" }
            (tabs("slices", &names, &figures.slices, |k| html! {
                "Mode (" (signs(&analysis.modes[k].mode.to_string())) "): slices across the third free coordinate, both signs of det A. \
                 Solid: det A = 0; dashed: a leg stretched or folded."
            }))
        }
    }
}

fn earlier_section(analysis: &Analysis, figures: &Figures) -> Markup {
    html! {
        section #earlier {
            h2 { "Why not the earlier definitions: parallel and serial aspects" }
            p { "Parallel aspects (Definition 5) divide the poses by the sign of det A; serial aspects (Definition 6) divide the joint \
                 vectors by the signs of the B" sub { "jj" } ". Each was made for robots with one solution of the inverse, or of the \
                 direct, model. This robot has several of both, and then neither tells its solutions apart." }
            @if analysis.parallel_aspects.is_empty() { p { "They are left out here: " (aspecta::text::EARLIER_NEED) "." } }
            @if let Some([parallel, serial]) = figures.flat.as_ref().and_then(|flat| flat.earlier.as_ref()) {
                (figure(parallel, html! {
                    "Definition 5 (figures 6 and 7 of the paper): all configurations with det A of one sign, in W" @if has_q(analysis) { " and in Q" } ". Shades count the \
                     configurations over a place. More than one over a pose: the domain holds several inverse solutions and does \
                     not separate them. In W both signs share " (number(analysis.parallel_aspects.first().map_or(0.0, |e| e.overlap))) " "
                    (measure_unit(&analysis.measure)) " (certified): there the sign of det A says nothing about where the robot is."
                }))
                (figure(serial, html! {
                    "Definition 6: all configurations of one working mode, in W"
                    @if has_q(analysis) { " and in Q. Two over a joint vector: the domain holds several direct solutions and does not separate them" }
                    ". The grey lines within are the undecided cells along det A = 0."
                }))
            }
            @if !analysis.parallel_aspects.is_empty() { div.scroll { (tables::earlier(analysis)) } }
        }
    }
}

fn certified_section() -> Markup {
    html! {
        section #certified {
            h2 { "What is certified, and what is numerical" }
            dl {
                dt { "Certified" }
                dd { "Proved with interval arithmetic that encloses all rounding: the bounds on the number of aspects; that a coloured cell lies \
                      in its aspect; that white places of W are in no aspect of the class; the inner measures, up to the rounding of their sum; \
                      the modes said to be reachable or not; the bounds of the W-aspects." }
                dt { "Undecided" }
                dd { "Grey cells: whether they belong to an aspect is not decided at this resolution. They lie along the boundaries; a larger \
                      budget makes them thinner. Where cells are finer than the picture, a pixel shows the first it holds of: undecided, aspect, \
                      nothing." }
                dt { "Numerical" }
                dd { "Computed in ordinary floating point and proved by nothing: the singular curves, the Q-aspects (images of the cells), \
                      postures and drawings, the smoothed surfaces of the 3-D view, the counts of Definitions 5 and 6." }
            }
        }
    }
}

fn run_section<'a>(run: &Run, names: impl Iterator<Item = &'a str>) -> Markup {
    let stop = match run.stop {
        Stop::Exact => "the bounds on the number of aspects met",
        Stop::Resolution => "the resolution asked for was reached",
        Stop::Boxes => "the budget of boxes was spent",
        Stop::Time => "the budget of time was spent, or too little of it was left for the next step",
        Stop::Cancelled => "it was cancelled; this is the result so far",
    };
    let widths = names
        .zip(&run.resolution)
        .filter(|(_, width)| **width > 0.0)
        .map(|(n, &w)| format!("{} {}", coordinate_name(n), number(w)));
    html! {
        section #run {
            h2 { "The run" }
            p { (run.boxes) " boxes classified in " (format!("{:.2}", run.seconds)) " s, " (run.depth) " subdivisions deep; finest cells: "
                (widths.collect::<Vec<_>>().join(", ")) ". It ended because " (stop) ". Aspecta " (env!("CARGO_PKG_VERSION")) "." }
            p { "Theory: D. Chablat and P. Wenger, " cite { "Séparation des solutions aux modèles géométriques direct et inverse pour les \
                 manipulateurs pleinement parallèles" } ", Mechanism and Machine Theory 36(6), 2001." }
        }
    }
}

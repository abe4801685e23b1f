//! Analyses, and what is asked of an analysed robot.

use crate::error;
use crate::map::Map;
use crate::threads;
use crate::watch::{watched, watched_within};
use aspecta::domain::{DomainOptions, Surfaces};
use aspecta::kinematics::constraints::Margins;
use aspecta::motion::modes::Configuration;
use aspecta::text::{AnalysisAdvice, AnalysisSummary};
use aspecta::{
    AspectId, ClassId, Control, MappedAspect, ModeGraph, PathCheck, PlanOptions, Planner, PoseSet, Route,
    RouteSummary, WorkingMode,
};
use pyo3::prelude::*;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;

/// Where the rows are that the tables leave out.
const ADVICE: AnalysisAdvice =
    AnalysisAdvice { on_aspects: ": see `to_dict()`", on_doubts: " (`to_dict()` lists all)" };

/// The result of `analyze`.
#[pyclass(frozen, module = "aspecta._native")]
pub struct Analysis(Arc<aspecta::Analysis>);

impl From<aspecta::Analysis> for Analysis {
    fn from(analysis: aspecta::Analysis) -> Self {
        Self(Arc::new(analysis))
    }
}

/// A planned motion: its JSON, its summary, and its pieces as `trajectory` takes them.
pub type Planned = (String, String, Vec<Piece>);

/// Modes, poses and joint vectors along a smooth piece of a motion.
pub type Piece = (Vec<String>, Vec<Vec<f64>>, Vec<Vec<f64>>);

/// Cells of a class: lower corners, upper corners, the aspect of each (0: undecided).
type Cells = (Vec<[f64; 3]>, Vec<[f64; 3]>, Vec<usize>);

#[pymethods]
impl Analysis {
    fn json(&self) -> PyResult<String> {
        error::json(&*self.0)
    }

    /// The tables of the terminal.
    fn text(&self, degrees: bool) -> String {
        AnalysisSummary { analysis: &self.0, degrees, advice: ADVICE }.to_string()
    }

    /// The coordinates that vary.
    #[getter]
    fn axes(&self) -> Vec<usize> {
        self.0.window.axes()
    }

    /// The class of a mode and a sign of det A.
    fn class_of(&self, mode: &str, det_a: f64) -> PyResult<Option<usize>> {
        let mode: WorkingMode = mode.parse().map_err(error::of)?;
        Ok(self.0.class_of(mode, aspecta::DetSign::of(det_a)).map(ClassId::index))
    }

    /// The aspect of a class that a pose lies in.
    fn aspect_at(&self, pose: Vec<f64>, class: usize) -> Option<usize> {
        self.0.aspect_at(&pose, ClassId::new(class)).map(AspectId::number)
    }

    /// The cells of a class that are not outside it.
    fn cells(&self, class: usize) -> Cells {
        let cells = self.0.cells(ClassId::new(class));
        let corners = |corner: fn(&aspecta::aspect::Cell) -> [f64; 3]| cells.iter().map(corner).collect();
        let aspects = cells.iter().map(|cell| cell.aspect.map_or(0, AspectId::number)).collect();
        (corners(|cell| cell.lo), corners(|cell| cell.hi), aspects)
    }

    /// The picture of the aspects of a robot or a slice with one or two coordinates, as SVG.
    fn picture(&self, py: Python<'_>) -> Option<String> {
        threads::detached(py, || aspecta_view::report::overview(&self.0))
    }

    /// The proof of the count, as JSON, if it was kept.
    fn certificate(&self) -> PyResult<Option<String>> {
        self.0.certificate.as_ref().map(aspecta::Certificate::to_json).transpose().map_err(error::of)
    }

    /// Writes the report into a directory; returns the paths written.
    fn report(&self, py: Python<'_>, directory: PathBuf) -> PyResult<Vec<PathBuf>> {
        let written = threads::detached(py, || aspecta_view::write_report(&self.0, &directory));
        written.map_err(|reason| error::at(&directory, reason))
    }

    /// The map of some aspects.
    #[expect(clippy::too_many_arguments, reason = "an argument is a keyword of Python's")]
    fn domains(
        &self,
        py: Python<'_>,
        aspects: Vec<usize>,
        cells: Option<usize>,
        samples: Option<usize>,
        surfaces: Option<bool>,
        seconds: Option<f64>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let analysis = Arc::clone(&self.0);
        let usual = DomainOptions::usual(&analysis.robot, analysis.window.axes().len());
        let options =
            DomainOptions { cells: cells.unwrap_or(usual.cells), samples: samples.unwrap_or(usual.samples) };
        // Curves take no time; surfaces may take as long as the regions.
        let with_surfaces = surfaces.unwrap_or(analysis.window.axes().len() == 2);
        let found = watched_within(py, seconds, progress.as_ref(), move |control| {
            let mut sheets = Vec::new();
            for number in aspects {
                match mapped(&analysis, AspectId::new(number), &options, with_surfaces, control) {
                    Ok(sheet) => sheets.push(sheet),
                    // What is done is kept.
                    Err(_) if control.is_cancelled() => break,
                    Err(error) => return Err(error),
                }
            }
            Ok(aspecta::Map::new(&analysis, sheets))
        })?;
        found.or_partial(py, |map| Ok(Map::from(map.map_err(error::of)?)))
    }

    /// The graph of aspects and changes of mode, as JSON and as SVG.
    fn modes(
        &self,
        py: Python<'_>,
        seconds: Option<f64>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let (analysis, robot) = (Arc::clone(&self.0), self.0.robot.clone());
        let look = move |control: &Control<'_>| ModeGraph::new(&analysis, control);
        let found = watched_within(py, seconds, progress.as_ref(), look)?;
        found
            .or_partial(py, move |graph| Ok((error::json(&graph)?, aspecta_view::mode_graph(&robot, &graph))))
    }

    /// Which aspects hold a set of poses, as JSON: `kind` is `box`, `round`, `poses` or `paths`.
    #[expect(clippy::too_many_arguments, reason = "the parts of a set of poses, of which each kind has some")]
    fn traverse(
        &self,
        py: Python<'_>,
        kind: &str,
        ranges: Vec<(f64, f64)>,
        round: Vec<usize>,
        radius: f64,
        lists: Vec<Vec<Vec<f64>>>,
        through_modes: bool,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let set = match kind {
            "box" => PoseSet::Box(ranges),
            "round" => PoseSet::round(ranges, round, radius),
            "poses" => PoseSet::Poses(lists.into_iter().flatten().collect()),
            _ => PoseSet::Paths(lists),
        };
        let analysis = Arc::clone(&self.0);
        let found = watched(py, progress.as_ref(), move |control| {
            let graph = through_modes.then(|| ModeGraph::new(&analysis, control));
            aspecta::traversability(&analysis, graph.as_ref(), set)
        })?;
        error::json(&found.whole()?.map_err(error::of)?)
    }

    /// The direct solutions of a joint vector by aspect, as JSON.
    fn assembly(&self, py: Python<'_>, q: Vec<f64>) -> PyResult<String> {
        let analysis = Arc::clone(&self.0);
        let found = watched(py, None, move |_| aspecta::assembly_modes(&analysis, &q))?;
        error::json(&found.whole()?.map_err(error::of)?)
    }

    /// A motion between two configurations; through changes of mode if these differ or `through` says so, which are looked for
    /// so many seconds.
    #[expect(clippy::too_many_arguments, reason = "an argument is a keyword of Python's")]
    fn plan(
        &self,
        py: Python<'_>,
        ends: [Vec<f64>; 2],
        modes: [String; 2],
        through: bool,
        wanted: Wanted,
        seconds: Option<f64>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Planned> {
        let mode = |signs: &str| signs.parse::<WorkingMode>().map_err(error::of);
        let (from, to) = (mode(&modes[0])?, mode(&modes[1])?);
        let (analysis, options) = (Arc::clone(&self.0), plan_options(wanted));
        let found = watched_within(py, seconds, progress.as_ref(), move |control| {
            let mut planner = Planner::new(&analysis);
            if !through && from == to {
                return Ok(planner.plan(&ends[0], &ends[1], from, &options)?.into());
            }
            let graph = ModeGraph::new(&analysis, control);
            let [start, goal] =
                [(&ends[0], from), (&ends[1], to)].map(|(pose, mode)| Configuration { pose, mode });
            planner.route(&graph, start, goal, &options)
        })?;
        planned(&found.whole()?.map_err(|refusal| error::no_plan(py, &refusal))?)
    }
}

/// An aspect cut into its regions, and the surfaces that bound them if they are wanted.
fn mapped(
    analysis: &aspecta::Analysis,
    id: AspectId,
    options: &DomainOptions,
    with_surfaces: bool,
    control: &Control<'_>,
) -> Result<MappedAspect, aspecta::Error> {
    let domains = aspecta::domains(analysis, id, options, control)?;
    if !with_surfaces {
        return Ok(MappedAspect { domains, surfaces: None });
    }
    let surfaces = Surfaces::of(analysis, &domains, options.cells)?;
    Ok(MappedAspect::with_surfaces(domains, surfaces, &analysis.window))
}

/// The weight of nearness to singularities, and the margins from parallel and serial ones.
pub type Wanted = (f64, f64, f64);

pub fn plan_options((weight, parallel, serial): Wanted) -> PlanOptions {
    PlanOptions { weight, margins: Margins { parallel, serial } }
}

#[derive(Serialize)]
struct Checked<'a> {
    #[serde(flatten)]
    route: &'a Route,
    /// Whether the checks below, and each crossing anew, prove it.
    proved: bool,
    checks: &'a [PathCheck],
}

/// A route as it is returned, checked once more.
pub fn planned(route: &Route) -> PyResult<Planned> {
    let checks = route.checks().map_err(error::of)?;
    let proved = route.is_proved(&checks);
    let text = RouteSummary { route, checks: &checks, degrees: false }.to_string();
    let json = error::json(&Checked { route, proved, checks: &checks })?;
    let pieces = route.stretches.first().map_or_else(Vec::new, |plan| route.pieces(&plan.robot));
    let piece = |piece: &aspecta::motion::time::Piece| {
        let samples = &piece.samples;
        let modes = samples.iter().map(|sample| sample.mode.to_string()).collect();
        (
            modes,
            samples.iter().map(|s| s.pose.clone()).collect(),
            samples.iter().map(|s| s.q.clone()).collect(),
        )
    };
    Ok((json, text, pieces.iter().map(piece).collect()))
}

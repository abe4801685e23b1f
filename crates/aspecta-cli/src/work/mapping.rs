//! The source of the map of a robot's aspects: a file, or an analysis.

use crate::args::making::Making;
use crate::failure::{Failure, advice};
use crate::input;
use crate::work::watch::{abandoned_if_cancelled, unkept, within_seconds};
use aspecta::aspect::{Analysis, AspectId, DetSign, Options, Purpose, analyze};
use aspecta::domain::{DomainOptions, Domains, Map, MapError, MappedAspect, Surfaces, domains};
use aspecta::kinematics::WorkingMode;
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::{FileError, Robot};
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// The first argument of a command: a robot, or a map.
pub enum Source {
    /// A robot, whose map is to be computed.
    Robot(Box<Robot>),
    /// A map that `aspecta domains --save` wrote.
    Map(Box<Map>),
}

/// Which aspects are wanted.
#[derive(Clone, Copy, Default)]
pub struct Wanted {
    /// Only the aspects of this mode.
    pub mode: Option<WorkingMode>,
    /// Only the aspects with this sign of det A.
    pub det_a: Option<DetSign>,
    /// The one with this number.
    pub aspect: Option<AspectId>,
}

/// The part of a robot that is looked at.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Coordinates that are held, and their values.
    pub fix: Vec<(usize, f64)>,
    /// Working modes, all if empty.
    pub modes: Vec<WorkingMode>,
}

impl Part {
    /// Coordinates that are free.
    pub fn free(&self, robot: &Robot) -> usize {
        (0..robot.dof()).filter(|k| self.fix.iter().all(|(held, _)| held != k)).count()
    }
}

impl Wanted {
    /// Whether an aspect is.
    pub fn is(&self, mode: WorkingMode, det_a: DetSign, aspect: AspectId) -> bool {
        self.mode.is_none_or(|wanted| wanted == mode)
            && self.det_a.is_none_or(|wanted| wanted == det_a)
            && self.aspect.is_none_or(|wanted| wanted == aspect)
    }
}

impl Source {
    /// Reads the map, or resolves the name of the robot.
    pub fn new(name_or_path: &str) -> Result<Self, Failure> {
        if !input::is_map(name_or_path.as_ref()) {
            let robot = input::robot(name_or_path).map_err(|failure| neither(name_or_path, failure))?;
            return Ok(Self::Robot(Box::new(robot)));
        }
        let refused =
            |error: MapError| Failure::Input(format!("`{name_or_path}`: {}", advice::of_map(&error)));
        Ok(Self::Map(Box::new(Map::load(name_or_path.as_ref()).map_err(refused)?)))
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        match self {
            Self::Robot(robot) => robot,
            Self::Map(map) => &map.robot,
        }
    }

    /// The map: that of the file, or computed now, of those aspects of a part that `wanted` picks from the analysis.
    pub fn map(
        self,
        making: &Making,
        part: Part,
        surfaces: bool,
        control: &Control<'_>,
        wanted: impl Fn(&Analysis) -> Result<Vec<AspectId>, Failure>,
    ) -> Result<(Map, Option<Stop>), Failure> {
        match self {
            Self::Robot(robot) => {
                let seconds = making.budget.and_then(|budget| budget.seconds);
                within_seconds(seconds, control, |control| {
                    making.map(&robot, part, surfaces, control, wanted)
                })
            }
            Self::Map(_) if making.cells.is_some() || making.budget.is_some() => Err(Failure::Input(
                "--cells and --budget are for robots: the map in this file is as fine as it was computed"
                    .into(),
            )),
            Self::Map(_) if !part.fix.is_empty() => Err(Failure::Input(
                "--fix is for robots: the map in this file is that of the whole workspace".into(),
            )),
            Self::Map(map) => Ok((*map, None)),
        }
    }
}

/// Returns the failure of a file that is no map: unless it is named like a robot file, it may have been meant
/// as a map.
fn neither(path: &str, failure: Failure) -> Failure {
    match failure {
        Failure::File(error @ FileError::Invalid(_)) if !path.ends_with(".toml") => Failure::Input(format!(
            "`{path}` is not a map, which `aspecta domains ROBOT --save FILE` writes, and not a robot file: {error}"
        )),
        other => other,
    }
}

impl Making {
    /// The map of a robot; of a time budget half is for the aspects.
    fn map(
        &self,
        robot: &Robot,
        part: Part,
        with_surfaces: bool,
        control: &Control<'_>,
        wanted: impl Fn(&Analysis) -> Result<Vec<AspectId>, Failure>,
    ) -> Result<(Map, Option<Stop>), Failure> {
        let free = part.free(robot);
        let mut budget = self.budget.unwrap_or_else(|| Budget::coarse(free));
        budget.seconds = budget.seconds.map(|seconds| 0.5 * seconds);
        let options = Options {
            budget,
            fix: part.fix,
            modes: part.modes,
            purpose: Purpose::Boxes,
            ..Options::default()
        };
        let usual = DomainOptions::usual(robot, free);
        let cells = self.cells.map_or(usual.cells, usize::from);
        let analysis = Arc::new(unkept(|| analyze(robot, &options, control))?);
        let options = DomainOptions { cells, ..usual };
        let sheet = |id: AspectId| {
            let domains = domains(&analysis, id, &options, control)?;
            let surfaces = if with_surfaces { surfaces(&analysis, &domains, cells, control)? } else { None };
            Ok::<_, Failure>(match surfaces {
                Some(surfaces) => MappedAspect::with_surfaces(domains, surfaces, &analysis.window),
                None => MappedAspect { domains, surfaces: None },
            })
        };
        let cancelled = || control.cancelled.load(Ordering::Relaxed);
        let mut sheets = Vec::new();
        for id in wanted(&analysis)?.into_iter().take_while(|_| !cancelled()) {
            match sheet(id) {
                Ok(sheet) => sheets.push(sheet),
                // What is done is kept.
                Err(_) if cancelled() => break,
                Err(failure) => return Err(failure),
            }
        }
        let stop = if cancelled() { Stop::Cancelled } else { analysis.run.stop };
        Ok((Map::new(&analysis, sheets), Some(stop)))
    }
}

/// The boundary of an aspect and its characteristic surface, about as fine as the regions; `None` once
/// cancelled.
fn surfaces(
    analysis: &Arc<Analysis>,
    domains: &Domains,
    cells: usize,
    control: &Control<'_>,
) -> Result<Option<Surfaces>, Failure> {
    let (analysis, domains) = (Arc::clone(analysis), domains.clone());
    let found = move || Surfaces::of(&analysis, &domains, cells).map_err(|e| Failure::Input(e.to_string()));
    abandoned_if_cancelled(control, found).transpose()
}

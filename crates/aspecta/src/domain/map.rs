//! A robot's map: what sections 3 and 4 of the paper have found about it, ready to be asked.
//!
//! A configuration (X, working mode) is looked up in three steps. Its class is a matter of signs, in doubles. Its aspect is that of a
//! node of the grid next to it, to which [`aspecta_kinematics::path::curve::along`] proves that the segment stays in the class (certified, as far as the node's own
//! aspect is: [`Sheet`]); where a class has one aspect, it is that. Its basic region is that of the nodes round it if they agree, else that of a
//! node to which the other poses with its joint vector can be followed: numerical, true to a cell of the grid.

mod file;

pub use file::{MAP_VERSION, MapError};

use super::RegionId;
use super::face::Face;
use super::field::Field;
use super::grid::Pose;
use super::labels::OUTSIDE;
use super::result::Domains;
use super::sheet::{Belongs, Sheet};
use super::surfaces::Surfaces;
use crate::aspect::{Analysis, AspectId, Count, DetSign, Measure};
use aspecta_kinematics::constraints::{Constraint, Demand, Kind};
use aspecta_kinematics::path::curve::Along;
use aspecta_kinematics::{KinematicsError, WorkingMode, check_pose, for_platform};
use aspecta_robot::num::padded;
use aspecta_robot::{LegIndex, Robot, Window};
use serde::{Deserialize, Serialize};

/// Interval evaluations spent on a segment from a pose to a node.
const EFFORT: usize = 64;

/// The aspects of a robot, and of some of them the basic regions and uniqueness domains.
#[derive(Clone, Debug)]
pub struct Map {
    /// The robot.
    pub robot: Robot,
    /// The box that holds its workspace.
    pub window: Window,
    /// The quantity that is measured, and its unit.
    pub unit: Measure,
    /// Certified bounds on the number of its aspects.
    pub aspects: Count,
    /// Its classes of aspects, in the order of [`Analysis::classes`].
    pub classes: Vec<MappedClass>,
    /// The aspects that are cut into regions.
    pub sheets: Vec<MappedAspect>,
}

/// A working mode and a sign of det A.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MappedClass {
    /// The mode.
    pub mode: WorkingMode,
    /// The sign.
    pub det_a: DetSign,
    /// The aspects found in it.
    pub aspects: Vec<AspectId>,
}

/// An aspect cut into regions.
#[derive(Clone, Debug)]
pub struct MappedAspect {
    /// Its regions.
    pub domains: Domains,
    /// The surfaces that pictures need besides, if they were computed.
    pub surfaces: Option<Surfaces>,
}

impl MappedAspect {
    /// An aspect cut into regions, with the surfaces that bound them: what disagrees with the direct model is measured by its
    /// distance from these.
    pub fn with_surfaces(mut domains: Domains, surfaces: Surfaces, window: &Window) -> Self {
        domains.measure_disagreements(&surfaces.characteristic, window);
        Self { domains, surfaces: Some(surfaces) }
    }
}

/// The location of a pose in a working mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Location {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// The aspect; `None` where neither the class nor a proved segment to a mapped aspect tells.
    pub aspect: Option<AspectId>,
    /// The basic region; `None` if the aspect is not mapped, or too thin here for the grid.
    pub region: Option<RegionId>,
}

/// Why a pose is in no aspect.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Nowhere {
    /// No pose of this robot.
    #[error(transparent)]
    Pose(#[from] KinematicsError),
    /// Outside the window that the robot file sets.
    #[error("outside the [window] of the robot file")]
    Window,
    /// A leg does not reach it, or just so: at a serial singularity.
    #[error("leg {0} does not reach")]
    OutOfReach(LegIndex),
    /// A limit of the machine.
    #[error("beyond {0}")]
    Limit(Constraint),
    /// det A = 0, to rounding.
    #[error("parallel singularity")]
    Singular,
}

impl Map {
    /// The map of an analysed robot, with the aspects that were cut up.
    pub fn new(analysis: &Analysis, sheets: Vec<MappedAspect>) -> Self {
        let class = |class: &crate::aspect::AspectClass| MappedClass {
            mode: class.mode,
            det_a: class.det_a,
            aspects: class.aspects.iter().map(|aspect| aspect.id).collect(),
        };
        Self {
            robot: analysis.robot.clone(),
            window: analysis.window.clone(),
            unit: analysis.measure.clone(),
            aspects: analysis.aspects,
            classes: analysis.classes.iter().map(class).collect(),
            sheets,
        }
    }

    /// The regions and domains of an aspect, if it was cut up.
    pub fn domains(&self, aspect: AspectId) -> Option<&Domains> {
        self.sheets.iter().map(|sheet| &sheet.domains).find(|domains| domains.aspect == aspect)
    }

    /// Returns the location of `pose` in the working mode `mode` of the robot; angles count modulo 2π.
    ///
    /// # Errors
    /// [`Nowhere`] if it is in no aspect.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{AspectId, Budget, Control, DomainOptions, Map, MappedAspect, Options, Robot, analyze, domains};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(7), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let options = DomainOptions { cells: 20, samples: 100 };
    /// let domains = domains(&analysis, AspectId::new(1), &options, &Control::unwatched())?;
    /// let map = Map::new(&analysis, vec![MappedAspect { domains, surfaces: None }]);
    ///
    /// let found = map.locate(&[4.0, 7.0], "++".parse()?)?;
    /// assert!(found.aspect.is_some());
    /// assert!(map.locate(&[40.0, 0.0], "++".parse()?).is_err()); // out of reach
    /// # Ok(())
    /// # }
    /// ```
    pub fn locate(&self, pose: &[f64], mode: WorkingMode) -> Result<Location, Nowhere> {
        check_pose(&self.robot, pose)?;
        let det_a = for_platform!(self.robot.platform, sign_at(self, pose, mode))?;
        let mut location = Location { mode, det_a, aspect: None, region: None };
        let Some(class) = self.classes.iter().find(|c| c.mode == mode && c.det_a == det_a) else {
            return Ok(location);
        };
        let known = self.sheets_of(class).find_map(|d| Some((d, self.region_round(class, d, pose)?)));
        if let Some((domains, region)) = known {
            (location.aspect, location.region) = (Some(domains.aspect), Some(region));
            return Ok(location);
        }
        location.aspect = self.aspect_of(class, pose);
        let domains = location.aspect.and_then(|aspect| self.domains(aspect));
        location.region =
            domains.and_then(|domains| domains.region_on(&self.sheet_in(class, domains.aspect), pose));
        Ok(location)
    }

    /// The numbers, from 1, of the uniqueness domains of an aspect that hold a region: their places in [`Domains::uniqueness`].
    pub fn uniqueness(&self, aspect: AspectId, region: RegionId) -> impl Iterator<Item = usize> {
        let all = self.domains(aspect).map_or(&[][..], |domains| &domains.uniqueness);
        (1..).zip(all).filter(move |(_, domain)| domain.regions.contains(&region)).map(|(number, _)| number)
    }

    fn sheets_of(&self, class: &MappedClass) -> impl Iterator<Item = &Domains> {
        let key = (class.mode, class.det_a);
        self.sheets.iter().map(|sheet| &sheet.domains).filter(move |d| (d.mode, d.det_a) == key)
    }

    /// The region all round a pose of a class, if the pose is proved to lie in its aspect.
    fn region_round(&self, class: &MappedClass, domains: &Domains, pose: &[f64]) -> Option<RegionId> {
        let region = domains.labels.region_round(pose).filter(|region| *region != OUTSIDE)?;
        let number = domains.regions.get(region as usize)?.number;
        if class.aspects.len() == 1 {
            return Some(number);
        }
        let grid = &domains.labels.grid;
        let mut corner = None;
        grid.around(pose, |node| corner = Some(node));
        self.is_joined(class, pose, &grid.turned_to(&padded(pose), corner?)).then_some(number)
    }

    /// The aspect of a pose of a class.
    fn aspect_of(&self, class: &MappedClass, pose: &[f64]) -> Option<AspectId> {
        if let [only] = class.aspects[..] {
            return Some(only);
        }
        let joined = |domains: &&Domains| {
            domains.labels.nearest(pose).iter().any(|(_, node)| self.is_joined(class, pose, node))
        };
        self.sheets_of(class).find(joined).map(|domains| domains.aspect)
    }

    /// Whether the segment between two poses is proved to stay in a class.
    fn is_joined(&self, class: &MappedClass, pose: &[f64], node: &Pose) -> bool {
        let demand = Demand::class(class.mode, class.det_a.factor());
        Along::is_inside(&self.robot, &demand, [pose, &node[..pose.len()]], EFFORT)
    }

    /// An aspect as a function; `None` if there is no such one.
    pub fn sheet(&self, aspect: AspectId) -> Option<Sheet<'_>> {
        let class = self.classes.iter().find(|class| class.aspects.contains(&aspect))?;
        Some(self.sheet_in(class, aspect))
    }

    fn sheet_in<'a>(&'a self, class: &'a MappedClass, aspect: AspectId) -> Sheet<'a> {
        let belongs = (class.aspects.len() > 1)
            .then(|| -> Belongs<'a> { Box::new(move |pose| self.aspect_of(class, pose) == Some(aspect)) });
        Sheet::of(&self.robot, &self.window, (class.mode, class.det_a), belongs)
    }
}

/// The sign of det A at a pose that is strictly within everything else.
fn sign_at<const D: usize, const N: usize>(
    map: &Map,
    pose: &[f64],
    mode: WorkingMode,
) -> Result<DetSign, Nowhere> {
    let field = Field::<D, N> { robot: &map.robot, mode, sign: DetSign::Positive, window: &map.window };
    field.sign_at(&std::array::from_fn(|k| pose[k])).map_err(|face| match face {
        Face::Of(constraint) => match constraint.kind() {
            Kind::Parallel => Nowhere::Singular,
            Kind::Serial(leg) => Nowhere::OutOfReach(leg),
            Kind::Limit => Nowhere::Limit(constraint),
        },
        Face::Cut { .. } => Nowhere::Window,
    })
}

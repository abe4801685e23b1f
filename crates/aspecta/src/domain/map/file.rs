//! The file of a map: gzip-compressed JSON (docs/map-file.md).

use super::{Map, MappedAspect, MappedClass};
use crate::aspect::{AspectId, Count, Measure};
use crate::domain::RegionId;
use crate::domain::grid::Grid;
use crate::domain::labels::{Labels, OUTSIDE};
use crate::domain::result::Domains;
use crate::domain::surfaces::Surfaces;
use aspecta_robot::{Robot, SliceError, Unsound, WorkingMode, holds, text, wanted};
use flate2::Compression;
use flate2::bufread::GzDecoder;
use flate2::write::GzEncoder;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;

/// Version of the file format; raised when a field changes its meaning or goes away.
pub const MAP_VERSION: u32 = 1;

/// The first bytes of a file: the mark of gzip.
const MAGIC: [u8; 2] = [0x1f, 0x8b];

/// The most bytes that are unpacked.
const LARGEST: u64 = 1 << 30;

/// Why a file is no map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// Not compressed, or damaged.
    #[error("damaged, or not a map of a robot's aspects: {0}")]
    Damaged(#[from] io::Error),
    /// It is too large for this program.
    #[error("it unpacks to more than the {} MiB that a map may hold", LARGEST >> 20)]
    TooLarge,
    /// It is not the JSON of a map; the message says where.
    #[error("not a map of a robot's aspects: {0}")]
    Form(#[from] serde_json::Error),
    /// Another version of the format.
    #[error("the map has version {found}, this program reads version {MAP_VERSION}: make it again")]
    Version {
        /// The version.
        found: u32,
    },
    /// The parts do not fit together.
    #[error("the map makes no sense: {0}")]
    Unsound(#[from] Unsound),
    /// The robot's workspace has no window.
    #[error(transparent)]
    Window(#[from] SliceError),
}

/// The fields with which every version begins.
#[derive(Deserialize)]
struct Head {
    map_version: u32,
}

#[derive(Serialize)]
struct FileOut<'a> {
    map_version: u32,
    robot: &'a Robot,
    aspects: Count,
    classes: &'a [MappedClass],
    sheets: Vec<SheetOut<'a>>,
}

#[derive(Serialize)]
struct SheetOut<'a> {
    domains: &'a Domains,
    grid: &'a Grid,
    runs: Vec<(i64, usize)>,
    surfaces: Option<&'a Surfaces>,
}

impl<'a> From<&'a MappedAspect> for SheetOut<'a> {
    fn from(MappedAspect { domains, surfaces }: &'a MappedAspect) -> Self {
        let Labels { grid, region } = &domains.labels;
        SheetOut { domains, grid, runs: runs(region), surfaces: surfaces.as_ref() }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileIn {
    #[serde(rename = "map_version")]
    _version: u32,
    robot: Robot,
    aspects: Count,
    classes: Vec<MappedClass>,
    sheets: Vec<SheetIn>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SheetIn {
    domains: Domains,
    grid: Grid,
    runs: Vec<(i64, usize)>,
    surfaces: Option<Surfaces>,
}

impl Map {
    /// Whether a file that begins with these bytes may be a map.
    pub fn is_map(beginning: &[u8]) -> bool {
        beginning.starts_with(&MAGIC)
    }

    /// The file of this map.
    ///
    /// # Errors
    /// None in practice: memory is written to.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Budget, Control, Map, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(6), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let map = Map::new(&analysis, Vec::new());
    /// let file = map.to_bytes()?;
    /// assert_eq!(Map::from_bytes(&file)?.classes, map.classes);
    /// # Ok(())
    /// # }
    /// ```
    pub fn to_bytes(&self) -> Result<Vec<u8>, MapError> {
        let file = FileOut {
            map_version: MAP_VERSION,
            robot: &self.robot,
            aspects: self.aspects,
            classes: &self.classes,
            sheets: self.sheets.iter().map(SheetOut::from).collect(),
        };
        let mut packed = GzEncoder::new(Vec::new(), Compression::default());
        serde_json::to_writer(&mut packed, &file)?;
        packed.write_all(b"\n")?;
        Ok(packed.finish()?)
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// As [`Map::from_bytes`].
    pub fn load(path: &Path) -> Result<Self, MapError> {
        Self::read(BufReader::new(File::open(path)?))
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`MapError`] if it is damaged, of another kind or version, or its parts do not fit together.
    pub fn from_bytes(file: &[u8]) -> Result<Self, MapError> {
        Self::read(file)
    }

    fn read(file: impl BufRead) -> Result<Self, MapError> {
        let mut text = Vec::new();
        // Reading to the end checks length and check sum.
        let mut packed = GzDecoder::new(file).take(LARGEST + 1);
        packed.read_to_end(&mut text)?;
        if text.len() as u64 > LARGEST {
            return Err(MapError::TooLarge);
        }
        if !packed.into_inner().into_inner().fill_buf()?.is_empty() {
            return Err(MapError::Damaged(io::Error::other("it goes on after its end")));
        }
        let Head { map_version: found } = serde_json::from_slice(&text)?;
        if found != MAP_VERSION {
            return Err(MapError::Version { found });
        }
        let file: FileIn = serde_json::from_slice(&text)?;
        file.robot.check()?;
        holds(file.robot.dof() <= 3, "maps are made for robots with two or three degrees of freedom")?;
        let window = file.robot.slice(&[])?;
        let unit = Measure::over(&file.robot, &window);
        let modes = file.robot.working_modes();
        file.classes.iter().try_for_each(|class| class.check(&modes))?;
        let sheet = |sheet: SheetIn| {
            let labels = Labels { region: region(&sheet.grid, &sheet.runs)?, grid: sheet.grid };
            let (unit, window, pose) = (unit.clone(), window.clone(), text::Labels::pose(&file.robot, false));
            let domains = Domains { unit, labels, window, pose, ..sheet.domains };
            let sheet = MappedAspect { domains, surfaces: sheet.surfaces };
            sheet.check(&file.classes, file.robot.dof())?;
            Ok(sheet)
        };
        let sheets = file.sheets.into_iter().map(sheet).collect::<Result<Vec<MappedAspect>, Unsound>>()?;
        let distinct: BTreeSet<AspectId> = sheets.iter().map(|sheet| sheet.domains.aspect).collect();
        holds(distinct.len() == sheets.len(), "the regions of an aspect stand twice")?;
        Ok(Self { robot: file.robot, window, unit, aspects: file.aspects, classes: file.classes, sheets })
    }
}

/// Equal neighbours once, with their number; −1 is outside.
fn runs(region: &[u32]) -> Vec<(i64, usize)> {
    let name = |region: u32| if region == OUTSIDE { -1 } else { i64::from(region) };
    region.chunk_by(|a, b| a == b).map(|run| (name(run[0]), run.len())).collect()
}

/// Nodes of a grid that a map may have: half a gigabyte of regions.
const MOST_NODES: usize = 1 << 27;

fn region(grid: &Grid, runs: &[(i64, usize)]) -> Result<Vec<u32>, Unsound> {
    let nodes = grid.count.iter().try_fold(1, |nodes: usize, &count| nodes.checked_mul(count));
    holds(nodes.is_some_and(|nodes| nodes <= MOST_NODES), "a grid of more than 134 million nodes")?;
    let found = runs.iter().fold(0usize, |sum, run| sum.saturating_add(run.1));
    wanted("nodes of a grid", found, grid.len())?;
    let mut region = Vec::with_capacity(found);
    for &(name, count) in runs {
        let name = if name == -1 {
            OUTSIDE
        } else {
            u32::try_from(name).map_err(|_| Unsound::Value("a region below 0"))?
        };
        region.resize(region.len() + count, name);
    }
    Ok(region)
}

impl MappedClass {
    fn check(&self, modes: &[WorkingMode]) -> Result<(), Unsound> {
        holds(modes.contains(&self.mode), "a class has a working mode that the robot has not")
    }
}

impl MappedAspect {
    fn check(&self, classes: &[MappedClass], dof: usize) -> Result<(), Unsound> {
        let domains = &self.domains;
        let known = |c: &MappedClass| {
            (c.mode, c.det_a) == (domains.mode, domains.det_a) && c.aspects.contains(&domains.aspect)
        };
        holds(classes.iter().any(known), "regions of an aspect that is in no class")?;
        holds(domains.labels.grid.is_sound(dof), "a grid that is none")?;
        let regions = domains.regions.len();
        let labels = regions.saturating_add(domains.unresolved.parts);
        let mut named = domains.labels.region.iter().filter(|region| **region != OUTSIDE);
        holds(named.all(|&region| (region as usize) < labels), "a node in a region that there is not")?;
        let is_region = |id: RegionId| (1..=regions).contains(&id.number());
        let numbered = (1..)
            .zip(&domains.regions)
            .all(|(k, region)| region.number.number() == k && region.pose.len() == dof);
        holds(
            numbered,
            "regions that are not numbered from 1, or whose pose has another number of coordinates",
        )?;
        let pairs = domains.coincidences.iter().map(|c| c.regions).chain(domains.adjacent.iter().copied());
        let sets = domains.uniqueness.iter().flat_map(|domain| &domain.regions).copied();
        let named = pairs.flat_map(|(a, b)| [a, b]).chain(sets).all(is_region);
        holds(named, "a region that there is not")?;
        holds(domains.cell.len() == dof, "cells with another number of coordinates")?;
        self.surfaces.as_ref().map_or(Ok(()), |surfaces| surfaces.check(dof))
    }
}

impl Surfaces {
    fn check(&self, dof: usize) -> Result<(), Unsound> {
        for mesh in [&self.boundary, &self.characteristic] {
            let count = mesh.vertices.len();
            let mut poses = mesh.vertices.iter().chain(&mesh.sources);
            holds(poses.all(|pose| pose.len() == dof), "vertices with another number of coordinates")?;
            holds([0, count].contains(&mesh.sources.len()), "sources of some vertices only")?;
            let mut corners = mesh.simplices.iter().flat_map(|s| s.corners);
            holds(corners.all(|corner| (corner as usize) < count), "a mesh with corners that it has not")?;
        }
        Ok(())
    }
}

//! The labels of a robot with three free coordinates, packed for the page's viewer (`viewer/src/volume.js`).

use crate::figure::palette;
use crate::figure::raster::pixels;
use crate::figure::survey::coordinate_name;
use aspecta::aspect::{Analysis, AspectId, Cell, DetSign};
use aspecta::kinematics::WorkingMode;
use base64::prelude::{BASE64_STANDARD, Engine};
use serde::Serialize;

/// Most voxels along an axis.
const VOXELS: usize = 128;

#[derive(Serialize)]
struct Volume {
    axes: Vec<VolumeAxis>,
    size: [usize; 3],
    /// Numbers of the modes that have classes, in the order of the classes.
    numbers: Vec<usize>,
    classes: Vec<VolumeClass>,
}

#[derive(Serialize)]
struct VolumeAxis {
    label: String,
    range: (f64, f64),
    angle: bool,
}

#[derive(Serialize)]
struct VolumeClass {
    mode: WorkingMode,
    det_a: DetSign,
    aspects: Vec<VolumeAspect>,
    data: String,
}

#[derive(Serialize)]
struct VolumeAspect {
    id: AspectId,
    colour: &'static str,
}

/// The volume as JSON that may stand in a script element.
pub fn json(analysis: &Analysis, cells: &[Vec<Cell>]) -> std::io::Result<String> {
    let coordinates = analysis.robot.platform.coordinates();
    let axis = |k: usize| {
        let unit = if coordinates[k].angle { "rad" } else { &analysis.robot.length_unit };
        let label = format!("{} [{unit}]", coordinate_name(coordinates[k].name));
        VolumeAxis { label, range: analysis.window.ranges[k], angle: coordinates[k].angle }
    };
    let free = analysis.window.axes();
    let size = std::array::from_fn(|a| super::side(analysis, free[a]).min(VOXELS));
    let ranges: [_; 3] = std::array::from_fn(|a| analysis.window.ranges[free[a]]);
    let classes = analysis.classes.iter().zip(cells).map(|(class, cells)| {
        let local = |id: AspectId| class.aspects.iter().position(|a| a.id == id).map_or(1, |k| k + 2);
        VolumeClass {
            mode: class.mode,
            det_a: class.det_a,
            aspects: class
                .aspects
                .iter()
                .map(|a| VolumeAspect { id: a.id, colour: palette::aspect(a.id) })
                .collect(),
            data: pack(&voxels(cells, &ranges, size, local)),
        }
    });
    let classes: Vec<VolumeClass> = classes.collect();
    let number =
        |m: &aspecta::aspect::ModeReport| classes.iter().any(|c| c.mode == m.mode).then_some(m.number);
    let numbers = analysis.modes.iter().filter_map(number).collect();
    let volume = Volume { axes: free.iter().map(|&k| axis(k)).collect(), size, numbers, classes };
    // `<` only occurs within strings, where an escape is as good.
    Ok(serde_json::to_string(&volume)?.replace('<', "\\u003c"))
}

/// Labels voxel by voxel, the first coordinate fastest. A voxel that meets an undecided cell is undecided.
fn voxels(
    cells: &[Cell],
    ranges: &[(f64, f64)],
    size: [usize; 3],
    local: impl Fn(AspectId) -> usize,
) -> Vec<u32> {
    let mut labels = vec![0; size.iter().product()];
    let inner = cells.iter().filter(|c| c.aspect.is_some());
    for cell in inner.chain(cells.iter().filter(|c| c.aspect.is_none())) {
        let label = cell.aspect.map_or(1, &local) as u32;
        let [x, y, z] = [0, 1, 2].map(|k| pixels((cell.lo[k], cell.hi[k]), ranges[k], size[k]));
        for (j, k) in z.flat_map(|k| y.clone().map(move |j| (j, k))) {
            let line = size[0] * (j + size[1] * k);
            labels[line + x.start..line + x.end].fill(label);
        }
    }
    labels
}

/// Runs of (label, length), both LEB128, in base64.
fn pack(labels: &[u32]) -> String {
    let mut bytes = Vec::new();
    for run in labels.chunk_by(|a, b| a == b) {
        leb128(&mut bytes, run[0] as usize);
        leb128(&mut bytes, run.len());
    }
    BASE64_STANDARD.encode(bytes)
}

fn leb128(bytes: &mut Vec<u8>, mut value: usize) {
    while value >= 128 {
        bytes.push((value & 127) as u8 | 128);
        value >>= 7;
    }
    bytes.push(value as u8);
}

//! Binary glTF 2.0 files (`.glb`), which common viewers show in colour.

use super::{Surface, Surfaces, name};
use crate::figure::palette;
use serde_json::{Value, json};

/// Numbers of the format: types of components, and what a buffer view is for.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
/// Side of the cube that a viewer sees the aspect in, metres.
const SIDE: f64 = 2.0;
/// How much the boundary hides of what is in it.
const OPACITY: f64 = 0.3;

/// Both surfaces of an aspect as nodes `boundary` and `characteristic` of one root, with a mesh primitive and
/// a material for each face. The boundary is translucent.
///
/// Positions are poses, in single precision. The root turns the third coordinate upward and scales: lengths
/// alike, and a third coordinate that is an angle so that its range is the longest side of the rest. Its
/// `extras` say so, with names and units.
pub fn glb(all: &Surfaces) -> Vec<u8> {
    let mut file = File::default();
    let nodes: Vec<Value> = all.surfaces.iter().filter_map(|surface| file.node(all, surface)).collect();
    let children: Vec<usize> = (1..=nodes.len()).collect();
    let root = root(all, &children);
    let document = json!({
        "asset": { "version": "2.0", "generator": concat!("aspecta ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": all.robot, "nodes": [0] }],
        "nodes": std::iter::once(root).chain(nodes).collect::<Vec<_>>(),
        "meshes": file.meshes,
        "materials": file.materials,
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "byteLength": file.bytes.len() }],
    });
    container(document.to_string().into_bytes(), file.bytes)
}

/// The node that shows poses well.
fn root(all: &Surfaces, children: &[usize]) -> Value {
    let vertices = || all.surfaces.iter().flat_map(|surface| &surface.vertices);
    let range = [0, 1, 2].map(|k| {
        let of = vertices().map(|v| v[k]);
        (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
    });
    let span = range.map(|(lo, hi)| if hi > lo { hi - lo } else { 1.0 });
    let side = if all.angle { span[0].max(span[1]) } else { span[0].max(span[1]).max(span[2]) };
    let scale = [SIDE / side, SIDE / side, SIDE / if all.angle { span[2] } else { side }];
    let middle: [f64; 3] = std::array::from_fn(|k| scale[k] * 0.5 * (range[k].0 + range[k].1));
    let half = 0.5_f64.sqrt();
    json!({
        "name": all.aspect,
        "children": children,
        // A quarter turn about the first axis: (x, y, z) to (x, z, −y).
        "rotation": [-half, 0.0, 0.0, half],
        "scale": scale,
        "translation": [-middle[0], -middle[2], middle[1]],
        "extras": {
            "robot": all.robot,
            "coordinates": all.coordinates,
            "scale": scale,
            "note": "positions are the coordinates; scale: metres shown per unit of each",
        },
    })
}

/// The parts of the file so far.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
}

impl File {
    /// The node of a surface; nothing if it has no triangle.
    fn node(&mut self, all: &Surfaces, surface: &Surface) -> Option<Value> {
        if surface.triangles.is_empty() {
            return None;
        }
        let positions = self.positions(&surface.vertices);
        let mut primitives = Vec::new();
        for (k, &face) in all.faces.iter().enumerate() {
            let of_face = surface.triangles.iter().zip(&surface.face).filter(|(_, f)| usize::from(**f) == k);
            let corners: Vec<u32> = of_face.flat_map(|(corners, _)| *corners).collect();
            if corners.is_empty() {
                continue;
            }
            let of_boundary = surface.name == "boundary";
            let opacity = if of_boundary { OPACITY } else { 1.0 };
            let name = if of_boundary { name(face) } else { format!("image of {}", name(face)) };
            self.materials.push(material(&name, palette::face(face), opacity));
            let indices = self.indices(&corners);
            primitives.push(json!({
                "attributes": { "POSITION": positions },
                "indices": indices,
                "material": self.materials.len() - 1,
                "extras": { "face": k },
            }));
        }
        self.meshes.push(json!({ "name": surface.name, "primitives": primitives }));
        Some(json!({ "name": surface.name, "mesh": self.meshes.len() - 1 }))
    }

    fn positions(&mut self, vertices: &[[f64; 3]]) -> usize {
        let single: Vec<[f32; 3]> = vertices.iter().map(|v| v.map(|x| x as f32)).collect();
        let bound = |start: f32, of: fn(f32, f32) -> f32| -> [f64; 3] {
            [0, 1, 2].map(|k| f64::from(single.iter().map(|v| v[k]).fold(start, of)))
        };
        let bounds = json!({ "min": bound(f32::MAX, f32::min), "max": bound(f32::MIN, f32::max) });
        let bytes = single.iter().flatten().flat_map(|x| x.to_le_bytes());
        self.accessor(bytes, ARRAY_BUFFER, "VEC3", FLOAT, single.len(), bounds)
    }

    fn indices(&mut self, corners: &[u32]) -> usize {
        let bytes = corners.iter().flat_map(|v| v.to_le_bytes());
        self.accessor(bytes, ELEMENT_ARRAY_BUFFER, "SCALAR", UNSIGNED_INT, corners.len(), json!({}))
    }

    /// Appends an array; all have components of four bytes, so that they are aligned.
    fn accessor(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        target: u32,
        kind: &str,
        component: u32,
        count: usize,
        mut accessor: Value,
    ) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start, "target": target,
        }));
        accessor["bufferView"] = json!(self.views.len() - 1);
        accessor["componentType"] = json!(component);
        accessor["count"] = json!(count);
        accessor["type"] = json!(kind);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

fn material(name: &str, colour: &str, opacity: f64) -> Value {
    let [r, g, b] = palette::channels(colour).map(linear);
    json!({
        "name": name,
        "doubleSided": true,
        "alphaMode": if opacity < 1.0 { "BLEND" } else { "OPAQUE" },
        "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, opacity], "metallicFactor": 0.0, "roughnessFactor": 0.7 },
    })
}

/// The intensity of a channel of an sRGB colour (IEC 61966-2-1).
fn linear(channel: u8) -> f64 {
    let x = f64::from(channel) / 255.0;
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

/// A header and two chunks, each padded to a multiple of four bytes.
fn container(mut document: Vec<u8>, mut bytes: Vec<u8>) -> Vec<u8> {
    document.resize(document.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let total = 12 + 8 + document.len() + 8 + bytes.len();
    let mut file = b"glTF".to_vec();
    file.extend([2, total as u32].iter().flat_map(|n| n.to_le_bytes()));
    for (kind, chunk) in [(b"JSON", document), (b"BIN\0", bytes)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

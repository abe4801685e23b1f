//! Triangle meshes in files: the boundary and the characteristic surface of an aspect with three coordinates.

pub mod gltf;
pub mod ply;
pub mod vtk;

use crate::figure::barrier::Barriers;
use crate::figure::cut::Cut;
use crate::figure::survey::pose_axis;
use aspecta::domain::boundary::{Face, Simplex};
use aspecta::domain::{Map, Mesh};
use aspecta::kinematics::constraints::Kind;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

/// Both surfaces of an aspect, and what their numbers mean.
#[derive(Clone, Debug)]
pub struct Surfaces {
    /// The robot's name.
    pub robot: String,
    /// The aspect they belong to, such as `aspect 1, mode +++, det A +`.
    pub aspect: String,
    /// The pose's coordinates with their units, such as `x [mm]`.
    pub coordinates: [String; 3],
    /// Whether the third is an angle.
    pub angle: bool,
    /// The faces that occur, each once, in order of their names.
    pub faces: Vec<Face>,
    /// The boundary, and the characteristic surface.
    pub surfaces: [Surface; 2],
}

/// A triangle mesh.
#[derive(Clone, Debug)]
pub struct Surface {
    /// `boundary` or `characteristic`.
    pub name: &'static str,
    /// Poses. Across the ends of a coordinate that closes up on itself, triangles have copies of their
    /// vertices a full turn further, so that they hang together; copies come last.
    pub vertices: Vec<[f64; 3]>,
    /// Indices of their vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle, which of [`Surfaces::faces`] it is or, in the characteristic surface, comes from.
    pub face: Vec<u8>,
    /// The data of each vertex.
    pub data: Vec<Data>,
}

/// Three numbers a vertex.
#[derive(Clone, Debug)]
pub struct Data {
    /// `q`, the joint vector; `source`, the pose on the boundary with the same joint vector.
    pub name: &'static str,
    /// Names of the numbers, with units.
    pub components: [String; 3],
    /// The numbers.
    pub values: Vec<[f64; 3]>,
}

impl Surfaces {
    /// The surfaces of an aspect; `None` unless its robot has three coordinates.
    pub fn new(cut: &Cut<'_>) -> Option<Self> {
        let Cut { map: Map { robot, window, .. }, domains, boundary, surface } = cut;
        if robot.dof() != 3 || window.held().next().is_some() {
            return None;
        }
        let mut faces: Vec<Face> = Vec::new();
        for simplex in &boundary.simplices {
            if !faces.contains(&simplex.face) {
                faces.push(simplex.face);
            }
        }
        faces.sort_by_key(|face| name(*face));
        let (glued, joints) = (window.glued[2], Joints::of(cut));
        Some(Self {
            robot: robot.name.clone(),
            aspect: format!("aspect {}, mode {}, det A {}", domains.aspect, domains.mode, domains.det_a),
            coordinates: std::array::from_fn(|k| pose_axis(robot, window, k).label),
            angle: robot.platform.coordinates()[2].angle,
            surfaces: [
                Surface::new("boundary", boundary, &faces, glued, &joints),
                Surface::new("characteristic", surface, &faces, glued, &joints),
            ],
            faces,
        })
    }
}

/// g_s, and the names of its values.
struct Joints<'a> {
    cut: &'a Cut<'a>,
    components: [String; 3],
}

impl<'a> Joints<'a> {
    fn of(cut: &'a Cut<'a>) -> Self {
        let robot = &cut.map.robot;
        let name = |j: usize| {
            let angle = robot.legs[j].actuator.is_angle();
            format!("q{} [{}]", j + 1, if angle { "rad" } else { &robot.length_unit })
        };
        Self { cut, components: std::array::from_fn(name) }
    }

    fn data<'p>(&self, poses: impl Iterator<Item = &'p [f64]>) -> Data {
        let q = |pose| Barriers::at(&self.cut.map.robot, self.cut.domains.mode, pose).q;
        let values = poses.map(|pose| triple(&q(pose))).collect();
        Data { name: "q", components: self.components.clone(), values }
    }
}

impl Surface {
    fn new(name: &'static str, of: &Mesh, faces: &[Face], glued: bool, joints: &Joints<'_>) -> Self {
        let poses = of.vertices.iter().map(Vec::as_slice);
        let mut data = vec![joints.data(poses.clone())];
        if !of.sources.is_empty() {
            let Map { robot, window, .. } = joints.cut.map;
            let components = std::array::from_fn(|k| pose_axis(robot, window, k).label);
            let values = of.sources.iter().map(|pose| triple(pose)).collect();
            data.push(Data { name: "source", components, values });
        }
        Self::glued(name, poses.map(triple).collect(), &of.simplices, faces, glued, data)
    }

    fn glued(
        name: &'static str,
        mut vertices: Vec<[f64; 3]>,
        simplices: &[Simplex],
        faces: &[Face],
        glued: bool,
        mut data: Vec<Data>,
    ) -> Self {
        let mut copies: HashMap<u32, u32> = HashMap::new();
        let mut triangles: Vec<[u32; 3]> = simplices.iter().map(|s| s.corners).collect();
        for corners in triangles.iter_mut().filter(|_| glued) {
            let top = corners.iter().map(|&v| vertices[v as usize][2]).fold(f64::MIN, f64::max);
            for corner in corners.iter_mut() {
                let [x, y, angle] = vertices[*corner as usize];
                if top - angle > PI {
                    *corner = *copies.entry(*corner).or_insert_with(|| {
                        vertices.push([x, y, angle + TAU]);
                        data.iter_mut().for_each(|d| d.values.push(d.values[*corner as usize]));
                        vertices.len() as u32 - 1
                    });
                }
            }
        }
        let index = |face| faces.iter().position(|f| *f == face).unwrap_or(usize::from(u8::MAX)) as u8;
        Self { name, vertices, triangles, face: simplices.iter().map(|s| index(s.face)).collect(), data }
    }
}

fn triple(numbers: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| numbers[k])
}

/// Returns the name of a face, for people.
pub fn name(face: Face) -> String {
    match face {
        Face::Of(constraint) => match constraint.kind() {
            Kind::Parallel => format!("{constraint} = 0"),
            Kind::Serial(leg) => format!("det B = 0, leg {leg}"),
            Kind::Limit => constraint.to_string(),
        },
        Face::Cut { coordinate, upper } => {
            let end = if upper { "upper" } else { "lower" };
            format!("{end} end of the window, coordinate {}", coordinate + 1)
        }
    }
}

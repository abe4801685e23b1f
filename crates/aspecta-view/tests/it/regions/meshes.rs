//! Meshes, as other readers of their formats see them.

use super::Case;
use aspecta::Kinematics;
use aspecta::kinematics::WorkingMode;
use aspecta_view::mesh::{Surface, Surfaces, gltf, name, ply, vtk};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use std::f64::consts::PI;
use std::sync::LazyLock;
use vtkio::model::{Attribute, DataArray, DataSet, IOBuffer, Piece, PolyDataPiece};

/// Found once for all tests.
static CASE: LazyLock<Case> = LazyLock::new(|| Case::three_rpr(10, 12));

fn surfaces() -> Surfaces {
    let surfaces = Surfaces::new(&CASE.cut()).unwrap();
    assert!(surfaces.surfaces.iter().all(|s| s.triangles.len() > 500));
    surfaces
}

/// Copies come after the vertices of the mesh, a full turn further; no triangle spans the full turn.
#[test]
fn triangles_hang_together_across_the_full_turn() {
    let (case, all) = (&CASE, surfaces());
    let boundary: Vec<&[f64]> = case.boundary.vertices.iter().map(Vec::as_slice).collect();
    let characteristic = case.surface.vertices.iter().map(Vec::as_slice).collect();
    let meshes = [(boundary, &case.boundary.simplices), (characteristic, &case.surface.simplices)];
    for (surface, (poses, simplices)) in all.surfaces.iter().zip(meshes) {
        assert!(surface.vertices.len() > poses.len(), "the mesh does not cross φ = π: nothing is tested");
        assert!(poses.iter().zip(&surface.vertices).all(|(pose, vertex)| *pose == vertex));
        assert_eq!(surface.triangles.len(), simplices.len());
        for ((corners, simplex), face) in surface.triangles.iter().zip(simplices).zip(&surface.face) {
            let angles = corners.map(|v| surface.vertices[v as usize][2]);
            for (angle, corner) in angles.into_iter().zip(simplex.corners) {
                let turns = (angle - poses[corner as usize][2]) / (2.0 * PI);
                assert!((turns - turns.round()).abs() < 1e-12);
                assert!((angle - angles[0]).abs() < PI);
            }
            assert_eq!(all.faces[usize::from(*face)], simplex.face);
        }
    }
}

/// The pose of the source has the joint vector of the vertex.
#[test]
fn vertices_know_their_joint_vectors_and_sources() {
    let case = &CASE;
    let robot = &case.map.robot;
    let mode: WorkingMode = case.domains.mode;
    let joints = |pose: &[f64]| robot.inverse_in(pose, mode).unwrap().unwrap();
    let [_, characteristic] = &surfaces().surfaces;
    let [q, source] = &characteristic.data[..] else { panic!("{:?}", characteristic.data) };
    assert_eq!((q.name, source.name), ("q", "source"));
    assert_eq!((q.values.len(), source.values.len()), (characteristic.vertices.len(), q.values.len()));
    for ((vertex, q), source) in characteristic.vertices.iter().zip(&q.values).zip(&source.values) {
        for pose in [vertex, source] {
            let off = joints(pose).iter().zip(q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-8, "{vertex:?} {q:?} {source:?}");
        }
    }
}

#[test]
fn ply_files_hold_the_meshes() {
    let all = surfaces();
    for surface in &all.surfaces {
        let file = ply::ply(&all, surface);
        let end = file.windows(10).position(|w| w == b"end_header").unwrap();
        assert!(file[..end].is_ascii());
        let read = Parser::<DefaultElement>::new().read_ply(&mut &file[..]).unwrap();
        let comments = &read.header.comments;
        assert!(comments.iter().any(|c| c.contains("det A = 0")), "{comments:?}");
        assert!(comments.iter().any(|c| c.contains("x [unit], y [unit], phi [rad]")), "{comments:?}");
        let (vertices, triangles) = (&read.payload["vertex"], &read.payload["face"]);
        assert_eq!((vertices.len(), triangles.len()), (surface.vertices.len(), surface.triangles.len()));
        for (read, vertex) in vertices.iter().zip(&surface.vertices) {
            assert_eq!(["x", "y", "z"].map(|k| read[k].clone()), vertex.map(Property::Double));
        }
        for ((read, corners), face) in triangles.iter().zip(&surface.triangles).zip(&surface.face) {
            assert_eq!(read["vertex_indices"], Property::ListInt(corners.map(|v| v as i32).to_vec()));
            assert_eq!(read["face"], Property::UChar(*face));
        }
    }
}

#[test]
fn gltf_files_hold_the_meshes() {
    let all = surfaces();
    // The crate checks what the format demands: indices, sizes, bounds.
    let read = ::gltf::Gltf::from_slice(&gltf::glb(&all)).unwrap();
    let blob = read.blob.as_deref();
    let root = read.default_scene().unwrap().nodes().next().unwrap();
    let children: Vec<_> = root.children().collect();
    assert_eq!(children.len(), 2);
    let mut shown = [(f32::MAX, f32::MIN); 3];
    for (node, surface) in children.iter().zip(&all.surfaces) {
        assert_eq!(node.name(), Some(surface.name));
        for primitive in node.mesh().unwrap().primitives() {
            let name_read = primitive.material().name().unwrap().to_owned();
            let face = all.faces.iter().position(|f| name_read.ends_with(&name(*f))).unwrap();
            let reader = primitive.reader(|_| blob);
            let corners: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            let of_face =
                surface.triangles.iter().zip(&surface.face).filter(|(_, f)| usize::from(**f) == face);
            assert_eq!(corners, of_face.flat_map(|(corners, _)| *corners).collect::<Vec<_>>());
            let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
            assert_eq!(positions, surface.vertices.iter().map(|v| v.map(|x| x as f32)).collect::<Vec<_>>());
            let bounds = primitive.bounding_box();
            let within = |p: &[f32; 3]| (0..3).all(|k| bounds.min[k] <= p[k] && p[k] <= bounds.max[k]);
            assert!(positions.iter().all(within));
            positions.iter().for_each(|p| widen(&mut shown, placed(root.transform().matrix(), *p)));
        }
        let counted: usize = node.mesh().unwrap().primitives().map(|p| p.indices().unwrap().count()).sum();
        assert_eq!(counted, 3 * surface.triangles.len());
    }
    // A viewer finds it round the origin, the angle upward and as wide as the rest.
    for (k, (lo, hi)) in shown.into_iter().enumerate() {
        assert!((lo + hi).abs() < 1e-4 && hi - lo < 2.0 + 1e-4, "{shown:?}");
        assert!(k != 1 || hi - lo > 2.0 - 1e-4, "{shown:?}");
    }
    let up = placed(root.transform().matrix(), [0.0, 0.0, 1.0]);
    assert!(up[1] > placed(root.transform().matrix(), [0.0; 3])[1]);
    let extras = root.extras().as_ref().unwrap().get();
    assert!(extras.contains("φ [rad]") && extras.contains("scale"), "{extras}");
}

/// M p, columns first.
fn placed(m: [[f32; 4]; 4], p: [f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|k| m[0][k] * p[0] + m[1][k] * p[1] + m[2][k] * p[2] + m[3][k])
}

fn widen(range: &mut [(f32, f32); 3], p: [f32; 3]) {
    (0..3).for_each(|k| range[k] = (range[k].0.min(p[k]), range[k].1.max(p[k])));
}

#[test]
fn vtk_files_hold_the_meshes() {
    let all = surfaces();
    for surface in &all.surfaces {
        let piece = poly_data(&vtk::vtp(&all, surface));
        assert_eq!(numbers(piece.points), flat(&surface.vertices));
        let (corners, ends) = piece.polys.unwrap().into_xml();
        let expected = surface.triangles.iter().flatten().map(|v| u64::from(*v));
        assert_eq!(corners, expected.collect::<Vec<_>>());
        assert_eq!(ends, (1..=surface.triangles.len() as u64).map(|k| 3 * k).collect::<Vec<_>>());
        let names: Vec<&str> = piece.data.point.iter().map(Attribute::name).collect();
        assert_eq!(names, surface.data.iter().map(|d| d.name).collect::<Vec<_>>());
        for (read, data) in piece.data.point.into_iter().zip(&surface.data) {
            assert_eq!(numbers(values(read)), flat(&data.values));
        }
        let [face] = <[Attribute; 1]>::try_from(piece.data.cell).unwrap();
        assert_eq!(face.name(), "face");
        let IOBuffer::U8(face) = values(face) else { panic!("not bytes") };
        assert_eq!(face, surface.face);
    }
}

fn flat(values: &[[f64; 3]]) -> Vec<f64> {
    values.iter().flatten().copied().collect()
}

fn poly_data(file: &str) -> PolyDataPiece {
    match vtkio::Vtk::parse_xml(file.as_bytes()).unwrap().data {
        DataSet::PolyData { mut pieces, .. } => match pieces.remove(0) {
            Piece::Inline(piece) => *piece,
            other => panic!("{other:?}"),
        },
        other => panic!("{other:?}"),
    }
}

fn values(attribute: Attribute) -> IOBuffer {
    match attribute {
        Attribute::DataArray(DataArray { data, .. }) => data,
        other => panic!("{other:?}"),
    }
}

fn numbers(buffer: IOBuffer) -> Vec<f64> {
    match buffer {
        IOBuffer::F64(values) => values,
        other => panic!("not doubles: {:?}", other.scalar_type()),
    }
}

/// The names of faces, and coordinates, that stand in the file beside the numbers.
#[test]
fn vtk_files_say_what_their_numbers_are() {
    let all = surfaces();
    let [boundary, _]: &[Surface; 2] = &all.surfaces;
    let file = vtk::vtp(&all, boundary);
    let document = roxmltree::Document::parse(&file).unwrap();
    let named = |name| document.descendants().find(|n| n.attribute("Name") == Some(name)).unwrap();
    let text = named("faces").text().unwrap();
    let bytes: Vec<u8> = text.split_whitespace().map(|byte| byte.parse().unwrap()).collect();
    let names: Vec<String> = all.faces.iter().map(|face| name(*face) + "\0").collect();
    assert_eq!(String::from_utf8(bytes).unwrap(), names.concat());
    assert_eq!(named("faces").attribute("NumberOfTuples"), Some(all.faces.len().to_string().as_str()));
    assert_eq!(named("Points").attribute("ComponentName2"), Some("φ [rad]"));
    assert_eq!(named("q").attribute("ComponentName0"), Some("q1 [unit]"));
}

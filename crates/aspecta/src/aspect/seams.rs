//! Seams: the places where the boxes of one chart meet those of another.

use super::atlas::Leaf;
use crate::paving::{Mark, Node, Paving};
use arrayvec::ArrayVec;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::chart::{Chart, coordinates};
use aspecta_kinematics::for_platform;
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar};

/// The sheet whose boxes, and those that replace some of them, hold all configurations: that of poses, or of
/// a chart that holds all.
pub(super) fn base_of(sheets: &[Paving]) -> usize {
    usize::from(sheets.get(1).is_some_and(|sheet| sheet.chart.is_whole()))
}

/// Pairs (box of the base, box of a later sheet) that may share a configuration in which neither box is
/// replaced by the other.
///
/// The boxes of a fold's sheet and those boxes of the base that it does not cover, cut to the configurations
/// the chart does not hold, cover all configurations. The two kinds meet only in the chart's outer faces, so
/// every box at such a face is joined with all that its image may meet.
pub(super) fn outer(
    robot: &Robot,
    sheets: &[Paving],
    classify: &impl Fn(&Node) -> Mark,
    join: &mut impl FnMut(Leaf, Leaf),
) {
    let base = base_of(sheets);
    for (k, sheet) in sheets.iter().skip(base + 1).enumerate() {
        let s = base + 1 + k;
        // An image is a box, but the face is thin and slanted: most boxes that meet the former are away from
        // the chart.
        let at_edge = |node: &Node| if node.partly >> k & 1 == 0 { Mark::Outside } else { classify(node) };
        sheet.boxes_of(classify, &mut |at| {
            for face in outer_faces(robot, sheet, at) {
                for image in images(robot, &sheets[base], sheet, &face) {
                    sheets[base].meeting(&at_edge, &image, &mut |other| join((base, other), (s, at)));
                }
            }
        });
    }
}

/// Pairs (inside box of the sheet beneath, inside box of a sheet) that share a configuration, the centre of
/// the latter seeming to lie in the former; the third argument of `join` proves that it does. Beneath the
/// base are the poses, beneath all others the base.
pub(super) fn inner(
    robot: &Robot,
    sheets: &[Paving],
    classify: &impl Fn(&Node) -> Mark,
    join: &mut impl FnMut(Leaf, Leaf, &dyn Fn() -> bool),
) {
    let base = base_of(sheets);
    for (s, sheet) in sheets.iter().enumerate().skip(1) {
        let beneath = if s > base { base } else { 0 };
        let under = &sheets[beneath];
        sheet.boxes_of(classify, &mut |at| {
            if classify(&sheet.nodes[at as usize]) != Mark::Inside {
                return;
            }
            for (k, point) in middles(robot, under, sheet, at).iter().enumerate() {
                // In the other posture of the base's leg it is another configuration, of another mode.
                let found = under.find(classify, point).filter(|(_, surely)| *surely).map(|(other, _)| other);
                let Some(other) = found.filter(|&n| classify(&under.nodes[n as usize]) == Mark::Inside)
                else {
                    continue;
                };
                join((beneath, other), (s, at), &|| {
                    under.holds(other, &images(robot, under, sheet, &middle(sheet, at))[k])
                });
            }
        });
    }
}

/// The centre of a box, to compute with in intervals.
pub(super) fn middle(sheet: &Paving, at: u32) -> Vec<Interval> {
    sheet.centre(at).into_iter().map(Interval::point).collect()
}

/// Returns the centre of a box in the chart of the sheet `under`, numerically, in each posture of its leg.
fn middles(robot: &Robot, under: &Paving, sheet: &Paving, at: u32) -> ArrayVec<Vec<f64>, 2> {
    if under.chart == Chart::Pose {
        return std::iter::once(pose_at_centre(robot, sheet, at)).collect();
    }
    let images = images(robot, under, sheet, &middle(sheet, at));
    images.into_iter().map(|image| image.iter().map(|x| x.mid()).collect()).collect()
}

/// The outer faces of a fold's chart that a box lies at: its coordinates, one of them at its end.
fn outer_faces(robot: &Robot, sheet: &Paving, at: u32) -> Vec<Vec<Interval>> {
    let node = &sheet.nodes[at as usize];
    let last = (1u32 << node.depth) - 1;
    let coordinates = sheet.extent(at);
    let mut faces = Vec::new();
    let bounded = sheet.chart.bounded(robot);
    for (a, &k) in sheet.axes.iter().enumerate().filter(|(_, k)| bounded.contains(*k)) {
        let Interval { lo, hi } = coordinates[k];
        for (is_outer, end) in [(node.corner[a] == 0, lo), (node.corner[a] == last, hi)] {
            if is_outer {
                let mut face = coordinates.clone();
                face[k] = Interval::point(end);
                faces.push(face);
            }
        }
    }
    faces
}

/// The pose at the centre of a box.
pub(super) fn centre(robot: &Robot, sheets: &[Paving], (s, at): Leaf) -> Vec<f64> {
    pose_at_centre(robot, &sheets[s], at)
}

fn pose_at_centre(robot: &Robot, sheet: &Paving, at: u32) -> Vec<f64> {
    for_platform!(robot.platform, pose_of(robot, &sheet.chart, &sheet.centre(at)))
}

/// Poses that hold the configurations of a box.
pub(super) fn poses(robot: &Robot, sheets: &[Paving], (s, at): Leaf) -> Vec<Interval> {
    for_platform!(robot.platform, poses_in(robot, &sheets[s].chart, &sheets[s].extent(at)))
}

/// Coordinates of the sheet `under` that hold the configurations with the coordinates `y` of another: if its
/// chart is a chain, in each posture of its leg.
fn images(robot: &Robot, under: &Paving, sheet: &Paving, y: &[Interval]) -> ArrayVec<Vec<Interval>, 2> {
    for_platform!(robot.platform, images_in(robot, &under.chart, &sheet.chart, y))
}

fn images_in<const D: usize, const N: usize>(
    robot: &Robot,
    under: &Chart,
    chart: &Chart,
    y: &[Interval],
) -> ArrayVec<Vec<Interval>, 2> {
    let Chart::Chain(chain) = under else {
        return std::iter::once(poses_in::<D, N>(robot, chart, y)).collect();
    };
    let y: [Interval; N] = std::array::from_fn(|k| y[k]);
    let (placement, _) = chart.at::<Interval, D, N>(robot, &y, |k| y[k].sin_cos());
    coordinates::<D, N>(chain, robot, &placement).map(|image| image.to_vec()).into()
}

fn poses_in<const D: usize, const N: usize>(robot: &Robot, chart: &Chart, y: &[Interval]) -> Vec<Interval> {
    chart.pose::<D, N>(robot, &std::array::from_fn(|k| y[k])).to_vec()
}

fn pose_of<const D: usize, const N: usize>(robot: &Robot, chart: &Chart, y: &[f64]) -> Vec<f64> {
    chart.pose_at::<D, N>(robot, &std::array::from_fn(|k| y[k])).to_vec()
}

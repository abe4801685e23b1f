//! The Agile Eye, of which every working mode is one aspect: against a count in other coordinates, which shares nothing with the
//! library, and with limits, slices and forged certificates.

use crate::random::Random;
use aspecta::aspect::{Analysis, DetSign, Options, analyze};
use aspecta::certificate::Certificate;
use aspecta::num::Interval;
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::{Actuator, Robot, catalogue};
use aspecta::verify::verify;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

fn eye() -> Robot {
    catalogue::find("spherical-3-rrr").unwrap()
}

fn analyzed(robot: &Robot, options: Options) -> Analysis {
    analyze(robot, &options, &Control::unwatched()).unwrap()
}

fn certificate(robot: &Robot, depth: u32) -> Certificate {
    let budget = Budget { depth: Some(depth), ..Budget::default() };
    analyzed(robot, Options { budget, certificate: true, ..Options::default() }).certificate.unwrap()
}

fn is_accepted(certificate: &Certificate) -> bool {
    // As it is read, which refuses some.
    let text = certificate.to_json().unwrap();
    Certificate::from_json(text.as_bytes())
        .is_ok_and(|read| verify(&read, &Control::unwatched()).is_verified())
}

/// Cells along an edge of each of the four cubes that the unit quaternions, up to sign, are cut into.
const CELLS: usize = 24;

/// Orientations as quaternions whose largest coordinate, the k-th, is 1; the middle of a cell of cube k.
fn orientation(k: usize, cell: [usize; 3]) -> UnitQuaternion<f64> {
    let mut all = [1.0; 4];
    for (a, i) in (0..4).filter(|&i| i != k).enumerate() {
        all[i] = (2.0 * cell[a] as f64 + 1.0) / CELLS as f64 - 1.0;
    }
    UnitQuaternion::from_quaternion(Quaternion::new(all[0], all[1], all[2], all[3]))
}

/// The cell that holds an orientation.
fn cell_of(q: &UnitQuaternion<f64>) -> usize {
    let all = [q.w, q.i, q.j, q.k];
    let k = (0..4).max_by(|&a, &b| all[a].abs().total_cmp(&all[b].abs())).unwrap();
    let others = (0..4).filter(|&i| i != k);
    others.fold(k, |at, i| {
        let line = ((all[i] / all[k] + 1.0) * 0.5 * CELLS as f64) as usize;
        at * CELLS + line.min(CELLS - 1)
    })
}

/// det A of the Agile Eye in a posture of each leg, by vectors alone: the elbows are perpendicular to a motor's axis and a joint; `None` where a
/// leg folds. B_jj is the derivative of w·v as the elbow turns about the motor's axis.
fn det_a(q: &UnitQuaternion<f64>, postures: [f64; 3]) -> Option<f64> {
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let rows: Vec<Vector3<f64>> = [(x, -y), (y, -z), (z, -x)]
        .into_iter()
        .zip(postures)
        .filter_map(|((e, joint), posture)| {
            let v = q * joint;
            let w = e.cross(&v).try_normalize(1e-9)?;
            let w = w * (posture * v.dot(&e.cross(&w)).signum());
            Some(v.cross(&w))
        })
        .collect();
    (rows.len() == 3).then(|| rows[0].dot(&rows[1].cross(&rows[2])))
}

/// How many sets the cells with each sign of det A fall into, neighbours being joined.
fn flood(postures: [f64; 3]) -> [usize; 2] {
    let middle = |at: usize| {
        let cell = [at / CELLS / CELLS % CELLS, at / CELLS % CELLS, at % CELLS];
        orientation(at / CELLS.pow(3), cell)
    };
    let all = 4 * CELLS.pow(3);
    let sign: Vec<Option<bool>> =
        (0..all).map(|at| det_a(&middle(at), postures).map(|det| det > 0.0)).collect();
    let mut seen = vec![false; all];
    let mut sets = [0; 2];
    for start in 0..all {
        let Some(positive) = sign[start].filter(|_| !seen[start]) else { continue };
        sets[usize::from(!positive)] += 1;
        let mut open = vec![start];
        seen[start] = true;
        while let Some(at) = open.pop() {
            let q = middle(at);
            // A step of a cell along each of the three directions of the sphere, both ways.
            for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                for step in [2.0, -2.0].map(|turn| turn / CELLS as f64) {
                    let next = cell_of(&(q * UnitQuaternion::from_scaled_axis(axis * step)));
                    if !seen[next] && sign[next] == Some(positive) {
                        seen[next] = true;
                        open.push(next);
                    }
                }
            }
        }
    }
    sets
}

#[test]
fn every_mode_is_one_aspect() {
    let analysis = analyzed(&eye(), Options { certificate: true, ..Options::default() });
    assert_eq!((analysis.aspects.low, analysis.aspects.high, analysis.run.stop), (8, Some(8), Stop::Exact));
    assert!(analysis.agile_eye && analysis.doubts.is_empty() && analysis.uncharted_folds.is_empty());
    for class in &analysis.classes {
        let postures = std::array::from_fn(|j| f64::from(class.mode.sign(j)));
        let counted = flood(postures)[usize::from(class.det_a == DetSign::Negative)];
        assert_eq!((class.low, class.high), (counted, Some(counted)), "{} {}", class.mode, class.det_a);
    }
    assert!(is_accepted(&analysis.certificate.unwrap()));
}

/// The sign is known with limits and in slices too; the number is not claimed there.
#[test]
fn limits_and_slices_are_searched() {
    let limited = Robot::from_toml(
        &catalogue::all().iter().find(|entry| entry.name == "spherical-3-rrr").unwrap().text.replacen(
            "distal = { deg = 90 } }",
            "distal = { deg = 90 } }\nlimits = { actuator = { deg = [-60, 60] } }",
            1,
        ),
        "limited.toml",
    )
    .unwrap();
    let budget = Budget { depth: Some(4), ..Budget::default() };
    let options = Options { budget, certificate: true, ..Options::default() };
    let slice = Options { fix: vec![(1, 0.3)], ..options.clone() };
    for analysis in [analyzed(&limited, options), analyzed(&eye(), slice)] {
        assert_eq!(analysis.aspects.high, None);
        assert_eq!(analysis.classes.iter().filter(|class| class.high == Some(0)).count(), 8);
        let certificate = analysis.certificate.unwrap();
        assert!(is_accepted(&certificate));
        for claim in 0..16 {
            let mut forged = certificate.clone();
            forged.claims[claim].high = Some(forged.claims[claim].low);
            assert_eq!(is_accepted(&forged), forged.claims[claim] == certificate.claims[claim], "{claim}");
        }
    }
}

#[test]
fn forged_certificates_are_refused() {
    let certificate = certificate(&eye(), 4);
    assert!(is_accepted(&certificate));
    let mut random = Random(22);
    let mut refused = 0;
    for case in 0..12 {
        let mut forged = certificate.clone();
        let (leg, axis) = (random.below(3), random.below(3));
        let by = Interval::point(random.within(1e-12, 1e-6));
        match case % 6 {
            0 => forged.robot.legs[leg].frame[2][axis] = forged.robot.legs[leg].frame[2][axis] + by,
            1 => forged.robot.legs[leg].attachment[axis] = forged.robot.legs[leg].attachment[axis] + by,
            2 => {
                let Actuator::Spherical(links) = &mut forged.robot.legs[leg].actuator else { unreachable!() };
                links.distal_cos = by;
            }
            3 => {
                let Actuator::Spherical(links) = &mut forged.robot.legs[leg].actuator else { unreachable!() };
                links.proximal.0 = by;
            }
            4 => {
                // Left-handed axes: det A has the other sign.
                let frame = &mut forged.robot.legs[leg].frame;
                (frame[1], frame[2]) = (frame[1].map(|x| -x), frame[2].map(|x| -x));
            }
            _ => {
                let claim = &mut forged.claims[random.below(16)];
                (claim.low, claim.high) = (1 - claim.low, Some(1 - claim.low));
            }
        }
        assert!(!is_accepted(&forged), "case {case}: {:?}", forged.robot.legs);
        refused += 1;
    }
    assert_eq!(refused, 12);
}

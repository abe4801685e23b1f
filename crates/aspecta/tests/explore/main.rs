//! Roadmaps of free bodies: what is joined is joined by segments that hold when looked at again.

#[path = "../random/split_mix.rs"]
#[allow(dead_code)]
mod split_mix;

use aspecta::aspect::DetSign;
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::motion::check_path;
use aspecta::motion::explore::{Effort, NoWay, explore, plan};
use aspecta::motion::plan::{Plan, PlanOptions, Refusal};
use aspecta::paving::Control;
use aspecta::robot::{Robot, catalogue};
use nalgebra::{DMatrix, DVector};
use split_mix::Random;
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

static NEVER: AtomicBool = AtomicBool::new(false);

fn control() -> Control<'static> {
    Control { cancelled: &NEVER, progress: &|_| {} }
}

fn robot(name: &str) -> Robot {
    catalogue::find(name).unwrap()
}

/// The strut lengths at which all 40 direct solutions of Dietmaier's platform are real.
const DIETMAIER: [f64; 6] = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];

/// Direct solutions by Newton's method on differences, from random poses: sorted by roll, each once.
fn direct(robot: &Robot, q: &[f64], starts: usize) -> Vec<Solution> {
    let mut random = Random(7);
    let mut found: Vec<Solution> = Vec::new();
    let mode = robot.working_modes()[0];
    let residual = |x: &[f64]| -> Option<DVector<f64>> {
        let at = robot.inverse_in(x, mode).ok()??;
        Some(DVector::from_fn(6, |j, _| at[j] - q[j]))
    };
    for _ in 0..starts {
        let draw = |k: usize, random: &mut Random| {
            if k < 3 { random.within(-2.0, 2.0) } else { random.within(-PI, PI) }
        };
        let mut x: Vec<f64> = (0..6).map(|k| draw(k, &mut random)).collect();
        for _ in 0..40 {
            let Some(f) = residual(&x) else { break };
            if f.norm() < 1e-13 {
                break;
            }
            let column = |k: usize| {
                let (mut a, mut b) = (x.clone(), x.clone());
                (a[k], b[k]) = (a[k] - 1e-6, b[k] + 1e-6);
                Some((residual(&b)? - residual(&a)?) / 2e-6)
            };
            let Some(columns) = (0..6).map(column).collect::<Option<Vec<_>>>() else { break };
            let Some(step) = DMatrix::from_columns(&columns).lu().solve(&f) else { break };
            let size = (0.5 / step.norm()).min(1.0);
            (0..6).for_each(|k| x[k] -= size * step[k]);
        }
        if !residual(&x).is_some_and(|f| f.norm() < 1e-12) {
            continue;
        }
        // In coordinates with the pitch within ±π/2.
        let turn = nalgebra::Rotation3::from_euler_angles(x[3], x[4], x[5]).euler_angles();
        (x[3], x[4], x[5]) = turn;
        if found.iter().all(|s| apart(&s.pose, &x) > 1e-6) {
            found.extend(robot.inverse(&x).unwrap());
        }
    }
    found.sort_by(|a, b| a.pose[3].total_cmp(&b.pose[3]));
    found
}

/// The distance between two poses of a free body, whatever their coordinates.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let turn = |x: &[f64]| nalgebra::Rotation3::from_euler_angles(x[3], x[4], x[5]);
    let far = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    far + turn(a).angle_to(&turn(b))
}
#[test]
fn experiment() {
    let robot = robot("gough-stewart");
    let begin = std::time::Instant::now();
    let solutions = direct(&robot, &DIETMAIER, 3000);
    eprintln!("{} solutions in {:?}", solutions.len(), begin.elapsed());
    for s in &solutions { eprintln!("{:?} {:.4} {}", s.pose, s.det_a, s.within_limits); }
    let begin = std::time::Instant::now();
    let e = explore(&robot, &[], &Effort { samples: 2048, seconds: Some(60.0) }, &control()).unwrap();
    for c in &e.classes {
        eprintln!("{} {}: {} comps, {:?} {:?}", c.mode, c.det_a, c.components.len(), c.end, begin.elapsed());
        for k in c.components.iter().take(8) { eprintln!("  {} {} {:.5}", k.poses, k.samples, k.clearance); }
    }
    for sign in [1.0, -1.0] {
        let same: Vec<&Solution> = solutions.iter().filter(|s| s.det_a * sign > 0.0).collect();
        eprintln!("{} of sign {sign}", same.len());
        for (i, pair) in same.windows(2).enumerate() {
            let begin = std::time::Instant::now();
            let r = plan(&robot, pair[0].mode, [&pair[0].pose, &pair[1].pose], &PlanOptions::default(),
                &Effort { samples: 20000, seconds: Some(10.0) }, &control());
            match r { Ok(p) => eprintln!("  {i} joined, {} waypoints, length {:.3}, {:?}", p.waypoints.len(), p.length, begin.elapsed()),
              Err(e) => eprintln!("  {i} {e} {:?}", begin.elapsed()) }
        }
    }
}

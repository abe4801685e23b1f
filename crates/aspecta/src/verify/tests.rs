//! Certificates that hold, and certificates with planted faults.

use super::view::View;
use super::*;
use crate::aspect::atlas::{Atlas, Leaf};
use crate::certificate::Claim;
use crate::paving::Budget;
use crate::robot::{Robot, catalogue};
use std::sync::atomic::AtomicBool;

const NO: AtomicBool = AtomicBool::new(false);

fn checked(certificate: &Certificate) -> Verdict {
    verify(certificate, &Control { cancelled: &NO, progress: &|_| {} })
}

/// A certificate that claims the most that its leaves prove.
fn certify(robot: &Robot, fix: &[(usize, f64)], coarse: u32, fine: u32) -> Certificate {
    let window = robot.slice(fix).unwrap();
    let control = Control { cancelled: &NO, progress: &|_| {} };
    let modes = robot.working_modes();
    let budget = Budget { depth: Some(coarse), ..Budget::default() };
    let mut atlas = Atlas::new(robot, &window, &modes, &budget, &control);
    let mut leaves = atlas.open_leaves();
    loop {
        let open = atlas.survey(&leaves);
        let todo: Vec<Leaf> =
            open.iter().copied().filter(|&(s, n)| atlas.sheets[s].depth_of(n) < fine).collect();
        if todo.is_empty() {
            println!("open {}", open.len());
            break;
        }
        leaves = atlas.split(&todo, &control);
    }
    let nothing = vec![Claim { low: 0, high: None }; 2 * modes.len()];
    let mut certificate = Certificate::new(robot, &atlas.scale, &atlas.sheets, vec![], vec![], nothing);
    let verdict = checked(&certificate);
    for fault in &verdict.faults {
        println!("{}", fault.in_words(&certificate.modes));
    }
    assert!(verdict.is_verified());
    certificate.claims = verdict.classes.iter().map(|c| c.proved).collect();
    certificate
}

#[test]
fn experiment() {
    let name = std::env::var("R").unwrap_or("five-bar".into());
    let number = |name: &str, usual: u32| std::env::var(name).map_or(usual, |d| d.parse().unwrap());
    let robot = catalogue::find(&name).unwrap();
    let fix: Vec<(usize, f64)> =
        std::env::var("PHI").ok().map(|x| (2, x.parse().unwrap())).into_iter().collect();
    let certificate = certify(&robot, &fix, number("DEPTH", 6), number("MOSTD", 12));
    let t = std::time::Instant::now();
    let verdict = checked(&certificate);
    println!("{:?}", t.elapsed());
    println!("{:?} {} {}", verdict.claims, verdict.boxes, verdict.leaves);
    for class in &verdict.classes {
        println!("{class:?}");
    }
    println!("{} bytes", certificate.to_json().unwrap().len());
}

#[test]
fn debug_summit() {
    use crate::kinematics::chart::{Chart, folds};
    let robot = catalogue::find("3-rrr").unwrap();
    let window = robot.slice(&[]).unwrap();
    let modes = robot.working_modes();
    let scale = crate::aspect::Scale::of(&robot, &window, &modes);
    let chart = Chart::Fold(folds(&robot, &window)[1].clone());
    let setting =
        Setting { robot: &robot, chart: &chart, window: charts::window_of(&chart, &window), scale: &scale };
    for (class, y) in [
        (
            15,
            [
                Interval::new(1.472622, 1.570796),
                Interval::new(-0.234375, -0.225),
                Interval::new(-0.490874, -0.392699),
            ],
        ),
        (
            8,
            [
                Interval::new(-2.552544, -2.454369),
                Interval::new(0.243750, 0.253125),
                Interval::new(0.981748, 1.079922),
            ],
        ),
    ] {
        let mut open = vec![(y, 0)];
        let mut counts = vec![0; 60];
        let mut deepest = 0;
        let mut last = None;
        for _ in 0..60000 {
            let Some((y, depth)) = open.pop() else {
                println!("PROVED");
                break;
            };
            let view = View::new(&setting, y);
            let mode = modes[class / 2];
            if view.existence(mode) == view::Existence::Nowhere {
                continue;
            }
            if (view.determinant(mode) * Interval::point(claims::sign_of(class))).hi <= 0.0 {
                continue;
            }
            if view.is_summitless(mode, claims::sign_of(class)) {
                continue;
            }
            counts[depth] += 1;
            if depth > deepest {
                deepest = depth;
                last = Some(y);
            }
            if depth > 30 {
                continue;
            }
            let (a, b) = claims::halves(&setting, &y);
            open.extend([(a, depth + 1), (b, depth + 1)]);
        }
        println!("class {class} counts {counts:?} {last:?}");
        let y = last.unwrap();
        View::new(&setting, y).explain(modes[class / 2], claims::sign_of(class));
    }
}

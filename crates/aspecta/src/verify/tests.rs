//! Certificates that hold, and certificates with planted faults.

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
    let mut certificate =
        Certificate::new(robot, &atlas.scale, &atlas.sheets, vec![], vec![], nothing);
    let verdict = checked(&certificate);
    for fault in &verdict.faults {
        println!("{fault}");
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
    let fix: Vec<(usize, f64)> = std::env::var("PHI").ok().map(|x| (2, x.parse().unwrap())).into_iter().collect();
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

//! Certificates that hold, and certificates with planted faults.

use super::*;
use crate::aspect::certified::certified;
use crate::paving::Budget;
use crate::robot::{Robot, catalogue};
use std::sync::atomic::AtomicBool;

fn checked(certificate: &Certificate) -> Verdict {
    verify(certificate, &Control { cancelled: &AtomicBool::new(false), progress: &|_| {} })
}

/// A certificate that claims the most that its leaves prove.
fn certify(robot: &Robot, fix: &[(usize, f64)], budget: &Budget) -> Certificate {
    let mut certificate = certified(robot, fix, budget);
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
    let number = |name: &str| std::env::var(name).ok().map(|d| d.parse::<f64>().unwrap());
    let robot = catalogue::find(&name).unwrap();
    let fix: Vec<(usize, f64)> = std::env::var("PHI").ok().map(|x| (2, x.parse().unwrap())).into_iter().collect();
    let budget = Budget { depth: number("DEPTH").map(|d| d as u32), boxes: number("BOXES").map(|d| d as u64), ..Budget::default() };
    let t = std::time::Instant::now();
    let certificate = certified(&robot, &fix, &budget);
    println!("searched {:?}", t.elapsed());
    let certificate = Certificate::from_json(certificate.to_json().unwrap().as_bytes()).unwrap();
    let t = std::time::Instant::now();
    let verdict = checked(&certificate);
    println!("{:?}", t.elapsed());
    for fault in &verdict.faults {
        println!("{}", fault.in_words(&certificate.modes));
    }
    println!("{:?} {} {}", verdict.claims, verdict.boxes, verdict.leaves);
    for class in &verdict.classes {
        println!("{class:?}");
    }
    println!("{} bytes", certificate.to_json().unwrap().len());
}

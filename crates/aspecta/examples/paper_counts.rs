//! The paper's two robots: Table 2 of the five-bar, and the same for the 3-RRR of Table 3.
use aspecta::aspect::{Options, analyze};
use aspecta::paving::{Budget, Control};
use aspecta::robot::{Leg, Platform, Robot};
use std::sync::atomic::AtomicBool;

fn main() {
    let depth = std::env::args().nth(1).and_then(|d| d.parse().ok());
    let five_bar = vec![
        Leg::revolute([0.0, 0.0], [0.0, 0.0], 8.0, 5.0),
        Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8.0),
    ];
    let three_rrr = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    for robot in [
        Robot::new("five-bar", Platform::PlanePoint, five_bar).unwrap(),
        Robot::new("3-rrr", Platform::PlaneBody, three_rrr).unwrap(),
    ] {
        let control = Control {
            cancelled: &AtomicBool::new(false),
            progress: &|p| {
                if std::env::var("V").is_ok() && (p.stage != "joining pieces" || p.done % 1000 == 0) {
                    eprintln!("{p:?}")
                }
            },
        };
        let options = Options { budget: Budget { depth, ..Budget::default() } };
        let t = std::time::Instant::now();
        let pav = aspecta::paving::Paving::new(
            &robot,
            &robot.workspace_window().unwrap(),
            &robot.working_modes(),
            &options.budget,
            &control,
        );
        println!("paving {:?}: {} boxes {} nodes", t.elapsed(), pav.boxes, pav.nodes.len());
        drop(pav);
        let analysis = analyze(&robot, &options, &control).unwrap();
        println!("{}: {:?} {:?}", robot.name, analysis.aspects, analysis.run);
        for c in &analysis.classes {
            let pieces: Vec<usize> = c.aspects.iter().map(|a| a.pieces).collect();
            let share = c.undecided / (c.measure + c.undecided) * 100.0;
            println!(
                "{} {}: {} {:.4} +{:.4} ({share:.2} %) {:?}",
                c.mode,
                c.det_a,
                c.low,
                c.measure,
                c.undecided,
                &pieces[..pieces.len().min(12)]
            );
        }
    }
}

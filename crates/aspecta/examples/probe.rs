//! probe
use aspecta::paving::*;
use aspecta::robot::*;
use std::sync::atomic::AtomicBool;
fn main() {
    let depth = std::env::args().nth(1).and_then(|d| d.parse().ok());
    let legs = vec![
        Leg::revolute([-10.0, -10.0], [0.0, 0.0], 10.0, 10.0),
        Leg::revolute([10.0, -10.0], [10.0, 0.0], 10.0, 10.0),
        Leg::revolute([0.0, 10.0], [10.0, 10.0], 10.0, 10.0),
    ];
    let robot = Robot::new("3-rrr", Platform::PlaneBody, legs).unwrap();
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let t = std::time::Instant::now();
    let p = Paving::new(
        &robot,
        &robot.workspace_window().unwrap(),
        &robot.working_modes(),
        &Budget { depth, ..Budget::default() },
        &control,
    );
    let dt = t.elapsed().as_secs_f64();
    println!("{} boxes in {dt:.2} s: {:.2} M/s", p.boxes, p.boxes as f64 / dt / 1e6);
    let mode = "+++".parse().unwrap();
    let mut cat = [0usize; 8];
    let (mut n, mut cross_d, mut cross_h, mut none, mut inside) = (0, 0, 0, 0, 0);
    let sight = |n: &Node| n.of_classes(3);
    let _ = sight;
    for (i, node) in p.nodes.iter().enumerate() {
        if node.first_child != 0 {
            continue;
        }
        if node.inside & 3 != 0 {
            inside += 1;
        }
        if node.undecided & 3 == 0 {
            continue;
        }
        n += 1;
        let (lo, hi) = p.bounds(i as u32);
        let (mut out, mut plus, mut minus) = (0, 0, 0);
        for c in 0..27 {
            let f = [c % 3, c / 3 % 3, c / 9];
            let x: Vec<f64> = (0..3).map(|k| lo[k] + (hi[k] - lo[k]) * f[k] as f64 / 2.0).collect();
            match robot.inverse_in(&x, mode).unwrap() {
                None => out += 1,
                Some(q) => {
                    if robot.jacobians(&x, &q).unwrap().det_a() > 0.0 {
                        plus += 1
                    } else {
                        minus += 1
                    }
                }
            }
        }
        if out > 0 && plus + minus > 0 {
            cross_h += 1
        } else if plus > 0 && minus > 0 {
            cross_d += 1
        } else {
            none += 1;
            let c = (node.closed & 1) as usize;
            let two = (node.undecided & 3 == 3) as usize;
            cat[c * 4 + two * 2 + (out == 27) as usize] += 1;
        }
    }
    println!("closed*4+both*2+allout {cat:?}");
    println!("inside {inside} undecided {n}: cross H {cross_h}, cross D {cross_d}, none seen {none}");
    let share: u64 = p
        .nodes
        .iter()
        .filter(|n| n.first_child == 0)
        .map(|n| (0..8).filter(|m| n.undecided >> (2 * m) & 3 != 0).count() as u64)
        .sum();
    let ins: f64 = (0..8)
        .map(|m| {
            let mut s = 0.0;
            p.boxes_of(&|n| n.of_classes(3 << (2 * m)), &mut |at| {
                if p.nodes[at as usize].inside >> (2 * m) & 3 != 0 {
                    s += p.measure(p.depth_of(at))
                }
            });
            s
        })
        .sum();
    let und = share as f64 * p.measure(p.depth());
    println!("share undecided {:.3} inside vol {ins} und {und}", und / (und + ins));
}

//! Table 2 of the paper from the library: `cargo run --release -p aspecta --example table_2`.

use aspecta::aspect::{Options, analyze};
use aspecta::paving::Control;
use aspecta::robot::Robot;
use std::error::Error;
use std::sync::atomic::AtomicBool;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Robot::resolve("five-bar")?;
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let analysis = analyze(&robot, &Options::default(), &control)?;
    println!("{}: at least {} generalized aspects", robot.title, analysis.aspects.low);
    for class in &analysis.classes {
        println!(
            "mode {}, det A {}: {} aspects, area {:.2}",
            class.mode, class.det_a, class.low, class.measure
        );
        for aspect in &class.aspects {
            println!("  number {} holds the pose {:?}", aspect.id, aspect.sample.pose);
        }
    }
    Ok(())
}

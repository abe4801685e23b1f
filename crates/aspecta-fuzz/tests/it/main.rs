//! The frozen corpus: seeds, and what the fuzzer has found.

use aspecta::robot::work::Stopwatch;
use std::fs;
use std::path::Path;

/// The seconds that an input may take on a busy machine.
const PATIENCE: f64 = 5.0;

fn replay(target: &str, check: fn(&[u8])) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let mut inputs = 0;
    for entry in fs::read_dir(corpus).unwrap() {
        let path = entry.unwrap().path();
        println!("{}", path.display());
        let begin = Stopwatch::start();
        check(&fs::read(&path).unwrap());
        assert!(begin.seconds() < PATIENCE, "{} takes {} s", path.display(), begin.seconds());
        inputs += 1;
    }
    assert!(inputs > 0);
}

#[test]
fn robot_files() {
    replay("robot_file", aspecta_fuzz::robot_file);
}

#[test]
fn certificates() {
    replay("certificate", aspecta_fuzz::certificate);
}

#[test]
fn maps() {
    replay("map", aspecta_fuzz::map);
}

#[test]
fn csv() {
    replay("csv", aspecta_fuzz::csv);
}

#[test]
fn arguments() {
    replay("arguments", aspecta_fuzz::arguments);
}

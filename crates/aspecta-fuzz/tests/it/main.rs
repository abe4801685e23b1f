//! The frozen corpus: seeds, and what the fuzzer has found.

use std::fs;
use std::path::{Path, PathBuf};

/// The bytes that all inputs together stay below: one that took long, or much memory, is frozen as small as
/// `cargo fuzz tmin` makes it.
const ENOUGH: u64 = 200_000;

const TARGETS: [&str; 5] = ["robot_file", "certificate", "map", "csv", "arguments"];

fn inputs(target: &str) -> Vec<PathBuf> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    fs::read_dir(corpus).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// Checks all inputs, each named before it is looked at: one that does not end is the last.
fn replay(target: &str, check: fn(&[u8])) {
    let inputs = inputs(target);
    for path in &inputs {
        println!("{}", path.display());
        check(&fs::read(path).unwrap());
    }
    assert!(!inputs.is_empty());
}

#[test]
fn the_corpus_is_small() {
    let sizes =
        TARGETS.iter().flat_map(|target| inputs(target)).map(|path| fs::metadata(path).unwrap().len());
    let bytes: u64 = sizes.sum();
    assert!(bytes < ENOUGH, "{bytes} bytes");
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

//! The Python package, tested by Python: runs the tests beside this folder, and the examples of the documentation, on the
//! library that cargo has built.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs a command that must succeed.
fn run(command: &mut Command) {
    let done = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    let told = [done.stdout, done.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(done.status.success(), "{command:?}\n{told}");
}

/// A Python of the project's own with what the tests need; `None` if there is none to make it with.
fn python(here: &Path) -> Option<PathBuf> {
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let python = made.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let (wanted, installed) = (here.join("tests/requirements.txt"), made.join("installed"));
    if fs::read(&wanted).ok() == fs::read(&installed).ok() {
        return Some(python);
    }
    let suits = "import ensurepip, sys; assert sys.version_info >= (3, 10)";
    let found = Command::new("python3").args(["-c", suits]).output();
    if !found.is_ok_and(|found| found.status.success()) {
        assert!(
            std::env::var_os("ASPECTA_NEEDS_PYTHON").is_none(),
            "Python 3.10 or later with venv is needed"
        );
        eprintln!(
            "skipped: no Python 3.10 or later with venv; Debian's packages are python3 and python3-venv"
        );
        return None;
    }
    run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&made));
    run(Command::new(&python)
        .args(["-m", "pip", "install", "-q", "--disable-pip-version-check", "-r"])
        .arg(&wanted));
    fs::copy(wanted, installed).unwrap();
    Some(python)
}

/// The package as a wheel would install it, with the library that belongs to this test.
fn package(here: &Path) -> PathBuf {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("package");
    let (from, to) = (here.join("python/aspecta"), root.join("aspecta"));
    drop(fs::remove_dir_all(&to));
    fs::create_dir_all(&to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap).filter(|entry| entry.path().is_file()) {
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
    let test = std::env::current_exe().unwrap();
    let library = test.parent().unwrap().join(format!("{DLL_PREFIX}_native{DLL_SUFFIX}"));
    let name = if cfg!(windows) { "_native.pyd" } else { "_native.abi3.so" };
    fs::copy(&library, to.join(name)).unwrap_or_else(|e| panic!("{}: {e}", library.display()));
    root
}

#[test]
fn python_tests_and_examples_pass() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let Some(python) = python(here) else { return };
    let package = package(here);
    let mut tests = Command::new(python);
    tests.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "--doctest-modules", "tests"]);
    tests.arg(package.join("aspecta")).current_dir(here);
    run(tests.env("PYTHONPATH", &package).env("PYTHONDONTWRITEBYTECODE", "1"));
}

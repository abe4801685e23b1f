//! A C program, compiled with the system's compiler and linked with either library.

use aspecta_c::aspecta_report;
use aspecta_c::aspecta_status::*;
use std::mem::{offset_of, size_of};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where cargo puts the libraries that belong to this test: beside it.
fn built() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    test.parent().unwrap().to_owned()
}

/// Compiles `follow.c` and runs it; what it prints, or `None` without a C compiler.
fn run(name: &str, flags: &[&str], libraries: &[&str]) -> Option<String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let program = built().join(name);
    let mut compiler = Command::new("cc");
    compiler.args(["-std=gnu11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1"]).args(flags);
    compiler.arg("-I").arg(here.join("include")).arg(here.join("tests/it/follow.c")).arg("-o").arg(&program);
    compiler.args(libraries).args(["-lm", "-lpthread", "-ldl"]);
    let output = match compiler.output() {
        Ok(output) => output,
        Err(e) => {
            eprintln!("skipped: no C compiler `cc` ({e}); Debian's package is gcc");
            return None;
        }
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let output = Command::new(&program).env("LD_LIBRARY_PATH", built()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.ends_with("done\n"), "{text}");
    Some(text)
}

fn value(text: &str, name: &str) -> usize {
    let line = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
    line.unwrap_or_else(|| panic!("no {name} in\n{text}")).parse().unwrap()
}

/// The header says the same as the Rust.
fn check_layout(text: &str) {
    assert_eq!(value(text, "size"), size_of::<aspecta_report>());
    macro_rules! same {
        ($($field:ident)*) => { $(assert_eq!(value(text, stringify!($field)), offset_of!(aspecta_report, $field));)* };
    }
    same!(proved singular_at distance length_error angle_error negative_legs stretches same_aspect within_limits leg);
    let statuses = [
        ("OK", ASPECTA_OK),
        ("PARALLEL", ASPECTA_PARALLEL),
        ("SERIAL", ASPECTA_SERIAL),
        ("TOO_LONG", ASPECTA_TOO_LONG),
        ("BAD_INPUT", ASPECTA_BAD_INPUT),
        ("NULL", ASPECTA_NULL),
    ];
    for (name, status) in statuses {
        assert_eq!(value(text, name), status as usize);
    }
}

#[cfg(unix)]
#[test]
fn with_the_shared_library() {
    let search = format!("-L{}", built().display());
    let Some(text) = run("follow-shared", &[], &[&search, "-l:libaspecta_c.so"]) else { return };
    check_layout(&text);
}

/// Linked in whole, every allocation can be counted: steps make none, refused ones neither.
#[cfg(target_os = "linux")]
#[test]
fn with_the_static_library_and_no_allocation() {
    let library = built().join("libaspecta_c.a");
    let wrap = "-Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=posix_memalign";
    let flags = ["-DCOUNT_ALLOCATIONS", wrap];
    let Some(text) = run("follow-static", &flags, &[library.to_str().unwrap()]) else { return };
    check_layout(&text);
    assert_eq!(value(&text, "allocations"), 0);
}

/// Every function of the header is used by the C program, and no other is exported.
#[test]
fn the_header_and_the_program_know_the_same_functions() {
    let functions = |text: &str| -> Vec<String> {
        let names = text.split("aspecta_").skip(1).filter_map(|rest| {
            let end = rest.find(|c: char| !(c.is_ascii_lowercase() || c == '_'))?;
            rest[end..].starts_with('(').then(|| rest[..end].to_owned())
        });
        let mut names: Vec<_> = names.collect();
        names.sort();
        names.dedup();
        names
    };
    // What a comment mentions is no declaration.
    let header: String = include_str!("../../include/aspecta.h")
        .split("*/")
        .map(|part| part.split("/*").next().unwrap_or_default())
        .collect();
    let program = functions(include_str!("follow.c"));
    let exported =
        functions(&[include_str!("../../src/start.rs"), include_str!("../../src/step.rs")].concat());
    assert_eq!(functions(&header), program);
    assert_eq!(functions(&header), exported);
}

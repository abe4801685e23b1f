//! The kernel is Rust alone: nothing that it is built of compiles or links C, which would be tied to the machine that builds it.

use serde_json::Value;
use std::collections::BTreeMap;
use std::process::Command;

/// What build scripts compile or find foreign code with.
const TOOLS: [&str; 6] = ["bindgen", "cc", "cmake", "pkg-config", "system-deps", "vcpkg"];

/// Claims to link a library so that no program holds two of it, and links none.
const LINKS_NOTHING: &str = "rayon-core";

/// Returns the packages that `root` is built of, itself included, by name. Dependencies of tests do not count.
fn built_of<'a>(metadata: &'a Value, root: &str) -> BTreeMap<&'a str, &'a Value> {
    let list = |value: &'a Value| value.as_array().expect("a list");
    let text = |value: &'a Value| value.as_str().expect("a string");
    let packages: BTreeMap<_, _> = list(&metadata["packages"]).iter().map(|p| (text(&p["id"]), p)).collect();
    let nodes: BTreeMap<_, _> =
        list(&metadata["resolve"]["nodes"]).iter().map(|n| (text(&n["id"]), n)).collect();
    let mut found = BTreeMap::new();
    let mut open: Vec<_> = packages.iter().filter(|(_, p)| p["name"] == root).map(|(id, _)| *id).collect();
    while let Some(id) = open.pop() {
        if found.insert(id, packages[id]).is_none() {
            let needed = list(&nodes[id]["deps"])
                .iter()
                .filter(|d| list(&d["dep_kinds"]).iter().any(|k| k["kind"] != "dev"));
            open.extend(needed.map(|d| text(&d["pkg"])));
        }
    }
    found.into_values().map(|p| (text(&p["name"]), p)).collect()
}

#[test]
fn the_kernel_is_built_without_c() {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--manifest-path",
            concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"),
        ])
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo writes JSON");
    let kernel = built_of(&metadata, "aspecta");
    for name in ["aspecta-robot", "aspecta-kinematics", "aspecta-verify", "nalgebra"] {
        assert!(kernel.contains_key(name), "{name}");
    }
    assert!(!kernel.contains_key("proptest"));
    for (name, package) in &kernel {
        assert!(!TOOLS.contains(name), "{name} compiles C");
        assert!(package["links"].is_null() || *name == LINKS_NOTHING, "{name} links {}", package["links"]);
    }
    // What the tests compare with is such a package: it would be found.
    let compared_with = built_of(&metadata, "core-math");
    assert!(compared_with.keys().any(|name| TOOLS.contains(name)));
}

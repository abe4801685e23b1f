//! `aspecta domains --out` and `--fix`.

use crate::{aspecta, output};
use std::fs;

#[test]
fn pictures_are_written_and_named() {
    let directory = tempfile::tempdir().unwrap();
    let arguments = "domains five-bar --aspect 1 --cells 60 --budget depth=7 --out";
    let output = aspecta(arguments).arg(directory.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(!text.ends_with("\n\n") && !text.contains("\n\nwritten"), "{text}");
    let mut names: Vec<String> = fs::read_dir(directory.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let pictures = ["components", "regions", "sheets", "uniqueness"];
    assert_eq!(names, pictures.map(|what| format!("aspect-1-{what}.svg")));
    for name in names {
        let line = format!("written: {}", directory.path().join(&name).display());
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
    // With --json stdout holds nothing but JSON.
    let output = aspecta(arguments).arg(directory.path()).arg("--json").output().unwrap();
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok());
    assert!(String::from_utf8_lossy(&output.stderr).contains("written: "));
}

/// In the formats asked for, and no others.
#[test]
fn meshes_are_written_as_asked() {
    let meshes = |choice: &str| {
        let directory = tempfile::tempdir().unwrap();
        let arguments = format!("domains 3-rpr --det + --cells 12 --budget depth=5 {choice} --out");
        let output = aspecta(&arguments).arg(directory.path()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let names = fs::read_dir(directory.path()).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut meshes: Vec<String> = names.filter(|name| !name.ends_with(".svg")).collect();
        meshes.sort();
        let components = fs::read_to_string(directory.path().join("aspect-1-components.svg")).unwrap();
        (meshes, components)
    };
    let (usual, components) = meshes("");
    assert_eq!(usual, ["aspect-1-boundary.ply", "aspect-1-characteristic.ply", "aspect-1.glb"]);
    assert!(components.contains(">q₁ [unit]<") && components.contains(">q₃ = "));
    let (chosen, components) = meshes("--meshes vtp --hold q1");
    assert_eq!(chosen, ["aspect-1-boundary.vtp", "aspect-1-characteristic.vtp"]);
    assert!(components.contains(">q₃ [unit]<") && components.contains(">q₁ = "));
}

/// Before the long work: the depth asked for would take hours.
#[test]
fn a_directory_that_cannot_be_written_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("taken");
    fs::write(&taken, "a file").unwrap();
    let output = aspecta("domains 3-rrr --budget depth=12 --out")
        .arg(&taken)
        .timeout(std::time::Duration::from_secs(20))
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{messages}");
    assert!(
        output.stdout.is_empty() && messages.contains("--out ") && messages.contains("taken"),
        "{messages}"
    );
}

#[test]
fn without_out_nothing_is_written() {
    let text = output("domains five-bar --aspect 1 --cells 60 --budget depth=7");
    assert!(text.status.success() && !String::from_utf8_lossy(&text.stdout).contains("written"));
}

const SLICE: &str =
    "domains gough-stewart --fix y=0.1,roll=0.1,pitch=0.3,yaw=0.8 --det - --cells 40 --budget depth=8";

#[test]
fn slices_say_what_is_held_and_where_solutions_are_counted() {
    let directory = tempfile::tempdir().unwrap();
    let run = aspecta(SLICE).arg("--out").arg(directory.path()).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    let expected = [
        "on the slice y = 0.100000 unit, roll = 0.100000 rad",
        "outside the slice too",
        "x [unit]  z [unit]",
    ];
    assert!(expected.iter().all(|part| text.contains(part)), "{text}");
    let picture = fs::read_to_string(directory.path().join("aspect-2-regions.svg")).unwrap();
    let expected =
        ["y = 0.1 unit, roll = 0.1 rad", "in the class, on the slice or off it", "characteristic surface"];
    assert!(expected.iter().all(|part| picture.contains(part)), "{picture}");
    // There is no picture of a joint space of six.
    assert!(!directory.path().join("aspect-2-components.svg").exists());

    let json: serde_json::Value = serde_json::from_slice(&output(&format!("{SLICE} --json")).stdout).unwrap();
    assert_eq!(json["fixed"][0], serde_json::json!(["y", 0.1]));
    let regions = json["domains"][0]["regions"].as_array().unwrap();
    assert!(
        regions.len() > 1 && regions.iter().all(|r| r["pose"].as_array().unwrap().len() == 6),
        "{regions:?}"
    );
}

#[test]
fn what_slices_have_not_is_refused() {
    let refused = |arguments: &str, expected: &str| {
        let output = output(arguments);
        let messages = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && messages.contains(expected), "{arguments}: {messages}");
    };
    refused(&format!("{SLICE} --save x.aspecta"), "--save keeps maps of whole workspaces");
    refused("domains gough-stewart", "--fix roll=0,pitch=0,yaw=0");
    refused("domains 3-rrr --fix z=1", "has no coordinate `z`");
    let line = "domains 3-rrr --fix phi=0.3,y=0 --mode +++ --det + --cells 100";
    refused(&format!("{line} --out x"), "two or three free coordinates");
    assert!(output(line).status.success());

    let directory = tempfile::tempdir().unwrap();
    let map = directory.path().join("map.aspecta");
    let save =
        aspecta("domains five-bar --aspect 1 --cells 60 --budget depth=7 --save").arg(&map).output().unwrap();
    assert!(save.status.success());
    refused(&format!("domains {} --fix x=1", map.display()), "--fix is for robots");
}

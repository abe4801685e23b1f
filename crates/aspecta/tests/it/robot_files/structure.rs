//! Mistakes in the structure of a file: syntax, keys, names, types, legs.

use super::*;
use aspecta::robot::{Problem, RobotError};
use proptest::prelude::*;
use std::path::Path;

#[test]
fn a_mistake_is_shown_in_its_line() {
    let (mistake, message) = invalid(&PLANE.replacen("crank = 8", "crank = -8", 1));
    assert_eq!((mistake.line, mistake.column), (7, 41));
    assert_eq!((mistake.key.as_str(), mistake.value.as_str()), ("legs[1].actuator.crank", "-8"));
    assert_eq!(mistake.problem, Problem::NotPositive);
    let wanted = "\
my.toml:7:41: legs[1].actuator.crank = -8: a length must be positive; directions and signs belong into `axis`, \
`zero` or `direction`
  |
7 | actuator = { kind = \"revolute\", crank = -8, rod = 5 }
  |                                         ^^";
    assert_eq!(message, wanted);
}

#[test]
fn columns_count_characters_and_lines_may_end_as_on_windows() {
    let text = PLANE.replacen("crank = 8", "\t\"crank\" = \"é\"", 1).replace('\n', "\r\n");
    let (mistake, message) = invalid(&text);
    assert_eq!((mistake.line, mistake.column, mistake.width), (7, 44, 3));
    assert!(!message.contains('\r'));
}

#[test]
fn unknown_keys() {
    let message = says(PLANE, "crank", "crnak");
    assert_eq!(
        message,
        "legs[1].actuator.crnak: unknown key (did you mean `crank`?); the keys here are `kind`, `crank`, `rod`"
    );
    assert_starts(&says(PLANE, "anchor", "ancor"), "legs[1].ancor: unknown key (did you mean `anchor`?)");
    assert_starts(
        &says(PLANE, "name", "nam"),
        "nam: unknown key (did you mean `name`?); the keys here are `name`, `title`",
    );
    let message = says(PLANE, "[[legs]]", "[windw]\nx = [0, 1]\n\n[[legs]]");
    assert_starts(&message, "windw: unknown key (did you mean `window`?)");
    let message = says(SPACE, "actuator = [1, 7]", "actuator = [1, 7], elbows = 3");
    assert_starts(&message, "legs[3].limits.elbows: unknown key (did you mean `elbow`?)");
}

/// Of the keys of actuators those that the kind takes, in the plane or in space; all if the kind is not known.
#[test]
fn unknown_keys_of_an_actuator() {
    let known = |text: &str, from: &str, to: &str| {
        let message = says(text, from, to);
        message.split_once("; the keys here are ").expect(&message).1.to_owned()
    };
    assert_eq!(known(SPACE, "crank =", "krank ="), "`kind`, `crank`, `rod`, `axis`, `zero`");
    assert_eq!(known(SPACE, "direction =", "crank = 1, dir ="), "`kind`, `rod`, `direction`");
    assert_eq!(known(SPACE, "\"strut\"", "\"strut\", length = 3"), "`kind`");
    assert_eq!(known(SPHERE, "distal =", "dist ="), "`kind`, `axis`, `zero`, `proximal`, `distal`");
    let all = "`kind`, `crank`, `rod`, `direction`, `axis`, `zero`, `proximal`, `distal`";
    assert_eq!(known(SPACE, "kind = \"strut\"", "kin = \"strut\""), all);
    assert_eq!(known(SPACE, "kind = \"strut\"", "a = 3, kind = \"ram\""), all);
}

#[test]
fn words_that_name_nothing_or_break_lines() {
    for bad in ["\"\"", "\" \""] {
        let message = says(PLANE, "\"test\"", bad);
        assert_starts(&message, &format!("name = {bad}: the name is empty; give the robot a short name"));
    }
    for bad in ["\"a\\nb\"", "\"a\\tb\"", "\"\\u001b[31m\""] {
        let message = says(PLANE, "\"test\"", bad);
        assert_starts(
            &message,
            &format!("name = {bad}: a line break, tab or other character that cannot be seen; write"),
        );
    }
    assert_starts(&says(PLANE, "\"test\"", "\"\"\"a\nb\"\"\""), "name: a line break");
    for key in ["title", "source", "length-unit"] {
        let line = format!("{key} = \"m\\nm\"");
        let message = says(PLANE, "[[legs]]", &format!("{line}\n\n[[legs]]"));
        assert_starts(&message, &format!("{line}: a line break"));
    }
}

#[test]
fn unknown_names() {
    let message = says(PLANE, "plane-point", "plane-dot");
    assert_starts(
        &message,
        "platform = \"plane-dot\": unknown name (did you mean `plane-point` or `plane-body`?); give one of",
    );
    let message = says(PLANE, "revolute", "rotary");
    assert_starts(&message, "legs[1].actuator.kind = \"rotary\": unknown name");
    assert!(message.ends_with("give one of `revolute`, `prismatic`, `strut`, `spherical`"), "{message}");
}

#[test]
fn missing_keys() {
    assert_starts(&says(PLANE, "name = \"test\"", ""), "missing key `name`: give the robot a short name");
    assert_starts(
        &says(PLANE, "platform = \"plane-point\"", ""),
        "missing key `platform`: say what the platform",
    );
    assert_starts(
        &says(PLANE, ", rod = 5", ""),
        "legs[1].actuator: missing key `rod`: give the length of the rod",
    );
    assert_starts(&says(PLANE, "anchor = [9, 0]", ""), "legs[2]: missing key `anchor`: give the point A");
    assert_starts(
        &says(SPACE, ", zero = [1, 0, 5]", ""),
        "legs[1].actuator: missing key `zero`: say where the crank",
    );
    let message = says(PLANE, "actuator = { kind = \"revolute\", crank = 8, rod = 5 }", "");
    assert_starts(&message, "legs[1]: missing key `actuator`");
    assert_starts(&says(SPHERE, "attachment = [0, -1, 0]", ""), "legs[1]: missing key `attachment`");
    assert_starts(
        &says(PLANE, "kind = \"revolute\", ", ""),
        "legs[1].actuator: missing key `kind`: one of `revolute`",
    );
    assert_starts(&says("", "", ""), "missing key `name`");
    // The first key is not to blame.
    assert_starts(&says("", "", "length-unit = \"mm\"\n"), "missing key `name`");
}

#[test]
fn wrong_types() {
    assert_starts(
        &says(PLANE, "crank = 8", "crank = \"8\""),
        "legs[1].actuator.crank = \"8\": wrong type: string \"8\", expected a number",
    );
    assert_starts(
        &says(PLANE, "[9, 0]", "[9, true]"),
        "legs[2].anchor[2] = true: wrong type: boolean `true`, expected a number",
    );
    assert_starts(
        &says(PLANE, "[9, 0]", "9"),
        "legs[2].anchor = 9: wrong type: integer `9`, expected a list in brackets",
    );
    assert_starts(&says(PLANE, "\"test\"", "3"), "name = 3: wrong type: integer `3`, expected a string");
    assert_starts(
        &says("", "", "name = \"x\"\nplatform = \"plane-point\"\nlegs = [1]"),
        "legs[1] = 1: wrong type: integer `1`, expected the table of a leg",
    );
    assert_starts(&says(SPACE, "[1, 7]", "[1, 7, 8]"), "legs[3].limits.actuator = [1, 7, 8]: wrong type");
    assert_starts(
        &says(SPACE, "[1, 7]", "[1]"),
        "legs[3].limits.actuator = [1]: wrong type: expected two numbers, [min, max]",
    );
    let message =
        says(SPACE, "zero = [1, 0, 5] }", "zero = [1, 0, 5] }\nlimits = { elbow = { deg = [1, 2, 3] } }");
    assert_starts(&message, "legs[1].limits.elbow.deg = [1, 2, 3]: wrong type: expected two numbers");
}

#[test]
fn wrong_number_of_legs() {
    let two = PLANE.find("[[legs]]\nanchor = [9").unwrap();
    let message = says(&PLANE[..two], "name", "name");
    assert_starts(
        &message,
        "legs[1]: platform `plane-point` has 2 degrees of freedom and needs 2 legs, not 1",
    );
    let message = says(PLANE, "plane-point", "plane-body");
    assert_starts(
        &message,
        "legs[2]: platform `plane-body` has 3 degrees of freedom and needs 3 legs, not 2",
    );
    let (mistake, _) =
        invalid(&format!("{PLANE}\n[[legs]]\nanchor = [1, 1]\nactuator = {{ kind = \"strut\" }}\n"));
    assert_eq!((mistake.key.as_str(), mistake.line), ("legs[3]", 13));
    assert!(matches!(mistake.problem, Problem::Robot(RobotError::LegCount { wanted: 2, found: 3, .. })));
    assert_starts(
        &says("", "", "name = \"x\"\nplatform = \"free-body\""),
        "platform = \"free-body\": platform `free-body` has 6",
    );
}

#[test]
fn leg_kinds_that_do_not_fit_the_platform() {
    let message = says(SPHERE, "turning-body", "translating-body");
    assert_starts(
        &message,
        "legs[1].actuator.kind = \"spherical\": leg 1: a spherical leg cannot drive a `translating-body`",
    );
    let message = says(SPACE, "translating-body", "turning-body");
    assert_starts(
        &message,
        "legs[1].actuator.kind = \"revolute\": leg 1: a revolute leg cannot drive a `turning-body`",
    );
}

#[test]
fn files_that_are_not_toml() {
    let cut = PLANE.find(", rod = 5").unwrap();
    let (mistake, message) = invalid(&PLANE[..cut]);
    assert_eq!(mistake.line, 7);
    assert!(
        message.contains("this is not TOML: ") && message.contains("it may have been cut off"),
        "{message}"
    );
    assert!(message.contains("7 | actuator = { kind = \"revolute\", crank = 8"), "{message}");
    let twice = says(PLANE, "name = \"test\"", "name = \"a\"\nname = \"b\"");
    assert_eq!(twice, "`name` is given a second time; keep one of them");
    let twice = says(PLANE, "crank = 8", "crank = 8, crank = 9");
    assert_eq!(twice, "`crank` is given a second time; keep one of them");
    assert!(says(PLANE, "crank = 8", "crank = 8 mm").contains("not TOML"));
}

/// However a file is cut off, it is a robot or a mistake with a place inside the text: never a panic.
#[test]
fn every_truncation_is_reported() {
    let text = include_str!("../../../../../robots/delta.toml");
    for end in (0..text.len()).filter(|&k| text.is_char_boundary(k)) {
        if let Err(FileError::Invalid(m)) = Robot::from_toml(&text[..end], "cut.toml") {
            assert!(
                m.line <= text[..end].matches('\n').count() + 1
                    && m.column <= m.source_line.chars().count() + 1
            );
            assert!(!m.to_string().is_empty());
        }
    }
}

proptest! {
    /// Whatever is written over a part of a file, there is an answer that can be printed.
    #[test]
    fn damaged_files_are_reported(
        (which, at, length) in (0usize..12, 0usize..2000, 0usize..12),
        patch in "[-a-z0-9é={}\\[\\]\"'.,\\\\\n #]{0,12}",
    ) {
        let chars: Vec<char> = aspecta::robot::catalogue::all()[which].text.chars().collect();
        let (start, end) = (at.min(chars.len()), (at + length).min(chars.len()));
        let text: String = chars[..start].iter().copied().chain(patch.chars()).chain(chars[end..].iter().copied()).collect();
        if let Err(error) = Robot::from_toml(&text, "damaged.toml") {
            prop_assert!(error.to_string().starts_with("damaged.toml:"));
        }
    }
}

#[test]
fn files_that_cannot_be_read() {
    let missing = Robot::load(Path::new("no/such/robot.toml")).unwrap_err();
    assert_starts(&missing.to_string(), "no/such/robot.toml: cannot be read: ");
    assert!(matches!(Robot::resolve("no-such.toml"), Err(FileError::Unreadable { .. })));
    assert!(matches!(Robot::resolve(env!("CARGO_MANIFEST_DIR")), Err(FileError::Unreadable { .. })));
}

#[test]
fn no_more_is_read_than_a_robot_file_may_hold() {
    let endless = Robot::read(std::io::repeat(b'#'), "endless.toml");
    assert!(matches!(endless, Err(FileError::TooLarge { file }) if file == "endless.toml"));
    let largest = format!("{PLANE}#{}", " ".repeat((1 << 20) - PLANE.len() - 1));
    assert!(Robot::read(largest.as_bytes(), "largest.toml").is_ok());
    assert!(Robot::read(format!("{largest} ").as_bytes(), "larger.toml").is_err());
}

/// A message is short, however long a key, a value or a line is, and a file of a long key and many values takes
/// no time.
#[test]
fn what_is_long_is_not_repeated() {
    let long = "a".repeat(400_000);
    for text in [
        format!("{long} = [0{}]", ",0".repeat(200_000)),
        format!("platform = \"{long}\""),
        format!("x = [{}", "[".repeat(400_000)),
        format!("{long} = 1\n{long} = 2"),
        format!("legs = \"{long}\""),
    ] {
        let message = Robot::from_toml(&text, "long.toml").unwrap_err().to_string();
        assert!(message.len() < 2000, "{message}");
    }
    let message =
        Robot::from_toml(&format!("{}x = 1", " ".repeat(300)), "wide.toml").unwrap_err().to_string();
    let [.., line, underline] = message.lines().collect::<Vec<_>>()[..] else { panic!("{message}") };
    assert_eq!(line.find('x'), underline.find('^'), "{message}");
}

#[test]
fn names_are_resolved_or_suggested() {
    assert_eq!(Robot::resolve("five-bar").unwrap().name, "five-bar");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/delta.toml");
    assert_eq!(Robot::resolve(path).unwrap(), Robot::resolve("delta").unwrap());
    let message = Robot::resolve("fivebar").unwrap_err().to_string();
    assert_starts(&message, "`fivebar` is neither a built-in robot nor a file (did you mean `five-bar`");
    assert!(message.contains("built-in robots: five-bar, symmetric-five-bar, 2-prr"));
    let message = Robot::resolve("zzz").unwrap_err().to_string();
    assert_starts(&message, "`zzz` is neither a built-in robot nor a file; built-in robots: ");
}

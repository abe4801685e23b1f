//! Mistakes in lengths, vectors and actuators.

use super::*;
use aspecta::num::Interval;
use aspecta::robot::{Actuator, Revolute};

#[test]
fn lengths_that_are_none() {
    for bad in ["0", "-8", "-1e-30", "0.0"] {
        let message = says(PLANE, "crank = 8", &format!("crank = {bad}"));
        assert_starts(&message, &format!("legs[1].actuator.crank = {bad}: a length must be positive"));
    }
    for bad in ["nan", "inf", "-inf"] {
        let message = says(PLANE, "crank = 8", &format!("crank = {bad}"));
        assert_starts(&message, &format!("legs[1].actuator.crank = {bad}: not a finite number"));
        assert_starts(
            &says(PLANE, "[9, 0]", &format!("[9, {bad}]")),
            &format!("legs[2].anchor[2] = {bad}: not a finite"),
        );
    }
    for bad in ["1e-7", "1e7", "1000001"] {
        let message = says(PLANE, "crank = 8", &format!("crank = {bad}"));
        assert_starts(
            &message,
            &format!("legs[1].actuator.crank = {bad}: lengths must lie within [1e-6, 1e6]"),
        );
        assert!(message.contains("choose another length unit"));
    }
    assert_starts(
        &says(PLANE, "[9, 0]", "[-2e6, 0]"),
        "legs[2].anchor[1] = -2e6: lengths must lie within [1e-6, 1e6] and coordinates within ±1e6",
    );
    for good in ["1e-6", "1e6"] {
        let text = PLANE.replacen("crank = 8", &format!("crank = {good}"), 1).replacen(
            "rod = 5",
            &format!("rod = {good}"),
            1,
        );
        let distance = text.replacen("[9, 0]", "[1, 0]", 1).replacen("crank = 5", "crank = 8", 1);
        Robot::from_toml(&distance, "t").unwrap_or_else(|e| panic!("{e}"));
    }
}

/// A double would take it for 8, and the enclosure [8, 8] would not hold it.
#[test]
fn decimals_a_double_takes_for_integers() {
    let message = says(PLANE, "crank = 8", "crank = 8.0000000000000000001");
    assert_starts(
        &message,
        "legs[1].actuator.crank = 8.0000000000000000001: double precision cannot tell this from 8: give fewer digits",
    );
    assert_starts(
        &says(PLANE, "[9, 0]", "[9, 1e-400]"),
        "legs[2].anchor[2] = 1e-400: double precision cannot tell this from 0",
    );
    let robot = Robot::from_toml(&PLANE.replacen("crank = 8", "crank = 8.000", 1), "t").unwrap();
    assert!(
        matches!(robot.legs[0].actuator, Actuator::Revolute(Revolute { crank, .. }) if crank == Interval::point(8.0))
    );
}

#[test]
fn vectors_of_the_wrong_length() {
    assert_starts(
        &says(PLANE, "[9, 0]", "[9, 0, 0]"),
        "legs[2].anchor = [9, 0, 0]: the legs of a `plane-point` live in 2 dimensions: give 2 numbers, not 3",
    );
    assert_starts(
        &says(SPACE, "[0, 3, 0]", "[0, 3]"),
        "legs[2].actuator.direction = [0, 3]: the legs of a `translating-body` live in 3",
    );
}

#[test]
fn vectors_without_direction() {
    assert_starts(
        &says(SPACE, "[0, 0, 2]", "[0, 0, 0]"),
        "legs[1].actuator.axis = [0, 0, 0]: the zero vector has no direction",
    );
    assert_starts(
        &says(SPACE, "[1, 0, 5]", "[0, 0, 0]"),
        "legs[1].actuator.zero = [0, 0, 0]: the zero vector",
    );
    assert_starts(
        &says(SPACE, "[0, 3, 0]", "[0, 0, 0]"),
        "legs[2].actuator.direction = [0, 0, 0]: the zero vector",
    );
    assert_starts(
        &says(SPHERE, "[0, -1, 0]", "[0, 0, 0]"),
        "legs[1].attachment = [0, 0, 0]: the zero vector",
    );
    for parallel in ["[0, 0, 5]", "[0, 0, -0.1]"] {
        let message = says(SPACE, "[1, 0, 5]", parallel);
        assert_starts(&message, &format!("legs[1].actuator.zero = {parallel}: `zero` is parallel to `axis`"));
    }
}

#[test]
fn keys_out_of_place() {
    let message = says(PLANE, "rod = 5", "rod = 5, axis = [0, 1]");
    assert_starts(&message, "legs[1].actuator.axis = [0, 1]: in the plane cranks turn about the normal");
    let message = says(SPACE, "\"strut\"", "\"strut\", rod = 3");
    assert_starts(&message, "legs[3].actuator.rod = 3: a `strut` actuator has no `rod`; its keys are `kind`");
    let message = says(SPACE, "direction = [0, 3, 0]", "direction = [0, 3, 0], crank = 1");
    assert!(
        message.ends_with("a `prismatic` actuator has no `crank`; its keys are `kind`, `rod`, `direction`"),
        "{message}"
    );
    let message = says(SPHERE, "attachment", "anchor = [0, 0, 0]\nattachment");
    assert_starts(
        &message,
        "legs[1].anchor = [0, 0, 0]: spherical legs pivot about the origin: leave the anchor out",
    );
}

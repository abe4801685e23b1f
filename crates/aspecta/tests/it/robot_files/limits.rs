//! Mistakes in limits and windows.

use super::*;

#[test]
fn contradictory_limits() {
    let leg = |limit: &str| PLANE.replacen("rod = 5 }", &format!("rod = 5 }}\nlimits = {{ {limit} }}"), 1);
    let of = |limit: &str| says(&leg(limit), "", "");
    assert_starts(
        &of("actuator = { deg = [90, -90] }"),
        "legs[1].limits.actuator: contradictory limits: the minimum 90 is not below the maximum -90",
    );
    assert_starts(
        &of("elbow = { rad = [1, 1] }"),
        "legs[1].limits.elbow: contradictory limits: the minimum 1 is not below",
    );
    assert_starts(&of("base-joint = { deg = [3, 2] }"), "legs[1].limits.base-joint: contradictory limits");
    assert_starts(
        &says(SPACE, "[1, 7]", "[7, 1]"),
        "legs[3].limits.actuator = [7, 1]: contradictory limits: the minimum 7",
    );
    let window = |w: &str| says(PLANE, "[[legs]]", &format!("[window]\n{w}\n\n[[legs]]"));
    assert_starts(&window("x = [3, 3]"), "window.x = [3, 3]: contradictory limits");
    assert_starts(
        &of("actuator = { deg = [-180, 180] }"),
        "legs[1].limits.actuator: a range of a full turn or more limits nothing",
    );
    assert_starts(
        &of("elbow = { rad = [0, 6.283185307179586] }"),
        "legs[1].limits.elbow: a range of a full turn",
    );
    assert_starts(
        &of("actuator = { deg = [1e5, 100001] }"),
        "legs[1].limits.actuator: a limit must lie within two turns",
    );
}

/// Two limits may contradict each other, too, or the lengths of the links.
#[test]
fn limits_no_pose_fulfils() {
    let message = says(PLANE, "[[legs]]", "[window]\nx = [100, 200]\n\n[[legs]]");
    assert_starts(
        &message,
        "window.x = [100, 200]: contradictory limits: the legs, by their lengths, never take `x` there",
    );
    assert_starts(
        &says(PLANE, "[9, 0]", "[90, 0]"),
        "legs[1]: the legs never meet: no value of `x` is within reach of all",
    );
    let message = says(
        SPACE,
        "[0, 0, 0]\nactuator = { kind = \"strut\" }",
        "[0, 30, 0]\nactuator = { kind = \"strut\" }",
    );
    assert_starts(&message, "legs[1]: the legs never meet: no value of `y`");
}

#[test]
fn angles_without_unit_and_lengths_with_one() {
    assert_starts(
        &says(SPHERE, "proximal = { deg = 90 }", "proximal = 90"),
        "legs[1].actuator.proximal = 90: wrong type: integer `90`, expected an angle with its unit, { deg = … } or { rad = … }",
    );
    assert_starts(
        &says(SPHERE, "{ deg = 90 }", "{ degrees = 90 }"),
        "legs[1].actuator.proximal.degrees: unknown name (did you mean `deg`?); give one of `deg`, `rad`",
    );
    assert_starts(
        &says(SPHERE, "{ deg = 90 }", "{ deg = 90, rad = 1.5 }"),
        "legs[1].actuator.proximal: wrong type: expected an angle with its unit",
    );
    assert_starts(
        &says(SPHERE, "{ deg = 90 }", "{}"),
        "legs[1].actuator.proximal: wrong type: expected an angle",
    );
    for (bad, value) in [("{ deg = 0 }", ""), ("{ deg = 180 }", ""), ("{ rad = 3.1415926535897932 }", "")] {
        let message = says(SPHERE, "{ deg = 90 }", bad);
        assert_starts(
            &message,
            &format!(
                "legs[1].actuator.proximal{value}: the angle of a spherical link must lie between 0° and 180°"
            ),
        );
    }
    let leg = |limit: &str| says(PLANE, "rod = 5 }", &format!("rod = 5 }}\nlimits = {{ {limit} }}"));
    assert_starts(
        &leg("actuator = [-90, 90]"),
        "legs[1].limits.actuator = [-90, 90]: the driven joint of a `revolute` leg is an angle: give its unit",
    );
    assert_starts(
        &leg("elbow = [5, 175]"),
        "legs[1].limits.elbow = [5, 175]: wrong type: sequence, expected an angle with its unit",
    );
    assert_starts(
        &says(SPACE, "[1, 7]", "{ deg = [1, 7] }"),
        "legs[3].limits.actuator: the driven joint of a `strut` leg is a length: give a plain range, [min, max]",
    );
    assert_starts(
        &says(SPACE, "[1, 7]", "[-1, 7]"),
        "legs[3].limits.actuator[1] = -1: the length of a strut is never negative; the minimum must be at least 0",
    );
}

#[test]
fn limits_on_joints_a_leg_does_not_have() {
    let with = |limit: &str| says(SPACE, "actuator = [1, 7]", limit);
    assert_starts(
        &with("elbow = { deg = [5, 175] }"),
        "legs[3].limits.elbow: only a `revolute` leg has an elbow, between crank and rod: limit `base-joint` or",
    );
    let spherical = SPHERE.replacen(
        "distal = { deg = 90 } }",
        "distal = { deg = 90 } }\nlimits = { elbow = { deg = [5, 175] } }",
        1,
    );
    assert!(says(&spherical, "", "").ends_with("an elbow, between crank and rod: limit `actuator`"));
    assert_starts(
        &with("base-joint = { deg = [5, 175] }"),
        "legs[3].limits.base-joint: in space give a cone, { axis = [x, y, z], within",
    );
    assert_starts(
        &with("base-joint = { axis = [0, 0, 1] }"),
        "legs[3].limits.base-joint: missing key `within`",
    );
    assert_starts(
        &with("base-joint = { within = { deg = 30 } }"),
        "legs[3].limits.base-joint: missing key `axis`",
    );
    assert_starts(
        &with("platform-joint = { axis = [0, 0, 0], within = { deg = 30 } }"),
        "legs[3].limits.platform-joint.axis = [0, 0, 0]: the zero vector",
    );
    assert_starts(
        &with("platform-joint = { axis = [0, 0, 1], within = { deg = 180 } }"),
        "legs[3].limits.platform-joint.within: the half-angle of a cone must lie",
    );
    let message = says(
        PLANE,
        "rod = 5 }",
        "rod = 5 }\nlimits = { base-joint = { axis = [0, 1], within = { deg = 3 } } }",
    );
    assert_starts(&message, "legs[1].limits.base-joint: in the plane give the range from the x axis");
    let message = says(
        SPHERE,
        "distal = { deg = 90 } }",
        "distal = { deg = 90 } }\nlimits.base-joint = { deg = [0, 1] }",
    );
    assert_starts(&message, "legs[1].limits.base-joint: a `spherical` leg has no rod");
    let elbow = |range: &str| {
        says(
            SPACE,
            "zero = [1, 0, 5] }",
            &format!("zero = [1, 0, 5] }}\nlimits = {{ elbow = {{ deg = {range} }} }}"),
        )
    };
    assert_starts(
        &elbow("[-5, 90]"),
        "legs[1].limits.elbow: an elbow angle in space must lie from 0° to 180°",
    );
    assert_starts(&elbow("[5, 190]"), "legs[1].limits.elbow: an elbow angle in space");
}

#[test]
fn windows_on_coordinates_the_platform_does_not_have() {
    let window = |w: &str| says(PLANE, "[[legs]]", &format!("[window]\n{w}\n\n[[legs]]"));
    assert_starts(
        &window("z = [0, 1]"),
        "window.z = [0, 1]: a `plane-point` has no such coordinate; its coordinates are `x`, `y`",
    );
    assert_starts(
        &window("theta = [0, 1]"),
        "window.theta: unknown key; the keys here are `x`, `y`, `z`, `phi`, `roll`",
    );
    assert_starts(&window("x = { deg = [0, 1] }"), "window.x: the coordinate `x` is a length");
    let window = |w: &str| says(SPHERE, "[[legs]]", &format!("[window]\n{w}\n\n[[legs]]"));
    assert_starts(
        &window("yaw = [0, 1]"),
        "window.yaw = [0, 1]: the coordinate `yaw` is an angle: give its unit",
    );
    assert_starts(&window("pitch = { deg = [0, 91] }"), "window.pitch: pitch must lie within ±90°");
    assert_starts(&window("roll = { deg = [0, 360] }"), "window.roll: a range of a full turn or more");
}

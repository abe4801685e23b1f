"""Robots: made, compared, passed on; poses in their several forms."""

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import aspecta
from aspecta import poses
from conftest import CATALOGUE, command

LEG = {"actuator": {"kind": "revolute", "crank": 8, "rod": 5}}


@pytest.mark.parametrize("name", CATALOGUE)
def test_a_robot_survives_its_text_a_pickle_and_a_copy(name: str) -> None:
    robot = aspecta.Robot(name)
    for other in (aspecta.Robot.from_toml(robot.to_toml()), pickle.loads(pickle.dumps(robot)), copy.deepcopy(robot)):
        assert other == robot and hash(other) == hash(robot) and other.name == name
    assert len(robot.pose_names) == len(robot.joint_names) == robot.dof
    assert robot.to_dict()["name"] == name and name in repr(robot) and name in robot._repr_html_()


def test_legs_share_a_limit() -> None:
    legs = [{"anchor": [0, 0], **LEG}, {"anchor": [9, 0], "actuator": {"kind": "revolute", "crank": 5, "rod": 8}}]
    robot = aspecta.Robot(platform="plane-point", legs=legs, rod_angles=[{"legs": [1, 2], "angle": {"deg": [0, 90]}}])
    analysis = robot.analyze()
    assert analysis.exact and analysis.low == 12
    assert aspecta.Robot.from_toml(robot.to_toml()) == robot
    beyond = [s.mode for s in robot.ik([4, 7]) if not s.within_limits]
    assert beyond and all("rods" in name for mode in beyond for name in robot.limits_beyond([4, 7], mode))
    with pytest.raises(aspecta.Error, match="two different legs"):
        aspecta.Robot(platform="plane-point", legs=legs, rod_angles=[{"legs": [1, 1], "angle": {"deg": [0, 90]}}])


def test_links_keep_clear_of_obstacles() -> None:
    legs = [{"anchor": [0, 0], **LEG}, {"anchor": [9, 0], "actuator": {"kind": "revolute", "crank": 5, "rod": 8}}]
    disc = {"centre": np.array([4.5, 0.0]), "radius": 1}
    robot = aspecta.Robot(platform="plane-point", legs=legs, obstacles=[disc])
    analysis = robot.analyze()
    assert analysis.exact and analysis.low == 28
    assert aspecta.Robot.from_toml(robot.to_toml()) == robot
    within = [s.within_limits for s in robot.ik([4.5, 2.9])]
    assert len(within) == 4 and not all(within)
    with pytest.raises(aspecta.Error, match="radius"):
        aspecta.Robot(platform="plane-point", legs=legs, obstacles=[{"centre": [4.5, 0]}])


def test_links_keep_clear_of_one_another() -> None:
    legs = [{"anchor": [0, 0], **LEG}, {"anchor": [9, 0], "actuator": {"kind": "revolute", "crank": 5, "rod": 8}}]
    robot = aspecta.Robot(platform="plane-point", legs=legs, bodies={"radius": 0})
    analysis = robot.analyze()
    assert analysis.exact and analysis.low == 10
    assert aspecta.Robot.from_toml(robot.to_toml()) == robot
    within = [s.within_limits for s in robot.ik([4.5, 2.9])]
    assert len(within) == 4 and not all(within)
    with pytest.raises(aspecta.Error, match="not negative"):
        aspecta.Robot(platform="plane-point", legs=legs, bodies={"radius": -1})


def test_a_robot_is_built_from_its_legs(tmp_path: Path) -> None:
    legs = [{"anchor": np.array([0.0, 0.0]), **LEG}, {"anchor": (9, 0), **LEG}]
    robot = aspecta.Robot(platform="plane-point", legs=legs, name="mine", length_unit="mm", window={"y": [0, 20]})
    assert (robot.platform, robot.length_unit, robot.title) == ("plane-point", "mm", "")
    path = tmp_path / "mine.toml"
    path.write_text(robot.to_toml())
    assert aspecta.Robot.from_file(path) == robot == aspecta.Robot(str(path))
    assert robot != aspecta.Robot("five-bar")


def test_mistakes_name_the_file_the_key_and_the_value() -> None:
    with pytest.raises(aspecta.Error, match="did you mean `five-bar`"):
        aspecta.Robot("five-baar")
    with pytest.raises(ValueError, match=r"mine:[0-9]+.*plane-pint"):
        aspecta.Robot(platform="plane-pint", legs=[], name="mine")
    with pytest.raises(aspecta.Error, match="give the name of a robot"):
        aspecta.Robot()


def test_an_array_that_does_not_fit_is_refused(five_bar: aspecta.Robot) -> None:
    with pytest.raises(aspecta.Error, match=r"shape \(3,\).*\(x, y\)"):
        five_bar.ik([1, 2, 3])
    with pytest.raises(aspecta.Error, match="row 1: pose coordinate 2 is NaN"):
        five_bar.ik([[4, 7], [4, np.nan]])
    with pytest.raises(aspecta.Error, match=r"not a working mode of `five-bar`.*left"):
        five_bar.ik([4, 7], mode="+++")
    assert len(five_bar.ik(np.empty((0, 2)))) == 0


@pytest.mark.parametrize(
    "pose", [np.ma.array([4.0, 7.0], mask=[False, True]), [4, None], [4, "7"], ["4", "7"], [4, 7j], [[4, 7], [4]]]
)
def test_what_is_no_number_is_refused(five_bar: aspecta.Robot, pose: Any) -> None:
    with pytest.raises(aspecta.Error, match=r"masked|is no number|differ in length"):
        five_bar.ik(pose)


def test_postures_have_names(five_bar: aspecta.Robot) -> None:
    assert (
        five_bar.mode_in_words("+-") == "left,right" and aspecta.Robot("gough-stewart").mode_in_words("------") is None
    )
    assert [s.mode for s in five_bar.ik([4, 7], mode="left,right")] == ["+-"]
    plan = five_bar.plan([4, 7], [5, 6], mode="left,left")
    assert plan.stretches[0]["mode"] == "++"


def test_limits_that_are_broken_are_named() -> None:
    leg = {"anchor": [0, 0], **LEG, "limits": {"actuator": {"deg": [-10, 10]}}}
    robot = aspecta.Robot(platform="plane-point", legs=[leg, {"anchor": [9, 0], **LEG}], window={"y": [-20, 6]})
    assert not robot.ik([4, 7])[0].within_limits
    assert len(robot.limits_beyond([4, 7], "++")) == 2
    with pytest.raises(aspecta.Error, match="out of reach of leg 1, leg 2"):
        robot.limits_beyond([40, 7], "++")


def test_degrees_taken_for_radians_are_warned_of() -> None:
    with pytest.warns(aspecta.UnitWarning, match=r"phi = 30 is taken in radians"):
        aspecta.Robot("3-rrr").ik([-9, 0, 30])


def test_lengths_in_two_units_are_warned_of() -> None:
    large = {"actuator": {"kind": "revolute", "crank": 8000, "rod": 7995}}
    legs = [{"anchor": [0, 0], **large}, {"anchor": [9, 0], **LEG}]
    with pytest.warns(aspecta.UnitWarning, match="one unit"):
        aspecta.Robot(platform="plane-point", legs=legs)


def test_matrices_and_quaternions_mean_the_same_pose() -> None:
    robot = aspecta.Robot("gough-stewart")
    pose = np.array([[0.2, 0.1, 0.9, 0.5, 1.4, 0.2], [0.1, 0.0, 1.0, -0.3, 0.2, 2.0]])
    matrices = robot.matrix(pose)
    expected = robot.ik(pose)
    assert np.allclose(robot.ik(matrices).q, expected.q)
    assert np.allclose(robot.ik(matrices[0])[0].q, expected[0][0].q)
    # Half-angle formulas, with no use of matrices.
    (cr, cp, cy), (sr, sp, sy) = np.cos(pose[:, 3:].T / 2), np.sin(pose[:, 3:].T / 2)
    wxyz = np.stack([
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ], axis=-1)  # fmt: skip
    assert np.allclose(robot.ik(pose[:, :3], quaternion_wxyz=3 * wxyz).q, expected.q)
    assert np.allclose(robot.ik(pose[:, :3], quaternion_xyzw=np.roll(wxyz, -1, axis=1)).q, expected.q)
    assert np.allclose(poses.from_matrix("free-body", matrices), pose)


def test_motions_that_a_platform_cannot_make_are_refused() -> None:
    turn = poses.to_matrix("free-body", [0, 0, 0, 0, 0, 1])
    with pytest.raises(aspecta.Error, match="does not turn"):
        aspecta.Robot("delta").ik(turn)
    with pytest.raises(aspecta.Error, match="does not move away"):
        aspecta.Robot("spherical-3-rrr").ik(poses.to_matrix("translating-body", [1, 0, 0]))
    with pytest.raises(aspecta.Error, match="not a rotation"):
        aspecta.Robot("hexa").ik(np.diag([1, 1, -1, 1]))
    with pytest.raises(aspecta.Error, match="zero"):
        aspecta.Robot("hexa").ik([0, 0, -700], quaternion_wxyz=[0, 0, 0, 0])
    level = aspecta.Robot("delta").ik(poses.to_matrix("translating-body", [0, 0, -900]))
    assert np.array_equal(level[0].q, aspecta.Robot("delta").ik([0, 0, -900])[0].q)


def test_a_matrix_is_a_pose_wherever_one_is_asked_for() -> None:
    robot = aspecta.Robot("gough-stewart")
    pose = [0.2, 0.1, 0.9, 0.5, 1.4, 0.2]
    matrix, start = robot.matrix(pose), robot.ik(pose, mode="------")[0]
    assert robot.plan(matrix, matrix, mode="------").proved
    assert robot.limits_beyond(matrix, "------") == robot.limits_beyond(pose, "------")
    assert np.allclose(robot.follower(matrix, start.q).pose, pose)
    assert np.allclose(robot.inverse_follower(matrix, "------").q, start.q)
    assert "<mujoco" in robot.to_mjcf(matrix, "------")
    for wrong in (matrix[None], matrix[:3], np.eye(5)):
        with pytest.raises(aspecta.Error, match="shape"):
            robot.follower(wrong, start.q)
    for unfit in ([1, 2], [*pose[:5], np.nan]):
        with pytest.raises(aspecta.Error, match=r"finite numbers \(…, 6\)"):
            robot.matrix(unfit)


def test_orientations_of_a_turning_body() -> None:
    robot = aspecta.Robot("spherical-3-rrr")
    wxyz = [np.cos(0.1), 0, 0, np.sin(0.1)]
    assert np.allclose(robot.ik(quaternion_wxyz=wxyz)[0].pose, [0, 0, 0.2])
    assert np.allclose(robot.ik(np.zeros((2, 3)), quaternion_wxyz=[wxyz] * 2).pose[0], [0, 0, 0.2])
    with pytest.raises(aspecta.Error, match="does not move away"):
        robot.ik([1, 0, 0], quaternion_wxyz=wxyz)
    with pytest.raises(aspecta.Error, match=r"homogeneous matrix \(4, 4\)"):
        robot.ik(robot.matrix([0, 0, 0.2])[:3, :3])
    assert len(robot.ik(np.eye(3) * 0.1)) == 3


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"quaternion_xyzw": [0, 0, 0, 1]}, "give the positions"),
        ({"pose": [0, 0, 1], "quaternion_xyzw": [0, 0, 1]}, r"quaternion of shape \(3,\)"),
        ({"pose": [[0, 0, 1]], "quaternion_xyzw": [0, 0, 0, 1]}, r"positions \(1, 3\) and quaternions \(4,\)"),
        ({"pose": [0, 0, 1], "quaternion_xyzw": [1, 0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0]}, "quaternion_xyzw and"),
        ({}, "give a pose"),
    ],
)
def test_quaternions_that_do_not_fit_are_refused(given: dict[str, Any], why: str) -> None:
    with pytest.raises(aspecta.Error, match=why):
        aspecta.Robot("gough-stewart").ik(**given)


def test_a_pitch_of_a_right_angle_gives_a_rotation_back() -> None:
    rotation = poses.rotation_from_rpy([0.3, np.pi / 2, 0.8])
    assert np.allclose(poses.rotation_from_rpy(poses.rpy_from_rotation(rotation)), rotation)


def test_quaternions_give_poses_by_their_order() -> None:
    angles = np.array([0.3, -0.4, 1.2])
    rotation = poses.rotation_from_rpy(angles)
    assert poses.is_rotation(rotation) and not poses.is_rotation(-rotation) and not poses.is_rotation(2 * rotation)
    w = np.sqrt(1 + np.trace(rotation)) / 2
    skew = rotation - rotation.T
    xyz = np.array([skew[2, 1], skew[0, 2], skew[1, 0]]) / (4 * w)
    for given in ({"wxyz": [w, *xyz]}, {"xyzw": [*xyz, w]}):
        assert np.allclose(poses.from_quaternion("free-body", [1, 2, 3], **given), [1, 2, 3, *angles])
        assert np.allclose(poses.from_quaternion("turning-body", None, **given), angles)
    with pytest.raises(aspecta.Error, match="give the positions"):
        poses.from_quaternion("free-body", None, wxyz=[1, 0, 0, 0])


def test_orientations_along_a_path_turn_least() -> None:
    near = np.array([[0.1, 0.2, 3.1], [0.1, 0.2, -3.1], [0.1 + np.pi, np.pi - 0.2, -3.1 + np.pi]])
    turned = poses.nearest("turning-body", near)
    assert np.allclose(turned[1], [0.1, 0.2, 2 * np.pi - 3.1]) and np.allclose(turned[2], turned[1])
    assert np.allclose(poses.nearest("turning-body", near[:1], before=[0.1, 0.2, -3.1]), [[0.1, 0.2, 3.1 - 2 * np.pi]])
    assert poses.nearest("plane-body", near) is near


def test_a_mask_keeps_solutions_and_rows() -> None:
    found = aspecta.Robot("five-bar").ik(np.array([[4.0, 7.0], [3.0, 8.0]]))
    kept = found.only(found.det_a > 0)
    assert (kept.det_a > 0).all() and 0 < len(kept.det_a) < len(found.det_a) and len(kept) == len(found) == 2


def test_the_command_comes_with_the_package() -> None:
    assert command("--version").stdout == f"aspecta {aspecta.__version__}\n"
    refused = command("ik", "five-bar", "--pose", "1,2,3")
    assert refused.returncode == 2 and "not 3" in refused.stderr


def test_a_model_for_mujoco_needs_no_pose() -> None:
    robot = aspecta.Robot("3-rrr")
    assert robot.to_mjcf(mode="+-+") == command("export", "mjcf", "3-rrr", "--mode=+-+").stdout
    assert robot.to_mjcf() == command("export", "mjcf", "3-rrr").stdout
    with pytest.raises(aspecta.Error, match="out of reach of leg 1"):
        robot.to_mjcf([400, 0, 0], "+++")

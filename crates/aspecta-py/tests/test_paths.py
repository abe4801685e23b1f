"""Paths and followers."""

import pickle

import numpy as np
import pytest

import aspecta
from conftest import answer

TABLE_4 = [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.5], [-9.902, -7.091, 1.081]]


def test_the_motion_of_table_4() -> None:
    robot = aspecta.Robot("3-rrr")
    check = robot.check_path(TABLE_4, mode="+++")
    assert check.sound and check.singularity_free is True and "yes, certified" in str(check)
    rows = "\n".join(",".join(map(str, row)) for row in TABLE_4)
    told = answer("check-path", "3-rrr", "-", "--mode", "+++", stdin=rows)
    mine = check.to_dict()
    assert all(mine[key] == told[key] for key in mine)
    motion = robot.time(TABLE_4, mode="+++", speed=2, acceleration=10)
    assert np.allclose(motion.pose[-1], TABLE_4[-1]) and motion.total_time == check.time(2, 10).total_time
    assert pickle.loads(pickle.dumps(check)) == check
    pytest.importorskip("matplotlib").use("Agg")
    assert len(check.plot().lines) == 5


def test_answers_have_three_values() -> None:
    robot = aspecta.Robot("3-rrr")
    through = robot.check_path([TABLE_4[0], [-15.468, 20, 0.073]], mode="+++")
    assert through.singularity_free is False and through.obstacle is not None and not through.sound
    with pytest.raises(aspecta.Error, match="not proved to be sound"):
        through.time(1, 1)
    with pytest.raises(TypeError, match=r"\.sound"):
        bool(through)
    margins = robot.check_path(TABLE_4, mode="+++", avoid=(0.5, 0))
    assert margins.singularity_free is True and margins.keeps_margins is False
    assert robot.check_path(TABLE_4, mode="+++", avoid=0.01) == robot.check_path(
        TABLE_4, mode="+++", avoid=(0.01, 0.01)
    )


@pytest.mark.parametrize(
    "path",
    [
        [[0.1, 0.1, 3.10], [0.1, 0.1, 3.20]],
        [[0.1, 0.1, -3.10], [0.1, 0.1, -3.20], [0.1, 0.1, -3.30]],
        [[0.1, 1.5, 0.2], [0.1, 1.65, 0.2]],
        [[0.1, 1.5, 0.2], [0.1, np.pi / 2, 0.2], [0.1, 1.65, 0.2]],
        [[0.1, -1.5, 0.2], [0.1, -np.pi / 2, 0.2], [0.1, -1.65, 0.2]],
    ],
)
def test_a_path_of_matrices_turns_the_short_way(path: list[list[float]]) -> None:
    robot = aspecta.Robot("spherical-3-rrr")
    matrices = robot.matrix(path)
    assert np.allclose(robot._path("path", matrices), path)
    follower = robot.inverse_follower(matrices[0], "+++")
    assert np.allclose(follower.step(robot.matrix(np.add(path[0], 0.001))).q, follower.q)
    assert np.allclose(follower.pose, np.add(path[0], 0.001))


def test_the_time_of_a_path_of_matrices_is_that_of_its_angles() -> None:
    robot, path = aspecta.Robot("spherical-3-rrr"), [[0.1, 0.1, 3.10], [0.1, 0.1, 3.20]]
    times = [robot.time(p, mode="+++", speed=1, acceleration=1).total_time for p in (path, robot.matrix(path))]
    assert np.isclose(*times)


def test_a_path_of_joints(five_bar: aspecta.Robot) -> None:
    start = five_bar.ik([4, 7])[0]
    check = five_bar.check_path(joints=[start.q, start.q + 0.05], start=start.pose)
    assert check.sound and check.mode == "++"
    for wrong in (
        {},
        {"poses": [[4, 7]], "joints": [[1, 2]]},
        {"poses": [[4, 7], [5, 7]]},
        {"poses": [[4, 7], [5, 7]], "mode": "++", "start": [4, 7]},
        {"joints": [start.q, start.q], "mode": "++"},
        {"poses": [[4, 7], [5, 7]], "mode": "++", "avoid": (0, 0, 0)},
    ):
        with pytest.raises(aspecta.Error):
            five_bar.check_path(**wrong)  # type: ignore[arg-type]
    with pytest.raises(aspecta.Error, match="spline"):
        five_bar.check_path([[4, 7], [5, 7]], mode="++", joined="curve")


def test_following_there_and_back(five_bar: aspecta.Robot) -> None:
    start = five_bar.ik([4, 7], mode="++")[0]
    assert repr(five_bar.follower(start)) == "<Follower of five-bar in mode ++ at x = 4, y = 7>"
    forward, back = five_bar.follower(start.pose, start.q), five_bar.inverse_follower(start.pose, "++")
    for k in range(1, 21):
        step = forward.step(start.q + 0.01 * k)
        assert step.mode == "++" and step.mode_kept and step.within_limits and step.length_error < 1e-9
        joints = back.step(step.pose)
        assert joints.regular and np.allclose(joints.q, start.q + 0.01 * k)
    assert np.array_equal(forward.pose, step.pose) and forward.mode == back.mode == "++"
    with pytest.raises(aspecta.Error):
        forward.step(start.q + 3)
    assert np.array_equal(forward.pose, step.pose)
    with pytest.raises(aspecta.Error):
        forward.step([np.nan, 0])
    with pytest.raises(aspecta.Error, match="shape"):
        forward.step([start.q])
    with pytest.raises(aspecta.Error, match="shape"):
        back.step([start.pose])


def test_a_model_for_mujoco() -> None:
    robot = aspecta.Robot("3-rrr")
    assert '<mujoco model="3-rrr">' in robot.to_mjcf(TABLE_4[0], "+++")
    with pytest.raises(aspecta.Error):
        robot.to_mjcf([100, 0, 0], "+++")

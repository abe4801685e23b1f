"""Solutions: the numbers are those of the command line, alone and in arrays."""

import pickle
from typing import Any

import numpy as np
import pytest

import aspecta
from conftest import CATALOGUE, POSES, answer, text


def same(found: aspecta.SolutionList, told: list[dict[str, Any]]) -> None:
    assert len(found) == len(told)
    for mine, theirs in zip(found, told, strict=True):
        assert mine.pose.tolist() == theirs["pose"] and mine.q.tolist() == theirs["q"]
        for name in ("mode", "det_a", "residual", "certified", "within_limits"):
            assert getattr(mine, name) == theirs[name]
        assert list(mine.serial_legs) == theirs["serial_legs"]


@pytest.mark.parametrize("name", CATALOGUE)
def test_numbers_are_those_of_the_command_line(name: str) -> None:
    robot = aspecta.Robot(name)
    found = robot.ik(POSES[name])
    same(found, answer("ik", name, f"--pose={text(POSES[name])}")["solutions"])
    start = found[0]
    told = answer("fk", name, f"--q={text(start.q)}")
    direct = robot.fk(start.q)
    same(direct, told["solutions"])
    assert direct.complete == told["complete"] and ("proved to be all" in str(direct)) == told["complete"]
    # The list of a pose is not proved to be whole, and the command says nothing of it either.
    assert found.complete is None and robot.ik([POSES[name]]).complete is None
    state = robot.state(start.pose, start.q).to_dict()
    line = answer("state", name, f"--pose={text(start.pose)}", f"--q={text(start.q)}")["states"][0]
    shared = state.keys() & line.keys()
    assert {"pose", "q", "det_a", "a", "b", "singularity"} <= shared
    assert {key: state[key] for key in shared} == {key: line[key] for key in shared}


@pytest.mark.parametrize("name", CATALOGUE)
def test_an_array_is_solved_row_by_row(name: str) -> None:
    robot = aspecta.Robot(name)
    rng = np.random.default_rng(1)
    poses = np.array(POSES[name]) + 0.05 * rng.standard_normal((300, robot.dof))
    batch = robot.ik(poses)
    assert len(batch) == 300 and batch.counts.sum() == len(batch.row) == len(batch.q)
    for k in (0, 1, 255, 256, 299):
        alone = robot.ik(poses[k])
        assert [s.mode for s in batch[k]] == [s.mode for s in alone]
        assert all(np.array_equal(a.q, b.q) for a, b in zip(batch[k], alone, strict=True))
    mode = batch.modes[0]
    chosen = robot.ik(poses, mode=mode)
    assert set(chosen.modes) == {mode} and len(chosen) == 300
    direct = robot.fk(batch.q[:5])
    # Each configuration is among the direct solutions of its joint vector.
    for k in range(5):
        assert min(np.abs(s.q - batch.q[k]).max() + np.abs(s.pose - batch.pose[k]).max() for s in direct[k]) < 1e-6


def test_a_batch_is_a_sequence_and_a_table(five_bar: aspecta.Robot) -> None:
    batch = five_bar.ik([[4, 7], [40, 7], [5, 6]])
    assert batch.counts.tolist() == [4, 0, 4] and len(batch[1]) == 0 and len(batch[-1]) == 4
    assert [len(row) for row in batch[:2]] == [4, 0] and [len(row) for row in batch] == [4, 0, 4]
    with pytest.raises(IndexError):
        batch[3]
    again = pickle.loads(pickle.dumps(batch))
    assert np.array_equal(again.q, batch.q) and again.counts.tolist() == [4, 0, 4]
    for frame in (batch.to_pandas(), batch.to_polars()):
        assert list(frame.columns[:4]) == ["row", "mode", "x", "y"] and len(frame) == 8
    assert (
        "8 solutions of 3 rows" in str(batch)
        and str(batch[0]).startswith("4 solutions\n")
        and "proved" not in str(batch)
    )
    assert pickle.loads(pickle.dumps(batch[0]))[0].mode == "++"
    assert str(five_bar.ik([[13, 0]])) == "4 solutions of 1 row"


def test_a_mode_is_chosen_as_everywhere(five_bar: aspecta.Robot) -> None:
    batch = five_bar.ik([[4, 7], [5, 6]])
    for each in (batch, pickle.loads(pickle.dumps(batch))):
        assert each.in_mode("left,right").modes.tolist() == ["+-", "+-"] == each.in_mode("+-").modes.tolist()
        with pytest.raises(aspecta.Error, match="not a working mode"):
            each.in_mode("+")


def test_solutions_are_values_and_a_table(five_bar: aspecta.Robot) -> None:
    found, again = five_bar.ik([4, 7]), five_bar.ik([[4, 7]])[0]
    assert list(found) == list(again) and again[2] in found and found.index(again[2]) == 2 and found[0] != found[1]
    for frame in (found.to_pandas(), found.to_polars()):
        columns = ["mode", "x", "y", "q1", "q2", "det_a", "certified", "within_limits"]
        assert list(frame.columns) == columns and list(frame["mode"]) == ["++", "+-", "--", "-+"]
    assert len(five_bar.ik([40, 7]).to_pandas()) == 0 and "<th>x</th>" in found._repr_html_()
    singular = five_bar.ik([13, 0])
    assert "serial: leg 1" in str(singular) and "serial: leg 1" in singular._repr_html_() and "serial" not in str(found)
    assert five_bar.state(found[0]) == five_bar.state(found[0].pose, found[0].q)
    for ask in (lambda: five_bar.state(found[0], found[0].q), lambda: five_bar.state([4, 7])):  # type: ignore[call-overload]
        with pytest.raises(aspecta.Error, match="solution"):
            ask()


def test_states_of_many(five_bar: aspecta.Robot) -> None:
    batch = five_bar.ik([4, 7])
    states = five_bar.state([s.pose for s in batch], [s.q for s in batch])
    assert isinstance(states, list) and [s.mode for s in states] == ["++", "+-", "--", "-+"]
    assert np.isclose(np.linalg.det(states[0].a), states[0].det_a)
    stretched = five_bar.state([13, 0], five_bar.ik([13, 0])[0].q)
    assert stretched.mode is None and stretched.singularity == "serial" and "serial" in str(stretched)
    with pytest.raises(aspecta.Error, match="give as many"):
        five_bar.state([[4, 7]], [[1, 2], [3, 4]])

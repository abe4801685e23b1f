"""Analyses: counts, aspects, plans, maps, certificates; pictures."""

import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import aspecta
from aspecta._pose_sets import pose_set
from conftest import answer, command

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


def test_table_2(analysis: aspecta.Analysis) -> None:
    assert (analysis.low, analysis.high, analysis.exact) == (10, 10, True)
    assert [a.id for a in analysis.aspects] == list(range(1, 11))
    assert "exactly 10" in str(analysis) and "exactly 10" in analysis._repr_html_()
    assert [m["mode"] for m in analysis.working_modes] == ["++", "+-", "--", "-+"]
    assert "deg" in analysis.summary(degrees=True)


def test_an_analysis_is_that_of_the_command_line(analysis: aspecta.Analysis) -> None:
    numbers = aspecta.Robot("five-bar").analyze(numbers_only=True)
    assert (numbers.low, numbers.high) == (analysis.low, analysis.high)
    mine, theirs = numbers.to_dict(), answer("analyze", "five-bar")
    for result in (mine, theirs):
        del result["run"]["seconds"]
    assert mine == theirs


def test_slices_modes_and_budgets() -> None:
    robot = aspecta.Robot("3-rrr")
    found = robot.analyze(fix={"phi": 0.0}, modes=["+++", "++-"], depth=6)
    told = answer("analyze", "3-rrr", "--fix", "phi=0", "--mode", "+++,++-", "--budget", "depth=6")
    assert found.classes == told["classes"] and (found.low, found.high) == (
        told["aspects"]["low"],
        told["aspects"]["high"],
    )
    with pytest.raises(aspecta.Error, match="`psi` is none of x, y, phi"):
        robot.analyze(fix={"psi": 0})
    with pytest.raises(aspecta.Error, match="up to 3 free coordinates"):
        aspecta.Robot("hexa").analyze()


@pytest.mark.parametrize(
    "budget",
    [
        {"depth": 0},
        {"depth": 99},
        {"boxes": -1},
        {"boxes": 2**63},
        {"seconds": "1"},
        {"boxes": 1.5},
        {"resolution": 0.0},
        {"seconds": float("nan")},
    ],
)
def test_budgets_that_make_no_sense_are_refused(five_bar: aspecta.Robot, budget: dict[str, float]) -> None:
    (name,) = budget
    with pytest.raises(aspecta.Error, match=f"{name} = .*: give a"):
        five_bar.analyze(**budget)  # type: ignore[arg-type]


def test_aspects_at_a_pose(analysis: aspecta.Analysis) -> None:
    assert [(a.id, a.mode, a.det_a) for a in analysis.at([4, 7])] == [
        (1, "++", "+"),
        (3, "+-", "+"),
        (6, "--", "+"),
        (10, "-+", "-"),
    ]
    assert [a.id for a in analysis.at([4, 7], mode="--")] == [6]
    assert analysis.at([40, 7]) == []


def test_a_notebook_shows_tables_and_pictures(analysis: aspecta.Analysis) -> None:
    shown = analysis._repr_html_()
    assert shown.count("<tr>") == 9 and "<svg" in shown and "exactly 10" in shown
    # Of three coordinates there is no one picture.
    body = aspecta.Robot("3-rpr").analyze(depth=3)
    assert "<table" in body._repr_html_() and "<svg" not in body._repr_html_()
    line = aspecta.Robot("3-rrr").analyze(fix={"phi": 0, "y": 0}, depth=6)
    assert "<svg" in line._repr_html_()
    solutions = analysis.robot.ik([4, 7])._repr_html_()
    assert solutions.count("<tr>") == 5 and "156.702" in solutions
    assert analysis._picture and analysis._picture in shown  # drawn once
    assert "0 solutions" in analysis.robot.ik([40, 7])._repr_html_()


def test_aspects_as_data_frames(analysis: aspecta.Analysis) -> None:
    for frame in (analysis.to_pandas(), analysis.to_polars()):
        assert list(frame.columns) == ["id", "mode", "det_a", "measure", "pieces", "x", "y", "q1", "q2"]
        assert list(frame["id"]) == list(range(1, 11)) and frame["measure"][0] == analysis.aspects[0].measure


def test_a_pickled_analysis_holds_its_answers(analysis: aspecta.Analysis) -> None:
    again = pickle.loads(pickle.dumps(analysis))
    assert again.aspects == analysis.aspects and str(again) == str(analysis) and again.robot == analysis.robot
    with pytest.raises(aspecta.Error, match="analyse the robot again"):
        again.at([4, 7])


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy])
def test_copies_share_the_boxes(analysis: aspecta.Analysis, copied: Callable[[Any], Any]) -> None:
    assert copied(analysis) == analysis and copied(analysis).at([4, 7]) == analysis.at([4, 7])
    found = analysis.domains(1, cells=20, samples=0).domains(1)
    assert copied(found).grid.coordinates == ["x", "y"]


def test_data_that_is_handed_over_is_a_copy(analysis: aspecta.Analysis) -> None:
    analysis.to_dict()["classes"].clear()
    assert len(analysis.to_dict()["classes"]) == 8


def test_progress_is_told() -> None:
    told: list[tuple[str, int, int]] = []
    aspecta.Robot("3-rrr").analyze(fix={"phi": 0}, progress=lambda *now: told.append(now))
    assert told and all(isinstance(stage, str) and done <= total for stage, done, total in told)

    def stop(*_: object) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        aspecta.Robot("3-rrr").analyze(progress=stop)


def test_certificates_are_verified_by_both(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    assert analysis.certificate is None
    certificate = analysis.robot.analyze(modes="++", certificate=True).certificate
    assert certificate is not None
    path = tmp_path / "five-bar.json"
    certificate.save(path)
    verdict = aspecta.verify(path)
    assert verdict and verdict.verified and "exactly 2" in str(verdict)
    assert command("verify", str(path)).returncode == 0
    # One aspect more than there are.
    planted = certificate.to_dict()
    planted["claims"][0]["low"] += 1
    planted["claims"][0]["high"] += 1
    assert not aspecta.Certificate(json.dumps(planted)).verify()
    with pytest.raises(aspecta.Error):
        aspecta.Certificate("{}").verify()


def test_plans_are_proved_and_refusals_say_why(analysis: aspecta.Analysis, five_bar: aspecta.Robot) -> None:
    for plan in (analysis.plan([4, 7], [5, 6], mode="++"), five_bar.plan([4, 7], [5, 6], mode="++")):
        assert plan.proved and np.array_equal(plan.waypoints[0], [4, 7]) and np.isclose(plan.length, np.sqrt(2))
        motion = plan.time(speed=2, acceleration=[10, 10])
        assert np.allclose(motion.pose[-1], [5, 6]) and np.abs(motion.velocity).max() <= 2 + 1e-9
        assert len(motion.to_pandas()) == len(motion.time) and pickle.loads(pickle.dumps(plan)) == plan
    through = five_bar.plan([4, 7], [4, 7], mode="++", to_mode="--")
    assert through.proved and len(through.crossings) == len(through.stretches) - 1 > 0
    with pytest.raises(aspecta.NoPlan) as refusal:
        # Both in mode +-, one in each of two aspects that the mode has where det A < 0.
        a, b = (x.pose for x in analysis.aspects if x.id in (4, 5))
        analysis.plan(a, b, mode="+-")
    assert refusal.value.proved
    with pytest.raises(aspecta.Error, match="weight = nan"):
        five_bar.plan([4, 7], [5, 6], mode="++", weight=float("nan"))
    with pytest.raises(aspecta.Error, match="3 limits of speed"):
        five_bar.plan([4, 7], [5, 6], mode="++").time([1, 2, 3], 1)
    with pytest.raises(aspecta.Error, match="working mode"):
        five_bar.plan([4, 7], [5, 6], mode="+++")


def test_a_plan_of_a_free_body() -> None:
    robot = aspecta.Robot("gough-stewart")
    plan = robot.plan([0.2, 0.1, 0.9, 0.5, 1.4, 0.2], [0.25, 0.05, 0.85, 0.45, 1.3, 0.25], mode="------")
    assert plan.proved and robot.check_path(plan.waypoints, mode="------").sound


def test_modes_traverse_and_assembly_are_those_of_the_command_line(
    analysis: aspecta.Analysis, five_bar: aspecta.Robot
) -> None:
    graph = analysis.modes()
    assert len(graph.crossings) == 12 and graph._repr_svg_().startswith("<svg")
    held = analysis.traverse(box=[[2, 6], [8, 10]])
    told = answer("traverse", "five-bar", "--box", "2:6,8:10")
    assert held.holds is True and held.classes == told["classes"]
    assert analysis.traverse(disc=[(4, 4), (9, 9)], radius=1).holds is True
    assert analysis.traverse(disc=[4, 9], radius=1) == analysis.traverse(disc=[(4, 4), (9, 9)], radius=1)
    assert analysis.traverse(poses=[[4, 7], [40, 7]]).holds is False
    some = analysis.traverse(box=[[2, 6], [8, 10]], mode="left,right", det_a="+")
    assert [(c["mode"], c["det_a"]) for c in some.classes] == [("+-", "+")]
    assert some.classes == answer("traverse", "five-bar", "--box=2:6,8:10", "--mode=+-", "--det=+")["classes"]
    for paths in ([[[4, 7], [5, 6]]], [[4, 7], [5, 6]], np.array([[4, 7], [5, 6]])):
        assert analysis.traverse(paths=paths).holds is True
    assert analysis.traverse(box={"y": [8, 10], "x": [2, 6]}) == held
    with pytest.raises(TypeError, match=r"\.holds"):
        bool(held)
    for wrong in (
        {},
        {"box": [[1, 2]]},
        {"box": [[6, 2], [8, 10]]},
        {"disc": [4, 9], "radius": -1},
        {"disc": [(1, 4), 9], "radius": 1},
        {"disc": [(4, 4), (9, 9)]},
        {"ball": [(0, 0), (0, 0)], "radius": 1},
        {"box": {"x": (2, 6)}},
        {"box": 3},
        {"box": [4, (1, 2, 3)]},
        {"poses": []},
        {"poses": [[4, 7, 1]]},
        {"paths": []},
        {"paths": [[[4, 7]]]},
        {"paths": [[4, 7]]},
    ):
        with pytest.raises(aspecta.Error):
            analysis.traverse(**wrong)  # type: ignore[arg-type]
    q = five_bar.ik([4, 7])[0].q
    assert [s["aspect"] for s in analysis.assembly(q).solutions] == [10, 1]
    assert len(aspecta.Robot("3-rpr").assembly([14.98, 15.38, 12], seconds=20).solutions) == 6


def test_cusps_and_exploration() -> None:
    cusps = aspecta.Robot("3-rpr").cusps(fix={"q1": 14.98})
    told = answer("cusps", "3-rpr", "--fix", "q1=14.98")
    assert cusps.to_dict()["cusps"] == told["cusps"] and cusps.complete
    assert str(cusps).startswith("6 cusps, proved to be all\n") and str(cusps).count("beyond limits") == 2
    curves = aspecta.Robot("3-rpr").cusps(boxes=1000)
    assert "each proved (not all were looked for: stopped)" in str(
        aspecta.Robot("3-rrr").analyze(depth=4).modes(seconds=1e-9)
    )
    assert str(curves) == f"0 curves of cusps, of {len(curves.slices)} slices"
    joined = aspecta.Robot("gough-stewart").assembly([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071], samples=50)
    assert str(joined).startswith("40 direct solutions, all of them\n  ------  det A +  joined by proved motions: ")
    explored = aspecta.Robot("gough-stewart").explore(samples=50)
    assert explored.to_dict() == {
        k: v for k, v in answer("explore", "gough-stewart", "--samples", "50").items() if k != "format_version"
    }


def test_pictures_and_reports(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    ax = analysis.plot(mode="+-")
    assert len(ax.collections) >= 3 and ax.get_xlabel() == "x [unit]"
    ax = analysis.plot(mode="++", space="joint")
    assert ax.get_xlabel() == "q1 [rad]" and [len(c.get_paths()) > 1000 for c in ax.collections] == [True, True]
    body = aspecta.Robot("3-rpr").analyze(depth=4)
    with pytest.raises(aspecta.Error, match="cut at one"):
        body.plot()
    assert body.plot(at={"phi": 0.1}).get_ylabel() == "y [unit]"
    assert aspecta.Robot("3-rrr").analyze(fix={"phi": 0, "y": 0}, depth=8).plot().get_xlabel() == "x [unit]"
    for wrong, why in (
        (0.1, "at = 0.1: give"),
        ({"z": 0}, "`z` does not vary"),
        ({"phi": 99}, "lies outside"),
        ({"phi": np.nan}, "give a number"),
    ):
        with pytest.raises(aspecta.Error, match=why):
            body.plot(at=wrong)
    with pytest.raises(aspecta.Error, match="space = 'q'"):
        analysis.plot(space="q")  # type: ignore[arg-type]
    legend = [text.get_text() for text in analysis.plot(mode="+-").get_legend().get_texts()]
    assert legend == ["undecided", "3: +- det A +", "4: +- det A -", "5: +- det A -"]
    held = aspecta.Robot("3-rrr").analyze(fix={"phi": 0}, depth=6)
    assert held.plot(at={"phi": 0}).get_xlabel() == "x [unit]"
    with pytest.raises(aspecta.Error, match="held at 0"):
        held.plot(at={"phi": 0.1})
    report = analysis.report(tmp_path / "report")
    assert report.name == "report.html" and "<svg" in report.read_text()
    with pytest.raises(aspecta.Error, match=r"report\.html`: "):
        analysis.report(report)


def test_modes_and_signs_are_taken_as_people_write_them(analysis: aspecta.Analysis, five_bar: aspecta.Robot) -> None:
    assert five_bar.analyze(modes=["++", "left,left"]).classes == five_bar.analyze(modes="++").classes
    assert five_bar.analyze(modes=None, depth=5).classes == five_bar.analyze(depth=5).classes
    assert len(aspecta.Robot("gough-stewart").explore(modes=["------"] * 2, samples=20).classes) == 2
    for sign in ("-", -1, -1.0, np.int64(-1)):
        assert np.array_equal(analysis.cells("++", sign)[0], analysis.cells("++", "-")[0])  # type: ignore[arg-type]
        assert analysis.domains(mode="++", det_a=sign, cells=20, samples=0).aspects == [2]  # type: ignore[arg-type]
        assert {c["det_a"] for c in analysis.traverse(poses=[4, 7], det_a=sign).classes} == {"-"}  # type: ignore[arg-type]
    for ask in (
        lambda: analysis.cells("++", 2),  # type: ignore[arg-type]
        lambda: analysis.domains(1, det_a=0),  # type: ignore[arg-type]
        lambda: analysis.traverse(poses=[4, 7], det_a="x"),  # type: ignore[arg-type]
        lambda: five_bar.analyze(modes=3),  # type: ignore[arg-type]
        lambda: five_bar.plan([4, 7], [5, 6], mode=["++"]),  # type: ignore[arg-type]
    ):
        with pytest.raises(aspecta.Error, match=r"(det_a|modes?) = .*: give"):
            ask()


def test_coordinates_are_held_by_any_mapping(five_bar: aspecta.Robot) -> None:
    assert five_bar.analyze(fix=[("x", 4)], depth=5).classes == five_bar.analyze(fix={"x": 4}, depth=5).classes  # type: ignore[arg-type]
    for fix in (3, {"x": "4"}, {"x": None}):
        with pytest.raises(aspecta.Error, match=r"fix.* = .*: give"):
            five_bar.analyze(fix=fix)  # type: ignore[arg-type]


def test_separate_poses_are_no_path() -> None:
    robot = aspecta.Robot("spherical-3-rrr")
    matrices = robot.matrix([[0.1, 0.1, 3.1], [0.1, 0.1, 3.2]])
    (poses,), (path,) = (pose_set(robot, {kind: matrices}, None).lists for kind in ("poses", "paths"))
    assert np.isclose(path[1][2], 3.2) and np.isclose(poses[1][2], 3.2 - 2 * np.pi)


def test_one_pose_is_one(analysis: aspecta.Analysis, five_bar: aspecta.Robot) -> None:
    for ask in (
        lambda: analysis.at([[4, 7]]),
        lambda: analysis.plan([[4, 7]], [5, 6], mode="++"),
        lambda: five_bar.plan([4, 7], [[5, 6], [4, 7]], mode="++"),
        lambda: analysis.assembly([[1, 2]]),
        lambda: five_bar.assembly([1, 2, 3]),
        lambda: five_bar.limits_beyond([[4, 7]], "++"),
        lambda: five_bar.follower([4, 7], [[1, 2]]),
        lambda: five_bar.inverse_follower([[4, 7]], "++"),
        lambda: five_bar.to_mjcf([4, 7, 1], "++"),
    ):
        with pytest.raises(aspecta.Error, match=r"shape \("):
            ask()


def test_a_time_is_for_all_steps_together(monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[float] = []
    analyze = aspecta.Robot.analyze

    def told(robot: aspecta.Robot, **budget: Any) -> aspecta.Analysis:
        given.append(budget["seconds"])
        return analyze(robot, **budget)

    monkeypatch.setattr(aspecta.Robot, "analyze", told)
    robot = aspecta.Robot("3-rrr")
    ends = [-15.468, 0.781, 0.073], [-9.902, -7.091, 1.081]
    with pytest.raises(aspecta.NoPlan, match=r"stopped after 0\.001 s"):
        robot.plan(*ends, mode="+++", to_mode="++-", seconds=0.001)
    given.clear()
    with pytest.raises(aspecta.NoPlan):
        robot.plan(*ends, mode="+++", to_mode="++-", seconds=2)
    assert given[0] < 2 and given == sorted(set(given), reverse=True)
    robot.assembly(robot.ik([-15.468, 0.781, 0.073])[0].q, seconds=1, depth=4)
    assert given[-1] < 1


def test_budgets_of_plans_and_assemblies_are_checked(five_bar: aspecta.Robot) -> None:
    for wrong in ({"depth": 0}, {"samples": 0}, {"seconds": "1"}, {"avoid": (1, 2, 3)}, {"weight": "1"}):
        with pytest.raises(aspecta.Error, match=r" = .*: give"):
            five_bar.plan([4, 7], [5, 6], mode="++", **wrong)  # type: ignore[arg-type]
    for wrong in ({"depth": 99}, {"samples": 1.5}, {"seconds": 0}):
        with pytest.raises(aspecta.Error, match=r" = .*: give"):
            five_bar.assembly([1, 2], **wrong)  # type: ignore[arg-type]
    assert len(five_bar.assembly(five_bar.ik([4, 7])[0].q, depth=5).solutions) == 2

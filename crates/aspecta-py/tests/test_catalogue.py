"""Every robot of the catalogue: what the package answers is what the command line prints as JSON."""

import numpy as np
import pytest

import aspecta
from conftest import CATALOGUE, POSES, answer, text

#: Slices of the robots that are not analysed whole, and a mode, which is enough to compare.
SLICES: dict[str, dict[str, float]] = {
    name: {"z": z, "roll": 0.1, "pitch": 0.1, "yaw": 0.2} for name, z in (("hexa", -700.0), ("gough-stewart", 0.9))
}


def held(name: str) -> list[str]:
    return [f"--fix={coordinate}={value}" for coordinate, value in SLICES.get(name, {}).items()]


def depth(name: str) -> int:
    """Boxes fine enough to find an aspect, and no finer."""
    return 8 if name in SLICES else 4


@pytest.mark.parametrize("name", CATALOGUE)
def test_analyses(name: str) -> None:
    mode = aspecta.Robot(name).modes[0]
    found = aspecta.Robot(name).analyze(fix=SLICES.get(name), modes=mode, depth=depth(name))
    told = answer("analyze", name, f"--mode={mode}", f"--budget=depth={depth(name)}", *held(name))
    mine = found.to_dict()
    for result in (mine, told):
        del result["run"]["seconds"]
    assert mine == told


@pytest.mark.parametrize("name", CATALOGUE)
def test_domains(name: str) -> None:
    robot = aspecta.Robot(name)
    fix = SLICES.get(name)
    # Of a whole robot `domains` analyses all modes, which numbers the aspects.
    found = robot.analyze(fix=fix, modes=robot.modes[:1] if fix else (), depth=depth(name))
    aspect = found.aspects[0]
    mine = found.domains(aspect.id, cells=8, surfaces=False).domains(aspect.id).to_dict()
    chosen = [f"--mode={aspect.mode}", f"--aspect={aspect.id}", "--cells=8", f"--budget=depth={depth(name)}"]
    (theirs,) = answer("domains", name, *chosen, *held(name))["domains"]
    assert mine == theirs


@pytest.mark.parametrize("name", CATALOGUE)
def test_paths_and_plans(name: str) -> None:
    robot = aspecta.Robot(name)
    start = np.array(POSES[name], dtype=float)
    goal = start + 0.01 * np.maximum(1, np.abs(start))
    mode = next(s.mode for s in robot.ik(start) if s.within_limits)
    rows = "\n".join([",".join(robot.pose_names), text(start), text(goal)]) + "\n"
    checked = robot.check_path([start, goal], mode=mode)
    told = answer("check-path", name, "-", f"--mode={mode}", stdin=rows)
    assert checked.sound and {key: told[key] for key in checked.to_dict()} == checked.to_dict()
    plan = robot.plan(start, goal, mode=mode)
    line = answer("plan", name, f"--from={text(start)}", f"--to={text(goal)}", f"--mode={mode}")
    mine = plan.to_dict()
    assert mine.pop("proved") and {key: line[key] for key in mine} == mine

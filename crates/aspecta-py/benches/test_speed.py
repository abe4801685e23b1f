"""Speed, side by side in one run: `pip install pytest-benchmark pin`, then `pytest benches`.

Pinocchio's direct problem of the five-bar is Newton's method on the closure of the loop, from a start nearby: one pose, with no
guarantee. Aspecta's is all poses, proved to be all.
"""

from typing import Any

import numpy as np
import pytest

import aspecta

RNG = np.random.default_rng(1)


def test_ik_of_a_million_poses(benchmark: Any) -> None:
    robot = aspecta.Robot("3-rrr")
    poses = RNG.uniform([-10, -10, -1], [10, 10, 1], (1_000_000, 3))
    batch = benchmark.pedantic(robot.ik, (poses,), rounds=3)
    assert len(batch) == 1_000_000


def test_fk_of_a_hundred_thousand_joint_vectors(benchmark: Any) -> None:
    robot = aspecta.Robot("3-rrr")
    q = robot.ik(RNG.uniform([-10, -10, -1], [10, 10, 1], (100_000, 3))).q[:100_000]
    batch = benchmark.pedantic(robot.fk, (q,), rounds=3)
    assert batch.complete.mean() > 0.99


def test_a_step_of_a_follower(benchmark: Any) -> None:
    robot = aspecta.Robot("five-bar")
    start = robot.ik([4, 7], mode="++")[0]
    follower = robot.follower(start.pose, start.q)
    there, back = start.q + 1e-3, start.q
    follower.step(there)

    def steps() -> None:
        follower.step(back)
        follower.step(there)

    benchmark(steps)


def test_fk_of_the_five_bar(benchmark: Any) -> None:
    robot = aspecta.Robot("five-bar")
    q = robot.ik([4, 7])[0].q
    assert len(benchmark(robot.fk, q)) == 2


def test_fk_of_the_five_bar_by_pinocchio(benchmark: Any) -> None:
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.Model()
    links = {"q1": (0, 8.0, 0.0), "p1": ("q1", 5.0, 8.0), "q2": (0, 5.0, 0.0), "p2": ("q2", 8.0, 5.0)}
    ids: dict[Any, int] = {0: 0}
    for name, (parent, _, along) in links.items():
        at = np.array([9.0 if name == "q2" else along, 0, 0])
        ids[name] = model.addJoint(ids[parent], pinocchio.JointModelRZ(), pinocchio.SE3(np.eye(3), at), name)
    tips = [
        model.addFrame(
            pinocchio.Frame(
                name, ids[name], pinocchio.SE3(np.eye(3), np.array([links[name][1], 0, 0])), pinocchio.OP_FRAME
            )
        )
        for name in ("p1", "p2")
    ]
    data = model.createData()
    start = aspecta.Robot("five-bar").ik([4, 7], mode="++")[0]
    passive = [model.idx_qs[ids[name]] for name in ("p1", "p2")]
    motors = [model.idx_qs[ids[name]] for name in ("q1", "q2")]

    def solve() -> Any:
        q = np.zeros(4)
        q[motors] = start.q
        q[passive] = guess
        for _ in range(50):
            pinocchio.computeJointJacobians(model, data, q)
            pinocchio.updateFramePlacements(model, data)
            gap = (data.oMf[tips[0]].translation - data.oMf[tips[1]].translation)[:2]
            if np.abs(gap).max() < 1e-10:
                return data.oMf[tips[0]].translation[:2]
            world = pinocchio.LOCAL_WORLD_ALIGNED
            jacobian = (
                pinocchio.getFrameJacobian(model, data, tips[0], world)
                - pinocchio.getFrameJacobian(model, data, tips[1], world)
            )[:2]
            q[passive] -= np.linalg.solve(jacobian[:, passive], gap)
        raise AssertionError("Newton's method does not converge")

    # The passive joints at the pose (4, 7), a little off.
    elbows = (
        np.array([8 * np.cos(start.q[0]), 8 * np.sin(start.q[0])]),
        np.array([9 + 5 * np.cos(start.q[1]), 5 * np.sin(start.q[1])]),
    )
    guess = [
        np.arctan2(*(start.pose - elbow)[::-1]) - motor + 0.05 for elbow, motor in zip(elbows, start.q, strict=True)
    ]
    assert np.allclose(benchmark(solve), [4, 7])

"""Following one solution in a control loop, step by step, each proved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _native

if TYPE_CHECKING:
    from aspecta._description import Description

Array = NDArray[np.float64]


class Step(NamedTuple):
    """A certified step of a :class:`Follower`.

    Attributes:
        pose: X, (dof,): the pose.
        mode: the working mode at the end.
        mode_kept: whether it is proved that no B_jj vanishes along the step.
        within_limits: whether joints are within their limits, and the pose in the window. Numerical.
        length_error: a proved bound of the error of each translation.
        angle_error: a proved bound of the error of the orientation, rad.
        stretches: stretches that were tried: 1 where the step was proved at once.
    """

    pose: Array
    mode: str
    mode_kept: bool
    within_limits: bool
    length_error: float
    angle_error: float
    stretches: int


class JointStep(NamedTuple):
    """A certified step of an :class:`InverseFollower`.

    Attributes:
        q: q, (dof,): the joint vector; angles go on past ±π.
        regular: whether it is proved that det A does not vanish along the step.
        within_limits: whether joints are within their limits, and the pose in the window. Numerical.
        stretches: stretches that were tried: 1 where the step was proved at once.
    """

    q: Array
    regular: bool
    within_limits: bool
    stretches: int


N = TypeVar("N", _native.Follower, _native.InverseFollower)


class _Following(Generic[N]):
    """What both followers have: the configuration they are in."""

    __slots__ = ("_native", "_robot")

    _native: N
    _robot: Description

    def __init__(self, native: N, robot: Description) -> None:
        self._native = native
        self._robot = robot

    @property
    def pose(self) -> Array:
        """X, (dof,): where it is."""
        return np.array(self._native.pose)

    @property
    def q(self) -> Array:
        """q, (dof,): where its joints are."""
        return np.array(self._native.q)

    @property
    def mode(self) -> str:
        """The working mode it is in."""
        return self._native.mode

    def __repr__(self) -> str:
        pose = ", ".join(f"{name} = {x:.6g}" for name, x in zip(self._robot.pose_names, self._native.pose, strict=True))
        return f"<{type(self).__name__} of {self._robot.name} in mode {self.mode} at {pose}>"


class Follower(_Following[_native.Follower]):
    """Follows one direct solution along joint vectors: which pose now?

    >>> import aspecta
    >>> robot = aspecta.Robot("five-bar")
    >>> start = robot.ik([4, 7])[0]
    >>> follower = robot.follower(start)
    >>> step = follower.step(start.q + 0.01)
    >>> step.mode == start.mode, step.mode_kept
    (True, True)
    """

    __slots__ = ()

    def step(self, q: ArrayLike) -> Step:
        """Go to the joint vector q (dof,), straight.

        Raises:
            Error: a singularity is ahead, the step is too long, or the numbers cannot be used. The follower then stays where
                it was.
        """
        given = np.ascontiguousarray(q, dtype=float)
        return Step._make(self._native.step(given if given.ndim == 1 else np.array(self._robot._joints("q", q))))


class InverseFollower(_Following[_native.InverseFollower]):
    """Follows one inverse solution along poses: which joint vector now?"""

    __slots__ = ()

    def step(self, pose: ArrayLike) -> JointStep:
        """Go to the pose X (dof,), straight.

        A homogeneous matrix (4, 4) is taken in the angles nearest to those of the pose it is at.

        Raises:
            Error: as :meth:`Follower.step`.
        """
        given = np.ascontiguousarray(pose, dtype=float)
        if given.ndim != 1:
            given = np.array(self._robot._pose("pose", pose, self._native.pose))
        return JointStep._make(self._native.step(given))

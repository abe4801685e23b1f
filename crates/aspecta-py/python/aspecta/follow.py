"""Following one solution in a control loop, step by step, each proved."""

from __future__ import annotations

from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _native

Array = NDArray[np.float64]


class Step(NamedTuple):
    """A certified step of a :class:`Follower`."""

    #: X, (dof,): the pose.
    pose: Array
    #: The working mode at the end.
    mode: str
    #: Whether it is proved that no B_jj vanishes along the step.
    mode_kept: bool
    #: Whether joints are within their limits, and the pose in the window. Numerical.
    within_limits: bool
    #: A proved bound of the error of each translation.
    length_error: float
    #: A proved bound of the error of the orientation, rad.
    angle_error: float
    #: Stretches that were tried: 1 where the step was proved at once.
    stretches: int


class JointStep(NamedTuple):
    """A certified step of an :class:`InverseFollower`."""

    #: q, (dof,): the joint vector; angles go on past ±π.
    q: Array
    #: Whether it is proved that det A does not vanish along the step.
    regular: bool
    #: Whether joints are within their limits, and the pose in the window. Numerical.
    within_limits: bool
    #: Stretches that were tried: 1 where the step was proved at once.
    stretches: int


def _vector(values: ArrayLike) -> Array:
    return np.ascontiguousarray(values, dtype=float)


N = TypeVar("N", _native.Follower, _native.InverseFollower)


class _Following(Generic[N]):
    """What both followers have: the configuration they are in."""

    __slots__ = ("_native",)

    _native: N

    def __init__(self, native: N) -> None:
        self._native = native

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


class Follower(_Following[_native.Follower]):
    """Follows one direct solution along joint vectors: which pose now?

    >>> import aspecta
    >>> robot = aspecta.Robot("five-bar")
    >>> start = robot.ik([4, 7])[0]
    >>> follower = robot.follower(start.pose, start.q)
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
        return Step._make(self._native.step(_vector(q)))


class InverseFollower(_Following[_native.InverseFollower]):
    """Follows one inverse solution along poses: which joint vector now?"""

    __slots__ = ()

    def step(self, pose: ArrayLike) -> JointStep:
        """Go to the pose X (dof,), straight.

        Raises:
            Error: as :meth:`Follower.step`.
        """
        return JointStep._make(self._native.step(_vector(pose)))

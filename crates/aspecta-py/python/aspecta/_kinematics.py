"""Single configurations of a robot: inverse and direct problem, Jacobians, followers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native, poses
from aspecta._description import Description
from aspecta.follow import Follower, InverseFollower
from aspecta.results import State
from aspecta.solutions import Solution, SolutionList, Solutions

Array = NDArray[np.float64]


class Kinematics(Description):
    """A robot as a mechanism: what :class:`~aspecta.Robot` is asked about single configurations."""

    __slots__ = ()

    @overload
    def ik(self, pose: Sequence[float]) -> SolutionList: ...
    @overload
    def ik(
        self,
        pose: ArrayLike | None = None,
        *,
        mode: str | None = None,
        quaternion_xyzw: ArrayLike | None = None,
        quaternion_wxyz: ArrayLike | None = None,
    ) -> Any: ...
    def ik(
        self,
        pose: ArrayLike | None = None,
        *,
        mode: str | None = None,
        quaternion_xyzw: ArrayLike | None = None,
        quaternion_wxyz: ArrayLike | None = None,
    ) -> SolutionList | Solutions:
        """Solve the inverse problem: all joint vectors of a pose, one per working mode that reaches it.

        Args:
            pose: (dof,), lengths in the robot's unit, angles in rad; or (n, dof), solved on all cores. In space also
                homogeneous matrices (4, 4) or (n, 4, 4); or positions (3,) or (n, 3) with a quaternion.
            mode: only the solution in this working mode, such as ``"+-+"``.
            quaternion_xyzw, quaternion_wxyz: orientations (4,) or (n, 4), their order named, of a body that turns in space; of
                one that only turns they are enough.

        Returns:
            The solutions of one pose; of (n, …) poses a :class:`Solutions` with arrays.

        Raises:
            Error: the array does not fit the robot, or holds numbers that are not finite.
        """
        given = self._poses(pose, quaternion_xyzw, quaternion_wxyz)
        mode = None if mode is None else self._known(mode)
        if given.ndim == 1:
            alone = (Solution(*parts) for parts in self._native.inverse_one(given))
            return SolutionList([s for s in alone if mode in (None, s.mode)], None, self.pose_names)
        found = Solutions({**self._native.inverse(given), "complete": None}, self)
        return found if mode is None else found.in_mode(mode)

    @overload
    def fk(self, q: Sequence[float]) -> SolutionList: ...
    @overload
    def fk(self, q: ArrayLike, *, mode: str | None = None) -> Any: ...
    def fk(self, q: ArrayLike, *, mode: str | None = None) -> SolutionList | Solutions:
        """Solve the direct problem: all poses of a joint vector, in every working mode.

        Args:
            q: (dof,), lengths in the robot's unit, angles in rad; or (n, dof), solved on all cores.
            mode: only the solutions in this working mode.

        Returns:
            The solutions of one joint vector, ``complete`` if they are proved to be all; of (n, dof) a :class:`Solutions`.

        Raises:
            Error: as :meth:`ik`; or the platform can move while the joints are locked.
        """
        given = _input.fitting(q, self._motors, self.name)
        mode = None if mode is None else self._known(mode)
        if given.ndim == 1:
            all_parts, complete = self._native.direct_one(given)
            alone = (Solution(*parts) for parts in all_parts)
            return SolutionList([s for s in alone if mode in (None, s.mode)], complete, self.pose_names)
        found = Solutions(self._native.direct(given), self)
        return found if mode is None else found.in_mode(mode)

    def mode_in_words(self, mode: str) -> str | None:
        """Return a working mode by the names of its postures; ``None`` if they have none.

        Everywhere a mode is asked for, such names do as well.

        >>> import aspecta
        >>> aspecta.Robot("five-bar").mode_in_words("+-")
        'left,right'
        """
        return self._native.words(self._known(mode))

    def limits_beyond(self, pose: ArrayLike, mode: str) -> list[str]:
        """Return the names of the limits that the robot goes beyond at a pose (dof,) in a working mode.

        Raises:
            Error: legs do not reach the pose; they are named.
        """
        return self._native.beyond(self._pose("pose", pose), self._known(mode))

    @overload
    def state(self, pose: Solution, q: None = None) -> State: ...
    @overload
    def state(self, pose: ArrayLike, q: ArrayLike) -> State | list[State]: ...
    def state(self, pose: ArrayLike | Solution, q: ArrayLike | None = None) -> State | list[State]:
        """Return the Jacobians of a configuration, its kind of singularity and its distance from singularities.

        A configuration is a solution, or a pose and a joint vector; of several, (n, dof) each, a list. They need not belong
        together: look at ``residual``.
        """
        pose, q = _configuration(pose, q)
        xs, qs = self._poses(pose), _input.fitting(q, self._motors, self.name)
        if xs.shape != qs.shape:
            raise _native.Error(f"poses {xs.shape} and joint vectors {qs.shape}: give as many of each")
        if xs.ndim == 1:
            return State(self._native.state(xs.tolist(), qs.tolist()))
        return [State(self._native.state(x, y)) for x, y in zip(xs.tolist(), qs.tolist(), strict=True)]

    def follower(self, pose: ArrayLike | Solution, q: ArrayLike | None = None) -> Follower:
        """Return a :class:`Follower` that starts in a configuration, and follows its pose along joint vectors.

        The configuration is a solution, or a pose (dof,) and a joint vector (dof,).
        """
        pose, q = _configuration(pose, q)
        return Follower(_native.Follower(self._native, self._pose("pose", pose), self._joints("q", q)), self)

    def inverse_follower(self, pose: ArrayLike, mode: str) -> InverseFollower:
        """Return an :class:`InverseFollower` that starts at a pose in a mode, and follows its joints along poses."""
        native = _native.InverseFollower(self._native, self._pose("pose", pose), self._known(mode))
        return InverseFollower(native, self)

    def matrix(self, pose: ArrayLike) -> Array:
        """Return poses (…, dof) of a platform in space as homogeneous matrices (…, 4, 4)."""
        return poses.to_matrix(self.platform, pose)


def _configuration(pose: ArrayLike | Solution, q: ArrayLike | None) -> tuple[ArrayLike, ArrayLike]:
    """A pose and a joint vector, which a solution has both."""
    if isinstance(pose, Solution):
        if q is not None:
            raise _native.Error("a solution has its joint vector: give the solution alone, or its pose and q")
        return pose.pose, pose.q
    if q is None:
        raise _native.Error("give a solution, or a pose and its joint vector q")
    return pose, q

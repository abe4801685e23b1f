"""Robots, and what is asked of them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native, poses
from aspecta._description import Description
from aspecta._progress import Progress, kept, reporter
from aspecta.analysis import Analysis
from aspecta.follow import Follower, InverseFollower
from aspecta.results import (
    AssemblyModes,
    Cusps,
    Exploration,
    JoinedSolutions,
    Motion,
    PathCheck,
    Plan,
    State,
)
from aspecta.solutions import Solution, SolutionList, Solutions

Array = NDArray[np.float64]

#: How often a plan is looked for again over finer boxes.
_FINER = 2
#: Samples of a roadmap that is to join given poses.
_SAMPLES = 20_000


class Robot(Description):
    """A fully parallel robot: from the catalogue, from a file, or built from its legs.

    >>> import aspecta
    >>> robot = aspecta.Robot("five-bar")
    >>> robot.dof, robot.modes
    (2, ['++', '+-', '--', '-+'])

    Built in code, with the keys of robot files (``docs/robot-files.md``):

    >>> leg = {"actuator": {"kind": "revolute", "crank": 8, "rod": 5}}
    >>> built = aspecta.Robot(platform="plane-point", legs=[{"anchor": [0, 0], **leg}, {"anchor": [9, 0], **leg}])
    >>> len(built.ik([4, 7]))
    4

    Raises:
        Error: there is no such robot, or the data makes none; the message names the file, the key and the value.
    """

    __slots__ = ()

    # Single configurations.

    @overload
    def ik(self, pose: Sequence[float]) -> SolutionList: ...
    @overload
    def ik(
        self,
        pose: ArrayLike,
        *,
        mode: str | None = None,
        quaternion_xyzw: ArrayLike | None = None,
        quaternion_wxyz: ArrayLike | None = None,
    ) -> Any: ...
    def ik(
        self,
        pose: ArrayLike,
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
            quaternion_xyzw, quaternion_wxyz: orientations (4,) or (n, 4) of a free body, their order named.

        Returns:
            The solutions of one pose; of (n, …) poses a :class:`Solutions` with arrays.

        Raises:
            Error: the array does not fit the robot, or holds numbers that are not finite.
        """
        given = self._poses(pose, quaternion_xyzw, quaternion_wxyz)
        mode = None if mode is None else self._known(mode)
        if given.ndim == 1:
            alone = (Solution(*parts) for parts in self._native.inverse_one(given))
            return SolutionList([s for s in alone if mode in (None, s.mode)])
        found = Solutions({**self._native.inverse(given), "complete": None})
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
            return SolutionList([s for s in alone if mode in (None, s.mode)], complete)
        found = Solutions(self._native.direct(given))
        return found if mode is None else found.in_mode(mode)

    def mode_in_words(self, mode: str) -> str | None:
        """Return a working mode by the names of its postures; ``None`` if they have none.

        Everywhere a mode is asked for, such names do as well.

        >>> import aspecta
        >>> aspecta.Robot("five-bar").mode_in_words("+-")
        'left,right'
        """
        return self._native.words(mode)

    def limits_beyond(self, pose: ArrayLike, mode: str) -> list[str]:
        """Return the names of the limits that the robot goes beyond at a pose (dof,) in a working mode."""
        return self._native.beyond(_input.vector(pose), mode)

    def state(self, pose: ArrayLike, q: ArrayLike) -> State | list[State]:
        """Return the Jacobians of a configuration, its kind of singularity and its distance from singularities.

        Of several, (n, dof) each, a list. The pose and the joint vector need not belong together: look at ``residual``.
        """
        xs, qs = self._poses(pose), _input.fitting(q, self._motors, self.name)
        if xs.shape != qs.shape:
            raise _native.Error(f"poses {xs.shape} and joint vectors {qs.shape}: give as many of each")
        if xs.ndim == 1:
            return State(self._native.state(xs.tolist(), qs.tolist()))
        return [State(self._native.state(x, y)) for x, y in zip(xs.tolist(), qs.tolist(), strict=True)]

    def follower(self, pose: ArrayLike, q: ArrayLike) -> Follower:
        """Return a :class:`Follower` that starts in a configuration, and follows its pose along joint vectors."""
        return Follower(_native.Follower(self._native, _input.vector(pose), _input.vector(q)))

    def inverse_follower(self, pose: ArrayLike, mode: str) -> InverseFollower:
        """Return an :class:`InverseFollower` that starts at a pose in a mode, and follows its joints along poses."""
        return InverseFollower(_native.InverseFollower(self._native, _input.vector(pose), self._known(mode)))

    def matrix(self, pose: ArrayLike) -> Array:
        """Return poses (…, dof) of a platform in space as homogeneous matrices (…, 4, 4)."""
        return poses.to_matrix(self.platform, pose)

    # Aspects.

    def analyze(
        self,
        *,
        fix: Mapping[str, float] | None = None,
        modes: str | Sequence[str] = (),
        seconds: float | None = None,
        boxes: int | None = None,
        depth: int | None = None,
        resolution: float | None = None,
        certificate: bool = False,
        progress: Progress = None,
    ) -> Analysis:
        """Find the generalized aspects (Def. 8), with certified bounds on their number.

        Args:
            fix: coordinates to hold, such as ``{"phi": 0.5}`` (rad): the slice with these values is analysed.
            modes: working modes to analyse; all if left out.
            seconds, boxes, depth, resolution: when to stop before the bounds meet, whichever comes first; without any, when
                they have met.
            certificate: whether to keep the proof, as :attr:`Analysis.certificate`.
            progress: called as ``progress(stage, done, total)`` now and then, or ``True`` for a bar.

        Raises:
            Error: the workspace is unbounded, or more than three coordinates vary.
            KeyboardInterrupt: at Ctrl-C; its ``partial()`` returns the analysis so far, or ``None``.

        >>> import aspecta
        >>> found = aspecta.Robot("five-bar").analyze()
        >>> found.low, found.high
        (10, 10)
        """
        wanted = [modes] if isinstance(modes, str) else list(modes)
        held = _input.held(fix, self._coordinates)
        known = [self._known(mode) for mode in wanted]
        budget = (
            _input.positive("seconds", seconds),
            _input.whole("boxes", boxes, 1),
            _input.whole("depth", depth, 1, _native.MAX_DEPTH),
            _input.positive("resolution", resolution),
        )
        return kept(
            lambda: self._native.analyze(held, known, *budget, certificate, reporter(progress)),
            lambda native: Analysis(self, native),
        )

    def explore(
        self,
        *,
        modes: str | Sequence[str] = (),
        samples: int = 1024,
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Exploration:
        """Explore the classes of a robot with six coordinates by roadmaps whose segments are proved."""
        wanted = [modes] if isinstance(modes, str) else list(modes)
        effort = _effort(samples, seconds)
        known = [self._known(mode) for mode in wanted]
        return kept(lambda: _native.explore(self._native, known, effort, reporter(progress)), Exploration)

    def cusps(
        self,
        *,
        fix: Mapping[str, float] | None = None,
        mode: str | None = None,
        boxes: int | None = None,
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Cusps:
        """Find where three direct solutions meet: all cusps of the slice in which a joint is held, such as
        ``fix={"q1": 14.98}``, proved; without ``fix``, of a robot with three coordinates, the curves they form. After
        ``boxes`` or ``seconds`` what was found so far.
        """
        held = _input.held(fix, self._motors)
        known = None if mode is None else self._known(mode)
        effort = (_input.whole("boxes", boxes, 1), _input.positive("seconds", seconds))
        return Cusps(_native.cusps(self._native, held, known, *effort, reporter(progress)))

    # Paths.

    def check_path(
        self,
        poses: ArrayLike | None = None,
        *,
        mode: str | None = None,
        joints: ArrayLike | None = None,
        start: ArrayLike | None = None,
        joined: str = "straight",
        avoid: tuple[float, float] = (0.0, 0.0),
    ) -> PathCheck:
        """Check whether a path meets a singularity, leaves limits or comes too near, between its samples too.

        Args:
            poses: (n, dof), in the working mode ``mode``; or
            joints: (n, dof), which start at the pose ``start`` (needed where the first has several).
            joined: how samples are joined: ``"straight"``, by a ``"spline"``, or ``"none"``.
            avoid: the margins to keep: the least ``|det Â|`` and the least ``|B_jj| / max |B_jj|``.

        Raises:
            Error: what is given is no path of the robot.
        """
        asked = (joined, float(avoid[0]), float(avoid[1]))
        if (poses is None) == (joints is None):
            raise _native.Error("give a path of poses, or of joints")
        if poses is None:
            first = None if start is None else _input.vector(start)
            return PathCheck(
                *_native.check_joints(self._native, _input.rows([] if joints is None else joints), first, asked)
            )
        if mode is None:
            raise _native.Error(f"say in which working mode the poses are taken: mode = one of {', '.join(self.modes)}")
        rows = _input.rows(self._poses(poses))
        return PathCheck(*_native.check_poses(self._native, rows, self._known(mode), asked))

    def time(
        self,
        poses: ArrayLike,
        *,
        mode: str,
        speed: float | Sequence[float],
        acceleration: float | Sequence[float],
        joined: str = "straight",
        rate: float = 100.0,
    ) -> Motion:
        """Return the fastest motion through a path of poses (n, dof) under limits of joint speed and acceleration."""
        return self.check_path(poses, mode=mode, joined=joined).time(speed, acceleration, rate=rate)

    def plan(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        *,
        mode: str,
        to_mode: str | None = None,
        through_modes: bool = False,
        weight: float = 1.0,
        avoid: tuple[float, float] = (0.0, 0.0),
        samples: int = _SAMPLES,
        seconds: float | None = None,
        depth: int | None = None,
        progress: Progress = None,
    ) -> Plan:
        """Plan a motion between two poses (dof,): see :meth:`Analysis.plan`, which plans again without analysing anew.

        Where three coordinates vary the straight way is tried first. Robots with six coordinates are planned over a roadmap of ``samples`` poses, within a
        mode; the aspects of others are found in boxes of the given ``depth`` (default: as fine as it takes, within reason).
        """
        ends = [_input.vector(start), _input.vector(goal)]
        wanted = _input.wishes(weight, avoid)
        mode, to_mode = self._known(mode), None if to_mode is None else self._known(to_mode)
        through = through_modes or to_mode not in (None, mode)
        if self.platform == "free-body":
            if through:
                raise _native.Error("changes of working mode are not planned for free bodies")
            effort = _effort(samples, seconds)
            found = _native.plan_over_roadmap(self._native, ends, mode, wanted, effort, reporter(progress))
            return Plan(*found)
        # With two coordinates the aspects cost nothing to speak of, and the plan tells in which it lies.
        straight = None if through or self.dof == 2 else self._native.straight(ends, mode, wanted)
        if straight is not None:
            return Plan(*straight)
        return self._over_boxes(ends, mode, to_mode, through, wanted, seconds, depth, progress)

    def _over_boxes(
        self,
        ends: list[list[float]],
        mode: str,
        to_mode: str | None,
        through: bool,
        wanted: tuple[float, float, float],
        seconds: float | None,
        depth: int | None,
        progress: Progress,
    ) -> Plan:
        """Plan through aspects, over finer boxes where they may tell more."""
        usual = _native.coarse_depth(self.dof)
        for finer in range(_FINER + 1):
            modes = [] if through or self.dof == 2 else [mode]
            analysis = self.analyze(modes=modes, seconds=seconds, depth=depth or usual + finer, progress=progress)
            try:
                return analysis.plan(
                    *ends,
                    mode=mode,
                    to_mode=to_mode,
                    through_modes=through,
                    weight=wanted[0],
                    avoid=wanted[1:],
                    progress=progress,
                )
            except _native.NoPlan as refusal:
                if depth is not None or finer == _FINER or not refusal.finer:
                    raise
        raise AssertionError("the last round returns or raises")

    def assembly(
        self, q: ArrayLike, *, samples: int = _SAMPLES, seconds: float | None = None, progress: Progress = None
    ) -> AssemblyModes | JoinedSolutions:
        """Return the direct solutions of a joint vector q (dof,), by aspect; of a free body, by what a roadmap joins."""
        if self.platform == "free-body":
            effort = _effort(samples, seconds)
            return JoinedSolutions(_native.join_solutions(self._native, _input.vector(q), effort, reporter(progress)))
        modes = [] if self.dof == 2 else sorted({s.mode for s in self.fk(q)})
        return self.analyze(
            modes=modes, seconds=seconds, depth=_native.coarse_depth(self.dof), progress=progress
        ).assembly(q)

    def to_mjcf(self, pose: ArrayLike | None = None, mode: str | None = None) -> str:
        """Return the robot as a model for MuJoCo that starts at a pose (dof,) in a working mode.

        Without a pose it starts at one far from singularities, without a mode in that farthest from them.

        Warns of limits of passive joints, which the model lacks.
        """
        model, left_out = self._native.mjcf(
            None if pose is None else _input.vector(pose), None if mode is None else self._known(mode)
        )
        if left_out:
            warnings.warn(f"the model lacks the limits of passive joints: {', '.join(left_out)}", stacklevel=2)
        return model


def _effort(samples: int, seconds: float | None) -> tuple[int, float | None]:
    """How long a roadmap may grow."""
    _input.whole("samples", samples, 1)
    return samples, _input.positive("seconds", seconds)

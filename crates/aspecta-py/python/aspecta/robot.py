"""Robots, and what is asked of them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence

from numpy.typing import ArrayLike

from aspecta import _input, _native
from aspecta._kinematics import Kinematics
from aspecta._progress import Progress, TimeLeft, all_or_nothing, kept, reporter
from aspecta.analysis import Analysis
from aspecta.paths import Motion, PathCheck, Plan
from aspecta.results import AssemblyModes, Cusps, Exploration, JoinedSolutions

#: How often a plan is looked for again over finer boxes.
_FINER = 2
#: Samples of a roadmap that is to join given poses.
_SAMPLES = 20_000


class Robot(Kinematics):
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

    # Aspects.

    def analyze(
        self,
        *,
        fix: Mapping[str, float] | None = None,
        modes: str | Sequence[str] | None = None,
        seconds: float | None = None,
        boxes: int | None = None,
        depth: int | None = None,
        resolution: float | None = None,
        certificate: bool = False,
        numbers_only: bool = False,
        progress: Progress = None,
    ) -> Analysis:
        """Find the generalized aspects (Def. 8), with certified bounds on their number.

        Args:
            fix: coordinates to hold, such as ``{"phi": 0.5}`` (rad): the slice with these values is analysed.
            modes: working modes to analyse; all if left out.
            seconds, boxes, depth, resolution: when to stop before the bounds meet, whichever comes first; without any, when
                they have met.
            certificate: whether to keep the proof, as :attr:`Analysis.certificate`.
            numbers_only: whether nothing is to be drawn or planned: a fraction of the boxes then does, as on the command line
                without ``--out``.
            progress: called as ``progress(stage, done, total)`` now and then, or ``True`` for a bar (with tqdm installed).

        Raises:
            Error: the workspace is unbounded, or more than three coordinates vary.
            KeyboardInterrupt: at Ctrl-C; its ``partial()`` returns the analysis so far, or ``None``.

        >>> import aspecta
        >>> found = aspecta.Robot("five-bar").analyze()
        >>> found.low, found.high
        (10, 10)
        """
        held = _input.held(fix, self._coordinates)
        known = self._modes_of(modes)
        budget = (
            _input.positive("seconds", seconds),
            _input.whole("boxes", boxes, 1),
            _input.whole("depth", depth, 1, _native.MAX_DEPTH),
            _input.positive("resolution", resolution),
        )
        return kept(
            lambda: self._native.analyze(held, known, *budget, certificate, numbers_only, reporter(progress)),
            lambda native: Analysis(self, native, native.json(), native.text(False)),
        )

    def explore(
        self,
        *,
        modes: str | Sequence[str] | None = None,
        samples: int = 1024,
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Exploration:
        """Explore the classes of a robot with six coordinates by roadmaps whose segments are proved."""
        effort = _input.effort(samples, seconds)
        known = self._modes_of(modes)
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
        ``fix={"q1": 14.98}`` of the robot ``3-rpr``, proved; without ``fix``, of a robot with three coordinates, the curves
        they form. After ``boxes`` or ``seconds``, and at Ctrl-C by ``partial()``, what was found so far.
        """
        held = _input.held(fix, self._motors)
        known = None if mode is None else self._known(mode)
        effort = (_input.whole("boxes", boxes, 1), _input.positive("seconds", seconds))
        return kept(lambda: _native.cusps(self._native, held, known, *effort, reporter(progress)), Cusps)

    # Paths.

    @all_or_nothing
    def check_path(
        self,
        poses: ArrayLike | None = None,
        *,
        mode: str | None = None,
        joints: ArrayLike | None = None,
        start: ArrayLike | None = None,
        joined: str = "straight",
        avoid: float | Sequence[float] = (0.0, 0.0),
    ) -> PathCheck:
        """Check whether a path meets a singularity, leaves limits or comes too near, between its samples too.

        Args:
            poses: (n, dof), in the working mode ``mode``: coordinates are joined as numbers, so angles go on past ±π; or
                homogeneous matrices (n, 4, 4), each taken in the angles nearest to those of the one before; or
            joints: (n, dof), which start at the pose ``start`` (needed where the first has several).
            joined: how samples are joined: ``"straight"``, by a ``"spline"``, or ``"none"``.
            avoid: the margins to keep: the least ``|det Â|`` and the least ``|B_jj| / max |B_jj|``, or a number for both.

        Raises:
            Error: what is given is no path of the robot.
        """
        margins = _input.margins(avoid)
        asked = (joined, *margins)
        if (poses is None) == (joints is None):
            raise _native.Error("give a path of poses, or of joints")
        if poses is not None and start is not None:
            raise _native.Error("start is the pose at which joints start: a path of poses has its own")
        if joints is not None and mode is not None:
            raise _native.Error("mode is that of poses: joints and the pose they start at have theirs")
        if joints is not None:
            first = None if start is None else self._pose("start", start)
            rows = _input.rows("joints", joints, self._motors, self.name)
            return PathCheck(*_native.check_joints(self._native, rows, first, asked), self.pose_names)
        if mode is None or poses is None:
            raise _native.Error(f"say in which working mode the poses are taken: mode = one of {', '.join(self.modes)}")
        path = self._path("poses", poses)
        return PathCheck(*_native.check_poses(self._native, path, self._known(mode), asked), self.pose_names)

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
        """Return the fastest motion through a path of poses (n, dof) under limits of joint speed and acceleration.

        Matrices (n, 4, 4) are taken as :meth:`check_path` takes them.
        """
        return self.check_path(poses, mode=mode, joined=joined).time(speed, acceleration, rate=rate)

    @all_or_nothing
    def plan(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        *,
        mode: str,
        to_mode: str | None = None,
        through_modes: bool = False,
        weight: float = 1.0,
        avoid: float | Sequence[float] = (0.0, 0.0),
        samples: int = _SAMPLES,
        seconds: float | None = None,
        depth: int | None = None,
        progress: Progress = None,
    ) -> Plan:
        """Plan a motion between two poses (dof,): see :meth:`Analysis.plan`, which plans again without analysing anew.

        Where three coordinates vary a straight way, and one round what is in between, are tried first. Robots with six
        coordinates are planned over a roadmap of ``samples`` poses, within a mode; the aspects of others are found in boxes of
        the given ``depth`` (default: as fine as it takes, within reason). All steps together have so many ``seconds``, after
        which those that can stop do.
        """
        ends = [self._pose("start", start), self._pose("goal", goal)]
        wanted = _input.wishes(weight, avoid)
        effort = _input.effort(samples, seconds)
        depth = _input.whole("depth", depth, 1, _native.MAX_DEPTH)
        mode, to_mode = self._known(mode), None if to_mode is None else self._known(to_mode)
        through = through_modes or to_mode not in (None, mode)
        if self.platform == "free-body":
            if through:
                raise _native.Error("changes of working mode are not planned for free bodies")
            found = _native.plan_over_roadmap(self._native, ends, mode, wanted, effort, reporter(progress))
            return Plan(*found, self.pose_names)
        left = TimeLeft(effort[1])
        # With two coordinates the aspects cost nothing to speak of, and the plan tells in which it lies.
        quick = None if through or self.dof == 2 else self._native.plan_without_aspects(ends, mode, wanted)
        if quick is not None:
            return Plan(*quick, self.pose_names)
        usual = _native.coarse_depth(self.dof)
        modes = [] if through or self.dof == 2 else [mode]
        # Finer boxes may tell more.
        for finer in range(_FINER + 1):
            analysis = self.analyze(modes=modes, seconds=left(), depth=depth or usual + finer, progress=progress)
            try:
                return analysis.plan(
                    *ends,
                    mode=mode,
                    to_mode=to_mode,
                    through_modes=through,
                    weight=weight,
                    avoid=avoid,
                    seconds=left(),
                    progress=progress,
                )
            except _native.NoPlan as refusal:
                if left.is_over and not refusal.proved:
                    refusal.args = (f"{refusal}; it was stopped after {seconds:g} s",)
                if depth is not None or finer == _FINER or not refusal.finer or left.is_over:
                    raise
        raise AssertionError("the last round returns or raises")

    def assembly(
        self,
        q: ArrayLike,
        *,
        samples: int = _SAMPLES,
        seconds: float | None = None,
        depth: int | None = None,
        progress: Progress = None,
    ) -> AssemblyModes | JoinedSolutions:
        """Return the direct solutions of a joint vector q (dof,), by aspect; of a free body, by what a roadmap joins.

        A roadmap has so many ``samples``; aspects are found in boxes of the given ``depth``, by default one that is fine
        enough to work with. All steps together have so many ``seconds``.
        """
        joints, effort = self._joints("q", q), _input.effort(samples, seconds)
        depth = _input.whole("depth", depth, 1, _native.MAX_DEPTH) or _native.coarse_depth(self.dof)
        if self.platform == "free-body":
            return kept(
                lambda: _native.join_solutions(self._native, joints, effort, reporter(progress)), JoinedSolutions
            )
        return self._by_aspect(joints, depth, TimeLeft(effort[1]), progress)

    @all_or_nothing
    def _by_aspect(self, q: list[float], depth: int, left: TimeLeft, progress: Progress) -> AssemblyModes:
        """The direct solutions of a joint vector, by aspect."""
        modes = [] if self.dof == 2 else sorted({s.mode for s in self.fk(q)})
        return self.analyze(modes=modes, seconds=left(), depth=depth, progress=progress).assembly(q)

    def to_mjcf(self, pose: ArrayLike | None = None, mode: str | None = None) -> str:
        """Return the robot as a model for MuJoCo that starts at a pose (dof,) in a working mode.

        Without a pose it starts at one far from singularities, without a mode in that farthest from them.

        Warns of limits that the model lacks: those of passive joints, and contacts of bodies without thickness.
        """
        model, left_out = self._native.mjcf(
            None if pose is None else self._pose("pose", pose), None if mode is None else self._known(mode)
        )
        if left_out:
            warnings.warn(f"the model lacks these limits: {', '.join(left_out)}", stacklevel=2)
        return model

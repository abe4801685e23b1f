"""Analyses: the working modes and generalized aspects of a robot, and what is asked of them."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native, certificates
from aspecta._pose_sets import pose_set
from aspecta._progress import Progress, all_or_nothing, kept, reporter
from aspecta._result import Result
from aspecta._table import Frame, columns, to_html
from aspecta.maps import Map
from aspecta.paths import Plan
from aspecta.results import AssemblyModes, ModeGraph, Traversability

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from aspecta.robot import Robot

Array = NDArray[np.float64]
Range = tuple[float, float]
#: A value or a range (low, high) per coordinate, in their order or by name.
Ranges = Sequence[float | Sequence[float]] | Mapping[str, float | Sequence[float]] | NDArray[np.float64]

#: Most random poses at which a map is compared with the direct model.
_MOST_SAMPLES = 10_000_000


@dataclass(frozen=True)
class Aspect:
    """A generalized aspect (Def. 8), as far as it is proved.

    Attributes:
        id: its number within the analysis, from 1.
        mode: the working mode.
        det_a: the sign of det A: ``"+"`` or ``"-"``.
        measure: certified inner measure: area, volume or what else :attr:`Analysis.measure` says.
        pieces: in how many certified connected pieces its cells fall; 1 if all are proved connected.
        pose: a pose inside, (dof,).
        q: its joint vector, (dof,).
        w_bounds: bounds of the W-aspect, per pose coordinate.
        q_bounds: bounds of the Q-aspect, per joint coordinate.
    """

    id: int
    mode: str
    det_a: str
    measure: float
    pieces: int
    pose: tuple[float, ...]
    q: tuple[float, ...]
    w_bounds: tuple[Range, ...]
    q_bounds: tuple[Range, ...]


def _bounds(count: Mapping[str, Any]) -> str:
    """Bounds on a number in words."""
    low, high = count["low"], count["high"]
    return f"exactly {low}" if low == high else f"at least {low}" if high is None else f"{low} to {high}"


class Analysis(Result, Frame):
    """The working modes and generalized aspects of a robot, or of a slice of it. Made by :meth:`Robot.analyze`.

    Printed it is Tables 1 and 2 of the paper; bounds on the number of aspects are certified.

    Attributes:
        robot: the robot.
        classes: Table 2: a class per working mode and sign of det A.
        doubts: what keeps the bounds apart, if they are.
        singular_modes: the modes in which det A vanishes at every pose, because two legs are one and the same: they have no aspects.
        measure: the quantity measured, and its unit.
    """

    __slots__ = ("_paving", "_picture", "robot")

    robot: Robot
    classes: list[dict[str, Any]]
    doubts: list[dict[str, Any]]
    singular_modes: list[dict[str, Any]]
    measure: dict[str, Any]
    _paving: _native.Analysis | None
    #: The SVG that notebooks show, once it was asked for.
    _picture: str | None

    def __init__(self, robot: Robot, native: _native.Analysis | None, data: str | dict[str, Any], text: str) -> None:
        super().__init__(data, text)
        self.robot = robot
        self._paving = native
        self._picture = None

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.robot, None, self._data, self._text)

    def __copy__(self) -> Analysis:
        return Analysis(self.robot, self._paving, self._data, self._text)

    def __deepcopy__(self, memo: dict[int, Any]) -> Analysis:
        # The boxes never change: copies share them.
        return Analysis(self.robot, self._paving, copy.deepcopy(self._data, memo), self._text)

    def _boxes(self) -> _native.Analysis:
        if self._paving is None:
            raise _native.Error(
                "a pickled analysis holds its answers, not the boxes behind them: analyse the robot again"
            )
        return self._paving

    @property
    def low(self) -> int:
        """At least so many aspects (certified)."""
        return int(self._data["aspects"]["low"])

    @property
    def high(self) -> int | None:
        """At most so many aspects (certified); ``None`` if no bound is proved."""
        high = self._data["aspects"]["high"]
        return None if high is None else int(high)

    @property
    def exact(self) -> bool:
        """Whether the bounds on the number of aspects have met."""
        return self.low == self.high

    @property
    def aspects(self) -> list[Aspect]:
        """The aspects found, in the order of their numbers."""

        def aspect(c: dict[str, Any], a: dict[str, Any]) -> Aspect:
            bounds = {name: tuple((lo, hi) for lo, hi in a[name]) for name in ("w_bounds", "q_bounds")}
            sample = a["sample"]
            return Aspect(
                a["id"],
                c["mode"],
                c["det_a"],
                a["measure"],
                a["pieces"],
                tuple(sample["pose"]),
                tuple(sample["q"]),
                **bounds,
            )

        found = [aspect(c, a) for c in self.classes for a in c["aspects"]]
        return sorted(found, key=lambda a: a.id)

    @property
    def working_modes(self) -> list[dict[str, Any]]:
        """Table 1: the working modes, and whether they are reachable."""
        return list(self._data["modes"])

    def summary(self, *, degrees: bool = False) -> str:
        """Return the tables of the terminal, angles in radians or in degrees."""
        return self._boxes().text(degrees) if degrees else str(self)

    def _repr_html_(self) -> str:
        if self._picture is None and self._paving is not None:
            self._picture = self._paving.picture() or ""
        measure = f"{self.measure['name']} [{self.measure['unit']}]"
        rows = [[c["mode"], c["det_a"], _bounds(c), c["measure"], c["undecided"]] for c in self.classes]
        heads = ["mode", "det A", "aspects", f"certified {measure}", "undecided"]
        count = f"number of generalized aspects, certified: {_bounds(self._data['aspects'])}"
        return f"{to_html(count, heads, rows)}{self._picture or ''}"

    def _columns(self) -> dict[str, Any]:
        """An aspect a line."""
        found = self.aspects
        dof = self.robot.dof
        return {
            **{name: [getattr(a, name) for a in found] for name in ("id", "mode", "det_a", "measure", "pieces")},
            **columns(self.robot.pose_names, np.reshape([a.pose for a in found], (-1, dof))),
            **columns(self.robot.joint_names, np.reshape([a.q for a in found], (-1, dof))),
        }

    def at(self, pose: ArrayLike, *, mode: str | None = None) -> list[Aspect]:
        """Return the aspects in which a pose (dof,) lies, one for each working mode in which it does (certified).

        A pose nearer to a border than cells tell is in none here; finer boxes may tell.
        """
        boxes, found = self._boxes(), []
        mode = None if mode is None else self.robot._known(mode)
        aspects = {a.id: a for a in self.aspects}
        for s in self.robot.ik(self.robot._pose("pose", pose)):
            number = boxes.class_of(s.mode, s.det_a) if mode in (None, s.mode) and not s.serial_legs else None
            aspect = None if number is None else boxes.aspect_at(s.pose.tolist(), number)
            if aspect is not None:
                found.append(aspects[aspect])
        return found

    def cells(self, mode: str, det_a: Literal["+", "-", 1, -1]) -> tuple[Array, Array, NDArray[np.int64]]:
        """Return the cells of a class: lower and upper corners (n, k) in the k coordinates that vary, and the aspect of each.

        A cell of aspect 0 is undecided; the others certainly lie in theirs.
        """
        boxes = self._boxes()
        number = boxes.class_of(self.robot._known(mode), -1.0 if _input.sign(det_a) == "-" else 1.0)
        if number is None:
            raise _native.Error(f"mode {mode} was not analysed")
        lo, hi, aspect = boxes.cells(number)
        free = len(boxes.axes)
        low, high = (np.array(c, dtype=float).reshape(-1, 3)[:, :free] for c in (lo, hi))
        return low, high, np.array(aspect, dtype=np.int64)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        mode: str | None = None,
        space: Literal["pose", "joint"] = "pose",
        at: Mapping[str, float] | None = None,
    ) -> Axes:
        """Draw the aspects, a colour each: in the workspace (W-aspects, certified cells), or their images in joint space
        (Q-aspects, numerical). Aspects of several modes lie on one another, and their colours mix: ``mode`` draws those of
        one. ``at`` names the coordinate to cut at where three vary, such as ``at={"phi": 0}``.
        """
        from aspecta._plot import aspects

        mode = None if mode is None else self.robot._known(mode)
        if space not in ("pose", "joint"):
            raise _native.Error(f'space = {space!r}: give "pose" or "joint"')
        names, ranges = self.robot.pose_names, self._data["window"]["ranges"]
        held = {one["coordinate"]: one["value"] for one in self._data["fixed"]}
        bounds = {names[k]: ranges[k] for k in self._boxes().axes}
        return aspects(self, ax, mode, space, _input.cut(at, bounds, held))

    def report(self, directory: str | PathLike[str]) -> Path:
        """Write the report with its figures into a directory; return the path of ``report.html``.

        Raises:
            Error: files cannot be written there.
        """
        return Path(self._boxes().report(fspath(directory))[0])

    @property
    def certificate(self) -> certificates.Certificate | None:
        """The proof of the count, if :meth:`Robot.analyze` was asked to keep it."""
        text = self._boxes().certificate()
        return None if text is None else certificates.Certificate(text)

    def domains(
        self,
        aspects: Sequence[int | Aspect] | NDArray[np.integer[Any]] | int | Aspect | None = None,
        *,
        mode: str | None = None,
        det_a: Literal["+", "-", 1, -1] | None = None,
        cells: int | None = None,
        samples: int | None = None,
        surfaces: bool | None = None,
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Map:
        """Cut aspects (default: all) into basic regions and uniqueness domains (Def. 10, Theorem 3).

        ``aspects`` are aspects or their numbers, of which ``mode`` and ``det_a`` choose some.
        ``cells`` is the number of cells across the workspace, ``samples`` of random poses at which the result is compared
        with the direct model. ``surfaces`` says whether the surfaces that bound aspects and regions are found too, which
        :meth:`Map.draw` and :meth:`Domains.surfaces` need; left out, they are where two coordinates vary, and it takes no time.
        After ``seconds`` the map is of the aspects that are done. Numerical, true to a cell. Ctrl-C raises
        ``KeyboardInterrupt``, whose ``partial()`` returns a map of what was done.
        """
        wanted, sign = _input.aspects(aspects), _input.sign(det_a)
        mode = None if mode is None else self.robot._known(mode)
        chosen = [
            a.id
            for a in self.aspects
            if (wanted is None or a.id in wanted) and mode in (None, a.mode) and sign in (None, a.det_a)
        ]
        missing = set(wanted or ()) - {a.id for a in self.aspects}
        if missing:
            raise _native.Error(f"there is no aspect {min(missing)}: {len(self.aspects)} were found, numbered from 1")
        if wanted and not chosen:
            raise _native.Error(
                f"aspects {', '.join(map(str, wanted))}: none of them is of the mode and the sign of det A asked for"
            )
        boxes = self._boxes()
        effort = (_input.whole("cells", cells, 2, 2000), _input.whole("samples", samples, 0, _MOST_SAMPLES))
        limit = _input.positive("seconds", seconds)
        return kept(lambda: boxes.domains(chosen, *effort, surfaces, limit, reporter(progress)), Map)

    def modes(self, *, seconds: float | None = None, progress: Progress = None) -> ModeGraph:
        """Return which aspects are joined by legs that change their postures; what was found after ``seconds``, or at Ctrl-C
        by ``partial()``.
        """
        boxes, limit = self._boxes(), _input.positive("seconds", seconds)
        return kept(lambda: boxes.modes(limit, reporter(progress)), lambda found: ModeGraph(found[0], "", found[1]))

    @all_or_nothing
    def assembly(self, q: ArrayLike) -> AssemblyModes:
        """Return the direct solutions of a joint vector q (dof,), by aspect."""
        return AssemblyModes(self._boxes().assembly(self.robot._joints("q", q)))

    @all_or_nothing
    def traverse(
        self,
        *,
        box: Ranges | None = None,
        disc: Ranges | None = None,
        ball: Ranges | None = None,
        radius: float | None = None,
        poses: ArrayLike | None = None,
        paths: ArrayLike | Sequence[ArrayLike] | None = None,
        mode: str | None = None,
        det_a: Literal["+", "-", 1, -1] | None = None,
        through_modes: bool = False,
        progress: Progress = None,
    ) -> Traversability:
        """Return which aspects hold a whole set of poses. Give one of:

        ``box``: a range (low, high), or a value, per coordinate, in their order or by name, such as ``{"x": (2, 6), "y": 9}``.
        ``disc`` or ``ball``: likewise, x and y (and z) being those of the centre, within ``radius`` of which the poses lie; with
        a range of z a disc is a cylinder.
        ``poses``: separate poses (n, dof), to be visited in any order. ``paths``: polylines, each (n, dof), or one alone.

        ``mode`` and ``det_a`` choose the classes that are asked about.
        """
        sets = {"box": box, "disc": disc, "ball": ball, "poses": poses, "paths": paths}
        asked, sign = pose_set(self.robot, sets, radius), _input.sign(det_a)
        known = None if mode is None else self.robot._known(mode)
        found = self._boxes().traverse(*asked, through_modes, reporter(progress))
        answer = Traversability(found)
        answer.classes[:] = [c for c in answer.classes if known in (None, c["mode"]) and sign in (None, c["det_a"])]
        return answer

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
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Plan:
        """Plan a motion between two poses (dof,), proved free of singularities and within limits.

        ``mode`` is the working mode at the start, ``to_mode`` that at the end if legs are to change their postures on the way;
        ``through_modes`` lets them do so though it is the same. ``weight`` says how much nearness to singularities counts (0:
        the shortest path), ``avoid`` the margins to keep: the least ``|det Â|`` and the least ``|B_jj| / max |B_jj|``, or a
        number for both. After ``seconds`` no more changes of posture are looked for.

        Raises:
            NoPlan: there is none (``proved`` is true), or none was found.
            Error: a pose is not one of the robot in that mode.
        """
        ends = [self.robot._pose("start", start), self.robot._pose("goal", goal)]
        wanted = _input.wishes(weight, avoid)
        modes = [self.robot._known(mode), self.robot._known(to_mode or mode)]
        limit = _input.positive("seconds", seconds)
        found = self._boxes().plan(ends, modes, through_modes, wanted, limit, reporter(progress))
        return Plan(*found, self.robot.pose_names)

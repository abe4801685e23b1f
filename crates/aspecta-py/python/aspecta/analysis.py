"""Analyses: the working modes and generalized aspects of a robot, and what is asked of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native, certificates
from aspecta._progress import Progress, kept, reporter
from aspecta._result import Result
from aspecta._table import Frame, to_html
from aspecta.maps import Map
from aspecta.results import AssemblyModes, ModeGraph, Plan, Traversability

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from aspecta.robot import Robot

Array = NDArray[np.float64]
Range = tuple[float, float]
#: A value or a range (low, high) per coordinate.
Ranges = Sequence[float | Sequence[float]] | NDArray[np.float64]


@dataclass(frozen=True)
class Aspect:
    """A generalized aspect (Def. 8), as far as it is proved."""

    #: Its number within the analysis, from 1.
    id: int
    #: The working mode.
    mode: str
    #: The sign of det A: ``"+"`` or ``"-"``.
    det_a: str
    #: Certified inner measure: area, volume or what else :attr:`Analysis.measure` says.
    measure: float
    #: In how many certified connected pieces its cells fall; 1 if all are proved connected.
    pieces: int
    #: A pose inside, (dof,).
    pose: tuple[float, ...]
    #: Its joint vector, (dof,).
    q: tuple[float, ...]
    #: Bounds of the W-aspect, per pose coordinate.
    w_bounds: tuple[Range, ...]
    #: Bounds of the Q-aspect, per joint coordinate.
    q_bounds: tuple[Range, ...]


def _bounds(count: Mapping[str, Any]) -> str:
    """Bounds on a number in words."""
    low, high = count["low"], count["high"]
    return f"exactly {low}" if low == high else f"at least {low}" if high is None else f"{low} to {high}"


class Analysis(Result, Frame):
    """The working modes and generalized aspects of a robot, or of a slice of it. Made by :meth:`Robot.analyze`.

    Printed it is Tables 1 and 2 of the paper; bounds on the number of aspects are certified.
    """

    __slots__ = ("_paving", "robot")

    #: The robot.
    robot: Robot
    _paving: _native.Analysis | None

    def __init__(self, robot: Robot, native: _native.Analysis | None, data: Any = None, text: str = "") -> None:
        super().__init__(
            native.json() if native is not None else data, native.text(False) if native is not None else text
        )
        self.robot = robot
        self._paving = native

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.robot, None, self._data, self._text)

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

    #: Table 2: a class per working mode and sign of det A.
    classes: list[dict[str, Any]]
    #: What keeps the bounds apart, if they are.
    doubts: list[dict[str, Any]]
    #: The quantity measured, and its unit.
    measure: dict[str, Any]

    @property
    def working_modes(self) -> list[dict[str, Any]]:
        """Table 1: the working modes, and whether they are reachable."""
        return list(self._data["modes"])

    def summary(self, *, degrees: bool = False) -> str:
        """Return the tables of the terminal, angles in radians or in degrees."""
        return self._boxes().text(degrees) if degrees else str(self)

    def _repr_html_(self) -> str:
        picture = None if self._paving is None else self._paving.picture()
        measure = f"{self.measure['name']} [{self.measure['unit']}]"
        rows = [[c["mode"], c["det_a"], _bounds(c), c["measure"], c["undecided"]] for c in self.classes]
        heads = ["mode", "det A", "aspects", f"certified {measure}", "undecided"]
        count = f"number of generalized aspects, certified: {_bounds(self._data['aspects'])}"
        return f"{to_html(count, heads, rows)}{picture or ''}"

    def _columns(self) -> dict[str, Any]:
        """An aspect a line."""
        found = self.aspects
        columns: dict[str, Any] = {
            name: [getattr(aspect, name) for aspect in found] for name in ("id", "mode", "det_a", "measure", "pieces")
        }
        for letter, point in (("x", "pose"), ("q", "q")):
            columns |= {f"{letter}{k + 1}": [getattr(a, point)[k] for a in found] for k in range(self.robot.dof)}
        return columns

    def at(self, pose: ArrayLike, *, mode: str | None = None) -> list[Aspect]:
        """Return the aspects in which a pose (dof,) lies, one for each working mode in which it does (certified).

        A pose nearer to a border than cells tell is in none here; finer boxes may tell.
        """
        boxes, found = self._boxes(), []
        mode = None if mode is None else self.robot._known(mode)
        aspects = {a.id: a for a in self.aspects}
        for s in self.robot.ik(pose):
            number = boxes.class_of(s.mode, s.det_a) if mode in (None, s.mode) and not s.serial_legs else None
            aspect = None if number is None else boxes.aspect_at(s.pose.tolist(), number)
            if aspect is not None:
                found.append(aspects[aspect])
        return found

    def cells(self, mode: str, det_a: Literal["+", "-"] | int) -> tuple[Array, Array, NDArray[np.int64]]:
        """Return the cells of a class: lower and upper corners (n, k) in the k coordinates that vary, and the aspect of each.

        A cell of aspect 0 is undecided; the others certainly lie in theirs.
        """
        boxes = self._boxes()
        number = boxes.class_of(self.robot._known(mode), -1.0 if det_a in ("-", -1) else 1.0)
        if number is None:
            raise _native.Error(f"mode {mode} was not analysed")
        lo, hi, aspect = boxes.cells(number)
        free = len(boxes.axes)
        corners = (np.array(c, dtype=float).reshape(-1, 3)[:, :free] for c in (lo, hi))
        low, high = corners
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
        (Q-aspects, numerical). ``at`` names the coordinate to cut at where three vary, such as ``at={"phi": 0}``.
        """
        from aspecta._plot import aspects

        mode = None if mode is None else self.robot._known(mode)
        return aspects(self, ax, mode, space, at or {})

    def report(self, directory: str | PathLike[str]) -> Path:
        """Write the report with its figures into a directory; return the path of ``report.html``."""
        return Path(self._boxes().report(fspath(directory))[0])

    @property
    def certificate(self) -> certificates.Certificate | None:
        """The proof of the count, if :meth:`Robot.analyze` was asked to keep it."""
        text = self._boxes().certificate()
        return None if text is None else certificates.Certificate(text)

    def domains(
        self,
        aspects: Sequence[int] | int | None = None,
        *,
        mode: str | None = None,
        det_a: Literal["+", "-"] | None = None,
        cells: int | None = None,
        samples: int | None = None,
        surfaces: bool | None = None,
        seconds: float | None = None,
        progress: Progress = None,
    ) -> Map:
        """Cut aspects (default: all) into basic regions and uniqueness domains (Def. 10, Theorem 3).

        ``cells`` is the number of cells across the workspace, ``samples`` of random poses at which the result is compared
        with the direct model. ``surfaces`` says whether the surfaces that bound aspects and regions are found too, which
        :meth:`Map.draw` and :meth:`Domains.surfaces` need; left out, they are where two coordinates vary, and it takes no time.
        After ``seconds`` the map is of the aspects that are done. Numerical, true to a cell. Ctrl-C raises
        ``KeyboardInterrupt``, whose ``partial()`` returns a map of what was done.
        """
        wanted = [aspects] if isinstance(aspects, int) else aspects
        mode = None if mode is None else self.robot._known(mode)
        chosen = [
            a.id
            for a in self.aspects
            if (wanted is None or a.id in wanted) and mode in (None, a.mode) and det_a in (None, a.det_a)
        ]
        missing = set(wanted or ()) - {a.id for a in self.aspects}
        if missing:
            raise _native.Error(f"there is no aspect {min(missing)}: {len(self.aspects)} were found, numbered from 1")
        boxes = self._boxes()
        _input.whole("cells", cells, 2, 2000)
        _input.whole("samples", samples, 0)
        _input.positive("seconds", seconds)
        return kept(lambda: boxes.domains(chosen, cells, samples, surfaces, seconds, reporter(progress)), Map)

    def modes(self, *, seconds: float | None = None, progress: Progress = None) -> ModeGraph:
        """Return which aspects are joined by legs that change their postures; what was found after ``seconds``."""
        data, svg = self._boxes().modes(_input.positive("seconds", seconds), reporter(progress))
        return ModeGraph(data, "", svg)

    def assembly(self, q: ArrayLike) -> AssemblyModes:
        """Return the direct solutions of a joint vector q (dof,), by aspect."""
        return AssemblyModes(self._boxes().assembly(_input.vector(q)))

    def traverse(
        self,
        *,
        box: Ranges | None = None,
        disc: Ranges | None = None,
        ball: Ranges | None = None,
        radius: float | None = None,
        poses: ArrayLike | None = None,
        paths: Sequence[ArrayLike] | None = None,
        mode: str | None = None,
        det_a: Literal["+", "-"] | None = None,
        through_modes: bool = False,
        progress: Progress = None,
    ) -> Traversability:
        """Return which aspects hold a whole set of poses. Give one of:

        ``box``: a range (low, high), or a value, per coordinate.
        ``disc`` or ``ball``: likewise, x and y (and z) being those of the centre, within ``radius`` of which the poses lie; with
        a range of z a disc is a cylinder.
        ``poses``: separate poses (n, dof), to be visited in any order. ``paths``: polylines, each (n, dof).

        ``mode`` and ``det_a`` choose the classes that are asked about.
        """
        sets = {"box": box, "disc": disc, "ball": ball, "poses": poses, "paths": paths}
        given = [name for name, value in sets.items() if value is not None]
        if len(given) != 1:
            raise _native.Error(f"give one of box, disc, ball, poses and paths, not {' and '.join(given) or 'none'}")
        kind, value = given[0], sets[given[0]]
        if (kind in ("disc", "ball")) != (radius is not None):
            raise _native.Error("radius is that of a disc or of a ball: give both, or neither")
        _input.positive("radius", radius)
        names = self.robot.pose_names
        round_in = {"disc": ["x", "y"], "ball": ["x", "y", "z"]}.get(kind, [])
        if not set(round_in) <= set(names):
            raise _native.Error(f"a pose of `{self.robot.name}` has no {', '.join(round_in)}: give a box")
        round_axes = [names.index(name) for name in round_in]
        ranges = _input.ranges(kind, value, names) if kind in ("box", "disc", "ball") else []
        for k in round_axes:
            if ranges[k][0] != ranges[k][1]:
                raise _native.Error(f"{kind}: give one value of {names[k]}, that of the centre")
        lists = [_input.rows(path) for path in paths or ()]
        if poses is not None:
            lists = [_input.rows(poses)]
        name = "round" if round_in else kind
        found = self._boxes().traverse(
            name, ranges, round_axes, radius or 0.0, lists, through_modes, reporter(progress)
        )
        answer = Traversability(found)
        known = None if mode is None else self.robot._known(mode)
        answer.classes[:] = [c for c in answer.classes if known in (None, c["mode"]) and det_a in (None, c["det_a"])]
        return answer

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
        progress: Progress = None,
    ) -> Plan:
        """Plan a motion between two poses (dof,), proved free of singularities and within limits.

        ``mode`` is the working mode at the start, ``to_mode`` that at the end if legs are to change their postures on the way;
        ``through_modes`` lets them do so though it is the same. ``weight`` says how much nearness to singularities counts (0:
        the shortest path), ``avoid`` the margins to keep: the least ``|det Â|`` and the least ``|B_jj| / max |B_jj|``.

        Raises:
            NoPlan: there is none (``proved`` is true), or none was found.
            Error: a pose is not one of the robot in that mode.
        """
        ends = [_input.vector(end) for end in (start, goal)]
        wanted = _input.wishes(weight, avoid)
        modes = [self.robot._known(mode), self.robot._known(to_mode or mode)]
        return Plan(*self._boxes().plan(ends, modes, through_modes, wanted, reporter(progress)))

"""Answers about configurations, paths, motions and sets of poses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from aspecta import _input, _native
from aspecta._result import Result
from aspecta._table import Frame

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
#: Modes, poses and joint vectors along a smooth piece of a motion.
Piece = tuple[list[str], list[list[float]], list[list[float]]]


class State(Result):
    """A configuration with its Jacobians, and how far it is from singularities (Definitions 3 and 4). Numerical."""

    #: The working mode; ``None`` at a serial singularity.
    mode: str | None
    #: det A.
    det_a: float
    #: B_jj, leg by leg.
    b: list[float]
    #: The kind: ``"regular"``, ``"parallel"``, ``"serial"`` or ``"both"``.
    singularity: str
    #: Smallest singular value of the homogeneous A, in [0, 1].
    parallel_measure: float
    #: ``|B_jj| / max |B_jj|``, leg by leg.
    serial_measures: list[float]
    #: Whether joints are within their limits, and the pose in the window.
    within_limits: bool

    def __str__(self) -> str:
        d = self._data
        lines = [
            f"mode          {d['mode'] or 'none: at a serial singularity'}",
            f"singularity   {d['singularity']}",
            f"det A         {d['det_a']:.6g}",
            f"B             {', '.join(f'{b:.6g}' for b in d['b'])}",
            f"parallel      {d['parallel_measure']:.4g} from 0 to 1",
            f"serial        {', '.join(f'{m:.4g}' for m in d['serial_measures'])} from 0 to 1",
            f"limits        {'within' if d['within_limits'] else 'beyond'}",
            f"residual      {d['residual']:.2g}",
        ]
        return "\n".join(lines)

    __repr__ = __str__

    @property
    def a(self) -> Array:
        """A = ∂f/∂X, (dof, dof): a row a leg."""
        return np.array(self._data["a"])


class PathCheck(Result):
    """Whether a path meets a singularity, leaves limits, or comes too near (certified where ``True`` or ``False``)."""

    #: Whether the path meets no singularity; ``None`` if undecided.
    singularity_free: bool | None
    #: Whether it keeps joint limits and the window; ``None`` if undecided.
    within_limits: bool | None
    #: Whether it keeps the margins asked for; ``None`` if undecided.
    keeps_margins: bool | None
    #: Where the first demand fails, if one does.
    obstacle: dict[str, Any] | None
    #: The working mode.
    mode: str
    #: Samples with their determinants (figure 11).
    profile: list[dict[str, Any]]

    @property
    def sound(self) -> bool:
        """Whether all that was asked for is proved."""
        return self.singularity_free is True and self.within_limits is True and self.keeps_margins is True

    @property
    def pieces(self) -> list[Piece]:
        """The path as :meth:`time` drives it: from rest to rest on each straight segment, or all of a spline."""
        groups: dict[int, list[dict[str, Any]]] = {}
        for point in self.profile:
            key = 0 if self._data.get("joined") == "spline" else point["segment"]
            groups.setdefault(key, []).append(point)
        return [([p["mode"] for p in g], [p["pose"] for p in g], [p["q"] for p in g]) for g in groups.values()]

    def time(
        self, speed: float | Sequence[float], acceleration: float | Sequence[float], *, rate: float = 100.0
    ) -> Motion:
        """Return the fastest motion through the path under joint limits; see :class:`Motion`.

        Raises:
            Error: the path is not proved to be sound, or a limit is not positive.
        """
        if not self.sound:
            raise _native.Error("the path is not proved to be sound: print the check to see why")
        return timed(self.pieces, speed, acceleration, rate)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw det A and the B_jj along the path, each divided by its largest modulus (figure 11)."""
        from aspecta._plot import profile

        return profile(self, ax)


class Motion(Result, Frame):
    """A motion in time: the fastest through a path under limits of joint speed and acceleration. Numerical."""

    #: Seconds from start to end.
    total_time: float
    #: How far each joint strays from the path between its samples, an estimate.
    path_error: list[float]
    #: Which limits bind, and for which share of the time.
    bindings: list[dict[str, Any]]

    def _column(self, name: str) -> Array:
        return np.array([row[name] for row in self._data["rows"]])

    @property
    def time(self) -> Array:
        """(n,): seconds from the start."""
        return self._column("time")

    @property
    def pose(self) -> Array:
        """(n, dof): X."""
        return self._column("pose")

    @property
    def q(self) -> Array:
        """(n, dof): q."""
        return self._column("q")

    @property
    def velocity(self) -> Array:
        """(n, dof): dq/dt, a second."""
        return self._column("velocity")

    @property
    def acceleration(self) -> Array:
        """(n, dof): d²q/dt², a second squared; it may jump."""
        return self._column("acceleration")

    def __str__(self) -> str:
        return f"a motion of {self.total_time:.6g} s in {len(self._data['rows'])} rows"

    __repr__ = __str__

    def _columns(self) -> dict[str, Any]:
        """A row a sample."""
        dof = self.pose.shape[1]
        parts = (("x", self.pose), ("q", self.q), ("v", self.velocity), ("a", self.acceleration))
        columns = {f"{name}{k + 1}": values[:, k] for name, values in parts for k in range(dof)}
        return {"time": self.time, **columns}


def timed(
    pieces: list[Piece], speed: float | Sequence[float], acceleration: float | Sequence[float], rate: float
) -> Motion:
    """Return the fastest motion through some pieces."""
    dof = len(pieces[0][2][0]) if pieces and pieces[0][2] else 1

    def each(limit: float | Sequence[float]) -> list[float]:
        return _input.vector(limit) if np.ndim(limit) else [float(limit)] * dof  # type: ignore[arg-type]

    return Motion(_native.trajectory(pieces, each(speed), each(acceleration), float(rate)))


class Plan(Result):
    """A motion between two configurations, proved free of singularities and within limits.

    Within a working mode it is one stretch of straight segments; through changes of mode there are several, with
    crossings of serial singularities between them.
    """

    __slots__ = ("pieces",)

    #: The motions within one mode: ``mode``, ``det_a``, ``aspect``, ``waypoints``, ``length``, ``margins``.
    stretches: list[dict[str, Any]]
    #: The changes of mode between them.
    crossings: list[dict[str, Any]]
    #: Whether it was proved once more after it was planned.
    proved: bool
    #: The motion as :meth:`time` drives it.
    pieces: list[Piece]

    def __init__(self, data: str | dict[str, Any], text: str = "", pieces: list[Piece] | None = None) -> None:
        super().__init__(data, text)
        self.pieces = pieces or []

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self.pieces)

    @property
    def waypoints(self) -> Array:
        """(n, dof): the poses it goes through; angles go on past ±π."""
        return np.array([pose for stretch in self.stretches for pose in stretch["waypoints"]])

    @property
    def length(self) -> float:
        """Its length: translations, and angles times the robot's characteristic length."""
        return float(sum(stretch["length"] for stretch in self.stretches))

    def time(
        self, speed: float | Sequence[float], acceleration: float | Sequence[float], *, rate: float = 100.0
    ) -> Motion:
        """Return the fastest motion through the plan under joint limits; see :class:`Motion`."""
        return timed(self.pieces, speed, acceleration, rate)


class AssemblyModes(Result):
    """The direct solutions of a joint vector, by aspect."""

    #: Whether the solutions are proved to be all.
    complete: bool
    #: Each with ``number``, ``aspect`` and the solution's parts.
    solutions: list[dict[str, Any]]
    #: Which solutions lie in one aspect, and whether that is certified.
    shared: list[dict[str, Any]]

    def __str__(self) -> str:
        lines = [f"{len(self.solutions)} direct solutions{', all of them' if self.complete else ', perhaps not all'}"]
        for s in self.solutions:
            pose = ", ".join(f"{x:.6g}" for x in s["pose"])
            lines.append(f"  {s['number']}  {s['mode']}  aspect {s['aspect'] or 'unknown'}  ({pose})")
        for shared in self.shared:
            names = ", ".join(map(str, shared["solutions"]))
            sure = "certified" if shared["certified"] else "as far as is known"
            lines.append(f"solutions {names} lie in one aspect ({sure})")
        return "\n".join(lines)

    __repr__ = __str__


class JoinedSolutions(Result):
    """The direct solutions of a joint vector of a free body, and which of them proved motions join."""

    #: Whether the solutions are proved to be all.
    complete: bool
    #: Each with ``number`` and the solution's parts.
    solutions: list[dict[str, Any]]
    #: Class by class: ``mode``, ``det_a``, and ``joined``, groups of solutions that lie in one aspect (certified).
    classes: list[dict[str, Any]]

    def __str__(self) -> str:
        lines = [f"{len(self.solutions)} direct solutions{', all of them' if self.complete else ', perhaps not all'}"]
        for c in self.classes:
            groups = "; ".join(", ".join(map(str, group)) for group in c["joined"])
            lines.append(f"  {c['mode']}  det A {c['det_a']}  joined by proved motions: {groups or 'none'}")
        return "\n".join(lines)

    __repr__ = __str__


class ModeGraph(Result):
    """Which aspects are joined by legs that change their postures, each crossing proved."""

    __slots__ = ("_svg",)

    #: The crossings found, each proved.
    crossings: list[dict[str, Any]]
    #: Aspects that can be reached from one another.
    groups: list[list[int]]
    #: The aspects.
    aspects: list[dict[str, Any]]

    def __init__(self, data: str | dict[str, Any], text: str = "", svg: str = "") -> None:
        super().__init__(data, text)
        self._svg = svg

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self._svg)

    def __str__(self) -> str:
        groups = "; ".join(", ".join(map(str, group)) for group in self.groups)
        return f"{len(self.aspects)} aspects, {len(self.crossings)} crossings, each proved; joined: {groups or 'none'}"

    __repr__ = __str__

    def _repr_svg_(self) -> str:
        return self._svg


class Traversability(Result):
    """Which aspects hold a whole set of poses (certified where it is not undecided)."""

    #: Class by class: ``mode``, ``det_a``, ``answer`` (``"whole"``, ``"not-whole"`` or ``"undecided"``), ``aspect``.
    classes: list[dict[str, Any]]
    #: With ``through_modes``: the groups of aspects through which every pose can be reached.
    groups: list[dict[str, Any]]

    @property
    def holds(self) -> bool | None:
        """Whether some class holds all of the set; ``None`` if that is undecided."""
        answers = {c["answer"] for c in self.classes}
        return True if "whole" in answers else None if "undecided" in answers else False

    def __str__(self) -> str:
        def line(c: dict[str, Any]) -> str:
            aspect = f", aspect {c['aspect']}" if c.get("aspect") else ""
            return f"  {c['mode']}  det A {c['det_a']}  {c['answer']}{aspect}"

        heading = {True: "some aspect holds the set", False: "no aspect holds the set", None: "undecided"}[self.holds]
        return "\n".join([heading, *map(line, self.classes)])

    __repr__ = __str__


class Cusps(Result):
    """Where three direct solutions meet: of a slice, proved; or the curves they form, followed numerically.

    Of a slice ``cusps``, ``complete`` and ``undecided``; of a whole robot ``curves``, ``slices`` and ``stopped``.
    """

    def __str__(self) -> str:
        if "curves" in self._data:
            ended = ", stopped before the end" if self.stopped else ""
            return f"{len(self.curves)} curves of cusps, of {len(self.slices)} slices{ended}"
        lines = [f"{len(self.cusps)} cusps{', proved to be all' if self.complete else ', perhaps not all'}"]
        for c in self.cusps:
            pose, q = (", ".join(f"{x:.6g}" for x in c[name]) for name in ("pose", "q"))
            lines.append(f"  {c['mode']}  pose ({pose})  q ({q}){'' if c['within_limits'] else '  beyond limits'}")
        return "\n".join(lines)

    __repr__ = __str__


class Exploration(Result):
    """What a roadmap has seen of the classes of a robot with six coordinates."""

    #: Certified: so many aspects there are at least.
    at_least: int
    #: Class by class: ``mode``, ``det_a``, ``samples``, ``components``, ``end``.
    classes: list[dict[str, Any]]

    def __str__(self) -> str:
        return f"at least {self.at_least} aspects (certified), in {len(self.classes)} classes"

    __repr__ = __str__


class Verdict(Result):
    """What a certificate claims, and whether it is right."""

    __slots__ = ("verified",)

    #: Whether all that it claims is verified.
    verified: bool

    def __init__(self, data: str | dict[str, Any], text: str = "", verified: bool = False) -> None:
        super().__init__(data, text)
        self.verified = verified

    def __bool__(self) -> bool:
        return self.verified

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self.verified)

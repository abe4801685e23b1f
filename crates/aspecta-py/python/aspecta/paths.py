"""Paths, plans and motions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from aspecta import _input, _native
from aspecta._result import Result, undecided
from aspecta._table import Frame, columns, counted, joint_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
#: Modes, poses and joint vectors along a smooth piece of a motion.
Piece = tuple[list[str], list[list[float]], list[list[float]]]


class PathCheck(Result):
    """Whether a path meets a singularity, leaves limits, or comes too near (certified where ``True`` or ``False``).

    Attributes:
        singularity_free: whether the path meets no singularity; ``None`` if undecided.
        within_limits: whether it keeps joint limits and the window; ``None`` if undecided.
        keeps_margins: whether it keeps the margins asked for; ``None`` if undecided.
        obstacle: where the first demand fails, if one does.
        mode: the working mode.
        profile: samples with their determinants (figure 11).
    """

    __slots__ = ("_names",)

    singularity_free: bool | None
    within_limits: bool | None
    keeps_margins: bool | None
    obstacle: dict[str, Any] | None
    mode: str
    profile: list[dict[str, Any]]

    def __init__(self, data: str | dict[str, Any], text: str, names: Sequence[str]) -> None:
        super().__init__(data, text)
        self._names = names

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self._names)

    def __bool__(self) -> bool:
        raise undecided(self, "sound")

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
        return _timed(self.pieces, speed, acceleration, rate, self._names)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw det A and the B_jj along the path, each divided by its largest modulus (figure 11)."""
        from aspecta._plot import profile

        return profile(self, ax)


class Motion(Result, Frame):
    """A motion in time: the fastest through a path under limits of joint speed and acceleration. Numerical.

    Attributes:
        total_time: seconds from start to end.
        path_error: how far each joint strays from the path between its samples, an estimate.
        bindings: which limits bind, and for which share of the time.
    """

    __slots__ = ("_names",)

    total_time: float
    path_error: list[float]
    bindings: list[dict[str, Any]]

    def __init__(self, data: str | dict[str, Any], names: Sequence[str]) -> None:
        super().__init__(data)
        self._names = names

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._names)

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
        return f"a motion of {self.total_time:.6g} s in {counted(len(self._data['rows']), 'row')}"

    __repr__ = __str__

    def _columns(self) -> dict[str, Any]:
        """A row a sample."""
        joints = joint_names(self._names)
        derivatives = {"v": self.velocity, "a": self.acceleration}
        return {
            "time": self.time,
            **columns(self._names, self.pose),
            **columns(joints, self.q),
            **{f"{letter}{k + 1}": values[:, k] for letter, values in derivatives.items() for k in range(len(joints))},
        }


def _timed(
    pieces: list[Piece],
    speed: float | Sequence[float],
    acceleration: float | Sequence[float],
    rate: float,
    names: Sequence[str],
) -> Motion:
    """Return the fastest motion through some pieces."""

    def each(name: str, limit: float | Sequence[float]) -> list[float]:
        given = _input.numbers(name, limit)
        return (given.ravel() if given.ndim else np.full(len(names), given)).tolist()

    limits = each("speed", speed), each("acceleration", acceleration)
    return Motion(_native.trajectory(pieces, *limits, _input.number("rate", rate)), names)


class Plan(Result):
    """A motion between two configurations, proved free of singularities and within limits.

    Within a working mode it is one stretch of straight segments; through changes of mode there are several, with
    crossings of serial singularities between them.

    Attributes:
        stretches: the motions within one mode: ``mode``, ``det_a``, ``aspect``, ``waypoints``, ``length``,
            ``margins``.
        crossings: the changes of mode between them.
        proved: whether it was proved once more after it was planned.
        pieces: the motion as :meth:`time` drives it.
    """

    __slots__ = ("_names", "pieces")

    stretches: list[dict[str, Any]]
    crossings: list[dict[str, Any]]
    proved: bool
    pieces: list[Piece]

    def __init__(self, data: str | dict[str, Any], text: str, pieces: list[Piece], names: Sequence[str]) -> None:
        super().__init__(data, text)
        self.pieces = pieces
        self._names = names

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self.pieces, self._names)

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
        return _timed(self.pieces, speed, acceleration, rate, self._names)

"""Solutions of the inverse and of the direct problem: one by one, and as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from aspecta._table import Frame, columns, counted, joint_names, listed, to_html

if TYPE_CHECKING:
    from aspecta._description import Description

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(slots=True, eq=False)
class Solution:
    """A configuration (X, q): a pose and a joint vector that belong together.

    Attributes:
        pose: X, (dof,): lengths in the robot's unit, angles in rad, in (-π, π].
        q: q, (dof,): angles in rad, within the range of their joint, or in (-π, π] if it has none.
        mode: the working mode: the signs of B_jj, such as ``"+-+"``.
        det_a: det A = det ∂f/∂X.
        residual: largest ``|f_i|`` relative to the leg's lengths squared.
        certified: whether existence and uniqueness near here are proved by intervals.
        within_limits: whether every joint is within its limits and the pose in the robot's window.
        serial_legs: legs, from 1, at a serial singularity: their signs in ``mode`` mean nothing.
    """

    pose: Array
    q: Array
    mode: str
    det_a: float
    residual: float
    certified: bool
    within_limits: bool
    serial_legs: tuple[int, ...]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Solution):
            return NotImplemented
        return all(np.array_equal(getattr(self, part.name), getattr(other, part.name)) for part in fields(self))

    __hash__ = None  # type: ignore[assignment]


class SolutionList(Sequence[Solution], Frame):
    """All solutions of one pose, or of one joint vector. It prints as a table.

    Attributes:
        complete: whether direct solutions are proved to be all; ``None`` of inverse ones, of which that is not
            proved.
    """

    __slots__ = ("_names", "_solutions", "complete")

    complete: bool | None

    def __init__(self, solutions: Sequence[Solution], complete: bool | None, names: Sequence[str]) -> None:
        self._solutions = tuple(solutions)
        self.complete = complete
        self._names = names

    def __len__(self) -> int:
        return len(self._solutions)

    @overload
    def __getitem__(self, index: int) -> Solution: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Solution]: ...
    def __getitem__(self, index: int | slice) -> Solution | Sequence[Solution]:
        return self._solutions[index]

    @property
    def _heading(self) -> str:
        return listed(self, "solution", self.complete)

    def __str__(self) -> str:
        return "\n".join([self._heading, *map(_line, self)])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        heads = ["mode", *self._names, *joint_names(self._names), "det A", "limits", "singularity"]
        rows = [
            [s.mode, *s.pose.tolist(), *s.q.tolist(), s.det_a, "within" if s.within_limits else "beyond", _serial(s)]
            for s in self
        ]
        return to_html(self._heading, heads, rows)

    def _columns(self) -> dict[str, Any]:
        """A solution a row."""
        dof = len(self._names)
        return {
            "mode": [s.mode for s in self],
            **columns(self._names, np.reshape([s.pose for s in self], (-1, dof))),
            **columns(joint_names(self._names), np.reshape([s.q for s in self], (-1, dof))),
            **{name: [getattr(s, name) for s in self] for name in ("det_a", "certified", "within_limits")},
        }

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._solutions, self.complete, self._names)


def _serial(solution: Solution) -> str:
    """Which legs are at a serial singularity, in words."""
    legs = solution.serial_legs
    return f"serial: leg{'s' if len(legs) > 1 else ''} {', '.join(map(str, legs))}" if legs else ""


def _line(solution: Solution) -> str:
    """A solution in a line of a table."""

    def numbers(values: Array) -> str:
        return " ".join(f"{x:11.6g}" for x in values)

    told = ["" if solution.within_limits else "beyond limits", _serial(solution)]
    return (
        f"  {solution.mode}  pose {numbers(solution.pose)}  q {numbers(solution.q)}  det A {solution.det_a:.4g}"
        f"{''.join(f'  {part}' for part in told if part)}"
    )


class Solutions(Sequence[SolutionList], Frame):
    """The solutions of many rows as arrays, one solution a line, in the order of the rows asked about.

    ``batch[i]`` are the solutions of row i; ``batch.q``, ``batch.pose`` … hold those of all rows, ``batch.row`` tells whose.

    Attributes:
        row: (k,): the row, from 0, of which this is a solution.
        pose: (k, dof): X.
        q: (k, dof): q.
        signs: (k, dof): signs of the working mode, leg by leg: -1 or 1.
        det_a: (k,): det A.
        residual: (k,): largest ``|f_i|`` relative to the leg's lengths squared.
        certified: (k,): whether existence and uniqueness are proved.
        within_limits: (k,): whether joints are within their limits and the pose in the window.
        serial: (k, dof): whether a leg is at a serial singularity.
        complete: (n,): of each row, whether its direct solutions are proved to be all; ``None`` of inverse solutions.
        rows: n, the rows asked about.
    """

    __slots__ = (
        "_robot",
        "_starts",
        "certified",
        "complete",
        "det_a",
        "pose",
        "q",
        "residual",
        "row",
        "rows",
        "serial",
        "signs",
        "within_limits",
    )

    row: NDArray[np.int64]
    pose: Array
    q: Array
    signs: NDArray[np.int8]
    det_a: Array
    residual: Array
    certified: Mask
    within_limits: Mask
    serial: Mask
    complete: Mask | None
    rows: int

    _robot: Description

    def __init__(self, arrays: dict[str, Any], robot: Description) -> None:
        for name, array in arrays.items():
            setattr(self, name, array)
        self._robot = robot
        self._starts = np.searchsorted(self.row, np.arange(self.rows + 1))

    def __len__(self) -> int:
        return self.rows

    @property
    def counts(self) -> NDArray[np.int64]:
        """(n,): how many solutions each row has."""
        return np.diff(self._starts)

    @property
    def modes(self) -> NDArray[np.str_]:
        """(k,): the working modes, such as ``"+-+"``."""
        letters = np.where(self.signs > 0, "+", "-")
        if letters.size == 0:
            return np.empty(len(letters), dtype="U1")
        return np.ascontiguousarray(letters).view(f"U{letters.shape[1]}").ravel()

    @overload
    def __getitem__(self, index: int) -> SolutionList: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[SolutionList]: ...
    def __getitem__(self, index: int | slice) -> SolutionList | Sequence[SolutionList]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"row {index} of {len(self)}")
        index %= len(self)
        found = [self._solution(k) for k in range(self._starts[index], self._starts[index + 1])]
        complete = None if self.complete is None else bool(self.complete[index])
        return SolutionList(found, complete, self._robot.pose_names)

    def _solution(self, k: int) -> Solution:
        return Solution(
            pose=self.pose[k],
            q=self.q[k],
            mode="".join("+" if sign > 0 else "-" for sign in self.signs[k]),
            det_a=float(self.det_a[k]),
            residual=float(self.residual[k]),
            certified=bool(self.certified[k]),
            within_limits=bool(self.within_limits[k]),
            serial_legs=tuple(int(j) + 1 for j in np.flatnonzero(self.serial[k])),
        )

    def __iter__(self) -> Iterator[SolutionList]:
        return (self[i] for i in range(len(self)))

    def only(self, kept: Mask) -> Solutions:
        """Return the solutions that a mask (k,) keeps. Rows stay as they are, some with fewer solutions."""
        arrays = {
            name: array if name in ("complete", "rows") else array[kept] for name, array in self._arrays().items()
        }
        return Solutions(arrays, self._robot)

    def in_mode(self, mode: str) -> Solutions:
        """Return the solutions in one working mode, such as ``"+-+"``, or the names of its postures.

        Raises:
            Error: the robot has no such mode.
        """
        wanted = np.array([1 if sign == "+" else -1 for sign in self._robot._known(mode)], dtype=np.int8)
        return self.only((self.signs == wanted).all(axis=1))

    def _columns(self) -> dict[str, Any]:
        """A solution a line."""
        robot = self._robot
        return {
            "row": self.row,
            "mode": self.modes,
            **columns(robot.pose_names, self.pose),
            **columns(robot.joint_names, self.q),
            "det_a": self.det_a,
            "certified": self.certified,
            "within_limits": self.within_limits,
        }

    def __str__(self) -> str:
        proved = "" if self.complete is None else f", proved to be all in {int(self.complete.sum())}"
        return f"{counted(len(self.row), 'solution')} of {counted(len(self), 'row')}{proved}"

    __repr__ = __str__

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._arrays(), self._robot)

    def _arrays(self) -> dict[str, Any]:
        """What holds the solutions, by name."""
        return {name: getattr(self, name) for name in self.__slots__ if not name.startswith("_")}

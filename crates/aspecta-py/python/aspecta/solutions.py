"""Solutions of the inverse and of the direct problem: one by one, and as arrays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from aspecta._table import Frame, to_html

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(slots=True, eq=False)
class Solution:
    """A configuration (X, q): a pose and a joint vector that belong together."""

    #: X, (dof,): lengths in the robot's unit, angles in rad, in (-π, π].
    pose: Array
    #: q, (dof,): angles in rad, within the range of their joint, or in (-π, π] if it has none.
    q: Array
    #: The working mode: the signs of B_jj, such as ``"+-+"``.
    mode: str
    #: det A = det ∂f/∂X.
    det_a: float
    #: Largest ``|f_i|`` relative to the leg's lengths squared.
    residual: float
    #: Whether existence and uniqueness near here are proved by intervals.
    certified: bool
    #: Whether every joint is within its limits and the pose in the robot's window.
    within_limits: bool
    #: Legs, from 1, at a serial singularity: their signs in ``mode`` mean nothing.
    serial_legs: tuple[int, ...]


#: What is said of a list of solutions.
_PROVED = {True: ", proved to be all", False: ", perhaps not all", None: ""}


class SolutionList(Sequence[Solution]):
    """All solutions of one pose, or of one joint vector. It prints as a table."""

    __slots__ = ("_solutions", "complete")

    #: Whether direct solutions are proved to be all; ``None`` of inverse ones, of which that is not proved.
    complete: bool | None

    def __init__(self, solutions: Sequence[Solution], complete: bool | None = None) -> None:
        self._solutions = tuple(solutions)
        self.complete = complete

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
        count = len(self)
        return f"{count} solution{'' if count == 1 else 's'}{_PROVED[self.complete]}"

    def __str__(self) -> str:
        return "\n".join([self._heading, *map(_line, self)])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        dof = len(self[0].q) if self else 0
        heads = ["mode", *(f"x{k + 1}" for k in range(dof)), *(f"q{k + 1}" for k in range(dof)), "det A", "limits"]
        rows = [
            [s.mode, *map(float, s.pose), *map(float, s.q), s.det_a, "within" if s.within_limits else "beyond"]
            for s in self
        ]
        return to_html(self._heading, heads, rows)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._solutions, self.complete)


def _line(solution: Solution) -> str:
    """A solution in a line of a table."""

    def numbers(values: Array) -> str:
        return " ".join(f"{x:11.6g}" for x in values)

    limits = "" if solution.within_limits else "  beyond limits"
    return (
        f"  {solution.mode}  pose {numbers(solution.pose)}  q {numbers(solution.q)}  det A {solution.det_a:.4g}{limits}"
    )


class Solutions(Sequence[SolutionList], Frame):
    """The solutions of many rows as arrays, one solution a line, in the order of the rows asked about.

    ``batch[i]`` are the solutions of row i; ``batch.q``, ``batch.pose`` … hold those of all rows, ``batch.row`` tells whose.
    """

    __slots__ = (
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

    #: (k,): the row, from 0, of which this is a solution.
    row: NDArray[np.int64]
    #: (k, dof): X.
    pose: Array
    #: (k, dof): q.
    q: Array
    #: (k, dof): signs of the working mode, leg by leg: -1 or 1.
    signs: NDArray[np.int8]
    #: (k,): det A.
    det_a: Array
    #: (k,): largest ``|f_i|`` relative to the leg's lengths squared.
    residual: Array
    #: (k,): whether existence and uniqueness are proved.
    certified: Mask
    #: (k,): whether joints are within their limits and the pose in the window.
    within_limits: Mask
    #: (k, dof): whether a leg is at a serial singularity.
    serial: Mask
    #: (n,): of each row, whether its direct solutions are proved to be all; ``None`` of inverse solutions.
    complete: Mask | None
    #: n, the rows asked about.
    rows: int

    def __init__(self, arrays: dict[str, Any]) -> None:
        for name, array in arrays.items():
            setattr(self, name, array)
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
        return SolutionList(found, None if self.complete is None else bool(self.complete[index]))

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
            name: getattr(self, name)[kept] for name in self.__slots__ if name not in ("_starts", "complete", "rows")
        }
        return Solutions({**arrays, "complete": self.complete, "rows": self.rows})

    def in_mode(self, mode: str) -> Solutions:
        """Return the solutions in one working mode, such as ``"+-+"``."""
        wanted = np.array([1 if sign == "+" else -1 for sign in mode], dtype=np.int8)
        return self.only((self.signs == wanted).all(axis=1))

    def _columns(self) -> dict[str, Any]:
        """A solution a line."""
        dof = self.pose.shape[1]
        columns: dict[str, Any] = {"row": self.row, "mode": self.modes}
        columns |= {f"x{k + 1}": self.pose[:, k] for k in range(dof)}
        columns |= {f"q{k + 1}": self.q[:, k] for k in range(dof)}
        return columns | {"det_a": self.det_a, "certified": self.certified, "within_limits": self.within_limits}

    def __str__(self) -> str:
        proved = "" if self.complete is None else f", proved to be all in {int(self.complete.sum())}"
        return f"{len(self.row)} solutions of {len(self)} rows{proved}"

    __repr__ = __str__

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), ({name: getattr(self, name) for name in self.__slots__ if name != "_starts"},)

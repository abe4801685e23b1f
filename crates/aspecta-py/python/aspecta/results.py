"""Answers about configurations and sets of poses."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from aspecta._result import Result, undecided
from aspecta._table import counted, listed

Array = NDArray[np.float64]


class State(Result):
    """A configuration with its Jacobians, and how far it is from singularities (Definitions 3 and 4). Numerical.

    Attributes:
        mode: the working mode; ``None`` at a serial singularity.
        det_a: det A.
        b: B_jj, leg by leg.
        singularity: the kind: ``"regular"``, ``"parallel"``, ``"serial"`` or ``"both"``.
        parallel_measure: smallest singular value of the homogeneous A, in [0, 1].
        serial_measures: ``|B_jj| / max |B_jj|``, leg by leg.
        within_limits: whether joints are within their limits, and the pose in the window.
        residual: largest ``|f_i|`` relative to the leg's lengths squared: of what belongs together, rounding alone.
    """

    mode: str | None
    det_a: float
    b: list[float]
    singularity: str
    parallel_measure: float
    serial_measures: list[float]
    within_limits: bool
    residual: float

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


def _direct(solutions: list[dict[str, Any]], complete: bool) -> str:
    """How many direct solutions there are, and whether these are all."""
    return f"{counted(len(solutions), 'direct solution')}{', all of them' if complete else ', perhaps not all'}"


class AssemblyModes(Result):
    """The direct solutions of a joint vector, by aspect.

    Attributes:
        complete: whether the solutions are proved to be all.
        solutions: each with ``number``, ``aspect`` and the solution's parts.
        shared: which solutions lie in one aspect, and whether that is certified.
    """

    complete: bool
    solutions: list[dict[str, Any]]
    shared: list[dict[str, Any]]

    def __str__(self) -> str:
        lines = [_direct(self.solutions, self.complete)]
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
    """The direct solutions of a joint vector of a free body, and which of them proved motions join.

    Attributes:
        complete: whether the solutions are proved to be all.
        solutions: each with ``number`` and the solution's parts.
        classes: class by class: ``mode``, ``det_a``, and ``joined``, groups of solutions that lie in one aspect
            (certified).
    """

    complete: bool
    solutions: list[dict[str, Any]]
    classes: list[dict[str, Any]]

    def __str__(self) -> str:
        lines = [_direct(self.solutions, self.complete)]
        for c in self.classes:
            groups = "; ".join(", ".join(map(str, group)) for group in c["joined"])
            lines.append(f"  {c['mode']}  det A {c['det_a']}  joined by proved motions: {groups or 'none'}")
        return "\n".join(lines)

    __repr__ = __str__


class ModeGraph(Result):
    """Which aspects are joined by legs that change their postures, each crossing proved.

    Attributes:
        crossings: the crossings found, each proved.
        groups: aspects that can be reached from one another.
        aspects: the aspects.
        searched: whether crossings were looked for everywhere; false if that was stopped.
    """

    __slots__ = ("_svg",)

    crossings: list[dict[str, Any]]
    groups: list[list[int]]
    aspects: list[dict[str, Any]]
    searched: bool

    def __init__(self, data: str | dict[str, Any], text: str = "", svg: str = "") -> None:
        super().__init__(data, text)
        self._svg = svg

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._data, self._text, self._svg)

    def __str__(self) -> str:
        groups = "; ".join(", ".join(map(str, group)) for group in self.groups)
        searched = "" if self.searched else " (not all were looked for: stopped)"
        found = (
            f"{counted(len(self.aspects), 'aspect')}, {counted(len(self.crossings), 'crossing')}, each proved{searched}"
        )
        return f"{found}; joined: {groups or 'none'}"

    __repr__ = __str__

    def _repr_svg_(self) -> str:
        return self._svg


class Traversability(Result):
    """Which aspects hold a whole set of poses (certified where it is not undecided).

    Attributes:
        classes: class by class: ``mode``, ``det_a``, ``answer`` (``"whole"``, ``"not-whole"`` or ``"undecided"``),
            ``aspect``.
        groups: with ``through_modes``: the groups of aspects through which every pose can be reached.
    """

    classes: list[dict[str, Any]]
    groups: list[dict[str, Any]]

    @property
    def holds(self) -> bool | None:
        """Whether some class holds all of the set; ``None`` if that is undecided."""
        answers = {c["answer"] for c in self.classes}
        return True if "whole" in answers else None if "undecided" in answers else False

    def __bool__(self) -> bool:
        raise undecided(self, "holds")

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
            return f"{counted(len(self.curves), 'curve')} of cusps, of {counted(len(self.slices), 'slice')}{ended}"
        lines = [listed(self.cusps, "cusp", self.complete)]
        for c in self.cusps:
            pose, q = (", ".join(f"{x:.6g}" for x in c[name]) for name in ("pose", "q"))
            lines.append(f"  {c['mode']}  pose ({pose})  q ({q}){'' if c['within_limits'] else '  beyond limits'}")
        return "\n".join(lines)

    __repr__ = __str__


class Exploration(Result):
    """What a roadmap has seen of the classes of a robot with six coordinates.

    Attributes:
        at_least: certified: so many aspects there are at least.
        classes: class by class: ``mode``, ``det_a``, ``samples``, ``components``, ``end``.
    """

    at_least: int
    classes: list[dict[str, Any]]

    def __str__(self) -> str:
        return f"at least {counted(self.at_least, 'aspect')} (certified), in {counted(len(self.classes), 'class', 'classes')}"

    __repr__ = __str__


class Verdict(Result):
    """What a certificate claims, and whether it is right."""

    @property
    def verified(self) -> bool | None:
        """Whether all that it claims is verified; ``None`` if not all was checked, and no fault found so far."""
        return False if self.faults else True if self.complete else None

    def __bool__(self) -> bool:
        return self.verified is True

    def __str__(self) -> str:
        # The summary of a whole check ends in what it found.
        refuted = any(fault["is_wrong"] for fault in self.faults)
        ended = "" if self.complete or refuted else "\nnot verified: not all was checked, it was stopped"
        return f"{super().__str__()}{ended}"

    __repr__ = __str__

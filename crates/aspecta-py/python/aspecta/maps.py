"""Maps of a robot: basic regions (Def. 10) and uniqueness domains (Theorem 3)."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from aspecta import _native
from aspecta._result import Result


class Location(NamedTuple):
    """Where a pose is, in a working mode."""

    #: The sign of det A: 1, -1, or 0 where the pose is in no aspect.
    det_a: int
    #: The aspect; ``None`` if it is not known.
    aspect: int | None
    #: The basic region; ``None`` if it is not known.
    region: int | None
    #: The uniqueness domains that hold the region, by number.
    domains: tuple[int, ...]
    #: Why the pose is in no aspect; ``None`` if it is in one.
    nowhere: str | None


class Domains(Result):
    """The basic regions and uniqueness domains of one aspect. Numerical, true to a cell of the grid."""

    #: The aspect.
    aspect: int
    #: The basic regions, the largest first.
    regions: list[dict[str, Any]]
    #: The uniqueness domains: each a list of regions in which a joint vector means one pose.
    uniqueness: list[dict[str, Any]]
    #: Whether nothing about it is unresolved.
    complete: bool


class Map:
    """The aspects of a robot, of which some are cut into basic regions. Made by :meth:`Analysis.domains`, or loaded."""

    __slots__ = ("_native",)

    def __init__(self, native: _native.Map) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Map:
        """Return the map in a file, as :meth:`save` or ``aspecta domains --save`` writes it.

        Raises:
            Error: the file is no map, or another version's. Its content is checked, never run.
        """
        return cls(_native.Map.load(fspath(path)))

    def save(self, path: str | PathLike[str]) -> None:
        """Write the map into a file, which is there only when it is complete; ``docs/map-file.md`` describes it."""
        _native.write(fspath(path), self._native.to_bytes())

    @property
    def robot(self) -> str:
        """The robot's name."""
        return self._native.robot[0]

    @property
    def aspects(self) -> list[int]:
        """The numbers of the aspects that are cut into regions."""
        return self._native.aspects

    def domains(self, aspect: int) -> Domains:
        """Return the regions and uniqueness domains of an aspect.

        Raises:
            KeyError: that aspect is not cut into regions here.
        """
        found = self._native.domains(aspect)
        if found is None:
            raise KeyError(f"aspect {aspect} is not in this map, which has {self.aspects}")
        return Domains(*found)

    @overload
    def locate(self, pose: list[float] | tuple[float, ...], mode: str) -> Location: ...
    @overload
    def locate(self, pose: ArrayLike, mode: str) -> Location | list[Location]: ...
    def locate(self, pose: ArrayLike, mode: str) -> Location | list[Location]:
        """Locate a pose (dof,), or each of several (n, dof), in a working mode.

        Numerical, true to a cell of the grid; where it is at a border it says so by ``None``.
        """
        poses = np.ascontiguousarray(pose, dtype=float)
        found = [
            Location(det_a, aspect or None, region or None, tuple(domains), nowhere)
            for det_a, aspect, region, domains, nowhere in self._native.locate(np.atleast_2d(poses), mode)
        ]
        return found if poses.ndim == 2 else found[0]

    def __str__(self) -> str:
        return f"a map of {self.robot}: aspects {', '.join(map(str, self.aspects)) or 'none'} cut into regions"

    __repr__ = __str__

    def __reduce__(self) -> tuple[Any, ...]:
        return _map_of, (self._native.to_bytes(),)


def _map_of(file: bytes) -> Map:
    """A map from a pickle, whose content is that of a map file and checked like one."""
    return Map(_native.Map.from_bytes(file))

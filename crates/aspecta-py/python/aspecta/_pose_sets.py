"""Sets of poses, as they are given to :meth:`~aspecta.Analysis.traverse`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from aspecta import _input, _native
from aspecta._table import counted

if TYPE_CHECKING:
    from aspecta._description import Description

#: The coordinates of the centre of what is round.
_CENTRES = {"disc": ["x", "y"], "ball": ["x", "y", "z"]}


class PoseSet(NamedTuple):
    """A set of poses, as the compiled part takes it."""

    #: ``box``, ``round``, ``poses`` or ``paths``.
    kind: str
    #: Ranges of a box, or of what is round.
    ranges: list[tuple[float, float]]
    #: The coordinates in which it is round.
    round: list[int]
    radius: float
    #: Rows of poses or of paths.
    lists: list[list[list[float]]]


def pose_set(robot: Description, given: dict[str, Any], radius: float | None) -> PoseSet:
    """Return the set of poses that is given as one of box, disc, ball, poses and paths."""
    kinds = [name for name, value in given.items() if value is not None]
    if len(kinds) != 1:
        raise _native.Error(f"give one of box, disc, ball, poses and paths, not {' and '.join(kinds) or 'none'}")
    kind = kinds[0]
    value = given[kind]
    if (kind in _CENTRES) != (radius is not None):
        raise _native.Error("radius is that of a disc or of a ball: give both, or neither")
    if kind == "poses":
        return PoseSet(kind, [], [], 0.0, [_enough(kind, _separate(robot, value), 1)])
    if kind == "paths":
        return PoseSet(kind, [], [], 0.0, [_enough(kind, robot._path(kind, path), 2) for path in _several(value)])
    names = robot.pose_names
    centre = _CENTRES.get(kind, [])
    if not set(centre) <= set(names):
        raise _native.Error(f"a pose of `{robot.name}` has no {', '.join(centre)}: give a box")
    ranges, axes = _input.ranges(kind, value, names), [names.index(name) for name in centre]
    for k in axes:
        if ranges[k][0] != ranges[k][1]:
            raise _native.Error(f"{kind}: give one value of {names[k]}, that of the centre")
    return PoseSet("round" if axes else kind, ranges, axes, _input.positive("radius", radius) or 0.0, [])


def _separate(robot: Description, poses: Any) -> list[list[float]]:
    """The rows of poses, each by itself; there may be none."""
    given = _input.numbers("poses", poses)
    return np.atleast_2d(robot._poses(given)).tolist() if given.size else []


def _several(paths: Any) -> list[Any]:
    """The paths, of which one may be given alone."""
    some = list(paths)
    if not some:
        raise _native.Error("paths: give at least one")
    first = _input.numbers("paths", some[0])
    return [paths] if first.ndim == 1 or first.shape == (4, 4) else some


def _enough(name: str, rows: list[list[float]], least: int) -> list[list[float]]:
    """Rows of poses, so many at least."""
    if len(rows) < least:
        remedy = f"give at least {least}{' to a path' if least > 1 else ''}"
        raise _native.Error(f"{name}: {counted(len(rows), 'pose')} given: {remedy}")
    return rows

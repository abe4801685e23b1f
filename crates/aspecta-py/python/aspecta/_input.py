"""What people give: checked, and as the compiled part takes it."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta._native import Error

Array = NDArray[np.float64]

#: Names of coordinates, and which of them are angles, by index.
Names: TypeAlias = tuple[list[str], list[int]]


class UnitWarning(UserWarning):
    """A number looks as if it were in another unit than the one it is taken in."""


def held(fix: Mapping[str, float] | None, coordinates: Names) -> list[tuple[int, float]]:
    """Return coordinates that are held, by index, and their values."""
    names, angles = coordinates
    found = []
    for name, value in (fix or {}).items():
        if name not in names:
            raise Error(f"fix: `{name}` is none of {', '.join(names)}")
        k = names.index(name)
        found.append((k, float(value)))
        if k in angles:
            _warn_of_degrees(name, float(value))
    return found


def fitting(values: ArrayLike, coordinates: Names, robot: str) -> Array:
    """Return one vector (dof,) or rows of several (n, dof), if they fit the robot."""
    names, angles = coordinates
    given = np.asarray(values, dtype=float)
    if given.ndim not in (1, 2) or given.shape[-1] != len(names):
        raise Error(
            f"an array of shape {given.shape}: `{robot}` has {len(names)} coordinates ({', '.join(names)}), give "
            f"({len(names)},) or (n, {len(names)})"
        )
    if angles and given.size and np.abs(given).max() > 2 * math.pi:
        for k in angles:
            column = given[..., k].ravel()
            _warn_of_degrees(names[k], float(column[np.abs(column).argmax()]))
    return np.ascontiguousarray(given)


def vector(values: ArrayLike) -> list[float]:
    """Return numbers as a list."""
    return [float(x) for x in np.asarray(values, dtype=float).ravel()]


def rows(values: ArrayLike) -> list[list[float]]:
    """Return rows of numbers as lists."""
    return [[float(x) for x in row] for row in np.atleast_2d(np.asarray(values, dtype=float))]


def whole(name: str, value: int | None, low: int, high: int | None = None) -> int | None:
    """Return a whole number, if one is given, that lies within bounds."""
    if value is None:
        return None
    bounds = f"from {low} on" if high is None else f"from {low} to {high}"
    if value != int(value) or value < low or (high is not None and value > high):
        raise Error(f"{name} = {value}: give a whole number {bounds}")
    return int(value)


def positive(name: str, value: float | None) -> float | None:
    """Return a number, if one is given, that is positive and finite."""
    if value is not None and not (value > 0 and math.isfinite(value)):
        raise Error(f"{name} = {value}: give a positive number")
    return value


def wishes(weight: float, avoid: tuple[float, float]) -> tuple[float, float, float]:
    """Return what is wished of a plan: the weight of nearness to singularities, and the margins."""
    if not 0 <= weight <= 64:
        raise Error(f"weight = {weight}: give a number from 0 to 64")
    return float(weight), float(avoid[0]), float(avoid[1])


def ranges(kind: str, values: Any, names: list[str]) -> list[tuple[float, float]]:
    """Return a range per coordinate, of each of which a value or (low, high) is given."""
    found = [(float(value), float(value)) if np.ndim(value) == 0 else _ends(value) for value in values]
    if len(found) != len(names):
        raise Error(f"{kind}: give {len(names)} ranges or values, one per coordinate ({', '.join(names)})")
    for name, (low, high) in zip(names, found, strict=True):
        if low > high:
            raise Error(f"{kind}: the range of {name} ends before it begins")
    return found


def _ends(values: Any) -> tuple[float, float]:
    low, high = values
    return float(low), float(high)


def plain(value: Any) -> Any:
    """Return data as TOML has it: arrays and tuples as lists, hyphens in keys, nothing that is None."""
    if isinstance(value, Mapping):
        return {re.sub("_", "-", key): plain(item) for key, item in value.items() if item is not None}
    if isinstance(value, np.ndarray | tuple | list):
        return [plain(item) for item in value]
    return value.item() if isinstance(value, np.generic) else value


def _warn_of_degrees(name: str, angle: float) -> None:
    if 2 * math.pi < abs(angle) < 1e7:
        turns = abs(angle) / (2 * math.pi)
        warnings.warn(
            f"{name} = {angle:g} is taken in radians, {turns:.1f} full turns; if it is in degrees, convert it with numpy.radians",
            UnitWarning,
            stacklevel=5,
        )

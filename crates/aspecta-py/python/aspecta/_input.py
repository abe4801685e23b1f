"""What people give: checked, and as the compiled part takes it."""

from __future__ import annotations

import math
import operator
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta._native import Error

Array = NDArray[np.float64]

#: Names of coordinates, and which of them are angles, by index.
Names: TypeAlias = tuple[list[str], list[int]]

#: The largest of those whole numbers that a float tells apart.
_MOST = 2**53
_SIGNS = {"+": "+", "-": "-", 1: "+", -1: "-"}


class UnitWarning(UserWarning):
    """A number looks as if it were in another unit than the one it is taken in."""


def number(name: str, value: Any, wanted: str = "a number") -> float:
    """Return a number."""
    if not _is_number(value) or math.isnan(value):
        raise Error(f"{name} = {value!r}: give {wanted}")
    return float(value)


def _is_number(value: Any) -> bool:
    """Whether something is a real number, of whatever type: no text, though it may tell one."""
    if isinstance(value, str | bytes | complex):
        return False
    try:
        float(value)
    except (TypeError, ValueError, OverflowError):
        return False
    return True


def whole(name: str, value: Any, low: int, high: int = _MOST) -> int | None:
    """Return a whole number, if one is given, that lies within bounds."""
    if value is None:
        return None
    bounds = f"a whole number from {low} on" if high == _MOST else f"a whole number from {low} to {high}"
    found = number(name, value, bounds)
    if found > high:
        bounds = f"a whole number from {low} to {high}"
    if not (low <= found <= high and found.is_integer()):
        raise Error(f"{name} = {value}: give {bounds}")
    return int(found)


def positive(name: str, value: Any) -> float | None:
    """Return a number, if one is given, that is positive and finite."""
    if value is None:
        return None
    found = number(name, value, "a positive number")
    if not (found > 0 and math.isfinite(found)):
        raise Error(f"{name} = {value}: give a positive number")
    return found


def numbers(name: str, values: ArrayLike) -> Array:
    """Return an array of numbers."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        raise Error(f"{name}: entries are masked; give those alone that are known, such as `values[~mask.any(axis=1)]`")
    try:
        given = np.asarray(values)
    except ValueError:
        raise Error(f"{name}: rows differ in length; give an even array of numbers") from None
    if given.dtype.kind in "fiub":
        return given.astype(float, copy=False)
    for item in given.ravel().tolist():
        if not _is_number(item):
            raise Error(f"{name}: {item!r} is no number")
    return given.astype(float)


def one(name: str, values: ArrayLike, coordinates: Names, robot: str) -> list[float]:
    """Return one vector (dof,), if it fits the robot."""
    given = fitting(values, coordinates, robot)
    if given.ndim != 1:
        raise Error(f"{name} of shape {given.shape}: give one alone, of shape ({len(coordinates[0])},)")
    return given.tolist()  # type: ignore[no-any-return]


def rows(name: str, values: ArrayLike, coordinates: Names, robot: str) -> list[list[float]]:
    """Return rows of several vectors (n, dof), or one, if they fit the robot."""
    return np.atleast_2d(fitting(values, coordinates, robot)).tolist()  # type: ignore[no-any-return]


def fitting(values: ArrayLike, coordinates: Names, robot: str) -> Array:
    """Return one vector (dof,) or rows of several (n, dof), if they fit the robot."""
    names, angles = coordinates
    given = numbers("an array", values)
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


def held(fix: Any, coordinates: Names) -> list[tuple[int, float]]:
    """Return coordinates that are held, by index, and their values."""
    names, angles = coordinates
    found = []
    for name, value in _by_name("fix", fix, names).items():
        if name not in names:
            raise Error(f"fix: `{name}` is none of {', '.join(names)}")
        k = names.index(name)
        found.append((k, value))
        if k in angles:
            _warn_of_degrees(name, value)
    return found


def _by_name(kind: str, values: Any, names: Sequence[str]) -> dict[str, float]:
    """Numbers by the names of their coordinates, given as anything that makes a dictionary."""
    try:
        pairs = dict(() if values is None else values)
    except (TypeError, ValueError):
        raise Error(f"{kind} = {values!r}: give values by name, such as {{{names[-1]!r}: 0.5}}") from None
    return {name: number(f"{kind}: {name}", value) for name, value in pairs.items()}


def margins(avoid: Any) -> tuple[float, float]:
    """Return the margins to keep from parallel and from serial singularities: two numbers, or one for both."""
    given = numbers("avoid", avoid)
    if given.shape not in ((), (2,)):
        raise Error(
            f"avoid = {avoid!r}: give the least |det Â| and the least |B_jj| / max |B_jj|, or a number for both"
        )
    parallel, serial = np.broadcast_to(given, 2).tolist()
    return parallel, serial


def wishes(weight: Any, avoid: Any) -> tuple[float, float, float]:
    """Return what is wished of a plan: the weight of nearness to singularities, and the margins."""
    found = number("weight", weight, "a number from 0 to 64")
    if not 0 <= found <= 64:
        raise Error(f"weight = {weight}: give a number from 0 to 64")
    return found, *margins(avoid)


def cut(at: Any, bounds: Mapping[str, tuple[float, float]], held: Mapping[str, float]) -> dict[str, float]:
    """Return where to cut, by coordinate: within the bounds of those that vary; of those that are held, where they are."""
    found = _by_name("at", at, list(bounds))
    for name, value in found.items():
        if name in held and held[name] != value:
            raise Error(f"at: {name} = {value:g}: it is held at {held[name]:g} here")
        if name not in bounds and name not in held:
            raise Error(f"at: `{name}` does not vary here; {', '.join(bounds)} do")
        if name in bounds and not bounds[name][0] <= value <= bounds[name][1]:
            low, high = bounds[name]
            raise Error(f"at: {name} = {value:g} lies outside what is drawn, {low:g} to {high:g}")
    return {name: value for name, value in found.items() if name in bounds}


def effort(samples: Any, seconds: Any) -> tuple[int, float | None]:
    """Return how long a roadmap may grow."""
    return whole("samples", samples, 1) or 1, positive("seconds", seconds)


def sign(det_a: Any) -> str | None:
    """Return the sign of det A as text, if one is given."""
    if det_a is None:
        return None
    try:
        return _SIGNS[det_a]
    except (KeyError, TypeError):
        raise Error(f'det_a = {det_a!r}: give "+" or "-" (or 1 or -1)') from None


def aspect(value: Any) -> int:
    """Return the number of an aspect, which may be given as an :class:`~aspecta.Aspect`."""
    try:
        return operator.index(getattr(value, "id", value))
    except TypeError:
        raise Error(f"aspect {value!r}: give an aspect or its number, from 1") from None


def aspects(values: Any) -> list[int] | None:
    """Return the numbers of aspects, of which one or several may be given."""
    if values is None:
        return None
    several = isinstance(values, Iterable) and not isinstance(values, str)
    return [aspect(value) for value in (values if several else [values])]


def ranges(kind: str, values: Any, names: list[str]) -> list[tuple[float, float]]:
    """Return a range per coordinate, of each of which a value or (low, high) is given, in their order or by name."""
    wanted = f"{kind}: give a range (low, high) or a value of each coordinate ({', '.join(names)}), in their order or by name"
    if isinstance(values, Mapping):
        if set(values) != set(names):
            raise Error(f"{wanted}; given are {', '.join(map(str, values)) or 'none'}")
        values = [values[name] for name in names]
    if not isinstance(values, Iterable) or len(each := list(values)) != len(names):
        raise Error(wanted)
    found = []
    for name, value in zip(names, each, strict=True):
        given = numbers(f"{kind}: {name}", value)
        if given.shape not in ((), (2,)):
            raise Error(f"{kind}: {name} = {value!r}: give a range (low, high) or a value")
        low, high = np.broadcast_to(given, 2).tolist()
        if low > high:
            raise Error(f"{kind}: the range of {name} ends before it begins")
        found.append((low, high))
    return found


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

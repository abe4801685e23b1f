"""What a robot is: its data, its names, its forms."""

from __future__ import annotations

import html
import json
import warnings
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np
import tomli_w
from numpy.typing import ArrayLike, NDArray

from aspecta import _input, _native, poses

if TYPE_CHECKING:
    from typing_extensions import Self

Array = NDArray[np.float64]


class Description:
    """A robot as data: what :class:`~aspecta.Robot` is asked about itself."""

    __slots__ = ("_coordinates", "_hash", "_modes", "_motors", "_native")

    def __init__(
        self,
        name_or_path: str | None = None,
        /,
        *,
        platform: str | None = None,
        legs: Sequence[Mapping[str, Any]] | None = None,
        name: str = "robot",
        title: str | None = None,
        source: str | None = None,
        length_unit: str | None = None,
        window: Mapping[str, Any] | None = None,
        rod_angles: Sequence[Mapping[str, Any]] | None = None,
        bodies: Mapping[str, Any] | None = None,
        obstacles: Sequence[Mapping[str, Any]] | None = None,
    ) -> None:
        if (name_or_path is None) == (platform is None):
            raise _native.Error("give the name of a robot, or its platform and legs")
        if name_or_path is not None:
            native = _native.Robot.resolve(fspath(name_or_path))
        else:
            table: dict[str, Any] = {
                "name": name,
                "title": title,
                "source": source,
                "length-unit": length_unit,
                "platform": platform,
            }
            table |= {"legs": [_input.plain(leg) for leg in legs or ()], "window": _input.plain(window)}
            table["bodies"] = _input.plain(bodies)
            for key, given_tables in (("rod-angles", rod_angles), ("obstacles", obstacles)):
                table[key] = [_input.plain(one) for one in given_tables or ()] or None
            given = {key: value for key, value in table.items() if value is not None}
            native = _native.Robot.from_toml(tomli_w.dumps(given), name)
        self._set(native)

    def _set(self, native: _native.Robot) -> None:
        self._native = native
        self._hash = hash(native.json())
        self._modes = frozenset(native.modes)
        self._coordinates = (
            [name for name, _ in native.coordinates],
            [k for k, (_, angle) in enumerate(native.coordinates) if angle],
        )
        self._motors = (
            [f"q{j + 1}" for j in range(native.dof)],
            [j for j, angle in enumerate(native.joint_angles) if angle],
        )
        mixed = native.mixed_units()
        if mixed is not None:
            small, a, large, b = mixed
            warnings.warn(
                f"{small} is {a:g} {self.length_unit} and {large} {b:g} {self.length_unit}: all lengths are in one unit",
                _input.UnitWarning,
                stacklevel=3,
            )

    @classmethod
    def from_toml(cls, text: str, file: str = "robot.toml") -> Self:
        """Return the robot that a text describes; ``file`` is its name in messages."""
        robot = cls.__new__(cls)
        robot._set(_native.Robot.from_toml(text, file))
        return robot

    @classmethod
    def from_file(cls, path: str | PathLike[str]) -> Self:
        """Return the robot of a file."""
        robot = cls.__new__(cls)
        robot._set(_native.Robot.load(fspath(path)))
        return robot

    def to_toml(self) -> str:
        """Return the robot as the text of a robot file."""
        return self._native.text

    def to_dict(self) -> dict[str, Any]:
        """Return the robot as it was understood, as plain data."""
        return json.loads(self._native.json())  # type: ignore[no-any-return]

    @property
    def name(self) -> str:
        """Its short name."""
        return self._native.name

    @property
    def title(self) -> str:
        """One line for people."""
        return self._native.title

    @property
    def length_unit(self) -> str:
        """The unit of all lengths."""
        return self._native.length_unit

    @property
    def platform(self) -> str:
        """How its platform moves: ``plane-point``, ``plane-body``, ``translating-body``, ``turning-body``, ``free-body``."""
        return self._native.platform

    @property
    def dof(self) -> int:
        """Its degrees of freedom, which is also the number of legs."""
        return self._native.dof

    @property
    def modes(self) -> list[str]:
        """Its working modes, such as ``"+-+"``: the signs of B_jj."""
        return self._native.modes

    @property
    def pose_names(self) -> list[str]:
        """The names of the pose coordinates, in their order."""
        return list(self._coordinates[0])

    @property
    def joint_names(self) -> list[str]:
        """The names of the joint coordinates: q1, q2, …"""
        return list(self._motors[0])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Description) and self._native == other._native

    def __hash__(self) -> int:
        return self._hash

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_toml, (self.to_toml(), f"{self.name}.toml")

    def __repr__(self) -> str:
        return f"<robot {self.name}: {self.title or self.platform}>"

    def _repr_html_(self) -> str:
        heading = f"<b>{html.escape(self.name)}</b> {html.escape(self.title)}"
        return f"{heading}<details><summary>robot file</summary><pre>{html.escape(self.to_toml())}</pre></details>"

    @property
    def _pose_labels(self) -> list[str]:
        """The pose coordinates with their units."""
        return self._labels(self._coordinates)

    @property
    def _joint_labels(self) -> list[str]:
        """The joint coordinates with their units."""
        return self._labels(self._motors)

    def _labels(self, coordinates: _input.Names) -> list[str]:
        names, angles = coordinates
        return [f"{name} [{'rad' if k in angles else self.length_unit}]" for k, name in enumerate(names)]

    def _known(self, mode: str) -> str:
        """The signs of a mode, which may be given by the names of its postures."""
        if not isinstance(mode, str):
            raise _native.Error(f"mode = {mode!r}: give one working mode as text, one of {', '.join(self.modes)}")
        return mode if mode in self._modes else self._native.signs(mode)

    def _modes_of(self, modes: Any) -> list[str]:
        """The signs of modes, of which one or several may be given, each once; none mean all."""
        if not isinstance(modes, str | Iterable | None):
            raise _native.Error(f"modes = {modes!r}: give working modes as texts, such as {self.modes[:2]}")
        wanted = [modes] if isinstance(modes, str) else () if modes is None else modes
        return list(dict.fromkeys(map(self._known, wanted)))

    def _poses(self, pose: ArrayLike | None, xyzw: ArrayLike | None = None, wxyz: ArrayLike | None = None) -> Array:
        """One pose (dof,), or rows of several (n, dof)."""
        if xyzw is not None or wxyz is not None:
            if xyzw is not None and wxyz is not None:
                raise _native.Error("give one of quaternion_xyzw and quaternion_wxyz")
            given = poses.from_quaternion(self.platform, pose, xyzw=xyzw, wxyz=wxyz)
        elif pose is None:
            raise _native.Error(f"give a pose ({', '.join(self.pose_names)})")
        else:
            given = _input.numbers("a pose", pose)
            if _are_matrices(given):
                given = poses.from_matrix(self.platform, given)
            elif self.platform == "turning-body" and given.shape == (3, 3) and poses.is_rotation(given):
                raise _native.Error(
                    "a rotation matrix (3, 3) could be three rows of angles: give a homogeneous matrix (4, 4), or angles"
                )
        return _input.fitting(given, self._coordinates, self.name)

    def _pose(self, name: str, pose: ArrayLike, before: ArrayLike | None = None) -> list[float]:
        """One pose; of a matrix, the angles nearest to those of a pose before."""
        given = _input.numbers(name, pose)
        if not _are_matrices(given):
            return _input.one(name, given, self._coordinates, self.name)
        if given.ndim != 2:
            raise _native.Error(f"{name} of shape {given.shape}: give one matrix (4, 4) alone")
        return poses.nearest(self.platform, self._poses(given[None]), before)[0].tolist()  # type: ignore[no-any-return]

    def _joints(self, name: str, q: ArrayLike) -> list[float]:
        """One joint vector."""
        return _input.one(name, q, self._motors, self.name)

    def _path(self, name: str, path: ArrayLike) -> list[list[float]]:
        """The rows of a path; of matrices, each in the angles nearest to those of the row before."""
        given = _input.numbers(name, path)
        rows = np.atleast_2d(self._poses(given))
        found = poses.nearest(self.platform, rows) if _are_matrices(given) else rows
        return found.tolist()  # type: ignore[no-any-return]


def _are_matrices(given: Array) -> bool:
    """Whether an array holds homogeneous matrices: no robot has four coordinates."""
    return given.shape[-2:] == (4, 4) and given.ndim <= 3

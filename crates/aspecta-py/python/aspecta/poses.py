"""Poses in space as matrices and quaternions.

A pose of a ``free-body`` is (x, y, z, roll, pitch, yaw), of a ``turning-body`` (roll, pitch, yaw), with the rotation
R = R_z(yaw) R_y(pitch) R_x(roll); of a ``translating-body`` (x, y, z). Lengths are in the robot's unit, angles in rad.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from aspecta import _input
from aspecta._native import Error

Array = NDArray[np.float64]

#: Matrices whose columns are off by more than this are no rotations.
_ORTHONORMAL = 1e-9


def rotation_from_rpy(rpy: ArrayLike) -> Array:
    """Return R_z(yaw) R_y(pitch) R_x(roll) of angles (…, 3), rad, as matrices (…, 3, 3).

    >>> rotation_from_rpy([0, 0, np.pi / 2]).round(12)[0].tolist()
    [0.0, -1.0, 0.0]
    """
    angles = np.asarray(rpy, dtype=float)
    (sr, sp, sy), (cr, cp, cy) = np.moveaxis(np.sin(angles), -1, 0), np.moveaxis(np.cos(angles), -1, 0)
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def is_rotation(matrices: Array) -> bool:
    """Return whether all of some matrices (…, 3, 3) are rotations."""
    return bool(_skewness(matrices) <= _ORTHONORMAL and np.all(np.linalg.det(matrices) > 0))


def _skewness(r: Array) -> float:
    """How far the rows of matrices are off orthonormal."""
    return float(np.abs(r @ np.swapaxes(r, -1, -2) - np.eye(3)).max(initial=0.0))


def rpy_from_rotation(matrices: ArrayLike) -> Array:
    """Return (roll, pitch, yaw) of rotation matrices (…, 3, 3), rad, pitch in [-π/2, π/2].

    Where pitch is ±π/2, roll and yaw turn about one axis: roll is then 0.

    Raises:
        Error: a matrix is not orthonormal, or a reflection.

    >>> rpy_from_rotation(rotation_from_rpy([0.1, 0.2, 0.3])).round(12).tolist()
    [0.1, 0.2, 0.3]
    """
    r = np.asarray(matrices, dtype=float)
    if not is_rotation(r):
        raise Error(f"not a rotation matrix: rows are off orthonormal by {_skewness(r):.1e}, or it reflects")
    flat = np.hypot(r[..., 0, 0], r[..., 1, 0])
    turned = flat > _ORTHONORMAL
    roll = np.where(turned, np.arctan2(r[..., 2, 1], r[..., 2, 2]), 0.0)
    yaw = np.where(turned, np.arctan2(r[..., 1, 0], r[..., 0, 0]), np.arctan2(-r[..., 0, 1], r[..., 1, 1]))
    return np.stack([roll, np.arctan2(-r[..., 2, 0], flat), yaw], axis=-1)


def rotation_from_quaternion(*, xyzw: ArrayLike | None = None, wxyz: ArrayLike | None = None) -> Array:
    """Return the rotation matrices (…, 3, 3) of quaternions (…, 4), of any length but 0, their order named.

    Raises:
        Error: none or both orders are given, or a quaternion is zero.

    >>> rotation_from_quaternion(wxyz=[1, 0, 0, 0]).tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    if (xyzw is None) == (wxyz is None):
        raise Error("give one quaternion, as xyzw=… or wxyz=…")
    given: Any = xyzw if xyzw is not None else wxyz
    q = _input.numbers("a quaternion", given)
    if q.shape[-1:] != (4,):
        raise Error(f"a quaternion of shape {q.shape}: give (4,), or (n, 4) of several")
    length = np.linalg.norm(q, axis=-1, keepdims=True)
    if np.any(length == 0) or not np.all(np.isfinite(length)):
        raise Error("a quaternion is zero or not finite: it means no rotation")
    x, y, z, w = np.moveaxis(q / length if xyzw is not None else np.roll(q / length, -1, axis=-1), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def from_matrix(platform: str, matrices: ArrayLike) -> Array:
    """Return the pose coordinates (…, dof) of homogeneous matrices (…, 4, 4) for a platform in space.

    Raises:
        Error: a matrix moves the platform as it cannot, or is no motion.
    """
    m = _input.numbers("matrices", matrices)
    if np.any(m[..., 3, :] != [0, 0, 0, 1]):
        raise Error("the last row of a homogeneous matrix is 0, 0, 0, 1")
    position, rotation = m[..., :3, 3], m[..., :3, :3]
    if platform == "free-body":
        return np.concatenate([position, rpy_from_rotation(rotation)], axis=-1)
    if platform == "turning-body":
        if np.any(position != 0):
            raise Error("a turning body does not move away: the position is 0, 0, 0")
        return rpy_from_rotation(rotation)
    if platform == "translating-body":
        if np.abs(rotation - np.eye(3)).max(initial=0.0) > _ORTHONORMAL:
            raise Error("a translating body does not turn: the rotation is the identity")
        return position
    raise Error(f"platform `{platform}` moves in the plane: give pose coordinates, not matrices")


def from_quaternion(
    platform: str, positions: ArrayLike | None, *, xyzw: ArrayLike | None = None, wxyz: ArrayLike | None = None
) -> Array:
    """Return the pose coordinates (…, dof) of positions (…, 3) and quaternions (…, 4), their order named.

    A turning body stays where it is: its positions are 0, or ``None``.

    Raises:
        Error: as :func:`rotation_from_quaternion`; or the platform does not turn in space.
    """
    if platform not in ("free-body", "turning-body"):
        raise Error(f"quaternions are for bodies that turn in space; this platform is `{platform}`")
    rotations = rotation_from_quaternion(xyzw=xyzw, wxyz=wxyz)
    if positions is None and platform == "free-body":
        raise Error("give the positions to which the quaternions belong, (3,) or (n, 3)")
    matrices = np.zeros((*rotations.shape[:-2], 4, 4))
    matrices[..., :3, :3], matrices[..., 3, 3] = rotations, 1
    if positions is not None:
        given = _input.numbers("positions", positions)
        if given.shape != (*rotations.shape[:-2], 3):
            orientations = (*rotations.shape[:-2], 4)
            raise Error(
                f"positions {given.shape} and quaternions {orientations}: give (3,) and (4,), or (n, 3) and (n, 4)"
            )
        matrices[..., :3, 3] = given
    return from_matrix(platform, matrices)


def nearest(platform: str, rows: Array, before: ArrayLike | None = None) -> Array:
    """Return the same poses (n, dof) of a platform in space, in those angles that are nearest to the pose before.

    An orientation is told by many angles: by full turns more or less, by (roll + π, π - pitch, yaw + π), and where pitch is
    ±π/2 by any roll. Matrices do not tell which are meant; along a path they are those that turn least.
    The first row stays as it is, unless a pose ``before`` it is given.
    """
    if platform not in ("free-body", "turning-body"):
        return rows
    found = rows.copy()
    last = None if before is None else np.asarray(before, dtype=float)[-3:]
    for angles in found[:, -3:]:
        if last is not None:
            angles[:] = _nearest(angles, last)
        last = angles
    return found


def _nearest(angles: Array, last: Array) -> Array:
    """Those angles of an orientation that are nearest to others."""
    roll, pitch, yaw = angles
    alike = [angles, np.array([roll + np.pi, np.pi - pitch, yaw + np.pi])]
    alike = [each + 2 * np.pi * np.round((last - each) / (2 * np.pi)) for each in alike]
    if abs(np.cos(pitch)) < _ORTHONORMAL:
        # Only yaw - sign · roll means anything: both turn as far.
        sign = np.sign(np.sin(pitch))
        apart = (yaw - sign * roll) - (last[2] - sign * last[0])
        half = 0.5 * (apart - 2 * np.pi * np.round(apart / (2 * np.pi)))
        alike = [np.array([last[0] - sign * half, each[1], last[2] + half]) for each in alike]
    return min(alike, key=lambda each: float(np.abs(each - last).max()))


def to_matrix(platform: str, poses: ArrayLike) -> Array:
    """Return homogeneous matrices (…, 4, 4) of pose coordinates (…, dof) of a platform in space.

    Raises:
        Error: the platform moves in the plane, or the poses do not fit it.

    >>> to_matrix("free-body", [1, 2, 3, 0, 0, 0])[:3, 3].tolist()
    [1.0, 2.0, 3.0]
    """
    p = _input.numbers("poses", poses)
    dof = {"free-body": 6, "turning-body": 3, "translating-body": 3}.get(platform)
    if dof is None:
        raise Error(f"platform `{platform}` moves in the plane: its poses are no matrices in space")
    if p.shape[-1:] != (dof,) or not np.isfinite(p).all():
        raise Error(f"poses of shape {p.shape}: give finite numbers (…, {dof}), the coordinates of a `{platform}`")
    m = np.zeros((*p.shape[:-1], 4, 4))
    m[..., 3, 3] = 1
    m[..., :3, :3] = np.eye(3)
    if platform == "free-body":
        m[..., :3, 3], m[..., :3, :3] = p[..., :3], rotation_from_rpy(p[..., 3:])
    elif platform == "turning-body":
        m[..., :3, :3] = rotation_from_rpy(p)
    else:
        m[..., :3, 3] = p
    return m

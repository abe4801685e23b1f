"""Poses in space as matrices and quaternions.

A pose of a ``free-body`` is (x, y, z, roll, pitch, yaw), of a ``turning-body`` (roll, pitch, yaw), with the rotation
R = R_z(yaw) R_y(pitch) R_x(roll); of a ``translating-body`` (x, y, z). Lengths are in the robot's unit, angles in rad.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

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


def rpy_from_rotation(matrices: ArrayLike) -> Array:
    """Return (roll, pitch, yaw) of rotation matrices (…, 3, 3), rad, pitch in [-π/2, π/2].

    Where pitch is ±π/2, roll and yaw turn about one axis: roll is then 0.

    Raises:
        Error: a matrix is not orthonormal, or a reflection.

    >>> rpy_from_rotation(rotation_from_rpy([0.1, 0.2, 0.3])).round(12).tolist()
    [0.1, 0.2, 0.3]
    """
    r = np.asarray(matrices, dtype=float)
    off = np.abs(r @ np.swapaxes(r, -1, -2) - np.eye(3)).max(initial=0.0)
    if off > _ORTHONORMAL or np.any(np.linalg.det(r) < 0):
        raise Error(f"not a rotation matrix: rows are off orthonormal by {off:.1e}, or it reflects")
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
    q = np.asarray(given, dtype=float)
    if q.shape[-1:] != (4,):
        raise Error(f"a quaternion has 4 numbers, not {q.shape[-1] if q.ndim else 1}")
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
    m = np.asarray(matrices, dtype=float)
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
    platform: str, positions: ArrayLike, *, xyzw: ArrayLike | None = None, wxyz: ArrayLike | None = None
) -> Array:
    """Return the pose coordinates (…, 6) of positions (…, 3) and quaternions (…, 4), their order named, for a free body.

    Raises:
        Error: as :func:`rotation_from_quaternion`; or the platform is no free body.
    """
    if platform != "free-body":
        raise Error(f"quaternions are for free bodies; this platform is `{platform}`")
    given = np.asarray(positions, dtype=float)
    turns = rpy_from_rotation(rotation_from_quaternion(xyzw=xyzw, wxyz=wxyz))
    if given.shape != turns.shape:
        raise Error(f"positions {given.shape} and orientations {turns.shape}: give (3,) or (n, 3) of both")
    return np.concatenate([given, turns], axis=-1)


def to_matrix(platform: str, poses: ArrayLike) -> Array:
    """Return homogeneous matrices (…, 4, 4) of pose coordinates (…, dof) of a platform in space.

    Raises:
        Error: the platform moves in the plane.

    >>> to_matrix("free-body", [1, 2, 3, 0, 0, 0])[:3, 3].tolist()
    [1.0, 2.0, 3.0]
    """
    p = np.asarray(poses, dtype=float)
    m = np.zeros((*p.shape[:-1], 4, 4))
    m[..., 3, 3] = 1
    m[..., :3, :3] = np.eye(3)
    if platform == "free-body":
        m[..., :3, 3], m[..., :3, :3] = p[..., :3], rotation_from_rpy(p[..., 3:])
    elif platform == "turning-body":
        m[..., :3, :3] = rotation_from_rpy(p)
    elif platform == "translating-body":
        m[..., :3, 3] = p
    else:
        raise Error(f"platform `{platform}` moves in the plane: its poses are no matrices in space")
    return m

"""Poses as 4 x 4 matrices: from and to angles, quaternions and the rotations of scipy."""

from __future__ import annotations

from typing import Any, Protocol, Union, runtime_checkable

import numpy as np
import numpy.typing as npt

from ._errors import DesignError

Floats = npt.NDArray[np.float64]


@runtime_checkable
class HasMatrix(Protocol):
    """What has ``as_matrix()``: ``Rotation`` and ``RigidTransform`` of ``scipy.spatial.transform``."""

    def as_matrix(self) -> Any: ...


#: What a pose, or many, may be given as.
PoseLike = Union[npt.ArrayLike, HasMatrix]


def as_matrices(poses: PoseLike) -> Floats:
    """Poses as an array of float64 with shape (..., 4, 4); no copy where it is one already."""
    given = poses.as_matrix() if isinstance(poses, HasMatrix) else poses
    array = np.asarray(given)
    if np.iscomplexobj(array):
        raise DesignError("a pose here is real; of complex solutions take `.real_transforms`", code="pose")
    if array.shape[-2:] == (3, 3) and isinstance(poses, HasMatrix):
        raise DesignError("a rotation alone is no pose: use equipod.pose(position, rotation=...)", code="pose")
    if array.ndim < 2 or array.shape[-2:] != (4, 4):
        raise DesignError(f"poses have the shape (..., 4, 4), not {array.shape}", code="shape")
    return np.ascontiguousarray(array, dtype=np.float64)


def pose(
    position: npt.ArrayLike = (0.0, 0.0, 0.0),
    *,
    rpy: npt.ArrayLike | None = None,
    degrees: bool = False,
    quat: npt.ArrayLike | None = None,
    scalar_first: bool = True,
    rotation: PoseLike | None = None,
) -> Floats:
    """A pose, or many, from a position and one form of rotation.

    Parameters
    ----------
    position : array_like, shape (..., 3)
        Origin of the platform frame in the base frame, in the unit of length of the design.
    rpy : array_like, shape (..., 3), optional
        Roll, pitch, yaw: ``R = Rz(yaw) Ry(pitch) Rx(roll)``; radians unless `degrees`.
    degrees : bool
        Whether `rpy` is in degrees.
    quat : array_like, shape (..., 4), optional
        Unit quaternion, ``[w, x, y, z]`` unless ``scalar_first=False``.
    scalar_first : bool
        Order of `quat`; scipy has the scalar last by default.
    rotation : array_like, shape (..., 3, 3), or scipy Rotation, optional
        Rotation matrix. Without any of the three the rotation is the identity.

    Returns
    -------
    ndarray, float64, shape (..., 4, 4)
        ``[[R, p], [0, 1]]``.

    Raises
    ------
    DesignError
        Two forms of rotation at once, wrong shapes, a quaternion of norm zero.

    Examples
    --------
    >>> import equipod
    >>> equipod.pose([0, 0, 17], rpy=[0, 10, 0], degrees=True).shape
    (4, 4)
    """
    if sum(form is not None for form in (rpy, quat, rotation)) > 1:
        raise DesignError("a pose has one rotation: give one of rpy, quat, rotation", code="pose")
    p = np.asarray(position, dtype=np.float64)
    if p.shape[-1:] != (3,):
        raise DesignError(f"positions have the shape (..., 3), not {p.shape}", code="shape")
    if rpy is not None:
        r = _from_rpy(np.asarray(rpy, dtype=np.float64), degrees)
    elif quat is not None:
        r = _from_quaternion(np.asarray(quat, dtype=np.float64), scalar_first)
    elif rotation is not None:
        given = rotation.as_matrix() if isinstance(rotation, HasMatrix) else rotation
        r = np.asarray(given, dtype=np.float64)
        if r.shape[-2:] != (3, 3):
            raise DesignError(f"rotations have the shape (..., 3, 3), not {r.shape}", code="shape")
    else:
        r = np.eye(3)
    shape = np.broadcast_shapes(p.shape[:-1], r.shape[:-2])
    out = np.zeros((*shape, 4, 4))
    out[..., :3, :3] = r
    out[..., :3, 3] = p
    out[..., 3, 3] = 1.0
    return out


def _from_rpy(rpy: Floats, degrees: bool) -> Floats:
    if rpy.shape[-1:] != (3,):
        raise DesignError(f"angles have the shape (..., 3), not {rpy.shape}", code="shape")
    angles = np.deg2rad(rpy) if degrees else rpy
    c, s = np.cos(angles), np.sin(angles)
    (cr, cp, cy), (sr, sp, sy) = np.moveaxis(c, -1, 0), np.moveaxis(s, -1, 0)
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _from_quaternion(quat: Floats, scalar_first: bool) -> Floats:
    if quat.shape[-1:] != (4,):
        raise DesignError(f"quaternions have the shape (..., 4), not {quat.shape}", code="shape")
    norm = np.linalg.norm(quat, axis=-1, keepdims=True)
    if not np.all(np.abs(norm - 1.0) <= 1e-3):
        raise DesignError("a quaternion of a rotation has norm 1", code="pose")
    w, x, y, z = np.moveaxis(quat / norm if scalar_first else np.roll(quat / norm, 1, axis=-1), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def rpy(poses: PoseLike, *, degrees: bool = False) -> Floats:
    """Roll, pitch and yaw of poses, ``R = Rz(yaw) Ry(pitch) Rx(roll)``.

    Parameters
    ----------
    poses : array_like, shape (..., 4, 4)
    degrees : bool
        Degrees instead of radians.

    Returns
    -------
    ndarray, float64, shape (..., 3)
        Pitch is in [-90, 90] degrees; where it is plus or minus 90, yaw is 0.
    """
    r = as_matrices(poses)[..., :3, :3]
    level = np.hypot(r[..., 0, 0], r[..., 1, 0])
    pitch = np.arctan2(-r[..., 2, 0], level)
    locked = level < 1e-12
    roll = np.where(locked, np.arctan2(-r[..., 1, 2], r[..., 1, 1]), np.arctan2(r[..., 2, 1], r[..., 2, 2]))
    yaw = np.where(locked, 0.0, np.arctan2(r[..., 1, 0], r[..., 0, 0]))
    out = np.stack([roll, pitch, yaw], axis=-1)
    return np.rad2deg(out) if degrees else out


def quaternion(poses: PoseLike, *, scalar_first: bool = True) -> Floats:
    """Unit quaternions of poses, with the scalar not negative.

    Parameters
    ----------
    poses : array_like, shape (..., 4, 4)
    scalar_first : bool
        ``[w, x, y, z]``, else ``[x, y, z, w]``.

    Returns
    -------
    ndarray, float64, shape (..., 4)
    """
    r = as_matrices(poses)[..., :3, :3]
    d0, d1, d2 = r[..., 0, 0], r[..., 1, 1], r[..., 2, 2]
    # 4 q q^T, column by column; the one with the largest diagonal loses no digits (Shepperd 1978)
    a, b, c = r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]
    e, f, g = r[..., 1, 0] + r[..., 0, 1], r[..., 0, 2] + r[..., 2, 0], r[..., 2, 1] + r[..., 1, 2]
    columns = np.stack(
        [
            np.stack([1 + d0 + d1 + d2, a, b, c], axis=-1),
            np.stack([a, 1 + d0 - d1 - d2, e, f], axis=-1),
            np.stack([b, e, 1 - d0 + d1 - d2, g], axis=-1),
            np.stack([c, f, g, 1 - d0 - d1 + d2], axis=-1),
        ],
        axis=-2,
    )
    best = np.argmax(np.diagonal(columns, axis1=-2, axis2=-1), axis=-1)
    q: Floats = np.take_along_axis(columns, best[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    q = np.where(q[..., :1] < 0, -q, q)
    return q if scalar_first else np.roll(q, -1, axis=-1)

"""Poses as 4 x 4 matrices: from and to angles, quaternions and the rotations of scipy."""

from __future__ import annotations

from typing import Any, Protocol, TypeVar, Union, runtime_checkable

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import DesignError

Floats = npt.NDArray[np.float64]

_FLOAT64 = np.dtype(np.float64)


@runtime_checkable
class HasMatrix(Protocol):
    """An object with ``as_matrix()``, such as ``Rotation`` and ``RigidTransform`` of ``scipy.spatial.transform``."""

    def as_matrix(self) -> Any: ...


Found = TypeVar("Found")

#: The forms in which poses can be given.
PoseLike = Union[npt.ArrayLike, HasMatrix]


def given(found: Found | None) -> Found:
    """The result of the native module for an array made for it."""
    if found is None:
        raise TypeError("an array of float64, row by row, was made and not taken")
    return found


def as_matrices(poses: PoseLike) -> Floats:
    """Poses as an array of float64 with shape (..., 4, 4); no copy where it is one already."""
    # what a loop hands over again and again: the lookup of `as_matrix` costs more than the mathematics
    if type(poses) is np.ndarray and poses.dtype == _FLOAT64 and poses.shape[-2:] == (4, 4) and poses.flags.c_contiguous:
        return poses
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
    angles = np.deg2rad(rpy) if degrees else rpy
    return _core.rotations_of_angles(_rows(angles, 3, "angles")).reshape(*rpy.shape[:-1], 3, 3)


def _from_quaternion(quat: Floats, scalar_first: bool) -> Floats:
    rows = _rows(quat if scalar_first else np.roll(quat, 1, axis=-1), 4, "quaternions")
    return _core.rotations_of_quaternions(rows).reshape(*quat.shape[:-1], 3, 3)


def _rows(array: Floats, width: int, what: str) -> Floats:
    if array.shape[-1:] != (width,):
        raise DesignError(f"{what} have the shape (..., {width}), not {array.shape}", code="shape")
    return np.ascontiguousarray(array).reshape(-1, width)


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
        Pitch is in [-90, 90] degrees; where it is plus or minus 90, only the sum or difference of roll and yaw is
        determined: yaw is then as the rounding of the matrix has it, and roll belongs to it.
    """
    array = as_matrices(poses)
    out = _core.angles_of(array.reshape(-1, 4, 4)).reshape(*array.shape[:-2], 3)
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
    array = as_matrices(poses)
    q = _core.quaternions_of(array.reshape(-1, 4, 4)).reshape(*array.shape[:-2], 4)
    return q if scalar_first else np.roll(q, -1, axis=-1)

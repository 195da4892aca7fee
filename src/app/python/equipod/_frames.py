"""Conventions for poses: order of turns, pivot, what poses count from, the axis that is up, units, quaternions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import DesignError
from ._poses import Floats, PoseLike, as_matrices


@dataclass(frozen=True)
class Frames:
    """A convention for poses, as ``[frames]`` of a design file; what is None is as in this package.

    Parameters
    ----------
    rotation_order : str, optional
        ``"fixed-xyz"`` (``R = Rz Ry Rx``, as roll, pitch, yaw), ``"moving-xyz"`` (``R = Rx Ry Rz``), any other axes, ``"rpy"``, ``"pi"``, ``"rubin"``, or ``"vector"``.
    angles : {"deg", "rad"}, optional
        Unit of angles.
    quaternion : {"wxyz", "xyzw"}, optional
        Order of quaternions.
    pivot : tuple of float, shape (3,), optional
        Point of the platform whose position poses state, platform frame.
    relative_to : {"base", "home"}, optional
        The origin of poses.
    up : {"z", "y"}, optional
        The axis that points up.

    Examples
    --------
    >>> import equipod
    >>> pi = equipod.Frames(rotation_order="pi")
    >>> T = pi.poses([0, 0, 650, 5, 3, 10])
    >>> pi.numbers(T).round(6).tolist()
    [0.0, 0.0, 650.0, 5.0, 3.0, 10.0]
    >>> pi.sentence
    'Angles a, b, c are in degrees in the order moving-xyz: R = Rx(a) Ry(b) Rz(c).'
    """

    rotation_order: str | None = None
    angles: Literal["deg", "rad"] | None = None
    quaternion: Literal["wxyz", "xyzw"] | None = None
    pivot: tuple[float, float, float] | None = None
    relative_to: Literal["base", "home"] | None = None
    up: Literal["z", "y"] | None = None

    @property
    def sentence(self) -> str:
        """The convention in sentences."""
        return _core.frames_sentence(self._words())

    def poses(self, numbers: npt.ArrayLike, *, home: PoseLike | None = None) -> Floats:
        """Matrices of poses that are written in this convention.

        Parameters
        ----------
        numbers : array_like, shape (..., 6) or (..., 7)
            Position and angles, or position and quaternion.
        home : pose_like, shape (4, 4), optional
            Needed if poses count from home.

        Returns
        -------
        ndarray, float64, shape (..., 4, 4)
        """
        array = np.asarray(numbers, dtype=np.float64)
        if array.shape[-1:] not in ((6,), (7,)):
            raise DesignError(f"written poses have the shape (..., 6) or (..., 7), not {array.shape}", code="shape")
        rows = np.ascontiguousarray(array).reshape(-1, array.shape[-1])
        return _core.poses_in_frames(self._words(), rows, self._home(home)).reshape(*array.shape[:-1], 4, 4)

    def numbers(self, poses: PoseLike, *, home: PoseLike | None = None, form: Literal["angles", "quaternion"] = "angles") -> Floats:
        """Poses in this convention: position and three angles, or position and quaternion.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)
        home : pose_like, shape (4, 4), optional
            Needed if poses count from home.
        form : {"angles", "quaternion"}
            The form of the rotation after the position.

        Returns
        -------
        ndarray, float64, shape (..., 6) or (..., 7)
        """
        array = as_matrices(poses)
        position, angles, quaternion, _ = self._written(array, home)
        rotation = angles if form == "angles" else quaternion
        rows: Floats = np.concatenate([position, rotation], axis=-1).reshape(*array.shape[:-2], -1)
        return rows

    def angles_unique(self, poses: PoseLike, *, home: PoseLike | None = None) -> npt.NDArray[np.bool_]:
        """Whether the rotations have no other angles: False near the ends of the middle angle, where only a combination of the others is determined.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)
        home : pose_like, shape (4, 4), optional
            Needed if poses count from home.
        """
        array = as_matrices(poses)
        return self._written(array, home)[3].reshape(array.shape[:-2])

    def _written(self, array: Floats, home: PoseLike | None) -> tuple[Floats, Floats, Floats, npt.NDArray[np.bool_]]:
        return _core.poses_as_numbers(self._words(), array.reshape(-1, 4, 4), self._home(home))

    def _home(self, home: PoseLike | None) -> Floats:
        if home is None:
            if self.relative_to == "home":
                raise DesignError("poses count from home: give home=design.home", code="frames")
            return np.eye(4).reshape(1, 4, 4)
        return as_matrices(home).reshape(1, 4, 4)

    def _words(
        self,
    ) -> tuple[str | None, str | None, str | None, tuple[float, float, float] | None, str | None, str | None]:
        pivot = None if self.pivot is None else (float(self.pivot[0]), float(self.pivot[1]), float(self.pivot[2]))
        return (self.rotation_order, self.angles, self.quaternion, pivot, self.relative_to, self.up)

"""Designs, and what is asked of them."""

from __future__ import annotations

import html
import json
import operator
import os
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, cast, get_args

import numpy as np
import numpy.typing as npt

from . import _core
from ._display import Figure, Page
from ._errors import DesignError
from ._exact import Coordinate, PointsLike, as_texts, offset_texts, plain
from ._frames import Frames
from ._poses import Floats, PoseLike, as_matrices, given
from ._program import Progress, Workshop, ask, pose_text, text_of
from ._solutions import BatchSolutions, Solutions
from ._words import Body, Drive, ExportFormat, FigureName, Method, TextFormat, TrackStatus

if TYPE_CHECKING:
    import pyarrow  # type: ignore[import-untyped]

    from .records import (
        AssessAnswer,
        AtAnswer,
        CalibrateAnswer,
        CheckAnswer,
        CompareAnswer,
        DrivesAnswer,
        ExploreAnswer,
        FamilyAnswer,
        LimitsAnswer,
        MapAnswer,
        MotionAnswer,
        OptimizeAnswer,
        RoundAnswer,
        SingularLocusAnswer,
        SingularPosesAnswer,
        TolerancesAnswer,
        VerifyAnswer,
    )

_LEGS = ((0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 5))


def presets() -> tuple[str, ...]:
    """The names that `Design.preset` takes."""
    return tuple(_core.preset_names())


def _whole(name: str, value: int, least: int = 0) -> int:
    """A whole number that is not below `least` and fits into 64 bits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise DesignError(f"{name} is a whole number, not {value!r}", code=name) from None
    if not least <= number < 2**64:
        raise DesignError(f"{name} is a whole number from {least}, not {number}", code=name)
    return number


def _threads(threads: int | None) -> int | None:
    return None if threads is None else _whole("threads", threads, 1)


def _row(name: str, values: npt.ArrayLike, count: int) -> str:
    """So many numbers as an option takes them, to the last digit."""
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (count,):
        raise DesignError(f"{name} has {count} numbers, not the shape {array.shape}", code="shape")
    return ",".join(map(repr, array.tolist()))


def _lengths(lengths: npt.ArrayLike) -> Floats:
    if np.iscomplexobj(lengths):
        raise DesignError("leg lengths, or angles of cranks, are real", code="lengths")
    try:
        array = np.ascontiguousarray(lengths, dtype=np.float64)
    except (TypeError, ValueError) as fault:
        raise DesignError(f"leg lengths, or angles of cranks, are numbers: {fault}", code="lengths") from None
    if array.ndim < 1 or array.shape[-1] != 6:
        raise DesignError(f"leg lengths, or angles of cranks, have the shape (..., 6), not {array.shape}", code="shape")
    return array


@dataclass(frozen=True)
class Joints:
    """The joints of a design.

    Attributes
    ----------
    base : ndarray, float64, shape (n, 3)
        Base joints in the base frame.
    platform : ndarray, float64, shape (m, 3)
        Platform joints in the platform frame.
    legs : ndarray, int64, shape (6, 2)
        Row of `base` and row of `platform` that each leg joins.
    base_names, platform_names : tuple of str
        The names of the rows.
    """

    base: Floats
    platform: Floats
    legs: npt.NDArray[np.int64]
    base_names: tuple[str, ...]
    platform_names: tuple[str, ...]

    @property
    def base_ends(self) -> Floats:
        """The base end of each leg, shape (6, 3)."""
        return self.base[self.legs[:, 0]]

    @property
    def platform_ends(self) -> Floats:
        """The platform end of each leg, shape (6, 3)."""
        return self.platform[self.legs[:, 1]]


@dataclass(frozen=True)
class LegMap:
    """The affine map between the squared leg lengths of two designs, ``s(b) = A s(a) + c``.

    Attributes
    ----------
    A : ndarray, float64, shape (6, 6), or None
        None where there is no map.
    c : ndarray, float64, shape (6,), or None
        In squared units of length.
    record : MapAnswer
        All that is known of it: whether it is exact, ``det A``, which legs have none.
    """

    A: Floats | None
    c: Floats | None
    record: MapAnswer

    def lengths(self, lengths: npt.ArrayLike) -> Floats:
        """The lengths of the second design at the poses of these lengths of the first.

        Parameters
        ----------
        lengths : array_like, shape (..., 6)

        Returns
        -------
        ndarray, float64, shape (..., 6)

        Raises
        ------
        DesignError
            There is no map, or a squared length is negative, so no pose has these lengths.
        """
        if self.A is None or self.c is None:
            raise DesignError("there is no leg map between these designs", code="map")
        squares = _lengths(lengths) ** 2 @ self.A.T + self.c
        if not np.all(squares >= 0):
            raise DesignError("no pose has these lengths: a squared length of the other design is negative", code="lengths")
        return np.sqrt(squares)


@dataclass(frozen=True)
class Calibrated:
    """A machine calibrated from measurements.

    Attributes
    ----------
    design : Design, or None
        With the calibrated joints; None where they are not identified, or where the measurements refute the model.
    record : CalibrateAnswer
        Joints, offsets, deviations, covariance, residuals, outliers, and the poses to measure next.
    """

    design: Design | None
    record: CalibrateAnswer


@dataclass(frozen=True)
class Equivalent:
    """A platform of the class of an octahedral one, and its map: ``s(design) = A s(original) + c``.

    Attributes
    ----------
    design : Design
    A : ndarray, float64, shape (6, 6)
    c : ndarray, float64, shape (6,)
    """

    design: Design
    A: Floats
    c: Floats

    @cached_property
    def singular(self) -> bool | None:
        """Whether the platform is architecturally singular, so that it is equivalent to none (``det A = 0``): the verdict of :meth:`Design.check`, None where it is not decided."""
        return self.design._native.is_singular()


@dataclass(frozen=True)
class Margins:
    """Margins of requirements at poses; a negative margin is a violation.

    Attributes
    ----------
    names : tuple of str
        The kind of requirement of each column.
    of : tuple of str
        Legs, joints or load of each column.
    units : tuple of str
    values : ndarray, float64, shape (..., columns)
    """

    names: tuple[str, ...]
    of: tuple[str, ...]
    units: tuple[str, ...]
    values: Floats

    @property
    def least(self) -> dict[str, float]:
        """The least margin of each kind over all poses."""
        out: dict[str, float] = {}
        for k, name in enumerate(self.names):
            value = float(np.min(self.values[..., k]))
            out[name] = min(out.get(name, value), value)
        return out

    def to_arrow(self) -> pyarrow.Table:
        """One row a pose, one column a requirement, named ``kind of``; needs pyarrow."""
        import pyarrow as pa

        values = self.values.reshape(-1, len(self.names))
        titles = [f"{name} {of}".strip() for name, of in zip(self.names, self.of)]
        return pa.table({title: np.ascontiguousarray(values[:, k]) for k, title in enumerate(titles)})


@dataclass(frozen=True)
class CrankAngles:
    """Angles of cranks at poses; NaN at a pose where a rod does not reach.

    Attributes
    ----------
    kept : ndarray, float64, shape (..., 6)
        Radians, on the side that the design keeps; what `Design.ik` gives.
    other : ndarray, float64, shape (..., 6)
        The angles on the other sides, which hold the platform as well.
    transmission : ndarray, float64, shape (..., 6)
        ``u . (n x t)`` of the unit vectors u along the rod, n along the axis and t along the crank, from -1 to 1; 0 at a singular crank, where both angles are one.
    limit_margin : ndarray, float64, shape (..., 6)
        Radians: what remains of the limits of the angle, negative beyond them; infinite where there are none.
    """

    kept: Floats
    other: Floats
    transmission: Floats
    limit_margin: Floats


class SkippedRow(NamedTuple):
    """A row of lengths at which a tracker did not move.

    Attributes
    ----------
    row : int
        Its number, from 0.
    status : str
        ``near_singularity``, ``lost``, or ``refused`` if the row is no set of lengths.
    fraction : float
        Fraction reached of the straight line of squared lengths, or of angles, from the last row reached.
    reason : str or None
        Why the pose was lost, or the row was refused.
    """

    row: int
    status: TrackStatus
    fraction: float
    reason: str | None


class Track(NamedTuple):
    """Poses that follow leg lengths, or angles of cranks.

    Attributes
    ----------
    status : str
        ``tracked``, ``near_singularity`` or ``lost``; ``refused`` for rows that were skipped.
    T : ndarray, float64, shape (4, 4) or (n, 4, 4)
        The pose reached; for several lengths, the poses of the rows reached.
    residual : float or ndarray, shape (n,)
        Largest errors of the leg equations over the squared size.
    frobenius_ratio : float or ndarray, shape (n,)
        Distance from singular poses: ``6 / (|J| |J^-1|)``, 1 at best, 0 at a singular pose; for cranks, the value of the rods.
    fraction : float
        Fraction reached of the straight line of squared lengths, or of angles, to the last ones; 1 if they were reached.
    reason : str or None
        Why the pose was lost.
    rows : ndarray, int64, shape (n,), or None
        The row of lengths of each pose; None for one set of lengths.
    skipped : tuple of SkippedRow
        Rows at which the tracker stayed where it was, with ``skip=True``.
    """

    status: TrackStatus
    T: Floats
    residual: float | Floats
    frobenius_ratio: float | Floats
    fraction: float
    reason: str | None
    rows: npt.NDArray[np.int64] | None = None
    skipped: tuple[SkippedRow, ...] = ()

    @property
    def transforms(self) -> Floats:
        """The poses reached, the same as ``T``."""
        return self.T


def _tracking(design: Design, at: Floats) -> Tracker:
    return design.tracker(at)


class Tracker:
    """Follows one real pose from lengths to lengths, never to another assembly mode; where a singularity is in the way it stays where it was.

    Of a design whose drive is rotary it takes angles of the cranks where it says lengths.
    """

    def __init__(self, native: _core.Tracker, design: Design) -> None:
        self._native = native
        self._design = design

    def __copy__(self) -> Tracker:
        """A tracker at the same place, which moves by itself."""
        return Tracker(self._native.__copy__(), self._design)

    def __deepcopy__(self, memo: object) -> Tracker:
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        return (_tracking, (self._design, self.T))

    @property
    def T(self) -> Floats:
        """The pose of the platform, shape (4, 4)."""
        return self._native.transform()

    @property
    def transform(self) -> Floats:
        """The pose of the platform, shape (4, 4); the same as ``T``."""
        return self.T

    def step(self, lengths: npt.ArrayLike) -> Track:
        """Continues to six lengths.

        Parameters
        ----------
        lengths : array_like, shape (6,)

        Returns
        -------
        Track
        """
        found = self._native.step(lengths)
        if found is None:
            array = _lengths(lengths)
            if array.shape != (6,):
                raise DesignError(f"step takes six lengths, not {array.shape}: use follow for many", code="shape")
            found = given(self._native.step(array))
        return Track(*found)

    def follow(self, lengths: npt.ArrayLike, *, skip: bool = False) -> Track:
        """Continues through rows of lengths, until one is not reached or, with `skip`, through all of them.

        Parameters
        ----------
        lengths : array_like, shape (..., 6)
            Rows of lengths in design units, or of angles in radians; leading axes are taken row by row.
        skip : bool
            At a row that is not reached, or that is no set of lengths (NaN, negative), the tracker stays where it was and
            goes on to the next row. A log of a real machine has such rows.

        Returns
        -------
        Track
            ``T`` has a pose for each row reached, and ``rows`` says which row. Without `skip`, `status` speaks of the row
            after these, or of the last. With it `status` speaks of the last row, and ``skipped`` lists the rows left out.

        Raises
        ------
        DesignError
            Without `skip`: a row that is no set of lengths, before the tracker moves.
        """
        found = self._native.follow(_lengths(lengths).reshape(-1, 6), skip)
        poses, (residual, ratio), rows, (status, fraction, reason), skipped = found
        left_out = tuple(SkippedRow._make(row) for row in skipped)
        return Track(status, poses, residual, ratio, fraction, reason, rows, left_out)

    def __repr__(self) -> str:
        return f"Tracker(at {np.array2string(self.T[:3, 3], precision=6)})"


class Design:
    """A platform with six legs: joints, units, home pose and requirements.

    Made by `load`, `loads`, `preset` or `from_arrays`; a design does not change.
    """

    def __init__(self, native: _core.Design) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Design:
        """Reads a design file, TOML or JSON.

        Raises
        ------
        DesignError
            With everything that is wrong with the file, and where.
        OSError
            A file that cannot be read.
        """
        return cls(_core.Design.load(path))

    @classmethod
    def loads(cls, text: str, format: TextFormat = "toml") -> Design:
        """Reads the text of a design, ``"toml"`` or ``"json"``."""
        return cls(_core.Design.loads(text, _is_json(format)))

    @classmethod
    def preset(cls, name: str) -> Design:
        """One of `equipod.presets`."""
        return cls(_core.Design.preset(name))

    @classmethod
    def from_arrays(
        cls,
        base: PointsLike,
        platform: PointsLike,
        legs: Iterable[tuple[int, int]] | None = None,
        *,
        home: PoseLike | None = None,
        name: str = "platform",
        units: str = "mm",
        snap: bool = False,
    ) -> Design:
        """A design from its joints.

        Parameters
        ----------
        base : array_like, shape (n, 3)
            Base joints, base frame. Coordinates are numbers, ``fractions.Fraction``, ``decimal.Decimal``, or texts such as
            ``"6*sqrt(3)"`` and ``"1/3"``. With a text, a fraction or a decimal in an array, its joints are exact: a float
            beside it counts as the decimal with the fewest digits, as in a design file.
        platform : array_like, shape (m, 3)
            Platform joints, platform frame, in the same forms.
        legs : six pairs of int, optional
            Rows of `base` and of `platform` that each leg joins; leg ``i`` joins row ``i`` of both when absent.
        home : array_like, shape (4, 4), optional
        name, units : str
            The unit of all lengths.
        snap : bool
            Take the symmetry that the joints have but for rounding as meant (`snapped`).

        Returns
        -------
        Design
            The joints are named ``A1, A2, ..`` and ``B1, B2, ..``.

        Raises
        ------
        DesignError
            Arrays of another shape, a text that is no expression, legs that are not six.
        """
        pairs = list(_LEGS if legs is None else ((int(a), int(b)) for a, b in legs))
        if len(pairs) != 6:
            raise DesignError(f"a platform has six legs, not {len(pairs)}", code="legs")
        texts = [as_texts(points) for points in (base, platform)]
        if any(points is not None for points in texts):
            both = [points if points is not None else _points(own).tolist() for points, own in zip(texts, (base, platform))]
            design = _from_texts(both, pairs, name, units)
        else:
            design = cls(_core.Design.from_arrays(_points(base), _points(platform), pairs, name, units))
        if home is not None:
            design = design.with_home(home)
        return design.snapped() if snap else design

    @property
    def symmetry(self) -> list[str]:
        """The symmetry that the joints have but for rounding, with its distance: joints at one place, mirrored, turned by
        a third, on lines and circles of others, and similar bodies. Empty where nothing was found."""
        found = self._native.snapped()
        return [] if found is None else found[1]

    def snapped(self) -> Design:
        """The design with its `symmetry` as constructions, so that joints are exact; the same where it has none."""
        found = self._native.snapped()
        return self if found is None else Design(found[0])

    def dumps(self, format: TextFormat = "toml") -> str:
        """The text of the design: with the comments of its file as ``"toml"``, or ``"json"``."""
        return self._native.dumps(_is_json(format))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the design; the file must not exist."""
        if pathlib.Path(path).exists():
            raise FileExistsError(f"{os.fspath(path)} exists, and nothing overwrites a file")
        self._native.save(path)

    @property
    def name(self) -> str:
        """The name of the design."""
        return self._native.name

    @property
    def units(self) -> str:
        """The unit of all lengths."""
        return self._native.units

    @property
    def drive(self) -> Drive:
        """``"prismatic"``: legs change their lengths; ``"rotary"``: the legs are rods of constant length on cranks."""
        return self._native.drive

    @property
    def home(self) -> Floats:
        """The home pose, shape (4, 4); above the base where the design names none."""
        return self._native.home()

    @property
    def lengths(self) -> Floats | None:
        """The leg lengths of the design file, shape (6,), distances of joints; None where it has none."""
        return self._native.lengths()

    def to_dict(self) -> dict[str, Any]:
        """The keys of the design file, as ``dumps("json")`` has them; a change of the dictionary changes no design."""
        document: dict[str, Any] = json.loads(self.dumps("json"))
        return document

    @property
    def workspace(self) -> dict[str, Any]:
        """The table ``[workspace]``: the poses to reach. Empty where the design has none."""
        return _table(self.to_dict(), "workspace")

    @property
    def hardware(self) -> dict[str, Any]:
        """The table ``[hardware]``: sizes and limits of joints, legs and drives. Empty where the design has none."""
        return _table(self.to_dict(), "hardware")

    @property
    def requirements(self) -> dict[str, Any]:
        """The tables of the design file that limit something, by their names: ``hardware``, ``limits``, ``speed``,
        ``stiffness``, ``loads``, ``keep_out``, ``payload``, ``envelope``, ``plates``, ``cranks``; and
        ``min_joint_distance`` of ``[optimize]``. `margins` says by how much they are met at poses, `assess` over the
        workspace."""
        document = self.to_dict()
        found = {name: document[name] for name in _REQUIRING if name in document}
        least = _table(document, "optimize").get("min_joint_distance")
        return found if least is None else {**found, "min_joint_distance": least}

    def replace(self, **keys: Any) -> Design:
        """The design with other keys of its file, in place of the whole value each key had.

        Parameters
        ----------
        **keys
            Keys of the design file: ``name="new"``, ``lengths=array``, ``home=pose``,
            ``hardware={**design.hardware, "leg_length": [9, 18]}``. Tables are dictionaries, lists may be arrays, and None
            removes a key. Fractions and texts stay exact where the file takes expressions.

        Returns
        -------
        Design

        Raises
        ------
        DesignError
            A fault of the design, for example an unknown key or a value of a wrong type.

        Examples
        --------
        >>> import equipod
        >>> design = equipod.Design.preset("bench-l16")
        >>> design.replace(name="mine", description=None).name
        'mine'
        """
        document = self.to_dict()
        for key, value in keys.items():
            if value is None:
                document.pop(key, None)
            elif key == "home" and not isinstance(value, Mapping):
                document[key] = json.loads(self.with_home(value).dumps("json"))["home"]
            else:
                document[key] = plain(value)
        return _read(document)

    def with_home(self, home: PoseLike) -> Design:
        """The design with another home pose.

        Parameters
        ----------
        home : pose_like, shape (4, 4)

        Returns
        -------
        Design

        Raises
        ------
        DesignError
            A matrix that is no pose; several poses.
        """
        pose = as_matrices(home)
        if pose.shape != (4, 4):
            raise DesignError(f"home is one pose of shape (4, 4), not {pose.shape}", code="shape")
        return Design(self._native.with_home(np.ascontiguousarray(pose).reshape(1, 4, 4)))

    def with_joint(self, joint: str, place: Sequence[Any] | npt.NDArray[np.float64] | Mapping[str, Any]) -> Design:
        """The design with one joint at another place. All else stays; joints that are constructed from it follow.

        Parameters
        ----------
        joint : str
            Its name, with the body before it where both have one of this name: ``"base.A1"``.
        place : array_like, shape (3,), or dict
            Coordinates in the frame of the body, as in `from_arrays`; or a construction of design files, such as
            ``{"on": ["A1", "A2"], "t": "1/5"}``.

        Returns
        -------
        Design
            With three numbers the comments of its text stay.

        Raises
        ------
        DesignError
            No joint, or two, of this name; a place that is none.
        """
        texts = None if isinstance(place, Mapping) else as_texts([place])
        if not isinstance(place, Mapping) and texts is None:
            x, y, z = _points([place])[0].tolist()
            return Design(self._native.with_joint(joint, (x, y, z)))
        document = self.to_dict()
        body, name = self._joint(joint)
        document[body][name] = plain(place) if texts is None else texts[0]
        return _read(document)

    def _joint(self, joint: str) -> tuple[Body, str]:
        """Body and name of a joint."""
        joints = self.joints
        names: dict[Body, tuple[str, ...]] = {"base": joints.base_names, "platform": joints.platform_names}
        found: list[tuple[Body, str]] = [(body, joint) for body, own in names.items() if joint in own]
        found = found or [(body, name) for body, own in names.items() for name in own if joint == f"{body}.{name}"]
        if len(found) != 1:
            known = ", ".join(f"{body}.{name}" for body, own in names.items() for name in own)
            raise DesignError(f"{len(found)} joints are named `{joint}`; joints are {known}", code="joint")
        return found[0]

    @property
    def frames(self) -> Frames:
        """The machine's own convention for poses, ``[frames]`` of the file."""
        order, angles, quaternion, pivot, relative_to, up = self._native.frames()
        return Frames(
            rotation_order=order,
            angles=cast(Any, angles),
            quaternion=cast(Any, quaternion),
            pivot=None if pivot is None else (pivot[0], pivot[1], pivot[2]),
            relative_to=cast(Any, relative_to),
            up=cast(Any, up),
        )

    def poses(self, numbers: npt.ArrayLike, *, frames: Frames | None = None) -> Floats:
        """Matrices of poses that are written in a convention, the design's own when absent.

        Parameters
        ----------
        numbers : array_like, shape (..., 6) or (..., 7)
            Position and angles, or position and quaternion.
        frames : Frames, optional
            The convention; poses that count from home count from that of the design.

        Returns
        -------
        ndarray, float64, shape (..., 4, 4)
        """
        return (self.frames if frames is None else frames).poses(numbers, home=self.home)

    def pose_numbers(
        self, poses: PoseLike, *, frames: Frames | None = None, form: Literal["angles", "quaternion"] = "angles"
    ) -> Floats:
        """Poses in a convention, the design's own when absent: position and three angles, or position and quaternion.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)
        frames : Frames, optional
            The convention.
        form : {"angles", "quaternion"}
            The form of the rotation after the position.

        Returns
        -------
        ndarray, float64, shape (..., 6) or (..., 7)
        """
        return (self.frames if frames is None else frames).numbers(poses, home=self.home, form=form)

    def _rows(self, poses: PoseLike) -> Floats:
        """Poses as a command reads them from a table of this design, shape (n, 7)."""
        own = replace(self.frames, quaternion="wxyz")
        return own.numbers(poses, home=self.home, form="quaternion").reshape(-1, 7)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Entries of the file that are allowed but often mistakes."""
        return tuple(self._native.warnings())

    @property
    def joints(self) -> Joints:
        """The joints and which of them each leg joins; of a design whose drive is rotary the base joints are the centres of the cranks."""
        return Joints(
            base=self._native.joints("base"),
            platform=self._native.joints("platform"),
            legs=self._native.legs(),
            base_names=tuple(self._native.joint_names("base")),
            platform_names=tuple(self._native.joint_names("platform")),
        )

    @property
    def characteristic_length(self) -> float:
        """The length that moments are divided by in conditioning numbers: the RMS radius of the platform joints."""
        return self._native.characteristic_length()

    def ik(self, poses: PoseLike) -> Floats:
        """Inverse kinematics: leg lengths ``|R b_i + p - a_i|``, or angles of the cranks.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)

        Returns
        -------
        ndarray, float64, shape (..., 6)
            Of a design whose drive is rotary radians, each angle on the side that the design keeps, and NaN at a pose where a rod does not reach;
            `crank_angles` has the other sides too.

        Raises
        ------
        DesignError
            Matrices that are no poses.
        """
        found = self._native.ik(poses)
        return given(self._native.ik(as_matrices(poses))) if found is None else found

    def crank_angles(self, poses: PoseLike) -> CrankAngles:
        """Both angles of each crank, transmissions, and what remains of the limits, of a design whose drive is rotary.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)

        Returns
        -------
        CrankAngles

        Raises
        ------
        DesignError
            Matrices that are no poses; a design without cranks.
        """
        found = self._native.crank_angles(poses)
        return CrankAngles(*(given(self._native.crank_angles(as_matrices(poses))) if found is None else found))

    def jacobian(self, poses: PoseLike, *, characteristic_length: float = 1.0) -> Floats:
        """Leg speeds, or speeds of the cranks, by the velocity of the platform origin and the angular velocity, base frame.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)
        characteristic_length : float
            Moments are divided by it, so that rows map ``(v, L omega)``; 1 gives ``(v, omega)``.

        Returns
        -------
        ndarray, float64, shape (..., 6, 6)
            Row ``i`` is ``[u_i, ((R b_i) x u_i) / L]`` with the unit vector ``u_i`` of leg ``i`` (Merlet 2006, sec. 5.3). For a crank of length ``r`` and
            transmission ``g`` the row of its rod is over ``r g`` and gives radians per second; NaN where a crank is singular or a rod does not reach.
        """
        found = self._native.jacobian(poses, characteristic_length)
        return given(self._native.jacobian(as_matrices(poses), characteristic_length)) if found is None else found

    def fk(
        self, lengths: npt.ArrayLike, *, seed: int = 1, method: Method | None = None, pose_count: bool = True
    ) -> Solutions:
        """Forward kinematics: all finite poses, real and complex, each with its certificate where there is one.

        Parameters
        ----------
        lengths : array_like, shape (6,)
            Of a design whose drive is rotary the angles of the cranks in radians; certificates hold for the tips of the cranks as doubles.
        seed : int
            Of generic constants; the same input and seed give the same answer.
        method : str, optional
            ``"octic"``, ``"homotopy"``, ``"trilateration"``, ``"sylvester"`` or ``"template"``; the one that fits when absent.
        pose_count : bool
            Count the poses modulo random primes where no theorem says that the list is complete, which takes some
            milliseconds.

        Returns
        -------
        Solutions

        Raises
        ------
        DesignError
            Values that are no lengths; a method that does not apply.
        """
        array = _lengths(lengths)
        if array.shape != (6,):
            raise DesignError(f"fk takes six lengths, not {array.shape}: use fk_batch for many", code="shape")
        six: list[float] = array.tolist()
        seed = _whole("seed", seed)
        return Solutions(self._native.fk(six, seed, method, bool(pose_count)), (self, six, seed, method, bool(pose_count)))

    def fk_batch(
        self,
        lengths: npt.ArrayLike,
        *,
        threads: int | None = None,
        seed: int = 1,
        method: Method | None = None,
        pose_count: bool = True,
        real_only: bool = False,
    ) -> BatchSolutions:
        """Forward kinematics of many sets of lengths; the design is prepared once.

        Parameters
        ----------
        lengths : array_like, shape (..., 6)
            Of a design whose drive is rotary the angles of the cranks in radians; nothing can be prepared for these.
        threads : int, optional
            One for each processor when absent; the answer does not depend on it.
        seed, method, pose_count
            As for `fk`.
        real_only : bool
            Keep only the real poses, as float64, in less memory. All poses are computed nevertheless, so that
            `completeness` says what it says of the whole; ``undecided`` counts the poses that may be real or not.

        Returns
        -------
        BatchSolutions
            Ragged: rows have as many poses as they have; leading axes are row by row, and ``batch[i, j]`` names a row by
            them.

        Raises
        ------
        DesignError
            An array of another shape, a method that does not exist; a row that fails carries its reason in the answer.
        """
        array = _lengths(lengths)
        rows = np.ascontiguousarray(array.reshape(-1, 6))
        if array.ndim < 2:
            raise DesignError(f"fk_batch takes rows of six lengths, not {array.shape}", code="shape")
        seed = _whole("seed", seed)
        found = self._native.fk_batch(rows, _threads(threads), seed, method, bool(pose_count), bool(real_only))
        return BatchSolutions(found, array.shape[:-1])

    def tracker(self, start: PoseLike | None = None) -> Tracker:
        """Follows one real pose from lengths to lengths, from `start` (home when absent); where the drive is rotary from angles to angles."""
        pose = self.home if start is None else as_matrices(start)
        return Tracker(self._native.tracker(np.ascontiguousarray(pose).reshape(1, 4, 4)), self)

    def margins(self, poses: PoseLike) -> Margins:
        """Margins of the requirements at poses; `assess` proves them for the whole workspace.

        Parameters
        ----------
        poses : array_like, shape (..., 4, 4)

        Returns
        -------
        Margins
        """
        array = as_matrices(poses)
        columns, values = self._native.margins(array.reshape(-1, 4, 4))
        return Margins(
            names=tuple(name for name, _, _ in columns),
            of=tuple(", ".join(of) for _, _, of in columns),
            units=tuple(unit for _, unit, _ in columns),
            values=values.reshape(*array.shape[:-2], len(columns)),
        )

    def check(self, *, seed: int = 1) -> CheckAnswer:
        """Whether the design is architecturally singular, why, and how far away a singular design is."""
        from .records import CheckAnswer

        return CheckAnswer.from_json(self._native.check(_whole("seed", seed)))

    def assess(
        self, *, points: int = 5000, steps: int = 10, searches: int = 3, cells: int | None = None, seed: int = 1
    ) -> AssessAnswer:
        """Margins of the requirements of the design over its whole workspace, with proof.

        ``cells`` is the greatest number of cells of the workspace for the proof of a kind of requirement; by default 6000, then 60,000 if the result is undecided.
        ``met`` is True if all requirements are proved, False if a violation is proved, and None otherwise.
        """
        from .records import AssessAnswer

        most = None if cells is None else _whole("cells", cells)
        found = self._native.assess(
            _whole("points", points), _whole("steps", steps, 1), _whole("searches", searches), most, _whole("seed", seed)
        )
        return AssessAnswer.from_json(found)

    def limits(self, at: PoseLike | None = None, *, to: PoseLike | None = None, options: Sequence[str] = ()) -> LimitsAnswer:
        """Free travel of the platform from a pose along every axis, and the requirements that limit it.

        Parameters
        ----------
        at : pose_like, shape (4, 4), optional
            Home when absent.
        to : pose_like, shape (4, 4), optional
            Also the straight path to this pose, and the allowed pose nearest to it.
        options : sequence of str
            Further options of ``equipod limits``.
        """
        from .records import LimitsAnswer

        with Workshop() as shop:
            words = ["limits", shop.file("design.toml", self._native)]
            words += [f"--{name}={pose_text(pose)}" for name, pose in (("at", at), ("to", to)) if pose is not None]
            return LimitsAnswer(ask([*words, *options]))

    def at(
        self,
        pose: PoseLike | None = None,
        *,
        point: npt.ArrayLike | None = None,
        axes: Literal["base", "platform"] = "base",
        wrench: npt.ArrayLike | None = None,
        forces: npt.ArrayLike | None = None,
        step: float = 1.0,
        leg: int | None = None,
        nearest_singular: bool = False,
        options: Sequence[str] = (),
    ) -> AtAnswer:
        """Forces, stiffness and resolution at a pose, what a stuck leg leaves, and the nearest singular pose.

        Parameters
        ----------
        pose : pose_like, shape (4, 4), optional
            Home when absent.
        point : array_like, shape (3,), optional
            Point that wrenches, shifts and stiffness are about, platform frame; the pivot of `frames` when absent.
        axes : {"base", "platform"}
            The body whose axes vectors have.
        wrench : array_like, shape (6,), optional
            Force and torque on the platform about the point: what holds them is computed.
        forces : array_like, shape (6,), optional
            Forces of the legs, positive where they push, or torques of the cranks: the wrench that they hold is computed.
        step : float
            Step of the drives for which the motion of the platform is computed: the unit of length, degrees of cranks.
        leg : int, optional
            Leg that is stuck, or free while the others are locked, from 1.
        nearest_singular : bool
            Also the nearest singular pose.
        options : sequence of str
            Further options of ``equipod at``.
        """
        from .records import AtAnswer

        with Workshop() as shop:
            words = ["at", shop.file("design.toml", self._native), f"--axes={axes}", f"--step={float(step)!r}"]
            words += [] if pose is None else [f"--pose={pose_text(pose)}"]
            lists = (("point", point, 3), ("wrench", wrench, 6), ("forces", forces, 6))
            words += [f"--{name}={_row(name, value, count)}" for name, value, count in lists if value is not None]
            words += [] if leg is None else [f"--leg={leg}"]
            words += ["--nearest-singular"] if nearest_singular else []
            return AtAnswer(ask([*words, *options]))

    def singular_poses(self, pose: PoseLike | None = None, *, options: Sequence[str] = ()) -> SingularPosesAnswer:
        """Singular poses: signs of det J, and a box of poses proved to have none.

        Parameters
        ----------
        pose : pose_like, shape (4, 4), optional
            In the middle of the box; home when absent.
        options : sequence of str
            Further options of ``equipod singular poses``.
        """
        from .records import SingularPosesAnswer

        with Workshop() as shop:
            words = ["singular", "poses", shop.file("design.toml", self._native)]
            return SingularPosesAnswer(ask([*words, *([] if pose is None else [f"--pose={pose_text(pose)}"]), *options]))

    def singular_locus(
        self,
        pose: PoseLike | str | None = None,
        *,
        along: Sequence[float | str] | None = None,
        about: Sequence[float | str] | None = None,
    ) -> SingularLocusAnswer:
        """``det J`` as an exact polynomial: a cubic in the position at one orientation, or a polynomial in one unknown ``u``.

        Parameters
        ----------
        pose : pose_like, shape (4, 4), or str, optional
            Gives the orientation; home when absent. A text such as ``"0,0,1,1,1/2,0,0"`` is exact, with a quaternion of any norm.
        along : sequence of float or str, shape (3,), optional
            Only the positions ``p + u along``.
        about : sequence of float or str, shape (3,), optional
            Rotations about this axis through the platform origin; ``u`` is the tangent of half the angle over its length.
        """
        from .records import SingularLocusAnswer

        with Workshop() as shop:
            words = ["singular", "locus", shop.file("design.toml", self._native)]
            words += [] if pose is None else [f"--pose={pose if isinstance(pose, str) else pose_text(pose)}"]
            given = (("along", along), ("about", about))
            words += [f"--{name}={','.join(map(str, value))}" for name, value in given if value is not None]
            return SingularLocusAnswer(ask(words))

    def equivalents(self) -> FamilyAnswer:
        """All patterns of the equivalence class of an octahedral design, each with its leg map as polynomials in the offsets.

        ``patterns`` has them, ``counts`` how many there are; `equivalent` makes the platform of a pattern.
        """
        from .records import FamilyAnswer

        with Workshop() as shop:
            return FamilyAnswer(ask(["equivalents", "family", shop.file("design.toml", self._native)]))

    def derivation(self, offsets: Sequence[Coordinate], *, pattern: str = "S123456") -> FamilyAnswer:
        """How A, c and det A of an equivalent platform follow from coplanar joints, with forward kinematics of both.

        Parameters
        ----------
        offsets : sequence of float, Fraction or str
            Shares of the edges, as in `equivalent`; a text such as ``"1/5"`` is exact.
        pattern : str
            A pattern of ``equipod equivalents family``.

        Returns
        -------
        FamilyAnswer
            ``derivation`` has the steps; shown in a notebook, the answer is the text.
        """
        from .records import FamilyAnswer

        with Workshop() as shop:
            words = ["equivalents", "family", shop.file("design.toml", self._native), "--explain"]
            return FamilyAnswer(ask([*words, f"--pattern={pattern}", f"--offsets={','.join(offset_texts(offsets))}"]))

    def equivalent(self, offsets: Sequence[Coordinate], *, pattern: str | None = None) -> Equivalent:
        """The equivalent platform of an octahedral design with these offsets.

        Parameters
        ----------
        offsets : sequence of float, Fraction or str
            Shares of the edges: six for the platform without shared joints, as many as the pattern has otherwise. Fractions
            and texts such as ``"1/5"`` stay exact; a text with a unit, ``"12/5 mm"``, is a length from the first corner of
            the edge.
        pattern : str, optional
            A pattern of ``equipod equivalents family``; without it the one with no shared joint.

        Returns
        -------
        Equivalent
        """
        design, a, c = self._native.equivalent(pattern, offset_texts(offsets))
        return Equivalent(Design(design), a, c)

    def optimize(
        self,
        *,
        seed: int = 1,
        threads: int | None = None,
        extension: float | None = None,
        drives: str | os.PathLike[str] | None = None,
        time_limit: float | None = None,
        progress: Progress | bool | None = None,
    ) -> tuple[Design | None, OptimizeAnswer]:
        """The best platform under the requirements of the design.

        Parameters
        ----------
        seed : int
        threads : int, optional
        extension : float, optional
            Greatest distance of a joint beyond the end of its edge, in edge lengths.
        drives : path, optional
            A table of drives, as for :meth:`drives`: the platform is searched with each drive that could win. The design has the chosen drive: the cheapest that meets the requirements, if every drive has a price. ``answer.drive_search`` has the result of each drive.
        time_limit : float, optional
            Seconds after which the search ends; the best platform so far is assessed.
        progress : callable or bool, optional
            Is given lines of text; True writes them on one line.

        Returns
        -------
        design : Design or None
            The best platform found, or the one with the least violation if none meets the requirements; None if there is neither.
        answer : OptimizeAnswer
            ``answer.status`` is the outcome of the search. After an interrupt the answer is the best so far.
        """
        from .records import OptimizeAnswer

        options = ["--seed", str(seed)]
        if threads is not None:
            options += ["--threads", str(threads)]
        if extension is not None:
            options += ["--extension", repr(float(extension))]
        if drives is not None:
            options += ["--drives", os.fspath(drives)]
        if time_limit is not None:
            options += ["--time-limit", repr(float(time_limit))]
        design, document = self._made("optimize", options, progress)
        return design, OptimizeAnswer(document)

    def explore(
        self,
        output: str | os.PathLike[str],
        *,
        seed: int = 1,
        extension: float | None = None,
        drives: str | os.PathLike[str] | None = None,
        options: Sequence[str] = (),
        progress: Progress | bool | None = None,
    ) -> ExploreAnswer:
        """All that the program finds out about the design, as files of a folder: the platforms with its kinematics, the best one without shared joints, the comparison with it, drawings and exports.

        Parameters
        ----------
        output : path
            The folder, made if missing. Results of an earlier run are replaced; the run is refused if it would replace another file.
        seed : int
        extension : float, optional
            Greatest distance of a joint beyond the end of its edge, in edge lengths.
        drives : path, optional
            A table of drives, as for :meth:`optimize`. For octahedral designs; another design with a table is refused.
        options : sequence of str
            Further options of ``equipod explore``.
        progress : callable or bool, optional

        Returns
        -------
        ExploreAnswer
            ``verdict`` and ``explanation`` say what was found, ``paths`` are the files.
        """
        from .records import ExploreAnswer

        arguments = ["--seed", str(seed), *options]
        if extension is not None:
            arguments += ["--extension", repr(float(extension))]
        if drives is not None:
            arguments += ["--drives", os.fspath(drives)]
        with Workshop() as shop:
            file = shop.file("design.toml", self._native)
            return ExploreAnswer(ask(["explore", file, "-o", os.fspath(output), *arguments], progress))

    def round(
        self, grid: float, *, options: Sequence[str] = (), progress: Progress | bool | None = None
    ) -> tuple[Design | None, RoundAnswer]:
        """The joints on a grid of holes, exactly equivalent or as near as the grid allows.

        Parameters
        ----------
        grid : float
            Distance between neighbouring holes.
        options : sequence of str
            Further options of ``equipod build round``.
        progress : callable or bool, optional

        Returns
        -------
        design : Design or None
        answer : RoundAnswer
        """
        from .records import RoundAnswer

        arguments = ["--grid", repr(float(grid)), *options]
        design, document = self._made(("build", "round"), arguments, progress)
        return design, RoundAnswer(document)

    def tolerances(
        self, length: float, degrees: float, *, options: Sequence[str] = (), progress: Progress | bool | None = None
    ) -> TolerancesAnswer:
        """Joint errors allowed for a pose error of at most `length` and `degrees`.

        Parameters
        ----------
        length : float
            Greatest error of the tool point.
        degrees : float
            Greatest error of the orientation.
        options : sequence of str
            Further options of ``equipod build tolerances``.
        progress : callable or bool, optional
        """
        from .records import TolerancesAnswer

        with Workshop() as shop:
            bound = f"{float(length)!r},{float(degrees)!r}"
            file = shop.file("design.toml", self._native)
            return TolerancesAnswer(ask(["build", "tolerances", file, "--bound", bound, *options], progress))

    def motion(
        self,
        times: npt.ArrayLike | None = None,
        poses: PoseLike | None = None,
        *,
        sine: Sequence[str] = (),
        accelerate: Sequence[str] = (),
        options: Sequence[str] = (),
        progress: Progress | bool | None = None,
    ) -> MotionAnswer:
        """Forces, speeds, accelerations and powers of the legs along a motion, by inverse dynamics, against the limits of the design.

        Parameters
        ----------
        times : array_like, shape (n,), optional
            Seconds, increasing, of the poses of a trajectory.
        poses : pose_like, shape (n, 4, 4), optional
            Its poses.
        sine : sequence of str
            Sines about home, ``"axis:amplitude:hertz"``: ``"z:100:0.5"``, turns in degrees.
        accelerate : sequence of str
            Accelerations from rest at home, ``"axis:acceleration"``, design units or degrees per second squared.
        options : sequence of str
            Further options of ``equipod motion``.
        progress : callable or bool, optional

        Returns
        -------
        MotionAnswer
            ``met`` is False if a requirement is violated at a sampled instant.
        """
        from .records import MotionAnswer

        with Workshop() as shop:
            words = ["motion", shop.file("design.toml", self._native)]
            if times is not None or poses is not None:
                if times is None or poses is None:
                    raise DesignError("a trajectory has times and poses", code="shape")
                words.append(shop.poses("trajectory.csv", times, self._rows(poses)))
            words += [f"--sine={text}" for text in sine] + [f"--accelerate={text}" for text in accelerate]
            return MotionAnswer(ask([*words, *options], progress))

    def drives(
        self,
        table: str | os.PathLike[str],
        *,
        sine: Sequence[str] = (),
        accelerate: Sequence[str] = (),
        options: Sequence[str] = (),
        progress: Progress | bool | None = None,
    ) -> DrivesAnswer:
        """The drives of a table that fit the design, the cheapest first.

        Parameters
        ----------
        table : path
            A drive a line; the first line names the columns: ``name,stroke_mm,dead_length_mm,force_N,speed_mm/s,mass_kg,stiffness_N/mm,price_EUR,source``.
        sine : sequence of str
            Sines about home along which the drives have to be fast and strong enough, ``"axis:amplitude:hertz"``.
        accelerate : sequence of str
            Accelerations from rest at home, ``"axis:acceleration"``.
        options : sequence of str
            Further options of ``equipod build drives``.
        progress : callable or bool, optional

        Returns
        -------
        DrivesAnswer
            ``met`` is True where a drive is proved to fit, ``chosen`` is its name, and ``design`` the design with it.
        """
        from .records import DrivesAnswer

        with Workshop() as shop:
            words = ["build", "drives", shop.file("design.toml", self._native), os.fspath(table)]
            words += [f"--sine={text}" for text in sine] + [f"--accelerate={text}" for text in accelerate]
            return DrivesAnswer(ask([*words, *options], progress))

    def calibrate(
        self,
        poses: PoseLike,
        lengths: npt.ArrayLike,
        *,
        sigma_length: float | None = None,
        sigma_position: float | None = None,
        sigma_rotation_deg: float | None = None,
        options: Sequence[str] = (),
        progress: Progress | bool | None = None,
    ) -> Calibrated:
        """The joints and leg offsets of the machine built from this design, from measured poses and lengths.

        Parameters
        ----------
        poses : pose_like, shape (n, 4, 4)
            As they were measured.
        lengths : array_like, shape (n, 6)
            The lengths measured at these poses.
        sigma_length, sigma_position : float, optional
            Standard deviations of a length and of each coordinate of a position, design units. Without the first one lengths count as equally uncertain and poses as
            exact, and how much is estimated.
        sigma_rotation_deg : float, optional
            Of each component of the rotation vector, degrees.
        options : sequence of str
            Further options of ``equipod calibrate``: ``["--loss=huber", "--frames=design"]``.
        progress : callable or bool, optional

        Returns
        -------
        Calibrated
            With the design, where the machine is identified and nothing refutes it.
        """
        from .records import CalibrateAnswer

        with Workshop() as shop:
            out = shop.path / "calibrated.toml"
            words = ["calibrate", shop.file("design.toml", self._native)]
            words += [shop.measurements("measurements.csv", self._rows(poses), _lengths(lengths)), "-o", str(out)]
            sigmas = {"length": sigma_length, "position": sigma_position, "rotation-deg": sigma_rotation_deg}
            words += [f"--sigma-{name}={float(x)!r}" for name, x in sigmas.items() if x is not None]
            record = CalibrateAnswer(ask([*words, *options], progress))
            return Calibrated(Design.load(out) if out.exists() else None, record)

    def export(self, format: ExportFormat) -> dict[str, str]:
        """The files of ``c``, ``csv``, ``dxf``, ``hal``, ``json``, ``matlab``, ``mjcf``, ``step``, ``stl`` or ``svg`` (a drawing): texts by names."""
        return dict(self._native.export(format))

    def plot(self, figure: FigureName = "modes", *options: str) -> Figure:
        """A picture of ``equipod plot``: ``modes``, ``workspace``, ``singular-poses``, ``det`` and others, with its options."""
        with Workshop() as shop:
            file = shop.file("design.toml", self._native)
            return Figure(text_of(["plot", figure, file, *options]))

    def view(self) -> Page:
        """The live page of the design."""
        with Workshop() as shop:
            file = shop.file("design.toml", self._native)
            page = shop.path / "page.html"
            ask(["view", file, "-o", str(page)])
            return Page(page.read_text(encoding="utf-8"))

    def _made(
        self, command: str | tuple[str, ...], options: Sequence[str], progress: Progress | bool | None
    ) -> tuple[Design | None, dict[str, Any]]:
        """The design that a command writes, with its answer."""
        words = [command] if isinstance(command, str) else list(command)
        with Workshop() as shop:
            file, out = shop.file("design.toml", self._native), shop.path / "out.toml"
            document = ask([*words, file, "-o", str(out), *options], progress)
            return (Design.load(out) if out.exists() else None), document

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Design) and self._native == other._native

    def __hash__(self) -> int:
        joints = self.joints
        # -0.0 and 0.0 are equal and have other bytes
        places = [(side + 0.0).tobytes() for side in (joints.base, joints.platform)]
        return hash((self.name, self.units, *places, joints.base_names, joints.platform_names))

    def __repr__(self) -> str:
        joints = self.joints
        return f"Design({self.name!r}, {len(joints.base)} base joints, {len(joints.platform)} platform joints, {self.units})"

    def _repr_html_(self) -> str:
        """Legs with their joints and lengths at home; the live page is :meth:`view`."""
        joints, rotary = self.joints, self.drive == "rotary"
        shown = np.degrees(self.ik(self.home)) if rotary else self.ik(self.home)
        heads = ("leg", "base joint", "x", "y", "z", "platform joint", "x", "y", "z")
        last = "angle at home [deg]" if rotary else f"length at home [{html.escape(self.units)}]"
        head = "".join(f"<th>{title}</th>" for title in (*heads, last))
        rows = "".join(
            f"<tr><td>{leg + 1}</td><td>{html.escape(joints.base_names[a])}</td>"
            + "".join(f"<td>{x:.6g}</td>" for x in joints.base[a])
            + f"<td>{html.escape(joints.platform_names[b])}</td>"
            + "".join(f"<td>{x:.6g}</td>" for x in joints.platform[b])
            + f"<td>{shown[leg]:.6g}</td></tr>"
            for leg, (a, b) in enumerate(joints.legs.tolist())
        )
        title = f"{html.escape(self.name)}, {self.drive} drive, {html.escape(self.units)}; <code>.view()</code> shows the live page"
        return f"<table><caption>{title}</caption><tr>{head}</tr>{rows}</table>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Design.loads, (self.dumps("json"), "json"))


#: Tables of a design file that limit something.
_REQUIRING = ("hardware", "limits", "speed", "stiffness", "loads", "keep_out", "payload", "envelope", "plates", "cranks")


def _table(document: dict[str, Any], key: str) -> dict[str, Any]:
    found: dict[str, Any] = document.get(key, {})
    return found


def _points(points: PointsLike) -> Floats:
    """Points as an array of float64 with shape (n, 3)."""
    try:
        array = np.ascontiguousarray(np.atleast_2d(np.asarray(points, dtype=np.float64)))
    except (TypeError, ValueError) as fault:
        raise DesignError(f"joints are rows of three numbers: {fault}", code="shape") from None
    if array.ndim != 2 or array.shape[1] != 3:
        raise DesignError(f"joints have the shape (n, 3), not {array.shape}", code="shape")
    return array


def _from_texts(points: list[list[list[Any]]], pairs: list[tuple[int, int]], name: str, units: str) -> Design:
    """A design whose joints are written, so that they are exact."""
    names = [[f"{letter}{k + 1}" for k in range(len(rows))] for letter, rows in zip("AB", points)]
    for k, rows in enumerate(names):
        if not all(0 <= pair[k] < len(rows) for pair in pairs):
            raise DesignError(f"legs name rows from 0 to {len(rows) - 1} of the {get_args(Body)[k]}", code="legs")
    base, platform = (dict(zip(own, rows)) for own, rows in zip(names, points))
    legs = [[names[0][a], names[1][b]] for a, b in pairs]
    return _read({"name": name, "units": units, "legs": legs, "base": base, "platform": platform})


def _read(document: dict[str, Any]) -> Design:
    """The design of a document that no file has: what is wrong is said with the key instead of a place in a text."""
    text = json.dumps(document, indent=1)
    try:
        return Design.loads(text, "json")
    except DesignError as fault:
        lines = text.splitlines()
        said = "; ".join(f"{_key_at(lines, f.line)}: {f.message}" for f in fault.faults) or str(fault)
        raise DesignError(said, code=fault.code, help=fault.help) from None


def _key_at(lines: list[str], line: int) -> str:
    """The key at a line of a JSON text with a value a line, or above it."""
    named = (above.split('"')[1] for above in reversed(lines[:line]) if '": ' in above)
    return next(named, "design")


def _is_json(format: TextFormat) -> bool:
    if format not in get_args(TextFormat):
        raise DesignError(f"a design is written as 'toml' or 'json', not {format!r}", code="format")
    return format == "json"


def leg_map(a: Design, b: Design) -> LegMap:
    """The affine map between the squared leg lengths of two designs, ``s(b) = A s(a) + c``.

    Parameters
    ----------
    a, b : Design
        In the same units and the same two frames.

    Returns
    -------
    LegMap
        ``A`` is None where there is no map; ``record`` says which legs have none.
    """
    from .records import MapAnswer

    found, record = _core.leg_map(a._native, b._native)
    numbers = (None, None) if found is None else found
    return LegMap(numbers[0], numbers[1], MapAnswer.from_json(record))


def compare(
    designs: Iterable[Design],
    *,
    sine: Sequence[str] = (),
    accelerate: Sequence[str] = (),
    accuracy: tuple[float, float] | None = None,
    options: Sequence[str] = (),
    progress: Progress | bool | None = None,
) -> CompareAnswer:
    """Designs in the same units side by side: margins, stroke, force, speed, power, conditioning, stiffness, spacing, clearance, sizes.

    Parameters
    ----------
    designs : iterable of Design
    sine, accelerate : sequence of str
        Manoeuvres along which forces, speeds and powers are taken, as for `Design.motion`.
    accuracy : (float, float), optional
        Accuracy of the pose, length and degrees, for which joints are toleranced.
    options : sequence of str
        Further options of ``equipod compare``.
    progress : callable or bool, optional

    Returns
    -------
    CompareAnswer
        ``designs`` has a record for each, in order; ``equipod.table(answer.designs)`` is an Arrow table.
    """
    from .records import CompareAnswer

    with Workshop() as shop:
        words = ["compare", *(shop.file(f"design-{k}.toml", d._native) for k, d in enumerate(designs))]
        words += [f"--sine={text}" for text in sine] + [f"--accelerate={text}" for text in accelerate]
        if accuracy is not None:
            words.append(f"--accuracy={float(accuracy[0])!r},{float(accuracy[1])!r}")
        return CompareAnswer(ask([*words, *options], progress))


def verify(a: Design, b: Design, *, samples: int = 10, seed: int = 1, threads: int | None = None) -> VerifyAnswer:
    """Whether two designs are kinematically equivalent: by their leg map, and by forward kinematics of both, which knows nothing of the map.

    Parameters
    ----------
    a, b : Design
    samples : int
        At how many sets of lengths both are solved.
    seed : int
    threads : int, optional

    Returns
    -------
    VerifyAnswer
        ``verdict`` is ``equivalent``, ``not_equivalent``, ``singular`` or ``inconclusive``.
    """
    from .records import VerifyAnswer

    return VerifyAnswer.from_json(_core.verify(a._native, b._native, _whole("samples", samples), _whole("seed", seed), _threads(threads)))


"""All poses with given leg lengths: for one set of lengths, and for many."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import DesignError
from ._poses import Floats, PoseLike, as_matrices
from ._words import Completeness, Method

if TYPE_CHECKING:
    import pyarrow  # type: ignore[import-untyped]

    from ._design import Design
    from .records import CertificateRecord, ClosureRecord, FkAnswer, RotationPolynomialRecord

COMPLETENESS = {3: "proved_bounded", 2: "proved", 1: "modular", 0: "unproved", -1: "failed"}


@dataclass(frozen=True, repr=False)
class Solution:
    """One pose with its evidence.

    Attributes
    ----------
    T : ndarray, complex128, shape (4, 4)
        The pose, ``[[R, p], [0, 1]]``.
    real : bool or None
        Whether the pose is real; None where that is not decided.
    certified : bool
        Whether a pose is proved to be there.
    residual : float
        Largest error of the leg equations over the squared size of the design.
    multiplicity : int
        How often the pose counts.
    """

    T: npt.NDArray[np.complex128]
    real: bool | None
    certified: bool
    residual: float
    multiplicity: int

    @property
    def transform(self) -> Floats:
        """The real pose, float64, shape (4, 4); DesignError where the pose is not real."""
        if self.real is not True:
            raise DesignError("the pose is not real, or not known to be", code="pose")
        return np.ascontiguousarray(self.T.real)

    def __repr__(self) -> str:
        kind = {True: "real", False: "not real", None: "real or not: undecided"}[self.real]
        p = self.T[:3, 3]
        position = ", ".join(f"{z.real:.6g}" if self.real else f"{z:.4g}" for z in p)
        return f"Solution({kind}, {'certified' if self.certified else 'no certificate'}, p=({position}))"


#: Design, lengths, seed, method, and whether poses are counted.
_Question = tuple["Design", list[float], int, "Method | None", bool]


def _solved(design: Design, lengths: list[float], seed: int, method: Method | None, pose_count: bool) -> Solutions:
    return design.fk(lengths, seed=seed, method=method, pose_count=pose_count)


class Solutions(Sequence[Solution]):
    """All finite poses, real and complex, with one set of leg lengths; real ones first.

    Attributes
    ----------
    T : ndarray, complex128, shape (n, 4, 4)
        The poses.
    real : ndarray, bool, shape (n,)
        True for real poses; undecided poses count as not real, see `reality`.
    reality : ndarray, int8, shape (n,)
        1 real, 0 not real, -1 undecided.
    certified : ndarray, bool, shape (n,)
        True for poses with a certificate.
    residual : ndarray, float64, shape (n,)
        Largest errors of the leg equations over the squared size of the design.
    multiplicity : ndarray, uint32, shape (n,)
        How often each pose counts.
    """

    # the arrays are made when they are first asked for: a control loop reads one or two of them

    def __init__(self, native: _core.Solutions, question: _Question) -> None:
        self._native = native
        self._question = question

    def __reduce__(self) -> tuple[Any, ...]:
        # computed again where it is read: the same question has the same answer
        return (_solved, self._question)

    @cached_property
    def T(self) -> npt.NDArray[np.complex128]:
        """The poses, complex128, shape (n, 4, 4)."""
        return self._native.transforms()

    @property
    def transforms(self) -> npt.NDArray[np.complex128]:
        """The poses, complex128, shape (n, 4, 4); the same as ``T``."""
        return self.T

    @cached_property
    def reality(self) -> npt.NDArray[np.int8]:
        """1 real, 0 not real, -1 undecided; int8, shape (n,)."""
        return self._native.reality()

    @cached_property
    def real(self) -> npt.NDArray[np.bool_]:
        """True for real poses; bool, shape (n,)."""
        real: npt.NDArray[np.bool_] = self.reality == 1
        return real

    @cached_property
    def certified(self) -> npt.NDArray[np.bool_]:
        """True for poses with a certificate; bool, shape (n,)."""
        return self._native.certified()

    @cached_property
    def residual(self) -> npt.NDArray[np.float64]:
        """Largest errors of the leg equations over the squared size of the design; float64, shape (n,)."""
        return self._native.residual()

    @cached_property
    def multiplicity(self) -> npt.NDArray[np.uint32]:
        """How often each pose counts; uint32, shape (n,)."""
        return self._native.multiplicity()

    @property
    def complete(self) -> bool:
        """Whether all poses are listed: by proof, or by a count modulo random primes (see `completeness`)."""
        return self._native.is_complete()

    @property
    def completeness(self) -> Completeness:
        """``proved``, ``proved_bounded`` (all real poses), ``modular`` (by a count with a bound on the probability of error) or ``unproved``."""
        return self._native.completeness()

    @property
    def reason(self) -> str:
        """One sentence on what is known of completeness."""
        return self._native.reason()

    @property
    def self_motion(self) -> int:
        """Dimension of the curve or surface of poses that the platform has with these lengths, as it was seen: at least so many; 0 where poses are isolated. Points of it are ``record.witness_points``."""
        return self._native.dimension()

    @property
    def method(self) -> str:
        """The method that found the poses."""
        return self._native.method()

    @property
    def real_transforms(self) -> Floats:
        """The real poses, float64, shape (m, 4, 4)."""
        return np.ascontiguousarray(self.T[self.real].real)

    @property
    def nearest_home(self) -> int | None:
        """The index of the real pose nearest to home, where the machine usually is; None where there is no real pose."""
        return self._native.nearest_home()

    def nearest(self, pose: PoseLike, *, length: float | None = None) -> Solution | None:
        """The real pose nearest to another one.

        Parameters
        ----------
        pose : array_like, shape (4, 4)
        length : float, optional
            The length that a rotation of one radian counts as; the largest ``|p|`` of the real poses when absent.

        Returns
        -------
        Solution or None
            None where there is no real pose.
        """
        there = self.real_transforms
        if len(there) == 0:
            return None
        target = as_matrices(pose)
        shift = np.linalg.norm(there[:, :3, 3] - target[:3, 3], axis=1)
        turn = np.linalg.norm(there[:, :3, :3] - target[:3, :3], axis=(1, 2)) / np.sqrt(2)
        weight = float(np.max(np.linalg.norm(there[:, :3, 3], axis=1))) if length is None else length
        return self[int(np.flatnonzero(self.real)[np.argmin(shift + weight * turn)])]

    @cached_property
    def record(self) -> FkAnswer:
        """The answer of ``equipod fk --json`` as typed record, certificates included."""
        from .records import FkAnswer

        return FkAnswer.from_json(self._native.json())

    def rotation_polynomial(self) -> RotationPolynomialRecord:
        """The polynomial in the Cayley parameter ``c3 = z / w`` of the quaternion ``(w, x, y, z)`` of the rotation, with a root for each pose.

        Returns
        -------
        RotationPolynomialRecord
            As ``equipod fk --polynomial`` has it: of degree 40 for a general platform, with enclosed coefficients; ``error`` says why there is none.

        Raises
        ------
        DesignError
            A design with cranks.
        """
        from .records import RotationPolynomialRecord

        return RotationPolynomialRecord.from_json(self._native.rotation_polynomial())

    def closure(self, base: str, platform: str) -> ClosureRecord:
        """The closure polynomial in the squared distance of a base joint and a platform joint that no leg joins.

        Parameters
        ----------
        base, platform : str
            The names of the joints.

        Returns
        -------
        ClosureRecord
            As ``equipod fk --between`` has it: integer coefficients of the doubles, and the real roots counted by Sturm; ``error`` says why there is none.

        Raises
        ------
        DesignError
            No such joint; a design with cranks.
        """
        from .records import ClosureRecord

        joints = self._question[0].joints
        pair = []
        for name, known, body in ((base, joints.base_names, "base"), (platform, joints.platform_names, "platform")):
            if name not in known:
                raise DesignError(f"{name!r} is no joint of the {body}, which has {', '.join(known)}", code="joint")
            pair.append(known.index(name))
        return ClosureRecord.from_json(self._native.closure((pair[0], pair[1])))

    @property
    def certificates(self) -> tuple[CertificateRecord | None, ...]:
        """The certificate of each pose, with all numbers of its proof."""
        return tuple(solution.certificate for solution in self.record.solutions or ())

    def to_dict(self) -> dict[str, Any]:
        """The fields of ``equipod fk --json``."""
        return self.record.to_dict()

    def __len__(self) -> int:
        return len(self._native)

    @overload
    def __getitem__(self, index: int) -> Solution: ...
    @overload
    def __getitem__(self, index: slice) -> list[Solution]: ...
    def __getitem__(self, index: int | slice) -> Solution | list[Solution]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        k = range(len(self))[index]
        known = {1: True, 0: False, -1: None}
        return Solution(
            T=self.T[k],
            real=known[int(self.reality[k])],
            certified=bool(self.certified[k]),
            residual=float(self.residual[k]),
            multiplicity=int(self.multiplicity[k]),
        )

    def __repr__(self) -> str:
        return (
            f"Solutions({len(self)} poses, {int(self.real.sum())} real, {int(self.certified.sum())} certified, "
            f"{self.completeness})"
        )

    def _repr_html_(self) -> str:
        machine = self.nearest_home
        rows = "".join(
            f"<tr><td>{k}</td><td>{ {1: 'yes', 0: 'no', -1: 'undecided'}[int(self.reality[k])] }</td>"
            + "".join(f"<td>{z.real:.6g}{'' if self.real[k] else f' {z.imag:+.3g}i'}</td>" for z in self.T[k, :3, 3])
            + f"<td>{'yes' if self.certified[k] else 'no'}{', nearest to home' if k == machine else ''}</td></tr>"
            for k in range(len(self))
        )
        head = "".join(f"<th>{name}</th>" for name in ("", "real", "x", "y", "z", "certified"))
        return f"<table><caption>{len(self)} poses, {self.reason}</caption><tr>{head}</tr>{rows}</table>"


class BatchSolutions(Sequence["RowPoses"]):
    """All poses with many sets of leg lengths, ragged: row ``k`` has the poses from ``offsets[k]`` to ``offsets[k + 1]``.

    Attributes
    ----------
    shape : tuple of int
        The leading axes of the lengths; rows are in the order of its elements.
    T : ndarray, complex128, shape (n, 4, 4)
        The poses of all rows; float64 where real poses alone are kept.
    offsets : ndarray, int64, shape (rows + 1,)
        Index of the first pose of each row, and of the end.
    reality : ndarray, int8, shape (n,)
        1 real, 0 not real, -1 undecided.
    real, certified : ndarray, bool, shape (n,)
    residual : ndarray, float64, shape (n,)
    multiplicity : ndarray, uint32, shape (n,)
    completeness : ndarray, int8, shape (rows,)
        3 all real poses proved, 2 proved, 1 modular, 0 unproved, -1 the row failed.
    undecided : ndarray, uint32, shape (rows,)
        Poses of which it is not decided whether they are real; they are not among those of ``real_only=True``.
    """

    T: npt.NDArray[np.complex128] | Floats

    def __init__(self, arrays: _core._BatchArrays, shape: tuple[int, ...]) -> None:
        self.shape = shape
        (
            self.T,
            self.reality,
            self.certified,
            self.residual,
            self.multiplicity,
            self.offsets,
            self.completeness,
            self.undecided,
            self._reason,
            self._reasons,
        ) = arrays
        self.real: npt.NDArray[np.bool_] = self.reality == 1

    @property
    def transforms(self) -> npt.NDArray[np.complex128] | Floats:
        """The poses of all rows, shape (n, 4, 4); the same as ``T``."""
        return self.T

    @property
    def complete(self) -> npt.NDArray[np.bool_]:
        """True for rows whose poses are complete, by proof or modulo random primes; bool, shape (rows,)."""
        return self.completeness >= 1

    @property
    def failed(self) -> npt.NDArray[np.int64]:
        """The rows that could not be solved; `reason` says why."""
        return np.flatnonzero(self.completeness == -1)

    def reason(self, row: int) -> str:
        """The evidence for the completeness of a row, or why it failed."""
        return self._reasons[int(self._reason[row])]

    def counts(self, *, real: bool = False) -> npt.NDArray[np.int64]:
        """How many poses each row has, int64, shape (rows,); with `real` the real ones."""
        if not real:
            return np.diff(self.offsets)
        total = np.concatenate([[0], np.cumsum(self.real, dtype=np.int64)])
        counts: npt.NDArray[np.int64] = np.diff(total[self.offsets])
        return counts

    def __len__(self) -> int:
        return len(self.completeness)

    @overload
    def __getitem__(self, index: int | tuple[int, ...]) -> RowPoses: ...
    @overload
    def __getitem__(self, index: slice) -> list[RowPoses]: ...
    def __getitem__(self, index: int | tuple[int, ...] | slice) -> RowPoses | list[RowPoses]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if isinstance(index, tuple):
            if len(index) != len(self.shape):
                raise IndexError(f"a row of a batch of shape {self.shape} has {len(self.shape)} indices, not {len(index)}")
            places = tuple(range(n)[i] for i, n in zip(index, self.shape))
            index = int(np.ravel_multi_index(places, self.shape))
        k = range(len(self))[index]
        part = slice(int(self.offsets[k]), int(self.offsets[k + 1]))
        return RowPoses(
            T=self.T[part],
            reality=self.reality[part],
            certified=self.certified[part],
            residual=self.residual[part],
            multiplicity=self.multiplicity[part],
            completeness=COMPLETENESS[int(self.completeness[k])],
            reason=self.reason(k),
        )

    def __iter__(self) -> Iterator[RowPoses]:
        return (self[k] for k in range(len(self)))

    def __repr__(self) -> str:
        words = ", ".join(
            f"{int((self.completeness == code).sum())} {word}"
            for code, word in COMPLETENESS.items()
            if (self.completeness == code).any()
        )
        return f"BatchSolutions({len(self)} rows, {len(self.reality)} poses; rows {words})"

    def to_arrow(self) -> pyarrow.Table:
        """The poses as an Arrow table, one row a pose, which polars, pandas and duckdb read.

        Columns: ``row``, ``reality``, ``certified``, ``residual``, ``multiplicity``, and ``x y z`` with the nine entries ``r11..r33`` of the
        rotation as real and imaginary parts (``x_re``, ``x_im``, ..), or as numbers (``x``, ..) where real poses alone are kept.
        Needs pyarrow (``pip install equipod[tables]``).
        """
        import pyarrow as pa

        columns: dict[str, Any] = {
            "row": np.repeat(np.arange(len(self)), self.counts()),
            "reality": self.reality,
            "certified": self.certified,
            "residual": self.residual,
            "multiplicity": self.multiplicity,
        }
        entries = {name: self.T[:, k, 3] for k, name in enumerate("xyz")}
        entries |= {f"r{i + 1}{j + 1}": self.T[:, i, j] for i in range(3) for j in range(3)}
        for name, entry in entries.items():
            if np.iscomplexobj(entry):
                columns[f"{name}_re"], columns[f"{name}_im"] = entry.real.copy(), entry.imag.copy()
            else:
                columns[name] = entry.copy()
        return pa.table(columns)


@dataclass(frozen=True, repr=False)
class RowPoses:
    """The poses of one row of a batch, as views of its arrays; certificates are not kept.

    Attributes
    ----------
    T : ndarray, complex128, shape (n, 4, 4)
        Float64 where real poses alone are kept.
    reality : ndarray, int8, shape (n,)
    certified : ndarray, bool, shape (n,)
    residual : ndarray, float64, shape (n,)
    multiplicity : ndarray, uint32, shape (n,)
    completeness : str
        ``proved``, ``modular``, ``unproved`` or ``failed``.
    reason : str
        The evidence for completeness, or why the row failed.
    """

    T: npt.NDArray[np.complex128] | Floats
    reality: npt.NDArray[np.int8]
    certified: npt.NDArray[np.bool_]
    residual: npt.NDArray[np.float64]
    multiplicity: npt.NDArray[np.uint32]
    completeness: str
    reason: str

    @property
    def transforms(self) -> npt.NDArray[np.complex128] | Floats:
        """The poses, shape (n, 4, 4); the same as ``T``."""
        return self.T

    @property
    def complete(self) -> bool:
        """Whether all poses are there."""
        return self.completeness in ("proved", "proved_bounded", "modular")

    @property
    def real_transforms(self) -> Floats:
        """The real poses, float64, shape (m, 4, 4)."""
        return np.ascontiguousarray(self.T[self.reality == 1].real)

    def __len__(self) -> int:
        return len(self.reality)

    def __repr__(self) -> str:
        return f"RowPoses({len(self)} poses, {int((self.reality == 1).sum())} real, {self.completeness})"

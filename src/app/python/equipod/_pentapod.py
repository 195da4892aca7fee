"""Designs of five legs."""

from __future__ import annotations

import json
import os
import pathlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._design import _is_json, _points, _whole
from ._errors import DesignError
from ._exact import PointsLike, as_texts
from ._poses import Floats
from ._words import TextFormat

if TYPE_CHECKING:
    from .records import PentapodAnswer


class Pentapod:
    """A platform on five legs. Where all joints of a body lie on a line, the legs hold this line; the turn about it is free.

    Made by `load`, `loads` or `from_arrays`; it does not change.

    >>> import equipod
    >>> line = [[0, 0, 0], [1, 0, 0], [3, 0, 0], [4, 0, 0], [6, 0, 0]]
    >>> plane = [[0, 0, 0], [4, 0, 0], [6, 3, 0], [3, 6, 0], [-1, 5, 0]]
    >>> legs = equipod.Pentapod.from_arrays(plane, line)
    >>> legs.check().architecturally_singular
    False
    """

    def __init__(self, native: _core.FiveLegs) -> None:
        self._native = native

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Pentapod:
        """Reads a design file of five legs, TOML or JSON (``.json``).

        Raises
        ------
        DesignError
            With everything that is wrong with the file, and where; a design of another number of legs.
        OSError
            A file that cannot be read.
        """
        file = pathlib.Path(path)
        return cls.loads(file.read_text(encoding="utf-8"), "json" if file.suffix == ".json" else "toml")

    @classmethod
    def loads(cls, text: str, format: TextFormat = "toml") -> Pentapod:
        """Reads the text of a design of five legs, ``"toml"`` or ``"json"``."""
        return cls(_core.FiveLegs.loads(text, _is_json(format)))

    @classmethod
    def from_arrays(
        cls,
        base: PointsLike,
        platform: PointsLike,
        *,
        lengths: npt.ArrayLike | None = None,
        name: str = "pentapod",
        units: str = "mm",
    ) -> Pentapod:
        """Five legs from their ends.

        Parameters
        ----------
        base, platform : array_like, shape (5, 3)
            The ends of leg ``i`` are in row ``i``, in the forms of `Design.from_arrays`; fractions and texts are exact.
        lengths : array_like, shape (5,), optional
            Leg lengths, for `fk`.
        name, units : str

        Raises
        ------
        DesignError
            Arrays of another shape, a text that is no expression.
        """
        rows: list[list[list[Any]]] = [
            own if own is not None else _points(points).tolist() for own, points in ((as_texts(p), p) for p in (base, platform))
        ]
        if any(len(own) != 5 for own in rows):
            raise DesignError(f"five legs have five ends on each body, not {[len(own) for own in rows]}", code="legs")
        ends = [{f"{letter}{k + 1}": row for k, row in enumerate(own)} for letter, own in zip("AB", rows)]
        document: dict[str, Any] = {"name": name, "units": units, "legs": [list(pair) for pair in zip(*ends)]}
        document |= {"base": ends[0], "platform": ends[1]}
        if lengths is not None:
            document["lengths"] = _five(lengths)
        return cls.loads(json.dumps(document), "json")

    @property
    def name(self) -> str:
        """The name of the design."""
        return self._native.name

    @property
    def units(self) -> str:
        """The unit of all lengths."""
        return self._native.units

    @property
    def base_ends(self) -> Floats:
        """The base end of each leg, base frame, shape (5, 3)."""
        return self._native.ends()[0]

    @property
    def platform_ends(self) -> Floats:
        """The platform end of each leg, platform frame, shape (5, 3)."""
        return self._native.ends()[1]

    @property
    def leg_names(self) -> tuple[tuple[str, str], ...]:
        """The names of the base joint and of the platform joint of each leg."""
        return tuple(self._native.leg_names())

    @property
    def lengths(self) -> Floats | None:
        """The leg lengths of the file, shape (5,); None where it has none."""
        return self._native.lengths()

    def check(self, *, seed: int = 1) -> PentapodAnswer:
        """The line that the legs hold, its singular poses, and the sixth legs that decouple the platform.

        Parameters
        ----------
        seed : int
            Seed of the lengths for which poses are counted.

        Returns
        -------
        PentapodAnswer
            ``line`` with its class and the polynomial of its singular poses; ``architecturally_singular``; ``sixth_legs``.
        """
        return self._about(None, seed)

    def fk(self, lengths: npt.ArrayLike | None = None, *, seed: int = 1) -> PentapodAnswer:
        """All poses of the line that the legs hold, real and complex, proved to be all.

        Parameters
        ----------
        lengths : array_like, shape (5,), optional
            In design units; those of the file when absent.
        seed : int
            As for `check`.

        Returns
        -------
        PentapodAnswer
            ``poses`` has position and direction of the line in the frame of the other body with bounds of their errors; ``no_poses`` says why there are none.

        Raises
        ------
        DesignError
            No lengths; values that are no lengths; legs that hold no line, so that the poses form a curve.
        """
        given = self.lengths if lengths is None else lengths
        if given is None:
            raise DesignError("the design has no `lengths`, and none were given", code="lengths")
        return self._about(_five(given), seed)

    def _about(self, lengths: list[float] | None, seed: int) -> PentapodAnswer:
        from .records import PentapodAnswer

        return PentapodAnswer.from_json(self._native.about(lengths, _whole("seed", seed)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Pentapod) and self._native == other._native

    def __hash__(self) -> int:
        return hash((self.name, self.units, self.leg_names))

    def __repr__(self) -> str:
        return f"Pentapod({self.name!r}, {self.units})"

    def __reduce__(self) -> tuple[Any, ...]:
        text, is_json = self._native.text()
        return (Pentapod.loads, (text, "json" if is_json else "toml"))


def _five(lengths: npt.ArrayLike) -> list[float]:
    try:
        array = np.asarray(lengths, dtype=np.float64)
    except (TypeError, ValueError) as fault:
        raise DesignError(f"leg lengths are numbers: {fault}", code="lengths") from None
    if array.shape != (5,):
        raise DesignError(f"five legs have five lengths, not an array of shape {array.shape}", code="shape")
    if not np.all((array >= 0) & np.isfinite(array)):
        raise DesignError("leg lengths are finite and not negative", code="lengths")
    five: list[float] = array.tolist()
    return five

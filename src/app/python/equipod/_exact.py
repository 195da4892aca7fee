"""Numbers that are exact: fractions, decimals and texts, as design files have them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeAlias, Union

import numpy as np
import numpy.typing as npt

from ._errors import DesignError

#: A coordinate: a number, or a text such as ``"6*sqrt(3)"``.
Coordinate: TypeAlias = Union[float, int, str, Fraction, Decimal]

#: Points as rows of three coordinates.
PointsLike: TypeAlias = Union[npt.ArrayLike, Sequence[Sequence[Coordinate]]]

#: Whole numbers up to this are doubles.
_DOUBLES = 2**53


def as_texts(points: PointsLike) -> list[list[Any]] | None:
    """Points with a text, a fraction or a decimal among their coordinates, as a design file has them; None: all are numbers."""
    if isinstance(points, np.ndarray) and points.dtype.kind in "fiub":
        return None
    try:
        array = np.asarray(points, dtype=object)
    except ValueError as fault:
        raise DesignError(f"joints are rows of three coordinates: {fault}", code="shape") from None
    entries = array.ravel().tolist()
    if not any(_exact(x) for x in entries):
        return None
    if array.ndim != 2 or array.shape[1] != 3:
        raise DesignError(f"joints have the shape (n, 3), not {array.shape}", code="shape")
    return [[plain(x) for x in row] for row in array.tolist()]


def _exact(x: Any) -> bool:
    return isinstance(x, (str, Fraction, Decimal)) or (isinstance(x, int) and abs(x) > _DOUBLES)


def plain(value: Any) -> Any:
    """A value as JSON has it: arrays as lists, fractions and decimals as texts."""
    if isinstance(value, Mapping):
        return {str(key): plain(x) for key, x in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, (list, tuple)):
        return [plain(x) for x in value]
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, Decimal):
        return _finite(value, value.is_finite()) and f"{value}"
    if isinstance(value, (bool, str)) or value is None:
        return value
    if isinstance(value, int):
        return str(value) if abs(value) > _DOUBLES else value
    if isinstance(value, float):
        return _finite(value, math.isfinite(value)) and value
    raise DesignError(f"{value!r} has no form in a design file", code="design::wrong_type")


def offset_texts(offsets: Sequence[Coordinate]) -> list[str]:
    """Offsets as they are written."""
    return [str(x) if isinstance(x, (str, Fraction, Decimal)) else repr(float(x)) for x in offsets]


def _finite(value: object, finite: bool) -> bool:
    if not finite:
        raise DesignError(f"{value!r} is not finite", code="design::not_finite")
    return True

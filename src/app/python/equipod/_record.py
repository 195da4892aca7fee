"""The common base of all answers."""

from __future__ import annotations

import copy
import json
import types
import typing
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Callable, ClassVar, TypeVar

from . import _core

if TYPE_CHECKING:
    import pyarrow  # type: ignore[import-untyped]

R = TypeVar("R", bound="Record")
Reader = Callable[[Any], Any]


class Record:
    """An answer, or a part of one: the fields of the JSON document as attributes.

    A field that the document does not have is None. `to_dict` gives the document itself.
    """

    _readers: ClassVar[dict[str, Reader] | None] = None
    _document: dict[str, Any]

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document
        for name, read in self._fields().items():
            value = document.get(name[:-1] if name.endswith("_") else name)
            setattr(self, name, None if value is None else read(value))

    @classmethod
    def _fields(cls) -> dict[str, Reader]:
        if cls.__dict__.get("_readers") is None:
            hints = typing.get_type_hints(cls)
            own = {name: hint for name, hint in hints.items() if not name.startswith("_")}
            cls._readers = {name: _reader(hint) for name, hint in own.items()}
        assert cls._readers is not None
        return cls._readers

    @classmethod
    def from_json(cls: type[R], text: str) -> R:
        """The record of a JSON document."""
        return cls(json.loads(text))

    def to_dict(self) -> dict[str, Any]:
        """The document as dictionaries and lists, as ``equipod --json`` prints it."""
        return copy.deepcopy(self._document)

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self._document == typing.cast(Record, other)._document

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={_short(getattr(self, name))}" for name in self._fields())
        return f"{type(self).__name__}({shown})"

    def _repr_html_(self) -> str:
        return _core.sheet_html(json.dumps(self._document))


def _short(value: Any, limit: int = 60) -> str:
    if isinstance(value, Record):
        return f"{type(value).__name__}(...)"
    if isinstance(value, tuple) and value and isinstance(value[0], Record):
        return f"({len(value)} x {type(value[0]).__name__})"
    text = repr(value)
    return text if len(text) <= limit else text[: limit - 3] + "..."


def _reader(hint: Any) -> Reader:
    """A function that converts a JSON value to a type."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        records = [p for p in parts if isinstance(p, type) and issubclass(p, Record)]
        others = [_reader(p) for p in parts if p not in records and p is not type(None)]
        return lambda value: _one_of(records, others, value)
    if origin is tuple:
        if len(parts) == 2 and parts[1] is Ellipsis:
            item = _reader(parts[0])
            return lambda value: tuple(None if x is None else item(x) for x in value)
        readers = [_reader(p) for p in parts]
        return lambda value: tuple(None if x is None else r(x) for r, x in zip(readers, value))
    if origin is dict:
        item = _reader(parts[1])
        return lambda value: {key: None if x is None else item(x) for key, x in value.items()}
    if isinstance(hint, type) and issubclass(hint, Record):
        return hint
    if hint is float:
        return float
    return lambda value: value


def _one_of(records: list[type[Record]], others: list[Reader], value: Any) -> Any:
    if isinstance(value, dict) and records:
        # the type of which most fields are there
        fitting = max(records, key=lambda r: (set(value) <= _keys(r), -len(_keys(r) - set(value))))
        return fitting(value)
    if isinstance(value, list):
        for read in others:
            made = read(value)
            if isinstance(made, tuple):
                return made
    return value


def _keys(record: type[Record]) -> set[str]:
    return {name[:-1] if name.endswith("_") else name for name in record._fields()}


def table(records: Iterable[Record]) -> pyarrow.Table:
    """Records of one type, the requirements of an assessment for instance, as an Arrow table with a row each; needs pyarrow."""
    import pyarrow as pa

    return pa.Table.from_pylist([record.to_dict() for record in records])

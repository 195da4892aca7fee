"""Exceptions for bad input."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence


@dataclass(frozen=True)
class Fault:
    """A fault of a design text, with its place.

    Attributes
    ----------
    code : str
        Stable name, ``"design::unknown_key"`` for example.
    line, column : int
        Place in the text, from 1.
    message : str
        The fault.
    help : str
        The remedy.
    """

    code: str
    line: int
    column: int
    message: str
    help: str


class DesignError(ValueError):
    """A design, an array or an option that the question cannot be asked with.

    Answers of *no* and of *not known* are values and raise nothing.

    Attributes
    ----------
    code : str
        Stable name of what is wrong.
    faults : tuple of Fault
        Everything that is wrong with a design text, with places; empty for other input.
    line, column : int or None
        Place of the first fault.
    help : str or None
        Help on the first fault.
    """

    def __init__(
        self,
        message: str,
        *,
        code: str = "design",
        faults: Sequence[tuple[str, int, int, str, str]] = (),
        help: str | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.faults = tuple(Fault(*fault) for fault in faults)
        first = self.faults[0] if self.faults else None
        self.line = first.line if first else None
        self.column = first.column if first else None
        self.help = first.help if first else help


class CommandError(RuntimeError):
    """The program broke down, or a computation did not come to an answer.

    Attributes
    ----------
    code : str
        Stable name of the failure.
    """

    def __init__(self, message: str, *, code: str = "internal") -> None:
        super().__init__(message)
        self.code = code

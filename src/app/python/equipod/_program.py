"""Questions that take long, asked of the program inside this process. Its answers are those of the command line, and an interrupt ends it with the best so far."""

from __future__ import annotations

import json
import pathlib
import sys
import tempfile
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import CommandError, DesignError
from ._poses import Floats, PoseLike, as_matrices, quaternion

#: What progress is reported to: a line of text at a time.
Progress = Callable[[str], None]


def shown(line: str) -> None:
    """Progress on one line of standard error, which is written over."""
    sys.stderr.write("\r\x1b[K" + line[:160])
    sys.stderr.flush()


class Workshop:
    """A folder for the files of one question, gone afterwards."""

    def __init__(self) -> None:
        # after an interrupt the command may still write for a moment
        self._folder = tempfile.TemporaryDirectory(prefix="equipod-", ignore_cleanup_errors=True)
        self.path = pathlib.Path(self._folder.name)

    def __enter__(self) -> Workshop:
        return self

    def __exit__(self, *_: object) -> None:
        self._folder.cleanup()

    def file(self, name: str, design: _core.Design) -> str:
        """A design as a file."""
        path = self.path / name
        path.write_text(design.dumps(False), encoding="utf-8")
        return str(path)

    def poses(self, name: str, times: npt.ArrayLike, poses: Floats) -> str:
        """Times and poses, shape (n, 7) in the convention of the design with the scalar first, as a table to the last digit."""
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        if len(seconds) != len(poses):
            raise DesignError(f"{len(seconds)} times and {len(poses)} poses", code="shape")
        return self._table(name, "time,x,y,z,qw,qx,qy,qz", np.column_stack([seconds, poses]))

    def measurements(self, name: str, poses: Floats, lengths: npt.NDArray[np.float64]) -> str:
        """Poses, as in `poses`, with lengths as a table to the last digit."""
        rows = lengths.reshape(-1, 6)
        if len(rows) != len(poses):
            raise DesignError(f"{len(poses)} poses and {len(rows)} rows of lengths", code="shape")
        return self._table(name, "x,y,z,qw,qx,qy,qz,l1,l2,l3,l4,l5,l6", np.column_stack([poses, rows]))

    def _table(self, name: str, header: str, rows: Floats) -> str:
        lines = [header, *(",".join(map(repr, row.tolist())) for row in rows)]
        path = self.path / name
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)


def pose_text(pose: PoseLike) -> str:
    """One pose as options take it, to the last digit: ``base:x,y,z,qw,qx,qy,qz``, whatever convention a design has."""
    array = as_matrices(pose)
    if array.shape != (4, 4):
        raise DesignError(f"one pose is a matrix of shape (4, 4), not {array.shape}", code="shape")
    return "base:" + ",".join(map(repr, [*array[:3, 3].tolist(), *quaternion(array).tolist()]))


def ask(arguments: Sequence[str], progress: Progress | bool | None = None) -> dict[str, Any]:
    """The JSON document of a command.

    Answers of no (exit code 1) and of not known (3) are documents as those of yes. The first interrupt asks the command for the best so far. Where there is
    none, and at the second interrupt, `KeyboardInterrupt` is raised.
    """
    observer = shown if progress is True else progress or None
    code, text, said = _core.ask(["equipod", *arguments, "--json", *(["--quiet"] if observer is None else [])], observer)
    if observer is shown:
        sys.stderr.write("\r\x1b[K")
    if not text:
        raise CommandError(said or f"the command ended with exit code {code}")
    document: dict[str, Any] = json.loads(text)
    error = document.get("error")
    if error is None:
        return document
    advice = error.get("help")
    message = error["message"] + (f"; {advice}" if advice else "")
    if code != 2:
        raise CommandError(message, code=error["code"])
    faults = [(v["code"], v["line"], v["column"], v["message"], v["help"]) for v in error["violations"]]
    raise DesignError(message, code=error["code"], faults=faults, help=advice)


def text_of(arguments: Sequence[str]) -> str:
    """The standard output of a command."""
    code, text, said = _core.ask(["equipod", *arguments, "--quiet"], None)
    if code in (2, 4):
        raise (DesignError if code == 2 else CommandError)(said.strip(), code="command")
    return text

"""Questions that take long, asked of the program in a process of its own: its answers are those of the command line, and an interrupt ends it with the best so far."""

from __future__ import annotations

import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import CommandError, DesignError
from ._poses import PoseLike, as_matrices, quaternion

#: What progress is reported to: a line of text at a time.
Progress = Callable[[str], None]


def shown(line: str) -> None:
    """Progress on one line of standard error, which is written over."""
    sys.stderr.write("\r\x1b[K" + line[:160])
    sys.stderr.flush()


class Workshop:
    """A folder for the files of one question, gone afterwards."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="equipod-")
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

    def poses(self, name: str, times: npt.ArrayLike, poses: PoseLike) -> str:
        """Times and poses as a table, to the last digit."""
        array = as_matrices(poses).reshape(-1, 4, 4)
        seconds = np.asarray(times, dtype=np.float64).reshape(-1)
        if len(seconds) != len(array):
            raise DesignError(f"{len(seconds)} times and {len(array)} poses", code="shape")
        rows = np.column_stack([seconds, array[:, :3, 3], quaternion(array)])
        lines = ["time,x,y,z,qw,qx,qy,qz", *(",".join(map(repr, row.tolist())) for row in rows)]
        path = self.path / name
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)

    def measurements(self, name: str, poses: PoseLike, lengths: npt.NDArray[np.float64]) -> str:
        """Poses with lengths as a table, to the last digit."""
        array, rows = as_matrices(poses).reshape(-1, 4, 4), lengths.reshape(-1, 6)
        if len(rows) != len(array):
            raise DesignError(f"{len(array)} poses and {len(rows)} rows of lengths", code="shape")
        table = np.column_stack([array[:, :3, 3], quaternion(array), rows])
        lines = ["x,y,z,qw,qx,qy,qz,l1,l2,l3,l4,l5,l6", *(",".join(map(repr, row.tolist())) for row in table)]
        path = self.path / name
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)


def pose_text(pose: PoseLike) -> str:
    """One pose as options take it, to the last digit: ``x,y,z,qw,qx,qy,qz``."""
    array = as_matrices(pose)
    if array.shape != (4, 4):
        raise DesignError(f"one pose is a matrix of shape (4, 4), not {array.shape}", code="shape")
    return ",".join(map(repr, [*array[:3, 3].tolist(), *quaternion(array).tolist()]))


def ask(arguments: Sequence[str], progress: Progress | bool | None = None, folder: str | None = None) -> dict[str, Any]:
    """The JSON document of a command.

    Answers of no (exit code 1) and of not known (3) are documents as those of yes. An interrupt is handed on to the program, which answers with the best so
    far where it has any.
    """
    command = [sys.executable, "-m", "equipod", *arguments, "--json"]
    look = shown if progress is True else progress or None
    if look is None:
        command.append("--quiet")
    child = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        # a terminal and Jupyter interrupt all of their processes, and a second interrupt would end the program before it answers: it gets ours alone
        start_new_session=True,
    )
    said: list[str] = []

    def read() -> None:
        assert child.stderr is not None
        for line in child.stderr:
            said.append(line)
            if look is not None:
                look(line.rstrip("\n"))

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    assert child.stdout is not None
    interrupted = False
    try:
        while True:
            try:
                text = child.stdout.read()
                code = child.wait()
                break
            except KeyboardInterrupt:
                if interrupted:
                    raise
                interrupted = True
                child.send_signal(signal.SIGINT)
    finally:
        # nothing of it remains where the caller gives up
        child.kill()
    reader.join()
    if look is shown:
        sys.stderr.write("\r\x1b[K")
    try:
        document: dict[str, Any] = json.loads(text)
    except ValueError:
        if interrupted:
            raise KeyboardInterrupt from None
        raise CommandError("".join(said[-5:]) or f"the program ended with exit code {code}") from None
    error = document.get("error")
    if error is not None:
        kind = DesignError if code == 2 else CommandError
        message = error["message"] + (f"; {error['help']}" if error.get("help") else "")
        raise kind(message, code=error["code"])
    return document


def text_of(arguments: Sequence[str]) -> str:
    """What a command writes to standard output."""
    command = [sys.executable, "-m", "equipod", *arguments, "--quiet"]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode in (2, 4):
        raise (DesignError if done.returncode == 2 else CommandError)(done.stderr.strip(), code="command")
    return done.stdout

"""The program ``equipod``: ``python -m equipod --help``."""

from __future__ import annotations

import signal
import sys

from ._core import main


def program() -> None:
    """Runs the program on the arguments of this process and ends it with its exit code."""
    # the program has its own way to end with the best so far
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(main(["equipod", *sys.argv[1:]]))


if __name__ == "__main__":
    program()

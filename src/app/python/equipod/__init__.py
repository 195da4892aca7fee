"""Gough-Stewart platforms: all poses from leg lengths with certificates, equivalent platforms without shared joints, designs that can be built.

>>> import equipod
>>> design = equipod.Design.preset("bench-l16")
>>> lengths = design.ik(design.home)
>>> found = design.fk(lengths)
>>> found.complete, int(found.real.sum()) > 0
(True, True)

Poses are 4 x 4 homogeneous matrices ``[[R, p], [0, 1]]`` of float64, batch first ``(..., 4, 4)``, from platform to base frame; leg lengths have the shape
``(..., 6)``, and so have the angles of cranks; lengths are in the unit of the design, angles in radians unless an argument says degrees. The tour is ``docs/python.md`` of the sources.
"""

from __future__ import annotations

from ._core import __version__
from ._design import (
    Calibrated,
    CrankAngles,
    Design,
    Equivalent,
    Joints,
    LegMap,
    Margins,
    SkippedRow,
    Track,
    Tracker,
    compare,
    leg_map,
    presets,
    verify,
)
from ._display import Figure, Page
from ._errors import CommandError, DesignError, Fault
from ._frames import Frames
from ._pentapod import Pentapod
from ._poses import PoseLike, pose, quaternion, rpy
from ._record import Record, table
from ._solutions import BatchSolutions, Solution, Solutions

__all__ = [
    "BatchSolutions",
    "Calibrated",
    "CommandError",
    "CrankAngles",
    "Design",
    "DesignError",
    "Equivalent",
    "Fault",
    "Figure",
    "Frames",
    "Joints",
    "LegMap",
    "Margins",
    "Page",
    "Pentapod",
    "PoseLike",
    "Record",
    "SkippedRow",
    "Solution",
    "Solutions",
    "Track",
    "Tracker",
    "__version__",
    "compare",
    "leg_map",
    "pose",
    "presets",
    "quaternion",
    "rpy",
    "table",
    "verify",
]

#!/usr/bin/env python3
"""Checks the files of `equipod export` with programs that are not ours. `tests/exports/run` installs them and calls this.

    python tests/exports/check.py target/debug/equipod

Every check is run on the file as it is written and on one with a planted fault, which it has to find.
A program that is not installed is named and counts as a failure unless --allow-missing is given; LinuxCNC, which few systems can have, is only named.
"""

import argparse
import pathlib
import shutil
import sys
import tempfile
import tomllib

from common import failed, missing, optional, passed, run
from cranks import check_cranks
from dynamics import check_dynamics
from drawings import check_dxf, check_svg, check_xml
from linuxcnc import check_linuxcnc, check_preset
from motion import check_equivalent, check_poses
from robots import check_robots
from solids import check_step, check_stl
from standing import check_standing
from swing import check_swing
from texts import check_csv, check_hal, check_json, check_matlab

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Design, options, time for a move over the square root of the size. The designs have shared joints and separate ones,
# flat bodies and others, limits of lengths, and a unit that has to be named. Designs without a time are asked for no
# pose. Lengths do not hold the platform of rbt-midline (architecturally singular). The default workspace of
# innocenti-6-4 holds singular poses (`equipod singular poses` proves it). general-6-6 settles slowly.
DESIGNS = [
    ("rbt-octahedral", [], 2.0),
    ("rbt-midline", [], None),
    ("innocenti-6-4", ["--unit", "mm"], None),
    ("general-6-6", ["--unit", "m"], 20.0),
    ("symmetric-hexapod", [], 2.0),
    ("worked/bench-octahedral", [], 2.0),
]


def leg_range(design, doc):
    """`leg_length` of a design in metres."""
    table = tomllib.loads(design.read_text()).get("hardware", {})
    return [x * doc["design_unit"]["mm"] / 1000 for x in table["leg_length"]] if "leg_length" in table else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the equipod program")
    parser.add_argument("--allow-missing", action="store_true", help="programs that are not installed are named only")
    parser.add_argument("--keep", help="folder for the files")
    args = parser.parse_args()
    program = str(pathlib.Path(args.program).resolve())
    top = pathlib.Path(args.keep or tempfile.mkdtemp())
    for design, options, time in DESIGNS:
        folder = top / design
        run(program, "export", ROOT / f"designs/{design}.toml", "--to", "all", "-o", folder, "--gravity-compensation", *options)
        check_csv(folder, design)
        doc = check_json(folder, design)
        check_hal(folder, design)
        check_linuxcnc(folder, design, time is not None)
        check_matlab(folder, design)
        check_svg(folder, design, doc)
        check_xml(folder, design)
        check_dxf(folder, design, doc)
        check_stl(folder, design, doc)
        limits = leg_range(ROOT / f"designs/{design}.toml", doc)
        check_step(folder, design, doc, limits and [1000 * x for x in limits])
        check_poses(folder, design, time, limits)
        check_robots(program, folder, ROOT / f"designs/{design}.toml", doc)
    check_preset(program, top / "preset")
    check_dynamics(program, top / "dynamics")
    check_cranks(program, top / "cranks", ROOT / "designs/presets/reachy-mini.toml")
    check_standing(program, top / "standing", ROOT / "designs/worked/simulator-300kg-built.toml")
    check_swing(program, top / "swing", ROOT / "designs/worked/simulator-300kg-built.toml")
    check_equivalent(program, top, ROOT / "designs/rbt-octahedral.toml")
    if not args.keep:
        shutil.rmtree(top)
    print(f"{len(passed)} passed, {len(failed)} failed" + (f", not installed: {', '.join(missing + optional)}" if missing + optional else ""))
    sys.exit(1 if failed or (missing and not args.allow_missing) else 0)


if __name__ == "__main__":
    main()

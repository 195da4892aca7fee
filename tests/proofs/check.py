#!/usr/bin/env python3
"""Checks proofs stated by the program with ball arithmetic and exact rationals. `tests/proofs/run` installs what it needs and calls this.

    python tests/proofs/check.py target/debug/equipod [--certificates N] [--seed S] [--only TOPIC]

Every topic is a module with `run(program, options, tally)`. Nothing is shared with the program but the published formulas. Faults are planted in every topic
and have to be found. New topics: add the module to TOPICS.
"""

import argparse
import pathlib
import sys
import time

import certificates
import counts
import offsets
import workspace
from common import Tally

TOPICS = {"certificates": certificates, "counts": counts, "offsets": offsets, "workspace": workspace}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the equipod program")
    parser.add_argument("--certificates", type=int, default=200, metavar="N", help="certificates of roots to check (200)")
    parser.add_argument("--bounds", type=int, default=10, metavar="N", help="bounds to check, for topics that have some (10)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", choices=sorted(TOPICS))
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    bad = False
    for name, topic in TOPICS.items():
        if options.only not in (None, name):
            continue
        tally, start = Tally(), time.time()
        topic.run(program, options, tally)
        counts = ", ".join(f"{n} {what}" for what, n in sorted(tally.checked.items()))
        print(
            f"{name}: {counts}; {tally.found} planted faults found, {len(tally.missed)} missed; {len(tally.faults)} faults; {time.time() - start:.0f} s",
            flush=True,
        )
        bad |= bool(tally.faults or tally.missed or not tally.checked or not tally.found)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

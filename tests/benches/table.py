#!/usr/bin/env python3
"""Rows of the tables of docs/benchmarks.md: `equipod bench` on one thread, one run for each class.

    tests/benches/table.py PROGRAM COUNT CLASS[,CLASS...]        `special`: the 16 classes; `topologies`: T01 to T34; `planar`: their planar variants

A row: class, problems, complete, every root certified, proved, missed, spurious, false certificates, median and 99th percentile in us, median / eig40, median / qz69.
The exit code is 1 when an answer is wrong or lacks its proof.
"""

import json
import subprocess
import sys

SPECIAL = "6-6,6-5,6P-6,6P-6P,tilted-planes,octahedral,griffis-duffy,hexapod,hexapod-home,similar,affine,congruent,collinear,close-pair,spread,double-root"
TOPOLOGIES = ",".join(f"T{k:02}" for k in range(1, 35))
PLANAR = ",".join(f"{name}-{which}" for name in TOPOLOGIES.split(",") for which in ("planar-base", "planar-platform", "both-planar"))


def main():
    program, count, classes = sys.argv[1:4]
    classes = {"special": SPECIAL, "topologies": TOPOLOGIES, "planar": PLANAR}.get(classes, classes)
    wrong = 0
    for name in classes.split(","):
        words = [program, "bench", "--class", name, "--count", count, "--threads", "1", "--seed", "1", "--json", "-q"]
        a = json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=False).stdout)
        times = [f"{a[key]:.3g}" if a[key] < 100 else f"{a[key]:.0f}" for key in ("median_us", "p99_us")]
        ratios = [f"{a['ratio_to_reference'][key]:.3g}" for key in ("eig40", "qz69")]
        counts = [a[key] for key in ("count", "complete", "certified", "proved", "missed_roots", "spurious_roots", "false_certificates")]
        print("|", " | ".join(map(str, [name, *counts, *times, *ratios])), "|", flush=True)
        wrong += a["proved"] < a["count"] or any(counts[4:])
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()

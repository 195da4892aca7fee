"""The share of a sweep that goes into writing, from samples of `perf` sorted by the names in their stacks.

    perf record -e cpu-clock -F 1500 --call-graph dwarf,8192 equipod sweep run PLAN -o DIR --threads 1 --shards 1 -q
    perf script --no-inline -F ip,sym | python tests/sweep/samples.py

A sample is computation if its stack names a candidate, its row or a figure of it. It is writing if its stack names a
part, a manifest, Parquet, a digest, the compressor or a file, and no computation. The second share counts all other
samples as writing too, so that the truth lies between the two.
"""

import collections
import math
import re
import sys

COMPUTING = re.compile(r"equipod::sweep::(evaluate|candidate|measure|sample|plan|climb|rows)|equipod::(fk|manipulator|synthesis|solve|geom)::")
WRITING = re.compile(r"parquet|snap::|sha2|Digested|sweep::part|sweep_folder|write_whole|SerializedFileWriter|BufWriter|std::fs|fsync|vfs_write|ext4|serde_json")


def main():
    counts, others = collections.Counter(), collections.Counter()
    for stack in sys.stdin.read().split("\n\n"):
        names = [" ".join(line.split()[1:]) for line in stack.splitlines() if line.strip()]
        if not names:
            continue
        text = "\n".join(names)
        kind = "computing" if COMPUTING.search(text) else "writing" if WRITING.search(text) else "neither"
        counts[kind] += 1
        if kind == "neither":
            others[names[0]] += 1
    total = sum(counts.values())
    for kind in ("computing", "writing", "neither"):
        print(f"{kind:<10} {counts[kind]:>8} {100 * counts[kind] / total:7.3f} %")
    for label, n in [("writing", counts["writing"]), ("writing and neither", counts["writing"] + counts["neither"])]:
        above = max(counts["computing"], 1)
        print(f"{label}: {100 * n / above:.3f} +- {100 * math.sqrt(n) / above:.3f} % above the computation, {total} samples")
    print("most of neither:", ", ".join(f"{name} {n}" for name, n in others.most_common(8)))


if __name__ == "__main__":
    main()

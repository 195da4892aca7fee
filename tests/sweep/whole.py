"""A sweep of many designs, killed twice, resumed, verified, merged and drawn; the same plan shard by shard and through
Dask. See the head of `run`.

Every step is a command that a user types. Its output is compared with the expected output, and the parts of the three
folders with each other byte for byte. The negative control alters a byte of a part, which `verify` has to see and `run`
to mend.
"""

import argparse
import contextlib
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import equipod.sweep

BASE = pathlib.Path(__file__).resolve().parents[2] / "designs" / "rbt-octahedral.toml"


def plan(count):
    """Offsets of an octahedral platform: the cheapest figures that a sweep computes."""
    return {
        "name": "offsets of the octahedral platform",
        "design": str(BASE),
        "compute": ["det_a", "spacing", "clearance", "conditioning"],
        "vary": [{"by": "sobol", "count": count, "values": {"offsets": {"from": 0.1, "to": 0.9}}}],
    }


class Checks:
    """Commands, what they took, and what was wrong."""

    def __init__(self, program):
        self.program = str(pathlib.Path(program).resolve())
        self.wrong = []

    def ask(self, *words, code=0):
        """The document of `equipod sweep WORDS`."""
        done = subprocess.run([self.program, "sweep", *map(str, words), "--json", "--quiet"], capture_output=True, text=True, check=False)
        self.holds(done.returncode == code, f"sweep {words[0]} ended with {done.returncode} instead of {code}: {done.stderr}{done.stdout[:400]}")
        return json.loads(done.stdout or "{}")

    def holds(self, right, what):
        if not right:
            self.wrong.append(what)
            print("WRONG:", what, flush=True)

    @contextlib.contextmanager
    def step(self, name):
        began = time.perf_counter()
        said = []
        yield said.append
        print(f"{name}: {time.perf_counter() - began:.1f} s", *said, flush=True)


def manifests(folder):
    return sorted(folder.glob("part-*.json"))


def digests(folder):
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.glob("part-*.parquet"))}


def killed(checks, source, folder, shards, after):
    """Starts the sweep and kills it without a word once so many shards are done."""
    child = subprocess.Popen(
        [checks.program, "sweep", "run", str(source), "--shards", str(shards), "-o", str(folder), "--quiet"], stdout=subprocess.DEVNULL
    )
    while len(manifests(folder)) < after and child.poll() is None:
        time.sleep(0.002)
    checks.holds(child.poll() is None, f"the sweep ended before it could be killed after {after} shards")
    child.kill()
    child.wait()


def main():
    words = argparse.ArgumentParser()
    words.add_argument("program")
    words.add_argument("--candidates", type=int, default=100_000)
    words.add_argument("--shards", type=int, default=50)
    words.add_argument("--keep", type=pathlib.Path, help="folder for everything that is written")
    asked = words.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = asked.keep or pathlib.Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        sys.exit(1 if whole(Checks(asked.program), work, asked.candidates, asked.shards) else 0)


def whole(checks, work, count, shards):
    source, one = work / "plan.json", work / "killed"
    source.write_text(json.dumps(plan(count)))
    with checks.step("run, killed twice") as say:
        killed(checks, source, one, shards, shards // 4)
        first = checks.ask("status", one, code=1)["done"]
        killed(checks, source, one, shards, len(first) + shards // 4)
        second = checks.ask("status", one, code=1)
        checks.holds(set(first) < set(second["done"]), "what was done before the second run is done after it, and more")
        checks.holds(len(second["done"]) < shards, "shards are left for the third run")
        say(f"{len(first)}, then {len(second['done'])} of {shards} shards done")
    with checks.step("resumed"):
        status = checks.ask("run", source, "-o", one)
        checks.holds(status["computed"] == second["missing"], "only what was missing is computed")
        checks.holds((status["rows"], status["failed"], status["unfinished"]) == (count, 0, []), "every candidate has a row without an error")
    with checks.step("verified, a thousand candidates computed again"):
        checks.holds(checks.ask("verify", one, "--sample", 1000)["same"], "all parts are what their manifests say, and all rows are computed again")
    with checks.step("merged") as say:
        merged = checks.ask("merge", one, "-o", work / "all.parquet")
        checks.holds(merged["rows"] == count, "the table has all rows")
        say(f"{merged['rows']} rows, {merged['bytes']} bytes, SHA-256 {merged['sha256']}")
    with checks.step("drawn") as say:
        for kind, columns in [("scatter", "det_a,conditioning"), ("heat", "det_a,base_spacing,conditioning"), ("histogram", "conditioning"), ("front", "base_spacing,conditioning")]:
            picture = work / f"{kind}.svg"
            drawn = subprocess.run(
                [checks.program, "plot", "sweep", str(one), "--kind", kind, "--columns", columns, "-o", str(picture), "--quiet"], capture_output=True, text=True, check=False
            )
            text = picture.read_text() if picture.exists() else ""
            checks.holds(drawn.returncode == 0 and re.search(r"</svg>\s*$", text), f"{kind} is drawn: {drawn.stderr}")
            say(f"{kind} {len(text)} bytes")
    with checks.step("best five as designs"):
        best = checks.ask("best", one, "--by", "conditioning", "--count", 5, "-o", work / "best")["candidates"]
        checks.holds(len(best) == 5 and all(pathlib.Path(b["output"]).exists() for b in best), "five designs")
    with checks.step("shard by shard, from the last one to the first"):
        for shard in reversed(range(shards)):
            checks.ask("run", source, "--shard", f"{shard}/{shards}", "--threads", 1, "-o", work / "shards")
    with checks.step("through Dask, a LocalCluster"):
        status = equipod.sweep.run(source, output=work / "dask", shards=shards)
        checks.holds((status["missing"], status["rows"]) == ([], count), "Dask has computed all")
    parts = [digests(work / name) for name in ("killed", "shards", "dask")]
    checks.holds(len(parts[0]) == shards and parts[0] == parts[1] == parts[2], "the parts of all three folders are the same bytes")
    print(f"{shards} parts, three times, byte for byte: SHA-256 over their digests", hashlib.sha256("".join(parts[0].values()).encode()).hexdigest(), flush=True)
    with checks.step("an altered byte seen and mended"):
        victim = one / sorted(parts[0])[shards // 2]
        content = bytearray(victim.read_bytes())
        content[len(content) // 2] ^= 1
        victim.write_bytes(content)
        checks.holds(checks.ask("verify", one, "--sample", 0, code=1)["status"]["missing"] == [shards // 2], "verify names the altered part")
        checks.holds(checks.ask("run", source, "-o", one)["computed"] == [shards // 2] and digests(one) == parts[0], "run makes it again")
    return checks.wrong


if __name__ == "__main__":
    main()

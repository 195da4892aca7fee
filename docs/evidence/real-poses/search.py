"""The largest numbers of real poses of docs/evidence/real-poses.md: plans, sweeps, and the designs they found.

    python docs/evidence/real-poses/search.py PROGRAM WORK [NAME ..] [--count N] [--seed S] [--threads N] [--check]

`PROGRAM` is the command that runs equipod, `WORK` a folder for plans and parts. Each topology is searched from N random platforms; without --count and --seed these are
the ones of its row on the page. The best design is written beside this file unless it has fewer real poses than the one that is there, or is less proved: then that one
stays, and a line says so. --check writes nothing and ends with 1 where the data of a row are other ones than those of the page. Needs pyarrow.
"""

import argparse
import hashlib
import json
import pathlib
import shlex
import subprocess
import sys
import tomllib

import pyarrow.parquet as parquet

HERE = pathlib.Path(__file__).resolve().parent
STEPS = 2000
#: Random platforms of a row and the seed that draws them: few where a search takes minutes.
USUAL = (12, 1)
ROWS = {"T01": (6, 4), "T02": (8, 4), "T04": (4, 4), "T05": (4, 4), "T10": (4, 4), "6P-6": (6, 4), "6P-6P": (4, 4)}
#: Platforms that are no topology of their own: one body flat, or both.
FLAT = {"6P-6": ["base"], "6P-6P": ["base", "platform"]}


def run(program, *words):
    subprocess.run([*shlex.split(program), *map(str, words)], check=True, stdout=subprocess.DEVNULL)


def representatives(program, work):
    """A design of each of the 34 topologies, and flat ones of the general one."""
    folder = work / "topologies"
    if not folder.exists():
        run(program, "equivalents", "topologies", "--members", 1, "-o", folder, "-q")
    designs = {path.stem: tomllib.loads(path.read_text()) for path in sorted(folder.glob("T*.toml"))}
    general = next(name for name, d in designs.items() if len({leg[0] for leg in d["legs"]}) + len({leg[1] for leg in d["legs"]}) == 12)
    for name in FLAT:
        designs[name] = designs[general]
    return designs


def plan(name, design, count):
    """All coordinates of all joints between -1 and 1, lengths between 0.5 and 2.5."""
    legs = design["legs"]
    values, bodies = {}, {}
    for k, body in enumerate(["base", "platform"]):
        bodies[body] = {joint: [0.1, 0.2, 0.0 if body in FLAT.get(name, []) else 0.3] for joint in dict.fromkeys(leg[k] for leg in legs)}
        axes = "xy" if body in FLAT.get(name, []) else "xyz"
        # the frame of each body is free: its first joint may stay in the origin
        for number, joint in enumerate(bodies[body]):
            if number == 0:
                bodies[body][joint] = [0.0, 0.0, 0.0]
            else:
                bodies[body][joint] = [0.1 * number, 0.2 * number * number, bodies[body][joint][2] * number**3 / 10]
                values.update({f"{body}.{joint}.{axis}": {"from": -1.0, "to": 1.0} for axis in axes})
    values["lengths"] = {"from": 0.5, "to": 2.5}
    base = {"name": name, "units": "1", "legs": legs, "lengths": [1.0] * 6, **bodies}
    content = {
        "name": f"real poses of {name}",
        "design": f"{name}.design.json",
        "compute": ["climb"],
        "steps": STEPS,
        "vary": [{"by": "uniform", "count": count, "values": values}],
    }
    return base, content


def as_design(name, legs, row, note):
    """The platform of a row as a design file; a joint that legs share has one name."""
    lines = [f"# {note}", f'name = "{name}, {row["found_real_poses"]} real poses"', 'units = "1"', f'source = "search by equipod: docs/evidence/real-poses.md"']
    lines.append("lengths = [" + ", ".join(repr(row[f"found_length_{k}"]) for k in range(1, 7)) + "]")
    lines.append("legs = " + json.dumps(legs))
    for k, body in enumerate(["base", "platform"]):
        lines.append(f"\n[{body}]")
        for joint in dict.fromkeys(leg[k] for leg in legs):
            leg = next(i for i, pair in enumerate(legs, 1) if pair[k] == joint)
            lines.append(f"{joint} = [" + ", ".join(repr(row[f"found_{body}_{leg}_{axis}"]) for axis in "xyz") + "]")
    return "\n".join(lines) + "\n"


def search(program, work, name, design, count, seed, threads):
    """The row of a topology, the best platform, and the digest of the data; `None` where no platform could be searched from."""
    base, content = plan(name, design, count)
    (work / f"{name}.design.json").write_text(json.dumps(base))
    source = work / f"{name}.json"
    source.write_text(json.dumps(content, indent=1, sort_keys=True))
    folder = work / f"{name}-{count}-{seed}"
    run(program, "sweep", "run", source, "--seed", seed, "--shards", 4, "-o", folder, "-q", *threads)
    merged = work / f"{name}-{count}-{seed}.parquet"
    run(program, "sweep", "merge", folder, "-o", merged)
    rows = [r for r in parquet.read_table(merged).to_pylist() if r["error"] is None]
    proved = [r for r in rows if r["found_completeness"] == "proved"]
    best = max(proved or rows, key=lambda r: (r["found_real_poses"], -r["candidate"]), default=None)
    if best is None:
        return None
    row = {
        "real": best["found_real_poses"],
        "finite": best["found_finite_poses"],
        "completeness": best["found_completeness"],
        "searches": count,
        "seed": seed,
        "candidate": best["candidate"],
        "reached": [r["found_real_poses"] for r in rows].count(best["found_real_poses"]),
        "sha256": hashlib.sha256(merged.read_bytes()).hexdigest(),
    }
    return row, best


def worth(row):
    """What makes one row better than another."""
    return row["completeness"] == "proved", row["real"]


def main():
    words = argparse.ArgumentParser()
    words.add_argument("program")
    words.add_argument("work", type=pathlib.Path)
    words.add_argument("--count", type=int)
    words.add_argument("--seed", type=int)
    words.add_argument("--threads", type=int)
    words.add_argument("--check", action="store_true")
    words.add_argument("names", nargs="*")
    asked = words.parse_args()
    asked.work.mkdir(parents=True, exist_ok=True)
    designs = representatives(asked.program, asked.work)
    results = HERE / "results.json"
    known = json.loads(results.read_text()) if results.exists() else {}
    threads = [] if asked.threads is None else ["--threads", asked.threads]
    other = False
    for name in asked.names or designs:
        count, seed = ROWS.get(name, USUAL)
        count, seed = asked.count or count, asked.seed or seed
        found = search(asked.program, asked.work, name, designs[name], count, seed, threads)
        if found is None:
            print(name, "no row")
            other = True
            continue
        row, best = found
        old = known.get(name)
        said = f"{name} real {row['real']} of {row['finite']} {row['completeness']}, reached by {row['reached']} of {count}, {row['sha256'][:16]}"
        if asked.check:
            same = old is not None and row == old
            other |= not same
            print(said, "as on the page" if same else f"OTHER than on the page: {old}", flush=True)
        elif old is not None and worth(row) < worth(old):
            print(said, f"is worse: the design with {old['real']} stays", flush=True)
        else:
            print(said, flush=True)
            known[name] = row
            note = f"candidate {row['candidate']} of {count}, seed {seed}; data {row['sha256']}"
            (HERE / f"{name}.toml").write_text(as_design(name, designs[name]["legs"], best, note))
            results.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n")
    sys.exit(int(other))


if __name__ == "__main__":
    main()

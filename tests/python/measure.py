"""Times of the Python package, side by side with what people use without it; prints the tables of docs/benchmarks.md.

    python tests/python/measure.py [--peer FOLDER] [--wheel FILE] [--rows N] [--problems N]

Run it with an interpreter that has the installed wheel and scipy. `--peer` is a copy of https://github.com/martyushev/fkSGP, whose folder `python` has the solvers of
Martyushev (2025). Everything runs on one thread; each number is a median, and a row of one table is measured in one run.
"""

import argparse
import importlib
import os
import pathlib
import statistics
import subprocess
import sys
import time
import types

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np  # noqa: E402
from scipy.optimize import fsolve  # noqa: E402

import equipod  # noqa: E402

#: A pose is right when no entry of its matrix is off by more, in sizes of the design.
RIGHT = 1e-6
#: Poses that differ by more in some entry are two.
DISTINCT = 1e-6


def median_us(call, repeats, batches=15):
    """Median over batches of the mean time of a call, microseconds."""
    times = []
    for _ in range(batches):
        began = time.perf_counter()
        for _ in range(repeats):
            call()
        times.append((time.perf_counter() - began) / repeats * 1e6)
    return statistics.median(times)


def start_ms(code, repeats=15):
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        subprocess.run([sys.executable, "-c", code], check=True)
        times.append((time.perf_counter() - began) * 1e3)
    return statistics.median(times)


def package(wheel):
    print("| what | value |\n|---|--:|")
    nothing, numpy, whole = start_ms("pass"), start_ms("import numpy"), start_ms("import equipod")
    print(f"| `import equipod` after numpy, ms | {whole - numpy:.0f} |")
    print(f"| `import equipod` with numpy, ms | {whole - nothing:.0f} |")
    if wheel:
        print(f"| wheel, MB | {pathlib.Path(wheel).stat().st_size / 1e6:.1f} |")
    print()


def calls(design, rows):
    rng = np.random.default_rng(1)
    home = design.home
    size = float(np.linalg.norm(home[:3, 3]))
    t = np.linspace(0.0, 60.0, rows)[:, None] * np.array([0.31, 0.47, 0.23, 0.37, 0.29, 0.41]) * 2 * np.pi
    swing = np.sin(t + np.arange(6))
    poses = equipod.pose(home[:3, 3] + 0.1 * size * swing[:, :3], rpy=0.2 * swing[:, 3:])
    lengths = design.ik(poses)
    one, l = poses[0], lengths[0]
    few = poses[rng.integers(0, rows, 10_000)]
    tracker = design.tracker(one)
    print("| call | us a call | us an item of a batch |\n|---|--:|--:|")
    batch = median_us(lambda: design.ik(few), 3) / len(few)
    print(f"| `ik` | {median_us(lambda: design.ik(one), 2000):.2f} | {batch:.3f} |")
    batch = median_us(lambda: design.jacobian(few), 3) / len(few)
    print(f"| `jacobian` | {median_us(lambda: design.jacobian(one), 2000):.2f} | {batch:.3f} |")
    step = median_us(lambda: tracker.step(l), 2000)
    began = time.perf_counter()
    track = design.tracker(one).follow(lengths)
    item = (time.perf_counter() - began) / rows * 1e6
    wrong = float(np.abs(track.T - poses).max()) if len(track.T) == rows else float("nan")
    print(f"| `tracker.step`, `follow` | {step:.2f} | {item:.3f} |")
    batch = median_us(lambda: design.fk_batch(lengths[:2000], threads=1), 1, 5) / 2000
    print(f"| `fk`, `fk_batch` | {median_us(lambda: design.fk(l), 100):.1f} | {batch:.2f} |")
    print(f"\n`follow`: {track.status}, {rows} rows, {60e6 / item / 1e6:.1f} million poses a minute, largest error {wrong:.1e}.\n")


def newton(joints, lengths, x, steps=50):
    """Newton's method in numpy on position and rotation; the step is a twist in the base frame."""
    base, platform = joints
    pose = x.copy()
    for _ in range(steps):
        ends = platform @ pose[:3, :3].T
        legs = ends + pose[:3, 3] - base
        now = np.linalg.norm(legs, axis=1)
        unit = legs / now[:, None]
        step = np.linalg.solve(np.hstack([unit, np.cross(ends, unit)]), lengths - now)
        pose[:3, 3] += step[:3]
        angle = np.linalg.norm(step[3:])
        if angle > 0.0:
            k = step[3:] / angle
            cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
            pose[:3, :3] = (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross) @ pose[:3, :3]
        if np.abs(step).max() < 1e-12:
            break
    return pose


def count(poses):
    """The number of different poses."""
    kept = []
    for pose in poses:
        if all(np.abs(pose - other).max() > DISTINCT for other in kept):
            kept.append(pose)
    return len(kept)


def by_peer(solver, joints, lengths):
    """All poses of Martyushev's solver, whose first joints are the origins, and that fulfil the lengths."""
    base, platform = joints
    rt, _ = solver(base - base[0], platform - platform[0], lengths**2, 0)
    rotation = rt[:, :, :3]
    position = rt[:, :, 3] + base[0] - rotation @ platform[0]
    legs = np.einsum("nij,kj->nki", rotation, platform) + position[:, None, :] - base
    defect = np.abs(np.einsum("nki,nki->nk", legs, legs) - lengths**2).max(axis=1)
    good = defect < 1e-6 * float(np.max(lengths)) ** 2
    return np.concatenate([rotation, position[:, :, None]], axis=2)[good]


def peers(name, design, problems, folder, solver):
    rng = np.random.default_rng(2)
    size = design.characteristic_length
    home = design.home
    joints = (design.joints.base_ends, design.joints.platform_ends)
    expected = [
        equipod.pose(home[:3, 3] + 0.4 * size * rng.uniform(-1, 1, 3), rpy=rng.uniform(-0.9, 0.9, 3)) for _ in range(problems)
    ]
    lengths = [design.ik(pose) for pose in expected]
    number = design.check().pose_count.finite
    start = np.concatenate([home[:3, 3], equipod.rpy(home)])

    def solved_by_fsolve(l):
        x = fsolve(lambda x: design.ik(equipod.pose(x[:3], rpy=x[3:])) - l, start)
        return equipod.pose(x[:3], rpy=x[3:])

    def right(found, pose):
        return bool(np.abs(found - pose).max() < RIGHT * size)

    rows = []

    def measure(method, solve, has_right, is_complete):
        times, rights, complete = [], 0, 0
        for l, pose in zip(lengths, expected):
            began = time.perf_counter()
            try:
                found = solve(l)
            except np.linalg.LinAlgError:
                found = None
            times.append((time.perf_counter() - began) * 1e6)
            rights += found is not None and has_right(found, pose)
            complete += found is not None and is_complete is not None and is_complete(found)
        share = f"{complete} of {problems}" if is_complete else "one pose"
        rows.append(f"| {name} | {method} | {statistics.median(times):.0f} | {rights} of {problems} | {share} |")

    def any_right(found, pose):
        return any(right(m, pose) for m in found)

    measure("`fk`", design.fk, lambda f, pose: any_right(f.T[:, :3, :].real, pose[:3]), lambda f: f.complete)
    if folder:
        # its `__init__` imports a program that needs Python 3.12, and the solvers do not
        package = types.ModuleType("python")
        package.__path__ = [str(folder / "python")]
        sys.modules["python"] = package
        function = getattr(importlib.import_module(f"python.{solver}"), solver)
        measure("fkSGP", lambda l: by_peer(function, joints, l), lambda f, pose: any_right(f.real, pose[:3]), lambda f: count(f) == number)
    measure("Newton's method in numpy, from home", lambda l: newton(joints, l, home), right, None)
    measure("`scipy.optimize.fsolve`, from home", solved_by_fsolve, right, None)
    print("\n".join(rows))


def planar():
    """A platform with random joints in two planes."""
    rng = np.random.default_rng(5)
    base, platform = rng.uniform(-2, 2, (6, 3)), rng.uniform(-1, 1, (6, 3))
    base[:, 2] = platform[:, 2] = 0.0
    return equipod.Design.from_arrays(base, platform, name="planar", units="m")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peer", type=pathlib.Path)
    parser.add_argument("--wheel", type=pathlib.Path)
    parser.add_argument("--rows", type=int, default=1_000_000)
    parser.add_argument("--problems", type=int, default=200)
    options = parser.parse_args()
    package(options.wheel)
    octahedral = equipod.Design.load("designs/rbt-octahedral.toml")
    calls(octahedral, options.rows)
    print("| design | method | median us | has the pose | has all poses |\n|---|---|--:|--:|--:|")
    peers("general-6-6", equipod.Design.load("designs/general-6-6.toml"), options.problems, options.peer, "solver66")
    peers("planar 6-6", planar(), options.problems, options.peer, "solver6p6p")
    # fkSGP is for general joints: its templates have no solutions where joints are shared
    peers("rbt-octahedral", octahedral, options.problems, None, "")


if __name__ == "__main__":
    main()

"""A log of leg lengths, turned into poses of one assembly mode; and what Newton's method from scipy makes of the same log.

    python examples/python/log_of_lengths.py [ROWS] [PICTURE]

The picture (.svg or .png) shows the error of both over the log; it needs matplotlib.
"""

import sys
import time

import numpy as np
from scipy.optimize import fsolve

import equipod

#: Rows that scipy solves, spread over the log.
COMPARED = 400


def path(design: equipod.Design, rows: int) -> np.ndarray:
    """Poses of a wide motion on all six axes about home."""
    t = np.linspace(0.0, 60.0, rows)[:, None] * np.array([0.31, 0.47, 0.23, 0.37, 0.29, 0.41]) * 2 * np.pi
    swing = np.sin(t + np.arange(6))
    home = design.home
    reach = 0.22 * float(np.linalg.norm(home[:3, 3]))
    return np.asarray(equipod.pose(home[:3, 3] + reach * swing[:, :3], rpy=38 * swing[:, 3:], degrees=True))


def by_fsolve(design: equipod.Design, lengths: np.ndarray, start: np.ndarray) -> tuple[np.ndarray, bool]:
    """One pose for a set of lengths by Newton's method on position and angles, and whether scipy calls it converged."""

    def defect(x: np.ndarray) -> np.ndarray:
        return np.asarray(design.ik(equipod.pose(x[:3], rpy=x[3:])) - lengths)

    found, _, status, _ = fsolve(defect, start, full_output=True)
    return np.asarray(equipod.pose(found[:3], rpy=found[3:])), status == 1


def draw(file: str, tracked: np.ndarray, rows: np.ndarray, newton: np.ndarray) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(9, 4))
    axes.semilogy(np.maximum(tracked, 1e-17), linewidth=0.5, label="tracker")
    axes.semilogy(rows, np.maximum(newton, 1e-17), ".", label="fsolve from home")
    axes.set_xlabel("row of the log")
    axes.set_ylabel("largest error of an entry of the pose")
    axes.legend()
    figure.savefig(file)


def main() -> None:
    rows = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    design = equipod.Design.load("designs/rbt-octahedral.toml")
    poses = path(design, rows)
    lengths = design.ik(poses)

    began = time.perf_counter()
    track = design.tracker(poses[0]).follow(lengths)
    seconds = time.perf_counter() - began
    tracked = np.abs(track.T - poses).max(axis=(1, 2))
    print(f"tracker: {track.status}, {len(tracked)} poses, {seconds / rows * 1e6:.2f} us a pose, largest error {tracked.max():.1e}")

    # from home each time, as a script without memory does
    some = np.linspace(0, rows - 1, COMPARED).astype(int)
    start = np.concatenate([design.home[:3, 3], equipod.rpy(design.home)])
    began = time.perf_counter()
    answers = [by_fsolve(design, lengths[k], start) for k in some]
    seconds = time.perf_counter() - began
    newton = np.array([np.abs(pose - poses[k]).max() for (pose, _), k in zip(answers, some)])
    converged = sum(ended for _, ended in answers)
    print(
        f"fsolve from home: {converged} of {COMPARED} converged, {int((newton < 1e-6).sum())} at the right pose, "
        f"{seconds / COMPARED * 1e6:.0f} us a pose"
    )
    wrong = some[np.argmax(newton)]
    found = design.fk(lengths[wrong])
    print(f"row {wrong}: {found}; all of them, so that a wrong one can be told")
    if len(sys.argv) > 2:
        draw(sys.argv[2], tracked, some, newton)


if __name__ == "__main__":
    main()

"""Poses of the workspace reached by simulators, an equivalent platform that moves alike."""

import json

from common import compare, module, planted, report, rotated, run, table
from models import installed


def poses_of(path, count):
    """Some poses of a table in metres, with our leg lengths."""
    rows = table(path)
    step = max(1, len(rows) // count)
    for row in rows[::step][:count]:
        p = [float(row[k]) / 1000 for k in ("x_mm", "y_mm", "z_mm")]
        q = [float(row[k]) for k in ("qw", "qx", "qy", "qz")]
        yield p, q, [float(row[f"l{i}_mm"]) / 1000 for i in range(1, 7)]


def complaint(model, pose):
    """The fault of `model`, whose platform should be at `pose`, or anywhere (None)."""
    if not model.closed():
        return f"loops are {model.gap():.1e} m open"
    if pose is None:
        return ""
    off = apart(model.pose(), expected(pose), model.size)
    return "" if off < 1e-6 else f"pose off by {off:.1e}"


def expected(pose):
    """Position and matrix of a pose with a quaternion."""
    import numpy as np
    p, q, _ = pose
    return np.array(p), np.array([rotated(q, e) for e in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]).T


def apart(one, two, size):
    """Greater of the distance over the size and the difference of the matrices."""
    return max(float(sum((one[0] - two[0]) ** 2)) ** 0.5 / size, float(abs(one[1] - two[1]).max()))


def shifted(body, size):
    """A fault: a body stands a thousandth of the size to the side."""
    def fault(text):
        at = text.index('pos="', text.index(f'<body name="{body}"')) + 5
        first, rest = text[at:].split(" ", 1)
        return text[:at] + repr(float(first) + size / 1000) + " " + rest
    return fault


def without_connect(text):
    """A fault: one loop is open."""
    at = text.index("    <connect")
    return text[:at] + text[text.index("\n", at) + 1:]


def check_poses(folder, name, time, range_):
    """`range_`: least and greatest length in metres by the design file, or None. `time` of a move over the square root of the size; None: lengths do not hold the platform, only the loops are examined."""
    moves = list(poses_of(folder / "lengths-workspace.csv", 4))
    home = moves[0][2]
    size = max(home)
    if sum(max(abs(x - y) for x, y in zip(home, m[2])) > 1e-3 * size for m in moves) < 3:
        report(f"{name} mjcf: moves to check", False)
    limits = [[round(x / size, 12) for x in range_]] * 6 if range_ else []
    path, wrong = folder / "platform.xml", folder / "wrong.xml"
    for kind in installed():
        def good(path):
            for pose in moves:
                model = kind(path)
                why = model.fault(limits)
                if not why and (time or kind.STIFF):
                    model.follow(pose[2], time or 2.0)
                    why = complaint(model, pose if time else None)
                if why:
                    return why
            return ""
        what = f"{name} mjcf ({kind.__name__}): loops closed" + (", poses reached" if time else "")
        compare(what, good, path, wrong, shifted("rod3", size))
        planted(f"{what}; a connect less", good, path, wrong, without_connect)
        if time or kind.STIFF:
            planted(f"{what}; an anchor off", good, path, wrong, lambda text: text.replace('anchor="0 0 0"', f'anchor="{size / 1000!r} 0 0"', 1))


def trajectory(folder, design, path):
    """The octahedral design with a trajectory."""
    text = design.read_text().replace("grid = 2\n", f'grid = 1\ntrajectory = "{path.name}"\n')
    path.write_text("3,5.196152422706632,15,0,0,0\n3.5,5,16,0,0,10\n4,4.5,15.5,6,-5,0\n2.5,5.5,14.5,-4,6,-8\n")
    out = folder / "moving.toml"
    out.write_text(text)
    return out


def check_equivalent(program, folder, original):
    """The octahedral platform with lengths l and its equivalent without shared joints with m = sqrt(A l^2 + c) along a trajectory."""
    np = module("numpy")
    if np is None:
        return
    moving = trajectory(folder, original, folder / "path.csv")
    free = folder / "free.toml"
    run(program, "equivalents", "family", original, "--pattern", "S123456", "--offsets=0.2,0.21,0.22,0.2,0.2,0.23", "-o", free)
    leg_map = json.loads(run(program, "equivalents", "map", original, free, "--json"))
    a, c = np.array(leg_map["A"]), np.array(leg_map["c"])
    for key, design in (("octahedral", moving), ("free", free)):
        run(program, "export", design, "--to", "mjcf,csv,json", "-o", folder / key, "--gravity-compensation")
    poses = list(poses_of(folder / "octahedral/lengths-trajectory.csv", 1000))
    def along(kind, a):
        """Three largest errors on the way, over the size: difference of the two platforms, difference of the first from
        ours, gap. It stops at the first that is too large."""
        pair = [kind(folder / key / "platform.xml") for key in ("octahedral", "free")]
        alike = right = gap = 0.0
        for pose in poses:
            lengths = np.array(pose[2])
            for model, to in zip(pair, (lengths, np.sqrt(a @ (lengths * 1000) ** 2 + c) / 1000)):
                model.follow(to, 0.1)
            first, second = (model.pose() for model in pair)
            alike = max(alike, apart(first, second, pair[0].size))
            right = max(right, apart(first, expected(pose), pair[0].size))
            gap = max(gap, *(model.gap() / model.size for model in pair))
            if not max(alike, right, gap) < 1e-6:
                break
        return alike, right, gap
    for kind in installed():
        alike, right, gap = along(kind, a)
        what = f"octahedral platform and equivalent without shared joints, m = sqrt(A l^2 + c), move alike at {len(poses)} poses along a trajectory ({kind.__name__})"
        report(what, len(poses) > 50 and max(alike, right, gap) < 1e-6, f"apart {alike:.1e}, from ours {right:.1e}, loops open {gap:.1e} of the size")
        spoilt = a.copy()
        spoilt[0, 0] += 1e-3
        alike, right, _ = along(kind, spoilt)
        report(f"the same with an entry of A off by 1e-3 ({kind.__name__}): planted fault is found", alike > 1e-6 > right, f"apart {alike:.1e}")

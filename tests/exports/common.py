"""The common parts of all checks: the tally, planted faults, tables, and plates computed from the joints alone."""

import csv
import math
import subprocess

passed, failed, missing, optional = [], [], [], []


def report(name, ok, detail=""):
    (passed if ok else failed).append(name)
    print(f"{'ok  ' if ok else 'FAIL'} {name} {detail}", flush=True)


def absent(name, required=True):
    """Notes a program that is not installed; one that is not required is named only, whatever the caller asked for."""
    names = missing if required else optional
    if name not in names:
        names.append(name)


def module(name, label=None):
    """The module, or None and a note."""
    try:
        return __import__(name)
    except ImportError:
        absent(label or name)
        return None


def compare(name, good, path, wrong, fault):
    """`good(path)` returns "" for the file, else a complaint, which it has to do for its text with a planted fault."""
    why = good(path)
    report(name, why == "", why)
    planted(name, good, path, wrong, fault)


def planted(name, good, path, wrong, fault):
    """`good` has to return a complaint, or to break down, for the text of the file with a planted fault."""
    text = path.read_text()
    spoilt = fault(text)
    if spoilt == text:
        report(f"{name}: a fault can be planted", False)
        return
    wrong.write_text(spoilt)
    try:
        found = good(wrong)
    except Exception as broken:
        found = f"{type(broken).__name__}: {broken}"
    report(f"{name}: planted fault is found", found != "", found.splitlines()[0][:110] if found else "")


def run(program, *args):
    out = subprocess.run([program, *map(str, args)], capture_output=True, text=True)
    if out.returncode != 0:
        raise SystemExit(f"{args}: exit {out.returncode}\n{out.stderr}{out.stdout}")
    return out.stdout


def table(path):
    rows = [r for r in path.read_text().splitlines() if not r.startswith("#")]
    return list(csv.DictReader(rows))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rotated(q, v):
    """`v` turned by the quaternion `q`, scalar first."""
    w, u = q[0], q[1:]
    t = [2 * x for x in cross(u, v)]
    return [a + w * b + c for a, b, c in zip(v, t, cross(u, t))]


def placed(doc, body, p):
    """A point of a body at home in the base frame."""
    if body == "base":
        return p
    home = doc["home"]
    return [a + b for a, b in zip(rotated(home["quat_wxyz"], p), home["position"])]


def expected_area(points, margin, holes, diameter):
    """Area within `margin` of the convex hull of `points`, less the holes."""
    points = sorted(set(points))
    def half(seq):
        out = []
        for p in seq:
            while len(out) > 1 and (out[-1][0] - out[-2][0]) * (p[1] - out[-2][1]) - (out[-1][1] - out[-2][1]) * (p[0] - out[-2][0]) <= 0:
                out.pop()
            out.append(p)
        return out[:-1]
    hull = half(points) + half(points[::-1]) if len(points) > 1 else points
    pairs = list(zip(hull, hull[1:] + hull[:1]))
    area = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs)) / 2
    around = sum(math.dist(a, b) for a, b in pairs)
    return area + around * margin + math.pi * margin**2 - holes * math.pi * diameter**2 / 4


def plate_facts(doc, body):
    plate = doc[body]["plate"]
    holes = [tuple(h["at"]) for h in plate["holes"]]
    # the holes are where the joints are: projected here again from the joint table
    axes, origin = plate["axes"], plate["origin"]
    def local(p, k):
        return sum((p[i] - origin[i]) * axes[k][i] for i in range(3))
    centres = {j["name"]: (local(j["at"], 0), local(j["at"], 1)) for j in doc[body]["joints"]}
    area = expected_area(holes, plate["margin"], len(holes), plate["hole_diameter"])
    return plate, centres, area

"""Tables, JSON, LinuxCNC pins, MATLAB script: recomputed from the joints, read by Octave."""

import json
import math
import re
import shutil
import subprocess

from common import absent, compare, rotated, table


def replaced(pattern, change):
    """A fault: the first number that `pattern` ends with is changed."""
    return lambda text: re.sub(pattern, lambda m: m[1] + repr(change(float(m[2]))), text, count=1, flags=re.M)


def lengths_of(joints, legs, q, p):
    """Leg lengths at a pose from joints by name alone."""
    out = []
    for leg in legs:
        a, b = joints[("base", leg["base_joint"])], joints[("platform", leg["platform_joint"])]
        out.append(math.dist([x + y for x, y in zip(rotated(q, b), p)], a))
    return out


def joints_of(folder):
    return {(r["body"], r["joint"]): [float(r[c]) for c in ("x_mm", "y_mm", "z_mm")] for r in table(folder / "joints.csv")}


def check_csv(folder, name):
    joints, legs = joints_of(folder), table(folder / "legs.csv")
    def good(path):
        rows, worst = table(path), 0.0
        for row in rows:
            q = [float(row[k]) for k in ("qw", "qx", "qy", "qz")]
            p = [float(row[k]) for k in ("x_mm", "y_mm", "z_mm")]
            for k, length in enumerate(lengths_of(joints, legs, q, p)):
                worst = max(worst, abs(float(row[f"l{k + 1}_mm"]) / length - 1))
        home = max(abs(float(l["home_length_mm"]) / float(rows[0][f"l{l['leg']}_mm"]) - 1) for l in legs)
        return "" if worst < 1e-12 and home < 1e-12 else f"lengths off by {max(worst, home):.1e}"
    last = replaced(r"(,)([0-9.e+-]+)\Z", lambda x: x * (1 + 1e-9))
    compare(f"{name} csv: lengths agree with joints", good, folder / "lengths-workspace.csv", folder / "wrong.csv",
            lambda text: last(text.rstrip("\n")) + "\n")


def check_json(folder, name):
    joints, legs = joints_of(folder), table(folder / "legs.csv")
    def good(path):
        doc = json.loads(path.read_text())
        own = {(b, j["name"]): j["at"] for b in ("base", "platform") for j in doc[b]["joints"]}
        if own != joints:
            return "other joints than the table"
        for pose in doc["workspace"] + doc["trajectory"]:
            for a, b in zip(lengths_of(own, doc["legs"], pose["quat_wxyz"], pose["position"]), pose["lengths"]):
                if abs(a / b - 1) > 1e-12:
                    return f"length {b} instead of {a}"
        same = [[l["base_joint"], l["platform_joint"]] for l in legs] == [[l["base_joint"], l["platform_joint"]] for l in doc["legs"]]
        return "" if same and doc["units"] == "mm" else "other legs than the table"
    compare(f"{name} json: joints and lengths", good, folder / "platform.json", folder / "wrong.json",
            replaced(r'("lengths":\[)([0-9.e+-]+)', lambda x: x * (1 + 1e-9)))
    return json.loads((folder / "platform.json").read_text())


# what the LinuxCNC manual page of genhexkins lists for the joints
PINS = {f"genhexkins.{body}.{n}.{axis}" for body in ("base", "platform") for n in range(6) for axis in "xyz"}


def check_hal(folder, name):
    joints, legs = joints_of(folder), table(folder / "legs.csv")
    def good(path):
        pins, home = {}, None
        for line in path.read_text().splitlines():
            code, _, comment = line.partition("#")
            if comment.startswith(" Home pose X Y Z A B C: "):
                home = [float(x) for x in comment.split(":")[1].split()]
            words = code.split()
            if not words:
                continue
            if len(words) != 3 or words[0] != "setp" or words[1] not in PINS or words[1] in pins:
                return f"`{line}` sets no pin of genhexkins, or one twice"
            pins[words[1]] = float(words[2])
        if set(pins) != PINS or home is None:
            return f"{len(pins)} pins"
        # genhexkins: strut = |RPY(A, B, C) a + (X, Y, Z) - b|, degrees, RPY = Rz Ry Rx
        (x, y, z), (a, b, c) = home[:3], map(math.radians, home[3:])
        half = lambda t, axis: [math.cos(t / 2)] + [math.sin(t / 2) * (k == axis) for k in range(3)]
        turn = lambda v: rotated(half(c, 2), rotated(half(b, 1), rotated(half(a, 0), v)))
        for leg in legs:
            n = int(leg["leg"]) - 1
            foot, arm = ([pins[f"genhexkins.{body}.{n}.{axis}"] for axis in "xyz"] for body in ("base", "platform"))
            if foot != joints[("base", leg["base_joint"])] or arm != joints[("platform", leg["platform_joint"])]:
                return f"strut {n} has other joints than the table"
            strut = math.dist([s + t for s, t in zip(turn(arm), (x, y, z))], foot)
            if abs(strut / float(leg["home_length_mm"]) - 1) > 1e-12:
                return f"strut {n} is {strut} at home"
        return ""
    compare(f"{name} hal: the pins of genhexkins, strut lengths by its formula", good, folder / "genhexkins.hal", folder / "wrong.hal",
            replaced(r"^(setp genhexkins\.platform\.3\.y )(\S+)$", lambda x: x + 1e-9))
    compare(f"{name} hal: names of pins", good, folder / "genhexkins.hal", folder / "wrong.hal",
            lambda text: text.replace("platform.5.z", "platform.6.z"))


def matlab_arrays(text):
    """The numeric arrays of a script: `stewart.NAME = [ rows ];`."""
    found = re.findall(r"^stewart\.(\w+) = \[$(.*?)^\];$", text, re.M | re.S)
    return {name: [[float(x) for x in row.split(",")] for row in body.split(";") if row.strip()] for name, body in found}


def check_matlab(folder, name):
    joints, legs = joints_of(folder), table(folder / "legs.csv")
    def arrays(path):
        got = matlab_arrays(path.read_text())
        for k, body in (("a", "base"), ("b", "platform")):
            for i, leg in enumerate(legs):
                at = joints[(body, leg[f"{body}_joint"])]
                if any(abs(got[k][r][i] - at[r] / 1000) > 1e-15 * max(1.0, abs(at[r])) for r in range(3)):
                    return f"stewart.{k}, column {i + 1}"
        for pose, lengths in zip(got["T"], got["L"]):
            r, p = [pose[0:3], pose[4:7], pose[8:11]], [pose[3], pose[7], pose[11]]
            for i in range(6):
                head = [sum(r[m][n] * got["b"][n][i] for n in range(3)) + p[m] for m in range(3)]
                if abs(math.dist(head, [got["a"][m][i] for m in range(3)]) / lengths[i] - 1) > 1e-12:
                    return f"length {i + 1}"
        ok = [len(got["T"]), len(got["a"]), len(got["l"])] == [len(got["L"]), 3, 6]
        return "" if ok else "sizes"
    spoil = replaced(r"(stewart\.b = \[\n  )([0-9.e+-]+)", lambda x: x + 1e-9)
    compare(f"{name} matlab: arrays", arrays, folder / "platform.m", folder / "wrong.m", spoil)
    octave = shutil.which("octave-cli") or shutil.which("octave")
    if octave is None:
        absent("octave (a program, not a Python package)")
        return
    home = [float(leg["home_length_mm"]) / 1000 for leg in legs]
    def by_octave(path):
        ask = f"run('{path}'); assert(size(stewart.a), [3 6]); printf('%.17g\\n', stewart.lengths(stewart.R, stewart.p))"
        out = subprocess.run([octave, "--no-gui", "--norc", "--quiet", "--eval", ask], capture_output=True, text=True)
        if out.returncode != 0:
            return f"exit {out.returncode}: {out.stderr.strip()}"
        got = [float(x) for x in out.stdout.split()]
        same = len(got) == 6 and all(abs(x / y - 1) < 1e-12 for x, y in zip(got, home))
        return "" if same else f"lengths {got}"
    compare(f"{name} matlab (Octave)", by_octave, folder / "platform.m", folder / "wrong.m",
            replaced(r"(stewart\.b = \[\n  )([0-9.e+-]+)", lambda x: x + 1e-6))

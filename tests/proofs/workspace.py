"""Margins and sets of regular poses that the program proves over workspaces, against poses drawn here.

The region has the poses `R = exp([w]x) R_0, p = p_0 + d` with |d_k| <= D_k and |w_k| <= theta_k, or with d and w in the
two ellipsoids with these half axes. `assess` states that no pose of the region has a margin below `proved_margin`,
whatever the requirement. If `regular` is `proved`, det J has one sign.

`singular poses` states that det J has one sign over the region scaled by `proved_scale`. It has the opposite sign at
the pose `singular_within`, which lies in the region scaled by its `scale`.

The check: poses are drawn in the region, most of them on its boundary, and moved towards worse ones by random steps.
The worst is evaluated once more in balls of 200 bits (python-flint), from the definitions of the margins. Such a check
refutes and does not prove. It would find the faults of version 0.1.0, which proved a set of other coordinates and
missed worst poses.
"""

import json
import math
import pathlib
import tempfile

from flint import arb, ctx

from common import answer, exact, stream

BITS = 200
KINDS = ["min_leg_length", "max_leg_length", "base_cone_angle", "platform_cone_angle", "leg_speed"]


class Doubles:
    """Plain numbers."""

    number = staticmethod(float)
    sqrt, sin, cos = staticmethod(math.sqrt), staticmethod(math.sin), staticmethod(math.cos)
    pi = math.pi

    @staticmethod
    def angle(y, x):
        return math.atan2(y, x)


class Balls:
    """Balls: exact input, enclosed output."""

    number = staticmethod(exact)

    @staticmethod
    def sqrt(x):
        return arb.sqrt(x)

    @staticmethod
    def sin(x):
        return arb.sin(x)

    @staticmethod
    def cos(x):
        return arb.cos(x)

    @staticmethod
    def angle(y, x):
        return arb.atan2(y, x)

    @property
    def pi(self):
        return arb.pi()


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def apply(r, v):
    return [dot(row, v) for row in r]


def back(r, v):
    return [sum((r[i][j] * v[i] for i in range(1, 3)), r[0][j] * v[0]) for j in range(3)]


def turn(n, w):
    """exp([w]x) by the formula of Rodrigues with sine and cosine of the whole angle."""
    t = n.sqrt(dot(w, w))
    one = n.number(1)
    u = [x / t for x in w]
    c, s = n.cos(t), n.sin(t)
    skew = [[0 * one, -u[2], u[1]], [u[2], 0 * one, -u[0]], [-u[1], u[0], 0 * one]]
    return [
        [(c if i == j else 0 * one) + s * skew[i][j] + (one - c) * u[i] * u[j] for j in range(3)] for i in range(3)
    ]


def pose(n, design, x, scale=1.0):
    """The pose of coordinates in the unit box or the two unit balls."""
    d = [n.number(x[k]) * n.number(design["translation"][k]) * n.number(scale) for k in range(3)]
    w = [n.number(x[k + 3]) * n.number(design["rotation_deg"][k]) * n.number(scale) * n.pi / 180 for k in range(3)]
    r = turn(n, w) if any(design["rotation_deg"][k] * x[k + 3] for k in range(3)) else [[n.number(float(i == j)) for j in range(3)] for i in range(3)]
    return r, [n.number(h) + y for h, y in zip(design["home"], d)]


def legs(n, design, x, scale=1.0):
    """Leg vectors and arms R b (home has no rotation), in leg order."""
    r, p = pose(n, design, x, scale)
    out = []
    for a, b in design["legs"]:
        arm = apply(r, [n.number(v) for v in b])
        out.append(([u + v - n.number(w) for u, v, w in zip(arm, p, a)], arm))
    return r, out


def margins(n, design, x):
    """The least margin of every kind at a pose, from the definitions."""
    r, all_legs = legs(n, design, x)
    limits = design["limits"]
    found = {kind: [] for kind in KINDS}
    for i, (line, arm) in enumerate(all_legs):
        length = n.sqrt(dot(line, line))
        found["min_leg_length"].append(length - n.number(limits["leg_length"][0]))
        found["max_leg_length"].append(n.number(limits["leg_length"][1]) - length)
        for body, vector in (("base", line), ("platform", back(r, line))):
            axis = [n.number(v) for v in limits[f"{body}_axes"][i]]
            off = cross(vector, axis)
            angle = n.angle(n.sqrt(dot(off, off)), dot(vector, axis)) * 180 / n.pi
            found[f"{body}_cone_angle"].append(n.number(limits[f"{body}_cone_angle_deg"]) - angle)
        lever = cross(arm, line)
        lever = n.sqrt(dot(lever, lever)) / length
        linear, angular = limits["speed"]
        found["leg_speed"].append(n.number(limits["max_leg_speed"]) - n.number(linear) - lever * n.number(angular) * n.pi / 180)
    return found


def determinant(n, design, x, scale=1.0):
    """det of the rows (n_i, R b_i x n_i), by elimination with the largest pivot."""
    _, all_legs = legs(n, design, x, scale)
    m = [line + cross(arm, line) for line, arm in all_legs]
    out = n.number(1)
    for c in range(6):
        k = max(range(c, 6), key=lambda i: float(abs(m[i][c])) if n is DOUBLES else float(abs(m[i][c]).mid()))
        if k != c:
            m[k], m[c], out = m[c], m[k], -out
        out = out * m[c][c]
        if n is DOUBLES and m[c][c] == 0:
            return 0.0
        for i in range(c + 1, 6):
            f = m[i][c] / m[c][c]
            m[i] = [u - f * v for u, v in zip(m[i], m[c])]
    return out


DOUBLES, BALLS = Doubles(), Balls()


def random_design(rng):
    """A platform with legs in pairs or of octahedral type, wide workspace, axes of joints near the legs, limits near what the poses need."""
    octahedral = rng.random() < 0.4
    def ring(radius, count, phase):
        out = []
        for k in range(count):
            side = 0 if count == 3 else (-0.35, 0.35)[k % 2]
            step = k if count == 3 else k // 2
            angle = step * 2 * math.pi / 3 + side + phase + rng.uniform(-0.2, 0.2)
            out.append([radius * math.cos(angle), radius * math.sin(angle), radius * rng.uniform(-0.1, 0.1)])
        return out
    count = 3 if octahedral else 6
    base, platform = ring(10, count, 0), ring(rng.uniform(4, 9), count, math.pi / 3)
    pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)] if octahedral else [(0, 5), (1, 0), (2, 1), (3, 2), (4, 3), (5, 4)]
    wide = rng.uniform(5, 60)
    design = {
        "base": base,
        "platform": platform,
        "pairs": pairs,
        "legs": [(base[i], platform[j]) for i, j in pairs],
        "home": [rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(9, 15)],
        "region": rng.choice(["box", "ellipsoid"]),
        "translation": [rng.choice([0.0, rng.uniform(0, 2)]) for _ in range(3)],
        "rotation_deg": [rng.choice([0.0, wide, rng.uniform(0, wide)]) for _ in range(3)],
    }
    if not any(design["translation"]) and not any(design["rotation_deg"]):
        design["rotation_deg"] = [wide] * 3
    axes = {"base_axes": [], "platform_axes": []}
    for a, b in design["legs"]:
        line = [v + h - u for u, v, h in zip(a, b, design["home"])]
        for body in axes:
            v = [x + rng.gauss(0, 1) for x in line]
            size = math.sqrt(dot(v, v))
            axes[body].append([x / size for x in v])
    design["limits"] = {
        **axes,
        "leg_length": [1.0, 50.0],
        "base_cone_angle_deg": 170.0,
        "platform_cone_angle_deg": 170.0,
        "max_leg_speed": 100.0,
        "speed": [1.0, 40.0],
    }
    # limits that some poses need, to either side
    worst = {kind: min(min(margins(DOUBLES, design, draw(rng, design))[kind]) for _ in range(60)) for kind in KINDS}
    off = lambda: 1 + rng.choice([-1, 1, 1]) * 10 ** rng.uniform(-3, -1)
    limits = design["limits"]
    limits["leg_length"] = [(1.0 + worst["min_leg_length"]) / off(), (50.0 - worst["max_leg_length"]) * off()]
    for body in ("base", "platform"):
        limits[f"{body}_cone_angle_deg"] = min(170.0, (170.0 - worst[f"{body}_cone_angle"]) * off() * 1.05)
    limits["max_leg_speed"] = (100.0 - worst["leg_speed"]) * off()
    return design


def draw(rng, design):
    """Coordinates in the unit box or the two unit balls, mostly on the boundary."""
    x = [rng.uniform(-1, 1) for _ in range(6)]
    if design["region"] == "box":
        return [math.copysign(1, v) if rng.random() < 0.6 else v for v in x]
    return held(design, x, surface=rng.random() < 0.7)


def held(design, x, surface=False):
    """Moved into the region."""
    if design["region"] == "box":
        return [max(-1.0, min(1.0, v)) for v in x]
    out = []
    for part, widths in ((x[:3], design["translation"]), (x[3:], design["rotation_deg"])):
        part = [v if w else 0.0 for v, w in zip(part, widths)]
        norm = math.sqrt(dot(part, part))
        if norm > 1 or (surface and norm > 0):
            part = [v / norm * (1 - 1e-15) for v in part]
        out += part
    return out


def worst(rng, design, value, points=300, steps=250, starts=3):
    """Coordinates at which a function is small, by drawing and random steps from the best draws."""
    drawn = sorted(((value(x), k, x) for k, x in enumerate(draw(rng, design) for _ in range(points))))
    found = []
    for least, _, best in drawn[:starts]:
        reach = 0.5
        for step in range(steps):
            one = rng.randrange(6) if step % 2 else None
            trial = held(design, [v + reach * rng.uniform(-1, 1) if one in (None, k) else v for k, v in enumerate(best)])
            there = value(trial)
            if there < least:
                best, least = trial, there
            else:
                reach = max(1e-7, reach * 0.95)
        found.append((least, best))
    return min(found)[1]


def text(design):
    def table(name, joints, letter):
        return f"[{name}]\n" + "".join(f"{letter}{k} = {json.dumps(v)}\n" for k, v in enumerate(joints))
    limits = design["limits"]
    names = json.dumps([[f"A{i}", f"B{j}"] for i, j in design["pairs"]])
    lines = [
        'name = "drawn"\nunits = "mm"\nlegs = ' + names,
        table("base", design["base"], "A"),
        table("platform", design["platform"], "B"),
        f"[home]\nposition = {json.dumps(design['home'])}\nrpy_deg = [0.0, 0.0, 0.0]",
        f"[workspace]\nregion = \"{design['region']}\"\ntranslation = {json.dumps(design['translation'])}\nrotation_deg = {json.dumps(design['rotation_deg'])}",
        "[hardware]",
        *(f"{key} = {json.dumps(limits[key])}" for key in limits if key != "speed"),
        f"[speed]\nlinear = {limits['speed'][0]}\nangular_deg = {limits['speed'][1]}",
    ]
    return "\n".join(lines) + "\n"


def refutes(design, kind, proved, x):
    """Why a pose refutes a proved margin, in balls; None where it does not."""
    value = min(margins(BALLS, design, x)[kind], key=lambda v: float(v.mid()))
    # joints of the region are reached to 1e-15 of their widths
    slack = 1e-11 * (1 + abs(proved))
    return f"{kind}: margin {value} at {x}, proved {proved}" if bool(value < exact(proved - slack)) else None


def check_assess(rng, design, found, tally, where):
    complaints = []
    for record in found["requirements"]:
        kind, proved = record["name"], record["proved_margin"]
        if kind not in KINDS:
            continue
        x = worst(rng, design, lambda x: min(margins(DOUBLES, design, x)[kind]))
        if proved is not None:
            tally.count("proved margins")
            complaints += [c for c in [refutes(design, kind, proved, x)] if c]
        least = min(margins(DOUBLES, design, x)[kind])
        if record["met"] is True and least < -1e-9:
            complaints.append(f"{kind} is called met, {least} at {x}")
        if record["met"] is False:
            tally.count("violations")
            if record["margin"] > 0:
                complaints.append(f"{kind} is called violated with margin {record['margin']}")
        if record["met"] is None and least < -1e-2 * abs(record["margin"] or 1):
            tally.count("violations not found, called searched")
    if found["regular"]["status"] == "proved":
        tally.count("regular workspaces")
        complaints += sign_complaint(rng, design, 1.0)
    return [f"{where}: {c}" for c in complaints]


def sign_complaint(rng, design, scale):
    """A pose of the scaled region at which det J has another sign than at home."""
    home = determinant(DOUBLES, design, [0.0] * 6)
    sign = math.copysign(1, home)
    x = worst(rng, design, lambda x: sign * determinant(DOUBLES, design, x, scale), points=400)
    value = determinant(BALLS, design, x, scale)
    return [f"det J has the other sign at {x} of scale {scale}"] if bool(value * exact(sign) < 0) else []


def run(program, options, tally):
    ctx.prec = BITS
    k = 0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "design.toml"
        while sum(tally.checked.get(x, 0) for x in ("proved margins", "proved sets")) < options.bounds:
            rng = stream(options.seed, "workspace", k)
            design = random_design(rng)
            path.write_text(text(design))
            where = f"workspace {k} (seed {options.seed})"
            found, code = answer(program, "assess", path, "--points", 300, "--cells", 1500)
            if {True: 0, False: 1, None: 3}[found["met"]] != code:
                tally.fault(f"{where}: exit {code} with met {found['met']}")
            for complaint in check_assess(rng, design, found, tally, where):
                tally.fault(complaint)
            scaled, _ = answer(program, "singular", "poses", path, "--cells", 1500)
            proved = scaled["box"]["proved_scale"]
            if proved > 0:
                tally.count("proved sets")
                for complaint in sign_complaint(rng, design, proved):
                    tally.fault(f"{where}: {complaint}")
            if k < 3:
                plant(rng, design, found, scaled, tally, where)
            k += 1


def plant(rng, design, found, scaled, tally, where):
    """Bounds that are not true have to be refuted."""
    for record in found["requirements"]:
        kind = record["name"]
        if kind not in KINDS or record["margin"] is None:
            continue
        x = worst(rng, design, lambda x: min(margins(DOUBLES, design, x)[kind]), points=600, steps=600, starts=8)
        wrong = record["margin"] + 0.02 * (1 + abs(record["margin"]))
        tally.planted(f"{where}: {kind} raised by two hundredths", refutes(design, kind, wrong, x))
    within = scaled["box"]["singular_within"]
    if within and within["scale"] < 3:
        wrong = 1.3 * within["scale"]
        tally.planted(f"{where}: regular set 30 % larger than a singular one", sign_complaint(rng, design, wrong))

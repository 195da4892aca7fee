"""Random designs with leg lengths, from a seed: the classes on which certificates are checked.

* general: six separate joints on each body.
* octahedral: two triangles.
* hexapod: symmetric, joints rounded to doubles.
* near-double: lengths at a singular pose, off by 1e-14 to 1e-6.
* double, triple: joints and lengths in whole numbers at a singular pose that counts so often.
* far: platform similar to the base up to 2^-12 to 2^-30 of its size, with poses far out.
* scaled: general, in other units and far from the origin.
"""

import math


def rotation(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    n = math.sqrt(sum(x * x for x in q))
    w, x, y, z = (v / n for v in q)
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def moved(r, p, b):
    return [sum(r[i][j] * b[j] for j in range(3)) + p[i] for i in range(3)]


def lengths(legs, r, p):
    return [math.dist(moved(r, p, b), a) for a, b in legs]


def determinant(rows):
    m, out = [list(row) for row in rows], 1.0
    for c in range(6):
        k = max(range(c, 6), key=lambda i: abs(m[i][c]))
        if m[k][c] == 0:
            return 0.0
        if k != c:
            m[k], m[c], out = m[c], m[k], -out
        out *= m[c][c]
        for i in range(c + 1, 6):
            f = m[i][c] / m[c][c]
            m[i] = [x - f * y for x, y in zip(m[i], m[c])]
    return out


def lines(legs, r, p):
    """Rows (direction, moment about the base origin), unnormalised."""
    out = []
    for a, b in legs:
        q = moved(r, p, b)
        d = [u - v for u, v in zip(q, a)]
        out.append(d + [a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2], a[0] * d[1] - a[1] * d[0]])
    return out


def singular_pose(rng, legs, size):
    """A position on a segment at which the determinant changes its sign, or None."""
    r = rotation(rng)
    ends = [[rng.gauss(0, size) for _ in range(3)] for _ in range(2)]
    at = lambda t: [u + t * (v - u) for u, v in zip(*ends)]
    low, high = 0.0, 1.0
    sign = determinant(lines(legs, r, at(low))) > 0
    if sign == (determinant(lines(legs, r, at(high))) > 0):
        return None
    for _ in range(80):
        middle = (low + high) / 2
        if (determinant(lines(legs, r, at(middle))) > 0) == sign:
            low = middle
        else:
            high = middle
    return r, at(low)


def general(rng, size=1.0, shift=0.0):
    point = lambda s: [rng.gauss(0, s) + shift for _ in range(3)]
    return [(point(1.5 * size), point(size)) for _ in range(6)]


def octahedral(rng):
    base, platform = [[[rng.uniform(-2, 2) for _ in range(3)] for _ in range(3)] for _ in range(2)]
    return [(base[i], platform[j]) for i, j in ((0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2))]


def hexapod(rng):
    radii, halves = [rng.uniform(1, 3), rng.uniform(0.5, 2)], [rng.uniform(0.05, 0.9) for _ in range(2)]

    def ring(radius, half, turn):
        angles = [turn + 2 * math.pi * (k // 2) / 3 + (half if k % 2 else -half) for k in range(6)]
        return [[radius * math.cos(t), radius * math.sin(t), 0.0] for t in angles]

    base, platform = ring(radii[0], halves[0], 0.0), ring(radii[1], halves[1], rng.uniform(0.2, 1.0))
    return list(zip(base, platform))


def far(rng):
    factor, off = rng.uniform(0.4, 0.9), 2.0 ** -rng.randint(12, 30)
    r = rotation(rng)
    base = [[rng.gauss(0, 1.5) for _ in range(3)] for _ in range(6)]
    like = lambda a: [factor * x + off * rng.gauss(0, 1) for x in moved(r, [0.1, 0.2, -0.1], a)]
    return [(a, like(a)) for a in base]


def multiple(rng, triple):
    """Joints in whole numbers at a singular pose, and lengths whose squares are exact up to their own rounding. Every
    leg is perpendicular to one velocity of its joint. With a mirror plane that reverses the velocity the pose counts
    three times."""
    whole = lambda most: [rng.randint(-most, most) for _ in range(3)]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    velocity, turn, position = whole(4), whole(4), [u + v for u, v in zip(whole(3), (0, 0, 9))]
    if triple:
        velocity[1] = velocity[2] = turn[0] = position[0] = 0
    legs = []
    while len(legs) < 6:
        b = whole(6)
        speed = [u + v for u, v in zip(velocity, cross(turn, b))]
        # a leg along a Pythagorean multiple of a direction across the speed has a whole length
        leg = cross(speed, whole(3))
        square = sum(x * x for x in leg)
        if not square or math.isqrt(square) ** 2 != square or (triple and not b[0]):
            continue
        ends = [([x + p - d for x, p, d in zip(b, position, leg)], b)]
        if triple:
            ends.append(tuple([-x, y, z] for x, y, z in ends[0]))
        legs += ends
    base = {f"A{i + 1}": [float(x) for x in a] for i, (a, _) in enumerate(legs)}
    platform = {f"B{i + 1}": [float(x) for x in b] for i, (_, b) in enumerate(legs)}
    row = [math.sqrt(sum((x + p - y) ** 2 for x, p, y in zip(b, position, a))) for a, b in legs]
    name = "triple" if triple else "double"
    design = {"name": name, "units": "mm", "base": base, "platform": platform, "legs": [[f"A{i}", f"B{i}"] for i in range(1, 7)]}
    return design, [row]


def draw(rng, k):
    """Name, design as a document, rows of lengths."""
    name = ("general", "octahedral", "hexapod", "near-double", "far", "scaled", "near-double octahedral", "double", "triple")[k % 9]
    size = 1.0
    if name in ("double", "triple"):
        return (name, *multiple(rng, name == "triple"))
    if name in ("general", "near-double"):
        legs = general(rng)
    elif name.endswith("octahedral"):
        legs = octahedral(rng)
    elif name == "hexapod":
        legs = hexapod(rng)
    elif name == "far":
        legs = far(rng)
    else:
        size = 10.0 ** rng.randint(-6, 6)
        legs = general(rng, size, size * rng.uniform(-20, 20))
    rows = []
    while len(rows) < 2:
        pose = (rotation(rng), [rng.gauss(0, size) for _ in range(3)])
        if name.startswith("near-double"):
            pose = singular_pose(rng, legs, 1.0) or pose
        row = lengths(legs, *pose)
        if name.startswith("near-double"):
            off = 10.0 ** -rng.randint(6, 15)
            row = [l * (1 + off * rng.gauss(0, 1)) for l in row]
        rows.append(row)
    names = [[], []]
    joints = [{}, {}]
    for a, b in legs:
        for body, point in enumerate((a, b)):
            known = next((n for n, q in joints[body].items() if q == point), None)
            if known is None:
                known = f"{'AB'[body]}{len(joints[body]) + 1}"
                joints[body][known] = point
            names[body].append(known)
    design = {"name": name, "units": "mm", "base": joints[0], "platform": joints[1], "legs": [list(pair) for pair in zip(*names)]}
    return name, design, rows

"""Global bounds and infeasibility of `optimize` (offsets), against offsets drawn here.

The statements: no offsets `t` within the limits have a worst inverse condition number above `global_bound.upper`. No
offsets at all are within the limits if `status` is `infeasible`. `optimal` means that the gap to the bound is at most
the `tolerance`.

The limits (docs/theory/offset-optimisation.md): `-e <= t_i <= 1 + e`, `abs(prod(1 - t_i) - prod(t_i)) >= min_abs_det`,
any two of the six joints of a body at least `min_joint_distance` apart. They are decided in exact rationals.
Conditioning comes from eigenvalues of `J^T J` in doubles; a point that exceeds the bound by rounding (1e-9) is no
fault.

The check: triangles are random, some 1e-6 the size of the other. In a third of the problems offsets known here just
meet distance and determinant; 0.1.0 called such problems infeasible. Offsets are drawn all over the box, at its
corners, near the answer and near the known ones, and climb by random steps. Such a check refutes and does not prove.
"""

import json
import math
import pathlib
import tempfile

from common import answer, rational, stream

SLACK = 1e-9


def triangle(rng, size):
    while True:
        points = [[size * rng.uniform(-1, 1), size * rng.uniform(-1, 1), 0.0] for _ in range(3)]
        (ax, ay, _), (bx, by, _), (cx, cy, _) = points
        area = abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
        longest = max(math.dist(points[i], points[i - 1]) for i in range(3))
        if area > 0.13 * longest**2:
            return points


class Problem:
    """Two triangles, limits, poses."""

    def __init__(self, rng, number):
        self.ratio = [1.0, 0.5, 1e-6, 0.3, 1e3, 0.7][number % 6]
        self.base, self.platform = triangle(rng, 1.0), triangle(rng, self.ratio)
        self.extension = [0.0, 1.0, 0.0][number % 3]
        self.height = rng.uniform(0.8, 1.6) * max(1.0, self.ratio)
        self.translation = [0.1 * max(1.0, self.ratio)] * 3
        self.rotation_deg = [8.0, 8.0, 8.0] if number % 4 == 0 else [0.0, 0.0, 0.0]
        self.known = None
        if number % 3 == 2:
            self.known = [rng.uniform(0.02, 0.98) for _ in range(6)]
            if number % 2 == 0:
                self.known[0], self.known[3] = 0.125, 0.875
            distance, det = self.exact(self.known)
            self.distance, self.det = root_below(distance), below(det)
            # all joints as near to the starts of their edges as the distance allows but for 1e-11: the greatest determinant there is
            edges = [math.dist(*self.ends(i)[:2]) for i in range(6)]
            near = 0.08 * min(edges)
            corner = [near / edge * (1 + 1e-11) for edge in edges]
            distance, det = self.exact(corner)
            if number % 2 == 1 and distance >= rational(near) ** 2:
                self.known, self.distance, self.det = corner, near, below(det)
        else:
            radius = min(max(math.dist(p, centre(t)) for p in t) for t in (self.base, self.platform))
            self.distance, self.det = 0.05 * radius, 0.05

    def ends(self, i):
        """The edge on which the joint of side `i` slides, and the fixed joint of the other body."""
        k, n = i // 2, (i // 2 + 1) % 3
        if i % 2 == 0:
            return self.base[k], self.base[n], self.platform[k]
        return self.platform[k], self.platform[n], self.base[n]

    def exact(self, t):
        """Square of the least distance and size of the determinant, as fractions."""
        least = None
        for body in (0, 1):
            joints = []
            for i in range(body, 6, 2):
                a, b, _ = self.ends(i)
                for x in (rational(t[i]), rational(0.0)):
                    joints.append([rational(p) + (rational(q) - rational(p)) * x for p, q in zip(a, b)])
            for i in range(6):
                for j in range(i):
                    d = sum(((x - y) ** 2 for x, y in zip(joints[i], joints[j])), rational(0.0))
                    least = d if least is None or d < least else least
        free = own = rational(1.0)
        for x in t:
            free, own = free * (1 - rational(x)), own * rational(x)
        return least, abs(free - own)

    def meets(self, t):
        if any(not -self.extension <= x <= 1 + self.extension for x in t):
            return False
        det = math.prod(1 - x for x in t) - math.prod(t)
        if abs(det) < self.det * (1 - 1e-6):
            return False
        distance, det = self.exact(t)
        return distance >= rational(self.distance) ** 2 and det >= rational(self.det)

    def poses(self):
        axes = [k for k, w in enumerate(self.translation + self.rotation_deg) if w > 0]
        out = [(identity(), [0.0, 0.0, self.height])]
        for corner in range(1 << len(axes)):
            x = [0.0] * 6
            for bit, k in enumerate(axes):
                half = (self.translation + [math.radians(w) for w in self.rotation_deg])[k]
                x[k] = half if corner >> bit & 1 else -half
            out.append((turn(x[3:]), [x[0], x[1], self.height + x[2]]))
        return out

    def length(self):
        c = centre(self.platform)
        return math.sqrt(sum(math.dist(p, c) ** 2 for p in self.platform) / 3)

    def toml(self):
        lines = ['name = "drawn"', 'units = "m"']
        lines.append('legs = [["P1", "P4"], ["P2", "P4"], ["P2", "P5"], ["P3", "P5"], ["P3", "P6"], ["P1", "P6"]]')
        for name, first, points in (("base", 1, self.base), ("platform", 4, self.platform)):
            lines.append(f"[{name}]")
            lines += [f"P{first + k} = {json.dumps(p)}" for k, p in enumerate(points)]
        lines += ["[home]", f"position = [0.0, 0.0, {self.height!r}]", "rpy_deg = [0.0, 0.0, 0.0]"]
        lines += ["[workspace]", f"translation = {self.translation}", f"rotation_deg = {self.rotation_deg}", "grid = 2"]
        lines += ["[optimize]", f"min_joint_distance = {self.distance!r}", f"min_abs_det = {self.det!r}"]
        return "\n".join(lines) + "\n"


def centre(points):
    return [sum(p[k] for p in points) / 3 for k in range(3)]


def identity():
    return [[float(i == j) for j in range(3)] for i in range(3)]


def turn(w):
    """exp([w]x)."""
    angle = math.sqrt(sum(x * x for x in w))
    if angle == 0.0:
        return identity()
    x, y, z = (c / angle for c in w)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return [
        [c + x * x * d, x * y * d - z * s, x * z * d + y * s],
        [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
        [z * x * d - y * s, z * y * d + x * s, c + z * z * d],
    ]


def root_below(x):
    """The greatest double near the root whose square is at most `x`."""
    r = math.sqrt(float(int(x.p) / int(x.q)))
    while rational(r) ** 2 > x:
        r = math.nextafter(r, 0.0)
    while rational(math.nextafter(r, math.inf)) ** 2 <= x:
        r = math.nextafter(r, math.inf)
    return r


def below(x):
    r = int(x.p) / int(x.q)
    return math.nextafter(r, 0.0) if rational(r) > x else r


def eigenvalues(m):
    """Eigenvalues of a symmetric matrix, by Jacobi's rotations."""
    n = len(m)
    m = [row[:] for row in m]
    for _ in range(30):
        off = sum(m[i][j] ** 2 for i in range(n) for j in range(i))
        if off <= 1e-32 * sum(m[i][i] ** 2 for i in range(n)):
            break
        for p in range(n):
            for q in range(p + 1, n):
                if m[p][q] == 0.0:
                    continue
                theta = (m[q][q] - m[p][p]) / (2 * m[p][q])
                t = math.copysign(1.0, theta) / (abs(theta) + math.hypot(theta, 1.0))
                c = 1 / math.hypot(t, 1.0)
                s = t * c
                for k in range(n):
                    a, b = m[k][p], m[k][q]
                    m[k][p], m[k][q] = c * a - s * b, s * a + c * b
                for k in range(n):
                    a, b = m[p][k], m[q][k]
                    m[p][k], m[q][k] = c * a - s * b, s * a + c * b
    return sorted(m[i][i] for i in range(n))


def inverse_condition(problem, pose, t, length):
    rotation, position = pose
    rows = []
    for i in range(6):
        a, b, fixed = problem.ends(i)
        slid = [p + (q - p) * t[i] for p, q in zip(a, b)]
        base, platform = (slid, fixed) if i % 2 == 0 else (fixed, slid)
        arm = [sum(rotation[r][k] * platform[k] for k in range(3)) for r in range(3)]
        line = [arm[k] + position[k] - base[k] for k in range(3)]
        size = math.sqrt(sum(x * x for x in line))
        u = [x / size for x in line]
        moment = [arm[1] * u[2] - arm[2] * u[1], arm[2] * u[0] - arm[0] * u[2], arm[0] * u[1] - arm[1] * u[0]]
        rows.append(u + [x / length for x in moment])
    gram = [[sum(row[i] * row[j] for row in rows) for j in range(6)] for i in range(6)]
    values = eigenvalues(gram)
    return math.sqrt(max(values[0], 0.0) / values[-1])


class Judge:
    """The worst inverse condition number over the poses, given up below a floor."""

    def __init__(self, problem):
        self.problem, self.poses, self.length, self.worst = problem, problem.poses(), problem.length(), 0

    def value(self, t, floor):
        order = [self.worst] + [k for k in range(len(self.poses)) if k != self.worst]
        least = math.inf
        for k in order:
            least = min(least, inverse_condition(self.problem, self.poses[k], t, self.length))
            if least <= floor:
                self.worst = k
                return least
        return least


def complaint(problem, document, rng, effort):
    """The fault of the answer, or None."""
    status, bound = document["status"], document["global_bound"]
    low, high = -problem.extension, 1 + problem.extension
    draw = lambda: [rng.uniform(low, high) for _ in range(6)]
    near = lambda t, step: [min(max(x + step * rng.gauss(0, 1) * (rng.random() < 0.6), low), high) for x in t]
    starts = [t for t in (problem.known, document.get("offsets")) if t]
    if status == "infeasible":
        tries = [draw() for _ in range(20 * effort)] + starts
        tries += [[rng.choice([low, high, 0.5, 0.1, 0.9]) for _ in range(6)] for _ in range(5 * effort)]
        tries += [near(t, 10 ** rng.uniform(-9, -1)) for t in starts for _ in range(effort)]
        for t in tries:
            if problem.meets(t):
                return f"called infeasible, but {t} meets the limits"
        return None
    if status == "optimal" and not (bound and bound["gap"] <= document.get("tolerance", 0.0)):
        return f"called optimal with the bound {bound} and the tolerance {document.get('tolerance')}"
    if document.get("offsets") and not problem.meets(document["offsets"]):
        return f"the answer {document['offsets']} violates a limit"
    if not bound:
        return None
    judge, best = Judge(problem), (0.0, None)
    tries = starts + [draw() for _ in range(effort)]
    tries += [near(t, 10 ** rng.uniform(-6, -0.5)) for t in starts for _ in range(effort)]
    for t in tries:
        if problem.meets(t):
            value = judge.value(t, best[0])
            if value > best[0]:
                best = (value, t)
    for step in (0.1, 0.03, 0.01, 0.001):
        for _ in range(effort // 3):
            if best[1] is None:
                break
            t = near(best[1], step)
            if problem.meets(t):
                value = judge.value(t, best[0])
                if value > best[0]:
                    best = (value, t)
    if best[0] > bound["upper"] * (1 + SLACK):
        return f"the bound {bound['upper']} is exceeded: {best[1]} reaches {best[0]}"
    return None


def run(program, options, tally):
    effort = 60
    for number in range(options.bounds):
        problem = Problem(stream(options.seed, "offsets", number), number)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "drawn.toml")
            path.write_text(problem.toml())
            document, code = answer(program, "optimize", path, "--extension", problem.extension, "--gap", 0.1)
        wrong = complaint(problem, document, stream(options.seed, "drawn", number), effort)
        expected = {"optimal": 0, "infeasible": 1}.get(document["status"], 3)
        if wrong is None and code != expected:
            wrong = f"exit {code} with the status {document['status']}"
        if wrong:
            tally.fault(f"offsets {number}: {wrong}\n{problem.toml()}")
        tally.count(f"answers {document['status']}")
        if document["global_bound"]:
            tally.count("bounds")
        if number < 5 and document.get("offsets"):
            rng = stream(options.seed, "planted", number)
            if document["global_bound"]:
                low = dict(document, global_bound=dict(document["global_bound"], upper=0.999 * document["objective"]))
                tally.planted("a bound below the answer", complaint(problem, low, rng, effort))
            known = dict(document, status="infeasible")
            tally.planted("a feasible problem called infeasible", complaint(problem, known, rng, effort))
            wide = dict(document, status="optimal", global_bound=None)
            tally.planted("optimal without a proof", complaint(problem, wide, rng, effort))

"""Certificates of roots in the answers of `fk`, one by one in ball arithmetic of 600 bits.

A record of kind `study` makes a statement about the joints as the doubles they are, and the squared lengths as the
exact squares of the lengths. The system

    |g + e b_i - a_i e|^2 = s_i e.e (i = 1..6),   e.g = 0,   e_patch = 1,        g in `unit`,

has a root within `radius` of `centre + centre_low` (largest modulus of a coordinate), and no other within
`uniqueness_radius`. Its R and p lie in `enclosure`, and it is real or not as `reality` says.

A record of kind `octahedral` is about P4, P5, P6 on circles about P1 P2, P2 P3, P3 P1. The angles on these are counted
from the direction of the centre. There is a pose within `radius` (largest modulus of an angle) and no other within
`uniqueness_radius`.

In both kinds R and p of the solution are the certified ones to 2^-26. Far out, where the enclosure is wider (2^-10 at
most), the pose is its middle.

The check: Newton's method from the centre, then Krawczyk's test in balls about its end, proves a root and its place.
Uniqueness follows for quadrics from F(x) - F(y) = J((x + y) / 2) (x - y). For the angles the second derivatives over
the ball bound the change of J from J(c). With Y the inverse of J at the centre, |1 - Y J| < 1 is checked.

A record of kind `cluster` states that exactly `multiplicity` roots, counted with multiplicity, lie within `radius` of
the centre. R and p of all of them lie in `enclosure`, and no others lie within `uniqueness_radius`. The check uses
bordered equations of this file's own and the expansion of their solution. A Newton map contracts for all t in a disc,
the smallest for which it does. Rouche's theorem follows for the term of that order on its circle. For other roots the
same is checked on the circle that the stated radius needs.
"""

import json
import math
import pathlib
import tempfile

from flint import acb, acb_mat, arb, ctx, fmpq, fmpq_mat

import designs
from common import answer, exact, rational, stream

BITS = 600
NEAR = arb(2) ** -26
FAR_OUT = arb(2) ** -10
TINY = arb(2) ** -400
# quaternion units: product[i][j] = (k, sign)
UNITS = [
    [(0, 1), (1, 1), (2, 1), (3, 1)],
    [(1, 1), (0, -1), (3, 1), (2, -1)],
    [(2, 1), (3, -1), (0, -1), (1, 1)],
    [(3, 1), (2, 1), (1, -1), (0, -1)],
]


def upper(x):
    """An upper bound of |x| as a ball of radius zero."""
    return abs(x).upper() if isinstance(x, arb) else abs(x).upper()


def below(x, y):
    """x < y for all numbers of both balls."""
    return bool(x < y)


def largest(items):
    items = [upper(x) for x in items]
    out = items[0]
    for x in items[1:]:
        out = out if bool(x <= out) else x
    return out


def complex_of(part, k):
    return acb(exact(part["re"][k]), exact(part["im"][k]))


def middle(z):
    return acb(z.real.mid(), z.imag.mid())


def ball(z, radius):
    """All complex numbers within `radius` of z, and some more: a square."""
    r = arb(0, radius.upper())
    return acb(z.real + r, z.imag + r)


class Refuted(Exception):
    """The fault of a record."""


def need(truth, what):
    if not truth:
        raise Refuted(what)


# --- roots of systems --------------------------------------------------------------------------------------------------------------------------------


def newton(f, jacobian, start):
    """The end of Newton's method, midpoints only."""
    x = [middle(z) for z in start]
    for _ in range(60):
        try:
            step = jacobian(x).solve(acb_mat([[v] for v in f(x)]))
        except ZeroDivisionError:
            raise Refuted("singular Jacobian on the way")
        x = [middle(z - step[i, 0]) for i, z in enumerate(x)]
        if all(bool(upper(step[i, 0]) < TINY) for i in range(len(x))):
            return x
    raise Refuted("Newton's method does not settle")


def proved_box(f, jacobian, x, radius):
    """A box about x of half width `radius` that holds exactly one root (Krawczyk 1969), made smaller; or a complaint."""
    box = [ball(z, radius) for z in x]
    y = middle_inverse(jacobian(x))
    image = acb_mat([[z] for z in x]) - y * acb_mat([[v] for v in f(x)])
    n = len(x)
    spread = acb_mat([[box[i] - x[i]] for i in range(n)])
    one = acb_mat([[1 if i == j else 0 for j in range(n)] for i in range(n)])
    image = image + (one - y * jacobian(box)) * spread
    out = [image[i, 0] for i in range(n)]
    for i in range(n):
        need(box[i].contains(out[i]) and bool(upper(out[i] - x[i]) < radius), "no proof of a root near the end of Newton's method")
    return out


def middle_inverse(matrix):
    try:
        inverse = matrix.inv()
    except ZeroDivisionError:
        raise Refuted("singular Jacobian")
    n = inverse.nrows()
    return acb_mat([[middle(inverse[i, j]) for j in range(n)] for i in range(n)])


def is_real(f, jacobian, x):
    """True or False when the root near x is proved to be real or not."""
    box = proved_box(f, jacobian, x, arb(2) ** -200)
    if any(not z.imag.contains(0) for z in box):
        return False
    # a box that is its own conjugate, with one root of a real system in it
    flat = [acb(z.real.mid(), 0) for z in x]
    proved_box(f, jacobian, flat, arb(2) ** -190)
    return True


# --- kind `study` ------------------------------------------------------------------------------------------------------------------------------------


class Study:
    """Seven quadrics in the seven coordinates other than the patch, as symmetric matrices of exact numbers."""

    def __init__(self, legs, lengths, patch, unit):
        self.patch = patch
        self.free = [k for k in range(8) if k != patch]
        self.forms = []
        for (a, b), l in zip(legs, lengths):
            a, b = [exact(x) / unit for x in a], [exact(x) / unit for x in b]
            # v = g + e b - a e as a 4 x 8 matrix
            v = [[arb(0)] * 8 for _ in range(4)]
            for k in range(4):
                v[k][4 + k] = arb(1)
            for i in range(4):
                for j in range(1, 4):
                    k, sign = UNITS[i][j]
                    v[k][i] = v[k][i] + sign * b[j - 1]
                    k, sign = UNITS[j][i]
                    v[k][i] = v[k][i] - sign * a[j - 1]
            s = (exact(l) / unit) ** 2
            form = [[sum((v[r][i] * v[r][j] for r in range(4)), arb(0)) for j in range(8)] for i in range(8)]
            for k in range(4):
                form[k][k] = form[k][k] - s
            self.forms.append(form)
        study = [[arb(0)] * 8 for _ in range(8)]
        for k in range(4):
            study[k][4 + k] = study[4 + k][k] = arb(1)
        self.forms.append(study)
        self.matrices = [acb_mat([[x for x in row] for row in form]) for form in self.forms]

    def whole(self, x):
        x = list(x)
        return x[: self.patch] + [acb(1)] + x[self.patch :]

    def values(self, x):
        column = acb_mat([[z] for z in self.whole(x)])
        out = []
        for m in self.matrices:
            image = m * column
            out.append(sum((column[i, 0] * image[i, 0] for i in range(8)), acb(0)))
        return out

    def jacobian(self, x):
        column = acb_mat([[z] for z in self.whole(x)])
        rows = []
        for m in self.matrices:
            image = m * column
            rows.append([2 * image[i, 0] for i in self.free])
        return acb_mat(rows)

    def curvature(self, y):
        """A bound of |Y (h' M_i k)_i| over all h, k with moduli at most 1."""
        total = []
        for row in range(7):
            combined = None
            for i, m in enumerate(self.matrices):
                part = m * y[row, i]
                combined = part if combined is None else combined + part
            total.append(sum((upper(combined[p, q]) for p in self.free for q in self.free), arb(0)))
        return largest(total)


def pose_of(x, unit):
    """R (rows) and p of e, g."""
    w, a, b, c, g0, g1, g2, g3 = x
    n = w * w + a * a + b * b + c * c
    need(not n.contains(0), "e.e may vanish")
    r = [
        [w * w + a * a - b * b - c * c, 2 * (a * b - w * c), 2 * (a * c + w * b)],
        [2 * (a * b + w * c), w * w - a * a + b * b - c * c, 2 * (b * c - w * a)],
        [2 * (a * c - w * b), 2 * (b * c + w * a), w * w - a * a - b * b + c * c],
    ]
    # p = g conj(e) / e.e
    p = [-g0 * a + g1 * w - g2 * c + g3 * b, -g0 * b + g1 * c + g2 * w - g3 * a, -g0 * c - g1 * b + g2 * a + g3 * w]
    return [[z / n for z in row] for row in r], [z / n * unit for z in p]


def check_study(legs, lengths, solution, record):
    unit, patch = exact(record["unit"]), record["patch"]
    need(0 <= patch < 4 and bool(unit > 0), "no patch or unit")
    system = Study(legs, lengths, patch, unit)
    centre = [complex_of(record["centre"], k) + complex_of(record["centre_low"], k) for k in range(8)]
    need(bool(abs(centre[patch] - 1) == 0), "the patch is not 1 at the centre")
    centre = [centre[k] for k in system.free]
    radius, alone = exact(record["radius"]), exact(record["uniqueness_radius"])
    need(bool(radius >= 0) and bool(alone > radius), "radii")
    x = newton(system.values, system.jacobian, centre)
    box = proved_box(system.values, system.jacobian, x, arb(2) ** -300)
    away = largest([z - c for z, c in zip(box, centre)])
    need(bool(away <= radius), f"the root is {away.str(5)} from the centre, not {radius.str(5)}")
    # x, y are roots within `alone`, one of them this one; J has to be regular at their middle, which is within
    # `alone` of the centre
    y = middle_inverse(system.jacobian(centre))
    bound = system.curvature(y) * (alone + away)
    defect = y * system.jacobian(centre)
    kappa = largest(
        [sum((upper(defect[i, j] - (1 if i == j else 0)) for j in range(7)), arb(0)) for i in range(7)]
    )
    need(below(bound + kappa, arb(1)), f"not alone within {alone.str(5)}: {bound.str(8)}")
    need_reality(is_real(system.values, system.jacobian, x), record, solution)
    rotation, position = pose_of(system.whole(box), unit)
    size = max(abs(x) for leg in legs for joint in leg for x in joint)
    check_pose(rotation, position, power_of_two(max(size, *lengths)), solution, record)
    return (patch, unit, system.whole(box))


# --- kind `cluster` ------------------------------------------------------------------------------------------------------------------------------------


def flat_directions(matrix):
    """The column that the image of a 7 x 7 matrix lacks and the row that its kernel needs, to the digits of doubles."""
    import numpy

    values = numpy.array([[complex(matrix[i, j]) for j in range(7)] for i in range(7)])
    u, _, v = numpy.linalg.svd(values)
    return [acb(z.real, z.imag) for z in u[:, 6]], [acb(z.real, z.imag) for z in v[6, :]]


def expansion(system, y, patch, order):
    """The terms of the solution of the bordered equations, to twice the order, products of terms up to the order."""
    whole = lambda t: acb_mat([[x] for x in t[:patch] + [acb(0)] + t[patch:7]])
    z = [[y[i, 7] for i in range(8)]]
    for n in range(2, 2 * order + 1):
        values = []
        for m in system.matrices:
            value = acb(0)
            for i in range(max(1, n - order), min(order, n - 1) + 1):
                h, image = whole(z[i - 1]), m * whole(z[n - i - 1])
                value += sum((h[k, 0] * image[k, 0] for k in range(8)), acb(0))
            values.append(value)
        z.append([-sum((y[r, k] * values[k] for k in range(7)), acb(0)) for r in range(8)])
    return z


def check_cluster(legs, lengths, solution, record):
    unit, patch, count = exact(record["unit"]), record["patch"], record["multiplicity"]
    need(0 <= patch < 4 and bool(unit > 0) and count >= 2, "no patch, unit or number of roots")
    system = Study(legs, lengths, patch, unit)
    centre = [complex_of(record["centre"], k) + complex_of(record["centre_low"], k) for k in range(8)]
    need(bool(abs(centre[patch] - 1) == 0), "the patch is not 1 at the centre")
    centre = [centre[k] for k in system.free]
    radius, alone = exact(record["radius"]), exact(record["uniqueness_radius"])
    j = system.jacobian(centre)
    w, l = flat_directions(j)
    bordered = acb_mat([[j[i, k] for k in range(7)] + [-w[i]] for i in range(7)] + [l + [acb(0)]])
    y = middle_inverse(bordered)
    defect = y * bordered
    rows = [sum((upper(defect[i, k] - (1 if i == k else 0)) for k in range(8)), arb(0)) for i in range(8)]
    kappa = largest(rows)
    f = system.values(centre)
    steps = [upper(sum((y[i, k] * f[k] for k in range(7)), acb(0))) for i in range(8)]
    curved = []
    for i in range(8):
        combined = None
        for k, m in enumerate(system.matrices):
            part = m * y[i, k]
            combined = part if combined is None else combined + part
        curved.append(sum((upper(combined[p, q]) for p in system.free for q in system.free), arb(0)))
    eta, beta = largest(steps), largest(curved)
    order = count + 1
    z = expansion(system, y, patch, order)
    whole, own, last = ([largest(t[a:b]) for t in z] for a, b in ((0, 8), (0, 7), (7, 8)))
    main = abs(z[count - 1][7]).lower()

    def total(sizes, numbers, rho):
        return sum((sizes[n - 1] * rho**n for n in numbers), arb(0))

    def proved(rho):
        """The radius of the ball that holds the roots if so many are proved on this circle."""
        first, all_orders = range(1, order + 1), range(1, 2 * order + 1)
        h, size = total(own, first, rho), total(whole, first, rho)
        rest = 3 * (eta + kappa * size + total(whole, range(order + 1, 2 * order + 1), rho))
        quadratic = 2 * h * rest + rest**2
        inside = below(rest / 3 + kappa * rest + beta * quadratic, rest)
        contracts = below(kappa + 2 * beta * (h + rest), arb(1))
        other = total(last, [n for n in all_orders if n != count], rho)
        other += steps[7] + rows[7] * (size + rest) + curved[7] * quadratic
        return h + rest if inside and contracts and below(other, main * rho**count) else None

    away = next((x for x in (proved(arb(2) ** e) for e in range(-140, -3)) if x is not None), None)
    if away is None:
        raise Refuted(f"no disc in which there are {count} roots")
    need(bool(away <= radius), f"the roots are within {away.str(5)} of the centre, not {radius.str(5)}")
    if bool(alone > 0):
        rho = alone * sum((upper(x) for x in l), arb(0))
        first = range(1, order + 1)
        h = total(own, first, rho)
        wide = ((1 - kappa) / (2 * beta) - h) * arb("0.999")
        alone_there = below(alone + h, wide) and below(total(last, first, rho), wide)
        need(alone_there and proved(rho) is not None, f"others may lie within {alone.str(5)}")
    box = [ball(x, away) for x in centre]
    stated = record["reality"]
    need(stated in ("undecided", "non_real"), f"roots of a cluster are said to be {stated}")
    need(stated == "undecided" or any(not x.imag.contains(0) for x in box), "said to be not real without proof")
    need(solution["real"] is {"undecided": None, "non_real": False}[stated], "`real` is not what is proved")
    need(solution["multiplicity"] == count, "roots of a cluster that are not counted")
    rotation, position = pose_of(system.whole(box), unit)
    e = record["enclosure"]
    for i in range(3):
        for k in range(3):
            disc = ball(acb(exact(e["R"]["re"][i][k]), exact(e["R"]["im"][i][k])), exact(e["R"]["radius"][i][k]))
            need(disc.contains(rotation[i][k]), f"R[{i}][{k}] is not in its disc")
            given = acb(exact(solution["R"]["re"][i][k]), exact(solution["R"]["im"][i][k]))
            need(disc.contains(given), f"R[{i}][{k}] of the pose is not in its disc")
        disc = ball(acb(exact(e["p"]["re"][i]), exact(e["p"]["im"][i])), exact(e["p"]["radius"][i]))
        need(disc.contains(position[i]), f"p[{i}] is not in its disc")
    return (patch, unit, system.whole(box))


# --- kind `octahedral` -------------------------------------------------------------------------------------------------------------------------------


def square(p, q):
    return sum(((u - v) ** 2 for u, v in zip(p, q)), fmpq(0))


class Corners:
    """Six equations in (h, z) of P4, P5, P6: each on its circle about a side of the base, and three sides of the platform."""

    def __init__(self, legs, lengths, order):
        a, b = [[[rational(x) for x in legs[i][k]] for i in order] for k in range(2)]
        need(a[1] == a[2] and a[3] == a[4] and a[0] == a[5], "base joints are not shared as they should be")
        need(b[0] == b[1] and b[2] == b[3] and b[4] == b[5], "platform joints are not shared as they should be")
        self.points = p1, p2, p3, p4, p5, p6 = a[0], a[1], a[3], b[0], b[2], b[4]
        s14, s24, s25, s35, s36, s16 = [rational(lengths[i]) ** 2 for i in order]
        lift = lambda p: [acb(arb(x)) for x in p]
        long = lambda v: dot(v, v).real.sqrt()
        normal = cross(minus(lift(p2), lift(p1)), minus(lift(p3), lift(p1)))
        need(bool(long(normal) > 0), "a flat triangle")
        self.normal = [x / long(normal) for x in normal]
        self.middles, self.across, self.radii = [], [], []
        for first, second, one, other in ((p1, p2, s14, s24), (p2, p3, s25, s35), (p3, p1, s36, s16)):
            # the foot on the side: as many times the side as the difference of the squares says, exactly
            side = square(first, second)
            part = (one + side - other) / (2 * side)
            way = [v - u for u, v in zip(first, second)]
            self.middles.append(lift([u + part * w for u, w in zip(first, way)]))
            self.radii.append(acb(arb(one - part * part * side)))
            along = [x / arb(side).sqrt() for x in lift(way)]
            self.across.append(cross(self.normal, along))
        self.sides = [acb(arb(square(*pair))) for pair in ((p4, p5), (p5, p6), (p6, p4))]

    def corner(self, k, h, z):
        return [m + h * a + z * n for m, a, n in zip(self.middles[k], self.across[k], self.normal)]

    def values(self, x):
        places = [self.corner(k, x[2 * k], x[2 * k + 1]) for k in range(3)]
        circles = [x[2 * k] ** 2 + x[2 * k + 1] ** 2 - self.radii[k] for k in range(3)]
        between = [minus(places[k], places[(k + 1) % 3]) for k in range(3)]
        return circles + [dot(d, d) - self.sides[k] for k, d in enumerate(between)]

    def jacobian(self, x):
        places = [self.corner(k, x[2 * k], x[2 * k + 1]) for k in range(3)]
        rows = [[acb(0)] * 6 for _ in range(6)]
        for k in range(3):
            l = (k + 1) % 3
            rows[k][2 * k], rows[k][2 * k + 1] = 2 * x[2 * k], 2 * x[2 * k + 1]
            d = minus(places[k], places[l])
            rows[3 + k][2 * k], rows[3 + k][2 * k + 1] = 2 * dot(d, self.across[k]), 2 * dot(d, self.normal)
            rows[3 + k][2 * l], rows[3 + k][2 * l + 1] = -2 * dot(d, self.across[l]), -2 * dot(d, self.normal)
        return acb_mat(rows)

    def by_angles(self, x):
        """Derivatives of the three sides by log(h + i z) of each corner: (h, z) moves along (i z, -i h)."""
        j = self.jacobian(x)
        i = acb(0, 1)
        return acb_mat([[i * (j[3 + n, 2 * k] * x[2 * k + 1] - j[3 + n, 2 * k + 1] * x[2 * k]) for k in range(3)] for n in range(3)])

    def bend(self, n, u, reach):
        """Half a bound of the second derivatives of side n by these, within `reach` of u = h + i z.

        The corner is m + u f + v g with isotropic f = (a - i n) / 2, g = (a + i n) / 2 and v = rho / u. Both u and v
        grow by exp(reach) at most.
        """
        k, l = n, (n + 1) % 3
        grow = reach.exp()
        vectors = []
        for m in (k, l):
            f = [(a - acb(0, 1) * b) / 2 for a, b in zip(self.across[m], self.normal)]
            g = [(a + acb(0, 1) * b) / 2 for a, b in zip(self.across[m], self.normal)]
            vectors.append([(f, upper(u[m]) * grow), (g, upper(self.radii[m] / u[m]) * grow)])
        way = minus(self.middles[k], self.middles[l])
        straight = sum((2 * upper(dot(way, f)) * size for pair in vectors for f, size in pair), arb(0))
        mixed = sum((2 * upper(dot(f, g)) * x * y for f, x in vectors[0] for g, y in vectors[1]), arb(0))
        return (straight + 4 * mixed) / 2


def dot(u, v):
    return sum((a * b for a, b in zip(u, v)), acb(0))


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def minus(u, v):
    return [a - b for a, b in zip(u, v)]


def check_octahedral(legs, lengths, solution, record):
    system = Corners(legs, lengths, record["order"])
    i = acb(0, 1)
    u = [complex_of(record["centre"], k) for k in range(3)]
    need(not any(x.contains(0) for x in u), "a centre of zero")
    sign = -1 if record["mirrored"] else 1
    centre = []
    for x, rho in zip(u, system.radii):
        v = rho / x
        centre += [(x + v) / 2, sign * (x - v) / (2 * i)]
    radius, alone = exact(record["radius"]), exact(record["uniqueness_radius"])
    need(bool(radius >= 0) and bool(alone > radius) and bool(alone <= 1), "radii")
    z = newton(system.values, system.jacobian, centre)
    box = proved_box(system.values, system.jacobian, z, largest(z) * arb(2) ** -300)
    ratios = [(box[2 * k] + sign * i * box[2 * k + 1]) / u[k] for k in range(3)]
    need(all(bool(abs(r - 1) < arb(1) / 2) for r in ratios), "the root is not near the centre")
    away = largest([r.log() for r in ratios])
    need(bool(away <= radius), f"the pose is {away.str(5)} from the centre, not {radius.str(5)}")
    y = middle_inverse(system.by_angles(centre))
    bends = [system.bend(n, u, alone) for n in range(3)]
    bound = largest([sum((upper(y[k, n]) * bends[n] for n in range(3)), arb(0)) for k in range(3)]) * (alone + away)
    need(below(bound, arb(1)), f"not alone within {alone.str(5)}: {bound.str(8)}")
    need_reality(is_real(system.values, system.jacobian, z), record, solution)
    check_pose(*place(system, box), solution, record)
    return None


def place(system, box):
    """R and p of the pose with these corners, and the unit."""
    p4, p5, p6 = [[acb(arb(x)) for x in p] for p in system.points[3:]]
    q4, q5, q6 = [system.corner(k, box[2 * k], box[2 * k + 1]) for k in range(3)]

    def frame(o, u, v):
        u, v = minus(u, o), minus(v, o)
        w = cross(u, v)
        return acb_mat([[u[k], v[k], w[k]] for k in range(3)])

    r = frame(q4, q5, q6) * frame(p4, p5, p6).inv()
    rotation = [[r[i, j] for j in range(3)] for i in range(3)]
    position = [q4[i] - sum((r[i, j] * p4[j] for j in range(3)), acb(0)) for i in range(3)]
    points = system.points
    sides = [math.sqrt(square(x, y)) for x, y in (points[:2], points[:3:2], points[3:5], points[3::2])]
    return rotation, position, power_of_two(max(sides))


def power_of_two(x):
    """The largest one not above x, as a ball of radius zero."""
    return exact(2.0 ** (math.frexp(float(x))[1] - 1))


# --- both kinds --------------------------------------------------------------------------------------------------------------------------------------


def need_reality(real, record, solution):
    stated = record["reality"]
    need(stated in ("undecided", "real" if real else "non_real"), f"the root is {'real' if real else 'not real'}, said to be {stated}")
    field = {"undecided": None, "real": True, "non_real": False}[stated]
    need(solution["real"] is field, f"`real` is {solution['real']} beside a proof of {stated}")


def check_pose(rotation, position, unit, solution, record):
    """The enclosure holds the root, and the pose given is the root to half the digits of a double."""
    e = record["enclosure"]
    for i in range(3):
        for j in range(3):
            centre = acb(exact(e["R"]["re"][i][j]), exact(e["R"]["im"][i][j]))
            need(bool(abs(rotation[i][j] - centre) <= exact(e["R"]["radius"][i][j])), f"R[{i}][{j}] is not in its disc")
        centre = acb(exact(e["p"]["re"][i]), exact(e["p"]["im"][i]))
        need(bool(abs(position[i] - centre) <= exact(e["p"]["radius"][i])), f"p[{i}] is not in its disc")
    given = [acb(exact(solution["R"]["re"][i][j]), exact(solution["R"]["im"][i][j])) for i in range(3) for j in range(3)]
    flat = [z for row in rotation for z in row]
    limit = FAR_OUT if is_middle(solution, e) and record["precision"] == "double_double" else NEAR
    gap, scale = largest([x - y for x, y in zip(flat, given)]), largest([arb(1)] + given)
    need(bool(gap <= limit * scale), f"R of the pose is {(gap / scale).str(5)} off")
    given = [acb(exact(solution["p"]["re"][i]), exact(solution["p"]["im"][i])) for i in range(3)]
    gap, scale = largest([x - y for x, y in zip(position, given)]), largest([unit] + given)
    need(bool(gap <= limit * scale), f"p of the pose is {(gap / scale).str(5)} off")


def is_middle(solution, enclosure):
    """Whether the pose is the middle of its enclosure, rounded."""

    def flat(z):
        return [complex(a, b) for a, b in zip(*([x for row in z[k] for x in (row if isinstance(row, list) else [row])] for k in ("re", "im")))]

    pairs = [(flat(solution[k]), flat(enclosure[k])) for k in ("R", "p")]
    return all(max(abs(a - b) for a, b in zip(x, y)) <= 2.0**-40 * max(abs(b) for b in y) for x, y in pairs)


def check(legs, lengths, solution):
    """"" for a record that holds, else what is wrong with it; and the box of the root."""
    record = solution["certificate"]
    try:
        if record["kind"] == "study":
            return "", check_study(legs, lengths, solution, record)
        if record["kind"] == "cluster":
            return "", check_cluster(legs, lengths, solution, record)
        if record["kind"] == "octahedral":
            return "", check_octahedral(legs, lengths, solution, record)
        return f"unknown kind {record['kind']}", None
    except Refuted as why:
        return str(why), None


def repeated(roots):
    """Two certified roots of one answer that are proved to be the same: boxes of 180 digits that meet."""

    def on_first(patch, unit, x):
        one = largest(x[:4])
        k = next(i for i in range(4) if bool(upper(x[i]) * 2 > one))
        return [z / x[k] for z in x[:4]] + [z / x[k] * unit for z in x[4:]], k

    boxes = [on_first(*r) for r in roots]
    out = []
    for i, (x, k) in enumerate(boxes):
        for j, (y, l) in enumerate(boxes[:i]):
            if y[k].contains(0):
                continue
            y = [z / y[k] for z in y]
            if all(u.overlaps(v) for u, v in zip(x, y)):
                out.append((i, j))
    return out


FAULTS = {
    "centre shifted": lambda s, l: s["certificate"]["centre"]["re"].__setitem__(
        shifted(s), s["certificate"]["centre"]["re"][shifted(s)] * (1 + 1e-3) + 1e-3
    ),
    "radius too small": lambda s, l: s["certificate"].__setitem__("radius", s["certificate"]["radius"] * 2.0**-40),
    "uniqueness radius too large": lambda s, l: wider(s),
    "reality turned round": lambda s, l: turn_reality(s),
    "a length off by 1e-6": lambda s, l: l.__setitem__(2, l[2] * (1 + 1e-6)),
    "an enclosure beside the root": lambda s, l: s["certificate"]["enclosure"]["p"]["re"].__setitem__(
        1, s["certificate"]["enclosure"]["p"]["re"][1] * 1.001 + 1e-3
    ),
    "a pose with wrong digits": lambda s, l: s["R"]["re"][0].__setitem__(0, s["R"]["re"][0][0] + 1e-6 * rotation_size(s)),
}


def shifted(s):
    record = s["certificate"]
    return (record["patch"] + 1) % 4 if record["kind"] in ("study", "cluster") else 0


def wider(s):
    """More is said to be free of other roots than is; of a cluster, that there is one root more."""
    record = s["certificate"]
    if record["kind"] == "cluster":
        s["multiplicity"] += 1
        record["multiplicity"] += 1
    else:
        record["uniqueness_radius"] *= 1e6


def rotation_size(s):
    return max(1.0, *(abs(x) for part in ("re", "im") for row in s["R"][part] for x in row))


def turn_reality(s):
    """Both statements turned round; where reality is left open, a pose that is called real without proof."""
    turned = {"real": "non_real", "non_real": "real", "undecided": "undecided"}[s["certificate"]["reality"]]
    s["certificate"]["reality"] = turned
    s["real"] = turned != "non_real"


def run(program, options, tally):
    ctx.prec = BITS
    expected, k = options.certificates, 0
    folder = pathlib.Path(tempfile.mkdtemp())
    while tally.checked.get("certificates", 0) < expected:
        name, design, rows = designs.draw(stream(options.seed, "certificates", k), k)
        k += 1
        path = folder / "design.json"
        path.write_text(json.dumps(design))
        table = folder / "lengths.csv"
        table.write_text("l1,l2,l3,l4,l5,l6\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows))
        document, _ = answer(program, "fk", path, "--lengths", table)
        joints = lambda pair: (design["base"][pair[0]], design["platform"][pair[1]])
        legs = [joints(pair) for pair in design["legs"]]
        for row in document["rows"]:
            tally.count("answers")
            if "error" in row:
                tally.count("answers without poses")
                continue
            roots = []
            for i, solution in enumerate(row["solutions"]):
                where = f"{name} (number {k - 1}), line {row['line']}, solution {i}"
                if solution["certified"] != (solution["certificate"] is not None):
                    tally.fault(f"{where}: `certified` without certificate")
                if solution["certificate"] is None:
                    tally.count("solutions without certificate")
                    continue
                if tally.checked.get("certificates", 0) >= expected:
                    return
                complaint, root = check(legs, row["lengths"], solution)
                tally.count("certificates")
                tally.count(f"certificates of {name}")
                if complaint:
                    tally.fault(f"{where}: {complaint}")
                elif root is not None:
                    roots.append(root)
                if i == 0 and tally.found + len(tally.missed) < 20 * len(FAULTS):
                    for fault, plant in FAULTS.items():
                        wrong, lengths = json.loads(json.dumps(solution)), list(row["lengths"])
                        plant(wrong, lengths)
                        tally.planted(f"{where}: {fault}", check(legs, lengths, wrong)[0])
            for i, j in repeated(roots):
                tally.fault(f"{name} (number {k - 1}), line {row['line']}: solutions {j} and {i} are one root")

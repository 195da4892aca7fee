"""Numbers of finite poses and dimensions of sets of poses, recounted modulo another prime.

A pose is M = R, y = p, x = -R^T p, r = |p|^2; legs are linear there. The matrix has all multiples up to degree 3, or 4,
of the quadrics of SE(3) in the unknowns that the legs leave. FLINT brings it to reduced echelon form, with leading
terms of high degree first. Rows of lower degree are multiplied by the unknowns, until nothing changes. The monomials
that lead no row are counted. (The program works in quotient spaces instead and never writes down this matrix.)
"""

import itertools
import json
import pathlib
import tempfile

from common import answer, rational, stream
from flint import nmod_mat

P = (1 << 61) - 1
DEGREE = 4


def residue(x):
    x = rational(x)
    return int(x.p) * pow(int(x.q), P - 2, P) % P


def quadrics():
    """Dictionaries {exponents as sorted tuples of coordinates: coefficient}."""
    m = lambda i, j: 3 * i + j
    y, x = (9, 10, 11), (12, 13, 14)
    out = []

    def add(*terms):
        q = {}
        for c, *f in terms:
            q[tuple(sorted(f))] = q.get(tuple(sorted(f)), 0) + c
        out.append(q)

    for i, j in itertools.product(range(3), repeat=2):
        if i <= j:
            one = [(-1,)] if i == j else []
            add(*[(1, m(i, k), m(j, k)) for k in range(3)], *one)
            add(*[(1, m(k, i), m(k, j)) for k in range(3)], *one)
        (a, b), (c, d) = [((k + 1) % 3, (k + 2) % 3) for k in (i, j)]
        add((1, m(a, c), m(b, d)), (-1, m(a, d), m(b, c)), (-1, m(i, j)))
        # [y]_x M + M [x]_x
        cross = lambda v: [[None, (-1, v[2]), (1, v[1])], [(1, v[2]), None, (-1, v[0])], [(-1, v[1]), (1, v[0]), None]]
        s, t = cross(y), cross(x)
        add(*[(s[i][k][0], s[i][k][1], m(k, j)) for k in range(3) if k != i], *[(t[k][j][0], m(i, k), t[k][j][1]) for k in range(3) if k != j])
    for i in range(3):
        add(*[(1, m(k, i), y[k]) for k in range(3)], (1, x[i]))
        add(*[(1, m(i, k), x[k]) for k in range(3)], (1, y[i]))
    add(*[(1, k, k) for k in y], (-1, 15))
    add(*[(1, k, k) for k in x], (-1, 15))
    return out


def leg(a, b, length):
    a, b, length = [residue(t) for t in a], [residue(t) for t in b], residue(length)
    row = [-2 * u * v for u in a for v in b] + [-2 * u for u in a] + [-2 * v for v in b] + [1]
    return [t % P for t in row + [sum(u * u for u in a + b) - length * length]]


def reduced(rows, width):
    """Rows of the reduced echelon form and their leading columns."""
    if not rows:
        return [], []
    matrix, rank = nmod_mat(len(rows), width, [t for row in rows for t in row], P).rref()
    table = [[int(t) for t in row] for row in matrix.table()[:rank]]
    return table, [next(k for k, t in enumerate(row) if t) for row in table]


def left_over(linear):
    """Number of monomials left over by degree; [] when the linear equations contradict each other. Multiples up to degree 3 do where none of that degree is left."""
    over = left_over_by(3, linear)
    return left_over_by(4, linear) if over and over[3] else over + [0] * bool(over)


def left_over_by(highest, linear):
    rows, lead = reduced([list(reversed(row[:16])) + [row[16]] for row in linear], 17)
    if 16 in lead:
        return []
    free = [c for c in range(16) if 15 - c not in lead]
    n = len(free)
    # every coordinate in those left: coefficients, then the constant
    form = {c: [int(k == i) for i in range(n)] + [0] for k, c in enumerate(free)}
    for row, c in zip(rows, lead):
        form[15 - c] = [-row[15 - f] % P for f in free] + [-row[16] % P]
    monomials = [t for d in range(highest, -1, -1) for t in itertools.combinations_with_replacement(range(n), d)]
    place = {t: k for k, t in enumerate(monomials)}
    polynomials = []
    for q in quadrics():
        p = {}
        for factors, c in q.items():
            product = {(): c}
            for f in factors:
                step = {}
                for t, u in product.items():
                    for k, v in enumerate(form[f]):
                        if v:
                            key = tuple(sorted(t + (k,))) if k < n else t
                            step[key] = (step.get(key, 0) + u * v) % P
                product = step
            for t, u in product.items():
                p[t] = (p.get(t, 0) + u) % P
        polynomials.append(p)
    dense = lambda p: [p.get(t, 0) for t in monomials]
    basis, lead = reduced([dense(p) for p in polynomials], len(monomials))
    while True:
        more = []
        for row, c in zip(basis, lead):
            if len(monomials[c]) < highest:
                terms = [(monomials[k], t) for k, t in enumerate(row) if t]
                for k in range(n):
                    out = [0] * len(monomials)
                    for t, u in terms:
                        out[place[tuple(sorted(t + (k,)))]] = u
                    more.append(out)
        rank = len(lead)
        basis, lead = reduced(basis + more, len(monomials))
        if len(lead) == rank:
            break
    over = set(range(len(monomials))) - set(lead)
    return [sum(len(monomials[k]) == d for k in over) for d in range(highest + 1)]


def complaint(legs, lengths, said, rng):
    """The fault of the record `pose_count` of a design, or None."""
    linear = [leg(a, b, l) for (a, b), l in zip(legs, lengths)]
    section = lambda: [rng.randrange(P) for _ in range(17)]
    if said["finite"] is not None:
        over = left_over(linear)
        # one monomial of degree 4 is left over by general platforms, and nothing by all others
        if sum(over) != said["finite"] or (over and over[DEGREE] > (said["finite"] == 40)):
            return f"{said['finite']} poses, but {over} monomials are left over"
        return None
    if said["dimension"] is None:
        return "no count"
    cut = left_over(linear + [section() for _ in range(said["dimension"])])
    if sum(cut) != said["degree"] or cut[DEGREE]:
        return f"degree {said['degree']}, but a section leaves {cut}"
    if (before := left_over(linear + [section() for _ in range(said["dimension"] - 1)]))[DEGREE] <= 1:
        return f"dimension {said['dimension']}, but one section less leaves {before}"
    return None


def draw(rng, k):
    """Name, legs and lengths; multiples of 1/64, so that relations between joints hold exactly."""
    point = lambda z=1: [rng.randint(-128, 128) / 64, rng.randint(-128, 128) / 64, z * rng.randint(-128, 128) / 64]
    base, feet = [[point() for _ in range(6)] for _ in range(2)]
    lengths = [rng.randint(150, 400) / 64 for _ in range(6)]
    name = ("similar", "octahedral", "general", "congruent", "collinear", "griffis-duffy")[k % 6]
    ring = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]
    if name == "similar":
        base = [point(0) for _ in range(6)]
        feet = [[2 * t for t in p] for p in base]
    elif name in ("octahedral", "griffis-duffy"):
        base, feet = [base[i] for i, _ in ring], [feet[j] for _, j in ring]
        if name == "griffis-duffy":
            # the same parameters on both bodies: each leg moves by one of them alone, since one of its ends stays
            ts = [rng.randint(1, 7) / 8 for _ in range(6)]
            base, feet = [[[u + (v - u) * ts[i] for u, v in zip(body[i], body[(i + 1) % 6])] for i in range(6)] for body in (base, feet)]
    elif name == "congruent":
        feet, lengths = base, lengths[:1] * 6
    elif name == "collinear":
        feet = [[t * u for u in (0.5, 1.0, -0.25)] for t in (-3, -1, 0, 2, 5, 7)]
    return name, list(zip(base, feet)), lengths


def document(legs):
    return {
        "name": "d",
        "units": "mm",
        "base": {f"B{i}": a for i, (a, _) in enumerate(legs)},
        "platform": {f"P{i}": b for i, (_, b) in enumerate(legs)},
        "legs": [[f"B{i}", f"P{i}"] for i in range(6)],
    }


def run(program, options, tally):
    with tempfile.TemporaryDirectory() as folder:
        for k in range(max(6, options.bounds)):
            rng = stream(options.seed, "counts", k)
            name, legs, lengths = draw(rng, k)
            path = pathlib.Path(folder) / f"{k}.json"
            path.write_text(json.dumps(document(legs)))
            doc, _ = answer(program, "fk", path, "--lengths", ",".join(map(repr, lengths)))
            said = doc["pose_count"]
            if said is None:
                tally.fault(f"counts {k} ({name}): no count")
                continue
            wrong = complaint(legs, lengths, said, rng)
            if wrong:
                tally.fault(f"counts {k} ({name}): {wrong}")
            tally.count("dimensions" if said["finite"] is None else "numbers of poses")
            if k < 6:
                key = "degree" if said["finite"] is None else "finite"
                tally.planted(f"counts {k} ({name}): one more", complaint(legs, lengths, said | {key: said[key] + 1}, rng))
                nudged = [lengths[0] * 1.25, *lengths[1:]]
                if said["finite"] is None:
                    tally.planted(f"counts {k} ({name}): other lengths", complaint(legs, nudged, said, rng))

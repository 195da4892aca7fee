#!/usr/bin/env python3
"""Checks proof files of equipod (option `--proof FILE`) with the standard library of Python alone.

    python check.py FILE          or          equipod-check FILE

Exit 0: every claim holds. Exit 1: a claim does not hold, and is named. Exit 2: FILE is no proof file. Exit 3: FILE has no claims.

This file imports nothing of equipod, so it can be copied and read alone. The numbers of a design are exact: sums of fractions times square roots of integers. Identities,
ranks and determinants are decided in these numbers. Roots are decided in intervals whose ends are integers over 2^320, rounded outwards. No floating-point number is used.
The theorems are those of the folder `docs/theory` of equipod; each claim names its page.
"""

from __future__ import annotations

import functools
import itertools
import json
import math
import os
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Any

VERSION = 1
# Bits behind the binary point of interval ends.
BITS = 320
ONE = 1 << BITS
# Newton's method ends with a step below this, 2^-160.
TINY = 1 << (BITS - 160)
# Radicands above this are refused: their square factors would take too long to find.
LARGEST_RADICAND = 10**12


class Refuted(Exception):
    """The reason why a claim does not hold."""


class NoProof(Exception):
    """The reason why a file is no proof file."""


def need(truth: bool, why: str) -> None:
    if not truth:
        raise Refuted(why)


# --- exact numbers ---------------------------------------------------------------------------------------------------------------------------------


def squarefree(n: int) -> tuple[int, int]:
    """The numbers s and r with n = s^2 r and r squarefree."""
    need(0 < n <= LARGEST_RADICAND, f"sqrt({n}) is not a square root that this program handles")
    s, p = 1, 2
    while p * p <= n:
        while n % (p * p) == 0:
            n, s = n // (p * p), s * p
        p += 1
    return s, n


def primes_of(n: int) -> list[int]:
    found, p = [], 2
    while p * p <= n:
        if n % p == 0:
            found.append(p)
            while n % p == 0:
                n //= p
        p += 1
    return found + [n] if n > 1 else found


class Number:
    """A sum of fractions times square roots of squarefree integers, by radicand. It is zero only without terms (Besicovitch 1940)."""

    __slots__ = ("terms",)

    def __init__(self, terms: dict[int, Fraction]) -> None:
        self.terms = {r: c for r, c in terms.items() if c}

    @staticmethod
    def of(x: int | Fraction) -> Number:
        return Number({1: Fraction(x)})

    def __add__(self, other: Number) -> Number:
        terms = dict(self.terms)
        for r, c in other.terms.items():
            terms[r] = terms.get(r, Fraction(0)) + c
        return Number(terms)

    def __neg__(self) -> Number:
        return Number({r: -c for r, c in self.terms.items()})

    def __sub__(self, other: Number) -> Number:
        return self + -other

    def __mul__(self, other: Number) -> Number:
        terms: dict[int, Fraction] = {}
        for r, c in self.terms.items():
            for s, d in other.terms.items():
                g = math.gcd(r, s)
                root = (r // g) * (s // g)
                terms[root] = terms.get(root, Fraction(0)) + c * d * g
        return Number(terms)

    def inverse(self) -> Number:
        """1 / x: x is multiplied by conjugates until it is a fraction."""
        factor, rest = Number.of(1), self
        for p in sorted({p for r in self.terms for p in primes_of(r)}):
            conjugate = Number({r: -c if r % p == 0 else c for r, c in rest.terms.items()})
            factor, rest = factor * conjugate, rest * conjugate
        value = rest.terms.get(1, Fraction(0))
        if not value or len(rest.terms) != 1:
            raise ZeroDivisionError
        return factor * Number.of(1 / value)

    def is_zero(self) -> bool:
        return not self.terms

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Number) and self.terms == other.terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def sign(self) -> int:
        """-1, 0 or 1."""
        if self.is_zero():
            return 0
        bits = 64
        while True:
            low, high = self.between(bits)
            if low > 0 or high < 0:
                return 1 if low > 0 else -1
            bits *= 2

    def between(self, bits: int) -> tuple[int, int]:
        """Integers below and above 2^bits x."""
        low = high = 0
        for r, c in self.terms.items():
            guard = bits + 16 + max(0, c.numerator.bit_length() - c.denominator.bit_length())
            root = math.isqrt(r << (2 * guard))
            ends = (root, root if root * root == r << (2 * guard) else root + 1)
            first, last = ends if c > 0 else ends[::-1]
            scale = c.denominator << (guard - bits)
            low += first * c.numerator // scale
            high += -(-last * c.numerator // scale)
        return low, high

    def __str__(self) -> str:
        parts = []
        for r, c in sorted(self.terms.items()):
            root = "" if r == 1 else f"sqrt({r})"
            number = "" if root and abs(c.numerator) == 1 else str(abs(c.numerator))
            over = "" if c.denominator == 1 else f"/{c.denominator}"
            parts.append(("-" if c < 0 else "+", "*".join(x for x in (number, root) if x) + over))
        if not parts:
            return "0"
        text = ("-" if parts[0][0] == "-" else "") + parts[0][1]
        return text + "".join(f" {sign} {part}" for sign, part in parts[1:])


TERM = re.compile(r"(?:(\d+)(?:\*sqrt\((\d+)\))?|sqrt\((\d+)\))(?:/(\d+))?", re.ASCII)


def number(text: Any) -> Number:
    """The number of a text such as `-3/4`, `6*sqrt(3)` or `1/2 + sqrt(3)/6`."""
    need(isinstance(text, str), f"{text!r} is not an exact number as text")
    rest, sign, out, first = text, 1, Number({}), True
    while first or rest:
        if first and rest.startswith("-"):
            rest, sign = rest[1:], -1
        elif not first:
            need(rest[:3] in (" + ", " - "), f"`{text}` is not an exact number")
            sign, rest = (1 if rest[1] == "+" else -1), rest[3:]
        found = TERM.match(rest)
        need(found is not None, f"`{text}` is not an exact number")
        assert found is not None
        whole, radicand, alone, below = found.groups()
        need(below is None or int(below) > 0, f"`{text}` divides by zero")
        square, root = squarefree(int(radicand or alone)) if radicand or alone else (1, 1)
        out = out + Number({root: Fraction(sign * int(whole or 1) * square, int(below or 1))})
        rest, first = rest[found.end() :], False
    return out


def fraction(text: Any) -> Fraction:
    x = number(text)
    need(set(x.terms) <= {1}, f"`{text}` is not a fraction")
    return x.terms.get(1, Fraction(0))


def a_list(value: Any, count: int, of: Callable[[Any], Any]) -> list[Any]:
    need(isinstance(value, list) and len(value) == count, f"a list of {count} entries is missing")
    return [of(x) for x in value]


def field(record: Any, name: str) -> Any:
    need(isinstance(record, dict) and name in record, f"`{name}` is missing")
    return record[name]


def whole(record: Any, name: str) -> int:
    value = field(record, name)
    need(isinstance(value, int) and not isinstance(value, bool), f"`{name}` is not a whole number")
    return int(value)


# --- linear algebra in exact numbers ---------------------------------------------------------------------------------------------------------------

Row = list[Number]


def dot(u: Sequence[Number], v: Sequence[Number]) -> Number:
    out = Number({})
    for x, y in zip(u, v):
        out = out + x * y
    return out


def eliminate(rows: Sequence[Row]) -> tuple[int, Number]:
    """Rank of the rows, and the product of the pivots with the sign of their exchanges."""
    work, rank, product = [list(row) for row in rows], 0, Number.of(1)
    for column in range(len(rows[0])):
        pivot = next((i for i in range(rank, len(work)) if not work[i][column].is_zero()), None)
        if pivot is None:
            continue
        if pivot != rank:
            work[rank], work[pivot], product = work[pivot], work[rank], -product
        product = product * work[rank][column]
        inverse = work[rank][column].inverse()
        for i in range(rank + 1, len(work)):
            if not work[i][column].is_zero():
                factor = work[i][column] * inverse
                work[i] = [x - factor * y for x, y in zip(work[i], work[rank])]
        rank += 1
        if rank == len(work):
            break
    return rank, product


def determinant(rows: Sequence[Row]) -> Number:
    rank, product = eliminate(rows)
    return product if rank == len(rows) else Number({})


def kernel(rows: Sequence[Row]) -> list[Row]:
    """A basis of the vectors whose products with all rows are zero."""
    work, count = [list(row) for row in rows], len(rows[0])
    leading: list[int] = []
    for column in range(count):
        rank = len(leading)
        pivot = next((i for i in range(rank, len(work)) if not work[i][column].is_zero()), None)
        if pivot is None:
            continue
        work[rank], work[pivot] = work[pivot], work[rank]
        inverse = work[rank][column].inverse()
        work[rank] = [x * inverse for x in work[rank]]
        for i, row in enumerate(work):
            if i != rank and not row[column].is_zero():
                work[i] = [x - row[column] * y for x, y in zip(row, work[rank])]
        leading.append(column)
    basis = []
    for free in (k for k in range(count) if k not in leading):
        vector = [Number.of(int(k == free)) for k in range(count)]
        for row, column in zip(work, leading):
            vector[column] = -row[free]
        basis.append(vector)
    return basis


# --- designs ---------------------------------------------------------------------------------------------------------------------------------------


class Design:
    """Six legs with exact ends."""

    def __init__(self, record: Any) -> None:
        self.name = str(field(record, "name"))
        self.units = str(field(record, "units"))
        legs = a_list(field(record, "legs"), 6, lambda leg: leg)
        self.base: list[Row] = [a_list(field(leg, "base"), 3, number) for leg in legs]
        self.platform: list[Row] = [a_list(field(leg, "platform"), 3, number) for leg in legs]
        one = [Number.of(1)]
        self.vectors: list[Row] = [[x * y for x in one + a for y in one + b] for a, b in zip(self.base, self.platform)]
        self.squares = [dot(a, a) + dot(b, b) for a, b in zip(self.base, self.platform)]

    def lines(self, pose: Pose) -> list[Row]:
        """Rows (n, a x n) of the legs with n = R b + p - a."""
        rows = []
        for a, n in zip(self.base, self.legs_at(pose)):
            rows.append(n + [a[1] * n[2] - a[2] * n[1], a[2] * n[0] - a[0] * n[2], a[0] * n[1] - a[1] * n[0]])
        return rows

    def legs_at(self, pose: Pose) -> list[Row]:
        """The vectors R b + p - a."""
        return [[dot(r, b) + p - x for r, p, x in zip(pose.rotation, pose.position, a)] for a, b in zip(self.base, self.platform)]


class Pose:
    """The rotation of a quaternion of any norm, scalar part first, and a position: exact numbers."""

    def __init__(self, quaternion: list[Number], position: list[Number]) -> None:
        w, x, y, z = quaternion
        norm = dot(quaternion, quaternion)
        need(not norm.is_zero(), "the quaternion is zero")
        scale = norm.inverse()
        two = Number.of(2)
        rows = [
            [w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y)],
            [two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x)],
            [two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
        self.rotation = [[scale * v for v in row] for row in rows]
        self.position = position

    @staticmethod
    def of(record: Any) -> Pose:
        return Pose(a_list(field(record, "quaternion"), 4, number), a_list(field(record, "position"), 3, number))

    def __str__(self) -> str:
        return f"p = ({', '.join(shown(x) for x in self.position)})"


def shown(x: Number | Fraction) -> str:
    """A number for people: exact if short, else six digits."""
    text = str(x)
    if len(text) <= 24:
        return text
    x = x if isinstance(x, Number) else Number.of(x)
    low, high = x.between(BITS)
    return decimal(Fraction(low + high, 2 * ONE))


def counted(n: int, noun: str) -> str:
    return f"{n} {noun}" if n == 1 else f"{n} {noun}s"


def decimal(x: Fraction) -> str:
    """Six significant digits, in integer arithmetic."""
    if not x:
        return "0"
    sign, x = ("-" if x < 0 else ""), abs(x)
    exponent = 0
    while x >= 10 ** (exponent + 1):
        exponent += 1
    while x * 10**-exponent < 1 if exponent < 0 else x < 10**exponent:
        exponent -= 1
    digits = round(x * Fraction(10) ** (5 - exponent))
    if -3 <= exponent <= 5:
        text = str(digits).rjust(6 - exponent, "0") if exponent < 0 else str(digits)
        places = 5 - exponent
        body = (text[:-places] or "0") + "." + text[-places:] if places else text
        return sign + body
    return f"{sign}{str(digits)[0]}.{str(digits)[1:]}e{exponent}"


# --- intervals -------------------------------------------------------------------------------------------------------------------------------------


class Real:
    """The real numbers between low / 2^BITS and high / 2^BITS."""

    __slots__ = ("high", "low")

    def __init__(self, low: int, high: int) -> None:
        self.low, self.high = low, high

    @staticmethod
    def of(x: Number | Fraction | int) -> Real:
        x = x if isinstance(x, Number) else Number.of(x)
        return Real(*x.between(BITS))

    def __add__(self, other: Real) -> Real:
        return Real(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Real) -> Real:
        return Real(self.low - other.high, self.high - other.low)

    def __neg__(self) -> Real:
        return Real(-self.high, -self.low)

    def __mul__(self, other: Real) -> Real:
        # the signs of the ends tell which two of the four products are the ends
        a, b, c, d = self.low, self.high, other.low, other.high
        if a >= 0:
            low, high = (a * c, b * d) if c >= 0 else (b * c, a * d) if d <= 0 else (b * c, b * d)
        elif b <= 0:
            low, high = (a * d, b * c) if c >= 0 else (b * d, a * c) if d <= 0 else (a * d, a * c)
        elif c >= 0:
            low, high = a * d, b * d
        elif d <= 0:
            low, high = b * c, a * c
        else:
            low, high = min(a * d, b * c), max(a * c, b * d)
        return Real(low >> BITS, -(-high >> BITS))

    def inverse(self) -> Real:
        need(self.low > 0 or self.high < 0, "a number that may be zero would be divided by")
        return Real((1 << 2 * BITS) // self.high, -(-(1 << 2 * BITS) // self.low))

    def sqrt(self) -> Real:
        need(self.low >= 0, "the square root of a number that may be negative is needed")
        return Real(math.isqrt(self.low << BITS), math.isqrt(self.high << BITS) + 1)

    def has_zero(self) -> bool:
        return self.low <= 0 <= self.high

    def size(self) -> int:
        """An upper bound of the absolute value."""
        return max(abs(self.low), abs(self.high))


ZERO = Real(0, 0)


class Complex:
    """The complex numbers of a rectangle."""

    __slots__ = ("im", "re")

    def __init__(self, re_part: Real, im_part: Real) -> None:
        self.re, self.im = re_part, im_part

    @staticmethod
    def point(z: tuple[int, int]) -> Complex:
        return Complex(Real(z[0], z[0]), Real(z[1], z[1]))

    def __add__(self, other: Complex) -> Complex:
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return Complex(self.re - other.re, self.im - other.im)

    def __mul__(self, other: Complex) -> Complex:
        return Complex(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def times(self, x: Real) -> Complex:
        return Complex(self.re * x, self.im * x)

    def inverse(self) -> Complex:
        scale = (self.re * self.re + self.im * self.im).inverse()
        return Complex(self.re * scale, -(self.im * scale))

    def size(self) -> int:
        """An upper bound of the modulus."""
        return math.isqrt(self.re.size() ** 2 + self.im.size() ** 2) + 1

    def has_zero(self) -> bool:
        return self.re.has_zero() and self.im.has_zero()

    def middle(self) -> tuple[int, int]:
        return (self.re.low + self.re.high) // 2, (self.im.low + self.im.high) // 2

    def widened(self, radius: int) -> Complex:
        return Complex(Real(self.re.low - radius, self.re.high + radius), Real(self.im.low - radius, self.im.high + radius))


NOTHING = Complex(ZERO, ZERO)


def total(items: Iterable[Complex]) -> Complex:
    out = NOTHING
    for x in items:
        out = out + x
    return out


Point = list[tuple[int, int]]


def approximate_inverse(matrix: list[Point]) -> list[Point]:
    """A matrix near the inverse: Gauss elimination in rounded complex numbers. It need not be near; the claims are proved with any matrix."""

    def times(x: tuple[int, int], y: tuple[int, int]) -> tuple[int, int]:
        return (x[0] * y[0] - x[1] * y[1]) >> BITS, (x[0] * y[1] + x[1] * y[0]) >> BITS

    n = len(matrix)
    work = [list(row) + [(ONE, 0) if i == j else (0, 0) for j in range(n)] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: work[i][k][0] ** 2 + work[i][k][1] ** 2)
        work[k], work[pivot] = work[pivot], work[k]
        x, y = work[k][k]
        norm = x * x + y * y
        need(norm > 0, "the Jacobian is singular")
        inverse = (x << 2 * BITS) // norm, (-y << 2 * BITS) // norm
        work[k] = [times(inverse, z) for z in work[k]]
        for i in range(n):
            factor = work[i][k]
            if i != k and factor != (0, 0):
                work[i] = [(z[0] - t[0], z[1] - t[1]) for z, t in ((z, times(factor, v)) for z, v in zip(work[i], work[k]))]
    return [row[n:] for row in work]


# --- roots -----------------------------------------------------------------------------------------------------------------------------------------

# Products of the quaternion units: unit i times unit j is sign times unit k, as (k, sign).
UNITS = [
    [(0, 1), (1, 1), (2, 1), (3, 1)],
    [(1, 1), (0, -1), (3, 1), (2, -1)],
    [(2, 1), (3, -1), (0, -1), (1, 1)],
    [(3, 1), (2, 1), (1, -1), (0, -1)],
]


class Study:
    """The equations |g + e b_i - a_i e|^2 = s_i e.e and e.g = 0 in the coordinates (e, g / unit), coordinate `patch` equal to 1: symmetric 8 x 8 matrices."""

    def __init__(self, design: Design, lengths: list[Fraction], patch: int, unit: Fraction) -> None:
        self.patch, self.unit = patch, unit
        self.free = [k for k in range(8) if k != patch]
        self.forms: list[list[list[Real]]] = []
        scale = Number.of(1 / unit)
        for a, b, length in zip(design.base, design.platform, lengths):
            v = [[Number({})] * 8 for _ in range(4)]
            for k in range(4):
                v[k][4 + k] = Number.of(1)
                for j in range(1, 4):
                    for (row, sign), x in ((UNITS[k][j], b[j - 1]), (UNITS[j][k], -a[j - 1])):
                        v[row][k] = v[row][k] + Number.of(sign) * scale * x
            square = Number.of((length / unit) ** 2)
            form = [[Number({})] * 8 for _ in range(8)]
            for i in range(8):
                for j in range(i, 8):
                    form[i][j] = form[j][i] = dot([row[i] for row in v], [row[j] for row in v])
            for k in range(4):
                form[k][k] = form[k][k] - square
            self.forms.append([[Real.of(x) for x in row] for row in form])
        one = Real.of(1)
        self.forms.append([[one if abs(i - j) == 4 else ZERO for j in range(8)] for i in range(8)])

    def whole(self, x: Sequence[Complex]) -> list[Complex]:
        return [*x[: self.patch], Complex.point((ONE, 0)), *x[self.patch :]]

    def at(self, x: Sequence[Complex]) -> tuple[list[Complex], list[list[Complex]]]:
        """Values and Jacobian."""
        z = self.whole(x)
        values, jacobian = [], []
        for form in self.forms:
            image = [total(z[j].times(m) for j, m in enumerate(row) if m.low or m.high) for row in form]
            values.append(total(u * v for u, v in zip(z, image)))
            jacobian.append([image[k] + image[k] for k in self.free])
        return values, jacobian


class Local:
    """The bounds eta, kappa and beta of `certificates.md` about a point, over 2^BITS."""

    def __init__(self, system: Study, x: Point) -> None:
        self.system, self.x = system, x
        values, self.jacobian = system.at([Complex.point(z) for z in x])
        self.y = [[Complex.point(z) for z in row] for row in approximate_inverse([[z.middle() for z in row] for row in self.jacobian])]
        self.step = [total(u * v for u, v in zip(row, values)) for row in self.y]
        self.eta = max(z.size() for z in self.step)
        self.kappa = self.beta = 0

    def bounded(self) -> Local:
        """With kappa and beta."""
        system, one = self.system, Complex.point((ONE, 0))
        for i, row in enumerate(self.y):
            entries = [total(u * self.jacobian[k][j] for k, u in enumerate(row)) for j in range(7)]
            self.kappa = max(self.kappa, sum((z - one if i == j else z).size() for j, z in enumerate(entries)))
            sizes = 0
            for i, p in enumerate(system.free):
                for q in system.free[i:]:
                    size = total(u.times(form[p][q]) for u, form in zip(row, system.forms)).size()
                    sizes += size if p == q else 2 * size
            self.beta = max(self.beta, sizes)
        return self

    def holds_one_root(self, r: int) -> bool:
        """Exactly one root lies within r, and it is regular."""
        inside = self.eta + up(self.kappa * r) + up(self.beta * up(r * r)) <= r
        return inside and self.kappa + 2 * up(self.beta * r) < ONE

    def is_alone(self, r: int, rho: int) -> bool:
        """A root within r is the only one within rho."""
        return self.kappa + up(self.beta * (r + rho)) < ONE


def up(x: int) -> int:
    """A product of two numbers over 2^BITS, rounded up."""
    return -(-x >> BITS)


def scaled(x: Fraction) -> int:
    """The integer nearest to 2^BITS x from below."""
    return (x.numerator << BITS) // x.denominator


class Root:
    """A proved root: its box, and its reality."""

    def __init__(self, box: list[Complex], unit: Fraction, real: bool | None, problem: tuple[int, int]) -> None:
        self.box, self.unit, self.real, self.problem = box, unit, real, problem

    def pose(self) -> tuple[list[list[Complex]], list[Complex]]:
        """Enclosures of R and p."""
        w, a, b, c, g0, g1, g2, g3 = self.box
        norm = w * w + a * a + b * b + c * c
        need(not norm.has_zero(), "e.e may vanish: the root may be at infinity")
        scale = norm.inverse()
        two = Real.of(2)
        rows = [
            [w * w + a * a - b * b - c * c, (a * b - w * c).times(two), (a * c + w * b).times(two)],
            [(a * b + w * c).times(two), w * w - a * a + b * b - c * c, (b * c - w * a).times(two)],
            [(a * c - w * b).times(two), (b * c + w * a).times(two), w * w - a * a - b * b + c * c],
        ]
        p = [g1 * w - g0 * a - g2 * c + g3 * b, g1 * c - g0 * b + g2 * w - g3 * a, g2 * a - g0 * c - g1 * b + g3 * w]
        unit = Real.of(self.unit)
        return [[z * scale for z in row] for row in rows], [(z * scale).times(unit) for z in p]

    def differs(self, other: Root) -> bool:
        """Whether the projective points differ: some minor of the two rows is not zero."""
        ratio = Real.of(other.unit / self.unit)
        mine, yours = self.box, [z if k < 4 else z.times(ratio) for k, z in enumerate(other.box)]
        pairs = itertools.combinations(range(8), 2)
        return any(not (mine[i] * yours[j] - mine[j] * yours[i]).has_zero() for i, j in pairs)


def refined(system: Study, centre: Point) -> Local:
    """The end of Newton's method from the centre, with its bounds."""
    x = list(centre)
    for _ in range(40):
        local = Local(system, x)
        if local.eta < TINY:
            return local.bounded()
        x = [(z[0] - step[0], z[1] - step[1]) for z, step in zip(x, (s.middle() for s in local.step))]
        need(all(abs(part) < ONE << 128 for z in x for part in z), "Newton's method leaves the centre")
    raise Refuted("Newton's method from the centre finds no root")


def complex_list(record: Any, count: int) -> list[tuple[Fraction, Fraction]]:
    parts = [a_list(field(record, name), count, fraction) for name in ("re", "im")]
    return list(zip(*parts))


def within(z: Complex, disc: tuple[Fraction, Fraction, Fraction]) -> bool:
    """Whether a rectangle lies in a disc."""
    re_part, im_part, radius = disc
    off = z - Complex(Real.of(re_part), Real.of(im_part))
    return off.size() <= scaled(radius)


# --- angles ----------------------------------------------------------------------------------------------------------------------------------------


def arctangent(x: int) -> Real:
    """arctan(1 / x) for a whole x."""
    low, high, k, power = 0, 0, 0, Fraction(1, x)
    while power > Fraction(1, ONE << 8):
        term = Real.of(power / (2 * k + 1))
        low, high = (low + term.low, high + term.high) if k % 2 == 0 else (low - term.high, high - term.low)
        k, power = k + 1, power / (x * x)
    return Real(low - 2, high + 2)


def pi() -> Real:
    """Machin's formula."""
    return Real.of(16) * arctangent(5) - Real.of(4) * arctangent(239)


def cosine_of_degrees(x: Fraction) -> Real:
    """The cosine of an angle from 0 to 180 degrees, by its series; the remainder is below the first term left out."""
    angle = Real.of(x / 180) * pi()
    square, term, out, k = angle * angle, Real.of(1), Real.of(1), 0
    while term.size() > 1 or k < 8:
        k += 2
        term = -(term * square * Real.of(Fraction(1, k * (k - 1))))
        out = out + term
    return Real(out.low - 4, out.high + 4)


# --- theorems about the number of poses ------------------------------------------------------------------------------------------------------------

# Topologies with a proved bound for generic joints (completeness.md, shared joints): base and platform joint of each leg.
SHARED = [
    (8, "012345", "000112"),
    (8, "001234", "012223"),
    (8, "001123", "010122"),
    (16, "012345", "000123"),
    (16, "012345", "001122"),
    (16, "001234", "012233"),
    (16, "001123", "010123"),
    (16, "001123", "012302"),
    (24, "001234", "012234"),
    (32, "012345", "001123"),
]


def shares(ends: Sequence[Row], code: Sequence[str]) -> bool:
    """Whether legs with the same digit share the joint."""
    first: dict[str, Row] = {}
    return all(first.setdefault(digit, end) == end for digit, end in zip(code, ends))


def bound_by_shared_joints(design: Design) -> int:
    """The least bound of a topology of which the design is a merger."""
    bodies = (design.base, design.platform)
    for poses, one, two in SHARED:
        for base, platform in (bodies, bodies[::-1]):
            for order in itertools.permutations(range(6)):
                if shares(base, [one[k] for k in order]) and shares(platform, [two[k] for k in order]):
                    return poses
    return 40


def collinear(points: Sequence[Row]) -> bool:
    return eliminate([[Number.of(1), *p] for p in points])[0] <= 2


def bound_by_lines(design: Design) -> int:
    """16 with five joints of a body on a line, 32 with four."""
    for count, poses in ((5, 16), (4, 32)):
        for body in (design.base, design.platform):
            if any(collinear([body[i] for i in some]) for some in itertools.combinations(range(6), count)):
                return poses
    return 40


# Polynomials in three unknowns by exponents.
Form = dict[tuple[int, int, int], Number]


def times(f: Form, g: Form) -> Form:
    out: Form = {}
    for (a, b, c), x in f.items():
        for (d, e, h), y in g.items():
            key = (a + d, b + e, c + h)
            out[key] = out.get(key, Number({})) + x * y
    return out


def combined(*parts: tuple[int | Number, Form, Form]) -> Form:
    """The sum of some multiples of products."""
    out: Form = {}
    for factor, f, g in parts:
        for key, x in times(f, g).items():
            out[key] = out.get(key, Number({})) + x * (factor if isinstance(factor, Number) else Number.of(factor))
    return out


def slope(f: Form, k: int) -> Form:
    out: Form = {}
    for key, x in f.items():
        if key[k]:
            out[(key[0] - (k == 0), key[1] - (k == 1), key[2] - (k == 2))] = x * Number.of(key[k])
    return out


def monomials(degree: int) -> list[tuple[int, int, int]]:
    return [(i, j, degree - i - j) for i in range(degree + 1) for j in range(degree + 1 - i)]


def left(conics: Sequence[Form], degree: int) -> int:
    """The dimension that the ideal of some conics leaves of the forms of a degree. Zero: the conics have no common zero."""
    zero = Number({})
    rows = [[f.get((m[0] - d[0], m[1] - d[1], m[2] - d[2]), zero) for m in monomials(degree)] for f in conics for d in monomials(degree - 2)]
    return len(rows[0]) - eliminate(rows)[0]


class Plane:
    """Joints of a body in a plane, not on a line: coordinates (1, s, t) of x = o + s e + t f, and the products e.e, e.f, f.f."""

    def __init__(self, points: list[Row], e: Row, f: Row) -> None:
        self.products = ee, ef, ff = dot(e, e), dot(e, f), dot(f, f)
        scale = (ee * ff - ef * ef).inverse()
        self.points = []
        for x in points:
            d = [u - v for u, v in zip(x, points[0])]
            de, df = dot(d, e), dot(d, f)
            self.points.append([Number.of(1), (ff * de - ef * df) * scale, (ee * df - ef * de) * scale])

    @staticmethod
    def of(points: list[Row]) -> Plane | None:
        if eliminate([[Number.of(1), *x] for x in points])[0] != 3:
            return None
        arms = [[u - v for u, v in zip(x, points[0])] for x in points]
        e, f = next(pair for pair in itertools.combinations(arms, 2) if eliminate(pair)[0] == 2)
        return Plane(points, e, f)

    def isotropic(self, u: Sequence[Form], v: Sequence[Form]) -> Form:
        """The symmetric product of two vectors (e.w, f.w) that vanishes for equal ones if the part of w in the plane is isotropic."""
        ee, ef, ff = self.products
        return combined((ff, u[0], v[0]), (-ef, u[0], v[1]), (-ef, u[1], v[0]), (ee, u[1], v[1]))


def planes(design: Design) -> tuple[Plane, Plane] | None:
    base, platform = Plane.of(design.base), Plane.of(design.platform)
    return (base, platform) if base and platform else None


def bound_by_affine_map(design: Design) -> int:
    """16 for planar bodies whose joints are affine images of each other."""
    bodies = planes(design)
    related = bodies is not None and eliminate([[*a, *b[1:]] for a, b in zip(bodies[0].points, bodies[1].points)])[0] == 3
    return 16 if related else 40


def bound_by_points_at_infinity(design: Design) -> int:
    """40 - 4 n for two planar bodies with n inversions (completeness.md, points at infinity).

    A common point at infinity of all legs is a matrix W with X^T W X' = 0 for the ends X, X' of each leg. Its lower two rows have rank one, and so have its right two columns:
    five conics in the plane of such matrices. If they leave n <= 3 dimensions of cubics and of quartics, they have n zeros with multiplicity (persistence: Gotzmann 1978). Each
    is simple if no zero lets all minors of the Jacobian matrix vanish too. It has four points at infinity if neither projection is isotropic.
    """
    bodies = planes(design)
    basis = kernel([[x * y for x in a for y in b] for a, b in zip(bodies[0].points, bodies[1].points)]) if bodies else []
    if not bodies or len(basis) != 3:
        return 40
    unknowns = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    w: list[list[Form]] = [[{unknown: vector[3 * i + j] for unknown, vector in zip(unknowns, basis)} for j in range(3)] for i in range(3)]
    conics = [combined((1, w[1][i], w[2][j]), (-1, w[1][j], w[2][i])) for i, j in itertools.combinations(range(3), 2)]
    conics += [combined((1, w[i][1], w[j][2]), (-1, w[j][1], w[i][2])) for i, j in ((0, 1), (0, 2))]
    n = left(conics, 3)
    if not 1 <= n <= 3 or left(conics, 4) != n:
        return 40
    gradients = [[slope(f, k) for k in range(3)] for f in conics]
    minors = [combined((1, g[k], h[m]), (-1, g[m], h[k])) for g, h in itertools.combinations(gradients, 2) for k, m in itertools.combinations(range(3), 2)]
    # the lower rows are multiples of the projection of one body, the right columns of the other
    lower, right = [[w[1][j], w[2][j]] for j in range(3)], [[w[j][1], w[j][2]] for j in range(3)]
    lengths = [[plane.isotropic(u, v) for u, v in itertools.combinations_with_replacement(vectors, 2)] for plane, vectors in zip(bodies, (lower, right))]
    isolated = all(left(conics + more, 4) == 0 for more in (minors, *lengths))
    return 40 - 4 * n if isolated else 40


BOUNDS: dict[str, tuple[Callable[[Design], int], str]] = {
    "six_legs": (lambda design: 40, "six legs have at most 40 isolated poses"),
    "shared_joints": (bound_by_shared_joints, "the joints that legs share allow no more"),
    "joints_on_a_line": (bound_by_lines, "joints of one body on a line allow no more"),
    "affine_hexagons": (bound_by_affine_map, "planar bodies that are affine images of each other allow no more"),
    "points_at_infinity": (bound_by_points_at_infinity, "the others of 40 are at infinity"),
}

# --- claims ----------------------------------------------------------------------------------------------------------------------------------------


class Proof:
    """The designs and lengths of a file, and the roots and bounds that its claims have proved so far."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.designs = [Design(x) for x in document.get("designs", [])]
        self.lengths = [a_list(x, 6, fraction) for x in document.get("lengths", [])]
        self.roots: dict[str, Root] = {}
        self.bounds: dict[str, tuple[int, int]] = {}
        self.maps: dict[str, tuple[int, int]] = {}
        self.systems: dict[tuple[int, int, int, Fraction], Study] = {}

    def design(self, claim: Any, name: str = "design") -> Design:
        k = whole(claim, name)
        need(0 <= k < len(self.designs), f"there is no design {k}")
        return self.designs[k]

    def problem(self, claim: Any) -> tuple[int, int]:
        self.design(claim)
        k = whole(claim, "lengths")
        need(0 <= k < len(self.lengths), f"there are no lengths {k}")
        return whole(claim, "design"), k

    def system(self, problem: tuple[int, int], patch: int, unit: Fraction) -> Study:
        key = (*problem, patch, unit)
        if key not in self.systems:
            self.systems[key] = Study(self.designs[problem[0]], self.lengths[problem[1]], patch, unit)
        return self.systems[key]


def leg_map(proof: Proof, claim: Any) -> str:
    """Leg vectors of TO are combinations of those of FROM, with a regular or singular matrix."""
    start, end = proof.design(claim, "from"), proof.design(claim, "to")
    a = a_list(field(claim, "A"), 6, lambda row: a_list(row, 6, number))
    c = a_list(field(claim, "c"), 6, number)
    for i in range(6):
        for k in range(16):
            need(dot(a[i], [v[k] for v in start.vectors]) == end.vectors[i][k], f"leg vector {i + 1} of {end.name} is not row {i + 1} of A times those of {start.name}")
        need(c[i] == end.squares[i] - dot(a[i], start.squares), f"c{i + 1} is not |a'|^2 + |b'|^2 minus A times |a|^2 + |b|^2")
    found = determinant(a)
    need(found == number(field(claim, "det")), f"det A is {shown(found)}")
    same = f"squared lengths of {end.name} are A s + c of those of {start.name} at every pose"
    if found.is_zero():
        return f"{same}, det A = 0: {end.name} is architecturally singular"
    proof.maps[str(field(claim, "id"))] = (whole(claim, "from"), whole(claim, "to"))
    return f"{same}, det A = {shown(found)}: corresponding lengths have the same poses, and the singular poses are the same"


def no_leg_map(proof: Proof, claim: Any) -> str:
    """Some legs of TO are not in the span of those of FROM."""
    start, end = proof.design(claim, "from"), proof.design(claim, "to")
    legs = field(claim, "legs")
    need(isinstance(legs, list) and len(legs) > 0, "no legs are named")
    rank = eliminate(start.vectors)[0]
    for leg in legs:
        need(isinstance(leg, int) and 1 <= leg <= 6, f"there is no leg {leg}")
        need(eliminate([*start.vectors, end.vectors[leg - 1]])[0] > rank, f"the vector of leg {leg} is in the span")
    names = ", ".join(map(str, legs))
    return f"the squared length of leg {names} of {end.name} is no affine function of those of {start.name}"


def dependency(proof: Proof, claim: Any) -> str:
    """The leg vectors are dependent."""
    design = proof.design(claim)
    c = a_list(field(claim, "coefficients"), 6, number)
    need(any(not x.is_zero() for x in c), "all coefficients are zero")
    need(all(dot(c, [v[k] for v in design.vectors]).is_zero() for k in range(16)), "the combination of the leg vectors is not zero")
    constant = dot(c, design.squares)
    need(constant == number(field(claim, "constant")), f"the combination of squared lengths is {shown(constant)}")
    words = " + ".join(f"({shown(x)}) s{i + 1}" for i, x in enumerate(c) if not x.is_zero())
    return f"{design.name} is architecturally singular: {words} = {shown(constant)} at every pose"


def leg_rank(proof: Proof, claim: Any) -> str:
    design = proof.design(claim)
    rank = eliminate(design.vectors)[0]
    need(rank == whole(claim, "rank"), f"the rank is {rank}")
    return f"the leg vectors of {design.name} have rank {rank}"


def regular_pose(proof: Proof, claim: Any) -> str:
    """Six independent leg lines at one pose."""
    design, pose = proof.design(claim), Pose.of(field(claim, "pose"))
    found = determinant(design.lines(pose))
    need(not found.is_zero(), "the leg lines are dependent at this pose")
    if "det" in claim:
        need(found == number(claim["det"]), f"det J is {shown(found)}")
    need(found.sign() == whole(claim, "sign"), f"det J is {shown(found)}")
    return f"the leg lines of {design.name} are independent at {pose}, det J = {shown(found)}: it is not architecturally singular"


def generic_rank(proof: Proof, claim: Any) -> str:
    """The rank of the leg lines at almost every pose: attained at one pose, and bounded by the rank of the leg vectors."""
    design, pose, rank = proof.design(claim), Pose.of(field(claim, "pose")), whole(claim, "rank")
    there, most = eliminate(design.lines(pose))[0], eliminate(design.vectors)[0]
    need(there == rank, f"the leg lines have rank {there} at this pose")
    need(most == rank, f"the leg vectors have rank {most}")
    return f"the leg lines of {design.name} have rank {rank} at almost every pose"


def principal_lattice(degree: int) -> Iterable[tuple[int, int, int]]:
    return ((i, j, k) for i in range(degree + 1) for j in range(degree + 1 - i) for k in range(degree + 1 - i - j))


def dependent_lines(proof: Proof, claim: Any) -> str:
    """The leg lines are dependent at the 1680 poses that decide all poses."""
    design = proof.design(claim)
    for x, y, z in principal_lattice(6):
        for steps in principal_lattice(3):
            pose = Pose([Number.of(k) for k in (1, x, y, z)], [Number.of(k) for k in steps])
            need(eliminate(design.lines(pose))[0] < 6, f"the leg lines are independent at the quaternion (1, {x}, {y}, {z}), {pose}")
    return f"{design.name} is architecturally singular: its leg lines are dependent at the 1680 poses that decide all poses"


def pose_bound(proof: Proof, claim: Any) -> str:
    """A bound on the number of isolated poses."""
    design, poses, theorem = proof.design(claim), whole(claim, "poses"), field(claim, "by")
    need(theorem in BOUNDS, f"there is no theorem `{theorem}`")
    bound, words = BOUNDS[theorem]
    proved = bound(design)
    need(proved <= poses, f"the theorem gives {proved}")
    proof.bounds[str(field(claim, "id"))] = (whole(claim, "design"), poses)
    return f"{design.name} has at most {poses} isolated poses for any lengths: {words}"


def equivalent_bound(proof: Proof, claim: Any) -> str:
    """The bound of an equivalent design: with a regular leg map, both have the same poses at corresponding lengths."""
    design, leg_map_id, bound = proof.design(claim), field(claim, "leg_map"), field(claim, "bound")
    need(leg_map_id in proof.maps, f"`{leg_map_id}` is not proved to be a regular leg map")
    need(bound in proof.bounds, f"`{bound}` is not proved")
    (start, end), (known, poses) = proof.maps[leg_map_id], proof.bounds[bound]
    need(end == whole(claim, "design") and start == known, f"`{leg_map_id}` does not lead from the design of `{bound}` to this one")
    need(poses <= whole(claim, "poses"), f"`{bound}` gives {poses}")
    proof.bounds[str(field(claim, "id"))] = (end, whole(claim, "poses"))
    return f"{design.name} has at most {poses} isolated poses for any lengths, as {proof.designs[start].name} has"


def root(proof: Proof, claim: Any) -> str:
    """One root within the radius of the centre, alone within the radius of uniqueness; its pose and its reality."""
    problem = proof.problem(claim)
    patch, unit = whole(claim, "patch"), fraction(field(claim, "unit"))
    need(0 <= patch < 4 and unit > 0, "patch or unit is no patch or unit")
    system = proof.system(problem, patch, unit)
    given = complex_list(field(claim, "centre"), 8)
    need(given[patch] == (Fraction(1), Fraction(0)), "the patch is not 1 at the centre")
    centre = [(scaled(given[k][0]), scaled(given[k][1])) for k in system.free]
    radius, alone = fraction(field(claim, "radius")), fraction(field(claim, "uniqueness_radius"))
    need(0 <= radius < alone, "the radius is not below the radius of uniqueness")
    local = refined(system, centre)
    r = 2 * local.eta + 1
    need(local.holds_one_root(r), "no root is proved near the end of Newton's method")
    # centre and end of Newton's method differ by one unit of rounding too
    away = max(math.isqrt((x - u) ** 2 + (y - v) ** 2) for (x, y), (u, v) in zip(local.x, centre)) + r + 4
    need(away <= scaled(radius), f"the root is {decimal(Fraction(away, ONE))} from the centre, not within {decimal(radius)}")
    here = Local(system, centre).bounded()
    need(here.is_alone(away, scaled(alone) + 8), f"another root may lie within {decimal(alone)}")
    box = system.whole([Complex.point(z).widened(r) for z in local.x])
    real = reality(local, r)
    stated = field(claim, "reality")
    need(stated in ("real", "non_real", "undecided"), f"`{stated}` is no reality")
    if stated != "undecided":
        need(real == (stated == "real"), {True: "the root is real", False: "the root is not real", None: "whether the root is real is undecided"}[real])
    found = Root(box, unit, real, problem)
    rotation, position = found.pose()
    pose = field(claim, "pose")
    for name, entries in (("R", [z for row in rotation for z in row]), ("p", position)):
        discs = zip(*(a_list(field(field(pose, name), part), len(entries), fraction) for part in ("re", "im", "radius")))
        for k, (z, disc) in enumerate(zip(entries, discs)):
            need(within(z, disc), f"entry {k + 1} of {name} is not in its disc")
    proof.roots[str(field(claim, "id"))] = found
    words = {"real": "a real pose", "non_real": "a complex pose"}.get(stated, "a pose")
    design = proof.designs[problem[0]]
    near = ", ".join(decimal(Fraction(z.middle()[0], ONE)) + ("" if stated == "real" else "..") for z in position)
    return f"{design.name} has exactly one pose within {decimal(radius)} of the centre, {words}: p = ({near})"


def reality(local: Local, r: int) -> bool | None:
    """Whether the root is real: it is, if its conjugate is within its radius of uniqueness."""
    aside = max(abs(z[1]) for z in local.x)
    if aside > r:
        return False
    return True if local.is_alone(r, r + 2 * aside + 4) else None


def complete(proof: Proof, claim: Any) -> str:
    """As many distinct regular poses as a bound allows: there are no others."""
    names = field(claim, "roots")
    need(isinstance(names, list) and len(set(names)) == len(names), "`roots` is no list of different names")
    for name in names:
        need(name in proof.roots, f"`{name}` is not proved")
    roots, problem = [proof.roots[name] for name in names], proof.problem(claim)
    need(all(x.problem == problem for x in roots), "a root belongs to other lengths or to another design")
    for (i, x), (j, y) in itertools.combinations(zip(names, roots), 2):
        need(x.differs(y), f"`{i}` and `{j}` may be the same pose")
    bound = field(claim, "bound")
    need(bound in proof.bounds, f"`{bound}` is not proved")
    design, most = proof.bounds[bound]
    need(design == problem[0], f"`{bound}` is about another design")
    need(len(roots) == most, f"there are {len(roots)} roots, and the bound is {most}")
    need(most > 0, "a list without poses proves nothing")
    real = sum(x.real is True for x in roots)
    need(all(x.real is not None for x in roots) and real == whole(claim, "real"), f"{real} of the roots are proved to be real")
    return f"the {most} poses listed for {proof.designs[design].name} are different, and there are no others; {real} of them are real"


def distinct(proof: Proof, claim: Any) -> str:
    """Poses that differ."""
    names = field(claim, "roots")
    need(isinstance(names, list) and len(set(names)) == len(names) > 0, "`roots` is no list of different names")
    for name in names:
        need(name in proof.roots, f"`{name}` is not proved")
    for i, j in itertools.combinations(names, 2):
        need(proof.roots[i].problem == proof.roots[j].problem, f"`{i}` and `{j}` belong to different lengths")
        need(proof.roots[i].differs(proof.roots[j]), f"`{i}` and `{j}` may be the same pose")
    return f"the {len(names)} poses listed are different"


def no_pose(proof: Proof, claim: Any) -> str:
    """Lengths that contradict a relation of the legs."""
    d, k = proof.problem(claim)
    design, lengths = proof.designs[d], proof.lengths[k]
    c = a_list(field(claim, "coefficients"), 6, number)
    need(all(dot(c, [v[k] for v in design.vectors]).is_zero() for k in range(16)), "the combination of the leg vectors is not zero")
    off = dot(c, [Number.of(x * x) - s for x, s in zip(lengths, design.squares)])
    need(not off.is_zero(), "the lengths satisfy the relation of the legs")
    return f"{design.name} has no pose with these lengths: they miss a relation of its squared lengths by {shown(off)}"


def margin(proof: Proof, claim: Any) -> str:
    """A requirement on the legs, met at poses."""
    design, kind, least = proof.design(claim), field(claim, "requirement"), fraction(field(claim, "at_least"))
    need(least >= 0, "the margin is negative")
    limits = a_list(field(claim, "limits"), 6, fraction)
    poses = field(claim, "poses")
    need(isinstance(poses, list) and len(poses) > 0, "no poses are listed")
    axes = a_list(field(claim, "axes"), 6, lambda x: a_list(x, 3, number)) if "cone_angle" in str(kind) else []
    for k, record in enumerate(poses):
        pose = Pose.of(record)
        for i, n in enumerate(design.legs_at(pose)):
            if kind in ("min_leg_length", "max_leg_length"):
                limit = limits[i] + least if kind == "min_leg_length" else limits[i] - least
                off = dot(n, n) - Number.of(limit * limit)
                met = limit <= 0 or off.sign() >= 0 if kind == "min_leg_length" else limit >= 0 and off.sign() <= 0
            elif kind in ("base_cone_angle", "platform_cone_angle"):
                if kind == "platform_cone_angle":
                    n = [dot([row[j] for row in pose.rotation], n) for j in range(3)]
                met = angle_is_below(n, axes[i], limits[i] - least)
            else:
                raise Refuted(f"`{kind}` is no requirement that this program checks")
            need(met, f"leg {i + 1} violates it at pose {k + 1}")
    unit = "degrees" if "angle" in kind else design.units
    return f"{design.name} meets {kind} {listed(limits)} with a margin of {shown(least)} {unit} or more at {counted(len(poses), 'pose')}"


def listed(numbers: Sequence[Number | Fraction]) -> str:
    """Numbers in words; equal ones as one."""
    return shown(numbers[0]) if len(set(numbers)) == 1 else f"({', '.join(shown(x) for x in numbers)})"


def angle_is_below(u: Row, v: Row, degrees: Fraction) -> bool:
    """Whether the angle between two vectors is at most so many degrees."""
    if degrees < 0:
        return False
    if degrees >= 180:
        return True
    size = (Real.of(dot(u, u)) * Real.of(dot(v, v))).sqrt()
    need(size.low > 0, "a leg or an axis has no direction")
    return (Real.of(dot(u, v)) - size * cosine_of_degrees(degrees)).low >= 0


# --- regions of poses ------------------------------------------------------------------------------------------------------------------------------

# Tilings are checked in these coordinates: distances of translation and rotation vector from the middle of the region over its half widths, in the cube [-1, 1]^6.
# The ends of a cell are integers over 2^BITS.
Ends = tuple[list[int], list[int]]
Vector = list[Real]
Matrix = list[Vector]
# Greatest square of a rotation vector: the coefficients of rotations and their slopes are monotone up to it.
LARGEST_TURN = 20
# Terms of their series below 2^-96 are left to the bound of the remainder.
LAST_TERM = 1 << (BITS - 96)


def real_dot(u: Vector, v: Vector) -> Real:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def real_cross(u: Vector, v: Vector) -> Vector:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def apply(r: Matrix, v: Vector) -> Vector:
    return [real_dot(row, v) for row in r]


def real_sum(items: Iterable[Real]) -> Real:
    out = ZERO
    for x in items:
        out = out + x
    return out


def square(x: Real) -> Real:
    low = 0 if x.has_zero() else min(abs(x.low), abs(x.high))
    return Real(low * low >> BITS, up(x.size() ** 2))


@functools.lru_cache(maxsize=1 << 14)
def stumpff_at(k: int, n: int, s: int) -> Real:
    """The n-th derivative of C_k(s) = sum_j (-s)^j / (2j + k)!, s from 0 to 20 over 2^BITS: an alternating series. Neighbouring cells share ends."""
    low = ONE * math.factorial(n) // math.factorial(2 * n + k)
    high, out_low, out_high, i = low + 1, 0, 0, 0
    while True:
        if (i + n) % 2:
            out_low, out_high = out_low - high, out_high - low
        else:
            out_low, out_high = out_low + low, out_high + high
        i += 1
        point, below = s * (i + n), i * (2 * (i + n) + k - 1) * (2 * (i + n) + k)
        low, high = (low * point >> BITS) // below, -((-high * point >> BITS) // below)
        # the terms fall once their ratio is below one, and the ratio falls
        if high < LAST_TERM and point < below * ONE:
            return Real(out_low - high, out_high + high)


def stumpff(k: int, n: int, s: Real) -> Real:
    """The same over an interval: monotone up to 20."""
    ends = [stumpff_at(k, n, x) for x in ([s.low] if s.low == s.high else [s.low, s.high])]
    return Real(min(x.low for x in ends), max(x.high for x in ends))


class Cell:
    """Poses over a cell: R v = v + C_1 w x v + C_2 w x (w x v) with C_k at w.w, for rotation vectors w, and the place of the pivot."""

    def __init__(self, region: Region, ends: Ends) -> None:
        x = [middle + Real(low, high) * width for middle, low, high, width in zip(region.middle, ends[0], ends[1], region.widths)]
        self.w = w = x[3:]
        squares = [square(a) for a in w]
        self.turn = squares[0] + squares[1] + squares[2]
        need(self.turn.high <= LARGEST_TURN * ONE, "the rotations of the region are too large")
        self.factors = stumpff(1, 0, self.turn), stumpff(2, 0, self.turn)
        self.twice = [[-(squares[(i + 1) % 3] + squares[(i + 2) % 3]) if i == j else w[i] * w[j] for j in range(3)] for i in range(3)]
        self.position = [a + b for a, b in zip(region.position, x)]

    def turned(self, v: Vector) -> Vector:
        """The vectors R v."""
        first, second = self.factors
        return [a + first * b + second * c for a, b, c in zip(v, real_cross(self.w, v), apply(self.twice, v))]

    def slopes(self, v: Vector) -> list[Vector]:
        """Their slopes along w: 2 w_k (C_1' w x v + C_2' w x (w x v)) + C_1 e_k x v + C_2 (e_k (w.v) + w v_k - 2 w_k v)."""
        w, (first, second), grown = self.w, self.factors, [stumpff(k, 1, self.turn) for k in (1, 2)]
        growth = [grown[0] * b + grown[1] * c for b, c in zip(real_cross(w, v), apply(self.twice, v))]
        spun, slopes = [first * x for x in v], list[Vector]()
        for k in range(3):
            i, j, two, slope = (k + 1) % 3, (k + 2) % 3, w[k] + w[k], [ZERO] * 3
            slope[k] = two * growth[k] + second * (w[i] * v[i] + w[j] * v[j])
            slope[i] = two * growth[i] - spun[j] + second * (w[i] * v[k] - two * v[i])
            slope[j] = two * growth[j] + spun[i] + second * (w[j] * v[k] - two * v[j])
            slopes.append(slope)
        return slopes


class Region:
    """The poses R = exp([w]x) R_home, p = p_home + d + R_home q - R q with the pivot q: d and w in intervals, or each in the ellipsoid that touches its intervals.

    So R b + p = exp([w]x) R_home (b - q) + (p_home + R_home q + d): the joints b are measured from the pivot, and d displaces the pivot."""

    def __init__(self, design: Design, record: Any) -> None:
        self.shape = field(record, "shape")
        need(self.shape in ("box", "ellipsoid"), f"`{self.shape}` is no shape of a region")
        self.pose = home = Pose.of(field(record, "home"))
        self.pivot = pivot = a_list(field(record, "pivot"), 3, number)
        self.intervals = [interval for name in ("translation", "rotation_deg") for interval in a_list(field(record, name), 3, lambda x: a_list(x, 2, fraction))]
        need(all(low <= high for low, high in self.intervals), "an interval ends below its beginning")
        self.used = [low < high for low, high in self.intervals]
        units = [Real.of(1)] * 3 + [Real.of(Fraction(1, 180)) * pi()] * 3
        self.middle = [Real.of((low + high) / 2) * unit for (low, high), unit in zip(self.intervals, units)]
        self.widths = [Real.of((high - low) / 2) * unit for (low, high), unit in zip(self.intervals, units)]
        # the place of the pivot for d = 0
        self.position = [Real.of(p + dot(row, pivot)) for p, row in zip(home.position, home.rotation)]
        self.home = [[Real.of(x) for x in row] for row in home.rotation]
        self.base = [[Real.of(x) for x in a] for a in design.base]
        self.platform = [[Real.of(dot(row, [x - q for x, q in zip(b, pivot)])) for row in home.rotation] for b in design.platform]

    def poses(self) -> str:
        """Words for its poses."""
        names = ("x", "y", "z", "rotation about x", "rotation about y", "rotation about z")
        parts = [f"{name} {shown(low)} to {shown(high)}" for name, (low, high) in zip(names, self.intervals) if low or high]
        if not parts:
            return f"the pose {self.pose}"
        pivot = "" if all(q.is_zero() for q in self.pivot) else f" about the pivot ({', '.join(shown(q) for q in self.pivot)})"
        return f"every pose of the {self.shape} {', '.join(parts)} from home{pivot}"

    def tiled(self, tree: Any, prove: Callable[[Cell, Cell, Ends], None]) -> int:
        """Checks the cells of a tree, which tile the region, and counts them."""
        need(isinstance(tree, str), "a tiling is missing")
        start = [ONE if used else 0 for used in self.used]
        open_cells: list[Ends] = [([-x for x in start], start)]
        count = 0
        for letter in tree:
            need(bool(open_cells), "the tiling goes on after its last cell")
            low, high = open_cells.pop()
            need(all((a + b) % 2 == 0 for a, b in zip(low, high)), "the cell is too small")
            middle = [(a + b) // 2 for a, b in zip(low, high)]
            if letter in "012345":
                k = int(letter)
                open_cells.append(([*low[:k], middle[k], *low[k + 1 :]], high))
                open_cells.append((low, [*high[:k], middle[k], *high[k + 1 :]]))
            elif letter == "x":
                nearest = [max(a, -b, 0) for a, b in zip(low, high)]
                outside = any(sum(x * x for x in nearest[i : i + 3]) > ONE * ONE for i in (0, 3))
                need(self.shape == "ellipsoid" and outside, f"cell {count + 1} is not outside the region")
            else:
                need(letter == ".", f"`{letter}` is no part of a tiling")
                count += 1
                try:
                    prove(Cell(self, (middle, middle)), Cell(self, (low, high)), (low, high))
                except Refuted as why:
                    raise Refuted(f"cell {count} is not proved: {why}") from why
        need(not open_cells, "the tiling does not cover the region")
        return count

    def along(self, cell: Cell, leg: int) -> list[Vector]:
        """The changes of a leg vector along the coordinates."""
        return [[self.widths[k] if i == k else ZERO for i in range(3)] for k in range(3)] + self.turns(cell, self.platform[leg])

    def turns(self, cell: Cell, at_home: Vector) -> list[Vector]:
        """The changes along the rotations of a vector that rotates from home."""
        return [[x * width for x in slope] for slope, width in zip(cell.slopes(at_home), self.widths[3:])]

    def leg(self, cell: Cell, leg: int) -> Vector:
        return [x + p - a for x, p, a in zip(cell.turned(self.platform[leg]), cell.position, self.base[leg])]

    def line(self, cell: Cell, leg: int, ks: range) -> JetVector:
        along = self.along(cell, leg) if ks else []
        return [Jet(x, [t[j] for t in along]) for j, x in enumerate(self.leg(cell, leg))]

    def turned(self, cell: Cell, at_home: Vector, ks: range) -> JetVector:
        """A vector that rotates from home."""
        along = [[ZERO] * 3] * 3 + self.turns(cell, at_home) if ks else []
        return [Jet(x, [t[j] for t in along]) for j, x in enumerate(cell.turned(at_home))]

    def least(self, value: Real, slopes: Vector, ends: Ends) -> int:
        """A lower bound on a cell, over 2^BITS, of a function with this value at the middle and these slopes."""
        out, half, z = value.low, half_widths(ends), [(a + b) // 2 for a, b in zip(*ends)]
        for first in (0, 3):
            ks = range(first, first + 3)
            c = {k: (slopes[k].low + slopes[k].high) // 2 for k in ks}
            in_cell = -sum(up(abs(c[k]) * half[k]) for k in ks)
            in_ball = -sum(up(c[k] * z[k]) for k in ks) - math.isqrt(sum(c[k] ** 2 for k in ks)) - 1
            out += max(in_cell, in_ball) if self.shape == "ellipsoid" else in_cell
            out -= sum(up(max(slopes[k].high - c[k], c[k] - slopes[k].low) * half[k]) for k in ks)
        return out

    def lines(self, cell: Cell, unit: Real) -> Matrix:
        """Rows (n, R b x (p - a) / unit): moments about the pivot."""
        rows = []
        for a, b in zip(self.base, self.platform):
            arm, lever = cell.turned(b), [p - x for p, x in zip(cell.position, a)]
            rows.append([x + y for x, y in zip(arm, lever)] + [x * unit for x in real_cross(arm, lever)])
        return rows

    def changes(self, cell: Cell, unit: Real) -> list[Matrix]:
        """The changes of these rows along the coordinates."""
        changes: list[Matrix] = [[] for _ in range(6)]
        for leg, (a, b) in enumerate(zip(self.base, self.platform)):
            arm, lever = cell.turned(b), [p - x for p, x in zip(cell.position, a)]
            for k, change in enumerate(self.along(cell, leg)):
                moment = real_cross(arm, change) if k < 3 else real_cross(change, lever)
                changes[k].append(change + [x * unit for x in moment])
        return changes


def half_widths(ends: Ends) -> list[int]:
    """Half widths of a cell over 2^BITS."""
    return [(b - a) // 2 for a, b in zip(*ends)]


def square_of(v: Vector) -> Real:
    return square(v[0]) + square(v[1]) + square(v[2])


def product(left_factor: Matrix, right_factor: Matrix) -> Matrix:
    columns = list(zip(*right_factor))
    return [[real_sum(x * y for x, y in zip(row, column)) for column in columns] for row in left_factor]


def margin_over_region(proof: Proof, claim: Any) -> str:
    """A requirement on the legs, met at every pose of a region: a bound on each cell of a tiling."""
    design, kind, least = proof.design(claim), field(claim, "requirement"), fraction(field(claim, "at_least"))
    need(least >= 0, "the margin is negative")
    limits, region = a_list(field(claim, "limits"), 6, fraction), Region(design, field(claim, "region"))
    trees = a_list(field(claim, "trees"), 6, lambda tree: tree)
    need(kind in ("min_leg_length", "max_leg_length", "base_cone_angle", "platform_cone_angle"), f"`{kind}` is no requirement that this program checks")
    axes = a_list(field(claim, "axes"), 6, lambda x: [Real.of(v) for v in a_list(x, 3, number)]) if "cone_angle" in kind else []
    need(all(square_of(m).low > 0 for m in axes), "an axis has no direction")
    cells, of_platform = 0, kind == "platform_cone_angle"
    for i in range(6):
        limit = limits[i] + least if kind == "min_leg_length" else limits[i] - least
        need(limit >= 0, "the limit is negative")
        bound = Real.of(limit * limit)
        if axes:
            need(limit <= 180, "the limit is above 180 degrees")
            cosine, axis = cosine_of_degrees(limit) * real_dot(axes[i], axes[i]).sqrt(), apply(region.home, axes[i])

        def prove(middle: Cell, cell: Cell, ends: Ends, i: int = i) -> None:
            n0, along = region.leg(middle, i), region.along(cell, i)
            if not axes:
                # |n|^2 = |n0|^2 + 2 n0.D + |D|^2 with D = n - n0
                twice = [x + x for x in n0]
                value, slopes = square_of(n0) - bound, [real_dot(twice, t) for t in along]
                if kind == "max_leg_length":
                    half = half_widths(ends)
                    d = [sum(up(t[j].size() * half[k]) for k, t in enumerate(along)) for j in range(3)]
                    rest = sum(up(x * x) for x in d)
                    value, slopes = -value - Real(rest, rest), [-x for x in slopes]
            else:
                # n.m - cos(limit) |n| |m| with the axis m in the base frame
                n = region.leg(cell, i)
                need(square_of(n).low > 0, "the leg may have no direction")
                m0, m = (c.turned(axis) if of_platform else axes[i] for c in (middle, cell))
                value, scale = real_dot(n0, m0) - cosine * square_of(n0).sqrt(), cosine * square_of(n).sqrt().inverse()
                slopes = [real_dot(t, m) - scale * real_dot(n, t) for t in along]
                if of_platform:
                    for k, turn in enumerate(region.turns(cell, axis)):
                        slopes[3 + k] = slopes[3 + k] + real_dot(n, turn)
            need(region.least(value, slopes, ends) >= 0, f"leg {i + 1} may violate it")

        cells += region.tiled(trees[i], prove)
    unit = "degrees" if axes else design.units
    return f"{design.name} meets {kind} {listed(limits)} with a margin of {shown(least)} {unit} or more at {region.poses()} ({counted(cells, 'cell')})"


class Jet:
    """A function over a cell: its values, and its slopes along some coordinates."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: Real, slopes: list[Real]) -> None:
        self.value, self.slopes = value, slopes

    def __add__(self, other: Jet) -> Jet:
        return Jet(self.value + other.value, [x + y for x, y in zip(self.slopes, other.slopes)])

    def __sub__(self, other: Jet) -> Jet:
        return Jet(self.value - other.value, [x - y for x, y in zip(self.slopes, other.slopes)])

    def __neg__(self) -> Jet:
        return Jet(-self.value, [-x for x in self.slopes])

    def __mul__(self, other: Jet) -> Jet:
        return Jet(self.value * other.value, [x * other.value + self.value * y for x, y in zip(self.slopes, other.slopes)])

    def square(self) -> Jet:
        twice = self.value + self.value
        return Jet(square(self.value), [twice * x for x in self.slopes])

    def times(self, x: Real) -> Jet:
        return Jet(self.value * x, [y * x for y in self.slopes])

    def root(self) -> Jet:
        value = self.value.sqrt()
        over = (value + value).inverse()
        return Jet(value, [x * over for x in self.slopes])

    def inverse(self) -> Jet:
        value = self.value.inverse()
        return Jet(value, [-(x * value * value) for x in self.slopes])


JetVector = list[Jet]


def jet_dot(u: JetVector, v: JetVector) -> Jet:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def jet_square_of(v: JetVector) -> Jet:
    return v[0].square() + v[1].square() + v[2].square()


def jet_less(u: JetVector, v: JetVector) -> JetVector:
    return [x - y for x, y in zip(u, v)]


def jet_cross(u: JetVector, v: JetVector) -> JetVector:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def constants(v: Vector, ks: range) -> JetVector:
    return [Jet(x, [ZERO for _ in ks]) for x in v]


class LegBody:
    """All points within a radius of the cylinder, which begins at the base joint, and of the rod, which continues to the platform joint."""

    def __init__(self, record: Any) -> None:
        self.radius, self.cylinder, self.rod = fraction(field(record, "diameter")) / 2, Fraction(0), Fraction(0)
        self.has_rod = "rod_diameter" in record
        if self.has_rod:
            self.cylinder, self.rod = fraction(field(record, "cylinder_length")), fraction(record["rod_diameter"]) / 2
        need(min(self.radius, self.cylinder, self.rod) >= 0, "a size of the leg is negative")


class LegOnCell:
    """The line of a leg over a cell and the ends of its parts, each with its radius. A leg that may be shorter than its cylinder is one part with the greater radius."""

    def __init__(self, region: Region, cell: Cell, leg: int, body: LegBody, ks: range, in_parts: bool) -> None:
        self.base, self.line = constants(region.base[leg], ks), region.line(cell, leg, ks)
        end, square = [a + n for a, n in zip(self.base, self.line)], jet_square_of(self.line)
        self.parts = [([self.base, end], max(body.radius, body.rod))]
        if in_parts and body.has_rod and square.value.low > Real.of(body.cylinder**2).high:
            share = square.root().inverse().times(Real.of(body.cylinder))
            top = [a + n * share for a, n in zip(self.base, self.line)]
            self.parts = [([self.base, top], body.radius), ([top, end], body.rod)]

    def across(self, point: JetVector) -> JetVector:
        """A multiple of the vector from the line to a point, normal to the line."""
        arm = jet_less(point, self.base)
        along, square = jet_dot(arm, self.line), jet_square_of(self.line)
        return [x * square - n * along for x, n in zip(arm, self.line)]


def direction(code: str, one: LegOnCell, p: list[JetVector], two: LegOnCell, q: list[JetVector]) -> JetVector:
    """A vector that depends on the pose: normal to both legs, normal to one of them from an end on the other, or between two ends. Any vector proves what is proved with it."""
    need(len(code) == 1 and code in "012345678", "a direction is missing")
    k = int(code)
    if k == 0:
        return jet_cross(one.line, two.line)
    if k <= 2:
        return [-x for x in two.across(p[k - 1])]
    return one.across(q[k - 3]) if k <= 4 else jet_less(q[(k - 5) % 2], p[(k - 5) // 2])


def leg_clearance(proof: Proof, claim: Any) -> str:
    """A gap between all legs that share no joint, at every pose of a region: u.(y - x) >= gap |u| for the ends of two segments, with some vector u at each pose."""
    design, region, body = proof.design(claim), Region(proof.design(claim), field(claim, "region")), LegBody(field(claim, "body"))
    least, clearance = fraction(field(claim, "at_least")), fraction(field(claim, "clearance"))
    need(least >= 0 and clearance >= 0, "the margin or the clearance is negative")
    given = {tuple(a_list(field(pair, "legs"), 2, int)): pair for pair in field(claim, "pairs")}
    cells = 0
    for i, j in itertools.combinations(range(6), 2):
        if design.base[i] == design.base[j] or design.platform[i] == design.platform[j]:
            continue
        need((i + 1, j + 1) in given, f"legs {i + 1} and {j + 1} are missing")
        pair = given[(i + 1, j + 1)]
        codes = iter(field(pair, "directions"))

        def prove(middle: Cell, cell: Cell, ends: Ends, i: int = i, j: int = j, codes: Any = codes) -> None:
            over = [LegOnCell(region, cell, leg, body, range(6), True) for leg in (i, j)]
            at = [LegOnCell(region, middle, leg, body, range(0), len(o.parts) == 2) for leg, o in zip((i, j), over)]
            need(all(len(a.parts) == len(o.parts) for a, o in zip(at, over)), "the parts of a leg are undecided")
            for s, t in itertools.product(range(len(over[0].parts)), range(len(over[1].parts))):
                code = next(codes, "")
                pairs = [(legs[0].parts[s][0], legs[1].parts[t][0]) for legs in (at, over)]
                vectors = [direction(code, legs[0], p, legs[1], q) for legs, (p, q) in zip((at, over), pairs)]
                between = jet_dot(vectors[0], jet_less(at[1].base, at[0].base)).value
                if code == "0" and between.low + between.high < 0:
                    vectors = [[-x for x in u] for u in vectors]
                need(jet_square_of(vectors[1]).value.low > 0, "a direction may vanish")
                gap = Real.of(least + clearance + over[0].parts[s][1] + over[1].parts[t][1])
                sizes = [jet_square_of(u).root().times(gap) for u in vectors]
                # a direction normal to a leg has the same product with all points of its line: the base joint stands for them
                ours, theirs = [-1] if code in "034" else [0, 1], [-1] if code in "012" else [0, 1]
                for x, y in itertools.product(ours, theirs):
                    points = [((legs[0].base if x < 0 else p[x]), (legs[1].base if y < 0 else q[y])) for legs, (p, q) in zip((at, over), pairs)]
                    here, there = (jet_dot(u, jet_less(b, a)) - size for u, (a, b), size in zip(vectors, points, sizes))
                    need(region.least(here.value, there.slopes, ends) >= 0, f"legs {i + 1} and {j + 1} may be too near")

        cells += region.tiled(field(pair, "tree"), prove)
    return f"legs of {design.name} that share no joint are {shown(clearance)} {design.units} apart, with a margin of {shown(least)} {design.units} or more, at {region.poses()} ({counted(cells, 'cell')})"


class Load:
    """A force at a point of the platform frame and a torque, which keep their direction in the frame of a body, and the weights of the legs."""

    def __init__(self, region: Region, record: Any) -> None:
        def vector(name: str, of: Any) -> Row:
            return a_list(field(of, name), 3, number)

        def at_home(v: Row) -> Vector:
            return [Real.of(dot(row, v)) for row in region.pose.rotation]

        self.name, self.region = str(field(record, "name")), region
        fixed_to = field(record, "fixed_to")
        need(fixed_to in ("base", "platform"), f"`{fixed_to}` is no body")
        self.turns = fixed_to == "platform"
        self.force, self.torque = ((at_home(v) if self.turns else [Real.of(x) for x in v]) for v in (vector("force", record), vector("torque", record)))
        self.arm = at_home([x - q for x, q in zip(vector("at", record), region.pivot)])
        weights = record.get("leg_weights")
        self.weights = None if weights is None else [[Real.of(x) for x in vector(name, weights)] for name in ("rod", "moment")]

    def wrench(self, cell: Cell, ks: range) -> JetVector:
        """Force, and torque about the pivot."""
        region = self.region

        def own(v: Vector) -> JetVector:
            return region.turned(cell, v, ks) if self.turns else constants(v, ks)

        force = own(self.force)
        torque = [x + y for x, y in zip(own(self.torque), jet_cross(region.turned(cell, self.arm, ks), force))]
        for leg in range(6) if self.weights else ():
            line, (rod, moment) = region.line(cell, leg, ks), (constants(v, ks) for v in self.weights or ())
            over = jet_square_of(line).root().inverse()
            along = [x * over for x in line]
            lengthwise = jet_dot(along, moment)
            weight = [r + (m - u * lengthwise) * over for r, m, u in zip(rod, moment, along)]
            torque = [x + y for x, y in zip(torque, jet_cross(region.turned(cell, region.platform[leg], ks), weight))]
            force = [x + y for x, y in zip(force, weight)]
        return force + torque


def solved(inverse: Matrix, rest: Matrix, right: Vector) -> Vector:
    """The solutions of B x = right, with K for `inverse` and I - K B for `rest`: x = K right + (I - K B) x, so |x| <= |K right| / (1 - |I - K B|)."""
    start = [real_sum(x * y for x, y in zip(row, right)) for row in inverse]
    norm = max(sum(x.size() for x in row) for row in rest)
    need(norm < ONE, "the leg lines may be dependent")
    size = -(-max(x.size() for x in start) * ONE // (ONE - norm))
    return [x + real_sum(y * Real(-size, size) for y in row) for x, row in zip(start, rest)]


def leg_force(proof: Proof, claim: Any) -> str:
    """Leg forces under loads at every pose of a region: f = phi |n| with B phi = -w for the columns (n, R b x n / unit) of B. Slopes solve B phi_k = -w_k - B_k phi."""
    design, region = proof.design(claim), Region(proof.design(claim), field(claim, "region"))
    least, limit, unit = (fraction(field(claim, name)) for name in ("at_least", "limit", "unit"))
    need(least >= 0 and unit > 0, "the margin is negative, or the unit is not positive")
    scale, greatest, loads, cells = Real.of(1 / unit), Real.of(limit - least), field(claim, "loads"), 0
    need(isinstance(loads, list) and len(loads) > 0, "no loads are listed")
    for record in loads:
        load = Load(region, record)

        def prove(middle: Cell, cell: Cell, ends: Ends, load: Load = load) -> None:
            half, one = half_widths(ends), Real.of(1)
            lines = [list(column) for column in zip(*region.lines(middle, scale))]
            inverse = [[Real(z[0], z[0]) for z in row] for row in approximate_inverse([[((x.low + x.high) // 2, 0) for x in row] for row in lines])]
            changes = [[list(column) for column in zip(*change)] for change in region.changes(cell, scale)]
            start, solved_changes = product(inverse, lines), [product(inverse, change) for change in changes]
            rest_at = [[(one if i == j else ZERO) - x for j, x in enumerate(row)] for i, row in enumerate(start)]
            reach = [[sum(up(change[i][j].size() * h) for change, h in zip(solved_changes, half)) for j in range(6)] for i in range(6)]
            rest = [[x + Real(-r, r) for x, r in zip(row, out)] for row, out in zip(rest_at, reach)]
            at, over = load.wrench(middle, range(0)), load.wrench(cell, range(6))
            scaled_at, scaled_over = ([x if j < 3 else x.times(scale) for j, x in enumerate(w)] for w in (at, over))
            phi_at, phi = solved(inverse, rest_at, [-x.value for x in scaled_at]), solved(inverse, rest, [-x.value for x in scaled_over])
            slopes = [
                solved(inverse, rest, [-x.slopes[k] - real_sum(b * p for b, p in zip(row, phi)) for x, row in zip(scaled_over, changes[k])]) for k in range(6)
            ]
            for i in range(6):
                length_at, length = (jet_square_of(line).root() for line in (region.line(middle, i, range(0)), region.line(cell, i, range(6))))
                force = phi_at[i] * length_at.value
                along = [slopes[k][i] * length.value + phi[i] * length.slopes[k] for k in range(6)]
                met = region.least(greatest - force, [-x for x in along], ends) >= 0 and region.least(greatest + force, along, ends) >= 0
                need(met, f"the force of leg {i + 1} may be too large under {load.name}")

        cells += region.tiled(field(record, "tree"), prove)
    names = ", ".join(str(field(record, "name")) for record in loads)
    return f"leg forces of {design.name} under {names} are at most {shown(limit)}, with a margin of {shown(least)} or more, at {region.poses()} ({counted(cells, 'cell')})"


def regular_region(proof: Proof, claim: Any) -> str:
    """det J is not zero at any pose of a region: |1 - K J| < 1 on each cell of a tiling, with K near the inverse of J at its middle."""
    design = proof.design(claim)
    region, unit = Region(design, field(claim, "region")), fraction(field(claim, "unit"))
    need(unit > 0, "the unit is not positive")
    scale = Real.of(1 / unit)

    def prove(middle: Cell, cell: Cell, ends: Ends) -> None:
        half = half_widths(ends)
        at = region.lines(middle, scale)
        inverse = approximate_inverse([[((x.low + x.high) // 2, 0) for x in row] for row in at])
        k_rows = [[Real(z[0], z[0]) for z in row] for row in inverse]
        start, changes = product(k_rows, at), [product(k_rows, change) for change in region.changes(cell, scale)]
        one = Real.of(1)
        for i in range(6):
            size = 0
            for j in range(6):
                size += (start[i][j] - (one if i == j else ZERO)).size()
                size += sum(up(changes[k][i][j].size() * half[k]) for k in range(6))
            need(size < ONE, "the leg lines may be dependent")

    cells = region.tiled(field(claim, "tree"), prove)
    return f"{design.name} is regular at {region.poses()} ({counted(cells, 'cell')})"


CLAIMS: dict[str, Callable[[Proof, Any], str]] = {
    check.__name__: check
    for check in (leg_map, no_leg_map, dependency, leg_rank, regular_pose, generic_rank, dependent_lines, pose_bound, equivalent_bound, root, complete, distinct, no_pose, margin, margin_over_region, leg_clearance, leg_force, regular_region)
}


def name_of(k: int, claim: Any) -> str:
    known = claim if isinstance(claim, dict) else {}
    return str(known.get("id", f"claim {k + 1}")) + f" ({known.get('claim', 'no claim')})"


def checked(proof: Proof, claim: Any) -> str:
    """The sentence of a claim that holds."""
    kind = field(claim, "claim")
    need(isinstance(kind, str) and kind in CLAIMS, f"`{kind}` is no claim that this program checks")
    need(isinstance(field(claim, "theorem"), str), "the theorem is not named")
    try:
        return CLAIMS[kind](proof, claim)
    except (ArithmeticError, AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise Refuted(f"its data cannot be read ({type(error).__name__}: {error})") from error


def read(text: str) -> dict[str, Any]:
    """The document of a proof file."""

    def no_float(digits: str) -> Any:
        raise NoProof(f"the number {digits} is no exact number")

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """Other readers may take the first of two values."""
        out = dict(pairs)
        if len(out) < len(pairs):
            raise NoProof("a key is repeated")
        return out

    try:
        document = json.loads(text, parse_float=no_float, parse_constant=no_float, object_pairs_hook=once)
    except (ValueError, RecursionError) as error:
        raise NoProof(f"it is no JSON document: {error}") from error
    if not isinstance(document, dict) or not isinstance(document.get("equipod_proof"), str):
        raise NoProof("`equipod_proof` is missing")
    if document.get("schema_version") != VERSION:
        raise NoProof(f"`schema_version` is {document.get('schema_version')!r}, and this program reads version {VERSION}")
    for key in ("claims", "not_included"):
        if not isinstance(document.get(key, [] if key == "not_included" else None), list):
            raise NoProof(f"`{key}` is no list")
    return document


def run(path: str, write: Callable[[str], None] = print) -> int:
    """Checks a file, says each claim, and gives the exit code."""

    def say(text: str) -> None:
        # a name in the file writes no line of its own
        write("".join(letter if letter.isprintable() else " " for letter in text))

    # Exact numbers of a proof may have more digits than Python converts by default.
    if hasattr(sys, "set_int_max_str_digits"):
        sys.set_int_max_str_digits(1_000_000)
    try:
        with open(path, encoding="utf-8") as file:
            document = read(file.read())
        proof = Proof(document)
    except OSError as error:
        say(f"{path} cannot be read: {error.strerror}")
        return 2
    except (NoProof, Refuted, UnicodeDecodeError, AttributeError, TypeError) as error:
        say(f"{path} is no proof file: {error}")
        return 2
    failed = 0
    for k, claim in enumerate(document["claims"]):
        try:
            say(f"holds: {name_of(k, claim)}: {checked(proof, claim)}")
        except Refuted as why:
            failed += 1
            say(f"DOES NOT HOLD: {name_of(k, claim)}: {why}")
    for left in document.get("not_included", []):
        known = left if isinstance(left, dict) else {}
        say(f"not included: {known.get('statement', left)} ({known.get('reason', 'no reason given')})")
    count = len(document["claims"])
    if count == 0:
        say(f"{path} has no claims: nothing is proved")
        return 3
    say(f"{failed} of {count} claims do not hold" if failed else f"every claim holds ({count})")
    return 1 if failed else 0


def program() -> int:
    """The command `equipod-check`."""
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 2
    try:
        return run(sys.argv[1])
    except BrokenPipeError:
        # The reader closed the pipe before the last claim was checked.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 2


if __name__ == "__main__":
    sys.exit(program())

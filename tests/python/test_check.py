"""The program `equipod-check` of the package: it checks proof files, and imports nothing beyond the standard library."""

import copy
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys
import types
from fractions import Fraction

import equipod
from equipod_check import check

DESIGNS = pathlib.Path(__file__).parents[2] / "designs"
PROGRAM = pathlib.Path(sys.executable).with_name("equipod-check")


def test_the_program_of_the_package_checks_a_proof_and_names_a_fault(tmp_path):
    proof = tmp_path / "proof.json"
    pair = [str(DESIGNS / name) for name in ("rbt-octahedral.toml", "rbt-griffis-duffy.toml")]
    subprocess.run([sys.executable, "-m", "equipod", "verify", *pair, "--samples", "1", "--proof", proof], capture_output=True, check=True)
    done = subprocess.run([PROGRAM, proof], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, "every claim holds (2)")
    document = json.loads(proof.read_text())
    document["claims"][0]["c"][0] = "-1/2"
    proof.write_text(json.dumps(document))
    done = subprocess.run([PROGRAM, proof], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "DOES NOT HOLD: leg-map (leg_map): c1 is" in done.stdout


def places(value, way=()):
    """The ways to all values of a document."""
    yield way
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inner:
        yield from places(one, (*way, key))


def test_documents_that_are_nearly_proofs_are_checked_or_refused(tmp_path):
    proof = tmp_path / "proof.json"
    pair = [str(DESIGNS / name) for name in ("rbt-octahedral.toml", "rbt-griffis-duffy.toml")]
    subprocess.run([sys.executable, "-m", "equipod", "verify", *pair, "--samples", "1", "--proof", proof], capture_output=True, check=True)
    whole = json.loads(proof.read_text())
    ways = [way for way in places(whole) if way]
    values = [None, True, -1, 10**30, "", "1/0", "1e999", [], {}, [[]], "sqrt(2)", "9" * 500, {"a": 1}, "x"]
    draw = random.Random(1)
    codes = set()
    for case in range(400):
        document = copy.deepcopy(whole)
        *outer, key = ways[case] if case < len(ways) else draw.choice(ways)
        parent = document
        for step in outer:
            parent = parent[step]
        if draw.random() < 0.2:
            del parent[key]
        else:
            parent[key] = draw.choice(values)
        proof.write_text(json.dumps(document))
        codes.add(check.run(str(proof), lambda _: None))
    assert codes <= {0, 1, 2, 3} and {1, 2} <= codes
    whole["not_included"] = 7
    proof.write_text(json.dumps(whole))
    assert check.run(str(proof), lambda _: None) == 2


def test_the_checker_imports_only_the_standard_library():
    script = "import sys; before = set(sys.modules); import equipod_check.check; print(*sorted(set(sys.modules) - before))"
    done = subprocess.run([sys.executable, "-I", "-c", script], capture_output=True, text=True, check=True)
    others = {name.partition(".")[0] for name in done.stdout.split()} - {"equipod_check"}
    assert others <= set(sys.stdlib_module_names)
    assert equipod.__version__


def test_exact_numbers_are_those_of_their_texts():
    number = check.number
    assert str(number("1/2 + sqrt(3)/6") * number("1/2 - sqrt(3)/6")) == "1/6"
    assert str(number("-6*sqrt(12)")) == "-12*sqrt(3)"
    assert (number("5 + 2*sqrt(6)") * number("5 - 2*sqrt(6)")).terms == {1: 1}
    assert [number(x).sign() for x in ("sqrt(2) - 1", "7 - 5*sqrt(2)", "99 - 70*sqrt(2)", "sqrt(2) - sqrt(2)")] == [1, -1, 1, 0]
    x = number("1 + sqrt(2) - sqrt(3) + 2*sqrt(6)/5")
    assert (x * x.inverse()).terms == {1: 1}


def test_the_ends_of_a_product_are_the_least_and_the_greatest_product():
    ends = [x * check.ONE for x in (-3, -1, 0, 2, 5)]
    factors = [check.Real(low, high) for low, high in itertools.combinations_with_replacement(ends, 2)]
    for x, y in itertools.product(factors, repeat=2):
        products = [a * b // check.ONE for a in (x.low, x.high) for b in (y.low, y.high)]
        found = x * y
        assert (found.low, found.high) == (min(products), max(products)), (x.low, x.high, y.low, y.high)


def test_series_of_rotations_enclose_their_sums():
    def partial_sum(k: int, n: int, s: Fraction) -> Fraction:
        terms = ((-1) ** j * Fraction(math.perm(j, n), math.factorial(2 * j + k)) * s ** (j - n) for j in range(n, 60))
        return sum(terms, Fraction(0))

    for k, n, s in itertools.product((1, 2), (0, 1), (Fraction(0), Fraction(1, 1024), Fraction(3, 2), Fraction(20))):
        exact, found = partial_sum(k, n, s), check.stumpff_at(k, n, check.scaled(s))
        assert found.low <= exact * check.ONE <= found.high
        assert found.high - found.low < check.ONE >> 80


def test_slopes_over_a_cell_hold_the_change_from_end_to_end():
    still = [["0", "0"]] * 3
    home = {"quaternion": ["1", "0", "0", "0"], "position": ["0", "0", "0"]}
    turns = [["-40", "30"], ["-20", "50"], ["-60", "20"]]
    record = {"shape": "box", "home": home, "pivot": ["0", "0", "0"], "translation": still, "rotation_deg": turns}
    region = check.Region(types.SimpleNamespace(base=[], platform=[]), record)
    v = [check.Real.of(x) for x in (3, -5, 2)]
    low, high = [0, 0, 0, -check.ONE, check.ONE // 4, 0], [0, 0, 0, -check.ONE // 2, check.ONE // 2, check.ONE // 2]
    cell = check.Cell(region, (low, high))
    for k in (3, 4, 5):
        end = [h if i == k else x for i, (x, h) in enumerate(zip(low, high))]
        ends = [check.Cell(region, (x, x)).turned(v) for x in (low, end)]
        slope = [x * region.widths[k] * check.Real(high[k] - low[k], high[k] - low[k]) for x in cell.slopes(v)[k - 3]]
        for a, b, change in zip(*ends, slope):
            assert change.low <= (b - a).low and (b - a).high <= change.high
            assert change.high - change.low < 4 * check.ONE

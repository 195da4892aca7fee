"""Designs in and out of Python, polynomials, five legs, logs with bad rows, and words that options take."""

import ast
import pathlib
import pickle
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from typing import get_args

import numpy as np
import pytest

import equipod
from equipod import _words
from equipod._program import ask

DESIGNS = pathlib.Path(__file__).parents[2] / "designs"
FIXTURES = pathlib.Path(__file__).parents[1] / "fixtures"
PENTAPOD = DESIGNS / "pentapods" / "line-plane.toml"


@pytest.fixture(scope="module")
def octahedral():
    return equipod.Design.load(DESIGNS / "rbt-octahedral.toml")


TRIANGLES = ([[0, 0, 0], ["12", 0, 0], [6, "6*sqrt(3)", 0]], [[0, 0, 0], [Fraction(6), 0, 0], [3, "3*sqrt(3)", 0]])
PAIRS = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]


def test_texts_and_fractions_are_exact_joints():
    exact = equipod.Design.from_arrays(*TRIANGLES, PAIRS, units="in")
    assert exact.units == "in" and '"6*sqrt(3)"' in exact.dumps()
    assert np.allclose(exact.joints.base[2], [6, 6 * np.sqrt(3), 0]) and exact.joints.base_names == ("A1", "A2", "A3")
    # a midline platform is singular, which is proved about exact joints alone
    middle = [Fraction(1, 2)] * 6
    steps = exact.derivation([str(x) for x in middle]).derivation
    assert steps.exact is True and steps.factors[0].value.exact == "0"
    typed = equipod.Design.from_arrays(exact.joints.base, exact.joints.platform, PAIRS)
    assert "sqrt" not in typed.dumps()
    # decimals, numpy texts and large integers
    for third in (Decimal("0.1"), "1/10", Fraction(1, 10)):
        made = equipod.Design.from_arrays([[0, 0, third], [12, 0, 0], [6, 10, 0]], TRIANGLES[1], PAIRS)
        assert made.joints.base[0, 2] == 0.1 and ('"0.1"' in made.dumps() or '"1/10"' in made.dumps())
    words = equipod.Design.from_arrays(np.array([["0", "0", "0"], ["12", "0", "0"], ["6", "9", "0"]]), TRIANGLES[1], PAIRS)
    assert np.array_equal(words.joints.base, [[0, 0, 0], [12, 0, 0], [6, 9, 0]])
    assert pickle.loads(pickle.dumps(exact)) == exact


def test_texts_that_are_no_coordinates_are_refused_without_places_of_a_text_nobody_wrote():
    base, platform = TRIANGLES
    for wrong, word in (("6*root(3)", "root"), ("inch", "inch"), ("", "missing"), ("1/0", "zero")):
        with pytest.raises(equipod.DesignError, match=word) as caught:
            equipod.Design.from_arrays([[0, 0, wrong], *base[1:]], platform, PAIRS)
        assert caught.value.line is None and "A1" in str(caught.value)
    for shape in ([["0", 0]], [["0", 0, 0], [1, 2]], "0"):
        with pytest.raises(equipod.DesignError) as caught:
            equipod.Design.from_arrays(shape, platform, PAIRS)
        assert caught.value.code == "shape"
    with pytest.raises(equipod.DesignError, match="legs"):
        equipod.Design.from_arrays(base, platform, [(0, 3), *PAIRS[1:]])
    with pytest.raises(equipod.DesignError, match="finite"):
        equipod.Design.from_arrays([["0", 0, float("nan")], *base[1:]], platform, PAIRS)


def test_tables_are_read_and_replaced():
    design = equipod.Design.load(DESIGNS / "worked/bench-joint-free.toml")
    assert design.hardware["leg_length"] == design.to_dict()["hardware"]["leg_length"]
    assert design.workspace and set(design.requirements) >= {"hardware"} and "workspace" not in design.requirements
    # what is read is a copy
    design.hardware["leg_length"] = None
    assert design.hardware["leg_length"] is not None
    low, high = design.hardware["leg_length"]
    wide = design.replace(hardware={**design.hardware, "leg_length": np.array([low - 1, high + 1])}, name="wide")
    assert wide.name == "wide" and wide.hardware["leg_length"] == [low - 1, high + 1]
    narrow, wider = (d.margins(d.home).least["min_leg_length"] for d in (design, wide))
    assert wider == pytest.approx(narrow + 1)
    assert wide.replace(hardware=design.hardware, name=design.name) == design
    plain = equipod.Design.load(DESIGNS / "rbt-octahedral.toml")
    assert plain.hardware == {} and plain.requirements == {"min_joint_distance": 1.2} and "translation" in plain.workspace
    given = plain.replace(lengths=np.arange(16.0, 22.0))
    assert np.array_equal(given.lengths, np.arange(16.0, 22.0)) and given.replace(lengths=None).lengths is None
    for wrong in ({"hardwear": {}}, {"units": 3}, {"lengths": [1, 2]}, {"hardware": {"leg_length": [3, "x"]}}):
        with pytest.raises(equipod.DesignError) as caught:
            plain.replace(**wrong)
        assert caught.value.line is None and caught.value.code.startswith("design::")


def test_home_and_joints_are_replaced(octahedral):
    home = equipod.pose([1, 2, 17], rpy=[3, 4, 5], degrees=True)
    for moved in (octahedral.with_home(home), octahedral.replace(home=home)):
        assert np.allclose(moved.home, home, atol=1e-12) and moved.joints.base_names == octahedral.joints.base_names
    assert not np.allclose(octahedral.home, home)
    for wrong in (np.stack([home, home]), np.eye(3), 2 * home):
        with pytest.raises(equipod.DesignError):
            octahedral.with_home(wrong)
    # three numbers keep the comments of the text
    text = octahedral.dumps()
    assert "#" in text
    moved = octahedral.with_joint("P1", [0.5, 0, 0])
    assert np.array_equal(moved.joints.base[0], [0.5, 0, 0]) and "#" in moved.dumps()
    exact = octahedral.with_joint("P1", ["1/3", Fraction(1, 7), 0])
    assert np.array_equal(exact.joints.base[0], [1 / 3, 1 / 7, 0]) and '"1/7"' in exact.dumps()
    free = octahedral.equivalent(["1/5"] * 6).design
    index = free.joints.base_names.index("Q1")
    on = free.with_joint("base.Q1", {"on": ["P2", "P1"], "t": Fraction(1, 3)})
    ends = [octahedral.joints.base[octahedral.joints.base_names.index(name)] for name in ("P2", "P1")]
    assert np.allclose(on.joints.base[index], ends[0] + (ends[1] - ends[0]) / 3) and '"1/3"' in on.dumps()
    for name, place in (("P9", [0, 0, 0]), ("P9", ["0", 0, 0]), ("P1", [0, 0]), ("P1", {"on": ["P1", "P2"], "t": 1})):
        with pytest.raises(equipod.DesignError):
            octahedral.with_joint(name, place)


def test_batches_take_any_shape_and_options(octahedral):
    rng = np.random.default_rng(1)
    poses = equipod.pose(octahedral.home[:3, 3] + rng.uniform(-1, 1, (2, 3, 3)))
    lengths = octahedral.ik(poses)
    assert lengths.shape == (2, 3, 6)
    batch = octahedral.fk_batch(lengths)
    flat = octahedral.fk_batch(lengths.reshape(6, 6))
    assert batch.shape == (2, 3) and len(batch) == 6 and flat.shape == (6,)
    assert np.array_equal(batch.T, flat.T) and np.array_equal(batch[1, 2].T, flat[5].T) and np.array_equal(batch[-1, 0].T, flat[3].T)
    row = flat[5]
    assert batch.transforms is batch.T and row.transforms is row.T
    for wrong in ((2, 0), (0, 3), (0,), (0, 0, 0)):
        with pytest.raises(IndexError):
            batch[wrong]
    with pytest.raises(equipod.DesignError):
        octahedral.fk_batch(lengths[0, 0])
    # methods and seeds are those of fk
    by = octahedral.fk_batch(lengths, method="homotopy", seed=3)
    one = octahedral.fk(lengths[1, 1], method="homotopy", seed=3)
    assert one.method == "homotopy" and len(by[1, 1]) == len(one) and not np.array_equal(by.T, batch.T)
    assert np.allclose(np.sort(abs(by[1, 1].T[:, 0, 3])), np.sort(abs(one.T[:, 0, 3])), rtol=1e-9)
    with pytest.raises(equipod.DesignError):
        octahedral.fk_batch(lengths, method="magic")
    # the tracker walks through all leading axes
    track = octahedral.tracker(poses[0, 0]).follow(lengths)
    assert track.status == "tracked" and np.allclose(track.transforms, poses.reshape(6, 4, 4), atol=1e-9)
    assert track.rows.tolist() == list(range(6)) and track.skipped == ()


def test_real_batches_are_compact_and_say_what_is_undecided(octahedral):
    rng = np.random.default_rng(2)
    lengths = octahedral.ik(equipod.pose(octahedral.home[:3, 3] + rng.uniform(-1, 1, (30, 3))))
    lengths[4] = np.nan
    whole, real = octahedral.fk_batch(lengths), octahedral.fk_batch(lengths, real_only=True)
    assert real.T.dtype == np.float64 and real.T.nbytes <= whole.T.nbytes / 2
    assert np.array_equal(real.T, whole.T[whole.real].real) and real.real.all()
    assert np.array_equal(real.counts(), whole.counts(real=True)) and np.array_equal(real.completeness, whole.completeness)
    assert real.undecided.tolist() == [int((row.reality == -1).sum()) for row in whole]
    assert np.array_equal(real[3].real_transforms, real[3].T) and real.failed.tolist() == [4]
    columns = real.to_arrow().column_names
    assert "x" in columns and "r33" in columns and not any(name.endswith("_im") for name in columns)


def test_poses_are_counted_where_that_is_wanted():
    design = equipod.Design.load(FIXTURES / "verdicts" / "borel-bricard.toml")
    lengths = design.ik(design.home)
    counted, plain = design.fk(lengths), design.fk(lengths, pose_count=False)
    assert (counted.completeness, plain.completeness) == ("modular", "unproved")
    assert pickle.loads(pickle.dumps(plain)).completeness == "unproved"
    # a batch is prepared anew where the options are others
    for pose_count, word in ((False, "unproved"), (True, "modular"), (False, "unproved")):
        assert design.fk_batch([lengths], pose_count=pose_count)[0].completeness == word


def test_a_log_with_bad_rows_is_followed_to_its_end(octahedral):
    way = np.linspace(0, 1, 40)
    poses = equipod.pose(octahedral.home[:3, 3] + way[:, None] * [0.5, 0.2, 1.0])
    lengths = octahedral.ik(poses)
    lengths[7] = np.nan
    lengths[12, 3] = -1.0
    lengths[20] = [1.0, 100.0, 1.0, 100.0, 1.0, 100.0]
    with pytest.raises(equipod.DesignError):
        octahedral.tracker(poses[0]).follow(lengths)
    track = octahedral.tracker(poses[0]).follow(lengths, skip=True)
    left_out = [7, 12, 20]
    reached = [k for k in range(40) if k not in left_out]
    assert track.rows.tolist() == reached and np.allclose(track.T, poses[reached], atol=1e-9)
    assert [row.row for row in track.skipped] == left_out and track.status == "tracked"
    assert [row.status for row in track.skipped[:2]] == ["refused", "refused"] and track.skipped[2].status in ("lost", "near_singularity")
    assert "length" in track.skipped[0].reason and 0 <= track.skipped[2].fraction < 1
    # where it stopped without skipping, and what the last row says
    stopped = octahedral.tracker(poses[0]).follow(lengths[13:])
    assert stopped.rows.tolist() == list(range(7)) and stopped.status == track.skipped[2].status and stopped.skipped == ()
    assert octahedral.tracker(poses[0]).follow(lengths[:8], skip=True).status == "refused"
    tracker = octahedral.tracker(poses[0])
    assert np.array_equal(tracker.transform, tracker.T)


def test_polynomials_are_those_of_the_program(octahedral):
    file = str(DESIGNS / "rbt-octahedral.toml")
    lengths = octahedral.ik(octahedral.home)
    given = ",".join(map(repr, lengths.tolist()))
    found = octahedral.fk(lengths)
    joints = octahedral.joints
    taken = {tuple(pair) for pair in joints.legs.tolist()}
    a, b = next((a, b) for a in range(3) for b in range(3) if (a, b) not in taken)
    names = joints.base_names[a], joints.platform_names[b]
    closure = found.closure(*names)
    assert closure.to_dict() == ask(["fk", file, "--lengths", given, "--between", ",".join(names)])["closure"]
    polynomial = found.rotation_polynomial()
    assert polynomial.to_dict() == ask(["fk", file, "--lengths", given, "--polynomial"])["polynomial"]
    general = equipod.Design.load(DESIGNS / "dietmaier.toml")
    forty = general.fk(general.lengths).rotation_polynomial()
    assert forty.degree == 40 and len(forty.real_roots) == 40
    with pytest.raises(equipod.DesignError, match="joint"):
        found.closure("nowhere", names[1])
    head = equipod.Design.preset("reachy-mini")
    with pytest.raises(equipod.DesignError):
        head.fk(head.ik(head.home)).rotation_polynomial()


def test_five_legs_are_asked_as_by_the_program(tmp_path):
    legs = equipod.Pentapod.load(PENTAPOD)

    def own(answer, *words):
        mine, program = answer.to_dict(), ask([*words, "--seed", "1"])
        for document in (mine, program):
            document.pop("warnings"), document.pop("provenance")
        return mine == program

    assert own(legs.check(), "check", str(PENTAPOD))
    assert own(legs.fk(), "fk", str(PENTAPOD))
    answer = legs.fk()
    assert answer.poses.counted == 8 and answer.poses.real == 4 and answer.line.singular_poses.degree == 3
    # each real pose of the line has the lengths that were given
    body = answer.line.body
    fixed = legs.base_ends if body == "platform" else legs.platform_ends
    marks = np.array([float(x) for x in answer.line.marks]) * float(answer.line.length)
    for pose in answer.poses.poses:
        if pose.real:
            place, along = np.array(pose.position.re), np.array(pose.direction.re)
            ends = place + marks[:, None] * along
            assert np.allclose(np.linalg.norm(ends - fixed, axis=1), legs.lengths, atol=1e-9)
    again = equipod.Pentapod.from_arrays(legs.base_ends, legs.platform_ends, lengths=legs.lengths, name=legs.name, units=legs.units)
    assert again.fk().poses.counted == 8 and pickle.loads(pickle.dumps(legs)) == legs and legs != again.name
    assert len(legs.leg_names) == 5 and "table" in legs.check()._repr_html_()
    exact = equipod.Pentapod.from_arrays([["0", 0, 0], [4, 0, 0], [6, 3, 0], [3, 6, 0], [-1, 5, 0]], [[Fraction(k, 3), 0, 0] for k in (0, 1, 3, 4, 6)])
    assert exact.check().architecturally_singular is False and exact.check().rounded_joints is False
    curve = equipod.Pentapod.from_arrays(legs.base_ends, np.eye(5, 3) + 1)
    for wrong in (
        lambda: equipod.Pentapod.load(DESIGNS / "rbt-octahedral.toml"),
        lambda: equipod.Pentapod.loads("name = 'x'"),
        lambda: legs.fk([1, 2, 3]),
        lambda: legs.fk([1, 2, 3, 4, -5]),
        lambda: exact.fk(),
        lambda: curve.fk([1, 1, 1, 1, 1]),
        lambda: equipod.Pentapod.from_arrays(legs.base_ends[:4], legs.platform_ends[:4]),
    ):
        with pytest.raises(equipod.DesignError):
            wrong()


def test_a_notebook_shows_a_design_by_a_short_table(octahedral):
    shown = octahedral._repr_html_()
    assert len(shown) < 5000 and shown.count("<tr>") == 7 and "iframe" not in shown and ".view()" in shown
    length = octahedral.ik(octahedral.home)[0]
    assert f"<td>{length:.6g}</td>" in shown
    hostile = octahedral.replace(name="<script>alert(1)</script>")
    assert "<script>" not in hostile._repr_html_()
    assert "angle at home" in equipod.Design.preset("reachy-mini")._repr_html_()


def test_words_are_those_that_the_program_takes(octahedral):
    def choices(*words):
        """The suggestions for a misspelt value of an option, or a misspelt command."""
        done = subprocess.run([sys.executable, "-m", "equipod", *words], capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    lengths = octahedral.ik(octahedral.home)
    for method in get_args(_words.Method):
        try:
            assert octahedral.fk(lengths, method=method).method == method
        except equipod.DesignError as refused:
            assert refused.code != "unknown_name"
    named = choices("fk", "--help")
    assert all(method in named for method in get_args(_words.Method))
    formats = set()
    for word in get_args(_words.ExportFormat):
        try:
            octahedral.export(word)
        except equipod.DesignError as refused:
            assert refused.code != "unknown_name", word
        formats.add(word)
    with pytest.raises(equipod.DesignError) as caught:
        octahedral.export("paper")
    assert formats <= set(str(caught.value).replace(",", " ").replace("`", " ").split()) and len(formats) == 10
    figures = choices("plot", "--help")
    assert all(f"  plot {name} " in figures for name in get_args(_words.FigureName))


def test_docstrings_have_parameters_shapes_and_errors():
    """Every public method with an argument says what the argument is."""
    folder = pathlib.Path(equipod.__file__).parent
    missing = []
    for name in ("_design.py", "_pentapod.py", "_solutions.py"):
        for kind in ast.parse((folder / name).read_text()).body:
            if not isinstance(kind, ast.ClassDef) or kind.name.startswith("_"):
                continue
            for method in kind.body:
                if not isinstance(method, ast.FunctionDef) or method.name.startswith("_"):
                    continue
                arguments = [a.arg for a in method.args.args[1:] + method.args.kwonlyargs]
                text = ast.get_docstring(method) or ""
                if not text or (len(arguments) > 1 and "Parameters\n---" not in text and "``" not in text):
                    missing.append(f"{kind.name}.{method.name}")
    assert not missing

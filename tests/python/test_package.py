"""The installed package: arrays in and out, evidence, errors, long work."""

import copy
import json
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

from scipy.spatial import transform as spatial

import equipod

DESIGNS = pathlib.Path(__file__).parents[2] / "designs"
FIXTURES = pathlib.Path(__file__).parents[1] / "fixtures"


@pytest.fixture(scope="module")
def octahedral():
    return equipod.Design.load(DESIGNS / "rbt-octahedral.toml")


def rotations(rng, n):
    return equipod.pose(np.zeros((n, 3)), rpy=rng.uniform(-0.3, 0.3, (n, 3)))[:, :3, :3]


def poses_about(design, rng, n):
    home = design.home
    size = np.linalg.norm(home[:3, 3])
    return equipod.pose(home[:3, 3] + rng.uniform(-0.1, 0.1, (n, 3)) * size, rotation=rotations(rng, n))


def test_the_package_is_the_installed_one():
    sources = pathlib.Path(__file__).parents[2] / "src"
    assert sources not in pathlib.Path(equipod.__file__).parents


def test_lengths_are_those_of_numpy_whatever_the_batch(octahedral):
    poses = poses_about(octahedral, np.random.default_rng(1), 12)
    joints = octahedral.joints
    tips = np.einsum("nij,kj->nki", poses[:, :3, :3], joints.platform_ends) + poses[:, None, :3, 3]
    expected = np.linalg.norm(tips - joints.base_ends, axis=2)
    assert np.allclose(octahedral.ik(poses), expected, rtol=1e-14)
    assert octahedral.ik(poses.reshape(3, 4, 4, 4)).shape == (3, 4, 6)
    assert octahedral.ik(poses[0]).shape == (6,)
    assert octahedral.ik(poses[:0]).shape == (0, 6)
    # strided and other types are taken too
    assert np.array_equal(octahedral.ik(poses[::2]), octahedral.ik(poses)[::2])
    assert np.allclose(octahedral.ik(np.asfortranarray(poses)), expected)
    assert octahedral.ik(np.eye(4).tolist()).shape == (6,)


def test_the_jacobian_is_the_derivative_of_the_lengths(octahedral):
    pose = poses_about(octahedral, np.random.default_rng(2), 1)[0]
    j = octahedral.jacobian(pose)
    h = 1e-6
    for k in range(6):
        step = np.zeros(6)
        step[k] = h
        turn = np.array([[0, -step[5], step[4]], [step[5], 0, -step[3]], [-step[4], step[3], 0]])
        q, _ = np.linalg.qr(np.eye(3) + turn)
        q = q * np.sign(np.diag(q))
        moved = equipod.pose(pose[:3, 3] + step[:3], rotation=q @ pose[:3, :3])
        slope = (octahedral.ik(moved) - octahedral.ik(pose)) / h
        assert np.allclose(slope, j[:, k], atol=1e-4)
    length = 3.0
    assert np.allclose(octahedral.jacobian(pose, characteristic_length=length)[:, 3:] * length, j[:, 3:])


def test_all_poses_are_found_with_certificates(octahedral):
    pose = poses_about(octahedral, np.random.default_rng(3), 1)[0]
    found = octahedral.fk(octahedral.ik(pose))
    assert (len(found), found.complete, found.completeness) == (16, True, "proved")
    assert found.T.dtype == np.complex128 and found.T.shape == (16, 4, 4)
    assert found.certified.all() and (found.residual < 1e-10).all()
    near = found.nearest(pose)
    assert near is not None and near.real is True and np.allclose(near.transform, pose, atol=1e-9)
    # sequence and arrays say the same, real ones first
    assert [s.real for s in found] == [bool(x) for x in found.real]
    assert found[-1].T.shape == (4, 4) and len(found[2:5]) == 3
    # each complex pose satisfies the leg equations
    joints = octahedral.joints
    tips = np.einsum("nij,kj->nki", found.T[:, :3, :3], joints.platform_ends.astype(complex)) + found.T[:, None, :3, 3]
    squares = ((tips - joints.base_ends) ** 2).sum(axis=2)
    assert np.allclose(squares, octahedral.ik(pose) ** 2)
    record = found.record
    assert record.finite_count == 16 and record.solutions[0].certificate.kind in ("octahedral", "study")
    assert found.to_dict()["finite_count"] == 16
    with pytest.raises(equipod.DesignError):
        next(s for s in found if s.real is False).transform


def test_batches_are_the_single_answers_and_do_not_depend_on_threads(octahedral):
    rng = np.random.default_rng(4)
    lengths = octahedral.ik(poses_about(octahedral, rng, 40))
    lengths[7] = 1e-3  # no real pose, sixteen complex ones or none
    one, two = (octahedral.fk_batch(lengths, threads=n) for n in (1, 2))
    assert np.array_equal(one.offsets, two.offsets) and np.array_equal(one.T, two.T)
    assert one.offsets[0] == 0 and one.offsets[-1] == len(one.T) and len(one) == 40
    for k in (0, 7, 39):
        single = octahedral.fk(lengths[k])
        assert len(one[k]) == len(single) and one[k].complete == single.complete
        assert np.isclose(np.sort(abs(one[k].T[:, 0, 3])), np.sort(abs(single.T[:, 0, 3])), rtol=1e-6).all()
    assert np.array_equal(one.counts(), np.diff(one.offsets))
    assert one.counts(real=True).sum() == one.real.sum()
    bad = lengths.copy()
    bad[3, 2] = -1.0
    bad[5, 0] = np.nan
    part = octahedral.fk_batch(bad)
    assert part.failed.tolist() == [3, 5] and "length" in part.reason(3)
    assert len(part[3]) == 0 and len(part[4]) == 16


def test_arrays_are_taken_as_they_stand_or_made_first(octahedral):
    rng = np.random.default_rng(6)
    poses = poses_about(octahedral, rng, 6)
    lengths, rows = octahedral.ik(poses), octahedral.jacobian(poses, characteristic_length=2.0)
    assert lengths.shape == (6, 6) and rows.shape == (6, 6, 6)
    assert octahedral.ik(poses[0]).shape == (6,) and octahedral.jacobian(poses[0]).shape == (6, 6)
    folded = poses.reshape(2, 3, 4, 4)
    assert np.array_equal(octahedral.ik(folded), lengths.reshape(2, 3, 6))
    assert np.array_equal(octahedral.jacobian(folded, characteristic_length=2.0), rows.reshape(2, 3, 6, 6))
    wide = np.zeros((6, 4, 8))
    wide[:, :, ::2] = poses
    columns = np.asfortranarray(poses)
    for other in (wide[:, :, ::2], columns, poses.tolist(), poses.astype(">f8")):
        assert np.array_equal(octahedral.ik(other), lengths)
        assert np.array_equal(octahedral.jacobian(other, characteristic_length=2.0), rows)
    assert octahedral.ik(np.empty((0, 4, 4))).shape == (0, 6)
    tracks = [octahedral.tracker(poses[0]).step(form(lengths[1])) for form in (np.array, list, tuple, lambda l: np.repeat(l, 2)[::2])]
    assert all(np.array_equal(track.T, tracks[0].T) and track.status == tracks[0].status for track in tracks)
    for wrong in (lengths[:2], lengths[0][:5], 3.0):
        with pytest.raises(equipod.DesignError):
            octahedral.tracker(poses[0]).step(wrong)
    for wrong in (poses[0][:3], np.full((4, 4), np.nan), poses[0].astype(complex)):
        with pytest.raises(equipod.DesignError):
            octahedral.ik(wrong)


def test_a_tracker_keeps_its_mode_and_stops_at_singularities(octahedral):
    rng = np.random.default_rng(5)
    ends = poses_about(octahedral, rng, 2)
    t = np.linspace(0, 1, 50)[:, None]
    path = equipod.pose((1 - t) * ends[0, :3, 3] + t * ends[1, :3, 3], rotation=ends[0, :3, :3])
    lengths = octahedral.ik(path)
    tracker = octahedral.tracker(path[0])
    track = tracker.follow(lengths)
    assert track.status == "tracked" and np.allclose(track.T, path, atol=1e-9)
    assert np.array_equal(tracker.T, track.T[-1])
    assert track.frobenius_ratio.shape == (len(track.T),) and np.all((track.frobenius_ratio > 0) & (track.frobenius_ratio <= 1))
    one = octahedral.tracker(path[0])
    for row in lengths:
        assert one.step(row).status == "tracked"
    assert np.allclose(one.T, tracker.T, atol=1e-12)
    # lengths that no pose has: the tracker stays
    lost = tracker.step([1.0, 100.0, 1.0, 100.0, 1.0, 100.0])
    assert lost.status != "tracked" and 0 <= lost.fraction < 1
    assert np.array_equal(tracker.T, track.T[-1])


def test_equal_designs_hash_equally(octahedral):
    again = equipod.Design.loads(octahedral.dumps())
    assert again == octahedral and hash(again) == hash(octahedral) and len({again, octahedral}) == 1
    other = equipod.Design.load(DESIGNS / "general-6-6.toml")
    assert other != octahedral and len({other, octahedral}) == 2


def test_trackers_and_solutions_are_copied_and_pickled(octahedral):
    tracker = octahedral.tracker()
    start, lengths = tracker.T, octahedral.ik(octahedral.home)
    for twin in (copy.copy(tracker), copy.deepcopy(tracker), pickle.loads(pickle.dumps(tracker))):
        assert np.allclose(twin.T, start, atol=1e-12)
        assert twin.step(lengths * 1.01).status == "tracked"
        assert np.array_equal(tracker.T, start) and not np.allclose(twin.T, start)
    found = octahedral.fk(lengths, seed=3)
    again = pickle.loads(pickle.dumps(found))
    # all but the hash of the file, whose text is another one after the way through pickle
    first, second = ({**answer.record.to_dict(), "provenance": None} for answer in (found, again))
    assert np.array_equal(again.T, found.T) and first == second


def test_numbers_that_cannot_be_are_refused_by_name(octahedral):
    lengths = octahedral.ik(octahedral.home)
    for wrong, code in [
        (lambda: octahedral.fk(lengths, seed=-1), "seed"),
        (lambda: octahedral.check(seed=1.5), "seed"),
        (lambda: octahedral.assess(points=-1), "points"),
        (lambda: octahedral.fk_batch(lengths[None], threads=-1), "threads"),
        (lambda: octahedral.fk_batch(lengths[None], threads=0), "threads"),
        (lambda: octahedral.fk(lengths + 1j), "lengths"),
        (lambda: octahedral.fk(["long"] * 6), "lengths"),
        (lambda: equipod.verify(octahedral, octahedral, seed=2**64), "seed"),
    ]:
        with pytest.raises(equipod.DesignError) as refused:
            wrong()
        assert refused.value.code == code, refused.value


def test_an_equivalent_says_whether_it_is_singular(octahedral):
    assert octahedral.equivalent([0.2, 0.3, 0.2, 0.3, 0.2, 0.3]).singular is False
    assert octahedral.equivalent([0.5] * 6).singular is True
    # decimals are taken as they are written: 0.7 is 1 - 0.3
    assert octahedral.equivalent([0.3, 0.7] * 3).singular is True


def test_a_self_motion_is_seen_in_the_solutions(octahedral):
    assert octahedral.fk(octahedral.ik(octahedral.home)).self_motion == 0
    moving = equipod.Design.load(FIXTURES / "verdicts" / "shares-30-70.toml")
    found = moving.fk(moving.ik(moving.home))
    assert found.self_motion == 1 and found.record.solution_set == "positive_dimensional"


def test_forms_of_poses_agree_with_scipy():
    rng = np.random.default_rng(6)
    r = spatial.Rotation.random(50, random_state=7)
    p = rng.normal(size=(50, 3))
    given = equipod.pose(p, rotation=r)
    assert np.allclose(equipod.pose(p, quat=r.as_quat(), scalar_first=False), given)
    rpy = equipod.rpy(given)
    assert np.allclose(rpy, r.as_euler("ZYX")[:, ::-1])
    assert np.allclose(equipod.pose(p, rpy=rpy), given)
    q = equipod.quaternion(given, scalar_first=False)
    assert np.allclose(spatial.Rotation.from_quat(q).as_matrix(), r.as_matrix())
    assert (q[:, 3] >= 0).all()
    if hasattr(spatial, "RigidTransform"):
        rigid = spatial.RigidTransform.from_components(p[0], r[0])
        design = equipod.Design.preset("bench-l16")
        assert np.allclose(design.ik(rigid), design.ik(given[0]))


def test_conventions_agree_with_scipy_and_give_poses_back():
    rng = np.random.default_rng(8)
    home = equipod.pose([1.0, 2.0, 300.0], rpy=[0.1, -0.2, 0.3])
    axes = [a + b + c for a in "xyz" for b in "xyz" for c in "xyz" if a != b != c]
    for order in axes:
        for frame, letters in (("fixed", order), ("moving", order.upper())):
            frames = equipod.Frames(rotation_order=f"{frame}-{order}")
            numbers = np.concatenate([rng.normal(size=(20, 3)), rng.uniform(-180, 180, (20, 3))], axis=-1)
            poses = frames.poses(numbers)
            expected = spatial.Rotation.from_euler(letters, numbers[:, 3:], degrees=True).as_matrix()
            assert np.allclose(poses[:, :3, :3], expected, atol=1e-14), frames
            own = equipod.Frames(
                rotation_order=f"{frame}-{order}", angles="rad", quaternion="xyzw", pivot=(1.0, 2.0, 3.0), relative_to="home", up="y"
            )
            for form in ("angles", "quaternion"):
                again = own.poses(own.numbers(poses, home=home, form=form), home=home)
                assert np.allclose(again, poses, atol=1e-12), (own, form)
    vectors = equipod.Frames(rotation_order="vector", angles="rad")
    numbers = np.concatenate([np.zeros((20, 3)), rng.normal(size=(20, 3))], axis=-1)
    assert np.allclose(vectors.poses(numbers)[:, :3, :3], spatial.Rotation.from_rotvec(numbers[:, 3:]).as_matrix())
    assert not equipod.Frames().angles_unique(equipod.pose(rpy=[0, 90, 0], degrees=True))
    for bad in (equipod.Frames(rotation_order="xyz"), equipod.Frames(up="x")):
        with pytest.raises(equipod.DesignError):
            bad.poses(np.zeros(6))
    with pytest.raises(equipod.DesignError):
        equipod.Frames(relative_to="home").poses(np.zeros(6))


def test_a_design_has_its_own_convention_and_commands_take_matrices_all_the_same():
    text = (DESIGNS / "presets" / "bench-l16.toml").read_text(encoding="utf-8")
    table = '[frames]\nrotation_order = "pi"\npivot = [0.0, 0.0, 40.0]\nrelative_to = "home"\nup = "y"\n'
    design, plain = equipod.Design.loads(text + "\n" + table), equipod.Design.loads(text)
    assert design.frames == equipod.Frames(rotation_order="moving-xyz", pivot=(0.0, 0.0, 40.0), relative_to="home", up="y")
    assert plain.frames == equipod.Frames()
    assert np.allclose(design.poses(np.zeros(6)), design.home)
    pose = design.home.copy()
    pose[2, 3] += 5.0
    assert np.allclose(design.pose_numbers(pose), [0, 5, 0, 0, 0, 0], atol=1e-12)
    own, usual = design.limits(pose), plain.limits(pose)
    assert own.pose == usual.pose and own.in_frames != usual.in_frames
    found = design.at(pose, wrench=[0, 0, -10, 0, 0, 0], axes="platform", leg=2, nearest_singular=True)
    assert found.stuck.leg == 2 and found.nearest_singular.distance > 0
    # the wrench has the axes of the convention, in which y is up and z is our -y, and is about its pivot
    same = plain.at(pose, wrench=[0, 10, 0, 0, 0, 0], point=[0, -40, 0])
    assert np.allclose(found.held[-1].forces, same.held[-1].forces, atol=1e-9)
    forces = np.array(plain.at(pose, wrench=[0, 10, 0, 0, 0, 0]).held[-1].forces)
    back = plain.at(pose, forces=forces).wrench
    assert np.allclose(back.force, [0, 10, 0], atol=1e-9) and np.allclose(back.torque, 0, atol=1e-6)
    with pytest.raises(equipod.DesignError):
        plain.at(pose, wrench=[1, 2, 3])


def test_bad_input_is_refused_with_code_place_and_help(octahedral):
    with pytest.raises(equipod.DesignError) as caught:
        equipod.Design.loads("name = 'slip'\nunit = 'mm'\n")
    error = caught.value
    assert isinstance(error, ValueError) and error.code == "design::unknown_key" or error.faults
    assert any(f.code == "design::unknown_key" and f.line == 2 for f in error.faults)
    assert any("units" in f.help + f.message for f in error.faults)
    for poses in (np.zeros((4, 4)), np.ones((3, 3)), np.eye(4) * 2, np.full((4, 4), np.nan), np.zeros((2, 4, 5))):
        with pytest.raises(equipod.DesignError):
            octahedral.ik(poses)
    with pytest.raises(equipod.DesignError):
        octahedral.ik(octahedral.fk(octahedral.ik(octahedral.home)).T)
    for lengths in ([1, 2, 3], [[18.0] * 6], [-1.0] * 6, [np.inf] * 6):
        with pytest.raises(equipod.DesignError):
            octahedral.fk(lengths)
    with pytest.raises(equipod.DesignError):
        octahedral.fk([18.0] * 6, method="magic")
    with pytest.raises(equipod.DesignError, match="preset"):
        equipod.Design.preset("nothing")
    with pytest.raises(equipod.DesignError):
        equipod.pose([0, 0, 0], rpy=[0, 0, 0], quat=[1, 0, 0, 0])
    with pytest.raises(OSError):
        equipod.Design.load("no-such-file.toml")
    with pytest.raises(equipod.DesignError):
        octahedral.fk_batch(np.ones((2, 6)), threads=0)
    hexapod = equipod.Design.load(DESIGNS / "symmetric-hexapod.toml")
    with pytest.raises(equipod.DesignError) as caught:
        hexapod.equivalent([0.2] * 6)
    assert caught.value.code == "not_octahedral"


def test_the_pose_of_the_machine_is_marked():
    design = equipod.Design.preset("bench-l16")
    found = design.fk(design.ik(design.home))
    assert np.allclose(found[found.nearest_home].transform, design.home, atol=1e-6)
    assert found._repr_html_().count("nearest to home") == 1


def test_rings_of_decimals_are_snapped():
    def ring(radius, degrees):
        turn = np.radians(degrees)
        return np.round(np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn], axis=1), 6)

    base, platform = ring(500, [-10, 10, 110, 130, 230, 250]), ring(300, [-50, 50, 70, 170, 190, 290])
    typed = equipod.Design.from_arrays(base, platform)
    assert len(typed.symmetry) == 3 and "turned by a third" in typed.symmetry[0] and "times 0.6" in typed.symmetry[2]
    snapped = equipod.Design.from_arrays(base, platform, snap=True)
    assert snapped == typed.snapped() and snapped.symmetry == [] and snapped.snapped() is snapped
    assert "turn" in snapped.dumps() and np.allclose(snapped.joints.base, base, atol=1e-5)


def test_designs_from_arrays_texts_and_files(tmp_path, octahedral):
    joints = octahedral.joints
    made = equipod.Design.from_arrays(joints.base, joints.platform, joints.legs.tolist(), home=octahedral.home, name="own", units="m")
    assert (made.name, made.units) == ("own", "m") and np.allclose(made.home, octahedral.home)
    assert np.allclose(made.ik(made.home), octahedral.ik(octahedral.home))
    for form in ("toml", "json"):
        assert equipod.Design.loads(octahedral.dumps(form), form) == octahedral
    octahedral.save(tmp_path / "copy.toml")
    assert equipod.Design.load(tmp_path / "copy.toml") == octahedral
    with pytest.raises(FileExistsError):
        octahedral.save(tmp_path / "copy.toml")
    assert pickle.loads(pickle.dumps(octahedral)) == octahedral
    assert made != octahedral and "own" in repr(made)
    assert len(equipod.presets()) >= 6
    for name in equipod.presets():
        assert equipod.Design.preset(name).joints.legs.shape == (6, 2)


def test_an_equivalent_has_the_lengths_of_its_map_and_is_verified(octahedral):
    free = octahedral.equivalent([0.2, 0.21, 0.22, 0.2, 0.2, 0.23])
    assert len(free.design.joints.base) == 6 and len(free.design.joints.platform) == 6
    poses = poses_about(octahedral, np.random.default_rng(8), 20)
    squares = octahedral.ik(poses) ** 2 @ free.A.T + free.c
    assert np.allclose(np.sqrt(squares), free.design.ik(poses))
    found = equipod.leg_map(octahedral, free.design)
    assert np.allclose(found.A, free.A) and np.allclose(found.lengths(octahedral.ik(poses)), free.design.ik(poses))
    answer = equipod.verify(octahedral, free.design, samples=3)
    assert answer.verdict == "equivalent" and len(answer.samples) == 3
    other = equipod.Design.load(DESIGNS / "general-6-6.toml")
    assert equipod.verify(other, other, samples=1).verdict == "equivalent"
    unrelated = equipod.leg_map(equipod.Design.preset("bench-l16"), equipod.Design.preset("bench-l16"))
    assert unrelated.A is not None and np.allclose(unrelated.A, np.eye(6))


def test_the_class_of_an_octahedral_design_has_all_its_patterns(octahedral):
    family = octahedral.equivalents()
    assert (family.counts.patterns, len(family.patterns)) == (728, 728)
    free = [p for p in family.patterns if not p.shared_joints]
    assert [leg.kind for leg in free[0].legs] == ["inner"] * 6 and len(free) == 1
    with pytest.raises(equipod.DesignError):
        equipod.Design.load(DESIGNS / "general-6-6.toml").equivalents()
    steps = octahedral.derivation([0.2, "1/5", 0.2, 0.2, 0.2, 0.2]).derivation
    assert steps.moves[0].constant.exact == "-576/25" and steps.verification.verdict == "equivalent"


def test_limits_and_singular_poses_take_poses_as_matrices():
    design = equipod.Design.preset("bench-l16")
    pose = design.home.copy()
    pose[2, 3] += 3.0
    home, moved = design.limits(), design.limits(pose)
    assert home.axes != moved.axes
    assert design.limits(design.home).axes == home.axes
    # a second way to one number: what is free along x ends where the least margin is zero
    edge = design.home.copy()
    edge[0, 3] += home.axes[0].forth.free
    assert min(design.margins(edge).least.values()) == pytest.approx(0.0, abs=1e-9)
    assert design.singular_poses(options=["--box=1,1,1,1,1,1"]).regular.met is True
    with pytest.raises(equipod.DesignError, match="one pose"):
        design.limits(np.stack([pose, pose]))


def test_the_singularity_locus_is_one_polynomial_for_equivalent_platforms(octahedral):
    pose = "0,0,1,1,1/2,1/3,0"
    own = octahedral.singular_locus(pose).polynomial
    other = equipod.Design.load(DESIGNS / "rbt-griffis-duffy.toml").singular_locus(pose).polynomial
    assert own.degree == 3 and own.exponents == other.exponents and own.coefficients == other.coefficients
    turned = octahedral.singular_locus(about=[0, 0, 1]).polynomial
    assert list(turned.coefficients) == ["-1", "0", "1"] and turned.real_roots_by_sturm == 2


def test_answers_are_those_of_the_program(octahedral):
    """The same fields with the same values as `equipod --json`, but for how the design was handed over."""

    def program(*arguments):
        done = subprocess.run([sys.executable, "-m", "equipod", *map(str, arguments), "--json", "--quiet"], capture_output=True, text=True)
        document = json.loads(done.stdout)
        document.pop("provenance"), document.pop("warnings")
        return document

    def own(answer):
        document = answer.to_dict() if not isinstance(answer, dict) else answer
        document.pop("provenance"), document.pop("warnings")
        return document

    file = DESIGNS / "rbt-octahedral.toml"
    assert own(octahedral.check()) == program("check", file)
    worked = DESIGNS / "worked/bench-joint-free.toml"
    options = dict(points=200, searches=1, cells=300)
    flags = [x for k, v in options.items() for x in (f"--{k}", v)]
    assert own(equipod.Design.load(worked).assess(**options)) == program("assess", worked, *flags)
    griffis = DESIGNS / "rbt-griffis-duffy.toml"
    assert own(equipod.leg_map(octahedral, equipod.Design.load(griffis)).record) == program("equivalents", "map", file, griffis)
    assert own(equipod.verify(octahedral, equipod.Design.load(griffis), samples=2)) == program("verify", file, griffis, "--samples", 2)
    lengths = octahedral.ik(octahedral.home)
    given = program("fk", file, "--lengths", ",".join(map(repr, lengths.tolist())))
    assert own(octahedral.fk(lengths).to_dict()) == given


def test_margins_at_a_pose_are_signed_distances_to_limits():
    design = equipod.Design.load(DESIGNS / "worked/bench-joint-free.toml")
    margins = design.margins(design.home)
    assert margins.values.shape == (len(margins.names),) and set(margins.units)
    assert set(margins.least) <= set(margins.names)
    lengths = design.ik(design.home)
    short = [k for k, name in enumerate(margins.names) if name == "min_leg_length"]
    long = [k for k, name in enumerate(margins.names) if name == "max_leg_length"]
    total = margins.values[short] + margins.values[long]
    assert np.allclose(total, total[0]) and len(lengths) == len(short)
    batch = design.margins(np.stack([design.home] * 3))
    assert batch.values.shape == (3, len(margins.names))


def test_cranks_have_angles_in_place_of_lengths(tmp_path):
    head = equipod.Design.load(DESIGNS / "presets/reachy-mini.toml")
    assert head.drive == "rotary" and equipod.Design.preset("reachy-mini") == head
    assert equipod.Design.loads(head.dumps("json"), "json") == head and pickle.loads(pickle.dumps(head)) == head
    assert equipod.Design.load(DESIGNS / "rbt-octahedral.toml").drive == "prismatic"
    rng = np.random.default_rng(3)
    shifts = head.home[:3, 3] + rng.uniform(-8, 8, (6, 3))
    poses = equipod.pose(shifts, rpy=rng.uniform(-6, 6, (6, 3)), degrees=True)
    angles = head.ik(poses)
    # what the maker's own data give at home
    assert np.allclose(np.degrees(head.ik(head.home)), 35.898 * np.array([1, -1] * 3), atol=0.01)
    assert angles.shape == (6, 6) and head.ik(poses.reshape(2, 3, 4, 4)).shape == (2, 3, 6)
    assert np.array_equal(head.ik(poses.tolist()), angles)

    # both sides put the tip of the crank a rod away from the platform joint
    found = head.crank_angles(poses)
    assert np.array_equal(found.kept, angles) and np.all(found.limit_margin > 0)
    joints = head.joints
    tips = np.einsum("nij,kj->nki", poses[:, :3, :3], joints.platform_ends) + poses[:, None, :3, 3]
    turn = [equipod.pose(rpy=[0, 0, k * 120], degrees=True)[:3, :3] for k in (2, 2, 0, 0, 1, 1)]
    for side in (found.kept, found.other):
        for leg in range(6):
            sign = 1 if leg % 2 == 0 else -1
            zero, across = turn[leg] @ [0, sign, 0], turn[leg] @ [0, 0, sign]
            at = joints.base_ends[leg] + 40 * (np.cos(side[:, leg, None]) * zero + np.sin(side[:, leg, None]) * across)
            assert np.allclose(np.linalg.norm(tips[:, leg] - at, axis=1), 85.0, rtol=1e-12)
    assert np.all(np.sign(found.transmission) == np.array([1, -1] * 3))

    # the Jacobian is the derivative of the angles
    h = 1e-6
    rows = head.jacobian(poses[0])
    for k in range(3):
        ahead, behind = poses[0].copy(), poses[0].copy()
        ahead[k, 3] += h
        behind[k, 3] -= h
        assert np.allclose((head.ik(ahead) - head.ik(behind)) / (2 * h), rows[:, k], atol=1e-7)
    assert np.allclose(head.jacobian(poses[0], characteristic_length=10.0)[:, 3:] * 10.0, rows[:, 3:])

    solutions = head.fk(angles[0])
    assert solutions.certified.all() and np.allclose(solutions.nearest(poses[0]).transform, poses[0], atol=1e-8)
    record = solutions.record
    assert np.allclose(record.angles_deg, np.degrees(angles[0]))
    kept = [s.real_pose.elbow_kept for s in record.solutions if s.real_pose is not None]
    assert (True,) * 6 in kept
    batch = head.fk_batch(angles[:2])
    assert len(batch) == 2 and batch.counts()[0] == len(solutions) and np.array_equal(batch[0].T, solutions.T)
    tracker = head.tracker()
    track = tracker.follow(angles)
    assert track.status == "tracked" and np.allclose(track.T, poses, atol=1e-7)
    assert tracker.step(angles[0]).status == "tracked" and np.allclose(tracker.T, poses[0], atol=1e-7)

    # beyond reach
    far = head.home.copy()
    far[2, 3] += 100
    assert np.isnan(head.ik(far)).all() and np.isnan(head.jacobian(far)).all()
    assert np.isnan(head.crank_angles(far).other).all()
    for refused in (lambda: head.tracker(far), lambda: head.fk([np.nan] * 6)):
        with pytest.raises(equipod.DesignError):
            refused()

    margins = head.margins(poses)
    names = {"min_rod_length", "max_rod_length", "crank_transmission", "crank_angle", "crank_torque"}
    assert set(margins.least) == names and min(margins.least.values()) > 0
    left = margins.values[:, [k for k, name in enumerate(margins.names) if name == "crank_angle"]]
    assert np.allclose(left, np.degrees(found.limit_margin))
    answer = head.assess(points=50, searches=1, cells=250)
    assert {row.name for row in answer.requirements} == names and answer.met is not False
    assert "platform.xml" in head.export("mjcf")

    # what has no meaning for cranks says so
    octahedral = equipod.Design.load(DESIGNS / "rbt-octahedral.toml")
    for refused in (
        head.check,
        lambda: head.equivalent([0.2] * 6),
        lambda: equipod.leg_map(octahedral, head),
        lambda: equipod.verify(head, octahedral),
        lambda: octahedral.crank_angles(octahedral.home),
    ):
        with pytest.raises(equipod.DesignError) as caught:
            refused()
        assert caught.value.code in ("design::rotary", "no_cranks")


def test_limits_and_motions_of_cranks():
    head = equipod.Design.preset("reachy-mini")
    limits = head.limits()
    up = next(axis for axis in limits.axes if axis.axis == "z").forth
    assert limits.allowed and up.binds is not None and up.value > head.home[2, 3] + 10
    run = head.motion(sine=["z:8:1"]).motions[0]
    assert run.met and not run.legs and run.unreached_at_s is None
    times = np.linspace(0, 1, 361)
    poses = np.tile(head.home, (361, 1, 1))
    poses[:, 2, 3] += 8 * np.sin(2 * np.pi * times)
    angles = np.degrees(head.ik(poses))
    assert np.allclose([c.least_deg.value for c in run.cranks], angles.min(axis=0), atol=1e-9)
    assert np.allclose([c.greatest_deg.value for c in run.cranks], angles.max(axis=0), atol=1e-9)
    assert all(abs(c.torque.value) >= c.rms_torque > 0 for c in run.cranks)
    servos = equipod.compare([head], options=["--points", "20"]).designs[0]
    assert servos.name == head.name and servos.stroke is None and servos.cranks.least_deg < servos.cranks.greatest_deg


def test_long_work_answers_reports_and_can_be_interrupted(octahedral):
    lines = []
    best, answer = octahedral.optimize(progress=lines.append)
    assert best is not None and answer.status in ("optimal", "feasible")
    assert answer.search.method == "offsets" and answer.variables[0].start == 0
    assert equipod.verify(octahedral, best, samples=2).verdict == "equivalent"
    tolerances = octahedral.tolerances(0.1, 0.5, options=["--trials", "50", "--points", "20", "--searches", "0"])
    assert tolerances.units == octahedral.units and len(tolerances.joints) == 6
    with pytest.raises(equipod.DesignError):
        octahedral.optimize(extension=-1.0)


def test_the_drive_is_chosen_with_the_platform(tmp_path):
    table = tmp_path / "drives.csv"
    table.write_text("name,stroke,retracted_length,price_EUR\ntiny,0.1,14,10\ngood,9,9,30\n")
    text = (FIXTURES / "octahedral-12-6.toml").read_text()
    design = equipod.Design.loads(
        text
        + """[home]
position = [3.0, 1.7320508075688772, 12.0]
rpy_deg = [0.0, 0.0, 0.0]
[workspace]
translation = [0.5, 0.5, 0.5]
[optimize]
variables = ["symmetric_offsets", "home_height"]
"""
    )
    best, answer = design.optimize(drives=table)
    assert best is not None and answer.drive_search.chosen == "good"
    assert {drive.name: drive.outcome for drive in answer.drive_search.drives} == {"good": "met", "tiny": "infeasible"}
    assert "leg_length = [9.0, 18.0]" in best.dumps() and best.assess().met is True
    explored = design.explore(tmp_path / "explored", drives=table, options=["--samples", "1"])
    assert explored.drive_search.chosen == "good" and explored.assessment.met is True
    assert all(pathlib.Path(path).exists() for path in explored.paths)
    with pytest.raises(equipod.DesignError):
        design.optimize(drives=tmp_path / "missing.csv")


def test_a_machine_is_calibrated_from_poses_and_lengths():
    design = equipod.Design.load("designs/symmetric-hexapod.toml")
    rng = np.random.default_rng(4)
    shifts, turns = rng.uniform(-40, 40, (30, 3)), rng.uniform(-20, 20, (30, 3))
    poses = equipod.pose(design.home[:3, 3] + shifts, rpy=turns, degrees=True)
    shown = design.ik(poses) + np.arange(6.0)
    found = design.calibrate(poses, shown, options=["--next", "2"])
    assert found.record.outcome == "calibrated" and len(found.record.next_poses) == 2
    assert np.allclose([leg.offset for leg in found.record.calibration.offsets], np.arange(6.0), atol=1e-6)
    assert found.design is not None
    assert np.allclose(found.design.joints.base, design.joints.base, atol=1e-6)
    unseen = design.calibrate(poses[:5], shown[:5], sigma_length=0.01)
    assert unseen.design is None and unseen.record.outcome == "not_identifiable"
    with pytest.raises(equipod.DesignError):
        design.calibrate(poses[:4], shown)


def test_motions_and_designs_side_by_side():
    design = equipod.Design.load("designs/worked/simulator-octahedral.toml")
    times = np.linspace(0.0, 1.0, 11)
    poses = np.tile(design.home, (11, 1, 1))
    poses[:, 2, 3] += 0.02 * np.sin(2 * np.pi * times)
    answer = design.motion(times, poses, sine=["z:0.02:1"])
    trajectory, sine = answer.motions
    assert sine.motion == "sine z:0.02:1" and len(trajectory.legs) == len(sine.legs) == 6
    assert isinstance(answer.met, bool) and answer.length_unit == design.units == "m"
    with pytest.raises(equipod.DesignError):
        design.motion(times[:5], poses)
    with pytest.raises(equipod.DesignError):
        design.motion(times)
    with pytest.raises(equipod.DesignError):
        design.motion(sine=["sideways"])

    bench = [equipod.Design.load(f"designs/worked/bench-{kind}.toml") for kind in ("octahedral", "joint-free")]
    beside = equipod.compare(bench, options=["--points", "20"])
    assert [row.name for row in beside.designs] == [design.name for design in bench]
    assert equipod.table(beside.designs).num_rows == 2


def test_computations_release_the_interpreter_lock(octahedral):
    lengths = np.tile(octahedral.ik(octahedral.home), (20000, 1))
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    clock = threading.Thread(target=tick)
    clock.start()
    octahedral.fk_batch(lengths, threads=1)
    stop.set()
    clock.join()
    # a lock that was held through the computation would have let through a handful
    assert len(ticks) > 20


LONG = {
    "batch": "d.fk_batch(np.tile(d.ik(d.home), (2_000_000, 1)))",
    "follow": "d.tracker().follow(np.tile(d.ik(d.home), (20_000_000, 1)))",
    "assess": "equipod.Design.load(DESIGNS / 'worked' / 'simulator-300kg.toml').assess(cells=10_000_000)",
    "tolerances": "d.tolerances(0.1, 0.1, options=['--trials', '10000000'])",
}


def interrupted(code, seconds, times=1):
    """The output of a program after its line `go` and some interrupts."""
    start = (
        "import equipod, numpy as np, pathlib, signal\n"
        # a shell that starts the tests in the background has the signal ignored, and children inherit it
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"DESIGNS = pathlib.Path({str(DESIGNS)!r})\n"
        "d = equipod.Design.preset('linuxcnc-hexapod')\n"
    )
    child = subprocess.Popen([sys.executable, "-c", start + code], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "go\n"
    time.sleep(seconds)
    for _ in range(times):
        child.send_signal(signal.SIGINT)
        time.sleep(0.2)
    return child.communicate(timeout=120)[0]


def ended_by_interrupts(call, times=1):
    code = f"print('go', flush=True)\ntry:\n    {call}\nexcept KeyboardInterrupt:\n    print('interrupted', flush=True)\nimport os\nos._exit(0)\n"
    return interrupted(code, 0.5, times) == "interrupted\n"


@pytest.mark.parametrize("call", LONG.values(), ids=LONG.keys())
def test_an_interrupt_ends_what_takes_long(call):
    assert ended_by_interrupts(call)


def test_an_interrupt_gives_the_best_so_far_and_a_second_one_nothing(tmp_path):
    design = "equipod.Design.load(DESIGNS / 'worked' / 'simulator-300kg.toml')"
    said = interrupted(f"print('go', flush=True)\nbest, answer = {design}.optimize()\nprint(answer.status)\n", 1.0)
    assert said.strip() == "interrupted"
    assert ended_by_interrupts(f"{design}.explore({str(tmp_path / 'out')!r})", times=2)


def test_what_notebooks_show(octahedral, tmp_path):
    picture = octahedral.plot("modes")
    assert picture._repr_svg_().lstrip().startswith("<svg") or "<svg" in picture.svg
    picture.save(tmp_path / "modes.svg")
    with pytest.raises(FileExistsError):
        picture.save(tmp_path / "modes.svg")
    page = octahedral.view()
    assert "<iframe" in page._repr_html_() and page.html.startswith("<!")
    found = octahedral.fk(octahedral.ik(octahedral.home))
    assert found._repr_html_().count("<tr>") == 17 and "<table" in octahedral.check()._repr_html_()
    assert "16 poses" in repr(found)


def test_exports_are_texts_by_name(octahedral):
    files = octahedral.export("mjcf")
    assert all("<mujoco" in text for text in files.values()) and files
    with pytest.raises(equipod.DesignError):
        octahedral.export("paper")


def test_tables_are_read_by_arrow(octahedral):
    batch = octahedral.fk_batch(octahedral.ik(poses_about(octahedral, np.random.default_rng(9), 5)))
    table = batch.to_arrow()
    assert table.num_rows == len(batch.T) and table.column("row").to_pylist()[-1] == 4
    assert np.allclose(table.column("x_re").to_numpy(), batch.T[:, 0, 3].real)
    worked = equipod.Design.load(DESIGNS / "worked/bench-joint-free.toml")
    assessed = worked.assess(points=100, searches=0, cells=50)
    rows = equipod.table(assessed.requirements)
    assert rows.num_rows == len(assessed.requirements) and "margin" in rows.column_names
    margins = worked.margins(np.stack([worked.home] * 4)).to_arrow()
    assert margins.num_rows == 4 and len(set(margins.column_names)) == margins.num_columns


def test_the_types_of_answers_are_those_of_the_schemas():
    script = pathlib.Path(__file__).with_name("generate_records.py")
    subprocess.run([sys.executable, script, sys.executable, "-m", "equipod", "--check"], check=True)


def test_every_public_thing_says_what_it_is():
    for name in equipod.__all__:
        if name.startswith("__") or name == "PoseLike":
            continue
        thing = getattr(equipod, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                doc = value.__func__.__doc__ if isinstance(value, classmethod) else value.__doc__
                assert doc, f"{name}.{member}"


def test_tracks_say_how_near_singular_poses_are(octahedral):
    # the platform turns by 90 degrees about the vertical axis, where a rigid octahedral platform is singular
    turns = np.radians(np.linspace(0, 80, 81))
    poses = np.tile(octahedral.home, (len(turns), 1, 1))
    poses[:, :3, :3] = [[[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]] @ octahedral.home[:3, :3] for a in turns]
    track = octahedral.tracker(poses[0]).follow(octahedral.ik(poses))
    size = octahedral.characteristic_length
    def ratio(pose):
        jacobian = octahedral.jacobian(pose, characteristic_length=size)
        return 6 / (np.linalg.norm(jacobian) * np.linalg.norm(np.linalg.inv(jacobian)))
    assert len(track.T) > 40 and track.frobenius_ratio[-1] < 0.5 * track.frobenius_ratio[0]
    # with moments over a length of its own, so that the course is compared and not the numbers
    assert np.corrcoef(track.frobenius_ratio, [ratio(pose) for pose in track.T])[0, 1] > 0.95


def test_calibrated_offsets_are_in_all_lengths(octahedral):
    offsets = [0.1, -0.2, 0.05, 0.3, -0.15, 0.02]
    text = octahedral.dumps() + f"\n[calibration]\noffsets = {offsets}\n"
    shown = equipod.Design.loads(text)
    pose = octahedral.home
    lengths = shown.ik(pose)
    assert np.allclose(lengths - octahedral.ik(pose), offsets, atol=1e-12)
    assert np.allclose(np.sort(np.abs(shown.fk(lengths).T - pose).max(axis=(1, 2)))[0], 0, atol=1e-9)
    assert np.abs(shown.fk_batch(np.array([lengths, lengths]))[1].T - pose).max(axis=(1, 2)).min() < 1e-9
    assert shown.tracker(pose).step(lengths).status == "tracked"
    assert np.allclose(shown.tracker(pose).step(lengths).T, pose, atol=1e-9)

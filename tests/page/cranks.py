"""The page of a design whose legs are rods on cranks: angles, sides, modes and requirements as the program has them."""

import math

import poses
from program import DESIGNS

HEAD = DESIGNS / "presets" / "reachy-mini.toml"


def near_home(folder):
    """The head with half its workspace, which is assessed in a fifth of the time."""
    text = HEAD.read_text()
    for key, wide, half in (("translation", 10.0, 5.0), ("rotation_deg", 10.0, 5.0)):
        assert f"{key} = {[wide] * 3}" in text, key
        text = text.replace(f"{key} = {[wide] * 3}", f"{key} = {[half] * 3}")
    path = folder / "near-home.toml"
    path.write_text(text)
    return path


def numbers(shown, column):
    """A column of the table of cranks, counted from the one after the names of the legs."""
    cells = shown.page.eval_on_selector_all("#lengths tbody tr", f"rows => rows.map((r) => r.cells[{column}].textContent)")
    return [float(text.split("●")[0].strip().replace("−", "-")) for text in cells]


def as_ik(shown, program):
    """Both angles, margins and transmissions of two poses are those of `ik`, and the kept angle is the marked one."""
    for pose in ([0, 0, 177, 0, 0, 0], [3, -4, 180, 5, -3, 8]):
        poses.go(shown, pose)
        found = program.json("ik", HEAD, "--pose", ",".join(map(str, pose)))["cranks"]
        fields = poses.lengths(shown)
        assert poses.near(fields, [c["angle_deg"] for c in found]), (fields, found)
        for column, key in ((1, "angle_deg"), (2, "other_angle_deg"), (3, "limit_margin_deg"), (4, "transmission"), (5, "to_singular_deg")):
            there = numbers(shown, column)
            assert poses.near(there, [c[key] for c in found], 1e-3), (key, there, found)
        marked = shown.page.eval_on_selector_all("#lengths tbody tr", "rows => rows.map((r) => r.cells[1].textContent)")
        assert all("●" in text and c["elbow"] in text for text, c in zip(marked, found)), marked
        assert shown.page.text_content("#regular-first") == "all rods reach"
        least = min(abs(c["transmission"]) for c in found)
        tile = float(shown.page.locator("#transmission").evaluate("e => e.firstChild.textContent"))
        assert abs(tile - math.degrees(math.asin(least))) < 1e-2, tile


def modes_of_angles(shown, program):
    """The modes listed are the real poses of `fk` for the angles shown, and typed angles give the pose back."""
    pose = [3, -4, 180, 5, -3, 8]
    poses.go(shown, pose)
    angles = poses.lengths(shown)
    shown.page.click("#find")
    shown.settle()
    found = program.json("fk", HEAD, "--angles", ",".join(map(repr, angles)), exits=(0, 1, 3))
    real = [s for s in found["solutions"] if s.get("real_pose")]
    rows = shown.page.locator("#modes input[name=mode]").count()
    assert rows == len(real) > 1, (rows, len(real))
    kept = sum(all(s["real_pose"]["elbow_kept"]) for s in real)
    text = shown.page.text_content("#modes")
    assert text.count("yes") == kept, text
    poses.go(shown, [0, 0, 177, 0, 0, 0])
    poses.type_lengths(shown, angles)
    assert "typed in" in shown.page.text_content("#lengths-state")
    shown.page.click("#solve")
    shown.settle()
    assert poses.near(poses.pose(shown), pose, 1e-5), poses.pose(shown)


def beyond_reach(shown):
    """A pose that the rods do not reach has no angles and says which rod is missing how much."""
    poses.go(shown, [0, 0, 230, 0, 0, 0])
    assert "does not reach" in shown.page.text_content("#regular-first")
    assert "too short" in shown.page.text_content("#lengths-words")
    assert shown.page.input_value("#length-1") == "" and shown.page.locator("#lengths tbody tr").count() == 0
    assert shown.page.locator("#margins td.no").count() > 0
    shown.page.click("#home")
    shown.settle()
    assert shown.page.text_content("#regular-first") == "all rods reach"


def required(shown, program):
    """The table of requirements has the rows of `assess`."""
    names = [row["name"] for row in program.json("assess", HEAD, "--cells", "50", "--points", "50", "--searches", "1", exits=(0, 1, 3))["requirements"]]
    shown.page.wait_for_function("[...document.querySelectorAll('#margins thead th')].some((h) => h.textContent === 'least margin')", timeout=120000)
    heads = shown.page.eval_on_selector_all("#margins tbody th", "list => list.map((h) => h.textContent)")
    assert len(heads) == len(names) + 2, (heads, names)

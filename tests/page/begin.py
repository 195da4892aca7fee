"""The page without a design: a hexapod from a data sheet, from points, from an example."""

import math
import tomllib

import poses
from program import DESIGNS


def numbers(page, **values):
    for name, value in values.items():
        page.fill(f"#{name}", str(value))
    page.locator("#sheet button").click()


def from_a_data_sheet(shown, program, folder):
    page = shown.page
    assert page.is_visible("#sheet") and page.text_content("#name") == "hexapod"
    numbers(page, base_radius=250, platform_radius=120, base_spread_deg=30, platform_spread_deg=25.5, height=220)
    shown.settle()
    design = shown.download("design, TOML", folder / "sheet.toml")
    answer = program.json("check", design)
    assert answer["architecturally_singular"] is False
    found = poses.lengths(shown)
    assert max(found) - min(found) < 1e-6, found
    # the leg from the base joint at 15 degrees to the platform joint at 60 - 12.75 degrees
    turn = math.radians(60 - 12.75 - 15)
    length = math.sqrt(250**2 + 120**2 - 2 * 250 * 120 * math.cos(turn) + 220**2)
    assert abs(found[0] - length) < 1e-6, (found[0], length)


def shared_joints(shown):
    """Spreads of 0 are an octahedral hexapod, with all its equivalents."""
    numbers(shown.page, base_spread_deg=0, platform_spread_deg=0)
    shown.settle()
    assert shown.page.is_visible("#offsets") and abs(shown.det()) > 0.05


def what_is_no_hexapod(shown):
    page = shown.page
    before = page.text_content("#name")
    numbers(page, base_spread_deg=130)
    assert "from 0 to less than 120" in page.text_content("#begin-words")
    numbers(page, base_spread_deg=20, base_radius=0, platform_radius=0)
    assert "not a positive length" in page.text_content("#begin-words"), page.text_content("#begin-words")
    assert page.get_attribute("#begin-words", "class") == "small bad"
    numbers(page, base_radius="")
    assert "five numbers" in page.text_content("#begin-words")
    assert page.text_content("#name") == before


def examples(shown):
    page = shown.page
    names = page.eval_on_selector_all("#preset option", "list => list.map((o) => o.value).filter(Boolean)")
    presets = list((DESIGNS / "presets").glob("*.toml"))
    assert len(names) == len(presets) > 0, names
    for name in names:
        page.select_option("#preset", name)
        page.wait_for_function("name => document.getElementById('begin-words').textContent.includes(name)", arg=name)
        shown.drawn()
        assert "bad" not in page.get_attribute("#begin-words", "class")
    numbers(page, base_spread_deg=30, platform_spread_deg=25.5)
    shown.settle()


def from_points(shown, folder):
    """Twelve points as a spreadsheet with decimal commas exports them; what was guessed is listed, what is no table is refused."""
    page = shown.page
    design = tomllib.loads((DESIGNS / "general-6-6.toml").read_text())
    rows = [[*design["base"][a], *design["platform"][b]] for a, b in design["legs"]]
    page.fill("#points", "\r\n".join(";".join(repr(float(x)).replace(".", ",") for x in row) for row in rows))
    page.select_option("#points-units", "cm")
    page.locator("#points-form button").click()
    shown.settle()
    assert "shown below" in page.text_content("#begin-words"), page.text_content("#begin-words")
    assert page.locator("#guesses li").count() > 0
    read = tomllib.loads(shown.download("design, TOML", folder / "points.toml").read_text())
    assert read["units"] == "cm"
    assert [[*read["base"][a], *read["platform"][b]] for a, b in read["legs"]] == rows
    page.fill("#points", "one two three")
    page.locator("#points-form button").click()
    assert "bad" in page.get_attribute("#begin-words", "class") and page.locator("#guesses li").count() == 0


def ring(radius, degrees):
    return [[round(radius * math.cos(math.radians(x)), 6), round(radius * math.sin(math.radians(x)), 6), 0.0] for x in degrees]


def symmetry_is_written(shown, program, folder):
    """Rings of rounded decimals: the symmetry is said, and the button writes the constructions of `design convert --snap`."""
    page = shown.page
    rows = zip(ring(500, [-10, 10, 110, 130, 230, 250]), ring(280, [-50, 50, 70, 170, 190, 290]))
    page.fill("#points", "\n".join(",".join(map(repr, [*a, *b])) for a, b in rows))
    page.locator("#points-form button").click()
    shown.settle()
    assert page.is_visible("#symmetry") and "turned by a third" in page.text_content("#symmetry-found")
    typed = shown.download("design, TOML", folder / "typed.toml")
    page.locator("#snap").click()
    shown.settle()
    assert not page.is_visible("#symmetry") and "exact constructions" in page.text_content("#begin-words")
    written = tomllib.loads(shown.download("design, TOML", folder / "written.toml").read_text())
    program.run("design", "convert", typed, "--snap", "-o", folder / "converted.toml", "--quiet")
    converted = tomllib.loads((folder / "converted.toml").read_text())
    assert [written[body] for body in ("base", "platform")] == [converted[body] for body in ("base", "platform")], written
    assert any("turn" in joint for joint in written["base"].values())

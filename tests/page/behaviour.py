"""The numbers of the page are those of the command line."""

from program import DESIGNS


def close(a, b, limit=1e-12):
    return abs(a - b) <= limit * max(1.0, abs(a), abs(b))


def numbers(text):
    return ",".join(repr(x) for x in text)


def slider_moves_det(shown, program, folder):
    """Keys on a slider; the page's det A is that of the two designs it offers, by `equivalents map`, and that of the class, by `equivalents family`."""
    page = shown.page
    before = shown.det()
    page.focus("#offset-t2")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.focus("#offset-t5")
    page.keyboard.press("ArrowLeft")
    shown.settle()
    det = shown.det()
    assert abs(det - before) > 1e-6, "the slider changes nothing"
    original = shown.download("original, TOML", folder / "original.toml")
    equivalent = shown.download("equivalent, TOML", folder / "equivalent.toml")
    answer = program.json("equivalents", "map", original, equivalent)
    assert close(answer["det"], det), (answer["det"], det)
    offsets = shown.offsets()
    pattern = page.input_value("#pattern")
    instance = program.json("equivalents", "family", original, "--pattern", pattern, f"--offsets={numbers(offsets)}")["instance"]
    assert instance["offsets"] == offsets and len(offsets) == 6
    # the original is read back: its cycle may begin elsewhere, |det A| is the same
    assert close(abs(instance["det"]), abs(det)) or pattern != "S123456", (instance["det"], det)
    return det


def derivation_is_that_of_the_command(shown, program, folder):
    """The steps for the offsets shown are those of `equivalents family --explain`, and follow a slider."""
    page = shown.page
    page.locator("#derivation-details summary").first.click()
    texts = []
    for key in ("ArrowRight", "ArrowLeft"):
        page.focus("#offset-t1")
        page.keyboard.press(key)
        shown.settle()
        page.wait_for_function("document.getElementById('derivation').textContent.includes('det A')")
        original = shown.download("original, TOML", folder / "derived.toml")
        chosen = ["--pattern", page.input_value("#pattern"), f"--offsets={numbers(shown.offsets())}"]
        steps = program.json("equivalents", "family", original, *chosen, "--explain")["derivation"]
        text = page.text_content("#derivation")
        assert all(f"leg {step['leg']}: {step['moved']}" in text for step in steps["moves"]), text
        assert ("exact numbers" in text) == steps["exact"], text[:200]
        texts.append(text)
    assert texts[0] != texts[1], "the steps stay while an offset moves"
    page.locator("#derivation-details summary").first.click()


def singular_at_the_mark(shown, program, folder):
    """The button of a slider puts it where det A vanishes, and `check` agrees."""
    shown.page.locator(".slider button").first.click()
    shown.settle()
    assert abs(shown.det()) < 1e-12, shown.det()
    equivalent = shown.download("equivalent, TOML", folder / "singular.toml")
    answer = program.json("check", equivalent, exits=(0, 1, 3))
    # the offset is a double, so that the exact design is singular or beside one that is
    near = answer["nearest_singular"]
    assert answer["architecturally_singular"] is not False or near["distance"] < 1e-12, answer["explanation"]


def shown_lengths(page, platform=1):
    """Lengths in the table: of the original (1) or of the equivalent (2)."""
    return page.eval_on_selector_all("#lengths tbody tr", "(rows, k) => rows.map(r => r.cells[k].firstChild.textContent)", platform)


def modes_are_all(shown, program, folder, which="original"):
    """The number of assembly modes that `fk` finds for the lengths in the table."""
    page = shown.page
    page.click("#home")
    page.click("#find")
    shown.settle()
    design = shown.download(f"{which}, TOML", folder / "modes.toml")
    lengths = shown_lengths(page)
    answer = program.json("fk", design, "--lengths", ",".join(lengths), exits=(0, 1, 3))
    listed = page.locator("#modes input[name=mode]").count()
    assert listed == answer["real_count"] and listed > 0, (listed, answer["real_count"])
    if listed > 1:
        other = page.locator("#modes input[name=mode]:not(:checked)").last
        before = page.text_content("#pose-words")
        other.click()
        page.locator("#modes input[name=ghost]").first.check()
        shown.settle()
        assert page.text_content("#pose-words") != before, "choosing a mode moves nothing"
        again = shown_lengths(page)
        assert all(close(float(a), float(b), 1e-6) for a, b in zip(lengths, again)), (lengths, again)


def modes_for_the_lengths_of_the_file(shown, program, design):
    """The published lengths in the field give the poses that `fk` gives for the file."""
    shown.page.click("#of-file")
    shown.page.click("#solve")
    shown.settle()
    answer = program.json("fk", design, exits=(0, 1, 3))
    listed = shown.page.locator("#modes input[name=mode]").count()
    assert listed == answer["real_count"] > 1, (listed, answer["real_count"])


def confirmed_by_the_equivalent(shown):
    shown.page.click("#confirm")
    shown.settle()
    words = shown.page.text_content("#modes-words")
    assert "paired, they are at most" in words, words
    assert float(words.split("at most ")[1].split(" ")[0].replace("−", "-")) < 1e-6, words


def self_motion_keeps_the_lengths(shown):
    """The legs of the equivalent keep their lengths along the curve, those of the original do not."""
    page = shown.page
    page.select_option("#path", "motion")
    shown.settle()
    assert "Self-motion" in page.text_content("#motion-words"), page.text_content("#motion-words")
    rows = []
    for at in ("0", "0.3"):
        page.eval_on_selector("#way", "(way, at) => { way.value = at; way.dispatchEvent(new Event('input')); }", at)
        shown.settle()
        rows.append(list(zip(shown_lengths(page), shown_lengths(page, 2))))
    pairs = [(a, b) for a, b in zip(*rows)]
    assert all(close(float(a[1]), float(b[1]), 1e-6) for a, b in pairs), pairs
    assert any(not close(float(a[0]), float(b[0]), 1e-3) for a, b in pairs), pairs


def at_the_limit(shown):
    """Joints exactly as far apart as they have to be are at their limit, and not violated by rounding."""
    for k in range(1, 7):
        shown.page.fill(f"input[aria-label='t{k} as a number']", "0.2")
        shown.page.keyboard.press("Enter")
    shown.settle()
    spacing = shown.page.locator("#margins tbody tr", has_text="distance of platform joints").locator("td").last
    assert "0, at the limit" in spacing.text_content() and spacing.get_attribute("class") == "yes", spacing.text_content()
    shown.page.fill("input[aria-label='t4 as a number']", "0.199999")
    shown.page.keyboard.press("Enter")
    shown.settle()
    assert spacing.get_attribute("class") == "no", spacing.text_content()


def no_motion_when_regular(shown):
    shown.page.select_option("#path", "motion")
    shown.settle()
    assert "No self-motion" in shown.page.text_content("#motion-words")


def pointer_drags_a_leg(shown):
    """A point of the hexagon follows the pointer."""
    page = shown.page
    before = shown.offsets()
    handle = page.locator("#hexagon .handle").nth(1)
    handle.scroll_into_view_if_needed()
    box = handle.locator("circle.touch").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 18, y + 24, steps=4)
    page.mouse.up()
    shown.settle()
    after = shown.offsets()
    assert before[1] != after[1] and before[2:] == after[2:], (before, after)


def another_design_opens(shown):
    shown.page.set_input_files("#open", DESIGNS / "general-6-6.toml")
    shown.settle()
    assert shown.page.text_content("#name") == "general 6-6"
    assert not shown.page.is_visible("#offsets")

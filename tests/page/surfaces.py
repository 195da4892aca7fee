"""The drawings over the offsets and about the platform in space: platforms that violate a requirement, and singular
surfaces."""


def words(shown):
    return shown.page.text_content("#feasible-words")


def put(shown, offsets):
    """Offsets typed into the fields, one after the other."""
    for k, value in enumerate(offsets, 1):
        shown.page.fill(f"input[aria-label='t{k} as a number']", repr(value))
        shown.page.keyboard.press("Enter")
    shown.assessed()


def shaded_as_assess(shown, program, folder):
    """Next to the mark the page says what `assess` finds at the same poses; the marks lie on points that were examined."""
    seen = set()
    for t1 in (0.2, 0.3, 0.5, 0.0, 1.2):
        put(shown, [t1, 0.3, 0.2, 0.3, 0.2, 0.3])
        said = words(shown)
        poses = int(said.split(" poses of the workspace")[0].split(" ")[-1])
        next_to = said.split("The platform next to the mark ")[1]
        if "joints coincide" in next_to:
            continue
        design = shown.download("equivalent, TOML", folder / "shaded.toml")
        answer = program.json("assess", design, "--points", "250", "--searches", "0", "--cells", "0", exits=(0, 1, 3))
        bad = [m["name"] for m in answer["requirements"] if m["met"] is False]
        assert poses == answer["poses"], (poses, answer["poses"])
        assert next_to.startswith("violates none") == (not bad), (t1, said, bad)
        seen.add(not bad)
    assert seen == {True, False}, f"all platforms are alike: {seen}"


def stays_while_the_mark_moves(shown):
    """The shading is not computed anew while only the offsets of the plane change."""
    page = shown.page
    page.focus("#plane")
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(100)
    assert "Checking requirements" not in words(shown), words(shown)
    shown.settle()


def in_space(shown):
    """The surface over three offsets: another third offset gives another sentence, and keys turn the picture."""
    page = shown.page
    page.locator("#space-details summary").click()
    shown.settle()
    before = page.text_content("#space-words")
    assert before.startswith("On the surface det A = 0 over t1, t2, t3"), before
    picture = page.evaluate("document.getElementById('space').toDataURL()")
    page.focus("#space")
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("document.getElementById('space').toDataURL()") != picture
    page.select_option("#axis-z", "4")
    shown.settle()
    assert "t1, t2, t5" in page.text_content("#space-words"), page.text_content("#space-words")


def singular_positions(shown, program, folder):
    """The page draws singular positions only where there are some. With the orientation of home none is in the
    workspace of a design that is proved regular."""
    page = shown.page
    plain = page.evaluate("document.getElementById('view-first').toDataURL()")
    page.check("#locus")
    shown.settle()
    said = page.text_content("#locus-words")
    assert "With this orientation" in said, said
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.evaluate("document.getElementById('view-first').toDataURL()") != plain
    page.uncheck("#locus")
    shown.settle()
    assert page.text_content("#locus-words") == ""

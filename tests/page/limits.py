"""The requirements over the whole workspace: the page says what `equipod assess` says of the same design."""

import re

from program import DESIGNS

# what the page has to say for the answer `met` of the program
BADGES = {True: "meets all requirements", None: "no violation found, not all proved"}


def as_assess(shown, program, folder, which="equivalent"):
    """Badge, status and least margins are those of `equipod assess` for the design that the page saves."""
    page = shown.page
    shown.assessed()
    design = shown.download(f"{which}, TOML", folder / "assessed.toml")
    answer = program.json("assess", design, exits=(0, 1, 3))
    badge = page.text_content("#badge")
    regular = answer["regular"]["met"]
    if regular is False:
        assert badge == "singular pose in the workspace", badge
    elif answer["met"] is False:
        assert badge == "violates requirements", badge
    else:
        assert badge == BADGES[answer["met"]], (badge, answer["met"])
    assert ("good" in page.get_attribute("#badge", "class")) == (answer["met"] is True), page.get_attribute("#badge", "class")
    # how many poses a search takes differs with the rounding of sines and cosines
    words = page.text_content("#margins-words")
    counted = re.search(r"(\d+) poses", words)
    assert counted or answer["met"] is False, words
    if counted:
        poses = int(counted.group(1))
        assert abs(poses - answer["poses"]) < 0.2 * answer["poses"], (poses, answer["poses"])
    # name, status and least margin, which a button follows where there is a pose
    rows = page.eval_on_selector_all("#margins tbody tr", "rows => rows.map(r => [r.cells[1].className, r.cells[2].firstChild.textContent])")
    assert len(rows) == len(answer["requirements"]) + 2, rows
    # beside the margins the singular poses and the conditioning
    least = float(rows[-1][1])
    assert abs(least - answer["conditioning"]["inverse_condition"]) < 0.02 * max(least, 0.01), (rows[-1], answer["conditioning"])
    for (tone, text), margin in zip(rows, answer["requirements"]):
        number = float(text)
        assert abs(number - margin["margin"]) <= 6e-3 * max(abs(number), abs(margin["margin"])) + 1e-9, (text, margin)
        assert tone == {True: "yes", False: "no", None: "open"}[margin["met"]], (text, tone, margin["met"])
    return answer


def violated_here(shown):
    """Number of requirements violated at the pose shown."""
    return shown.page.evaluate("""() => {
      const heads = [...document.querySelectorAll("#margins thead th")].map((h) => h.textContent);
      const rows = [...document.querySelectorAll("#margins tbody tr")];
      return rows.flatMap((r) => [...r.cells].filter((c, k) => heads[k].startsWith("here") && c.classList.contains("no"))).length;
    }""")


def short_legs(folder):
    """A design that meets its requirements at home and violates one at the edge of its workspace."""
    text = (DESIGNS / "presets" / "mdx-chair-v3.toml").read_text()
    path = folder / "short-legs.toml"
    limits = "leg_length = [800.0, 1000.0]"
    assert limits in text, "the design has other limits of its legs"
    path.write_text(text.replace(limits, "leg_length = [812.0, 1000.0]"))
    return path


def wide(folder):
    """A design whose workspace holds singular poses, and whose home does not."""
    text = (DESIGNS / "symmetric-hexapod.toml").read_text()
    path = folder / "wide.toml"
    turns = "rotation_deg = [10.0, 10.0, 10.0]"
    assert turns in text, "the design turns otherwise"
    # turned by 90 degrees about its axis such a hexapod is singular
    path.write_text(text.replace(turns, "rotation_deg = [0.0, 0.0, 100.0]").replace("leg_diameter = 25.0", "leg_diameter = 1.0"))
    return path


def at_its_worst(shown):
    """The button beside a violated margin shows the pose where it is violated."""
    page = shown.page
    row = page.locator("#margins tbody tr", has=page.locator("td:nth-child(2).no")).first
    assert not violated_here(shown)
    row.get_by_role("button", name="show pose").click()
    shown.assessed()
    assert violated_here(shown), page.text_content("#margins")

"""Poses to lengths and lengths to poses, by sliders and fields."""

import math
import tomllib

from program import DESIGNS

COORDINATES = ["x", "y", "z", "roll", "pitch", "yaw"]


def rotation(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll), degrees."""
    (sr, cr), (sp, cp), (sy, cy) = [(math.sin(math.radians(a)), math.cos(math.radians(a))) for a in (roll, pitch, yaw)]
    return [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]


def lengths_at(design, pose):
    """Leg lengths of a design whose joints are plain numbers."""
    turn = rotation(*pose[3:])
    found = []
    for base, platform in design["legs"]:
        p = design["platform"][platform]
        end = [sum(turn[i][j] * p[j] for j in range(3)) + pose[i] for i in range(3)]
        found.append(math.dist(end, design["base"][base]))
    return found


def field(page, name):
    return page.locator(f"#pose-{name} + input[type=number]")


def pose(shown):
    return [float(field(shown.page, name).input_value()) for name in COORDINATES]


def lengths(shown):
    return [float(shown.page.input_value(f"#length-{k}")) for k in range(1, 7)]


def type_lengths(shown, values):
    for k, value in enumerate(values, 1):
        shown.page.fill(f"#length-{k}", repr(value))


def go(shown, values):
    for name, value in zip(COORDINATES, values):
        field(shown.page, name).fill(repr(value))
        shown.page.keyboard.press("Enter")
    shown.settle()


def near(a, b, limit=1e-6):
    return len(a) == len(b) and all(abs(x - y) <= limit * max(1.0, abs(x)) for x, y in zip(a, b))


def there_and_back(shown, name):
    """Numbers in the fields give the lengths of that pose; these lengths, typed in elsewhere, give the pose back, and all others that `fk` finds."""
    page = shown.page
    design = tomllib.loads((DESIGNS / f"{name}.toml").read_text())
    start = pose(shown)
    aim = [start[0] + 0.11, start[1] - 0.07, start[2] + 0.09, start[3] + 3.5, start[4] - 2.25, start[5] + 4.0]
    go(shown, aim)
    assert near(pose(shown), aim), (pose(shown), aim)
    found = lengths(shown)
    assert near(found, lengths_at(design, aim)), (found, lengths_at(design, aim))
    # the modes follow the lengths shown without being asked for, and the pose shown is one of them
    assert "has moved since" not in page.text_content("#modes-words")
    assert page.locator("#modes input[name=mode]:checked").count() == 1
    page.click("#home")
    shown.settle()
    assert near(pose(shown), start), (pose(shown), start)
    type_lengths(shown, found)
    assert "typed in" in page.text_content("#lengths-state")
    page.click("#solve")
    shown.settle()
    modes = page.locator("#modes input[name=mode]")
    reached = []
    for k in range(modes.count()):
        modes.nth(k).click()
        shown.settle()
        reached.append(pose(shown))
        assert near(lengths(shown), found, 1e-5), (k, lengths(shown), found)
    assert any(near(p, aim, 1e-4) for p in reached), (aim, reached)


def one_slider(shown):
    """A key on a slider moves that coordinate alone, and the lengths with it."""
    before, at = pose(shown), lengths(shown)
    shown.page.focus("#pose-yaw")
    shown.page.keyboard.press("ArrowRight")
    shown.settle()
    after = pose(shown)
    assert after[:5] == before[:5] and after[5] != before[5], (before, after)
    assert lengths(shown) != at


def pasted_lengths(shown):
    """Six numbers that are pasted into one field are for all six."""
    shown.page.focus("#length-2")
    shown.page.evaluate("""() => {
      const data = new DataTransfer();
      data.setData("text", "1.5; 2.5\\n3.5\\t4.5, 5.5 6.5");
      document.getElementById("length-2").dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, cancelable: true, bubbles: true }));
    }""")
    assert lengths(shown) == [1.5, 2.5, 3.5, 4.5, 5.5, 6.5], lengths(shown)
    shown.page.fill("#length-3", "x")
    shown.page.click("#solve")
    assert "six positive numbers" in shown.page.text_content("#lengths-state")
    shown.page.click("#as-shown")
    shown.settle()
    assert lengths(shown)[0] != 1.5


def of_the_equivalent(shown):
    """The lengths of the equivalent find the same pose as those of the original."""
    page = shown.page
    original = lengths(shown)
    page.select_option("#whose", "second")
    shown.settle()
    own, before = lengths(shown), pose(shown)
    assert own != original
    shown.page.focus("#pose-x")
    shown.page.keyboard.press("ArrowRight")
    shown.settle()
    type_lengths(shown, own)
    page.click("#solve")
    shown.settle()
    assert "of the equivalent" in page.text_content("#modes-words")
    assert near(pose(shown), before, 1e-4), (pose(shown), before)
    page.select_option("#whose", "first")
    shown.settle()
    assert near(lengths(shown), original, 1e-5)


def no_leg_hidden(shown, canvases):
    """Much of each leg is visible, in its own colour or through a plate, which lets 58 % of it through."""
    for name in canvases:
        counts = shown.page.evaluate("""(id) => {
          const canvas = document.getElementById(id);
          const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
          const colour = (name) => {
            const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
            return [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
          };
          return [1, 2, 3, 4, 5, 6].map((leg) => {
            const own = colour(`--leg-${leg}`);
            const all = [own, ...["--base", "--platform"].map((plate) => colour(plate).map((x, k) => 0.42 * x + 0.58 * own[k]))];
            let seen = 0;
            for (let i = 0; i < pixels.length; i += 4) seen += all.some((c) => c.every((x, k) => Math.abs(x - pixels[i + k]) < 3)) ? 1 : 0;
            return seen;
          });
        }""", name)
        middle = sorted(counts)[3]
        assert min(counts) >= 0.25 * middle > 0, (name, counts)

"""The common part of the browsers that are driven by their own protocols: a tab, and the main parts of the page checked
in it.

`firefox.py` and `webkit.py` say how a tab is reached. The checks are the same, and so are the answers that they compare
with.
"""

import json
import sys
import tempfile
import time
from pathlib import Path

from program import DESIGNS, Program

NONE = 77


class Tab:
    """A tab of a browser: a class for one has `navigate(url)`, `run(expression)` and the list `complaints`."""

    def open(self, url):
        self.navigate("about:blank")
        self.navigate(url)
        self.until("document.documentElement.dataset.ready")
        self.settle()

    def until(self, condition, seconds=180):
        end = time.monotonic() + seconds
        while not self.run(f"Boolean({condition})"):
            assert time.monotonic() < end, f"not in {seconds} s: {condition}"
            time.sleep(0.1)

    def settle(self):
        time.sleep(0.35)
        self.until("!document.documentElement.dataset.busy && !document.documentElement.dataset.assessing")
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def text(self, selector):
        return self.run(f"document.querySelector({json.dumps(selector)}).textContent")

    def fill(self, selector, value):
        self.run(
            f"(() => {{ const field = document.querySelector({json.dumps(selector)}); field.value = {json.dumps(str(value))};"
            " for (const name of ['input', 'change']) field.dispatchEvent(new Event(name, { bubbles: true })); })()"
        )

    def click(self, selector):
        self.run(f"document.querySelector({json.dumps(selector)}).click()")
        self.settle()


def lengths(tab):
    return tab.run("[1, 2, 3, 4, 5, 6].map((k) => Number(document.getElementById(`length-${k}`).value))")


def octahedral(tab, program, folder):
    path = program.page(DESIGNS / "rbt-octahedral.toml", folder / "octahedral.html")
    tab.open(path.as_uri())
    assert tab.run("document.documentElement.dataset.ready") == "live"
    assert tab.text("#badge") == "meets all requirements", tab.text("#badge")
    assert tab.run("document.querySelectorAll('#modes input[name=mode]').length") == 16
    before = lengths(tab)
    tab.fill("#pose-yaw + input", 5)
    tab.settle()
    there = lengths(tab)
    assert there != before and tab.run("document.querySelectorAll('#modes input[name=mode]:checked').length") == 1
    tab.click("#home")
    assert lengths(tab) == before
    for k, value in enumerate(there, 1):
        tab.fill(f"#length-{k}", value)
    tab.click("#solve")
    assert abs(tab.run("Number(document.querySelector('#pose-yaw + input').value)") - 5) < 1e-4
    tab.click("#share")
    tab.until("!document.getElementById('link').hidden")
    link = tab.run("document.getElementById('link').value")
    other = program.page(DESIGNS / "general-6-6.toml", folder / "other.html")
    tab.open(other.as_uri() + "#" + link.split("#")[1])
    assert tab.text("#name") == "octahedral 12-6", tab.text("#name")
    assert abs(tab.run("Number(document.querySelector('#pose-yaw + input').value)") - 5) < 1e-4


def start(tab, program, folder):
    path = program.page(None, folder / "start.html")
    tab.open(path.as_uri())
    tab.fill("#base_spread_deg", 0)
    tab.fill("#platform_spread_deg", 0)
    tab.click("#sheet button")
    assert tab.run("document.getElementById('offsets').checkVisibility()")


def surfaces(tab, program, folder):
    """The parts that need a worker: platforms shaded over two offsets, the singular surfaces in space."""
    tab.open((folder / "octahedral.html").as_uri())
    tab.until("document.getElementById('feasible-words').textContent.includes('inside the green line')")
    tab.run("(document.getElementById('space-details').open = true)")
    tab.until("document.getElementById('space-words').textContent.startsWith('On the surface det A = 0')")
    tab.click("#locus")
    tab.until("document.getElementById('locus-words').textContent.includes('With this orientation')")


def checked(name, browser):
    """Every check in a browser; `browser()` gives a tab, or nothing where there is none."""
    program = Program(sys.argv[1])
    failed = 0
    with tempfile.TemporaryDirectory() as folder, browser() as tab:
        if tab is None:
            print(f"NOT RUN: there is no {name}")
            return NONE
        for check in (octahedral, surfaces, start):
            try:
                check(tab, program, Path(folder))
                assert not tab.complaints, tab.complaints
                print(f"ok      {check.__name__} in {name}")
            except Exception as error:  # every check is reported
                failed += 1
                print(f"FAILED  {check.__name__} in {name}: {type(error).__name__}: {error}")
    return 1 if failed else 0

"""The page in Firefox, by the remote protocol that it has itself (WebDriver BiDi): the same answers as in Chromium.

    python tests/page/firefox.py PROGRAM
"""

import itertools
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from websockets.sync.client import connect

from program import DESIGNS, Program

NONE = 77


class Firefox:
    """One tab of a headless Firefox."""

    def __init__(self, socket):
        self.socket = socket
        self.numbers = itertools.count(1)
        self.complaints = []
        self.ask("session.new", {"capabilities": {}})
        self.ask("session.subscribe", {"events": ["log.entryAdded"]})
        self.tab = self.ask("browsingContext.getTree", {})["contexts"][0]["context"]

    def ask(self, method, params):
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        while True:
            message = json.loads(self.socket.recv(timeout=120))
            if message.get("method") == "log.entryAdded" and message["params"]["level"] in ("error", "warn"):
                self.complaints.append(message["params"].get("text"))
            if message.get("id") == number:
                assert message["type"] == "success", message
                return message["result"]

    def run(self, script):
        """The value of an expression, which may be a promise, as JSON."""
        expression = f"Promise.resolve({script}).then((value) => JSON.stringify(value ?? null))"
        found = self.ask("script.evaluate", {"expression": expression, "target": {"context": self.tab}, "awaitPromise": True})
        assert found["type"] == "success", found
        return json.loads(found["result"]["value"])

    def open(self, url):
        self.ask("browsingContext.navigate", {"context": self.tab, "url": "about:blank", "wait": "complete"})
        self.ask("browsingContext.navigate", {"context": self.tab, "url": url, "wait": "complete"})
        self.until("document.documentElement.dataset.ready")
        self.settle()

    def until(self, condition, seconds=180):
        end = time.monotonic() + seconds
        while not self.run(f"Boolean({condition})"):
            assert time.monotonic() < end, f"not in {seconds} s: {condition}"
            time.sleep(0.1)

    def settle(self):
        time.sleep(0.35)
        self.until("!document.documentElement.dataset.busy")
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


@contextmanager
def browser():
    """Firefox of the system; `None` where there is none."""
    path = shutil.which("firefox-esr") or shutil.which("firefox")
    if not path:
        yield None
        return
    with tempfile.TemporaryDirectory() as profile:
        started = subprocess.Popen(
            [path, "--headless", "--remote-debugging-port", "0", "--profile", profile, "--no-remote", "about:blank"],
            stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
        )
        try:
            address = next(m.group(1) for m in (re.search(r"WebDriver BiDi listening on (ws://\S+)", line) for line in started.stderr) if m)
            with connect(f"{address}/session", max_size=None) as socket:
                yield Firefox(socket)
        finally:
            started.terminate()
            started.wait(timeout=30)


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


def main():
    program = Program(sys.argv[1])
    failed = 0
    with tempfile.TemporaryDirectory() as folder, browser() as tab:
        if tab is None:
            print("NOT RUN: there is no Firefox")
            return NONE
        for check in (octahedral, start):
            try:
                check(tab, program, Path(folder))
                assert not tab.complaints, tab.complaints
                print(f"ok      {check.__name__} in Firefox")
            except Exception as error:  # every check is reported
                failed += 1
                print(f"FAILED  {check.__name__} in Firefox: {type(error).__name__}: {error}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

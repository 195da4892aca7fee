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
from contextlib import contextmanager

from websockets.sync.client import connect

from driven import Tab, checked


class Firefox(Tab):
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

    def navigate(self, url):
        self.ask("browsingContext.navigate", {"context": self.tab, "url": url, "wait": "complete"})


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


if __name__ == "__main__":
    sys.exit(checked("Firefox", browser))

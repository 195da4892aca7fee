"""The page in WebKit, by the driver that comes with WebKitGTK (W3C WebDriver): the same answers as in Chromium.

    python tests/page/webkit.py PROGRAM

Debian: apt install webkit2gtk-driver xvfb. The browser has no mode without a screen, so it gets one that nobody sees where there is none.
"""

import json
import os
import shutil
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import contextmanager

from driven import Tab, checked

# a script of a page that ends in a promise, and the same for an error
ASYNC = "const done = arguments[arguments.length - 1]; Promise.resolve({}).then((value) => done(JSON.stringify(value ?? null)), (error) => done(`!${{error}}`));"


class WebKit(Tab):
    """One tab of WebKitGTK's small browser."""

    def __init__(self, address):
        self.address = address
        self.complaints = []
        made = self.ask("POST", "session", {"capabilities": {"alwaysMatch": {"pageLoadStrategy": "normal", "timeouts": {"script": 180000}}}})
        self.address = f"{address}/session/{made['sessionId']}"
        # The driver does not report errors of a page. So the page writes them down itself once it is loaded; without
        # its start there is no data-ready.
        self.watch = "window.complaints = []; addEventListener('error', (e) => window.complaints.push(e.message)); addEventListener('unhandledrejection', (e) => window.complaints.push(String(e.reason)));"

    def ask(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(f"{self.address}/{path}".rstrip("/"), data=data, method=method, headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=300) as reply:
                return json.loads(reply.read())["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(f"{method} {path}: {error.read().decode()}") from None

    def navigate(self, url):
        self.ask("POST", "url", {"url": url})
        if not url.startswith("about:"):
            self.run(f"(() => {{ {self.watch} }})()")

    def run(self, script):
        found = self.ask("POST", "execute/async", {"script": ASYNC.format(f"({script})"), "args": []})
        assert not found.startswith("!"), found
        return json.loads(found)

    def settle(self):
        super().settle()
        self.complaints += self.run("window.complaints.splice(0)")


@contextmanager
def browser():
    """WebKitGTK of the system; `None` where there is none."""
    driver = shutil.which("WebKitWebDriver")
    screen = [] if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") else ["xvfb-run", "--auto-servernum"]
    if not driver or (screen and not shutil.which(screen[0])):
        yield None
        return
    port = 4500 + os.getpid() % 1000
    environment = {**os.environ, "WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS": "1", "LIBGL_ALWAYS_SOFTWARE": "1", "WEBKIT_DISABLE_COMPOSITING_MODE": "1"}
    started = subprocess.Popen([*screen, driver, f"--port={port}"], env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        address = f"http://127.0.0.1:{port}"
        for _ in range(100):
            try:
                with urllib.request.urlopen(f"{address}/status", timeout=5):
                    break
            except OSError:
                time.sleep(0.2)
        tab = WebKit(address)
        try:
            yield tab
        finally:
            tab.ask("DELETE", "")
    finally:
        os.killpg(started.pid, 15)
        started.wait(timeout=30)


if __name__ == "__main__":
    sys.exit(checked("WebKit", browser))

"""The program under test and the browser."""

import json
import re
import shutil
import subprocess
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DESIGNS = ROOT / "designs"


class Program:
    """`equipod`, whose answers on the command line the page has to agree with."""

    def __init__(self, binary):
        self.binary = str(Path(binary).resolve())

    def run(self, *args, exits=(0,)):
        done = subprocess.run([self.binary, *map(str, args)], capture_output=True, text=True)
        if done.returncode not in exits:
            raise AssertionError(f"{args}: exit {done.returncode}: {done.stderr}")
        return done.stdout

    def json(self, *args, exits=(0, 1)):
        return json.loads(self.run(*args, "--json", exits=exits))

    def page(self, design, out, *options):
        self.run("view", *([design] if design else []), "-o", out, "--quiet", *options)
        return out


def unguarded(html):
    """The page with a policy that takes any inline script and style. It serves pages with planted faults, whose script
    or style is not the one that the policy names."""
    guarded = re.compile(r"(script|style)-src( 'sha256-[^']*')+")
    assert {m.group(1) for m in guarded.finditer(html)} == {"script", "style"}, "the page has no policy"
    return guarded.sub(r"\1-src 'unsafe-inline'", html)


@contextmanager
def browser(playwright):
    """Chromium of the system where there is one, else the one of playwright."""
    path = shutil.which("chromium") or shutil.which("google-chrome")
    opened = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
    try:
        yield opened
    finally:
        opened.close()


class Opened:
    """A page in the browser with everything it complained about."""

    def __init__(self, chromium, path, width=1360, height=900, dark=False, script=None, touch=False, fragment=""):
        self.context = chromium.new_context(
            viewport={"width": width, "height": height}, color_scheme="dark" if dark else "light",
            has_touch=touch, accept_downloads=True, reduced_motion="reduce",
        )
        self.page = self.context.new_page()
        self.complaints, self.requests = [], []
        self.page.on("console", lambda m: m.type in ("error", "warning") and self.complaints.append(m.text))
        self.page.on("pageerror", lambda e: self.complaints.append(str(e)))
        self.page.on("request", lambda r: self.requests.append(r.url))
        if script:
            self.page.add_init_script(script)
        self.url = Path(path).resolve().as_uri()
        self.page.goto(self.url + fragment)
        self.page.wait_for_selector("html[data-ready]", timeout=30000)
        self.settle()

    def settle(self):
        """Waits until bursts of changes are answered and drawn; not for assessments over the workspace, which take longest."""
        self.page.wait_for_timeout(350)
        self.page.wait_for_selector("html:not([data-busy])", state="attached", timeout=120000)
        self.drawn()

    def assessed(self):
        """Waits until the workspace is assessed as well, and what is shaded over the offsets."""
        self.settle()
        self.page.wait_for_selector("html:not([data-busy]):not([data-assessing])", state="attached", timeout=300000)
        self.drawn()

    def drawn(self):
        self.page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.context.close()

    @property
    def ready(self):
        return self.page.get_attribute("html", "data-ready")

    def quiet(self):
        """No error, and nothing asked from anywhere."""
        assert not self.complaints, self.complaints
        others = [u for u in self.requests if u.split("#")[0] != self.url and not u.startswith(("blob:", "data:"))]
        assert not others, others

    def det(self):
        return float(self.page.get_attribute("#det", "data-value"))

    def offsets(self):
        return json.loads(self.page.get_attribute("html", "data-shown"))

    def download(self, name, to):
        with self.page.expect_download() as waiting:
            self.page.get_by_role("button", name=name, exact=True).click()
        waiting.value.save_as(to)
        return to

"""Scripts that came with files of others do not run in pages made of them."""

import json
from xml.etree import ElementTree

from program import DESIGNS

MARK = "document.documentElement.dataset.hacked = 1"
PAYLOADS = [
    f"<script>{MARK}</script>",
    f'<img src=x onerror="{MARK}">',
    f'"><svg onload="{MARK}">',
    f"</title></style></script></pre><script>{MARK}</script>",
    f"<iframe srcdoc='&lt;script&gt;{MARK}&lt;/script&gt;'></iframe>",
    f"&lt;img src=x onerror=&quot;{MARK}&quot;&gt;",
]
TRAP = f"<script>{MARK}</script>"


def is_picture(svg):
    """Whether the text is XML: a browser shows nothing else as a picture."""
    try:
        ElementTree.fromstring(svg)
    except ElementTree.ParseError:
        return False
    return True


def opened(chromium, path):
    """A page with what its console said; alerts count as scripts."""
    page = chromium.new_page()
    said, dialogs = [], []
    page.on("console", lambda m: said.append(m.text))
    page.on("dialog", lambda d: (dialogs.append(d.message), d.dismiss()))
    page.goto(path.resolve().as_uri())
    page.wait_for_timeout(1500)
    hacked = [f for f in page.frames if f.evaluate("document.documentElement.dataset.hacked")]
    return page, said, bool(dialogs or hacked)


def report(chromium, program, folder):
    """A folder of hostile pictures, designs and results. Then the same page with a script in it: the policy stops it,
    and it runs without the policy."""
    results = folder / "results"
    results.mkdir()
    design = (DESIGNS / "rbt-octahedral.toml").read_text()
    pictures = []
    for k, evil in enumerate(PAYLOADS):
        svg = f'<svg xmlns="http://www.w3.org/2000/svg"><title id="title">{evil}</title><desc id="desc">{evil}</desc><circle r="9"/></svg>'
        (results / f"picture{k}.svg").write_text(svg)
        pictures.append(is_picture(svg))
        quoted = json.dumps(evil)
        named = design.replace('"P1"', quoted).replace("P1 = ", f"{quoted} = ", 1)
        named = named.replace('name = "octahedral 12-6"', f"name = {quoted}")
        (results / f"design{k}.toml").write_text(named)
        answer = {"schema_version": 1, "verdict": evil, "explanation": evil, evil: evil, "list": [{evil: evil}], "seed": evil}
        (results / f"answer{k}.json").write_text(json.dumps(answer))
    program.run("report", results, "--title", PAYLOADS[3])
    path = results / "report.html"
    page, said, hacked = opened(chromium, path)
    assert not hacked, "a script of a foreign file runs in the report"
    refused = [text for text in said if "Content Security Policy" in text or "Content-Security-Policy" in text]
    assert not refused, refused
    assert page.locator("figure img").count() == len(PAYLOADS)
    shown = page.eval_on_selector_all("figure img", "list => list.map((i) => i.naturalWidth > 0)")
    assert True in pictures and shown == pictures, f"pictures are not shown: {shown}, {pictures}"
    live = page.frames[-1]
    live.wait_for_selector("html[data-ready=live]", timeout=60000)
    assert page.evaluate("getComputedStyle(document.querySelector('main')).maxWidth") != "none", "the style of the page is not applied"
    page.close()
    whole = path.read_text()
    (folder / "trapped.html").write_text(whole.replace("</main>", TRAP + "</main>"))
    page, said, hacked = opened(chromium, folder / "trapped.html")
    assert not hacked and any("Security" in text for text in said), "the policy does not stop a script"
    page.close()
    (folder / "bare.html").write_text(whole.replace("Content-Security-Policy", "x-nothing").replace("</main>", TRAP + "</main>"))
    page, _, hacked = opened(chromium, folder / "bare.html")
    assert hacked, "the check does not notice a script that runs"
    page.close()


def names(chromium, program, folder):
    """The page of a design with hostile names."""
    design = (DESIGNS / "rbt-octahedral.toml").read_text()
    for evil in PAYLOADS:
        quoted = json.dumps(evil)
        text = design.replace('"P1"', quoted).replace("P1 = ", f"{quoted} = ", 1)
        (folder / "evil.toml").write_text(text.replace('name = "octahedral 12-6"', f"name = {quoted}"))
        path = program.page(folder / "evil.toml", folder / "evil.html")
        page, said, hacked = opened(chromium, path)
        assert not hacked, f"a name runs as a script: {evil}"
        assert page.text_content("#name") == evil
        assert not [text for text in said if "Security" in text], said
        page.close()

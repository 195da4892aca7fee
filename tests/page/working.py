"""Long computations run beside the page: it draws and answers meanwhile, and old answers are not shown."""

import json

import poses

NO_WORKERS = "delete window.Worker;"

ASK = 'answer = JSON.parse(this.call("equipod_answer", JSON.stringify(request)));'

FRAMES = """() => {
  window.gaps = [];
  let last = performance.now();
  const frame = () => { const now = performance.now(); window.gaps.push(now - last); last = now; requestAnimationFrame(frame); };
  requestAnimationFrame(frame);
}"""


def slowed(html):
    """The page with a core that computes the same forward kinematics again and again for two seconds."""
    assert html.count(ASK) == 1
    again = f"const until = performance.now() + 2000; do {{ {ASK} }} while (request.op === 'modes' && performance.now() < until);"
    return html.replace(ASK, again)


def table(shown):
    return shown.page.eval_on_selector_all("#modes tbody tr", "rows => rows.map(r => r.innerText)")


def timed(shown):
    """Presses Find; milliseconds until the answer is there, and the longest time between two frames."""
    page = shown.page
    page.evaluate(FRAMES)
    page.wait_for_timeout(300)
    took = page.evaluate("""() => new Promise((done) => {
      const start = performance.now();
      window.gaps.length = 0;
      document.getElementById('find').click();
      const wait = () => (document.documentElement.dataset.busy ? setTimeout(wait, 5) : requestAnimationFrame(() => done(performance.now() - start)));
      wait();
    })""")
    shown.settle()
    return took, page.evaluate("Math.max(...window.gaps)")


def stays_usable(shown):
    page = shown.page
    took, gap = timed(shown)
    assert took > 1000, f"only {took:.0f} ms: the core is not slow enough to tell"
    assert gap < took / 4, f"no frame for {gap:.0f} of {took:.0f} ms"
    found = table(shown)
    page.click("#find")
    page.get_by_text("Searching for all poses").wait_for()
    assert page.get_attribute("html", "data-busy") == "worker"
    before = page.text_content("#pose-words")
    page.focus("#way")
    page.keyboard.press("PageUp")
    page.wait_for_timeout(100)
    assert page.text_content("#pose-words") != before, "a key does nothing while the core computes"
    assert page.get_attribute("html", "data-busy") == "worker", "the answer was there before the key"
    shown.settle()
    # at rest the poses are those of the lengths shown, without being asked for
    assert "has moved since" not in page.text_content("#modes-words")
    assert page.locator("#modes input[name=mode]:checked").count() == 1
    assert [r.split("\t")[2:] for r in table(shown)] != [r.split("\t")[2:] for r in found]
    page.focus("#way")
    page.keyboard.press("PageUp")
    # until they are found the old ones stay, and are marked so
    page.wait_for_timeout(100)
    assert page.locator("#modes input[name=mode]:checked").count() == 0
    page.click("#home")
    shown.settle()
    assert table(shown) == found
    return found


def newest_answer_only(shown):
    """Asked for two sets of lengths, one after the other, the page shows the poses of the second."""
    page = shown.page
    page.click("#of-file")
    lengths = poses.lengths(shown)
    other = [x * (1 + 0.01 * k) for k, x in enumerate(lengths)]
    poses.type_lengths(shown, other)
    page.click("#solve")
    shown.settle()
    alone = table(shown)
    poses.type_lengths(shown, lengths)
    page.click("#solve")
    page.wait_for_timeout(150)
    poses.type_lengths(shown, other)
    page.click("#solve")
    seen = json.loads(page.evaluate("""() => new Promise((done) => {
      const seen = new Set();
      const look = () => {
        seen.add(document.querySelectorAll('#modes tbody tr').length);
        if (document.documentElement.dataset.busy) setTimeout(look, 5); else done(JSON.stringify([...seen]));
      };
      look();
    })"""))
    shown.settle()
    assert table(shown) == alone and seen == [len(alone)], (seen, len(alone))


def stands_still(shown):
    """Negative control: where the page itself computes, no frame is drawn meanwhile."""
    took, gap = timed(shown)
    assert took > 1000 and gap > took / 2, f"{gap:.0f} of {took:.0f} ms: the measure of frames notices nothing"
    return table(shown)

"""Cheap checks of accessibility: names, tab order, contrast, no sideways scrolling."""

CONTROLS = "button, select, input, canvas[tabindex], [role=slider], summary, [tabindex='0']"

NAMELESS = """(selector) => [...document.querySelectorAll(selector)].filter((node) => {
  if (!node.checkVisibility()) return false;
  const by = (node.getAttribute('aria-labelledby') || '').split(' ').filter(Boolean).map((id) => document.getElementById(id)?.textContent);
  const labels = [...(node.labels || [])].map((l) => {
    const words = l.cloneNode(true);
    words.querySelectorAll('select, input').forEach((n) => n.remove());
    return words.textContent;
  });
  const own = ['BUTTON', 'SUMMARY'].includes(node.tagName) ? [node.textContent] : [];
  const name = [node.getAttribute('aria-label'), ...by, ...labels, ...own].join('').trim();
  return name === '';
}).map((node) => node.outerHTML.slice(0, 120))"""

CONTRAST = """() => {
  const light = (c) => { c /= 255; return c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
  const parse = (text) => text.match(/[\\d.]+/g).slice(0, 4).map(Number);
  const shade = ([r, g, b]) => 0.2126 * light(r) + 0.7152 * light(g) + 0.0722 * light(b);
  const back = (node) => { for (; node; node = node.parentElement) { const c = parse(getComputedStyle(node).backgroundColor); if (c[3] !== 0) return c; } return [255, 255, 255]; };
  const poor = [];
  for (const node of document.querySelectorAll('h1,h2,p,th,td,dt,dd,small,label,button,select,figcaption,span')) {
    if (!node.checkVisibility() || !node.textContent.trim() || node.closest('[disabled]')) continue;
    const [a, b] = [shade(parse(getComputedStyle(node).color)), shade(back(node))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) poor.push(`${ratio.toFixed(2)}: ${node.outerHTML.slice(0, 90)}`);
  }
  return poor;
}"""


def names(shown):
    nameless = shown.page.evaluate(NAMELESS, CONTROLS)
    assert not nameless, nameless
    page = shown.page
    assert page.evaluate("document.documentElement.lang") == "en"
    assert page.locator("h1").count() == 1 and page.title()
    doubles = page.evaluate("(() => { const all = [...document.querySelectorAll('[id]')].map((n) => n.id); return all.filter((id, k) => all.indexOf(id) !== k); })()")
    assert not doubles, doubles
    heads = page.evaluate("[...document.querySelectorAll('tbody tr')].filter((r) => r.checkVisibility() && !r.querySelector('th[scope=row]')).length")
    assert heads == 0, "rows without a heading"


def tab_order(shown):
    """The tabulator reaches every control once, in the order of the document, and leaves the page."""
    page = shown.page
    page.evaluate("document.activeElement.blur(); window.scrollTo(0, 0)")
    expected = page.evaluate("""() => [...document.querySelectorAll("a[href], button, select, input, summary, [tabindex='0']")]
      .filter((n) => n.checkVisibility() && !n.disabled && n.tabIndex >= 0).length""")
    seen = []
    for _ in range(expected + 40):
        page.keyboard.press("Tab")
        place = page.evaluate("""() => { const n = document.activeElement; if (n === document.body) return -1;
          return [...document.querySelectorAll('*')].indexOf(n); }""")
        if place < 0 or place in seen:
            break
        seen.append(place)
    assert seen == sorted(seen), seen
    # radio buttons of a group are one stop
    radios = page.evaluate("[...document.querySelectorAll('input[type=radio]')].filter((n) => n.checkVisibility()).length")
    assert len(seen) >= expected - radios, (len(seen), expected, radios)


def contrast(shown):
    poor = shown.page.evaluate(CONTRAST)
    assert not poor, poor


def narrow(shown):
    width = shown.page.evaluate("[document.documentElement.scrollWidth, window.innerWidth]")
    assert width[0] <= width[1], f"the page scrolls sideways: {width}"


def fitting(shown):
    """Tables that are open need no scrolling sideways."""
    wide = shown.page.eval_on_selector_all(".scroll", "list => list.filter((n) => n.checkVisibility() && n.scrollWidth > n.clientWidth + 1).map((n) => `${n.getAttribute('aria-label')}: ${n.scrollWidth} in ${n.clientWidth}`)")
    assert not wide, wide


def stacked(shown):
    """The two views are one above the other, each as wide as the card."""
    first, second = [shown.page.locator(f"#view-{name}").bounding_box() for name in ("first", "second")]
    assert second["y"] >= first["y"] + first["height"] and first["width"] > 0.8 * shown.page.viewport_size["width"], (first, second)


def spoken(shown):
    """The live region says the new value after a change."""
    page = shown.page
    page.focus("#offset-t1")
    page.keyboard.press("ArrowRight")
    shown.settle()
    assert "det A" in page.text_content("#live"), page.text_content("#live")

"""A design in a link: it opens as it was, and what is not one is refused in words."""

import base64
import json
import zlib

import poses
from program import Opened


def packed(value):
    squeeze = zlib.compressobj(9, zlib.DEFLATED, -15)
    data = squeeze.compress(value if isinstance(value, bytes) else json.dumps(value).encode()) + squeeze.flush()
    return "#design=" + base64.urlsafe_b64encode(data).decode().rstrip("=")


def opens_again(chromium, shown, other):
    """The link, opened on the page of another design, gives design, offsets and pose back."""
    page = shown.page
    page.focus("#offset-t3")
    page.keyboard.press("ArrowRight")
    page.focus("#pose-pitch")
    page.keyboard.press("ArrowRight")
    shown.settle()
    page.click("#share")
    page.locator("#link").wait_for()
    link = page.input_value("#link")
    assert len(link) < 4000, len(link)
    with Opened(chromium, other, fragment="#" + link.split("#")[1]) as again:
        assert again.page.text_content("#name") == page.text_content("#name")
        assert again.offsets() == shown.offsets() and abs(again.det() - shown.det()) < 1e-12
        assert poses.near(poses.pose(again), poses.pose(shown), 1e-9), (poses.pose(again), poses.pose(shown))
        again.quiet()


def refused(chromium, path):
    """A link that holds no design leaves the page as it is, and says so; nothing in it runs."""
    evil = "<img src=x onerror='window.hacked=1'>"
    bombs = [
        "#design=", "#design=***", "#design=AAAA", packed(b"\0" * 3_000_000), packed("text"), packed({"design": 3}),
        packed({"design": f"name = \"{evil}\""}), packed({"design": evil, "start": evil}), packed([1, 2]),
    ]
    for bomb in bombs:
        with Opened(chromium, path, fragment=bomb) as shown:
            note = shown.page.text_content("#note")
            assert "holds no design that can be opened" in note, (bomb[:60], note)
            assert shown.page.text_content("#name") == "octahedral 12-6"
            assert not shown.page.evaluate("window.hacked")
            shown.quiet()

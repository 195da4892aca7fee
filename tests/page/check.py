#!/usr/bin/env python3
"""Pages of several designs in headless Chromium: no errors, no network, the numbers of the command line, accessible.

    python tests/page/check.py target/release/equipod [--pictures FOLDER]
"""

import argparse
import concurrent.futures
import os
import re
import shutil
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

import access
import begin
import behaviour
import cranks
import fresh
import hostile
import limits
import links
import poses
import surfaces
import working
from program import DESIGNS, Opened, Program, browser, unguarded

NO_WASM = "delete window.WebAssembly;"


def octahedral(chromium, program, folder, pictures):
    with Opened(chromium, folder / "octahedral.html") as shown:
        assert shown.ready == "live"
        fresh.same_answers(shown)
        picture(shown, pictures, "octahedral")
        access.names(shown)
        access.tab_order(shown)
        access.contrast(shown)
        access.spoken(shown)
        behaviour.slider_moves_det(shown, program, folder)
        behaviour.derivation_is_that_of_the_command(shown, program, folder)
        behaviour.pointer_drags_a_leg(shown)
        behaviour.no_motion_when_regular(shown)
        behaviour.confirmed_by_the_equivalent(shown)
        behaviour.modes_are_all(shown, program, folder)
        picture(shown, pictures, "octahedral-modes")
        behaviour.singular_at_the_mark(shown, program, folder)
        behaviour.another_design_opens(shown)
        shown.quiet()


def equivalent(chromium, program, folder, pictures):
    path = program.page(DESIGNS / "rbt-griffis-duffy.toml", folder / "equivalent.html")
    with Opened(chromium, path, dark=True) as shown:
        fresh.same_answers(shown)
        det = shown.det()
        assert behaviour.close(det, 0.26208), det
        access.contrast(shown)
        picture(shown, pictures, "equivalent-dark")
        behaviour.slider_moves_det(shown, program, folder)
        for pattern in shown.page.eval_on_selector_all("#pattern option", "list => list.map((o) => o.value)"):
            shown.page.select_option("#pattern", pattern)
        shown.settle()
        access.names(shown)
        shown.quiet()


def spaces(chromium, program, folder, pictures):
    """Over the offsets what violates a requirement is shaded as `assess` says; singular surfaces in space, of offsets and of positions."""
    path = folder / "octahedral.html"
    with Opened(chromium, path) as shown:
        surfaces.shaded_as_assess(shown, program, folder)
        surfaces.stays_while_the_mark_moves(shown)
        surfaces.in_space(shown)
        surfaces.singular_positions(shown, program, folder)
        access.names(shown)
        access.contrast(shown)
        picture(shown, pictures, "surfaces")
        shown.quiet()
    with Opened(chromium, program.page(DESIGNS / "general-6-6.toml", folder / "locus.html"), dark=True) as shown:
        surfaces.singular_positions(shown, program, folder)
        shown.page.check("#locus")
        shown.settle()
        picture(shown, pictures, "locus-dark")
        shown.quiet()


def singular(chromium, program, folder, pictures):
    path = program.page(DESIGNS / "rbt-midline.toml", folder / "midline.html")
    with Opened(chromium, path) as shown:
        assert abs(shown.det()) < 1e-12
        behaviour.self_motion_keeps_the_lengths(shown)
        picture(shown, pictures, "self-motion")
        shown.quiet()


def framed(chromium, program, folder, pictures):
    """Poses are shown and taken in the convention of the design, and the page states the order."""
    text = (DESIGNS / "symmetric-hexapod.toml").read_text()
    design = folder / "framed.toml"
    design.write_text(f'{text}\n[frames]\nrotation_order = "pi"\nrelative_to = "home"\npivot = [0, 0, 40]\n')
    with Opened(chromium, program.page(design, folder / "framed.html")) as shown:
        names = ["x", "y", "z", "rx", "ry", "rz"]
        assert "Rx(a) Ry(b) Rz(c)" in shown.page.text_content("#pose-help")
        field = {name: poses.field(shown.page, name) for name in names}
        assert all(abs(float(field[name].input_value())) < 1e-9 for name in names)
        aim = [4.5, -3.25, 6.0, 5.0, 3.0, 10.0]
        for name, value in zip(names, aim):
            field[name].fill(repr(value))
            shown.page.keyboard.press("Enter")
        shown.settle()
        picture(shown, pictures, "framed")
        asked = ",".join(map(repr, aim))
        assert poses.near(poses.lengths(shown), program.json("ik", design, f"--pose={asked}")["lengths"])
        access.names(shown)
        shown.quiet()


def general(chromium, program, folder, pictures):
    for name in ("general-6-6", "dietmaier"):
        path = program.page(DESIGNS / f"{name}.toml", folder / f"{name}.html")
        with Opened(chromium, path) as shown:
            assert not shown.page.is_visible("#offsets")
            fresh.same_answers(shown)
            behaviour.modes_are_all(shown, program, folder, "design")
            behaviour.modes_for_the_lengths_of_the_file(shown, program, DESIGNS / f"{name}.toml")
            access.names(shown)
            picture(shown, pictures, name)
            shown.quiet()


def rods(chromium, program, folder, pictures):
    """Rods on cranks, light and dark, wide and narrow."""
    path = program.page(cranks.near_home(folder), folder / "rods.html")
    with Opened(chromium, path) as shown:
        assert shown.ready == "live" and not shown.page.is_visible("#locus-label")
        cranks.as_ik(shown, program)
        cranks.beyond_reach(shown)
        cranks.modes_of_angles(shown, program)
        cranks.required(shown, program)
        access.names(shown)
        access.contrast(shown)
        picture(shown, pictures, "rods")
        shown.quiet()
    for width, dark in ((360, False), (390, True), (1360, True)):
        with Opened(chromium, path, width=width, height=780, dark=dark, touch=width < 1000) as shown:
            if width < 1000:
                access.narrow(shown)
            access.contrast(shown)
            picture(shown, pictures, f"rods-{width}-{'dark' if dark else 'light'}")
            shown.quiet()


def required(chromium, program, folder, pictures):
    """A worked design: requirements with margins, a workspace of its own."""
    path = program.page(DESIGNS / "worked" / "positioner-joint-free.toml", folder / "worked.html")
    with Opened(chromium, path) as shown:
        shown.assessed()
        assert shown.page.locator("#margins tbody tr").count() > 0
        picture(shown, pictures, "worked")
        shown.quiet()


def first(chromium, program, folder, pictures):
    """The first view is a platform without shared joints that meets the requirements of the file."""
    for name in ("rbt-octahedral", "worked/linuxcnc-octahedral"):
        path = program.page(DESIGNS / f"{name}.toml", folder / "first.html")
        with Opened(chromium, path) as shown:
            assert shown.page.input_value("#pattern") == "S123456"
            assert shown.page.locator("#margins tbody tr").count() > 0
            assert not limits.violated_here(shown), shown.page.text_content("#margins")
            # every class offers offsets of its own
            options = shown.page.eval_on_selector_all("#pattern option", "list => list.map((o) => o.value)")
            shown.page.select_option("#pattern", options[-1])
            shown.settle()
            assert abs(shown.det()) > 0.05, (options[-1], shown.det())
            shown.quiet()
    path = folder / "octahedral.html"
    with Opened(chromium, path) as shown:
        behaviour.at_the_limit(shown)


def lengths(chromium, program, folder, pictures):
    """Poses to lengths and back, for a design whose joints are plain numbers, for an original and its equivalent, with limits."""
    path = program.page(DESIGNS / "general-6-6.toml", folder / "lengths.html")
    with Opened(chromium, path) as shown:
        poses.one_slider(shown)
        shown.page.click("#home")
        shown.settle()
        poses.there_and_back(shown, "general-6-6")
        poses.pasted_lengths(shown)
        shown.quiet()
    with Opened(chromium, folder / "octahedral.html") as shown:
        poses.of_the_equivalent(shown)
        shown.quiet()
    path = program.page(DESIGNS / "presets" / "bench-l16.toml", folder / "limits.html")
    with Opened(chromium, path) as shown:
        assert "within the limits" in shown.page.text_content("#lengths-state")
        poses.go(shown, [0, 0, 400, 0, 0, 0])
        assert "Beyond the limits" in shown.page.text_content("#lengths-state")
        assert shown.page.locator("#margins td.no").count() > 0


def whole(chromium, program, folder, pictures):
    """The page and `assess` agree on the workspace: met, violated away from home, a singular pose, nothing required."""
    cases = [(DESIGNS / "presets" / "mdx-chair-v3.toml", None), (limits.short_legs(folder), False), (limits.wide(folder), False)]
    for path, met in cases:
        page = program.page(path, folder / "whole.html")
        with Opened(chromium, page) as shown:
            which = "equivalent" if shown.page.is_visible("#offsets") else "design"
            answer = limits.as_assess(shown, program, folder, which)
            assert met is None or answer["met"] is met, (path, answer["met"])
            picture(shown, pictures, f"whole-{path.stem}")
            if path.stem == "short-legs":
                limits.at_its_worst(shown)
            shown.quiet()
    with Opened(chromium, folder / "octahedral.html") as shown:
        assert limits.as_assess(shown, program, folder)["met"] is True
        # beside a singular platform nothing is green
        shown.page.locator(".slider button").first.click()
        shown.settle()
        assert shown.page.text_content("#badge") == "architecturally singular"
        assert shown.page.text_content("#regular-second") == "architecturally singular"
        assert shown.page.text_content("#regular-first") == "architecturally regular"
        assert "good" not in shown.page.get_attribute("#badge", "class")


def shared(chromium, program, folder, pictures):
    """A design in a link."""
    other = program.page(DESIGNS / "general-6-6.toml", folder / "other.html")
    with Opened(chromium, folder / "octahedral.html") as shown:
        links.opens_again(chromium, shown, other)
        shown.quiet()
    links.refused(chromium, folder / "octahedral.html")


def start(chromium, program, folder, pictures):
    """The page without a design."""
    path = program.page(None, folder / "start.html")
    with Opened(chromium, path) as shown:
        access.names(shown)
        access.tab_order(shown)
        access.contrast(shown)
        picture(shown, pictures, "start")
        begin.from_a_data_sheet(shown, program, folder)
        begin.shared_joints(shown)
        begin.what_is_no_hexapod(shown)
        begin.from_points(shown, folder)
        begin.symmetry_is_written(shown, program, folder)
        begin.examples(shown)
        shown.quiet()
    with Opened(chromium, path, width=390, height=780, touch=True) as shown:
        access.narrow(shown)
        picture(shown, pictures, "start-phone")


def hidden(chromium, program, folder, pictures):
    """The first view hides no leg."""
    for name in ("rbt-octahedral", "rbt-griffis-duffy", "general-6-6", "symmetric-hexapod", "presets/bench-l16", "presets/linuxcnc-hexapod"):
        path = program.page(DESIGNS / f"{name}.toml", folder / "hidden.html")
        with Opened(chromium, path) as shown:
            pair = shown.page.is_visible("#figure-second")
            poses.no_leg_hidden(shown, ["view-first", "view-second"][: 1 + pair])


def slow(chromium, program, folder, pictures):
    """While the core computes for seconds the page answers keys and draws; nothing else than the newest answer is shown."""
    whole = program.page(DESIGNS / "dietmaier.toml", folder / "dietmaier.html").read_text()
    path = folder / "slow.html"
    path.write_text(unguarded(working.slowed(whole)))
    with Opened(chromium, path) as shown:
        busy = working.stays_usable(shown)
        working.newest_answer_only(shown)
        shown.quiet()
    # without workers the same answers, and the measure of frames notices that the page stands still
    for what, page, script in (("no workers", path, working.NO_WORKERS), ("a policy without workers", folder / "policy.html", None)):
        (folder / "policy.html").write_text(path.read_text().replace(" worker-src blob:;", ""))
        with Opened(chromium, page, script=script) as shown:
            again = working.stands_still(shown)
            assert again == busy, f"{what}: {again} is not {busy}"
            assert not [r for r in shown.requests if r.startswith("http")]


def foreign(chromium, program, folder, pictures):
    """Files of others in a report, and names of others in a page, are text and pictures. None of their scripts runs,
    and the policy would stop them."""
    hostile.report(chromium, program, folder)
    hostile.names(chromium, program, folder)


def reported(chromium, program, folder, pictures):
    """The report of a usual design: readable in light and dark, wide and narrow, and two sheets of paper."""
    results = folder / "reported"
    results.mkdir()
    design = results / "design.toml"
    design.write_text((DESIGNS / "rbt-octahedral.toml").read_text())
    for command in ("assess", "fk", "check"):
        (results / f"{command}.json").write_text(program.run(command, design, "--json"))
    program.run("plot", "workspace", design, "--resolution", "40", "-o", results / "workspace.svg", "--quiet")
    program.run("report", results, "--quiet")
    for width, dark in ((1200, False), (1200, True), (390, False), (390, True)):
        context = chromium.new_context(viewport={"width": width, "height": 800}, color_scheme="dark" if dark else "light")
        page = context.new_page()
        page.goto((results / "report.html").resolve().as_uri())
        assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), f"the report scrolls sideways at {width}"
        poor = page.evaluate(access.CONTRAST)
        assert not poor, poor
        top = page.text_content("body").split("Pictures")[0]
        assert all(word in top for word in ("regular", "met", "16 finite poses")), top
        if pictures:
            page.screenshot(path=pictures / f"report-{width}-{'dark' if dark else 'light'}.png", full_page=True)
        if not dark and width > 1000:
            pages = len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4")))
            assert pages <= 2, f"the report is printed on {pages} pages"
        context.close()


def printed(chromium, program, folder, pictures):
    """Printed from a dark screen the page is dark on white, with all its tables."""
    with Opened(chromium, folder / "octahedral.html", dark=True) as shown:
        shown.page.emulate_media(media="print")
        shown.settle()
        access.contrast(shown)
        ink = shown.page.evaluate("getComputedStyle(document.body).color")
        assert ink == "rgb(23, 25, 28)", ink
        picture(shown, pictures, "printed")
    for name in ("rbt-octahedral", "general-6-6", "presets/bench-l16"):
        path = program.page(DESIGNS / f"{name}.toml", folder / "paper.html")
        name = Path(name).name
        with Opened(chromium, path) as shown:
            paper = shown.page.pdf(format="A4", path=pictures / f"printed-{name}.pdf" if pictures else None)
            pages = len(re.findall(rb"/Type\s*/Page\b", paper))
            assert 1 <= pages <= 2, f"{name} is printed on {pages} pages"


def phone(chromium, program, folder, pictures):
    path = folder / "octahedral.html"
    for width, dark in ((360, False), (390, True)):
        with Opened(chromium, path, width=width, height=780, dark=dark, touch=True) as shown:
            access.narrow(shown)
            access.fitting(shown)
            access.stacked(shown)
            access.contrast(shown)
            shown.page.locator("#offset-t1").tap()
            shown.settle()
            shown.quiet()
            picture(shown, pictures, f"phone-{'dark' if dark else 'light'}")


def recorded(chromium, program, folder, pictures):
    """Without WebAssembly, in the program or in the browser, the page still shows what was recorded, and says so."""
    bare = program.page(DESIGNS / "rbt-midline.toml", folder / "recorded.html", "--core", "none")
    for path, script in ((bare, None), (folder / "octahedral.html", NO_WASM)):
        with Opened(chromium, path, script=script) as shown:
            assert shown.ready == "recorded" and shown.page.is_visible("#note")
            assert shown.page.locator("#modes input[name=mode]").count() > 0
            before = shown.page.text_content("#pose-words")
            shown.page.focus("#way")
            shown.page.keyboard.press("PageUp")
            shown.settle()
            assert shown.page.text_content("#pose-words") != before
            assert shown.page.locator("#offset-t1").is_disabled()
            access.names(shown)
            picture(shown, pictures, f"recorded-{Path(path).stem}")
            shown.quiet()


def faults(chromium, program, folder, pictures):
    """Negative controls: a page with a planted fault fails the check made for it."""
    whole = (folder / "octahedral.html").read_text()
    planted = {
        "an error": ("new App(core);", "new App(core); setTimeout(() => { throw new Error('planted'); });", lambda s: s.quiet()),
        "a request": ("</main>", "</main><script>fetch('http://example.invalid/x').catch(() => 0)</script>", lambda s: s.quiet()),
        "a wrong det A": ("exact: state.map.det", "exact: state.map.det * (1 + 1e-9)", lambda s: behaviour.slider_moves_det(s, program, folder)),
        "a wrong mode list": ("...rows, last)", "...rows.slice(1), last)", lambda s: behaviour.modes_are_all(s, program, folder)),
        "a control without name": ('<label>Speed', '<label hidden></label><label><select><option>x</option></select></label><label>Speed', access.names),
        "a core of other sources": ('"inverse_condition":', '"inverse_condition":1', fresh.same_answers),
        "a hidden leg": ("seen > best + 1e-3", "best < 0 || seen < best", lambda s: poses.no_leg_hidden(s, ["view-first", "view-second"])),
        "a shade that says nothing": ("violated[row * n + column];", "null;", lambda s: surfaces.shaded_as_assess(s, program, folder)),
        "a workspace that is not examined": ("limits.regular.met === false", "true", lambda s: limits.as_assess(s, program, folder)),
        "pale text": ("--soft:#555c66", "--soft:#b5bcc6", access.contrast),
    }
    for name, (good, bad, check) in planted.items():
        assert good in whole, f"{name}: the place to plant it is gone"
        path = folder / "fault.html"
        path.write_text(unguarded(whole.replace(good, bad, 1)))
        try:
            with Opened(chromium, path) as shown:
                shown.page.wait_for_timeout(350)
                check(shown)
        except AssertionError:
            continue
        raise AssertionError(f"{name} was not noticed")


def picture(shown, folder, name):
    if folder:
        shown.page.evaluate("document.activeElement.blur()")
        shown.page.screenshot(path=folder / f"{name}.png", full_page=True)


CHECKS = [
    rods, faults, first, spaces, lengths, whole, shared, start, framed, octahedral, hidden, slow, required, equivalent, singular, general, phone, recorded, printed, reported, foreign,
]


def run(check, binary, pictures, octahedral_page):
    """One check in a browser and a folder of its own: what it found, and its seconds."""
    began, program = time.monotonic(), Program(binary)
    try:
        with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright, browser(playwright) as chromium:
            folder = Path(folder)
            shutil.copy(octahedral_page, folder)
            check(chromium, program, folder, pictures)
        fault = None
    except Exception as error:  # every check is reported
        fault = f"{type(error).__name__}: {error}"
    return check.__name__, fault, time.monotonic() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--only", nargs="+", help="checks by name")
    args = parser.parse_args()
    if args.pictures:
        args.pictures.mkdir(parents=True, exist_ok=True)
    failed, checks = 0, [check for check in CHECKS if not args.only or check.__name__ in args.only]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        made = Program(args.program).page(DESIGNS / "rbt-octahedral.toml", Path(folder) / "octahedral.html")
        for done in concurrent.futures.as_completed([pool.submit(run, check, args.program, args.pictures, made) for check in checks]):
            name, fault, seconds = done.result()
            failed += fault is not None
            print(f"FAILED  {name}: {fault}" if fault else f"ok      {name}  {seconds:.0f} s", flush=True)
    return 1 if failed or not checks else 0


if __name__ == "__main__":
    sys.exit(main())

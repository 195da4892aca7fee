"""DXF read by ezdxf, SVG and MJCF by libxml2."""

import math
import re
import shutil
import subprocess

from common import absent, compare, module, placed, plate_facts


def near(a, b, tolerance):
    return abs(a - b) <= tolerance


def expected_dimensions(centres, margin):
    """Distances of the holes from the origin where it is on the plate, else from the lowest hole, and over all, along both axes."""
    centres = list(centres)
    on_it = all(min(p[k] for p in centres) - margin <= 0 <= max(p[k] for p in centres) + margin for k in (0, 1))
    out = []
    for k in (0, 1):
        places = []
        for x in sorted(p[k] for p in centres):
            if not places or x - places[-1] > 1e-6:
                places.append(x)
        start = 0 if on_it else places[0]
        out += [abs(x - start) for x in places if abs(x - start) > 1e-6] + [places[-1] - places[0] + 2 * margin]
    return sorted(out)


def check_dxf(folder, name, doc):
    ezdxf = module("ezdxf")
    if ezdxf is None:
        return
    for body in ("base", "platform"):
        plate, centres, _ = plate_facts(doc, body)
        expected = expected_dimensions(centres.values(), plate["margin"])
        def good(path):
            drawing = ezdxf.readfile(path)
            audit, space = drawing.audit(), drawing.modelspace()
            if audit.errors or audit.fixes:
                return f"{len(audit.errors)} errors, {len(audit.fixes)} fixes"
            if drawing.dxfversion != "AC1009" or drawing.header.get("$INSUNITS") != 4:
                return "version or unit"
            circles = [(c.dxf.center.x, c.dxf.center.y, 2 * c.dxf.radius) for c in space.query("CIRCLE")]
            for joint, p in centres.items():
                if not any(near(x, p[0], 1e-6) and near(y, p[1], 1e-6) and near(d, plate["hole_diameter"], 1e-9) for x, y, d in circles):
                    return f"no hole under {joint}"
            texts = {t.dxf.text for t in space.query("TEXT[layer=='NAMES']")}
            if len(circles) != len(plate["holes"]) or not all(any(joint in t for t in texts) for joint in centres):
                return "holes without name"
            ends = []
            for e in space.query("LINE[layer=='OUTLINE']").extend(space.query("ARC")):
                a, b = (e.start_point, e.end_point) if e.dxftype() == "ARC" else (e.dxf.start, e.dxf.end)
                ends += [(a.x, a.y), (b.x, b.y)]
            if not all(sum(math.dist(p, q) < 1e-6 for q in ends) == 2 for p in ends):
                return "outline not closed"
            measured = sorted(d.get_measurement() for d in space.query("DIMENSION"))
            if len(measured) != len(expected) or not all(near(x, y, 1e-6) for x, y in zip(measured, expected)):
                return f"dimensions {measured} instead of {expected}"
            for d in space.query("DIMENSION"):
                shown = [t.dxf.text for t in drawing.blocks.get(d.dxf.geometry).query("TEXT")]
                if shown != [f"{d.get_measurement():.3f}"]:
                    return f"a dimension of {d.get_measurement()} shows {shown}"
            return ""
        path, wrong = folder / f"{body}-plate.dxf", folder / "wrong.dxf"
        def moved(entity, code):
            def fault(text):
                at = text.index(f"  0\n{entity}\n", text.index("ENTITIES"))
                return text[:at] + re.sub(rf"^( {code}\n)(.*)\n", lambda m: f"{m[1]}{float(m[2]) + 1e-3}\n", text[at:], count=1, flags=re.M)
            return fault
        compare(f"{name} dxf {body} (ezdxf): holes, names, outline, dimensions; a hole 1e-3 mm off", good, path, wrong, moved("CIRCLE", 10))
        # the first hole may lie on the line that is measured from
        compare(f"{name} dxf {body}, a dimension 1e-3 mm off", good, path, wrong, moved("DIMENSION", 14))


def check_svg(folder, name, doc):
    """Balls of the three views are where the joints are, at one scale."""
    module_ = module("lxml")
    if module_ is None:
        return
    from lxml import etree
    joints = [placed(doc, b, j["at"]) for b in ("base", "platform") for j in doc[b]["joints"]]
    names = [j["name"] for b in ("base", "platform") for j in doc[b]["joints"]]
    def good(path):
        root = etree.parse(str(path)).getroot()
        find = lambda tag, kind: [e for e in root.iter(f"{{http://www.w3.org/2000/svg}}{tag}") if kind in e.get("class", "").split()]
        balls = [(float(e.get("cx")), float(e.get("cy"))) for e in find("circle", "ball")]
        labels = [e.text for e in find("text", "halo")]
        if len(balls) != 3 * len(joints) or any(labels.count(n) < 3 for n in names) or len(find("line", "axis")) != 18:
            return f"{len(balls)} balls, {len(labels)} labels"
        scales = []
        for view, (across, up) in enumerate(((0, 1), (0, 2), (1, 2))):
            seen = balls[view * len(joints):(view + 1) * len(joints)]
            for page, axis, sign in ((0, across, 1), (1, up, -1)):
                xs, ys = [j[axis] for j in joints], [sign * s[page] for s in seen]
                mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
                scale = sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)
                if max(abs(y - my - scale * (x - mx)) for x, y in zip(xs, ys)) > 0.011:
                    return f"view {view + 1} is off"
                scales.append(scale)
        return "" if max(scales) / min(scales) - 1 < 1e-3 else f"scales {scales}"
    compare(f"{name} svg (lxml): joints of the three views", good, folder / "three-views.svg", folder / "wrong.svg",
            lambda text: re.sub(r'(class="ball" cx=")([0-9.]+)', lambda m: m[1] + f"{float(m[2]) + 0.05:.2f}", text, count=1))


def check_xml(folder, name):
    xmllint = shutil.which("xmllint")
    if xmllint is None:
        absent("xmllint (a program, not a Python package)")
        return
    def good(path):
        out = subprocess.run([xmllint, "--noout", "--nonet", str(path)], capture_output=True, text=True)
        return out.stderr.strip()
    for file in ("three-views.svg", "platform.xml"):
        compare(f"{name} {file} (xmllint)", good, folder / file, folder / "wrong.xml", lambda text: text.replace("/>", ">", 1))

"""STEP and STL, read and measured by OCCT."""

import math
import re

from common import compare, cross, module, placed, planted, plate_facts


def step_solids(path):
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    reader = STEPControl_Reader()
    if reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise ValueError("not read")
    reader.TransferRoots()
    explorer = TopExp_Explorer(reader.OneShape(), TopAbs_ShapeEnum.TopAbs_SOLID)
    out = []
    while explorer.More():
        out.append(explorer.Current())
        explorer.Next()
    return out


def step_facts(solid):
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.GProp import GProp_GProps
    from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS
    props = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, props)
    centre = props.CentreOfMass()
    cylinders, spheres, faces = [], [], 0
    explorer = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        faces += 1
        cast = getattr(TopoDS, "Face_s", None) or TopoDS.Face
        face = cast(explorer.Current())
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            c = surface.Cylinder()
            o, d = c.Axis().Location(), c.Axis().Direction()
            reversed_ = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
            cylinders.append(((o.X(), o.Y(), o.Z()), (d.X(), d.Y(), d.Z()), c.Radius(), reversed_))
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Sphere:
            spheres.append(surface.Sphere().Radius())
        explorer.Next()
    return {
        "valid": BRepCheck_Analyzer(solid).IsValid(),
        "volume": props.Mass(),
        "centre": (centre.X(), centre.Y(), centre.Z()),
        "cylinders": cylinders,
        "spheres": spheres,
        "faces": faces,
    }


def tree(path):
    """The assembly as OCCT reads it: of each place its name, the name of what is placed, and the places in it; None where it is none."""
    from OCP.collections import Sequence_TDF_Label
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDF import TDF_Label
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool
    document = TDocStd_Document(TCollection_ExtendedString("step"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.ReadFile(str(path))
    reader.Transfer(document)
    tool, free = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()), Sequence_TDF_Label()
    tool.GetFreeShapes(free)
    if free.Length() != 1 or not XCAFDoc_ShapeTool.IsAssembly_s(free.Value(1)):
        return None
    def named(label):
        name = TDataStd_Name()
        return str(name.Get().ToExtString()) if label.FindAttribute(TDataStd_Name.GetID_s(), name) else ""
    def places(label):
        found, out = Sequence_TDF_Label(), []
        XCAFDoc_ShapeTool.GetComponents_s(label, found)
        for k in range(1, found.Length() + 1):
            placed_ = TDF_Label()
            XCAFDoc_ShapeTool.GetReferredShape_s(found.Value(k), placed_)
            out.append((named(found.Value(k)), named(placed_), places(placed_)))
        return out
    return places(free.Value(1))


def tree_fault(path, doc):
    """The fault of the assembly: base and platform with plate and joints, six legs with cylinder and rod, equal legs of
    one part."""
    whole = tree(path)
    if whole is None or [p[0] for p in whole] != ["base", "platform"] + [f"leg {k}" for k in range(1, 7)]:
        return f"parts of the whole: {whole and [p[0] for p in whole]}"
    for (body, _, inside) in whole[:2]:
        names = [p[0] for p in inside if not p[0].startswith(("post of", "housing of"))]
        if sorted(names) != sorted([f"{body} plate"] + [j["name"] for j in doc[body]["joints"]]):
            return f"parts of the {body}: {names}"
        if any("joint of the " + body not in p[1] for p in inside if p[0] in {j["name"] for j in doc[body]["joints"]}):
            return f"joints of the {body}: {[p[1] for p in inside]}"
    if any([p[0] for p in inside] != ["cylinder", "rod"] for _, _, inside in whole[2:]):
        return "parts of a leg"
    for a, leg in zip(whole[2:], doc["legs"]):
        for b, other in zip(whole[2:], doc["legs"]):
            if abs(leg["home_length"] - other["home_length"]) > 1e-7 * leg["home_length"] and a[1] == b[1]:
                return f"{a[0]} and {b[0]} differ and are one part"
            # of the designs checked all joints of a body are of one kind
            if abs(leg["home_length"] - other["home_length"]) < 1e-9 * leg["home_length"] and a[1] != b[1]:
                return f"{a[0]} and {b[0]} are equal and two parts"
    return ""


def common_volume(a, b):
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    props = GProp_GProps()
    BRepGProp.VolumeProperties_s(BRepAlgoAPI_Common(a, b).Shape(), props)
    return abs(props.Mass())


def moved_by(solid, v):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
    from OCP.gp import gp_Trsf, gp_Vec
    by = gp_Trsf()
    by.SetTranslation(gp_Vec(*v))
    return BRepBuilderAPI_Transform(solid, by, True).Shape()


def telescope_fault(solids, doc, joints, limits):
    """The fault of rods in the bores of their cylinders. Over the stroke no rod cuts into its cylinder, and none leaves
    it unless the file says so."""
    for leg, (cylinder, rod), d in zip(doc["legs"], [solids[k:k + 2] for k in range(0, 12, 2)], directions(doc, joints)):
        listed = [p["lengths"][leg["leg"] - 1] for p in doc["workspace"] + doc["trajectory"]] + [leg["home_length"]]
        least, greatest = limits or (min(listed), max(listed))
        tip, mouth = doc["platform"]["ball_diameter"] / 2, leg["cylinder_length"]
        least = min(max(least, mouth + tip), leg["home_length"])
        for length in (least, leg["home_length"], greatest):
            common = common_volume(cylinder, moved_by(rod, [x * (length - leg["home_length"]) for x in d]))
            if common > 1e-6 * leg["rod_diameter"] ** 3:
                return f"leg {leg['leg']} at {length}: rod and cylinder share {common} mm^3"
            tail = length - tip - leg["rod_length"]
            if limits and not doc["base"]["ball_diameter"] / 2 < tail < mouth:
                return f"leg {leg['leg']} at {length}: the rod begins at {tail}, the cylinder ends at {mouth}"
    return ""


def directions(doc, joints):
    at = {(b, j["name"]): placed(doc, b, j["at"]) for b, j in joints}
    for leg in doc["legs"]:
        a, b = at[("base", leg["base_joint"])], at[("platform", leg["platform_joint"])]
        yield [(y - x) / math.dist(a, b) for x, y in zip(a, b)]


def distance_to_axis(p, axis):
    return math.hypot(*cross(axis[1], [a - b for a, b in zip(p, axis[0])]))


def expected_legs(doc, joints):
    """Ends and volume of cylinder and rod of each leg. The rod ends at the ball of the platform, and the floor of the
    bore is as thick as its wall."""
    at = {(b, j["name"]): placed(doc, b, j["at"]) for b, j in joints}
    rb, rp = (doc[b]["ball_diameter"] / 2 for b in ("base", "platform"))
    for leg, d in zip(doc["legs"], directions(doc, joints)):
        a = at[("base", leg["base_joint"])]
        thick, thin, mouth, rod = (leg[k] for k in ("cylinder_diameter", "rod_diameter", "cylinder_length", "rod_length"))
        floor = rb + min((thick - thin) / 2, (mouth - rb) / 2)
        head = leg["home_length"] - rp
        def solid(pieces):
            volume = sum(v for v, _ in pieces)
            along = sum(v * z for v, z in pieces) / volume
            return [x + y * along for x, y in zip(a, d)], volume
        area = lambda diameter: math.pi * diameter**2 / 4
        whole, bore = (area(thick) * (mouth - rb), (mouth + rb) / 2), (-area(thin) * (mouth - floor), (mouth + floor) / 2)
        yield leg["leg"], *solid([whole, bore])
        yield leg["leg"], *solid([(area(thin) * rod, head - rod / 2)])


def check_step(folder, name, doc, limits=None):
    if module("OCP", "cadquery-ocp") is None:
        return
    joints = [(b, j) for b in ("base", "platform") for j in doc[b]["joints"]]
    posts = sum(h["post"] > 0 for b in ("base", "platform") for h in doc[b]["plate"]["holes"])
    def good(path):
        solids = step_solids(path)
        facts = [step_facts(s) for s in solids]
        if not facts or not all(f["valid"] for f in facts):
            return "invalid solid"
        balls = [f for f in facts if f["spheres"]]
        # a bore is turned inwards too, and ends in a leg
        plates = [f for f in facts[:-12] if any(c[3] for c in f["cylinders"])]
        if len(facts) != 2 + len(joints) + 12 + posts or len(balls) != len(joints) or len(plates) != 2:
            return f"{len(facts)} solids, {len(balls)} balls, {len(plates)} plates"
        if why := tree_fault(path, doc):
            return why
        for body, joint in joints:
            at, r = placed(doc, body, joint["at"]), doc[body]["ball_diameter"] / 2
            if not any(math.dist(b["centre"], at) < 1e-6 and abs(b["volume"] / (4 / 3 * math.pi * r**3) - 1) < 1e-6 for b in balls):
                return f"no ball at {joint['name']}"
        for body, plate_solid in zip(("base", "platform"), plates):
            plate, _, area = plate_facts(doc, body)
            if abs(plate_solid["volume"] / (area * plate["thickness"]) - 1) > 1e-6:
                return f"volume of the {body} plate {plate_solid['volume']} against {area * plate['thickness']}"
            holes = [c for c in plate_solid["cylinders"] if c[3]]
            if len(holes) != len(plate["holes"]):
                return f"{len(holes)} holes"
            for joint in doc[body]["joints"]:
                at = placed(doc, body, joint["at"])
                if not any(distance_to_axis(at, h) < 1e-6 and abs(2 * h[2] - plate["hole_diameter"]) < 1e-9 for h in holes):
                    return f"no hole under {joint['name']}"
        rest = [f for f in facts if f not in balls and f not in plates]
        for leg, middle, volume in expected_legs(doc, joints):
            if not any(math.dist(f["centre"], middle) < 1e-6 and abs(f["volume"] / volume - 1) < 1e-6 for f in rest):
                return f"no body of leg {leg}"
        return telescope_fault(solids[-12:], doc, joints, limits)
    path, wrong = folder / "platform.step", folder / "wrong.step"
    def wider(entity, factor):
        def fault(text):
            found = re.search(entity + r"\('',#\d+,([^)]*)\)", text)
            return text[:found.start(1)] + repr(float(found[1]) * factor) + text[found.end(1):]
        return fault
    compare(f"{name} step (OCCT): assembly, valid solids, volumes, holes, balls, legs; a ball 1e-4 wider", good, path, wrong, wider("SPHERICAL_SURFACE", 1.0001))
    # the place of a rod in the part of its leg
    def moved(text):
        rod = re.search(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\('2','rod'.*?ITEM_DEFINED_TRANSFORMATION\('','',#\d+,#(\d+)\)", text, re.S)
        frame = re.search(rf"#{rod[1]}=AXIS2_PLACEMENT_3D\('',#(\d+),", text)
        at = re.search(rf"#{frame[1]}=CARTESIAN_POINT\('',\([^,]*,[^,]*,([^)]*)\)", text)
        return text[:at.start(1)] + repr(float(at[1]) + 1e-4) + text[at.end(1):]
    compare(f"{name} step, a rod 1e-4 mm off", good, path, wrong, moved)
    planted(f"{name} step, a leg by another name", good, path, wrong, lambda text: text.replace("'leg 3'", "'leg 33'", 1))


def check_stl(folder, name, doc):
    """Closed, oriented, of the right volume: nodes merged by OCCT."""
    if module("OCP", "cadquery-ocp") is None:
        return
    from OCP.RWStl import RWStl
    for body in ("base", "platform"):
        plate, _, area = plate_facts(doc, body)
        posts = sum(h["post"] for h in plate["holes"]) * math.pi * doc[body]["ball_diameter"] ** 2 / 4
        expected = area * plate["thickness"] + posts
        def good(path):
            mesh = RWStl.ReadFile_s(str(path))
            if mesh is None:
                return "not read"
            nodes = [mesh.Node(k + 1).Coord() for k in range(mesh.NbNodes())]
            edges, volume = {}, 0.0
            for k in range(mesh.NbTriangles()):
                t = mesh.Triangle(k + 1).Get()
                for edge in zip(t, t[1:] + t[:1]):
                    edges[edge] = edges.get(edge, 0) + 1
                a, b, c = (nodes[i - 1] for i in t)
                volume += sum(x * y for x, y in zip(a, cross(b, c))) / 6
            if any(n != edges.get((b, a), 0) for (a, b), n in edges.items()):
                return "not closed"
            return "" if abs(volume / expected - 1) < 2e-3 else f"volume {volume} instead of {expected}"
        compare(f"{name} stl {body} (OCCT): closed, volume", good, folder / f"{body}-plate.stl", folder / "wrong.stl",
                lambda text: "\n".join(text.splitlines()[:1] + text.splitlines()[8:]))

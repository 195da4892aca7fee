"""STEP and STL, read and measured by OCCT."""

import math
import re

from common import compare, cross, module, placed, plate_facts


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


def products(path):
    """Names of the parts of the assembly, one for each place."""
    from OCP.collections import Sequence_TDF_Label
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
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
    places = Sequence_TDF_Label()
    XCAFDoc_ShapeTool.GetComponents_s(free.Value(1), places)
    names = []
    for k in range(1, places.Length() + 1):
        name = TDataStd_Name()
        names.append(str(name.Get().ToExtString()) if places.Value(k).FindAttribute(TDataStd_Name.GetID_s(), name) else "")
    return names


def distance_to_axis(p, axis):
    return math.hypot(*cross(axis[1], [a - b for a, b in zip(p, axis[0])]))


def expected_legs(doc, joints):
    """Middle and volume of cylinder and rod of each leg."""
    at = {(b, j["name"]): placed(doc, b, j["at"]) for b, j in joints}
    rb, rp = (doc[b]["ball_diameter"] / 2 for b in ("base", "platform"))
    for leg in doc["legs"]:
        a, b = at[("base", leg["base_joint"])], at[("platform", leg["platform_joint"])]
        length = math.dist(a, b)
        d = [(y - x) / length for x, y in zip(a, b)]
        parts = [(rb, leg["cylinder_length"], leg["cylinder_diameter"]), (leg["cylinder_length"], length - rp, leg["rod_diameter"])]
        for from_, to, diameter in parts:
            middle = [x + y * (from_ + to) / 2 for x, y in zip(a, d)]
            yield leg["leg"], middle, math.pi * diameter**2 / 4 * (to - from_)


def check_step(folder, name, doc):
    if module("OCP", "cadquery-ocp") is None:
        return
    joints = [(b, j) for b in ("base", "platform") for j in doc[b]["joints"]]
    posts = sum(h["post"] > 0 for b in ("base", "platform") for h in doc[b]["plate"]["holes"])
    def good(path):
        facts = [step_facts(s) for s in step_solids(path)]
        if not facts or not all(f["valid"] for f in facts):
            return "invalid solid"
        balls = [f for f in facts if f["spheres"]]
        plates = [f for f in facts if any(c[3] for c in f["cylinders"])]
        if len(facts) != 2 + len(joints) + 12 + posts or len(balls) != len(joints) or len(plates) != 2:
            return f"{len(facts)} solids, {len(balls)} balls, {len(plates)} plates"
        names = products(path)
        if names is None or len(names) != len(facts) or not {"base plate", "platform plate", "rod 6"} | {j["name"] for _, j in joints} <= set(names):
            return f"parts of the assembly: {names}"
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
        return ""
    path, wrong = folder / "platform.step", folder / "wrong.step"
    def wider(entity, factor):
        def fault(text):
            found = re.search(entity + r"\('',#\d+,([^)]*)\)", text)
            return text[:found.start(1)] + repr(float(found[1]) * factor) + text[found.end(1):]
        return fault
    compare(f"{name} step (OCCT): assembly, valid solids, volumes, holes, balls, legs; a ball 1e-4 wider", good, path, wrong, wider("SPHERICAL_SURFACE", 1.0001))
    # the last point is the origin of the assembly, the one before it that of the last rod
    def moved(text):
        last = [m for m in re.finditer(r"CARTESIAN_POINT\('',\(([^,]*),", text)][-2]
        return text[:last.start(1)] + repr(float(last[1]) + 1e-4) + text[last.end(1):]
    compare(f"{name} step, a rod 1e-4 mm off", good, path, wrong, moved)


def check_stl(folder, name, doc):
    """Closed, oriented, of the right volume: nodes merged by OCCT."""
    if module("OCP", "cadquery-ocp") is None:
        return
    from OCP.RWStl import RWStl
    for body in ("base", "platform"):
        plate, _, area = plate_facts(doc, body)
        posts = sum(h["post"] for h in plate["holes"]) * math.pi * doc[body]["ball_diameter"] ** 2 / 4
        wanted = area * plate["thickness"] + posts
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
            return "" if abs(volume / wanted - 1) < 2e-3 else f"volume {volume} instead of {wanted}"
        compare(f"{name} stl {body} (OCCT): closed, volume", good, folder / f"{body}-plate.stl", folder / "wrong.stl",
                lambda text: "\n".join(text.splitlines()[:1] + text.splitlines()[8:]))

"""Answers of all commands in their different outcomes against `equipod design schema`, every object closed, and with planted faults."""

import json
import re
import subprocess

from common import report, run

# keys that an answer may lack: help and path of refusals, what an option adds, what only some outcome has
OPTIONAL = {
    "help", "path", "near", "closure", "notes", "exchanged", "alignment", "output", "counterexample", "sampling", "beyond_precision",
    "instance", "by_virtual_legs", "design", "rearrangements", "conflict", "history", "base", "platform", "squared_lengths", "between",
    "four_planes",
}
# keys of a document whose keys are names or numbers, and those of a design
MAPS = {"base", "platform", "finite_counts", "real_counts"}


def parts(schema, definitions):
    """The alternatives a schema stands for, each with the properties of all its parts in one list."""
    if "$ref" in schema:
        return parts(definitions[schema["$ref"].split("/")[-1]], definitions)
    out = [{k: v for k, v in schema.items() if k not in ("allOf", "anyOf", "oneOf")}]
    for part in schema.get("allOf", []):
        out = [merged(a, b) for a in out for b in parts(part, definitions)]
    for choice in (schema[k] for k in ("anyOf", "oneOf") if k in schema):
        out = [merged(a, b) for a in out for part in choice for b in parts(part, definitions)]
    return out


def merged(a, b):
    out = {**a, **b}
    if "properties" in a and "properties" in b:
        assert not a["properties"].keys() & b["properties"].keys(), "one place for every key"
        out["properties"] = a["properties"] | b["properties"]
    if "required" in a and "required" in b:
        out["required"] = a["required"] + b["required"]
    return out


def closed(schema, definitions):
    """The same schema without room for more: keys that it does not name are faults."""
    if "$ref" in schema:
        return schema
    if any(k in schema for k in ("allOf", "anyOf", "oneOf")):
        return {"anyOf": [closed(part, definitions) for part in parts(schema, definitions)]}
    out = dict(schema)
    if "properties" in out:
        out["properties"] = {name: closed(part, definitions) for name, part in out["properties"].items()}
    for key in ("items", "additionalProperties"):
        if isinstance(out.get(key), dict):
            out[key] = closed(out[key], definitions)
    if out.get("type") == "object":
        out.setdefault("additionalProperties", False)
    return out


def closed_document(schema):
    definitions = schema["$defs"]
    return {"$ref": schema["$ref"], "$defs": {name: closed(part, definitions) for name, part in definitions.items()}}


def short(value):
    """The first two of long lists: the others are alike."""
    if isinstance(value, list):
        return [short(x) for x in (value if len(value) <= 8 else value[:2])]
    return {k: short(x) for k, x in value.items()} if isinstance(value, dict) else value


def places(value, path=(), kind=()):
    """Places in a document, one of each kind: indices of lists do not count, the alternatives of a list do."""
    yield path, kind
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in inner:
        shape = tuple(part) if isinstance(part, dict) else type(part).__name__
        yield from places(part, (*path, key), (*kind, key if isinstance(value, dict) else "*", shape))


def spoilt(document, path, change):
    copy = json.loads(json.dumps(document))
    place = copy
    for key in path[:-1]:
        place = place[key]
    change(place, path[-1])
    return copy


def put(wrong):
    def change(place, key):
        place[key] = wrong
    return change


def drop(place, key):
    del place[key]


def unknown(place, key):
    place[key]["no such key"] = "no such value"


def overlooked(validator, document, seen):
    """Planted faults that the schema does not see: values of a wrong kind, unknown keys, missing keys; one of each kind that is not yet `seen`."""
    document, missed = short(document), []
    if not validator.is_valid(document):
        return ["the shortened document is refused"]
    for path, kind in places(document):
        if kind in seen or not path or path[0] == "schema" and len(path) > 1:
            continue
        seen.add(kind)
        value = document
        for key in path:
            value = value[key]
        faults = [("wrong kind", put(7.5 if isinstance(value, (dict, list, str)) else {"no": "such"}))]
        if isinstance(value, dict) and path != ("schema",):
            faults.append(("unknown key", unknown))
        optional = path[-1] in OPTIONAL or "design" in path or any(key in MAPS for key in path[-2:-1])
        if isinstance(path[-1], str) and not optional:
            faults.append(("missing", drop))
        missed += [f"{what} at {'/'.join(map(str, path))}" for what, change in faults if validator.is_valid(spoilt(document, path, change))]
    return missed


def fixtures(program, folder, root):
    """Designs and tables that bring about the rarer outcomes."""
    made = {}
    octahedral = root / "designs/rbt-octahedral.toml"

    def family(name, offsets):
        made[name] = folder / f"{name}.toml"
        run(program, "equivalents", "family", octahedral, "--pattern", "S123456", f"--offsets={offsets}", "-o", made[name])

    def design(name, source, change):
        path = folder / f"{name}.json"
        run(program, "design", "convert", source, "-o", path)
        data = json.loads(path.read_text())
        change(data)
        path.write_text(json.dumps(data))
        made[name] = path

    def table(name, *rows):
        made[name] = folder / f"{name}.csv"
        made[name].write_text("".join(f"{row}\n" for row in rows))

    def turned(data):
        # a quarter turn about z and a shift of the base frame
        data["base"] = {k: [1 - y, x, z] for k, (x, y, z) in data["base"].items()}
        data.pop("home", None)

    def off(data):
        turned(data)
        next(iter(data["base"].values()))[0] += 0.01

    def four_at_one(data):
        first = data["legs"][0][0]
        data["legs"][:4] = [[first, leg[1]] for leg in data["legs"][:4]]
        data.pop("lengths", None)

    def required(search, **hardware):
        def change(data):
            data["home"] = {"position": [3.0, 1.75, 12.0], "rpy_deg": [0.0, 0.0, 0.0]}
            data["workspace"] = {"translation": [0.5, 0.5, 0.5]}
            data.update({"hardware": hardware} if hardware else {}, optimize=search)
        return change

    def swinging(data):
        required({"variables": ["symmetric_offsets", "joint_axes"]}, leg_length=[9.0, 18.0], base_swing_deg=60.0)(data)
        data["hardware"]["base_axes"] = "optimize"

    family("free", "0.2,0.21,0.22,0.2,0.2,0.23")
    family("outer", "-0.2,0.21,-0.22,0.2,-0.2,0.23")
    general, midline = root / "designs/general-6-6.toml", root / "designs/rbt-midline.toml"
    design("turned", general, turned)
    design("off", general, off)
    design("star", general, four_at_one)
    design("longer", midline, lambda data: data["lengths"].__setitem__(0, data["lengths"][0] + 1e-3))
    design("twins", octahedral, lambda data: data["base"].update(spare=[0.0, 0.0, 1.0]))
    design("apart", octahedral, lambda data: data.update(optimize={"min_joint_distance": 6.5}))
    design("lifted", octahedral, required({"variables": ["home_height"]}, leg_length=[9.0, 18.0]))
    design("conflict", octahedral, required({"variables": ["home_height"]}, leg_length=[14.0, 14.1]))
    design("swinging", octahedral, swinging)
    front = {"variables": ["symmetric_offsets"], "objectives": ["worst_conditioning", "joint_spacing"], "mode": "pareto", "points": 2}
    design("front", octahedral, required(front))
    design("no-front", octahedral, required({**front, "variables": ["home_height"]}, leg_length=[14.0, 14.1]))
    design("crowded", made["outer"], lambda data: required({}, joint_diameter=30.0)(data))
    table("rows", "l1,l2,l3,l4,l5,l6", "18,18,17,16,15,19", "1,1,1,1,1,1")
    # a trajectory needs lengths near those of home
    home = json.loads(run(program, "singular", "poses", octahedral, "--cells", 500, "--json"))["lengths"]
    table("way", *(",".join(str(x + d) for x in home) for d in (0.0, 0.01)), "1,1,1,1,1,1")
    return made


def asked(folder, root, made):
    """Command with arguments and the exit code."""
    shipped = {p.stem: p for p in (root / "designs").rglob("*.toml")}
    octahedral, general, midline, hexapod, gd = (shipped[n] for n in ("rbt-octahedral", "general-6-6", "rbt-midline", "symmetric-hexapod", "rbt-griffis-duffy"))
    innocenti, bench, free = shipped["innocenti-6-4"], shipped["bench-octahedral"], made["free"]
    box = ("--cells", 500)
    return [
        (0, "assess", bench, "--points", 50),
        (1, "assess", made["conflict"], "--points", 50),
        (0, "bench", "--class", "octahedral", "--count", 2),
        (0, "bench", "--class", "octahedral,T05", "--count", 1, "--recheck-every", 0),
        (1, "bench", "--class", "hexapod-home", "--count", 1, "--recheck-every", 0, "--method", "template"),
        (0, "bench", "--noise", "--class", "octahedral", "--count", 1),
        (0, "check", octahedral),
        (1, "check", midline),
        (1, "check", made["longer"]),
        (1, "check", made["star"]),
        (0, "check", gd),
        (0, "shell-completions", "bash"),
        (0, "equivalents-components", octahedral, "--samples", 1),
        (0, "equivalents-components", gd, "--samples", 1),
        (0, "equivalents-components", hexapod, "--family", 1),
        (0, "equivalents-components", general),
        (0, "equivalents-components", midline),
        (0, "design-convert", octahedral, "-o", folder / "converted.json"),
        (2, "error", "fk", "no-such.toml"),
        (2, "error", "fk", root / "Cargo.toml"),
        (2, "error", "fk"),
        (2, "error", "fk", general, "--method", "octic"),
        (1, "error", "equivalents", "topologies", made["star"]),
        (0, "explore", octahedral, "--samples", 1, "-o", folder / "explored"),
        (1, "explore", made["apart"], "--samples", 1, "-o", folder / "none"),
        (0, "export", octahedral, "--to", "csv,svg", "-o", folder / "exported"),
        (1, "export", octahedral, "--to", "all", "--hole-diameter", 20, "--ball-diameter", 25, "--margin", 30, "-o", folder / "exported"),
        (0, "equivalents-family", octahedral),
        (0, "equivalents-family", octahedral, "--pattern", "S123456", "--offsets=0.2,0.21,0.22,0.2,0.2,0.23"),
        (0, "fk", octahedral),
        (0, "fk", octahedral, "--near", "home"),
        (3, "fk", octahedral, "--near", "home", "--lengths", "1,1,1,1,1,1"),
        (0, "fk", octahedral, "--method", "trilateration"),
        (0, "fk", innocenti, "--method", "trilateration"),
        (3, "fk", hexapod, "--method", "trilateration"),
        (0, "fk", octahedral, "--method", "homotopy"),
        (0, "fk", general),
        (0, "fk", midline),
        (0, "fk", midline, "--lengths", "18,18,17,16,15,19"),
        (0, "fk", octahedral, "--lengths", made["rows"]),
        (0, "fk", midline, "--lengths", made["rows"]),
        (2, "fk", general, "--method", "octic", "--lengths", made["rows"]),
        (3, "fk", octahedral, "--near", "home", "--lengths", made["way"]),
        (0, "help", "fk", "--help"),
        (0, "help", "--version"),
        (0, "plot-locus", innocenti, "--leg", 6, "--from", 3, "--to", 7, "--steps", 21),
        (0, "shell-man", "-o", folder / "man"),
        (0, "equivalents-map", octahedral, free),
        (1, "equivalents-map", octahedral, midline),
        (1, "equivalents-map", octahedral, gd, "--exchange", "-o", folder / "exchanged.toml"),
        (0, "equivalents-map", general, made["turned"], "--align", "-o", folder / "aligned.toml"),
        (1, "equivalents-map", general, made["off"], "--align"),
        (0, "equivalents-move", octahedral, "--leg", 1, "--along", 1, "--to", 0.1),
        (0, "equivalents-move", octahedral, "--move", "1:1:0.1", "--move", "2:P2:P4-P5:0.2", "--together"),
        (1, "equivalents-move", octahedral, *(x for m in ("1:P1-P2:P4", "2:P2:P4-P5", "3:P2-P3:P5", "4:P3:P5-P6", "5:P3-P1:P6", "6:P1:P6-P4", "1:P1-P2:P4") for x in ("--move", f"{m}:0.5"))),
        (0, "equivalents-move", octahedral, "--search", "--no-shared-joints", "--no-crossing", "--hole", "base:1.5,2.598076211353316,0"),
        (1, "equivalents-move", innocenti, "--search", "--no-shared-joints", "-o", folder / "found"),
        (1, "equivalents-move", octahedral, "--search", "--hole", "base:5,5,40"),
        (3, "equivalents-move", octahedral, "--search", "--spacing", 1000),
        (0, "optimize", octahedral, "-o", folder / "optimised.toml"),
        (1, "optimize", made["apart"]),
        (0, "optimize", made["lifted"]),
        (1, "optimize", made["conflict"]),
        (0, "optimize", made["swinging"]),
        (0, "optimize", made["front"], "-o", folder / "front.toml"),
        (1, "optimize", made["no-front"]),
        (0, "plot", "modes", octahedral),
        (0, "plot", "det", octahedral, "-o", folder / "det.svg"),
        (0, "design-presets"),
        (0, "design-presets", "bench-l16"),
        (0, "design-presets", "bench-l16", "-o", folder / "l16.toml"),
        (0, "report", folder / "explored"),
        (0, "build-round", octahedral, "--grid", 1, "--trials", 10),
        (0, "build-round", made["outer"], "--grid", 0.25, "--trials", 10, "--free-grid", "-o", folder / "rounded.toml"),
        (1, "build-round", made["crowded"], "--grid", 0.25, "--trials", 10),
        (0, "build-round", hexapod, "--grid", 1, "--trials", 10),
        (0, "design-schema", "fk"),
        (0, "singular-motion", midline, "--sections", 0),
        (1, "singular-motion", octahedral),
        (1, "singular-motion", midline, "--lengths", "18,18,17,16,15,19"),
        (0, "singular-poses", octahedral, *box, "--between", "--samples", 20, "--path", "1,2"),
        (3, "singular-poses", midline, *box),
        (0, "build-tolerances", octahedral, "--bound", "0.1,0.1", "--trials", 10),
        (0, "build-tolerances", made["twins"], "--bound", "0.1,0.1", "--trials", 10, "--points", 20),
        (0, "equivalents-topologies", octahedral, "--rearrangements"),
        (0, "equivalents-topologies", hexapod, "--members", 1),
        (0, "equivalents-topologies", "--members", 1),
        (0, "verify", octahedral, free, "--samples", 1),
        (1, "verify", octahedral, midline, "--samples", 1),
        (1, "verify", general, made["off"], "--samples", 1),
        (0, "verify", general, made["turned"], "--align", "--samples", 1),
        (1, "verify", general, made["off"], "--align", "--samples", 1),
        (0, "view", octahedral, "-o", folder / "view.html"),
    ]


def check_one(program, schema, seen, exit_code, name, *args):
    call = list(map(str, args if name in ("error", "help") else (*name.split("-"), *args)))
    out = subprocess.run([program, *call, "--json"], capture_output=True, text=True)
    document = json.loads(out.stdout)
    title = " ".join(re.sub(r".*/", "", a) for a in call)
    why = complaints(schema, document)
    why += [] if out.returncode == exit_code else [f"exit {out.returncode} instead of {exit_code}"]
    report(f"schema of answers: {title}", not why, "; ".join(why[:2]))
    missed = overlooked(schema, document, seen) if not why else []
    report(f"schema of answers: {title}: planted faults are found", not missed, "; ".join(missed[:3]))
    return document


def complaints(schema, document):
    """What is wrong; of alternatives, with the one that comes nearest."""
    from jsonschema.exceptions import best_match
    worst = best_match(schema.iter_errors(document))
    return [] if worst is None else [f"{'/'.join(map(str, worst.absolute_path))}: {worst.message[-200:]}"]


def check_answers(program, folder, root, designs, schema_of):
    """`schema_of(name, change)` is the validator for the schema after a change."""
    made, schemas, seen = fixtures(program, folder, root), {}, {}
    for exit_code, name, *args in asked(folder, root, made):
        if name not in schemas:
            schemas[name], seen[name] = schema_of(name, closed_document), set()
        document = check_one(program, schemas[name], seen[name], exit_code, name, *args)
        if isinstance(document.get("design"), dict) and name in ("optimize", "build-round", "equivalents-move"):
            why = complaints(designs, document["design"])
            report(f"schema of designs: the design {name} answers", not why, "; ".join(why))
    # the files of `explore` are answers with what docs/cli.md says is added
    for file, name in (("family", "equivalents-family"), ("optimize", "optimize"), ("verify", "verify"), ("fk", "fk")):
        document = json.loads((folder / "explored" / f"{file}.json").read_text())
        added = ["lengths", "lengths_from"] if name == "fk" else []
        why = complaints(schemas[name], {k: v for k, v in document.items() if k not in added}) + [f"no {k}" for k in added if k not in document]
        report(f"schema of answers: {file}.json of explore", not why, "; ".join(why))

"""`equipod design schema`: shipped designs against their schema, and all schemas against that of JSON Schema, by a validator that is not ours."""

import json
import subprocess
import tomllib

from common import module, report, run


def complaints(validator, document):
    return [f"{'/'.join(map(str, e.path))}: {e.message[:90]}" for e in validator.iter_errors(document)]


def without(document, path):
    copy = json.loads(json.dumps(document))
    place = copy
    for key in path[:-1]:
        place = place[key]
    del place[path[-1]]
    return copy


def changed(document, path, value):
    copy = json.loads(json.dumps(document))
    place = copy
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return copy


# changes that neither the schema nor the program takes
WRONG = [
    (["legs"], None),
    (["unit"], "mm"),
    (["legs"], [["P1", "P4"]] * 5),
    (["legs", 0], ["P1", "P4", "P5"]),
    (["base", "P1"], [0.0, 1.0]),
    (["base", "P1"], "here"),
    (["name"], " "),
    (["lengths"], [1.0, 1.0, 1.0, 1.0, 1.0, -1.0]),
    (["home", "quat_wxyz"], [1.0, 0.0, 0.0, 0.0]),
    (["home", "position"], None),
    (["workspace", "grid"], 9),
    (["workspace", "region"], "ball"),
    (["optimize", "objective"], "beauty"),
    (["optimize", "slack"], 0.1),
    (["optimize", "min_abs_det"], 0.0),
    (["hardware"], {"stroke": 1.0}),
    (["hardware"], {"leg_length": [1.0, 2.0], "dead_length": 1.0, "stroke": 1.0}),
    (["speed"], {"linear": -1.0}),
    (["loads"], [{"fixed_to": "ground"}]),
    (["keep_out"], [{"name": "nothing"}]),
]


def check_designs(program, folder, root, validator):
    for path in sorted((root / "designs").rglob("*.toml")):
        file = tomllib.loads(path.read_text())
        why = complaints(validator, file)
        if "vary" in file:
            report(f"schema of designs: {path.relative_to(root)}, a plan of a sweep, is refused", bool(why))
            continue
        report(f"schema of designs: {path.relative_to(root)}", not why, "; ".join(why[:2]))
    as_json = folder / "good.json"
    run(program, "design", "convert", root / "designs/rbt-octahedral.toml", "-o", as_json)
    good = json.loads(as_json.read_text())
    if "rotation" in good["home"]:
        report("schema of designs: a converted design", not complaints(validator, good))
    for path, value in WRONG:
        bad = without(good, path) if value is None else changed(good, path, value)
        file = folder / "bad.json"
        file.write_text(json.dumps(bad))
        ours = subprocess.run([program, "design", "convert", str(file), "-o", str(folder / "out.json")], capture_output=True).returncode
        report(f"schema of designs: {'.'.join(map(str, path))} = {value} is refused by schema and program", bool(complaints(validator, bad)) and ours == 2)


def check_schemas(program, folder, root):
    if module("jsonschema") is None:
        return
    from jsonschema import Draft202012Validator
    def schema_of(name):
        schema = json.loads(run(program, "design", "schema", name))
        Draft202012Validator.check_schema(schema)
        return Draft202012Validator(schema)
    folder.mkdir(exist_ok=True)
    check_designs(program, folder, root, schema_of("design"))
    check_answers(program, root, schema_of)


def check_answers(program, root, schema_of):
    """One answer each of some commands: tests/it/answers has all of them, with a validator of its own that this one is compared with."""
    octahedral = root / "designs/rbt-octahedral.toml"
    for name, *args in (("fk", octahedral), ("check", octahedral), ("optimize", octahedral), ("design-presets",)):
        answer = json.loads(run(program, *name.split("-"), *args, "--json"))
        validator = schema_of(name)
        why = complaints(validator, answer)
        report(f"schema of answers: {name}", not why, "; ".join(why[:2]))
        lacking = without(answer, ["provenance", "version"])
        report(f"schema of answers: {name} without the version is refused", bool(complaints(validator, lacking)))

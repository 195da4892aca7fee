"""`equipod design schema`: shipped designs and answers of all commands against their schemas, by a validator that is not ours.

    python tests/answers/check.py PROGRAM
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "exports"))

from answers import answers
from common import failed, missing, module, passed, report, run


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
        if "vary" in file or path.parent.name == "pentapods":
            report(f"schema of designs: {path.relative_to(root)}, no design of six legs, is refused", bool(why))
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


def closed(schema):
    """The schema with a fault for every key that it does not name."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    out = {key: closed(part) for key, part in schema.items()}

    def shut(part):
        return {**part, "unevaluatedProperties": False} if isinstance(part, dict) else part

    for key in ("properties", "patternProperties"):
        if isinstance(out.get(key), dict):
            out[key] = {name: shut(part) for name, part in out[key].items()}
    if "prefixItems" in out:
        out["prefixItems"] = [shut(part) for part in out["prefixItems"]]
    for key in ("items", "additionalProperties"):
        if key in out:
            out[key] = shut(out[key])
    return out


def check_schemas(program, folder, root):
    if module("jsonschema") is None:
        return
    from jsonschema import Draft202012Validator
    def schema_of(name):
        schema = json.loads(run(program, "design", "schema", name))
        Draft202012Validator.check_schema(schema)
        return Draft202012Validator(schema)
    def answer_of(name):
        schema = closed(schema_of(name).schema)
        return Draft202012Validator({**schema, "unevaluatedProperties": False})
    folder.mkdir(exist_ok=True)
    check_designs(program, folder, root, schema_of("design"))
    check_answers(program, folder, root, answer_of)


def check_answers(program, folder, root, schema_of):
    refusal = subprocess.run([program, "design", "schema", "nothing"], capture_output=True, text=True).stderr
    known = set(re.search(r"\[possible values: (.*?)\]", refusal, re.S)[1].replace(",", " ").split()) - {"design"}
    validators = {name: schema_of(name) for name in known}
    asked = set()
    for call, code, found, name, text in answers(program, root, folder):
        answer = json.loads(text)
        why = complaints(validators[name], answer)
        report(f"answer of {call}", not why and found == code, f"exit {found}, not {code} " * (found != code) + "; ".join(why[:2]))
        if name not in asked:
            asked.add(name)
            faults = [without(answer, ["provenance", "version"]), changed(answer, ["no such key"], 1), changed(answer, ["warnings"], True)]
            report(f"schema of {name}: planted faults are found", all(complaints(validators[name], fault) for fault in faults))
    report("every schema of an answer has a call", asked == known, " ".join(sorted(asked ^ known)))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        check_schemas(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(scratch), pathlib.Path(__file__).resolve().parents[2])
    print(f"{len(passed)} checks passed, {len(failed)} failed")
    sys.exit(bool(failed or missing))

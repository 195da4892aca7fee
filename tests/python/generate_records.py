"""Writes `src/app/python/equipod/records.py`, the types of answers, from the schemas that the program prints.

    python tests/python/generate_records.py PROGRAM [--check]

`PROGRAM` is the command that runs equipod; with `--check` nothing is written, and the exit code says whether the file is as it should be.
"""

import json
import keyword
import pathlib
import re
import subprocess
import sys
import textwrap

ANSWERS = {
    "assess": "AssessAnswer",
    "at": "AtAnswer",
    "build-drives": "DrivesAnswer",
    "build-round": "RoundAnswer",
    "build-tolerances": "TolerancesAnswer",
    "calibrate": "CalibrateAnswer",
    "check": "CheckAnswer",
    "check-pentapod": "PentapodAnswer",
    "compare": "CompareAnswer",
    "equivalents-family": "FamilyAnswer",
    "equivalents-map": "MapAnswer",
    "explore": "ExploreAnswer",
    "fk": "FkAnswer",
    "limits": "LimitsAnswer",
    "motion": "MotionAnswer",
    "optimize": "OptimizeAnswer",
    "singular-locus": "SingularLocusAnswer",
    "singular-poses": "SingularPosesAnswer",
    "verify": "VerifyAnswer",
}
FILE = pathlib.Path(__file__).parents[2] / "src/app/python/equipod/records.py"
HEAD = '''"""Answers as typed records: the fields of `equipod COMMAND --json`, by the same names.

Made from the schemas of the answers by `.ci/generate`; do not edit. What may be absent from a document is None, and so is what is null in it.
"""

from __future__ import annotations

from typing import Any, Literal, Union

from ._record import Record

'''


def parts_of(kind, name):
    """The types between the brackets of `name[..]`; the type itself if it is another."""
    if not kind.startswith(f"{name}["):
        return [kind]
    parts, depth, start = [], 0, len(name) + 1
    for k in range(start, len(kind)):
        depth += {"[": 1, "]": -1}.get(kind[k], 0)
        if depth < 0 or (depth == 0 and kind[k] == ","):
            parts.append(kind[start:k].strip())
            start = k + 1
    return parts


class Types:
    """The definitions of all schemas, by the name of the Python type."""

    def __init__(self):
        self.classes, self.words = {}, {}
        self.names = {}

    def name_of(self, definition):
        words = re.split(r"[^A-Za-z0-9]+", definition)
        if len(words) > 1 or definition.islower():
            return "".join(w[:1].upper() + w[1:] for w in words)
        return definition

    def add(self, schema, answer):
        definitions = schema["$defs"]
        root = schema["$ref"].rsplit("/", 1)[1]
        renamed = {name: answer if name == root else self.name_of(name) for name in definitions}
        taken = set()
        for name, body in definitions.items():
            plain, number = renamed[name].rstrip("0123456789"), 2
            while renamed[name] in taken or self.clashes(renamed[name], body, definitions, renamed):
                renamed[name], number = f"{plain}{number}", number + 1
            taken.add(renamed[name])
        for name, body in definitions.items():
            self.define(renamed[name], body, definitions, renamed)

    def clashes(self, name, body, definitions, renamed):
        """Whether another record has the name: one with a field in common that is of another kind."""
        known = self.classes.get(name)
        if known is None or known[1] is None or "properties" not in body:
            return False
        fields = {}
        self.fields_of(body, definitions, renamed, fields, True, set())
        return any(key in known[1] and known[1][key][0] != kind for key, (kind, _, _) in fields.items())

    def define(self, name, body, definitions, renamed):
        consts = self.consts(body)
        if consts:
            self.words[name] = sorted(set(self.words.get(name, [])) | set(consts))
            return
        fields = {}
        parts = body.get("oneOf") or body.get("anyOf") or []
        if any(part.get("type", "object") != "object" for part in parts):
            # not always an object: what it may be
            self.classes.setdefault(name, (self.plain(body, renamed), None))
            return
        if "properties" in body or "oneOf" in body or "anyOf" in body:
            self.fields_of(body, definitions, renamed, fields, True, set())
        if fields:
            known = self.classes.get(name)
            if known is not None and known[1] is not None and known[1] != fields:
                # the same record in two answers, with what one of them leaves out
                merged = dict(known[1])
                for key, (kind, needed, text) in fields.items():
                    old = merged.get(key)
                    merged[key] = (kind, needed and (old is None or old[1]), text) if old is None or old[0] == kind else old
                fields = merged
            self.classes[name] = (body.get("description", ""), fields)
        else:
            self.classes.setdefault(name, (self.plain(body, renamed), None))

    def consts(self, body):
        if "enum" in body and all(isinstance(x, str) for x in body["enum"]):
            return body["enum"]
        parts = body.get("oneOf") or body.get("anyOf") or []
        found = []
        for part in parts:
            if "const" in part and isinstance(part["const"], str):
                found.append(part["const"])
            elif "enum" in part and part.get("type") == "string":
                found.extend(part["enum"])
            else:
                return []
        return found

    def fields_of(self, body, definitions, renamed, fields, needed, seen):
        if "$ref" in body:
            target = body["$ref"].rsplit("/", 1)[1]
            if target in seen:
                return
            self.fields_of(definitions[target], definitions, renamed, fields, needed, seen | {target})
            return
        required = set(body.get("required", []))
        for key, value in body.get("properties", {}).items():
            kind, always = self.plain(value, renamed), needed and key in required
            old = fields.get(key)
            if old is None:
                fields[key] = (kind, always, value.get("description", ""))
            elif old[0] != kind:
                fields[key] = (self.union([old[0], kind]), old[1] and always, old[2])
        for part in body.get("allOf", []):
            self.fields_of(part, definitions, renamed, fields, needed, seen)
        for group in ("oneOf", "anyOf"):
            for part in body.get(group, []):
                self.fields_of(part, definitions, renamed, fields, False, seen)

    def union(self, kinds):
        parts, words = [], []
        for part in (part for kind in kinds for part in parts_of(kind, "Union")):
            literal = parts_of(part, "Literal")
            if literal != [part]:
                words.extend(w for w in literal if w not in words)
            elif part not in parts:
                parts.append(part)
        if words:
            parts.insert(0, f"Literal[{', '.join(words)}]")
        # None stands last
        parts.sort(key=lambda part: part == "None")
        return parts[0] if len(parts) == 1 else f"Union[{', '.join(parts)}]"

    def plain(self, body, renamed):
        """The Python type of a schema."""
        if body is True or body == {}:
            return "Any"
        if "$ref" in body:
            return renamed[body["$ref"].rsplit("/", 1)[1]]
        consts = self.consts(body)
        if consts:
            return f"Literal[{', '.join(map(repr, consts)).replace(chr(39), chr(34))}]"
        if "const" in body:
            return f"Literal[{json.dumps(body['const'])}]" if isinstance(body["const"], str) else type(body["const"]).__name__
        for group in ("anyOf", "oneOf"):
            if group in body:
                return self.union([self.plain(part, renamed) for part in body[group]])
        kind = body.get("type")
        if isinstance(kind, list):
            return self.union([self.plain({**body, "type": one}, renamed) for one in kind])
        if kind == "array":
            if "prefixItems" in body:
                return f"tuple[{', '.join(self.plain(item, renamed) for item in body['prefixItems'])}]"
            return f"tuple[{self.plain(body.get('items', {}), renamed)}, ...]"
        if kind == "object":
            extra = body.get("additionalProperties")
            return f"dict[str, {self.plain(extra, renamed)}]" if isinstance(extra, dict) else "dict[str, Any]"
        return {"string": "str", "integer": "int", "number": "float", "boolean": "bool", "null": "None"}.get(kind, "Any")

    def text(self):
        out = [HEAD]
        for name, words in sorted(self.words.items()):
            one = f"{name} = Literal[{', '.join(json.dumps(w) for w in words)}]"
            if len(one) > 110:
                lines = "".join(f"    {json.dumps(w)},\n" for w in words)
                one = f"{name} = Literal[\n{lines}]"
            out.append(one + "\n")
        for name, (description, fields) in sorted(self.classes.items()):
            if fields is None:
                continue
            out.append(f'\n\nclass {name}(Record):\n    """{self.sentence(description, name)}"""\n\n')
            for key, (kind, needed, text) in sorted(fields.items(), key=lambda f: not f[1][1]):
                if "Any" not in kind.split("[") and not needed and "None" not in kind:
                    kind = self.union([kind, "None"])
                spelled = key + "_" if keyword.iskeyword(key) or key in ("to_dict",) else key
                if not spelled.isidentifier():
                    continue
                for line in textwrap.wrap(" ".join(text.split()), 100):
                    out.append(f"    #: {line}\n")
                out.append(f"    {spelled}: {kind}\n")
        aliases = {n: b for n, (b, f) in self.classes.items() if f is None}
        while aliases:
            ready = [n for n in sorted(aliases) if not any(re.search(rf"\b{o}\b", aliases[n]) for o in aliases if o != n)]
            if not ready:
                sys.exit(f"types that follow from each other in a circle: {sorted(aliases)}")
            for name in ready:
                out.append(f"\n\n{name} = {aliases.pop(name)}")
        out.append("\n")
        return "".join(out)

    def sentence(self, description, name):
        line = " ".join(description.split()) or name
        return line.replace("\\", "\\\\").replace('"""', "'''")


def generated(program):
    types = Types()
    for command, answer in ANSWERS.items():
        done = subprocess.run([*program, "design", "schema", command], check=True, capture_output=True, text=True)
        types.add(json.loads(done.stdout), answer)
    return types.text()


def main():
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    text = generated(arguments)
    if "--check" in sys.argv:
        if FILE.read_text() != text:
            sys.exit(f"{FILE.name} is not what the schemas say: run .ci/generate")
        return
    FILE.write_text(text)


if __name__ == "__main__":
    main()

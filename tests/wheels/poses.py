"""Poses found by an installed wheel, for comparison between processors.

    python poses.py write FILE     by the package that is installed here
    python poses.py same A B       exit 1 unless both found the same poses with as many certificates
"""

import json
import pathlib
import sys

DESIGNS = pathlib.Path(__file__).resolve().parents[2] / "designs"
NAMES = ("rbt-octahedral", "general-6-6", "presets/linuxcnc-hexapod")


def found():
    import equipod

    out = {}
    for name in NAMES:
        design = equipod.Design.load(DESIGNS / f"{name}.toml")
        solutions = design.fk(design.ik(design.home))
        poses = [[[x.real, x.imag] for x in pose.ravel()] for pose in solutions.T]
        out[name] = {"certified": int(sum(solutions.certified)), "completeness": str(solutions.completeness), "poses": poses}
    original = equipod.Design.load(DESIGNS / "rbt-octahedral.toml")
    equivalent = original.equivalent([0.2, 0.21, 0.22, 0.2, 0.2, 0.23])
    out["verdict"] = str(equipod.verify(original, equivalent.design).verdict)
    return out


def same(a, b):
    """Faults of `b`: each pose of `a` has to be in `b`, up to rounding relative to the largest entry."""
    faults = []
    if a["verdict"] != b["verdict"] or a["verdict"] != "equivalent":
        faults.append(f"verdicts {a['verdict']}, {b['verdict']}")
    for name in NAMES:
        one, two = a[name], b[name]
        for key in ("certified", "completeness"):
            if one[key] != two[key]:
                faults.append(f"{name}: {key} {one[key]}, {two[key]}")
        if len(one["poses"]) != len(two["poses"]) or not one["poses"]:
            faults.append(f"{name}: {len(one['poses'])} and {len(two['poses'])} poses")
            continue
        left = list(two["poses"])
        for pose in one["poses"]:
            size = max(abs(x) for entry in pose for x in entry)

            def away(other):
                return max(abs(x - y) for e, f in zip(pose, other) for x, y in zip(e, f)) / size

            nearest = min(left, key=away)
            if away(nearest) > 1e-8:
                faults.append(f"{name}: the nearest pose is {away(nearest):.1e} away")
            left.remove(nearest)
    return faults


def main():
    if sys.argv[1] == "write":
        with open(sys.argv[2], "w", encoding="utf-8") as file:
            json.dump(found(), file)
        return 0
    both = [json.load(open(path, encoding="utf-8")) for path in sys.argv[2:4]]
    faults = same(*both)
    # a comparison that cannot fail shows nothing
    moved = json.loads(json.dumps(both[1]))
    moved[NAMES[0]]["poses"][0][0][0] += 1e-3
    if not same(both[0], moved):
        faults.append("a moved pose was not seen")
    for fault in faults:
        print(fault, file=sys.stderr)
    counts = ", ".join(f"{name} {len(both[0][name]['poses'])}" for name in NAMES)
    print(f"poses: {counts}; {both[0]['verdict']}; {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

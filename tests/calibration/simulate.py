"""Measures a simulated machine, and compares a calibration with the truth.

    equipod export DESIGN --to json -o FOLDER
    python tests/calibration/simulate.py measure FOLDER/platform.json OUT.csv [--truth TRUTH.json] [--poses N] [--seed S]
        [--shift MM] [--turn DEG] [--outliers N]
    equipod calibrate DESIGN OUT.csv .. --json > ANSWER.json
    python tests/calibration/simulate.py compare TRUTH.json ANSWER.json

The machine is the design with every coordinate of its joints off by 0.3 mm (standard deviation) and encoders that count
from 1.5 mm away. Poses are drawn around home, up to --shift along each axis and --turn about each. They are measured
with errors of 0.01 mm in each coordinate and 0.002 degrees about each axis, lengths with errors of 0.005 mm. The joints
and the home pose come from equipod; lengths are computed here from the definition.
"""

import argparse
import json
import math
import random
import statistics

JOINTS, OFFSETS = 0.3, 1.5
SIGMA_LENGTH, SIGMA_POSITION, SIGMA_ROTATION = 0.005, 0.01, math.radians(0.002)
GROSS = 0.5


def turned(vector):
    """The rotation matrix of a rotation vector."""
    angle = math.sqrt(sum(x * x for x in vector))
    if angle == 0.0:
        return [[float(i == j) for j in range(3)] for i in range(3)]
    x, y, z = (c / angle for c in vector)
    s, c = math.sin(angle), math.cos(angle)
    cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    outer = [[a * b for b in (x, y, z)] for a in (x, y, z)]
    return [[c * (i == j) + s * cross[i][j] + (1 - c) * outer[i][j] for j in range(3)] for i in range(3)]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def applied(r, v):
    return [sum(r[i][k] * v[k] for k in range(3)) for i in range(3)]


def angles(r):
    """Roll, pitch and yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll)."""
    pitch = math.atan2(-r[2][0], math.hypot(r[0][0], r[1][0]))
    return [math.degrees(x) for x in (math.atan2(r[2][1], r[2][2]), pitch, math.atan2(r[1][0], r[0][0]))]


def machine(design, rng):
    """The joints and offsets of the machine that was built."""
    def off(body):
        return {joint["name"]: [x + rng.gauss(0, JOINTS) for x in joint["at"]] for joint in body["joints"]}

    return {
        "base": off(design["base"]),
        "platform": off(design["platform"]),
        "offsets": [rng.gauss(0, OFFSETS) for _ in range(6)],
        "legs": [[leg["base_joint"], leg["platform_joint"]] for leg in design["legs"]],
    }


def lengths(truth, r, p):
    def one(leg, offset):
        a, b = truth["base"][leg[0]], applied(r, truth["platform"][leg[1]])
        return math.dist([x + y for x, y in zip(b, p)], a) + offset

    return [one(leg, offset) for leg, offset in zip(truth["legs"], truth["offsets"])]


def measure(args):
    design = json.load(open(args.design, encoding="utf-8"))
    rng = random.Random(args.seed)
    truth = machine(design, rng)
    home = design["home"]
    w, *v = home["quat_wxyz"]
    n = math.sqrt(sum(x * x for x in v))
    level = turned([x * 2 * math.atan2(n, w) / n for x in v]) if n > 0 else turned([0, 0, 0])
    rows = []
    for _ in range(args.poses):
        r = product(turned([math.radians(args.turn) * rng.uniform(-1, 1) for _ in range(3)]), level)
        p = [x + args.shift * rng.uniform(-1, 1) for x in home["position"]]
        shown = [l + rng.gauss(0, SIGMA_LENGTH) for l in lengths(truth, r, p)]
        seen = product(turned([rng.gauss(0, SIGMA_ROTATION) for _ in range(3)]), r)
        at = [x + rng.gauss(0, SIGMA_POSITION) for x in p]
        rows.append([f"{x:.4f}" for x in at] + [f"{x:.6f}" for x in angles(seen)] + [f"{x:.4f}" for x in shown])
    for k in rng.sample(range(args.poses), args.outliers):
        rows[k][0] = f"{float(rows[k][0]) + GROSS:.4f}"
    with open(args.out, "w", encoding="utf-8") as file:
        file.write("x_mm,y_mm,z_mm,roll_deg,pitch_deg,yaw_deg," + ",".join(f"leg_{i}_mm" for i in range(1, 7)) + "\n")
        file.writelines(",".join(row) + "\n" for row in rows)
    if args.truth:
        with open(args.truth, "w", encoding="utf-8") as file:
            json.dump(truth, file)


def compare(args):
    truth = json.load(open(args.truth, encoding="utf-8"))
    answer = json.load(open(args.answer, encoding="utf-8"))
    found = answer["calibration"]
    errors, shares = [], []
    for joint in found["joints"]:
        meant = truth[joint["body"]][joint["joint"]]
        for x, y, s in zip(joint["position"], meant, joint["deviations"]):
            errors.append(x - y)
            shares.append((x - y) / s)
    for leg in found["offsets"]:
        errors.append(leg["offset"] - truth["offsets"][leg["leg"] - 1])
        shares.append(errors[-1] / leg["deviation"])
    before = [x for joint in found["joints"] for x in joint["moved"]]
    print(f"outcome {answer['outcome']}, rank {found['observability']['rank']} of {found['unknowns']}")
    print(f"joints off the design by {statistics.pstdev(before):.4f} rms (found)")
    print(f"errors of the calibration: rms {statistics.pstdev(errors, 0):.4f}, greatest {max(map(abs, errors)):.4f}")
    print(f"errors over their deviations: rms {statistics.pstdev(shares, 0):.3f}, greatest {max(map(abs, shares)):.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("measure")
    one.add_argument("design")
    one.add_argument("out")
    one.add_argument("--truth")
    one.add_argument("--poses", type=int, default=40)
    one.add_argument("--seed", type=int, default=1)
    one.add_argument("--shift", type=float, default=60.0)
    one.add_argument("--turn", type=float, default=15.0)
    one.add_argument("--outliers", type=int, default=0)
    one.set_defaults(run=measure)
    two = commands.add_parser("compare")
    two.add_argument("truth")
    two.add_argument("answer")
    two.set_defaults(run=compare)
    args = parser.parse_args()
    args.run(args)


if __name__ == "__main__":
    main()

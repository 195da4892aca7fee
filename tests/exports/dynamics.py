"""MuJoCo: the forces, speeds and accelerations of `equipod motion` against inverse dynamics of the exported model.

The simulator's model is a tree with five loops. Its velocities follow from those of the platform by the Jacobians of the platform and of the loops, which the simulator gives; `mj_inverse` gives the forces
that the open tree needs, and the principle of virtual work carries them over to the slides. Nothing of our formulas is used.
"""

import csv
import json
import re

from common import compare, module, run

DESIGN = """
name = "moving"
units = "mm"
force_units = "N"
mass_units = "kg"
legs = [["A1", "B1"], ["A2", "B2"], ["A3", "B3"], ["A4", "B4"], ["A5", "B5"], ["A6", "B6"]]
[base]
A1 = [750, -160, 10]
A2 = [750, 150, 0]
A3 = [-235, 730, 0]
A4 = [-510, 575, -5]
A5 = [-515, -570, 0]
A6 = [-240, -725, 8]
[platform]
B1 = [330, -350, 0]
B2 = [335, 355, 5]
B3 = [140, 460, 0]
B4 = [-470, 110, -4]
B5 = [-475, -105, 0]
B6 = [135, -465, 0]
[home]
position = [10, -20, 800]
rpy_deg = [2, -3, 5]
[hardware]
cylinder_mass = 9.5
cylinder_center = 310
cylinder_inertia = 4.1e5
rod_mass = 4.25
rod_center = 280
reflected_mass = 21.5
[payload]
mass = 120
center = [25, -40, 310]
inertia = [[9.0e6, 4.0e5, -3.0e5], [4.0e5, 7.5e6, 2.0e5], [-3.0e5, 2.0e5, 5.0e6]]
gravity = [0.5, -0.25, -9.8]
"""
HOME = ([10.0, -20.0, 800.0], [2.0, -3.0, 5.0])
# amplitude in mm or degrees, hertz, phase: of the combined motion
COMBINED = [(40, 1.1, 0.3), (30, 0.9, 1.1), (50, 1.3, 2.0), (8, 1.2, 0.5), (6, 0.8, 1.7), (10, 1.0, 2.6)]
RATE, ROWS = 8000, 4001


def turns(np, angles):
    """`Rz Ry Rx` of three angles with their first and second derivatives, and its derivatives."""
    skew = lambda k: np.cross(np.eye(3)[k], np.eye(3)).T
    product = (np.eye(3), np.zeros((3, 3)), np.zeros((3, 3)))
    for k in (2, 1, 0):
        x, v, a = angles[k]
        e = skew(k)
        r = np.eye(3) + np.sin(x) * e + (1 - np.cos(x)) * e @ e
        dr = v * e @ r
        ddr = a * e @ r + v * v * e @ e @ r
        p, dp, ddp = product
        product = (p @ r, dp @ r + p @ dr, ddp @ r + 2 * dp @ dr + p @ ddr)
    return product


def state(np, t, sines):
    """Position, rotation, twist and its derivative, in metres: `sines` are added to the coordinates of home, or turn the platform from there."""
    values = []
    for a, f, phase in sines:
        w = 2 * np.pi * f
        values.append((a * np.sin(w * t + phase), a * w * np.cos(w * t + phase), -a * w * w * np.sin(w * t + phase)))
    p, v, a = ([1e-3 * (HOME[0][k] * (d == 0) + values[k][d]) for k in range(3)] for d in range(3))
    home = turns(np, [(np.radians(x), 0, 0) for x in HOME[1]])[0]
    r, dr, ddr = (m @ home for m in turns(np, [np.radians(values[k]) for k in (3, 4, 5)]))
    vee = lambda m: np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / 2
    return np.array(p), r, np.concatenate([v, vee(dr @ r.T)]), np.concatenate([a, vee(ddr @ r.T + dr @ dr.T)])


class Inverse:
    """The exported model, moved by its platform."""

    def __init__(self, np, mujoco, path):
        self.np, self.mujoco = np, mujoco
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.data = mujoco.MjData(self.model)
        mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        self.site = self.model.site("platform_frame").id
        self.slides = [self.model.joint(f"leg{k}").dofadr[0] for k in range(1, 7)]
        self.loops = list(zip(self.model.eq_obj1id, self.model.eq_obj2id, self.model.eq_data))

    def kinematics(self, q):
        self.data.qpos[:] = q
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_comPos(self.model, self.data)

    def stack(self):
        """Gaps of the loops, and the Jacobians of platform and loops."""
        np, nv = self.np, self.model.nv
        rows = np.zeros((2, 3, nv))
        self.mujoco.mj_jacSite(self.model, self.data, rows[0], rows[1], self.site)
        gaps, parts = [], [rows[0], rows[1]]
        for one, two, anchors in self.loops:
            ends = []
            for body, anchor in ((one, anchors[0:3]), (two, anchors[3:6])):
                at = self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ anchor
                jacobian = np.zeros((3, nv))
                self.mujoco.mj_jac(self.model, self.data, jacobian, None, at, body)
                ends.append((at, jacobian))
            gaps.append(ends[0][0] - ends[1][0])
            parts.append(ends[0][1] - ends[1][1])
        return np.concatenate(gaps), np.vstack(parts)

    def moved(self, q, by):
        out = q.copy()
        self.mujoco.mj_integratePos(self.model, out, by, 1.0)
        return out

    def at(self, position, rotation, twist, change):
        """Forces, speeds and accelerations of the slides."""
        np = self.np
        q = self.data.qpos.copy()
        for _ in range(30):
            self.kinematics(q)
            gaps, rows = self.stack()
            off = position - self.data.site_xpos[self.site]
            turn = rotation @ self.data.site_xmat[self.site].reshape(3, 3).T
            turn = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
            step = np.linalg.solve(rows, np.concatenate([off, turn, -gaps]))
            q = self.moved(q, step)
            if abs(step).max() < 1e-13:
                break
        self.kinematics(q)
        rows = self.stack()[1]
        none = np.zeros(rows.shape[0] - 6)
        speed = np.linalg.solve(rows, np.concatenate([twist, none]))
        sides = []
        for h in (1e-5, -1e-5):
            self.kinematics(self.moved(q, h * speed))
            sides.append(self.stack()[1])
        drift = (sides[0] - sides[1]) @ speed / 2e-5
        acceleration = np.linalg.solve(rows, np.concatenate([change, none]) - drift)
        self.data.qpos[:], self.data.qvel[:], self.data.qacc[:] = q, speed, acceleration
        self.mujoco.mj_inverse(self.model, self.data)
        free = np.linalg.inv(rows)[:, :6]
        forces = np.linalg.solve(free[self.slides].T, free.T @ self.data.qfrc_inverse)
        return forces, speed[self.slides], acceleration[self.slides]


# what of DESIGN is left out, and what the program says instead
LEG_MASSES = ["cylinder_mass", "cylinder_center", "cylinder_inertia", "rod_mass", "rod_center", "reflected_mass"]
VARIANTS = {
    "with all masses": ([], []),
    "legs without masses": (LEG_MASSES, ["assumed massless"]),
    "nothing but the mass of the payload": (["inertia", *LEG_MASSES], ["assumed massless", "a ball is assumed"]),
}


def check_dynamics(program, folder):
    np, mujoco = module("numpy"), module("mujoco", "MuJoCo")
    if np is None or mujoco is None:
        return
    for number, (name, (absent, assumed)) in enumerate(VARIANTS.items()):
        lines = [line for line in DESIGN.split("\n") if line.split(" = ")[0] not in absent]
        check_variant(program, folder / str(number), (name, "\n".join(lines), assumed), (np, mujoco))


def check_variant(program, folder, variant, modules):
    """`motion` and the exported model of one design: the same masses, the same assumptions, the same forces."""
    (name, text, assumed), (np, mujoco) = variant, modules
    folder.mkdir(parents=True, exist_ok=True)
    design, way, out = folder / "moving.toml", folder / "way.csv", folder / "motion.csv"
    design.write_text(text)
    lines = ["t,x,y,z,qw,qx,qy,qz"]
    for k in range(ROWS):
        p, r, _, _ = state(np, k / RATE, COMBINED)
        q = np.zeros(4)
        mujoco.mju_mat2Quat(q, r.flatten())
        lines.append(",".join(repr(float(x)) for x in [k / RATE, *(1000 * p), *q]))
    way.write_text("\n".join(lines) + "\n")
    sines = {"x:60:1": 0, "z:40:2": 2, "roll:9:1.5": 3, "yaw:12:1": 5}
    options = [x for sine in sines for x in ("--sine", sine)]
    moved = json.loads(run(program, "motion", design, way, "--steps", 1, *options, "--samples", 40, "--csv", out, "--json"))
    exported = json.loads(run(program, "export", design, "--to", "mjcf", "-o", folder, "--json"))
    assert moved["assumptions"] == exported["assumptions"], exported["assumptions"]
    assert len(assumed) == len(moved["assumptions"]), moved["assumptions"]
    assert all(any(words in line for line in moved["assumptions"]) for words in assumed), moved["assumptions"]
    rows = list(csv.DictReader(out.open()))
    def chosen():
        """Rows with what the platform does there."""
        moving = [r for r in rows if not r["motion"].startswith("sine")]
        for row in moving[::173]:
            yield row, state(np, float(row["t_s"]), COMBINED)
        for sine, k in sines.items():
            amplitude, frequency = map(float, sine.split(":")[1:])
            alone = [(amplitude if j == k else 0, frequency, 0) for j in range(6)]
            for row in [r for r in rows if r["motion"] == f"sine {sine}"][::3]:
                yield row, state(np, float(row["t_s"]), alone)
    def good(path):
        model = Inverse(np, mujoco, path)
        worst, seen = 0.0, 0
        for row, (position, rotation, twist, change) in chosen():
            forces, speeds, accelerations = model.at(position, rotation, twist, change)
            column = lambda name: np.array([float(v) for key, v in row.items() if key.startswith(name)])
            for found, ours in ((forces, column("force_")), (1000 * speeds, column("speed_")), (1000 * accelerations, column("acceleration_"))):
                # newtons, mm/s, mm/s^2: near a standstill the rest of both is rounding
                scale = max(abs(found).max(), 100.0)
                worst = max(worst, float(abs(found - ours).max() / scale))
            power = column("force_") * column("speed_") / 1000
            worst = max(worst, float(abs(power - column("power_")).max() / max(abs(power).max(), 1.0)))
            seen += 1
        return "" if seen > 70 and worst < 1e-6 else f"{seen} instants, off by {worst:.1e}"
    wrong = folder / "wrong.xml"
    def heavier(text):
        before, after = text.split('<body name="rod2"')
        return before + '<body name="rod2"' + re.sub('mass="([^"]*)"', lambda m: f'mass="{float(m[1]) + 0.01!r}"', after, count=1)
    what = f"motion (MuJoCo), {name}: forces, speeds, accelerations and powers of the legs to 1e-6; a rod 10 g heavier"
    compare(what, good, folder / "platform.xml", wrong, heavier)

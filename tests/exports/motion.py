"""MuJoCo: poses of the workspace reached, an equivalent platform that moves alike."""

import json
import math

from closure import complaint, shifted
from common import compare, module, report, run, table


def poses_of(path, count):
    """Some poses of a table in metres, with our leg lengths."""
    rows = table(path)
    step = max(1, len(rows) // count)
    for row in rows[::step][:count]:
        p = [float(row[k]) / 1000 for k in ("x_mm", "y_mm", "z_mm")]
        q = [float(row[k]) for k in ("qw", "qx", "qy", "qz")]
        yield p, q, [float(row[f"l{i}_mm"]) / 1000 for i in range(1, 7)]


def home_lengths(folder):
    return [float(r["home_length_mm"]) / 1000 for r in table(folder / "legs.csv")]


class Model:
    """A model at its home; `size` in metres scales lengths, and times by its square root."""

    def __init__(self, path, home, size):
        self.mujoco, self.np = module("mujoco"), module("numpy")
        self.model = self.mujoco.MjModel.from_xml_path(str(path))
        self.data = self.mujoco.MjData(self.model)
        self.home, self.size, self.now = self.np.array(home), size, self.np.array(home)
        self.body = self.mujoco.mj_name2id(self.model, self.mujoco.mjtObj.mjOBJ_BODY, "platform")
        self.mujoco.mj_resetDataKeyframe(self.model, self.data, 0)

    def move(self, lengths, seconds):
        """Smoothly to these lengths in `seconds`, then at rest as long."""
        steps = max(1, int(seconds / self.model.opt.timestep))
        start, end = self.now, self.np.array(lengths)
        for k in range(2 * steps):
            s = min(1.0, (k + 1) / steps)
            self.data.ctrl[:] = start + (end - start) * s**3 * (10 - 15 * s + 6 * s * s) - self.home
            self.mujoco.mj_step(self.model, self.data)
        self.now = end
        self.mujoco.mj_forward(self.model, self.data)

    def settle(self, steps):
        """Until nothing moves any more, in at most `steps`; whether it came to rest."""
        for _ in range(steps):
            self.mujoco.mj_step(self.model, self.data)
            if self.speed() < 1e-8:
                return True
        return False

    def limits(self):
        """Least and greatest length of each leg, rounded to 1e-12 of the size; empty where the slides have none."""
        slides = [self.mujoco.mj_name2id(self.model, self.mujoco.mjtObj.mjOBJ_JOINT, f"leg{k}") for k in range(1, 7)]
        ends = [(h + self.model.jnt_range[j]) / self.size for h, j in zip(self.home, slides) if self.model.jnt_limited[j]]
        return [[round(float(x), 12) for x in e] for e in ends]

    def speed(self):
        return float(abs(self.data.qvel).max()) * math.sqrt(self.size)

    def pose(self):
        self.mujoco.mj_forward(self.model, self.data)
        return self.data.xpos[self.body].copy(), self.data.xmat[self.body].reshape(3, 3).copy()

    def gap(self):
        worst = 0.0
        for e in range(self.model.neq):
            a, b = self.model.eq_obj1id[e], self.model.eq_obj2id[e]
            one = self.data.xpos[a] + self.data.xmat[a].reshape(3, 3) @ self.model.eq_data[e][0:3]
            two = self.data.xpos[b] + self.data.xmat[b].reshape(3, 3) @ self.model.eq_data[e][3:6]
            worst = max(worst, float(self.np.linalg.norm(one - two)))
        return worst


def check_mujoco(folder, name, time, range_):
    """`range_`: least and greatest length in metres by the design file, or None. `time` of a move over the square root of the size; None: lengths do not hold the platform, only the loops are looked at."""
    mujoco = module("mujoco")
    if mujoco is None or module("numpy") is None:
        return
    home = home_lengths(folder)
    size = max(home)
    moves = list(poses_of(folder / "lengths-workspace.csv", 4))
    if sum(max(abs(x - y) for x, y in zip(home, m[2])) > 1e-3 * size for m in moves) < 3:
        report(f"{name} mjcf (MuJoCo): moves to look at", False)
    limits = [[round(x / size, 12) for x in range_]] * 6 if range_ else []
    def good(path):
        for pose in moves:
            model = Model(path, home, size)
            if (model.model.nv, model.model.neq, model.model.nu) != (21, 5, 6):
                return f"nv {model.model.nv}, neq {model.model.neq}, nu {model.model.nu}"
            if model.limits() != limits:
                return f"slides from {model.limits()} instead of {limits}"
            model.move(pose[2], (time or 2.0) * math.sqrt(size))
            why = complaint(model.gap(), *model.pose(), pose, size) if time else ("" if model.gap() < 1e-6 else f"gap {model.gap():.1e}")
            if why:
                return why
        return ""
    what = "loops closed, poses reached" if time else "loops closed"
    path, wrong = folder / "platform.xml", folder / "wrong.xml"
    if time:
        compare(f"{name} mjcf (MuJoCo {mujoco.__version__}): {what}; a rod a thousandth off", good, path, wrong, shifted("rod3", size))
    else:
        compare(f"{name} mjcf (MuJoCo {mujoco.__version__}): {what}; a connect less", good, path, wrong,
                lambda text: text[:text.index("    <connect")] + text[text.index("\n", text.index("<connect")) + 1:])


def trajectory(folder, design, path):
    """The octahedral design with a trajectory."""
    text = design.read_text().replace("grid = 2\n", f'grid = 1\ntrajectory = "{path.name}"\n')
    path.write_text("3,5.196152422706632,15,0,0,0\n3.5,5,16,0,0,10\n4,4.5,15.5,6,-5,0\n2.5,5.5,14.5,-4,6,-8\n")
    out = folder / "moving.toml"
    out.write_text(text)
    return out


def check_equivalent(program, folder, original):
    """The octahedral platform with lengths l and its joint-free equivalent with m = sqrt(A l^2 + c) along a trajectory."""
    np = module("numpy")
    if module("mujoco") is None or np is None:
        return
    moving = trajectory(folder, original, folder / "path.csv")
    free = folder / "free.toml"
    run(program, "family", original, "--pattern", "S123456", "--offsets=0.2,0.21,0.22,0.2,0.2,0.23", "-o", free)
    leg_map = json.loads(run(program, "map", original, free, "--json"))
    a, c = np.array(leg_map["A"]), np.array(leg_map["c"])
    for key, design in (("octahedral", moving), ("free", free)):
        run(program, "export", design, "--to", "mjcf,csv", "-o", folder / key, "--gravity-compensation")
    home = {key: home_lengths(folder / key) for key in ("octahedral", "free")}
    size = max(home["octahedral"])
    poses = list(poses_of(folder / "octahedral/lengths-trajectory.csv", 1000))
    def along(a, c, ours):
        """Largest difference of the two poses, and of the first from ours, on the way; to the first that is too large."""
        pair = [Model(folder / key / "platform.xml", home[key], size) for key in ("octahedral", "free")]
        worst = [0.0, 0.0]
        for p, q, lengths in poses:
            squares = a @ (np.array(lengths) * 1000) ** 2 + c
            for model, to in zip(pair, (lengths, np.sqrt(squares) / 1000)):
                model.move(to, 0.1 * math.sqrt(size))
                if not model.settle(4000):
                    return [1.0, 1.0]
            (p1, r1), (p2, r2) = (m.pose() for m in pair)
            worst[0] = max(worst[0], float(np.linalg.norm(p1 - p2)) / size, float(abs(r1 - r2).max()))
            worst[1] = max(worst[1], float(np.linalg.norm(p1 - np.array(p))) / size)
            if not max(worst) < 1e-6:
                break
        return worst
    alike, right = along(a, c, poses)
    report(f"octahedral platform and joint-free equivalent, m = sqrt(A l^2 + c), move alike at {len(poses)} poses along a trajectory (MuJoCo)",
           len(poses) > 50 and alike < 1e-6 and right < 1e-6, f"apart {alike:.1e}, from ours {right:.1e} of the size")
    spoilt = a.copy()
    spoilt[0, 0] += 1e-3
    report("the same with an entry of A off by 1e-3: planted fault is found", along(spoilt, c, poses)[0] > 1e-6)

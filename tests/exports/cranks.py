"""A platform on cranks in MuJoCo. The actuators hold the angles of `equipod ik`, the platform comes to the pose of
these angles, and the swing of the rods is limited at both ends."""

import json
import math

from common import absent, compare, run
from models import smooth

POSES = ["0,0,177,0,0,0", "3,-4,180,5,-3,8", "-6,5,172,-10,8,-12"]


def angles_and_poses(program, design):
    """Angles in radians with position in metres and matrix, as `ik` gives them."""
    import numpy as np
    options = [f"--pose={pose}" for pose in POSES]
    rows = json.loads(run(program, "ik", design, *options, "--json"))["rows"]
    return [(np.radians(r["angles_deg"]), np.array(r["pose"]["p"]) / 1000, np.array(r["pose"]["R"])) for r in rows]


def complaint(path, expected):
    """The fault of the model at its home, or at one of the poses that its actuators are sent to."""
    import mujoco
    import numpy as np
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    if (model.nv, model.neq, model.nu) != (21, 5, 6):
        return f"velocities, loops, actuators: {(model.nv, model.neq, model.nu)}"
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    if np.abs(data.efc_pos).max() > 1e-9:
        return f"at home the loops are {np.abs(data.efc_pos).max():.1e} m open"
    steps = round(1.0 / model.opt.timestep)
    for angles, position, matrix in expected:
        start = data.ctrl.copy()
        for k in range(steps):
            data.ctrl[:] = start + (angles - start) * smooth((k + 1) / steps)
            mujoco.mj_step(model, data)
        for _ in range(2 * steps):
            mujoco.mj_step(model, data)
        off = max(np.abs(data.body("platform").xpos - position).max() / 0.1, np.abs(data.body("platform").xmat.reshape(3, 3) - matrix).max())
        if not off < 1e-9:
            return f"pose off by {off:.1e}"
    return ""


LIMITS = {"tip": 25.0, "platform": 35.0}


def swings(model, data, crank_axes, rod_axes):
    """Two angles of each rod, from the frames of the bodies: the angle out of the plane in which its crank turns, and
    the angle from its direction at home in the platform frame."""
    import numpy as np
    turn = data.body("platform").xmat.reshape(3, 3)
    out = []
    for k in range(6):
        u = data.body(f"rod{k + 1}").xmat.reshape(3, 3)[:, 2]
        axis = turn @ rod_axes[k]
        lean = math.asin(np.clip(u @ crank_axes[k], -1, 1))
        out.append((lean, math.atan2(np.linalg.norm(np.cross(u, axis)), u @ axis)))
    return out


def swing_complaint(path):
    """The fault of the limits of the swing: at random states they act beyond the angles of the design and not below."""
    import mujoco
    import numpy as np
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    crank_axes = [data.body(f"crank{k}").xmat.reshape(3, 3)[:, 2].copy() for k in range(1, 7)]
    turn = data.body("platform").xmat.reshape(3, 3)
    rod_axes = [turn.T @ data.body(f"rod{k}").xmat.reshape(3, 3)[:, 2] for k in range(1, 7)]
    tip, platform = (math.radians(LIMITS[end]) for end in ("tip", "platform"))
    hinges = [model.joint(f"swing{k}y").id for k in range(1, 7)]
    tendons = [model.tendon(f"swing{k}").id for k in range(1, 7)]
    if not (model.jnt_limited[hinges].all() and model.tendon_limited[tendons].all()):
        return "hinges or tendons without limits"
    home = data.qpos.copy()
    kinds = mujoco.mjtConstraint
    counts = [[0, 0], [0, 0]]
    rng = np.random.default_rng(19)
    for _ in range(200):
        data.qpos[:] = home + 0.7 * rng.uniform(-1, 1, model.nq)
        mujoco.mj_normalizeQuat(model, data.qpos)
        mujoco.mj_forward(model, data)
        acting = lambda kind, number: any(data.efc_type[j] == kind and data.efc_id[j] == number for j in range(data.nefc))
        for k, (lean, swing) in enumerate(swings(model, data, crank_axes, rod_axes)):
            acts = acting(kinds.mjCNSTR_LIMIT_JOINT, hinges[k])
            # a hinge turned beyond a right angle from the plane leans less again
            at = data.qpos[model.jnt_qposadr[hinges[k]]]
            if abs(at) < 1.0 and acts != (abs(lean) > tip):
                return f"rod {k + 1} leans by {math.degrees(lean):.3f} degrees: the limit {'acts' if acts else 'does not act'}"
            counts[0][acts] += 1
            # rod 1 carries the platform; the others hang loose, so that their ends are where they are
            if k:
                continue
            acts = acting(kinds.mjCNSTR_LIMIT_TENDON, tendons[k])
            if acts != (swing > platform):
                return f"rod {k + 1} swings by {math.degrees(swing):.3f} degrees: the limit {'acts' if acts else 'does not act'}"
            counts[1][acts] += 1
    if not all(all(c) for c in counts):
        return f"states within and beyond the limits: {counts}"
    return ""


def check_swing_of_rods(program, folder, design):
    folder.mkdir(parents=True, exist_ok=True)
    limited = folder / "limited.toml"
    limits = f"tip_angle_deg = {LIMITS['tip']}\nplatform_cone_angle_deg = {LIMITS['platform']}\n"
    limited.write_text(design.read_text().replace("[cranks]\n", f"[cranks]\n{limits}", 1))
    run(program, "export", limited, "--to", "mjcf", "-o", folder)

    def more(text):
        """The ranges of the second hinges a tenth wider."""
        before, after = text.split('name="swing1y"', 1)
        start, end = after.split('range="', 1)
        old, rest = end.split('"', 1)
        wide = " ".join(repr(1.1 * float(x)) for x in old.split())
        return f'{before}name="swing1y"{start}range="{wide}"{rest}'

    compare("cranks: MuJoCo, swing of rods", swing_complaint, folder / "platform.xml", folder / "wrong.xml", more)


def check_cranks(program, folder, design):
    try:
        import mujoco  # noqa: F401
    except ImportError:
        absent("MuJoCo")
        return
    run(program, "export", design, "--to", "mjcf", "-o", folder, "--gravity-compensation")
    expected = angles_and_poses(program, design)
    # a rod that is a hundredth too long
    fault = lambda text: text.replace('body2="platform" anchor="0.0 0.0 0.085"', 'body2="platform" anchor="0.0 0.0 0.0851"', 1)
    compare("cranks: MuJoCo", lambda path: complaint(path, expected), folder / "platform.xml", folder / "wrong.xml", fault)
    check_swing_of_rods(program, folder / "swing", design)

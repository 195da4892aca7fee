"""MuJoCo with a platform on cranks: the actuators hold the angles of `equipod ik`, and the platform comes to the pose they were asked for."""

import json

from common import absent, compare, run
from models import smooth

POSES = ["0,0,177,0,0,0", "3,-4,180,5,-3,8", "-6,5,172,-10,8,-12"]


def angles_and_poses(program, design):
    """Angles in radians with position in metres and matrix, as `ik` gives them."""
    import numpy as np
    options = [f"--pose={pose}" for pose in POSES]
    rows = json.loads(run(program, "ik", design, *options, "--json"))["rows"]
    return [(np.radians(r["angles_deg"]), np.array(r["pose"]["p"]) / 1000, np.array(r["pose"]["R"])) for r in rows]


def complaint(path, wanted):
    """What is wrong with the model at its home, or at one of the poses that its actuators are sent to."""
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
    for angles, position, matrix in wanted:
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


def check_cranks(program, folder, design):
    try:
        import mujoco  # noqa: F401
    except ImportError:
        absent("MuJoCo")
        return
    run(program, "export", design, "--to", "mjcf", "-o", folder, "--gravity-compensation")
    wanted = angles_and_poses(program, design)
    # a rod that is a hundredth too long
    fault = lambda text: text.replace('body2="platform" anchor="0.0 0.0 0.085"', 'body2="platform" anchor="0.0 0.0 0.0851"', 1)
    compare("cranks: MuJoCo", lambda path: complaint(path, wanted), folder / "platform.xml", folder / "wrong.xml", fault)

"""The swing of the platform's balls in MuJoCo is limited as the design says, leg by leg. The payload is visible and
touches nothing."""

import math
import tomllib

from common import compare, module, run


def check_swing(program, folder, design):
    """Lengths of the tendons against angles computed from the frames of the bodies, at random states; the limit acts beyond it and not below."""
    np, mujoco = module("numpy"), module("mujoco", "MuJoCo")
    if np is None or mujoco is None:
        return
    text = design.read_text()
    table = tomllib.loads(text)
    limit = math.radians(table["hardware"]["platform_cone_angle_deg"])
    folder.mkdir(parents=True, exist_ok=True)
    # the payload as a box, of which the design says nothing
    shape = "box = { center = [0.0, 0.0, 500.0], size = [600.0, 500.0, 700.0] }"
    shaped = folder / "shaped.toml"
    shaped.write_text(text.replace("[payload]\n", f"[payload]\n{shape}\n"))
    run(program, "export", shaped, "--to", "mjcf", "-o", folder)

    def good(path):
        model = mujoco.MjModel.from_xml_path(str(path))
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        mujoco.mj_forward(model, data)
        rods = [model.body(f"rod{k}").id for k in range(1, 7)]
        platform = model.body("platform").id
        tendons = [model.tendon(f"swing{k}").id for k in range(1, 7)]
        if not model.tendon_limited[tendons].all():
            return "tendons without limits"
        # the axes of the joints are along the legs at home
        axes = [data.xmat[platform].reshape(3, 3).T @ data.xmat[rod].reshape(3, 3)[:, 2] for rod in rods]
        away = [-model.site(f"rod{k}_swing").pos[2] for k in range(1, 7)]
        for k in range(6):
            if abs(model.tendon_range[tendons[k]][1] - 2 * away[k] * math.sin(limit / 2)) > 1e-9 * away[k]:
                return f"tendon {k + 1} limits another angle"
        rng = np.random.default_rng(19)
        beyond, within = 0, 0
        for _ in range(200):
            mujoco.mj_resetDataKeyframe(model, data, 0)
            data.qpos += 0.3 * rng.uniform(-1, 1, model.nq) * (rng.random() < 0.9)
            mujoco.mj_normalizeQuat(model, data.qpos)
            mujoco.mj_forward(model, data)
            turn = data.xmat[platform].reshape(3, 3)
            for k, rod in enumerate(rods):
                # of leg 1 the tip is the joint; the others hang loose, so that their tips are where they are
                if k:
                    continue
                u, axis = data.xmat[rod].reshape(3, 3)[:, 2], turn @ axes[k]
                angle = math.atan2(np.linalg.norm(np.cross(u, axis)), u @ axis)
                if abs(data.ten_length[tendons[k]] - 2 * away[k] * math.sin(angle / 2)) > 1e-9 * away[k]:
                    return f"leg {k + 1}: {data.ten_length[tendons[k]]} at {math.degrees(angle):.3f} degrees"
                acts = any(
                    data.efc_type[j] == mujoco.mjtConstraint.mjCNSTR_LIMIT_TENDON and data.efc_id[j] == tendons[k] for j in range(data.nefc)
                )
                if acts != (angle > limit):
                    return f"leg {k + 1}: the limit {'acts' if acts else 'does not act'} at {math.degrees(angle):.3f} degrees"
                beyond, within = beyond + acts, within + (not acts)
        if not (beyond and within):
            return f"{beyond} states beyond the limit and {within} within"
        # turns about a leg are free: the platform turned about the line of leg 1 at its joint leaves the tendon as it is
        mujoco.mj_resetDataKeyframe(model, data, 0)
        mujoco.mj_forward(model, data)
        joint = model.joint("ball1").qposadr[0]
        own = axes[0]
        data.qpos[joint:joint + 4] = [math.cos(0.5), *(math.sin(0.5) * own)]
        mujoco.mj_forward(model, data)
        if abs(data.ten_length[tendons[0]]) > 1e-9 * away[0]:
            return f"a turn about the leg makes the tendon {data.ten_length[tendons[0]]} long"
        geom = model.geom("payload")
        if geom.contype[0] or geom.conaffinity[0]:
            return "the payload touches legs"
        if geom.type[0] != mujoco.mjtGeom.mjGEOM_BOX or abs(geom.size - [0.3, 0.25, 0.35]).max() > 1e-12 or abs(geom.pos - [0, 0, 0.5]).max() > 1e-12:
            return f"the payload is {geom.size} at {geom.pos}"
        # the rods carry a part of the platform in the joints that they share with it
        if not 200 < model.body_mass[platform] < 300 or abs(model.body_mass.sum() - 300) > 1e-5:
            return f"all weighs {model.body_mass.sum()} kg, the platform {model.body_mass[platform]} kg"
        return ""

    compare("mjcf (MuJoCo): swing of the balls at the platform; a limit of a tenth more", good, folder / "platform.xml", folder / "wrong.xml", wider)


def wider(text):
    """The first tendon a tenth longer."""
    limit = text.split('<spatial name="swing1"')[1].split('range="0 ')[1].split('"')[0]
    return text.replace(f'range="0 {limit}"', f'range="0 {1.1 * float(limit)!r}"', 1)

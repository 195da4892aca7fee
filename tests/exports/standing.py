"""MuJoCo: a machine with limited drives stands under its payload, and `equipod explore` writes such a machine."""

import math

from common import compare, module, run


def check_standing(program, folder, design):
    """The model of a built design, left alone at home with its controls at zero."""
    np, mujoco = module("numpy"), module("mujoco", "MuJoCo")
    if np is None or mujoco is None:
        return
    run(program, "export", design, "--to", "mjcf", "-o", folder)

    def good(path):
        model = mujoco.MjModel.from_xml_path(str(path))
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, 0)
        mujoco.mj_forward(model, data)
        site = model.site("platform_frame").id
        start = data.site_xpos[site].copy()
        for _ in range(round(2 / model.opt.timestep)):
            mujoco.mj_step(model, data)
        sunk = float(np.linalg.norm(data.site_xpos[site] - start))
        if not sunk < 2e-3:
            return f"the platform is {1000 * sunk:.2f} mm off after two seconds"
        if not float(abs(data.qvel).max()) < 1e-3:
            return f"it still moves: {abs(data.qvel).max():.1e}"
        if not model.actuator_forcelimited.all() or not model.actuator_ctrllimited.all():
            return "drives without limits"
        slides = [model.joint(f"leg{k}").id for k in range(1, 7)]
        hinges = [model.joint(f"swing{k}{axis}").id for k in range(1, 7) for axis in "xy"]
        if not model.jnt_limited[slides + hinges].all():
            return "strokes or swings without limits"
        # what the drives push up carries the weight of all that moves
        weight = float(model.body_mass.sum() * np.linalg.norm(model.opt.gravity))
        up = sum(f * data.xmat[model.body(f"rod{k}").id][8] for k, f in zip(range(1, 7), data.actuator_force))
        if not 0.5 * weight < up < 1.01 * weight:
            return f"drives push {up:.0f} N up under {weight:.0f} N"
        return ""

    wrong = folder / "wrong.xml"
    compare("mjcf (MuJoCo): the built simulator stands under its payload; drives of a tenth of the force", good, folder / "platform.xml", wrong, weaker)


def weaker(text):
    """Drives too weak for the payload."""
    limit = text.split('forcerange="')[1].split('"')[0]
    low, high = (float(x) for x in limit.split())
    assert math.isclose(-low, high)
    return text.replace(f'forcerange="{limit}"', f'forcerange="{low / 10} {high / 10}"')

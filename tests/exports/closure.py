"""Drake and Pinocchio: the pose at given leg lengths by their own kinematics of the model, loops closed by Newton's method."""

import json

from common import absent, compare, rotated


def solved(gap, q, slides, step, plus):
    """Moves the slides of `q` by `step` and closes the loops: `gap(q)` is a vector, `plus(q, v)` moves along a tangent vector."""
    import numpy as np
    n = step.size
    free = [k for k in range(n) if k not in slides]
    q = plus(q, step)
    for _ in range(20):
        r = gap(q)
        if np.linalg.norm(r) < 1e-15 * (1 + np.linalg.norm(step)):
            break
        jacobian, h = np.empty((r.size, len(free))), 1e-6
        for column, k in enumerate(free):
            e = np.zeros(n)
            e[k] = h
            jacobian[:, column] = (gap(plus(q, e)) - gap(plus(q, -e))) / (2 * h)
        v = np.zeros(n)
        v[free] = -np.linalg.lstsq(jacobian, r, rcond=None)[0]
        q = plus(q, v)
    return q


def reach(gap, q, slides, lengths, home, plus, n):
    """From home to `lengths` in ten steps."""
    import numpy as np
    for _ in range(10):
        step = np.zeros(n)
        step[slides] = (np.array(lengths) - np.array(home)) / 10
        q = solved(gap, q, slides, step, plus)
    return q


def matrix(q):
    import numpy as np
    return np.array([rotated(q, e) for e in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]).T


def complaint(gap, at, turn, pose, size):
    """What is wrong with the platform at `at`, `turn` instead of `pose`."""
    import numpy as np
    if not gap < 1e-6:
        return f"loops are {gap:.1e} m open"
    p, q, _ = pose
    off = max(float(np.linalg.norm(at - np.array(p))) / size, float(abs(turn - matrix(q)).max()))
    return "" if off < 1e-6 else f"pose off by {off:.1e}"


def check_drake(folder, name, home, size, poses):
    """`poses` is empty where the lengths do not hold the platform."""
    try:
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import AddMultibodyPlantSceneGraph
        from pydrake.systems.analysis import Simulator
        from pydrake.systems.framework import DiagramBuilder
    except ImportError:
        absent("drake")
        return
    import logging
    import numpy as np
    logging.getLogger("drake").setLevel(logging.ERROR)
    doc = json.loads((folder / "platform.json").read_text())
    joints = {j["name"]: np.array(j["at"]) / 1000 for j in doc["platform"]["joints"]}
    def good(path):
        builder = DiagramBuilder()
        plant, _ = AddMultibodyPlantSceneGraph(builder, 1e-3 * size**0.5)
        Parser(plant).AddModels(str(path))
        plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
        plant.Finalize()
        counts = (plant.num_velocities(), plant.num_constraints(), plant.num_actuators())
        if counts != (21, 5, 6):
            return f"velocities, constraints, actuators: {counts}"
        diagram = builder.Build()
        root = diagram.CreateDefaultContext()
        context = plant.GetMyMutableContextFromRoot(root)
        bodies = [plant.GetBodyByName(f"rod{l['leg']}") for l in doc["legs"]]
        heads = [joints[l["platform_joint"]] for l in doc["legs"]]
        platform = plant.GetBodyByName("platform")
        def gap(q):
            plant.SetPositions(context, q)
            frame = platform.EvalPoseInWorld(context)
            return np.concatenate([b.EvalPoseInWorld(context).translation() - frame @ h for b, h in zip(bodies, heads)])
        start = plant.GetPositions(context).copy()  # else a view
        if np.abs(gap(start)).max() > 1e-6:
            return f"at home the loops are {np.abs(gap(start)).max():.1e} m open"
        slides = [plant.GetJointByName(f"leg{k}").position_start() for k in range(1, 7)]
        for pose in poses:
            q = reach(gap, start, slides, pose[2], home, lambda q, v: q + v, 21)
            def state():
                frame = platform.EvalPoseInWorld(context)
                return frame.translation(), frame.rotation().matrix()
            why = complaint(float(np.abs(gap(q)).max()), *state(), pose, size)
            if why:
                return why
            # Drake's own constraints hold the platform there: it does not move with the slides locked
            plant.SetPositionsAndVelocities(context, np.concatenate([q, np.zeros(21)]))
            for k in range(1, 7):
                plant.GetJointByName(f"leg{k}").Lock(context)
            simulator = Simulator(diagram, root)
            root.SetTime(0.0)
            simulator.Initialize()
            simulator.AdvanceTo(0.05 * size**0.5)
            why = complaint(0.0, *state(), pose, size)
            for k in range(1, 7):
                plant.GetJointByName(f"leg{k}").Unlock(context)
            if why:
                return f"constraints move the platform: {why}"
        return ""
    path, wrong = folder / "platform.xml", folder / "wrong.xml"
    what = "poses of our lengths, held by its constraints" if poses else "home closed"
    compare(f"{name} mjcf (Drake): {what}; a rod a thousandth off", good, path, wrong, shifted("rod3", size))
    if poses:
        compare(f"{name} mjcf (Drake), an anchor a thousandth off", good, path, wrong,
                lambda text: text.replace('anchor="0 0 0"', f'anchor="{size / 1000!r} 0 0"', 1))


def shifted(body, size):
    """A fault: a body stands a thousandth of the size to the side."""
    def fault(text):
        at = text.index('pos="', text.index(f'<body name="{body}"')) + 5
        first, rest = text[at:].split(" ", 1)
        return text[:at] + repr(float(first) + size / 1000) + " " + rest
    return fault


def check_pinocchio(folder, name, home, size, poses):
    try:
        import pinocchio
    except ImportError:
        absent("pin")
        return
    if not hasattr(pinocchio, "buildModelAndConstraintsFromMJCF"):
        absent("pin with MJCF")
        return
    import numpy as np
    doc = json.loads((folder / "platform.json").read_text())
    joints = {j["name"]: np.array(j["at"]) / 1000 for j in doc["platform"]["joints"]}
    def good(path):
        model, constraints = pinocchio.buildModelAndConstraintsFromMJCF(str(path))[:2]
        if (model.nv, len(constraints)) != (21, 5):
            return f"nv {model.nv}, {len(constraints)} constraints"
        data = model.createData()
        def gap(q):
            pinocchio.forwardKinematics(model, data, q)
            ends = lambda c, k: data.oMi[getattr(c, f"joint{k}_id")].act(getattr(c, f"joint{k}_placement")).translation
            return np.concatenate([ends(c, 1) - ends(c, 2) for c in constraints])
        start = pinocchio.neutral(model)
        # at home by the joints of the table: the constraints take their anchors from the model
        pinocchio.framesForwardKinematics(model, data, start)
        placed = lambda body: data.oMf[model.getFrameId(body, pinocchio.FrameType.BODY)]
        apart = [placed(f"rod{l['leg']}").translation - placed("platform").act(joints[l["platform_joint"]]) for l in doc["legs"]]
        home_gap = max(np.abs(gap(start)).max(), np.abs(apart).max())
        if home_gap > 1e-6:
            return f"at home the loops are {home_gap:.1e} m open"
        slides = [model.idx_vs[model.getJointId(f"leg{k}")] for k in range(1, 7)]
        frame = model.getFrameId("platform", pinocchio.FrameType.BODY)
        plus = lambda q, v: pinocchio.integrate(model, q, v)
        for pose in poses:
            q = reach(gap, start, slides, pose[2], home, plus, 21)
            open_ = float(np.abs(gap(q)).max())
            at = pinocchio.updateFramePlacement(model, data, frame)
            why = complaint(open_, at.translation, at.rotation, pose, size)
            if why:
                return why
        return ""
    what = "poses of our lengths" if poses else "home closed"
    path, wrong = folder / "platform.xml", folder / "wrong.xml"
    compare(f"{name} mjcf (Pinocchio {pinocchio.__version__}): {what}; a rod a thousandth off", good, path, wrong, shifted("rod3", size))
    if poses:
        compare(f"{name} mjcf (Pinocchio), an anchor a thousandth off", good, path, wrong,
                lambda text: text.replace('anchor="0 0 0"', f'anchor="{size / 1000!r} 0 0"', 1))

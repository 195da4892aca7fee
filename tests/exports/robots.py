"""Gazebo's and ROS's models: Drake reads the SDF, and Pinocchio closes the loops of the URDF at poses for which `equipod ik` gives the lengths."""

import json

from common import compare, module, run

# from home: millimetres over the size in metres, degrees
MOVES = [(0, 0, 0, 0, 0, 0), (20, -15, 25, 3, -2, 4)]


def pose_at(doc, move):
    """Home moved so far, as `ik` takes poses: design units and degrees."""
    import numpy as np
    unit, size = doc["design_unit"]["mm"], max(leg["home_length"] for leg in doc["legs"]) / 500
    home = doc["home"]
    turn = np.array(home["R"])
    position = (np.array(home["p"]) + np.array(move[:3]) * size) / unit
    return position, turn


def tree_complaint(program, design, doc):
    """The fault of the URDF: closures that are open at home, or slides that differ from `equipod ik` after Newton's
    method has closed the loops."""
    import numpy as np
    import pinocchio as pin

    def good(path):
        model = pin.buildModelFromUrdf(str(path))
        data = model.createData()
        ends = [model.getFrameId(name) for name in ["platform"] + [f"closure{i}" for i in range(2, 7)]]
        slides = [model.getJointId(f"leg{i}") for i in range(1, 7)]
        if model.nv != 36:
            return f"{model.nv} freedoms, and not 6 for each leg"
        q = pin.neutral(model)
        pin.framesForwardKinematics(model, data, q)
        home = data.oMf[ends[0]].copy()
        size = max(leg["home_length"] for leg in doc["legs"]) / 1000
        gap = max(np.linalg.norm(pin.log6(data.oMf[e].actInv(home)).vector) for e in ends)
        if gap > 1e-9 * max(1, size):
            return f"closures are {gap:.1e} open at home"
        lengths = np.array([leg["home_length"] for leg in doc["legs"]]) / 1000
        for move in MOVES:
            p = np.array(move[:3]) * size / 500
            expected = home * pin.SE3(pin.rpy.rpyToMatrix(*np.radians(move[3:])), home.rotation.T @ p)
            for _ in range(30):
                pin.computeJointJacobians(model, data, q)
                pin.framesForwardKinematics(model, data, q)
                errors, rows = [], []
                for end in ends:
                    errors.append(pin.log6(data.oMf[end].actInv(expected)).vector)
                    rows.append(pin.getFrameJacobian(model, data, end, pin.ReferenceFrame.LOCAL))
                error = np.concatenate(errors)
                if np.linalg.norm(error) < 1e-12:
                    break
                q = pin.integrate(model, q, np.linalg.lstsq(np.vstack(rows), error, rcond=None)[0])
            found = lengths + [q[model.joints[j].idx_q] for j in slides]
            unit = doc["design_unit"]["mm"] / 1000
            x, y, z, w = pin.Quaternion(expected.rotation).coeffs()
            pose = ",".join(map(repr, map(float, [*(expected.translation / unit), w, x, y, z])))
            answer = json.loads(run(program, "ik", design, f"--pose={pose}", "--json"))
            meant = np.array(answer["lengths"]) * unit
            if abs(found - meant).max() > 1e-9 * size:
                return f"lengths {found} instead of {meant}"
        return ""

    return good


def sdf_complaint(doc):
    """The fault of the SDF as Drake reads it: links, joints, their ends at home. Drake simulates trees, so that the
    joints that close loops are cut."""
    import logging
    import re
    import numpy as np
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant
    logging.getLogger("drake").setLevel(logging.ERROR)

    def plant_of(text):
        plant = MultibodyPlant(1e-3)
        Parser(plant).AddModelsFromString(text, "sdf")
        return plant

    def good(path):
        text = path.read_text()
        whole = plant_of(text)
        for i in range(1, 7):
            for name, links in ((f"universal{i}", ("base", f"cylinder{i}")), (f"leg{i}", (f"cylinder{i}", f"rod{i}")), (f"ball{i}", ("platform", f"rod{i}"))):
                joint = whole.GetJointByName(name)
                if {joint.parent_body().name(), joint.child_body().name()} != set(links):
                    return f"{name} joins {joint.parent_body().name()} and {joint.child_body().name()}"
        tree = plant_of(re.sub(r".*<joint name=\"ball[2-6]\".*\n", "", text))
        tree.Finalize()
        context = tree.CreateDefaultContext()
        place = lambda name: tree.GetBodyByName(name).EvalPoseInWorld(context)
        joints = {j["name"]: np.array(j["at"]) / 1000 for j in doc["platform"]["joints"]}
        for leg in doc["legs"]:
            gap = place("platform") @ joints[leg["platform_joint"]] - place(f"rod{leg['leg']}").translation()
            if np.linalg.norm(gap) > 1e-9 * max(1, leg["home_length"] / 1000):
                return f"leg {leg['leg']} ends {np.linalg.norm(gap):.1e} m from its joint"
        return ""

    return good


def check_robots(program, folder, design, doc):
    """Both files of a design."""
    if module("pinocchio", "pin"):
        bent = lambda text: text.replace("<axis xyz=\"0 0 1\"/><limit", "<axis xyz=\"0 0.1 1\"/><limit", 1)
        compare(f"{design.stem}: URDF in Pinocchio", tree_complaint(program, design, doc), folder / "platform.urdf", folder / "wrong.urdf", bent)
    if module("pydrake", "drake"):
        moved = lambda text: text.replace("<parent>platform</parent><child>rod3", "<parent>base</parent><child>rod3", 1)
        compare(f"{design.stem}: SDF in Drake", sdf_complaint(doc), folder / "platform.sdf", folder / "wrong.sdf", moved)

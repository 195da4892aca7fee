"""MuJoCo, Drake and Pinocchio: an exported model that follows leg lengths. The first two move it by its own actuators and connects, Pinocchio solves its loops."""

import json
import math

from common import module, table


def home_lengths(folder):
    return [float(r["home_length_mm"]) / 1000 for r in table(folder / "legs.csv")]


def smooth(s):
    return s**3 * (10 - 15 * s + 6 * s * s)


class Mechanism:
    """A model at home. `size` in metres scales lengths, its square root times. A program has its own `load`, `counts`, `ranges`, `placed`, mostly `openings`, and either `follow` or what that calls."""

    COUNTS = (21, 5, 6)
    STIFF = False  # loops stay closed in free motion too
    REST = 1e-10  # speed that counts as none

    def __init__(self, path):
        import numpy
        self.np = numpy
        self.home = numpy.array(home_lengths(path.parent))
        self.size, self.now = max(self.home), self.home
        doc = json.loads((path.parent / "platform.json").read_text())
        joints = {j["name"]: numpy.array(j["at"]) / 1000 for j in doc["platform"]["joints"]}
        # where the ends of the rods belong on the platform, by the table of joints
        self.heads = {f"rod{l['leg']}": joints[l["platform_joint"]] for l in doc["legs"]}
        self.load(path)

    def fault(self, limits):
        """The fault at home: velocities, loops and actuators, the least and greatest length of each leg, gaps."""
        if self.counts() != self.COUNTS[: len(self.counts())]:
            return f"velocities, loops, actuators: {self.counts()}"
        ranges = [[round(float(h + x) / self.size, 12) for x in ends] for h, ends in zip(self.home, self.ranges()) if self.np.isfinite(ends).all()]
        if ranges != limits:
            return f"slides from {ranges} instead of {limits}"
        return "" if self.closed() else f"at home the loops are {self.gap():.1e} m open"

    def gap(self):
        """Greatest distance of the end of a rod from its place. The place comes from the table of joints, and from the
        program's own anchors if it has them."""
        at, turn = self.placed("platform")
        gaps = [self.placed(rod)[0] - at - turn @ head for rod, head in self.heads.items()]
        return max(float(self.np.linalg.norm(g)) for g in [*gaps, *self.openings()])

    def openings(self):
        return []

    def closed(self):
        return self.gap() < 1e-6 * min(1.0, self.size)

    def pose(self):
        return self.placed("platform")

    def follow(self, lengths, time):
        """Moves smoothly to these lengths in `time`, then rests until nothing moves any more, for at most `time + 3`.
        Times are over the square root of the size."""
        unit = self.step / math.sqrt(self.size)
        start, end = self.now, self.np.array(lengths)
        count = max(1, round(time / unit))
        for k in range(count):
            self.advance(start + (end - start) * smooth((k + 1) / count) - self.home)
        for _ in range(round((time + 3) / unit)):
            self.advance(end - self.home)
            if self.speed() < self.REST:
                break
        self.now = end

    def speed(self):
        return float(abs(self.velocities()).max()) * math.sqrt(self.size)


class MuJoCo(Mechanism):
    PACKAGE = "mujoco"
    STIFF = True

    def load(self, path):
        import mujoco
        self.mujoco = mujoco
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        self.step = self.model.opt.timestep
        mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        mujoco.mj_forward(self.model, self.data)

    def counts(self):
        return self.model.nv, self.model.neq, self.model.nu

    def ranges(self):
        slides = [self.model.joint(f"leg{k}").id for k in range(1, 7)]
        return [self.model.jnt_range[j] if self.model.jnt_limited[j] else [-math.inf, math.inf] for j in slides]

    def advance(self, control):
        self.data.ctrl[:] = control
        self.mujoco.mj_step(self.model, self.data)

    def velocities(self):
        return self.data.qvel

    def placed(self, body):
        self.mujoco.mj_forward(self.model, self.data)
        return self.data.body(body).xpos.copy(), self.data.body(body).xmat.reshape(3, 3).copy()

    def openings(self):
        place = lambda body, anchor: self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ anchor
        ends = zip(self.model.eq_obj1id, self.model.eq_obj2id, self.model.eq_data)
        return [place(a, anchors[0:3]) - place(b, anchors[3:6]) for a, b, anchors in ends]


class Drake(Mechanism):
    PACKAGE = "pydrake"
    REST = 1e-7  # its solver gives up on slower motion

    def load(self, path):
        import logging
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import MultibodyPlant
        from pydrake.systems.analysis import Simulator
        logging.getLogger("drake").setLevel(logging.ERROR)
        # its steps are implicit: long ones come to rest sooner, where they end does not depend on them
        self.step = 0.03 * math.sqrt(self.size)
        self.plant = MultibodyPlant(self.step)
        Parser(self.plant).AddModels(str(path))
        # it does not know gravity compensation
        self.plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
        self.plant.Finalize()
        self.simulator = Simulator(self.plant)
        self.context = self.simulator.get_mutable_context()
        self.simulator.Initialize()
        self.expected = self.plant.get_desired_state_input_port(self.plant.GetJointByName("leg1").model_instance())

    def counts(self):
        return self.plant.num_velocities(), self.plant.num_constraints(), self.plant.num_actuators()

    def ranges(self):
        slides = [self.plant.GetJointByName(f"leg{k}") for k in range(1, 7)]
        return [[s.position_lower_limits()[0], s.position_upper_limits()[0]] for s in slides]

    def advance(self, control):
        self.expected.FixValue(self.context, self.np.concatenate([control, self.np.zeros(6)]))
        self.simulator.AdvanceTo(self.context.get_time() + self.step)

    def velocities(self):
        return self.plant.GetVelocities(self.context)

    def placed(self, body):
        frame = self.plant.GetBodyByName(body).EvalPoseInWorld(self.context)
        return frame.translation().copy(), frame.rotation().matrix().copy()


class Pinocchio(Mechanism):
    PACKAGE = "pinocchio"

    def load(self, path):
        import pinocchio
        self.pin = pinocchio
        self.model, self.loops = pinocchio.buildModelAndConstraintsFromMJCF(str(path))[:2]
        self.data, self.q = self.model.createData(), pinocchio.neutral(self.model)
        self.slides = [self.model.getJointId(f"leg{k}") for k in range(1, 7)]

    def counts(self):
        return self.model.nv, len(self.loops)

    def ranges(self):
        low, high = self.model.lowerPositionLimit, self.model.upperPositionLimit
        return [[low[k], high[k]] for k in (self.model.idx_qs[j] for j in self.slides)]

    def follow(self, lengths, time):
        """In steps of a fiftieth of the size, the loops closed after each."""
        np = self.np
        change = np.array(lengths) - self.now
        count = max(1, math.ceil(abs(change).max() / (0.02 * self.size)))
        for _ in range(count):
            step = np.zeros(self.model.nv)
            step[[self.model.idx_vs[j] for j in self.slides]] = change / count
            self.q = self.pin.integrate(self.model, self.q, step)
            self.solve()
        self.now = np.array(lengths)

    def solve(self):
        """Newton's method on the loops, the slides held."""
        np = self.np
        slides = {self.model.idx_vs[j] for j in self.slides}
        free = [k for k in range(self.model.nv) if k not in slides]
        for _ in range(20):
            gaps, jacobian = self.linearised()
            if np.linalg.norm(gaps) < 1e-15 * self.size:
                break
            step = np.zeros(self.model.nv)
            step[free] = -np.linalg.lstsq(jacobian[:, free], gaps, rcond=None)[0]
            self.q = self.pin.integrate(self.model, self.q, step)

    def openings(self):
        return self.linearised()[0].reshape(-1, 3)

    def linearised(self):
        """The gaps of the loops, and how they change with the velocities."""
        pin, np = self.pin, self.np
        pin.computeJointJacobians(self.model, self.data, self.q)
        def end(joint, placement):
            at = self.data.oMi[joint].act(placement).translation
            rates = pin.getJointJacobian(self.model, self.data, joint, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
            return at, rates[:3] - pin.skew(at - self.data.oMi[joint].translation) @ rates[3:]
        pairs = [(end(c.joint1_id, c.joint1_placement), end(c.joint2_id, c.joint2_placement)) for c in self.loops]
        return np.concatenate([a[0] - b[0] for a, b in pairs]), np.concatenate([a[1] - b[1] for a, b in pairs])

    def placed(self, body):
        self.pin.framesForwardKinematics(self.model, self.data, self.q)
        frame = self.data.oMf[self.model.getFrameId(body, self.pin.FrameType.BODY)]
        return frame.translation.copy(), frame.rotation.copy()


def installed():
    """The targets whose program is installed; the others are noted."""
    return [kind for kind in (MuJoCo, Drake, Pinocchio) if module(kind.PACKAGE, kind.__name__)]

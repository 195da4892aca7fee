"""LinuxCNC's headers and its HAL take the kinematics module of `equipod export DESIGN --to c -o FOLDER`, and poses become joint values and poses again.

LINUXCNC_ROOT names the folder where the Debian packages linuxcnc-uspace and linuxcnc-uspace-dev are unpacked (`dpkg -x`); without it LinuxCNC is searched for
on the system. Few systems can have it, so it is never required. The memory of HAL is one for the whole system: where a component is loaded nothing is done.
"""

import ctypes
import math
import pathlib
import random
import subprocess

Handler = ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_char_p, ctypes.c_void_p)
FLAGS = ["-std=gnu11", "-O2", "-fPIC", "-shared", "-ffp-contract=off", "-DRTAPI", "-DUSPACE", "-DSIM", "-D_GNU_SOURCE", "-D__MODULE__", "-Wall", "-Werror"]


def build(root, folder):
    """Compiles the module; what the compiler complains about."""
    out = subprocess.run(["gcc", *FLAGS, f"-I{root}/usr/include/linuxcnc", "equipodkins.c", "-o", "equipodkins.so", "-lm"], cwd=folder / "linuxcnc", capture_output=True, text=True)
    return out.stderr if out.returncode else ""


class Machine:
    """The module in a HAL without realtime: it is called from here."""

    def __init__(self, root, folder):
        library = next(lib for pattern in ("usr/lib", "usr/lib/*") for lib in pathlib.Path(root).glob(f"{pattern}/liblinuxcnchal.so.0"))
        self.hal = ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
        self.silent = Handler(lambda *_: None)
        self.hal.rtapi_set_msg_handler(self.silent)
        self.module = ctypes.CDLL(str(folder / "linuxcnc/equipodkins.so"))
        if self.module.rtapi_app_main() != 0:
            raise SystemExit("equipodkins does not start")

    def pin(self, name, needed=True):
        kind, linked, value = ctypes.c_int(), ctypes.c_bool(), ctypes.POINTER(ctypes.c_double)()
        if self.hal.hal_get_pin_value_by_name(f"equipodkins.{name}".encode(), *map(ctypes.byref, (kind, value, linked))) != 0:
            if needed:
                raise SystemExit(f"equipodkins has no pin {name}")
            return None
        return value

    def joint_offsets(self):
        """The pins of offsets, where the joints of the design are not ideal."""
        return [name for name in ("base-joint-offset", "platform-joint-offset") if self.pin(name, needed=False)]

    def joints(self, pose):
        joints = (ctypes.c_double * 16)()
        code = self.module.kinematicsInverse((ctypes.c_double * 9)(*pose), joints, (ctypes.c_ulong * 1)(), (ctypes.c_ulong * 1)())
        return list(joints)[:6] if code == 0 else None

    def pose(self, joints, start):
        pose = (ctypes.c_double * 9)(*start)
        code = self.module.kinematicsForward((ctypes.c_double * 16)(*joints), pose, (ctypes.c_ulong * 1)(), (ctypes.c_ulong * 1)())
        return list(pose)[:6] if code == 0 else None


def there_and_back(machine, home, size, tilt):
    """The worst error of poses from their own joint values, and how many were not found."""
    worst, lost = 0.0, 0
    random.seed(5)
    for _ in range(100):
        pose = [x + 0.05 * size * random.uniform(-1, 1) for x in home] + [tilt * random.uniform(-1, 1) for _ in range(3)]
        start = [x + 1e-4 * size for x in pose[:3]] + [x + 0.01 for x in pose[3:]]
        found = machine.pose(machine.joints(pose), start)
        if found is None:
            lost += 1
        else:
            off = [abs(a - b) / size for a, b in zip(found[:3], pose[:3])] + [abs(math.radians(a - b)) for a, b in zip(found[3:], pose[3:])]
            worst = max(worst, *off)
    return worst, lost


def check(root, folder, told, name, rows):
    """`told(good, what, why)` for every check. `rows` are poses and the joint values that the library has there, millimetres."""
    complaint = build(root, folder)
    if not told(not complaint, f"{name}: equipodkins compiles with LinuxCNC's headers", complaint):
        return
    machine = Machine(root, folder)
    try:
        base = [[machine.pin(f"base.{i}.{axis}")[0] for axis in "xyz"] for i in range(6)]
        size = max(math.dist(base[0], b) for b in base)
        home = rows[0][0][:3]
        off = max(abs(a - b) for pose, lengths in rows for a, b in zip(machine.joints([*pose, 0, 0, 0]), lengths)) / size
        told(off < 1e-12, f"{name}: equipodkins has the joint values of the library", f"off by {off} of the size")
        for lead in (machine.pin("screw-lead")[0], 0.02 * size):
            machine.pin("screw-lead")[0] = lead
            worst, lost = there_and_back(machine, home, size, 15)
            print(f"  {name}: lead {lead:.1f} mm, poses come back to {worst:.1e} of the size")
            told(worst < 1e-9 and lost == 0, f"{name}: equipodkins: poses come back with a lead of {lead:.1f}", f"off by {worst}, {lost} lost")
        # another machine has other joint values
        for pin in ("platform.3.y", *machine.joint_offsets()):
            before = machine.joints([*home, 5, 0, 0])
            machine.pin(pin)[0] += 1
            told(machine.joints([*home, 5, 0, 0]) != before, f"{name}: equipodkins: {pin} is read", "joint values did not change")
    finally:
        machine.module.rtapi_app_exit()

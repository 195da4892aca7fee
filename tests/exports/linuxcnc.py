"""LinuxCNC: its halcmd reads the settings, its compiled genhexkins computes struts from poses and poses from struts.

LINUXCNC_ROOT names the folder where a Debian package is unpacked (`dpkg -x`); without it LinuxCNC is searched for on the system.
"""

import atexit
import cmath
import ctypes
import math
import os
import pathlib
import shutil
import subprocess

from common import absent, compare, rotated, run, table
from texts import PINS, joints_of, replaced

Handler = ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_char_p, ctypes.c_void_p)


class Session:
    """A HAL with genhexkins in it, and no realtime: the module is called from here."""

    def __init__(self, root):
        libraries = [lib for pattern in ("usr/lib", "usr/lib/*") for lib in root.glob(f"{pattern}/liblinuxcnchal.so.0")]
        if not libraries:
            raise SystemExit(f"{root} holds no LinuxCNC")
        self.root, self.library, self.command = root, libraries[0], root / "usr/bin/halcmd"

    def busy(self):
        """The memory of HAL is one for the whole system: a machine that runs is left alone."""
        return any(not name.startswith("halcmd") for name in self.halcmd("list", "comp").stdout.split())

    def start(self):
        self.hal = ctypes.CDLL(str(self.library), mode=ctypes.RTLD_GLOBAL)
        self.silent = Handler(lambda *_: None)
        self.hal.rtapi_set_msg_handler(self.silent)
        self.module = ctypes.CDLL(str(self.root / "usr/lib/linuxcnc/modules/genhexkins.so"))
        if self.module.rtapi_app_main() != 0:
            raise SystemExit("genhexkins does not start")
        atexit.register(self.module.rtapi_app_exit)
        self.pins = {name: self.pin(name) for name in PINS}
        self.defaults = {name: value[0] for name, value in self.pins.items()}
        # the first answer starts from the zero pose whatever it is given
        self.forward([1.0] * 6, [0.0] * 6)

    def pin(self, name):
        kind, linked, value = ctypes.c_int(), ctypes.c_bool(), ctypes.POINTER(ctypes.c_double)()
        if self.hal.hal_get_pin_value_by_name(name.encode(), *map(ctypes.byref, (kind, value, linked))) != 0:
            raise SystemExit(f"genhexkins has no pin {name}")
        return value

    def halcmd(self, *args):
        env = {**os.environ, "LD_LIBRARY_PATH": str(self.library.parent)}
        return subprocess.run([self.command, *args], env=env, capture_output=True, text=True)

    def load(self, path):
        """Reads a file into pins that held nothing; what halcmd complains about."""
        for value in self.pins.values():
            value[0] = math.nan
        out = self.halcmd("-f", path)
        return "" if out.returncode == 0 else f"halcmd: exit {out.returncode}: {out.stderr.strip()}"

    def inverse(self, pose):
        """Struts at X Y Z A B C, or None."""
        joints = (ctypes.c_double * 16)()
        code = self.module.kinematicsInverse((ctypes.c_double * 9)(*pose), joints, (ctypes.c_ulong * 1)(), (ctypes.c_ulong * 1)())
        return list(joints)[:6] if code == 0 else None

    def forward(self, struts, start):
        """X Y Z A B C at these struts, from a pose nearby, or None."""
        pose = (ctypes.c_double * 9)(*start)
        code = self.module.kinematicsForward((ctypes.c_double * 16)(*struts), pose, (ctypes.c_ulong * 1)(), (ctypes.c_ulong * 1)())
        return list(pose)[:6] if code == 0 else None


sessions = []


def session():
    """The one session, or None and a note."""
    if not sessions:
        named = os.environ.get("LINUXCNC_ROOT")
        if named is None and shutil.which("halcmd") is None:
            absent("LinuxCNC", required=False)
            return None
        found = Session(pathlib.Path(named or "/"))
        if found.busy():
            absent("LinuxCNC, which is running", required=False)
            return None
        found.start()
        sessions.append(found)
    return sessions[0]


def angles(q):
    """A, B, C in degrees of a quaternion, R = Rz(C) Ry(B) Rx(A)."""
    x, y, z = (rotated(q, e) for e in ([1, 0, 0], [0, 1, 0], [0, 0, 1]))
    return [math.degrees(t) for t in (math.atan2(y[2], z[2]), math.atan2(-x[2], math.hypot(x[0], x[1])), math.atan2(x[1], x[0]))]


def contraction(b, c):
    """The factor by which the forward kinematics reduces an error near a pose. It takes rates E of the angles for an
    angular velocity, so that the factor is the spectral radius of 1 - E."""
    y, z = math.cos(math.radians(b)), math.cos(math.radians(c))
    root = cmath.sqrt((z * (1 + y)) ** 2 - 4 * y)
    return max(abs(1 - (z * (1 + y) + sign * root) / 2) for sign in (-1, 1))


def check_linuxcnc(folder, name, regular):
    """`regular`: the legs hold the platform at all poses; elsewhere LinuxCNC may refuse to say where it is."""
    linuxcnc = session()
    if linuxcnc is None:
        return
    joints, legs, rows = joints_of(folder), table(folder / "legs.csv"), table(folder / "lengths-workspace.csv")
    size = max(float(leg["home_length_mm"]) for leg in legs)
    def read(path):
        why = linuxcnc.load(path)
        for leg in legs:
            for body in ("base", "platform"):
                for axis, x in zip("xyz", joints[(body, leg[f"{body}_joint"])]):
                    pin = f"genhexkins.{body}.{int(leg['leg']) - 1}.{axis}"
                    if linuxcnc.pins[pin][0] != x:
                        why = why or f"{pin} is {linuxcnc.pins[pin][0]} instead of {x}"
        return why
    def moves(path):
        linuxcnc.load(path)
        found = 0
        for row in rows:
            pose = [float(row[k]) for k in ("x_mm", "y_mm", "z_mm")] + angles([float(row[k]) for k in ("qw", "qx", "qy", "qz")])
            ours = [float(row[f"l{k}_mm"]) for k in range(1, 7)]
            struts = linuxcnc.inverse(pose)
            off = max(abs(a / b - 1) for a, b in zip(struts, ours)) if struts else math.inf
            if not off < 1e-12:
                return f"struts off by {off:.1e}"
            back = linuxcnc.forward(ours, [x + 1e-4 * size for x in pose[:3]] + [x + 0.01 for x in pose[3:]])
            if back is None:
                if regular and contraction(*pose[4:]) < 0.8:
                    return f"no pose found near {pose}"
                continue
            turns = [abs(math.remainder(a - b, 360)) * math.pi / 180 for a, b in zip(back[3:], pose[3:])]
            off = max(math.dist(back[:3], pose[:3]) / size, *turns)
            if not off < 1e-6:
                return f"pose off by {off:.1e}"
            found += 1
        return "" if found or not regular else "no pose found"
    path, wrong = folder / "genhexkins.hal", folder / "wrong.hal"
    compare(f"{name} hal (LinuxCNC): halcmd sets every coordinate to the table's", read, path, wrong,
            lambda text: text.replace("platform.5.z", "platform.6.z"))
    compare(f"{name} hal (LinuxCNC): genhexkins.so has our struts, and our poses where it finds any", moves, path, wrong,
            replaced(r"^(setp genhexkins\.platform\.3\.y )(\S+)$", lambda x: x + 1e-9 * size))


def check_preset(program, folder):
    """The preset `linuxcnc-hexapod` has the joints that genhexkins has before anything is set, in inches."""
    linuxcnc = session()
    if linuxcnc is None:
        return
    folder.mkdir(exist_ok=True)
    run(program, "design", "presets", "linuxcnc-hexapod", "-o", folder / "preset.toml")
    run(program, "export", folder / "preset.toml", "--to", "hal", "-o", folder)
    def good(path):
        why = linuxcnc.load(path)
        off = max(abs(value[0] / 25.4 - linuxcnc.defaults[name]) for name, value in linuxcnc.pins.items())
        return why if why or off < 1e-12 else f"joints off by {off:.1e} in"
    compare("preset linuxcnc-hexapod (LinuxCNC): the joints that are compiled in", good, folder / "genhexkins.hal", folder / "wrong.hal",
            replaced(r"^(setp genhexkins\.base\.2\.x )(\S+)$", lambda x: x + 1e-9))

#!/usr/bin/env python3
"""Compilers that are not ours take the files of `equipod export DESIGN --to c -o FOLDER`, and the self-test in them runs. `tests/controllers/run` calls this.

    python tests/controllers/check.py target/debug/equipod [--allow-missing] [--table]

On the host: gcc and clang, double and float, with all warnings as errors and with sanitizers. For microcontrollers: arm-none-eabi-gcc for Cortex-M4F and M7,
run by qemu-system-arm. Every compiler also has to find a planted fault: a self-test with one wrong number has to fail.
`--table` prints what docs/controllers.md holds: code, stack, instructions, operations.
"""

import argparse
import itertools
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# shared joints and separate ones, limits of lengths and cone angles, a design equivalent to an octahedral platform, a unit that has to be named
DESIGNS = [
    ("rbt-octahedral", []),
    ("worked/bench-joint-free", []),
    ("worked/chair", []),
    ("presets/linuxcnc-hexapod", []),
    ("general-6-6", ["--unit", "m"]),
    # rods on cranks, with functions of their own
    ("presets/reachy-mini", []),
]
# the symmetric hexapod with joints that are not ideal: axes that do not meet at both ends, at one, and screws
AXES = "[[0, 1, 0], [0, 1, 0], [-0.866, -0.5, 0], [-0.866, -0.5, 0], [0.866, -0.5, 0], [0.866, -0.5, 0]]"
JOINTS = {
    "offsets at both ends": (14, 9, 0),
    "offsets at the base": (14, 0, 0),
    "offsets and screws": (14, 9, 8),
}
STRICT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wconversion", "-Wdouble-promotion"]
SANITIZE = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
SOURCES = ["equipod.c", "equipod_design.c"]
# name, options of the compiler, machine of QEMU, real_t
BOARDS = [
    ("Cortex-M4F, float", ["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16"], ("mps2-an386", "cortex-m4"), True),
    ("Cortex-M7, float", ["-mcpu=cortex-m7", "-mfpu=fpv5-d16"], ("mps2-an500", "cortex-m7"), True),
    ("Cortex-M7, double", ["-mcpu=cortex-m7", "-mfpu=fpv5-d16"], ("mps2-an500", "cortex-m7"), False),
]
ARM = ["-mthumb", "-mfloat-abi=hard", "-O2", "-fno-math-errno", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections"]

failed, passed, missing = [], [], []


def told(good, what, why=""):
    (passed if good else failed).append(what)
    if not good:
        print(f"FAILED {what}: {why.strip()[-2000:]}")
    return good


def run(*args, cwd=None, timeout=300):
    out = subprocess.run([str(a) for a in args], capture_output=True, text=True, cwd=cwd, timeout=timeout)
    return out.returncode, out.stdout + out.stderr


def has(program):
    if shutil.which(program) is None:
        if program not in missing:
            missing.append(program)
        return False
    return True


def export(program, design, options, folder):
    code, out = run(program, "export", ROOT / f"designs/{design}.toml", "--to", "c", "-o", folder, *options)
    if code != 0:
        sys.exit(f"the program does not export {design}: {out}")


def not_ideal(program, offsets, folder):
    """The files of the symmetric hexapod with universal joints of these offsets and a lead."""
    base, platform, lead = offsets
    text = (ROOT / "designs/symmetric-hexapod.toml").read_text() + f"leg_length = [200, 600]\nscrew_lead = {lead}\n"
    for body, offset in (("base", base), ("platform", platform)):
        text += f'{body}_joint = {{ model = "universal", first_axis = {AXES}, offset = {offset} }}\n'
    folder.mkdir()
    (folder / "design.toml").write_text(text)
    # it proves the limits of the legs first, which takes minutes where joints are not ideal
    code, out = run(program, "export", folder / "design.toml", "--to", "c", "-o", folder, timeout=1200)
    if code != 0:
        sys.exit(f"the program does not export joints that are not ideal: {out}")


def faulty(folder, to):
    """The same files with one expected number, a squared length or an angle, off by a hundredth."""
    shutil.copytree(folder, to)
    path = to / "equipod_vectors.h"
    text = path.read_text()
    # a vector begins with its pose, {{rotation}, {position}}, and its squared lengths come next, or that no rod is too short and its angles
    number = re.search(r"\}\}, \{[^}]*\}\}, (?:0, )?\{([\d.e+-]+)", text).group(1)
    wrong = repr(float(number) * 1.01)
    path.write_text(text.replace(number, wrong, 1))


def sources(place):
    """The library and the numbers of the design in a folder."""
    more = [name for name in ("equipod_cranks.c", "equipod_drives.c") if (place / name).exists()]
    return [place / name for name in [*SOURCES, *more]]


def host(folder, wrong, name):
    for compiler, real in itertools.product(["gcc", "clang"], [[], ["-DEQUIPOD_FLOAT"]]):
        if not has(compiler):
            continue
        for options in (["-O2"], ["-O1", "-g", *SANITIZE]):
            label = f"{name}: {compiler} {' '.join(real + options)}"
            for place, good in ((folder, True), (wrong, False)):
                if not good and options != ["-O2"]:
                    continue
                binary = place / "selftest"
                code, out = run(compiler, *STRICT, "-ffp-contract=off", *real, *options, *sources(place), place / "equipod_selftest.c", "-lm", "-o", binary)
                if not told(code == 0, f"{label} compiles", out):
                    continue
                code, out = run(binary)
                told((code == 0) == good, f"{label} {'agrees' if good else 'finds the planted fault'}", out)
                if good and options == ["-O2"] and compiler == "gcc":
                    print(f"  {name} {'float' if real else 'double'}: {' / '.join(out.strip().splitlines())}")


def cmake(folder):
    if has("cmake"):
        code, out = run("cmake", "-S", folder, "-B", folder / "build")
        code, out = run("cmake", "--build", folder / "build") if code == 0 else (code, out)
        code, out = run("ctest", cwd=folder / "build") if code == 0 else (code, out)
        told(code == 0 and "100% tests passed" in out, "cmake and ctest", out)


def qemu(board, binary):
    machine, cpu = board
    return run("qemu-system-arm", "-M", machine, "-cpu", cpu, "-icount", "shift=0", "-semihosting", "-display", "none", "-serial", "null", "-monitor", "none",
               "-kernel", binary)


def worst_stack(info):
    """The greatest sum of frames along calls from each public function; functions of other libraries are not in it, and named."""
    frames, calls = {}, {}
    for path in info:
        for match in re.finditer(r'node: \{ title: "([^"]+)" label: "([^"]*)"', path.read_text()):
            size = re.search(r"(\d+) bytes \((\w+)\)", match.group(2))
            frames[match.group(1)] = int(size.group(1)) if size else None
            if size and size.group(2) != "static":
                sys.exit(f"the stack of {match.group(1)} has no bound")
        for match in re.finditer(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', path.read_text()):
            calls.setdefault(match.group(1), set()).add(match.group(2))
    def depth(name, above=()):
        if name in above:
            sys.exit(f"{name} calls itself")
        deepest, outside = 0, set()
        for callee in calls.get(name, ()):
            if frames.get(callee) is None:
                outside.add(callee)
                continue
            below, more = depth(callee, (*above, name))
            deepest, outside = max(deepest, below), outside | more
        return frames[name] + deepest, outside
    return {name: depth(name) for name in frames if frames[name] is not None and name.startswith("equipod_")}


def board(folder, wrong, name, table):
    if not (has("arm-none-eabi-gcc") and has("qemu-system-arm")):
        return
    for label, options, machine, is_float in BOARDS:
        real = ["-DEQUIPOD_FLOAT"] if is_float else []
        options = [*options, *ARM, *real]
        link = ["--specs=rdimon.specs", "-nostartfiles", "-T", HERE / "firmware/mps2.ld", HERE / "firmware/start.c", "-Wl,--gc-sections", "-lm"]
        binaries = {}
        programs = [(folder, folder / "equipod_selftest.c"), (wrong, wrong / "equipod_selftest.c")]
        programs += [(folder, HERE / "firmware/count.c")] if table else []
        for place, main in programs:
            binary = place / f"{main.stem}.elf"
            code, out = run("arm-none-eabi-gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", *options, "-I", place, *sources(place), main, *link, "-o", binary)
            if told(code == 0, f"{name}: {label}: {main.stem} compiles", out):
                binaries[(place, main.stem)] = binary
        if len(binaries) < len(programs):
            continue
        code, out = qemu(machine, binaries[(folder, "equipod_selftest")])
        told(code == 0 and " 0 failed" in out, f"{name}: {label}: agrees", out)
        print(f"  {name} {label}: {' / '.join(out.strip().splitlines())}")
        code, out = qemu(machine, binaries[(wrong, "equipod_selftest")])
        told(code == 1, f"{name}: {label}: finds the planted fault", out)
        if not table:
            continue
        code, out = qemu(machine, binaries[(folder, "count")])
        counts = dict(line.split() for line in out.splitlines() if len(line.split()) == 2)
        objects = []
        for source in SOURCES:
            run("arm-none-eabi-gcc", "-std=c99", *options, "-fcallgraph-info=su", "-c", folder / source, "-o", folder / f"{source[:-2]}.o", cwd=folder)
            objects.append(folder / f"{source[:-2]}.o")
        _, sizes = run("arm-none-eabi-size", *objects)
        text = [int(line.split()[0]) for line in sizes.splitlines()[1:]]
        data = [int(line.split()[1]) + int(line.split()[2]) for line in sizes.splitlines()[1:]]
        stacks = worst_stack([folder / "equipod.ci"])
        print(f"  TABLE {label}: code {text[0]}, numbers of the design {text[1]}, variables {sum(data)}")
        print("    stack", {k: v[0] for k, v in stacks.items()}, "outside", sorted(set().union(*(v[1] for v in stacks.values()))))
        print("    instructions", counts)


def operations(folder):
    """Counts the operations of each part of the tracker: sums, products, quotients, roots."""
    if not has("g++"):
        return
    place = folder / "counted"
    place.mkdir()
    for name in [*SOURCES, "equipod.h", "equipod_design.h"]:
        shutil.copy(folder / name, place / name)
    header = place / "equipod.h"
    header.write_text(header.read_text().replace("typedef double real_t;", "typedef counted real_t;"))
    code, out = run("g++", "-std=c++11", "-w", "-I", place, HERE / "operations.cpp", "-o", place / "operations")
    if told(code == 0, "operations are counted", out):
        print(run(place / "operations")[1])


def known_rows(program, design, folder):
    """Poses about home, the home pose first, and the lengths to command there by the library, millimetres and degrees."""
    here, table = folder / "in-millimetres.toml", folder / "poses.csv"
    code, out = run(program, "design", "convert", design, "--units", "mm", "-o", here, "--json")
    if code != 0:
        sys.exit(f"the program does not convert {design}: {out}")
    at = json.loads(subprocess.run([program, "ik", here, "--pose", "home", "--json"], capture_output=True, text=True, check=True).stdout)
    home, size = at["pose"]["p"], max(at["lengths"])
    dice = random.Random(7)
    poses = [[*home, 0, 0, 0]]
    poses += [[x + 0.05 * size * dice.uniform(-1, 1) for x in home] + [12 * dice.uniform(-1, 1) for _ in range(3)] for _ in range(20)]
    table.write_text("".join(",".join(map(repr, pose)) + "\n" for pose in poses))
    out = subprocess.run([program, "ik", here, table, "--json"], capture_output=True, text=True, check=False).stdout
    return [(pose, row.get("drives", row)["lengths"]) for pose, row in zip(poses, json.loads(out)["rows"], strict=True)]


def table_of_operations(folder, name, rows):
    """The kinematics module with a table of operations, against a stand-in for LinuxCNC's headers. KINS_HEADERS names
    the folders of the true headers, with colons between them, for a second check. The module of 2.9 has to suit the
    stand-in too."""
    if not has("gcc"):
        return
    options = ["-std=gnu11", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off"]
    own = ["-I", HERE / "kins"]
    code, out = run("gcc", *options, *own, "-fsyntax-only", folder / "linuxcnc/equipodkins.c")
    told(code == 0, f"{name}: equipodkins suits the stand-in", out)
    binary = folder / "kins"
    text = "".join(" ".join(map(repr, [*pose, *lengths])) + "\n" for pose, lengths in rows)
    for fault in (False, True):
        source = folder / "linuxcnc/equipodkins_ops.c"
        if fault:
            # a planted fault: degrees that are a little off
            place = folder / "kins-wrong"
            shutil.copytree(folder, place)
            header = place / "linuxcnc/equipodkins.h"
            header.write_text(header.read_text().replace("#define DEGREE 0.017453292519943295", "#define DEGREE 0.0174532925"))
            source = place / "linuxcnc/equipodkins_ops.c"
        sources = [source, HERE / "kins/check.c", "-lm"]
        code, out = run("gcc", *options, "-O2", *SANITIZE, f"-DHOME_Z={rows[0][0][2]!r}", *own, *sources, "-o", binary)
        if told(code == 0, f"{name}: equipodkins_ops suits the stand-in", out):
            done = subprocess.run([binary], input=text, capture_output=True, text=True, timeout=300)
            out = done.stdout + done.stderr
            told((done.returncode != 0) == fault, f"{name}: equipodkins_ops {'finds the planted fault' if fault else 'goes there and back'}", out)
            if not fault:
                print(f"  {name}: equipodkins_ops: {out.strip()}")
    headers = [part for part in os.environ.get("KINS_HEADERS", "").split(":") if part]
    if not headers:
        print("  KINS_HEADERS is not set: equipodkins_ops was not compiled with LinuxCNC's own headers")
        return
    true = [x for part in headers for x in ("-I", part)]
    code, out = run("gcc", *options, "-DRTAPI", "-DUSPACE", "-D_GNU_SOURCE", *true, "-fsyntax-only", folder / "linuxcnc/equipodkins_ops.c")
    told(code == 0, f"{name}: equipodkins_ops compiles with LinuxCNC's own headers", out)


def linuxcnc(program, top, coupled):
    """The kinematics module with the headers and the HAL of LinuxCNC, if they are installed. The designs are one
    without shared joints and one whose joints are not ideal."""
    root = os.environ.get("LINUXCNC_ROOT", "/")
    if not pathlib.Path(root, "usr/include/linuxcnc/kinematics.h").exists():
        print("  LinuxCNC's headers are not installed: its kinematics module was not compiled")
        return
    import linuxcnc as own
    ideal = top / "linuxcnc"
    export(program, "worked/linuxcnc-griffis-duffy", [], ideal)
    separate = ROOT / "designs/worked/linuxcnc-griffis-duffy.toml"
    for name, design, folder in (("separate joints", separate, ideal), ("offsets and screws", coupled / "design.toml", coupled)):
        own.check(root, folder, told, name, known_rows(program, design, folder))
        if root == "/" and shutil.which("linuxcnc") and shutil.which("halcompile"):
            # with the Python that LinuxCNC's own module is for
            code, out = run("/usr/bin/python3", HERE / "program.py", program, design, timeout=400)
            told(code == 0, f"{name}: a program runs in LinuxCNC", out)
            print(f"  {name}: {out.strip()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the equipod program")
    parser.add_argument("--allow-missing", action="store_true", help="programs that are not installed are named only")
    parser.add_argument("--table", action="store_true", help="code, stack, instructions and operations of the second design")
    args = parser.parse_args()
    program = pathlib.Path(args.program).resolve()
    if not (shutil.which("gcc") or shutil.which("clang")):
        print("there is no C compiler")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as top:
        top = pathlib.Path(top)
        for number, (design, options) in enumerate(DESIGNS):
            folder, wrong = top / str(number), top / f"{number}-wrong"
            export(program, design, options, folder)
            faulty(folder, wrong)
            host(folder, wrong, design)
            if number == 0 or design == "presets/reachy-mini":
                cmake(folder)
            if number == 1:
                table_of_operations(folder, design, known_rows(program, ROOT / f"designs/{design}.toml", folder))
                board(folder, wrong, design, args.table)
                if args.table:
                    operations(folder)
            if design == "presets/reachy-mini":
                board(folder, wrong, design, False)
        for name, offsets in JOINTS.items():
            folder, wrong = top / name.replace(" ", "-"), top / f"{name.replace(' ', '-')}-wrong"
            not_ideal(program, offsets, folder)
            faulty(folder, wrong)
            host(folder, wrong, name)
            table_of_operations(folder, name, known_rows(program, folder / "design.toml", folder))
            if name == "offsets and screws":
                board(folder, wrong, name, False)
        cmake(folder)
        linuxcnc(program, top, folder)
    print(f"{len(passed)} passed, {len(failed)} failed" + (f", not installed: {', '.join(missing)}" if missing else ""))
    sys.exit(1 if failed or (missing and not args.allow_missing) else 0)


if __name__ == "__main__":
    main()

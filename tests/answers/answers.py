"""Every command in all outcomes of its answer: the calls, and the designs and tables that bring them about."""

import json
import math
import subprocess

# Exit code, schema of the answer, arguments behind the command; `{name}` is a file of `Files`.
CALLS = """
0 assess {bench-octahedral} --points 50
0 assess {universal} --points 50
1 assess {conflict} --points 50
0 bench --class octahedral --count 2
0 bench --class octahedral,T05 --count 1 --recheck-every 0
1 bench --class hexapod-home --count 1 --recheck-every 0 --method template
0 bench --noise --class octahedral --count 1
0 check {rbt-octahedral}
1 check {rbt-midline}
1 check {longer}
1 check {star}
0 check {rbt-griffis-duffy}
0 check-pentapod {line-plane}
0 shell-completions bash
0 equivalents-components {rbt-octahedral} --samples 1
0 equivalents-components {rbt-griffis-duffy} --samples 1
0 equivalents-components {symmetric-hexapod} --family 1
0 equivalents-components {general-6-6}
0 equivalents-components {rbt-midline}
0 design-convert {rbt-octahedral} -o {converted.json}
0 design-convert {rbt-octahedral} --units in -o {inches.toml}
2 error fk no-such.toml
2 error fk Cargo.toml
2 error fk
2 error fk {general-6-6} --method octic
1 error equivalents topologies {star}
0 explore {rbt-octahedral} --samples 1 -o {explored}
1 explore {apart} --samples 1 -o {none}
1 explore {general-6-6} --samples 1 -o {general}
0 explore {rbt-griffis-duffy} --samples 1 -o {made}
0 equivalents-nearest {general-6-6} -o {nearest.toml}
0 report {explored}
0 export {rbt-octahedral} --to csv,svg -o {exported}
1 export {rbt-octahedral} --to all --hole-diameter 20 --ball-diameter 25 --margin 30 -o {exported}
0 equivalents-family {rbt-octahedral}
0 equivalents-family {rbt-octahedral} --pattern S123456 --offsets=0.2,0.21,0.22,0.2,0.2,0.23
0 at {bench-octahedral} --wrench 0,0,-10,0,0,0 --leg 2 --nearest-singular
0 at {symmetric-hexapod} --forces 1,1,1,1,1,1 --point 0,0,20 --axes platform
0 ik {symmetric-hexapod} --pose 0,0,360,5,0,0 --rotation-order pi --pivot 0,0,20 --angle-unit rad
0 limits {bench-octahedral}
0 limits {rbt-octahedral}
1 limits {bench-octahedral} --at 0,0,900,0,0,0 --starts 1
1 limits {bench-octahedral} --at home --to 0,0,230,0,40,0 --starts 1
0 fk {rbt-octahedral}
0 fk {rbt-octahedral} --near home
3 fk {rbt-octahedral} --near home --lengths 1,1,1,1,1,1
0 fk {coupled} --near home
0 fk {rbt-octahedral} --method trilateration
0 fk {innocenti-6-4} --method trilateration
3 fk {symmetric-hexapod} --method trilateration
0 fk {rbt-octahedral} --method homotopy
0 fk {general-6-6}
0 fk {rbt-midline}
0 fk {rbt-midline} --lengths 18,18,17,16,15,19
0 fk {rbt-octahedral} --lengths {rows}
0 fk {rbt-midline} --lengths {rows}
2 fk {general-6-6} --method octic --lengths {rows}
3 fk {rbt-octahedral} --near home --lengths {way}
0 ik {bench-octahedral}
0 ik {coupled}
0 ik {flexures} --pose 3,5,350,0,2,9
0 ik {rbt-octahedral} --pose home --pose 3,5,9,0,0,90
0 ik {rbt-octahedral} {places}
0 new --servo --crank 24 --base-radius 80 --platform-radius 60 --base-spread 20 --platform-spread 20 --rod 120
0 new --base-radius 500 --platform-radius 300 --base-spread 20 --platform-spread 20 --height 400
0 new --points designs/tables/hexapod.csv -o {imported.toml}
0 help fk --help
0 help --version
0 help --licences
0 plot-locus {innocenti-6-4} --leg 6 --from 3 --to 7 --steps 21
0 shell-man -o {man}
0 equivalents-map {rbt-octahedral} {free}
1 equivalents-map {rbt-octahedral} {rbt-midline}
1 equivalents-map {rbt-octahedral} {rbt-griffis-duffy} --exchange -o {exchanged.toml}
3 equivalents-map {general-6-6} {turned} --align -o {aligned.toml}
1 equivalents-map {general-6-6} {off} --align
0 compare {rbt-octahedral} {rbt-griffis-duffy} --points 20 --sine z:1:1 --accuracy 0.1,0.05 --csv {compare.csv} -o {compare.html}
0 compare {simulator-octahedral} {simulator-joint-free} --points 20 --accelerate z:1
0 calibrate {symmetric-hexapod} designs/tables/calibration.csv --frames design -o {machine.toml}
1 calibrate {symmetric-hexapod} designs/tables/calibration.csv --sigma-length 0.001 --loss huber --check designs/tables/calibration.csv
0 calibrate {symmetric-hexapod} --next 2
0 motion {simulator-octahedral} --sine z:0.05:0.5 --accelerate x:1 --csv {motion.csv}
1 motion {simulator-octahedral} --sine z:0.05:4
0 motion {bench-octahedral} --sine x:1:1
0 equivalents-move {rbt-octahedral} --leg 1 --along 1 --to 0.1
0 equivalents-move {rbt-octahedral} --move 1:1:0.1 --move 2:P2:P4-P5:0.2 --together
1 equivalents-move {rbt-octahedral} --move 1:P1-P2:P4:0.5 --move 2:P2:P4-P5:0.5 --move 3:P2-P3:P5:0.5 --move 4:P3:P5-P6:0.5 --move 5:P3-P1:P6:0.5 --move 6:P1:P6-P4:0.5 --move 1:P1-P2:P4:0.5
0 equivalents-move {rbt-octahedral} --search --no-shared-joints --no-crossing --hole base:1.5,2.598076211353316,0
1 equivalents-move {innocenti-6-4} --search --no-shared-joints -o {found}
1 equivalents-move {rbt-octahedral} --search --hole base:5,5,40
3 equivalents-move {rbt-octahedral} --search --spacing 1000
0 optimize {rbt-octahedral} -o {optimised.toml}
1 optimize {apart}
0 optimize {lifted}
1 optimize {conflict}
0 optimize {turning}
1 optimize {turning-conflict}
0 optimize {lifted} --drives {struts}
1 explore {conflict} --drives {weak-struts} --samples 1 -o {driven}
0 optimize {cone_limited}
0 optimize {front} -o {front.toml}
1 optimize {no-front}
0 plot modes {rbt-octahedral}
0 plot det {rbt-octahedral} -o {det.svg}
0 design-presets
0 design-presets bench-l16
0 design-presets bench-l16 -o {l16.toml}
0 build-drives {small-bench} {drives} --sine z:1:1 -o {driven.toml}
1 build-drives {small-bench} {weak-drives}
1 build-round {ringed} --trials 10
0 build-round {rbt-octahedral} --grid 1 --trials 10
0 build-round {outer} --grid 0.25 --trials 10 --free-grid -o {rounded.toml}
1 build-round {crowded} --grid 0.25 --trials 10
0 build-round {symmetric-hexapod} --grid 1 --trials 10
0 design-schema fk
0 singular-motion {rbt-midline} --sections 0
1 singular-motion {rbt-octahedral}
1 singular-motion {rbt-midline} --lengths 18,18,17,16,15,19
0 singular-locus {rbt-octahedral} --pose 0,0,1,1,1/2,0,0
0 singular-locus {symmetric-hexapod} --about 1,2,3
1 singular-locus {rbt-midline} --along 0,0,1
0 singular-poses {rbt-octahedral} --cells 500 --between --samples 20 --path 1,2
3 singular-poses {rbt-midline} --cells 500
0 build-tolerances {rbt-octahedral} --bound 0.01,0.1 --points 10 --searches 0 --trials 10 --length-error 0.01 --growth 1e-5,1e-5,2e-5 --map {errors.csv}
0 build-tolerances {rbt-octahedral} --bound 0.1,0.1 --trials 10
0 build-tolerances {twins} --bound 0.1,0.1 --trials 10 --points 20
0 equivalents-topologies {rbt-octahedral} --rearrangements
0 equivalents-topologies {symmetric-hexapod} --members 1
0 equivalents-topologies --members 1
0 verify {rbt-octahedral} {free} --samples 1
1 verify {rbt-octahedral} {rbt-midline} --samples 1
1 verify {general-6-6} {off} --samples 1
3 verify {general-6-6} {turned} --align --samples 1
1 verify {general-6-6} {off} --align --samples 1
0 view {rbt-octahedral} -o {view.html}
0 sweep-run {small-plan} --estimate
0 sweep-run {small-plan} --shards 2 -o {swept}
0 sweep-status {swept}
0 sweep-merge {swept} -o {merged.parquet}
0 sweep-verify {swept} --sample 3
0 sweep-best {swept} --by candidate --count 2 -o {best}
1 sweep-best {swept} --by candidate --keep candidate<0 -o {best}
0 sweep-design {swept} --candidate 1
0 sweep-design {swept} --candidate 1 -o {candidate.toml}
0 sweep-script {small-plan} --slurm --folder {swept}
0 sweep-script {small-plan} --slurm --folder {swept} -o {swept.sh}
"""

OCTAHEDRAL = "designs/rbt-octahedral.toml"
HEXAPOD = "designs/symmetric-hexapod.toml"
OFFSETS = {"free": "0.2,0.21,0.22,0.2,0.2,0.23", "outer": "-0.2,0.21,-0.22,0.2,-0.2,0.23"}
TABLES = {
    "struts": "name,stroke,retracted_length,price_EUR\ntiny,0.1,14,10\ntinier,0.05,14.02,20\ngood,9,9,30\nlong,12,8,40\n",
    "weak-struts": "name,stroke,retracted_length\ntiny,0.1,14\n",
    "drives": "name,stroke_mm,dead_length_mm,force_N,speed_mm/s,mass_kg,stiffness_N/mm,price_EUR,source\n"
    "fits,100,98,46,10,2,500,90,invented\nshort,40,98,46,10,1,500,50,invented\nsilent,100,98,,,,,,\n",
    "weak-drives": "name,stroke,retracted_length,force\nweak,100,198,1\n",
    "places": "l1,l2,l3,l4,l5,l6\n3,5,9,0,0,90\n3,5,9.5,0,10,90\n",
    "rows": "l1,l2,l3,l4,l5,l6\n18,18,17,16,15,19\n1,1,1,1,1,1\n",
}


def turn(design):
    """A quarter turn about z and a shift of the base frame."""
    for joint in design["base"].values():
        joint[:] = [1.0 - joint[1], joint[0], joint[2]]
    design.pop("home", None)


def off(design):
    turn(design)
    next(iter(design["base"].values()))[0] += 0.01


def star(design):
    for leg in design["legs"][:4]:
        leg[0] = design["legs"][0][0]
    design.pop("lengths", None)


def longer(design):
    design["lengths"][0] += 1e-3


def universal(design):
    joint = {"model": "universal", "first_axis": [0.6, 0.8, 0.0], "angle_deg": [70.0, 60.0]}
    design["hardware"].update(base_joint=joint, platform_joint=joint)


def coupled(design):
    joint = {"model": "universal", "first_axis": [0.6, 0.8, 0.0], "offset": 9.0}
    design["hardware"].update(base_joint=joint, platform_joint=joint, screw_lead=6.0)


def flexures(design):
    design["hardware"].update(base_cone_angle_deg=20.0, base_joint={"model": "flexure", "bending_stiffness": 4e4})


def ringed(design):
    ring = {"pattern": "polar", "first_radius": 0.5, "pitch": 0.25, "step_deg": 2.5}
    design["holes"] = {"base": ring, "pattern": "bolt_circle", "radii": [3.0, 3.5], "count": [36, 48]}


def small(design):
    design["workspace"].update(translation=[8.0, 8.0, 8.0], rotation_deg=[2.0, 2.0, 2.0])


def searched(search, hardware=None, ahead=1.75):
    """A change of a design: the requirements and the search at a home pose `ahead` of the origin."""

    def change(design):
        design["home"] = {"position": [3.0, ahead, 12.0], "rpy_deg": [0.0, 0.0, 0.0]}
        design["workspace"] = {"translation": [0.5, 0.5, 0.5]}
        design["optimize"] = search
        if hardware:
            design["hardware"] = hardware

    return change


def front(variable):
    return {"variables": [variable], "objectives": ["worst_conditioning", "joint_spacing"], "mode": "pareto", "points": 2}


HOME = {"variables": ["home_height"]}
ROOMY, TIGHT = {"leg_length": [9.0, 18.0]}, {"leg_length": [14.0, 14.1]}
ABOVE = 3.0 * math.sqrt(3.0)  # the triangles are one above the other
CONE_LIMITED = ROOMY | {"base_cone_angle_deg": 60.0, "base_axes": "optimize"}
DESIGNS = {
    "turned": ("designs/general-6-6.toml", turn),
    "off": ("designs/general-6-6.toml", off),
    "star": ("designs/general-6-6.toml", star),
    "longer": ("designs/rbt-midline.toml", longer),
    "universal": (HEXAPOD, universal),
    "coupled": (HEXAPOD, coupled),
    "flexures": (HEXAPOD, flexures),
    "ringed": (OCTAHEDRAL, ringed),
    "small-bench": ("designs/presets/bench-l16.toml", small),
    "twins": (OCTAHEDRAL, lambda d: d["base"].update(spare=[0.0, 0.0, 1.0])),
    "apart": (OCTAHEDRAL, lambda d: d.update(optimize={"min_joint_distance": 6.5})),
    "lifted": (OCTAHEDRAL, searched(HOME, ROOMY)),
    "conflict": (OCTAHEDRAL, searched(HOME, TIGHT)),
    "turning": (OCTAHEDRAL, searched({"variables": ["offsets"]}, ROOMY, ABOVE)),
    "turning-conflict": (OCTAHEDRAL, searched({"variables": ["offsets"], "offset_bounds": [0.1, 0.3]}, TIGHT, ABOVE)),
    "cone_limited": (OCTAHEDRAL, searched({"variables": ["symmetric_offsets", "joint_axes"]}, CONE_LIMITED)),
    "front": (OCTAHEDRAL, searched(front("symmetric_offsets"))),
    "no-front": (OCTAHEDRAL, searched(front("home_height"), TIGHT)),
    "crowded": ("outer", searched({}, {"joint_diameter": 30.0})),
}


class Files:
    """A folder with the designs and tables of the calls, each made where it is first asked for."""

    def __init__(self, program, root, folder):
        self.program, self.root, self.folder = program, root, folder

    def ask(self, words):
        """Exit code and text of a call that is made beside the shipped designs."""
        done = subprocess.run([self.program, *map(str, words)], cwd=self.root, capture_output=True, text=True)
        return done.returncode, done.stdout

    def done(self, *words):
        code, text = self.ask(words)
        assert code == 0, f"{words}: exit {code}: {text}"
        return text

    def path(self, name):
        """The file of that name: shipped, made here, or a place to write to."""
        for folder in ("designs", "designs/worked", "designs/presets", "designs/pentapods"):
            if (self.root / folder / f"{name}.toml").exists():
                return f"{folder}/{name}.toml"
        if name in OFFSETS:
            made = self.folder / f"{name}.toml"
            if not made.exists():
                self.done("equivalents", "family", OCTAHEDRAL, "--pattern", "S123456", f"--offsets={OFFSETS[name]}", "-o", made)
        elif name in DESIGNS:
            made, (source, change) = self.folder / f"{name}.json", DESIGNS[name]
            if not made.exists():
                self.done("design", "convert", source if "/" in source else self.path(source), "-o", made)
                design = json.loads(made.read_text())
                change(design)
                made.write_text(json.dumps(design))
        elif name in TABLES:
            made = self.folder / f"{name}.csv"
            made.write_text(TABLES[name])
        elif name == "way":
            # a trajectory needs lengths near those of home
            lengths = json.loads(self.done("singular", "poses", OCTAHEDRAL, "--cells", 500, "--json"))["lengths"]
            near = [",".join(str(x + by) for x in lengths) for by in (0.0, 0.01)]
            made = self.folder / "way.csv"
            made.write_text("\n".join(["l1,l2,l3,l4,l5,l6", *near, "1,1,1,1,1,1"]) + "\n")
        elif name == "small-plan":
            made = self.folder / "small-plan.json"
            vary = [{"by": "grid", "values": {"base.P2.y": {"from": 9.0, "to": 11.0, "count": 5}}}]
            plan = {"name": "small", "design": str(self.root / OCTAHEDRAL), "compute": ["spacing"], "vary": vary}
            made.write_text(json.dumps(plan))
        else:
            made = self.folder / name
        return str(made)


def answers(program, root, folder):
    """For each call its words, the exit code that it should have, the one that it has, the schema of its answer, and
    the answer. The files of `explore` follow."""
    files = Files(program, root, folder)
    for call in CALLS.strip().splitlines():
        code, name, *arguments = call.split()
        command = [] if name in ("error", "help") else name.removesuffix("-pentapod").split("-")
        words = [files.path(w[1:-1]) if w[0] + w[-1] == "{}" else w for w in [*command, *arguments]]
        found, text = files.ask([*words, "--json"])
        yield " ".join(words), int(code), found, name, text
    explored = folder / "explored"
    for file, name in (("family", "equivalents-family"), ("optimize", "optimize"), ("verify", "verify")):
        yield f"{file}.json of explore", 0, 0, name, (explored / f"{file}.json").read_text()
    # the poses of `explore` are those of `fk` with the lengths they belong to
    poses = json.loads((explored / "fk.json").read_text())
    del poses["lengths"], poses["lengths_from"]
    yield "fk.json of explore", 0, 0, "fk", json.dumps(poses)

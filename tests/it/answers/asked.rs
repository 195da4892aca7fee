//! What is asked of each command, so that its answers in all their outcomes are seen, with the designs and tables that bring them about.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::super::cli_frame::{document, equipod};

/// A call: exit code, the schema of its answer, arguments.
pub(super) type Asked = (i32, &'static str, Vec<String>);

/// The words of a call; `{name}` stands for a file of [`Files`].
const CALLS: &[(i32, &str, &str)] = &[
    (0, "assess", "{bench-octahedral} --points 50"),
    (0, "assess", "{universal} --points 50"),
    (1, "assess", "{conflict} --points 50"),
    (0, "bench", "--class octahedral --count 2"),
    (0, "bench", "--class octahedral,T05 --count 1 --recheck-every 0"),
    (1, "bench", "--class hexapod-home --count 1 --recheck-every 0 --method template"),
    (0, "bench", "--noise --class octahedral --count 1"),
    (0, "check", "{rbt-octahedral}"),
    (1, "check", "{rbt-midline}"),
    (1, "check", "{longer}"),
    (1, "check", "{star}"),
    (0, "check", "{rbt-griffis-duffy}"),
    (0, "shell-completions", "bash"),
    (0, "equivalents-components", "{rbt-octahedral} --samples 1"),
    (0, "equivalents-components", "{rbt-griffis-duffy} --samples 1"),
    (0, "equivalents-components", "{symmetric-hexapod} --family 1"),
    (0, "equivalents-components", "{general-6-6}"),
    (0, "equivalents-components", "{rbt-midline}"),
    (0, "design-convert", "{rbt-octahedral} -o {converted.json}"),
    (0, "design-convert", "{rbt-octahedral} --units in -o {inches.toml}"),
    (2, "error", "fk no-such.toml"),
    (2, "error", "fk Cargo.toml"),
    (2, "error", "fk"),
    (2, "error", "fk {general-6-6} --method octic"),
    (1, "error", "equivalents topologies {star}"),
    (0, "explore", "{rbt-octahedral} --samples 1 -o {explored}"),
    (1, "explore", "{apart} --samples 1 -o {none}"),
    (1, "explore", "{general-6-6} --samples 1 -o {general}"),
    (0, "explore", "{rbt-griffis-duffy} --samples 1 -o {made}"),
    (0, "equivalents-nearest", "{general-6-6} -o {nearest.toml}"),
    (0, "report", "{explored}"),
    (0, "export", "{rbt-octahedral} --to csv,svg -o {exported}"),
    (
        1,
        "export",
        "{rbt-octahedral} --to all --hole-diameter 20 --ball-diameter 25 --margin 30 -o {exported}",
    ),
    (0, "equivalents-family", "{rbt-octahedral}"),
    (0, "equivalents-family", "{rbt-octahedral} --pattern S123456 --offsets=0.2,0.21,0.22,0.2,0.2,0.23"),
    (0, "limits", "{bench-octahedral}"),
    (0, "limits", "{rbt-octahedral}"),
    (1, "limits", "{bench-octahedral} --at 0,0,900,0,0,0 --starts 1"),
    (1, "limits", "{bench-octahedral} --at home --to 0,0,230,0,40,0 --starts 1"),
    (0, "fk", "{rbt-octahedral}"),
    (0, "fk", "{rbt-octahedral} --near home"),
    (3, "fk", "{rbt-octahedral} --near home --lengths 1,1,1,1,1,1"),
    (0, "fk", "{coupled} --near home"),
    (0, "fk", "{rbt-octahedral} --method trilateration"),
    (0, "fk", "{innocenti-6-4} --method trilateration"),
    (3, "fk", "{symmetric-hexapod} --method trilateration"),
    (0, "fk", "{rbt-octahedral} --method homotopy"),
    (0, "fk", "{general-6-6}"),
    (0, "fk", "{rbt-midline}"),
    (0, "fk", "{rbt-midline} --lengths 18,18,17,16,15,19"),
    (0, "fk", "{rbt-octahedral} --lengths {rows}"),
    (0, "fk", "{rbt-midline} --lengths {rows}"),
    (2, "fk", "{general-6-6} --method octic --lengths {rows}"),
    (3, "fk", "{rbt-octahedral} --near home --lengths {way}"),
    (0, "ik", "{bench-octahedral}"),
    (0, "ik", "{coupled}"),
    (0, "ik", "{flexures} --pose 3,5,350,0,2,9"),
    (0, "ik", "{rbt-octahedral} --pose home --pose 3,5,9,0,0,90"),
    (0, "ik", "{rbt-octahedral} {places}"),
    (0, "new", "--base-radius 500 --platform-radius 300 --base-spread 20 --platform-spread 20 --height 400"),
    (0, "new", "--points designs/tables/hexapod.csv -o {imported.toml}"),
    (0, "help", "fk --help"),
    (0, "help", "--version"),
    (0, "help", "--licences"),
    (0, "plot-locus", "{innocenti-6-4} --leg 6 --from 3 --to 7 --steps 21"),
    (0, "shell-man", "-o {man}"),
    (0, "equivalents-map", "{rbt-octahedral} {free}"),
    (1, "equivalents-map", "{rbt-octahedral} {rbt-midline}"),
    (1, "equivalents-map", "{rbt-octahedral} {rbt-griffis-duffy} --exchange -o {exchanged.toml}"),
    (0, "equivalents-map", "{general-6-6} {turned} --align -o {aligned.toml}"),
    (1, "equivalents-map", "{general-6-6} {off} --align"),
    (
        0,
        "compare",
        "{rbt-octahedral} {rbt-griffis-duffy} --points 20 --sine z:1:1 --accuracy 0.1,0.05 --csv {compare.csv} -o {compare.html}",
    ),
    (0, "compare", "{simulator-octahedral} {simulator-joint-free} --points 20 --accelerate z:1"),
    (0, "calibrate", "{symmetric-hexapod} designs/tables/calibration.csv --frames design -o {machine.toml}"),
    (
        1,
        "calibrate",
        "{symmetric-hexapod} designs/tables/calibration.csv --sigma-length 0.001 --loss huber --check designs/tables/calibration.csv",
    ),
    (0, "calibrate", "{symmetric-hexapod} --next 2"),
    (0, "motion", "{simulator-octahedral} --sine z:0.05:0.5 --accelerate x:1 --csv {motion.csv}"),
    (1, "motion", "{simulator-octahedral} --sine z:0.05:4"),
    (0, "motion", "{bench-octahedral} --sine x:1:1"),
    (0, "equivalents-move", "{rbt-octahedral} --leg 1 --along 1 --to 0.1"),
    (0, "equivalents-move", "{rbt-octahedral} --move 1:1:0.1 --move 2:P2:P4-P5:0.2 --together"),
    (
        1,
        "equivalents-move",
        "{rbt-octahedral} --move 1:P1-P2:P4:0.5 --move 2:P2:P4-P5:0.5 --move 3:P2-P3:P5:0.5 --move 4:P3:P5-P6:0.5 \
         --move 5:P3-P1:P6:0.5 --move 6:P1:P6-P4:0.5 --move 1:P1-P2:P4:0.5",
    ),
    (
        0,
        "equivalents-move",
        "{rbt-octahedral} --search --no-shared-joints --no-crossing --hole base:1.5,2.598076211353316,0",
    ),
    (1, "equivalents-move", "{innocenti-6-4} --search --no-shared-joints -o {found}"),
    (1, "equivalents-move", "{rbt-octahedral} --search --hole base:5,5,40"),
    (3, "equivalents-move", "{rbt-octahedral} --search --spacing 1000"),
    (0, "optimize", "{rbt-octahedral} -o {optimised.toml}"),
    (1, "optimize", "{apart}"),
    (0, "optimize", "{lifted}"),
    (1, "optimize", "{conflict}"),
    (0, "optimize", "{turning}"),
    (1, "optimize", "{turning-conflict}"),
    (0, "optimize", "{lifted} --drives {struts}"),
    (1, "explore", "{conflict} --drives {weak-struts} --samples 1 -o {driven}"),
    (0, "optimize", "{swinging}"),
    (0, "optimize", "{front} -o {front.toml}"),
    (1, "optimize", "{no-front}"),
    (0, "plot", "modes {rbt-octahedral}"),
    (0, "plot", "det {rbt-octahedral} -o {det.svg}"),
    (0, "design-presets", ""),
    (0, "design-presets", "bench-l16"),
    (0, "design-presets", "bench-l16 -o {l16.toml}"),
    (0, "build-drives", "{small-bench} {drives} --sine z:1:1 -o {driven.toml}"),
    (1, "build-drives", "{small-bench} {weak-drives}"),
    (1, "build-round", "{ringed} --trials 10"),
    (0, "build-round", "{rbt-octahedral} --grid 1 --trials 10"),
    (0, "build-round", "{outer} --grid 0.25 --trials 10 --free-grid -o {rounded.toml}"),
    (1, "build-round", "{crowded} --grid 0.25 --trials 10"),
    (0, "build-round", "{symmetric-hexapod} --grid 1 --trials 10"),
    (0, "design-schema", "fk"),
    (0, "singular-motion", "{rbt-midline} --sections 0"),
    (1, "singular-motion", "{rbt-octahedral}"),
    (1, "singular-motion", "{rbt-midline} --lengths 18,18,17,16,15,19"),
    (0, "singular-poses", "{rbt-octahedral} --cells 500 --between --samples 20 --path 1,2"),
    (3, "singular-poses", "{rbt-midline} --cells 500"),
    (
        0,
        "build-tolerances",
        "{rbt-octahedral} --bound 0.01,0.1 --points 10 --searches 0 --trials 10 --length-error 0.01 --growth 1e-5,1e-5,2e-5 --map {errors.csv}",
    ),
    (0, "build-tolerances", "{rbt-octahedral} --bound 0.1,0.1 --trials 10"),
    (0, "build-tolerances", "{twins} --bound 0.1,0.1 --trials 10 --points 20"),
    (0, "equivalents-topologies", "{rbt-octahedral} --rearrangements"),
    (0, "equivalents-topologies", "{symmetric-hexapod} --members 1"),
    (0, "equivalents-topologies", "--members 1"),
    (0, "verify", "{rbt-octahedral} {free} --samples 1"),
    (1, "verify", "{rbt-octahedral} {rbt-midline} --samples 1"),
    (1, "verify", "{general-6-6} {off} --samples 1"),
    (0, "verify", "{general-6-6} {turned} --align --samples 1"),
    (1, "verify", "{general-6-6} {off} --align --samples 1"),
    (0, "view", "{rbt-octahedral} -o {view.html}"),
    (0, "sweep-run", "{small-plan} --estimate"),
    (0, "sweep-run", "{small-plan} --shards 2 -o {swept}"),
    (0, "sweep-status", "{swept}"),
    (0, "sweep-merge", "{swept} -o {merged.parquet}"),
    (0, "sweep-verify", "{swept} --sample 3"),
    (0, "sweep-best", "{swept} --by candidate --count 2 -o {best}"),
    (1, "sweep-best", "{swept} --by candidate --keep candidate<0 -o {best}"),
    (0, "sweep-design", "{swept} --candidate 1"),
    (0, "sweep-design", "{swept} --candidate 1 -o {candidate.toml}"),
    (0, "sweep-script", "{small-plan} --slurm --folder {swept}"),
    (0, "sweep-script", "{small-plan} --slurm --folder {swept} -o {swept.sh}"),
];

/// The calls with the paths of their files, those of schemas that `wanted` takes.
pub(super) fn asked(files: &mut Files, wanted: impl Fn(&str) -> bool) -> Vec<Asked> {
    let calls = CALLS.iter().filter(|(_, name, _)| wanted(name));
    let call = |(exit, name, text): &(i32, &'static str, &str)| {
        let command = if ["error", "help"].contains(name) { String::new() } else { name.replace('-', " ") };
        let words = [command.as_str(), text].map(str::split_whitespace).into_iter().flatten();
        let word = |w: &str| match w.strip_prefix('{').and_then(|w| w.strip_suffix('}')) {
            Some(file) => files.path(file).display().to_string(),
            None => w.to_owned(),
        };
        (*exit, *name, words.map(word).collect())
    };
    calls.map(call).collect()
}

/// Schemas that the calls are about.
pub(super) fn seen() -> impl Iterator<Item = &'static str> {
    CALLS.iter().map(|(_, name, _)| *name)
}

/// A folder with designs and tables, made where they are first asked for.
#[derive(Debug)]
pub(super) struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    pub(super) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(super) fn beside(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The file of that name: shipped, made here, or a place to write to.
    fn path(&mut self, name: &str) -> PathBuf {
        for folder in ["designs", "designs/worked", "designs/presets"] {
            let shipped = Path::new(folder).join(format!("{name}.toml"));
            if Path::new(env!("CARGO_MANIFEST_DIR")).join(&shipped).exists() {
                return shipped;
            }
        }
        let octahedral = "designs/rbt-octahedral.toml";
        let home = &["home_height"][..];
        match name {
            "free" => self.family(name, "0.2,0.21,0.22,0.2,0.2,0.23"),
            "outer" => self.family(name, "-0.2,0.21,-0.22,0.2,-0.2,0.23"),
            "turned" => self.design(name, "designs/general-6-6.toml", turn),
            "off" => self.design(name, "designs/general-6-6.toml", |d| {
                turn(d);
                let joint = d["base"].as_object_mut().unwrap().values_mut().next().unwrap();
                joint[0] = json!(joint[0].as_f64().unwrap() + 0.01);
            }),
            "star" => self.design(name, "designs/general-6-6.toml", |d| {
                let first = d["legs"][0][0].clone();
                (0..4).for_each(|k| d["legs"][k][0] = first.clone());
                d.as_object_mut().unwrap().remove("lengths");
            }),
            "longer" => self.design(name, "designs/rbt-midline.toml", |d| {
                d["lengths"][0] = json!(d["lengths"][0].as_f64().unwrap() + 1e-3);
            }),
            "universal" => self.design(name, "designs/symmetric-hexapod.toml", |d| {
                let joint =
                    json!({"model": "universal", "first_axis": [0.6, 0.8, 0.0], "angle_deg": [70.0, 60.0]});
                (d["hardware"]["base_joint"], d["hardware"]["platform_joint"]) = (joint.clone(), joint);
            }),
            "coupled" => self.design(name, "designs/symmetric-hexapod.toml", |d| {
                let joint = json!({"model": "universal", "first_axis": [0.6, 0.8, 0.0], "offset": 9.0});
                (d["hardware"]["base_joint"], d["hardware"]["platform_joint"]) = (joint.clone(), joint);
                d["hardware"]["screw_lead"] = json!(6.0);
            }),
            "flexures" => self.design(name, "designs/symmetric-hexapod.toml", |d| {
                d["hardware"]["base_swing_deg"] = json!(20.0);
                d["hardware"]["base_joint"] = json!({"model": "flexure", "bending_stiffness": 4e4});
            }),
            "twins" => self.design(name, octahedral, |d| d["base"]["spare"] = json!([0.0, 0.0, 1.0])),
            "apart" => self.design(name, octahedral, |d| d["optimize"] = json!({"min_joint_distance": 6.5})),
            "lifted" => {
                let hardware = json!({"leg_length": [9.0, 18.0]});
                self.design(name, octahedral, |d| require(d, json!({"variables": home}), hardware))
            }
            "conflict" => {
                let hardware = json!({"leg_length": [14.0, 14.1]});
                self.design(name, octahedral, |d| require(d, json!({"variables": home}), hardware))
            }
            "turning" => {
                let hardware = json!({"leg_length": [9.0, 18.0]});
                self.design(name, octahedral, |d| turning(d, json!({"variables": ["offsets"]}), hardware))
            }
            "turning-conflict" => {
                let hardware = json!({"leg_length": [14.0, 14.1]});
                let search = json!({"variables": ["offsets"], "offset_bounds": [0.1, 0.3]});
                self.design(name, octahedral, |d| turning(d, search, hardware))
            }
            "struts" => {
                let path = self.beside("struts.csv");
                let head = "name,stroke,retracted_length,price_EUR";
                fs::write(
                    &path,
                    format!("{head}\ntiny,0.1,14,10\ntinier,0.05,14.02,20\ngood,9,9,30\nlong,12,8,40\n"),
                )
                .unwrap();
                path
            }
            "weak-struts" => {
                let path = self.beside("weak-struts.csv");
                fs::write(&path, "name,stroke,retracted_length\ntiny,0.1,14\n").unwrap();
                path
            }
            "swinging" => self.design(name, octahedral, |d| {
                let hardware =
                    json!({"leg_length": [9.0, 18.0], "base_swing_deg": 60.0, "base_axes": "optimize"});
                require(d, json!({"variables": ["symmetric_offsets", "joint_axes"]}), hardware);
            }),
            "front" => {
                self.design(name, octahedral, |d| require(d, front(&["symmetric_offsets"]), Value::Null))
            }
            "no-front" => {
                let hardware = json!({"leg_length": [14.0, 14.1]});
                self.design(name, octahedral, |d| require(d, front(home), hardware))
            }
            "crowded" => {
                let outer = self.path("outer");
                let hardware = json!({"joint_diameter": 30.0});
                self.design(name, outer.to_str().unwrap(), |d| require(d, json!({}), hardware))
            }
            "ringed" => self.design(name, octahedral, |d| {
                let ring = json!({"pattern": "polar", "first_radius": 0.5, "pitch": 0.25, "step_deg": 2.5});
                d["holes"] =
                    json!({"base": ring, "pattern": "bolt_circle", "radii": [3.0, 3.5], "count": [36, 48]});
            }),
            "small-bench" => self.design(name, "designs/presets/bench-l16.toml", |d| {
                (d["workspace"]["translation"], d["workspace"]["rotation_deg"]) =
                    (json!([8.0, 8.0, 8.0]), json!([2.0, 2.0, 2.0]));
            }),
            "drives" => {
                let path = self.beside("drives.csv");
                let head = "name,stroke_mm,dead_length_mm,force_N,speed_mm/s,mass_kg,stiffness_N/mm,price_EUR,source";
                fs::write(&path, format!("{head}\nfits,100,98,46,10,2,500,90,invented\nshort,40,98,46,10,1,500,50,invented\nsilent,100,98,,,,,,\n")).unwrap();
                path
            }
            "weak-drives" => {
                let path = self.beside("weak-drives.csv");
                fs::write(&path, "name,stroke,retracted_length,force\nweak,100,198,1\n").unwrap();
                path
            }
            "places" => self.table(name, &["3,5,9,0,0,90".into(), "3,5,9.5,0,10,90".into()]),
            "rows" => self.table(name, &["18,18,17,16,15,19".into(), "1,1,1,1,1,1".into()]),
            "way" => {
                // a trajectory needs lengths near those of home
                let doc = document(&equipod(&["singular", "poses", octahedral, "--cells", "500", "--json"]));
                let near = |by: f64| {
                    let lengths = doc["lengths"].as_array().unwrap().iter();
                    lengths.map(|x| (x.as_f64().unwrap() + by).to_string()).collect::<Vec<_>>().join(",")
                };
                self.table(name, &[near(0.0), near(0.01), "1,1,1,1,1,1".into()])
            }
            "small-plan" => {
                let path = self.beside("small-plan.json");
                let base = Path::new(env!("CARGO_MANIFEST_DIR")).join(octahedral);
                let values = json!({"base.P2.y": {"from": 9.0, "to": 11.0, "count": 5}});
                let plan = json!({"name": "small", "design": base, "compute": ["spacing"], "vary": [{"by": "grid", "values": values}]});
                fs::write(&path, plan.to_string()).unwrap();
                path
            }
            _ => self.beside(name),
        }
    }

    fn family(&self, name: &str, offsets: &str) -> PathBuf {
        let path = self.beside(&format!("{name}.toml"));
        if !path.exists() {
            let offsets = format!("--offsets={offsets}");
            let source = "designs/rbt-octahedral.toml";
            let call = ["equivalents", "family", source, "--pattern", "S123456", &offsets, "-o"];
            done(&[&call[..], &[path.to_str().unwrap()]].concat());
        }
        path
    }

    fn design(&self, name: &str, source: &str, change: impl FnOnce(&mut Value)) -> PathBuf {
        let path = self.beside(&format!("{name}.json"));
        if !path.exists() {
            done(&["design", "convert", source, "-o", path.to_str().unwrap()]);
            let mut design = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            change(&mut design);
            fs::write(&path, design.to_string()).unwrap();
        }
        path
    }

    fn table(&self, name: &str, rows: &[String]) -> PathBuf {
        let path = self.beside(&format!("{name}.csv"));
        fs::write(&path, format!("l1,l2,l3,l4,l5,l6\n{}\n", rows.join("\n"))).unwrap();
        path
    }
}

fn done(args: &[&str]) {
    let out = equipod(args);
    assert_eq!(out.status.code(), Some(0), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
}

/// A quarter turn about z and a shift of the base frame.
fn turn(design: &mut Value) {
    for joint in design["base"].as_object_mut().unwrap().values_mut() {
        let [x, y, z] = [0, 1, 2].map(|k| joint[k].as_f64().unwrap());
        *joint = json!([1.0 - y, x, z]);
    }
    design.as_object_mut().unwrap().remove("home");
}

fn require(design: &mut Value, search: Value, hardware: Value) {
    design["home"] = json!({"position": [3.0, 1.75, 12.0], "rpy_deg": [0.0, 0.0, 0.0]});
    design["workspace"] = json!({"translation": [0.5, 0.5, 0.5]});
    if !hardware.is_null() {
        design["hardware"] = hardware;
    }
    design["optimize"] = search;
}

/// With the triangles one above the other at home.
fn turning(design: &mut Value, search: Value, hardware: Value) {
    require(design, search, hardware);
    design["home"]["position"] = json!([3.0, 3.0 * 3_f64.sqrt(), 12.0]);
}

fn front(variables: &[&str]) -> Value {
    let objectives = ["worst_conditioning", "joint_spacing"];
    json!({"variables": variables, "objectives": objectives, "mode": "pareto", "points": 2})
}

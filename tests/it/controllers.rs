//! C of `export --to c`, compiled and run with the checking programs of `tests/controllers/checks`.

use std::path::{Path, PathBuf};
use std::process::Command;

use equipod::methods::coupled::{CoupledLegs, CoupledTracker};
use equipod::methods::design::{Format, parse_with_cranks};
use equipod::methods::num::Rng;
use equipod::prelude::*;
use tempfile::TempDir;

use super::evidence::size;

/// Whether there is a C compiler; without one a test says that it did not run.
fn compiler() -> bool {
    let there = Command::new("cc").arg("--version").output().is_ok_and(|out| out.status.success());
    #[allow(clippy::print_stderr, reason = "a test that does not run says so")]
    if !there {
        eprintln!("NOT RUN: there is no C compiler `cc`, and the C for controllers is not checked");
    }
    there
}

fn checks() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/controllers")
}

/// The C of a design in a folder.
struct Exported {
    folder: TempDir,
    octahedral: bool,
}

impl Exported {
    fn of(design: &Design) -> Self {
        Self::possible(design).unwrap()
    }

    /// `None` where C does not hold the design.
    fn possible(design: &Design) -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let files = design.export(ExportFormat::C).ok()?;
        for file in &files {
            let path = folder.path().join(&file.name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, &file.text).unwrap();
        }
        let octahedral = files.iter().any(|f| f.text.contains("#define EQUIPOD_HAS_OCTAHEDRAL"));
        Some(Self { folder, octahedral })
    }

    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Compiles sources with these options and runs the program: whether it ends with status 0, and its words.
    fn runs(&self, options: &[&str], sources: &[PathBuf]) -> (bool, String) {
        let program = self.at("program");
        let mut cc = Command::new("cc");
        cc.args(options).args(sources).arg("-lm").arg("-o").arg(&program);
        let made = cc.output().unwrap();
        let text = String::from_utf8_lossy(&made.stderr);
        assert!(made.status.success(), "{options:?} {sources:?}: {text}");
        let done = Command::new(&program).output().unwrap();
        (done.status.success(), String::from_utf8_lossy(&done.stdout).into_owned())
    }

    /// A checking program that includes the code of the kinematics modules, found by one of two include paths.
    fn kinematics(&self, check: &str, include: &str, more: &[&str]) -> (bool, String) {
        let include = format!("-I{}", self.at(include).display());
        let stand_in = format!("-I{}", checks().join("kins").display());
        let options = ["-std=gnu99", "-O0", "-Wall", "-Wextra", "-Werror", "-Wno-unused-function"];
        let options = [&options[..], &[&stand_in, &include], more].concat();
        self.runs(&options, &[checks().join("checks").join(check)])
    }

    /// The checking program of mapped poses, with so many cases of joints that are far off.
    fn mapped(&self, many: u32) -> (bool, String) {
        let include = format!("-I{}", self.folder.path().display());
        let many = format!("-DMANY={many}u");
        let options = ["-std=c99", "-O0", "-Wall", "-Wextra", "-Werror", &include, &many];
        let sources = [checks().join("checks/mapped.c"), self.at("equipod.c"), self.at("equipod_design.c")];
        self.runs(&options, &sources)
    }

    /// Replaces text of a file, which has to be there.
    fn plant(&self, name: &str, from: &str, to: &str) {
        let text = std::fs::read_to_string(self.at(name)).unwrap();
        assert_eq!(text.matches(from).count(), 1, "{name} has no `{from}`");
        std::fs::write(self.at(name), text.replace(from, to)).unwrap();
    }
}

#[test]
fn poses_of_every_worked_design_come_back_through_the_kinematics_of_linuxcnc() {
    if !compiler() {
        return;
    }
    let cases = format!("-DCASES={}u", size(2, 8));
    let mut written = 0;
    for (name, exported) in worked() {
        written += 1;
        let (good, said) = exported.kinematics("poses.c", "linuxcnc", &[&cases]);
        assert!(good, "{name}: {said}");
    }
    assert!(written > 10, "{written}");
}

#[test]
fn poses_of_every_worked_design_come_back_through_its_octahedral_platform() {
    if !compiler() {
        return;
    }
    let mut mapped = 0;
    for (name, exported) in worked().filter(|(_, exported)| exported.octahedral) {
        mapped += 1;
        let (good, said) = exported.mapped(size(20, 300));
        assert!(good, "{name}: {said}");
    }
    assert!(mapped > 2, "{mapped}");
}

/// The worked designs that C holds, with their names.
fn worked() -> impl Iterator<Item = (String, Exported)> {
    std::fs::read_dir("designs/worked").unwrap().filter_map(|file| {
        let path = file.unwrap().path();
        Some((path.display().to_string(), Exported::possible(&Design::load(&path).unwrap())?))
    })
}

#[test]
fn checks_of_poses_find_planted_faults() {
    if !compiler() {
        return;
    }
    let design = Design::load("designs/worked/linuxcnc-griffis-duffy.toml").unwrap();
    let exported = Exported::of(&design);
    // a corrected pose that no test of the measured joints has to prove
    exported.plant(
        "equipod.c",
        "&& correct_on(measured, s, &from, singular, corrections, result))",
        "&& (correct_on(measured, s, &from, singular, corrections, result), 1))",
    );
    assert!(!exported.mapped(3000).0 && !exported.kinematics("poses.c", "linuxcnc", &[]).0);
    // a corrected pose that need not continue the start
    let exported = Exported::of(&design);
    exported.plant("equipod.c", "at_end.epsilon, &from)) {", "at_end.epsilon, &place)) {");
    assert!(!exported.mapped(3000).0);
    // a tool that is not taken off the octahedral pose
    let exported = Exported::of(&design);
    exported.plant("linuxcnc/equipodkins.h", "move_origin(-tool, ", "move_origin(0, ");
    assert!(!exported.kinematics("poses.c", "linuxcnc", &[]).0);
    // joints that are not examined
    let exported = Exported::of(&design);
    exported.plant("equipod.c", "    return finite;\n", "    return 1;\n");
    assert!(!exported.kinematics("poses.c", "linuxcnc", &[]).0);
}

#[test]
fn the_module_of_linuxcnc_starts_at_home_again() {
    if !compiler() {
        return;
    }
    let exported = Exported::of(&Design::load("designs/worked/linuxcnc-griffis-duffy.toml").unwrap());
    let (good, said) = exported.kinematics("module.c", "linuxcnc", &[]);
    assert!(good, "{said}");
    // the folder of the export alone is enough for a program that includes the header
    let (good, said) = exported.kinematics("poses.c", ".", &[]);
    assert!(good, "{said}");
    exported.plant(
        "linuxcnc/equipodkins.h",
        "for (n = reset ? 2 : 0; n < 3; n++)",
        "for (n = 0; n < 2; n++)",
    );
    assert!(!exported.kinematics("module.c", "linuxcnc", &[]).0, "starts that leave home out");
}

/// Sources of C beside the folder for `LinuxCNC`.
fn sources(exported: &Exported) -> Vec<PathBuf> {
    let names = std::fs::read_dir(exported.folder.path()).unwrap().map(|f| f.unwrap().path());
    names.filter(|path| path.extension().is_some_and(|end| end == "c")).collect()
}

/// The symmetric hexapod on universal joints whose axes do not meet, with screws that turn.
fn not_ideal() -> Design {
    let universal = r#"leg_length = [200, 600]
screw_lead = 8
base_joint = { model = "universal", first_axis = [[0, 1, 0], [0, 1, 0], [-0.866, -0.5, 0], [-0.866, -0.5, 0], [0.866, -0.5, 0], [0.866, -0.5, 0]], offset = 14 }
platform_joint = { model = "universal", first_axis = [[0, 1, 0], [0, 1, 0], [-0.866, -0.5, 0], [-0.866, -0.5, 0], [0.866, -0.5, 0], [0.866, -0.5, 0]], offset = 9 }
"#;
    let text = std::fs::read_to_string("designs/symmetric-hexapod.toml").unwrap();
    parse_with_cranks(&format!("{text}{universal}"), Format::Toml).unwrap().0
}

/// Near a singularity the corrections may grow away from a pose to another one: then there is no pose, and never the
/// other one.
#[test]
fn a_pose_of_joints_that_are_not_ideal_is_found_from_itself_or_not_at_all() {
    let design = not_ideal();
    let home = design.home_or_default();
    let legs = CoupledLegs::new(design.manipulator(), &design.hardware, &home).unwrap();
    let scale = design.manipulator().size();
    let (mut rng, mut found, mut lost) = (Rng::new(5), 0, 0);
    for k in 0..size(400, 4000) {
        // as the legs come to lie in the plane of the base, poses are nearly singular
        let low = if k % 2 == 0 { 1.0 } else { 0.04 };
        let mut draw = |most: f64| rng.uniform(-most, most);
        let shift = nalgebra::Vector3::from_fn(|_, _| draw(0.04 * scale));
        let turn = Angles::from_degrees([draw(15.0), draw(15.0), draw(15.0)]);
        let at = home.position.component_mul(&nalgebra::Vector3::new(1.0, 1.0, low)) + shift;
        let pose = Pose::new(at, turn);
        let Ok(drives) = legs.drives(&pose) else { continue };
        let outcome = CoupledTracker::new(legs.clone(), pose).find(&drives);
        match outcome.pose() {
            Some(reached) => {
                found += 1;
                let off = (reached.position - pose.position).norm() / scale;
                assert!(off < 1e-8, "case {k}: {off:e} of the size, {:?}", outcome.status);
            }
            None => lost += 1,
        }
    }
    assert!(found > 20 * lost, "{found} found, {lost} lost");
}

#[test]
fn all_sources_of_the_folder_are_one_program() {
    if !compiler() {
        return;
    }
    let parsed = |text: &str| parse_with_cranks(text, Format::Toml).unwrap().0;
    let drives = not_ideal();
    let cranks = parsed(&std::fs::read_to_string("designs/presets/reachy-mini.toml").unwrap());
    let legs = Design::load("designs/worked/linuxcnc-griffis-duffy.toml").unwrap();
    for (design, count, modules) in [(&legs, 3, 3), (&drives, 4, 3), (&cranks, 4, 0)] {
        let exported = Exported::of(design);
        let found = sources(&exported);
        assert_eq!(found.len(), count, "{found:?}");
        let (good, said) = exported.runs(&["-std=c99", "-O2"], &found);
        assert!(good && said.contains(" 0 failed"), "{}: {said}", design.name);
        let below = std::fs::read_dir(exported.at("linuxcnc")).map_or(0, Iterator::count);
        assert_eq!(below, modules);
        if below > 0 {
            let (good, said) = exported.kinematics("poses.c", "linuxcnc", &[]);
            assert!(good, "{}: {said}", design.name);
        }
    }
}

//! Designs whose legs are rods on cranks: the file, angles and poses from the command line, motions, margins, and their
//! refusals.

mod elsewhere;
mod file;
mod margins;
mod motion;
mod poses;
mod sizes;

use equipod::methods::design::{Design, Format, parse_with_cranks};
use equipod::methods::geom::Pose;
use nalgebra::{Rotation3, Vector3};
use serde_json::Value;

use super::cli_frame::{document, equipod};

const HEAD: &str = "designs/presets/reachy-mini.toml";

/// A machine of builders: six servos around a circle, told by one crank, its mirror image and turned copies.
const SERVOS: &str = r#"
name = "servos"
units = "mm"
drive = "rotary"
legs = [["A1", "B1"], ["A2", "B2"], ["A3", "B3"], ["A4", "B4"], ["A5", "B5"], ["A6", "B6"]]

[parameters]
arm = 20
half = "30/2"

[base]
A1 = [80, "half", 0]
A2 = { mirror = "A1", plane = "xz" }
A3 = { turn = "A1", deg = 120 }
A4 = { turn = "A2", deg = 120 }
A5 = { turn = "A1", deg = 240 }
A6 = { turn = "A2", deg = 240 }

[platform]
B1 = [20, 40, 0]
B2 = { mirror = "B1", plane = "xz" }
B3 = { turn = "B1", deg = 120 }
B4 = { turn = "B2", deg = 120 }
B5 = { turn = "B1", deg = 240 }
B6 = { turn = "B2", deg = 240 }

[cranks]
length = "arm"
rod_length = "6*arm"
elbow = "plus"
angle_deg = [-80, "60 + half"]
max_torque = 1500
max_speed_deg = 300

[cranks.A1]
axis = [1, 0, 0]
zero = [0, 1, 0]
[cranks.A2]
mirror = "A1"
plane = "xz"
[cranks.A3]
turn = "A1"
deg = 120
[cranks.A4]
turn = "A2"
deg = 120
[cranks.A5]
turn = "A1"
deg = "2*120"
[cranks.A6]
turn = "A2"
deg = 240
rod_length = 120.5

[home]
position = [0, 0, 105]
rpy_deg = [0, 0, 0]

[speed]
linear = 50

[[loads]]
name = "camera"
force = [0, 0, -10]
"#;

fn servos() -> Design {
    parse_with_cranks(SERVOS, Format::Toml).unwrap_or_else(|v| panic!("{v:?}")).0
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap_or_else(|| panic!("{value}")).iter().map(|x| x.as_f64().unwrap()).collect()
}

/// A document and its exit code.
fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

/// Everything that limits cranks and rods.
const LIMITS: &str =
    "max_torque = 1500\nmin_transmission_angle_deg = 20\ntip_angle_deg = 40\nplatform_cone_angle_deg = 25";

fn limited() -> Design {
    let text = SERVOS.replace("max_torque = 1500", LIMITS).replace(
        "[speed]\nlinear = 50",
        "[workspace]\ntranslation = [3, 3, 3]\nrotation_deg = [2, 2, 2]\n[speed]\nlinear = 50\nangular_deg = 30",
    );
    parse_with_cranks(&text, Format::Toml).unwrap_or_else(|v| panic!("{v:?}")).0
}

/// Poses about home, within the workspace of [`limited`] times a factor.
fn drawn(design: &Design, count: usize, factor: f64) -> Vec<Pose> {
    let home = design.home.unwrap();
    // a lattice that no symmetry of the machine keeps
    let share =
        |k: usize, j: i32| factor * (2.0 * ((k as f64 + 0.5) * 0.618_034_f64.powi(j + 1)).fract() - 1.0);
    (0..count)
        .map(|k| {
            let turn = Vector3::new(share(k, 3), share(k, 4), share(k, 5)) * 2f64.to_radians();
            let shift = Vector3::new(share(k, 0), share(k, 1), share(k, 2)) * 3.0;
            Pose { rotation: Rotation3::new(turn) * home.rotation, position: home.position + shift }
        })
        .collect()
}

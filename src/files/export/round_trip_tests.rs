//! Exported models that are read again give the design.

use nalgebra::Matrix3;
use proptest::prelude::*;

use super::{Export, ExportFormat, ExportOptions, LengthUnit};
use crate::design::{DesignModel, Format, PointTable, parse_with_cranks};
use platform::manipulator::{Body, Manipulator};

const SYMMETRIC: &str = include_str!("../../../designs/symmetric-hexapod.toml");
const OCTAHEDRAL: &str = include_str!("../../../designs/rbt-octahedral.toml");
const GENERAL: &str = include_str!("../../../designs/general-6-6.toml");
const MIDLINE: &str = include_str!("../../../designs/rbt-midline.toml");
const SIX_FOUR: &str = include_str!("../../../designs/innocenti-6-4.toml");
const RUBIN: &str = include_str!("../../../designs/presets/rubin-camera-hexapod.toml");
const MOTION_BASE: &str = include_str!("../../../designs/presets/motion-base-6dof2000e.toml");

fn design(text: &str) -> DesignModel {
    parse_with_cranks(text, Format::Toml).unwrap().0
}

/// The file of a format with the legs, and the unit of the export.
fn exported(design: &DesignModel, format: &str) -> (String, &'static str) {
    let unit = LengthUnit::of(&design.units).or_else(|_| LengthUnit::of("m")).unwrap();
    let options = ExportOptions { unit: Some(unit), ..ExportOptions::default() };
    let export = Export::new(design, design.home_or_default(), (Vec::new(), Vec::new()), &options).unwrap();
    let files = export.files(format.parse::<ExportFormat>().unwrap());
    let files = files.unwrap_or_else(|why| panic!("{}: {format}: {why}", design.name));
    let own = ["legs.csv", "equipod_design.c"];
    let file = files.iter().find(|f| own.contains(&f.name.as_str())).unwrap_or(&files[0]);
    (file.text.clone(), unit.label)
}

fn returns(design: &DesignModel, format: &str) {
    let (text, unit) = exported(design, format);
    let mut table =
        PointTable::read(text.as_bytes()).unwrap_or_else(|why| panic!("{}: {format}: {why}", design.name));
    assert_eq!(table.units.as_deref(), Some(unit));
    let m = design.manipulator();
    let near = 1e-12 * m.size();
    for (i, (read, meant)) in table.legs.iter().zip(m.legs()).enumerate() {
        for body in Body::BOTH {
            let apart = (read.end(body) - meant.end(body)).norm();
            assert!(apart <= near, "{}: {format}: leg {}, {body}: {apart}", design.name, i + 1);
        }
    }
    let (home, meant) = (table.home.unwrap(), design.home_or_default());
    assert!((home.position - meant.position).norm() <= near, "{}: {format}: {home:?}", design.name);
    // a rotation of a design is orthonormal to the digits of its file, that of a model as a quaternion exactly
    let r = meant.rotation.matrix();
    let skew = (r.transpose() * r - Matrix3::identity()).amax();
    let turned = (r - home.rotation.matrix()).amax();
    assert!(turned <= 1e-12 + skew, "{}: {format}: {turned} {skew}", design.name);
    // shared joints are shared again
    let read = table.design("read", unit).unwrap();
    let shared = |m: &Manipulator| {
        let pairs = m.pairs();
        Body::BOTH.map(|b| pairs.map(|leg| pairs.iter().position(|other| b.of(*other) == b.of(leg))))
    };
    assert_eq!(shared(read.manipulator()), shared(m), "{}: {format}", design.name);
}

#[test]
fn models_of_mujoco_return() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN, MOTION_BASE] {
        returns(&design(text), "mjcf");
    }
}

#[test]
fn models_of_gazebo_and_ros_return() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN, MOTION_BASE] {
        for format in ["sdf", "urdf"] {
            returns(&design(text), format);
        }
    }
}

#[test]
fn tables_of_legs_return() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN, MOTION_BASE] {
        let mut given = design(text);
        // the table is in millimetres; pure numbers keep that label
        if LengthUnit::of(&given.units).is_err() {
            given.units = "mm".into();
        }
        returns(&given.in_units("mm").unwrap(), "csv");
    }
}

#[test]
fn scripts_of_matlab_return() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN, MOTION_BASE] {
        let mut given = design(text);
        if LengthUnit::of(&given.units).is_err() {
            given.units = "m".into();
        }
        returns(&given.in_units("m").unwrap(), "matlab");
    }
}

#[test]
fn tables_of_c_return() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN] {
        let mut given = design(text);
        if LengthUnit::of(&given.units).is_err() {
            given.units = "mm".into();
        }
        returns(&given, "c");
    }
}

#[test]
fn json_returns_in_millimetres() {
    for text in [SYMMETRIC, OCTAHEDRAL, GENERAL, MIDLINE, SIX_FOUR, RUBIN, MOTION_BASE] {
        let mut given = design(text);
        if LengthUnit::of(&given.units).is_err() {
            given.units = "mm".into();
        }
        returns(&given.in_units("mm").unwrap(), "json");
    }
}

#[test]
fn inches_return_as_inches() {
    for text in [SYMMETRIC, MOTION_BASE] {
        returns(&design(text).in_units("in").unwrap(), "mjcf");
    }
}

#[test]
fn joints_at_decimals_are_at_these_decimals_again() {
    let meant = design(SYMMETRIC);
    let table = PointTable::read(exported(&meant, "mjcf").0.as_bytes()).unwrap();
    let first = table.legs[0].base.coords.map(f64::to_bits);
    assert_eq!(first, nalgebra::Vector3::new(293.444, -62.374, 0.0).map(f64::to_bits));
    let heights: Vec<f64> = table.legs.iter().map(|l| l.platform.z).collect();
    assert!(heights.iter().all(|z| z.to_bits() == 0.0_f64.to_bits()), "{heights:?}");
}

#[test]
fn a_model_with_cranks_is_refused_in_words() {
    let cranks = design(include_str!("../../../designs/presets/reachy-mini.toml"));
    let said = PointTable::read(exported(&cranks, "mjcf").0.as_bytes()).unwrap_err().to_string();
    assert!(said.contains("6 of its hinges are driven") && said.contains("rods on cranks"), "{said}");
}

/// A text with a piece of it left out, doubled or replaced.
fn damaged(text: &str, at: usize, length: usize, how: usize, instead: &str) -> String {
    let boundary = |k: usize| (0..=k.min(text.len())).rev().find(|k| text.is_char_boundary(*k)).unwrap_or(0);
    let from = boundary(at % text.len());
    let to = boundary(from + length).max(from);
    let middle = match how {
        0 => String::new(),
        1 => text[from..to].repeat(2),
        _ => instead.to_string(),
    };
    [&text[..from], &middle, &text[to..]].concat()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn no_damage_to_a_model_stops_the_reader(
        at in 0..200_000_usize,
        length in 0..400_usize,
        how in 0..3_usize,
        instead in "[<>()#'\"/*;,=.$0-9A-Za-z \n-]{0,12}",
    ) {
        let (text, _) = exported(&design(OCTAHEDRAL), "mjcf");
        let _ = PointTable::read(damaged(&text, at, length, how, &instead).as_bytes());
    }

    #[test]
    fn no_text_stops_the_reader(text in ".{0,200}", marks in "[<>()#'\"/*;,=.$0-9A-Z \n-]{0,200}") {
        for begin in ["", "<", "<mujoco>", "<mujoco><worldbody>", "ISO-10303-21;"] {
            for rest in [&text, &marks] {
                let _ = PointTable::read(format!("{begin}{rest}").as_bytes());
            }
        }
    }
}

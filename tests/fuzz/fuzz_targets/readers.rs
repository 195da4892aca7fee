//! Texts of joints, poses, lengths, angles, drives and sheets: lists of programs, JSON, tables, controllers' settings and
//! models of robots. Each is read or refused in a sentence.
#![no_main]

use equipod::methods::design::{
    DesignUnits, DriveTable, PointTable, RigSheet, SeriesKind, SheetDialect, read_poses,
    read_poses_with_lengths,
};
use equipod::methods::geom::{Pose, PoseConvention};
use libfuzzer_sys::fuzz_target;
use equipod::prelude::{ForceUnit, MassUnit};

fn refused<T, E: std::fmt::Display>(read: Result<T, E>) {
    if let Err(why) = read {
        assert!(!why.to_string().is_empty());
    }
}

fuzz_target!(|bytes: &[u8]| {
    // the first byte chooses the reader; a table of thousands of lines only takes longer
    let Some((first, bytes)) = bytes.split_first() else { return };
    if bytes.len() > 20_000 {
        return;
    }
    let (usual, home) = (PoseConvention::default(), Pose::identity());
    let six = |text: &str| {
        text.split(',').map(|cell| cell.parse::<f64>().map_err(|why| why.to_string())).collect::<Result<Vec<_>, _>>()
    };
    match first % 7 {
        0 => match PointTable::read(bytes) {
            Ok(mut table) => {
                assert!(table.legs.iter().all(|leg| leg.base.iter().chain(leg.platform.iter()).all(|x| x.is_finite())));
                refused(table.design("a", "mm"));
            }
            Err(why) => assert!(!why.to_string().is_empty()),
        },
        1 => refused(SeriesKind::Lengths.read(bytes, "mm", six)),
        2 => refused(SeriesKind::Angles.read(bytes, "", six)),
        3 => match read_poses(bytes, &usual, &home, "mm") {
            Ok(table) => {
                for row in table.rows {
                    let r = row.value.rotation.matrix();
                    assert!((r.transpose() * r - equipod::nalgebra::Matrix3::identity()).amax() < 1e-9);
                }
            }
            Err(why) => assert!(!why.to_string().is_empty()),
        },
        4 => refused(read_poses_with_lengths(bytes, &usual, &home, "mm")),
        5 => {
            let units = DesignUnits { length: "mm", force: ForceUnit::Newton, mass: MassUnit::Kilogram };
            refused(DriveTable::read(bytes, &units));
        }
        _ => {
            for dialect in SheetDialect::ALL {
                refused(RigSheet::read(bytes, dialect));
            }
        }
    }
});

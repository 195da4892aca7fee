//! The legs along motions as a table of all instants.

use crate::app::cli::poses;
use crate::app::cli::table::{column_unit, csv_line, number};
use ask::{Design, MotionReport, PoseFrames};

/// Every instant of every motion.
pub(super) fn csv(design: &Design, frames: &PoseFrames, motions: &[(String, MotionReport)]) -> String {
    let unit = column_unit(&design.units);
    let force = design.force_unit().label();
    let mut header: Vec<String> = ["motion", "t_s"].map(String::from).to_vec();
    let [x, y, z, quaternion @ ..] = poses::csv_names(frames);
    header.extend([x, y, z].map(|axis| format!("{axis}_{unit}")));
    header.extend(quaternion.map(String::from));
    let columns = if design.has_cranks() {
        [
            ("crank", "deg".to_string()),
            ("speed", "deg_per_s".to_string()),
            ("acceleration", "deg_per_s2".to_string()),
            ("torque", format!("{force}_{unit}")),
            ("power", "W".to_string()),
        ]
    } else {
        [
            ("length", unit.clone()),
            ("speed", format!("{unit}_per_s")),
            ("acceleration", format!("{unit}_per_s2")),
            ("force", force.to_string()),
            ("power", "W".to_string()),
        ]
    };
    for (name, unit) in columns {
        header.extend((1..=6).map(|leg| format!("{name}_{leg}_{unit}")));
    }
    let mut out = csv_line(&header);
    for (name, found) in motions {
        for at in &found.instants {
            let mut cells = vec![name.clone(), number(at.time)];
            cells.extend(poses::csv_fields(frames, &at.state.pose).split(',').map(str::to_string));
            // nothing is known of a crank whose rod does not reach
            let cell = |x: f64| if x.is_nan() { String::new() } else { number(x) };
            cells.extend(at.legs.iter().map(|leg| cell(leg.length)));
            cells.extend(at.legs.iter().map(|leg| cell(leg.speed)));
            cells.extend(at.legs.iter().map(|leg| cell(leg.acceleration)));
            match &at.drives {
                Some((forces, powers)) => cells.extend(forces.iter().chain(powers).map(|x| number(*x))),
                None => cells.extend(std::iter::repeat_n(String::new(), 12)),
            }
            out.push_str(&csv_line(&cells));
        }
    }
    out
}

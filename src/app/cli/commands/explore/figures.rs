//! The pictures of `explore`.

use std::fmt::Write as _;

use ask::{Design, LengthsOrigin, OptimizeReport, OwnPoses};
use files::plot::{ModesFigure, OffsetPlane, PlaneAxis, PlanePoint, assembly_modes, determinant_plane};
use fk::Reality;
use platform::manipulator::Octahedral;
use synthesis::edge_lengths;

/// Edges or offsets with a smaller relative difference count as equal in a picture.
const SAME: f64 = 1e-9;
/// Mirror images agree within this share of the size.
const MIRROR: f64 = 1e-6;

/// At most six decimals, no trailing zeros.
fn short(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The common length of three edges, if they are equal.
fn common(edges: [f64; 3]) -> Option<f64> {
    let longest = edges.into_iter().fold(0.0, f64::max);
    edges.iter().all(|d| longest - d <= SAME * longest).then_some(longest)
}

/// `det A` over the offsets, in the design's unit if all edges of a body are equal, otherwise in fractions.
///
/// `None` for a platform with other triangles, or with other variables than offsets.
pub(super) fn determinant(
    design: &Design,
    octahedral: &Octahedral,
    search: &OptimizeReport,
) -> Option<String> {
    let has_plane = search.keeps_class() && (search.design().is_none() || search.offsets().is_some());
    if !has_plane {
        return None;
    }
    let d = edge_lengths(octahedral);
    let units = &design.units;
    let equal = common([d[0], d[2], d[4]]).zip(common([d[1], d[3], d[5]]));
    let axis = |body: &str, name: &str, scale: Option<f64>| match scale {
        Some(scale) => {
            PlaneAxis { label: format!("offset \u{394}{name} on the {body} edges [{units}]"), scale }
        }
        None => PlaneAxis {
            label: format!("offset t{name} on the {body} edges [fraction of the edge]"),
            scale: 1.0,
        },
    };
    let singular_label = match equal {
        Some((b, p)) => format!("\u{394}1/{} + \u{394}2/{} = 1", short(b), short(p)),
        None => "t1 + t2 = 1".to_owned(),
    };
    let (points, note) = points(octahedral, search);
    Some(determinant_plane(&OffsetPlane {
        title: format!("det A of the platforms without shared joints of \u{201c}{}\u{201d}", design.name),
        note,
        base: axis("base", "1", equal.map(|e| e.0)),
        platform: axis("platform", "2", equal.map(|e| e.1)),
        singular_label,
        points,
    }))
}

/// The chosen offsets, a base and a platform offset at a time; equal pairs share one mark.
fn points(octahedral: &Octahedral, search: &OptimizeReport) -> (Vec<PlanePoint>, String) {
    let Some((t, det)) = search.offsets() else {
        return (Vec::new(), "no offsets were found that keep the limits".to_owned());
    };
    let order = octahedral.order();
    let mut groups: Vec<(f64, f64, Vec<usize>)> = Vec::new();
    for k in [0, 2, 4] {
        let legs = [order[k].get() + 1, order[k + 1].get() + 1];
        let near =
            |g: &&mut (f64, f64, Vec<usize>)| (g.0 - t[k]).abs() < 1e-6 && (g.1 - t[k + 1]).abs() < 1e-6;
        match groups.iter_mut().find(near) {
            Some(g) => g.2.extend(legs),
            None => groups.push((t[k], t[k + 1], legs.to_vec())),
        }
    }
    let note = if groups.len() == 1 {
        format!("mark: the chosen offsets, det A = {det:.6}")
    } else {
        format!(
            "marks: the chosen offsets, two legs a mark; det A = {det:.4} with all six \
             (the plane has equal offsets on each body)"
        )
    };
    let mark = |(base, platform, legs): (f64, f64, Vec<usize>)| {
        let legs: Vec<String> = legs.iter().map(ToString::to_string).collect();
        PlanePoint { base, platform, label: format!("chosen, legs {}", legs.join(", ")) }
    };
    (groups.into_iter().map(mark).collect(), note)
}

/// The real poses.
pub(super) fn modes(design: &Design, poses: &OwnPoses) -> String {
    let s = &poses.solutions;
    let real = s.roots.iter().enumerate().filter(|(_, r)| r.reality == Reality::Real);
    let undecided = s.roots.iter().filter(|r| r.reality == Reality::Undecided).count();
    let lengths: Vec<String> = poses.lengths.get().iter().map(|l| short(*l)).collect();
    let whose = if poses.origin == LengthsOrigin::Design { "" } else { " (home pose)" };
    let mut note = format!(
        "{} finite poses, {} real; leg lengths {}{}{whose}; numbers as in the list of fk",
        s.roots.len(),
        s.assembly_modes().count(),
        lengths.join(", "),
        // "1" is not a unit to print
        if design.units == "1" { String::new() } else { format!(" {}", design.units) }
    );
    if undecided > 0 {
        let _ = write!(note, "; {undecided} not shown, reality undecided");
    }
    let figure = ModesFigure {
        title: format!("Assembly modes of \u{201c}{}\u{201d}", design.name),
        note,
        poses: real.map(|(k, r)| (k + 1, r.pose.real_part())).collect(),
        tolerance: MIRROR * design.manipulator().size(),
    };
    assembly_modes(design.manipulator(), &figure)
}

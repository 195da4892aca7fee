//! Designs as tables, for reading beside the results.

use std::fmt::Write as _;

use crate::design::Design;
use crate::plot::escape;

/// Legs with their joints and home lengths, and the file as it is.
pub(super) fn section(name: &str, text: &str, design: &Design) -> String {
    let mut out = String::new();
    let (shown, units) = (escape(&design.name), escape(&design.units));
    let _ = writeln!(out, "<section class=\"card\"><h3>{shown}</h3>");
    if let Some(text) = &design.description {
        let _ = writeln!(out, "<p>{}</p>", escape(text));
    }
    if let Some(text) = &design.source {
        let _ = writeln!(out, "<p class=\"note\">Source: {}</p>", escape(text));
    }
    let _ = writeln!(
        out,
        "<div class=\"wide\"><table><caption>Legs; joint centres in {units}, base joints in the base frame, platform joints in the platform frame</caption>\n\
         <thead><tr><th scope=\"col\">leg</th><th scope=\"col\">base joint</th><th scope=\"col\">x, y, z</th>\
         <th scope=\"col\">platform joint</th><th scope=\"col\">x, y, z</th><th scope=\"col\">length</th></tr></thead><tbody>"
    );
    let m = design.manipulator();
    let at = |p: &nalgebra::Point3<f64>| format!("{}, {}, {}", p.x, p.y, p.z);
    for (k, (a, b)) in m.pairs().into_iter().enumerate() {
        let length = design.lengths.map_or_else(|| "\u{2013}".to_owned(), |l| l.get()[k].to_string());
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{length}</td></tr>",
            k + 1,
            escape(&design.base_names()[a]),
            at(&m.base_joints()[a]),
            escape(&design.platform_names()[b]),
            at(&m.platform_joints()[b]),
        );
    }
    let _ = writeln!(
        out,
        "</tbody></table></div>\n<details><summary>{}</summary><pre>{}</pre></details></section>",
        escape(name),
        escape(text)
    );
    out
}

//! Designs as tables, for reading beside the results.

use std::fmt::Write as _;

use super::facts::digits;
use ask::Design;
use files::plot::escape;

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
    let m = design.manipulator();
    let at_home = || design.home.as_ref().and_then(|home| home.lengths(m));
    let (title, lengths) = match design.lengths {
        Some(lengths) => ("length", Some(lengths)),
        None => ("length at home", at_home()),
    };
    let head = lengths.map_or_else(String::new, |_| format!("<th scope=\"col\">{title}</th>"));
    let _ = writeln!(
        out,
        "<div class=\"wide\"><table><caption>Legs; joint centres in {units}, base joints in the base frame, platform joints in the platform frame</caption>\n\
         <thead><tr><th scope=\"col\">leg</th><th scope=\"col\">base joint</th><th scope=\"col\">x, y, z</th>\
         <th scope=\"col\">platform joint</th><th scope=\"col\">x, y, z</th>{head}</tr></thead><tbody>"
    );
    let at = |p: &nalgebra::Point3<f64>| [p.x, p.y, p.z].map(digits).join(", ");
    for (k, (a, b)) in m.pairs().into_iter().enumerate() {
        let length = lengths.map_or_else(String::new, |l| format!("<td>{}</td>", digits(l.get()[k])));
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{length}</tr>",
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

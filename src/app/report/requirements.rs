//! The requirements of a design as a table: the first thing that a person wants to know of a machine.

use std::fmt::Write as _;

use serde_json::{Map, Value};

use super::facts::{digits, words};
use super::kind::ResultVerdict;
use super::page::badge;
use files::plot::escape;
use records::DesignRoleWord;

/// The table of a result of `assess`, or of one that carries such an assessment; `link` leads to its file.
pub(super) fn section(link: &str, fields: &Map<String, Value>) -> Option<String> {
    let record = fields.get("assessment").and_then(Value::as_object).unwrap_or(fields);
    let rows = record.get("requirements").and_then(Value::as_array).filter(|rows| !rows.is_empty())?;
    let mut out = String::new();
    let text = |key: &str| record.get(key).and_then(Value::as_str);
    if let (Some(name), Some(role)) = (text("name"), text("role").and_then(DesignRoleWord::heading_of)) {
        let _ = writeln!(out, "<h3>{role}: {}</h3>", escape(name));
    }
    if let (Some(name), Some(said)) = (text("name"), text("explanation")) {
        let _ = writeln!(out, "<p>{} {}.</p>", escape(name), escape(said));
    }
    out.push_str(
        "<div class=\"wide\"><table><thead><tr><th scope=\"col\">requirement</th><th scope=\"col\">answer</th>\
         <th scope=\"col\">least margin</th><th scope=\"col\">no less than</th><th scope=\"col\">of</th>\
         <th scope=\"col\">position at the worst pose</th></tr></thead><tbody>\n",
    );
    for row in rows {
        let text = |key: &str| row.get(key).and_then(Value::as_str);
        let unit = text("unit").map_or_else(String::new, |unit| format!(" {}", escape(unit)));
        let length = |key: &str| {
            let number = row.get(key).and_then(Value::as_f64);
            number.map_or_else(|| "\u{2013}".to_owned(), |x| format!("{}{unit}", digits(x)))
        };
        let holds = row.get("met").and_then(Value::as_bool);
        let answer = ResultVerdict {
            word: text("status").unwrap_or("undecided").replace('_', " "),
            holds,
            explanation: None,
        };
        let list = |v: Option<&Value>, show: &dyn Fn(&Value) -> Option<String>| -> String {
            let entries = v.and_then(Value::as_array).into_iter().flatten();
            entries.filter_map(show).collect::<Vec<_>>().join(", ")
        };
        let between = list(row.get("between"), &|v| v.as_str().map(escape));
        let position = list(row.pointer("/pose/p"), &|v| v.as_f64().map(digits));
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{between}</td><td>{}</td></tr>",
            words(text("name").unwrap_or_default()),
            badge(&answer),
            length("margin"),
            length("proved_margin"),
            if position.is_empty() { "any" } else { &position },
        );
    }
    let singular = record.get("regular_explanation").and_then(Value::as_str);
    let singular = singular.map_or_else(String::new, |text| format!("<p>{}.</p>\n", escape(text)));
    let conditioning =
        record.get("conditioning").and_then(|c| c.get("inverse_condition")).and_then(Value::as_f64);
    let conditioning = conditioning.map_or_else(String::new, |x| {
        format!(
            "<p>The least conditioning of the poses looked at is {}; 1 is the best, 0 a singular pose.</p>\n",
            digits(x)
        )
    });
    let _ = writeln!(
        out,
        "</tbody></table></div>\n{singular}{conditioning}<p class=\"note\">A margin below 0 is a violation. From {link}</p>"
    );
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_violated_requirement_shows_its_margin_with_unit_and_place() {
        let fields: Map<String, Value> = serde_json::from_str(
            r#"{"met":false,"name":"a <b>","role":"nearest_equivalent","explanation":"violates requirements: leg_too_short",
                "regular_explanation":"No singular pose in the workspace: proved","requirements":[{"name":"leg_too_short","margin":-25.156342123,"met":false,"status":"violated",
                "proved_margin":null,"unit":"mm","between":["leg <1>"],"pose":{"p":[32.4443,14.3,371.8],"q":[1,0,0,0]}}],
                "regular":{"met":true,"status":"proved","pose":null},"conditioning":{"inverse_condition":0.3359123,"pose":null}}"#,
        )
        .unwrap();
        let text = section("<a>x</a>", &fields).unwrap();
        for shown in [
            "leg too short",
            "-25.1563 mm",
            "leg &lt;1&gt;",
            "32.4443, 14.3, 371.8",
            "\u{2717}",
            "no less than",
            "<h3>Equivalent of the nearest octahedral platform: a &lt;b&gt;</h3>",
            "a &lt;b&gt; violates requirements",
        ] {
            assert!(text.contains(shown), "{shown}: {text}");
        }
        assert!(text.contains("No singular pose in the workspace: proved.") && text.contains("is 0.335912;"));
        let carried: Map<String, Value> =
            [("assessment".to_owned(), Value::Object(fields))].into_iter().collect();
        assert_eq!(section("<a>x</a>", &carried).unwrap(), text);
        assert_eq!(section("", &Map::new()), None);
    }
}

//! Keys under the names of the last release: they are read as the keys with the new names, with a note.

use super::Code;
use super::kind::{KeyForm, KeyKind, KeyShape};
use crate::design::tree::{Node, Value};
use crate::design::violation::Findings;
use machine::requirements::TermKind;

/// Rows of `assess` by their names in the last release.
pub(super) const OLD_ROWS: &[(&str, TermKind)] = &[
    ("leg_too_short", TermKind::MinLegLength),
    ("leg_too_long", TermKind::MaxLegLength),
    ("base_swing", TermKind::BaseConeAngle),
    ("platform_swing", TermKind::PlatformConeAngle),
    ("rod_too_short", TermKind::MinRodLength),
    ("rod_too_long", TermKind::MaxRodLength),
    ("tip_swing", TermKind::TipAngle),
];

/// Renames the old keys of a table and of the tables in it, so that all later steps see new names alone. An old key
/// beside its new one is refused.
pub(in crate::design) fn give_new_names(report: &mut Findings<'_>, node: &mut Node, shape: &dyn KeyShape) {
    let Value::Table(entries) = &mut node.value else { return };
    let given: Vec<String> = entries.iter().map(|entry| entry.key.clone()).collect();
    entries.retain_mut(|entry| {
        let Some(new) = shape.renamed(&entry.key) else { return true };
        if given.iter().any(|key| key == new) {
            let message = format!("`{}` is the old name of `{new}`, and both keys are there", entry.key);
            let help = format!("keep `{new}`, and remove `{}`", entry.key);
            report.refuse(Code::ConflictingKeys, &entry.key_span, message, help);
            return false;
        }
        report.rename(&entry.key_span, &entry.key, new);
        new.clone_into(&mut entry.key);
        true
    });
    for entry in entries {
        if let Some(kind) = shape.kind(&entry.key) {
            inside(report, &mut entry.node, &kind);
        }
    }
}

/// The tables in a value of a kind.
fn inside(report: &mut Findings<'_>, node: &mut Node, kind: &KeyKind) {
    match kind.form {
        KeyForm::Table(shape) => give_new_names(report, node, shape),
        KeyForm::List(item, _) => {
            if let Value::Array(list) = &mut node.value {
                for node in list {
                    inside(report, node, item);
                }
            }
        }
        KeyForm::Either(kinds) => kinds.iter().for_each(|kind| inside(report, node, kind)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::super::kind::{list, positive, table, unit};
    use super::super::{KeyTable, key};
    use super::*;
    use crate::design::tree::read;
    use crate::design::{Format, Warning};

    #[derive(Default)]
    struct Sizes {
        width: Option<f64>,
    }

    static INNER: KeyTable<Sizes> = KeyTable {
        keys: &[key!("width" { old = "breadth" }: positive(unit::LENGTH), width; "of a part")],
        ..KeyTable::EMPTY
    };
    static OUTER: KeyTable<()> = KeyTable {
        keys: &[
            key!("part" { old = "piece" }: table(&INNER); "one part"),
            key!("parts": list(&table(&INNER)); "others"),
        ],
        ..KeyTable::EMPTY
    };

    #[test]
    fn an_old_key_is_read_with_a_note_and_written_under_its_new_name() {
        let text = "[piece] # one\nbreadth = 2 # breadth\n[[parts]]\nbreadth = 3\n[[parts]]\nwidth = 4\n";
        let mut report = Findings::new(text);
        let mut root = read(text, Format::Toml, &mut report).unwrap();
        give_new_names(&mut report, &mut root, &OUTER);
        let Value::Table(entries) = &root.value else { panic!("{root:?}") };
        let mut sizes = Sizes::default();
        INNER.read(&mut report, &entries[0].node, "[part]", &mut sizes);
        assert_eq!((entries[0].key.as_str(), sizes.width), ("part", Some(2.0)));
        let renamed = text.replace("[piece]", "[part]").replace("breadth =", "width =");
        assert_eq!(report.text_with_new_names(), renamed);
        assert!(report.is_clean());
        let warnings = report.into_warnings();
        let lines: Vec<usize> = warnings.iter().map(Warning::line).collect();
        assert_eq!((lines, warnings[0].code()), (vec![1, 2, 4], "design::renamed_key"));
        assert_eq!(warnings[0].to_string(), "`piece` is now `part`");
        assert!(warnings[0].advice().contains("is read until version"), "{}", warnings[0].advice());
    }

    #[test]
    fn an_old_key_beside_its_new_one_is_refused() {
        let text = "[part]\nbreadth = 2\nwidth = 3\n";
        let mut report = Findings::new(text);
        let mut root = read(text, Format::Toml, &mut report).unwrap();
        give_new_names(&mut report, &mut root, &OUTER);
        let violations = report.into_violations();
        assert_eq!((violations.len(), violations[0].code, violations[0].line), (1, Code::ConflictingKeys, 2));
        assert!(violations[0].message.contains("old name of `width`"), "{}", violations[0]);
    }

    /// The keys that have new names in 0.2.
    #[test]
    fn a_design_with_old_keys_is_the_design_with_their_new_names() {
        let renamed = [
            ("base_swing_deg", "base_cone_angle_deg"),
            ("platform_swing_deg", "platform_cone_angle_deg"),
            (" swing_deg", " cone_angle_deg"),
            ("reserve", "safety_margin"),
            ("leg_too_long", "max_leg_length"),
        ];
        let old = format!(
            "{}\n[hardware]\nleg_length = [1, 90]\nbase_swing_deg = 50 # cone\nplatform_swing_deg = 60\n\
             platform_joint = {{ model = \"ball\", swing_deg = 40 }}\n[limits.reserve]\nleg_too_long = 1 # at least\n",
            include_str!("../../../../designs/rbt-octahedral.toml").trim_end()
        );
        let new = renamed.iter().fold(old.clone(), |text, (old, new)| text.replace(old, new));
        let (design, warnings) = crate::design::parse(&old, Format::Toml).unwrap();
        assert_eq!(warnings.len(), renamed.len(), "{warnings:?}");
        assert_eq!(design, crate::design::parse(&new, Format::Toml).unwrap().0);
        assert_eq!(design.text(), new);
        let both = old.replace("[limits.reserve]", "[limits]\nsafety_margin = \"5%\"\n[limits.reserve]");
        let refused = crate::design::parse(&both, Format::Toml).unwrap_err();
        assert_eq!((refused.len(), refused[0].code), (1, Code::ConflictingKeys), "{refused:?}");
    }
}

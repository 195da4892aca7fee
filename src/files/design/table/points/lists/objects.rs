//! Joints or legs as objects of JSON or YAML, as a table.

use crate::design::table::listed::{ListValue, member, records, stated_units, table_of};
use crate::design::table::points::columns::PointColumns;
use crate::design::table::sheet::CellTable;

/// The cells of an object with the names of their columns.
fn cells(object: &ListValue) -> Vec<(String, String)> {
    let mut out: Vec<(String, String)> = Vec::new();
    object.leaves("", &mut |name, leaf| match leaf {
        ListValue::Number(x) => out.push((name.to_owned(), format!("{x:?}"))),
        ListValue::Text(text) => out.push((name.to_owned(), text.clone())),
        _ => {
            let point = leaf.numbers().filter(|list| (2..=3).contains(&list.len())).unwrap_or_default();
            let axes = ["x", "y", "z"].iter().zip(point);
            out.extend(axes.map(|(axis, x)| (member(name, axis), format!("{x:?}"))));
        }
    });
    out
}

/// The table of a text with a list of objects that have coordinates.
pub(in crate::design::table::points) fn read(text: &str) -> Option<CellTable> {
    if !text.contains(['{', ':']) {
        return None;
    }
    let is_known = |value: &ListValue| {
        let names: Vec<String> = cells(value).into_iter().map(|(name, _)| name).collect();
        matches!(value, ListValue::Named(_)) && PointColumns::named(&names, &mut Vec::new()).is_some()
    };
    let found = records(text, &is_known).ok()??;
    if found.len() < 6 || !found.iter().all(|record| matches!(record.value, ListValue::Named(_))) {
        return None;
    }
    let (header, rows) = table_of(found.iter().map(|record| (record.line, cells(&record.value))).collect());
    let (length_unit, angle_unit, guess) = stated_units(&[], text);
    Some(CellTable::of_rows(Some(header), rows, (length_unit, angle_unit), guess.into_iter().collect()))
}

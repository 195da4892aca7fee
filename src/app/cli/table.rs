//! Tables for other programs: a header with units, then numbers that read back to the same double.

use files::export::csv_field;

/// Cells on a line, each in the notation of [`csv_field`].
pub(crate) fn csv_line(cells: &[impl AsRef<str>]) -> String {
    cells.iter().map(|cell| csv_field(cell.as_ref())).collect::<Vec<_>>().join(",") + "\n"
}

/// A number with the fewest digits that read back to it.
pub(crate) fn number(x: f64) -> String {
    // no cell contains `-0.0`
    format!("{:?}", x + 0.0)
}

/// The label of a unit as a part of the name of a column.
pub(crate) fn column_unit(units: &str) -> String {
    units.trim().chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_with_a_separator_is_quoted() {
        assert_eq!(csv_line(&["time, s", "a \"b\"", "c"]), "\"time, s\",\"a \"\"b\"\"\",c\n");
        assert_eq!(csv_line(&["=1+1", "@a", "-1.5", "-a,b", "+inf"]), "'=1+1,'@a,-1.5,\"'-a,b\",+inf\n");
        assert_eq!(
            (number(-0.0), number(1e-17), column_unit("design units")),
            ("0.0".into(), "1e-17".into(), "design_units".into())
        );
    }
}

//! The octahedral design that tests of `optimize` and `explore` begin with; `tests/python/test_package.py` reads the
//! same file.

/// Joints and legs alone.
pub(crate) const DESIGN: &str = include_str!("../fixtures/octahedral-12-6.toml");

/// The design with a home, so that nothing is taken from its size.
pub(crate) fn at_home() -> String {
    format!("{DESIGN}[home]\nposition = [3.0, 1.7320508075688772, 12.0]\nrpy_deg = [0.0, 0.0, 0.0]\n")
}

/// The design with a small workspace about its home, and these tables.
pub(crate) fn required(more: &str) -> String {
    format!("{}[workspace]\ntranslation = [0.5, 0.5, 0.5]\n{more}", at_home())
}

/// The design with limits of its own that offsets and height have to meet.
pub(crate) fn limited() -> String {
    let tables = "[hardware]\nleg_length = [9.0, 18.0]\n[optimize]\nvariables = [\"symmetric_offsets\", \"home_height\"]\n";
    required(tables).replace("octahedral 12-6", "limited")
}

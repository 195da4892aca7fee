//! The output of the examples is the text that their headers quote.

macro_rules! examples {
    ($($name:ident = $path:literal),* $(,)?) => {
        $(
            #[path = $path]
            #[allow(dead_code, reason = "the example's main is not called here")]
            mod $name;

            #[test]
            fn $name() {
                assert_eq!($name::report().unwrap(), quoted(include_str!($path)), "run the example and quote it");
            }
        )*
    };
}

examples! {
    forward_kinematics = "../../examples/01_forward_kinematics.rs",
    enumerate_family = "../../examples/02_enumerate_family.rs",
    check_leg_map = "../../examples/03_check_leg_map.rs",
    optimise_offsets = "../../examples/04_optimise_offsets.rs",
    verify_equivalence = "../../examples/05_verify_equivalence.rs",
}

/// The block marked `text` in the header of an example.
fn quoted(source: &str) -> String {
    let header = source.lines().map_while(|l| l.strip_prefix("//!"));
    let block = header.skip_while(|l| *l != " ```text").skip(1).take_while(|l| *l != " ```");
    let lines: Vec<&str> = block.map(|l| l.strip_prefix(' ').unwrap_or(l)).collect();
    lines.join("\n") + "\n"
}

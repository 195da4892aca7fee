//! The JSON Schema of design files.

/// JSON Schema (draft 2020-12) of a design as JSON; a TOML file has the same structure.
///
/// What no schema can say is left to [`parse`](super::parse): that the joints of the legs exist, that bodies have a size, that rotations are rotations. It takes
/// a TOML file with `legs` below `[base]` with a warning, which the schema refuses.
pub const SCHEMA: &str = include_str!("design.schema.json");

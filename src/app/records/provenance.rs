//! The program, seed and files behind an answer.

use data_encoding::HEXLOWER;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use ask::Design;

/// The data needed to compute an answer again: the program, the seed and the files. It holds no time and no name of a
/// machine.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ProvenanceRecord {
    /// Program version.
    pub version: String,
    /// Seed; null: it takes none.
    pub seed: Option<u64>,
    /// The designs in the order given.
    pub designs: Vec<DesignSourceRecord>,
    /// The other files read: tables of lengths or poses, fronts.
    pub files: Vec<FileSourceRecord>,
}

/// A design of an answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct DesignSourceRecord {
    /// The name of the design.
    pub name: String,
    /// File as named; null: the design was made in memory, and its text is the text it would be saved as.
    pub path: Option<String>,
    /// SHA-256 of file or text, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
}

/// A file other than a design.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct FileSourceRecord {
    /// File as named.
    pub path: String,
    /// SHA-256 of its bytes, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
}

/// A design in memory, represented by the text it would be saved as. For an unchanged TOML file this is the text of the
/// file.
impl From<&Design> for DesignSourceRecord {
    fn from(design: &Design) -> Self {
        Self { name: design.name.clone(), path: None, sha256: sha256(design.text().as_bytes()) }
    }
}

impl ProvenanceRecord {
    /// The provenance of an answer about designs in memory; `seed` comes from the options of the computation, `None`
    /// without a seed.
    #[must_use]
    pub fn of(designs: &[&Design], seed: Option<u64>) -> Self {
        let designs = designs.iter().copied().map(DesignSourceRecord::from).collect();
        Self { seed, designs, ..Self::default() }
    }
}

/// The provenance without seed and files.
impl Default for ProvenanceRecord {
    fn default() -> Self {
        Self { version: env!("CARGO_PKG_VERSION").into(), seed: None, designs: Vec::new(), files: Vec::new() }
    }
}

/// SHA-256 as hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    HEXLOWER.encode(&Sha256::digest(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ask::design::parse;
    use files::design::Format;

    #[test]
    fn a_design_in_memory_has_the_hash_of_its_file_until_it_is_changed() {
        let text = include_str!("../../../designs/rbt-octahedral.toml");
        let (mut design, _) = parse(text, Format::Toml).unwrap();
        let of = |design: &Design| ProvenanceRecord::of(&[design], Some(7)).designs.remove(0);
        assert_eq!(of(&design).sha256, sha256(text.as_bytes()));
        assert_eq!((of(&design).name, of(&design).path), (design.name.clone(), None));
        design.set_joint("P1", [0.0, 0.0, 0.25]).unwrap();
        assert_ne!(of(&design).sha256, sha256(text.as_bytes()));
    }

    #[test]
    fn the_hash_is_the_one_of_the_standard() {
        // FIPS 180-2, appendix B.1
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}

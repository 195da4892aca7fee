//! The equivalence class of the octahedral platform as a table with counts.

use std::collections::{BTreeMap, BTreeSet};

use super::enumerate::{enumerate, representative};
use super::moves::{moves, reachable};
use super::pattern::Pattern;
use platform::topology::Topology;

/// A pattern and its place in the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FamilyMember {
    /// The pattern.
    pub pattern: Pattern,
    /// Index of its class, without exchange of base and platform.
    pub class: usize,
    /// Index of its class with exchange of base and platform.
    pub class_exchange: usize,
    /// Index into [`Family::topologies`].
    pub topology: usize,
    /// Whether offsets introduced one at a time reach it.
    pub sequential: bool,
}

/// A topology of the class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FamilyTopology {
    /// The graph.
    pub topology: Topology,
    /// A pattern of this topology with few offsets, reached only by moves that split a joint, if there is one.
    pub example: Pattern,
    /// Whether offsets introduced one at a time reach a pattern of this topology.
    pub sequential: bool,
    /// Indices of the topologies after one move that splits a joint.
    pub next: Vec<usize>,
}

/// Counts of the members of the class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "CountsRecord")
)]
pub struct FamilyCounts {
    /// Patterns of kept and moved legs.
    pub patterns: usize,
    /// Patterns up to symmetries that keep base and platform apart.
    pub classes: usize,
    /// Patterns up to all symmetries.
    pub classes_exchange: usize,
    /// Topologies, including the octahedral one.
    pub topologies: usize,
    /// The same, base and platform exchangeable.
    pub topologies_exchange: usize,
    /// Topologies reached by offsets one at a time.
    pub sequential_topologies: usize,
    /// The same, base and platform exchangeable.
    pub sequential_topologies_exchange: usize,
    /// Patterns reached by offsets one at a time.
    pub sequential_patterns: usize,
    /// Patterns that only split joints.
    pub splitting_patterns: usize,
}

/// Every platform equivalent to an octahedral one, up to the values of the offsets.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_synthesis as synthesis; pub use platform::manipulator; } }
/// let family = equipod::methods::synthesis::Family::octahedral();
/// assert_eq!(family.counts().patterns, 3usize.pow(6) - 1);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Family {
    members: Vec<FamilyMember>,
    topologies: Vec<FamilyTopology>,
    counts: FamilyCounts,
}

/// Numbers the distinct keys in the order of their first appearance.
fn numbered<K: Ord + Clone>(keys: &[K]) -> Vec<usize> {
    let mut index = BTreeMap::new();
    keys.iter()
        .map(|k| {
            let next = index.len();
            *index.entry(k.clone()).or_insert(next)
        })
        .collect()
}

fn distinct<K: Ord>(keys: impl Iterator<Item = K>) -> usize {
    keys.collect::<BTreeSet<_>>().len()
}

impl Family {
    /// The class of the octahedral platform. It is the same for all triangles.
    #[must_use]
    pub fn octahedral() -> Self {
        let patterns = enumerate();
        let reached = reachable(false);
        let split = reachable(true);
        let classes: Vec<Pattern> = patterns.iter().map(|p| representative(p, false)).collect();
        let wide: Vec<Pattern> = classes.iter().map(|p| representative(p, true)).collect();
        let class = numbered(&classes);
        let mut of_class: Vec<Topology> = Vec::new();
        for (k, p) in patterns.iter().enumerate() {
            if class[k] == of_class.len() {
                of_class.push(p.topology());
            }
        }
        let graphs: Vec<Topology> = class.iter().map(|c| of_class[*c]).collect();
        let topology = numbered(&graphs);
        let class_exchange = numbered(&wide);
        let members: Vec<FamilyMember> = patterns
            .into_iter()
            .enumerate()
            .map(|(k, pattern)| FamilyMember {
                sequential: reached.contains(&pattern),
                pattern,
                class: class[k],
                class_exchange: class_exchange[k],
                topology: topology[k],
            })
            .collect();
        let topologies = topology_table(&members, &graphs, &split);
        let sequential = || topologies.iter().filter(|t| t.sequential).map(|t| t.topology);
        let counts = FamilyCounts {
            patterns: members.len(),
            classes: distinct(class.iter()),
            classes_exchange: distinct(class_exchange.iter()),
            topologies: topologies.len(),
            topologies_exchange: distinct(topologies.iter().map(|t| t.topology.up_to_exchange())),
            sequential_topologies: sequential().count(),
            sequential_topologies_exchange: distinct(sequential().map(Topology::up_to_exchange)),
            sequential_patterns: reached.len(),
            splitting_patterns: split.len(),
        };
        Self { members, topologies, counts }
    }

    /// All patterns, by number of offsets.
    #[must_use]
    pub fn members(&self) -> &[FamilyMember] {
        &self.members
    }

    /// All topologies, in the order of their first pattern.
    #[must_use]
    pub fn topologies(&self) -> &[FamilyTopology] {
        &self.topologies
    }

    /// The counts.
    #[must_use]
    pub fn counts(&self) -> FamilyCounts {
        self.counts
    }
}

fn topology_table(
    members: &[FamilyMember],
    graphs: &[Topology],
    split: &BTreeSet<Pattern>,
) -> Vec<FamilyTopology> {
    let number: BTreeMap<&Pattern, usize> = members.iter().map(|m| (&m.pattern, m.topology)).collect();
    let count = members.iter().map(|m| m.topology + 1).max().unwrap_or(0);
    (0..count)
        .filter_map(|t| {
            let of_t = || members.iter().enumerate().filter(move |(_, m)| m.topology == t);
            let (first, _) = of_t().next()?;
            // moves that each split a joint, at most one inner point a side where possible
            let example = of_t()
                .map(|(_, m)| &m.pattern)
                .min_by_key(|p| (!split.contains(p), p.inner().iter().filter(|m| **m > 1).count()))?;
            let steps = of_t().flat_map(|(_, m)| moves(&m.pattern)).filter(|step| step.splits);
            let next: BTreeSet<usize> = steps.filter_map(|step| number.get(&step.to).copied()).collect();
            Some(FamilyTopology {
                topology: graphs[first],
                example: example.clone(),
                sequential: of_t().any(|(_, m)| m.sequential),
                next: next.into_iter().collect(),
            })
        })
        .collect()
}

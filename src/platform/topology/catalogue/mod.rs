//! Enumeration of every topology that can hold a platform.

use std::collections::BTreeSet;

use super::graph::{AlwaysSingular, Topology};
use crate::manipulator::Manipulator;

/// A topology with its place in [`catalogue`].
///
/// The number is the place, counted from 1, printed as `T01`. Topologies are counted up to exchange of the bodies, and
/// have at least as many base joints as platform joints here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct NamedTopology {
    number: u8,
    variant: Option<u8>,
    topology: Topology,
}

/// The result of [`recognise`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recognised {
    /// The topology.
    pub topology: NamedTopology,
    /// Whether base and platform of the design are those of the catalogue exchanged.
    pub exchanged: bool,
}

impl NamedTopology {
    /// Place in the catalogue, counted from 1.
    #[must_use]
    pub fn number(self) -> usize {
        usize::from(self.number)
    }

    /// `T01`, `T02`, ...
    #[must_use]
    pub fn id(self) -> String {
        format!("T{:02}", self.number)
    }

    /// Numbers of base and platform joints, with a letter if several topologies share them: `6-5`, `5-4c`.
    #[must_use]
    pub fn name(self) -> String {
        let letter = self.variant.map_or(String::new(), |v| char::from(b'a' + v).to_string());
        format!("{}-{}{letter}", self.topology.base_joints(), self.topology.platform_joints())
    }

    /// The graph.
    #[must_use]
    pub fn topology(self) -> Topology {
        self.topology
    }
}

/// All topologies of six legs that are not [always singular](Topology::always_singular), up to relabelling and exchange
/// of base and platform. The one without shared joints is first, those with fewest joints are last.
///
/// The enumeration takes milliseconds, in a fixed order. Porta and Thomas count 34.
#[must_use]
pub fn catalogue() -> Vec<NamedTopology> {
    let mut found = BTreeSet::new();
    for base in shapes() {
        each_partition(&mut [0; 6], 1, 1, &mut |platform| {
            let wide = (base, platform.map(usize::from));
            let joints = |x: &[usize; 6]| 1 + x.iter().max().copied().unwrap_or(0);
            // the exchange puts the body with more joints on the base
            if joints(&wide.0) >= joints(&wide.1) && holds(wide.0, wide.1) {
                let topology = Topology::of_legs(wide.0, wide.1);
                found.insert(standing(topology));
            }
        });
    }
    let mut found: Vec<Topology> = found.into_iter().collect();
    let joints = |t: &Topology| t.base_joints() + t.platform_joints();
    found.sort_by_key(|t| (12 - joints(t), 6 - t.base_joints(), *t));
    let counts = |t: &Topology| (t.base_joints(), t.platform_joints());
    let name = |(k, t): (usize, &Topology)| {
        let alike = |list: &[Topology]| list.iter().filter(|u| counts(u) == counts(t)).count();
        let variant = (alike(&found) > 1).then(|| alike(&found[..k]) as u8);
        NamedTopology { number: k as u8 + 1, variant, topology: *t }
    };
    found.iter().enumerate().map(name).collect()
}

/// The entry of a design in the [`catalogue`].
///
/// # Errors
/// [`AlwaysSingular`] with the reason, if it is not in the catalogue.
pub fn recognise(m: &Manipulator) -> Result<Recognised, AlwaysSingular> {
    let topology = Topology::of_manipulator(m);
    if let Some(why) = topology.always_singular() {
        return Err(why);
    }
    let upright = standing(topology);
    let entry = catalogue().into_iter().find(|n| n.topology == upright);
    let named = entry
        .unwrap_or_else(|| unreachable!("the catalogue holds every topology that is not always singular"));
    Ok(Recognised { topology: named, exchanged: upright != topology })
}

/// The orientation of the catalogue: more joints on the base, otherwise the lesser graph.
fn standing(t: Topology) -> Topology {
    let other = t.exchanged();
    let key = |t: &Topology| (t.platform_joints(), *t);
    if key(&other) < key(&t) { other } else { t }
}

/// Tested before the graph is reduced to its least form, which takes longer.
fn holds(base: [usize; 6], platform: [usize; 6]) -> bool {
    Topology::unordered(base, platform).always_singular().is_none()
}

/// One pattern of shared joints on one body for every partition of the number six.
fn shapes() -> Vec<[usize; 6]> {
    let mut out: Vec<[usize; 6]> = Vec::new();
    each_partition(&mut [0; 6], 1, 1, &mut |p| {
        let size = |j: u8| p.iter().map(|x| u8::from(*x == j)).sum::<u8>();
        let contiguous = p.windows(2).all(|w| w[0] <= w[1]);
        if contiguous && (1..6).all(|j| size(j) <= size(j - 1)) {
            out.push(p.map(usize::from));
        }
    });
    out
}

/// Visits every partition of six legs into joints, numbered in order of appearance.
fn each_partition(joint: &mut [u8; 6], leg: usize, used: u8, visit: &mut impl FnMut([u8; 6])) {
    if leg == 6 {
        visit(*joint);
        return;
    }
    for j in 0..=used {
        joint[leg] = j;
        each_partition(joint, leg + 1, used.max(j + 1), visit);
    }
}

#[cfg(test)]
mod tests;

//! The answer for one topology, and for all of them.
//!
//! The possible distributions of six legs over the families determine the least number of shared joints.

use thiserror::Error;

use super::octahedral::{Reduction, from_cubics, from_families, in_space};
use super::pieces::{Piece, PieceKind, PlaneGroups, SampleOutcome, SplitFamilies, at_joints, split};
use super::sample::{Arrangement, DesignSample};
use crate::components::flat_name;
use num::exact::{ExactVector, rank};
use num::{Purpose, Rng};
use platform::manipulator::{Body, ExactLeg};
use platform::topology::{NamedTopology, catalogue};

/// The bodies with all joints in a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PlanarBodies {
    /// The base joints lie in a plane.
    pub base: bool,
    /// The platform joints lie in a plane.
    pub platform: bool,
}

/// The method that found the families.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Argument {
    /// The span of the legs is a sum of stars at independent points of a body: all families are in the list.
    Stars(Body),
    /// The lemma on supports leaves the joints and at most one pairing: all families are in the list.
    Supports,
    /// Two planes with a pair of curves: families are not listed. The design shows that joints can be free.
    Curves,
}

/// The result of equivalent rearrangement for the general members of a topology.
#[derive(Debug, Clone, PartialEq)]
pub struct Rearrangement {
    /// The topology.
    pub topology: NamedTopology,
    /// Bodies in a plane.
    pub planar: PlanarBodies,
    /// A member with small integer coordinates.
    pub member: Arrangement,
    /// The method that found the families.
    pub argument: Argument,
    /// All families of replaceable legs of the member; empty for [`Argument::Curves`].
    pub families: Vec<Piece>,
    /// Dimensions of the summands of the span of the legs, in the order of [`Piece::parts`].
    pub summands: Vec<usize>,
    /// The least number of joints that carry two or more legs.
    pub fewest_shared: usize,
    /// The least value of twelve minus the number of joints.
    pub fewest_merged: usize,
    /// An equivalent design with [`fewest_shared`](Self::fewest_shared) shared joints and
    /// [`fewest_merged`](Self::fewest_merged).
    pub fewest: Arrangement,
    /// The reasons why there cannot be fewer shared joints.
    pub obstructions: Vec<Obstruction>,
    /// Whether an octahedral design is equivalent.
    pub octahedral: Reduction,
}

/// The argument did not decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("no proof was found for {topology} (plane base: {}, plane platform: {})", planar.base, planar.platform, topology = topology.id())]
pub struct NotDecided {
    /// The topology.
    pub topology: NamedTopology,
    /// Bodies in a plane.
    pub planar: PlanarBodies,
}

/// Every topology of the catalogue with its bodies in space or in a plane; bodies with three joints are in a plane
/// anyway.
///
/// # Errors
/// [`NotDecided`], which does not occur.
pub fn rearrangements() -> Result<Vec<Rearrangement>, NotDecided> {
    let mut out = Vec::new();
    for topology in catalogue() {
        for planar in PlanarBodies::of(topology) {
            out.push(rearrangement(topology, planar)?);
        }
    }
    Ok(out)
}

impl Rearrangement {
    /// The families in words, base first: `2 x line-point, pairing, 3 legs`; `curves` if they are not listed.
    #[must_use]
    pub fn family_names(&self) -> String {
        if self.argument == Argument::Curves {
            return "curves".to_string();
        }
        let mut counted: Vec<(String, usize)> = Vec::new();
        let mut sorted: Vec<&Piece> = self.families.iter().collect();
        sorted.sort_by_key(|p| {
            (
                p.kind == PieceKind::Pairing,
                std::cmp::Reverse(p.dimension()),
                std::cmp::Reverse(p.base_dimension()),
            )
        });
        for piece in sorted.into_iter().filter(|p| p.dimension() > 0) {
            let name = match piece.kind {
                PieceKind::AllPairs => {
                    format!("{}-{}", flat_name(piece.base_dimension()), flat_name(piece.platform_dimension()))
                }
                PieceKind::Pairing => "pairing".to_string(),
            };
            match counted.last_mut().filter(|(last, _)| *last == name) {
                Some((_, count)) => *count += 1,
                None => counted.push((name, 1)),
            }
        }
        let mut out: Vec<String> = counted
            .into_iter()
            .map(|(name, count)| if count > 1 { format!("{count} x {name}") } else { name })
            .collect();
        match self.families.iter().filter(|p| p.dimension() == 0).count() {
            0 => {}
            1 => out.push("1 leg".to_string()),
            n => out.push(format!("{n} legs")),
        }
        out.join(", ")
    }
}

impl PlanarBodies {
    /// `plane` or `space`: base, platform.
    #[must_use]
    pub fn names(self) -> [&'static str; 2] {
        [self.base, self.platform].map(|flat| if flat { "plane" } else { "space" })
    }

    /// The cases of a topology with bodies in space or in a plane.
    #[must_use]
    pub fn of(topology: NamedTopology) -> Vec<Self> {
        let choice = |joints: usize| if joints > 3 { vec![false, true] } else { vec![true] };
        let t = topology.topology();
        let platform = choice(t.platform_joints());
        let cases = choice(t.base_joints()).into_iter();
        cases.flat_map(|base| platform.iter().map(move |p| Self { base, platform: *p })).collect()
    }
}

/// One topology with its bodies in space or in a plane.
///
/// # Errors
/// [`NotDecided`] when no proof was found.
pub fn rearrangement(topology: NamedTopology, planar: PlanarBodies) -> Result<Rearrangement, NotDecided> {
    from_seed(topology, planar, 0x5eed)
}

/// The same from another member.
pub(super) fn from_seed(
    topology: NamedTopology,
    planar: PlanarBodies,
    seed: u64,
) -> Result<Rearrangement, NotDecided> {
    let stream = 4 * topology.number() as u64 + 2 * u64::from(planar.base) + u64::from(planar.platform);
    let mut rng = Purpose::REARRANGED_MEMBERS.item(seed, stream);
    let flat = (planar.base, planar.platform);
    for _ in 0..60 {
        let sample = DesignSample::draw(topology.topology().legs(), flat, &mut rng);
        let found =
            if sample.is_general(flat) { of_sample(topology, planar, &sample, &mut rng) } else { None };
        if let Some(found) = found {
            return Ok(found);
        }
    }
    Err(NotDecided { topology, planar })
}

fn of_sample(
    topology: NamedTopology,
    planar: PlanarBodies,
    sample: &DesignSample,
    rng: &mut Rng,
) -> Option<Rearrangement> {
    let (argument, found) = families(sample, topology)?;
    let member = Arrangement::of_sample(sample)?;
    let Some(SplitFamilies { pieces, summands }) = found else {
        let planes = PlaneGroups::of(sample);
        let legs = planes.legs(sample);
        let fewest = joint_free(&legs, &mut Vec::new(), 0)?;
        let octahedral = from_cubics(sample, &planes, &legs)?;
        return fewest.is_equivalent_to(&member).then_some(Rearrangement {
            topology,
            planar,
            member,
            argument,
            families: Vec::new(),
            summands: Vec::new(),
            fewest_shared: 0,
            fewest_merged: 0,
            fewest,
            obstructions: Vec::new(),
            octahedral,
        });
    };
    let spreads = spreads(&pieces, &summands);
    let best = spreads.first()?;
    // one design has the least of both numbers; a topology without such a design would remain undecided
    let fewest_merged = spreads.iter().map(|s| s.merged).min().filter(|m| *m == best.merged)?;
    let fewest = realise(&pieces, best, &member, rng)?;
    Some(Rearrangement {
        topology,
        planar,
        member,
        argument,
        fewest_shared: best.shared,
        fewest_merged,
        fewest,
        obstructions: obstructions(&pieces, &summands, best.shared)?,
        octahedral: from_families(sample, &pieces)?,
        families: pieces,
        summands,
    })
}

/// All families, `None` inside for a pair of curves; `None` for a special sample.
fn families(sample: &DesignSample, topology: NamedTopology) -> Option<(Argument, Option<SplitFamilies>)> {
    for body in Body::BOTH {
        match split(sample, body) {
            SampleOutcome::Found(found) => return Some((Argument::Stars(body), Some(found))),
            SampleOutcome::Special => return None,
            SampleOutcome::None => {}
        }
    }
    if in_space(sample).is_some() {
        return Some((Argument::Supports, Some(at_joints(sample, &topology.topology().legs())?)));
    }
    Some((Argument::Curves, None))
}

/// Six legs with the given distribution, equivalent to the member, with no more shared joints than the distribution
/// requires.
fn realise(
    pieces: &[Piece],
    spread: &FamilySpread,
    member: &Arrangement,
    rng: &mut Rng,
) -> Option<Arrangement> {
    for _ in 0..40 {
        let taken = pieces.iter().zip(&spread.counts).flat_map(|(p, n)| std::iter::repeat_n(p, *n));
        let Some(legs) = taken.map(|p| p.draw(rng)).collect::<Option<Vec<ExactLeg>>>() else { continue };
        let found = Arrangement::of_legs(&legs)?;
        let sharing = (found.shared_joints(), found.merged_ends());
        if sharing == (spread.shared, spread.merged) && found.is_equivalent_to(member) {
            return Some(found);
        }
    }
    None
}

/// Six independent legs of the list without common joints, the earlier ones preferred.
fn joint_free(legs: &[ExactLeg], taken: &mut Vec<ExactLeg>, from: usize) -> Option<Arrangement> {
    if taken.len() == 6 {
        return Arrangement::of_legs(taken);
    }
    for (k, leg) in legs.iter().enumerate().skip(from) {
        if taken.iter().any(|l| l.base == leg.base || l.platform == leg.platform) {
            continue;
        }
        taken.push(leg.clone());
        let vectors: Vec<ExactVector> = taken.iter().map(ExactLeg::vector).collect();
        let found = if rank(&vectors) == taken.len() { joint_free(legs, taken, k + 1) } else { None };
        if found.is_some() {
            return found;
        }
        taken.pop();
    }
    None
}

/// Number of legs from each family, with their least number of shared joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct FamilySpread {
    /// Joints with two or more legs.
    pub(super) shared: usize,
    /// Twelve minus the number of joints.
    merged: usize,
    /// Legs from each family.
    pub(super) counts: Vec<usize>,
}

/// An upper bound of the rank of the legs of some families: in every summand the sum of their dimensions, at most its
/// own.
fn rank_bound<'a>(pieces: impl Iterator<Item = &'a Piece>, summands: &[usize]) -> usize {
    let mut filled = vec![0; summands.len()];
    for piece in pieces {
        piece.parts.iter().for_each(|k| filled[*k] += piece.weight);
    }
    filled.iter().zip(summands).map(|(f, s)| f.min(s)).sum()
}

/// All ways to take six legs such that no families hold more of them than their rank bound, those with the fewest
/// shared joints first.
fn spreads(pieces: &[Piece], summands: &[usize]) -> Vec<FamilySpread> {
    let bounds: Vec<usize> = (0..1usize << pieces.len())
        .map(|set| {
            rank_bound(pieces.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, p)| p), summands)
        })
        .collect();
    let mut out = Vec::new();
    let mut counts = vec![0; pieces.len()];
    spread(pieces, &bounds, &mut counts, 0, 6, &mut out);
    out.sort_by_key(|s: &FamilySpread| (s.shared, s.merged));
    out
}

fn spread(
    pieces: &[Piece],
    bounds: &[usize],
    counts: &mut [usize],
    next: usize,
    left: usize,
    out: &mut Vec<FamilySpread>,
) {
    if next == pieces.len() {
        let held = |set: usize| {
            counts.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, n)| n).sum::<usize>()
        };
        if left == 0 && (1..bounds.len()).all(|set| held(set) <= bounds[set]) {
            let common = || pieces.iter().zip(&*counts).filter(|(p, n)| p.has_common_joint() && **n > 1);
            let merged = common().map(|(_, n)| n - 1).sum();
            out.push(FamilySpread { shared: common().count(), merged, counts: counts.to_vec() });
        }
        return;
    }
    for n in 0..=left.min(pieces[next].rank()) {
        counts[next] = n;
        spread(pieces, bounds, counts, next + 1, left - n, out);
    }
    counts[next] = 0;
}

/// The reason why no equivalent design has fewer shared joints.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "ObstructionRecord")
)]
pub struct Obstruction {
    // Any number of legs comes from the families `allowed` (with a common joint), and one from each of the others with
    // a common joint. The bound is the rank of the families `within`, plus for each family outside its rank, or 1 if
    // its joint must not be shared.
    /// Families with several legs, from 0.
    pub allowed: Vec<usize>,
    /// Summands of these families, from 0.
    pub within: Vec<usize>,
    /// Greatest number of independent legs there.
    // below six
    pub most: usize,
}

/// One obstruction for every choice of `fewest - 1` families whose joints may be shared; `None` if one is missing.
///
/// The rank bound is submodular, so the least sum over `within` is the greatest number of legs (Edmonds 1970).
pub(super) fn obstructions(pieces: &[Piece], summands: &[usize], fewest: usize) -> Option<Vec<Obstruction>> {
    let Some(free) = fewest.checked_sub(1) else { return Some(Vec::new()) };
    let common: Vec<usize> = (0..pieces.len()).filter(|k| pieces[*k].has_common_joint()).collect();
    let sets = (0..1usize << pieces.len()).filter(|set| {
        set.count_ones() as usize == free
            && (0..pieces.len()).all(|k| set >> k & 1 == 0 || common.contains(&k))
    });
    sets.map(|set| {
        let of = |set: usize| (0..pieces.len()).filter(|k| set >> k & 1 == 1).collect::<Vec<_>>();
        let allowed = of(set);
        let capacity = |k: usize| {
            if common.contains(&k) && !allowed.contains(&k) { 1 } else { pieces[k].rank() }
        };
        let total = |set: usize| {
            let outside: usize = (0..pieces.len()).filter(|k| set >> k & 1 == 0).map(capacity).sum();
            outside + rank_bound(of(set).iter().map(|k| &pieces[*k]), summands)
        };
        let (most, within) = (0..1usize << pieces.len()).map(|s| (total(s), s)).min()?;
        (most < 6).then(|| Obstruction { allowed: allowed.clone(), within: of(within), most })
    })
    .collect()
}

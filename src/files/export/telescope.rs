//! Rods in their cylinders, and legs by kind.

use super::parts::SAME_LENGTH;
use super::{Export, ExportLeg, Unsupported};

/// Cylinder and rod along the line of a leg, from the centre of its base joint, design units.
///
/// The cylinder begins at the ball of the base joint and is hollow from `floor` to its end, the `mouth`. Its bore is as
/// wide as the rod, which ends at the ball of the platform joint. The rod is the longest one that fits into the
/// retracted leg. It reaches the floor at the least length, or fills the bore if the leg may be shorter than cylinder
/// and joint. A rod at least as thick as its cylinder cannot move in it. There is then no bore, and the rod begins at
/// the mouth at home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Telescope {
    /// Start of the cylinder.
    pub(super) foot: f64,
    /// Start of its bore.
    pub(super) floor: f64,
    /// End of the cylinder.
    pub(super) mouth: f64,
    /// Length of the rod.
    pub(super) rod: f64,
    /// From the end of the rod to the centre of the platform joint.
    pub(super) tip: f64,
    /// Least and greatest length of the leg: the limits of the design, otherwise those over the listed poses of
    /// workspace and trajectory. They include home.
    pub(super) range: [f64; 2],
    /// Lengths within this distance are equal.
    same: f64,
}

impl Telescope {
    /// Start of the rod at a given leg length.
    pub(super) fn tail(&self, length: f64) -> f64 {
        length - self.tip - self.rod
    }

    /// Length of the rod inside the cylinder at the greatest leg length. It is negative if the rod would leave the
    /// cylinder, and zero below the length tolerance of legs of a kind.
    pub(super) fn held(&self) -> f64 {
        self.settled(self.mouth - self.tail(self.range[1]))
    }

    /// Space between the cylinder and the ball of the platform joint at the least length; negative for a collision,
    /// zero as for [`Telescope::held`].
    pub(super) fn clearance(&self) -> f64 {
        self.settled(self.range[0] - self.tip - self.mouth)
    }

    fn settled(&self, x: f64) -> f64 {
        if x.abs() <= self.same { 0.0 } else { x }
    }
}

/// Legs with the same joints and the same length at home.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LegKind {
    /// The suffix of the names of its parts: empty if all legs are of one kind.
    pub(super) suffix: String,
    /// Length at home, design units.
    pub(super) length: f64,
    /// Indices of the legs.
    pub(super) legs: Vec<usize>,
    /// Least and greatest length over the listed poses, home among them, design units.
    pub(super) lengths: [f64; 2],
}

impl LegKind {
    /// The name of a part of it.
    pub(super) fn name(&self, part: &str) -> String {
        format!("{part}{}", self.suffix)
    }

    /// The numbers of its legs.
    pub(super) fn numbers(&self) -> String {
        let numbers: Vec<String> = self.legs.iter().map(|i| (i + 1).to_string()).collect();
        format!("legs {}", numbers.join(" "))
    }
}

/// The suffix that distinguishes the names of one kind out of `count`.
pub(super) fn kind_suffix(k: usize, count: usize) -> String {
    if count == 1 { String::new() } else { format!(", kind {}", k + 1) }
}

/// Whether the balls of a leg leave space for a cylinder and a rod; `head` is the start of the platform ball.
pub(super) fn fits(foot: f64, mouth: f64, head: f64) -> bool {
    foot < mouth && mouth < head
}

/// Start of the bore of a cylinder: its floor is as thick as its wall, and at most half of the cylinder.
pub(super) fn floor(foot: f64, mouth: f64, (thick, thin): (f64, f64)) -> f64 {
    if thin < thick { foot + (0.5 * (thick - thin)).min(0.5 * (mouth - foot)) } else { mouth }
}

impl Export {
    /// Kinds of legs in the order of their first legs.
    pub(super) fn leg_kinds(&self) -> Vec<LegKind> {
        let mut kinds: Vec<LegKind> = Vec::new();
        for (i, leg) in self.legs.iter().enumerate() {
            let length = leg.length();
            let alike = |kind: &&mut LegKind| {
                (kind.length - length).abs() <= SAME_LENGTH * self.size
                    && self.joint_sorts(kind.legs[0]) == self.joint_sorts(i)
            };
            match kinds.iter_mut().find(alike) {
                Some(kind) => kind.legs.push(i),
                None => {
                    kinds.push(LegKind {
                        suffix: String::new(),
                        length,
                        legs: vec![i],
                        lengths: [length; 2],
                    });
                }
            }
        }
        for pose in self.workspace.iter().chain(&self.trajectory) {
            let lengths = self.lengths_at(pose);
            for kind in &mut kinds {
                for i in &kind.legs {
                    kind.lengths = [kind.lengths[0].min(lengths[*i]), kind.lengths[1].max(lengths[*i])];
                }
            }
        }
        let count = kinds.len();
        for (k, kind) in kinds.iter_mut().enumerate() {
            kind.suffix = kind_suffix(k, count);
        }
        kinds
    }

    /// Cylinder and rod of the legs of a kind.
    ///
    /// # Errors
    /// [`Unsupported::LegTooShort`] if there is no space for a rod at home.
    pub(super) fn telescope(&self, kind: &LegKind) -> Result<Telescope, Unsupported> {
        let leg: &ExportLeg = &self.legs[kind.legs[0]];
        let [foot, tip] = [0, 1].map(|k: usize| 0.5 * self.bodies[k].ball_diameter);
        let (mouth, length) = (leg.cylinder, kind.length);
        if !fits(foot, mouth, length - tip) {
            let taken = foot.max(mouth) + tip;
            return Err(Unsupported::LegTooShort { leg: leg.number, length, taken });
        }
        let floor = floor(foot, mouth, leg.diameters);
        // common limits give all legs the same rod
        let range = self.leg_range.map_or(kind.lengths, |(least, greatest)| {
            let homes = self.legs.iter().map(ExportLeg::length);
            [homes.clone().fold(least, f64::min), homes.fold(greatest, f64::max)]
        });
        let least = if floor < mouth { range[0].max(mouth + tip) } else { length };
        let rod = least - tip - floor;
        Ok(Telescope { foot, floor, mouth, rod, tip, range, same: SAME_LENGTH * self.size })
    }
}

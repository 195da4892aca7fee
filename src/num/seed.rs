//! Random numbers from a given seed: `SplitMix64` (Steele, Lea, Flood 2014).
//!
//! Sixty-four bits of state suffice for test poses and generic constants, and the stream is the same on every machine.
//! [`Rng::stream`] gives element `k` of a family of streams.

/// A seeded generator. There is no other source of randomness in this crate.
#[derive(Debug, Clone)]
pub struct Rng(u64);

impl Rng {
    /// The generator for `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Stream `k` of `seed`: the numbers of item `k` of a batch are independent of the other items.
    #[must_use]
    pub fn stream(seed: u64, k: u64) -> Self {
        let mut outer = Self(seed ^ 0x6a09_e667_f3bc_c909);
        let a = outer.next_u64();
        Self(a ^ Self(k).next_u64())
    }

    /// 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in `[low, high)`.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Standard normal (Box, Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let r = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        r * (std::f64::consts::TAU * self.unit()).cos()
    }
}

/// The purpose of random numbers. Each purpose begins a new stream of the seed, or a family of streams with one for
/// each item. So the numbers of one purpose do not depend on those of another, and an item has the same numbers
/// regardless of the other items. Purposes with unrelated numbers may share a stream.
///
/// This is the whole list. Only two others draw numbers. They are the problems of `bench`, whose streams are named by
/// their class, and searches with a private seed, which begin with [`Rng::new`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Purpose {
    /// Distinguishes families that are numbered from zero.
    family: u64,
    /// The stream, or the first one of the family.
    first: u64,
}

impl Purpose {
    /// Poses for comparing two platforms; one stream a pose.
    pub const COMPARED_POSES: Self = Self::single(0);
    /// Frames in which a problem is generic, for eliminations and for real slices of curves; one stream an attempt.
    pub const GENERIC_FRAMES: Self = Self::single(0);
    /// Real slices of sets of positive dimension; one stream a slice.
    pub const SLICES: Self = Self::single(1000);
    /// The constant `gamma` of a homotopy.
    pub const GAMMA: Self = Self::single(0);
    /// Starts of the search for real points; one stream a start.
    pub const REAL_POINTS: Self = Self::family(0x7ea1);
    /// Integers for counting poses modulo primes.
    pub const POSE_COUNT: Self = Self::single(0x9c);
    /// Squared lengths of the solve that prepares a design for others.
    pub const START_LENGTHS: Self = Self::single(0x51e6);
    /// Starts of the search for common points of legs at infinity.
    pub const FAR_POINTS: Self = Self::single(0xfa2);
    /// Complex designs of a topology, the same for every seed; one stream a design.
    pub const GENERIC_DESIGNS: Self = Self::single(0);
    /// Poses and joint errors of trials; one stream a trial.
    pub const TRIALS: Self = Self::family(0x7472);
    /// Poses for tolerances.
    pub const TOLERANCE_POSES: Self = Self::single(0x706f);
    /// Poses for solving errors of joints on holes; one stream a pose.
    pub const ROUNDED_POSES: Self = Self::family(0x6772);
    /// Poses for assessing requirements.
    pub const ASSESSED_POSES: Self = Self::single(0x6d61);
    /// Allowed starts of the search for the pose nearest to a given one.
    pub const NEAREST_POSES: Self = Self::single(0x6e70);
    /// Starting poses for the bounds of requirements.
    pub const BOUNDED_POSES: Self = Self::single(0x626e);
    /// Steps of the local searches from cells of the bounds of requirements; one stream a search.
    pub const CELL_SEARCHES: Self = Self::family(0x626f);
    /// Offsets of a cell of the search for the best offsets; one stream a cell.
    pub const OFFSETS_OF_CELL: Self = Self::single(0);
    /// Further offsets of a cell to start climbs; one stream a cell.
    pub const FURTHER_OFFSETS: Self = Self::family(0x5eed);
    /// Offsets for finding the critical poses.
    pub const CRITICAL_POSES: Self = Self::single(1 << 40);
    /// Directions of the last search from the best offsets.
    pub const LAST_DIRECTIONS: Self = Self::single(u64::MAX);
    /// Starting poses of the search for worse ones.
    pub const WORSE_POSES: Self = Self::single(7);
    /// Descent directions of the search for worse poses.
    pub const DESCENT: Self = Self::single(8);
    /// Mixtures of the ends of climbs.
    pub const MIXTURES: Self = Self::single(0x4d65);
    /// The evolution of populations; one stream a population.
    pub const POPULATIONS: Self = Self::single(0x5347);
    /// Candidate poses for the next measurements.
    pub const MEASURED_POSES: Self = Self::single(0x6d65);
    /// Poses for evaluating a finished platform.
    pub const EVALUATED_POSES: Self = Self::single(0x6576);
    /// Starting coefficients of the search for the nearest singular design; one stream a start.
    pub const NEAREST_STARTS: Self = Self::single(0);
    /// Constants of the critical points of a self-motion.
    pub const CRITICAL_POINTS: Self = Self::single(0xc7);
    /// Changes of joints for the sensitivity of invariants; one stream a change.
    pub const SHIFTS: Self = Self::single(0);
    /// Members of topologies and planes for computing rearrangements; one stream a member.
    pub const REARRANGED_MEMBERS: Self = Self::single(0);
    /// Ends of legs that span a family.
    pub const FAMILY_ENDS: Self = Self::single(0xbe);
    /// Legs sampled from components; one stream a component.
    pub const SAMPLED_LEGS: Self = Self::single(0);
    /// Points marked on the curves of a figure.
    pub const FIGURE_MARKS: Self = Self::single(0xc0);
    /// Joints off their circle in the representative of a topology; one stream a topology.
    pub const REPRESENTATIVES: Self = Self::single(0);
    /// Values of the candidates of a sweep; one stream a candidate of a block.
    pub const SWEPT_VALUES: Self = Self::family(0x5357);
    /// Permutations and scramblings of the points of a sweep; one stream a dimension of a block.
    pub const SWEPT_ORDERS: Self = Self::family(0x5358);
    /// Candidates of a sweep that are computed again, or first for an estimate of the time.
    pub const SWEPT_AGAIN: Self = Self::single(0x5359);
    /// Cells of a column of a sweep for detecting repeated numbers.
    pub const SWEPT_CELLS: Self = Self::single(0x535a);
    /// Matrices of the reference timings.
    pub const REFERENCE_MATRICES: Self = Self::single(69);

    const fn single(first: u64) -> Self {
        Self { family: 0, first }
    }

    const fn family(family: u64) -> Self {
        Self { family, first: 0 }
    }

    /// The generator for this purpose.
    pub fn rng(self, seed: u64) -> Rng {
        self.item(seed, 0)
    }

    /// The generator for item `k` of this purpose.
    pub fn item(self, seed: u64, k: u64) -> Rng {
        Rng::stream(seed ^ self.family, self.first.wrapping_add(k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_values_are_those_of_splitmix64() {
        let mut rng = Rng::new(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| rng.next_u64()).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn moments_of_the_distributions() {
        let mut rng = Rng::stream(7, 3);
        let n = 40_000;
        let u: f64 = (0..n).map(|_| rng.uniform(-2.0, 4.0)).sum::<f64>() / f64::from(n);
        let v: f64 = (0..n).map(|_| rng.normal().powi(2)).sum::<f64>() / f64::from(n);
        assert!((u - 1.0).abs() < 0.05 && (v - 1.0).abs() < 0.05, "{u} {v}");
    }
}

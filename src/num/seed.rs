//! Random numbers from a seed that is passed in: `SplitMix64` (Steele, Lea, Flood 2014).
//!
//! Sixty-four bits of state are plenty for drawing test poses and generic constants, the stream is the
//! same on every machine, and element `k` of a family of streams is had by [`Rng::stream`].

/// A seeded generator. There is no other source of randomness in this crate.
#[derive(Debug, Clone)]
pub struct Rng(u64);

impl Rng {
    /// The generator for `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Stream `k` of `seed`: what item `k` of a batch draws does not depend on the other items.
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

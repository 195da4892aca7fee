//! Random numbers of the search: each step draws from a stream of its own, so that no step changes what another one draws.

use crate::num::Rng;

/// First stream of the populations, which have one each; the streams below it are free for other steps.
const POPULATIONS: u64 = 0x5347;
const MIXTURES: u64 = 0x4d65;
const EVALUATION: u64 = 0x6576;
const LOOK: u64 = 7;
const DESCENT: u64 = 8;

/// For the evolution of population `k`.
pub(crate) fn population(seed: u64, k: usize) -> Rng {
    Rng::stream(seed, POPULATIONS + k as u64)
}

/// For the mixtures of the ends of climbs.
pub(crate) fn mixtures(seed: u64) -> Rng {
    Rng::stream(seed, MIXTURES)
}

/// Seed of the look for worse poses in one round of adding them.
pub(crate) fn of_round(seed: u64, round: usize) -> u64 {
    seed.wrapping_add(round as u64)
}

/// For the poses at which a look for worse ones begins.
pub(crate) fn look(seed: u64) -> Rng {
    Rng::stream(seed, LOOK)
}

/// For the directions in which a look goes down from there.
pub(crate) fn descent(seed: u64) -> Rng {
    Rng::stream(seed, DESCENT)
}

/// For the poses over which a finished platform is evaluated.
pub(crate) fn evaluation(seed: u64) -> Rng {
    Rng::stream(seed, EVALUATION)
}

/// For the sample over which objectives are averaged: part of the problem, the same for every seed.
pub(crate) fn sample() -> Rng {
    Rng::new(1)
}

/// For the points between the corners among the poses that every run starts with: the same for every seed.
pub(crate) fn between_corners() -> Rng {
    Rng::new(2)
}

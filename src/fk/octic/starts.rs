//! The starts of the search for the angles of the corners: lengths, equal to the given ones or beside them, and their
//! known poses.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::factors::Factors;
use super::lanes::{Points, pairs, separate};
use super::parallel::Translation;
use super::solver::OcticSolver;

/// Relative offsets, in the squares, of the neighbouring lengths whose poses are continued to the given lengths.
const BESIDE: [f64; 8] = [1e-2, -1e-2, 3e-2, 3e-3, -3e-2, -3e-3, 1e-1, 1e-3];
/// A direction without symmetry.
const ASKEW: [f64; 6] = [0.71, -0.43, 1.0, 0.29, -0.87, 0.53];
/// The same for translations: parts of the distance along `x` and `y`, and of the squared height.
const SHIFTED: [[f64; 3]; 2] = [[0.0, 0.0, 0.0], [0.021, -0.013, 0.03]];
/// Newton steps on both closures, which tell pairs near each other apart; from the coarse roots they come near
/// rounding, and the angles get there.
const POLISHES: usize = 2;
/// The same for pairs that are continued, which may still be close to each other.
const POLISHES_BESIDE: usize = 8;

/// A start of the continuation: the path to eight poses that lead to the poses of the given lengths.
pub(super) struct Start<'a> {
    /// At these squared lengths, in the order s14 s24 s25 s35 s36 s16, where they are not the given ones.
    pub(super) beside: Option<[f64; 6]>,
    known: Option<Translation<'a>>,
}

impl OcticSolver {
    /// The starts in the order in which they are tried. Near a translation the roots of the octic do not settle. The
    /// start that takes as long as all the rest comes last.
    #[inline(always)]
    pub(super) fn starts<'a>(&'a self, s: &'a [f64; 6]) -> impl Iterator<Item = Start<'a>> {
        let near = self.parallel.iter().filter_map(|sides| sides.translation(s));
        let translations = near.flat_map(|known| {
            SHIFTED.into_iter().map(move |by| {
                let known = known.shifted(by);
                Start { beside: Some(known.squared_lengths()), known: Some(known) }
            })
        });
        let others = BESIDE.into_iter().map(|part| {
            let mut beside = *s;
            for i in 0..6 {
                beside[i] *= 1.0 + part * ASKEW[i];
            }
            Start { beside: Some(beside), known: None }
        });
        translations.chain([Start { beside: None, known: None }]).chain(others)
    }

    /// `P4, P5, P6` of eight poses in the frame of the base triangle, roughly, for the squared lengths `s` or those
    /// beside.
    #[inline(always)]
    pub(super) fn start(&self, start: &Start, s: &[f64; 6]) -> Option<[Points; 3]> {
        let Start { beside, known } = start;
        let squares = beside.as_ref().unwrap_or(s);
        let [s14, s24, s25, s35, s36, s16] = *squares;
        let short = self.platform.b * self.platform.b;
        let first = Factors::new(&self.base_gram, [s25, s35], [s14, s24], short);
        let second = Factors::new(&self.turned_gram, [s16, s14], [s35, s36], self.base_gram.cc);
        // pairs near each other are refused unless they are continued: there the continuation decides, and they may be
        // known with few digits
        let polishes = if beside.is_some() && known.is_none() { POLISHES_BESIDE } else { POLISHES };
        let (x, y) = pairs(&first, &second, known.as_ref(), polishes)?;
        if beside.is_none() && !separate(&[x, y]) {
            return None;
        }
        let mut corners = self.corners(squares, x, y);
        if let Some(known) = known {
            known.put(&mut corners);
        }
        Some(corners)
    }
}

//! `det J` along paths of poses, and paths that keep its sign.
//!
//! The *straight path* from one pose to another: `p` linear, the quaternion linear (and normalised), that is, the rotation about the fixed axis of
//! the relative rotation, the short way. On it `det J` is a polynomial of degree 18 over a positive function, so that its sign is proved piece
//! by piece in interval arithmetic ([`polynomial`]). Poses of the same sign may be joined by other paths ([`join()`]).

mod join;
mod polynomial;
#[cfg(test)]
mod tests;

pub use join::{JoinOptions, Joined, Way, join};
pub use polynomial::Sign;

use nalgebra::{Quaternion, UnitQuaternion};

use self::polynomial::{common_sign, determinant, halves, quaternions};
use crate::geom::Pose;
use crate::manipulator::Manipulator;
use crate::num::interval::Interval;

/// Pieces are halved this often before they are left open.
const DEPTH: u32 = 40;

/// A part `[from, to]` of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Parameter of its start, in `[0, 1]`.
    pub from: f64,
    /// Parameter of its end.
    pub to: f64,
    /// The sign of `det J` proved for all of it; `None` when a zero is there or nearly so.
    pub sign: Option<Sign>,
}

/// The signs of `det J` along a straight path, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct SignsAlong {
    /// Pieces that follow each other from 0 to 1; neighbours differ in sign, or one is open.
    pub pieces: Vec<Piece>,
}

impl SignsAlong {
    /// The sign proved for the whole path: no pose on it is singular.
    #[must_use]
    pub fn kept(&self) -> Option<Sign> {
        match self.pieces[..] {
            [piece] => piece.sign,
            _ => None,
        }
    }

    /// Proved signs at start and end.
    #[must_use]
    pub fn ends(&self) -> [Option<Sign>; 2] {
        let sign = |piece: Option<&Piece>| piece.and_then(|p| p.sign);
        [sign(self.pieces.first()), sign(self.pieces.last())]
    }

    /// Open pieces between opposite signs: each holds a singular pose.
    pub fn changes(&self) -> impl Iterator<Item = Piece> + '_ {
        self.open().filter(|w| w.1).map(|w| w.0)
    }

    /// Open pieces not between opposite signs: `det J` vanishes there, twice or more, or nearly does.
    pub fn doubtful(&self) -> impl Iterator<Item = Piece> + '_ {
        self.open().filter(|w| !w.1).map(|w| w.0)
    }

    fn open(&self) -> impl Iterator<Item = (Piece, bool)> + '_ {
        let sign = |k: Option<usize>| k.and_then(|k| self.pieces.get(k)).and_then(|p| p.sign);
        self.pieces.iter().enumerate().filter(|(_, p)| p.sign.is_none()).map(move |(k, p)| {
            let (before, after) = (sign(k.checked_sub(1)), sign(Some(k + 1)));
            (*p, before.is_some() && after.is_some() && before != after)
        })
    }
}

/// The pose at the parameter `u` of the straight path.
#[must_use]
pub fn between(from: &Pose, to: &Pose, u: f64) -> Pose {
    let (e0, e1) = quaternions(from, to);
    let e: [f64; 4] = std::array::from_fn(|k| e0[k] * (1.0 - u) + e1[k] * u);
    let rotation =
        UnitQuaternion::from_quaternion(Quaternion::new(e[0], e[1], e[2], e[3])).to_rotation_matrix();
    Pose { rotation, position: from.position * (1.0 - u) + to.position * u }
}

/// Where `det J` is proved to have which sign on the straight path from `from` to `to`.
///
/// Rotations are those of the rounded quaternions of the poses, exactly; the poses of the path are exact functions of these and of the positions.
#[must_use]
pub fn signs_along(m: &Manipulator, from: &Pose, to: &Pose) -> SignsAlong {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut open: Vec<(f64, f64, Vec<Interval>, u32)> = vec![(0.0, 1.0, determinant(m, from, to), 0)];
    while let Some((from, to, c, depth)) = open.pop() {
        let sign = common_sign(&c);
        if sign.is_none() && depth < DEPTH && !hopeless(&c) {
            let (left, right) = halves(&c);
            let middle = 0.5 * (from + to); // exact: dyadic with few digits
            open.push((middle, to, right, depth + 1));
            open.push((from, middle, left, depth + 1));
            continue;
        }
        match pieces.last_mut().filter(|last| last.sign == sign) {
            Some(last) => last.to = to,
            None => pieces.push(Piece { from, to, sign }),
        }
    }
    SignsAlong { pieces }
}

/// No coefficient has a sign: rounding hides everything, halving helps no more.
fn hopeless(c: &[Interval]) -> bool {
    c.iter().all(|x| x.lo() <= 0.0 && x.hi() >= 0.0)
}

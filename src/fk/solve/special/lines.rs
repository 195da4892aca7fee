//! Lines of a body on which legs end.

use super::Residues;
use num::modular::Field;
use num::surd::Surd;
use platform::manipulator::ExactEnds;

/// The legs with an end on a line, as bits.
pub(super) type Members = u8;

/// The number of pairs of lines, one of each body, such that every leg ends on one of them.
///
/// Both lines are spanned by ends of legs. A line that is not takes a single joint with it and turns about it, so that
/// the points at infinity are not isolated.
pub(super) fn covering_pairs([base, platform]: &[Vec<Members>; 2]) -> usize {
    let pairs = base.iter().flat_map(|l| platform.iter().map(move |k| l | k));
    pairs.filter(|covered| *covered == 0b11_1111).count()
}

/// The largest number of legs that end on one line.
pub(super) fn most(lines: &[Vec<Members>; 2]) -> usize {
    lines.iter().flatten().map(|l| l.count_ones() as usize).max().unwrap_or(0)
}

/// The lines through two different ends of a body, each once; `None` when numbers become too long.
pub(super) fn lines(residues: &Residues, ends: &[ExactEnds; 6], body: usize) -> Option<Vec<Members>> {
    let field = residues.split.field();
    let mut out: Vec<Members> = Vec::new();
    for j in 0..6 {
        for i in 0..j {
            let pair = 1 << i | 1 << j;
            // two different ends are on one line
            if out.iter().any(|line| line & pair == pair) || ends[i][body] == ends[j][body] {
                continue;
            }
            let on = |k: usize| {
                let near = collinear_modulo(field, &[i, j, k].map(|l| residues.ends[l][body]));
                if near { collinear(&[i, j, k].map(|l| &ends[l][body])) } else { Some(false) }
            };
            let mut members = pair;
            for k in (0..6).filter(|k| *k != i && *k != j) {
                members |= Members::from(on(k)?) << k;
            }
            out.push(members);
        }
    }
    Some(out)
}

fn collinear_modulo(field: Field, [p, q, r]: &[[u64; 3]; 3]) -> bool {
    let difference = |x: &[u64; 3]| -> [u64; 3] { std::array::from_fn(|k| field.sub(x[k], p[k])) };
    let (d, e) = (difference(q), difference(r));
    (0..3).all(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        field.mul(d[i], e[j]) == field.mul(d[j], e[i])
    })
}

/// Whether `(q - p) x (r - p)` is zero.
fn collinear([p, q, r]: &[&[Surd; 3]; 3]) -> Option<bool> {
    let difference = |x: &[Surd; 3]| -> Option<[Surd; 3]> {
        Some([x[0].minus(&p[0])?, x[1].minus(&p[1])?, x[2].minus(&p[2])?])
    };
    let (d, e) = (difference(q)?, difference(r)?);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        if d[i].times(&e[j])? != d[j].times(&e[i])? {
            return Some(false);
        }
    }
    Some(true)
}

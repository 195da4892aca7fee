//! Planar bodies: affine images, and projections that a linear fractional map relates.
//!
//! Ends of planar bodies have affine coordinates `X = (1, x, y)`, `X' = (1, x', y')` in their planes. A common point at
//! infinity is a matrix `W` with `X_i^T W X'_i = 0` for all legs,
//!
//! ```text
//! W = [ r       xi pi'^T     ]      alpha = pi.(x, y) + const,   beta = pi'.(x', y') + const,
//!     [ eta pi  mu pi pi'^T  ]
//! ```
//!
//! so that its last two rows have rank one, and so have its last two columns. Six independent legs leave three
//! dimensions of matrices, in which these are five conics. The minors of a `2 x 3` matrix of linear forms have three
//! common zeros, each of which may be a common zero of the others. The ring of the common zeros has the dimension
//! `10 - rank` of the cubics that the conics generate (see the documentation). The rank is computed over the field of
//! the joints. A prime shows that the zeros are different, and not at ramified projections; an error could only hide an
//! inversion. Every zero stands for two isotropic `u` with projection `pi` and two `v` with `pi'`.

use super::Residues;
use num::Rng;
use num::elimination::{Arithmetic, Rows, SurdArithmetic, eliminate, kernel};
use num::modular::Field;
use num::surd::Surd;
use platform::manipulator::{Body, ExactEnds, dimension_of_ends};

/// Products of two and of three of three unknowns.
const QUADRATIC: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];
const CUBIC: [[usize; 3]; 10] = [
    [0, 0, 0],
    [0, 0, 1],
    [0, 0, 2],
    [0, 1, 1],
    [0, 1, 2],
    [0, 2, 2],
    [1, 1, 1],
    [1, 1, 2],
    [1, 2, 2],
    [2, 2, 2],
];

/// Affine coordinates of both planes; `None` when a body is not planar, or on a line.
pub(super) fn charts(residues: &Residues) -> Option<[PlaneChart; 2]> {
    let field = residues.split.field();
    Some([chart(field, residues, 0)?, chart(field, residues, 1)?])
}

/// Whether the ends on one body are the images of those on the other under an affine map of the planes.
pub(super) fn are_affine_images(
    residues: &Residues,
    ends: &[ExactEnds; 6],
    charts: &[PlaneChart; 2],
) -> Option<bool> {
    let field = residues.split.field();
    // (1, x, y, x', y') has no larger rank than the coordinates of one plane: 3
    let row = |i: usize| {
        let [a, b] = [0, 1].map(|body| charts[body].axes.map(|k| residues.ends[i][body][k]));
        vec![1, a[0], a[1], b[0], b[1]]
    };
    if field.rank((0..6).map(row).collect()) > 3 {
        return Some(false);
    }
    let row = |i: usize| {
        let [a, b] = [0, 1].map(|body| charts[body].axes.map(|k| ends[i][body][k].clone()));
        let ([x, y], [z, w]) = (a, b);
        vec![Surd::integer(1), x, y, z, w]
    };
    let mut rows: Vec<Vec<Surd>> = (0..6).map(row).collect();
    Some(are_planar(ends) && eliminate(&SurdArithmetic, &mut rows)?.len() == 3)
}

/// The number of inversions beside `butterflies`, which are such matrices of rank one. `None` when numbers become too
/// long or a prime is unlucky.
pub(super) fn inversions(
    residues: &Residues,
    ends: &[ExactEnds; 6],
    charts: &[PlaneChart; 2],
    butterflies: usize,
    rng: &mut Rng,
) -> Option<usize> {
    let field = residues.split.field();
    let plane = |leg: usize, body: usize| charts[body].axes.map(|k| residues.ends[leg][body][k]);
    let legs: Vec<[[u64; 2]; 2]> = (0..6).map(|i| [plane(i, 0), plane(i, 1)]).collect();
    let forms = MatrixOfForms::of(&field, &legs)?;
    let zeros = CUBIC.len() - forms.cubics(&field)?.0.len();
    if zeros <= butterflies || zeros > 3 || !forms.distinct_zeros(field, charts, zeros, rng) {
        return None;
    }
    // modulo the prime it is so: now over the field of the joints
    if !are_planar(ends) {
        return None;
    }
    let plane = |leg: usize, body: usize| charts[body].axes.map(|k| ends[leg][body][k].clone());
    let legs: Vec<[[Surd; 2]; 2]> = (0..6).map(|i| [plane(i, 0), plane(i, 1)]).collect();
    let rank = MatrixOfForms::of(&SurdArithmetic, &legs)?.cubics(&SurdArithmetic)?.0.len();
    (rank + zeros == CUBIC.len()).then(|| zeros - butterflies)
}

/// Affine coordinates of the plane of a body: two of the three coordinates.
pub(super) struct PlaneChart {
    axes: [usize; 2],
    /// The quadratic form of `pi`, in the order `pi_0^2, pi_0 pi_1, pi_1^2`, that vanishes where the two isotropic
    /// vectors with this projection are one.
    ramification: [u64; 3],
}

/// Modulo the prime: `None` when the ends are not on one plane, or all on a line.
fn chart(field: Field, residues: &Residues, body: usize) -> Option<PlaneChart> {
    let end = |leg: usize| residues.ends[leg][body];
    let difference =
        |i: usize, j: usize| -> [u64; 3] { std::array::from_fn(|k| field.sub(end(j)[k], end(i)[k])) };
    let minor = |d: &[u64; 3], e: &[u64; 3], i: usize, j: usize| {
        field.sub(field.mul(d[i], e[j]), field.mul(d[j], e[i]))
    };
    for j in 1..6 {
        for k in 1..j {
            let (d, e) = (difference(0, k), difference(0, j));
            for (axes, third) in [([0, 1], 2), ([0, 2], 1), ([1, 2], 0)] {
                let area = minor(&d, &e, axes[0], axes[1]);
                if area == 0 {
                    continue;
                }
                let volume = |f: &[u64; 3]| {
                    let normal = [minor(&d, &e, 1, 2), minor(&d, &e, 2, 0), minor(&d, &e, 0, 1)];
                    (0..3).fold(0, |sum, k| field.add(sum, field.mul(normal[k], f[k])))
                };
                if (1..6).any(|l| volume(&difference(0, l)) != 0) {
                    return None;
                }
                // the third coordinate has slopes g, h in the plane: metric [1 + g^2, g h; g h, 1 + h^2]
                let over = field.inverse(area);
                let g = field.mul(minor(&d, &e, third, axes[1]), over);
                let h = field.mul(minor(&d, &e, axes[0], third), over);
                let one = |x: u64| field.add(1, field.mul(x, x));
                let twice = field.mul(field.integer(-2), field.mul(g, h));
                return Some(PlaneChart { axes, ramification: [one(h), twice, one(g)] });
            }
        }
    }
    None
}

fn are_planar(ends: &[ExactEnds; 6]) -> bool {
    Body::BOTH.into_iter().all(|body| dimension_of_ends(ends, body) == Some(2))
}

/// `W` as a matrix of linear forms in three unknowns.
struct MatrixOfForms<A: Arithmetic>([[[A::Number; 3]; 3]; 3]);

impl<A: Arithmetic> MatrixOfForms<A> {
    /// `None` when the legs are dependent.
    fn of(field: &A, legs: &[[[A::Number; 2]; 2]]) -> Option<Self> {
        let homogeneous = |p: &[A::Number; 2]| [field.one(), p[0].clone(), p[1].clone()];
        let vector = |[a, b]: &[[A::Number; 2]; 2]| -> Option<Vec<A::Number>> {
            let (a, b) = (homogeneous(a), homogeneous(b));
            a.iter().flat_map(|x| b.iter().map(move |y| field.times(x, y))).collect()
        };
        let rows = legs.iter().map(vector).collect::<Option<Vec<_>>>()?;
        let basis = kernel(field, rows, 9)?;
        let [x, y, z] = <[_; 3]>::try_from(basis).ok()?;
        let form = |k: usize| [x[k].clone(), y[k].clone(), z[k].clone()];
        Some(Self(std::array::from_fn(|j| std::array::from_fn(|l| form(3 * j + l)))))
    }

    /// Products `f g - h k` of linear forms.
    fn minor(field: &A, [f, g, h, k]: [&[A::Number; 3]; 4]) -> Option<Vec<A::Number>> {
        let product = |f: &[A::Number; 3], g: &[A::Number; 3], [i, j]: [usize; 2]| {
            let straight = field.times(&f[i], &g[j])?;
            if i == j { Some(straight) } else { field.plus(&straight, &field.times(&f[j], &g[i])?) }
        };
        QUADRATIC.iter().map(|m| field.minus(&product(f, g, *m)?, &product(h, k, *m)?)).collect()
    }

    /// The conics, in echelon form, with their leading columns.
    fn conics(&self, field: &A) -> Option<(Rows<A>, Vec<usize>)> {
        let w = &self.0;
        let rows = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| [&w[1][i], &w[2][j], &w[1][j], &w[2][i]]);
        let columns = [(0, 1), (0, 2)].map(|(i, j)| [&w[i][1], &w[j][2], &w[j][1], &w[i][2]]);
        let minors = rows.into_iter().chain(columns).map(|m| Self::minor(field, m));
        let mut conics = minors.collect::<Option<Rows<A>>>()?;
        let leading = eliminate(field, &mut conics)?;
        Some((conics, leading))
    }

    /// The cubics that they generate, likewise.
    fn cubics(&self, field: &A) -> Option<(Rows<A>, Vec<usize>)> {
        let conics = self.conics(field)?.0;
        let mut cubics: Rows<A> = Vec::new();
        for conic in &conics {
            for unknown in 0..3 {
                let mut row = vec![field.zero(); CUBIC.len()];
                for (x, monomial) in conic.iter().zip(QUADRATIC) {
                    row[cubic(monomial, unknown)] = x.clone();
                }
                cubics.push(row);
            }
        }
        let leading = eliminate(field, &mut cubics)?;
        Some((cubics, leading))
    }
}

/// The column of a product of three unknowns.
fn cubic([i, j]: [usize; 2], k: usize) -> usize {
    let mut sorted = [i, j, k];
    sorted.sort_unstable();
    CUBIC.iter().position(|m| *m == sorted).unwrap_or(0)
}

impl MatrixOfForms<Field> {
    /// Whether the `zeros` common zeros of the conics are different from each other, with projections that are not
    /// ramified.
    fn distinct_zeros(&self, field: Field, charts: &[PlaneChart; 2], zeros: usize, rng: &mut Rng) -> bool {
        self.coordinates(field, zeros, rng).is_some_and(|[x, y, z]| {
            let form = |f: &[u64; 3]| x.times(f[0]).plus(&y.times(f[1])).plus(&z.times(f[2]));
            let mut random = || rng.next_u64() >> 4;
            let distinct = form(&[random(), random(), random()]).has_distinct_eigenvalues();
            let weights = [random(), random()];
            let c = |j: usize, k: usize| form(&self.0[j][k]);
            // a multiple of pi at every zero, and one of pi'
            let mixed = |a: ResidueMatrix, b: ResidueMatrix| a.times(weights[0]).plus(&b.times(weights[1]));
            let pi = [mixed(c(1, 1), c(1, 2)), mixed(c(2, 1), c(2, 2))];
            let other = [mixed(c(1, 1), c(2, 1)), mixed(c(1, 2), c(2, 2))];
            distinct
                && [pi, other].iter().zip(charts).all(|([p, q], chart)| {
                    let [a, b, c] = chart.ramification;
                    let value = p.after(p).times(a).plus(&p.after(q).times(b)).plus(&q.after(q).times(c));
                    value.is_invertible()
                })
        })
    }

    /// Multiplication by the three unknowns, divided by a random linear form, on the ring of the common zeros.
    fn coordinates(&self, field: Field, zeros: usize, rng: &mut Rng) -> Option<[ResidueMatrix; 3]> {
        let (_, conics_lead) = self.conics(&field)?;
        let (cubics, cubics_lead) = self.cubics(&field)?;
        let standard =
            |count: usize, lead: &[usize]| (0..count).filter(|c| !lead.contains(c)).collect::<Vec<_>>();
        let (from, to) = (standard(6, &conics_lead), standard(10, &cubics_lead));
        if from.len() != zeros || to.len() != zeros {
            return None;
        }
        let multiplication = |k: usize| {
            let column = |monomial: &usize| -> Vec<u64> {
                let at = cubic(QUADRATIC[*monomial], k);
                match cubics_lead.iter().position(|c| *c == at) {
                    Some(row) => to.iter().map(|c| field.sub(0, cubics[row][*c])).collect(),
                    None => to.iter().map(|c| u64::from(*c == at)).collect(),
                }
            };
            ResidueMatrix { field, columns: from.iter().map(column).collect() }
        };
        let all = [0, 1, 2].map(multiplication);
        let mut divisor = all[0].times(rng.next_u64() >> 4);
        for m in &all[1..] {
            divisor = divisor.plus(&m.times(rng.next_u64() >> 4));
        }
        let inverse = divisor.inverse()?;
        Some(all.map(|m| inverse.after(&m)))
    }
}

/// A square matrix modulo a prime, by columns.
#[derive(Debug, Clone)]
struct ResidueMatrix {
    field: Field,
    columns: Vec<Vec<u64>>,
}

impl ResidueMatrix {
    fn map(&self, f: impl Fn(usize, usize) -> u64) -> Self {
        let n = self.columns.len();
        Self { field: self.field, columns: (0..n).map(|c| (0..n).map(|r| f(r, c)).collect()).collect() }
    }

    fn times(&self, factor: u64) -> Self {
        self.map(|r, c| self.field.mul(self.columns[c][r], factor % self.field.prime()))
    }

    fn plus(&self, other: &Self) -> Self {
        self.map(|r, c| self.field.add(self.columns[c][r], other.columns[c][r]))
    }

    /// The product, `other` first.
    fn after(&self, other: &Self) -> Self {
        let field = self.field;
        self.map(|r, c| {
            let terms = self.columns.iter().zip(&other.columns[c]);
            terms.fold(0, |sum, (column, x)| field.add(sum, field.mul(column[r], *x)))
        })
    }

    fn is_invertible(&self) -> bool {
        self.field.rank(self.columns.clone()) == self.columns.len()
    }

    fn inverse(&self) -> Option<Self> {
        let n = self.columns.len();
        // rows of the transpose beside the identity
        let beside = |(i, column): (usize, &Vec<u64>)| -> Vec<u64> {
            column.iter().copied().chain((0..n).map(|j| u64::from(i == j))).collect()
        };
        let mut rows: Vec<Vec<u64>> = self.columns.iter().enumerate().map(beside).collect();
        let leading = eliminate(&self.field, &mut rows)?;
        (leading == (0..n).collect::<Vec<_>>()).then(|| self.map(|r, c| rows[c][n + r]))
    }

    /// Whether the characteristic polynomial has no double root; for at most three rows.
    fn has_distinct_eigenvalues(&self) -> bool {
        let (field, m) = (self.field, &self.columns);
        let mul = |list: &[u64]| list.iter().fold(1, |product, x| field.mul(product, *x));
        let minor = |i: usize, j: usize| field.sub(field.mul(m[i][i], m[j][j]), field.mul(m[i][j], m[j][i]));
        let trace = (0..m.len()).fold(0, |sum, k| field.add(sum, m[k][k]));
        let four = field.integer(-4);
        match m.len() {
            1 => true,
            2 => field.add(mul(&[trace, trace]), mul(&[four, minor(0, 1)])) != 0,
            3 => {
                let second = field.add(field.add(minor(0, 1), minor(0, 2)), minor(1, 2));
                let cofactor =
                    |i: usize, j: usize| field.sub(field.mul(m[1][i], m[2][j]), field.mul(m[1][j], m[2][i]));
                let expanded = [(0, cofactor(1, 2)), (1, cofactor(2, 0)), (2, cofactor(0, 1))];
                let last = expanded.iter().fold(0, |sum, (k, x)| field.add(sum, field.mul(m[0][*k], *x)));
                let terms = [
                    mul(&[trace, trace, second, second]),
                    mul(&[four, second, second, second]),
                    mul(&[four, trace, trace, trace, last]),
                    mul(&[field.integer(18), trace, second, last]),
                    mul(&[field.integer(-27), last, last]),
                ];
                terms.iter().fold(0, |sum, x| field.add(sum, *x)) != 0
            }
            _ => false,
        }
    }
}

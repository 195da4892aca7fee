//! `det A` of a pattern as a product of factors, by Laplace expansion along forced entries.

use std::ops::{Mul, Sub};

use super::hexagon::{HexagonPoint, Offset};

/// `(prod (1 - t), prod t)` over offsets, for any number type (floating point, exact, intervals). With one offset on
/// each side of the hexagon their difference is `det A`; with some left out they give the minors of `A`.
pub fn offset_products<T>(one: &T, t: impl IntoIterator<Item = T>) -> (T, T)
where
    T: Clone + Mul<Output = T> + Sub<Output = T>,
{
    t.into_iter()
        .fold((one.clone(), one.clone()), |(rest, own), t| (rest * (one.clone() - t.clone()), own * t))
}

/// `det A = prod(1 - t_i) - prod(t_i)` of the map from the octahedral to the platform without shared joints.
///
/// The platform without shared joints is singular exactly if it vanishes, for any two triangles. Source: expansion of
/// the cyclic bidiagonal matrix of the six one-offset relations (Rojas, Borras, Thomas, sec. 6, for two distinct values
/// of `t`).
#[must_use]
pub fn offset_determinant(t: &[f64; 6]) -> f64 {
    let (rest, own) = offset_products(&1.0, *t);
    rest - own
}

/// Gradient of [`offset_determinant`] by products without the factor itself, so zero factors do no harm.
pub fn determinant_gradient(t: &[f64; 6]) -> [f64; 6] {
    std::array::from_fn(|j| {
        let (rest, own) = offset_products(&1.0, (0..6).filter(|i| *i != j).map(|i| t[i]));
        -rest - own
    })
}

/// One factor of `det A`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Factor {
    /// `1 - t`: zero when the leg reaches the next vertex of the hexagon.
    OneMinus(Offset),
    /// `t`: zero when the leg falls back on the vertex before.
    Plain(Offset),
    /// `u - t` of the two inner points of one side (0-based): zero when they coincide.
    Difference(usize),
    /// `prod (1 - t_k) - prod t_k` over all six sides: the pattern without a shared joint.
    Cycle,
}

impl Factor {
    /// The value for any number type; `at` gives the offsets.
    pub fn value<T>(self, one: &T, at: impl Fn(Offset) -> T) -> T
    where
        T: Clone + Mul<Output = T> + Sub<Output = T>,
    {
        let first = |side: usize| at(Offset { side, second: false });
        match self {
            Self::OneMinus(o) => one.clone() - at(o),
            Self::Plain(o) => at(o),
            Self::Difference(side) => at(Offset { side, second: true }) - first(side),
            Self::Cycle => {
                let (rest, own) = offset_products(one, (0..6).map(first));
                rest - own
            }
        }
    }

    /// The equation of the zero set, for instance `t1 = 1`.
    #[must_use]
    pub fn zero(self) -> String {
        match self {
            Self::OneMinus(o) => format!("{o} = 1"),
            Self::Plain(o) => format!("{o} = 0"),
            Self::Difference(side) => format!("u{0} = t{0}", side + 1),
            Self::Cycle => "(1 - t1)(1 - t2)(1 - t3)(1 - t4)(1 - t5)(1 - t6) = t1 t2 t3 t4 t5 t6".to_string(),
        }
    }
}

impl std::fmt::Display for Factor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OneMinus(o) => write!(f, "(1 - {o})"),
            Self::Plain(o) => write!(f, "{o}"),
            Self::Difference(side) => write!(f, "(u{0} - t{0})", side + 1),
            Self::Cycle => {
                f.write_str("((1 - t1)(1 - t2)(1 - t3)(1 - t4)(1 - t5)(1 - t6) - t1 t2 t3 t4 t5 t6)")
            }
        }
    }
}

/// Rows in an order that puts every leg in the place of one of its components, and the factors of `det A`.
pub(crate) struct Expansion {
    pub slots: [HexagonPoint; 6],
    pub factors: Vec<Factor>,
}

/// The factor of the entry of `point` in column `vertex`; `None` stands for 1.
fn entry(point: HexagonPoint, vertex: usize) -> Option<Factor> {
    match point {
        HexagonPoint::Vertex(_) => None,
        HexagonPoint::Inner(o) if o.side == vertex => Some(Factor::OneMinus(o)),
        HexagonPoint::Inner(o) => Some(Factor::Plain(o)),
    }
}

fn covers(point: HexagonPoint, vertex: usize) -> bool {
    match point {
        HexagonPoint::Vertex(i) => i == vertex,
        HexagonPoint::Inner(o) => o.side == vertex || (o.side + 1) % 6 == vertex,
    }
}

/// Expands `det A` of six points of the hexagon; `None` if it is the zero polynomial, so that the points are dependent
/// for all offsets.
///
/// Row `j` of `A` has entries only in the one or two columns that point `j` covers. A column or row with one remaining
/// entry is expanded (exactly one term); a column or row without entries makes the determinant zero. The remaining rows
/// and columns have two entries each, which form cycles in the hexagon. A cycle is either the two inner points of one
/// side, `(1 - t) u - t (1 - u) = u - t`, or one inner point on each of the six sides. Neither is the zero polynomial,
/// so the expansion decides generic independence exactly.
pub(crate) fn expand(points: &[HexagonPoint; 6]) -> Option<Expansion> {
    let mut slots: [Option<HexagonPoint>; 6] = [None; 6];
    let mut open: Vec<HexagonPoint> = points.to_vec();
    let mut factors = Vec::new();
    while !open.is_empty() {
        let rows_of = |v: usize| open.iter().enumerate().filter(move |(_, p)| covers(**p, v)).map(|(j, _)| j);
        let free = |v: &usize| slots[*v].is_none();
        let columns_of = |p: HexagonPoint| (0..6).filter(free).filter(move |v| covers(p, *v));
        if (0..6).filter(free).any(|v| rows_of(v).count() == 0)
            || open.iter().any(|p| columns_of(*p).count() == 0)
        {
            return None;
        }
        let by_row = open.iter().enumerate().find_map(|(j, p)| {
            let mut columns = columns_of(*p);
            columns.next().filter(|_| columns.next().is_none()).map(|v| (j, v))
        });
        let forced = by_row.or_else(|| {
            (0..6).filter(free).find_map(|v| {
                let mut rows = rows_of(v);
                rows.next().filter(|_| rows.next().is_none()).map(|j| (j, v))
            })
        });
        if let Some((j, v)) = forced {
            let point = open.remove(j);
            factors.extend(entry(point, v));
            slots[v] = Some(point);
        } else {
            factors.extend(close_cycles(&open, &mut slots));
            open.clear();
        }
    }
    factors.sort_unstable();
    let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = slots else { return None };
    Some(Expansion { slots: [a, b, c, d, e, f], factors })
}

/// Places the points of the remaining cycles and returns their factors.
fn close_cycles(open: &[HexagonPoint], slots: &mut [Option<HexagonPoint>; 6]) -> Vec<Factor> {
    let mut factors = Vec::new();
    for point in open {
        let HexagonPoint::Inner(o) = *point else { continue };
        let pair = open.contains(&HexagonPoint::Inner(Offset { second: !o.second, ..o }));
        slots[if o.second { (o.side + 1) % 6 } else { o.side }] = Some(*point);
        if pair && o.second {
            factors.push(Factor::Difference(o.side));
        } else if !pair && o.side == 0 {
            factors.push(Factor::Cycle);
        }
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hexagon::tests::example;
    use crate::joint_free;

    const T: [f64; 6] = [0.3, -0.4, 0.2, 1.3, 0.6, 0.8];

    #[test]
    fn determinant_formula_matrix_and_gradient_agree() {
        assert!((offset_determinant(&T) - joint_free(&example(), T).unwrap().1.determinant()).abs() < 1e-13);
        let (g, h) = (determinant_gradient(&T), 1e-6);
        for j in 0..6 {
            let moved = |x: f64| {
                let mut t = T;
                t[j] += x;
                t
            };
            let slope = (offset_determinant(&moved(h)) - offset_determinant(&moved(-h))) / (2.0 * h);
            assert!((slope - g[j]).abs() < 1e-9);
        }
        // Griffis-Duffy: all midpoints
        assert!(offset_determinant(&[0.5; 6]).abs() < 1e-16);
    }

    /// Legs of isosceles triangles on either side of the plane `x = 0`, ends on the edges at `t`: base end, platform
    /// end.
    fn isosceles_legs(t: [f64; 6]) -> [[[f64; 2]; 2]; 6] {
        let base = [[0.0, 2.0], [-1.5, -1.0], [1.5, -1.0]];
        let platform = [[-1.0, 0.5], [0.0, -1.0], [1.0, 0.5]];
        let between = |of: [[f64; 2]; 3], k: usize, t: f64| {
            let (u, v) = (of[k], of[(k + 1) % 3]);
            [0, 1].map(|c| u[c] + t * (v[c] - u[c]))
        };
        std::array::from_fn(|i| {
            let k = i / 2;
            if i % 2 == 0 {
                [between(base, k, t[i]), platform[k]]
            } else {
                [base[(k + 1) % 3], between(platform, k, t[i])]
            }
        })
    }

    fn is_mirror_symmetric(legs: &[[[f64; 2]; 2]; 6]) -> bool {
        let near = |a: &[[f64; 2]; 2], b: &[[f64; 2]; 2]| {
            a.iter().flatten().zip(b.iter().flatten()).all(|(x, y)| (x - y).abs() < 1e-12)
        };
        legs.iter().all(|leg| {
            let image = leg.map(|[x, y]| [-x, y]);
            legs.iter().any(|other| near(other, &image))
        })
    }

    /// "Mirror planes" in docs/theory/octahedral-class.md: platforms without shared joints have the mirror plane of the
    /// triangles exactly for the offsets `t, u, 1/2, 1 - u, 1 - t, 1/2`. All of these are singular.
    #[test]
    fn platforms_with_a_mirror_plane_are_singular() {
        for (t, u) in [(0.25, 0.125), (0.375, -0.5), (1.5, 0.75), (0.5, 0.5)] {
            let mirrored = [t, u, 0.5, 1.0 - u, 1.0 - t, 0.5];
            assert!(is_mirror_symmetric(&isosceles_legs(mirrored)), "{mirrored:?}");
            assert!(offset_determinant(&mirrored).abs() < 1e-15, "{mirrored:?}");
            for k in 0..6 {
                let mut moved = mirrored;
                moved[k] += 0.0625;
                assert!(!is_mirror_symmetric(&isosceles_legs(moved)), "{moved:?}");
            }
        }
        // three-fold: regular unless t + u = 1
        assert!(offset_determinant(&[0.25, 0.125, 0.25, 0.125, 0.25, 0.125]).abs() > 0.1);
        assert!(offset_determinant(&[0.25, 0.75, 0.25, 0.75, 0.25, 0.75]).abs() < 1e-15);
    }
}

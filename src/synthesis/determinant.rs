//! `det A` of a pattern as a product of factors, by Laplace expansion along forced entries.

use super::hexagon::{HexagonPoint, Offset};

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
    /// The value, with `at` giving the offsets.
    pub(crate) fn value(self, at: impl Fn(Offset) -> f64) -> f64 {
        match self {
            Self::OneMinus(o) => 1.0 - at(o),
            Self::Plain(o) => at(o),
            Self::Difference(side) => at(Offset { side, second: true }) - at(Offset { side, second: false }),
            Self::Cycle => {
                let t = |side| at(Offset { side, second: false });
                (0..6).map(|k| 1.0 - t(k)).product::<f64>() - (0..6).map(t).product::<f64>()
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

/// Rows in the order that puts every leg in the place of one it is made of, and the factors of `det A`.
pub(crate) struct Expansion {
    pub(crate) slots: [HexagonPoint; 6],
    pub(crate) factors: Vec<Factor>,
}

/// The factor contributed by the entry of `point` in column `vertex`; `None` stands for 1.
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

/// Expands `det A` of six points of the hexagon; `None` when it is the zero polynomial, that is when the
/// points are dependent for all offsets.
///
/// Row `j` of `A` has entries only in the one or two columns that point `j` covers. A column with one entry
/// left, or a row with one entry left, is expanded (exactly one term); a column or row with none makes the
/// determinant zero. What remains has two entries in every row and column: a cycle in the hexagon, which is either the two inner
/// points of one side, `(1 - t) u - t (1 - u) = u - t`, or one inner point on each of the six sides. Neither
/// is the zero polynomial, so the expansion decides generic independence exactly.
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

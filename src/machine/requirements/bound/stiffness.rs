//! Bounds of the least stiffness and of the lowest natural frequency over a cell.
//!
//! In the platform frame the twist `(v, w)` moves the end of leg `i` by `D_i (v, w) = v + w x b_i`, whatever the pose,
//! and with `e_i = R^T n_i / |n_i|`
//!
//! ```text
//! K = k sum D_i^T e_i e_i^T D_i,    M = M_0 + sum D_i^T (B_i I + (m_a - B_i) e_i e_i^T) D_i,    B_i = T(|n_i|) / |n_i|^2,
//! ```
//!
//! `m_a` the mass that moves along a leg, `T` its moment of inertia about an axis across it through the base joint.
//! Each requirement states that `K - s B` is positive semidefinite. A least stiffness `s` has `B = diag(I, 0)` or
//! `B = diag(0, I)`, since the Schur complement of a block of `K` is the inverse of the compliance. A frequency has
//! `B = M` and `s = omega^2`. At a point of the cell a basis makes `K` the identity and `B` diagonal, with the softest
//! motion last. An interval elimination of `K - s B` with positive pivots proves the requirement for all poses of the
//! cell. Coupling of the softest motion with the others enters by its square. The error of the bound is thus quadratic
//! in the width of the cell if the softest motion is a single one. Its own entry is bounded by second derivatives for
//! ideal joints, the other entries by first ones.

use nalgebra::{Matrix6, Vector3};

use super::frame::{CellFrame, enclosed};
use super::local::{self, Bounded};
use crate::requirements::term::{TermKind, Terms};
use crate::requirements::vibration::{mass_matrix, scaled_mass};
use crate::requirements::{LegMasses, Requirements, VibratingMasses};
use num::interval::Interval;
use num::jet::{Jet, JetVector, dot as dot_jets, place};
use num::small::bounded_svd;
use platform::geom::enclosed::{IntervalVector, cross, dot};
use platform::geom::{Chart, ChartCell, radians};
use platform::manipulator::Manipulator;

/// The matrix `B` that `K` is compared with.
#[derive(Debug, Clone, Copy)]
enum Compared<'a> {
    /// Translations: `diag(I, 0)`.
    Shifts,
    /// Rotations: `diag(0, I)`.
    Turns,
    /// The mass matrix.
    Masses(&'a VibratingMasses),
}

/// A requirement of the whole platform on its legs.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftestMotion<'a> {
    m: &'a Manipulator,
    terms: &'a Terms<'a>,
    compared: Compared<'a>,
    /// Stiffness of a leg.
    leg: f64,
    /// The required value, in the unit of the margin.
    least: f64,
}

/// Columns of the basis, by their parts `(v, w)` in the platform frame.
type Basis = [(Vector3<f64>, Vector3<f64>); 6];

/// `K` and `B` in a basis.
struct StiffnessForms {
    k: Vec<Jet>,
    b: Vec<Jet>,
}

/// Factors by which the value sinks below the first estimate in the attempts of a proof, and the least shares.
const ATTEMPTS: [(f64, f64); 6] =
    [(1.001, 1e-14), (1.1, 1e-13), (1.6, 1e-12), (3.0, 1e-10), (10.0, 1e-8), (40.0, 1e-6)];

/// Share of the slopes of the softest motion in the choice of the halved side: the corner of a cell already explains
/// the rest.
const EXPLAINED: f64 = 0.2;

impl<'a> SoftestMotion<'a> {
    /// `None` where the design does not ask for this kind.
    pub(super) fn new(
        m: &'a Manipulator,
        required: &'a Requirements,
        terms: &'a Terms<'a>,
        kind: TermKind,
    ) -> Option<Self> {
        let least = required.least_stiffness_of(kind)?;
        let leg = required.hardware.leg_stiffness.unwrap_or(0.0);
        let (compared, leg) = match kind {
            TermKind::LinearStiffness => (Compared::Shifts, leg),
            TermKind::AngularStiffness => (Compared::Turns, leg),
            _ => {
                let masses = required.vibrating.as_ref().filter(|_| !required.leaves_out_moving_legs())?;
                (Compared::Masses(masses), masses.leg)
            }
        };
        Some(Self { m, terms, compared, leg, least })
    }

    /// The margin for a value of `s`.
    fn margin(&self, s: Interval) -> Interval {
        let least = Interval::from(self.least);
        match self.compared {
            Compared::Shifts | Compared::Turns => s - least,
            Compared::Masses(_) => {
                let positive = Interval::new(s.lo().max(0.0), s.hi().max(0.0)).unwrap_or(Interval::WHOLE);
                let omega = positive.sqrt().unwrap_or(Interval::WHOLE);
                omega.checked_div(radians(360.0)).unwrap_or(Interval::WHOLE) - least
            }
        }
    }

    /// The basis at a pose, and `1 / s` of its last column, the softest motion.
    fn basis(&self, chart: &Chart, z: &[f64; 6]) -> Option<(Basis, f64)> {
        let (pose, size) = (chart.pose(z), self.m.size());
        let r = pose.rotation.matrix();
        let mut to_base = Matrix6::zeros();
        to_base.fixed_view_mut::<3, 3>(0, 0).copy_from(r);
        to_base.fixed_view_mut::<3, 3>(3, 3).copy_from(r);
        let rows = self.terms.drive_rows(&pose, size)? * to_base;
        let back = rows.try_inverse()? / self.leg.sqrt();
        let diagonal = |from: usize, unit: f64| {
            Matrix6::from_fn(|i, j| if i == j && (from..from + 3).contains(&i) { unit } else { 0.0 })
        };
        let b = match self.compared {
            Compared::Shifts => diagonal(0, 1.0),
            Compared::Turns => diagonal(3, 1.0 / (size * size)),
            Compared::Masses(masses) => {
                let own = scaled_mass(&mass_matrix(self.m, &masses.bodies, &pose), size);
                to_base.transpose() * own * to_base
            }
        };
        let found = bounded_svd(&(back.transpose() * b * back))?;
        let turned = back * found.u?;
        let mut order: [usize; 6] = std::array::from_fn(|k| k);
        order.sort_by(|i, j| found.singular_values[*i].total_cmp(&found.singular_values[*j]));
        let basis = order.map(|k| {
            let t = turned.column(k);
            (Vector3::new(t[0], t[1], t[2]), Vector3::new(t[3], t[4], t[5]) / size)
        });
        let greatest = found.singular_values[order[5]];
        let finite = basis.iter().all(|(v, w)| v.iter().chain(w.iter()).all(|x| x.is_finite()));
        (finite && greatest > 0.0 && greatest.is_finite()).then_some((basis, greatest))
    }

    /// `K` and `B` in a basis over the poses of a frame; `None` where a leg may have length zero.
    fn forms(&self, frame: &CellFrame<'_>, basis: &Basis) -> Option<StiffnessForms> {
        let zero = frame.constant(Interval::ZERO);
        // second derivatives are the greatest cost, and only those of the softest motion count
        let kept = |p: usize, q: usize, x: Jet| if (p, q) == (5, 5) { x } else { x.first_order() };
        let mut k = vec![zero.first_order(); 21];
        k[place(5, 5)] = zero;
        let mut b = k.clone();
        let columns: [(IntervalVector, IntervalVector); 6] = basis.map(|(v, w)| {
            (std::array::from_fn(|i| Interval::from(v[i])), std::array::from_fn(|i| Interval::from(w[i])))
        });
        self.fixed_part(&columns, &mut b);
        let axes: [JetVector; 3] = std::array::from_fn(|a| {
            frame.turned(&std::array::from_fn(|i| Interval::from(if i == a { 1.0 } else { 0.0 })))
        });
        let pivot = frame.pivot();
        for i in 0..6 {
            if let Some(joints) = frame.joints() {
                let along = along_drive(&joints.rates(frame, self.m, i)?, &axes, &columns);
                for (p, q) in (0..6).flat_map(|p| (p..6).map(move |q| (p, q))) {
                    let product = along[p] * along[q];
                    k[place(p, q)] = k[place(p, q)] + product.times(Interval::from(self.leg));
                }
                continue;
            }
            let [base, platform] = self.m.enclosed_ends(i);
            let square = frame.leg(self.m, i).square;
            let over = square.inverse_root()?;
            let away: JetVector = std::array::from_fn(|j| pivot[j] - frame.constant(base[j]));
            let from_pivot = frame.relative_to_pivot(&platform);
            let e: JetVector =
                std::array::from_fn(|j| (dot_jets(&axes[j], &away) + frame.constant(from_pivot[j])) * over);
            // D_i of each column
            let ends: [IntervalVector; 6] = columns.map(|(v, w)| {
                let turned = cross(&w, &platform);
                std::array::from_fn(|j| v[j] + turned[j])
            });
            let along: [Jet; 6] = ends.map(|c| e[0].times(c[0]) + e[1].times(c[1]) + e[2].times(c[2]));
            let legs = self.leg_masses(frame, &square);
            for (p, q) in (0..6).flat_map(|p| (p..6).map(move |q| (p, q))) {
                let product = kept(p, q, along[p]) * kept(p, q, along[q]);
                k[place(p, q)] = k[place(p, q)] + product.times(Interval::from(self.leg));
                if let Some((across, more)) = &legs {
                    let own =
                        kept(p, q, *across).times(dot(&ends[p], &ends[q])) + kept(p, q, *more) * product;
                    b[place(p, q)] = b[place(p, q)] + own;
                }
            }
        }
        Some(StiffnessForms { k, b })
    }

    /// The part of `B` that is independent of the pose.
    fn fixed_part(&self, columns: &[(IntervalVector, IntervalVector); 6], b: &mut [Jet]) {
        let entry = |p: usize, q: usize| {
            let ((v, w), (v2, w2)) = (&columns[p], &columns[q]);
            match self.compared {
                Compared::Shifts => dot(v, v2),
                Compared::Turns => dot(w, w2),
                Compared::Masses(masses) => {
                    let bodies = &masses.bodies;
                    let at = enclosed(&bodies.center);
                    let of_centre = |v: &IntervalVector, w: &IntervalVector| -> IntervalVector {
                        let turned = cross(w, &at);
                        std::array::from_fn(|j| v[j] + turned[j])
                    };
                    let turning: IntervalVector = std::array::from_fn(|i| {
                        dot(&std::array::from_fn(|j| Interval::from(bodies.inertia[(i, j)])), w2)
                    });
                    Interval::from(bodies.mass) * dot(&of_centre(v, w), &of_centre(v2, w2)) + dot(w, &turning)
                }
            }
        };
        for (p, q) in (0..6).flat_map(|p| (p..6).map(move |q| (p, q))) {
            b[place(p, q)] = b[place(p, q)].alike(entry(p, q));
        }
    }

    /// `B_i` and `m_a - B_i` of a leg with this square of its length; `None` for legs without masses.
    fn leg_masses(&self, frame: &CellFrame<'_>, square: &Jet) -> Option<(Jet, Jet)> {
        let Compared::Masses(masses) = self.compared else { return None };
        let leg = &masses.bodies.leg;
        if *leg == LegMasses::default() {
            return None;
        }
        let (x, mass) = (Interval::from, leg.rod.mass);
        // T(n) = T_0 + m_r n^2 - 2 m_r c_r n
        let still = x(leg.cylinder.inertia)
            + x(leg.cylinder.mass) * x(leg.cylinder.center).square()
            + x(leg.rod.inertia)
            + x(mass) * x(leg.rod.center).square();
        let over = square.inverse_root()?;
        let linear = x(-2.0) * x(mass) * x(leg.rod.center);
        let across = over.square().times(still) + over.times(linear) + frame.constant(x(mass));
        let lengthwise = frame.constant(x(mass) + x(leg.reflected));
        Some((across, lengthwise - across))
    }

    /// A lower bound of the margin over a cell, and an upper one at `z`.
    pub(super) fn bounds(
        &self,
        chart: &Chart,
        cell: &ChartCell,
        z: &[f64; 6],
        frames: (&CellFrame<'_>, &CellFrame<'_>),
    ) -> (Bounded, f64) {
        let nothing = || (Bounded::nothing(cell), f64::INFINITY);
        let Some((basis, softness)) = self.basis(chart, z) else { return nothing() };
        let Some(here) = self.forms(frames.0, &basis) else { return nothing() };
        let last = place(5, 5);
        let quotient = here.k[last].value.checked_div(here.b[last].value);
        let upper = quotient.filter(|x| x.lo() >= 0.0).map_or(f64::INFINITY, |s| self.margin(s).hi());
        let Some(over) = self.forms(frames.1, &basis) else { return (Bounded::nothing(cell), upper) };
        let first = 1.0 / softness;
        let cell_matrix = CellMatrix { chart, cell, z, here, over };
        let (estimate, loose) = cell_matrix.estimate(first);
        let proved = ATTEMPTS.iter().find_map(|(factor, least)| {
            let s = first * (1.0 - (estimate * factor).max(*least));
            (s > 0.0 && cell_matrix.is_definite(s)).then_some(s)
        });
        // K itself is positive semidefinite at every pose
        let below = self.margin(Interval::from(proved.unwrap_or(0.0))).lo();
        (Bounded { below, loose }, upper)
    }
}

/// Rate at which a drive with these rates becomes longer for twists `(v, w)` of the platform frame: `r . (R v, R w)`.
fn along_drive(
    rates: &[Jet; 6],
    axes: &[JetVector; 3],
    columns: &[(IntervalVector, IntervalVector); 6],
) -> [Jet; 6] {
    let [x, y, z, a, b, c] = *rates;
    let back = |row: JetVector| -> JetVector { std::array::from_fn(|j| dot_jets(&axes[j], &row)) };
    let (shifts, turns) = (back([x, y, z]), back([a, b, c]));
    let along =
        |row: &JetVector, v: &IntervalVector| row[0].times(v[0]) + row[1].times(v[1]) + row[2].times(v[2]);
    columns.map(|(v, w)| along(&shifts, &v) + along(&turns, &w))
}

/// `K - s B` over a cell.
struct CellMatrix<'a> {
    chart: &'a Chart,
    cell: &'a ChartCell,
    z: &'a [f64; 6],
    here: StiffnessForms,
    over: StiffnessForms,
}

impl CellMatrix<'_> {
    fn entry(&self, s: f64, i: usize, j: usize) -> (Jet, Jet) {
        let (at, s) = (place(i, j), Interval::from(s));
        let of = |forms: &StiffnessForms| forms.k[at] - forms.b[at].times(s);
        (of(&self.here), of(&self.over))
    }

    /// The values of an entry over the cell.
    fn values(&self, s: f64, i: usize, j: usize) -> Interval {
        let (here, over) = self.entry(s, i, j);
        let mut mean = here.value;
        for k in 0..self.chart.coordinates() {
            mean = mean + over.slope(k) * (self.cell.side(k) - Interval::from(self.z[k]));
        }
        let (lo, hi) = (mean.lo().max(over.value.lo()), mean.hi().min(over.value.hi()));
        Interval::new(lo, hi).unwrap_or(over.value)
    }

    /// The least value of a diagonal entry over the workspace in the cell.
    fn least(&self, s: f64, i: usize) -> f64 {
        let (here, over) = self.entry(s, i, i);
        let first = local::below_first_order(self.chart, self.cell, self.z, &here, &over).below;
        if !over.is_second_order() {
            return first;
        }
        first.max(local::below(self.chart, self.cell, self.z, &here, &over).below)
    }

    /// The approximate share by which `s` sinks over the cell, and the amount by which each coordinate loosens the
    /// bound.
    fn estimate(&self, s: f64) -> (f64, [f64; 6]) {
        let mut sinks = (-self.least(s, 5)).max(0.0);
        let mut loose = [0.0; 6];
        let (_, own) = self.entry(s, 5, 5);
        for (k, l) in loose.iter_mut().enumerate().take(self.chart.coordinates()) {
            let slope = own.slope(k);
            *l = self.cell.reach(self.z, k) * (EXPLAINED * slope.magnitude() + (slope.hi() - slope.lo()));
        }
        for j in 0..5 {
            let (shared, diagonal) = (self.values(s, j, 5).magnitude(), self.least(s, j).max(0.05));
            sinks += shared * shared / diagonal;
            let (_, across) = self.entry(s, j, 5);
            for (k, l) in loose.iter_mut().enumerate().take(self.chart.coordinates()) {
                let part = self.cell.reach(self.z, k) * across.slope(k).magnitude();
                *l += part * (shared / diagonal).min(1.0);
            }
        }
        (sinks, loose)
    }

    /// Whether elimination finds positive pivots for all matrices.
    fn is_definite(&self, s: f64) -> bool {
        let mut a = [[Interval::ZERO; 6]; 6];
        for i in 0..6 {
            let least = self.least(s, i);
            if !(least > 0.0) || !least.is_finite() {
                return false;
            }
            a[i][i] = Interval::from(least);
            for j in i + 1..6 {
                let x = self.values(s, i, j);
                (a[i][j], a[j][i]) = (x, x);
            }
        }
        for k in 0..6 {
            if !(a[k][k].lo() > 0.0) {
                return false;
            }
            for i in k + 1..6 {
                let Some(factor) = a[k][i].checked_div(a[k][k]) else { return false };
                for j in i..6 {
                    let lost = if i == j {
                        a[k][i].square().checked_div(a[k][k]).unwrap_or(Interval::WHOLE)
                    } else {
                        factor * a[k][j]
                    };
                    let left = a[i][j] - lost;
                    (a[i][j], a[j][i]) = (left, left);
                }
            }
        }
        true
    }
}

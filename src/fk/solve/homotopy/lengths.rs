//! Parameter homotopy in the squared lengths alone: as many paths as the design has poses, none of which goes to
//! infinity.
//!
//! The poses at generic complex squared lengths `s_1` are known. The lengths move on the straight line
//! `s(t) = s + t (s_1 - s)` to those asked for. The joints stay as they are, so that only the multiples of `e.e` change
//! in the leg equations. For generic `s_1` the line meets no lengths but `s` at which poses coincide or are lost
//! (Sommese, Wampler 2005, theorem 7.1.1). If `s` is generic, too, every path ends in a pose and every pose is the end
//! of one path.

use num_complex::Complex64;
use pulp::Simd;

use super::dispatch::track_all;
use super::endgame::projective_distance;
use super::fast_tracker::{FastPath, FastTracker};
use super::lanes::{Lanes, Matrix8, Vec8};
use super::limits::{BRISK, CAREFUL, FastTrackerLimits, LENGTHS, VERY_CAREFUL};
use super::monodromy::StartKind;
use super::paths::{EndKind, HomotopyPath, SAME_END, SETTLED, settle, settle_arrived, suspects, unit};
use super::polish::polish;
use super::quadrics::{QuadraticForms, Quadrics};
use super::system::{Coefficient, SectionHomotopy, SectionPath, border};
use crate::solve::planar::{PLANAR_FORMS, mirror, planar_row};
use crate::solve::sections::{FORMS, NORM_FORMS, ScaledFrames, Sections};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Poses of a design at generic complex squared lengths; of each mirror pair one where the design is doubly planar.
#[derive(Debug, Clone)]
pub(crate) struct LengthStart {
    kind: StartKind,
    /// Design units squared.
    squares: [Complex64; 6],
    /// The scale of the frame that the points belong to.
    scale: f64,
    points: Vec<[Complex64; 8]>,
}

/// Sections that change by multiples of `e.e`, `target + t slope e.e`.
struct LengthHomotopy<const F: usize> {
    target: [[f64; F]; 6],
    slope: [Complex64; 6],
}

impl<const F: usize> SectionPath<F> for LengthHomotopy<F>
where
    QuadraticForms<F>: Quadrics<F>,
{
    type Moved<S: Simd> = Lanes<S>;

    #[inline(always)]
    fn derivative_at<S: Simd>(&self, t: Lanes<S>, x: &Vec8<S>, patch: &Vec8<S>, j: &mut Matrix8<S>) {
        border(x, patch, j);
        let mut moved = [t; 4];
        for k in 0..4 {
            moved[k] = (x[k] * t).times(2.0);
        }
        for i in 0..6 {
            j[i] = QuadraticForms::real_gradient(&self.target[i], x);
            for k in 0..4 {
                j[i][k] = self.slope[i].add_times(j[i][k], moved[k]);
            }
        }
    }

    #[inline(always)]
    fn moved<S: Simd>(forms: &[Lanes<S>; F]) -> Lanes<S> {
        QuadraticForms::norm(forms)
    }

    #[inline(always)]
    fn moved_polar<S: Simd>(x: &Vec8<S>, y: &Vec8<S>) -> Lanes<S> {
        (x[0] * y[0]).mul_add(x[1], y[1]).mul_add(x[2], y[2]).mul_add(x[3], y[3]).times(2.0)
    }

    #[inline(always)]
    fn moved_sum<S: Simd>(a: &Lanes<S>, t: Lanes<S>, b: &Lanes<S>) -> Lanes<S> {
        a.mul_add(t, *b)
    }

    #[inline(always)]
    fn combine<S: Simd>(&self, forms: Option<&[Lanes<S>; F]>, moved: &Lanes<S>) -> [Lanes<S>; 6] {
        let norm = *moved;
        let mut out = [norm; 6];
        for i in 0..6 {
            out[i] = self.slope[i].add_times(Lanes::zero(norm.simd), norm);
        }
        if let Some(forms) = forms {
            for k in 0..F {
                for i in 0..6 {
                    out[i] = self.target[i][k].add_times(out[i], forms[k]);
                }
            }
        }
        out
    }
}

/// The rows at `t = 1`, less those at `t = 0`.
fn slope_rows(slope: &[Complex64; 6]) -> [[Complex64; FORMS]; 6] {
    slope.map(|z| std::array::from_fn(|k| if NORM_FORMS.contains(&k) { z } else { Complex64::ZERO }))
}

impl LengthStart {
    /// Continues the poses at the real squared lengths `from` to the complex squared lengths `to`. The poses must be
    /// regular, and one of each mirror pair for [`StartKind::Planar`]. `None` when a path gets lost or two meet.
    pub(crate) fn new(
        kind: StartKind,
        frame: &ScaledFrames,
        m: &Manipulator,
        from: &SquaredLegLengths,
        points: &[[Complex64; 8]],
        to: [Complex64; 6],
    ) -> Option<Self> {
        let real = from.get();
        let change: [Complex64; 6] = std::array::from_fn(|i| to[i] - real[i]);
        let (sections, slope) = frame.moving_sections(m, from, &change)?;
        let real_rows = sections.rows.map(|row| row.map(|z| z.re));
        let way = [Complex64::ZERO, Complex64::ZERO, Complex64::ONE];
        let limits = FastTrackerLimits { settled: SETTLED, ..LENGTHS };
        let tracked = track(kind, &real_rows, slope, points, (way, limits));
        let settled = tracked.iter().all(|p| p.remaining == Some(0.0) && p.correction < SETTLED);
        // paths that take many steps first, so that no lane of the tracker is left alone with one at the end
        let mut order: Vec<&FastPath> = tracked.iter().collect();
        order.sort_by_key(|p| std::cmp::Reverse(p.steps + p.rejections));
        let quick: Vec<[Complex64; 8]> = order.iter().map(|p| p.x).collect();
        if settled && all_different(kind, &quick) {
            return Some(Self { kind, squares: to, scale: frame.scale(), points: quick });
        }
        let forward = slope_rows(&slope);
        let mut target = sections.rows;
        for (z, d) in target.iter_mut().flatten().zip(forward.iter().flatten()) {
            *z += d;
        }
        let homotopy = SectionHomotopy::line(&target, &forward.map(|row| row.map(|z| -z)));
        let mut ends = Vec::with_capacity(points.len());
        for tracked in track_all(&homotopy, points, &CAREFUL, 0.0) {
            let end = polish(&homotopy, &tracked.x);
            ends.push((tracked.arrived && end.converged).then(|| unit(&end.x))?);
        }
        all_different(kind, &ends).then(|| Self { kind, squares: to, scale: frame.scale(), points: ends })
    }

    /// Paths to each problem.
    pub(crate) fn paths(&self) -> usize {
        self.points.len()
    }

    /// The kind of the forms and of the poses.
    pub(crate) fn kind(&self) -> StartKind {
        self.kind
    }

    /// All paths to the lengths `s`, with the sections in which they end; `frame` is [planar](ScaledFrames::planar) for
    /// [`StartKind::Planar`]. `None` when the leg equations are dependent. Paths that cannot be followed are left as
    /// [`EndKind::Failed`].
    pub(crate) fn follow(
        &self,
        frame: &ScaledFrames,
        m: &Manipulator,
        s: &SquaredLegLengths,
    ) -> Option<(Sections, Vec<HomotopyPath>)> {
        let real = s.get();
        let change: [Complex64; 6] = std::array::from_fn(|i| self.squares[i] - real[i]);
        let (sections, slope) = frame.moving_sections(m, s, &change)?;
        let starts: Vec<[Complex64; 8]> =
            self.points.iter().map(|x| unit(&frame.rescaled(x, self.scale))).collect();
        let target = sections.rows.map(|row| row.map(|z| z.re));
        let way = [Complex64::ONE, Complex64::ONE, Complex64::ZERO];
        let tracked = track(self.kind, &target, slope, &starts, (way, LENGTHS));
        let homotopy = SectionHomotopy::line(&sections.rows, &slope_rows(&slope));
        let mut paths: Vec<HomotopyPath> = tracked
            .iter()
            .map(|p| {
                let blank = HomotopyPath::under_way(p);
                match p.remaining {
                    Some(0.0) if p.correction < LENGTHS.settled => settle(blank, &p.x),
                    Some(0.0) => settle_arrived(&homotopy, &blank),
                    _ => blank,
                }
            })
            .collect();
        for limits in [BRISK, CAREFUL, VERY_CAREFUL] {
            let again = suspects(self.kind, &paths, &sections);
            if again.is_empty() {
                break;
            }
            let from: Vec<[Complex64; 8]> = again.iter().map(|i| starts[*i]).collect();
            for (index, tracked) in again.into_iter().zip(track_all(&homotopy, &from, &limits, 0.0)) {
                let path = &mut paths[index];
                path.kind = EndKind::Failed;
                path.x = tracked.x;
                path.steps += tracked.steps;
                path.rejections += tracked.rejections;
                path.retracked += 1;
                if tracked.arrived {
                    *path = settle_arrived(&homotopy, path);
                }
            }
        }
        Some((sections, paths))
    }
}

/// No two points are one, nor for [`StartKind::Planar`] mirror images of each other.
fn all_different(kind: StartKind, points: &[[Complex64; 8]]) -> bool {
    points.iter().enumerate().all(|(k, x)| {
        let meets = |y: &[Complex64; 8]| projective_distance(x, y) < SAME_END;
        let again = |y: &[Complex64; 8]| meets(y) || (kind == StartKind::Planar && meets(&mirror(*y)));
        !points[..k].iter().any(again)
    })
}

/// The paths of `target + t slope e.e` along a straight way, with the forms of the kind.
fn track(
    kind: StartKind,
    target: &[[f64; FORMS]; 6],
    slope: [Complex64; 6],
    starts: &[[Complex64; 8]],
    (way, limits): ([Complex64; 3], FastTrackerLimits),
) -> Vec<FastPath> {
    match kind {
        StartKind::Generic => {
            let homotopy = &LengthHomotopy::<FORMS> { target: *target, slope };
            FastTracker { homotopy, starts, way, limits }.run()
        }
        StartKind::Planar => {
            let homotopy = &LengthHomotopy::<PLANAR_FORMS> { target: target.map(planar_row), slope };
            FastTracker { homotopy, starts, way, limits }.run()
        }
    }
}

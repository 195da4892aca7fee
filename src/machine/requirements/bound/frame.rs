//! Points that move with the platform, as jets over a cell of poses.

use nalgebra::Point3;

use super::joint_offsets::JointOffsets;
use num::interval::Interval;
use num::jet::{Jet, JetVector, cross, dot, norm_squared};
use platform::geom::enclosed::{IntervalVector, apply};
use platform::geom::{Chart, ChartCell, TurnCoefficients};
use platform::manipulator::Manipulator;

/// The poses of a cell: translation `d` and the parts of `exp([w]x) = I + C_1 [w]x + C_2 (w w^T - (w.w) I)`.
pub(super) struct CellFrame<'a> {
    chart: &'a Chart,
    variables: usize,
    second: bool,
    shift: JetVector,
    w: JetVector,
    square: Jet,
    first: Jet,
    twice: Jet,
    joints: Option<&'a JointOffsets>,
}

impl<'a> CellFrame<'a> {
    /// The frame over a cell, with second derivatives if needed.
    pub(super) fn over(chart: &'a Chart, cell: &ChartCell, second: bool) -> Self {
        let variables = chart.coordinates();
        let values = chart.displacement(cell);
        let coordinate = |k: usize| {
            let mut slope = [Interval::ZERO; 6];
            for (s, column) in slope.iter_mut().zip(&chart.columns) {
                *s = column[k];
            }
            Jet::linear(values[k], slope, variables, second)
        };
        let shift = std::array::from_fn(coordinate);
        let w = std::array::from_fn(|k| coordinate(k + 3));
        let square = norm_squared(&w);
        let c = TurnCoefficients::over(square.value);
        Self {
            chart,
            variables,
            second,
            shift,
            w,
            square,
            first: square.composed(c.first),
            twice: square.composed(c.second),
            joints: None,
        }
    }

    /// The same poses for legs with possible joint offsets.
    pub(super) fn with_joints(mut self, joints: Option<&'a JointOffsets>) -> Self {
        self.joints = joints;
        self
    }

    /// The joint offsets, if there are any.
    pub(super) fn joints(&self) -> Option<&'a JointOffsets> {
        self.joints
    }

    pub(super) fn constant(&self, x: Interval) -> Jet {
        Jet::constant(x, self.variables, self.second)
    }

    /// A fixed vector.
    pub(super) fn fixed(&self, v: &IntervalVector) -> JetVector {
        v.map(|x| self.constant(x))
    }

    /// A vector of the platform frame in the base frame: `exp([w]x) R_0 v`.
    pub(super) fn turned(&self, v: &IntervalVector) -> JetVector {
        let y = apply(&self.chart.rotation, v);
        let fixed = self.fixed(&y);
        let once = [
            self.w[1].times(y[2]) - self.w[2].times(y[1]),
            self.w[2].times(y[0]) - self.w[0].times(y[2]),
            self.w[0].times(y[1]) - self.w[1].times(y[0]),
        ];
        let along = self.w[0].times(y[0]) + self.w[1].times(y[1]) + self.w[2].times(y[2]);
        std::array::from_fn(|k| {
            let twice = self.w[k] * along - self.square.times(y[k]);
            fixed[k] + self.first * once[k] + self.twice * twice
        })
    }

    /// `p_0 + d`, the position of the pivot.
    pub(super) fn pivot(&self) -> JetVector {
        std::array::from_fn(|k| self.shift[k] + self.constant(self.chart.position[k]))
    }

    /// A point of the platform frame, measured from the pivot.
    pub(super) fn relative_to_pivot(&self, point: &IntervalVector) -> IntervalVector {
        self.chart.relative_to_pivot(point)
    }

    /// The position of the platform origin.
    pub(super) fn origin(&self) -> JetVector {
        if self.chart.pivot.is_some() { self.moved(&Point3::origin()) } else { self.pivot() }
    }

    /// A point of the platform frame in the base frame.
    pub(super) fn moved(&self, point: &Point3<f64>) -> JetVector {
        // the pivot enters once, so that the enclosure is as tight as for rotations about the origin
        let (arm, pivot) = (self.turned(&self.relative_to_pivot(&enclosed(point))), self.pivot());
        std::array::from_fn(|k| arm[k] + pivot[k])
    }

    /// The coordinates along rotated axes: `c . R^T (x - p)` for a vector `c` of the platform frame, with the platform
    /// origin `p`.
    pub(super) fn along(&self, c: &IntervalVector, x: &JetVector) -> Jet {
        let pivot = self.pivot();
        let from_pivot = dot(&self.turned(c), &std::array::from_fn(|k| x[k] - pivot[k]));
        match &self.chart.pivot {
            None => from_pivot,
            Some(q) => from_pivot + self.constant(c[0] * q[0] + c[1] * q[1] + c[2] * q[2]),
        }
    }

    /// A leg of a manipulator: from joint to joint, or from second axis to second axis for universal joints with
    /// offsets. The result is unbounded where the axes may be undetermined.
    pub(super) fn leg(&self, m: &Manipulator, i: usize) -> LegOverCell {
        let Some(joints) = self.joints else { return self.bare_leg(m, i) };
        joints.leg(self, m, i).unwrap_or_else(|| {
            let unknown = self.square.unknown();
            let all = [unknown; 3];
            LegOverCell { base: all, arm: all, line: all, square: unknown }
        })
    }

    /// A leg from joint to joint.
    pub(super) fn bare_leg(&self, m: &Manipulator, i: usize) -> LegOverCell {
        let [base, platform] = m.enclosed_ends(i);
        let arm = self.turned(&platform);
        let from_pivot =
            if self.chart.pivot.is_some() { self.turned(&self.relative_to_pivot(&platform)) } else { arm };
        let pivot = self.pivot();
        let base = self.fixed(&base);
        let line: JetVector = std::array::from_fn(|k| from_pivot[k] + (pivot[k] - base[k]));
        LegOverCell { base, arm, line, square: norm_squared(&line) }
    }
}

/// The coordinates of a point.
pub(super) fn enclosed(point: &Point3<f64>) -> IntervalVector {
    std::array::from_fn(|k| Interval::from(point[k]))
}

/// A leg over the poses of a frame.
pub(super) struct LegOverCell {
    /// Base joint.
    pub(super) base: JetVector,
    /// `R b`.
    pub(super) arm: JetVector,
    /// `n = R b + p - a`.
    pub(super) line: JetVector,
    /// `n . n`.
    pub(super) square: Jet,
}

impl LegOverCell {
    /// `cos` of the angle between the leg and a vector of known length; `None` where the leg may have length zero.
    pub(super) fn cosine(&self, axis: &JetVector, length: Interval) -> Option<Jet> {
        let over = Interval::from(1.0).checked_div(length)?;
        Some((dot(&self.line, axis) * self.square.inverse_root()?).times(over))
    }

    /// `R b x n`.
    pub(super) fn moment(&self) -> JetVector {
        cross(&self.arm, &self.line)
    }

    /// `|R b x n|^2 / |n|^2`; `None` where the leg may have length zero.
    pub(super) fn lever_squared(&self) -> Option<Jet> {
        let inverse = self.square.inverse_root()?;
        Some(norm_squared(&self.moment()) * inverse.square())
    }
}

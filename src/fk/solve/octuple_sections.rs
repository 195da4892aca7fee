//! The sections of a platform with 256 bits. The difference between a platform and a special one nearby may be in no
//! digit of a double.

use num_complex::Complex64;

use super::sections::{FORMS, ScaledFrames, Sections, leg_row, quaternion_product};
use num::octuple::{ComplexOctuple, Octuple};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// A row of real coefficients, see [`FormRow`](super::sections::FormRow).
type OctupleRow = [Octuple; FORMS];

/// Rows whose length falls below this when earlier ones are taken off are dependent but for accidents of design data.
const DEPENDENT: f64 = 1e-45;

/// Six linear sections, `g.g` in the last one only.
#[derive(Debug, Clone)]
pub(crate) struct OctupleSections {
    pub rows: [OctupleRow; 6],
}

fn dot<const N: usize>(a: &[Octuple; N], b: &[Octuple; N]) -> Octuple {
    a.iter().zip(b).fold(Octuple::ZERO, |sum, (x, y)| sum + *x * *y)
}

impl ScaledFrames {
    /// [`sections`](Self::sections) with 256 bits, of the joints and squared lengths as they are. `None` when the
    /// equations are dependent, and for frames turned into planes, which are turned in doubles.
    pub(crate) fn octuple_sections(&self, m: &Manipulator, s: &SquaredLegLengths) -> Option<OctupleSections> {
        if self.planes.is_some() {
            return None;
        }
        let scale = Octuple::ONE / Octuple::from(self.scale);
        let centred = |p: &nalgebra::Point3<f64>, o: &nalgebra::Vector3<f64>| -> [Octuple; 3] {
            std::array::from_fn(|k| (Octuple::from(p[k]) - Octuple::from(o[k])) * scale)
        };
        let legs = m.legs();
        let s = s.middle().map(|s| Octuple::from(s.hi()) + Octuple::from(s.lo()));
        let row = |i: usize| {
            let a = centred(&legs[i].base, &self.base_origin);
            let b = centred(&legs[i].platform, &self.platform_origin);
            leg_row(&a, &b, s[i] * scale * scale)
        };
        let first = row(0);
        let apart = |i: usize| -> OctupleRow {
            let other = row(i);
            std::array::from_fn(|k| other[k] - first[k])
        };
        orthonormalised([apart(1), apart(2), apart(3), apart(4), apart(5), first])
    }
}

impl ScaledFrames {
    /// [`to_design`](Self::to_design) for a frame that is not turned.
    pub(crate) fn to_design_precisely(self, x: &[ComplexOctuple; 8]) -> [ComplexOctuple; 8] {
        let pure = |v: &nalgebra::Vector3<f64>| -> [ComplexOctuple; 4] {
            let part = |k: usize| ComplexOctuple { re: Octuple::from(v[k]), im: Octuple::ZERO };
            [ComplexOctuple::ZERO, part(0), part(1), part(2)]
        };
        let e = [x[0], x[1], x[2], x[3]];
        let left = quaternion_product(pure(&self.base_origin), e);
        let right = quaternion_product(e, pure(&self.platform_origin));
        let scale = Octuple::from(self.scale);
        let mut out = *x;
        for k in 0..4 {
            out[4 + k] = x[4 + k].times(scale) + left[k] - right[k];
        }
        out
    }
}

/// Modified Gram-Schmidt; with so many digits once is enough.
fn orthonormalised(mut rows: [OctupleRow; 6]) -> Option<OctupleSections> {
    for i in 0..6 {
        let before = dot(&rows[i], &rows[i]).rounded();
        for j in 0..i {
            let overlap = dot(&rows[j], &rows[i]);
            for k in 0..FORMS {
                rows[i][k] = rows[i][k] - rows[j][k] * overlap;
            }
        }
        let square = dot(&rows[i], &rows[i]);
        if !(square.rounded() > DEPENDENT * DEPENDENT * before) {
            return None;
        }
        let inverse = Octuple::ONE / square.sqrt();
        rows[i] = rows[i].map(|x| x * inverse);
    }
    Some(OctupleSections { rows })
}

impl OctupleSections {
    /// The nearest sections in doubles.
    pub(crate) fn rounded(&self) -> Sections {
        Sections { rows: self.rows.map(|row| row.map(|x| Complex64::new(x.rounded(), 0.0))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::sections::forms;
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    #[test]
    fn octuple_sections_are_those_in_doubles_with_more_digits() {
        let rng = &mut Rng::new(31);
        for _ in 0..10 {
            let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
            let m = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }))
                .unwrap();
            let pose = Pose { rotation: random_rotation(rng), position: Vector3::new(0.2, 0.5, 1.1) };
            let s = pose.squared_lengths(&m).unwrap();
            let frame = ScaledFrames::of(&m, &s);
            let plain = frame.sections(&m, &s).unwrap();
            let precise = frame.octuple_sections(&m, &s).unwrap();
            let rounded = precise.rounded();
            for (x, y) in plain.rows.iter().flatten().zip(rounded.rows.iter().flatten()) {
                assert!((x - y).norm() < 1e-12, "{x} {y}");
            }
            for i in 0..6 {
                for j in 0..=i {
                    let product = dot(&precise.rows[i], &precise.rows[j])
                        - if i == j { Octuple::ONE } else { Octuple::ZERO };
                    assert!(product.rounded().abs() < 1e-60);
                }
            }
            let x: [Complex64; 8] = std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal()));
            for (p, q) in forms::<ComplexOctuple>(x.map(Into::into)).iter().zip(forms(x)) {
                assert!((p.rounded() - q).norm() < 1e-14 * (1.0 + q.norm()));
            }
        }
    }
}

//! A pattern: the six points of the hexagon that are the legs of an equivalent platform.

use nalgebra::{Matrix6, Vector6};
use thiserror::Error;

use super::AffineLegMap;
use super::determinant::{Factor, expand};
use super::hexagon::{HexagonPoint, JointLabel, Offset, corner_point, edge, edge_lengths};
use crate::HexagonSide;
use platform::manipulator::{Body, InvalidManipulator, LegIndex, Manipulator, Octahedral};
use platform::topology::Topology;

/// Six points of the hexagon that are linearly independent for generic offsets.
///
/// It prints as its identifier: `V` and the unchanged legs, `S` and the sides with an inner point, from 1. `V123456` is
/// the octahedral platform, `S123456` the one without shared joints. `V3456S11` has two inner points on side 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    vertices: [bool; 6],
    inner: [u8; 6],
    slots: [HexagonPoint; 6],
    factors: Vec<Factor>,
}

/// Reasons why a pattern has no platform with the given offsets.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InstantiateError {
    /// A wrong number of offsets.
    #[error("the pattern has {expected} offsets, but {given} were given")]
    OffsetCount {
        /// Inner points of the pattern.
        expected: usize,
        /// Values given.
        given: usize,
    },
    /// NaN or infinite.
    #[error("the offset {offset} is {value}, not a finite number")]
    NotFinite {
        /// The offset.
        offset: Offset,
        /// Its value.
        value: f64,
    },
    /// Joints and legs form no manipulator.
    #[error(transparent)]
    Design(#[from] InvalidManipulator),
}

/// A text that is not a pattern identifier.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ParsePatternError {
    /// Not of the form `V` digits `S` digits with digits 1 to 6.
    #[error("a pattern is written like V3456S11: V and unchanged legs, S and sides with a moved leg, 1 to 6")]
    Form,
    /// The legs are dependent for all offsets, or not six.
    #[error("these are not six independent points of the hexagon")]
    Dependent,
}

impl Pattern {
    /// The pattern with the unchanged legs `vertices` and `inner[k]` generic points on side `k`. `None` unless these
    /// are six points, independent for generic offsets.
    #[must_use]
    pub fn new(vertices: [bool; 6], inner: [u8; 6]) -> Option<Self> {
        if inner.iter().any(|m| *m > 2) {
            return None; // three points of one line are dependent
        }
        let kept = (0..6).filter(|i| vertices[*i]).map(HexagonPoint::Vertex);
        let moved = (0..6).flat_map(|side| {
            [false, true]
                .into_iter()
                .take(usize::from(inner[side]))
                .map(move |second| Offset { side, second })
        });
        let points: Vec<_> = kept.chain(moved.map(HexagonPoint::Inner)).collect();
        let expansion = expand(&points.try_into().ok()?)?;
        Some(Self { vertices, inner, slots: expansion.slots, factors: expansion.factors })
    }

    /// Whether each leg of the octahedral platform is kept.
    #[must_use]
    pub fn vertices(&self) -> [bool; 6] {
        self.vertices
    }

    /// Number of inner points on each side.
    #[must_use]
    pub fn inner(&self) -> [u8; 6] {
        self.inner
    }

    /// The legs in cyclic order: entry `i` replaces leg `i`, one of the legs in its combination.
    #[must_use]
    pub fn legs(&self) -> [HexagonPoint; 6] {
        self.slots
    }

    /// The offsets in the order of their values: by side, the second point of a side last.
    #[must_use]
    pub fn offsets(&self) -> Vec<Offset> {
        let mut list: Vec<Offset> = self
            .slots
            .iter()
            .filter_map(|p| if let HexagonPoint::Inner(o) = p { Some(*o) } else { None })
            .collect();
        list.sort_unstable();
        list
    }

    /// Factors of `det A`; none for the octahedral platform itself (`det A = 1`).
    #[must_use]
    pub fn factors(&self) -> &[Factor] {
        &self.factors
    }

    /// `det A` as a formula.
    #[must_use]
    pub fn determinant_formula(&self) -> String {
        if self.factors.is_empty() {
            return "1".to_string();
        }
        self.factors.iter().map(Factor::to_string).collect::<Vec<_>>().join(" ")
    }

    /// Joints in use, each once: the base's, then the platform's; corners first.
    #[must_use]
    pub fn joints(&self) -> [Vec<JointLabel>; 2] {
        [0, 1].map(|body| {
            let mut list: Vec<_> = self.slots.iter().map(|p| p.joints()[body]).collect();
            list.sort_unstable();
            list.dedup();
            list
        })
    }

    /// The topology of shared joints; base and platform are distinguished.
    ///
    /// Two legs share a joint if their ends coincide by construction, for all offsets.
    #[must_use]
    pub fn topology(&self) -> Topology {
        let joints = self.joints();
        let ends = |body: usize| {
            self.legs().map(|p| joints[body].iter().position(|j| *j == p.joints()[body]).unwrap_or(0))
        };
        Topology::of_legs(ends(0), ends(1))
    }

    /// Joints that carry two or more legs, with those legs (cyclic numbers).
    #[must_use]
    pub fn shared_joints(&self) -> Vec<(Body, JointLabel, Vec<usize>)> {
        let mut shared = Vec::new();
        for (pick, body) in Body::BOTH.into_iter().enumerate() {
            for joint in &self.joints()[pick] {
                let legs: Vec<usize> = (0..6).filter(|i| self.slots[*i].joints()[pick] == *joint).collect();
                if legs.len() > 1 {
                    shared.push((body, *joint, legs));
                }
            }
        }
        shared
    }

    /// Sets of three or four joints that must be collinear, in order along the triangle side.
    #[must_use]
    pub fn alignments(&self) -> Vec<Vec<JointLabel>> {
        let used = self.joints().concat();
        let on = |side: usize| {
            let [x, y] = edge(side).map(JointLabel::Corner);
            let first = JointLabel::OnEdge(Offset { side, second: false });
            let second = JointLabel::OnEdge(Offset { side, second: true });
            [x, first, second, y].into_iter().filter(|j| used.contains(j)).collect::<Vec<_>>()
        };
        (0..6).map(on).filter(|line| line.len() > 2).collect()
    }

    fn lookup(&self, values: &[f64]) -> Result<impl Fn(Offset) -> f64, InstantiateError> {
        let offsets = self.offsets();
        if values.len() != offsets.len() {
            return Err(InstantiateError::OffsetCount { expected: offsets.len(), given: values.len() });
        }
        if let Some((offset, value)) = offsets.iter().zip(values).find(|(_, v)| !v.is_finite()) {
            return Err(InstantiateError::NotFinite { offset: *offset, value: *value });
        }
        let values = values.to_vec();
        Ok(move |o: Offset| offsets.iter().position(|x| *x == o).map_or(f64::NAN, |k| values[k]))
    }

    /// `det A` at the given offsets, from its factors.
    ///
    /// # Errors
    /// A wrong number of offsets or one that is not finite.
    pub fn determinant(&self, offsets: &[f64]) -> Result<f64, InstantiateError> {
        let at = self.lookup(offsets)?;
        Ok(self.factors.iter().map(|f| f.value(&1.0, &at)).product())
    }

    /// The leg map from the octahedral platform, in the leg order of the design from which `o` was recognised.
    ///
    /// An unchanged leg has `s' = s`; an inner point of side `k` with the edge `d_k` has
    /// `s' = (1 - t) s_k + t s_{k+1} - t (1 - t) d_k^2`.
    ///
    /// # Errors
    /// A wrong number of offsets or one that is not finite.
    pub fn leg_map(&self, o: &Octahedral, offsets: &[f64]) -> Result<AffineLegMap, InstantiateError> {
        let at = self.lookup(offsets)?;
        let (order, d) = (o.order().map(LegIndex::get), edge_lengths(o));
        let mut map = AffineLegMap { a: Matrix6::zeros(), c: Vector6::zeros() };
        for (i, point) in self.slots.iter().enumerate() {
            match *point {
                HexagonPoint::Vertex(k) => map.a[(order[i], order[k])] = 1.0,
                HexagonPoint::Inner(offset) => {
                    let (k, t) = (offset.side, at(offset));
                    map.a[(order[i], order[k])] = 1.0 - t;
                    map.a[(order[i], order[(k + 1) % 6])] = t;
                    map.c[order[i]] = -t * (1.0 - t) * d[k] * d[k];
                }
            }
        }
        Ok(map)
    }

    /// `A` as formulas in the offsets, in the leg order of the design.
    #[must_use]
    pub fn matrix_formulas(&self, o: &Octahedral) -> [[String; 6]; 6] {
        let order = o.order().map(LegIndex::get);
        let mut a: [[String; 6]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| "0".to_string()));
        for (i, point) in self.slots.iter().enumerate() {
            match *point {
                HexagonPoint::Vertex(k) => a[order[i]][order[k]] = "1".to_string(),
                HexagonPoint::Inner(t) => {
                    a[order[i]][order[t.side]] = format!("1 - {t}");
                    a[order[i]][order[(t.side + 1) % 6]] = t.to_string();
                }
            }
        }
        a
    }

    /// The platform of this pattern, legs in the leg order of the design, joints as in [`Pattern::joints`].
    ///
    /// Offsets outside `[0, 1]` put joints on the extensions of the triangle sides. Offsets on the zero set
    /// of `det A` give an architecturally singular platform; that is not refused here.
    ///
    /// # Errors
    /// A wrong number of offsets, or values that give no valid manipulator.
    pub fn instantiate(&self, o: &Octahedral, offsets: &[f64]) -> Result<Manipulator, InstantiateError> {
        let at = self.lookup(offsets)?;
        let place = |joint: &JointLabel| match *joint {
            JointLabel::Corner(i) => corner_point(o, i),
            JointLabel::OnEdge(offset) => HexagonSide::of(o, offset.side).joint(at(offset)),
        };
        let joints = self.joints();
        let index =
            |body: usize, joint: JointLabel| joints[body].iter().position(|j| *j == joint).unwrap_or(0);
        let mut pairs = [(0, 0); 6];
        for (slot, point) in o.order().iter().zip(self.slots) {
            let [a, b] = point.joints();
            pairs[slot.get()] = (index(0, a), index(1, b));
        }
        let [base, platform] = [0, 1].map(|body| joints[body].iter().map(place).collect());
        Ok(Manipulator::try_new(base, platform, pairs)?)
    }
}

impl PartialOrd for Pattern {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Pattern {
    /// By number of offsets, then unchanged legs first.
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let key = |p: &Self| (p.inner.iter().sum::<u8>(), p.vertices.map(|v| !v), p.inner.map(|m| 2 - m));
        key(self).cmp(&key(other))
    }
}

impl std::fmt::Display for Pattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = |count: [u8; 6]| {
            (0..6).flat_map(|k| (0..count[k]).map(move |_| char::from(b'1' + k as u8))).collect::<String>()
        };
        let (v, s) = (digits(self.vertices.map(u8::from)), digits(self.inner));
        let part = |letter: &str, d: &str| if d.is_empty() { String::new() } else { format!("{letter}{d}") };
        f.pad(&(part("V", &v) + &part("S", &s)))
    }
}

impl std::str::FromStr for Pattern {
    type Err = ParsePatternError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (mut vertices, mut inner, mut part) = ([false; 6], [0u8; 6], None);
        for c in text.chars() {
            match (c, part) {
                ('V', None) => part = Some('V'),
                ('S', None | Some('V')) => part = Some('S'),
                ('1'..='6', Some(p)) => {
                    let k = c as usize - '1' as usize;
                    if p == 'S' {
                        inner[k] += 1;
                    } else if std::mem::replace(&mut vertices[k], true) {
                        return Err(ParsePatternError::Form);
                    }
                }
                _ => return Err(ParsePatternError::Form),
            }
        }
        Self::new(vertices, inner).ok_or(ParsePatternError::Dependent)
    }
}

/// The platform without a shared joint (one inner point on each side) and its leg map.
///
/// `t[k]` belongs to side `k` of the cycle; leg `k` of the cycle, that is leg `o.order()[k]` of the design,
/// slides towards leg `k + 1`:
///
/// ```text
/// s'_k = (1 - t_k) s_k + t_k s_{k+1} - t_k (1 - t_k) d_k^2,    det A = prod (1 - t_k) - prod t_k.
/// ```
///
/// Source: Griffis, Duffy (1993); Rojas, Borras, Thomas, Fig. 7.
///
/// # Errors
/// Values that are not finite or give no valid manipulator.
pub fn joint_free(o: &Octahedral, t: [f64; 6]) -> Result<(Manipulator, AffineLegMap), InstantiateError> {
    let Some(pattern) = Pattern::new([false; 6], [1; 6]) else { unreachable!("det A is not zero") };
    Ok((pattern.instantiate(o, &t)?, pattern.leg_map(o, &t)?))
}

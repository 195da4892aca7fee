//! A polynomial as an answer, and the singular poses of a family as the zeros of one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use fk::{Closure, NoPosePolynomial, PosePolynomial};
use num::algebraic::Algebraic;
use num::poly::{EnclosedRoot, IntPoly, sturm_count_of_line};
use platform::topology::JointIndex;
use synthesis::singularity::{ExactPose, LocusCoefficients, LocusPolynomial, PoseFamily};

/// The representation of the coefficients of a polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CoefficientsWord {
    /// Integers without a common factor.
    Integers,
    /// Exact sums of square roots and cosines; the leading coefficient is 1.
    Expressions,
    /// Enclosures between two doubles.
    Enclosed,
}

view! {
    /// A polynomial in one unknown or in several: its degrees, its coefficients and its real roots.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PolynomialRecord {
        /// Names of unknowns.
        pub unknowns: Vec<String> = vec![unknown],
        /// Degree with spurious factors.
        pub degree_before: usize = degree.unwrap_or(0),
        /// The degree; null for the zero polynomial.
        pub degree: Option<usize> = degree,
        /// The spurious factors removed.
        pub removed: Vec<RemovedFactorRecord> = Vec::new(),
        /// Number of distinct complex roots; null: several unknowns, or not proved.
        pub distinct_roots: Option<usize> = degree,
        /// The representation of the coefficients.
        pub coefficients_known: CoefficientsWord = coefficients_known,
        /// Exponents of the unknowns by term.
        pub exponents: Vec<Vec<usize>> = degree.into_iter().flat_map(|n| 0..=n).map(|k| vec![k]).collect(),
        /// Exact coefficients, integers as decimal text; for one unknown the constant comes first.
        pub coefficients: Vec<String> = Vec::new(),
        /// Coefficient bounds [low, high]; null: they are exact.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub coefficient_bounds: Option<Vec<[Number; 2]>> = None,
        /// Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients that are
        /// not exact.
        pub real_roots_by_sturm: Option<usize> = None,
        /// Real roots as [low, high], rounded outwards.
        pub real_roots: Vec<[Number; 2]> = roots.iter().map(|r| [r.low, r.high].map(Number)).collect(),
        /// Their multiplicities.
        pub real_root_multiplicities: Vec<usize> = roots.iter().map(|r| r.multiplicity).collect(),
    }
    /// A polynomial in one unknown, of which nothing is removed and no coefficients are listed.
    fn in_one_unknown(
        unknown: String,
        degree: Option<usize>,
        coefficients_known: CoefficientsWord,
        roots: &[EnclosedRoot],
    ) {}
}

/// A spurious factor: it comes from the derivation of the polynomial and has no meaning for the poses.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RemovedFactorRecord {
    /// Factor in the unknowns, or in words.
    pub factor: String,
    /// The degree of the factor.
    pub degree: usize,
    /// Number of removals.
    pub times: usize,
}

impl PolynomialRecord {
    /// A polynomial with integer coefficients in one unknown, with its real roots if they are already known.
    fn of_integers(unknown: String, p: &IntPoly, distinct: usize, roots: &[EnclosedRoot]) -> Self {
        Self {
            distinct_roots: Some(distinct),
            coefficients: p.coefficients().iter().map(ToString::to_string).collect(),
            real_roots_by_sturm: p.degree().map(|_| sturm_count_of_line(p)),
            ..Self::in_one_unknown(unknown, p.degree(), CoefficientsWord::Integers, roots)
        }
    }

    /// The closure polynomial, with the names of joints.
    pub(crate) fn of_closure(c: &Closure, name: &impl Fn(JointIndex) -> String) -> Self {
        let p = &c.polynomial;
        let unknown = squared_distance(&p.unknown.map(name));
        let roots: Vec<EnclosedRoot> = p.real_roots.iter().map(EnclosedRoot::from).collect();
        let removed = c.degrees.factors.iter().filter(|f| f.removed > 0).map(|f| {
            let of = p.sequence.steps.iter().filter(|s| !s.rigid).nth(f.step);
            let triangle = of.map_or_else(Vec::new, |s| s.from.map(name).to_vec());
            RemovedFactorRecord {
                factor: format!("16 area^2 of the triangle {}", triangle.join(", ")),
                degree: f.degree,
                times: f.removed,
            }
        });
        Self {
            degree_before: c.degrees.before,
            removed: removed.collect(),
            ..Self::of_integers(unknown, &p.polynomial, p.distinct, &roots)
        }
    }

    /// The polynomial in a number at all poses.
    pub(crate) fn of_poses(unknown: String, p: &PosePolynomial) -> Self {
        let degree = p.coefficients.len().saturating_sub(1);
        Self {
            coefficient_bounds: Some(p.coefficients.iter().map(|c| [c.lo(), c.hi()].map(Number)).collect()),
            // the discs of the roots are disjoint, so that all roots are distinct
            ..Self::in_one_unknown(unknown, Some(degree), CoefficientsWord::Enclosed, &p.real_roots)
        }
    }

    fn of_locus(found: &LocusPolynomial, unknowns: &[&str]) -> Self {
        let own = |(square, times): &(Algebraic, usize)| RemovedFactorRecord {
            factor: match square.to_string().as_str() {
                "1" => "1 + u^2".to_owned(),
                square => format!("1 + ({square})*u^2"),
            },
            degree: 2,
            times: *times,
        };
        let (mut coefficients, mut bounds) = (Vec::new(), None);
        let exponents = match &found.coefficients {
            LocusCoefficients::Exact(terms) => {
                coefficients = terms.iter().map(|(_, c)| c.to_string()).collect();
                terms.iter().map(|(e, _)| e.clone()).collect()
            }
            LocusCoefficients::Enclosed(terms) => {
                bounds = Some(terms.iter().map(|(_, c)| [c.lo(), c.hi()].map(Number)).collect());
                terms.iter().map(|(e, _)| e.clone()).collect()
            }
        };
        let fractions = |terms: &[(Vec<usize>, Algebraic)]| terms.iter().all(|t| t.1.as_rational().is_some());
        let roots = found.roots.as_ref();
        let real = roots.map_or(&[][..], |r| &r.real);
        Self {
            unknowns: unknowns.iter().map(|x| (*x).to_owned()).collect(),
            degree_before: found.degree_before.unwrap_or(0),
            degree: found.degree,
            removed: found.removed.iter().filter(|(_, times)| *times > 0).map(own).collect(),
            distinct_roots: roots.map(|r| r.distinct),
            coefficients_known: match &found.coefficients {
                LocusCoefficients::Exact(terms) if fractions(terms) => CoefficientsWord::Integers,
                LocusCoefficients::Exact(_) => CoefficientsWord::Expressions,
                LocusCoefficients::Enclosed(_) => CoefficientsWord::Enclosed,
            },
            exponents,
            coefficients,
            coefficient_bounds: bounds,
            real_roots_by_sturm: roots.map(|r| r.sturm),
            real_roots: real.iter().map(|r| [r.low, r.high].map(Number)).collect(),
            real_root_multiplicities: real.iter().map(|r| r.multiplicity).collect(),
        }
    }
}

/// The name of the unknown of two joints.
pub(crate) fn squared_distance([x, y]: &[String; 2]) -> String {
    format!("squared distance of {x} and {y}")
}

/// The polynomial in a Cayley parameter of all poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum RotationPolynomialRecord {
    /// The polynomial exists. Its unknown c3 is z / w of the quaternion (w, x, y, z) of the platform's rotation, one
    /// root for each pose.
    Polynomial(Box<PolynomialRecord>),
    /// No polynomial.
    None {
        /// The reason.
        error: String,
    },
}

impl From<Result<PosePolynomial, NoPosePolynomial>> for RotationPolynomialRecord {
    fn from(found: Result<PosePolynomial, NoPosePolynomial>) -> Self {
        match found {
            Ok(p) => Self::Polynomial(Box::new(PolynomialRecord::of_poses("c3".to_owned(), &p))),
            Err(why) => Self::None { error: why.to_string() },
        }
    }
}

/// Poses on which det J is a polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PoseFamilyWord {
    /// All positions at one orientation; the unknowns are x, y and z.
    Positions,
    /// The positions on a line at one orientation: position + u direction.
    Line,
    /// Rotations about an axis through the platform origin: the quaternion (1, u direction) before the one given.
    Rotation,
}

view! {
    /// The answer of `singular locus`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SingularLocusAnswer {
        /// The name of the design.
        pub name: String = name.to_owned(),
        /// Unit of lengths.
        pub units: String = units.to_owned(),
        /// Poses on which det J is a polynomial.
        pub family: PoseFamilyWord = word,
        /// Position of the given pose, as exact expressions, base frame.
        pub position: [String; 3] = pose.position.each_ref().map(ToString::to_string),
        /// Quaternion of the orientation, scalar part first, of any norm, as exact expressions.
        pub quaternion: [String; 4] = pose.quaternion.each_ref().map(ToString::to_string),
        /// The direction of the line, or the axis of the rotations, base frame; null: a family of positions.
        pub direction: Option<[String; 3]> = direction.map(|d| d.each_ref().map(ToString::to_string)),
        /// The squared length of the axis; u is the tangent of half the angle divided by this length. Null: no axis.
        pub axis_squared: Option<Number> = square.filter(|_| word == PoseFamilyWord::Rotation).map(Number),
        /// det J up to a constant; the zero polynomial means that every pose is singular.
        pub polynomial: PolynomialRecord = PolynomialRecord::of_locus(found, unknowns),
    }
    /// The answer for a design, given by its name and units.
    pub fn new([name, units]: [&str; 2], pose: &ExactPose, family: &PoseFamily, found: &LocusPolynomial) {
        let (word, direction) = match family {
            PoseFamily::Positions => (PoseFamilyWord::Positions, None),
            PoseFamily::Line(d) => (PoseFamilyWord::Line, Some(d)),
            PoseFamily::Rotation(n) => (PoseFamilyWord::Rotation, Some(n)),
        };
        let square = direction.map(|n| n.iter().map(|x| x.nearest().powi(2)).sum::<f64>());
        let unknowns: &[&str] = if direction.is_some() { &["u"] } else { &["x", "y", "z"] };
    }
}

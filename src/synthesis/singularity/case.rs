//! Names of architectural singularities, each with an exact test.
//!
//! The test for a projectivity between corresponding points of two planes is exact too. A tolerance only determines the
//! name of a singular design that is known in doubles.

use nalgebra::{Point3, Vector3};

use super::dependency::{Dependency, subsets_by_size};
use super::griffis_duffy::GriffisDuffy;
use num::algebraic::Algebraic;
use num::exact::{product, rank, relations};
use num::linalg::{LinalgError, svd};
use platform::manipulator::{AlgebraicVector, Body, ExactLegs, Manipulator};

/// A geometric reason for dependent leg lines at every pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Case {
    /// Two legs join the same two points.
    CoincidentLegs,
    /// Four or more legs share one point of `body`: their lines have rank 3.
    ConcurrentFour {
        /// The body of the common point.
        body: Body,
    },
    /// All six legs pass through two points, so every line meets the line of the two.
    TwoJointsHoldAllLegs,
    /// All joints of one body lie on a line that every leg meets.
    AllCollinear {
        /// The body.
        body: Body,
    },
    /// Three legs from one point to three points of a line: three lines of a plane pencil.
    PointLine {
        /// The body with the line.
        line: Body,
    },
    /// Four or five legs with ends on two lines: the pairing of four is projective (equal cross-ratios), five are
    /// always dependent.
    LineLine,
    /// Dependent legs with ends on a line of one body and in a plane or in space on the other. These are five legs and
    /// a plane; for six, all ends of the body are on the line.
    LineOther {
        /// The body with the line.
        line: Body,
    },
    /// Both bodies planar, corresponding joints under a projectivity of the planes, the joints on a conic (Ma, Angeles
    /// 1991).
    Conic {
        /// The map from the base joints to the platform joints.
        map: PlanarMap,
    },
    /// Joints on the sides of two triangles with `prod t_i = prod (1 - t_i)` (Griffis, Duffy 1993; Husty, Karger 2000).
    GriffisDuffy,
    /// Both bodies planar, dependent leg vectors, no special name.
    PlanarBodies,
    /// Three legs from one point `X`, and two from one point `Y` of the other body to points on a line through `X`.
    /// Both the plane pencil at `Y` and the bundle at `X` contain the line `XY`.
    StarAndPencil {
        /// The body of `X`.
        star: Body,
    },
    /// Independent leg vectors, dependent lines at every pose, four joints of `body` on a line (Karger 2008).
    FourCollinear {
        /// The body.
        body: Body,
    },
    /// Independent leg vectors, dependent lines at every pose, none of the named cases.
    Unnamed,
}

impl Case {
    /// The code for the command line, from a short stable list.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::CoincidentLegs => "coincident_legs",
            Self::ConcurrentFour { .. } => "concurrent_four",
            Self::TwoJointsHoldAllLegs => "two_joints_hold_all_legs",
            Self::AllCollinear { .. }
            | Self::LineLine
            | Self::LineOther { .. }
            | Self::StarAndPencil { .. }
            | Self::FourCollinear { .. } => "four_collinear",
            Self::PointLine { .. } | Self::Conic { .. } | Self::GriffisDuffy | Self::PlanarBodies => {
                "leg_vectors_dependent"
            }
            Self::Unnamed => "jacobian_vanishes",
        }
    }

    /// The name of the case.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::CoincidentLegs => "coincident_legs",
            Self::ConcurrentFour { .. } => "concurrent_four",
            Self::TwoJointsHoldAllLegs => "two_joints_hold_all_legs",
            Self::AllCollinear { .. } => "all_collinear",
            Self::PointLine { .. } => "point_line",
            Self::LineLine => "line_line",
            Self::LineOther { .. } => "line_other",
            Self::Conic { .. } => "conic",
            Self::GriffisDuffy => "griffis_duffy",
            Self::PlanarBodies => "planar_bodies",
            Self::StarAndPencil { .. } => "star_and_pencil",
            Self::FourCollinear { .. } => "four_collinear",
            Self::Unnamed => "unnamed",
        }
    }

    /// One sentence without the legs.
    #[must_use]
    pub fn sentence(self) -> String {
        match self {
            Self::CoincidentLegs => "two legs join the same two points: their lines are one".into(),
            Self::ConcurrentFour { body } => {
                format!("four or more legs end in one point of the {body}: their lines have rank 3")
            }
            Self::TwoJointsHoldAllLegs => {
                "two points hold all six legs: every leg meets the line of the two, about which nothing is held".into()
            }
            Self::AllCollinear { body } => {
                format!("all joints of the {body} lie on a line, which every leg meets: nothing is held about it")
            }
            Self::PointLine { line } => {
                format!("three legs run from one point to three points of a line of the {line}: their lines form a pencil")
            }
            Self::LineLine => "the legs end on two lines: four with a projective pairing (equal cross-ratios), or five".into(),
            Self::LineOther { line } => {
                format!("the {line} ends lie on a line, and the leg vectors are dependent")
            }
            Self::Conic { map } => format!(
                "both bodies are planar, the platform joints are {map} of the base joints, and the joints lie on a conic"
            ),
            Self::GriffisDuffy => {
                "the joints lie on the sides of two triangles (Griffis-Duffy type) with prod t_i = prod (1 - t_i)".into()
            }
            Self::PlanarBodies => "both bodies are planar, and the leg vectors are dependent".into(),
            Self::StarAndPencil { star } => format!(
                "three legs run from one point of the {star}, two more from points on a line through it to one point: the line of the two points \
                 belongs to both groups"
            ),
            Self::FourCollinear { body } => format!(
                "the leg vectors are independent, but their lines are dependent at every pose; four joints of the {body} \
                 lie on a line"
            ),
            Self::Unnamed => "the leg vectors are independent, but their lines are dependent at every pose".into(),
        }
    }
}

/// A case and its legs (0-based).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The case.
    pub case: Case,
    /// Its legs.
    pub legs: Vec<usize>,
}

/// The legs with the same end as `leg`.
fn at_point_of(legs: &ExactLegs, body: Body, leg: usize) -> Vec<usize> {
    let ends = legs.ends(body);
    (0..6).filter(|j| ends[*j] == ends[leg]).collect()
}

/// The cases that follow from positions of joints alone, worst first.
pub(super) fn positional(legs: &ExactLegs) -> Vec<Finding> {
    let mut found = Vec::new();
    let same = |i: usize, j: usize| legs.base[i] == legs.base[j] && legs.platform[i] == legs.platform[j];
    for (i, j) in (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j))).filter(|(i, j)| same(*i, *j)) {
        found.push(Finding { case: Case::CoincidentLegs, legs: vec![i, j] });
    }
    let groups: Vec<(Body, Vec<usize>)> = Body::BOTH
        .into_iter()
        .flat_map(|body| (0..6).map(move |i| (body, i)))
        .map(|(b, i)| (b, at_point_of(legs, b, i)))
        .collect();
    for (k, (body, group)) in groups.iter().enumerate() {
        let known = groups[..k].iter().any(|g| g.0 == *body && g.1 == *group);
        if group.len() >= 4 && !known {
            found.push(Finding { case: Case::ConcurrentFour { body: *body }, legs: group.clone() });
        }
    }
    let covers = |x: &[usize], y: &[usize]| (0..6).all(|i| x.contains(&i) || y.contains(&i));
    if groups.iter().any(|x| groups.iter().any(|y| covers(&x.1, &y.1))) {
        found.push(Finding { case: Case::TwoJointsHoldAllLegs, legs: (0..6).collect() });
    }
    for body in Body::BOTH {
        if legs.dimension(body, &[0, 1, 2, 3, 4, 5]) <= 1 {
            found.push(Finding { case: Case::AllCollinear { body }, legs: (0..6).collect() });
        }
    }
    found
}

/// The case of one dependency of the leg vectors.
pub(super) fn of_dependency(legs: &ExactLegs, d: &Dependency, hexagon: Option<&GriffisDuffy>) -> Finding {
    let case = match (d.base_dimension, d.platform_dimension) {
        (0, 0) => Case::CoincidentLegs,
        (0, 1) => Case::PointLine { line: Body::Platform },
        (1, 0) => Case::PointLine { line: Body::Base },
        (0, _) => Case::ConcurrentFour { body: Body::Base },
        (_, 0) => Case::ConcurrentFour { body: Body::Platform },
        (1, 1) => Case::LineLine,
        (1, _) => Case::LineOther { line: Body::Base },
        (_, 1) => Case::LineOther { line: Body::Platform },
        // k legs of a smallest relation have i + j <= k - 2 <= 4: two planes remain
        _ => planar_case(legs, d, hexagon),
    };
    Finding { case, legs: d.legs.clone() }
}

fn planar_case(legs: &ExactLegs, d: &Dependency, hexagon: Option<&GriffisDuffy>) -> Case {
    if hexagon.is_some_and(GriffisDuffy::is_exactly_singular) {
        return Case::GriffisDuffy;
    }
    let [a, b] =
        Body::BOTH.map(|body| d.legs.iter().map(|i| legs.ends(body)[*i].clone()).collect::<Vec<_>>());
    match planar_map(&a, &b) {
        Some(map) if on_a_conic(&a) => Case::Conic { map },
        _ => Case::PlanarBodies,
    }
}

/// Whether points of a plane lie on a conic (a quadratic equation that is not identically zero on the plane).
fn on_a_conic(points: &[AlgebraicVector]) -> bool {
    let squares: Vec<_> = points.iter().map(|x| product(x, x)).collect();
    // six quadratic monomials in the plane
    rank(&squares) < 6
}

/// The case of a design with independent leg vectors and dependent lines; `among` are the legs at fault.
pub(super) fn of_lines(legs: &ExactLegs, among: Vec<usize>) -> Finding {
    if let Some(star) = Body::BOTH.into_iter().find(|b| is_star_and_pencil(legs, *b, &among)) {
        return Finding { case: Case::StarAndPencil { star }, legs: among };
    }
    let four = |body: Body| {
        subsets_by_size(4)
            .into_iter()
            .filter(|s| s.len() == 4)
            .any(|s| s.iter().all(|i| among.contains(i)) && legs.dimension(body, &s) <= 1)
    };
    let case =
        Body::BOTH.into_iter().find(|b| four(*b)).map_or(Case::Unnamed, |body| Case::FourCollinear { body });
    Finding { case, legs: among }
}

fn is_star_and_pencil(legs: &ExactLegs, star: Body, among: &[usize]) -> bool {
    let other = star.other();
    let (ends, far) = (legs.ends(star), legs.ends(other));
    among.len() == 5
        && among.iter().any(|i| {
            let (at, off): (Vec<usize>, Vec<usize>) = among.iter().partition(|j| ends[**j] == ends[*i]);
            at.len() == 3 && far[off[0]] == far[off[1]] && legs.dimension(star, &[*i, off[0], off[1]]) <= 1
        })
}

/// Singular values below this times the largest count as zero, for names only.
const NEGLIGIBLE: f64 = 1e-7;

/// The case of a relation between the vectors of `legs`; codes as in [`Case::name`](super::Case::name).
pub(super) fn name(m: &Manipulator, legs: &[usize]) -> Result<&'static str, LinalgError> {
    let all = m.legs();
    let base = plane_coordinates(m, &legs.iter().map(|i| all[*i].base).collect::<Vec<_>>())?;
    let platform = plane_coordinates(m, &legs.iter().map(|i| all[*i].platform).collect::<Vec<_>>())?;
    Ok(match (base.dimension, platform.dimension) {
        (0, 0) => "coincident_legs",
        (0, 1) | (1, 0) => "point_line",
        (0, _) | (_, 0) => "concurrent_four",
        (1, 1) => "line_line",
        (1, _) | (_, 1) => "line_other",
        // a relation of six legs or fewer leaves only two planes
        _ if legs.len() == 6 && GriffisDuffy::recognise(m).is_some_and(|g| g.is_nearly_singular()) => {
            "griffis_duffy"
        }
        _ if projective_within(&base.coordinates, &platform.coordinates)? => "conic",
        _ => "planar_bodies",
    })
}

struct PrincipalSpread {
    dimension: usize,
    /// `(1, x, y)` along the two principal axes, in units of the largest spread.
    coordinates: Vec<[f64; 3]>,
}

fn plane_coordinates(m: &Manipulator, points: &[Point3<f64>]) -> Result<PrincipalSpread, LinalgError> {
    let mean = points.iter().map(|p| p - points[0]).sum::<Vector3<f64>>() / points.len() as f64;
    let rows: Vec<Vec<f64>> =
        points.iter().map(|p| ((p - points[0] - mean) / m.size()).iter().copied().collect()).collect();
    let d = svd(&rows)?;
    let dimension = d.s.iter().filter(|s| **s > NEGLIGIBLE).count();
    let unit = if d.s[0] > 0.0 { d.s[0] } else { 1.0 };
    let along = |row: &[f64], k: usize| (0..3).map(|i| row[i] * d.v[i][k]).sum::<f64>() / unit;
    let coordinates = rows.iter().map(|row| [1.0, along(row, 0), along(row, 1)]).collect();
    Ok(PrincipalSpread { dimension, coordinates })
}

/// Whether a projectivity maps one set to the other: `b_i x T a_i = 0`, linear in the nine entries of `T`, has a
/// solution. With dependent leg vectors the points then lie on a conic.
fn projective_within(a: &[[f64; 3]], b: &[[f64; 3]]) -> Result<bool, LinalgError> {
    let mut rows = Vec::new();
    for (a, b) in a.iter().zip(b) {
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let mut row = vec![0.0; 9];
            for l in 0..3 {
                row[3 * last + l] = b[next] * a[l];
                row[3 * next + l] = -b[last] * a[l];
            }
            rows.push(row);
        }
    }
    let s = svd(&rows)?.s;
    Ok(s[8] <= NEGLIGIBLE * s[0])
}

num::words! {
    /// The map from one planar set of points to another.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum PlanarMap as words, Display {
        /// A similarity: all distances in one ratio.
        Similar = "similar images",
        /// An affine map.
        Affine = "affine images",
        /// A projectivity.
        Projective = "projective images",
    }
}

/// The most special regular map with `b_i` the image of `a_i`, points `(1, x, y, z)`; both sets span planes.
fn planar_map(a: &[AlgebraicVector], b: &[AlgebraicVector]) -> Option<PlanarMap> {
    if similar(a, b) {
        return Some(PlanarMap::Similar);
    }
    let affine = |x: &[AlgebraicVector], y: &[AlgebraicVector]| {
        let rows = x.iter().zip(y).map(|(x, y)| x.iter().chain(&y[1..]).cloned().collect());
        // the graph of an affine map of a plane is a plane
        rank(&rows.collect::<Vec<AlgebraicVector>>()) == 3
    };
    if affine(a, b) {
        return Some(PlanarMap::Affine);
    }
    projective(&in_plane(a)?, &in_plane(b)?).then_some(PlanarMap::Projective)
}

fn squared_distance(x: &AlgebraicVector, y: &AlgebraicVector) -> Algebraic {
    x.iter().zip(y).map(|(x, y)| x - y).map(|d| &d * &d).sum()
}

fn similar(a: &[AlgebraicVector], b: &[AlgebraicVector]) -> bool {
    let pairs = || (0..a.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let zero = Algebraic::integer(0);
    let from = |list: &[AlgebraicVector], (i, j): (usize, usize)| squared_distance(&list[i], &list[j]);
    let Some(unit) = pairs().find(|p| from(a, *p) != zero) else { return false };
    let (u, v) = (from(a, unit), from(b, unit));
    v != zero && pairs().all(|p| &from(a, p) * &v == &from(b, p) * &u)
}

/// Homogeneous coordinates in the plane: two coordinates in which the points still span a plane.
fn in_plane(points: &[AlgebraicVector]) -> Option<Vec<AlgebraicVector>> {
    [[1, 2], [2, 3], [3, 1]].into_iter().find_map(|[i, j]| {
        let seen: Vec<AlgebraicVector> =
            points.iter().map(|p| [0, i, j].map(|k| p[k].clone()).to_vec()).collect();
        (rank(&seen) == 3).then_some(seen)
    })
}

/// Whether a regular 3 x 3 matrix `T` with `T a_i` a multiple of `b_i` exists: `b_i x T a_i = 0` is linear in `T`.
fn projective(a: &[AlgebraicVector], b: &[AlgebraicVector]) -> bool {
    let zero = || Algebraic::integer(0);
    // one row an entry T_kl, one column an equation
    let equations = |k: usize, l: usize| -> Vec<Algebraic> {
        a.iter()
            .zip(b)
            .flat_map(|(a, b)| {
                let (mut e, next, last) = ([zero(), zero(), zero()], (k + 1) % 3, (k + 2) % 3);
                e[next] = -&(&b[last] * &a[l]);
                e[last] = &b[next] * &a[l];
                e
            })
            .collect()
    };
    let rows: Vec<_> = (0..9).map(|i| equations(i / 3, i % 3)).collect();
    let solutions = relations(&rows);
    let [t] = solutions.as_slice() else { return false };
    let minor = |i: usize, j: usize, k: usize| {
        let both = &(&t[3 + j] * &t[6 + k]) - &(&t[3 + k] * &t[6 + j]);
        &t[i] * &both
    };
    let determinant: Algebraic = [minor(0, 1, 2), minor(1, 2, 0), minor(2, 0, 1)].into_iter().sum();
    !determinant.is_zero()
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use num::exact::rational;
    use platform::manipulator::{Leg, homogeneous};

    /// Names of hypothetical singular designs with independent leg vectors beyond the known kinds. No such design is
    /// known, so the names are tested on regular designs.
    #[test]
    fn lines_without_a_known_kind_are_named_by_what_their_joints_do() {
        let joints = [[0., 0., 0.], [7., 1., 0.], [9., 6., 1.], [4., 9., -1.], [-3., 5., 2.], [-5., -2., 3.]];
        let legs = |base: [[f64; 3]; 6]| {
            let leg = |i: usize| Leg { base: Point3::from(base[i]), platform: Point3::from(joints[5 - i]) };
            ExactLegs::of_doubles(&std::array::from_fn(leg)).unwrap()
        };
        let all: Vec<usize> = (0..6).collect();
        assert_eq!(of_lines(&legs(joints), all.clone()).case, Case::Unnamed);
        let mut lined = joints;
        for (k, t) in [(0, 1.0), (2, 2.0), (3, 4.0), (5, -1.0)] {
            lined[k] = [t, 2.0 * t, 3.0];
        }
        let found = of_lines(&legs(lined), all);
        assert_eq!(found.case, Case::FourCollinear { body: Body::Base });
        assert_eq!((found.case.name(), Case::Unnamed.reason()), ("four_collinear", "jacobian_vanishes"));
        // four collinear joints count only if all are among the legs at fault
        assert_eq!(of_lines(&legs(lined), vec![0, 1, 2, 3, 4]).case, Case::Unnamed);
    }

    fn points(list: &[[f64; 3]]) -> Vec<AlgebraicVector> {
        let exact =
            |p: &[f64; 3]| homogeneous(&Point3::from(*p)).unwrap().into_iter().map(Algebraic::Rational);
        list.iter().map(|p| exact(p).collect()).collect()
    }

    #[test]
    fn maps_are_told_apart() {
        let plane = [[0.0, 0.0], [3.0, 1.0], [5.0, 2.0], [4.0, 6.0], [1.0, 7.0], [-2.0, 3.0]];
        let image = |f: &dyn Fn(f64, f64) -> [f64; 3]| points(&plane.map(|[x, y]| f(x, y)));
        let a = image(&|x, y| [x, 1.0, y]);
        // rotated by the angle of the triangle 3, 4, 5 and scaled
        assert_eq!(
            planar_map(&a, &image(&|x, y| [3.0 * x - 4.0 * y, 4.0 * x + 3.0 * y, 2.0])),
            Some(PlanarMap::Similar)
        );
        assert_eq!(planar_map(&a, &image(&|x, y| [x + y, 2.0 * y, x])), Some(PlanarMap::Affine));
        // z = 8 / (8 + x): powers of two keep the quotients exact
        let b = image(&|x, y| [x, y, 0.0]);
        let projected: Vec<AlgebraicVector> = b
            .iter()
            .map(|p| {
                let w = &Algebraic::integer(8) + &p[1];
                vec![p[0].clone(), &p[1] / &w, &p[2] / &w, p[3].clone()]
            })
            .collect();
        assert_eq!(planar_map(&a, &projected), Some(PlanarMap::Projective));
        let mut spoilt = projected;
        spoilt[4][2] = &spoilt[4][2] + &rational(1e-30).unwrap().into();
        assert_eq!(planar_map(&a, &spoilt), None);
    }
}

//! Architecturally singular designs with small integer coordinates, so that they are singular exactly.

use equipod::methods::manipulator::{InvalidManipulator, Leg, Manipulator};
use nalgebra::Point3;

/// A design and the results that must be found.
pub(crate) struct Instance {
    /// Name of the case.
    pub(crate) name: &'static str,
    pub(crate) m: Manipulator,
    pub(crate) leg_rank: usize,
    pub(crate) rank: usize,
    pub(crate) reason: &'static str,
    /// Legs of the first finding, 0-based.
    pub(crate) guilty: Vec<usize>,
}

type Point = [f64; 3];

/// Every leg on joints of its own, also where they are at one place.
pub(crate) fn apart(legs: &[Leg; 6]) -> Result<Manipulator, InvalidManipulator> {
    let (base, platform) = (legs.map(|l| l.base), legs.map(|l| l.platform));
    Manipulator::try_new(base.to_vec(), platform.to_vec(), std::array::from_fn(|i| (i, i)))
}

fn manipulator(base: [Point; 6], platform: [Point; 6]) -> Manipulator {
    let legs =
        std::array::from_fn(|i| Leg { base: Point3::from(base[i]), platform: Point3::from(platform[i]) });
    apart(&legs).unwrap()
}

/// No four of them in a plane with a special place.
const BASE: [Point; 6] =
    [[0., 0., 0.], [7., 1., 0.], [9., 6., 1.], [4., 9., -1.], [-3., 5., 2.], [-5., -2., 3.]];
const PLATFORM: [Point; 6] =
    [[1., -3., 0.], [4., -2., 1.], [5., 2., -1.], [0., 4., 2.], [-3., 1., 1.], [-2., -4., -2.]];

fn with(change: impl Fn(&mut [Point; 6], &mut [Point; 6])) -> Manipulator {
    let (mut base, mut platform) = (BASE, PLATFORM);
    change(&mut base, &mut platform);
    manipulator(base, platform)
}

fn flat(points: [[f64; 2]; 6]) -> [Point; 6] {
    points.map(|[x, y]| [x, y, 0.0])
}

/// Griffis-Duffy type on two triangles with fourths as offsets: `prod t = prod (1 - t)`.
pub(crate) fn griffis_duffy(t: [f64; 6]) -> Manipulator {
    let base = [[0., 0., 0.], [16., 4., 8.], [4., 20., -12.]];
    let top = [[8., 0., 0.], [-4., 12., 4.], [-8., -8., 16.]];
    let on = |p: [Point; 3], k: usize| -> Point {
        let (from, to) = (p[k / 2], p[(k / 2 + 1) % 3]);
        std::array::from_fn(|i| from[i] + (to[i] - from[i]) * t[k])
    };
    let ends = |k: usize| {
        if k.is_multiple_of(2) { (on(base, k), top[k / 2]) } else { (base[k.div_ceil(2) % 3], on(top, k)) }
    };
    manipulator(std::array::from_fn(|k| ends(k).0), std::array::from_fn(|k| ends(k).1))
}

/// Hexagons on a conic, the platform a similar, an affine and a projective image of the base.
pub(crate) fn conics() -> [Manipulator; 3] {
    let circle = [[5., 0.], [3., 4.], [-3., 4.], [-5., 0.], [-4., -3.], [4., -3.]];
    let parabola = [-7., -6., -4., 0., 8., 24.].map(|x| [x, x * x]);
    [
        manipulator(flat(circle), flat(circle.map(|[x, y]| [-2.0 * y, 2.0 * x]))),
        manipulator(flat(circle), flat(circle.map(|[x, y]| [x + y, 3.0 * y]))),
        manipulator(flat(parabola), flat(parabola.map(|[x, y]| [8.0 * x / (8.0 + x), 8.0 * y / (8.0 + x)]))),
    ]
}

/// Two planes that no map relates: five legs in general position and the sixth leg that lies in the span of their
/// vectors.
fn planar() -> Manipulator {
    let base = [[0., -3.], [-2., 3.], [-6., 1.], [0., 1.], [-2., -3.], [-5., 3.]];
    let platform = [[-5., 1.], [1., -1.], [2., 4.], [-7., 7.], [-7., -1.], [0., 2.]];
    manipulator(flat(base), flat(platform))
}

pub(crate) fn instances() -> Vec<Instance> {
    let all = || (0..6).collect::<Vec<usize>>();
    let case = |name, reason, (leg_rank, rank), guilty: Vec<usize>, m| Instance {
        name,
        m,
        leg_rank,
        rank,
        reason,
        guilty,
    };
    let [similar, _, projective] = conics();
    vec![
        case(
            "coincident_legs",
            "coincident_legs",
            (5, 5),
            vec![1, 4],
            with(|a, b| (a[4], b[4]) = (a[1], b[1])),
        ),
        case(
            "concurrent_four",
            "concurrent_four",
            (6, 5),
            vec![0, 1, 2, 4],
            with(|a, _| {
                for i in [1, 2, 4] {
                    a[i] = a[0];
                }
            }),
        ),
        case(
            "two_joints_hold_all_legs",
            "two_joints_hold_all_legs",
            (6, 5),
            all(),
            with(|a, b| {
                (a[1], a[2]) = (a[0], a[0]);
                (b[4], b[5]) = (b[3], b[3]);
            }),
        ),
        case(
            "all_collinear",
            "four_collinear",
            (6, 5),
            all(),
            with(|a, _| {
                *a = [-4., -1., 0., 2., 7., 9.].map(|t| [2.0 * t, t, 1.0 - t]);
            }),
        ),
        case(
            "point_line",
            "leg_vectors_dependent",
            (5, 5),
            vec![0, 2, 3],
            with(|a, b| {
                (b[2], b[3]) = (b[0], b[0]);
                for (i, t) in [(0, 0.), (2, 1.), (3, 3.)] {
                    a[i] = [1.0 + 2.0 * t, 3.0 * t, 2.0 - t];
                }
            }),
        ),
        case(
            "line_line",
            "four_collinear",
            (5, 5),
            vec![0, 1, 3, 5],
            with(|a, b| {
                // 1, 2, 4, 8 to 8, 4, 2, 1: the pairing x y = 8
                for (i, t) in [(0, 1.), (1, 2.), (3, 4.), (5, 8.)] {
                    a[i] = [t, 2.0 * t, 1.0];
                    b[i] = [3.0, 8.0 / t, -8.0 / t];
                }
            }),
        ),
        case(
            "line_line",
            "four_collinear",
            (5, 5),
            vec![0, 1, 2, 3, 5],
            with(|a, b| {
                for (i, t, u) in [(0, 1., 0.), (1, 2., 5.), (2, 3., -2.), (3, 4., 1.), (5, 8., 3.)] {
                    a[i] = [t, 2.0 * t, 1.0];
                    b[i] = [3.0, u, -u];
                }
            }),
        ),
        case(
            "line_other",
            "four_collinear",
            (5, 5),
            vec![0, 1, 2, 4, 5],
            with(|a, b| {
                // from a line to a parabola with the same parameter: polynomials of degree 3, four independent ones
                for (i, t) in [(0, 0.), (1, 1.), (2, 3.), (4, -1.), (5, -2.)] {
                    a[i] = [t, 2.0 * t, 1.0];
                    b[i] = [t, t * t, 2.0 - t - t * t];
                }
            }),
        ),
        case("planar_bodies", "leg_vectors_dependent", (5, 5), all(), planar()),
        case(
            "star_and_pencil",
            "four_collinear",
            (6, 5),
            vec![0, 1, 2, 3, 4],
            with(|a, b| {
                (a[1], a[2]) = (a[0], a[0]);
                (a[3], a[4]) = ([2., 1., -1.], [6., 3., -3.]);
                b[4] = b[3];
            }),
        ),
        case("conic", "leg_vectors_dependent", (5, 5), all(), similar),
        case("conic", "leg_vectors_dependent", (5, 5), all(), projective),
        case(
            "griffis_duffy",
            "leg_vectors_dependent",
            (5, 5),
            all(),
            griffis_duffy([0.25, 0.75, 0.5, 0.25, 0.5, 0.75]),
        ),
    ]
}

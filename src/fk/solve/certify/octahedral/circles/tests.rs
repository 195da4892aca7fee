use super::*;
use num::Rng;
use num_rational::BigRational;

type Exact = BigRational;

fn exact(x: f64) -> Exact {
    BigRational::from_float(x).unwrap()
}

/// `|P - Q|^2 - d` over the rationals, for corners with real `u`, whose heights are imaginary.
struct ExactCorner {
    place: [Exact; 2],
    /// The height over the imaginary unit.
    height: Exact,
}

/// A corner on the circle of squared lengths `s` about the side from `start` along `along`, a rational unit vector, of
/// length `length`.
fn corner(start: [i64; 2], along: [(i64, i64); 2], length: i64, s: [f64; 2], u: f64) -> ExactCorner {
    let whole = |n: i64| Exact::from_integer(n.into());
    let along = along.map(|(n, d)| Exact::new(n.into(), d.into()));
    let half = Exact::new(1.into(), 2.into());
    let length = whole(length);
    let foot = (exact(s[0]) + &length * &length - exact(s[1])) * &half / &length;
    let (u, v) = (exact(u), (exact(s[0]) - &foot * &foot) / exact(u));
    let (h, height) = ((&u + &v) * &half, (&v - &u) * &half);
    let across = [-along[1].clone(), along[0].clone()];
    let place = [0, 1].map(|i| whole(start[i]) + &foot * &along[i] + &h * &across[i]);
    ExactCorner { place, height }
}

/// A triangle with sides 3, 5, 4 and frames in whole numbers. The rounded gaps are within their bounds of the squared
/// distances over the rationals.
#[test]
fn gaps_are_squared_distances_over_the_rationals() {
    let points = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let triangle = CertifiedTriangle::of(points.map(|p| p.map(Real::point)));
    let sides = BaseSides::of(&triangle);
    let mut rng = Rng::new(5);
    let mut closest = 0.0_f64;
    for _ in 0..200 {
        let mut draw = || rng.uniform(6.0, 30.0);
        let s = [draw(), draw(), draw(), draw(), draw(), draw()];
        let d = [draw(), draw(), draw()];
        let u = [0, 1, 2].map(|_| rng.uniform(0.001, 20.0));
        let ends = [
            corner([0, 0], [(1, 1), (0, 1)], 3, [s[0], s[1]], u[0]),
            corner([3, 0], [(-3, 5), (4, 5)], 5, [s[2], s[3]], u[1]),
            corner([0, 4], [(0, 1), (-1, 1)], 4, [s[4], s[5]], u[2]),
        ];
        let circles = sides.circles(&s.map(Real::point));
        let gaps = sides.gaps(&circles, d.map(Real::point));
        let corners = [0, 1, 2].map(|k| {
            let u = ComplexBatch::real(u[k]);
            [u, u.reciprocal().times(circles[k].squared_radius.centre)]
        });
        for k in 0..3 {
            let l = (k + 1) % 3;
            let (p, q) = (&ends[k], &ends[l]);
            let square = |x: Exact| &x * &x;
            let truth = square(&p.place[0] - &q.place[0]) + square(&p.place[1] - &q.place[1])
                - square(&p.height - &q.height)
                - exact(d[k]);
            let loose = [k, l].map(|i| {
                let rho = circles[i].squared_radius;
                rho.radius / (rho.centre.abs() - rho.radius) * UP + 16.0 * U
            });
            let moduli = [(k, 0), (l, 1)].map(|(i, n)| moduli_of(&corners[i], loose[n]));
            let [error, _] = gaps[k].errors(&moduli[0], &moduli[1], loose);
            let [value, first, second] = gaps[k].rounded(&corners[k], &corners[l]);
            let off = truth - exact(value.re[0]);
            let off = if off < exact(0.0) { -off } else { off };
            assert!(off <= exact(error.0[0]) && value.im[0] == 0.0, "{} +- {:e}", value.re[0], error.0[0]);
            // and the bound is one of rounding errors
            let size = moduli.iter().flatten().map(|m| m.0[0]).fold(10.0, f64::max);
            assert!(error.0[0] < 1e-12 * size * size, "{:e}", error.0[0]);
            closest = closest.max(num_traits::ToPrimitive::to_f64(&off).unwrap() / error.0[0]);
            // derivatives against differences
            let step: f64 = 1e-6;
            let at = |t: f64, w: f64| {
                let turn = |[u, v]: OnCircle, t: f64| [u.times(t.exp()), v.times((-t).exp())];
                gaps[k].rounded(&turn(corners[k], t), &turn(corners[l], w))[0].re[0]
            };
            let slope = |t: f64, w: f64| (at(t, w) - at(-t, -w)) / (2.0 * step);
            for (derivative, expected) in [(first, slope(step, 0.0)), (second, slope(0.0, step))] {
                assert!((derivative.re[0] - expected).abs() < 1e-7 * size * size, "{expected}");
            }
        }
    }
    // the bound is not a hundred times too wide
    assert!(closest > 0.01, "{closest}");
}

/// Second derivatives within the reach stay below twice `q`, for corners of any kind.
#[test]
fn the_curvature_is_a_bound() {
    let triangle = CertifiedTriangle::of(
        [[0.0, 0.0, 0.0], [2.0, 0.1, 0.0], [0.4, 1.5, 0.3]].map(|p| p.map(Real::point)),
    );
    let sides = BaseSides::of(&triangle);
    let mut rng = Rng::new(6);
    let mut closest = 0.0_f64;
    for _ in 0..100 {
        let s = [0, 1, 2, 3, 4, 5].map(|_| Real::point(rng.uniform(2.0, 9.0)));
        let circles = sides.circles(&s);
        let gaps = sides.gaps(&circles, [Real::point(1.0); 3]);
        let mut corner = |k: usize| {
            let (re, im) = (rng.normal() * 3.0, rng.normal() * 3.0);
            let u = ComplexBatch { re: [re; LANES], im: [im; LANES] };
            [u, u.reciprocal().times(circles[k].squared_radius.centre)]
        };
        let (p, q) = (corner(0), corner(1));
        let [_, bend] = gaps[0].errors(&moduli_of(&p, 0.0), &moduli_of(&q, 0.0), [0.0; 2]);
        let mut angle = || {
            let turn = rng.uniform(0.0, std::f64::consts::TAU);
            num_complex::Complex64::from_polar(REACH, turn)
        };
        for _ in 0..20 {
            let (at, way) = ([angle(), angle()], [angle() / REACH, angle() / REACH]);
            let step = 1e-4;
            let value = |n: f64| {
                let turn = |[u, v]: OnCircle, t: num_complex::Complex64| {
                    let lanes =
                        |z: num_complex::Complex64| ComplexBatch { re: [z.re; LANES], im: [z.im; LANES] };
                    [u * lanes(t.exp()), v * lanes((-t).exp())]
                };
                let moved = [0, 1].map(|i| at[i] + way[i] * (n * step));
                gaps[0].rounded(&turn(p, moved[0]), &turn(q, moved[1]))[0].lane(0)
            };
            let second = (value(1.0) - value(0.0) * 2.0 + value(-1.0)) / (step * step);
            let ratio = second.norm() / (2.0 * bend.0[0]);
            assert!(ratio <= 1.0 + 1e-5, "{ratio}");
            closest = closest.max(ratio);
        }
    }
    assert!(closest > 0.3, "{closest}");
}

/// A squared radius known to one part in fifty only: the bounds hold for both of its ends.
#[test]
fn moduli_are_bounds_for_every_squared_radius() {
    let (rho, part) = (2.0, 0.02);
    let u = ComplexBatch { re: [0.7; LANES], im: [-1.9; LANES] };
    let [of_u, of_v] = moduli_of(&[u, u.reciprocal().times(rho)], part);
    let modulus = 0.7_f64.hypot(1.9);
    for end in [rho * (1.0 - part), rho * (1.0 + part)] {
        assert!(of_u.0[0] >= modulus && of_v.0[0] >= end / modulus, "{of_v:?}");
    }
    assert!(of_v.0[0] < 1.001 * rho * (1.0 + part) / modulus);
}

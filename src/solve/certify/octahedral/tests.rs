use super::*;
use crate::num::Rng;
use num_rational::BigRational;

type Exact = BigRational;

fn exact(x: f64) -> Exact {
    BigRational::from_float(x).unwrap()
}

/// Cayley-Menger determinant of squared distances, by fraction-free elimination over the rationals.
fn cayley_menger(d: &[[Exact; 5]; 5]) -> Exact {
    let zero = || exact(0.0);
    let mut m: Vec<Vec<Exact>> = (0..6)
        .map(|i| {
            (0..6)
                .map(|j| match (i, j) {
                    (0, 0) => zero(),
                    (0, _) | (_, 0) => exact(1.0),
                    _ => d[i - 1][j - 1].clone(),
                })
                .collect()
        })
        .collect();
    let mut det = exact(1.0);
    for c in 0..6 {
        let Some(p) = (c..6).find(|&i| m[i][c] != zero()) else { return zero() };
        if p != c {
            m.swap(p, c);
            det = -det;
        }
        det *= m[c][c].clone();
        for i in c + 1..6 {
            let factor = &m[i][c] / &m[c][c];
            for j in c..6 {
                let term = &factor * &m[c][j];
                m[i][j] -= term;
            }
        }
    }
    det
}

/// The closure is `-D/8`... of the determinant up to the factor `8 / D`, exactly: the enclosures hold the rational values.
#[test]
fn closures_enclose_the_cayley_menger_determinant_over_the_rationals() {
    let mut rng = Rng::new(5);
    for _ in 0..20 {
        let corner = |rng: &mut Rng| [rng.normal(), rng.normal(), rng.normal()];
        let p = [corner(&mut rng), corner(&mut rng), corner(&mut rng)];
        let t = Triangle::of(p.map(|corner| corner.map(Real::point)));
        let mut draw = || rng.uniform(0.5, 3.0);
        let (u, v, d) = ([draw(), draw()], [draw(), draw()], draw());
        let closure = ClosureCoefficients::new(&t, u.map(Real::point), v.map(Real::point), Real::point(d));
        let (x, y) = (rng.uniform(0.5, 3.0), rng.uniform(0.5, 3.0));
        let point = |z: f64| Discs::point(ComplexBatch::real(z));
        let values = closure.values(point(x), point(y));
        let side = |i: usize, j: usize| -> Exact {
            (0..3).map(|k| exact(p[i][k]) - exact(p[j][k])).map(|z| &z * &z).sum()
        };
        let to_u = [exact(x), exact(u[0]), exact(u[1])];
        let to_v = [exact(v[0]), exact(v[1]), exact(y)];
        let entry = |i: usize, j: usize| -> Exact {
            match (i.min(j), i.max(j)) {
                (a, b) if a == b => exact(0.0),
                (3, 4) => exact(d),
                (a, 3) => to_u[a].clone(),
                (a, 4) => to_v[a].clone(),
                (a, b) => side(a, b),
            }
        };
        let distances: [[Exact; 5]; 5] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        // in an affine basis with Gram determinant D = |b x c|^2: CM = -16 (h_u h_v - (U_h V_h)^2) D and F = D^2 (..)
        let (bb, cc) = (side(1, 0), side(2, 0));
        let bc: Exact =
            (0..3).map(|k| (exact(p[1][k]) - exact(p[0][k])) * (exact(p[2][k]) - exact(p[0][k]))).sum();
        let area = &bb * &cc - &bc * &bc;
        let expected = cayley_menger(&distances) * &area / exact(16.0);
        let f = &values.f;
        let gap = expected - exact(f.c.re[0]);
        let gap = if gap < exact(0.0) { -gap } else { gap };
        assert!(gap <= exact(f.r.0[0]), "{} +- {:e}", f.c.re[0], f.r.0[0]);
        let largest = f.c.re[0].abs().max(1.0) * (1.0 + x * x * y * y) * 1e4;
        assert!(f.r.0[0] < 1e-12 * largest, "{} +- {:e}", f.c.re[0], f.r.0[0]);
        // derivatives against differences of the closure
        let h = 1e-6;
        let slope = |a: f64, b: f64| {
            let at = |x: f64, y: f64| closure.values(point(x), point(y)).f.c.re[0];
            (at(x + a * h, y + b * h) - at(x - a * h, y - b * h)) / (2.0 * h)
        };
        let scale = 1.0 + values.fx.c.re[0].abs() + values.fy.c.re[0].abs();
        assert!((values.fx.c.re[0] - slope(1.0, 0.0)).abs() < 1e-5 * scale);
        assert!((values.fy.c.re[0] - slope(0.0, 1.0)).abs() < 1e-5 * scale);
    }
}

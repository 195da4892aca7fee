//! The number of poses if tips and platform joints have three-fold symmetry.
//!
//! `docs/theory/rotary.md` has the theorem and its proof.

use nalgebra::{Complex, Point3, Vector3};

use super::RotaryPlatform;

/// Joints within this share of the size of symmetric places count as symmetric: a hundred times the rounding of sines
/// and cosines.
const SYMMETRIC: f64 = 1e-13;
/// The theorem applies if each number that must not vanish is at least this, as a share of the size to its power.
const CLEAR: f64 = 1e-6;

/// Number of poses by the theorem.
const POSES: usize = 28;

/// The quantities of the theorem: radii of both hexagons, and half the angles between two legs that no rotation
/// exchanges.
struct Hexagons {
    radii: [f64; 2],
    half_angles: [f64; 2],
}

impl RotaryPlatform {
    /// The number of finite poses, complex ones included, of the platform with three-fold symmetry nearest to the tips
    /// and joints at these angles. `None` without this symmetry within rounding, or too near to a platform with another
    /// number.
    ///
    /// Tips at one height and joints at one height are two hexagons with equal rods. A third of a turn about the z axis
    /// maps each hexagon, with the legs, to itself. The tips as doubles are symmetric to rounding only, and can have
    /// more finite poses than the symmetric ones. Their existence then depends on the rounding, and they are very far
    /// away.
    #[must_use]
    pub fn symmetric_pose_count(&self, angles: &[f64; 6]) -> Option<usize> {
        let tips: [Point3<f64>; 6] = std::array::from_fn(|i| self.tip(i, angles[i]));
        let joints = self.legs.map(|leg| leg.platform);
        let rods = self.rods.get();
        let size = tips.iter().chain(&joints).map(|p| p.coords.norm()).chain(rods).fold(0.0, f64::max);
        let near = |a: f64, b: f64| (a - b).abs() <= SYMMETRIC * size;
        if !rods.iter().all(|l| near(*l, rods[0])) {
            return None;
        }
        let found = hexagons([&tips, &joints], &near)?;
        let ([a, b], [alpha, beta], l) = (found.radii, found.half_angles, rods[0]);
        let sine = (alpha - beta).sin();
        let (k1, k2) =
            (b * (alpha + 2.0 * beta).sin() / (2.0 * sine), a * (2.0 * alpha + beta).sin() / (2.0 * sine));
        let (c, k) = (a * b * (alpha - beta).cos(), a * a + b * b - l * l);
        let lead = 2.0 * c - 4.0 * k1 * k2;
        let (sum, difference) = (k1 + k2, k2 - k1);
        // both quadratics, of e0^2 and of e3^2
        let quadratics = [
            [lead, -k - 4.0 * k1 * k1 + 4.0 * k1 * sum + sum * sum, -sum * sum],
            [
                -lead,
                -k - 4.0 * k1 * k1 - 4.0 * k1 * difference + difference * difference,
                -difference * difference,
            ],
        ];
        let discriminants = quadratics.map(|[x, y, z]| (y * y - 4.0 * x * z) / size.powi(4));
        let squares = [lead, 2.0 * c - k, -2.0 * c - k].map(|x| x / (size * size));
        let clear = [sine, sum / size, difference / size].into_iter().chain(discriminants).chain(squares);
        // a comparison with NaN is false
        clear.into_iter().all(|x| x.abs() >= CLEAR).then_some(POSES)
    }
}

/// Both hexagons about the z axes through their centroids; `None` if the bodies are no such hexagons.
fn hexagons(bodies: [&[Point3<f64>; 6]; 2], near: &dyn Fn(f64, f64) -> bool) -> Option<Hexagons> {
    let flat = bodies.map(|points| {
        let centroid = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 6.0;
        let level = points.iter().all(|p| near(p.z, centroid.z));
        level.then(|| points.map(|p| Complex::new(p.x - centroid.x, p.y - centroid.y)))
    });
    let [Some(tips), Some(joints)] = flat else { return None };
    let third = Complex::from_polar(1.0, std::f64::consts::TAU / 3.0);
    let equal = |x: Complex<f64>, y: Complex<f64>| near(x.re, y.re) && near(x.im, y.im);
    let turned =
        |i: usize| (0..6).find(|&j| equal(tips[j], tips[i] * third) && equal(joints[j], joints[i] * third));
    let image: [Option<usize>; 6] = std::array::from_fn(turned);
    let first = [Some(0), image[0], image[0].and_then(|j| image[j])];
    let other = (0..6).find(|i| !first.contains(&Some(*i)))?;
    let same = |points: &[Complex<f64>; 6]| near(points[0].norm(), points[other].norm());
    if image.contains(&None) || !same(&tips) || !same(&joints) {
        return None;
    }
    // a rotation between the mirror planes of the bodies about z does not change the number of poses
    let half = |points: &[Complex<f64>; 6]| 0.5 * (points[0].arg() - points[other].arg());
    Some(Hexagons { radii: [tips[0].norm(), joints[0].norm()], half_angles: [half(&tips), half(&joints)] })
}

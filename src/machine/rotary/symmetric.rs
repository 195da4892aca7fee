//! How many poses there are where tips and platform joints have the symmetry of three turns.
//!
//! `docs/theory/rotary.md` has the theorem and its proof.

use nalgebra::{Complex, Point3, Vector3};

use super::RotaryPlatform;

/// Joints count as symmetric where they are off by less than this share of the size: a hundred times what sines and
/// cosines round.
const SYMMETRIC: f64 = 1e-13;
/// The theorem is used where each number that must not be zero is at least this, as a share of the size to its power.
const CLEAR: f64 = 1e-6;

/// Poses of the theorem.
const POSES: usize = 28;

/// What the theorem takes: radii of both hexagons and half the angles between two legs that are no turned images of
/// each other.
struct Hexagons {
    radii: [f64; 2],
    half_angles: [f64; 2],
}

impl RotaryPlatform {
    /// The number of finite poses, complex ones included, of the platform whose tips and joints are the exactly
    /// symmetric ones nearest to those at these angles; `None` where they are not symmetric to rounding, or too near to
    /// where the number is another one.
    ///
    /// Tips at one height and joints at one height are two hexagons, each kept by a third of a turn about the z axis
    /// together with the legs; rods are equally long. The tips as doubles are symmetric to rounding only, and can have
    /// more finite poses than the symmetric ones: these are so far out that the rounding decides whether there are any.
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

/// Both hexagons about the z axes through their centroids; `None` where they are none.
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
    // that the mirror planes of both bodies differ by a turn about z changes no number of poses
    let half = |points: &[Complex<f64>; 6]| 0.5 * (points[0].arg() - points[other].arg());
    Some(Hexagons { radii: [tips[0].norm(), joints[0].norm()], half_angles: [half(&tips), half(&joints)] })
}

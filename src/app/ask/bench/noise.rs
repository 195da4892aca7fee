//! Displacements of poses for leg lengths with errors: Martyushev (2025), sec. 5.2 and Fig. 4.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::Class;
use super::generator::{LengthsFrom, NotDrawn, problem};
use super::run::RunError;
use super::statistics::quantile;
use fk::{FkOptions, FkSolutions, ForwardKinematics, PoseCounting, Reality, Threads, in_order};
use num::Rng;
use platform::geom::{Pose, turn_between};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Default standard deviations of the relative error of a leg length; the published figure ends at `8e-4`.
pub const NOISE_LEVELS: [f64; 16] =
    [0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 2e-4, 4e-4, 8e-4, 1e-3, 1e-2, 1e-1];

/// Seed offset that separates poses and errors from the joints of the same problem.
const APART: u64 = 0x0015_e000;

/// The plan of a noise run.
#[derive(Debug, Clone, PartialEq)]
pub struct NoisePlan {
    /// Class of the platforms.
    pub class: Class,
    /// Number of platforms, each with one pose and one direction of errors for all levels.
    pub count: u64,
    /// Seed of platforms, poses, errors, and of the solver's generic constants.
    pub seed: u64,
    /// Number of threads.
    pub threads: Threads,
    /// Standard deviations of the relative errors of the leg lengths.
    pub levels: Vec<f64>,
}

/// The distribution of angles over problems, radians.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "SpreadRecord", transform = num::nullable))]
pub struct Spread {
    /// The lower quartile.
    pub lower_quartile: f64,
    /// The median.
    pub median: f64,
    /// The upper quartile.
    pub upper_quartile: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The maximum.
    pub max: f64,
}

/// The effect of one level of noise.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "NoiseLevelRecord", transform = num::nullable))]
pub struct NoiseLevel {
    // the statistics are over the problems that have a real pose
    /// Relative error of the lengths.
    pub sigma: f64,
    /// Number of problems without real pose.
    // here two real poses met and became complex
    #[cfg_attr(feature = "files", serde(rename = "without_real_pose"))]
    pub without_pose: u64,
    /// Rotation angle to the nearest real pose, radians; null: no problem has one.
    #[cfg_attr(feature = "files", serde(rename = "rotation_rad"))]
    pub rotation: Option<Spread>,
    /// Angle between the position vectors, radians.
    #[cfg_attr(feature = "files", serde(rename = "position_rad"))]
    pub position: Option<Spread>,
}

/// Errors `(rotation, position)` of one problem at one level, radians.
type Errors = Option<(f64, f64)>;

fn vector_angle(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// The least errors over the real poses; rotation and position are minimised separately, as published.
fn errors(found: &FkSolutions, truth: &Pose) -> Errors {
    let real = found.roots.iter().filter(|r| r.reality == Reality::Real).map(|root| {
        let found = root.pose.real_part();
        let turn = turn_between(&truth.rotation, &found.rotation).norm();
        (turn, vector_angle(&truth.position, &found.position))
    });
    real.reduce(|best, next| (best.0.min(next.0), best.1.min(next.1)))
}

/// A pose with standard normal Cayley vector and position, and six standard normal numbers.
fn draw(class: Class, seed: u64, k: u64) -> Result<(Manipulator, Pose, [f64; 6]), NotDrawn> {
    let manipulator = problem(class, LengthsFrom::Pose, seed, k)?.manipulator;
    let mut rng = Rng::stream(seed ^ class.stream() ^ APART, k);
    let cayley = Quaternion::new(1.0, rng.normal(), rng.normal(), rng.normal());
    let rotation = UnitQuaternion::from_quaternion(cayley).to_rotation_matrix();
    let position = Vector3::from_fn(|_, _| rng.normal());
    Ok((manipulator, Pose { rotation, position }, std::array::from_fn(|_| rng.normal())))
}

/// The disturbed squared lengths `s_i (1 + sigma n_i)^2`.
fn disturbed(s: &SquaredLegLengths, sigma: f64, n: &[f64; 6]) -> Option<SquaredLegLengths> {
    let s = s.get();
    SquaredLegLengths::try_new(std::array::from_fn(|i| s[i] * (1.0 + sigma * n[i]).powi(2))).ok()
}

fn one(plan: &NoisePlan, solver: &dyn ForwardKinematics, k: u64) -> Result<Vec<Errors>, NotDrawn> {
    let (m, truth, n) = draw(plan.class, plan.seed, k)?;
    let exact = truth.squared_lengths(&m).ok_or(NotDrawn::Lengths)?;
    let options = FkOptions::new().seed(plan.seed).pose_count(PoseCounting::Never);
    let at = |sigma: &f64| {
        let s = disturbed(&exact, *sigma, &n)?;
        errors(&solver.solve(&m, &s, &options).ok()?, &truth)
    };
    Ok(plan.levels.iter().map(at).collect())
}

fn spread(values: &[f64]) -> Option<Spread> {
    let at = |q: f64| quantile(values.iter().copied(), q);
    (!values.is_empty()).then(|| Spread {
        lower_quartile: at(0.25),
        median: at(0.5),
        upper_quartile: at(0.75),
        p99: at(0.99),
        max: at(1.0),
    })
}

/// Disturbs the leg lengths of random poses and measures the distance of the nearest real pose from the true one.
///
/// Platforms come from [`problem`]; position and Cayley vector of the pose are standard normal. Squared lengths are
/// `s_i (1 + sigma n_i)^2` with standard normal `n_i`, and errors follow eqs. (20) and (21) of Martyushev (2025).
/// Unlike there, all levels share platforms, poses and `n_i`, so that levels differ only by the noise.
///
/// # Errors
/// [`RunError::NotDrawn`].
pub fn noise(plan: &NoisePlan, solver: &dyn ForwardKinematics) -> Result<Vec<NoiseLevel>, RunError> {
    let count = usize::try_from(plan.count).unwrap_or(usize::MAX);
    let outcomes = in_order(count, plan.threads, &|i| {
        let k = i as u64;
        one(plan, solver, k).map_err(|why| RunError::NotDrawn { k, why })
    });
    let outcomes = outcomes.into_iter().collect::<Result<Vec<_>, _>>()?;
    let level = |(i, sigma): (usize, &f64)| {
        let (rotation, position): (Vec<f64>, Vec<f64>) = outcomes.iter().filter_map(|o| o[i]).unzip();
        NoiseLevel {
            sigma: *sigma,
            without_pose: (outcomes.len() - rotation.len()) as u64,
            rotation: spread(&rotation),
            position: spread(&position),
        }
    };
    Ok(plan.levels.iter().enumerate().map(level).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use fk::Homotopy;

    #[test]
    fn angles_of_vectors_keep_their_digits_near_zero() {
        assert!((vector_angle(&Vector3::x(), &Vector3::new(1.0, 1e-12, 0.0)) - 1e-12).abs() < 1e-24);
    }

    #[test]
    fn errors_vanish_without_noise_and_grow_in_proportion_to_it() {
        let levels = vec![0.0, 1e-10, 1e-8, 1e-6];
        let plan = NoisePlan { class: Class::General, count: 6, seed: 1, threads: Threads::All, levels };
        let found = noise(&plan, &Homotopy).unwrap();
        assert!(found.iter().all(|l| l.without_pose == 0));
        for of in [|l: &NoiseLevel| l.rotation.unwrap(), |l: &NoiseLevel| l.position.unwrap()] {
            assert!(of(&found[0]).max < 1e-12, "{:?}", found[0]);
            for pair in found[1..].windows(2) {
                let ratio = of(&pair[1]).median / of(&pair[0]).median;
                assert!((ratio - 100.0).abs() < 3.0, "{ratio}");
            }
        }
    }
}

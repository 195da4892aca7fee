//! Poses whose numbers may be expressions, in any convention, without rounding.

use super::failure::Failure;
use super::numbers;
use super::poses::FORM;
use ask::{Design, PoseFrames};
use files::design::Share;
use num::exact::Rational;
use num::surd::Surd;
use platform::geom::{AngleUnit, ListedFrom, Pose, PoseConvention, RotationOrder, TurnAxes, UpAxis};
use synthesis::singularity::ExactPose;

/// An exact pose: `home`, or six or seven numbers, which may be expressions; the quaternion has any norm but zero.
/// Angles whose halves have no exact cosines are those of the nearest doubles.
///
/// # Errors
/// Exit 2 with the code given.
pub(crate) fn read(
    text: &str,
    (design, frames): (&Design, &PoseFrames),
    option: &str,
    code: &str,
) -> Result<ExactPose, Failure> {
    let refuse = |message: String| Failure::refused(code, format!("{option}: {message}")).with_help(FORM);
    if text == "home" {
        return Ok(home(design));
    }
    let (convention, text) = frames.convention_of(text);
    let count = text.split(',').count();
    if count > 7 {
        // the entries of a matrix are decimals, and a rotation within their rounding
        let found = convention.read_text(text, &frames.home);
        return found.map(|pose| of_doubles(&pose)).map_err(|why| refuse(why.to_string()));
    }
    let (position, rotation) = if count == 7 {
        let [x, y, z, quaternion @ ..] = numbers::exact::<7>(text).map_err(refuse)?;
        if quaternion.iter().all(Surd::is_zero) {
            return Err(refuse("the quaternion is zero".to_owned()));
        }
        ([x, y, z], Some(convention.quaternion_order().scalar_first(quaternion)))
    } else {
        let [x, y, z, angles @ ..] = numbers::exact::<6>(text).map_err(refuse)?;
        ([x, y, z], quaternion_of(&convention, &angles))
    };
    let exact =
        rotation.and_then(|quaternion| placed(&convention, ExactPose { position, quaternion }, design));
    if let Some(pose) = exact {
        Ok(pose)
    } else {
        let number = |field: &str| numbers::one(field).unwrap_or(f64::NAN);
        let values: Vec<f64> = text.split(',').map(number).collect();
        let found = convention.read(&values, &frames.home);
        found.map(|pose| of_doubles(&pose)).map_err(|why| refuse(why.to_string()))
    }
}

/// The home pose of the design, exactly where it is.
fn home(design: &Design) -> ExactPose {
    let doubles = of_doubles(&design.home_or_default());
    let Some((position, angles)) = design.exact_home() else { return doubles };
    let usual = PoseConvention::default();
    let quaternion = angles.and_then(|angles| quaternion_of(&usual, &angles));
    ExactPose { position, quaternion: quaternion.unwrap_or(doubles.quaternion) }
}

fn of_doubles(pose: &Pose) -> ExactPose {
    let exact = |x: f64| Share::shortest(x).and_then(|x| x.exact().cloned()).unwrap_or_else(Surd::zero);
    let p = pose.position;
    ExactPose { position: [p.x, p.y, p.z].map(exact), quaternion: pose.quaternion().map(exact) }
}

/// The quaternion of three angles as they are written; `None` where it has no exact one.
fn quaternion_of(convention: &PoseConvention, angles: &[Surd; 3]) -> Option<[Surd; 4]> {
    if convention.angle_unit() == AngleUnit::Radians && !angles.iter().all(Surd::is_zero) {
        return None;
    }
    let about = |axis: usize, angle: &Surd| -> Option<[Surd; 4]> {
        let (cos, sin) = Surd::turn(&(angle.as_rational()? / Rational::from_integer(2.into())))?;
        let mut out = [cos, Surd::zero(), Surd::zero(), Surd::zero()];
        out[axis + 1] = sin;
        Some(out)
    };
    match convention.order() {
        RotationOrder::Turns(axes, order) => {
            let one = |k: usize| about(order[k].index(), &angles[k]);
            let [first, second, third] = [one(0)?, one(1)?, one(2)?];
            match axes {
                TurnAxes::Moving => product(&product(&first, &second)?, &third),
                TurnAxes::Fixed => product(&product(&third, &second)?, &first),
            }
        }
        // about one axis of the frame a rotation vector is an angle
        RotationOrder::Vector => {
            let turned: Vec<usize> = (0..3).filter(|k| !angles[*k].is_zero()).collect();
            match turned[..] {
                [] => about(0, &Surd::zero()),
                [axis] => about(axis, &angles[axis]),
                _ => None,
            }
        }
    }
}

/// The pose in the base frame of one in the frames of the convention, as [`PoseConvention::in_base_frame`].
fn placed(convention: &PoseConvention, written: ExactPose, design: &Design) -> Option<ExactPose> {
    let ExactPose { position: [x, y, z], quaternion: [w, i, j, k] } = written;
    let (mut position, mut quaternion) = match convention.up_axis() {
        UpAxis::Z => ([x, y, z], [w, i, j, k]),
        UpAxis::Y => ([x, z.negated(), y], [w, i, k.negated(), j]),
    };
    let home = (convention.measured_from() == ListedFrom::Home).then(|| self::home(design));
    let plus = |a: &[Surd; 3], b: &[Surd; 3]| -> Option<[Surd; 3]> {
        Some([a[0].plus(&b[0])?, a[1].plus(&b[1])?, a[2].plus(&b[2])?])
    };
    if let Some(home) = &home {
        position = plus(&position, &home.position)?;
        quaternion = product(&quaternion, &home.quaternion)?;
    }
    if convention.pivot.is_some() {
        let pivot = convention.pivot_on_platform();
        let pivot = of_doubles(&Pose { position: pivot, rotation: nalgebra::Rotation3::identity() }).position;
        position = plus(&position, &rotated(&quaternion, &pivot)?.map(|x| x.negated()))?;
        if let Some(home) = &home {
            position = plus(&position, &rotated(&home.quaternion, &pivot)?)?;
        }
    }
    Some(ExactPose { position, quaternion })
}

/// The product of two quaternions, scalar first.
fn product(p: &[Surd; 4], q: &[Surd; 4]) -> Option<[Surd; 4]> {
    // the sign and the factors of each of the four products of a part
    const PARTS: [[(bool, usize, usize); 4]; 4] = [
        [(true, 0, 0), (false, 1, 1), (false, 2, 2), (false, 3, 3)],
        [(true, 0, 1), (true, 1, 0), (true, 2, 3), (false, 3, 2)],
        [(true, 0, 2), (true, 2, 0), (true, 3, 1), (false, 1, 3)],
        [(true, 0, 3), (true, 3, 0), (true, 1, 2), (false, 2, 1)],
    ];
    let part = |terms: &[(bool, usize, usize); 4]| {
        terms.iter().try_fold(Surd::zero(), |sum, (adds, i, j)| {
            let term = p[*i].times(&q[*j])?;
            if *adds { sum.plus(&term) } else { sum.minus(&term) }
        })
    };
    let [w, x, y, z] = PARTS.each_ref().map(part);
    Some([w?, x?, y?, z?])
}

/// A vector turned by a quaternion of any norm but zero.
fn rotated(q: &[Surd; 4], v: &[Surd; 3]) -> Option<[Surd; 3]> {
    let [w, x, y, z] = q;
    let [a, b, c] = v.clone();
    let conjugate = [w.clone(), x.negated(), y.negated(), z.negated()];
    let [_, i, j, k] = product(&product(q, &[Surd::zero(), a, b, c])?, &conjugate)?;
    let norm = num::surd::combination(q, q)?.inverse()?;
    Some([i.times(&norm)?, j.times(&norm)?, k.times(&norm)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Quaternion, UnitQuaternion};
    use platform::geom::QuaternionOrder;

    const DESIGN: &str = include_str!("../../../designs/rbt-octahedral.toml");

    fn doubles(exact: &ExactPose) -> Pose {
        let [w, x, y, z] = exact.quaternion.each_ref().map(Surd::nearest);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        Pose { rotation, position: exact.position.each_ref().map(Surd::nearest).into() }
    }

    #[test]
    fn exact_poses_are_those_of_doubles_in_every_convention() {
        let text = format!("{DESIGN}\n[home]\nposition = [1.0, 2.0, 9.0]\nrpy_deg = [0.0, 0.0, 30.0]\n");
        let (design, _) = ask::design::parse(&text, files::design::Format::Toml)
            .or_else(|_| ask::design::parse(DESIGN, files::design::Format::Toml))
            .unwrap();
        for (k, order) in RotationOrder::all().into_iter().enumerate() {
            let convention = PoseConvention {
                rotation_order: Some(order),
                quaternion: Some(QuaternionOrder::ALL[k % 2]),
                pivot: Some(nalgebra::Vector3::new(0.5, -1.0, 2.0)),
                relative_to: Some([ListedFrom::Home, ListedFrom::Base][(k / 2) % 2]),
                up: Some(UpAxis::ALL[k % 2]),
                angles: None,
            };
            let frames = design.pose_frames(convention);
            let angles = if order == RotationOrder::Vector { "0,0,120" } else { "30,90,-120" };
            for numbers in [format!("1/2,3,4,{angles}"), "1/2,3,4,0.5,0.5,0.5,0.5".to_owned()] {
                let found = read(&numbers, (&design, &frames), "--pose", "x").unwrap();
                let meant = frames.read(&numbers.replace("1/2", "0.5")).unwrap();
                let off = (doubles(&found).rotation.matrix() - meant.rotation.matrix()).amax();
                assert!(off < 1e-14, "{order} {numbers}: {off:e}");
                assert!((doubles(&found).position - meant.position).amax() < 1e-13, "{order} {numbers}");
            }
            // the half of 30 degrees has square roots, which are kept
            let angle = if order == RotationOrder::Vector { "0,0,30" } else { "30,0,0" };
            let own = design.pose_frames(PoseConvention { relative_to: None, ..convention });
            let exact = read(&format!("1/3,0,0,{angle}"), (&design, &own), "--pose", "x").unwrap();
            assert!(exact.quaternion.iter().any(|x| x.as_rational().is_none()), "{order}");
        }
    }
}

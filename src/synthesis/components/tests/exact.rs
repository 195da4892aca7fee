//! Families that exact arithmetic confirms or denies.

use super::*;

/// Two families over the ends `(sqrt 2, ..)` and `(-sqrt 2, ..)` of a base line, with conjugate platform lines through a common joint.
#[test]
fn conjugate_lines_without_joints_are_exact() {
    let base = [(0, 0), (3, 0), (3, 3), (-3, 3), (-2, 1), (1, 2)];
    let platform = [(0, 0), (0, 0), (1, -3), (-3, -3), (3, -3), (0, -3)];
    let at = |p: (i32, i32)| Point3::new(f64::from(p.0), f64::from(p.1), 0.0);
    let legs: [Leg; 6] = std::array::from_fn(|k| Leg { base: at(base[k]), platform: at(platform[k]) });
    let c = found(&legs);
    let kinds =
        |curve: &PlaneCurve| curve.exact.as_ref().unwrap().parts.iter().map(|p| p.kind).collect::<Vec<_>>();
    assert_eq!(kinds(&c.planes[0].platform), [ExactKind::Line, ExactKind::RealLines]);
    assert_eq!(kinds(&c.planes[0].base), [ExactKind::Line, ExactKind::Conic]);
    let over_no_joints: Vec<&Component> =
        c.components.iter().filter(|x| x.legs.is_empty() && x.type_name() == "point-line").collect();
    assert_eq!(over_no_joints.len(), 2, "{:?}", list(&c));
    assert!(c.components.iter().all(|x| x.exact == Some(true)), "{:?}", list(&c));
    assert!(c.doubts.is_empty(), "{:?}", c.doubts);
    check_samples(&c, 1e-9);
}

#[test]
fn conics_are_exact_or_denied() {
    let t = [-1.25, -0.75, -0.25, 0.5, 1.0, 1.5];
    let mut legs = design(3, 3, 0, &mut Rng::new(10));
    for (leg, t) in legs.iter_mut().zip(&t[..5]) {
        leg.base = Point3::new(*t, t * t, 0.0);
        leg.platform = Point3::new(2.0 * t + t * t, t - 3.0 * t * t, 0.5);
    }
    one_exactly(&found(&legs), "over_conic", "plane-plane", 1, &[1, 2, 3, 4, 5]);
    let mut twisted = legs;
    for (leg, t) in twisted.iter_mut().zip(&t) {
        leg.base = Point3::new(*t, t * t, 0.5 * t);
        leg.platform = Point3::new(*t, t * t, t * t * t);
    }
    one_exactly(&found(&twisted), "over_conic", "plane-space", 1, &[1, 2, 3, 4, 5, 6]);
    // spoilt beyond rounding and below the tolerance
    legs[4].platform.x += 1e-12;
    let c = found(&legs);
    assert_eq!(list(&c).len(), 1);
    assert_eq!(c.components[0].exact, Some(false));
}

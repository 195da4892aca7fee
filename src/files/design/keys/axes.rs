//! `"normal"` among the axes of joints: the normal of the plane of the joints of a body, from base to platform.

use nalgebra::{Unit, Vector3};

use super::hardware::is_normal;
use super::joint_models::check_axes;
use crate::design::DesignModel;
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{JointAxes, plate_normal};
use platform::manipulator::Body;

/// Replaces named normals by vectors, and checks the axes of universal joints again.
pub(super) fn turn_to_normals(report: &mut Findings<'_>, top: &[Entry], design: &mut DesignModel) {
    let Some(Value::Table(hardware)) = find(top, "hardware").map(|e| &e.node.value) else { return };
    for body in Body::BOTH {
        let Some(entry) = find(hardware, body.of(("base_axes", "platform_axes"))) else { continue };
        let named = named(&entry.node);
        if !named.contains(&true) {
            continue;
        }
        let normal = normal(design, body);
        let turned = |axes: &mut JointAxes| {
            if let JointAxes::Given(axes) = axes {
                axes.iter_mut().zip(named).filter(|(_, is)| *is).for_each(|(axis, _)| *axis = normal);
            }
        };
        let h = &mut design.hardware;
        let cone_angle = body.of((&mut h.base_cone_angle, &mut h.platform_cone_angle));
        cone_angle.as_mut().map(|s| &mut s.axes).map(turned);
        let universal = body.of((&mut h.base_universal, &mut h.platform_universal));
        if let Some(joint) = universal {
            turned(&mut joint.axes);
            let joint = *joint;
            check_axes(report, entry, joint.axes, &joint);
        }
    }
}

/// Flags of the axes given by this name.
pub(super) fn named(node: &Node) -> [bool; 6] {
    match &node.value {
        Value::Array(list) => std::array::from_fn(|i| list.get(i).is_some_and(is_normal)),
        _ => [is_normal(node); 6],
    }
}

/// The normal of the greatest triangle of the joints: on the base towards the platform at home, on the platform away
/// from the base.
fn normal(design: &DesignModel, body: Body) -> Unit<Vector3<f64>> {
    let (m, home) = (design.manipulator(), design.home_or_default());
    let lines: Vector3<f64> = m.legs().iter().map(|l| home.transform(&l.platform) - l.base).sum();
    let towards = if body == Body::Base { lines } else { home.rotation.inverse() * lines };
    let normal = plate_normal(m.joints(body), &towards, m.size());
    Unit::new_normalize(if normal.dot(&towards) < 0.0 { -normal } else { normal })
}

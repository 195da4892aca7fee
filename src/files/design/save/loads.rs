//! What the platform carries and how fast and stiff it has to be, and the bodies in the way of the legs: `[payload]`, `[speed]`, `[stiffness]`, `[[loads]]`, `[[keep_out]]`.

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use machine::requirements::{KeepOut, KeepOutShape, Load, Payload, PlateMass};

/// `[payload]`.
#[derive(Serialize)]
pub(super) struct PayloadTable {
    mass: f64,
    center: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    inertia: Option<[[f64; 3]; 3]>,
    gravity: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    plate: Option<&'static str>,
    #[serde(flatten)]
    shape: ShapeTable,
}

impl From<&Payload> for PayloadTable {
    fn from(p: &Payload) -> Self {
        Self {
            mass: p.mass,
            center: p.center.coords.into(),
            inertia: p.inertia.map(|m| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]))),
            gravity: p.gravity.into(),
            plate: Some(p.plate.name()).filter(|_| p.plate != PlateMass::Included),
            shape: p.shape.as_ref().map_or_else(ShapeTable::default, ShapeTable::from),
        }
    }
}

/// `[speed]`.
#[derive(Serialize)]
pub(super) struct SpeedTable {
    pub(super) linear: f64,
    pub(super) angular_deg: f64,
}

/// `[stiffness]`.
#[derive(Serialize)]
pub(super) struct StiffnessTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) linear: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) angular: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) natural_frequency: Option<f64>,
}

/// One of `[[loads]]`.
#[derive(Serialize)]
pub(super) struct LoadTable<'a> {
    name: &'a str,
    force: [f64; 3],
    torque: [f64; 3],
    at: [f64; 3],
    fixed_to: &'static str,
}

impl<'a> From<&'a Load> for LoadTable<'a> {
    fn from(l: &'a Load) -> Self {
        Self {
            name: &l.name,
            force: l.force.into(),
            torque: l.torque.into(),
            at: l.at.coords.into(),
            fixed_to: l.fixed_to.name(),
        }
    }
}

#[derive(Serialize)]
pub(super) struct BoxTable {
    center: [f64; 3],
    size: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct SphereTable {
    center: [f64; 3],
    diameter: f64,
}

#[derive(Serialize)]
pub(super) struct CapsuleTable {
    from: [f64; 3],
    to: [f64; 3],
    diameter: f64,
}

/// One of `[[keep_out]]`: one of the three shapes.
#[derive(Serialize)]
pub(super) struct KeepOutTable<'a> {
    name: &'a str,
    fixed_to: &'static str,
    #[serde(flatten)]
    shape: ShapeTable,
}

/// At most one of the three shapes.
#[derive(Serialize, Default)]
pub(super) struct ShapeTable {
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    block: Option<BoxTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sphere: Option<SphereTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    capsule: Option<CapsuleTable>,
}

impl<'a> From<&'a KeepOut> for KeepOutTable<'a> {
    fn from(k: &'a KeepOut) -> Self {
        Self { name: &k.name, fixed_to: k.fixed_to.name(), shape: ShapeTable::from(&k.shape) }
    }
}

impl From<&KeepOutShape> for ShapeTable {
    fn from(shape: &KeepOutShape) -> Self {
        let point = |p: Point3<f64>| -> [f64; 3] { p.coords.into() };
        let vector = |v: Vector3<f64>| -> [f64; 3] { v.into() };
        let mut out = Self::default();
        match *shape {
            KeepOutShape::Box { center, size } => {
                out.block = Some(BoxTable { center: point(center), size: vector(size) });
            }
            KeepOutShape::Sphere { center, diameter } => {
                out.sphere = Some(SphereTable { center: point(center), diameter });
            }
            KeepOutShape::Capsule { from, to, diameter } => {
                out.capsule = Some(CapsuleTable { from: point(from), to: point(to), diameter });
            }
        }
        out
    }
}

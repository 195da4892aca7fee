//! Sizes and limits of joints, legs and drives.

use super::envelope::extent;
use super::term::TermKind;
use super::universal::{HingeAngle, UniversalJoint};
use nalgebra::{Unit, Vector3};
use num::ordered::OrderedNumber;
use platform::manipulator::Body;

/// The space that a joint occupies, centred at the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Housing {
    /// A sphere of this diameter, design units.
    Sphere(f64),
    /// A box with these edge lengths along the axes of the body frame, design units.
    Box(Vector3<f64>),
}

impl Housing {
    /// Its diameter, or its shortest edge.
    #[must_use]
    pub fn least_width(&self) -> f64 {
        match self {
            Self::Sphere(diameter) => *diameter,
            Self::Box(edges) => edges.min(),
        }
    }

    /// Gap between two housings whose centres differ by `d` (body frame), design units; negative when they overlap.
    ///
    /// `h` are the half edges (0 for a sphere) and `r` the radii (0 for a box) of both; `g_k = |d_k| - h_k - h'_k`.
    /// Boxes apart: the norm of the positive `g_k`. Boxes that overlap: the greatest `g_k`, which is minus the shortest
    /// way out. The gap is this value minus `r + r'`; spheres have `|d| - r - r'`.
    #[must_use]
    pub fn gap<N: OrderedNumber>(&self, other: &Self, d: [N; 3]) -> N {
        let ((half, ball), (other_half, other_ball)) = (extent(Some(*self)), extent(Some(*other)));
        let zero = N::from(0.0);
        let g: [N; 3] = std::array::from_fn(|k| d[k].abs() - (N::from(half[k]) + N::from(other_half[k])));
        let apart = N::norm(g.map(|x| x.max(zero)));
        let overlap = g[0].max(g[1]).max(g[2]).min(zero);
        apart + overlap - (N::from(ball) + N::from(other_ball))
    }

    /// The two housings if at least one joint has one; a joint without housing is a point.
    pub fn pair(a: Option<Self>, b: Option<Self>) -> Option<[Self; 2]> {
        let point = Self::Sphere(0.0);
        (a.is_some() || b.is_some()).then(|| [a.unwrap_or(point), b.unwrap_or(point)])
    }

    /// Its diameter, or its longest edge.
    #[must_use]
    pub fn greatest_width(&self) -> f64 {
        match self {
            Self::Sphere(diameter) => *diameter,
            Self::Box(edges) => edges.max(),
        }
    }
}

/// The space that a leg occupies around the line from its base joint to its platform joint.
///
/// A cylinder of `diameter` starts at the base joint; after `cylinder_length` a rod of `rod_diameter` continues to the
/// platform joint. Each part has rounded ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegBody {
    /// Diameter of the cylinder, or of the whole leg without rod, design units.
    pub diameter: f64,
    /// Length of the cylinder and diameter of the rod, design units.
    pub rod: Option<(f64, f64)>,
}

/// A part of a leg: from one share of its line to another, with a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegSegment {
    /// Share at its beginning.
    pub from: f64,
    /// Share at its end.
    pub to: f64,
    /// Radius, design units.
    pub radius: f64,
    /// The share at a fixed distance from the base joint: the end of the cylinder.
    pub joint: Option<f64>,
}

impl LegBody {
    /// The parts of a leg of this length: cylinder and rod, or one.
    #[inline]
    pub fn parts(&self, length: f64) -> impl Iterator<Item = LegSegment> + Clone + use<> {
        let radius = self.diameter / 2.0;
        let (first, second) = match self.rod {
            Some((cylinder, rod)) if length > cylinder => {
                let s = cylinder / length;
                (
                    LegSegment { from: 0.0, to: s, radius, joint: Some(s) },
                    Some(LegSegment { from: s, to: 1.0, radius: rod / 2.0, joint: Some(s) }),
                )
            }
            _ => (LegSegment { from: 0.0, to: 1.0, radius, joint: None }, None),
        };
        std::iter::once(first).chain(second)
    }

    /// The parts of a leg of this length without the points nearer than `cut` to its joint at an end, with their
    /// numbers. If nothing is left, it is one point at the other end.
    pub fn parts_beyond(
        &self,
        length: f64,
        end: Body,
        cut: f64,
    ) -> impl Iterator<Item = (usize, LegSegment)> {
        let cut = (cut / length).min(1.0);
        let all = self.parts(length);
        let last = all.clone().count() - 1;
        all.enumerate().filter_map(move |(number, part)| {
            let (from, to, far, is_far) = match end {
                Body::Base => (part.from.max(cut), part.to, part.to, number == last),
                Body::Platform => (part.from, part.to.min(1.0 - cut), part.from, number == 0),
            };
            let (from, to) = if from < to { (from, to) } else { (far, far) };
            (from < to || is_far).then_some((number, LegSegment { from, to, ..part }))
        })
    }
}

/// The possible lengths of a leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LengthLimits {
    /// From the first to the second length, design units.
    Range(f64, f64),
    /// A linear drive with a rod that retracts into its cylinder. The length is `dead + stroke` retracted and
    /// `dead + 2 stroke` extended.
    Stroke {
        /// Length of the parts that neither extend nor retract, design units.
        dead: f64,
        /// Travel, design units.
        stroke: f64,
    },
}

impl LengthLimits {
    /// Least and greatest length.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        match *self {
            Self::Range(least, greatest) => (least, greatest),
            Self::Stroke { dead, stroke } => (dead + stroke, dead + 2.0 * stroke),
        }
    }
}

/// Direction of the axis of each joint of a body, from which its joint angle is measured.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum JointAxes {
    /// Along the leg at the home pose.
    #[default]
    Home,
    /// Chosen by the optimiser; evaluated like [`JointAxes::Home`] until then.
    Optimize,
    /// Given, one for each leg in leg order, in the frame of the body, from base to platform.
    Given([Unit<Vector3<f64>>; 6]),
}

/// Limits of the angles between the legs and the joint axes of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeLimits {
    /// Greatest angle between each leg and its axis, in leg order, degrees, above 0 and at most 180; 180 limits
    /// nothing.
    pub limits_deg: [f64; 6],
    /// The axes.
    pub axes: JointAxes,
}

impl ConeLimits {
    /// The same limit for all legs, degrees, from axes.
    #[must_use]
    pub fn of_all(limit_deg: f64, axes: JointAxes) -> Self {
        Self { limits_deg: [limit_deg; 6], axes }
    }

    /// The least of the limits, degrees.
    #[must_use]
    pub fn least_deg(&self) -> f64 {
        self.limits_deg.iter().copied().fold(180.0, f64::min)
    }

    /// The limit of all legs, degrees; `None` where they differ.
    #[must_use]
    pub fn common_deg(&self) -> Option<f64> {
        let first = self.limits_deg[0];
        self.limits_deg.iter().all(|x| x.to_bits() == first.to_bits()).then_some(first)
    }
}

/// A part of a leg as a body: thin, so that it has no inertia about the line of the leg.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LegPart {
    /// Mass, mass units.
    pub mass: f64,
    /// Distance of the centre of mass from its joint along the leg, design units.
    pub center: f64,
    /// Moment of inertia about an axis across the leg through the centre of mass, mass units times design units
    /// squared.
    pub inertia: f64,
}

impl LegPart {
    /// Moment of inertia of a thin rod of constant cross-section that begins at the joint and has its middle at the
    /// centre of mass: `m (2 c)^2 / 12`.
    #[must_use]
    pub fn uniform_inertia(mass: f64, center: f64) -> f64 {
        mass * center * center / 3.0
    }
}

/// Masses of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LegMasses {
    /// The part that rotates about the base joint and keeps its length; its centre is measured from the base joint.
    pub cylinder: LegPart,
    /// The part that moves along the leg; its centre is measured from the platform joint.
    pub rod: LegPart,
    /// Equivalent mass along the leg of the rotating parts of the drive, mass units. It is the inertia of motor and
    /// spindle over the square of the lead per radian.
    pub reflected: f64,
}

impl LegMasses {
    /// The masses and inertias multiplied by `factor`, as for another unit of mass.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let part =
            |p: &LegPart| LegPart { mass: p.mass * factor, center: p.center, inertia: p.inertia * factor };
        Self { cylinder: part(&self.cylinder), rod: part(&self.rod), reflected: self.reflected * factor }
    }

    /// Mass that moves along the leg with its platform joint.
    pub fn lengthwise(&self) -> f64 {
        self.rod.mass + self.reflected
    }

    /// Moment of inertia of a leg of this length about an axis across it through its base joint.
    pub fn turning(&self, length: f64) -> f64 {
        let (cylinder, rod) = (&self.cylinder, &self.rod);
        cylinder.inertia
            + cylinder.mass * cylinder.center.powi(2)
            + rod.inertia
            + rod.mass * (length - rod.center).powi(2)
    }
}

num::words! {
    /// The kind of a joint.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum JointType as name {
        /// It rotates freely about all axes, within its cone angle.
        Ball = "ball",
        /// Two hinges in a row.
        Universal = "universal",
        /// It bends against a stiffness.
        Flexure = "flexure",
    }
}

/// Sizes and limits of joints, legs and drives. Absent entries limit nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hardware {
    /// Housing of each base joint without its own housing.
    pub base_housing: Option<Housing>,
    /// Housing of each platform joint without its own housing.
    pub platform_housing: Option<Housing>,
    /// Housings of base joints whose model has one, in leg order.
    pub base_joint_housing: [Option<Housing>; 6],
    /// Housings of platform joints whose model has one, in leg order.
    pub platform_joint_housing: [Option<Housing>; 6],
    /// Diameter of the joints of both bodies without their own housing, design units.
    pub joint_diameter: Option<f64>,
    /// Bodies of the legs.
    pub leg_body: Option<LegBody>,
    /// Required gap between legs, and between legs and keep-outs, design units; none means 0.
    pub leg_clearance: Option<f64>,
    /// Lengths of the legs.
    pub leg_length: Option<LengthLimits>,
    /// Cone angles of the base joints.
    pub base_cone_angle: Option<ConeLimits>,
    /// Cone angles of the platform joints.
    pub platform_cone_angle: Option<ConeLimits>,
    /// Universal joints of the base; none where no joint is one.
    pub base_universal: Option<UniversalJoint>,
    /// Universal joints of the platform.
    pub platform_universal: Option<UniversalJoint>,
    /// Bending stiffness of the flexures of the base, in leg order, force units times design units per radian; none
    /// where a joint turns freely.
    pub base_bending: [Option<f64>; 6],
    /// Bending stiffness of the flexures of the platform.
    pub platform_bending: [Option<f64>; 6],
    /// Lengthening of a leg when its platform end makes one turn relative to the base end, design units. The turn
    /// follows the right-hand rule about the direction from base to platform.
    pub screw_lead: Option<f64>,
    /// Greatest force along a leg, push or pull, force units.
    pub max_leg_force: Option<f64>,
    /// Greatest speed of a leg, design units per second.
    pub max_leg_speed: Option<f64>,
    /// Stiffness of a leg along its line, force units per design unit.
    pub leg_stiffness: Option<f64>,
    /// Masses of a leg; none if the design gives none.
    pub leg_masses: Option<LegMasses>,
}

impl Hardware {
    /// Housing of the joint of a leg at a body: that of its model, then that of the body, then
    /// [`Hardware::joint_diameter`] as a sphere.
    #[must_use]
    pub fn housing(&self, body: Body, leg: usize) -> Option<Housing> {
        let own = body.of((self.base_joint_housing, self.platform_joint_housing))[leg];
        let of_body = body.of((self.base_housing, self.platform_housing));
        own.or(of_body).or(self.joint_diameter.map(Housing::Sphere))
    }

    /// The housings about the centre of a joint: those of the legs that end there, each once. `ends` are the joints of
    /// the body in leg order.
    pub(crate) fn housings_at(&self, body: Body, ends: &[usize; 6], joint: usize) -> Vec<Option<Housing>> {
        let mut out = Vec::new();
        for leg in (0..6).filter(|&leg| ends[leg] == joint) {
            let housing = self.housing(body, leg);
            if !out.contains(&housing) {
                out.push(housing);
            }
        }
        out
    }

    /// The least and the greatest of the widths of the housings of a body ([`Housing::least_width`]); `None` where a
    /// joint has no housing.
    #[must_use]
    pub fn joint_widths(&self, body: Body) -> Option<[f64; 2]> {
        let widths: Option<Vec<f64>> =
            (0..6).map(|leg| self.housing(body, leg).map(|h| h.least_width())).collect();
        let widths = widths?;
        let (least, greatest) =
            (widths.iter().copied().reduce(f64::min), widths.iter().copied().reduce(f64::max));
        least.zip(greatest).map(<[f64; 2]>::from)
    }

    /// The model of the joint of a leg at a body.
    #[must_use]
    pub fn joint_kind(&self, body: Body, leg: usize) -> JointType {
        if self.universal(body).is_some_and(|joint| joint.first_axes[leg].is_some()) {
            JointType::Universal
        } else if body.of((self.base_bending, self.platform_bending))[leg].is_some() {
            JointType::Flexure
        } else {
            JointType::Ball
        }
    }

    /// The universal joints of a body, if it has any.
    #[must_use]
    pub fn universal(&self, body: Body) -> Option<UniversalJoint> {
        body.of((self.base_universal, self.platform_universal))
    }

    /// The axes of the joints of a body, if a limit refers to them.
    #[must_use]
    pub fn axes(&self, body: Body) -> Option<JointAxes> {
        let cone_angle = body.of((self.base_cone_angle, self.platform_cone_angle)).map(|s| s.axes);
        cone_angle.or(self.universal(body).map(|joint| joint.axes))
    }

    /// The limit of an angle of the universal joint of a leg, degrees; `None` without such a limit, and for other
    /// kinds.
    pub fn angle_limit_deg(&self, kind: TermKind, leg: usize) -> Option<f64> {
        let (body, angle) = kind.hinge()?;
        let joints = self.universal(body)?;
        let limits = joints.limits_deg[leg].filter(|_| joints.first_axes[leg].is_some())?;
        Some(match angle {
            HingeAngle::First => limits[0],
            HingeAngle::Second => limits[1],
        })
    }

    /// The least limit of an angle of universal joints over the legs, degrees.
    pub(crate) fn least_angle_limit_deg(&self, kind: TermKind) -> Option<f64> {
        (0..6).filter_map(|leg| self.angle_limit_deg(kind, leg)).reduce(f64::min)
    }

    /// The greatest force or speed of the drive of a leg; `None` without this limit, and for other kinds.
    #[must_use]
    pub fn drive_limit(&self, kind: TermKind) -> Option<f64> {
        match kind {
            TermKind::LegForce => self.max_leg_force,
            TermKind::LegSpeed => self.max_leg_speed,
            _ => None,
        }
    }

    /// The same with another drive in each leg; unknown properties stay.
    #[must_use]
    pub fn with_drive(&self, lengths: LengthLimits, [force, speed, stiffness]: [Option<f64>; 3]) -> Self {
        Self {
            leg_length: Some(lengths),
            max_leg_force: force.or(self.max_leg_force),
            max_leg_speed: speed.or(self.max_leg_speed),
            leg_stiffness: stiffness.or(self.leg_stiffness),
            ..*self
        }
    }

    /// The properties of the drives (lengths, force, speed, stiffness, masses), and all limits without the drives.
    pub(super) fn of_drives_and_rest(&self) -> [Self; 2] {
        let rest =
            Self { leg_length: None, max_leg_force: None, max_leg_speed: None, leg_stiffness: None, ..*self };
        let drives = Self {
            leg_length: self.leg_length,
            max_leg_force: self.max_leg_force,
            max_leg_speed: self.max_leg_speed,
            leg_stiffness: self.leg_stiffness,
            leg_masses: self.leg_masses,
            ..Self::default()
        };
        [drives, rest]
    }

    /// `true` if drive lengths differ from the distances of the joints: universal joints with offset axes, or screws
    /// that couple rotation and length.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        let apart = |joint: Option<UniversalJoint>| joint.is_some_and(|j| j.offset != 0.0);
        apart(self.base_universal)
            || apart(self.platform_universal)
            || self.screw_lead.is_some_and(|lead| lead != 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_of_spheres_and_boxes() {
        let d = [3.0f64, 4.0, 0.0];
        let alike = |h: Housing| h.gap(&h, d);
        assert!((alike(Housing::Sphere(2.0)) - 3.0).abs() < 1e-15);
        let block = |x, y, z| Housing::Box(Vector3::new(x, y, z));
        assert!((alike(block(2.0, 2.0, 9.0)) - (1.0f64 + 4.0).sqrt()).abs() < 1e-15, "corner to corner");
        assert!((alike(block(5.0, 2.0, 9.0)) - 2.0).abs() < 1e-15, "face to face");
        let overlap = alike(block(5.0, 4.5, 9.0));
        assert!((overlap + 0.5).abs() < 1e-15, "overlap: the shortest way out is along y");
        // one of each: the box ends at x = 1, y = 2, its corner is (2, 2) from the centre of the ball
        let (wide, ball) = (block(2.0, 4.0, 9.0), Housing::Sphere(3.0));
        let mixed = 8f64.sqrt() - 1.5;
        assert!((wide.gap(&ball, d) - mixed).abs() < 1e-15 && (ball.gap(&wide, d) - mixed).abs() < 1e-15);
        assert!((Housing::Sphere(2.0).gap(&Housing::Sphere(5.0), d) - 1.5).abs() < 1e-15);
    }

    #[test]
    fn the_housing_of_a_joint_is_that_of_its_model_then_that_of_its_body() {
        let mut h = Hardware { joint_diameter: Some(4.0), ..Hardware::default() };
        h.base_joint_housing[2] = Some(Housing::Sphere(7.0));
        h.platform_housing = Some(Housing::Box(Vector3::new(1.0, 2.0, 3.0)));
        assert_eq!(h.housing(Body::Base, 2), Some(Housing::Sphere(7.0)));
        assert_eq!(h.housing(Body::Base, 1), Some(Housing::Sphere(4.0)));
        assert_eq!(h.housing(Body::Platform, 2), h.platform_housing);
        assert_eq!(h.joint_widths(Body::Base), Some([4.0, 7.0]));
        // legs 2 and 3 share a joint: two housings about one centre
        let at = h.housings_at(Body::Base, &[0, 1, 1, 2, 2, 0], 1);
        assert_eq!(at, [Some(Housing::Sphere(4.0)), Some(Housing::Sphere(7.0))]);
        assert_eq!(h.housings_at(Body::Base, &[0, 1, 1, 2, 2, 0], 2).len(), 1);
    }

    #[test]
    fn a_drive_is_between_one_and_two_strokes_longer_than_its_dead_length() {
        assert_eq!(LengthLimits::Stroke { dead: 5.0, stroke: 2.0 }.range(), (7.0, 9.0));
    }
}

//! The common data of all formats, computed once.

use nalgebra::{DMatrix, Matrix3, Point3, Rotation3, Vector3};

use super::controller::EquivalentOctahedral;
use super::plate::Plate;
use super::sizes::{ExportOptions, LegSizes, NoExport, SizeChoice, Sizes, least_distance, moving, positive};
use super::units::LengthUnit;
use super::{ExportFormat, ExportedFile, Unsupported};
use crate::design::{CalibratedNumber, DesignModel};
use machine::coupled::CoupledLegs;
use machine::requirements::{Hardware, KeepOutShape, MovingBodies, TermKind, plate_normal};
use machine::rotary::RotaryPlatform;
use platform::geom::{Pose, any_across};
use platform::manipulator::{Body, Manipulator};

/// A joint of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportedJoint {
    /// Its name.
    pub name: String,
    /// Its centre in the frame of the body, design units.
    pub at: Point3<f64>,
}

/// Base or platform.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportBody {
    /// The body.
    pub body: Body,
    /// Its joints in the order of the design; a shared joint once.
    pub joints: Vec<ExportedJoint>,
    /// Diameter of the balls of its joints, design units.
    pub ball_diameter: f64,
    /// Its plate. Formats that draw it call [`ExportBody::plate`].
    plate: Plate,
}

impl ExportBody {
    /// The plate.
    ///
    /// # Errors
    /// Holes that overlap.
    pub fn plate(&self) -> Result<&Plate, Unsupported> {
        self.plate.made(self.body)
    }
}

/// A leg at home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExportLeg {
    /// 1-based number.
    pub number: usize,
    /// Index of its base joint.
    pub base: usize,
    /// Index of its platform joint.
    pub platform: usize,
    /// Centre of the base joint, base frame, design units.
    pub foot: Point3<f64>,
    /// Centre of the platform joint at home, base frame, design units.
    pub head: Point3<f64>,
    /// Diameter of the cylinder and of the rod, design units.
    pub diameters: (f64, f64),
    /// End of the cylinder, distance from the base joint, design units.
    pub cylinder: f64,
}

impl ExportLeg {
    /// Length at home, design units.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.head - self.foot).norm()
    }

    /// Unit vector from the base joint to the platform joint at home, base frame.
    ///
    /// # Errors
    /// [`Unsupported::NoDirection`] for a leg of length zero.
    pub fn direction(&self) -> Result<Vector3<f64>, Unsupported> {
        let d = (self.head - self.foot).try_normalize(0.0);
        d.ok_or(Unsupported::NoDirection { leg: self.number })
    }
}

/// A frame with its third axis along a direction.
pub(super) fn frame_along(direction: &Vector3<f64>, origin: Vector3<f64>) -> Pose {
    let x = any_across(direction);
    let axes = Matrix3::from_columns(&[x, direction.cross(&x), *direction]);
    Pose { rotation: Rotation3::from_matrix_unchecked(axes), position: origin }
}

/// The pose `inner` relative to the pose `outer`, both given in the same frame.
pub(super) fn seen_from(outer: &Pose, inner: &Pose) -> Pose {
    let back = outer.rotation.inverse();
    Pose { rotation: back * inner.rotation, position: back * (inner.position - outer.position) }
}

/// The cranks of a rotary design.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportCranks {
    /// Cranks and rods, design units.
    pub platform: RotaryPlatform,
    /// Angles at home, radians.
    pub home_angles: [f64; 6],
    /// Greatest torque of a crank, newton metres, if the design limits it.
    pub greatest_torque: Option<f64>,
    /// Cone angle of the joints at the tips, out of the planes of the cranks, radians, if the design limits it.
    pub tip_angle: Option<f64>,
    /// Cone angle of the joints at the platform, from the rod directions at home, radians, if the design limits it.
    pub platform_cone_angle: Option<f64>,
}

impl ExportCranks {
    /// `None` for a design with legs of variable length.
    fn of(design: &DesignModel, home: &Pose, torque_unit: f64) -> Result<Option<Self>, NoExport> {
        let unfit = |why: &dyn std::fmt::Display| NoExport::Cranks(why.to_string());
        let Some(platform) = design.rotary().map_err(|why| unfit(&why))? else { return Ok(None) };
        let home_angles = platform
            .ik(home)
            .map_err(|why| unfit(&format!("the cranks do not hold the home pose: {why}")))?;
        let limits = design.crank_limits();
        Ok(Some(Self {
            platform,
            home_angles,
            greatest_torque: limits.max_torque.map(|t| t * torque_unit),
            tip_angle: limits.tip_angle_deg.map(f64::to_radians),
            platform_cone_angle: limits.platform_cone_angle_deg.map(f64::to_radians),
        }))
    }
}

/// Uncertainty of the joints and leg offsets of a calibrated machine, with correlations.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportCalibration {
    /// The numbers with a standard deviation in the design: coordinates of joints, then leg offsets.
    pub numbers: Vec<CalibratedNumber>,
    /// Their names: `base.A1.x`, `offset.3`.
    pub names: Vec<String>,
    /// Their values, design units.
    pub values: Vec<f64>,
    /// Their standard deviations, design units.
    pub deviations: Vec<f64>,
    /// Correlations of these numbers.
    pub correlations: DMatrix<f64>,
}

impl ExportCalibration {
    /// `None` for a design without standard deviations.
    fn of(design: &DesignModel) -> Option<Self> {
        let table = design.calibration.as_ref()?;
        let of_body = |body: Body| {
            (0..design.joint_names(body).len()).flat_map(move |joint| {
                (0..3).map(move |axis| CalibratedNumber::Coordinate { body, joint, axis })
            })
        };
        let all = Body::BOTH.into_iter().flat_map(of_body).chain((0..6).map(CalibratedNumber::Offset));
        let (numbers, deviations): (Vec<_>, Vec<_>) =
            all.filter_map(|number| Some((number, table.deviation_of(number)?))).unzip();
        if numbers.is_empty() {
            return None;
        }
        let m = design.manipulator();
        let value = |number: &CalibratedNumber| match *number {
            CalibratedNumber::Coordinate { body, joint, axis } => {
                body.of((m.base_joints(), m.platform_joints()))[joint][axis]
            }
            CalibratedNumber::Offset(leg) => table.offsets[leg],
        };
        Some(Self {
            names: numbers.iter().map(|number| number.name(design)).collect(),
            values: numbers.iter().map(value).collect(),
            correlations: table.correlations_of(&numbers),
            deviations,
            numbers,
        })
    }

    /// The covariance of all legs, design units squared. Rows and columns are ordered by legs: the base joint, the
    /// platform joint and the offset of each. Numbers without uncertainty have zeros.
    #[must_use]
    pub fn of_legs(&self, pairs: &[(usize, usize); 6]) -> DMatrix<f64> {
        let numbers = (0..6).flat_map(|leg| {
            let coordinates = move |body: Body, joint: usize| {
                (0..3).map(move |axis| CalibratedNumber::Coordinate { body, joint, axis })
            };
            let (base, platform) = pairs[leg];
            coordinates(Body::Base, base)
                .chain(coordinates(Body::Platform, platform))
                .chain(std::iter::once(CalibratedNumber::Offset(leg)))
        });
        let places: Vec<Option<usize>> =
            numbers.map(|number| self.numbers.iter().position(|own| *own == number)).collect();
        DMatrix::from_fn(places.len(), places.len(), |i, j| match (places[i], places[j]) {
            (Some(i), Some(j)) => self.correlations[(i, j)] * self.deviations[i] * self.deviations[j],
            _ => 0.0,
        })
    }
}

/// The data of all formats.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// Name of the design.
    pub name: String,
    /// Source of its numbers.
    pub source: Option<String>,
    /// Program and version.
    pub program: String,
    /// The length of a design unit.
    pub unit: LengthUnit,
    /// The platform, design units.
    pub manipulator: Manipulator,
    /// Limits of its joints, legs and drives.
    pub hardware: Hardware,
    /// The equivalent octahedral platform, if one other than the platform itself is known.
    pub octahedral: Option<EquivalentOctahedral>,
    /// Size of the manipulator, design units.
    pub size: f64,
    /// Home pose, design units.
    pub home: Pose,
    /// Base and platform.
    pub bodies: [ExportBody; 2],
    /// Legs in leg order. For rods on cranks, the rods at home from the tips of the cranks; the base joints are the
    /// centres of the cranks.
    pub legs: [ExportLeg; 6],
    /// The cranks of the legs; `None` for legs of variable length.
    pub cranks: Option<ExportCranks>,
    /// Legs with joint offsets or leads; `None` if the drive lengths are the distances of the joints.
    pub coupled: Option<CoupledLegs>,
    /// Shown length of each leg minus the distance of its joints, design units, if the design was calibrated.
    pub leg_offsets: Option<[f64; 6]>,
    /// Uncertainty after a calibration, if the design states it.
    pub calibration: Option<ExportCalibration>,
    /// Least and greatest length of a leg, design units, if the design limits them.
    pub leg_range: Option<(f64, f64)>,
    /// Poses of the workspace, home first.
    pub workspace: Vec<Pose>,
    /// Poses along the trajectory; empty without one.
    pub trajectory: Vec<Pose>,
    /// The moving bodies, kilograms and design units; values that the design omits follow rules.
    pub moving: MovingBodies,
    /// Whether the design has a payload.
    pub payload: bool,
    /// The shape of the payload, platform frame, design units, if the design gives one.
    pub payload_shape: Option<KeepOutShape>,
    /// Gravity, base frame, m/s^2.
    pub gravity: Vector3<f64>,
    /// Greatest force of a drive, newtons, if the design limits it.
    pub greatest_force: Option<f64>,
    /// Whether simulators compensate the weight of all bodies.
    pub gravity_compensation: bool,
    /// Diameter of the tolerance circle for the centre of each hole, design units, if known.
    pub hole_places: Option<f64>,
    /// The sizes and their sources.
    pub choices: Vec<SizeChoice>,
}

/// Steps between two poses of a trajectory in the table of leg lengths.
const STEPS: usize = 20;

impl Export {
    /// Computes plates, legs at home and sizes, with the home, the workspace and the trajectory of the design.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn of(design: &DesignModel, options: &ExportOptions) -> Result<Self, NoExport> {
        let (home, mut workspace) = (design.home_or_default(), design.workspace_or_default());
        let path = workspace.space(&home).along_trajectory(STEPS);
        workspace.trajectory = None;
        let listed = (workspace.sample(&home), path);
        Self::new(design, home, listed, options)
    }

    /// Computes plates, legs at home and sizes.
    ///
    /// `home` is in design units; `workspace` and `trajectory` are the poses with listed leg lengths.
    ///
    /// # Errors
    /// [`NoExport`]: an unknown unit, a size that is not positive or does not fit the others.
    pub fn new(
        design: &DesignModel,
        home: Pose,
        (workspace, trajectory): (Vec<Pose>, Vec<Pose>),
        options: &ExportOptions,
    ) -> Result<Self, NoExport> {
        let unit = options.unit.map_or_else(|| LengthUnit::of(&design.units), Ok)?;
        let m = design.manipulator();
        let size = m.size();
        let hardware = &design.hardware;
        let joints = |names: &[String], points: &[Point3<f64>]| -> Vec<ExportedJoint> {
            names.iter().zip(points).map(|(name, at)| ExportedJoint { name: name.clone(), at: *at }).collect()
        };
        let base = joints(design.base_names(), m.base_joints());
        let platform = joints(design.platform_names(), m.platform_joints());
        let newtons = design.force_unit().newtons();
        let cranks = ExportCranks::of(design, &home, newtons * unit.metres)?;
        let coupled = hardware.is_coupled().then(|| CoupledLegs::new(m, hardware, &home)).transpose();
        let coupled = coupled.map_err(|why| NoExport::Joints(format!("at home {why}")))?;
        let mut ends = m.pairs().map(|(a, b)| (base[a].at, home.transform(&platform[b].at)));
        if let Some(cranks) = &cranks {
            for (i, end) in ends.iter_mut().enumerate() {
                end.0 = cranks.platform.tip(i, cranks.home_angles[i]);
            }
        }
        let lengths = ends.map(|(a, b)| (b - a).norm());
        let shortest = lengths.iter().copied().filter(|l| *l > 1e-9 * size).fold(f64::INFINITY, f64::min);
        let towards: Vector3<f64> = ends.iter().map(|(a, b)| b - a).sum();
        let mut choices = Vec::new();
        let mut seated = |body: Body, joints: &[ExportedJoint], towards: &Vector3<f64>| {
            let points: Vec<Point3<f64>> = joints.iter().map(|j| j.at).collect();
            let normal = plate_normal(&points, towards, size);
            let distance = least_distance(joints, &normal, size);
            let ball = (0.05 * size).min(0.4 * distance).min(0.1 * shortest);
            let stated = design.plates.of(body);
            let sizes = Sizes::of(body, (hardware, stated), options, ball, &mut choices)?;
            Ok::<_, NoExport>((sizes.ball, Plate::under(joints, &normal, towards, &sizes, stated, size)))
        };
        let (base_ball, base_plate) = seated(Body::Base, &base, &towards)?;
        let (platform_ball, platform_plate) =
            seated(Body::Platform, &platform, &-(home.rotation.inverse() * towards))?;
        let sizes = LegSizes::of(hardware, [base_ball, platform_ball], shortest, &mut choices);
        let moving = moving(design, options.mass, unit.metres, &mut choices)?;
        if let Some(value) = options.hole_places {
            positive("the circle of hole places", value)?;
            let what = "diameter of the circle of each hole's place".to_owned();
            choices.push(SizeChoice { what, value, unit: "design units", from: "option" });
        }
        let bodies = [
            ExportBody { body: Body::Base, joints: base, ball_diameter: base_ball, plate: base_plate },
            ExportBody {
                body: Body::Platform,
                joints: platform,
                ball_diameter: platform_ball,
                plate: platform_plate,
            },
        ];
        let pairs = m.pairs();
        let legs = std::array::from_fn(|i| ExportLeg {
            number: i + 1,
            base: pairs[i].0,
            platform: pairs[i].1,
            foot: ends[i].0,
            head: ends[i].1,
            diameters: (sizes.cylinder_diameter, sizes.rod_diameter),
            cylinder: sizes.cylinder_length,
        });
        Ok(Self {
            name: design.name.clone(),
            source: design.source.clone(),
            program: concat!("equipod ", env!("CARGO_PKG_VERSION")).to_string(),
            unit,
            manipulator: m.clone(),
            hardware: *hardware,
            octahedral: None,
            size,
            home,
            bodies,
            legs,
            cranks,
            coupled,
            leg_offsets: design.calibration.as_ref().map(|table| table.offsets),
            calibration: ExportCalibration::of(design),
            leg_range: hardware.leg_length.map(|l| l.range()),
            workspace,
            trajectory,
            moving,
            payload: design.payload.is_some(),
            payload_shape: design.payload.as_ref().and_then(|p| p.shape),
            gravity: design.gravity(),
            greatest_force: hardware.drive_limit(TermKind::LegForce).map(|f| f * newtons),
            gravity_compensation: options.gravity_compensation,
            hole_places: options.hole_places,
            choices,
        })
    }

    /// The files of a format.
    ///
    /// # Errors
    /// The format cannot express the design. [`Unsupported::Cranks`]: rods on cranks without
    /// [support](Writer::takes_cranks). [`Unsupported::NotIdeal`]: joint offsets or leads.
    pub fn files(&self, format: ExportFormat) -> Result<Vec<ExportedFile>, Unsupported> {
        let writer = format.writer();
        if self.cranks.is_some() && !writer.takes_cranks {
            return Err(Unsupported::Cranks);
        }
        if self.coupled.is_some() && !writer.takes_coupled {
            return Err(Unsupported::NotIdeal);
        }
        writer.files(self)
    }

    /// The export with an octahedral platform for controllers to compute poses.
    #[must_use]
    pub fn with_octahedral(self, octahedral: Option<EquivalentOctahedral>) -> Self {
        Self { octahedral, ..self }
    }

    /// Names of base and platform joint of a leg.
    #[must_use]
    pub fn ends_of(&self, leg: &ExportLeg) -> (&str, &str) {
        (&self.bodies[0].joints[leg.base].name, &self.bodies[1].joints[leg.platform].name)
    }

    /// Leg lengths at a pose, design units; for rods on cranks, distances from the tips at home.
    #[must_use]
    pub fn lengths_at(&self, pose: &Pose) -> [f64; 6] {
        self.legs.map(|l| (pose.transform(&self.bodies[1].joints[l.platform].at) - l.foot).norm())
    }

    /// Lengths that the legs show at a pose, design units: [`lengths_at`](Self::lengths_at) plus the offsets of a
    /// calibration.
    #[must_use]
    pub fn shown_at(&self, pose: &Pose) -> [f64; 6] {
        let (lengths, offsets) = (self.lengths_at(pose), self.leg_offsets.unwrap_or_default());
        std::array::from_fn(|i| lengths[i] + offsets[i])
    }

    /// The heading of every text file: design, source, program, unit of the file, frames.
    pub(super) fn heading(&self, file_unit: &str) -> Vec<String> {
        let mut out = vec![format!("{}: written by {}", super::text::one_line(&self.name), self.program)];
        out.extend(self.source.iter().map(|s| format!("Source of the design: {}", super::text::one_line(s))));
        out.push(format!(
            "Lengths in {file_unit}; one unit of the design is {} {file_unit}",
            match file_unit {
                "m" => self.unit.metres,
                _ => self.unit.millimetres,
            }
        ));
        out.push("Right-handed frames; a pose (R, p) takes platform to base coordinates: x_base = R x_platform + p".to_string());
        out
    }
}

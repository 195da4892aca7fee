//! The design: the contents of a valid file, with its requirements and the variables of the optimiser.

use nalgebra::{DMatrix, Point3, Vector3};
use thiserror::Error;

use super::construction::resolve::{Fault, Joints};
use super::construction::{RealPoint, WrittenHome};
use super::{Constructions, CrankLimits, DesignExactness, ExactJoint, Workspace, Written};
use machine::requirements::{
    CrankedLeg, Cranks, Envelopes, ForceUnit, Grid, Hardware, KeepOut, Load, MassUnit, Payload, PlateSolid,
    Plates, PlatformSpeed, PlatformStiffness, Quantity, Requirements, SafetyMargins, Term, TermKind,
};
use machine::requirements::{KeptSymmetry, Objective, VariableKind};
use machine::rotary::{Crank, Elbow, InvalidRotary, RotaryLeg, RotaryPlatform};
use num::surd::Surd;
use platform::geom::{Pose, PoseConvention};
use platform::manipulator::Body;
use platform::manipulator::{InvalidManipulator, JointValues, LegLengths, Manipulator, SurdPoint};

/// A manipulator with names and all other contents of a design file.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignModel {
    /// Name of the design.
    pub name: String,
    /// Label of the length unit; all lengths are in it.
    pub units: String,
    /// Source of the numbers (paper, year, table).
    pub source: Option<String>,
    /// Free text.
    pub description: Option<String>,
    /// The revision of the design, as named on its drawings and parts.
    pub revision: Option<String>,
    /// Leg lengths that belong to the design, for instance of a published example.
    pub lengths: Option<LegLengths>,
    /// The pose for which the platform is designed.
    pub home: Option<Pose>,
    /// The machine's own convention for poses.
    pub frames: PoseConvention,
    /// The poses the platform has to reach.
    pub workspace: Workspace,
    /// Limits for the optimisation of joint offsets.
    pub optimize: OptimizeTable,
    /// Variables and objectives of the optimiser: the other keys of `[optimize]`.
    pub search: SearchTable,
    /// Sizes and limits of joints, legs and drives.
    pub hardware: Hardware,
    /// Required speed of the platform.
    pub speed: Option<PlatformSpeed>,
    /// Required stiffness of the platform on its legs.
    pub stiffness: Option<PlatformStiffness>,
    /// Loads on the platform.
    pub loads: Vec<Load>,
    /// Bodies that the legs must not touch.
    pub keep_outs: Vec<KeepOut>,
    /// The payload of the platform.
    pub payload: Option<Payload>,
    /// Space that plates and machine may occupy.
    pub envelopes: Envelopes,
    /// The plates that carry the joints.
    pub plates: Plates,
    /// The file name of the table of drives to choose from, relative to the folder of the design.
    pub drive_table: Option<String>,
    /// The required safety margins of the limits.
    pub safety_margins: SafetyMargins,
    /// Grids for the joints of base and platform; `None`: any position. If holes are stated, at least one plate has a
    /// grid.
    pub holes: Option<[Option<Grid>; 2]>,
    /// Unit of forces; `None` if the file names none.
    pub force_units: Option<ForceUnit>,
    /// Unit of masses; `None` if the file names none.
    pub mass_units: Option<MassUnit>,
    /// Results of a calibration besides the joints.
    pub calibration: Option<CalibrationTable>,
    /// The text it was read from.
    pub written: Written,
    pub(super) manipulator: Manipulator,
    pub(super) constructions: Constructions,
    base_names: Vec<String>,
    platform_names: Vec<String>,
}

/// Limits for the optimisation of joint offsets; the optimiser chooses absent ones.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OptimizeTable {
    /// Smallest distance between two joints of one body, design units, positive.
    pub min_joint_distance: Option<f64>,
    /// Smallest `|det A|` of the leg map, dimensionless, positive.
    pub min_abs_det: Option<f64>,
    /// Length that turns angles into lengths, design units, positive.
    pub characteristic_length: Option<f64>,
}

/// The results of a calibration besides the joints, which are stored as those of the design.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CalibrationTable {
    /// Shown length of each leg minus the distance of its joints, design units.
    pub offsets: [f64; 6],
    /// Standard deviations of the offsets, design units.
    pub offset_deviations: Option<[f64; 6]>,
    /// Standard deviations of the coordinates of the base joints, in joint order, design units; `None` for joints
    /// without data.
    pub base_deviations: Vec<Option<Vector3<f64>>>,
    /// Standard deviations of the coordinates of the platform joints, in the same form.
    pub platform_deviations: Vec<Option<Vector3<f64>>>,
    /// Correlations of coordinates and offsets; `None`: uncorrelated.
    pub correlations: Option<Correlations>,
}

/// A number that a calibration finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CalibratedNumber {
    /// A coordinate of a joint, frame of its body.
    Coordinate {
        /// The body.
        body: Body,
        /// Index of the joint.
        joint: usize,
        /// 0, 1, 2: x, y, z.
        axis: usize,
    },
    /// The offset of a leg, by its index.
    Offset(usize),
}

impl CalibratedNumber {
    /// Its name: `base.A1.x`, `offset.3`.
    #[must_use]
    pub fn name(&self, design: &DesignModel) -> String {
        self.name_among([design.base_names(), design.platform_names()])
    }

    /// The name, from these names of the joints of base and platform.
    pub(super) fn name_among(self, joints: [&[String]; 2]) -> String {
        match self {
            Self::Coordinate { body, joint, axis } => {
                format!("{body}.{}.{}", joints[body.index()][joint], ["x", "y", "z"][axis])
            }
            Self::Offset(leg) => format!("offset.{}", leg + 1),
        }
    }
}

/// Correlations of the numbers of a calibration. They have no unit; unlisted numbers are uncorrelated.
#[derive(Debug, Clone, PartialEq)]
pub struct Correlations {
    /// The numbers of rows and columns.
    pub unknowns: Vec<CalibratedNumber>,
    /// The lower triangle with the diagonal, which is 1: row `i` has `i + 1` numbers. The matrix is positive
    /// semidefinite up to rounding.
    pub triangle: Vec<Vec<f64>>,
}

impl Correlations {
    /// The correlations of a covariance `F F^T`, rounded to ten decimals; a number without uncertainty has none.
    #[must_use]
    pub fn of_root(unknowns: Vec<CalibratedNumber>, root: &DMatrix<f64>) -> Self {
        let units: Vec<_> = root.row_iter().map(|row| row.transpose().try_normalize(0.0)).collect();
        let one = |i: usize, j: usize| match (&units[i], &units[j]) {
            _ if i == j => 1.0,
            (Some(a), Some(b)) => a.dot(b),
            _ => 0.0,
        };
        // formatted as text, so the file has at most ten decimals; adding zero removes the sign of -0
        let kept = |x: f64| format!("{x:.10}").parse::<f64>().unwrap_or(x) + 0.0;
        let row = |i: usize| (0..=i).map(|j| kept(one(i, j)).clamp(-1.0, 1.0)).collect();
        Self { triangle: (0..unknowns.len()).map(row).collect(), unknowns }
    }

    /// The whole matrix.
    #[must_use]
    pub fn matrix(&self) -> DMatrix<f64> {
        let n = self.triangle.len();
        DMatrix::from_fn(n, n, |i, j| self.triangle[i.max(j)][i.min(j)])
    }
}

impl CalibrationTable {
    /// Standard deviations of the coordinates of a joint.
    #[must_use]
    pub fn deviation(&self, body: Body, joint: usize) -> Option<Vector3<f64>> {
        body.of((&self.base_deviations, &self.platform_deviations)).get(joint).copied().flatten()
    }

    /// The standard deviation of a number; `None` without data.
    #[must_use]
    pub fn deviation_of(&self, number: CalibratedNumber) -> Option<f64> {
        match number {
            CalibratedNumber::Coordinate { body, joint, axis } => Some(self.deviation(body, joint)?[axis]),
            CalibratedNumber::Offset(leg) => Some(self.offset_deviations?[leg]),
        }
    }

    /// Correlations of these numbers: 1 on the diagonal, the values of the table for listed pairs, 0 for others.
    #[must_use]
    pub fn correlations_of(&self, numbers: &[CalibratedNumber]) -> DMatrix<f64> {
        let mut out = DMatrix::identity(numbers.len(), numbers.len());
        let Some(known) = &self.correlations else { return out };
        let listed = |number: &CalibratedNumber| known.unknowns.iter().position(|unknown| unknown == number);
        let places: Vec<Option<usize>> = numbers.iter().map(listed).collect();
        for (i, row) in places.iter().enumerate() {
            for (j, column) in places.iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    out[(i, j)] = known.triangle[*row.max(column)][*row.min(column)];
                }
            }
        }
        out
    }

    /// Distances of the joints for shown leg lengths; all other functions take distances.
    #[must_use]
    pub fn distances(&self, shown: [f64; 6]) -> [f64; 6] {
        std::array::from_fn(|leg| shown[leg] - self.offsets[leg])
    }
}

/// The number of names differs from that of the joints.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the {body} has {joints} joints, but {names} names were given for them")]
pub struct NameCount {
    /// The body.
    pub body: Body,
    /// Names given.
    pub names: usize,
    /// Number of joints.
    pub joints: usize,
}

/// Reasons why constructions give no design.
#[derive(Debug, Clone, PartialEq, Error)]
pub(crate) enum NotBuilt {
    /// One of them gives no point.
    #[error("{0}")]
    Construction(Fault),
    /// The points form no manipulator.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
}

impl From<Vec<Fault>> for NotBuilt {
    fn from(mut faults: Vec<Fault>) -> Self {
        if faults.is_empty() {
            // without a reported fault the coordinates are not finite
            return Self::Manipulator(InvalidManipulator::NoSize);
        }
        Self::Construction(faults.swap_remove(0))
    }
}

impl DesignModel {
    /// A design with the joint names `A1, A2, ...` on the base and `B1, B2, ...` on the platform and
    /// nothing optional.
    #[must_use]
    pub fn new(name: impl Into<String>, units: impl Into<String>, manipulator: Manipulator) -> Self {
        let names = |letter: char, n: usize| (1..=n).map(|i| format!("{letter}{i}")).collect();
        Self {
            name: name.into(),
            units: units.into(),
            source: None,
            description: None,
            revision: None,
            lengths: None,
            home: None,
            frames: PoseConvention::default(),
            workspace: Workspace::default(),
            optimize: OptimizeTable::default(),
            search: SearchTable::default(),
            hardware: Hardware::default(),
            speed: None,
            stiffness: None,
            loads: Vec::new(),
            keep_outs: Vec::new(),
            payload: None,
            envelopes: Envelopes::default(),
            plates: Plates::default(),
            drive_table: None,
            safety_margins: SafetyMargins::default(),
            holes: None,
            force_units: None,
            mass_units: None,
            calibration: None,
            base_names: names('A', manipulator.base_joints().len()),
            platform_names: names('B', manipulator.platform_joints().len()),
            written: Written::default(),
            manipulator,
            constructions: Constructions::default(),
        }
    }

    /// The design with other joint names, in joint order.
    ///
    /// # Errors
    /// [`NameCount`] unless there is one name for every joint. Names are not compared here; the reader of a file
    /// refuses duplicate names in a body.
    pub fn with_joint_names(mut self, base: Vec<String>, platform: Vec<String>) -> Result<Self, NameCount> {
        let bodies = [
            (Body::Base, base.len(), self.manipulator.base_joints().len()),
            (Body::Platform, platform.len(), self.manipulator.platform_joints().len()),
        ];
        for (body, names, joints) in bodies {
            if names != joints {
                return Err(NameCount { body, names, joints });
            }
        }
        (self.base_names, self.platform_names) = (base, platform);
        Ok(self)
    }

    /// The design with the source and all requirement tables of another one, which a rearrangement of its legs keeps.
    #[must_use]
    pub fn with_tables_of(mut self, other: &Self) -> Self {
        self.source.clone_from(&other.source);
        (self.home, self.workspace, self.search) =
            (other.home, other.workspace.clone(), other.search.clone());
        (self.optimize, self.hardware) = (other.optimize, other.hardware);
        (self.speed, self.stiffness) = (other.speed, other.stiffness);
        (self.loads, self.keep_outs) = (other.loads.clone(), other.keep_outs.clone());
        (self.payload, self.envelopes, self.safety_margins) =
            (other.payload, other.envelopes, other.safety_margins.clone());
        (self.force_units, self.mass_units) = (other.force_units, other.mass_units);
        self.holes = other.holes;
        self.plates = other.plates.clone();
        self.drive_table.clone_from(&other.drive_table);
        // other joints would change the default length, and with it the conditioning
        self.optimize.characteristic_length = Some(other.characteristic_length());
        self
    }

    /// For each joint of a body whether searches must keep it.
    pub fn fixed_joints(&self, body: Body) -> Vec<bool> {
        let fixed = &self.search.fixed[body.index()];
        self.joint_names(body).iter().map(|name| fixed.contains(name)).collect()
    }

    /// Whether any joint is fixed.
    pub fn has_fixed_joints(&self) -> bool {
        Body::BOTH.into_iter().any(|body| self.fixed_joints(body).contains(&true))
    }

    /// The cranks and rods of a design with rotary drive; `None` for legs of variable length.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_files::design; } }
    /// use equipod::methods::design::{Format, parse, parse_with_cranks};
    /// let text = include_str!("../../../designs/presets/reachy-mini.toml");
    /// assert!(parse(text, Format::Toml).is_err(), "its legs do not change their lengths");
    /// let (design, _) = parse_with_cranks(text, Format::Toml).expect("a design");
    /// let platform = design.rotary().expect("tips and joints make a platform").expect("it has cranks");
    /// let angles = platform.ik(&design.home.expect("home")).expect("within reach");
    /// assert!((angles[0].to_degrees() - 35.9).abs() < 0.05);
    /// ```
    ///
    /// # Errors
    /// Cranks and joints form no platform, which is possible after [moving](Self::set_joint) joints.
    pub fn rotary(&self) -> Result<Option<RotaryPlatform>, InvalidRotary> {
        let Some(cranks) = &self.constructions.cranks else { return Ok(None) };
        let m = &self.manipulator;
        let leg = |i: usize| {
            let (a, b) = m.pairs()[i];
            // the reader refuses cranks with missing keys
            let values =
                cranks.values.get(a).and_then(|v| v.as_ref().ok()).ok_or(InvalidRotary::BadNumber(i))?;
            Ok::<_, InvalidRotary>(RotaryLeg {
                crank: Crank {
                    centre: m.base_joints()[a],
                    axis: values.axis,
                    zero: values.zero,
                    length: values.length,
                },
                rod: values.rod,
                platform: m.platform_joints()[b],
                elbow: values.elbow,
                limits: values.limits_deg.map(|[least, most]| (least.to_radians(), most.to_radians())),
            })
        };
        let legs = [leg(0)?, leg(1)?, leg(2)?, leg(3)?, leg(4)?, leg(5)?];
        RotaryPlatform::try_new(legs).map(Some)
    }

    /// Whether the legs are rods on cranks.
    #[must_use]
    pub fn has_cranks(&self) -> bool {
        self.constructions.cranks.is_some()
    }

    /// Limits of the drives of the cranks; empty for legs of variable length.
    #[must_use]
    pub fn crank_limits(&self) -> CrankLimits {
        self.constructions.cranks.as_ref().map(|cranks| cranks.drives).unwrap_or_default()
    }

    /// Joints and legs. With rods on [cranks](Self::rotary) the base joints are the centres of the cranks.
    #[must_use]
    pub fn manipulator(&self) -> &Manipulator {
        &self.manipulator
    }

    /// Names of [`Manipulator::base_joints`], in the same order.
    #[must_use]
    pub fn base_names(&self) -> &[String] {
        &self.base_names
    }

    /// Names of [`Manipulator::platform_joints`], in the same order.
    #[must_use]
    pub fn platform_names(&self) -> &[String] {
        &self.platform_names
    }

    /// Names of the joints of a body, in joint order.
    pub fn joint_names(&self, body: Body) -> &[String] {
        body.of((&self.base_names, &self.platform_names))
    }

    /// The joints of a body with exact coordinates, in joint order.
    ///
    /// A joint of three plain numbers is the three doubles. A constructed joint has the exact numbers of its
    /// construction: fractions, sums of square roots, or bounds. The coordinates in [`Self::manipulator`] are the
    /// nearest doubles.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_files::design; } pub mod prelude { pub use platform::manipulator::Body; } }
    /// use equipod::methods::design::{Exactness, Format, parse};
    /// use equipod::prelude::Body;
    /// let text = r#"
    /// name = "triangles"
    /// units = "m"
    /// legs = [["A", "D"], ["B", "D"], ["B", "E"], ["C", "E"], ["C", "F"], ["A", "F"]]
    /// [parameters]
    /// r = 6
    /// [base]
    /// A = { radius = "r", angle_deg = 30 }
    /// B = { turn = "A", deg = 120 }
    /// C = { turn = "B", deg = 120 }
    /// [platform]
    /// D = [1, 0, 0]
    /// E = ["1/3", "sqrt(2)", 0]
    /// F = { mirror = "E", plane = "xz" }
    /// "#;
    /// let (design, _) = parse(text, Format::Toml).unwrap();
    /// let base = design.exact_joints(Body::Base);
    /// assert_eq!(base[0].coordinates, ["3*sqrt(3)", "3", "0"]);
    /// assert_eq!(base[1].coordinates, ["-3*sqrt(3)", "3", "0"]);
    /// assert_eq!((base[0].exactness, base[2].exactness), (Exactness::Field, Exactness::Rational));
    /// ```
    #[must_use]
    pub fn exact_joints(&self, body: Body) -> Vec<ExactJoint> {
        self.exact_points(body).iter().map(ExactJoint::of).collect()
    }

    /// Exactness of all joints.
    ///
    /// ```
    /// # mod equipod { pub mod methods { pub use equipod_files::design; } }
    /// use equipod::methods::design::{Format, parse};
    /// let (design, _) = parse(include_str!("../../../designs/rbt-octahedral.toml"), Format::Toml).expect("a design");
    /// assert_eq!(design.exactness().to_string(), "exact numbers of Q(sqrt(3))");
    /// ```
    #[must_use]
    pub fn exactness(&self) -> DesignExactness {
        let constructed = Body::BOTH.iter().any(|body| {
            (0..self.joint_names(*body).len()).any(|j| self.constructions.of(*body, j).is_some())
        });
        let known = |body| (body, self.joint_names(body), self.exact_points(body));
        DesignExactness::of(constructed, Body::BOTH.map(known))
    }

    /// The numbers behind [`Self::exact_joints`].
    pub(crate) fn exact_points(&self, body: Body) -> Vec<RealPoint> {
        let m = &self.manipulator;
        self.constructions.exact(body, body.of((m.base_joints(), m.platform_joints())))
    }

    /// The length that makes rotations comparable with translations, as in every inverse condition number of the
    /// Jacobian. It is that of `[optimize]`, otherwise the RMS distance of the platform's leg ends from their centroid.
    #[must_use]
    pub fn characteristic_length(&self) -> f64 {
        self.optimize.characteristic_length.unwrap_or_else(|| self.manipulator.platform_rms_radius())
    }

    /// The current constructions of joints and home; home is left out if it has been given another pose since.
    pub(super) fn current_constructions(&self) -> Constructions {
        let mut constructions = self.constructions.clone();
        constructions.home = self.written_home().cloned();
        constructions
    }

    /// The home pose as written, if an expression gives one of its numbers and no other pose has been set since.
    pub(super) fn written_home(&self) -> Option<&WrittenHome> {
        self.constructions.home.as_ref().filter(|written| self.home == Some(written.pose))
    }

    /// The exact numbers of the written home pose: the position, and the angles in degrees if the rotation is given by
    /// them. `None` if no expression gives one of them, or if one is known only between bounds.
    #[must_use]
    pub fn exact_home(&self) -> Option<([Surd; 3], Option<[Surd; 3]>)> {
        let values = self.written_home()?.values.iter().map(|x| x.exact().cloned());
        let values: Vec<Surd> = values.collect::<Option<_>>()?;
        let three = |list: &[Surd]| list.to_vec().try_into().ok();
        Some((three(values.get(..3)?)?, values.get(3..).and_then(three)))
    }

    /// The convention of the table of the workspace: the machine's own, but for what poses are measured from, which
    /// `[workspace]` itself says.
    pub fn trajectory_frames(&self) -> PoseConvention {
        PoseConvention { relative_to: None, ..self.frames }
    }

    /// Sets resolved constructions. Home and the coordinates of the manipulator take their values, unless the doubles
    /// agree already.
    pub(super) fn set_constructions(&mut self, constructions: Constructions) {
        self.constructions = constructions;
        if let Some(home) = &self.constructions.home {
            self.home = Some(home.pose);
        }
        if !self.constructions.any_joint() {
            return; // the doubles as written
        }
        let points = Body::BOTH.map(|body| self.exact_points(body));
        let whole = |list: &[RealPoint]| list.iter().map(exact_point).collect::<Option<Vec<_>>>();
        let exact = match points.each_ref().map(|list| whole(list)) {
            [Some(base), Some(platform)] => Some([base, platform]),
            _ => None,
        };
        let radius = Body::BOTH.map(|body| {
            let doubles = self.manipulator.joints(body);
            let one = |(p, d): (&RealPoint, &Point3<f64>)| {
                p.iter().zip(d.iter()).map(|(x, d)| x.distance_from(*d)).fold(0.0, f64::max)
            };
            points[body.index()].iter().zip(doubles).map(one).collect()
        });
        let values = JointValues::new(exact, radius);
        self.manipulator = self.manipulator.clone().with_values(values);
    }

    /// The design with other constructions, and the resulting coordinates.
    pub(crate) fn with_constructions(mut self, mut constructions: Constructions) -> Result<Self, NotBuilt> {
        let m = &self.manipulator;
        let names = [self.base_names.as_slice(), &self.platform_names];
        let given = Joints { names, points: [m.base_joints(), m.platform_joints()], unread: &[] };
        let [base, platform] = constructions.resolve(given)?;
        self.manipulator = Manipulator::try_new(base, platform, m.pairs())?;
        self.set_constructions(constructions);
        Ok(self)
    }

    /// Base and platform joint name of every leg, in leg order.
    #[must_use]
    pub fn leg_names(&self) -> [(&str, &str); 6] {
        self.manipulator.pairs().map(|(a, b)| (self.base_names[a].as_str(), self.platform_names[b].as_str()))
    }

    /// The requirements of the design, from all its tables.
    #[must_use]
    pub fn requirements(&self) -> Requirements {
        Requirements {
            hardware: self.hardware,
            keep_outs: self.keep_outs.clone(),
            loads: self.all_loads(),
            platform_speed: self.speed,
            platform_stiffness: self.stiffness,
            vibrating: self.vibrating(),
            min_joint_distance: self.optimize.min_joint_distance,
            envelopes: self.envelopes,
            plates: self.plates.clone(),
            payload_shape: self.payload.and_then(|p| p.shape),
            safety_margins: self.safety_margins.clone(),
            cranks: self.limits_of_cranks().map(Box::new),
        }
    }

    /// The limits of cranks and rods; `None` without cranks, or if they form no platform.
    fn limits_of_cranks(&self) -> Option<Cranks> {
        let platform = self.rotary().ok()??;
        let values = &self.constructions.cranks.as_ref()?.values;
        let pairs = self.manipulator.pairs();
        let drives = self.crank_limits();
        let mut legs = Vec::with_capacity(6);
        for (leg, (joint, _)) in platform.legs().iter().zip(pairs) {
            legs.push(CrankedLeg {
                axis: leg.crank.axis.into_inner(),
                zero: leg.crank.zero,
                length: leg.crank.length,
                rod: leg.rod,
                greater: leg.elbow == Elbow::Plus,
                limits_deg: values.get(joint)?.as_ref().ok()?.limits_deg,
            });
        }
        Some(Cranks {
            legs: legs.try_into().ok()?,
            max_torque: drives.max_torque,
            max_speed_deg: drives.max_speed_deg,
            min_transmission_angle_deg: drives.min_transmission_angle_deg.unwrap_or(0.0),
            tip_angle_deg: drives.tip_angle_deg,
            platform_cone_angle_deg: drives.platform_cone_angle_deg,
        })
    }

    /// Offsets of the calibration, design units, zero without one: each leg shows the distance of its joints plus its
    /// offset.
    #[must_use]
    pub fn leg_offsets(&self) -> [f64; 6] {
        self.calibration.as_ref().map_or([0.0; 6], |table| table.offsets)
    }

    /// The plate of a body as a solid, if the file describes it; the legs are on their side at home.
    #[must_use]
    pub fn plate(&self, body: Body) -> Option<PlateSolid> {
        let home = self.home_or_default();
        let solid = |plate| PlateSolid::of(plate, &self.manipulator, body, &self.hardware, &home);
        self.plates.of(body).map(solid)
    }
}

impl DesignModel {
    /// Leg, joint, keep-out and load names of a requirement.
    pub fn names_of(&self, term: Term) -> Vec<String> {
        let leg = |i: usize| format!("leg {}", i + 1);
        let joints = |names: &[String]| vec![names[term.first].clone(), names[term.second].clone()];
        match term.kind {
            TermKind::BaseSpacing => joints(self.base_names()),
            TermKind::PlatformSpacing => joints(self.platform_names()),
            TermKind::LegClearance => vec![leg(term.first), leg(term.second)],
            TermKind::KeepOut => vec![leg(term.first), self.keep_outs[term.second].name.clone()],
            TermKind::LegForce | TermKind::CrankTorque => {
                vec![leg(term.first), self.all_loads()[term.second].name.clone()]
            }
            TermKind::BaseHoleGap if term.first != term.second => joints(self.base_names()),
            TermKind::PlatformHoleGap if term.first != term.second => joints(self.platform_names()),
            TermKind::PlatformEnvelope | TermKind::PlatformHoleEdge | TermKind::PlatformHoleGap => {
                vec![self.platform_names()[term.first].clone()]
            }
            TermKind::PlateClearance => {
                let body = Body::BOTH[term.second.min(1)];
                vec![leg(term.first), format!("{body} plate")]
            }
            TermKind::PayloadClearance => vec![leg(term.first), "payload".to_owned()],
            TermKind::BaseEnvelope | TermKind::BaseHoleEdge | TermKind::BaseHoleGap => {
                vec![self.base_names()[term.first].clone()]
            }
            TermKind::MachineEnvelope => {
                let (base, platform) = self.leg_names()[term.first];
                vec![if term.second == 0 { base } else { platform }.to_owned()]
            }
            kind if kind.is_of_platform() => vec!["platform".to_owned()],
            _ => vec![leg(term.first)],
        }
    }

    /// The legs of a requirement, counted from 1: all legs for requirements of the platform as a whole.
    pub fn legs_of(&self, term: Term) -> Vec<usize> {
        let pairs = self.manipulator.pairs();
        let at = |body: Body| {
            let holds = |i: &usize| [term.first, term.second].contains(&body.of(pairs[*i]));
            (0..6).filter(holds).map(|i| i + 1).collect()
        };
        match term.kind {
            TermKind::BaseSpacing | TermKind::BaseEnvelope => at(Body::Base),
            TermKind::PlatformSpacing | TermKind::PlatformEnvelope => at(Body::Platform),
            kind if kind.plate().is_some() => at(kind.plate().unwrap_or(Body::Base)),
            TermKind::LegClearance => vec![term.first + 1, term.second + 1],
            kind if kind.is_of_platform() => (1..=6).collect(),
            _ => vec![term.first + 1],
        }
    }

    /// The unit of a margin.
    pub fn unit_of(&self, quantity: Quantity) -> String {
        match quantity {
            Quantity::Length => self.units.clone(),
            Quantity::Angle => "deg".to_string(),
            Quantity::Force => self.force_unit().label().to_owned(),
            Quantity::Speed => format!("{}/s", self.units),
            Quantity::LinearStiffness => format!("{}/{}", self.unit_of(Quantity::Force), self.units),
            Quantity::AngularStiffness => format!("{} {}/rad", self.unit_of(Quantity::Force), self.units),
            Quantity::Frequency => "Hz".to_string(),
            Quantity::Torque => format!("{} {}", self.unit_of(Quantity::Force), self.units),
            Quantity::AngularSpeed => "deg/s".to_string(),
        }
    }
}

/// The combination of several objectives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Combination {
    /// The weighted sum of the gains.
    Weighted,
    /// One after the other; later levels may give up this share of the gains of earlier ones.
    Lexicographic {
        /// Share, positive.
        slack: f64,
    },
    /// Designs of which none is better than another in every objective.
    Pareto {
        /// Steps between the extremes of each objective but the first.
        points: usize,
    },
}

/// The keys of `[optimize]` beyond the default task: the six offsets with the best worst-case conditioning.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SearchTable {
    /// The variables; empty: the offsets.
    pub variables: Vec<VariableKind>,
    /// The symmetry that the search keeps. If absent, it is the three-fold one of a design that has it, as long as a
    /// symmetric platform meets the requirements.
    pub symmetry: Option<KeptSymmetry>,
    /// Objectives with weights, or in the order of their levels; empty: the worst-case conditioning.
    pub objectives: Vec<(Objective, f64)>,
    /// The combination of objectives; weighted if absent.
    pub mode: Option<Combination>,
    /// Least and greatest offset; 0 and 1 are the ends of the edge.
    pub offset_bounds: Option<(f64, f64)>,
    /// Least and greatest change of a triangle, as a share of its size.
    pub stretch_bounds: Option<(f64, f64)>,
    /// Least and greatest change of the height of home, in sizes of the design.
    pub height_bounds: Option<(f64, f64)>,
    /// Names of the joints of base and platform that searches must keep.
    pub fixed: [Vec<String>; 2],
}

/// The coordinates if all three are known exactly.
fn exact_point(p: &RealPoint) -> Option<SurdPoint> {
    let [x, y, z] = p;
    Some([x.exact()?.clone(), y.exact()?.clone(), z.exact()?.clone()])
}

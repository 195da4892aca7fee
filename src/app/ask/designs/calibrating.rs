//! A machine calibrated from measurements, as a design.

use nalgebra::{DMatrix, Vector3};

use super::Error;
use crate::Design;
use files::design::{CalibratedNumber, CalibrationTable, Correlations};
use machine::calibration::{
    CalibrateOptions, Calibration, CarriedFrames, LegModel, Measurement, Unknown, Unknowns, calibrate,
};
use machine::manufacture::{Joint, MachineUncertainty, joints};
use machine::requirements::Terms;
use num::Purpose;
use platform::geom::Pose;
use platform::manipulator::Body;

impl Design {
    /// Fits the joints and leg offsets of the machine built from this design to measured poses and lengths. The result
    /// is in the frames of the measured poses, with standard deviations and diagnostics. Offsets of an earlier
    /// calibration count as nominal.
    ///
    /// ```
    /// use equipod::methods::calibration::{CalibrateOptions, CalibrationStatus, Measurement};
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/symmetric-hexapod.toml")?;
    /// let home = design.home_or_default();
    /// let mut rows = Vec::new();
    /// for k in 0..30 {
    ///     let turn = |n: f64| 20.0 * (n * f64::from(k)).sin();
    ///     let at = nalgebra::Vector3::new(turn(1.3), turn(2.7), turn(5.1));
    ///     let pose = Pose::new(home.position + at, Angles::from_degrees([turn(1.7), turn(3.1), turn(4.3)]));
    ///     // a machine like the design but for its encoders, which all count from 2.5 mm
    ///     rows.push(Measurement { pose, lengths: design.ik(&pose)?.get().map(|l| l + 2.5) });
    /// }
    /// let found = design.calibrate(&rows, &CalibrateOptions::default())?;
    /// assert_eq!(found.status, CalibrationStatus::Calibrated);
    /// assert!(found.model.offsets.iter().all(|d| (d - 2.5).abs() < 1e-6));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Calibration`]: unusable measurements or options. Incomplete identification is an answer, not an error.
    pub fn calibrate(
        &self,
        measurements: &[Measurement],
        options: &CalibrateOptions,
    ) -> Result<Calibration, Error> {
        Ok(calibrate(&self.leg_model(), measurements, options)?)
    }

    /// The joints with the offsets of an earlier calibration, or zero offsets.
    #[must_use]
    pub fn leg_model(&self) -> LegModel {
        LegModel::new(self.manipulator(), self.leg_offsets())
    }

    /// The design with calibrated joints and the table `[calibration]`, in the frames of the measurements, or with
    /// `frames` in the design frames.
    ///
    /// # Errors
    /// Joints that make no manipulator.
    pub fn with_calibration(
        &self,
        found: &Calibration,
        frames: Option<&CarriedFrames>,
    ) -> Result<Self, Error> {
        let (model, root) = carried(found, frames);
        let mut out = self.clone();
        for body in Body::BOTH {
            let points = body.of((&model.base, &model.platform));
            for (joint, point) in points.iter().enumerate() {
                // carried joints move, even if they were held
                if found.unknowns.joint(body, joint).is_some() || frames.is_some() {
                    let name = format!("{body}.{}", self.joint_names(body)[joint]);
                    out.set_joint(&name, *point)?;
                }
            }
        }
        let deviation = |column: usize| root.row(column).norm();
        let of = |body: Body| -> Vec<Option<Vector3<f64>>> {
            let joints = 0..self.joint_names(body).len();
            let one = |joint| {
                let column = found.unknowns.joint(body, joint)?;
                Some(Vector3::from_fn(|axis, _| deviation(column + axis)))
            };
            let all: Vec<_> = joints.map(one).collect();
            if all.iter().all(Option::is_none) { Vec::new() } else { all }
        };
        let offsets: Option<Vec<f64>> = (0..6).map(|leg| found.unknowns.offset(leg).map(deviation)).collect();
        out.calibration = Some(CalibrationTable {
            offsets: model.offsets,
            offset_deviations: offsets.and_then(|list| list.try_into().ok()),
            base_deviations: of(Body::Base),
            platform_deviations: of(Body::Platform),
            correlations: Some(Correlations::of_root(numbers(&found.unknowns), &root)),
        });
        Ok(out)
    }

    /// The uncertainty of the machine: standard deviations of its calibration and their correlations, zero for joints
    /// and offsets without a value. `None` if there is no standard deviation at all.
    #[must_use]
    pub fn machine_uncertainty(&self) -> Option<MachineUncertainty> {
        let table = self.calibration.as_ref()?;
        let joints = joints(self.manipulator()).into_iter();
        let coordinates = joints.flat_map(|Joint { body, index: joint }| {
            (0..3).map(move |axis| CalibratedNumber::Coordinate { body, joint, axis })
        });
        let all: Vec<_> = coordinates.chain((0..6).map(CalibratedNumber::Offset)).collect();
        let deviations: Vec<_> = all.iter().map(|number| table.deviation_of(*number)).collect();
        if deviations.iter().all(Option::is_none) {
            return None;
        }
        let matrix = table.correlations_of(&all);
        let deviations: Vec<f64> = deviations.into_iter().map(Option::unwrap_or_default).collect();
        MachineUncertainty::new(&deviations, &matrix)
    }

    /// Poses that may be measured: poses of the workspace at which all requirements of the design are met. About
    /// `count` regular and as many random poses are tried.
    pub fn measurable_poses(&self, count: usize, seed: u64) -> Vec<Pose> {
        let home = self.home_or_default();
        let space = self.workspace_or_default().space(&home);
        let required = self.requirements();
        let terms = Terms::new(self.manipulator(), &required, &home);
        let mut rng = Purpose::MEASURED_POSES.rng(seed);
        let region = space.cube_points(count, &mut rng).into_iter().map(|x| space.pose(&x));
        let met = |pose: &Pose| terms.at(pose).iter().all(|(_, margin)| *margin >= 0.0);
        region.chain(space.listed(1)).filter(met).collect()
    }
}

/// The unknowns of a calibration by the names of the design.
fn numbers(unknowns: &Unknowns) -> Vec<CalibratedNumber> {
    let of = |unknown: &Unknown| match *unknown {
        Unknown::Joint { body, joint, axis } => CalibratedNumber::Coordinate { body, joint, axis },
        Unknown::Offset { leg } => CalibratedNumber::Offset(leg),
    };
    unknowns.list().iter().map(of).collect()
}

/// The machine and a root of the covariance of its unknowns, in the requested frames.
pub fn carried(found: &Calibration, frames: Option<&CarriedFrames>) -> (LegModel, DMatrix<f64>) {
    match frames {
        None => (found.model.clone(), found.root.clone()),
        Some(frames) => (frames.carry(&found.model), frames.carry_root(&found.unknowns, &found.root)),
    }
}

/// The names of the unknowns: `base.A1.x`, `offset.3`.
pub fn unknown_names(design: &Design, unknowns: &Unknowns) -> Vec<String> {
    numbers(unknowns).iter().map(|number| number.name(design)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::parse;
    use files::design::Format;
    use machine::calibration::{MeasurementNoise, pose_deviation};
    use nalgebra::Point3;
    use num::Rng;
    use platform::geom::Angles;

    #[test]
    fn a_written_calibration_leaves_as_much_open_as_the_one_in_memory() {
        let design = Design::load("../../../designs/symmetric-hexapod.toml").unwrap();
        let home = design.home_or_default();
        let mut rng = Rng::new(11);
        let turned = |k: u32, n: f64| 20.0 * (n * f64::from(k)).sin();
        let rows: Vec<Measurement> = (0..40)
            .map(|k| {
                let at = Vector3::new(turned(k, 1.3), turned(k, 2.7), turned(k, 5.1));
                let angles = Angles::from_degrees([turned(k, 1.7), turned(k, 3.1), turned(k, 4.3)]);
                let pose = Pose::new(home.position + at, angles);
                let lengths = design.ik(&pose).unwrap().get().map(|l| l + 0.005 * rng.normal());
                Measurement { pose, lengths }
            })
            .collect();
        let noise = MeasurementNoise { length: 0.005, position: 0.01, rotation: 2e-5 };
        let options = CalibrateOptions::default().noise(noise);
        let found = design.calibrate(&rows, &options).unwrap();
        let text = design.with_calibration(&found, None).unwrap().to_toml();
        let again = parse(&text, Format::Toml).unwrap().0;
        assert_eq!(again.to_toml(), text);
        let known = again.machine_uncertainty().unwrap();
        for row in rows.iter().take(10) {
            let expected = pose_deviation(&found.model, &found.unknowns, &found.root, &row.pose).unwrap();
            let of = |u: &MachineUncertainty| {
                u.pose_covariance(again.manipulator(), &row.pose, &Point3::origin()).unwrap()
            };
            let (kept, independent) = (of(&known), of(&known.independent()));
            assert!((kept.position / expected.position - 1.0).abs() < 1e-5, "{kept:?} {expected:?}");
            assert!((kept.rotation / expected.rotation - 1.0).abs() < 1e-5, "{kept:?} {expected:?}");
            assert!(independent.position > 2.0 * kept.position, "{independent:?} {kept:?}");
        }
    }
}

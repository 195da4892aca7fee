//! The fit of the drives of a table to a design. Every requirement is checked with the lengths, force and speed of the
//! drive as limits, also along motions.

use std::cmp::Ordering;

use super::assessing::{ASSESS_CELLS, BRIEF_CELLS, PATIENT_CELLS, deciding};
use super::{AssessReport, MotionMasses, MotionReport, PlatformMotion};
use crate::Design;
use files::design::{DesignUnits, Drive};
use machine::requirements::{MarginProof, Requirements, least_conditioning, prove};
use synthesis::singularity::regular_workspace;

/// A drive with the design it leads to.
#[derive(Debug, Clone)]
pub struct DriveFit {
    /// The row of the table.
    pub drive: Drive,
    /// The design with the drive.
    pub design: Design,
    /// The proved margins of this design.
    pub assessed: AssessReport,
    /// The results along each motion, in the order given.
    pub motions: Vec<MotionReport>,
}

impl DriveFit {
    /// Whether the drive fits; `None`: undecided. The value `true` is proved for every pose of the workspace, and no
    /// sampled instant of the motions is a violation. The value `false` is proved.
    pub fn fits(&self) -> Option<bool> {
        let along =
            |m: &MotionReport| m.singular.is_none() && m.margins.iter().all(|m| m.margin.standing.is_met());
        if !self.motions.iter().all(along) {
            return Some(false);
        }
        self.assessed.met_at_assessed_poses()
    }

    /// Whether the safety margin on every limit is kept too.
    pub fn keeps_safety_margin(&self) -> Option<bool> {
        let fits = self.fits();
        let along = |m: &MotionReport| {
            let required = self.design.requirements();
            m.margins.iter().all(|m| m.margin.value >= required.safety_margin(m.margin.term.kind))
        };
        if fits == Some(false) || !self.motions.iter().all(along) {
            return Some(false);
        }
        self.assessed.met_with_safety_margin()
    }

    /// Drives that fit come first, then undecided ones; within a group by price, then mass, then the order of the
    /// table. A missing price or mass comes last.
    fn order(&self, other: &Self) -> Ordering {
        let rank = |fit: &Self| match fit.fits() {
            Some(true) => 0,
            None => 1,
            Some(false) => 2,
        };
        let last = |x: Option<f64>| x.unwrap_or(f64::INFINITY);
        rank(self)
            .cmp(&rank(other))
            .then(last(self.drive.price).total_cmp(&last(other.drive.price)))
            .then(last(self.drive.mass).total_cmp(&last(other.drive.mass)))
            .then(self.drive.line.cmp(&other.drive.line))
    }
}

/// The lightest drive of a table that suffices for a design, with the undecided ones.
#[derive(Debug, Clone)]
pub struct LightestDrive<'t> {
    /// The drive; `None` if no drive is proved to suffice.
    pub drive: Option<&'t Drive>,
    /// Undecided lighter drives; all undecided drives if none is proved to suffice.
    pub undecided: Vec<&'t Drive>,
    /// Whether the requirements that no drive changes are met.
    pub rest: Option<bool>,
}

impl Design {
    /// The units for reading a table of drives.
    pub fn drive_units(&self) -> DesignUnits<'_> {
        DesignUnits { length: &self.units, force: self.force_unit(), mass: self.mass_unit() }
    }

    /// The design with a drive in each leg. The drive's lengths, force, speed and stiffness, as far as known, replace
    /// those of `[hardware]`. If both the drive and the legs of the design have masses, cylinder and rod are scaled
    /// alike to the mass of the drive. The mass that stands for the rotating parts stays, as does everything else.
    pub fn with_drive(&self, drive: &Drive) -> Self {
        let mut out = self.clone();
        // the drive is chosen
        out.drive_table = None;
        out.hardware = self.hardware.with_drive(drive.lengths, [drive.force, drive.speed, drive.stiffness]);
        if let (Some(mass), Some(masses)) = (drive.mass, &mut out.hardware.leg_masses) {
            let known = masses.cylinder.mass + masses.rod.mass;
            if known > 0.0 {
                let reflected = masses.reflected;
                *masses = masses.scaled(mass / known);
                masses.reflected = reflected;
            }
        }
        out
    }

    /// Fits every drive of a table; the drive to choose comes first: fitting drives by price, then mass. Requirements
    /// that no drive changes are proved once for all drives.
    ///
    /// `metres` is the length of a design unit; without it no forces along motions are computed.
    pub fn fit_drives(
        &self,
        drives: &[Drive],
        motions: &[PlatformMotion],
        metres: Option<f64>,
        seed: u64,
    ) -> Vec<DriveFit> {
        let rest = self.assessed_without_drives(seed);
        let one = |drive: &Drive| {
            let design = self.with_drive(drive);
            let masses: Option<MotionMasses> = metres.and_then(|m| design.motion_masses(m, None));
            let motions = motions.iter().map(|m| design.along(m, masses.as_ref())).collect();
            let [of_drive, _] = design.requirements().of_drives_and_rest();
            let own = design.proved(&of_drive, seed);
            let mut assessed = AssessReport { ranges: design.stated_ranges(), ..rest.clone() };
            assessed.proof.poses += own.poses;
            assessed.proof.bounds.extend(own.bounds);
            assessed.proof.bounds.sort_by_key(|b| b.found.term.kind);
            DriveFit { drive: drive.clone(), design, assessed, motions }
        };
        let mut all: Vec<DriveFit> = drives.iter().map(one).collect();
        all.sort_by(DriveFit::order);
        all
    }

    /// The lightest drive of a table that is proved to suffice; drives without a mass come last. The drives are tried
    /// in order of mass until one suffices.
    pub fn lightest_drive<'t>(&self, drives: &'t [Drive], seed: u64) -> LightestDrive<'t> {
        let mut order: Vec<&Drive> = drives.iter().collect();
        let mass = |d: &Drive| d.mass.unwrap_or(f64::INFINITY);
        order.sort_by(|a, b| mass(a).total_cmp(&mass(b)).then(a.line.cmp(&b.line)));
        let mut out = LightestDrive { drive: None, undecided: Vec::new(), rest: None };
        let rest = self.assessed_without_drives(seed);
        out.rest = rest.met_at_assessed_poses();
        if out.rest == Some(false) {
            return out;
        }
        for drive in order {
            let design = self.with_drive(drive);
            let [of_drive, _] = design.requirements().of_drives_and_rest();
            let proof = design.proved(&of_drive, seed);
            match proof.all_met() {
                Some(true) if out.rest == Some(true) => {
                    out.drive = Some(drive);
                    break;
                }
                Some(false) => {}
                _ => out.undecided.push(drive),
            }
        }
        out
    }

    /// The assessment of all requirements that no drive changes, and of singular poses.
    fn assessed_without_drives(&self, seed: u64) -> AssessReport {
        let (m, space) = (self.manipulator(), self.workspace.space(&self.home_or_default()));
        let [_, rest] = self.requirements().of_drives_and_rest();
        let proof = self.proved(&rest, seed);
        let (regularity, regularity_cells) = regular_workspace(m, &space, ASSESS_CELLS, seed);
        let conditioning = least_conditioning(m, &space, &deciding(seed), self.characteristic_length());
        AssessReport {
            assessed_poses: self.assessed_poses(),
            proof,
            regularity,
            regularity_cells,
            conditioning,
            // the limits of a drive change them
            ranges: Vec::new(),
        }
    }

    /// The proved margins of some requirements, with as many cells as a decision takes, up to the limit of a search. A
    /// violated safety margin alone does not end the proof, since the question is whether the drive fits.
    fn proved(&self, required: &Requirements, seed: u64) -> MarginProof {
        let (m, space) = (self.manipulator(), self.workspace.space(&self.home_or_default()));
        let mut found = MarginProof::default();
        for cells in [BRIEF_CELLS, ASSESS_CELLS, PATIENT_CELLS] {
            found = prove(m, required, &space, &deciding(seed), cells);
            let decided = match found.all_met() {
                Some(false) => true,
                Some(true) => found.all_keep_safety_margin().is_some(),
                None => false,
            };
            if decided {
                break;
            }
        }
        found
    }
}

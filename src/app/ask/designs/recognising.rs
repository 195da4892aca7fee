//! Symmetry that joints have up to rounding, and the sizes of a new hexapod.

use crate::Design;
use crate::design::parse_with_cranks;
use files::design::{Format, HexapodSizes, SnappedDesign};
use fk::solve::pose_count::{CountOptions, count_generic_poses};
use fk::{FkOptions, solver};
use platform::manipulator::{Manipulator, SquaredLegLengths, inverse_condition, jacobian};
use synthesis::singularity::SingularityVerdict;

/// Below this inverse condition number at home, a new hexapod is reported as nearly singular.
const NEARLY_SINGULAR: f64 = 0.05;

impl Design {
    /// The design with the symmetry of its joints exact, if all poses for these lengths are then proved to be listed.
    #[must_use]
    pub fn snapped_to_prove(
        &self,
        lengths: &SquaredLegLengths,
        options: &FkOptions,
    ) -> Option<SnappedDesign> {
        let snapped = self.snapped()?;
        let solved = solver(None).solve(snapped.design.manipulator(), lengths, options).ok()?;
        solved.is_complete().then_some(snapped)
    }

    /// The same if it decides whether the design is architecturally singular, or the number of its poses.
    #[must_use]
    pub fn snapped_to_decide(&self, seed: u64) -> Option<SnappedDesign> {
        let snapped = self.snapped()?;
        let options = CountOptions { seed, ..CountOptions::default() };
        let is_decided =
            |m: &Manipulator| SingularityVerdict::of(m).is_ok_and(|found| found.is_singular().is_some());
        let is_counted = |m: &Manipulator| count_generic_poses(m, &options).finite().is_some();
        let (own, exact) = (self.manipulator(), snapped.design.manipulator());
        let gains = (!is_decided(own) && is_decided(exact)) || (!is_counted(own) && is_counted(exact));
        gains.then_some(snapped)
    }

    /// The places of the joints of a new hexapod, the meaning of its spreads, and whether its home is nearly singular:
    /// one sentence each. The other reading of the spreads is named if its home is not.
    #[must_use]
    pub fn told_of_sizes(&self, sizes: &HexapodSizes) -> Vec<String> {
        let mut told = sizes.understood(&self.units).to_vec();
        let condition = |design: &Self| {
            let (m, home) = (design.manipulator(), design.home_or_default());
            inverse_condition(&jacobian(m, &home, design.characteristic_length()))
        };
        let here = condition(self);
        if here >= NEARLY_SINGULAR {
            return told;
        }
        let other = sizes.other_reading();
        let read = |other: HexapodSizes| {
            let text = other.check().ok().map(|()| other.to_toml(&self.name, &self.units))?;
            let (design, _) = parse_with_cranks(&text, Format::Toml).ok()?;
            Some(condition(&design)).filter(|there| *there >= NEARLY_SINGULAR)
        };
        let would = read(other).map_or_else(String::new, |there| {
            format!(
                ", and {there:.3} with the platform spread counted from the legs of a base pair ({} degrees)",
                other.spread_deg[1]
            )
        });
        told.push(format!("Home is nearly singular: the inverse condition number is {here:.3}{would}."));
        told
    }
}

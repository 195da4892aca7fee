//! Symmetry that joints have up to rounding, and the sizes of a new hexapod.

use crate::Design;
use crate::design::parse_with_cranks;
use files::design::{Format, HexapodSizes, ServoHexapod, SnappedDesign};
use fk::solve::pose_count::{CountOptions, count_generic_poses};
use fk::{FkOptions, solver};
use num::shown::rounded;
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
        let other = sizes.other_reading();
        let text = || other.check().ok().map(|()| other.to_toml(&self.name, &self.units));
        self.told(sizes.understood(&self.units).to_vec(), other.spread_deg[1], text)
    }

    /// The same for a rotary hexapod.
    #[must_use]
    pub fn told_of_servos(&self, hexapod: &ServoHexapod) -> Vec<String> {
        let (spread, other) = hexapod.other_reading();
        let text = || other.ok().map(|other| other.to_toml(&self.name, &self.units));
        self.told(hexapod.understood(&self.units), spread, text)
    }

    /// The sentences, with the conditioning of a nearly singular home. `text` is the design of the other reading, with
    /// this platform spread.
    fn told(&self, mut told: Vec<String>, spread: f64, text: impl FnOnce() -> Option<String>) -> Vec<String> {
        let here = self.conditioning_at_home();
        if here >= NEARLY_SINGULAR {
            return told;
        }
        let read = |text: String| {
            let (design, _) = parse_with_cranks(&text, Format::Toml).ok()?;
            Some(design.conditioning_at_home()).filter(|there| *there >= NEARLY_SINGULAR)
        };
        let would = text().and_then(read).map_or_else(String::new, |there| {
            format!(
                ", and {there:.3} with the platform spread counted from the legs of a base pair ({} degrees)",
                rounded(spread, 12)
            )
        });
        told.push(format!("Home is nearly singular: the inverse condition number is {here:.3}{would}."));
        told
    }

    /// The inverse condition number of the legs or rods at home.
    fn conditioning_at_home(&self) -> f64 {
        let home = self.home_or_default();
        let rods = self.rotary().ok().flatten().and_then(|cranks| cranks.at(&cranks.ik(&home).ok()?).ok());
        let legs = rods.as_ref().unwrap_or_else(|| self.manipulator());
        inverse_condition(&jacobian(legs, &home, self.characteristic_length()))
    }
}

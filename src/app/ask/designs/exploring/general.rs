//! Designs that are not octahedral.

use super::{ExploreOptions, ExploreVerdict, NoExploration, OwnPoses};
use crate::equivalents::NearestDesigns;
use crate::{
    AssessReport, ComparedDesigns, Design, MoveSearchReport, MoveTargets, MovedPlatform, ReplaceableLegs,
    ReplaceableOptions, SearchWord,
};
use optimize::offsets::DEFAULT_MIN_ABS_DET;
use synthesis::NearestOptions;
use synthesis::components::ComponentOptions;
use synthesis::relocate::search::MoveSearchOptions;
use verify::VerdictWord;

/// The default limit of a joint's distance beyond a corner of the triangles sought, in lengths of the side. It is wide,
/// since existing triangles are recognised rather than chosen.
pub const NEAREST_EXTENSION: f64 = 1.0;

/// The limits of the nearest octahedral platform of a design.
#[must_use]
pub fn nearest_options(design: &Design, extension: f64) -> NearestOptions {
    NearestOptions { extension, min_abs_det: design.optimize.min_abs_det.unwrap_or(DEFAULT_MIN_ABS_DET) }
}

/// The results for a design that is not octahedral.
#[derive(Debug)]
#[non_exhaustive]
pub struct ExploredDesign {
    /// Its families of replaceable legs.
    pub families: ReplaceableLegs,
    /// Equivalent platforms without shared joints; `None` if the design is singular or no leg can be moved.
    pub moves: Option<MoveSearchReport>,
    /// The limits of the nearest octahedral platform.
    pub limits: NearestOptions,
    /// The nearest octahedral platform, and its equivalent near the design.
    pub near: Option<NearestDesigns>,
    /// Whether this equivalent meets the requirements of the design; `None` without requirements.
    pub assessed: Option<AssessReport>,
    /// The comparison of the design with its equivalent, or of the nearest octahedral platform with its equivalent.
    pub compared: Option<ComparedDesigns>,
    /// Poses of the design.
    pub poses: OwnPoses,
}

impl ExploredDesign {
    pub(super) fn of(design: &Design, mut options: ExploreOptions<'_>) -> Result<Self, NoExploration> {
        let seed = options.seed;
        options.stage(1, "replaceable legs");
        let search = ComponentOptions { seed, ..ComponentOptions::default() };
        let families = design.replaceable_legs(&ReplaceableOptions::all(search))?;

        options.stage(2, "equivalent platforms");
        let found = &families.found;
        let moves = (found.leg_rank.value == 6 && !found.components.is_empty()).then(|| {
            let targets = MoveTargets::default().no_shared_joints(true);
            let options = MoveSearchOptions { seed, ..MoveSearchOptions::default() };
            design.search_moves(found, &targets, &options)
        });
        let moves = moves.transpose()?;

        options.stage(3, "nearest octahedral platform");
        let limits = nearest_options(design, options.extension.unwrap_or(NEAREST_EXTENSION));
        let near = NearestDesigns::of(design, &limits);

        options.stage(4, "requirements");
        let assessed = near.as_ref().and_then(|near| near.beside.assessed(seed));

        options.stage(5, "comparison");
        let chosen = moves.as_ref().and_then(MoveSearchReport::first_other);
        let pair = match (chosen.and_then(|f| f.design.as_ref()), &near) {
            (Some(new), _) => Some([design, new]),
            (None, Some(near)) => Some([&near.octahedral, &near.beside]),
            (None, None) => None,
        };
        let compared =
            pair.map(|pair| ComparedDesigns::of(pair, options.samples, &options.fk())).transpose()?;

        options.stage(6, "forward kinematics");
        let poses = design.own_poses(&options.fk())?;
        Ok(Self { families, moves, limits, near, assessed, compared, poses })
    }

    /// The platform without shared joints that is compared with the design.
    #[must_use]
    pub fn chosen(&self) -> Option<&MovedPlatform> {
        self.moves.as_ref()?.first_other()
    }

    /// The design of that platform.
    #[must_use]
    pub fn equivalent(&self) -> Option<&Design> {
        self.chosen()?.design.as_ref()
    }

    /// Whether the design is architecturally singular; then every platform made of its legs is singular too.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.families.found.leg_rank.value < 6
    }

    /// The verdict: whether an equivalent platform without shared joints exists, other than the design.
    #[must_use]
    pub fn verdict(&self) -> ExploreVerdict {
        let undecided = ExploreVerdict::Compared(VerdictWord::Inconclusive);
        let Some(moves) = &self.moves else {
            return match (self.is_singular(), self.families.found.doubts.is_empty()) {
                (true, _) => ExploreVerdict::Compared(VerdictWord::Singular),
                (false, true) => ExploreVerdict::None,
                (false, false) => undecided,
            };
        };
        match (self.chosen(), &self.compared, moves.word()) {
            (Some(_), Some(compared), _) => ExploreVerdict::Compared(compared.found.verdict.word()),
            (_, _, SearchWord::Violated) => ExploreVerdict::Violated,
            (_, _, SearchWord::Impossible) => ExploreVerdict::None,
            _ => undecided,
        }
    }
}

//! A candidate: the platform for given values of the free quantities, with results that are computed once.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::num::NonZeroUsize;

use super::column::SweepCell;
use super::evaluate::Sweep;
use super::plan::{FreeQuantity, PoseChoice};
use ask::Design;
use ask::equivalents::Original;
use ask::{AssessReport, CheckReport};
use files::design::Drive;
use fk::FkSolutions;
use machine::requirements::AssessOptions;
use num::Purpose;
use platform::geom::Pose;
use platform::manipulator::{LegLengths, Manipulator, SquaredLegLengths};
use synthesis::Pattern;

/// The data derived from the text of a base design.
#[derive(Debug, Clone)]
pub(super) struct Ground {
    pub(super) design: Design,
    /// The octahedral platform, if offsets or patterns vary.
    original: Option<Original>,
    pub(super) home: Pose,
    pub(super) poses: Vec<Pose>,
}

impl Ground {
    /// # Errors
    /// The reason why the design has no equivalents, if they vary.
    pub(super) fn new(design: Design, sweep: &Sweep) -> Result<Self, String> {
        let original = if sweep.has_equivalents() {
            Some(Original::of(&design).ok_or("the design is not octahedral")?)
        } else {
            None
        };
        let home = design.home_or_default();
        let workspace = || design.workspace_or_default();
        let poses = match &sweep.plan.poses {
            PoseChoice::Workspace => workspace().sample(&home),
            PoseChoice::Home => vec![home],
            PoseChoice::Listed(poses) => poses.clone(),
            PoseChoice::Region(points) => {
                let space = workspace().space(&home);
                let mut rng = Purpose::ASSESSED_POSES.rng(sweep.seed);
                space.cube_points(*points, &mut rng).iter().map(|x| space.pose(x)).collect()
            }
        };
        Ok(Self { design, original, home, poses })
    }
}

/// A pattern with values for its offsets.
#[derive(Debug)]
struct PlacedPattern<'a> {
    pattern: &'a Pattern,
    offsets: Vec<f64>,
}

/// A platform of the sweep.
#[derive(Debug)]
pub(super) struct SweepCandidate<'a> {
    sweep: &'a Sweep,
    pub(super) ground: Cow<'a, Ground>,
    /// The values of the free quantities.
    values: &'a [SweepCell],
    placed: Option<PlacedPattern<'a>>,
    /// The drive in all legs; `None`: the data of the design apply.
    pub(super) drive: Option<&'a Drive>,
    /// The manipulator; `None`: the manipulator of the design.
    manipulator: Option<Manipulator>,
    whole: OnceCell<Result<Design, String>>,
    solved: OnceCell<Result<FkSolutions, String>>,
    assessed: OnceCell<Result<AssessReport, String>>,
    checked: OnceCell<Result<CheckReport, String>>,
}

impl<'a> SweepCandidate<'a> {
    /// # Errors
    /// The reason why the values make no platform.
    pub(super) fn new(sweep: &'a Sweep, values: &'a [SweepCell]) -> Result<Self, String> {
        let ground = match &sweep.ground {
            Some(fixed) => Cow::Borrowed(fixed),
            None => Cow::Owned(Ground::new(changed(sweep, values)?, sweep)?),
        };
        let placed = if sweep.has_equivalents() { Some(placed(sweep, values)?) } else { None };
        let manipulator = match (&placed, &ground.original) {
            (Some(p), Some(original)) => {
                Some(p.pattern.instantiate(&original.octahedral, &p.offsets).map_err(|e| e.to_string())?)
            }
            _ => None,
        };
        let drive =
            sweep.plan.quantities().zip(values).find_map(|(quantity, value)| match (quantity, value) {
                (FreeQuantity::Drive, SweepCell::Text(name)) => sweep.base.drive(name),
                _ => None,
            });
        let (whole, solved, assessed, checked) = Default::default();
        Ok(Self { sweep, ground, values, placed, drive, manipulator, whole, solved, assessed, checked })
    }

    pub(super) fn manipulator(&self) -> &Manipulator {
        self.manipulator.as_ref().unwrap_or(self.ground.design.manipulator())
    }

    /// `det A` of the leg map from the base design; `None` for a base design without pattern.
    pub(super) fn determinant(&self) -> Option<f64> {
        let placed = self.placed.as_ref()?;
        placed.pattern.determinant(&placed.offsets).ok()
    }

    /// The characteristic length, common to all candidates, so that their conditioning can be compared.
    pub(super) fn characteristic_length(&self) -> f64 {
        self.ground.design.characteristic_length()
    }

    /// The candidate as a design, with all tables of the base design and its home.
    ///
    /// # Errors
    /// The reason why there is none.
    pub(super) fn design(&self) -> Result<&Design, String> {
        let make = || match (&self.placed, &self.ground.original) {
            (Some(p), Some(original)) => {
                let (mut design, _) =
                    original.equivalent(p.pattern, &p.offsets).map_err(|e| e.to_string())?;
                design.home = Some(self.ground.home);
                Ok(design)
            }
            _ => Ok(self.ground.design.clone()),
        };
        let driven = |design: Design| match self.drive {
            Some(drive) => design.with_drive(drive),
            None => design,
        };
        self.whole.get_or_init(|| make().map(driven)).as_ref().map_err(Clone::clone)
    }

    /// The squared leg lengths of the candidate. Varying lengths come first, then the lengths at a varying pose.
    /// Otherwise the lengths of the design (mapped to the equivalent platform), or the lengths at home.
    ///
    /// # Errors
    /// The reason why there are none.
    pub(super) fn squares(&self) -> Result<SquaredLegLengths, String> {
        let (mut lengths, mut pose) = ([None; 6], [None; 6]);
        for (quantity, value) in self.sweep.plan.quantities().zip(self.values) {
            match quantity {
                FreeQuantity::Length(i) => lengths[*i] = value.as_number(),
                FreeQuantity::Pose(i) => pose[*i] = value.as_number(),
                _ => {}
            }
        }
        let own = self.ground.design.lengths;
        if lengths.iter().any(Option::is_some) {
            let rest = own.map(|l| l.get());
            let all: [f64; 6] =
                std::array::from_fn(|i| lengths[i].or(rest.map(|l| l[i])).unwrap_or(f64::NAN));
            return LegLengths::try_new(all).map(|l| l.squared()).map_err(|e| e.to_string());
        }
        if pose.iter().any(Option::is_some) {
            let home = self.ground.home;
            let angles = home.angles().degrees();
            let all = std::array::from_fn(|i| {
                pose[i].unwrap_or_else(|| if i < 3 { home.position[i] } else { angles[i - 3] })
            });
            return self.squares_at(&super::plan::pose_of(all));
        }
        match (own, &self.placed, &self.ground.original) {
            (Some(own), Some(p), Some(original)) if original.seen.is_none() => {
                let map = p.pattern.leg_map(&original.octahedral, &p.offsets).map_err(|e| e.to_string())?;
                map.apply(&own.squared()).map_err(|e| e.to_string())
            }
            (Some(own), None, _) => Ok(own.squared()),
            _ => self.squares_at(&self.ground.home),
        }
    }

    fn squares_at(&self, pose: &Pose) -> Result<SquaredLegLengths, String> {
        pose.squared_lengths(self.manipulator()).ok_or_else(|| "the leg lengths at the pose overflow".into())
    }

    /// The poses at the lengths of the candidate.
    ///
    /// # Errors
    /// The reason why there is no answer.
    pub(super) fn solved(&self) -> Result<&FkSolutions, String> {
        let make = || {
            let squares = self.squares()?;
            match &self.sweep.solver {
                Some(solver) => solver.solve_squared(&squares).map_err(|e| e.to_string()),
                None => poses_at(self.manipulator(), &squares, self.sweep.seed),
            }
        };
        self.solved.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// # Errors
    /// The reason why there is no answer.
    pub(super) fn assessed(&self) -> Result<&AssessReport, String> {
        let make = || {
            let effort = self.sweep.plan.assess;
            let options = AssessOptions::new()
                .points(effort.points)
                .searches(effort.searches)
                .seed(self.sweep.seed)
                .threads(NonZeroUsize::MIN) // candidates are what threads share
                .close(false);
            self.design()?.assess_with(&options, effort.cells).map_err(|e| e.to_string())
        };
        self.assessed.get_or_init(make).as_ref().map_err(Clone::clone)
    }

    /// # Errors
    /// The reason why there is no answer.
    pub(super) fn checked(&self) -> Result<&CheckReport, String> {
        let make = || self.design()?.check_with(self.sweep.seed).map_err(|e| e.to_string());
        let found = if self.sweep.plan.platform_is_fixed() {
            self.sweep.checked.get_or_init(make)
        } else {
            self.checked.get_or_init(make)
        };
        found.as_ref().map_err(Clone::clone)
    }
}

fn poses_at(m: &Manipulator, squares: &SquaredLegLengths, seed: u64) -> Result<FkSolutions, String> {
    fk::solver(None).solve(m, squares, &fk::FkOptions::new().seed(seed)).map_err(|e| e.to_string())
}

/// The base design with the numbers of the candidate in its text.
fn changed(sweep: &Sweep, values: &[SweepCell]) -> Result<Design, String> {
    let base = &sweep.base;
    let written: Vec<_> = sweep
        .plan
        .quantities()
        .zip(values)
        .filter_map(|(quantity, value)| match quantity {
            FreeQuantity::Number(place) => Some((place.clone(), as_written(value))),
            _ => None,
        })
        .collect();
    let read = base.candidate(&base.with_values(&written));
    read.map_err(|violations| violations.first().map(ToString::to_string).unwrap_or_default())
}

/// A value in the notation that both formats of design files share.
fn as_written(value: &SweepCell) -> String {
    match value {
        SweepCell::Number(x) => format!("{x:?}"),
        SweepCell::Text(text) => serde_json::Value::from(text.as_str()).to_string(),
        other => other.to_string(),
    }
}

/// The pattern of a candidate with the offsets that it uses.
fn placed<'a>(sweep: &'a Sweep, values: &[SweepCell]) -> Result<PlacedPattern<'a>, String> {
    let mut offsets = [None; 6];
    let mut pattern = &sweep.joint_free;
    for (quantity, value) in sweep.plan.quantities().zip(values) {
        match (quantity, value) {
            (FreeQuantity::Offset(i), value) => offsets[*i] = value.as_number(),
            (FreeQuantity::Pattern, SweepCell::Text(name)) => {
                pattern = sweep.patterns.get(name).ok_or_else(|| format!("{name} is no pattern"))?;
            }
            _ => {}
        }
    }
    let offsets = offsets.iter().flatten().copied().take(pattern.offsets).collect();
    Ok(PlacedPattern { pattern: &pattern.pattern, offsets })
}

impl SweepCandidate<'_> {
    /// The text of the candidate as a design file: the text of the base design with changed numbers. An equivalent
    /// platform has a text of its own.
    ///
    /// # Errors
    /// The reason why there is none.
    pub(super) fn text(&self) -> Result<String, String> {
        Ok(match (&self.placed, &self.sweep.ground) {
            (None, None) if self.drive.is_none() => self.ground.design.text(),
            _ => self.design()?.to_toml(),
        })
    }
}

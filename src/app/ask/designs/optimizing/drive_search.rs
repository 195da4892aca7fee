//! The best platform with the best drive of a table: one search for each drive, except for drives that cannot win.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::super::Error;
use super::OptimizeStatus;
use super::platform_search::{FoundPlatform, find_platform};
use crate::Design;
use files::design::{Drive, DriveTable};
use machine::requirements::TermKind;
use optimize::dimensional::{DimensionalOutcome, Progress, ShapeSearchOptions};

/// The criterion for choosing among drives with which the requirements can be met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DriveRanking {
    /// The lowest price, and for equal prices the best value of the first objective; every drive of the table has a
    /// price.
    Price,
    /// The best value of the first objective: some drive of the table has no price.
    Objective,
}

/// A design with a drive, and its search result.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DrivenPlatform {
    /// The design with the drive.
    pub design: Design,
    /// The result of the search with it.
    pub found: FoundPlatform,
}

/// The outcome for a drive.
#[derive(Debug, Clone, PartialEq)]
pub enum DriveOutcome {
    /// The drive was searched.
    Searched(Box<DrivenPlatform>),
    /// Not searched: it costs more than this drive, which can meet the requirements.
    Dearer(String),
    /// Not searched: it is in no respect better than this drive, for which no start met the requirements.
    Weaker(String),
    /// Not searched: the search was interrupted.
    NotTried,
}

/// A drive of the table with its outcome.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SearchedDrive {
    /// The drive.
    pub drive: Drive,
    /// The outcome.
    pub outcome: DriveOutcome,
}

impl SearchedDrive {
    fn searched(&self) -> Option<&DrivenPlatform> {
        match &self.outcome {
            DriveOutcome::Searched(driven) => Some(driven),
            _ => None,
        }
    }

    /// The value of the first objective, greater for better, if the requirements are met.
    fn gain(&self) -> Option<f64> {
        let found = &self.searched()?.found;
        let (objective, value) = found.checked.as_ref().filter(|_| found.is_met())?.objectives.first()?;
        Some(if objective.is_cost() { -value } else { *value })
    }
}

/// The outcomes for all drives of a table.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DriveSearch {
    /// The criterion.
    pub ranking: DriveRanking,
    /// The drives, the best first; drives with which the requirements are met come before the others.
    pub drives: Vec<SearchedDrive>,
    /// The unit of the prices, as in the table.
    pub currency: Option<String>,
    /// Whether the search was interrupted before every drive that could win was tried.
    pub interrupted: bool,
}

impl DriveSearch {
    /// The chosen drive: the best with which the requirements are met.
    #[must_use]
    pub fn chosen(&self) -> Option<&Drive> {
        self.drives.first().filter(|d| d.gain().is_some()).map(|d| &d.drive)
    }

    /// The answer: the platform with the chosen drive, or else with the drive of the best result. `None` if no search
    /// was begun.
    #[must_use]
    pub fn answer(&self) -> Option<&DrivenPlatform> {
        self.drives.iter().find_map(SearchedDrive::searched)
    }
}

/// The limits of a drive minus the safety margins: shortest and longest leg, force, speed, stiffness, and whether its
/// mass counts.
struct DriveRange {
    legs: [f64; 2],
    most: [f64; 2],
    stiffness: Option<f64>,
    mass: Option<f64>,
}

impl DriveRange {
    fn of(design: &Design, drive: &Drive) -> Self {
        let driven = design.with_drive(drive);
        let (required, hardware) = (driven.requirements(), &driven.hardware);
        let (least, greatest) = drive.lengths.range();
        let limit =
            |x: Option<f64>, kind: TermKind| x.map_or(f64::INFINITY, |x| x - required.safety_margin(kind));
        Self {
            legs: [
                least + required.safety_margin(TermKind::MinLegLength),
                greatest - required.safety_margin(TermKind::MaxLegLength),
            ],
            most: [
                limit(hardware.max_leg_force, TermKind::LegForce),
                limit(hardware.max_leg_speed, TermKind::LegSpeed),
            ],
            stiffness: hardware.leg_stiffness,
            mass: hardware.leg_masses.and(drive.mass),
        }
    }

    /// Whether every platform that meets the requirements with the other drive meets them with this one. Each limit of
    /// the other is at least as tight, and the rest (mass, stiffness) is the same.
    fn covers(&self, other: &Self) -> bool {
        let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (None, None) => true,
            (Some(a), Some(b)) => a.total_cmp(&b).is_eq(),
            _ => false,
        };
        self.legs[0] <= other.legs[0]
            && self.legs[1] >= other.legs[1]
            && (0..2).all(|k| self.most[k] >= other.most[k])
            && same(self.stiffness, other.stiffness)
            && same(self.mass, other.mass)
    }
}

/// The order of trials. By price, then mass, so that the first drive that meets the requirements is the answer. Without
/// prices the longest and strongest first, since others cannot do more.
fn order_of_trials(drives: &[Drive], ranking: DriveRanking) -> Vec<&Drive> {
    let mut out: Vec<&Drive> = drives.iter().collect();
    let last = |x: Option<f64>| x.unwrap_or(f64::INFINITY);
    out.sort_by(|a, b| match ranking {
        DriveRanking::Price => {
            last(a.price).total_cmp(&last(b.price)).then(last(a.mass).total_cmp(&last(b.mass)))
        }
        DriveRanking::Objective => {
            b.stroke.total_cmp(&a.stroke).then(last(b.force).total_cmp(&last(a.force)))
        }
    });
    out
}

/// The order of answers. First the drives that meet the requirements, by price and gain. Then the others by the result
/// reached, and last the drives not searched, in the order of the table.
fn order_of_answers(a: &SearchedDrive, b: &SearchedDrive, ranking: DriveRanking) -> Ordering {
    let met = |d: &SearchedDrive| d.gain().is_some();
    let reached = |d: &SearchedDrive| {
        d.searched().map(|s| {
            let conflict = matches!(s.found.report.outcome, DimensionalOutcome::Infeasible(_));
            (s.found.rank(), !conflict)
        })
    };
    let price = |d: &SearchedDrive| d.drive.price.unwrap_or(f64::INFINITY);
    met(b).cmp(&met(a)).then_with(|| match (a.gain(), b.gain()) {
        (Some(x), Some(y)) => match ranking {
            DriveRanking::Price => price(a).total_cmp(&price(b)).then(y.total_cmp(&x)),
            DriveRanking::Objective => y.total_cmp(&x),
        },
        _ => reached(b).cmp(&reached(a)),
    })
}

/// Searches for the best platform of a design with each drive of a table, and ranks the drives.
///
/// A drive is left out if it cannot win. With prices, it loses against a cheaper drive that meets the requirements. It
/// also loses if it is in no respect better than a drive for which no start met the requirements. When `progress` ends
/// the search, the drives tried until then are ranked.
///
/// # Errors
/// The errors of [`Design::optimize_with`].
pub fn search_drives(
    design: &Design,
    table: &DriveTable,
    extension: f64,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(&Drive, Progress) -> ControlFlow<()>,
) -> Result<DriveSearch, Error> {
    let drives = &table.drives[..];
    let priced = drives.iter().all(|d| d.price.is_some());
    let ranking = if priced { DriveRanking::Price } else { DriveRanking::Objective };
    let mut tried: Vec<SearchedDrive> = Vec::new();
    let mut interrupted = false;
    for drive in order_of_trials(drives, ranking) {
        let outcome = if interrupted {
            DriveOutcome::NotTried
        } else if let Some(cheaper) = cheaper(&tried, drive, ranking) {
            DriveOutcome::Dearer(cheaper.name.clone())
        } else if let Some(stronger) = stronger(design, &tried, drive) {
            DriveOutcome::Weaker(stronger.name.clone())
        } else {
            let driven = design.with_drive(drive);
            let found = find_platform(&driven, extension, options, true, &mut |p| progress(drive, p))?;
            interrupted = found.status() == OptimizeStatus::Interrupted;
            DriveOutcome::Searched(Box::new(DrivenPlatform { design: driven, found }))
        };
        tried.push(SearchedDrive { drive: drive.clone(), outcome });
    }
    tried.sort_by(|a, b| order_of_answers(a, b, ranking));
    Ok(DriveSearch { ranking, drives: tried, currency: table.currency.clone(), interrupted })
}

/// A cheaper drive with which the requirements are met.
fn cheaper<'t>(tried: &'t [SearchedDrive], drive: &Drive, ranking: DriveRanking) -> Option<&'t Drive> {
    let costs_less = |d: &&SearchedDrive| {
        let prices = d.drive.price.zip(drive.price);
        d.gain().is_some() && prices.is_some_and(|(less, more)| less < more)
    };
    (ranking == DriveRanking::Price).then(|| tried.iter().find(costs_less))?.map(|d| &d.drive)
}

/// A drive that is at least as good in every respect, and for which no start met the requirements.
fn stronger<'t>(design: &Design, tried: &'t [SearchedDrive], drive: &Drive) -> Option<&'t Drive> {
    let range = DriveRange::of(design, drive);
    let fails = |d: &&SearchedDrive| {
        let searched = d.searched().map(|s| &s.found.report);
        let failed = searched
            .is_some_and(|r| !r.interrupted && matches!(r.outcome, DimensionalOutcome::Infeasible(_)));
        failed && DriveRange::of(design, &d.drive).covers(&range)
    };
    tried.iter().find(fails).map(|d| &d.drive)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::parse;
    use files::design::Format;
    use machine::requirements::LengthLimits;

    fn drive(name: &str, (least, stroke): (f64, f64), force: Option<f64>, price: Option<f64>) -> Drive {
        Drive {
            line: 1,
            name: name.to_owned(),
            stroke,
            lengths: LengthLimits::Range(least, least + stroke),
            force,
            speed: None,
            mass: None,
            stiffness: None,
            price,
            source: None,
        }
    }

    fn bench(limits: &str) -> Design {
        let text = include_str!("../../../../../designs/presets/bench-l16.toml");
        parse(&format!("{text}\n{limits}"), Format::Toml).unwrap().0
    }

    #[test]
    fn a_drive_covers_another_with_tighter_limits_and_safety_margins_count() {
        let wide = drive("wide", (200.0, 100.0), Some(60.0), None);
        let short = drive("short", (200.0, 60.0), Some(60.0), None);
        let free = drive("free", (200.0, 100.0), None, None);
        let covers = |design: &Design, a: &Drive, b: &Drive| {
            DriveRange::of(design, a).covers(&DriveRange::of(design, b))
        };
        let plain = bench("");
        assert!(covers(&plain, &wide, &short) && !covers(&plain, &short, &wide));
        assert!(covers(&plain, &wide, &wide));
        // the force limit of the design applies if the drive has none
        let own = plain.hardware.max_leg_force.unwrap();
        assert_eq!(covers(&plain, &wide, &free), own <= 60.0);
        assert_eq!(covers(&plain, &free, &wide), own >= 60.0);
        // a tenth of the travel is kept free at either end: the short drive starts 4 lower than the wide one
        let reserved = bench("[limits]\nsafety_margin = \"10%\"\n");
        assert!(!covers(&reserved, &wide, &short) && covers(&reserved, &wide, &wide));
    }

    #[test]
    fn the_cheapest_is_tried_first_and_without_prices_the_longest() {
        let list = [
            drive("b", (1.0, 2.0), None, Some(3.0)),
            drive("a", (1.0, 1.0), None, Some(2.0)),
            drive("c", (1.0, 3.0), None, Some(9.0)),
        ];
        let names = |ranking| {
            order_of_trials(&list, ranking).iter().map(|d| d.name.as_str()).collect::<Vec<_>>().join("")
        };
        assert_eq!(
            (names(DriveRanking::Price), names(DriveRanking::Objective)),
            ("abc".into(), "cba".into())
        );
    }
}

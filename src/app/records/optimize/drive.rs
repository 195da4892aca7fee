//! The drives of a table with the search result for each.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ConflictRecord, SymmetryRecord};
use crate::{MarginRecord, Number};
use ask::{DriveOutcome, DriveRanking, DriveSearch, DrivenPlatform, OptimizeStatus, SearchedDrive};
use machine::requirements::TermKind;
use num::shown::rounded;
use optimize::dimensional::DimensionalOutcome;

view! {
    /// The search over the drives of a table.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DriveSearchRecord {
        /// Drive of the answer; null: no drive leads to a platform that is proved to meet the requirements.
        pub chosen: Option<String> = chosen.map(str::to_owned),
        /// Criterion of the choice.
        pub ranked_by: DriveRanking = search.ranking,
        /// Currency of prices; null: the table names none.
        pub currency: Option<String> = search.currency.clone(),
        /// Whether the search was interrupted.
        pub interrupted: bool = search.interrupted,
        /// Result in words.
        pub message: String = message,
        /// Drives, best first.
        pub drives: Vec<SearchedDriveRecord> = drives,
    }
    /// The record of a search over a table.
    pub fn new(search: &DriveSearch) {
        let chosen = search.chosen().map(|d| d.name.as_str());
        let one = |d: &SearchedDrive| SearchedDriveRecord::new(d, chosen, search.ranking);
        let drives: Vec<SearchedDriveRecord> = search.drives.iter().map(one).collect();
        let how = match search.ranking {
            DriveRanking::Price => "the cheapest drive with which the requirements are met",
            DriveRanking::Objective => {
                "the drive with the best first objective among those that meet the requirements (not every drive has a price)"
            }
        };
        let ended = if search.interrupted { "; the search was interrupted" } else { "" };
        let message = match chosen {
            Some(name) => format!("{name} is {how}{ended}"),
            None => format!(
                "no platform found with any of {} drives is proved to meet the requirements{ended}",
                drives.len()
            ),
        };
    }
}

/// A drive of the table in the units of the design, with its search result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SearchedDriveRecord {
    /// The name of the drive.
    pub name: String,
    /// Line of the table, from 1.
    pub line: usize,
    /// Price; null: not in the table.
    pub price: Option<Number>,
    /// Mass; null: not in the table.
    pub mass: Option<Number>,
    /// Least and greatest joint distance, design units.
    pub leg_length: [Number; 2],
    /// Greatest force; null: not in the table.
    pub force: Option<Number>,
    /// Greatest speed; null: not in the table.
    pub speed: Option<Number>,
    /// Outcome.
    pub outcome: DriveSearchWord,
    /// First objective of the platform found; null: no platform was found.
    pub objective: Option<Number>,
    /// Margins against the drive's limits (length, force, speed), for the platform found or the one with the least
    /// violation. Empty: the drive was not searched.
    pub margins: Vec<MarginRecord>,
    /// Result for the three-fold symmetry; null under the same conditions as without a table.
    pub symmetry: Option<SymmetryRecord>,
    /// Reason for rejection, one sentence; null: it is the answer.
    pub reason: Option<String>,
}

/// The outcome for a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DriveSearchWord {
    /// A platform with this drive is proved to meet the requirements.
    Met,
    /// A platform was found, but it violates requirements.
    Violated,
    /// No start led to a platform that meets the requirements.
    Infeasible,
    /// Neither is proved.
    Undecided,
    /// The search was interrupted at this drive.
    Interrupted,
    /// The drive costs more than one that meets the requirements.
    Dearer,
    /// The drive is in no respect better than one for which no start met the requirements.
    Weaker,
    /// The search was interrupted before this drive.
    NotTried,
}

impl DriveSearchWord {
    /// The code of the outcome.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::Violated => "violated",
            Self::Infeasible => "infeasible",
            Self::Undecided => "undecided",
            Self::Interrupted => "interrupted",
            Self::Dearer => "dearer",
            Self::Weaker => "weaker",
            Self::NotTried => "not_tried",
        }
    }

    fn of(driven: &DrivenPlatform) -> Self {
        if driven.found.is_met() {
            return Self::Met;
        }
        match driven.found.status() {
            OptimizeStatus::Violated => Self::Violated,
            OptimizeStatus::Infeasible => Self::Infeasible,
            OptimizeStatus::Interrupted => Self::Interrupted,
            _ => Self::Undecided,
        }
    }
}

/// The requirements that a drive limits.
const OF_DRIVES: [TermKind; 4] =
    [TermKind::MinLegLength, TermKind::MaxLegLength, TermKind::LegForce, TermKind::LegSpeed];

/// The margins of all requirements of the platform found, or of the platform with the least violation.
fn margins(driven: &DrivenPlatform) -> Vec<MarginRecord> {
    let Some(c) = driven.found.checked.as_ref().or(driven.found.nearest.as_ref()) else { return Vec::new() };
    match &c.assessed {
        Some(found) => found.proof.bounds.iter().map(|b| MarginRecord::proved(&c.design, b)).collect(),
        None => MarginRecord::searched(&c.design, &c.assessment),
    }
}

/// The reason why a platform with a drive is no answer.
fn reason(driven: &DrivenPlatform) -> Option<String> {
    let report = &driven.found.report;
    if driven.found.is_met() {
        return None;
    }
    let of = |m: &MarginRecord| {
        let missed = (m.net_margin.0, m.unit.as_str());
        format!("{}: {} {}", m.name.label(), rounded(missed.0, 3), missed.1)
    };
    let missed: Vec<String> =
        margins(driven).iter().filter(|m| m.net_margin.0 < 0.0 && !m.at_limit).map(of).collect();
    let listed = if missed.is_empty() { String::new() } else { format!(": {}", missed.join(", ")) };
    Some(match &report.outcome {
        _ if report.interrupted => "the search was interrupted".to_owned(),
        DimensionalOutcome::Infeasible(c) => {
            let demands = ConflictRecord::new(&driven.design, c).requirements;
            let sentences: Vec<String> = demands.into_iter().map(|g| g.message).collect();
            format!("no start met the requirements together: {}", sentences.join("; "))
        }
        DimensionalOutcome::Undecided(_) => {
            format!(
                "no platform was found that meets the requirements; the nearest one violates some{listed}"
            )
        }
        _ if missed.is_empty() => "not all requirements are proved for the platform found".to_owned(),
        _ => format!("the platform found violates requirements{listed}"),
    })
}

impl SearchedDriveRecord {
    fn new(searched: &SearchedDrive, chosen: Option<&str>, ranking: DriveRanking) -> Self {
        let drive = &searched.drive;
        let (least, greatest) = drive.lengths.range();
        let mut out = Self {
            name: drive.name.clone(),
            line: drive.line,
            price: drive.price.map(Number),
            mass: drive.mass.map(Number),
            leg_length: [Number(least), Number(greatest)],
            force: drive.force.map(Number),
            speed: drive.speed.map(Number),
            outcome: DriveSearchWord::NotTried,
            objective: None,
            margins: Vec::new(),
            symmetry: None,
            reason: None,
        };
        match &searched.outcome {
            DriveOutcome::Searched(driven) => {
                let found = driven.found.checked.as_ref();
                out.outcome = DriveSearchWord::of(driven);
                out.objective = found.and_then(|c| c.objectives.first()).map(|o| Number(o.1));
                out.margins = margins(driven);
                out.margins.retain(|m| OF_DRIVES.contains(&m.name));
                out.symmetry = driven.found.symmetry.map(SymmetryRecord::from);
                out.reason = reason(driven);
                if out.outcome == DriveSearchWord::Met && chosen != Some(&drive.name) {
                    out.reason = Some(match ranking {
                        DriveRanking::Price => "it costs more, or as much with a worse objective".to_owned(),
                        DriveRanking::Objective => "its objective is worse".to_owned(),
                    });
                }
            }
            DriveOutcome::Dearer(other) => {
                out.outcome = DriveSearchWord::Dearer;
                out.reason = Some(format!(
                    "not searched: it costs more than {other}, with which the requirements are met"
                ));
            }
            DriveOutcome::Weaker(other) => {
                out.outcome = DriveSearchWord::Weaker;
                out.reason = Some(format!(
                    "not searched: it is no stronger than {other}, with which no start met the requirements"
                ));
            }
            DriveOutcome::NotTried => {
                out.reason = Some("not searched: the search was interrupted".to_owned());
            }
        }
        out
    }
}

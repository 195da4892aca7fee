//! `equipod equivalents move DESIGN --search`: what was found.

use std::path::Path;

use super::naming::{family_names, moved_design};
use super::wishes::WishArgs;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files;
use crate::app::cli::output::Answer;
use ::files::design::Share;
use ask::Design;
use records::{
    AssessAnswer, CandidateRecord, DesignRecord, DesignRoleWord, HoleRecord, MoveAnswer, MoveSearchAnswer,
    Number, PlacementRecord, SearchWord,
};
use synthesis::LegMapOutcome;
use synthesis::components::{ComponentOptions, Components};
use synthesis::relocate::search::{
    Candidate, Impossibility, LegSource, MoveSearchOptions, Placement, SearchError, SearchOutcome,
    SearchVerdict, Wishes, search,
};
use verify::judge;

/// Searches, and writes the designs found.
pub(super) fn run(
    output: Option<&Path>,
    args: &WishArgs,
    design: &Design,
    options: ComponentOptions,
) -> Result<Answer, Failure> {
    let wishes = args.wishes(design)?;
    let families = super::families(design, options)?;
    let FoundMoves { mut record, designs, exit, .. } =
        platforms(design, &families, &wishes, &args.options(options.seed))?;
    if let Some(folder) = output {
        files::make_folder(folder)?;
        for (k, d) in designs.iter().enumerate() {
            let path = folder.join(format!("{}.toml", k + 1));
            if let Some(d) = d {
                files::write_design(&path, d)?;
                record.paths.push(path.display().to_string());
            }
        }
    }
    let text = sheet::answers::move_search(&record);
    Ok(Answer::new(exit, MoveAnswer::Search(Box::new(record)), text))
}

/// What a search found, with the platforms as designs.
#[derive(Debug)]
pub(in crate::app::cli::commands) struct FoundMoves {
    pub(in crate::app::cli::commands) record: MoveSearchAnswer,
    /// One for each platform of the record; absent where it makes no design.
    pub(in crate::app::cli::commands) designs: Vec<Option<Design>>,
    /// Legs of each platform that are not legs of the design, from 1.
    pub(in crate::app::cli::commands) moved: Vec<Vec<usize>>,
    pub(in crate::app::cli::commands) exit: Exit,
}

/// The equivalent platforms that fulfil the wishes.
pub(in crate::app::cli::commands) fn platforms(
    design: &Design,
    families: &Components,
    wishes: &Wishes,
    options: &MoveSearchOptions,
) -> Result<FoundMoves, Failure> {
    let outcome = search(design.manipulator(), families, wishes, options).map_err(|e| match e {
        SearchError::NearlyDependent(_) => {
            Failure::new(Exit::Inconclusive, "move::nearly_singular_design", e.to_string())
        }
        SearchError::Linalg(_) => Failure::internal(e.to_string()),
        SearchError::Dependent(_) => Failure::refused("move::singular_design", e.to_string())
            .with_help("`equipod check DESIGN` says why"),
        _ => Failure::refused("move::bad_wish", e.to_string()),
    })?;
    let found = judged(design, &outcome, options.seed);
    let record = MoveReport { design, families, outcome: &outcome, found: &found }.record()?;
    let exit = match record.outcome {
        SearchWord::Found => Exit::Yes,
        SearchWord::Impossible | SearchWord::Violated => Exit::No,
        SearchWord::Undecided => Exit::Inconclusive,
    };
    let new = |p: &&Placement| !matches!(p.source, LegSource::Kept(_));
    let numbers = |c: &Candidate| c.placements.iter().filter(new).map(|p| p.leg.get() + 1).collect();
    let moved = found.iter().map(|f| numbers(f.candidate)).collect();
    let designs = found.into_iter().map(|f| f.design).collect();
    Ok(FoundMoves { record, designs, moved, exit })
}

/// A platform of the search with what `assess` says of it.
struct JudgedPlatform<'a> {
    candidate: &'a Candidate,
    /// `None` where the legs make no platform.
    design: Option<Design>,
    /// The relation to the design, decided on the joints of both.
    map: LegMapOutcome,
    /// `None` where nothing is required.
    assessment: Option<AssessAnswer>,
}

impl JudgedPlatform<'_> {
    /// Whether the requirements of the design are met; `Some(true)` where there are none.
    fn met(&self) -> Option<bool> {
        self.assessment.as_ref().map_or(Some(true), |a| a.met)
    }

    /// Every wish, and every requirement proved.
    fn is_fulfilled(&self) -> bool {
        self.candidate.fulfilled && self.met() == Some(true)
    }
}

/// The platforms as designs with their requirements; those that fulfil everything come first, in the order of the
/// search.
fn judged<'a>(design: &Design, outcome: &'a SearchOutcome, seed: u64) -> Vec<JudgedPlatform<'a>> {
    let judge = |candidate: &'a Candidate| {
        let parameters = candidate.placements.iter().flat_map(|p| p.parameters.iter().copied());
        let shares: Vec<Share> = parameters.filter_map(Share::shortest).collect();
        let built = moved_design(design, &candidate.assembled, &shares);
        let assessment = built
            .as_ref()
            .and_then(|d| Some(AssessAnswer::of(d, seed)?.with_role(DesignRoleWord::Equivalent)));
        let on_joints = built.as_ref().and_then(|d| judge(design.manipulator(), d.manipulator()).ok());
        JudgedPlatform {
            candidate,
            design: built,
            map: on_joints.unwrap_or_else(|| candidate.map.clone()),
            assessment,
        }
    };
    let mut found: Vec<JudgedPlatform<'a>> = outcome.candidates.iter().map(judge).collect();
    found.sort_by_key(|f| !f.is_fulfilled());
    for (k, f) in found.iter_mut().enumerate() {
        let words = sheet::answers::wishes_in_words(f.candidate.fulfilled, f.assessment.as_ref());
        if let Some(d) = &mut f.design {
            finish(d, design, f.candidate, k + 1, &words);
        }
    }
    found
}

/// Name, description and lengths of a platform of the search.
fn finish(out: &mut Design, design: &Design, c: &Candidate, number: usize, words: &str) {
    out.name = format!("{}, rearranged {number}", design.name);
    out.description = Some(format!(
        "Equivalent to \"{}\" by equipod {}: det A = {}, {words}",
        design.name,
        env!("CARGO_PKG_VERSION"),
        c.map.determinant
    ));
    let lengths = design.lengths.and_then(|l| c.map.closest.apply(&l.squared()).ok());
    out.lengths = lengths.map(|s| s.lengths());
}

struct MoveReport<'a> {
    design: &'a Design,
    families: &'a Components,
    outcome: &'a SearchOutcome,
    found: &'a [JudgedPlatform<'a>],
}

impl MoveReport<'_> {
    fn source(&self, source: LegSource) -> Result<String, Failure> {
        Ok(match source {
            LegSource::Kept(leg) => leg.to_string(),
            LegSource::Family(k) => {
                let name = family_names(self.design, self.families, k)?;
                name.map_or(format!("family {}", k + 1), |n| format!("family {} {n}", k + 1))
            }
            LegSource::Hole(h) => format!("hole {}", h + 1),
            LegSource::Holes(h, l) => format!("holes {} and {}", h + 1, l + 1),
        })
    }

    /// What came of it, the requirements of the design included.
    fn word(&self) -> (SearchWord, Option<String>) {
        let (word, reason) = SearchWord::of(self.outcome.verdict);
        let wished = || self.found.iter().filter(|f| f.candidate.fulfilled);
        let word = match word {
            SearchWord::Found if wished().any(JudgedPlatform::is_fulfilled) => SearchWord::Found,
            SearchWord::Found if wished().all(|f| f.met() == Some(false)) => SearchWord::Violated,
            SearchWord::Found => SearchWord::Undecided,
            other => other,
        };
        (word, reason)
    }

    /// The verdict in a sentence.
    fn explanation(&self) -> String {
        let o = self.outcome;
        match o.verdict {
            SearchVerdict::Found => {
                let wished = self.found.iter().filter(|f| f.candidate.fulfilled).count();
                let count = self.found.iter().filter(|f| f.is_fulfilled()).count();
                let judged = self.found.iter().any(|f| f.assessment.is_some());
                match self.word().0 {
                    SearchWord::Found if judged => {
                        format!("{count} equivalent platform(s) fulfil every wish and meet the requirements of the design")
                    }
                    SearchWord::Found => format!("{count} equivalent platform(s) fulfil every wish"),
                    SearchWord::Violated => format!(
                        "{wished} equivalent platform(s) fulfil every wish, and each of them violates requirements of the design"
                    ),
                    _ => format!(
                        "{wished} equivalent platform(s) fulfil every wish, and none of them is proved to meet the requirements of the design"
                    ),
                }
            }
            SearchVerdict::Impossible(Impossibility::NoLegAtHole(h)) => format!(
                "impossible, proved: no leg of any equivalent platform ends at hole {} (exact rank; smallest singular value {:.2e})",
                h + 1,
                o.holes[h].singular_value
            ),
            SearchVerdict::Impossible(Impossibility::PartnersAtInfinity(h)) => {
                format!("impossible: the other end of every leg at hole {} is at infinity", h + 1)
            }
            SearchVerdict::Impossible(Impossibility::NotByThoseLegs(h)) => {
                format!("impossible: a leg at hole {} can replace none of the legs of that joint", h + 1)
            }
            SearchVerdict::Impossible(Impossibility::SharedJoints(least)) => format!(
                "impossible: every equivalent platform has at least {least} shared joint(s): all replaceable legs are known, and six independent \
                 ones always share that many"
            ),
            SearchVerdict::Impossible(Impossibility::HolesTogether) => {
                "impossible: all replaceable legs are known, and no six independent ones have ends at all the holes".to_string()
            }
            SearchVerdict::Undecided => format!(
                "undecided: no platform with every wish was found in {} of {} pattern(s) of legs, which proves nothing",
                o.searched, o.patterns
            ),
        }
    }

    fn record(&self) -> Result<MoveSearchAnswer, Failure> {
        let o = self.outcome;
        let (outcome, reason) = self.word();
        let candidates = self.found.iter().map(|f| self.candidate(f));
        Ok(MoveSearchAnswer {
            name: self.design.name.clone(),
            mode: "search".into(),
            outcome,
            reason,
            explanation: self.explanation(),
            patterns: o.patterns,
            patterns_searched: o.searched,
            least_shared_joints: o.least_shared,
            complete: o.complete,
            wishes: (&o.wishes).into(),
            holes: o.holes.iter().map(HoleRecord::from).collect(),
            designs: candidates.collect::<Result<_, _>>()?,
            paths: Vec::new(),
        })
    }

    fn candidate(&self, f: &JudgedPlatform<'_>) -> Result<CandidateRecord, Failure> {
        let c = f.candidate;
        let place = |p: &Placement| {
            let k = p.leg.get();
            Ok(PlacementRecord {
                leg: k + 1,
                from: self.source(p.source)?,
                parameters: p.parameters.iter().copied().map(Number).collect(),
                to: (&c.assembled.legs[k]).into(),
                coefficient: Number(c.map.closest.a[(k, k)]),
                residual: Number(c.map.residuals[k]),
            })
        };
        Ok(CandidateRecord {
            fulfilled: f.is_fulfilled(),
            wishes_fulfilled: c.fulfilled,
            assessment: f.assessment.clone(),
            worst: Number(c.worst),
            shared_joints: c.shared_joints,
            margins: c.margins.clone(),
            moves: c.placements.iter().map(place).collect::<Result<_, Failure>>()?,
            map: (&f.map).into(),
            design: f.design.as_ref().map(DesignRecord::from),
        })
    }
}

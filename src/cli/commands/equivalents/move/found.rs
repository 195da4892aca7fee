//! `equipod equivalents move DESIGN --search`: what was found.

use std::fmt::Write as _;
use std::path::Path;

use super::naming::{family_names, moved_design};
use super::wishes::WishArgs;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cli::output::Answer;
use crate::design::Design;
use crate::records::{
    CandidateRecord, DesignRecord, HoleRecord, MoveAnswer, MoveSearchAnswer, Number, PlacementRecord,
    SearchWord, WishMarginRecord,
};
use crate::synthesis::components::{ComponentOptions, Components};
use crate::synthesis::relocate::search::{
    Candidate, Impossibility, LegSource, MoveSearchOptions, Placement, SearchError, SearchOutcome,
    SearchVerdict, Wishes, search,
};

/// Searches, and writes the designs found.
pub(super) fn run(
    output: Option<&Path>,
    args: &WishArgs,
    design: &Design,
    options: ComponentOptions,
) -> Result<Answer, Failure> {
    let wishes = args.wishes(design)?;
    let families = super::families(design, options)?;
    let Found { mut record, designs, exit, .. } =
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
    let text = text(&record);
    Ok(Answer::new(exit, MoveAnswer::Search(Box::new(record)), text))
}

/// What a search found, with the platforms as designs.
#[derive(Debug)]
pub(in crate::cli::commands) struct Found {
    pub(in crate::cli::commands) record: MoveSearchAnswer,
    /// One for each platform of the record; absent where it makes no design.
    pub(in crate::cli::commands) designs: Vec<Option<Design>>,
    /// Legs of each platform that are not legs of the design, from 1.
    pub(in crate::cli::commands) moved: Vec<Vec<usize>>,
    pub(in crate::cli::commands) exit: Exit,
}

/// The equivalent platforms that fulfil the wishes.
pub(in crate::cli::commands) fn platforms(
    design: &Design,
    families: &Components,
    wishes: &Wishes,
    options: &MoveSearchOptions,
) -> Result<Found, Failure> {
    let outcome = search(design.manipulator(), families, wishes, options).map_err(|e| match e {
        SearchError::Linalg(_) => Failure::internal(e.to_string()),
        SearchError::Dependent(_) => Failure::refused("move::singular_design", e.to_string())
            .with_help("`equipod check DESIGN` says why"),
        _ => Failure::refused("move::bad_wish", e.to_string()),
    })?;
    let designs: Vec<Option<Design>> =
        outcome.candidates.iter().enumerate().map(|(k, c)| built(design, c, k + 1)).collect();
    let exit = match outcome.verdict {
        SearchVerdict::Found => Exit::Yes,
        SearchVerdict::Impossible(_) => Exit::No,
        SearchVerdict::Undecided => Exit::Inconclusive,
    };
    let record = MoveReport { design, families, outcome: &outcome }.record(&designs)?;
    let new = |p: &&Placement| !matches!(p.source, LegSource::Kept(_));
    let numbers = |c: &Candidate| c.placements.iter().filter(new).map(|p| p.leg.get() + 1).collect();
    let moved = outcome.candidates.iter().map(numbers).collect();
    Ok(Found { record, designs, moved, exit })
}

/// A platform of the search as a design.
fn built(design: &Design, c: &Candidate, number: usize) -> Option<Design> {
    let mut out = moved_design(design, &c.assembled)?;
    out.name = format!("{}, rearranged {number}", design.name);
    let wishes = if c.fulfilled { "wishes fulfilled" } else { "not all wishes fulfilled" };
    out.description = Some(format!(
        "Equivalent to \"{}\" by equipod {}: det A = {}, {wishes}",
        design.name,
        env!("CARGO_PKG_VERSION"),
        c.map.determinant
    ));
    let lengths = design.lengths.and_then(|l| c.map.closest.apply(&l.squared()).ok());
    out.lengths = lengths.map(|s| s.lengths());
    Some(out)
}

struct MoveReport<'a> {
    design: &'a Design,
    families: &'a Components,
    outcome: &'a SearchOutcome,
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

    /// The verdict in a sentence.
    fn explanation(&self) -> String {
        let o = self.outcome;
        match o.verdict {
            SearchVerdict::Found => {
                let count = o.candidates.iter().filter(|c| c.fulfilled).count();
                format!("{count} equivalent platform(s) fulfil every wish")
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

    fn record(&self, designs: &[Option<Design>]) -> Result<MoveSearchAnswer, Failure> {
        let o = self.outcome;
        let (outcome, reason) = SearchWord::of(o.verdict);
        let candidates = o.candidates.iter().zip(designs).map(|(c, d)| self.candidate(c, d.as_ref()));
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

    fn candidate(&self, c: &Candidate, design: Option<&Design>) -> Result<CandidateRecord, Failure> {
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
            fulfilled: c.fulfilled,
            worst: Number(c.worst),
            shared_joints: c.shared_joints,
            margins: c.margins.iter().map(WishMarginRecord::from).collect(),
            moves: c.placements.iter().map(place).collect::<Result<_, Failure>>()?,
            map: (&c.map).into(),
            design: design.map(DesignRecord::from),
        })
    }
}

fn text(r: &MoveSearchAnswer) -> String {
    let mut text = format!("{}\n", r.explanation);
    let _ = writeln!(
        text,
        "{} patterns of six independent legs, {} searched; fewest shared joints {}{}",
        r.patterns,
        r.patterns_searched,
        r.least_shared_joints.map_or("unknown".to_string(), |n| n.to_string()),
        if r.complete { "" } else { " (the list of replaceable legs is not proved complete)" }
    );
    for (k, c) in r.designs.iter().enumerate() {
        let _ = writeln!(
            text,
            "\n{}. {}, det A = {:.6}, sigma_min/sigma_max of A {:.3e}, shared joints {}",
            k + 1,
            if c.fulfilled { "every wish fulfilled" } else { "not every wish fulfilled" },
            c.map.determinant.0,
            c.map.inverse_condition.0,
            c.shared_joints
        );
        for m in &c.margins {
            let _ = writeln!(
                text,
                "   {:<13} {:>12.6}  required {:>12.6}  slack {:>9.5}",
                m.wish, m.value.0, m.required.0, m.slack.0
            );
        }
        for p in &c.moves {
            let (a, b) = (p.to.base.map(|x| x.0), p.to.platform.map(|x| x.0));
            let _ = writeln!(
                text,
                "   leg {}  {}  [{:.6}, {:.6}, {:.6}] - [{:.6}, {:.6}, {:.6}]",
                p.leg, p.from, a[0], a[1], a[2], b[0], b[1], b[2]
            );
        }
    }
    for path in &r.paths {
        let _ = writeln!(text, "wrote {path}");
    }
    text
}

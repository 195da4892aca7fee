//! Margins of the requirements of a design; this table leads every answer that assesses a design.

use super::limits::named;
use super::poses::{POSE, place, pose, units};
use crate::figure::figure;
use crate::{Cell, Sheet, Table, Tone, left, right};
use machine::requirements::{MarginVerdict, TermKind};
use records::{AssessAnswer, MarginRecord, RangeRecord, StatedPosesWord, TravelRecord};
use synthesis::singularity::RegularityWord;

/// The answer of `assess`: the verdict, the numbers that decide, the table, and what is assumed.
#[must_use]
pub fn assess(found: &AssessAnswer) -> Sheet {
    let mut sheet = Sheet::new();
    sheet.line(sentence(found));
    key_numbers(&mut sheet, found);
    sheet.space();
    sheet.table(requirements_table(Some(found), &[]));
    sheet.space();
    ranges(&mut sheet, found);
    sheet.line("A margin below 0 is a violation (!); = marks a margin of 0 to rounding, which is met.");
    sheet.line("The proved margin is a lower bound over the poses assessed; the least margin was found at the worst pose.");
    if found.workspace == StatedPosesWord::None {
        sheet.line("Home alone was assessed: state [workspace] for a verdict about the machine.");
    } else if found.met.is_none() {
        sheet.line(
            "Poses between the sampled ones may violate the unproved requirements; more --cells may prove them.",
        );
    }
    sheet.add(assumptions(found));
    sheet
}

/// The free part of each range of a single coordinate.
fn ranges(sheet: &mut Sheet, found: &AssessAnswer) {
    if found.ranges.is_empty() {
        return;
    }
    sheet.line("Ranges of single coordinates from home, and the part that is free (computed in doubles):\n");
    let side = |title: &str| [right(title, 9), right("free to", 9).gap(2), left("limited by", 0).gap(2)];
    let columns = [left("coordinate", 10)].into_iter().chain(side("minimum")).chain(side("maximum"));
    let end = |stated: f64, free: &TravelRecord| {
        let limit = free.binds.as_ref().map_or_else(|| "nothing".to_owned(), named);
        // the whole side of a range is zero if home is its end
        [figure(stated), figure(free.value + 0.0), limit]
    };
    let row = |range: &RangeRecord| {
        let sides = end(range.min, &range.back).into_iter().chain(end(range.max, &range.forth));
        [range.coordinate.trim_end_matches("_deg").to_owned()]
            .into_iter()
            .chain(sides)
            .chain([range.unit.clone()])
            .collect::<Vec<_>>()
    };
    sheet.table(Table::new(columns.chain([left("unit", 0)])).with_rows(found.ranges.iter().map(row)));
    sheet.space();
}

/// The tightest requirement, singular poses, conditioning and the lightest drive, a line each.
fn key_numbers(sheet: &mut Sheet, found: &AssessAnswer) {
    if let Some(t) = &found.tightest {
        let margin = found.requirements.iter().find(|m| m.name == t.name);
        let margin = margin.map_or_else(String::new, |m| format!("{} {}, ", figure(m.margin.0), m.unit));
        let share = figure(100.0 * t.share.0);
        let whole = match t.name {
            TermKind::MinLegLength | TermKind::MaxLegLength => "the travel",
            TermKind::MinRodLength | TermKind::MaxRodLength => "the rod's length",
            TermKind::CrankAngle => "half the range",
            _ => "its limit",
        };
        say!(sheet, "Tightest requirement: {} (margin {margin}{share} % of {whole}).", t.name.label());
    }
    let said = &found.regular_explanation;
    let at = format!("{}{}", place(found.regular.pose.as_ref()), units(&found.length_unit, "deg"));
    sheet.line(match found.regular.status {
        RegularityWord::Proved => format!("{said}."),
        RegularityWord::ChangesSign => format!("{said}, {POSE} = {at}."),
        RegularityWord::Undecided => format!("{said}; undecided near {POSE} = {at}."),
    });
    if let Some(d) = &found.lightest_drive {
        say!(sheet, "{}.", d.message);
    }
}

/// The verdict in a line, and the place with all margins: a command, or a page.
#[must_use]
pub fn verdict(name: &str, found: Option<&AssessAnswer>, place: &str) -> Sheet {
    let mut sheet = Sheet::new();
    match found {
        Some(found) => {
            sheet.line(sentence(found));
            say!(sheet, "Margins and worst poses: {place}");
        }
        None => no_requirements(&mut sheet, name),
    }
    sheet
}

fn no_requirements(sheet: &mut Sheet, name: &str) {
    say!(
        sheet,
        "{name} has no requirements: the file limits no length, joint angle, clearance, force or speed"
    );
}

/// The sentence, the table and what is assumed; a design without requirements gets one line.
#[must_use]
pub fn requirements(name: &str, found: Option<&AssessAnswer>) -> Sheet {
    let Some(found) = found else {
        let mut sheet = Sheet::new();
        no_requirements(&mut sheet, name);
        return sheet;
    };
    let mut sheet = requirements_without_assumptions(found);
    sheet.add(assumptions(found));
    sheet
}

/// The verdict and the table.
#[must_use]
pub fn requirements_without_assumptions(found: &AssessAnswer) -> Sheet {
    let mut sheet = Sheet::new();
    sheet.line(sentence(found));
    sheet.space();
    sheet.table(requirements_table(Some(found), &[]));
    sheet
}

/// The assumptions of the answer.
#[must_use]
pub fn assumptions(found: &AssessAnswer) -> Sheet {
    assumed(&found.assumptions)
}

/// The assumptions of an answer, a line for each sentence at its end.
pub(super) fn assumed(sentences: &[String]) -> Sheet {
    let mut sheet = Sheet::new();
    if !sentences.is_empty() {
        sheet.line("Assumed:");
        for sentence in sentences {
            say!(sheet, "  {sentence}");
        }
    }
    sheet
}

/// The verdict in a sentence that names the violated requirements.
#[must_use]
pub fn sentence(found: &AssessAnswer) -> String {
    format!("{} {}", found.name, found.explanation)
}

/// A platform at one pose: its margins are a column of the table.
#[derive(Debug, Clone)]
pub struct MarginsAtPose<'a> {
    /// The title of the column.
    pub title: &'a str,
    /// The least margin of each kind of requirement at the pose.
    pub margins: Vec<MarginRecord>,
    /// The conditioning at the pose.
    pub inverse_condition: f64,
}

/// The table of an answer: a row for each kind of requirement with the critical pose and legs, then singularity and
/// conditioning. Each platform of `here` adds a column; without an answer these columns are all.
#[must_use]
pub fn requirements_table(found: Option<&AssessAnswer>, here: &[MarginsAtPose<'_>]) -> Table {
    // a column for the safety margin, if the design requires one on any limit
    let with_margin = found.is_some_and(|f| f.requirements.iter().any(|m| m.safety_margin.0 > 0.0));
    let mut columns = vec![left("requirement", 17)];
    if found.is_some() {
        columns.extend([left("status", 9).gap(2), right("least margin", 0).gap(2)]);
        columns.extend(with_margin.then(|| right("after safety margin", 0).gap(2).minor()));
        columns.push(right("proved margin", 0).gap(2).minor());
    }
    columns.push(left("unit", 0));
    if let Some(found) = found {
        columns.extend([
            left("binds at", 0).gap(2).minor(),
            left(format!("worst pose {POSE}{}", units(&found.length_unit, "deg")), 0).gap(2).minor(),
        ]);
    }
    columns.extend(here.iter().map(|at| left(at.title, 0).gap(2)));
    let mut table = Table::new(columns);

    // `over`: status, least margin, margin minus the safety margin, proved margin, legs or joints, pose
    let mut row = |name: &str, over: [Cell; 6], unit: &str, here: Vec<Cell>| {
        let [status, margin, after_safety_margin, proved, of, pose] = over;
        let mut cells = vec![name.into()];
        if found.is_some() {
            cells.extend(
                [status, margin]
                    .into_iter()
                    .chain(with_margin.then_some(after_safety_margin))
                    .chain([proved]),
            );
        }
        cells.push(unit.into());
        if found.is_some() {
            cells.extend([of, pose]);
        }
        table.row(cells.into_iter().chain(here));
    };
    let over = found.map_or(&[][..], |f| &f.requirements);
    let mut kinds: Vec<TermKind> = Vec::new();
    for m in over.iter().chain(here.iter().flat_map(|at| &at.margins)) {
        if !kinds.contains(&m.name) {
            kinds.push(m.name);
        }
    }
    let none = || Cell::from("-");
    for kind in kinds {
        let of = |margins: &'_ [MarginRecord]| margins.iter().find(|m| m.name == kind).cloned();
        let whole = of(over);
        let single: Vec<_> = here.iter().map(|at| of(&at.margins)).collect();
        let unit =
            whole.iter().chain(single.iter().flatten()).map(|m| m.unit.clone()).next().unwrap_or_default();
        let at_poses = single.iter().map(|m| m.as_ref().map_or_else(none, margin_at_pose)).collect();
        row(
            kind.label(),
            whole.as_ref().map_or_else(|| std::array::from_fn(|_| none()), over_poses),
            &unit,
            at_poses,
        );
    }
    let Some(found) = found else { return table };
    // rows without a margin: the sign of det J, and the conditioning, which has no limit
    let (tone, status) = match found.regular.status {
        RegularityWord::Proved => (Tone::Yes, "met"),
        RegularityWord::ChangesSign => (Tone::No, "violated"),
        RegularityWord::Undecided => (Tone::Open, "undecided"),
    };
    let at = found.regular.pose.as_ref();
    let over =
        [Cell::toned(status, tone), none().at(at), none(), none(), "sign of det J".into(), place(at).into()];
    row("no singular pose", over, "", here.iter().map(|_| none()).collect());
    let c = &found.conditioning;
    let of = "1 at best, 0 at a singular pose";
    let value = Cell::from(figure(c.inverse_condition.0)).at(Some(&c.pose));
    let over = ["no limit".into(), value, none(), none(), of.into(), pose(&c.pose).into()];
    row("conditioning", over, "", here.iter().map(|at| figure(at.inverse_condition).into()).collect());
    table
}

/// The cells of a requirement over all poses assessed.
fn over_poses(m: &MarginRecord) -> [Cell; 6] {
    let (tone, margin) = match () {
        () if m.at_limit => (Tone::AtLimit, 0.0),
        () if m.violates() => (Tone::No, m.margin.0),
        () => (Tone::of(m.met), m.margin.0),
    };
    let proved = match m.proved_margin.0 {
        x if m.status == MarginVerdict::AtLimit || x == 0.0 => figure(0.0),
        x if x.is_finite() => figure(x),
        _ => "none".into(),
    };
    let tone_after = if m.safety_margin_kept == Some(false) { Tone::No } else { Tone::Plain };
    [
        Cell::toned(m.status.label(), tone),
        Cell::from(figure(margin)).at(m.pose.as_ref()),
        Cell::toned(figure(m.net_margin.0), tone_after),
        proved.into(),
        m.between.join(", ").into(),
        place(m.pose.as_ref()).into(),
    ]
}

/// The margin at a single pose with its legs or joints.
fn margin_at_pose(m: &MarginRecord) -> Cell {
    let number = if m.at_limit { "0, at the limit".to_owned() } else { figure(m.margin.0) };
    toned(m, format!("{number} ({})", m.between.join(", ")))
}

/// A cell whose tone says whether the margin is met.
pub(super) fn toned(margin: &MarginRecord, text: impl Into<String>) -> Cell {
    let tone = match () {
        () if margin.at_limit => Tone::AtLimit,
        () if margin.violates() => Tone::No,
        () => Tone::Plain,
    };
    Cell::toned(text, tone)
}

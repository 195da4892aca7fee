//! Random problems: solved, validated and timed, or disturbed by noise.

use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use ask::bench::{ErrorStatistics, RawReport};
use records::{BenchAnswer, BenchClassRecord, Histogram, NoiseRowRecord};

/// The greatest number of failures listed for people; JSON has all of them.
const LISTED: usize = 20;

/// The answer of `bench` with this seed.
#[must_use]
pub fn bench(answer: &BenchAnswer, seed: u64) -> Sheet {
    match answer {
        BenchAnswer::One(one) => classes(std::slice::from_ref(&one.class), seed),
        BenchAnswer::Several(several) => classes(&several.rows, seed),
        BenchAnswer::Noise(found) => noise(&found.rows),
    }
}

fn classes(rows: &[BenchClassRecord], seed: u64) -> Sheet {
    let mut out = Sheet::from(counts(rows));
    let Some(references) = rows.first().map(|row| row.counts.reference_us) else { return out };
    say!(
        out,
        "references by faer: QZ of a random 69 x 69 pair {:.0} us, eigenvalues of a random 40 x 40 matrix {:.0} us",
        references.qz69,
        references.eig40
    );
    for r in rows {
        say!(
            out,
            "{}: {}; solve {:.0} us, certify {:.0} us, validate {:.0} us; {:.1} s",
            r.counts.class,
            errors(&r.epsilon),
            r.split_us.solve,
            r.split_us.certify,
            r.split_us.validate,
            r.total_s.0
        );
        say!(out, "  finite: {}  real: {}", line(&r.finite_counts), line(&r.real_counts));
        if let Some(raw) = &r.raw {
            before_refinement(&mut out, raw);
        }
        for f in r.failures.iter().take(LISTED) {
            let claimed = f.found + f.spurious + f.false_certificates > 0;
            say!(
                out,
                "  {} --class {} --seed {} --first {}: missed {}, spurious {}, false certificates {}, found {} of {}; {}",
                if claimed { "WRONG" } else { "NO ANSWER" },
                r.counts.class,
                seed,
                f.problem,
                f.missed,
                f.spurious,
                f.false_certificates,
                f.found,
                r.expected_count,
                f.solver
            );
        }
        if r.failures.len() > LISTED {
            say!(out, "  and {} more, see --json", r.failures.len() - LISTED);
        }
        if let Some(decimals) = r.decimals {
            open(&mut out, r, decimals, seed);
        }
    }
    out
}

/// Rounded designs whose poses are not proved to be all.
fn open(out: &mut Sheet, r: &BenchClassRecord, decimals: u32, seed: u64) {
    for o in r.open.iter().take(LISTED) {
        say!(
            out,
            "  OPEN --class {} --decimals {decimals} --seed {seed} --first {}: {}",
            r.counts.class,
            o.problem,
            o.solver
        );
    }
    if r.open.len() > LISTED {
        say!(out, "  and {} more, see --json", r.open.len() - LISTED);
    }
}

fn errors(e: &ErrorStatistics) -> String {
    if !e.median.is_finite() {
        return "no roots".to_owned();
    }
    let shares = [e.above_minus_5, e.above_minus_6].map(|share| 100.0 * share);
    format!(
        "error metric median {:.2} mean {:.2} max {:.2}, above -5 {:.2} %, above -6 {:.2} %",
        e.median, e.mean, e.max, shares[0], shares[1]
    )
}

/// The candidates of a published elimination.
fn before_refinement(out: &mut Sheet, raw: &RawReport) {
    let zeros = raw.matrix.zeros.map(|zeros| format!(", {:.1} % zeros", 100.0 * zeros));
    say!(
        out,
        "  elimination: matrix {} x {}{}, {} candidates; {} refused, {} with fewer than 40 finite candidates",
        raw.matrix.rows,
        raw.matrix.columns,
        zeros.unwrap_or_default(),
        raw.candidates,
        raw.refused,
        raw.infinite
    );
    let steps = raw.steps.iter().map(|s| {
        let library = s.library.map(|name| format!(" ({name})")).unwrap_or_default();
        format!("{}{library} {:.0} us", s.step.replace('_', " "), s.median_us)
    });
    let Some(e) = raw.epsilon else { return };
    say!(out, "  steps: {}", steps.collect::<Vec<_>>().join(", "));
    say!(out, "  before refinement: {}", errors(&e));
    if let Some(gap) = raw.gap {
        say!(
            out,
            "  residual 40 over residual 41: decimal logarithm, median {:.2} mean {:.2}",
            gap.median,
            gap.mean
        );
    }
    let bins = raw.bins.iter().map(|b| format!("{:.1}: {}", b.from, b.count));
    say!(out, "  error metric from: {}", bins.collect::<Vec<_>>().join(", "));
}

/// The counts, one row for each class.
fn counts(rows: &[BenchClassRecord]) -> Table {
    let numbers = [
        ("count", 7),
        ("poses", 5),
        ("complete", 8),
        ("certified", 9),
        ("proved", 7),
        ("all real", 8),
        ("missed", 6),
        ("spurious", 8),
        ("false certificates", 5),
        ("median us", 10),
        ("p99 us", 10),
        ("residual", 8),
    ];
    let columns = numbers.map(|(title, width)| right(title, width));
    let mut table = Table::new([left("class", 14)].into_iter().chain(columns));
    for r in rows {
        let c = &r.counts;
        table.row([
            c.class.clone(),
            c.count.to_string(),
            r.expected_count.to_string(),
            c.complete.to_string(),
            c.certified.to_string(),
            r.proved.to_string(),
            r.proved_bounded.to_string(),
            c.missed_roots.to_string(),
            c.spurious_roots.to_string(),
            c.false_certificates.to_string(),
            figure(c.median_us.0),
            figure(c.p99_us.0),
            format!("{:.1e}", c.worst_residual.0),
        ]);
    }
    table
}

fn line(counts: &Histogram) -> String {
    let parts: Vec<String> = counts.0.iter().map(|(n, problems)| format!("{n}: {problems}")).collect();
    parts.join(", ")
}

/// Pose errors divided by errors of leg lengths, one row for each class and level.
fn noise(rows: &[NoiseRowRecord]) -> Sheet {
    let quartiles = ["rot 25%", "50%", "75%", "99%", "pos 25%", "50%", "75%", "99%"];
    let columns = [left("class", 14), right("sigma", 7), right("no pose", 7)].into_iter();
    let mut table = Table::new(columns.chain(quartiles.map(|title| right(title, 9))));
    for (row, level) in rows.iter().flat_map(|row| row.levels.iter().map(move |level| (row, level))) {
        let errors = [&level.rotation, &level.position].map(|spread| match spread {
            Some(s) => [s.lower_quartile, s.median, s.upper_quartile, s.p99].map(|x| format!("{x:.2e}")),
            None => ["-"; 4].map(str::to_owned),
        });
        let begin = [row.class.clone(), format!("{:.0e}", level.sigma), level.without_pose.to_string()];
        table.row(begin.into_iter().chain(errors.into_iter().flatten()));
    }
    let mut out = Sheet::from(table);
    out.line("radians; angle of the rotation, angle of the positions, to the nearest real pose");
    out
}

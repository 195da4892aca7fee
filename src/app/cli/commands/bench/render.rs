//! The table of a run.

use std::fmt::Write as _;

use ask::bench::ReferenceTimes;
use records::{BenchClassRecord, Histogram};

/// Most failures listed for people; JSON has them all.
const LISTED: usize = 20;

/// What people read.
pub(super) fn text(rows: &[BenchClassRecord], references: &ReferenceTimes, seed: u64) -> String {
    let mut out = format!(
        "{:<14} {:>7} {:>5} {:>8} {:>9} {:>7} {:>6} {:>8} {:>5} {:>10} {:>10} {:>8}\n",
        "class",
        "count",
        "poses",
        "complete",
        "certified",
        "proved",
        "missed",
        "spurious",
        "false",
        "median us",
        "p99 us",
        "residual"
    );
    for r in rows {
        let c = &r.counts;
        let _ = writeln!(
            out,
            "{:<14} {:>7} {:>5} {:>8} {:>9} {:>7} {:>6} {:>8} {:>5} {:>10.1} {:>10.1} {:>8.1e}",
            c.class,
            c.count,
            r.expected_count,
            c.complete,
            c.certified,
            r.proved,
            c.missed_roots,
            c.spurious_roots,
            c.false_certificates,
            c.median_us.0,
            c.p99_us.0,
            c.worst_residual.0
        );
    }
    let _ = writeln!(
        out,
        "references: QZ of a random 69 x 69 pair {:.0} us, eigenvalues of a random 40 x 40 matrix {:.0} us",
        references.qz69, references.eig40
    );
    for r in rows {
        let e = r.epsilon;
        let _ = writeln!(
            out,
            "{}: error metric median {:.2} mean {:.2} max {:.2}, above -5 {:.2} %, above -6 {:.2} %; \
             solve {:.0} us, certify {:.0} us, validate {:.0} us; {:.1} s",
            r.counts.class,
            e.median,
            e.mean,
            e.max,
            100.0 * e.above_minus_5,
            100.0 * e.above_minus_6,
            r.split_us.solve,
            r.split_us.certify,
            r.split_us.validate,
            r.total_s.0
        );
        let _ = writeln!(out, "  finite: {}  real: {}", line(&r.finite_counts), line(&r.real_counts));
        for f in r.failures.iter().take(LISTED) {
            let _ = writeln!(
                out,
                "  WRONG --class {} --seed {} --first {}: missed {}, spurious {}, false certificates {}, found {} of {}; {}",
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
            let _ = writeln!(out, "  and {} more, see --json", r.failures.len() - LISTED);
        }
    }
    out
}

fn line(counts: &Histogram) -> String {
    let parts: Vec<String> = counts.0.iter().map(|(n, problems)| format!("{n}: {problems}")).collect();
    parts.join(", ")
}

//! `equipod sweep run`: the candidates of a plan, or one shard of them.

#![allow(clippy::cast_sign_loss, reason = "only shares of counts are cast")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::app::cli::diagnostic;
use crate::app::cli::progress::{Interrupt, ProgressLine};
use crate::app::cli::sweep_folder::{
    MOST_SHARDS, PartCheck, ShardState, SweepFolder, SweepTexts, default_shards,
};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath};
use fk::Threads;
use num::{Cancel, Purpose};
use records::{SweepColumnRecord, SweepEstimateAnswer, SweepRunAnswer};
use sweep::{Sweep, shard_range};

/// Arguments of `sweep run`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepRunArgs {
    /// Plan (.toml or .json)
    plan: PathBuf,
    /// Folder of the parts; a sweep of the same plan is continued
    #[arg(short, long, value_name = "DIR", required_unless_present = "estimate")]
    output: Option<OutputPath>,
    /// Compute only shard I of N, from 0 (N/N is 0/N)
    #[arg(long, value_name = "I/N", conflicts_with = "shards")]
    shard: Option<ShardNumber>,
    /// Offset added to the shard's number, for clusters with limited array numbers
    #[arg(long, value_name = "K", requires = "shard", default_value_t = 0)]
    shard_offset: u64,
    /// Number of shards; default 16, or more for more than 1.6 million candidates
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_SHARDS))]
    shards: Option<u64>,
    /// Worker threads; default: one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Compute a sample only, and estimate time and columns
    #[arg(long)]
    estimate: bool,
}

/// `--shard`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ShardNumber {
    shard: u64,
    shards: u64,
}

impl std::str::FromStr for ShardNumber {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = || format!("`{text}` is not a shard: write I/N with numbers, I from 0 to N");
        let (shard, shards) = text.split_once('/').ok_or_else(form)?;
        let (shard, shards) = (shard.parse().map_err(|_| form())?, shards.parse().map_err(|_| form())?);
        if !(1..=MOST_SHARDS).contains(&shards) {
            return Err(format!("{shards} shards, but 1 to {MOST_SHARDS} are possible"));
        }
        Ok(Self { shard, shards })
    }
}

/// Greatest number of candidates in the sample for the estimate, and the time for them.
const SAMPLE: (u64, Duration) = (24, Duration::from_secs(2));

/// A sweep of fewer candidates starts without an estimate.
const FEW: u64 = 200;

/// Runs the sweep.
pub(crate) fn run(args: &SweepRunArgs, context: &mut Context) -> Result<Answer, Failure> {
    let texts = SweepTexts::load(&args.plan, context)?;
    let sweep = Arc::new(texts.sweep(context.seed(), &crate::app::cli::files::shown(&args.plan))?);
    let threads = match args.threads.and_then(|n| std::num::NonZeroUsize::new(n.into())) {
        Some(n) => Threads::Count(n),
        None => Threads::All,
    }
    .count(usize::MAX);
    if args.estimate {
        return Ok(estimate(&sweep, threads, args.shards));
    }
    // clap ensures this
    let Some(output) = &args.output else { return Err(Failure::internal("there is no folder")) };
    let shard = match args.shard {
        None => None,
        Some(ShardNumber { shard, shards }) => {
            let number = shard.saturating_add(args.shard_offset);
            if number > shards {
                let message = format!("shard {number} of {shards}");
                return Err(Failure::refused("sweep::no_shard", message)
                    .with_help("shards are counted from 0; N/N is the same as 0/N"));
            }
            Some(number % shards)
        }
    };
    let folder = SweepFolder::begin(output, &texts, &sweep, args.shard.map(|s| s.shards).or(args.shards))?;
    compute(&folder, &sweep, shard, threads, context)
}

fn compute(
    folder: &SweepFolder,
    sweep: &Arc<Sweep>,
    shard: Option<u64>,
    threads: usize,
    context: &Context,
) -> Result<Answer, Failure> {
    let shards = folder.record.shards;
    let all = shard.map_or(0..shards, |s| s..s + 1);
    let mut known: BTreeMap<u64, ShardState> =
        all.clone().map(|shard| (shard, folder.state(shard, PartCheck::Whole))).collect();
    let is_open =
        |(shard, state): (&u64, &ShardState)| (!matches!(state, ShardState::Done(_))).then_some(*shard);
    let open: Vec<u64> = known.iter().filter_map(is_open).collect();
    let range = |shard| shard_range(sweep.count(), shard, shards);
    let (mut progress, interrupt) = (ProgressLine::new(context.quiet()), Interrupt::watch());
    let total: u64 = open.iter().map(|s| range(*s).end - range(*s).start).sum();
    if total >= FEW && !context.quiet() {
        let sample = CandidateSample::of(sweep);
        let seconds = sample.seconds_each() * total as f64 / threads as f64;
        diagnostic::print_note(&format!(
            "{total} candidates in {} shards: {} on {threads} thread{}, estimated from a sample of {}",
            open.len(),
            spoken(seconds),
            if threads == 1 { "" } else { "s" },
            sample.computed,
        ));
    }
    let mut computed = Vec::new();
    let (mut done, mut interrupted) = (0u64, false);
    for shard in open {
        let range = range(shard);
        let cancel = Cancel::new();
        let rows = sweep.rows(range.clone(), threads, &cancel);
        let written = folder.write_part(sweep, shard, (range.start, range.end - range.start), rows, |n| {
            done += n;
            progress.part("candidates", done as usize, total as usize);
            interrupt.flow()
        });
        cancel.cancel();
        let manifest = match written {
            Ok(Some(manifest)) => manifest,
            Ok(None) => {
                interrupted = true;
                known.remove(&shard);
                break;
            }
            // another process may have finished and removed the same shard meanwhile
            Err(error) => match folder.state(shard, PartCheck::Whole) {
                ShardState::Done(manifest) => {
                    known.insert(shard, ShardState::Done(manifest));
                    continue;
                }
                _ => return Err(error),
            },
        };
        known.insert(shard, ShardState::Done(Box::new(manifest)));
        computed.push(shard);
    }
    let mut status = folder.status_after(computed, |shard| {
        known.remove(&shard).unwrap_or_else(|| folder.state(shard, PartCheck::Size))
    });
    if status.missing.is_empty() {
        folder.tidy();
        status.unfinished.clear();
    }
    let left = status.missing.iter().any(|s| all.contains(s));
    let exit = if interrupted || left { Exit::Inconclusive } else { Exit::Yes };
    let mut text = super::status::text(&status);
    if interrupted {
        text.push_str("Interrupted: the same command continues the run.\n");
    }
    Ok(Answer::new(exit, SweepRunAnswer::Run(status), text))
}

/// Candidates spread over the sweep, computed one after the other.
pub(super) struct CandidateSample {
    computed: usize,
    kept: usize,
    failed: usize,
    time: Duration,
}

impl CandidateSample {
    pub(super) fn of(sweep: &Sweep) -> Self {
        let mut rng = Purpose::SWEPT_AGAIN.rng(sweep.seed);
        let began = Instant::now();
        let mut sample = Self { computed: 0, kept: 0, failed: 0, time: Duration::ZERO };
        let count = sweep.count();
        for n in 0..SAMPLE.0.min(count) {
            // one candidate from each of equal parts, at a random place
            let k = ((n as f64 + rng.unit()) / SAMPLE.0.min(count) as f64 * count as f64) as u64;
            let row = sweep.row(k.min(count - 1));
            sample.computed += 1;
            sample.failed +=
                usize::from(row.as_ref().is_some_and(|r| r[r.len() - 1] != sweep::SweepCell::Empty));
            sample.kept += usize::from(row.is_some());
            sample.time = began.elapsed();
            if sample.time > SAMPLE.1 {
                break;
            }
        }
        sample
    }

    pub(super) fn seconds_each(&self) -> f64 {
        self.time.as_secs_f64() / self.computed.max(1) as f64
    }
}

/// A duration in words.
fn spoken(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "less than a second".into(),
        s if s < 120.0 => format!("about {s:.0} s"),
        s if s < 7200.0 => format!("about {:.0} min", s / 60.0),
        s => format!("about {:.1} h", s / 3600.0),
    }
}

fn estimate(sweep: &Sweep, threads: usize, shards: Option<u64>) -> Answer {
    let sample = CandidateSample::of(sweep);
    let each = sample.seconds_each();
    let seconds = each * sweep.count() as f64 / threads as f64;
    let answer = SweepEstimateAnswer {
        name: sweep.plan.name.clone(),
        candidates: sweep.count(),
        shards: shards.unwrap_or_else(|| default_shards(sweep.count())),
        sampled: sample.computed,
        kept: sample.kept,
        failed: sample.failed,
        seconds_each: each.into(),
        threads,
        seconds: seconds.into(),
        columns: sweep.columns.iter().map(SweepColumnRecord::from).collect(),
    };
    let mut text = format!(
        "{}: {} candidates in {} shards, {:.3} ms each, {} on {threads} thread{}\n{} of {} sampled candidates pass the filters, {} have an error\n\n",
        answer.name,
        answer.candidates,
        answer.shards,
        1e3 * each,
        spoken(seconds),
        if threads == 1 { "" } else { "s" },
        answer.kept,
        answer.sampled,
        answer.failed,
    );
    for c in &answer.columns {
        let unit = c.unit.as_deref().unwrap_or("");
        let _ = writeln!(text, "{:<24} {:<8} {unit:<6} {}", c.name, c.kind, c.meaning);
    }
    Answer::new(Exit::Yes, SweepRunAnswer::Estimate(answer), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_read_as_numbers_of_a_number() {
        let read = |text: &str| text.parse::<ShardNumber>().ok().map(|s| (s.shard, s.shards));
        assert_eq!(read("0/4"), Some((0, 4)));
        assert_eq!(read("4/4"), Some((4, 4)));
        for wrong in ["", "4", "1/0", "a/4", "1/4/2", "-1/4", "1/99999999"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}

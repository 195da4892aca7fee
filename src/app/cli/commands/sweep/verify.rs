//! `equipod sweep verify`: checks the digests of all parts, and recomputes a random sample.

#![allow(clippy::cast_sign_loss, reason = "only shares of counts are cast")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::sweep_folder::SweepFolder;
use crate::app::cli::{Answer, Context, Exit, Failure};
use num::Purpose;
use records::SweepVerifyAnswer;
use sweep::{Sweep, SweepCell, SweepRow, shard_range};

/// Arguments of `sweep verify`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepVerifyArgs {
    /// Folder of the sweep
    folder: PathBuf,
    /// Number of candidates to recompute, drawn by --seed
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(0..=1_000_000_000))]
    sample: u64,
}

/// Checks the parts.
pub(crate) fn run(args: &SweepVerifyArgs, context: &mut Context) -> Result<Answer, Failure> {
    let folder = SweepFolder::open(&args.folder)?;
    let sweep = folder.sweep()?;
    let status = folder.status();
    let sampled = sample(&sweep, args.sample, context.seed());
    let mut different = Vec::new();
    let mut checked = Vec::new();
    for shard in &status.done {
        let range = shard_range(sweep.count(), *shard, folder.record.shards);
        let own: Vec<u64> = sampled.iter().copied().filter(|k| range.contains(k)).collect();
        if own.is_empty() {
            continue;
        }
        let rows = rows(&folder, *shard, &own)?;
        different.extend(own.iter().copied().filter(|k| !is_same(rows.get(k), sweep.row(*k).as_ref())));
        checked.extend(own);
    }
    let same = status.missing.is_empty() && different.is_empty();
    let mut text = super::status::text(&status);
    let _ = writeln!(
        text,
        "{} candidates recomputed: {}",
        checked.len(),
        if different.is_empty() {
            "all rows equal bit for bit".into()
        } else {
            format!("different rows {different:?}")
        }
    );
    let exit = if same { Exit::Yes } else { Exit::No };
    Ok(Answer::new(exit, SweepVerifyAnswer { same, status, sampled: checked, different }, text))
}

/// Candidates drawn at random, each once, in order.
fn sample(sweep: &Sweep, n: u64, seed: u64) -> Vec<u64> {
    let mut rng = Purpose::SWEPT_AGAIN.item(seed, 1);
    let count = sweep.count();
    if n >= count {
        return (0..count).collect();
    }
    let mut drawn = std::collections::BTreeSet::new();
    while (drawn.len() as u64) < n {
        drawn.insert(((rng.unit() * count as f64) as u64).min(count - 1));
    }
    drawn.into_iter().collect()
}

/// The rows of these candidates in the part of a shard.
fn rows(folder: &SweepFolder, shard: u64, candidates: &[u64]) -> Result<BTreeMap<u64, SweepRow>, Failure> {
    let reader = folder.reader(shard)?;
    let damaged = |e: sweep::part::PartError| {
        Failure::refused("sweep::damaged", format!("{}: {e}", folder.part(shard).display()))
    };
    let columns: Vec<usize> = (0..reader.columns.len()).collect();
    let mut found = BTreeMap::new();
    for group in 0..reader.groups() {
        for row in reader.group(group, &columns).map_err(damaged)? {
            if let SweepCell::Integer(k) = row[0]
                && let Some(k) = u64::try_from(k).ok().filter(|k| candidates.binary_search(k).is_ok())
            {
                found.insert(k, row);
            }
        }
    }
    Ok(found)
}

fn is_same(there: Option<&SweepRow>, again: Option<&SweepRow>) -> bool {
    match (there, again) {
        (None, None) => true,
        (Some(a), Some(b)) => a.len() == b.len() && a.iter().zip(b).all(|(x, y)| x.is_same(y)),
        _ => false,
    }
}

//! The rows of a sweep that fulfil conditions, from its folder or from a merged file.

use std::path::Path;

use super::failure::Failure;
use super::sweep_folder::{PartCheck, ShardState, SweepFolder, open_table};
use sweep::part::PartReader;
use sweep::plan::KeepCondition;
use sweep::{SweepCell, SweepColumn};

/// `--better`: the better direction of a column's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Better {
    High,
    Low,
}

/// Tables with the same columns, one after the other, and the conditions on their rows.
pub(crate) struct SweptTable {
    path: String,
    pub(crate) name: String,
    pub(crate) columns: Vec<SweepColumn>,
    readers: Vec<PartReader>,
    conditions: Vec<KeepCondition>,
}

/// The tables of a folder or file, and the name of the sweep.
fn tables(path: &Path) -> Result<(String, Vec<PartReader>), Failure> {
    if !path.is_dir() {
        let reader = open_table(path)?;
        let name = reader.note("equipod.name").unwrap_or_default();
        return Ok((name, vec![reader]));
    }
    let folder = SweepFolder::open(path)?;
    let done = (0..folder.record.shards)
        .filter(|s| matches!(folder.state(*s, PartCheck::Whole), ShardState::Done(_)));
    let readers = done.map(|s| folder.reader(s)).collect::<Result<Vec<_>, _>>()?;
    Ok((folder.record.name.clone(), readers))
}

impl SweptTable {
    /// Opens the finished part of a sweep; `keep` are conditions as in a plan.
    pub(crate) fn open(path: &Path, keep: &[String]) -> Result<Self, Failure> {
        let (name, readers) = tables(path)?;
        let shown = path.display().to_string();
        let Some(first) = readers.first() else {
            return Err(Failure::refused("sweep::no_rows", format!("{shown}: no shard is done"))
                .with_help("`equipod sweep status DIR` says what is missing"));
        };
        let columns = first.columns.clone();
        let read = |text: &String| {
            KeepCondition::read(text, &columns)
                .map_err(|(message, help)| Failure::refused("sweep::bad_condition", message).with_help(help))
        };
        let conditions = keep.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { path: shown, name, columns, readers, conditions })
    }

    /// The index of a column.
    pub(crate) fn column(&self, name: &str) -> Result<usize, Failure> {
        let names: Vec<&str> = self.columns.iter().map(|c| c.name.as_str()).collect();
        names.iter().position(|n| *n == name).ok_or_else(|| {
            let help = files::design::spanned::nearest_help("columns", name, &names);
            Failure::refused("sweep::no_column", format!("the table has no column `{name}`")).with_help(help)
        })
    }

    /// The note of the file under this key.
    pub(crate) fn note(&self, key: &str) -> String {
        self.readers.first().and_then(|r| r.note(key)).unwrap_or_default()
    }

    /// Calls `visit` for the rows that fulfil all conditions, in order.
    pub(crate) fn each_row(&self, mut visit: impl FnMut(&[SweepCell])) -> Result<(), Failure> {
        let every: Vec<usize> = (0..self.columns.len()).collect();
        for reader in &self.readers {
            for group in 0..reader.groups() {
                let rows = reader
                    .group(group, &every)
                    .map_err(|e| Failure::refused("sweep::damaged", format!("{}: {e}", self.path)))?;
                for row in rows.iter().filter(|row| self.conditions.iter().all(|c| c.holds(row))) {
                    visit(row);
                }
            }
        }
        Ok(())
    }
}

//! The keys of design files. One entry of a table is one key. It holds the name, the kind (type, range and unit), the
//! sentence of the documentation, and the access to the design. Reading, checks, suggestions, saving, changes of units,
//! the schema and the documentation all use it.

mod axes;
mod calibration;
mod constructions;
mod cranks;
mod document;
mod envelope;
mod five_legs;
mod found;
mod frames;
mod hardware;
mod holes;
mod joint_models;
mod joints;
mod kind;
mod limits;
mod loads;
mod optimize;
mod payload;
mod plates;
mod poses;
mod renamed;
mod schema;
mod shapes;
mod stored;
mod workspace;

use serde_json::{Map, Value as Json};

pub(super) use document::design;
pub(super) use five_legs::{five_legs, has_five_legs};
pub use found::{check_keys, nearest_help, number, shown, table, text};
pub(super) use frames::frames;
pub(super) use kind::{KeyForm, KeyKind, KeyShape};
pub(super) use renamed::give_new_names;
pub use schema::SCHEMA;

use self::found::FoundKey;
pub(super) use self::found::LARGEST;
use self::kind::TEXT;
use super::Code;
use super::tree::{Entry, Node, Span, find};
use super::violation::Findings;

/// The keys of a whole file.
pub(super) static FILE: &dyn KeyShape = &document::TOP;

/// A key of a table that is read into an `M` and written from one.
struct Key<M: 'static> {
    name: &'static str,
    /// The name in the last release, which is still read; empty for a key that has its name since then.
    old: &'static str,
    kind: KeyKind,
    /// The sentence of schema and documentation.
    says: &'static str,
    /// The value of an absent key, as JSON; empty without a default.
    default: &'static str,
    /// The instruction to add a required key; empty for an optional key.
    required: &'static str,
    /// Keys of the same table that this one requires.
    needs: &'static [&'static str],
    read: fn(&mut FoundKey<'_, '_>, &mut M),
    write: fn(&M) -> Option<Json>,
}

impl<M> Key<M> {
    const fn new(
        name: &'static str,
        kind: KeyKind,
        says: &'static str,
        read: fn(&mut FoundKey<'_, '_>, &mut M),
        write: fn(&M) -> Option<Json>,
    ) -> Self {
        Self { name, old: "", kind, says, default: "", required: "", needs: &[], read, write }
    }
}

/// A key: `key!(name { old = name, default = JSON, required = help, needs = keys }: kind, field; sentence)`, with
/// optional entries in braces. Functions `read, write` replace the field if the value is not a field. Both are missing
/// if functions of the table read and write it.
macro_rules! key {
    ($name:literal $({ $($option:ident = $value:expr),+ })?: $kind:expr; $says:expr) => {
        key!($name $({ $($option = $value),+ })?: $kind, |_, _| (), |_| None; $says)
    };
    ($name:literal $({ $($option:ident = $value:expr),+ })?: $kind:expr, $($field:ident).+; $says:expr) => {
        key!(
            $name $({ $($option = $value),+ })?: $kind,
            |found, to| found.fill(&mut to.$($field).+),
            |of| $crate::design::keys::stored::Stored::written(&of.$($field).+);
            $says
        )
    };
    ($name:literal $({ $($option:ident = $value:expr),+ })?: $kind:expr, $read:expr, $write:expr; $says:expr) => {
        $crate::design::keys::Key {
            $($($option: $value,)+)?
            ..$crate::design::keys::Key::new($name, $kind, $says, $read, $write)
        }
    };
}
use key;

/// The keys of a table of the file, in the order of listing and writing.
struct KeyTable<M: 'static> {
    /// The name of its definition in the schema; empty for a table used once.
    definition: &'static str,
    keys: &'static [Key<M>],
    /// The kind of the keys that are names.
    named: Option<&'static KeyKind>,
    /// Rules of the schema beside those of single keys, as JSON.
    rules: &'static str,
}

/// A table or a list of tables is written after the numbers and texts of its table, as TOML requires.
fn is_table(value: &Json) -> bool {
    match value {
        Json::Object(_) => true,
        Json::Array(list) => !list.is_empty() && list.iter().all(Json::is_object),
        _ => false,
    }
}

impl<M> KeyTable<M> {
    const EMPTY: Self = Self { definition: "", keys: &[], named: None, rules: "{}" };

    fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }

    /// Reads a table and refuses all other keys.
    fn read<'e>(
        &self,
        report: &mut Findings<'_>,
        node: &'e Node,
        place: &str,
        to: &mut M,
    ) -> Option<&'e [Entry]> {
        let entries = table(report, node, place)?;
        check_keys(report, entries, &self.names(), place);
        self.fill(report, entries, place, to, |_| true);
        Some(entries)
    }

    /// Reads the requested keys.
    fn fill(
        &self,
        report: &mut Findings<'_>,
        entries: &[Entry],
        place: &str,
        to: &mut M,
        is_wanted: impl Fn(&str) -> bool,
    ) {
        for key in self.keys.iter().filter(|key| is_wanted(key.name)) {
            let Some(entry) = find(entries, key.name) else { continue };
            for other in key.needs.iter().filter(|other| find(entries, other).is_none()) {
                let message = format!("`{}` without `{other}`", key.name);
                let help = format!("add `{other}`, or remove `{}`", key.name);
                report.refuse(Code::MissingKey, &entry.key_span, message, help);
            }
            (key.read)(&mut FoundKey { report, entry, place, kind: key.kind }, to);
        }
    }

    /// Refuses a table that lacks a selected required key.
    fn require(
        &self,
        report: &mut Findings<'_>,
        entries: &[Entry],
        (span, place): (&Span, &str),
        is_wanted: impl Fn(&str) -> bool,
    ) {
        let missing = |key: &&Key<M>| !key.required.is_empty() && find(entries, key.name).is_none();
        for key in self.keys.iter().filter(|key| is_wanted(key.name)).filter(missing) {
            report.refuse(Code::MissingKey, span, format!("{place} has no `{}`", key.name), key.required);
        }
    }

    /// The keys with a value to write.
    fn write(&self, of: &M) -> Map<String, Json> {
        let written = |key: &Key<M>| Some((key.name.to_owned(), (key.write)(of)?));
        let (tables, values): (Vec<_>, Vec<_>) =
            self.keys.iter().filter_map(written).partition(|(_, value)| is_table(value));
        values.into_iter().chain(tables).collect()
    }

    /// The table as a value of its parent, which omits an empty one.
    fn put(&self, of: &M) -> Option<Json> {
        Some(self.write(of)).filter(|keys| !keys.is_empty()).map(Json::Object)
    }
}

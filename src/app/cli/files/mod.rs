//! Reads and writes files: the program's only access to the file system.
//!
//! Three rules protect the user's files. A run never overwrites a file that it has read, under any path, link or
//! spelling. No run writes a file twice. A design replaces only another design, not a picture or a table. A file
//! appears whole or not at all.

use std::cell::RefCell;
use std::ffi::OsString;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::ArgMatches;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::exit::Exit;
use super::failure::Failure;
use super::streams;
use ask::Design;
use ask::design::parse_with_cranks;
use ask::whole::WholeFile;
use files::design::Format;
use records::{FileSourceRecord, sha256};

/// Greatest size of an input, bytes; a design has some kilobytes.
const MAX_BYTES: u64 = 4 << 20;

/// The name for standard input and standard output.
const STANDARD: &str = "-";

/// Whether a path stands for standard input or standard output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD
}

/// The name of an input in messages.
pub(crate) fn shown(path: &Path) -> String {
    if is_standard(path) { "standard input".into() } else { path.display().to_string() }
}

/// The text of a file of at most 4 MiB, or of standard input.
///
/// # Errors
/// Exit 2: `file::not_readable`, `file::is_directory`, `file::too_large`, `file::not_utf8`, `file::read_twice`.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    utf8(path, read_table(path)?)
}

/// The text of the bytes of a file.
///
/// # Errors
/// Exit 2: `file::not_utf8`.
pub(crate) fn utf8(path: &Path, bytes: Vec<u8>) -> Result<String, Failure> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..valid].split(|b| *b == b'\n').count();
        let message = format!("{} is not UTF-8 text: see line {line}", shown(path));
        Failure::refused("file::not_utf8", message).with_help("save the file as UTF-8")
    })
}

/// The bytes of a table of at most 4 MiB, whatever its encoding.
///
/// # Errors
/// Exit 2: `file::not_readable`, `file::is_directory`, `file::too_large`, `file::read_twice`.
pub(crate) fn read_table(path: &Path) -> Result<Vec<u8>, Failure> {
    let help = "a design has some kilobytes, a table of leg lengths about 100 bytes a row; split the table";
    read_limited(path, MAX_BYTES, help)
}

fn read_limited(path: &Path, most: u64, help: &str) -> Result<Vec<u8>, Failure> {
    let shown = shown(path);
    let unreadable = |error: &std::io::Error| {
        Failure::refused("file::not_readable", format!("{shown} cannot be read: {}", in_words(error)))
            .with_help("check the path and its permissions")
    };
    let too_large = || {
        Failure::refused("file::too_large", format!("{shown} is larger than {} MiB", most >> 20))
            .with_help(help)
    };
    let mut bytes = Vec::new();
    if is_standard(path) {
        if texts_read().iter().any(|text| text.path == STANDARD) {
            let message = "standard input is named for two inputs of this command";
            return Err(
                Failure::refused("file::read_twice", message).with_help("name a file for one of them")
            );
        }
        streams::input().take(most + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
    } else {
        let metadata = std::fs::metadata(path).map_err(|e| unreadable(&e))?;
        if metadata.is_dir() {
            let failure = Failure::refused("file::is_directory", format!("{shown} is a directory"));
            return Err(failure.with_help("name a file in it"));
        }
        if metadata.len() > most {
            return Err(too_large());
        }
        // a pipe or device has no size, and a file may grow: the read itself is limited too
        let file = File::open(path).map_err(|e| unreadable(&e))?;
        note_input(path);
        file.take(most + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
    }
    if bytes.len() as u64 > most {
        return Err(too_large());
    }
    note_text(path, &bytes);
    Ok(bytes)
}

/// A path of an output, file or folder; the type separates outputs from inputs among the arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OutputPath(PathBuf);

impl From<OsString> for OutputPath {
    fn from(text: OsString) -> Self {
        Self(text.into())
    }
}

impl Deref for OutputPath {
    type Target = Path;
    fn deref(&self) -> &Path {
        &self.0
    }
}

/// The identity of a file, under any name.
#[derive(Debug, Clone)]
struct Identity {
    /// The path without links and dots; for a file that does not exist yet, the folder's path with the name.
    path: PathBuf,
    /// Device and number of the file: the same for hard links, and for other spellings that the file system accepts.
    #[cfg(unix)]
    node: Option<(u64, u64)>,
}

impl Identity {
    fn of(path: &Path) -> Self {
        let whole = path.canonicalize().or_else(|_| {
            let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
            folder.canonicalize().map(|f| f.join(path.file_name().unwrap_or_default()))
        });
        Self {
            path: whole.unwrap_or_else(|_| path.to_path_buf()),
            #[cfg(unix)]
            node: path.metadata().ok().map(|m| {
                use std::os::unix::fs::MetadataExt as _;
                (m.dev(), m.ino())
            }),
        }
    }

    fn is(&self, other: &Self) -> bool {
        #[cfg(unix)]
        if self.node.is_some() && self.node == other.node {
            return true;
        }
        self.path == other.path
    }
}

/// The files of this run.
#[derive(Debug, Default)]
struct FilesOfRun {
    read: Vec<Identity>,
    /// The texts that [`read_text`] read, for the provenance of the answer.
    texts: Vec<FileSourceRecord>,
    written: Vec<Identity>,
    /// The text that goes to standard output instead of the answer.
    standard: Option<String>,
}

thread_local! {
    /// Commands read and write on the thread on which they are started; worker threads access no files.
    static RUN: RefCell<FilesOfRun> = RefCell::default();
}

/// Forgets the files of an earlier run of this thread.
pub(crate) fn begin() {
    RUN.take();
}

fn note_input(path: &Path) {
    RUN.with_borrow_mut(|run| run.read.push(Identity::of(path)));
}

fn note_text(path: &Path, bytes: &[u8]) {
    let text = FileSourceRecord { path: path.display().to_string(), sha256: sha256(bytes) };
    RUN.with_borrow_mut(|run| {
        if !run.texts.contains(&text) {
            run.texts.push(text);
        }
    });
}

/// The texts that this run has read, in order, each once.
pub(crate) fn texts_read() -> Vec<FileSourceRecord> {
    RUN.with_borrow(|run| run.texts.clone())
}

/// The file that this run has written to standard output, if any.
pub(crate) fn standard_output() -> Option<String> {
    RUN.with_borrow_mut(|run| run.standard.take())
}

fn over_input(path: &Path) -> Failure {
    let message = format!("{} is an input of this command and would be overwritten", path.display());
    Failure::refused("file::overwrites_input", message).with_help("name another file")
}

fn written_twice(path: &Path) -> Failure {
    let message = format!("{} is named for two outputs of this command", path.display());
    Failure::refused("file::written_twice", message).with_help("name a file for each")
}

/// Refuses outputs among the arguments that are also inputs or equal other outputs, before anything is computed.
///
/// # Errors
/// Exit 2: `file::overwrites_input`, `file::written_twice`, `file::standard_output`.
pub(crate) fn check_arguments(matches: &ArgMatches, json: bool) -> Result<(), Failure> {
    let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
    let mut level = Some(matches);
    while let Some(matches) = level {
        for id in matches.ids().map(clap::Id::as_str) {
            inputs.extend(matches.try_get_many::<PathBuf>(id).ok().flatten().into_iter().flatten().cloned());
            for path in matches.try_get_many::<OutputPath>(id).ok().flatten().into_iter().flatten() {
                // a global option is listed at every level
                if !outputs.iter().any(|(known, _)| known == &id) {
                    outputs.push((id, path.clone()));
                }
            }
        }
        level = matches.subcommand().map(|(_, below)| below);
    }
    let standard = outputs.iter().filter(|(_, path)| is_standard(path)).count();
    if standard > 1 {
        return Err(written_twice(Path::new("standard output")));
    }
    if standard == 1 && json {
        let message = "standard output cannot take a file in addition to the document of --json";
        return Err(
            Failure::refused("file::standard_output", message).with_help("name a file, or leave out --json")
        );
    }
    let files: Vec<(Identity, &OutputPath)> = outputs
        .iter()
        .filter(|(_, path)| !is_standard(path))
        .filter(|(_, p)| !p.is_dir() && !is_device(p))
        .map(|(_, p)| (Identity::of(p), p))
        .collect();
    for (k, (file, path)) in files.iter().enumerate() {
        if inputs.iter().any(|input| Identity::of(input).is(file)) {
            return Err(over_input(path));
        }
        if files[..k].iter().any(|(other, _)| other.is(file)) {
            return Err(written_twice(path));
        }
    }
    Ok(())
}

/// Whether a path is a device or a pipe, which accepts any number of texts.
fn is_device(path: &Path) -> bool {
    path.exists() && !path.is_file() && !path.is_dir()
}

/// Makes a folder and its parents, if missing.
///
/// # Errors
/// Exit 2: `file::not_writable`.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    if is_standard(path) {
        let message = "this command writes several files, but standard output takes one";
        return Err(Failure::refused("file::standard_output", message).with_help("name a folder"));
    }
    std::fs::create_dir_all(path).map_err(|error| {
        Failure::refused(
            "file::not_writable",
            format!("{} cannot be made: {}", path.display(), in_words(&error)),
        )
        .with_help("check the folder and its permissions")
    })
}

/// Opens a file that a folder of results should hold, and refuses a pipe, which would block forever.
///
/// # Errors
/// The error of the system; `InvalidInput` for a pipe or device.
pub(crate) fn open_regular(path: &Path) -> std::io::Result<File> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::new(ErrorKind::InvalidInput, "it is no file"));
    }
    File::open(path)
}

/// Greatest size of a file in a folder of results, bytes: the plan of a sweep with its table of poses is the largest.
const MAX_FOUND_BYTES: u64 = 64 << 20;

/// The bytes of a file that a folder of results should hold; `None` if it is missing, or larger than this program
/// writes.
pub(crate) fn found_in_folder(path: &Path) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path).ok()?.take(MAX_FOUND_BYTES + 1).read_to_end(&mut bytes).ok()?;
    (bytes.len() as u64 <= MAX_FOUND_BYTES).then_some(bytes)
}

/// A record in a folder of results; `None` if it is missing, or is another file.
pub(crate) fn found_record<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_slice(&found_in_folder(path)?).ok()
}

/// A record for a folder of results, as the text of its file.
///
/// # Errors
/// Exit 4: it cannot be written as JSON.
pub(crate) fn record_text(record: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(record).map_err(|e| Failure::internal(e.to_string()))?;
    Ok(text + "\n")
}

/// The bytes of a file of at most `most` bytes.
///
/// # Errors
/// Exit 2: `file::not_readable`, `file::too_large`.
pub(crate) fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let unreadable = |error: std::io::Error| {
        Failure::refused(
            "file::not_readable",
            format!("{} cannot be read: {}", path.display(), in_words(&error)),
        )
        .with_help("check the path and its permissions")
    };
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    note_input(path);
    file.take(most + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > most {
        let message = format!("{} is larger than {} MiB", path.display(), most >> 20);
        return Err(Failure::refused("file::too_large", message).with_help("name a smaller file"));
    }
    Ok(bytes)
}

/// Refuses a file that this run has read.
///
/// # Errors
/// Exit 2: `file::overwrites_input`.
pub(crate) fn check_input(path: &Path) -> Result<(), Failure> {
    let target = Identity::of(path);
    let read = RUN.with_borrow(|run| run.read.iter().any(|known| known.is(&target)));
    if read { Err(over_input(path)) } else { Ok(()) }
}

/// Refuses a write that would destroy a file of the user.
///
/// # Errors
/// Exit 2: `file::overwrites_input`, `file::written_twice`, `file::overwrites_design`, `file::not_writable`
/// (write-protected).
fn check_target(path: &Path, text: &str) -> Result<(), Failure> {
    check_input(path)?;
    let target = Identity::of(path);
    RUN.with_borrow(|run| {
        if run.written.iter().any(|known| known.is(&target)) {
            return Err(written_twice(path));
        }
        Ok(())
    })?;
    let Ok(metadata) = path.metadata() else { return Ok(()) };
    if metadata.permissions().readonly() {
        let message = format!("{} cannot be written: it is write-protected", path.display());
        return Err(Failure::refused("file::not_writable", message).with_help("name another file"));
    }
    let is_design =
        |text: &str| [Format::Toml, Format::Json].iter().any(|f| parse_with_cranks(text, *f).is_ok());
    let there = if metadata.len() > MAX_BYTES { None } else { std::fs::read_to_string(path).ok() };
    if there.is_some_and(|old| is_design(&old)) && !is_design(text) {
        let message =
            format!("{} is a design and would be overwritten by another kind of file", path.display());
        return Err(Failure::refused("file::overwrites_design", message).with_help("name another file"));
    }
    Ok(())
}

/// An error of the system without its number, and without the name of the file beside which a new one is written.
pub(crate) fn in_words(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_owned()
}

/// The failure of a write; a full disk is not the fault of the arguments.
pub(crate) fn not_written(shown: &str, error: &std::io::Error) -> Failure {
    let message = format!("{shown} cannot be written: {}", in_words(error));
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            Failure::new(Exit::Internal, "file::disk_full", message)
                .with_help("free some space, or write elsewhere")
        }
        _ => {
            Failure::refused("file::not_writable", message).with_help("check the folder and its permissions")
        }
    }
}

/// Writes a file whole: first beside its place, then renamed, so that it is never half-written. `-` is standard output.
///
/// # Errors
/// Exit 2: `file::overwrites_input`, `file::written_twice`, `file::overwrites_design`, `file::not_writable`. Exit 4:
/// `file::disk_full`.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let failed = |error: std::io::Error| not_written(&path.display().to_string(), &error);
    if is_standard(path) {
        RUN.with_borrow_mut(|run| run.standard.get_or_insert_default().push_str(text));
        return Ok(());
    }
    if is_device(path) {
        // a device or pipe cannot be replaced; the reader of a pipe may close it early
        return match std::fs::write(path, text) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
            done => done.map_err(failed),
        };
    }
    if path.is_dir() {
        return Err(failed(std::io::ErrorKind::IsADirectory.into()));
    }
    check_target(path, text)?;
    WholeFile::write(path, text.as_bytes()).map_err(failed)?;
    RUN.with_borrow_mut(|run| run.written.push(Identity::of(path)));
    Ok(())
}

/// Writes a file into a folder and returns its path; a folder in the name is made too.
///
/// # Errors
/// The errors of [`make_folder`] and [`write_text`].
pub(crate) fn write_into(folder: &Path, name: &str, text: &str) -> Result<PathBuf, Failure> {
    let path = folder.join(name);
    path.parent().map_or(Ok(()), make_folder)?;
    write_text(&path, text)?;
    Ok(path)
}

/// Writes a design in the notation of the file name.
///
/// # Errors
/// The errors of [`write_text`].
pub(crate) fn write_design(path: &Path, design: &Design) -> Result<(), Failure> {
    let text = match Format::of_path(path) {
        Format::Toml => design.to_toml(),
        Format::Json => design.to_json(),
    };
    write_text(path, &text)
}

#[cfg(test)]
mod tests;

//! Reading and writing files, with a limit on what is read.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::failure::Failure;
use crate::design::{Design, Format};

/// Nothing this program reads is larger; a design has some kilobytes.
const MAX_BYTES: u64 = 4 << 20;

/// The text of a file of at most 4 MiB.
///
/// # Errors
/// Exit 2: `file::not_readable`, `file::is_directory`, `file::too_large`, `file::not_utf8`.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let shown = path.display();
    let unreadable = |error: &std::io::Error| {
        Failure::refused("file::not_readable", format!("{shown} cannot be read: {error}"))
            .with_help("check the path and its permissions")
    };
    let too_large = || {
        Failure::refused("file::too_large", format!("{shown} is larger than 4 MiB")).with_help(
            "a design has some kilobytes, a table of leg lengths about 100 bytes a row; split the table",
        )
    };
    let metadata = std::fs::metadata(path).map_err(|e| unreadable(&e))?;
    if metadata.is_dir() {
        let failure = Failure::refused("file::is_directory", format!("{shown} is a directory"));
        return Err(failure.with_help("name a file in it"));
    }
    if metadata.len() > MAX_BYTES {
        return Err(too_large());
    }
    // a pipe or device has no size to go by, and a file may grow: the read itself is limited too
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|e| unreadable(&e))?;
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|e| unreadable(&e))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(too_large());
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..valid].split(|b| *b == b'\n').count();
        Failure::refused("file::not_utf8", format!("{shown} is not UTF-8 text: line {line} has other bytes"))
            .with_help("save the file as UTF-8")
    })
}

/// Makes a folder and those above it, where they do not exist.
///
/// # Errors
/// Exit 2: `file::not_writable`.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path).map_err(|error| {
        Failure::refused("file::not_writable", format!("{} cannot be made: {error}", path.display()))
            .with_help("check the folder and its permissions")
    })
}

/// The bytes of a file.
///
/// # Errors
/// Exit 2: `file::not_readable`.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| {
        Failure::refused("file::not_readable", format!("{} cannot be read: {error}", path.display()))
            .with_help("check the path and its permissions")
    })
}

/// Writes a file whole: first beside it, then renamed, so that a half-written file never stands there.
///
/// # Errors
/// Exit 2: `file::not_writable`.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let mut part = path.as_os_str().to_owned();
    part.push(format!(".{}.part", std::process::id()));
    let part = Path::new(&part);
    let result = if path.is_file() || !path.exists() {
        std::fs::write(part, text).and_then(|()| std::fs::rename(part, path))
    } else {
        std::fs::write(path, text) // a device or pipe: nothing to rename over
    };
    result.map_err(|error| {
        let _ = std::fs::remove_file(part); // it may not exist; the error to report is the first one
        Failure::refused("file::not_writable", format!("{} cannot be written: {error}", path.display()))
            .with_help("check the folder and its permissions")
    })
}

/// Writes a design in the notation of the file name.
///
/// # Errors
/// As [`write_text`].
pub(crate) fn write_design(path: &Path, design: &Design) -> Result<(), Failure> {
    let text = match Format::of_path(path) {
        Format::Toml => design.to_toml(),
        Format::Json => design.to_json(),
    };
    write_text(path, &text)
}

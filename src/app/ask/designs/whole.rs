//! Writes files so that they appear whole or not at all; the library and the program write every file here.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// The beginning and the end of the temporary name of a file.
const PART: (&str, &str) = (".", ".part");

/// A file under a temporary name beside its place, until [`finish`](Self::finish) moves it there; dropping it earlier
/// deletes it.
///
/// The name `.NAME.RANDOM.part` is unique for any number of processes and machines that write into one folder.
#[derive(Debug)]
pub struct WholeFile {
    part: tempfile::NamedTempFile,
    target: PathBuf,
}

impl WholeFile {
    /// Begins the file for a path; at a link, the file that it points to will be replaced.
    ///
    /// # Errors
    /// A folder in which no file can be made.
    pub fn begin(path: &Path) -> io::Result<Self> {
        let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let mut name = OsString::from(PART.0);
        name.push(target.file_name().unwrap_or_default());
        name.push(".");
        let mut make = tempfile::Builder::new();
        make.prefix(&name).suffix(PART.1);
        // the usual permissions of a new file, rather than those of a private one
        #[cfg(unix)]
        make.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let part = make.tempfile_in(folder_of(&target))?;
        Ok(Self { part, target })
    }

    /// The file to write to.
    pub fn file(&self) -> &File {
        self.part.as_file()
    }

    /// Flushes all data to the disk, and moves the file to its place with the permissions of the file it replaces.
    ///
    /// # Errors
    /// A full disk, or a target that cannot be replaced.
    pub fn finish(self) -> io::Result<()> {
        let Self { part, target } = self;
        part.as_file().sync_all()?;
        if let Ok(old) = target.metadata() {
            part.as_file().set_permissions(old.permissions())?;
        }
        part.persist(&target).map_err(|failed| failed.error)?;
        // flush the name to the disk too, if the system can do so for a folder
        #[cfg(unix)]
        let _ = File::open(folder_of(&target)).and_then(|folder| folder.sync_all());
        Ok(())
    }

    /// Writes bytes as a whole file.
    ///
    /// # Errors
    /// The errors of [`begin`](Self::begin) and [`finish`](Self::finish).
    pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
        let whole = Self::begin(path)?;
        io::Write::write_all(&mut whole.file(), bytes)?;
        whole.finish()
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The final name of a temporary file that a killed run has left.
pub fn part_of(name: &OsStr) -> Option<&str> {
    let inner = name.to_str()?.strip_prefix(PART.0)?.strip_suffix(PART.1)?;
    let (file, random) = inner.rsplit_once('.')?;
    let is_ours = !file.is_empty() && random.len() == 6 && random.bytes().all(|b| b.is_ascii_alphanumeric());
    is_ours.then_some(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_there_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let names = || -> Vec<OsString> {
            let mut names: Vec<_> =
                std::fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
            names.sort();
            names
        };
        // neither a leftover of a killed run nor a second writer disturbs
        std::fs::write(folder.path().join(".a.toml.1.part"), "half").unwrap();
        let (first, second) = (WholeFile::begin(&path).unwrap(), WholeFile::begin(&path).unwrap());
        io::Write::write_all(&mut first.file(), b"first").unwrap();
        assert!(!path.exists());
        let parts: Vec<OsString> = names().into_iter().filter(|n| part_of(n) == Some("a.toml")).collect();
        assert_eq!(parts.len(), 2, "{parts:?}");
        drop(second);
        first.finish().unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"first");
        assert_eq!(names(), [".a.toml.1.part", "a.toml"]);
        assert!(WholeFile::begin(&folder.path().join("no/such/folder.toml")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file_and_of_the_one_replaced() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let [plain, ours] = ["plain", "ours"].map(|name| folder.path().join(name));
        std::fs::write(&plain, "").unwrap();
        WholeFile::write(&ours, b"x").unwrap();
        let mode = |path: &Path| path.metadata().unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
        std::fs::set_permissions(&ours, std::fs::Permissions::from_mode(0o640)).unwrap();
        WholeFile::write(&ours, b"y").unwrap();
        assert_eq!(mode(&ours) & 0o777, 0o640);
        // a link stays a link
        let link = folder.path().join("link");
        std::os::unix::fs::symlink(&ours, &link).unwrap();
        WholeFile::write(&link, b"z").unwrap();
        assert!(link.is_symlink() && std::fs::read(&ours).unwrap() == b"z");
    }

    #[test]
    fn parts_are_told_from_files_of_the_user() {
        assert_eq!(part_of(OsStr::new(".fk.json.aB3xYz.part")), Some("fk.json"));
        for name in
            ["fk.json.part", ".fk.json.part", ".fk.json.mine.part", ".aB3xYz.part", ".fk.json.aB3-Yz.part"]
        {
            assert_eq!(part_of(OsStr::new(name)), None, "{name}");
        }
    }
}

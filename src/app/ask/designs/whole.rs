//! A file that appears whole or not at all: every file of the library and of the program is written here.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// The beginning and the end of the name that a file has until it is whole.
const PART: (&str, &str) = (".", ".part");

/// A file beside its place, under a name of its own, until [`finish`](Self::finish) puts it there; dropped before that
/// it is gone.
///
/// The name `.NAME.RANDOM.part` belongs to nobody else, whatever number a process has and however many machines write
/// into one folder.
#[derive(Debug)]
pub struct WholeFile {
    part: tempfile::NamedTempFile,
    target: PathBuf,
}

impl WholeFile {
    /// Begins the file for a path; where a link stands, the file that it points to will be replaced.
    ///
    /// # Errors
    /// A folder where no file can be made.
    pub fn begin(path: &Path) -> io::Result<Self> {
        let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let mut name = OsString::from(PART.0);
        name.push(target.file_name().unwrap_or_default());
        name.push(".");
        let mut make = tempfile::Builder::new();
        make.prefix(&name).suffix(PART.1);
        // what any new file gets, and not a file for this user alone
        #[cfg(unix)]
        make.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let part = make.tempfile_in(folder_of(&target))?;
        Ok(Self { part, target })
    }

    /// The file to write to.
    pub fn file(&self) -> &File {
        self.part.as_file()
    }

    /// Makes sure that all of it is on the disk, and puts it in its place with the permissions of the file that stood
    /// there.
    ///
    /// # Errors
    /// A disk that is full, a target that cannot be replaced.
    pub fn finish(self) -> io::Result<()> {
        let Self { part, target } = self;
        part.as_file().sync_all()?;
        if let Ok(old) = target.metadata() {
            part.as_file().set_permissions(old.permissions())?;
        }
        part.persist(&target).map_err(|failed| failed.error)?;
        // the name is on the disk too where the system can say so of a folder
        #[cfg(unix)]
        let _ = File::open(folder_of(&target)).and_then(|folder| folder.sync_all());
        Ok(())
    }

    /// Writes bytes as a whole file.
    ///
    /// # Errors
    /// As of [`begin`](Self::begin) and [`finish`](Self::finish).
    pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
        let whole = Self::begin(path)?;
        io::Write::write_all(&mut whole.file(), bytes)?;
        whole.finish()
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The file that a name is a part of, left by a run that was killed.
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
        // a part that a killed run has left, and two writers at once, are in nobody's way
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

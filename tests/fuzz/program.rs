//! The program in this process, on a file with the bytes of a case.

use std::cell::RefCell;
use std::path::Path;
use std::process::ExitCode;

thread_local! {
    // one folder for all cases
    static FOLDER: RefCell<Option<tempfile::TempDir>> = const { RefCell::new(None) };
}

/// Calls `run` with the folder of this thread, which is made first and kept.
pub(crate) fn in_folder(run: impl FnOnce(&Path)) {
    FOLDER.with_borrow_mut(|folder| {
        let folder = folder.get_or_insert_with(|| tempfile::tempdir().expect("a temporary folder"));
        run(folder.path());
    });
}

/// Runs `equipod ARGS --json`. The program catches panics and ends with 4: that is the fault to find.
pub(crate) fn equipod(args: &[&str]) {
    let all = ["equipod"].iter().chain(args).chain(&["--json"]).map(Into::into);
    let code = equipod::cli::main(all);
    assert_ne!(format!("{code:?}"), format!("{:?}", ExitCode::from(4)), "{args:?}");
}

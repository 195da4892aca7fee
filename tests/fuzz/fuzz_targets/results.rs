//! Answers read back: a front for `plot pareto`, and a folder of results for `report` in which one file is anything.
#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../program.rs"]
mod program;

fuzz_target!(|bytes: &[u8]| {
    // the first byte chooses what the file is called
    let Some((first, bytes)) = bytes.split_first() else { return };
    program::in_folder(|folder| {
        let name = ["verify.json", "optimize.json", "front.json", "a.svg", "a.csv"][usize::from(*first) % 5];
        let results = folder.join("results");
        let _ = std::fs::remove_dir_all(&results);
        std::fs::create_dir_all(&results).expect("a writable folder");
        let file = results.join(name);
        std::fs::write(&file, bytes).expect("a writable folder");
        let picture = folder.join("front.svg");
        program::equipod(&["plot", "pareto", &file.to_string_lossy(), "-o", &picture.to_string_lossy()]);
        program::equipod(&["report", &results.to_string_lossy()]);
    });
});

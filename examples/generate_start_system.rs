//! Makes `src/fk/solve/homotopy/data/generic40.txt` and `planar20.txt`: run from the project's top folder.

use equipod::methods::solve::homotopy::{SHIPPED_SEED, StartKind, start_system_text};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (name, kind) in [("generic40", StartKind::Generic), ("planar20", StartKind::Planar)] {
        let text = start_system_text(kind, SHIPPED_SEED)?;
        std::fs::write(format!("src/fk/solve/homotopy/data/{name}.txt"), &text)?;
    }
    Ok(())
}

//! Makes `src/solve/homotopy/data/generic40.txt`: run from the project's top folder.

use equipod::solve::homotopy::{SHIPPED_SEED, start_system_text};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = start_system_text(SHIPPED_SEED)?;
    std::fs::write("src/solve/homotopy/data/generic40.txt", &text)?;
    Ok(())
}

//! Designs of real hardware that come with the library, as text: every figure in them is sourced or marked as chosen.

use ask::presets::{Preset, PresetClass};

macro_rules! preset {
    ($name:literal, $class:ident) => {
        Preset {
            name: $name,
            class: PresetClass::$class,
            text: include_str!(concat!("../../designs/presets/", $name, ".toml")),
        }
    };
}

/// All presets, by class and name. `docs/presets.md` has their figures in one table.
pub const PRESETS: [Preset; 7] = [
    preset!("bench-l16", Bench),
    preset!("mdx-chair-v3", MotionSimulator),
    preset!("motion-base-6dof2000e", MotionSimulator),
    preset!("rubin-camera-hexapod", PrecisionPositioner),
    preset!("rubin-m2-hexapod", PrecisionPositioner),
    preset!("linuxcnc-hexapod", MachineTool),
    preset!("reachy-mini", Robot),
];

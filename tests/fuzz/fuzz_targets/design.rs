//! Design files in both notations: read, or refused with a place in the text; what was read is written and reads back.
#![no_main]

use equipod::methods::design::{Format, parse};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let lines = text.lines().count().max(1) + 1;
    for format in [Format::Toml, Format::Json] {
        match parse(&text, format) {
            Ok((design, _)) => {
                for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
                    let (again, _) = parse(&text, format).expect("what is written reads back");
                    assert_eq!(format!("{again:?}"), format!("{design:?}"));
                }
            }
            Err(violations) => {
                assert!(!violations.is_empty());
                assert!(
                    violations
                        .iter()
                        .all(|v| (1..=lines).contains(&v.line) && v.column >= 1 && !v.help.is_empty())
                );
            }
        }
    }
});

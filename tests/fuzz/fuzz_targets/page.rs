//! Requests of the page, and the text it is opened with.
#![no_main]

use std::sync::OnceLock;

use equipod::methods::design::{Format, parse};
use equipod::methods::page::Session;
use libfuzzer_sys::fuzz_target;

static SESSION: OnceLock<Session> = OnceLock::new();

fuzz_target!(|bytes: &[u8]| {
    let session = SESSION.get_or_init(|| {
        let text = include_str!("../../../designs/rbt-octahedral.toml");
        Session::new(parse(text, Format::Toml).expect("a shipped design").0)
    });
    let text = String::from_utf8_lossy(bytes);
    assert!(session.answer(&text).starts_with('{'));
    if let Err(refusal) = Session::open(&text) {
        assert!(refusal.starts_with("{\"error\":"));
    }
});

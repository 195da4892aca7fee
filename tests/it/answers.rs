//! Answers are read by programs in Rust as their types; `tests/answers/check.py` holds every answer against its schema.

use equipod::records::{
    CheckAnswer, CompletionsAnswer, Document, ErrorAnswer, FamilyAnswer, FkAnswer, HelpAnswer, IkAnswer,
    LimitsAnswer, MapAnswer, NewAnswer, PlotAnswer, PresetsAnswer, SchemaAnswer, VerifyAnswer,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::cli_frame::equipod;

/// Reads a document as its type and writes it again.
fn reread<T: Serialize + DeserializeOwned>(text: &str) -> Result<String, String> {
    let document: Document<T> = serde_json::from_str(text).map_err(|e| e.to_string())?;
    serde_json::to_string(&document).map_err(|e| e.to_string())
}

type Reread = fn(&str) -> Result<String, String>;

const ASKED: [(&str, Reread); 14] = [
    ("check designs/rbt-midline.toml", reread::<CheckAnswer>),
    ("shell completions bash", reread::<CompletionsAnswer>),
    ("fk no-such.toml", reread::<ErrorAnswer>),
    ("equivalents family designs/rbt-octahedral.toml", reread::<FamilyAnswer>),
    ("fk designs/rbt-octahedral.toml", reread::<FkAnswer>),
    ("fk --help", reread::<HelpAnswer>),
    ("ik designs/rbt-octahedral.toml --pose home", reread::<IkAnswer>),
    ("limits designs/rbt-octahedral.toml", reread::<LimitsAnswer>),
    ("equivalents map designs/rbt-octahedral.toml designs/rbt-midline.toml", reread::<MapAnswer>),
    (
        "new --base-radius 500 --platform-radius 300 --base-spread 20 --platform-spread 20 --height 400",
        reread::<NewAnswer>,
    ),
    ("plot modes designs/rbt-octahedral.toml", reread::<PlotAnswer>),
    ("design presets", reread::<PresetsAnswer>),
    ("design schema fk", reread::<SchemaAnswer>),
    ("verify designs/rbt-octahedral.toml designs/rbt-midline.toml --samples 1", reread::<VerifyAnswer>),
];

#[test]
fn an_answer_read_as_its_type_is_written_as_it_was() {
    for (line, reread) in ASKED {
        let words: Vec<&str> = line.split(' ').chain(["--json"]).collect();
        let text = String::from_utf8(equipod(&words).stdout).unwrap();
        assert_eq!(reread(text.trim_end()).as_deref(), Ok(text.trim_end()), "{line}");
        // a key less, one more, or a value of another kind is not read, or is read as another answer
        for (from, to) in [
            ("\"version\"", "\"versions\""),
            ("\"warnings\":[", "\"more\":1,\"warnings\":["),
            ("\"seed\":", "\"seed\":{},\"x\":"),
        ] {
            // the last place: an answer may hold the schema of another one
            let at = text.rfind(from).unwrap_or_else(|| panic!("{line}: no {from}"));
            let spoilt = format!("{}{to}{}", &text[..at], text[at + from.len()..].trim_end());
            assert_ne!(spoilt, text.trim_end(), "{line}");
            assert_ne!(reread(&spoilt).as_deref(), Ok(&*spoilt), "{line}: {from}");
        }
    }
}

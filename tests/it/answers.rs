//! Answers that reports and notebooks read are read as their types; `tests/answers/check.py` holds every answer against
//! its schema.

use equipod::records::{
    AssessAnswer, CompareAnswer, Document, DrivesAnswer, FamilyAnswer, LimitsAnswer, MapAnswer, MotionAnswer,
    OptimizeAnswer, RoundAnswer, TolerancesAnswer, VerifyAnswer,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::{cli_drives, cli_frame::equipod};

/// Reads a document as its type and writes it again.
fn reread<T: Serialize + DeserializeOwned>(text: &str) -> Result<String, String> {
    let document: Document<T> = serde_json::from_str(text).map_err(|e| e.to_string())?;
    serde_json::to_string(&document).map_err(|e| e.to_string())
}

type Reread = fn(&str) -> Result<String, String>;

/// BENCH and TABLE are files of the test.
const ASKED: [(&str, Reread); 13] = [
    ("assess BENCH", reread::<AssessAnswer>),
    ("compare designs/rbt-octahedral.toml designs/rbt-midline.toml", reread::<CompareAnswer>),
    ("build drives BENCH TABLE", reread::<DrivesAnswer>),
    ("build round designs/rbt-octahedral.toml --grid 0.25", reread::<RoundAnswer>),
    ("build tolerances designs/rbt-octahedral.toml --bound 0.1,0.1 --trials 50", reread::<TolerancesAnswer>),
    ("equivalents family designs/rbt-octahedral.toml", reread::<FamilyAnswer>),
    ("equivalents map designs/rbt-octahedral.toml designs/rbt-midline.toml", reread::<MapAnswer>),
    ("limits designs/rbt-octahedral.toml", reread::<LimitsAnswer>),
    ("limits BENCH", reread::<LimitsAnswer>),
    ("motion BENCH --sine x:1:1", reread::<MotionAnswer>),
    ("motion designs/presets/reachy-mini.toml --sine z:1:1", reread::<MotionAnswer>),
    ("optimize designs/rbt-octahedral.toml", reread::<OptimizeAnswer>),
    ("verify designs/rbt-octahedral.toml designs/rbt-midline.toml --samples 1", reread::<VerifyAnswer>),
];

#[test]
fn an_answer_read_as_its_type_is_written_as_it_was() {
    are_written_as_read(&ASKED[..ASKED.len() / 2]);
}

#[test]
fn further_answers_read_as_their_types_are_written_as_they_were() {
    are_written_as_read(&ASKED[ASKED.len() / 2..]);
}

fn are_written_as_read(asked: &[(&str, Reread)]) {
    let folder = tempfile::tempdir().unwrap();
    let files = (
        cli_drives::bench(folder.path()),
        cli_drives::table(folder.path(), "name,stroke,retracted_length\nlong,100,150\ntiny,1,150\n"),
    );
    for (line, reread) in asked {
        let line = line.replace("BENCH", &files.0).replace("TABLE", &files.1);
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

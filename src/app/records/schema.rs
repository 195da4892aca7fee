//! Schemas of the answers, made from their types.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value};

use super::{
    AssessAnswer, AtPoseAnswer, CalibrateAnswer, CheckAnswer, CompareAnswer, CompletionsAnswer,
    ComponentsAnswer, ConvertAnswer, Document, DrivesAnswer, ErrorAnswer, ExploreAnswer, ExportAnswer,
    FamilyAnswer, FkAnswer, HelpAnswer, IkAnswer, LimitsAnswer, LocusAnswer, ManAnswer, MapAnswer,
    MotionAnswer, MoveAnswer, NearestAnswer, NewAnswer, OptimizeAnswer, PentapodAnswer, PlotAnswer,
    PresetsAnswer, ReportAnswer, RoundAnswer, SchemaAnswer, SelfmotionAnswer, SingularLocusAnswer,
    SingularitiesAnswer, TolerancesAnswer, TopologiesAnswer, VerifyAnswer, ViewAnswer,
};

/// Names of answers, each with the function that writes its schema. Commands have their own names, or the form
/// `singular-poses` in a group; `error` stands for refusals, `help` for --help.
type Table = &'static [(&'static str, fn(&mut SchemaGenerator) -> schemars::Schema)];

const ANSWERS: Table = &[
    ("assess", Document::<AssessAnswer>::json_schema),
    ("at", Document::<AtPoseAnswer>::json_schema),
    #[cfg(feature = "lab")]
    ("bench", Document::<super::BenchAnswer>::json_schema),
    ("build-drives", Document::<DrivesAnswer>::json_schema),
    ("build-round", Document::<RoundAnswer>::json_schema),
    ("build-tolerances", Document::<TolerancesAnswer>::json_schema),
    ("calibrate", Document::<CalibrateAnswer>::json_schema),
    ("check", Document::<CheckAnswer>::json_schema),
    ("check-pentapod", Document::<PentapodAnswer>::json_schema),
    ("compare", Document::<CompareAnswer>::json_schema),
    ("design-convert", Document::<ConvertAnswer>::json_schema),
    ("design-presets", Document::<PresetsAnswer>::json_schema),
    ("design-schema", Document::<SchemaAnswer>::json_schema),
    ("equivalents-components", Document::<ComponentsAnswer>::json_schema),
    ("equivalents-family", Document::<FamilyAnswer>::json_schema),
    ("equivalents-map", Document::<MapAnswer>::json_schema),
    ("equivalents-move", Document::<MoveAnswer>::json_schema),
    ("equivalents-nearest", Document::<NearestAnswer>::json_schema),
    ("equivalents-topologies", Document::<TopologiesAnswer>::json_schema),
    ("error", Document::<ErrorAnswer>::json_schema),
    ("explore", Document::<ExploreAnswer>::json_schema),
    ("export", Document::<ExportAnswer>::json_schema),
    ("fk", Document::<FkAnswer>::json_schema),
    ("help", Document::<HelpAnswer>::json_schema),
    ("ik", Document::<IkAnswer>::json_schema),
    ("limits", Document::<LimitsAnswer>::json_schema),
    ("motion", Document::<MotionAnswer>::json_schema),
    ("new", Document::<NewAnswer>::json_schema),
    ("optimize", Document::<OptimizeAnswer>::json_schema),
    ("plot", Document::<PlotAnswer>::json_schema),
    ("plot-locus", Document::<LocusAnswer>::json_schema),
    ("report", Document::<ReportAnswer>::json_schema),
    ("shell-completions", Document::<CompletionsAnswer>::json_schema),
    ("shell-man", Document::<ManAnswer>::json_schema),
    ("singular-locus", Document::<SingularLocusAnswer>::json_schema),
    ("singular-motion", Document::<SelfmotionAnswer>::json_schema),
    ("singular-poses", Document::<SingularitiesAnswer>::json_schema),
    ("sweep-best", Document::<super::SweepBestAnswer>::json_schema),
    ("sweep-design", Document::<super::SweepDesignAnswer>::json_schema),
    ("sweep-merge", Document::<super::SweepMergeAnswer>::json_schema),
    ("sweep-run", Document::<super::SweepRunAnswer>::json_schema),
    ("sweep-script", Document::<super::SweepScriptAnswer>::json_schema),
    ("sweep-status", Document::<super::SweepStatusAnswer>::json_schema),
    ("sweep-verify", Document::<super::SweepVerifyAnswer>::json_schema),
    ("verify", Document::<VerifyAnswer>::json_schema),
    ("view", Document::<ViewAnswer>::json_schema),
];

/// The names of all schemas, in alphabetical order.
pub fn schema_names() -> impl Iterator<Item = &'static str> {
    ANSWERS.iter().map(|(name, _)| *name)
}

/// The JSON Schema (draft 2020-12) of the documents that a command writes with `--json`; `None` for a name outside
/// [`schema_names`].
///
/// Objects are open: later versions may add keys to them.
#[must_use]
pub fn schema(of: &str) -> Option<Map<String, Value>> {
    let (name, write) = ANSWERS.iter().find(|(name, _)| *name == of)?;
    let mut generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let document = write(&mut generator).to_value();
    let mut definitions = Map::new();
    definitions.insert((*name).into(), document);
    definitions.extend(generator.take_definitions(true));
    let open = "Later versions with the same schema_version may add keys to every object, and words to lists of words: pass over what is not known. \
                docs/answers.md lists the fields of all answers.";
    let mut root = Map::new();
    root.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
    root.insert("title".into(), format!("Answer of equipod {} --json", name.replace('-', " ")).into());
    root.insert("description".into(), open.into());
    root.insert("$ref".into(), format!("#/$defs/{name}").into());
    root.insert("$defs".into(), Value::Object(definitions));
    root.values_mut().for_each(unwrap_descriptions);
    Some(root)
}

/// Puts each paragraph of a description on one line, since line breaks of the sources have no meaning.
fn unwrap_descriptions(schema: &mut Value) {
    match schema {
        Value::Object(fields) => {
            for (key, value) in fields {
                match value {
                    Value::String(text) if key == "description" => {
                        let paragraphs: Vec<String> =
                            text.split("\n\n").map(|p| p.replace('\n', " ")).collect();
                        *text = paragraphs.join("\n\n");
                    }
                    _ => unwrap_descriptions(value),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(unwrap_descriptions),
        _ => {}
    }
}

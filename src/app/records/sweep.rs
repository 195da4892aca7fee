//! Answers of `sweep`, and the files that a sweep keeps beside its parts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use files::design::Format;

/// A text that a sweep was begun with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SweepTextRecord {
    /// The text.
    pub text: String,
    /// Its notation.
    pub format: Format,
}

/// What `sweep.json` in the folder of a sweep holds: all that its parts depend on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SweepFolderRecord {
    /// The version of these definitions.
    pub schema_version: u32,
    /// The name of the plan.
    pub name: String,
    /// The version of the program.
    pub version: String,
    /// The seed.
    pub seed: u64,
    /// Candidates.
    pub candidates: u64,
    /// Shards that they are divided into.
    pub shards: u64,
    /// SHA-256 over plan, base design, table of drives and table of poses, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub plan_sha256: String,
    /// The plan.
    pub plan: SweepTextRecord,
    /// Its base design.
    pub design: SweepTextRecord,
    /// Its table of drives; absent where it names none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drives: Option<String>,
    /// The table of poses that the workspace of the base design names; absent where it names none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poses: Option<String>,
}

/// What the manifest beside a part says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SweepManifestRecord {
    /// The version of these definitions.
    pub schema_version: u32,
    /// The shard, from 0.
    pub shard: u64,
    /// How many there are.
    pub shards: u64,
    /// The first candidate.
    pub first: u64,
    /// Candidates.
    pub candidates: u64,
    /// Rows kept.
    pub rows: u64,
    /// Rows with an error.
    pub failed: u64,
    /// SHA-256 over plan and base design, hexadecimal.
    pub plan_sha256: String,
    /// The seed.
    pub seed: u64,
    /// The version of the program.
    pub version: String,
    /// The file of the part.
    pub part: String,
    /// Its size.
    pub bytes: u64,
    /// SHA-256 of its bytes, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
    /// How long it took; the part does not depend on it.
    pub seconds: Number,
    /// How much of that went into the part, its digest, and bringing it to the disk; for the rest the candidates were
    /// computed, or waited for.
    pub writing_seconds: Number,
}

/// A part that is not what its manifest says.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct DamagedPartRecord {
    /// The shard, from 0.
    pub shard: u64,
    /// What is wrong.
    pub reason: String,
}

/// The answer of `sweep run`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SweepRunAnswer {
    /// With --estimate: nothing was written.
    Estimate(SweepEstimateAnswer),
    /// The sweep, or a shard of it.
    Run(SweepStatusAnswer),
}

/// How long a sweep takes, from a sample of its candidates.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepEstimateAnswer {
    /// The name of the plan.
    pub name: String,
    /// Candidates.
    pub candidates: u64,
    /// Shards, where nothing else is asked for.
    pub shards: u64,
    /// Candidates that were computed to tell.
    pub sampled: usize,
    /// Of these, rows that the plan keeps.
    pub kept: usize,
    /// Of these, rows with an error.
    pub failed: usize,
    /// Mean time of a candidate on one thread.
    pub seconds_each: Number,
    /// Threads that were asked for.
    pub threads: usize,
    /// Time of the whole sweep on so many threads.
    pub seconds: Number,
    /// Columns of the table.
    pub columns: Vec<SweepColumnRecord>,
}

/// A column of the table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SweepColumnRecord {
    /// Its name.
    pub name: String,
    /// What its cells hold.
    #[schemars(extend("enum" = ["number", "integer", "truth", "text"]))]
    pub kind: String,
    /// The unit; null: a pure number, or none.
    pub unit: Option<String>,
    /// What it is.
    pub meaning: String,
}

/// What is done of a sweep, and what is missing.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepStatusAnswer {
    /// The name of the plan.
    pub name: String,
    /// The folder.
    pub folder: String,
    /// SHA-256 over plan and base design, hexadecimal.
    pub plan_sha256: String,
    /// The seed.
    pub seed: u64,
    /// Candidates of the whole sweep.
    pub candidates: u64,
    /// Shards of the whole sweep.
    pub shards: u64,
    /// Shards whose parts are there and have the digests of their manifests.
    pub done: Vec<u64>,
    /// All others.
    pub missing: Vec<u64>,
    /// The same as ranges, as the option --array of Slurm takes them: `2-5,9`.
    pub missing_ranges: String,
    /// Those whose parts are there and are not what their manifests say.
    pub damaged: Vec<DamagedPartRecord>,
    /// Shards that this run has computed; those that were done before are left as they are.
    pub computed: Vec<u64>,
    /// Rows in the parts that are done.
    pub rows: u64,
    /// Rows among them with an error.
    pub failed: u64,
    /// Files that were being written when a run ended.
    pub unfinished: Vec<String>,
}

/// The answer of `sweep merge`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SweepMergeAnswer {
    /// The file written.
    pub output: String,
    /// Parts in it.
    pub parts: u64,
    /// Rows.
    pub rows: u64,
    /// Its size.
    pub bytes: u64,
    /// SHA-256 of its bytes, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
}

/// The answer of `sweep verify`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepVerifyAnswer {
    /// All parts are there, with their digests, and every candidate that was computed again has the same row.
    pub same: bool,
    /// What is done and what is missing.
    pub status: SweepStatusAnswer,
    /// Candidates that were computed again.
    pub sampled: Vec<u64>,
    /// Those among them whose row is another one.
    pub different: Vec<u64>,
}

/// The answer of `sweep design`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SweepDesignAnswer {
    /// The candidate.
    pub candidate: u64,
    /// Its design.
    #[serde(flatten)]
    pub file: SweepDesignFile,
}

/// The answer of `sweep best`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepBestAnswer {
    /// The column by which candidates are ranked.
    pub column: String,
    /// Rows that were kept and ranked.
    pub rows: u64,
    /// The best of them, the best one first.
    pub candidates: Vec<SweepBestRecord>,
    /// The page that compares them; `null` where there are none.
    pub page: Option<String>,
}

/// One of the best candidates of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepBestRecord {
    /// The candidate.
    pub candidate: u64,
    /// Its value in the column.
    pub value: Number,
    /// Its design file.
    pub output: String,
}

/// The answer of `sweep script`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepScriptAnswer {
    /// Shards.
    pub shards: u64,
    /// Arrays of jobs.
    pub arrays: u64,
    /// What a shard takes, from a sample.
    pub seconds_per_shard: Number,
    /// The script.
    #[serde(flatten)]
    pub file: SweepDesignFile,
}

/// Where a design or a script is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SweepDesignFile {
    /// Written.
    Written {
        /// The file written.
        output: String,
    },
    /// Given.
    Given {
        /// The design file.
        text: String,
    },
}

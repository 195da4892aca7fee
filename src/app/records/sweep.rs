//! Answers of `sweep`, and the files that a sweep keeps beside its parts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Number;
use files::design::Format;

/// A text from which a sweep was begun.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SweepTextRecord {
    /// The text.
    pub text: String,
    /// The notation of the text.
    pub format: Format,
}

/// The content of `sweep.json` in the folder of a sweep: all data that its parts depend on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SweepFolderRecord {
    /// The version of the file format.
    pub schema_version: u32,
    /// The name of the plan.
    pub name: String,
    /// Program version.
    pub version: String,
    /// The seed.
    pub seed: u64,
    /// Number of candidates.
    pub candidates: u64,
    /// Number of shards.
    pub shards: u64,
    /// SHA-256 over plan, base design, table of drives and table of poses, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub plan_sha256: String,
    /// The plan.
    pub plan: SweepTextRecord,
    /// The base design of the plan.
    pub design: SweepTextRecord,
    /// The table of drives; absent: the plan names none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drives: Option<String>,
    /// The table of poses that is the workspace of the base design; absent: the base design names none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poses: Option<String>,
}

/// The manifest of a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SweepManifestRecord {
    /// The version of the file format.
    pub schema_version: u32,
    /// Shard number, from 0.
    pub shard: u64,
    /// Number of shards of the sweep.
    pub shards: u64,
    /// The first candidate of the shard.
    pub first: u64,
    /// Number of candidates.
    pub candidates: u64,
    /// Number of rows kept.
    pub rows: u64,
    /// Number of rows with an error.
    pub failed: u64,
    /// SHA-256 of plan and base design, hexadecimal.
    pub plan_sha256: String,
    /// The seed.
    pub seed: u64,
    /// Program version.
    pub version: String,
    /// The file of the part.
    pub part: String,
    /// File size, bytes.
    pub bytes: u64,
    /// SHA-256, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
    /// Computation time, seconds; the part does not depend on it.
    pub seconds: Number,
    /// The share of this time for writing the part, its digest and flushing to disk, seconds. The rest is computing
    /// candidates or waiting for them.
    pub writing_seconds: Number,
}

/// A part that disagrees with its manifest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct DamagedPartRecord {
    /// Shard number, from 0.
    pub shard: u64,
    /// The disagreement.
    pub reason: String,
}

/// The answer of `sweep run`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SweepRunAnswer {
    /// The answer with --estimate; nothing was written.
    Estimate(SweepEstimateAnswer),
    /// The sweep, or a shard of it.
    Run(SweepStatusAnswer),
}

/// The estimated time of a sweep, from a sample of its candidates.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepEstimateAnswer {
    /// The name of the plan.
    pub name: String,
    /// Number of candidates.
    pub candidates: u64,
    /// Number of shards, unless another number is requested.
    pub shards: u64,
    /// Number of sampled candidates.
    pub sampled: usize,
    /// Number of sampled rows that the plan keeps.
    pub kept: usize,
    /// Number of sampled rows with an error.
    pub failed: usize,
    /// Mean time of a candidate on one thread, seconds.
    pub seconds_each: Number,
    /// Number of threads requested.
    pub threads: usize,
    /// Estimated time on these threads, seconds.
    pub seconds: Number,
    /// The columns of the table.
    pub columns: Vec<SweepColumnRecord>,
}

/// A column of the table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SweepColumnRecord {
    /// The name of the column.
    pub name: String,
    /// Cell type.
    #[schemars(extend("enum" = ["number", "integer", "truth", "text"]))]
    pub kind: String,
    /// The unit; null: a pure number, or none.
    pub unit: Option<String>,
    /// Meaning.
    pub meaning: String,
}

/// The finished and the missing shards of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepStatusAnswer {
    /// The name of the plan.
    pub name: String,
    /// The folder.
    pub folder: String,
    /// SHA-256 of plan and base design, hexadecimal.
    pub plan_sha256: String,
    /// The seed.
    pub seed: u64,
    /// Number of candidates in all.
    pub candidates: u64,
    /// Number of shards in all.
    pub shards: u64,
    /// Finished shards with the right digest.
    pub done: Vec<u64>,
    /// All other shards.
    pub missing: Vec<u64>,
    /// Missing shards as ranges for Slurm's --array: `2-5,9`.
    pub missing_ranges: String,
    /// Shards that disagree with their manifest.
    pub damaged: Vec<DamagedPartRecord>,
    /// Shards of this run; finished shards are left as they are.
    pub computed: Vec<u64>,
    /// Number of rows in finished parts.
    pub rows: u64,
    /// Rows with an error.
    pub failed: u64,
    /// Incomplete files of an earlier run.
    pub unfinished: Vec<String>,
}

/// The answer of `sweep merge`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SweepMergeAnswer {
    /// The file written.
    pub output: String,
    /// Number of parts in it.
    pub parts: u64,
    /// Number of rows.
    pub rows: u64,
    /// File size, bytes.
    pub bytes: u64,
    /// SHA-256, hexadecimal.
    #[schemars(regex(pattern = "^[0-9a-f]{64}$"))]
    pub sha256: String,
}

/// The answer of `sweep verify`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepVerifyAnswer {
    /// Whether all parts have their digests, and every recomputed candidate has the same row.
    pub same: bool,
    /// Finished and missing shards.
    pub status: SweepStatusAnswer,
    /// Recomputed candidates.
    pub sampled: Vec<u64>,
    /// Candidates with a different row.
    pub different: Vec<u64>,
}

/// The answer of `sweep design`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct SweepDesignAnswer {
    /// The number of the candidate.
    pub candidate: u64,
    /// Design file of the candidate.
    #[serde(flatten)]
    pub file: SweepDesignFile,
}

/// The answer of `sweep best`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepBestAnswer {
    /// Column of the ranking.
    pub column: String,
    /// Number of rows kept and ranked.
    pub rows: u64,
    /// The best candidates, the best first.
    pub candidates: Vec<SweepBestRecord>,
    /// Page with comparison; `null`: there are none.
    pub page: Option<String>,
}

/// One of the best candidates of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepBestRecord {
    /// The number of the candidate.
    pub candidate: u64,
    /// Value in the column.
    pub value: Number,
    /// Design file of the candidate.
    pub output: String,
}

/// The answer of `sweep script`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepScriptAnswer {
    /// Number of shards.
    pub shards: u64,
    /// Number of job arrays.
    pub arrays: u64,
    /// Computation time of a shard, estimated from a sample, seconds.
    pub seconds_per_shard: Number,
    /// The script.
    #[serde(flatten)]
    pub file: SweepDesignFile,
}

/// A design file or script: its path or its text.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SweepDesignFile {
    /// The file was written.
    Written {
        /// The file written.
        output: String,
    },
    /// File in the answer.
    Given {
        /// File contents.
        text: String,
    },
}

//! `equipod report`: a folder of results as one HTML page.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::Value;

use super::compare::{CompareQuestion, compare};
use super::explore::folder::FIRST;
use crate::app::cli::streams::output_is_terminal;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use crate::app::page::{CORE, Session, page as view};
use crate::app::report::{Comparison, Report, ReportFile, html};
use ::files::design::Format;
use ask::Design;
use ask::design::parse;
use records::{AssessAnswer, ReportAnswer};
use synthesis::Pattern;

/// The page in its folder.
pub(super) const PAGE: &str = "report.html";
/// Greatest size of all files together, bytes: a result has at most some megabytes, and no browser opens a larger page.
const MOST_BYTES: u64 = 64 << 20;
/// Arguments of `report`.
#[derive(Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// Folder with designs (.toml, .json), results (.json) and pictures (.svg); below it only machine/parts.csv is read
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Write the page to this file; default: report.html in the folder
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Title of the page; default: the name of the first design
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
}

/// Writes the page.
pub(crate) fn run(args: &ReportArgs, context: &mut Context) -> Result<Answer, Failure> {
    let output = args.output.as_deref().map_or_else(|| args.folder.join(PAGE), Path::to_path_buf);
    let found = gather(&args.folder, &output)?;
    if found.is_empty() {
        let message = format!("{} holds no files", args.folder.display());
        return Err(
            Failure::refused("report::empty", message).with_help("run `equipod explore DESIGN -o DIR` first")
        );
    }
    let files = found.len();
    let first = found.iter().find_map(design_of);
    let assessment = first.as_ref().and_then(|d| AssessAnswer::of(d, context.seed()));
    // the path on standard output, for programs; before it the requirements, for people
    let shown = first.as_ref().filter(|_| output_is_terminal());
    let lead = shown.map(|d| sheet::answers::verdict(&d.name, assessment.as_ref(), "in the report"));
    files::write_text(&output, &page(found, args.title.clone(), None))?;
    let record = ReportAnswer { output: output.display().to_string(), files, assessment };
    let mut text = lead.unwrap_or_default();
    text.line(&record.output);
    Ok(Answer::new(Exit::Yes, record, text))
}

/// The page of these files; assessments of several designs end at the time `until` with the result so far.
pub(in crate::app::cli::commands) fn page(
    files: Vec<ReportFile>,
    title: Option<String>,
    until: Option<Instant>,
) -> String {
    let first = files.iter().find_map(design_of);
    let title = title.or_else(|| first.as_ref().map(|d| d.name.clone())).unwrap_or_else(|| "Results".into());
    let view = first.map(|design| live(design, &files));
    let comparison = side_by_side(&files, until);
    html(&Report { title, files, comparison, view })
}

/// Numbers of Halton points and of random points for comparing the designs of a folder.
const COMPARED_POSES: usize = 200;

/// The comparison of the designs among the files, if there are several in the same units.
fn side_by_side(files: &[ReportFile], until: Option<Instant>) -> Option<Comparison> {
    let designs: Vec<(String, Design)> =
        files.iter().filter_map(|f| design_of(f).map(|design| (f.name.clone(), design))).collect();
    let several = designs.len() > 1;
    several.then(|| compare(&designs, &CompareQuestion::plain(COMPARED_POSES, until)).ok()).flatten()
}

/// The live page of a design; it begins with the offsets of a result among the files.
fn live(design: Design, files: &[ReportFile]) -> String {
    let session = Session::new(design);
    let chosen = files.iter().find_map(offsets_of).zip(Pattern::new([false; 6], [1; 6]));
    // offsets of another design do not fit; the page then begins with its own
    let started = chosen.and_then(|(t, pattern)| session.clone().starting_with(pattern, t).ok());
    view(&started.unwrap_or(session), Some(CORE))
}

/// The offsets in the answer of `optimize`.
fn offsets_of(file: &ReportFile) -> Option<Vec<f64>> {
    Path::new(&file.name).extension().filter(|e| *e == "json")?;
    let document: Value = serde_json::from_slice(&file.bytes).ok()?;
    document.get("offsets")?.as_array()?.iter().map(Value::as_f64).collect()
}

fn design_of(file: &ReportFile) -> Option<Design> {
    let path = Path::new(&file.name);
    path.extension().filter(|e| *e == "toml" || *e == "json")?;
    let text = std::str::from_utf8(&file.bytes).ok()?;
    parse(text, Format::of_path(path)).ok().map(|(design, _)| design)
}

fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::refused(
        "report::not_readable",
        format!("{} cannot be read: {}", path.display(), files::in_words(error)),
    )
    .with_help("name a folder with results, for instance that of `explore`")
}

/// All files of a folder, except an earlier page at the path of this one. Any other file there is an input, and is not
/// overwritten.
fn gather(folder: &Path, page: &Path) -> Result<Vec<ReportFile>, Failure> {
    let entries = std::fs::read_dir(folder).map_err(|e| unreadable(folder, &e))?;
    let is_page =
        page.extension().is_some_and(|e| e.eq_ignore_ascii_case("html") || e.eq_ignore_ascii_case("htm"));
    let own = page.canonicalize().ok().filter(|_| is_page);
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.map_err(|e| unreadable(folder, &e))?.path();
        // hidden files are no results
        let hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        if path.is_file() && !hidden && (own.is_none() || path.canonicalize().ok() != own) {
            paths.push(path);
        }
    }
    let parts = folder.join(PARTS[0]).join(PARTS[1]);
    if parts.is_file() {
        paths.push(parts);
    }
    read(folder, paths)
}

/// The path of the bill of materials in a folder of `explore`.
const PARTS: [&str; 2] = ["machine", "parts.csv"];

/// Files of a folder for the page: files of `explore` first, the others by name.
pub(in crate::app::cli::commands) fn read(
    folder: &Path,
    paths: impl IntoIterator<Item = PathBuf>,
) -> Result<Vec<ReportFile>, Failure> {
    let (mut out, mut left) = (Vec::new(), MOST_BYTES);
    for path in paths {
        let bytes = files::read_bytes(&path, left).map_err(|failure| match failure.code.as_str() {
            "file::too_large" => {
                let message =
                    format!("the files of {} have more than {} MiB", folder.display(), MOST_BYTES >> 20);
                Failure::refused("file::too_large", message).with_help("take large files out of the folder")
            }
            _ => failure,
        })?;
        left -= bytes.len() as u64;
        let within = path.strip_prefix(folder).unwrap_or(&path);
        let parts: Vec<_> = within.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let name = parts.join("/");
        out.push(ReportFile { name, bytes });
    }
    Ok(in_order(out))
}

/// The files in order: those that `explore` names first, then the others by name.
pub(in crate::app::cli::commands) fn in_order(mut files: Vec<ReportFile>) -> Vec<ReportFile> {
    let rank = |name: &str| FIRST.iter().position(|known| *known == name).unwrap_or(FIRST.len());
    files.sort_by(|a, b| (rank(&a.name), &a.name).cmp(&(rank(&b.name), &b.name)));
    files
}

//! `equipod view`: a design as one HTML page.

use std::path::{Path, PathBuf};

use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use crate::app::page::{CORE, Session, page};
use records::{AssessAnswer, ViewAnswer};

/// Arguments of `view`.
#[derive(Debug, clap::Args)]
pub(crate) struct ViewArgs {
    /// Design file (.toml or .json); without it, the page asks for a hexapod
    design: Option<PathBuf>,
    /// Write the page to this file; default: DESIGN.html or equipod.html
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Pattern of the equivalent platform shown first, for instance S123456 (no shared joint)
    #[arg(long, value_name = "ID", requires = "offsets")]
    pattern: Option<String>,
    /// Offsets of this platform, as fractions of the edges; default pattern: S123456
    #[arg(
        long,
        value_name = "T1,..",
        value_delimiter = ',',
        allow_hyphen_values = true,
        requires = "design"
    )]
    offsets: Option<Vec<f64>>,
    /// WebAssembly core instead of the program's own, plain or compressed; `none`: recorded data only
    #[arg(long, value_name = "FILE|none")]
    core: Option<PathBuf>,
}

/// Writes the page.
pub(crate) fn run(args: &ViewArgs, context: &mut Context) -> Result<Answer, Failure> {
    let mut session = match &args.design {
        Some(path) => Session::new(context.load_ideal(path)?),
        None => Session::without_design().map_err(|e| Failure::internal(e.to_string()))?,
    };
    if let Some(offsets) = &args.offsets {
        let id = args.pattern.as_deref().unwrap_or("S123456");
        let pattern = id.parse().map_err(|e| {
            Failure::refused("view::bad_pattern", format!("`{id}`: {e}"))
                .with_help("take an \"id\" from the patterns of `equipod equivalents family DESIGN --json`")
        })?;
        session = session
            .starting_with(pattern, offsets.clone())
            .map_err(|e| Failure::refused("view::bad_offsets", e.to_string()))?;
    }
    let core = core(args.core.as_deref())?;
    let html = page(&session, core.as_deref());
    let output = args.output.as_deref().map_or_else(|| beside(args.design.as_deref()), Path::to_path_buf);
    files::write_text(&output, &html)?;
    let shown = session.shown();
    let assessment = args.design.as_ref().and_then(|_| AssessAnswer::of(&shown, context.seed()));
    let record = ViewAnswer {
        name: session.design().name.clone(),
        output: output.display().to_string(),
        bytes: html.len(),
        live: core.is_some(),
        assessment,
    };
    let how = if record.live { "" } else { ", with recorded data only" };
    let wrote = format!("wrote {}{how}", record.output);
    // a page without a design has only an example
    let lead = args
        .design
        .as_ref()
        .map(|_| sheet::answers::verdict(&shown.name, record.assessment.as_ref(), "on the page"));
    let mut text = lead.unwrap_or_default();
    text.line(wrote);
    Ok(Answer::new(Exit::Yes, record, text))
}

/// The name of the page: `designs/a.toml` gives `a.html`, a design from standard input `design.html`, and no design
/// `equipod.html`.
fn beside(design: Option<&Path>) -> PathBuf {
    let Some(design) = design else { return "equipod.html".into() };
    if files::is_standard(design) {
        return "design.html".into();
    }
    PathBuf::from(design.file_name().unwrap_or_default()).with_extension("html")
}

/// Greatest size of a core, bytes; the core of this program has some hundred kilobytes.
const MOST_CORE: u64 = 64 << 20;

/// The module to put into the page.
fn core(given: Option<&Path>) -> Result<Option<Vec<u8>>, Failure> {
    let Some(path) = given else { return Ok(Some(CORE.to_vec())) };
    if path == Path::new("none") {
        return Ok(None);
    }
    let bytes = files::read_bytes(path, MOST_CORE)?;
    let known: [&[u8]; 2] = [b"\0asm", &[0x1f, 0x8b]];
    if !known.iter().any(|k| bytes.starts_with(k)) {
        let message = format!("{} is neither WebAssembly nor compressed by gzip", path.display());
        return Err(Failure::refused("view::bad_core", message)
            .with_help("tests/page/build-core makes one from the sources"));
    }
    Ok(Some(bytes))
}

//! Answers and failures to standard output and standard error.

use std::borrow::Cow;
use std::fmt::Debug;
use std::io;

use serde::Serialize;
use sheet::Sheet;

use super::context::{Context, FileWarning};
use super::diagnostic;
use super::exit::Exit;
use super::failure::Failure;
use super::files;
use super::streams;
use records::{Document, ErrorAnswer, HelpAnswer, ProvenanceRecord, WarningRecord};

/// The result of a command: the record for `--json`, and the text for people.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) exit: Exit,
    record: Box<dyn ErasedRecord>,
    text: AnswerText,
}

/// The text for people: a sheet whose numbers are rounded where it is printed, or a text as it is.
#[derive(Debug)]
pub(crate) enum AnswerText {
    Sheet(Sheet),
    Plain(String),
}

impl AnswerText {
    fn with_digits(&self, digits: usize) -> Cow<'_, str> {
        match self {
            Self::Sheet(sheet) => format!("{sheet:.digits$}").into(),
            Self::Plain(text) => text.into(),
        }
    }
}

impl From<Sheet> for AnswerText {
    fn from(sheet: Sheet) -> Self {
        Self::Sheet(sheet)
    }
}

impl From<String> for AnswerText {
    fn from(text: String) -> Self {
        Self::Plain(text)
    }
}

impl From<&str> for AnswerText {
    fn from(text: &str) -> Self {
        Self::Plain(text.into())
    }
}

impl Answer {
    pub(crate) fn new(
        exit: Exit,
        record: impl Serialize + Debug + 'static,
        text: impl Into<AnswerText>,
    ) -> Self {
        Self { exit, record: Box::new(record), text: text.into() }
    }
}

/// A record of any type that can be written as a document.
trait ErasedRecord: Debug {
    fn document(&self, context: &Context) -> Result<String, Failure>;
}

impl<T: Serialize + Debug> ErasedRecord for T {
    fn document(&self, context: &Context) -> Result<String, Failure> {
        document(self, context.provenance(), context.warnings())
    }
}

/// The destination of results.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Output {
    json: bool,
}

impl Output {
    pub(crate) fn new(json: bool) -> Self {
        Self { json }
    }

    pub(crate) fn is_json(self) -> bool {
        self.json
    }

    pub(crate) fn answer(self, answer: &Answer, context: &Context) -> Exit {
        if !self.json {
            let text = answer.text.with_digits(context.digits());
            let Some(file) = files::standard_output() else {
                return write_out(&diagnostic::harmless(&text), answer.exit);
            };
            // if a file goes to standard output, the text goes to standard error
            if !context.quiet() {
                let said = text
                    .lines()
                    .filter(|line| !["wrote -", "-"].contains(line))
                    .collect::<Vec<_>>()
                    .join("\n");
                diagnostic::print_note(&said);
            }
            return write_out(&file, answer.exit);
        }
        match answer.record.document(context) {
            Ok(text) => write_out(&text, answer.exit),
            Err(failure) => self.failure(&failure, Some(context)),
        }
    }

    /// `context`: `None` before the arguments are parsed.
    pub(crate) fn failure(self, failure: &Failure, context: Option<&Context>) -> Exit {
        diagnostic::print_failure(failure);
        if !self.json {
            return failure.exit;
        }
        write_failure(failure, context)
    }

    /// A text that the program prints about itself.
    pub(crate) fn notices(self, text: &str) -> Exit {
        if !self.json {
            return write_out(text, Exit::Yes);
        }
        match document(HelpAnswer { help: text.into() }, ProvenanceRecord::default(), &[]) {
            Ok(text) => write_out(&text, Exit::Yes),
            Err(failure) => self.failure(&failure, None),
        }
    }

    /// Help and version, in the words of clap.
    pub(crate) fn help(self, said: &clap::Error) -> Exit {
        if self.json {
            return self.notices(&said.to_string());
        }
        let styled = said.render().ansi().to_string();
        let shown = anstream::adapter::strip_str(&styled).to_string();
        write_out(if streams::output_is_coloured() { &styled } else { &shown }, Exit::Yes)
    }
}

/// The text of a document.
pub(crate) fn document(
    answer: impl Serialize,
    provenance: ProvenanceRecord,
    warnings: &[FileWarning],
) -> Result<String, Failure> {
    let document = Document::new(answer, provenance, warnings.iter().map(WarningRecord::from).collect());
    let text = serde_json::to_string(&document);
    // terminal control characters occur only in strings, and JSON has an escape for them
    text.map(|t| {
        diagnostic::escaped(&t, |c| {
            c.encode_utf16(&mut [0; 2]).iter().fold(String::new(), |t, u| format!("{t}\\u{u:04x}"))
        }) + "\n"
    })
    .map_err(|e| Failure::internal(format!("the answer cannot be written as JSON: {e}")))
}

/// A refusal or failure as a document of texts and line numbers. If even that cannot be written, standard error has the
/// message.
fn write_failure(failure: &Failure, context: Option<&Context>) -> Exit {
    let (provenance, warnings) = context.map_or_else(Default::default, |c| (c.provenance(), c.warnings()));
    let text = document(ErrorAnswer { error: failure.into() }, provenance, warnings).unwrap_or_default();
    write_out(&text, failure.exit)
}

impl From<&FileWarning> for WarningRecord {
    fn from(w: &FileWarning) -> Self {
        Self {
            code: w.warning.code().into(),
            path: w.path.clone(),
            line: w.warning.line(),
            message: w.warning.to_string(),
            help: w.warning.advice(),
        }
    }
}

/// Writes to standard output. A closed pipe (`| head`) ends quietly with the exit code of the answer; any other failure
/// is exit 4.
fn write_out(text: &str, exit: Exit) -> Exit {
    match streams::write_output(text) {
        Ok(()) => exit,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => exit,
        Err(error) => {
            let message = format!("standard output cannot be written: {error}");
            diagnostic::print_failure(&Failure::new(Exit::Internal, "output", message));
            Exit::Internal
        }
    }
}

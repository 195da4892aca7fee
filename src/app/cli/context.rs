//! The context of a command: global options, warnings, and the designs read.

use std::cell::{Cell, RefCell};
use std::path::{Path, PathBuf};

use clap::ArgMatches;
use clap::parser::ValueSource;

use super::diagnostic;
use super::failure::Failure;
use super::files;
use super::rows;
use ::files::design::{Accepts, Format, SixOrFive, SnappedDesign, Warning, parse_six_or_five};
use ask::design::{DesignOrViolations, parse, parse_ideal, parse_with_cranks};
use ask::{Design, PoseFrames};
use machine::coupled::CoupledLegs;
use machine::rotary::RotaryPlatform;
use records::{DesignSourceRecord, FileSourceRecord, ProvenanceRecord};

/// Options of every command, before or after its name.
#[derive(Debug, clap::Args)]
pub(crate) struct Global {
    /// Write exactly one JSON document to standard output, errors included
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// Seed of all random numbers; the same input and seed give the same output
    #[arg(long, global = true, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Write no warnings and no progress to standard error
    #[arg(short, long, global = true)]
    pub(crate) quiet: bool,
    /// Significant digits of printed numbers; --json and tables have all
    #[arg(long, global = true, value_name = "N", default_value_t = sheet::DIGITS, value_parser = clap::value_parser!(u8).range(1..=17))]
    pub(crate) digits: u8,
}

/// A warning and the file it is about.
#[derive(Debug)]
pub(crate) struct FileWarning {
    pub(crate) path: String,
    pub(crate) warning: Warning,
}

/// Global options and collected warnings.
#[derive(Debug)]
pub(crate) struct Context {
    seed: u64,
    /// Whether the command has used the seed, so that the answer may depend on it.
    seed_taken: Cell<bool>,
    json: bool,
    quiet: bool,
    digits: usize,
    /// Options that were typed, by their identifiers.
    typed: Vec<String>,
    warnings: Vec<FileWarning>,
    /// The designs that were read: name and file.
    designs: Vec<(String, String)>,
    /// The notes written once.
    noted: RefCell<Vec<String>>,
}

impl Context {
    pub(crate) fn new(global: &Global, matches: &ArgMatches) -> Self {
        let Global { json, seed, quiet, digits } = *global;
        Self {
            seed,
            seed_taken: Cell::new(false),
            json,
            quiet,
            digits: digits.into(),
            typed: typed(matches),
            warnings: Vec::new(),
            designs: Vec::new(),
            noted: RefCell::default(),
        }
    }

    /// The context of a command without arguments, for tests.
    #[cfg(test)]
    pub(crate) fn silent() -> Self {
        Self::new(&Global { json: false, seed: 1, quiet: true, digits: 3 }, &ArgMatches::default())
    }

    /// Refuses an option that was typed but has no effect for `reason`: no option is silently ignored.
    ///
    /// # Errors
    /// Exit 2, `usage::no_effect`.
    pub(crate) fn no_effect(&self, option: &str, reason: &str) -> Result<(), Failure> {
        if !self.typed.iter().any(|id| id == option) {
            return Ok(());
        }
        let option = option.replace('_', "-");
        let failure =
            Failure::refused("usage::no_effect", format!("--{option} has no effect here: {reason}"));
        Err(failure.with_help(format!("leave out --{option}")))
    }

    /// `--seed`: the only source of randomness.
    pub(crate) fn seed(&self) -> u64 {
        self.seed_taken.set(true);
        self.seed
    }

    /// The program, seed and files behind the answer.
    pub(crate) fn provenance(&self) -> ProvenanceRecord {
        let texts = files::texts_read();
        let source = |(name, path): &(String, String)| {
            let text = texts.iter().find(|text| text.path == *path)?;
            Some(DesignSourceRecord {
                name: name.clone(),
                path: Some(path.clone()),
                sha256: text.sha256.clone(),
            })
        };
        let is_design = |text: &FileSourceRecord| self.designs.iter().any(|(_, path)| *path == text.path);
        ProvenanceRecord {
            seed: self.seed_taken.get().then_some(self.seed),
            designs: self.designs.iter().filter_map(source).collect(),
            files: texts.iter().filter(|text| !is_design(text)).cloned().collect(),
            ..ProvenanceRecord::default()
        }
    }

    /// `--json`: lets commands skip rendering of text that is not shown.
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    /// `--quiet`: no progress on standard error.
    pub(crate) fn quiet(&self) -> bool {
        self.quiet
    }

    /// `--digits`: of the numbers printed for people.
    pub(crate) fn digits(&self) -> usize {
        self.digits
    }

    pub(crate) fn warnings(&self) -> &[FileWarning] {
        &self.warnings
    }

    /// Writes a part of the answer to standard error, even with `--quiet`.
    pub(crate) fn note(&self, words: &str) {
        if !self.json {
            diagnostic::print_note(words);
        }
    }

    /// Writes such a part of the answer once, however often it applies.
    pub(crate) fn note_once(&self, words: String) {
        let mut noted = self.noted.borrow_mut();
        if !noted.contains(&words) {
            self.note(&words);
            noted.push(words);
        }
    }

    /// Tells of the symmetry that makes an answer a proof.
    pub(crate) fn offer_symmetry(&self, snapped: Option<SnappedDesign>, units: &str) {
        if let Some(snapped) = snapped {
            self.note(&format!(
                "The joints have a symmetry but for {:.1e} {units}, and the exact design has a proof: `equipod design convert DESIGN --snap -o FILE` writes it.",
                snapped.off()
            ));
        }
    }

    /// Reports guesses about a table.
    pub(crate) fn note_guesses(&self, table: &str, guesses: &[String]) {
        for guess in guesses.iter().filter(|_| !self.quiet) {
            diagnostic::print_note(&format!("{table}: {guess}"));
        }
    }

    /// Reads and checks a design file, `-` for standard input; its warnings are shown and kept for the JSON document.
    /// Rods on cranks and joints that are not ideal are refused; commands that accept them call
    /// [`Self::load_with_cranks`].
    ///
    /// # Errors
    /// Exit 2 with all violations, or because the file cannot be read.
    pub(crate) fn load(&mut self, path: &Path) -> Result<Design, Failure> {
        self.read_design(path, parse).map(|read| read.design)
    }

    /// As [`Self::load`], with the texts of the design, for commands that keep them.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub(crate) fn load_with_texts(&mut self, path: &Path) -> Result<ReadDesign, Failure> {
        self.read_design(path, parse)
    }

    /// As [`Self::load`], for commands that handle rods on cranks and joints that are not ideal.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub(crate) fn load_with_cranks(&mut self, path: &Path) -> Result<Design, Failure> {
        self.read_design(path, parse_with_cranks).map(|read| read.design)
    }

    /// As [`Self::load`], for commands that handle rods on cranks, and take joints as ideal.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub(crate) fn load_ideal(&mut self, path: &Path) -> Result<Design, Failure> {
        self.read_design(path, parse_ideal).map(|read| read.design)
    }

    /// The cranks of a design, if it has any.
    ///
    /// # Errors
    /// Exit 2: cranks and joints that make no platform.
    pub(crate) fn cranks_of(design: &Design) -> Result<Option<RotaryPlatform>, Failure> {
        design.rotary().map_err(|why| Failure::refused("design::invalid", format!("{}: {why}", design.name)))
    }

    /// The legs of a design with joints that are not ideal.
    ///
    /// # Errors
    /// Exit 2: drives without a length at home, where their twists are zero.
    pub(crate) fn coupled_of(design: &Design) -> Result<Option<CoupledLegs>, Failure> {
        if !design.hardware.is_coupled() {
            return Ok(None);
        }
        let home = crate::app::cli::poses::home(design);
        let refused = |why| Failure::refused("design::not_ideal", format!("{}: at home {why}", design.name));
        CoupledLegs::new(design.manipulator(), &design.hardware, &home).map(Some).map_err(refused)
    }

    /// A design of six or five legs, for commands that handle both.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub(crate) fn load_six_or_five(
        &mut self,
        path: &Path,
        accepts: Accepts,
    ) -> Result<SixOrFive<Design>, Failure> {
        let text = files::read_text(path)?;
        let six = match parse_six_or_five(&text, format_of(path, &text), accepts) {
            Ok((SixOrFive::Five(five), warnings)) => {
                self.warn(path, &text, warnings);
                self.designs.push((five.name.clone(), path.display().to_string()));
                return Ok(SixOrFive::Five(five));
            }
            Ok((SixOrFive::Six(six), warnings)) => Ok(((*six).into(), warnings)),
            Err(violations) => Err(violations),
        };
        self.accept(path, text, six).map(|read| SixOrFive::Six(Box::new(read.design)))
    }

    fn warn(&mut self, path: &Path, text: &str, warnings: Vec<Warning>) {
        for warning in warnings {
            if !self.quiet {
                diagnostic::print_warning(&files::shown(path), text, &warning);
            }
            self.warnings.push(FileWarning { path: path.display().to_string(), warning });
        }
    }

    fn read_design(
        &mut self,
        path: &Path,
        read: fn(&str, Format) -> DesignOrViolations,
    ) -> Result<ReadDesign, Failure> {
        let text = files::read_text(path)?;
        let read = read(&text, format_of(path, &text));
        self.accept(path, text, read)
    }

    /// Keeps the warnings of a design that was read, and the poses that its workspace names.
    fn accept(&mut self, path: &Path, text: String, read: DesignOrViolations) -> Result<ReadDesign, Failure> {
        match read {
            Ok((mut design, warnings)) => {
                self.warn(path, &text, warnings);
                let mut poses = None;
                let frames =
                    PoseFrames { convention: design.trajectory_frames(), home: design.home_or_default() };
                let units = design.units.clone();
                if let Some(trajectory) = &mut design.workspace.trajectory {
                    // the name is relative to the folder of the design
                    let table = path.parent().unwrap_or(Path::new("")).join(&trajectory.file);
                    let bytes = files::read_table(&table)?;
                    let read =
                        rows::poses_of(&bytes, &table, "design::bad_trajectory", (&frames, &units), self)?;
                    trajectory.poses = read.rows.into_iter().map(|row| row.value).collect();
                    poses = Some((table, bytes));
                }
                self.designs.push((design.name.clone(), path.display().to_string()));
                Ok(ReadDesign { design, text, poses })
            }
            Err(violations) => Err(Failure::bad_design(files::shown(path), text, violations)),
        }
    }
}

/// A design with its texts.
#[derive(Debug)]
pub(crate) struct ReadDesign {
    pub(crate) design: Design,
    pub(crate) text: String,
    /// The table of poses that its workspace names: its file, its bytes.
    pub(crate) poses: Option<(PathBuf, Vec<u8>)>,
}

/// The notation of a design: by the file name or, on standard input, by the first character.
pub(crate) fn format_of(path: &Path, text: &str) -> Format {
    let begins = text.trim_start_matches('\u{feff}').trim_start();
    if files::is_standard(path) && begins.starts_with('{') { Format::Json } else { Format::of_path(path) }
}

/// The options that were typed after the last command.
fn typed(matches: &ArgMatches) -> Vec<String> {
    if let Some((_, below)) = matches.subcommand() {
        return typed(below);
    }
    let given = |id: &&clap::Id| matches.value_source(id.as_str()) == Some(ValueSource::CommandLine);
    matches.ids().filter(given).map(ToString::to_string).collect()
}

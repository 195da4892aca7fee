//! `equipod build drives`: the fit of the drives of a table to the design.

use std::path::{Path, PathBuf};

use crate::app::cli::commands::motion;
use crate::app::cli::{Answer, Context, Failure, OutputPath, files};
use ::files::design::{AssessedForces, Drive, DriveTable};
use ask::Design;
use ask::PlatformMotion;
use machine::requirements::TermKind;
use records::{DriveRecord, DrivesAnswer, LightestDriveRecord};

/// Arguments of `build drives`.
#[derive(Debug, clap::Args)]
pub(crate) struct BuildDrivesArgs {
    /// Design file (.toml or .json) with home, workspace, limits and loads
    design: PathBuf,
    /// Table of drives (.csv) with columns such as `force_N` and `price_EUR`; default: `drives` in `[hardware]`
    table: Option<PathBuf>,
    /// Table of times and poses; the drives must be fast and strong enough for it
    #[arg(long, value_name = "FILE")]
    trajectory: Option<PathBuf>,
    /// Sine about home: x, y, z (design units), roll, pitch or yaw (degrees), amplitude and frequency; repeat for
    /// several
    #[arg(long, value_name = "AXIS:AMPLITUDE:HERTZ", allow_hyphen_values = true)]
    sine: Vec<String>,
    /// Acceleration from rest at home, design units or degrees per second squared; repeat for several
    #[arg(long, value_name = "AXIS:ACCELERATION", allow_hyphen_values = true)]
    accelerate: Vec<String>,
    /// Length unit of the design for forces along motions, if its label is not one: um, mm, cm, m, in, ft
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Write the design with the chosen drive (.json, else TOML)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// Exit 0 if a drive is proved to fit, 1 if all are proved not to, otherwise 3.
pub(crate) fn run(args: &BuildDrivesArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let Some(table) = asked(args.table.as_deref(), &args.design, &design, context)? else {
        let message = "neither the command nor the design names a table of drives";
        return Err(Failure::refused("drives::no_table", message)
            .with_help("give a table, or add drives = \"drives.csv\" to [hardware]"));
    };
    let choice = motion::ChosenMotions::new(args.trajectory.as_deref(), &args.sine, &args.accelerate);
    if choice.is_empty() {
        context.no_effect("unit", "there is no motion")?;
    }
    let (names, motions): (Vec<String>, Vec<PlatformMotion>) =
        choice.motions(&design, context)?.into_iter().unzip();
    // without a payload there are no forces along motions
    let metres = if choice.is_empty() || design.moving_payload().is_none() {
        None
    } else {
        Some(motion::metres(args.unit.as_deref(), &design)?)
    };
    let found = design.fit_drives(&table.drives, &motions, metres, context.seed());
    let drives: Vec<DriveRecord> = found.iter().map(|fit| DriveRecord::new(fit, &names)).collect();
    let chosen = found.first().filter(|fit| fit.fits() == Some(true));
    let met = match chosen {
        Some(_) => Some(true),
        None if drives.iter().all(|d| d.fits == Some(false)) => Some(false),
        None => None,
    };
    let mut output = None;
    if let (Some(path), Some(fit)) = (&args.output, chosen) {
        files::write_design(path, &fit.design)?;
        output = Some(path.display().to_string());
    }
    let units = design.drive_units();
    let answer = DrivesAnswer {
        name: design.name.clone(),
        met,
        chosen: chosen.map(|fit| fit.drive.name.clone()),
        drives,
        currency: table.currency,
        length_unit: design.units.clone(),
        force_unit: units.force.label().into(),
        mass_unit: units.mass.label().into(),
        assumptions: assumptions(&design, &table.drives, metres.is_some()),
        design: chosen.map(|fit| (&fit.design).into()),
        output,
    };
    let text = sheet::answers::drives(&answer);
    Ok(Answer::new(met.into(), answer, text))
}

/// The table of drives named by an option, or by the design relative to its file.
pub(in crate::app::cli::commands) fn asked(
    option: Option<&Path>,
    file: &Path,
    design: &Design,
    context: &Context,
) -> Result<Option<DriveTable>, Failure> {
    let beside = design.drive_table.as_ref().map(|name| file.parent().unwrap_or(Path::new("")).join(name));
    option.map(Path::to_path_buf).or(beside).map(|path| table(&path, design, context)).transpose()
}

/// The lightest drive of the table that a design names; `None` if it names none.
pub(in crate::app::cli::commands) fn lightest(
    file: &Path,
    design: &Design,
    context: &Context,
) -> Result<Option<LightestDriveRecord>, Failure> {
    let Some(table) = asked(None, file, design, context)? else { return Ok(None) };
    let found = design.lightest_drive(&table.drives, context.seed());
    Ok(Some(LightestDriveRecord::new(&found, design.drive_units().mass.label())))
}

/// Reads a table of drives in the units of a design.
pub(in crate::app::cli::commands) fn table(
    path: &Path,
    design: &Design,
    context: &Context,
) -> Result<DriveTable, Failure> {
    let shown = files::shown(path);
    let found = DriveTable::read(&files::read_table(path)?, &design.drive_units());
    let table = found.map_err(|why| {
        Failure::refused("drives::bad_table", format!("{shown}: {why}")).with_help(
            "name the columns in the first line, `name,stroke_mm,dead_length_mm,force_N,speed_mm/s,mass_kg,stiffness_N/mm,price_EUR,source`, of which stroke and dead_length (or retracted_length) are needed",
        )
    })?;
    context.note_guesses(&shown, &table.guesses);
    Ok(table)
}

/// Values assumed because neither the design nor a drive states them.
fn assumptions(design: &Design, drives: &[Drive], with_forces: bool) -> Vec<String> {
    let mut out = Vec::new();
    let h = &design.hardware;
    let mut silent = |what: &str, of: fn(&Drive) -> Option<f64>, own: bool| {
        let count = drives.iter().filter(|d| of(d).is_none()).count();
        if count == 0 {
            return;
        }
        let whose = if own { "that of the design is kept" } else { "nothing limits it" };
        let subject = if count == drives.len() {
            "No drive of the table has".to_owned()
        } else {
            format!("{count} of the {} drives do not have", drives.len())
        };
        out.push(format!("{subject} a {what}: {whose}."));
    };
    silent("force", |d| d.force, h.drive_limit(TermKind::LegForce).is_some());
    silent("speed", |d| d.speed, h.drive_limit(TermKind::LegSpeed).is_some());
    if h.leg_masses.is_none() && drives.iter().any(|d| d.mass.is_some()) {
        out.push(
            "The legs have no masses in [hardware]: masses of drives only rank drives of equal price.".into(),
        );
    }
    if design.requirements().loads.is_empty() {
        out.push("The design has neither loads nor masses: the drives carry no force at rest.".into());
    }
    let at_rest = h.drive_limit(TermKind::LegForce).is_some() || drives.iter().any(|d| d.force.is_some());
    let at_rest = at_rest && !design.requirements().loads.is_empty();
    out.extend(design.assumptions_of(AssessedForces { at_rest, in_motion: with_forces }));
    out
}

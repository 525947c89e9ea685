//! `pendula bench`: run time against error, on this machine.

use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::book::preprocess::work_precision::{self, CSV, SVG};
use anyhow::Context;
use clap::Args;
use pendula_study::report::table::Table;
use serde_json::{Value, json};

use crate::book::locate;
use crate::book::progress::Progress;
use crate::commands::number::number;
use crate::commands::output::{Stream, TableFormat, is_lost};
use crate::output::failure::Failure;
use crate::output::files;
use crate::output::files::whole_file::{self, Change};
use crate::work_precision::figure;
use crate::work_precision::{Budget, Curve, Measured, Measurement, Problem, SCENES, measure};

/// Arguments of `pendula bench`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How the table is printed
    #[arg(long, value_enum, default_value_t)]
    format: TableFormat,
    /// Measure for about this long at most (s); a longer time reaches smaller errors
    #[arg(long, value_name = "S", default_value_t = 15.0, value_parser = number)]
    seconds: f64,
    /// Write work-precision.svg and work-precision.csv to this folder, not to the one where the
    /// book looks for them
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Measures, prints the table, and writes the figure and the numbers to their files: for each scene
/// and method the steps that count, with their error (rad) and run time (s).
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    run_with(arguments, Budget::Seconds(arguments.seconds), out)
}

/// The same with this budget instead of the seconds.
pub fn run_with(arguments: &Arguments, budget: Budget, out: &mut dyn Write) -> Result<(), Failure> {
    let seconds = arguments.seconds;
    if !(seconds > 0.0 && seconds <= 3600.0) {
        return Err(Failure::refused(format!(
            "--seconds cannot be {seconds:?}. It must be greater than zero and at most 3600"
        )));
    }
    let folder = folder(arguments.output.as_deref())?;
    for file in [SVG, CSV].map(|file| folder.join(file)) {
        if Stream::Output.leads_to(&file) {
            return Err(Stream::Output.refusal("the table and the files", &file));
        }
    }
    let measured = measure(budget, &Progress::on_terminal());
    let printed = print(arguments.format, &measured, &folder, out);
    if !is_lost(&printed) {
        whole_file::change(&[
            Change::Written(folder.join(SVG), figure::svg(&measured).into_bytes()),
            Change::Written(folder.join(CSV), csv(&measured).into_bytes()),
        ])?;
    }
    Ok(printed?)
}

/// Prints the table, all of it; as text, with the names of the files in the folder.
fn print(
    format: TableFormat,
    measured: &Measured,
    folder: &Path,
    out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        TableFormat::Text => {
            write_text(measured, out)?;
            let [svg, csv] = [SVG, CSV].map(|file| folder.join(file));
            writeln!(out, "\n{}\n{}", svg.display(), csv.display())?;
        }
        TableFormat::Csv => out.write_all(csv(measured).as_bytes())?,
        TableFormat::Json => {
            let rows: Vec<Value> =
                points(measured).map(|(curve, point)| object(measured, curve, point)).collect();
            writeln!(out, "{:#}", json!(rows))?;
        }
    }
    out.flush()
}

/// The folder for the files, checked to be writable before anything is measured.
fn folder(asked: Option<&Path>) -> Result<PathBuf, Failure> {
    let folder = match asked {
        Some(folder) => folder.to_path_buf(),
        None => {
            let here = env::current_dir().context("the current directory cannot be read")?;
            let folder = work_precision::folder(&locate::book(&here)?);
            let cannot = || format!("{} cannot be made", folder.display());
            files::create_folder(&folder).with_context(cannot)?;
            files::canonicalize(&folder).with_context(cannot)?
        }
    };
    files::probe(&folder).map_err(|error| {
        let folder = folder.display();
        Failure::refused(format!(
            "--output {folder}: it must be a folder that can be written to: {error}"
        ))
    })?;
    Ok(folder)
}

fn points(measured: &Measured) -> impl Iterator<Item = (&Curve, &Measurement)> {
    measured.curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)))
}

fn csv(measured: &Measured) -> String {
    let line = |(curve, point): (&Curve, &Measurement)| {
        let Problem { theta0, duration } = curve.scene;
        let Measurement { dt, steps, error, seconds, .. } = point;
        let (name, instructions) = (curve.method.info().name, measured.instructions);
        format!(
            "{theta0:?},{duration},{name},{dt:?},{steps},{error:?},{seconds:?},{instructions}\n"
        )
    };
    let header = "theta0,duration,method,dt,steps,error,seconds,instructions\n".to_owned();
    header + &points(measured).map(line).collect::<String>()
}

fn object(measured: &Measured, curve: &Curve, point: &Measurement) -> Value {
    json!({
        "theta0": curve.scene.theta0,
        "duration": curve.scene.duration,
        "method": curve.method.info().name,
        "dt": point.dt,
        "steps": point.steps,
        "error": point.error,
        "seconds": point.seconds,
        "instructions": measured.instructions,
    })
}

fn write_text(measured: &Measured, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "Run time against error on {}; only steps whose error", measured.instructions)?;
    writeln!(
        out,
        "falls as the order of the method says, and a dash where there was time for none"
    )?;
    for scene in SCENES {
        let mut table = Table::new(["Method", "steps", "Δt (s)", "error (rad)", "time (s)"]);
        for curve in measured.curves.iter().filter(|curve| curve.scene == scene) {
            let title = curve.method.info().title;
            if curve.points.is_empty() {
                table.push([title, "—", "—", "—", "—"]);
            }
            for (index, Measurement { dt, steps, error, seconds, .. }) in
                curve.points.iter().enumerate()
            {
                table.push([
                    if index == 0 { title.to_string() } else { String::new() },
                    steps.to_string(),
                    format!("{dt:.2e}"),
                    format!("{error:.1e}"),
                    format!("{seconds:.2e}"),
                ]);
            }
        }
        let Problem { theta0, duration } = scene;
        write!(out, "\nFrom {theta0} rad, after {duration} s\n{}", table.to_text())?;
    }
    Ok(())
}

//! `pendula bench`: run time against error, on this machine.

use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use pendula_book::preprocess::work_precision::{self, CSV, SVG};
use pendula_study::report::table::Table;
use serde_json::{Value, json};

use crate::commands::arguments::number::number;
use crate::commands::arguments::table_format::TableFormat;
use crate::work_precision::figure;
use crate::work_precision::{Curve, Measured, Measurement, SCENES, measure};
use pendula_book::locate;
use pendula_book::progress::Progress;
use pendula_output::failure::Failure;
use pendula_output::files;
use pendula_output::files::together::{self, Change};
use pendula_output::interrupt::interrupts;

/// Arguments of `pendula bench`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How the table is printed
    #[arg(long, value_enum, default_value_t)]
    format: TableFormat,
    /// Measure for at most about this long (s): the longer, the smaller the smallest errors
    #[arg(long, value_name = "S", default_value_t = 15.0, value_parser = number,
        allow_hyphen_values = true)]
    seconds: f64,
    /// Write work-precision.svg and work-precision.csv to this folder instead of the one where the
    /// book looks for them
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Measures, writes the figure and the numbers to their files, and prints the table: for each scene
/// and method the steps that count, with their error (rad) and run time (s).
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let seconds = arguments.seconds;
    if !(seconds > 0.0 && seconds <= 3600.0) {
        return Err(Failure::refused(format!(
            "--seconds {seconds:?}: it must be greater than zero and at most 3600"
        )));
    }
    let folder = folder(arguments.output.as_deref())?;
    let measured = measure(seconds, &Progress::on_terminal());
    // What is begun is finished, as it takes no time.
    interrupts()?;
    let csv = write_files(&folder, &measured)?;
    match arguments.format {
        TableFormat::Text => {
            write_text(&measured, out)?;
            let [svg, csv] = [SVG, CSV].map(|file| folder.join(file));
            writeln!(out, "\n{}\n{}", svg.display(), csv.display())?;
        }
        TableFormat::Csv => out.write_all(&csv)?,
        TableFormat::Json => {
            let rows: Vec<Value> =
                rows(&measured).map(|(curve, p)| object(&measured, curve, p)).collect();
            serde_json::to_writer_pretty(&mut *out, &rows).context("the rows cannot be written")?;
            writeln!(out)?;
        }
    }
    Ok(())
}

/// Writes the figure and the numbers, both or neither; returns the numbers.
pub(crate) fn write_files(folder: &Path, measured: &Measured) -> Result<Vec<u8>, Failure> {
    let mut csv = Vec::new();
    write_csv(measured, &mut csv)?;
    together::change(&[
        Change::Written(folder.join(SVG), figure::svg(measured).into_bytes()),
        Change::Written(folder.join(CSV), csv.clone()),
    ])?;
    Ok(csv)
}

/// The folder for the files, checked to be writable before anything is measured.
pub(crate) fn folder(asked: Option<&Path>) -> Result<PathBuf, Failure> {
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

fn rows(measured: &Measured) -> impl Iterator<Item = (&Curve, &Measurement)> {
    measured.curves.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)))
}

fn write_csv(measured: &Measured, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "theta0,duration,method,dt,steps,error,seconds,instructions")?;
    for (curve, Measurement { dt, steps, error, seconds }) in rows(measured) {
        let (scene, name) = (curve.scene, curve.method.info().name);
        write!(out, "{:?},{},{name},{dt:?},{steps},", scene.theta0, scene.duration)?;
        writeln!(out, "{error:?},{seconds:?},{}", measured.instructions)?;
    }
    Ok(())
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
            for (index, Measurement { dt, steps, error, seconds }) in
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
        write!(
            out,
            "\nFrom {} rad, after {} s\n{}",
            scene.theta0,
            scene.duration,
            table.to_text()
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use pendula::METHODS;

    use super::*;

    /// The two of one measurement.
    ///
    /// Catches: a number under another heading, or in another unit than its heading or the file
    /// says; digits cut off; a line of one that the other lacks.
    #[test]
    fn the_table_agrees_with_the_file() {
        let point = |k: i32| Measurement {
            dt: 0.25 * 0.5_f64.powi(k),
            steps: 400 << k,
            error: 0.3 * 0.25_f64.powi(k),
            seconds: 1.23456e-6 * 2.0_f64.powi(k),
        };
        let points: Vec<Measurement> = (0..5).map(point).collect();
        let curve = |scene| Curve { scene, method: METHODS[0], points: points.clone() };
        let measured =
            Measured { instructions: "an abacus", curves: SCENES.map(curve).into_iter().collect() };
        let printed = |write: fn(&Measured, &mut dyn Write) -> io::Result<()>| {
            let mut out = Vec::new();
            write(&measured, &mut out).unwrap();
            String::from_utf8(out).unwrap()
        };
        let (text, csv) = (printed(write_text), printed(write_csv));
        let headings = text.lines().find(|line| line.starts_with("Method")).unwrap();
        let headings = headings.split("  ").map(str::trim).filter(|name| !name.is_empty());
        assert!(headings.eq(["Method", "steps", "Δt (s)", "error (rad)", "time (s)"]), "{text}");
        // The last four fields of the lines that have them, as numbers.
        let cells = text.lines().filter_map(|line| {
            let mut fields = line.split_whitespace().rev().map(|field| field.parse::<f64>().ok());
            let [seconds, error, dt, steps] = [(); 4].map(|()| fields.next().flatten());
            Some([steps?, dt?, error?, seconds?])
        });
        let cells: Vec<[f64; 4]> = cells.collect();
        assert_eq!(csv.lines().next().unwrap().split(',').nth(6), Some("seconds"));
        let rows = csv.lines().skip(1).map(|line| {
            let field = |name| line.split(',').nth(name).unwrap().parse::<f64>().unwrap();
            [4, 3, 5, 6].map(field)
        });
        let rows: Vec<[f64; 4]> = rows.collect();
        assert_eq!((cells.len(), rows.len()), (15, 15));
        // Half a unit in the last printed digit, of a number whose first digit is 1: 1.00 and 1.0.
        let within = [0.0, 0.005, 0.05, 0.005];
        for (cell, row) in cells.iter().zip(&rows) {
            for ((printed, value), within) in cell.iter().zip(row).zip(within) {
                assert!((printed / value - 1.0).abs() <= within, "{printed}, {value}\n{text}");
            }
        }
    }
}

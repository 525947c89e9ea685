//! `pendula exact`: the closed form at given times; without times the exact period, the quantities
//! in its formula, and what motion it is.

use std::f64::consts::TAU;
use std::io::Write;

use clap::Args;
use pendula::exact::Swing;
use pendula::{Motion, MotionKind, Pendulum, Phase};

use super::number::{angle, number};
use super::output::{Destination, RowFormat, Rows};
use super::system::PendulumArguments;
use crate::output::failure::Failure;

/// Arguments of `pendula exact`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Angle at the start: in radians, or like pi/3 or 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    theta0: f64,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number)]
    omega0: f64,
    /// Times (s), separated by commas; without them, print the period and the kind of motion
    #[arg(long, value_name = "T1,T2,…", value_delimiter = ',', value_parser = number)]
    t: Vec<f64>,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t, requires = "t")]
    format: RowFormat,
}

/// Writes the rows t, theta, omega: in s, rad and rad/s, θ unwrapped. Without times, a line for
/// each of T and T₀ (s), T/T₀, K and the modulus k, and one that says what motion it is.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let Arguments { theta0, omega0, ref t, .. } = *arguments;
    let pendulum = arguments.pendulum.pendulum(Pendulum::PAPER.mass());
    let pendulum = pendulum.map_err(Failure::refused)?;
    let start = pendulum.start(theta0, omega0).map_err(Failure::refused)?;
    let motion = Motion::new(&pendulum, start).map_err(Failure::refused)?;
    if t.is_empty() {
        return period(&pendulum, start, &motion, out);
    }
    let horizon = motion.horizon();
    if let Some(t) = t.iter().find(|t| !(-horizon..=horizon).contains(*t)) {
        return Err(Failure::refused(format!(
            "t cannot be {t:?} s. It must be a number of at most {horizon:e} s in size, because \
             beyond that neighbouring f64s are a quarter of a period apart, or more"
        )));
    }
    let (out, columns) = (Destination::Caller(out), ["t", "theta", "omega"]);
    let mut rows = Rows::begin((None, out), arguments.format, columns, true)?;
    for &t in t {
        let z = motion.at(t);
        rows.row([t, z.theta, z.omega])?;
    }
    rows.finish()
}

/// K is that of a release from rest, and with an angular velocity it is left out; T is left out
/// where the motion never repeats.
fn period(
    pendulum: &Pendulum,
    start: Phase,
    motion: &Motion,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let small = pendulum.small_angle_period();
    if start.omega == 0.0 {
        let swing = Swing::released_at(pendulum, start.theta).map_err(Failure::refused)?;
        writeln!(out, "T       {:?} s", swing.period())?;
        writeln!(out, "T0      {small:?} s")?;
        writeln!(out, "T/T0    {:?}", swing.ratio())?;
        writeln!(out, "K       {:?}", swing.elliptic_k())?;
        writeln!(out, "modulus {:?}", swing.modulus())?;
    } else {
        if let Some(period) = motion.period() {
            writeln!(out, "T       {period:?} s")?;
        }
        writeln!(out, "T0      {small:?} s")?;
        if let Some(period) = motion.period() {
            writeln!(out, "T/T0    {:?}", period / small)?;
        }
        writeln!(out, "modulus {:?}", motion.modulus())?;
    }
    writeln!(out, "motion  {}", described(motion, start.theta, start.omega))?;
    Ok(())
}

/// What motion it is, in words.
fn described(motion: &Motion, theta0: f64, omega0: f64) -> String {
    match (motion.kind(), motion.period()) {
        (MotionKind::Rest, _) => "rest; T is the limit of small swings".to_owned(),
        (MotionKind::Separatrix, _) => {
            "separatrix: it approaches the top and never comes back".to_owned()
        }
        (MotionKind::Rotation, _) => {
            let way = if omega0 > 0.0 { "forwards" } else { "backwards" };
            format!("rotation {way}; T is the time of a turn")
        }
        (MotionKind::Libration, period) if omega0 == 0.0 => {
            // Half a period later it is at the other end, and the lowest point half way.
            let other = motion.at(0.5 * period.unwrap_or(0.0)).theta;
            let turns = ((theta0 + other) / (2.0 * TAU)).round();
            let about = match turns.abs() {
                0.0 => return format!("libration between {theta0:?} rad and {other:?} rad"),
                1.0 => "one full turn".to_owned(),
                more => format!("{more:.0} full turns"),
            };
            let sign = if turns > 0.0 { "" } else { "minus " };
            format!(
                "libration between {theta0:?} rad and {other:?} rad, around the lowest point at \
                 {sign}{about}"
            )
        }
        (MotionKind::Libration, _) => "libration".to_owned(),
    }
}

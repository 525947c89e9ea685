//! `pendula period`: the exact period, the quantities in its formula, and what motion it is.

use std::f64::consts::TAU;
use std::io::Write;

use clap::Args;
use pendula::exact::Swing;
use pendula::{Motion, MotionKind};

use super::pendulum_arguments::{PendulumArguments, StartArguments};
use crate::failure::Failure;

/// Arguments of `pendula period`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    start: StartArguments,
    #[command(flatten)]
    pendulum: PendulumArguments,
}

/// Writes a line for each of T and T₀ (s), T/T₀, K and the modulus k, and one that says what motion
/// it is. K is that of a release from rest, and with an angular velocity it is left out; T is left
/// out where the motion never repeats.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(None).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let motion = Motion::new(&pendulum, start).map_err(Failure::refused)?;
    let small = pendulum.small_angle_period();
    if start.omega == 0.0 {
        let swing = Swing::released_at(&pendulum, start.theta).map_err(Failure::refused)?;
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
    writeln!(out, "motion  {}", described(&motion, start.theta, start.omega))?;
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
                1.0 => "1 turn".to_owned(),
                more => format!("{more:.0} turns"),
            };
            let way = if turns > 0.0 { "on" } else { "back" };
            format!(
                "libration between {theta0:?} rad and {other:?} rad, about the lowest point \
                 {about} {way}"
            )
        }
        (MotionKind::Libration, _) => "libration".to_owned(),
    }
}

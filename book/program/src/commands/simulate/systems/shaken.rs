//! The pendulum whose pivot is shaken.

use anyhow::Result;
use pendula::{Pendulum, Phase, Shaken};

use super::Simulated;
use super::parameters::{Parameter, SystemArguments};
use super::pendulum::{self, FORCED, GRAVITY, LENGTH, MASS, OMEGA0, THETA0};
use crate::commands::output::Summary;
use crate::commands::plot::Panel;

static AMPLITUDE: Parameter =
    Parameter::number("pivot-amplitude", "M", "Shaken: amplitude a of the pivot's motion (m)")
        .under(FORCED);
static FREQUENCY: Parameter = Parameter::number(
    "pivot-frequency",
    "RAD/S",
    "Shaken: angular frequency Ω of the pivot's motion (rad/s)",
)
.under(FORCED);

impl Simulated<4> for Shaken {
    const NAME: &'static str = "shaken";
    const ABOUT: &'static str =
        "With its pivot shaken up and down by a cos Ωt: θ̈ + (g − aΩ² cos Ωt)/L sin θ = 0";
    const CALLED: &'static str = "shaken pendulum";
    const PARAMETERS: &'static [&'static Parameter] =
        &[&THETA0, &OMEGA0, &GRAVITY, &LENGTH, &MASS, &AMPLITUDE, &FREQUENCY];
    const COLUMNS: [&'static str; 4] = pendulum::COLUMNS;
    const PANELS: &'static [Panel] = pendulum::PANELS;

    fn chosen(given: &SystemArguments) -> Result<(Self, Phase)> {
        let (pendulum, start) = Pendulum::chosen(given)?;
        Ok((Self::new(pendulum, given.value(&AMPLITUDE)?, given.value(&FREQUENCY)?)?, start))
    }

    fn row(&self, t: f64, z: Phase) -> [f64; 4] {
        pendulum::row(self.pendulum(), t, z)
    }

    fn summarise(&self, summary: &mut Summary, start: Phase, _t: f64, end: Phase) {
        pendulum::energy_at_the_end(summary, self.pendulum(), start, end);
    }
}

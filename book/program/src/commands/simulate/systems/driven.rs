//! The driven pendulum.

use anyhow::Result;
use pendula::{Damped, Driven, Pendulum, Phase};

use super::Simulated;
use super::damped::DAMPING;
use super::parameters::{Parameter, SystemArguments};
use super::pendulum::{self, FORCED, GRAVITY, LENGTH, MASS, OMEGA0, THETA0};
use crate::commands::output::Summary;
use crate::commands::plot::Panel;

static STRENGTH: Parameter =
    Parameter::number("drive-strength", "G", "Driven: strength γ of the torque, in units of m g L")
        .under(FORCED);
static FREQUENCY: Parameter = Parameter::number(
    "drive-frequency",
    "RAD/S",
    "Driven: angular frequency Ω of the torque (rad/s)",
)
.under(FORCED);

impl Simulated<4> for Driven {
    const NAME: &'static str = "driven";
    const ABOUT: &'static str =
        "With friction and a periodic torque: θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt";
    const CALLED: &'static str = "driven pendulum";
    const PARAMETERS: &'static [&'static Parameter] =
        &[&THETA0, &OMEGA0, &GRAVITY, &LENGTH, &MASS, &DAMPING, &STRENGTH, &FREQUENCY];
    const COLUMNS: [&'static str; 4] = pendulum::COLUMNS;
    const PANELS: &'static [Panel] = pendulum::PANELS;

    fn chosen(given: &SystemArguments) -> Result<(Self, Phase)> {
        let (pendulum, start) = Pendulum::chosen(given)?;
        let damped = Damped::new(pendulum, given.given(&DAMPING).unwrap_or(0.0))?;
        Ok((Self::new(damped, given.value(&STRENGTH)?, given.value(&FREQUENCY)?)?, start))
    }

    fn row(&self, t: f64, z: Phase) -> [f64; 4] {
        pendulum::row(self.damped().pendulum(), t, z)
    }

    fn summarise(&self, summary: &mut Summary, start: Phase, _t: f64, end: Phase) {
        pendulum::energy_at_the_end(summary, self.damped().pendulum(), start, end);
    }
}

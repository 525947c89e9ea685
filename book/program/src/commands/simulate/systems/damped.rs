//! The damped pendulum.

use anyhow::Result;
use pendula::{Damped, Pendulum, Phase};

use super::Simulated;
use super::parameters::{Parameter, SystemArguments};
use super::pendulum::{self, FORCED, GRAVITY, LENGTH, MASS, OMEGA0, THETA0};
use crate::commands::output::Summary;
use crate::commands::plot::Panel;

/// The driven pendulum has it too.
pub static DAMPING: Parameter = Parameter::number(
    "damping",
    "1/S",
    "Damped or driven: damping β (1/s), the rate at which small swings decay [driven: default 0]",
)
.under(FORCED);

impl Simulated<4> for Damped {
    const NAME: &'static str = "damped";
    const ABOUT: &'static str = "With friction: θ̈ + 2β θ̇ + ω₀² sin θ = 0";
    const CALLED: &'static str = "damped pendulum";
    const PARAMETERS: &'static [&'static Parameter] =
        &[&THETA0, &OMEGA0, &GRAVITY, &LENGTH, &MASS, &DAMPING];
    const COLUMNS: [&'static str; 4] = pendulum::COLUMNS;
    const PANELS: &'static [Panel] = pendulum::PANELS;

    fn chosen(given: &SystemArguments) -> Result<(Self, Phase)> {
        let (pendulum, start) = Pendulum::chosen(given)?;
        Ok((Self::new(pendulum, given.value(&DAMPING)?)?, start))
    }

    fn row(&self, t: f64, z: Phase) -> [f64; 4] {
        pendulum::row(self.pendulum(), t, z)
    }

    fn summarise(&self, summary: &mut Summary, start: Phase, _t: f64, end: Phase) {
        pendulum::energy_at_the_end(summary, self.pendulum(), start, end);
    }
}

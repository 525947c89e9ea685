//! The pendulum itself, and what the systems made of it share.

use anyhow::Result;
use pendula::{Hamiltonian, Motion, Pendulum, Phase};

use super::Simulated;
use super::parameters::{Parameter, SystemArguments};
use crate::commands::output::Summary;
use crate::commands::plot::Panel;
use crate::commands::simulate::walk::{Series, by_series};

pub static THETA0: Parameter =
    Parameter::angle("theta0", "Angle at the start: in radians, or like pi/3 or 60deg");
pub static OMEGA0: Parameter =
    Parameter::number("omega0", "RAD/S", "Angular velocity at the start (rad/s)").or(0.0);
pub static GRAVITY: Parameter =
    Parameter::number("gravity", "GRAVITY", "Gravitational acceleration g (m/s²)")
        .or(Pendulum::PAPER.gravity());
pub static LENGTH: Parameter =
    Parameter::number("length", "M", "Length L of the rod (m)").or(Pendulum::PAPER.length());
pub static MASS: Parameter =
    Parameter::number("mass", "KG", "Mass m of the bob (kg)").or(Pendulum::PAPER.mass());

/// The heading of the options of systems that are made of it.
pub const FORCED: &str = "Damped, driven or shaken";

/// The columns of the rows.
pub const COLUMNS: [&str; 4] = ["t", "theta", "omega", "energy"];

/// What a plot shows of them.
pub const PANELS: &[Panel] = &[
    Panel::new("angle θ (rad)", &[(1, "")]),
    Panel::new("energy change (J)", &[(3, "")]).since_the_start(),
];

/// The row of a time and a state: in s, rad, rad/s and J, the energy as in the paper's Eq. 3.
pub fn row(pendulum: &Pendulum, t: f64, z: Phase) -> [f64; 4] {
    [t, z.theta, z.omega, pendulum.energy_from_pivot(z)]
}

/// Adds the energy of the state `end` to the summary, of a system that conserves none, and of which
/// there is no closed form.
pub fn energy_at_the_end(summary: &mut Summary, pendulum: &Pendulum, start: Phase, end: Phase) {
    let [first, last] = [start, end].map(|z| pendulum.energy(z));
    summary.line("energy at the end", format!("{last:.6e} J, of {first:.6e} J"));
}

impl Simulated<4> for Pendulum {
    const NAME: &'static str = "pendulum";
    const ABOUT: &'static str = "The simple pendulum";
    const CALLED: &'static str = "pendulum";
    const PARAMETERS: &'static [&'static Parameter] = &[&THETA0, &OMEGA0, &GRAVITY, &LENGTH, &MASS];
    const COLUMNS: [&'static str; 4] = COLUMNS;
    const PANELS: &'static [Panel] = PANELS;
    const SERIES: Option<Series<Self, 4>> = Some(by_series);

    fn chosen(given: &SystemArguments) -> Result<(Self, Phase)> {
        let [gravity, length] = [given.value(&GRAVITY)?, given.value(&LENGTH)?];
        let pendulum = Self::new(gravity, length, given.value(&MASS)?)?;
        let start = pendulum.start(given.value(&THETA0)?, given.value(&OMEGA0)?)?;
        Ok((pendulum, start))
    }

    fn row(&self, t: f64, z: Phase) -> [f64; 4] {
        row(self, t, z)
    }

    fn conserved(&self) -> Option<&dyn Hamiltonian<State = Phase>> {
        Some(self)
    }

    /// The errors against the closed form, if it reaches so far.
    fn summarise(&self, summary: &mut Summary, start: Phase, t: f64, end: Phase) {
        let Ok(motion) = Motion::new(self, start) else { return };
        if t.abs() <= motion.horizon() {
            let exact = motion.at(t);
            let [theta, omega] = [end.theta - exact.theta, end.omega - exact.omega];
            summary.line("error of θ at the end", format!("{theta:.6e} rad"));
            summary.line("error of ω at the end", format!("{omega:.6e} rad/s"));
        }
    }
}

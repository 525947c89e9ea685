//! The double pendulum.

use anyhow::Result;
use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Hamiltonian};

use super::Simulated;
use super::parameters::{Parameter, SystemArguments};
use super::pendulum::GRAVITY;
use crate::commands::plot::Panel;

static THETA1: Parameter = angle(
    "theta1",
    "Angle of the upper rod at the start, from the downward vertical: in radians, or like pi/3",
);
static THETA2: Parameter = angle(
    "theta2",
    "Angle of the lower rod at the start, from the downward vertical: in radians, or like pi/3",
);
static OMEGA1: Parameter =
    number("omega1", "RAD/S", "Angular velocity of the upper rod at the start (rad/s)", 0.0);
static OMEGA2: Parameter =
    number("omega2", "RAD/S", "Angular velocity of the lower rod at the start (rad/s)", 0.0);
static LENGTH1: Parameter = number("length1", "M", "Length of the upper rod (m)", 1.0);
static LENGTH2: Parameter = number("length2", "M", "Length of the lower rod (m)", 1.0);
static MASS1: Parameter = number("mass1", "KG", "Mass of the upper bob (kg)", 1.0);
static MASS2: Parameter =
    number("mass2", "KG", "Mass of the lower bob (kg), at most 1e6 times that of the upper", 1.0);

const HEADING: &str = "Double pendulum";

const fn angle(name: &'static str, help: &'static str) -> Parameter {
    Parameter::angle(name, help).under(HEADING)
}

const fn number(
    name: &'static str,
    unit: &'static str,
    help: &'static str,
    default: f64,
) -> Parameter {
    Parameter::number(name, unit, help).or(default).under(HEADING)
}

impl Simulated<10> for DoublePendulum {
    const NAME: &'static str = "double-pendulum";
    const ABOUT: &'static str = "Two pendulums, the second hung from the bob of the first";
    const CALLED: &'static str = "double pendulum";
    const PARAMETERS: &'static [&'static Parameter] =
        &[&GRAVITY, &THETA1, &THETA2, &OMEGA1, &OMEGA2, &LENGTH1, &LENGTH2, &MASS1, &MASS2];
    const COLUMNS: [&'static str; 10] =
        ["t", "theta1", "theta2", "omega1", "omega2", "x1", "y1", "x2", "y2", "energy"];
    const PANELS: &'static [Panel] = &[
        Panel::new("angle (rad)", &[(1, "upper rod, θ_{1}"), (2, "lower rod, θ_{2}")]),
        Panel::new("energy change (J)", &[(9, "")]).since_the_start(),
    ];
    const NEEDS_METHOD: bool = false;

    fn chosen(given: &SystemArguments) -> Result<(Self, DoublePhase)> {
        let theta = [given.value(&THETA1)?, given.value(&THETA2)?];
        let omega = [given.value(&OMEGA1)?, given.value(&OMEGA2)?];
        let upper = Joint { length: given.value(&LENGTH1)?, mass: given.value(&MASS1)? };
        let lower = Joint { length: given.value(&LENGTH2)?, mass: given.value(&MASS2)? };
        let double = Self::new(given.value(&GRAVITY)?, upper, lower)?;
        Ok((double, double.start(theta, omega)?))
    }

    /// In s, rad, rad/s, m and J: the positions of the bobs with the pivot as origin and y upwards,
    /// the energy above that of the equilibrium.
    fn row(&self, t: f64, z: DoublePhase) -> [f64; 10] {
        let [omega1, omega2] = self.velocities(z);
        let [(x1, y1), (x2, y2)] = self.bobs(z);
        [t, z.theta1, z.theta2, omega1, omega2, x1, y1, x2, y2, self.energy(z)]
    }

    fn conserved(&self) -> Option<&dyn Hamiltonian<State = DoublePhase>> {
        Some(self)
    }
}

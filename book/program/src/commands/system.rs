//! The options of a pendulum, or two: those of `pendula simulate`, whose system may also be damped,
//! driven or shaken, and those that other commands share.

use anyhow::{Context, Result, bail};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use pendula::systems::{Damped, DoublePhase, Driven, Joint, Shaken};
use pendula::{DoublePendulum, Error, METHODS, Pendulum, Phase};

use super::number::{angle, number};

/// The names that `--method` accepts.
pub fn methods() -> PossibleValuesParser {
    METHODS.iter().map(|method| method.info().name).collect::<Vec<_>>().into()
}

/// The method that is no method of equal steps.
pub const SERIES: &str = "taylor-series";

/// The names that are accepted where steps may vary.
pub fn methods_and_series() -> PossibleValuesParser {
    let names = METHODS.iter().map(|method| method.info().name);
    names.chain([SERIES]).collect::<Vec<_>>().into()
}

/// The acceleration.
#[derive(Args, Debug)]
pub struct GravityArgument {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), value_parser = number)]
    pub gravity: f64,
}

/// The pendulum.
#[derive(Args, Debug)]
pub struct PendulumArguments {
    #[command(flatten)]
    gravity: GravityArgument,
    /// Length L of the rod (m)
    #[arg(long, default_value_t = Pendulum::PAPER.length(), value_parser = number)]
    length: f64,
}

impl PendulumArguments {
    /// The pendulum of `mass` (kg).
    pub fn pendulum(&self, mass: f64) -> Result<Pendulum, Error> {
        Pendulum::new(self.gravity.gravity, self.length, mass)
    }
}

/// The double pendulum.
#[derive(Args, Debug)]
pub struct DoubleArguments {
    /// Length of the upper rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number)]
    pub length1: Option<f64>,
    /// Length of the lower rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number)]
    pub length2: Option<f64>,
    /// Mass of the upper bob (kg) [default: 1]
    #[arg(long, value_name = "KG", value_parser = number)]
    pub mass1: Option<f64>,
    /// Mass of the lower bob (kg), at most 1e6 times that of the upper [default: 1]
    #[arg(long, value_name = "KG", value_parser = number)]
    pub mass2: Option<f64>,
}

impl DoubleArguments {
    /// The double pendulum.
    pub fn double(&self, gravity: f64) -> Result<DoublePendulum, Error> {
        let [length1, length2, mass1, mass2] =
            [self.length1, self.length2, self.mass1, self.mass2].map(|x| x.unwrap_or(1.0));
        let upper = Joint { length: length1, mass: mass1 };
        DoublePendulum::new(gravity, upper, Joint { length: length2, mass: mass2 })
    }
}

/// What is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SystemName {
    /// The simple pendulum
    #[default]
    Pendulum,
    /// With friction: θ̈ + 2β θ̇ + ω₀² sin θ = 0
    Damped,
    /// With friction and a periodic torque: θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt
    Driven,
    /// With its pivot shaken up and down by a cos Ωt: θ̈ + (g − aΩ² cos Ωt)/L sin θ = 0
    Shaken,
    /// Two pendulums, the second hung from the bob of the first
    DoublePendulum,
}

impl SystemName {
    fn text(self) -> String {
        self.to_possible_value().expect("no name is hidden").get_name().to_owned()
    }
}

/// The system, its parameters and its start. Which of them belong to which system is checked
/// afterwards, so that a refusal can say so.
#[derive(Args, Debug)]
pub struct SystemArguments {
    /// What is integrated
    #[arg(long, value_name = "S", value_enum, default_value_t)]
    system: SystemName,
    /// Angle at the start: in radians, or like pi/3 or 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    theta0: Option<f64>,
    /// Angular velocity at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number)]
    omega0: Option<f64>,
    #[command(flatten)]
    gravity: GravityArgument,
    /// Length L of the rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number)]
    length: Option<f64>,
    /// Mass m of the bob (kg) [default: 1]
    #[arg(long, value_name = "KG", value_parser = number)]
    mass: Option<f64>,
    #[command(flatten, next_help_heading = "Damped, driven or shaken")]
    forced: ForcedArguments,
    #[command(flatten, next_help_heading = "Double pendulum")]
    double_start: DoubleStart,
    #[command(flatten, next_help_heading = "Double pendulum")]
    double: DoubleArguments,
}

#[derive(Args, Debug)]
struct ForcedArguments {
    /// Damped or driven: damping β (1/s), the rate at which small swings decay [driven: default 0]
    #[arg(long, value_name = "1/S", value_parser = number)]
    damping: Option<f64>,
    /// Driven: strength γ of the torque, in units of m g L
    #[arg(long, value_name = "G", value_parser = number)]
    drive_strength: Option<f64>,
    /// Driven: angular frequency Ω of the torque (rad/s)
    #[arg(long, value_name = "RAD/S", value_parser = number)]
    drive_frequency: Option<f64>,
    /// Shaken: amplitude a of the pivot's motion (m)
    #[arg(long, value_name = "M", value_parser = number)]
    pivot_amplitude: Option<f64>,
    /// Shaken: angular frequency Ω of the pivot's motion (rad/s)
    #[arg(long, value_name = "RAD/S", value_parser = number)]
    pivot_frequency: Option<f64>,
}

#[derive(Args, Debug)]
struct DoubleStart {
    /// Angle of the upper rod at the start, from the downward vertical: in radians, or like pi/3
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    theta1: Option<f64>,
    /// Angle of the lower rod at the start, from the downward vertical: in radians, or like pi/3
    #[arg(long, value_name = "ANGLE", value_parser = angle)]
    theta2: Option<f64>,
    /// Angular velocity of the upper rod at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number)]
    omega1: Option<f64>,
    /// Angular velocity of the lower rod at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number)]
    omega2: Option<f64>,
}

/// A system, and its first state.
pub enum Chosen {
    /// The pendulum, and what else happens to it.
    Pendulum(Pendulum, Phase, Forced),
    /// The double pendulum.
    Double(DoublePendulum, DoublePhase),
}

/// What happens to a pendulum.
pub enum Forced {
    /// Nothing.
    No,
    /// Friction.
    Damped(Damped),
    /// A torque.
    Driven(Driven),
    /// A pivot that moves.
    Shaken(Shaken),
}

impl SystemArguments {
    /// The system. An error is a refusal.
    pub fn chosen(&self) -> Result<Chosen> {
        self.check()?;
        let gravity = self.gravity.gravity;
        if self.system == SystemName::DoublePendulum {
            let DoubleStart { theta1, theta2, omega1, omega2 } = self.double_start;
            let theta = [self.needed("theta1", theta1)?, self.needed("theta2", theta2)?];
            let omega = [omega1.unwrap_or(0.0), omega2.unwrap_or(0.0)];
            let double = self.double.double(gravity)?;
            return Ok(Chosen::Double(double, double.start(theta, omega)?));
        }
        let length = self.length.unwrap_or(Pendulum::PAPER.length());
        let mass = self.mass.unwrap_or(Pendulum::PAPER.mass());
        let pendulum = Pendulum::new(gravity, length, mass)?;
        let theta0 = self.needed("theta0", self.theta0)?;
        let start = pendulum.start(theta0, self.omega0.unwrap_or(0.0))?;
        Ok(Chosen::Pendulum(pendulum, start, self.forced(pendulum)?))
    }

    /// What happens to `pendulum`.
    fn forced(&self, pendulum: Pendulum) -> Result<Forced> {
        let of = &self.forced;
        Ok(match self.system {
            SystemName::Pendulum | SystemName::DoublePendulum => Forced::No,
            SystemName::Damped => {
                let damping = self.needed("damping", of.damping)?;
                Forced::Damped(Damped::new(pendulum, damping)?)
            }
            SystemName::Driven => {
                let damped = Damped::new(pendulum, of.damping.unwrap_or(0.0))?;
                let strength = self.needed("drive-strength", of.drive_strength)?;
                let frequency = self.needed("drive-frequency", of.drive_frequency)?;
                Forced::Driven(Driven::new(damped, strength, frequency)?)
            }
            SystemName::Shaken => {
                let amplitude = self.needed("pivot-amplitude", of.pivot_amplitude)?;
                let frequency = self.needed("pivot-frequency", of.pivot_frequency)?;
                Forced::Shaken(Shaken::new(pendulum, amplitude, frequency)?)
            }
        })
    }

    /// Refuses what belongs to another system.
    fn check(&self) -> Result<()> {
        use SystemName::{Damped, DoublePendulum, Driven, Pendulum, Shaken};
        let Self { theta0, omega0, length, mass, forced, double_start, double, .. } = self;
        let single: &[_] = &[Pendulum, Damped, Driven, Shaken];
        let two: &[_] = &[DoublePendulum];
        for (option, value, of) in [
            ("theta0", theta0, single),
            ("omega0", omega0, single),
            ("length", length, single),
            ("mass", mass, single),
            ("damping", &forced.damping, &[Damped, Driven]),
            ("drive-strength", &forced.drive_strength, &[Driven]),
            ("drive-frequency", &forced.drive_frequency, &[Driven]),
            ("pivot-amplitude", &forced.pivot_amplitude, &[Shaken]),
            ("pivot-frequency", &forced.pivot_frequency, &[Shaken]),
            ("theta1", &double_start.theta1, two),
            ("theta2", &double_start.theta2, two),
            ("omega1", &double_start.omega1, two),
            ("omega2", &double_start.omega2, two),
            ("length1", &double.length1, two),
            ("length2", &double.length2, two),
            ("mass1", &double.mass1, two),
            ("mass2", &double.mass2, two),
        ] {
            if value.is_some() && !of.contains(&self.system) {
                let of: Vec<String> = of.iter().map(|name| name.text()).collect();
                let (of, system) = (of.join(" or "), self.system.text());
                bail!("--{option} belongs to --system {of}, and the system is {system}");
            }
        }
        Ok(())
    }

    fn needed(&self, option: &str, value: Option<f64>) -> Result<f64> {
        value.with_context(|| format!("--{option} is missing for --system {}", self.system.text()))
    }
}

//! What `pendula simulate` integrates: the pendulum, one that is damped, driven or shaken, or the
//! double pendulum.

use clap::{Args, ValueEnum};
use pendula::systems::{Damped, DoublePhase, Driven, Shaken};
use pendula::{DoublePendulum, Pendulum, Phase};

use super::angle::angle;
use super::number::number;
use super::pendulum::{DoubleArguments, GravityArgument};
use pendula_output::failure::Failure;

/// What is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SystemName {
    /// The simple pendulum
    #[default]
    Pendulum,
    /// With friction: θ̈ + 2β θ̇ + ω₀² sin θ = 0
    Damped,
    /// With friction, under a periodic torque: θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt
    Driven,
    /// Its pivot shaken up and down as a cos Ωt: θ̈ + (g − aΩ² cos Ωt)/L sin θ = 0
    Shaken,
    /// Two pendulums, the second on the bob of the first
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
    /// Angle at the start: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta0: Option<f64>,
    /// Angular velocity at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true)]
    omega0: Option<f64>,
    #[command(flatten)]
    gravity: GravityArgument,
    /// Length L of the rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    length: Option<f64>,
    /// Mass m of the bob (kg) [default: 1]
    #[arg(long, value_name = "KG", value_parser = number, allow_hyphen_values = true)]
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
    /// Damped or driven: damping β (1/s), the rate at which small swings decay [driven: 0]
    #[arg(long, value_name = "1/S", value_parser = number, allow_hyphen_values = true)]
    damping: Option<f64>,
    /// Driven: strength γ of the torque, in units of m g L
    #[arg(long, value_name = "G", value_parser = number, allow_hyphen_values = true)]
    drive_strength: Option<f64>,
    /// Driven: angular frequency Ω of the torque (rad/s)
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true)]
    drive_frequency: Option<f64>,
    /// Shaken: amplitude a of the pivot (m)
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pivot_amplitude: Option<f64>,
    /// Shaken: angular frequency Ω of the pivot (rad/s)
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true)]
    pivot_frequency: Option<f64>,
}

#[derive(Args, Debug)]
struct DoubleStart {
    /// Angle of the upper rod at the start, from the downward vertical: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta1: Option<f64>,
    /// Angle of the lower rod at the start, from the downward vertical: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta2: Option<f64>,
    /// Angular velocity of the upper rod at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true)]
    omega1: Option<f64>,
    /// Angular velocity of the lower rod at the start (rad/s) [default: 0]
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true)]
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
    /// The system.
    pub fn chosen(&self) -> Result<Chosen, Failure> {
        self.check()?;
        let gravity = self.gravity.gravity;
        if self.system == SystemName::DoublePendulum {
            let DoubleStart { theta1, theta2, omega1, omega2 } = self.double_start;
            let theta = [self.needed("theta1", theta1)?, self.needed("theta2", theta2)?];
            let omega = [omega1.unwrap_or(0.0), omega2.unwrap_or(0.0)];
            let double = self.double.double(gravity).map_err(Failure::refused)?;
            return Ok(Chosen::Double(
                double,
                double.start(theta, omega).map_err(Failure::refused)?,
            ));
        }
        let length = self.length.unwrap_or(Pendulum::PAPER.length());
        let mass = self.mass.unwrap_or(Pendulum::PAPER.mass());
        let pendulum = Pendulum::new(gravity, length, mass).map_err(Failure::refused)?;
        let theta0 = self.needed("theta0", self.theta0)?;
        let start = pendulum.start(theta0, self.omega0.unwrap_or(0.0)).map_err(Failure::refused)?;
        Ok(Chosen::Pendulum(pendulum, start, self.forced(pendulum)?))
    }

    /// What happens to `pendulum`.
    fn forced(&self, pendulum: Pendulum) -> Result<Forced, Failure> {
        let of = &self.forced;
        Ok(match self.system {
            SystemName::Pendulum | SystemName::DoublePendulum => Forced::No,
            SystemName::Damped => {
                let damping = self.needed("damping", of.damping)?;
                Forced::Damped(Damped::new(pendulum, damping).map_err(Failure::refused)?)
            }
            SystemName::Driven => {
                let damped =
                    Damped::new(pendulum, of.damping.unwrap_or(0.0)).map_err(Failure::refused)?;
                let strength = self.needed("drive-strength", of.drive_strength)?;
                let frequency = self.needed("drive-frequency", of.drive_frequency)?;
                Forced::Driven(Driven::new(damped, strength, frequency).map_err(Failure::refused)?)
            }
            SystemName::Shaken => {
                let amplitude = self.needed("pivot-amplitude", of.pivot_amplitude)?;
                let frequency = self.needed("pivot-frequency", of.pivot_frequency)?;
                Forced::Shaken(
                    Shaken::new(pendulum, amplitude, frequency).map_err(Failure::refused)?,
                )
            }
        })
    }

    /// Refuses what belongs to another system.
    fn check(&self) -> Result<(), Failure> {
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
                return Err(Failure::refused(format!(
                    "--{option} belongs to --system {}, and the system is {}",
                    of.join(" or "),
                    self.system.text()
                )));
            }
        }
        Ok(())
    }

    fn needed(&self, option: &str, value: Option<f64>) -> Result<f64, Failure> {
        value.ok_or_else(|| {
            let system = self.system.text();
            Failure::refused(format!("--{option} is missing for --system {system}"))
        })
    }
}

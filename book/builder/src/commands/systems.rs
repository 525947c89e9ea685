//! `--system`: the pendulum, or one that is damped, driven or shaken.

use clap::{Args, ValueEnum};
use pendula::{Error, Pendulum};
use pendula::systems::{Damped, Driven, Shaken};

use super::number::number;
use crate::failure::Failure;

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
}

/// The system and its parameters.
#[derive(Args, Debug)]
pub struct SystemArguments {
    /// What is integrated
    #[arg(long, value_name = "S", value_enum, default_value_t)]
    system: SystemName,
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

/// A system, with its parameters.
pub enum Chosen {
    /// The pendulum alone.
    Pendulum,
    /// With friction.
    Damped(Damped),
    /// Under a torque.
    Driven(Driven),
    /// On a pivot that moves.
    Shaken(Shaken),
}

impl SystemArguments {
    /// The system made of `pendulum`.
    ///
    /// # Errors
    /// [`Failure::Refused`] for a parameter that is missing, or belongs to another system, or that
    /// the library refuses.
    pub fn of(&self, pendulum: Pendulum) -> Result<Chosen, Failure> {
        use SystemName::{Damped as D, Driven as F, Pendulum as P, Shaken as S};
        let name = self.system;
        let given = [
            ("damping", self.damping, &[D, F][..]),
            ("drive-strength", self.drive_strength, &[F]),
            ("drive-frequency", self.drive_frequency, &[F]),
            ("pivot-amplitude", self.pivot_amplitude, &[S]),
            ("pivot-frequency", self.pivot_frequency, &[S]),
        ];
        for (option, value, of) in given {
            if value.is_some() && !of.contains(&name) {
                let of: Vec<String> = of.iter().map(|name| name.text()).collect();
                return Err(Failure::refused(format!(
                    "--{option} belongs to --system {}, and the system is {}",
                    of.join(" or "),
                    name.text()
                )));
            }
        }
        let needed = |option: &str, value: Option<f64>| {
            value.ok_or_else(|| {
                Failure::refused(format!("--{option} is missing for --system {}", name.text()))
            })
        };
        let refused = |error: Error| Failure::refused(error);
        Ok(match name {
            P => Chosen::Pendulum,
            D => {
                let damping = needed("damping", self.damping)?;
                Chosen::Damped(Damped::new(pendulum, damping).map_err(refused)?)
            }
            F => {
                let damped = Damped::new(pendulum, self.damping.unwrap_or(0.0)).map_err(refused)?;
                let strength = needed("drive-strength", self.drive_strength)?;
                let frequency = needed("drive-frequency", self.drive_frequency)?;
                Chosen::Driven(Driven::new(damped, strength, frequency).map_err(refused)?)
            }
            S => {
                let amplitude = needed("pivot-amplitude", self.pivot_amplitude)?;
                let frequency = needed("pivot-frequency", self.pivot_frequency)?;
                Chosen::Shaken(Shaken::new(pendulum, amplitude, frequency).map_err(refused)?)
            }
        })
    }
}

impl SystemName {
    fn text(self) -> String {
        self.to_possible_value().expect("no name is hidden").get_name().to_owned()
    }
}

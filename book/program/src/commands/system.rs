//! The options that commands share: the pendulum, and the method. Those of the systems of `pendula
//! simulate` are in [`simulate`](super::simulate).

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Args, Command};
use pendula::{Error, METHODS, MethodInfo, Pendulum, method_named};

use super::number::number;

/// The names that `--method` accepts: those of the methods, and their aliases. What they are read
/// as is the name.
pub const fn methods() -> MethodNames {
    MethodNames { with_series: false }
}

/// The method that is no method of equal steps.
pub const SERIES: &str = "taylor-series";

/// The names that are accepted where steps may vary.
pub const fn methods_and_series() -> MethodNames {
    MethodNames { with_series: true }
}

/// Reads the name of a method.
#[derive(Clone, Debug)]
pub struct MethodNames {
    with_series: bool,
}

impl MethodNames {
    fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        let names = METHODS.iter().map(|method| method.info().name);
        names.chain(self.with_series.then_some(SERIES))
    }
}

impl TypedValueParser for MethodNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let value = StringValueParser::new().parse_ref(command, argument, value)?;
        let series = MethodInfo::new(SERIES, 1);
        if self.with_series && series.is_called(&value) {
            return Ok(SERIES.into());
        }
        if let Some(method) = method_named::<Pendulum>(&value) {
            return Ok(method.info().name.into());
        }
        let names = self.names().map(str::to_string).collect();
        let mut error = clap::Error::new(ErrorKind::InvalidValue).with_cmd(command);
        if let Some(argument) = argument {
            let name = ContextValue::String(argument.to_string());
            error.insert(ContextKind::InvalidArg, name);
        }
        if let Some(meant) = misspelt(&value) {
            error.insert(ContextKind::SuggestedValue, ContextValue::String(meant.into()));
        }
        error.insert(ContextKind::InvalidValue, ContextValue::String(value));
        error.insert(ContextKind::ValidValue, ContextValue::Strings(names));
        Err(error)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.names().map(PossibleValue::new)))
    }
}

/// The name of the method that `typed` is a misspelling of: one letter or two apart from its name
/// or an alias, fewer in short ones, with the digits of it. A method that merely sounds alike is
/// another one.
fn misspelt(typed: &str) -> Option<&'static str> {
    let small = |name: &str| name.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "");
    let digits = |name: &str| name.chars().filter(char::is_ascii_digit).collect::<String>();
    let typed = small(typed);
    let apart = |name: &str| strsim::osa_distance(&typed, &small(name));
    let mut close: Vec<(usize, &str)> = METHODS
        .iter()
        .map(|method| method.info())
        .flat_map(|info| {
            [info.name, info.title]
                .into_iter()
                .chain(info.aliases.iter().copied())
                .map(move |name| (name, info.name))
        })
        .filter(|(name, _)| digits(name) == digits(&typed))
        .map(|(name, method)| (apart(name), method))
        .filter(|(apart, _)| *apart <= (typed.chars().count() / 4).min(2))
        .collect();
    close.sort_unstable();
    close.first().map(|(_, method)| *method)
}

/// The pendulum.
#[derive(Args, Debug)]
pub struct PendulumArguments {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), value_parser = number)]
    gravity: f64,
    /// Length L of the rod (m)
    #[arg(long, default_value_t = Pendulum::PAPER.length(), value_parser = number)]
    length: f64,
}

impl PendulumArguments {
    /// The pendulum of `mass` (kg).
    pub fn pendulum(&self, mass: f64) -> Result<Pendulum, Error> {
        Pendulum::new(self.gravity, self.length, mass)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a method that is proposed because it sounds alike, which is another one; an alias
    /// that is not accepted; a misspelling of which nothing is said.
    #[rstest::rstest]
    #[case("velocity-verlet", Ok("stormer-verlet"))]
    #[case("Leapfrog", Ok("stormer-verlet"))]
    #[case("euler-cromer", Ok("symplectic-euler"))]
    #[case("semi-implicit-euler", Ok("symplectic-euler"))]
    #[case("RK45", Ok("dormand-prince"))]
    #[case("dopri5", Ok("dormand-prince"))]
    #[case("taylor series", Ok("taylor-series"))]
    #[case("velocty-verlet", Err(Some("stormer-verlet")))]
    #[case("pozition-verlet", Err(Some("position-verlet")))]
    #[case("dormand-price", Err(Some("dormand-prince")))]
    #[case("verlet", Err(None))]
    #[case("euler", Err(None))]
    #[case("rk5", Err(None))]
    #[case("yoshida-7", Err(None))]
    #[case("", Err(None))]
    fn a_name_is_that_of_one_method(
        #[case] name: &str,
        #[case] expected: Result<&str, Option<&str>>,
    ) {
        let read = methods_and_series().parse_ref(&Command::new("pendula"), None, name.as_ref());
        let told = read.map_err(|error| error.get(ContextKind::SuggestedValue).cloned());
        let expected = expected
            .map(str::to_string)
            .map_err(|meant| meant.map(|meant| ContextValue::String(meant.into())));
        assert_eq!(told, expected);
    }
}

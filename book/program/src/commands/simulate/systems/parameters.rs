//! The options of the systems: one for each parameter, and for each component of a start.

use std::fmt;

use anyhow::{Context, Result, bail};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::error::ErrorKind;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

use super::{Registration, SYSTEMS};
use crate::commands::number::{angle, number};

/// An option of a system: a number, or an angle. Systems with the same option share it.
#[derive(Debug)]
pub struct Parameter {
    pub name: &'static str,
    is_angle: bool,
    /// What stands for the number in the help: its unit.
    unit: &'static str,
    pub help: &'static str,
    pub default: Option<f64>,
    heading: Option<&'static str>,
}

impl Parameter {
    /// A number, needed if it has no default.
    pub const fn number(name: &'static str, unit: &'static str, help: &'static str) -> Self {
        Self { name, is_angle: false, unit, help, default: None, heading: None }
    }

    /// An angle: in radians, or like pi/3 or 60deg.
    pub const fn angle(name: &'static str, help: &'static str) -> Self {
        Self { is_angle: true, ..Self::number(name, "ANGLE", help) }
    }

    /// The same with this value unless another is given.
    pub const fn or(self, default: f64) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The same under this heading of the help.
    pub const fn under(self, heading: &'static str) -> Self {
        Self { heading: Some(heading), ..self }
    }

    /// The same option.
    pub fn is(&self, other: &Self) -> bool {
        self.name == other.name
    }

    fn option(&self) -> Arg {
        let default = self.default.map(|default| format!(" [default: {default}]"));
        let option = Arg::new(self.name)
            .long(self.name)
            .value_name(self.unit)
            .help(format!("{}{}", self.help, default.unwrap_or_default()))
            .help_heading(self.heading);
        if self.is_angle { option.value_parser(angle) } else { option.value_parser(number) }
    }
}

/// The options of all systems, each once.
pub fn parameters() -> impl Iterator<Item = &'static Parameter> {
    let all = || SYSTEMS.iter().flat_map(|system| system.parameters()).copied();
    all().enumerate().filter(move |(n, new)| !all().take(*n).any(|old| old.is(new))).map(|(_, p)| p)
}

/// The system that was chosen, and the numbers that were given. Which of them belong to which
/// system is checked afterwards, so that a refusal can say so.
pub struct SystemArguments {
    system: &'static dyn Registration,
    given: Vec<(&'static Parameter, f64)>,
}

impl SystemArguments {
    /// The system. Refuses what belongs to another.
    pub fn system(&self) -> Result<&'static dyn Registration> {
        let has = |system: &dyn Registration, option: &Parameter| {
            system.parameters().iter().any(|own| own.is(option))
        };
        if let Some((option, _)) = self.given.iter().find(|(option, _)| !has(self.system, option)) {
            let of = SYSTEMS.iter().filter(|system| has(**system, option));
            let of: Vec<&str> = of.map(|system| system.name()).collect();
            let (of, system) = (of.join(" or "), self.system.name());
            bail!("--{} is an option of --system {of}, but the system is {system}", option.name);
        }
        Ok(self.system)
    }

    /// The number that was given, or its default; without either it is a refusal.
    pub fn value(&self, parameter: &Parameter) -> Result<f64> {
        self.given(parameter).or(parameter.default).with_context(|| {
            format!(
                "--system {1} needs --{0}, which is missing",
                parameter.name,
                self.system.name()
            )
        })
    }

    /// The number that was given, if one was.
    pub fn given(&self, parameter: &Parameter) -> Option<f64> {
        self.given.iter().find(|(given, _)| given.is(parameter)).map(|(_, value)| *value)
    }
}

impl Args for SystemArguments {
    fn augment_args(command: Command) -> Command {
        let named = SYSTEMS.iter().map(|it| PossibleValue::new(it.name()).help(it.about()));
        let system = Arg::new("system")
            .long("system")
            .value_name("S")
            .help("The system to integrate")
            .value_parser(PossibleValuesParser::new(named))
            .default_value(SYSTEMS[0].name());
        command.arg(system).args(parameters().map(Parameter::option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SystemArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let name = matches.get_one::<String>("system");
        let system = SYSTEMS.iter().find(|system| name.is_some_and(|name| name == system.name()));
        let system = *system.ok_or_else(|| clap::Error::new(ErrorKind::MissingRequiredArgument))?;
        let value = |option: &Parameter| matches.get_one(option.name).copied();
        let given = parameters().filter_map(|option| Some((option, value(option)?))).collect();
        Ok(Self { system, given })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl fmt::Debug for SystemArguments {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let given = self.given.iter().map(|(option, value)| (option.name, value));
        f.debug_map().entry(&"system", &self.system.name()).entries(given).finish()
    }
}

//! The library's methods on systems other than the pendulum: which of them suit.

use pendula::integrate::Steps;
use pendula::methods::table::Listed;
use pendula::systems::{Damped, Driven, Shaken};
use pendula::{DoublePendulum, METHODS};

use pendula_output::failure::Failure;

/// A system that some of the library's methods integrate.
pub trait Suited: Listed {
    /// What it is called in a refusal.
    const NAME: &'static str;
}

impl Suited for Damped {
    const NAME: &'static str = "the damped pendulum";
}

impl Suited for Driven {
    const NAME: &'static str = "the driven pendulum";
}

impl Suited for Shaken {
    const NAME: &'static str = "the shaken pendulum";
}

impl Suited for DoublePendulum {
    const NAME: &'static str = "the double pendulum";
}

/// The steps of the method `name`, or its refusal, with those that suit.
///
/// # Errors
/// [`Failure::Refused`].
pub fn steps<S: Suited>(name: &str) -> Result<&'static dyn Steps<S>, Failure> {
    S::steps(name).ok_or_else(|| {
        let names = METHODS.iter().map(|method| method.info().name);
        let suited: Vec<&str> = names.filter(|name| S::steps(name).is_some()).collect();
        let suited = suited.join(", ");
        let why = "it needs more of a system than this one has";
        Failure::refused(format!(
            "--method {name}: {why}, {}; those that suit are {suited}",
            S::NAME
        ))
    })
}

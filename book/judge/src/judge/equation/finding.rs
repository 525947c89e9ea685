//! What a report says of the equation, and of what is taken and returned.

use super::Looked;
use super::departure::{Departure, Kind, Place};
use crate::finding::{Finding, Measurement};
use crate::judge::answers::Match;
use crate::judge::verdict::{Measured, Verdict};

/// The two findings, and what they are made of.
pub struct Told {
    pub equation: Measured<Finding>,
    pub output: Measured<Finding>,
    /// In what the program departs from what is asked for.
    pub departure: Option<Departure>,
    /// Angle (rad) and force, in units of g/L, if the equation is another one.
    pub force: Vec<(f64, f64)>,
}

impl Told {
    /// Of what was `looked` at, which is nothing where the method is known, behind a change of
    /// `output`.
    pub fn new(
        looked: &Measured<Option<Looked>>,
        output: Option<Departure>,
        known: Option<Match>,
    ) -> Self {
        let seen = looked.as_ref().ok().and_then(Option::as_ref);
        let of_equation = seen.and_then(|looked| looked.departure.clone());
        let (equation, output) = match (of_equation, output) {
            // A change of output behind which nothing right was found.
            (Some(found), None) if found.place() == Place::Output => (None, Some(found)),
            found => found,
        };
        let force = seen.filter(|_| equation.is_some()).map(|looked| looked.force.clone());
        let force = force.unwrap_or_default();
        let of_equation = looked.clone().map(|looked| match (&equation, looked, known) {
            (Some(departure), ..) => Finding::departing(departure, Measurement::OtherEquation),
            (None, Some(looked), _) => Finding {
                measurement: Measurement::RightRates,
                ..Finding::number(looked.known_to, "", looked.known_to, Verdict::Holds)
            },
            (None, None, Some(known)) => Finding {
                measurement: Measurement::StepsOf(known.known.name.as_str()),
                ..Finding::number(known.apart, "rad", known.apart, Verdict::Holds)
            },
            (None, None, None) => Finding::nothing("nothing was found of it".to_string()),
        });
        // Angles without their turns are told where turns are.
        let changed = output.as_ref().filter(|departure| departure.kind() != Kind::Wrapped);
        let of_output = match changed {
            Some(departure) => Ok(Finding::departing(departure, Measurement::OtherOutput)),
            None => of_equation.clone().map(|_| Finding {
                measurement: Measurement::AsAsked,
                verdict: Verdict::Holds,
                ..Finding::default()
            }),
        };
        let departure = equation.or(output);
        Self { equation: of_equation, output: of_output, departure, force }
    }
}

//! What is claimed of an integrator.

use core::fmt;
use core::str::FromStr;

use crate::known_answers::{self, Known};
use crate::property::Property;

/// What is claimed of an integrator. Nothing is, unless said. What comes with any claim (equation,
/// output, mirror, turn, units, clock, repeatable, precision, and stage times where there is a
/// drive) is not listed here.
///
/// The order is claimed of equal steps and of a solver, whichever is judged. A claim that belongs
/// to the other one is not measured, and the report says so.
///
/// ```
/// use pendula_judge::Claims;
///
/// let claims: Claims = "order=2 symplectic symmetric evaluations=1".parse()?;
/// assert_eq!(claims, Claims::order(2).symplectic().symmetric().evaluations(1));
/// # Ok::<(), pendula_judge::ClaimError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Claims {
    /// The order of the state.
    pub order: Option<u32>,
    /// That a step keeps the area of phase space.
    pub symplectic: bool,
    /// That a step with −h undoes a step with h.
    pub symmetric: bool,
    /// That the energy error does not grow with time.
    pub bounded_energy: bool,
    /// Force evaluations a step, when many are taken.
    pub evaluations: Option<u64>,
    /// The method that it is, by a name of the [known answers](crate::known_answers).
    pub name: Option<String>,
    /// Of a solver: that its error estimate falls with this power of the step.
    pub estimate: Option<u32>,
    /// Of a solver: that a run ends in the same state, but for rounding, with outputs and without.
    pub free_outputs: bool,
    /// Of a solver: that it finds where θ passes zero.
    pub crossings: bool,
    /// Of a solver: that the impossible, as a tolerance of zero or NaN or a time that never comes,
    /// ends in an error. Without this claim it is said what comes of it, and not judged.
    pub refuses: bool,
    /// Of a solver: that states between its steps come from polynomials of this degree, so that
    /// their error falls with the next higher power of the step. Without this claim they have to be
    /// as good as the steps.
    pub outputs: Option<u32>,
    /// That it runs forward only: nothing is asked backwards, and what needs it is not judged.
    pub forward_only: bool,
    /// That it computes in single precision, by which its errors are measured then.
    pub single_precision: bool,
}

impl Claims {
    /// No claims: it is said what the integrator is, and nothing is judged.
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether no claims are made.
    pub fn are_none(&self) -> bool {
        *self == Self::default()
    }

    /// A claim that everybody makes who makes any.
    pub(crate) fn implied(&self) -> Option<String> {
        (!self.are_none()).then(|| "implied".to_string())
    }

    /// That the error of the state falls with the power `order` of the step.
    pub fn order(order: u32) -> Self {
        Self { order: Some(order), ..Self::default() }
    }

    /// And that a step keeps the area of phase space.
    pub fn symplectic(self) -> Self {
        Self { symplectic: true, ..self }
    }

    /// And that a step with −h undoes a step with h.
    pub fn symmetric(self) -> Self {
        Self { symmetric: true, ..self }
    }

    /// And that the energy error does not grow with time.
    pub fn bounded_energy(self) -> Self {
        Self { bounded_energy: true, ..self }
    }

    /// And that a step takes so many force evaluations, when many are taken.
    pub fn evaluations(self, a_step: u64) -> Self {
        Self { evaluations: Some(a_step), ..self }
    }

    /// And that it is the method of this [name](pendula::MethodInfo::name), or of one of the
    /// [known answers](crate::known_answers).
    pub fn name(self, name: impl Into<String>) -> Self {
        Self { name: Some(name.into()), ..self }
    }

    /// And that the error estimate of a solver falls with the power `power` of the step.
    pub fn estimate(self, power: u32) -> Self {
        Self { estimate: Some(power), ..self }
    }

    /// And that a run of a solver ends in the same state, but for rounding, with outputs and
    /// without.
    pub fn free_outputs(self) -> Self {
        Self { free_outputs: true, ..self }
    }

    /// And that a solver finds where θ passes zero.
    pub fn crossings(self) -> Self {
        Self { crossings: true, ..self }
    }

    /// And that a solver ends in an error where the impossible is asked for, as a tolerance of zero
    /// or NaN, or a time that never comes.
    pub fn refuses(self) -> Self {
        Self { refuses: true, ..self }
    }

    /// And that states between the steps of a solver come from polynomials of this `degree`, so
    /// that their error falls with the power `degree` + 1 of the step.
    pub fn outputs(self, degree: u32) -> Self {
        Self { outputs: Some(degree), ..self }
    }

    /// And that it runs forward only: nothing is asked backwards.
    pub fn forward_only(self) -> Self {
        Self { forward_only: true, ..self }
    }

    /// And that it computes in single precision.
    pub fn single_precision(self) -> Self {
        Self { single_precision: true, ..self }
    }

    /// What is claimed of the properties that equal steps alone have.
    pub(crate) fn of_steps(&self) -> [(Property, Option<String>); 5] {
        let word = |claimed: bool, word: &str| claimed.then(|| word.to_string());
        [
            (Property::Area, word(self.symplectic, "symplectic")),
            (Property::Reversal, word(self.symmetric, "symmetric")),
            (Property::Energy, word(self.bounded_energy, "bounded")),
            (Property::Evaluations, self.evaluations.map(|a_step| format!("{a_step} a step"))),
            (Property::Name, self.name.clone()),
        ]
    }

    /// What is claimed of the properties that a solver alone has.
    pub(crate) fn of_a_solver(&self) -> [(Property, Option<String>); 5] {
        let word = |claimed: bool, word: &str| claimed.then(|| word.to_string());
        [
            (Property::Estimate, self.estimate.map(|power| power.to_string())),
            (Property::FreeOutputs, word(self.free_outputs, "free")),
            (Property::Crossings, word(self.crossings, "crossings")),
            (Property::Refusal, word(self.refuses, "refuses")),
            (Property::SolveOutput, self.outputs.map(of_degree)),
        ]
    }

    /// The method that is claimed.
    pub(super) fn method(&self) -> Option<&'static Known> {
        self.name.as_deref().and_then(known_answers::method)
    }

    /// Whether the method that is claimed has this name.
    pub(super) fn is_named(&self, name: &str) -> bool {
        let entry = known_answers::method(name).map(|known| &known.name);
        entry.is_some() && entry == self.method().map(|known| &known.name)
    }

    /// The claims of an entry of the library, its name among them. An implicit method claims no
    /// evaluations: their number depends on the sweeps. Beyond order 8 an energy error is rounding,
    /// of which nothing is claimed.
    pub fn of(entry: &pendula::MethodInfo) -> Self {
        Self {
            order: Some(entry.order),
            symplectic: entry.symplectic,
            symmetric: entry.symmetric,
            bounded_energy: entry.symplectic && entry.order <= 8,
            evaluations: (!entry.implicit).then_some(entry.force_evaluations),
            name: Some(entry.name.to_string()),
            ..Self::default()
        }
    }
}

/// What is claimed of outputs of this degree.
pub(crate) fn of_degree(degree: u32) -> String {
    format!("degree {degree}")
}

/// The largest number that a claim in words may have.
const MOST: u64 = 99_999;

/// The first characters of a word that is quoted.
fn shortened(word: &str) -> String {
    const SHOWN: usize = 60;
    match word.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_string(),
    }
}

/// That there is no method of this name, and which have one like it.
fn unknown(name: &str) -> String {
    const SHOWN: usize = 8;
    let mut like = known_answers::meant(name);
    if like.is_empty() {
        like = vec!["rk4", "stormer-verlet", "…"];
    } else if like.len() > SHOWN {
        like.truncate(SHOWN);
        like.push("…");
    }
    format!(
        "name={}: no method of known-answers.json has this name; there are {}",
        shortened(name),
        like.join(", ")
    )
}

/// The words of a claim, separated by blanks: `order=2 symplectic symmetric bounded-energy
/// evaluations=1 name=stormer-verlet`. The numbers are from 1 to 99 999.
impl FromStr for Claims {
    type Err = ClaimError;

    fn from_str(text: &str) -> Result<Self, ClaimError> {
        Self::read(text).map_err(ClaimError)
    }
}

/// Words that are no claims, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClaimError(String);

impl fmt::Display for ClaimError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for ClaimError {}

impl Claims {
    fn read(text: &str) -> Result<Self, String> {
        let mut claims = Self::default();
        for word in text.split_whitespace() {
            let (key, value) = word.split_once('=').map_or((word, None), |(k, v)| (k, Some(v)));
            let number = || -> Result<u64, String> {
                let given = value.unwrap_or_default();
                let is_digits = given.bytes().all(|byte| byte.is_ascii_digit());
                let number = given.parse().ok().filter(|number| (1..=MOST).contains(number));
                number.filter(|_| is_digits).ok_or_else(|| {
                    format!("{}: {key} is a whole number from 1 to {MOST}", shortened(word))
                })
            };
            let repeated = match key {
                "order" => claims.order.replace(number()? as u32).is_some(),
                "estimate" => claims.estimate.replace(number()? as u32).is_some(),
                "outputs" => claims.outputs.replace(number()? as u32).is_some(),
                "evaluations" => claims.evaluations.replace(number()?).is_some(),
                "name" => {
                    let name = value.unwrap_or_default();
                    known_answers::method(name).ok_or_else(|| unknown(name))?;
                    claims.name.replace(name.to_string()).is_some()
                }
                "symplectic" | "symmetric" | "bounded-energy" | "free-outputs" | "crossings"
                | "refuses" | "forward-only" | "single-precision"
                    if value.is_some() =>
                {
                    return Err(format!("{}: {key} takes no value", shortened(word)));
                }
                "symplectic" => core::mem::replace(&mut claims.symplectic, true),
                "symmetric" => core::mem::replace(&mut claims.symmetric, true),
                "bounded-energy" => core::mem::replace(&mut claims.bounded_energy, true),
                "free-outputs" => core::mem::replace(&mut claims.free_outputs, true),
                "crossings" => core::mem::replace(&mut claims.crossings, true),
                "refuses" => core::mem::replace(&mut claims.refuses, true),
                "forward-only" => core::mem::replace(&mut claims.forward_only, true),
                "single-precision" => core::mem::replace(&mut claims.single_precision, true),
                _ => {
                    return Err(format!(
                        "{}: no such claim; there are order=P, symplectic, symmetric, \
                         bounded-energy, evaluations=N, name=METHOD, forward-only, \
                         single-precision and, of a solver, estimate=Q, free-outputs, crossings, \
                         outputs=N and refuses",
                        shortened(word)
                    ));
                }
            };
            if repeated {
                return Err(format!("{}: claimed twice", shortened(word)));
            }
        }
        Ok(claims)
    }
}

impl fmt::Display for Claims {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = [
            self.order.map(|order| format!("order={order}")),
            self.symplectic.then(|| "symplectic".to_string()),
            self.symmetric.then(|| "symmetric".to_string()),
            self.bounded_energy.then(|| "bounded-energy".to_string()),
            self.evaluations.map(|a_step| format!("evaluations={a_step}")),
            self.name.as_ref().map(|name| format!("name={name}")),
            self.estimate.map(|power| format!("estimate={power}")),
            self.free_outputs.then(|| "free-outputs".to_string()),
            self.crossings.then(|| "crossings".to_string()),
            self.refuses.then(|| "refuses".to_string()),
            self.outputs.map(|degree| format!("outputs={degree}")),
            self.forward_only.then(|| "forward-only".to_string()),
            self.single_precision.then(|| "single-precision".to_string()),
        ];
        f.write_str(&words.into_iter().flatten().collect::<Vec<_>>().join(" "))
    }
}

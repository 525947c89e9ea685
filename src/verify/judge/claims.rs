//! What is claimed of a stranger.

use core::fmt;
use core::str::FromStr;

/// What is claimed of an integrator. Nothing is, unless said. What comes with any claim (mirror,
/// turn, units, clock, repeatable, precision, and stage times where there is a drive) is not listed
/// here.
///
/// ```
/// use pendula::verify::Claims;
///
/// let claims: Claims = "order=2 symplectic symmetric evaluations=1".parse()?;
/// assert_eq!(claims, Claims::order(2).symplectic().symmetric().evaluations(1));
/// # Ok::<(), String>(())
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
    /// The method that it is, by its name on the command line.
    pub name: Option<String>,
}

impl Claims {
    /// No claims: it is said what the stranger is, and nothing is judged.
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether no claims are made.
    pub fn are_none(&self) -> bool {
        *self == Self::default()
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

    /// And that it is the method of this [name](crate::MethodInfo::name).
    pub fn name(self, name: impl Into<String>) -> Self {
        Self { name: Some(name.into()), ..self }
    }

    /// The claims of an entry of the library, its name among them. An implicit method claims no
    /// evaluations: their number depends on the sweeps. Beyond order 8 an energy error is rounding,
    /// of which nothing is claimed.
    pub fn of(entry: &crate::MethodInfo) -> Self {
        Self {
            order: Some(entry.order),
            symplectic: entry.symplectic,
            symmetric: entry.symmetric,
            bounded_energy: entry.symplectic && entry.order <= 8,
            evaluations: (!entry.implicit).then_some(entry.force_evaluations),
            name: Some(entry.name.to_string()),
        }
    }
}

/// The words of a claim, separated by blanks: `order=2 symplectic symmetric bounded-energy
/// evaluations=1 name=stormer-verlet`.
impl FromStr for Claims {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut claims = Self::default();
        for word in text.split_whitespace() {
            let (key, value) = word.split_once('=').map_or((word, None), |(k, v)| (k, Some(v)));
            let number = || -> Result<u64, String> {
                let given = value.unwrap_or_default();
                let number = given.parse().ok().filter(|number| (1..=99_999).contains(number));
                number.ok_or_else(|| format!("{word}: {key} is a whole number, as in {key}=2"))
            };
            let repeated = match key {
                "order" => claims.order.replace(number()? as u32).is_some(),
                "evaluations" => claims.evaluations.replace(number()?).is_some(),
                "name" => {
                    let name = value.filter(|name| crate::method_named(name).is_some());
                    let name = name.ok_or_else(|| {
                        let known = crate::METHODS.iter().map(|method| method.info().name);
                        format!("{word}: the names are {}", known.collect::<Vec<_>>().join(", "))
                    })?;
                    claims.name.replace(name.to_string()).is_some()
                }
                "symplectic" | "symmetric" | "bounded-energy" if value.is_some() => {
                    return Err(format!("{word}: {key} takes no value"));
                }
                "symplectic" => core::mem::replace(&mut claims.symplectic, true),
                "symmetric" => core::mem::replace(&mut claims.symmetric, true),
                "bounded-energy" => core::mem::replace(&mut claims.bounded_energy, true),
                _ => {
                    return Err(format!(
                        "{word}: no such claim; there are order=P, symplectic, symmetric, \
                         bounded-energy, evaluations=N and name=METHOD"
                    ));
                }
            };
            if repeated {
                return Err(format!("{word}: claimed twice"));
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
        ];
        f.write_str(&words.into_iter().flatten().collect::<Vec<_>>().join(" "))
    }
}

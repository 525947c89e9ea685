//! Accelerations and energies of pendulums, and the usual mistakes in them.

use std::sync::LazyLock;

use serde_json::Value;

use super::formula::{Names, evaluate};
use super::{checked, entries, text};

/// The right-hand side of a system's equations, at a dozen states.
///
/// ```
/// use pendula_judge::known_answers::{self, Comparison};
///
/// let pendulum = known_answers::right_hand_side("pendulum").unwrap();
/// let upside_down = pendulum.compare(f64::EPSILON, |point| {
///     let [theta, g, l] = ["theta", "g", "l"].map(|name| point.number(name));
///     vec![-l / g * libm::sin(theta)]
/// });
/// let Comparison::Mistakes(found) = upside_down else { panic!() };
/// assert_eq!(found[0].what, "l/g for g/l");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RightHandSide {
    /// The name of the system.
    pub name: String,
    /// Its equation, in words and signs.
    pub equation: String,
    /// The names of what is computed from a state, such as `alpha1` and `alpha2`.
    pub rates: Vec<String>,
    /// States with the right numbers.
    pub points: Vec<Point>,
    /// What people get wrong in the rates.
    pub mistakes: Vec<Wrong>,
    /// What people get wrong in the energy; empty where it is the pendulum's.
    pub energy_mistakes: Vec<Wrong>,
}

/// A state, with the parameters of the system, its rates and its energy.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Point {
    /// The parameters' name: `usual` has all lengths and masses 1 and g = 9.81.
    pub set: String,
    /// State and parameters, by their names (rad, rad/s, s, kg, m, m/s²).
    pub inputs: Vec<(String, f64)>,
    /// The right rates, in the order of [`RightHandSide::rates`].
    pub rates: Vec<f64>,
    /// How far off a right program may be, in ε of its type times the largest of the rates.
    pub tolerance: f64,
    /// The energy (J), 0 where all hang at rest.
    pub energy: f64,
    /// How far off it may be, in ε times the larger of itself and `depth`.
    pub energy_tolerance: f64,
    /// How far the energy at rest is below that of bobs at the height of the pivot (J).
    pub depth: f64,
}

/// What a mistake leads to.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Wrong {
    /// Its name.
    pub name: String,
    /// What is done, in a few words.
    pub what: String,
    /// What comes of it, or for what it is right.
    pub effect: String,
    /// Where it was seen.
    pub seen: String,
    /// The wrong numbers: for each point its rates, or its energy alone.
    pub numbers: Vec<Vec<f64>>,
}

/// A program has a mistake if it is within so many tolerances of it: they are measured on the right
/// formulas, and wrong ones may round more. Entries are 10 apart, in single precision.
const OF_A_MISTAKE: f64 = 4.0;

/// What a program's right-hand side or energy is.
#[derive(Clone, Debug, PartialEq)]
pub enum Comparison {
    /// It is right.
    Right,
    /// It is one of these mistakes, and these points do not tell which: of all points one at most.
    Mistakes(Vec<&'static Wrong>),
    /// It is neither right nor a usual mistake.
    Unknown,
}

impl Point {
    /// The number of the state or the parameters that has this name.
    ///
    /// # Panics
    /// If there is none.
    pub fn number(&self, name: &str) -> f64 {
        let found = self.inputs.iter().find(|(other, _)| other == name);
        found.unwrap_or_else(|| panic!("no {name} among {:?}", self.inputs)).1
    }

    /// How far off `rates` are, in tolerances, for a program whose ε is `epsilon`: at most 1 for a
    /// right one, NaN for a NaN.
    ///
    /// # Panics
    /// If there are not as many as the system has, or no type of numbers has this ε: it must be at
    /// least 2⁻⁵³ and at most 0.01.
    pub fn off(&self, rates: &[f64], epsilon: f64) -> f64 {
        self.beside(&self.rates, rates, epsilon)
    }

    /// How far off an energy is, likewise. `above_rest` is the energy of a program less its own
    /// where all hang at rest, with the same parameters: where it has its zero does not matter, as
    /// long as that is not far away. Both are rounded as they are; so if they are larger than what
    /// the tolerance is a multiple of, `epsilon` must be as many times larger.
    ///
    /// # Panics
    /// As [`Point::off`], for such an ε.
    pub fn energy_off(&self, above_rest: f64, epsilon: f64) -> f64 {
        self.energy_beside(self.energy, above_rest, epsilon)
    }

    /// How far `rates` are from `those`, in tolerances: the larger of these and the right ones is
    /// their size.
    fn beside(&self, those: &[f64], rates: &[f64], epsilon: f64) -> f64 {
        assert_eq!(rates.len(), those.len(), "as many numbers as the system has rates");
        let both = self.rates.iter().chain(those);
        let size = both.fold(0.0, |size, rate| f64::max(size, rate.abs()));
        let off = |sum: f64, (x, y): (&f64, &f64)| libm::fmaximum(sum, (x - y).abs());
        rates.iter().zip(those).fold(0.0, off) / (self.tolerance * checked(epsilon) * size)
    }

    fn energy_beside(&self, that: f64, above_rest: f64, epsilon: f64) -> f64 {
        let size = self.energy.abs().max(self.depth).max(that.abs());
        (above_rest - that).abs() / (self.energy_tolerance * checked(epsilon) * size)
    }
}

impl RightHandSide {
    /// What the rates of a program are whose ε is `epsilon`: it answers for each point, in the
    /// order of [`RightHandSide::rates`]. It agrees with an entry if it does at every point.
    ///
    /// # Panics
    /// If it answers other than as many numbers as there are rates, or no type of numbers has this
    /// ε, as [`Point::off`].
    pub fn compare(
        &'static self,
        epsilon: f64,
        program: impl FnMut(&Point) -> Vec<f64>,
    ) -> Comparison {
        let found: Vec<Vec<f64>> = self.points.iter().map(program).collect();
        let right = self.points.iter().zip(&found).all(|(point, x)| point.off(x, epsilon) <= 1.0);
        self.among(right, &self.mistakes, |point, i, wrong| {
            point.beside(&wrong.numbers[i], &found[i], epsilon)
        })
    }

    /// What the energy of a program is: of each point the energy less the program's own at rest,
    /// with the same parameters, as [`Point::energy_off`].
    ///
    /// # Panics
    /// As that.
    pub fn compare_energy(
        &'static self,
        epsilon: f64,
        above_rest: impl FnMut(&Point) -> f64,
    ) -> Comparison {
        let found: Vec<f64> = self.points.iter().map(above_rest).collect();
        let is_right = |(point, x): (&Point, &f64)| point.energy_off(*x, epsilon) <= 1.0;
        let right = self.points.iter().zip(&found).all(is_right);
        self.among(right, &self.energy_mistakes, |point, i, wrong| {
            point.energy_beside(wrong.numbers[i][0], found[i], epsilon)
        })
    }

    fn among(
        &'static self,
        right: bool,
        mistakes: &'static [Wrong],
        off: impl Fn(&Point, usize, &Wrong) -> f64,
    ) -> Comparison {
        let agrees = |wrong: &&Wrong| {
            let mut points = self.points.iter().enumerate();
            points.all(|(i, point)| off(point, i, wrong) <= OF_A_MISTAKE)
        };
        let found: Vec<&Wrong> = mistakes.iter().filter(agrees).collect();
        match (right, found.is_empty()) {
            (true, _) => Comparison::Right,
            (false, true) => Comparison::Unknown,
            (false, false) => Comparison::Mistakes(found),
        }
    }
}

/// The right-hand sides: of the pendulum, the damped and the driven one, and of the
/// double pendulum in its velocities and in its momenta.
pub fn right_hand_sides() -> &'static [RightHandSide] {
    &ALL
}

/// The right-hand side of the system of this name: `pendulum`, `damped-pendulum`,
/// `driven-pendulum`, `double-pendulum` or `double-pendulum-momenta`.
pub fn right_hand_side(system: &str) -> Option<&'static RightHandSide> {
    right_hand_sides().iter().find(|known| known.name == system)
}

static ALL: LazyLock<Vec<RightHandSide>> = LazyLock::new(|| {
    let text = include_str!("../../python/pendula/right-hand-sides.json");
    let file: Value = serde_json::from_str(text).expect("the file is JSON");
    let systems = file["systems"].as_object().expect("the systems by their names");
    systems.iter().map(|(name, system)| read(name, system, &file)).collect()
});

fn read(name: &str, system: &Value, file: &Value) -> RightHandSide {
    // Its own, or the name of a system that has the same.
    let energies = match &system["energies"] {
        Value::String(other) => &file["systems"][other]["energies"],
        own => own,
    };
    let (forms, energies) = (read_forms(&system["forms"]), read_forms(energies));
    let (state, rates) = (texts(&system["state"]), texts(&system["rates"]));
    let evaluate_rates = |lines: &[String], point: &Point| evaluate(lines, &point.inputs, &rates);
    let evaluate_energy =
        |lines: &[String], point: &Point| vec![above_rest(lines, &point.inputs, &state)];
    let points: Vec<Point> = entries(&system["points"])
        .iter()
        .map(|answer| {
            let mut point = read_point(answer, &state, system);
            point.rates = evaluate_rates(&forms[0].1, &point);
            point.energy = evaluate_energy(&energies[0].1, &point)[0];
            point
        })
        .collect();
    let wrong = |mistake: &Value, forms, evaluate: &dyn Fn(&[String], &Point) -> Vec<f64>| {
        let lines = wrong_lines(mistake, forms);
        Wrong {
            name: text(&mistake["name"]),
            what: text(&mistake["what"]),
            effect: text(&mistake["effect"]),
            seen: mistake["seen"].as_str().unwrap_or("usual").to_string(),
            numbers: points.iter().map(|point| evaluate(&lines, point)).collect(),
        }
    };
    // The wrong forces are mistakes in all that has the pendulum's.
    let has_force = forms.iter().any(|(form, _)| form == "plain");
    let forces = if has_force { entries(&file["forces"]) } else { &[] };
    let mistakes = forces.iter().chain(entries(&system["mistakes"]));
    let energy_mistakes = entries(&system["energy_mistakes"]).iter();
    RightHandSide {
        name: name.to_string(),
        equation: text(&system["equation"]),
        mistakes: mistakes.map(|one| wrong(one, &forms, &evaluate_rates)).collect(),
        energy_mistakes: energy_mistakes
            .map(|one| wrong(one, &energies, &evaluate_energy))
            .collect(),
        rates,
        points,
    }
}

/// Without what is right there.
fn read_point(point: &Value, state: &[String], system: &Value) -> Point {
    let set = text(&point["set"]);
    let parameters = system["sets"][&set].as_object().expect("the parameters by their names");
    let of_state = state.iter().cloned().zip(entries(&point["state"]).iter().map(float));
    let of_set = parameters.iter().map(|(name, value)| (name.clone(), float(value)));
    let inputs: Names = of_state.chain(of_set).collect();
    let depth = format!("depth = {}", text(&system["depth"]));
    Point {
        set,
        rates: vec![],
        tolerance: float(&point["tolerance"]),
        energy: 0.0,
        energy_tolerance: float(&point["energy_tolerance"]),
        depth: evaluate(&[depth], &inputs, &["depth".to_string()])[0],
        inputs,
    }
}

/// The lines of each form, by its name.
type Forms = Vec<(String, Vec<String>)>;

fn read_forms(forms: &Value) -> Forms {
    let read = |form: &Value| {
        let mut lines = texts(form);
        (lines.remove(0), lines)
    };
    entries(forms).iter().map(read).collect()
}

/// A mistake has its own formula, or every place of something in a form is changed: in the plain
/// one that has the pendulum's force, another force.
fn wrong_lines(mistake: &Value, forms: &Forms) -> Vec<String> {
    if mistake["formula"].is_array() {
        return texts(&mistake["formula"]);
    }
    let (form, changes) = match mistake["force"].as_str() {
        Some(force) => ("plain", vec![format!("-(g/l*sin(theta)) -> -({force})")]),
        None => (mistake["form"].as_str().expect("a form"), texts(&mistake["change"])),
    };
    let (_, lines) = forms.iter().find(|(name, _)| name == form).expect("a form of this name");
    let changed = changes.iter().fold(lines.join("\n"), |lines, change| {
        let (old, new) = change.split_once(" -> ").expect("old -> new");
        assert!(lines.contains(old), "no {old:?} in {lines}");
        lines.replace(old, new)
    });
    changed.lines().map(str::to_string).collect()
}

/// The energy that a formula says, less what it says where all hang at rest.
fn above_rest(lines: &[String], inputs: &Names, state: &[String]) -> f64 {
    let at_rest =
        |(name, x): &(String, f64)| (name.clone(), if state.contains(name) { 0.0 } else { *x });
    let rest: Names = inputs.iter().map(at_rest).collect();
    let [here, there] = [inputs, &rest].map(|at| evaluate(lines, at, &["energy".to_string()])[0]);
    here - there
}

fn texts(value: &Value) -> Vec<String> {
    entries(value).iter().map(text).collect()
}

fn float(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

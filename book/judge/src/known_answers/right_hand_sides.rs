//! Accelerations and energies of pendulums, and the usual mistakes in them.

use std::sync::LazyLock;

use serde_json::Value;

use super::{FILE, checked, entries, number, text};

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
    /// The parameters' name in the file: `usual` has all lengths and masses 1 and g = 9.81.
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

/// The right-hand sides of the file: of the pendulum, the damped and the driven one, and of the
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
    let systems = FILE["right_hand_sides"].as_object().expect("the systems by their names");
    systems.iter().map(|(name, system)| read(name, system)).collect()
});

fn read(name: &str, system: &Value) -> RightHandSide {
    let rates: Vec<String> = entries(&system["rates"]).iter().map(text).collect();
    let state: Vec<String> = entries(&system["state"]).iter().map(text).collect();
    let energy = ["energy".to_string()];
    RightHandSide {
        name: name.to_string(),
        equation: text(&system["equation"]),
        points: entries(&system["answers"])
            .iter()
            .map(|answer| read_point(answer, &state, &rates, &system["sets"]))
            .collect(),
        mistakes: read_wrong(&system["mistakes"], &rates),
        energy_mistakes: read_wrong(&system["energy_mistakes"], &energy),
        rates,
    }
}

fn read_point(answer: &Value, state: &[String], rates: &[String], sets: &Value) -> Point {
    let set = text(&answer["set"]);
    let parameters = sets[&set].as_object().expect("the parameters by their names");
    let of_state = state.iter().map(|name| (name.clone(), number(&answer[name])));
    let of_set = parameters.iter().map(|(name, value)| (name.clone(), number(value)));
    Point {
        inputs: of_state.chain(of_set.filter(|(name, _)| name != "depth")).collect(),
        rates: rates.iter().map(|name| number(&answer[name])).collect(),
        tolerance: number(&answer["tolerance"]),
        energy: number(&answer["energy"]),
        energy_tolerance: number(&answer["energy_tolerance"]),
        depth: number(&parameters["depth"]),
        set,
    }
}

fn read_wrong(mistakes: &Value, names: &[String]) -> Vec<Wrong> {
    let read = |wrong: &Value| {
        let column = |name: &String| entries(&wrong[name]).iter().map(number).collect();
        let columns: Vec<Vec<f64>> = names.iter().map(column).collect();
        let row = |i| columns.iter().map(|column| column[i]).collect();
        Wrong {
            name: text(&wrong["name"]),
            what: text(&wrong["what"]),
            effect: text(&wrong["effect"]),
            seen: text(&wrong["seen"]),
            numbers: (0..columns[0].len()).map(row).collect(),
        }
    };
    entries(mistakes).iter().map(read).collect()
}

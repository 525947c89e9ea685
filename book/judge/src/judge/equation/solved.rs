//! The equation that is solved in place of the pendulum's, as a system, and the method on it.

use core::f64::consts::PI;

use super::departure::short;
use super::form::{DEGREES, Equation, SHAPES};
use crate::judge::identity::{Asked, names};
use crate::judge::probe::{G_OVER_L, distance};
use crate::known_answers;
use pendula::registry::{ByName, methods_for_separable};
use pendula::systems::{Phase, Separable, System};
use pendula::{AnyMethod, Grid, METHODS, method_named};

/// θ̇ = a ω, ω̇ = −(g/L) f(θ) − c ω − d ω|ω| + e.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    /// a.
    pub drift: f64,
    /// f.
    pub force: fn(f64) -> f64,
    /// Its factor (1/s²).
    pub g_over_l: f64,
    /// c (1/s).
    pub linear: f64,
    /// d (1/rad).
    pub quadratic: f64,
    /// e (1/s²).
    pub torque: f64,
    /// What the numbers are known to, in units of √(g/L) and g/L.
    pub known_to: f64,
}

impl System for Solved {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: self.drift * z.omega, omega: self.force(t, z) }
    }
}

impl ByName for Solved {
    fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
        methods_for_separable()
    }
}

impl Separable for Solved {
    type Force = f64;

    fn force(&self, _t: f64, Phase { theta, omega }: Phase) -> f64 {
        let Self { force, g_over_l, linear, quadratic, torque, .. } = *self;
        -g_over_l * force(theta) - linear * omega - quadratic * omega * omega.abs() + torque
    }

    fn kick(&self, z: Phase, force: f64, h: f64) -> Phase {
        Phase { omega: z.omega + h * force, ..z }
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        Phase { theta: z.theta + h * self.drift * z.omega, ..z }
    }
}

/// A method by which it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Its name on the command line, or that of the known answers.
    pub name: &'static str,
    /// Its name in text.
    pub title: &'static str,
    /// By how much eight steps are apart (rad).
    pub apart: f64,
}

impl Solved {
    /// This equation, with the numbers that are meant.
    pub fn of(equation: &Equation) -> Self {
        let Equation { known_to, shape, beside: [linear, quadratic, torque], .. } = *equation;
        let frequency = libm::sqrt(G_OVER_L);
        let unit = libm::pow(G_OVER_L, -equation.power());
        let factor = match (shape, short(equation.factor * unit, known_to)) {
            (DEGREES, factor) if (factor - 180.0 / PI).abs() <= 60.0 * known_to => 180.0 / PI,
            (_, factor) => factor,
        };
        Self {
            drift: equation.drifts(),
            force: SHAPES[shape].value,
            g_over_l: factor * G_OVER_L / unit,
            linear: short(linear * frequency, known_to * frequency),
            quadratic: short(quadratic, known_to),
            torque: short(torque * G_OVER_L, known_to * G_OVER_L),
            known_to,
        }
    }

    /// The method whose steps on this equation the integrator's are: to its own rounding, where no
    /// other method lies within ten times that.
    pub fn method(&self, asked: &Asked) -> Option<Solver> {
        let of_the_library = METHODS.iter().filter_map(|method| {
            let info = method.info();
            let on_it = method_named::<Self>(info.name)?;
            let apart = asked
                .apart(1e-3, distance, |start, h, count| self.states(on_it, start, h, count))?;
            Some(Solver { name: info.name, title: info.title, apart })
        });
        let drift_first = asked.apart(1e-3, distance, |start, h, count| {
            let mut z = start;
            let step = |_| {
                z = self.drift(z, h);
                z = self.kick(z, self.force(0.0, z), h);
                z
            };
            Some((0..count).map(step).collect())
        });
        let drift_first = drift_first.and_then(|apart| {
            let (name, title) = names(known_answers::method("symplectic-euler-drift-first")?);
            Some(Solver { name, title, apart })
        });
        let mut all: Vec<Solver> = of_the_library.chain(drift_first).collect();
        all.sort_by(|a, b| a.apart.total_cmp(&b.apart));
        let bound = asked.bound().max(1e2 * self.known_to);
        let best = *all.first().filter(|best| best.apart <= bound)?;
        let room = 10.0 * libm::fmax(best.apart, 0.1 * asked.bound().min(bound));
        let second = all.get(1).map_or(f64::INFINITY, |second| second.apart);
        (second > room).then_some(best)
    }

    fn states(
        &self,
        method: &dyn AnyMethod<Self>,
        start: Phase,
        h: f64,
        count: u64,
    ) -> Option<Vec<Phase>> {
        let grid = Grid::new(h, count).ok()?;
        let mut states = Vec::new();
        let mut keep = |n: u64, _: f64, z: Phase| {
            if n > 0 {
                states.push(z);
            }
        };
        let done = method.try_run(self, start, &grid, &mut keep);
        let nothing = Phase { theta: f64::NAN, omega: f64::NAN };
        if done.is_err() {
            states.resize(count as usize, nothing);
        }
        Some(states)
    }
}

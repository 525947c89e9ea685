//! Impostors of the methods of high order: their tables with an entry changed, their loops cut
//! short.

use pendula::arithmetic::sine::{cos, sin};
use pendula::internals::runge_kutta::dop853;
use pendula::methods::splitting::{Splitting, kicks};
use pendula::methods::{Dop853, ForestRuth, Gauss4, Taylor24, Yoshida6};
use pendula::{Counting, Info, Method, Pendulum, Phase, Separable};

use super::{Plain, impostor, poses_as};

macro_rules! composition {
    ($(#[$doc:meta])* $name:ident poses as $truth:ident, $n:literal substeps, $substeps:expr) => {
        $(#[$doc])*
        pub struct $name;

        poses_as!($name, $truth);

        impl $name {
            const SUBSTEPS: [f64; $n] = $substeps;
        }

        impl Splitting for $name {
            const KICKS: &'static [f64] = &kicks::<$n, { $n + 1 }>(Self::SUBSTEPS);
            const DRIFTS: &'static [f64] = &Self::SUBSTEPS;
        }
    };
}

composition! {
    /// The triple jump with its first substep too long by a millionth: the three do not add up to a
    /// whole step.
    TripleJumpTooLong poses as ForestRuth, 3 substeps,
    [ForestRuth::DRIFTS[0] + 1e-6, ForestRuth::DRIFTS[1], ForestRuth::DRIFTS[2]]
}

composition! {
    /// The triple jump with its outer substeps off by a millionth, and the middle one chosen so
    /// that the sum is 1; the sum of cubes is nearly 0.
    TripleJumpOff poses as ForestRuth, 3 substeps,
    [ForestRuth::DRIFTS[0] + 1e-6, ForestRuth::DRIFTS[1] - 2e-6, ForestRuth::DRIFTS[2] + 1e-6]
}

composition! {
    /// Yoshida's substeps with the wrong sign of the second, and the middle one chosen so that the
    /// sum is 1.
    SignLost poses as Yoshida6, 7 substeps, {
        let [a, b, c] = [Yoshida6::DRIFTS[0], -Yoshida6::DRIFTS[1], Yoshida6::DRIFTS[2]];
        [a, b, c, 1.0 - 2.0 * (a + b + c), c, b, a]
    }
}

composition! {
    /// Yoshida's substeps to six digits, and the middle one chosen so that the sum is 1.
    SixDigits poses as Yoshida6, 7 substeps, {
        const fn short(x: f64) -> f64 {
            (x * 1e6) as i64 as f64 / 1e6
        }
        let all = Yoshida6::DRIFTS;
        let [a, b, c] = [short(all[0]), short(all[1]), short(all[2])];
        [a, b, c, 1.0 - 2.0 * (a + b + c), c, b, a]
    }
}

impostor! {
    /// Gauss's method of two stages after a single sweep of its iteration: an explicit method.
    SweptOnce poses as Gauss4, |system, t, h, z| {
        let table = Gauss4::TABLEAU;
        let mut k = [system.rate(t, z); 2];
        for i in 0..2 {
            let [one, other] = [0, 1].map(|j| table.b[j] * table.parts[i][j]);
            let slope = k[0] * one + k[1] * other;
            k[i] = system.rate(t + table.c[i] * h, z + slope * h);
        }
        z + (k[0] * table.b[0] + k[1] * table.b[1]) * h
    }
}

/// DOP853's table as data, with one entry off.
pub struct EntryOff {
    /// The row: the name of a stage, or of the step.
    pub row: &'static str,
    /// The stage whose coefficient is off.
    pub term: &'static str,
    /// By how much.
    pub by: f64,
}

poses_as!(EntryOff, Dop853);

impl EntryOff {
    /// The stages of DOP853, the first of which is the rate at the start.
    const STAGES: usize = 12;

    /// The rows of the stages after the first, and of the step, each with what the stages before it
    /// are multiplied by.
    fn rows(&self) -> [[f64; Self::STAGES]; Self::STAGES] {
        let stages = dop853::STEP.stages;
        let names: Vec<&str> = ["k1"].into_iter().chain(stages.iter().map(|it| it.name)).collect();
        let step = dop853::STEP.sums.iter().find(|row| row.name == "step");
        let mut rows = stages.iter().chain(step);
        core::array::from_fn(|_| {
            let (mut factors, row) = ([0.0; Self::STAGES], rows.next().expect("a row for each"));
            for (term, a) in row.terms {
                let off = if (row.name, *term) == (self.row, self.term) { self.by } else { 0.0 };
                let stage = names.iter().position(|name| name == term).expect("an earlier stage");
                factors[stage] = a.value + off;
            }
            factors
        })
    }
}

impl<S: Plain> Method<S> for EntryOff {
    type Carry = [[f64; Self::STAGES]; Self::STAGES];

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: Phase) -> Self::Carry {
        self.rows()
    }

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, rows: &mut Self::Carry) -> Phase {
        let mut slopes = [Phase::default(); Self::STAGES];
        let sum = |row: &[f64; Self::STAGES], slopes: &[Phase]| {
            let terms = slopes.iter().zip(row).map(|(slope, factor)| *slope * *factor);
            terms.reduce(|sum, term| sum + term).expect("a term at least")
        };
        slopes[0] = system.rate(t, z);
        for (i, stage) in dop853::STEP.stages.iter().enumerate() {
            let c = stage.node.expect("a stage's time").value;
            slopes[i + 1] = system.rate(t + c * h, z + sum(&rows[i], &slopes[..=i]) * h);
        }
        z + sum(&rows[Self::STAGES - 1], &slopes) * h
    }
}

/// The Taylor series of order 24, term by term as in a book, without one of the products in one
/// coefficient each of the sine and the cosine.
pub struct TermDropped {
    /// The power of the step at which the coefficients of sine and cosine lack …
    pub power: usize,
    /// … the product with this power of the angle.
    pub factor: usize,
}

impl TermDropped {
    /// No term dropped.
    pub const NONE: Self = Self { power: 0, factor: 0 };

    fn step_of(&self, pendulum: &Pendulum, h: f64, z: Phase) -> Phase {
        const P: usize = 24;
        let (mut theta, mut omega) = ([0.0; P + 1], [0.0; P + 1]);
        let (mut s, mut c) = ([0.0; P + 1], [0.0; P + 1]);
        // The coefficients of θ, each times its power.
        let mut slopes = [0.0; P + 1];
        (theta[0], omega[0], s[0], c[0]) = (z.theta, z.omega, sin(z.theta), cos(z.theta));
        for k in 1..=P {
            let power = k as f64;
            slopes[k] = h * omega[k - 1];
            theta[k] = slopes[k] / power;
            omega[k] = -h * pendulum.frequency_squared() * s[k - 1] / power;
            let mut factors = slopes;
            if k == self.power {
                factors[self.factor] = 0.0;
            }
            let (mut sine, mut cosine) = (0.0, 0.0);
            for ((factor, s), c) in
                factors[1..=k].iter().zip(s[..k].iter().rev()).zip(c[..k].iter().rev())
            {
                sine += factor * c;
                cosine -= factor * s;
            }
            (s[k], c[k]) = (sine / power, cosine / power);
        }
        let sum = |terms: [f64; P + 1]| terms.iter().rev().sum();
        Phase { theta: sum(theta), omega: sum(omega) }
    }
}

poses_as!(TermDropped, Taylor24);

impl Method<Counting<Pendulum>> for TermDropped {
    type Carry = ();

    fn start(&self, _pendulum: &Counting<Pendulum>, _t: f64, _h: f64, _z: Phase) {}

    fn step(
        &self,
        pendulum: &Counting<Pendulum>,
        t: f64,
        h: f64,
        z: Phase,
        _carry: &mut (),
    ) -> Phase {
        // They count, as those of the series that it poses as.
        for _ in 0..self.info().force_evaluations {
            pendulum.force(t, z);
        }
        self.step_of(pendulum.system(), h, z)
    }
}

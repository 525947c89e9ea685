//! The cells of the paper's tables that theory predicts.

use std::sync::LazyLock;

use pendula::{Grid, Pendulum};

use super::cell_id;
use crate::experiments::PaperMethod;
use crate::experiments::{STEPS, convergence, long_run, small_angle, work};
use crate::theory::small_angle::{LinearRecurrence, errors};
use crate::theory::{Dimensionless, forward_euler, rk4, scaled, stormer_verlet, symplectic_euler};

/// A cell of a table, predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The id of the cell, as in the [`Ledger`](crate::claims::Ledger).
    pub id: String,
    /// The predicted value, in the unit of the cell.
    pub value: f64,
    /// How far, relatively, the measured value may lie from it: what the law leaves out, and
    /// rounding.
    pub tolerance: f64,
    /// The law behind it.
    pub law: &'static str,
}

impl Prediction {
    /// Relative distance of the prediction from what was `measured`; positive where too much was
    /// predicted.
    pub const fn relative_error(&self, measured: f64) -> f64 {
        (self.value - measured) / measured
    }

    /// Whether what was `measured` lies within the tolerance.
    pub const fn agrees_with(&self, measured: f64) -> bool {
        self.relative_error(measured).abs() <= self.tolerance
    }
}

/// All 49 predictions, in the order of the ledger: Tables 4, 5, 6 and 8, and last `P6.3.norm` from
/// the text (Section 6.3): RK4's largest angle error over θ₀, at θ₀ = 1e-4.
///
/// They are computed at the first call, in half a second.
pub fn predictions() -> &'static [Prediction] {
    static ALL: LazyLock<Vec<Prediction>> = LazyLock::new(computed);
    &ALL
}

fn computed() -> Vec<Prediction> {
    let mut all = Vec::new();
    let (table_4, table_8) = (Run::TABLE_4, Run::TABLE_8);
    for law in ENERGY_LAWS {
        all.extend(STEPS.map(|h| law.predict(table_4, h, |row| cell_id(4, row, h))));
    }
    for law in ENERGY_LAWS {
        all.push(law.predict(Run::TABLE_5, long_run::STEP, |row| cell_id(5, row, "dH")));
    }
    for law in ANGLE_LAWS {
        all.extend(STEPS.map(|h| angle(&law, table_8, h)));
    }
    for law in ENERGY_LAWS {
        all.push(law.predict(table_8, STEPS[work::TABLE_8], |row| cell_id(8, row, "dH")));
    }
    all.push(normalised_angle());
    all
}

/// A release from rest at an angle (rad), followed for a duration (s).
#[derive(Clone, Copy)]
struct Run {
    theta_0: f64,
    duration: f64,
    /// Whether forward Euler goes over the top so late, and gains so little in a swing, that its
    /// error depends on the phase in which it does. It goes over in Table 4 too, at the three
    /// largest steps, after 6, 5 and 27 s; see `forward_euler_tolerance`.
    goes_over_late: bool,
}

impl Run {
    const TABLE_4: Self = Self {
        theta_0: convergence::THETA_0,
        duration: convergence::DURATION,
        goes_over_late: false,
    };
    const TABLE_5: Self =
        Self { theta_0: long_run::THETA_0, duration: long_run::DURATION, goes_over_late: true };
    /// Table 6 too.
    const TABLE_8: Self = Self {
        theta_0: small_angle::THETA_0,
        duration: small_angle::DURATION,
        goes_over_late: false,
    };

    fn steps(self, h: f64) -> u64 {
        Grid::with_duration(h, self.duration)
            .expect("the paper's durations are whole numbers of steps")
            .steps()
    }

    /// Energy above the bottom (J).
    fn energy(self) -> f64 {
        let pendulum = Pendulum::PAPER;
        pendulum.depth() * Dimensionless::new(self.theta_0, 0.0).energy()
    }

    /// What rounding may add to the largest energy error (J): at each step a random half-unit of
    /// the energy.
    fn rounding(self, h: f64) -> f64 {
        f64::EPSILON * self.energy() * libm::sqrt(self.steps(h) as f64)
    }
}

// -------------------------------------------------------------------------------------------------
// Energy: Tables 4, 5 and 8
// -------------------------------------------------------------------------------------------------

const SOLVED: &str = "its modified equation to order h⁵, solved";
const SLOWED: &str = "its linear recurrence, slowed as the pendulum is by θ₀²/16";

/// How a method's largest energy error is predicted.
struct EnergyLaw {
    method: PaperMethod,
    law: &'static str,
    /// The largest energy error (J) from an angle of release (rad), for a step (s) and a number of
    /// steps.
    value: fn(f64, f64, u64) -> f64,
    /// What the law leaves out, relatively, for a run, a step (s) and the value.
    left_out: fn(Run, f64, f64) -> f64,
}

const ENERGY_LAWS: [EnergyLaw; 4] = [
    EnergyLaw {
        method: PaperMethod::ForwardEuler,
        law: SOLVED,
        value: |theta_0, h, steps| {
            forward_euler::largest_energy_error(&Pendulum::PAPER, theta_0, h, steps)
        },
        left_out: |run, h, _| forward_euler_tolerance(run, h),
    },
    EnergyLaw {
        method: PaperMethod::SymplecticEuler,
        law: "the level curve of its conserved energy to order h⁷",
        value: |theta_0, h, _| symplectic_euler::largest_energy_error(&Pendulum::PAPER, theta_0, h),
        // x⁸ is 1e-4 at h = 0.1, with a coefficient below 1/1000.
        left_out: |_, _, _| SAMPLING,
    },
    EnergyLaw {
        method: PaperMethod::Rk4,
        law: "the energy changes of single steps, h⁵e₅ + … + h⁸e₈, along the exact orbit",
        value: |theta_0, h, steps| rk4::largest_energy_error(&Pendulum::PAPER, theta_0, h, steps),
        // The rate of loss is roughly ∝ E²: as the energy falls by ΔH, the rate falls by 2ΔH/E,
        // and by half that on average. The phase error of x⁴/120 per radian changes the bounded
        // part only; x⁹e₉ is odd in q.
        left_out: |run, _, error| error / run.energy(),
    },
    EnergyLaw {
        method: PaperMethod::StormerVerlet,
        law: "m g L (1 − cos θ₀) [x²(5 + cos θ₀)/24 + x⁴(1 − cos θ₀)²/240], x = ω₀h",
        value: |theta_0, h, _| stormer_verlet::energy_error(&Pendulum::PAPER, theta_0, h),
        // The next term is at most x⁴ (100 + 33)/30240 × 24/5 × (1 − c₀)² of the first, and c₀ ≥ ½.
        left_out: |_, h, _| {
            let x = scaled(&Pendulum::PAPER, h);
            0.0053 * x * x * x * x + SAMPLING
        },
    },
];

impl EnergyLaw {
    fn predict(&self, run: Run, h: f64, id: impl Fn(PaperMethod) -> String) -> Prediction {
        let value = (self.value)(run.theta_0, h, run.steps(h));
        let tolerance = (self.left_out)(run, h, value) + run.rounding(h) / value;
        Prediction { id: id(self.method), value, tolerance, law: self.law }
    }
}

/// A highest sample δ steps away from the maximum of the curve lies below it, by ½(2x δ)²
/// relatively. With the 46 maxima of Table 4 spread evenly between the samples δ is 1/92, which
/// gives 2.3e-5 at h = 0.1. At smaller steps the spread may be less even, but x² is smaller by
/// more.
const SAMPLING: f64 = 2.5e-5;

/// What the modified equation to order h⁵ leaves out, relatively.
///
/// On a small swing the frequency is wrong by x⁶/7 and the rate of the energy gain by x⁶/4, the
/// next terms of atan x and ln(1 + x²); over the 160 rad of Table 4 and an energy 20 times larger,
/// the second makes x⁶ and the first 20 x⁶ rad, which matters to the energy only by its ripple, of
/// order x. 10 x⁶ covers both. The phase in which it goes over, as below, makes 3 and 5 x⁶ at 0.1
/// and 0.05 s, where each swing doubles the energy or nearly so. At 0.01 s the same estimate is
/// 1/4 × 84 rad over a fifth, 100 x⁶: ten times more than is allowed, and 2000 times more than the
/// error that is measured, 0.05 x⁶.
///
/// In Table 5 the phase in which it goes over the top matters most: 1e-9 × 1/4 × the 140 rad until
/// then, in units of the 0.03 of its energy that each swing adds there. With x⁶ and x⁷ included
/// that error falls from 1.3e-7 to 4e-10.
fn forward_euler_tolerance(run: Run, h: f64) -> f64 {
    /// The solver's own error, over the whole of a run.
    const SOLVER: f64 = 1e-10;
    let x = scaled(&Pendulum::PAPER, h);
    let x6 = x * x * x * x * x * x;
    if run.goes_over_late { 1000.0 * x6 } else { 10.0 * x6 + SOLVER }
}

// -------------------------------------------------------------------------------------------------
// Angle: Table 6 and Section 6.3
// -------------------------------------------------------------------------------------------------

/// How a method's angle error in the small swing is predicted.
struct AngleLaw {
    method: PaperMethod,
    /// Its recurrence on the linear oscillator; `None` for a swing that does not stay small, where
    /// the modified equation is used.
    recurrence: Option<fn(&Pendulum, f64) -> LinearRecurrence>,
    /// How much the relative error of its frequency changes with the amplitude, per A², as a
    /// function of x: the cross term that the recurrence with a slower phase leaves out.
    cross_term: fn(f64) -> f64,
}

const ANGLE_LAWS: [AngleLaw; 4] = [
    AngleLaw { method: PaperMethod::ForwardEuler, recurrence: None, cross_term: |_| 0.0 },
    // τ₂ falls with the amplitude as 1 − θ₀²/8 (theory::period): x²/24 × 1/8. In terms of its own
    // amplitude symplectic Euler equals Verlet.
    AngleLaw {
        method: PaperMethod::SymplecticEuler,
        recurrence: Some(LinearRecurrence::symplectic_euler),
        cross_term: |x| x * x / 192.0,
    },
    // τ₄ falls by less than 1 − θ₀²/2 (theory::rk4::period_shift).
    AngleLaw {
        method: PaperMethod::Rk4,
        recurrence: Some(LinearRecurrence::rk4),
        cross_term: |x| x * x * x * x / 240.0,
    },
    AngleLaw {
        method: PaperMethod::StormerVerlet,
        recurrence: Some(LinearRecurrence::stormer_verlet),
        cross_term: |x| x * x / 192.0,
    },
];

/// A cell of Table 6.
fn angle(law: &AngleLaw, run: Run, h: f64) -> Prediction {
    let Run { theta_0, .. } = run;
    let pendulum = &Pendulum::PAPER;
    let (steps, x) = (run.steps(h), scaled(pendulum, h));
    let id = cell_id(6, law.method, h);
    let Some(recurrence) = law.recurrence else {
        let angles = forward_euler::trajectory(pendulum, theta_0, h).map(|z| z.theta);
        let (value, _) = errors(pendulum, theta_0, h, steps, angles);
        return Prediction { id, value, tolerance: forward_euler_tolerance(run, h), law: SOLVED };
    };
    let angles = recurrence(pendulum, h).angles(theta_0);
    let (value, _) = errors(pendulum, theta_0, h, steps, angles);
    // A frequency wrong by δ leaves δ θ₀ω₀T/√6 in the root mean square. Left out are the cross term
    // and A⁴/3072, the next term of the pendulum's own frequency; a third more for the harmonics.
    let square = theta_0 * theta_0;
    let frequency = (law.cross_term)(x) * square + square * square / 3072.0;
    let turned = pendulum.small_angle_frequency() * run.duration;
    let left_out = frequency * theta_0 * turned / libm::sqrt(6.0);
    Prediction { id, value, tolerance: 4.0 / 3.0 * left_out / value, law: SLOWED }
}

/// RK4's largest angle error over θ₀ where the formula is all but exact, so that the method's own
/// error shows.
fn normalised_angle() -> Prediction {
    const THETA_0: f64 = 1e-4;
    let pendulum = &Pendulum::PAPER;
    let h = STEPS[work::TABLE_8];
    let steps = Run::TABLE_8.steps(h);
    let angles = LinearRecurrence::rk4(pendulum, h).angles(THETA_0);
    let (_, largest) = errors(pendulum, THETA_0, h, steps, angles);
    Prediction {
        id: "P6.3.norm".to_string(),
        value: largest / THETA_0,
        // The difference of two angles of θ₀, each rounded a thousand times in its phase: √1000
        // ε/2.6e-7, with a margin of 30 as one sum of phases is not random.
        tolerance: 1e-6,
        law: SLOWED,
    }
}

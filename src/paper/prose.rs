//! What the paper says in its sentences: each claim with how it is measured and what became of it.
//!
//! The ids follow the paper: `A` abstract, `P` a section's number, `T1` and `T3` its tables of parameters, `F` a figure, `X` what it leaves
//! open and its numbers decide.

use super::Verdict::{
    self, DependsOnPlatform, DependsOnRounding, NotCheckable, Reproduced, ReproducedWithDefinition,
    Wrong,
};
use super::measure::{in_paper, row_id};
use super::{Claim, Measured, Tolerance};
use crate::methods::{
    forward_euler::ForwardEuler, rk4::Rk4, stormer_verlet::StormerVerlet,
    symplectic_euler::SymplecticEuler,
};
use crate::order::slopes;
use crate::paper::number::Format::{self, Fixed, Scientific, Significant};
use crate::study::properties::{AREA_TOLERANCE, EnergyBehaviour};
use crate::study::variants::{DriftKick, PositionVerlet};
use crate::study::{
    STEPS, Study, convergence, findings, long_run, phase_portrait, small_angle, work,
};
use crate::{AnyMethod, Grid, Hamiltonian, LinearOscillator, Pendulum, exact};

/// A sentence of the paper.
struct Prose {
    id: &'static str,
    place: &'static str,
    gist: &'static str,
    stated: &'static str,
    definition: &'static str,
    verdict: Verdict,
    because: &'static str,
    measure: fn(&Study) -> Finding,
}

/// What is measured, and how it compares with what is stated.
type Finding = (Measured, Tolerance);

/// A number that has to meet the printed digits.
const fn number(value: f64, format: Format) -> Finding {
    (Measured::Number(value, format), Tolerance::PrintedDigits)
}

/// A number that decides by a comparison.
const fn shows(value: f64, format: Format, holds: bool) -> Finding {
    (Measured::Number(value, format), Tolerance::Decided(holds))
}

/// Words that decide by a comparison.
const fn says(text: String, holds: bool) -> Finding {
    (Measured::Text(text), Tolerance::Decided(holds))
}

const fn nothing(_: &Study) -> Finding {
    (Measured::Nothing, Tolerance::PrintedDigits)
}

/// The row of the method `id` in a table of rows.
macro_rules! row {
    ($rows:expr, $id:literal) => {
        $rows.iter().find(|row| row_id(row.method) == $id).expect("one of the paper's methods")
    };
}

/// All claims in prose, measured.
pub(super) fn claims(study: &Study) -> impl Iterator<Item = Claim> {
    PROSE.iter().map(|prose| {
        let (measured, tolerance) = (prose.measure)(study);
        Claim {
            id: prose.id.to_string(),
            place: prose.place,
            gist: prose.gist.to_string(),
            definition: prose.definition,
            stated: Some(prose.stated),
            measured,
            tolerance,
            verdict: prose.verdict,
            because: prose.because,
        }
    })
}

fn order_range(study: &Study, id: &str) -> (f64, f64) {
    let row = study.convergence.iter().find(|row| row_id(row.method) == id);
    let drift = row.map_or([f64::NAN; 5], |row| row.drift);
    let slopes = slopes(&STEPS, &drift, 1e-11).flatten();
    slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

fn orders_confirmed(study: &Study) -> Finding {
    let within = |id, order: f64| {
        let (low, high) = order_range(study, id);
        (low - order).abs() < 0.15 && (high - order).abs() < 0.15
    };
    let (rk4, fe) = (order_range(study, "rk4"), order_range(study, "fe"));
    says(
        std::format!(
            "slopes of the energy error: RK4 up to {:.2}, forward Euler {:.2} to {:.2}",
            rk4.1,
            fe.0,
            fe.1
        ),
        within("fe", 1.0) && within("se", 1.0) && within("vv", 2.0) && within("rk4", 4.0),
    )
}

fn monotonic(study: &Study) -> Finding {
    let falls = row!(study.long_run, "fe").falls;
    says(std::format!("{falls} of 100 000 steps lower the energy"), falls == 0)
}

/// Whether an orbit of Störmer–Verlet from the chaotic layer crosses u = ω Δt = 2π, which it can only where no
/// invariant curve is left between 0 and 2π.
fn escapes(k: f64) -> bool {
    findings::chaotic_speed(&StormerVerlet, k, 200_000) > 2.0 * core::f64::consts::PI
}

fn bounded(_: &Study) -> Finding {
    let drift = |steps| findings::energy_drift(&StormerVerlet, 1.0, 0.01, steps);
    let (small, large) = (drift(1_000_000) <= 1.001 * drift(100_000), escapes(1.5));
    says(
        std::format!(
            "at 0.01 s {}; at K = 0.9 {}; at K = 1.5 {}",
            if small { "bounded over 10⁶ steps" } else { "growing" },
            if escapes(0.9) { "unbounded" } else { "bounded" },
            if large { "unbounded" } else { "bounded" },
        ),
        small,
    )
}

fn largest_formula_error(theta_0: f64, step: f64) -> f64 {
    findings::normalised_formula_error(&Rk4, theta_0, step).0
}

const PROSE: &[Prose] = &[
    Prose {
        id: "T1.g",
        place: "Table 1",
        gist: "g (m/s²)",
        stated: "9.81",
        definition: "the constant that meets every cell of the tables",
        verdict: Reproduced,
        because: "Table 3 has the same.",
        measure: |_| number(Pendulum::PAPER.gravity(), Fixed(2)),
    },
    Prose {
        id: "T1.units_H",
        place: "Eq. 3, Table 1",
        gist: "H as a function of θ and ω is the Hamiltonian",
        stated: "Hamiltonian",
        definition: "the momentum conjugate to θ is m L² ω",
        verdict: ReproducedWithDefinition,
        because: "(θ, ω) are canonical coordinates only where m L² = 1, as in the paper; elsewhere areas scale by m L².",
        measure: |_| {
            let pendulum = Pendulum::PAPER;
            let inertia = pendulum.mass() * pendulum.length() * pendulum.length();
            says(std::format!("m L² = {inertia} kg m²"), inertia == 1.0)
        },
    },
    Prose {
        id: "T3.g",
        place: "Table 3",
        gist: "gravitational acceleration (m/s²)",
        stated: "9.81",
        definition: "input",
        verdict: Reproduced,
        because: "",
        measure: |_| number(Pendulum::PAPER.gravity(), Fixed(2)),
    },
    Prose {
        id: "T3.L",
        place: "Table 3",
        gist: "length (m)",
        stated: "1.0",
        definition: "input",
        verdict: Reproduced,
        because: "",
        measure: |_| number(Pendulum::PAPER.length(), Fixed(1)),
    },
    Prose {
        id: "T3.m",
        place: "Table 3",
        gist: "mass (kg)",
        stated: "1.0",
        definition: "input",
        verdict: Reproduced,
        because: "",
        measure: |_| number(Pendulum::PAPER.mass(), Fixed(1)),
    },
    Prose {
        id: "T3.omega0",
        place: "Table 3",
        gist: "initial angular velocity (rad/s)",
        stated: "0.0",
        definition: "input; elsewhere the same symbol means √(g/L)",
        verdict: Reproduced,
        because: "",
        measure: |_| number(crate::Phase::at_rest(1.0).omega, Fixed(1)),
    },
    Prose {
        id: "A.dts",
        place: "Abstract, Section 5.2",
        gist: "number of steps in the ladder",
        stated: "5",
        definition: "0.1, 0.05, 0.01, 0.005, 0.001 s",
        verdict: Reproduced,
        because: "",
        measure: |_| number(STEPS.len() as f64, Fixed(0)),
    },
    Prose {
        id: "A.tspan",
        place: "Abstract",
        gist: "duration of the long run (s)",
        stated: "1000",
        definition: "100 000 steps of 0.01 s",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let grid = Grid::over(long_run::DURATION, long_run::STEP);
            number(grid.map_or(f64::NAN, |grid| grid.time(grid.steps())), Fixed(0))
        },
    },
    Prose {
        id: "A.bounded",
        place: "Abstract, Section 8",
        gist: "symplectic energy errors stay bounded however long the run",
        stated: "bounded",
        definition: "largest energy error over 10⁶ against 10⁵ steps; speed reached from the chaotic layer",
        verdict: ReproducedWithDefinition,
        because: "True of small steps. The method is the standard map: beyond K = g Δt²/L = 0.9716, that is 0.3147 s, energy diffuses without bound.",
        measure: bounded,
    },
    Prose {
        id: "A.verlet_pct",
        place: "Abstract, Section 8",
        gist: "energy error of Störmer–Verlet over 1000 s, in per cent of |H(0)|",
        stated: "0.02",
        definition: "Table 5",
        verdict: Reproduced,
        because: "",
        measure: |study| number(row!(study.long_run, "vv").percent_of_initial(), Significant(5)),
    },
    Prose {
        id: "A.rk4_order",
        place: "Abstract",
        gist: "RK4 converges with order",
        stated: "4",
        definition: "slope of the largest error of the state against the exact solution",
        verdict: ReproducedWithDefinition,
        because: "The state has order 4, a single step order 5, and so has the energy error that the paper shows.",
        measure: |study| number(row!(study.properties, "rk4").order(), Fixed(2)),
    },
    Prose {
        id: "A.optimal",
        place: "Abstract, Section 8",
        gist: "Störmer–Verlet is the best choice for long runs",
        stated: "the best",
        definition: "largest energy error over the paper's own 1000 s: Störmer–Verlet's over RK4's",
        verdict: Wrong,
        because: "In the paper's own long run RK4's error is that many times smaller; its loss reaches Störmer–Verlet's amplitude only after 240 times as long.",
        measure: |study| {
            let ratio = row!(study.long_run, "vv").drift / row!(study.long_run, "rk4").drift;
            shows(ratio, Fixed(0), ratio < 1.0)
        },
    },
    Prose {
        id: "A.period",
        place: "Abstract, Sections 1 and 8",
        gist: "relative error of the period at 3 rad (%)",
        stated: "0.001",
        definition: "time of the highest sample on the grid, against the elliptic integral",
        verdict: ReproducedWithDefinition,
        because: "It is the spacing of the grid; see T7.relerr.",
        measure: |study| {
            let periods = &study.large_angle;
            number(periods.percent(periods.by_peak), Significant(6))
        },
    },
    Prose {
        id: "A.dt2",
        place: "Abstract",
        gist: "power of Δt in Störmer–Verlet's energy error",
        stated: "2",
        definition: "slope of Table 4 at its finest steps",
        verdict: Reproduced,
        because: "The error is Δt² (g/L)² (5 + cos θ₀)(1 − cos θ₀)/24, from the modified Hamiltonian.",
        measure: |study| number(order_range(study, "vv").0, Fixed(3)),
    },
    Prose {
        id: "P1.lines200",
        place: "Section 1",
        gist: "the implementation has fewer than 200 lines",
        stated: "< 200",
        definition: "",
        verdict: NotCheckable,
        because: "The code is not supplied, and Section 8 speaks of 300.",
        measure: nothing,
    },
    Prose {
        id: "P8.lines300",
        place: "Section 8",
        gist: "everything comes from fewer than 300 lines",
        stated: "< 300",
        definition: "",
        verdict: NotCheckable,
        because: "The code is not supplied, and Section 1 speaks of 200.",
        measure: nothing,
    },
    Prose {
        id: "P1.orders",
        place: "Section 1",
        gist: "the orders 1, 1, 2, 4 are confirmed",
        stated: "1, 1, 2, 4",
        definition: "slopes of the energy error between neighbouring steps of Table 4, each to ± 0.15",
        verdict: Wrong,
        because: "The energy error of RK4 has order 5, and forward Euler is not yet in the range where it has one.",
        measure: orders_confirmed,
    },
    Prose {
        id: "P1.three_orders",
        place: "Section 1",
        gist: "symplectic methods conserve energy better by three orders of magnitude",
        stated: "10³",
        definition: "forward Euler's energy error over symplectic Euler's in Table 5",
        verdict: ReproducedWithDefinition,
        because: "It is nearly four for symplectic Euler and nearly six for Störmer–Verlet.",
        measure: |study| {
            let ratio = row!(study.long_run, "fe").drift / row!(study.long_run, "se").drift;
            shows(ratio, Scientific(3), ratio > 1e3)
        },
    },
    Prose {
        id: "P1.no_elementary",
        place: "Section 1",
        gist: "the pendulum has no solution in elementary functions",
        stated: "none",
        definition: "third harmonic of the exact motion over the first at 3 rad: a sinusoid has none",
        verdict: Reproduced,
        because: "The solution is Jacobi's sn, whose nome is not elementary.",
        measure: |_| {
            let third = findings::waveform(3.0).1;
            shows(third, Fixed(4), third > 0.1)
        },
    },
    Prose {
        id: "P2.alltime",
        place: "Section 2",
        gist: "energy errors of order Δtᵖ for all time",
        stated: "all time",
        definition: "whether Störmer–Verlet leaves the chaotic layer at K = g Δt²/L = 1.5",
        verdict: Wrong,
        because: "The theorem gives times exponential in 1/Δt, for Δt small enough. At K = 1.5 there is no bound.",
        measure: |_| {
            let text = if escapes(1.5) { "no bound at K = 1.5" } else { "bounded at K = 1.5" };
            says(text.to_string(), !escapes(1.5))
        },
    },
    Prose {
        id: "P3.eq5",
        place: "Section 3.4",
        gist: "T = 4 √(L/g) K(sin(θ₀/2))",
        stated: "Eq. 5",
        definition: "against the return time of the closed form; the argument of K is the modulus k, not m = k²",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let start = crate::Phase::at_rest(2.0);
            let period = exact::period(&Pendulum::PAPER, 2.0).unwrap_or(f64::NAN);
            let motion = crate::Motion::new(&Pendulum::PAPER, start);
            let back = motion.map_or(f64::NAN, |motion| motion.at(period).theta);
            says("closes the orbit".to_string(), (back - 2.0).abs() < 1e-14)
        },
    },
    Prose {
        id: "P3.eq4",
        place: "Section 3.3",
        gist: "θ₀ cos ω₀t solves the linear oscillator",
        stated: "Eq. 4",
        definition: "released from rest",
        verdict: Reproduced,
        because: "It holds for a release from rest only.",
        measure: |_| {
            let linear = LinearOscillator::of(Pendulum::PAPER);
            let start = crate::Phase::at_rest(0.05);
            let kept = linear.energy(linear.exact(start, 7.3)) / linear.energy(start);
            says("conserves its energy".to_string(), (kept - 1.0).abs() < 1e-14)
        },
    },
    Prose {
        id: "P4.rk4_lte",
        place: "Section 4.4",
        gist: "order of RK4's local truncation error",
        stated: "4",
        definition: "slope of the error of a single step",
        verdict: Wrong,
        because: "A single step is of order 5; the global error is of order 4.",
        measure: |_| {
            let slope = findings::one_step_slope(&Rk4);
            shows(slope, Fixed(1), (slope - 4.0).abs() < 0.5)
        },
    },
    Prose {
        id: "P4.rk4_evals",
        place: "Section 4.4",
        gist: "force evaluations of RK4 a step",
        stated: "4",
        definition: "counted",
        verdict: Reproduced,
        because: "",
        measure: |study| number(row!(study.properties, "rk4").evaluations, Fixed(0)),
    },
    Prose {
        id: "P4.vv_evals",
        place: "Sections 4.5 and 8",
        gist: "force evaluations of Störmer–Verlet a step",
        stated: "2",
        definition: "counted",
        verdict: Wrong,
        because: "The force at the end of a step is that at the start of the next.",
        measure: |study| number(row!(study.properties, "vv").evaluations, Fixed(0)),
    },
    Prose {
        id: "P4.vv_twoform",
        place: "Sections 4.5 and 8",
        gist: "Störmer–Verlet preserves the symplectic form",
        stated: "exactly",
        definition: "det J − 1 of one step, within the error of the difference quotient",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let defect = row!(study.properties, "vv").area_defect.abs();
            says("det J = 1".to_string(), defect < AREA_TOLERANCE)
        },
    },
    Prose {
        id: "P4.fe_nonsymp",
        place: "Section 4.2",
        gist: "forward Euler is not symplectic",
        stated: "not symplectic",
        definition: "det J − 1 of one step of 0.1 s at 1 rad",
        verdict: Reproduced,
        because: "The defect is Δt² (g/L) cos θ: area grows below the horizontal and shrinks above.",
        measure: |study| {
            let defect = row!(study.properties, "fe").area_defect;
            shows(defect, Fixed(5), defect.abs() > AREA_TOLERANCE)
        },
    },
    Prose {
        id: "P4.se_symp",
        place: "Section 4.3",
        gist: "the new velocity makes symplectic Euler symplectic, and its energy error bounded",
        stated: "bounded",
        definition: "det J, and the energy over 1000 s",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let row = row!(study.properties, "se");
            let bounded = row.energy == EnergyBehaviour::BoundedOscillation;
            says("det J = 1; bounded oscillation".to_string(), row.symplectic() && bounded)
        },
    },
    Prose {
        id: "P5.metric_pct",
        place: "Section 5.3",
        gist: "energy errors in per cent of |H(0)|",
        stated: "a measure of quality",
        definition: "|H(0)| at a release from π/2 (J), where the percentage is infinite",
        verdict: ReproducedWithDefinition,
        because: "It depends on where the potential is said to be zero.",
        measure: |study| {
            let quarter = crate::Phase::at_rest(core::f64::consts::FRAC_PI_2);
            let initial = Pendulum::PAPER.hamiltonian(quarter).abs();
            let table = row!(study.long_run, "fe").percent_of_initial();
            says("zero to rounding".to_string(), initial < 1e-14 && (table - 9090.0).abs() < 0.5)
        },
    },
    Prose {
        id: "P5.metric_rms",
        place: "Section 5.3",
        gist: "the mean of the RMS error runs over N samples",
        stated: "N",
        definition: "samples that meet Table 6 at 0.1 s",
        verdict: ReproducedWithDefinition,
        because: "Seven cells of Table 6 are met with N + 1 samples only.",
        measure: |study| {
            let over_all = row!(study.small_angle, "fe").errors[0].formula;
            // 100 steps: the mean over N instead of N + 1 samples.
            let over_steps = over_all * libm::sqrt(101.0 / 100.0);
            let meets = |value: f64| (value - 0.919).abs() <= 0.0005;
            says("N + 1".to_string(), meets(over_all) && !meets(over_steps))
        },
    },
    Prose {
        id: "P5.core",
        place: "Section 5.4",
        gist: "one core, Python with NumPy and SciPy",
        stated: "environment",
        definition: "",
        verdict: NotCheckable,
        because: "Neither machine nor versions are recorded.",
        measure: nothing,
    },
    Prose {
        id: "P6.1.fe200",
        place: "Section 6.1",
        gist: "forward Euler's energy error exceeds 200 J at 0.1 s",
        stated: "> 200",
        definition: "T4.fe.0.1",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let drift = row!(study.convergence, "fe").drift[0];
            shows(drift, Significant(6), drift > 200.0)
        },
    },
    Prose {
        id: "P6.1.fe_order",
        place: "Section 6.1",
        gist: "forward Euler's energy error falls as Δt",
        stated: "slope 1",
        definition: "slopes between neighbouring steps of Table 4, each to ± 0.15",
        verdict: Wrong,
        because: "Coarse steps go over the top and rotate, fine ones only swing higher: regimes with different laws.",
        measure: |study| {
            let (low, high) = order_range(study, "fe");
            let text = std::format!("slopes from {low:.2} to {high:.2}");
            says(text, (low - 1.0).abs() < 0.15 && (high - 1.0).abs() < 0.15)
        },
    },
    Prose {
        id: "P6.1.machine",
        place: "Sections 6.1 and 7.2",
        gist: "RK4 conserves energy to machine precision at 0.001 s",
        stated: "machine precision",
        definition: "its energy error over one unit in the last place of |H(0)| (8.9e-16 J) exceeds 1000",
        verdict: Wrong,
        because: "Nearly all of it is truncation: a loss of order Δt⁵ and an oscillation of order Δt⁴.",
        measure: |study| {
            // |H(0)| = 4.905 J lies between 4 and 8, where neighbours are 4 ε apart.
            let units = row!(study.convergence, "rk4").drift[4] / (4.0 * f64::EPSILON);
            let text = if units > 1000.0 { "over 1000 units" } else { "under 1000 units" };
            says(text.to_string(), units < 10.0)
        },
    },
    Prose {
        id: "P6.1.ratio",
        place: "Sections 6.1 and 7.2",
        gist: "Störmer–Verlet's energy error at 0.01 s over that at 0.005 s",
        stated: "3.99",
        definition: "from the cells rounded to three digits, as the paper does",
        verdict: DependsOnRounding,
        because: "The ratio of the unrounded cells is 4.0000.",
        measure: |study| {
            let drift = row!(study.convergence, "vv").drift;
            let rounded = |value: f64| std::format!("{value:.2e}").parse().unwrap_or(f64::NAN);
            number(rounded(drift[2]) / rounded(drift[3]), Fixed(4))
        },
    },
    Prose {
        id: "P6.1.slope",
        place: "Section 6.1, Figure 2",
        gist: "RK4's energy error falls with slope",
        stated: "4",
        definition: "slope of Table 4 between 0.05 s and 0.01 s",
        verdict: Wrong,
        because: "The loss is x⁶/72 a step, of order Δt⁵ over a fixed time.",
        measure: |study| {
            let drift = row!(study.convergence, "rk4").drift;
            let slope = slopes(&STEPS[1..3], &drift[1..3], 0.0).flatten().next();
            number(slope.unwrap_or(f64::NAN), Fixed(2))
        },
    },
    Prose {
        id: "P6.1.best",
        place: "Table 4",
        gist: "the smallest energy error at each step",
        stated: "RK4",
        definition: "the least of each column",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let rk4 = row!(study.convergence, "rk4");
            let least = |column: usize| {
                let rows = study.convergence.iter().filter(|row| in_paper(row.method));
                rows.into_iter().all(|row| row.drift[column] >= rk4.drift[column])
            };
            says("RK4".to_string(), (0..STEPS.len()).all(least))
        },
    },
    Prose {
        id: "P6.1.highest",
        place: "Section 6.1, Figure 2",
        gist: "RK4 has the highest order of convergence",
        stated: "RK4",
        definition: "slopes of Table 4",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let rk4 = order_range(study, "rk4").0;
            let others = ["fe", "se", "vv"].map(|id| order_range(study, id).1);
            says("RK4".to_string(), others.into_iter().all(|slope| slope < rk4))
        },
    },
    Prose {
        id: "P6.2.omit",
        place: "Section 6.2",
        gist: "RK4's energy error over 1000 s is negligible",
        stated: "negligible",
        definition: "largest energy error (J), against 1e-5",
        verdict: Reproduced,
        because: "True, and it hides that RK4 is the best method of this experiment.",
        measure: |study| {
            let drift = row!(study.long_run, "rk4").drift;
            shows(drift, Scientific(6), drift < 1e-5)
        },
    },
    Prose {
        id: "P6.2.mono",
        place: "Section 6.2, Figures 3 and 4",
        gist: "forward Euler's energy grows monotonically",
        stated: "monotonic",
        definition: "steps of the 1000 s run that lower the energy",
        verdict: Wrong,
        because: "Above the horizontal a step takes energy away; the first to do so is at 27.6 s.",
        measure: monotonic,
    },
    Prose {
        id: "P6.2.se_pct",
        place: "Section 6.2, Figure 3",
        gist: "symplectic Euler's energy error over 1000 s (%)",
        stated: "1.3",
        definition: "Table 5",
        verdict: Reproduced,
        because: "",
        measure: |study| number(row!(study.long_run, "se").percent_of_initial(), Significant(5)),
    },
    Prose {
        id: "P6.2.escape",
        place: "Section 6.2",
        gist: "forward Euler's pendulum would have escaped to infinity",
        stated: "escaped",
        definition: "speed at the end (rad/s)",
        verdict: Wrong,
        because: "A pendulum cannot escape: it goes round and round, about five times a second.",
        measure: |study| {
            let omega = row!(study.long_run, "fe").end.omega.abs();
            shows(omega, Fixed(2), !omega.is_finite())
        },
    },
    Prose {
        id: "P6.2.final",
        place: "Sections 6.2 and 7.1",
        gist: "forward Euler's energy after 1000 s (J)",
        stated: "475.7",
        definition: "Eq. 3",
        verdict: Reproduced,
        because: "",
        measure: |study| number(row!(study.long_run, "fe").last, Fixed(6)),
    },
    Prose {
        id: "P6.2.five_orders",
        place: "Section 6.2",
        gist: "forward Euler and Störmer–Verlet differ by nearly five orders of magnitude",
        stated: "< 10⁵",
        definition: "ratio of their energy errors",
        verdict: Wrong,
        because: "It is nearer to six.",
        measure: |study| {
            let ratio = row!(study.long_run, "fe").drift / row!(study.long_run, "vv").drift;
            shows(ratio, Scientific(3), ratio < 1e5)
        },
    },
    Prose {
        id: "P6.3.floor",
        place: "Sections 6.3 and 7.3",
        gist: "the small-angle formula itself is off by (rad)",
        stated: "1e-4",
        definition: "RMS error of the formula against the exact solution over 10 s",
        verdict: Reproduced,
        because: "It is a phase error and grows with the duration: no floor.",
        measure: |study| number(row!(study.small_angle, "rk4").errors[4].formula, Scientific(6)),
    },
    Prose {
        id: "P6.3.converge",
        place: "Section 6.3",
        gist: "RK4 and Störmer–Verlet converge to that floor",
        stated: "converge",
        definition: "RK4's and Störmer–Verlet's error at 0.01 s over that at 0.001 s",
        verdict: ReproducedWithDefinition,
        because: "RK4 from above. Störmer–Verlet passes below it: at 0.01955 s its error and the formula's cancel.",
        measure: |study| {
            let ratio = |id| {
                let row = study.small_angle.iter().find(|row| row_id(row.method) == id);
                row.map_or(f64::NAN, |row| row.errors[2].formula / row.errors[4].formula)
            };
            let (rk4, vv) = (ratio("rk4"), ratio("vv"));
            says(std::format!("{rk4:.3} and {vv:.3}"), (rk4 - 1.0).abs() < 0.01 && vv < 1.0)
        },
    },
    Prose {
        id: "P6.3.norm",
        place: "Sections 6.3 and 7.3",
        gist: "RK4's error over θ₀ at θ₀ = 1e-4 rad",
        stated: "2.6e-7",
        definition: "the largest over all samples at 0.01 s, not the RMS",
        verdict: ReproducedWithDefinition,
        because: "Over nine tenths of it are RK4's own phase error; at 0.001 s it is 1.9e-8.",
        measure: |_| number(largest_formula_error(1e-4, 0.01), Scientific(4)),
    },
    Prose {
        id: "P6.3.below",
        place: "Section 6.3",
        gist: "that is well below 1e-6",
        stated: "< 10⁻⁶",
        definition: "the same",
        verdict: Reproduced,
        because: "At 0.01 s; at 0.05 s it is not.",
        measure: |_| {
            let error = largest_formula_error(1e-4, 0.01);
            shows(error, Scientific(4), error < 1e-6)
        },
    },
    Prose {
        id: "P6.3.best",
        place: "Table 6",
        gist: "the smallest error at each step",
        stated: "printed in bold",
        definition: "the least of each column",
        verdict: ReproducedWithDefinition,
        because: "The last three win by cancelling the formula's error; against the exact solution RK4 is ahead at every step.",
        measure: |study| {
            let rows = || study.small_angle.iter().filter(|row| in_paper(row.method));
            let best = |column: usize, pick: fn(&small_angle::Errors) -> f64| {
                let error = |row: &small_angle::Row| pick(&row.errors[column]);
                let best = rows().min_by(|a, b| error(a).total_cmp(&error(b)));
                best.map_or("", |row| row.method.properties().title)
            };
            let winners: Vec<&str> = (0..5).map(|column| best(column, |e| e.formula)).collect();
            let expected = ["RK4", "RK4", "Störmer–Verlet", "Störmer–Verlet", "Symplectic Euler"];
            says(winners.join(", "), winners == expected)
        },
    },
    Prose {
        id: "P6.4.closed",
        place: "Section 6.4, Figure 5",
        gist: "RK4's orbits are closed",
        stated: "closed",
        definition: "largest |Δθ| after one exact period, for the three orbits (rad)",
        verdict: ReproducedWithDefinition,
        because: "To the eye. RK4 loses energy and spirals inward.",
        measure: |_| {
            let missed = phase_portrait::THETA_0.map(|theta_0| findings::closure(&Rk4, theta_0));
            let largest = missed.iter().fold(0.0, |largest: f64, miss| largest.max(miss.0));
            let inward = missed.iter().all(|miss| miss.2 > 0.0);
            shows(largest, Scientific(1), largest < 1e-8 && inward)
        },
    },
    Prose {
        id: "P6.4.elong",
        place: "Section 6.4",
        gist: "larger orbits are more elongated",
        stated: "more elongated",
        definition: "largest ω over ω₀ θ₀, exactly 2 sin(θ₀/2)/θ₀",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let ratio = phase_portrait::THETA_0
                .map(|theta_0| 2.0 * crate::sine::sin(0.5 * theta_0) / theta_0);
            let text = ratio.map(|ratio| std::format!("{ratio:.3}")).join(", ");
            says(text, ratio.is_sorted_by(|a, b| a > b))
        },
    },
    Prose {
        id: "P6.5.T",
        place: "Section 6.5",
        gist: "numerical and exact period agree (s)",
        stated: "5.158",
        definition: "time of the highest sample",
        verdict: ReproducedWithDefinition,
        because: "See T7.Tnum.",
        measure: |study| number(study.large_angle.by_peak, Fixed(4)),
    },
    Prose {
        id: "P6.5.ratio",
        place: "Section 6.5",
        gist: "T/T₀",
        stated: "2.57",
        definition: "exact period over small-angle period",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let periods = &study.large_angle;
            number(periods.exact / periods.small_angle, Fixed(6))
        },
    },
    Prose {
        id: "P6.5.wave",
        place: "Section 6.5, Figure 6",
        gist: "more time near the turning points than a sinusoid",
        stated: "more",
        definition: "fraction of time beyond nine tenths of the amplitude; a sinusoid has 0.287",
        verdict: Reproduced,
        because: "The third harmonic over the first is cosh(r/2)/(3 cosh(3r/2)) with r = πK'/K.",
        measure: |_| {
            let (beyond, _) = findings::waveform(3.0);
            shows(beyond, Fixed(2), beyond > 0.287)
        },
    },
    Prose {
        id: "P6.6.dom",
        place: "Section 6.6, Figure 7",
        gist: "RK4 has the lowest error for a given budget",
        stated: "RK4",
        definition: "the paper's Table 8: Störmer–Verlet's error over RK4's, with a quarter of the evaluations",
        verdict: Wrong,
        because: "Its own Table 8 contradicts it; against the exact solution it would be true.",
        measure: |study| {
            let error = |id| {
                let row = study.work.iter().find(|row| row_id(row.method) == id);
                row.map_or(f64::NAN, |row| row.points[work::TABLE_8].1.formula)
            };
            let ratio = error("vv") / error("rk4");
            shows(ratio, Fixed(3), ratio > 1.0)
        },
    },
    Prose {
        id: "P6.6.34",
        place: "Section 6.6",
        gist: "RK4 costs three to four times as much a step",
        stated: "3–4",
        definition: "wall time",
        verdict: DependsOnPlatform,
        because: "Of the interpreter. Four evaluations against one is the stable fact.",
        measure: nothing,
    },
    Prose {
        id: "P6.6.best",
        place: "Section 6.6, Figure 7",
        gist: "Störmer–Verlet has the best trade-off at moderate precision",
        stated: "Störmer–Verlet",
        definition: "its RMS error over RK4's for 400 evaluations each, from 1 rad over 10 s, against the exact solution",
        verdict: Wrong,
        because: "RK4 is ahead from about 200 evaluations on, that is for every error below a hundredth of a radian.",
        measure: |study| {
            let methods = [row!(study.work, "vv").method, row!(study.work, "rk4").method];
            let [vv, rk4] = methods.map(|method| findings::error_for_work(method, 400));
            shows(vv / rk4, Fixed(1), vv < rk4)
        },
    },
    Prose {
        id: "P6.6.33",
        place: "Section 6.6",
        gist: "RK4's overhead over forward Euler",
        stated: "3.3",
        definition: "wall time",
        verdict: DependsOnPlatform,
        because: "The division is right; the times are those of one machine.",
        measure: nothing,
    },
    Prose {
        id: "P6.6.120",
        place: "Section 6.6",
        gist: "forward Euler's RMS error over RK4's",
        stated: "120",
        definition: "Table 8, against the small-angle formula",
        verdict: ReproducedWithDefinition,
        because: "Limited by the formula; against the exact solution it is over two million.",
        measure: |study| {
            let error = |id| {
                let row = study.work.iter().find(|row| row_id(row.method) == id);
                row.map_or(f64::NAN, |row| row.points[work::TABLE_8].1.formula)
            };
            number(error("fe") / error("rk4"), Fixed(1))
        },
    },
    Prose {
        id: "P7.1.kin",
        place: "Section 7.1",
        gist: "forward Euler's kinetic energy exceeds any physical bound",
        stated: "beyond any bound",
        definition: "turns a second at the end of the long run",
        verdict: Wrong,
        because: "An ordinary rate: an electric fan turns faster.",
        measure: |study| {
            let omega = row!(study.long_run, "fe").end.omega.abs();
            let rate = omega / (2.0 * core::f64::consts::PI);
            shows(rate, Fixed(2), rate > 1e3)
        },
    },
    Prose {
        id: "P7.1.surface",
        place: "Section 7.1",
        gist: "the symplectic methods stay on the true energy surface",
        stated: "true surface",
        definition: "symplectic Euler's energy error over 1000 s (%)",
        verdict: Wrong,
        because: "They stay on the surface of a modified energy.",
        measure: |study| {
            let percent = row!(study.long_run, "se").percent_of_initial();
            shows(percent, Significant(5), percent < 1e-10)
        },
    },
    Prose {
        id: "P7.1.md",
        place: "Section 7.1",
        gist: "molecular dynamics takes a thousand million steps",
        stated: "10⁹",
        definition: "",
        verdict: NotCheckable,
        because: "A statement about other work.",
        measure: nothing,
    },
    Prose {
        id: "P7.1.fe1000",
        place: "Section 7.1",
        gist: "forward Euler's energy error over 1000 s (%)",
        stated: "9090",
        definition: "Table 5",
        verdict: Reproduced,
        because: "",
        measure: |study| number(row!(study.long_run, "fe").percent_of_initial(), Significant(5)),
    },
    Prose {
        id: "P7.2.precise",
        place: "Section 7.2",
        gist: "the orders match theory precisely",
        stated: "1, 1, 2, 4",
        definition: "as P1.orders",
        verdict: Wrong,
        because: "Only symplectic Euler and Störmer–Verlet do.",
        measure: orders_confirmed,
    },
    Prose {
        id: "P7.3.all",
        place: "Section 7.3",
        gist: "all methods converge to a common floor",
        stated: "all",
        definition: "forward Euler's error at 0.001 s over RK4's",
        verdict: Wrong,
        because: "Forward Euler is ten times above it and symplectic Euler below it at the finest step.",
        measure: |study| {
            let error = row!(study.small_angle, "fe").errors[4].formula;
            let ratio = error / row!(study.small_angle, "rk4").errors[4].formula;
            shows(ratio, Fixed(1), (ratio - 1.0).abs() < 0.1)
        },
    },
    Prose {
        id: "P7.4.se",
        place: "Section 7.4",
        gist: "symplectic Euler is the cheapest: evaluations a step",
        stated: "1",
        definition: "counted",
        verdict: ReproducedWithDefinition,
        because: "Störmer–Verlet costs the same, and is the same method seen half a kick later.",
        measure: |study| number(row!(study.properties, "se").evaluations, Fixed(0)),
    },
    Prose {
        id: "P7.4.rk4",
        place: "Section 7.4",
        gist: "RK4 has the smallest error a step",
        stated: "RK4",
        definition: "slope of the error of a single step, the largest of the four",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let others: [&dyn AnyMethod; 3] = [&ForwardEuler, &SymplecticEuler, &StormerVerlet];
            let rk4 = findings::one_step_slope(&Rk4);
            let highest = others.iter().all(|other| findings::one_step_slope(*other) < rk4);
            shows(rk4, Fixed(1), highest)
        },
    },
    Prose {
        id: "P7.4.fe",
        place: "Section 7.4",
        gist: "forward Euler's energy grows without end",
        stated: "monotonic growth",
        definition: "energy above the bottom after 10⁶ steps of 0.1 s over ½ (π/Δt)²",
        verdict: Wrong,
        because: "It saturates: at half a turn a step, what one step gains the next one loses.",
        measure: |_| {
            let half_turn = core::f64::consts::PI / 0.1;
            let energy = findings::last_energy(&ForwardEuler, 1.0, 0.1, 1_000_000);
            let ratio = energy / (0.5 * half_turn * half_turn);
            let text = if (ratio - 1.0).abs() < 0.05 { "saturated" } else { "not saturated" };
            says(text.to_string(), ratio > 1.5)
        },
    },
    Prose {
        id: "P7.5.adaptive",
        place: "Section 7.5",
        gist: "the study has no adaptive methods",
        stated: "none",
        definition: "",
        verdict: NotCheckable,
        because: "The paper's own account of its scope.",
        measure: nothing,
    },
    Prose {
        id: "P8.order",
        place: "Section 8",
        gist: "the orders match theory precisely",
        stated: "1, 1, 2, 4",
        definition: "as P1.orders",
        verdict: Wrong,
        because: "See P1.orders.",
        measure: orders_confirmed,
    },
    Prose {
        id: "P8.bounded",
        place: "Section 8",
        gist: "symplectic energy errors stay bounded however long the run",
        stated: "bounded",
        definition: "as A.bounded",
        verdict: ReproducedWithDefinition,
        because: "See A.bounded.",
        measure: bounded,
    },
    Prose {
        id: "F1",
        place: "Figure 1",
        gist: "the architecture is modular",
        stated: "a diagram",
        definition: "",
        verdict: NotCheckable,
        because: "The picture is missing from the text.",
        measure: nothing,
    },
    Prose {
        id: "F4",
        place: "Figure 4",
        gist: "forward Euler at 0.01 s",
        stated: "a curve",
        definition: "",
        verdict: NotCheckable,
        because: "Neither amplitude nor duration is given.",
        measure: nothing,
    },
    Prose {
        id: "F7",
        place: "Figure 7",
        gist: "error against wall time",
        stated: "a curve",
        definition: "",
        verdict: DependsOnPlatform,
        because: "Only the times at 0.01 s are tabulated, and they are those of one machine.",
        measure: nothing,
    },
    Prose {
        id: "X.symbols",
        place: "Tables 2 and 8",
        gist: "two evaluations a step agree with Störmer–Verlet's time over forward Euler's",
        stated: "1.6",
        definition: "2.87/1.80 of Table 8, which lies between one evaluation and two",
        verdict: Reproduced,
        because: "The paper's program evaluates the force twice; it need not.",
        measure: |_| number(2.87 / 1.80, Fixed(2)),
    },
    Prose {
        id: "X.order_variant",
        place: "Section 4.3",
        gist: "symplectic Euler kicks first",
        stated: "kick, then drift",
        definition: "Table 6 at 0.1 s by drift-kick (rad)",
        verdict: ReproducedWithDefinition,
        because: "Drift-kick would print 3.62e-3 where the paper has 7.86e-3.",
        measure: |_| {
            let error = findings::normalised_formula_error(&DriftKick, 0.05, 0.1).1 * 0.05;
            shows(error, Scientific(3), (error - 7.86e-3).abs() > 5e-6)
        },
    },
    Prose {
        id: "X.verlet_variant",
        place: "Section 4.5",
        gist: "Störmer–Verlet in velocity form",
        stated: "kick, drift, kick",
        definition: "Table 4 at 0.1 s by drift-kick-drift (J)",
        verdict: ReproducedWithDefinition,
        because: "The position form would print 1.02e-1 where the paper has 1.10e-1.",
        measure: |_| {
            let drift = findings::energy_drift(&PositionVerlet, convergence::THETA_0, 0.1, 500);
            shows(drift, Scientific(3), (drift - 1.10e-1).abs() > 5e-4)
        },
    },
];

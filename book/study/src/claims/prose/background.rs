//! Abstract to experimental set-up: Sections 1 to 5 and the tables of parameters.

use super::*;

pub(super) const CLAIMS: &[Prose] = &[
    Prose {
        id: "T1.g",
        place: "Table 1",
        gist: "g (m/s²)",
        stated: "9.81",
        definition: "from the printed energy at the start of the long run, −5.300 J = −m g L cos 1",
        verdict: Reproduced,
        because: "Table 3 has the same.",
        measure: |_| {
            let cell = CELLS.iter().find(|cell| cell.id == "T5.fe.H0").expect("it is printed");
            let energy: f64 = cell.stated.replace('−', "-").parse().expect("a number");
            number(-energy / pendula::arithmetic::sine::cos(long_run::THETA_0), Fixed(2))
        },
    },
    Prose {
        id: "T1.units_H",
        place: "Eq. 3, Table 1",
        gist: "H as a function of θ and ω is the Hamiltonian",
        stated: "Hamiltonian",
        definition: "the momentum conjugate to θ is m L² ω",
        verdict: ReproducedWithDefinition,
        because: "(θ, ω) are canonical coordinates only where m L² = 1, as in the paper; elsewhere \
                  areas scale by m L².",
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
        measure: |_| number(pendula::Phase::at_rest(1.0).omega, Fixed(1)),
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
            let grid = Grid::with_duration(long_run::STEP, long_run::DURATION);
            number(grid.map_or(f64::NAN, |grid| grid.time(grid.steps())), Fixed(0))
        },
    },
    Prose {
        id: "A.bounded",
        place: "Abstract, Section 8",
        gist: "symplectic energy errors stay bounded however long the run",
        stated: "bounded",
        definition: "largest energy error over 10⁶ against 10⁵ steps; speed reached from the \
                     chaotic layer",
        verdict: ReproducedWithDefinition,
        because: "True of small steps. The method is the standard map: beyond K = g Δt²/L = \
                  0.9716, that is 0.3147 s, no curve bars the way of the orbits in the chaotic \
                  sea, while those on islands, such as a swing from 1 rad at K = 3, stay.",
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
        measure: |study| {
            number(row!(study.long_run, StormerVerlet).percent_of_initial(), Significant(5))
        },
    },
    Prose {
        id: "A.rk4_order",
        place: "Abstract",
        gist: "RK4 converges with order",
        stated: "4",
        definition: "slope of the largest error of the state against the exact solution",
        verdict: ReproducedWithDefinition,
        because: "The state has order 4, and the error of a single step order 5. The energy error \
                  that the paper shows falls as Δt⁵, in its range of steps.",
        measure: |study| number(row!(study.characteristics, Rk4).order(), Fixed(2)),
    },
    Prose {
        id: "A.optimal",
        place: "Abstract, Sections 7.4 and 8",
        gist: "Störmer–Verlet is the best choice for long runs",
        stated: "the best",
        definition: "another method's largest energy error over Störmer–Verlet's, in 1000 s from 1 \
                     rad for equal evaluations: of RK4, 4 a step; of Blanes and Moan's method of \
                     order 4, 6 a step",
        verdict: Wrong,
        because: "Of the paper's four it is the best in the energy, for equal work as it is \
                  counted here; by the paper's count, 2 a step, and in equal steps, RK4 is ahead \
                  over this time. Among symplectic methods there are far better ones.",
        measure: |study| {
            let verlet = row!(study.long_run, StormerVerlet).drift;
            let over = |method: &dyn AnyMethod, evaluations: f64| {
                let step = evaluations * long_run::STEP;
                let steps = libm::round(long_run::DURATION / step) as u64;
                findings::energy_drift(method, long_run::THETA_0, step, steps) / verlet
            };
            let (rk4, blanes_moan) = (over(&Rk4, 4.0), over(&BlanesMoan4, 6.0));
            let text = std::format!("{rk4:.1} and {blanes_moan:.4}");
            says(text, rk4 > 1.0 && blanes_moan > 1.0)
        },
    },
    Prose {
        id: "A.guarantees",
        place: "Abstract",
        gist: "Störmer–Verlet has rigorous guarantees of energy conservation",
        stated: "guarantees",
        definition: "whether an orbit of it on the pendulum goes on gaining speed, at K = g Δt²/L \
                     = 1.5, within its limit of stability",
        verdict: Wrong,
        because: "What is guaranteed is the area, and of the energy a bound for steps that are \
                  short enough; how short, the guarantee does not say.",
        measure: |_| says(escape_in_words(1.5), !escapes(1.5)),
    },
    Prose {
        id: "P1.systematic",
        place: "Section 1",
        gist: "standard methods such as forward Euler and Runge–Kutta introduce a systematic drift \
               of the energy",
        stated: "systematic drift",
        definition: "largest energy error in 10⁵ steps of 0.01 s over that in 10⁴, from 1 rad: \
                     forward Euler, RK4, and the Runge–Kutta method of Gauss of order 4",
        verdict: ReproducedWithDefinition,
        because: "True of the two that the paper runs. Gauss's methods are Runge–Kutta methods, \
                  too, and do not drift.",
        measure: |_| {
            static GROWTH: LazyLock<[f64; 3]> = LazyLock::new(|| {
                let methods: [&dyn AnyMethod; 3] = [&ForwardEuler, &Rk4, &Gauss4];
                methods.map(|method| {
                    let drift = |steps| findings::energy_drift(method, 1.0, 0.01, steps);
                    drift(100_000) / drift(10_000)
                })
            });
            let [euler, rk4, gauss] = *GROWTH;
            // A drift grows for as long as there is something to gain or to lose.
            says(std::format!("{euler:.2}, {rk4:.2}, {gauss:.2}"), euler > 1.1 && rk4 > 1.1)
        },
    },
    Prose {
        id: "A.period",
        place: "Abstract, Sections 1 and 8",
        gist: "relative error of the period at 3 rad (%)",
        stated: "0.001",
        definition: "time of the highest sample on the grid, against the elliptic integral",
        verdict: ReproducedWithDefinition,
        because: "Rounded, as here. Read as a bound, 0.001 % is not met. It is the spacing of the \
                  grid; see T7.relerr.",
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
        because: "The error is Δt² (g/L)² (5 + cos θ₀)(1 − cos θ₀)/24, from the modified \
                  Hamiltonian.",
        measure: |study| number(order_range(study, PaperMethod::StormerVerlet).0, Fixed(3)),
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
        id: "P1.orders",
        place: "Section 1",
        gist: "the orders 1, 1, 2, 4 are confirmed",
        stated: "1, 1, 2, 4",
        definition: "slopes of the energy error between neighbouring steps of Table 4, each to ± \
                     0.15",
        verdict: Wrong,
        because: "In the range of Table 4 RK4's slope is 5, as its loss, of order Δt⁵, outweighs \
                  its oscillation, of order Δt⁴; below 0.4 ms it would be 4. Forward Euler's slope \
                  would be 1 in far shorter steps, and is not in the table.",
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
            let ratio = row!(study.long_run, ForwardEuler).drift
                / row!(study.long_run, SymplecticEuler).drift;
            shows(ratio, Scientific(3), ratio > 1e3)
        },
    },
    Prose {
        id: "P1.no_elementary",
        place: "Section 1",
        gist: "the pendulum has no solution in elementary functions",
        stated: "none",
        definition: "third harmonic of the exact motion over the first at 3 rad: a sinusoid has \
                     none",
        verdict: Reproduced,
        because: "The time as a function of the angle is an elliptic integral, which is not \
                  elementary (Liouville), and its inverse, Jacobi's sn, is not either. Only on the \
                  separatrix, and at rest, is the motion elementary.",
        measure: |_| {
            let third = findings::waveform(3.0).1;
            shows(third, Fixed(4), third > 0.1)
        },
    },
    Prose {
        id: "P2.alltime",
        place: "Section 2",
        gist: "of any separable Hamiltonian, energy errors of order Δtᵖ for all time",
        stated: "all time",
        definition: "whether an orbit of Störmer–Verlet on the pendulum goes on gaining speed at K \
                     = g Δt²/L = 1.5; and its energy error at 0.0001 s over that at 0.01 s of a \
                     body that falls into Kepler's centre, where order 2 would give 0.0001",
        verdict: Wrong,
        because: "The theorem (Hairer, Lubich, Wanner, Thm IX.8.1) asks for an analytic \
                  Hamiltonian, an orbit that stays in a compact set, and small steps, and gives \
                  times exponential in 1/Δt. For the pendulum in small steps it is true for all \
                  time, but by invariant curves.",
        measure: |_| {
            let [coarse, fine] = [1e-2, 1e-4].map(findings::energy_error_of_a_fall);
            let text = std::format!("{}; {:.0}", escape_in_words(1.5), fine / coarse);
            says(text, !escapes(1.5))
        },
    },
    Prose {
        id: "P3.eq5",
        place: "Section 3.4",
        gist: "T = 4 √(L/g) K(sin(θ₀/2))",
        stated: "Eq. 5",
        definition: "against the return time of the closed form; the argument of K is the modulus \
                     k, not m = k²",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let start = pendula::Phase::at_rest(2.0);
            let period = exact::period(&Pendulum::PAPER, 2.0).unwrap_or(f64::NAN);
            let motion = pendula::Motion::new(&Pendulum::PAPER, start);
            let back = motion.map_or(f64::NAN, |motion| motion.at(period).theta);
            says("closes the orbit".to_string(), is_near(back, 2.0, 1e-14))
        },
    },
    Prose {
        id: "P3.eq4",
        place: "Section 3.3",
        gist: "θ₀ cos ω₀t solves the linear oscillator",
        stated: "Eq. 4",
        definition: "what is left of θ̈ + (g/L)θ, over (g/L)θ₀, at a hundred moments of 10 s, with \
                     θ̈ by differences over 1 ms",
        verdict: Reproduced,
        because: "It holds for a release from rest only.",
        measure: |_| {
            let (g_over_l, h) = (Pendulum::PAPER.frequency_squared(), 1e-3);
            let frequency = Pendulum::PAPER.small_angle_frequency();
            let theta = |t: f64| pendula::arithmetic::sine::cos(frequency * t);
            let left = (1..=100).map(|n| {
                let t = 0.1 * f64::from(n);
                let second = (theta(t + h) - 2.0 * theta(t) + theta(t - h)) / (h * h);
                (second / g_over_l + theta(t)).abs()
            });
            let largest = left.fold(0.0, f64::max);
            // The differences leave (ω₀h)²/12 = 8e-7, and rounding 2e-16/(ω₀h)² = 2e-11.
            shows(largest, Significant(1), largest < 1e-6)
        },
    },
    Prose {
        id: "P4.rk4_lte",
        place: "Section 4.4",
        gist: "order of RK4's local truncation error",
        stated: "4",
        definition: "slope of the error of a single step, divided by the step",
        verdict: ReproducedWithDefinition,
        because: "Some texts define it so, per unit of time. The error of a single step itself is \
                  of order 5.",
        measure: |_| {
            let slope = findings::one_step_slope(&Rk4) - 1.0;
            shows(slope, Fixed(1), is_near(slope, 4.0, 0.25))
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
        measure: |study| number(row!(study.characteristics, Rk4).evaluations, Fixed(0)),
    },
    Prose {
        id: "P4.vv_evals",
        place: "Sections 4.5 and 8",
        gist: "force evaluations of Störmer–Verlet a step",
        stated: "2",
        definition: "counted",
        verdict: Wrong,
        because: "The method needs one: the force at the end of a step is that at the start of the \
                  next. The paper's own program may well take two.",
        measure: |study| number(row!(study.characteristics, StormerVerlet).evaluations, Fixed(0)),
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
            let defect = row!(study.characteristics, StormerVerlet).area_defect.abs();
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
        because: "The defect is Δt² (g/L) cos θ: area grows below the horizontal and shrinks \
                  above.",
        measure: |study| {
            let defect = row!(study.characteristics, ForwardEuler).area_defect;
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
            let row = row!(study.characteristics, SymplecticEuler);
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
            let quarter = pendula::Phase::at_rest(core::f64::consts::FRAC_PI_2);
            let initial = Pendulum::PAPER.energy_from_pivot(quarter).abs();
            let table = row!(study.long_run, ForwardEuler).percent_of_initial();
            says(
                "zero to rounding".to_string(),
                is_near(initial, 0.0, 1e-14) && prints_as("T5.fe.pct", table),
            )
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
            let over_all = row!(study.small_angle, ForwardEuler).errors[0].formula;
            // 100 steps: the mean over N instead of N + 1 samples.
            let over_steps = over_all * libm::sqrt(101.0 / 100.0);
            let met = [over_all, over_steps].map(|error| prints_as("T6.fe.0.1", error));
            says("N + 1".to_string(), met == [true, false])
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
];

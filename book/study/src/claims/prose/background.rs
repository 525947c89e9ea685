//! Abstract to experimental set-up: Sections 1 to 5 and the tables of parameters.

use super::*;

pub(super) const CLAIMS: &[Prose] = &[
    claim("T1.g", "Table 1", "9.81", Reproduced)
        .gist("g (m/s²)")
        .because("Table 3 has the same.")
        .definition("from the printed energy at the start of the long run, −5.300 J = −m g L cos 1")
        .measured(|_| number(-printed("T5.fe.H0") / cos(long_run::THETA_0), Fixed(2))),
    claim(
        "T1.units_H",
        "Abstract, Section 3.2, Eq. 3, Table 1",
        "Hamiltonian",
        ReproducedWithDefinition,
    )
    .gist("the pendulum is Hamiltonian, with H as a function of θ and ω")
    .because(
        "The momentum conjugate to θ is m L² ω: (θ, ω) are canonical coordinates only where m \
             L² = 1, as in the paper; elsewhere areas scale by m L².",
    )
    .definition(
        "∂H/∂ω over the θ̇ of Eq. 2, and −∂H/∂θ over its ω̇, by differences: of the two, at \
             two states, the further from 1; and of a pendulum of 3 m",
    )
    .measured(|_| {
        let long = Pendulum::new(9.81, 3.0, 1.0).expect("a pendulum");
        let [paper, long] = [Pendulum::PAPER, long].map(|it| hamilton_over_newton(&it));
        says(std::format!("{paper:.4} and {long:.4}"), is_near(paper, 1.0, 1e-6))
    }),
    claim("T3.g", "Table 3", "9.81", Reproduced)
        .gist("gravitational acceleration (m/s²)")
        .definition("from the printed small-angle period, T₀ = 2π √(L/g), with the printed L")
        .measured(|_| number(squared_frequency_of_t_0(), Fixed(3))),
    claim("T3.L", "Table 3", "1.0", Reproduced)
        .gist("length (m)")
        .definition("from the same period, with the printed g")
        .measured(|_| number(9.81 / squared_frequency_of_t_0(), Fixed(3))),
    claim("T3.m", "Table 3", "1.0", Reproduced)
        .gist("mass (kg)")
        .definition(
            "from the printed energy at the start of the long run, −m g L cos 1, with the printed \
             g and L",
        )
        .measured(|_| number(-printed("T5.fe.H0") / (9.81 * cos(long_run::THETA_0)), Fixed(3))),
    claim("T3.omega0", "Table 3", "0.0", Reproduced)
        .gist("initial angular velocity (rad/s)")
        .because("Elsewhere the same symbol means √(g/L).")
        .definition(
            "the same energy at rest, which has to meet it, and at 0.05 rad/s, which must not (J)",
        )
        .measured(|_| {
            let energy = [0.0, 0.05].map(|omega| {
                Pendulum::PAPER.energy_from_pivot(Phase { theta: long_run::THETA_0, omega })
            });
            let text = energy.map(|energy| Fixed(3).print(energy)).join(" and ");
            says(text, energy.map(|energy| prints_as("T5.fe.H0", energy)) == [true, false])
        }),
    claim("A.dts", "Abstract, Section 5.2", "5", Reproduced)
        .gist("number of steps in the ladder")
        .definition(
            "steps of 0.1, 0.05, 0.01, 0.005, 0.001 s at which all four methods meet their cells \
             of Table 6",
        )
        .measured(|study| {
            let met = |step: &usize| study.small_angle.iter().all(|row| meets_table_6(row, *step));
            number((0..STEPS.len()).filter(met).count() as f64, Fixed(0))
        }),
    claim("A.tspan", "Abstract", "1000", Reproduced)
        .gist("duration of the long run (s)")
        .definition("100 000 steps of 0.01 s, after which forward Euler has the printed H")
        .measured(|study| {
            let grid = Grid::with_duration(long_run::STEP, long_run::DURATION);
            let duration = grid.map_or(f64::NAN, |grid| grid.time(grid.steps()));
            let met = prints_as("T5.fe.Hend", row!(study.long_run, ForwardEuler).last);
            shows(duration, Fixed(0), met && duration == 1000.0)
        }),
    claim("A.bounded", "Abstract, Section 1", "bounded", ReproducedWithDefinition)
        .gist("symplectic energy errors stay bounded however long the run")
        .because(
            "True of small steps. The two are the standard map: beyond K = g Δt²/L = 0.9716, that \
             is 0.3147 s, no curve bars the way of the orbits in the chaotic sea, while those on \
             islands, such as a swing from 1 rad at K = 3, stay.",
        )
        .definition(
            "at 0.01 s: largest energy error over 10⁶ against 10⁵ steps; else: speed reached from \
             the chaotic layer",
        )
        .measured(bounded),
    claim("A.verlet_pct", "Abstract, Sections 6.2 and 8, Figure 3", "0.02", Reproduced)
        .gist("energy error of Störmer–Verlet over 1000 s, in per cent of |H(0)|")
        .definition("Table 5")
        .measured(|study| {
            number(row!(study.long_run, StormerVerlet).percent_of_initial(), Significant(5))
        }),
    claim("A.rk4_order", "Abstract, Section 4.4", "4", ReproducedWithDefinition)
        .gist("RK4 converges with order")
        .because(
            "The state has order 4, and the error of a single step order 5. The energy error that \
             the paper shows falls as Δt⁵, in its range of steps.",
        )
        .definition("slope of the largest error of the state against the exact solution, to ± 0.15")
        .measured(|study| {
            let order = row!(study.characteristics, Rk4).order();
            shows(order, Fixed(2), confirms((order, order), 4.0))
        }),
    claim("A.optimal", "Abstract, Sections 7.4 and 8", "the best", Wrong)
        .gist("Störmer–Verlet is the best choice for long runs")
        .because(
            "For equal work it is ahead of RK4 in the energy and behind it in the angle; by the \
             paper's count, 2 a step, and in equal steps, it is behind in both. Among symplectic \
             methods there are far better ones.",
        )
        .definition(
            "another method's largest error over Störmer–Verlet's, in 1000 s from 1 rad for equal \
             evaluations: of RK4, 4 a step, and of Blanes and Moan's method of order 4, 6 a step",
        )
        .measured(|study| {
            static FOUND: LazyLock<[[f64; 2]; 3]> = LazyLock::new(|| {
                let methods: [(&dyn AnyMethod, f64); 3] =
                    [(&StormerVerlet, 1.0), (&Rk4, 4.0), (&BlanesMoan4, 6.0)];
                methods.map(|(method, evaluations)| errors_for_work(method, evaluations))
            });
            let [verlet, others @ ..] = *FOUND;
            let energy =
                others.map(|[energy, _]| energy / row!(study.long_run, StormerVerlet).drift);
            let angle = others.map(|[_, angle]| angle / verlet[1]);
            let [in_energy, in_angle] = [energy, angle]
                .map(|ratios| ratios.map(|ratio| Significant(2).print(ratio)).join(" and "));
            let text = std::format!("in the energy {in_energy}, in the angle {in_angle}");
            says(text, energy.into_iter().chain(angle).all(|ratio| ratio > 1.0))
        }),
    claim("A.guarantees", "Abstract", "guarantees", Wrong)
        .gist("Störmer–Verlet has rigorous guarantees of energy conservation")
        .because(
            "What is guaranteed is the area, and of the energy a bound for steps that are short \
             enough; how short, the guarantee does not say.",
        )
        .definition(
            "whether an orbit of it on the pendulum goes on gaining speed, at K = g Δt²/L = 1.5, \
             within its limit of stability",
        )
        .measured(|_| never_escapes(&StormerVerlet)),
    claim("P1.systematic", "Section 1", "systematic drift", ReproducedWithDefinition)
        .gist(
            "standard methods such as forward Euler and Runge–Kutta introduce a systematic drift \
             of the energy",
        )
        .because(
            "True of the two that the paper runs. Gauss's methods are Runge–Kutta methods, too, \
             and do not drift.",
        )
        .definition(
            "largest energy error in 10⁵ steps of 0.01 s over that in 10⁴, from 1 rad, of forward \
             Euler and RK4: a bounded error has 1, a random walk √10; and of the Runge–Kutta \
             method of Gauss of order 4",
        )
        .measured(|_| {
            static GROWTH: LazyLock<[f64; 3]> = LazyLock::new(|| {
                let methods: [&dyn AnyMethod; 3] = [&ForwardEuler, &Rk4, &Gauss4];
                methods.map(|method| {
                    let drift = |steps| findings::energy_drift(method, 1.0, 0.01, steps);
                    drift(100_000) / drift(10_000)
                })
            });
            let [euler, rk4, gauss] = *GROWTH;
            let is_systematic = |growth: f64| growth > libm::sqrt(10.0);
            let text = std::format!("{euler:.2} and {rk4:.2}; {gauss:.2}");
            says(text, is_systematic(euler) && is_systematic(rk4))
        }),
    claim("P1.qualitative", "Section 1, Figure 4", "qualitatively incorrect", Reproduced)
        .gist("such a drift may make the dynamics qualitatively wrong")
        .definition(
            "forward Euler's energy after 1000 s from 1 rad over that of the pendulum at rest on \
             top, both from the height of the pivot: above 1 a swing has become a rotation",
        )
        .measured(|study| {
            let ratio = row!(study.long_run, ForwardEuler).last / Pendulum::PAPER.depth();
            shows(ratio, Significant(3), ratio > 1.0)
        }),
    claim("A.period", "Abstract, Sections 1 and 8", "0.001", ReproducedWithDefinition)
        .gist("relative error of the period at 3 rad (%)")
        .because(
            "Rounded, as here. Read as a bound, 0.001 % is not met. It is the spacing of the grid; \
             see T7.relerr.",
        )
        .definition("time of the highest sample on the grid, against the elliptic integral")
        .measured(|study| {
            let periods = &study.large_angle;
            number(periods.percent(periods.by_peak), Significant(6))
        }),
    claim("A.dt2", "Abstract, Sections 6.1 and 7.2", "2", Reproduced)
        .gist("power of Δt in Störmer–Verlet's energy error")
        .because(
            "The error is Δt² (g/L)² (5 + cos θ₀)(1 − cos θ₀)/24, from the modified Hamiltonian.",
        )
        .definition("the least slope between neighbouring steps of Table 4, and each to ± 0.15")
        .measured(|study| {
            let range = order_range(study, PaperMethod::StormerVerlet);
            shows(range.0, Fixed(3), confirms(range, 2.0))
        }),
    claim("P1.lines200", "Section 1", "< 200", NotCheckable)
        .gist("the implementation has fewer than 200 lines")
        .because("The code is not supplied, and Section 8 speaks of 300."),
    claim("P1.orders", "Section 1", "1, 1, 2, 4", Wrong)
        .gist("the orders 1, 1, 2, 4 are confirmed")
        .because(
            "In the range of Table 4 RK4's slope is 5, as its loss, of order Δt⁵, outweighs its \
             oscillation, of order Δt⁴; below 0.4 ms it would be 4. Forward Euler's slope would be \
             1 in far shorter steps, and is not in the table.",
        )
        .definition(
            "slopes of the energy error between neighbouring steps of Table 4, each to ± 0.15",
        )
        .measured(orders_confirmed),
    claim("P1.three_orders", "Section 1", "10³", Wrong)
        .gist("symplectic methods conserve energy better by three orders of magnitude")
        .because("It is nearly four and nearly six.")
        .definition(
            "forward Euler's energy error in Table 5 over symplectic Euler's and over \
             Störmer–Verlet's; three orders are 10^2.5 to 10^3.5",
        )
        .measured(|study| {
            let euler = row!(study.long_run, ForwardEuler).drift;
            let ratios = [
                euler / row!(study.long_run, SymplecticEuler).drift,
                euler / row!(study.long_run, StormerVerlet).drift,
            ];
            let text = ratios.map(|ratio| Scientific(3).print(ratio)).join(" and ");
            says(text, ratios.into_iter().all(|ratio| is_near(libm::log10(ratio), 3.0, 0.5)))
        }),
    claim("P1.no_elementary", "Section 1", "none", NotCheckable)
        .gist("the pendulum has no solution in elementary functions")
        .because(
            "A theorem, which no measurement decides: the time as a function of the angle is an \
             elliptic integral, which is not elementary (Liouville), and its inverse, Jacobi's sn, \
             is not either. Only on the separatrix, and at rest, is the motion elementary.",
        ),
    claim("P2.alltime", "Section 2", "all time", Wrong)
        .gist("of any separable Hamiltonian, energy errors of order Δtᵖ for all time")
        .because(
            "The theorem (Hairer, Lubich, Wanner, Thm IX.8.1) asks for an analytic Hamiltonian, an \
             orbit that stays in a compact set, and small steps, and gives times exponential in \
             1/Δt. For the pendulum in small steps it is true for all time, but by invariant \
             curves.",
        )
        .definition(
            "Störmer–Verlet's energy error at 0.0001 s over that at 0.01 s, for a body that falls \
             into Kepler's centre: order 2 would give 0.0001, and at most ten times that is taken \
             for it",
        )
        .measured(|_| {
            let [coarse, fine] = [1e-2, 1e-4].map(findings::energy_error_of_a_fall);
            let ratio = fine / coarse;
            shows(ratio, Fixed(0), ratio < 1e-3)
        }),
    claim("P3.eq1", "Section 3.1", "Eq. 1 and Eq. 2", Reproduced)
        .gist("the pendulum obeys θ̈ + (g/L) sin θ = 0, and as a system of first order")
        .because("Of a rigid rod without mass and a pivot without friction.")
        .definition(
            "what is left of θ̈ + (g/L) sin θ, over g/L, and of θ̇ − ω, over ω₀, along the exact \
             motion from 1 and from 3 rad, at a hundred moments of 10 s each, by differences over \
             1 ms",
        )
        .measured(|_| {
            let left = left_of_the_equations();
            // The differences leave h²/12 of the fourth derivative: 4e-6 at 3 rad.
            shows(left, Significant(1), left < 1e-5)
        }),
    claim("P3.constant", "Section 3.2", "constant", Reproduced)
        .gist("H is a constant of the motion")
        .definition("largest change of H along the same motions, over m g L")
        .measured(|_| {
            let change = change_of_the_energy();
            says(below(1e-13, change), change < 1e-13)
        }),
    claim("P3.eq5", "Section 3.4", "Eq. 5", Reproduced)
        .gist("T = 4 √(L/g) K(sin(θ₀/2)), for arbitrary amplitudes")
        .because("The argument of K is the modulus k, not m = k².")
        .definition(
            "its integral by quadrature, against the period of RK4's run at 1 ms between zeros of \
             θ: largest relative difference from 0.05, 1, 2 and 3 rad",
        )
        .measured(|_| {
            static APART: LazyLock<f64> = LazyLock::new(|| {
                let apart = [0.05, 1.0, 2.0, 3.0].map(|theta_0| {
                    (period_of_a_run(theta_0) / period_of_eq_5(theta_0) - 1.0).abs()
                });
                apart.into_iter().fold(0.0, libm::fmaximum)
            });
            says(below(1e-10, *APART), *APART < 1e-10)
        }),
    claim("P3.eq4", "Section 3.3", "Eq. 4", Reproduced)
        .gist("θ₀ cos ω₀t solves the linear oscillator")
        .because("It holds for a release from rest only.")
        .definition(
            "what is left of θ̈ + (g/L)θ, over (g/L)θ₀, at a hundred moments of 10 s, with θ̈ by \
             differences over 1 ms",
        )
        .measured(|_| {
            let (g_over_l, h) = (Pendulum::PAPER.frequency_squared(), 1e-3);
            let frequency = Pendulum::PAPER.small_angle_frequency();
            let theta = |t: f64| cos(frequency * t);
            let left = (1..=100).map(|n| {
                let t = 0.1 * f64::from(n);
                let second = (theta(t + h) - 2.0 * theta(t) + theta(t - h)) / (h * h);
                (second / g_over_l + theta(t)).abs()
            });
            let largest = left.fold(0.0, f64::max);
            // The differences leave (ω₀h)²/12 = 8e-7, and rounding 2e-16/(ω₀h)² = 2e-11.
            shows(largest, Significant(1), largest < 1e-6)
        }),
    claim("P4.identical", "Section 4", "identical conditions", ReproducedWithDefinition)
        .gist("the four are compared directly, under identical conditions")
        .because("Where they are shown: RK4 is left out of the long run.")
        .definition("methods in Tables 4, 5, 6 and 8, each with the same columns")
        .measured(|_| {
            let shown = ["T4.", "T5.", "T6.", "T8."].map(columns_of_methods);
            let alike = |columns: &Vec<Vec<&str>>| columns.windows(2).all(|two| two[0] == two[1]);
            let counts = shown.each_ref().map(|columns| columns.len().to_string()).join(", ");
            says(counts, shown.iter().all(alike))
        }),
    claim("P4.rk4_lte", "Section 4.4", "4", ReproducedWithDefinition)
        .gist("order of RK4's local truncation error")
        .because(
            "Some texts define it so, per unit of time. The error of a single step itself is of \
             order 5.",
        )
        .definition("slope of the error of a single step, divided by the step")
        .measured(|_| {
            let slope = findings::one_step_slope(&Rk4) - 1.0;
            shows(slope, Fixed(1), is_near(slope, 4.0, 0.15))
        }),
    claim("P4.rk4_evals", "Section 4.4", "4", Reproduced)
        .gist("force evaluations of RK4 a step")
        .definition("counted")
        .measured(|study| number(row!(study.characteristics, Rk4).evaluations, Fixed(0))),
    claim("P4.rk4_alg", "Section 4.4, Algorithm 1", "classical RK4", Reproduced)
        .gist("Algorithm 1 is a step of the classical RK4")
        .definition("cells of RK4 in Table 4, down to 0.005 s, that its seven lines meet")
        .measured(|_| {
            let steps = &STEPS[..4];
            let met = |step: &&f64| {
                prints_as(&std::format!("T4.rk4.{step}"), energy_error_of_algorithm_1(**step))
            };
            let count = steps.iter().filter(met).count();
            says(std::format!("{count} of {}", steps.len()), count == steps.len())
        }),
    claim("P4.vv_evals", "Sections 4.5, 7.4 and 8", "2", Wrong)
        .gist("force evaluations of Störmer–Verlet a step")
        .because(
            "The method needs one: the force at the end of a step is that at the start of the \
             next. The paper's own program may well take two.",
        )
        .definition("counted")
        .measured(|study| number(row!(study.characteristics, StormerVerlet).evaluations, Fixed(0))),
    claim("P4.vv_twoform", "Sections 4.5, 7.4 and 8", "exactly", Reproduced)
        .gist("Störmer–Verlet preserves the symplectic form")
        .definition(
            "largest |det J − 1| of one step of 0.1, 0.2 and 0.4 s from five states of two \
             pendulums each, the longer ones over the square of their ratio to the first: within \
             the error of the difference quotient",
        )
        .measured(|_| {
            let defects = [1.0, 2.0, 4.0].into_iter().flat_map(|ratio: f64| {
                let h = ratio * AREA_STEP;
                cases().map(move |(pendulum, z)| {
                    area_defect(&StormerVerlet, &pendulum, z, h).abs() / (ratio * ratio)
                })
            });
            let largest = defects.fold(0.0, libm::fmaximum);
            says(below(AREA_TOLERANCE, largest), largest < AREA_TOLERANCE)
        }),
    claim("P4.vv_half", "Section 4.5", "a half-step velocity update", ReproducedWithDefinition)
        .gist("Störmer–Verlet by Eqs. 10 to 12 uses half-step velocities")
        .because(
            "The equations have no velocity at half a step, and give the same motion to rounding.",
        )
        .definition(
            "largest difference, in angle (rad) or velocity (rad/s), of a run by these equations \
             from one by half kicks: Table 4's, at 0.01 s",
        )
        .measured(|_| {
            static APART: LazyLock<f64> = LazyLock::new(equations_10_to_12_from_half_kicks);
            says(below(1e-11, *APART), *APART < 1e-11)
        }),
    claim("P4.fe_nonsymp", "Section 4.2", "not symplectic", Reproduced)
        .gist("forward Euler is not symplectic")
        .because(
            "The defect is Δt² (g/L) cos θ: area grows below the horizontal and shrinks above.",
        )
        .definition("det J − 1 of one step of 0.1 s at 1 rad")
        .measured(|study| {
            let defect = row!(study.characteristics, ForwardEuler).area_defect;
            shows(defect, Fixed(5), defect.abs() > AREA_TOLERANCE)
        }),
    claim("P4.se_change", "Section 4.3", "symplectic", Reproduced)
        .gist("the new velocity makes Euler's method symplectic")
        .definition(
            "|det J − 1| of one step of 0.1 s at 1 rad, with the new velocity and with the old",
        )
        .measured(|study| {
            let new = row!(study.characteristics, SymplecticEuler);
            let old = row!(study.characteristics, ForwardEuler);
            let [a, b] = [new, old].map(|row| Fixed(5).print(row.area_defect.abs()));
            says(std::format!("{a} and {b}"), new.symplectic() && !old.symplectic())
        }),
    claim("P4.se_symp", "Section 4.3", "ensures", Wrong)
        .gist("that it is symplectic ensures symplectic Euler a bounded energy error")
        .because(
            "In steps that are short enough it has one: A.bounded. That it is symplectic does not \
             ensure it.",
        )
        .definition("as P7.4.guaranteed")
        .measured(|_| never_escapes(&SymplecticEuler)),
    claim("P5.metric_pct", "Section 5.3", "per cent of the start", Reproduced)
        .gist("energy errors are given in per cent of |H(0)|")
        .because(
            "|H(0)| depends on where the potential is said to be zero: after a release from π/2 \
             every error would be infinite.",
        )
        .definition("with it, the three percentages of Table 5")
        .measured(|study| {
            let rows = [
                ("T5.fe.pct", row!(study.long_run, ForwardEuler).percent_of_initial()),
                ("T5.se.pct", row!(study.long_run, SymplecticEuler).percent_of_initial()),
                ("T5.vv.pct", row!(study.long_run, StormerVerlet).percent_of_initial()),
            ];
            let text = rows.map(|(_, percent)| Significant(5).print(percent)).join(", ");
            says(text, rows.into_iter().all(|(cell, percent)| prints_as(cell, percent)))
        }),
    claim("P5.metric_rms", "Section 5.3", "N", ReproducedWithDefinition)
        .gist("the mean of the RMS error runs over N samples")
        .because("The paper does not say which.")
        .definition(
            "cells of Table 6 that are met where N counts all samples, the start included; and \
             where it counts the steps",
        )
        .measured(|study| {
            let cells =
                || study.small_angle.iter().flat_map(|row| (0..STEPS.len()).map(move |i| (row, i)));
            let over_samples = cells().filter(|(row, step)| meets_table_6(row, *step)).count();
            let over_steps = cells().filter(|(row, step)| {
                let steps = small_angle::DURATION / STEPS[*step];
                let error = row.errors[*step].formula * libm::sqrt((steps + 1.0) / steps);
                prints_as(&cell_of_table_6(row, *step), error)
            });
            let text = std::format!("{over_samples} and {} of 20", over_steps.count());
            says(text, over_samples == 20)
        }),
    claim("P5.core", "Section 5.4", "environment", NotCheckable)
        .gist("one core, Python with NumPy and SciPy")
        .because("Neither machine nor versions are recorded."),
];

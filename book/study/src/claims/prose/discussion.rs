//! Discussion and conclusion, Sections 7 and 8; the figures; and what the numbers decide where the
//! text leaves it open.

use super::*;

pub(super) const CLAIMS: &[Prose] = &[
    claim("P8.lines300", "Section 8", "< 300", NotCheckable)
        .gist("everything comes from fewer than 300 lines")
        .because("The code is not supplied, and Section 1 speaks of 200."),
    claim("P7.1.kin", "Sections 6.2 and 7.1", "beyond any bound", ReproducedWithDefinition)
        .gist("forward Euler's kinetic energy far exceeds any physical bound")
        .because("The bound is that of the conserved energy.")
        .definition(
            "at the end of the long run, over m g L (1 − cos θ₀), all that a swing from 1 rad can \
             have",
        )
        .measured(|study| {
            let omega = row!(study.long_run, ForwardEuler).end.omega;
            let all = Pendulum::PAPER.energy(pendula::Phase::at_rest(long_run::THETA_0));
            let ratio = 0.5 * omega * omega / all;
            shows(ratio, Fixed(0), ratio > 10.0)
        }),
    claim("P7.1.surface", "Section 7.1", "true surface", Wrong)
        .gist("the symplectic methods stay on the true energy surface")
        .because("They stay on the surface of a modified energy.")
        .definition(
            "H after 1000 s of symplectic Euler and of Störmer–Verlet, and at the start (J), with \
             the three decimals of Table 5",
        )
        .measured(|study| {
            let runs = [row!(study.long_run, SymplecticEuler), row!(study.long_run, StormerVerlet)];
            let [euler, verlet] = runs.map(|run| Fixed(3).print(run.last));
            let start = Fixed(3).print(runs[0].initial);
            let met = euler == start && verlet == start;
            says(std::format!("{euler} and {verlet}; {start}"), met)
        }),
    claim("P7.1.modest", "Section 7.1", "meaningless", ReproducedWithDefinition)
        .gist("over 10⁹ steps even a modest drift makes a simulation meaningless")
        .because(
            "In long steps: what a step loses goes as its sixth power. At the paper's own step RK4 \
             would still err less than symplectic Euler. And not of every method that is not \
             symplectic: a discrete gradient loses nothing.",
        )
        .definition(
            "the energy that RK4 loses from 1 rad over the largest energy error of symplectic \
             Euler: at 0.1 s already after 10⁶ steps; at 0.01 s after 10⁹, in proportion to 10⁶",
        )
        .measured(|_| {
            static LOST: LazyLock<[f64; 2]> = LazyLock::new(|| {
                let start = Pendulum::PAPER.energy(Phase::at_rest(1.0));
                [(0.1, 1.0), (0.01, 1e3)].map(|(step, times)| {
                    let lost = start - findings::last_energy(&Rk4, 1.0, step, 1_000_000);
                    times * lost / findings::energy_drift(&SymplecticEuler, 1.0, step, 100_000)
                })
            });
            let [coarse, fine] = *LOST;
            says(std::format!("{coarse:.1} and {fine:.2}"), coarse > 1.0)
        }),
    claim("P7.1.construction", "Section 7.1", "by construction", Wrong)
        .gist("symplectic methods are qualitatively right by construction")
        .because(
            "By construction they keep areas. In small steps the motion is qualitatively right; at \
             K = 1.5 the pendulum that should hang on the edge gains and loses turns at random.",
        )
        .definition("Störmer–Verlet from beside the upper equilibrium at K = g Δt²/L = 0.1 and 1.5")
        .measured(|_| {
            let found = [0.1, 1.5].map(|k| escapes(&StormerVerlet, k));
            let text = found.map(|escapes| if escapes { "wanders off" } else { "stays" });
            says(text.join(" and "), found == [false, false])
        }),
    claim("P7.1.md", "Section 7.1", "10⁹", NotCheckable)
        .gist("molecular dynamics takes a thousand million steps")
        .because("A statement about other work."),
    claim("P7.1.fe1000", "Abstract, Sections 6.2, 7.1 and 8, Figure 3", "9090", Reproduced)
        .gist("forward Euler's energy error over 1000 s (%)")
        .definition("Table 5")
        .measured(|study| {
            number(row!(study.long_run, ForwardEuler).percent_of_initial(), Significant(5))
        }),
    claim("P7.2.precise", "Section 7.2", "1, 1, 2, 4", Wrong)
        .gist("the orders match theory precisely")
        .because("Only symplectic Euler and Störmer–Verlet do.")
        .definition("as P1.orders")
        .measured(orders_confirmed),
    claim("P7.2.accuracy", "Section 7.2", "effectively conserved", Reproduced)
        .gist("over short times a method of high order conserves energy through sheer accuracy")
        .definition(
            "RK4's largest energy error over 50 s at 0.001 s, over that of Störmer–Verlet, which \
             conserves by its structure",
        )
        .measured(|study| {
            let [rk4, verlet] = [
                row!(study.convergence, Rk4).drift[4],
                row!(study.convergence, StormerVerlet).drift[4],
            ];
            shows(rk4 / verlet, Scientific(1), rk4 < verlet)
        }),
    claim("P7.2.independent", "Section 7.2", "independent", NotCheckable)
        .gist(
            "the ratio 3.99 is an independent numerical verification of the theoretical framework",
        )
        .because(
            "It agrees with one prediction of one method, made from the theory that it would \
             verify; whether that is called independent is no matter of measurement.",
        ),
    claim("P7.3.all", "Section 7.3", "all", Wrong)
        .gist("in the study all methods converge to a common floor")
        .because(
            "The study does not show it: at its finest step forward Euler is ten times above the \
             floor, and symplectic Euler below it. In the limit it is so.",
        )
        .definition(
            "forward Euler's and symplectic Euler's error over the formula's, at 0.001 s, the \
             finest step of the study, and at 0.00001 s; at the former, within a tenth of 1",
        )
        .measured(|study| {
            let coarse = [
                row!(study.small_angle, ForwardEuler).errors[4].formula,
                row!(study.small_angle, SymplecticEuler).errors[4].formula,
            ];
            static FINE: LazyLock<[f64; 2]> = LazyLock::new(|| {
                let methods: [&dyn AnyMethod; 2] = [&ForwardEuler, &SymplecticEuler];
                methods.map(|method| {
                    let theta_0 = small_angle::THETA_0;
                    findings::normalised_formula_error(method, theta_0, 1e-5).1 * theta_0
                })
            });
            let [[a, b], [c, d]] = [coarse, *FINE].map(|errors| errors.map(|error| error / *FLOOR));
            let there = is_near(a, 1.0, 0.1) && is_near(b, 1.0, 0.1);
            says(std::format!("{a:.1} and {b:.2}; {c:.3} and {d:.3}"), there)
        }),
    claim("P7.4.se", "Section 7.4", "1", ReproducedWithDefinition)
        .gist("symplectic Euler is the cheapest: evaluations a step")
        .because(
            "So are forward Euler, whose printed time is shorter, and Störmer–Verlet, which is the \
             same method seen half a kick later.",
        )
        .definition("counted, and of the other three none has fewer")
        .measured(|study| {
            let own = row!(study.characteristics, SymplecticEuler).evaluations;
            let rows = study.characteristics.iter();
            let least = rows.filter(|row| PaperMethod::of(row.method).is_some());
            let cheapest = least.fold(f64::INFINITY, |least, row| least.min(row.evaluations));
            shows(own, Fixed(0), own == 1.0 && own <= cheapest)
        }),
    claim("P7.4.guaranteed", "Section 7.4", "guaranteed", Wrong)
        .gist("symplectic Euler has a guaranteed bound of its energy")
        .because("As A.guarantees: it is the same orbit, seen from half a kick away.")
        .definition(
            "whether an orbit of it goes on gaining speed, at K = g Δt²/L = 1.5, within its limit \
             of stability",
        )
        .measured(|_| never_escapes(&SymplecticEuler)),
    claim("P7.4.adequate", "Section 7.4", "adequate", NotCheckable)
        .gist("symplectic Euler's accuracy is adequate for interactive use")
        .because("A recommendation; the paper does not say what interactive use needs."),
    claim("P7.4.rk4", "Abstract, Section 7.4", "RK4", Reproduced)
        .gist("RK4 has the smallest error a step")
        .definition(
            "its error of a single step over the smallest of the other three's: the largest of \
             four states, each in steps of 0.1, 0.01 and 0.001 s",
        )
        .measured(|_| {
            static LARGEST: LazyLock<f64> = LazyLock::new(rk4_over_the_next_in_a_step);
            shows(*LARGEST, Significant(1), *LARGEST < 1.0)
        }),
    claim("P7.4.caveat", "Section 7.4", "must", Reproduced)
        .gist("with RK4 the drift of the energy over long times must be watched")
        .because("It grows with time.")
        .definition(
            "its largest energy error in 1000 s from 1 rad in steps of 0.01 s over that in 100 s",
        )
        .measured(|_| {
            let drift = |steps| findings::energy_drift(&Rk4, 1.0, 0.01, steps);
            let ratio = drift(100_000) / drift(10_000);
            shows(ratio, Fixed(2), ratio > 5.0)
        }),
    claim("P7.4.fe", "Section 7.4", "never", NotCheckable)
        .gist(
            "forward Euler should never be used for production simulations of Hamiltonian systems",
        )
        .because("A recommendation. The reason that it gives, monotonic growth, is P6.2.mono."),
    claim("P7.5.dissipation", "Section 7.5", "may alter", Reproduced)
        .gist("dissipation and driving may alter the merits of symplectic methods")
        .definition(
            "of the two, friction: Störmer–Verlet's RMS angle error over RK4's for 400 evaluations \
             each, from 1 rad over 10 s, without it, and with a rate β of 0.2/s; they are to \
             differ by more than a tenth",
        )
        .measured(|_| {
            let [free, damped] = findings::verlet_over_rk4_damped();
            let differs = !is_near(damped / free, 1.0, 0.1);
            says(std::format!("{free:.1} and {damped:.1}"), differs)
        }),
    claim("P7.5.python", "Section 7.5", "may differ", DependsOnPlatform)
        .gist("the times are those of Python loops, and compiled programs may compare otherwise")
        .because("Said fairly; it holds of every time in Table 8 and Figure 7."),
    claim("P7.5.adaptive", "Section 7.5", "none", Reproduced)
        .gist("the study has no adaptive methods")
        .because("The paper's own account of its scope.")
        .definition(
            "of the numbers of Tables 4 to 8 that are no property of a machine, those that fixed \
             steps meet, as the cells are judged",
        )
        .measured(|_| {
            let cells = || {
                let cells = CELLS.iter().filter(|cell| !cell.id.starts_with("T2."));
                cells.filter(|cell| cell.verdict != DependsOnPlatform)
            };
            let met = cells().filter(|cell| cell.verdict.demands() == Some(true)).count();
            says(std::format!("{met} of {}", cells().count()), met == cells().count())
        }),
    claim("P7.5.superior", "Section 7.5", "can", Reproduced)
        .gist("adaptive steps can be more accurate for the same budget")
        .because(
            "Where the motion has more than one pace. A swing of the pendulum has not, or not \
             enough to pay for a control.",
        )
        .definition(
            "the error of Dormand and Prince's method in steps that it chooses over that in equal \
             steps, for equal evaluations: the pendulum from 1 rad, an ellipse of eccentricity \
             0.9; one of them below 1",
        )
        .measured(|_| {
            let ratios = findings::adaptive_over_fixed();
            let text = ratios.map(|ratio| Significant(1).print(ratio)).join(" and ");
            says(text, ratios.into_iter().any(|ratio| ratio < 1.0))
        }),
    claim("P7.5.primary", "Section 7.5", "may tell more", Reproduced)
        .gist("energy is the primary measure; other invariants, such as area, may tell more")
        .because("It tells the two apart at the first step.")
        .definition("|det J − 1| of forward and of symplectic Euler, which converge alike")
        .measured(|study| {
            let euler = row!(study.characteristics, ForwardEuler);
            let symplectic = row!(study.characteristics, SymplecticEuler);
            let [a, b] = [euler, symplectic].map(|row| Fixed(5).print(row.area_defect.abs()));
            says(std::format!("{a} and {b}"), !euler.symplectic() && symplectic.symplectic())
        }),
    claim("P8.order", "Section 8", "1, 1, 2, 4", Wrong)
        .gist("the orders match theory precisely")
        .because("See P1.orders.")
        .definition("as P1.orders")
        .measured(orders_confirmed),
    claim("P8.validates", "Section 8", "validates", ReproducedWithDefinition)
        .gist("that RK4's period is right to 0.001 % validates the integrator's accuracy")
        .because("To the spacing of the grid, as methods of order 2 and 1 would be, too.")
        .definition(
            "RK4's period, read as the paper does, from the exact one, no further than half a \
             step, which is all that the reading tells; and that of Störmer–Verlet and of \
             symplectic Euler, read in the same way (ms)",
        )
        .measured(|study| {
            static OTHERS: LazyLock<[f64; 2]> = LazyLock::new(|| {
                let methods: [&dyn AnyMethod; 2] = [&StormerVerlet, &SymplecticEuler];
                methods.map(large_angle::period_by_peak)
            });
            let away = |period: f64| (period - study.large_angle.exact).abs();
            let ms = |period| std::format!("{:.3}", 1e3 * away(period));
            let rk4 = study.large_angle.by_peak;
            let [vv, se] = OTHERS.map(ms);
            let text = std::format!("{}; {vv} and {se}", ms(rk4));
            says(text, away(rk4) <= 0.5 * large_angle::STEP)
        }),
    claim("P8.equations", "Section 8", "validates", ReproducedWithDefinition)
        .gist("that it is right to 0.001 % validates the equations of motion")
        .because(
            "Those of the program, against Eq. 5, which has the same origin: of a real pendulum it \
             says nothing.",
        )
        .definition("how far the period would be off with θ for sin θ, and with g = 9.80 m/s² (%)")
        .measured(|study| {
            let slow = Pendulum::new(9.80, 1.0, 1.0).expect("a pendulum");
            let slow = exact::period(&slow, large_angle::THETA_0).unwrap_or(f64::NAN);
            let periods = &study.large_angle;
            let off = [periods.small_angle, slow].map(|period| periods.percent(period));
            let text = off.map(|percent| Significant(2).print(percent)).join(" and ");
            says(text, off.into_iter().all(|percent| percent > 0.001))
        }),
    claim("P8.reproducible", "Section 8", "all", Wrong)
        .gist("all results are reproducible")
        .because(
            "Not the times, which are those of one machine, nor a cell that is rounding, nor two \
             entries of Table 2. All others are.",
        )
        .definition(
            "cells of Tables 2 and 4 to 8 whose printed digits or words are met, as they are \
             judged",
        )
        .measured(|_| {
            let met = CELLS.iter().filter(|cell| cell.verdict.demands() == Some(true)).count();
            says(std::format!("{met} of {}", CELLS.len()), met == CELLS.len())
        }),
    claim("P8.yoshida", "Section 8", "a higher-order symplectic method", Reproduced)
        .gist("Yoshida's scheme is symplectic and of higher order")
        .definition(
            "slope of the largest error of the state, and |det J − 1| of a step of 0.1 s; it is \
             Forest and Ruth's method",
        )
        .measured(|_| {
            static FOUND: LazyLock<(f64, f64)> = LazyLock::new(|| {
                let slope = Ladder::measure(&ForestRuth).slopes().last().unwrap_or(f64::NAN);
                let z = Phase { theta: 1.0, omega: 0.5 };
                (slope, area_defect(&ForestRuth, &Pendulum::PAPER, z, AREA_STEP).abs())
            });
            let (slope, defect) = *FOUND;
            let text = std::format!("{slope:.2}; {}", below(AREA_TOLERANCE, defect));
            says(text, confirms((slope, slope), 4.0) && defect < AREA_TOLERANCE)
        }),
    claim("P8.bounded", "Section 8", "bounded", ReproducedWithDefinition)
        .gist("symplectic energy errors stay bounded however long the run")
        .because("See A.bounded.")
        .definition("as A.bounded")
        .measured(bounded),
    claim("F1", "Section 4.1, Figure 1", "a diagram", NotCheckable)
        .gist("the architecture is modular")
        .because("The picture is missing from the text."),
    claim("F4", "Figure 4", "growing amplitude", ReproducedWithDefinition)
        .gist("forward Euler's amplitude grows, at 0.01 s")
        .because("The figure names neither amplitude nor duration.")
        .definition(
            "in 10 s from 0.05 rad, as in Table 6: its last turning point over its first, and each \
             beyond the one before",
        )
        .measured(|_| {
            let turns = turning_points_of_figure_4();
            let (first, last) = (turns[0].1.abs(), turns[turns.len() - 1].1.abs());
            let grows = turns.windows(2).all(|two| two[0].1.abs() < two[1].1.abs());
            shows(last / first, Fixed(2), turns.len() > 2 && grows)
        }),
    claim("F4b", "Figure 4", "upward", Wrong)
        .gist("an upward drift of the energy is characteristic of a non-symplectic method")
        .because(
            "RK4, not symplectic either, loses energy. That forward Euler's rises without a fall \
             is so for as long as it swings: X.fe.first_fall.",
        )
        .definition("H(1000) − H(0) of forward Euler and of RK4 in the long run (J)")
        .measured(|study| {
            let gained = [row!(study.long_run, ForwardEuler), row!(study.long_run, Rk4)]
                .map(|run| run.last - run.initial);
            let text = gained.map(|gained| Significant(2).print(gained)).join(" and ");
            says(text, gained.into_iter().all(|gained| gained > 0.0))
        }),
    claim("F4c", "Figure 4", "corresponds", ReproducedWithDefinition)
        .gist("the growth of the amplitude corresponds directly to the drift of the energy")
        .because("On the parameters of Table 6.")
        .definition(
            "m g L (cos θ₀ − cos θ) at the last turning point θ of the same run over the energy \
             gained by then, to a hundredth",
        )
        .measured(|_| {
            let turns = turning_points_of_figure_4();
            let (gained, theta) = turns[turns.len() - 1];
            let depth = Pendulum::PAPER.depth();
            let ratio = depth * (cos(small_angle::THETA_0) - cos(theta)) / gained;
            shows(ratio, Fixed(3), is_near(ratio, 1.0, 0.01))
        }),
    claim("F7", "Figure 7", "a curve", DependsOnPlatform)
        .gist("error against wall time")
        .because("Only the times at 0.01 s are tabulated, and they are those of one machine."),
    claim("X.order_variant", "Section 4.3", "kick, then drift", ReproducedWithDefinition)
        .gist("symplectic Euler kicks first, as in Eqs. 8 and 9")
        .because("The numbers are those of the equations.")
        .definition(
            "Table 6 at 0.1 s by kick-drift, which has to meet the cell, and by drift-kick, which \
             must not (rad)",
        )
        .measured(|_| {
            let methods: [&dyn AnyMethod; 2] = [&SymplecticEuler, &DriftKick];
            let errors = methods.map(|method| {
                findings::normalised_formula_error(method, 0.05, 0.1).1 * small_angle::THETA_0
            });
            let met = errors.map(|error| prints_as("T6.se.0.1", error));
            let text = errors.map(|error| Scientific(3).print(error)).join(" and ");
            says(text, met == [true, false])
        }),
    claim("X.verlet_variant", "Section 4.5", "kick, drift, kick", ReproducedWithDefinition)
        .gist("Störmer–Verlet in velocity form, as in Eqs. 10 to 12")
        .because("The numbers are those of the equations.")
        .definition(
            "Table 4 at 0.1 s by kick-drift-kick, which has to meet the cell, and by \
             drift-kick-drift, which must not (J)",
        )
        .measured(|_| {
            let methods: [&dyn AnyMethod; 2] = [&StormerVerlet, &PositionVerlet];
            let drifts = methods.map(|method| convergence::drift(method, 0.1));
            let met = drifts.map(|drift| prints_as("T4.vv.0.1", drift));
            let text = drifts.map(|drift| Scientific(3).print(drift)).join(" and ");
            says(text, met == [true, false])
        }),
    claim("X.bold", "Table 6", "as printed", Reproduced)
        .gist("the best at each step, which the text does not show in bold")
        .because(
            "The last three win by cancelling the formula's error; against the exact solution RK4 \
             is ahead at every step.",
        )
        .definition("the least of each column, by the measured and by the printed numbers")
        .measured(|study| {
            let best = |step: usize, error: &dyn Fn(&small_angle::Row) -> f64| {
                let rows = study.small_angle.iter();
                let best = rows.min_by(|a, b| error(a).total_cmp(&error(b)));
                (step, best.map_or("", |row| row.method.info().title))
            };
            let columns = || 0..STEPS.len();
            let found: Vec<_> =
                columns().map(|step| best(step, &|row| row.errors[step].formula)).collect();
            let stated: Vec<_> = columns()
                .map(|step| best(step, &|row| printed(&cell_of_table_6(row, step))))
                .collect();
            let titles: Vec<&str> = found.iter().map(|(_, title)| *title).collect();
            says(titles.join(", "), found == stated)
        }),
];

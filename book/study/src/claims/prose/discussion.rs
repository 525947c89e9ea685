//! Discussion and conclusion, Sections 7 and 8; the figures; and what the numbers decide where the
//! text leaves it open.

use super::*;

pub(super) const CLAIMS: &[Prose] = &[
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
        id: "P7.1.kin",
        place: "Sections 6.2 and 7.1",
        gist: "forward Euler's kinetic energy far exceeds any physical bound",
        stated: "beyond any bound",
        definition: "at the end of the long run, over m g L (1 − cos θ₀), all that a swing from 1 \
                     rad can have",
        verdict: ReproducedWithDefinition,
        because: "The bound is that of the conserved energy.",
        measure: |study| {
            let omega = row!(study.long_run, ForwardEuler).end.omega;
            let all = Pendulum::PAPER.energy(pendula::Phase::at_rest(long_run::THETA_0));
            let ratio = 0.5 * omega * omega / all;
            shows(ratio, Fixed(0), ratio > 10.0)
        },
    },
    Prose {
        id: "P7.1.surface",
        place: "Section 7.1",
        gist: "the symplectic methods stay on the true energy surface",
        stated: "true surface",
        definition: "H after 1000 s of symplectic Euler and of Störmer–Verlet, and at the start \
                     (J), with the three decimals of Table 5",
        verdict: Wrong,
        because: "They stay on the surface of a modified energy.",
        measure: |study| {
            let runs = [row!(study.long_run, SymplecticEuler), row!(study.long_run, StormerVerlet)];
            let [euler, verlet] = runs.map(|run| Fixed(3).print(run.last));
            let start = Fixed(3).print(runs[0].initial);
            let met = euler == start && verlet == start;
            says(std::format!("{euler} and {verlet}; {start}"), met)
        },
    },
    Prose {
        id: "P7.1.modest",
        place: "Section 7.1",
        gist: "over 10⁹ steps even a modest drift makes a simulation meaningless",
        stated: "meaningless",
        definition: "the energy that RK4 loses from 1 rad over the largest energy error of \
                     symplectic Euler: at 0.1 s already after 10⁶ steps; at 0.01 s after 10⁹, in \
                     proportion to 10⁶",
        verdict: ReproducedWithDefinition,
        because: "In long steps: what a step loses goes as its sixth power. At the paper's own \
                  step RK4 would still err less than symplectic Euler. And not of every method \
                  that is not symplectic: a discrete gradient loses nothing.",
        measure: |_| {
            static LOST: LazyLock<[f64; 2]> = LazyLock::new(|| {
                let start = Pendulum::PAPER.energy(Phase::at_rest(1.0));
                [(0.1, 1.0), (0.01, 1e3)].map(|(step, times)| {
                    let lost = start - findings::last_energy(&Rk4, 1.0, step, 1_000_000);
                    times * lost / findings::energy_drift(&SymplecticEuler, 1.0, step, 100_000)
                })
            });
            let [coarse, fine] = *LOST;
            says(std::format!("{coarse:.1} and {fine:.2}"), coarse > 1.0)
        },
    },
    Prose {
        id: "P7.1.construction",
        place: "Section 7.1",
        gist: "symplectic methods are qualitatively right by construction",
        stated: "by construction",
        definition: "Störmer–Verlet from beside the upper equilibrium at K = g Δt²/L = 0.1 and 1.5",
        verdict: Wrong,
        because: "By construction they keep areas. In small steps the motion is qualitatively \
                  right; at K = 1.5 the pendulum that should hang on the edge gains and loses \
                  turns at random.",
        measure: |_| {
            let found = [0.1, 1.5].map(|k| escapes(&StormerVerlet, k));
            let text = found.map(|escapes| if escapes { "wanders off" } else { "stays" });
            says(text.join(" and "), found == [false, false])
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
        place: "Abstract, Sections 6.2, 7.1 and 8, Figure 3",
        gist: "forward Euler's energy error over 1000 s (%)",
        stated: "9090",
        definition: "Table 5",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            number(row!(study.long_run, ForwardEuler).percent_of_initial(), Significant(5))
        },
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
        id: "P7.2.accuracy",
        place: "Section 7.2",
        gist: "over short times a method of high order conserves energy through sheer accuracy",
        stated: "effectively conserved",
        definition: "RK4's largest energy error over 50 s at 0.001 s, over that of Störmer–Verlet, \
                     which conserves by its structure",
        verdict: Reproduced,
        because: "",
        measure: |study| {
            let [rk4, verlet] = [
                row!(study.convergence, Rk4).drift[4],
                row!(study.convergence, StormerVerlet).drift[4],
            ];
            shows(rk4 / verlet, Scientific(1), rk4 < verlet)
        },
    },
    Prose {
        id: "P7.2.independent",
        place: "Section 7.2",
        gist: "the ratio 3.99 is an independent numerical verification of the theoretical \
               framework",
        stated: "independent",
        definition: "",
        verdict: NotCheckable,
        because: "It agrees with one prediction of one method, made from the theory that it would \
                  verify; whether that is called independent is no matter of measurement.",
        measure: nothing,
    },
    Prose {
        id: "P7.3.all",
        place: "Section 7.3",
        gist: "in the study all methods converge to a common floor",
        stated: "all",
        definition: "forward Euler's and symplectic Euler's error over the formula's, at 0.001 s, \
                     the finest step of the study, and at 0.00001 s; at the former, within a tenth \
                     of 1",
        verdict: Wrong,
        because: "The study does not show it: at its finest step forward Euler is ten times above \
                  the floor, and symplectic Euler below it. In the limit it is so.",
        measure: |study| {
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
        },
    },
    Prose {
        id: "P7.4.se",
        place: "Section 7.4",
        gist: "symplectic Euler is the cheapest: evaluations a step",
        stated: "1",
        definition: "counted, and of the other three none has fewer",
        verdict: ReproducedWithDefinition,
        because: "So are forward Euler, whose printed time is shorter, and Störmer–Verlet, which \
                  is the same method seen half a kick later.",
        measure: |study| {
            let own = row!(study.characteristics, SymplecticEuler).evaluations;
            let rows = study.characteristics.iter();
            let least = rows.filter(|row| PaperMethod::of(row.method).is_some());
            let cheapest = least.fold(f64::INFINITY, |least, row| least.min(row.evaluations));
            shows(own, Fixed(0), own == 1.0 && own <= cheapest)
        },
    },
    Prose {
        id: "P7.4.guaranteed",
        place: "Section 7.4",
        gist: "symplectic Euler has a guaranteed bound of its energy",
        stated: "guaranteed",
        definition: "whether an orbit of it goes on gaining speed, at K = g Δt²/L = 1.5, within \
                     its limit of stability",
        verdict: Wrong,
        because: "As A.guarantees: it is the same orbit, seen from half a kick away.",
        measure: |_| never_escapes(&SymplecticEuler),
    },
    Prose {
        id: "P7.4.adequate",
        place: "Section 7.4",
        gist: "symplectic Euler's accuracy is adequate for interactive use",
        stated: "adequate",
        definition: "",
        verdict: NotCheckable,
        because: "A recommendation; the paper does not say what interactive use needs.",
        measure: nothing,
    },
    Prose {
        id: "P7.4.rk4",
        place: "Abstract, Section 7.4",
        gist: "RK4 has the smallest error a step",
        stated: "RK4",
        definition: "its error of a single step over the smallest of the other three's: the \
                     largest of four states, each in steps of 0.1, 0.01 and 0.001 s",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            static LARGEST: LazyLock<f64> = LazyLock::new(rk4_over_the_next_in_a_step);
            shows(*LARGEST, Significant(1), *LARGEST < 1.0)
        },
    },
    Prose {
        id: "P7.4.caveat",
        place: "Section 7.4",
        gist: "with RK4 the drift of the energy over long times must be watched",
        stated: "must",
        definition: "its largest energy error in 1000 s from 1 rad in steps of 0.01 s over that in \
                     100 s",
        verdict: Reproduced,
        because: "It grows with time.",
        measure: |_| {
            let drift = |steps| findings::energy_drift(&Rk4, 1.0, 0.01, steps);
            let ratio = drift(100_000) / drift(10_000);
            shows(ratio, Fixed(2), ratio > 5.0)
        },
    },
    Prose {
        id: "P7.4.fe",
        place: "Section 7.4",
        gist: "forward Euler should never be used for production simulations of Hamiltonian \
               systems",
        stated: "never",
        definition: "",
        verdict: NotCheckable,
        because: "A recommendation. The reason that it gives, monotonic growth, is P6.2.mono.",
        measure: nothing,
    },
    Prose {
        id: "P7.5.dissipation",
        place: "Section 7.5",
        gist: "dissipation and driving may alter the merits of symplectic methods",
        stated: "may alter",
        definition: "of the two, friction: Störmer–Verlet's RMS angle error over RK4's for 400 \
                     evaluations each, from 1 rad over 10 s, without it, and with a rate β of \
                     0.2/s; they are to differ by more than a tenth",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let [free, damped] = findings::verlet_over_rk4_damped();
            let differs = !is_near(damped / free, 1.0, 0.1);
            says(std::format!("{free:.1} and {damped:.1}"), differs)
        },
    },
    Prose {
        id: "P7.5.python",
        place: "Section 7.5",
        gist: "the times are those of Python loops, and compiled programs may compare otherwise",
        stated: "may differ",
        definition: "",
        verdict: DependsOnPlatform,
        because: "Said fairly; it holds of every time in Table 8 and Figure 7.",
        measure: nothing,
    },
    Prose {
        id: "P7.5.adaptive",
        place: "Section 7.5",
        gist: "the study has no adaptive methods",
        stated: "none",
        definition: "of the numbers of Tables 4 to 8 that are no property of a machine, those that \
                     fixed steps meet, as the cells are judged",
        verdict: Reproduced,
        because: "The paper's own account of its scope.",
        measure: |_| {
            let cells = || {
                let cells = CELLS.iter().filter(|cell| !cell.id.starts_with("T2."));
                cells.filter(|cell| cell.verdict != DependsOnPlatform)
            };
            let met = cells().filter(|cell| cell.verdict.demands() == Some(true)).count();
            says(std::format!("{met} of {}", cells().count()), met == cells().count())
        },
    },
    Prose {
        id: "P7.5.superior",
        place: "Section 7.5",
        gist: "adaptive steps can be more accurate for the same budget",
        stated: "can",
        definition: "the error of Dormand and Prince's method in steps that it chooses over that \
                     in equal steps, for equal evaluations: the pendulum from 1 rad, an ellipse of \
                     eccentricity 0.9; one of them below 1",
        verdict: Reproduced,
        because: "Where the motion has more than one pace. A swing of the pendulum has not, or not \
                  enough to pay for a control.",
        measure: |_| {
            let ratios = findings::adaptive_over_fixed();
            let text = ratios.map(|ratio| Significant(1).print(ratio)).join(" and ");
            says(text, ratios.into_iter().any(|ratio| ratio < 1.0))
        },
    },
    Prose {
        id: "P7.5.primary",
        place: "Section 7.5",
        gist: "energy is the primary measure; other invariants, such as area, may tell more",
        stated: "may tell more",
        definition: "|det J − 1| of forward and of symplectic Euler, which converge alike",
        verdict: Reproduced,
        because: "It tells the two apart at the first step.",
        measure: |study| {
            let euler = row!(study.characteristics, ForwardEuler);
            let symplectic = row!(study.characteristics, SymplecticEuler);
            let [a, b] = [euler, symplectic].map(|row| Fixed(5).print(row.area_defect.abs()));
            says(std::format!("{a} and {b}"), !euler.symplectic() && symplectic.symplectic())
        },
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
        id: "P8.validates",
        place: "Section 8",
        gist: "that RK4's period is right to 0.001 % validates the integrator's accuracy",
        stated: "validates",
        definition: "RK4's period, read as the paper does, from the exact one, no further than \
                     half a step, which is all that the reading tells; and that of Störmer–Verlet \
                     and of symplectic Euler, read in the same way (ms)",
        verdict: ReproducedWithDefinition,
        because: "To the spacing of the grid, as methods of order 2 and 1 would be, too.",
        measure: |study| {
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
        },
    },
    Prose {
        id: "P8.equations",
        place: "Section 8",
        gist: "that it is right to 0.001 % validates the equations of motion",
        stated: "validates",
        definition: "how far the period would be off with θ for sin θ, and with g = 9.80 m/s² (%)",
        verdict: ReproducedWithDefinition,
        because: "Those of the program, against Eq. 5, which has the same origin: of a real \
                  pendulum it says nothing.",
        measure: |study| {
            let slow = Pendulum::new(9.80, 1.0, 1.0).expect("a pendulum");
            let slow = exact::period(&slow, large_angle::THETA_0).unwrap_or(f64::NAN);
            let periods = &study.large_angle;
            let off = [periods.small_angle, slow].map(|period| periods.percent(period));
            let text = off.map(|percent| Significant(2).print(percent)).join(" and ");
            says(text, off.into_iter().all(|percent| percent > 0.001))
        },
    },
    Prose {
        id: "P8.reproducible",
        place: "Section 8",
        gist: "all results are reproducible",
        stated: "all",
        definition: "cells of Tables 2 and 4 to 8 whose printed digits or words are met, as they \
                     are judged",
        verdict: Wrong,
        because: "Not the times, which are those of one machine, nor a cell that is rounding, nor \
                  two entries of Table 2. All others are.",
        measure: |_| {
            let met = CELLS.iter().filter(|cell| cell.verdict.demands() == Some(true)).count();
            says(std::format!("{met} of {}", CELLS.len()), met == CELLS.len())
        },
    },
    Prose {
        id: "P8.yoshida",
        place: "Section 8",
        gist: "Yoshida's scheme is symplectic and of higher order",
        stated: "a higher-order symplectic method",
        definition: "slope of the largest error of the state, and |det J − 1| of a step of 0.1 s; \
                     it is Forest and Ruth's method",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            static FOUND: LazyLock<(f64, f64)> = LazyLock::new(|| {
                let slope = Ladder::measure(&ForestRuth).slopes().last().unwrap_or(f64::NAN);
                let z = Phase { theta: 1.0, omega: 0.5 };
                (slope, area_defect(&ForestRuth, &Pendulum::PAPER, z, AREA_STEP).abs())
            });
            let (slope, defect) = *FOUND;
            let text = std::format!("{slope:.2}; {}", below(AREA_TOLERANCE, defect));
            says(text, confirms((slope, slope), 4.0) && defect < AREA_TOLERANCE)
        },
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
        place: "Section 4.1, Figure 1",
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
        gist: "forward Euler's amplitude grows, at 0.01 s",
        stated: "growing amplitude",
        definition: "in 10 s from 0.05 rad, as in Table 6: its last turning point over its first, \
                     and each beyond the one before",
        verdict: ReproducedWithDefinition,
        because: "The figure names neither amplitude nor duration.",
        measure: |_| {
            let turns = turning_points_of_figure_4();
            let (first, last) = (turns[0].1.abs(), turns[turns.len() - 1].1.abs());
            let grows = turns.windows(2).all(|two| two[0].1.abs() < two[1].1.abs());
            shows(last / first, Fixed(2), turns.len() > 2 && grows)
        },
    },
    Prose {
        id: "F4b",
        place: "Figure 4",
        gist: "an upward drift of the energy is characteristic of a non-symplectic method",
        stated: "upward",
        definition: "H(1000) − H(0) of forward Euler and of RK4 in the long run (J)",
        verdict: Wrong,
        because: "RK4, not symplectic either, loses energy. That forward Euler's rises without a \
                  fall is so for as long as it swings: X.fe.first_fall.",
        measure: |study| {
            let gained = [row!(study.long_run, ForwardEuler), row!(study.long_run, Rk4)]
                .map(|run| run.last - run.initial);
            let text = gained.map(|gained| Significant(2).print(gained)).join(" and ");
            says(text, gained.into_iter().all(|gained| gained > 0.0))
        },
    },
    Prose {
        id: "F4c",
        place: "Figure 4",
        gist: "the growth of the amplitude corresponds directly to the drift of the energy",
        stated: "corresponds",
        definition: "m g L (cos θ₀ − cos θ) at the last turning point θ of the same run over the \
                     energy gained by then, to a hundredth",
        verdict: ReproducedWithDefinition,
        because: "On the parameters of Table 6.",
        measure: |_| {
            let turns = turning_points_of_figure_4();
            let (gained, theta) = turns[turns.len() - 1];
            let depth = Pendulum::PAPER.depth();
            let ratio = depth * (cos(small_angle::THETA_0) - cos(theta)) / gained;
            shows(ratio, Fixed(3), is_near(ratio, 1.0, 0.01))
        },
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
        id: "X.order_variant",
        place: "Section 4.3",
        gist: "symplectic Euler kicks first, as in Eqs. 8 and 9",
        stated: "kick, then drift",
        definition: "Table 6 at 0.1 s by kick-drift, which has to meet the cell, and by \
                     drift-kick, which must not (rad)",
        verdict: ReproducedWithDefinition,
        because: "The numbers are those of the equations.",
        measure: |_| {
            let methods: [&dyn AnyMethod; 2] = [&SymplecticEuler, &DriftKick];
            let errors = methods.map(|method| {
                findings::normalised_formula_error(method, 0.05, 0.1).1 * small_angle::THETA_0
            });
            let met = errors.map(|error| prints_as("T6.se.0.1", error));
            let text = errors.map(|error| Scientific(3).print(error)).join(" and ");
            says(text, met == [true, false])
        },
    },
    Prose {
        id: "X.verlet_variant",
        place: "Section 4.5",
        gist: "Störmer–Verlet in velocity form, as in Eqs. 10 to 12",
        stated: "kick, drift, kick",
        definition: "Table 4 at 0.1 s by kick-drift-kick, which has to meet the cell, and by \
                     drift-kick-drift, which must not (J)",
        verdict: ReproducedWithDefinition,
        because: "The numbers are those of the equations.",
        measure: |_| {
            let methods: [&dyn AnyMethod; 2] = [&StormerVerlet, &PositionVerlet];
            let drifts = methods.map(|method| convergence::drift(method, 0.1));
            let met = drifts.map(|drift| prints_as("T4.vv.0.1", drift));
            let text = drifts.map(|drift| Scientific(3).print(drift)).join(" and ");
            says(text, met == [true, false])
        },
    },
    Prose {
        id: "X.bold",
        place: "Table 6",
        gist: "the best at each step, which the text does not show in bold",
        stated: "as printed",
        definition: "the least of each column, by the measured and by the printed numbers",
        verdict: Reproduced,
        because: "The last three win by cancelling the formula's error; against the exact solution \
                  RK4 is ahead at every step.",
        measure: |study| {
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
        },
    },
];

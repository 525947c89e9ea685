//! Discussion and conclusion, Sections 7 and 8; the figures; and what the numbers decide where the
//! text leaves it open.

use std::sync::LazyLock;

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
        place: "Section 7.1",
        gist: "forward Euler's kinetic energy exceeds any physical bound",
        stated: "beyond any bound",
        definition: "at the end of the long run, over m g L (1 − cos θ₀), all that a swing from 1 \
                     rad can have",
        verdict: ReproducedWithDefinition,
        because: "The bound is that of the conserved energy.",
        measure: |study| {
            let omega = row!(study.long_run, ForwardEuler).end.omega;
            let all = Pendulum::PAPER.energy(pendula::Phase::at_rest(long_run::THETA_0));
            let ratio = 0.5 * omega * omega / all;
            shows(ratio, Fixed(0), ratio > 1.0)
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
            let percent = row!(study.long_run, SymplecticEuler).percent_of_initial();
            shows(percent, Significant(5), percent < 1e-10)
        },
    },
    Prose {
        id: "P7.1.modest",
        place: "Section 7.1",
        gist: "over very long runs even a modest drift makes a simulation meaningless",
        stated: "meaningless",
        definition: "RK4's energy over the true one, after 10⁶ steps of 0.1 s from 1 rad; and of \
                     0.01 s, for comparison",
        verdict: ReproducedWithDefinition,
        because: "How long a run has to be depends on the step: what a step loses goes as its \
                  sixth power.",
        measure: |_| {
            static LEFT: LazyLock<[f64; 2]> = LazyLock::new(|| {
                let start = Pendulum::PAPER.energy(pendula::Phase::at_rest(1.0));
                [0.1, 0.01].map(|step| findings::last_energy(&Rk4, 1.0, step, 1_000_000) / start)
            });
            let [coarse, fine] = *LEFT;
            says(std::format!("{coarse:.3} and {fine:.5}"), coarse < 0.5)
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
            let word = |k| if escapes(k) { "wanders off" } else { "stays" };
            let text = std::format!("{} and {}", word(0.1), word(1.5));
            says(text, !escapes(0.1) && !escapes(1.5))
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
        gist: "all methods converge to a common floor",
        stated: "all",
        definition: "forward Euler's and symplectic Euler's error over RK4's, at 0.001 s and at \
                     0.00001 s",
        verdict: ReproducedWithDefinition,
        because: "In the limit. At the finest step of the paper forward Euler is ten times above \
                  the floor, and symplectic Euler below it.",
        measure: |study| {
            let rk4 = row!(study.small_angle, Rk4).errors[4].formula;
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
            let [[a, b], [c, d]] = [coarse, *FINE].map(|errors| errors.map(|error| error / rk4));
            let near = [c, d].into_iter().all(|ratio| is_near(ratio, 1.0, 0.02));
            says(std::format!("{a:.1} and {b:.2}; {c:.3} and {d:.3}"), near)
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
        measure: |study| number(row!(study.characteristics, SymplecticEuler).evaluations, Fixed(0)),
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
        measure: |_| {
            let fastest = findings::chaotic_speed(&SymplecticEuler, 1.5, 200_000);
            let escapes = fastest > core::f64::consts::TAU;
            says(if escapes { "it does" } else { "it does not" }.to_string(), !escapes)
        },
    },
    Prose {
        id: "P7.4.adequate",
        place: "Section 7.4",
        gist: "symplectic Euler's accuracy is adequate for interactive use",
        stated: "adequate",
        definition: "its largest error of the angle in 10 s from 0.05 rad, in steps of 0.01 s, \
                     over the amplitude",
        verdict: ReproducedWithDefinition,
        because: "A fiftieth of the swing, which no eye sees; from 1 rad it is more.",
        measure: |_| {
            let error = findings::normalised_formula_error(&SymplecticEuler, 0.05, 0.01).0;
            shows(error, Significant(2), error < 0.05)
        },
    },
    Prose {
        id: "P7.4.rk4",
        place: "Section 7.4",
        gist: "RK4 has the smallest error a step",
        stated: "RK4",
        definition: "error of a step of 0.01 s from 1 rad and 1 rad/s, the smallest of the four",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let others: [&dyn AnyMethod; 3] = [&ForwardEuler, &SymplecticEuler, &StormerVerlet];
            let error = |method| findings::one_step_error(method, 0.01);
            let rk4 = error(&Rk4);
            shows(rk4, Scientific(2), others.into_iter().all(|other| rk4 < error(other)))
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
        definition: "its largest energy error over 1000 s, over Störmer–Verlet's in the same steps \
                     for the same work",
        verdict: Reproduced,
        because: "That its growth is monotonic is P6.2.mono.",
        measure: |study| {
            let [euler, verlet] =
                [row!(study.long_run, ForwardEuler), row!(study.long_run, StormerVerlet)];
            let ratio = euler.drift / verlet.drift;
            shows(ratio, Significant(2), ratio > 1.0)
        },
    },
    Prose {
        id: "P7.5.dissipation",
        place: "Section 7.5",
        gist: "friction and driving may alter the merits of symplectic methods",
        stated: "may alter",
        definition: "Störmer–Verlet's RMS angle error over RK4's for 400 evaluations each, from 1 \
                     rad over 10 s: without friction, and with a rate β of 0.2/s",
        verdict: Reproduced,
        because: "",
        measure: |_| {
            let [free, damped] = findings::verlet_over_rk4_damped();
            let differs = !is_near(damped / free, 1.0, 0.05);
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
        definition: "cells of Table 6 that fixed steps meet",
        verdict: Reproduced,
        because: "The paper's own account of its scope.",
        measure: |study| {
            let met = |(row, step): (&small_angle::Row, usize)| {
                let method = PaperMethod::of(row.method).map_or("", PaperMethod::id);
                prints_as(&std::format!("T6.{method}.{}", STEPS[step]), row.errors[step].formula)
            };
            let rows = study.small_angle.iter();
            let cells = rows.flat_map(|row| (0..STEPS.len()).map(move |step| (row, step)));
            let count = cells.filter(|cell| met(*cell)).count();
            says(std::format!("{count} of 20"), count == 20)
        },
    },
    Prose {
        id: "P7.5.superior",
        place: "Section 7.5",
        gist: "adaptive steps can be more accurate for the same budget",
        stated: "can",
        definition: "the error of Dormand and Prince's method in steps that it chooses over that \
                     in equal steps, for equal evaluations: the pendulum from 1 rad, an ellipse of \
                     eccentricity 0.9",
        verdict: ReproducedWithDefinition,
        because: "Where the motion has more than one pace. A swing of the pendulum has not, or not \
                  enough to pay for a control.",
        measure: |_| {
            let [pendulum, ellipse] = findings::adaptive_over_fixed();
            let text = [pendulum, ellipse].map(|ratio| Significant(1).print(ratio)).join(" and ");
            says(text, pendulum > 0.5 && ellipse < 0.1)
        },
    },
    Prose {
        id: "P7.5.primary",
        place: "Section 7.5",
        gist: "energy is the primary measure; other invariants, such as area, may tell more",
        stated: "may tell more",
        definition: "det J − 1 of forward and of symplectic Euler, which converge alike",
        verdict: Reproduced,
        because: "It tells the two apart at the first step.",
        measure: |study| {
            let defect = row!(study.characteristics, ForwardEuler).area_defect;
            let none = row!(study.characteristics, SymplecticEuler).area_defect;
            let text = std::format!("{defect:.5} and 0");
            says(text, defect.abs() > AREA_TOLERANCE && none.abs() < AREA_TOLERANCE)
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
        definition: "the period read in the same way, in the same steps, with Störmer–Verlet and \
                     with symplectic Euler (s)",
        verdict: Wrong,
        because: "Methods of order 2 and 1 give the same period to the last digit: the reading \
                  measures the spacing of the grid.",
        measure: |study| {
            let methods: [&dyn AnyMethod; 2] = [&StormerVerlet, &SymplecticEuler];
            let [vv, se] = methods.map(large_angle::period_by_peak);
            let text = [vv, se].map(|period| Fixed(3).print(period)).join(" and ");
            let rk4 = study.large_angle.by_peak;
            says(text, !is_near(vv, rk4, 1e-9) && !is_near(se, rk4, 1e-9))
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
        id: "X.order_variant",
        place: "Section 4.3",
        gist: "symplectic Euler kicks first",
        stated: "kick, then drift",
        definition: "Table 6 at 0.1 s by drift-kick (rad)",
        verdict: ReproducedWithDefinition,
        because: "Drift-kick would print 3.62e-3 where the paper has 7.86e-3.",
        measure: |_| {
            let error = findings::normalised_formula_error(&DriftKick, 0.05, 0.1).1 * 0.05;
            shows(error, Scientific(3), !prints_as("T6.se.0.1", error))
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
            shows(drift, Scientific(3), !prints_as("T4.vv.0.1", drift))
        },
    },
];

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
        place: "Section 7.1",
        gist: "forward Euler's kinetic energy exceeds any physical bound",
        stated: "beyond any bound",
        definition: "turns a second at the end of the long run",
        verdict: Wrong,
        because: "An ordinary rate: an electric fan turns faster.",
        measure: |study| {
            let omega = row!(study.long_run, ForwardEuler).end.omega.abs();
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
            let percent = row!(study.long_run, SymplecticEuler).percent_of_initial();
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
        id: "P7.3.all",
        place: "Section 7.3",
        gist: "all methods converge to a common floor",
        stated: "all",
        definition: "forward Euler's error at 0.001 s over RK4's",
        verdict: Wrong,
        because: "Forward Euler is ten times above it and symplectic Euler below it at the finest \
                  step.",
        measure: |study| {
            let error = row!(study.small_angle, ForwardEuler).errors[4].formula;
            let ratio = error / row!(study.small_angle, Rk4).errors[4].formula;
            shows(ratio, Fixed(1), is_near(ratio, 1.0, 0.1))
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
            let text = if is_near(ratio, 1.0, 0.05) { "saturated" } else { "not saturated" };
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

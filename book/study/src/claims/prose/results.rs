//! The results: Section 6.

use super::*;

pub(super) const CLAIMS: &[Prose] = &[
    claim("P6.1.fe200", "Section 6.1", "> 200", Reproduced)
        .gist("forward Euler's energy error exceeds 200 J at 0.1 s")
        .definition("T4.fe.0.1")
        .measured(|study| {
            let drift = row!(study.convergence, ForwardEuler).drift[0];
            shows(drift, Significant(6), drift > 200.0)
        }),
    claim("P6.1.fe_order", "Section 6.1", "slope 1", Wrong)
        .gist("forward Euler's energy error falls as Δt")
        .because(
            "Coarse steps go over the top and rotate, fine ones only swing higher: regimes with \
             different laws. In the limit it does, for steps far below 2 ms; none of the five is \
             there.",
        )
        .definition("slopes between neighbouring steps of Table 4, each to ± 0.15")
        .measured(|study| {
            let (low, high) = order_range(study, PaperMethod::ForwardEuler);
            let text = std::format!("slopes from {low:.2} to {high:.2}");
            says(text, confirms((low, high), 1.0))
        }),
    claim("P6.1.machine", "Sections 6.1 and 7.2", "machine precision", Wrong)
        .gist("RK4 conserves energy to machine precision at 0.001 s")
        .because(
            "Nearly all of it is truncation: a loss of order Δt⁵ and an oscillation of order Δt⁴.",
        )
        .definition(
            "how far its energy error still falls at half the step: rounding would not fall at \
             all, and order 4 sixteenfold",
        )
        .measured(|study| {
            static HALVED: LazyLock<f64> = LazyLock::new(|| convergence::drift(&Rk4, 0.0005));
            let ratio = row!(study.convergence, Rk4).drift[4] / *HALVED;
            let text = if ratio > 4.0 { "more than fourfold" } else { "fourfold at most" };
            says(text.to_string(), ratio <= 4.0)
        }),
    claim("P6.1.ratio", "Sections 6.1 and 7.2", "3.99", DependsOnRounding)
        .gist("Störmer–Verlet's energy error at 0.01 s over that at 0.005 s")
        .because("The ratio of the unrounded cells is 4.0000.")
        .definition("from the cells rounded to three digits, as the paper does")
        .measured(|study| {
            let drift = row!(study.convergence, StormerVerlet).drift;
            let rounded = |value: f64| std::format!("{value:.2e}").parse().unwrap_or(f64::NAN);
            number(rounded(drift[2]) / rounded(drift[3]), Fixed(4))
        }),
    claim("P6.1.exact", "Sections 6.1 and 7.2", "exact", ReproducedWithDefinition)
        .gist("that ratio confirms that the scaling is exactly of second order")
        .because(
            "In the limit, to which the second is nearer than the first. It is 4 at no step, and \
             3.99 is rounding.",
        )
        .definition(
            "the ratio of the unrounded errors at 0.1 s and 0.05 s, and at 0.01 s and 0.005 s",
        )
        .measured(|study| {
            let drift = row!(study.convergence, StormerVerlet).drift;
            let [coarse, fine] = [drift[0] / drift[1], drift[2] / drift[3]];
            let text = std::format!("{coarse:.5} and {fine:.5}");
            let away = |ratio: f64| (ratio - 4.0).abs();
            says(text, away(fine) < 0.1 * away(coarse) && away(coarse) < 0.1)
        }),
    claim("P6.1.bounded", "Section 6.1, Figure 2", "respective orders", Reproduced)
        .gist("the symplectic methods' energy errors are bounded, at their respective orders")
        .definition(
            "slopes between neighbouring steps of Table 4, each to ± 0.15 of 1 and of 2; and the \
             energy over 1000 s",
        )
        .measured(|study| {
            let is_bounded = |energy| energy == EnergyBehaviour::BoundedOscillation;
            let [euler, verlet] = [PaperMethod::SymplecticEuler, PaperMethod::StormerVerlet]
                .map(|id| order_range(study, id));
            let slopes = confirms(euler, 1.0) && confirms(verlet, 2.0);
            let bounded = is_bounded(row!(study.characteristics, SymplecticEuler).energy)
                && is_bounded(row!(study.characteristics, StormerVerlet).energy);
            let [a, b] = [euler, verlet].map(|(low, high)| std::format!("{low:.2} to {high:.2}"));
            let text =
                std::format!("{a} and {b}; {}", if bounded { "bounded" } else { "not bounded" });
            says(text, slopes && bounded)
        }),
    claim("P6.1.slope", "Section 6.1, Figure 2", "4", Wrong)
        .gist("each curve's slope is the order of its method: RK4's")
        .because(
            "A small swing loses x⁶/72 of its energy a step, with x = ω₀Δt, and a large one less \
             of it but with the same power: Δt⁵ over a fixed time.",
        )
        .definition("slope of Table 4 between 0.05 s and 0.01 s")
        .measured(|study| {
            let drift = row!(study.convergence, Rk4).drift;
            let slope = slopes(&STEPS[1..3], &drift[1..3], 0.0).flatten().next();
            number(slope.unwrap_or(f64::NAN), Fixed(2))
        }),
    claim("P6.1.best", "Table 4", "in bold", NotCheckable)
        .gist("the smallest energy error at each step is in bold")
        .because(NO_BOLD),
    claim("P6.1.highest", "Section 6.1, Figure 2", "RK4", Reproduced)
        .gist("RK4 has the highest order of convergence")
        .definition("its least slope in Table 4, and the largest of the others")
        .measured(|study| {
            let rk4 = order_range(study, PaperMethod::Rk4).0;
            let others = [
                PaperMethod::ForwardEuler,
                PaperMethod::SymplecticEuler,
                PaperMethod::StormerVerlet,
            ]
            .map(|id| order_range(study, id).1);
            let next = others.into_iter().fold(f64::NEG_INFINITY, libm::fmaximum);
            says(std::format!("{rk4:.2} and {next:.2}"), next < rk4)
        }),
    claim("P6.2.omit", "Section 6.2", "negligible", Reproduced)
        .gist("RK4's energy error over 1000 s is negligible")
        .because("True, and it hides that RK4 is the best method of this experiment.")
        .definition("over Störmer–Verlet's, the smallest of those shown: below a hundredth")
        .measured(|study| {
            let ratio = row!(study.long_run, Rk4).drift / row!(study.long_run, StormerVerlet).drift;
            shows(ratio, Significant(2), ratio < 0.01)
        }),
    claim("P6.2.stark", "Section 6.2", "starkly", Wrong)
        .gist(
            "the run starkly illustrates the difference between symplectic and non-symplectic \
             methods",
        )
        .because(
            "What is stark is forward Euler. RK4, not symplectic either and left out, errs less \
             than both that are.",
        )
        .definition(
            "the smallest energy error of the two that are not symplectic, forward Euler and RK4, \
             over the largest of the two that are: above 1, they would be apart",
        )
        .measured(|study| {
            let drift = |symplectic: bool| {
                let rows = study.characteristics.iter().zip(&study.long_run);
                let own = rows.filter(move |(row, _)| {
                    PaperMethod::of(row.method).is_some() && row.symplectic() == symplectic
                });
                own.map(|(_, run)| run.drift)
            };
            let ratio =
                drift(false).fold(f64::INFINITY, f64::min) / drift(true).fold(0.0, f64::max);
            shows(ratio, Scientific(2), ratio > 1.0)
        }),
    claim("P6.2.mono", "Sections 6.2, 7.4 and 8, Figure 3", "monotonic", Wrong)
        .gist("forward Euler's energy grows monotonically")
        .because(
            "Once the pendulum goes over the top, steps above the horizontal take energy away.",
        )
        .definition("steps of the 1000 s run that lower the energy")
        .measured(monotonic),
    claim("P6.2.se_pct", "Section 6.2, Figure 3", "1.3", Reproduced)
        .gist("symplectic Euler's energy error over 1000 s (%)")
        .definition("Table 5")
        .measured(|study| {
            number(row!(study.long_run, SymplecticEuler).percent_of_initial(), Significant(5))
        }),
    claim("P6.2.escape", "Section 6.2", "escaped", ReproducedWithDefinition)
        .gist("forward Euler's pendulum would have escaped to infinity")
        .because(
            "The angle leaves every bound, as that of any pendulum that rotates. The bob stays on \
             its circle.",
        )
        .definition(
            "its angle at the end, in turns; and that H is above m g L, so that the angle would \
             grow for ever",
        )
        .measured(|study| {
            let run = row!(study.long_run, ForwardEuler);
            let turns = run.end.theta.abs() / core::f64::consts::TAU;
            shows(turns, Fixed(0), run.last > Pendulum::PAPER.depth() && turns > 1.0)
        }),
    claim("P6.2.final", "Sections 6.2 and 7.1", "475.7", Reproduced)
        .gist("forward Euler's energy after 1000 s (J)")
        .definition("Eq. 3")
        .measured(|study| number(row!(study.long_run, ForwardEuler).last, Fixed(6))),
    claim("P6.2.corresponds", "Section 6.2", "corresponds", ReproducedWithDefinition)
        .gist("the drift in per cent corresponds to that final energy")
        .because(
            "The printed percentage is that of the largest error of the run, which is not the \
             last.",
        )
        .definition("100 (H(1000) − H(0))/|H(0)|, within a hundredth of the printed percentage")
        .measured(|study| {
            let run = row!(study.long_run, ForwardEuler);
            let last = 100.0 * (run.last - run.initial) / run.initial.abs();
            let printed = printed("T5.fe.pct");
            shows(last, Fixed(1), is_near(last, printed, 0.01 * printed))
        }),
    claim("P6.2.best", "Table 5", "in bold", NotCheckable)
        .gist("the best result is in bold")
        .because(NO_BOLD),
    claim("P6.2.five_orders", "Section 6.2", "nearly 10⁵", Wrong)
        .gist("forward Euler and Störmer–Verlet differ by nearly five orders of magnitude")
        .because("It is nearer to six.")
        .definition("ratio of their energy errors; nearly five orders are 10^4.5 to 10^5")
        .measured(|study| {
            let ratio = row!(study.long_run, ForwardEuler).drift
                / row!(study.long_run, StormerVerlet).drift;
            shows(ratio, Scientific(3), is_near(libm::log10(ratio), 4.75, 0.25))
        }),
    claim("P6.3.floor", "Sections 6.3 and 7.3", "1e-4", ReproducedWithDefinition)
        .gist("the small-angle formula itself is off by (rad)")
        .because("Over that time. It is a phase error and grows with the duration: no floor.")
        .definition("RMS error of the formula against the exact solution over 10 s")
        .measured(|_| number(*FLOOR, Scientific(6))),
    claim("P6.3.converge", "Section 6.3", "converge", Reproduced)
        .gist("RK4 and Störmer–Verlet converge to that floor")
        .because(
            "RK4 from above, but for the start's share in the mean. Störmer–Verlet from below: at \
             0.01955 s its error and the formula's cancel.",
        )
        .definition(
            "RK4's and Störmer–Verlet's error at 0.001 s over that of the formula, each within a \
             hundredth of 1; and at 0.1 s, where neither is",
        )
        .measured(|study| {
            let rows = [row!(study.small_angle, Rk4), row!(study.small_angle, StormerVerlet)];
            let [coarse, fine] =
                [0, 4].map(|step| rows.map(|row| row.errors[step].formula / *FLOOR));
            let there = |ratio: f64| is_near(ratio, 1.0, 0.01);
            let ([a, b], [c, d]) = (fine, coarse);
            says(
                std::format!("{a:.3} and {b:.3}; {c:.1} and {d:.1}"),
                fine.into_iter().all(there) && !coarse.into_iter().any(there),
            )
        }),
    claim("P6.3.norm", "Sections 6.3 and 7.3", "2.6e-7", ReproducedWithDefinition)
        .gist("RK4's error over θ₀ at θ₀ = 1e-4 rad")
        .because("Over nine tenths of it are RK4's own phase error; at 0.001 s it is 1.9e-8.")
        .definition("the largest over all samples at 0.01 s, not the RMS")
        .measured(|_| number(largest_formula_error(1e-4, 0.01), Scientific(4))),
    claim("P6.3.below", "Section 6.3", "< 10⁻⁶", ReproducedWithDefinition)
        .gist("that is well below 1e-6")
        .because("At 0.01 s; at 0.05 s it is not.")
        .definition("the same")
        .measured(|_| {
            let error = largest_formula_error(1e-4, 0.01);
            shows(error, Scientific(4), error < 1e-6)
        }),
    claim("P6.3.confirms", "Sections 6.3 and 7.3", "confirmed", ReproducedWithDefinition)
        .gist("that run confirms that the floor is no numerical error")
        .because("For RK4, and at that step.")
        .definition(
            "RK4's largest error over θ₀ at 0.05 rad over that at 1e-4 rad, both at 0.01 s: a \
             numerical error would keep its share, and give 1",
        )
        .measured(|_| {
            let [large, small] =
                [small_angle::THETA_0, 1e-4].map(|theta_0| largest_formula_error(theta_0, 0.01));
            shows(large / small, Scientific(2), large > 100.0 * small)
        }),
    claim("P6.3.best", "Table 6", "in bold", NotCheckable)
        .gist("the smallest error at each step is in bold")
        .because(NO_BOLD),
    claim("P6.4.closed", "Section 6.4, Figure 5", "closed", ReproducedWithDefinition)
        .gist("RK4's orbits are closed")
        .because("To the eye. RK4 loses energy and spirals inward.")
        .definition(
            "after one exact period, the largest |Δθ| (rad) or |Δω| (rad/s) of the three orbits: \
             below 0.01, the width of a line",
        )
        .measured(|_| {
            let largest = gap_of_the_orbits(&Rk4);
            shows(largest, Scientific(1), largest < LINE)
        }),
    claim("P6.4.confirms", "Section 6.4, Figure 5", "confirm", ReproducedWithDefinition)
        .gist("closed orbits confirm that energy is conserved, and the quality of RK4")
        .because("They tell RK4 from forward Euler. Methods of order 1 and 2 would look the same.")
        .definition(
            "the same of forward Euler, symplectic Euler and Störmer–Verlet: those above 0.01 \
             would be seen not to close",
        )
        .measured(|_| {
            let others: [&dyn AnyMethod; 3] = [&ForwardEuler, &SymplecticEuler, &StormerVerlet];
            let gaps = others.map(gap_of_the_orbits);
            let text = gaps.map(|gap| Significant(1).print(gap)).join(", ");
            says(text, gap_of_the_orbits(&Rk4) < LINE && gaps.into_iter().any(|gap| gap > LINE))
        }),
    claim("P6.4.elong", "Section 6.4, Figure 5", "more elongated", ReproducedWithDefinition)
        .gist("larger orbits are more elongated")
        .because(
            "In the unit ω₀ of ω, in which a small swing is a circle. In rad/s, as Figure 5 has \
             it, small orbits are the longer ones, and larger ones are rounder.",
        )
        .definition("the largest ω of RK4's three orbits over ω₀ θ₀")
        .measured(|_| {
            let ratio = phase_portrait::THETA_0.map(|theta_0| {
                let orbit = phase_portrait::orbit(&Rk4, theta_0);
                let fastest = orbit.iter().fold(0.0, |fastest: f64, z| fastest.max(z.omega.abs()));
                fastest / (Pendulum::PAPER.small_angle_frequency() * theta_0)
            });
            let text = ratio.map(|ratio| std::format!("{ratio:.3}")).join(", ");
            says(text, ratio[0] < 1.0 && ratio.is_sorted_by(|a, b| a > b))
        }),
    claim("P6.5.T", "Section 6.5", "5.158", ReproducedWithDefinition)
        .gist("numerical and exact period agree (s)")
        .because("See T7.Tnum.")
        .definition("time of the highest sample")
        .measured(|study| number(study.large_angle.by_peak, Fixed(4))),
    claim("P6.5.within", "Section 6.5", "within", Wrong)
        .gist("they agree to within 0.001 %")
        .because(
            "It rounds to 0.001, but is not within it, and neither are the printed periods. RK4's \
             own period is, by far: T7.hermite.",
        )
        .definition("their relative difference (%), as a bound")
        .measured(|study| {
            let percent = study.large_angle.percent(study.large_angle.by_peak);
            shows(percent, Significant(3), percent <= 0.001)
        }),
    claim("P6.5.ratio", "Section 6.5", "2.57", Reproduced)
        .gist("T/T₀")
        .definition("exact period over small-angle period")
        .measured(|study| {
            let periods = &study.large_angle;
            number(periods.exact / periods.small_angle, Fixed(6))
        }),
    claim("P6.5.wave", "Section 6.5, Figure 6", "more", Reproduced)
        .gist("more time near the turning points than a sinusoid")
        .because("The third harmonic over the first is cosh(r/2)/(3 cosh(3r/2)) with r = πK'/K.")
        .definition("fraction of time beyond nine tenths of the amplitude; a sinusoid has 0.287")
        .measured(|_| {
            let (beyond, _) = findings::waveform(3.0);
            shows(beyond, Fixed(2), beyond > 0.287)
        }),
    claim("P6.6.dom", "Section 6.6, Figure 7", "RK4", Wrong)
        .gist("RK4 achieves the lowest error for a given computation budget")
        .because(
            "It depends on the budget: true from some number of evaluations on, which depends on \
             the amplitude.",
        )
        .definition(
            "Störmer–Verlet's RMS angle error over RK4's, from 1 rad over 10 s against the exact \
             solution: for 100 evaluations each, and for 400",
        )
        .measured(|study| {
            let methods = [row!(study.work, StormerVerlet).method, row!(study.work, Rk4).method];
            let ratio = |evaluations| {
                let [vv, rk4] = methods.map(|method| findings::error_for_work(method, evaluations));
                vv / rk4
            };
            let [few, many] = [100, 400].map(ratio);
            says(std::format!("{few:.2} and {many:.1}"), few > 1.0 && many > 1.0)
        }),
    claim("P6.6.high", "Sections 6.6 and 7.4", "RK4", ReproducedWithDefinition)
        .gist("RK4 dominates at high accuracy")
        .because(
            "Against the exact solution, and among the four. Against the small-angle formula, as \
             in Figure 7, high accuracy cannot be seen.",
        )
        .definition(
            "Störmer–Verlet's RMS angle error over RK4's for 4000 evaluations each, from 1 rad \
             over 10 s, against the exact solution",
        )
        .measured(|study| {
            let methods = [row!(study.work, StormerVerlet).method, row!(study.work, Rk4).method];
            let [vv, rk4] = methods.map(|method| findings::error_for_work(method, 4000));
            shows(vv / rk4, Fixed(0), vv > rk4)
        }),
    claim("P6.6.34", "Section 6.6", "3–4", ReproducedWithDefinition)
        .gist("RK4 costs three to four times as much a step")
        .because(
            "Than the two Eulers, by the clock of one machine. Four evaluations against one is the \
             stable fact.",
        )
        .definition(
            "its printed time over forward Euler's, symplectic Euler's and Störmer–Verlet's",
        )
        .measured(|_| {
            let ratios = ["fe", "se", "vv"]
                .map(|id| printed("T8.rk4.ms") / printed(&std::format!("T8.{id}.ms")));
            let text = ratios.map(|ratio| Fixed(2).print(ratio)).join(", ");
            says(text, ratios[..2].iter().all(|ratio| (3.0..=4.0).contains(ratio)))
        }),
    claim("P6.6.best", "Section 6.6, Figure 7", "Störmer–Verlet", Wrong)
        .gist("Störmer–Verlet has the best trade-off at moderate precision")
        .because(
            "From 0.05 rad, the paper's start, RK4 is ahead from about 230 evaluations on, where \
             both err by a hundredth of the swing; from 1 rad from about 180. What is left to \
             Störmer–Verlet is rough. From 3 rad it is ahead to about 1500, and an error of a ten \
             thousandth.",
        )
        .definition(
            "its RMS error over RK4's for 400 evaluations each, from 1 rad over 10 s, against the \
             exact solution",
        )
        .measured(|study| {
            let methods = [row!(study.work, StormerVerlet).method, row!(study.work, Rk4).method];
            let [vv, rk4] = methods.map(|method| findings::error_for_work(method, 400));
            shows(vv / rk4, Fixed(1), vv < rk4)
        }),
    claim("P6.6.33", "Section 6.6", "3.3", Reproduced)
        .gist("RK4's overhead over forward Euler")
        .because("The times themselves are those of one machine.")
        .definition("the printed times divided")
        .measured(|_| number(printed("T8.rk4.ms") / printed("T8.fe.ms"), Fixed(2))),
    claim("P6.6.120", "Section 6.6", "120", ReproducedWithDefinition)
        .gist("forward Euler's RMS error over RK4's")
        .because("Limited by the formula; against the exact solution it is over two million.")
        .definition("Table 8, against the small-angle formula")
        .measured(|study| {
            let error = |id| {
                let row = study.work.iter().find(|row| PaperMethod::of(row.method) == Some(id));
                row.map_or(f64::NAN, |row| row.points[work::TABLE_8].1.formula)
            };
            number(error(PaperMethod::ForwardEuler) / error(PaperMethod::Rk4), Fixed(1))
        }),
    claim(
        "P6.6.pareto",
        "Sections 1 and 6.6, Figure 7",
        "the Pareto frontier",
        ReproducedWithDefinition,
    )
    .gist("the figure presents the Pareto frontier of accuracy and time")
    .because(
        "The figure shows all four methods, and the frontier is part of it: RK4's point is \
             beaten by Störmer–Verlet's in both.",
    )
    .definition(
        "rows of Table 8 that no other beats in both the printed time and the printed RMS \
             error; of one alone there would be no frontier to speak of",
    )
    .measured(|_| {
        let point = |id| ["ms", "rms"].map(|column| printed(&std::format!("T8.{id}.{column}")));
        let all = PaperMethod::ALL.map(|method| (method, point(method.id())));
        let beaten = |[time, error]: [f64; 2]| {
            all.iter().any(|(_, [less, smaller])| *less < time && *smaller < error)
        };
        let on_it: Vec<&str> = all
            .into_iter()
            .filter(|(_, point)| !beaten(*point))
            .map(|(method, _)| method.title())
            .collect();
        says(on_it.join(", "), on_it.len() > 1)
    }),
    claim("P6.6.bold", "Table 8", "in bold", NotCheckable)
        .gist("the best in each column is in bold")
        .because(NO_BOLD),
];

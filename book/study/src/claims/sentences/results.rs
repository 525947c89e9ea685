//! The results: Section 6.

use super::*;
use pendula::registry::InSteps;

pub(super) const MEASURED: &[(&str, Measure)] = &[
    ("P6.1.fe200", |study| {
        let drift = row!(study.convergence, ForwardEuler).drift[0];
        shows(drift, Significant(6), drift > 200.0)
    }),
    ("P6.1.fe_order", |study| {
        let (low, high) = order_range(study, PaperMethod::ForwardEuler);
        let text = format!("slopes from {low:.2} to {high:.2}");
        says(text, confirms((low, high), 1.0))
    }),
    ("P6.1.machine", |study| {
        let ratio =
            row!(study.convergence, Rk4).drift[4] / convergence::drift(&InSteps(Rk4), 0.0005);
        let text = if ratio > 4.0 { "more than fourfold" } else { "fourfold at most" };
        says(text.to_string(), ratio <= 4.0)
    }),
    ("P6.1.ratio", |study| {
        let drift = row!(study.convergence, StormerVerlet).drift;
        let rounded = |value: f64| format!("{value:.2e}").parse().unwrap_or(f64::NAN);
        number(rounded(drift[2]) / rounded(drift[3]), Fixed(4))
    }),
    ("P6.1.exact", |study| {
        let drift = row!(study.convergence, StormerVerlet).drift;
        let [coarse, fine] = [drift[0] / drift[1], drift[2] / drift[3]];
        let text = format!("{coarse:.5} and {fine:.5}");
        let away = |ratio: f64| (ratio - 4.0).abs();
        says(text, away(fine) < 0.1 * away(coarse) && away(coarse) < 0.1)
    }),
    ("P6.1.bounded", |study| {
        let is_bounded = |energy| energy == EnergyBehaviour::BoundedOscillation;
        let [euler, verlet] = [PaperMethod::SymplecticEuler, PaperMethod::StormerVerlet]
            .map(|id| order_range(study, id));
        let slopes = confirms(euler, 1.0) && confirms(verlet, 2.0);
        let bounded = is_bounded(row!(study.characteristics, SymplecticEuler).energy)
            && is_bounded(row!(study.characteristics, StormerVerlet).energy);
        let [a, b] = [euler, verlet].map(|(low, high)| format!("{low:.2} to {high:.2}"));
        let text = format!("{a} and {b}; {}", if bounded { "bounded" } else { "not bounded" });
        says(text, slopes && bounded)
    }),
    ("P6.1.slope", |study| {
        let drift = row!(study.convergence, Rk4).drift;
        let slope = slopes(&STEPS[1..3], &drift[1..3], 0.0).flatten().next();
        number(slope.unwrap_or(f64::NAN), Fixed(2))
    }),
    ("P6.1.highest", |study| {
        let rk4 = order_range(study, PaperMethod::Rk4).0;
        let others =
            [PaperMethod::ForwardEuler, PaperMethod::SymplecticEuler, PaperMethod::StormerVerlet]
                .map(|id| order_range(study, id).1);
        let next = others.into_iter().fold(f64::NEG_INFINITY, libm::fmaximum);
        says(format!("{rk4:.2} and {next:.2}"), next < rk4)
    }),
    ("P6.2.omit", |study| {
        let ratio = row!(study.long_run, Rk4).drift / row!(study.long_run, StormerVerlet).drift;
        shows(ratio, Significant(2), ratio < 0.01)
    }),
    ("P6.2.stark", |study| {
        let drift = |symplectic: bool| {
            let rows = study.characteristics.iter().zip(&study.long_run);
            let own = rows.filter(move |(row, _)| {
                PaperMethod::of(row.method).is_some() && row.symplectic() == symplectic
            });
            own.map(|(_, run)| run.drift)
        };
        let ratio = drift(false).fold(f64::INFINITY, f64::min) / drift(true).fold(0.0, f64::max);
        shows(ratio, Scientific(2), ratio > 1.0)
    }),
    ("P6.2.mono", monotonic),
    ("P6.2.se_pct", |study| {
        number(row!(study.long_run, SymplecticEuler).percent_of_initial(), Significant(5))
    }),
    ("P6.2.escape", |study| {
        let end = row!(study.long_run, ForwardEuler).end;
        let motion = Motion::new(&Pendulum::PAPER, end).expect("a finite state");
        let back = motion.period();
        shows(back.unwrap_or(f64::INFINITY), Significant(2), back.is_none())
    }),
    ("P6.2.final", |study| number(row!(study.long_run, ForwardEuler).last, Fixed(6))),
    ("P6.2.corresponds", |study| {
        let run = row!(study.long_run, ForwardEuler);
        let last = 100.0 * (run.last - run.initial) / run.initial.abs();
        let printed = printed("T5.fe.pct");
        shows(last, Fixed(1), is_near(last, printed, 0.01 * printed))
    }),
    ("P6.2.five_orders", |study| {
        let ratio =
            row!(study.long_run, ForwardEuler).drift / row!(study.long_run, StormerVerlet).drift;
        shows(ratio, Scientific(3), is_near(libm::log10(ratio), 4.75, 0.25))
    }),
    ("P6.3.floor", |_| number(*FLOOR, Scientific(6))),
    ("P6.3.converge", |study| {
        let rows = [row!(study.small_angle, Rk4), row!(study.small_angle, StormerVerlet)];
        let [coarse, fine] = [0, 4].map(|step| rows.map(|row| row.errors[step].formula / *FLOOR));
        let there = |ratio: f64| is_near(ratio, 1.0, 0.01);
        let ([a, b], [c, d]) = (fine, coarse);
        says(
            format!("{a:.3} and {b:.3}; {c:.1} and {d:.1}"),
            fine.into_iter().all(there) && !coarse.into_iter().any(there),
        )
    }),
    ("P6.3.norm", |_| number(largest_formula_error(1e-4, 0.01), Scientific(4))),
    ("P6.3.below", |_| {
        let error = largest_formula_error(1e-4, 0.01);
        shows(error, Scientific(4), error < 1e-6)
    }),
    ("P6.3.confirms", |_| {
        let [large, small] =
            [small_angle::THETA_0, 1e-4].map(|theta_0| largest_formula_error(theta_0, 0.01));
        shows(large / small, Scientific(2), large > 100.0 * small)
    }),
    ("P6.4.closed", |_| {
        let largest = gap_of_the_orbits(&InSteps(Rk4));
        shows(largest, Scientific(1), largest < LINE)
    }),
    ("P6.4.confirms", |_| {
        let others: [&dyn AnyMethod; 3] =
            [&InSteps(ForwardEuler), &InSteps(SymplecticEuler), &InSteps(StormerVerlet)];
        let gaps = others.map(gap_of_the_orbits);
        let met = gap_of_the_orbits(&InSteps(Rk4)) < LINE && gaps.into_iter().all(|gap| gap > LINE);
        show_all(gaps, Significant(1), met)
    }),
    ("P6.4.elong", |_| {
        let ratio = level_curves::PORTRAIT.map(|theta_0| {
            let orbit = level_curves::portrait(&InSteps(Rk4), theta_0);
            let fastest = orbit.iter().fold(0.0, |fastest: f64, z| fastest.max(z.omega.abs()));
            fastest / (Pendulum::PAPER.small_angle_frequency() * theta_0)
        });
        show_all(ratio, Fixed(3), ratio[0] < 1.0 && ratio.is_sorted_by(|a, b| a > b))
    }),
    ("P6.5.T", |study| number(study.large_angle.by_peak, Fixed(4))),
    ("P6.5.within", |study| {
        let percent = study.large_angle.percent(study.large_angle.by_peak);
        shows(percent, Significant(3), percent <= 0.001)
    }),
    ("P6.5.ratio", |study| {
        let periods = &study.large_angle;
        number(periods.exact / periods.small_angle, Fixed(6))
    }),
    ("P6.5.wave", |_| {
        let (beyond, _) = findings::waveform(3.0);
        shows(beyond, Fixed(2), beyond > 0.287)
    }),
    ("P6.6.dom", |_| {
        let [few, many] = [100, 400].map(verlet_over_rk4);
        says(format!("{few:.2} and {many:.1}"), few > 1.0 && many > 1.0)
    }),
    ("P6.6.high", |_| {
        let ratio = verlet_over_rk4(4000);
        shows(ratio, Fixed(0), ratio > 1.0)
    }),
    ("P6.6.34", |_| {
        let ratios =
            ["fe", "se", "vv"].map(|id| printed("T8.rk4.ms") / printed(&format!("T8.{id}.ms")));
        show_all(ratios, Fixed(2), ratios[..2].iter().all(|ratio| (3.0..=4.0).contains(ratio)))
    }),
    ("P6.6.best", |study| {
        let time = printed("T8.vv.ms") / printed("T8.rk4.ms");
        let error = |row: &work::Row| row.points[work::TABLE_8].1.formula;
        let error = error(row!(study.work, StormerVerlet)) / error(row!(study.work, Rk4));
        let [few, many] = [100, 400].map(verlet_over_rk4);
        let text = format!("{time:.2} and {error:.2}; {few:.2} and {many:.1}");
        says(text, time < 1.0 && error < 1.0 && few < 1.0)
    }),
    ("P6.6.33", |_| number(printed("T8.rk4.ms") / printed("T8.fe.ms"), Fixed(2))),
    ("P6.6.120", |study| {
        let error = |id| {
            let row = study.work.iter().find(|row| PaperMethod::of(row.method) == Some(id));
            row.map_or(f64::NAN, |row| row.points[work::TABLE_8].1.formula)
        };
        number(error(PaperMethod::ForwardEuler) / error(PaperMethod::Rk4), Fixed(1))
    }),
    ("P6.6.pareto", |_| {
        let point = |id| ["ms", "rms"].map(|column| printed(&format!("T8.{id}.{column}")));
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
];

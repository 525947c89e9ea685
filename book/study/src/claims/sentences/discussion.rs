//! Discussion and conclusion, Sections 7 and 8; the figures; and what the numbers decide where the
//! text leaves it open.

use super::*;
use pendula::registry::InSteps;

pub(super) const MEASURED: &[(&str, Measure)] = &[
    ("P7.1.kin", |study| {
        let omega = row!(study.long_run, ForwardEuler).end.omega;
        let all = Pendulum::PAPER.energy(pendula::Phase::at_rest(long_run::THETA_0));
        let ratio = 0.5 * omega * omega / all;
        shows(ratio, Fixed(0), ratio > 10.0)
    }),
    ("P7.1.divergent", |study| {
        let run = row!(study.long_run, ForwardEuler).percent_of_initial() / 100.0;
        let half_a_turn = core::f64::consts::PI / 0.1;
        let locked = 0.5 * half_a_turn * half_a_turn;
        let [short, long] = [100_000, 1_000_000]
            .map(|steps| findings::energy_drift(&InSteps(ForwardEuler), 1.0, 0.1, steps) / locked);
        says(format!("{run:.1}; {short:.2} and {long:.2}"), run > 1.0)
    }),
    ("P7.1.surface", |study| {
        let runs = [row!(study.long_run, SymplecticEuler), row!(study.long_run, StormerVerlet)];
        let [euler, verlet] = runs.map(|run| Fixed(3).print(run.last));
        let start = Fixed(3).print(runs[0].initial);
        let met = euler == start && verlet == start;
        says(format!("{euler} and {verlet}; {start}"), met)
    }),
    ("P7.1.modest", |_| {
        let start = Pendulum::PAPER.energy(Phase::at_rest(1.0));
        let [coarse, fine] = [(0.1, 1.0), (0.01, 1e3)].map(|(step, times)| {
            let lost = start - findings::last_energy(&InSteps(Rk4), 1.0, step, 1_000_000);
            times * lost / findings::energy_drift(&InSteps(SymplecticEuler), 1.0, step, 100_000)
        });
        says(format!("{coarse:.1} and {fine:.2}"), coarse > 1.0)
    }),
    ("P7.1.construction", |_| {
        let found = [0.1, 1.5].map(|k| escapes(&InSteps(StormerVerlet), k));
        let text = found.map(|escapes| if escapes { "wanders off" } else { "stays" });
        says(text.join(" and "), !found[0])
    }),
    ("P7.1.fe1000", |study| {
        number(row!(study.long_run, ForwardEuler).percent_of_initial(), Significant(5))
    }),
    ("P7.2.precise", orders_confirmed),
    ("P7.2.accuracy", |study| {
        let [rk4, verlet] = [
            row!(study.convergence, Rk4).drift[4],
            row!(study.convergence, StormerVerlet).drift[4],
        ];
        shows(rk4 / verlet, Scientific(1), rk4 < verlet)
    }),
    ("P7.3.all", |study| {
        let coarse = [
            row!(study.small_angle, ForwardEuler).errors[4].formula,
            row!(study.small_angle, SymplecticEuler).errors[4].formula,
        ];
        let methods: [&dyn AnyMethod; 2] = [&InSteps(ForwardEuler), &InSteps(SymplecticEuler)];
        let fine = methods.map(|method| {
            let theta_0 = small_angle::THETA_0;
            findings::normalised_formula_error(method, theta_0, 1e-5).1 * theta_0
        });
        let [[a, b], [c, d]] = [coarse, fine].map(|errors| errors.map(|error| error / *FLOOR));
        let there = is_near(a, 1.0, 0.1) && is_near(b, 1.0, 0.1);
        says(format!("{a:.1} and {b:.2}; {c:.3} and {d:.3}"), there)
    }),
    ("P7.4.se", |study| {
        let own = row!(study.characteristics, SymplecticEuler).evaluations;
        let rows = study.characteristics.iter();
        let least = rows.filter(|row| PaperMethod::of(row.method).is_some());
        let cheapest = least.fold(f64::INFINITY, |least, row| least.min(row.evaluations));
        shows(own, Fixed(0), own == 1.0 && own <= cheapest)
    }),
    ("P7.4.guaranteed", |_| alone_bounded(BOUNDED[0])),
    ("P7.4.rk4", |_| {
        let largest = rk4_over_the_next_in_a_step();
        shows(largest, Significant(1), largest < 1.0)
    }),
    ("P7.4.caveat", |_| {
        let drift = |steps| findings::energy_drift(&InSteps(Rk4), 1.0, 0.01, steps);
        let ratio = drift(100_000) / drift(10_000);
        shows(ratio, Fixed(2), ratio > 5.0)
    }),
    ("P7.5.dissipation", |_| {
        let [free, damped] = findings::verlet_over_rk4_damped();
        let differs = !is_near(damped / free, 1.0, 0.1);
        says(format!("{free:.1} and {damped:.1}"), differs)
    }),
    ("P7.5.adaptive", |_| numbers_met()),
    ("P7.5.superior", |_| {
        let ratios = findings::adaptive_over_fixed();
        show_all(ratios, Significant(1), ratios.into_iter().any(|ratio| ratio < 1.0))
    }),
    ("P7.5.primary", |study| {
        let euler = row!(study.characteristics, ForwardEuler);
        let symplectic = row!(study.characteristics, SymplecticEuler);
        let [a, b] = [euler, symplectic].map(|row| Fixed(5).print(row.area_defect.abs()));
        says(format!("{a} and {b}"), !euler.symplectic() && symplectic.symplectic())
    }),
    ("P8.order", orders_confirmed),
    ("P8.validates", |study| {
        let others: [&dyn AnyMethod; 2] = [&InSteps(StormerVerlet), &InSteps(SymplecticEuler)];
        let away = |period: f64| (period - study.large_angle.exact).abs();
        let rk4 = away(study.large_angle.by_peak);
        let others = others.map(|method| away(large_angle::period_by_peak(method)));
        let ms = |away: f64| format!("{:.3}", 1e3 * away);
        let text = format!("{}; {} and {}", ms(rk4), ms(others[0]), ms(others[1]));
        let within = |away: f64| away <= 0.5 * large_angle::STEP;
        says(text, within(rk4) && !others.into_iter().any(within))
    }),
    ("P8.equations", |study| {
        let slow = Pendulum::new(9.80, 1.0, 1.0).expect("a pendulum");
        let slow = exact::period(&slow, large_angle::THETA_0).unwrap_or(f64::NAN);
        let periods = &study.large_angle;
        let off = [periods.small_angle, slow].map(|period| periods.percent(period));
        show_all(off, Significant(2), off.into_iter().all(|percent| percent > 0.001))
    }),
    ("P8.reproducible", |_| numbers_met()),
    ("P8.yoshida", |_| {
        let slope = Ladder::measure(&InSteps(ForestRuth)).slopes().last().unwrap_or(f64::NAN);
        let z = Phase { theta: 1.0, omega: 0.5 };
        let defect = area_defect(&InSteps(ForestRuth), &Pendulum::PAPER, z, AREA_STEP).abs();
        let text = format!("{slope:.2}; {}", below(AREA_TOLERANCE, defect));
        says(text, confirms((slope, slope), 4.0) && defect < AREA_TOLERANCE)
    }),
    ("P8.bounded", bounded),
    ("F4", |_| {
        let turns = turning_points_of_figure_4();
        let (first, last) = (turns[0].1.abs(), turns[turns.len() - 1].1.abs());
        let grows = turns.windows(2).all(|two| two[0].1.abs() < two[1].1.abs());
        shows(last / first, Fixed(2), turns.len() > 2 && grows)
    }),
    ("F4b", |study| {
        let gained = [row!(study.long_run, ForwardEuler), row!(study.long_run, Rk4)]
            .map(|run| run.last - run.initial);
        show_all(gained, Significant(2), gained.into_iter().all(|gained| gained > 0.0))
    }),
    ("F4c", |_| {
        let turns = turning_points_of_figure_4();
        let (gained, theta) = turns[turns.len() - 1];
        let depth = Pendulum::PAPER.depth();
        let ratio = depth * (cos(small_angle::THETA_0) - cos(theta)) / gained;
        shows(ratio, Fixed(3), is_near(ratio, 1.0, 0.01))
    }),
    ("X.order_variant", |_| {
        let methods: [&dyn AnyMethod; 2] = [&InSteps(SymplecticEuler), &DriftKick];
        let errors = methods.map(|method| {
            findings::normalised_formula_error(method, 0.05, 0.1).1 * small_angle::THETA_0
        });
        let met = errors.map(|error| prints_as("T6.se.0.1", error));
        show_all(errors, Scientific(3), met == [true, false])
    }),
    ("X.verlet_variant", |_| {
        let methods: [&dyn AnyMethod; 2] = [&InSteps(StormerVerlet), &InSteps(PositionVerlet)];
        let drifts = methods.map(|method| convergence::drift(method, 0.1));
        let met = drifts.map(|drift| prints_as("T4.vv.0.1", drift));
        show_all(drifts, Scientific(3), met == [true, false])
    }),
    ("X.bold", |study| {
        let best = |step: usize, error: &dyn Fn(&small_angle::Row) -> f64| {
            let rows = study.small_angle.iter();
            let best = rows.min_by(|a, b| error(a).total_cmp(&error(b)));
            (step, best.map_or("", |row| row.method.info().title))
        };
        let columns = || 0..STEPS.len();
        let found: Vec<_> =
            columns().map(|step| best(step, &|row| row.errors[step].formula)).collect();
        let stated: Vec<_> =
            columns().map(|step| best(step, &|row| printed(&cell_of_table_6(row, step)))).collect();
        let titles: Vec<&str> = found.iter().map(|(_, title)| *title).collect();
        says(titles.join(", "), found == stated)
    }),
];

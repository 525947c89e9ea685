//! Abstract to experimental set-up: Sections 1 to 5 and the tables of parameters.

use super::*;
use pendula::registry::InSteps;

pub(super) const MEASURED: &[(&str, Measure)] = &[
    ("T1.g", |_| number(-printed("T5.fe.H0") / cos(long_run::THETA_0), Fixed(2))),
    ("T1.units_H", |_| {
        let long = Pendulum::new(9.81, 3.0, 1.0).expect("a pendulum");
        let [paper, long] = [Pendulum::PAPER, long].map(|it| hamilton_over_newton(&it));
        says(format!("{paper:.4} and {long:.4}"), is_near(paper, 1.0, 1e-6))
    }),
    ("T3.g", |_| number(squared_frequency_of_t_0(), Fixed(3))),
    ("T3.L", |_| number(9.81 / squared_frequency_of_t_0(), Fixed(3))),
    ("T3.m", |_| number(-printed("T5.fe.H0") / (9.81 * cos(long_run::THETA_0)), Fixed(3))),
    ("T3.omega0", |_| {
        let energy = [0.0, 0.05].map(|omega| {
            Pendulum::PAPER.energy_from_pivot(Phase { theta: long_run::THETA_0, omega })
        });
        let met = energy.map(|energy| prints_as("T5.fe.H0", energy));
        show_all(energy, Fixed(3), met == [true, false])
    }),
    ("A.dts", |study| {
        let met = |step: &usize| study.small_angle.iter().all(|row| meets_table_6(row, *step));
        number((0..STEPS.len()).filter(met).count() as f64, Fixed(0))
    }),
    ("A.tspan", |study| {
        let grid = Grid::with_duration(long_run::STEP, long_run::DURATION);
        let duration = grid.map_or(f64::NAN, |grid| grid.time(grid.steps()));
        let met = prints_as("T5.fe.Hend", row!(study.long_run, ForwardEuler).last);
        shows(duration, Fixed(0), met && duration == 1000.0)
    }),
    ("A.bounded", bounded),
    ("A.verlet_pct", |study| {
        number(row!(study.long_run, StormerVerlet).percent_of_initial(), Significant(5))
    }),
    ("A.rk4_order", |study| {
        let order = row!(study.characteristics, Rk4).order();
        shows(order, Fixed(2), confirms((order, order), 4.0))
    }),
    ("A.optimal", |study| {
        let methods: [(&dyn AnyMethod, f64); 3] = [
            (&InSteps(StormerVerlet), 1.0),
            (&InSteps(Rk4), 4.0),
            (&InSteps(BlanesMoanSrkn6b), 6.0),
        ];
        let [verlet, others @ ..] =
            methods.map(|(method, evaluations)| errors_for_work(method, evaluations));
        let energy = others.map(|[energy, _]| energy / row!(study.long_run, StormerVerlet).drift);
        let angle = others.map(|[_, angle]| angle / verlet[1]);
        let [in_energy, in_angle] = [energy, angle]
            .map(|ratios| ratios.map(|ratio| Significant(2).print(ratio)).join(" and "));
        let text = format!("in the energy {in_energy}, in the angle {in_angle}");
        says(text, energy.into_iter().chain(angle).all(|ratio| ratio > 1.0))
    }),
    ("A.guarantees", |_| alone_bounded(BOUNDED[1])),
    ("P1.systematic", |_| {
        let methods: [&dyn AnyMethod; 3] =
            [&InSteps(ForwardEuler), &InSteps(Rk4), &InSteps(Gauss4)];
        let [euler, rk4, gauss] = methods.map(|method| {
            let drift = |steps| findings::energy_drift(method, 1.0, 0.01, steps);
            drift(100_000) / drift(10_000)
        });
        let is_systematic = |growth: f64| growth > libm::sqrt(10.0);
        let text = format!("{euler:.2} and {rk4:.2}; {gauss:.2}");
        says(text, is_systematic(euler) && is_systematic(rk4))
    }),
    ("P1.qualitative", |study| {
        let ratio = row!(study.long_run, ForwardEuler).last / Pendulum::PAPER.depth();
        shows(ratio, Significant(3), ratio > 1.0)
    }),
    ("A.period", |study| {
        let periods = &study.large_angle;
        number(periods.percent(periods.by_peak), Significant(6))
    }),
    ("A.dt2", |study| {
        let range = order_range(study, PaperMethod::StormerVerlet);
        shows(range.0, Fixed(3), confirms(range, 2.0))
    }),
    ("P1.orders", orders_confirmed),
    ("P1.three_orders", |study| {
        let euler = row!(study.long_run, ForwardEuler).drift;
        let ratios = [
            euler / row!(study.long_run, SymplecticEuler).drift,
            euler / row!(study.long_run, StormerVerlet).drift,
        ];
        show_all(ratios, Scientific(3), ratios.into_iter().all(|ratio| ratio >= 1e3))
    }),
    ("P1.single", |_| {
        let compared = ["Euler, RK4, and scipy.odeint", "Euler, midpoint, and Verlet"];
        let counts = compared.map(|methods| methods.split(", ").count());
        says(format!("{} and {}", counts[0], counts[1]), counts == [1, 1])
    }),
    ("P2.alltime", |_| {
        let [coarse, fine] = [1e-2, 1e-4].map(findings::energy_error_of_a_fall);
        let ratio = fine / coarse;
        shows(ratio, Fixed(0), ratio < 1e-3)
    }),
    ("P3.eq1", |_| {
        let left = left_of_the_equations();
        // The differences leave h²/12 of the fourth derivative: 4e-6 at 3 rad.
        shows(left, Significant(1), left < 1e-5)
    }),
    ("P3.constant", |_| {
        let change = change_of_the_energy();
        says(below(1e-13, change), change < 1e-13)
    }),
    ("P3.eq5", |_| {
        let apart = [0.05, 1.0, 2.0, 3.0]
            .map(|theta_0| (period_of_a_run(theta_0) / period_of_eq_5(theta_0) - 1.0).abs());
        let largest = apart.into_iter().fold(0.0, libm::fmaximum);
        says(below(1e-10, largest), largest < 1e-10)
    }),
    ("P3.eq4", |_| {
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
    ("P4.identical", |_| {
        let shown = ["T4.", "T5.", "T6.", "T8."].map(columns_of_methods);
        let alike = |columns: &Vec<Vec<&str>>| columns.windows(2).all(|two| two[0] == two[1]);
        let counts = shown.each_ref().map(|columns| columns.len().to_string()).join(", ");
        says(counts, shown.iter().all(alike))
    }),
    ("P4.rk4_lte", |_| {
        let slope = findings::one_step_slope(&InSteps(Rk4)) - 1.0;
        shows(slope, Fixed(1), is_near(slope, 4.0, 0.15))
    }),
    ("P4.rk4_evals", |study| number(row!(study.characteristics, Rk4).evaluations, Fixed(0))),
    ("P4.rk4_alg", |_| {
        let steps = &STEPS[..4];
        let met =
            |step: &&f64| prints_as(&format!("T4.rk4.{step}"), energy_error_of_algorithm_1(**step));
        let count = steps.iter().filter(met).count();
        says(format!("{count} of {}", steps.len()), count == steps.len())
    }),
    ("P4.vv_evals", |study| {
        number(row!(study.characteristics, StormerVerlet).evaluations, Fixed(0))
    }),
    ("P4.vv_twoform", |_| {
        let defects = [1.0, 2.0, 4.0].into_iter().flat_map(|ratio: f64| {
            let h = ratio * AREA_STEP;
            cases().map(move |(pendulum, z)| {
                area_defect(&InSteps(StormerVerlet), &pendulum, z, h).abs()
            })
        });
        let largest = defects.fold(0.0, libm::fmaximum);
        says(below(AREA_TOLERANCE, largest), largest < AREA_TOLERANCE)
    }),
    ("P4.vv_half", |_| {
        let apart = equations_10_to_12_from_half_kicks();
        says(below(1e-11, apart), apart < 1e-11)
    }),
    ("P4.fe_nonsymp", |study| {
        let defect = row!(study.characteristics, ForwardEuler).area_defect;
        shows(defect, Fixed(5), defect.abs() > AREA_TOLERANCE)
    }),
    ("P4.se_change", |study| {
        let new = row!(study.characteristics, SymplecticEuler);
        let old = row!(study.characteristics, ForwardEuler);
        let [a, b] = [new, old].map(|row| Fixed(5).print(row.area_defect.abs()));
        says(format!("{a} and {b}"), new.symplectic() && !old.symplectic())
    }),
    ("P4.se_symp", |_| {
        let growth = [0.01, 0.001].map(findings::growth_on_a_falling_stone);
        let bounded = growth.into_iter().all(|growth| has_not_grown(growth, 1.0));
        show_all(growth, Fixed(0), bounded)
    }),
    ("P5.metric_pct", |study| {
        let rows = [
            ("T5.fe.pct", row!(study.long_run, ForwardEuler).percent_of_initial()),
            ("T5.se.pct", row!(study.long_run, SymplecticEuler).percent_of_initial()),
            ("T5.vv.pct", row!(study.long_run, StormerVerlet).percent_of_initial()),
        ];
        let met = rows.into_iter().all(|(cell, percent)| prints_as(cell, percent));
        show_all(rows.map(|(_, percent)| percent), Significant(5), met)
    }),
    ("P5.metric_rms", |study| {
        let cells =
            || study.small_angle.iter().flat_map(|row| (0..STEPS.len()).map(move |i| (row, i)));
        let over_samples = cells().filter(|(row, step)| meets_table_6(row, *step)).count();
        let over_steps = cells().filter(|(row, step)| {
            let steps = small_angle::DURATION / STEPS[*step];
            let error = row.errors[*step].formula * libm::sqrt((steps + 1.0) / steps);
            prints_as(&cell_of_table_6(row, *step), error)
        });
        let text = format!("{over_samples} and {} of 20", over_steps.count());
        says(text, over_samples == 20)
    }),
];

//! Tables that are made here, and what is said of them.

use super::candidates::{Candidate, Equation, named};
use super::*;

const PENDULUM: Equation = Equation { force: Force::Sine, k: 9.8, c: 0.0, drive: [0.0; 3] };

/// Rows of a run from 1 rad: times and states.
fn run(name: &str, equation: &Equation, h: f64, every: u32, rows: usize) -> Vec<[f64; 3]> {
    let candidate: &Candidate = named(name).unwrap();
    let mut z = [1.0, 0.0];
    (0..rows)
        .map(|n| {
            let t = n as f64 * h * f64::from(every);
            let row = [t, z[0], z[1]];
            z = candidate.run(equation, t, z, h, every);
            row
        })
        .collect()
}

fn text(rows: &[[f64; 3]], digits: usize) -> String {
    let line = |[t, theta, omega]: &[f64; 3]| format!("{t:.4},{theta:.digits$},{omega:.digits$}\n");
    "t,theta,omega\n".to_string() + &rows.iter().map(line).collect::<String>()
}

fn report(text: &str) -> RunReport {
    identify(text.as_bytes()).unwrap_or_else(|refusal| panic!("{refusal:?}"))
}

fn method(report: &RunReport) -> (&str, u32) {
    let Maker::Method(made) = &report.maker else { panic!("{report}") };
    (made.name, made.steps)
}

/// Catches: a step or a number of steps that is found wrong, a fit of k or c that is off, a mistake
/// that is taken for its method.
#[test]
fn methods_and_mistakes_are_named() {
    let damped = Equation { c: 0.1, ..PENDULUM };
    for (name, equation, h, every, digits) in [
        ("symplectic-euler", PENDULUM, 0.01, 1, 4),
        ("forward-euler", damped, 0.02, 1, 6),
        ("stormer-verlet", PENDULUM, 0.01, 10, 10),
        ("heun", PENDULUM, 0.02, 3, 9),
        ("rk4-fourth-stage-from-second-slope", PENDULUM, 0.05, 1, 9),
        ("backward-euler", PENDULUM, 0.01, 1, 6),
        ("rk4", PENDULUM, 0.1, 1, 13),
    ] {
        let found = report(&text(&run(name, &equation, h, every, 200), digits));
        assert_eq!(method(&found), (name, every), "{found}");
        let Some(FoundEquation { k, damping, .. }) = found.equation else { panic!() };
        assert!((k.value - 9.8).abs() <= k.known_to && k.known_to < 0.01, "{k:?}");
        let c = damping.map_or(0.0, |c| c.value);
        let to = damping.map_or(1e-12, |c| c.known_to);
        assert!((c - equation.c).abs() <= to, "{damping:?}");
    }
}

/// Catches: a name where the digits do not tell.
#[test]
fn what_cannot_be_told_is_not_named() {
    let found = report(&text(&run("rk4", &PENDULUM, 0.01, 1, 200), 6));
    assert!(matches!(found.maker, Maker::Several { exact: Some(_), .. }), "{found}");
    // By angles alone these three are one recurrence.
    let rows = run("stormer-verlet", &PENDULUM, 0.05, 1, 200);
    let alone: String = rows.iter().map(|[t, theta, _]| format!("{t:.2} {theta:.8}\n")).collect();
    let found = report(&alone);
    let Maker::Several { methods, by, .. } = &found.maker else { panic!("{found}") };
    for name in ["stormer-verlet", "symplectic-euler", "symplectic-euler-drift-first"] {
        assert!(methods.iter().any(|made| made.name == name), "{found}");
    }
    assert!(by.contains(&Distinguish::Velocity));
}

/// Catches: a fault of the rows that is not seen, or seen in another row, or that hides the method.
#[test]
fn faults_of_the_rows_are_told_by_their_row() {
    let rows = run("stormer-verlet", &PENDULUM, 0.05, 1, 100);
    type Change = fn(&mut Vec<[f64; 3]>);
    let cases: [(Change, Fault); 8] = [
        (|rows| rows.retain(|row| row[0] != 2.0), Fault::Missing { after: 40, rows: 1 }),
        (|rows| rows[40][1] += 0.01, Fault::Edited { row: 41 }),
        (|rows| rows[40][2] = f64::NAN, Fault::NoNumber { row: 41 }),
        (
            |rows| {
                (40..99).for_each(|i| (rows[i][1], rows[i][2]) = (rows[i + 1][1], rows[i + 1][2]))
            },
            Fault::TimesLate { row: 41, by: 1 },
        ),
        (
            |rows| (0..99).for_each(|i| rows[i][2] = rows[i + 1][2]),
            Fault::VelocityShifted { rows: 1 },
        ),
        (|rows| rows[40][0] += 0.013, Fault::TimeOff { row: 41 }),
        // The same row twice.
        (|rows| rows.insert(41, rows[40]), Fault::TimeRepeated { row: 42 }),
        (|rows| rows.insert(41, rows[40]), Fault::StateRepeated { row: 42 }),
    ];
    for (change, fault) in cases {
        let mut rows = rows.clone();
        change(&mut rows);
        if matches!(fault, Fault::TimesLate { .. } | Fault::VelocityShifted { .. }) {
            rows.truncate(99);
        }
        let found = report(&text(&rows, 9));
        assert!(found.faults.contains(&fault), "{fault:?}: {found}");
        assert_eq!(method(&found).0, "stormer-verlet", "{fault:?}: {found}");
    }
    let mut twice = rows;
    twice.insert(41, twice[40]);
    let said = report(&text(&twice, 9)).to_string();
    // No more of it, as its state may be the same or another.
    assert!(said.contains("Row 42 has the time of the row before.\n"), "{said}");
}

/// Catches: degrees taken for radians, x and y for an angle and its rate, full turns that are lost.
#[test]
fn units_and_turns_are_seen() {
    let rows = run("stormer-verlet", &PENDULUM, 0.05, 1, 100);
    let degrees: Vec<_> =
        rows.iter().map(|[t, a, b]| [*t, a.to_degrees(), b.to_degrees()]).collect();
    let found = report(&text(&degrees, 9).replace("t,theta,omega\n", ""));
    assert_eq!((found.read.unit, method(&found).0), (Unit::Degrees, "stormer-verlet"));
    let point = |[t, a, _]: &[f64; 3]| format!("{t:.2};{:.10};{:.10}\n", a.sin(), -a.cos());
    let points: String = rows.iter().map(point).collect();
    let found = report(&points);
    assert_eq!(found.read.unit, Unit::Coordinates, "{found}");
    let k = found.equation.unwrap().k;
    assert!((k.value - 9.8).abs() <= k.known_to, "{k:?}");

    let fast = Equation { k: 1.0, ..PENDULUM };
    let mut z = [0.0, 3.0];
    let mut turned = String::new();
    for n in 0..300 {
        let wrapped = z[0] - core::f64::consts::TAU * (z[0] / core::f64::consts::TAU).round();
        turned += &format!("{:.2} {wrapped:.9} {:.9}\n", 0.05 * f64::from(n), z[1]);
        z = named("stormer-verlet").unwrap().run(&fast, 0.0, z, 0.05, 1);
    }
    let found = report(&turned);
    assert!(matches!(found.faults[..], [Fault::Wrapped { .. }]), "{found}");
    assert_eq!(method(&found).0, "stormer-verlet");
}

/// Catches: noise that is given a method, rows of something else that are given an equation, bad
/// input that is no refusal.
#[test]
fn what_no_program_made_is_said_to_be_that() {
    let mut noise = fastrand::Rng::with_seed(7);
    let mut gauss = || 0.002 * ((0..12).map(|_| noise.f64()).sum::<f64>() - 6.0);
    let mut rows = run("dormand-prince-8", &Equation { c: 0.05, ..PENDULUM }, 0.02, 1, 400);
    rows.iter_mut().for_each(|row| row[1] += gauss());
    let alone: String = rows.iter().map(|[t, theta, _]| format!("{t:.2},{theta:.5}\n")).collect();
    let found = report(&alone);
    let Maker::Measured { noise } = found.maker else { panic!("{found}") };
    assert!((noise / 0.002 - 1.0).abs() < 0.2, "{noise}");
    let k = found.equation.unwrap().k;
    assert!((k.value - 9.8).abs() < 0.05, "{k:?}");

    for (text, refusal) in [
        ("", Refusal::Empty),
        ("t,theta\n0,1\n", Refusal::OneRow),
        ("0 1\n1 1\n2 1\n3 1\n", Refusal::NoMotion),
        ("0 1\n1 0.9\n2 0.7\n", Refusal::TooFewRows { rows: 3, needed: 7 }),
    ] {
        assert_eq!(identify(text.as_bytes()), Err(refusal), "{text}");
    }
}

/// Catches: a drive that is taken for a method's error, or whose numbers are wrong.
#[test]
fn a_drive_is_found() {
    let driven = Equation { c: 0.2, drive: [1.5, 0.0, 2.0], ..PENDULUM };
    let found = report(&text(&run("stormer-verlet", &driven, 0.05, 1, 300), 9));
    let Some([a, frequency, phase]) = found.equation.and_then(|equation| equation.drive) else {
        panic!("{found}")
    };
    for (found, expected) in [(a, 1.5), (frequency, 2.0), (phase, 0.0)] {
        assert!((found.value - expected).abs() < 1e-5, "{found:?}");
    }
    assert_eq!(method(&found).0, "stormer-verlet", "{found}");
}

/// Catches: a decimal comma taken for a separator, a heading or more columns that lead astray,
/// degrees under another language's words, a unit of time that is lost.
#[test]
fn tables_are_read_as_people_write_them() {
    let rows = run("stormer-verlet", &PENDULUM, 0.05, 1, 60);
    type Line = fn(usize, &[f64; 3]) -> String;
    let cases: [(&str, Line, Unit); 7] = [
        (
            "Zeit in s;Auslenkung in °;Winkelgeschwindigkeit\r\n",
            |_, [t, a, b]| {
                format!("{t:.2};{:.9};{:.9}\r\n", a.to_degrees(), b.to_degrees()).replace('.', ",")
            },
            Unit::Degrees,
        ),
        ("時間\t角度\t角速度\n", |_, [t, a, b]| format!("{t:.2}\t{a:.9}\t{b:.9}\n"), Unit::Radians),
        ("", |n, [t, a, b]| format!("{n} {t:.2} {a:.9} {b:.9} {:.5}\n", b * b), Unit::Radians),
        (
            "step,kinetic,omega,theta,time\n",
            |n, [t, a, b]| format!("{n},{:.6},{b:.9},{a:.9},{t:.2}\n", 0.5 * b * b),
            Unit::Radians,
        ),
        (
            "t (ms) | θ (deg) | ω (rad/s)\n",
            |_, [t, a, b]| format!("{:.0} | {:.9} | {b:.9}\n", 1000.0 * t, a.to_degrees()),
            Unit::Degrees,
        ),
        (
            "temps angle vitesse\n",
            |_, [t, a, b]| format!("{t:.6e} {a:.12e} {b:.12e}\n"),
            Unit::Radians,
        ),
        ("# a run\n\n", |_, [t, a, b]| format!("({t}, {a}, {b}),\n"), Unit::Radians),
    ];
    for (heading, line, unit) in cases {
        let lines: String = rows.iter().enumerate().map(|(n, row)| line(n, row)).collect();
        let found = report(&(heading.to_string() + &lines));
        assert_eq!(found.read.unit, unit, "{heading}: {found}");
        assert_eq!(method(&found), ("stormer-verlet", 1), "{heading}: {found}");
        let k = found.equation.unwrap().k;
        assert!((k.value - 9.8).abs() < 1e-3, "{heading}: {k:?}");
    }
}

/// Rows of a method of order 2 that is in no table: its second stage is at 0.7 of the step.
fn unknown(digits: usize, rows: usize) -> String {
    let rate = |[q, p]: [f64; 2]| [p, -9.8 * q.sin()];
    let (h, mut z, mut text) = (0.05, [2.8, 3.0], String::from("t,theta,omega\n"));
    for n in 0..rows {
        text += &format!("{:.2},{:.digits$},{:.digits$}\n", h * n as f64, z[0], z[1]);
        let [a, b] = rate(z);
        let [c, d] = rate([z[0] + 0.7 * h * a, z[1] + 0.7 * h * b]);
        z = [z[0] + h * (0.3 * a + 0.7 * c), z[1] + h * (0.3 * b + 0.7 * d)];
    }
    text
}

/// Catches: a program's own error that is taken for noise, a neighbour's name for what is in no
/// table, a fault in rows that nobody has touched.
#[test]
fn an_unknown_program_is_given_no_name_and_no_noise() {
    for (digits, rows) in [(3, 60), (4, 200), (9, 200)] {
        let found = report(&unknown(digits, rows));
        assert!(
            matches!(found.maker, Maker::Unknown { .. } | Maker::Several { .. }),
            "{digits} digits: {found}"
        );
        assert!(found.faults.is_empty(), "{digits} digits: {found}");
    }
}

/// Catches: what rounding leaves in single precision, or in numbers that were rounded and printed
/// with more digits, taken for a mistake or for noise.
#[test]
fn rounding_before_the_print_is_seen() {
    let (mut q, mut p, h) = (1.0_f32, 0.0_f32, 0.02_f32);
    let (mut long, mut short) = (String::new(), String::new());
    for n in 0..200 {
        let t = 0.02 * f64::from(n);
        long += &format!("{t:.2} {:.17} {:.17}\n", f64::from(q), f64::from(p));
        short += &format!("{t:.2} {q} {p}\n");
        p -= h * 9.8 * q.sin();
        q += h * p;
    }
    let rows = run("symplectic-euler", &PENDULUM, 0.02, 1, 200);
    let padded: String =
        rows.iter().map(|[t, a, b]| format!("{t:.2} {a:.4}000 {b:.4}000\n")).collect();
    for text in [long, short, padded] {
        let found = report(&text);
        assert_eq!(method(&found), ("symplectic-euler", 1), "{found}");
    }
}

/// Catches: a method that is looked for where no steps of one length lead from row to row, and an
/// equation that is not found there.
#[test]
fn uneven_times_are_told() {
    let mut noise = fastrand::Rng::with_seed(3);
    let (mut t, mut z, mut text) = (0.0, [1.0, 0.0], String::new());
    for _ in 0..100 {
        text += &format!("{t:.9} {:.9} {:.9}\n", z[0], z[1]);
        let h = 0.02 + 0.05 * noise.f64();
        z = named("dormand-prince-8").unwrap().run(&PENDULUM, t, z, h / 4.0, 4);
        t += h;
    }
    let found = report(&text);
    assert_eq!(found.faults, [Fault::Uneven], "{found}");
    assert!(matches!(found.maker, Maker::Several { exact: Some(_), .. }), "{found}");
    let k = found.equation.unwrap().k;
    assert!((k.value - 9.8).abs() <= k.known_to && k.known_to < 1e-5, "{k:?}");
}

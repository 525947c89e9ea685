//! Systems beyond the pendulum on the command line, and the methods that suit them.

use pendula::methods::Gauss6;
use pendula::systems::{Damped, Driven, Joint, Shaken};
use pendula::{
    Counting, DoublePendulum, Grid, Info, METHODS, Method, Pendulum, Phase, Rk4, StormerVerlet,
    System, for_each_general_method, integrate, methods,
};

use crate::call::{assert_refused, json, numbers, pendula, printed, words};

const SCENE: &str = "--theta0 1.2 --omega0 -0.3 --gravity 4 --length 2 --mass 3 --dt 0.05";

/// The pendulum of the scene.
fn pendulum() -> Pendulum {
    Pendulum::new(4.0, 2.0, 3.0).unwrap()
}

/// The rows of 40 steps, and the force evaluations.
fn rows<S, M>(system: S, method: &M) -> (Vec<Vec<f64>>, u64)
where
    S: System<State = Phase>,
    M: Method<Counting<S>>,
{
    let mut rows = Vec::new();
    let counting = Counting::new(system);
    let start = Phase { theta: 1.2, omega: -0.3 };
    integrate(&counting, method, start, &Grid::new(0.05, 40).unwrap(), &mut |_, t, z: Phase| {
        rows.push(vec![t, z.theta, z.omega, pendulum().energy_from_pivot(z)]);
    });
    (rows, counting.evaluations())
}

/// Catches: a parameter ignored, or taken for another; another system or method than was asked for;
/// rows under other names; evaluations of another system; a summary that speaks of an energy error.
#[test]
fn each_system_is_what_the_library_integrates() {
    let damped = Damped::new(pendulum(), 0.3).unwrap();
    let driven = Driven::new(damped, 1.1, 2.5).unwrap();
    let undamped = Driven::new(Damped::new(pendulum(), 0.0).unwrap(), 1.1, 2.5).unwrap();
    let shaken = Shaken::new(pendulum(), 0.4, 9.0).unwrap();
    let drive = "--drive-strength 1.1 --drive-frequency 2.5";
    for (system, method, expected) in [
        ("damped --damping 0.3".to_owned(), "rk4", rows(damped, &Rk4)),
        ("damped --damping 0.3".to_owned(), "stormer-verlet", rows(damped, &StormerVerlet)),
        (format!("driven --damping 0.3 {drive}"), "gauss-6", rows(driven, &Gauss6)),
        (format!("driven {drive}"), "rk4", rows(undamped, &Rk4)),
        (
            "shaken --pivot-amplitude 0.4 --pivot-frequency 9".to_owned(),
            "stormer-verlet",
            rows(shaken, &StormerVerlet),
        ),
    ] {
        let line = format!("simulate --method {method} --system {system} {SCENE} --steps 40");
        let words = words(&line);
        let (expected, evaluations) = expected;
        assert_eq!(numbers(&printed(&words)), expected, "{line}");
        let objects = json(&[&words[..], &["--format", "json"]].concat());
        assert_eq!(objects[40]["theta"].as_f64(), Some(expected[40][1]));
        let summary = pendula([&words[..], &["--summary"]].concat());
        let summary = String::from_utf8(summary.stderr).unwrap();
        let of = |name: &str| {
            let line = summary.lines().find_map(|line| line.strip_prefix(name));
            line.unwrap_or_else(|| panic!("{summary}")).trim().to_owned()
        };
        assert_eq!(of("force evaluations"), evaluations.to_string(), "{line}");
        assert!(of("energy at the end").contains(" J, of "), "{summary}");
        assert!(!summary.contains("energy error"), "{summary}");
    }
}

/// Catches: a method for the double pendulum that is another than was asked for, or one that mixes
/// up positions and momenta; one that suits and is refused, or does not and runs; a list in the
/// help that is another than what runs.
#[test]
fn the_double_pendulum_takes_the_methods_that_suit() {
    // Explicit and implicit Runge–Kutta methods: all that evaluate rates alone.
    const SUIT: [&str; 11] = [
        "forward-euler",
        "rk4",
        "explicit-midpoint",
        "heun",
        "dormand-prince",
        "dop853",
        "implicit-midpoint",
        "trapezoidal",
        "gauss-4",
        "gauss-6",
        "gauss-16",
    ];
    let run = words("simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 9");
    for method in METHODS.iter().map(|method| method.info().name) {
        let with = [&run[..], &["--method", method]].concat();
        if SUIT.contains(&method) {
            assert_eq!(numbers(&printed(&with)).len(), 10, "{method}");
        } else {
            assert_refused(&with, &format!("those that suit are {}", SUIT.join(", ")));
        }
    }
    let joint = Joint { length: 1.0, mass: 1.0 };
    let double = DoublePendulum::of_equals(Pendulum::PAPER.gravity(), joint).unwrap();
    let start = double.start([2.0, 1.0], [0.0, 0.0]).unwrap();
    let grid = Grid::new(0.01, 9).unwrap();
    let end = integrate(&double, &Gauss6, start, &grid, &mut ());
    let rows = numbers(&printed(&[&run[..], &["--method", "gauss-6"]].concat()));
    assert_eq!(rows[9][1..3], [end.theta1, end.theta2]);
    assert_eq!(printed(&run), printed(&[&run[..], &["--method", "rk4"]].concat()));
    let long = ["--dt", "0.3", "--method", "gauss-4", "--steps", "9"];
    let stopped = pendula([&run[..7], &long].concat());
    let reason = String::from_utf8(stopped.stderr).unwrap();
    assert_eq!(stopped.status.code(), Some(2), "{reason}");
    assert!(reason.contains("the iteration of gauss-4 does not converge"), "{reason}");
}

/// Where a run is lost does not depend on which of its rows are printed: by an iteration that does
/// not converge, and by numbers that overflow, both after the last of the rows.
///
/// Catches: a run of which only the printed rows are looked at.
#[test]
fn a_run_that_is_lost_after_its_last_row_is_refused() {
    let scenes = [
        ("simulate --method gauss-4 --theta0 3 --omega0 6 --dt 0.7 --steps 399", "not converge"),
        (
            "simulate --system double-pendulum --theta1 10 --theta2 16 --omega2 20 --dt 2 \
             --steps 390",
            "the range",
        ),
    ];
    for (scene, because) in scenes {
        for every in ["1", "100", "4068"] {
            let line = format!("{scene} --every {every}");
            let lost = pendula(words(&line));
            let reason = String::from_utf8(lost.stderr).unwrap();
            assert_eq!(lost.status.code(), Some(2), "{line}: {reason}");
            assert!(reason.contains(because), "{line}: {reason}");
        }
    }
}

/// Catches: a method that does not suit, refused without those that do.
#[test]
fn a_method_that_does_not_suit_a_system_is_refused() {
    macro_rules! general {
        ($($module:ident::$method:ident,)+) => {
            [$(methods::$method.info().name),+]
        };
    }
    let general = for_each_general_method!(general).join(", ");
    let taylor =
        format!("simulate --method taylor-24 {SCENE} --steps 4 --system damped --damping 1");
    let because = format!("the damped pendulum; those that suit are {general}");
    assert_refused(&words(&taylor), &because);
}

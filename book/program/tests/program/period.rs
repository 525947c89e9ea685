//! What `pendula exact` says of a motion.

use pendula::{Motion, Pendulum, Phase};

use crate::call::printed;

/// What is said of the motion, and the period (s).
fn motion(arguments: &[&str]) -> (String, Option<f64>) {
    let text = printed(&[&["exact"], arguments].concat());
    let line = |name: &str| text.lines().find_map(|line| line.strip_prefix(name));
    let period = line("T  ").map(|value| value.trim().trim_end_matches(" s").parse().unwrap());
    (line("motion  ").expect("a line on the motion").to_owned(), period)
}

/// Catches: an angle beyond π taken for rotation, or answered with the angle within a turn; turns
/// counted in the wrong direction; a rotation whose T is two turns; a T where nothing repeats;
/// T₀/T for T/T₀.
#[test]
fn the_motion_has_its_name() {
    let (said, _) = motion(&["--theta0", "3"]);
    assert_eq!(said, "libration between 3.0 rad and -3.0 rad");
    let (said, period) = motion(&["--theta0", "3.5"]);
    let other = 4.0 * std::f64::consts::PI - 3.5;
    let ends = said.strip_prefix("libration between 3.5 rad and ").unwrap();
    let (end, about) = ends.split_once(" rad, ").unwrap();
    assert_eq!(about, "about the lowest point 1 turn on");
    // The error of the closed form, and half an ε of a number up to 16.
    assert!((end.parse::<f64>().unwrap() - other).abs() < 4e-15, "{end} {other}");
    assert!(
        (period.unwrap() / pendula::exact::period(&Pendulum::PAPER, 3.5).unwrap() - 1.0).abs()
            < 1e-15
    );
    assert!(motion(&["--theta0", "-10"]).0.ends_with("2 turns back"));
    assert_eq!(motion(&["--theta0", "0"]).0, "rest; T is the limit of small swings");

    let start = Phase { theta: 0.5, omega: -7.0 };
    let (said, period) = motion(&["--theta0", "0.5", "--omega0", "-7"]);
    assert_eq!(said, "rotation backwards; T is the time of a turn");
    let after = Motion::new(&Pendulum::PAPER, start).unwrap().at(period.unwrap());
    // 7 rad/s times an ε of the period, and the error of the closed form.
    assert!((after.theta - (0.5 - 2.0 * std::f64::consts::PI)).abs() < 1e-14, "{after:?}");
    assert_eq!(motion(&["--theta0", "1", "--omega0", "1"]).0, "libration");
    // With a velocity the ratio is that of the two numbers above it, rounded once.
    let text = printed(&["exact", "--theta0", "1", "--omega0", "1"]);
    let values = text.lines().take(3).map(|line| line.split_whitespace().nth(1)?.parse().ok());
    let values: Option<Vec<f64>> = values.collect();
    let [period, small, ratio] = values.unwrap()[..] else { panic!("three numbers: {text}") };
    assert!(ratio > 1.0 && ratio == period / small, "{text}");
    // ω² = 4 g/L at the bottom, exactly.
    let (said, period) = motion(&["--theta0", "0", "--omega0", "4", "--gravity", "4"]);
    assert!(said.starts_with("separatrix") && period.is_none(), "{said} {period:?}");
}

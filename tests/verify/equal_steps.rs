//! Programs of equal steps that are right in a way that surprises a judge, or wrong where it is
//! hardly asked.

use pendula::Phase;
use pendula_judge::{
    Claims, Fault, FromFn, Integrator, Property, Reply, Report, Request, Verdict, judge,
};
use rstest::rstest;

use crate::looks::{self, Driven, Force};
use crate::programs::*;

/// The report on a program, by its claims in words.
fn judged<I: IntoIterator<Item = State>>(
    program: impl Fn(f64, f64, f64, f64, u64) -> I,
    claims: &str,
) -> Report {
    judge(&FromFn(program), claims.parse::<Claims>().expect("claims"))
}

/// Each number of the states as it is printed with so many significant digits.
fn printed(
    program: Program,
    count: usize,
) -> impl Fn(f64, f64, f64, f64, u64) -> Vec<State> + Copy {
    move |g, theta, omega, h, n| {
        let states = program(g, theta, omega, h, n).into_iter();
        states.map(|(theta, omega)| (digits(count, theta), digits(count, omega))).collect()
    }
}

/// Catches: a bound that lies below what the program itself rounds by, as that of a pendulum at
/// rest did for angles that are others inside; an order that is unclear of a method whose slopes
/// come down to it, or that has a name; a rounded coefficient taken for a loss.
#[rstest]
#[case::from_the_top(from_the_top, "order=2 symplectic symmetric name=stormer-verlet")]
#[case::rotating_frame(rotating_frame, "order=2 symplectic symmetric name=stormer-verlet")]
#[case::fast_rotating_frame(fast_rotating_frame, "order=2 symplectic symmetric")]
#[case::position_from_the_top(position_from_the_top, "order=2 symplectic")]
#[case::tsit5(tsit5, "order=5 name=tsitouras-5")]
#[case::tsit5_claims_less(tsit5, "order=4")]
#[case::gragg_8(gragg_8, "order=8")]
#[case::gautschi(gautschi, "order=2 symplectic symmetric")]
#[case::adams_3(|g: f64, a, b, h: f64, n| adams(&AB3, Begin::Rk4, g, a, b, h, n), "order=3")]
#[case::adams_5(|g: f64, a, b, h: f64, n| adams(&AB5, Begin::Rk4, g, a, b, h, n), "order=5")]
fn right_ones_are_not_refused(#[case] program: Program, #[case] claims: &str) {
    let report = judged(program, claims);
    assert_eq!((report.verdict, &report.look_at()[..]), (Verdict::Holds, &[][..]), "{report}");
}

/// Catches: a method that is compared from everywhere but where it stands, because its digits, or a
/// tolerance inside it, are more than the known answers allow and less than shows; a claim that
/// then fails of a right program.
#[rstest]
#[case(verlet, "stormer-verlet", "order=2 symplectic symmetric")]
#[case(symplectic_euler, "symplectic-euler", "order=1 symplectic")]
#[case(forward_euler, "forward-euler", "order=1")]
#[case(rk4, "rk4", "order=4")]
#[case(
    |g: f64, a, b, h: f64, n| midpoint_to(0.0, g, a, b, h, n), "implicit-midpoint",
    "order=2 symmetric",
)]
fn its_digits_do_not_change_its_name(
    #[case] program: Program,
    #[case] name: &str,
    #[case] claims: &str,
    #[values(15, 16, 17)] count: usize,
) {
    let report = judged(printed(program, count), &format!("{claims} name={name}"));
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
    let identity = report.identity.as_ref().expect("it has a name");
    assert!(identity.is_plain() && identity.method == name, "{report}");
}

/// Catches: the same, of a state that is rounded in each step, of a drag that nobody sees, of an
/// iteration that ends before the last digit.
#[rstest]
#[case::rounded_in_each_step(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let (theta, omega) = leapfrog(g, z, h);
        (digits(15, theta), digits(15, omega))
    }),
    "order=2 symplectic symmetric name=stormer-verlet",
)]
#[case::a_drag_of_a_rounding(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let (theta, omega) = leapfrog(g, z, h);
        (theta, omega * (1.0 - 1e-15))
    }),
    "order=2 symplectic name=stormer-verlet",
)]
#[case::to_1e_11(
    |g: f64, a, b, h: f64, n| midpoint_to(1e-11, g, a, b, h, n), "order=2 name=implicit-midpoint",
)]
#[case::to_1e_12(
    |g: f64, a, b, h: f64, n| midpoint_to(1e-12, g, a, b, h, n), "order=2 name=implicit-midpoint",
)]
#[case::to_1e_13(
    |g: f64, a, b, h: f64, n| midpoint_to(1e-13, g, a, b, h, n), "order=2 name=implicit-midpoint",
)]
#[case::to_1e_14(
    |g: f64, a, b, h: f64, n| midpoint_to(1e-14, g, a, b, h, n), "order=2 name=implicit-midpoint",
)]
#[case::verlet_by_the_size_of_h(
    |g: f64, a, b, h: f64, n| verlet(g, a, b, h.abs(), n), "order=2 symplectic name=stormer-verlet",
)]
#[case::euler_by_the_size_of_h(
    |g: f64, a, b, h: f64, n| symplectic_euler(g, a, b, h.abs(), n),
    "order=1 symplectic name=symplectic-euler",
)]
#[case::drift_first_by_the_size_of_h(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |(theta, omega)| {
        let theta = theta + h.abs() * omega;
        (theta, omega - h.abs() * g * theta.sin())
    }),
    "order=1 symplectic name=symplectic-euler-drift-first",
)]
fn what_is_no_more_than_rounding_does_not_change_its_name(
    #[case] program: Program,
    #[case] claims: &str,
) {
    let report = judged(program, claims);
    let name = report.finding(Property::Name).expect("it is claimed");
    assert_eq!(name.verdict, Verdict::Holds, "{report}");
    assert_ne!(report.verdict, Verdict::Fails, "{report}");
}

/// Wrong where most requests do not reach, and right everywhere else.
///
/// Catches: a judge that asks for slow motions, for swings of a radian, for short steps, for few
/// turns and short runs alone.
#[rstest]
#[case::a_speed_limit("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    let (theta, omega) = leapfrog(g, z, h);
    (theta, omega.clamp(-4.0 * g.sqrt(), 4.0 * g.sqrt()))
}))]
#[case::a_weaker_force_in_fast_rotation("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.1.abs() > 3.0 * g.sqrt() { 0.9 * g } else { g }, z, h)
}))]
#[case::a_force_a_millionth_weaker_there("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.1.abs() > 3.0 * g.sqrt() { (1.0 - 1e-6) * g } else { g }, z, h)
}))]
#[case::no_force_in_fast_rotation("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.1.abs() > 20.0 * g.sqrt() { 0.0 } else { g }, z, h)
}))]
#[case::no_numbers_in_fast_rotation("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.1.abs() > 10.0 * g.sqrt() { f64::NAN } else { g }, z, h)
}))]
#[case::put_to_sleep("range", sleeping)]
#[case::a_dead_band("range", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.0.abs() < 1e-3 { 0.0 } else { g }, z, h)
}))]
#[case::long_steps_cut("range", |g: f64, a, b, h: f64, n| {
    let x = h * g.sqrt();
    verlet(g, a, b, if x > 1.15 { 1.15 / g.sqrt() } else { h }, n)
})]
#[case::beyond_a_thousand_radians("turn", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.0.abs() > 1000.0 { 0.9 * g } else { g }, z, h)
}))]
#[case::beyond_a_hundred_thousand_radians("turn", |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
    leapfrog(if z.0.abs() > 1e5 { 0.9 * g } else { g }, z, h)
}))]
#[case::late_in_a_run("clock", |g: f64, a, b, h: f64, n| {
    let mut count = 0_u32;
    steps(a, b, n, |z| {
        count += 1;
        if count > 65_535 { z } else { leapfrog(g, z, h) }
    })
})]
fn wrong_beyond_the_usual_is_refused(#[case] property: &str, #[case] program: Program) {
    let report = judged(program, "order=2 symplectic symmetric");
    assert!(report.failures().any(|failed| failed.name() == property), "{report}");
}

/// Catches: a question about what lies beyond that a program does not answer, as one does whose
/// answers are a record, and that fails or leaves the verdict open for it.
#[test]
fn what_lies_beyond_need_not_be_answered() {
    struct Near;
    impl Integrator for Near {
        fn answer(&self, request: &Request) -> Result<Reply, Fault> {
            let Phase { theta, omega } = request.start;
            let fast = omega.abs() > 4.0 * request.g_over_l.sqrt();
            let far = theta.abs() > 1000.0 || request.steps > 65_535 || theta.abs() == 1e-4;
            if fast || far {
                return Err(Fault::Refused("its record has no answer to this question".into()));
            }
            FromFn(verlet).answer(request)
        }
    }
    let report = judge(&Near, "order=2 symplectic symmetric".parse().expect("claims"));
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
}

// -------------------------------------------------------------------------------------------------
// Causes
// -------------------------------------------------------------------------------------------------

/// Störmer–Verlet with another force.
fn with_force(force: impl Fn(f64) -> f64, (theta, omega): State, h: f64) -> State {
    let omega = omega + 0.5 * h * force(theta);
    let theta = theta + h * omega;
    (theta, omega + 0.5 * h * force(theta))
}

/// A run that ends where a sum of its steps reaches their product.
fn while_time_is_less(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let end = h * n as f64;
    let (mut time, mut z) = (0.0, (theta, omega));
    let mut states = Vec::new();
    while time < end {
        z = leapfrog(g, z, h);
        time += h;
        states.push(z);
    }
    // The rows that are asked for, the last of which is where it ended.
    let last = z;
    states.truncate(n as usize);
    states.resize(n as usize, last);
    states[n as usize - 1] = last;
    states
}

/// Each program with one mistake, and how the first sentence begins. What is said is shown: it
/// predicts the program's numbers.
///
/// Catches: a cause that is told of another mistake, or of none where one is shown.
#[rstest]
#[case::pi_in_each_step(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let z = leapfrog(g, z, h);
        (z.0 + std::f64::consts::PI, z.1)
    }),
    "Each step turns the angle by π, however short it is.",
)]
#[case::one_bottom(
    filtered_about_one_bottom,
    "A step from a whole turn higher is not the same step. The difference falls with h to \
     the power 3"
)]
#[case::one_bottom_of_a_known_method(
    deuflhard_about_one_bottom,
    "This is the known mistake deuflhard-one-bottom of deuflhard"
)]
#[case::ten_decimals(
    |g: f64, a, b, h: f64, n| forest_ruth_to(10, g, a, b, h, n),
    "However short the steps are, it is off by 5.8 × 10⁻¹⁰ rad after 2.7 s",
)]
#[case::four_decimals(
    |g: f64, a, b, h: f64, n| forest_ruth_to(4, g, a, b, h, n),
    "A coefficient has too few digits, about 4",
)]
#[case::a_short_pi(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let turn = 2.0 * decimals(4, std::f64::consts::PI);
        with_force(|theta| -g * (theta - turn * (theta / turn).round()).sin(), z, h)
    }),
    "Its turns are not 2π long, but off by 1.5 × 10⁻⁵ rad",
)]
#[case::the_size_of_h(
    |g: f64, a, b, h: f64, n| verlet(g, a, b, h.abs(), n), "It takes the absolute value of h",
)]
#[case::no_slopes_before_2(
    |g: f64, a, b, h: f64, n| adams(&AB2, Begin::Zero, g, a, b, h, n),
    "The first step is 1.5 h long, and those after it h: the slopes before the start are taken as \
     zero",
)]
#[case::no_slopes_before_3(
    |g: f64, a, b, h: f64, n| adams(&AB3, Begin::Zero, g, a, b, h, n),
    "The first steps are 1.917, 0.583 h long, and those after them h: the slopes before the start",
)]
#[case::begun_with_euler_3(
    |g: f64, a, b, h: f64, n| adams(&AB3, Begin::Euler, g, a, b, h, n),
    "Only the first step is of order 1: its error goes with h²",
)]
#[case::begun_with_euler_5(
    |g: f64, a, b, h: f64, n| adams(&AB5, Begin::Euler, g, a, b, h, n),
    "Only the first step is of order 1: its error goes with h²",
)]
#[case::the_old_velocity(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| (s[k].0, s[k - 1].1))(g, a, b, h, n),
    "The adapter or the output is at fault, because with each angle it returns the velocity of the \
     step before",
)]
#[case::the_old_angle(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| (s[k - 1].0, s[k].1))(g, a, b, h, n),
    "The adapter or the output is at fault, because with each velocity it returns the angle of the \
     step before",
)]
#[case::means(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| {
        (0.5 * (s[k].0 + s[k - 1].0), 0.5 * (s[k].1 + s[k - 1].1))
    })(g, a, b, h, n),
    "The adapter or the output is at fault, because it returns the mean of each state and the one \
     before",
)]
#[case::two_steps_late(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| s[k.saturating_sub(2)])(g, a, b, h, n),
    "The adapter or the output is at fault, because it returns each state two steps late",
)]
#[case::differences(
    |g: f64, a, b, h: f64, n| handed_out(rk4, |s, k| {
        (s[k].0, (s[k].0 - s[k - 1].0) / h)
    })(g, a, b, h, n),
    "The adapter or the output is at fault, because for a velocity it returns the difference of \
     the last two angles",
)]
#[case::the_place(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| (s[k].0.sin(), s[k].1))(g, a, b, h, n),
    "The adapter or the output is at fault, because it returns sin θ for θ",
)]
#[case::velocity_times_the_step(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| (s[k].0, s[k].1 * h))(g, a, b, h, n),
    "The adapter or the output is at fault, because it returns ω h for ω",
)]
#[case::turns(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| {
        (s[k].0 / std::f64::consts::TAU, s[k].1 / std::f64::consts::TAU)
    })(g, a, b, h, n),
    "The adapter or the output is at fault, and not the method, because at g/L = 12.2625 1/s² it \
     returns 0.159155 times the angle and the velocity, which are turns",
)]
#[case::turns_a_minute(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| {
        (s[k].0, s[k].1 * 60.0 / std::f64::consts::TAU)
    })(g, a, b, h, n),
    "The adapter or the output is at fault, and not the method, because at g/L = 12.2625 1/s² it \
     returns 9.5493 times the velocity, which are velocities in turns per minute",
)]
#[case::half_precision(
    |g: f64, a, b, h: f64, n| handed_out(verlet, |s, k| {
        (half_precision(s[k].0), half_precision(s[k].1))
    })(g, a, b, h, n),
    "A step rounds by 1 × 10⁻⁵, because its numbers have 11 binary digits: half precision",
)]
#[case::g_of_two_decimals(
    |g: f64, a, b, h: f64, n| verlet(decimals(2, g), a, b, h, n),
    "Its g/L is rounded to 2 decimals.",
)]
#[case::h_in_single_precision(
    |g: f64, a, b, h: f64, n| rk4(g, a, b, f64::from(h as f32), n),
    "Its step is h in single precision.",
)]
#[case::h_in_microseconds(
    |g: f64, a, b, h: f64, n| rk4(g, a, b, decimals(6, h), n),
    "Its step is h rounded to 1 × 10⁻⁶ s.",
)]
#[case::a_longest_step(
    |g: f64, a, b, h: f64, n| verlet(g, a, b, h.clamp(-1.0 / 60.0, 1.0 / 60.0), n),
    "Its step is never longer than 0.0166667 s",
)]
#[case::a_shortest_step(
    |g: f64, a, b, h: f64, n| verlet(g, a, b, h.abs().max(1e-3).copysign(h), n),
    "Its step is never shorter than 0.001 s",
)]
#[case::a_sum_of_steps(while_time_is_less, "A run of 1000 steps takes 1001")]
#[case::a_table_of_sines(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        with_force(|theta| -g * table_sine(1024, theta), z, h)
    }),
    "The force has corners along the angle, of 1.9 × 10⁻⁵ g/L",
)]
#[case::a_speed_limit(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let (theta, omega) = leapfrog(g, z, h);
        (theta, omega.clamp(-7.0, 7.0))
    }),
    "Its velocity is limited to 7 rad/s, whatever g/L is",
)]
#[case::a_limit_in_units(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        let (theta, omega) = leapfrog(g, z, h);
        (theta, omega.clamp(-4.0 * g.sqrt(), 4.0 * g.sqrt()))
    }),
    "Its velocity is limited to 4 √(g/L)",
)]
#[case::put_to_sleep(sleeping, "A swing of 1 × 10⁻³ rad stands still after 30 steps")]
#[case::g_of_the_height(
    |g: f64, a, b, h: f64, n| steps(a, b, n, |z| {
        with_force(|theta| -g * theta.sin() * (1.0 - 1e-7 * (1.0 - theta.cos())), z, h)
    }),
    "It solves another equation: at θ = 1 rad and ω = 0 the force is −10.318537, not \
     −10.318538",
)]
#[case::units_alone(
    |g: f64, a, b, h: f64, n| verlet(g * (1.0 + 1e-3 * h * h), a, b, h, n),
    "It contains a constant in seconds",
)]
fn a_cause_is_said_where_it_is_shown(#[case] program: Program, #[case] begins: &str) {
    let claims = match begins {
        _ if begins.contains("few digits") || begins.starts_with("However") => "order=4",
        _ if begins.to_lowercase().contains("first step") => "order=3",
        _ => "order=2 symmetric",
    };
    let report = judged(program, claims);
    let look_at = report.look_at();
    let first = look_at.first().map_or("", String::as_str);
    assert!(first.starts_with(begins), "{report}");
    let single = report.look_at().iter().any(|line| line.contains("single precision"));
    assert_eq!(single, begins.contains("single precision"), "{report}");
}

/// Catches: a rounding named where answers are not repeatable, or what was kept from another
/// request taken for a part of the step.
#[test]
fn what_is_random_is_no_precision() {
    let count = std::cell::Cell::new(0);
    let noisy = |g: f64, a: f64, b: f64, h: f64, n: u64| {
        steps(a, b, n, |z| {
            count.set(count.get() + 1);
            let z = leapfrog(g, z, h);
            (z.0, z.1 + 1e-9 * random(count.get()))
        })
    };
    let report = judged(noisy, "order=2");
    assert!(report.look_at()[0].starts_with("The same request has another answer"), "{report}");
    assert_eq!(report.look_at().len(), 1, "{report}");
}

/// Catches: "does not keep area" of what never answered with a number.
#[test]
fn what_was_not_measured_is_not_said() {
    let report = judged(|_, _, _, _, n| vec![(f64::NAN, f64::NAN); n as usize], "order=2");
    assert!(report.description.to_string().starts_with("not known"), "{report}");
    let few = |g: f64, a: f64, b: f64, h: f64, n: u64| verlet(g, a, b, h, n.saturating_sub(1));
    let report = judged(few, "order=2 symmetric");
    assert!(!report.description.to_string().contains("not symmetric"), "{report}");
    assert_eq!(report.look_at(), [""; 0], "{report}");
}

/// RK4 whose stages take the drive at t + 0.5, and not at t + 0.5 h.
///
/// Catches: a wrong time of the stages that is told more exactly than it is shown.
#[test]
fn a_wrong_time_of_the_stages_is_told_by_its_order() {
    fn run(force: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
        let later = |t: f64, theta: f64| {
            let (steps, part) = ((t / h).floor(), t / h - (t / h).floor());
            let half = (0.25..0.75).contains(&part);
            force(if half { steps * h + 0.5 } else { t }, theta)
        };
        looks::rk4(&later, z, h, n)
    }
    let report = judge(&Driven { run, g_over_l: looks::told }, Claims::order(4));
    let line = "Only with a drive is the order 0: stages take the drive at a wrong time, by what \
                does not become less with the step.";
    assert!(report.look_at().iter().any(|told| told.starts_with(line)), "{report}");
}

//! Programs of equal steps that are right in a way that surprises a judge, or wrong where it is
//! hardly asked.

use pendula::Phase;
use pendula_judge::{
    Claims, Fault, FromFn, Property, Reply, Report, Request, Stranger, Verdict, judge,
};
use rstest::rstest;

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

/// Catches: a bound that lies below what the program itself rounds by, as that of a pendulum at rest
/// did for angles that are others inside; an order that is unclear of a method whose slopes come down
/// to it, or that has a name; a rounded coefficient taken for a loss.
#[rstest]
#[case::from_the_top(from_the_top, "order=2 symplectic symmetric name=stormer-verlet")]
#[case::rotating_frame(rotating_frame, "order=2 symplectic symmetric name=stormer-verlet")]
#[case::fast_rotating_frame(fast_rotating_frame, "order=2 symplectic symmetric")]
#[case::position_from_the_top(position_from_the_top, "order=2 symplectic")]
#[case::tsit5(tsit5, "order=5 name=tsitouras-5")]
#[case::tsit5_claims_less(tsit5, "order=4")]
#[case::gragg_8(gragg_8, "order=8")]
#[case::gautschi(gautschi, "order=2 symplectic symmetric")]
fn right_ones_are_not_refused(#[case] program: Program, #[case] claims: &str) {
    let report = judged(program, claims);
    assert_eq!((report.verdict, &report.look_at()[..]), (Verdict::Holds, &[][..]), "{report}");
}

/// Catches: a method that is compared from everywhere but where it stands, because its digits, or a
/// tolerance inside it, are more than the known answers allow and less than shows; a claim that then
/// fails of a right program.
#[rstest]
#[case(verlet, "stormer-verlet", "order=2 symplectic symmetric")]
#[case(symplectic_euler, "symplectic-euler", "order=1 symplectic")]
#[case(forward_euler, "forward-euler", "order=1")]
#[case(rk4, "rk4", "order=4")]
#[case(|g: f64, a, b, h: f64, n| midpoint_to(0.0, g, a, b, h, n), "implicit-midpoint", "order=2 symmetric")]
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
    impl Stranger for Near {
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

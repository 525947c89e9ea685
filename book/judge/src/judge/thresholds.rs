//! Where the judge's verdicts change: just inside each threshold and just outside.

use pendula::methods::StormerVerlet;
use pendula::{Motion, Pendulum, Phase, method_named};
use rstest::rstest;

use super::Verdict::{self, Fails, Holds, NotMeasured, Unclear};
use super::answers::{Answers, Name};
use super::area::{Defect, judge as area};
use super::energy::verdict as energy;
use super::expansion::deviation_with;
use super::identity::leading_error;
use super::loss::Loss;
use super::order::{Ladder, shown, verdict as order};
use super::probe::Probe;
use super::replies::{Clock, judge_precision as precision};
use super::reversal::{Way, judge as reversal};
use super::stage_times::verdict as stage_times;
use super::symmetry::Apart;
use super::{Claims, Report, judge};
use crate::finding::{EnergyLaw, Finding, LossBy, Slopes};
use crate::known_answers;
use crate::properties::error_constant::leading_local_error;
use crate::property::Property;
use crate::{Chosen, Fault, FromFn, Integrator, Reply, Request};

/// A little less and a little more: nothing that a verdict compares is known better.
const INSIDE: f64 = 1.0 - 1e-9;
const OUTSIDE: f64 = 1.0 + 1e-9;

/// Asserts that the verdict changes from the first to the second at `at`.
#[track_caller]
fn changes(at: f64, [below, above]: [Verdict; 2], verdict: impl Fn(f64) -> Verdict) {
    assert_eq!([verdict(at * INSIDE), verdict(at * OUTSIDE)], [below, above], "at {at:e}");
}

/// Catches: a threshold of the area that is moved, or a defect of one sign that is not looked at;
/// an area that is said to be kept since nothing is known of it.
#[rstest]
#[case(1.0)]
#[case(-1.0)]
fn of_the_area(#[case] sign: f64) {
    let of = |value: f64| area(&Defect { value: sign * value, ruler: 3e-9, x: 0.4 }).verdict;
    changes(3e-8, [Holds, Unclear], of);
    changes(3e-7, [Unclear, Fails], of);
    let by_a_corner =
        |value: f64| area(&Defect { value: sign * value, ruler: 0.1, x: 0.4 }).verdict;
    changes(0.03, [Holds, Unclear], by_a_corner);
}

/// Catches: a threshold of the way back that is moved.
#[test]
fn of_the_way_back() {
    let of = |miss| {
        let way = Way { miss, bound: 2e-12, x: 0.1, steps: 1000, by_itself: true };
        reversal(&way).verdict
    };
    changes(2e-12, [Holds, Unclear], of);
    changes(2e-11, [Unclear, Fails], of);
    assert_eq!(of(f64::NAN), Fails);
}

/// Catches: a way with a large miss and a large bound preferred to one that misses by more than
/// rounding can make.
#[test]
fn ways_are_compared_by_what_rounding_may_make() {
    let way = |miss, bound| Way { miss, bound, x: 0.1, steps: 1000, by_itself: true };
    assert!(way(1e-10, 2e-11).in_roundings() > way(2e-10, 1e-9).in_roundings());
}

/// Catches: a threshold of mirror, units or turn that is moved; a tolerance that excuses the
/// mirror, or more than 10⁻⁷.
#[test]
fn of_the_symmetries() {
    let of = |spoilt, bound| move |largest| Apart { largest, bound }.judge(spoilt).verdict;
    for spoilt in [false, true] {
        changes(1e-12, [Holds, Unclear], of(spoilt, 1e-12));
    }
    changes(1e-11, [Unclear, Fails], of(false, 1e-12));
    changes(1e-7, [Unclear, Fails], of(true, 1e-12));
}

/// Catches: a threshold of the clock that is moved, or one that a coarse rounding does not widen.
#[test]
fn of_the_clock() {
    let of = |bound| move |steps_apart| Clock { steps_apart, bound, steps: 100 }.judge().verdict;
    changes(0.05, [Holds, Unclear], of(1e-9));
    changes(0.2, [Holds, Unclear], of(0.2));
    changes(0.5, [Unclear, Fails], of(1e-9));
}

/// Catches: a threshold of the loss that is moved, a gain that is let pass, a tolerance that does
/// not excuse.
#[rstest]
#[case(1.0)]
#[case(-1.0)]
fn of_the_loss(#[case] sign: f64) {
    let of = |tolerance| {
        move |a_step: f64| {
            Loss { a_step: sign * a_step, bound: 1e-16, tolerance, by: LossBy::Area }
                .judge()
                .verdict
        }
    };
    changes(1e-16, [Holds, Unclear], of(0.0));
    changes(1e-15, [Unclear, Fails], of(0.0));
    changes(1e-12, [Unclear, Fails], of(1e-12));
}

/// Catches: a threshold of the precision that is moved.
#[test]
fn of_the_precision() {
    let of = |rounding| precision(rounding, None, false).verdict;
    changes(2e-14, [Holds, Unclear], of);
    changes(1e-11, [Unclear, Fails], of);
}

/// Catches: a threshold of the energy that is moved, growth that is taken for rounding or rounding
/// for growth, the law of a growth with time.
#[test]
fn of_the_energy() {
    let of = |first: f64, bound: f64| move |last| energy(first, last, bound).0;
    // Far above rounding: 1.3 and 2 times the first tenth.
    changes(1.3e-6, [Holds, Unclear], of(1e-6, 1e-20));
    changes(2e-6, [Unclear, Fails], of(1e-6, 1e-20));
    // At rounding: nothing is told below 10 times it, and no failure below 20 times.
    assert_eq!(energy(9.9e-15, 9.9e-15, 1e-15).0, Unclear);
    assert_eq!(energy(1.01e-14, 9.9e-15, 1e-15).0, Holds);
    changes(2e-14, [Unclear, Fails], of(1e-15, 1e-15));
    let law = |times: f64| energy(1e-6, times * 1e-6, 1e-20).1;
    let laws = [law(4.9), law(5.1), law(19.9), law(20.1)];
    use EnergyLaw::{Grows, GrowsWithTime};
    assert_eq!(laws, [Grows, GrowsWithTime, GrowsWithTime, Grows]);
}

/// Catches: a threshold of the slope with a drive that is moved; no slope taken for a right one.
#[test]
fn of_the_stage_times() {
    let of = |order| move |last| stage_times(Some(last), 1e-3, order);
    changes(3.5, [Unclear, Holds], of(4));
    changes(3.0, [Fails, Unclear], of(4));
    changes(1.5, [Fails, Holds], of(2));
    changes(0.5, [Fails, Holds], of(1));
    assert_eq!(stage_times(Some(f64::NAN), 1e-3, 1), Fails);
    changes(1e-10, [Holds, Unclear], |coarsest| stage_times(None, coarsest, 4));
}

/// A ladder of halved steps with these slopes, all of them those of the leading term.
fn ladder(slopes: &[f64]) -> Ladder {
    let mut rungs = vec![(0.01, 1e-3)];
    for slope in slopes {
        let (h, error) = rungs[rungs.len() - 1];
        rungs.push((h / 2.0, error / f64::powf(2.0, *slope)));
    }
    Ladder { rungs, slopes: slopes.to_vec(), leading: 0 }
}

/// Catches: a threshold of the order that is moved: how near the last slope has to be, how far it
/// may leave the order again, when it has settled elsewhere.
#[test]
fn of_the_order() {
    let last = |before: &[f64], claimed: u32| {
        let before = before.to_vec();
        move |last: f64| order(&ladder(&[&before[..], &[last]].concat()), claimed).0
    };
    // Towards the order from above and from below.
    changes(2.2, [Holds, Unclear], last(&[2.1, 2.15], 2));
    // Further above, slopes that come down tend to within 0.2 of it by quarters of what is left,
    // (4 · 2.5 − 3.4)/3 = 2.2, or, by halves, to no less than 0.2 below it, 2 · 2.6 − 3.4 = 1.8.
    changes(2.5, [Holds, Unclear], last(&[4.3, 3.4], 2));
    changes(2.6, [Unclear, Holds], last(&[4.3, 3.4], 2));
    // Those that rise again come to no end.
    changes(3.4, [Holds, Unclear], last(&[4.3, 3.4], 2));
    changes(1.8, [Unclear, Holds], last(&[1.2, 1.5], 2));
    // Once within 0.05 of it, it may not fall by more than 0.2.
    changes(3.8, [Fails, Holds], last(&[4.0, 3.96], 4));
    changes(3.8, [Unclear, Holds], last(&[4.06, 4.06], 4));
    // Two slopes within 0.15 of a whole number that is more than what is claimed.
    changes(5.15, [Holds, Unclear], last(&[5.0, 5.01], 4));
    // Below that they come down to it, as far as is seen.
    changes(4.85, [Unclear, Holds], |last| {
        let (verdict, why) = order(&ladder(&[5.0, 5.01, last]), 4);
        assert_eq!(verdict, Holds);
        if matches!(why, Slopes::Better { shown: 5, .. }) { Holds } else { Unclear }
    });
    // Errors that grow by more than a tenth from step to step, three times.
    changes(-1.1_f64.log2(), [Unclear, Fails], |slope| {
        let slope = slope.clamp(-1.0, 1.0);
        let ladder = ladder(&[-1.0, -1.0, slope]);
        if order(&ladder, 2).1 == Slopes::Grows { Fails } else { Unclear }
    });
    // Twice more than an order and a half too low, though rising: not on its way.
    changes(2.5, [Fails, Unclear], last(&[4.82, 2.82, 1.3], 4));
    // Away from the order, and below it by half in two slopes: no longer on its way.
    changes(3.5, [Fails, Unclear], |before| order(&ladder(&[3.9, before, before - 0.15]), 4).0);
    assert_eq!(order(&ladder(&[]), 2).0, Unclear);
}

/// Over three halvings a factor of four in the error is 2/3 in the slope.
///
/// Catches: another window around a high order, or one that is as wide as a quarter of the order.
#[test]
fn of_a_high_order() {
    for third in [3.0, -3.0] {
        let off = |off| order(&ladder(&[20.0, 12.0, 12.0, 12.0 + third * off]), 12).0;
        changes(2.0 / 3.0, [Holds, Unclear], off);
        changes(4.0 / 3.0, [Unclear, Fails], off);
    }
    let rungs = |by: f64| vec![(1.0, 1.0), ((-by).exp(), (-12.0 * by).exp())];
    let over = |by| order(&Ladder { rungs: rungs(by), slopes: vec![12.0], leading: 0 }, 12).0;
    changes(4.0_f64.ln() / 3.0, [Unclear, Holds], over);
}

/// Near one of the states at which the area is measured, and none of the equation's.
fn between(request: &Request) -> bool {
    (2.4..2.55).contains(&request.start.theta)
}

/// A program that is off by a third of what the file allows, as plain programs are at most, has its
/// name: all entries but those that are one map on a pendulum without a drive.
///
/// Catches: a name that is withheld from a right program, or given to another one.
#[test]
fn each_known_method_has_its_name() {
    for known in known_answers::methods() {
        let third = |answer: &known_answers::Answer| answer.tolerance / 3.0;
        for answers in [Answers::as_of(known, |_| 0.0), Answers::as_of(known, third)] {
            let claims = Claims::none().name(known.name.as_str());
            let name = answers.method(&claims);
            let Name::One(found) = name else { panic!("{}: {name:?}", known.name) };
            assert_eq!(found.known.name, known.name);
        }
    }
}

/// Störmer–Verlet, and something else where a request is of one kind.
struct But {
    when: fn(&Request) -> bool,
    spoilt: fn(&Request, Reply) -> Reply,
}

impl Integrator for But {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let reply = StormerVerlet.answer(request)?;
        Ok(if (self.when)(request) { (self.spoilt)(request, reply) } else { reply })
    }
}

/// The states a millionth lower.
fn lowered(_: &Request, reply: Reply) -> Reply {
    let states = reply.states.iter().map(|z| Phase { theta: z.theta - 1e-6, ..*z }).collect();
    Reply { states, ..reply }
}

/// x = ω₀h.
fn x(request: &Request) -> f64 {
    request.step * request.g_over_l.sqrt()
}

fn near(a: f64, b: f64) -> bool {
    (a.abs() - b).abs() < 1e-9
}

/// Each is wrong in one of several measurements of its property, and in no other.
///
/// Catches: a measurement that is left out, or whose result is not the one that decides.
#[rstest]
#[case::back_in_short_steps("reversal", |r: &Request| r.step < 0.0 && near(x(r), 0.1))]
#[case::back_in_longer_steps("reversal", |r: &Request| r.step < 0.0 && near(x(r), 0.4))]
#[case::back_in_long_steps("reversal", |r: &Request| r.step < 0.0 && near(x(r), 1.0))]
#[case::mirrored_swing("mirror", |r: &Request| r.start.theta == -1.2)]
#[case::mirrored_rotation("mirror", |r: &Request| r.start.omega == -8.0 && r.steps == 200)]
#[case::at_rest("mirror", |r: &Request| r.start == Phase::default() && r.steps == 200)]
#[case::four_times_as_fast("units", |r: &Request| near(r.g_over_l, 12.2625 * 16.0))]
#[case::four_times_as_slow("units", |r: &Request| near(r.g_over_l, 12.2625 / 16.0))]
#[case::three_times_as_fast("units", |r: &Request| near(r.g_over_l, 12.2625 * 9.0))]
#[case::a_turn_up("turn", |r: &Request| (5.0..8.0).contains(&r.start.theta))]
#[case::three_turns_down("turn", |r: &Request| (-20.0..-17.0).contains(&r.start.theta))]
#[case::a_hundred_turns_up("turn", |r: &Request| r.start.theta > 600.0)]
#[case::every_fifth_state("repeatable", |r: &Request| r.every == 5 && r.steps == 50)]
fn one_measurement_decides(#[case] property: &str, #[case] when: fn(&Request) -> bool) {
    let report = judge(&But { when, spoilt: lowered }, claims());
    fails(&report, property);
}

fn claims() -> Claims {
    Claims::order(2).symplectic().symmetric().bounded_energy().evaluations(1)
}

#[track_caller]
fn fails(report: &Report, property: &str) {
    let failed: Vec<&str> = report.failures().map(Property::name).collect();
    assert_eq!(failed, [property], "{report}");
}

/// The same where what is spoilt is a part of an answer.
///
/// Catches: a clock that is tried with one length of pieces, evaluations counted with the first
/// step's, an area measured at one step.
#[rstest]
#[case::the_clock_of_long_pieces(
    "clock", |r: &Request| r.step == 0.1 && r.steps == 100,
    |r: &Request, reply: Reply| moved(r, reply, 0.6),
)]
#[case::the_clock_of_many_pieces(
    "clock", |r: &Request| r.step == 0.01 && r.steps == 500,
    |r: &Request, reply: Reply| moved(r, reply, 0.6),
)]
#[case::the_clock_of_few_steps(
    "clock", |r: &Request| r.step == 0.01 && r.steps == 7,
    |r: &Request, reply: Reply| moved(r, reply, 0.6),
)]
#[case::the_area_of_short_steps("area", |r: &Request| r.steps == 1 && near(x(r), 0.1), widened)]
#[case::the_area_of_longer_steps("area", |r: &Request| r.steps == 1 && near(x(r), 0.4), widened)]
#[case::the_area_of_long_steps("area", |r: &Request| r.steps == 1 && near(x(r), 1.0), widened)]
#[case::the_area_at_one_state("area", |r: &Request| r.steps == 1 && between(r), widened)]
#[case::the_energy_of_short_steps("energy", |r: &Request| r.steps == 60_000, sped_up)]
#[case::the_energy_of_long_steps("energy", |r: &Request| r.steps == 20_000, sped_up)]
#[case::evaluations(
    "evaluations", |r: &Request| r.steps == 2000,
    one_more,
)]
fn one_answer_decides(
    #[case] property: &str,
    #[case] when: fn(&Request) -> bool,
    #[case] spoilt: fn(&Request, Reply) -> Reply,
) {
    fails(&judge(&But { when, spoilt }, claims()), property);
}

/// One evaluation more than there was.
fn one_more(_: &Request, reply: Reply) -> Reply {
    Reply { evaluations: reply.evaluations.map(|count| count + 1), ..reply }
}

/// The angles larger by a millionth of themselves.
fn widened(_: &Request, reply: Reply) -> Reply {
    let states = reply.states.iter().map(|z| Phase { theta: z.theta * (1.0 + 1e-6), ..*z });
    Reply { states: states.collect(), ..reply }
}

/// Velocities that grow with time, to twice what they are.
fn sped_up(_: &Request, reply: Reply) -> Reply {
    let count = reply.states.len() as f64;
    let states = (1_u32..).zip(&reply.states);
    let states = states.map(|(k, z)| Phase { omega: z.omega * (1.0 + f64::from(k) / count), ..*z });
    Reply { states: states.collect(), ..reply }
}

/// The states further by this many steps' way at the amplitude of 0.3 rad.
fn moved(request: &Request, reply: Reply, steps: f64) -> Reply {
    let way = 0.3 * steps * x(request);
    let states = reply.states.iter().map(|z| Phase { theta: z.theta + way, ..*z }).collect();
    Reply { states, ..reply }
}

/// Right programs have no term of a step that should vanish, wherever it is looked for.
///
/// Catches: rounding, or the terms that a series leaves out, taken for a wrong coefficient.
#[test]
fn a_right_step_has_no_wrong_term() {
    let mut random = fastrand::Rng::with_seed(1);
    let mut between = |low: f64, high: f64| low + (high - low) * random.f64();
    for name in ["stormer-verlet", "rk4", "forest-ruth", "gauss-4", "dormand-prince"] {
        let method = method_named(name).expect("it is on the list");
        let integrator = Chosen::new(method);
        let probe = Probe::new(&integrator).unwrap();
        for _ in 0..40 {
            let g_over_l = between(0.1, 50.0);
            let starts = [(); 6].map(|()| [between(-3.0, 3.0), between(-2.0, 2.0)]);
            let found = deviation_with(&probe, g_over_l, starts).unwrap();
            let order = method.info().order as usize;
            let power = found.map(|found| found.power);
            assert!(power.is_none_or(|power| power > order), "{name} {power:?} {starts:?}");
        }
    }
}

/// Of the exact motion with one term too much of h, h², h³ or h⁴, that term is found, by its excess
/// and in parts of its factor, to 1 in 10⁵: series of 12 steps know h⁴ to about 10⁻⁸.
///
/// Catches: a term of a wrong value, sign or factor, or one told for another.
#[rstest]
#[case(1, 0, [0, 0, 1], 1.0)]
#[case(1, 1, [1, 0, 0], -1.0)]
#[case(2, 0, [1, 0, 0], -1.0 / 2.0)]
#[case(2, 1, [0, 1, 1], -1.0 / 2.0)]
#[case(3, 0, [0, 1, 1], -1.0 / 6.0)]
#[case(3, 1, [1, 1, 0], 1.0 / 6.0)]
#[case(3, 1, [1, 0, 2], 1.0 / 6.0)]
#[case(4, 0, [1, 0, 2], 1.0 / 24.0)]
#[case(4, 0, [1, 1, 0], 1.0 / 24.0)]
#[case(4, 1, [0, 1, 3], 1.0 / 24.0)]
#[case(4, 1, [2, 0, 1], -1.0 / 8.0)]
#[case(4, 1, [0, 2, 1], 1.0 / 24.0)]
fn a_term_too_much_is_found(
    #[case] power: i32,
    #[case] of: usize,
    #[case] powers: [i32; 3],
    #[case] factor: f64,
) {
    let step = move |g: f64, theta: f64, omega: f64, h: f64| {
        let (frequency, (sine, cosine)) = (g.sqrt(), theta.sin_cos());
        let factors = [sine, cosine, omega / frequency];
        let term: f64 = factors.iter().zip(powers).map(|(factor, n)| factor.powi(n)).product();
        let more = 1e-2 * factor.signum() * term * (h * frequency).powi(power);
        let pendulum = Pendulum::new(g, 1.0, 1.0).unwrap();
        let end = Motion::new(&pendulum, Phase { theta, omega }).unwrap().at(h);
        let [to_theta, to_omega] = [[more, 0.0], [0.0, more * frequency]][of];
        (end.theta + to_theta, end.omega + to_omega)
    };
    let integrator = FromFn(|g, theta, omega, h, n| {
        let next = move |z: &(f64, f64)| Some(step(g, z.0, z.1, h));
        std::iter::successors(next(&(theta, omega)), next).take(n as usize)
    });
    let starts = core::array::from_fn(|i| [i as f64 - 2.3, 1.1 - 0.7 * (i * i % 5) as f64]);
    let found = deviation_with(&Probe::new(&integrator).unwrap(), 9.81, starts).unwrap().unwrap();
    let (term, excess, parts) = found.worst();
    assert_eq!((found.power, term.of), (power as usize, of), "{}", term.name);
    // And nothing of the others.
    let all: f64 = found.excess.iter().map(|excess| excess.abs()).sum();
    assert!((excess - 1e-2).abs() < 1e-7 && (all - 1e-2).abs() < 1e-7, "{:?}", found.excess);
    assert!((parts - 1e-2 / factor.abs()).abs() < 1e-6, "{parts}");
}

/// The verdict on three claims, of area, clock and order, is the worst of theirs, and each that is
/// not *holds* is named once, the failures first.
///
/// Catches: what was not measured hiding a failure, or something unclear hiding that it was not
/// measured; a claim that is not named, or under another verdict; one failure in the plural.
#[rstest]
#[case([Holds, Holds, Holds], Holds, "Every claim holds.")]
#[case([Holds, Fails, Holds], Fails, "A claim fails: clock.")]
#[case([Fails, Holds, Fails], Fails, "Claims fail: area, order.")]
#[case(
    [Unclear, Fails, NotMeasured], Fails,
    "A claim fails: clock. Not measured: order. Unclear: area.",
)]
#[case(
    [Holds, Unclear, Holds], Unclear,
    "No claim fails, but some could not be decided. Unclear: clock.",
)]
#[case(
    [NotMeasured, NotMeasured, Holds], NotMeasured,
    "No claim fails, but some could not be decided. Not measured: area, clock.",
)]
#[case(
    [Unclear, NotMeasured, Unclear], NotMeasured,
    "No claim fails, but some could not be decided. Not measured: clock. Unclear: area, order.",
)]
fn the_verdict_on_all_claims_is_the_worst(
    #[case] verdicts: [Verdict; 3],
    #[case] worst: Verdict,
    #[case] summary: &str,
) {
    let finding = |(property, verdict)| {
        let (claimed, values) = (Some(String::new()), vec![1.0]);
        Finding { property, verdict, claimed, values, ..Finding::default() }
    };
    let findings = [Property::Area, Property::Clock, Property::Order]
        .into_iter()
        .zip(verdicts)
        .map(finding)
        .collect();
    let mut report = Report { findings, ..Report::default() };
    report.conclude(false);
    assert_eq!((report.verdict, &report.summary()[..]), (worst, summary));
}

/// The smallest of these errors are RK4's, a fortieth of 1/5!. Step and truth are rounded by ε
/// at the quarter step, which there is 1/(3e4 · 5!); times 8/3, its weight in the
/// extrapolation, 4e-3 of the error. The extrapolation leaves x³/8 with x = 0.06: 3e-5.
///
/// Catches: an error that is not extrapolated or drowned in rounding, one of ω in rad/s and not
/// in ω₀, a power of x too many.
#[test]
fn the_leading_error_is_that_of_theory() {
    for name in ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4"] {
        let method = method_named::<Pendulum>(name).unwrap();
        let integrator = Chosen::named(name).unwrap();
        let law = leading_local_error(name, [1.0, 1.0]).unwrap();
        let probe = Probe::new(&integrator).unwrap();
        let found = leading_error(&probe, method.info().order).unwrap();
        for i in 0..2 {
            let allowed = 4e-3 * law[i].abs();
            assert!((found[i] - law[i]).abs() <= allowed, "{name}: {found:?}, not {law:?}");
        }
    }
}

/// Catches: an order shown by the finest slope alone.
#[test]
fn two_slopes_show_an_order() {
    let ladder = |slopes: &[f64]| Ladder { rungs: vec![], slopes: slopes.to_vec(), leading: 0 };
    assert_eq!(shown(&ladder(&[1.4, 1.6, 3.05])), None);
    assert_eq!(shown(&ladder(&[2.9, 3.05])), Some(3));
}

//! The judge at the limits of its numbers: whatever is claimed, asked or answered, it comes back
//! with a verdict, or with a line that says what is allowed.

use std::cell::Cell;

use pendula::Phase;
use pendula::methods::{Rk4, StormerVerlet};
use pendula_judge::{
    Chosen, Claims, Drive, Fault, FromFn, Integrator, Property, Reply, Report, Request, Verdict,
    judge, try_judge,
};
use rstest::rstest;

use crate::common::Random;

/// The most that a judgement may ask for, whatever is claimed and answered. The longest ladder that
/// a claim leads to, that of order 32 and beyond, has at most 8 rungs for each of the 11.4 octaves
/// from 6 steps to 16 384, of two runs each: 184 requests, and 2 · 16 384/(1 − 2^(−1/8)) = 395 000
/// steps. Of a program whose equation is another, the equation is told by up to six fields of 560
/// single steps each. All the rest, of which most are the single steps of the series that says what
/// to look at, and 78 000 are those of a run past 65 535 steps, is 1000 requests and 320 000 steps,
/// counted.
const MOST_REQUESTS: u64 = 4600;
const MOST_STEPS: u64 = 740_000;

/// Ends a judgement that asks for more than it may, so that what would take for ever fails at once,
/// or that asks for what the protocol does not have.
struct Metered<'a> {
    integrator: &'a dyn Integrator,
    requests: Cell<u64>,
    steps: Cell<u64>,
    /// Of a request.
    most: Cell<u64>,
}

impl<'a> Metered<'a> {
    fn new(integrator: &'a dyn Integrator) -> Self {
        let [requests, steps, most] = [0; 3].map(Cell::new);
        Self { integrator, requests, steps, most }
    }
}

impl Integrator for Metered<'_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        self.requests.set(self.requests.get() + 1);
        self.steps.set(self.steps.get() + request.steps);
        self.most.set(self.most.get().max(request.steps));
        let (requests, steps) = (self.requests.get(), self.steps.get());
        assert!(requests <= MOST_REQUESTS && steps <= MOST_STEPS, "{requests} with {steps} steps");
        let Request { g_over_l, start: Phase { theta, omega }, step, every, .. } = *request;
        let finite = [g_over_l, theta, omega, step].iter().all(|x| x.is_finite());
        assert!(finite && step != 0.0 && request.steps.is_multiple_of(every), "{request}");
        self.integrator.answer(request)
    }

    fn longest_run(&self) -> u64 {
        self.integrator.longest_run()
    }
}

/// The report on `integrator`, which comes soon, and says nothing of a NaN: a state that is none is
/// said to be so.
#[track_caller]
fn judged(integrator: &dyn Integrator, claims: &Claims) -> Report {
    let report =
        try_judge(&Metered::new(integrator), claims.clone()).expect("it keeps the protocol");
    let text = report.to_string();
    assert!(!text.contains("NaN"), "{claims}: {text}");
    let values = report.findings.iter().flat_map(|finding| &finding.values);
    assert!(!values.clone().any(|value| value.is_nan()), "{claims}: {values:?}");
    report
}

/// Claims with each number at its limits.
fn extreme_claims() -> Vec<Claims> {
    let orders = [0, 1, 8, 9, 24, 32, 33, 99_999, u32::MAX - 1, u32::MAX];
    let mut claims: Vec<Claims> = orders.map(Claims::order).into();
    let all = || Claims::order(2).symplectic().symmetric().bounded_energy();
    claims.extend([0, 1, u64::MAX].map(|a_step| all().evaluations(a_step)));
    claims.extend(["", "\0", "rk4"].map(|name| all().name(name)));
    claims.push(Claims::order(u32::MAX).evaluations(u64::MAX).name("x".repeat(100_000)));
    claims.push(Claims::none());
    claims
}

/// An integrator whose state after step k from (θ, ω) is that.
fn of(state: fn(f64, f64, u64) -> (f64, f64)) -> Box<dyn Integrator> {
    Box::new(FromFn(move |_: f64, theta: f64, omega: f64, _: f64, n: u64| {
        (1..=n).map(move |k| state(theta, omega, k))
    }))
}

/// Catches: an order that is taken for the fineness of the ladder without a limit, so that a claim
/// of 4 294 967 295 takes for ever, and one of 99 999 ten minutes; one that overflows where 1 is
/// added; a rung that stands twice on the ladder, with NaN for its slope.
#[rstest]
#[case::right(Box::new(StormerVerlet))]
#[case::right_of_high_order(Box::new(Chosen::named("taylor-24").unwrap()))]
#[case::at_rest(of(|theta, omega, _| (theta, omega)))]
#[case::to_and_fro(of(|theta, omega, k| [(theta, omega), (-theta, -omega)][k as usize % 2]))]
#[case::huge_to_and_fro(of(|_, _, k| [(1e308, -1e308), (-1e308, 1e308)][k as usize % 2]))]
#[case::away(of(|theta, omega, k| (theta * 2.0_f64.powi(k as i32), omega)))]
#[case::huge(of(|_, _, _| (f64::MAX, f64::MAX)))]
#[case::huge_velocity(of(|theta, _, _| (theta, -f64::MAX)))]
#[case::subnormal(of(|_, _, _| (5e-324, -5e-324)))]
#[case::nothing(of(|_, _, _| (0.0, -0.0)))]
#[case::nan(of(|_, _, _| (f64::NAN, 0.0)))]
#[case::infinite(of(|_, _, _| (0.0, f64::INFINITY)))]
#[case::nan_now_and_then(of(|theta, omega, k| (if k % 7 == 0 { f64::NAN } else { theta }, omega)))]
#[case::no_state(Box::new(FromFn(|_: f64, _: f64, _: f64, _: f64, _: u64| [])))]
#[case::a_state_too_many(Box::new(FromFn(|_: f64, theta: f64, omega: f64, _: f64, n: u64| {
    vec![(theta, omega); n as usize + 1]
})))]
fn a_judgement_ends_whatever_is_claimed(#[case] integrator: Box<dyn Integrator>) {
    for claims in extreme_claims() {
        judged(&*integrator, &claims);
    }
}

/// Catches: an order taken modulo a power of two; a claim of no evaluations taken for none; a
/// method that is better than claimed refused.
#[test]
fn a_wrong_claim_fails_however_wrong_it_is() {
    for order in [0, 1] {
        let report = judged(&StormerVerlet, &Claims::order(order));
        let found = report.finding(Property::Order).expect("it is claimed");
        assert_eq!(
            found.why(),
            format!("The order is 2, which is better than {order}."),
            "{report}"
        );
        assert_eq!(report.verdict, Verdict::Holds, "{report}");
    }
    for order in [3, 258, 99_999, u32::MAX] {
        let report = judged(&StormerVerlet, &Claims::order(order));
        let failures: Vec<Property> = report.failures().collect();
        assert!(failures.contains(&Property::Order), "{order}: {report}");
    }
    for a_step in [0, 2, u64::MAX] {
        let report = judged(&StormerVerlet, &Claims::order(2).evaluations(a_step));
        assert!(report.failures().eq([Property::Evaluations]), "{a_step}: {report}");
    }
}

/// Catches: a function that never ends its states waited for, or all of them kept.
#[test]
fn states_without_an_end_are_not_waited_for() {
    let endless =
        FromFn(|_: f64, theta: f64, omega: f64, _: f64, _: u64| std::iter::repeat((theta, omega)));
    let report = judged(&endless, &Claims::order(1));
    assert_eq!(report.verdict, Verdict::Fails);
    let order = report.finding(Property::Order).expect("it is claimed");
    assert_eq!(order.why(), "more than the 8 states that were asked for", "{report}");
}

/// Answers as a hash of what is asked says, out of numbers at the limits of f64.
struct Wild {
    seed: u64,
}

impl Integrator for Wild {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let Request { start: Phase { theta, omega }, step, g_over_l, .. } = *request;
        let bits = [theta, omega, step, g_over_l].map(f64::to_bits);
        let mix = |sum: u64, x: u64| (sum ^ x).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        let mut random = Random::new(bits.into_iter().fold(self.seed, mix));
        let mut below = |n: u64| (random.between(0.0, 1.0) * n as f64) as u64;
        // Of each integrator alone: how wild it is, and in what.
        let wild = [2, 20, 500, 20_000][self.seed as usize % 4];
        if below(10 * wild) == 0 {
            return Err(Fault::Unsupported);
        }
        if below(10 * wild) == 0 {
            return Err(Fault::Refused("x".repeat(1000)));
        }
        let right = StormerVerlet.answer(request)?.states.into_iter();
        let mut one = |x: f64| {
            if below(wild) > 0 {
                return x;
            }
            let extremes =
                [f64::NAN, f64::INFINITY, f64::MAX, 1e308, 1e154, 1e15, 5e-324, 0.0, x + 1e-9, 1.0];
            let to = extremes[below(extremes.len() as u64) as usize];
            if below(2) == 0 { to } else { -to }
        };
        let mut states: Vec<Phase> =
            right.map(|z| Phase { theta: one(z.theta), omega: one(z.omega) }).collect();
        match below(5 * wild) {
            0 => states.clear(),
            1 => states.push(Phase::default()),
            2 => drop(states.pop()),
            _ => {}
        }
        let evaluations = [None, Some(0), Some(u64::MAX), Some(request.steps)][below(4) as usize];
        Ok(Reply { states, evaluations })
    }

    fn longest_run(&self) -> u64 {
        [0, 1, 19, 20, 21, 1999, 20_000, u64::MAX][(self.seed / 4) as usize % 8]
    }
}

/// Two integrators of each wildness and of each longest run.
///
/// Catches: an answer that is taken on trust: a state that is not there, a NaN that is compared, a
/// number of evaluations that overflows; a run of no steps, where none is possible in time; states
/// so large that what they round by is infinite, and a start that is asked for beside it.
#[test]
fn a_judgement_ends_whatever_is_answered() {
    let claims = extreme_claims();
    for seed in 0..64 {
        let integrator = Wild { seed };
        let claims = claims[seed as usize % claims.len()].clone();
        let report = try_judge(&Metered::new(&integrator), claims);
        let text = report.expect("it keeps the protocol").to_string();
        assert!(!text.contains("NaN"), "{seed}: {text}");
    }
}

/// Catches: a run longer than its integrator answers in time, where a shorter one would do.
#[test]
fn no_run_is_longer_than_its_stranger_allows() {
    struct Slow(u64);
    impl Integrator for Slow {
        fn answer(&self, request: &Request) -> Result<Reply, Fault> {
            Rk4.answer(request)
        }
        fn longest_run(&self) -> u64 {
            self.0
        }
    }
    for longest in [0, 1, 19, 20, 39, 1000, 2001, 7000, 30_000, u64::MAX] {
        let slow = Slow(longest);
        let metered = Metered::new(&slow);
        try_judge(&metered, Claims::order(4)).unwrap();
        let most = metered.most.get();
        assert!(most <= longest.max(2000), "{most} steps, not {longest}");
    }
}

// -------------------------------------------------------------------------------------------------
// What is read, and what is asked
// -------------------------------------------------------------------------------------------------

/// Catches: a number out of its range that is read as another one, an error of more than one line,
/// or one that does not say what is allowed.
#[test]
fn claims_are_read_within_limits() {
    for (text, claims) in [
        ("order=1 evaluations=1", Claims::order(1).evaluations(1)),
        ("order=99999 evaluations=99999", Claims::order(99_999).evaluations(99_999)),
        ("order=0002", Claims::order(2)),
        ("", Claims::none()),
        (" \t\n", Claims::none()),
    ] {
        assert_eq!(text.parse(), Ok(claims), "{text}");
    }
    let numbers = [
        "0",
        "-0",
        "-1",
        "+2",
        "1e3",
        "2.0",
        "NaN",
        "inf",
        "",
        "=2",
        "100000",
        "4294967296",
        "4294967298",
        "18446744073709551616",
        "18446744073709551618",
        "0x2",
        "２",
    ];
    for key in ["order", "evaluations"] {
        for number in numbers {
            let text = format!("{key}={number}");
            let expected = format!("{text}: {key} is a whole number from 1 to 99999");
            assert_eq!(text.parse::<Claims>().unwrap_err().to_string(), expected);
        }
        let long = format!("{key}={}", "9".repeat(1_000_000));
        let refused = long.parse::<Claims>().unwrap_err().to_string();
        assert!(refused.len() < 300 && refused.contains(" to 99999"), "{refused}");
    }
    for text in ["name=", "name=\u{1b}[31m", "rk4", "order", "symplectic=1"] {
        let refused = text.parse::<Claims>().unwrap_err().to_string();
        assert!(!refused.contains('\n') && refused.len() < 300, "{refused}");
    }
}

/// A request with each of its numbers, one after the other, at its limits.
fn extreme_requests() -> Vec<Request> {
    let drive = Drive { amplitude: 6.0, frequency: 5.0 };
    let start = Phase { theta: 1.0, omega: 0.5 };
    let usual = Request::new(9.81, start, 0.1, 20).every(5);
    let driven = usual.driven(drive);
    let with = |mut request: Request, change: &dyn Fn(&mut Request)| {
        change(&mut request);
        request
    };
    let floats = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        -f64::MAX,
        1e200,
        1e-200,
        5e-324,
        -5e-324,
        0.0,
        -0.0,
        -1.0,
    ];
    let mut all = vec![usual, driven];
    for x in floats {
        for request in [usual, driven] {
            all.push(with(request, &|request| request.g_over_l = x));
            all.push(with(request, &|request| request.start.theta = x));
            all.push(with(request, &|request| request.start.omega = x));
            all.push(with(request, &|request| request.step = x));
        }
        all.push(usual.driven(Drive { amplitude: x, ..drive }));
        all.push(usual.driven(Drive { frequency: x, ..drive }));
    }
    let counts = [0, 1, 2, 10_000_001, 1_000_000_001, u64::MAX / 2, u64::MAX - 1, u64::MAX];
    for steps in counts {
        for every in counts {
            // No more than a few steps, or refused.
            for request in [usual, driven] {
                all.push(with(request, &|request| (request.steps, request.every) = (steps, every)));
            }
        }
    }
    all
}

/// Catches: a division by a k of zero, a run of 10¹⁹ steps that is begun, room for as many states
/// asked for; a state made of a number that is none.
#[test]
fn a_request_at_its_limits_is_answered_or_refused_in_a_line() {
    let function = FromFn(|_: f64, theta: f64, omega: f64, _: f64, n: u64| {
        (0..n).map(move |_| (theta, omega))
    });
    let listed = Chosen::named("rk4").unwrap();
    let entries: [&dyn Integrator; 3] = [&StormerVerlet, &listed, &function];
    let (mut answered, mut refused) = (0, 0);
    for request in extreme_requests() {
        let Request { steps, every, start, step, .. } = request;
        let fits = every > 0 && steps > 0 && steps.is_multiple_of(every) && steps <= 1_000_000_000;
        let numbers = [start.theta, start.omega, step].iter().all(|x| x.is_finite());
        let allowed = fits && steps / every <= 10_000_000 && numbers && step != 0.0;
        // Long runs take seconds, and the library's are answered alike.
        let few = if allowed && steps > 1_000_000 { &entries[..1] } else { &entries[..] };
        for integrator in few {
            match integrator.answer(&request) {
                Ok(reply) => {
                    assert!(allowed, "{request}");
                    assert_eq!(reply.states.len() as u64, request.states(), "{request}");
                    answered += 1;
                }
                Err(Fault::Unsupported) => assert!(request.drive.is_some(), "{request}"),
                Err(Fault::Refused(why)) => {
                    assert!(!why.contains('\n') && !why.is_empty(), "{why}");
                    refused += 1;
                }
                Err(fault) => panic!("{request}: {fault}"),
            }
        }
    }
    assert!(answered > 100 && refused > 300, "{answered} answered, {refused} refused");
}

/// Catches: the panic of [`judge`] for anything but a broken protocol.
#[test]
fn only_a_broken_protocol_panics() {
    struct Broken;
    impl Integrator for Broken {
        fn answer(&self, _: &Request) -> Result<Reply, Fault> {
            Err(Fault::Broken("it ended".to_string()))
        }
    }
    let ended = Err(Fault::Broken("it ended".to_string()));
    assert_eq!(try_judge(&Broken, Claims::order(u32::MAX)), ended);
    assert!(std::panic::catch_unwind(|| judge(&Broken, Claims::order(0))).is_err());
}

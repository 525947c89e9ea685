//! The judge, on the library's own methods and on the zoo.

use std::cell::Cell;

use pendula::methods::{ForwardEuler, Gauss16, Heun, Rk4, StormerVerlet};
use pendula::{AnyMethod, method_named};
use pendula_judge::zoo::impostor_named;
use pendula_judge::{
    Chosen, Claims, Fault, FromFn, Integrator, Property, Reply, Report, Request, Verdict, judge,
    known_answers, sign_of_slopes,
};
use rstest::rstest;

use crate::looks::{Driven, Run, rk4, the_drive_at_the_steps_start, told};

/// Asserts that all claims of its entry hold, and that it is recognised.
fn assert_itself(integrator: &impl Integrator, method: &dyn AnyMethod) -> Report {
    let report = judge(integrator, Claims::of(&method.info()));
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
    let identity = report.identity.as_ref().expect("it is on the list");
    assert!(identity.is_plain() && identity.method == method.info().name, "{report}");
    report
}

/// Each with its driven pendulum, and with steps that lead back.
///
/// Catches: a judge that refuses a right method, or cannot decide.
fn our_methods_hold_their_claims(method: &dyn AnyMethod) {
    let chosen = Chosen::named(method.info().name).unwrap();
    let report = assert_itself(&chosen, method);
    let driven = report.finding(Property::StageTimes).unwrap();
    assert_eq!(driven.verdict, Verdict::Holds, "{report}");
}
each_general_method!(our_methods_hold_their_claims);

/// Some mistakes show in driven scenes only: without a drive they are the method.
///
/// Catches: a method that is known by its entry alone judged as another, or told of a mistake that
/// only a drive would show, with its claims or without.
#[test]
fn what_cannot_be_driven_holds_its_claims() {
    for method in ["taylor-24", "discrete-gradient", "cieslinski-ratkiewicz", "deuflhard", "rk4"] {
        let method = method_named(method).unwrap();
        let report = assert_itself(&Chosen::new(method), method);
        assert!(report.mistake.is_none(), "{report}");
        let report = judge(&Chosen::new(method), Claims::none());
        assert!(report.mistake.is_none(), "{report}");
    }
}

/// Wrong in what depends on g and L apart, or on the mass. The judge sends g/L alone, with which
/// they are right.
const RIGHT_BY_G_OVER_L: [&str; 3] = ["g_times_l", "l_forgotten", "mass_in_the_motion"];

/// With the claims of the method that it poses as.
///
/// Catches: a judge that lets a wrong method pass.
fn impostors_are_refused(name: &str) {
    let impostor = impostor_named(name).unwrap();
    let report = judge(&Chosen::new(&*impostor.method), Claims::of(&impostor.poses_as));
    let right = RIGHT_BY_G_OVER_L.contains(&name);
    let expected = if right { Verdict::Holds } else { Verdict::Fails };
    assert_eq!(report.verdict, expected, "{report}");
}
each_impostor!(impostors_are_refused);

/// The pendulum cannot see at which times a method evaluates its stages; a drive can.
///
/// Catches: a judge that does not test the times of the stages, or refuses right ones.
#[rstest]
#[case::right_times(rk4, Verdict::Holds)]
#[case::all_at_the_start(the_drive_at_the_steps_start, Verdict::Fails)]
fn stages_know_the_time(#[case] run: Run, #[case] expected: Verdict) {
    let report = judge(&Driven { run, g_over_l: told }, Claims::order(4));
    let found = report.finding(Property::StageTimes).unwrap();
    assert_eq!((report.verdict, found.verdict), (expected, expected), "{report}");
}

/// Catches: a mean where the largest is said, the two ends exchanged, an end of another length.
#[test]
fn the_energy_is_told_by_the_largest_error_of_either_end() {
    let report = judge(&StormerVerlet, Claims::none());
    let samples = &report.evidence.energy;
    let tenth = samples.len() / 10;
    let largest = |part: &[(f64, f64)]| part.iter().map(|s| s.1.abs()).fold(0.0, f64::max);
    let (first, last) = (largest(&samples[..tenth]), largest(&samples[9 * tenth..]));
    assert_eq!((samples.len(), tenth > 0), (10 * tenth, true), "whole tenths");
    let told = report.finding(Property::Energy).expect("it is measured");
    assert_eq!(told.values, [first, last]);
    assert!(told.measured().ends_with(" at last: bounded"), "{report}");
}

/// Störmer–Verlet with the g/L of the request before, as from a cache that is never emptied.
struct Late {
    g_over_l: Cell<Option<f64>>,
}

impl Integrator for Late {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let known = self.g_over_l.replace(Some(request.g_over_l));
        let mut late = *request;
        late.g_over_l = known.unwrap_or(request.g_over_l);
        StormerVerlet.answer(&late)
    }
}

/// Catches: a judge that asks for the same pendulum each time when it looks for what is remembered.
#[test]
fn what_remembers_the_last_pendulum_is_not_repeatable() {
    let report = judge(&Late { g_over_l: Cell::new(None) }, Claims::order(2));
    assert!(report.failures().any(|property| property == Property::Repeatable), "{report}");
}

/// Catches: an integrator that answers too little taken for one that fails nothing, and a judge
/// that gives up on it.
#[test]
fn a_state_too_few_is_a_wrong_clock() {
    let short = FromFn(|_: f64, theta: f64, omega: f64, _: f64, n: u64| {
        vec![(theta, omega); n.saturating_sub(1) as usize]
    });
    let report = judge(&short, Claims::order(1));
    assert!(report.failures().any(|property| property == Property::Clock), "{report}");
    for claims in [Claims::order(1), Claims::none()] {
        assert!(judge(&short, claims).to_string().contains("states where"), "{report}");
    }
}

// -------------------------------------------------------------------------------------------------
// What the judge says, to the word
// -------------------------------------------------------------------------------------------------

/// RK4 whose states have the digits of single precision.
struct Single;

impl Integrator for Single {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let mut reply = Rk4.answer(request)?;
        for z in &mut reply.states {
            (z.theta, z.omega) = (f64::from(z.theta as f32), f64::from(z.omega as f32));
        }
        Ok(reply)
    }
}

/// RK4 that adds a thousandth of x³, where x = h √(g/L), to the angle after each step.
struct Nearly;

impl Integrator for Nearly {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        if request.drive.is_some() {
            return Err(Fault::Unsupported);
        }
        let mut reply = Reply::default();
        let mut one = Request::new(request.g_over_l, request.start, request.step, 1);
        for n in 1..=request.steps {
            one.start = Rk4.answer(&one)?.states[0];
            one.start.theta += 1e-3 * (request.step * request.g_over_l.sqrt()).powi(3);
            if n % request.every == 0 {
                reply.states.push(one.start);
            }
        }
        Ok(reply)
    }
}

/// Refuses every request.
struct Silent;

impl Integrator for Silent {
    fn answer(&self, _: &Request) -> Result<Reply, Fault> {
        Err(Fault::Refused("the table is empty".to_string()))
    }
}

/// With each verdict of each property but a few. When the judge speaks otherwise: the new text is
/// that which the failure prints.
///
/// Catches: a word, a number, a bound or a unit in a report that is another one, or is missing.
#[test]
fn the_reports_are_these() {
    let all = || Claims::order(2).symplectic().symmetric().bounded_energy().evaluations(2);
    let reports = [
        judge(&ForwardEuler, all().name("rk4")),
        judge(&Gauss16, Claims::order(16).symplectic().symmetric().bounded_energy()),
        judge(
            &Chosen::new(method_named("stormer-verlet").unwrap()),
            Claims::order(2).name("stormer-verlet"),
        ),
        judge(&Single, Claims::order(4).symmetric().name("rk4")),
        judge(&Nearly, Claims::order(2)),
        judge(&Heun, Claims::none()),
        judge(&Silent, Claims::order(2)),
        judge(&Silent, Claims::none()),
    ];
    let said = reports.map(|report| {
        let bounds = report.findings.iter().filter_map(|x| Some((x.property, x.bound?, x.unit)));
        let bounds =
            bounds.map(|(name, bound, unit)| format!("{name} within {bound:.4e} {unit}\n"));
        format!("{report}{}", bounds.collect::<String>())
    });
    crate::assert_text("reports.txt", &said.join("\n"));
    let in_a_test = || judge(&Silent, Claims::order(2)).assert();
    assert!(std::panic::catch_unwind(in_a_test).is_err(), "nothing was measured");
}

/// Slopes near the order at first, which fall without a rise of 0.05 to less than half an order
/// below it: all four on both sides.
///
/// Catches: a sign that is seen where there is none, or not where there is one.
#[test]
fn falling_slopes_are_a_sign() {
    let digits = "The slopes fall from 4 to 3.49 as the steps become short: a coefficient has too \
                  few digits";
    assert_eq!(sign_of_slopes(4, &[4.49, 4.53, 3.49]).as_deref(), Some(digits));
    assert!(sign_of_slopes(4, &[3.51, 3.0, 0.5]).unwrap().ends_with("too few digits"));
    let other = "it solves another equation, of which a coefficient differs slightly";
    assert!(sign_of_slopes(4, &[4.0, 1.0, 0.49]).unwrap().ends_with(other));
    for slopes in [&[4.51, 4.0, 3.4][..], &[3.49, 3.0], &[4.0, 4.06, 3.4], &[4.0, 3.51], &[]] {
        assert_eq!(sign_of_slopes(4, slopes), None, "{slopes:?}");
    }
}

/// Catches: a distance from a known answer that has another unit, or looks at one number alone.
#[test]
fn the_distance_from_a_known_answer_is_in_tolerances() {
    let answer = known_answers::method("rk4").unwrap().answers[0];
    let size = answer.state.theta.abs().max(answer.state.omega.abs());
    let miss = 4.0 * answer.tolerance * f64::EPSILON * size;
    for (theta, omega, by) in [(1.0, 0.0, 4.0), (0.0, -1.0, 4.0), (2.0, -1.0, 8.0)] {
        let mut state = answer.state;
        (state.theta, state.omega) = (state.theta + theta * miss, state.omega + omega * miss);
        // A sum rounds by half an ε, as the angle lies between 1 and 2; a tolerance is larger.
        let off = answer.off(state, f64::EPSILON);
        assert!((off - by).abs() <= 0.5 / answer.tolerance, "{off} for {by}");
    }
    assert!(answer.off(answer.state * f64::NAN, f64::EPSILON).is_nan());
}

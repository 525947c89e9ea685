//! Programs that answer with numbers at the limits of f64, and claims at theirs: a verdict, or one
//! line, and a page that can be drawn.

use pendula_judge::formats::{self, Judged};
use pendula_judge::{
    Claims, FromFn, Integrator, Report, SolveFn, Solver, try_judge, try_judge_solver,
};
use pendula_program::verify::page;
use rstest::rstest;

use super::{assert_valid, judged, request, started};
use crate::{PENDULA, assert_refused};

/// Fails unless the report is written in each form.
#[track_caller]
fn assert_written(report: &Report, claims: &Claims) {
    let judged = Judged { command: "x", name: "", claims, report };
    assert_valid(&formats::json(&judged));
    let (junit, markdown) = (formats::junit(&judged, true), formats::markdown(&judged));
    let html = page::html(&judged, "2026-01-02");
    for text in [&junit, &markdown, &html] {
        assert!(!text.contains("NaN"), "{text}");
        // The page of a right method has 0.3 MB, most of it the curve of the energy.
        assert!(text.len() < 1_000_000, "{} bytes", text.len());
    }
    // A difference may be infinite, in words; the place of a point is not.
    let drawings = html.split("<svg").skip(1).filter_map(|rest| rest.split("</svg>").next());
    for drawing in drawings {
        let attributes = drawing.split('"').skip(1).step_by(2);
        let infinite: Vec<&str> = attributes.filter(|value| value.contains("inf")).collect();
        assert!(infinite.is_empty(), "{infinite:?}");
    }
}

/// An integrator whose state after step k from (θ, ω) is that.
fn of(state: fn(f64, f64, u64) -> (f64, f64)) -> Box<dyn Integrator> {
    Box::new(FromFn(move |_: f64, theta: f64, omega: f64, _: f64, n: u64| {
        (1..=n).map(move |k| state(theta, omega, k))
    }))
}

/// Catches: a page whose axes have no end or no span, or whose slope is no number; a value in JSON
/// that is none, a figure of megabytes.
#[rstest]
#[case::at_rest(of(|theta, omega, _| (theta, omega)))]
#[case::huge(of(|_, _, _| (f64::MAX, f64::MAX)))]
#[case::huge_to_and_fro(of(|_, _, k| [(f64::MAX, -1e308), (-f64::MAX, 1e308)][k as usize % 2]))]
#[case::far(of(|theta, omega, k| (theta * 1e300, omega * k as f64 * 1e300)))]
#[case::away(of(|theta, omega, k| (theta * 2.0_f64.powi(k as i32), omega)))]
#[case::subnormal(of(|_, _, k| (5e-324 * k as f64, -5e-324)))]
#[case::nothing(of(|_, _, _| (0.0, -0.0)))]
#[case::nearly_one(of(|_, _, k| (if k % 2 == 0 { 1.0 } else { 1.0_f64.next_up() }, 1.0)))]
#[case::nan(of(|_, _, _| (f64::NAN, 0.0)))]
#[case::infinite(of(|_, _, _| (0.0, f64::INFINITY)))]
fn a_report_is_written_whatever_is_measured(#[case] integrator: Box<dyn Integrator>) {
    let all = || Claims::order(2).symplectic().symmetric().bounded_energy();
    let orders = [0, 1, 99_999, u32::MAX].map(Claims::order);
    let more = [Claims::none(), all().evaluations(0), all().evaluations(u64::MAX).name("\0")];
    for claims in orders.iter().chain(&more) {
        let report = try_judge(&*integrator, claims.clone()).expect("it keeps the protocol");
        assert_written(&report, claims);
    }
}

/// A solver whose state at each time is that, and which counts so many evaluations.
fn solver(state: fn(f64, f64, f64) -> (f64, f64), counted: u64) -> Box<dyn Solver> {
    Box::new(SolveFn(
        move |_: f64, theta: f64, omega: f64, _: f64, tolerance: f64, times: &[f64]| {
            (vec![state(theta, omega, tolerance); times.len()], counted)
        },
    ))
}

/// Catches: a page whose axes have no end or no span, a slope without a number, NaN in words.
#[rstest]
#[case::at_rest(solver(|theta, omega, _| (theta, omega), 1))]
#[case::huge(solver(|_, _, _| (f64::MAX, -f64::MAX), u64::MAX / 3))]
#[case::far(solver(|theta, omega, tolerance| (theta * 1e300, omega / tolerance), 0))]
#[case::subnormal(solver(|_, _, _| (5e-324, -5e-324), 1000))]
#[case::nothing(solver(|_, _, _| (0.0, -0.0), 0))]
#[case::nan(solver(|_, _, _| (f64::NAN, 0.0), 7))]
#[case::infinite(solver(|_, _, _| (0.0, f64::INFINITY), 7))]
fn a_report_on_a_solver_is_written_whatever_is_measured(#[case] solver: Box<dyn Solver>) {
    let all = || Claims::order(5).estimate(5).free_outputs().crossings();
    let orders = [0, 1, 99_999, u32::MAX].map(|order| Claims::order(order).estimate(order));
    for claims in orders.iter().chain(&[Claims::none(), all(), all().symplectic()]) {
        let report = try_judge_solver(&*solver, claims.clone()).expect("it solves");
        assert_written(&report, claims);
    }
}

/// A program that answers each request with as many states as it asks for, by turns huge and
/// subnormal. What the judge makes of states that are all of one kind is asked above, without a
/// program.
#[cfg(unix)]
const BY_TURNS: &str = "read -r line; echo hello 1; while read -r kind g a w h n k; do \
       case $kind in \
         pendulum) yes '1e308 -1.7976931348623157e308
4.9e-324 -1e-400' | head -n $((n / k)); echo done 18446744073709551615;; \
         bye) exit;; \
         *) echo unsupported;; \
       esac; \
     done";

/// Catches: a number of an answer that ends the reader of the protocol, or the judge; a count of
/// evaluations that overflows.
#[cfg(unix)]
#[test]
fn a_program_with_extreme_answers_is_judged() {
    let words = ["sh", "-c", BY_TURNS];
    let program = started(words, 600.0).expect("it keeps the protocol");
    let reply = program.answer(&request(0.1, 2).every(1)).expect("two states");
    let numbers = reply.states.iter().flat_map(|z| [z.theta, z.omega]);
    assert!(numbers.eq([1e308, -f64::MAX, 5e-324, -0.0]), "{reply:?}");
    assert_eq!(reply.evaluations, Some(u64::MAX));
    let claims = "order=99999 symplectic symmetric bounded-energy evaluations=99999";
    let (status, report) = judged(&["--claims", claims], &words);
    assert_eq!((status, report["verdict"].as_str()), (1, Some("fails")), "{report:#}");
    let properties = report["properties"].as_array().expect("there are properties");
    let order = properties.iter().find(|property| property["name"] == "order");
    assert_eq!(order.map(|order| &order["verdict"]), Some(&"fails".into()), "{report:#}");
}

/// Catches: a claim or a patience out of its range that is taken for another one, or for none.
#[test]
fn numbers_out_of_range_are_refused_with_what_is_allowed() {
    let program = [PENDULA, "serve", "rk4"];
    let refused = |option: &str, value: &str, because: &str| {
        let words = [&["verify", option, value, "--"], &program[..]].concat();
        assert_refused(&words, because);
    };
    for claim in ["order", "evaluations"] {
        for number in ["0", "-1", "+2", "1e3", "nan", "inf", "", "100000", "18446744073709551618"] {
            let because = format!("{claim} is a whole number from 1 to 99999");
            refused("--claims", &format!("{claim}={number}"), &because);
        }
    }
    refused("--claims", &format!("order={}", "9".repeat(10_000)), "from 1 to 99999");
    refused("--claims", "name=\u{1b}[31m", "no method of");
    for patience in ["0", "-0", "5e-324", "1e-10", "nan", "inf", "86400.1", "1e308"] {
        refused("--patience", patience, "");
    }
}

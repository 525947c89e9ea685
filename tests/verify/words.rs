//! What the judge says, to the word.

use pendula::methods::{ForwardEuler, Gauss16, Heun, Rk4, StormerVerlet};
use pendula::verify::{
    Claims, Fault, Listed, Reply, Request, Stranger, judge, known_answers, sign_of_slopes,
};

/// RK4 whose states have the digits of single precision.
struct Single;

impl Stranger for Single {
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

impl Stranger for Nearly {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        if request.drive.is_some() {
            return Err(Fault::Unsupported);
        }
        let mut reply = Reply::default();
        let mut one = Request { steps: 1, every: 1, ..*request };
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

impl Stranger for Silent {
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
        judge(&Listed(&StormerVerlet), Claims::order(2).name("stormer-verlet")),
        judge(&Single, Claims::order(4).symmetric().name("rk4")),
        judge(&Nearly, Claims::order(2)),
        judge(&Heun, Claims::none()),
        judge(&Silent, Claims::order(2)),
        judge(&Silent, Claims::none()),
    ];
    let said = reports.map(|report| {
        let bounds = report.findings.iter().filter_map(|x| Some((x.name, x.bound?, x.unit)));
        let bounds =
            bounds.map(|(name, bound, unit)| format!("{name} within {bound:.4e} {unit}\n"));
        format!("{report}{}", bounds.collect::<String>())
    });
    assert_eq!(said.join("\n"), include_str!("reports.txt"), "\n{}", said.join("\n"));
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

//! Solvers that are right and do not do all that can be asked of one: that run forward only, have a
//! cubic between their steps, compute in single precision, or hang at the impossible. Each holds by
//! the claim that says so, and a wrong one does not.

use std::cell::Cell;

use pendula::Phase;
use pendula_judge::{
    Claims, Fault, FromFn, Integrator, Property, Reply, Report, Request, SolveFn, SolveRequest,
    Solver, Verdict, judge, judge_solver,
};
use rstest::rstest;

/// Stages and weights of an embedded method, of the result and of the other one.
struct Tableau {
    a: &'static [&'static [f64]],
    b: &'static [f64],
    other: &'static [f64],
    /// The power of the step with which the estimate falls.
    power: f64,
}

const HEUN: Tableau = Tableau { a: &[&[], &[1.0]], b: &[0.5, 0.5], other: &[1.0, 0.0], power: 2.0 };

const BOGACKI_SHAMPINE: Tableau = Tableau {
    a: &[&[], &[0.5], &[0.0, 0.75], &[2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0]],
    b: &[2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0],
    other: &[7.0 / 24.0, 0.25, 1.0 / 3.0, 0.125],
    power: 3.0,
};

const DORMAND_PRINCE: Tableau = Tableau {
    a: &[
        &[],
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    b: &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
    other: &[
        5179.0 / 57600.0,
        0.0,
        7571.0 / 16695.0,
        393.0 / 640.0,
        -92097.0 / 339_200.0,
        187.0 / 2100.0,
        0.025,
    ],
    power: 5.0,
};

/// What is between steps.
#[derive(Clone, Copy, PartialEq)]
enum Between {
    /// Steps end at the outputs.
    Nothing,
    /// Hermite's cubic.
    Cubic,
    /// The same, with slopes that are not those of a step of h, but of one second.
    CubicWithoutStep,
    Line,
}

/// A solver, as people write one.
struct Honest {
    tableau: Tableau,
    single: bool,
    between: Between,
    counts: bool,
    /// Of the state, in each step, as a constant of few digits makes it.
    off: f64,
}

impl Honest {
    const fn of(tableau: Tableau) -> Self {
        Self { tableau, single: false, between: Between::Nothing, counts: true, off: 0.0 }
    }

    /// A number as it is kept. Of a sum or a product of numbers in single precision this is that of
    /// single precision.
    fn kept(&self, x: f64) -> f64 {
        if self.single { f64::from(x as f32) } else { x }
    }

    fn sum(&self, terms: impl IntoIterator<Item = f64>) -> f64 {
        terms.into_iter().fold(0.0, |sum, term| self.kept(sum + self.kept(term)))
    }
}

impl Solver for Honest {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let SolveRequest { g_over_l, drive, start, from, tolerance, ref times, .. } = *request;
        if drive.is_some() {
            return Err(Fault::Unsupported);
        }
        assert!(tolerance > 0.0 && times.iter().all(|t| t.is_finite()), "it would hang: {request}");
        assert!(times.iter().all(|t| *t >= from), "it would never return: {request}");
        let count = Cell::new(0);
        let g = self.kept(g_over_l);
        let rate = |z: [f64; 2]| {
            count.set(count.get() + 1);
            [z[1], self.kept(-g * self.kept(z[0].sin()))]
        };
        let frequency = g.sqrt();
        let (mut t, mut z) = (self.kept(from), [start.theta, start.omega].map(|x| self.kept(x)));
        let mut step = self.kept(0.01 / frequency);
        let mut states = Vec::new();
        let mut left = times.iter().map(|t| self.kept(*t)).peekable();
        while left.next_if(|until| *until <= t).is_some() {
            states.push(Phase { theta: z[0], omega: z[1] });
        }
        let end = times.iter().copied().fold(t, f64::max);
        while let Some(&next) = left.peek() {
            let until = if self.between == Between::Nothing { next } else { self.kept(end) };
            let is_last = t + step >= until;
            let h = if is_last { self.kept(until - t) } else { step };
            if !is_last && self.kept(t + h) == t {
                return Err(Fault::Refused("the step is too small".to_string()));
            }
            let mut slopes: Vec<[f64; 2]> = Vec::new();
            let moved = |slopes: &[[f64; 2]], weights: &[f64]| {
                [0, 1].map(|i| {
                    let terms = slopes.iter().zip(weights).map(|(k, a)| self.kept(a * k[i]));
                    self.kept(h * self.sum(terms))
                })
            };
            for row in self.tableau.a {
                let by = moved(&slopes, row);
                slopes.push(rate([0, 1].map(|i| self.kept(z[i] + by[i]))));
            }
            let by = moved(&slopes, self.tableau.b);
            let other = moved(&slopes, self.tableau.other);
            let new = [0, 1].map(|i| self.kept(z[i] + by[i] + self.off * h));
            let allowed = [1.0, frequency];
            let error = [0, 1].map(|i| {
                let size = z[i].abs().max(new[i].abs());
                ((by[i] - other[i]) / (tolerance * (allowed[i] + size))).abs()
            });
            let error = error[0].max(error[1]);
            let factor = (0.9 * error.powf(-1.0 / self.tableau.power)).clamp(0.2, 5.0);
            if error > 1.0 {
                step = self.kept(h * factor);
                continue;
            }
            let arrived = if is_last { until } else { self.kept(t + h) };
            let (before, after) = (rate(z), rate(new));
            while let Some(next) = left.next_if(|next| *next <= arrived) {
                let s = (next - t) / h;
                let scale = if self.between == Between::CubicWithoutStep { 1.0 } else { h };
                let hermite = |i: usize| {
                    let bend = s
                        * (s - 1.0)
                        * ((1.0 - 2.0 * s) * (new[i] - z[i])
                            + (s - 1.0) * scale * before[i]
                            + s * scale * after[i]);
                    (1.0 - s) * z[i] + s * new[i] + bend
                };
                let state = match self.between {
                    _ if next == arrived => new,
                    Between::Line => [0, 1].map(|i| (1.0 - s) * z[i] + s * new[i]),
                    _ => [0, 1].map(hermite),
                }
                .map(|x| self.kept(x));
                states.push(Phase { theta: state[0], omega: state[1] });
            }
            // A step that was cut short says little about the next.
            step = if is_last && factor >= 1.0 { step } else { self.kept(h * factor) };
            (t, z) = (arrived, new);
        }
        Ok(Reply { states, evaluations: self.counts.then(|| count.get()) })
    }
}

#[track_caller]
fn judged(solver: &dyn Solver, claims: &str) -> Report {
    judge_solver(solver, claims.parse().unwrap())
}

/// What fails, and what else does not hold.
fn open(report: &Report) -> Vec<(&'static str, Verdict)> {
    let claimed = report.findings.iter().filter(|it| it.claimed.is_some());
    claimed
        .filter(|it| it.verdict != Verdict::Holds)
        .map(|it| (it.property.name(), it.verdict))
        .collect()
}

/// Catches: a right solver that cannot be green since it runs forward only, or a question backwards
/// to one, which would never return; a closure that is asked for what no right one need answer.
#[rstest]
#[case::heun(HEUN, "order=2 estimate=2 forward-only")]
#[case::bogacki_shampine(BOGACKI_SHAMPINE, "order=3 estimate=3 forward-only")]
#[case::dormand_prince(DORMAND_PRINCE, "order=5 estimate=5 forward-only")]
fn what_runs_forward_holds(#[case] tableau: Tableau, #[case] claims: &str) {
    let report = judged(&Honest::of(tableau), claims);
    assert_eq!((report.verdict, open(&report)), (Verdict::Holds, vec![]), "{report}");
    let back = report.finding(Property::Back).unwrap();
    assert!(back.claimed.is_none() && back.why().contains("forward-only is claimed"), "{report}");
}

/// Catches: a right solver in single precision that cannot be green; bounds of double precision on
/// it; a question for a tolerance, or for times, that single precision does not have. (Between its
/// rounding and the long steps of order 5 there is too little to tell the power of an estimate.)
#[rstest]
#[case::heun(HEUN, "order=2 estimate=2 forward-only single-precision")]
#[case::bogacki_shampine(BOGACKI_SHAMPINE, "order=3 estimate=3 forward-only single-precision")]
#[case::dormand_prince(DORMAND_PRINCE, "order=5 forward-only single-precision")]
fn what_computes_in_single_precision_holds(
    #[case] tableau: Tableau,
    #[case] claims: &str,
    #[values(Between::Nothing, Between::Cubic)] between: Between,
) {
    let solver = Honest { single: true, between, ..Honest::of(tableau) };
    let claims = if between == Between::Cubic { &format!("{claims} outputs=3") } else { claims };
    let report = judged(&solver, claims);
    assert_eq!((report.verdict, open(&report)), (Verdict::Holds, vec![]), "{report}");
}

/// Catches: single precision that passes where nobody claims it; a mistake of 1 % that is held for
/// rounding because it is claimed.
#[test]
fn single_precision_excuses_no_mistake() {
    let solver = Honest { single: true, ..Honest::of(BOGACKI_SHAMPINE) };
    let report = judged(&solver, "order=3 forward-only");
    assert!(report.failures().any(|name| name == Property::Precision), "{report}");
    let wrong = Honest { off: 0.01, ..solver };
    let report = judged(&wrong, "order=3 forward-only single-precision");
    assert!(report.failures().any(|name| name == Property::Tolerance), "{report}");
}

/// Catches: a cubic between the steps that cannot be green though it is claimed; one that is green
/// and is not claimed; a claim of a cubic that holds for a line, or for a cubic whose slopes are
/// wrong, or where nobody counts, so that no power is known.
#[rstest]
#[case::cubic(Between::Cubic, "outputs=3", &[])]
#[case::cubic_and_no_claim(Between::Cubic, "", &[("output", Verdict::Fails)])]
#[case::line_for_a_cubic(Between::Line, "outputs=3", &[("output", Verdict::Fails)])]
#[case::line(Between::Line, "outputs=1", &[])]
#[case::better(Between::Nothing, "outputs=3", &[])]
#[case::wrong_cubic(Between::CubicWithoutStep, "outputs=3", &[("output", Verdict::Fails)])]
fn outputs_are_judged_by_their_degree(
    #[case] between: Between,
    #[case] claim: &str,
    #[case] expected: &[(&str, Verdict)],
) {
    let solver = Honest { between, ..Honest::of(DORMAND_PRINCE) };
    let report = judged(&solver, &format!("order=5 estimate=5 forward-only {claim}"));
    let of_output: Vec<_> = open(&report).into_iter().filter(|it| it.0 == "output").collect();
    assert_eq!(of_output, expected, "{report}");
    if expected.is_empty() {
        assert_eq!(open(&report), [], "{report}");
    }
    let uncounted = Honest { counts: false, ..solver };
    let report = judged(&uncounted, &format!("order=5 forward-only {claim}"));
    let output = report.finding(Property::Output).unwrap().verdict;
    let is_open = [Between::Cubic, Between::Line].contains(&between) && !claim.is_empty();
    assert!(!is_open || output == Verdict::Unclear, "{report}");
}

/// Catches: a closure that is asked for a time that never comes, which it may never return from;
/// one that claims to refuse it and is not asked.
#[test]
fn a_closure_is_asked_for_the_impossible_if_it_refuses() {
    let impossible = Cell::new(0);
    let solver = SolveFn(|g: f64, theta: f64, omega: f64, from: f64, tol: f64, times: &[f64]| {
        if !(tol > 0.0 && times.iter().all(|t| t.is_finite())) {
            impossible.set(impossible.get() + 1);
            return Err(Fault::Refused("no".to_string()));
        }
        let request = SolveRequest::new(g, Phase { theta, omega }, tol).from(from).to(times);
        let reply = Honest::of(HEUN).solve(&request)?;
        let states: Vec<_> = reply.states.into_iter().map(|z| (z.theta, z.omega)).collect();
        Ok((states, reply.evaluations.unwrap_or_default()))
    });
    let report = judge_solver(&solver, Claims::order(2).forward_only());
    assert_eq!((report.verdict, impossible.get()), (Verdict::Holds, 0), "{report}");
    assert!(report.finding(Property::Refusal).unwrap().claimed.is_none(), "{report}");
    let report = judge_solver(&solver, Claims::order(2).forward_only().refuses());
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
    assert!(impossible.get() >= 4);
}

/// Störmer–Verlet in single precision.
fn verlet(g: f32, mut theta: f32, mut omega: f32, h: f32, n: u64) -> Vec<(f64, f64)> {
    let mut step = || {
        omega -= 0.5 * h * (g * theta.sin());
        theta += h * omega;
        omega -= 0.5 * h * (g * theta.sin());
        (f64::from(theta), f64::from(omega))
    };
    (0..n).map(|_| step()).collect()
}

/// Catches: equal steps in single precision that cannot be green though it is claimed; double
/// precision that is not asked for where it is not claimed; a rounding of a thousandth that passes.
#[test]
fn equal_steps_in_single_precision_hold() {
    let single = FromFn(|g: f64, theta: f64, omega: f64, h: f64, n: u64| {
        verlet(g as f32, theta as f32, omega as f32, h as f32, n)
    });
    let claims = Claims::order(2).symplectic().symmetric();
    let report = judge(&single, claims.clone());
    assert!(report.failures().any(|name| name == Property::Precision), "{report}");
    let report = judge(&single, claims.single_precision());
    assert_eq!(open(&report), [], "{report}");
    let coarse = FromFn(|g: f64, theta: f64, omega: f64, h: f64, n: u64| {
        let rows = verlet(g as f32, theta as f32, omega as f32, h as f32, n).into_iter();
        let rounded = |x: f64| (x * 500.0).round() / 500.0;
        rows.map(|(theta, omega)| (rounded(theta), rounded(omega))).collect::<Vec<_>>()
    });
    let report = judge(&coarse, Claims::order(2).single_precision());
    assert_ne!(report.verdict, Verdict::Holds, "{report}");
}

/// A method that never returns from a step back.
struct Onward(Cell<u64>);

impl Integrator for Onward {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        assert!(request.step > 0.0, "it would never return: {request}");
        self.0.set(self.0.get() + 1);
        pendula::StormerVerlet.answer(request)
    }
}

/// Catches: equal steps that are asked for a step back though it is claimed that there is none; a
/// right method without one that cannot be green.
#[test]
fn equal_steps_forward_hold() {
    let onward = Onward(Cell::new(0));
    let claims = "order=2 symplectic evaluations=1 name=stormer-verlet forward-only";
    let report = judge(&onward, claims.parse().unwrap());
    assert_eq!((report.verdict, open(&report)), (Verdict::Holds, vec![]), "{report}");
    assert!(onward.0.get() > 100);
}

/// Catches: a name that many use, as it is written or with a slip, that leads to other methods or
/// to none; the same method by two names that is taken for two.
#[test]
fn names_are_proposed_that_can_be_meant() {
    let told = |name: &str| match format!("name={name}").parse::<Claims>() {
        Ok(_) => "accepted".to_string(),
        Err(error) => error.to_string().split_once("there are ").unwrap().1.to_string(),
    };
    for name in ["leapfrog", "velocity-verlet", "Velocity_Verlet", "RK45", "euler-cromer", "Vern7"]
    {
        assert_eq!(told(name), "accepted", "{name}");
    }
    for (name, meant) in [
        ("verlet", "stormer-verlet, position-verlet"),
        ("störmer-verlet", "stormer-verlet"),
        ("stromer-verlet", "stormer-verlet"),
        ("dormand-prince-45", "dormand-prince-8, dop853, dormand-prince-5"),
        ("something", "rk4, stormer-verlet, …"),
        ("", "rk4, stormer-verlet, …"),
    ] {
        assert!(told(name).contains(meant), "{name}: {}", told(name));
    }
    let report = judge(&pendula::StormerVerlet, "name=velocity-verlet".parse().unwrap());
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
}

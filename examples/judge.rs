//! A method of one's own, judged: as a `Method`, and as a plain function.

use pendula::{Method, System};
use pendula_judge::{Claims, FromFn, judge};

/// Ralston's method of order 2.
struct Ralston;

impl<S: System> Method<S> for Ralston {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let k1 = system.rate(t, z);
        let k2 = system.rate(t + h * 2.0 / 3.0, z + k1 * (h * 2.0 / 3.0));
        z + k1 * (h / 4.0) + k2 * (h * 3.0 / 4.0)
    }
}

/// θ and ω after 1, 2, … n steps of h.
fn leapfrog(
    g_over_l: f64,
    mut theta: f64,
    mut omega: f64,
    h: f64,
    n: u64,
) -> impl Iterator<Item = (f64, f64)> {
    (0..n).map(move |_| {
        omega -= 0.5 * h * g_over_l * theta.sin();
        theta += h * omega;
        omega -= 0.5 * h * g_over_l * theta.sin();
        (theta, omega)
    })
}

fn main() {
    let report = judge(&Ralston, Claims::order(2).evaluations(2));
    println!("{report}");
    report.assert();

    let claims = Claims::order(2).symplectic().symmetric();
    let report = judge(&FromFn(leapfrog), claims);
    println!("{report}");
    report.assert();

    // What is claimed wrongly is refused, with the reason.
    let refused = judge(&Ralston, Claims::order(2).symplectic());
    println!("{refused}");
    assert!(refused.failures().next().is_some());
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn they_are_what_they_claim() {
    main();
}

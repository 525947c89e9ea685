//! A step of one's own, judged: what it claims, and what it claims wrongly.

use pendula_judge::{Claims, FromStep, judge};

fn main() {
    let leapfrog = FromStep::new(|force, theta, omega, h| {
        let omega = omega + h / 2.0 * force(theta);
        let theta = theta + h * omega;
        (theta, omega + h / 2.0 * force(theta))
    });
    let report = judge(&leapfrog, Claims::order(2).symplectic().symmetric());
    println!("{report}");
    report.assert();
    // It is refused, with the reason.
    let refused = judge(&leapfrog, Claims::order(4));
    println!("{refused}");
    assert!(refused.failures().next().is_some());
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_is_what_it_claims() {
    main();
}

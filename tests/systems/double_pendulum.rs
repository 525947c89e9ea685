//! The double pendulum: its equations derived in two ways, its modes, its energy, and how fast two
//! neighbouring motions separate.

use std::f64::consts::{PI, SQRT_2};

use approx::{assert_abs_diff_eq, assert_relative_eq};
use pendula::methods::{Gauss4, Gauss6, ImplicitMidpoint, Rk4};
use pendula::metrics::EnergyDrift;
use pendula::systems::{DoublePendulum, DoublePhase, Joint, LARGEST_MASS_RATIO};
use pendula::{Grid, Hamiltonian, Method, RateOf, System, integrate, integrate_with};
use pendula_study::dynamics::{mode_shapes, normal_modes};
use pendula_study::experiments::beyond::{equals, separation, swing_frequency};

/// All parameters differ, so that exchanging two of them shows.
fn unequal() -> DoublePendulum {
    let (upper, lower) = (Joint { length: 1.3, mass: 0.7 }, Joint { length: 0.6, mass: 1.9 });
    DoublePendulum::new(9.81, upper, lower).unwrap()
}

/// Angles and angular velocities from all over phase space.
const STATES: [([f64; 2], [f64; 2]); 5] = [
    ([0.0, 0.0], [1.0, -2.0]),
    ([0.3, -0.2], [0.0, 0.0]),
    ([2.0, 2.5], [-1.0, 0.5]),
    ([-3.0, 1.2], [4.0, -3.0]),
    ([1.0, 1.0 + PI], [0.7, 5.0]),
];

/// Kinetic and potential energy of the bobs: ½ Σ m v² + Σ m g y, zero when both hang at rest.
fn energy_of_the_bobs(double: &DoublePendulum, [t1, t2]: [f64; 2], [w1, w2]: [f64; 2]) -> f64 {
    let (upper, lower) = (double.upper(), double.lower());
    let (l1, l2) = (upper.length, lower.length);
    let (vx1, vy1) = (l1 * w1 * t1.cos(), l1 * w1 * t1.sin());
    let (vx2, vy2) = (vx1 + l2 * w2 * t2.cos(), vy1 + l2 * w2 * t2.sin());
    let (y1, y2) = (l1 * (1.0 - t1.cos()), l1 * (1.0 - t1.cos()) + l2 * (1.0 - t2.cos()));
    0.5 * upper.mass * (vx1 * vx1 + vy1 * vy1)
        + 0.5 * lower.mass * (vx2 * vx2 + vy2 * vy2)
        + double.gravity() * (upper.mass * y1 + lower.mass * y2)
}

/// The Hamiltonian is the energy of the two bobs, and the momenta give back the velocities.
///
/// Catches: m₁ for m₁ + m₂, a cosine of the sum for that of the difference, a factor 2 in the
/// coupling, an energy that is not zero at rest.
#[test]
fn the_hamiltonian_is_the_energy_of_the_bobs() {
    for double in [equals(), unequal()] {
        for (theta, omega) in STATES {
            let z = double.start(theta, omega).unwrap();
            // Energies of up to 100 J, rounded some twenty times.
            let energy = energy_of_the_bobs(&double, theta, omega);
            assert_abs_diff_eq!(double.energy(z), energy, epsilon = 2e-13);
            let back = double.velocities(z);
            assert_abs_diff_eq!(back[0], omega[0], epsilon = 1e-13);
            assert_abs_diff_eq!(back[1], omega[1], epsilon = 1e-13);
            let [(x1, y1), (x2, y2)] = double.bobs(z);
            let (l1, l2) = (double.upper().length, double.lower().length);
            assert_abs_diff_eq!(x1, l1 * theta[0].sin(), epsilon = 1e-15);
            assert_abs_diff_eq!(y1, -l1 * theta[0].cos(), epsilon = 1e-15);
            assert_abs_diff_eq!(x2 - x1, l2 * theta[1].sin(), epsilon = 1e-15);
            assert_abs_diff_eq!(y2 - y1, -l2 * theta[1].cos(), epsilon = 1e-15);
        }
    }
    assert_eq!(unequal().energy(DoublePhase::default()), 0.0);
}

/// Velocities that become momenta and velocities again, over all ratios of the masses, with the
/// rods in line or nearly so, where the momenta are hardest to undo; or a refusal.
///
/// With u = ε/2, r = m₂/m₁ and V = L₁|ω₁| + L₂|ω₂|: each momentum is a sum of products of six
/// factors at most, p₁/L₁ ≤ (m₁ + m₂)V off by 5u of that, and p₂/L₂ ≤ m₂V by 5u; the numerator of a
/// velocity doubles that and adds 3u for its own products; the denominator, m₁ + m₂ sin² Δ, is off
/// by 7u(m₁ + m₂), as sin² Δ + cos² Δ = 1 only to rounding; and all is divided by m₁: 32u(1 + r)V
/// at most. Where m₁ is the larger the same holds without r.
///
/// Catches: velocities that are lost in momenta of the other bob, and printed as if they were right
/// (ω₂ = 0.5058 for 0.5); a limit on the wrong ratio; a conversion that loses more than it must.
#[test]
fn velocities_survive_as_momenta() {
    for exponent in -16..=16 {
        let ratio = 10_f64.powi(exponent);
        for (m1, m2, l1, l2) in [
            (1.0, ratio, 1.0, 1.0),
            (1.0 / ratio, 1.0, 0.3, 2.0),
            (3.0 / ratio.sqrt(), 3.0 * ratio.sqrt(), 2.5, 0.1),
        ] {
            let joints = [Joint { length: l1, mass: m1 }, Joint { length: l2, mass: m2 }];
            let double = DoublePendulum::new(9.81, joints[0], joints[1]);
            // The ratios are off by a few roundings; that of the limit itself may be on either
            // side.
            if exponent > 6 {
                let refused = double.unwrap_err().to_string();
                assert!(refused.contains("m₂/m₁") && refused.contains("at most 1e6"), "{refused}");
                continue;
            }
            if m2 / m1 > LARGEST_MASS_RATIO {
                continue;
            }
            let double = double.unwrap();
            let tolerance = 16.0 * f64::EPSILON * (1.0 + ratio);
            assert!(tolerance < 1e-8);
            for delta in [0.0, 1e-12, 1e-6, 1e-3, 0.3, 1.5, PI - 1e-9, PI] {
                for omega in [[1.0, 0.5], [1.0, -0.5], [-3.0, 40.0], [0.0, 7.0], [1e-3, 0.0]] {
                    let start = double.start([0.1 + delta, 0.1], omega).unwrap();
                    let back = double.velocities(start);
                    let speed = l1 * omega[0].abs() + l2 * omega[1].abs();
                    for (length, back, omega) in [(l1, back[0], omega[0]), (l2, back[1], omega[1])]
                    {
                        let off = length * (back - omega).abs() / speed;
                        assert!(off <= tolerance, "{off:e} at {ratio:e}, Δ = {delta}: {back}");
                    }
                }
            }
        }
    }
    let equal = Joint { length: 1.0, mass: 1.0 };
    let at_limit = Joint { mass: LARGEST_MASS_RATIO, ..equal };
    assert!(DoublePendulum::new(9.81, equal, at_limit).is_ok());
    assert!(DoublePendulum::new(9.81, at_limit, equal).is_ok());
}

/// Lagrange's equations for θ₁ and θ₂, without momenta: (m₁ + m₂)L₁ θ̈₁ + m₂L₂ (θ̈₂ cos Δ + ω₂²
/// sin Δ) + (m₁ + m₂)g sin θ₁ = 0 and L₂ θ̈₂ + L₁ (θ̈₁ cos Δ − ω₁² sin Δ) + g sin θ₂ = 0. The state
/// is (θ₁, θ₂, ω₁, ω₂) under other names.
struct Lagrange(DoublePendulum);

impl System for Lagrange {
    type State = DoublePhase;

    fn rate(&self, _t: f64, z: DoublePhase) -> RateOf<Self> {
        let (upper, lower, g) = (self.0.upper(), self.0.lower(), self.0.gravity());
        let (both, m2, l1, l2) = (upper.mass + lower.mass, lower.mass, upper.length, lower.length);
        let (s, c) = (z.theta1 - z.theta2).sin_cos();
        // a θ̈₁ + b θ̈₂ = e, d θ̈₁ + f θ̈₂ = k
        let (a, b, d, f) = (both * l1, m2 * l2 * c, l1 * c, l2);
        let e = -m2 * l2 * z.p2 * z.p2 * s - both * g * z.theta1.sin();
        let k = l1 * z.p1 * z.p1 * s - g * z.theta2.sin();
        let det = a * f - b * d;
        DoublePhase {
            theta1: z.p1,
            theta2: z.p2,
            p1: (e * f - b * k) / det,
            p2: (a * k - e * d) / det,
        }
    }
}

/// Lagrange's and Hamilton's equations have the same solution.
///
/// Catches: a Hamiltonian and a rate that agree with each other but do not describe the pendulum.
#[test]
fn hamilton_and_lagrange_go_the_same_way() {
    for (theta, omega) in STATES {
        let double = unequal();
        let grid = Grid::new(0.0005, 2000).unwrap();
        let start = double.start(theta, omega).unwrap();
        let end = integrate(&double, &Rk4, start, &grid);
        let start = DoublePhase { theta1: theta[0], theta2: theta[1], p1: omega[0], p2: omega[1] };
        let other = integrate(&Lagrange(double), &Rk4, start, &grid);
        let [omega1, omega2] = double.velocities(end);
        // RK4: h⁴/120 = 5e-16 times fifth derivatives of up to (20/s)⁵ for 1 s, times the
        // divergence of neighbouring motions in that time: 1e-8.
        assert_abs_diff_eq!(end.theta1, other.theta1, epsilon = 1e-8);
        assert_abs_diff_eq!(end.theta2, other.theta2, epsilon = 1e-8);
        assert_abs_diff_eq!(omega1, other.p1, epsilon = 1e-7);
        assert_abs_diff_eq!(omega2, other.p2, epsilon = 1e-7);
    }
}

/// Small swings with equal joints have ω² = (2 ∓ √2) g/L and θ₂ = ±√2 θ₁; and a swing started in a
/// mode's shape has its frequency.
///
/// Catches: modes exchanged, g·L for g/L, a shape that excites both modes, masses or lengths
/// exchanged where they differ.
#[test]
fn small_swings_are_the_normal_modes() {
    let double = equals();
    let [slow, fast] = normal_modes(&double);
    // A few roundings.
    assert_abs_diff_eq!(slow * slow, (2.0 - SQRT_2) * 9.81, epsilon = 1e-14);
    assert_abs_diff_eq!(fast * fast, (2.0 + SQRT_2) * 9.81, epsilon = 3e-14);
    let [together, against] = mode_shapes(&double);
    assert_abs_diff_eq!(together, SQRT_2, epsilon = 1e-14);
    assert_abs_diff_eq!(against, -SQRT_2, epsilon = 1e-14);
    let long = Joint { length: 2.5, mass: 0.4 };
    let short = Joint { length: 0.3, mass: 4.0 };
    let [heavy, light] = [(long, short), (short, long)]
        .map(|(upper, lower)| DoublePendulum::new(3.0, upper, lower).unwrap());
    for double in [double, unequal(), heavy, light] {
        for (mode, shape) in normal_modes(&double).into_iter().zip(mode_shapes(&double)) {
            // Angles of 1e-6: the sine is off by 1e-12/6; the lower angle is up to ten times
            // larger. RK4 is off by (ωh)⁴/120 with ω up to 30/s, 7e-9; a crossing by (ωh)⁴/384 of a
            // step at each end.
            let frequency = swing_frequency(&double, 1e-6, shape).unwrap();
            assert_abs_diff_eq!(frequency / mode, 1.0, epsilon = 1e-8);
        }
    }
}

/// Normal modes are orthogonal in the mass matrix: (m₁ + m₂)L₁² + m₂L₁L₂(s₁ + s₂) + m₂L₂² s₁s₂ = 0,
/// whatever masses and rods. Each shape is a quotient of sums without cancellation, off by some
/// eight roundings, and the three terms by as many of their own size.
///
/// Catches: a shape that is infinite, or has lost its digits, beside a light lower bob.
#[test]
fn mode_shapes_are_orthogonal() {
    for exponent in -29..=6 {
        for (l1, l2) in [(1.0, 1.0), (1.0, 1.0 + 1e-9), (0.3, 2.0), (2.0, 0.3), (1e-6, 1e6)] {
            let (m1, m2) = (1.0, 10_f64.powi(exponent).min(0.999e6));
            let (upper, lower) = (Joint { length: l1, mass: m1 }, Joint { length: l2, mass: m2 });
            let double = DoublePendulum::new(9.81, upper, lower).unwrap();
            let [slow, fast] = mode_shapes(&double);
            assert!(slow > 0.0 && fast < 0.0, "{slow} and {fast}");
            let terms = [
                (m1 + m2) * l1 * l1,
                m2 * l1 * l2 * slow,
                m2 * l1 * l2 * fast,
                m2 * l2 * l2 * slow * fast,
            ];
            let size = terms.iter().fold(0.0, |size: f64, term| size.max(term.abs()));
            let sum = terms.iter().sum::<f64>();
            assert!(sum.abs() <= 64.0 * f64::EPSILON * size, "{m2} {l1} {l2}: {terms:?}");
        }
    }
}

/// Over ten times the time a symplectic method's energy error does not grow, and RK4's grows
/// tenfold. The release is low, so that the motion is a superposition of two swings, which within
/// 100 s has come close enough to all its states to fix the largest error to a hundredth.
///
/// Catches: an implicit method whose iteration stops too soon, or one that takes a momentum for a
/// velocity.
#[test]
fn only_a_symplectic_method_keeps_the_energy() {
    fn growth<M: Method<DoublePendulum>>(method: &M) -> f64 {
        let double = unequal();
        let start = double.start([0.2, 0.1], [0.0; 2]).unwrap();
        let [short, long] = [5_000, 50_000].map(|steps| {
            let mut drift = EnergyDrift::new(&double);
            let grid = Grid::new(0.02, steps).unwrap();
            integrate_with(&double, method, start, &grid, &mut drift);
            drift.largest()
        });
        long / short
    }
    for kept in [growth(&ImplicitMidpoint), growth(&Gauss4), growth(&Gauss6)] {
        assert!(kept < 1.01, "{kept}");
    }
    let lost = growth(&Rk4);
    assert!(lost > 9.0, "{lost}");
}

/// R² of a line through the logarithm of the distance against time between 1e-8 and 1e-3 rad, which
/// it has to reach: the share of the variance that the line explains.
fn straightness(path: &[(f64, f64)]) -> f64 {
    let until = path.iter().position(|&(_, d)| d > 1e-3).expect("they part");
    let from = path.iter().position(|&(_, d)| d > 1e-8).unwrap();
    let logs: Vec<(f64, f64)> = path[from..until].iter().map(|&(t, d)| (t, d.ln())).collect();
    let n = logs.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (t, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let cross = mean(&|p| (p.0 - t) * (p.1 - y));
    let (tt, yy) = (mean(&|p| (p.0 - t).powi(2)), mean(&|p| (p.1 - y).powi(2)));
    cross * cross / (tt * yy)
}

/// Two starts 1e-9 rad apart separate exponentially from a high release, and not from a low one.
///
/// Catches: a distance that grows because of the method's error and not the motion: it would grow
/// from the low release too, would not scale with the nudge, and would depend on the step.
#[test]
fn neighbours_part_exponentially_where_the_motion_is_chaotic() {
    let double = equals();
    let high = |nudge, run| separation(&double, [2.0, 2.5], nudge, run);
    let path = high(1e-9, (0.002, 10_000));
    let fit = straightness(&path);
    assert!(fit > 0.9, "a straight line on a logarithmic scale: {fit}");
    assert!(path.iter().any(|&(_, d)| d > 1.0), "nothing in common in the end");
    // The growth is the motion's, not the method's: after 5 s, in which the distance grows by a
    // factor of 1000, it is the same with half the step, and ten times as large with ten times the
    // nudge. RK4 is off by (5h)⁴ = 1e-8, amplified by chaos; the linearisation by the distance,
    // 1e-5.
    let at_5 = |path: &[(f64, f64)]| path.iter().find(|p| p.0 >= 5.0 - 1e-9).unwrap().1;
    let one = at_5(&path);
    assert!(one > 1e-7, "{one}");
    assert_abs_diff_eq!(at_5(&high(1e-9, (0.001, 10_000))) / one, 1.0, epsilon = 1e-2);
    assert_abs_diff_eq!(at_5(&high(1e-8, (0.002, 5_000))) / (10.0 * one), 1.0, epsilon = 1e-2);
    // Low: quasi-periodic, where neighbours separate no faster than t.
    let low = separation(&double, [0.2, 0.25], 1e-9, (0.002, 10_000));
    assert!(low.iter().all(|&(_, d)| d < 1e-8), "regular");
}

/// The lowest energy at rest with one rod upright, over all angles of the other, is the least with
/// which a rod can pass the upward vertical.
///
/// Catches: a mass or a length left out or confused with the other rod's; the higher of the two.
#[test]
fn the_least_energy_of_a_flip_is_the_lowest_pass() {
    let joint = |length, mass| Joint { length, mass };
    for (upper, lower) in [
        (joint(1.0, 1.0), joint(1.0, 1.0)),
        (joint(1.3, 0.7), joint(0.9, 2.1)),
        (joint(0.2, 1.5), joint(1.1, 4.0)),
    ] {
        let double = DoublePendulum::new(3.7, upper, lower).unwrap();
        let energy = |theta| double.energy(double.start(theta, [0.0; 2]).unwrap());
        let angles = (-300..=300).map(|i| PI * f64::from(i) / 300.0);
        let lowest = angles
            .map(|other| energy([other, PI]).min(energy([PI, other])))
            .fold(f64::INFINITY, f64::min);
        // Both are sums of a few products, rounded a few times each.
        assert_relative_eq!(double.least_flip_energy(), lowest, max_relative = 1e-15);
    }
}

/// Catches: NaN accepted, a mass that vanishes, an error that does not give the reason.
#[test]
fn impossible_pendulums_are_refused() {
    let joint = Joint { length: 1.0, mass: 1.0 };
    for (gravity, upper, lower, because) in [
        (0.0, joint, joint, "gravity g"),
        (9.81, Joint { length: -1.0, ..joint }, joint, "length L₁"),
        (9.81, joint, Joint { length: f64::NAN, ..joint }, "length L₂"),
        (9.81, Joint { mass: f64::INFINITY, ..joint }, joint, "mass m₁"),
        (9.81, joint, Joint { mass: 1e-200, ..joint }, "mass m₂ (kg) cannot be 1e-200"),
    ] {
        let refused = DoublePendulum::new(gravity, upper, lower).unwrap_err().to_string();
        assert!(refused.contains(because), "{refused}");
    }
    let double = equals();
    for (theta, omega, because) in [
        ([f64::NAN, 0.0], [0.0; 2], "angle θ"),
        ([0.0, 1e16], [0.0; 2], "at most 1e15"),
        ([0.0; 2], [f64::INFINITY, 0.0], "ω₁"),
        ([0.0; 2], [0.0, f64::NAN], "ω₂"),
        ([0.0; 2], [1e200, 0.0], "energy"),
    ] {
        let refused = double.start(theta, omega).unwrap_err().to_string();
        assert!(refused.contains(because), "{refused}");
    }
}

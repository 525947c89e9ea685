//! The exact solution against references of 25 digits and more, and against properties of every
//! solution.

use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;
use pendula::exact::{Swing, complete_elliptic_k, period};
use pendula::systems::Analytic;
use pendula::{Error, Hamiltonian, Motion, MotionKind, Pendulum, Phase};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rstest::rstest;

const PERIODS: &str = include_str!("../data/period.csv");
const TRAJECTORIES: &str = include_str!("../data/trajectory.csv");
const MOTIONS: &str = include_str!("../data/motion.csv");
const BESIDE_SEPARATRIX: &str = include_str!("../data/beside_separatrix.csv");

// -------------------------------------------------------------------------------------------------
// Tolerances
// -------------------------------------------------------------------------------------------------

/// The rounding of one evaluation, in units of the motion's size: about ten operations in a row,
/// each within ε/2, and arctangent, sine and cosine within ε each. Not more at 10⁵ s than at 0.
const EVALUATION: f64 = 2e-15;

/// T = 4 K/ω₀ in f64: K, ω₀ and the quotient are rounded by ε/2 each, and k' by ε, which changes K
/// by at most half as much, as dK/K = −(E/K − k'²)/k² · dk'/k' falls from ½ at k' = 1 to 1/K beside
/// the top. In all 2 ε.
const PERIOD_TOLERANCE: f64 = 5e-16;

/// A period from a double-double rounds once, ε/2, and so does the reference when it is read.
const NEAREST: f64 = f64::EPSILON;

/// No reference trajectory comes so near the top that half an ulp in the start is worse than this
/// after 50 s (rad): a tolerance computed from sensitivity must not become arbitrarily large.
const WELL_CONDITIONED: f64 = 3e-13;

/// Half a unit in the last place: how far an f64 may be from the number it stands for.
fn half_ulp(x: f64) -> f64 {
    0.5 * (x.abs().next_up() - x.abs())
}

/// How far an angle and an angular velocity may be off by rounding.
///
/// An angle is measured against the amplitude or one radian, a velocity against the largest one,
/// 2ω₀ k. An angle of many turns is rounded to its own last digit: once here, and once when the
/// reference is read. So is a subnormal k.
fn evaluation(pendulum: &Pendulum, motion: &Motion, theta: f64) -> Phase {
    let k = motion.modulus() + f64::from_bits(1);
    Phase {
        theta: EVALUATION * k.min(1.0) + 2.0 * half_ulp(theta),
        omega: 2.0 * pendulum.small_angle_frequency() * EVALUATION * k + f64::from_bits(1),
    }
}

#[track_caller]
fn assert_close(found: Phase, expected: Phase, tolerance: Phase, what: &dyn std::fmt::Display) {
    let (theta, omega) =
        ((found.theta - expected.theta).abs(), (found.omega - expected.omega).abs());
    assert!(
        theta <= tolerance.theta && omega <= tolerance.omega,
        "{what}: {found:?}, not {expected:?}: off by {theta:e} rad, {omega:e} rad/s; allowed \
         {tolerance:?}"
    );
}

// -------------------------------------------------------------------------------------------------
// References
// -------------------------------------------------------------------------------------------------

/// One row of a table of references.
#[derive(Clone, Copy)]
struct Row<'a> {
    header: &'a str,
    line: &'a str,
}

impl<'a> Row<'a> {
    /// The rows after the comments and the line of names.
    fn all(table: &'a str) -> impl Iterator<Item = Self> {
        let mut lines = table.lines().filter(|line| !line.starts_with('#'));
        let header = lines.next().expect("a line of names");
        lines.map(move |line| Self { header, line })
    }

    fn text(&self, name: &str) -> &'a str {
        let column = self.header.split(',').position(|field| field == name);
        self.line.split(',').nth(column.expect(name)).expect(name)
    }

    /// The nearest f64.
    fn number(&self, name: &str) -> f64 {
        self.text(name).parse().expect(name)
    }

    /// The phase in the columns of these names.
    fn phase(&self, theta: &str, omega: &str) -> Phase {
        Phase { theta: self.number(theta), omega: self.number(omega) }
    }
}

fn motion(pendulum: &Pendulum, start: Phase) -> Motion {
    Motion::new(pendulum, start).expect("a legal start")
}

/// A pendulum that swings at ω₀ = 2 rad/s exactly, with L ≠ 1.
fn two_radians_a_second() -> Pendulum {
    Pendulum::new(2.0, 0.5, 3.0).expect("a legal pendulum")
}

/// Catches: a form with 1 − k², which at π − 1e-8 is infinite; K of k in place of K of k²; T₀ in
/// place of T.
///
/// The reference takes θ₀ and g as the f64s that are given, so that even beside the top nothing is
/// lost: π − 1e-8 as an f64 is another angle, with a period 9e-9 s longer, which is not an error of
/// the period.
#[test]
fn periods_are_the_references() {
    let pendulum = Pendulum::PAPER;
    for row in Row::all(PERIODS) {
        let theta0 = row.number("theta0");
        let expected = row.number("T_f64_inputs");
        let swing = Swing::released_at(&pendulum, theta0).expect("a legal angle");
        assert_eq!(period(&pendulum, theta0), Ok(swing.period()));
        assert_relative_eq!(swing.period(), expected, max_relative = PERIOD_TOLERANCE);
        let exact = motion(&pendulum, Phase::at_rest(theta0)).period().expect("it swings");
        assert_relative_eq!(exact, expected, max_relative = NEAREST);
    }
}

/// Catches: k and k' exchanged, or a ratio upside down.
///
/// These columns take θ₀ and g as written, not as rounded: half an ulp of θ₀ is added to what K may
/// be off by.
#[test]
fn the_numbers_of_a_swing_are_the_references() {
    for row in Row::all(PERIODS) {
        let theta0 = row.number("theta0");
        let swing = Swing::released_at(&Pendulum::PAPER, theta0).expect("a legal angle");
        let rounding = 0.5 * half_ulp(theta0);
        let (k, complement) = (row.number("k"), row.number("kc"));
        let of_k = f64::EPSILON * k + rounding * complement;
        let of_complement = f64::EPSILON * complement + rounding * k;
        assert!((swing.modulus() - k).abs() <= of_k, "{}", row.line);
        assert!(
            (swing.complementary_modulus() - complement).abs() <= of_complement,
            "{}",
            row.line
        );
        let relative = PERIOD_TOLERANCE + of_complement / complement;
        assert_relative_eq!(swing.elliptic_k(), row.number("K"), max_relative = relative);
        assert_relative_eq!(swing.ratio(), row.number("T_over_T0"), max_relative = relative);
        assert_relative_eq!(swing.period(), row.number("T"), max_relative = relative);
    }
}

/// k, k' and K of a release from rest, computed with 60 digits of the f64 θ₀: of either sign, tiny,
/// beside the top, and beyond a turn. Relatively, so that no digit of a small one may be lost: half
/// the angle is exact, and sine and cosine are within 0.8 ulp.
///
/// Catches: a modulus with the sign of its angle, one that is right only as a part of 1, a k' from
/// 1 − k².
#[test]
fn the_numbers_of_a_swing_are_right_relatively() {
    for [theta0, k, complement, elliptic_k] in [
        [-1.0, 0.479425538604203, 0.8775825618903728, 1.6749939160926133],
        [-3.1, 0.999783764189357, 0.020794827803092428, 5.2598059169883875],
        [-0.001, 0.0004999999791666669, 0.9999998750000026, 1.5707964249696726],
        [1e-08, 5e-09, 1.0, FRAC_PI_2],
        [-1e-160, 5e-161, 1.0, FRAC_PI_2],
        [2.2250738585072014e-308, 1.1125369292536007e-308, 1.0, FRAC_PI_2],
        [3.141592643589793, 1.0, 5.000000030844985e-09, 20.500122279463206],
        [-PI, 1.0, 6.123233995736766e-17, 38.718150554388814],
        [3.5, 0.9839859468739369, 0.17824605564949209, 3.12793329569683],
        [-7.0, 0.35078322768961984, 0.9364566872907963, 1.622777768438897],
        [100.0, 0.26237485370392877, 0.9649660284921133, 1.5989296090544474],
        [-1000000.0, 0.1778312015182589, 0.9840610061203382, 1.5834408989083992],
    ] {
        let swing = Swing::released_at(&two_radians_a_second(), theta0).unwrap();
        // With the default `epsilon` any two tiny numbers would be equal.
        assert_relative_eq!(swing.modulus(), k, epsilon = 0.0, max_relative = f64::EPSILON);
        let found = swing.complementary_modulus();
        assert_relative_eq!(found, complement, epsilon = 0.0, max_relative = f64::EPSILON);
        assert_relative_eq!(swing.elliptic_k(), elliptic_k, max_relative = PERIOD_TOLERANCE);
        assert_relative_eq!(swing.period(), 2.0 * elliptic_k, max_relative = PERIOD_TOLERANCE);
        let ratio = elliptic_k / FRAC_PI_2;
        assert_relative_eq!(swing.ratio(), ratio, max_relative = PERIOD_TOLERANCE);
    }
}

/// Modulus and period of a motion at ω₀ = 2 rad/s, computed with 60 digits: either way, tiny, and
/// in rotation. Both come from double-doubles, which are rounded once.
///
/// Catches: a modulus that is not scaled back after a tiny swing was solved larger, or has the sign
/// of a velocity; that of rotation upside down; a period of the mirror image.
#[test]
fn the_numbers_of_a_motion_are_right_relatively() {
    for [theta, omega, k, period] in [
        [-1.0, 0.5, 0.4954531734341099, 3.36661317030618],
        [-1.0, -0.5, 0.4954531734341099, 3.36661317030618],
        [0.0, -0.001, 0.00025, 3.14159270267718],
        [1e-09, -2e-09, 7.071067811865476e-10, PI],
        [0.0, 1e-300, 2.5e-301, PI],
        [-1e-200, 3e-200, 9.013878188659973e-201, PI],
        [2.5, -3.9, 1.360586935029683, 1.388893567774905],
        [0.0, -4.0000001, 1.000000025, 9.791915659327922],
        [-3.0, 50.0, 12.539736689751512, 0.12546536741066877],
        [12.0, -100000.0, 25000.00000156146, 6.283185309300423e-05],
        [-100000.0, 1.0, 1.0306213677772775, 2.7483970934951047],
    ] {
        let motion = motion(&two_radians_a_second(), Phase { theta, omega });
        assert_relative_eq!(motion.modulus(), k, epsilon = 0.0, max_relative = NEAREST);
        assert_relative_eq!(motion.period().unwrap(), period, max_relative = NEAREST);
    }
}

/// Catches: a wrong reflection or a wrong quarter; a period rounded to f64 (off by 1e-12 at 10⁵ s);
/// a modulus near 1 computed from 1 − k²; lost turns; an amplitude that underflows; an overflow.
#[test]
fn motions_are_the_references() {
    for row in Row::all(MOTIONS) {
        let length = row.number("length");
        // A mass that keeps the energy in range; it does not enter the motion.
        let pendulum = Pendulum::new(row.number("gravity"), length, 1.0 / length).expect("legal");
        let motion = motion(&pendulum, row.phase("theta0", "omega0"));
        let expected = row.phase("theta", "omega");
        let tolerance = evaluation(&pendulum, &motion, expected.theta);
        assert_close(motion.at(row.number("t")), expected, tolerance, &row.line);
    }
}

/// Beside the separatrix k'² is the difference of two numbers that agree in up to 22 digits, and an
/// error in it makes every quarter period wrong. The last times are after about 10¹⁰ of them.
///
/// Catches: a k'² that is right to 32 digits of 1 instead of its own, with which the first start is
/// 1.2e-13 rad off at 10⁵ s, and the last times are wrong altogether; a cosine of the angle without
/// its turns.
#[test]
fn beside_the_separatrix_late_times_are_the_references() {
    for row in Row::all(BESIDE_SEPARATRIX) {
        let pendulum = Pendulum::new(row.number("gravity"), 1.0, 1.0).expect("legal");
        let motion = motion(&pendulum, row.phase("theta0", "omega0"));
        let expected = row.phase("theta", "omega");
        let tolerance = evaluation(&pendulum, &motion, expected.theta);
        assert_close(motion.at(row.number("t")), expected, tolerance, &row.line);
    }
}

/// From θ = 0 with ω = 2ω₀ a pendulum is on the separatrix, and no start of f64s is from another
/// angle, however small: there it goes over the top. The period 2K/(k ω₀) for k' = sin(θ/2)/k and
/// ω₀ = 2, from K = ln(4/k') to all digits.
///
/// Catches: a side decided by a difference of rounded numbers; a k'² that underflows.
#[rstest]
fn only_from_the_bottom_can_a_start_be_on_the_separatrix(
    #[values(1e-9, 1e-40, -1e-160, 1e-280)] theta: f64,
) {
    let motion = motion(&two_radians_a_second(), Phase { theta, omega: 4.0 });
    assert_eq!(motion.kind(), MotionKind::Rotation);
    let period = motion.period().expect("it goes over the top");
    assert_relative_eq!(period, 8.0_f64.ln() - theta.abs().ln(), max_relative = f64::EPSILON);
    // The period is rounded by half an ulp, and the bottom passed at 4 rad/s.
    let turned = motion.at(period);
    assert!((turned.theta - 2.0 * PI - theta).abs() <= 4.0 * half_ulp(period) + EVALUATION);
    assert!((turned.omega - 4.0).abs() <= 4.0 * EVALUATION);
}

/// Catches: a gravity, start or time that enters wrongly, with references made by someone else.
///
/// They take 9.81, 0.05 and 6.3 as written. The f64s are up to half an ulp off, and what that does
/// to the answer is computed: each input is moved by one ulp either way, and the change scaled to
/// half an ulp.
#[test]
fn trajectories_are_the_references() {
    for row in Row::all(TRAJECTORIES) {
        let on_separatrix = row.text("scene") == "separatrix";
        let exact = |gravity: f64, start: Phase| {
            let pendulum = Pendulum::new(gravity, 1.0, 1.0).expect("legal");
            let motion = match on_separatrix {
                // The velocity at the start follows from g: the f64 in the table is not exactly on
                // the separatrix.
                true => Motion::on_separatrix(&pendulum, start.theta).expect("legal"),
                false => motion(&pendulum, start),
            };
            (motion.at(row.number("t")), evaluation(&pendulum, &motion, row.number("theta")))
        };
        let (gravity, start) = (9.81_f64, row.phase("theta0", "omega0"));
        let (found, mut tolerance) = exact(gravity, start);
        let moved = |by: fn(f64) -> f64| {
            let Phase { theta, omega } = start;
            [
                (by(gravity), start),
                (gravity, Phase { theta: by(theta), omega }),
                (gravity, Phase { theta, omega: by(omega) }),
            ]
        };
        for (either, or) in moved(f64::next_down).into_iter().zip(moved(f64::next_up)) {
            let ((one, _), (other, _)) = (exact(either.0, either.1), exact(or.0, or.1));
            // From one ulp below to one ulp above is four times half an ulp.
            tolerance.theta += (one.theta - other.theta).abs() / 4.0;
            tolerance.omega += (one.omega - other.omega).abs() / 4.0;
        }
        let expected = row.phase("theta", "omega");
        let (theta, omega) = (found.theta - expected.theta, found.omega - expected.omega);
        println!("{} after {} s:", row.text("scene"), row.text("t"));
        println!("    {theta:9.1e} rad   of {:.1e} allowed", tolerance.theta);
        println!("    {omega:9.1e} rad/s of {:.1e} allowed", tolerance.omega);
        assert!(tolerance.theta <= WELL_CONDITIONED, "{}", row.line);
        assert_close(found, expected, tolerance, &row.line);
    }
}

// -------------------------------------------------------------------------------------------------
// Special starts
// -------------------------------------------------------------------------------------------------

/// Catches: a kind decided by 1 − k², which loses the last digits; a full oscillation reported for
/// one turn.
#[rstest]
#[case::rest(0.0, 0.0, MotionKind::Rest)]
#[case::swing(1.0, 0.0, MotionKind::Libration)]
#[case::top(std::f64::consts::PI, 0.0, MotionKind::Libration)]
#[case::just_inside(0.0, 4.0_f64.next_down(), MotionKind::Libration)]
#[case::separatrix(0.0, 4.0, MotionKind::Separatrix)]
#[case::separatrix_backward(0.0, -4.0, MotionKind::Separatrix)]
#[case::just_outside(0.0, 4.0_f64.next_up(), MotionKind::Rotation)]
#[case::top_kicked(std::f64::consts::PI, 1e-15, MotionKind::Rotation)]
#[case::tiniest(5e-324, 0.0, MotionKind::Libration)]
fn kinds_are_told_apart(#[case] theta: f64, #[case] omega: f64, #[case] kind: MotionKind) {
    let motion = motion(&two_radians_a_second(), Phase { theta, omega });
    assert_eq!(motion.kind(), kind);
    assert_eq!(
        motion.period().is_some(),
        matches!(kind, MotionKind::Libration | MotionKind::Rotation)
    );
}

/// Catches: a quarter period from an incomplete integral, whose rounding makes the pendulum move
/// before t = 0.
#[rstest]
fn a_release_from_rest_is_at_rest(
    #[values(1e-300, 1e-9, 0.5, -2.0, 3.13, 4.0, -700.0)] theta0: f64,
) {
    let start = motion(&Pendulum::PAPER, Phase::at_rest(theta0)).at(0.0);
    assert_eq!(start.omega, 0.0);
    assert!((start.theta - theta0).abs() <= 2.0 * half_ulp(theta0), "{start:?}");
}

/// Catches: an overflow of cosh, an ω that becomes 0 instead of decaying exponentially, and one
/// that changes its sign.
#[rstest]
fn on_the_separatrix_the_top_is_approached_forever(#[values(-3.0, 0.0, 2.0, 20.0)] theta0: f64) {
    let pendulum = two_radians_a_second();
    let motion = Motion::on_separatrix(&pendulum, theta0).expect("a legal angle");
    let turns = (theta0 / std::f64::consts::TAU).round();
    let mut last = motion.at(-1.0);
    for n in -3..1500 {
        let z = motion.at(0.25 * f64::from(n));
        assert!(z.theta >= last.theta, "{n}: {z:?} after {last:?}");
        last = z;
        // ω = 2ω₀ cos(θ/2) loses its digits at the top as the angle does: there ω is compared with
        // the exponential.
        let u = 2.0 * 0.25 * f64::from(n)
            + (0.5 * (theta0 - std::f64::consts::TAU * turns)).tan().asinh();
        if (18.0..745.0).contains(&u) {
            // 4ω₀ e⁻ᵘ: the rounding of u is the relative error of e⁻ᵘ; past 708 that is subnormal,
            // and its last place counts 8 times too.
            let relative = 4.0 * f64::EPSILON * (1.0 + u);
            let expected = 8.0 * (-u).exp();
            assert_relative_eq!(
                z.omega,
                expected,
                max_relative = relative,
                epsilon = f64::from_bits(16)
            );
        } else {
            let expected = 4.0 * (0.5 * z.theta).cos().abs();
            assert!(
                (z.omega - expected).abs() <= 2.0 * EVALUATION * 4.0 + half_ulp(theta0) * 4.0,
                "{n}: {z:?} {expected}"
            );
        }
    }
    assert_eq!(motion.at(1e300).omega, 0.0);
    assert_eq!(motion.at(f64::MAX).theta, std::f64::consts::PI * (2.0 * turns + 1.0));
}

/// At times of the motion through the bottom with a modulus of `k`: the radius (s) of the
/// pendulum's majorant, where it has one, and the distance (s) to the nearest singularity of θ.
///
/// Its poles are those of Jacobi's cn on a swing and dn in a rotation: K' above and below each pass
/// through the bottom, in units of 1/ω₀ and of 1/(k ω₀), where K' is K of the complementary
/// modulus. Between two passes the first half is the second one backwards.
fn radii(k: f64) -> Vec<(f64, f64)> {
    let pendulum = two_radians_a_second();
    let frequency = pendulum.small_angle_frequency();
    let motion = motion(&pendulum, Phase { theta: 0.0, omega: 2.0 * frequency * k });
    let rate = frequency * k.max(1.0);
    let above = complete_elliptic_k(k.min(1.0 / k)) / rate;
    let half =
        motion.period().map_or(20.0 / rate, |period| if k < 1.0 { 0.25 } else { 0.5 } * period);
    let times = (0..=400).map(|i| half * f64::from(i) / 400.0);
    let radii = times.filter_map(|t| {
        let majorant = pendulum.majorant(motion.at(t))?;
        Some((majorant.radius, t.hypot(above)))
    });
    radii.collect()
}

/// The radius of convergence of a motion is the distance to its nearest singularity. On a swing of
/// 1, 2 and 3 rad steps in proportion to the majorant's radius are 1.4, 5 and 12 % more than in
/// proportion to that distance: computed with another program, from the coefficients.
///
/// Catches: a radius that is a bound on some motions, as on swings and not in rotations, or of some
/// amplitudes; poles of the wrong modulus, or of a rotation in the time of a swing; coefficients
/// that make the steps shorter than need be.
#[test]
fn no_singularity_is_nearer_than_the_majorant_says() {
    let swings = (1..1000).map(|i| f64::from(i) / 1000.0);
    let mut closest = 0.0_f64;
    for k in swings.flat_map(|k| [k, 1.0 / k]).chain([1.0 - 1e-9, 1.0 + 1e-9]) {
        for (radius, distance) in radii(k) {
            assert!(radius < distance, "k = {k}: {radius} s of {distance} s");
            closest = closest.max(radius / distance);
        }
    }
    assert!(closest > 0.999, "{closest}");
    for (theta_0, more) in [(1.0_f64, 1.014), (2.0, 1.053), (3.0, 1.120)] {
        let (mut steps, mut fewest) = (0.0, 0.0);
        for (radius, distance) in radii((0.5 * theta_0).sin()) {
            steps += 1.0 / radius;
            fewest += 1.0 / distance;
        }
        assert!((steps / fewest - more).abs() < 2e-3, "{theta_0}: {}", steps / fewest);
    }
}

/// Catches: an accepted NaN, a panic, or an answer where there is no right one.
#[rstest]
#[case(f64::NAN, 0.0)]
#[case(f64::INFINITY, 0.0)]
#[case(0.0, f64::NEG_INFINITY)]
#[case::turns_beyond_counting(1.1e15, 0.0)]
#[case::square_overflows(0.0, 1e151)]
#[case::swing_underflows(0.0, 5e-324)]
fn what_cannot_be_right_is_refused(#[case] theta: f64, #[case] omega: f64) {
    let pendulum = two_radians_a_second();
    let refusal = Motion::new(&pendulum, Phase { theta, omega });
    assert!(matches!(refusal, Err(Error::Parameter { .. })), "{refusal:?}");
}

/// Catches: an overflow or underflow at the extremes of the legal range, and a wrong horizon.
#[rstest]
fn legal_extremes_have_finite_answers(
    #[values(1e-300, 1e-9, 1.0, 1e300)] frequency_squared: f64,
    #[values(0.0, 5e-324, 1e-300, 1e-30, 3.0, 1e15)] theta: f64,
    #[values(0.0, 1e-320, 1e-160, 1.0, 1e150)] omega: f64,
) {
    let pendulum = Pendulum::new(frequency_squared, 1.0, 1.0).expect("a legal pendulum");
    let frequency = pendulum.small_angle_frequency();
    let start = Phase { theta, omega };
    let Ok(motion) = Motion::new(&pendulum, start) else {
        let ratio = omega / frequency;
        assert!(
            ratio > 3e150 || (theta == 0.0 && omega > 0.0 && ratio == 0.0),
            "{start:?} refused"
        );
        return;
    };
    let tolerance = evaluation(&pendulum, &motion, theta);
    assert_close(motion.at(0.0), start, tolerance, &format_args!("{start:?} at 0"));
    let horizon = motion.horizon();
    for t in [5e-324, -1e-300, 1e-9 / frequency, 1.0 / frequency, horizon, -horizon] {
        let z = motion.at(t);
        assert!(
            t.abs() > horizon || (z.theta.is_finite() && z.omega.is_finite()),
            "{start:?} at {t}: {z:?}"
        );
    }
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.01 * horizon] {
        let z = motion.at(t);
        assert!(
            horizon == f64::MAX && t.is_finite() || z.theta.is_nan() && z.omega.is_nan(),
            "{start:?} at {t}: {z:?}"
        );
    }
}

// -------------------------------------------------------------------------------------------------
// What every solution must satisfy
// -------------------------------------------------------------------------------------------------

/// The same starts on every machine and in every run.
fn always_the_same() -> ProptestConfig {
    ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(1673), // Huygens, Horologium Oscillatorium
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn any_pendulum() -> impl Strategy<Value = Pendulum> {
    (0.5..30.0, 0.2..5.0, 0.1..10.0).prop_map(|(g, l, m)| Pendulum::new(g, l, m).expect("legal"))
}

/// Starts of every kind, within two turns: librations and rotations about equally often.
fn any_start() -> impl Strategy<Value = Phase> {
    (-12.0..12.0, -15.0..15.0).prop_map(|(theta, omega)| Phase { theta, omega })
}

proptest! {
    #![proptest_config(always_the_same())]

    /// Catches: a phase at the start in the wrong quarter, a turn lost.
    #[test]
    fn it_begins_at_the_start(pendulum in any_pendulum(), start in any_start()) {
        let motion = motion(&pendulum, start);
        assert_close(motion.at(0.0), start, evaluation(&pendulum, &motion, start.theta), &"at 0");
    }

    /// Catches: a period with the wrong number of quarters, a rotation that comes back without one
    /// more turn, a horizon that is not 2⁵² quarters of an oscillation or half turns.
    #[test]
    fn the_period_closes_the_orbit(
        pendulum in any_pendulum(),
        start in any_start(),
        t in -5.0..5.0_f64,
    ) {
        let motion = motion(&pendulum, start);
        let period = motion.period().expect("random starts are not on the separatrix");
        let (turns, quarters) = match motion.kind() {
            MotionKind::Rotation => (start.omega.signum(), 2.0),
            _ => (0.0, 4.0),
        };
        let horizon = 2.0_f64.powi(52) * period / quarters;
        assert_relative_eq!(motion.horizon(), horizon, max_relative = 2.0 * f64::EPSILON);
        let (now, later) = (motion.at(t), motion.at(t + period));
        let expected = Phase { theta: now.theta + turns * std::f64::consts::TAU, ..now };
        // The period and the sum t + T are rounded; meanwhile the pendulum moves on.
        let rounding = half_ulp(period) + half_ulp(t + period);
        let evaluation = evaluation(&pendulum, &motion, now.theta.abs().max(later.theta.abs()));
        let speed = 2.0 * motion.modulus() * pendulum.small_angle_frequency();
        let tolerance = Phase {
            theta: 2.0 * evaluation.theta + half_ulp(expected.theta) + rounding * speed,
            omega: 2.0 * evaluation.omega + rounding * pendulum.frequency_squared(),
        };
        assert_close(later, expected, tolerance, &period);
    }

    /// Catches: an amplitude or a speed that is off, anywhere along the motion.
    #[test]
    fn energy_is_constant(pendulum in any_pendulum(), start in any_start(), t in -20.0..20.0_f64) {
        let motion = motion(&pendulum, start);
        let z = motion.at(t);
        let off = evaluation(&pendulum, &motion, z.theta.abs().max(start.theta.abs()));
        // dH = m g L sin θ dθ + m L² ω dω, and |sin θ| ≤ 2k; as much again for the two energies'
        // own rounding.
        let k = motion.modulus();
        let inertia = pendulum.mass() * pendulum.length() * pendulum.length();
        let largest = 2.0 * k * pendulum.small_angle_frequency();
        let potential = pendulum.depth() * (2.0 * k).min(1.0) * off.theta;
        let tolerance = 2.0 * (potential + inertia * largest * off.omega);
        let difference = pendulum.energy(z) - pendulum.energy(start);
        prop_assert!(difference.abs() <= tolerance, "{difference:e} J, allowed {tolerance:e} J");
    }

    /// Catches: sn, cn, dn that solve equations other than θ' = ω and ω' = −(g/L) sin θ.
    #[test]
    fn it_solves_the_equation(
        pendulum in any_pendulum(),
        start in any_start(),
        t in -5.0..5.0_f64,
    ) {
        let motion = motion(&pendulum, start);
        // In units of τ, the time of a radian at most, each derivative is of order 1 and the fifth
        // below 60: the five-point difference truncates h⁴/30 of it. Values off by e make it off by
        // 3e/(2h).
        let tau = 1.0 / (2.0 * pendulum.small_angle_frequency() * motion.modulus().max(0.5));
        let h = 1e-3 * tau;
        let difference = |part: fn(Phase) -> f64| {
            let at = |steps: f64| part(motion.at(t + steps * h));
            (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
        };
        let z = motion.at(t);
        let off = evaluation(&pendulum, &motion, z.theta.abs() + 1.0);
        // The times are rounded too, by half an ulp of t, at a speed of at most 1/τ and an
        // acceleration of at most g/L.
        let times = half_ulp(t.abs() + 3.0 * h);
        let truncation = 60.0 * 1e-12 / 30.0;
        let theta_tolerance = truncation / tau + 1.5 * (off.theta + times / tau) / h;
        let rounding = off.omega + times * pendulum.frequency_squared();
        let omega_tolerance = truncation / (tau * tau) + 1.5 * rounding / h;
        let theta_rate = difference(|z| z.theta) - z.omega;
        let omega_rate = difference(|z| z.omega) + pendulum.frequency_squared() * z.theta.sin();
        let (theta, omega) = (theta_rate.abs(), omega_rate.abs());
        prop_assert!(theta <= theta_tolerance, "{theta:e}, allowed {theta_tolerance:e}");
        prop_assert!(omega <= omega_tolerance, "{omega:e}, allowed {omega_tolerance:e}");
    }

    /// Catches: a preferred direction: the mirror image has the same bits.
    #[test]
    fn left_and_right_mirror_each_other(
        pendulum in any_pendulum(),
        start in any_start(),
        t in -1e3..1e3_f64,
    ) {
        for start in [start, Phase::at_rest(start.theta)] {
            let mirrored = motion(&pendulum, start * -1.0).at(t) * -1.0;
            prop_assert_eq!(motion(&pendulum, start).at(t), mirrored);
        }
    }
}

/// Near the horizon the phase in quarter periods is an f64 whose last place is a half or a whole,
/// and the motion depends on the remainder alone. From mpmath, 80 digits: the release from 1 rad.
/// The rate of the phase is known to a relative 2⁻¹⁰⁴, so the phase to 2⁻⁵² × π/2 × √9.81 × 2 at
/// the most.
///
/// Catches: a remainder of a full quarter period that is not carried to the count of quarters.
#[rstest]
#[case(1879331179301274.0, -0.8158890537714706, 1.6862109693977085)]
#[case(2008179616693827.8, -0.8022912096853608, 1.7425185374503611)]
#[case(2066061913573249.2, -0.8509092403710324, -1.5279824661491765)]
#[case(2225659432656420.8, -0.9999937484022129, -0.010159308602593555)]
#[case(2006132944214766.2, -0.16336895464727558, -2.9593964591007262)]
#[case(2203847552472841.2, -0.971313006441824, 0.6849715112422733)]
#[case(1235663414503259.0, 0.9453359576316266, 0.9413825021456528)]
#[case(1708871420491457.8, 0.9595809859811066, 0.81145826545723)]
#[case(1793557971926229.2, -0.8511015032563142, 1.5270540059334516)]
#[case(2068179045651396.5, 0.9124121082333505, -1.1847200765610846)]
#[case(1354624188886351.2, -0.8838020817812487, -1.357420090790461)]
#[case(1206151016542377.0, -0.926414974858239, 1.0886140238045867)]
fn the_phase_is_kept_up_to_the_horizon(#[case] t: f64, #[case] theta: f64, #[case] omega: f64) {
    let motion = motion(&Pendulum::PAPER, Phase::at_rest(1.0));
    assert!(t < motion.horizon());
    let tolerance = Phase { theta: 1e-14, omega: 1e-14 * 9.81 };
    assert_close(motion.at(t), Phase { theta, omega }, tolerance, &t);
}

/// Catches: an f64::sin or a fused multiply-add in the code: the bits are fixed, for every machine.
#[test]
fn the_bits_are_the_same_everywhere() {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64; // FNV-1a
    for (theta, omega) in [(1.0, 0.0), (3.1, 0.2), (-20.0, 0.5), (0.0, 6.3), (1.0, -50.0)] {
        let motion = motion(&Pendulum::PAPER, Phase { theta, omega });
        for n in -100..1000 {
            let z = motion.at(0.37 * f64::from(n));
            for bits in [z.theta.to_bits(), z.omega.to_bits()] {
                hash = (hash ^ bits).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    assert_eq!(hash, 0x9637_3bad_d882_ba17, "{hash:#x}");
}

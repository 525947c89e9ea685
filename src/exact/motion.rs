//! θ(t) and ω(t) in closed form: libration, rotation, and the separatrix between them.
//!
//! With ω₀ = √(g/L), S = sin(θ/2), C = cos(θ/2) and w = ω/(2ω₀), the energy above the bottom is 2 m
//! g L k²,
//!
//! k² = S² + w²,  k'² = 1 − k² = C² − w²,
//!
//! and its distance to the top, k'², distinguishes the kinds of motion:
//!
//! | kind | | sin(θ/2) | cos(θ/2) | ω |
//! |---|---|---|---|---|
//! | libration | k'² > 0 | k sn u | dn u | 2ω₀ k cn u |
//! | separatrix | k'² = 0 | tanh u | sech u | 2ω₀ sech u |
//! | rotation, of modulus 1/k | k'² < 0 | sn ku | cn ku | 2ω₀ k dn ku |
//!
//! where u = u₀ + ω₀ t. Sources: DLMF 22.19(i); Lawden, *Elliptic Functions and Applications*
//! (1989), Sect. 5.1.
//!
//! The motions to the right and to the left are mirror images: everything here moves in the
//! direction of growing θ, and [`Motion`] stores the sign of its `direction`.

use super::elliptic::{Jacobi, Values, carlson_rf};
use super::unwrapped;
use crate::arithmetic::double_double::{DoubleDouble, reduced_sine_cosine};
use crate::arithmetic::fixed::Fixed;
use crate::error::{Error, checked, finite};
use crate::systems::{Pendulum, Phase, angle};

/// What the pendulum does for all time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// It hangs at rest.
    Rest,
    /// It swings to and fro.
    Libration,
    /// It has exactly the energy of the top, and approaches the top forever.
    Separatrix,
    /// It goes over the top, again and again.
    Rotation,
}

/// The exact motion from one start: prepared once, then evaluated at any time.
///
/// Maps t (s) to θ (rad, unwrapped: it counts turns) and ω (rad/s). Both are right to 2e-15, of a
/// radian or the amplitude and of the largest velocity 2ω₀ k, however near the separatrix, and
/// after 10⁵ s as at the start: the period is known to a relative 1.5e-30, which adds at most 3e-30
/// ω₀|t|, or in rotation k times that. After many turns θ is right to its own last digit. The
/// solution is in Jacobian elliptic functions: DLMF 22.19(i).
///
/// The pendulum balanced at the top cannot occur, as no f64 is π: a start at rest at π as an f64 is
/// a libration from 1.2e-16 rad beside the top, and takes the paper's pendulum 12 s to fall. On the
/// separatrix is only a start from θ = 0 with exactly ω = 2ω₀, and what counts as it: the same ω
/// with |θ| < 2e-290. Which side any other start is on is decided with 330 binary digits.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    course: Course,
    /// 1 for a motion that begins towards growing θ, −1 otherwise.
    direction: f64,
    /// The power of two by which the solution of a tiny swing is multiplied; otherwise 1.
    shrink: f64,
    /// Whole turns at the start, in that direction.
    turns: f64,
    /// The modulus k, before the multiplication by `shrink`.
    modulus: f64,
    /// The largest |t| (s).
    horizon: f64,
}

/// The motion in the direction of growing θ.
#[derive(Clone, Copy, Debug)]
enum Course {
    Rest,
    Libration(Elliptic),
    Separatrix(Hyperbolic),
    Rotation(Elliptic),
}

/// Libration or rotation, as [`Course`] tells.
#[derive(Clone, Copy, Debug)]
struct Elliptic {
    jacobi: Jacobi,
    /// The phase u/K: at the start, and its growth (1/s).
    quarters: DoubleDouble,
    rate: DoubleDouble,
    /// The modulus k of the libration.
    modulus: f64,
    /// The largest angular velocity, 2ω₀ k (rad/s).
    speed: f64,
}

#[derive(Clone, Copy, Debug)]
struct Hyperbolic {
    /// u at the start.
    start: f64,
    /// ω₀ (rad/s).
    frequency: f64,
}

// -------------------------------------------------------------------------------------------------
// Limits
// -------------------------------------------------------------------------------------------------

/// 2⁵⁰⁰: beyond this ω/ω₀ the squares leave the range of f64.
const FASTEST: f64 = 3.273_390_607_896_142e150;

/// Beyond this ω (rad/s) a product of double-doubles, which splits its factors, leaves the range of
/// f64.
const LARGEST_VELOCITY: f64 = 1e295;

/// 2⁻¹⁰⁰: in a swing this small, θ and sin θ have the same digits even in double-double.
const LINEAR: f64 = 1.0 / (1_u128 << 100) as f64;

/// Below this sin(θ/2) the second half of a double-double is lost to underflow.
const SMALLEST_SINE: f64 = 1e-290;

/// 2⁵²: beyond this many quarter periods their count, with that of the turns at the start, would be
/// rounded.
const LARGEST_PHASE: f64 = (1_u64 << 52) as f64;

const VELOCITY: &str = "angular velocity ω (rad/s)";

impl Motion {
    /// The motion of `pendulum` that begins at `start`: θ in rad, ω in rad/s.
    ///
    /// Takes microseconds: everything that the phase at late times depends on is computed in
    /// double-double.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a start that is not finite, for |θ| > 1e15, for |ω| > 3e150 ω₀ or >
    /// 1e295 rad/s, and for a start at θ = 0 with an ω ≠ 0 so small that the amplitude underflows.
    pub fn new(pendulum: &Pendulum, start: Phase) -> Result<Self, Error> {
        let theta = angle(start.theta)?;
        let omega = finite(VELOCITY, start.omega)?;
        let fits = libm::fabs(omega) <= LARGEST_VELOCITY;
        checked(VELOCITY, omega, fits, "at most 1e295 in size")?;
        let time = TimeUnit::new(pendulum);
        let fits = libm::fabs(omega * time.unit) <= FASTEST;
        checked(VELOCITY, omega, fits, "at most 3e150 √(g/L) in size")?;
        let direction = if omega < 0.0 { -1.0 } else { 1.0 };
        let (theta, omega) = (direction * theta, direction * omega);

        // A swing so small that it is linear is scaled up, solved, and the solution scaled down,
        // lest its square underflow.
        let size = f64::max(libm::fabs(theta), omega * time.unit);
        if size == 0.0 {
            let allowed = "zero, or at least 5e-324 √(g/L) in size";
            checked(VELOCITY, start.omega, omega == 0.0, allowed)?;
            return Ok(Self::along(Course::Rest));
        }
        let grow = if size < LINEAR { libm::ldexp(LINEAR, -libm::ilogb(size)) } else { 1.0 };
        let (theta, omega) = (theta * grow, omega * grow * time.unit);

        let half = HalfAngle::new(theta);
        let (course, k) = Course::through(theta, &half, omega, &time);
        Ok(Self {
            direction,
            shrink: 1.0 / grow,
            turns: half.turns,
            modulus: k.rounded(),
            ..Self::along(course)
        })
    }

    /// The motion of `pendulum` on the separatrix, through `theta` (rad) at t = 0, towards growing
    /// θ.
    ///
    /// Its angular velocity there is 2ω₀ |cos(θ/2)|, rarely an f64, so that [`Motion::new`] rarely
    /// hits the separatrix. The motion in the other direction is this one from −θ, with the signs
    /// of θ and ω changed.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an angle that is not finite, or beyond 1e15.
    pub fn on_separatrix(pendulum: &Pendulum, theta: f64) -> Result<Self, Error> {
        let HalfAngle { sine, cosine, turns } = HalfAngle::new(angle(theta)?);
        let time = TimeUnit::new(pendulum);
        let course = Course::Separatrix(Hyperbolic::through(sine, cosine, &time));
        Ok(Self { turns, modulus: 1.0, ..Self::along(course) })
    }

    /// The motion along `course`, for the rest of the fields to be filled in.
    fn along(course: Course) -> Self {
        let horizon = match &course {
            Course::Rest | Course::Separatrix(_) => f64::MAX,
            Course::Libration(elliptic) | Course::Rotation(elliptic) => {
                LARGEST_PHASE / elliptic.rate.rounded()
            }
        };
        Self { course, direction: 1.0, shrink: 1.0, turns: 0.0, modulus: 0.0, horizon }
    }

    /// What the pendulum does for all time.
    pub const fn kind(&self) -> MotionKind {
        match self.course {
            Course::Rest => MotionKind::Rest,
            Course::Libration(_) => MotionKind::Libration,
            Course::Separatrix(_) => MotionKind::Separatrix,
            Course::Rotation(_) => MotionKind::Rotation,
        }
    }

    /// The modulus k = √(sin²(θ/2) + ω²/(2ω₀)²), 0 at rest, 1 on the separatrix and above 1 in
    /// rotation; its square is the ratio of the energy above the bottom to that at the top.
    pub fn modulus(&self) -> f64 {
        self.modulus * self.shrink
    }

    /// The time (s) of a full oscillation, 4K/ω₀, or of one turn, 2K/(k ω₀); `None` at rest or on
    /// the separatrix.
    pub fn period(&self) -> Option<f64> {
        let (quarters, elliptic) = match &self.course {
            Course::Libration(elliptic) => (4.0, elliptic),
            Course::Rotation(elliptic) => (2.0, elliptic),
            Course::Rest | Course::Separatrix(_) => return None,
        };
        Some((DoubleDouble::new(quarters) / elliptic.rate).rounded())
    }

    /// The largest |t| (s) for which [`Motion::at`] returns a state: 2⁵² quarter periods, about
    /// 10¹⁵ periods.
    ///
    /// At rest and on the separatrix it is the largest f64.
    pub const fn horizon(&self) -> f64 {
        self.horizon
    }

    /// The state at time `t` (s), before the start if `t` is negative: θ in rad, unwrapped, and ω
    /// in rad/s.
    ///
    /// For a time beyond the [horizon](Motion::horizon), or not finite, both components are NaN.
    pub fn at(&self, t: f64) -> Phase {
        // NaN fails this test too.
        if !(-self.horizon..=self.horizon).contains(&t) {
            return Phase { theta: f64::NAN, omega: f64::NAN };
        }
        let (half_turns, Phase { theta, omega }) = match &self.course {
            Course::Rest => (0.0, Phase::at_rest(0.0)),
            Course::Libration(elliptic) => (0.0, elliptic.libration(t)),
            Course::Separatrix(hyperbolic) => (0.0, hyperbolic.at(t)),
            Course::Rotation(elliptic) => elliptic.rotation(t),
        };
        Phase {
            theta: self.direction * unwrapped(half_turns + 2.0 * self.turns, theta * self.shrink),
            omega: self.direction * omega * self.shrink,
        }
    }
}

// -------------------------------------------------------------------------------------------------
// The three solutions
// -------------------------------------------------------------------------------------------------

impl Course {
    /// The course through the angle `theta`, of which `half` is the half, with the angular velocity
    /// `omega`, not negative and in the unit of `time`; and its modulus k.
    fn through(theta: f64, half: &HalfAngle, omega: f64, time: &TimeUnit) -> (Self, DoubleDouble) {
        let HalfAngle { sine, cosine, .. } = *half;
        let w = DoubleDouble::new(0.5 * omega) / time.frequency;
        let k = (sine.squared() + w.squared()).sqrt();
        let (side, complement) = to_the_top(theta, half, omega, time);

        let course = if side > 0.0 {
            let (s, c) = (sine / k, w / k);
            let jacobi = Jacobi::new(complement);
            // At rest it is a quarter period from the bottom, without rounding. Otherwise u₀ = F(φ,
            // k) with s = sin φ and c = cos φ (DLMF 19.25.5).
            let quarters = if omega == 0.0 {
                DoubleDouble::new(libm::copysign(1.0, sine.rounded()))
            } else {
                s * carlson_rf(c.squared(), cosine.squared(), DoubleDouble::ONE)
                    / jacobi.quarter_period
            };
            Self::Libration(Elliptic::new(jacobi, quarters, time.frequency, k, time))
        } else if side < 0.0 {
            let c = w / k;
            let jacobi = Jacobi::new(complement / k);
            // The same with the roles of S and s, of C and c exchanged: k u₀ = F(θ/2, 1/k).
            let quarters = sine * carlson_rf(cosine.squared(), c.squared(), DoubleDouble::ONE)
                / jacobi.quarter_period;
            Self::Rotation(Elliptic::new(jacobi, quarters, k * time.frequency, k, time))
        } else {
            Self::Separatrix(Hyperbolic::through(sine, cosine, time))
        };
        (course, k)
    }
}

/// k'² = C² − w² as its sign and its root, k', with the relative precision of a double-double: K
/// goes with ln k', so that an error of k' makes every quarter period wrong.
///
/// The sign is zero on the separatrix, which a start of f64s is on only at θ = 0: the cosine of any
/// other f64 is transcendental.
fn to_the_top(theta: f64, half: &HalfAngle, omega: f64, time: &TimeUnit) -> (f64, DoubleDouble) {
    /// The part of C² that a difference of double-doubles may leave: it has lost two binary digits.
    const LEFT: f64 = 0.25;
    let signed = |gap: DoubleDouble| {
        if gap.rounded() < 0.0 { (-1.0, (-gap).sqrt()) } else { (gap.rounded(), gap.sqrt()) }
    };
    // C² − w² = (4 C² g/L − ω²) / (4 g/L).
    let (stiffness, square) = (4.0 * time.frequency_squared, DoubleDouble::product(omega, omega));
    let top = DoubleDouble::new(stiffness);
    let highest = top * half.cosine.squared();
    let left = highest - square;
    if libm::fabs(left.rounded()) >= LEFT * highest.rounded() {
        return signed(left / top);
    }
    // Where ω² = 4 g/L, it is −S², which may be smaller than what follows can tell from zero.
    if (top - square).rounded() == 0.0 {
        let is_above = libm::fabs(half.sine.rounded()) >= SMALLEST_SINE;
        let size = if half.sine.rounded() < 0.0 { -half.sine } else { half.sine };
        return if is_above { (-1.0, size) } else { (0.0, DoubleDouble::ZERO) };
    }
    let cosine = Fixed::cosine(0.5 * theta);
    let highest = Fixed::new(stiffness).times(cosine.times(cosine));
    let square = Fixed::new(omega).times(Fixed::new(omega));
    let (_, root) = signed(highest.distance(square).to_double_double() / top);
    (if highest < square { -1.0 } else { 1.0 }, root)
}

impl Elliptic {
    fn new(
        jacobi: Jacobi,
        quarters: DoubleDouble,
        rate: DoubleDouble,
        k: DoubleDouble,
        time: &TimeUnit,
    ) -> Self {
        Self {
            jacobi,
            quarters,
            rate: (rate / jacobi.quarter_period).scaled(1.0 / time.unit),
            modulus: k.rounded(),
            speed: 2.0 * (k * time.frequency).rounded() / time.unit,
        }
    }

    /// The phase u/K at time t (s) as a whole number of quarter periods and a remainder of at most
    /// half of one.
    ///
    /// A rounded period would do harm in the product with t, so that product is a double-double:
    /// 10⁵ periods cost no digit of the f64 remainder.
    #[inline]
    fn phase(&self, t: f64) -> (f64, f64) {
        let phase = self.quarters + self.rate * DoubleDouble::new(t);
        let whole = libm::rint(phase.rounded());
        let rest = (phase.rounded() - whole) + phase.remainder();
        // The low part of the double-double may bring the remainder above one half.
        let carry = libm::rint(rest);
        (whole + carry, rest - carry)
    }

    /// tan(θ/2) = k sn u / dn u and ω = 2ω₀ k cn u.
    ///
    /// After an odd number of quarter periods sn, cn, dn become cn/dn, −k' sn/dn, k'/dn (DLMF
    /// Table 22.4.3): near a turning point they are computed from quantities that are small there.
    /// After two, sn and cn change sign.
    // ANCHOR: libration
    #[inline]
    fn libration(&self, t: f64) -> Phase {
        let (whole, rest) = self.phase(t);
        let half = libm::floor(0.5 * whole);
        let sign = if is_even(half) { 1.0 } else { -1.0 };
        let complementary_modulus = self.jacobi.complementary_modulus;
        let Values { sn, cn, dn, .. } = self.jacobi.at(rest);
        let (rise, run, velocity) = if is_even(whole) {
            (sn, dn, cn)
        } else {
            (cn, complementary_modulus, -complementary_modulus * sn / dn)
        };
        Phase {
            theta: sign * 2.0 * libm::atan2(self.modulus * rise, run),
            omega: sign * self.speed * velocity,
        }
    }
    // ANCHOR_END: libration

    /// θ/2 = am(k u, 1/k) and ω = 2ω₀ k dn(k u, 1/k): the number of half turns, and the state
    /// beyond them.
    ///
    /// A quarter period is half a turn. After an odd number of them sc and dn become −1/(k' sc) and
    /// k'/dn, so that the angle beyond the half turns has the tangent k' sc; k' is that of the
    /// modulus 1/k.
    #[inline]
    fn rotation(&self, t: f64) -> (f64, Phase) {
        let (whole, rest) = self.phase(t);
        let complementary_modulus = self.jacobi.complementary_modulus;
        let Values { sc, dn, .. } = self.jacobi.at(rest);
        let (tangent, velocity) = if is_even(whole) {
            (sc, dn)
        } else {
            (complementary_modulus * sc, complementary_modulus / dn)
        };
        let beyond = Phase { theta: 2.0 * libm::atan(tangent), omega: self.speed * velocity };
        (whole, beyond)
    }
}

impl Hyperbolic {
    /// Through the angle with S = `sine` and C = `cosine` at t = 0: sinh u₀ = S/C.
    fn through(sine: DoubleDouble, cosine: DoubleDouble, time: &TimeUnit) -> Self {
        Self {
            start: libm::asinh((sine / cosine).rounded()),
            frequency: time.frequency.rounded() / time.unit,
        }
    }

    /// θ = 2 gd u = 2 atan sinh u and ω = 2ω₀ sech u (DLMF 4.23.39–40).
    #[inline]
    fn at(&self, t: f64) -> Phase {
        let u = self.start + self.frequency * t;
        // sech u without e^|u|, which overflows; where sinh u overflows, its arctangent is still
        // π/2.
        let decay = libm::exp(-libm::fabs(u));
        Phase {
            theta: 2.0 * libm::atan(libm::sinh(u)),
            omega: 2.0 * self.frequency * (2.0 * decay / (1.0 + decay * decay)),
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Units, angles, errors
// -------------------------------------------------------------------------------------------------

/// A unit of time in which g/L is of order 1, so that no square under- or overflows: a power of
/// two, so that the conversion is exact.
struct TimeUnit {
    /// The unit (s).
    unit: f64,
    /// g/L in this unit: from 1/2 to 2.
    frequency_squared: f64,
    /// ω₀ in this unit.
    frequency: DoubleDouble,
}

impl TimeUnit {
    fn new(pendulum: &Pendulum) -> Self {
        let (_, exponent) = libm::frexp(pendulum.frequency_squared());
        let unit = libm::ldexp(1.0, -exponent.div_euclid(2));
        let frequency_squared = pendulum.frequency_squared() * unit * unit;
        Self { unit, frequency_squared, frequency: DoubleDouble::new(frequency_squared).sqrt() }
    }
}

/// Half the angle, minus the multiple of π that corresponds to whole turns of the angle: its cosine
/// is not negative.
struct HalfAngle {
    sine: DoubleDouble,
    cosine: DoubleDouble,
    turns: f64,
}

impl HalfAngle {
    fn new(theta: f64) -> Self {
        let (sine, cosine, quadrant) = reduced_sine_cosine(0.5 * theta);
        // θ/2 = quadrant · π/2 + y. For an odd quadrant the nearest multiple of π is the one below
        // for y ≤ 0 and the one above for y > 0: the reduced half angle is y + π/2 or y − π/2.
        if is_even(quadrant) {
            Self { sine, cosine, turns: 0.5 * quadrant }
        } else if sine.rounded() <= 0.0 {
            Self { sine: cosine, cosine: -sine, turns: 0.5 * (quadrant - 1.0) }
        } else {
            Self { sine: -cosine, cosine: sine, turns: 0.5 * (quadrant + 1.0) }
        }
    }
}

/// Whether an integer is even.
#[inline]
fn is_even(integer: f64) -> bool {
    libm::rint(0.5 * integer) == 0.5 * integer
}

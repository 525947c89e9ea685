//! Kepler's problem: no pendulum, but a second system that is Hamiltonian and separable, with an
//! angular momentum besides its energy.

use core::f64::consts::PI;

use pendula::arithmetic::sine::{cos, sin};
use pendula::{Error, Hamiltonian, Separable, System, state};

use crate::checked;

/// Kepler's problem in its plane, r̈ = −μ r/r³, with the centre at rest in the origin.
///
/// The motion conserves the energy ½v² − μ/r and the angular momentum x v_y − y v_x, and the
/// pericentre stays fixed. Kicks along r and drifts along v do not change the angular momentum, so
/// that every splitting method conserves it up to rounding, but not the pericentre.
///
/// Landau, Lifshitz, *Mechanics*, § 15; Hairer, Lubich, Wanner (2006), Sect. I.2.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kepler {
    attraction: f64,
}

state! {
    /// Position and velocity in the plane, or a rate of change of both.
    ///
    /// As a state, positions are in m and velocities in m/s; as a rate, both are per second.
    pub struct PlanePhase {
        /// Position, along x.
        pub x: f64,
        /// Position, along y.
        pub y: f64,
        /// Velocity, along x.
        pub vx: f64,
        /// Velocity, along y.
        pub vy: f64,
    }
}

/// A vector in the plane; for [`Kepler`]'s force an acceleration (m/s²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Planar {
    /// Component along x.
    pub x: f64,
    /// Component along y.
    pub y: f64,
}

impl Kepler {
    /// A centre of the `attraction` μ = G M (m³/s²).
    ///
    /// # Errors
    /// [`Error::Parameter`] for a μ that is not finite and positive.
    pub fn new(attraction: f64) -> Result<Self, Error> {
        Ok(Self { attraction: positive("attraction μ (m³/s²)", attraction)? })
    }

    /// The attraction μ (m³/s²).
    pub const fn attraction(&self) -> f64 {
        self.attraction
    }

    /// Angular momentum per unit of mass, x v_y − y v_x (m²/s).
    #[inline]
    pub fn angular_momentum(&self, z: PlanePhase) -> f64 {
        z.x * z.vy - z.y * z.vx
    }

    /// The vector towards the pericentre whose length is the eccentricity (Laplace, Runge, Lenz): v
    /// × l/μ − r/r.
    pub fn eccentricity(&self, z: PlanePhase) -> Planar {
        let momentum = self.angular_momentum(z);
        let r = distance(z);
        Planar {
            x: z.vy * momentum / self.attraction - z.x / r,
            y: -z.vx * momentum / self.attraction - z.y / r,
        }
    }
}

/// An ellipse about a centre: the exact motion, from the pericentre on the positive x axis,
/// counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    attraction: f64,
    semi_major: f64,
    eccentricity: f64,
}

impl Ellipse {
    /// The ellipse about `centre` of the semi-major axis a (m) and the eccentricity e.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an a that is not finite and positive, for an e outside 0 ≤ e < 1,
    /// and where the period 2π√(a³/μ), or on the orbit r³, μ/r³ or μ/r, leaves the range of normal
    /// numbers.
    pub fn new(centre: &Kepler, semi_major: f64, eccentricity: f64) -> Result<Self, Error> {
        let semi_major = positive("semi-major axis a (m)", semi_major)?;
        let fits = (0.0..1.0).contains(&eccentricity);
        checked("eccentricity e", eccentricity, fits, "at least 0 and below 1")?;
        let ellipse = Self { attraction: centre.attraction, semi_major, eccentricity };
        normal("mean motion √(μ/a³) (rad/s)", ellipse.mean_motion())?;
        normal("period 2π√(a³/μ) (s)", ellipse.period())?;
        // From the pericentre to the apocentre; the square of the velocity is below 2μ/r.
        for r in [semi_major * (1.0 - eccentricity), semi_major * (1.0 + eccentricity)] {
            let cube = normal("r³ on the orbit (m³)", r * r * r)?;
            normal("μ/r³ on the orbit (1/s²)", centre.attraction / cube)?;
            normal("2μ/r on the orbit (m²/s²)", 2.0 * (centre.attraction / r))?;
        }
        Ok(ellipse)
    }

    /// Semi-major axis a (m).
    pub const fn semi_major(&self) -> f64 {
        self.semi_major
    }

    /// Eccentricity e.
    pub const fn eccentricity(&self) -> f64 {
        self.eccentricity
    }

    /// Mean angular velocity n = √(μ/a³) (rad/s), Kepler's third law.
    pub fn mean_motion(&self) -> f64 {
        libm::sqrt(self.attraction / self.semi_major) / self.semi_major
    }

    /// Time 2π/n of a revolution (s).
    pub fn period(&self) -> f64 {
        2.0 * PI / self.mean_motion()
    }

    /// Position and velocity at time `t` (s) after the pericentre, through the eccentric anomaly E:
    /// E − e sin E = nt.
    pub fn at(&self, t: f64) -> PlanePhase {
        let Self { semi_major: a, eccentricity: e, .. } = *self;
        let n = self.mean_motion();
        let anomaly = eccentric_anomaly(n * t, e);
        let (s, c) = (sin(anomaly), cos(anomaly));
        let flat = libm::sqrt((1.0 - e) * (1.0 + e));
        let turning = n / (1.0 - e * c);
        PlanePhase {
            x: a * (c - e),
            y: a * flat * s,
            vx: -a * s * turning,
            vy: a * flat * c * turning,
        }
    }
}

/// The root E of Kepler's equation E − e sin E = `mean` (rad).
fn eccentric_anomaly(mean: f64, e: f64) -> f64 {
    // The root lies within e of the mean. Newton's step, or bisection where Newton's step would
    // leave the bracket: 60 bisections exhaust an f64, and ten steps are more than Newton needs.
    let (mut low, mut high) = (mean - e, mean + e);
    let mut anomaly = mean;
    for _ in 0..70 {
        let excess = anomaly - e * sin(anomaly) - mean;
        if excess > 0.0 {
            high = anomaly;
        } else {
            low = anomaly;
        }
        let newton = anomaly - excess / (1.0 - e * cos(anomaly));
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - anomaly).abs() <= f64::EPSILON * anomaly.abs() {
            return next;
        }
        anomaly = next;
    }
    anomaly
}

/// Returns `value` if it is finite and greater than zero.
fn positive(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value.is_finite() && value > 0.0, "finite and greater than zero")
}

/// Returns `value`, a product of parameters, if it neither overflowed nor lost digits to underflow.
fn normal(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value.is_normal(), "between 2.3e-308 and 1.8e308")
}

#[inline]
fn distance(z: PlanePhase) -> f64 {
    libm::sqrt(z.x * z.x + z.y * z.y)
}

impl System for Kepler {
    type State = PlanePhase;

    #[inline]
    fn rate(&self, t: f64, z: PlanePhase) -> PlanePhase {
        let acceleration = self.force(t, z);
        PlanePhase { x: z.vx, y: z.vy, vx: acceleration.x, vy: acceleration.y }
    }
}

impl Separable for Kepler {
    type Force = Planar;

    #[inline]
    fn force(&self, _t: f64, z: PlanePhase) -> Planar {
        let r = distance(z);
        let strength = -self.attraction / (r * r * r);
        Planar { x: strength * z.x, y: strength * z.y }
    }

    #[inline]
    fn kick(&self, z: PlanePhase, force: Planar, h: f64) -> PlanePhase {
        PlanePhase { vx: z.vx + force.x * h, vy: z.vy + force.y * h, ..z }
    }

    #[inline]
    fn drift(&self, z: PlanePhase, h: f64) -> PlanePhase {
        PlanePhase { x: z.x + z.vx * h, y: z.y + z.vy * h, ..z }
    }
}

impl Hamiltonian for Kepler {
    /// ½v² − μ/r (J/kg): per unit of mass, and zero for a planet at rest at infinity, since there
    /// is no equilibrium to measure from.
    fn energy(&self, z: PlanePhase) -> f64 {
        0.5 * (z.vx * z.vx + z.vy * z.vy) - self.attraction / distance(z)
    }
}

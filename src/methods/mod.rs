//! The methods, by family, and the list of them all.
//!
#![doc = include_str!("table.md")]
//!
//! Evaluations are those of the force a step; for an implicit method, those of one sweep of its
//! iteration. Each entry is the [`MethodInfo`] in the method's own file.
//!
//! # A method of your own
//!
//! A type with a [`step`](crate::Method::step): `()` for what it carries from one step to the next,
//! if it carries nothing. For every [`System`](crate::System) it may evaluate the rate of change;
//! for a [`Separable`](crate::Separable) one, the force, a kick and a drift.
//!
//! ```
//! use pendula::{Grid, Method, Pendulum, Phase, System, integrate};
//!
//! /// Ralston's method of order 2.
//! struct Ralston;
//!
//! impl<S: System> Method<S> for Ralston {
//!     type Carry = ();
//!
//!     fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}
//!
//!     fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
//!         let k1 = system.rate(t, z);
//!         let k2 = system.rate(t + h * 2.0 / 3.0, z + k1 * (h * 2.0 / 3.0));
//!         z + k1 * (h / 4.0) + k2 * (h * 3.0 / 4.0)
//!     }
//! }
//!
//! // Half the step, a quarter of the error.
//! let start = Phase::at_rest(1.0);
//! let truth = pendula::Motion::new(&Pendulum::PAPER, start)?.at(1.0);
//! let error = |h| -> Result<f64, pendula::Error> {
//!     let grid = Grid::with_duration(h, 1.0)?;
//!     let end = integrate(&Pendulum::PAPER, &Ralston, start, &grid);
//!     Ok((end.theta - truth.theta).abs())
//! };
//! // The next term of the error is smaller by the step, 0.001 s, times a few rad/s.
//! let ratio = error(0.001)? / error(0.0005)?;
//! assert!((ratio - 4.0).abs() < 0.04, "{ratio}");
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! A method is added to the library in three places: its file, two lines in its family's `mod.rs`,
//! and a line in `list.rs`. CONTRIBUTING.md has the recipe.

pub mod implicit;
mod list;
pub mod processed;
mod projected;
pub mod runge_kutta;
pub mod splitting;
pub mod taylor;

pub use implicit::*;
pub use processed::*;
pub use projected::Projected;
pub use runge_kutta::*;
pub use splitting::*;
pub use taylor::*;

/// The properties of a method. They are defined once, beside the method's step, and read by every
/// test, table and page.
///
/// Yours ends with [`..MethodInfo::new(…)`](Self::new), because there may be more fields in later
/// versions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodInfo {
    /// Name on the command line and in test names.
    pub name: &'static str,
    /// Name in tables and text.
    pub title: &'static str,
    /// Other names in use for the same method.
    pub aliases: &'static [&'static str],
    /// Order p: the global error of the state is O(hᵖ).
    pub order: u32,
    /// Whether one step preserves area in phase space for every Hamiltonian system.
    pub symplectic: bool,
    /// Whether a step with −h undoes a step with h.
    pub symmetric: bool,
    /// Whether a step of any length conserves the energy, to rounding.
    pub conserves_energy: bool,
    /// Whether a step solves equations by iteration. The number of evaluations then depends on the
    /// number of sweeps, and where the step is too long for the iteration to converge, every
    /// component of the state is NaN.
    pub implicit: bool,
    /// Force evaluations a step; for an implicit method, those of one sweep of its iteration, which
    /// begins with one more.
    pub force_evaluations: u64,
    /// Force evaluations once, before the first step.
    pub start_evaluations: u64,
    /// Where the method is defined and analysed.
    pub reference: &'static str,
}

impl MethodInfo {
    /// An explicit method of `name` and order p of which nothing else is claimed, with p force
    /// evaluations a step. You write what else is known of it before it:
    ///
    /// ```
    /// use pendula::MethodInfo;
    ///
    /// const LEAPFROG: MethodInfo = MethodInfo {
    ///     symplectic: true,
    ///     symmetric: true,
    ///     force_evaluations: 1,
    ///     ..MethodInfo::new("leapfrog", 2)
    /// };
    /// assert_eq!(LEAPFROG.title, "leapfrog");
    /// assert!(LEAPFROG.symmetric && !LEAPFROG.implicit);
    /// ```
    pub const fn new(name: &'static str, order: u32) -> Self {
        Self {
            name,
            title: name,
            aliases: &[],
            order,
            symplectic: false,
            symmetric: false,
            conserves_energy: false,
            implicit: false,
            force_evaluations: order as u64,
            start_evaluations: 0,
            reference: "",
        }
    }

    /// Whether the method is called so: by its [`name`](Self::name), its [`title`](Self::title) or
    /// one of its [`aliases`](Self::aliases). Capitals and all that is no letter and no digit, such
    /// as hyphens and spaces, make no difference, nor do accents.
    ///
    /// ```
    /// use pendula::{Info, StormerVerlet};
    ///
    /// let info = StormerVerlet.info();
    /// for name in ["stormer-verlet", "Störmer–Verlet", "velocity_verlet", "Leapfrog"] {
    ///     assert!(info.is_called(name));
    /// }
    /// assert!(!info.is_called("position-verlet"));
    /// ```
    pub fn is_called(&self, name: &str) -> bool {
        let mut names = [self.name, self.title].into_iter().chain(self.aliases.iter().copied());
        folded(name).next().is_some() && names.any(|own| folded(own).eq(folded(name)))
    }
}

/// The letters and digits of a name, small and without the accents that names of methods have.
fn folded(name: &str) -> impl Iterator<Item = char> {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).map(|c| match c {
        'ö' => 'o',
        'ś' => 's',
        other => other,
    })
}

/// A method with a [`MethodInfo`].
pub trait Info {
    /// The properties of the method.
    fn info(&self) -> MethodInfo;
}

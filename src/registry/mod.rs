//! The library's methods, and methods that are chosen at run time.
//!
//! [`method_named`] finds a method by its name or an alias, such as `"stormer-verlet"`, `"velocity
//! Verlet"` or `"leapfrog"`, on every system that is [`ByName`]: those of the library, closures,
//! and those of your own by a line. [`ByName::methods`] has the list of them, and [`METHODS`] is
//! the one for the pendulum, which tests, tables, benches and book use.
//!
//! A method that is chosen at run time is a `&dyn` [`AnyMethod`]. A function that is generic in its
//! system takes it as it takes a method that is known by its type, since each of those is one:
//!
//! ```
//! use pendula::methods::BlanesMoan6;
//! use pendula::systems::{ArrayPhase, FromForce};
//! use pendula::{AnyMethod, Grid, Rk4, StormerVerlet, System};
//!
//! fn last<S: System + 'static>(
//!     method: &dyn AnyMethod<S>,
//!     system: &S,
//!     start: S::State,
//!     grid: &Grid,
//! ) -> S::State {
//!     method.end(system, start, grid)
//! }
//!
//! let spring = FromForce::new(|_t, [x]: [f64; 1]| [-x]);
//! let (start, grid) = (ArrayPhase::at_rest([1.0]), Grid::with_duration(0.01, 1.0)?);
//! let methods: [&dyn AnyMethod<_>; 3] = [&Rk4, &StormerVerlet, &BlanesMoan6];
//! for method in methods {
//!     let [x] = last(method, &spring, start, &grid).positions;
//!     assert!((x - 1.0_f64.cos()).abs() < 1e-5, "{}", method.info().title);
//! }
//! assert_eq!(last(&Rk4, &spring, start, &grid), last(methods[0], &spring, start, &grid));
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! On the pendulum the methods of the list take steps as
//! [`integrate_fast`](crate::integrate_fast()) does, with the step as the unit of time: the last
//! bits differ from those of [`integrate`](crate::integrate()), and it takes two thirds of the
//! time. On all other systems, and where a method becomes an [`AnyMethod`] by its type, the bits
//! are those of [`integrate`](crate::integrate()); within [`InSteps`] it takes the faster steps
//! too.
//!
//! A method that chooses its own steps is found as an
//! [`AnyEmbedded`](crate::adaptive::AnyEmbedded).

mod any;
mod list;
pub(crate) mod names;

pub use any::{AnyMethod, InSteps};
pub use list::METHODS;
pub use names::{ByName, method_named, methods_for, methods_for_separable};

//! The library's methods, and methods that are chosen at run time.
//!
//! [`METHODS`] is the one list that tests, tables, benches and book use: the methods on the
//! pendulum, of which [`method_named`] finds one. They take its steps as
//! [`integrate_fast`](crate::integrate_fast()) does, with the step as the unit of time: the last
//! bits differ from those of [`integrate`](crate::integrate()), and it takes two thirds of the
//! time. A method that is made [`AnyMethod`] from its type has the bits of
//! [`integrate`](crate::integrate()), as those have that [`in_seconds`] finds; within [`InSteps`]
//! it takes the faster steps too.
//!
//! | on | by name | bits |
//! |---|---|---|
//! | the pendulum | [`method_named`] | those of [`integrate_fast`](crate::integrate_fast()) |
//! | the pendulum, in seconds | [`in_seconds`] | those of [`integrate`](crate::integrate()) |
//! | another system of the library | [`ByName::method_named`] | those of [`integrate`](crate::integrate()) |
//! | a system of your own | [`method_for`], [`method_for_separable`] | the same |
//!
//! Names are those of [`MethodInfo::name`](crate::MethodInfo::name), such as `"stormer-verlet"`.
//! On other systems of the library methods are found by [`ByName::method_named`]; on a system of
//! your own by [`method_for`], or by [`method_for_separable`] if it is
//! [`Separable`](crate::Separable):
//!
//! ```
//! use pendula::registry::{ByName, method_for};
//! use pendula::{Damped, Grid, Pendulum, Phase, System, method_named};
//!
//! let (start, grid) = (Phase::at_rest(1.0), Grid::with_duration(0.01, 1.0)?);
//! let rk4 = method_named("rk4").expect("a method of the library");
//! let free = rk4.end(&Pendulum::PAPER, start, &grid);
//!
//! let damped = Damped::new(Pendulum::PAPER, 0.1)?;
//! let slower = Damped::method_named("rk4").expect("as above").end(&damped, start, &grid);
//! assert!(slower.omega.abs() < free.omega.abs());
//!
//! /// ẍ = −9 x.
//! #[derive(Clone)]
//! struct Spring;
//!
//! impl System for Spring {
//!     type State = Phase;
//!
//!     fn rate(&self, _t: f64, z: Phase) -> Phase {
//!         Phase { theta: z.omega, omega: -9.0 * z.theta }
//!     }
//! }
//!
//! for name in ["rk4", "gauss-6"] {
//!     let method = method_for(name).expect("a Runge–Kutta method");
//!     let end = method.end(&Spring, start, &grid);
//!     assert!((end.theta - 3.0_f64.cos()).abs() < 1e-7, "{}", method.info().title);
//! }
//! # Ok::<(), pendula::Error>(())
//! ```

mod any;
mod list;
mod names;

pub use any::{AnyMethod, InSteps};
pub use list::{METHODS, method_named};
pub use names::{ByName, in_seconds, method_for, method_for_separable};

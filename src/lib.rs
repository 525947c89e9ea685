//! Numerical integrators on the simple pendulum, θ̈ + (g/L) sin θ = 0, and the tests that they are
//! right.
//!
//! A run has a system, a method, a start, a grid of times, and perhaps an observer of its states.
//! Nothing else costs time.
//!
//! ```
//! use pendula::metrics::EnergyDrift;
//! use pendula::{Grid, Pendulum, Phase, StormerVerlet, integrate_with};
//!
//! let pendulum = Pendulum::PAPER;
//! let ten_seconds = Grid::with_duration(0.01, 10.0)?;
//! let mut drift = EnergyDrift::new(&pendulum);
//! let end =
//!     integrate_with(&pendulum, &StormerVerlet, Phase::at_rest(1.0), &ten_seconds, &mut drift);
//! assert!(end.theta.abs() < 1.0 && drift.largest() < 1.1e-3);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! Any other system is a closure: its rate of change, or the accelerations alone.
//!
//! ```
//! use pendula::{ArrayPhase, FromForce, FromRate, Grid, Rk4, StormerVerlet, integrate};
//!
//! let grid = Grid::with_duration(0.01, 20.0)?;
//! let van_der_pol = FromRate::new(|_t, [x, v]: [f64; 2]| [v, (1.0 - x * x) * v - x]);
//! let end = integrate(&van_der_pol, &Rk4, [2.0, 0.0], &grid);
//! assert!(end[0].abs() < 2.1);
//!
//! let galaxy = FromForce::new(|_t, [x, y]: [f64; 2]| [-x - 2.0 * x * y, -y - x * x + y * y]);
//! let end = integrate(&galaxy, &StormerVerlet, ArrayPhase::at_rest([0.1, 0.2]), &grid);
//! assert!(end.positions[0].abs() < 1.0);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! # Where to start
//!
//! Each of these tasks is a program of some twenty lines in the folder `examples/tasks` of the
//! repository, the last one in `examples/judge.rs`. Beside it stands what it is in SciPy's
//! `scipy.integrate` and in OrdinaryDiffEq.jl. Names that are not links need a
//! [feature](#features): `trajectory`, `states`, `solve` and methods by name `alloc`, an `Ensemble`
//! `ensemble`.
//!
//! | task | here | SciPy | OrdinaryDiffEq.jl |
//! |---|---|---|---|
//! | `trajectory` | `trajectory()` | `solve_ivp(…).y` | `solve(prob, RK4(); dt, adaptive=false)` |
//! | `rate`, a rate as a closure | [`FromRate`] | `fun` | `ODEProblem(f, u0, tspan)` |
//! | `n_bodies`, `chain`, from accelerations | [`FromForce`] | none | `SecondOrderODEProblem(f, v0, u0, tspan)`, `VelocityVerlet()` |
//! | `henon_heiles`, with an energy | [`FromForce::with_potential`] | none | `HamiltonianProblem(H, p0, q0, tspan)` |
//! | `bouncing_ball`, an event | [`AdaptiveSteps::crossings`](adaptive::AdaptiveSteps::crossings) | `events`, `terminal` | `ContinuousCallback` |
//! | `output_times` | `Adaptive::states`, `Adaptive::solve` | `t_eval`, `dense_output` | `saveat`, `sol(t)` |
//! | `adaptive_options` | [`first_step`](adaptive::Adaptive::first_step), [`max_step`](adaptive::Adaptive::max_step), [`Tolerance::new(atol, rtol)`](adaptive::Tolerance::new), [`for_each`](adaptive::Tolerance::for_each) | `first_step`, `max_step`, `rtol`, `atol` | `dt`, `dtmax`, `abstol` |
//! | `ensemble`, many starts | `Ensemble` | none | `EnsembleProblem` |
//! | `method_table`, a list of methods | `&[&dyn AnyMethod]` | a list of `method` | a list of `alg` |
//! | `method_by_name` | `method_named("velocity-verlet")` | none | none |
//! | `adaptive_by_name` | [`AnyEmbedded::named("RK45")`](adaptive::AnyEmbedded::named) | `method="RK45"` | `DP5()` |
//! | `own_method` | [`Method`] | `OdeSolver` | `alg_cache`, `perform_step!` |
//! | `judge`, a closure judged | `pendula_judge::judge` | none | none |
//!
//! * The four methods of the paper, a few lines each: [`ForwardEuler`], [`SymplecticEuler`],
//!   [`Rk4`], [`StormerVerlet`]. The others are in [`methods`], as a table.
//! * The problem: [`Pendulum`], and its exact solution, [`Motion`].
//!
//! The book, which `cargo run` builds from the repository, walks through each of them.
//!
//! # What it is not for
//!
//! * Stiff systems. For van der Pol's oscillator with μ = 1000 to t = 100, [`methods::Dop853`] with
//!   a tolerance of 10⁻⁶ takes 45 000 steps, in which little happens; and the implicit methods here
//!   are solved by iteration, which converges for short steps only. Take SciPy's `Radau` or `BDF`,
//!   or the crate `diffsol`.
//! * States whose length is known at run time only. A state is copied, and its length is known to
//!   the compiler: up to some hundred numbers.
//! * Equations with constraints, delays or noise.
//!
//! # The loops
//!
//! Arguments come in one order: the system, the method, the start, the times, the observer.
//!
//! | loop | takes | use it |
//! |---|---|---|
//! | [`integrate()`], [`integrate_with`] | any system, fixed steps | unless there is a reason for another |
//! | [`integrate_fast()`] | the pendulum, fixed steps | for speed: two thirds of the time; the last bits differ |
//! | `Ensemble` | many pendulums, or any other system, fixed steps | for sweeps: pendulums in vector instructions; all cores with the feature `parallel` |
//! | [`Adaptive`](adaptive::Adaptive) | any system, to a tolerance | where the pace of the motion varies, for events and output at any time |
//! | [`SymmetricSteps`](adaptive::SymmetricSteps) | a separable system, steps that vary | for long runs with steps that vary: the energy does not drift |
//!
//! # The modules, in reading order
//!
//! * [`systems`]: the equations of motion; a system of your own.
//! * [`integrate`](mod@integrate): the time loop, its grid and its observers; what a method is.
//! * [`methods`]: the methods, by family; a method of your own.
//! * [`exact`]: the motion of the pendulum in closed form.
//! * [`metrics`]: quantities measured along a run.
//! * `registry`: methods that are chosen at run time.
//! * [`fast`]: the same steps at full speed, for one pendulum and for many.
//! * [`adaptive`]: steps whose size follows the motion.
//! * [`arithmetic`]: sine and cosine.
//! * [`error`]: the errors.
//!
//! What is public and hidden from this documentation, the module `internals` above all, serves the
//! tests and the book of the repository: it is no part of the interface, and may change at any
//! time.
//!
//! # Features
//!
//! | feature | adds | needs |
//! |---|---|---|
//! | `alloc` | what is returned in a `Vec`: `trajectory`, `Adaptive::states`, `Adaptive::solve`; the module `registry`, methods that are chosen at run time | alloc |
//! | `ensemble` | `Ensemble` | std, the crate `fearless_simd` |
//! | `parallel` | ensembles on all cores | std, the crate `rayon` |
//! | `table` | the methods of `registry`, compiled with the library for its systems and in lanes | std; a minute to compile |
//!
//! Without any of them the library is `no_std` and depends on `libm` alone.
//!
//! # What is compiled where
//!
//! [`integrate()`], [`integrate_fast()`] and `Ensemble` with a method that is named by its type
//! are compiled in your crate, at its level of optimisation: in lanes that is seconds for a method,
//! and in an unoptimised build they are two hundred times as slow. A method that is found by its
//! name is compiled with this library: `METHODS` for one pendulum, and with the feature `table` the
//! same in ensembles and on the library's other systems. So that these run at full speed in your
//! dev build, optimise the library in your `Cargo.toml`:
//!
//! ```toml
//! [profile.dev.package.pendula]
//! opt-level = 3
//! debug = false
//! # With them the vectors are narrow, and an ensemble takes four times as long.
//! debug-assertions = false
//! ```
//!
//! Every result comes from additions, multiplications, divisions and square roots in a fixed
//! order, so that debug and release, and one machine and another, give the same bits.
#![cfg_attr(not(feature = "ensemble"), no_std)]
#![warn(clippy::disallowed_methods, missing_debug_implementations)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod adaptive;
pub mod arithmetic;
pub mod error;
pub mod exact;
pub mod fast;
pub mod integrate;
pub mod methods;
pub mod metrics;
#[cfg(feature = "alloc")]
pub mod registry;
pub mod systems;

pub use error::Error;
pub use exact::{Motion, MotionKind};
#[cfg(feature = "ensemble")]
pub use fast::Ensemble;
pub use fast::{integrate_fast, integrate_fast_with};
#[cfg(feature = "alloc")]
pub use integrate::trajectory;
pub use integrate::{
    Grid, Method, Observer, Unsolved, integrate, integrate_with, try_integrate, try_integrate_with,
};
pub use methods::{ForwardEuler, Info, MethodInfo, Rk4, StormerVerlet, SymplecticEuler, Taylor};
#[cfg(feature = "alloc")]
pub use registry::{AnyMethod, METHODS, method_named};
pub use systems::{
    Array, ArrayPhase, Compensated, CompensatedPhase, Components, Counting, Damped, DoublePendulum,
    Driven, FromForce, FromRate, Hamiltonian, LinearOscillator, Pendulum, Phase, RateOf, Separable,
    Shaken, State, System, Vector,
};

#[doc(hidden)]
pub mod internals;

/// The README's listing, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

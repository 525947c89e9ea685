//! Methods by their names.

use crate::registry::{AnyMethod, METHODS};
use crate::systems::{
    AsState, Compensated, FromForce, FromRate, Measurable, Pendulum, Separable, System,
};
use crate::{methods, systems};

#[diagnostic::on_unimplemented(
    message = "the methods of the library are not found by their names on `{Self}`",
    note = "implement `pendula::registry::ByName` for it, with `methods_for()` as its methods, or \
            `methods_for_separable()` if it is `Separable`; it has to be `Clone` and `Send`, and \
            to borrow nothing"
)]
/// A system on which the methods of the library are found by their names.
///
/// A closure is one, by [`FromForce`] or [`FromRate`], unless it borrows something. A type of your
/// own becomes one by a line:
///
/// ```
/// use pendula::registry::{ByName, methods_for};
/// use pendula::{AnyMethod, Grid, Phase, System, method_named};
///
/// /// ẍ = −9 x.
/// #[derive(Clone)]
/// struct Spring;
///
/// impl System for Spring {
///     type State = Phase;
///
///     fn rate(&self, _t: f64, z: Phase) -> Phase {
///         Phase { theta: z.omega, omega: -9.0 * z.theta }
///     }
/// }
///
/// impl ByName for Spring {
///     fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
///         methods_for()
///     }
/// }
///
/// let grid = Grid::with_duration(0.01, 1.0)?;
/// for name in ["RK4", "gauss-6"] {
///     let method = method_named(name).expect("a Runge–Kutta method");
///     let end = method.end(&Spring, Phase::at_rest(1.0), &grid);
///     assert!((end.theta - 3.0_f64.cos()).abs() < 1e-7, "{}", method.info().title);
/// }
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// With the feature `table` the methods for the systems of the library are compiled with it;
/// without, and for your own, in your crate.
pub trait ByName: System + 'static {
    /// The methods of the library that suit the system, in the order of
    /// [`METHODS`](crate::METHODS).
    fn methods() -> &'static [&'static dyn AnyMethod<Self>]
    where
        Self: Sized;
}

/// The method [called](crate::MethodInfo::is_called) so, by its name or an alias, capitals and
/// hyphens aside; none if there is no such method, or if it needs more of a system than this one
/// has. Its steps are those of the grid: `rk45` is Dormand and Prince's method with *fixed* steps.
/// For steps that follow a tolerance, as in SciPy, there is
/// [`AnyEmbedded::named`](crate::adaptive::AnyEmbedded::named).
///
/// ```
/// use pendula::{Damped, Grid, Pendulum, Phase, method_named};
///
/// let (start, grid) = (Phase::at_rest(1.0), Grid::with_duration(0.01, 1.0)?);
/// let verlet = method_named("velocity-verlet").expect("another name of Störmer–Verlet");
/// let free = verlet.end(&Pendulum::PAPER, start, &grid);
///
/// let damped = Damped::new(Pendulum::PAPER, 0.1)?;
/// let slower = method_named("leapfrog").expect("as above").end(&damped, start, &grid);
/// assert!(slower.omega.abs() < free.omega.abs());
/// # Ok::<(), pendula::Error>(())
/// ```
#[cfg_attr(not(feature = "table"), inline)]
pub fn method_named<S: ByName>(name: &str) -> Option<&'static dyn AnyMethod<S>> {
    S::methods().iter().copied().find(|method| method.info().is_called(name))
}

macro_rules! list {
    ($($module:ident::$method:ident,)+) => {
        const { &[$(&methods::$method),+] }
    };
}

/// The Runge–Kutta methods, explicit and implicit, which suit every system.
pub fn methods_for<S>() -> &'static [&'static dyn AnyMethod<S>]
where
    S: System<State: Measurable> + Clone + Send + 'static,
{
    crate::for_each_runge_kutta_method!(list)
}

/// The Runge–Kutta and splitting methods, which suit every separable system.
pub fn methods_for_separable<S>() -> &'static [&'static dyn AnyMethod<S>]
where
    S: Separable<State: Measurable> + Clone + Send + 'static,
{
    crate::for_each_general_method!(list)
}

/// The method called so on the pendulum, with the time in seconds: the bits of
/// [`integrate`](crate::integrate()).
#[cfg_attr(not(feature = "table"), inline)]
pub fn in_seconds(name: &str) -> Option<&'static dyn AnyMethod> {
    let methods: &[&dyn AnyMethod] = crate::for_each_method!(list);
    methods.iter().copied().find(|method| method.info().is_called(name))
}

impl ByName for Pendulum {
    fn methods() -> &'static [&'static dyn AnyMethod] {
        METHODS
    }
}

impl ByName for Compensated<Pendulum> {
    #[cfg_attr(not(feature = "table"), inline)]
    fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
        crate::for_each_method!(list)
    }
}

impl<Z, F> ByName for FromRate<Z, F>
where
    Z: AsState<State: Measurable> + 'static,
    F: Fn(f64, Z) -> Z::Rate + Clone + Send + 'static,
{
    fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
        methods_for()
    }
}

impl<const N: usize, F, V> ByName for FromForce<N, F, V>
where
    F: Fn(f64, [f64; N]) -> [f64; N] + Clone + Send + 'static,
    V: Clone + Send + 'static,
{
    fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
        methods_for_separable()
    }
}

macro_rules! methods_on {
    (separable) => {
        methods_for_separable()
    };
    (general) => {
        methods_for()
    };
}

macro_rules! by_name {
    ($($mark:ident $System:ident,)+) => {
        $(impl ByName for systems::$System {
            #[cfg_attr(not(feature = "table"), inline)]
            fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
                methods_on!($mark)
            }
        })+
    };
}
crate::for_each_system!(by_name);

//! A zoo of impostors: wrong methods, each close to a right one. Most have been published or
//! shipped.
//!
//! An impostor of a method has the entry of the method that it poses as, and so claims its order,
//! its symplecticity and its work.

pub mod completing;
pub mod euler;
pub mod high_order;
mod list;
pub mod processed;
pub mod recorded;
pub mod runge_kutta;
pub mod solvers;
pub mod tabled;
pub mod verlet;
pub mod wrapped;

pub use list::{Impostor, impostor_named, impostors};

use crate::properties::driven::Pushed;
use pendula::{Counting, Pendulum, Phase, System};

/// A system whose state is θ and ω: all that an impostor needs.
pub trait Plain: System<State = Phase> {
    /// What `work` returns, whose evaluations are not counted if others are.
    fn uncounted<T>(&self, work: impl FnOnce(&Self) -> T) -> T {
        work(self)
    }
}

impl Plain for Pendulum {}

impl<S: Plain> Plain for Counting<S> {
    fn uncounted<T>(&self, work: impl FnOnce(&Self) -> T) -> T {
        Counting::uncounted(self, work)
    }
}

impl Plain for Pushed {}

/// Gives an impostor the entry of the method that it poses as.
macro_rules! poses_as {
    ($type:ty, $truth:expr) => {
        impl pendula::Info for $type {
            fn info(&self) -> pendula::MethodInfo {
                pendula::Info::info(&$truth)
            }
        }
    };
}
pub(crate) use poses_as;

/// Makes a method from an expression for its step. Its entry is that of the method it poses as; it
/// may need more than a force of its system.
macro_rules! impostor {
    (
        $(#[$doc:meta])*
        $name:ident poses as $truth:ident $(needing $bound:path)?,
        |$system:pat_param, $t:pat_param, $h:pat_param, $z:pat_param| $step:expr
    ) => {
        $(#[$doc])*
        pub struct $name;

        $crate::zoo::poses_as!($name, $truth);

        impl<S> pendula::Method<S> for $name
        where
            S: $crate::zoo::Plain + pendula::Separable<Force = f64> $(+ $bound)?,
        {
            type Carry = ();

            fn start(&self, _system: &S, _t: f64, _h: f64, _z: pendula::Phase) {}

            fn step(
                &self,
                $system: &S,
                $t: f64,
                $h: f64,
                $z: pendula::Phase,
                _carry: &mut (),
            ) -> pendula::Phase {
                $step
            }
        }
    };
}
pub(crate) use impostor;

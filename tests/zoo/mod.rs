//! A zoo of impostors: wrong methods and wrong metrics, each close to a right one. Most have been published or shipped.
//!
//! An impostor of a method has the entry of the method that it poses as, and so claims its order, its symplecticity and
//! its work.

pub mod euler;
pub mod metrics;
pub mod problem;
pub mod runge_kutta;
pub mod verlet;
pub mod wrapped;

/// Makes a method of one expression for its step. Its entry is that of the method it poses as.
macro_rules! impostor {
    ($(#[$doc:meta])* $name:ident poses as $truth:ident, |$system:ident, $h:ident, $z:ident| $step:expr) => {
        $(#[$doc])*
        pub struct $name;

        impl pendula::Described for $name {
            fn properties(&self) -> pendula::Properties {
                pendula::Described::properties(&$truth)
            }
        }

        impl<S: pendula::Separable<State = pendula::Phase, Force = f64>> pendula::Method<S> for $name {
            type Memo = ();

            fn start(&self, _system: &S, _t: f64, _z: pendula::Phase) {}

            fn step(&self, $system: &S, _t: f64, $h: f64, $z: pendula::Phase, _memo: &mut ()) -> pendula::Phase {
                $step
            }
        }
    };
}
pub(crate) use impostor;

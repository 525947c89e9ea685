//! The suite against itself: wrong methods have to be caught.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

/// Makes of the function `$test` a test for each wrong method.
macro_rules! each_impostor {
    ($test:ident) => {
        pendula_judge::for_each_impostor! { impostors, => $test }
    };
}

macro_rules! impostors {
    ($($name:ident: $impostor:expr, $truth:expr, [$($caught_by:ident),+];)+ => $test:ident) => {
        cases! { $test: $($name(stringify!($name)),)+ }
    };
}

mod any_claims;
mod discrimination;
mod equations;
mod garbage;
mod judged;
mod looks;
mod metrics;
mod solvers;
mod strangers;

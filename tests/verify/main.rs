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

/// Asserts that the file `name` in this folder has this text. With INSTA_UPDATE=always, as
/// `.ci/after --accept` sets it, the text is written instead.
#[track_caller]
fn assert_text(name: &str, text: &str) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/verify/");
    let path = std::path::Path::new(path).join(name);
    if std::env::var_os("INSTA_UPDATE").is_some_and(|update| update == "always") {
        std::fs::write(&path, text).unwrap();
    }
    let before = std::fs::read_to_string(&path).unwrap();
    let differ = text.lines().zip(before.lines()).find(|(now, before)| now != before);
    assert!(text == before, "{name}: .ci/after --accept writes it anew; {differ:?}\n{text}");
}

mod any_claims;
mod discrimination;
mod equal_steps;
mod equations;
mod garbage;
mod habits;
mod honest;
mod integrators;
mod judged;
mod looks;
mod metrics;
mod programs;
mod search;
mod solvers;

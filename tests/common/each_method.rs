//! Shared by the tests: the methods as rstest cases.
#![allow(unused_macros, reason = "each test file uses one or the other")]

/// Makes an rstest template of the library's list of methods, so that every test also runs on a new
/// method.
macro_rules! template {
    ($($module:ident::$method:ident,)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$module(pendula::methods::$method)])+
        pub fn each_method(#[case] method: M) {}
    };
}
pendula::for_each_method!(template);

/// The same for the methods that also apply to systems other than the pendulum.
macro_rules! general_template {
    ($($module:ident::$method:ident,)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$module(pendula::methods::$method)])+
        pub fn each_general_method(#[case] method: M) {}
    };
}
pendula::for_each_general_method!(general_template);

//! What the tests share: the methods as rstest cases.
#![allow(unused_macros, reason = "each test file uses one or the other")]

/// Makes an rstest template of the library's list of methods, so that a new method is under every
/// test at once.
macro_rules! template {
    ($($module:ident::$method:ident,)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$module(pendula::methods::$method)])+
        pub fn each_method(#[case] method: M) {}
    };
}
pendula::for_each_method!(template);

/// The same for those that suit other systems than the pendulum.
macro_rules! general_template {
    ($($module:ident::$method:ident,)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$module(pendula::methods::$method)])+
        pub fn each_general_method(#[case] method: M) {}
    };
}
pendula::for_each_general_method!(general_template);

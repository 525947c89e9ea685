//! Shared by the tests: the zoo of wrong methods as rstest cases.

/// Makes an rstest template of the zoo's list, by name.
macro_rules! zoo_template {
    ($($name:ident: $impostor:expr, $truth:expr, [$($caught_by:ident),+];)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$name(stringify!($name))])+
        pub fn each_impostor(#[case] name: &str) {}
    };
}
pendula_study::for_each_impostor!(zoo_template);

//! What the tests share: the methods as rstest cases.

/// Makes an rstest template of the library's list of methods, so that a new method is under every test at once.
macro_rules! template {
    ($($module:ident::$method:ident,)+) => {
        #[rstest_reuse::template]
        #[rstest::rstest]
        $(#[case::$module(pendula::methods::$module::$method)])+
        pub fn each_method(#[case] method: M) {}
    };
}
pendula::methods!(template);

//! What a listing of the book prints, so that the output that stands below it is held to it.
//!
//! A listing that prints has two hidden parts: a first line that takes these names, and a last
//! statement with what is printed. The book shows the latter as the listing's output.
//!
//! ```
//! # use pendula_study::listing::{printed, println};
//! println!("{:.3}", 2.0 / 3.0);
//! # assert_eq!(printed(), "\
//! # 0.667
//! # ");
//! ```

use std::cell::RefCell;
use std::fmt::Arguments;

#[doc(inline)]
pub use crate::__println as println;

thread_local! {
    static PRINTED: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Prints a line, and keeps it for [`printed`].
#[doc(hidden)]
#[macro_export]
macro_rules! __println {
    ($($line:tt)*) => { $crate::listing::print(::std::format_args!($($line)*)) };
}

#[doc(hidden)]
pub fn print(line: Arguments<'_>) {
    ::std::println!("{line}");
    PRINTED.with_borrow_mut(|printed| *printed += &format!("{line}\n"));
}

/// The lines that this thread has printed since it was last asked.
pub fn printed() -> String {
    PRINTED.take()
}

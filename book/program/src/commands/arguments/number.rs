//! Numbers on the command line: any way to write one, negative ones too.
//!
//! clap takes what begins with a hyphen for an option, or, if asked, lets pass what it takes for a
//! negative number; it does not know exponents. So every numeric option allows hyphens, and the
//! parser here says what a forgotten value led to.

use std::num::NonZeroU64;
use std::str::FromStr;

/// What a number may be.
pub const NUMBER: &str = "it must be a number without a unit, as 0.01 or 1e-3";

/// A number. Whether it may be infinite or negative is for the library to say.
pub fn number(text: &str) -> Result<f64, String> {
    value(text, NUMBER)
}

/// A count, zero included.
pub fn count(text: &str) -> Result<u64, String> {
    value(text, "it must be a whole number, 0 or greater, below 2^64, in digits")
}

/// A count, at least one.
pub fn positive_count(text: &str) -> Result<NonZeroU64, String> {
    value(text, "it must be a whole number, 1 or greater, below 2^64, in digits")
}

/// The value that `text` stands for; otherwise `allowed`, or that the value was forgotten.
pub fn value<T: FromStr>(text: &str, allowed: &str) -> Result<T, String> {
    text.parse().map_err(|_| refusal(text, allowed))
}

/// Why `text` is no value: because it is not what is `allowed`, or the value was forgotten.
pub fn refusal(text: &str, allowed: &str) -> String {
    forgotten(text)
        .map_or_else(|| allowed.to_owned(), |forgotten| format!("{forgotten}; {allowed}"))
}

/// That a value was forgotten, if `text` is an option: `--dt` or `-h`, and not `-pi/3`.
pub fn forgotten(text: &str) -> Option<String> {
    let is_option = text.starts_with("--")
        || text.strip_prefix('-').is_some_and(|rest| {
            rest.is_empty()
                || rest.len() == 1 && rest.starts_with(|c: char| c.is_ascii_alphabetic())
        });
    is_option.then(|| format!("{text} is an option, and the value before it is missing"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a forgotten value that is not explained, a wrong number that is called an option.
    #[test]
    fn an_option_is_told_from_a_wrong_number() {
        for text in ["--dt", "-h", "--", "-"] {
            assert!(number(text).unwrap_err().contains("is missing"), "{text}");
        }
        for text in ["-1e", "-pix", "-.", ""] {
            assert!(!number(text).unwrap_err().contains("is missing"), "{text}");
        }
        assert!(count("-1").unwrap_err().contains("0 or greater"));
        assert!(positive_count("0").unwrap_err().contains("1 or greater"));
    }
}

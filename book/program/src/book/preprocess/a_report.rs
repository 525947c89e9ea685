//! A report of the judge where a chapter asks for one with `{{a-report}}`: on the function of
//! "Judging an integrator" with the mistake that the chapter makes in it.

use libm::sin;
use pendula_judge::{Claims, FromFn, judge};

use crate::verify::page;

const DIRECTIVE: &str = "{{a-report}}";

/// How many properties are shown: those that fail, and one that holds.
const ROWS: usize = 5;

/// The chapter's text with the report.
pub fn insert(text: &str) -> String {
    if text.contains(DIRECTIVE) { text.replace(DIRECTIVE, &report()) } else { text.to_string() }
}

fn report() -> String {
    let changed = FromFn(|g: f64, mut theta: f64, mut omega: f64, h: f64, n: u64| {
        (0..n).map(move |_| {
            omega -= 0.50001 * h * g * sin(theta);
            theta += h * omega;
            omega -= 0.5 * h * g * sin(theta);
            (theta, omega)
        })
    });
    page::excerpt(&judge(&changed, Claims::order(2).symplectic().symmetric()), ROWS)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a report on the right function, or one whose rows do not begin with what fails; a
    /// blank line, after which Markdown would set the rest as text.
    #[test]
    fn the_report_is_on_the_changed_function() {
        let html = insert("Before\n\n{{a-report}}\n\nAfter");
        assert!(html.contains("Claims fail: equation, order, reversal, loss"), "{html}");
        assert!(html.contains("1.00001 times"), "{html}");
        let html = html.trim_start_matches("Before\n\n").trim_end_matches("\n\nAfter");
        assert!(!html.contains("\n\n") && html.starts_with("<section"), "{html}");
        assert_eq!(html.matches("<tr class=\"alarm\">").count(), ROWS - 1);
        assert_eq!(html.matches("<tr").count(), 1 + ROWS);
    }
}

//! Which term of a step's series is wrong, in words.

use crate::judge::expansion::Deviation;

impl Deviation {
    /// What is wrong, in words: the order condition, the commutator or the term.
    pub fn in_words(&self) -> String {
        let (term, excess, _) = self.worst();
        match (self.is_runge_kutta(), self.commutators(), term.condition) {
            (true, _, Some((sum, exact, times))) => {
                let value = (term.exact + excess) * times;
                format!("{sum} is {}, not {exact}", self.number(value))
            }
            (_, Some(commutators), _) => {
                format!("{commutators} of drifts and kicks do not cancel")
            }
            _ => {
                let of = ["θ", "ω"][term.of];
                let is = self.number(term.exact + excess);
                // Every factor is one over a whole number.
                let exact = match libm::round(1.0 / term.exact) {
                    1.0 => "1".to_string(),
                    whole => format!("1/{whole}"),
                };
                format!("in {of} the term {} has the factor {is}, not {exact}", term.name)
            }
        }
    }

    /// A factor to as many digits as it is known, at most ten after the point.
    fn number(&self, value: f64) -> String {
        let digits = (-libm::log10(self.known_to)).clamp(2.0, 10.0) as usize;
        let text = format!("{value:.digits$}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" { "0".to_string() } else { text.replace('-', "−") }
    }
}

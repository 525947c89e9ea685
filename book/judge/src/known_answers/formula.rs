//! Formulas as `right-hand-sides.json` has them, which Python reads too.

/// Numbers by their names.
pub(super) type Names = Vec<(String, f64)>;

/// What a formula says, line by line: these results.
///
/// # Panics
/// At what is no formula: all that there are come with this crate.
pub(super) fn evaluate<L: AsRef<str>>(lines: &[L], inputs: &Names, results: &[String]) -> Vec<f64> {
    let mut names = inputs.clone();
    for line in lines {
        let line = line.as_ref();
        let (name, expression) = line.split_once(" = ").expect("name = expression");
        let mut reader = Reader { rest: expression, names: &names };
        let value = reader.sum();
        assert!(reader.rest.is_empty(), "{line}: what is {:?}?", reader.rest);
        names.push((name.to_string(), value));
    }
    results.iter().map(|name| number(&names, name)).collect()
}

fn number(names: &Names, name: &str) -> f64 {
    // The last of this name: a line may say anew what another has said.
    let found = names.iter().rev().find(|(other, _)| other == name);
    found.unwrap_or_else(|| panic!("no {name} among {names:?}")).1
}

/// A parser of Python's arithmetic by recursive descent, which computes as it reads.
struct Reader<'a> {
    rest: &'a str,
    names: &'a Names,
}

impl<'a> Reader<'a> {
    fn take(&mut self, sign: &str) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// The letters, digits and so on that come next.
    fn word(&mut self, belongs: impl Fn(char) -> bool) -> &'a str {
        self.rest = self.rest.trim_start();
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    fn sum(&mut self) -> f64 {
        let mut sum = self.product();
        loop {
            if self.take("+") {
                sum += self.product();
            } else if self.take("-") {
                sum -= self.product();
            } else {
                return sum;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut product = self.signed();
        loop {
            if self.take("*") {
                product *= self.signed();
            } else if self.take("/") {
                product /= self.signed();
            } else {
                return product;
            }
        }
    }

    /// −x² is −(x²).
    fn signed(&mut self) -> f64 {
        if self.take("-") { -self.signed() } else { self.power() }
    }

    fn power(&mut self) -> f64 {
        let base = self.atom();
        if self.take("**") { libm::pow(base, self.signed()) } else { base }
    }

    fn atom(&mut self) -> f64 {
        if self.take("(") {
            let inside = self.sum();
            assert!(self.take(")"), "a bracket is open before {:?}", self.rest);
            return inside;
        }
        let digits = self.word(|c| c.is_ascii_digit() || c == '.');
        if !digits.is_empty() {
            return digits.parse().expect("digits");
        }
        let name = self.word(|c| c.is_ascii_alphanumeric() || c == '_');
        if !self.rest.starts_with('(') {
            return if name == "pi" { std::f64::consts::PI } else { number(self.names, name) };
        }
        let inside = self.atom();
        match name {
            "sin" => libm::sin(inside),
            "cos" => libm::cos(inside),
            "sqrt" => libm::sqrt(inside),
            "radians" => inside.to_radians(),
            "degrees" => inside.to_degrees(),
            _ => panic!("no function {name:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values are Python's.
    ///
    /// Catches: a product before a power, a sign before a power, a difference or a quotient from
    /// the right; a line that does not see those before it.
    #[test]
    fn formulas_are_read_as_python_reads_them() {
        let inputs = [("x", 0.75), ("l1", -2.0)].map(|(name, x)| (name.to_string(), x)).to_vec();
        let value = |lines: &[&str]| evaluate(lines, &inputs, &["y".to_string()])[0];
        for (formula, expected) in [
            ("y = -x**2", -0.5625),
            ("y = 2**3**2", 512.0),
            ("y = 2**-1*x", 0.375),
            ("y = 8/4/2 - 3 - 2", -4.0),
            ("y = 8/(4/2) - (3 - 2)", 3.0),
            ("y = 1 - -l1 * x + -x", -1.25),
            ("y = 32.5/(-l1)**2", 8.125),
            ("y = 2*cos(0*x)*sqrt(-l1*8)", 8.0),
            ("y = sin(x - 0.75)", 0.0),
            ("y = degrees(pi)/radians(180)*pi", 180.0),
        ] {
            assert_eq!(value(&[formula]), expected, "{formula}");
        }
        assert_eq!(value(&["y = x + 1", "z = y*2", "y = z"]), 3.5);
    }

    /// Catches: a formula of which a part is left out.
    #[test]
    #[should_panic(expected = "what is \")\"?")]
    fn what_is_no_formula_is_refused() {
        evaluate(&["y = (1 + 2))"], &Names::new(), &["y".to_string()]);
    }
}

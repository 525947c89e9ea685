//! One chapter: its directives and its formulas.
//!
//! | directive | becomes |
//! |---|---|
//! | `{{measured ID}}` | the value as the library measures it |
//! | `{{stated ID}}` | the value as the paper prints it |
//! | `{{verdict ID}}` | what comparing the two came to, with a link to its row of the ledger |
//! | `{{test file::function}}` | a link to that test's source in the book, which says what wrong code it catches |
//! | `{{work-precision}}` | the figure that `pendula bench` made, or a line on how to make it |
//! | `{{verdicts}}` | how many claims got which verdict; see [`claims`](super::claims) |
//! | `doi:…` | a link to the work |
//!
//! A formula takes no value. The first quote of a claim has its id, so that its row of the ledger
//! can link back. A block of code marked `question` becomes a form, as [`questions`] says, and what
//! is right stands at the end of the chapter, for paper. Other code blocks are shown as [`listing`]
//! says; code spans do not change, but for a word with a hyphen, which is kept whole.

use std::collections::BTreeSet;
use std::ops::Range;

use anyhow::{Context, Result, bail, ensure};

use super::listing;
use super::markdown::{Kind, held_after, passages, splice};
use super::questions;
use super::sources::Tests;
use super::typeset::{Maths, inert, value};
use crate::book::ledger::Ledger;
use crate::book::{Pattern, pattern};

/// The longest formula (bytes of TeX) that is kept on one line with what holds on to it.
const HELD: usize = 24;

/// What a chapter may refer to.
pub struct Setter<'a> {
    ledger: &'a dyn Ledger,
    tests: &'a Tests,
    /// The replacement of `{{work-precision}}`.
    work_precision: String,
    maths: Maths,
}

impl<'a> Setter<'a> {
    /// A setter for chapters that refer to these values and tests, and to this figure.
    pub fn new(ledger: &'a dyn Ledger, tests: &'a Tests, work_precision: String) -> Self {
        Self { ledger, tests, work_precision, maths: Maths::default() }
    }

    /// The chapter's text with directives and formulas replaced; `to_root` is the relative path
    /// from its page to the root of the book. `quoted` gets the ids of the claims that it quotes.
    pub fn set(&self, text: &str, to_root: &str, quoted: &mut BTreeSet<String>) -> Result<String> {
        let mut page =
            Page { setter: self, text, to_root, quoted, edits: Vec::new(), answers: String::new() };
        page.set()?;
        let (edits, answers) = (page.edits, page.answers);
        let mut set = splice(text, edits);
        if !answers.is_empty() {
            set += &format!(
                "\n\n<div class=\"answers\">\n<p>Answers to the questions</p>\n\
                 <ol>\n{answers}</ol>\n</div>\n"
            );
        }
        Ok(set)
    }
}

/// A chapter that is being set.
struct Page<'a> {
    setter: &'a Setter<'a>,
    text: &'a str,
    to_root: &'a str,
    /// The ids of the claims that it has quoted so far.
    quoted: &'a mut BTreeSet<String>,
    /// What is replaced, in order.
    edits: Vec<(Range<usize>, String)>,
    /// The right answers to its questions, as items of a list.
    answers: String,
}

impl Page<'_> {
    fn set(&mut self) -> Result<()> {
        let text = self.text;
        let mut done = 0;
        for (range, kind) in passages(text) {
            // A formula has taken it along.
            if range.start < done {
                continue;
            }
            self.set_prose(done..range.start)?;
            done = range.end;
            let source = &text[range.clone()];
            match kind {
                Kind::Code if source.starts_with(questions::FENCE) => {
                    let question = self.question(source)?;
                    self.answers += &question.answer;
                    self.edits.push((range, question.form));
                }
                Kind::Code => {
                    let shown = listing::shown(source).or_else(|| with_whole_options(source));
                    self.edits.extend(shown.map(|shown| (range, shown)));
                }
                Kind::Formula { tex, display } => {
                    // In TeX `{{a}}` is a group in a group.
                    let dense = tex.replace(char::is_whitespace, "");
                    let mut values = ["{{measured", "{{stated", "{{verdict"].iter();
                    let has_value = values.any(|value| dense.contains(value));
                    ensure!(!has_value, "{tex}: a formula takes no value; set it beside");
                    let html = self.setter.maths.set(&tex, display)?;
                    let after = &text[done..];
                    let mark = after.starts_with([',', '.', ';', ':', '!', '?', ')']);
                    let held = if mark { Some(&after[..1]) } else { held_after(after) };
                    self.edits.push(match held {
                        // A browser may break a line after any formula, even before a comma or a
                        // no-break space. A long one must stay breakable: there its last part holds
                        // what follows.
                        Some(held) if !display => {
                            done += held.len();
                            let held = inert(held).replace(' ', "&nbsp;");
                            let held = if tex.len() <= HELD {
                                format!("<span class=\"held\">{html}{held}</span>")
                            } else {
                                with_mark(&html, &held).with_context(|| tex.to_string())?
                            };
                            (range.start..done, held)
                        }
                        _ => (range, html),
                    });
                }
                Kind::Exponent => self.edits.push((range, value(source))),
                Kind::Gap => self.edits.push((range, "&nbsp;".to_string())),
                Kind::StrayDollar => {
                    let line = text[..done].lines().last().unwrap_or_default();
                    bail!("{line}: this dollar sign begins no formula; the sign itself is \\$");
                }
            }
        }
        self.set_prose(done..text.len())
    }

    /// Replaces directives and DOIs, each of these without the punctuation after it.
    fn set_prose(&mut self, range: Range<usize>) -> Result<()> {
        static NOTABLE: Pattern = Pattern::new(|| {
            pattern(r"\{\{(?s:(?<directive>.*?))\}\}|(?<doi>doi:10\.[^\s{]*)|\{\{.{0,38}")
        });
        // A nested footnote or the like may begin before the last passage ended.
        let Some(prose) = self.text.get(range.clone()) else { return Ok(()) };
        for found in NOTABLE.captures_iter(prose) {
            let (mut source, start) = (&found[0], found.get_match().start());
            let html = if let Some(inside) = found.name("directive") {
                let html = self.directive(inside.as_str().trim());
                html.with_context(|| source.to_string())?
            } else {
                ensure!(
                    found.name("doi").is_some(),
                    "{source}: a directive without its closing braces"
                );
                source = source.trim_end_matches(['.', ',', ';', ':']);
                let address = inert(&source.replacen("doi:", "https://doi.org/", 1));
                format!("<a href=\"{address}\">{}</a>", inert(source))
            };
            let start = range.start + start;
            self.edits.push((start..start + source.len(), html));
        }
        Ok(())
    }

    fn question(&mut self, block: &str) -> Result<questions::Set> {
        let (setter, to_root) = (self.setter, self.to_root);
        let set = |text: &str| setter.set(text, to_root, self.quoted);
        questions::set(block, |id| setter.ledger.truth(id), set)
    }

    fn directive(&mut self, inside: &str) -> Result<String> {
        let (name, argument) = inside.split_once(char::is_whitespace).unwrap_or((inside, ""));
        let argument = argument.trim();
        Ok(match name {
            "measured" | "stated" | "verdict" => self.value(name, argument)?,
            "test" => self.link(argument)?,
            "work-precision" => self.setter.work_precision.clone(),
            // It waits until every chapter has been searched for quotes.
            "verdicts" => "{{verdicts}}".to_string(),
            _ => bail!(
                "no such directive; there are measured, stated, verdict, test, work-precision \
                 and verdicts"
            ),
        })
    }

    /// A value of the ledger. The first quote of a claim in its chapter has its id.
    fn value(&mut self, name: &str, claim: &str) -> Result<String> {
        let entry = self.setter.ledger.entry(claim);
        let entry = entry.with_context(|| format!("the ledger has no claim {claim}"))?;
        let said = match name {
            "measured" => entry.measured,
            "stated" => entry.stated,
            _ => entry.verdict,
        };
        let said = said.with_context(|| format!("the ledger has no {name} value for {claim}"))?;
        let value = value(&said);
        let is_first = self.quoted.insert(claim.to_string());
        let id = if is_first { format!(" id=\"{claim}\"") } else { String::new() };
        Ok(match name {
            "verdict" => {
                let row = format!("{}appendix-claims.html#{claim}", self.to_root);
                format!("<a class=\"verdict\"{id} href=\"{row}\">{value}</a>")
            }
            _ => format!("<span class=\"{name}\"{id}>{value}</span>"),
        })
    }

    fn link(&self, cited: &str) -> Result<String> {
        let (file, test) = self.setter.tests.find(cited)?;
        // A reader follows the link to learn that.
        ensure!(test.says_what_it_catches, "the documentation of {cited} has no line `Catches:`");
        let (file, test, to_root) = (&file.name, &test.name, self.to_root);
        // As `cargo test` prints it and accepts it as a filter: without the name of the test
        // program.
        let path = file.split_once('/').map_or(&file[..], |(_, path)| path);
        let text = inert(&format!("{}::{test}", path.replace('/', "::")));
        // Long names may break only after an underscore.
        let text = text.replace("&#95;", "&#95;<wbr>");
        // HTML, not Markdown, so that it also works in a figure's caption.
        Ok(format!("<a href=\"{to_root}tests/{file}.html#{test}\"><code>{text}</code></a>"))
    }
}

/// The code span as HTML in which no line ends after a hyphen of an option such as `--every`, or
/// before the bracket of `#[case`; none if there is no such word in it.
fn with_whole_options(code: &str) -> Option<String> {
    /// A longer word must stay breakable on a phone.
    const WHOLE: usize = 24;
    let inner = code.strip_prefix('`')?.strip_suffix('`')?;
    if inner.contains('`') {
        return None;
    }
    let set = |word: &str| match inert(word) {
        html if word.contains(['-', '[']) && (2..=WHOLE).contains(&word.len()) => {
            format!("<span class=\"held\">{html}</span>")
        }
        html => html,
    };
    let html = inner.split_whitespace().map(set).collect::<Vec<_>>().join(" ");
    html.contains("<span").then(|| format!("<code>{html}</code>"))
}

/// A formula with a mark after it that no line begins with: on the screen it stands in the formula,
/// next to its last part.
fn with_mark(html: &str, mark: &str) -> Option<String> {
    // The end of that part, of the formula on the screen, and of both its forms.
    const ENDS: &str = "</span></span></span>";
    let at = html.rfind("<span class=\"katex-base\">")?;
    let part = html[at..].strip_suffix(ENDS)?;
    Some(format!("{}<span class=\"held\">{part}</span>{mark}{ENDS}", &html[..at]))
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::super::typeset::tests::shown;
    use super::*;
    use crate::book::ledger::Entry;

    fn ledger(id: &str) -> Option<Entry> {
        let value = |text: &str| Some(text.to_string());
        match id {
            "T4.rk4.0.01" => Some(Entry {
                stated: value("2.01e-4"),
                measured: value("3e-4"),
                verdict: value("wrong"),
            }),
            "T9.only" => Some(Entry { verdict: value("not checkable"), ..Entry::default() }),
            _ => None,
        }
    }

    fn set(text: &str) -> Result<String> {
        let source = "/// Catches: a.\n#[test]\nfn every_slope() {}\n";
        let tests = Tests::from_sources([("order", source)]).unwrap();
        let setter = Setter::new(&ledger, &tests, "<figure>".to_string());
        setter.set(text, "../", &mut BTreeSet::new())
    }

    /// Catches: the stated value in place of the measured one, and the other way round; a link that
    /// ignores how deep the page lies; a figure left out, or in the wrong place; directives
    /// replaced in a page that explains them; a line that ends in the middle of `--test`, and a
    /// word held that is too long for a phone; a DOI that is no link, or whose link takes the full
    /// stop or the directive after it along, and so leads nowhere; what stands before a directive
    /// lost.
    #[rstest]
    #[case(
        "{{stated T4.rk4.0.01}}, {{ measured T4.rk4.0.01 }}, {{verdict T4.rk4.0.01}}",
        "<span class=\"stated\" id=\"T4.rk4.0.01\">2.01~×~10<sup>−4</sup></span>, \
         <span class=\"measured\">3~×~10<sup>−4</sup></span>, \
         <a class=\"verdict\" href=\"../appendix-claims.html#T4.rk4.0.01\">wrong</a>"
    )]
    #[case(
        "{{test order::every_slope}}",
        "<a href=\"../tests/order.html#every_slope\"><code>order::every_<wbr>slope</code></a>"
    )]
    #[case("a\n\n{{work-precision}}\n\nb\n", "a\n\n<figure>\n\nb\n")]
    #[case("`{{stated nothing}}`", "`{{stated nothing}}`")]
    #[case("```text\n{{test nothing}} $x$\n```\n", "```text\n{{test nothing}} $x$\n```\n")]
    #[case(
        "`cargo test --test\nstudy -- x`",
        "<code>cargo test <span class=\"held\">--test</span> study \
         <span class=\"held\">--</span> x</code>"
    )]
    #[case("`#[case`", "<code><span class=\"held\">#[case</span></code>")]
    #[case("`a - b`", "`a - b`")]
    #[case("`a-very-long-name-with-many-hyphens.rs`", "`a-very-long-name-with-many-hyphens.rs`")]
    #[case("`` a--b ` ``", "`` a--b ` ``")]
    #[case(
        "*Physica D* 43. doi:10.1/2(90)90-L. And `doi:10.1/x`.",
        "*Physica D* 43. <a href=\"https://doi.org/10.1/2(90)90-L\">doi:10.1/2(90)90-L</a>. And \
         `doi:10.1/x`."
    )]
    #[case(
        "doi:10.1/x{{stated T4.rk4.0.01}}, doi:10.2/y.",
        "<a href=\"https://doi.org/10.1/x\">doi:10.1/x</a><span class=\"stated\" \
         id=\"T4.rk4.0.01\">2.01~×~10<sup>−4</sup></span>, \
         <a href=\"https://doi.org/10.2/y\">doi:10.2/y</a>."
    )]
    #[case("{{work-precision doi:10.1/x}}", "<figure>")]
    fn what_is_typed_becomes(#[case] typed: &str, #[case] expected: &str) {
        assert_eq!(shown(&set(typed).unwrap()).replace('\u{a0}', "~"), expected);
    }

    /// Catches: a link to a test that does not say what wrong code it catches.
    #[test]
    fn a_cited_test_says_what_it_catches() {
        let source = "/// Does it.\n///\n/// Catches: one thing.\n#[test]\nfn a() {}\n\
                      #[test]\nfn b() {}\n";
        let tests = Tests::from_sources([("x", source)]).unwrap();
        let set = |text: &str| {
            Setter::new(&ledger, &tests, String::new()).set(text, "", &mut BTreeSet::new())
        };
        assert!(set("{{test x::a}}").unwrap().contains("x.html#a"));
        assert!(format!("{:#}", set("{{test x::b}}").unwrap_err()).contains("Catches:"));
    }

    /// Catches: a comma alone at the beginning of a line; a word kept on one line with the formula
    /// before it.
    #[test]
    fn a_formula_keeps_its_punctuation() {
        let held = |text: &str| set(text).unwrap().matches("<span class=\"held\">").count();
        assert_eq!(held("by $h$, or ($x$) and $y$."), 3);
        assert_eq!(held("by $h$ or\n\n$$x$$, say"), 0);
        assert!(set("by $h$ rad, or").unwrap().ends_with("&nbsp;rad</span>, or"));
        assert!(set("at $h$\n= 1 s or").unwrap().ends_with("&nbsp;&#61;&nbsp;1&nbsp;s</span> or"));
        // A long one by its last part alone.
        let long = set(r"$\theta_{n+1} = \theta_n + h\,\omega_n$, or").unwrap();
        let (before, last) =
            long.split_once("<span class=\"held\"><span class=\"katex-base\">").unwrap();
        assert!(before.contains("katex-base") && !last.contains("katex-base"), "{long}");
        assert!(last.contains("</span>&#44;</span></span></span> or"), "{long}");
        assert!(
            set("by $h$, or").unwrap().ends_with("&#44;</span> or")
                || set("by $h$, or").unwrap().ends_with(",</span> or")
        );
    }

    /// Catches: a misspelt id or name that leaves a gap, or the raw directive, in the book.
    #[test]
    fn what_is_unknown_stops_the_build_and_is_quoted() {
        for (text, quoted) in [
            ("{{stated T4.rk5}}", "T4.rk5"),
            ("{{measured T9.only}}", "no measured value"),
            ("{{mesured T4.rk4.0.01}}", "mesured"),
            ("{{test order::no_such}}", "order::no_such"),
            ("{{test ordre::every_slope}}", "ordre::every_slope"),
            ("{{stated T4.rk4.0.01", "closing"),
            ("as $\\frac{1$", "as $"),
            ("$\\sqrt{1}$ or $\\fraq{1}$", "\\fraq{1}"),
            ("$x^{{a}} = {{ stated T4.rk4.0.01 }}$", "a formula takes no value"),
        ] {
            let error = format!("{:#}", set(text).unwrap_err());
            assert!(error.contains(quoted), "{text}: {error}");
        }
    }
}

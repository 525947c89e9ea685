//! A chapter's questions: a block of code marked `question`, in TOML, becomes a form.
//!
//! ```toml
//! id = "rk4-energy"
//! ask = "Half the step, twice as many steps: by what factor does the loss of energy fall?"
//! fold = true                      # what shows the answer is folded until the reader has answered
//!
//! [[choice]]                       # which of these? Readers believe each of them.
//! is = "16"
//! text = "16"
//! because = "The error of the *state* is of order 4; the energy's is not."
//!
//! [number]                         # or: how much?
//! unit = "s"
//! because = "…"
//! mistake = [{ is = "half-step", because = "…" }]
//!
//! [[item]]                         # or: in which order?
//! is = "rk4"
//! text = "RK4"
//! [[pair]]                         # what is wrong with this one before that one
//! before = "verlet"
//! after = "rk4"
//! because = "…"
//! ```
//!
//! What is right is not written here: the study computes it, by the question's id, and so it does
//! the numbers of the mistakes, and how near to the right number an answer has to be. A question
//! that does not have exactly one right answer stops the build. Without scripts its answer is
//! folded below it; on paper the answers stand at the end of the chapter.
//!
//! With `fold`, what follows the question and shows its answer is folded until the reader has
//! answered or asks for it: from the first output, figure or table below it, up to the heading or
//! question after that. Without scripts and on paper nothing of it is folded.

use std::fmt::Write;

use anyhow::{Context, Result, bail, ensure};
use pendula_study::questions::{MISTAKEN, Truth, Within};
use pulldown_cmark::Parser;
use pulldown_cmark::html::push_html;
use serde::Deserialize;

use super::markdown::options;
use super::typeset::{inert, value};

/// What the first line of a question's block is.
pub const FENCE: &str = "```question\n";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    id: String,
    ask: String,
    /// Whether what shows the answer below the question is folded until it is answered.
    #[serde(default)]
    fold: bool,
    /// Why the right order is right.
    because: Option<String>,
    /// In the exam: what to read again.
    again: Option<String>,
    #[serde(default)]
    choice: Vec<Choice>,
    number: Option<Number>,
    #[serde(default)]
    item: Vec<Item>,
    #[serde(default)]
    pair: Vec<Pair>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    is: String,
    text: String,
    because: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Number {
    unit: String,
    because: String,
    #[serde(default)]
    mistake: Vec<Mistake>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Mistake {
    is: String,
    because: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Item {
    is: String,
    text: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pair {
    before: String,
    after: String,
    because: String,
}

/// A question as its page has it.
pub struct Set {
    /// The form, with its answer folded.
    pub form: String,
    /// The right answer, for the list at the end of the chapter on paper.
    pub answer: String,
}

/// The question in the block, of which `truth` tells what is right; `set` replaces the directives
/// and formulas of a text.
pub fn set(
    block: &str,
    truth: impl Fn(&str) -> Option<Truth>,
    mut set: impl FnMut(&str) -> Result<String>,
) -> Result<Set> {
    let source = block.strip_prefix(FENCE).and_then(|block| block.trim_end().strip_suffix("```"));
    let question: Question = toml::from_str(source.context("a question's block has no end")?)
        .context("a question that cannot be read")?;
    let id = &question.id;
    let truth = truth(id).with_context(|| format!("the study does not know the question {id}"))?;
    let mut inline = |text: &str| -> Result<String> {
        let mut html = String::new();
        push_html(&mut html, Parser::new_ext(&set(text)?, options()));
        let html = html.trim().replace(".md\"", ".html\"").replace(".md#", ".html#");
        let inner = html.strip_prefix("<p>").and_then(|html| html.strip_suffix("</p>"));
        let inner = inner.filter(|inner| !inner.contains("<p>"));
        let inner = inner.with_context(|| format!("{text}: more than one paragraph"))?;
        // A blank line would end the block of HTML in Markdown.
        Ok(inner
            .split('\n')
            .map(str::trim)
            .filter(|line| !line.is_empty())
            .collect::<Vec<_>>()
            .join(" "))
    };
    let parts =
        question.parts(&truth, &mut inline).with_context(|| format!("the question {id}"))?;
    let (ask, kind) = (inline(&question.ask)?, parts.kind);
    let again = match &question.again {
        Some(again) => format!("<p class=\"again\">{}</p>\n", inline(again)?),
        None => String::new(),
    };
    let fold = if question.fold { " data-fold" } else { "" };
    let form = format!(
        "<fieldset class=\"question\" id=\"question-{id}\" data-kind=\"{kind}\"{fold}>\n\
         <legend>{ask}</legend>\n{}<details class=\"answer\">\n<summary>Answer</summary>\n\
         <ul>\n{}{}</ul>\n{again}</details>\n</fieldset>\n",
        parts.controls, parts.right, parts.wrong,
    );
    Ok(Set { form, answer: parts.right })
}

/// What a form consists of, as HTML.
#[derive(Default)]
struct Parts {
    kind: &'static str,
    controls: String,
    /// The item of the list of answers that is right, and the others.
    right: String,
    wrong: String,
}

impl Question {
    fn parts(
        &self,
        truth: &Truth,
        inline: &mut impl FnMut(&str) -> Result<String>,
    ) -> Result<Parts> {
        let kinds = [!self.choice.is_empty(), self.number.is_some(), !self.item.is_empty()];
        ensure!(
            kinds.iter().filter(|is| **is).count() == 1,
            "it has to have choices, or a number, or items"
        );
        match (truth, &self.number) {
            (Truth::Which(truth), None) if kinds[0] => self.which(truth, inline),
            (Truth::Number { right, within, mistakes }, Some(number)) => {
                self.how_much(number, (*right, *within), mistakes, inline)
            }
            (Truth::Order(order), None) if kinds[2] => self.in_order(order, inline),
            _ => bail!("the study answers a question of another kind"),
        }
    }

    fn which(
        &self,
        truth: &[(&str, bool)],
        inline: &mut impl FnMut(&str) -> Result<String>,
    ) -> Result<Parts> {
        same(truth.iter().map(|(name, _)| *name), self.choice.iter().map(|choice| &choice.is[..]))?;
        let right: Vec<&str> =
            truth.iter().filter(|(_, is_right)| *is_right).map(|(name, _)| *name).collect();
        let [right] = right[..] else { bail!("right are {right:?}, and not one choice alone") };
        let mut parts = Parts { kind: "which", ..Parts::default() };
        for Choice { is, text, because } in &self.choice {
            let (id, text, because) = (&self.id, inline(text)?, inline(because)?);
            let value = inert(is);
            writeln!(
                parts.controls,
                "<label><input type=\"radio\" name=\"{id}\" value=\"{value}\"> \
                 <span>{text}</span></label>"
            )?;
            let answer = |mark: &str| {
                format!(
                    "<li data-is=\"{value}\"{mark}><strong>{text}</strong> \
                     <span class=\"because\">{because}</span></li>\n"
                )
            };
            match is == right {
                true => parts.right = answer(" data-right"),
                false => parts.wrong += &answer(""),
            }
        }
        Ok(parts)
    }

    fn how_much(
        &self,
        number: &Number,
        (right, within): (f64, Within),
        mistakes: &[(&str, f64)],
        inline: &mut impl FnMut(&str) -> Result<String>,
    ) -> Result<Parts> {
        let (id, unit, counts) = (&self.id, inline(&number.unit)?, inert(&within.said()));
        ensure!(right > 0.0, "{right} has no positive ratio to an answer");
        same(
            mistakes.iter().map(|(name, _)| *name),
            number.mistake.iter().map(|mistake| &mistake.is[..]),
        )?;
        let mut ranges = vec![("right", within.range(right))];
        let mut parts = Parts { kind: "number", ..Parts::default() };
        parts.controls = format!(
            "<label><input type=\"text\" inputmode=\"decimal\" autocomplete=\"off\" size=\"9\" \
             name=\"{id}\"> {unit} <span class=\"counts\">({counts})</span></label>\n"
        );
        let mut answer = |value: f64, within: Within, mark: &str, why: &str| -> Result<String> {
            let ([low, high], why) = (within.range(value), inline(why)?);
            let shown = match within {
                Within::Count(_) => format!("{value}"),
                Within::Percent(_) => rounded(value),
            };
            Ok(format!(
                "<li data-low=\"{low}\" data-high=\"{high}\"{mark}>\
                 <strong>{shown} {unit}.</strong> \
                 <span class=\"because\">{why}</span></li>\n"
            ))
        };
        parts.right = answer(right, within, " data-right", &number.because)?;
        for &(name, value) in mistakes {
            ensure!(value > 0.0, "the mistake {name} gives {value}");
            let because = number.mistake.iter().find(|mistake| mistake.is == name);
            let because = &because.context("no such mistake")?.because;
            parts.wrong += &answer(value, MISTAKEN, "", because)?;
            ranges.push((name, MISTAKEN.range(value)));
        }
        ranges.sort_by(|(_, one), (_, other)| one[0].total_cmp(&other[0]));
        for pair in ranges.windows(2) {
            let [(one, [_, high]), (other, [low, _])] = pair else { unreachable!("two of them") };
            ensure!(high < low, "the numbers {one} and {other} are within the tolerance");
        }
        Ok(parts)
    }

    fn in_order(
        &self,
        order: &[&str],
        inline: &mut impl FnMut(&str) -> Result<String>,
    ) -> Result<Parts> {
        same(order.iter().copied(), self.item.iter().map(|item| &item.is[..]))?;
        let because = self.because.as_ref().context("it does not say why the order is right")?;
        let place = |name: &str| order.iter().position(|item| *item == name);
        let mut parts = Parts { kind: "order", ..Parts::default() };
        let mut texts = Vec::new();
        for Item { is, text } in &self.item {
            let (value, text) = (inert(is), inline(text)?);
            let places: String =
                (1..=order.len()).map(|n| format!("<option>{n}</option>")).collect();
            writeln!(
                parts.controls,
                "<label><select name=\"{value}\"><option></option>{places}</select> \
                 <span>{text}</span></label>"
            )?;
            texts.push((place(is), text));
        }
        texts.sort();
        let texts: Vec<_> = texts.into_iter().map(|(_, text)| text).collect();
        let (inert_order, because) = (inert(&order.join(" ")), inline(because)?);
        parts.right = format!(
            "<li data-order=\"{inert_order}\" data-right><strong>{}.</strong> \
             <span class=\"because\">{because}</span></li>\n",
            texts.join(", ")
        );
        for Pair { before, after, because } in &self.pair {
            let [Some(first), Some(second)] = [place(before), place(after)] else {
                bail!("the pair {before}, {after} has other items");
            };
            ensure!(
                first > second,
                "{before} stands before {after}, and nothing is wrong with that"
            );
            let (before, after, because) = (inert(before), inert(after), inline(because)?);
            writeln!(
                parts.wrong,
                "<li data-before=\"{before}\" data-after=\"{after}\">\
                 <span class=\"because\">{because}</span></li>"
            )?;
        }
        // Whoever has each item after its neighbour has them all in order.
        for pair in order.windows(2) {
            let is_told = |known: &Pair| known.before == pair[1] && known.after == pair[0];
            ensure!(self.pair.iter().any(is_told), "no pair for {} before {}", pair[1], pair[0]);
        }
        Ok(parts)
    }
}

/// Whether the study and the chapter speak of the same answers.
fn same<'a>(
    computed: impl Iterator<Item = &'a str>,
    written: impl Iterator<Item = &'a str>,
) -> Result<()> {
    let sorted = |names: &mut Vec<&'a str>| names.sort_unstable();
    let (mut computed, mut written): (Vec<_>, Vec<_>) = (computed.collect(), written.collect());
    sorted(&mut computed);
    sorted(&mut written);
    ensure!(computed == written, "the study computes {computed:?}, the chapter has {written:?}");
    Ok(())
}

/// The number in three digits.
fn rounded(number: f64) -> String {
    let digits = 2 - number.abs().log10().floor() as i32;
    if !(-3..=6).contains(&digits) {
        return value(&format!("{number:.2e}"));
    }
    let scale = 10f64.powi(digits);
    value(&format!("{:.*}", digits.max(0) as usize, (number * scale).round() / scale))
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::super::typeset::tests::shown;
    use super::*;

    fn number(right: f64, within: Within, twice: f64) -> Truth {
        Truth::Number { right, within, mistakes: vec![("twice", twice)] }
    }

    fn truth(id: &str) -> Option<Truth> {
        Some(match id {
            "which" => Truth::Which(vec![("a", false), ("b", true)]),
            "both" => Truth::Which(vec![("a", true), ("b", true)]),
            "none" => Truth::Which(vec![("a", false), ("b", false)]),
            "number" => number(0.25, Within::Percent(2.0), 0.5),
            "count" => number(1001.0, Within::Count(1), 2000.0),
            "near" => number(0.25, Within::Percent(2.0), 0.28),
            "order" => Truth::Order(vec!["x", "y", "z"]),
            _ => return None,
        })
    }

    fn form(toml: &str) -> Result<Set> {
        let block = format!("{FENCE}{toml}```\n");
        set(&block, truth, |text| Ok(text.replace("{{five}}", "5")))
    }

    const CHOICES: &str = "ask = \"*Which* of {{five}}?\"\n\
        [[choice]]\nis = \"a\"\ntext = \"`a`\"\nbecause = \"No: [why](rk4.md#why).\"\n\
        [[choice]]\nis = \"b\"\ntext = \"b\"\nbecause = \"Yes.\"\n";
    const NUMBER: &str = "ask = \"How much?\"\n[number]\nunit = \"s\"\n\
        because = \"So.\"\nmistake = [{ is = \"twice\", because = \"Twice.\" }]\n";
    const ORDER: &str = "ask = \"In which order?\"\nbecause = \"By cost.\"\n\
        [[item]]\nis = \"y\"\ntext = \"Y\"\n[[item]]\nis = \"z\"\ntext = \"Z\"\n\
        [[item]]\nis = \"x\"\ntext = \"X\"\n\
        [[pair]]\nbefore = \"y\"\nafter = \"x\"\nbecause = \"Y is dearer.\"\n\
        [[pair]]\nbefore = \"z\"\nafter = \"y\"\nbecause = \"Z is dearest.\"\n";

    /// Catches: an answer marked right that is not; a sentence lost or given to another answer; a
    /// blank line, at which Markdown would go on; a link to a source, which is no page.
    #[test]
    fn what_the_study_computes_is_marked_right() {
        let Set { form, answer } = form(&format!("id = \"which\"\n{CHOICES}")).unwrap();
        assert!(form.contains("<legend><em>Which</em> of 5?</legend>"), "{form}");
        assert!(answer.starts_with("<li data-is=\"b\" data-right>"), "{answer}");
        assert!(form.contains("<li data-is=\"a\"><strong><code>a</code></strong>"), "{form}");
        assert!(form.contains("rk4.html#why") && !form.contains("\n\n"), "{form}");
        assert_eq!(form.matches("data-right").count(), 1);
    }

    /// Catches: a page whose questions are all folded, or none.
    #[test]
    fn what_shows_the_answer_is_folded_where_the_author_says_so() {
        let plain = form(&format!("id = \"which\"\n{CHOICES}")).unwrap().form;
        let folded = form(&format!("id = \"which\"\nfold = true\n{CHOICES}")).unwrap().form;
        assert!(!plain.contains("data-fold") && folded.contains("data-kind=\"which\" data-fold>"));
    }

    /// Catches: a tolerance that is not about the number that was computed, or that the reader is
    /// not told; a count of which digits are left out.
    #[test]
    fn a_number_has_its_range() {
        let Set { form: page, answer } = form(&format!("id = \"number\"\n{NUMBER}")).unwrap();
        assert!(answer.contains("data-low=\"0.245\" data-high=\"0.255"), "{answer}");
        let answer = shown(&answer);
        assert!(answer.contains("0.250 s.") && answer.contains("So."), "{answer}");
        assert!(page.contains("data-low=\"0.45\"") && shown(&page).contains("within 2 % counts"));
        let Set { form: page, answer } = form(&format!("id = \"count\"\n{NUMBER}")).unwrap();
        assert!(answer.contains("data-low=\"1000\" data-high=\"1002\""), "{answer}");
        assert!(shown(&answer).contains("1001 s."), "{answer}");
        assert!(shown(&page).contains("1 more or less counts"), "{page}");
    }

    /// Catches: items in the order in which they are written; a pair without its sentence.
    #[test]
    fn an_order_says_which_pair_is_wrong() {
        let Set { form, answer } = form(&format!("id = \"order\"\n{ORDER}")).unwrap();
        assert!(answer.contains("<strong>X, Y, Z.</strong>"), "{answer}");
        assert!(
            form.contains(
                "<li data-before=\"z\" data-after=\"y\"><span class=\"because\">Z is dearest."
            ),
            "{form}"
        );
    }

    /// Catches: a question that more than one answer is right of, or none; answers, mistakes or
    /// items that only the chapter or only the study knows; numbers that the tolerance cannot tell
    /// apart; a wrong order of which nothing is said.
    #[rstest]
    #[case("both", CHOICES, "not one choice alone")]
    #[case("none", CHOICES, "not one choice alone")]
    #[case("nobody", CHOICES, "does not know the question nobody")]
    #[case("number", CHOICES, "another kind")]
    #[case("near", NUMBER, "within the tolerance")]
    #[case("order", NUMBER, "another kind")]
    #[case("which", "ask = \"?\"\n", "has to have choices")]
    #[case("which", "ask = \"?\"\ncolour = 1\n", "cannot be read")]
    fn what_is_no_question_stops_the_build(
        #[case] id: &str,
        #[case] rest: &str,
        #[case] quoted: &str,
    ) {
        let error = format!("{:#}", form(&format!("id = \"{id}\"\n{rest}")).err().unwrap());
        assert!(error.contains(quoted), "{error}");
    }

    #[rstest]
    #[case(CHOICES, "is = \"b\"", "is = \"c\"", "the study computes")]
    #[case(CHOICES, "*Which*", "a\\n\\nb", "more than one paragraph")]
    #[case(NUMBER, "is = \"twice\"", "is = \"thrice\"", "the study computes")]
    #[case(
        ORDER,
        "before = \"y\"\nafter = \"x\"",
        "before = \"x\"\nafter = \"y\"",
        "nothing is wrong"
    )]
    #[case(
        ORDER,
        "before = \"z\"\nafter = \"y\"",
        "before = \"z\"\nafter = \"x\"",
        "no pair for z before y"
    )]
    #[case(ORDER, "because = \"By cost.\"\n", "", "does not say why")]
    fn what_does_not_fit_stops_the_build(
        #[case] question: &str,
        #[case] text: &str,
        #[case] other: &str,
        #[case] quoted: &str,
    ) {
        assert!(question.contains(text));
        let id = [("which", CHOICES), ("number", NUMBER), ("order", ORDER)];
        let (id, _) = id.iter().find(|(_, known)| *known == question).unwrap();
        let changed = question.replacen(text, other, 1);
        let error = format!("{:#}", form(&format!("id = \"{id}\"\n{changed}")).err().unwrap());
        assert!(error.contains(quoted), "{error}");
    }

    /// Catches: digits that no reader asked for, and a number without any.
    #[rstest]
    #[case(1069.7, "1070")]
    #[case(0.0642875, "0.0643")]
    #[case(24.0, "24.0")]
    #[case(240_300.0, "240000")]
    fn numbers_have_three_digits(#[case] number: f64, #[case] expected: &str) {
        assert_eq!(shown(&rounded(number)).replace('\u{a0}', ""), expected);
    }
}

//! What is right in the questions of the book.

use std::collections::BTreeSet;

use pendula_study::questions::{MISTAKEN, Truth, all, truth};

/// Catches: a question with two right answers or none, as the method that it asks about has
/// changed; a mistake that leads to a number that counts as right; two questions of one id.
#[test]
fn each_question_has_one_right_answer() {
    let mut ids = BTreeSet::new();
    for (id, truth) in all() {
        assert!(ids.insert(id), "two questions are called {id}");
        match truth() {
            Truth::Which(choices) => {
                let right = choices.iter().filter(|(_, is_right)| *is_right).count();
                assert_eq!(right, 1, "{id}: {choices:?}");
            }
            Truth::Number { right, within, mistakes } => {
                let [low, high] = within.range(right);
                assert!(0.0 < low && low < right && right < high, "{id}: {low} to {high}");
                for (name, wrong) in mistakes {
                    let [least, most] = MISTAKEN.range(wrong);
                    assert!(most < low || high < least, "{id}: {name} gives {wrong}");
                }
            }
            Truth::Order(items) => assert!(items.len() > 2, "{id}: {items:?}"),
        }
    }
    assert!(ids.len() >= 48, "{} questions", ids.len());
}

/// Catches: a tolerance that refuses an answer for which it was chosen, or takes one that the book
/// elsewhere calls wrong, such as 0.7 s for a step in which Störmer–Verlet still swings.
#[test]
fn what_a_reader_may_have_computed_counts_and_what_is_wrong_does_not() {
    use core::f64::consts::{LN_2, LN_10, PI};
    let answers: [(&str, &[f64], &[f64]); 13] = [
        ("pendulum-longer-rod", &[0.02], &[0.019, 0.021]),
        // With 9.81, π² and 10 m/s² for g; in one digit.
        (
            "forward-euler-doubled",
            &[LN_2 / 0.0981, LN_2 / (0.01 * PI * PI), LN_2 / 0.1, 7.0],
            &[6.5, 7.5],
        ),
        ("symplectic-euler-longer", &[1.0], &[0.95, 1.05]),
        ("stormer-verlet-cost", &[1000.0, 1001.0], &[950.0, 999.0, 1050.0]),
        ("order-change", &[100.0], &[95.0, 105.0]),
        ("small-angle-highest-sample", &[0.5], &[0.45, 0.55]),
        // With the question's two seconds; in two digits. In steps of 0.7 s it explodes.
        ("limits-longest-step", &[2.0 / PI, 0.64], &[0.6, 0.65, 0.7]),
        // With 3.13 and with 3 rad/s for ω₀.
        ("limits-ten-times-nearer", &[LN_10 / 3.13, LN_10 / 3.0], &[0.65, 0.8]),
        // With 9.81 and 10 m/s² for g; in two digits.
        ("friction-and-drives-upright", &[14.1, 14.24, 14.0], &[13.5, 14.8]),
        ("choosing-longer", &[1000.0], &[950.0, 1050.0]),
        // 4⁵ is 1024.
        ("exam-thousand-times", &[3.98, 4.0], &[3.8, 4.1]),
        ("exam-twice-as-high", &[2.0], &[1.9, 2.1]),
        ("exam-allowance", &[100.0], &[95.0, 105.0]),
    ];
    let numbers = all().filter(|(_, truth)| matches!(truth(), Truth::Number { .. }));
    assert!(numbers.map(|(id, _)| id).eq(answers.iter().map(|(id, ..)| *id)), "questions changed");
    for (id, right_ones, wrong_ones) in answers {
        let Some(Truth::Number { right, within, .. }) = truth(id) else { unreachable!("{id}") };
        let [low, high] = within.range(right);
        for answer in right_ones {
            assert!((low..=high).contains(answer), "{id}: {answer} is refused: {low} to {high}");
        }
        for answer in wrong_ones {
            assert!(!(low..=high).contains(answer), "{id}: {answer} counts: {low} to {high}");
        }
    }
}

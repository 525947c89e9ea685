//! What is right in the questions of the book.

use std::collections::BTreeSet;

use pendula_study::questions::{Truth, all};

/// Catches: a question with two right answers or none, as the method that it asks about has
/// changed; a mistake that leads to the right number; two questions of one id.
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
            Truth::Number { right, mistakes } => {
                assert!(right > 0.0, "{id}: {right}");
                for (name, wrong) in mistakes {
                    assert!((wrong / right - 1.0).abs() > 0.1, "{id}: {name} gives {wrong}");
                }
            }
            Truth::Order(items) => assert!(items.len() > 2, "{id}: {items:?}"),
        }
    }
    assert!(ids.len() >= 48, "{} questions", ids.len());
}

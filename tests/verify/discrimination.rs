//! The suite against impostors: each wrong method, and the properties that catch it.
//!
//! Libraries have shipped a symplectic Euler that was forward Euler, a Verlet with wrong
//! coefficients and a fourth-order method that was second, under green tests. Here each of them is
//! run through the same checks that the library's own methods pass, and its case names the checks
//! that it fails. It passes all others, and that is asserted too: so each line also shows which
//! popular check would not have noticed.

use pendula::methods::{ForwardEuler, Rk4};
use pendula_judge::properties::*;
use pendula_judge::zoo::high_order::{EntryOff, TermDropped};
use pendula_judge::zoo::runge_kutta::Tableau;
use pendula_judge::zoo::{euler, impostor_named, processed};
use rstest::rstest;

/// Catches: a check that no longer tells right methods from wrong ones.
fn impostors_are_caught(name: &str) {
    let impostor = impostor_named(name).unwrap();
    assert_eq!(impostor.method.info(), impostor.poses_as, "it claims to be another");
    let objections: Vec<(&str, String)> = PROPERTIES
        .iter()
        .filter_map(|property| Some((property.name, (property.check)(&*impostor.method).err()?)))
        .collect();
    let objecting: Vec<&str> = objections.iter().map(|&(name, _)| name).collect();
    let expected: Vec<&str> = impostor.caught_by.iter().map(|it| it.name).collect();
    assert_eq!(objecting, expected, "{objections:#?}");
}
each_impostor!(impostors_are_caught);

/// Catches: a refusal that does not say which method failed, at what, and what was measured.
#[test]
#[should_panic(expected = "(symplectic-euler), checked for area: A step of x = ω₀h = 1.0 changes")]
fn a_refusal_says_what_was_found() {
    AREA.assert(&*impostor_named("forward_euler_posing_as_symplectic_euler").unwrap().method);
}

/// The series without a dropped term, the table without a wrong entry and the kernels with their
/// own processors have every property: so it is the dropped term, the wrong entry and the wrong
/// processor that are caught.
///
/// Catches: an impostor that is wrong for another reason than the one given.
#[test]
fn impostors_with_nothing_wrong_are_right() {
    for property in PROPERTIES {
        (property.check)(&TermDropped::NONE).expect(property.name);
    }
    let table = EntryOff { row: "step", term: "k9", by: 0.0 };
    for property in PROPERTIES {
        (property.check)(&table).expect(property.name);
    }
    for property in PROPERTIES {
        (property.check)(&processed::RIGHT_4).expect(property.name);
        (property.check)(&processed::RIGHT_6).expect(property.name);
    }
}

/// The pendulum is autonomous, so that none of the properties above depends on the times at which
/// RK4 evaluates its stages. A driven system does.
///
/// Catches: stages at the wrong times, which reduce the order to 1 as soon as the pendulum is
/// driven.
#[rstest]
#[case::all_stages_at_the_start(Tableau { c: [0.0; 4], ..Tableau::RIGHT })]
#[case::middle_stages_at_the_end(Tableau { c: [0.0, 1.0, 1.0, 1.0], ..Tableau::RIGHT })]
#[case::last_stage_in_the_middle(Tableau { c: [0.0, 0.5, 0.5, 0.5], ..Tableau::RIGHT })]
fn wrong_stage_times_are_caught(#[case] impostor: Tableau) {
    driven::check(&Rk4).unwrap();
    driven::check(&impostor).expect_err("stages at the wrong times pass");
    for property in PROPERTIES {
        (property.check)(&impostor).expect("the pendulum cannot see them");
    }
}

/// Forward Euler with the force at the time of the step's end is of order 1 on a driven system,
/// too: only the exact sum of its steps distinguishes it from the right one.
///
/// Catches: a check of the times at which Euler's methods evaluate the force that no longer
/// discriminates.
#[test]
fn a_force_asked_for_late_is_caught() {
    driven::check_euler(&ForwardEuler).unwrap();
    driven::check_euler(&euler::Late).expect_err("the force of the end of the step passes");
    driven::check(&euler::Late).expect("the order cannot see it");
    for property in PROPERTIES {
        (property.check)(&euler::Late).expect("the pendulum cannot see it");
    }
}

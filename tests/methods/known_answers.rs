//! The methods of the library beside `snapshots/known-answers.json`, whose answers a program that
//! knows nothing of them has computed.

use std::num::NonZeroU64;

use pendula::integrate::Steps;
use pendula::systems::Damped;
use pendula::verify::known_answers::{self, Answer, Known, Scene};
use pendula::verify::{Listed, Request, Stranger};
use pendula::{AnyMethod, Driven, Pendulum, Phase, System};

use crate::common::{steps, steps_on};

/// The entry of the file for a method of the library.
fn known(method: &dyn AnyMethod) -> &'static Known {
    known_answers::method(method.info().name).expect("the file has every method of the library")
}

/// Asserts that the states of `run`, which takes the steps of an answer, are those of the file: of
/// all answers of scenes that are driven or not. The tolerance is that of the file, whose
/// README derives it; right rounding uses a quarter of it.
fn assert_known(method: &dyn AnyMethod, driven: bool, run: impl Fn(&Answer) -> Phase) {
    let answers = &known(method).answers;
    let those = answers.iter().filter(|answer| answer.scene.drive.is_some() == driven);
    let mut compared = 0;
    for answer in those {
        let state = run(answer);
        let off = answer.off(state, f64::EPSILON);
        let name = method.info().name;
        let Answer { scene, steps, .. } = answer;
        assert!(
            off <= 1.0,
            "{name}, {}, {steps} steps: {state:?} is {off} tolerances off",
            scene.name
        );
        compared += 1;
    }
    assert!(compared >= 4, "{compared} answers");
}

/// The pendulum of a scene without its drive.
fn pendulum(scene: &Scene) -> Pendulum {
    Pendulum::new(scene.g_over_l, 1.0, 1.0).unwrap()
}

/// The end of the steps of an answer. The time of a scene is a multiple of its step.
fn end<S: System<State = Phase>>(method: &dyn Steps<S>, system: &S, answer: &Answer) -> Phase {
    let Answer { scene, steps, .. } = answer;
    let before = scene.time / scene.step;
    assert_eq!(before.fract(), 0.0, "a grid begins at 0");
    let (mut at, _) = method.start(system, before as u64, scene.step, scene.start);
    let mut end = [Phase::default()];
    let all = NonZeroU64::new(*steps).unwrap();
    method.take(system, scene.step, &mut at, all, &mut end);
    end[0]
}

/// Swinging, over the top, backwards and in large steps.
///
/// Catches: a coefficient of any method wrong in its twelfth digit.
fn steps_lead_where_they_should(method: &dyn AnyMethod) {
    assert_known(method, false, |answer| {
        end::<Pendulum>(steps(method), &pendulum(answer.scene), answer)
    });
}
each_method!(steps_lead_where_they_should);

/// Catches: a fast loop that computes something else than the plain one, or forgets a sign on the
/// way back.
fn fast_steps_lead_where_they_should(method: &dyn AnyMethod) {
    assert_known(method, false, |answer| {
        let Scene { g_over_l, start, step, .. } = *answer.scene;
        let steps = answer.steps;
        let request = Request { g_over_l, drive: None, start, step, steps, every: steps };
        Listed(method).answer(&request).unwrap().states[0]
    });
}
each_method!(fast_steps_lead_where_they_should);

/// From t = 0 and later.
///
/// Catches: a stage that is told another time than its own.
fn driven_steps_lead_where_they_should(method: &dyn AnyMethod) {
    assert_known(method, true, |answer| {
        let pendulum = pendulum(answer.scene);
        let drive = answer.scene.drive.unwrap();
        let strength = drive.amplitude / pendulum.frequency_squared();
        let undamped = Damped::new(pendulum, 0.0).unwrap();
        let driven = Driven::new(undamped, strength, drive.frequency).unwrap();
        end(steps_on::<Driven>(method), &driven, answer)
    });
}
each_general_method!(driven_steps_lead_where_they_should);

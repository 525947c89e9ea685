//! The methods of the library beside `book/judge/known-answers/known-answers.json`, whose answers a
//! program that knows nothing of them has computed.

use pendula::registry::{ByName, methods_for_separable};
use pendula::systems::Damped;
use pendula::{AnyMethod, Driven, Grid, Pendulum, Phase, Separable, System};
use pendula_judge::known_answers::{self, Answer, Known, Scene};
use pendula_judge::{Chosen, Integrator, Request};

use crate::common::{in_seconds, on};

/// The entry of the file for a method of the library.
fn known(method: &dyn AnyMethod) -> &'static Known {
    let name = method.info().name;
    known_answers::method(name).unwrap_or_else(|| {
        panic!(
            "the known answers have no {name}: give it an entry in a file of \
             book/judge/known-answers/tables, and run `book/judge/known-answers/run generate`"
        )
    })
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
            "{name}, {}, {steps} steps: {state:?} is {off} tolerances off. (The known answers call \
             {name} a method of order {}, also named {:?}, and book/judge/known-answers/tables \
             says whose it is; if that is not yours, give yours another name.)",
            scene.name,
            known(method).order,
            known(method).also
        );
        compared += 1;
    }
    assert!(compared >= 4, "{compared} answers");
}

/// The pendulum of a scene without its drive.
fn pendulum(scene: &Scene) -> Pendulum {
    Pendulum::new(scene.g_over_l, 1.0, 1.0).unwrap()
}

/// Swinging, over the top, backwards and in large steps: in seconds and in steps.
///
/// Catches: a coefficient of any method wrong in its twelfth digit; a fast loop that computes
/// something else than the plain one, or forgets a sign on the way back.
fn steps_lead_where_they_should(method: &dyn AnyMethod) {
    for method in [method, in_seconds(method)] {
        assert_known(method, false, |answer| {
            let Scene { g_over_l, start, step, .. } = *answer.scene;
            let request = Request::new(g_over_l, start, step, answer.steps).every(answer.steps);
            Chosen::new(method).answer(&request).unwrap().states[0]
        });
    }
}
each_method!(steps_lead_where_they_should);

/// A driven pendulum whose time 0 is a later one.
#[derive(Clone)]
struct Later {
    driven: Driven,
    by: f64,
}

impl System for Later {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        self.driven.rate(self.by + t, z)
    }
}

impl Separable for Later {
    type Force = <Driven as Separable>::Force;

    fn force(&self, t: f64, z: Phase) -> Self::Force {
        self.driven.force(self.by + t, z)
    }

    fn kick(&self, z: Phase, force: Self::Force, h: f64) -> Phase {
        self.driven.kick(z, force, h)
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.driven.drift(z, h)
    }
}

impl ByName for Later {
    fn methods() -> &'static [&'static dyn AnyMethod<Self>] {
        methods_for_separable()
    }
}

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
        let Scene { start, step, time, .. } = *answer.scene;
        let later = Later { driven, by: time };
        on(method).end(&later, start, &Grid::new(step, answer.steps).unwrap())
    });
}
each_general_method!(driven_steps_lead_where_they_should);

/// Gonzalez's gradient of the energy is the midpoint's plus c Δz, and so is a step of his: Δθ =
/// h (ω̄ + c Δω), Δω = h (f − c Δθ), with the force f half-way. Δθ times the first and Δω times the
/// second add up to |Δz|² = h (ω̄ Δθ + f Δω), where c is gone; and c is such that H stays. These
/// two hold to rounding: each has five terms of at most 1 that are rounded twice.
///
/// With the mean along a line, or Itoh's and Abe's, Δθ is h ω̄ alone. Both keep H, but they are
/// other steps, also with one degree of freedom.
///
/// Catches: Gonzalez's name for the mean's steps; a correction along Δθ alone, or one that misses
/// the energy.
#[test]
fn gonzalez_corrects_in_phase_space_and_the_mean_does_not() {
    const ROUNDING: f64 = 10.0 * f64::EPSILON;
    let energy = |z: Phase| 0.5 * z.omega * z.omega - z.theta.cos();
    let swinging = |name| {
        let known = known_answers::method(name).unwrap();
        let first = known.answers.iter().filter(|it| it.scene.name == "swinging" && it.steps <= 2);
        let states: Vec<Phase> = first.map(|answer| answer.state).collect();
        (&known.name, [Phase { theta: 1.0, omega: 0.5 }, states[0], states[1]])
    };
    let (gonzalez, his) = swinging("Gonzalez");
    let (mean, its) = swinging("Itoh-Abe");
    assert_eq!([gonzalez.as_str(), mean.as_str()], ["gonzalez", "discrete-gradient"]);
    for (states, in_phase_space) in [(his, true), (its, false)] {
        for pair in states.windows(2) {
            let [z, next] = [pair[0], pair[1]];
            let (h, way, gain) = (0.125, next.theta - z.theta, next.omega - z.omega);
            let mean = 0.5 * (z.omega + next.omega);
            let force = -(0.5 * (z.theta + next.theta)).sin();
            assert!((energy(next) - energy(z)).abs() < ROUNDING, "{pair:?} changes H");
            let along_both = way * way + gain * gain - h * (mean * way + force * gain);
            let along_the_angle = way - h * mean;
            let [none, some] = match in_phase_space {
                true => [along_both, along_the_angle],
                false => [along_the_angle, along_both],
            };
            assert!(none.abs() < ROUNDING, "{none}");
            // c is about f h²/24, and Δω a tenth.
            assert!(some.abs() > 1e-7, "{some}");
        }
    }
}

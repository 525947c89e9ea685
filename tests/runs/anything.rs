//! The whole public interface with any numbers: every exponent of an f64 is as likely as any other,
//! and zeros, infinities, NaN, and the ends of its range are frequent.
//!
//! A scene asks one part of the library with such numbers. It is refused with an error of one line,
//! or what comes out is finite where the documentation says so; no scene panics or goes on for
//! ever; and what is computed for many at once has the bits of what is computed for one.

use pendula::methods::StormerVerlet;
use pendula::verify::{Claims, Fault, Reply, Request, Stranger, try_judge};
use pendula::{Error, Grid, Pendulum, Phase};

use crate::common::Random;

mod beyond;
mod loops;
mod motions;

/// Ten thousand scenes, a second or two.
///
/// Catches: a panic, an overflow of an integer, a loop without an end; a number out of range
/// accepted and NaN later; a batch or a lane with other bits than a run alone.
#[test]
fn ten_thousand_scenes_are_sound_or_refused() {
    let tally = Tally::of(10_000, 1);
    assert!(tally.refused > 1000 && tally.computed > 1000, "{tally:?}");
}

/// A million other scenes, which take minutes:
///
/// ```text
/// cargo test --release -p pendula --test runs -- --ignored --nocapture a_million_scenes
/// ```
///
/// with `CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS=true CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true`
/// before it, so that an overflow of an integer shows.
///
/// Catches: the same, where it is rare.
#[test]
#[ignore = "takes minutes: the comment above has the command"]
fn a_million_scenes_are_sound_or_refused() {
    let tally = Tally::of(1_000_000, 2);
    println!("{tally:?}");
    assert!(tally.refused > 100_000 && tally.computed > 100_000, "{tally:?}");
}

/// How many requests were refused, and how many computed.
#[derive(Debug, Default)]
struct Tally {
    refused: u64,
    computed: u64,
}

impl Tally {
    /// The tally of `scenes` scenes of the sequence `seed`. A scene that fails says which it was.
    fn of(scenes: u64, seed: u64) -> Self {
        const PARTS: [fn(&mut Any, &mut Tally); 14] = [
            motions::a_pendulum,
            motions::a_grid,
            loops::a_run,
            loops::a_run,
            loops::a_run,
            motions::a_motion,
            motions::a_period,
            motions::metrics,
            motions::readings,
            beyond::adaptive_steps,
            beyond::variable_steps,
            beyond::systems_beyond,
            beyond::dynamics,
            beyond::arithmetic,
        ];
        let mut tally = Self::default();
        for scene in 0..scenes {
            let mut any = Any(Random::new(seed.wrapping_mul(0x1000_0000_0001).wrapping_add(scene)));
            let said = Said { seed, scene };
            // Judging takes a thousand times as long as any other scene.
            if scene % 2500 == 2499 {
                a_stranger(&mut any, &mut tally);
            } else {
                PARTS[any.0.below(PARTS.len())](&mut any, &mut tally);
            }
            std::mem::forget(said);
        }
        tally
    }

    /// What came out, if it was not refused. A refusal has one line.
    fn accepted<T>(&mut self, result: Result<T, Error>) -> Option<T> {
        match result {
            Ok(value) => {
                self.computed += 1;
                Some(value)
            }
            Err(error) => {
                self.refused += 1;
                let text = error.to_string();
                assert!(!text.is_empty() && !text.contains('\n'), "{text}");
                None
            }
        }
    }
}

/// Says in which scene it was dropped: by a panic.
struct Said {
    seed: u64,
    scene: u64,
}

impl Drop for Said {
    fn drop(&mut self) {
        eprintln!("scene {} of the sequence {}", self.scene, self.seed);
    }
}

/// Any numbers.
struct Any(Random);

impl Any {
    /// Any f64: in one of four cases a special one, otherwise 64 random bits or an ordinary number.
    fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 16] = [
            0.0,
            -0.0,
            5e-324,
            -5e-324,
            2.225_073_858_507_201e-308,
            f64::MIN_POSITIVE,
            1e-160,
            1.0,
            -1.0,
            1e15,
            1e160,
            f64::MAX,
            f64::MIN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        match self.0.below(4) {
            0 => self.0.one_of(&SPECIAL),
            1 => self.0.between(-10.0, 10.0),
            _ => f64::from_bits(self.0.bits()),
        }
    }

    /// Any number greater than zero and finite.
    fn positive(&mut self) -> f64 {
        loop {
            let number = self.number().abs();
            if number > 0.0 && number.is_finite() {
                return number;
            }
        }
    }

    /// Any numbers, `count` of them.
    fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    fn phase(&mut self) -> Phase {
        Phase { theta: self.number(), omega: self.number() }
    }

    fn phases(&mut self, count: usize) -> Vec<Phase> {
        (0..count).map(|_| self.phase()).collect()
    }

    /// Any pendulum that is not refused; half of them are ordinary.
    fn pendulum(&mut self) -> Pendulum {
        if self.0.below(2) == 0 {
            let [gravity, length, mass] = [0, 1, 2].map(|_| self.0.between(0.1, 10.0));
            return Pendulum::new(gravity, length, mass).unwrap();
        }
        loop {
            let [gravity, length, mass] = [0, 1, 2].map(|_| self.positive());
            if let Ok(pendulum) = Pendulum::new(gravity, length, mass) {
                return pendulum;
            }
        }
    }

    /// A grid of up to `most` steps, in half of the cases with a step that suits the pendulum.
    fn grid(&mut self, pendulum: &Pendulum, most: usize) -> Grid {
        let steps = self.0.below(most + 1) as u64;
        let natural = self.0.between(1e-4, 3.0) / pendulum.small_angle_frequency();
        let step = if self.0.below(2) == 0 { natural } else { self.positive() };
        Grid::new(step, steps).unwrap_or_else(|_| Grid::new(1.0, steps).unwrap())
    }
}

/// The bits of a number; those of all NaNs are the same.
fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

fn is_finite(z: Phase) -> bool {
    z.theta.is_finite() && z.omega.is_finite()
}

// -------------------------------------------------------------------------------------------------
// The judge
// -------------------------------------------------------------------------------------------------

/// A stranger that answers with garbage: any states, as many as asked for or not; or with those of
/// a method, now and then spoilt.
struct Garbage {
    random: std::cell::RefCell<Random>,
    spoils: usize,
    counts: bool,
}

impl Stranger for Garbage {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let mut any = Any(self.random.borrow_mut().clone());
        self.random.borrow_mut().bits();
        let evaluations = self.counts.then(|| any.0.bits() >> any.0.below(64));
        let states = request.states() as usize;
        if self.spoils > 0 {
            let mut reply = StormerVerlet.answer(request)?;
            if any.0.below(self.spoils) == 0 && states > 0 {
                let at = any.0.below(states);
                reply.states[at] = any.phase();
            }
            return Ok(reply);
        }
        match any.0.below(60) {
            0 => Err(Fault::Unsupported),
            1 => Err(Fault::Refused("no".to_string())),
            2 => Err(Fault::Broken("nonsense".to_string())),
            3 => Ok(Reply { states: vec![], evaluations }),
            4 => Ok(Reply { states: any.phases(states + 1), evaluations }),
            _ => Ok(Reply { states: any.phases(states), evaluations }),
        }
    }

    fn longest_run(&self) -> u64 {
        2000
    }
}

fn a_stranger(any: &mut Any, tally: &mut Tally) {
    let garbage = Garbage {
        random: std::cell::RefCell::new(any.0.clone()),
        spoils: any.0.one_of(&[0, 0, 3, 30]),
        counts: any.0.below(2) == 0,
    };
    let claims = Claims::order(any.0.below(20) as u32).symplectic().symmetric();
    match try_judge(&garbage, &claims) {
        Ok(report) => {
            tally.computed += 1;
            // It is written out, whatever was measured.
            assert!(!report.to_string().is_empty() && !report.findings.is_empty());
        }
        Err(fault) => {
            tally.refused += 1;
            assert!(!fault.is_empty());
        }
    }
}

//! The whole public interface with any numbers: every exponent of an f64 is as likely as any other,
//! and zeros, infinities, NaN, and the ends of its range are frequent.
//!
//! A scene asks one part of the library with such numbers. It is refused with an error of one line,
//! or what comes out is finite where the documentation says so; no scene panics or goes on for
//! ever; and what is computed for many at once has the bits of what is computed for one.

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
/// cargo test --test runs -- --ignored --nocapture a_million_scenes
/// ```
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
        const PARTS: [fn(&mut Any, &mut Tally); 13] = [
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
            beyond::arithmetic,
        ];
        let mut tally = Self::default();
        for scene in 0..scenes {
            let mut any = Any(Random::new(seed.wrapping_mul(0x1000_0000_0001).wrapping_add(scene)));
            let said = Said { seed, scene };
            PARTS[any.0.below(PARTS.len())](&mut any, &mut tally);
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
    /// Any f64.
    fn number(&mut self) -> f64 {
        self.0.number()
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

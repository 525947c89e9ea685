//! States between the steps: whether they are as good as the steps, whether asking for them changes
//! the run, and whether there are as many as were asked for.

use std::time::Instant;

use super::asked::{self, Asked, Power, Scenes, evenly, power};
use super::ladder::{Ladder, Rung};
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};

/// States asked for in a run.
const OUTPUTS: u32 = 1000;
/// In each of so many parts of the run lies the end of a step, unless the steps are longer than
/// half a second.
const PARTS: usize = 20;
/// Runs that end where another has outputs.
const ENDS: u32 = 10;

/// How the outputs of a run compare with its steps.
#[derive(Clone, Copy, Debug)]
struct Compared {
    tolerance: f64,
    /// The largest error of all outputs (rad).
    outputs: f64,
    /// The largest of the parts' smallest errors (rad), which are those beside the ends of steps.
    steps: f64,
    /// What rounding may make of either (rad).
    rounding: f64,
    evaluations: Option<u64>,
}

/// The outputs at several tolerances.
#[derive(Clone, Debug)]
pub struct Outputs {
    compared: Vec<Compared>,
    /// The errors along one run: time (s) and error (rad).
    pub run: Vec<(f64, f64)>,
    /// Whether runs that end between the steps of a longer one are as bad there as its outputs.
    interpolated_end: bool,
}

impl Outputs {
    /// Asks for outputs at every second tolerance of the ladder.
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let times = evenly(OUTPUTS, asked.scenes.duration);
        let mut outputs = Self { compared: Vec::new(), run: Vec::new(), interpolated_end: false };
        for rung in ladder.quick().step_by(2) {
            let Rung { tolerance, .. } = rung;
            let request = asked.scenes.run(asked.scenes.starts[0], *tolerance).to(&times);
            let errors = asked.errors(&request)?;
            let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, libm::fminimum);
            let steps = errors.chunks(OUTPUTS as usize / PARTS).map(least);
            // The end itself is no state between steps.
            let between = errors.iter().take(OUTPUTS as usize - 1).copied();
            let largest = between.fold(0.0, libm::fmaximum);
            outputs.compared.push(Compared {
                tolerance: *tolerance,
                outputs: largest,
                steps: steps.fold(0.0, libm::fmaximum),
                rounding: rung.rounding,
                evaluations: rung.evaluations,
            });
            if outputs.run.is_empty() || *tolerance >= 0.9 * ladder.usual() {
                outputs.run = times.iter().copied().zip(errors).collect();
            }
        }
        let worse = outputs.ratios().filter(|(ratio, _)| *ratio > WORSE);
        let tightest = worse.last().map(|(_, it)| *it);
        if let Some(worse) = tightest {
            // Of several ends one is as bad as the worst output, if ends are interpolated.
            let mut largest = 0.0;
            for k in 0..ENDS {
                let end = asked.scenes.duration * (0.5 + 0.043 * f64::from(k));
                let request = asked.scenes.run(asked.scenes.starts[0], worse.tolerance).to(&[end]);
                largest = libm::fmaximum(largest, asked.errors(&request)?[0]);
            }
            outputs.interpolated_end = largest > 0.2 * worse.outputs;
        }
        Ok(outputs)
    }

    /// How many times worse than it may be the worst output is, tolerance by tolerance. It may be
    /// as bad as the steps; and, since a tolerance is what a user asks for, as many tolerances off
    /// as outputs are at looser ones, which an interpolant of the power of the estimate keeps.
    fn ratios(&self) -> impl Iterator<Item = (f64, &Compared)> {
        let mut tolerances = f64::INFINITY;
        self.compared.iter().filter(|it| it.outputs < 0.5).map(move |it| {
            let least = it.steps.max(tolerances * it.tolerance).max(it.rounding);
            tolerances = tolerances.min(it.outputs / it.tolerance);
            (it.outputs / least, it)
        })
    }

    fn worst(&self) -> Option<(f64, &Compared)> {
        self.ratios().max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The power of the step with which the error of the outputs falls, where it is not that of the
    /// steps.
    pub fn power(&self) -> Option<Power> {
        let points = self.compared.iter().filter_map(|it| {
            let tells = it.outputs > 3.0 * it.steps.max(it.rounding) && it.outputs < 0.1;
            tells.then_some((libm::log(it.evaluations? as f64), -libm::log(it.outputs)))
        });
        power(&points.collect::<Vec<_>>())
    }

    /// Whether even the end of a run is interpolated, by less than the steps are worth.
    pub const fn interpolates_the_end(&self) -> bool {
        self.interpolated_end
    }

    /// What is to be said of them.
    pub fn judge(&self) -> Finding {
        let Some((ratio, worst)) = self.worst() else {
            return Finding::nothing("no run is accurate enough to tell".to_string());
        };
        let Compared { tolerance, outputs, steps, .. } = *worst;
        let verdict = Verdict::of(ratio, HOLDS, WORSE);
        let power =
            self.power().map(|power| format!("; they fall with the power {}", in_words(power)));
        let measured = format!(
            "the worst of {OUTPUTS} states between steps is off by {} rad, the steps by {}, at a \
             tolerance of {}{}",
            scientific(outputs),
            scientific(steps),
            about(tolerance),
            power.filter(|_| verdict == Verdict::Fails).unwrap_or_default()
        );
        let why = format!(
            "{} times worse than its steps, and than its outputs at looser tolerances are for \
             theirs; up to {HOLDS:.0} may be chance",
            rounded(ratio)
        );
        Finding { measured, why, ..Finding::number(ratio, "", HOLDS, verdict) }
    }
}

/// Up to this ratio outputs are as good as steps: the error swings with the motion by a factor of 2
/// or 3, and a step more or less makes as much.
const HOLDS: f64 = 6.0;
/// Beyond this ratio they are worse.
const WORSE: f64 = 10.0;

/// A ratio to read.
pub fn rounded(ratio: f64) -> String {
    if ratio < 10.0 {
        format!("{ratio:.1}")
    } else if ratio < 1e4 {
        format!("{ratio:.0}")
    } else {
        about(ratio).to_string()
    }
}

/// A power with its uncertainty.
pub fn in_words(power: Power) -> String {
    format!("{:.1} ± {:.1}", power.value, libm::fmax(power.uncertainty, 0.1))
}

/// The power of the step that outputs are good to, and the polynomial of which that is true, where
/// the power is as good as whole.
pub fn as_of(power: Power) -> String {
    let whole = libm::round(power.value);
    let polynomial = match whole as u32 {
        2 => ", as those on a straight line",
        3 => ", as those on a parabola",
        4 => ", as those on a cubic",
        5 => ", as those on a quartic",
        _ => "",
    };
    let told = (power.value - whole).abs() + power.uncertainty < 0.35;
    format!("the power {} of the step{}", in_words(power), if told { polynomial } else { "" })
}

// -------------------------------------------------------------------------------------------------
// Whether they ask anything
// -------------------------------------------------------------------------------------------------

/// What a run with outputs makes of its end.
#[derive(Clone, Copy, Debug)]
pub struct Asking {
    /// Whether the end is the same to the bit.
    same: bool,
    /// The errors at the end without outputs and with them (rad).
    errors: [f64; 2],
    /// The largest error that a run with this tolerance may have (rad).
    bound: f64,
    /// Evaluations without them and with.
    evaluations: Option<(u64, u64)>,
}

impl Asking {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let alone =
            asked.scenes.run(asked.scenes.starts[0], ladder.usual()).to(&[asked.scenes.duration]);
        let outputs = asked
            .scenes
            .run(asked.scenes.starts[0], ladder.usual())
            .to(&evenly(OUTPUTS, asked.scenes.duration));
        let [without, with] = [asked.reply(&alone)?, asked.reply(&outputs)?];
        let ends = [&without, &with].map(|reply| reply.states[reply.states.len() - 1]);
        let errors = ends.map(|end| asked::errors(&alone, &[end])[0]);
        Ok(Self {
            same: ends[0] == ends[1],
            errors,
            bound: 10.0 * ladder.usual_error()?,
            evaluations: without.evaluations.zip(with.evaluations),
        })
    }

    /// What is to be said of it, where it is claimed that outputs are free, or not.
    pub fn judge(&self, claimed: bool) -> Finding {
        let Self { same, errors: [without, with], bound, evaluations } = *self;
        let cost = match evaluations {
            Some((without, with)) if with > without => {
                format!(", with {} times the evaluations", rounded(with as f64 / without as f64))
            }
            _ => String::new(),
        };
        let verdict = match Verdict::of(with, bound, bound) {
            Verdict::Holds if claimed && !same => Verdict::Fails,
            other => other,
        };
        let stops = evaluations.is_some_and(|(without, with)| with as f64 > 1.5 * without as f64);
        let measured = match (same, verdict) {
            (true, _) => format!("free: the same end to the bit{cost}"),
            (false, Verdict::Fails) if with > bound => format!(
                "{OUTPUTS} outputs change the end from {} to {} rad",
                scientific(without),
                scientific(with)
            ),
            _ if stops => format!("it stops at them{cost}"),
            _ => format!("an end as good, but not the same to the bit{cost}"),
        };
        let why = format!(
            "the end is off by {} rad without outputs and by {} with them; a run with this \
             tolerance may be off by {}",
            scientific(without),
            scientific(with),
            about(bound)
        );
        Finding { measured, why, ..Finding::number(with, "rad", bound, verdict) }
    }
}

// -------------------------------------------------------------------------------------------------
// Rows
// -------------------------------------------------------------------------------------------------

/// Times that are easily forgotten, in units of the duration.
const ROWS: [(&str, &[f64]); 5] = [
    ("equal times", &[0.4, 0.4, 0.4, 0.7, 0.7]),
    ("times at the start", &[0.0, 0.0, 0.5]),
    ("the start alone", &[0.0]),
    ("the last time twice", &[0.3, 1.0, 1.0]),
    ("times of a run backwards", &[0.0, -0.3, -0.3, -1.0]),
];

/// And a thousand times within a step.
const CLOSE: f64 = 1e-10;

/// Rows that were not right: which, and why; and the largest error of those that came.
#[derive(Clone, Debug)]
pub struct Rows {
    wrong: Vec<String>,
    refused: Vec<String>,
    largest: f64,
    bound: f64,
}

impl Rows {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let bound = 10.0 * ladder.usual_error()?;
        let mut rows = Self { wrong: Vec::new(), refused: Vec::new(), largest: 0.0, bound };
        let Scenes { starts, duration, .. } = asked.scenes;
        let close: Vec<f64> = (0..1000).map(|k| 0.5 + CLOSE * f64::from(k)).collect();
        let all = ROWS.into_iter().chain([("a thousand times within a step", &close[..])]);
        for (name, times) in all {
            let times: Vec<f64> = times.iter().map(|part| part * duration).collect();
            match asked.errors(&asked.scenes.run(starts[0], ladder.usual()).to(&times)) {
                Ok(errors) => {
                    let largest = errors.iter().copied().fold(0.0, libm::fmaximum);
                    rows.largest = libm::fmaximum(rows.largest, largest);
                    if largest > bound {
                        rows.wrong.push(format!("{name}: off by {} rad", scientific(largest)));
                    }
                }
                Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
                Err(Trouble::NoAnswer(why)) => rows.refused.push(format!("{name}: {why}")),
                Err(trouble) => rows.wrong.push(format!("{name}: {trouble}")),
            }
        }
        Ok(rows)
    }

    pub fn judge(&self) -> Finding {
        let Self { wrong, refused, largest, bound } = self;
        let (verdict, measured) = match (&wrong[..], &refused[..]) {
            ([], []) => (Verdict::Holds, "as many as asked for, at times of all kinds".to_string()),
            ([], refused) => (Verdict::Unclear, format!("refused: {}", refused.join("; "))),
            (wrong, _) => (Verdict::Fails, wrong.join("; ")),
        };
        let why = format!("each time has its row, off by {} rad at most", about(*bound));
        Finding { measured, why, ..Finding::number(*largest, "rad", *bound, verdict) }
    }
}

/// How the time goes with the number of outputs.
#[derive(Clone, Copy, Debug)]
pub struct Many {
    /// As many as can be had in time.
    count: u32,
    /// For a tenth of them and for all (s).
    took: [f64; 2],
    largest: f64,
    bound: f64,
}

const MANY: u32 = 100_000;

impl Many {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let timed = |count: u32| -> Measured<(f64, Vec<f64>)> {
            let request = asked
                .scenes
                .run(asked.scenes.starts[0], ladder.usual())
                .to(&evenly(count, asked.scenes.duration));
            let begun = Instant::now();
            let states = asked.reply(&request)?.states;
            let took = begun.elapsed().as_secs_f64();
            Ok((took, asked::errors(&request, &states)))
        };
        let patience = asked.solver.patience().as_secs_f64();
        let mut count = MANY / 10;
        let ((mut tenth, _), (mut all, mut errors)) = (timed(count / 10)?, timed(count)?);
        if 10.0 * all < 0.25 * patience && !is_slow(tenth, all) {
            (count, tenth) = (MANY, all);
            (all, errors) = timed(count)?;
        }
        let largest = errors.into_iter().fold(0.0, libm::fmaximum);
        Ok(Self { count, took: [tenth, all], largest, bound: 10.0 * ladder.usual_error()? })
    }

    /// What is to be said of it.
    pub fn judge(&self) -> Finding {
        let Self { count, took: [tenth, all], largest, bound } = *self;
        let ratio = all / tenth.max(1e-9);
        let slow = is_slow(tenth, all);
        let verdict = if slow { Verdict::Fails } else { Verdict::of(largest, bound, bound) };
        let measured = match slow {
            true => format!(
                "{count} outputs take {all:.1} s, {ratio:.0} times as long as a tenth of them"
            ),
            false => format!("{count} outputs, off by {} rad at most", scientific(largest)),
        };
        let why =
            format!("a tenth of them took {tenth:.2} s; a run may be off by {} rad", about(bound));
        Finding { measured, why, ..Finding::number(largest, "rad", bound, verdict) }
    }
}

/// Whether all outputs take too long (s) beside a tenth of them: ten times as long where the time
/// is linear, and a hundred times where it is not; less than 0.3 s is not worth a complaint.
fn is_slow(tenth: f64, all: f64) -> bool {
    all > 40.0 * tenth.max(1e-9) && all > 0.3
}

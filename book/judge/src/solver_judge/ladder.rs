//! Runs at smaller and smaller tolerances: how their errors and evaluations go with the tolerance,
//! and with each other.

use std::time::Duration;

use super::asked::{self, Asked, Power, Scenes, USUAL, largest_of, power};
use super::found::Ended;
use super::short;
use crate::judge::verdict::{Measured, Trouble};
use crate::solver::SolveRequest;
use pendula::systems::Phase;

/// Runs at each tolerance.
pub const RUNS: usize = Scenes::USUAL.starts.len();

/// A tolerance, and what came of it.
#[derive(Clone, Debug)]
pub struct Rung {
    /// The tolerance.
    pub tolerance: f64,
    /// The error at the end of each run (rad).
    pub errors: [f64; RUNS],
    /// Evaluations of all runs together, where somebody counts.
    pub evaluations: Option<u64>,
    /// What rounding may make of the errors (rad).
    pub rounding: f64,
    /// The states at the ends.
    pub ends: [Phase; RUNS],
}

impl Rung {
    /// The largest error (rad).
    pub fn largest(&self) -> f64 {
        largest_of(self.errors)
    }

    /// The geometric mean of the errors (rad): one of them may vanish by chance.
    pub fn mean(&self) -> f64 {
        let logs: f64 = self.errors.iter().map(|e| libm::log(libm::fmax(*e, 1e-18))).sum();
        libm::exp(logs / RUNS as f64)
    }

    /// Evaluations of one run; where nobody counts, of a run of thousands of steps.
    pub fn a_run(&self) -> u64 {
        self.evaluations.map_or(10_000, |all| all / RUNS as u64)
    }

    /// Whether its answers are those of another, to the bit, for as many evaluations.
    fn equals(&self, other: &Self) -> bool {
        self.ends == other.ends && self.evaluations == other.evaluations
    }

    /// Whether its error is that of the steps, neither rounding nor as large as the motion.
    fn tells(&self) -> bool {
        self.mean() > 3.0 * self.rounding && self.largest() < 0.1
    }
}

/// An error that falls no more.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// The tolerance from which on it does not.
    pub tolerance: f64,
    /// The error there (rad).
    pub error: f64,
}

/// The runs, from loose to tight.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// What was asked.
    pub scenes: Scenes,
    /// What came of each tolerance.
    pub rungs: Vec<Rung>,
    /// Why it ends before the last tolerance, if it does.
    pub ended: Option<Ended>,
    /// Tolerances, and the errors (rad) of states between steps, where it is claimed that these
    /// come from polynomials of a degree; else none.
    pub outputs: Vec<(f64, f64)>,
    /// Two counts of evaluations for the same answers to the same requests, the first and the
    /// second time, if they differ. Such counts are left out.
    pub miscount: Option<[u64; 2]>,
    /// The power of the number of evaluations with which the error of short runs falls, where it is
    /// known.
    pub in_short: Option<Power>,
}

/// 10⁻³, half a decade apart.
fn tolerance(k: i32) -> f64 {
    if k % 2 == 0 {
        libm::pow(10.0, f64::from(-3 - k / 2))
    } else {
        libm::pow(10.0, -3.5 - f64::from(k / 2))
    }
}

/// The rungs through which lines are drawn: four decades of tolerances.
pub const LAST: usize = 9;

/// The last is 10⁻¹³.
const RUNGS: i32 = 21;
/// In single precision it is 10⁻⁶: as many roundings as 10⁻¹⁴ of double precision, of which an
/// estimate is made that is a difference of slopes.
const SINGLE_RUNGS: i32 = 7;

/// A solver whose estimate is of first power needs ten times the steps for a tenth of the
/// tolerance: beyond so many evaluations nothing new is to be seen.
const ENOUGH: u64 = 200_000;
/// But a line needs four rungs.
const FEWEST: i32 = 3;

/// So many equal answers, and one that is so many rungs on, show that the tolerance does nothing. A
/// solver that halves all its steps has the same for a while, but not over four decades: that is a
/// step of a half in an order of 12.
const EQUAL: usize = 4;
const ON: i32 = 5;

/// Runs of so many evaluations are not long, and of so many are short.
pub const NOT_LONG: u64 = 13_000;
const SHORT: u64 = 4000;

impl Ladder {
    /// Asks as far as patience allows.
    pub fn of(asked: Asked<'_>) -> Measured<Self> {
        let mut ladder = Self {
            scenes: asked.scenes,
            rungs: Vec::new(),
            ended: None,
            outputs: Vec::new(),
            miscount: None,
            in_short: None,
        };
        let rungs = if asked.scenes.coarser() > 1.0 { SINGLE_RUNGS } else { RUNGS };
        let mut last = Duration::ZERO;
        let patience = asked.solver.patience();
        for k in 0..rungs {
            let tolerance = tolerance(k);
            let begun = asked.solver.clock();
            match rung(asked, tolerance) {
                Ok(rung) => ladder.push(asked, rung)?,
                // A tolerance may be too loose for it.
                Err(Trouble::NoAnswer(_) | Trouble::Lost(_))
                    if ladder.rungs.is_empty() && k + 1 < rungs =>
                {
                    continue;
                }
                Err(Trouble::NoAnswer(why) | Trouble::Lost(why)) if !ladder.rungs.is_empty() => {
                    ladder.ended = Some(Ended::NoAnswer { tolerance, why });
                    break;
                }
                Err(trouble) => return Err(trouble),
            }
            let took = asked.solver.clock().saturating_sub(begun);
            let evaluations = ladder.rungs.last().and_then(|rung| rung.evaluations);
            let enough = evaluations.is_some_and(|n| n > ENOUGH) && k >= FEWEST;
            if ladder.is_still() && (enough || k + ON < rungs && ladder.stays(asked, k + ON)?) {
                break;
            }
            // By what it grew, or by the most that half a decade may cost.
            let last_took = if k == 0 { took } else { last };
            let growth = (took.as_secs_f64() / last_took.as_secs_f64().max(1e-3)).clamp(1.0, 3.2);
            last = took;
            // Where somebody counts, time is no measure: it goes by what else the machine does.
            let allowed = if evaluations.is_some() { patience } else { patience / 4 };
            if k + 1 < rungs && (enough || last.mul_f64(growth) > allowed * RUNS as u32) {
                let at = ladder.rungs.last().map_or(0.0, |rung| rung.tolerance);
                ladder.ended = Some(Ended::TooLong { tolerance: at });
                break;
            }
        }
        // What single precision makes of an error is measured: the most that rounding may make is
        // far more.
        if asked.scenes.coarser() > 1.0 {
            let least = ladder.rungs.iter().map(Rung::mean).fold(f64::INFINITY, f64::min);
            ladder.rungs.iter_mut().for_each(|rung| rung.rounding = rung.rounding.min(least));
        }
        // What does not grow as the tolerance falls is no count of evaluations.
        let counts = |rung: Option<&Rung>| rung.and_then(|rung| rung.evaluations);
        if counts(ladder.rungs.last()) <= counts(ladder.rungs.first()) {
            ladder.rungs.iter_mut().for_each(|rung| rung.evaluations = None);
        }
        ladder.in_short = short::order(asked, &ladder)?;
        Ok(ladder)
    }

    /// Whether the last answers are equal, to the bit.
    fn is_still(&self) -> bool {
        self.rungs.len() >= EQUAL
            && self.rungs[self.rungs.len() - EQUAL..].windows(2).all(|two| two[0].equals(&two[1]))
    }

    /// Whether the answers at the tolerance of this number are those of the last rung; then it is
    /// added. At the last tolerances nothing is left to be asked.
    fn stays(&mut self, asked: Asked<'_>, k: i32) -> Measured<bool> {
        let far = match rung(asked, tolerance(k)) {
            Ok(far) => far,
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            Err(_) => return Ok(false),
        };
        let stays = self.rungs.last().is_some_and(|last| last.equals(&far));
        if stays {
            self.push(asked, far)?;
        }
        Ok(stays)
    }

    /// The tolerance from which on all answers are the same, to the bit, and their error, if that
    /// is more than rounding: two decades of tolerances show it, or all that were asked for.
    pub fn idle(&self) -> Option<Floor> {
        let last = self.rungs.last()?;
        let first = self.rungs.iter().rposition(|it| !it.equals(last)).map_or(0, |k| k + 1);
        let flat = &self.rungs[first..];
        let (tolerance, error) = (flat[0].tolerance, last.mean());
        let is_long = first == 0 && flat.len() >= EQUAL || tolerance / last.tolerance > 90.0;
        (is_long && error > 3.0 * last.rounding).then_some(Floor { tolerance, error })
    }

    /// Adds a rung; the first is asked for again at once.
    fn push(&mut self, asked: Asked<'_>, mut new: Rung) -> Measured<()> {
        if self.rungs.is_empty() {
            let again = rung(asked, new.tolerance)?;
            let counts = new.evaluations.zip(again.evaluations);
            self.miscount =
                counts.filter(|(a, b)| a != b && new.ends == again.ends).map(<[u64; 2]>::from);
        }
        if self.miscount.is_some() {
            new.evaluations = None;
            new.rounding = self.scenes.rounding(new.a_run());
        }
        self.rungs.push(new);
        Ok(())
    }

    /// Whether somebody counts evaluations.
    pub fn counts(&self) -> bool {
        self.rungs.iter().all(|rung| rung.evaluations.is_some_and(|n| n > 0))
    }

    /// The line through points of the rungs that tell: of the last [`LAST`], as longer steps bend
    /// it.
    fn line(&self, point: impl Fn(&Rung) -> Option<(f64, f64)>) -> Option<Power> {
        let points = self.rungs.iter().filter(|rung| rung.tells()).filter_map(point);
        let points: Vec<_> = points.collect();
        // Of a solver that halves all its steps, many tolerances have the same steps.
        let mut steps: Vec<f64> = points.iter().map(|point| libm::round(100.0 * point.0)).collect();
        steps.dedup();
        if steps.len() < FEWEST as usize + 1 {
            return None;
        }
        power(&points[points.len().saturating_sub(LAST)..])
    }

    /// The power of the tolerance with which the error falls.
    pub fn by_tolerance(&self) -> Option<Power> {
        self.line(|rung| Some((libm::log(rung.tolerance), libm::log(rung.mean()))))
    }

    /// The power of the step with which the estimate falls: evaluations grow as tol^(−1/q).
    pub fn estimate(&self) -> Option<Power> {
        let point =
            |rung: &Rung| Some((libm::log(rung.evaluations? as f64), -libm::log(rung.tolerance)));
        // A solver whose estimate is hopeless comes to no small error.
        self.line(point).or_else(|| power(&self.rungs.iter().filter_map(point).collect::<Vec<_>>()))
    }

    /// The power of the number of evaluations with which the error falls.
    pub fn order(&self) -> Option<Power> {
        self.line(|rung| Some((libm::log(rung.evaluations? as f64), -libm::log(rung.mean()))))
    }

    /// The rungs whose runs are quick, and the first.
    pub fn quick(&self) -> impl Iterator<Item = &Rung> {
        let first = self.rungs.iter().take(1);
        let others = self.rungs.iter().skip(1);
        first.chain(others.filter(|rung| rung.evaluations.is_none_or(|n| n < ENOUGH)))
    }

    /// The smallest tolerance to 10⁻¹¹ whose runs are not long.
    pub fn smallest(&self) -> f64 {
        self.smallest_within(NOT_LONG)
    }

    /// The smallest tolerance to 10⁻¹¹ whose runs are short, as many are asked for: where they
    /// show what an error of usual size covers. The usual one if that is as small.
    pub fn tight(&self) -> f64 {
        let few = if self.counts() { SHORT } else { NOT_LONG };
        self.smallest_within(few).min(self.usual())
    }

    fn smallest_within(&self, evaluations: u64) -> f64 {
        let quick = |rung: &&Rung| rung.tolerance > 0.9e-11 && rung.a_run() < evaluations;
        self.rungs.iter().filter(quick).map(|rung| rung.tolerance).fold(f64::INFINITY, f64::min)
    }

    /// The tolerance of the runs whose tolerance does not matter: [`USUAL`], or the smallest that
    /// can be had in time.
    pub fn usual(&self) -> f64 {
        let reached = self.quick().map(|rung| rung.tolerance).filter(|it| *it > 0.9 * USUAL);
        let loosest = self.rungs.first().map_or(1e-3, |rung| rung.tolerance);
        reached.fold(loosest, f64::min)
    }

    /// Such a run, from `start`.
    pub fn run(&self, start: Phase) -> SolveRequest {
        self.scenes.run(start, self.usual())
    }

    /// What the error of such a run may be (rad); no answer where that is as large as the motion.
    pub fn usual_error(&self) -> Measured<f64> {
        let error = self.error_at(self.usual());
        if error < 0.1 {
            return Ok(error);
        }
        Err(Trouble::NoAnswer("no run is accurate enough to tell".to_string()))
    }

    /// The rung of this tolerance.
    pub fn at(&self, tolerance: f64) -> Option<&Rung> {
        self.rungs.iter().find(|rung| (rung.tolerance / tolerance - 1.0).abs() < 0.1)
    }

    /// What is allowed a run of another kind with this tolerance (rad): ten times the error of a
    /// usual one, and not less than rounding.
    pub fn allowed(&self, tolerance: f64) -> f64 {
        let rounding = self.at(tolerance).map_or(0.0, |rung| rung.rounding);
        10.0 * self.error_at(tolerance).max(rounding)
    }

    /// The same of states between steps.
    pub fn usual_between(&self) -> Measured<f64> {
        Ok(libm::fmaximum(self.usual_error()?, self.between_at(self.usual())))
    }

    /// What the error of a state between the steps of a run with this tolerance may be (rad): that
    /// of the run, or, where outputs are claimed to be worse, that of those.
    pub fn between_at(&self, tolerance: f64) -> f64 {
        let near = |it: &&(f64, f64)| (libm::log10(it.0 / tolerance)).abs() < 1.1;
        let outputs = self.outputs.iter().filter(near).map(|it| it.1);
        outputs.fold(self.error_at(tolerance), libm::fmaximum)
    }

    /// The same of a state between steps.
    pub fn allowed_between(&self, tolerance: f64) -> f64 {
        self.allowed(tolerance).max(10.0 * self.between_at(tolerance))
    }

    /// What the error of a run with this tolerance may be: the largest at it and at its neighbours.
    pub fn error_at(&self, tolerance: f64) -> f64 {
        let near = |rung: &&Rung| (libm::log10(rung.tolerance / tolerance)).abs() < 0.6;
        self.rungs.iter().filter(near).map(Rung::largest).fold(0.0, libm::fmaximum)
    }

    /// By what the error rises most where the tolerance falls, and the tolerance at which it does:
    /// against the smallest error at a looser one, as far as that is more than rounding. An error
    /// may vanish by chance, so each is averaged with its neighbours.
    pub fn rise(&self) -> (f64, f64) {
        let mut least = f64::INFINITY;
        let mut worst = (1.0, self.rungs.first().map_or(0.0, |rung| rung.tolerance));
        for three in self.rungs.windows(3) {
            let logs = three.iter().map(|rung| libm::log(rung.mean().max(rung.rounding)));
            let error = libm::exp(logs.sum::<f64>() / 3.0);
            if error / least > worst.0 {
                worst = (error / least, three[1].tolerance);
            }
            least = least.min(error);
        }
        worst
    }

    /// The largest error in tolerances for each evaluation of its run, and the tolerance at which
    /// it is; of runs whose error is not as large as the motion.
    pub fn an_evaluation(&self) -> Option<(f64, f64)> {
        let each = self.rungs.iter().filter(|rung| rung.tells()).filter_map(|rung| {
            rung.evaluations?;
            Some((rung.largest() / rung.tolerance / rung.a_run() as f64, rung.tolerance))
        });
        each.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Where the error falls no more, if two decades of tolerances show it and more than rounding
    /// is left.
    pub fn floor(&self) -> Option<Floor> {
        let last = self.rungs.last()?;
        let least = self.rungs.iter().map(Rung::mean).fold(f64::INFINITY, f64::min);
        let first = self.rungs.iter().position(|rung| rung.mean() < 3.0 * least)?;
        let flat = &self.rungs[first..];
        let is_flat = flat[0].tolerance / last.tolerance > 90.0;
        let is_more = least > 3.0 * last.rounding;
        let floor = Floor { tolerance: flat[0].tolerance, error: least };
        (is_flat && is_more && least < 0.1).then_some(floor)
    }
}

/// The runs with this tolerance, each to its end.
fn rung(asked: Asked<'_>, tolerance: f64) -> Measured<Rung> {
    let Scenes { starts, duration, .. } = asked.scenes;
    let mut rung =
        Rung { tolerance, errors: [0.0; RUNS], evaluations: Some(0), rounding: 0.0, ends: starts };
    for (k, start) in starts.into_iter().enumerate() {
        let request = asked.scenes.run(start, tolerance).to(&[duration]);
        let reply = asked.reply(&request)?;
        rung.errors[k] = asked::errors(&request, &reply.states)[0];
        rung.ends[k] = reply.states[0];
        rung.evaluations =
            rung.evaluations.zip(reply.evaluations).map(|(a, b)| a.saturating_add(b));
    }
    Ok(Rung { rounding: asked.scenes.rounding(rung.a_run()), ..rung })
}

#[cfg(test)]
mod tests {
    use crate::property::Property;
    use std::cell::Cell;

    use pendula::methods::Dop853;

    use super::*;
    use crate::{ByTolerance, Claims, Fault, Reply, SolveRequest, Solver, Verdict, judge_solver};

    /// A right solver that takes so long for an answer, and for each of its states, by its clock.
    struct Slow {
        patience: Duration,
        answer: Duration,
        state: Duration,
        clock: Cell<Duration>,
    }

    impl Solver for Slow {
        fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
            let took = self.answer + self.state * request.times.len() as u32;
            self.clock.set(self.clock.get() + took);
            ByTolerance::new(Dop853).solve(request)
        }

        fn clock(&self) -> Duration {
            self.clock.get()
        }

        fn patience(&self) -> Duration {
            self.patience
        }
    }

    /// Catches: a verdict that depends on what else the machine does: a ladder that ends by the
    /// time that answers take, though evaluations are counted.
    #[test]
    fn a_ladder_does_not_depend_on_the_load() {
        let rungs = |answer| {
            let patience = Duration::from_secs(10);
            let (state, clock) = (Duration::ZERO, Cell::default());
            let slow = Slow { patience, answer, state, clock };
            let report = judge_solver(&slow, Claims::order(8).estimate(8));
            assert_eq!(report.verdict, Verdict::Holds, "{report}");
            report.evidence.tolerances
        };
        let quick = rungs(Duration::from_millis(1));
        assert_eq!(quick.len(), RUNGS as usize);
        assert_eq!(rungs(Duration::from_secs(5)), quick);
    }

    /// Catches: a solver too slow for its patience held for a wrong one, or asked on; one that has
    /// time enough not asked for more than a rung; so many outputs asked for that it is late.
    #[test]
    fn a_slow_solver_is_asked_for_what_it_has_time_for() {
        let judged = |patience, answer, state| {
            let [patience, answer] = [patience, answer].map(Duration::from_millis);
            let (state, clock) = (Duration::from_micros(state), Cell::default());
            let slow = Slow { patience, answer, state, clock };
            judge_solver(&slow, Claims::order(8))
        };
        let report = judged(40, 41, 0);
        assert_eq!(report.evidence.tolerances.len(), 1, "{report}");
        assert_eq!(report.verdict, Verdict::NotMeasured, "{report}");
        assert_eq!(report.failures().next(), None, "{report}");
        let told = &report.finding(Property::Tolerance).unwrap().why();
        assert_eq!(told, "smaller tolerances than 1e-3 take too long");
        // Five seconds are allowed for an answer of a millisecond; and ten times the 0.6 s that
        // 10 000 outputs take at least are more than that, by its clock.
        let report = judged(20_000, 1, 60);
        assert_eq!(report.evidence.tolerances.len(), RUNGS as usize, "{report}");
        let many = &report.finding(Property::Many).unwrap().measured();
        assert!(many.starts_with("10000 outputs, off by "), "{many}");
    }

    /// A right solver that is asked for another tolerance than it takes, and counts its answers.
    struct Deaf(Cell<u32>, fn(f64) -> f64);

    impl Solver for Deaf {
        fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
            self.0.set(self.0.get() + 1);
            let tolerance = self.1(request.tolerance);
            ByTolerance::new(Dop853).solve(&SolveRequest { tolerance, ..request.clone() })
        }
    }

    /// Catches: a tolerance that does nothing asked for down to the last, which may take minutes;
    /// one that does nothing over two decades only, as of a solver that halves its steps, taken for
    /// it.
    #[test]
    fn a_tolerance_that_does_nothing_is_told_by_four_answers() {
        let climbed = |taken| {
            let deaf = Deaf(Cell::new(0), taken);
            let ladder = Ladder::of(Asked { solver: &deaf, scenes: Scenes::USUAL }).unwrap();
            let idle = ladder.idle().map(|floor| floor.tolerance);
            (ladder.rungs.len(), idle, deaf.0.get())
        };
        let (rungs, idle, answers) = climbed(|_| 1e-5);
        // Four, one far on, and the first again, of three runs each.
        assert_eq!((rungs, idle, answers), (5, Some(1e-3), 18));
        let (rungs, idle, _) = climbed(|tolerance| tolerance.max(1e-5));
        assert_eq!(rungs, 9, "10⁻³ to 10⁻⁵, three more, and one far on");
        assert!(idle.is_some_and(|at| (at / 1e-5 - 1.0).abs() < 1e-9), "{idle:?}");
        // In steps of a hundred: what is asked for at 10⁻⁴, 3 · 10⁻⁵, 10⁻⁵ and 3 · 10⁻⁶ is one.
        let in_hundreds = |tolerance: f64| 10_f64.powf(2.0 * (0.5 * tolerance.log10()).floor());
        let (rungs, idle, _) = climbed(in_hundreds);
        assert_eq!((rungs, idle), (RUNGS as usize, None));
    }
}

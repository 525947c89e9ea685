//! The map for choosing an integrator, checked against real runs.

use pendula::internals::in_seconds;
use pendula::{AnyMethod, Grid, Motion, Pendulum, Phase, method_named};
use pendula_study::experiments::choosing::{
    Advice, Cell, Curve, LONGEST, PERIODS, PROJECTED, Release, SWINGS, THETA_0, allowed, map,
    profile_of, ranked,
};
use rstest::rstest;

/// The largest error of the angle (rad) of a real run, against the closed form: at every sample, or
/// in runs of more than 2 · 10⁴ steps at about that many samples, spread over all phases.
fn largest_error(release: &Release, method: &dyn AnyMethod, grid: &Grid) -> f64 {
    let motion = Motion::new(&Pendulum::PAPER, release.start).unwrap();
    let stride = (grid.steps() / 20_000).max(1) | 1;
    let mut largest = 0.0_f64;
    method.run(&Pendulum::PAPER, release.start, grid, &mut |n: u64, t: f64, z: Phase| {
        if n.is_multiple_of(stride) {
            largest = largest.max((z.theta - motion.at(t).theta).abs());
        }
    });
    largest
}

/// The curve of the method on a swing of `theta_0`, over this many periods.
fn curve(advice: &Advice, theta_0: f64, periods: u64) -> Curve {
    profile_of(advice.method, theta_0).over(periods)
}

/// The most steps of a run that a test can afford: of some runs from 1 rad, and of others.
const AFFORDABLE: f64 = 3e5;
const OF_OTHERS: f64 = 1e5;

/// Random cells of a map, the same at each call, whose two best methods can be run in full: first
/// those with runs as short as the measured ones, then as many with longer runs.
fn some_cells(map: &[Cell], count: usize, affordable: f64) -> impl Iterator<Item = &Cell> {
    let at_random = move || {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let position = core::iter::from_fn(move || {
            // Marsaglia's xorshift.
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            Some(state as usize % map.len())
        });
        let runs = move |cell: &&Cell| {
            let short = |a: &Advice| a.steps * cell.periods as f64 <= affordable;
            cell.ranking.len() >= 2 && cell.ranking[..2].iter().all(short)
        };
        position.map(|i| &map[i]).filter(runs)
    };
    let within = at_random().filter(|cell| cell.periods <= LONGEST).take(count);
    let beyond = at_random().filter(|cell| cell.periods > LONGEST).take(count);
    within.chain(beyond)
}

/// A measured error counts if rounding is at most a tenth of it, so an extrapolated error may be
/// off by a tenth. For errors up to 0.1 rad the law's next terms, of relative order e/θ₀, are as
/// small.
const TOLERANCE: f64 = 0.1;

/// Between two rungs, half an octave apart, the curve is a chord on logarithmic axes. Where two
/// terms of an error cancel, or one takes over from the other, the slope changes by at most the
/// order p, and the chord is too high by at most p ln(√2)/4 (in the logarithm).
fn chord(order: u32) -> f64 {
    (-f64::from(order) * 2.0_f64.sqrt().ln() / 4.0).exp()
}

/// With the step that the map advises, the two best methods stay within the allowed error, also on
/// runs many times longer than the measured ones; and not far below it, so that the step is no
/// smaller than necessary.
///
/// Catches: a law of growth without its quadratic term, or with one where theory has none; a ladder
/// of steps that is too coarse; the error at the end of a run taken for the largest error; the
/// error at one phase taken for that at all phases; coarse steps that are resonant.
#[rstest]
#[case::small(0.3, 4)]
#[case::of_the_chapter(1.0, 24)]
#[case::large(2.0, 4)]
#[case::nearly_over_the_top(3.0, 4)]
fn the_advice_is_met_in_real_runs(#[case] theta_0: f64, #[case] count: usize) {
    let release = Release::new(theta_0);
    let affordable = if theta_0 == THETA_0 { AFFORDABLE } else { OF_OTHERS };
    for Cell { periods, allowed, ranking } in some_cells(map(theta_0), count, affordable) {
        for advice in &ranking[..2] {
            let info = advice.method.info();
            let grid = release.grid(advice.steps, *periods);
            let error = largest_error(&release, advice.method, &grid);
            let rounding = release.rounding(advice.method, advice.steps, *periods);
            assert!(
                error < (1.0 + TOLERANCE) * allowed,
                "{error:e} of {allowed:e} allowed over {periods} periods: {advice:?}"
            );
            let curve = curve(advice, theta_0, *periods);
            let law = curve.error(advice.steps);
            // Coarse steps stand on a rung, with no chord beside it. Where no error was measured,
            // and the order itself is not reached, it may fall more steeply.
            let coarse = advice.steps < release.coarse;
            let steep = coarse && advice.steps > curve.finest;
            let chord = if coarse { 1.0 } else { chord(info.order) };
            let least = (1.0 - TOLERANCE) * chord * law - rounding;
            assert!(
                steep || error > least,
                "{error:e} for {law:e} over {periods} periods: {advice:?}"
            );
            // Steps of an explicit method cost the same: the first of them tell.
            let steps = if info.implicit { grid.steps() } else { grid.steps().min(1000) };
            let some = Grid::new(grid.step(), steps).unwrap();
            let method = in_seconds(info.name).unwrap();
            let counted = method.count_evaluations(&Pendulum::PAPER, release.start, &some)
                + info.force_evaluations * (grid.steps() - steps);
            // For an implicit method only a part of the run was counted, and the number of sweeps
            // depends on the phase, which drifts over the run.
            let tolerance = if info.implicit { counted / 20 } else { 0 };
            assert!(advice.evaluations.abs_diff(counted) <= tolerance, "{counted}: {advice:?}");
        }
    }
}

/// The most steps a period that a method can take with so many evaluations: a whole number or, if
/// they are coarse, a rung of its curve. The curve may begin at more.
fn steps_for(curve: &Curve, evaluations: u64) -> Option<f64> {
    let steps = evaluations / curve.method.info().force_evaluations / curve.periods;
    if steps as f64 >= curve.release.coarse {
        return Some(steps as f64);
    }
    let mut rungs = curve.points.iter().map(|(steps, _)| *steps).rev();
    rungs.find(|steps| curve.evaluations(*steps) <= evaluations)
}

/// Given only as many force evaluations as the best method, the second-best exceeds the allowed
/// error: at every cell where the run can be afforded, and where its error is so large by its curve
/// that the tolerance and the chord cannot make up for it.
///
/// Catches: a method that wins only because the errors of the others are overestimated, or because
/// they may not take steps as long as they could.
#[test]
fn the_second_best_needs_more() {
    let (mut compared, mut coarse) = (0, 0);
    let release = Release::new(THETA_0);
    for Cell { periods, allowed, ranking } in map(THETA_0) {
        let [best, next, ..] = &ranking[..] else { continue };
        let info = next.method.info();
        let curve = curve(next, THETA_0, *periods);
        let Some(steps) = steps_for(&curve, best.evaluations) else { continue };
        // There are many such runs, and so each must be shorter.
        if steps * *periods as f64 > OF_OTHERS {
            continue;
        }
        let is_coarse = steps < release.coarse;
        let chord = if is_coarse { 1.0 } else { chord(info.order) };
        if (1.0 - TOLERANCE) * chord * curve.error(steps) < *allowed {
            continue;
        }
        compared += 1;
        coarse += usize::from(is_coarse && *periods > LONGEST);
        let error = largest_error(&release, next.method, &release.grid(steps, *periods));
        assert!(error > *allowed, "{error:e} of {allowed:e} over {periods} periods: {next:?}");
    }
    // Elsewhere the two best are too close, or their runs too long.
    assert!(compared > map(THETA_0).len() / 8, "{compared} of {} cells", map(THETA_0).len());
    assert!(coarse > map(THETA_0).len() / 32, "{coarse} long runs in coarse steps");
}

/// RK4 with its energy put back is ranked too, though it is no method of the list. What it is
/// charged with is counted in the run, the gradient of each step included; and the run stays within
/// the allowed error, and not far below it: the chord of order 4 is as close here as the tolerance.
///
/// Catches: a projection whose gradient costs nothing; one that is extrapolated as RK4 is, with a
/// drift of the action.
#[test]
fn a_projection_has_its_place_on_the_map() {
    has_a_projection_in_its_place(0.3, 10_000);
}

/// The same of the other maps, whose runs have more steps.
#[rstest]
#[case::of_the_chapter(THETA_0, 40_000)]
#[case::large(2.0, 10_000)]
#[case::nearly_over_the_top(3.0, 10_000)]
#[ignore = "takes seven seconds of processor time: see .ci/slow"]
fn a_projection_has_its_place_on_each_map(#[case] theta_0: f64, #[case] periods: u64) {
    has_a_projection_in_its_place(theta_0, periods);
}

#[track_caller]
fn has_a_projection_in_its_place(theta_0: f64, periods: u64) {
    const ALLOWED: f64 = 1e-2;
    let release = Release::new(theta_0);
    let rk4 = profile_of(method_named("rk4").unwrap(), theta_0).over(periods);
    let advice = profile_of(PROJECTED, theta_0).over(periods).advice(ALLOWED).unwrap();
    let grid = release.grid(advice.steps, periods);
    let error = largest_error(&release, PROJECTED, &grid);
    let least = (1.0 - TOLERANCE) * chord(PROJECTED.info().order) * ALLOWED;
    assert!(error > least && error < (1.0 + TOLERANCE) * ALLOWED, "{error:e}: {advice:?}");
    let counted = PROJECTED.count_evaluations(&Pendulum::PAPER, release.start, &grid);
    assert_eq!(advice.evaluations, counted);
    assert_eq!(counted, 5 * grid.steps());
    let saved = rk4.advice(ALLOWED).unwrap().evaluations as f64 / counted as f64;
    assert!(saved > 1.5, "{saved} times fewer than RK4");
    let ranks = |cell: &Cell| cell.ranking.iter().any(|it| it.method.info() == PROJECTED.info());
    assert!(map(theta_0).iter().any(ranks), "on no cell of the map");
}

/// Two methods of which the map long said the contrary: it trusted no step longer than a 32nd of a
/// period in long runs, and so charged a step of eleven evaluations 2.75 times as much as one of
/// four. Blanes and Moan's method does the run with half the evaluations of four to a 32nd of a
/// period; the processed one with as many evaluations as that does not.
///
/// Catches: a method excluded, or charged for more, because its steps are long.
#[test]
fn a_step_may_be_long() {
    const PERIODS: u64 = 10_000;
    const ALLOWED: f64 = 1e-2;
    let release = Release::new(THETA_0);
    let cell =
        map(THETA_0).iter().find(|cell| cell.periods == PERIODS && cell.allowed < 1.01 * ALLOWED);
    let ranking = &cell.unwrap().ranking;
    let place = |name| ranking.iter().position(|it| it.method.info().name == name).unwrap();
    let (eleven, four) = (place("blanes-moan-6"), place("processed-6"));
    assert!(eleven < four, "{:?}", &ranking[..four]);
    let (eleven, four) = (&ranking[eleven], &ranking[four]);
    assert!(eleven.evaluations < PERIODS * 32 * 4 * 6 / 10, "{eleven:?}");
    let run = |advice: &Advice, steps| {
        largest_error(&release, advice.method, &release.grid(steps, PERIODS))
    };
    assert!(run(eleven, eleven.steps) < ALLOWED);
    let curve = curve(four, THETA_0, PERIODS);
    let as_many = steps_for(&curve, eleven.evaluations).unwrap();
    assert!(run(four, as_many) > ALLOWED, "in {as_many} steps a period");
}

/// Where steps are so small that only rounding is left, the error is a random walk. It stays below
/// the bound, which is two standard deviations of steps with the largest possible rounding; how far
/// below depends on how often a step rounds: `part` is the root mean square of the largest error of
/// twelve runs, measured with steps several times as long and as short, from which it scatters by a
/// fifth, and here by a factor of 2 at most. `steps` to a period are so many that the method's own
/// error is a hundredth of the bound.
///
/// The steps do not divide the period: if they did, and the method's error in a period were below
/// one rounding, each period would round like the one before, and the errors would add up linearly.
///
/// Catches: cells wrongly marked as lost in rounding, and lost cells that are not marked; a walk
/// that grows as another power of time.
#[rstest]
#[case::rk4("rk4", 16_000, 0.17)]
#[case::kicks_and_drifts("blanes-moan-6", 4_000, 0.32)]
#[case::many_kicks("yoshida-8", 4_000, 0.33)]
#[case::twelve_stages("dop853", 1_000, 0.107)]
#[case::a_series("taylor-24", 1_000, 0.056)]
#[case::implicit("gauss-6", 2_000, 0.20)]
fn rounding_is_as_large_as_the_map_says(
    #[case] name: &str,
    #[case] steps: u64,
    #[case] part: f64,
    #[values(2, 16)] periods: u64,
) {
    let method = method_named(name).unwrap();
    let release = Release::new(THETA_0);
    let bound = release.rounding(method, steps as f64, periods);
    let errors = (0..12_u32).map(|j| {
        let step = release.period / (steps as f64 + 0.618 + 3.3 * f64::from(j));
        largest_error(&release, method, &Grid::new(step, steps * periods).unwrap()) / bound
    });
    let errors: Vec<f64> = errors.collect();
    assert!(errors.iter().all(|error| *error < 1.0), "{errors:?} of {bound:e}");
    let mean = (errors.iter().map(|error| error * error).sum::<f64>() / 12.0).sqrt();
    assert!(mean > 0.5 * part && mean < 2.0 * part, "{mean} of {bound:e}, not {part}");
}

/// The map has all its cells, and each cell ranks each method at most once.
///
/// Catches: a method forgotten; a cell lost; an error that costs less over a longer run, or a
/// smaller error that costs less work.
#[test]
fn more_is_never_cheaper() {
    let cost = |cell: &Cell| cell.ranking.first().map_or(u64::MAX, |best| best.evaluations);
    for theta_0 in SWINGS {
        // One to a decade in the other swings.
        let full = theta_0 == THETA_0;
        let (columns, rows) = if full { (PERIODS.len(), allowed().len()) } else { (6, 10) };
        let map = map(theta_0);
        assert_eq!(map.len(), columns * rows, "from {theta_0} rad");
        for (i, cell) in map.iter().enumerate() {
            assert!(cell.ranking.len() <= ranked().count());
            assert!(cell.ranking.is_sorted_by_key(|advice| advice.evaluations));
            let (row, column) = (i % rows, i / rows);
            assert!(row == 0 || cost(cell) >= cost(&map[i - 1]), "{cell:?}");
            assert!(column == 0 || cost(cell) >= cost(&map[i - rows]), "{cell:?}");
        }
        assert!(!full || map[0].ranking.len() == ranked().count(), "0.1 rad, once: anybody can");
        assert!(map.last().unwrap().ranking.is_empty(), "1e-10 after 10⁵ periods: nobody can");
    }
}

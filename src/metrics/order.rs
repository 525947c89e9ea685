//! Order of convergence: the slopes along a ladder of steps, with the rounding floor masked.

// ANCHOR: slopes
/// The slope log(e₁/e₀) / log(h₁/h₀) of each pair of neighbours on a ladder of steps.
///
/// `steps` (s) and `errors` run together, in either direction. A pair in which an error has reached
/// `floor`, the level at which rounding and not truncation is measured, has no slope: `None`. So
/// has a pair whose error is zero or not a number.
pub fn slopes<'a>(
    steps: &'a [f64],
    errors: &'a [f64],
    floor: f64,
) -> impl Iterator<Item = Option<f64>> + 'a {
    let above = move |error: f64| error > floor.max(0.0) && error.is_finite();
    steps.windows(2).zip(errors.windows(2)).map(move |(h, e)| {
        (above(e[0]) && above(e[1])).then(|| libm::log(e[1] / e[0]) / libm::log(h[1] / h[0]))
    })
}
// ANCHOR_END: slopes

/// Whether the `error` of a method of this `order` is its own and no luck, going by that of half
/// the step, `finer`, of which so much may be `rounding`.
///
/// An error may cross zero at some step, and there a poor method looks splendid. But with half the
/// step it should be 2ᵖ times smaller: where that makes it out to be more than three times what it
/// is, the step was lucky, or rounding has been reached. A high order may reach it in a single
/// halving. So where the finer error may be rounding, it need only be no more than three times what
/// `error` is.
pub fn is_asymptotic(order: u32, error: f64, finer: f64, rounding: f64) -> bool {
    let falls = 3.0 * error >= libm::exp2(f64::from(order)) * finer;
    falls || finer <= rounding && 3.0 * error >= finer
}

/// Whether an `error`, of which so much may be `rounding`, is on the floor: with half the step,
/// where it is `finer`, it does not fall by half, as that of any method would.
pub fn is_floor(error: f64, rounding: f64, finer: f64) -> bool {
    error <= rounding && 2.0 * finer >= error
}

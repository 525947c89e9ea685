//! Order of convergence: the slopes along a ladder of steps, with the rounding floor masked.

// ANCHOR: slopes
/// The slope log(e₁/e₀) / log(h₁/h₀) of each pair of neighbours on a ladder of steps.
///
/// `steps` (s) and `errors` are in the same order, ascending or descending. A pair in which an
/// error has reached `floor`, the level at which rounding and not truncation is measured, has no
/// slope: `None`. Nor has a pair in which an error is zero or not finite.
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

/// Whether the `error` of a method of this `order` agrees with its order and is not small by
/// chance, judged by the error with half the step, `finer`, of which as much as `rounding` may be
/// rounding.
///
/// The error as a function of the step may cross zero, and near there a poor method looks splendid.
/// But with half the step an error should be 2ᵖ times smaller: if 2ᵖ `finer` is more than three
/// times `error`, then `error` was small by chance, or rounding has been reached. A high order may
/// reach rounding in a single halving. So if `finer` may be rounding, it need only be at most three
/// times `error`.
pub fn is_asymptotic(order: u32, error: f64, finer: f64, rounding: f64) -> bool {
    let falls = 3.0 * error >= libm::exp2(f64::from(order)) * finer;
    falls || finer <= rounding && 3.0 * error >= finer
}

/// Whether an `error`, of which as much as `rounding` may be rounding, is on the rounding floor:
/// the error with half the step, `finer`, is not less than half of it, as it would be for any
/// method above the floor.
pub fn is_floor(error: f64, rounding: f64, finer: f64) -> bool {
    error <= rounding && 2.0 * finer >= error
}

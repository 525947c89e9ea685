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

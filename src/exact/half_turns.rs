//! Angles that count their half turns.

use crate::arithmetic::double_double::DoubleDouble;

/// `half_turns` π + `angle`, rounded as if once: π and its multiple are double-doubles.
#[inline]
pub(super) fn unwrapped(half_turns: f64, angle: f64) -> f64 {
    let turned = DoubleDouble::HALF_PI.scaled(2.0) * DoubleDouble::new(half_turns);
    turned.rounded() + (turned.remainder() + angle)
}

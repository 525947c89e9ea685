//! The small swings of a double pendulum.

use pendula::DoublePendulum;

/// The angular frequencies of the two normal modes of small swings (rad/s), the slow one first: the
/// roots of m₁L₁L₂ ω⁴ − (m₁ + m₂)(L₁ + L₂)g ω² + (m₁ + m₂)g² = 0.
pub fn normal_modes(double: &DoublePendulum) -> [f64; 2] {
    let (l1, l2) = (double.upper().length, double.lower().length);
    let upper = double.upper().mass / (double.upper().mass + double.lower().mass);
    let (sum, root) = (l1 + l2, root(double));
    // The slow root as a quotient: it loses no digits in a difference.
    let slow = 2.0 * double.gravity() / (sum + root);
    let fast = double.gravity() * (sum + root) / (2.0 * upper * l1 * l2);
    [libm::sqrt(slow), libm::sqrt(fast)]
}

/// The ratio θ₂/θ₁ in each of the [`normal_modes`]: positive in the slow one, where the bobs swing
/// together, negative in the fast one. For equal rods and bobs it is ±√2.
///
/// From the lower bob's equation, L₁ θ̈₁ + L₂ θ̈₂ + g θ₂ = 0, it is L₁/(g/ω² − L₂), where 2g/ω² is
/// L₁ + L₂ plus or minus the root of the discriminant.
pub fn mode_shapes(double: &DoublePendulum) -> [f64; 2] {
    let (l1, l2) = (double.upper().length, double.lower().length);
    let lower = double.lower().mass / (double.upper().mass + double.lower().mass);
    // The denominators are (L₁ − L₂ ± root)/2. One of them cancels; it is the quotient of their
    // product, −L₁L₂ m₂/(m₁ + m₂), by the other.
    let sum = (l1 - l2).abs() + root(double);
    let (near, far) = (2.0 * l1 / sum, sum / (2.0 * lower * l2));
    if l1 >= l2 { [near, -far] } else { [far, -near] }
}

/// √((L₁ + L₂)² − 4 L₁L₂ m₁/(m₁ + m₂)) (m), without the cancellation where it is small.
fn root(double: &DoublePendulum) -> f64 {
    let (l1, l2) = (double.upper().length, double.lower().length);
    let lower = double.lower().mass / (double.upper().mass + double.lower().mass);
    libm::sqrt((l1 - l2) * (l1 - l2) + 4.0 * lower * l1 * l2)
}

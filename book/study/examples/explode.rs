//! The first program of the book: a pendulum whose energy explodes.

fn main() {
    let (mut theta, mut omega) = (1.0_f64, 0.0_f64); // released at 1 rad, at rest
    let h = 0.01; // the step, in seconds
    for step in 0..=100_000 {
        if [0, 100, 1_000, 10_000, 100_000].contains(&step) {
            let energy = omega * omega / 2.0 + 9.81 * (1.0 - theta.cos());
            println!("after {:4} s: {energy:7.3} J", h * f64::from(step));
        }
        let omega_new = omega - h * 9.81 * theta.sin(); // the force changes the velocity
        theta += h * omega; // the velocity changes the angle
        omega = omega_new;
    }
}

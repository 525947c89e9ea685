// differential-equations 0.7.0: q'' = cos t from rest at 0, so that q(1) = 1 - cos 1.
use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

struct Driven;

impl ODE<f64, [f64; 2]> for Driven {
    fn diff(&self, t: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [y[1], t.cos()];
    }
}

fn solve(name: &str, n: u32, mut method: impl OrdinaryNumericalMethod<f64, [f64; 2]>) {
    method.init(&Driven, 0.0, 1.0, &[0.0, 0.0]).unwrap();
    (0..n).for_each(|_| drop(method.step(&Driven).unwrap()));
    println!("{name}, {n} steps: q(1) = {:.9}, right {:.9}", method.y()[0], 1.0 - 1f64.cos());
}

fn main() {
    for n in [10, 20, 40] {
        let h = 1.0 / f64::from(n);
        solve("velocity_verlet", n, SymplecticIntegrator::velocity_verlet(h));
        solve("ruth_forest", n, SymplecticIntegrator::ruth_forest(h));
        solve("heun", n, ExplicitRungeKutta::heun(h));
    }
}

// differential-equations 0.7.0: y' = -100 y, y(0) = 1, in ten steps of 0.1, four methods.
use differential_equations::methods::{ExplicitRungeKutta, ImplicitRungeKutta};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

struct Decay;

impl ODE<f64, [f64; 1]> for Decay {
    fn diff(&self, _: f64, y: &[f64; 1], rate: &mut [f64; 1]) {
        rate[0] = -100.0 * y[0];
    }
}

fn steps(name: &str, mut method: impl OrdinaryNumericalMethod<f64, [f64; 1]>) {
    method.init(&Decay, 0.0, 1.0, &[1.0]).unwrap();
    let mut show = || (method.step(&Decay).unwrap(), method.y()[0]).1;
    println!("{name}: {:.4e}, {:.4e}, {:.4e} …", show(), show(), show());
}

fn main() {
    steps("crank_nicolson", ImplicitRungeKutta::crank_nicolson(0.1));
    steps("trapezoidal", ImplicitRungeKutta::trapezoidal(0.1));
    steps("heun, explicit", ExplicitRungeKutta::heun(0.1));
    let r = (1.0 - 5.0) / (1.0 + 5.0f64); // (1 + z/2)/(1 - z/2) at z = -10
    println!("Crank and Nicolson's: {r:.4e}, {:.4e}, {:.4e} …", r * r, r * r * r);
}

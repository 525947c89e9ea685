// ode_solvers 0.6.2: y' = cos t, y(0) = 0, so that y(1) = sin 1, by Dop853 in fixed steps.
use ode_solvers::dop_shared::OutputType::Sparse;
use ode_solvers::{Dop853, System, Vector1};

struct Cosine;

impl System<f64, Vector1<f64>> for Cosine {
    fn system(&self, t: f64, _: &Vector1<f64>, rate: &mut Vector1<f64>) {
        rate[0] = t.cos();
    }
}

fn main() {
    for n in [10, 20, 40] {
        let (h, no, y0) = (1.0 / f64::from(n), u32::MAX, Vector1::new(0.0));
        let (tol, s, b, c, d) = (1e100, 0.9, 0.0, 0.2, 10.0);
        let mut dop853 =
            Dop853::from_param(Cosine, 0.0, 1.0, h, y0, tol, tol, s, b, c, d, h, h, no, no, Sparse);
        dop853.integrate().unwrap();
        let y = dop853.y_out().last().unwrap()[0];
        println!("{n} steps: y(1) = {y:.9}, right {:.9}", 1f64.sin());
    }
}

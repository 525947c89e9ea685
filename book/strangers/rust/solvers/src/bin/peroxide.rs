//! peroxide 0.43.1, `BasicODESolver`. It has no other states than those at its steps, of which the
//! last lies behind the end. Those that are asked for are reached from the step before, by RK4 in a
//! thousand parts of that step, whose error is rounding. It goes forward alone, and looks for no
//! events.

use peroxide::fuga::{
    BasicODESolver, ODEIntegrator, ODEProblem, ODESolver, BS23, DP45, RKF45, RKF78, TSIT45,
};
use strangers_protocol::solver::{serve, Run, Solver, States};
use strangers_protocol::Pendulum;

struct Equations<'a>(&'a Run);

impl ODEProblem for Equations<'_> {
    fn rhs(&self, t: f64, y: &[f64], rate: &mut [f64]) -> anyhow::Result<()> {
        rate.copy_from_slice(&self.0.rate(t, [y[0], y[1]]));
        Ok(())
    }
}

/// The motion from y at t, for so long.
fn onward(pendulum: &Pendulum, mut t: f64, mut y: [f64; 2], long: f64) -> [f64; 2] {
    let h = long / 1000.0;
    let add = |y: [f64; 2], h: f64, k: [f64; 2]| [y[0] + h * k[0], y[1] + h * k[1]];
    for _ in 0..if long == 0.0 { 0 } else { 1000 } {
        let rate = |t: f64, y: [f64; 2]| [y[1], pendulum.force(y[0], t)];
        let k1 = rate(t, y);
        let k2 = rate(t + 0.5 * h, add(y, 0.5 * h, k1));
        let k3 = rate(t + 0.5 * h, add(y, 0.5 * h, k2));
        let k4 = rate(t + h, add(y, h, k3));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        t += h;
    }
    y
}

fn states(run: &Run, method: impl ODEIntegrator) -> States {
    let span = (run.from(), run.end());
    let solver = BasicODESolver::new(method);
    let found = solver.solve(&Equations(run), span, run.first(), &run.start);
    let (t, y) = found.map_err(|why| why.to_string())?;
    let uncounted = Pendulum { forces: Default::default(), ..run.pendulum };
    let mut k = 0;
    let mut rows = Vec::new();
    for asked in &run.grid[1..] {
        while k + 1 < t.len() && t[k + 1] <= *asked {
            k += 1;
        }
        if t[t.len() - 1] < *asked || *asked < t[k] {
            return Err(format!("it goes from {} to {}", t[0], t[t.len() - 1]));
        }
        rows.push(onward(&uncounted, t[k], [y[k][0], y[k][1]], asked - t[k]));
    }
    Ok(rows)
}

macro_rules! solver {
    ($name:ident) => {
        Solver {
            name: stringify!($name),
            solve: |run| {
                // Steps as long as the run, and as short as 10⁻¹² of it.
                let longest = (run.end() - run.from()).abs();
                states(run, $name::new(run.tol, 0.9, 1e-12 * longest, longest, 100))
            },
            crossings: None,
        }
    };
}

fn main() {
    serve(vec![solver!(BS23), solver!(RKF45), solver!(DP45), solver!(TSIT45), solver!(RKF78)]);
}

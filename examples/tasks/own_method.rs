//! A method of one's own: Ralston's, of order 2.

use pendula::{Error, Grid, Method, Motion, Pendulum, Phase, System, integrate};

struct Ralston;

impl<S: System> Method<S> for Ralston {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let k1 = system.rate(t, z);
        let k2 = system.rate(t + h * 2.0 / 3.0, z + k1 * (h * 2.0 / 3.0));
        z + k1 * (h / 4.0) + k2 * (h * 3.0 / 4.0)
    }
}

pub fn main() -> Result<(), Error> {
    let exact = Motion::new(&Pendulum::PAPER, Phase::at_rest(1.0))?.at(1.0);
    let end = integrate(&Pendulum::PAPER, &Ralston, [1.0, 0.0], &Grid::with_duration(1e-3, 1.0)?);
    println!("{:.1e} rad off", (end - exact).theta.abs());
    assert!((end - exact).theta.abs() < 1e-5);
    Ok(())
}

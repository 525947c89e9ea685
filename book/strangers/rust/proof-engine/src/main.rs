//! proof-engine 0.3.2: the ODE solver, the numerical module and the steps of its points and bodies.
//! Where a step is given an acceleration only, that is the one at its start. What works in f32
//! says so.

use glam::{Vec2, Vec3};
use proof_engine::game::cloth_rope;
use proof_engine::math::{numerical, springs};
use proof_engine::physics;
use proof_engine::solver::{OdeMethod, OdeSolver, OdeState, OdeSystem};
use std::sync::atomic::{AtomicUsize, Ordering};
use strangers_protocol::{Integrator, Path, Pendulum, Request, serve};

/// The solver wants its system to be shared between threads.
struct Equations {
    gl: f64,
    a: f64,
    w: f64,
    forces: AtomicUsize,
}

impl OdeSystem for Equations {
    fn dimension(&self) -> usize {
        2
    }

    fn evaluate(&self, t: f64, y: &[f64], rate: &mut [f64]) {
        self.forces.fetch_add(1, Ordering::Relaxed);
        rate[0] = y[1];
        rate[1] = self.a * (self.w * t).cos() - self.gl * y[0].sin();
    }
}

fn solver(method: OdeMethod, pendulum: &Pendulum, asked: &Request) -> Path {
    let equations =
        Equations { gl: pendulum.gl, a: pendulum.a, w: pendulum.w, forces: AtomicUsize::new(0) };
    let mut solver = OdeSolver::new(method, asked.h);
    solver.dt_min = asked.h;
    solver.dt_max = asked.h; // for the one with step control
    let mut state = OdeState { t: 0.0, y: vec![asked.theta, asked.omega] };
    let step = |_| {
        state = solver.step(&equations, &state);
        [state.y[0], state.y[1]]
    };
    let path = (0..asked.n).map(step).collect();
    pendulum.forces.set(equations.forces.load(Ordering::Relaxed));
    Ok(path)
}

type General = fn(&dyn Fn(f64, &[f64]) -> Vec<f64>, &[f64], f64, usize) -> Vec<Vec<f64>>;

fn general(method: General, pendulum: &Pendulum, asked: &Request) -> Path {
    let rate = |t: f64, y: &[f64]| vec![y[1], pendulum.force(y[0], t)];
    let states = method(&rate, &[asked.theta, asked.omega], asked.h, asked.n);
    Ok(states[1..].iter().map(|y| [y[0], y[1]]).collect())
}

/// `old` is the place before the start, one step back along the velocity.
fn positions(asked: &Request, mut step: impl FnMut(usize) -> [f32; 2]) -> Path {
    let state = |i| step(i).map(f64::from);
    Ok((0..asked.n).map(state).map(|[now, old]| [now, (now - old) / asked.h]).collect())
}

fn main() {
    let mut all = vec![
        Integrator::new("numerical::euler", true, |p, r| {
            general(|f, y, h, n| numerical::euler(f, 0.0, y, h, n), p, r)
        }),
        Integrator::new("numerical::rk4", true, |p, r| {
            general(|f, y, h, n| numerical::rk4(f, 0.0, y, h, n), p, r)
        }),
        Integrator::new("numerical::adams_bashforth4", true, |p, r| {
            general(|f, y, h, n| numerical::adams_bashforth4(f, 0.0, y, h, n), p, r)
        }),
        Integrator::new("numerical::verlet", false, |p, r| {
            let states = numerical::verlet(r.theta, r.omega, |x| p.force(x, 0.0), r.h, r.n);
            Ok(states[1..].iter().map(|&(_, x, v)| [x, v]).collect())
        }),
        Integrator::new("numerical::leapfrog", false, |p, r| {
            let force = |x: &[f64]| vec![p.force(x[0], 0.0)];
            let states = numerical::leapfrog(&[r.theta], &[r.omega], force, r.h, r.n);
            Ok(states[1..].iter().map(|(x, v)| [x[0], v[0]]).collect())
        }),
        // f32
        Integrator::new("physics::verlet_step", true, |p, r| {
            let (mut x, mut v) = (Vec2::new(r.theta as f32, 0.0), Vec2::new(r.omega as f32, 0.0));
            let step = |i| {
                let force = p.force(x.x.into(), i as f64 * r.h) as f32;
                (x, v) = physics::verlet_step(x, v, Vec2::new(force, 0.0), r.h as f32);
                [x.x.into(), v.x.into()]
            };
            Ok((0..r.n).map(step).collect())
        }),
        // f32
        Integrator::new("physics::rk4_2d", false, |p, r| {
            let (mut x, mut v) = (Vec2::new(r.theta as f32, 0.0), Vec2::new(r.omega as f32, 0.0));
            let step = |_| {
                let force = |x: Vec2, _| Vec2::new(p.force(x.x.into(), 0.0) as f32, 0.0);
                (x, v) = physics::rk4_2d(x, v, 1.0, r.h as f32, force);
                [x.x.into(), v.x.into()]
            };
            Ok((0..r.n).map(step).collect())
        }),
        // f32
        Integrator::new("springs::VerletPoint", true, |p, r| {
            let at = |x: f64| Vec3::new(x as f32, 0.0, 0.0);
            let mut point = springs::VerletPoint::new(at(r.theta));
            point.prev_pos = at(r.theta - r.omega * r.h);
            positions(r, |i| {
                let force = p.force(point.pos.x.into(), i as f64 * r.h);
                point.integrate(at(force), r.h as f32);
                [point.pos.x, point.prev_pos.x]
            })
        }),
        // f32
        Integrator::new("cloth_rope::VerletPoint", true, |p, r| {
            let at = |x: f64| Vec3::new(x as f32, 0.0, 0.0);
            let mut point = cloth_rope::VerletPoint::new(at(r.theta), 1.0);
            point.old_position = at(r.theta - r.omega * r.h);
            positions(r, |i| {
                let force = p.force(point.position.x.into(), i as f64 * r.h);
                point.apply_force(at(force));
                point.integrate(r.h as f32);
                [point.position.x, point.old_position.x]
            })
        }),
    ];
    for (name, method) in [
        ("OdeMethod::Euler", OdeMethod::Euler),
        ("OdeMethod::RungeKutta4", OdeMethod::RungeKutta4),
        ("OdeMethod::RungeKutta45", OdeMethod::RungeKutta45),
        ("OdeMethod::ImplicitEuler", OdeMethod::ImplicitEuler),
        ("OdeMethod::CrankNicolson", OdeMethod::CrankNicolson),
        ("OdeMethod::Verlet", OdeMethod::Verlet),
        ("OdeMethod::Leapfrog", OdeMethod::Leapfrog),
    ] {
        all.push(Integrator::new(name, true, move |p, r| solver(method, p, r)));
    }
    serve(all);
}

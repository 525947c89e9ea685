//! rapier2d-f64 0.36.1. One body of mass 1 without collider, gravity or damping; its x is the angle
//! and the force is set before each step. As it comes (four solver iterations a step), and with
//! one.

use rapier2d_f64::prelude::*;
use strangers_protocol::{Integrator, Path, Pendulum, Request, serve};

fn steps(iterations: Option<usize>, pendulum: &Pendulum, asked: &Request) -> Path {
    if asked.h < 0.0 {
        return Err("rapier does not step back".into()); // a negative dt moves nothing
    }
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0);
    world.integration_parameters.dt = asked.h;
    if let Some(iterations) = iterations {
        world.integration_parameters.num_solver_iterations = iterations;
    }
    let body = RigidBodyBuilder::dynamic()
        .translation(Vector::new(asked.theta, 0.0))
        .linvel(Vector::new(asked.omega, 0.0))
        .additional_mass(1.0)
        .can_sleep(false);
    let body = world.insert_body(body);
    let step = |i| {
        let it = &mut world.bodies[body];
        let force = pendulum.force(it.translation().x, i as f64 * asked.h);
        it.reset_forces(true);
        it.add_force(Vector::new(force, 0.0), true);
        world.step();
        let it = &world.bodies[body];
        [it.translation().x, it.linvel().x]
    };
    Ok((0..asked.n).map(step).collect())
}

fn main() {
    serve(vec![
        Integrator::new("PhysicsWorld::step", true, |pendulum, asked| steps(None, pendulum, asked)),
        Integrator::new("PhysicsWorld::step/1", true, |pendulum, asked| {
            steps(Some(1), pendulum, asked)
        }),
    ]);
}

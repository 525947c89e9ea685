//! oxiphysics-gpu 0.1.2, its steps on the CPU. One particle of mass 1 whose x is the angle; the
//! force is evaluated before each step, and where the documentation asks for it, again.

use oxiphysics_gpu::fluid_sim_gpu::{SphParticle, gpu_particle_integrate_verlet};
use oxiphysics_gpu::gpu_md_solver::{GpuMdBuffer, verlet_integrate_gpu};
use oxiphysics_gpu::kernels::rigid::{RigidBodyState, integrate_semi_implicit};
use oxiphysics_gpu::parallel::parallel_verlet_step;
use strangers_protocol::{Integrator, serve};

fn main() {
    serve(vec![
        // In single precision.
        Integrator::new("verlet_integrate_gpu", true, |pendulum, asked| {
            let mut buffer = GpuMdBuffer::new(1);
            buffer.atoms[0].pos[0] = asked.theta as f32;
            buffer.atoms[0].vel[0] = asked.omega as f32;
            let step = |i| {
                let theta = f64::from(buffer.atoms[0].pos[0]);
                buffer.atoms[0].force[0] = pendulum.force(theta, i as f64 * asked.h) as f32;
                verlet_integrate_gpu(&mut buffer, asked.h as f32);
                [buffer.atoms[0].pos[0].into(), buffer.atoms[0].vel[0].into()]
            };
            Ok((0..asked.n).map(step).collect())
        }),
        Integrator::new("gpu_particle_integrate_verlet", true, |pendulum, asked| {
            let mut particle = [SphParticle::new([asked.theta, 0.0, 0.0], 1.0)];
            particle[0].density = 1.0;
            particle[0].velocity[0] = asked.omega;
            let step = |i| {
                particle[0].force[0] = pendulum.force(particle[0].position[0], i as f64 * asked.h);
                gpu_particle_integrate_verlet(&mut particle, asked.h, asked.h);
                [particle[0].position[0], particle[0].velocity[0]]
            };
            Ok((0..asked.n).map(step).collect())
        }),
        // "call again after recomputing forces for the second half", to the letter.
        Integrator::new("parallel_verlet_step", true, |pendulum, asked| {
            let mut x = vec![[asked.theta, 0.0, 0.0]];
            let mut v = vec![[asked.omega, 0.0, 0.0]];
            let step = |i| {
                for half in [0, 1] {
                    let force = pendulum.force(x[0][0], (i + half) as f64 * asked.h);
                    parallel_verlet_step(&mut x, &mut v, &[[force, 0.0, 0.0]], &[1.0], asked.h);
                }
                [x[0][0], v[0][0]]
            };
            Ok((0..asked.n).map(step).collect())
        }),
        Integrator::new("integrate_semi_implicit", true, |pendulum, asked| {
            let mut body = RigidBodyState::at_rest([asked.theta, 0.0, 0.0], 1.0);
            body.velocity[0] = asked.omega;
            let step = |i| {
                let force = pendulum.force(body.position[0], i as f64 * asked.h);
                body = integrate_semi_implicit(&body, [force, 0.0, 0.0], [0.0; 3], asked.h);
                [body.position[0], body.velocity[0]]
            };
            Ok((0..asked.n).map(step).collect())
        }),
    ]);
}

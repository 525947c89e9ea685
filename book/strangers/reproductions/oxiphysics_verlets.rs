// oxiphysics-gpu 0.1.2: x'' = -x from x = 1, v = 0, so that x(1) = cos 1, beside velocity Verlet.
use oxiphysics_gpu::fluid_sim_gpu::{SphParticle, gpu_particle_integrate_verlet};
use oxiphysics_gpu::gpu_md_solver::{GpuMdBuffer, verlet_integrate_gpu};

fn main() {
    for n in [10, 20, 40] {
        let h = 1.0 / f64::from(n);
        let mut buffer = GpuMdBuffer::new(1);
        buffer.atoms[0].pos[0] = 1.0;
        let mut sph = [SphParticle::new([1.0, 0.0, 0.0], 1.0)];
        sph[0].density = 1.0;
        let (mut x, mut v) = (1.0, 0.0);
        for _ in 0..n {
            buffer.atoms[0].force[0] = -buffer.atoms[0].pos[0];
            verlet_integrate_gpu(&mut buffer, h as f32);
            sph[0].force[0] = -sph[0].position[0];
            gpu_particle_integrate_verlet(&mut sph, h, h);
            (x, v) = (x + h * (v - h / 2.0 * x), v - h / 2.0 * x);
            v -= h / 2.0 * x;
        }
        let (gpu, particle) = (buffer.atoms[0].pos[0], sph[0].position[0]);
        println!("{n} steps: velocity Verlet {x:.5}, right {:.5}", 1f64.cos());
        println!("  verlet_integrate_gpu {gpu:.5}, gpu_particle_integrate_verlet {particle:.5}");
    }
}

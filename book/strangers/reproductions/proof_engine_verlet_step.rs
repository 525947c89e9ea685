// proof-engine 0.3.2: x'' = -x from x = 1, v = 0, so that x(1) = cos 1, beside velocity Verlet.
use glam::Vec2;
use proof_engine::physics::verlet_step;

fn main() {
    for n in [10, 20, 40] {
        let h = 1.0 / n as f32;
        let (mut x, mut v) = (Vec2::X, Vec2::ZERO);
        let (mut q, mut p) = (1.0, 0.0);
        for _ in 0..n {
            (x, v) = verlet_step(x, v, -x, h);
            p -= h / 2.0 * q;
            q += h * p;
            p -= h / 2.0 * q;
        }
        println!("{n} steps: theirs {:.5}, velocity Verlet {q:.5}, right {:.5}", x.x, 1f32.cos());
    }
}

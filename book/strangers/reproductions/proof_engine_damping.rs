// proof-engine 0.3.2: a point of cloth or rope, no force, x = 0, v = 1, so that x(1) = 1.
use glam::Vec3;
use proof_engine::game::cloth_rope::VerletPoint;

fn main() {
    for n in [10, 100, 1000] {
        let h = 1.0 / n as f32;
        let mut point = VerletPoint::new(Vec3::ZERO, 1.0);
        point.old_position = Vec3::X * -h;
        (0..n).for_each(|_| point.integrate(h));
        println!("{n} steps of {h}: x(1) = {:.4}, right 1.0000", point.position.x);
    }
}

// oxiphysics-gpu 0.1.2: x = 0, v = 1 and no force; a step of 0.1, in its two halves as documented.
use oxiphysics_gpu::parallel::parallel_verlet_step;

fn main() {
    let (mut x, mut v) = (vec![[0.0; 3]], vec![[1.0, 0.0, 0.0]]);
    for half in ["first", "second"] {
        parallel_verlet_step(&mut x, &mut v, &[[0.0; 3]], &[1.0], 0.1);
        println!("after the {half} half: x = {:.3}; right at the end: 0.100", x[0][0]);
    }
}

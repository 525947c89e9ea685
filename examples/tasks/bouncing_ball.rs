//! A ball that bounces: each walk ends at an event, and the next begins there.

use pendula::adaptive::{Adaptive, Direction, Tolerance};
use pendula::methods::DormandPrince;
use pendula::systems::FromRate;
use pendula::Error;

pub fn main() -> Result<(), Error> {
    let fall = FromRate::new(|_t, [_, velocity]: [f64; 2]| [velocity, -9.81]);
    let adaptive = Adaptive::new(DormandPrince, Tolerance::uniform(1e-9)?);
    let (mut t, mut z) = (0.0, [1.0, 0.0]);
    for bounce in 1..=5 {
        let mut walk = adaptive.steps(&fall, z, t, t + 10.0)?;
        let hit = walk.crossings(Direction::Falling, |_t, z| z[0]).next().expect("it falls")?;
        println!("bounce {bounce} at {:.4} s", hit.t);
        (t, z) = (hit.t, [0.0, -0.8 * hit.z[1]]);
    }
    // Each flight is 0.8 of the one before.
    let exact = (2.0_f64 / 9.81).sqrt() * (1.0 + 2.0 * (0.8 + 0.64 + 0.512 + 0.4096));
    assert!((t - exact).abs() < 1e-6);
    Ok(())
}

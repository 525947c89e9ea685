//! Hashes of long runs of every method: the same on every machine, in debug and in release.

use pendula::{Grid, Info, Pendulum, Phase, integrate, integrate_fast};

use crate::experiments::in_paper;

/// FNV-1a of every state's bits over four runs of `steps` steps: swinging, nearly over the top,
/// rotating, and starting many turns from zero; with L ≠ 1 and a step that is not a power of two.
fn hash(steps: u64, run: impl Fn(&Pendulum, Phase, &Grid, &mut dyn FnMut(u64, f64, Phase))) -> u64 {
    let pendulum = Pendulum::new(9.81, 1.3, 0.7).expect("parameters in range");
    let grid = Grid::new(0.01, steps).expect("a positive step");
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for (theta, omega) in [(1.0, 0.0), (3.1, 0.2), (-0.3, 12.0), (1000.5, -1.0)] {
        run(&pendulum, Phase { theta, omega }, &grid, &mut |_, _, z: Phase| {
            for bits in [z.theta.to_bits(), z.omega.to_bits()] {
                hash = (hash ^ bits).wrapping_mul(0x0100_0000_01b3);
            }
        });
    }
    hash
}

macro_rules! hashes {
    ($($module:ident::$method:ident,)+) => {{
        let mut table = String::from("| Method | in steps | in seconds |\n| --- | --- | --- |\n");
        $({
            use pendula::methods::$method;
            // Without optimisation a million steps of every method would take minutes.
            let steps = if in_paper(&$method) { 250_000 } else { 25_000 };
            let in_steps = hash(steps, |pendulum, start, grid, mut watch| {
                integrate_fast(pendulum, &$method, start, grid, &mut watch);
            });
            let in_seconds = hash(steps, |pendulum, start, grid, mut watch| {
                integrate(pendulum, &$method, start, grid, &mut watch);
            });
            let title = $method.info().title;
            table += &format!("| {title} | `{in_steps:016x}` | `{in_seconds:016x}` |\n");
        })+
        table
    }};
}

/// A row for each method: the hash of its runs with time in steps, and with time in seconds.
pub fn bits() -> String {
    pendula::for_each_method!(hashes)
}

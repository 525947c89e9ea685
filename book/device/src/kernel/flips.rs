//! The program that takes the steps of double pendulums until they turn over.

use pendula::fast::{DoublePendulums, DoublePhases, is_below};
use pendula::systems::Numbers;
use pendula::{DoublePendulum, Method};

use super::{HEAD, Program, Recording, numbers};
use crate::trace::Traced;

/// The kernel, and how many of the buffers it is given.
pub const KERNELS: [(&str, usize); 1] = [("flips", 2)];

/// The buffers, by their indices in [`rows`].
pub mod buffer {
    /// States and carries, between launches.
    pub const NUMBERS: usize = 0;
    /// Steps taken, and whether both rods are still below.
    pub const FLIPS: usize = 1;
}

/// The rows of each buffer, of as many columns as pendulums: the numbers, and the steps after which
/// both rods were below the upward vertical beside a 1, which is 0 from the first flip on.
pub const fn rows(numbers: usize) -> [usize; 2] {
    [numbers, 2]
}

/// What a method needs: steps that can be recorded, and a carry that can be copied.
pub trait Recordable:
    Method<DoublePendulums<f64>, Carry: Numbers>
    + Method<DoublePendulums<Traced>, Carry: Numbers<Traced>>
{
}

impl<M> Recordable for M where
    M: Method<DoublePendulums<f64>, Carry: Numbers>
        + Method<DoublePendulums<Traced>, Carry: Numbers<Traced>>
{
}

/// The numbers of `state` and carry, before the first step `h` (s) of `method`.
pub fn begin<M: Recordable>(
    method: &M,
    double: &DoublePendulum,
    state: [f64; 4],
    h: f64,
) -> Vec<f64> {
    let (system, state) = (DoublePendulums::new(*double), DoublePhases(state));
    numbers(state, method.start(&system, 0.0, h, state))
}

/// The program for steps `h` (s) of `method` for `double`; `None` if they depend on values.
///
/// A pendulum that has turned over stays where it is, so that no angle leaves the range of the
/// sine.
pub fn program<M: Recordable>(method: &M, double: &DoublePendulum, h: f64) -> Option<Program> {
    let step = Recording::of(&[], |_, z: DoublePhases<Traced>, mut carry| {
        let z = method.step(&DoublePendulums::new(*double), 0.0, h, z, &mut carry);
        (z, carry, [is_below(z).place()])
    })?;
    let [below] = step.looks;
    let mut source = String::from(HEAD);
    source.push_str(
        "kernel void flips(const ulong pendulums, const ulong count, global double *numbers, \
         global double *flips) {\n    const ulong i = get_global_id(0);\n    if (i >= pendulums) \
         return;\n    double taken = flips[i], below = flips[pendulums + i];\n",
    );
    step.write_loads(&mut source);
    source.push_str("    for (ulong n = 0; n < count && below != 0.0; n++) {\n");
    step.write_values(&mut source, &[&*step.next, &[below]].concat());
    source.push_str(&format!("        below = {} ? 1.0 : 0.0;\n", step.term(below)));
    source.push_str("        taken += below;\n");
    step.write_moves(&mut source, &step.all());
    source.push_str("    }\n    flips[i] = taken;\n    flips[pendulums + i] = below;\n");
    step.write_stores(&mut source);
    source.push_str("}\n");
    let (numbers, operations) = (step.next.len(), step.operations());
    Some(Program { source, numbers, operations })
}

//! The program that takes the steps of an ensemble of pendulums.

use std::fmt::Write as _;

use pendula::internals::{ReducedPhase, ScaledPendulum, energy_in_lanes};
use pendula::{Grid, Hamiltonian, Method, Pendulum, Phase};

use super::{HEAD, Program, Recording, numbers};
use crate::numbers::Numbers;
use crate::trace::{Place, Traced};

/// The kernels, and how many of the buffers each is given.
pub const KERNELS: [(&str, usize); 2] = [("steps", 3), ("watched_steps", 4)];

/// The buffers, by their indices in [`rows`].
pub mod buffer {
    /// Of [`CONSTANTS`](super::CONSTANTS).
    pub const CONSTANTS: usize = 0;
    /// States and carries, between launches.
    pub const NUMBERS: usize = 1;
    /// Angles and angular velocities.
    pub const PHASES: usize = 2;
    /// Largest energy errors and angles.
    pub const WATCHED: usize = 3;
}

/// The rows of each buffer, of as many columns as pendulums: constants, numbers, the angle (rad)
/// and angular velocity (rad/s) after the last step, the largest energy error (J) and the largest
/// angle (rad) after any step.
pub const fn rows(numbers: usize) -> [usize; 4] {
    [CONSTANTS.len(), numbers, 2, 2]
}

/// What each pendulum has of its own: −K, and for its energy m L² (kg m²), m g L (J) and the energy
/// at the start (J).
pub const CONSTANTS: [&str; 4] = ["minus_k", "inertia", "depth", "initial"];

/// The step h (s), which all have in common.
const STEP: &str = "h";

/// What a method needs to run on a device: steps that can be recorded, and a carry that can be
/// copied.
pub trait Recordable:
    Method<ScaledPendulum, Carry: Numbers> + Method<ScaledPendulum<Traced>, Carry: Numbers<Traced>>
{
}

impl<M> Recordable for M where
    M: Method<ScaledPendulum, Carry: Numbers>
        + Method<ScaledPendulum<Traced>, Carry: Numbers<Traced>>
{
}

/// A pendulum where it begins: its [`CONSTANTS`], and the numbers of its state and its carry.
#[derive(Clone, Debug)]
pub struct Begun {
    /// As the list of their names.
    pub constants: [f64; CONSTANTS.len()],
    /// As many as [`Program::numbers`].
    pub numbers: Vec<f64>,
}

/// `pendulum` at `start`, before the first step of `method` along `grid`; `None` where the library
/// does not run it in steps either, see [`ScaledPendulum::new`].
pub fn begin<M: Recordable>(
    method: &M,
    pendulum: &Pendulum,
    start: Phase,
    grid: &Grid,
) -> Option<Begun> {
    let scaled = ScaledPendulum::new::<M>(pendulum, grid, start)?;
    let state = scaled.from_phase(start);
    let carry = method.start(&scaled, 0.0, 1.0, state);
    let constants =
        [scaled.minus_k(), pendulum.inertia(), pendulum.depth(), pendulum.energy(start)];
    Some(Begun { constants, numbers: numbers(state, carry) })
}

/// The program for `method`, with the kernels `steps` and `watched_steps`; the second looks at the
/// energy after each step. `None` if the steps depend on values, as those of an implicit method do,
/// which sweeps until its equations are solved.
pub fn program<M: Recordable>(method: &M) -> Option<Program> {
    let [minus_k, inertia, depth, initial] = CONSTANTS;
    let parameters = [minus_k, inertia, depth, initial, STEP];
    let recording = Recording::of(&parameters, |variables, z: ReducedPhase<Traced>, mut carry| {
        let system = ScaledPendulum::from_parameter(variables[0], f64::NAN);
        let z = method.step(&system, 0.0, 1.0, z, &mut carry);
        (z, carry, looks(variables, z))
    })?;
    Some(written(&recording))
}

/// A step after which angle, angular velocity and energy can be looked at.
type Step = Recording<3>;

/// The angle (rad), the angular velocity (rad/s) and the energy (J) of a state.
fn looks(variables: &[Traced], z: ReducedPhase<Traced>) -> [Place; 3] {
    let [_, inertia, depth, _, h] = *variables else { unreachable!("the constants and the step") };
    let (theta, omega) = (z.angle(), z.velocity() / h);
    let energy = energy_in_lanes([inertia, depth], theta, omega);
    [theta, omega, energy].map(Traced::place)
}

fn written(step: &Step) -> Program {
    let mut source = String::from(HEAD);
    write_steps(step, &mut source);
    write_watched_steps(step, &mut source);
    Program { source, numbers: step.next.len(), operations: step.operations() }
}

/// Writes the steps, without a look at them: before the last one only what later steps need.
fn write_steps(step: &Step, out: &mut String) {
    let read = step.read_by_later_steps();
    let next: Vec<Place> = read.iter().map(|&i| step.next[i]).collect();
    let [theta, omega, _] = step.looks;
    write_head(step, out, "steps", "");
    out.push_str("    double theta, omega;\n    for (ulong n = 1; n < count; n++) {\n");
    step.write_values(out, &next);
    step.write_moves(out, &read);
    out.push_str("    }\n    {\n");
    step.write_values(out, &[&*step.next, &[theta, omega]].concat());
    write_angle_and_velocity(step, out);
    step.write_moves(out, &step.all());
    out.push_str("    }\n");
    write_stores(step, out);
}

/// Writes the steps, with a look at the energy after each.
fn write_watched_steps(step: &Step, out: &mut String) {
    let [.., energy] = step.looks;
    write_head(step, out, "watched_steps", ", global double *watched");
    out.push_str(
        "    double theta, omega;\n    double largest = watched[i], farthest = watched[pendulums \
         + i];\n    for (ulong n = 0; n < count; n++) {\n",
    );
    step.write_values(out, &[&*step.next, &step.looks].concat());
    write_angle_and_velocity(step, out);
    let _ = writeln!(out, "        const double error = fabs({} - initial);", step.term(energy));
    // A NaN stays.
    out.push_str("        largest = error > largest || isnan(error) ? error : largest;\n");
    out.push_str("        farthest = fabs(theta) > farthest ? fabs(theta) : farthest;\n");
    step.write_moves(out, &step.all());
    out.push_str("    }\n    watched[i] = largest;\n    watched[pendulums + i] = farthest;\n");
    write_stores(step, out);
}

fn write_angle_and_velocity(step: &Step, out: &mut String) {
    let [theta, omega, _] = step.looks.map(|place| step.term(place));
    let _ = writeln!(out, "        theta = {theta};\n        omega = {omega};");
}

fn write_head(step: &Step, out: &mut String, name: &str, more: &str) {
    let _ = writeln!(
        out,
        "kernel void {name}(const ulong pendulums, const ulong count, const double {STEP}, global \
         const double *constants, global double *numbers, global double *phases{more}) {{\n    \
         const ulong i = get_global_id(0);\n    if (i >= pendulums) return;"
    );
    for (index, name) in CONSTANTS.iter().enumerate() {
        let _ = writeln!(out, "    const double {name} = constants[{index} * pendulums + i];");
    }
    step.write_loads(out);
}

fn write_stores(step: &Step, out: &mut String) {
    step.write_stores(out);
    out.push_str("    phases[i] = theta;\n    phases[pendulums + i] = omega;\n}\n\n");
}

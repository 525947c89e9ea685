//! Ensembles of pendulums on a device.

use std::num::NonZeroU64;

use pendula::integrate::Every;
use pendula::internals::sine::half_turn;
use pendula::metrics::EnergyDrift;
use pendula::{
    AnyMethod, Ensemble, Grid, METHODS, Observer, Pendulum, Phase, for_each_method, methods,
};

use crate::Error;
use crate::kernel::Program;
use crate::kernel::steps::{self, Begun, CONSTANTS, buffer};
use crate::opencl::{Device, Session};

/// A method of the library on a device.
#[derive(Clone, Copy, Debug)]
pub struct OnDevice {
    /// The method on the host, which takes the steps that the device does not.
    pub host: &'static dyn AnyMethod,
    /// [`steps::program`] for it.
    pub program: fn() -> Option<Program>,
    /// [`steps::begin`] for it.
    pub begin: fn(&Pendulum, Phase, &Grid) -> Option<Begun>,
}

/// Program and begin of a method.
type Steps = (fn() -> Option<Program>, fn(&Pendulum, Phase, &Grid) -> Option<Begun>);

// By their types: what is recorded is a method's own code, with a number of another type.
macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        const STEPS: &[Steps] = &[$((
            || steps::program(&methods::$method),
            |pendulum, start, grid| steps::begin(&methods::$method, pendulum, start, grid),
        ),)+];
    };
}
for_each_method!(collect);

/// Every method of the library, in its order; whether its steps run on a device, its program says.
pub fn methods() -> impl Iterator<Item = OnDevice> {
    // From the library's list: a trait object made here would compile each time loop once more.
    let pairs = METHODS.iter().zip(STEPS);
    pairs.map(|(&host, &(program, begin))| OnDevice { host, program, begin })
}

/// The method of the library with this name.
pub fn method_named(name: &str) -> Option<OnDevice> {
    methods().find(|one| one.host.info().name == name)
}

/// Pendulums that are on the device at once, at most: enough for every core of a large card. It
/// bounds the memory here, whatever the number of starts.
const MOST: usize = 1 << 18;

/// What a launch looks at; its number is that of the kernel.
#[derive(Clone, Copy)]
enum Watch {
    /// The last state only.
    End = 0,
    /// The energy after each step, too.
    Energy = 1,
}

/// The steps of a method, compiled for a device.
pub struct Compiled<'d> {
    method: OnDevice,
    program: Program,
    session: Session<'d>,
}

impl Device {
    /// Compiles the steps of `method`.
    pub fn compile(&self, method: OnDevice) -> Result<Compiled<'_>, Error> {
        let name = method.host.info().name;
        let program = (method.program)().ok_or(Error::Method { method: name })?;
        let rows = steps::rows(program.numbers);
        let session = Session::new(self, &program.source, &steps::KERNELS, &rows)?;
        Ok(Compiled { method, program, session })
    }
}

impl Compiled<'_> {
    /// Writes the state of each pendulum at the end of the grid to `ends`, as [`Ensemble::ends`]
    /// does.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends(&mut self, ensemble: &Ensemble<'_>, ends: &mut [Phase]) -> Result<(), Error> {
        let host = self.method.host;
        let (steps, h) = (ensemble.grid().steps(), ensemble.grid().step());
        self.in_batches(
            ensemble,
            ends,
            |session, batch, ends| {
                session.run(Watch::End as usize, batch.len(), steps, &[h])?;
                let phases = session.read(buffer::PHASES, batch.len())?;
                for (column, &i) in batch.iter().enumerate() {
                    ends[i] = phase(&phases, column);
                }
                Ok(())
            },
            |i, end| {
                *end = host.end(ensemble.system(i), ensemble.starts()[i], ensemble.grid());
            },
        )
    }

    /// The same, and to each end the largest energy error (J) of all steps, as [`EnergyDrift`] has
    /// it.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends_and_energy_errors(
        &mut self,
        ensemble: &Ensemble<'_>,
        ends: &mut [(Phase, f64)],
    ) -> Result<(), Error> {
        let host = self.method.host;
        let (steps, h) = (ensemble.grid().steps(), ensemble.grid().step());
        let alone = |i: usize, slot: &mut (Phase, f64)| {
            let pendulum = ensemble.system(i);
            let mut drift = EnergyDrift::new(pendulum);
            let end = host.run(pendulum, ensemble.starts()[i], ensemble.grid(), &mut drift);
            *slot = (end, drift.largest());
        };
        self.in_batches(
            ensemble,
            ends,
            |session, batch, ends| {
                session.run(Watch::Energy as usize, batch.len(), steps, &[h])?;
                let phases = session.read(buffer::PHASES, batch.len())?;
                let watched = session.read(buffer::WATCHED, batch.len())?;
                let (errors, angles) = watched.split_at(batch.len());
                for (column, &i) in batch.iter().enumerate() {
                    // Beyond, the library's sine is another one.
                    if angles[column] <= 2.0 * half_turn::LARGEST {
                        ends[i] = (phase(&phases, column), errors[column]);
                    } else {
                        alone(i, &mut ends[i]);
                    }
                }
                Ok(())
            },
            alone,
        )
    }

    /// Passes every k-th state of each start, from the start on, to the observer of that start, as
    /// [`Ensemble::watch`] does.
    ///
    /// # Panics
    /// If there are not as many observers as starts.
    pub fn watch<O: Observer<Phase>>(
        &mut self,
        ensemble: &Ensemble<'_>,
        every: NonZeroU64,
        observers: &mut [O],
    ) -> Result<(), Error> {
        let host = self.method.host;
        let (grid, h) = (ensemble.grid(), ensemble.grid().step());
        self.in_batches(
            ensemble,
            observers,
            |session, batch, observers| {
                for &i in batch {
                    observers[i].observe(0, 0.0, ensemble.starts()[i]);
                }
                let mut n = 0;
                while grid.steps() - n >= every.get()
                    && batch.iter().any(|&i| !observers[i].is_satisfied())
                {
                    session.run(Watch::End as usize, batch.len(), every.get(), &[h])?;
                    n += every.get();
                    let phases = session.read(buffer::PHASES, batch.len())?;
                    for (column, &i) in batch.iter().enumerate() {
                        if !observers[i].is_satisfied() {
                            observers[i].observe(n, grid.time(n), phase(&phases, column));
                        }
                    }
                }
                Ok(())
            },
            |i, observer| {
                let mut watch = Every::new(every, |n, t, z| {
                    if !observer.is_satisfied() {
                        observer.observe(n, t, z);
                    }
                });
                let _ = host.run(ensemble.system(i), ensemble.starts()[i], grid, &mut watch);
            },
        )
    }

    /// Calls `on_device` for each batch of pendulums, with a session in which they stand at the
    /// start, their indices and all slots; and `alone` for each pendulum that the library does not
    /// run in steps either.
    fn in_batches<T>(
        &mut self,
        ensemble: &Ensemble<'_>,
        slots: &mut [T],
        mut on_device: impl FnMut(&Session<'_>, &[usize], &mut [T]) -> Result<(), Error>,
        mut alone: impl FnMut(usize, &mut T),
    ) -> Result<(), Error> {
        assert_eq!(slots.len(), ensemble.starts().len(), "one slot for each start");
        let capacity = self.session.reserve(slots.len(), MOST)?;
        let mut batch = Vec::with_capacity(capacity);
        let mut begun = Vec::with_capacity(capacity);
        for (i, start) in ensemble.starts().iter().enumerate() {
            match (self.method.begin)(ensemble.system(i), *start, ensemble.grid()) {
                Some(pendulum) => {
                    batch.push(i);
                    begun.push(pendulum);
                }
                None => alone(i, &mut slots[i]),
            }
            let is_last = i + 1 == ensemble.starts().len();
            if !batch.is_empty() && (is_last || batch.len() == capacity) {
                let constants = rows(&begun, CONSTANTS.len(), |pendulum| &pendulum.constants);
                let numbers = rows(&begun, self.program.numbers, |pendulum| &pendulum.numbers);
                let watched = vec![0.0; 2 * batch.len()];
                let buffers = [
                    (buffer::CONSTANTS, &constants),
                    (buffer::NUMBERS, &numbers),
                    (buffer::WATCHED, &watched),
                ];
                for (index, values) in buffers {
                    self.session.write(index, batch.len(), values)?;
                }
                on_device(&self.session, &batch, slots)?;
                batch.clear();
                begun.clear();
            }
        }
        Ok(())
    }
}

/// What all pendulums have, in rows: the first number of each, then the second of each.
fn rows<T>(pendulums: &[T], width: usize, of: impl Fn(&T) -> &[f64]) -> Vec<f64> {
    (0..width)
        .flat_map(|row| pendulums.iter().map(move |one| (row, one)))
        .map(|(row, one)| of(one)[row])
        .collect()
}

/// The state in a column of angles and then angular velocities.
fn phase(phases: &[f64], column: usize) -> Phase {
    Phase { theta: phases[column], omega: phases[phases.len() / 2 + column] }
}

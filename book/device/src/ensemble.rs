//! Ensembles on a device.

use std::num::NonZeroU64;

use pendula::arithmetic::sine::half_turn;
use pendula::fast::Instructions;
use pendula::integrate::Every;
use pendula::metrics::EnergyDrift;
use pendula::{AnyMethod, Ensemble, Grid, Observer, Pendulum, Phase, for_each_method, methods};

use crate::Error;
use crate::kernel::Program;
use crate::kernel::steps::{self, Begun, CONSTANTS, Recordable};
use crate::opencl::{Device, Session};

/// A method whose steps may run on a device. Every one of the library is one; whether it can be
/// recorded, [`program`](OnDevice::program) says.
pub trait OnDevice: AnyMethod {
    /// [`steps::program`].
    fn program(&self) -> Option<Program>;

    /// [`steps::begin`].
    fn begin(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Option<Begun>;
}

impl<M: AnyMethod + Recordable> OnDevice for M {
    fn program(&self) -> Option<Program> {
        steps::program(self)
    }

    fn begin(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Option<Begun> {
        steps::begin(self, pendulum, start, grid)
    }
}

macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        /// Every method of the library, in its order.
        pub static METHODS: &[&dyn OnDevice] = &[$(&methods::$method,)+];
    };
}
for_each_method!(collect);

/// The method of the library with this name.
pub fn method_named(name: &str) -> Option<&'static dyn OnDevice> {
    METHODS.iter().find(|method| method.info().name == name).copied()
}

/// Pendulums that are on the device at once, at most: enough for every core of a large card. It
/// bounds the memory here, whatever the number of starts.
pub const MOST: usize = 1 << 18;

/// The buffers, by their indices in [`steps::rows`].
const CONSTANTS_OF: usize = 0;
const NUMBERS: usize = 1;
const PHASES: usize = 2;
const WATCHED: usize = 3;

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
    device: &'d Device,
    method: &'static dyn OnDevice,
    program: Program,
    session: Session,
}

impl Device {
    /// Compiles the steps of `method`.
    ///
    /// # Errors
    /// [`Error::Method`] for a method that cannot be recorded; [`Error::NoDouble`],
    /// [`Error::Build`], [`Error::Driver`].
    pub fn compile(&self, method: &'static dyn OnDevice) -> Result<Compiled<'_>, Error> {
        let name = method.info().name;
        let program = method.program().ok_or(Error::Method { method: name })?;
        let rows = steps::rows(program.numbers);
        let session = Session::new(self, &program.source, &steps::KERNELS, &rows)?;
        Ok(Compiled { device: self, method, program, session })
    }
}

impl Compiled<'_> {
    /// Writes the state of each pendulum at the end of the grid to `ends`, as [`Ensemble::ends`]
    /// does.
    ///
    /// # Errors
    /// [`Error::Memory`], [`Error::Driver`].
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends<I: Instructions>(
        &mut self,
        ensemble: &Ensemble<'_, I>,
        ends: &mut [Phase],
    ) -> Result<(), Error> {
        let (device, method) = (self.device, self.method);
        let (steps, h) = (ensemble.grid().steps(), ensemble.grid().step());
        self.in_batches(
            ensemble,
            ends,
            |session, batch, ends| {
                session.run(device, Watch::End as usize, batch.len(), steps, &[h])?;
                let phases = session.read(device, PHASES, batch.len())?;
                for (column, &i) in batch.iter().enumerate() {
                    ends[i] = phase(&phases, column);
                }
                Ok(())
            },
            |i, end| {
                *end = method.end(ensemble.pendulum(i), ensemble.starts()[i], ensemble.grid());
            },
        )
    }

    /// The same, and to each end the largest energy error (J) of all steps, as [`EnergyDrift`] has
    /// it.
    ///
    /// # Errors
    /// As [`Compiled::ends`].
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends_and_energy_errors<I: Instructions>(
        &mut self,
        ensemble: &Ensemble<'_, I>,
        ends: &mut [(Phase, f64)],
    ) -> Result<(), Error> {
        let (device, method) = (self.device, self.method);
        let (steps, h) = (ensemble.grid().steps(), ensemble.grid().step());
        let alone = |i: usize, slot: &mut (Phase, f64)| {
            let pendulum = ensemble.pendulum(i);
            let mut drift = EnergyDrift::new(pendulum);
            let end = method.run(pendulum, ensemble.starts()[i], ensemble.grid(), &mut drift);
            *slot = (end, drift.largest());
        };
        self.in_batches(
            ensemble,
            ends,
            |session, batch, ends| {
                session.run(device, Watch::Energy as usize, batch.len(), steps, &[h])?;
                let phases = session.read(device, PHASES, batch.len())?;
                let watched = session.read(device, WATCHED, batch.len())?;
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
    /// # Errors
    /// As [`Compiled::ends`].
    ///
    /// # Panics
    /// If there are not as many observers as starts.
    pub fn watch<I: Instructions, O: Observer<Phase>>(
        &mut self,
        ensemble: &Ensemble<'_, I>,
        every: NonZeroU64,
        observers: &mut [O],
    ) -> Result<(), Error> {
        let (device, method) = (self.device, self.method);
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
                    session.run(device, Watch::End as usize, batch.len(), every.get(), &[h])?;
                    n += every.get();
                    let phases = session.read(device, PHASES, batch.len())?;
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
                let _ = method.run(ensemble.pendulum(i), ensemble.starts()[i], grid, &mut watch);
            },
        )
    }
}

impl Compiled<'_> {
    /// Calls `on_device` for each batch of pendulums, with a session in which they stand at the
    /// start, their indices and all slots; and `alone` for each pendulum that the library does not
    /// run in steps either.
    fn in_batches<I: Instructions, T>(
        &mut self,
        ensemble: &Ensemble<'_, I>,
        slots: &mut [T],
        mut on_device: impl FnMut(&Session, &[usize], &mut [T]) -> Result<(), Error>,
        mut alone: impl FnMut(usize, &mut T),
    ) -> Result<(), Error> {
        assert_eq!(slots.len(), ensemble.starts().len(), "one slot for each start");
        let capacity = self.session.reserve(self.device, slots.len(), MOST)?;
        let mut batch = Vec::with_capacity(capacity);
        let mut begun = Vec::with_capacity(capacity);
        for (i, start) in ensemble.starts().iter().enumerate() {
            match self.method.begin(ensemble.pendulum(i), *start, ensemble.grid()) {
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
                let buffers =
                    [(CONSTANTS_OF, &constants), (NUMBERS, &numbers), (WATCHED, &watched)];
                for (buffer, values) in buffers {
                    self.session.write(self.device, buffer, batch.len(), values)?;
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
pub fn rows<T>(pendulums: &[T], width: usize, of: impl Fn(&T) -> &[f64]) -> Vec<f64> {
    (0..width)
        .flat_map(|row| pendulums.iter().map(move |one| (row, one)))
        .map(|(row, one)| of(one)[row])
        .collect()
}

/// The state in a column of angles and then angular velocities.
fn phase(phases: &[f64], column: usize) -> Phase {
    Phase { theta: phases[column], omega: phases[phases.len() / 2 + column] }
}

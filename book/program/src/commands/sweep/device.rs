//! A sweep on an OpenCL device.

use std::sync::{Mutex, PoisonError};

use pendula::{Ensemble, Phase};
pub use pendula_device::Device;
use pendula_device::{Compiled, Error, method_named};

use pendula_output::failure::Failure;

/// The steps of a method on a device, for as long as the program runs.
pub struct OnDevice {
    compiled: Mutex<Compiled<'static>>,
    /// Why it did not go on.
    error: Mutex<Option<Error>>,
}

impl OnDevice {
    /// The steps of the method `method`, compiled for the device with `name` in its name.
    ///
    /// # Errors
    /// [`Failure::Refused`] for what the device cannot do, or if there is none.
    pub fn open(name: &str, method: &str) -> Result<&'static Self, Failure> {
        // Used to the end of the program, by threads that may outlive the command.
        let device: &Device = Box::leak(Box::new(Device::named(name).map_err(Failure::refused)?));
        let method = method_named(method)
            .ok_or_else(|| Failure::refused(format!("there is no method {method}")))?;
        let compiled = Mutex::new(device.compile(method).map_err(Failure::refused)?);
        Ok(Box::leak(Box::new(Self { compiled, error: Mutex::new(None) })))
    }

    /// The end of each run and its largest energy error (J); none if the device does not go on.
    pub fn ends(&self, ensemble: &Ensemble<'_>) -> Vec<(Phase, f64)> {
        let mut ends = vec![(Phase::default(), 0.0); ensemble.starts().len()];
        let mut compiled = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        match compiled.ends_and_energy_errors(ensemble, &mut ends) {
            Ok(()) => ends,
            Err(error) => {
                *self.error.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                Vec::new()
            }
        }
    }

    /// Why the device did not go on, if it did not.
    pub fn failure(&self) -> Option<Failure> {
        let error = self.error.lock().unwrap_or_else(PoisonError::into_inner).take();
        error.map(|error| Failure::Failed(error.into()))
    }
}

//! What stands for devices in a program that was built without the feature `device`: there are
//! none, and no name of one gets here.

use std::io;
use std::num::NonZeroU64;

use pendula::systems::DoublePhase;
use pendula::{DoublePendulum, Ensemble, Grid, Phase, Rk4};

use pendula_output::failure::Failure;

/// A device.
pub enum Device {}

impl Device {
    /// The device with `name` in its name.
    ///
    /// # Errors
    /// Always.
    pub fn named(name: &str) -> io::Result<Self> {
        Err(io::Error::other(format!("{name}: this program was built without devices")))
    }

    /// The first flip of each of the `starts`.
    ///
    /// # Errors
    /// None.
    pub fn first_flips(
        &self,
        _: &DoublePendulum,
        _: &Rk4,
        _: &[DoublePhase],
        _: &Grid,
        _: &mut [Option<NonZeroU64>],
    ) -> io::Result<()> {
        match *self {}
    }
}

/// The steps of a method on a device.
pub struct OnDevice(Device);

impl OnDevice {
    /// The steps of a method on the device with `name` in its name.
    ///
    /// # Errors
    /// Always.
    pub fn open(name: &str, _: &str) -> Result<&'static Self, Failure> {
        Device::named(name).map(|device| match device {}).map_err(Failure::refused)
    }

    /// The end of each run and its largest energy error (J).
    pub fn ends(&self, _: &Ensemble<'_>) -> Vec<(Phase, f64)> {
        match self.0 {}
    }

    /// Why the device did not go on.
    pub fn failure(&self) -> Option<Failure> {
        match self.0 {}
    }
}

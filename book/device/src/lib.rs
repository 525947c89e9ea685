//! Ensembles of pendulums on graphics cards and other OpenCL devices, with the bits of the library.
//!
//! The methods of the library are written for every [number](pendula::internals::Number). Here a
//! step is [recorded](trace) with numbers that write down what is done with them, and the record is
//! the [program](kernel) for the device: the same additions and multiplications in the same order,
//! each rounded by itself. So the bits are those of the library, on every device that keeps the
//! IEEE standard in double precision.
//!
//! Any method whose steps can be recorded runs: Runge–Kutta methods, splittings, processed methods,
//! Taylor series. Implicit methods do not, as they sweep until their equations are solved.

mod ensemble;
pub mod kernel;
pub mod numbers;
mod opencl;
pub mod trace;

pub use ensemble::{Compiled, OnDevice, method_named, methods};
pub use opencl::{Device, devices};

/// Why a device could not be used. Each is said in one line.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Error {
    /// There is no OpenCL on this machine.
    #[error("there is no OpenCL platform on this machine, or no driver for one")]
    NoPlatform,
    /// No device has this in its name.
    #[error("no device has {name:?} in its name; there are: {names}")]
    NoDevice {
        /// What was asked for.
        name: String,
        /// The names of all devices.
        names: String,
    },
    /// More than one device has this in its name.
    #[error("{name:?} is in the names of {names}")]
    Ambiguous {
        /// What was asked for.
        name: String,
        /// The names of these devices.
        names: String,
    },
    /// The device calculates in single precision only.
    #[error("{device} has no double precision")]
    NoDouble {
        /// Its name.
        device: String,
    },
    /// The method cannot run on a device.
    #[error(
        "{method} does not run on a device: how many operations a step has depends on the numbers"
    )]
    Method {
        /// Its name.
        method: &'static str,
    },
    /// The driver does not compile the program.
    #[error("the driver of {device} does not compile the steps: {}", first_line(log))]
    Build {
        /// Its name.
        device: String,
        /// All that its compiler says.
        log: String,
    },
    /// There is too little memory.
    #[error("{device} has too little memory")]
    Memory {
        /// Its name.
        device: String,
    },
    /// The driver refuses something, or the device is lost.
    #[error("{device} does not go on: the driver answers {answer} ({code})")]
    Driver {
        /// Its name.
        device: String,
        /// OpenCL's error code.
        code: i32,
        /// Its name.
        answer: String,
    },
}

fn first_line(log: &str) -> &str {
    log.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("it says nothing")
}

impl Device {
    /// The only device that has `name` in its name, in upper or lower case.
    pub fn named(name: &str) -> Result<Self, Error> {
        let devices = devices()?;
        let names = |devices: &[&Self]| {
            let names: Vec<&str> = devices.iter().map(|device| &*device.name).collect();
            names.join(", ")
        };
        let fits = |device: &&Self| device.name.to_lowercase().contains(&name.to_lowercase());
        let fitting: Vec<&Self> = devices.iter().filter(fits).collect();
        let index = match *fitting {
            [] => {
                let names = names(&devices.iter().collect::<Vec<_>>());
                return Err(Error::NoDevice { name: name.into(), names });
            }
            [one] => devices.iter().position(|device| device.name == one.name),
            // The first of some of the same name is part of the names of the others.
            _ => {
                devices.iter().position(|device| device.name.to_lowercase() == name.to_lowercase())
            }
        };
        match index {
            Some(index) => Ok(devices.into_iter().nth(index).expect("it is among them")),
            None => Err(Error::Ambiguous { name: name.into(), names: names(&fitting) }),
        }
    }
}

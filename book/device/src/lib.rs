//! Ensembles of pendulums on graphics cards and other OpenCL devices, with the bits of the library.
//!
//! The methods of the library are written for every [number](pendula::fast::Number). Here a step is
//! [recorded](trace) with numbers that write down what is done with them, and the record is the
//! [program](kernel) for the device: the same additions and multiplications in the same order, each
//! rounded by itself. So the bits are those of the library, on every device that keeps the IEEE
//! standard in double precision.
//!
//! Any method whose steps can be recorded runs: Runge–Kutta methods, splittings, processed methods,
//! Taylor series. Implicit methods do not, as they sweep until their equations are solved.

mod ensemble;
mod error;
pub mod kernel;
mod opencl;
pub mod trace;

pub use ensemble::{Compiled, OnDevice, method_named, methods};
pub use error::Error;
pub use opencl::{Device, devices};

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

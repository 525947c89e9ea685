//! Why a device could not be used.

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

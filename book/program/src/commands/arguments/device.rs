//! `--device`: where a sweep runs. Without the feature `device` there is no such option.

use clap::Args;

/// A device, or none.
#[derive(Args, Debug)]
pub struct DeviceArgument {
    /// Run on the OpenCL device with NAME in its name, see `pendula sweep devices`: the same bits
    #[cfg(feature = "device")]
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
}

impl DeviceArgument {
    /// The name that was given.
    #[cfg(feature = "device")]
    pub fn name(&self) -> Option<&str> {
        self.device.as_deref()
    }

    /// No name can be given.
    #[cfg(not(feature = "device"))]
    pub const fn name(&self) -> Option<&str> {
        None
    }
}

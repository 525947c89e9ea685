//! What is asked of the driver. All `unsafe` code of the project is here.
//!
//! Three things make the calls sound. A [`Session`] makes its buffers with the rows that its
//! kernels, made by [`kernel`](crate::kernel), index, and no kernel writes beyond them: each work
//! item has its own column, and returns if there is none. Each argument has the type that the
//! kernel declares. And every call waits until the device has finished, so that no memory of this
//! side is used after it is gone.
#![allow(unsafe_code)]

use std::sync::{Mutex, MutexGuard, PoisonError};

use opencl3::command_queue::CommandQueue;
use opencl3::context::Context;
use opencl3::device::{CL_DEVICE_TYPE_ALL, Device as Handle};
use opencl3::error_codes::{
    CL_INVALID_BUFFER_SIZE, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_HOST_MEMORY, ClError,
};
use opencl3::kernel::Kernel;
use opencl3::memory::{Buffer, CL_MEM_READ_WRITE};
use opencl3::platform::get_platforms;
use opencl3::types::{CL_TRUE, cl_double, cl_ulong};

use crate::Error;

/// A device, and what is known of it.
#[derive(Debug)]
pub struct Device {
    handle: Handle,
    /// Its name, which no other has.
    pub name: String,
    /// Its memory (bytes).
    pub memory: u64,
    /// The largest buffer that it allows (bytes).
    pub largest_buffer: u64,
    /// Whether it calculates in double precision.
    pub is_double: bool,
}

/// Held while a driver is asked what there is, or compiles: OpenCL lets threads do so at once, and
/// PoCL 3.1 crashes if they begin at the same time.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

fn one_at_a_time() -> MutexGuard<'static, ()> {
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All devices of all platforms; of those with the same name the second and later are numbered.
pub fn devices() -> Result<Vec<Device>, Error> {
    let _alone = one_at_a_time();
    let platforms = get_platforms().unwrap_or_default();
    if platforms.is_empty() {
        return Err(Error::NoPlatform);
    }
    let mut devices: Vec<Device> = Vec::new();
    for platform in platforms {
        // A platform without a device answers with an error.
        for id in platform.get_devices(CL_DEVICE_TYPE_ALL).unwrap_or_default() {
            let handle = Handle::new(id);
            let name = handle.name().unwrap_or_else(|_| "a device without a name".into());
            // Two blanks separate the columns in which devices are listed.
            let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
            let is_same = |other: &&Device| {
                other.name == name || other.name.starts_with(&format!("{name} #"))
            };
            let name = match devices.iter().filter(is_same).count() {
                0 => name,
                same => format!("{name} #{}", same + 1),
            };
            devices.push(Device {
                name,
                memory: handle.global_mem_size().unwrap_or(0),
                largest_buffer: handle.max_mem_alloc_size().unwrap_or(0),
                is_double: handle.double_fp_config().is_ok_and(|abilities| abilities != 0),
                handle,
            });
        }
    }
    Ok(devices)
}

/// A program on a device, and memory for a number of pendulums.
pub struct Session<'d> {
    device: &'d Device,
    context: Context,
    queue: CommandQueue,
    /// Each kernel, and how many of the buffers it is given.
    kernels: Vec<(Kernel, usize)>,
    /// The rows of each buffer.
    rows: Vec<usize>,
    /// The columns that there is room for, and the buffers.
    capacity: usize,
    buffers: Vec<Buffer<cl_double>>,
}

/// Work items in a group: a kernel gets a whole number of groups.
const GROUP: usize = 64;

/// Steps in a launch, at most: a driver may take a program that runs for seconds for one that
/// hangs.
const LAUNCH: cl_ulong = 1 << 12;

impl<'d> Session<'d> {
    /// Builds `source` for `device`, with its `kernels` and how many of the buffers each is given;
    /// `rows` says how many rows each buffer has.
    pub fn new(
        device: &'d Device,
        source: &str,
        kernels: &[(&str, usize)],
        rows: &[usize],
    ) -> Result<Self, Error> {
        if !device.is_double {
            return Err(Error::NoDouble { device: device.name.clone() });
        }
        let _alone = one_at_a_time();
        let refused = |error| device.refusal(error);
        let context = Context::from_device(&device.handle).map_err(refused)?;
        // Deprecated since OpenCL 2.0, and the one call that every version has.
        #[allow(deprecated)]
        let queue = CommandQueue::create_default(&context, 0).map_err(refused)?;
        let built = opencl3::program::Program::create_and_build_from_source(
            &context,
            source,
            "-cl-std=CL1.2",
        );
        let built = built.map_err(|log| Error::Build { device: device.name.clone(), log })?;
        let kernel = |&(name, buffers): &(&str, usize)| {
            Ok((Kernel::create(&built, name).map_err(refused)?, buffers))
        };
        let kernels = kernels.iter().map(kernel).collect::<Result<_, _>>()?;
        let (rows, capacity, buffers) = (rows.into(), 0, Vec::new());
        Ok(Self { device, context, queue, kernels, rows, capacity, buffers })
    }

    /// The pendulums of `all` that are on the device at once: a quarter of its memory, in buffers
    /// that it allows, and no more than `most`. There is then room for them.
    pub fn reserve(&mut self, all: usize, most: usize) -> Result<usize, Error> {
        let device = self.device;
        let column = 8 * self.rows.iter().sum::<usize>() as u64;
        let room = u64::min(device.memory / 4, device.largest_buffer) / column;
        let capacity = usize::try_from(room).unwrap_or(usize::MAX).min(most).min(all);
        if capacity == 0 && all > 0 {
            return Err(Error::Memory { device: device.name.clone() });
        }
        if capacity > self.capacity {
            self.capacity = 0;
            self.buffers.clear();
            let buffer = |&rows: &usize| {
                let (flags, length) = (CL_MEM_READ_WRITE, rows * capacity);
                let (context, queue, null) = (&self.context, &self.queue, core::ptr::null_mut());
                // NVIDIA's driver makes a buffer of any size, and allocates it when it is first
                // written.
                // SAFETY: No memory of this side is handed over, and the buffer has a first value.
                unsafe {
                    let mut buffer = Buffer::create(context, flags, length, null)?;
                    queue.enqueue_write_buffer(&mut buffer, CL_TRUE, 0, &[0.0], &[])?;
                    Ok(buffer)
                }
            };
            let buffers: Result<_, ClError> = self.rows.iter().map(buffer).collect();
            self.buffers = buffers.map_err(|error| device.refusal(error))?;
            self.capacity = capacity;
        }
        Ok(capacity)
    }

    /// Brings to a buffer the values of `pendulums` of them, in rows with one column for each.
    pub fn write(&mut self, buffer: usize, pendulums: usize, values: &[f64]) -> Result<(), Error> {
        assert!(pendulums <= self.capacity, "there is room for them");
        assert_eq!(values.len(), self.rows[buffer] * pendulums, "a column for each pendulum");
        let buffer = &mut self.buffers[buffer];
        // SAFETY: The buffer is at least as long, and the call returns when all is copied.
        unsafe { self.queue.enqueue_write_buffer(buffer, CL_TRUE, 0, values, &[]) }
            .map_err(|error| self.device.refusal(error))?;
        Ok(())
    }

    /// Runs a kernel over the `pendulums` that are there, for `steps` steps in launches of at most
    /// [`LAUNCH`], and waits for them. `scalars` are its arguments between the number of steps and
    /// the buffers.
    pub fn run(
        &self,
        kernel: usize,
        pendulums: usize,
        steps: u64,
        scalars: &[f64],
    ) -> Result<(), Error> {
        assert!(pendulums <= self.capacity, "there is room for them");
        let columns = pendulums as cl_ulong;
        let (kernel, buffers) = &self.kernels[kernel];
        let (items, group) = ([pendulums.next_multiple_of(GROUP)], [GROUP]);
        let launch = |steps: cl_ulong| {
            // SAFETY: The arguments are those that the programs in `kernel` declare, in order: two
            // counts, numbers, buffers. The buffers have a column for each of the pendulums, and an
            // item beyond them returns.
            unsafe {
                kernel.set_arg(0, &columns)?;
                kernel.set_arg(1, &steps)?;
                for (index, scalar) in (2..).zip(scalars) {
                    kernel.set_arg(index, scalar)?;
                }
                for (index, buffer) in (2 + scalars.len() as u32..).zip(&self.buffers[..*buffers]) {
                    kernel.set_arg(index, buffer)?;
                }
                self.queue.enqueue_nd_range_kernel(
                    kernel.get(),
                    1,
                    core::ptr::null(),
                    items.as_ptr(),
                    group.as_ptr(),
                    &[],
                )?;
            }
            self.queue.finish()
        };
        let mut left = steps;
        while left > 0 {
            let now = left.min(LAUNCH);
            launch(now).map_err(|error| self.device.refusal(error))?;
            left -= now;
        }
        Ok(())
    }

    /// The values of a buffer for the first `pendulums` columns, row after row.
    pub fn read(&self, buffer: usize, pendulums: usize) -> Result<Vec<f64>, Error> {
        assert!(pendulums <= self.capacity, "there is room for them");
        let mut values = vec![0.0; self.rows[buffer] * pendulums];
        // SAFETY: The buffer is at least as long, and the call returns when all is copied.
        unsafe {
            self.queue.enqueue_read_buffer(&self.buffers[buffer], CL_TRUE, 0, &mut values, &[])
        }
        .map_err(|error| self.device.refusal(error))?;
        Ok(values)
    }
}

impl Device {
    /// What the driver's answer means.
    fn refusal(&self, error: ClError) -> Error {
        let device = self.name.clone();
        match error.0 {
            CL_INVALID_BUFFER_SIZE | CL_MEM_OBJECT_ALLOCATION_FAILURE | CL_OUT_OF_HOST_MEMORY => {
                Error::Memory { device }
            }
            code => Error::Driver { device, code, answer: error.to_string() },
        }
    }
}

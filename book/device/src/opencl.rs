//! What is asked of the driver. All `unsafe` code of the project is here.
//!
//! Three things make the calls sound. A [`Session`] makes its buffers with the lengths that its
//! kernels, made by [`kernel`](crate::kernel), index, and no kernel writes beyond them: each work
//! item has its own column, and returns if there is none. Each argument has the type that the
//! kernel declares. And every call waits until the device has finished, so that no memory of this
//! side is used after it is gone.
#![allow(unsafe_code)]

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
use crate::kernel::{CONSTANTS, Program};

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

/// All devices of all platforms; of those with the same name the second and later are numbered.
///
/// # Errors
/// [`Error::NoPlatform`] if there is none, or no library that would know it.
pub fn devices() -> Result<Vec<Device>, Error> {
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

/// A program on a device, with the memory for a number of pendulums.
pub struct Session {
    queue: CommandQueue,
    steps: Kernel,
    watched_steps: Kernel,
    constants: Buffer<cl_double>,
    numbers: Buffer<cl_double>,
    phases: Buffer<cl_double>,
    watched: Buffer<cl_double>,
    /// The pendulums that there is room for.
    capacity: usize,
    /// The numbers of each.
    width: usize,
}

/// What a launch is to look at.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Watch {
    /// The last state only.
    End,
    /// The energy after each step, too.
    Energy,
}

/// Work items in a group: a kernel gets a whole number of groups.
const GROUP: usize = 64;

/// The largest energy error (J) and the largest angle (rad) of each pendulum, in two rows.
const WATCHED: usize = 2;

impl Session {
    /// Builds `program` for `device`, with room for `capacity` pendulums.
    ///
    /// # Errors
    /// [`Error::Build`] with what the driver's compiler says, [`Error::Memory`] if there is too
    /// little, and [`Error::Driver`] for whatever else it refuses.
    pub fn new(device: &Device, program: &Program, capacity: usize) -> Result<Self, Error> {
        let refused = |error| refusal(device, error);
        let context = Context::from_device(&device.handle).map_err(refused)?;
        // Deprecated since OpenCL 2.0, and the one call that every version has.
        #[allow(deprecated)]
        let queue = CommandQueue::create_default(&context, 0).map_err(refused)?;
        let built = opencl3::program::Program::create_and_build_from_source(
            &context,
            &program.source,
            "-cl-std=CL1.2",
        );
        let built = built.map_err(|log| Error::Build { device: device.name.clone(), log })?;
        let kernel = |name| Kernel::create(&built, name).map_err(refused);
        let buffer = |rows: usize| {
            // SAFETY: No memory of this side is handed over.
            unsafe {
                Buffer::create(&context, CL_MEM_READ_WRITE, rows * capacity, core::ptr::null_mut())
            }
            .map_err(refused)
        };
        Ok(Self {
            steps: kernel("steps")?,
            watched_steps: kernel("watched_steps")?,
            constants: buffer(CONSTANTS.len())?,
            numbers: buffer(program.numbers)?,
            phases: buffer(2)?,
            watched: buffer(WATCHED)?,
            queue,
            capacity,
            width: program.numbers,
        })
    }

    /// Brings `pendulums` of them to the device: their constants and numbers in rows, with one
    /// column for each.
    ///
    /// # Errors
    /// As the driver says.
    ///
    /// # Panics
    /// If there are more than it has room for, or the rows do not have this length.
    pub fn write(
        &mut self,
        device: &Device,
        pendulums: usize,
        constants: &[f64],
        numbers: &[f64],
    ) -> Result<(), Error> {
        assert!(pendulums <= self.capacity, "there is no room for so many");
        assert_eq!(constants.len(), CONSTANTS.len() * pendulums, "a column for each pendulum");
        assert_eq!(numbers.len(), self.width * pendulums, "a column for each pendulum");
        let zeros = vec![0.0; WATCHED * pendulums];
        let rows: [(&mut Buffer<cl_double>, &[f64]); 3] = [
            (&mut self.constants, constants),
            (&mut self.numbers, numbers),
            (&mut self.watched, &zeros),
        ];
        for (buffer, values) in rows {
            // SAFETY: The buffer is at least as long, and the call returns when all is copied.
            unsafe { self.queue.enqueue_write_buffer(buffer, CL_TRUE, 0, values, &[]) }
                .map_err(|error| refusal(device, error))?;
        }
        Ok(())
    }

    /// Takes `steps` steps of `h` (s), at least one, with the pendulums that are there, and waits
    /// for them.
    ///
    /// # Errors
    /// As the driver says.
    pub fn advance(
        &self,
        device: &Device,
        watch: Watch,
        pendulums: usize,
        steps: u64,
        h: f64,
    ) -> Result<(), Error> {
        assert!(pendulums <= self.capacity && steps > 0, "there is work for every item");
        let columns = pendulums as cl_ulong;
        let kernel = match watch {
            Watch::End => &self.steps,
            Watch::Energy => &self.watched_steps,
        };
        let (items, group) = ([pendulums.next_multiple_of(GROUP)], [GROUP]);
        let launch = || {
            // SAFETY: The arguments are those that `kernel::write_head` declares, in order; the
            // buffers have a column for each of the pendulums, and an item beyond them returns.
            unsafe {
                kernel.set_arg(0, &columns)?;
                kernel.set_arg(1, &steps)?;
                kernel.set_arg(2, &h)?;
                kernel.set_arg(3, &self.constants)?;
                kernel.set_arg(4, &self.numbers)?;
                kernel.set_arg(5, &self.phases)?;
                if watch == Watch::Energy {
                    kernel.set_arg(6, &self.watched)?;
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
        launch().map_err(|error| refusal(device, error))
    }

    /// Angles (rad) and then angular velocities (rad/s) of `pendulums` of them after the last
    /// steps.
    ///
    /// # Errors
    /// As the driver says.
    pub fn phases(&self, device: &Device, pendulums: usize) -> Result<Vec<f64>, Error> {
        self.read(device, &self.phases, 2 * pendulums)
    }

    /// Largest energy errors (J) and then largest angles (rad) of `pendulums` of them over all
    /// watched steps.
    ///
    /// # Errors
    /// As the driver says.
    pub fn watched(&self, device: &Device, pendulums: usize) -> Result<Vec<f64>, Error> {
        self.read(device, &self.watched, WATCHED * pendulums)
    }

    fn read(
        &self,
        device: &Device,
        buffer: &Buffer<cl_double>,
        count: usize,
    ) -> Result<Vec<f64>, Error> {
        assert!(count <= 2 * self.capacity, "the buffer is as long");
        let mut values = vec![0.0; count];
        // SAFETY: The buffer is at least as long, and the call returns when all is copied.
        unsafe { self.queue.enqueue_read_buffer(buffer, CL_TRUE, 0, &mut values, &[]) }
            .map_err(|error| refusal(device, error))?;
        Ok(values)
    }
}

/// What the driver's answer means.
fn refusal(device: &Device, error: ClError) -> Error {
    let name = device.name.clone();
    match error.0 {
        CL_INVALID_BUFFER_SIZE | CL_MEM_OBJECT_ALLOCATION_FAILURE | CL_OUT_OF_HOST_MEMORY => {
            Error::Memory { device: name }
        }
        code => Error::Driver { device: name, code, answer: error.to_string() },
    }
}

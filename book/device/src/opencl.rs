//! What is asked of the driver. All `unsafe` code of the project is here.
//!
//! Three things make the calls sound. A [`Session`] makes its buffers with the lengths that its
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

/// Held while a driver is asked what there is, or compiles: OpenCL lets threads do so at once, and
/// PoCL 3.1 crashes if they begin at the same time.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

fn one_at_a_time() -> MutexGuard<'static, ()> {
    ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All devices of all platforms; of those with the same name the second and later are numbered.
///
/// # Errors
/// [`Error::NoPlatform`] if there is none, or no library that would know it.
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
pub struct Session {
    context: Context,
    queue: CommandQueue,
    steps: Kernel,
    watched_steps: Kernel,
    /// The numbers of each pendulum.
    width: usize,
    room: Option<Room>,
}

/// Memory for a number of pendulums.
struct Room {
    capacity: usize,
    constants: Buffer<cl_double>,
    numbers: Buffer<cl_double>,
    phases: Buffer<cl_double>,
    watched: Buffer<cl_double>,
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
    /// Builds `program` for `device`.
    ///
    /// # Errors
    /// [`Error::Build`] with what the driver's compiler says, and [`Error::Driver`] for whatever
    /// else it refuses.
    pub fn new(device: &Device, program: &Program) -> Result<Self, Error> {
        let _alone = one_at_a_time();
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
        let (steps, watched_steps) = (kernel("steps")?, kernel("watched_steps")?);
        Ok(Self { context, queue, steps, watched_steps, width: program.numbers, room: None })
    }

    /// Makes room for `capacity` pendulums, if there is not so much.
    ///
    /// # Errors
    /// [`Error::Memory`] if the device has too little, and [`Error::Driver`].
    pub fn reserve(&mut self, device: &Device, capacity: usize) -> Result<(), Error> {
        if self.room.as_ref().is_some_and(|room| room.capacity >= capacity) {
            return Ok(());
        }
        self.room = None;
        let buffer = |rows: usize| {
            let flags = CL_MEM_READ_WRITE;
            // SAFETY: No memory of this side is handed over.
            unsafe { Buffer::create(&self.context, flags, rows * capacity, core::ptr::null_mut()) }
                .map_err(|error| refusal(device, error))
        };
        self.room = Some(Room {
            capacity,
            constants: buffer(CONSTANTS.len())?,
            numbers: buffer(self.width)?,
            phases: buffer(2)?,
            watched: buffer(WATCHED)?,
        });
        Ok(())
    }

    /// Brings `pendulums` of them to the device: their constants and numbers in rows, with one
    /// column for each.
    ///
    /// # Errors
    /// As the driver says.
    ///
    /// # Panics
    /// If there is no room for them, or the rows do not have this length.
    pub fn write(
        &mut self,
        device: &Device,
        pendulums: usize,
        constants: &[f64],
        numbers: &[f64],
    ) -> Result<(), Error> {
        let room = self.room.as_mut().filter(|room| pendulums <= room.capacity);
        let room = room.expect("there is room for them");
        assert_eq!(constants.len(), CONSTANTS.len() * pendulums, "a column for each pendulum");
        assert_eq!(numbers.len(), self.width * pendulums, "a column for each pendulum");
        let zeros = vec![0.0; WATCHED * pendulums];
        let rows: [(&mut Buffer<cl_double>, &[f64]); 3] = [
            (&mut room.constants, constants),
            (&mut room.numbers, numbers),
            (&mut room.watched, &zeros),
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
        let room = self.room(pendulums);
        assert!(steps > 0, "there are steps to take");
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
                kernel.set_arg(3, &room.constants)?;
                kernel.set_arg(4, &room.numbers)?;
                kernel.set_arg(5, &room.phases)?;
                if watch == Watch::Energy {
                    kernel.set_arg(6, &room.watched)?;
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
        self.read(device, &self.room(pendulums).phases, 2 * pendulums)
    }

    /// Largest energy errors (J) and then largest angles (rad) of `pendulums` of them over all
    /// watched steps.
    ///
    /// # Errors
    /// As the driver says.
    pub fn watched(&self, device: &Device, pendulums: usize) -> Result<Vec<f64>, Error> {
        self.read(device, &self.room(pendulums).watched, WATCHED * pendulums)
    }

    /// The room, with a column for each of `pendulums`.
    fn room(&self, pendulums: usize) -> &Room {
        let room = self.room.as_ref().filter(|room| pendulums <= room.capacity);
        room.expect("there is room for them")
    }

    /// The first `count` numbers of a buffer, which has as many.
    fn read(
        &self,
        device: &Device,
        buffer: &Buffer<cl_double>,
        count: usize,
    ) -> Result<Vec<f64>, Error> {
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

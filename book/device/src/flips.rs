//! Double pendulums on a device.

use std::num::NonZeroU64;

use pendula::systems::DoublePhase;
use pendula::{DoublePendulum, Grid, Info};

use crate::Error;
use crate::ensemble::{MOST, rows};
use crate::kernel::flips::{self, Recordable, buffer};
use crate::opencl::{Device, Session};

impl Device {
    /// Writes the first flips to `flips`, as [`pendula::fast::first_flips`] does, with the same
    /// bits.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn first_flips<M: Info + Recordable>(
        &self,
        double: &DoublePendulum,
        method: &M,
        starts: &[DoublePhase],
        grid: &Grid,
        flips: &mut [Option<NonZeroU64>],
    ) -> Result<(), Error> {
        assert_eq!(flips.len(), starts.len(), "one slot for each start");
        let (name, h) = (method.info().name, grid.step());
        let program = flips::program(method, double, h).ok_or(Error::Method { method: name })?;
        let (kernels, width) = (&flips::KERNELS, flips::rows(program.numbers));
        let mut session = Session::new(self, &program.source, kernels, &width)?;
        let capacity = session.reserve(self, starts.len(), MOST)?;
        if capacity == 0 {
            return Ok(());
        }
        for (starts, flips) in starts.chunks(capacity).zip(flips.chunks_mut(capacity)) {
            let begin =
                |z: &DoublePhase| flips::begin(method, double, [z.theta1, z.theta2, z.p1, z.p2], h);
            let begun: Vec<_> = starts.iter().map(begin).collect();
            session.write(
                self,
                buffer::NUMBERS,
                starts.len(),
                &rows(&begun, program.numbers, |z| z),
            )?;
            // No step taken, and both rods below.
            let zeros_and_ones = [vec![0.0; starts.len()], vec![1.0; starts.len()]].concat();
            session.write(self, buffer::FLIPS, starts.len(), &zeros_and_ones)?;
            session.run(self, 0, starts.len(), grid.steps(), &[])?;
            let taken = session.read(self, buffer::FLIPS, starts.len())?;
            for (flip, taken) in flips.iter_mut().zip(taken) {
                let taken = taken as u64;
                *flip = if taken < grid.steps() { NonZeroU64::new(taken + 1) } else { None };
            }
        }
        Ok(())
    }
}

//! `pendula sweep flips`: when a double pendulum first turns over, for every release from rest.

use std::io::{self, Write};
use std::num::NonZeroU64;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use anyhow::anyhow;
use clap::Args;
use pendula::fast::first_flips;
use pendula::methods::table::RK4_IN_LANES;
use pendula::systems::DoublePhase;
use pendula::{DoublePendulum, Grid, Hamiltonian, Rk4};
use pendula_device::Device;

use crate::commands::number::number;
use crate::commands::output::{Destination, Streams, Summary};
use crate::commands::system::{DoubleArguments, GravityArgument};
use pendula_output::failure::Failure;
use pendula_output::interrupt::unless_interrupted;

/// Arguments of `pendula sweep flips`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Releases in a row and in a column, an even number: angles between −π and π, at even
    /// distances
    #[arg(long, value_name = "N", default_value_t = 100)]
    size: usize,
    /// Step Δt (s) of RK4
    #[arg(long, value_name = "S", default_value_t = 0.01, value_parser = number)]
    dt: f64,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", default_value_t = 20.0, value_parser = number)]
    duration: f64,
    #[command(flatten)]
    gravity: GravityArgument,
    #[command(flatten)]
    double: DoubleArguments,
    /// Draw the times as a picture: θ₁ from left to right, θ₂ upwards, the later the darker
    #[arg(long, value_name = "FILE.png")]
    picture: Option<PathBuf>,
    /// Run on the OpenCL device with NAME in its name, see `pendula sweep devices`: the same bits
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
    /// Write to FILE, which appears when it is whole
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say on standard error what it has cost
    #[arg(long)]
    summary: bool,
}

/// The most releases in a row: the rows of as many need a gigabyte.
const LARGEST: usize = 4096;

/// Writes the rows theta1, theta2, t: the angles at the release (rad), and the time (s) of the
/// first step after which a rod is past the upward vertical, empty if there is none. The `lookout`
/// counts rows.
pub fn run(
    arguments: &Arguments,
    Streams { out, err, lookout }: Streams<'_>,
) -> Result<(), Failure> {
    let size = arguments.size;
    if size == 0 || size % 2 == 1 || size > LARGEST {
        return Err(Failure::refused(format!(
            "--size {size}: must be an even number, from 2 to {LARGEST}"
        )));
    }
    let double = arguments.double.double(arguments.gravity.gravity).map_err(Failure::refused)?;
    let grid = Grid::with_duration(arguments.dt, arguments.duration).map_err(Failure::refused)?;
    let device = arguments.device.as_deref().map(Device::named);
    let device = device.transpose().map_err(Failure::refused)?;
    // Set the interrupt handler before creating a file.
    let lookout = lookout();
    let interrupted = || Failure::Failed(anyhow!("interrupted"));
    let picture = arguments.picture.as_deref();
    let picture = picture.map(|path| Destination::file("--picture", path)).transpose()?;
    let mut out = Destination::open(arguments.output.as_deref(), Destination::Caller(out))?;
    let begin = Instant::now();
    let device = device.map(Arc::new);
    let work = move || flips_of(&double, size, device.as_deref(), &grid);
    let flips = unless_interrupted(|| lookout.interrupts(0), work).ok_or_else(interrupted)??;
    let elapsed = begin.elapsed();
    writeln!(out, "theta1,theta2,t")?;
    for (index, flip) in flips.iter().enumerate() {
        if lookout.interrupts(index as u64) {
            return Err(interrupted());
        }
        let (theta1, theta2) = (angle(index % size, size), angle(index / size, size));
        match flip {
            Some(n) => writeln!(out, "{theta1:?},{theta2:?},{:?}", grid.time(n.get()))?,
            None => writeln!(out, "{theta1:?},{theta2:?},")?,
        }
    }
    if let Some(mut file) = picture {
        // Upwards is upwards.
        let rows = flips.chunks(size).rev();
        Bands::of(grid.steps()).write(rows, &mut file)?;
        file.finish()?;
    }
    out.finish()?;
    if arguments.summary {
        let mut summary = Summary::default();
        summary.line("releases", (size * size).to_string());
        summary.line("turn over", flips.iter().flatten().count().to_string());
        summary.line("wall time", format!("{:.3} s", elapsed.as_secs_f64()));
        summary.print(err)?;
    }
    Ok(())
}

/// The first flip of each of `size` × `size` releases from rest, row after row from below, those of
/// a row from left to right.
///
/// Mirrored in the vertical, a motion takes the same steps, so that half of them are enough; and no
/// step is taken where the energy does not suffice for a flip.
fn flips_of(
    double: &DoublePendulum,
    size: usize,
    device: Option<&Device>,
    grid: &Grid,
) -> Result<Vec<Option<NonZeroU64>>, Failure> {
    let count = size * size;
    let least = double.least_flip_energy();
    let (mut places, mut starts) = (Vec::new(), Vec::<DoublePhase>::new());
    for index in 0..count / 2 {
        let theta = [angle(index % size, size), angle(index / size, size)];
        let start = double.start(theta, [0.0; 2]).map_err(Failure::refused)?;
        if double.energy(start) >= least {
            places.push(index);
            starts.push(start);
        }
    }
    let mut found = vec![None; starts.len()];
    match device {
        Some(device) => device
            .first_flips(double, &Rk4, &starts, grid, &mut found)
            .map_err(|error| Failure::Failed(error.into()))?,
        None => first_flips(double, RK4_IN_LANES, &starts, grid, &mut found),
    }
    let mut flips = vec![None; count];
    for (place, flip) in places.into_iter().zip(found) {
        flips[place] = flip;
        flips[count - 1 - place] = flip;
    }
    Ok(flips)
}

/// The angle (rad) of the release `index` of `size`: the middles of as many parts of a turn.
fn angle(index: usize, size: usize) -> f64 {
    let odd = 2 * index as i64 + 1 - size as i64;
    std::f64::consts::PI * odd as f64 / size as f64
}

/// Fifteen bands of times, each longer than the one before by the same factor; the last ends with
/// the last time. Their colours go from light to dark, so that they are told apart without colour;
/// where there is no time the picture is transparent.
pub struct Bands {
    /// The last step of each band.
    ends: [u64; COUNT],
}

/// The sixteenth colour is none.
const COUNT: usize = 15;

/// The first band ends with this part of the last time.
const FIRST: f64 = 1.0 / 40.0;

/// The colours of the bands, red, green and blue, from yellow over red to violet, and black for
/// none. The lightness falls, in CIELAB from 89 to 28.
const COLOURS: [u32; COUNT + 1] = [
    0xfd_de_96, 0xf9_cc_89, 0xf4_ba_7c, 0xf0_a8_6f, 0xeb_96_63, 0xe4_85_5c, 0xd7_75_63, 0xca_66_6a,
    0xbd_57_71, 0xb0_47_78, 0x9d_40_7d, 0x88_3c_80, 0x72_39_84, 0x5c_35_88, 0x46_32_8c, 0,
];

impl Bands {
    /// For times up to `steps` steps.
    pub fn of(steps: u64) -> Self {
        let end = |band: usize| {
            let part = 1.0 - band as f64 / (COUNT - 1) as f64;
            (steps as f64 * libm::pow(FIRST, part)).round() as u64
        };
        Self { ends: std::array::from_fn(end) }
    }

    /// The band of a step, COUNT for none.
    fn band(&self, step: Option<NonZeroU64>) -> usize {
        let step = step.map_or(u64::MAX, NonZeroU64::get);
        self.ends.iter().position(|end| step <= *end).unwrap_or(COUNT)
    }

    /// Writes the picture as PNG: rows of dots from the top.
    pub fn write<'a>(
        &self,
        rows: impl ExactSizeIterator<Item = &'a [Option<NonZeroU64>]> + Clone,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        let width = rows.clone().next().map_or(0, <[_]>::len);
        let mut encoder = png::Encoder::new(out, width as u32, rows.len() as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Four);
        let palette = COLOURS.map(|colour| colour.to_be_bytes());
        encoder.set_palette(palette.iter().flat_map(|[_, rgb @ ..]| *rgb).collect::<Vec<u8>>());
        encoder.set_trns([[255; COUNT].as_slice(), &[0]].concat());
        encoder.set_compression(png::Compression::High);
        let mut data = Vec::new();
        for row in rows {
            for two in row.chunks(2) {
                let of = |dot: usize| two.get(dot).map_or(0, |step| self.band(*step) as u8);
                data.push(of(0) << 4 | of(1));
            }
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&data)?;
        writer.finish()?;
        Ok(())
    }
}

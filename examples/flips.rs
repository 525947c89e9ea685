//! When a double pendulum first turns over, for a million releases from rest: the picture of the
//! book's chapter "Other systems". It takes a minute or two, and is written to `flips.png`.

use std::f64::consts::PI;
use std::fs::File;
use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};
use std::thread;

use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Error, Grid, Hamiltonian, Observer, Rk4, integrate_with};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dots = picture(&Releases::new(1000)?);
    write_png(&dots, File::create("flips.png")?)?;
    println!("flips.png");
    Ok(())
}

/// Two equal rods with equal bobs, released from rest in steps of 0.01 s for 20 s; `size` angles
/// between −π and π for each rod.
struct Releases {
    double: DoublePendulum,
    grid: Grid,
    size: usize,
}

impl Releases {
    fn new(size: usize) -> Result<Self, Error> {
        let double = DoublePendulum::of_equals(9.81, Joint { length: 1.0, mass: 1.0 })?;
        Ok(Self { double, grid: Grid::with_duration(0.01, 20.0)?, size })
    }

    /// The place in the palette of the dot in this column and row: θ₁ from left to right, θ₂
    /// upwards, each the middle of one of `size` parts of a turn.
    fn colour(&self, column: usize, row: usize) -> u8 {
        let angle = |i| PI * (2 * i + 1 - self.size as i64) as f64 / self.size as f64;
        let theta = [angle(column as i64), angle((self.size - 1 - row) as i64)];
        let start = self.double.start(theta, [0.0; 2]).expect("both angles are small");
        if self.double.energy(start) < self.double.least_flip_energy() {
            return UNABLE;
        }
        let mut flip = FirstFlip(None);
        integrate_with(&self.double, &Rk4, start, &self.grid, &mut flip);
        flip.0.map_or(NOT_YET, |step| band(step, self.grid.steps()))
    }
}

/// Notes the first step after which a rod is past the upward vertical, and ends the run there.
struct FirstFlip(Option<u64>);

impl Observer<DoublePhase> for FirstFlip {
    fn observe(&mut self, n: u64, _t: f64, z: DoublePhase) {
        if z.theta1.abs() > PI || z.theta2.abs() > PI {
            self.0 = Some(n);
        }
    }

    fn is_satisfied(&self) -> bool {
        self.0.is_some()
    }
}

/// The colours of fifteen bands of times, from light to dark: in CIELAB from 89 to 28.
const COLOURS: [[u8; 3]; 15] = [
    [0xfd, 0xde, 0x96],
    [0xf9, 0xcc, 0x89],
    [0xf4, 0xba, 0x7c],
    [0xf0, 0xa8, 0x6f],
    [0xeb, 0x96, 0x63],
    [0xe4, 0x85, 0x5c],
    [0xd7, 0x75, 0x63],
    [0xca, 0x66, 0x6a],
    [0xbd, 0x57, 0x71],
    [0xb0, 0x47, 0x78],
    [0x9d, 0x40, 0x7d],
    [0x88, 0x3c, 0x80],
    [0x72, 0x39, 0x84],
    [0x5c, 0x35, 0x88],
    [0x46, 0x32, 0x8c],
];

/// A release that could turn over, and has not in the time of the run: grey, as no band is.
const NOT_YET: u8 = COLOURS.len() as u8;
const GREY: [u8; 3] = [0xc0; 3];

/// A release with too little energy to turn over: transparent, so that the figure can have lines
/// across the paper there.
const UNABLE: u8 = NOT_YET + 1;

/// The band of a step of `steps`. Each is longer than the one before by the same factor: the first
/// ends with a fortieth of the steps, the last with all of them.
fn band(step: u64, steps: u64) -> u8 {
    let end = |band: u8| {
        let part = 1.0 - f64::from(band) / f64::from(NOT_YET - 1);
        (steps as f64 * libm::pow(1.0 / 40.0, part)).round() as u64
    };
    (0..NOT_YET).find(|band| step <= end(*band)).unwrap_or(NOT_YET)
}

/// All dots, row after row from the top, on all cores.
fn picture(releases: &Releases) -> Vec<u8> {
    let size = releases.size;
    let mut dots = vec![UNABLE; size * size];
    let rows = Mutex::new(dots[..size * size.div_ceil(2)].chunks_mut(size).enumerate());
    let work = || {
        loop {
            let next = rows.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((row, dots)) = next else { break };
            for (column, dot) in dots.iter_mut().enumerate() {
                *dot = releases.colour(column, row);
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, Into::into) {
            scope.spawn(work);
        }
    });
    // Mirrored in the vertical, a motion takes the same steps.
    for i in 0..size * size / 2 {
        dots[size * size - 1 - i] = dots[i];
    }
    dots
}

fn write_png(dots: &[u8], out: impl Write) -> io::Result<()> {
    let size = dots.len().isqrt() as u32;
    let mut encoder = png::Encoder::new(out, size, size);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette([&COLOURS[..], &[GREY, [0; 3]]].concat().concat());
    encoder.set_trns([&[255; COLOURS.len() + 1][..], &[0]].concat());
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(dots)?;
    Ok(writer.finish()?)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    /// The dots of a picture, as colours; none where it is transparent.
    fn colours(png: &[u8]) -> Vec<Option<[u8; 3]>> {
        let mut decoder = png::Decoder::new(io::Cursor::new(png));
        decoder.set_transformations(png::Transformations::ALPHA);
        let mut reader = decoder.read_info().expect("a picture");
        let mut bytes = vec![0; reader.output_buffer_size().expect("it fits")];
        reader.next_frame(&mut bytes).expect("a picture");
        let (dots, _) = bytes.as_chunks::<4>();
        dots.iter().map(|&[red, green, blue, a]| (a > 0).then_some([red, green, blue])).collect()
    }

    fn colour(dot: u8) -> Option<[u8; 3]> {
        [&COLOURS[..], &[GREY]].concat().get(usize::from(dot)).copied()
    }

    /// Of the million dots of the picture every 997th, in all columns and rows, and the colours of
    /// its key. (The package alone has no book.)
    ///
    /// Catches: a picture of another method, of other steps or of other pendulums than the chapter
    /// says; one that is upside down or mirrored; a time one step off where bands meet; a release
    /// that has not turned over taken for one that cannot; a key of other colours.
    #[test]
    fn the_picture_of_the_book_is_what_this_computes() -> Result<(), Error> {
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/assets");
        if !assets.exists() {
            return Ok(());
        }
        let releases = Releases::new(1000)?;
        let drawn = colours(&fs::read(assets.join("flips.png")).expect("the picture"));
        assert_eq!(drawn.len(), 1_000_000);
        for place in (0..drawn.len()).step_by(997) {
            let (column, row) = (place % 1000, place / 1000);
            assert_eq!(drawn[place], colour(releases.colour(column, row)), "{column}, {row}");
        }
        let figure = fs::read_to_string(assets.join("flips.svg")).expect("the figure");
        for [red, green, blue] in COLOURS.into_iter().chain([GREY]) {
            assert!(drawn.contains(&Some([red, green, blue])));
            assert!(figure.contains(&format!("fill=\"#{red:02x}{green:02x}{blue:02x}\"")));
        }
        Ok(())
    }

    /// Catches: a mirror that turns one rod alone, or leaves the middle row out; rows in another
    /// order in the file; another colour there.
    #[test]
    fn a_small_picture_is_its_releases() -> Result<(), Error> {
        for size in [8, 9] {
            let releases = Releases::new(size)?;
            let dots = picture(&releases);
            let expected: Vec<u8> =
                (0..size * size).map(|i| releases.colour(i % size, i / size)).collect();
            assert_eq!(dots, expected);
            let mut png = Vec::new();
            write_png(&dots, &mut png).expect("a buffer");
            assert_eq!(colours(&png), expected.into_iter().map(colour).collect::<Vec<_>>());
        }
        Ok(())
    }
}

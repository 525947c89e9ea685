//! A picture of times, a dot each.

use std::io::{self, Write};
use std::num::NonZeroU64;

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

/// The colours of the first band, of the last, and of those at even distances between them: red,
/// green and blue. The lightness falls, in CIELAB from 89 to 28.
const COLOURS: [[f64; 3]; 4] =
    [[253.0, 222.0, 150.0], [232.0, 138.0, 90.0], [172.0, 66.0, 122.0], [70.0, 50.0, 140.0]];

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
        encoder.set_palette(colours().concat());
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

/// The colour of each band, and of none.
fn colours() -> [[u8; 3]; COUNT + 1] {
    std::array::from_fn(|band| {
        if band == COUNT {
            return [0; 3];
        }
        let place = band as f64 / (COUNT - 1) as f64 * (COLOURS.len() - 1) as f64;
        let from = (place as usize).min(COLOURS.len() - 2);
        let part = place - from as f64;
        std::array::from_fn(|i| {
            (COLOURS[from][i] * (1.0 - part) + COLOURS[from + 1][i] * part).round() as u8
        })
    })
}

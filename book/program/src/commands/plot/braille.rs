//! A line in braille, each character of which has two dots by four.
//!
//! There are crates that do this; the smallest that is maintained, textplots, brings seven others
//! for what is a page here.

use std::io::{self, Write};

use super::{ends, short};

/// Characters across and down.
const SIZE: (usize, usize) = (64, 10);

/// Draws the line through `points`, with the ends of its y axis on the left. `log` says which of
/// the axes are logarithmic; what has no place there leaves a gap.
pub fn draw(points: &[(f64, f64)], log: [bool; 2], out: &mut dyn Write) -> io::Result<()> {
    let place = |value: f64, log: bool| match log {
        true if value > 0.0 => libm::log10(value),
        true => f64::NAN,
        false => value,
    };
    let placed: Vec<(f64, f64)> =
        points.iter().map(|&(x, y)| (place(x, log[0]), place(y, log[1]))).collect();
    let shown = || placed.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
    let (left, right) = ends(shown().map(|point| point.0));
    let (bottom, top) = ends(shown().map(|point| point.1));
    let (width, height) = (2 * SIZE.0, 4 * SIZE.1);
    let dot = |value: f64, low: f64, high: f64, dots: usize| {
        let share = if high > low { (value - low) / (high - low) } else { 0.5 };
        (share * (dots - 1) as f64).round() as i64
    };
    let mut canvas = vec![vec![0_u8; SIZE.0]; SIZE.1];
    let mut set = |x: i64, y: i64| {
        let (x, y) = (x as usize, height - 1 - y as usize);
        // The bits of a character's dots: the lowest row came later, and has the highest.
        let bit = [[0, 3], [1, 4], [2, 5], [6, 7]][y % 4][x % 2];
        canvas[y / 4][x / 2] |= 1 << bit;
    };
    let mut before: Option<(i64, i64)> = None;
    for &(x, y) in &placed {
        if !(x.is_finite() && y.is_finite()) {
            before = None;
            continue;
        }
        let here = (dot(x, left, right, width), dot(y, bottom, top, height));
        let (from_x, from_y) = before.unwrap_or(here);
        let (dx, dy) = (here.0 - from_x, here.1 - from_y);
        let steps = dx.abs().max(dy.abs()).max(1);
        for step in 0..=steps {
            let along = |from: i64, by: i64| from + (2 * by * step + steps).div_euclid(2 * steps);
            set(along(from_x, dx), along(from_y, dy));
        }
        before = Some(here);
    }
    let end =
        |value: f64, log: bool| if log { short(libm::pow(10.0, value)) } else { short(value) };
    let (low, high) = match shown().next() {
        Some(_) => (end(bottom, log[1]), end(top, log[1])),
        None => (String::new(), String::new()),
    };
    let margin = low.len().max(high.len());
    for (row, cells) in canvas.iter().enumerate() {
        let label = match row {
            0 => high.as_str(),
            _ if row == SIZE.1 - 1 => low.as_str(),
            _ => "",
        };
        let cells: String = cells
            .iter()
            .map(|&dots| char::from_u32(0x2800 + u32::from(dots)).unwrap_or(' '))
            .collect();
        writeln!(out, "{label:>margin$} ┤{cells}")?;
    }
    Ok(())
}

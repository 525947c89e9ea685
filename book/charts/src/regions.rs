//! A map: cells of a grid, of which those of one name that touch make up a region.

use super::path::{Num, Point};

/// A map on the axes of a chart.
#[derive(Clone, Debug)]
pub struct Map {
    /// Where its columns begin, and where the last ends, in values of the axis.
    pub x: Vec<f64>,
    /// The same of its rows.
    pub y: Vec<f64>,
    /// What its cells may have in common.
    pub names: Vec<Name>,
    /// A cell for each place: column by column, in each from the first of `y` on.
    pub cells: Vec<Cell>,
    /// What the numbers of the cells count.
    pub unit: String,
    /// Two lines that stand below the map until a cell says something there.
    pub prompt: [String; 2],
}

/// What the cells of a region have in common.
#[derive(Clone, Debug)]
pub struct Name {
    /// Written in a region where there is room. The legend has those that no region has room for.
    pub title: String,
    /// What its cells look like.
    pub fill: Fill,
}

/// What an area is filled with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// This one of the areas' colours.
    Colour(usize),
    /// Nothing: as the paper is.
    Paper,
}

/// A cell of a map.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its place in the list of names.
    pub name: usize,
    /// Below its region's name stand the smallest and the largest of these.
    pub number: Option<u64>,
    /// Shown below the map while a mouse is on the cell, or after a tap on it.
    pub says: [String; 2],
}

impl Map {
    pub(super) fn rows(&self) -> usize {
        self.y.len().saturating_sub(1)
    }

    pub(super) fn columns(&self) -> usize {
        self.x.len().saturating_sub(1)
    }

    /// The smallest and the largest number of a region's cells, with their unit.
    pub(super) fn numbers(&self, region: &Region) -> Option<String> {
        let cells =
            region.cells.iter().map(|(column, row)| &self.cells[column * self.rows() + row]);
        let numbers = cells.filter_map(|cell| cell.number);
        let (least, most) = (numbers.clone().min()?, numbers.max()?);
        let range = if least == most { least.to_string() } else { format!("{least}–{most}") };
        Some(format!("{range} {}", self.unit))
    }

    /// Its regions, in the order of their first cells.
    pub(super) fn regions(&self) -> Vec<Region> {
        let rows = self.rows();
        let mut regions: Vec<Region> = Vec::new();
        let mut taken = vec![false; self.cells.len()];
        for first in 0..self.cells.len() {
            if taken[first] {
                continue;
            }
            let name = self.cells[first].name;
            let (mut cells, mut open) = (Vec::new(), vec![first]);
            taken[first] = true;
            while let Some(cell) = open.pop() {
                cells.push((cell / rows, cell % rows));
                let (column, row) = (cell / rows, cell % rows);
                let neighbours = [
                    (column > 0).then(|| cell - rows),
                    (column + 1 < self.columns()).then(|| cell + rows),
                    (row > 0).then(|| cell - 1),
                    (row + 1 < rows).then(|| cell + 1),
                ];
                for other in neighbours.into_iter().flatten() {
                    if !taken[other] && self.cells[other].name == name {
                        taken[other] = true;
                        open.push(other);
                    }
                }
            }
            cells.sort_unstable();
            regions.push(Region { name, cells });
        }
        regions
    }
}

/// Cells of one name that touch along their sides.
pub(super) struct Region {
    /// Its place in the list of names.
    pub name: usize,
    /// Column and row of each, sorted.
    pub cells: Vec<(usize, usize)>,
}

/// A corner of the grid: column and row of the cell above and to the right of it.
type Corner = (usize, usize);

impl Region {
    fn has(&self, column: usize, row: usize) -> bool {
        self.cells.binary_search(&(column, row)).is_ok()
    }

    /// Its outlines: the outer one and those of holes, each with the region on its left, and
    /// without its first corner at the end again.
    pub fn outlines(&self) -> Vec<Vec<Corner>> {
        // The sides that it shares with no cell of its own.
        let mut sides: Vec<(Corner, Corner)> = Vec::new();
        for &(i, j) in &self.cells {
            let below = j > 0 && self.has(i, j - 1);
            let before = i > 0 && self.has(i - 1, j);
            let all = [
                (below, (i, j), (i + 1, j)),
                (self.has(i + 1, j), (i + 1, j), (i + 1, j + 1)),
                (self.has(i, j + 1), (i + 1, j + 1), (i, j + 1)),
                (before, (i, j + 1), (i, j)),
            ];
            sides.extend(all.into_iter().filter(|side| !side.0).map(|(_, from, to)| (from, to)));
        }
        sides.sort_unstable();
        let mut outlines = Vec::new();
        while let Some(&(first, mut at)) = sides.first() {
            sides.remove(0);
            let mut corners = vec![first];
            let mut from = first;
            while at != first {
                // Where two of its corners touch, the outline keeps to its own cell: it turns left.
                let next = sides.iter().enumerate().filter(|(_, side)| side.0 == at);
                let next = next.min_by_key(|(_, side)| turn(from, at, side.1));
                let (index, &(_, to)) = next.expect("an outline is closed");
                sides.remove(index);
                if turn(from, at, to) != 0 {
                    corners.push(at);
                }
                (from, at) = (at, to);
            }
            outlines.push(corners);
        }
        outlines
    }

    /// The widest and highest place for a text that is `width` wide and `height` high: the middle
    /// of the largest rectangle of cells that has room for it, whose edges are at `x` and `y`
    /// (units of the drawing).
    pub fn place(&self, x: &[f64], y: &[f64], (width, height): Point) -> Option<Point> {
        let mut best: Option<(f64, Point)> = None;
        for &(i, j) in &self.cells {
            let mut top = usize::MAX;
            for right in i.. {
                let mut end = j;
                while end < top && self.has(right, end) {
                    end += 1;
                }
                top = end;
                if top == j {
                    break;
                }
                let (w, h) = ((x[right + 1] - x[i]).abs(), (y[top] - y[j]).abs());
                let middle = (0.5 * (x[right + 1] + x[i]), 0.5 * (y[top] + y[j]));
                if w >= width && h >= height && best.is_none_or(|(area, _)| w * h > area) {
                    best = Some((w * h, middle));
                }
            }
        }
        best.map(|(_, middle)| middle)
    }
}

/// Negative for a turn to the left, zero straight on, positive for one to the right.
fn turn(from: Corner, at: Corner, to: Corner) -> i64 {
    let less = |a: usize, b: usize| a as i64 - b as i64;
    let (dx, dy) = (less(at.0, from.0), less(at.1, from.1));
    let (ex, ey) = (less(to.0, at.0), less(to.1, at.1));
    dy * ex - dx * ey
}

/// The attribute `d` of closed lines through these corners.
pub(super) fn closed(outlines: &[Vec<Corner>], x: &[f64], y: &[f64]) -> String {
    let mut d = Vec::new();
    for corners in outlines {
        let point = |c: &Corner| format!("{},{}", Num(x[c.0]), Num(y[c.1]));
        let points: Vec<String> = corners.iter().map(point).collect();
        d.push(format!("M{}z", points.join("L")));
    }
    d.join("\n")
}

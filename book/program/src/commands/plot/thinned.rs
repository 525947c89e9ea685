//! A line of any number of points, thinned to a few that look the same.

/// Groups of neighbours, of which the lowest and the highest point are kept: a line through them
/// covers what the line through all would cover, to the width of a group.
#[derive(Debug, Default)]
pub struct Thinned {
    groups: Vec<Group>,
    /// Points in a group, a power of two; 0 before the first.
    size: u64,
    /// Points so far.
    count: u64,
    last: Option<(f64, f64)>,
}

/// More than a plot has pixels across, when they are halved.
const MOST: usize = 2048;

#[derive(Clone, Copy, Debug)]
struct Group {
    low: Point,
    high: Point,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    /// Which point it is, in the order of the line.
    n: u64,
    x: f64,
    y: f64,
}

impl Group {
    fn with(self, other: Self) -> Self {
        Self {
            low: if other.low.y < self.low.y { other.low } else { self.low },
            high: if other.high.y > self.high.y { other.high } else { self.high },
        }
    }
}

impl Thinned {
    /// Adds the next point.
    pub fn add(&mut self, x: f64, y: f64) {
        let point = Point { n: self.count, x, y };
        let group = Group { low: point, high: point };
        self.size = self.size.max(1);
        if self.count.is_multiple_of(self.size) {
            if self.groups.len() == MOST {
                let pairs = self.groups.chunks(2);
                self.groups = pairs.map(|pair| pair[0].with(pair[pair.len() - 1])).collect();
                self.size *= 2;
            }
            self.groups.push(group);
        } else if let Some(last) = self.groups.last_mut() {
            *last = last.with(group);
        }
        self.count += 1;
        self.last = Some((x, y));
    }

    /// The points that are kept, in order; the last one of all among them.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        let kept = self.groups.iter().flat_map(|&Group { low, high }| {
            let (one, other) = if low.n <= high.n { (low, high) } else { (high, low) };
            let other = (other.n != one.n).then_some(other);
            [Some(one), other].into_iter().flatten()
        });
        let last = self.groups.last().map(|group| group.low.n.max(group.high.n));
        let end = self.last.filter(|_| last.is_some_and(|n| n + 1 < self.count));
        kept.map(|Point { x, y, .. }| (x, y)).chain(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: memory that grows with the run; an extreme that is lost, or moved; points out of
    /// order; a line that ends before its last point.
    #[test]
    fn a_long_line_keeps_its_extremes_in_order() {
        let wave = |i: u32| (f64::from(i), f64::from(i.wrapping_mul(2_654_435_761) >> 8));
        for count in [1, 2, 2047, 2048, 2049, 5000, 1_000_000] {
            let mut line = Thinned::default();
            (0..count).for_each(|i| {
                let (x, y) = wave(i);
                line.add(x, y);
            });
            let points: Vec<(f64, f64)> = line.points().collect();
            assert!(points.len() <= 2 * MOST + 1, "{}", points.len());
            assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
            assert!(points.iter().all(|&(x, y)| wave(x as u32) == (x, y)));
            assert_eq!(points.last(), Some(&wave(count - 1)));
            if count <= MOST as u32 {
                assert_eq!(points.len(), count as usize);
            }
            // Of each thousandth of the line, the extremes are no further away than a group.
            let all: Vec<f64> = (0..count).map(|i| wave(i).1).collect();
            for highest in [true, false] {
                let best = |a: f64, b: f64| if highest { a.max(b) } else { a.min(b) };
                let all = all.iter().copied().reduce(best);
                assert_eq!(points.iter().map(|point| point.1).reduce(best), all);
            }
        }
    }
}

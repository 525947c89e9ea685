//! The coefficients as the build script packs them, number by number.
//!
//! The book's page carries the tables, so they are small: a number that comes again is told by its
//! place, 1/6 is two small numbers, and nothing is to be parsed. A double is handed on bit by bit,
//! and the division of a fraction gives the nearest one, as its digits did.

/// What an entry may have, each a bit of its first number; with `build.rs`.
pub const A_THETA: usize = 1;
pub const B_THETA: usize = 2;
pub const OLD_FORCE: usize = 4;
pub const TIMES: usize = 8;
pub const WRONG: usize = 16;

/// The names of the entries, a line each.
pub const NAMES: &str = include_str!(concat!(env!("OUT_DIR"), "/names"));
static TABLES: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/tables"));
static FRACTIONS: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/fractions"));
/// The first bytes of all numbers, then the second ones, up to the eighth.
static SIZES: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/sizes"));

/// What is still to be read.
pub struct Packed {
    tables: &'static [u8],
    fractions: &'static [u8],
    /// How many of the sizes are read.
    sizes: usize,
    /// The sizes that came, in their order.
    seen: Vec<f64>,
}

impl Packed {
    /// From the beginning.
    pub fn new() -> Self {
        Self { tables: TABLES, fractions: FRACTIONS, sizes: 0, seen: Vec::new() }
    }

    /// A length, or what a number stands for.
    pub fn whole(&mut self) -> usize {
        whole(&mut self.tables)
    }

    /// A number.
    pub fn number(&mut self) -> f64 {
        let code = self.whole();
        let size = match code >> 1 {
            0 => {
                let n = SIZES.len() / 8;
                let bytes = core::array::from_fn(|i| SIZES[i * n + self.sizes]);
                self.sizes += 1;
                f64::from_le_bytes(bytes)
            }
            1 => {
                let p = whole(&mut self.fractions) as f64;
                p / whole(&mut self.fractions) as f64
            }
            at => self.seen[at - 2],
        };
        if code < 4 {
            self.seen.push(size);
        }
        if code & 1 == 1 { -size } else { size }
    }

    /// A list of what `one` reads.
    pub fn list<T>(&mut self, mut one: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let length = self.whole();
        (0..length).map(|_| one(self)).collect()
    }

    /// A row.
    pub fn numbers(&mut self) -> Vec<f64> {
        self.list(Self::number)
    }

    /// Rows.
    pub fn rows(&mut self) -> Vec<Vec<f64>> {
        self.list(Self::numbers)
    }
}

/// Seven bits a byte, the lowest first.
fn whole(bytes: &mut &[u8]) -> usize {
    let (mut n, mut shift) = (0, 0);
    while let Some((&byte, rest)) = bytes.split_first() {
        *bytes = rest;
        n |= usize::from(byte & 127) << shift;
        shift += 7;
        if byte < 128 {
            break;
        }
    }
    n
}

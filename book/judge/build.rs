//! Packs known-answers/coefficients.json for the identification of rows: each number once, and no
//! JSON to be read, because the book's page carries the tables with it. `src/rows/packed.rs` reads
//! what is written here, and its test holds it against the file.

use std::collections::HashMap;
use std::{env, fs, path::Path};

use serde_json::Value;

/// What an entry may have, each a bit of its first number; with `packed.rs`.
const MAY_HAVE: [&str; 5] = ["a_theta", "b_theta", "old_force", "times", "wrong"];
/// The names of a formula that are given, and its signs; with `candidates.rs`.
const NAMES: [&str; 6] = ["q", "p", "h", "c", "theta", "omega"];
const SIGNS: [&str; 5] = ["f", "+", "-", "*", "/"];

#[derive(Default)]
struct Packed {
    /// The tables: lengths and numbers as [`Packed::whole`] writes them.
    tables: Vec<u8>,
    /// Numbers that are short fractions.
    fractions: Vec<u8>,
    /// The others.
    sizes: Vec<f64>,
    /// The place of each size in the order in which they came.
    seen: HashMap<u64, usize>,
}

fn main() {
    let file = "known-answers/coefficients.json";
    println!("cargo::rerun-if-changed={file}");
    println!("cargo::rerun-if-changed=build.rs");
    let text = fs::read_to_string(file).expect("the file is there");
    let entries: Value = serde_json::from_str(&text).expect("the file is JSON");
    let mut packed = Packed::default();
    let mut names = Vec::new();
    for entry in list(&entries) {
        names.push(entry["name"].as_str().expect("a name"));
        packed.entry(entry);
    }
    // Numbers that are near have the same first bytes, and those are packed again: so byte by byte.
    let byte = |i: usize| packed.sizes.iter().map(move |size| size.to_le_bytes()[i]);
    let sizes: Vec<u8> = (0..8).flat_map(byte).collect();
    let out = env::var("OUT_DIR").expect("Cargo says it");
    let write = |name: &str, bytes: &[u8]| {
        fs::write(Path::new(&out).join(name), bytes).expect("a folder of its own");
    };
    write("names", names.join("\n").as_bytes());
    write("tables", &packed.tables);
    write("fractions", &packed.fractions);
    write("sizes", &sizes);
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// Seven bits a byte, the lowest first.
fn whole(bytes: &mut Vec<u8>, mut n: usize) {
    while n > 127 {
        bytes.push(n as u8 | 128);
        n >>= 7;
    }
    bytes.push(n as u8);
}

impl Packed {
    fn entry(&mut self, entry: &Value) {
        let has = |bit: usize| usize::from(entry.get(MAY_HAVE[bit]).is_some()) << bit;
        self.whole((0..MAY_HAVE.len()).map(has).sum());
        let keys: &[&str] = match entry["kind"].as_str().expect("a kind") {
            "rk" => self.kind(0, &["c", "a", "b", "a_theta", "b_theta", "times"]),
            "rkn" => self.kind(1, &["c", "a", "b", "a_theta", "b_theta", "times"]),
            "splitting" => self.kind(2, &["moves"]),
            "multistep" => self.kind(3, &["values", "explicit", "implicit"]),
            _ => self.kind(4, &[]),
        };
        for key in keys {
            if !MAY_HAVE.contains(key) || entry.get(key).is_some() {
                self.value(&entry[key]);
            }
        }
        if keys.is_empty() {
            self.formula(list(&entry["formula"]));
        }
    }

    fn kind<'a>(&mut self, kind: usize, keys: &'a [&'a str]) -> &'a [&'a str] {
        self.whole(kind);
        keys
    }

    /// A number, or a list with its length.
    fn value(&mut self, value: &Value) {
        if let Some(x) = value.as_f64() {
            return self.number(x);
        }
        self.whole(list(value).len());
        list(value).iter().for_each(|value| self.value(value));
    }

    fn whole(&mut self, n: usize) {
        whole(&mut self.tables, n);
    }

    /// The sign is the lowest bit; above it 0 stands for the next of the others, 1 for the next
    /// fraction, and n + 2 for the number whose size came as the nth.
    fn number(&mut self, x: f64) {
        let size = x.abs();
        let next = self.seen.len();
        let at = self.seen.get(&size.to_bits()).copied();
        let code = at.map_or_else(
            || {
                self.seen.insert(size.to_bits(), next);
                if let Some((p, q)) = fraction(size) {
                    whole(&mut self.fractions, p as usize);
                    whole(&mut self.fractions, q as usize);
                    return 1;
                }
                self.sizes.push(size);
                0
            },
            |at| at + 2,
        );
        self.whole(code << 1 | usize::from(x.is_sign_negative()));
    }

    /// Lines of a name and words: a sign, 5 before a number, 6 and more for a name.
    fn formula(&mut self, lines: &[Value]) {
        let mut names = NAMES.to_vec();
        self.whole(lines.len());
        for line in lines {
            let line = line.as_str().expect("a text");
            let (name, words) = line.split_once(" = ").expect("name = words");
            let at = names.iter().position(|other| *other == name);
            let words: Vec<&str> = words.split(' ').collect();
            self.whole(at.unwrap_or(names.len()));
            self.whole(words.len());
            for word in words {
                let sign = SIGNS.iter().position(|sign| *sign == word);
                let own = names.iter().position(|name| *name == word);
                match sign.or(own.map(|own| own + SIGNS.len() + 1)) {
                    Some(code) => self.whole(code),
                    None => {
                        self.whole(SIGNS.len());
                        self.number(word.parse().expect("a number"));
                    }
                }
            }
            if at.is_none() {
                names.push(name);
            }
        }
    }
}

/// The fraction p/q in seven bytes whose division gives this double, by continued fractions.
fn fraction(x: f64) -> Option<(u64, u64)> {
    let (mut before, mut here, mut rest) = ((0, 1), (1, 0), x);
    for _ in 0..20 {
        let digit = rest.floor();
        if digit > 1e9 {
            return None;
        }
        let next = (digit as u64 * here.0 + before.0, digit as u64 * here.1 + before.1);
        (before, here) = (here, next);
        let bits = |n: u64| (64 - n.leading_zeros()).div_ceil(7).max(1);
        if bits(here.0) + bits(here.1) > 7 {
            return None;
        }
        if here.0 as f64 / here.1 as f64 == x {
            return Some(here);
        }
        rest = 1.0 / (rest - digit);
    }
    None
}

//! A row of numbers as text, millions a second: half the time of a simulation is spent here.

/// How a row looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// `0.0,1.0` and the end of the line.
    Csv,
    /// `{"t":0.0,"theta":1.0}` on a line of its own, behind a comma but for the first.
    Json,
}

/// A place for rows of some columns, each written over the one before.
pub struct Line {
    look: Look,
    /// The names of the columns as JSON has them, with quotes and colon.
    names: Vec<String>,
    digits: ryu::Buffer,
    is_first: bool,
    /// As long as a row can be.
    text: Box<[u8]>,
}

impl Line {
    /// For rows with these columns.
    pub fn new(look: Look, columns: &[&str]) -> Self {
        let names: Vec<String> = columns.iter().map(|name| format!("\"{name}\":")).collect();
        // A number has at most 24 characters.
        let longest = names.iter().map(|name| name.len() + 24 + 1).sum::<usize>() + 4;
        let text = vec![0; longest].into_boxed_slice();
        Self { look, names, digits: ryu::Buffer::new(), is_first: true, text }
    }

    /// The row of these values, one for each column, which must be finite: so that each reads back
    /// to the same bits.
    pub fn row(&mut self, values: &[f64]) -> &[u8] {
        let Self { look, names, digits, is_first, text } = self;
        let mut length = 0;
        let mut put = |part: &[u8]| {
            text[length..length + part.len()].copy_from_slice(part);
            length += part.len();
        };
        let is_json = *look == Look::Json;
        if is_json {
            put(if *is_first { b"\n{" } else { b",\n{" });
            *is_first = false;
        }
        for (column, (name, value)) in names.iter().zip(values).enumerate() {
            if column > 0 {
                put(b",");
            }
            if is_json {
                put(name.as_bytes());
            }
            put(digits.format_finite(*value).as_bytes());
        }
        put(if is_json { b"}" } else { b"\n" });
        &self.text[..length]
    }
}

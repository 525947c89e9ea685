//! A text as columns of numbers with their digits.

use super::report::Refusal;

/// A number as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Its value; NaN where there is no number.
    pub value: f64,
    /// Decimals: 3 of 0.125 and of 1.25e-1.
    pub decimals: i32,
    /// Digits from the first that is not 0 on, with the zeros at the end.
    pub significant: i32,
    /// How many zeros there are at the end.
    pub zeros: i32,
}

impl Cell {
    const NOTHING: Self = Self { value: f64::NAN, decimals: 0, significant: 0, zeros: 0 };

    /// The shortest digits that read back to it.
    pub fn of(value: f64) -> Self {
        read(&format!("{value:?}"), '.').unwrap_or(Self::NOTHING)
    }
}

/// What was written over a column, and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The heading; empty if there is none.
    pub heading: String,
    /// A cell for each row.
    pub cells: Vec<Cell>,
}

/// The columns that are numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The line of each row in the text, counted from 1.
    pub lines: Vec<usize>,
    /// How many lines after the first row are none.
    pub left_out: usize,
}

/// How a table may be written: what separates columns, and the decimal sign.
const FORMS: [(Option<char>, char); 8] = [
    (Some(';'), '.'),
    (Some(';'), ','),
    (Some('\t'), '.'),
    (Some('\t'), ','),
    (Some('|'), '.'),
    (Some(','), '.'),
    (None, '.'),
    (None, ','),
];
/// More columns, or a longer line, no table of a run has.
const MOST_COLUMNS: usize = 64;
const LONGEST: usize = 4096;
/// So many rows are enough to see how a table is written.
const SAMPLE: usize = 200;
/// So many rows are read.
pub const MOST_ROWS: usize = 1_000_000;

/// Reads a table.
///
/// # Errors
/// What it is, if it is none.
pub fn parse(bytes: &[u8]) -> Result<Table, Refusal> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Refusal::Empty);
    }
    // UTF-16 has a zero in every other byte of a number.
    if bytes[..bytes.len().min(1 << 16)].contains(&0) {
        return Err(Refusal::Binary);
    }
    let lines = || {
        // A byte order mark is no part of a heading.
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
        text.split(move |&b| b == end).enumerate()
    };
    let form = find_form(lines().map(|(_, line)| line))?;
    let mut rows = Rows::default();
    let (mut width, mut heading) = (0, String::new());
    for (number, line) in lines() {
        let line = String::from_utf8_lossy(&line[..line.len().min(LONGEST)]);
        if line.trim().is_empty() {
            continue;
        }
        let cells = split(&line, form);
        let count = cells.iter().filter(|cell| cell.is_some()).count();
        if rows.lines.is_empty() && (count < 2 || count * 2 < cells.len()) {
            heading = line.into_owned();
            continue;
        }
        if rows.lines.is_empty() {
            width = cells.len();
            rows.columns = vec![Vec::new(); width];
        }
        let blank = cells.len() != width || count == 0;
        if blank {
            rows.left_out += 1;
            continue;
        }
        if rows.lines.len() == MOST_ROWS {
            break;
        }
        rows.lines.push(number + 1);
        for (column, cell) in rows.columns.iter_mut().zip(cells) {
            column.push(cell.unwrap_or(Cell::NOTHING));
        }
    }
    rows.table(&heading, form)
}

#[derive(Default)]
struct Rows {
    columns: Vec<Vec<Cell>>,
    lines: Vec<usize>,
    left_out: usize,
}

impl Rows {
    fn table(self, heading: &str, form: (Option<char>, char)) -> Result<Table, Refusal> {
        let Self { columns, lines, left_out } = self;
        match lines.len() {
            0 => return Err(Refusal::NoRows),
            1 => return Err(Refusal::OneRow),
            // What has more lines that are no rows than rows is not a table.
            rows if left_out > rows => return Err(Refusal::NoRows),
            _ => {}
        }
        let headings = headings(heading, form, columns.len());
        let numbers = |cells: &[Cell]| cells.iter().filter(|cell| cell.value.is_finite()).count();
        let columns = columns.into_iter().zip(headings);
        let columns = columns
            .filter(|(cells, _)| numbers(cells) * 2 > cells.len())
            .map(|(cells, heading)| Column { heading, cells })
            .collect();
        Ok(Table { columns, lines, left_out })
    }
}

/// The words over the columns, of which a heading may separate otherwise than its rows.
fn headings(line: &str, form: (Option<char>, char), width: usize) -> Vec<String> {
    let line = line.trim().trim_start_matches(['#', '%', '!', '/']).trim();
    let by = |separator: Option<char>| -> Vec<String> {
        let words: Vec<&str> = match separator {
            Some(sign) => line.trim_matches('|').split(sign).collect(),
            None => line.split_whitespace().collect(),
        };
        let bare = |word: &str| word.trim().trim_matches(['"', '\'', '[', ']']).to_string();
        words.into_iter().map(bare).collect()
    };
    let forms = [form.0, Some(','), Some(';'), Some('\t'), None];
    let found = forms.into_iter().map(by).find(|words| words.len() == width);
    found.unwrap_or_else(|| vec![String::new(); width])
}

/// The form in which most of the first lines have the most numbers.
fn find_form<'a>(lines: impl Iterator<Item = &'a [u8]>) -> Result<(Option<char>, char), Refusal> {
    let lines: Vec<_> = lines
        .filter(|line| !line.iter().all(u8::is_ascii_whitespace))
        .take(SAMPLE)
        .map(|line| String::from_utf8_lossy(&line[..line.len().min(LONGEST)]))
        .collect();
    let strange = |line: &&std::borrow::Cow<'_, str>| {
        line.chars().any(|c| c == '\u{fffd}' || (c.is_control() && !matches!(c, '\t' | '\r')))
    };
    if lines.iter().filter(strange).count() * 2 > lines.len() {
        return Err(Refusal::Binary);
    }
    let score = |form| {
        let widths = lines.iter().map(|line| {
            let cells = split(line, form);
            let count = cells.iter().filter(|cell| cell.is_some()).count();
            // One number and many words are a sentence.
            if count < 2 || count * 2 < cells.len() { (0, 0) } else { (cells.len(), count) }
        });
        let mut rows = [0_usize; MOST_COLUMNS + 1];
        for (width, count) in widths {
            rows[width] += usize::from(width > 0) * count;
        }
        rows.into_iter().max().unwrap_or(0)
    };
    let scored = FORMS.map(|form| (score(form), form));
    let best = scored.iter().rev().max_by_key(|(score, _)| *score);
    match best {
        Some(&(score, form)) if score > 0 => Ok(form),
        _ => {
            let one = lines.iter().filter(|line| read(line.trim(), '.').is_some()).count();
            Err(if one > 1 { Refusal::OneColumn } else { Refusal::NoRows })
        }
    }
}

fn split(line: &str, (separator, point): (Option<char>, char)) -> Vec<Option<Cell>> {
    let around = ['[', ']', '(', ')', '{', '}', ' ', '|'];
    let line = line.trim_matches(around).trim_end_matches([',', ';']).trim_matches(around);
    let cell = |word: &str| {
        let bare = word.trim().trim_matches(['"', '\'', '[', ']', '(', ')', '|']);
        if bare.is_empty() || is_no_number(bare) {
            return None;
        }
        read(bare.trim(), point)
    };
    match separator {
        Some(sign) => line.split(sign).take(MOST_COLUMNS).map(cell).collect(),
        None => line.split_whitespace().take(MOST_COLUMNS).map(cell).collect(),
    }
}

/// What programs write where there is no number.
fn is_no_number(word: &str) -> bool {
    let word = word.trim_start_matches(['+', '-']);
    ["nan", "inf", "infinity", "na", "null", "none"].iter().any(|no| word.eq_ignore_ascii_case(no))
}

/// A number as programs print it, if it is one.
fn read(word: &str, point: char) -> Option<Cell> {
    let mut text = String::with_capacity(word.len());
    let (mut decimals, mut significant, mut after, mut leading) = (0, 0, false, true);
    let mut zeros = 0;
    let mut exponent = None;
    for (at, c) in word.char_indices() {
        match c {
            '0'..='9' => {
                text.push(c);
                leading &= c == '0';
                zeros = if c == '0' { zeros + 1 } else { 0 };
                significant += i32::from(!leading);
                decimals += i32::from(after);
            }
            c if c == point && !after => {
                after = true;
                text.push('.');
            }
            '+' | '-' | '−' if at == 0 => text.push(if c == '+' { '+' } else { '-' }),
            'e' | 'E' | 'd' | 'D' if text.ends_with(|c: char| c.is_ascii_digit() || c == '.') => {
                let shift: i32 = word[at + 1..].replace('−', "-").parse().ok()?;
                exponent = Some(shift);
                break;
            }
            _ => return None,
        }
    }
    if !text.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    if let Some(shift) = exponent {
        text.push_str(&format!("e{shift}"));
        decimals -= shift;
    }
    let value: f64 = text.parse().ok()?;
    value.is_finite().then_some(Cell { value, decimals, significant, zeros })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<Vec<f64>> {
        let table = parse(text.as_bytes()).unwrap();
        table.columns.iter().map(|c| c.cells.iter().map(|cell| cell.value).collect()).collect()
    }

    /// Catches: a separator taken for a decimal sign or the reverse, a heading taken for a row, a
    /// sign or an exponent misread.
    #[test]
    fn rows_are_read_however_they_are_written() {
        let expected = vec![vec![0.0, 0.5], vec![1.5, -1.25], vec![0.0, 0.001]];
        for text in [
            "t,theta,omega\n0,1.5,0\n0.5,-1.25,1e-3\n",
            "Zeit;Winkel;Geschw.\r\n0;1,5;0\r\n0,5;-1,25;0,001\r\n",
            "0 1.5 0\n0.5 -1.25 .001",
            "0,0\t1,5\t0,0\n0,5\t−1,25\t1,0E-3\n",
            "0,0 1,5 0,0\n0,5 -1,25 0,001\n",
            "# a run of 3 seconds\n[0.0, 1.5, 0.0],\n[0.5, -1.25, 0.001]\n",
            "| t | x | v |\n|---|---|---|\n| 0 | 1.5 | 0 |\n| 0.5 | -1.25 | 1D-3 |\n",
            "0.0, 1.5, 0.0\n\n0.5, -1.25, 0.001\n# end\n",
        ] {
            assert_eq!(values(text), expected, "{text}");
        }
        assert_eq!(parse(b"t (s), angle\n0,1\n1,2\n").unwrap().columns[1].heading, "angle");
    }

    /// Catches: trailing zeros that are not counted, an exponent that is.
    #[test]
    fn digits_are_counted() {
        let digits = |text: &str| {
            let Cell { decimals, significant, .. } = read(text, '.').unwrap();
            (decimals, significant)
        };
        for (text, expected) in
            [("0.0120", (4, 3)), ("-1.250e-1", (4, 4)), ("12", (0, 2)), ("1e3", (-3, 1))]
        {
            assert_eq!(digits(text), expected, "{text}");
        }
    }

    /// Catches: a panic, or an answer, where there is no table.
    #[test]
    fn what_is_no_table_is_refused() {
        let mut noise = fastrand::Rng::with_seed(1);
        let mut bytes: Vec<u8> = (0..100_000).map(|_| noise.u8(..)).collect();
        assert_eq!(parse(&bytes), Err(Refusal::Binary));
        bytes.iter_mut().for_each(|byte| *byte = *byte | 128 | 1);
        assert_eq!(parse(&bytes), Err(Refusal::Binary));
        assert_eq!(parse(b" \n \n"), Err(Refusal::Empty));
        assert_eq!(parse(b"0 1 0\n"), Err(Refusal::OneRow));
        assert_eq!(parse(b"1\n2\n3\n"), Err(Refusal::OneColumn));
        let text = "In the year 1673, Huygens published it.\nOn 3 pages, 2 figures.\n";
        assert_eq!(parse(text.as_bytes()), Err(Refusal::NoRows));
    }
}

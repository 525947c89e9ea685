//! The tables of snapshots, which a chapter includes as data, in Markdown.

use anyhow::{Result, anyhow};
use pendula_study::report::table::Table;

use super::markdown::splice;
use crate::book::{Pattern, pattern};

/// The text with each table of data as it is read. Data has a row `*`, which says what the columns
/// hold.
pub fn set(text: &str) -> Result<String> {
    static DATA: Pattern =
        Pattern::new(|| pattern(r"(?m)^\| .*\n\| -.*\n\| \* +\|.*\n(?:\|.*\n?)*"));
    let edit = |found: regex::Match<'_>| {
        let table = Table::read(found.as_str());
        let table = table.map_err(|why| anyhow!("{}: {why}", first_line(found.as_str())))?;
        Ok((found.range(), table.typeset().to_markdown()))
    };
    Ok(splice(text, DATA.find_iter(text).map(edit).collect::<Result<Vec<_>>>()?))
}

fn first_line(text: &str) -> &str {
    text.lines().next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::set;

    /// Catches: data that a reader sees; the text around it, or a table that an author wrote, set
    /// otherwise; a row that is lost because it is not as wide as the others.
    #[test]
    fn data_is_set_and_nothing_else() {
        let written = "Text 1e-3.\n\n| a | b |\n| --- | --: |\n| 1e-3 | -1 |\n\nMore.\n";
        assert_eq!(set(written).unwrap(), written);
        let data = "| id | Name | ΔH |\n| -- | ---- | -: |\n| *  |      | T1.*.dH |\n\
                    | a  | A    | ≠ 1e-3 |\n";
        let table = "| Name |       ΔH |\n| ---- | -------: |\n| A    | ≠ 1 × 10⁻³ |\n";
        let bare = |text: &str| text.replace([' ', '-'], "");
        let set_data = set(&format!("{written}\n{data}\n{written}")).unwrap();
        assert_eq!(bare(&set_data), bare(&format!("{written}\n{table}\n{written}")));
        let uneven = data.replace("| A    ", "");
        assert!(set(&uneven).unwrap_err().to_string().contains("| id | Name | ΔH |: rows of"));
    }
}

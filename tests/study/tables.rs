//! Tables as data, as the book sets them, and as text.

use pendula_study::report::snapshots::Kind;
use pendula_study::report::table::{Cell, Column, Quantity, Table};
use rstest::rstest;

use crate::snapshots::SNAPSHOTS;

fn table() -> Table {
    let order = Column::from("order").is(Quantity::Order).of("T2.*.order");
    let columns = ["id".into(), "Method".into(), order, "h".into(), "why".into()];
    let mut table = Table::new(columns).with_remarks(1);
    let cells =
        |id: &str, words: [&str; 4]| [id].into_iter().chain(words).map(Cell::from).collect();
    let rk4: Vec<Cell> = cells("rk4", ["RK4", "4", "1e-3", "it is quick and needs no memory"]);
    table.push(rk4);
    let mut verlet: Vec<Cell> = cells("vv", ["Störmer–Verlet", "1", "-1 ± 2", ""]);
    verlet[2].differs = true;
    table.push(verlet);
    table
}

/// Catches: columns that are not aligned, a rule of another width, blanks at the end of a line; a
/// number as programs write it, or an id, shown to a reader; a mark that is lost.
#[test]
fn text_stands_in_columns() {
    let expected = "Method          order         h  why\n\
                    ────────────────────────────────────\n\
                    RK4                 4  1 × 10⁻³  it is quick and needs no memory\n\
                    Störmer–Verlet    ≠ 1    −1 ± 2\n";
    assert_eq!(table().typeset().to_text(), expected);
}

/// Catches: a table of a snapshot in which two rows have the same name, or that is not read back as
/// it was written: a bar in a cell, such as that of |H|, that begins a column; a mark or a quantity
/// that is lost; a cell that is moved.
#[test]
fn each_table_of_a_snapshot_is_read_back() {
    let mut made = vec![table().to_data()];
    made[0] += "| x  | \\|H\\| | 1 | 2 | 3 |\n";
    let tables = SNAPSHOTS.iter().filter(|snapshot| snapshot.kind == Kind::Table);
    made.extend(tables.map(|snapshot| snapshot.content().to_string()));
    assert!(made.len() > 15);
    for (index, text) in made.iter().enumerate() {
        let read = Table::read(text).expect("a table");
        let mut ids: Vec<&str> = read.rows().map(|row| row.id()).collect();
        assert_eq!(ids.len(), text.lines().count() - 3, "{text}");
        ids.sort_unstable();
        assert!(ids.windows(2).all(|two| two[0] != two[1]), "two rows of one name: {ids:?}");
        let again = Table::read(&read.to_data()).expect("a table");
        assert!(read == again, "{text}");
        if index > 0 {
            // But for the padding of remarks.
            let bare = |text: &str| text.split_whitespace().collect::<String>().replace('-', "");
            assert_eq!(bare(&read.to_data()), bare(text));
        }
    }
    let read = Table::read(&made[0]).expect("a table");
    let row = read.rows().last().expect("a row");
    assert_eq!(row.get("Method"), Some(&Cell::from("|H|")));
    let rows: Vec<_> = read.rows().collect();
    assert_eq!(rows[1].cells, table().rows().nth(1).expect("a row").cells);
    assert!(rows[1].of(Quantity::Order).eq([&rows[1].cells[2]]) && rows[1].cells[2].differs);
    let claims: Vec<_> = read.columns().iter().map(|column| column.claim("vv")).collect();
    assert_eq!(claims, [None, None, Some("T2.vv.order".to_string()), None, None]);
}

/// Catches: another text that is taken for a table; a quantity that is misspelt, and passed over; a
/// reader who looks beyond the last column.
#[test]
fn what_is_no_table_is_refused() {
    let text = table().to_data();
    let first_lines = |n: usize| text.lines().take(n).collect::<Vec<_>>().join("\n");
    assert!(Table::read(&first_lines(3)).is_ok_and(|table| table.rows().len() == 0));
    // Of one column that is all there is to see.
    assert!(Table::read("| id |\n| -- |\n| a |\n").is_ok_and(|table| table.first() == 0));
    let uneven = format!("{text}| one |\n");
    let no_rule = first_lines(1) + "\n" + text.lines().nth(2).expect("a row");
    let unknown = text.replace("order T2", "ordr T2");
    for other in ["", "words", &first_lines(1), &uneven, &text[2..], &no_rule, &unknown] {
        assert!(Table::read(other).is_err(), "{other}");
    }
}

/// Catches: an exponent or a sign that is lost, a remark that is read as part of the number, a word
/// taken for a number, or one in words; a digit of the exponent, or a zero in front, counted.
#[rstest]
#[case("1.10271e-5", Some((1.10271e-5, 6)), "1.10271 × 10⁻⁵")]
#[case("-5.300366", Some((-5.300366, 7)), "−5.300366")]
#[case("6e-89", Some((6e-89, 1)), "6 × 10⁻⁸⁹")]
#[case("0.0193 (Table 5)", Some((0.0193, 3)), "0.0193 (Table 5)")]
#[case("15 ± 2e1", Some((15.0, 2)), "15 ± 2 × 10¹")]
#[case("—", None, "—")]
#[case("off by -1e-6", None, "off by -1e-6")]
#[case("well-known", None, "well-known")]
#[case("nan", None, "nan")]
#[case("-nan", None, "-nan")]
#[case("1e999", None, "1e999")]
#[case("", None, "")]
fn a_number_is_read_and_typeset(
    #[case] text: &str,
    #[case] number: Option<(f64, usize)>,
    #[case] typeset: &str,
) {
    let cell = Cell::from(text);
    assert_eq!(cell.number().map(|number| (number.value, number.digits)), number);
    assert_eq!(cell.typeset(), typeset);
}

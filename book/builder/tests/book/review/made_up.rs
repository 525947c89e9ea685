//! Made-up pairs of versions: each moved cell is shown once, under its own name.

use std::collections::{BTreeMap, BTreeSet};

use pendula_book::review::cells::{Value, differences};
use pendula_book::review::groups::{Group, Item, groups};
use pendula_book::versions::{Content, Version};
use pendula_study::report::snapshots::Kind;
use pendula_study::report::table::Table;
use proptest::prelude::*;

use super::between;

/// A block of rows: one with a name of its own, and what is said of it in rows without.
#[derive(Clone, Debug)]
struct Block {
    name: usize,
    values: [u8; 2],
    of_it: Vec<[u8; 2]>,
}

/// Few values of few digits, so that many coincide.
fn block(name: usize) -> impl Strategy<Value = Block> {
    let values = || [0..4_u8, 0..4_u8];
    (values(), prop::collection::vec(values(), 0..3)).prop_map(move |(values, of_it)| Block {
        name,
        values,
        of_it,
    })
}

/// Blocks of some of six names, in any order.
fn blocks() -> impl Strategy<Value = Vec<Block>> {
    let all: Vec<_> = (0..6).map(block).collect();
    (all, prop::collection::vec(any::<bool>(), 6)).prop_flat_map(|(all, kept)| {
        let kept = all.into_iter().zip(kept).filter(|(_, kept)| *kept);
        Just(kept.map(|(block, _)| block).collect::<Vec<_>>()).prop_shuffle()
    })
}

/// The cells of the blocks, by what they are.
fn cells(blocks: &[Block]) -> BTreeMap<(usize, usize, usize), String> {
    let mut cells = BTreeMap::new();
    for Block { name, values, of_it } in blocks {
        for (row, values) in [values].into_iter().chain(of_it).enumerate() {
            for (column, value) in values.iter().enumerate() {
                cells.insert((*name, row, column), format!("{value}.0"));
            }
        }
    }
    cells
}

fn table(blocks: &[Block]) -> Table {
    let mut table = Table::new(["Quantity", "found", "known"]);
    for Block { name, values, of_it } in blocks {
        let row = |name: String, values: &[u8; 2]| {
            let values = values.map(|value| format!("{value}.0"));
            [name].into_iter().chain(values).collect::<Vec<_>>()
        };
        table.push(row(format!("quantity {name}"), values));
        of_it.iter().for_each(|values| table.push(row("its error".to_string(), values)));
    }
    table
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    /// Catches: a cell that is compared with that of another row where rows are inserted, left out
    /// or exchanged and short numbers coincide; one that is named after another row, left out, or
    /// shown twice.
    #[test]
    fn each_moved_cell_is_shown_once_under_its_own_name(old in blocks(), new in blocks()) {
        let differ = differences("made_up", Some(&table(&old)), Some(&table(&new)));
        let (before, after) = (cells(&old), cells(&new));
        let places: BTreeSet<_> = before.keys().chain(after.keys()).collect();
        let repeats = [&old, &new].map(|v| v.iter().map(|block| block.of_it.len()).sum::<usize>());
        let mut expected: Vec<_> = places
            .into_iter()
            .filter(|place| before.get(place) != after.get(place))
            .map(|place| {
                let (name, row, column) = *place;
                let own = match row {
                    0 => format!("quantity {name}"),
                    1 => format!("its error, of quantity {name}"),
                    nth => format!("its error, of quantity {name} ({nth})"),
                };
                (own, ["found", "known"][column], before.get(place), after.get(place))
            })
            .collect();
        let text = |value: &Option<Value>| value.as_ref().map(|value| value.text.clone());
        let said: Vec<_> = differ
            .iter()
            .map(|cell| (cell.row.clone(), cell.column.clone(), text(&cell.old), text(&cell.new)))
            .collect();
        let mut found: Vec<_> = said
            .iter()
            .map(|(row, column, old, new)| (row.clone(), &**column, old.as_ref(), new.as_ref()))
            .collect();
        // A row that stands alone with its name needs no other.
        if repeats.iter().any(|repeats| *repeats > 1) {
            expected.sort();
            found.sort();
            prop_assert_eq!(found, expected);
        }
        let groups = groups(differ.clone());
        let shown: Vec<_> = groups.iter().flat_map(Group::items).flat_map(Item::cells).collect();
        prop_assert_eq!(shown, differ.iter().collect::<Vec<_>>());
    }
}

/// Catches: a claim of the ledger that is taken for a repetition of one of two numbers that both
/// moved as it did, or of one with few digits; a row of Table 7 taken for that of its neighbour
/// where a row is inserted above.
#[test]
fn a_number_that_may_be_another_stands_by_itself() {
    let made = |measured: [&str; 2], sentence: &str, first: &str| {
        let [a, b] = measured;
        let content = |text: String| Content { kind: Kind::Table, text };
        let table_7 = format!(
            "| Quantity | measured |\n| --- | --- |\n{first}| a period | {a} |\n\
             | its error | {b} |\n"
        );
        let rows = first.replace("| a new ", "| `T7.new` a new ");
        let cells = format!(
            "| Claim | measured |\n| --- | --- |\n{rows}| `T7.period` a period | {a} |\n\
             | `T7.error` its error | {b} |\n"
        );
        let sentences = format!(
            "| Claim | measured |\n| --- | --- |\n| `P1.same` as in Table 7 | {sentence} |\n"
        );
        Version::from([
            ("table_7".to_string(), content(table_7)),
            ("ledger_cells".to_string(), content(cells)),
            ("ledger_sentences".to_string(), content(sentences)),
        ])
    };
    let items = |old: Version, new: Version| -> Vec<(String, usize)> {
        let review = between(&old, &new);
        let items = review.groups.iter().flat_map(Group::items);
        items.map(|item| (item.claim.clone().unwrap_or_default(), item.also.len())).collect()
    };
    let claim = |id: &str, also: usize| (id.to_string(), also);
    let old = || made(["1.2345", "1.2345"], "1.2345", "");
    let alone = ["", "", "T7.period", "T7.error", "P1.same"].map(|id| claim(id, 0));
    assert_eq!(items(old(), made(["1.2346", "1.2346"], "1.2346", "")), alone);
    // One alone moved so: the sentence repeats it.
    let new = made(["1.2346", "1.2347"], "1.2346", "| a new row | 1.2345 |\n");
    assert_eq!(
        items(old(), new),
        [claim("", 0), claim("T7.period", 2), claim("T7.error", 1), claim("T7.new", 0)]
    );
    let short = || made(["1.23", "1.24"], "1.23", "");
    assert_eq!(
        items(short(), made(["1.25", "1.24"], "1.25", "")),
        [claim("", 0), claim("T7.period", 0), claim("P1.same", 0)]
    );
}

//! A drawing read back, as who looks at it would: places by the ticks, series by the legend.

use roxmltree::{Document, Node};

use super::{Axis, Chart, Figure, Point, Style};

/// The numbers in a path.
fn numbers(d: &str) -> Vec<f64> {
    let parts = d.split(|c: char| !(c.is_ascii_digit() || ".-".contains(c)));
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// The points of a path that goes on from each to the next.
fn steps(d: &str) -> Vec<Point> {
    let steps = numbers(d);
    let sum = |at: &mut Point, step: &[f64]| {
        *at = (at.0 + step[0], at.1 + step[1]);
        Some(*at)
    };
    steps.chunks(2).scan((0.0, 0.0), sum).collect()
}

/// A line with markers, markers and dots, each at three places.
fn three() -> (Chart, [[Point; 3]; 3]) {
    let values = [[1.0, 40.0, 30.0], [2.0, 20.0, 50.0], [3.0, 4.0, 90.0]];
    let [line, marks, dots] = values.map(|[a, b, c]| [(0.0, a), (5.0, b), (10.0, c)]);
    let chart = Chart::new(Axis::linear("x").range(0.0, 10.0), Axis::log("y").range(1.0, 100.0))
        .series("line", Style::numbered(0), line)
        .series("marks", Style::numbered(1).markers_only(), marks)
        .series("dots", Style::numbered(2).dots(), dots);
    (chart, [line, marks, dots])
}

/// Coordinates have one decimal.
fn is_near(at: f64, there: f64) -> bool {
    (at - there).abs() < 0.3
}

/// What is where a reader finds it by the ticks.
///
/// Catches: a value that is not where its tick says, an axis upside down or stretched, a series
/// that is not drawn.
#[test]
fn values_are_where_the_ticks_say() {
    let (chart, [line, marks, dots]) = three();
    let svg = Figure::new("t", "d").panel(chart).to_svg("x");
    let document = Document::parse(&svg).unwrap();
    let d = |class: &str| {
        let mut nodes = document.root_element().children();
        let node = nodes.find(|node| node.attribute("class") == Some(class));
        node.and_then(|node| node.attribute("d")).unwrap_or_else(|| panic!("no {class}"))
    };
    let [left, top, bottom, right] = numbers(d("axis"))[..4] else { panic!("no axis") };
    let across = |share: f64| left + share * (right - left);
    let up = |share: f64| bottom - share * (bottom - top);
    let shows = |found: Vec<Point>, values: [Point; 3]| {
        assert_eq!(found.len(), values.len());
        for (at, (x, y)) in found.into_iter().zip(values) {
            let there = (across(x / 10.0), up(libm::log10(y) / 2.0));
            assert!(is_near(at.0, there.0) && is_near(at.1, there.1), "{at:?} {there:?}");
        }
    };
    let marked = |d: &str| {
        let place = |mark| (numbers(mark)[0], numbers(mark)[1]);
        d.split('M').skip(1).map(place).collect::<Vec<Point>>()
    };
    shows(steps(d("line vermilion")), line);
    shows(marked(d("dot vermilion")), line);
    shows(marked(d("dot blue")), marks);
    shows(steps(&d("line green").replace("h0", "")), dots);
    let ticks = [("0", 0.0), ("4", 0.4), ("10", 1.0)]
        .map(|(text, share)| (text, (across(share), bottom + 22.0)));
    let powers = [("100", 0.0), ("101", 0.5), ("102", 1.0)]
        .map(|(text, share)| (text, (left - 9.0, up(share) + 6.0)));
    for (text, (x, y)) in ticks.into_iter().chain(powers) {
        let at = |node: &Node, name| node.attribute(name).unwrap().parse::<f64>().unwrap();
        let mut labels = document.root_element().children().filter(|n| n.has_tag_name("text"));
        let found = labels.any(|node| {
            said(node) == text && is_near(at(&node, "x"), x) && is_near(at(&node, "y"), y)
        });
        assert!(found, "{text} at {x}, {y}");
    }
}

fn said(node: Node) -> String {
    node.descendants().filter(Node::is_text).filter_map(|text| text.text()).collect()
}

/// Catches: a label at the sample of another series, a sample that does not look like it.
#[test]
fn the_legend_says_what_is_what() {
    let svg = Figure::new("t", "d").panel(three().0).to_svg("x");
    let document = Document::parse(&svg).unwrap();
    let entries = document.descendants().filter(|n| n.attribute("class") == Some("entry"));
    let entries = entries.map(|entry| {
        let parts = entry.children().filter(Node::is_element);
        let words =
            parts.map(|part| part.attribute("class").unwrap_or("").to_string() + &said(part));
        words.collect::<Vec<_>>().join(", ")
    });
    let expected = ["line vermilion, dot vermilion, line", "dot blue, marks", "line green, dots"];
    assert_eq!(entries.collect::<Vec<_>>(), expected);
}

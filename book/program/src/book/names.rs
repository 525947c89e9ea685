//! The names of the paper's four methods in the colours of their lines, in the text of a page.
//!
//! Within links, headings, code and drawings a name has the colour of what it stands in.

use regex::Captures;

use crate::book::{Pattern, pattern};

/// Elements within which nothing is coloured.
const PLAIN: [&str; 17] = [
    "a", "button", "code", "h1", "h2", "h3", "h4", "legend", "math", "option", "pre", "script",
    "select", "style", "summary", "svg", "title",
];

/// The classes of book/theme/pendula.css, and what has them.
const NAMES: [(&str, &str); 4] = [
    ("of-forward-euler", r"\b[Ff]orward\s+Euler\b"),
    ("of-symplectic-euler", r"\b[Ss]ymplectic\s+Euler\b"),
    ("of-rk4", r"\bRK4\b"),
    ("of-stormer-verlet", r"\bStörmer–Verlet\b"),
];

/// The page with the names in its text in their colours.
pub fn coloured(page: &str) -> String {
    let start = page.find("<main>").unwrap_or(page.len());
    let end = page.rfind("</main>").unwrap_or(page.len()).max(start);
    let mut text = page[..start].to_string();
    let mut rest = &page[start..end];
    // The element within which nothing is coloured, and how many of its name are open.
    let mut plain: Option<(&str, usize)> = None;
    while let Some(at) = rest.find('<') {
        text += &words(&rest[..at], plain.is_some());
        rest = &rest[at..];
        let close = if rest.starts_with("<!--") { "-->" } else { ">" };
        let tag_end = rest.find(close).map_or(rest.len(), |at| at + close.len());
        let (tag, after) = rest.split_at(tag_end);
        text += tag;
        rest = after;
        let name = tag.trim_start_matches(['<', '/']);
        let name = name.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
        let opens = !tag.starts_with("</") && !tag.ends_with("/>");
        plain = match plain {
            Some((of, depth)) if of == name => {
                let depth =
                    if opens { depth + 1 } else { depth - usize::from(tag.starts_with("</")) };
                (depth > 0).then_some((of, depth))
            }
            None if opens && PLAIN.contains(&name) => Some((name, 1)),
            other => other,
        };
    }
    text + &words(rest, plain.is_some()) + &page[end..]
}

fn words(text: &str, plain: bool) -> String {
    static NAME: Pattern = Pattern::new(|| {
        let names = NAMES.map(|(_, name)| format!("({name})"));
        pattern(&names.join("|"))
    });
    if plain {
        return text.to_string();
    }
    let span = |found: &Captures<'_>| {
        let which = (0..NAMES.len()).find(|which| found.get(which + 1).is_some()).unwrap_or(0);
        format!("<span class=\"{}\">{}</span>", NAMES[which].0, &found[0])
    };
    NAME.replace_all(text, span).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a name in another method's colour, one that a line break parts, one within a longer
    /// word, and one in a link, in code, in a drawing or in mdBook's frame.
    #[test]
    fn names_in_the_text_have_their_colour() {
        let page = coloured(
            "<title>RK4</title><main><h1>RK4</h1><p>Forward\nEuler’s, and <em>RK4</em>, <a \
             href=\"r.html\">RK4</a> <code>RK4</code> ARK4.</p><svg><g><svg></svg></g><text>RK4\
             </text></svg><!-- RK4 --><br>Störmer–Verlet, symplectic Euler</main>RK4",
        );
        assert_eq!(
            page,
            "<title>RK4</title><main><h1>RK4</h1><p><span class=\"of-forward-euler\">Forward\n\
             Euler</span>’s, and <em><span class=\"of-rk4\">RK4</span></em>, <a \
             href=\"r.html\">RK4</a> <code>RK4</code> ARK4.</p><svg><g><svg></svg></g><text>RK4\
             </text></svg><!-- RK4 --><br><span class=\"of-stormer-verlet\">Störmer–Verlet</span>, \
             <span class=\"of-symplectic-euler\">symplectic Euler</span></main>RK4"
        );
        assert_eq!(coloured("<p>RK4</p>"), "<p>RK4</p>");
    }

    /// Catches: a class without a rule, whose names have no colour, in silence.
    #[test]
    fn each_name_has_a_rule() {
        let css = concat!(env!("CARGO_MANIFEST_DIR"), "/../theme/pendula.css");
        let css = std::fs::read_to_string(css).unwrap();
        for (class, _) in NAMES {
            assert!(css.contains(&format!(".{class} {{")), "{class}");
        }
    }
}

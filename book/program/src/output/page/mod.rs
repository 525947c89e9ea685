//! A page that needs nothing but itself: it has the colours of the book, in all its themes, and the
//! reader's own fonts, and may load nothing.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use pendula_judge::printable::escaped;
use sha2::{Digest, Sha256};

/// What is on a page.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// Its title, which is its heading too.
    pub title: &'a str,
    /// What stands below the heading.
    pub lead: &'a str,
    /// What follows, as HTML, with a section `verdict`.
    pub body: &'a str,
    /// Its own styles, which come after those of every page.
    pub style: &'a str,
}

impl Page<'_> {
    /// The page.
    pub fn html(&self) -> String {
        let script = concat!("\n", include_str!("theme.js"));
        format!(
            include_str!("frame.html"),
            title = escaped(self.title),
            lead = escaped(self.lead),
            style = [
                include_str!("plain.css"),
                include_str!("../../../../theme/pendula.css"),
                include_str!("../../../../theme/figures.css"),
                include_str!("frame.css"),
                self.style,
            ]
            .concat(),
            // Of all scripts that may come to stand on the page, this one runs.
            hash = hash(script),
            script = script,
            body = self.body,
        )
    }
}

/// The name of a script in a policy.
pub fn hash(script: &str) -> String {
    format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(script)))
}

/// Text as HTML, with what stands between backticks as code.
pub fn with_code(text: &str) -> String {
    let escaped = escaped(text);
    let parts = escaped.split('`').enumerate();
    parts
        .map(|(i, part)| if i % 2 == 1 { format!("<code>{part}</code>") } else { part.into() })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The hash is that of an example of the specification (CSP 3, 6.7.2.3: `alert('Hello,
    /// world.');`).
    ///
    /// Catches: a digest of something else than the script's text; base64 for addresses.
    #[test]
    fn a_hash_is_the_specifications() {
        let hello = "'sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng='";
        assert_eq!(hash("alert('Hello, world.');"), hello);
    }

    /// Catches: a policy that names another text than the page's script, which then does not run;
    /// one that lets other scripts run.
    #[test]
    fn the_policy_names_the_script_of_the_page_and_no_other() {
        let (title, lead, style) = ("T", "L", "");
        let html = Page { title, lead, body: "<script>let b;</script>", style }.html();
        let scripts: Vec<&str> = html
            .split("<script>")
            .skip(1)
            .map(|rest| rest.split_once("</script>").unwrap().0)
            .collect();
        assert_eq!(scripts.len(), 2);
        let policy = html.split("Content-Security-Policy").nth(1).unwrap();
        let policy = policy.split('>').next().unwrap();
        assert!(!policy.contains(&hash(scripts[0])), "{policy}");
        assert!(policy.contains(&hash(scripts[1])), "{policy}");
        assert!(!policy.contains("script-src 'unsafe-inline'"), "{policy}");
    }

    /// Catches: a name or a claim whose markup becomes that of the page, or that turns it around.
    #[test]
    fn text_is_no_markup() {
        let (title, lead) = ("<i>\u{202e}", "\"a\" & 'b'");
        let html = Page { title, lead, body: "", style: "" }.html();
        assert!(html.contains("<h1>&lt;i&gt;\\u{202e}</h1>"));
        assert!(html.contains("<title>&lt;i&gt;\\u{202e} · pendula"));
        assert!(html.contains("<p class=\"lead\">&quot;a&quot; &amp; &#x27;b&#x27;</p>"));
        assert_eq!(with_code("a `b<` c `d"), "a <code>b&lt;</code> c <code>d</code>");
    }
}

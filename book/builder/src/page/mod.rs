//! A page that needs nothing but itself: it looks like the book, in all its themes, and may load
//! nothing.

use anyhow::{Context, Result};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use handlebars::Handlebars;
use mdbook_driver::config::HtmlConfig;
use mdbook_html::theme::Theme;
use serde_json::{Value, json};

use crate::files;
use crate::policy;

/// What is on a page. The styles and the script come after those of every page.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// Its title, which is its heading too.
    pub title: &'a str,
    /// What stands below the heading.
    pub lead: &'a str,
    /// The template of what follows, which has a section `verdict`.
    pub template: &'a str,
    /// Its own styles.
    pub style: &'a str,
    /// Its own script, which may be empty.
    pub script: &'a str,
}

impl Page<'_> {
    /// The page, its template filled with `data`.
    ///
    /// # Errors
    /// If the book's theme cannot be read, or the template asks for what `data` does not have.
    pub fn html(&self, data: &Value) -> Result<String> {
        let mut templates = Handlebars::new();
        templates.set_strict_mode(true);
        let body = templates.render_template(self.template, data).context("the page")?;
        let script = ["\n", include_str!("theme.js"), self.script].concat();
        let frame = json!({
            "title": self.title,
            "lead": self.lead,
            "style": style()? + self.style,
            // Of all scripts that may come to stand on the page, this one runs.
            "hash": policy::hash(&script),
            "script": script,
            "body": body,
        });
        templates.render_template(include_str!("frame.hbs"), &frame).context("the page's frame")
    }
}

/// The style of the book, with its fonts, and that of every page.
fn style() -> Result<String> {
    let folder = files::temporary_folder().context("no temporary folder can be made")?;
    Theme::copy_theme(&HtmlConfig::default(), folder.path())?;
    let theme = folder.path().join("theme");
    let read = |file: &str| {
        files::read_to_string(&theme.join(file))
            .with_context(|| format!("mdBook's theme has no {file}"))
    };
    let mut style = String::new();
    for (weight, file) in [(400, "regular"), (600, "600")] {
        let file = format!("fonts/open-sans-v17-all-charsets-{file}.woff2");
        let font = files::read(&theme.join(&file))
            .with_context(|| format!("mdBook's theme has no {file}"))?;
        let font = BASE64_STANDARD.encode(font);
        style += &format!(
            "@font-face {{ font-family: \"Open Sans\"; font-weight: {weight}; \
             src: url(data:font/woff2;base64,{font}); }}\n"
        );
    }
    for sheet in [
        &read("css/variables.css")?,
        &read("css/general.css")?,
        include_str!("../../../theme/pendula.css"),
        include_str!("../../../theme/figures.css"),
        include_str!("frame.css"),
    ] {
        style += sheet;
    }
    Ok(style)
}

/// Text as HTML, with what stands between backticks as code.
pub fn with_code(text: &str) -> String {
    let escaped = handlebars::html_escape(text);
    let parts = escaped.split("&#x60;").enumerate();
    parts
        .map(|(i, part)| if i % 2 == 1 { format!("<code>{part}</code>") } else { part.into() })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a policy that names another text than the page's script, which then does not run;
    /// one that lets other scripts run.
    #[test]
    fn the_policy_names_the_script_of_the_page_and_no_other() {
        let (title, lead, style, script) = ("T", "L", "", "let own = '<';\n");
        let template = "<script>{{more}}</script>";
        let page = Page { title, lead, template, style, script };
        let html = page.html(&json!({ "more": "let b;" })).unwrap();
        let scripts: Vec<&str> = html
            .split("<script>")
            .skip(1)
            .map(|rest| rest.split_once("</script>").unwrap().0)
            .collect();
        assert_eq!(scripts.len(), 2);
        let policy = html.split("Content-Security-Policy").nth(1).unwrap();
        let policy = policy.split('>').next().unwrap();
        assert!(!policy.contains(&policy::hash(scripts[0])), "{policy}");
        assert!(policy.contains(&policy::hash(scripts[1])), "{policy}");
        assert!(scripts[1].ends_with(script) && !policy.contains("script-src 'unsafe-inline'"));
    }
}

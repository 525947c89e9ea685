//! The book's own style: that of mdBook, with its fonts.

use anyhow::{Context, Result};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use mdbook_driver::config::HtmlConfig;
use mdbook_html::theme::Theme;

use pendula_output::files;

/// The style sheet.
pub fn style() -> Result<String> {
    let folder = files::temporary_folder().context("no temporary folder can be made")?;
    Theme::copy_theme(&HtmlConfig::default(), folder.path())?;
    let theme = folder.path().join("theme");
    let read = |file: &str| {
        files::read_to_string(theme.join(file))
            .with_context(|| format!("mdBook's theme has no {file}"))
    };
    let mut style = String::new();
    for (weight, file) in [(400, "regular"), (600, "600")] {
        let file = format!("fonts/open-sans-v17-all-charsets-{file}.woff2");
        let font = files::read(theme.join(&file))
            .with_context(|| format!("mdBook's theme has no {file}"))?;
        let font = BASE64_STANDARD.encode(font);
        style += &format!(
            "@font-face {{ font-family: \"Open Sans\"; font-weight: {weight}; \
             src: url(data:font/woff2;base64,{font}); }}\n"
        );
    }
    Ok(style + &read("css/variables.css")? + &read("css/general.css")?)
}

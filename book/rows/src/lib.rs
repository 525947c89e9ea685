//! The identification of rows for the page "Which integrator is this?": the judge's, with a text in
//! memory and a report as JSON.
//!
//! The page writes the bytes of a file where [`reserve`] says, asks [`identify`], and reads so many
//! bytes at [`answer_at`]. What a method is called, and what is wrong in a mistake, the page has in
//! its file of known answers: here a name stands between ⟦ and ⟧.
#![allow(unsafe_code, reason = "an export's name is a promise to the linker")]

use std::cell::RefCell;

use pendula_judge::rows::{self, Drawn};

thread_local! {
    static TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Where so many bytes can be written.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn reserve(length: u32) -> *mut u8 {
    TEXT.with_borrow_mut(|text| {
        text.clear();
        text.resize(length as usize, 0);
        text.as_mut_ptr()
    })
}

/// Says what the rows of the text are; the length of the answer in bytes.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn identify() -> u32 {
    let text = TEXT.take();
    let said = answer(&text);
    ANSWER.with_borrow_mut(|answer| {
        *answer = said;
        answer.len() as u32
    })
}

/// Where the answer begins.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn answer_at() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}

/// The answer as JSON: what is said, each under its heading, the faults, and what can be drawn; or
/// why there is none.
pub fn answer(text: &[u8]) -> String {
    let report = match rows::identify(text) {
        Ok(report) => report,
        Err(refusal) => return format!("{{\"refused\":{}}}", word(&refusal.to_string())),
    };
    let marked = |name: &str| format!("⟦{name}⟧");
    let said = report.said(marked).into_iter();
    let said = said.map(|[what, words]| format!("[{},{}]", word(&what), word(&words)));
    let faults = report.faults.iter().map(|fault| word(&fault.to_string()));
    let drawn = report.drawn.as_ref().map_or_else(
        || String::from("null"),
        |Drawn { t, theta, exact, off, .. }| {
            let lines = [("t", t), ("theta", theta), ("exact", exact), ("off", off)];
            let lines =
                lines.map(|(name, xs)| format!("\"{name}\":{}", list(xs.iter().map(number))));
            format!("{{{}}}", lines.join(","))
        },
    );
    format!("{{\"said\":{},\"faults\":{},\"drawn\":{drawn}}}", list(said), list(faults))
}

// A crate for JSON is a tenth of what the page would have to load.

fn list(values: impl Iterator<Item = String>) -> String {
    format!("[{}]", values.collect::<Vec<_>>().join(","))
}

/// What is no number, JSON cannot say.
fn number(x: &f64) -> String {
    if x.is_finite() { x.to_string() } else { String::from("null") }
}

fn word(text: &str) -> String {
    let mut word = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => word.extend(['\\', c]),
            c if c < ' ' => word += &format!("\\u{:04x}", c as u32),
            c => word.push(c),
        }
    }
    word.push('"');
    word
}

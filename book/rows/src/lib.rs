//! The identification of rows for the page "Which integrator is this?": the judge's, with a text in
//! memory and a report as JSON.
//!
//! The page writes the bytes of a file where [`reserve`] says, asks [`identify`], and reads so many
//! bytes at [`answer_at`]. What a method is called, and what is wrong in a mistake, the page has in
//! its file of known answers: here a name stands between ⟦ and ⟧.
#![allow(unsafe_code, reason = "an export's name is a promise to the linker")]

use std::cell::RefCell;

use pendula_judge::rows;
use serde_json::json;

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

/// The answer: what is said, each under its heading, the faults, and what can be drawn; or why
/// there is none.
pub fn answer(text: &[u8]) -> String {
    let report = match rows::identify(text) {
        Ok(report) => report,
        Err(refusal) => return json!({ "refused": refusal.to_string() }).to_string(),
    };
    let marked = |name: &str| format!("⟦{name}⟧");
    let faults: Vec<String> = report.faults.iter().map(ToString::to_string).collect();
    json!({
        "said": report.said(marked),
        "faults": faults,
        "drawn": report.drawn_json(),
    })
    .to_string()
}

//! The identification as the page has it: what it answers, and with the feature `interpreter` the
//! compiled file that the page loads, beside the judge.

use std::fmt::Write;

use pendula_rows::answer;

/// Rows of symplectic Euler, as the example of the page has them; with a fault in one of them.
fn table(rows: u32, fault: Option<u32>) -> String {
    let (h, mut theta, mut omega) = (0.02, 1.0_f64, 0.0_f64);
    let mut text = String::from("t,theta,omega\n");
    for n in 0..rows {
        let edited = theta + if fault == Some(n) { 0.01 } else { 0.0 };
        writeln!(text, "{:.2},{edited:.6},{omega:.6}", h * f64::from(n)).unwrap();
        omega -= h * 9.8 * theta.sin();
        theta += h * omega;
    }
    text
}

/// Catches: a name that the page cannot look up, a fault or a chart that is lost on the way, a
/// refusal that is no sentence.
#[test]
fn the_page_is_told_what_the_judge_finds() {
    let told = answer(table(100, Some(40)).as_bytes());
    for part in ["⟦symplectic-euler⟧, a step of 0.02 s", "Row 41 does not follow", "\"drawn\":{"]
    {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(answer(b"").contains("refused"), "{}", answer(b""));
}

/// Catches: an answer that is no JSON because of what stands in a heading, or of a row that is not
/// compared and has no number.
#[test]
fn the_answer_is_json_whatever_the_heading() {
    let table = table(100, None).replace("theta", "theta\\\"\u{1}’");
    let told: serde_json::Value = serde_json::from_str(&answer(table.as_bytes())).unwrap();
    let read = told["said"][0][1].as_str().unwrap();
    assert!(read.contains("theta"), "{read}");
    let drawn = told["drawn"].as_object().unwrap();
    let lengths = drawn.values().map(|line| line.as_array().unwrap().len());
    assert_eq!(lengths.collect::<Vec<_>>(), [100; 4]);
    assert!(drawn["off"][0].is_null() && drawn["off"][1].is_number());
}

/// Rows of forward Euler, with steps so long that three of them tell it.
#[cfg(feature = "interpreter")]
fn few_rows() -> String {
    let (h, mut theta, mut omega) = (0.1, 2.0_f64, 0.0_f64);
    let mut text = String::from("t,theta,omega\n");
    for n in 0..4 {
        writeln!(text, "{:.1},{theta:.4},{omega:.4}", h * f64::from(n)).unwrap();
        (theta, omega) = (theta + h * omega, omega - h * 9.8 * theta.sin());
    }
    text
}

/// Catches: a compiled file that is older than its source. An interpreter takes hundreds of times
/// as long as a browser, so it is given few rows here; book/browser/rows.py compares more of them.
#[cfg(feature = "interpreter")]
#[test]
fn the_compiled_file_answers_as_the_source() {
    use std::fs;
    use std::io::Read;
    use std::path::Path;

    use base64::Engine as _;
    use base64::prelude::BASE64_STANDARD;
    use wasmi::{Engine, Linker, Module, Store};

    let book = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let script = fs::read_to_string(book.join("src/assets/rows.wasm.js")).unwrap();
    let start = "globalThis.pendulaRows = \"";
    let (_, rest) = script.split_once(start).expect("its line");
    let packed = BASE64_STANDARD.decode(rest.split_once("\";").expect("its end").0).unwrap();
    let mut bytes = Vec::new();
    flate2::read::GzDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();

    let engine = Engine::default();
    let module = Module::new(&engine, bytes).unwrap();
    assert_eq!(module.imports().count(), 0, "it would ask something of the page");
    let mut store = Store::new(&engine, ());
    let instance = Linker::new(&engine).instantiate_and_start(&mut store, &module).unwrap();
    let memory = instance.get_memory(&store, "memory").unwrap();
    let reserve = instance.get_typed_func::<u32, u32>(&store, "reserve").unwrap();
    let identify = instance.get_typed_func::<(), u32>(&store, "identify").unwrap();
    let answer_at = instance.get_typed_func::<(), u32>(&store, "answer_at").unwrap();
    for text in [few_rows(), String::new(), "0 1\n".to_string()] {
        let at = reserve.call(&mut store, text.len() as u32).unwrap();
        memory.write(&mut store, at as usize, text.as_bytes()).unwrap();
        let mut told = vec![0; identify.call(&mut store, ()).unwrap() as usize];
        let at = answer_at.call(&mut store, ()).unwrap();
        memory.read(&store, at as usize, &mut told).unwrap();
        let told = String::from_utf8(told).unwrap();
        assert!(text.len() < 9 || told.contains("⟦forward-euler⟧, a step of 0.1 s"), "{told}");
        assert_eq!(told, answer(text.as_bytes()));
    }
}

//! Whatever a program that is judged writes: it is read as Rust reads it, or a fault in one line.

use std::ffi::OsString;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use pendula::Phase;
use pendula::verify::{Fault, Request, Stranger};
use pendula_program::verify::Program;
use pendula_program::verify::protocol::{Answer, Question, answer, greeting, question};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::call::words;

/// As many cases as this, or as the environment asks for, if that is more.
fn config(cases: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    ProptestConfig {
        cases: asked.unwrap_or(0).max(cases),
        rng_seed: RngSeed::Fixed(0x0050_E4D0_1A01),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Numbers in every notation that programs print, and what only looks like one.
fn word() -> impl Strategy<Value = String> {
    let number =
        prop_oneof![any::<f64>(), (-10.0_f64..10.0).boxed(), Just(0.1 + 0.2), Just(5e-324)];
    let printed = (number, 0..9_u8, 0..25_usize).prop_map(|(x, how, digits)| match how {
        0 => format!("{x}"),
        1 => format!("{x:?}"),
        2 => format!("{x:e}"),
        3 => format!("{x:E}"),
        4 => format!("{x:+.digits$e}"),
        5 => format!("{x:.digits$}"),
        6 => format!("{x:e}").replace('e', "e+"),
        7 => format!("0{x}"),
        _ => format!("{x}").replace('.', ","),
    });
    // The first is empty.
    let odd = " - + . e e5 .5 5. -.5 1e 1e+ 1e5.5 0x10 1_000 1,5 NaN nan -nan inf -inf infinity \
               +Infinity 1e999 -1e999 1e-999 1.5e-2147483648 1e2147483647 1e-2147483649 \
               18446744073709551616 １ ١ −1 1f 1d0 1.0.0 --1 +-1 1e5e5 0e0 -0 -0.0 1\u{0} \
               9007199254740993 2.2250738585072011e-308 \
               0.1000000000000000055511151231257827021181583404541015625";
    let odd = prop::sample::select(words(odd)).prop_map(str::to_string);
    prop_oneof![5 => printed, 2 => odd, 1 => "[-+0-9.eE]{0,12}", 1 => any::<String>()]
}

/// Words of the protocol among them, with any white space between.
fn line() -> impl Strategy<Value = String> {
    let known = words("hello 1 bye pendulum driven done error unsupported 10 1000 0.01");
    let known = prop::sample::select(known);
    let word = prop_oneof![3 => word(), 2 => known.prop_map(str::to_string)];
    let space = prop::sample::select(&[" ", "  ", "\t", "\r", "\u{a0}", "\n"]);
    prop::collection::vec((word, space), 0..10).prop_map(|words| {
        words.into_iter().flat_map(|(word, space)| [word, space.to_string()]).collect()
    })
}

/// The finite number that a word is to Rust, as bits.
fn finite(word: &str) -> Option<u64> {
    word.parse::<f64>().ok().filter(|x| x.is_finite()).map(f64::to_bits)
}

proptest! {
    #![proptest_config(config(2000))]

    /// Catches: a number of a stranger's answer that is rounded, cut off or read where there is
    /// none; a panic.
    #[test]
    fn an_answer_is_the_numbers_that_rust_reads(line in line()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match answer(&line) {
            Ok(Answer::State(Phase { theta, omega })) => {
                prop_assert_eq!(words.len(), 2);
                prop_assert_eq!(finite(words[0]), Some(theta.to_bits()));
                prop_assert_eq!(finite(words[1]), Some(omega.to_bits()));
            }
            Ok(Answer::Done(Some(count))) => {
                prop_assert_eq!(words[1].parse::<u64>(), Ok(count));
            }
            Ok(Answer::Done(None)) => prop_assert_eq!(&words[..], ["done"]),
            Ok(Answer::Unsupported) => prop_assert_eq!(&words[..], ["unsupported"]),
            Ok(Answer::Error(why)) if words.len() > 1 => prop_assert_eq!(words[1..].join(" "), why),
            Ok(Answer::Error(why)) => prop_assert!(!why.is_empty()),
            Err(why) => {
                let two = words.len() == 2 && words.iter().all(|word| finite(word).is_some());
                prop_assert!(!two, "{} is refused: {}", line, why);
                prop_assert_eq!(why.lines().count(), 1);
            }
        }
        if let Ok(name) = greeting(&line) {
            prop_assert_eq!(&words[..2], ["hello", "1"]);
            prop_assert_eq!(name, words[2..].join(" "));
        }
    }

    /// Catches: a request understood in part, or with other numbers than it has.
    #[test]
    fn a_request_is_the_numbers_that_rust_reads(line in line()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if let Ok(Question::Run(request)) = question(&line) {
            let Request { g_over_l, drive, start, step, steps, every } = request;
            let drive = drive.map(|drive| [drive.amplitude, drive.frequency]);
            let numbers = [g_over_l].into_iter().chain(drive.into_iter().flatten());
            let numbers = numbers.chain([start.theta, start.omega, step]);
            let read: Vec<_> = numbers.map(|x| Some(x.to_bits())).collect();
            let last = words.len() - 2;
            let said: Vec<_> = words[1..last].iter().map(|word| finite(word)).collect();
            prop_assert_eq!(read, said);
            prop_assert!(steps % every == 0 && every > 0 && step != 0.0);
            let counts: Vec<_> = words[last..].iter().map(|word| word.parse().ok()).collect();
            prop_assert_eq!(counts, [Some(steps), Some(every)]);
            prop_assert_eq!(question(&request.to_string()), Ok(Question::Run(request)));
        }
    }
}

/// What a program writes that asks nothing.
fn monologue() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        3 => line().prop_map(|line| (line + "\n").into_bytes()),
        1 => Just(b"0.5 1e-3\n".to_vec()),
        1 => Just(b"done 4\n".to_vec()),
        1 => prop::collection::vec(any::<u8>(), 0..40),
        1 => Just(vec![b'9'; 2000]),
    ];
    let greets = prop_oneof![3 => Just(b"hello 1 x\n".to_vec()), 1 => Just(Vec::new())];
    (greets, prop::collection::vec(piece, 0..6)).prop_map(|(mut all, pieces)| {
        all.extend(pieces.concat());
        all
    })
}

#[cfg(unix)]
proptest! {
    #![proptest_config(config(100))]

    /// A program that writes this and ends.
    ///
    /// Catches: bytes of a stranger that panic or hang, an answer made up for one that is missing,
    /// a fault of many lines.
    #[test]
    fn a_program_is_at_fault_in_one_line(bytes in monologue()) {
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(&bytes).unwrap();
        let command = ["cat".into(), OsString::from(file.path())];
        let patience = Duration::from_secs(20);
        let started = Program::start(&command, patience, &Arc::new(AtomicBool::new(false)));
        let program = match started {
            Ok(program) => program,
            Err(why) => {
                prop_assert_eq!(why.lines().count(), 1, "{}", why);
                return Ok(());
            }
        };
        let start = Phase { theta: 1.0, omega: 0.0 };
        let request =
            Request { g_over_l: 9.81, drive: None, start, step: 0.01, steps: 1, every: 1 };
        match program.answer(&request) {
            Ok(reply) => {
                prop_assert_eq!(reply.states.len(), 1);
                let Phase { theta, omega } = reply.states[0];
                prop_assert!(theta.is_finite() && omega.is_finite());
            }
            Err(Fault::Refused(why) | Fault::Broken(why)) => {
                prop_assert_eq!(why.lines().count(), 1, "{}", why);
            }
            Err(Fault::Unsupported) => {}
        }
    }
}

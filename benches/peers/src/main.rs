//! The library and other crates, in one run, compared with the naive loop.
//!
//! `cargo run --profile peers -p pendula-peers` compares run time [for an error](front), and with
//! `-- ends` it prints the exact motion for `others.py`, which compares programs that are no
//! crates. The profile optimises the dependencies of the crates; the release build does not.

mod crates;
mod front;
#[path = "../../common/machine.rs"]
mod machine;
#[path = "../../common/mod.rs"]
mod naive;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => front::compare(),
        ["ends"] => front::ends(),
        _ => {
            eprintln!("pendula-peers: nothing, or ends");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

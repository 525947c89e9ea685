//! The library and other crates, in one run, compared with the naive loop: `cargo run --profile
//! peers -p pendula-peers`. The profile optimises the dependencies of the crates; the release build
//! does not.

mod crates;
mod front;
#[path = "../../common/machine.rs"]
mod machine;
#[path = "../../common/mod.rs"]
mod naive;

fn main() {
    front::compare();
}

//! Hashes of all that the library computes: the same on every machine, in debug and in release.

/// A row for each: its name and the hash of its bits. `.ci/processors` compares these rows with
/// what other processors compute.
pub fn bits() -> String {
    let mut table = String::from("| Result | Hash |\n| --- | --- |\n");
    for (name, hash) in pendula_bits::lines() {
        table += &format!("| {name} | `{hash:016x}` |\n");
    }
    table
}

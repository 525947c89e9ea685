//! What users of an integrator want first, a file for each: each has its own `main`, and can be
//! taken as a program. `cargo run --features ensemble --example tasks chain` runs one of them.

use pendula::Error;

macro_rules! tasks {
    ($($task:ident)+) => {
        $(mod $task;)+

        const TASKS: &[(&str, fn() -> Result<(), Error>)] =
            &[$((stringify!($task), $task::main)),+];

        /// Catches: a task that does not compile, fails, or says what is not so.
        #[cfg(test)]
        mod tests {
            $(#[test]
            fn $task() -> Result<(), pendula::Error> {
                super::$task::main()
            })+
        }
    };
}

tasks! {
    trajectory rate n_bodies chain henon_heiles bouncing_ball output_times adaptive_options ensemble
    method_table method_by_name adaptive_by_name own_method
}

fn main() -> Result<(), Error> {
    let asked = std::env::args().nth(1);
    for (name, task) in TASKS {
        if asked.as_ref().is_none_or(|asked| asked == name) {
            println!("{name}");
            task()?;
        }
    }
    Ok(())
}

//! The list of methods: complete, unambiguous, and consistent with the files.

use std::collections::BTreeSet;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use pendula::registry::{ByName, InSteps};
use pendula::{
    AnyMethod, Compensated, Counting, Grid, METHODS, Method, Pendulum, Phase, StormerVerlet,
    System, method_named, methods,
};

/// The folder of the methods.
fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src/methods")
}

/// Catches: a method whose file exists but which is not on the list, so that no test, table or page
/// runs it.
#[test]
fn every_file_of_methods_is_on_the_list() {
    /// The other files in the folders of the methods.
    const OTHERS: [&str; 6] = ["mod", "table", "tableau", "embedded", "explicit", "iteration"];
    let methods = source();
    let inside =
        |folder: &Path| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let families = inside(&methods).filter(|path| path.is_dir());
    let files: BTreeSet<String> = families
        .flat_map(|family| inside(&family))
        .map(|file| file.file_stem().unwrap().to_string_lossy().replace('_', "-"))
        .filter(|name| !OTHERS.contains(&name.as_str()))
        .collect();
    let names: BTreeSet<String> =
        METHODS.iter().map(|method| method.info().name.to_string()).collect();
    assert_eq!(files, names);
}

/// Catches: two methods of the same name, a name that is hard to type, an incomplete entry.
#[test]
fn entries_are_complete_and_distinct() {
    let mut seen = BTreeSet::new();
    for method in METHODS {
        let entry = method.info();
        assert!(seen.insert(entry.name), "{} stands twice", entry.name);
        let typeable = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(entry.name.chars().all(typeable), "{}", entry.name);
        assert_eq!(method_named::<Pendulum>(entry.name).map(|m| m.info()), Some(entry));
        assert!(!entry.title.is_empty() && !entry.aliases.is_empty());
        assert!(entry.order > 0 && entry.force_evaluations > 0 && !entry.reference.is_empty());
    }
    assert!(method_named::<Pendulum>("no-such-method").is_none());
    assert_eq!(format!("{:?}", METHODS[0]), METHODS[0].info().name);
}

/// Asks a method whether it is one for the system: its own constant goes before that of the trait.
struct Asked<M, S>(PhantomData<(M, S)>);

impl<M: Method<Counting<S>>, S: System> Asked<M, S> {
    const SUITS: bool = true;
}

trait Otherwise {
    const SUITS: bool = false;
}

impl<M, S> Otherwise for Asked<M, S> {}

macro_rules! suit {
    ($($module:ident::$method:ident,)+ => $System:ty) => {
        &[$((stringify!($module), Asked::<methods::$method, $System>::SUITS)),+]
    };
}

/// The double pendulum stands for every system, which [`pendula::registry::methods_for`] asks for,
/// the damped pendulum for every separable one.
///
/// Catches: a method whose mark in the list leaves it out on systems for which it is a method; a
/// system whose mark in its list leaves it with fewer methods than suit it.
#[test]
fn a_method_is_found_on_every_system_that_it_suits() {
    fn is_found<S: ByName>(system: &str, suit: &[(&str, bool)]) {
        assert_eq!(suit.len(), METHODS.len());
        for &(module, suits) in suit {
            let found = method_named::<S>(&module.replace('_', "-")).is_some();
            assert_eq!(
                found, suits,
                "whether {module} is found on {system}, and whether it suits it: is its mark right \
                 in src/methods/list.rs, and that of the system in src/systems/list.rs?"
            );
        }
    }
    macro_rules! is_found {
        ($($System:ty),+) => {
            $(is_found::<$System>(
                stringify!($System),
                pendula::for_each_method!(suit, => $System),
            );)+
        };
    }
    macro_rules! is_found_on_each {
        ($($mark:ident $System:ident,)+) => {
            is_found!($(pendula::systems::$System),+);
        };
    }
    is_found!(Pendulum, Compensated<Pendulum>);
    pendula::for_each_system!(is_found_on_each);
}

/// The table on the documentation page of the methods, generated from their entries.
fn table() -> String {
    let mut table = String::from(
        "| method | order | symplectic | symmetric | evaluations | source \
         |\n|---|--:|---|---|--:|---|\n",
    );
    let yes = |is: bool| if is { "yes" } else { "" };
    for info in METHODS.iter().map(|method| method.info()) {
        table += &format!(
            "| {} | {} | {} | {} | {} | {} |\n",
            info.title,
            info.order,
            yes(info.symplectic),
            yes(info.symmetric),
            info.force_evaluations,
            info.reference
        );
    }
    table
}

/// To regenerate the table, run this test with `INSTA_UPDATE=always`, as for the snapshots.
///
/// Catches: documentation that contradicts a method's entry, or leaves a method out.
#[test]
fn the_documentation_lists_what_the_entries_say() {
    let path = source().join("table.md");
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(&path, table()).unwrap();
    }
    let (written, now) = (std::fs::read_to_string(&path).unwrap(), table());
    let stale: Vec<&str> = now.lines().filter(|line| !written.contains(line)).collect();
    assert!(
        written == now,
        "{} is stale: `.ci/after` writes it. Not in it: {stale:#?}",
        path.display()
    );
}

const STARTS: [Phase; 3] = [
    Phase { theta: 1.0, omega: 0.0 },
    Phase { theta: -2.5, omega: 0.5 },
    Phase { theta: 0.2, omega: 7.0 },
];

/// The same bits with and without an observer.
///
/// Catches: a run without an observer that ends in another state.
#[test]
fn the_list_runs_what_it_lists() {
    let (pendulum, grid) = (Pendulum::new(9.81, 1.3, 0.7).unwrap(), Grid::new(0.02, 40).unwrap());
    let by_type: [&dyn AnyMethod; 2] = [&StormerVerlet, &InSteps(StormerVerlet)];
    for method in METHODS.iter().copied().chain(by_type) {
        for start in STARTS {
            let mut last = start;
            let mut seen = 0;
            let end = method.run(&pendulum, start, &grid, &mut |n: u64, _: f64, z: Phase| {
                (seen, last) = (n, z);
            });
            assert_eq!((seen, last), (40, end), "{method:?}");
            assert_eq!(end, method.end(&pendulum, start, &grid), "{method:?}");
        }
    }
}

//! The list of methods: complete, unambiguous, and true to the files.

use std::collections::BTreeSet;
use std::path::Path;

use pendula::methods::rk4::Rk4;
use pendula::metrics::EnergyDrift;
use pendula::{
    AnyMethod, Described, Grid, METHODS, Observer, Pendulum, Phase, Properties, method_named, swing,
};
use rstest::rstest;

/// Catches: a method whose file exists but which no test, table or page would ever run.
#[test]
fn every_file_of_methods_is_on_the_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/methods");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().replace('_', "-"))
        .filter(|name| name != "mod")
        .collect();
    let names: BTreeSet<String> =
        METHODS.iter().map(|method| method.properties().name.to_string()).collect();
    assert_eq!(files, names);
}

/// Catches: two methods of one name, a name that cannot be typed, an entry left half empty.
#[test]
fn entries_are_complete_and_distinct() {
    let mut seen = BTreeSet::new();
    for method in METHODS {
        let entry = method.properties();
        assert!(seen.insert(entry.name), "{} stands twice", entry.name);
        let typeable = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(entry.name.chars().all(typeable), "{}", entry.name);
        assert_eq!(method_named(entry.name).map(|m| m.properties()), Some(entry));
        assert!(!entry.title.is_empty() && !entry.aliases.is_empty());
        assert!(entry.order > 0 && entry.force_evaluations > 0 && !entry.reference.is_empty());
    }
    assert!(method_named("no-such-method").is_none());
    assert_eq!(format!("{:?}", METHODS[0]), METHODS[0].properties().name);
}

/// A method that leaves to the list what the list can do.
struct Plain;

impl Described for Plain {
    fn properties(&self) -> Properties {
        Rk4.properties()
    }
}

impl AnyMethod for Plain {
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        swing(pendulum, &Rk4, start, grid, observer)
    }

    fn count_evaluations(&self, _: &Pendulum, _: Phase, grid: &Grid) -> u64 {
        4 * grid.steps()
    }
}

const STARTS: [Phase; 3] = [
    Phase { theta: 1.0, omega: 0.0 },
    Phase { theta: -2.5, omega: 0.5 },
    Phase { theta: 0.2, omega: 7.0 },
];

/// Whoever is asked, one trajectory or many: the same bits.
///
/// Catches: a run that nobody watches and that goes elsewhere; starts mixed up, or ends and errors left as they were.
#[test]
fn the_list_runs_what_it_lists() {
    let (pendulum, grid) = (Pendulum::new(9.81, 1.3, 0.7).unwrap(), Grid::new(0.02, 40).unwrap());
    for method in METHODS.iter().copied().chain([&Plain as &dyn AnyMethod]) {
        let mut drifts = [(); 3].map(|()| EnergyDrift::of(&pendulum));
        let mut ends = [Phase::default(); 3];
        method.drift_each(&pendulum, &STARTS, &grid, &mut drifts, &mut ends);
        for ((start, drift), end) in STARTS.into_iter().zip(&drifts).zip(ends) {
            let mut alone = EnergyDrift::of(&pendulum);
            assert_eq!(end, method.run(&pendulum, start, &grid, &mut alone), "{method:?}");
            assert_eq!(drift.largest(), alone.largest(), "{method:?}");
            assert!(alone.largest() > 0.0 || method.properties().order > 20, "{method:?}");
            assert_eq!(end, method.end(&pendulum, start, &grid), "{method:?}");
        }
    }
}

/// Catches: starts without a slot, left out in silence.
#[rstest]
#[should_panic(expected = "two slots for each start")]
fn each_start_needs_its_slots(
    #[values(2, 3, 4)] drifts: usize,
    #[values(2, 4)] ends: usize,
    #[values(METHODS[0], &Plain)] method: &dyn AnyMethod,
) {
    let (pendulum, grid) = (Pendulum::PAPER, Grid::new(0.02, 4).unwrap());
    let mut drifts: Vec<_> = (0..drifts).map(|_| EnergyDrift::of(&pendulum)).collect();
    method.drift_each(&pendulum, &STARTS, &grid, &mut drifts, &mut vec![Phase::default(); ends]);
}

//! The lab as a page uses it, by the functions that it exports.

use pendula::Phase;
use pendula_lab::{exports, figures};

/// The labs to compare with the library.
pub fn labs() -> Vec<Box<dyn Lab>> {
    vec![
        Box::new(Source),
        #[cfg(feature = "interpreter")]
        Box::new(compiled::Compiled::new()),
    ]
}

macro_rules! exported {
    ($($from:ident::$name:ident($($number:ident: $type:ty),*) $(-> $result:ty)?;)+) => {
        /// What the lab exports.
        #[expect(clippy::too_many_arguments, reason = "an export has numbers alone")]
        pub trait Lab {
            /// The name (0) or the title (1) of a method.
            fn text(&mut self, method: u32, which: u32) -> String;
            /// Writes the first of the shared points.
            fn write(&mut self, points: &[Phase]);
            /// Reads the first `count` of the shared points.
            fn points(&mut self, count: u32) -> Vec<Phase>;
            $(fn $name(&mut self, $($number: $type),*) $(-> $result)?;)+
        }

        impl Lab for Source {
            fn text(&mut self, method: u32, which: u32) -> String {
                exports::text(method, which).to_string()
            }

            fn write(&mut self, points: &[Phase]) {
                let both = points.iter().map(|z| [z.theta, z.omega]);
                figures::shared(|shared| shared.iter_mut().zip(both).for_each(|(at, z)| *at = z));
            }

            fn points(&mut self, count: u32) -> Vec<Phase> {
                let phase = |&[theta, omega]: &[f64; 2]| Phase { theta, omega };
                figures::shared(|shared| shared[..count as usize].iter().map(phase).collect())
            }

            $(fn $name(&mut self, $($number: $type),*) $(-> $result)? {
                $from::$name($($number),*)
            })+
        }

        #[cfg(feature = "interpreter")]
        impl Lab for compiled::Compiled {
            fn text(&mut self, method: u32, which: u32) -> String {
                let at = self.call("text_at", (method, which));
                let length = self.call("text_length", (method, which));
                String::from_utf8(self.bytes(at, length).to_vec()).unwrap()
            }

            fn write(&mut self, points: &[Phase]) {
                let numbers = points.iter().flat_map(|z| [z.theta, z.omega]);
                let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
                let at = self.call("points_at", ());
                self.bytes(at, bytes.len() as u32).copy_from_slice(&bytes);
            }

            fn points(&mut self, count: u32) -> Vec<Phase> {
                let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().unwrap());
                let phase =
                    |z: &[u8]| Phase { theta: number(&z[..8]), omega: number(&z[8..]) };
                let at = self.call("points_at", ());
                self.bytes(at, 16 * count).chunks_exact(16).map(phase).collect()
            }

            $(fn $name(&mut self, $($number: $type),*) $(-> $result)? {
                self.call(stringify!($name), ($($number,)*))
            })+
        }
    };
}

exported! {
    exports::places() -> u32;
    exports::methods() -> u32;
    exports::set(place: u32, kind: u32, method: u32, g: f64, length: f64, damping: f64, theta: f64,
        omega: f64, step: f64, p: f64, q: f64) -> u32;
    exports::advance(place: u32, steps: u32) -> u32;
    exports::look(place: u32);
    exports::read(place: u32, quantity: u32) -> f64;
    exports::exact_theta(place: u32, t: f64) -> f64;
    exports::exact_omega(place: u32, t: f64) -> f64;
    exports::separatrix_theta(place: u32, t: f64) -> f64;
    exports::separatrix_omega(place: u32, t: f64) -> f64;
    figures::points_room() -> u32;
    figures::scene(method: u32, g: f64, length: f64, theta: f64, omega: f64, step: f64) -> u32;
    figures::carry(steps: u32, count: u32);
    figures::follow(t: f64, count: u32);
    figures::orbit(count: u32) -> u32;
    figures::level_curve(order: u32, count: u32);
    figures::strays(order: u32, count: u32) -> f64;
    figures::area(count: u32) -> f64;
    figures::shape(which: u32, size: f64, pieces: u32) -> u32;
    figures::step_parts() -> u32;
}

/// The source, compiled for this machine.
struct Source;

/// The quantities that the page can read, numbered as in `book/lab/src/simulation.rs`.
pub mod quantity {
    pub const THETA: u32 = 0;
    pub const OMEGA: u32 = 1;
    pub const TIME: u32 = 2;
    pub const STEPS: u32 = 3;
    pub const EVALUATIONS: u32 = 4;
    pub const ENERGY: u32 = 5;
    pub const ERROR: u32 = 6;
    pub const LOWEST: u32 = 7;
    pub const HIGHEST: u32 = 8;
    pub const LARGEST: u32 = 9;
    pub const LIMIT: u32 = 10;
    pub const PERIOD: u32 = 11;
    pub const INITIAL: u32 = 12;
    pub const LOWER_THETA: u32 = 13;
    pub const LOWER_OMEGA: u32 = 14;
}

/// If it is the compiled file that differs.
pub const STALE: &str =
    "if this holds of the source, book/src/assets/lab.wasm.js is stale: run book/lab/build";

/// Compares the bits, except for a NaN, of an implicit step that is not solved, which has many bit
/// patterns.
#[track_caller]
pub fn assert_bits(lab: f64, library: f64, what: impl FnOnce() -> String) {
    assert!(
        lab.to_bits() == library.to_bits() || (lab.is_nan() && library.is_nan()),
        "{}: {lab:e}, and in the library {library:e}\n{STALE}",
        what()
    );
}

#[cfg(feature = "interpreter")]
mod compiled {
    use std::fs;
    use std::path::Path;

    use base64::Engine as _;
    use base64::prelude::BASE64_STANDARD;
    use wasmi::{Engine, Instance, Linker, Module, Store, WasmParams, WasmResults};

    /// The most that a page may load for it: 64 KB.
    const LARGEST_FILE: usize = 96 * 1024;

    /// The bytes of the file.
    fn wasm() -> Vec<u8> {
        let book = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let script = fs::read_to_string(book.join("src/assets/lab.wasm.js")).unwrap();
        let (_, rest) =
            script.split_once("globalThis.pendulaLab = \"").expect("the script's one line");
        BASE64_STANDARD.decode(rest.split_once("\";").expect("its end").0).expect("base64")
    }

    /// The compiled file, in an interpreter.
    pub struct Compiled {
        store: Store<()>,
        instance: Instance,
    }

    impl Compiled {
        pub fn new() -> Self {
            let engine = Engine::default();
            let module = Module::new(&engine, wasm()).unwrap();
            assert_eq!(module.imports().count(), 0, "it would ask something of the page");
            let mut store = Store::new(&engine, ());
            let linker = Linker::new(&engine);
            let instance = linker.instantiate_and_start(&mut store, &module).unwrap();
            Self { store, instance }
        }

        pub fn call<P: WasmParams, R: WasmResults>(&mut self, name: &str, parameters: P) -> R {
            let function = self.instance.get_typed_func(&self.store, name).unwrap();
            function.call(&mut self.store, parameters).unwrap()
        }

        /// So many bytes of its memory.
        pub fn bytes(&mut self, at: u32, length: u32) -> &mut [u8] {
            let memory = self.instance.get_memory(&self.store, "memory").unwrap();
            &mut memory.data_mut(&mut self.store)[at as usize..][..length as usize]
        }
    }

    /// Catches: a page that becomes slow to load.
    #[test]
    fn the_file_is_small() {
        let size = wasm().len();
        assert!(size <= LARGEST_FILE, "{size} bytes");
    }
}

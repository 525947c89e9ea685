//! `pendula sweep devices` and `pendula sweep --device`.

use std::process::{Command, Output};

use crate::{PENDULA, assert_refused, printed, words};

/// Distinct names of the devices, as they are printed. Where there is none, the tests that need one
/// say so, and do not run.
fn devices() -> Vec<String> {
    if let Err(error) = pendula_device::devices() {
        println!("not run: {error}");
        return Vec::new();
    }
    let lines = printed(&["sweep", "devices"]);
    let of = |line: &str| line.split("  ").next().map(str::to_owned);
    lines.lines().map(|line| of(line).expect("a name")).collect()
}

/// Every method, from all sorts of starts, is compared in `tests/device/bits.rs`.
///
/// Catches: a device that has other bits than the lanes; another order of the rows; an energy error
/// of other samples.
#[test]
fn a_sweep_on_a_device_is_the_same_to_the_byte() {
    for name in devices() {
        // Half a name, in the other case.
        let half: String = name.chars().take(name.chars().count() / 2).collect();
        let half = half.to_uppercase();
        for method in ["rk4", "stormer-verlet", "processed-6"] {
            let sweep = "--theta0 -3.1:3.14:4096 --dt 0.05 --duration 2";
            let lanes = format!("sweep --method {method} {sweep}");
            let on_device = [&words(&lanes)[..], &["--device", &half]].concat();
            assert_eq!(printed(&on_device), printed(&words(&lanes)), "{method} on {name}");
        }
    }
}

/// Catches: a sweep that runs in lanes after all; a file that is begun before the device is known.
#[test]
fn what_a_device_cannot_do_is_refused() {
    let sweep = ["sweep", "--theta0", "0:3:9", "--dt", "0.1", "--duration", "1", "--method"];
    let with = |more: &[&'static str]| [&sweep[..], more].concat();
    if let Some(name) = devices().first() {
        assert_refused(&with(&["gauss-4", "--device", "p"]), "gauss-4 does not run on a device");
        assert_refused(&with(&["rk4", "--device", "no such"]), name);
    }
}

/// Catches: a program that cannot start where there is no driver, that panics, or that runs in
/// lanes; an empty list that is a failure, or says nothing.
#[test]
#[cfg(target_os = "linux")]
fn where_there_is_no_platform_one_line_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rows.csv");
    let sweep = ["sweep", "--method", "rk4", "--theta0", "0:3:9", "--dt", "0.1", "--duration", "1"];
    let output = ["--device", "x", "--output", file.to_str().expect("UTF-8")];
    for (arguments, expected) in
        [(&["sweep", "devices"][..], 0), (&[&sweep[..], &output].concat(), 2)]
    {
        let Output { status, stdout, stderr } = Command::new(PENDULA)
            .args(arguments)
            .env("OCL_ICD_VENDORS", folder.path())
            .output()
            .expect("it starts");
        assert_eq!(status.code(), Some(expected));
        let expected =
            "pendula: there is no OpenCL platform on this machine, or no driver for one\n";
        assert_eq!(String::from_utf8_lossy(&stderr), expected);
        assert!(stdout.is_empty() && !file.exists());
    }
}

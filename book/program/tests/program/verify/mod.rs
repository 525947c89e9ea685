//! Judging a program that is not ours: the command, programs that work, and programs that do not.

#[cfg(unix)]
mod anew;
mod extremes;
#[cfg(unix)]
mod faults;
mod languages;
mod reports;
mod solvers;
mod stdio;

use std::ffi::OsString;
#[cfg(unix)]
use std::thread;
use std::time::Duration;

use pendula::Phase;
use pendula_judge::{Program, Request};
use serde_json::Value;

use crate::{PENDULA, names, pendula, refused};

/// How long runs are and how many tolerances are asked for goes by the time that answers take: with
/// minutes for each it does not depend on what else the machine does.
const PATIENT: [&str; 2] = ["--patience", "600"];

/// Exit status and report, as JSON that is valid by its schema, of `program`, judged with these
/// options.
#[track_caller]
fn judged(options: &[&str], program: &[&str]) -> (i32, Value) {
    let words = [&["verify", "--format", "json"][..], &PATIENT, options, &["--"], program].concat();
    let output = pendula(words);
    let status = output.status.code().expect("it is not killed");
    let report: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {output:?}"));
    assert_valid(&report);
    (status, report)
}

/// The property of this name, of which there is one.
#[track_caller]
fn property<'r>(report: &'r Value, name: &str) -> &'r Value {
    let properties = report["properties"].as_array().unwrap();
    let mut those = properties.iter().filter(|property| property["name"] == name);
    let (Some(property), None) = (those.next(), those.next()) else { panic!("{name}: {report:#}") };
    property
}

/// Does both at once, as programs are waited for in each.
#[cfg(unix)]
fn both<T: Send>(one: impl FnOnce() -> T + Send, other: impl FnOnce() -> T + Send) -> [T; 2] {
    thread::scope(|scope| {
        let other = scope.spawn(other);
        [one(), other.join().unwrap()]
    })
}

/// The program of these words, started, with this patience (s).
fn started<S: Into<OsString>>(
    words: impl IntoIterator<Item = S>,
    patience: f64,
) -> Result<Program, String> {
    let words: Vec<OsString> = words.into_iter().map(Into::into).collect();
    Program::start(&words, Duration::from_secs_f64(patience))
}

/// From 1 rad at rest, `steps` steps of `step` (s), each tenth of them asked for.
fn request(step: f64, steps: u64) -> Request {
    let start = Phase { theta: 1.0, omega: 0.0 };
    Request::new(9.81, start, step, steps).every(steps.min(10))
}

#[track_caller]
fn assert_valid(report: &Value) {
    let schema = schema();
    if let Err(error) = valid(report, &schema, &schema) {
        panic!("{error}: {report:#}");
    }
}

/// The schema of the repository, of the few words of JSON Schema that are known here. (A library
/// that knows all of them brings forty packages along.)
fn schema() -> Value {
    serde_json::from_str(include_str!("../../../../judge/src/report.schema.json")).unwrap()
}

/// Why `value` is not valid by `schema`, whose references are to `root`.
///
/// # Panics
/// At a word that is not known here.
fn valid(value: &Value, schema: &Value, root: &Value) -> Result<(), String> {
    let wrong = |why: &str| Err(format!("{value} {why}"));
    for (word, by) in schema.as_object().unwrap() {
        let holds = match word.as_str() {
            "$schema" | "$defs" | "title" | "description" => true,
            "const" => value == by,
            "enum" => by.as_array().unwrap().contains(value),
            "type" => match by {
                Value::Array(types) => types.iter().any(|one| is(value, one)),
                one => is(value, one),
            },
            "maxItems" => value.as_array().unwrap().len() as u64 <= by.as_u64().unwrap(),
            // All fields are required, and no others are allowed.
            "required" | "additionalProperties" => true,
            "properties" => {
                let fields = by.as_object().unwrap();
                let mut required: Vec<_> = schema["required"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .filter_map(Value::as_str)
                    .collect();
                required.sort_unstable();
                assert!(fields.keys().eq(required) && schema["additionalProperties"] == false);
                for (name, by) in fields {
                    value.get(name).map_or(Ok(()), |field| valid(field, by, root))?;
                }
                value.as_object().is_some_and(|object| object.keys().eq(fields.keys()))
            }
            "items" => {
                for item in value.as_array().into_iter().flatten() {
                    valid(item, by, root)?;
                }
                true
            }
            "anyOf" => by.as_array().unwrap().iter().any(|one| valid(value, one, root).is_ok()),
            "$ref" => {
                let place = by.as_str().unwrap().strip_prefix('#').unwrap();
                valid(value, root.pointer(place).unwrap(), root)?;
                true
            }
            other => panic!("{other} is not known here"),
        };
        if !holds {
            return wrong(&format!("does not have {word}: {by}"));
        }
    }
    Ok(())
}

fn is(value: &Value, name: &Value) -> bool {
    match name.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "null" => value.is_null(),
        other => panic!("{other} is not known here"),
    }
}

/// Catches: a schema, or a reader of it, that lets everything pass.
#[test]
fn the_schema_refuses_what_is_no_report() {
    let (_, report) = judged(&[], &[PENDULA, "serve", "rk4"]);
    let refused = |spoilt: &Value| valid(spoilt, &schema(), &schema()).is_err();
    for (place, wrong) in [
        ("/schema", Value::from(2)),
        ("/verdict", Value::from("good")),
        ("/identity", Value::from(4)),
        ("/properties", Value::Null),
        ("/properties/0/verdict", Value::from("good")),
        ("/properties/0/value", Value::from("2.00")),
        ("/program", Value::from("rk4")),
    ] {
        let mut spoilt = report.clone();
        *spoilt.pointer_mut(place).unwrap() = wrong;
        assert!(refused(&spoilt), "{place}");
    }
    for place in ["", "/program", "/properties/0"] {
        let mut more = report.clone();
        more.pointer_mut(place).unwrap()["new"] = Value::Null;
        assert!(refused(&more), "a field more at {place}");
        let mut less = report.clone();
        let object = less.pointer_mut(place).unwrap().as_object_mut().unwrap();
        let first = object.keys().next().unwrap().clone();
        object.remove(&first);
        assert!(refused(&less), "{first} is missing at {place}");
    }
}

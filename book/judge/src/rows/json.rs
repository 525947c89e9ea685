//! The report as an object, for programs.

use serde_json::{Value, json};

use super::report::{
    Digits, Distinguish, Fault, Force, FoundEquation, Known, Made, Maker, RunReport, Unit, Used,
};

impl RunReport {
    /// The report as JSON; `text` has it in words.
    pub fn json(&self) -> Value {
        let read = &self.read;
        json!({
            "schema": 1,
            "text": self.to_string(),
            "rows": read.rows,
            "time": used(&read.time),
            "angle": used(&read.angle),
            "height": read.height.as_ref().map(used),
            "velocity": read.velocity.as_ref().map(used),
            "unit": match read.unit {
                Unit::Radians => "rad",
                Unit::Degrees => "deg",
                Unit::Coordinates => "x-y",
            },
            "spacing": read.spacing,
            "faults": self.faults.iter().map(fault).collect::<Vec<_>>(),
            "equation": self.equation.as_ref().map(equation),
            "method": maker(&self.maker),
            "compared": self.compared.0,
            "pairs": self.compared.1,
            "end": self.end.as_ref().map(|end| json!({
                "time": end.time,
                "angle_error": end.angle,
                "energy_error": end.energy,
                "others": end.others.iter()
                    .map(|(name, off)| json!({"name": name, "angle_error": off}))
                    .collect::<Vec<_>>(),
            })),
        })
    }
}

fn used(used: &Used) -> Value {
    let (kind, digits) = match used.digits {
        Digits::Decimals(n) => ("decimals", n),
        Digits::Significant(n) => ("digits", n),
    };
    json!({"column": used.column, "heading": used.heading, kind: digits})
}

fn fault(fault: &Fault) -> Value {
    let (what, row, by) = match *fault {
        Fault::NoNumber { row } => ("no-number", Some(row), None),
        Fault::Missing { after, rows } => ("missing", Some(after + 1), Some(rows as i64)),
        Fault::TimeRepeated { row } => ("time-repeated", Some(row), None),
        Fault::StateRepeated { row } => ("state-repeated", Some(row), None),
        Fault::TimesLate { row, by } => ("times-late", Some(row), Some(by as i64)),
        Fault::TimeOff { row } => ("time-off", Some(row), None),
        Fault::Edited { row } => ("edited", Some(row), None),
        Fault::VelocityShifted { rows } => ("velocity-of-another-row", None, Some(i64::from(rows))),
        Fault::Wrapped { row, times } => ("wrapped", Some(row), Some(times as i64)),
        Fault::Uneven => ("uneven-times", None, None),
    };
    json!({"what": what, "row": row, "by": by, "text": fault.to_string()})
}

fn known(known: &Known) -> Value {
    json!({"value": known.value, "known_to": known.known_to, "short": known.short})
}

fn equation(equation: &FoundEquation) -> Value {
    let force = match equation.force {
        Force::Sine => "sin",
        Force::Linear => "linear",
        Force::Cubic => "cubic",
        Force::Cosine => "cos",
        Force::SineCosine => "sin-cos",
        Force::Degrees => "sin-of-degrees",
    };
    json!({
        "force": force,
        "k": known(&equation.k),
        "damping": equation.damping.as_ref().map(known),
        "drive": equation.drive.as_ref().map(|[a, frequency, phase]| json!({
            "amplitude": known(a), "frequency": known(frequency), "phase": known(phase),
        })),
    })
}

fn made(made: &Made) -> Value {
    json!({
        "name": made.name,
        "wrong": made.wrong,
        "steps_per_row": made.steps,
        "step": made.step,
        "equation": equation(&made.equation),
        "off": made.off,
        "same": made.same.iter().map(|(name, k)| json!({"name": name, "k": k})).collect::<Vec<_>>(),
    })
}

fn maker(maker: &Maker) -> Value {
    match maker {
        Maker::Method(method) => json!({"is": "known", "known": [made(method)]}),
        Maker::Several { methods, exact, by } => json!({
            "is": "several",
            "known": methods.iter().map(made).collect::<Vec<_>>(),
            "exact_motion_too": exact.is_some(),
            "exact_motion_off": exact,
            "distinguish": by.iter().map(|by| match by {
                Distinguish::Velocity => "velocity",
                Distinguish::Digits => "digits",
                Distinguish::LongerStep => "longer-step",
                Distinguish::Rows => "rows",
            }).collect::<Vec<_>>(),
        }),
        Maker::Measured { noise } => json!({"is": "measured", "noise": noise}),
        Maker::Unknown { nearest, exact, equation: near } => json!({
            "is": "unknown",
            "nearest": nearest.as_ref().map(|(name, off)| json!({"name": name, "off": off})),
            "exact_motion_off": exact,
            "nearest_equation": equation(near),
        }),
        Maker::NoPendulum => json!({"is": "no-pendulum"}),
    }
}

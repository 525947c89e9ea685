//! The slopes of a method, before and now, with the steps between which they are.

use anyhow::{Context, Result};
use pendula::verify::sign_of_slopes;
use pendula_charts::{Axis, Chart, Figure, Style};

use super::cells::Value;
use super::claims::table;
use super::number::{leading, parse};
use crate::versions::Version;

/// The slopes of a method in two versions.
#[derive(Clone, Debug, PartialEq)]
pub struct Slopes {
    /// The order that the method claims now, if slopes of its error are to be that.
    pub claimed: Option<u32>,
    /// Before and now.
    pub versions: [Vec<Slope>; 2],
}

/// A slope of an error against the step.
#[derive(Clone, Debug, PartialEq)]
pub struct Slope {
    /// The longer and the shorter step.
    pub steps: String,
    /// The slope as it is printed.
    pub said: Value,
}

impl Slope {
    fn value(&self) -> Option<f64> {
        leading(&self.said.text).map(|number| number.value)
    }
}

impl Slopes {
    /// The slopes of `method` in the snapshot `name` of both versions; a version may lack them.
    ///
    /// # Errors
    /// If the snapshot is not a table of slopes as the study writes it.
    pub fn read(versions: [&Version; 2], name: &str, method: &str) -> Result<Self> {
        let (mut claimed, mut read) = (None, [Vec::new(), Vec::new()]);
        for (version, slopes) in versions.into_iter().zip(&mut read) {
            let Some(table) = table(version, name)? else { continue };
            let Some(row) = table.rows().iter().find(|row| row[0] == method) else { continue };
            let corrupt = || format!("{name}: corrupt: the row of {method}");
            *slopes = if name == "orders" {
                let order: u32 = row[1].parse().with_context(corrupt)?;
                claimed = Some(order);
                ladder(order, row).with_context(corrupt)?
            } else {
                // The headings are the steps.
                let cells = table.header().iter().zip(row).skip(1);
                let slope = |(steps, cell): (&String, &String)| Slope {
                    steps: steps.clone(),
                    said: Value::new(cell),
                };
                cells.map(slope).collect()
            };
            slopes.retain(|slope| !slope.said.text.is_empty());
        }
        Ok(Self { claimed, versions: read })
    }

    /// What slopes that fall away from the claimed order are a sign of, as the judge says it.
    pub fn sign(&self) -> Option<String> {
        let now: Vec<f64> = self.versions[1].iter().filter_map(Slope::value).collect();
        let leaves = self.versions[1].iter().any(|slope| slope.said.marked);
        let claimed = self.claimed.filter(|_| leaves)?;
        sign_of_slopes(claimed, &now)
    }

    /// All steps, from long ones to short ones: a ladder may begin elsewhere than before.
    pub fn steps(&self) -> Vec<String> {
        let [before, now] = &self.versions;
        let is_longer = |slope: &&Slope| now.iter().all(|now| now.steps != slope.steps);
        let only: Vec<&Slope> = before.iter().filter(is_longer).collect();
        let first = |slopes: &[Slope]| slopes.first().and_then(|slope| leading(&slope.steps));
        let is_before = first(before).map(|step| step.value) > first(now).map(|step| step.value);
        let now: Vec<&Slope> = now.iter().collect();
        let all = if is_before { [only, now] } else { [now, only] };
        all.concat().into_iter().map(|slope| slope.steps.clone()).collect()
    }

    /// Both versions side by side in one small figure, in the order of the steps.
    pub fn svg(&self, title: &str, id: &str) -> String {
        let steps = self.steps();
        let place = |slope: &Slope| steps.iter().position(|step| *step == slope.steps);
        let points = |slopes: &[Slope]| -> Vec<(f64, f64)> {
            let point = |slope: &Slope| Some((place(slope)? as f64, slope.value()?));
            slopes.iter().filter_map(point).collect()
        };
        let [before, now] = self.versions.each_ref().map(|slopes| points(slopes));
        let claimed = self.claimed.map(f64::from);
        let values = before.iter().chain(&now).map(|point| point.1).chain(claimed);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        // Names of both steps, or of more than five, would run into each other.
        let longer = |step: &String| step.split(" →").next().unwrap_or_default().to_string();
        let ticks = steps.iter().enumerate().step_by(steps.len().div_ceil(5).max(1));
        let ticks = ticks.map(|(place, step)| (place as f64, longer(step)));
        let x = Axis::linear("the longer step (s)").range(-0.4, steps.len() as f64 - 0.6);
        let x = x.ticks(ticks);
        let y = Axis::linear("slope").range(low - 0.3, high + 0.3);
        let mut chart = Chart::new(x, y).height(170.0);
        if let Some(order) = self.claimed {
            chart = chart.horizontal(f64::from(order), format!("claimed: {order}"));
        }
        let chart =
            chart.series("before", Style::TRUE_POINT, before).series("now", Style::series(0), now);
        let described = "Slopes from step to step, before and now, as in the table above.";
        Figure::new(title, described).panel(chart).to_svg(id)
    }
}

/// Two steps, in two digits: those of a ladder are round numbers only to these.
fn named(steps: [f64; 2]) -> String {
    let [long, short] = steps.map(|step| {
        let digits = (1.0 - step.log10().floor()).max(0.0) as usize;
        let step = format!("{step:.digits$}");
        if step.contains('.') { step.trim_end_matches('0').to_string() } else { step }
    });
    format!("{long} → {short} s")
}

/// The slopes of a row of `orders`: its order, its first step, and the slopes from rung to rung.
fn ladder(order: u32, row: &[String]) -> Option<Vec<Slope>> {
    let first = parse(&row[2])?.value;
    // As in `pendula::verify::properties::Ladder`: from rung to rung the error falls sixteenfold,
    // beyond order 8 by 2¹⁶, and the step by half at most.
    let powers = if order > 8 { 16.0 } else { 4.0 };
    let factor = (powers / f64::from(order.max(1))).min(1.0).exp2();
    let slope = |(k, cell): (i32, &String)| {
        let steps = [k, k + 1].map(|rung| first / factor.powi(rung));
        Slope { steps: named(steps), said: Value::new(cell) }
    };
    Some((0..).zip(row.get(3..)?).map(slope).collect())
}

#[cfg(test)]
mod tests {
    use pendula::method_named;
    use pendula::verify::properties::Ladder;

    use super::*;

    /// Catches: a slope between other steps than those where the library measures it.
    #[test]
    fn the_steps_are_those_of_the_library() {
        for name in ["stormer-verlet", "gauss-6", "taylor-24"] {
            let method = method_named(name).unwrap();
            let order = method.info().order;
            let steps = Ladder::measure(method).steps;
            let first = format!("{:.6}", steps[0]);
            let row = ["", "", &first, "1", "2", "3", "4"].map(str::to_string);
            let read = ladder(order, &row).unwrap();
            let read: Vec<String> = read.into_iter().map(|slope| slope.steps).collect();
            let expected = steps.windows(2).map(|pair| named([pair[0], pair[1]]));
            assert_eq!(read, expected.collect::<Vec<_>>(), "{name}");
        }
    }

    /// Catches: steps out of order, or twice, where a ladder begins elsewhere than it did.
    #[test]
    fn steps_fall_from_version_to_version() {
        let slopes = |steps: &[&str]| {
            let slope = |steps: &&str| Slope { steps: steps.to_string(), said: Value::new("1") };
            steps.iter().map(slope).collect::<Vec<_>>()
        };
        let (long, short) = (["4 → 2 s", "2 → 1 s"], ["2 → 1 s", "1 → 0.5 s"]);
        for versions in [[&long, &short], [&short, &long]] {
            let versions = versions.map(|steps| slopes(steps));
            let steps = Slopes { claimed: None, versions }.steps();
            assert_eq!(steps, ["4 → 2 s", "2 → 1 s", "1 → 0.5 s"]);
        }
    }
}

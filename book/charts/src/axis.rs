//! Axes: linear and logarithmic scales, their ranges and their ticks.

use super::text::minus;

/// An axis: what it shows, linear or logarithmic, from where to where.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, and the unit.
    pub label: String,
    kind: Kind,
    /// From where to where, if it was said.
    pub range: Option<(f64, f64)>,
    /// The ticks, if they were said.
    pub ticks: Option<Vec<Tick>>,
}

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Linear,
    Log,
}

impl Axis {
    /// A linear axis, whose label should name the unit: `"t (s)"`.
    ///
    /// Labels everywhere may hold `^{superscripts}` and `_{subscripts}`.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), kind: Kind::Linear, range: None, ticks: None }
    }

    /// A logarithmic axis. Values that are not positive have no place on it and leave a gap.
    pub fn log(label: impl Into<String>) -> Self {
        Self { kind: Kind::Log, ..Self::linear(label) }
    }

    /// From `low` to `high` instead of what the data need.
    ///
    /// A range no axis can have (`low ≥ high`, not finite, not positive on a logarithmic axis) is
    /// ignored.
    pub fn range(self, low: f64, high: f64) -> Self {
        let possible = low < high && self.can_show(low) && self.can_show(high);
        Self { range: possible.then_some((low, high)), ..self }
    }

    /// These ticks with these labels, such as `[(-PI, "−π"), (0.0, "0"), (PI, "π")]`, instead of
    /// round numbers.
    pub fn ticks<S: Into<String>>(self, ticks: impl IntoIterator<Item = (f64, S)>) -> Self {
        let tick = |(value, label): (f64, S)| Tick { value, label: Some(label.into()) };
        Self { ticks: Some(ticks.into_iter().map(tick).collect()), ..self }
    }

    pub(super) fn can_show(&self, value: f64) -> bool {
        self.place(value).is_some()
    }

    /// The length of the range that was asked for.
    pub(super) fn span(&self) -> Option<f64> {
        self.range.map(|(low, high)| high - low)
    }

    /// The coordinate along the axis, on which it is even.
    fn place(&self, value: f64) -> Option<f64> {
        match self.kind {
            _ if !value.is_finite() || value.abs() > 1e300 => None,
            Kind::Log if value <= 0.0 => None,
            Kind::Log => Some(libm::log10(value)),
            Kind::Linear => Some(value),
        }
    }

    /// The scale for these data; with a `count`, a linear one ends at ticks, about that many of
    /// them.
    pub(super) fn scale(&self, data: impl Iterator<Item = f64>, count: Option<usize>) -> Scale<'_> {
        let ends = match self.range {
            Some((low, high)) => self.place(low).zip(self.place(high)),
            None => None,
        };
        let (low, high) = ends.unwrap_or_else(|| {
            let (low, high) = data
                .filter_map(|value| self.place(value))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            self.widen(low, high, count)
        });
        Scale { axis: self, low, high }
    }

    /// A range around the data that ends a little outside them (logarithmic), or at a tick.
    fn widen(&self, low: f64, high: f64, count: Option<usize>) -> (f64, f64) {
        if low > high {
            return (0.0, 1.0);
        }
        let is_linear = self.kind == Kind::Linear;
        let least = if is_linear { 1e-9 * low.abs().max(high.abs()) } else { 0.3 };
        let (low, high) = match high - low {
            span if span > least => (low, high),
            _ if low == 0.0 && high == 0.0 => (-1.0, 1.0),
            _ => (low - least.max(0.1 * low.abs()), high + least.max(0.1 * high.abs())),
        };
        match count {
            _ if !is_linear => (low - 0.05 * (high - low), high + 0.05 * (high - low)),
            None => (low, high),
            // Three times, since the wider range may ask for wider steps, and so may that.
            Some(count) => (0..3).fold((low, high), |(low, high), _| {
                let step = Step::new(high - low, count);
                let size = step.value(1.0);
                (step.value((low / size + 1e-9).floor()), step.value((high / size - 1e-9).ceil()))
            }),
        }
    }
}

/// A tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where it stands.
    pub value: f64,
    /// What stands beside it; nothing at the minor ones.
    pub label: Option<String>,
}

/// An axis with its range, in values or in logarithms of them.
pub(super) struct Scale<'a> {
    axis: &'a Axis,
    low: f64,
    high: f64,
}

impl Scale<'_> {
    /// Where the value stands: 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> Option<f64> {
        Some((self.axis.place(value)? - self.low) / (self.high - self.low))
    }

    pub fn contains(&self, value: f64) -> bool {
        self.fraction(value).is_some_and(|f| (-1e-9..=1.0 + 1e-9).contains(&f))
    }

    /// At most about `count` labelled ticks.
    pub fn ticks(&self, count: usize) -> Vec<Tick> {
        let mut ticks = match (&self.axis.ticks, self.axis.kind) {
            (Some(ticks), _) => ticks.clone(),
            (None, Kind::Log) => log_ticks(self.low, self.high, count),
            (None, Kind::Linear) => linear_ticks(self.low, self.high, count),
        };
        ticks.retain(|tick| self.contains(tick.value));
        ticks
    }
}

/// A round step, 1, 2 or 5 times a power of ten.
struct Step {
    mantissa: f64,
    exponent: i32,
}

impl Step {
    /// The smallest that fits about `count` times into `span`, at most a third more often.
    fn new(span: f64, count: usize) -> Self {
        let least = 0.75 * span / count.max(1) as f64;
        let exponent = libm::log10(least).floor() as i32;
        let power = libm::pow(10.0, f64::from(exponent));
        match [1.0, 2.0, 5.0].into_iter().find(|mantissa| mantissa * power >= least) {
            Some(mantissa) => Self { mantissa, exponent },
            None => Self { mantissa: 1.0, exponent: exponent + 1 },
        }
    }

    /// `k` steps; a division where the step is below one, so that 3 × 0.1 is 0.3.
    fn value(&self, k: f64) -> f64 {
        let power = libm::pow(10.0, f64::from(self.exponent.abs()));
        let k = k * self.mantissa;
        if self.exponent < 0 { k / power } else { k * power }
    }
}

fn linear_ticks(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let step = Step::new(high - low, count);
    let (first, last) =
        ((low / step.value(1.0) - 1e-9).ceil(), (high / step.value(1.0) + 1e-9).floor());
    let largest = step.value(first.abs().max(last.abs()));
    // 1e5 and more, or all below 1e-3: one power of ten for all labels.
    // It is the step's, if the labels then have two digits at most: 5×10⁻⁶, and not 0.5×10⁻⁵.
    let power = match largest {
        v if v == 0.0 || (1e-3..1e5).contains(&v) => 0,
        v => {
            let power = libm::log10(v * (1.0 + 1e-9)).floor() as i32;
            if power - step.exponent <= 1 { step.exponent } else { power }
        }
    };
    let decimals = (power - step.exponent).clamp(0, 17) as usize;
    let scale = libm::pow(10.0, f64::from(power.abs()));
    let label = |value: f64| {
        let mantissa = if power < 0 { value * scale } else { value / scale };
        match power {
            _ if value == 0.0 => "0".into(),
            0 => minus(&format!("{mantissa:.decimals$}")),
            _ => minus(&format!("{mantissa:.decimals$}×10^{{{power}}}")),
        }
    };
    let tick = |i: i32| {
        let value = step.value(first + f64::from(i));
        Tick { value, label: Some(label(value)) }
    };
    (0..=(last - first).min(99.0) as i32).map(tick).collect()
}

/// Every decade or every few, with minor ticks between; below two decades 1, 2, 5 are labelled.
fn log_ticks(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let power = |k: i32| libm::pow(10.0, f64::from(k));
    let (first, last) = (low.floor() as i32, high.ceil() as i32);
    if high - low < 0.7 {
        return linear_ticks(libm::pow(10.0, low), libm::pow(10.0, high), count.min(4));
    }
    let whole = (high.floor() - low.ceil()) as i32 + 1;
    let stride = (whole.max(1) as usize).div_ceil(count.max(1)) as i32;
    // Below two decades of ordinary numbers: 0.5, 1, 2.
    let plain = whole < 2 && first >= -2 && last <= 4;
    let label = |digit: i32, k: i32| match digit {
        _ if plain => format!("{:.*}", (-k).max(0) as usize, f64::from(digit) * power(k)),
        1 => format!("10^{{{}}}", minus(&k.to_string())),
        _ => format!("{digit}×10^{{{}}}", minus(&k.to_string())),
    };
    let mut ticks = Vec::new();
    for k in first..=last {
        for digit in 1..=9 {
            let is_labelled = match digit {
                1 => k % stride == 0,
                2 | 5 => whole < 2,
                _ => false,
            };
            let label = is_labelled.then(|| label(digit, k));
            if label.is_some() || digit == 1 || whole <= 7 {
                ticks.push(Tick { value: f64::from(digit) * power(k), label });
            }
        }
    }
    ticks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, data: &[f64], count: usize) -> Vec<String> {
        let ticks = axis.scale(data.iter().copied(), Some(count)).ticks(count);
        ticks.into_iter().filter_map(|tick| tick.label).collect()
    }

    /// Catches: labels such as 0.00001 or 2000000 that are wider than the plot's margin.
    #[test]
    fn very_small_and_very_large_numbers_share_a_power_of_ten() {
        let axis = Axis::linear("x");
        assert_eq!(
            labels(&axis, &[0.0, 2e-5], 4),
            ["0", "5×10^{−6}", "10×10^{−6}", "15×10^{−6}", "20×10^{−6}"]
        );
        assert_eq!(labels(&axis, &[0.0, 2e6], 2), ["0", "1×10^{6}", "2×10^{6}"]);
        assert_eq!(labels(&axis, &[0.0, 1e7], 2), ["0", "5×10^{6}", "10×10^{6}"]);
        let far = [1e6, 1e6 + 2e4];
        assert_eq!(labels(&axis, &far, 2), ["1.00×10^{6}", "1.01×10^{6}", "1.02×10^{6}"]);
    }

    /// Catches: an endless loop, a division by zero or an empty axis for constant, missing,
    /// huge or nearly constant data.
    #[test]
    fn every_range_has_ticks() {
        for data in [
            &[][..],
            &[0.0],
            &[-5.3],
            &[5.0, 5.0 + 1e-15],
            &[f64::NAN, f64::INFINITY],
            &[-1e300, 1e300],
            &[-f64::MAX, f64::MAX],
            &[1e-300],
        ] {
            for axis in [Axis::linear("x"), Axis::log("x")] {
                let count = labels(&axis, data, 5).len();
                assert!((2..=8).contains(&count), "{data:?}: {count}");
            }
        }
    }

    /// Catches: an impossible range that turns every coordinate into NaN.
    #[test]
    fn impossible_ranges_are_ignored() {
        assert_eq!(Axis::log("x").range(0.0, 1.0), Axis::log("x"));
        assert_eq!(Axis::linear("x").range(2.0, 2.0), Axis::linear("x"));
        assert_eq!(Axis::linear("x").range(f64::NAN, 2.0), Axis::linear("x"));
        // 1e300 is the largest that is shown.
        assert_ne!(Axis::linear("x").range(0.0, 1e300), Axis::linear("x"));
        assert_eq!(Axis::linear("x").range(0.0, 1e300_f64.next_up()), Axis::linear("x"));
    }
    /// Catches: a single value on the edge of its axis, or on an axis without length; no value at
    /// all.
    #[test]
    fn a_single_value_has_an_axis_about_it() {
        let ends = |axis: Axis, data: &[f64]| {
            let scale = axis.scale(data.iter().copied(), None);
            (scale.low, scale.high)
        };
        let linear = || Axis::linear("x");
        assert_eq!(ends(linear(), &[]), (0.0, 1.0));
        assert_eq!(ends(linear(), &[0.0]), (-1.0, 1.0));
        assert_eq!(ends(linear(), &[5.0]), (4.5, 5.5));
        assert_eq!(ends(linear(), &[-5.0, -5.0]), (-5.5, -4.5));
        assert_eq!(ends(linear(), &[0.0, 5.0]), (0.0, 5.0));
        // A single 1 gets a decade on either side. Otherwise a span below 0.3 decades is widened
        // by as much, or by a tenth of the exponent, on both sides; and every span by a twentieth
        // of it. Sums of numbers up to 11, rounded a few times.
        let near = |(a, b): (f64, f64), (c, d): (f64, f64)| (a - c).abs() + (b - d).abs() < 1e-12;
        assert!(near(ends(Axis::log("x"), &[1.0]), (-1.1, 1.1)));
        assert!(near(ends(Axis::log("x"), &[1e2]), (1.67, 2.33)));
        assert!(near(ends(Axis::log("x"), &[1e10]), (8.9, 11.1)));
        let high = 0.1;
        let (low, high) = (-0.3 - 0.05 * (0.6 + high), 0.3 + high + 0.05 * (0.6 + high));
        assert!(near(ends(Axis::log("x"), &[1.0, libm::pow(10.0, 0.1)]), (low, high)));
    }

    /// The number that a label says.
    fn said(label: &str) -> f64 {
        let text = label.replace('−', "-").replace('}', "");
        let (mantissa, power) = match text.split_once("10^{") {
            Some((mantissa, power)) => (mantissa.replace('×', ""), power),
            None => (text.clone(), "0"),
        };
        let mantissa = if ["", "-"].contains(&&*mantissa) { mantissa + "1" } else { mantissa };
        format!("{mantissa}e{power}").parse().expect(label)
    }

    /// All kinds of axes, with ranges of all sizes, at zero, about it and far from it, asked for or
    /// from data, for as many ticks as a chart asks for and twice as many.
    ///
    /// Catches: an axis that ends before its last tick or loses it to rounding, a tick too many at
    /// its end; digits of the step before last; a stride of decades that is too short, or
    /// longer than the axis; the logarithm of a single tick at zero.
    #[test]
    fn ticks_are_within_in_order_and_where_they_say() {
        let power = |k: f64| libm::pow(10.0, k);
        for (i, low) in [0.0, 1.0, -1.0, -0.3, 7.0, -123.0, 0.997].into_iter().enumerate() {
            for (j, span) in [0.0123, 0.5, 1.0, 1.7, 3.3, 8.9, 40.0].into_iter().enumerate() {
                let unit = power((i as f64 - 3.0) * 5.0 + (j % 3) as f64);
                for (axis, low, high) in [
                    (Axis::linear("x"), low * unit, (low + span) * unit),
                    (Axis::log("x"), power(low), power(low + span)),
                ] {
                    let asked = axis.clone().range(low, high);
                    for count in 1..=12 {
                        let round = Some(count).filter(|count| *count > 1);
                        for (axis, ends) in [(&axis, round), (&axis, None), (&asked, None)] {
                            let scale = axis.scale([low, high].into_iter(), ends);
                            assert!(scale.contains(low) && scale.contains(high));
                            assert_ticks(&scale, count, ends.is_some());
                        }
                    }
                }
            }
        }
    }

    /// A step is at least ¾ of what fits the count and less than 5/2 of that; a decade has at most
    /// three labels. A linear axis with `round` ends has a tick at either.
    fn assert_ticks(scale: &Scale<'_>, count: usize, round: bool) {
        let ticks = scale.ticks(count);
        let places: Vec<_> = ticks.iter().filter_map(|t| scale.fraction(t.value)).collect();
        let (least, most) = match scale.axis.kind {
            Kind::Linear if round => {
                assert!(
                    places[0] < 1e-9 && places[places.len() - 1] > 1.0 - 1e-9,
                    "{} {} {count} {ticks:?}",
                    scale.low,
                    scale.high
                );
                (2, count * 4 / 3 + 1)
            }
            Kind::Linear => (count * 8 / 15, count * 4 / 3 + 1),
            Kind::Log if scale.high - scale.low < 0.7 => (count.min(4) * 8 / 15, 6),
            Kind::Log => (1.max(count.min(4) / 2), count.max(5)),
        };
        let labels = ticks.iter().filter_map(|tick| tick.label.as_deref().zip(Some(tick.value)));
        let case = format!("{:?} {:?}, {count}: {ticks:?}", scale.axis, (scale.low, scale.high));
        assert!((least..=most).contains(&labels.clone().count()), "{case}");
        assert!(places.iter().all(|at| (-1e-9..=1.0 + 1e-9).contains(at)), "{case}");
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 1e-5), "{case}");
        for (label, value) in labels {
            assert!((said(label) - value).abs() <= 1e-12 * value.abs(), "{label}: {case}");
        }
    }
}

//! A search for right programs that are refused or misnamed, and for wrong ones that are let
//! through or told a cause that is not theirs.
//!
//! A test judges some of each; `cargo test --test verify search -- --ignored
//! --nocapture` a thousand of each, and says which wrong ones are let through: some ten minutes.

use pendula::{METHODS, Phase};
use pendula_judge::{
    Chosen, Claims, Fault, FromFn, Integrator, Property, Reply, Report, Request, Verdict, judge,
};

use crate::common::Random;
use crate::programs::*;

// -------------------------------------------------------------------------------------------------
// Right ones
// -------------------------------------------------------------------------------------------------

/// How numbers are returned.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Double,
    Digits(usize),
    Decimals(usize),
}

impl Format {
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Double => x,
            Self::Digits(count) => digits(count, x),
            Self::Decimals(count) => decimals(count, x),
        }
    }

    /// Whether it has fewer digits than a double tells of a state of order 1.
    fn is_coarse(self) -> bool {
        matches!(self, Self::Digits(..14) | Self::Decimals(..14))
    }
}

/// A method of the library, dressed otherwise.
#[derive(Clone, Copy, Debug)]
struct Dressed {
    method: Chosen<'static>,
    format: Format,
    /// Its angles are larger by this inside, which rounds.
    from: f64,
    /// Numbers are printed and read again after each so many steps.
    every: Option<u64>,
    /// It takes no steps back.
    ahead: bool,
    /// It knows no drive.
    alone: bool,
}

impl Integrator for Dressed {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        if (self.ahead && request.step < 0.0) || (self.alone && request.drive.is_some()) {
            return Err(Fault::Unsupported);
        }
        let printed = |z: Phase| {
            // As a sum that is kept in the angle rounds.
            let theta = (z.theta + self.from) - self.from;
            Phase { theta: self.format.of(theta), omega: self.format.of(z.omega) }
        };
        let every = self.every.filter(|every| request.drive.is_none() && *every < request.every);
        let Some(every) = every.filter(|every| request.every.is_multiple_of(*every)) else {
            let mut reply = self.method.answer(request)?;
            reply.states.iter_mut().for_each(|z| *z = printed(*z));
            return Ok(reply);
        };
        let (mut states, mut start) = (Vec::new(), request.start);
        for k in 1..=request.steps / every {
            let part = Request::new(request.g_over_l, start, request.step, every).every(every);
            start = printed(self.method.answer(&part)?.states[0]);
            if (k * every).is_multiple_of(request.every) {
                states.push(start);
            }
        }
        Ok(Reply { states, evaluations: None })
    }
}

/// A right program, by chance.
fn right(random: &mut Random) -> Dressed {
    let method = METHODS[random.below(METHODS.len())].info().name;
    let format = match random.below(5) {
        0 => Format::Double,
        1 | 2 => Format::Digits(6 + random.below(12)),
        3 => Format::Digits(14 + random.below(3)),
        _ => Format::Decimals(6 + random.below(11)),
    };
    Dressed {
        method: Chosen::named(method).expect("it is on the list"),
        format,
        from: [0.0, 0.0, std::f64::consts::PI, 10.0][random.below(4)],
        every: [None, None, Some(1), Some(5)][random.below(4)],
        ahead: random.below(4) == 0,
        alone: random.below(2) == 0,
    }
}

/// What is wrong with the report on a right program; nothing, if nothing is.
fn complaint_about_a_right_one(integrator: &Dressed, report: &Report) -> Option<String> {
    let name = integrator.method.pendulum.info().name;
    let named = report.identity.as_ref().filter(|known| !known.is_plain() || known.method != name);
    let refused: Vec<&str> = report
        .failures()
        .filter(|it| !(*it == Property::Precision && integrator.format.is_coarse()))
        .map(Property::name)
        .collect();
    let of_digits = |line: &&String| !line.contains("It prints") && !line.contains("it prints");
    let look_at = report.look_at();
    let told = look_at.iter().find(of_digits);
    match (named, &refused[..], told) {
        (Some(other), ..) => Some(format!("named {other}")),
        (_, [_, ..], _) => Some(format!("refused for {}", refused.join(", "))),
        (.., Some(line)) => Some(format!("told: {line}")),
        _ => None,
    }
}

fn right_ones(count: u64, seed: u64) -> Vec<String> {
    let mut random = Random::new(seed);
    let all = (0..count).filter_map(|k| {
        let integrator = right(&mut random);
        let info = integrator.method.pendulum.info();
        // Evaluations of parts are others.
        let claims = Claims { evaluations: None, ..Claims::of(&info) };
        let claims = if k % 3 == 0 { Claims { name: None, ..claims } } else { claims };
        let report = judge(&integrator, claims);
        let complaint = complaint_about_a_right_one(&integrator, &report)?;
        let Dressed { format, from, every, ahead, alone, .. } = integrator;
        Some(format!(
            "{} {format:?} from {from} every {every:?} ahead {ahead} alone {alone}: {complaint}",
            info.name
        ))
    });
    all.collect()
}

// -------------------------------------------------------------------------------------------------
// Wrong ones
// -------------------------------------------------------------------------------------------------

/// A step by a force of angle and velocity.
type Step = fn(&dyn Fn(f64, f64) -> f64, State, f64) -> State;

fn by_kick_drift(force: &dyn Fn(f64, f64) -> f64, (theta, omega): State, h: f64) -> State {
    let omega = omega + h * force(theta, omega);
    (theta + h * omega, omega)
}

fn by_drift_kick(force: &dyn Fn(f64, f64) -> f64, (theta, omega): State, h: f64) -> State {
    let theta = theta + h * omega;
    (theta, omega + h * force(theta, omega))
}

fn by_leapfrog(force: &dyn Fn(f64, f64) -> f64, (theta, omega): State, h: f64) -> State {
    let omega = omega + 0.5 * h * force(theta, omega);
    let theta = theta + h * omega;
    (theta, omega + 0.5 * h * force(theta, omega))
}

fn by_forward_euler(force: &dyn Fn(f64, f64) -> f64, (theta, omega): State, h: f64) -> State {
    (theta + h * omega, omega + h * force(theta, omega))
}

fn by_heun(force: &dyn Fn(f64, f64) -> f64, z: State, h: f64) -> State {
    let ahead = by_forward_euler(force, z, h);
    let (here, there) = (force(z.0, z.1), force(ahead.0, ahead.1));
    (z.0 + 0.5 * h * (z.1 + ahead.1), z.1 + 0.5 * h * (here + there))
}

fn by_rk4(force: &dyn Fn(f64, f64) -> f64, z: State, h: f64) -> State {
    let rate = |z: State| (z.1, force(z.0, z.1));
    let along = |k: State, h: f64| (z.0 + h * k.0, z.1 + h * k.1);
    let k1 = rate(z);
    let k2 = rate(along(k1, 0.5 * h));
    let k3 = rate(along(k2, 0.5 * h));
    let k4 = rate(along(k3, h));
    let sum = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
    (z.0 + h * sum(k1.0, k2.0, k3.0, k4.0), z.1 + h * sum(k1.1, k2.1, k3.1, k4.1))
}

const STEPS: [(&str, Step, &str); 6] = [
    ("symplectic-euler", by_kick_drift, "order=1 symplectic"),
    ("symplectic-euler-drift-first", by_drift_kick, "order=1 symplectic"),
    ("stormer-verlet", by_leapfrog, "order=2 symplectic symmetric"),
    ("forward-euler", by_forward_euler, "order=1"),
    ("heun", by_heun, "order=2"),
    ("rk4", by_rk4, "order=4"),
];

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Gravity,
    Damping,
    Quadratic,
    Torque,
    Cubic,
    Table,
    DeadBand,
    Decimals,
    Drag,
    Limit,
    Sleep,
    FastForce,
    FarForce,
    Late,
    LongSteps,
    StepFactor,
    StepSingle,
    StepRounded,
    StepMost,
    StepLeast,
    StepSize,
    RowsLate,
    OldVelocity,
    OldAngle,
    Mean,
    Difference,
    Place,
    TimesStep,
    Turns,
    ShortPi,
    Adds,
    Kept,
    Random,
    Noise,
    Single,
    FirstStep,
    Twice,
}

use Kind as F;

const FAULTS: [F; 37] = [
    F::Gravity,
    F::Damping,
    F::Quadratic,
    F::Torque,
    F::Cubic,
    F::Table,
    F::DeadBand,
    F::Decimals,
    F::Drag,
    F::Limit,
    F::Sleep,
    F::FastForce,
    F::FarForce,
    F::Late,
    F::LongSteps,
    F::StepFactor,
    F::StepSingle,
    F::StepRounded,
    F::StepMost,
    F::StepLeast,
    F::StepSize,
    F::RowsLate,
    F::OldVelocity,
    F::OldAngle,
    F::Mean,
    F::Difference,
    F::Place,
    F::TimesStep,
    F::Turns,
    F::ShortPi,
    F::Adds,
    F::Kept,
    F::Random,
    F::Noise,
    F::Single,
    F::FirstStep,
    F::Twice,
];

/// What is said where a cause is shown, and the faults of which it is true.
const CAUSES: [(&str, &[F]); 27] = [
    ("takes the absolute value of h", &[F::StepSize]),
    ("h in single precision", &[F::StepSingle]),
    ("h rounded to", &[F::StepRounded]),
    ("never longer than", &[F::StepMost]),
    ("never shorter than", &[F::StepLeast]),
    ("A run of", &[F::Late]),
    ("slopes before the start are taken as zero", &[]),
    // Rows of others begin with another step too.
    ("The first step", &[F::FirstStep, F::Twice, F::Mean, F::OldAngle, F::Difference]),
    ("Only the first step", &[F::FirstStep]),
    ("velocity of the step before", &[F::OldVelocity]),
    ("angle of the step before", &[F::OldAngle]),
    ("mean of each state", &[F::Mean]),
    ("steps late", &[F::RowsLate]),
    ("a step late", &[F::RowsLate]),
    ("difference of the last two", &[F::Difference]),
    ("sin θ for θ", &[F::Place]),
    ("ω h for ω", &[F::TimesStep]),
    ("is limited to", &[F::Limit]),
    ("stands still", &[F::Sleep, F::DeadBand]),
    ("has corners", &[F::Table, F::DeadBand]),
    ("g/L is rounded", &[F::Decimals]),
    ("turns are not 2π", &[F::ShortPi]),
    ("one bottom", &[F::ShortPi]),
    ("binary digits", &[F::Single]),
    ("single precision on the way", &[F::Single, F::Noise]),
    ("The same request has another answer", &[F::Random, F::Kept]),
    ("Each step turns the angle", &[F::Adds]),
];

/// A wrong program: its step, what is wrong, and a size.
#[derive(Clone, Copy, Debug)]
struct Mutant {
    step: (&'static str, Step, &'static str),
    fault: F,
    size: f64,
}

impl Mutant {
    fn run(
        &self,
        count: &std::cell::Cell<u64>,
        g: f64,
        theta: f64,
        omega: f64,
        h: f64,
        n: u64,
    ) -> Vec<State> {
        let Self { step: (_, step, _), fault, size } = *self;
        let g = match fault {
            F::Gravity => g * (1.0 + size),
            F::Decimals => decimals(2, g),
            _ => g,
        };
        let force = |theta: f64, omega: f64| match fault {
            F::Damping => -g * theta.sin() - size * omega,
            F::Quadratic => -g * theta.sin() - size * omega * omega.abs(),
            F::Torque => -g * theta.sin() + size,
            F::Cubic => -g * (theta.sin() + size * theta.sin().powi(3)),
            F::Table => -g * table_sine((1.0 / size) as usize + 16, theta),
            F::DeadBand if theta.abs() < size => 0.0,
            F::FastForce if omega.abs() > 3.0 * g.sqrt() => -g * (1.0 - size) * theta.sin(),
            F::FarForce if theta.abs() > 1000.0 => -g * (1.0 - size) * theta.sin(),
            F::ShortPi => {
                let turn = 2.0 * decimals(4, std::f64::consts::PI);
                -g * (theta - turn * (theta / turn).round()).sin()
            }
            F::Single => f64::from((-g * theta.sin()) as f32),
            _ => -g * theta.sin(),
        };
        let x = h * g.sqrt();
        let h = match fault {
            F::StepFactor => h * (1.0 + size),
            F::StepSingle => f64::from(h as f32),
            F::StepRounded => (h * 1e6).round() / 1e6,
            F::StepMost => h.clamp(-0.02, 0.02),
            F::StepLeast => h.abs().max(1e-3).copysign(h),
            F::StepSize => h.abs(),
            F::LongSteps if x.abs() > 1.2 => h / x.abs() * 1.2,
            _ => h,
        };
        let (mut quiet, mut k) = (0, 0_u64);
        let kept = if fault == F::Kept { 1e-3 * (count.get() % 7) as f64 } else { 0.0 };
        let states = steps(theta, omega, n, |z| {
            (k, quiet) = (k + 1, quiet);
            count.set(count.get() + 1);
            let part = match fault {
                F::FirstStep if k == 1 => return by_forward_euler(&force, z, h),
                F::Twice if k == 1 => 2.0,
                F::Late if k > 65_535 => return z,
                _ => 1.0,
            };
            let mut z = step(&force, z, part * h);
            match fault {
                F::Drag => z.1 *= 1.0 - size,
                F::Limit => z.1 = z.1.clamp(-8.0, 8.0),
                F::Sleep => {
                    quiet = if z.0.abs() < 0.05 && z.1.abs() < 0.01 { quiet + 1 } else { 0 };
                    z.1 = if quiet >= 30 { 0.0 } else { z.1 };
                }
                F::Adds => z.0 += std::f64::consts::PI,
                F::Kept => z.1 += kept * h,
                F::Random => z.1 += 1e-8 * random(count.get()),
                F::Noise => z.1 += 1e-10 * random(z.0.to_bits()),
                _ => {}
            }
            z
        });
        let mut all = vec![(theta, omega)];
        all.extend(states);
        let row = |k: usize| {
            let (z, before) = (all[k], all[k - 1]);
            match fault {
                F::RowsLate => all[k.saturating_sub(1 + (10.0 * size.sqrt()) as usize % 4)],
                F::OldVelocity => (z.0, before.1),
                F::OldAngle => (before.0, z.1),
                F::Mean => (0.5 * (z.0 + before.0), 0.5 * (z.1 + before.1)),
                F::Difference => (z.0, (z.0 - before.0) / h),
                F::Place => (z.0.sin(), z.1),
                F::TimesStep => (z.0, z.1 * h),
                F::Turns => (z.0 / std::f64::consts::TAU, z.1),
                _ => z,
            }
        };
        (1..all.len()).map(row).collect()
    }
}

fn wrong(random: &mut Random) -> Mutant {
    let step = STEPS[random.below(STEPS.len())];
    let fault = FAULTS[random.below(FAULTS.len())];
    // From a tenth to 10⁻⁹.
    let size = 10f64.powf(-1.0 - 8.0 * random.between(0.0, 1.0));
    Mutant { step, fault, size }
}

/// What came of the wrong ones: those that are let through, other names, and causes of others.
#[derive(Debug, Default)]
struct Wrong {
    through: Vec<String>,
    names: Vec<String>,
    causes: Vec<String>,
}

fn wrong_ones(count: u64, seed: u64) -> Wrong {
    let mut random = Random::new(seed);
    let mut wrong_ones = Wrong::default();
    for _ in 0..count {
        let mutant = wrong(&mut random);
        let counter = std::cell::Cell::new(0);
        let run = |g, theta, omega, h, n| mutant.run(&counter, g, theta, omega, h, n);
        let Mutant { step: (name, _, claims), fault, size } = mutant;
        let report = judge(&FromFn(run), claims.parse().expect("claims"));
        let what = format!("{name} {fault:?} {size:.0e}");
        if report.verdict == Verdict::Holds {
            wrong_ones.through.push(what.clone());
        }
        let identity = report.identity.as_ref();
        if let Some(known) = identity.filter(|known| known.is_plain() && known.method != name) {
            wrong_ones.names.push(format!("{what}: {known}"));
        }
        for line in &report.look_at() {
            let false_ones = CAUSES.iter().filter(|(_, of)| !of.contains(&fault));
            if false_ones.clone().any(|(words, _)| line.contains(words)) {
                wrong_ones.causes.push(format!("{what}: {line}"));
            }
        }
    }
    wrong_ones
}

/// Catches: a right program refused, misnamed or told a cause; a wrong one misnamed, or told the
/// cause of another.
#[test]
fn some_programs_of_each_are_judged_rightly() {
    let refused = right_ones(12, 1);
    assert!(refused.is_empty(), "{}", refused.join("\n"));
    let Wrong { names, causes, .. } = wrong_ones(20, 1);
    assert!(names.is_empty() && causes.is_empty(), "{}\n{}", names.join("\n"), causes.join("\n"));
}

/// A table of the sine with straight lines between its values, of which one lies beside the starts
/// along which the rounding of a step is measured: three of their third differences see a corner.
///
/// Catches: one corner taken for numbers of few digits.
#[test]
fn a_corner_is_not_told_for_few_digits() {
    let by_table = |theta: f64| {
        let place = (theta - 0.900_007) / 0.05;
        let at = |k: f64| (0.900_007 + 0.05 * k).sin();
        let part = place - place.floor();
        at(place.floor()) * (1.0 - part) + at(place.floor() + 1.0) * part
    };
    let program = FromFn(move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
        steps(theta, omega, n, |z| by_forward_euler(&|theta, _| -g * by_table(theta), z, h))
    });
    let report = judge(&program, Claims::order(1));
    let rounding = report.finding(Property::Precision).map(|it| it.values[0]);
    assert!(rounding.is_some_and(|it| it > 1e-9), "{report}");
    assert!(!report.look_at().iter().any(|line| line.contains("A step rounds")), "{report}");
}

/// How many of each are judged: `PENDULA_PROGRAMS=100` for fewer.
fn programs() -> u64 {
    std::env::var("PENDULA_PROGRAMS").ok().and_then(|text| text.parse().ok()).unwrap_or(1000)
}

/// A thousand of each, and what is let through.
///
/// Catches: what the few of the test beside it do not meet.
#[test]
#[ignore = "some ten minutes"]
fn a_thousand_of_each_are_judged_rightly() {
    // In tens, each from a seed of its own.
    let tens = programs() / 10;
    let mut refused = Vec::new();
    for seed in 0..tens {
        let some = right_ones(10, 1000 + seed);
        some.iter().for_each(|line| println!("refused: {line}"));
        refused.extend(some);
    }
    let mut all = Wrong::default();
    for seed in 0..tens {
        let Wrong { through, names, causes } = wrong_ones(10, 9000 + seed);
        for (title, lines) in [("through", &through), ("name", &names), ("cause", &causes)] {
            lines.iter().for_each(|line| println!("{title}: {line}"));
        }
        all.through.extend(through);
        all.names.extend(names);
        all.causes.extend(causes);
    }
    let [refused, names, causes] = [&refused, &all.names, &all.causes].map(Vec::len);
    println!(
        "of {} of each: {refused} right ones refused, misnamed or told a cause; of wrong ones {} \
        let through, {names} misnamed, {causes} told the cause of another",
        10 * tens,
        all.through.len()
    );
    assert_eq!([refused, names, causes], [0; 3]);
}

/// Yoshida's method of order 8, whose long steps round more than most, with six decimals.
///
/// Catches: what rounds coarsely taken for a term of lower order.
#[test]
fn few_decimals_tell_no_lower_order() {
    let method = Chosen::named("yoshida-8").expect("it is on the list");
    let format = Format::Decimals(6);
    for every in [None, Some(1)] {
        let integrator = Dressed { method, format, from: 0.0, every, ahead: true, alone: true };
        let report = judge(&integrator, Claims::order(8));
        assert!(!report.failures().any(|name| name == Property::Order), "{report}");
    }
}

/// DOP853 that prints twelve digits, with a drive.
///
/// Catches: slopes of what is hardly more than rounding, which tell no order, taken for times of
/// stages that are wrong.
#[test]
fn few_digits_tell_no_wrong_times() {
    for count in 10..=14 {
        let method = Chosen::named("dop853").expect("it is on the list");
        let format = Format::Digits(count);
        let integrator =
            Dressed { method, format, from: 0.0, every: None, ahead: false, alone: false };
        for claims in [Claims::order(8).name("dop853"), Claims::none().name("dop853")] {
            let report = judge(&integrator, claims);
            let refused = report.failures().filter(|name| *name != Property::Precision).count();
            assert_eq!(refused, 0, "{count}: {report}");
        }
        let report = judge(&integrator, Claims::order(8));
        let precision = report.finding(Property::Precision).expect("it is implied");
        assert!(precision.why().contains("significant digits") || count == 14, "{report}");
    }
}

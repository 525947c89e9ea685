//! What it really is: the step compared with those of the library's methods, at finite steps, to
//! the rounding.

use super::answers::{Match, Name};
use super::claims::Claims;
use super::equation::{Equation, Solver};
use super::probe::{G_OVER_L, Probe, distance, exact, frequency, pendulum, states_after, step};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Finding, Measurement};
use crate::integrator::Request;
use crate::known_answers::{self, Known};
use crate::properties::error_constant::extrapolated;
use pendula::systems::{Phase, Separable};
use pendula::{AnyMethod, METHODS, MethodInfo};

/// From where a method is seen: an integrator's states are those of the method, or lie a part of a
/// kick or a drift before them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Kicks ahead of the method's own states: half a kick makes symplectic Euler Störmer–Verlet.
    pub kicks: f64,
    /// Drifts ahead of them.
    pub drifts: f64,
}

impl Seen {
    pub(crate) const DIRECTLY: Self = Self { kicks: 0.0, drifts: 0.0 };

    pub(super) const ALL: [Self; 9] = [
        Self::DIRECTLY,
        Self { kicks: 0.5, drifts: 0.0 },
        Self { kicks: -0.5, drifts: 0.0 },
        Self { kicks: 1.0, drifts: 0.0 },
        Self { kicks: -1.0, drifts: 0.0 },
        Self { kicks: 0.0, drifts: 0.5 },
        Self { kicks: 0.0, drifts: -0.5 },
        Self { kicks: 0.0, drifts: 1.0 },
        Self { kicks: 0.0, drifts: -1.0 },
    ];

    /// All but [`Self::DIRECTLY`].
    pub(super) fn elsewhere() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|seen| *seen != Self::DIRECTLY)
    }

    /// The integrator's state for one of the method's own.
    pub fn from_its_own(self, g_over_l: f64, z: Phase, h: f64) -> Phase {
        let pendulum = pendulum(g_over_l);
        let z = pendulum.kick(z, pendulum.force(0.0, z), self.kicks * h);
        pendulum.drift(z, self.drifts * h)
    }

    /// The method's own state for a state of the integrator.
    pub fn into_its_own(self, g_over_l: f64, z: Phase, h: f64) -> Phase {
        Self { kicks: -self.kicks, drifts: -self.drifts }.from_its_own(g_over_l, z, h)
    }
}

/// A known method that an integrator is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Identity {
    /// The method's name on the command line, or that of the
    /// [known answers](crate::known_answers) if it is not of the library.
    pub method: &'static str,
    /// Its name in text.
    pub title: &'static str,
    /// From where it is seen.
    pub seen: Seen,
    /// Whether only the angles are the method's, and the velocities are not.
    pub angles_only: bool,
    /// The equation on which it is that method, if that is not the pendulum's.
    pub on: Option<Equation>,
    /// By how much a step differs at most (rad).
    pub apart: f64,
}

impl Identity {
    /// Whether the states are those of the method on the pendulum, from where it stands itself.
    pub fn is_plain(&self) -> bool {
        self.seen == Seen::DIRECTLY && !self.angles_only && self.on.is_none()
    }

    /// A method on another equation.
    pub(super) fn solving(solver: Solver, equation: Equation) -> Self {
        let Solver { name, title, apart } = solver;
        let on = Some(equation);
        Self { method: name, title, seen: Seen::DIRECTLY, angles_only: false, on, apart }
    }
}

/// The name on the command line, and that in text, of an entry of the file: what is in the library
/// has its names there.
pub fn names(known: &'static Known) -> (&'static str, &'static str) {
    let of_the_library = METHODS.iter().map(|method| method.info()).find(|info| {
        known_answers::method(info.name).is_some_and(|entry| entry.name == known.name)
    });
    match of_the_library {
        Some(info) => (info.name, info.title),
        None => (known.name.as_str(), known.also.first().unwrap_or(&known.name).as_str()),
    }
}

impl From<Match> for Identity {
    fn from(Match { known, apart, .. }: Match) -> Self {
        let (method, title) = names(known);
        Self { method, title, seen: Seen::DIRECTLY, angles_only: false, on: None, apart }
    }
}

/// From where the eight steps are compared.
const STARTS: [Phase; 3] = [
    Phase { theta: 1.0, omega: 0.7 },
    Phase { theta: -2.4, omega: 3.0 },
    Phase { theta: 0.3, omega: -6.0 },
];
/// x = ω₀h of the steps: the higher the order, the longer the step at which two methods differ.
const STEPS: [f64; 4] = [0.05, 0.3, 0.8, 1.1];
const COUNT: u64 = 8;

/// The states of a method of the library after 1, 2, … steps, as they are seen from there.
pub fn own_states(
    method: &dyn AnyMethod,
    seen: Seen,
    start: Phase,
    h: f64,
    count: u64,
) -> Option<Vec<Phase>> {
    let own = seen.into_its_own(G_OVER_L, start, h);
    let states = states_after(method, G_OVER_L, own, h, count)?;
    Some(states.into_iter().map(|z| seen.from_its_own(G_OVER_L, z, h)).collect())
}

/// The integrator's states in a few runs of eight steps, with which known methods are compared.
pub struct Asked {
    /// Start, step (s) and states, where it answers.
    runs: Vec<(Phase, f64, Vec<Phase>)>,
    /// What rounding, and a tolerance inside it, may make of them (rad).
    bound: f64,
}

impl Asked {
    /// Asks.
    pub fn of(probe: &Probe<'_>) -> Measured<Self> {
        let mut runs = Vec::new();
        for start in STARTS {
            for x in STEPS {
                match probe.states(Request::run(start, step(x), COUNT)) {
                    Ok(states) => runs.push((start, step(x), states)),
                    Err(Trouble::NoAnswer(_) | Trouble::NotFinite) if x > STEPS[0] => {}
                    Err(trouble) => return Err(trouble),
                }
            }
        }
        // Sixteen roundings a step of whoever rounds more coarsely, of an angle of up to 12 rad,
        // and neighbours that part by a factor of ten at most.
        let rounding = 10.0 * 12.0 * 16.0 * COUNT as f64 * probe.rounding / 8.0;
        // And what a tolerance inside the integrator may add; the long steps are as long as these.
        let tolerance = probe.bound(COUNT, 1.0) - probe.rounding_bound(COUNT, 1.0);
        let in_long_steps = 10.0 * COUNT as f64 * probe.in_long_steps();
        Ok(Self { runs, bound: rounding + 100.0 * tolerance + in_long_steps })
    }

    /// What rounding, and a tolerance inside it, may make of its states (rad).
    pub const fn bound(&self) -> f64 {
        self.bound
    }

    /// By how much its states differ from those of `method`, as `apart` measures it (rad); `None`
    /// if by more than the bound, or `at_least` if that is more. Where a method has no solution,
    /// nothing is compared.
    pub fn apart(
        &self,
        at_least: f64,
        apart: fn(Phase, Phase) -> f64,
        method: impl Fn(Phase, f64, u64) -> Option<Vec<Phase>>,
    ) -> Option<f64> {
        let (mut largest, mut compared) = (0.0_f64, false);
        for (start, h, states) in &self.runs {
            let own = method(*start, *h, COUNT)?;
            if own.iter().any(|z| z.theta.is_nan()) {
                continue;
            }
            compared = true;
            let off = own.iter().zip(states).map(|(own, z)| apart(*own, *z));
            largest = off.fold(largest, libm::fmaximum);
            if largest.is_nan() || largest > self.bound.max(at_least) {
                return None;
            }
        }
        compared.then_some(largest)
    }
}

/// A method of the library that an integrator may be, seen from elsewhere or by its angles alone.
type Candidate = (&'static dyn AnyMethod, Seen, f64);

/// The known method that the integrator is; else that of the library: seen directly, to what its
/// digits, or a tolerance inside it, allow, from half a kick or drift away, or by its angles alone;
/// and of several that of the order `shown`.
pub fn identify(probe: &Probe<'_>, name: &Name, shown: Option<u32>) -> Measured<Option<Identity>> {
    match name {
        Name::One(found) => return Ok(Some(Identity::from(*found))),
        // What agrees with several methods is not looked at from elsewhere.
        Name::OneOf(_) => return Ok(None),
        Name::None => {}
    }
    let asked = Asked::of(probe)?;
    let of_its_order = |method: &&dyn AnyMethod| Some(method.info().order) == shown;
    let (first, then): (Vec<_>, Vec<_>) = METHODS.iter().copied().partition(of_its_order);
    let methods: Vec<&'static dyn AnyMethod> = first.into_iter().chain(then).collect();
    for angles_only in [false, true] {
        let Some((method, seen, apart)) = seen(&asked, &methods, angles_only) else { continue };
        let MethodInfo { name, title, .. } = method.info();
        let identity = Identity { method: name, title, seen, angles_only, on: None, apart };
        return Ok(Some(identity));
    }
    Ok(None)
}

/// The first of `methods` whose states, as they are or seen from elsewhere, are the integrator's;
/// none if another one's lie within ten times that. What is one map with a method as it is, is that
/// method, unless that is excluded by more than rounding.
fn seen(asked: &Asked, methods: &[&'static dyn AnyMethod], angles_only: bool) -> Option<Candidate> {
    let angle = |a: Phase, b: Phase| (a.theta - b.theta).abs();
    let apart = if angles_only { angle } else { distance };
    // The angles do not show a kick at the end, and a drift is no other method's angle.
    let seen_from = |seen: &Seen| !angles_only || seen.drifts == 0.0;
    let mut near: Vec<Candidate> = Vec::new();
    for seen in Seen::ALL.into_iter().filter(seen_from) {
        for method in methods {
            let own = |start, h, count| own_states(*method, seen, start, h, count);
            let off = asked.apart(10.0 * asked.bound(), apart, own);
            near.extend(off.map(|off| (*method, seen, off)));
        }
    }
    let first = *near.iter().find(|(.., off)| *off <= asked.bound())?;
    let best = near.iter().map(|(.., off)| *off).fold(f64::INFINITY, f64::min);
    let room = (10.0 * best).max(asked.bound());
    // Two that are one map, as a method and its conjugate, are one.
    let same = |other: &Candidate| {
        asked.runs.iter().all(|(start, h, _)| {
            let [a, b] = [first, *other]
                .map(|(method, seen, _)| own_states(method, seen, *start, *h, COUNT));
            let (Some(a), Some(b)) = (a, b) else { return false };
            let off = a.iter().zip(&b).map(|(a, b)| apart(*a, *b)).filter(|off| !off.is_nan());
            off.fold(0.0, f64::max) <= SAME
        })
    };
    let alone = near.iter().filter(|(.., off)| *off <= room).all(same);
    let plain = near.iter().find(|it| it.1 == Seen::DIRECTLY && same(it));
    alone.then_some(*plain.unwrap_or(&first))
}

/// By how much the states of one map, computed in two ways in double precision, may differ in eight
/// steps (rad).
const SAME: f64 = 1e-11;

/// What is to be said of a claim to be the method `name`.
pub fn judge(name: &Name, identity: Option<&Identity>, claims: &Claims) -> Finding {
    if let Name::OneOf(those) = name {
        return one_of(those, claims);
    }
    let (verdict, measurement) = match identity {
        Some(identity) => {
            let right = identity.is_plain() && claims.is_named(identity.method);
            let verdict = if right { Verdict::Holds } else { Verdict::Fails };
            (verdict, Measurement::Is(Box::new(identity.clone())))
        }
        None => (Verdict::Fails, Measurement::NoKnownMethod),
    };
    let values = identity.map(|identity| identity.apart).into_iter().collect();
    Finding { measurement, values, unit: "rad", verdict, ..Finding::default() }
}

/// The names of the methods that it may be.
pub fn may_be(those: &[Match]) -> Vec<&'static str> {
    those.iter().map(|found| found.known.name.as_str()).collect()
}

fn one_of(those: &[Match], claims: &Claims) -> Finding {
    let claimed = those.iter().any(|found| claims.is_named(&found.known.name));
    let verdict = if claimed { Verdict::Unclear } else { Verdict::Fails };
    let measurement = Measurement::OneOf(may_be(those));
    let values = those.first().map(|found| found.apart).into_iter().collect();
    Finding { measurement, values, unit: "rad", verdict, ..Finding::default() }
}

/// The leading error of a step at (1 rad, 1 ω₀) over h^(order + 1), in θ and in ω/ω₀ with h in
/// units of 1/ω₀: by a short step, extrapolated with a half and a quarter of it.
pub fn leading_error(probe: &Probe<'_>, order: u32) -> Measured<[f64; 2]> {
    let start = Phase { theta: 1.0, omega: frequency() };
    let truth = exact(G_OVER_L, start);
    // A coefficient of the error is about 1/(order + 1)!, as in a Taylor series, or some tens of
    // times less. So long a step that rounding is a thirty-thousandth of that at the quarter.
    let power = f64::from(order + 1);
    let factorial: f64 = (1..=order + 1).map(f64::from).product();
    let quarter = libm::pow(3e4 * factorial * probe.rounding, 1.0 / power);
    let x = (4.0 * quarter).clamp(0.02, 0.6);
    let error = |x: f64| -> Measured<[f64; 2]> {
        let h = step(x);
        let (z, true_z) = (probe.end(Request::run(start, h, 1))?, truth.at(h));
        let over = libm::pow(x, power);
        Ok([(z.theta - true_z.theta) / over, (z.omega - true_z.omega) / frequency() / over])
    };
    let errors = [error(x)?, error(0.5 * x)?, error(0.25 * x)?];
    // Of another power, as a first step of its own may be, it is no constant.
    let size = |error: [f64; 2]| error[0].abs().max(error[1].abs());
    if !(0.5..2.0).contains(&(size(errors[2]) / size(errors[1]))) {
        return Err(Trouble::NoAnswer(format!("the error of a step goes not with x^{power}")));
    }
    Ok([0, 1].map(|i| extrapolated(errors.map(|error| error[i]))))
}

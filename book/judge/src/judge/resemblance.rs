//! What an integrator nearly is: a known method, right or wrong, but for one thing.

use super::claims::Claims;
use super::equation::Departure;
use super::identity::{Asked, Identity, Seen, own_states};
use super::probe::{G_OVER_L, Probe, distance, exact, states_after, step};
use super::report::Report;
use super::verdict::Measured;
use crate::integrator::Request;
use pendula::systems::Phase;
use pendula::{AnyMethod, METHODS};

/// A known method that a program is but for one thing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Resemblance {
    /// The method's name on the command line.
    pub method: &'static str,
    /// Its name in text.
    pub title: &'static str,
    /// The one thing.
    pub but: But,
}

/// The one thing in which a run differs from that of a known method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum But {
    /// Nothing.
    Nothing,
    /// It is seen from elsewhere, at the start as at the end: half a kick behind, and the like.
    Seen(Seen),
    /// Its states are reported from elsewhere, and it starts where it is told.
    Reported(Seen),
    /// It starts elsewhere than it is told, and reports the states that it has.
    Begun(Seen),
    /// Each step lacks its first half kick.
    WithoutFirstHalfKick,
    /// Each step lacks its last half kick.
    WithoutLastHalfKick,
}

/// Every one thing.
fn every() -> Vec<But> {
    let mut all: Vec<But> = Seen::elsewhere().map(But::Seen).collect();
    all.extend(Seen::elsewhere().map(But::Reported));
    all.extend(Seen::elsewhere().map(But::Begun));
    all.extend([But::WithoutFirstHalfKick, But::WithoutLastHalfKick]);
    all
}

/// The states of a known method after 1, 2, … `count` steps, but for one thing; none if it has
/// none.
fn states(
    method: &dyn AnyMethod,
    but: But,
    start: Phase,
    h: f64,
    count: u64,
) -> Option<Vec<Phase>> {
    let run = |g_over_l, start, h, count| states_after(method, g_over_l, start, h, count);
    match but {
        But::Nothing => run(G_OVER_L, start, h, count),
        But::Seen(seen) => own_states(method, seen, start, h, count),
        But::Reported(seen) => {
            let states = run(G_OVER_L, start, h, count)?.into_iter();
            Some(states.map(|z| seen.from_its_own(G_OVER_L, z, h)).collect())
        }
        But::Begun(seen) => run(G_OVER_L, seen.from_its_own(G_OVER_L, start, h), h, count),
        But::WithoutFirstHalfKick | But::WithoutLastHalfKick => {
            let first = but == But::WithoutFirstHalfKick;
            let back = Seen { kicks: -0.5, drifts: 0.0 };
            let kicked_back = |z: Phase| back.from_its_own(G_OVER_L, z, h);
            let mut z = start;
            (0..count)
                .map(|_| {
                    let before = if first { kicked_back(z) } else { z };
                    let after = *run(G_OVER_L, before, h, 1)?.last()?;
                    z = if first { after } else { kicked_back(after) };
                    Some(z)
                })
                .collect()
        }
    }
}

/// Whether the entry of a method has what is claimed.
fn fits(method: &dyn AnyMethod, claims: &Claims) -> bool {
    let entry = method.info();
    claims.order.is_none_or(|order| order <= entry.order)
        && (!claims.symplectic || entry.symplectic)
        && (!claims.symmetric || entry.symmetric)
        && (claims.name.is_none() || claims.is_named(entry.name))
}

/// What the integrator is but for one thing: first a method of the library that has what is
/// claimed, then any other. Of several that are near, none is named unless the digits of double
/// precision tell that they are one map.
pub fn find(probe: &Probe<'_>, claims: &Claims, report: &Report) -> Measured<Option<Resemblance>> {
    let plain = report.identity.as_ref().filter(|identity| identity.is_plain());
    let is_itself = |identity: &Identity| {
        METHODS.iter().any(|method| method.info().name == identity.method && fits(*method, claims))
    };
    if plain.is_some_and(is_itself) {
        return Ok(None);
    }
    let asked = Asked::of(probe)?;
    let every = every();
    let (fitting, others): (Vec<_>, Vec<_>) =
        METHODS.iter().copied().partition(|method| fits(*method, claims));
    let told_apart = probe.rounding < 1e-12;
    let resembling = |methods: &[&dyn AnyMethod]| {
        let pairs = every.iter().flat_map(|but| methods.iter().map(move |method| (*but, *method)));
        let near = |room: f64, but: But, method: &dyn AnyMethod| {
            let own = |start, h, count| states(method, but, start, h, count);
            asked.apart(room, distance, own).is_some()
        };
        let mut those = pairs.filter(|(but, method)| near(0.0, *but, *method));
        let (but, method) = those.next()?;
        let alone = told_apart || {
            let every = || [But::Nothing].into_iter().chain(every.iter().copied());
            let all = METHODS.iter().flat_map(|other| every().map(move |but| (but, *other)));
            let mut near = all.filter(|(but, other)| near(10.0 * asked.bound(), *but, *other));
            near.all(|(_, other)| other.info().name == method.info().name)
        };
        let info = method.info();
        alone.then_some(Resemblance { method: info.name, title: info.title, but })
    };
    // What is on the list has its name already; there only the method that is claimed helps.
    let anything_fits = claims.order.is_some() || claims.name.is_some();
    let fitting = if anything_fits { fitting } else { Vec::new() };
    if report.identity.is_some() {
        return Ok(resembling(&fitting));
    }
    Ok(resembling(&fitting).or_else(|| resembling(&others)))
}

/// A method of the library, and by how much a short step parts from its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Nearest {
    /// Its name in text.
    pub title: &'static str,
    /// The distance (rad) over x to the power `power`, with x = ω₀h.
    pub factor: f64,
    /// The power.
    pub power: u32,
}

/// The method of the library from which a short step parts least, and by how much; `None` if no
/// method is near.
pub fn nearest(probe: &Probe<'_>) -> Measured<Option<Nearest>> {
    const STARTS: [Phase; 3] = [
        Phase { theta: 1.0, omega: 1.5 },
        Phase { theta: -2.2, omega: 0.8 },
        Phase { theta: 0.4, omega: -4.0 },
    ];
    // So long that rounding is small beside what most methods part by, so short that the leading
    // power shows.
    const X: [f64; 2] = [0.1, 0.05];
    let mut ends = [[Phase::default(); 3]; 2];
    for (row, x) in ends.iter_mut().zip(X) {
        for (end, start) in row.iter_mut().zip(STARTS) {
            *end = probe.end(Request::run(start, step(x), 1))?;
        }
    }
    let apart = |method: &dyn AnyMethod, row: usize| -> Option<f64> {
        let mut largest = 0.0;
        for (end, start) in ends[row].iter().zip(STARTS) {
            let own = states(method, But::Nothing, start, step(X[row]), 1)?;
            largest = libm::fmaximum(largest, distance(*end, own[0]));
        }
        Some(largest)
    };
    let all = METHODS.iter().filter_map(|method| {
        let [long, short] = [apart(*method, 0)?, apart(*method, 1)?];
        (short > 30.0 * probe.rounding).then_some((method.info().title, long, short))
    });
    let Some((title, long, short)) = all.min_by(|a, b| a.2.total_cmp(&b.2)) else {
        return Ok(None);
    };
    let power = libm::round(libm::log2(long / short));
    if !(1.0..=9.0).contains(&power) || short > 0.01 {
        return Ok(None);
    }
    // It says something only where the step parts from it later than from the exact motion.
    let from_the_motion = [0, 1].map(|row| {
        let apart = ends[row]
            .iter()
            .zip(STARTS)
            .map(|(end, start)| distance(*end, exact(G_OVER_L, start).at(step(X[row]))));
        apart.fold(0.0, libm::fmaximum)
    });
    let wrong_from = libm::round(libm::log2(from_the_motion[0] / from_the_motion[1]));
    if power <= wrong_from {
        return Ok(None);
    }
    let factor = short / libm::pow(X[1], power);
    Ok(Some(Nearest { title, factor, power: power as u32 }))
}

// -------------------------------------------------------------------------------------------------
// Another step or another equation
// -------------------------------------------------------------------------------------------------

/// A step that goes another distance, or solves another equation, than is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scaled {
    /// The step is this many times as long.
    Step(f64),
    /// g/L is this many times as large.
    Gravity(f64),
    /// g/L is this (1/s²), whatever is asked for.
    Fixed(f64),
}

impl Scaled {
    /// Of a departure that is no more than that.
    pub fn of(departure: &Departure) -> Option<Self> {
        let value = departure.values().first().copied();
        match departure {
            Departure::Step { times, .. } => Some(Self::Step(*times)),
            Departure::Gravity(_) => value.map(Self::Gravity),
            Departure::FixedGravity(_) => value.map(Self::Fixed),
            _ => None,
        }
    }
}

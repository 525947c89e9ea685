//! Integrators that answer with any numbers.

use std::cell::RefCell;

use pendula::{Phase, StormerVerlet};
use pendula_judge::{Claims, Fault, Integrator, Reply, Request, try_judge};

use crate::common::Random;

/// An integrator that answers with garbage: any states, as many as asked for or not; or with those
/// of a method, now and then spoilt.
struct Garbage {
    random: RefCell<Random>,
    spoils: usize,
    counts: bool,
}

fn phase(any: &mut Random) -> Phase {
    Phase { theta: any.number(), omega: any.number() }
}

fn phases(any: &mut Random, count: usize) -> Vec<Phase> {
    (0..count).map(|_| phase(any)).collect()
}

impl Integrator for Garbage {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let mut any = self.random.borrow().clone();
        self.random.borrow_mut().bits();
        let evaluations = self.counts.then(|| any.bits() >> any.below(64));
        let states = request.states() as usize;
        if self.spoils > 0 {
            let mut reply = StormerVerlet.answer(request)?;
            if any.below(self.spoils) == 0 && states > 0 {
                let at = any.below(states);
                reply.states[at] = phase(&mut any);
            }
            return Ok(reply);
        }
        match any.below(60) {
            0 => Err(Fault::Unsupported),
            1 => Err(Fault::Refused("no".to_string())),
            2 => Err(Fault::Broken("nonsense".to_string())),
            3 => Ok(Reply { states: vec![], evaluations }),
            4 => Ok(Reply { states: phases(&mut any, states + 1), evaluations }),
            _ => Ok(Reply { states: phases(&mut any, states), evaluations }),
        }
    }

    fn longest_run(&self) -> u64 {
        2000
    }
}

/// Twenty integrators, each with claims of any order.
///
/// Catches: a panic or a loop without an end at numbers that no method returns; a report that
/// cannot be written out, a fault without a word.
#[test]
fn garbage_is_judged_or_refused() {
    let mut any = Random::new(7);
    let (mut judged, mut refused) = (0, 0);
    for integrator in 0..20 {
        let garbage = Garbage {
            random: RefCell::new(Random::new(any.bits())),
            spoils: any.one_of(&[0, 0, 3, 30]),
            counts: any.below(2) == 0,
        };
        let claims = Claims::order(any.below(20) as u32).symplectic().symmetric();
        match try_judge(&garbage, claims) {
            Ok(report) => {
                judged += 1;
                assert!(!report.to_string().is_empty() && !report.findings.is_empty());
            }
            Err(fault) => {
                refused += 1;
                assert!(!fault.to_string().is_empty(), "{integrator}");
            }
        }
    }
    assert!(judged > 3 && refused > 3, "{judged} {refused}");
}

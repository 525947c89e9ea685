//! The judge, of strangers that answer anything.

use pendula::methods::StormerVerlet;
use pendula::verify::{Claims, Fault, Reply, Request, Stranger, try_judge};

use super::*;
use crate::random::Random;

/// A stranger that answers with garbage: any states, as many as asked for or not; or with those of
/// a method, now and then spoilt.
struct Garbage {
    random: std::cell::RefCell<Random>,
    spoils: usize,
    counts: bool,
}

impl Stranger for Garbage {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let mut any = Any(self.random.borrow_mut().clone());
        self.random.borrow_mut().bits();
        let evaluations = self.counts.then(|| any.0.bits() >> any.0.below(64));
        let states = request.states() as usize;
        if self.spoils > 0 {
            let mut reply = StormerVerlet.answer(request)?;
            if any.0.below(self.spoils) == 0 && states > 0 {
                let at = any.0.below(states);
                reply.states[at] = any.phase();
            }
            return Ok(reply);
        }
        match any.0.below(60) {
            0 => Err(Fault::Unsupported),
            1 => Err(Fault::Refused("no".to_string())),
            2 => Err(Fault::Broken("nonsense".to_string())),
            3 => Ok(Reply { states: vec![], evaluations }),
            4 => Ok(Reply { states: any.phases(states + 1), evaluations }),
            _ => Ok(Reply { states: any.phases(states), evaluations }),
        }
    }

    fn longest_run(&self) -> u64 {
        2000
    }
}

pub fn a_stranger(any: &mut Any, tally: &mut Tally) {
    let garbage = Garbage {
        random: std::cell::RefCell::new(any.0.clone()),
        spoils: any.0.one_of(&[0, 0, 3, 30]),
        counts: any.0.below(2) == 0,
    };
    let claims = Claims::order(any.0.below(20) as u32).symplectic().symmetric();
    match try_judge(&garbage, &claims) {
        Ok(report) => {
            tally.computed += 1;
            // It is written out, whatever was measured.
            assert!(!report.to_string().is_empty() && !report.findings.is_empty());
        }
        Err(fault) => {
            tally.refused += 1;
            assert!(!fault.is_empty());
        }
    }
}

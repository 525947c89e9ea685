//! Impostors of the processed methods: their kernels or processors with something changed or left
//! out.

use crate::properties::conjugacy::{Kernel, PROCESSED_4, PROCESSED_6};
use pendula::arithmetic::sine::{cos, sin};
use pendula::methods::{Processed4, Processed6};
use pendula::{Counting, Info, Method, MethodInfo, Pendulum, Phase, Separable};

/// A kernel between its processor undone and done.
#[derive(Clone, Copy)]
pub struct Processed<M> {
    /// The method that it poses as.
    pub truth: M,
    /// The kernel and its processor, with what is wrong in it.
    pub kernel: Kernel,
    /// Whether the change of variables is its first term in either direction, in place of an
    /// inverse.
    pub first_term: bool,
}

/// The method of order 4 with nothing wrong.
pub const RIGHT_4: Processed<Processed4> =
    Processed { truth: Processed4, kernel: PROCESSED_4, first_term: false };

/// The method of order 6 with nothing wrong.
pub const RIGHT_6: Processed<Processed6> =
    Processed { truth: Processed6, kernel: PROCESSED_6, first_term: false };

/// The kernel alone: its states are seen as they are.
pub const ALONE: Processed<Processed4> =
    Processed { kernel: Kernel { processor: [0.0; 3], ..PROCESSED_4 }, ..RIGHT_4 };

/// The potential V − (h²/24) V'² taken for its force.
pub const HALF_THE_GRADIENT: Processed<Processed4> = Processed {
    kernel: Kernel { kicks: &[(0.0, 0.0), (1.0, 1.0 / 24.0), (0.0, 0.0)], ..PROCESSED_4 },
    ..RIGHT_4
};

/// θ ∓ (h²/24) V' and ω (1 ± (h²/24) V'') in either direction, which is as good to the fourth power
/// of h.
pub const FIRST_TERM: Processed<Processed4> = Processed { first_term: true, ..RIGHT_4 };

/// The processor of order 6 without its terms in h⁴.
pub const SECOND_POWER: Processed<Processed6> = Processed {
    kernel: Kernel { processor: [PROCESSED_6.processor[0], 0.0, 0.0], ..PROCESSED_6 },
    ..RIGHT_6
};

/// The gradient's coefficient, rounded to five digits.
pub const FIVE_DIGITS: Processed<Processed6> = Processed {
    kernel: Kernel {
        kicks: &[
            (PROCESSED_6.kicks[0].0, 0.068_945),
            PROCESSED_6.kicks[1],
            PROCESSED_6.kicks[2],
            (PROCESSED_6.kicks[3].0, 0.068_945),
        ],
        ..PROCESSED_6
    },
    ..RIGHT_6
};

impl<M> Processed<M> {
    /// The linear part λx² of the processor's V' and V'' at `z`.
    fn term(&self, pendulum: &Pendulum, z: Phase, h: f64) -> (f64, f64) {
        let linear = self.kernel.processor[0] * pendulum.frequency_squared() * h * h;
        (linear * sin(z.theta), linear * cos(z.theta))
    }

    fn unprocessed(&self, pendulum: &Pendulum, z: Phase, h: f64) -> Phase {
        if !self.first_term {
            return self.kernel.unprocessed(pendulum, z, h);
        }
        let (shift, stretch) = self.term(pendulum, z, h);
        Phase { theta: z.theta - shift, omega: z.omega * (1.0 + stretch) }
    }

    fn processed(&self, pendulum: &Pendulum, z: Phase, h: f64) -> Phase {
        if !self.first_term {
            return self.kernel.processed(pendulum, z, h);
        }
        let (shift, stretch) = self.term(pendulum, z, h);
        Phase { theta: z.theta + shift, omega: z.omega * (1.0 - stretch) }
    }
}

impl<M: Info> Info for Processed<M> {
    fn info(&self) -> MethodInfo {
        self.truth.info()
    }
}

impl<M: Info> Method<Counting<Pendulum>> for Processed<M> {
    /// The state inside the change of variables.
    type Carry = Phase;

    fn start(&self, pendulum: &Counting<Pendulum>, t: f64, h: f64, z: Phase) -> Phase {
        count(pendulum, self.info().start_evaluations, t, z);
        self.unprocessed(pendulum.system(), z, h)
    }

    fn step(
        &self,
        pendulum: &Counting<Pendulum>,
        t: f64,
        h: f64,
        z: Phase,
        inside: &mut Phase,
    ) -> Phase {
        count(pendulum, self.info().force_evaluations, t, z);
        *inside = self.kernel.step(pendulum.system(), *inside, h);
        self.processed(pendulum.system(), *inside, h)
    }
}

/// Counts as many evaluations as the method that it poses as has.
fn count(pendulum: &Counting<Pendulum>, evaluations: u64, t: f64, z: Phase) {
    for _ in 0..evaluations {
        pendulum.force(t, z);
    }
}

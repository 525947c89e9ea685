//! States and what a step carries to the next, as numbers and back again with the same bits.

use pendula::internals::{Deferred, Number, ReducedPhase, ReducedRate};
use pendula::methods::splitting::Rotating;

use crate::trace::Traced;

/// What can be taken apart into numbers and put together again.
pub trait Numbers<N = f64>: Copy {
    /// Passes its numbers to `write`, one after the other.
    fn write(self, write: &mut impl FnMut(N));

    /// Puts it together from the numbers that [`write`](Numbers::write) passed on, in their order.
    fn read(next: &mut impl FnMut() -> N) -> Self;
}

impl<N> Numbers<N> for () {
    fn write(self, _write: &mut impl FnMut(N)) {}

    fn read(_next: &mut impl FnMut() -> N) -> Self {}
}

macro_rules! number {
    ($($Number:ty)+) => {
        $(impl Numbers<$Number> for $Number {
            fn write(self, write: &mut impl FnMut(Self)) {
                write(self);
            }

            fn read(next: &mut impl FnMut() -> Self) -> Self {
                next()
            }
        })+
    };
}
number!(f64 Traced);

impl<N: Number> Numbers<N> for Deferred<N> {
    fn write(self, write: &mut impl FnMut(N)) {
        let Self { sum, factor, series } = self;
        [sum, factor, series].into_iter().for_each(write);
    }

    fn read(next: &mut impl FnMut() -> N) -> Self {
        Self { sum: next(), factor: next(), series: next() }
    }
}

impl<N: Number> Numbers<N> for ReducedPhase<N> {
    fn write(self, write: &mut impl FnMut(N)) {
        write(self.rest);
        write(self.turns);
        self.velocity.write(write);
    }

    fn read(next: &mut impl FnMut() -> N) -> Self {
        Self { rest: next(), turns: next(), velocity: Deferred::read(next) }
    }
}

impl<N: Number> Numbers<N> for ReducedRate<N> {
    fn write(self, write: &mut impl FnMut(N)) {
        self.angle.write(write);
        self.velocity.write(write);
    }

    fn read(next: &mut impl FnMut() -> N) -> Self {
        Self { angle: Deferred::read(next), velocity: Deferred::read(next) }
    }
}

impl<N: Copy, Z: Numbers<N>> Numbers<N> for Rotating<Z, N> {
    fn write(self, write: &mut impl FnMut(N)) {
        self.ahead.write(write);
        write(self.kick);
    }

    fn read(next: &mut impl FnMut() -> N) -> Self {
        Self { ahead: Z::read(next), kick: next() }
    }
}

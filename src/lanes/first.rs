//! The first few of the numbers in a register.

use super::{EIGHT, Lanes, Number};

/// The first `count` numbers, none of which is below 0, and 0 in place of those after them.
#[inline(always)]
pub(crate) fn first_of<L: Lanes>(lanes: L, count: usize, numbers: L::F) -> L::F {
    up_to(lanes, count, numbers, const { &bounds(0.0) })
}

/// The first `count` numbers, and what none is below in place of those after them.
#[inline(always)]
pub(crate) fn first_below_any<L: Lanes>(lanes: L, count: usize, numbers: L::F) -> L::F {
    up_to(lanes, count, numbers, const { &bounds(f32::NEG_INFINITY) })
}

/// Which of a register's numbers are looked at: the first so many. The others may be anything, also no numbers.
#[derive(Clone, Copy)]
pub(crate) struct First<F>(F);

impl<F: Number> First<F> {
    #[inline(always)]
    pub(crate) fn of<L: Lanes<F = F>>(lanes: L, count: usize) -> Self {
        let bounds = const { &bounds(f32::NEG_INFINITY) };
        Self(lanes.load(&bounds[EIGHT - count.min(EIGHT)..]))
    }

    /// They, and what none is below in place of the others.
    #[inline(always)]
    pub(crate) fn below_any(self, numbers: F) -> F {
        let zero = numbers.like(0.0);
        self.0.if_above(zero, numbers, self.0)
    }

    /// They, and what none is above in place of the others.
    #[inline(always)]
    pub(crate) fn above_any(self, numbers: F) -> F {
        let zero = numbers.like(0.0);
        self.0.if_above(zero, numbers, -self.0)
    }
}

/// Any number's bound as often as there are lanes, then another one's.
const fn bounds(last: f32) -> [f32; 2 * EIGHT] {
    let any = f32::INFINITY;
    [
        any, any, any, any, any, any, any, any, last, last, last, last, last, last, last, last,
    ]
}

#[inline(always)]
fn up_to<L: Lanes>(lanes: L, count: usize, numbers: L::F, bounds: &[f32; 2 * EIGHT]) -> L::F {
    if count >= L::WIDTH {
        return numbers;
    }
    numbers.min(lanes.load(&bounds[EIGHT - count.min(EIGHT)..]))
}

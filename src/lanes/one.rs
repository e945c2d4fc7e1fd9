//! Numbers one by one.

use super::{Lanes, Number};
use glam::Vec2;

/// One by one.
#[derive(Clone, Copy)]
pub(crate) struct One;

impl One {
    #[inline(always)]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast saturates"
    )]
    fn whole(self, number: f32) -> u16 {
        number as u16
    }
}

impl Lanes for One {
    type F = f32;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn all(self, value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn load(self, values: &[f32]) -> f32 {
        values[0]
    }

    #[inline(always)]
    fn load_whole(self, values: &[u16]) -> f32 {
        f32::from(values[0])
    }

    #[inline(always)]
    fn load_pairs(self, pairs: &[Vec2]) -> [f32; 2] {
        pairs[0].to_array()
    }

    #[inline(always)]
    fn above(self, number: f32, other: f32) -> u32 {
        u32::from(number > other)
    }

    #[inline(always)]
    fn least_from(self, numbers: f32) -> f32 {
        numbers
    }

    #[inline(always)]
    fn most_up_to(self, numbers: f32) -> f32 {
        numbers
    }

    #[inline(always)]
    fn store(self, numbers: f32, values: &mut [f32]) {
        values[0] = numbers;
    }

    #[inline(always)]
    fn store_whole(self, number: f32, values: &mut [u16]) {
        values[0] = self.whole(number);
    }

    #[inline(always)]
    fn made(self, mut of: impl FnMut(usize) -> f32) -> f32 {
        of(0)
    }

    #[inline(always)]
    fn of_three(self, a: [f32; 3], b: [f32; 3], of: impl Fn(f32, f32) -> f32) -> [f32; 3] {
        [of(a[0], b[0]), of(a[1], b[1]), of(a[2], b[2])]
    }

    #[inline(always)]
    fn call<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }
}

impl Number for f32 {
    #[inline(always)]
    fn like(self, value: Self) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn times_plus(self, by: Self, plus: Self) -> Self {
        self * by + plus
    }

    #[inline(always)]
    fn if_above(self, least: Self, then: Self, otherwise: Self) -> Self {
        if self > least { then } else { otherwise }
    }

    #[inline(always)]
    fn any(self) -> bool {
        self > 0.0
    }

    #[inline(always)]
    fn each(self, mut of: impl FnMut(usize, Self) -> Self) -> Self {
        of(0, self)
    }

    #[inline(always)]
    fn lane(self, _: usize) -> Self {
        self
    }

    #[inline(always)]
    fn sum(self) -> Self {
        self
    }

    #[inline(always)]
    fn least(self) -> Self {
        self
    }

    #[inline(always)]
    fn cut_off(self) -> Self {
        Self::from(One.whole(self))
    }
}

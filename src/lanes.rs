//! Numbers side by side: what is done to zones and lights is written once, for one number or for a register of eight.
//!
//! Which of the two runs is decided at run time, by what the processor has. Both do the same operations in the same order
//! for each number, so that they agree to rounding.

mod first;
mod one;
mod vector;

use core::ops::{Add, Div, Mul, Neg, Sub};
use core::sync::atomic::{AtomicBool, Ordering};
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, u16x8};
pub(crate) use first::{First, first_below_any, first_of};
use glam::Vec2;
pub(crate) use one::One;
pub(crate) use vector::Vector;

/// Whether registers of eight may be used at all.
static ALLOWED: AtomicBool = AtomicBool::new(true);

/// Numbers in a register.
const EIGHT: usize = 8;

/// Lets all threads use SIMD instructions where the processor has them (so it is at the start), or keeps them from it: to
/// measure and compare. Results agree within 1e-5.
pub fn set_simd(allowed: bool) {
    ALLOWED.store(allowed, Ordering::Relaxed);
}

/// What the processor has, unless it may not be used. Detected once; the first call may take microseconds.
pub(crate) fn level() -> Option<Level> {
    ALLOWED.load(Ordering::Relaxed).then(Level::new)
}

/// One number, or eight of them.
pub(crate) trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
    + Div<f32, Output = Self>
{
    /// The same number in each place.
    fn like(self, value: f32) -> Self;
    fn sqrt(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// `self * by + plus`: in a register one step, rounded once.
    fn times_plus(self, by: Self, plus: Self) -> Self;
    /// `then` where it is above `least`, else `otherwise`.
    fn if_above(self, least: Self, then: Self, otherwise: Self) -> Self;
    /// Whether any is above 0.
    fn any(self) -> bool;
    /// Each by itself, with its number.
    fn each(self, of: impl FnMut(usize, f32) -> f32) -> Self;
    fn lane(self, lane: usize) -> f32;
    fn sum(self) -> f32;
    fn least(self) -> f32;
    /// Without what is behind the point: of shares up to 65535.
    fn cut_off(self) -> Self;
}

impl<S: Simd> Number for f32x8<S> {
    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self::splat(self.token(), value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        SimdBase::min(self, other)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        SimdBase::max(self, other)
    }

    #[inline(always)]
    fn times_plus(self, by: Self, plus: Self) -> Self {
        SimdFloat::mul_add(self, by, plus)
    }

    #[inline(always)]
    fn if_above(self, least: Self, then: Self, otherwise: Self) -> Self {
        self.simd_gt(least).select(then, otherwise)
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.simd_gt(0.0).any_true()
    }

    #[inline(always)]
    fn each(self, mut of: impl FnMut(usize, f32) -> f32) -> Self {
        Self::from_fn(self.token(), |i| of(i, self[i]))
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f32 {
        self[lane]
    }

    #[inline(always)]
    fn sum(self) -> f32 {
        let (low, high) = self.split();
        let [a, b, c, d] = (low + high).to_array();
        (a + c) + (b + d)
    }

    #[inline(always)]
    fn least(self) -> f32 {
        let (low, high) = self.split();
        let [a, b, c, d] = SimdBase::min(low, high).to_array();
        Number::min(Number::min(a, c), Number::min(b, d))
    }

    #[inline(always)]
    fn cut_off(self) -> Self {
        SimdFloat::trunc(self)
    }
}

/// How many numbers are looked at together, and how they are made.
pub(crate) trait Lanes: Copy {
    type F: Number;
    const WIDTH: usize;

    /// The same number in each place.
    fn all(self, value: f32) -> Self::F;
    /// [`Self::WIDTH`] numbers from the first of `values` on.
    fn load(self, values: &[f32]) -> Self::F;
    /// The same of whole numbers.
    fn load_whole(self, values: &[u16]) -> Self::F;
    /// The same of pairs: their first and their second ones.
    fn load_pairs(self, pairs: &[Vec2]) -> [Self::F; 2];
    /// Which numbers are above others: a bit for each.
    fn above(self, numbers: Self::F, others: Self::F) -> u32;
    /// In each place the least from there on.
    fn least_from(self, numbers: Self::F) -> Self::F;
    /// In each place the most up to there.
    fn most_up_to(self, numbers: Self::F) -> Self::F;
    /// Writes [`Self::WIDTH`] of them.
    fn store(self, numbers: Self::F, values: &mut [f32]);
    /// The same as whole numbers, cut off: of shares up to 65535.
    fn store_whole(self, numbers: Self::F, values: &mut [u16]);
    fn made(self, of: impl FnMut(usize) -> f32) -> Self::F;
    /// What becomes of three pairs of numbers, looked at together if there are lanes for them.
    fn of_three(
        self,
        first: [f32; 3],
        second: [f32; 3],
        of: impl Fn(Self::F, Self::F) -> Self::F,
    ) -> [f32; 3];
    /// Runs what is too long to be written into its callers.
    fn call<R>(self, work: impl FnOnce() -> R) -> R;
}

/// Eight at a time.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S>(pub S);

impl<S: Simd> Lanes for Eight<S> {
    type F = f32x8<S>;
    const WIDTH: usize = EIGHT;

    #[inline(always)]
    fn all(self, value: f32) -> Self::F {
        f32x8::splat(self.0, value)
    }

    #[inline(always)]
    fn load(self, values: &[f32]) -> Self::F {
        f32x8::from_slice(self.0, &values[..EIGHT])
    }

    #[inline(always)]
    fn load_whole(self, values: &[u16]) -> Self::F {
        let values = u16x8::from_slice(self.0, &values[..EIGHT]);
        let (first, last) = self.0.widen_u16x8(values);
        let all = self.0.combine_u32x4(first, last);
        // None is so large that it would be negative.
        self.0.cvt_f32_i32x8(all.bitcast())
    }

    #[inline(always)]
    fn load_pairs(self, pairs: &[Vec2]) -> [Self::F; 2] {
        let (first, second) = bytemuck::cast_slice(&pairs[..EIGHT]).split_at(EIGHT);
        let (x, y) = self.load(first).deinterleave(self.load(second));
        [x, y]
    }

    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "of eight bits")]
    fn above(self, numbers: Self::F, others: Self::F) -> u32 {
        numbers.simd_gt(others).to_bitmask() as u32
    }

    /// Of neighbours, then of twos, then of fours.
    #[inline(always)]
    fn least_from(self, numbers: Self::F) -> Self::F {
        let none = self.all(f32::INFINITY);
        let two = Number::min(numbers, self.0.slide_f32x8::<1>(numbers, none));
        let four = Number::min(two, self.0.slide_f32x8::<2>(two, none));
        Number::min(four, self.0.slide_f32x8::<4>(four, none))
    }

    #[inline(always)]
    fn most_up_to(self, numbers: Self::F) -> Self::F {
        let none = self.all(f32::NEG_INFINITY);
        let two = Number::max(numbers, self.0.slide_f32x8::<7>(none, numbers));
        let four = Number::max(two, self.0.slide_f32x8::<6>(none, two));
        Number::max(four, self.0.slide_f32x8::<4>(none, four))
    }

    #[inline(always)]
    fn store(self, numbers: Self::F, values: &mut [f32]) {
        numbers.store_slice(&mut values[..EIGHT]);
    }

    #[inline(always)]
    fn store_whole(self, numbers: Self::F, values: &mut [u16]) {
        let whole = self.0.cvt_i32_f32x8(numbers);
        let (first, last) = self.0.split_i32x8(whole);
        let all = self.0.narrow_u32x4(first.bitcast(), last.bitcast());
        all.store_slice(&mut values[..EIGHT]);
    }

    #[inline(always)]
    fn made(self, of: impl FnMut(usize) -> f32) -> Self::F {
        f32x8::from_fn(self.0, of)
    }

    #[inline(always)]
    fn of_three(
        self,
        a: [f32; 3],
        b: [f32; 3],
        of: impl Fn(Self::F, Self::F) -> Self::F,
    ) -> [f32; 3] {
        let eight = |[x, y, z]: [f32; 3]| [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0];
        let (a, b) = (eight(a), eight(b));
        let [x, y, z, ..] = of(self.load(&a), self.load(&b)).to_array();
        [x, y, z]
    }

    #[inline(always)]
    fn call<R>(self, work: impl FnOnce() -> R) -> R {
        self.0.vectorize(work)
    }
}

/// Keeps what is done one by one out of the way of what is done in registers.
#[inline(never)]
pub(crate) fn apart<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// Does `work` with as many lanes as the processor has; it is compiled once for each.
macro_rules! in_lanes {
    ($lanes:ident => $work:expr) => {{
        let level = $crate::lanes::level();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let simd = level.and_then(|level| level.as_avx2());
        #[cfg(target_arch = "aarch64")]
        let simd = level.and_then(|level| level.as_neon());
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64", target_arch = "aarch64")))]
        let simd = level.and_then(|_| None::<fearless_simd::Fallback>);
        if let Some(simd) = simd {
            let $lanes = $crate::lanes::Eight(simd);
            fearless_simd::Simd::vectorize(
                simd,
                #[inline(always)]
                || $work,
            )
        } else {
            let $lanes = $crate::lanes::One;
            $crate::lanes::apart(|| $work)
        }
    }};
}
pub(crate) use in_lanes;

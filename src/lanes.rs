//! Numbers side by side: what is done to zones and lights is written once, for one number or for a register of eight.
//!
//! Which of the two runs is decided at run time, by what the processor has. Both do the same operations in the same order
//! for each number, so that they agree to rounding.

mod first;

use core::ops::{Add, Div, Mul, Neg, Sub};
use core::sync::atomic::{AtomicBool, Ordering};
use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x8, u16x8};
pub(crate) use first::{first_below_any, first_of};

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

/// One by one.
#[derive(Clone, Copy)]
pub(crate) struct One;

/// Eight at a time.
#[derive(Clone, Copy)]
pub(crate) struct Eight<S>(pub S);

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
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast saturates"
    )]
    fn store_whole(self, numbers: f32, values: &mut [u16]) {
        values[0] = numbers as u16;
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

/// Three numbers, or eight times three.
#[derive(Clone, Copy)]
pub(crate) struct Vector<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl Vector<f32> {
    /// The same in each place.
    #[inline(always)]
    pub(crate) fn all<L: Lanes>(self, lanes: L) -> Vector<L::F> {
        Vector {
            x: lanes.all(self.x),
            y: lanes.all(self.y),
            z: lanes.all(self.z),
        }
    }

    pub(crate) fn to_array(self) -> [f32; 3] {
        [self.x, self.y, self.z]
    }
}

impl<F: Number> Vector<F> {
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> F {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
}

//! What strips cover of one another's quarters: pair by pair in double precision, and how it is added up.

use crate::pattern::strip::{Strip, crossed, for_each_quarter};
use crate::single;
use core::sync::atomic::{AtomicU32, Ordering};
use glam::{DVec2, Vec2};

/// Strips whose crossing takes up more than this share of their length are nearly parallel.
pub(super) const SHORT: f64 = 0.25;

/// What covers a quarter is added up as the negative logarithm of what is left, in whole numbers: their sum is the
/// same in any order.
const UNIT: f64 = (1 << 20) as f64;

/// A quarter of which no more is left is hidden.
pub(super) const HIDDEN: f32 = 3e-4;

/// Sums that go no further, far below what 32 bits hold.
const FULL: u32 = 1 << 30;

/// What is left of the quarters of a strip.
pub(super) type Left = [f32; 4];

/// A strip, and what covers its quarters, whatever threads find it: together, and no larger than need be, for they are
/// waited for.
pub(super) struct Covered {
    start: DVec2,
    /// From there to the end: short enough for single precision.
    step: Vec2,
    half_width: f32,
    sums: [AtomicU32; 4],
}

impl Covered {
    /// A strip that nothing covers.
    pub(super) fn new(strip: Strip) -> Self {
        Self {
            start: strip.start,
            step: (strip.end - strip.start).as_vec2(),
            half_width: single(strip.half_width),
            sums: Default::default(),
        }
    }

    pub(super) fn strip(&self) -> Strip {
        Strip {
            start: self.start,
            end: self.start + self.step.as_dvec2(),
            half_width: self.half_width.into(),
        }
    }

    /// Adds what leaves so much.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to what is left of what is hidden"
    )]
    pub(super) fn add(&self, left: Left) {
        for (sum, left) in self.sums.iter().zip(left) {
            if left < 1.0 && sum.load(Ordering::Relaxed) < FULL {
                let units = (lost(left.max(HIDDEN)) * UNIT + 0.5) as u32;
                sum.fetch_add(units, Ordering::Relaxed);
            }
        }
    }

    /// What is left of each quarter, in 255ths.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the cast saturates"
    )]
    pub(super) fn left(&self) -> [u8; 4] {
        let left = |sum: &AtomicU32| match sum.load(Ordering::Relaxed) {
            0 => 255,
            sum => (255.0 * (-f64::from(sum) / UNIT).exp() + 0.5) as u8,
        };
        self.sums.each_ref().map(left)
    }
}

/// The negative logarithm of what is left.
fn lost(left: f32) -> f64 {
    if left < 0.7 {
        return -f64::from(left).ln();
    }
    // The series is as good and takes less: of the inverse hyperbolic tangent.
    let left = f64::from(left);
    let z = (1.0 - left) / (1.0 + left);
    let square = z * z;
    2.0 * z * (1.0 + square * (1.0 / 3.0 + square * (1.0 / 5.0 + square / 7.0)))
}

/// A strip, and what all that it is compared with asks it for.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub number: u32,
    pub strip: Strip,
    pub length: f64,
    /// Unit normal, and its product with any place on the centre line.
    pub normal: DVec2,
    offset: f64,
}

impl Line {
    pub(super) fn of(number: u32, strip: &Strip) -> Self {
        let (normal, offset) = strip.line();
        Self {
            number,
            strip: *strip,
            length: strip.length(),
            normal,
            offset,
        }
    }

    fn side(&self, place: DVec2) -> f64 {
        self.normal.dot(place) - self.offset
    }
}

/// Takes from what is left of the quarters of a strip what a later one covers, if they meet in the box.
#[inline(never)]
pub(super) fn cut(left: &mut Left, a: &Line, b: &Line, within: [DVec2; 2]) {
    let [from, to] = [a.strip.start, a.strip.end].map(|end| b.side(end));
    let theirs = [b.strip.start, b.strip.end].map(|end| a.side(end));
    let half_widths = a.strip.half_width + b.strip.half_width;
    if beside([from, to]).max(beside(theirs)) > half_widths {
        return;
    }
    let mut take = |quarter: usize, share: f64| left[quarter] *= single(1.0 - share);
    let sin = a.normal.perp_dot(b.normal).abs();
    if SHORT * sin * a.length.min(b.length) < 2.0 * half_widths {
        // They run side by side.
        let cover = a.strip.covered_by(&b.strip);
        if let Some(cover) = cover.filter(|cover| is_within(cover.place, within)) {
            (0..4).for_each(|quarter| take(quarter, cover.quarters[quarter]));
        }
        return;
    }
    // Where one piece ends and the next begins, one of them crosses.
    if ((from >= 0.0) == (to >= 0.0)) | ((theirs[0] >= 0.0) == (theirs[1] >= 0.0)) {
        return;
    }
    let place = from / (from - to);
    if is_within(a.strip.start.lerp(a.strip.end, place), within) {
        for_each_quarter(crossed(place, b.strip.half_width / (sin * a.length)), take);
    }
}

/// How far two places keep to one side of a line: not above 0 if they lie on both.
fn beside([a, b]: [f64; 2]) -> f64 {
    a.min(b).max(-a.max(b))
}

/// Whether a place lies in a box: on a border that two share, in one.
fn is_within(place: DVec2, [low, high]: [DVec2; 2]) -> bool {
    place.cmpge(low).all() && place.cmplt(high).all()
}

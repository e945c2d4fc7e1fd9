//! What strips leave of a way on average over its width: less to do than line by line, and as true where many lie over it.

use super::{EIGHT, Eight, LEAST, Of, load};
use crate::lanes::{Lanes, Number};
use glam::DVec2;

/// Strips whose distance changes by less than this share of their width run side by side.
const SIDE_BY_SIDE: f32 = 0.05;

/// What strips leave of a way so wide.
#[inline(always)]
pub(super) fn left_of<L: Lanes>(
    lanes: L,
    eights: &[Eight],
    [from, to]: [DVec2; 2],
    half_width: f32,
) -> f32 {
    let (way, from) = ((to - from).as_vec2(), from.as_vec2());
    let (none, one) = (lanes.all(0.0), lanes.all(1.0));
    let mut left = one;
    for eight in eights {
        for first in (0..EIGHT).step_by(L::WIDTH) {
            let (x, y) = (
                load(lanes, eight, Of::AlongX, first),
                load(lanes, eight, Of::AlongY, first),
            );
            let start = load(lanes, eight, Of::Start, first) - (x * from.x + y * from.y);
            let slope = not_nothing(lanes, x * way.x + y * way.y);
            let (a, b) = (
                start / slope,
                (start + load(lanes, eight, Of::Length, first)) / slope,
            );
            let enters = a.min(b).max(none).min(one);
            let leaves = a.max(b).max(none).min(one);
            // How far the way is beside the strip where it enters what lies between its ends, and where it leaves.
            let (x, y) = (
                load(lanes, eight, Of::NormalX, first),
                load(lanes, eight, Of::NormalY, first),
            );
            let beside = x * from.x + y * from.y - load(lanes, eight, Of::Offset, first);
            let slope = x * way.x + y * way.y;
            let ends = [beside + slope * enters, beside + slope * leaves];
            let share = overlap(
                lanes,
                ends,
                load(lanes, eight, Of::HalfWidth, first),
                half_width,
            );
            left = left * (-(share * (leaves - enters)) + 1.0);
        }
    }
    (0..L::WIDTH).map(|lane| left.lane(lane)).product()
}

/// The share of a strip, so wide, that another one covers, on average from where their centre lines are so far apart to
/// where they are so far apart.
#[inline(always)]
fn overlap<L: Lanes>(lanes: L, [from, to]: [L::F; 2], other: L::F, own: f32) -> L::F {
    let none = lanes.all(0.0);
    let bounds = [other + own, (other - own).max(-other + own)];
    let [touch, _] = bounds;
    let step = to - from;
    let mean =
        (shared_to(none, bounds, to) - shared_to(none, bounds, from)) / not_nothing(lanes, step);
    let middle = shared(none, bounds, (from + to) * 0.5);
    // Where they run side by side.
    let crosses = step * step - touch * touch * SIDE_BY_SIDE.powi(2);
    crosses.if_above(none, mean, middle) / (2.0 * own)
}

/// What two strips share where their centre lines are so far apart, one of which ceases to lie in the other, and to touch
/// it, at these bounds: a trapezium.
#[inline(always)]
fn shared<F: Number>(none: F, [touch, inside]: [F; 2], at: F) -> F {
    let at = at.min(touch).max(-touch);
    (at + touch) - (at + inside).max(none) - (at - inside).max(none)
}

/// Its integral up to a place, no further than where they part: beyond, squares would cancel.
#[inline(always)]
fn shared_to<F: Number>(none: F, [touch, inside]: [F; 2], at: F) -> F {
    let at = at.min(touch).max(-touch);
    let (first, second, third) = (at + touch, (at + inside).max(none), (at - inside).max(none));
    (first * first - second * second - third * third) * 0.5
}

#[inline(always)]
pub(super) fn not_nothing<L: Lanes>(lanes: L, slope: L::F) -> L::F {
    let least = lanes.all(LEAST);
    (slope * slope).if_above(least * least, slope, least)
}

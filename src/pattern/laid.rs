//! What of a strip later ones cover within a footprint that holds many: each by its own area, all independently of one
//! another.

use crate::lanes::{Lanes, Number, in_lanes};
use crate::single;
use arrayvec::ArrayVec;
use glam::DVec2;

/// Strips that lie side by side in memory.
const EIGHT: usize = 8;

/// Eights of strips that are remembered: what lies under more of them is covered as it is on average.
const MOST_EIGHTS: usize = 96;

/// Slopes are no less than this, so that parallel lines have a ratio.
const LEAST: f32 = 1e-15;

/// Strips whose distance changes by less than this share of their width run side by side.
const SIDE_BY_SIDE: f32 = 0.05;

/// Numbers of a strip.
#[derive(Clone, Copy)]
enum Of {
    NormalX,
    NormalY,
    /// The normal's product with any place on the centre line.
    Offset,
    HalfWidth,
    AlongX,
    AlongY,
    /// The direction's product with its start.
    Start,
    Length,
}

const NUMBERS: usize = 8;

/// Strips that were laid, the latest first; mm.
#[derive(Debug)]
pub(super) struct Laid {
    /// Number by number.
    eights: ArrayVec<[[f32; EIGHT]; NUMBERS], MOST_EIGHTS>,
    count: usize,
}

impl Laid {
    pub(super) fn new() -> Self {
        Self {
            eights: ArrayVec::new(),
            count: 0,
        }
    }

    /// Lays a straight strip, so wide, under all that were laid before; the share that they leave of its way between two
    /// shares of it. Nothing if there is no room.
    pub(super) fn lay_under(
        &mut self,
        ends: [DVec2; 2],
        [from, to]: [f64; 2],
        width_mm: f64,
    ) -> Option<f64> {
        let [start, end] = ends;
        let left = self.left_of([start.lerp(end, from), start.lerp(end, to)], width_mm);
        self.lay(ends, width_mm).then_some(left)
    }

    /// The share that the strips leave of a way so wide.
    pub(super) fn left_of(&self, way: [DVec2; 2], width_mm: f64) -> f64 {
        let half_width = single(0.5 * width_mm).max(LEAST);
        in_lanes!(lanes => left_of(lanes, &self.eights, way, half_width)).into()
    }

    /// Lays a strip under the others; false if there is no room.
    pub(super) fn lay(&mut self, [start, end]: [DVec2; 2], width_mm: f64) -> bool {
        let place = self.count % EIGHT;
        if place == 0 && self.eights.try_push([[0.0; EIGHT]; NUMBERS]).is_err() {
            return false;
        }
        let along = (end - start).normalize_or(DVec2::X);
        let normal = along.perp();
        let Some(eight) = self.eights.last_mut() else {
            return false;
        };
        for (number, value) in [
            (Of::NormalX, normal.x),
            (Of::NormalY, normal.y),
            (Of::Offset, normal.dot(start)),
            (Of::HalfWidth, 0.5 * width_mm),
            (Of::AlongX, along.x),
            (Of::AlongY, along.y),
            (Of::Start, along.dot(start)),
            (Of::Length, start.distance(end)),
        ] {
            eight[number as usize][place] = single(value);
        }
        self.count += 1;
        true
    }
}

/// What strips leave of a way so wide.
#[inline(always)]
fn left_of<L: Lanes>(
    lanes: L,
    eights: &[[[f32; EIGHT]; NUMBERS]],
    [from, to]: [DVec2; 2],
    half_width: f32,
) -> f32 {
    let (way, from) = ((to - from).as_vec2(), from.as_vec2());
    let (none, one) = (lanes.all(0.0), lanes.all(1.0));
    let mut left = one;
    for eight in eights {
        for first in (0..EIGHT).step_by(L::WIDTH) {
            let load = |number: Of| lanes.load(&eight[number as usize][first..]);
            let (x, y) = (load(Of::AlongX), load(Of::AlongY));
            let start = load(Of::Start) - (x * from.x + y * from.y);
            let slope = not_nothing(lanes, x * way.x + y * way.y);
            let (a, b) = (start / slope, (start + load(Of::Length)) / slope);
            let enters = a.min(b).max(none).min(one);
            let leaves = a.max(b).max(none).min(one);
            // How far the way is beside the strip where it enters what lies between its ends, and where it leaves.
            let (x, y) = (load(Of::NormalX), load(Of::NormalY));
            let beside = x * from.x + y * from.y - load(Of::Offset);
            let slope = x * way.x + y * way.y;
            let ends = [beside + slope * enters, beside + slope * leaves];
            let share = overlap(lanes, ends, load(Of::HalfWidth), half_width);
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
fn not_nothing<L: Lanes>(lanes: L, slope: L::F) -> L::F {
    let least = lanes.all(LEAST);
    (slope * slope).if_above(least * least, slope, least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::strip::Strip;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Strips laid one under the other leave of each, on average over many, what polygons leave of it, each by itself;
    /// the first is whole, and parallel ones that do not touch leave each other whole.
    #[test]
    fn as_polygons_say() {
        let mut rng = StdRng::seed_from_u64(3);
        let (mut ours, mut truth) = (0.0, 0.0);
        for spread in [6.3, 0.02, 0.0].repeat(8) {
            let mut laid = Laid::new();
            let mut strips: Vec<Strip> = Vec::new();
            for i in 0..150 {
                let start = DVec2::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
                let end = start
                    + DVec2::from_angle(spread * rng.random::<f64>()) * rng.random_range(0.5..2.0);
                let half_width = 0.01 * rng.random::<f64>();
                let strip = Strip {
                    start,
                    end,
                    half_width,
                };
                let left = laid
                    .lay_under([start, end], [0.0, 1.0], 2.0 * half_width)
                    .unwrap();
                let of_quarters = |later: &Strip| {
                    let cover = strip.covered_by(later)?;
                    Some(1.0 - cover.quarters.iter().sum::<f64>() / 4.0)
                };
                let exact: f64 = strips.iter().filter_map(of_quarters).product();
                assert!(i > 0 || left == 1.0, "the first one is left {left}");
                ours += left * half_width;
                truth += exact * half_width;
                strips.push(strip);
            }
        }
        assert!((ours / truth - 1.0).abs() < 3e-3, "{ours} and {truth}");
    }

    #[test]
    fn neighbours_leave_each_other_whole() {
        let mut laid = Laid::new();
        for i in 0..MOST_EIGHTS * EIGHT {
            let y = 0.1 * i as f64;
            let ends = [DVec2::new(-1e3, y), DVec2::new(1e3, y)];
            assert_eq!(
                laid.lay_under(ends, [0.4, 0.6], 0.0999),
                Some(1.0),
                "strip {i}"
            );
        }
        assert_eq!(
            laid.lay_under([DVec2::ZERO, DVec2::X], [0.0, 1.0], 0.1),
            None
        );
    }
}

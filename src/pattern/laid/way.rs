//! Which part of a chord of scratch lies in a footprint, line by line along it.

use crate::pattern::region::Region;
use crate::pattern::strips::{STRIPS, Strips};
use crate::single;
use glam::DVec2;

/// Slopes are no less than this, so that parallel lines have a ratio.
const LEAST_SLOPE: f64 = 1e-200;

/// Where strips' middles are, from -1 to 1 across the scratch.
pub(super) const OFF_MIDDLE: [f64; STRIPS] =
    [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875];

/// What of a straight chord of scratch lies in a footprint: lines along it, each in the middle of its strip.
#[derive(Clone, Copy, Debug)]
pub(in crate::pattern) struct Way {
    /// mm.
    pub start: DVec2,
    pub end: DVec2,
    /// Unit direction.
    pub along: DVec2,
    pub half_width_mm: f64,
    /// Where each line enters and leaves the footprint, as shares of the chord; nowhere unless to > from.
    pub from: [f64; STRIPS],
    to: [f64; STRIPS],
    /// From where to where any does.
    pub stretch: [f64; 2],
}

impl Way {
    /// Nothing if none of it does.
    pub(in crate::pattern) fn within(
        footprint: &Region,
        [a, b]: [DVec2; 2],
        width_mm: f64,
    ) -> Option<Self> {
        let half_width_mm = 0.5 * width_mm;
        let along = (b - a).normalize_or(DVec2::X);
        let across = -half_width_mm * along.perp();
        let (mut from, mut to) = ([0.0; STRIPS], [1.0; STRIPS]);
        for (p, q) in footprint.edges() {
            let edge = q - p;
            let [at_a, at_b, beside] = [a - p, b - p, across].map(|v| edge.perp_dot(v));
            let away = -beside.abs();
            if at_a < away && at_b < away {
                return None;
            }
            let slope = at_b - at_a;
            let slope = if slope.abs() > LEAST_SLOPE {
                slope
            } else {
                LEAST_SLOPE
            };
            let (middle, spread) = (-at_a / slope, -beside / slope);
            let places = OFF_MIDDLE.map(|off| middle + spread * off);
            // Written so that each is one instruction.
            if slope > 0.0 {
                for (from, place) in from.iter_mut().zip(places) {
                    *from = if place > *from { place } else { *from };
                }
            } else {
                for (to, place) in to.iter_mut().zip(places) {
                    *to = if place < *to { place } else { *to };
                }
            }
        }
        let mut stretch = [1.0, 0.0];
        for (from, to) in from.iter().zip(&mut to) {
            if *to > *from {
                let [first, last] = stretch;
                stretch = [
                    if *from < first { *from } else { first },
                    if *to > last { *to } else { last },
                ];
            } else {
                *to = *from;
            }
        }
        (stretch[1] > stretch[0]).then_some(Self {
            start: a,
            end: b,
            along,
            half_width_mm,
            from,
            to,
            stretch,
        })
    }

    /// What of the chord's own line lies beside what lines have in the footprint.
    pub(super) fn middle(&self) -> [DVec2; 2] {
        self.stretch.map(|share| self.start.lerp(self.end, share))
    }

    /// What of the chord each line has in the footprint.
    pub(in crate::pattern) fn whole(&self) -> Strips {
        core::array::from_fn(|i| single(self.to[i] - self.from[i]))
    }
}

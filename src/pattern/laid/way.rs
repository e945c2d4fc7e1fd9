//! Which part of a chord of scratch lies in a footprint, line by line along it.

use crate::lanes::in_lanes;
use crate::pattern::region::{MOST_CORNERS, Region};
use crate::pattern::stretches::{Border, OFF_MIDDLE, Stretches};
use crate::pattern::strips::{STRIPS, Strips};
use crate::single;
use arrayvec::ArrayVec;
use glam::DVec2;

/// What of a straight chord of scratch lies in a footprint: lines along it, each in the middle of its strip.
#[derive(Clone, Copy, Debug)]
pub(in crate::pattern) struct Way {
    /// mm.
    pub start: DVec2,
    pub end: DVec2,
    /// Unit direction.
    pub along: DVec2,
    pub half_width_mm: f64,
    /// From where to where any of them lies there, as shares of the chord.
    pub stretch: [f64; 2],
    /// Each of them, as shares of that.
    pub lines: Stretches,
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
        let widest = f64::from(OFF_MIDDLE[STRIPS - 1]);
        // How far inside each edge it starts, how much farther to its right, and how much farther ahead.
        let mut edges: ArrayVec<[f64; 3], MOST_CORNERS> = ArrayVec::new();
        let (mut from, mut to) = (0.0, 1.0);
        for (p, q) in footprint.edges() {
            let edge = q - p;
            let [inside, end, right] = [a - p, b - p, across].map(|v| edge.perp_dot(v));
            let (outermost, ahead) = (inside + widest * right.abs(), end - inside);
            if outermost < 0.0 && outermost + ahead < 0.0 {
                return None;
            }
            // Where the first line comes in, or the last one leaves.
            let place = -outermost / ahead;
            from = if ahead > 0.0 && place > from {
                place
            } else {
                from
            };
            to = if ahead < 0.0 && place < to { place } else { to };
            edges.push([inside, right, ahead]);
        }
        let length = to - from;
        if length <= 0.0 {
            return None;
        }
        // Seen from there: single precision is to tell its parts, however long the chord is.
        let seen = |&[inside, right, ahead]: &[f64; 3]| {
            Border::of(&[inside + from * ahead], &[right], &[ahead * length])
        };
        let borders: ArrayVec<Border, MOST_CORNERS> = edges.iter().flat_map(seen).collect();
        let mut lines = Stretches::even([0.0, 1.0]);
        let is_any = in_lanes!(lanes => lines.keep(lanes, &borders));
        let [first, last] = lines.stretch_out();
        is_any.then_some(Self {
            start: a,
            end: b,
            along,
            half_width_mm,
            stretch: [first, last].map(|share| from + length * f64::from(share)),
            lines,
        })
    }

    /// What of the chord's own line lies beside what lines have in the footprint.
    pub(super) fn middle(&self) -> [DVec2; 2] {
        self.stretch.map(|share| self.start.lerp(self.end, share))
    }

    /// What of the chord each line has in the footprint.
    pub(in crate::pattern) fn whole(&self) -> Strips {
        let stretch = single(self.stretch[1] - self.stretch[0]);
        core::array::from_fn(|i| stretch * (self.lines.to[i] - self.lines.from[i]))
    }
}

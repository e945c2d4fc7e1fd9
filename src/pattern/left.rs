//! What others leave of a run.

use super::strips::{STRIPS, Strips, shares};
use crate::lanes::{Lanes, Number, in_lanes};
use crate::single;

/// Numbers of strips.
const NUMBERS: Strips = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// What others leave of a run, strip by strip across it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Left {
    /// Of all of it.
    pub mean: f64,
    strips: Strips,
    /// How much of each line that is, mm.
    left_mm: Strips,
    /// Where the first one begins, and how wide each is, mm across from the run's centre line.
    low_mm: f32,
    step_mm: f32,
    /// Where one strip ends and the next begins, mm across from the run's centre line.
    borders_mm: [f32; STRIPS - 1],
}

impl Left {
    /// Of strips that begin there and are so wide, mm across from the run's centre line: so much of all that each was.
    pub(crate) fn new([low, step]: [f64; 2], left: Strips, all: Strips) -> Self {
        let share = |left: f32, all: f32| if all > 0.0 { left / all } else { 1.0 };
        Self {
            mean: share(left.iter().sum(), all.iter().sum()).into(),
            strips: core::array::from_fn(|i| share(left[i], all[i])),
            left_mm: left,
            low_mm: single(low),
            step_mm: single(step),
            borders_mm: core::array::from_fn(|i| single(low + step * (i + 1) as f64)),
        }
    }

    /// As much of each strip.
    pub(crate) fn even(share: f64) -> Self {
        Self {
            mean: share,
            strips: [single(share); STRIPS],
            left_mm: [0.0; STRIPS],
            low_mm: 0.0,
            step_mm: 0.0,
            borders_mm: [0.0; STRIPS - 1],
        }
    }

    /// What share of all that is left the strips of a cross-section have that reaches from one place to another.
    pub(crate) fn across(&self, ends_mm: [f64; 2]) -> Strips {
        let [from, to] = ends_mm.map(single);
        let step = (to - from) / STRIPS as f32;
        shares(in_lanes!(lanes => self.over(lanes, [from, step])))
    }

    /// How much of lines lies over strips that begin there and are so wide, by their widths.
    #[inline(always)]
    fn over<L: Lanes>(&self, lanes: L, [from, step]: [f32; 2]) -> Strips {
        let mut over = Strips::default();
        for first in (0..STRIPS).step_by(L::WIDTH) {
            let start = lanes.load(&NUMBERS[first..]) * step + from;
            let (end, none) = (start + step, lanes.all(0.0));
            let (mut sum, mut low) = (none, self.low_mm);
            for left in self.left_mm {
                let high = low + self.step_mm;
                let width = end.min(lanes.all(high)) - start.max(lanes.all(low));
                sum = sum + width.max(none) * left;
                low = high;
            }
            lanes.store(sum, &mut over[first..]);
        }
        over
    }

    /// Where strips end, and the share that is left of each; the outer ones go on without end. Neighbours of which as much is
    /// left are one.
    pub(crate) fn strips(&self) -> impl Iterator<Item = (f32, f32)> {
        (0..STRIPS).filter_map(|i| match self.strips.get(i + 1) {
            Some(next) if *next == self.strips[i] => None,
            Some(_) => Some((self.borders_mm[i], self.strips[i])),
            None => Some((f32::INFINITY, self.strips[i])),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of lines over a part of a cross-section is shared out by its strips, and adds up to 1.
    #[test]
    fn lines_are_shared_out_by_strips() {
        // Lines over the left half, of which the right half is gone.
        let left = [2.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0];
        let found = Left::new([-1.0, 0.125], left, [2.0; STRIPS]).across([-1.0, 1.0]);
        let wanted = [0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
        }
        let found = Left::new([-1.0, 0.25], [0.0; STRIPS], [2.0; STRIPS]).across([-1.0, 1.0]);
        assert!(
            (found.iter().sum::<f32>() - 1.0).abs() < 1e-6,
            "{found:?} of nothing"
        );
    }
}

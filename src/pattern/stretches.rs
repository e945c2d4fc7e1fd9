//! Lines side by side along something straight, and what straight borders leave of each.

use super::strips::{STRIPS, Strips};
use crate::lanes::{Lanes, Number};
use crate::single;

/// Where lines are, each in the middle of its strip, from -1 to 1 across.
pub(super) const OFF_MIDDLE: Strips = [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875];

/// Places further away are as good as this one, and numbers stay finite.
const FAR: f64 = 1e30;

/// What changes by less than this share on the way does not change. Of what is parallel, places are far away, but not yet all
/// alike.
const LEAST_AHEAD: f64 = 1e-20;

/// From where to where something reaches along each line; nowhere if both are one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretches {
    pub from: Strips,
    pub to: Strips,
}

/// Where lines pass a straight border: evenly, from one side to the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Border {
    /// In the middle, and how much further on at 1 to the right of it.
    place: f32,
    step: f32,
    /// To its inner side.
    enters: bool,
}

impl Border {
    /// Borders on whose inner side the middle's start lies so far, so much farther from 1 to the right, and so much farther from
    /// 1 ahead. Of several at once divisions take no longer than of one.
    #[inline(always)]
    pub(super) fn of<const COUNT: usize>(
        inside: &[f64; COUNT],
        to_the_right: &[f64; COUNT],
        ahead: &[f64; COUNT],
    ) -> [Self; COUNT] {
        let (mut places, mut steps) = ([0.0; COUNT], [0.0; COUNT]);
        for i in 0..COUNT {
            // Along a border, all of a line lies on one side.
            let is_parallel = ahead[i].abs() < LEAST_AHEAD;
            let per_way = 1.0 / if is_parallel { LEAST_AHEAD } else { ahead[i] };
            places[i] = bounded(-inside[i] * per_way);
            steps[i] = bounded(-to_the_right[i] * per_way);
        }
        core::array::from_fn(|i| Self {
            place: places[i],
            step: steps[i],
            enters: ahead[i] > -LEAST_AHEAD,
        })
    }
}

/// Written so that each is one instruction.
#[inline(always)]
fn bounded(place: f64) -> f32 {
    let place = if place < FAR { place } else { FAR };
    single(if place > -FAR { place } else { -FAR })
}

impl Stretches {
    /// The same of each line.
    pub(super) fn even([from, to]: [f32; 2]) -> Self {
        Self {
            from: [from; STRIPS],
            to: [to; STRIPS],
        }
    }

    /// All of lines without end.
    pub(super) fn endless() -> Self {
        Self::even([single(-FAR), single(FAR)])
    }

    /// From where to where any reaches; from there on they are told as shares of that.
    pub(super) fn stretch_out(&mut self) -> [f32; 2] {
        let (mut first, mut last) = (f32::INFINITY, f32::NEG_INFINITY);
        for (from, to) in self.from.iter().zip(&self.to) {
            if to > from {
                first = if *from < first { *from } else { first };
                last = if *to > last { *to } else { last };
            }
        }
        let length = last - first;
        for place in self.from.iter_mut().chain(&mut self.to) {
            *place = (*place - first) / length;
        }
        [first, last]
    }

    /// As many as there are lanes, from one on.
    #[inline(always)]
    pub(super) fn load<L: Lanes>(&self, lanes: L, first: usize) -> [L::F; 2] {
        [
            lanes.load(&self.from[first..]),
            lanes.load(&self.to[first..]),
        ]
    }

    #[inline(always)]
    pub(super) fn store<L: Lanes>(&mut self, lanes: L, first: usize, [from, to]: [L::F; 2]) {
        lanes.store(from, &mut self.from[first..]);
        lanes.store(to, &mut self.to[first..]);
    }

    /// Keeps what lies within borders; of a line that has nothing there, its end. Whether there is any.
    #[inline(always)]
    pub(super) fn keep<L: Lanes>(&mut self, lanes: L, borders: &[Border]) -> bool {
        let mut is_any = false;
        for first in (0..STRIPS).step_by(L::WIDTH) {
            let off = lanes.load(&OFF_MIDDLE[first..]);
            let [mut from, end] = self.load(lanes, first);
            let mut to = end;
            for border in borders {
                // Rounded alike in a register and alone: what is nearly parallel hangs by a hair.
                let place = off * border.step + border.place;
                if border.enters {
                    from = from.max(place);
                } else {
                    to = to.min(place);
                }
            }
            is_any |= (to - from).any();
            let kept = [to.if_above(from, from, end), to.if_above(from, to, end)];
            self.store(lanes, first, kept);
        }
        is_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::in_lanes;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Borders leave of each line what they do at point after point along it.
    #[test]
    fn borders_leave_what_lies_within() {
        let mut rng = StdRng::seed_from_u64(11);
        let mut some = 0;
        for _ in 0..300 {
            let mut any = || [(); 3].map(|()| rng.random_range(-1.0..1.0_f64));
            let sides = [any(), any(), any()];
            let [inside, right, ahead] = [0, 1, 2].map(|k| sides.map(|side| side[k]));
            let borders = Border::of(&inside, &right, &ahead);
            let mut kept = Stretches::even([-2.0, 3.0]);
            let is_any = in_lanes!(lanes => kept.keep(lanes, &borders));
            for (i, off) in OFF_MIDDLE.into_iter().enumerate() {
                let steps = 4000;
                let is_inside = |step: i32| {
                    let at = -2.0 + 5.0 * (f64::from(step) + 0.5) / f64::from(steps);
                    let side = |[inside, right, ahead]: [f64; 3]| {
                        inside + right * f64::from(off) + ahead * at
                    };
                    sides.into_iter().all(|of| side(of) >= 0.0)
                };
                let inside = (0..steps).filter(|step| is_inside(*step)).count();
                let (truth, found) = (
                    5.0 * inside as f64 / f64::from(steps),
                    kept.to[i] - kept.from[i],
                );
                assert!(
                    (truth - f64::from(found)).abs() < 3e-3,
                    "{found}, not {truth}"
                );
                assert!(is_any || found == 0.0, "{found} of nothing");
                some += u32::from(inside > 0);
            }
        }
        assert!(some > 300, "only {some} lines have any");
    }

    /// Along a border, a line is kept or not, whatever lies beyond, near and far.
    #[test]
    fn lines_along_a_border() {
        for scale in [1e-6, 1.0, 10.0, 1e6] {
            let mut kept = Stretches::endless();
            // On the inner side from -1/4 to the right.
            let borders = Border::of(
                &[0.25 * scale, 0.0, 1.0],
                &[scale, 0.0, 0.0],
                &[0.0, 1.0, -1.0],
            );
            assert!(in_lanes!(lanes => kept.keep(lanes, &borders)), "nothing");
            let lengths: Vec<f32> = (0..8).map(|i| kept.to[i] - kept.from[i]).collect();
            assert_eq!(lengths, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        }
    }
}

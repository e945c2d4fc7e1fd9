//! Lines along a run, on which what other runs cover of it is measured: exact along each, however many cover one another.

use super::center_line::CenterLine;
use super::left::Left;
use super::region::{MOST_CORNERS, Region};
use super::stretches::{Border, Stretches};
use super::strips::{STRIPS, Strips};
use crate::lanes::{Lanes, Number, in_lanes};
use arrayvec::ArrayVec;
use glam::DVec2;

/// Lines beside one another, each in the middle of its share of the width.
const LINES: usize = STRIPS;

/// Others whose cuts are measured.
const MOST_CUTS: usize = 64;

/// Lines along a run, as far as they lie in what it covers, and what others cut from them.
pub(super) struct Lines {
    line: CenterLine,
    /// Beside its origin, in the middle of them.
    middle: DVec2,
    /// From there to the right side.
    right_mm: DVec2,
    /// Where the first one's share of the width begins, and where the last one's ends, mm across from the run's centre line.
    ends_mm: [f64; 2],
    /// mm from beside the run's origin.
    whole: Stretches,
}

/// What others cut from lines: along each in the order in which they begin.
pub(super) type Cuts = ArrayVec<Stretches, MOST_CUTS>;

impl Lines {
    /// Along a run, through what it covers.
    pub(super) fn along(line: &CenterLine, cover: &Region) -> Self {
        let edges = cover.edges().map(|(a, b)| [a, (b - a).perp()]);
        Self::within(line, line.extent(cover), edges)
    }

    /// Along a run, between two places across and within borders, each a point and an inward direction.
    fn within(
        line: &CenterLine,
        [low, high]: [f64; 2],
        borders: impl Iterator<Item = [DVec2; 2]>,
    ) -> Self {
        let mut lines = Self {
            line: *line,
            middle: line.beside(0.5 * (low + high)),
            right_mm: line.across() * (0.5 * (high - low)),
            ends_mm: [low, high],
            whole: Stretches::endless(),
        };
        let borders = borders.flat_map(|border| lines.borders(&[border]));
        let borders: ArrayVec<Border, MOST_CORNERS> = borders.collect();
        in_lanes!(lanes => lines.whole.keep(lanes, &borders));
        lines
    }

    #[inline(always)]
    fn borders<const COUNT: usize>(&self, all: &[[DVec2; 2]; COUNT]) -> [Border; COUNT] {
        let (mut inside, mut right, mut ahead) = ([0.0; COUNT], [0.0; COUNT], [0.0; COUNT]);
        for (i, &[point, inward]) in all.iter().enumerate() {
            inside[i] = (self.middle - point).dot(inward);
            right[i] = self.right_mm.dot(inward);
            ahead[i] = self.line.approach([point, inward]);
        }
        Border::of(&inside, &right, &ahead)
    }

    /// Adds what of them lies within borders, each a point and an inward direction, to the cuts; false if there were too many.
    pub(super) fn cut(&self, borders: &[[DVec2; 2]; 4], cuts: &mut Cuts) -> bool {
        let borders = self.borders(borders);
        let mut part = self.whole;
        if !in_lanes!(lanes => part.keep(lanes, &borders)) {
            return true;
        }
        let has_room = cuts.try_push(part).is_ok();
        if has_room {
            in_lanes!(lanes => sort_last(lanes, cuts));
        }
        has_room
    }

    /// What cuts leave.
    pub(super) fn left(&self, cuts: &Cuts) -> Left {
        let [left, all] = in_lanes!(lanes => self.beside(lanes, cuts));
        let [low, high] = self.ends_mm;
        Left::new([low, (high - low) / LINES as f64], left, all)
    }

    /// How much of each line no cut covers, and how much there is, mm.
    #[inline(always)]
    fn beside<L: Lanes>(&self, lanes: L, cuts: &Cuts) -> [Strips; 2] {
        let (mut left, mut all) = (Strips::default(), Strips::default());
        let none = lanes.all(0.0);
        for first in (0..LINES).step_by(L::WIDTH) {
            let [mut at, end] = self.whole.load(lanes, first);
            lanes.store(self.line.spans([at, end]), &mut all[first..]);
            let mut sum = none;
            for cut in cuts {
                let [from, to] = cut.load(lanes, first);
                sum = sum + self.line.spans([at, from.max(at)]);
                at = at.max(to);
            }
            sum = sum + self.line.spans([at, end]);
            lanes.store(sum, &mut left[first..]);
        }
        [left, all]
    }
}

/// Moves the last of some stretches to where it belongs along each line.
#[inline(always)]
fn sort_last<L: Lanes>(lanes: L, all: &mut [Stretches]) {
    for first in (0..LINES).step_by(L::WIDTH) {
        let mut place = all.len() - 1;
        let [mut from, mut to] = all[place].load(lanes, first);
        while let Some(before) = place.checked_sub(1) {
            let [its_from, its_to] = all[before].load(lanes, first);
            if !(its_from - from).any() {
                break;
            }
            let later = [its_from.max(from), its_from.if_above(from, its_to, to)];
            all[place].store(lanes, first, later);
            to = its_from.if_above(from, to, its_to);
            from = its_from.min(from);
            place = before;
        }
        all[place].store(lanes, first, [from, to]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Strips across a thin one, many of which cover one another, leave of it what they leave of points all over it:
    /// within half a line's share, which those that run along it may be off, and within 0.2 % on average.
    #[test]
    fn as_points_say() {
        let mut rng = StdRng::seed_from_u64(5);
        let [length, width] = [1.0, 0.05];
        let mut off = 0.0;
        for count in 0..40 {
            let strips: Vec<[[DVec2; 2]; 4]> = (0..count % 8)
                .map(|_| strip(&mut rng, [length, width]))
                .collect();
            let is_left = |at: DVec2| {
                let covers = |strip: &[[DVec2; 2]; 4]| {
                    let within = |[origin, inward]: &[DVec2; 2]| (at - *origin).dot(*inward) > 0.0;
                    strip.iter().all(within)
                };
                !strips.iter().any(covers)
            };
            let steps = 300;
            let share = |step: u32| (f64::from(step) + 0.5) / f64::from(steps);
            let points = (0..steps * steps)
                .map(|i| DVec2::new(length * share(i % steps), width * share(i / steps)));
            let points = points.filter(|at| is_left(*at)).count() as f64;
            let truth = points / f64::from(steps * steps);
            let line = CenterLine::even(DVec2::new(0.3, 0.0), DVec2::X);
            let ends = [[DVec2::ZERO, DVec2::X], [DVec2::X * length, -DVec2::X]];
            let lines = Lines::within(&line, [-width, 0.0], ends.into_iter());
            let mut cuts = Cuts::new();
            let mut strips = strips.iter();
            assert!(strips.all(|borders| lines.cut(borders, &mut cuts)), "room");
            let left = lines.left(&cuts).mean;
            let worst = 0.5 / LINES as f64;
            assert!((left - truth).abs() < worst, "{left}, not {truth}");
            off += (left - truth).abs() / 40.0;
        }
        assert!(off < 2e-3, "{off} on average");
    }

    /// The borders of a strip anywhere across a larger one, some of which end in it.
    fn strip(rng: &mut StdRng, [length, width]: [f64; 2]) -> [[DVec2; 2]; 4] {
        let middle = DVec2::new(length * rng.random::<f64>(), width * rng.random::<f64>());
        let along = DVec2::from_angle(rng.random_range(0.2..3.0));
        let half = [rng.random_range(0.02..1.0), rng.random_range(0.02..0.2)];
        let [end, side] = [half[0] * along, half[1] * along.perp()];
        [
            [middle - end, along],
            [middle + end, -along],
            [middle - side, along.perp()],
            [middle + side, -along.perp()],
        ]
    }
}

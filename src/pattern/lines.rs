//! Lines along a run, on which what other runs cover of it is measured: exact along each, however many cover one another.

use super::center_line::CenterLine;
use super::left::Left;
use super::region::{MOST_CORNERS, Region};
use super::strips::{STRIPS, Strips};
use crate::lanes::{Lanes, Number, in_lanes};
use crate::single;
use arrayvec::ArrayVec;
use glam::DVec2;

/// Lines beside one another, each in the middle of its share of the width.
const LINES: usize = STRIPS;

/// Numbers of lines.
const NUMBERS: Strips = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Others whose cuts are measured.
const MOST_CUTS: usize = 64;

/// Places further away, mm, are as good as this one, and numbers stay finite.
const FAR_MM: f64 = 1e30;

/// Lines along a run, as far as they lie in what it covers, and what others cut from them.
pub(super) struct Lines {
    line: CenterLine,
    /// Beside its origin: where the first one is.
    first: DVec2,
    /// Where the first one's share of the width begins, and how wide each is, mm across from the run's centre line.
    low_mm: f64,
    step_mm: f64,
    whole: Stretches,
}

/// What others cut from lines: along each in the order in which they begin.
pub(super) type Cuts = ArrayVec<Stretches, MOST_CUTS>;

/// From where to where something reaches along each line, mm from beside the run's origin; nowhere if both are one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretches {
    from: Strips,
    to: Strips,
}

/// Where lines pass a straight border, mm: evenly, from the first one on.
#[derive(Clone, Copy)]
struct Border {
    place: f32,
    step: f32,
    /// To its inner side.
    enters: bool,
}

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
        let step = (high - low) / LINES as f64;
        let mut lines = Self {
            line: *line,
            first: line.beside(low + 0.5 * step),
            low_mm: low,
            step_mm: step,
            whole: Stretches {
                from: [single(-FAR_MM); LINES],
                to: [single(FAR_MM); LINES],
            },
        };
        let borders = borders.map(|border| lines.border(border));
        let borders: ArrayVec<Border, MOST_CORNERS> = borders.collect();
        in_lanes!(lanes => lines.whole.keep(lanes, &borders));
        lines
    }

    #[inline(always)]
    fn border(&self, [point, inward]: [DVec2; 2]) -> Border {
        let slope = self.line.approach([point, inward]);
        // Along a border, all of a line lies on one side.
        let per_slope = if slope == 0.0 { FAR_MM } else { 1.0 / slope };
        let [inside, deeper] = [
            (self.first - point).dot(inward),
            self.step_mm * self.line.across().dot(inward),
        ];
        let place = |inside: f64| single((-inside * per_slope).clamp(-FAR_MM, FAR_MM));
        Border {
            place: place(inside),
            step: place(deeper),
            enters: slope >= 0.0,
        }
    }

    /// Adds what of them lies within borders, each a point and an inward direction, to the cuts; false if there were too many.
    pub(super) fn cut(&self, borders: &[[DVec2; 2]; 4], cuts: &mut Cuts) -> bool {
        let [a, b, c, d] = borders;
        // Number by number: mapped, they would be asked for one by one.
        let borders = [
            self.border(*a),
            self.border(*b),
            self.border(*c),
            self.border(*d),
        ];
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
        Left::new([self.low_mm, self.step_mm], left, all)
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

impl Stretches {
    #[inline(always)]
    fn load<L: Lanes>(&self, lanes: L, first: usize) -> [L::F; 2] {
        [
            lanes.load(&self.from[first..]),
            lanes.load(&self.to[first..]),
        ]
    }

    #[inline(always)]
    fn store<L: Lanes>(&mut self, lanes: L, first: usize, [from, to]: [L::F; 2]) {
        lanes.store(from, &mut self.from[first..]);
        lanes.store(to, &mut self.to[first..]);
    }

    /// Keeps what lies within borders; of a line that has nothing there, its end. Whether there is any.
    #[inline(always)]
    fn keep<L: Lanes>(&mut self, lanes: L, borders: &[Border]) -> bool {
        let mut is_any = false;
        for first in (0..LINES).step_by(L::WIDTH) {
            let numbers = lanes.load(&NUMBERS[first..]);
            let [mut from, end] = self.load(lanes, first);
            let mut to = end;
            for border in borders {
                let place = numbers.times_plus(lanes.all(border.step), lanes.all(border.place));
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
            let mut lines = Lines::within(&line, [-width, 0.0], ends.into_iter());
            assert!(strips.into_iter().all(|borders| lines.cut(borders)), "room");
            let left = lines.left().mean;
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

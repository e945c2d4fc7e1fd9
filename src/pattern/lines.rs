//! Lines along a run, on which what other runs cover of it is measured: exact along each, however many cover one another.

use super::center_line::CenterLine;
use super::region::Region;
use super::strips::{STRIPS, Strips, shares};
use crate::single;
use arrayvec::ArrayVec;
use glam::DVec2;

/// Lines beside one another, each in the middle of its share of the width.
const LINES: usize = STRIPS;

/// Others whose cuts are measured.
const MOST_CUTS: usize = 64;

/// What others cover of some lines.
pub(super) type Cuts = ArrayVec<Stretches, MOST_CUTS>;

pub(super) struct Lines {
    line: CenterLine,
    /// Beside its origin.
    starts: [DVec2; LINES],
    /// Where the first one's share of the width begins, and how wide each is, mm across from the run's centre line.
    low_mm: f64,
    step_mm: f64,
}

/// What others leave of a run, strip by strip across it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Left {
    /// Of all of it.
    pub mean: f64,
    strips: Strips,
    /// How much of each line that is, mm.
    left_mm: Strips,
    /// Where the first one begins, and how wide each is, mm across from the run's centre line.
    low_mm: f64,
    step_mm: f64,
    /// Where one strip ends and the next begins, mm across from the run's centre line.
    borders_mm: [f32; LINES - 1],
}

/// From where to where something reaches along each line, mm; nowhere unless to > from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretches {
    from: [f64; LINES],
    to: [f64; LINES],
}

impl Lines {
    /// Along a run, through what it covers.
    pub(super) fn along(line: &CenterLine, cover: &Region) -> Self {
        let [low, high] = line.extent(cover);
        let step = (high - low) / LINES as f64;
        Self {
            line: *line,
            starts: core::array::from_fn(|i| line.beside(low + step * (i as f64 + 0.5))),
            low_mm: low,
            step_mm: step,
        }
    }

    /// What cuts leave of a run that reaches so far along them.
    pub(super) fn left(&self, whole: &Stretches, cuts: &Cuts) -> Left {
        let [left, all] = whole.beside(cuts, &self.line);
        Left::new([self.low_mm, self.step_mm], left, all)
    }

    /// What of them lies within borders, each a point and an inward direction.
    pub(super) fn within(&self, borders: impl IntoIterator<Item = [DVec2; 2]>) -> Stretches {
        let mut part = Stretches {
            from: [f64::NEG_INFINITY; LINES],
            to: [f64::INFINITY; LINES],
        };
        for [origin, inward] in borders {
            let slope = self.line.approach([origin, inward]);
            let inside = self.starts.map(|start| (start - origin).dot(inward));
            if slope == 0.0 {
                for (to, inside) in part.to.iter_mut().zip(inside) {
                    *to = if inside < 0.0 { f64::NEG_INFINITY } else { *to };
                }
                continue;
            }
            let places = inside.map(|inside| inside * (-1.0 / slope));
            let (bounds, sign) = match slope > 0.0 {
                true => (&mut part.from, 1.0),
                false => (&mut part.to, -1.0),
            };
            for (bound, place) in bounds.iter_mut().zip(places) {
                let is_nearer = (place - *bound) * sign > 0.0;
                *bound = if is_nearer { place } else { *bound };
            }
        }
        part
    }
}

impl Stretches {
    pub(super) fn meet(&self, other: &Self) -> bool {
        let meets = |i: usize| self.from[i].max(other.from[i]) < self.to[i].min(other.to[i]);
        (0..LINES).any(meets)
    }

    /// How much of each line none of `cuts` covers, and how much there is, mm.
    fn beside(&self, cuts: &Cuts, line: &CenterLine) -> [[f64; LINES]; 2] {
        let (mut left, mut whole) = ([0.0; LINES], [0.0; LINES]);
        let mut own: ArrayVec<[f64; 2], MOST_CUTS> = ArrayVec::new();
        for i in 0..LINES {
            let [mut at, end] = [self.from[i], self.to[i]];
            if end <= at {
                continue;
            }
            whole[i] = line.span([at, end]);
            let all = cuts.iter().map(|cut| [cut.from[i], cut.to[i]]);
            own.clear();
            own.extend(all.filter(|&[from, to]| from.max(at) < to.min(end)));
            own.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            for &[from, to] in &own {
                left[i] += line.span([at, from]).max(0.0);
                at = at.max(to).min(end);
            }
            left[i] += line.span([at, end]);
        }
        [left, whole]
    }
}

impl Left {
    /// Of strips that begin there and are so wide, mm across from the run's centre line: so much of all that each was.
    pub(crate) fn new([low, step]: [f64; 2], left: [f64; LINES], all: [f64; LINES]) -> Self {
        let share = |left: f64, all: f64| if all > 0.0 { left / all } else { 1.0 };
        Self {
            mean: share(left.iter().sum(), all.iter().sum()),
            strips: core::array::from_fn(|i| single(share(left[i], all[i]))),
            left_mm: left.map(single),
            low_mm: low,
            step_mm: step,
            borders_mm: core::array::from_fn(|i| single(low + step * (i + 1) as f64)),
        }
    }

    /// As much of each strip.
    pub(crate) fn even(share: f64) -> Self {
        Self {
            mean: share,
            strips: [single(share); LINES],
            left_mm: [0.0; LINES],
            low_mm: 0.0,
            step_mm: 0.0,
            borders_mm: [0.0; LINES - 1],
        }
    }

    /// What share of all that is left the strips of a cross-section have that reaches from one place to another.
    pub(crate) fn across(&self, [from, to]: [f64; 2]) -> Strips {
        let step = (to - from) / STRIPS as f64;
        shares(core::array::from_fn(|i| {
            let own = [from + step * i as f64, from + step * (i + 1) as f64];
            let of_line = |line: usize| {
                let low = self.low_mm + self.step_mm * line as f64;
                let width = own[1].min(low + self.step_mm) - own[0].max(low);
                single(width.max(0.0)) * self.left_mm[line]
            };
            (0..LINES).map(of_line).sum()
        }))
    }

    /// Where strips end, and the share that is left of each; the outer ones go on without end. Neighbours of which as much is
    /// left are one.
    pub(crate) fn strips(&self) -> impl Iterator<Item = (f32, f32)> {
        (0..LINES).filter_map(|i| match self.strips.get(i + 1) {
            Some(next) if *next == self.strips[i] => None,
            Some(_) => Some((self.borders_mm[i], self.strips[i])),
            None => Some((f32::INFINITY, self.strips[i])),
        })
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
            let lines = Lines {
                line: CenterLine::even(DVec2::ZERO, DVec2::X),
                starts: core::array::from_fn(|i| {
                    DVec2::new(0.3, width * (i as f64 + 0.5) / LINES as f64)
                }),
                low_mm: 0.0,
                step_mm: width / LINES as f64,
            };
            let ends = [[DVec2::ZERO, DVec2::X], [DVec2::X * length, -DVec2::X]];
            let whole = lines.within(ends);
            let cuts: Cuts = strips
                .iter()
                .map(|borders| lines.within(*borders))
                .collect();
            let left = lines.left(&whole, &cuts).mean;
            let worst = 0.5 / LINES as f64;
            assert!((left - truth).abs() < worst, "{left}, not {truth}");
            off += (left - truth).abs() / 40.0;
        }
        assert!(off < 2e-3, "{off} on average");
    }

    /// What is left of lines over a part of a cross-section is shared out by its strips, and adds up to 1.
    #[test]
    fn lines_are_shared_out_by_strips() {
        // Lines over the left half, of which the right half is gone.
        let left = [2.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0];
        let found = Left::new([-1.0, 0.125], left, [2.0; LINES]).across([-1.0, 1.0]);
        let wanted = [0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{found}, not {wanted}");
        }
        let found = Left::new([-1.0, 0.25], [0.0; LINES], [2.0; LINES]).across([-1.0, 1.0]);
        assert!(
            (found.iter().sum::<f32>() - 1.0).abs() < 1e-6,
            "{found:?} of nothing"
        );
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

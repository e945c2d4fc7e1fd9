//! What strips leave of lines along a way.

use super::way::Way;
use super::{EIGHT, Eight, Of};
use crate::lanes::{Lanes, Number};
use crate::pattern::stretches::OFF_MIDDLE;
use crate::pattern::strips::{STRIPS, Strips};
use crate::single;
use glam::Vec2;

/// Parts of a line, in each of which what covers it does so independently.
const PARTS: usize = 4;

/// Slopes are no less than this, so that parallel lines have a ratio.
const LEAST: f32 = 1e-15;

/// Lines along a way, single.
pub(super) struct Lines {
    start: Vec2,
    /// From there to where the last one leaves the footprint.
    way: Vec2,
    across: Vec2,
    half_width: f32,
    /// How far each is to the right of the middle.
    off: Strips,
    /// Where each begins, as a share of the way, and how many of its parts are as long.
    from: Strips,
    parts: Strips,
    /// Where the last of them has begun and the first one ends, and where they begin and how long they are on average.
    common: [f32; 2],
    mean: [f32; 2],
}

/// How strips lie to all lines, side by side.
struct Crossing<F> {
    /// Where the middle of the way comes under each strip and leaves it, in parts.
    covered: [F; 2],
    /// Above 0 where some line comes under it.
    touches: F,
    /// Above 0 where all lines do, for as long, from side to side.
    alike: F,
}

/// How a strip lies to a way: how far beside it is the way's start, and how far behind its own start; how both change to the
/// way's end, and from there to its right.
struct Meeting {
    beside: [f32; 3],
    behind: [f32; 3],
    half_width: f32,
    length: f32,
}

impl Lines {
    pub(super) fn of(way: &Way) -> Self {
        let [start, end] = way.middle();
        let half_width = single(way.half_width_mm);
        let mut lines = Self {
            start: start.as_vec2(),
            way: (end - start).as_vec2(),
            across: -way.along.perp().as_vec2(),
            half_width,
            off: OFF_MIDDLE.map(|off| half_width * off),
            from: way.lines.from,
            parts: Strips::default(),
            common: [0.0, 1.0],
            mean: [0.0; 2],
        };
        let (mut count, mut sums) = (0.0, [0.0; 2]);
        for (i, (from, to)) in way.lines.from.into_iter().zip(way.lines.to).enumerate() {
            let length = to - from;
            if length > 0.0 {
                let [begun, ends] = lines.common;
                count += 1.0;
                sums = [sums[0] + from, sums[1] + length];
                lines.parts[i] = PARTS as f32 / length;
                lines.common = [begun.max(from), ends.min(to)];
            }
        }
        lines.mean = sums.map(|sum| sum / count);
        lines
    }

    /// The share of each that strips leave.
    #[inline(always)]
    pub(super) fn left<L: Lanes>(&self, lanes: L, eights: &[Eight]) -> Strips {
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let mut left = [[1.0; STRIPS]; PARTS];
        let mut of_all = [one; PARTS];
        for eight in eights {
            for first in (0..EIGHT).step_by(L::WIDTH) {
                let crossing = self.crossing(lanes, eight, first);
                if !crossing.touches.any() {
                    continue;
                }
                for (i, left) in of_all.iter_mut().enumerate() {
                    let [enters, leaves] = crossing.covered;
                    let covered = within(none, leaves - i as f32) - within(none, enters - i as f32);
                    *left = crossing
                        .alike
                        .if_above(none, *left * (one - covered), *left);
                }
                let unlike = crossing.alike.if_above(none, none, crossing.touches);
                if !unlike.any() {
                    continue;
                }
                for lane in 0..L::WIDTH {
                    if unlike.lane(lane) > 0.0 {
                        self.cut(lanes, &self.meeting(eight, first + lane), &mut left);
                    }
                }
            }
        }
        let of_all = of_all.map(|left| (0..L::WIDTH).map(|lane| left.lane(lane)).product::<f32>());
        let mean = |i: usize| {
            let parts = left.iter().zip(&of_all);
            parts.map(|(part, all)| part[i] * all).sum::<f32>() / PARTS as f32
        };
        core::array::from_fn(mean)
    }

    #[inline(always)]
    fn crossing<L: Lanes>(&self, lanes: L, eight: &Eight, first: usize) -> Crossing<L::F> {
        let half_width = load(lanes, eight, Of::HalfWidth, first);
        let (sides, aside) = self.between(
            lanes,
            [
                load(lanes, eight, Of::NormalX, first),
                load(lanes, eight, Of::NormalY, first),
            ],
            load(lanes, eight, Of::Offset, first),
            [-half_width, half_width],
        );
        let (ends, ahead) = self.between(
            lanes,
            [
                load(lanes, eight, Of::AlongX, first),
                load(lanes, eight, Of::AlongY, first),
            ],
            load(lanes, eight, Of::Start, first),
            [lanes.all(0.0), load(lanes, eight, Of::Length, first)],
        );
        let all_of_it = [sides[0] - aside, sides[1] + aside];
        let from = all_of_it[0].max(ends[0] - ahead);
        let to = all_of_it[1].min(ends[1] + ahead);
        let before = all_of_it[0] - (ends[0] + ahead).max(lanes.all(self.common[0]));
        let behind = (ends[1] - ahead).min(lanes.all(self.common[1])) - all_of_it[1];
        let per_part = PARTS as f32 / self.mean[1];
        let [enters, leaves] = sides;
        Crossing {
            covered: [
                (enters - self.mean[0]) * per_part,
                (leaves - self.mean[0]) * per_part,
            ],
            touches: (to - from).min(to).min(-from + 1.0),
            alike: before.min(behind),
        }
    }

    /// Where the middle is between two bounds along axes, and how far from there lines up to its sides may be.
    #[inline(always)]
    fn between<L: Lanes>(
        &self,
        lanes: L,
        [x, y]: [L::F; 2],
        offset: L::F,
        [first, last]: [L::F; 2],
    ) -> ([L::F; 2], L::F) {
        let slope = x * self.way.x + y * self.way.y;
        let per_way = lanes.all(1.0) / not_nothing(slope);
        let here = x * self.start.x + y * self.start.y - offset;
        let (a, b) = ((first - here) * per_way, (last - here) * per_way);
        let right = x * self.across.x + y * self.across.y;
        let spread = right * per_way * self.half_width;
        ([a.min(b), a.max(b)], spread.max(-spread))
    }

    #[inline(always)]
    fn meeting(&self, eight: &Eight, place: usize) -> Meeting {
        let of = |number: Of| eight[number as usize][place];
        let normal = Vec2::new(of(Of::NormalX), of(Of::NormalY));
        let along = Vec2::new(of(Of::AlongX), of(Of::AlongY));
        let seen_from = |axis: Vec2, offset: f32| {
            [
                axis.dot(self.start) - offset,
                axis.dot(self.way),
                axis.dot(self.across),
            ]
        };
        Meeting {
            beside: seen_from(normal, of(Of::Offset)),
            behind: seen_from(along, of(Of::Start)),
            half_width: of(Of::HalfWidth),
            length: of(Of::Length),
        }
    }

    /// Takes what a strip covers from what is left of parts of lines.
    #[inline(always)]
    fn cut<L: Lanes>(&self, lanes: L, meeting: &Meeting, left: &mut [[f32; STRIPS]; PARTS]) {
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let (half_width, length) = (meeting.half_width, meeting.length);
        for first in (0..STRIPS).step_by(L::WIDTH) {
            let off = lanes.load(&self.off[first..]);
            let sides = places(off, meeting.beside, [-half_width, half_width]);
            let ends = places(off, meeting.behind, [0.0, length]);
            let (from, parts) = (
                lanes.load(&self.from[first..]),
                lanes.load(&self.parts[first..]),
            );
            let enters = (sides[0].max(ends[0]) - from) * parts;
            let leaves = (sides[1].min(ends[1]) - from) * parts;
            for (i, left) in left.iter_mut().enumerate() {
                let (to, from) = (
                    within(none, leaves - i as f32),
                    within(none, enters - i as f32),
                );
                let covered = (to - from).max(none);
                let left = &mut left[first..];
                lanes.store(lanes.load(left) * (one - covered), left);
            }
        }
    }
}

/// A number of [`Lanes::WIDTH`] strips.
#[inline(always)]
fn load<L: Lanes>(lanes: L, eight: &Eight, number: Of, first: usize) -> L::F {
    lanes.load(&eight[number as usize][first..])
}

/// Where lines so far off the middle are between two bounds, from how far the middle's start is, and how that changes to its
/// end and to its right.
#[inline(always)]
fn places<F: Number>(off: F, [at, slope, right]: [f32; 3], [first, last]: [f32; 2]) -> [F; 2] {
    let per_way = 1.0 / not_nothing(slope);
    let here = off * right + at;
    let (a, b) = ((-here + first) * per_way, (-here + last) * per_way);
    [a.min(b), a.max(b)]
}

/// No less than nothing and no more than 1.
#[inline(always)]
fn within<F: Number>(none: F, at: F) -> F {
    at.max(none).min(none.like(1.0))
}

#[inline(always)]
fn not_nothing<F: Number>(slope: F) -> F {
    let least = slope.like(LEAST);
    (slope * slope).if_above(least * least, slope, least)
}

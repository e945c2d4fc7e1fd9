//! What of a scratch later ones cover within a footprint that holds many, line by line along it: exactly where one does, and as
//! if independently of one another where several meet in the same part of a line.

mod average;

use super::region::Region;
use super::strips::{STRIPS, Strips};
use crate::lanes::{Lanes, Number, in_lanes};
use crate::single;
use arrayvec::ArrayVec;
use glam::{DVec2, Vec2};

/// Strips that lie side by side in memory.
const EIGHT: usize = 8;

/// Eights of strips that are remembered: what lies under more of them is covered as it is on average.
const MOST_EIGHTS: usize = 96;

/// Up to so many strips are looked at line by line. What lies under more, of which little is left, is told by the average.
const MOST_BY_LINES: usize = 192;

/// Parts of a line, in each of which what covers it does so independently.
const PARTS: usize = 4;

/// Slopes are no less than this, so that parallel lines have a ratio.
const LEAST: f32 = 1e-15;
const LEAST_SLOPE: f64 = 1e-200;

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

/// Where strips' middles are, from -1 to 1 across the scratch.
const OFF_MIDDLE: [f64; STRIPS] = [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375, 0.625, 0.875];

/// Number by number.
type Eight = [[f32; EIGHT]; NUMBERS];

/// Strips that were laid, the latest first; mm.
#[derive(Debug)]
pub(super) struct Laid {
    eights: ArrayVec<Eight, MOST_EIGHTS>,
    count: usize,
}

impl Laid {
    pub(super) fn new() -> Self {
        Self {
            eights: ArrayVec::new(),
            count: 0,
        }
    }

    /// What all strips leave of each line of a way, as a share of all of the chord.
    pub(super) fn left_of(&self, way: &Way) -> Strips {
        if self.count > MOST_BY_LINES {
            let half_width = single(way.half_width_mm).max(LEAST);
            let middle = way.middle();
            let left =
                in_lanes!(lanes => average::left_of(lanes, &self.eights, middle, half_width));
            return way.whole().map(|whole| whole * left);
        }
        let lines = Lines::of(way);
        let left = in_lanes!(lanes => lines.left(lanes, &self.eights));
        let whole = way.whole();
        core::array::from_fn(|i| left[i] * whole[i])
    }

    /// Lays a chord under the others; false if there is no room.
    pub(super) fn lay(&mut self, way: &Way) -> bool {
        let place = self.count % EIGHT;
        if place == 0 && self.eights.try_push([[0.0; EIGHT]; NUMBERS]).is_err() {
            return false;
        }
        let (start, along) = (way.start, way.along);
        let normal = along.perp();
        let Some(eight) = self.eights.last_mut() else {
            return false;
        };
        for (number, value) in [
            (Of::NormalX, normal.x),
            (Of::NormalY, normal.y),
            (Of::Offset, normal.dot(start)),
            (Of::HalfWidth, way.half_width_mm),
            (Of::AlongX, along.x),
            (Of::AlongY, along.y),
            (Of::Start, along.dot(start)),
            (Of::Length, along.dot(way.end - start)),
        ] {
            eight[number as usize][place] = single(value);
        }
        self.count += 1;
        true
    }
}

/// What of a straight chord of scratch lies in a footprint: lines along it, each in the middle of its strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// mm.
    start: DVec2,
    end: DVec2,
    /// Unit direction.
    along: DVec2,
    half_width_mm: f64,
    /// Where each line enters and leaves the footprint, as shares of the chord; nowhere unless to > from.
    from: [f64; STRIPS],
    to: [f64; STRIPS],
    /// From where to where any does.
    pub stretch: [f64; 2],
}

impl Way {
    /// Nothing if none of it does.
    pub(super) fn within(footprint: &Region, [a, b]: [DVec2; 2], width_mm: f64) -> Option<Self> {
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
    fn middle(&self) -> [DVec2; 2] {
        self.stretch.map(|share| self.start.lerp(self.end, share))
    }

    /// What of the chord each line has in the footprint.
    pub(super) fn whole(&self) -> Strips {
        core::array::from_fn(|i| single(self.to[i] - self.from[i]))
    }
}

/// Lines along a way, single.
struct Lines {
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
    fn of(way: &Way) -> Self {
        let [start, end] = way.middle();
        let [first, last] = way.stretch;
        let per_way = 1.0 / (last - first);
        let half_width = single(way.half_width_mm);
        let mut lines = Self {
            start: start.as_vec2(),
            way: (end - start).as_vec2(),
            across: -way.along.perp().as_vec2(),
            half_width,
            off: OFF_MIDDLE.map(|off| half_width * single(off)),
            from: way.from.map(|at| single((at - first) * per_way)),
            parts: Strips::default(),
            common: [0.0, 1.0],
            mean: [0.0; 2],
        };
        let (mut count, mut sums) = (0.0, [0.0; 2]);
        for (i, whole) in way.whole().into_iter().enumerate() {
            let length = whole * single(per_way);
            let is_held = length > 0.0;
            let (from, to) = (lines.from[i], lines.from[i] + length);
            let [begun, ends] = lines.common;
            if is_held {
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
    fn left<L: Lanes>(&self, lanes: L, eights: &[Eight]) -> Strips {
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
        let per_way = lanes.all(1.0) / average::not_nothing(lanes, slope);
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

fn not_nothing(slope: f32) -> f32 {
    if slope.abs() > LEAST { slope } else { LEAST }
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
        let footprint = Region::parallelogram(10.0 * DVec2::X, 10.0 * DVec2::Y);
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
                let way = Way::within(&footprint, [start, end], 2.0 * half_width).unwrap();
                let left = laid.left_of(&way).iter().sum::<f32>() / STRIPS as f32;
                let left = f64::from(left);
                assert!(laid.lay(&way), "no room for strip {i}");
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
        let footprint = Region::parallelogram(200.0 * DVec2::X, 200.0 * DVec2::Y);
        for i in 0..MOST_EIGHTS * EIGHT {
            let y = 0.1 * i as f64;
            let ends = [DVec2::new(-1e3, y), DVec2::new(1e3, y)];
            let way = Way::within(&footprint, ends, 0.0999).unwrap();
            assert_eq!(laid.left_of(&way), way.whole(), "strip {i}");
            assert!(laid.lay(&way), "no room for strip {i}");
        }
        let way = Way::within(&footprint, [DVec2::ZERO, DVec2::X], 0.1).unwrap();
        assert!(!laid.lay(&way), "there is no end of room");
    }
}

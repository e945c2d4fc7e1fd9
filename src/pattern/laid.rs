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
        core::array::from_fn(|i| left[i] * single(way.to[i] - way.from[i]))
    }

    /// Lays a chord under the others; false if there is no room.
    pub(super) fn lay(&mut self, way: &Way) -> bool {
        let [start, end] = way.chord;
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
            (Of::HalfWidth, way.half_width_mm),
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

/// What of a straight chord of scratch lies in a footprint: lines along it, each in the middle of its strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// mm.
    chord: [DVec2; 2],
    half_width_mm: f64,
    /// Where each line enters and leaves the footprint, as shares of the chord; nowhere unless to > from.
    from: [f64; STRIPS],
    to: [f64; STRIPS],
}

impl Way {
    /// Nothing if none of it does.
    pub(super) fn within(footprint: &Region, chord: [DVec2; 2], width_mm: f64) -> Option<Self> {
        let [a, b] = chord;
        let half_width_mm = 0.5 * width_mm;
        let across = half_width_mm * to_the_right(b - a);
        let mut way = Self {
            chord,
            half_width_mm,
            from: [0.0; STRIPS],
            to: [1.0; STRIPS],
        };
        for (p, q) in footprint.edges() {
            let edge = q - p;
            let [at_a, at_b, beside] = [a - p, b - p, across].map(|v| edge.perp_dot(v));
            let slope = at_b - at_a;
            for (i, (from, to)) in way.from.iter_mut().zip(&mut way.to).enumerate() {
                let at = at_a + beside * off_middle(i);
                let place = -at / slope;
                match slope {
                    _ if slope > 0.0 => *from = from.max(place),
                    _ if slope < 0.0 => *to = to.min(place),
                    _ if at < 0.0 => *to = f64::NEG_INFINITY,
                    _ => {}
                }
            }
        }
        let mut is_held = false;
        for (from, to) in way.from.iter_mut().zip(&mut way.to) {
            match to > from {
                true => is_held = true,
                false => (*from, *to) = (0.0, 0.0),
            }
        }
        is_held.then_some(way)
    }

    /// From where to where any line lies in the footprint, as shares of the chord.
    pub(super) fn stretch(&self) -> [f64; 2] {
        let held = self
            .from
            .iter()
            .zip(&self.to)
            .filter(|(from, to)| to > from);
        held.fold([1.0, 0.0], |[first, last], (from, to)| {
            [from.min(first), to.max(last)]
        })
    }

    /// What of the chord's own line lies beside what lines have in the footprint.
    fn middle(&self) -> [DVec2; 2] {
        let [start, end] = self.chord;
        self.stretch().map(|share| start.lerp(end, share))
    }

    /// What of the chord each line has in the footprint.
    pub(super) fn whole(&self) -> Strips {
        core::array::from_fn(|i| single(self.to[i] - self.from[i]))
    }
}

fn to_the_right(travel: DVec2) -> DVec2 {
    let along = travel.normalize_or(DVec2::X);
    DVec2::new(along.y, -along.x)
}

/// Where a strip's middle is, from -1 to 1 across the scratch.
fn off_middle(strip: usize) -> f64 {
    (2 * strip + 1) as f64 / STRIPS as f64 - 1.0
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
        let [a, b] = way.chord;
        let [first, last] = way.stretch();
        let (start, end) = (a.lerp(b, first), a.lerp(b, last));
        let share = |at: f64| (at - first) / (last - first);
        let parts = |i: usize| PARTS as f64 / (share(way.to[i]) - share(way.from[i]));
        let held = |i: usize| way.to[i] > way.from[i];
        Self {
            start: start.as_vec2(),
            way: (end - start).as_vec2(),
            across: to_the_right(b - a).as_vec2(),
            half_width: single(way.half_width_mm),
            off: core::array::from_fn(|i| single(way.half_width_mm * off_middle(i))),
            from: core::array::from_fn(|i| single(share(way.from[i]))),
            parts: core::array::from_fn(|i| if held(i) { single(parts(i)) } else { 0.0 }),
        }
    }

    /// The share of each that strips leave.
    #[inline(always)]
    fn left<L: Lanes>(&self, lanes: L, eights: &[Eight]) -> Strips {
        let mut left = [[1.0; STRIPS]; PARTS];
        for eight in eights {
            for first in (0..EIGHT).step_by(L::WIDTH) {
                let touches = self.touches(lanes, eight, first);
                if !touches.any() {
                    continue;
                }
                for lane in 0..L::WIDTH {
                    if touches.lane(lane) > 0.0 {
                        self.cut(lanes, &self.meeting(eight, first + lane), &mut left);
                    }
                }
            }
        }
        core::array::from_fn(|i| left.iter().map(|part| part[i]).sum::<f32>() / PARTS as f32)
    }

    /// Above 0 for strips that may cover any of it.
    #[inline(always)]
    fn touches<L: Lanes>(&self, lanes: L, eight: &Eight, first: usize) -> L::F {
        let load = |number: Of| lanes.load(&eight[number as usize][first..]);
        let dot = |[x, y]: [L::F; 2], v: Vec2| x * v.x + y * v.y;
        let normal = [load(Of::NormalX), load(Of::NormalY)];
        let from = dot(normal, self.start) - load(Of::Offset);
        let to = from + dot(normal, self.way);
        let near = load(Of::HalfWidth) + self.half_width;
        let beside = (near - from.min(to)).min(near + from.max(to));
        let along = [load(Of::AlongX), load(Of::AlongY)];
        let from = dot(along, self.start) - load(Of::Start);
        let to = from + dot(along, self.way);
        let before = from.max(to) + self.half_width;
        let behind = load(Of::Length) + self.half_width - from.min(to);
        beside.min(before).min(behind)
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
            let places = |[at, slope, right]: [f32; 3], bounds: [f32; 2]| {
                let per_way = 1.0 / not_nothing(slope);
                let here = off * right + at;
                let [a, b] = bounds.map(|bound| (-here + bound) * per_way);
                [a.min(b), a.max(b)]
            };
            let sides = places(meeting.beside, [-half_width, half_width]);
            let ends = places(meeting.behind, [0.0, length]);
            let (from, parts) = (
                lanes.load(&self.from[first..]),
                lanes.load(&self.parts[first..]),
            );
            let enters = (sides[0].max(ends[0]) - from) * parts;
            let leaves = (sides[1].min(ends[1]) - from) * parts;
            for (i, left) in left.iter_mut().enumerate() {
                let within = |at: L::F| (at - i as f32).max(none).min(one);
                let covered = (within(leaves) - within(enters)).max(none);
                let left = &mut left[first..];
                lanes.store(lanes.load(left) * (one - covered), left);
            }
        }
    }
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

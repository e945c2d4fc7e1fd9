//! How later strips meet one, in single precision: one of them, or eight at a time.

use super::cover::SHORT;
use crate::lanes::{Lanes, Number};
use crate::single;

/// Numbers by which a strip is seen.
pub(super) const NUMBERS: usize = 11;

/// Strips that lie side by side.
pub(super) const EIGHT: usize = 8;

/// Eight strips: ends, normal, offset, half width, length and way.
pub(super) type Numbers = [[f32; EIGHT]; NUMBERS];

/// On one side of every strip.
pub(super) const NOWHERE: [f64; NUMBERS] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0];

/// Strips at a smaller angle to one another (its sine) are nearly parallel, however thin they are.
const LEAST_SIN: f32 = 1.0 / 64.0;

/// Single precision tells on which side of a line a place lies up to this share of the largest coordinate.
const SIDE: f64 = 1e-6;

/// Where strips cross it tells up to this share.
pub(super) const PLACE: f64 = 1e-4;

/// A strip, or eight, seen from the middle of a box.
pub(super) struct Seen<F> {
    /// Start and end of the part of it that may lie in the box.
    ends: [[F; 2]; 2],
    normal: [F; 2],
    /// How far the origin lies to the left of the centre line.
    offset: F,
    half_width: F,
    /// Of all of it.
    length: F,
    /// Where that part starts, and how far it goes, in quarters of it all.
    way: [F; 2],
}

/// The box, and how far single precision may be off in it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Window<F> {
    half_size: [F; 2],
    side: F,
    place: F,
}

/// How strips meet one.
pub(super) struct Meeting<F> {
    /// The share of each quarter that each covers.
    pub quarters: [F; 4],
    /// Above 0 if single precision cannot tell.
    pub unsure: F,
}

impl Window<f32> {
    /// A box that strips up to this half width lie in.
    pub(super) fn new(half_size: [f64; 2], half_width: f64) -> Self {
        let farthest = half_size[0].max(half_size[1]) + half_width;
        Self {
            half_size: half_size.map(single),
            side: single(SIDE * farthest),
            place: single(PLACE * farthest),
        }
    }
}

impl<F> Window<F> {
    #[inline(always)]
    pub(super) fn map<G>(&self, of: impl Fn(&F) -> G) -> Window<G> {
        Window {
            half_size: self.half_size.each_ref().map(&of),
            side: of(&self.side),
            place: of(&self.place),
        }
    }
}

impl<F: Number> Seen<F> {
    /// One of eight strips, in each place.
    #[inline(always)]
    pub(super) fn one<L: Lanes<F = F>>(lanes: L, numbers: &Numbers, place: usize) -> Self {
        Self::of(numbers, |eight| lanes.all(eight[place]))
    }

    /// As many of eight strips as there are lanes, from one on.
    #[inline(always)]
    pub(super) fn some<L: Lanes<F = F>>(lanes: L, numbers: &Numbers, first: usize) -> Self {
        Self::of(numbers, |eight| lanes.load(&eight[first..]))
    }

    /// Number by number, not by `map`: what is not written out stays in memory.
    #[inline(always)]
    fn of(numbers: &Numbers, number: impl Fn(&[f32; EIGHT]) -> F) -> Self {
        let [x, y, to_x, to_y, normal_x, normal_y, rest @ ..] = numbers;
        let [offset, half_width, length, start, way] = rest;
        Self {
            ends: [[number(x), number(y)], [number(to_x), number(to_y)]],
            normal: [number(normal_x), number(normal_y)],
            offset: number(offset),
            half_width: number(half_width),
            length: number(length),
            way: [number(start), number(way)],
        }
    }

    /// How others meet it in a window; none if none of them comes near.
    #[inline(always)]
    pub(super) fn met_by(&self, others: &Self, window: &Window<F>) -> Option<Meeting<F>> {
        let [from, to] = others.sides_of(&self.ends);
        let [others_from, others_to] = self.sides_of(&others.ends);
        // Below 0 if each has an end on the one side of the other's centre line; not so if on the other side.
        let low = from.min(to).max(others_from.min(others_to));
        let high = from.max(to).min(others_from.max(others_to));
        let widths = self.half_width + others.half_width;
        let near = widths + window.side - low.max(-high);
        if !near.any() {
            return None;
        }
        let (zero, one) = (near.like(0.0), near.like(1.0));
        let crosses = zero.if_above(low, zero.if_above(high, zero, one), zero);
        let sin = self.normal[0] * others.normal[1] - self.normal[1] * others.normal[0];
        let sin = sin.max(-sin);
        let short = self.length.min(others.length);
        let steep = sin * short - (widths * single(2.0 / SHORT)).max(short * LEAST_SIN);
        let place = from / (from - to);
        let outside = self.outside(place, window);
        let on_border = window.place.if_above(outside.max(-outside), crosses, zero);
        let parallel = near.if_above(zero, one, zero);
        let inside = (-outside).if_above(window.place, crosses, zero);
        let sure = steep.if_above(zero, inside, zero);
        // As far to both sides of the place, but within the strip.
        let half = (others.half_width * 4.0 / (sin * self.length)).min(near.like(2.0));
        let middle = (self.way[0] + place * self.way[1])
            .max(half)
            .min(-half + 4.0);
        let from = sure.if_above(zero, middle - half, zero);
        let to = sure.if_above(zero, middle + half, zero);
        let before = |i: f32| to.min(near.like(i)) - from.min(near.like(i));
        let (first, second, third) = (before(1.0), before(2.0), before(3.0));
        Some(Meeting {
            quarters: [first, second - first, third - second, to - from - third],
            unsure: steep.if_above(zero, on_border, parallel),
        })
    }

    /// How far places lie to the left of its centre line.
    #[inline(always)]
    fn sides_of(&self, places: &[[F; 2]; 2]) -> [F; 2] {
        let [x, y] = self.normal;
        let side = |place: [F; 2]| x.times_plus(place[0], y.times_plus(place[1], self.offset));
        [side(places[0]), side(places[1])]
    }

    /// How far a place on it, by its share of the way from end to end, lies outside a window.
    #[inline(always)]
    fn outside(&self, place: F, window: &Window<F>) -> F {
        let [start, end] = self.ends;
        let beyond = |axis: usize| {
            let at = start[axis] + place * (end[axis] - start[axis]);
            at.max(-at) - window.half_size[axis]
        };
        beyond(0).max(beyond(1))
    }
}

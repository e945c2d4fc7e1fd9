//! What a scratch's cross-section depends on, as a function of arc length.

use super::scratch::Key;
use super::tracks::TrackRef;
use crate::formation::DepthLaw;
use crate::single;
use std::collections::HashMap;

/// Courses of all scratches, each stored once: knots (share of arc length, share of the largest value).
#[derive(Clone, Debug, Default)]
pub(crate) struct Courses {
    knots: Vec<[f32; 2]>,
    known: HashMap<Vec<[u32; 2]>, u32>,
    /// Place and length of the last one that was asked for: most scratches are like the one before.
    last: (u32, usize),
}

/// One scratch's course: linear between its knots, constant before the first and after the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Course<'p> {
    pub knots: &'p [[f32; 2]],
    /// The largest value: knots are shares of it, so that scratches of one taper share their knots.
    pub scale: f32,
}

/// The course of a scratch whose cross-sections are known by arc length itself.
pub(crate) const BY_ARC_LENGTH: [[f32; 2]; 2] = [[0.0; 2], [1.0; 2]];

/// Adds knots of what the keys state, force or depth under [`DepthLaw::Stated`], and tells the scale.
pub(crate) fn of_keys(keys: &[Key], law: DepthLaw, knots: &mut Vec<[f32; 2]>) -> f32 {
    let stated = |key: &Key| value(key, law);
    let scale = keys.iter().map(stated).fold(0.0, f64::max);
    let share = |key: &Key| {
        if scale > 0.0 {
            stated(key) / scale
        } else {
            0.0
        }
    };
    if keys.iter().all(|key| stated(key) == scale) {
        knots.push([0.0, 1.0]);
    } else {
        let all = keys.iter();
        knots.extend(all.map(|key| [single(key.at), single(share(key))]));
    }
    single(scale)
}

/// What of a key the cross-section depends on.
pub(crate) fn value(key: &Key, law: DepthLaw) -> f64 {
    match law {
        DepthLaw::Stated => key.depth_mm,
        _ => key.force_kgf,
    }
}

impl Courses {
    /// The number of the first of these knots among all.
    pub(crate) fn place(&mut self, knots: &[[f32; 2]]) -> u32 {
        let key: &[[u32; 2]] = bytemuck::cast_slice(knots);
        let (first, count) = (self.last.0 as usize, self.last.1);
        let last = self.knots.get(first..first + count);
        if count > 0 && last.is_some_and(|last| bytemuck::cast_slice::<_, [u32; 2]>(last) == key) {
            return self.last.0;
        }
        let place = self.place_of(key, knots);
        self.last = (place, knots.len());
        place
    }

    fn place_of(&mut self, key: &[[u32; 2]], knots: &[[f32; 2]]) -> u32 {
        if let Some(&known) = self.known.get(key) {
            return known;
        }
        let place = u32::try_from(self.knots.len()).unwrap_or(u32::MAX);
        self.knots.extend(knots);
        self.known.insert(key.to_vec(), place);
        place
    }

    pub(crate) fn knots(&self) -> &[[f32; 2]] {
        &self.knots
    }
}

impl Course<'_> {
    /// Whether it has one value all along.
    pub(crate) fn is_constant(&self) -> bool {
        self.knots.len() < 2
    }

    /// Whether it has one value between two shares of arc length.
    pub(crate) fn is_even(&self, [from, to]: [f64; 2]) -> bool {
        self.is_constant()
            || self.value(from) == self.value(to) && {
                let [low, high] = self.extremes(from, to);
                low == high
            }
    }

    /// Its value at a share of arc length.
    #[inline(always)]
    pub(crate) fn value(&self, at: f64) -> f64 {
        if let [only] = self.knots {
            return f64::from(only[1]) * f64::from(self.scale);
        }
        self.value_before(self.next(at), at)
    }

    /// The same, and the number of the first knot behind it.
    #[inline(always)]
    pub(crate) fn value_and_next(&self, at: f64) -> (f64, usize) {
        if let [only] = self.knots {
            return (f64::from(only[1]) * f64::from(self.scale), 0);
        }
        let next = self.next(at);
        (self.value_before(next, at), next)
    }

    /// The number of the first knot behind a share of arc length.
    fn next(&self, at: f64) -> usize {
        self.knots.partition_point(|knot| f64::from(knot[0]) <= at)
    }

    /// Its value at a place before this knot and behind the one before it.
    fn value_before(&self, next: usize, at: f64) -> f64 {
        let share = match (
            next.checked_sub(1).and_then(|i| self.knots.get(i)),
            self.knots.get(next),
        ) {
            (Some(a), Some(b)) => {
                let ([a, at_a], [b, at_b]) = (a.map(f64::from), b.map(f64::from));
                // Most of the way is even.
                if at_a == at_b {
                    at_a
                } else {
                    at_a + (at_b - at_a) * ((at - a) / (b - a))
                }
            }
            (Some(only), None) | (None, Some(only)) => only[1].into(),
            (None, None) => 0.0,
        };
        share * f64::from(self.scale)
    }

    /// Where its value changes direction between two shares of arc length: spans of places and values.
    pub(crate) fn turns(&self, from: f64, to: f64) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let scale = f64::from(self.scale);
        let next = self.next(from);
        let behind = self.knots.get(next..).unwrap_or(&[]).iter();
        let behind = behind.map(|knot| knot.map(f64::from));
        let inner = behind.take_while(move |knot| knot[0] < to);
        let ends = [[from, self.value_before(next, from)], [to, self.value(to)]];
        let mut last = ends[0];
        inner
            .map(move |[at, share]| [at, share * scale])
            .chain([ends[1]])
            .map(move |next| [core::mem::replace(&mut last, next), next])
    }

    /// Its lowest and highest value between two shares of arc length.
    pub(crate) fn extremes(&self, from: f64, to: f64) -> [f64; 2] {
        let ends = self.turns(from, to);
        ends.fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[low, high], [[_, a], [_, b]]| [low.min(a).min(b), high.max(a).max(b)],
        )
    }

    /// The mean between two shares of arc length of something that has this mean on an even way between two values.
    pub(crate) fn mean(&self, [from, to]: [f64; 2], mut mean: impl FnMut(f64, f64) -> f64) -> f64 {
        if to <= from || self.is_constant() {
            let value = self.value(from);
            return mean(value, value);
        }
        let spans = self.turns(from, to);
        let part = |[[at_a, a], [at_b, b]]: [[f64; 2]; 2]| (at_b - at_a) * mean(a, b);
        spans.map(part).sum::<f64>() / (to - from)
    }

    /// How much the cross-section changes from one share of arc length to another, all to and fro counted.
    pub(crate) fn change(&self, track: &TrackRef<'_>, from: f64, to: f64) -> f64 {
        if self.is_constant() {
            return 0.0;
        }
        let mut last = track.change(self.value(from));
        let change = |[_, [_, value]]: [[f64; 2]; 2]| {
            let next = track.change(value);
            (next - core::mem::replace(&mut last, next)).abs()
        };
        self.turns(from, to).map(change).sum()
    }
}

//! Scratches too many to be told apart: one cross-section and one direction stand for all that are alike.

use crate::lanes::{Lanes, Number};
use core::ops::Range;
use glam::Vec2;

/// Flocks of a shading point. With more of them, neighbouring directions are put together.
pub(crate) const MOST_FLOCKS: usize = 128;

/// All flocks of a shading point.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Flocks {
    /// Across travel, about 32767 long: all first components, then all second ones.
    across: [[i16; MOST_FLOCKS]; 2],
    share: [f32; MOST_FLOCKS],
    /// First slot and vertex count of the cross-section, one unit wide.
    slots: [[u8; 2]; MOST_FLOCKS],
    count: u32,
    /// The share of the pixel that the viewer sees all of them in, over the shares that they cover.
    seen_per_share: f32,
}

/// Flocks of one cross-section, side by side.
pub(super) struct Abreast<F> {
    /// As a [`Flock`]'s.
    pub across: [F; 2],
    pub share: F,
    pub shown: F,
}

/// One flock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flock {
    /// Cross-section axis, to the right of travel, in the local frame.
    pub across: Vec2,
    /// First slot and vertex count of its cross-section.
    pub slots: [u32; 2],
    /// The share of the pixel that it covers.
    pub share: f32,
    /// How often it is sampled: in all as often as the viewer sees any of them.
    pub shown: f32,
}

impl Flock {
    /// Where its cross-section is kept.
    pub(crate) fn range(&self) -> Range<usize> {
        let [first, count] = self.slots.map(|slot| slot as usize);
        first..first + count
    }
}

impl Flocks {
    pub(crate) const NONE: Self = Self {
        across: [[0; MOST_FLOCKS]; 2],
        share: [0.0; MOST_FLOCKS],
        slots: [[0; 2]; MOST_FLOCKS],
        count: 0,
        seen_per_share: 0.0,
    };

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.count = 0;
        self.seen_per_share = 0.0;
    }

    pub(crate) fn push(&mut self, flock: &Flock) {
        let i = self.count as usize;
        if i < MOST_FLOCKS {
            [self.across[0][i], self.across[1][i]] = flock.across.to_array().map(packed);
            self.share[i] = flock.share;
            self.slots[i] = flock.slots.map(|slot| u8::try_from(slot).unwrap_or(0));
            self.count += 1;
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Flock> {
        (0..self.len()).map(|i| Flock {
            // Rounded ones are a little longer or shorter than 1, and what is turned by them would be.
            across: Vec2::from(self.across.map(|components| f32::from(components[i])))
                .normalize_or(Vec2::X),
            slots: self.slots[i].map(u32::from),
            share: self.share[i],
            shown: self.share[i] * self.seen_per_share,
        })
    }

    fn len(&self) -> usize {
        (self.count as usize).min(MOST_FLOCKS)
    }

    /// Each cross-section's first slot and vertex count, and the numbers of its flocks.
    pub(super) fn classes(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let mut next = 0;
        self.slots[..self.len()]
            .chunk_by(PartialEq::eq)
            .map(move |slots| {
                let flocks = next..next + slots.len();
                next = flocks.end;
                let [first, count] = slots[0].map(usize::from);
                (first..first + count, flocks)
            })
    }

    /// As many flocks as there are lanes, from the first of `flocks` on. Those beyond its end cover nothing.
    #[inline(always)]
    pub(super) fn abreast<L: Lanes>(&self, lanes: L, flocks: Range<usize>) -> Abreast<L::F> {
        // The last ones are read together with some before.
        let first = flocks.start.min(MOST_FLOCKS - L::WIDTH);
        let [xs, ys] = &self.across;
        let x = lanes.made(|i| f32::from(xs[first + i]));
        let y = lanes.made(|i| f32::from(ys[first + i]));
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let length = (x * x + y * y).sqrt();
        let over = length.if_above(none, one / length, none);
        let ends = [flocks.start, flocks.end].map(|end| end as f32 - 0.5);
        let number = lanes.made(|i| i as f32) + first as f32;
        let own = number.if_above(lanes.all(ends[0]), lanes.load(&self.share[first..]), none);
        let share = lanes.all(ends[1]).if_above(number, own, none);
        Abreast {
            across: [length.if_above(none, x * over, one), y * over],
            share,
            shown: share * self.seen_per_share,
        }
    }

    /// Sets in what share of the pixel the viewer sees all of them.
    pub(crate) fn set_seen(&mut self, seen: f32) {
        let shares: f32 = self.share[..self.count as usize].iter().sum();
        self.seen_per_share = if shares > 0.0 { seen / shares } else { 0.0 };
    }

    /// Thins all of them.
    pub(crate) fn scale(&mut self, by: f32) {
        self.share[..self.count as usize]
            .iter_mut()
            .for_each(|share| *share *= by);
    }
}

#[expect(clippy::cast_possible_truncation, reason = "-1 to 1 times 32767 fits")]
fn packed(component: f32) -> i16 {
    (component * 32767.0).round() as i16
}

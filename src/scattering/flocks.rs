//! Scratches too many to be told apart: one cross-section and one direction stand for all that are alike.

use glam::Vec2;

/// Flocks of a shading point. With more of them, neighbouring directions are put together.
pub(crate) const MOST_FLOCKS: usize = 128;

/// All flocks of a shading point.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Flocks {
    /// Across travel, about 32767 long.
    across: [[i16; 2]; MOST_FLOCKS],
    share: [f32; MOST_FLOCKS],
    /// First slot and vertex count of the cross-section, one unit wide.
    slots: [[u8; 2]; MOST_FLOCKS],
    count: u32,
    /// The share of the pixel that the viewer sees all of them in, over the shares that they cover.
    seen_per_share: f32,
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
    pub(crate) fn range(&self) -> core::ops::Range<usize> {
        let [first, count] = self.slots.map(|slot| slot as usize);
        first..first + count
    }
}

impl Flocks {
    pub(crate) const NONE: Self = Self {
        across: [[0; 2]; MOST_FLOCKS],
        share: [0.0; MOST_FLOCKS],
        slots: [[0; 2]; MOST_FLOCKS],
        count: 0,
        seen_per_share: 0.0,
    };

    pub(crate) fn clear(&mut self) {
        self.count = 0;
        self.seen_per_share = 0.0;
    }

    pub(crate) fn push(&mut self, flock: &Flock) {
        let i = self.count as usize;
        if i < MOST_FLOCKS {
            self.across[i] = flock.across.to_array().map(packed);
            self.share[i] = flock.share;
            self.slots[i] = flock.slots.map(|slot| u8::try_from(slot).unwrap_or(0));
            self.count += 1;
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Flock> {
        (0..(self.count as usize).min(MOST_FLOCKS)).map(|i| Flock {
            // Rounded ones are a little longer or shorter than 1, and what is turned by them would be.
            across: Vec2::from(self.across[i].map(f32::from)).normalize_or(Vec2::X),
            slots: self.slots[i].map(u32::from),
            share: self.share[i],
            shown: self.share[i] * self.seen_per_share,
        })
    }

    /// The share of the pixel that the viewer sees all of them in.
    pub(crate) fn seen(&self) -> f32 {
        self.iter().map(|flock| flock.shown).sum()
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

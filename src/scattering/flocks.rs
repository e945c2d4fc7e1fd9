//! Scratches too many to be told apart: one cross-section and one direction stand for all that are alike.

mod packed;

use crate::lanes::{Lanes, Number};
use crate::pattern::{MOST_CLASSES, STRIPS, Strips};
use core::ops::Range;
use glam::Vec2;
use packed::WORDS;

/// Flocks of a shading point. With more of them, neighbouring directions are put together.
pub(crate) const MOST_FLOCKS: usize = 128;

/// All flocks of a shading point.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Flocks {
    across: [u16; MOST_FLOCKS],
    /// The share of the pixel that each would cover if all its strips were like the fullest one.
    full: [u16; MOST_FLOCKS],
    /// How full strips are.
    strips: [[u16; MOST_FLOCKS]; WORDS],
    /// Cross-sections, each one unit wide: first slot, vertex count, and where its flocks end, which follow those of the one
    /// before. Without flocks there is none.
    classes: [[u8; 3]; MOST_CLASSES],
    /// How far crowding thins all of them.
    gain: f32,
    /// The share of the pixel that the viewer sees all of them in, over the shares that they cover.
    seen_per_share: f32,
}

/// Flocks of one cross-section, side by side.
pub(super) struct Abreast<F> {
    /// As a [`Flock`]'s.
    pub across: [F; 2],
    pub share: F,
    pub strips: [F; STRIPS],
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
    /// What strips of its cross-section have of that, from left to right.
    pub strips: Strips,
    /// How often it is sampled: in all as often as the viewer sees any of them.
    pub shown: f32,
}

impl Flock {
    /// Where its cross-section is kept.
    pub(crate) fn range(&self) -> Range<usize> {
        let [first, count] = self.slots.map(|slot| slot as usize);
        first..first + count
    }

    /// The share of the pixel that it would cover if all of it were like what lies over these strips.
    pub(super) fn share_over(&self, strips: &Over) -> f32 {
        STRIPS as f32 * strips.mean(&self.strips)
    }
}

/// The strips that lie under a part of a cross-section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Over {
    /// The first one and the last.
    ends: [u8; 2],
    /// What of the part lies over them, and over each in between.
    shares: [f32; 3],
}

impl Over {
    /// Of what lies between two places of a cross-section one unit wide.
    #[inline(always)]
    pub(super) fn of(ends: [f32; 2]) -> Self {
        let [from, to] = ends.map(|x| (x + 0.5) * STRIPS as f32);
        let ends @ [first, last] = [from, to].map(strip_at);
        let each = 1.0 / (to - from);
        let shares = match first < last {
            true => [f32::from(first + 1) - from, to - f32::from(last), 1.0].map(|at| at * each),
            // Also of a wall, or of what hangs over.
            false => [1.0, 0.0, 0.0],
        };
        Self { ends, shares }
    }

    /// The mean of strips' numbers.
    #[inline(always)]
    pub(super) fn mean<F: Number>(&self, strips: &[F; STRIPS]) -> F {
        let [first, last] = self.ends.map(|strip| usize::from(strip) % STRIPS);
        let mut sum = strips[first] * self.shares[0];
        if first < last {
            for strip in &strips[first + 1..last] {
                sum = strip.times_plus(sum.like(self.shares[2]), sum);
            }
            sum = strips[last].times_plus(sum.like(self.shares[1]), sum);
        }
        sum
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
#[inline(always)]
fn strip_at(place: f32) -> u8 {
    (place as u8).min(STRIPS as u8 - 1)
}

impl Flocks {
    pub(crate) const NONE: Self = Self {
        across: [0; MOST_FLOCKS],
        full: [0; MOST_FLOCKS],
        strips: [[0; MOST_FLOCKS]; WORDS],
        classes: [[0; 3]; MOST_CLASSES],
        gain: 1.0,
        seen_per_share: 0.0,
    };

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.classes = [[0; 3]; MOST_CLASSES];
        self.gain = 1.0;
        self.seen_per_share = 0.0;
    }

    /// Adds one; those of one cross-section one after the other.
    pub(crate) fn push(&mut self, flock: &Flock) {
        let held = self.classes.iter().take_while(|[.., end]| *end > 0).count();
        let end = held.checked_sub(1).map_or(0, |last| self.classes[last][2]);
        let [first, count] = flock.slots.map(|slot| u8::try_from(slot).unwrap_or(0));
        let is_new = held == 0 || self.classes[held - 1][..2] != [first, count];
        let (i, class) = (usize::from(end), if is_new { held } else { held - 1 });
        if i < MOST_FLOCKS && class < MOST_CLASSES {
            self.classes[class] = [first, count, end + 1];
            self.across[i] = packed::across(flock.across);
            let levels = packed::levels(&flock.strips);
            // What they are rounded to adds up to as much.
            let all: f32 = levels
                .iter()
                .map(|level| packed::fullness(f32::from(*level)))
                .sum();
            self.full[i] = packed::share(flock.share * STRIPS as f32 / all);
            for (word, strips) in self.strips.iter_mut().zip(packed::words(&levels)) {
                word[i] = strips;
            }
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.classes[0][2] == 0
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Flock> {
        let of_class = move |(slots, flocks): (Range<usize>, Range<usize>)| {
            let slots = [slots.start, slots.len()].map(|slot| u32::try_from(slot).unwrap_or(0));
            flocks.map(move |i| self.flock(i, slots))
        };
        self.classes().flat_map(of_class)
    }

    fn flock(&self, i: usize, slots: [u32; 2]) -> Flock {
        let words = self.strips.each_ref().map(|word| f32::from(word[i]));
        let full = self.gain * packed::unpacked_share(self.full[i]) / STRIPS as f32;
        let strips = packed::fullnesses(words).map(|fullness| full * fullness);
        let share = strips.iter().sum();
        Flock {
            // Rounded ones are a little longer or shorter than 1, and what is turned by them would be.
            across: Vec2::from(packed::unpacked_across(self.across[i])).normalize_or(Vec2::X),
            slots,
            share,
            strips,
            shown: share * self.seen_per_share,
        }
    }

    /// Each cross-section's slots, and the numbers of its flocks.
    pub(super) fn classes(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let mut next = 0;
        let held = self.classes.iter().map(|class| class.map(usize::from));
        held.take_while(|[.., end]| *end > 0)
            .map(move |[first, count, end]| {
                let flocks = next..end.min(MOST_FLOCKS);
                next = flocks.end;
                (first..first + count, flocks)
            })
    }

    /// As many flocks as there are lanes, from the first of `flocks` on. Those beyond its end cover nothing.
    #[inline(always)]
    pub(super) fn abreast<L: Lanes>(&self, lanes: L, flocks: Range<usize>) -> Abreast<L::F> {
        // The last ones are read together with some before.
        let first = flocks.start.min(MOST_FLOCKS - L::WIDTH);
        let x = lanes.made(|i| packed::unpacked_across(self.across[first + i])[0]);
        let y = lanes.made(|i| packed::unpacked_across(self.across[first + i])[1]);
        let (none, one) = (lanes.all(0.0), lanes.all(1.0));
        let length = (x * x + y * y).sqrt();
        let over = length.if_above(none, one / length, none);
        let ends = [flocks.start, flocks.end].map(|end| end as f32 - 0.5);
        let number = lanes.made(|i| i as f32) + first as f32;
        let full = lanes.made(|i| packed::unpacked_share(self.full[first + i])) * self.gain;
        let own = number.if_above(lanes.all(ends[0]), full, none);
        let full = lanes.all(ends[1]).if_above(number, own, none);
        let [a, b, c] = &self.strips;
        // Not by `map`, which would not be written into code for registers.
        let words = [
            lanes.load_whole(&a[first..]),
            lanes.load_whole(&b[first..]),
            lanes.load_whole(&c[first..]),
        ];
        let mut strips = packed::fullnesses(words);
        let mut share = none;
        for strip in &mut strips {
            *strip = *strip * full;
            share = share + *strip;
        }
        let share = share / STRIPS as f32;
        Abreast {
            across: [length.if_above(none, x * over, one), y * over],
            share,
            strips,
            shown: share * self.seen_per_share,
        }
    }

    /// Sets in what share of the pixel the viewer sees all of them, of the share that they cover.
    pub(crate) fn set_seen(&mut self, seen: f32, share: f32) {
        self.seen_per_share = if share > 0.0 { seen / share } else { 0.0 };
    }

    /// Thins all of them.
    pub(crate) fn scale(&mut self, by: f32) {
        self.gain *= by;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means between places add up to the whole, whatever they are cut into; of one place it is its strip's.
    #[test]
    fn means_add_up() {
        let strips = [1.0, 0.0, 3.0, 2.0, 5.0, 0.5, 0.0, 4.0];
        let whole: f32 = strips.iter().sum::<f32>() / STRIPS as f32;
        let mean = |ends| Over::of(ends).mean(&strips);
        assert!((mean([-0.5, 0.5]) - whole).abs() < 1e-6, "the whole");
        for cut in [-0.49_f32, -0.375, -0.3, 0.0, 0.2, 0.37] {
            let [left, right] =
                [[-0.5, cut], [cut, 0.5]].map(|ends| (ends[1] - ends[0]) * mean(ends));
            assert!((left + right - whole).abs() < 1e-6, "cut at {cut}");
        }
        assert_eq!(mean([0.1, 0.1]), 5.0, "a wall");
        assert_eq!(mean([0.5, 0.5]), 4.0, "the last end");
    }

    /// What is added comes back: as much in all, and shared out between strips within a hundredth of the fullest.
    #[test]
    fn strips_come_back() {
        let mut flocks = Flocks::NONE;
        let strips = [0.1, 0.0, 0.3, 0.2, 0.05, 0.05, 0.1, 0.2];
        for (share, slots) in [(0.3, [0, 5]), (1e-4, [0, 5]), (0.9, [5, 9])] {
            flocks.push(&Flock {
                across: Vec2::Y,
                slots,
                share,
                strips,
                shown: 0.0,
            });
        }
        let classes: Vec<_> = flocks.classes().collect();
        assert_eq!(classes, [(0..5, 0..2), (5..14, 2..3)], "cross-sections");
        for (flock, share) in flocks.iter().zip([0.3, 1e-4, 0.9]) {
            assert!((flock.share / share - 1.0).abs() < 2.5e-4, "{flock:?}");
            for (found, wanted) in flock.strips.iter().zip(strips) {
                assert!((found / share - wanted).abs() < 0.015 * 0.3, "{flock:?}");
            }
        }
        flocks.clear();
        assert!(
            flocks.is_empty() && flocks.iter().next().is_none(),
            "none is left"
        );
    }
}

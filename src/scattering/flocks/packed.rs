//! Numbers of flocks in few bits.

use crate::lanes::Number;
use crate::pattern::{STRIPS, Strips};
use glam::Vec2;

/// How full a strip is, next to the fullest one, is one of so many steps.
const STEPS: f32 = 39.0;

/// Those and none.
const LEVELS: f32 = STEPS + 1.0;

/// Strips to a word, and words.
const PER_WORD: usize = 3;
pub(super) const WORDS: usize = STRIPS.div_ceil(PER_WORD);

/// The emptiest strip still counts a little, so that there is something to be sampled whichever of them are seen.
const EMPTIEST: f32 = 1e-3;

/// What is added to this, be it below 0, is rounded to the nearest whole number.
const WHOLE: f32 = (3 << 22) as f32;

/// Half a circle of directions, in steps.
const HALF: f32 = 16383.0;

/// Bits of a share's mantissa.
const MANTISSA: u32 = 11;

/// The lowest share but 0: shares reach from 2^-29 up to 8.
const LOWEST: u32 = 98 << MANTISSA;

/// A direction: the sum of its components' absolute values is 1, the first one says where it is, the last bit whether the
/// second is below 0.
pub(super) fn across(across: Vec2) -> u16 {
    let [x, y] = across.to_array();
    let at = x / (x.abs() + y.abs()).max(f32::MIN_POSITIVE);
    (whole((at + 1.0) * HALF) << 1) | u16::from(y < 0.0)
}

/// It, of any length.
#[inline(always)]
pub(super) fn unpacked_across(packed: u16) -> [f32; 2] {
    let x = f32::from(packed >> 1) / HALF - 1.0;
    let y = 1.0 - x.abs();
    [x, if packed & 1 == 1 { -y } else { y }]
}

/// A share, rounded to the nearest.
pub(super) fn share(share: f32) -> u16 {
    const DROPPED: u32 = 23 - MANTISSA;
    let bits = (share.max(0.0).to_bits() + (1 << (DROPPED - 1))) >> DROPPED;
    u16::try_from(bits.saturating_sub(LOWEST)).unwrap_or(u16::MAX)
}

#[inline(always)]
pub(super) fn unpacked_share(packed: u16) -> f32 {
    match packed {
        0 => 0.0,
        packed => f32::from_bits((u32::from(packed) + LOWEST) << (23 - MANTISSA)),
    }
}

/// How full strips are next to the fullest of them.
pub(super) fn levels(strips: &Strips) -> [u16; STRIPS] {
    let most = strips.iter().fold(f32::MIN_POSITIVE, |a, b| a.max(*b));
    strips.map(|strip| whole(strip.clamp(0.0, most) / most * STEPS))
}

/// The same in words.
pub(super) fn words(levels: &[u16; STRIPS]) -> [u16; WORDS] {
    let mut words = [0; WORDS];
    for (word, levels) in words.iter_mut().zip(levels.chunks(PER_WORD)) {
        *word = levels
            .iter()
            .rev()
            .fold(0, |word, level| word * whole(LEVELS) + level);
    }
    words
}

/// How full strips of this level are.
#[inline(always)]
pub(super) fn fullness<F: Number>(level: F) -> F {
    level * ((1.0 - EMPTIEST) / STEPS) + EMPTIEST
}

/// How full strips are, of words as numbers.
#[inline(always)]
pub(super) fn fullnesses<F: Number>(words: [F; WORDS]) -> [F; STRIPS] {
    let mut all = [words[0]; STRIPS];
    for (mut word, strips) in words.into_iter().zip(all.chunks_mut(PER_WORD)) {
        for strip in strips {
            // Cut off: what is left over is a share of 39/40 at most.
            let rest = (word * (1.0 / LEVELS) - 0.49) + WHOLE - WHOLE;
            *strip = fullness(word - rest * LEVELS);
            word = rest;
        }
    }
    all
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn whole(number: f32) -> u16 {
    // To the nearest, for none is below 0.
    (number + 0.5) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::TAU;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// All levels come back, in any strip; shares and directions nearly.
    #[test]
    fn what_goes_in_comes_out() {
        for i in 0..40_u16 {
            let levels = core::array::from_fn(|k| (i * 7 + 11 * u16::try_from(k).unwrap()) % 40);
            let wanted = levels.map(|level| fullness(f32::from(level)));
            let found = fullnesses(words(&levels).map(f32::from));
            assert_eq!(found, wanted, "{levels:?}");
        }
        for i in 0..1000_u16 {
            let part = f32::from(i) / 1000.0;
            let wanted = 7.9 * part.powi(8);
            let off = (unpacked_share(share(wanted)) - wanted).abs();
            assert!(off <= 2.5e-4 * wanted + 2e-9, "{wanted} is off by {off}");
            let wanted = Vec2::from_angle(TAU * part);
            let found = Vec2::from(unpacked_across(across(wanted)));
            let off = found.normalize().perp_dot(wanted).abs();
            assert!(off < 1e-4, "{wanted} is off by {off}");
        }
    }

    /// Levels are no fuller on average than what they stand for.
    #[test]
    fn levels_do_not_drift() {
        let mut rng = StdRng::seed_from_u64(5);
        let (mut sum, mut wanted) = (0.0, 0.0);
        for _ in 0..10_000 {
            let strips: Strips = core::array::from_fn(|_| rng.random());
            let most = strips.iter().fold(0.0_f32, |a, b| a.max(*b));
            for (level, strip) in levels(&strips).into_iter().zip(strips) {
                sum += f64::from(level) / f64::from(STEPS);
                wanted += f64::from(strip / most);
            }
        }
        assert!((sum / wanted - 1.0).abs() < 1e-3, "{sum}, not {wanted}");
    }
}

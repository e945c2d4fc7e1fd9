//! How much of each piece later scratches leave of it (Bosch et al. 2004, section 3.3, leaves crossings out).
//!
//! Where a pixel holds few scratches, crossings are cut out exactly while shading; this is their mean along a
//! piece, for pixels that hold many.

use super::Pattern;
use super::region::Region;
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use glam::DVec2;
use rayon::prelude::*;

/// Later pieces near one that are looked at: beyond, little of it is left.
const MOST_NEIGHBOURS: usize = 256;

/// A piece as a straight strip, mm in the pattern's own scale.
#[derive(Clone, Copy)]
struct Strip {
    middle: DVec2,
    /// Half its length, as a vector.
    half: DVec2,
    half_width: f64,
}

impl Strip {
    /// One of its quarters, in the direction of travel.
    fn quarter(&self, number: usize) -> Self {
        let shift = 0.25 * (2.0 * number as f64 - 3.0);
        Self {
            middle: self.middle + shift * self.half,
            half: 0.25 * self.half,
            half_width: self.half_width,
        }
    }

    fn along(&self) -> DVec2 {
        self.half.normalize_or(DVec2::X)
    }

    fn region(&self) -> Region {
        Region::parallelogram(2.0 * self.half, 2.0 * self.half_width * self.along().perp())
    }

    /// Whether all of another strip lies beside this one.
    fn misses(&self, other: &Self) -> bool {
        let away = other.middle - self.middle;
        let along = self.along();
        let turned = |v: DVec2| [v.dot(along).abs(), v.perp_dot(along).abs()];
        let [away_x, away_y] = turned(away);
        let [half_x, half_y] = turned(other.half);
        away_y > half_y + self.half_width + other.half_width
            || away_x > half_x + self.half.length() + other.half_width
    }

    /// The share of this strip that another one covers.
    fn covered_by(&self, other: &Self) -> f64 {
        if self.misses(other) || other.misses(self) {
            return 0.0;
        }
        let region = self.region();
        let away = other.middle - self.middle;
        let along = other.along();
        let across = along.perp();
        let (length, width) = (other.half.length(), other.half_width);
        let covered = region
            .clipped(away - along * length, along)
            .and_then(|part| part.clipped(away + along * length, -along))
            .and_then(|part| part.clipped(away - across * width, across))
            .and_then(|part| part.clipped(away + across * width, -across));
        covered.map_or(0.0, |part| part.area() / region.area())
    }
}

/// What later scratches leave of the quarters of each piece, in 255ths: those that cover a part of one each do so
/// independently of one another.
pub(super) fn visible_shares(pattern: &Pattern) -> Vec<[u8; 4]> {
    let count = pattern.curves().pieces.len();
    let strips: Vec<Strip> = (0..count)
        .into_par_iter()
        .map(|i| strip(pattern, i))
        .collect();
    // Two strips that overlap lie no farther apart than both half widths.
    let reach = DVec2::splat(2.0 * f64::from(pattern.extent.half_width_mm))
        / (pattern.units_per_uv * pattern.mm_per_scene_unit);
    let visible = |number: usize| {
        let control = pattern.curves().control(number);
        let mut later: ArrayVec<usize, MOST_NEIGHBOURS> = ArrayVec::new();
        let mut visible = [1.0; 4];
        let quarters = [0, 1, 2, 3].map(|quarter| strips[number].quarter(quarter));
        let _ = pattern.grid.query_along(&control, reach, |other| {
            let other = other as usize;
            if other <= number + 1
                || strips[number].misses(&strips[other])
                || later.contains(&other)
            {
                return ControlFlow::Continue(());
            }
            for (visible, quarter) in visible.iter_mut().zip(&quarters) {
                *visible *= 1.0 - quarter.covered_by(&strips[other]);
            }
            match later.try_push(other) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        });
        visible.map(packed)
    };
    // Neighbours one after the other: they look at the same strips.
    let order = pattern.grid.in_order(pattern.curves());
    let shares: Vec<[u8; 4]> = order.par_iter().map(|&number| visible(number)).collect();
    let mut all = vec![[255; 4]; count];
    for (number, share) in order.into_iter().zip(shares) {
        all[number] = share;
    }
    all
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn packed(share: f64) -> u8 {
    (share * 255.0 + 0.5) as u8
}

fn strip(pattern: &Pattern, number: usize) -> Strip {
    let curves = pattern.curves();
    let [a, _, _, b] = curves.control(number);
    let scale = pattern.units_per_uv * pattern.mm_per_scene_unit;
    let [from, to] = curves.at(number);
    let ends = pattern
        .strand(curves.pieces[number].scratch)
        .map_or([0.0; 2], |(track, course)| {
            track.ends(course.value(0.5 * (from + to)))
        });
    Strip {
        middle: 0.5 * (a + b) * scale,
        half: 0.5 * (b - a) * scale,
        half_width: 0.5 * f64::from(ends[1] - ends[0]),
    }
}

//! How much of each piece later scratches leave of it (Bosch et al. 2004, section 3.3, leaves crossings out).
//!
//! Where a pixel holds few scratches, crossings are cut out exactly while shading; this is their mean along a
//! piece, for pixels that hold many. Pairs of strips are looked for where both are: the plate is divided again and
//! again until few strips are left in each part, and a pair counts in the part that holds its place.

mod cell;
mod cover;
mod meet;
mod part;

use super::Pattern;
use super::lists::{Lists, of_sources};
use super::raster::Extents;
use super::reader::Reader;
use super::strip::Strip;
use cover::Covered;
use part::Part;
use rayon::prelude::*;

/// Strips in a cell to begin with.
const PER_CELL: f64 = 1024.0;

/// Cells that a strip lies in, on average: no more.
const MOST_CELLS_PER_STRIP: f64 = 4.0;

/// What later scratches leave of the quarters of each piece, in 255ths: those that cover a part of one each do so
/// independently of one another.
pub(super) fn visible_shares(pattern: &Pattern) -> Vec<[u8; 4]> {
    let begin = || Reader::new(pattern);
    shares_left(pattern.curves().pieces.len(), begin, strip)
}

/// The same, of strips alone.
fn shares_left<R>(
    count: usize,
    begin: impl Fn() -> R + Sync + Send,
    strip: impl Fn(&mut R, usize) -> Strip + Sync + Send,
) -> Vec<[u8; 4]> {
    let covered = |reader: &mut R, i| Covered::new(strip(reader, i));
    let strips = (0..count).into_par_iter().map_init(begin, covered);
    let strips: Vec<Covered> = strips.collect();
    let Some(extents) = Extents::of(count, |i| strips[i].strip().bounds()) else {
        return Vec::new();
    };
    let raster = extents.raster(PER_CELL, MOST_CELLS_PER_STRIP);
    let cells = of_sources(raster.count(), count, |i, source| {
        let strip = strips[i].strip();
        if strip.half_width > 0.0 {
            let line = [strip.start, strip.end];
            raster.for_each_cell_within(strip.half_width, line, |cell| source.lies_in(cell));
        }
    });
    cells.map(Part::default, |part, first, lists: &Lists<u32>| {
        for own in 0..lists.count() {
            let within = raster.corners(first + own);
            cell::look(part, lists.of(own), &strips, within);
        }
    });
    strips.par_iter().map(Covered::left).collect()
}

fn strip(reader: &mut Reader<'_>, number: usize) -> Strip {
    let pattern = reader.pattern;
    let curves = pattern.curves();
    let [start, end] = curves.ends(number);
    let scale = pattern.units_per_uv * pattern.mm_per_scene_unit;
    Strip {
        start: start * scale,
        end: end * scale,
        // Where it sets in, it covers less.
        half_width: 0.5 * reader.mean_width(number),
    }
}

#[cfg(test)]
mod tests {
    use super::cover::SHORT;
    use super::*;
    use glam::DVec2;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    fn strip(start: [f64; 2], end: [f64; 2], half_width: f64) -> Strip {
        Strip {
            start: start.into(),
            end: end.into(),
            half_width,
        }
    }

    fn left_of(strips: &[Strip]) -> Vec<[u8; 4]> {
        shares_left(strips.len(), || (), |(), i| strips[i])
    }

    /// What is left of each quarter by the rule, pair by pair with polygons.
    fn truth(strips: &[Strip]) -> Vec<[f64; 4]> {
        let left = |i: usize| {
            let mut left = [1.0; 4];
            for later in strips.iter().skip(i + 2) {
                if let Some(cover) = strips[i].covered_by(later) {
                    (0..4).for_each(|k| left[k] *= 1.0 - cover.quarters[k]);
                }
            }
            left
        };
        (0..strips.len()).map(left).collect()
    }

    fn assert_near(strips: &[Strip], most: f64, mean: f64) {
        let (ours, truth) = (left_of(strips), truth(strips));
        let quarters = ours.iter().flatten().zip(truth.iter().flatten());
        let off: Vec<f64> = quarters.map(|(a, b)| f64::from(*a) / 255.0 - b).collect();
        let worst = off.iter().fold(0.0_f64, |worst, off| worst.max(off.abs()));
        let sum: f64 = off.iter().sum();
        assert!(worst < most, "off by {worst}");
        assert!(sum.abs() < mean * off.len() as f64, "off by {sum} in all");
    }

    /// Lines that cross where halves, quarters and eighths of the plate meet: each crossing counts once.
    #[test]
    fn crossings_on_borders_count_once() {
        let at = |i: u32| f64::from(i) / 64.0;
        for half_width in [1e-5, 1e-3] {
            let rows = (1..64).map(|i| strip([0.0, at(i)], [1.0, at(i)], half_width));
            let columns = (1..64).map(|i| strip([at(i), 0.0], [at(i), 1.0], half_width));
            let all: Vec<Strip> = rows.chain(columns).collect();
            assert_near(&all, 0.5001 / 255.0, 0.5 / 255.0);
        }
    }

    /// Strips anywhere, thick and thin, long and short, bundled and not: as polygons say, on average within a
    /// thousandth, each quarter within half a crossing, which at an end counts wholly or not at all.
    #[test]
    fn strips_anywhere() {
        let mut rng = StdRng::seed_from_u64(8);
        for (spread, width) in [(6.3, 0.002), (6.3, 0.02), (0.1, 0.01), (0.0, 0.01)] {
            let mut any = || {
                let start = DVec2::new(rng.random(), rng.random());
                let size: f64 = rng.random_range(0.1..0.5);
                let angle = spread * rng.random::<f64>();
                let end = start + size * DVec2::from_angle(angle);
                strip(start.into(), end.into(), width * rng.random::<f64>())
            };
            let all: Vec<Strip> = (0..1500).map(|_| any()).collect();
            assert_near(&all, 2.0 * SHORT, 1e-3);
        }
    }

    /// Of a heap far too large to be looked at pair by pair nothing is left but the last ones; of many crossings
    /// those that are looked at stand for all.
    #[test]
    fn heaps() {
        let same = vec![strip([0.0; 2], [1.0, 0.2], 0.01); 5000];
        let left = left_of(&same);
        assert_eq!(left[0], [0; 4]);
        assert_eq!(left[4998], [255; 4], "only its own next piece lies on it");
        let mut rng = StdRng::seed_from_u64(9);
        let mut all = vec![strip([0.0, 0.5], [1.0, 0.5], 1e-3); 1];
        for _ in 0..20_000 {
            let x = rng.random::<f64>();
            all.push(strip([x, 0.0], [x, 1.0], 2e-5));
        }
        // 20 000 of a width of 4e-5 leave exp(-0.8).
        for quarter in left_of(&all)[0] {
            let left = f64::from(quarter) / 255.0;
            assert!((left - 0.4493).abs() < 0.02, "{left} is left");
        }
    }
}

//! Where a pattern of few scratches has none, told at a glance: most pixels of such a surface lie there.

use super::pieces::Curves;
use super::raster::{Outline, Raster, cell_number};
use glam::DVec2;

/// The pattern's rectangle is told in so many cells per side, a bit each: 8 KB in all.
const SIDE: u32 = 256;

/// Words of 64 cells to a row.
const WORDS: usize = 4;

/// Of more pieces than this few cells would be blank.
const MOST_PIECES: usize = 16_384;

/// Boxes that touch more rows are not told.
const MOST_ROWS: u32 = 8;

/// Which cells no piece crosses.
#[derive(Clone, Debug, Default)]
pub(crate) struct Blank {
    raster: Raster,
    /// Row after row, and one more word to be read behind the last; none if nothing is known.
    crossed: Vec<u64>,
}

impl Blank {
    /// Of a pattern whose pieces lie within these bounds.
    pub(super) fn new(curves: Curves<'_>, bounds: [DVec2; 2]) -> Self {
        let pieces = curves.pieces.len();
        let raster = Raster::of_box(bounds, SIDE.into());
        // A damaged file may claim any bounds.
        let size = bounds[1] - bounds[0];
        let is_box = size.is_finite() && size.cmpgt(DVec2::ZERO).all();
        if pieces > MOST_PIECES || !is_box {
            return Self::default();
        }
        let mut crossed = vec![0; SIDE as usize * WORDS + 1];
        for piece in 0..pieces {
            raster.for_each_cell(&Outline::of(&curves.control(piece)), |cell| {
                crossed[cell as usize / 64] |= 1 << (cell % 64);
            });
        }
        Self { raster, crossed }
    }

    /// Whether a piece may lie in a box.
    #[inline(always)]
    pub(super) fn may_cross(&self, low: DVec2, high: DVec2) -> bool {
        let last = f64::from(SIDE - 1);
        let cell = |place: f64| cell_number(if place < last { place } else { last });
        let [from, to] = [low, high].map(|place| self.raster.in_cells(place));
        let ([left, right], [bottom, top]) =
            ([cell(from.x), cell(to.x)], [cell(from.y), cell(to.y)]);
        let (columns, rows) = (right.wrapping_sub(left), top.wrapping_sub(bottom));
        if self.crossed.is_empty() || columns >= 64 || rows >= MOST_ROWS {
            return true;
        }
        let (wanted, shift) = (u64::MAX >> (63 - columns), left % 64);
        let first = left as usize / 64;
        (bottom..=top).any(|row| {
            let words = self.crossed.get(row as usize * WORDS + first..);
            let Some([word, next, ..]) = words else {
                return true;
            };
            (word >> shift | next << 1 << (63 - shift)) & wanted != 0
        })
    }

    /// Memory of what it keeps.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.crossed[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;
    use crate::pattern::closest::bezier;
    use crate::pattern::grid::Grid;
    use crate::pattern::pieces::Chains;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Boxes of any size, anywhere, also across words and beyond the borders: what a curve runs through is never blank, and
    /// nearly all small boxes that none comes near are.
    #[test]
    fn blank_is_blank() {
        let mut rng = StdRng::seed_from_u64(21);
        let mut chains = Chains::default();
        for scratch in 0..60 {
            let mut point = || [rng.random::<f64>() * 2.0, rng.random()];
            let start = point();
            let points = [(); 4].map(|()| {
                let [u, v] = point();
                [start[0] + 0.2 * u, start[1] + 0.2 * v]
            });
            let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
            chains.append(&Chains::of_path(&curves, DVec2::ONE), scratch);
        }
        let curves = chains.curves();
        let bounds = Grid::new(curves).raster.bounds();
        let blank = Blank::new(curves, bounds);
        let places: Vec<DVec2> = (0..chains.pieces.len())
            .flat_map(|piece| {
                let control = curves.control(piece);
                (0..=400).map(move |i| bezier(&control, f64::from(i) / 400.0))
            })
            .collect();
        let (mut small, mut told) = (0, 0);
        for i in 0..1500 {
            let size = 10_f64.powf(rng.random_range(-5.0..0.0));
            let low = match i % 3 {
                // One that a curve runs through.
                0 => places[rng.random_range(0..places.len())] - size * rng.random::<f64>(),
                _ => DVec2::new(rng.random_range(-0.1..2.3), rng.random_range(-0.1..1.3)),
            };
            let high = low + size * DVec2::new(rng.random(), rng.random());
            let inside = |p: &DVec2| p.cmpge(low).all() && p.cmple(high).all();
            let (holds, may) = (places.iter().any(inside), blank.may_cross(low, high));
            assert!(may || !holds, "{low}..{high} is told to be blank");
            let wider = |p: &DVec2| p.cmpge(low - 0.03).all() && p.cmple(high + 0.03).all();
            if size < 0.01 && !places.iter().any(wider) {
                small += 1;
                told += u32::from(!may);
            }
        }
        assert!(
            small > 150 && 50 * told > 49 * small,
            "{told} of {small} are told"
        );
    }
}

//! A uniform grid over texture space (Bosch et al. 2004, section 5) in two levels: which pieces lie near a pixel.
//!
//! Each cell is divided again, as finely as its own pieces ask for, so that a crowded corner costs no more
//! than an empty plain (as the two-level grids of Kalojanov et al. 2011 for ray tracing).

use super::lists::of_sources;
use super::pieces::Curves;
use super::raster::{Extents, Outline, Raster, Touched, cell_number};
use super::store::Store;
use bytemuck::{Pod, Zeroable};
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicU32, Ordering};
use glam::DVec2;
use rayon::prelude::*;

/// Pieces that a cell should hold on average.
const PER_CELL: f64 = 64.0;

/// Pieces that a part of a cell should hold. Of fewer pieces in all than this, smaller parts hold fewer in proportion, down
/// to this many: then the room is there, and most pixels find nothing to look at.
const PER_PART: f64 = 12.0;
const MANY: f64 = 131_072.0;
const LEAST_PER_PART: f64 = 0.0625;

/// Cells that a piece may cross, on average: long pieces ask for larger cells.
const MOST_CELLS_PER_PIECE: f64 = 32.0;

/// Parts that a piece may cross, on average, for what its listing costs.
const MOST_PARTS_PER_PIECE: f64 = 128.0;

/// Where pieces cross more cells than this, on average, smaller cells would not hold fewer of them.
const LONG: f64 = 8.0;

/// A cell that holds more than this many times its share (as seen by an average piece) asks for smaller cells.
const CROWDED: f64 = 4.0;

/// Most parts of a cell, per side.
const MOST_PARTS: u32 = 1024;

/// Each part of each cell lists the pieces that cross it, all in two flat arrays: no pointers to chase.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    pub raster: Raster,
    /// What the raster's bounds are, told at a glance.
    hull: [DVec2; 2],
    pub(super) cells: Store<Cell>,
    /// Where each part's list starts in `entries`; one more than there are parts.
    pub(super) starts: Store<u32>,
    pub(super) entries: Store<u32>,
}

/// A cell's parts: `side` by `side`, their lists beginning at number `first` of `starts`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Cell {
    first: u32,
    side: u32,
}

impl Cell {
    /// Column and row of its part that is nearest to a place so many cells from its corner.
    #[inline(always)]
    fn part_at(&self, place: DVec2) -> [u32; 2] {
        let side = f64::from(self.side);
        let (place, last) = (place * side, side - 1.0);
        let part = |place: f64| cell_number(if place < last { place } else { last });
        [part(place.x), part(place.y)]
    }
}

impl Grid {
    pub(crate) fn new(curves: Curves<'_>) -> Self {
        let count = curves.pieces.len();
        let Some(extents) = Extents::of(count, |i| curves.bounds(i)) else {
            return Self::default();
        };
        let mut per_cell = PER_CELL;
        loop {
            let raster = extents.raster(per_cell, MOST_CELLS_PER_PIECE);
            let cells = count_in_cells(curves, raster);
            let listed: f64 = cells.iter().map(|&count| f64::from(count)).sum();
            let squares: f64 = cells.iter().map(|&count| f64::from(count).powi(2)).sum();
            // How many pieces share a cell with an average one.
            let crowded = squares > CROWDED * PER_CELL * listed && listed < LONG * count as f64;
            if crowded && per_cell > 4.0 && raster.columns.max(raster.rows) < 4096 {
                per_cell *= 0.25;
            } else {
                return Self::of_cells(curves, raster, &cells, listed);
            }
        }
    }

    /// Of cells that are crossed by so many pieces each, `listed` in all.
    fn of_cells(curves: Curves<'_>, raster: Raster, counts: &[u32], listed: f64) -> Self {
        let pieces = curves.pieces.len() as f64;
        let per_piece = listed / pieces;
        let per_part = (PER_PART * pieces / MANY).clamp(LEAST_PER_PART, PER_PART);
        let most = (MOST_PARTS_PER_PIECE / per_piece).clamp(1.0, MOST_PARTS.into());
        let mut first = 0;
        let cell = |&count: &u32| {
            let side = (f64::from(count) / per_part).sqrt().ceil();
            let side = cell_number(side.clamp(1.0, most));
            let cell = Cell { first, side };
            first += side * side;
            cell
        };
        let cells: Vec<Cell> = counts.iter().map(cell).collect();
        let parts = of_sources(first as usize, curves.pieces.len(), |piece, source| {
            let control = curves.control(piece);
            let cell = |number: u32| cells[number as usize];
            raster.for_each_part_of_cells(
                &Outline::of(&control),
                |number| cell(number).side,
                |number, part| source.lies_in(cell(number).first + part),
            );
        })
        .lists();
        Self::of_lists(
            raster,
            cells.into(),
            parts.starts.into(),
            parts.items.into(),
        )
    }

    /// As a file keeps it.
    pub(super) fn of_lists(
        raster: Raster,
        cells: Store<Cell>,
        starts: Store<u32>,
        entries: Store<u32>,
    ) -> Self {
        Self {
            hull: raster.hull(),
            raster,
            cells,
            starts,
            entries,
        }
    }

    /// Whether a box touches it.
    #[inline(always)]
    pub(super) fn touches(&self, low: DVec2, high: DVec2) -> bool {
        low.cmple(self.hull[1]).all() && high.cmpge(self.hull[0]).all()
    }

    /// The cells that a box touches, of which [`Self::touches`] says that it does.
    #[inline(always)]
    pub(super) fn touched(&self, low: DVec2, high: DVec2) -> Touched {
        let within = [low, high].map(|place| self.raster.in_cells(place));
        let last = DVec2::new(self.raster.columns.into(), self.raster.rows.into()) - 1.0;
        let cell = |place: f64, last: f64| cell_number(if place < last { place } else { last });
        let [from, to] = within;
        Touched {
            columns: cell(from.x, last.x)..cell(to.x, last.x) + 1,
            rows: cell(from.y, last.y)..cell(to.y, last.y) + 1,
            within,
        }
    }

    /// Calls `visit` with lists of all pieces that may touch a box, each once or more, until it breaks. These cells are
    /// those that the box touches.
    #[inline(always)]
    pub(crate) fn query(
        &self,
        cells: &Touched,
        mut visit: impl FnMut(&[u32]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let (cells_of, starts, entries) = (&*self.cells, &*self.starts, &*self.entries);
        let [low, high] = cells.within;
        for row in cells.rows.clone() {
            for column in cells.columns.clone() {
                let number = row * self.raster.columns + column;
                let Some(cell) = cells_of.get(number as usize) else {
                    continue;
                };
                // A damaged file may claim endlessly many parts.
                if cell.side > MOST_PARTS {
                    continue;
                }
                let corner = DVec2::new(column.into(), row.into());
                let [left, bottom] = cell.part_at(low - corner);
                let [right, top] = cell.part_at(high - corner);
                for row in bottom..top + 1 {
                    // Of a damaged file's, any number.
                    let first = cell.first.wrapping_add(row * cell.side);
                    let parts = [left, right].map(|column| first.wrapping_add(column));
                    let listed = lists(starts, entries, parts);
                    if !listed.is_empty() {
                        visit(listed)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Memory of all arrays.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.cells[..])
            + size_of_val(&self.starts[..])
            + size_of_val(&self.entries[..])
    }

    /// Whether its numbers fit together, which a damaged file's may not.
    #[cfg(feature = "files")]
    pub(super) fn is_sound(&self) -> bool {
        self.raster.is_sound()
            && self.cells.len() == self.raster.count()
            && (self.cells.is_empty() || !self.starts.is_empty())
    }
}

/// The pieces of neighbouring parts, from the first to the last.
fn lists<'g>(starts: &[u32], entries: &'g [u32], [first, last]: [u32; 2]) -> &'g [u32] {
    let start = |part: usize| starts.get(part).map_or(0, |&start| start as usize);
    let lists = entries.get(start(first as usize)..start(last as usize + 1));
    lists.unwrap_or(&[])
}

/// How many pieces cross each cell.
fn count_in_cells(curves: Curves<'_>, raster: Raster) -> Vec<u32> {
    let counts: Vec<AtomicU32> = (0..raster.count()).map(|_| AtomicU32::new(0)).collect();
    (0..curves.pieces.len()).into_par_iter().for_each(|piece| {
        raster.for_each_cell(&Outline::of(&curves.control(piece)), |cell| {
            counts[cell as usize].fetch_add(1, Ordering::Relaxed);
        });
    });
    counts.into_iter().map(AtomicU32::into_inner).collect()
}

pub(super) fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;
    use crate::pattern::closest::bezier;
    use crate::pattern::pieces::Chains;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Every piece near a box is reported, also where pieces crowd.
    #[test]
    fn query_finds_each_piece() {
        for crowd in [1.0, 0.003] {
            let mut rng = StdRng::seed_from_u64(7);
            let mut chains = Chains::default();
            for scratch in 0..300 {
                let scale = if scratch % 10 == 0 { 1.0 } else { crowd };
                let mut point = || {
                    [
                        rng.random::<f64>() * 2.0 * scale,
                        rng.random::<f64>() * scale,
                    ]
                };
                let points = [point(), point(), point(), point()];
                let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
                chains.append(&Chains::of_path(&curves, DVec2::ONE), scratch);
            }
            let curves = chains.curves();
            let grid = Grid::new(curves);
            for _ in 0..60 {
                let low = DVec2::new(rng.random::<f64>() * 2.2 - 0.1, rng.random::<f64>()) * crowd;
                let high = low + DVec2::new(rng.random(), rng.random()) * 0.1 * crowd;
                let mut found = vec![false; chains.pieces.len()];
                if !grid.touches(low, high) {
                    continue;
                }
                let cells = grid.touched(low, high);
                let _ = grid.query(&cells, |pieces| {
                    pieces
                        .iter()
                        .for_each(|&piece| found[piece as usize] = true);
                    ControlFlow::Continue(())
                });
                for (number, found) in found.iter().enumerate() {
                    let inside = (0..=100).any(|i| {
                        let p = bezier(&curves.control(number), f64::from(i) / 100.0);
                        p.cmpge(low).all() && p.cmple(high).all()
                    });
                    assert!(*found || !inside, "lost piece {number}");
                }
            }
        }
    }
}

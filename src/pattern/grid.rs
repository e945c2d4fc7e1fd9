//! A uniform grid over texture space (Bosch et al. 2004, section 5) in two levels: which pieces lie near a pixel.
//!
//! Each cell is divided again, as finely as its own pieces ask for, so that a crowded corner costs no more
//! than an empty plain (as the two-level grids of Kalojanov et al. 2011 for ray tracing).

use super::pieces::{Curves, bounds, sagitta};
use super::raster::{Raster, cell_number};
use super::store::Store;
use bytemuck::{Pod, Zeroable};
use core::ops::ControlFlow;
use glam::DVec2;
use rayon::prelude::*;

/// Pieces that a cell should hold on average.
const PER_CELL: f64 = 64.0;

/// Pieces that a part of a cell should hold.
const PER_PART: f64 = 2.0;

/// A cell that holds more than this many times its share (as seen by an average piece) asks for smaller cells.
const CROWDED: f64 = 4.0;

/// Most parts of a cell, per side.
const MOST_PARTS: f64 = 1024.0;

/// Each part of each cell lists the pieces that cross it, all in two flat arrays: no pointers to chase.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    pub raster: Raster,
    pub(super) cells: Store<Cell>,
    /// Where each part's list starts in `entries`; one more than there are parts.
    pub(super) starts: Store<u32>,
    pub(super) entries: Store<u32>,
}

/// A cell's parts: `side` by `side`, their lists beginning at number `first` of `starts`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Cell {
    first: u32,
    side: u32,
}

impl Grid {
    /// The grid, and the pieces of each of its cells.
    pub(crate) fn new(curves: Curves<'_>) -> (Self, CellPieces) {
        let count = curves.pieces.len();
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let wider = |a: [DVec2; 2], b: [DVec2; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let all = (0..count).into_par_iter().map(|i| curves.bounds(i));
        let [low, high] = all.reduce(|| empty, wider);
        if count == 0 {
            return Default::default();
        }
        // Square cells, slightly larger than the pattern; a pattern of one line is a strip.
        let longest = (high - low).max_element();
        let size = (high - low).max(DVec2::splat(longest / PER_CELL)) * (1.0 + 1e-9);
        let mut per_cell = PER_CELL;
        loop {
            let raster = Raster::over(low, size, count as f64 / per_cell);
            let pairs = pairs(raster, curves);
            let crowded = mean_in_cell(&pairs) > CROWDED * PER_CELL;
            if crowded && per_cell > 4.0 && raster.columns.max(raster.rows) < 4096 {
                per_cell *= 0.25;
            } else {
                let cells = CellPieces::new(raster, pairs);
                return (Self::of_cells(curves, raster, &cells), cells);
            }
        }
    }

    fn of_cells(curves: Curves<'_>, raster: Raster, cells: &CellPieces) -> Self {
        let count = raster.count();
        let parts: Vec<Parts> = (0..count)
            .into_par_iter()
            .map(|cell| Parts::of(curves, raster.cell(cell), cells.pairs(cell)))
            .collect();
        let mut grid = Self {
            raster,
            cells: Vec::with_capacity(count).into(),
            starts: Vec::with_capacity(parts.iter().map(|part| part.ends.len()).sum::<usize>() + 1)
                .into(),
            entries: Vec::with_capacity(parts.iter().map(|part| part.entries.len()).sum()).into(),
        };
        grid.starts.push(0);
        for Parts {
            side,
            ends,
            entries,
        } in &parts
        {
            let before = number(grid.entries.len());
            grid.cells.push(Cell {
                first: number(grid.starts.len() - 1),
                side: *side,
            });
            grid.starts.extend(ends.iter().map(|end| before + end));
            grid.entries.extend(entries);
        }
        grid
    }

    /// Calls `visit` with each piece that may touch the box from `low` to `high`, once or more, until it breaks.
    pub(crate) fn query(
        &self,
        low: DVec2,
        high: DVec2,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Some((columns, rows)) = self.raster.touched(low, high) else {
            return ControlFlow::Continue(());
        };
        let (starts, entries) = (&*self.starts, &*self.entries);
        for row in rows {
            for column in columns.clone() {
                let number = row * self.raster.columns + column;
                let Some(cell) = self.cell(number as usize) else {
                    continue;
                };
                let parts = self.raster.cell(number as usize).parted(cell.side);
                let Some((columns, rows)) = parts.touched(low, high) else {
                    continue;
                };
                for row in rows {
                    for column in columns.clone() {
                        let part = cell.first + row * cell.side + column;
                        for &piece in list(starts, entries, part as usize) {
                            visit(piece)?;
                        }
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

    /// As [`Self::query`], for what lies within `reach` of a curve.
    pub(crate) fn query_along(
        &self,
        control: &[DVec2; 4],
        reach: DVec2,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let [low, high] = bounds(control);
        let [low, high] = [low - reach, high + reach];
        let sagitta = sagitta(control) + reach.max_element();
        let Some((columns, rows)) = self.raster.touched(low, high) else {
            return ControlFlow::Continue(());
        };
        let (starts, entries) = (&*self.starts, &*self.entries);
        for row in rows {
            for column in columns.clone() {
                let number = (row * self.raster.columns + column) as usize;
                let Some(cell) = self.cell(number) else {
                    continue;
                };
                let parts = self.raster.cell(number).parted(cell.side);
                let Some((_, rows)) = parts.touched(low, high) else {
                    continue;
                };
                for row in rows {
                    for column in parts.columns_of(control, [low, high], sagitta, row) {
                        let part = cell.first + row * cell.side + column;
                        for &piece in list(starts, entries, part as usize) {
                            visit(piece)?;
                        }
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// All pieces, cell by cell of where they begin.
    pub(crate) fn in_order(&self, curves: Curves<'_>) -> Vec<usize> {
        let place = |number: u32| {
            let [start, ..] = curves.control(number as usize);
            let [column, row] =
                [0, 1].map(|axis| *self.raster.cells(start[axis], start[axis], axis).start());
            u64::from(row * self.raster.columns + column) << 32 | u64::from(number)
        };
        let mut order: Vec<u64> = (0..number(curves.pieces.len()))
            .into_par_iter()
            .map(place)
            .collect();
        order.par_sort_unstable();
        order.iter().map(|&pair| low_half(pair) as usize).collect()
    }

    /// A cell, if its parts end where the next one's begin: a damaged file may claim endlessly many.
    fn cell(&self, number: usize) -> Option<Cell> {
        let cell = *self.cells.get(number)?;
        let next = self.cells.get(number + 1);
        let end = next.map_or(self.starts.len() as u64 - 1, |next| next.first.into());
        let parts = u64::from(cell.side) * u64::from(cell.side);
        (u64::from(cell.first) + parts == end).then_some(cell)
    }

    /// Whether its numbers fit together, which a damaged file's may not.
    #[cfg(feature = "files")]
    pub(super) fn is_sound(&self) -> bool {
        self.raster.is_sound()
            && self.cells.len() == self.raster.count()
            && (self.cells.is_empty() || !self.starts.is_empty())
    }
}

/// The pieces of a part.
fn list<'g>(starts: &[u32], entries: &'g [u32], part: usize) -> &'g [u32] {
    let start = |i: usize| starts.get(i).map_or(0, |&start| start as usize);
    let list = entries.get(start(part)..start(part + 1));
    list.unwrap_or(&[])
}

/// The pieces of each of a grid's cells, for what else is built from them.
#[derive(Clone, Debug, Default)]
pub(crate) struct CellPieces {
    /// Cell and piece numbers, sorted.
    pairs: Vec<u64>,
    /// Where each cell's begin; one more than there are cells.
    starts: Vec<usize>,
}

impl CellPieces {
    fn new(raster: Raster, pairs: Vec<u64>) -> Self {
        let mut starts = vec![0; raster.count() + 1];
        for &pair in &pairs {
            starts[(pair >> 32) as usize + 1] += 1;
        }
        for cell in 0..raster.count() {
            starts[cell + 1] += starts[cell];
        }
        Self { pairs, starts }
    }

    fn pairs(&self, cell: usize) -> &[u64] {
        &self.pairs[self.starts[cell]..self.starts[cell + 1]]
    }

    pub(crate) fn of(&self, cell: usize) -> impl Iterator<Item = usize> {
        self.pairs(cell).iter().map(|&pair| low_half(pair) as usize)
    }
}

/// Cell and piece numbers of all pieces, cell by cell.
fn pairs(raster: Raster, curves: Curves<'_>) -> Vec<u64> {
    let numbers = 0..number(curves.pieces.len());
    let mut pairs: Vec<u64> = numbers
        .into_par_iter()
        .fold(Vec::new, |mut pairs, piece| {
            let control = curves.control(piece as usize);
            raster.for_each_cell(&control, |cell| {
                pairs.push(u64::from(cell) << 32 | u64::from(piece));
            });
            pairs
        })
        .reduce(Vec::new, |mut a, mut b| {
            a.append(&mut b);
            a
        });
    pairs.par_sort_unstable();
    pairs
}

/// How many pieces share a cell with an average piece.
fn mean_in_cell(pairs: &[u64]) -> f64 {
    let runs = pairs.chunk_by(|a, b| a >> 32 == b >> 32);
    let squares: f64 = runs.map(|run| (run.len() as f64).powi(2)).sum();
    squares / (pairs.len() as f64).max(1.0)
}

/// A cell's parts, on their own.
struct Parts {
    side: u32,
    /// Where each part's list ends in `entries`.
    ends: Vec<u32>,
    entries: Vec<u32>,
}

impl Parts {
    fn of(curves: Curves<'_>, cell: Raster, pairs: &[u64]) -> Self {
        let side = (pairs.len() as f64 / PER_PART).sqrt().ceil();
        let raster = cell.parted(cell_number(side.clamp(1.0, MOST_PARTS)));
        let mut listed = Vec::with_capacity(2 * pairs.len());
        for piece in pairs.iter().map(|&pair| pair & 0xffff_ffff) {
            let control = curves.control(usize::try_from(piece).unwrap_or(0));
            raster.for_each_cell(&control, |cell| listed.push(u64::from(cell) << 32 | piece));
        }
        listed.sort_unstable();
        let count = raster.columns * raster.rows;
        let upto =
            |part: u32| number(listed.partition_point(|&pair| pair >> 32 <= u64::from(part)));
        Self {
            side: raster.columns,
            ends: (0..count).map(upto).collect(),
            entries: listed.iter().map(|&pair| low_half(pair)).collect(),
        }
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[expect(clippy::cast_possible_truncation, reason = "the lower half is meant")]
fn low_half(pair: u64) -> u32 {
    pair as u32
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
            let (grid, _) = Grid::new(curves);
            for _ in 0..60 {
                let low = DVec2::new(rng.random::<f64>() * 2.2 - 0.1, rng.random::<f64>()) * crowd;
                let high = low + DVec2::new(rng.random(), rng.random()) * 0.1 * crowd;
                let mut found = vec![false; chains.pieces.len()];
                let _ = grid.query(low, high, |piece| {
                    found[piece as usize] = true;
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

//! A uniform grid over texture space (Bosch et al. 2004, section 5): which pieces lie near a pixel.

use super::pieces::Piece;
use core::ops::RangeInclusive;
use glam::DVec2;

/// Cells per side are at most this.
const MOST_CELLS: f64 = 2048.0;

/// Each cell lists the pieces that cross it, in two flat arrays: no pointers to chase.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    origin: DVec2,
    /// Cells per unit of u and v.
    per_unit: DVec2,
    columns: usize,
    rows: usize,
    /// Where each cell's list starts in `entries`; one more than there are cells.
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Grid {
    pub(crate) fn new(pieces: &[Piece]) -> Self {
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let [low, high] = pieces.iter().map(Piece::bounds).fold(empty, |all, piece| {
            [all[0].min(piece[0]), all[1].max(piece[1])]
        });
        if pieces.is_empty() {
            return Self::default();
        }
        // About one cell per piece, square, slightly larger than the pattern.
        let size = (high - low).max(DVec2::splat(1e-9)) * (1.0 + 1e-9);
        let per_side = (pieces.len() as f64 / (size.x * size.y)).sqrt();
        let cells = (size * per_side)
            .ceil()
            .clamp(DVec2::ONE, DVec2::splat(MOST_CELLS));
        let mut grid = Self {
            origin: low,
            per_unit: cells / size,
            columns: cell_number(cells.x),
            rows: cell_number(cells.y),
            starts: Vec::new(),
            entries: Vec::new(),
        };
        grid.fill(pieces);
        grid
    }

    /// Counts each cell's pieces, then lists them.
    fn fill(&mut self, pieces: &[Piece]) {
        let mut counts = vec![0_u32; self.columns * self.rows + 1];
        self.for_each_entry(pieces, |cell, _| counts[cell + 1] += 1);
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        let mut next = counts.clone();
        let mut entries = vec![0; counts[counts.len() - 1] as usize];
        self.for_each_entry(pieces, |cell, piece| {
            entries[next[cell] as usize] = piece;
            next[cell] += 1;
        });
        self.starts = counts;
        self.entries = entries;
    }

    fn for_each_entry(&self, pieces: &[Piece], mut visit: impl FnMut(usize, u32)) {
        for (number, piece) in (0_u32..).zip(pieces) {
            for row in self.rows_of(piece) {
                for column in self.columns_of(piece, row) {
                    visit(row * self.columns + column, number);
                }
            }
        }
    }

    /// Calls `visit` once with each piece that may touch the box from `low` to `high`.
    pub(crate) fn query(
        &self,
        pieces: &[Piece],
        low: DVec2,
        high: DVec2,
        mut visit: impl FnMut(u32),
    ) {
        let end = self.origin + DVec2::new(self.columns as f64, self.rows as f64) / self.per_unit;
        // Also false for an empty grid and for NaN.
        if !(low.cmple(end).all() && high.cmpge(self.origin).all() && self.columns > 0) {
            return;
        }
        let (columns, rows) = (self.cells(low.x, high.x, 0), self.cells(low.y, high.y, 1));
        for row in rows.clone() {
            for column in columns.clone() {
                let cell = row * self.columns + column;
                for &number in
                    &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize]
                {
                    let piece = &pieces[number as usize];
                    let [from, to] = piece.bounds();
                    let near = from.cmple(high).all() && to.cmpge(low).all();
                    if near && self.first_cell(piece, &rows, &columns) == Some((row, column)) {
                        visit(number);
                    }
                }
            }
        }
    }

    /// The first cell of the queried ones that lists the piece: there, and only there, it is reported.
    fn first_cell(
        &self,
        piece: &Piece,
        rows: &RangeInclusive<usize>,
        columns: &RangeInclusive<usize>,
    ) -> Option<(usize, usize)> {
        let own = self.rows_of(piece);
        let shared = *own.start().max(rows.start())..=*own.end().min(rows.end());
        shared.into_iter().find_map(|row| {
            let listed = self.columns_of(piece, row);
            let column = *listed.start().max(columns.start());
            let last = *listed.end().min(columns.end());
            (column <= last).then_some((row, column))
        })
    }

    fn rows_of(&self, piece: &Piece) -> RangeInclusive<usize> {
        let [low, high] = piece.bounds();
        self.cells(low.y, high.y, 1)
    }

    /// The columns a piece crosses in one row: where its chord, widened by its sagitta, crosses the row.
    fn columns_of(&self, piece: &Piece, row: usize) -> RangeInclusive<usize> {
        let [low, high] = piece.bounds();
        let (start, chord) = (piece.control[0], piece.chord());
        let sagitta = piece.sagitta();
        let bottom = self.origin.y + row as f64 / self.per_unit.y - sagitta;
        let top = self.origin.y + (row + 1) as f64 / self.per_unit.y + sagitta;
        let (mut from, mut to) = (low.x, high.x);
        if chord.y.abs() > 1e-12 * chord.x.abs() {
            let at = |v: f64| ((v - start.y) / chord.y).clamp(0.0, 1.0);
            let us = [bottom, top].map(|v| start.x + chord.x * at(v));
            // A hair of slack: rounding must not lose a cell.
            let slack = sagitta + 1e-9 / self.per_unit.x;
            from = from.max(us[0].min(us[1]) - slack);
            to = to.min(us[0].max(us[1]) + slack);
        }
        self.cells(from, to, 0)
    }

    /// The cells from `low` to `high` along an axis (0 = columns), clamped to the grid.
    fn cells(&self, low: f64, high: f64, axis: usize) -> RangeInclusive<usize> {
        let count = [self.columns, self.rows][axis];
        let cell =
            |at: f64| cell_number((at - self.origin[axis]) * self.per_unit[axis]).min(count - 1);
        cell(low)..=cell(high)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates: below the grid is cell 0"
)]
fn cell_number(at: f64) -> usize {
    at as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Path;
    use crate::pattern::pieces::pieces as cut;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// Every piece near a box is reported, and once only.
    #[test]
    fn query_finds_each_piece_once() {
        let mut rng = StdRng::seed_from_u64(7);
        let mut pieces = Vec::new();
        for scratch in 0..300 {
            let mut point = || [rng.random::<f64>() * 2.0, rng.random::<f64>()];
            let points = [point(), point(), point(), point()];
            let curves = Path::CubicBezier(&points).curves(DVec2::ONE).unwrap();
            pieces.extend(cut(&curves, DVec2::ONE, scratch).0);
        }
        let grid = Grid::new(&pieces);
        for _ in 0..300 {
            let low = DVec2::new(rng.random::<f64>() * 2.2 - 0.1, rng.random::<f64>());
            let high = low + DVec2::new(rng.random(), rng.random()) * 0.1;
            let mut found = vec![0; pieces.len()];
            grid.query(&pieces, low, high, |piece| found[piece as usize] += 1);
            for (piece, &times) in pieces.iter().zip(&found) {
                assert!(times <= 1, "reported {times} times");
                let inside = (0..=100).any(|i| {
                    let p = super::super::closest::bezier(&piece.control, f64::from(i) / 100.0);
                    p.cmpge(low).all() && p.cmple(high).all()
                });
                assert!(times == 1 || !inside, "lost a piece");
            }
        }
    }
}

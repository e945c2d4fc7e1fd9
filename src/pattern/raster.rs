//! A rectangle of texture space in equal cells: which cells a curve crosses, or a box touches.

use super::pieces::{bounds, sagitta};
use bytemuck::{Pod, Zeroable};
use core::ops::RangeInclusive;
use glam::DVec2;

/// A rectangle in equal cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Raster {
    origin: DVec2,
    /// Cells per unit of u and v.
    per_unit: DVec2,
    pub columns: u32,
    pub rows: u32,
}

impl Raster {
    /// About `count` square cells over a rectangle.
    pub(super) fn over(origin: DVec2, size: DVec2, count: f64) -> Self {
        let per_side = (count / (size.x * size.y)).sqrt();
        let cells = (size * per_side)
            .ceil()
            .clamp(DVec2::ONE, DVec2::splat(4096.0));
        Self {
            origin,
            per_unit: cells / size,
            columns: cell_number(cells.x),
            rows: cell_number(cells.y),
        }
    }

    /// Whether it is one that [`Self::over`] or [`Self::coarser`] could have made.
    #[cfg(feature = "files")]
    pub(super) fn is_sound(&self) -> bool {
        let is_plain = |v: DVec2| v.is_finite() && v.cmpgt(DVec2::ZERO).all();
        // Of no scratches it is nothing.
        *self == Self::default()
            || self.origin.is_finite()
                && is_plain(self.per_unit)
                && is_plain(1.0 / self.per_unit)
                && (1..=4096).contains(&self.columns)
                && (1..=4096).contains(&self.rows)
    }

    /// How many cells it has.
    pub(crate) fn count(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Half as many cells per side.
    pub(crate) fn coarser(&self) -> Self {
        Self {
            per_unit: 0.5 * self.per_unit,
            columns: self.columns.div_ceil(2),
            rows: self.rows.div_ceil(2),
            ..*self
        }
    }

    /// The cells that one of `coarser` holds.
    pub(crate) fn children(&self, coarser: Self, cell: usize) -> impl Iterator<Item = usize> {
        let (columns, rows) = (self.columns as usize, self.rows as usize);
        let (column, row) = (
            cell % coarser.columns as usize,
            cell / coarser.columns as usize,
        );
        (2 * row..(2 * row + 2).min(rows)).flat_map(move |row| {
            (2 * column..(2 * column + 2).min(columns)).map(move |column| row * columns + column)
        })
    }

    /// Its lowest and highest (u, v).
    pub(crate) fn bounds(&self) -> [DVec2; 2] {
        let size = DVec2::new(self.columns.into(), self.rows.into()) / self.per_unit;
        [self.origin, self.origin + size]
    }

    /// How many cells a box touches.
    pub(crate) fn count_touched(&self, low: DVec2, high: DVec2) -> u32 {
        let length = |range: &RangeInclusive<u32>| range.end() - range.start() + 1;
        self.touched(low, high).map_or(0, |(columns, rows)| {
            length(&columns).saturating_mul(length(&rows))
        })
    }

    /// One of its cells.
    pub(crate) fn cell(&self, number: usize) -> Self {
        let (column, row) = (
            number % self.columns as usize,
            number / self.columns as usize,
        );
        Self {
            origin: self.origin + DVec2::new(column as f64, row as f64) / self.per_unit,
            columns: 1,
            rows: 1,
            ..*self
        }
    }

    /// Each cell divided `side` by `side`.
    pub(super) fn parted(&self, side: u32) -> Self {
        Self {
            per_unit: self.per_unit * f64::from(side),
            columns: self.columns * side,
            rows: self.rows * side,
            ..*self
        }
    }

    /// Calls `visit` with the number of each cell that a curve may cross.
    pub(super) fn for_each_cell(&self, control: &[DVec2; 4], mut visit: impl FnMut(u32)) {
        let [low, high] = bounds(control);
        let Some((columns, rows)) = self.touched(low, high) else {
            return;
        };
        if rows.start() == rows.end() || columns.start() == columns.end() {
            for row in rows {
                columns
                    .clone()
                    .for_each(|column| visit(row * self.columns + column));
            }
            return;
        }
        let sagitta = sagitta(control);
        for row in rows {
            for column in self.columns_of(control, [low, high], sagitta, row) {
                visit(row * self.columns + column);
            }
        }
    }

    /// The columns a curve crosses in one row: where its chord, widened by its sagitta, crosses the row.
    pub(super) fn columns_of(
        &self,
        control: &[DVec2; 4],
        [low, high]: [DVec2; 2],
        sagitta: f64,
        row: u32,
    ) -> RangeInclusive<u32> {
        let (start, chord) = (control[0], control[3] - control[0]);
        let bottom = self.origin.y + f64::from(row) / self.per_unit.y - sagitta;
        let top = self.origin.y + f64::from(row + 1) / self.per_unit.y + sagitta;
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

    /// Columns and rows that a box touches, if any.
    pub(crate) fn touched(
        &self,
        low: DVec2,
        high: DVec2,
    ) -> Option<(RangeInclusive<u32>, RangeInclusive<u32>)> {
        let end = self.origin + DVec2::new(self.columns.into(), self.rows.into()) / self.per_unit;
        // A hair of slack again; false for NaN and for a grid of nothing.
        let slack = 1e-9 / self.per_unit;
        let touches = low.cmple(end + slack).all() && high.cmpge(self.origin - slack).all();
        (touches && self.columns > 0)
            .then(|| (self.cells(low.x, high.x, 0), self.cells(low.y, high.y, 1)))
    }

    /// The cells from `low` to `high` along an axis (0 = columns), clamped to the grid.
    pub(super) fn cells(&self, low: f64, high: f64, axis: usize) -> RangeInclusive<u32> {
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
pub(super) fn cell_number(at: f64) -> u32 {
    at as u32
}

//! What lies along a chord, in cells: which of them it may cross. From there it is told in parts of a cell.

use super::{Touched, cell_number};
use core::ops::RangeInclusive;
use glam::DVec2;

/// What strays little from a chord, in cells.
pub(super) struct Placed {
    pub chord: [DVec2; 2],
    pub bounds: [DVec2; 2],
}

impl Placed {
    /// The same in parts of a cell, of which so many lie across.
    pub(super) fn within(&self, [column, row]: [u32; 2], across: f64) -> Self {
        let corner = DVec2::new(column.into(), row.into());
        let place = |place: DVec2| (place - corner) * across;
        Self {
            chord: self.chord.map(place),
            bounds: self.bounds.map(place),
        }
    }

    /// Calls `visit` with column and row of each of so many cells within the bounds that may lie within `reach` of the
    /// chord.
    #[inline(always)]
    pub(super) fn for_each_cell(
        &self,
        sides: [u32; 2],
        reach: impl FnOnce() -> DVec2,
        mut visit: impl FnMut([u32; 2]),
    ) {
        let Some(Touched { columns, rows, .. }) = Touched::of(sides, self.bounds) else {
            return;
        };
        if rows.len() == 1 || columns.len() == 1 {
            for row in rows {
                columns.clone().for_each(|column| visit([column, row]));
            }
            return;
        }
        let band = self.band(reach());
        for row in rows {
            band.columns(row, sides[0] - 1)
                .for_each(|column| visit([column, row]));
        }
    }

    /// The chord, widened by `reach` and cut off at the bounds.
    fn band(&self, reach: DVec2) -> Band {
        let [from, to] = self.bounds;
        let [start, end] = self.chord;
        let chord = end - start;
        // Level ones cross as many columns in one row as in all.
        let is_level = chord.y.abs() <= 1e-12 * chord.x.abs();
        Band {
            ends: [from.x, to.x],
            start,
            slope: if is_level { 0.0 } else { chord.x / chord.y },
            chord: [start.x.min(end.x), start.x.max(end.x)],
            reach_y: reach.y,
            // A hair of slack: rounding must not lose a cell.
            reach_x: if is_level {
                f64::INFINITY
            } else {
                reach.x + 1e-9
            },
        }
    }
}

/// A straight band in cells.
struct Band {
    /// Where it ends across.
    ends: [f64; 2],
    start: DVec2,
    /// Columns per row.
    slope: f64,
    /// Between which columns its middle line lies.
    chord: [f64; 2],
    reach_x: f64,
    reach_y: f64,
}

impl Band {
    /// The columns that it touches in a row, no further than the `last`.
    fn columns(&self, row: u32, last: u32) -> RangeInclusive<u32> {
        let at = |y: f64| {
            let x = self.start.x + (y - self.start.y) * self.slope;
            x.max(self.chord[0]).min(self.chord[1])
        };
        let row = f64::from(row);
        let (bottom, top) = (at(row - self.reach_y), at(row + 1.0 + self.reach_y));
        let from = (bottom.min(top) - self.reach_x).max(self.ends[0]);
        let to = (bottom.max(top) + self.reach_x).min(self.ends[1]);
        cell_number(from).min(last)..=cell_number(to).min(last)
    }
}

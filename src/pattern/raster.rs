//! A rectangle of texture space in equal cells: which cells a curve crosses, or a box touches.

mod placed;

use super::pieces::{bounds, sagitta};
use bytemuck::{Pod, Zeroable};
use core::cell::OnceCell;
use core::ops::Range;
use glam::DVec2;
use placed::Placed;
use rayon::prelude::*;

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

/// Cells that a box touches.
#[derive(Clone, Debug)]
pub(crate) struct Touched {
    pub columns: Range<u32>,
    pub rows: Range<u32>,
    /// Where the box begins and ends, in cells from the origin.
    pub within: [DVec2; 2],
}

impl Touched {
    /// Of so many columns and rows, those that a box touches that is told in cells, if any.
    #[inline(always)]
    fn of([columns, rows]: [u32; 2], [from, to]: [DVec2; 2]) -> Option<Self> {
        let end = DVec2::new(columns.into(), rows.into());
        // A hair of slack again; false for NaN and for a grid of nothing.
        let slack = DVec2::splat(1e-9);
        if !(from.cmple(end + slack).all() && to.cmpge(-slack).all() && columns > 0) {
            return None;
        }
        let last = end - 1.0;
        let cell = |place: f64, last: f64| cell_number(if place < last { place } else { last });
        Some(Self {
            columns: cell(from.x, last.x)..cell(to.x, last.x) + 1,
            rows: cell(from.y, last.y)..cell(to.y, last.y) + 1,
            within: [from, to],
        })
    }

    /// How many cells these are.
    pub(super) fn count(&self) -> u32 {
        let length = |range: &Range<u32>| range.end - range.start;
        length(&self.columns).saturating_mul(length(&self.rows))
    }
}

/// A curve, and what rasters ask it for.
pub(super) struct Outline<'c> {
    control: &'c [DVec2; 4],
    bounds: [DVec2; 2],
    sagitta: OnceCell<f64>,
}

impl<'c> Outline<'c> {
    pub(super) fn of(control: &'c [DVec2; 4]) -> Self {
        Self {
            control,
            bounds: bounds(control),
            sagitta: OnceCell::new(),
        }
    }

    fn chord(&self) -> [DVec2; 2] {
        [self.control[0], self.control[3]]
    }

    fn sagitta(&self) -> f64 {
        *self.sagitta.get_or_init(|| sagitta(self.control))
    }
}

/// What a raster for many things must span, and how large they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extents {
    hull: [DVec2; 2],
    count: f64,
    /// Width and height together, on average.
    size: f64,
}

impl Extents {
    /// Of `count` things with these lowest and highest coordinates; nothing of none.
    pub(super) fn of(count: usize, bounds: impl Fn(usize) -> [DVec2; 2] + Sync) -> Option<Self> {
        const PORTION: usize = 1 << 16;
        // In portions, one after the other: sums in another order would be others.
        let portions = (0..count.div_ceil(PORTION)).into_par_iter().map(|portion| {
            let empty = ([DVec2::INFINITY, DVec2::NEG_INFINITY], 0.0);
            let all = portion * PORTION..count.min((portion + 1) * PORTION);
            all.map(&bounds)
                .fold(empty, |([low, high], size), [from, to]| {
                    let hull = [low.min(from), high.max(to)];
                    (hull, size + (to - from).element_sum())
                })
        });
        let portions: Vec<([DVec2; 2], f64)> = portions.collect();
        let hulls = portions.iter().map(|portion| portion.0);
        let hull = hulls.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let count = count as f64;
        let size = portions.iter().map(|portion| portion.1).sum::<f64>() / count;
        Some(Self { hull, count, size })
    }

    /// Square cells with about `per_cell` things for each, of which a thing touches about `most` on average, or
    /// fewer. They span slightly more than the things; for one line they are a strip.
    pub(super) fn raster(&self, per_cell: f64, most: f64) -> Raster {
        let [low, high] = self.hull;
        let longest = (high - low).max_element();
        let size = (high - low).max(DVec2::splat(longest / 64.0)) * (1.0 + 1e-9);
        let side = self.size / most;
        let fewest = size.x * size.y / (side * side);
        Raster::over(low, size, (self.count / per_cell).min(fewest).max(1.0))
    }
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

    /// A box, `per_side` by `per_side`.
    pub(super) fn of_box([low, high]: [DVec2; 2], per_side: f64) -> Self {
        let count = cell_number(per_side);
        Self {
            origin: low,
            per_unit: per_side / (high - low),
            columns: count,
            rows: count,
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
        self.touched(low, high).map_or(0, |touched| touched.count())
    }

    /// Where a cell is lowest and highest: where it ends, to the bit, its neighbours begin.
    pub(super) fn corners(&self, number: usize) -> [DVec2; 2] {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        let cell = DVec2::new(
            (number % self.columns).into(),
            (number / self.columns).into(),
        );
        [0.0, 1.0].map(|i| self.corner(cell + i))
    }

    /// So many columns and rows from the origin.
    fn corner(&self, place: DVec2) -> DVec2 {
        self.origin + place / self.per_unit
    }

    /// The same, of a raster of this box: its outermost cells end where the box does.
    pub(super) fn corners_within(&self, number: usize, [low, high]: [DVec2; 2]) -> [DVec2; 2] {
        let [from, to] = self.corners(number);
        let columns = self.columns as usize;
        let is_last = [
            number % columns + 1 == columns,
            number / columns + 1 == self.rows as usize,
        ];
        let end = |axis: usize| if is_last[axis] { high[axis] } else { to[axis] };
        [from.max(low), DVec2::new(end(0), end(1))]
    }

    /// One of its cells.
    pub(crate) fn cell(&self, number: usize) -> Self {
        Self {
            origin: self.corners(number)[0],
            columns: 1,
            rows: 1,
            ..*self
        }
    }

    /// Calls `visit` with the number of each cell that a curve may cross.
    pub(super) fn for_each_cell(&self, curve: &Outline<'_>, mut visit: impl FnMut(u32)) {
        let reach = || curve.sagitta() * self.per_unit;
        let placed = self.placed(curve.chord(), curve.bounds);
        placed.for_each_cell(self.sides(), reach, |[column, row]| {
            visit(row * self.columns + column);
        });
    }

    /// Calls `visit` with the number of each cell that a curve may cross, and of each part of the cell that it may: `side`
    /// tells how many there are across.
    pub(super) fn for_each_part_of_cells(
        &self,
        curve: &Outline<'_>,
        side: impl Fn(u32) -> u32,
        mut visit: impl FnMut(u32, u32),
    ) {
        let reach = || curve.sagitta() * self.per_unit;
        let placed = self.placed(curve.chord(), curve.bounds);
        placed.for_each_cell(self.sides(), reach, |[column, row]| {
            let cell = row * self.columns + column;
            let side = side(cell);
            let across = f64::from(side);
            let parts = placed.within([column, row], across);
            parts.for_each_cell(
                [side; 2],
                || across * reach(),
                |[column, row]| visit(cell, row * side + column),
            );
        });
    }

    /// Calls `visit` with the number of each cell that may lie within `reach` of a line.
    pub(super) fn for_each_cell_within(
        &self,
        reach: f64,
        [a, b]: [DVec2; 2],
        mut visit: impl FnMut(u32),
    ) {
        let bounds = [a.min(b) - reach, a.max(b) + reach];
        let placed = self.placed([a, b], bounds);
        placed.for_each_cell(
            self.sides(),
            || reach * self.per_unit,
            |[column, row]| visit(row * self.columns + column),
        );
    }

    fn sides(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }

    fn placed(&self, chord: [DVec2; 2], bounds: [DVec2; 2]) -> Placed {
        Placed {
            chord: chord.map(|place| self.in_cells(place)),
            bounds: bounds.map(|place| self.in_cells(place)),
        }
    }

    /// Calls `visit` with each cell that a line crosses, and the part of the line that lies in it, from one share of
    /// it to another; all parts make up the line.
    pub(super) fn for_each_part(&self, [a, b]: [DVec2; 2], mut visit: impl FnMut(u32, [f64; 2])) {
        let [from, to] = [a, b].map(|p| (p - self.origin) * self.per_unit);
        let most = DVec2::new(self.columns.into(), self.rows.into()) - 1.0;
        let cell = |p: DVec2| {
            let cell = p.clamp(DVec2::ZERO, most);
            cell_number(cell.y) * self.columns + cell_number(cell.x)
        };
        if cell(from) == cell(to) {
            return visit(cell(from), [0.0, 1.0]);
        }
        let step = to - from;
        let mut before = 0.0;
        let mut put = |upto: f64| {
            if upto > before {
                visit(cell(from + 0.5 * (before + upto) * step), [before, upto]);
                before = upto;
            }
        };
        let mut next = [0, 1].map(|axis| Borders::between(from[axis], to[axis]));
        let mut at = next.each_ref().map(Borders::place);
        while at[0].min(at[1]) < f64::INFINITY {
            let axis = usize::from(at[1] < at[0]);
            put(at[axis]);
            next[axis].pass();
            at[axis] = next[axis].place();
        }
        put(1.0);
    }

    /// A place in cells from the origin.
    #[inline(always)]
    pub(super) fn in_cells(&self, place: DVec2) -> DVec2 {
        (place - self.origin) * self.per_unit
    }

    /// Its lowest and highest (u, v), and a hair of slack.
    pub(super) fn hull(&self) -> [DVec2; 2] {
        let [low, high] = self.bounds();
        let slack = DVec2::splat(1e-9) / self.per_unit;
        [low - slack, high + slack]
    }

    /// The cells that a box touches, if any.
    #[inline(always)]
    pub(crate) fn touched(&self, low: DVec2, high: DVec2) -> Option<Touched> {
        Touched::of(self.sides(), [self.in_cells(low), self.in_cells(high)])
    }
}

/// Whole numbers between two, from the first to the second.
struct Borders {
    from: f64,
    step: f64,
    next: f64,
    side: f64,
    count: f64,
}

impl Borders {
    fn between(from: f64, to: f64) -> Self {
        let (low, high) = (from.min(to), from.max(to));
        let side = if to < from { -1.0 } else { 1.0 };
        let next = if to < from {
            -floor(-from) - 1.0
        } else {
            floor(from) + 1.0
        };
        let count = (-floor(-high) - 1.0 - floor(low)).max(0.0);
        Self {
            from,
            step: to - from,
            next,
            side,
            count,
        }
    }

    /// The share of the way at which the next one is passed; beyond all of it if there is none.
    fn place(&self) -> f64 {
        if self.count > 0.0 {
            ((self.next - self.from) / self.step).clamp(0.0, 1.0)
        } else {
            f64::INFINITY
        }
    }

    fn pass(&mut self) {
        self.next += self.side;
        self.count -= 1.0;
    }
}

/// The same as [`f64::floor`] of a place in cells, without a call.
#[expect(
    clippy::cast_possible_truncation,
    reason = "places lie within a few times 4096 cells"
)]
fn floor(at: f64) -> f64 {
    let whole = at as i64 as f64;
    if whole > at { whole - 1.0 } else { whole }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates: below the grid is cell 0"
)]
#[inline(always)]
pub(super) fn cell_number(at: f64) -> u32 {
    at as u32
}

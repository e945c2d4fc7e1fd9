//! A cell of the plate, divided again and again until few strips are left in each part.

use super::cover::{Covered, Left, Line};
use super::part::Part;
use crate::pattern::grid::number;
use crate::pattern::lists::Lists;
use crate::pattern::raster::Raster;
use crate::pattern::strip::Strip;
use glam::DVec2;
use rayon::prelude::*;

/// Parts with no more strips than this are not divided.
const FEW: usize = 96;

/// Strips that a part should have, where more are divided.
const PER_PART: f64 = 48.0;

/// Parts per side of what is divided in one go.
const MOST_PER_SIDE: f64 = 64.0;

/// Dividing until few are left may list the strips of a cell again so many times.
const MOST_LISTED: f64 = 16.0;

/// From this many strips on, parts are cells of their own, looked at on all cores.
const MANY: usize = 4096;

/// Strips of a cell, all that parts of it list by their places here, and what is left of them.
pub(super) struct Cell {
    pub lines: Vec<Line>,
    pub left: Vec<Left>,
}

/// Strips in a box, which may be listed so many times in all.
struct Crowd<'l> {
    list: &'l [u32],
    within: [DVec2; 2],
    room: f64,
}

/// Adds what covers strips of a list, of all pairs whose place lies in a box.
pub(super) fn look(part: &mut Part, list: &[u32], strips: &[Covered], within: [DVec2; 2]) {
    let room = MOST_LISTED * list.len() as f64;
    look_in(part, &Crowd { list, within, room }, strips);
}

fn look_in(part: &mut Part, crowd: &Crowd<'_>, strips: &[Covered]) {
    let list = crowd.list;
    if list.len() > MANY {
        let strip = |i: u32| strips[i as usize].strip();
        let per_side = crowd.parts_per_side(strip);
        if per_side >= 2.0 {
            let parts = crowd.parts(per_side, strip);
            let look = |part: &mut Part, number| look_in(part, &parts.part(number), strips);
            let all = 0..parts.lists.starts.len() - 1;
            all.into_par_iter().for_each_init(Part::default, look);
            return;
        }
    }
    let mut cell = Cell::of(list, strips);
    let all: Vec<u32> = (0..list.len()).map(number).collect();
    cell.share_out(
        part,
        &Crowd {
            list: &all,
            ..*crowd
        },
    );
    for (&i, left) in list.iter().zip(&cell.left) {
        strips[i as usize].add(*left);
    }
}

impl Cell {
    fn of(list: &[u32], strips: &[Covered]) -> Self {
        // All at once: many are waited for at the same time.
        let strips: Vec<Strip> = list.iter().map(|&i| strips[i as usize].strip()).collect();
        let line = |(&i, strip)| Line::of(i, strip);
        Self {
            lines: list.iter().zip(&strips).map(line).collect(),
            left: vec![[1.0; 4]; list.len()],
        }
    }

    /// Takes from what is left what pairs say whose place lies in a box.
    fn share_out(&mut self, part: &mut Part, crowd: &Crowd<'_>) {
        let strip = |i: u32| self.lines[i as usize].strip;
        let per_side = crowd.parts_per_side(strip);
        if per_side < 2.0 {
            part.pairs(self, crowd.list, crowd.within);
            return;
        }
        let parts = crowd.parts(per_side, strip);
        for number in 0..parts.lists.starts.len() - 1 {
            self.share_out(part, &parts.part(number));
        }
    }
}

/// A crowd divided.
struct Parts {
    raster: Raster,
    within: [DVec2; 2],
    lists: Lists<u32>,
    room: f64,
}

impl Parts {
    fn part(&self, number: usize) -> Crowd<'_> {
        let list = self.lists.of(number);
        Crowd {
            list,
            within: self.raster.corners_within(number, self.within),
            room: self.room * list.len() as f64 / self.lists.items.len() as f64,
        }
    }
}

impl Crowd<'_> {
    fn parts(&self, per_side: f64, strip: impl Fn(u32) -> Strip) -> Parts {
        let raster = Raster::of_box(self.within, per_side);
        let mut listed = Vec::with_capacity(2 * self.list.len());
        for &i in self.list {
            let Strip {
                start,
                end,
                half_width,
            } = strip(i);
            raster.for_each_cell_within(half_width, [start, end], |part| listed.push((part, i)));
        }
        Parts {
            raster,
            within: self.within,
            lists: Lists::few(raster.count(), &listed),
            room: self.room,
        }
    }

    /// How finely it is to be divided.
    fn parts_per_side(&self, strip: impl Fn(u32) -> Strip) -> f64 {
        let count = self.list.len() as f64;
        if self.list.len() <= FEW {
            return 1.0;
        }
        let size = self.within[1] - self.within[0];
        // In units of the box: each border that a strip crosses lists it once more.
        let extent = |&i: &u32| {
            let Strip {
                start,
                end,
                half_width,
            } = strip(i);
            let extent = (end - start).abs() + 2.0 * half_width;
            (extent / size).min(DVec2::ONE).element_sum()
        };
        let extents: f64 = self.list.iter().map(extent).sum();
        // A part of k² has count / k² + extents / k of them.
        let wanted = extents + (extents * extents + 4.0 * PER_PART * count).sqrt();
        let most = (self.room - count) / extents;
        (wanted / (2.0 * PER_PART))
            .min(most)
            .min(MOST_PER_SIDE)
            .floor()
    }
}

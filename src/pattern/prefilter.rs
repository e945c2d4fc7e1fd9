//! What whole cells of the grid hold of each cross-section and direction, at every scale: for pixels that hold
//! more scratches than can be looked at one by one.

use super::Pattern;
use super::caps::ENDS;
use super::closest::{LengthShares, bezier, tangent};
use super::crowd::{Crowd, MOST_ENTRIES, Packed, keys};
use super::hit::Hit;
use super::lists::Lists;
use super::query::{Candidates, Reach};
use super::raster::{Raster, cell_number};
use super::store::Store;
use bytemuck::{Pod, Zeroable};
use glam::DVec2;
use rayon::prelude::*;

/// Cells that a pixel's bounding box may touch: a level is chosen for it.
const MOST_CELLS: u32 = 64;

/// A piece counts as a chain of at most this many straight chords.
const MOST_CHORDS: f64 = 512.0;

/// A chord turns no more than this.
const CHORD_RAD: f64 = 0.07;

/// A chord's cross-section changes no more than this share of its size.
const CHORD_CHANGE: f64 = 0.14;

/// Quarters of a piece of which later scratches leave shares closer than this, 255ths, count with their mean.
const EVEN: u8 = 5;

/// A pyramid of cells: level 0 are the grid's, each level has half as many per side as the one before.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pyramid {
    pub(super) levels: Store<Level>,
    /// Where each cell's entries start; one more than there are cells.
    pub(super) starts: Store<u32>,
    pub(super) entries: Store<Packed>,
}

#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Level {
    raster: Raster,
    first_cell: u32,
    padding: u32,
}

/// A straight stretch of scratch.
struct Chord {
    ends: [DVec2; 2],
    classes: [(usize, f32); 4],
    /// Along the scratch, in texture space times units per (u, v).
    travel: DVec2,
    area_mm2: f32,
}

impl Pattern {
    /// What a footprint holds of all scratches, however many; exact while the pieces are.
    pub(crate) fn crowd(&self, reach: &Reach<'_>, candidates: Option<&Candidates>) -> Crowd {
        let mut crowd = Crowd::new();
        match candidates {
            Some(candidates) => {
                let mut last = None;
                for &number in candidates {
                    let mut is_held = false;
                    let share = |ends: [DVec2; 2]| {
                        let ends = ends.map(|uv| reach.place(uv));
                        reach.footprint.share_of_segment(ends)
                    };
                    self.for_each_chord(number as usize, share, |chord| {
                        is_held = true;
                        let (classes, travel) = (&chord.classes, chord.travel);
                        crowd.add(&self.palette, classes, travel, chord.area_mm2);
                    });
                    let scratch = self.curves().pieces.get(number as usize).map(|p| p.scratch);
                    if is_held && last != scratch {
                        crowd.count += 1;
                        last = scratch;
                    }
                }
            }
            None => self.pyramid.add_to(&mut crowd, reach),
        }
        crowd
    }

    /// Adds one run that covers `area_mm2` of a footprint.
    pub(crate) fn add_run(
        &self,
        crowd: &mut Crowd,
        hit: &Hit<'_>,
        reach: &Reach<'_>,
        area_mm2: f64,
    ) {
        // From mm into the pattern's own scale, and back when it is shaded.
        let travel = reach.metric.step_uv(hit.travel) * self.units_per_uv;
        let area_mm2 = area_mm2 * travel.length() * self.mm_per_scene_unit;
        let classes = hit.track.classes(hit.place);
        crowd.add(&self.palette, &classes, travel, crate::single(area_mm2));
    }

    /// Calls `visit` with the chords of a piece of which a share counts, each with that share of its area.
    fn for_each_chord(
        &self,
        number: usize,
        share: impl Fn([DVec2; 2]) -> f64,
        mut visit: impl FnMut(Chord),
    ) {
        let curves = self.curves();
        let Some((track, course)) = curves
            .pieces
            .get(number)
            .and_then(|piece| self.strand(piece.scratch))
        else {
            return;
        };
        let (control, [from, to]) = (curves.control(number), curves.at(number));
        let scaled = control.map(|p| p * self.units_per_uv);
        let visible = evened(self.visible(number));
        let is_even = visible.iter().all(|quarter| *quarter == visible[0]);
        let turn_rad = turn_rad(&scaled);
        let lengths = LengthShares::of(&scaled);
        let (mut start, mut first_t) = (control[0], 0.0);
        // Between two turns of its course the cross-section changes one way.
        for [[_, first], [at, last]] in course.turns(from, to) {
            let last_t = match at < to {
                true => lengths.parameter((at - from) / (to - from)),
                false => 1.0,
            };
            let span = last_t - first_t;
            let change = (track.change(last) - track.change(first)).abs();
            let needed = (span * turn_rad / CHORD_RAD)
                .max(change / CHORD_CHANGE)
                .max(if is_even { 1.0 } else { 4.0 * span });
            let count = cell_number(needed.ceil().clamp(1.0, MOST_CHORDS));
            let place = |t: f64| course.value(from + (to - from) * lengths.at(t));
            for i in 0..count {
                let t = |i: f64| first_t + span * i / f64::from(count);
                let ends = [start, bezier(&control, t(f64::from(i + 1)))];
                start = ends[1];
                let share = share(ends);
                if share <= 0.0 {
                    continue;
                }
                let middle_t = t(f64::from(i) + 0.5);
                let (sides, classes) = track.ends_and_classes(place(middle_t));
                let mean_width = if change > 0.0 {
                    track.mean_width(place(t(f64::from(i))), place(t(f64::from(i + 1))))
                } else {
                    f64::from(sides[1] - sides[0])
                };
                let travel = (ends[1] - ends[0]) * self.units_per_uv;
                let visible = visible[cell_number(4.0 * middle_t).min(3) as usize];
                let area_mm2 = travel.length() * self.mm_per_scene_unit * mean_width * share;
                visit(Chord {
                    ends,
                    classes,
                    travel,
                    area_mm2: crate::single(area_mm2 * visible),
                });
            }
            first_t = last_t;
        }
        self.for_each_cap_chord(number, share, &mut visit);
    }

    /// Caps count in a crowd as so much of their scratch's own cross-section, across each sector's axis.
    fn for_each_cap_chord(
        &self,
        number: usize,
        share: impl Fn([DVec2; 2]) -> f64,
        visit: &mut impl FnMut(Chord),
    ) {
        let curves = self.curves();
        let visible = self.visible(number);
        for (end, visible) in ENDS.into_iter().zip([visible[0], visible[3]]) {
            let visible = f64::from(visible) / 255.0;
            let Some(cap) = self.cap_at(number, end) else {
                continue;
            };
            let Some((track, _)) = self.strand(curves.pieces[number].scratch) else {
                continue;
            };
            let control = curves.control(number);
            let ends = [bezier(&control, cap.at); 2];
            let share = share(ends);
            if share <= 0.0 {
                continue;
            }
            let scaled = control.map(|p| p * self.units_per_uv);
            let classes = track.classes(cap.place);
            for sector in cap.sectors() {
                let [_, _, axis] = sector.wedge.directions(tangent(&scaled, cap.at));
                visit(Chord {
                    ends,
                    classes,
                    travel: axis.perp(),
                    area_mm2: crate::single(sector.area_mm2() * visible * share),
                });
            }
        }
    }
}

/// How much a piece turns, and no less.
fn turn_rad([a, b, c, d]: &[DVec2; 4]) -> f64 {
    let (first, middle, last) = (b - a, c - b, d - c);
    first.angle_to(last).abs() + first.angle_to(middle).abs()
}

/// What is left of each quarter, as a share; their mean, if they differ little.
fn evened(visible: [u8; 4]) -> [f64; 4] {
    let (low, high) = (visible.into_iter().min(), visible.into_iter().max());
    let visible = visible.map(|quarter| f64::from(quarter) / 255.0);
    match (low, high) {
        (Some(low), Some(high)) if high - low > EVEN => visible,
        _ => [0.25 * visible.iter().sum::<f64>(); 4],
    }
}

/// What one chord has in one cell of one key of a crowd.
#[derive(Clone, Copy, Debug, Default)]
struct Held {
    area_mm2: f32,
    key: u16,
    /// Within the direction's step, in 65534ths.
    place: i16,
}

impl Held {
    const PLACES: f32 = 65534.0;

    #[expect(
        clippy::cast_possible_truncation,
        reason = "from -1/2 to 1/2 of PLACES"
    )]
    fn new(key: usize, area_mm2: f32, place: f32) -> Self {
        Self {
            area_mm2,
            key: u16::try_from(key).unwrap_or(0),
            place: (Self::PLACES * place).round() as i16,
        }
    }

    fn add_to(self, crowd: &mut Crowd) {
        let place = f32::from(self.place) / Self::PLACES;
        crowd.add_to(self.key.into(), self.area_mm2, self.area_mm2 * place);
    }
}

impl Pyramid {
    /// Of a pattern that has all but this.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let raster = pattern.grid.raster;
        let mut pyramid = Self::default();
        if raster.count() == 0 {
            return pyramid;
        }
        // Piece by piece, as they lie in memory, and sorted by cell afterwards.
        let pieces = pattern.curves().pieces.len();
        let held = Lists::new(raster.count(), pieces, |number, sink| {
            pattern.for_each_chord(
                number,
                |_| 1.0,
                |chord| {
                    raster.for_each_share(chord.ends, |cell, share| {
                        let area_mm2 = chord.area_mm2 * crate::single(share);
                        for (key, share, place) in
                            keys(&pattern.palette, &chord.classes, chord.travel)
                        {
                            sink.put(cell, Held::new(key, share * area_mm2, place));
                        }
                    });
                },
            );
        });
        let first: Vec<Vec<Packed>> = (0..raster.count())
            .into_par_iter()
            .map(|cell| {
                let mut crowd = Crowd::new();
                for held in held.of(cell) {
                    held.add_to(&mut crowd);
                }
                crowd.packed().collect()
            })
            .collect();
        drop(held);
        pyramid.push(raster, &first);
        let (mut raster, mut cells) = (raster, first);
        while raster.count() > 1 {
            let coarser = raster.coarser();
            let merged = |cell: usize| {
                let mut crowd = Crowd::new();
                for child in raster.children(coarser, cell) {
                    crowd.add_packed(&cells[child], 1.0);
                }
                crowd.packed().collect()
            };
            cells = (0..coarser.count()).into_par_iter().map(merged).collect();
            pyramid.push(coarser, &cells);
            raster = coarser;
        }
        pyramid
    }

    /// Whether all cells of all levels have entries.
    #[cfg(feature = "files")]
    pub(super) fn is_sound(&self) -> bool {
        let cells = self.starts.len().saturating_sub(1);
        self.levels.iter().all(|level| {
            level.raster.is_sound()
                && level
                    .raster
                    .count()
                    .checked_add(level.first_cell as usize)
                    .is_some_and(|end| end <= cells)
        })
    }

    /// Memory of all arrays.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.levels[..])
            + size_of_val(&self.starts[..])
            + size_of_val(&self.entries[..])
    }

    fn push(&mut self, raster: Raster, cells: &[Vec<Packed>]) {
        let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.levels.push(Level {
            raster,
            first_cell: number(self.starts.len() - 1),
            padding: 0,
        });
        for cell in cells {
            self.entries.extend(cell);
            self.starts.push(number(self.entries.len()));
        }
    }

    /// Adds what a footprint holds: each cell of the level that suits its size, by the area they share.
    fn add_to(&self, crowd: &mut Crowd, reach: &Reach<'_>) {
        let [low, high] = reach.footprint_uv();
        let fits = |level: &&Level| level.raster.count_touched(low, high) <= MOST_CELLS;
        let Some(level) = self.levels.iter().find(fits).or(self.levels.last()) else {
            return;
        };
        let Some((columns, rows)) = level.raster.touched(low, high) else {
            return;
        };
        for row in rows {
            for column in columns.clone() {
                let cell = row * level.raster.columns + column;
                let entries = self.entries_of(level.first_cell + cell);
                if entries.is_empty() {
                    continue;
                }
                let [low, high] = level.raster.cell(cell as usize).bounds();
                let corner = |u: f64, v: f64| reach.place(DVec2::new(u, v));
                let corners = [
                    corner(low.x, low.y),
                    corner(high.x, low.y),
                    corner(high.x, high.y),
                    corner(low.x, high.y),
                ];
                let share = crate::single(reach.footprint.share_of_cell(corners));
                if share > 0.0 {
                    crowd.add_packed(entries, share);
                    let count = u32::try_from(entries.len()).unwrap_or(0);
                    crowd.count = crowd.count.saturating_add(count);
                }
            }
        }
    }

    fn entries_of(&self, cell: u32) -> &[Packed] {
        let start = |i: usize| self.starts.get(i).map_or(0, |&start| start as usize);
        let cell = cell as usize;
        let entries = self.entries.get(start(cell)..start(cell + 1));
        // A damaged file may claim anything.
        entries
            .filter(|entries| entries.len() <= MOST_ENTRIES)
            .unwrap_or(&[])
    }
}

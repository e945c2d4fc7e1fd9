//! What whole cells of the grid hold of each cross-section and direction, at every scale: for pixels that hold
//! more scratches than can be looked at one by one.

use super::Pattern;
use super::chords::{ClassAreas, add_shares};
use super::crowd::{FarCrowd, Heading, MOST_ENTRIES, NearCrowd, Packed, keys};
use super::grid::number;
use super::hit::Hit;
use super::laid::{Laid, Way};
use super::lists::{Lists, Sink, of_items};
use super::palette::MOST_CLASSES;
use super::query::{Candidates, Reach};
use super::raster::{Raster, Touched};
use super::reader::Reader;
use super::store::Store;
use super::strips::{EVEN, Strips};
use arrayvec::ArrayVec;
use bytemuck::{Pod, Zeroable};
use core::array::from_fn;
use core::ops::Range;
use glam::DVec2;
use rayon::prelude::*;

/// Cells that a pixel's bounding box may touch: a level is chosen for it.
const MOST_CELLS: u32 = 64;

/// Pieces whose scratches are touched together before they are looked at.
const TOUCHED: usize = 16;

/// Areas of one piece that are gathered before they are sorted by cell.
const MOST_GATHERED: usize = 32;

/// Cells of a coarser level that are filled in one go.
const PORTION: usize = 256;

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

impl Pattern {
    /// What a footprint holds of these pieces (in their order), less what later ones take; nothing if these are
    /// fewer scratches than `least`.
    pub(crate) fn crowd_of(
        &self,
        reach: &Reach<'_>,
        candidates: &Candidates,
        least: usize,
    ) -> Option<NearCrowd> {
        let mut crowd = NearCrowd::new();
        let mut to_come = self.scratches_of(candidates);
        let mut is_held = false;
        let mut laid = Laid::new();
        let mut reader = Reader::new(self);
        for (i, &number) in candidates.iter().enumerate().rev() {
            if i % TOUCHED == TOUCHED - 1 || i + 1 == candidates.len() {
                self.touch(&candidates[i - i % TOUCHED..=i]);
            }
            reader.for_each_chord(number as usize, Some(reach), |chord| {
                let Some(width_mm) = chord.width_mm() else {
                    is_held = true;
                    crowd.add(&self.palette, chord.areas([0.0, 1.0]), chord.heading, &EVEN);
                    return;
                };
                let ends = chord.ends.map(|uv| reach.place(uv));
                let Some(way) = Way::within(reach.footprint, ends, width_mm) else {
                    return;
                };
                is_held = true;
                let (areas, strips) = chord.areas_left(way.stretch, |mean| {
                    let left = laid.left_of(&way);
                    if laid.lay(&way) {
                        left
                    } else {
                        way.whole().map(|whole| whole * mean)
                    }
                });
                crowd.add(&self.palette, areas, chord.heading, &strips);
            });
            let of = |number: u32| self.curves().scratch(number);
            if i == 0 || of(candidates[i - 1]) != of(number) {
                to_come = to_come.saturating_sub(1);
                crowd.count += u32::from(core::mem::take(&mut is_held));
                if crowd.count as usize + to_come < least {
                    return None;
                }
            }
        }
        Some(crowd)
    }

    /// Adds what a footprint holds of the caps of these pieces, as far as they do not stand by themselves beside what is so
    /// thin.
    pub(crate) fn add_thin_caps(
        &self,
        crowd: &mut Option<NearCrowd>,
        candidates: &Candidates,
        reach: &Reach<'_>,
        thin_mm: f64,
    ) {
        for &number in candidates {
            self.for_each_cap_chord(number as usize, Some(reach), thin_mm, &mut |chord| {
                let crowd = crowd.get_or_insert_with(NearCrowd::new);
                crowd.add(&self.palette, chord.areas([0.0, 1.0]), chord.heading, &EVEN);
            });
        }
    }

    /// What a footprint holds of all scratches, however many, as far as cells as large as its parts tell.
    pub(crate) fn crowd(&self, reach: &Reach<'_>) -> FarCrowd {
        let mut crowd = FarCrowd::new();
        self.pyramid.add_to(&mut crowd, reach);
        crowd
    }

    /// Adds one run that covers `area_mm2` of a footprint, of which strips across have these shares.
    pub(crate) fn add_run(
        &self,
        crowd: &mut NearCrowd,
        hit: &Hit<'_>,
        reach: &Reach<'_>,
        area_mm2: f64,
        strips: &Strips,
    ) {
        // From mm into the pattern's own scale, and back when it is shaded.
        let travel = reach.metric.step_uv(hit.line.travel) * self.units_per_uv;
        let area_mm2 = area_mm2 * travel.length() * self.mm_per_scene_unit;
        let mut areas = ClassAreas::default();
        let classes = hit.track.classes(hit.place);
        add_shares(&mut areas, &classes, crate::single(area_mm2));
        crowd.add(&self.palette, areas, Heading::of(travel), strips);
    }
}

/// What one piece has in one cell of one key of a crowd.
#[derive(Clone, Copy, Debug, Zeroable)]
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
    fn new(gathered: &Gathered) -> Self {
        let place = Self::PLACES * gathered.moment / gathered.area_mm2;
        Self {
            area_mm2: gathered.area_mm2,
            key: u16::try_from(gathered.key).unwrap_or(0),
            place: (place + f32::copysign(0.5, place)) as i16,
        }
    }

    fn add_to(self, crowd: &mut FarCrowd) {
        let place = f32::from(self.place) / Self::PLACES;
        crowd.add_to(self.key.into(), self.area_mm2, self.area_mm2 * place);
    }
}

/// The same while chord after chord is added: area, and area times the place within the direction's step.
struct Gathered {
    cell: u32,
    key: usize,
    area_mm2: f32,
    moment: f32,
}

/// What one piece has in all cells.
#[derive(Default)]
struct OfPiece(ArrayVec<Gathered, MOST_GATHERED>);

impl OfPiece {
    fn add(&mut self, cell: u32, (key, area_mm2, place): (usize, f32, f32), sink: &mut Sink<Held>) {
        let moment = area_mm2 * place;
        let known = self.0.iter_mut().rev();
        for known in known {
            if known.cell == cell && known.key == key {
                known.area_mm2 += area_mm2;
                known.moment += moment;
                return;
            }
        }
        if self.0.is_full() {
            self.put(sink);
        }
        self.0.push(Gathered {
            cell,
            key,
            area_mm2,
            moment,
        });
    }

    fn put(&mut self, sink: &mut Sink<Held>) {
        for gathered in self.0.drain(..) {
            sink.put(gathered.cell, Held::new(&gathered));
        }
    }
}

/// Entries of neighbouring cells.
struct Entries {
    /// Where each cell's end.
    ends: Vec<u32>,
    all: Vec<Packed>,
}

impl Entries {
    /// Of these cells, each of which is filled.
    fn of(cells: Range<usize>, fill: impl Fn(usize, &mut FarCrowd)) -> Self {
        let (mut ends, mut all) = (Vec::with_capacity(cells.len()), Vec::new());
        for cell in cells {
            let mut crowd = FarCrowd::new();
            fill(cell, &mut crowd);
            all.extend(crowd.packed());
            ends.push(number(all.len()));
        }
        Self { ends, all }
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
        let symmetric: [bool; MOST_CLASSES] = from_fn(|class| pattern.palette.is_symmetric(class));
        let begin = || Reader::new(pattern);
        let held = of_items(raster.count(), pieces, begin, |reader, number, sink| {
            let mut piece = OfPiece::default();
            reader.for_each_chord(number, None, |chord| {
                raster.for_each_part(chord.ends, |cell, part| {
                    let areas = chord.areas(part);
                    for held in keys(areas, chord.heading, |class| symmetric[class]) {
                        piece.add(cell, held, sink);
                    }
                });
            });
            piece.put(sink);
        });
        let of_group = |(): &mut (), _, held: &Lists<Held>| {
            Entries::of(0..held.count(), |cell, crowd| {
                held.of(cell).iter().for_each(|held| held.add_to(crowd));
            })
        };
        pyramid.push(raster, &held.map(|| (), of_group));
        drop(held);
        pyramid.push_coarser(raster);
        pyramid
    }

    /// Appends all levels above this one.
    fn push_coarser(&mut self, mut raster: Raster) {
        while raster.count() > 1 {
            let coarser = raster.coarser();
            let first = self.levels.last().map_or(0, |level| level.first_cell);
            let of_portion = |portion: usize| {
                let cells = portion * PORTION..coarser.count().min((portion + 1) * PORTION);
                Entries::of(cells, |cell, crowd| {
                    for child in raster.children(coarser, cell) {
                        crowd.add_packed(self.entries_of(first + number(child)), 1.0);
                    }
                })
            };
            let portions = (0..coarser.count().div_ceil(PORTION)).into_par_iter();
            let portions: Vec<Entries> = portions.map(of_portion).collect();
            self.push(coarser, &portions);
            raster = coarser;
        }
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

    /// Appends a level.
    fn push(&mut self, raster: Raster, portions: &[Entries]) {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
        self.levels.push(Level {
            raster,
            first_cell: number(self.starts.len() - 1),
            padding: 0,
        });
        for portion in portions {
            let before = number(self.entries.len());
            self.entries.extend(&portion.all);
            self.starts
                .extend(portion.ends.iter().map(|end| before + end));
        }
    }

    /// Adds what a footprint holds: each cell of the level that suits its size, by the area they share.
    fn add_to(&self, crowd: &mut FarCrowd, reach: &Reach<'_>) {
        let [low, high] = reach.footprint_uv();
        let fits = |level: &&Level| level.raster.count_touched(low, high) <= MOST_CELLS;
        let Some(level) = self.levels.iter().find(fits).or(self.levels.last()) else {
            return;
        };
        let Some(Touched { columns, rows, .. }) = level.raster.touched(low, high) else {
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

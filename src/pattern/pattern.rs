//! A surface with its scratches, ready to be queried.

use super::blank::Blank;
use super::builder::PatternBuilder;
use super::course::Course;
use super::grid::Grid;
use super::hosts::Hosts;
use super::overlap::visible_shares;
use super::palette::Palette;
use super::pieces::{Curves, Piece};
use super::prefilter::Pyramid;
use super::query::Candidates;
use super::reader::Reader;
use super::store::Store;
use super::tracks::{Extent, TrackRef, Tracks};
use crate::brdf::{Finish, Hosted};
use bytemuck::{Pod, Zeroable};
use glam::DVec2;
use rayon::prelude::*;

/// Neighbouring pieces that turn less than this in all are one run, with one frame, degrees. On smooth finishes
/// less: see [`run_cos`].
const MOST_RUN_DEG: f64 = 2.0;

/// From this many scratches on, each is looked at in fewer places when classes are chosen.
const MANY: usize = 1 << 16;

/// A surface with its scratches, immutable: share it between threads as you like.
#[derive(Clone, Debug)]
pub struct Pattern {
    pub(super) points: Store<DVec2>,
    pub(super) pieces: Store<Piece>,
    pub(super) strands: Store<Strand>,
    pub(super) knots: Store<[f32; 2]>,
    pub(super) tracks: Tracks,
    /// What later scratches leave of the quarters of each piece, in 255ths.
    pub(super) visible: Store<[u8; 4]>,
    pub(crate) palette: Palette,
    pub(super) pyramid: Pyramid,
    pub(super) grid: Grid,
    pub(super) blank: Blank,
    pub(crate) surface: Finish,
    pub(crate) mm_per_scene_unit: f64,
    pub(crate) units_per_uv: DVec2,
    /// How far any scratch reaches from its centre line.
    pub(crate) extent: Extent,
    pub(super) run_cos: f64,
    pub(crate) hosts: Hosts,
}

/// How much memory a pattern takes, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PatternMemory {
    /// Control points of all pieces, 16 bytes each.
    pub control_points: usize,
    /// All else: pieces, cross-sections, the grid, what is prefiltered.
    pub rest: usize,
}

/// One scratch: where its share of the arrays begins, and what is its alone.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Strand {
    pub first_piece: u32,
    pub track: u32,
    pub first_knot: u32,
    pub knot_count: u32,
    /// Largest value of its course.
    pub scale: f32,
    /// Arc length, scene units.
    pub length: f32,
}

impl Pattern {
    pub(super) fn of(builder: &PatternBuilder) -> Self {
        let PatternBuilder { plate, kept } = builder;
        let mut tracks = Tracks::default();
        let shared = kept.kinds.tracks();
        shared.iter().chain(&kept.own).for_each(|track| {
            tracks.push(track);
        });
        let hosts = kept.hosts.clone();
        tracks.change_finishes(|finish| hosts.kept(finish));
        let first_own = u32::try_from(shared.len()).unwrap_or(u32::MAX);
        let strand = |added: &super::builder::Added| Strand {
            track: added.strand.track + if added.is_own { first_own } else { 0 },
            ..added.strand
        };
        let smoothest = tracks
            .finishes()
            .iter()
            .map(Finish::alpha)
            .fold(1.0, f32::min);
        let mut pattern = Self {
            points: (&kept.chains.points).into(),
            pieces: (&kept.chains.pieces).into(),
            strands: kept
                .scratches
                .par_iter()
                .map(strand)
                .collect::<Vec<_>>()
                .into(),
            knots: kept.courses.knots().to_vec().into(),
            extent: tracks.extent(),
            run_cos: run_cos(smoothest),
            surface: hosts.kept(Finish::new(&plate.material.surface)),
            mm_per_scene_unit: plate.mm_per_scene_unit,
            units_per_uv: plate.units_per_uv,
            visible: Store::default(),
            palette: Palette::default(),
            pyramid: Pyramid::default(),
            grid: Grid::default(),
            blank: Blank::default(),
            tracks,
            hosts,
        };
        // None of them asks for another, and where one cannot use all cores another does.
        let (grid, (visible, areas)) = rayon::join(
            || Grid::new(pattern.curves()),
            || rayon::join(|| visible_shares(&pattern), || pattern.station_areas()),
        );
        pattern.blank = Blank::new(pattern.curves(), grid.raster.bounds());
        pattern.grid = grid;
        pattern.visible = visible.into();
        pattern.palette = Palette::new(&pattern.tracks, &areas);
        pattern.tracks.blends = pattern.palette.blends(&pattern.tracks).into();
        pattern.tracks.sums = pattern.tracks.class_sums().into();
        pattern.pyramid = Pyramid::new(&pattern);
        pattern
    }

    /// How much scratched area each station of the tracks stands for.
    fn station_areas(&self) -> Vec<f64> {
        /// Numbers that all portions' sums may take.
        const MOST: usize = 1 << 24;
        // Scratches of a portion are added up before any others', so that rounding is the same on any cores.
        let most = (MOST / self.tracks.station_count().max(1)).clamp(1, 64);
        let portion_size = self.strands.len().div_ceil(most).max(1);
        let portions: Vec<Vec<f64>> = (0..self.strands.len().div_ceil(portion_size))
            .into_par_iter()
            .map(|portion| {
                let mut areas = vec![0.0; self.tracks.station_count()];
                let (first, mut reader) = (portion * portion_size, Reader::new(self));
                for scratch in first..self.strands.len().min(first + portion_size) {
                    self.add_areas(&mut reader, scratch, &mut areas);
                }
                areas
            })
            .collect();
        let mut areas = vec![0.0; self.tracks.station_count()];
        for portion in portions {
            for (area, part) in areas.iter_mut().zip(portion) {
                *area += part;
            }
        }
        areas
    }

    /// Adds one scratch's area.
    fn add_areas(&self, reader: &mut Reader<'_>, scratch: usize, areas: &mut [f64]) {
        // Of many, one place each says as much.
        let most = if self.strands.len() < MANY { 4 } else { 1 };
        let number = u32::try_from(scratch).unwrap_or(u32::MAX);
        let Some((track, course)) = self.strand(number) else {
            return;
        };
        let whole = self.length_of(number);
        for [[from, a], [to, b]] in course.turns(0.0, 1.0) {
            let places = if a == b { 1 } else { most };
            for i in 0..places {
                let place = a + (b - a) * (f64::from(i) + 0.5) / f64::from(places);
                let (station, mix, width) = reader.places.get(&track, [place; 2], || {
                    let (station, mix) = track.locate(place);
                    let [left, right] = track.ends_of((station, mix)).map(f64::from);
                    (station, mix, right - left)
                });
                let length = whole * (to - from) / f64::from(places);
                let (area, mix) = (length * width, f64::from(mix));
                let first = track.first_station() + station;
                areas[first] += area * (1.0 - mix);
                if mix > 0.0 {
                    areas[first + 1] += area * mix;
                }
            }
        }
    }

    /// The share of a piece that later scratches leave.
    pub(super) fn visible_share(&self, piece: usize) -> f32 {
        let quarters = self.visible(piece).map(f32::from);
        quarters.iter().sum::<f32>() / (4.0 * 255.0)
    }

    /// What later scratches leave of the quarters of a piece, in 255ths.
    pub(super) fn visible(&self, piece: usize) -> [u8; 4] {
        self.visible.get(piece).copied().unwrap_or([255; 4])
    }

    /// The host's own base BRDFs that its zones have, each once: the surface's, then those of its scratches in the order
    /// in which they were added (that of the bulk, then the layers' from the surface down; the surface's own material
    /// first).
    pub fn hosted(&self) -> &[Hosted] {
        &self.hosts.0
    }

    /// How many scratches it holds.
    pub fn scratch_count(&self) -> usize {
        self.strands.len()
    }

    /// How much memory it takes: all its arrays.
    pub fn memory_bytes(&self) -> PatternMemory {
        let control_points = size_of_val(&self.points[..]);
        let rest = size_of_val(&self.pieces[..])
            + size_of_val(&self.strands[..])
            + size_of_val(&self.knots[..])
            + size_of_val(&self.visible[..])
            + self.tracks.bytes()
            + self.pyramid.bytes()
            + self.grid.bytes()
            + self.blank.bytes();
        PatternMemory {
            control_points,
            rest,
        }
    }

    /// How many pieces touch a box in (u, v): the index alone, for its bench.
    #[doc(hidden)]
    pub fn count_near(&self, low_uv: [f64; 2], high_uv: [f64; 2]) -> usize {
        let mut found = Candidates::new();
        self.pieces_near(DVec2::from(low_uv), DVec2::from(high_uv), &mut found);
        found.len()
    }

    /// Bytes of the index alone, for its bench.
    #[doc(hidden)]
    pub fn index_bytes(&self) -> usize {
        self.grid.bytes()
    }

    pub(super) fn curves(&self) -> Curves<'_> {
        Curves {
            points: &self.points,
            pieces: &self.pieces,
        }
    }

    /// A scratch's way in (u, v), as cubic Bézier curves from start to end.
    #[cfg(feature = "files")]
    pub(crate) fn way(&self, scratch: u32) -> impl Iterator<Item = [DVec2; 4]> {
        let [first, last] = self.pieces_of(scratch);
        let curves = self.curves();
        (first..=last).map(move |piece| curves.control(piece))
    }

    /// A scratch's cross-sections, and how they follow one another along it.
    #[inline(always)]
    pub(super) fn strand(&self, scratch: u32) -> Option<(TrackRef<'_>, Course<'_>)> {
        let strand = self.strands.get(scratch as usize)?;
        let first = strand.first_knot as usize;
        let course = Course {
            knots: self
                .knots
                .get(first..first.checked_add(strand.knot_count as usize)?)?,
            scale: strand.scale,
        };
        Some((self.tracks.get(strand.track)?, course))
    }

    /// Touches what the scratches of pieces are to be asked for next, as [`Curves::touch`] does.
    pub(super) fn touch(&self, pieces: &[u32]) {
        let touched = pieces.iter().fold(0, |touched, &piece| {
            let scratch = self.pieces.get(piece as usize).map_or(0, |p| p.scratch);
            let knot = self
                .strands
                .get(scratch as usize)
                .map_or(0, |strand| strand.first_knot);
            let [visible, ..] = self.visible(piece as usize);
            let at = self
                .knots
                .get(knot as usize)
                .map_or(0, |knot| knot[0].to_bits());
            touched ^ at ^ u32::from(visible)
        });
        core::hint::black_box(touched);
    }

    /// A scratch's arc length, scene units.
    pub(super) fn length_of(&self, scratch: u32) -> f64 {
        let strand = self.strands.get(scratch as usize);
        strand.map_or(0.0, |strand| strand.length.into())
    }

    /// The first and the last piece of a scratch.
    pub(super) fn pieces_of(&self, scratch: u32) -> [usize; 2] {
        let first = |scratch: usize| self.strands.get(scratch).map(|s| s.first_piece as usize);
        let end = first(scratch as usize + 1).unwrap_or(self.pieces.len());
        [first(scratch as usize).unwrap_or(0), end.saturating_sub(1)]
    }
}

/// The cosine of how far a run may turn: a direction that is off by a degree moves the highlight of a flank by
/// a third of that, which must be little beside the lobe's width.
fn run_cos(smoothest_alpha: f32) -> f64 {
    let degrees = (35.0 * f64::from(smoothest_alpha)).clamp(0.5, MOST_RUN_DEG);
    degrees.to_radians().cos()
}

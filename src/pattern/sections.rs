//! A pattern as one block of numbers and some arrays, for files that are read where they lie.

use super::Pattern;
use super::blank::Blank;
use super::caps::Caps;
use super::grid::Grid;
use super::hosts::Hosts;
use super::palette::Palette;
use super::prefilter::Pyramid;
use super::raster::Raster;
use super::store::Store;
use super::tracks::{Extent, Tracks};
use crate::brdf::{Finish, Hosted};
use bytemuck::{Pod, Zeroable, bytes_of, cast_slice, try_pod_read_unaligned};
use core::ops::Range;
use glam::DVec2;
use memmap2::Mmap;
use std::sync::Arc;

/// How many arrays a pattern is.
pub(crate) const SECTIONS: usize = 23;

/// Bytes of the block of numbers.
pub(crate) const FACTS: usize = size_of::<Facts>();

/// All of a pattern that is no array.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Facts {
    mm_per_scene_unit: f64,
    units_per_uv: DVec2,
    run_cos: f64,
    raster: Raster,
    extent: Extent,
    surface: Finish,
    /// Base BRDFs of the host's own, which the arrays name by their place among them.
    host_count: u32,
}

/// An array as bytes, and how many each element takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section<'p> {
    pub bytes: &'p [u8],
    pub element_bytes: usize,
}

/// The arrays of a file, one after the other.
#[derive(Debug)]
pub(crate) struct Sections<'a, I> {
    pub file: &'a Arc<Mmap>,
    /// Where each lies, and bytes per element.
    pub places: I,
}

impl<'p> Section<'p> {
    fn of<T: Pod>(elements: &'p [T]) -> Self {
        Self {
            bytes: cast_slice(elements),
            element_bytes: size_of::<T>(),
        }
    }
}

impl<I: Iterator<Item = (Range<usize>, usize)>> Sections<'_, I> {
    fn next<T: Pod>(&mut self) -> Option<Store<T>> {
        let (bytes, element_bytes) = self.places.next()?;
        if element_bytes != size_of::<T>() {
            return None;
        }
        Store::mapped(self.file, bytes)
    }
}

impl Pattern {
    /// The block of numbers.
    pub(crate) fn facts(&self) -> [u8; FACTS] {
        let facts = Facts {
            mm_per_scene_unit: self.mm_per_scene_unit,
            units_per_uv: self.units_per_uv,
            run_cos: self.run_cos,
            raster: self.grid.raster,
            extent: self.extent,
            surface: self.surface,
            host_count: u32::try_from(self.hosts.0.len()).unwrap_or(u32::MAX),
        };
        let mut bytes = [0; FACTS];
        bytes.copy_from_slice(bytes_of(&facts));
        bytes
    }

    /// The arrays, in the order of [`Self::of_sections`].
    pub(crate) fn sections(&self) -> [Section<'_>; SECTIONS] {
        [
            Section::of(&self.points),
            Section::of(&self.pieces),
            Section::of(&self.strands),
            Section::of(&self.knots),
            Section::of(&self.visible),
            Section::of(&self.tracks.records),
            Section::of(&self.tracks.stations),
            Section::of(&self.tracks.vertices),
            Section::of(&self.tracks.layers),
            Section::of(&self.tracks.blends),
            Section::of(&self.tracks.sums),
            Section::of(&self.tracks.caps.stations),
            Section::of(&self.tracks.caps.wedges),
            Section::of(&self.tracks.caps.vertices),
            Section::of(&self.palette.classes),
            Section::of(&self.palette.points),
            Section::of(&self.palette.finishes),
            Section::of(&self.pyramid.levels),
            Section::of(&self.pyramid.starts),
            Section::of(&self.pyramid.entries),
            Section::of(&self.grid.cells),
            Section::of(&self.grid.starts),
            Section::of(&self.grid.entries),
        ]
    }

    /// How many base BRDFs of the host's own the pattern of a file's numbers has.
    pub(crate) fn host_count(facts: &[u8]) -> Option<u32> {
        let facts: Facts = try_pod_read_unaligned(facts).ok()?;
        Some(facts.host_count)
    }

    /// The pattern of a file's numbers and arrays, if they fit together, with these base BRDFs of the host's own. Each
    /// array's own content is believed to be whatever it is: queries look before they leap.
    pub(crate) fn of_sections<I: Iterator<Item = (Range<usize>, usize)>>(
        facts: &[u8],
        sections: &mut Sections<'_, I>,
        hosts: &[Hosted],
    ) -> Option<Self> {
        let facts: Facts = try_pod_read_unaligned(facts).ok()?;
        // In the order of `sections`: so are the fields of an expression evaluated.
        let mut pattern = Self {
            points: sections.next()?,
            pieces: sections.next()?,
            strands: sections.next()?,
            knots: sections.next()?,
            visible: sections.next()?,
            tracks: Tracks {
                records: sections.next()?,
                stations: sections.next()?,
                vertices: sections.next()?,
                layers: sections.next()?,
                blends: sections.next()?,
                sums: sections.next()?,
                caps: Caps {
                    stations: sections.next()?,
                    wedges: sections.next()?,
                    vertices: sections.next()?,
                },
            },
            palette: Palette {
                classes: sections.next()?,
                points: sections.next()?,
                finishes: sections.next()?,
            },
            pyramid: Pyramid {
                levels: sections.next()?,
                starts: sections.next()?,
                entries: sections.next()?,
            },
            grid: Grid::of_lists(
                facts.raster,
                sections.next()?,
                sections.next()?,
                sections.next()?,
            ),
            blank: Blank::default(),
            surface: facts.surface,
            mm_per_scene_unit: facts.mm_per_scene_unit,
            units_per_uv: facts.units_per_uv,
            extent: facts.extent,
            run_cos: facts.run_cos,
            hosts: Hosts(hosts.to_vec()),
        };
        let is_sound = facts.is_sound()
            && pattern.palette.is_sound()
            && pattern.pyramid.is_sound()
            && pattern.grid.is_sound();
        if !is_sound {
            return None;
        }
        pattern.blank = Blank::new(pattern.curves(), pattern.grid.raster.bounds());
        Some(pattern)
    }
}

impl Facts {
    fn is_sound(&self) -> bool {
        let scale = 1e-9..=1e9;
        let Extent {
            half_width_mm,
            height_mm,
            rise_mm,
        } = self.extent;
        scale.contains(&self.mm_per_scene_unit)
            && scale.contains(&self.units_per_uv.x)
            && scale.contains(&self.units_per_uv.y)
            && (0.0..=1.0).contains(&self.run_cos)
            && (0.0..=1e9).contains(&half_width_mm)
            && (0.0..=1e9).contains(&height_mm)
            && (0.0..=1e9).contains(&rise_mm)
    }
}

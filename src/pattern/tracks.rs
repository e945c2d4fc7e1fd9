//! All cross-sections of a pattern, in flat arrays.

mod reading;

use super::caps::{CapRange, CapRef, Caps, vertices_per_sector};
use super::chords::ClassAreas;
use super::grid::number;
use super::palette::Blend;
use super::profile::Profile;
use super::raster::cell_number;
use super::store::Store;
use super::track::{MOST_VERTICES, Track};
use crate::brdf::Finish;
use crate::formation::MOST_LAYERS;
use crate::single;
use bytemuck::{Pod, Zeroable};
use glam::Vec2;

/// All tracks, one after the other: no pointers to chase.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tracks {
    pub(super) records: Store<Record>,
    pub(super) stations: Store<Station>,
    pub(super) vertices: Store<Vec2>,
    pub(super) layers: Store<LayerFinish>,
    pub(super) caps: Caps,
    /// How each station is shared between the palette's classes.
    pub blends: Store<Blend>,
    pub sums: Store<ClassAreas>,
}

/// Where one track's share of the arrays begins, and how long it is.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Record {
    first_station: u32,
    station_count: u32,
    first_vertex: u32,
    vertex_count: u32,
    first_layer: u32,
    layer_count: u32,
    /// At the start, and where it stops.
    caps: [CapRange; 2],
    extent: Extent,
    bulk: Finish,
}

/// A place on a track where its cross-section is known.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Station {
    at: f32,
    /// How much the cross-section has changed since the first station, as a share of the track's largest size.
    change: f32,
    /// The last station up to this one's share of the way from the first to the last, as its number is a share of
    /// all: where to look for a place.
    guide: u32,
    /// The width added up since the first station, mm times what places are measured in.
    area: f32,
}

/// A layer's lower interface and finish.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct LayerFinish {
    /// z, mm, below 0.
    pub bottom_mm: f32,
    pub finish: Finish,
}

/// What of a cross-section bounds how far it matters, mm.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Extent {
    pub half_width_mm: f32,
    /// Up or down.
    pub height_mm: f32,
    /// Up: what casts shadows.
    pub rise_mm: f32,
}

/// One track to read.
///
/// It is copied often, so it holds what most are asked for: stations and their vertices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrackRef<'p> {
    stations: &'p [Station],
    vertices: &'p [Vec2],
    all: &'p Tracks,
    record: &'p Record,
}

impl Tracks {
    /// Appends a track; its number.
    pub(crate) fn push(&mut self, track: &Track) -> u32 {
        let extent = Extent::of(&track.vertices);
        let caps = track.caps.each_ref().map(|caps| self.caps.append(caps));
        self.records.push(Record {
            first_station: number(self.stations.len()),
            station_count: number(track.at.len()),
            first_vertex: number(self.vertices.len()),
            vertex_count: number(track.vertex_count),
            first_layer: number(self.layers.len()),
            layer_count: number(track.finishes.layers.len()),
            caps,
            extent,
            bulk: track.finishes.bulk,
        });
        let size = Vec2::new(extent.half_width_mm, extent.height_mm).max(Vec2::splat(1e-30));
        let shapes: Vec<&[Vec2]> = track.vertices.chunks(track.vertex_count).collect();
        let guides = guides(&track.at);
        let (mut change, mut area) = (0.0, 0.0);
        let width = |shape: &[Vec2]| match shape {
            [first, .., last] => f64::from(last.x - first.x),
            _ => 0.0,
        };
        for (i, &at) in track.at.iter().enumerate() {
            if i > 0 {
                let widths = width(shapes[i - 1]) + width(shapes[i]);
                area += 0.5 * widths * (at - track.at[i - 1]);
                let steps = shapes[i - 1]
                    .iter()
                    .zip(shapes[i])
                    .map(|(a, b)| (*b - *a) / size);
                change += steps.fold(0.0, |most: f32, step| most.max(step.abs().max_element()));
            }
            let at = single(at);
            self.stations.push(Station {
                at,
                change,
                guide: guides[i],
                area: single(area),
            });
        }
        self.vertices.extend(&track.vertices);
        let layers = track.finishes.layers.iter();
        self.layers
            .extend(layers.map(|&(bottom_mm, finish)| LayerFinish { bottom_mm, finish }));
        number(self.records.len() - 1)
    }

    /// A track by its number.
    #[inline(always)]
    pub(crate) fn get(&self, number: u32) -> Option<TrackRef<'_>> {
        let record = self.records.get(number as usize)?;
        // A damaged file may claim anything.
        let is_sound = record.station_count > 0
            && (6..=MOST_VERTICES).contains(&(record.vertex_count as usize))
            && record.layer_count as usize <= MOST_LAYERS;
        if !is_sound {
            return None;
        }
        let (first, count) = (record.first_station as usize, record.station_count as usize);
        let (vertex, per_station) = (record.first_vertex as usize, record.vertex_count as usize);
        Some(TrackRef {
            stations: self.stations.get(first..first + count)?,
            vertices: self.vertices.get(vertex..vertex + count * per_station)?,
            all: self,
            record,
        })
    }

    /// What stands beyond the hard ends of a track's scratches: where they start (0), or where they stop (1).
    pub(crate) fn caps(&self, number: u32, end: usize) -> Option<CapRef<'_>> {
        let record = self.records.get(number as usize)?;
        let facets = (record.vertex_count as usize).checked_sub(5)?;
        self.caps.get(record.caps[end], vertices_per_sector(facets))
    }

    /// Whether no scratch ends hard.
    pub(crate) fn has_no_caps(&self) -> bool {
        self.caps.stations.is_empty()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = TrackRef<'_>> {
        (0..self.records.len()).filter_map(|number| self.get(u32::try_from(number).ok()?))
    }

    pub(crate) fn station_count(&self) -> usize {
        self.stations.len()
    }

    /// Memory of all arrays.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.records[..])
            + size_of_val(&self.stations[..])
            + size_of_val(&self.vertices[..])
            + size_of_val(&self.layers[..])
            + size_of_val(&self.blends[..])
            + size_of_val(&self.sums[..])
    }

    /// Puts others in the place of all finishes.
    pub(crate) fn change_finishes(&mut self, change: impl Fn(Finish) -> Finish) {
        let layers = self.layers.to_mut().iter_mut();
        layers.for_each(|layer| layer.finish = change(layer.finish));
        let records = self.records.to_mut().iter_mut();
        records.for_each(|record| record.bulk = change(record.bulk));
    }

    /// All different finishes.
    pub(crate) fn finishes(&self) -> Vec<Finish> {
        let layers = self.layers.iter().map(|layer| layer.finish);
        let mut all = Vec::new();
        for finish in layers.chain(self.records.iter().map(|record| record.bulk)) {
            if !all.contains(&finish) {
                all.push(finish);
            }
        }
        all
    }

    /// The extent of all.
    pub(crate) fn extent(&self) -> Extent {
        let extents = self.records.iter().map(|record| record.extent);
        extents.fold(self.caps.extent(), Extent::max)
    }
}

/// For each place the last one up to its share of the way, as its number is a share of all.
fn guides(at: &[f64]) -> Vec<u32> {
    let (Some(first), Some(last)) = (at.first(), at.last()) else {
        return Vec::new();
    };
    let step = (last - first) / at.len() as f64;
    let mut before = 0;
    let guide = |i: usize| {
        while before + 1 < at.len() && at[before + 1] <= first + step * i as f64 {
            before += 1;
        }
        number(before)
    };
    (0..at.len()).map(guide).collect()
}

impl Extent {
    pub(super) fn of(vertices: &[Vec2]) -> Self {
        let all = vertices.iter();
        let size = all.clone().fold(Vec2::ZERO, |size, v| size.max(v.abs()));
        Self {
            half_width_mm: size.x,
            height_mm: size.y,
            rise_mm: all.fold(0.0, |most, v| most.max(v.y)),
        }
    }

    fn max(self, other: Self) -> Self {
        Self {
            half_width_mm: self.half_width_mm.max(other.half_width_mm),
            height_mm: self.height_mm.max(other.height_mm),
            rise_mm: self.rise_mm.max(other.rise_mm),
        }
    }
}

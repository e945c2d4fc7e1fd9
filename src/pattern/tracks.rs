//! All cross-sections of a pattern, in flat arrays.

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

impl<'p> TrackRef<'p> {
    /// Vertices of each of its cross-sections.
    #[inline(always)]
    pub(crate) fn vertex_count(&self) -> usize {
        self.record.vertex_count as usize
    }

    /// Layers that it may cut through, from the surface down.
    #[inline(always)]
    pub(crate) fn layers(&self) -> &'p [LayerFinish] {
        let first = self.record.first_layer as usize;
        let count = self.record.layer_count as usize;
        // Mostly there are none.
        match count {
            0 => &[],
            _ => self.all.layers.get(first..first + count).unwrap_or(&[]),
        }
    }

    /// The finish of what lies below them.
    pub(crate) fn bulk(&self) -> &'p Finish {
        &self.record.bulk
    }

    /// How far its widest cross-section reaches from the centre line, mm.
    pub(crate) fn half_width_mm(&self) -> f64 {
        self.record.extent.half_width_mm.into()
    }

    /// Number of its first station among all.
    pub(crate) fn first_station(&self) -> usize {
        self.record.first_station as usize
    }

    /// How each station is shared between the palette's classes.
    pub(super) fn blends(&self) -> &'p [Blend] {
        self.of_stations(&self.all.blends)
    }

    /// Up to each station, what [`Self::areas_to`] says.
    pub(super) fn sums(&self) -> &'p [ClassAreas] {
        self.of_stations(&self.all.sums)
    }

    fn of_stations<T>(&self, all: &'p [T]) -> &'p [T] {
        let first = self.first_station();
        let own = all.get(first..first + self.stations.len());
        own.unwrap_or(&[])
    }

    pub(crate) fn station_count(&self) -> usize {
        self.stations.len()
    }

    /// Where a station is.
    pub(crate) fn station_at(&self, station: usize) -> f64 {
        self.stations[station].at.into()
    }

    /// The finishes of its zones, from the surface down.
    pub(crate) fn finishes(&self) -> impl Iterator<Item = Finish> {
        let layers = self.layers().iter().map(|layer| layer.finish);
        layers.chain([*self.bulk()])
    }

    /// Classes that stand for the cross-section at a place, and the share of each.
    pub(crate) fn classes(&self, at: f64) -> [(usize, f32); 4] {
        self.classes_of(self.locate(at))
    }

    fn classes_of(&self, (last, mix): (usize, f32)) -> [(usize, f32); 4] {
        let of = |station: usize, share: f32| {
            let blend = self.blends().get(station).copied().unwrap_or_default();
            let [a, b] = blend.classes.map(usize::from);
            [(a, share * (1.0 - blend.second)), (b, share * blend.second)]
        };
        let next = (last + 1).min(self.stations.len() - 1);
        let ([a, b], [c, d]) = (of(last, 1.0 - mix), of(next, mix));
        [a, b, c, d]
    }

    /// The station before a place, and how far the place is on the way to the next.
    #[inline(always)]
    pub(crate) fn locate(&self, at: f64) -> (usize, f32) {
        match self.stations.len() {
            1 => (0, 0.0),
            _ => self.locate_among(at),
        }
    }

    /// The same where there are several.
    fn locate_among(&self, at: f64) -> (usize, f32) {
        let place = |i: usize| f64::from(self.stations[i].at);
        let final_one = self.stations.len() - 1;
        // Most ask for where scratches set in.
        if at <= place(0) {
            return (0, 0.0);
        }
        let count = self.stations.len() as f64;
        let share = (at - place(0)) / (place(final_one) - place(0));
        let guide = |i: usize| self.stations.get(i).map(|station| station.guide as usize);
        let near = cell_number(share * count).min(number(final_one)) as usize;
        let low = guide(near).unwrap_or(0);
        let high = guide(near + 1).unwrap_or(final_one);
        // A damaged file may lead anywhere.
        let (low, near) = match self.stations.get(low..=high) {
            Some(near) => (low, near),
            None => (0, self.stations),
        };
        let next = low + near.partition_point(|station| f64::from(station.at) <= at);
        let last = next.saturating_sub(1);
        let next = next.min(final_one);
        let span = place(next) - place(last);
        let mix = if span > 0.0 {
            single(((at - place(last)) / span).clamp(0.0, 1.0))
        } else {
            0.0
        };
        (last, mix)
    }

    /// The cross-section at a place.
    #[inline(always)]
    pub(crate) fn profile(&self, at: f64) -> Profile<'p> {
        let (last, mix) = self.locate(at);
        Profile::between(
            self.shapes_from(last),
            self.vertex_count(),
            self.vertex_count(),
            mix,
        )
    }

    /// Shapes from a station on, one after the other.
    #[inline(always)]
    pub(super) fn shapes_from(&self, station: usize) -> &'p [Vec2] {
        self.vertices
            .get(station * self.vertex_count()..)
            .unwrap_or(&[])
    }

    /// How wide the cross-section is at a place, mm.
    pub(crate) fn width(&self, at: f64) -> f64 {
        let [left, right] = self.ends(at).map(f64::from);
        right - left
    }

    /// How wide it is on average on an even way from one place to another, mm.
    pub(crate) fn mean_width(&self, from: f64, to: f64) -> f64 {
        if (to - from).abs() <= self.least_step() {
            return self.width(0.5 * (from + to));
        }
        (self.area_to(to) - self.area_to(from)) / (to - from)
    }

    /// Of less of the way, differences of sums would be rounding.
    pub(super) fn least_step(&self) -> f64 {
        1e-4 * f64::from(self.stations[self.stations.len() - 1].at - self.stations[0].at)
    }

    /// The width added up from the first station to a place.
    fn area_to(&self, at: f64) -> f64 {
        let (last, mix) = self.locate(at);
        let station = &self.stations[last];
        let [width, end] = [(last, 0.0), (last, mix)].map(|place| {
            let [left, right] = self.ends_of(place).map(f64::from);
            right - left
        });
        let next = self.stations.get(last + 1).unwrap_or(station);
        let way = f64::from(mix) * f64::from(next.at - station.at);
        f64::from(station.area) + 0.5 * (width + end) * way
    }

    /// Where the cross-section begins and ends at a place, mm across from the centre line.
    pub(crate) fn ends(&self, at: f64) -> [f32; 2] {
        self.ends_of(self.locate(at))
    }

    /// The same, and [`Self::classes`].
    pub(crate) fn ends_and_classes(&self, at: f64) -> ([f32; 2], [(usize, f32); 4]) {
        let place = self.locate(at);
        (self.ends_of(place), self.classes_of(place))
    }

    /// The same, of a place that was located.
    pub(crate) fn ends_of(&self, (last, mix): (usize, f32)) -> [f32; 2] {
        let ends = |station: usize| {
            let shape = self.shapes_from(station);
            let x = |vertex: usize| shape.get(vertex).map_or(0.0, |vertex| vertex.x);
            [x(0), x(self.vertex_count() - 1)]
        };
        if mix <= 0.0 {
            return ends(last);
        }
        let (a, b) = (ends(last), ends(last + 1));
        [0, 1].map(|i| a[i] * (1.0 - mix) + b[i] * mix)
    }

    /// How far from the centre line it reaches at a place that was located, mm.
    pub(crate) fn half_width_of(&self, place: (usize, f32)) -> f64 {
        let [left, right] = self.ends_of(place);
        right.max(-left).into()
    }

    /// How much the cross-section has changed from the first station to a place.
    pub(crate) fn change(&self, at: f64) -> f64 {
        self.change_to(self.locate(at))
    }

    /// The same, of a place that was located.
    pub(crate) fn change_to(&self, (last, mix): (usize, f32)) -> f64 {
        let next = (last + 1).min(self.stations.len() - 1);
        let (a, b) = (self.stations[last].change, self.stations[next].change);
        f64::from(a) + f64::from(b - a) * f64::from(mix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places are found between the stations where a search from the first one on finds them, however unevenly
    /// stations lie.
    #[test]
    fn places_lie_between_their_stations() {
        for (count, power) in [(1, 1), (2, 1), (3, 2), (200, 1), (200, 6)] {
            let at = (0..count).map(|i| (0.5 + f64::from(i)).powi(power));
            let at: Vec<f64> = at.map(|at| f64::from(single(at))).collect();
            let mut tracks = Tracks::default();
            tracks.push(&Track {
                vertices: vec![Vec2::ZERO; 6 * at.len()],
                at: at.clone(),
                vertex_count: 6,
                caps: Default::default(),
                finishes: Default::default(),
            });
            let track = tracks.get(0).unwrap();
            for i in -10..=1010 {
                let place = at[at.len() - 1] * f64::from(i) / 1000.0;
                let (last, mix) = track.locate(place);
                let before = at.iter().filter(|station| **station <= place).count();
                let truth = before.saturating_sub(1);
                let next = at.get(truth + 1).copied().unwrap_or(f64::INFINITY);
                let share = ((place - at[truth]) / (next - at[truth])).clamp(0.0, 1.0);
                let off = last as f64 + f64::from(mix) - (truth as f64 + share);
                assert!(off.abs() < 1e-6, "{count}, {power}, {place}: off by {off}");
            }
        }
    }
}

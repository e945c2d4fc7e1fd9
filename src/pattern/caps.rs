//! Hard ends: what stands beyond the ends of a track's scratches, in flat arrays beside the cross-sections.
//!
//! A cap is a fan of sectors around the tool's last place (`formation::end_cap`). Each sector is kept as a whole
//! cross-section: ahead of the fan's centre its own half, behind it the scratch's other side as a line along the
//! sector's axis meets it. What lies behind has no weight, but hides and shadows as it does along the scratch.

use super::profile::Profile;
use super::store::Store;
use super::tracks::{Extent, TrackRef};
use crate::formation::{End, EndCap, SECTORS};
use crate::single;
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, Vec2};

/// Points of the scratch's other side that are kept: foot, crest and edge. What is below the edge hides nothing.
pub(super) const BEHIND: usize = 3;

/// Right ahead the other side is so far behind that it does not matter: at least this share of it lies across.
const LEAST_ACROSS: f64 = 0.02;

/// Narrower sectors are none, radians.
const NARROWEST_RAD: f64 = 1e-6;

/// A sector's border reaches no further out than this times its width along the axis.
pub(super) const LONGEST_BORDER: f64 = 5.0;

/// Both ends, in the order in which travel comes to them.
pub(crate) const ENDS: [End; 2] = [End::Start, End::Stop];

/// Caps at one end of a track's scratches, while the pattern is built.
#[derive(Clone, Debug, Default)]
pub(crate) struct EndCaps {
    stations: Vec<Station>,
    wedges: Vec<Wedge>,
    vertices: Vec<Vec2>,
}

/// All caps of a pattern.
#[derive(Clone, Debug, Default)]
pub(crate) struct Caps {
    pub(super) stations: Store<Station>,
    /// [`SECTORS`] for each station.
    pub(super) wedges: Store<Wedge>,
    /// The same count for each sector of a track.
    pub(super) vertices: Store<Vec2>,
}

/// Which of all stations are those of one end of a track.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CapRange {
    first: u32,
    count: u32,
}

/// A force (or depth, or share of arc length) for which the cap is known.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Station {
    at: f32,
    /// Where the fan's centre is, mm to the right of the path's end.
    offset_mm: f32,
    first_vertex: u32,
}

/// Borders and axis of a sector, radians from travel, counter-clockwise from above, and how wide it is at 1 mm along the
/// axis, mm.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Wedge {
    pub from_rad: f32,
    pub to_rad: f32,
    pub axis_rad: f32,
    spread: f32,
}

/// A sector of a cap.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CapSector<'p> {
    pub wedge: Wedge,
    pub offset_mm: f64,
    pub profile: Profile<'p>,
}

/// The caps of one end of a track's scratches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CapRef<'p> {
    stations: &'p [Station],
    wedges: &'p [Wedge],
    vertices: &'p [Vec2],
    per_sector: usize,
}

/// A cap where a scratch ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CapAt<'p> {
    pub caps: CapRef<'p>,
    /// Share of the scratch's arc length: 0 or 1.
    pub at: f64,
    /// What its track is asked with there.
    pub place: f64,
}

/// Facets of half a groove.
fn half(facets: usize) -> usize {
    facets.div_ceil(2)
}

/// Vertices of each sector of a scratch whose groove has so many facets.
pub(crate) fn vertices_per_sector(facets: usize) -> usize {
    BEHIND + half(facets) + 3
}

impl EndCaps {
    /// Appends the cap at a place after the last one; `run` is the scratch's own cross-section there.
    pub(crate) fn push(&mut self, at: f64, cap: &EndCap, run: &[DVec2]) {
        let offset_mm = cap.offset_mm();
        self.stations.push(Station {
            at: single(at),
            offset_mm: single(offset_mm),
            first_vertex: number(self.vertices.len()),
        });
        for sector in cap.sectors(half(run.len() - 5)) {
            let axis_rad = sector.axis_rad;
            let borders = [sector.from_rad, sector.to_rad].map(|border| border - axis_rad);
            self.wedges.push(Wedge {
                from_rad: single(sector.from_rad),
                to_rad: single(sector.to_rad),
                axis_rad: single(axis_rad),
                spread: single(spread(borders)),
            });
            let behind = behind(run, offset_mm, axis_rad).into_iter();
            let points = behind.chain(sector.points);
            self.vertices.extend(points.map(|point| point.as_vec2()));
        }
    }
}

/// Foot, crest and edge of the side of a cross-section that lies behind a sector's axis, along the axis.
fn behind(run: &[DVec2], offset_mm: f64, axis_rad: f64) -> [DVec2; BEHIND] {
    let right = -axis_rad.sin();
    let stretch = 1.0 / right.abs().max(LEAST_ACROSS);
    [0, 1, 2].map(|i| {
        let (point, away) = if right >= 0.0 {
            (run[i], offset_mm - run[i].x)
        } else {
            let point = run[run.len() - 1 - i];
            (point, point.x - offset_mm)
        };
        DVec2::new(-away.max(0.0) * stretch, point.y)
    })
}

impl Caps {
    pub(crate) fn append(&mut self, caps: &EndCaps) -> CapRange {
        let range = CapRange {
            first: number(self.stations.len()),
            count: number(caps.stations.len()),
        };
        let shift = number(self.vertices.len());
        self.stations
            .extend(caps.stations.iter().map(|station| Station {
                first_vertex: station.first_vertex + shift,
                ..*station
            }));
        self.wedges.extend(&caps.wedges);
        self.vertices.extend(&caps.vertices);
        range
    }

    /// What a range holds, if anything.
    pub(crate) fn get(&self, range: CapRange, per_sector: usize) -> Option<CapRef<'_>> {
        let (first, count) = (range.first as usize, range.count as usize);
        (count > 0).then_some(())?;
        Some(CapRef {
            stations: self.stations.get(first..first + count)?,
            wedges: self
                .wedges
                .get(first * SECTORS..(first + count) * SECTORS)?,
            vertices: &self.vertices,
            per_sector,
        })
    }

    /// How far caps reach from their scratches' ends, and how high or deep.
    pub(crate) fn extent(&self) -> Extent {
        let mut far = 0.0_f32;
        for (i, station) in self.stations.iter().enumerate() {
            let next = self.stations.get(i + 1).map(|next| next.first_vertex);
            let first = station.first_vertex as usize;
            let end = next.map_or(self.vertices.len(), |next| next as usize);
            let own = &self.vertices[first..end];
            let wedges = &self.wedges[i * SECTORS..(i + 1) * SECTORS];
            for (wedge, points) in wedges.iter().zip(own.chunks(own.len() / SECTORS)) {
                let foot_mm = points.last().map_or(0.0, |foot| foot.x);
                let off = |border_rad: f32| (border_rad - wedge.axis_rad).cos();
                let least = off(wedge.from_rad).min(off(wedge.to_rad));
                let longest = foot_mm / least.max(1.0 / single(LONGEST_BORDER));
                far = far.max(longest + station.offset_mm.abs());
            }
        }
        Extent {
            half_width_mm: far,
            ..Extent::of(&self.vertices)
        }
    }
}

impl<'p> CapAt<'p> {
    /// Its sectors that have a width; none where there is no groove.
    pub(crate) fn sectors(&self) -> impl Iterator<Item = CapSector<'p>> + use<'p> {
        self.caps.sectors(self.place)
    }
}

impl<'p> CapRef<'p> {
    fn sectors(self, place: f64) -> impl Iterator<Item = CapSector<'p>> + use<'p> {
        let at = |i: usize| f64::from(self.stations[i].at);
        let after = self
            .stations
            .partition_point(|station| f64::from(station.at) <= place);
        let (last, next) = (after.saturating_sub(1), after.min(self.stations.len() - 1));
        let span = at(next) - at(last);
        let mix = if span > 0.0 {
            single(((place - at(last)) / span).clamp(0.0, 1.0))
        } else {
            0.0
        };
        let (a, b) = (self.stations[last], self.stations[next]);
        let offset_mm = a.offset_mm + mix * (b.offset_mm - a.offset_mm);
        let sector = move |i: usize| CapSector {
            wedge: self.wedges[last * SECTORS + i].mixed(self.wedges[next * SECTORS + i], mix),
            offset_mm: offset_mm.into(),
            profile: Profile::between(
                self.points_from(a, i),
                SECTORS * self.per_sector,
                self.per_sector,
                mix,
            ),
        };
        // Soft ends of a kind whose others are hard ask for less than any station.
        let count = if place < at(0) * (1.0 - 1e-6) {
            0
        } else {
            SECTORS
        };
        (0..count)
            .map(sector)
            .filter(|sector| sector.wedge.width_rad() > NARROWEST_RAD && sector.outer_mm() > 0.0)
    }

    /// From a sector's points on; those at the next station follow after all sectors of this one.
    fn points_from(&self, station: Station, sector: usize) -> &'p [Vec2] {
        let first = station.first_vertex as usize + sector * self.per_sector;
        self.vertices.get(first..).unwrap_or(&[])
    }
}

impl CapAt<'_> {
    /// How much of it stands by itself: nothing of one on a scratch no wider than `thin_mm`, all from twice that on.
    pub(crate) fn alone(&self, track: &TrackRef<'_>, thin_mm: f64) -> f64 {
        let width_mm = track.width(self.place);
        (width_mm / thin_mm - 1.0).clamp(0.0, 1.0)
    }
}

impl CapSector<'_> {
    /// Where the sector's peak meets the surface, mm along the axis from the fan's centre.
    pub(crate) fn outer_mm(&self) -> f64 {
        self.profile.ends()[1].into()
    }

    /// What it covers, mm².
    pub(crate) fn area_mm2(&self) -> f64 {
        0.5 * self.outer_mm().powi(2) * f64::from(self.wedge.spread)
    }
}

impl Wedge {
    fn mixed(self, other: Self, mix: f32) -> Self {
        let between = |a: f32, b: f32| a + mix * (b - a);
        Self {
            from_rad: between(self.from_rad, other.from_rad),
            to_rad: between(self.to_rad, other.to_rad),
            axis_rad: between(self.axis_rad, other.axis_rad),
            spread: between(self.spread, other.spread),
        }
    }

    fn width_rad(self) -> f64 {
        f64::from(self.to_rad) - f64::from(self.from_rad)
    }
}

/// How wide a sector is at 1 mm along its axis, from which its borders lead away so far, radians.
fn spread(borders_rad: [f64; 2]) -> f64 {
    let most = LONGEST_BORDER.atan();
    let [from, to] = borders_rad.map(|border| border.clamp(-most, most).tan());
    to - from
}

/// A direction at an angle from travel, counter-clockwise from above.
pub(super) fn turned(travel: DVec2, angle_rad: f32) -> DVec2 {
    DVec2::from_angle(f64::from(angle_rad)).rotate(travel)
}

fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

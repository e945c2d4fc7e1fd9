//! The hard end of a scratch: the tool's own print closes the groove, and pile-up stands around it.
//!
//! The half plane beyond the end is a fan of sectors around the tip, each of which is a short straight scratch
//! with half a cross-section. At the end of a scratch the tool stopped here; at its start it went in here. In both
//! cases the surface is what the tool cut on its way to or from this place: at each distance to the side, as
//! far ahead as the tool reaches there.

use super::cross_section::Process;
use super::facets::{Measured, facet_points};
use super::imprint::Imprint;
use super::material::Material;
use super::outline::{Cut, Measures, Outline, Piece};
use super::pileup::Peak;
use super::tool::Tool;
use crate::error::Result;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DMat3, DVec2, DVec3};

/// Sectors of the half plane.
pub(crate) const SECTORS: usize = 8;

/// Share of length in the measure by which borders are placed along the contact area's rim; the rest is turning.
/// With eight sectors a corner of 60 degrees or more gets a border of its own.
const LENGTH_SHARE: f64 = 0.6;

/// Sections reach this much above the level, so that the flank's angle there can be taken.
const ABOVE: f64 = 1.05;

/// Stands for no depth at all where only azimuths are asked for, as a share of the tool's height.
const SHALLOWEST: f64 = 1e-6;

/// Which end of a scratch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// Where the tool went in.
    Start,
    /// Where it stopped.
    Stop,
}

/// The cap of a scratch's hard end.
#[derive(Clone, Debug)]
pub(crate) struct EndCap {
    offset_mm: f64,
    parts: Vec<Part>,
}

/// A sector before its groove is cut into facets.
#[derive(Clone, Debug)]
struct Part {
    from_rad: f64,
    to_rad: f64,
    axis_rad: f64,
    groove: Cut,
    peak: Peak,
}

/// A sector of a cap: a half cross-section, the same on all lines across `axis_rad` between two azimuths.
#[derive(Clone, Debug)]
pub(crate) struct Sector {
    /// The sector's borders, radians from the travel direction, counter-clockwise from above; `from_rad <= to_rad`.
    pub from_rad: f64,
    pub to_rad: f64,
    /// Direction of the cross-section, outward.
    pub axis_rad: f64,
    /// Points (outward from the tip along the axis, up), mm: the groove from its bottom to the surface, crest, foot.
    pub points: Vec<DVec2>,
}

/// The swept groove that a cap has to meet, measured from the tip to the right and to the left.
struct Sides {
    width_mm: [f64; 2],
    /// What a side's peak holds over what the groove lacks on that side.
    share: [f64; 2],
}

impl EndCap {
    /// What `tool` leaves beyond an end of a scratch where it is held and pressed as `process` says.
    ///
    /// Errors: as [`super::CrossSection::form`].
    pub(crate) fn form(
        tool: &Tool,
        process: &Process,
        material: &Material,
        end: End,
    ) -> Result<Self> {
        let (outline, loaded_mm) = process.press(tool, material)?;
        // The start is the end of the same scratch made by a mirrored tool.
        let mirror = match end {
            End::Start => DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
            End::Stop => DMat3::IDENTITY,
        };
        let imprint = tool.imprint(mirror * process.orientation.rotation());
        let depth_mm = loaded_mm.max(SHALLOWEST * outline.height_mm());
        let sides = Sides::of(&outline, imprint.tip().x, depth_mm);
        let front = sides.joined(imprint.front(depth_mm));
        let mut parts = front.fan(|rim| {
            let groove = section(&imprint, &rim, depth_mm).recovered(material.elastic_recovery);
            let peak = sides.peak(&rim, &groove, material, end);
            (groove, peak)
        });
        if loaded_mm == 0.0 {
            parts.iter_mut().for_each(Part::clear);
        }
        if end == End::Start {
            parts.iter_mut().for_each(Part::mirror);
            parts.reverse();
        }
        Ok(Self {
            offset_mm: imprint.tip().x,
            parts,
        })
    }

    /// Where the tip is: this far to the right of the path's end, mm. It depends on the tool and how it is held, not on
    /// the force.
    pub(crate) fn offset_mm(&self) -> f64 {
        self.offset_mm
    }

    /// The sectors, counter-clockwise, with `groove_facets` facets from bottom to surface: `groove_facets + 3` points
    /// each.
    pub(crate) fn sectors(&self, groove_facets: usize) -> Vec<Sector> {
        let sector = |part: &Part| Sector {
            from_rad: part.from_rad,
            to_rad: part.to_rad,
            axis_rad: part.axis_rad,
            points: part.points(groove_facets),
        };
        self.parts.iter().map(sector).collect()
    }
}

impl Part {
    fn points(&self, groove_facets: usize) -> Vec<DVec2> {
        let mut points = facet_points(&self.groove, groove_facets);
        let edge_x = points.last().map_or(0.0, |edge| edge.x);
        let crest = DVec2::new(edge_x + self.peak.inner_width_mm, self.peak.height_mm);
        points.extend([crest, DVec2::new(crest.x + self.peak.outer_width_mm, 0.0)]);
        points
    }

    fn clear(&mut self) {
        self.groove.points.clear();
        self.groove.measures = Measures::default();
        self.peak = Peak::default();
    }

    fn mirror(&mut self) {
        (self.from_rad, self.to_rad) = (PI - self.to_rad, PI - self.from_rad);
        self.axis_rad = PI - self.axis_rad;
    }
}

/// The contact area's front from right to left, as the tool leaves it and stretched across the travel to be as wide
/// as the groove.
struct Front {
    points: Vec<DVec2>,
    /// By how much it was stretched, right and left.
    stretch: [f64; 2],
}

/// The place on the contact area's rim that a sector's section goes through.
struct Rim {
    place: DVec2,
    stretch: f64,
    axis_rad: f64,
}

impl Sides {
    fn of(outline: &Outline, tip_x: f64, depth_mm: f64) -> Self {
        let cut = outline.cut(depth_mm);
        let [from_x, to_x] = cut.measures.edges_mm;
        let area_right: f64 = cut
            .points
            .windows(2)
            .map(|pair| [pair[0] - DVec2::X * tip_x, pair[1] - DVec2::X * tip_x])
            .filter(|[_, to]| to.x > 0.0)
            .map(|[from, to]| {
                let share = if from.x < 0.0 {
                    from.x / (from.x - to.x)
                } else {
                    0.0
                };
                let from = from.lerp(to, share);
                -0.5 * (to.x - from.x) * (from.y + to.y)
            })
            .sum();
        let half = 0.5 * cut.measures.area_mm2;
        let areas = [area_right, cut.measures.area_mm2 - area_right];
        Self {
            width_mm: [to_x - tip_x, tip_x - from_x],
            share: areas.map(|area| if area > 1e-6 * half { half / area } else { 1.0 }),
        }
    }

    /// The front of a contact area, made to meet the groove's edges: straight lines stay straight. A front that is narrower
    /// than the groove belongs to a tool that is widest behind its tip.
    fn joined(&self, mut points: Vec<DVec2>) -> Front {
        let ends = [points.first(), points.last()].map(|end| end.map_or(0.0, |end| end.x.abs()));
        let stretch = [0, 1].map(|side| {
            let thin = ends[side] <= 1e-9 * self.width_mm[side] || self.width_mm[side] <= 0.0;
            if thin {
                1.0
            } else {
                self.width_mm[side] / ends[side]
            }
        });
        for point in &mut points {
            point.x *= stretch[usize::from(point.x < 0.0)];
        }
        Front { points, stretch }
    }

    /// The peak beyond a section. At the groove's sides it holds what the groove's own peaks do: half of the whole,
    /// however the groove is divided by its deepest line.
    ///
    /// At the start the tool was pressed in and pushed nothing backward: there the peak's height fades from its
    /// whole at the sides to nothing right behind, by the squared sine of the azimuth. No source says so; our choice.
    fn peak(&self, rim: &Rim, groove: &Cut, material: &Material, end: End) -> Peak {
        let sideways = if rim.place == DVec2::ZERO {
            0.0
        } else {
            rim.place.x.powi(2) / rim.place.length_squared()
        };
        let side = usize::from(rim.place.x < 0.0);
        let share = 1.0 + (self.share[side] - 1.0) * sideways;
        let fade = match end {
            End::Start => sideways,
            End::Stop => 1.0,
        };
        let half_mm2 = groove.measures.area_mm2 * share;
        let area_mm2 = 2.0 * half_mm2 * material.pile_up_fraction;
        let mut peak = Peak::rising(groove.measures.flank_rad[1], material.pile_up, area_mm2);
        // Lower, not narrower: sectors of unequal width would look like teeth.
        peak.height_mm *= fade;
        peak
    }
}

impl Front {
    /// The half plane cut into sectors, right to left, each with what `leave` says of its place on the rim.
    fn fan(&self, leave: impl Fn(Rim) -> (Cut, Peak)) -> Vec<Part> {
        let reach = self.points.iter().map(|point| point.y).fold(0.0, f64::max);
        let width = self
            .points
            .iter()
            .map(|point| point.x.abs())
            .fold(0.0, f64::max);
        // A sheet has nothing ahead of its tip: any azimuths will do.
        let sheet = reach <= 1e-9 * width || width <= 1e-9 * reach;
        let measured = Measured::new(&self.points, LENGTH_SHARE);
        let at = |half_steps: usize| {
            let share = half_steps as f64 / (2 * SECTORS) as f64;
            if sheet {
                DVec2::ZERO
            } else {
                measured.at(share)
            }
        };
        let mut to_rad = -FRAC_PI_2;
        let part = |i: usize| {
            let (from, middle, to) = (at(2 * i), at(2 * i + 1), at(2 * i + 2));
            let from_rad = to_rad;
            let equal = -FRAC_PI_2 + PI * (i + 1) as f64 / SECTORS as f64;
            to_rad = if sheet || i + 1 == SECTORS {
                equal
            } else {
                azimuth_rad(to).clamp(from_rad, FRAC_PI_2)
            };
            let chord = to - from;
            let level = chord.length() <= 1e-9 * (width + reach);
            let axis_rad = if sheet {
                0.5 * (from_rad + to_rad)
            } else if level {
                azimuth_rad(middle)
            } else {
                azimuth_rad(DVec2::new(chord.y, -chord.x))
            };
            // Through the chord's middle: there a face of the tool is as high as it is on the mean.
            let place = self.beyond(from.midpoint(to)).unwrap_or(middle);
            let rim = Rim {
                place,
                stretch: self.stretch[usize::from(place.x < 0.0)],
                axis_rad,
            };
            let (groove, peak) = leave(rim);
            Part {
                from_rad,
                to_rad,
                axis_rad,
                groove,
                peak,
            }
        };
        (0..SECTORS).map(part).collect()
    }

    /// Where the ray from the tip through `place` leaves the contact area.
    fn beyond(&self, place: DVec2) -> Option<DVec2> {
        self.points.windows(2).find_map(|pair| {
            let [from, to] = [0, 1].map(|i| place.perp_dot(pair[i]));
            let crossed = from <= 0.0 && to > 0.0;
            crossed.then(|| pair[0].lerp(pair[1], from / (from - to)))
        })
    }
}

/// The groove from the tip to a place on the rim, seen across the sector's axis: a flat face shows its true slope.
fn section(imprint: &Imprint<'_>, rim: &Rim, depth_mm: f64) -> Cut {
    let held = DVec2::new(rim.place.x / rim.stretch, rim.place.y);
    let outward = held.normalize_or(DVec2::Y);
    let points = imprint.section(outward, ABOVE * depth_mm);
    let rim_mm = half_outline(&points, 1.0).measures(depth_mm).edges_mm[1];
    let wanted = rim.place.dot(direction(rim.axis_rad)).max(0.0);
    let scale = if rim_mm > 0.0 { wanted / rim_mm } else { 1.0 };
    half_outline(&points, scale).cut(depth_mm)
}

/// An outline that starts at the tip, its distances from there scaled.
fn half_outline(points: &[DVec2], scale: f64) -> Outline {
    let place = |point: DVec2| DVec2::new(point.x * scale, point.y);
    let piece = |pair: &[DVec2]| Piece::Line {
        from: place(pair[0]),
        to: place(pair[1]),
    };
    Outline::new(points.windows(2).map(piece).collect())
}

/// Azimuth of a direction (x to the right, y forward), counter-clockwise from forward.
fn azimuth_rad(direction: DVec2) -> f64 {
    (-direction.x).atan2(direction.y)
}

fn direction(azimuth_rad: f64) -> DVec2 {
    let (sin, cos) = azimuth_rad.sin_cos();
    DVec2::new(-sin, cos)
}

#[cfg(test)]
mod tests;

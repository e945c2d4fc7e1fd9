//! The cross-section as a function of one quantity: arc length along a scratch, or the force on a tool.

use super::along::Along;
use super::caps::{ENDS, EndCaps};
use super::course::value;
use super::scratch::{Held, Key, Scratch};
use crate::brdf::{Brdf, Finish};
use crate::error::{Error, Result, in_range};
use crate::formation::{CrossSection, EndCap, HardnessMap, Layer, MOST_FACETS, Material, Process};
use crate::single;
use glam::{DVec2, Vec2};
use std::borrow::Cow;

/// Points of the most finely faceted cross-section.
pub(crate) const MOST_VERTICES: usize = MOST_FACETS + 5;

/// Between stations the cross-section is interpolated; it strays from the true one by at most this share
/// of its own size.
const INTERPOLATION_ERROR: f64 = 0.01;

/// Stations between two keys are at most 2 to the power of this.
const MOST_HALVINGS: u32 = 7;

/// Cross-sections at stations, all with the same number of vertices, so that the shape in between is their
/// mean, vertex by vertex: continuous whatever changes. There is one station or more.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Where each station is, ascending: a share of arc length, or a force or depth.
    pub at: Vec<f64>,
    /// `vertex_count` points per station, station after station.
    pub vertices: Vec<Vec2>,
    pub vertex_count: usize,
    /// What stands beyond hard ends, where it starts and where it stops; empty if no end is hard.
    pub caps: [EndCaps; 2],
    pub finishes: Finishes,
}

/// The finishes of a scratch's zones, from the surface down.
#[derive(Clone, Debug, Default)]
pub(crate) struct Finishes {
    /// Each layer's lower interface (z, mm, below 0) and finish.
    pub layers: Vec<(f32, Finish)>,
    pub bulk: Finish,
}

/// What a scratch is drawn over.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground<'a> {
    pub along: Along<'a>,
    pub surface: &'a Material,
    pub hardness: Option<&'a HardnessMap>,
    /// The path goes on where it ends.
    pub is_closed: bool,
}

impl Track {
    /// One scratch's cross-sections by arc length: for a hand that turns, or a surface of varying hardness. Where
    /// it names no material of its own, it scratches the surface's.
    pub(crate) fn along(scratch: &Scratch<'_>, ground: &Ground<'_>) -> Result<Self> {
        let material = scratch.material.unwrap_or(ground.surface);
        let map = ground.hardness.filter(|_| scratch.material.is_none());
        let process = |at: f64| process_at(scratch, ground, at);
        let here = |at: f64| match map {
            Some(map) => Cow::Owned(Material {
                hardness_hv: map.at(ground.along.uv(at)),
                ..material.clone()
            }),
            None => Cow::Borrowed(material),
        };
        let section = |at: f64| {
            CrossSection::form(scratch.tool, &process(at), &here(at))
                .map_err(|error| in_key(error, scratch.keys, at))
        };
        // Keys first: what they state themselves is theirs to blame for.
        for key in scratch.keys {
            section(key.at)?;
        }
        let mut track = Self::over(&spans(scratch, ground), material, &section)?;
        let hard = hard_ends(scratch, ground.is_closed);
        for (i, at) in [0.0, 1.0].into_iter().enumerate() {
            if hard[i].is_some() {
                let cap = EndCap::form(scratch.tool, &process(at), &here(at), ENDS[i]);
                let cap = cap.map_err(|error| in_key(error, scratch.keys, at))?;
                track.push_cap(i, at, &cap, &section(at)?);
            }
        }
        Ok(track)
    }

    /// The track of a tool that leaves no scratch: one station, at which the surface is flat.
    pub(crate) fn bare(material: &Material) -> Self {
        let vertex_count = 1 + 5;
        Self {
            at: vec![0.0],
            vertices: vec![Vec2::ZERO; vertex_count],
            vertex_count,
            caps: Default::default(),
            finishes: Finishes::of(material),
        }
    }

    /// Cross-sections over spans of whatever `section` depends on; the spans ascend, and follow one another.
    pub(crate) fn over(
        spans: &[[f64; 2]],
        material: &Material,
        section: &impl Fn(f64) -> Result<CrossSection>,
    ) -> Result<Self> {
        let step_rad = finest_step_rad(material);
        let mut facets = 1;
        for at in spans
            .iter()
            .flat_map(|&[from, to]| [from, 0.5 * (from + to), to])
        {
            facets = facets.max(section(at)?.facets_needed(step_rad));
        }
        let faceted = |at: f64| section(at).map(|formed| formed.faceted(facets));
        let mut track = Self {
            at: Vec::new(),
            vertices: Vec::new(),
            vertex_count: facets + 5,
            caps: Default::default(),
            finishes: Finishes::of(material),
        };
        track.push(spans[0][0], &faceted(spans[0][0])?);
        for &[from, to] in spans.iter().filter(|[from, to]| to > from) {
            let ends = [faceted(from)?, faceted(to)?];
            track.refine([from, to], &ends, MOST_HALVINGS, &faceted)?;
        }
        Ok(track)
    }

    /// Appends stations after `span[0]` up to `span[1]`, halving until interpolation is close enough.
    fn refine(
        &mut self,
        span: [f64; 2],
        ends: &[Vec<DVec2>; 2],
        halvings: u32,
        faceted: &impl Fn(f64) -> Result<Vec<DVec2>>,
    ) -> Result<()> {
        let middle_at = 0.5 * (span[0] + span[1]);
        let middle = faceted(middle_at)?;
        if halvings == 0 || close_to_mean(&middle, ends) {
            self.push(span[1], &ends[1]);
            return Ok(());
        }
        let first = [ends[0].clone(), middle.clone()];
        self.refine([span[0], middle_at], &first, halvings - 1, faceted)?;
        let second = [middle, ends[1].clone()];
        self.refine([middle_at, span[1]], &second, halvings - 1, faceted)
    }

    /// Appends to the caps of an end (0 or 1) the one that follows a cross-section.
    pub(crate) fn push_cap(&mut self, end: usize, at: f64, cap: &EndCap, section: &CrossSection) {
        let run = section.faceted(self.vertex_count - 5);
        self.caps[end].push(at, cap, &run);
    }

    fn push(&mut self, at: f64, points: &[DVec2]) {
        self.at.push(at);
        self.vertices
            .extend(points.iter().map(|point| point.as_vec2()));
    }
}

pub(crate) fn check_keys(keys: &[Key]) -> Result<()> {
    if keys.is_empty() {
        return Err(Error::count("key_count", 0, "one or more"));
    }
    let mut last = 0.0;
    for (i, key) in keys.iter().enumerate() {
        let in_order = in_range("at", key.at, last, 1.0);
        let checked = in_order
            .and_then(|_| in_range("force_kgf", key.force_kgf, 0.0, 100_000.0))
            .and_then(|_| in_range("depth_mm", key.depth_mm, 0.0, 1000.0))
            .and_then(|_| key.orientation.check());
        checked.map_err(|error| error.within("keys", i))?;
        last = key.at;
    }
    Ok(())
}

/// What a scratch presses with at its start and where it stops, at hard ends: where that is not 0.
pub(crate) fn hard_ends(scratch: &Scratch<'_>, is_closed: bool) -> [Option<f64>; 2] {
    [0.0, 1.0].map(|at| {
        let value = value(&key_at(scratch.keys, at), scratch.depth_law);
        (value > 0.0 && !is_closed).then_some(value)
    })
}

/// Arc-length spans in which the process changes smoothly.
fn spans(scratch: &Scratch<'_>, ground: &Ground<'_>) -> Vec<[f64; 2]> {
    let keys = scratch.keys;
    let mut at: Vec<f64> = keys.iter().map(|key| key.at).chain([0.0, 1.0]).collect();
    if ground.hardness.is_some() || scratch.held == Held::ToSurface {
        at.extend(ground.along.knots());
    }
    at.sort_unstable_by(f64::total_cmp);
    at.windows(2)
        .filter(|w| w[1] > w[0])
        .map(|w| [w[0], w[1]])
        .collect()
}

/// Force and orientation, relative to the travel, at a share of arc length.
fn process_at(scratch: &Scratch<'_>, ground: &Ground<'_>, at: f64) -> Process {
    let key = key_at(scratch.keys, at);
    let mut orientation = key.orientation;
    if scratch.held == Held::ToSurface {
        let heading = ground.along.heading_deg(at);
        orientation.spin_deg = (orientation.spin_deg - heading).rem_euclid(360.0);
        orientation.azimuth_deg = (orientation.azimuth_deg - heading).rem_euclid(360.0);
    }
    let Key {
        force_kgf,
        depth_mm,
        ..
    } = key;
    Process {
        depth_law: scratch.depth_law,
        force_kgf,
        depth_mm,
        orientation,
    }
}

/// The facet step that the smoothest of a material's finishes asks for.
fn finest_step_rad(material: &Material) -> f64 {
    let layers = material.layers.iter().map(|layer| layer.scratched);
    let steps = layers.chain([material.scratched]).map(Brdf::facet_step_rad);
    steps.fold(f64::INFINITY, f64::min)
}

impl Finishes {
    fn of(material: &Material) -> Self {
        let mut depth_mm = 0.0;
        let layer = |layer: &Layer| {
            depth_mm += layer.thickness_mm;
            (single(-depth_mm), Finish::new(&layer.scratched))
        };
        Self {
            layers: material.layers.iter().map(layer).collect(),
            bulk: Finish::new(&material.scratched),
        }
    }
}

/// The process between keys, linear in arc length; constant before the first and after the last.
pub(crate) fn key_at(keys: &[Key], at: f64) -> Key {
    let next = keys.partition_point(|key| key.at <= at);
    match (next.checked_sub(1).map(|i| keys[i]), keys.get(next)) {
        (Some(last), Some(next)) => last.mix(next, (at - last.at) / (next.at - last.at)),
        (Some(last), None) => last,
        (None, next) => next.copied().unwrap_or(Key::force(0.0, 0.0)),
    }
}

/// An error of the cross-section at `at`, said of the key nearest before it.
pub(crate) fn in_key(error: Error, keys: &[Key], at: f64) -> Error {
    error.within("keys", keys.partition_point(|key| key.at <= at).max(1) - 1)
}

fn close_to_mean(middle: &[DVec2], ends: &[Vec<DVec2>; 2]) -> bool {
    let size = |points: &[DVec2]| {
        points
            .iter()
            .fold(DVec2::splat(1e-300), |size, point| size.max(point.abs()))
    };
    let allowed = size(middle).max(size(&ends[0])).max(size(&ends[1])) * INTERPOLATION_ERROR;
    middle
        .iter()
        .zip(ends[0].iter().zip(&ends[1]))
        .all(|(middle, (a, b))| {
            let stray = (*middle - 0.5 * (*a + *b)).abs();
            stray.cmple(allowed).all()
        })
}

//! The cross-section as a function of arc length along one scratch.

use super::along::Along;
use super::scratch::{Held, Key, Scratch};
use crate::brdf::{Brdf, Finish};
use crate::error::{Error, Result, in_range};
use crate::formation::{CrossSection, HardnessMap, Layer, MOST_FACETS, Material, Process};
use crate::single;
use glam::{DVec2, Vec2};

/// Points of the most finely faceted cross-section.
pub(crate) const MOST_VERTICES: usize = MOST_FACETS + 5;

/// Between stations the cross-section is interpolated; it strays from the true one by at most this share
/// of its own size.
const INTERPOLATION_ERROR: f64 = 0.01;

/// Within one run of a scratch, which has one cross-section in a footprint, its points move by no more than
/// this share of its half width or height.
const MOST_CHANGE: f64 = 0.14;

/// Stations between two keys are at most 2 to the power of this.
const MOST_HALVINGS: u32 = 7;

/// Cross-sections at stations along a scratch, all with the same number of vertices, so that the shape
/// in between is their mean, vertex by vertex: continuous along the path whatever changes.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Where each station is, as a share of arc length, ascending.
    at: Vec<f64>,
    /// `vertex_count` points per station, station after station.
    vertices: Vec<Vec2>,
    vertex_count: usize,
    pub finishes: Finishes,
    pub extent: Extent,
}

/// The finishes of a scratch's zones, from the surface down.
#[derive(Clone, Debug)]
pub(crate) struct Finishes {
    /// Each layer's lower interface (z, mm, below 0) and finish.
    pub layers: Vec<(f32, Finish)>,
    pub bulk: Finish,
}

/// What of a cross-section bounds how far it matters, mm.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Extent {
    pub half_width_mm: f32,
    pub height_mm: f32,
}

/// What a scratch is drawn over.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground<'a> {
    pub along: Along<'a>,
    pub surface: &'a Material,
    pub hardness: Option<&'a HardnessMap>,
}

impl Track {
    /// The scratch's cross-sections. Where it names no material of its own, it scratches the surface's.
    pub(crate) fn new(scratch: &Scratch<'_>, ground: &Ground<'_>) -> Result<Self> {
        check_keys(scratch.keys)?;
        let material = scratch.material.unwrap_or(ground.surface);
        material.check()?;
        let map = ground.hardness.filter(|_| scratch.material.is_none());
        let section = |at: f64| {
            let process = process_at(scratch, ground, at);
            let formed = match map {
                Some(map) => {
                    let hardness_hv = map.at(ground.along.uv(at));
                    let here = Material {
                        hardness_hv,
                        ..material.clone()
                    };
                    CrossSection::form(scratch.tool, &process, &here)
                }
                None => CrossSection::form(scratch.tool, &process, material),
            };
            formed.map_err(|error| in_key(error, scratch.keys, at))
        };
        // Keys first: what they state themselves is theirs to blame for.
        for key in scratch.keys {
            section(key.at)?;
        }
        let spans = spans(scratch, ground, map.is_some());
        let mut facets = 1;
        for at in spans
            .iter()
            .flat_map(|&[from, to]| [from, 0.5 * (from + to), to])
        {
            let step_rad = finest_step_rad(material);
            facets = facets.max(section(at)?.facets_needed(step_rad));
        }
        let faceted = |at: f64| section(at).map(|formed| formed.faceted(facets));
        let mut track = Self {
            at: Vec::new(),
            vertices: Vec::new(),
            vertex_count: facets + 5,
            finishes: Finishes::of(material),
            extent: Extent::default(),
        };
        track.push(spans[0][0], &faceted(spans[0][0])?);
        for [from, to] in spans.into_iter().filter(|[from, to]| to > from) {
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

    fn push(&mut self, at: f64, points: &[DVec2]) {
        self.at.push(at);
        for point in points {
            self.extent.half_width_mm = self.extent.half_width_mm.max(single(point.x.abs()));
            self.extent.height_mm = self.extent.height_mm.max(single(point.y.abs()));
        }
        self.vertices
            .extend(points.iter().map(|point| point.as_vec2()));
    }

    /// The cross-section's vertices at a share of arc length, as x and z written to the two slices.
    pub(crate) fn sample(&self, at: f64, xs: &mut [f32], zs: &mut [f32]) {
        let count = self.vertex_count;
        let next = self
            .at
            .partition_point(|&station| station <= at)
            .min(self.at.len() - 1);
        let last = next.saturating_sub(1);
        let span = self.at[next] - self.at[last];
        let mix = if span > 0.0 {
            single(((at - self.at[last]) / span).clamp(0.0, 1.0))
        } else {
            0.0
        };
        let station = |i: usize| &self.vertices[i * count..(i + 1) * count];
        let pairs = station(last).iter().zip(station(next));
        for ((a, b), (x, z)) in pairs.zip(xs.iter_mut().zip(zs.iter_mut())) {
            let point = a.lerp(*b, mix);
            (*x, *z) = (point.x, point.y);
        }
    }

    /// Shares of arc length between which the cross-section changes by [`MOST_CHANGE`] of its largest size.
    pub(crate) fn cuts(&self) -> Vec<f64> {
        let size =
            Vec2::new(self.extent.half_width_mm, self.extent.height_mm).max(Vec2::splat(1e-30));
        let stations: Vec<&[Vec2]> = self.vertices.chunks(self.vertex_count).collect();
        let change = |pair: &[&[Vec2]]| {
            let between = pair[0].iter().zip(pair[1]).map(|(a, b)| (*b - *a) / size);
            between.fold(0.0, |most: f32, step| most.max(step.abs().max_element()))
        };
        let (mut cuts, mut changed) = (Vec::new(), 0.0);
        for (pair, at) in stations.windows(2).zip(self.at.windows(2)) {
            let (from, to) = (at[0], at[1]);
            let step = f64::from(change(pair));
            while changed + step > MOST_CHANGE * (cuts.len() + 1) as f64 {
                let share = (MOST_CHANGE * (cuts.len() + 1) as f64 - changed) / step;
                cuts.push(from + (to - from) * share);
            }
            changed += step;
        }
        cuts
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.vertex_count
    }
}

fn check_keys(keys: &[Key]) -> Result<()> {
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

/// Arc-length spans in which the process changes smoothly; one of no length if it does not change at all.
fn spans(scratch: &Scratch<'_>, ground: &Ground<'_>, over_map: bool) -> Vec<[f64; 2]> {
    let keys = scratch.keys;
    let along = over_map || scratch.held == Held::ToSurface;
    if !along && keys.windows(2).all(|pair| pair[0].same_process(&pair[1])) {
        return vec![[0.0, 0.0]];
    }
    let mut at: Vec<f64> = keys.iter().map(|key| key.at).chain([0.0, 1.0]).collect();
    if along {
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
fn key_at(keys: &[Key], at: f64) -> Key {
    let next = keys.partition_point(|key| key.at <= at);
    match (next.checked_sub(1).map(|i| keys[i]), keys.get(next)) {
        (Some(last), Some(next)) => last.mix(next, (at - last.at) / (next.at - last.at)),
        (Some(last), None) => last,
        (None, next) => next.copied().unwrap_or(Key::force(0.0, 0.0)),
    }
}

/// An error of the cross-section at `at`, said of the key nearest before it.
fn in_key(error: Error, keys: &[Key], at: f64) -> Error {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::Metal;
    use crate::formation::{Orientation, Tool};
    use crate::pattern::Path;
    use crate::pattern::pieces::pieces;

    fn track(keys: &[Key]) -> Track {
        let tool = Tool::rockwell_c();
        let path = Path::Polyline(&[[0.0, 0.0], [1.0, 0.0]]);
        let curves = path.curves(DVec2::ONE).unwrap();
        let (pieces, length) = pieces(&curves, DVec2::ONE, 0);
        let steel = Material::metal(Metal::Steel);
        let ground = Ground {
            along: Along::new(&pieces, DVec2::ONE, length),
            surface: &steel,
            hardness: None,
        };
        Track::new(
            &Scratch {
                path,
                keys,
                ..Scratch::new(&tool)
            },
            &ground,
        )
        .unwrap()
    }

    /// A constant process needs one station; a force that sets in softly is followed closely.
    #[test]
    fn stations_follow_the_process() {
        assert_eq!(
            track(&[Key::force(0.0, 1.0), Key::force(1.0, 1.0)])
                .at
                .len(),
            1
        );
        let soft = track(&[Key::force(0.0, 0.0), Key::force(1.0, 4.0)]);
        assert!(soft.at.len() > 4, "{:?}", soft.at);
        let (mut xs, mut zs) = ([0.0; MOST_VERTICES], [0.0; MOST_VERTICES]);
        soft.sample(0.0, &mut xs, &mut zs);
        assert!(xs.iter().all(|&x| x == 0.0), "a soft end has no width");
    }

    /// The cross-section has no step anywhere along the scratch.
    #[test]
    fn cross_section_is_continuous() {
        let turned = Key {
            orientation: Orientation {
                spin_deg: 0.0,
                tilt_deg: 25.0,
                azimuth_deg: 200.0,
            },
            ..Key::force(0.8, 2.0)
        };
        let track = track(&[Key::force(0.1, 0.0), Key::force(0.3, 3.0), turned]);
        let count = track.vertex_count();
        let mut last = [[0.0; MOST_VERTICES]; 2];
        let [xs, zs] = &mut last;
        track.sample(0.0, &mut xs[..count], &mut zs[..count]);
        for i in 1..=100_000_u32 {
            let mut next = [[0.0; MOST_VERTICES]; 2];
            let [xs, zs] = &mut next;
            track.sample(f64::from(i) / 1e5, &mut xs[..count], &mut zs[..count]);
            for (a, b) in last.iter().flatten().zip(next.iter().flatten()) {
                assert!((a - b).abs() < 2e-4, "step of {} mm at {i}", (a - b).abs());
            }
            last = next;
        }
    }
}

//! The cross-section as a function of arc length along one scratch.

use super::scratch::{Key, Scratch};
use crate::brdf::Finish;
use crate::error::{Error, Result, in_range};
use crate::formation::{CrossSection, MOST_FACETS, Material, Process};
use crate::single;
use glam::{DVec2, Vec2};

/// Points of the most finely faceted cross-section.
pub(crate) const MOST_VERTICES: usize = MOST_FACETS + 5;

/// Between stations the cross-section is interpolated; it strays from the true one by at most this share
/// of its own size.
const INTERPOLATION_ERROR: f64 = 0.01;

/// Stations between two keys are at most 2 to the power of this.
const MOST_HALVINGS: u32 = 7;

/// Cross-sections at stations along a scratch, all with the same number of vertices, so that the shape
/// in between is their mean, vertex by vertex: continuous along the path whatever changes.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Where each station is, as a share of arc length, ascending.
    at: Vec<f32>,
    /// `vertex_count` points per station, station after station.
    vertices: Vec<Vec2>,
    vertex_count: usize,
    pub finish: Finish,
}

/// What of a cross-section bounds how far it matters, mm.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Extent {
    pub half_width_mm: f32,
    pub height_mm: f32,
}

impl Track {
    /// The scratch's cross-sections; `surface` is scratched where the scratch names no material of its own.
    pub(crate) fn new(scratch: &Scratch<'_>, surface: &Material) -> Result<Self> {
        check_keys(scratch.keys)?;
        let material = scratch.material.copied().unwrap_or(*surface).check()?;
        let section = |at: f64| {
            let key = key_at(scratch.keys, at);
            let process = Process {
                depth_law: scratch.depth_law,
                force_kgf: key.force_kgf,
                orientation: key.orientation,
            };
            CrossSection::form(scratch.tool, &process, material.hardness_hv)
        };
        let varies = scratch
            .keys
            .windows(2)
            .any(|pair| !pair[0].same_process(&pair[1]));
        let spans = if varies {
            spans(scratch.keys)
        } else {
            vec![[0.0, 0.0]]
        };
        let mut facets = 1;
        for at in spans
            .iter()
            .flat_map(|&[from, to]| [from, 0.5 * (from + to), to])
        {
            let formed = section(at).map_err(|error| in_key(error, scratch.keys, at))?;
            facets = facets.max(formed.facets_needed(material.scratched.facet_step_rad()));
        }
        let faceted = |at: f64| -> Result<Vec<DVec2>> {
            let formed = section(at).map_err(|error| in_key(error, scratch.keys, at))?;
            Ok(formed.faceted(facets))
        };
        let mut track = Self {
            at: Vec::new(),
            vertices: Vec::new(),
            vertex_count: facets + 5,
            finish: Finish::new(&material.scratched),
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
        self.at.push(single(at));
        self.vertices
            .extend(points.iter().map(|point| point.as_vec2()));
    }

    /// The cross-section's vertices at a share of arc length, as x and z written to the two slices.
    pub(crate) fn sample(&self, at: f32, xs: &mut [f32], zs: &mut [f32]) {
        let count = self.vertex_count;
        let next = self
            .at
            .partition_point(|&station| station <= at)
            .min(self.at.len() - 1);
        let last = next.saturating_sub(1);
        let span = self.at[next] - self.at[last];
        let mix = if span > 0.0 {
            ((at - self.at[last]) / span).clamp(0.0, 1.0)
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

    pub(crate) fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    pub(crate) fn extent(&self) -> Extent {
        self.vertices
            .iter()
            .fold(Extent::default(), |extent, v| Extent {
                half_width_mm: extent.half_width_mm.max(v.x.abs()),
                height_mm: extent.height_mm.max(v.y.abs()),
            })
    }
}

fn check_keys(keys: &[Key]) -> Result<()> {
    if keys.is_empty() {
        return Err(Error::number("key_count", 0.0, "one or more"));
    }
    let mut last = 0.0;
    for (i, key) in keys.iter().enumerate() {
        let in_order = in_range("at", key.at, last, 1.0);
        let checked = in_order
            .and_then(|_| in_range("force_kgf", key.force_kgf, 0.0, 100_000.0))
            .and_then(|_| key.orientation.check());
        checked.map_err(|error| error.within("keys", i))?;
        last = key.at;
    }
    Ok(())
}

/// Arc-length spans between keys, the ends of the path included.
fn spans(keys: &[Key]) -> Vec<[f64; 2]> {
    let inner = keys.iter().map(|key| key.at);
    let at: Vec<f64> = [0.0].into_iter().chain(inner).chain([1.0]).collect();
    at.windows(2)
        .filter(|w| w[1] > w[0])
        .map(|w| [w[0], w[1]])
        .collect()
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

    fn track(keys: &[Key]) -> Track {
        let tool = Tool::rockwell_c();
        let path = Path::Polyline(&[[0.0, 0.0], [1.0, 0.0]]);
        let scratch = Scratch {
            path,
            keys,
            ..Scratch::new(&tool)
        };
        Track::new(&scratch, &Material::metal(Metal::Steel)).unwrap()
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
            track.sample(
                single(f64::from(i) / 1e5),
                &mut xs[..count],
                &mut zs[..count],
            );
            for (a, b) in last.iter().flatten().zip(next.iter().flatten()) {
                assert!((a - b).abs() < 2e-4, "step of {} mm at {i}", (a - b).abs());
            }
            last = next;
        }
    }
}

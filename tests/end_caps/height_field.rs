//! An end as an explicit surface, looked at by rays.

use super::FORCE_KGF;
use super::support::caster::dot;
use super::support::dark_sheet;
use glam::DVec2;
use std::f64::consts::PI;
use striae::formation::{CrossSection, Process, Tool};

/// The end of an upright cone's scratch as an explicit surface: the cross-section behind the end, ahead of it the
/// surface of revolution of its half.
pub(crate) struct HeightField {
    /// Heights by distance from the centre line, or from the end, at equal steps.
    heights: Vec<f64>,
    /// Half the scratch's width, with its rims.
    pub(crate) foot_mm: f64,
    top_mm: f64,
}

const STEPS: usize = 2000;

impl HeightField {
    pub(crate) fn new() -> Self {
        let process = Process {
            force_kgf: FORCE_KGF,
            ..Process::default()
        };
        let tool = Tool::rockwell_c();
        let section = CrossSection::form(&tool, &process, &dark_sheet()).unwrap();
        let points = section.vertices();
        let foot_mm = points[points.len() - 1].x;
        let height = |x: f64| {
            let after = points.partition_point(|p| p.x <= x).min(points.len() - 1);
            let (a, b) = (points[after - 1], points[after]);
            a.lerp(b, (x - a.x) / (b.x - a.x)).y
        };
        let heights: Vec<f64> = (0..=STEPS)
            .map(|i| height(foot_mm * i as f64 / STEPS as f64))
            .collect();
        let top_mm = heights.iter().copied().fold(0.0, f64::max);
        Self {
            heights,
            foot_mm,
            top_mm,
        }
    }

    /// Outward distance and its direction.
    fn away(&self, p: DVec2) -> (f64, DVec2) {
        let from = if p.x > 0.0 {
            DVec2::ZERO
        } else {
            DVec2::X * p.x
        };
        let away = p - from;
        (away.length(), away.normalize_or(DVec2::Y))
    }

    /// Height and slope at a distance.
    fn at(&self, distance: f64) -> (f64, f64) {
        let place = distance / self.foot_mm * STEPS as f64;
        let Some(i) = (0..STEPS).nth(floor(place)) else {
            return (0.0, 0.0);
        };
        let rise = self.heights[i + 1] - self.heights[i];
        let height = self.heights[i] + rise * (place - i as f64);
        (height, rise / self.foot_mm * STEPS as f64)
    }

    fn above(&self, p: [f64; 3]) -> f64 {
        p[2] - self.at(self.away(DVec2::new(p[0], p[1])).0).0
    }

    /// The first place on a ray from above, where it passes below the surface.
    fn meets(&self, from: [f64; 3], direction: [f64; 3], length: f64) -> Option<[f64; 3]> {
        let along = |t: f64| [0, 1, 2].map(|i| from[i] + t * direction[i]);
        let count = (length / 1e-3).ceil().clamp(8.0, 400.0);
        let step = length / count;
        let mut t = 0.0;
        while t < length {
            let next = t + step;
            if self.above(along(next)) < 0.0 {
                let (mut above, mut below) = (t, next);
                for _ in 0..24 {
                    let middle = 0.5 * (above + below);
                    *(if self.above(along(middle)) < 0.0 {
                        &mut below
                    } else {
                        &mut above
                    }) = middle;
                }
                return Some(along(above));
            }
            t = next;
        }
        None
    }

    /// What the ray towards a viewer through a place of the plane shows: Lambert's law, shadow or light.
    pub(crate) fn radiance(&self, place: DVec2, view: [f64; 3], light: [f64; 3]) -> f64 {
        let top = 1.01 * self.top_mm + 1e-6;
        let bottom = self.heights[0] - 1e-6;
        let above = [0, 1, 2].map(|i| [place.x, place.y, 0.0][i] + view[i] * top / view[2]);
        let down = view.map(|component| -component);
        let Some(p) = self.meets(above, down, (top - bottom) / view[2]) else {
            return f64::NAN;
        };
        let (distance, outward) = self.away(DVec2::new(p[0], p[1]));
        let (_, slope) = self.at(distance);
        let albedo = if distance < self.foot_mm { 0.9 } else { 0.002 };
        let normal = [-slope * outward.x, -slope * outward.y, 1.0];
        let cos = dot(normal, light) / slope.hypot(1.0);
        let start = [p[0], p[1], p[2] + 1e-7];
        if cos <= 0.0 || self.meets(start, light, (top - p[2]) / light[2]).is_some() {
            return 0.0;
        }
        albedo / PI * cos
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates"
)]
fn floor(place: f64) -> usize {
    place as usize
}

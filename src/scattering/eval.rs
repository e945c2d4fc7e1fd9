//! What a prepared point reflects of one light, zone by zone.

use super::relief::{MOST_FINISHES, Zone};
use super::shading::{LEAST_COS, Shading, direction};
use crate::brdf::{ACROSS_SURFACE, Pair};
use glam::{Vec2, Vec3};

/// Weights that should add up to 1 do so within this; less flat surface than that is none, or it would shine
/// through a pixel that lies within a scratch.
const ROUNDING: f32 = 1e-6;

/// What [`Shading::eval`] gives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Output {
    /// BRDF times the cosine between light and normal.
    #[default]
    BrdfCos,
    /// The BRDF alone.
    Brdf,
}

impl Shading {
    /// RGB reflected towards the view from a light in direction `light` (of any length above 0, in the local
    /// frame). Black for a light that is no direction, or below the surface.
    pub fn eval(&self, light: [f32; 3], output: Output) -> [f32; 3] {
        let Some(pair) = self.pair(light) else {
            return [0.0; 3];
        };
        let sum = self.reflected(&pair);
        match output {
            Output::BrdfCos => sum.to_array(),
            Output::Brdf => (sum / pair.light.z).to_array(),
        }
    }

    /// View and light, unless this light or this point reflects nothing.
    pub(super) fn pair(&self, light: [f32; 3]) -> Option<Pair> {
        let light = direction(light).filter(|light| light.z >= LEAST_COS)?;
        self.is_seen().then(|| Pair::new(self.view, light))
    }

    /// Whether the view is above the surface; else the point reflects nothing.
    pub(super) fn is_seen(&self) -> bool {
        self.view.z >= LEAST_COS
    }

    /// BRDF times cosine, RGB.
    pub(super) fn reflected(&self, pair: &Pair) -> Vec3 {
        let mut lobes = [0.0; MOST_FINISHES];
        self.each_zone(pair, |zone, pair, _| {
            if zone.lit > 0.0 {
                let lobe = self
                    .zones
                    .finish_of(zone.finish)
                    .lobe_cos(zone.normal, pair);
                lobes[zone.finish as usize] += zone.lit * lobe;
            }
        });
        let mut sum = self.zones.colour(&lobes, pair) + self.hosted(pair);
        if self.has_all_bounces() {
            sum += self.indirect(pair);
        }
        finite(sum)
    }

    /// Visits each zone that the viewer sees, with view and light in the frame of its scratch and that frame's first
    /// axis; the flat surface comes last.
    pub(super) fn each_zone(&self, pair: &Pair, mut visit: impl FnMut(&Zone, &Pair, Vec2)) {
        let mut taken = 0.0;
        for relief in self.reliefs() {
            let (across, pair) = (relief.across, pair.turned(relief.across));
            taken += self
                .zones
                .each_of_relief(relief, &pair, |zone| visit(zone, &pair, across));
        }
        for flock in self.flocks.iter() {
            let (across, pair) = (flock.across, pair.turned(flock.across));
            taken += self
                .zones
                .each_of_flock(&flock, &pair, |zone| visit(zone, &pair, across));
        }
        let flat = Zone {
            lit: rest(taken),
            ..Zone::flat(rest(self.coverage()))
        };
        visit(&flat, &pair.turned(ACROSS_SURFACE), ACROSS_SURFACE);
    }
}

/// What is left of the flat surface.
pub(super) fn rest(taken: f32) -> f32 {
    if taken < 1.0 - ROUNDING {
        1.0 - taken
    } else {
        0.0
    }
}

pub(super) fn finite(rgb: Vec3) -> Vec3 {
    if rgb.is_finite() { rgb } else { Vec3::ZERO }
}

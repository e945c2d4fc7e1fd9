//! What a prepared point reflects of one light, zone by zone.

use super::relief::MOST_FINISHES;
use super::shading::{LEAST_COS, Shading, direction};
use super::visibility::Parts;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Local, Pair};
use crate::lanes::{Lanes, Number, One, in_lanes};
use glam::{Vec2, Vec3};

/// Weights that should add up to 1 do so within this; less flat surface than that is none, or it would shine
/// through a pixel that lies within a scratch.
pub(super) const ROUNDING: f32 = 1e-6;

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
    #[inline(always)]
    pub fn eval(&self, light: [f32; 3], output: Output) -> [f32; 3] {
        let Some(pair) = self.pair(light) else {
            return [0.0; 3];
        };
        let sum = self.reflected(&pair);
        match output {
            Output::BrdfCos => sum.to_array(),
            Output::Brdf => without_cos(sum, pair.light.z),
        }
    }

    /// View and light, unless this light or this point reflects nothing.
    #[inline(always)]
    pub(super) fn pair(&self, light: [f32; 3]) -> Option<Pair> {
        let light = direction(light).filter(|light| light.z >= LEAST_COS)?;
        self.is_seen().then(|| Pair::new(self.view, light))
    }

    /// Whether the view is above the surface; else the point reflects nothing.
    pub(super) fn is_seen(&self) -> bool {
        self.view.z >= LEAST_COS
    }

    /// BRDF times cosine, RGB.
    #[inline(always)]
    pub(super) fn reflected(&self, pair: &Pair) -> Vec3 {
        let mut lobes = [0.0; MOST_FINISHES];
        // Pairs by value: on the way of most points, which have no scratch, none is written down.
        let taken = if self.is_scratched() {
            self.add_scratches(*pair, &mut lobes)
        } else {
            0.0
        };
        lobes[0] += self.lobe(One, &self.surface(taken), &pair.level());
        let mut sum = self.zones.colour(&lobes, pair.view_half);
        if self.zones.has_hosted() {
            sum += self.hosted(*pair);
        }
        if self.has_all_bounces() {
            sum += self.indirect(*pair);
        }
        finite(sum)
    }

    /// Adds what the lobes of each finish of all scratches add up to; what of the flat surface they take from this light.
    #[inline(never)]
    fn add_scratches(&self, pair: Pair, lobes: &mut [f32; MOST_FINISHES]) -> f32 {
        in_lanes!(lanes => self.each_scratch_zone(
            lanes,
            &pair,
            #[inline(always)]
            |zone, pair, _| lobes[zone.finish as usize] += self.lobe(lanes, zone, &zone.sees(pair)),
        ))
    }

    /// What of a finish's colour lit zones reflect; `pair` is as they see it.
    #[inline(always)]
    pub(super) fn lobe<L: Lanes>(&self, lanes: L, zone: &Zone<L::F>, pair: &Local<L::F>) -> f32 {
        if !zone.lit.any() {
            return 0.0;
        }
        let finish = self.zones.finish_of(zone.finish);
        let lobes = finish.lobes_cos(lanes, pair);
        let none = lanes.all(0.0);
        // Where no light falls a lobe may be anything.
        (zone.lit.if_above(none, zone.lit * lobes, none)).sum()
    }

    /// Visits each zone that the viewer sees, with view and light in the frame of its scratch and that frame's first
    /// axis; the flat surface comes last.
    pub(super) fn each_zone(&self, pair: &Pair, mut visit: impl FnMut(&Zone, &Pair, Vec2)) {
        let taken = self.each_scratch_zone(One, pair, &mut visit);
        let turned = pair.turned(ACROSS_SURFACE);
        visit(&self.surface(taken), &turned, ACROSS_SURFACE);
    }

    /// The same without the flat surface: what of it these zones take from the light.
    #[inline(always)]
    pub(super) fn each_scratch_zone<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        mut visit: impl FnMut(&Zone<L::F>, &Pair, Vec2),
    ) -> f32 {
        let mut taken = 0.0;
        let mut parts = Parts::new();
        for relief in self.reliefs() {
            let (across, pair) = (relief.across, pair.turned(relief.across));
            taken += self.zones.each_of_relief(
                lanes,
                &mut parts,
                relief,
                &pair,
                #[inline(always)]
                |zone| visit(zone, &pair, across),
            );
        }
        // To clear them takes as long as to look at a scratch: where there is no flock they are not.
        if !self.flocks.is_empty() {
            let mut both = [const { Parts::new() }; 2];
            for flock in self.flocks.iter() {
                let (across, pair) = (flock.across, pair.turned(flock.across));
                taken += self.zones.each_of_flock(
                    lanes,
                    &mut both,
                    &flock,
                    &pair,
                    #[inline(always)]
                    |zone| visit(zone, &pair, across),
                );
            }
        }
        taken
    }

    /// The flat surface, by what scratches take of it from this light.
    pub(super) fn surface(&self, taken: f32) -> Zone {
        Zone::flat(rest(self.coverage()), rest(taken))
    }

    /// Whether it holds any scratch.
    pub(super) fn is_scratched(&self) -> bool {
        self.relief_count > 0 || !self.flocks.is_empty()
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

/// Black in place of what is no colour.
#[inline(always)]
pub(super) fn finite(rgb: Vec3) -> Vec3 {
    // False of NaN too.
    let is_finite = rgb.abs().cmple(Vec3::MAX).all();
    if is_finite { rgb } else { Vec3::ZERO }
}

/// Apart: written into its caller it would be computed always, and then be left out.
#[inline(never)]
fn without_cos(sum: Vec3, cos: f32) -> [f32; 3] {
    (sum / cos).to_array()
}

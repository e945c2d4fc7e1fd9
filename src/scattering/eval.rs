//! What a prepared point reflects of one light, zone by zone.

use super::abreast::{Light, Reflected};
use super::shading::{LEAST_COS, Shading, direction};
use super::visibility::Parts;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Pair};
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
        let sums = in_lanes!(lanes => self.sums(lanes, pair, None));
        let mut sum = self.zones.colour(&sums.lobes, pair) + self.hosted(pair);
        if self.has_all_bounces() {
            sum += self.indirect(pair);
        }
        finite(sum)
    }

    /// What all zones reflect of a light, and how often their samples go there if it is also given `below` the surface.
    #[inline(always)]
    pub(super) fn sums<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        below: Option<&Pair>,
    ) -> Reflected<f32> {
        let mut sums = Reflected::NONE;
        if !self.flocks.is_empty() {
            let light = Light {
                pair: *pair,
                below: below.copied(),
            };
            [sums] = self.by_flocks(lanes, &[light]);
        }
        let taken = sums.taken;
        self.each_zone_but_flocks(
            lanes,
            pair,
            taken,
            #[inline(always)]
            |zone, turned, across| {
                sums.lobes[zone.finish as usize] += self.lobe(lanes, zone, turned);
                if let Some(below) = below {
                    sums.density += self.density(lanes, zone, turned, below, across);
                    sums.seen += zone.seen.sum();
                }
            },
        );
        sums
    }

    /// What of a finish's colour lit zones reflect; `pair` is in the frame of their scratch.
    #[inline(always)]
    pub(super) fn lobe<L: Lanes>(&self, lanes: L, zone: &Zone<L::F>, pair: &Pair) -> f32 {
        if !zone.lit.any() {
            return 0.0;
        }
        let [x, z] = zone.normal;
        let finish = self.zones.finish_of(zone.finish);
        let lobes = finish.lobes_cos(lanes, &pair.tilted(x, z));
        let none = lanes.all(0.0);
        // Where no light falls a lobe may be anything.
        (zone.lit.if_above(none, zone.lit * lobes, none)).sum()
    }

    /// Visits each zone that the viewer sees, with view and light in the frame of its scratch and that frame's first
    /// axis; the flat surface comes last.
    pub(super) fn each_zone(&self, pair: &Pair, mut visit: impl FnMut(&Zone, &Pair, Vec2)) {
        let mut taken = self.each_relief_zone(One, pair, &mut visit);
        let mut parts = [const { Parts::new() }; 2];
        for flock in self.flocks.iter() {
            let (across, pair) = (flock.across, pair.turned(flock.across));
            let visit = |zone: &Zone| visit(zone, &pair, across);
            taken += self.zones.each_of_flock(&mut parts, &flock, &pair, visit);
        }
        self.visit_flat(One, pair, taken, &mut visit);
    }

    /// The same without flocks, which take this share of the flat surface from the light.
    #[inline(always)]
    fn each_zone_but_flocks<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        taken: f32,
        mut visit: impl FnMut(&Zone<L::F>, &Pair, Vec2),
    ) {
        let taken = taken + self.each_relief_zone(lanes, pair, &mut visit);
        self.visit_flat(lanes, pair, taken, &mut visit);
    }

    /// The scratches' own that are held one by one; returns what of the flat surface they take from the light.
    #[inline(always)]
    fn each_relief_zone<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        visit: &mut impl FnMut(&Zone<L::F>, &Pair, Vec2),
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
        taken
    }

    #[inline(always)]
    fn visit_flat<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        taken: f32,
        visit: &mut impl FnMut(&Zone<L::F>, &Pair, Vec2),
    ) {
        let flat = Zone::flat(lanes, rest(self.coverage()), rest(taken));
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

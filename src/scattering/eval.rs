//! What a prepared point reflects of one light, zone by zone.

use super::abreast::{Light, Reflected};
use super::shading::{LEAST_COS, Shading, direction};
use super::visibility::Parts;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Pair, is_finite};
use crate::lanes::{Lanes, Number, One, in_lanes};
use crate::single;
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
        let Some(light) = self.light(light) else {
            return [0.0; 3];
        };
        let sum = self.reflected(light);
        match output {
            Output::BrdfCos => sum.to_array(),
            Output::Brdf => without_cos(sum, light.z),
        }
    }

    /// A light's direction, unless it or this point reflects nothing.
    #[inline(always)]
    pub(super) fn light(&self, light: [f32; 3]) -> Option<Vec3> {
        let light = direction(light).filter(|light| light.z >= LEAST_COS)?;
        self.is_seen().then_some(light)
    }

    /// View and light, unless this light or this point reflects nothing.
    pub(super) fn pair(&self, light: [f32; 3]) -> Option<Pair> {
        self.light(light).map(|light| Pair::new(self.view, light))
    }

    /// Whether the view is above the surface; else the point reflects nothing.
    pub(super) fn is_seen(&self) -> bool {
        self.view.z >= LEAST_COS
    }

    /// BRDF times cosine, RGB.
    #[inline(always)]
    pub(super) fn reflected(&self, light: Vec3) -> Vec3 {
        let pair = || Pair::new(self.view, light);
        // Most points have no scratch: on their way nothing is written down, and no registers are needed.
        let mut sum = if self.is_scratched() {
            self.scratched(light)
        } else {
            let mut none = Reflected::NONE;
            self.all_of(One, &mut none, &pair(), None).0
        };
        if self.zones.has_hosted() {
            sum += self.hosted(pair());
        }
        if self.has_all_bounces() {
            sum += self.indirect(pair());
        }
        finite(sum)
    }

    /// The same of a point with scratches.
    #[inline(never)]
    fn scratched(&self, light: Vec3) -> Vec3 {
        in_lanes!(lanes => {
            let pair = Pair::new(self.view, light);
            let mut sums = self.scratch_sums(lanes, &pair, None);
            self.all_of(lanes, &mut sums, &pair, None).0
        })
    }

    /// BRDF times cosine, RGB, and density of all that sums of scratches say and of the flat surface that they leave.
    #[inline(always)]
    pub(super) fn all_of<L: Lanes>(
        &self,
        lanes: L,
        sums: &mut Reflected<f32>,
        pair: &Pair,
        below: Option<&Pair>,
    ) -> (Vec3, f32) {
        self.add_surface(sums, pair, below);
        let colour = self.zones.colour(lanes, &sums.lobes, pair.view_half);
        (colour, self.mean(sums.density))
    }

    /// With what density samples go to a light, if their zones' densities add up to this.
    #[inline(always)]
    pub(super) fn mean(&self, density: f32) -> f32 {
        let pdf = density / self.seen;
        // What is no number, or too large, was nothing's.
        if self.seen > 0.0 && pdf < f32::INFINITY {
            pdf
        } else {
            0.0
        }
    }

    /// Adds to sums of scratches the flat surface, of which they take what they say.
    #[inline(always)]
    pub(super) fn add_surface(&self, sums: &mut Reflected<f32>, pair: &Pair, below: Option<&Pair>) {
        let surface = self.surface(sums.taken);
        // Of a pixel that lies within a scratch nothing.
        if surface.seen <= 0.0 && surface.lit <= 0.0 {
            return;
        }
        let turned = pair.level();
        self.add_zone(One, sums, &surface, (&turned, below, ACROSS_SURFACE));
    }

    /// What all scratches reflect of a light, and how often their zones' samples go there if it is also given `below` the
    /// surface.
    #[inline(always)]
    pub(super) fn scratch_sums<L: Lanes>(
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
        let taken = self.each_relief_zone(
            lanes,
            pair,
            #[inline(always)]
            |zone, turned, across| self.add_zone(lanes, &mut sums, zone, (turned, below, across)),
        );
        sums.taken += taken;
        sums
    }

    /// Adds a zone; the pair is in the frame of its scratch, which has this first axis.
    #[inline(always)]
    fn add_zone<L: Lanes>(
        &self,
        lanes: L,
        sums: &mut Reflected<f32>,
        zone: &Zone<L::F>,
        (turned, below, across): (&Pair, Option<&Pair>, Vec2),
    ) {
        let lobe = &mut sums.lobes[zone.finish as usize];
        let Some(below) = below else {
            *lobe += self.lobe(lanes, zone, turned);
            return;
        };
        if zone.seen.any() || zone.lit.any() {
            let finish = self.zones.finish_of(zone.finish);
            let below = turned.below_turned(below, across);
            let [lobes, pdfs] = finish.facet_lobes_and_pdfs(lanes, [turned, &below], zone.normal);
            *lobe += where_any(zone.lit, lobes).sum();
            sums.density += where_any(zone.seen, pdfs).sum();
        }
    }

    /// What of a finish's colour lit zones reflect; `pair` is in the frame of their scratch.
    #[inline(always)]
    pub(super) fn lobe<L: Lanes>(&self, lanes: L, zone: &Zone<L::F>, pair: &Pair) -> f32 {
        if !zone.lit.any() {
            return 0.0;
        }
        let finish = self.zones.finish_of(zone.finish);
        let lobes = finish.facet_lobes(lanes, pair, zone.normal);
        where_any(zone.lit, lobes).sum()
    }

    /// Visits each zone that the viewer sees, with view and light in the frame of its scratch and that frame's first
    /// axis; the flat surface comes last.
    pub(super) fn each_zone(&self, pair: &Pair, mut visit: impl FnMut(&Zone, &Pair, Vec2)) {
        // Of many small shares, which may leave little: in single, rounding would add up to more than that.
        let mut taken = f64::from(self.each_relief_zone(One, pair, &mut visit));
        // To clear these takes as long as to look at a scratch.
        if !self.flocks.is_empty() {
            let mut parts = [const { Parts::new() }; 2];
            for flock in self.flocks.iter() {
                let (across, pair) = (flock.across, pair.turned(flock.across));
                let visit = |zone: &Zone| visit(zone, &pair, across);
                taken += f64::from(self.zones.each_of_flock(&mut parts, &flock, &pair, visit));
            }
        }
        let turned = pair.turned(ACROSS_SURFACE);
        visit(&self.surface(single(taken)), &turned, ACROSS_SURFACE);
    }

    /// The zones of scratches that are held one by one: what of the flat surface they take from the light.
    #[inline(always)]
    fn each_relief_zone<L: Lanes>(
        &self,
        lanes: L,
        pair: &Pair,
        mut visit: impl FnMut(&Zone<L::F>, &Pair, Vec2),
    ) -> f32 {
        let mut taken = 0.0;
        for relief in self.reliefs() {
            let (across, pair) = (relief.across, pair.turned(relief.across));
            taken += self.zones.each_of_relief(
                lanes,
                relief,
                &pair,
                #[inline(always)]
                |zone| visit(zone, &pair, across),
            );
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

/// So much of each value: where there is none it may be anything.
#[inline(always)]
pub(super) fn where_any<F: Number>(share: F, value: F) -> F {
    let none = share.like(0.0);
    share.if_above(none, share * value, none)
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
    if is_finite(rgb) { rgb } else { Vec3::ZERO }
}

/// Apart: written into its caller it would be computed always, and then be left out.
#[inline(never)]
fn without_cos(sum: Vec3, cos: f32) -> [f32; 3] {
    (sum / cos).to_array()
}

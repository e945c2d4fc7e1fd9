//! How often the view would be chosen were the light the view, for paths that are walked from both ends.

use super::eval::{rest, where_any};
use super::flocks::Flock;
use super::shading::Shading;
use super::visibility::Parts;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Pair};
use crate::lanes::{Lanes, Number, One};
use glam::{Vec2, Vec3};

impl Shading {
    /// What [`Self::pdf`] of this point's view is once the point is prepared for `light` as its view (of any length
    /// above 0, in the local frame): told from the scratches that this point holds, without preparing another.
    pub fn pdf_reverse(&self, light: [f32; 3]) -> f32 {
        let Some(pair) = self.pair(light) else {
            return 0.0;
        };
        let back = Pair::new(pair.light, pair.view);
        let below = back.below();
        let (mut density, mut seen) = (0.0, 0.0);
        self.each_scratch_zone_from(pair.light, &back, |zone, turned, across| {
            density += self.density(One, zone, turned, &below, across);
            seen += zone.seen;
        });
        let left = rest(seen.min(1.0));
        let turned = back.turned(ACROSS_SURFACE);
        let flat = Zone::flat(left, left);
        density += self.density(One, &flat, &turned, &below, ACROSS_SURFACE);
        seen += left;
        let pdf = if seen > 0.0 { density / seen } else { 0.0 };
        if pdf.is_finite() { pdf } else { 0.0 }
    }

    /// Visits each zone of scratches that is seen from `from`, as each counts before all are thinned to fill the pixel and
    /// no more; `pair` is looked at from there.
    fn each_scratch_zone_from(
        &self,
        from: Vec3,
        pair: &Pair,
        mut visit: impl FnMut(&Zone, &Pair, Vec2),
    ) {
        for relief in self.reliefs() {
            let (across, turned) = (relief.across, pair.turned(relief.across));
            let mut whole = *relief;
            whole.gain *= self.crowding;
            self.zones
                .each_seen_from(&whole, turned.view, |zone| visit(zone, &turned, across));
        }
        let mut parts = [const { Parts::new() }; 2];
        let [crowd, shares] = self.seen_of_flocks(from);
        for flock in self.flocks.iter() {
            let (across, turned) = (flock.across, pair.turned(flock.across));
            let share = flock.share * self.crowding;
            let shown = share * (crowd / shares.max(f32::MIN_POSITIVE));
            let whole = Flock {
                share,
                strips: flock.strips.map(|strip| strip * self.crowding),
                shown,
                ..flock
            };
            self.zones
                .each_of_flock(&mut parts, &whole, &turned, |zone| {
                    visit(zone, &turned, across);
                });
        }
    }

    /// With what density the samples of zones go up to the pair's light, whether they go there or are turned up from below
    /// the surface: each as often as it is seen. `turned` is the pair in the frame of the zones' scratch, `below` the one
    /// whose light is mirrored below the surface.
    #[inline(always)]
    pub(super) fn density<L: Lanes>(
        &self,
        lanes: L,
        zone: &Zone<L::F>,
        turned: &Pair,
        below: &Pair,
        across: Vec2,
    ) -> f32 {
        if !zone.seen.any() {
            return 0.0;
        }
        let finish = self.zones.finish_of(zone.finish);
        let above = finish.facet_pdfs(lanes, turned, zone.normal);
        let below = finish.facet_pdfs(lanes, &turned.below_turned(below, across), zone.normal);
        where_any(zone.seen, above + below).sum()
    }
}

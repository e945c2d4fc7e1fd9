//! Zones whose base BRDFs are the host's own: each has a colour of its own, so that no lobes add up to be coloured once.

use super::shading::Shading;
use crate::brdf::Pair;
use glam::Vec3;

impl Shading {
    /// What all such zones reflect: BRDF times cosine, RGB.
    #[inline(never)]
    pub(super) fn hosted(&self, pair: Pair) -> Vec3 {
        let mut sum = Vec3::ZERO;
        self.each_zone(&pair, |zone, pair, _| {
            if zone.lit > 0.0 {
                let finish = self.zones.finish_of(zone.finish);
                sum += zone.lit * finish.hosted_cos(zone.normal(), pair);
            }
        });
        sum
    }
}

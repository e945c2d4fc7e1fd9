//! The zones of a prepared point, for renderers that evaluate base BRDFs of their own.

use super::shading::Shading;
use crate::brdf::{Brdf, Pair};
use glam::Vec2;

/// A facet of a scratch, or the flat surface, as a point shows it. Directions are unit vectors in the local frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct SeenZone {
    /// The zone's normal.
    pub normal: [f32; 3],
    /// Along the scratch, or along the flat surface's polishing lines; at right angles to `normal`.
    pub tangent: [f32; 3],
    /// How often [`Shading::sample`] chooses it, of all that is chosen: the share of the pixel that the viewer sees it in.
    /// Scratches of a crowd are chosen by what all of them show on average.
    pub seen: f32,
    /// The share of the pixel in which the viewer sees it lit: its BRDF times cosine, about `normal`, counts so often.
    pub lit: f32,
    /// Number of its base BRDF, see [`Shading::zone_brdf`].
    pub brdf: u32,
}

impl Shading {
    /// Writes the zones that the viewer sees, the flat surface last, as a light (of any length above 0, in the local frame)
    /// falls on them; no light does so from below the surface. Returns how many there are: more than are written if
    /// there is no room, none if the point reflects nothing.
    pub fn zones(&self, light: [f32; 3], zones: &mut [SeenZone]) -> usize {
        if !self.is_seen() {
            return 0;
        }
        let pair = self.pair(light);
        let lit = if pair.is_some() { 1.0 } else { 0.0 };
        let mut count = 0;
        let still = Pair::new(self.view, self.view);
        self.each_zone(&pair.unwrap_or(still), |zone, _, across| {
            if zone.facet.is_some() && zone.seen <= 0.0 {
                return;
            }
            if let Some(room) = zones.get_mut(count) {
                let along = Vec2::new(-across.y, across.x);
                *room = SeenZone {
                    normal: (across * zone.normal[0]).extend(zone.normal[1]).to_array(),
                    tangent: along.extend(0.0).to_array(),
                    seen: zone.seen,
                    lit: lit * zone.lit.max(0.0),
                    brdf: zone.finish.into(),
                };
            }
            count += 1;
        });
        count
    }

    /// The base BRDF of this number: 0 is the flat surface's. Nothing if the point has no such one.
    pub fn zone_brdf(&self, number: u32) -> Option<Brdf> {
        let finishes = self.zones.finishes();
        finishes.get(number as usize).map(|finish| finish.brdf())
    }
}

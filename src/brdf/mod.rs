//! Base BRDFs: what the finish of one zone does to light. They know nothing of scratches.
//!
//! Directions point away from the surface. All values are linear RGB.

mod finish;
mod fresnel;
mod ggx;
mod metal;

pub(crate) use finish::Finish;
pub use fresnel::Fresnel;
pub use metal::Metal;

use crate::error::{Result, in_range, rgb_in_range};
use glam::{Vec2, Vec3};

/// A base BRDF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brdf {
    /// Perfectly diffuse.
    Lambert {
        /// Albedo per channel, 0 to 1.
        albedo: [f32; 3],
    },
    /// GGX microfacets with height-correlated Smith masking (Heitz 2014).
    Ggx {
        /// Width of the distribution of slopes, 0.001 to 1.
        alpha: f32,
        /// Reflectance of a microfacet.
        fresnel: Fresnel,
    },
}

/// A direction of view and one of light, and what every zone's base BRDF needs of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub view: Vec3,
    pub light: Vec3,
    /// The unit half vector.
    pub half: Vec3,
    /// view · half
    pub view_half: f32,
}

impl Pair {
    pub(crate) fn new(view: Vec3, light: Vec3) -> Self {
        let sum = view + light;
        // Opposite directions (their sum 0) have no half vector; they are never both above a zone.
        let half = sum / sum.length().max(1e-6);
        Self {
            view,
            light,
            half,
            view_half: view.dot(half).clamp(0.0, 1.0),
        }
    }

    /// The same pair in the frame (across, along, up) of a scratch.
    pub(crate) fn turned(&self, across: Vec2) -> Self {
        let along = Vec2::new(-across.y, across.x);
        let turn = |w: Vec3| Vec3::new(w.truncate().dot(across), w.truncate().dot(along), w.z);
        Self {
            view: turn(self.view),
            light: turn(self.light),
            half: turn(self.half),
            view_half: self.view_half,
        }
    }
}

impl Brdf {
    /// Polished metal: GGX of width `alpha` (0.001 to 1) and the metal's own Fresnel reflectance.
    pub fn metal(metal: Metal, alpha: f32) -> Self {
        let (eta, k) = metal.eta_k();
        Self::Ggx {
            alpha,
            fresnel: Fresnel::Conductor { eta, k },
        }
    }

    /// Itself, if every value lies in its range.
    pub(crate) fn check(self) -> Result<Self> {
        match self {
            Self::Lambert { albedo } => {
                rgb_in_range("albedo", albedo, 0.0, 1.0)?;
            }
            Self::Ggx { alpha, fresnel } => {
                in_range("alpha", f64::from(alpha), 0.001, 1.0)?;
                fresnel.check()?;
            }
        }
        Ok(self)
    }

    /// How much the normal may step from facet to facet of a curved groove before its highlights would
    /// show as separate lines, radians.
    ///
    /// GGX lobes whose slopes are a width alpha apart add up to within 3 %, at three quarters to within 0.5 %.
    pub(crate) fn facet_step_rad(self) -> f64 {
        match self {
            Self::Lambert { .. } => 0.2,
            Self::Ggx { alpha, .. } => (0.75 * f64::from(alpha)).clamp(0.03, 0.2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A white GGX reflects no more than it receives, and most of it when smooth.
    #[test]
    fn ggx_albedo_is_at_most_one() {
        let fresnel = Fresnel::Schlick { f0: [1.0; 3] };
        for alpha in [0.1, 0.5, 1.0] {
            let finish = Finish::new(&Brdf::Ggx { alpha, fresnel });
            let view = Vec3::new(0.6, 0.0, 0.8);
            let (rings, spokes) = (600, 180);
            let mut albedo = 0.0_f64;
            for i in 0..rings {
                let z = (i as f32 + 0.5) / rings as f32;
                for j in 0..spokes {
                    let (sin, cos) =
                        (core::f32::consts::TAU * (j as f32 + 0.5) / spokes as f32).sin_cos();
                    let r = (1.0 - z * z).sqrt();
                    let pair = Pair::new(view, Vec3::new(r * cos, r * sin, z));
                    let f_cos = finish.shared(&pair).x * finish.lobe_cos(Vec3::Z, &pair);
                    albedo +=
                        f64::from(f_cos) * 2.0 * core::f64::consts::PI / f64::from(rings * spokes);
                }
            }
            assert!(albedo < 1.001, "alpha {alpha}: {albedo}");
            assert!(alpha > 0.2 || albedo > 0.98, "alpha {alpha}: {albedo}");
        }
    }
}

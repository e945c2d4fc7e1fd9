//! Base BRDFs: what the finish of one zone does to light. They know nothing of scratches.
//!
//! Directions point away from the surface. All values are linear RGB. A zone's base BRDF sees directions in the frame
//! (across, along, up) of its scratch, and the zone's normal lies in the plane of the first and the last. The flat surface is
//! a zone like any other, of a scratch that runs along the local frame's x (dP/du): so do its polishing lines.

mod beckmann;
mod facet;
mod finish;
mod fresnel;
mod ggx;
mod hosted;
mod lambert;
mod metal;
mod oren_nayar;
mod pair;
mod phong;
mod threads;

pub use facet::Facet;
pub use finish::Lobe;
pub(crate) use finish::{Facets, Finish, is_finite};
pub use fresnel::Fresnel;
pub use hosted::{HostBrdf, Hosted};
pub use metal::Metal;
pub(crate) use pair::{Local, Pair, Pairs, turned_each};
#[cfg(feature = "files")]
pub(crate) use threads::Directions;

use crate::error::{Result, in_range, rgb_in_range};
use glam::Vec2;

/// The flat surface's axis across its polishing lines, which run along the local frame's x.
pub(crate) const ACROSS_SURFACE: Vec2 = Vec2::NEG_Y;

/// A base BRDF.
///
/// Microfacets (GGX, Cook-Torrance) take a Fresnel reflectance: it is that of each one of them. The others take a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brdf {
    /// Perfectly diffuse.
    Lambert {
        /// Albedo per channel, 0 to 1.
        albedo: [f32; 3],
    },
    /// Rough and diffuse: Oren and Nayar's facets in Fujii's form (2013), which never gains light.
    OrenNayar {
        /// Albedo per channel, 0 to 1.
        albedo: [f32; 3],
        /// 0 (Lambert) to 1 (as rough as can be), without a unit. Facets whose slopes deviate by sigma radians in the model
        /// of 1994 look like 0.25 for sigma 0.3, 0.42 for 0.5 and 0.66 for 1.
        roughness: f32,
    },
    /// Phong's lobe about the mirrored view, normalised (Lafortune and Willems 1994): reflects all of its colour at normal
    /// incidence, less at an angle.
    Phong {
        /// Colour per channel, 0 to 1.
        specular: [f32; 3],
        /// Of the lobe's cosine, 1 (wide) to 100000 (sharp).
        exponent: f32,
    },
    /// Microfacets by Cook and Torrance (1982): Beckmann's distribution of slopes, masked as V-grooves.
    CookTorrance {
        /// Width of the distribution of slopes, 0.001 to 1: the square root of 2 times their deviation along any line.
        alpha: f32,
        /// Reflectance of a microfacet.
        fresnel: Fresnel,
    },
    /// GGX microfacets with height-correlated Smith masking (Heitz 2014).
    Ggx {
        /// Width of the distribution of slopes, 0.001 to 1.
        alpha: f32,
        /// Reflectance of a microfacet.
        fresnel: Fresnel,
    },
    /// GGX of polishing lines, which run along the scratch, or on the flat surface along dP/du.
    AnisotropicGgx {
        /// Width of the distribution of slopes across the lines, 0.001 to 1.
        alpha_across: f32,
        /// Width along the lines, 0.001 to 1: the smaller one of the two where they are fine and straight.
        alpha_along: f32,
        /// Reflectance of a microfacet.
        fresnel: Fresnel,
    },
    /// The host's own.
    Hosted(Hosted),
}

impl Brdf {
    /// Polished metal: GGX of width `alpha` (0.001 to 1) and the metal's own Fresnel reflectance.
    pub fn metal(metal: Metal, alpha: f32) -> Self {
        Self::Ggx {
            alpha,
            fresnel: Fresnel::metal(metal),
        }
    }

    /// Itself, if every value lies in its range.
    pub(crate) fn check(self) -> Result<Self> {
        match self {
            Self::Lambert { albedo } => {
                rgb_in_range("albedo", albedo, 0.0, 1.0)?;
            }
            Self::OrenNayar { albedo, roughness } => {
                rgb_in_range("albedo", albedo, 0.0, 1.0)?;
                in_range("roughness", f64::from(roughness), 0.0, 1.0)?;
            }
            Self::Phong { specular, exponent } => {
                rgb_in_range("specular", specular, 0.0, 1.0)?;
                in_range("exponent", f64::from(exponent), 1.0, 100_000.0)?;
            }
            Self::CookTorrance { alpha, fresnel } | Self::Ggx { alpha, fresnel } => {
                width_in_range("alpha", alpha)?;
                fresnel.check()?;
            }
            Self::AnisotropicGgx {
                alpha_across,
                alpha_along,
                fresnel,
            } => {
                width_in_range("alpha_across", alpha_across)?;
                width_in_range("alpha_along", alpha_along)?;
                fresnel.check()?;
            }
            // Was checked when it was made.
            Self::Hosted(_) => {}
        }
        Ok(self)
    }

    /// How much the normal may step from facet to facet of a curved groove before its highlights would
    /// show as separate lines, radians.
    ///
    /// GGX lobes whose slopes are a width alpha apart add up to within 3 %, at three quarters to within 0.5 %.
    /// Gaussian ones (Beckmann's, and Phong's nearly) do that up to 1.1 widths apart.
    pub(crate) fn facet_step_rad(self) -> f64 {
        let (widths, alpha) = match self {
            Self::Lambert { .. } | Self::OrenNayar { .. } => return MOST_STEP_RAD,
            Self::Phong { exponent, .. } => (1.1, phong::alpha(exponent)),
            Self::CookTorrance { alpha, .. } => (1.1, alpha),
            Self::Ggx { alpha, .. } => (0.75, alpha),
            // What turns is the normal across the scratch.
            Self::AnisotropicGgx { alpha_across, .. } => (0.75, alpha_across),
            Self::Hosted(host) if host.is_diffuse => return MOST_STEP_RAD,
            Self::Hosted(host) => (0.75, host.alphas[0]),
        };
        (widths * f64::from(alpha)).clamp(LEAST_STEP_RAD, MOST_STEP_RAD)
    }
}

/// Diffuse grooves look round from this step on.
const MOST_STEP_RAD: f64 = 0.2;

/// What a cross-section's most facets can still follow.
const LEAST_STEP_RAD: f64 = 0.03;

fn width_in_range(argument: &'static str, alpha: f32) -> Result<f64> {
    in_range(argument, f64::from(alpha), 0.001, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Facets a step apart add up to one highlight: seen and lit from above, it is even to within 1 %.
    #[test]
    fn facet_steps_show_no_lines() {
        let fresnel = Fresnel::Schlick { f0: [1.0; 3] };
        let alpha = 0.08;
        let pair = Pair::new(Vec3::Z, Vec3::Z);
        for brdf in [
            Brdf::Ggx { alpha, fresnel },
            Brdf::AnisotropicGgx {
                alpha_across: alpha,
                alpha_along: 0.01,
                fresnel,
            },
            Brdf::CookTorrance { alpha, fresnel },
            Brdf::Phong {
                specular: [1.0; 3],
                exponent: 80.0,
            },
        ] {
            let (finish, step) = (Finish::new(&brdf), crate::single(brdf.facet_step_rad()));
            let sum = |offset: f32| -> f32 {
                let facet = |k: i32| {
                    let (sin, cos) = ((k as f32 + offset) * step).sin_cos();
                    finish.lobe_cos(Vec3::new(sin, 0.0, cos), &pair)
                };
                (-15..=15).map(facet).sum()
            };
            let (on, between) = (sum(0.0), sum(0.5));
            let uneven = (on - between).abs() / on;
            assert!(uneven < 0.01, "{brdf:?}: {on} on, {between} between facets");
            // Much finer would be facets for nothing.
            assert!(step > 0.7 * alpha, "{brdf:?}: {step}");
        }
    }
}

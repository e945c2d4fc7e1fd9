//! GGX microfacets (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014).

use super::Local;
use crate::lanes::{Number, Vector};
use core::f32::consts::{FRAC_1_PI, TAU};
use glam::{Vec2, Vec3};

/// D G / (4 n·l n·v) · n·l of facets `alpha` wide across and along, for both cosines above 0.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(alpha: Vec2, pair: &Local<F>) -> F {
    let (light, view) = (&pair.light, &pair.view);
    let shown = light.z * smith(alpha, view) + view.z * smith(alpha, light);
    let spread = spread(alpha, &pair.half);
    // One division for all.
    light.z * (0.5 * FRAC_1_PI * alpha.x * alpha.y) / (spread * spread * shown)
}

/// The root of what divides alpha across times alpha along over pi in the density of microfacets whose normal is `half`:
/// sines and cosine each by themselves, so that nothing cancels near the highlight's centre.
#[inline(always)]
fn spread<F: Number>(alpha: Vec2, half: &Vector<F>) -> F {
    half.x * half.x * (alpha.y / alpha.x)
        + half.y * half.y * (alpha.x / alpha.y)
        + half.z * half.z * (alpha.x * alpha.y)
}

/// Its excess over the cosine is what masking takes.
#[inline(always)]
fn smith<F: Number>(alpha: Vec2, w: &Vector<F>) -> F {
    let (x, y) = (w.x * alpha.x, w.y * alpha.y);
    (x * x + y * y + w.z * w.z).sqrt()
}

/// A microfacet's normal, as often as the view sees it (Dupuy and Benyoub 2023, "Sampling visible GGX normals with
/// spherical caps").
pub(super) fn sample(alpha: Vec2, u: [f32; 2], view: Vec3) -> Vec3 {
    let stretch = alpha.extend(1.0);
    let view = (view * stretch).normalize_or_zero();
    // Near the cap's pole the sine has no digits left in 1 - z².
    let below_pole = u[1] * (1.0 + view.z);
    let z = 1.0 - below_pole;
    let sin = (below_pole * (2.0 - below_pole)).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = (TAU * u[0]).sin_cos();
    let cap = Vec3::new(sin * cos_azimuth, sin * sin_azimuth, z);
    ((cap + view) * stretch).normalize_or_zero()
}

/// The density of [`sample`] mirrored to lights, per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(alpha: Vec2, pair: &Local<F>) -> F {
    let shown = pair.view.z + smith(alpha, &pair.view);
    let spread = spread(alpha, &pair.half);
    shown.like(0.5 * FRAC_1_PI * alpha.x * alpha.y) / (spread * spread * shown)
}

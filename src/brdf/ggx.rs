//! GGX microfacets (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014).

use super::Local;
use crate::lanes::{Number, Vector};
use core::f32::consts::{PI, TAU};
use glam::{Vec2, Vec3};

/// D G / (4 n·l n·v) · n·l of facets `alpha` wide across and along, for both cosines above 0.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(alpha: Vec2, pair: &Local<F>) -> F {
    let (light, view) = (&pair.light, &pair.view);
    let visibility =
        light.z.like(0.5) / (light.z * smith(alpha, view) + view.z * smith(alpha, light));
    distribution(alpha, &pair.half) * light.z * visibility
}

/// The density of microfacets whose normal is `half`: sines and cosine each by themselves, so that nothing cancels near the
/// highlight's centre.
#[inline(always)]
fn distribution<F: Number>(alpha: Vec2, half: &Vector<F>) -> F {
    let (x, y) = (half.x * (1.0 / alpha.x), half.y * (1.0 / alpha.y));
    let denominator = x * x + y * y + half.z * half.z;
    denominator.like(1.0 / (PI * alpha.x * alpha.y)) / (denominator * denominator)
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
    distribution(alpha, &pair.half) * 0.5 / (pair.view.z + smith(alpha, &pair.view))
}

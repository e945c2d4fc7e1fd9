//! GGX microfacets (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014).

use super::Pair;
use core::f32::consts::{PI, TAU};
use glam::{Vec2, Vec3};

/// D G / (4 n·l n·v) · n·l of facets as rough along as across, for both cosines above 0.
pub(super) fn lobe_cos(alpha: f32, normal: Vec3, half: Vec3, n_l: f32, n_v: f32) -> f32 {
    distribution(alpha, normal, half) * n_l * visibility(alpha, n_l, n_v)
}

/// The density of microfacets whose normal is `half`.
///
/// cos² (a² - 1) + 1 is written sin² + a² cos², the sine from a cross product: no cancellation near the
/// highlight's centre.
fn distribution(alpha: f32, normal: Vec3, half: Vec3) -> f32 {
    let a2 = alpha * alpha;
    let cos = normal.dot(half);
    let denominator = normal.cross(half).length_squared() + a2 * cos * cos;
    a2 / (PI * denominator * denominator)
}

/// G / (4 n·l n·v), height-correlated.
fn visibility(alpha: f32, n_l: f32, n_v: f32) -> f32 {
    let a2 = alpha * alpha;
    let smith = |cos: f32| (a2 + (1.0 - a2) * cos * cos).sqrt();
    0.5 / (n_l * smith(n_v) + n_v * smith(n_l))
}

/// The same as [`lobe_cos`], of facets `alpha` wide across and along; the pair in the zone's own frame.
pub(super) fn anisotropic_lobe_cos(alpha: Vec2, pair: &Pair) -> f32 {
    let (n_l, n_v) = (pair.light.z, pair.view.z);
    let smith = |w: Vec3| (w * alpha.extend(1.0)).length();
    let visibility = 0.5 / (n_l * smith(pair.view) + n_v * smith(pair.light));
    anisotropic_distribution(alpha, pair.half) * n_l * visibility
}

fn anisotropic_distribution(alpha: Vec2, half: Vec3) -> f32 {
    let denominator = (half / alpha.extend(1.0)).length_squared();
    1.0 / (PI * alpha.x * alpha.y * denominator * denominator)
}

/// A microfacet's normal, as often as the view sees it (Dupuy and Benyoub 2023, "Sampling visible GGX normals with
/// spherical caps").
pub(super) fn sample(alpha: Vec2, u: [f32; 2], view: Vec3) -> Vec3 {
    let stretch = alpha.extend(1.0);
    let view = (view * stretch).normalize_or_zero();
    let z = (1.0 - u[1]) * (1.0 + view.z) - view.z;
    let sin = (1.0 - z * z).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = (TAU * u[0]).sin_cos();
    let cap = Vec3::new(sin * cos_azimuth, sin * sin_azimuth, z);
    ((cap + view) * stretch).normalize_or_zero()
}

/// The density of [`sample`] mirrored to lights, per steradian.
pub(super) fn pdf(alpha: Vec2, pair: &Pair) -> f32 {
    let smith = (pair.view * alpha.extend(1.0)).length();
    0.5 * anisotropic_distribution(alpha, pair.half) / (pair.view.z + smith)
}

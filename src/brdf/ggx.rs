//! GGX microfacets (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014).

use core::f32::consts::PI;
use glam::Vec3;

/// D G / (4 n·l n·v) · n·l, for both cosines above 0.
pub(crate) fn lobe_cos(alpha: f32, normal: Vec3, half: Vec3, n_l: f32, n_v: f32) -> f32 {
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

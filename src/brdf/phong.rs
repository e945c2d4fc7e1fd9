//! Phong's lobe about the mirrored view, normalised (Lafortune and Willems 1994, "Using the modified Phong
//! reflectance model for physically based rendering"): (n + 2) / 2 pi, so that white reflects all light at normal incidence
//! and never more. At an angle it reflects less, a sharp one about its cosine: the model's own.

use super::Local;
use crate::lanes::Number;
use core::f32::consts::TAU;
use glam::Vec3;

/// What makes the lobe of a white surface reflect all light at normal incidence.
pub(super) fn scale(exponent: f32) -> f32 {
    (exponent + 2.0) / TAU
}

/// The Beckmann width whose highlight at normal incidence is as wide: half vectors turn half as far as mirrored views.
pub(super) fn alpha(exponent: f32) -> f32 {
    1.0 / (2.0 * exponent + 1.0).sqrt()
}

/// The other way round.
pub(super) fn exponent(alpha: f32) -> f32 {
    0.5 * (1.0 / (alpha * alpha) - 1.0)
}

/// The cosine between mirrored view and light to the power of `exponent`.
#[inline(always)]
fn power<F: Number>(exponent: f32, pair: &Local<F>) -> F {
    // 1 - cos from the two directions' distance: exact where sharp lobes need it.
    let (x, y) = (pair.view.x + pair.light.x, pair.view.y + pair.light.y);
    let z = pair.view.z - pair.light.z;
    let one_minus_cos = (x * x + y * y + z * z) * 0.5;
    one_minus_cos.each(|_, less| match less {
        less if less < 1.0 => (exponent * (-less).ln_1p()).exp(),
        _ => 0.0,
    })
}

/// The lobe times n · light.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(exponent: f32, pair: &Local<F>) -> F {
    power(exponent, pair) * pair.light.z
}

/// A light by the lobe; it may lie below the zone.
pub(super) fn sample(exponent: f32, u: [f32; 2], view: Vec3) -> Vec3 {
    let mirrored = Vec3::new(-view.x, -view.y, view.z);
    let (s, t) = mirrored.any_orthonormal_pair();
    let one_minus_cos = -((-u[1]).ln_1p() / (exponent + 1.0)).exp_m1();
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = (TAU * u[0]).sin_cos();
    let light = mirrored * (1.0 - one_minus_cos) + (s * cos_azimuth + t * sin_azimuth) * sin;
    light.normalize_or_zero()
}

/// The density of [`sample`], per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(exponent: f32, pair: &Local<F>) -> F {
    power(exponent, pair) * ((exponent + 1.0) / TAU)
}

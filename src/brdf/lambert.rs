//! Perfectly diffuse reflection, and the sampling that all diffuse base BRDFs share: by the cosine.

use crate::lanes::Number;
use core::f32::consts::{FRAC_1_PI, TAU};
use glam::Vec3;

/// A light in a zone's own frame, as often as its cosine is large (Malley's method).
pub(super) fn sample(u: [f32; 2]) -> Vec3 {
    let (sin_azimuth, cos_azimuth) = (TAU * u[0]).sin_cos();
    let radius = u[1].sqrt();
    Vec3::new(
        radius * cos_azimuth,
        radius * sin_azimuth,
        (1.0 - u[1]).sqrt(),
    )
}

/// The density of [`sample`] at a light of this cosine, per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(n_l: F) -> F {
    n_l * FRAC_1_PI
}

//! Cook and Torrance's microfacets (1982, "A reflectance model for computer graphics"): Beckmann's distribution of
//! slopes, shadowed and masked as V-grooves; over 4 (n·l) (n·v), the factor that keeps energy (theirs was pi).
//!
//! V-grooves are one of the two models of masking that are exact (Heitz 2014, "Understanding the masking-shadowing
//! function"): no light is gained, and visible normals are sampled exactly.

use super::Local;
use crate::lanes::Number;
use core::f32::consts::PI;
use glam::{Vec2, Vec3};

/// Half vectors lower than this are no microfacets': their density is below 1e-38 at any width.
const LEAST_HALF_COS: f32 = 0.08;

/// The density of microfacets whose normal is the half vector.
#[inline(always)]
fn distribution<F: Number>(alpha: f32, pair: &Local<F>) -> F {
    let half = &pair.half;
    let a2 = alpha * alpha;
    let cos2 = half.z * half.z;
    let tan2 = (half.x * half.x + half.y * half.y) / cos2;
    let density = (tan2 / -a2).each(|_, power| power.exp()) / (cos2 * cos2 * (PI * a2));
    half.z
        .if_above(half.z.like(LEAST_HALF_COS), density, half.z.like(0.0))
}

/// The share of microfacets like the half vector that is not masked, over the cosine of the direction.
#[inline(always)]
fn seen_over_cos<F: Number>(pair: &Local<F>, cos: F) -> F {
    (cos.like(1.0) / cos).min(pair.half.z * 2.0 / pair.view_half)
}

/// D G / (4 n·l n·v) · n·l, for both cosines above 0.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(alpha: f32, pair: &Local<F>) -> F {
    let lower = pair.light.z.min(pair.view.z);
    // What the lower direction does not see is the only part lost: both are masked by the same walls.
    let seen = lower * seen_over_cos(pair, lower);
    distribution(alpha, pair) * seen * 0.25 / pair.view.z
}

/// The density of [`sample`] mirrored to lights, per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(alpha: f32, pair: &Local<F>) -> F {
    distribution(alpha, pair) * seen_over_cos(pair, pair.view.z) * 0.25
}

/// A microfacet's normal, as often as the view sees it.
pub(super) fn sample(alpha: f32, u: [f32; 2], view: Vec3) -> Vec3 {
    let tan = alpha * (-(-u[1]).ln_1p()).max(0.0).sqrt();
    let view_sin = view.truncate().length();
    let to_view = view.truncate().normalize_or(Vec2::X);
    let azimuth = visible_azimuth(tan * view_sin / view.z, u[0]);
    let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
    let slope = Vec2::new(cos_azimuth, sin_azimuth).rotate(to_view) * tan;
    slope.extend(1.0).normalize()
}

/// The azimuth, relative to the view, of a microfacet whose slope times the view's tangent is `slope`: its density is
/// 1 + slope cos(azimuth), 2 at most and 0 at least.
fn visible_azimuth(slope: f32, u: f32) -> f32 {
    let wanted = PI * (2.0 * u - 1.0).abs();
    let full = if slope > 1.0 {
        (1.0 / slope).acos()
    } else {
        0.0
    };
    let azimuth = if wanted <= 2.0 * full {
        0.5 * wanted
    } else {
        kepler(slope, wanted, [full, PI - full])
    };
    if u < 0.5 { -azimuth } else { azimuth }
}

/// Solves x + slope sin x = `wanted` plus what both sides are at the lower bound: Newton's method, halving where it leaves
/// the bounds.
fn kepler(slope: f32, wanted: f32, [mut low, mut high]: [f32; 2]) -> f32 {
    let offset = low - slope * low.sin();
    let mut x = wanted.max(low).min(high);
    for _ in 0..24 {
        let excess = x + slope * x.sin() + offset - wanted;
        if excess > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let next = x - excess / (1.0 + slope * x.cos());
        let next = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
        if (next - x).abs() < 1e-6 {
            return next;
        }
        x = next;
    }
    x
}

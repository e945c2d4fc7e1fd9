//! Cook and Torrance's microfacets (1982, "A reflectance model for computer graphics"): Beckmann's distribution of
//! slopes, shadowed and masked as V-grooves; over 4 (n·l) (n·v), the factor that keeps energy (theirs was pi).
//!
//! V-grooves are one of the two models of masking that are exact (Heitz 2014, "Understanding the masking-shadowing
//! function"): no light is gained, and visible normals are sampled exactly.

use super::Pair;
use core::f32::consts::PI;
use glam::{Vec2, Vec3};

/// Half vectors lower than this are no microfacets': their density is below 1e-38 at any width.
const LEAST_HALF_COS: f32 = 0.08;

/// The density of microfacets whose normal is `half`, in the zone's own frame.
fn distribution(alpha: f32, half: Vec3) -> f32 {
    let cos2 = half.z * half.z;
    if half.z < LEAST_HALF_COS {
        return 0.0;
    }
    let a2 = alpha * alpha;
    let tan2 = (half.x * half.x + half.y * half.y) / cos2;
    (-tan2 / a2).exp() / (PI * a2 * cos2 * cos2)
}

/// The share of microfacets like `half` that is not masked, over the cosine of the direction.
fn seen_over_cos(half: Vec3, cos: f32, view_half: f32) -> f32 {
    (1.0 / cos).min(2.0 * half.z / view_half)
}

/// D G / (4 n·l n·v) · n·l, for both cosines above 0; the pair in the zone's own frame.
pub(super) fn lobe_cos(alpha: f32, pair: &Pair) -> f32 {
    let lower = pair.light.z.min(pair.view.z);
    // What the lower direction does not see is the only part lost: both are masked by the same walls.
    let seen = lower * seen_over_cos(pair.half, lower, pair.view_half);
    0.25 * distribution(alpha, pair.half) * seen / pair.view.z
}

/// The density of [`sample`] mirrored to lights, per steradian.
pub(super) fn pdf(alpha: f32, pair: &Pair) -> f32 {
    let seen = seen_over_cos(pair.half, pair.view.z, pair.view_half);
    0.25 * distribution(alpha, pair.half) * seen
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

//! Rough diffuse surfaces: Oren and Nayar's facets in Fujii's form ("A tiny improvement of Oren-Nayar reflectance
//! model", 2013; the FON of Portsmouth, Kutz and Hill, "EON", JCGT 14, 2025).
//!
//! Of the forms in use it is the one that is a colour times a single lobe, reciprocal, without the dark ring of the
//! qualitative model of 1994, and proven never to gain: it reflects all of its albedo at grazing incidence and a
//! little less elsewhere. What facets reflect to each other is left out, as it is of microfacets: a white
//! surface of full roughness keeps 78 % at normal incidence, 83 % on average. (EON gives that back, in a second colour.)

use super::{Local, lambert};
use crate::lanes::Number;
use core::f32::consts::{FRAC_1_PI, PI, TAU};
use glam::Vec3;

/// pi/2 - 2/3: what rough facets add at grazing incidence, times pi and over the roughness.
const GRAZING: f32 = 0.5 * PI - 2.0 / 3.0;

/// The lobe's weight, so that a white surface reflects all light at grazing incidence: A of the model.
fn scale(roughness: f32) -> f32 {
    1.0 / (1.0 + roughness * GRAZING * FRAC_1_PI)
}

/// pi f / albedo, times n · light, both directions above the zone.
#[inline(always)]
pub(super) fn lobe_cos<F: Number>(roughness: f32, pair: &Local<F>) -> F {
    let (n_l, n_v) = (pair.light.z, pair.view.z);
    let zero = n_l.like(0.0);
    let beside = pair.light.dot(pair.view) - n_l * n_v;
    let away = beside.if_above(zero, beside / n_l.max(n_v), beside);
    ((away * roughness + 1.0) * scale(roughness)).max(zero) * n_l
}

/// The share of samples that are spread evenly over all lights: at grazing angles the lobe rises to 1 over the cosine, and
/// by the cosine alone few samples would count for much.
fn even_share<F: Number>(roughness: f32, x: F, y: F) -> F {
    (x * x + y * y).sqrt() * roughness
}

/// A light, by the cosine or evenly.
pub(super) fn sample(roughness: f32, [u, v]: [f32; 2], view: Vec3) -> Vec3 {
    let even = even_share(roughness, view.x, view.y);
    if u >= even {
        return lambert::sample([(u - even) / (1.0 - even), v]);
    }
    let (sin_azimuth, cos_azimuth) = (TAU * u / even).sin_cos();
    let radius = (1.0 - v * v).sqrt();
    Vec3::new(radius * cos_azimuth, radius * sin_azimuth, v)
}

/// The density of [`sample`], per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(roughness: f32, pair: &Local<F>) -> F {
    let even = even_share(roughness, pair.view.x, pair.view.y);
    (-even + 1.0) * lambert::pdf(pair.light.z) + even / TAU
}

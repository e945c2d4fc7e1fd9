//! GGX microfacets (Walter et al. 2007) with height-correlated Smith masking (Heitz 2014).

use super::Local;
use super::finish::{LEAST_COS, if_above};
use crate::lanes::{Lanes, Number, Vector};
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

/// The same lobe and density, but for `scale`, for many facets of one finish and directions in the frames of scratches.
/// What turns those into the facets' own frames keeps y and x² + z²: so that both roots and the distribution's
/// denominator are a number that all facets share and a multiple of one square.
pub(super) struct Tilting<F> {
    view: Vector<F>,
    light: Vector<F>,
    half: Vector<F>,
    /// What facets share.
    of_view: F,
    of_light: F,
    of_half: F,
    /// How often the cosine's square comes to that under a root, and the sine's square in the denominator.
    by_cos: F,
    by_sin: F,
    /// What all values are still to be multiplied by.
    pub scale: f32,
}

impl<F: Number> Tilting<F> {
    #[inline(always)]
    pub(super) fn new(alpha: Vec2, pair: &Local<F>) -> Self {
        let (squares, like) = (alpha * alpha, pair.view_half);
        let over = 1.0 / squares;
        Self {
            view: pair.view,
            light: pair.light,
            half: pair.half,
            of_view: across_and_along(&pair.view, squares.x, squares.y),
            of_light: across_and_along(&pair.light, squares.x, squares.y),
            of_half: across_and_along(&pair.half, 1.0, over.y),
            by_cos: like.like(1.0 - squares.x),
            by_sin: like.like(over.x - 1.0),
            scale: 0.5 * FRAC_1_PI / (alpha.x * alpha.y),
        }
    }

    /// [`lobe_cos`] of a facet of this normal; of one that a direction is below, as if it were barely above: finite.
    #[inline(always)]
    pub(super) fn lobe_cos(&self, normal: [F; 2]) -> F {
        let (view, light) = (above(&self.view, normal), above(&self.light, normal));
        let (seen, lit) = (
            self.smith(view, self.of_view),
            self.smith(light, self.of_light),
        );
        let masking = light.times_plus(seen, view * lit);
        light / (self.spread(normal) * masking)
    }

    /// [`pdf`] of a facet of this normal, 0 where the half vector is below it; the view as for lobes.
    #[inline(always)]
    pub(super) fn pdf(&self, normal: [F; 2]) -> F {
        let view = above(&self.view, normal);
        let seen = view + self.smith(view, self.of_view);
        let density = view.like(1.0) / (self.spread(normal) * seen);
        if_above(cos(&self.half, normal), density)
    }

    #[inline(always)]
    fn smith(&self, cos: F, shared: F) -> F {
        (cos * cos).times_plus(self.by_cos, shared).sqrt()
    }

    /// What the distribution of slopes is divided by at the half vector.
    #[inline(always)]
    fn spread(&self, [x, z]: [F; 2]) -> F {
        let sin = self.half.x.times_plus(z, -(self.half.z * x));
        let denominator = (sin * sin).times_plus(self.by_sin, self.of_half);
        denominator * denominator
    }
}

impl Tilting<f32> {
    /// The same for facets side by side.
    #[inline(always)]
    pub(super) fn all<L: Lanes>(&self, lanes: L) -> Tilting<L::F> {
        Tilting {
            view: self.view.all(lanes),
            light: self.light.all(lanes),
            half: self.half.all(lanes),
            of_view: lanes.all(self.of_view),
            of_light: lanes.all(self.of_light),
            of_half: lanes.all(self.of_half),
            by_cos: lanes.all(self.by_cos),
            by_sin: lanes.all(self.by_sin),
            scale: self.scale,
        }
    }
}

#[inline(always)]
fn across_and_along<F: Number>(w: &Vector<F>, across: f32, along: f32) -> F {
    (w.x * w.x + w.z * w.z) * across + w.y * w.y * along
}

/// The cosine between a direction and a normal (x, 0, z).
#[inline(always)]
fn cos<F: Number>(w: &Vector<F>, [x, z]: [F; 2]) -> F {
    w.x.times_plus(x, w.z * z)
}

#[inline(always)]
fn above<F: Number>(w: &Vector<F>, normal: [F; 2]) -> F {
    cos(w, normal).max(w.x.like(LEAST_COS))
}

/// A microfacet's normal, of any length, as often as the view sees it (Dupuy and Benyoub 2023, "Sampling visible GGX
/// normals with spherical caps").
#[inline(always)]
pub(super) fn sample(alpha: Vec2, u: [f32; 2], view: Vec3) -> Vec3 {
    let stretch = alpha.extend(1.0);
    let view = (view * stretch).normalize();
    // Near the cap's pole the sine has no digits left in 1 - z².
    let below_pole = u[1] * (1.0 + view.z);
    let z = 1.0 - below_pole;
    let sin = (below_pole * (2.0 - below_pole)).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = (TAU * u[0]).sin_cos();
    let cap = Vec3::new(sin * cos_azimuth, sin * sin_azimuth, z);
    (cap + view) * stretch
}

/// The density of [`sample`] mirrored to lights, per steradian.
#[inline(always)]
pub(super) fn pdf<F: Number>(alpha: Vec2, pair: &Local<F>) -> F {
    let shown = pair.view.z + smith(alpha, &pair.view);
    let spread = spread(alpha, &pair.half);
    shown.like(0.5 * FRAC_1_PI * alpha.x * alpha.y) / (spread * spread * shown)
}

//! A base BRDF made ready for evaluation: plain numbers, valid whatever their bits, so that a shading point
//! may live in a caller's uninitialised memory.

use super::{Brdf, Fresnel, Pair, ggx};
use core::f32::consts::FRAC_1_PI;
use glam::Vec3;

const LAMBERT: u32 = 0;
const GGX_SCHLICK: u32 = 1;
const GGX_CONDUCTOR: u32 = 2;

/// A base BRDF, evaluated as `shared(pair) * lobe_cos(normal, pair)`: the first factor is the same for all
/// zones of a finish, the second depends on the zone's normal.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Finish {
    kind: u32,
    alpha: f32,
    /// Lambert: albedo / pi; Schlick: f0; conductor: eta.
    first: [f32; 3],
    /// Conductor: k.
    second: [f32; 3],
}

impl Default for Finish {
    fn default() -> Self {
        Self::BLACK
    }
}

impl Finish {
    /// How wide its lobe is: the slope of its microfacets, 1 if it has none.
    pub(crate) fn alpha(&self) -> f32 {
        self.alpha
    }

    pub(crate) const BLACK: Self = Self {
        kind: LAMBERT,
        alpha: 1.0,
        first: [0.0; 3],
        second: [0.0; 3],
    };

    pub(crate) fn new(brdf: &Brdf) -> Self {
        match *brdf {
            Brdf::Lambert { albedo } => Self {
                first: albedo.map(|channel| channel * FRAC_1_PI),
                ..Self::BLACK
            },
            Brdf::Ggx {
                alpha,
                fresnel: Fresnel::Schlick { f0 },
            } => Self {
                kind: GGX_SCHLICK,
                alpha,
                first: f0,
                second: [0.0; 3],
            },
            Brdf::Ggx {
                alpha,
                fresnel: Fresnel::Conductor { eta, k },
            } => Self {
                kind: GGX_CONDUCTOR,
                alpha,
                first: eta,
                second: k,
            },
        }
    }

    /// What all zones of this finish share for a pair of directions.
    pub(crate) fn shared(&self, pair: &Pair) -> Vec3 {
        let (first, second) = (self.first, self.second);
        match self.kind {
            GGX_SCHLICK => Fresnel::Schlick { f0: first }.reflectance(pair.view_half),
            GGX_CONDUCTOR => Fresnel::Conductor {
                eta: first,
                k: second,
            }
            .reflectance(pair.view_half),
            _ => Vec3::from(first),
        }
    }

    /// The part that depends on the zone's normal, times n · light; 0 unless both directions are above it.
    pub(crate) fn lobe_cos(&self, normal: Vec3, pair: &Pair) -> f32 {
        let n_l = normal.dot(pair.light);
        let n_v = normal.dot(pair.view);
        if n_l <= 0.0 || n_v <= 0.0 {
            return 0.0;
        }
        match self.kind {
            LAMBERT => n_l,
            _ => ggx::lobe_cos(self.alpha, normal, pair.half, n_l, n_v),
        }
    }
}

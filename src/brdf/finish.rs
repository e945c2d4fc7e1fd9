//! A base BRDF made ready for evaluation: plain numbers, valid whatever their bits, so that a shading point
//! may live in a caller's uninitialised memory.

mod abreast;

pub(crate) use abreast::Facets;

use super::{
    Brdf, Fresnel, Hosted, Local, Pair, beckmann, ggx, hosted, lambert, oren_nayar, phong, threads,
};
use crate::lanes::{Lanes, Number, One};
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3};

/// Lobes: what depends on the zone's normal.
const LAMBERT: u32 = 0;
const GGX: u32 = 1;
const ANISOTROPIC_GGX: u32 = 2;
const BECKMANN: u32 = 3;
const OREN_NAYAR: u32 = 4;
const PHONG: u32 = 5;
/// The host's own, by its number: diffuse or not.
const HOSTED_DIFFUSE: u32 = 6;
const HOSTED_GLOSSY: u32 = 7;
/// Of several threads the one that shines most: the earlier systems' own.
const THREADS: u32 = 8;

/// Colours: what does not.
const PLAIN: u32 = 0;
const SCHLICK: u32 = 1;
const CONDUCTOR: u32 = 2;

/// Directions are above a zone from this cosine on: products of two with a lobe's width stay far from underflow.
pub(super) const LEAST_COS: f32 = 1e-12;

/// Samples that an estimate of reflectance takes: a power of two.
const REFLECTANCE_SAMPLES: u32 = 64;

/// Lobes are sharp below this width.
const SHARP_ALPHA: f32 = 0.02;

/// How far a base BRDF spreads light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lobe {
    /// Everywhere: Lambert, Oren-Nayar.
    Diffuse,
    /// About the mirrored view: Phong and microfacets.
    Glossy,
    /// The same, less than alpha 0.02 wide, so that it may be treated like a mirror; never infinitely sharp.
    Sharp,
}

/// A base BRDF, evaluated as `shared(pair) * lobe_cos(normal, pair)`: the first factor is the same for all
/// zones of a finish, the second depends on the zone's normal. The host's own have no such factors, a lobe of 0, and
/// [`Self::hosted_cos`]. All directions are in the frame (across, along, up).
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Finish {
    lobe: u32,
    /// How it is coloured. Of the host's own: its number.
    colour: u32,
    /// Width of the distribution of slopes across the scratch; of Phong's lobe the width that looks like it.
    alpha: f32,
    /// Of anisotropic GGX and the host's own: along the scratch. Of Oren-Nayar the roughness, of Phong and of threads the
    /// exponent.
    second: f32,
    /// Plain: what all lobes are multiplied by; Schlick: f0; conductor: eta.
    rgb: [f32; 3],
    /// Conductor: k. Threads: the set of their directions.
    k: [f32; 3],
}

impl Default for Finish {
    fn default() -> Self {
        Self::BLACK
    }
}

impl Finish {
    pub(crate) const BLACK: Self = Self {
        lobe: LAMBERT,
        colour: PLAIN,
        alpha: 1.0,
        second: 1.0,
        rgb: [0.0; 3],
        k: [0.0; 3],
    };

    pub(crate) fn new(brdf: &Brdf) -> Self {
        match *brdf {
            Brdf::Lambert { albedo } => Self {
                rgb: albedo.map(|channel| channel * FRAC_1_PI),
                ..Self::BLACK
            },
            Brdf::OrenNayar { albedo, roughness } => Self {
                lobe: OREN_NAYAR,
                second: roughness,
                rgb: albedo.map(|channel| channel * FRAC_1_PI),
                ..Self::BLACK
            },
            Brdf::Phong { specular, exponent } => Self {
                lobe: PHONG,
                alpha: phong::alpha(exponent),
                second: exponent,
                rgb: specular.map(|channel| channel * phong::scale(exponent)),
                ..Self::BLACK
            },
            Brdf::CookTorrance { alpha, fresnel } => Self::of_microfacets(BECKMANN, alpha, fresnel),
            Brdf::Ggx { alpha, fresnel } => Self::of_microfacets(GGX, alpha, fresnel),
            Brdf::AnisotropicGgx {
                alpha_across,
                alpha_along,
                fresnel,
            } => Self {
                second: alpha_along,
                ..Self::of_microfacets(ANISOTROPIC_GGX, alpha_across, fresnel)
            },
            Brdf::Hosted(host) => Self {
                lobe: if host.is_diffuse {
                    HOSTED_DIFFUSE
                } else {
                    HOSTED_GLOSSY
                },
                colour: host.number,
                alpha: host.alphas[0],
                second: host.alphas[1],
                ..Self::BLACK
            },
        }
    }

    /// The same finish with a lobe that is at least so wide.
    pub(crate) fn no_sharper_than(self, alpha: f32) -> Self {
        match self.lobe {
            PHONG if self.alpha < alpha => {
                let exponent = phong::exponent(alpha);
                let scale = phong::scale(exponent) / phong::scale(self.second);
                Self {
                    alpha,
                    second: exponent,
                    rgb: self.rgb.map(|channel| channel * scale),
                    ..self
                }
            }
            GGX | ANISOTROPIC_GGX | BECKMANN => Self {
                alpha: self.alpha.max(alpha),
                second: self.second.max(alpha),
                ..self
            },
            _ => self,
        }
    }

    /// The same finish; in the place of a host's own, which takes long to be asked, what reflects as much and spreads it as
    /// far: Lambert's or GGX.
    pub(crate) fn without_host(self, albedo: Vec3) -> Self {
        match self.lobe {
            HOSTED_DIFFUSE => Self::new(&Brdf::Lambert {
                albedo: albedo.to_array(),
            }),
            HOSTED_GLOSSY => Self {
                lobe: ANISOTROPIC_GGX,
                colour: PLAIN,
                rgb: albedo.to_array(),
                ..self
            },
            _ => self,
        }
    }

    /// The strongest of several threads' highlights, as bright as Phong's of this colour and exponent.
    #[cfg(feature = "files")]
    pub(crate) fn threads(
        specular: [f32; 3],
        exponent: f32,
        directions: &threads::Directions,
    ) -> Self {
        Self {
            lobe: THREADS,
            k: directions.numbers(),
            ..Self::new(&Brdf::Phong { specular, exponent })
        }
    }

    /// Which of the host's own base BRDFs it is.
    #[inline(always)]
    pub(crate) fn hosted(&self) -> Option<u32> {
        matches!(self.lobe, HOSTED_DIFFUSE | HOSTED_GLOSSY).then_some(self.colour)
    }

    /// The same finish, if it is the host's, by another number.
    pub(crate) fn renumbered(self, number: u32) -> Self {
        match self.hosted() {
            Some(_) => Self {
                colour: number,
                ..self
            },
            None => self,
        }
    }

    fn of_microfacets(lobe: u32, alpha: f32, fresnel: Fresnel) -> Self {
        let (colour, rgb, k) = match fresnel {
            Fresnel::Schlick { f0 } => (SCHLICK, f0, [0.0; 3]),
            Fresnel::Conductor { eta, k } => (CONDUCTOR, eta, k),
        };
        Self {
            lobe,
            colour,
            alpha,
            second: alpha,
            rgb,
            k,
        }
    }

    /// How narrow its lobe is where it is narrowest: the slope of its microfacets, 1 if it has none.
    pub(crate) fn alpha(&self) -> f32 {
        self.alphas().min_element()
    }

    /// BRDF times n · light, RGB; 0 unless both directions are above the zone.
    pub(crate) fn brdf_cos(&self, normal: Vec3, pair: &Pair) -> Vec3 {
        match self.hosted() {
            Some(_) => self.hosted_cos(normal, pair),
            None => self.shared(pair) * self.lobe_cos(normal, pair),
        }
    }

    /// The same over the density of [`Self::sample`]: what a light counts that was sampled.
    pub(crate) fn weight(&self, normal: Vec3, pair: &Pair) -> Vec3 {
        self.brdf_cos(normal, pair) / self.pdf(normal, pair)
    }

    /// The same as [`Self::brdf_cos`] if it is the host's own, else 0.
    pub(crate) fn hosted_cos(&self, normal: Vec3, pair: &Pair) -> Vec3 {
        let Some(number) = self.hosted() else {
            return Vec3::ZERO;
        };
        let pair = pair.tilted(normal.x, normal.z);
        if pair.light.z <= LEAST_COS || pair.view.z <= LEAST_COS {
            return Vec3::ZERO;
        }
        hosted::brdf_cos(number, &pair)
    }

    /// What all zones of this finish share for a pair of directions.
    #[inline(always)]
    pub(crate) fn shared(&self, pair: &Pair) -> Vec3 {
        Vec3::from(self.colour(pair.view_half))
    }

    /// The same by the cosine between view and half vector, per channel.
    #[inline(always)]
    pub(crate) fn colour<F: Number>(&self, view_half: F) -> [F; 3] {
        let (rgb, k) = (self.rgb, self.k);
        match self.colour {
            SCHLICK => Fresnel::Schlick { f0: rgb }.reflectance(view_half),
            CONDUCTOR => Fresnel::Conductor { eta: rgb, k }.reflectance(view_half),
            _ => [
                view_half.like(rgb[0]),
                view_half.like(rgb[1]),
                view_half.like(rgb[2]),
            ],
        }
    }

    /// The same of one angle, channels side by side.
    #[inline(always)]
    pub(crate) fn colour_in<L: Lanes>(&self, lanes: L, view_half: f32) -> [f32; 3] {
        let (rgb, k) = (self.rgb, self.k);
        match self.colour {
            SCHLICK => Fresnel::Schlick { f0: rgb }.reflectance_in(lanes, view_half),
            CONDUCTOR => Fresnel::Conductor { eta: rgb, k }.reflectance_in(lanes, view_half),
            _ => rgb,
        }
    }

    /// The part that depends on the zone's normal, times n · light; 0 unless both directions are above it.
    pub(crate) fn lobe_cos(&self, normal: Vec3, pair: &Pair) -> f32 {
        self.lobes_cos(One, &pair.tilted(normal.x, normal.z))
    }

    /// The same for a pair as zones see it.
    #[inline(always)]
    pub(crate) fn lobes_cos<L: Lanes>(&self, lanes: L, pair: &Local<L::F>) -> L::F {
        let lobe = match self.lobe {
            LAMBERT => pair.light.z,
            GGX | ANISOTROPIC_GGX => ggx::lobe_cos(self.alphas(), pair),
            _ => self.further_lobes_cos(lanes, pair),
        };
        let lobe = if_above(pair.view.z, lobe);
        if_above(pair.light.z, lobe)
    }

    /// Lobes that are used less: kept apart, so that the others stay short.
    #[inline(always)]
    fn further_lobes_cos<L: Lanes>(&self, lanes: L, pair: &Local<L::F>) -> L::F {
        lanes.call(
            #[inline(always)]
            || match self.lobe {
                BECKMANN => beckmann::lobe_cos(self.alpha, pair),
                OREN_NAYAR => oren_nayar::lobe_cos(self.second, pair),
                PHONG => phong::lobe_cos(self.second, pair),
                THREADS => threads::lobe_cos(self.second, self.k, pair),
                _ => lanes.all(0.0),
            },
        )
    }

    /// Widths of the distribution of slopes, across the scratch and along it; 1 if it is diffuse.
    #[inline(always)]
    pub(crate) fn alphas(&self) -> Vec2 {
        match self.lobe {
            ANISOTROPIC_GGX | HOSTED_DIFFUSE | HOSTED_GLOSSY => Vec2::new(self.alpha, self.second),
            _ => Vec2::splat(self.alpha),
        }
    }

    /// How far it spreads light.
    pub(crate) fn kind(&self) -> Lobe {
        match self.lobe {
            LAMBERT | OREN_NAYAR | HOSTED_DIFFUSE => Lobe::Diffuse,
            _ if self.alphas().max_element() < SHARP_ALPHA => Lobe::Sharp,
            _ => Lobe::Glossy,
        }
    }

    /// The base BRDF that it was made of, but for rounding; of threads, which are none, Phong's.
    pub(crate) fn brdf(&self) -> Brdf {
        let (rgb, k) = (self.rgb, self.k);
        let fresnel = match self.colour {
            CONDUCTOR => Fresnel::Conductor { eta: rgb, k },
            _ => Fresnel::Schlick { f0: rgb },
        };
        let over = |scale: f32| rgb.map(|channel| (channel / scale).clamp(0.0, 1.0));
        match self.lobe {
            GGX => Brdf::Ggx {
                alpha: self.alpha,
                fresnel,
            },
            ANISOTROPIC_GGX => Brdf::AnisotropicGgx {
                alpha_across: self.alpha,
                alpha_along: self.second,
                fresnel,
            },
            BECKMANN => Brdf::CookTorrance {
                alpha: self.alpha,
                fresnel,
            },
            OREN_NAYAR => Brdf::OrenNayar {
                albedo: over(FRAC_1_PI),
                roughness: self.second,
            },
            PHONG | THREADS => Brdf::Phong {
                specular: over(phong::scale(self.second)),
                exponent: self.second,
            },
            HOSTED_DIFFUSE | HOSTED_GLOSSY => Brdf::Hosted(Hosted {
                number: self.colour,
                is_diffuse: self.lobe == HOSTED_DIFFUSE,
                alphas: [self.alpha, self.second],
            }),
            _ => Brdf::Lambert {
                albedo: over(FRAC_1_PI),
            },
        }
    }

    /// A light for a zone, by two numbers from 0 to 1: microfacets as often as they are seen, Phong's lobe as often as it
    /// is bright, what is diffuse and threads by the cosine (rough at a grazing view: evenly). Nothing where view or light is below
    /// the zone.
    pub(crate) fn sample(&self, u: [f32; 2], normal: Vec3, view: Vec3) -> Option<Vec3> {
        let light = self.sample_all(u, normal, view)?;
        is_above(onto_zone(normal, light)).then_some(light)
    }

    /// The same, also where the light falls below the zone, from where it reflects nothing.
    #[inline(always)]
    pub(crate) fn sample_all(&self, u: [f32; 2], normal: Vec3, view: Vec3) -> Option<Vec3> {
        let view = onto_zone(normal, view);
        if !is_above(view) {
            return None;
        }
        // At a half vector of any length.
        let mirrored = |half: Vec3| half * (2.0 * view.dot(half) / half.length_squared()) - view;
        let light = match self.lobe {
            GGX | ANISOTROPIC_GGX => mirrored(ggx::sample(self.alphas(), u, view)),
            BECKMANN => mirrored(beckmann::sample(self.alpha, u, view)),
            PHONG => phong::sample(self.second, u, view),
            OREN_NAYAR => oren_nayar::sample(self.second, u, view),
            HOSTED_DIFFUSE | HOSTED_GLOSSY => hosted::sample(self.colour, u, view)?,
            _ => lambert::sample(u),
        };
        is_finite(light).then(|| off_zone(normal, light))
    }

    /// The density of [`Self::sample`] at the pair's light, per steradian; 0 unless both directions are above the
    /// zone. Adds up to 1 less the share of samples that fail.
    pub(crate) fn pdf(&self, normal: Vec3, pair: &Pair) -> f32 {
        let pair = pair.tilted(normal.x, normal.z);
        if_above(pair.light.z, self.pdfs(One, &pair))
    }

    /// The density of [`Self::sample_all`] for a pair as zones see it: adds up to 1 over the whole sphere.
    #[inline(always)]
    pub(crate) fn pdfs<L: Lanes>(&self, lanes: L, pair: &Local<L::F>) -> L::F {
        let density = match self.lobe {
            LAMBERT => if_above(pair.light.z, lambert::pdf(pair.light.z)),
            GGX | ANISOTROPIC_GGX => if_above(pair.half.z, ggx::pdf(self.alphas(), pair)),
            _ => self.further_pdfs(lanes, pair),
        };
        if_above(pair.view.z, density)
    }

    #[inline(always)]
    fn further_pdfs<L: Lanes>(&self, lanes: L, pair: &Local<L::F>) -> L::F {
        lanes.call(
            #[inline(always)]
            || match self.lobe {
                BECKMANN => beckmann::pdf(self.alpha, pair),
                PHONG => phong::pdf(self.second, pair),
                THREADS => if_above(pair.light.z, lambert::pdf(pair.light.z)),
                OREN_NAYAR => if_above(pair.light.z, oren_nayar::pdf(self.second, pair)),
                HOSTED_DIFFUSE | HOSTED_GLOSSY => {
                    let own = |lane| hosted::pdf(self.colour, &pair.lane(lane));
                    pair.view.z.each(|lane, _| own(lane))
                }
                _ => lanes.all(0.0),
            },
        )
    }

    /// The share of light that a zone reflects towards a view, RGB: an estimate by a few samples, within 0.04.
    pub(crate) fn reflectance(&self, normal: Vec3, view: Vec3) -> Vec3 {
        let sampled = |i: u32| {
            let light = self.sample(hammersley(i), normal, view)?;
            let pair = Pair::new(view, light);
            let share = self.weight(normal, &pair) / REFLECTANCE_SAMPLES as f32;
            share.is_finite().then_some(share)
        };
        (0..REFLECTANCE_SAMPLES).filter_map(sampled).sum()
    }

    /// How rough it is: the width of GGX microfacets that spread light about as far, 1 if it is diffuse.
    pub(crate) fn roughness(&self) -> f32 {
        let alphas = self.alphas();
        if alphas.x == alphas.y {
            return alphas.x;
        }
        (alphas.x * alphas.y).sqrt()
    }
}

/// Points spread evenly over the unit square.
fn hammersley(i: u32) -> [f32; 2] {
    let share = 1.0 / REFLECTANCE_SAMPLES as f32;
    let reversed = i.reverse_bits() >> (u32::BITS - REFLECTANCE_SAMPLES.trailing_zeros());
    [i, reversed].map(|n| (n as f32 + 0.5) * share)
}

/// `value` for directions of this cosine that are above the zone, else 0.
#[inline(always)]
pub(super) fn if_above<F: Number>(cos: F, value: F) -> F {
    cos.if_above(cos.like(LEAST_COS), value, cos.like(0.0))
}

/// What is no number is none however often it is taken, even not at all.
#[inline(always)]
pub(crate) fn is_finite(v: Vec3) -> bool {
    let [x, y, z] = (v * 0.0).to_array();
    x + y + z == 0.0
}

fn is_above(direction: Vec3) -> bool {
    direction.z > LEAST_COS
}

/// A direction in the zone's own frame, its normal (x, 0, z) upwards.
fn onto_zone(normal: Vec3, w: Vec3) -> Vec3 {
    let (x, z) = (normal.x, normal.z);
    Vec3::new(w.x * z - w.z * x, w.y, w.x * x + w.z * z)
}

/// Back from the zone's own frame.
fn off_zone(normal: Vec3, w: Vec3) -> Vec3 {
    let (x, z) = (normal.x, normal.z);
    Vec3::new(w.x * z + w.z * x, w.y, w.z * z - w.x * x)
}

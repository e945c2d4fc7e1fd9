//! Base BRDFs and metals for C.

use super::handle::{borrowed, exclusive};
use super::host_brdf::StriaeHostBrdf;
use super::status::{StriaeStatus, guard};
use crate::brdf::{Brdf, Fresnel, Metal};
use crate::error::{Error, Result};

/// Kinds of base BRDF.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeBrdfKind {
    /// Perfectly diffuse: `albedo`.
    Lambert = 0,
    /// GGX microfacets with height-correlated Smith masking: `alpha` and a Fresnel reflectance.
    Ggx = 1,
    /// Rough and diffuse, by Oren and Nayar in Fujii's form: `albedo` and `roughness`.
    OrenNayar = 2,
    /// Phong's lobe, normalised: `specular` and `exponent`.
    Phong = 3,
    /// Cook-Torrance: Beckmann microfacets, masked as V-grooves: `alpha` and a Fresnel reflectance.
    CookTorrance = 4,
    /// GGX of polishing lines, which run along the scratch, or on the flat surface along dp_du: `alpha_across`,
    /// `alpha_along` and a Fresnel reflectance.
    AnisotropicGgx = 5,
    /// The host's own: `host`.
    Host = 6,
}

/// Kinds of Fresnel reflectance.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeFresnelKind {
    /// Schlick's approximation from `f0`.
    Schlick = 0,
    /// A conductor's exact reflectance from `eta` and `k`.
    Conductor = 1,
}

/// Metals with known hardness and optical constants.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeMetal {
    /// Aluminium alloy 6061-T6, 107 HV.
    Aluminium = 0,
    /// Cartridge brass, half hard, 120 HV.
    Brass = 1,
    /// Low-carbon steel AISI 1018, 131 HV.
    Steel = 2,
    /// Titanium, grade 2, 145 HV.
    Titanium = 3,
    /// 37.6 HV.
    Copper = 4,
    /// 22 HV.
    Gold = 5,
    /// 25.6 HV.
    Silver = 6,
    /// 62 HV.
    Iron = 7,
    /// 65 HV.
    Nickel = 8,
    /// 108 HV.
    Chromium = 9,
}

/// A base BRDF: how the finish of one zone reflects. Linear RGB. Fields that its kinds do not name are ignored.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeBrdf {
    /// A StriaeBrdfKind.
    pub kind: u32,
    /// A StriaeFresnelKind (GGX, anisotropic GGX, Cook-Torrance).
    pub fresnel: u32,
    /// Lambert, Oren-Nayar: albedo, 0 to 1.
    pub albedo: [f32; 3],
    /// GGX, Cook-Torrance: width of the distribution of slopes, 0.001 to 1.
    pub alpha: f32,
    /// Schlick: reflectance at normal incidence, 0 to 1.
    pub f0: [f32; 3],
    /// Conductor: real part of the index of refraction, 0.01 to 20.
    pub eta: [f32; 3],
    /// Conductor: its imaginary part, 0 to 20.
    pub k: [f32; 3],
    /// Anisotropic GGX: width of the distribution of slopes across the polishing lines, 0.001 to 1.
    pub alpha_across: f32,
    /// Anisotropic GGX: width along the lines, 0.001 to 1.
    pub alpha_along: f32,
    /// Oren-Nayar: 0 (Lambert) to 1 (as rough as can be), without a unit.
    pub roughness: f32,
    /// Phong: of the lobe's cosine, 1 (wide) to 100000 (sharp).
    pub exponent: f32,
    /// Phong: colour, 0 to 1.
    pub specular: [f32; 3],
    /// The host's own: its functions, as striae_brdf_host() fills in. A table of yours must live during each call that the
    /// base BRDF is given to, and no longer; one that the library fills in stays.
    pub host: *const StriaeHostBrdf,
}

impl StriaeBrdf {
    /// # Safety
    /// If the kind says so, `host` is NULL or valid.
    pub(super) unsafe fn checked(&self) -> Result<Brdf> {
        let albedo = self.albedo;
        let brdf = match self.kind {
            0 => Brdf::Lambert { albedo },
            1 => Brdf::Ggx {
                alpha: self.alpha,
                fresnel: self.fresnel()?,
            },
            2 => Brdf::OrenNayar {
                albedo,
                roughness: self.roughness,
            },
            3 => Brdf::Phong {
                specular: self.specular,
                exponent: self.exponent,
            },
            4 => Brdf::CookTorrance {
                alpha: self.alpha,
                fresnel: self.fresnel()?,
            },
            5 => Brdf::AnisotropicGgx {
                alpha_across: self.alpha_across,
                alpha_along: self.alpha_along,
                fresnel: self.fresnel()?,
            },
            // SAFETY: as promised by the caller.
            6 => Brdf::Hosted(unsafe { borrowed("brdf.host", self.host)? }.known()?),
            kind => {
                let accepted = "a StriaeBrdfKind, 0 to 6";
                return Err(Error::number("brdf.kind", f64::from(kind), accepted));
            }
        };
        brdf.check()
    }

    fn fresnel(&self) -> Result<Fresnel> {
        match self.fresnel {
            0 => Ok(Fresnel::Schlick { f0: self.f0 }),
            1 => Ok(Fresnel::Conductor {
                eta: self.eta,
                k: self.k,
            }),
            other => {
                let accepted = "a StriaeFresnelKind, 0 to 1";
                Err(Error::number("brdf.fresnel", f64::from(other), accepted))
            }
        }
    }

    /// Microfacets of one width, whichever distribution.
    fn of_microfacets(alpha: f32, fresnel: Fresnel) -> Self {
        let c = Self {
            kind: 1,
            alpha,
            alpha_across: alpha,
            alpha_along: alpha,
            ..Self::BLACK
        };
        match fresnel {
            Fresnel::Schlick { f0 } => Self { f0, ..c },
            Fresnel::Conductor { eta, k } => Self {
                fresnel: 1,
                eta,
                k,
                ..c
            },
        }
    }

    /// Lambert without albedo; every other field is in its range too.
    const BLACK: Self = Self {
        kind: 0,
        fresnel: 0,
        albedo: [0.0; 3],
        alpha: 1.0,
        f0: [0.0; 3],
        eta: [1.0; 3],
        k: [0.0; 3],
        alpha_across: 1.0,
        alpha_along: 1.0,
        roughness: 0.0,
        exponent: 1.0,
        specular: [0.0; 3],
        host: core::ptr::null(),
    };
}

impl From<Brdf> for StriaeBrdf {
    fn from(brdf: Brdf) -> Self {
        match brdf {
            Brdf::Lambert { albedo } => Self {
                albedo,
                ..Self::BLACK
            },
            Brdf::Ggx { alpha, fresnel } => Self::of_microfacets(alpha, fresnel),
            Brdf::OrenNayar { albedo, roughness } => Self {
                kind: 2,
                albedo,
                roughness,
                ..Self::BLACK
            },
            Brdf::Phong { specular, exponent } => Self {
                kind: 3,
                specular,
                exponent,
                ..Self::BLACK
            },
            Brdf::CookTorrance { alpha, fresnel } => Self {
                kind: 4,
                ..Self::of_microfacets(alpha, fresnel)
            },
            Brdf::AnisotropicGgx {
                alpha_across,
                alpha_along,
                fresnel,
            } => Self {
                kind: 5,
                alpha_along,
                ..Self::of_microfacets(alpha_across, fresnel)
            },
            Brdf::Hosted(hosted) => Self {
                kind: 6,
                host: StriaeHostBrdf::of(hosted),
                ..Self::BLACK
            },
        }
    }
}

pub(super) fn metal_of(number: u32) -> Result<Metal> {
    let known = Metal::ALL.get(number as usize).copied();
    known.ok_or(Error::number(
        "metal",
        f64::from(number),
        "a StriaeMetal, 0 to 9",
    ))
}

/// Fills in `brdf` with what is made of a colour.
///
/// # Safety
/// `rgb` is NULL or points to three numbers; `brdf` is NULL or writable.
unsafe fn fill_in_brdf(
    argument: &'static str,
    rgb: *const f32,
    make: impl FnOnce([f32; 3]) -> Brdf,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: as promised by the caller.
        let (rgb, brdf) = unsafe {
            (
                borrowed(argument, rgb.cast::<[f32; 3]>())?,
                exclusive("brdf", brdf)?,
            )
        };
        *brdf = make(*rgb).check()?.into();
        Ok(())
    })
}

/// Fills in a diffuse base BRDF. Allocates nothing.
///
/// @param albedo RGB, each 0 to 1
/// @param brdf is written on success only
/// cbindgen:ptrs-as-arrays=[[albedo;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_lambert(
    albedo: *const f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    // SAFETY: both are NULL or valid, as the header asks.
    unsafe { fill_in_brdf("albedo", albedo, |albedo| Brdf::Lambert { albedo }, brdf) }
}

/// Fills in a rough diffuse base BRDF: Oren-Nayar.
///
/// @param albedo RGB, each 0 to 1
/// @param roughness 0 (Lambert) to 1 (as rough as can be), without a unit
/// @param brdf is written on success only
/// cbindgen:ptrs-as-arrays=[[albedo;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_oren_nayar(
    albedo: *const f32,
    roughness: f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    let make = |albedo| Brdf::OrenNayar { albedo, roughness };
    // SAFETY: both are NULL or valid, as the header asks.
    unsafe { fill_in_brdf("albedo", albedo, make, brdf) }
}

/// Fills in a normalised Phong lobe.
///
/// @param specular RGB, each 0 to 1
/// @param exponent of the lobe's cosine, 1 (wide) to 100000 (sharp)
/// @param brdf is written on success only
/// cbindgen:ptrs-as-arrays=[[specular;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_phong(
    specular: *const f32,
    exponent: f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    let make = |specular| Brdf::Phong { specular, exponent };
    // SAFETY: both are NULL or valid, as the header asks.
    unsafe { fill_in_brdf("specular", specular, make, brdf) }
}

/// Fills in GGX microfacets with Schlick's Fresnel reflectance. For Cook-Torrance set `kind` afterwards; for polishing
/// lines `kind` and whichever of `alpha_across` and `alpha_along` differs.
///
/// @param f0 reflectance at normal incidence, RGB, each 0 to 1
/// @param alpha width of the distribution of slopes, 0.001 (mirror) to 1 (rough)
/// @param brdf is written on success only
/// cbindgen:ptrs-as-arrays=[[f0;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_schlick(
    f0: *const f32,
    alpha: f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    let make = |f0| Brdf::Ggx {
        alpha,
        fresnel: Fresnel::Schlick { f0 },
    };
    // SAFETY: both are NULL or valid, as the header asks.
    unsafe { fill_in_brdf("f0", f0, make, brdf) }
}

/// Fills in a metal's base BRDF: GGX with its own conductor Fresnel reflectance. For Cook-Torrance set `kind`
/// afterwards; for polishing lines `kind` and whichever of `alpha_across` and `alpha_along` differs.
///
/// @param metal a StriaeMetal
/// @param alpha width of the distribution of slopes, 0.001 (mirror) to 1 (rough)
/// @param brdf is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_metal(
    metal: u32,
    alpha: f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable, as the header asks.
        let brdf = unsafe { exclusive("brdf", brdf)? };
        *brdf = Brdf::metal(metal_of(metal)?, alpha).check()?.into();
        Ok(())
    })
}

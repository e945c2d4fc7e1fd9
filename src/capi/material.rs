//! Base BRDFs and materials for C.

use super::handle::{borrowed, exclusive};
use super::status::{StriaeStatus, check_struct_size, guard};
use crate::brdf::{Brdf, Fresnel, Metal};
use crate::error::{Error, Result};
use crate::formation::Material;

/// Kinds of base BRDF.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeBrdfKind {
    /// Perfectly diffuse: `albedo`.
    Lambert = 0,
    /// GGX microfacets with height-correlated Smith masking: `alpha` and a Fresnel reflectance.
    Ggx = 1,
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
}

/// A base BRDF: how the finish of one zone reflects. Linear RGB. Fields that its kinds do not name are ignored.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeBrdf {
    /// A StriaeBrdfKind.
    pub kind: u32,
    /// A StriaeFresnelKind (GGX).
    pub fresnel: u32,
    /// Lambert: albedo, 0 to 1.
    pub albedo: [f32; 3],
    /// GGX: width of the distribution of slopes, 0.001 to 1.
    pub alpha: f32,
    /// Schlick: reflectance at normal incidence, 0 to 1.
    pub f0: [f32; 3],
    /// Conductor: real part of the index of refraction, 0.01 to 20.
    pub eta: [f32; 3],
    /// Conductor: its imaginary part, 0 to 20.
    pub k: [f32; 3],
}

/// What is scratched. Set struct_size to sizeof(StriaeMaterial) first.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeMaterial {
    /// sizeof(StriaeMaterial)
    pub struct_size: usize,
    /// Vickers hardness, kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
    /// How the unscratched surface reflects.
    pub surface: StriaeBrdf,
    /// How a scratch's zones reflect.
    pub scratched: StriaeBrdf,
}

impl StriaeBrdf {
    fn checked(&self) -> Result<Brdf> {
        let brdf = match (self.kind, self.fresnel) {
            (0, _) => Brdf::Lambert {
                albedo: self.albedo,
            },
            (1, 0) => Brdf::Ggx {
                alpha: self.alpha,
                fresnel: Fresnel::Schlick { f0: self.f0 },
            },
            (1, 1) => {
                let fresnel = Fresnel::Conductor {
                    eta: self.eta,
                    k: self.k,
                };
                Brdf::Ggx {
                    alpha: self.alpha,
                    fresnel,
                }
            }
            (1, fresnel) => {
                let accepted = "a StriaeFresnelKind, 0 to 1";
                return Err(Error::number("brdf.fresnel", f64::from(fresnel), accepted));
            }
            (kind, _) => {
                let accepted = "a StriaeBrdfKind, 0 to 1";
                return Err(Error::number("brdf.kind", f64::from(kind), accepted));
            }
        };
        brdf.check()
    }
}

impl From<Brdf> for StriaeBrdf {
    fn from(brdf: Brdf) -> Self {
        let zero = [0.0; 3];
        let mut c = Self {
            kind: 0,
            fresnel: 0,
            albedo: zero,
            alpha: 1.0,
            f0: zero,
            eta: [1.0; 3],
            k: zero,
        };
        match brdf {
            Brdf::Lambert { albedo } => c.albedo = albedo,
            Brdf::Ggx { alpha, fresnel } => {
                c.kind = 1;
                c.alpha = alpha;
                match fresnel {
                    Fresnel::Schlick { f0 } => c.f0 = f0,
                    Fresnel::Conductor { eta, k } => (c.fresnel, c.eta, c.k) = (1, eta, k),
                }
            }
        }
        c
    }
}

impl StriaeMaterial {
    pub(super) fn checked(&self) -> Result<Material> {
        let accepted = "sizeof(StriaeMaterial)";
        check_struct_size(self.struct_size, size_of::<Self>(), accepted)?;
        Ok(Material {
            hardness_hv: self.hardness_hv,
            surface: self.surface.checked()?,
            scratched: self.scratched.checked()?,
        })
    }
}

fn metal_of(number: u32) -> Result<Metal> {
    const ALL: [Metal; 4] = [
        Metal::Aluminium,
        Metal::Brass,
        Metal::Steel,
        Metal::Titanium,
    ];
    let known = ALL.get(number as usize).copied();
    known.ok_or(Error::number(
        "metal",
        f64::from(number),
        "a StriaeMetal, 0 to 3",
    ))
}

/// Fills in a diffuse base BRDF.
///
/// @param albedo RGB, each 0 to 1
/// @param brdf is written on success only
/// cbindgen:ptrs-as-arrays=[[albedo;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_lambert(
    albedo: *const f32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: both are NULL or valid, as the header asks.
        let (albedo, brdf) = unsafe {
            (
                borrowed("albedo", albedo.cast::<[f32; 3]>())?,
                exclusive("brdf", brdf)?,
            )
        };
        let made = StriaeBrdf::from(Brdf::Lambert { albedo: *albedo });
        made.checked()?;
        *brdf = made;
        Ok(())
    })
}

/// Fills in polished metal: GGX with the metal's own conductor Fresnel reflectance.
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
        let made = StriaeBrdf::from(Brdf::metal(metal_of(metal)?, alpha));
        made.checked()?;
        *brdf = made;
        Ok(())
    })
}

/// Fills in a metal: its hardness, a satin surface (GGX alpha 0.3) and smoother scratches (0.15).
///
/// @param metal a StriaeMetal
/// @param material with struct_size set; the rest is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_material_metal(
    metal: u32,
    material: *mut StriaeMaterial,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable with struct_size set, as the header asks.
        let material = unsafe { exclusive("material", material)? };
        let size = size_of::<StriaeMaterial>();
        check_struct_size(material.struct_size, size, "sizeof(StriaeMaterial)")?;
        let made = Material::metal(metal_of(metal)?);
        *material = StriaeMaterial {
            struct_size: size,
            hardness_hv: made.hardness_hv,
            surface: made.surface.into(),
            scratched: made.scratched.into(),
        };
        Ok(())
    })
}

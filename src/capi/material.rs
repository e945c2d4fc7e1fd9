//! Materials for C.

use super::brdf::{StriaeBrdf, metal_of};
use super::handle::{array, exclusive};
use super::status::{StriaeStatus, check_struct_size, guard};
use crate::error::{Error, Result};
use crate::formation::{Layer, MOST_LAYERS, Material, PileUpLaw, Plasticity};

/// Materials by name that are no metals.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeMaterialPreset {
    /// Acrylic glass (PMMA), opaque grey, 20 HV: springs back.
    Acrylic = 0,
    /// Soda-lime glass over a dark ground, 550 HV: brittle, little pile-up (an estimate), springs back by 0.45.
    Glass = 1,
    /// Alumina, white, 1500 HV: brittle, little pile-up (an estimate).
    Ceramic = 2,
}

/// How steep the outer flanks of piled-up material are.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaePileUpLaw {
    /// tan beta = -0.56 + 2.54 tan alpha (Bosch et al. 2004), at least a quarter of tan alpha.
    Bosch2004 = 0,
    /// tan beta = outer_slope.
    OuterSlope = 1,
    /// No peaks at all.
    None = 2,
}

/// A layer on top of a material's bulk, such as paint. It changes how a scratch looks, not how deep it is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeLayer {
    /// Thickness, mm, 1e-6 to 1000.
    pub thickness_mm: f64,
    /// How a scratch's zones reflect where they lie in this layer.
    pub scratched: StriaeBrdf,
}

/// What is scratched. Set struct_size to sizeof(StriaeMaterial), fill it with striae_material_metal() or
/// striae_material_preset(), and change what you like.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeMaterial {
    /// sizeof(StriaeMaterial)
    pub struct_size: usize,
    /// Vickers hardness (scratch hardness for STRIAE_DEPTH_LAW_SCRATCH_HARDNESS), kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
    /// A StriaePileUpLaw.
    pub pile_up_law: u32,
    /// tan beta for STRIAE_PILE_UP_LAW_OUTER_SLOPE, 0.001 to 11.4.
    pub outer_slope: f64,
    /// Area of both peaks over the area of the groove, 0 to 1 (nothing is lost).
    pub pile_up_fraction: f64,
    /// Share of the depth that springs back behind the tool, 0 to 0.95.
    pub elastic_recovery: f64,
    /// How the unscratched surface reflects.
    pub surface: StriaeBrdf,
    /// How a scratch's zones reflect where it reaches the bulk of the material.
    pub scratched: StriaeBrdf,
    /// Layers from the surface down; NULL for none. They must live during each call that the material is given to, and no
    /// longer.
    pub layers: *const StriaeLayer,
    /// How many layers, 4 at most.
    pub layer_count: usize,
}

impl StriaeMaterial {
    /// # Safety
    /// `layers` is NULL or points to `layer_count` layers; each base BRDF that is the host's own has valid functions.
    pub(super) unsafe fn checked(&self) -> Result<Material> {
        check_struct_size(
            self.struct_size,
            size_of::<Self>(),
            "sizeof(StriaeMaterial)",
        )?;
        if self.layer_count > MOST_LAYERS {
            return Err(Error::count("layer_count", self.layer_count, "4 or fewer"));
        }
        // SAFETY: as promised by the caller.
        let layers = unsafe { array(["layers", "layer_count"], self.layers, self.layer_count)? };
        let layer = |(i, layer): (usize, &StriaeLayer)| {
            // SAFETY: as promised by the caller.
            let scratched =
                unsafe { layer.scratched.checked() }.map_err(|error| error.within("layers", i))?;
            Ok(Layer {
                thickness_mm: layer.thickness_mm,
                scratched,
            })
        };
        // SAFETY: as promised by the caller.
        let (surface, scratched) = unsafe { (self.surface.checked()?, self.scratched.checked()?) };
        Ok(Material {
            hardness_hv: self.hardness_hv,
            pile_up: self.pile_up()?,
            pile_up_fraction: self.pile_up_fraction,
            elastic_recovery: self.elastic_recovery,
            surface,
            scratched,
            layers: layers
                .iter()
                .enumerate()
                .map(layer)
                .collect::<Result<_>>()?,
        })
    }

    fn pile_up(&self) -> Result<PileUpLaw> {
        match self.pile_up_law {
            0 => Ok(PileUpLaw::Bosch2004),
            1 => Ok(PileUpLaw::OuterSlope {
                tan_beta: self.outer_slope,
            }),
            2 => Ok(PileUpLaw::None),
            other => {
                let accepted = "a StriaePileUpLaw, 0 to 2";
                Err(Error::number("pile_up_law", f64::from(other), accepted))
            }
        }
    }

    /// Takes over a material that has no layers.
    fn fill_in(&mut self, made: &Material) -> Result<()> {
        let size = size_of::<Self>();
        check_struct_size(self.struct_size, size, "sizeof(StriaeMaterial)")?;
        let (pile_up_law, outer_slope) = match made.pile_up {
            PileUpLaw::Bosch2004 => (0, 1.0),
            PileUpLaw::OuterSlope { tan_beta } => (1, tan_beta),
            PileUpLaw::None => (2, 1.0),
        };
        *self = Self {
            struct_size: size,
            hardness_hv: made.hardness_hv,
            pile_up_law,
            outer_slope,
            pile_up_fraction: made.pile_up_fraction,
            elastic_recovery: made.elastic_recovery,
            surface: made.surface.into(),
            scratched: made.scratched.into(),
            layers: core::ptr::null(),
            layer_count: 0,
        };
        Ok(())
    }
}

/// Fills in a metal: its hardness, a satin surface (GGX alpha 0.3) and smoother scratches (0.15), flowing as the
/// metals of Bosch et al. 2004 do: nothing is lost, nothing springs back. No layers.
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
        material.fill_in(&Material::metal(metal_of(metal)?))
    })
}

/// Fills in a material by name. No layers.
///
/// @param preset a StriaeMaterialPreset
/// @param material with struct_size set; the rest is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_material_preset(
    preset: u32,
    material: *mut StriaeMaterial,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable with struct_size set, as the header asks.
        let material = unsafe { exclusive("material", material)? };
        let made = match preset {
            0 => Material::acrylic(),
            1 => Material::glass(),
            2 => Material::ceramic(),
            other => {
                let accepted = "a StriaeMaterialPreset, 0 to 2";
                return Err(Error::number("preset", f64::from(other), accepted));
            }
        };
        material.fill_in(&made)
    })
}

/// Sets a material's pile-up fraction and elastic recovery from its plasticity, by a fit to finite-element
/// scratches (yield strain 5e-4 to 0.01, hardening 0.1 to 0.5).
///
/// @param yield_strain yield stress over Young's modulus, 1e-4 to 0.1
/// @param hardening strain-hardening exponent, 0 to 0.6
/// @param material a filled-in material; its pile-up law counts; two fields are written, on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_material_set_plasticity(
    yield_strain: f64,
    hardening: f64,
    material: *mut StriaeMaterial,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable, as the header asks.
        let material = unsafe { exclusive("material", material)? };
        check_struct_size(
            material.struct_size,
            size_of::<StriaeMaterial>(),
            "sizeof(StriaeMaterial)",
        )?;
        let plasticity = Plasticity::of(yield_strain, hardening)?;
        material.pile_up_fraction = plasticity.pile_up_fraction(material.pile_up()?);
        material.elastic_recovery = plasticity.elastic_recovery();
        Ok(())
    })
}

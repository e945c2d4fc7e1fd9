//! What a prepared point is made of, for C: zones for renderers with base BRDFs of their own, and a few numbers for those
//! that take no more.

use super::brdf::StriaeBrdf;
use super::handle::{exclusive, exclusive_array};
use super::sampling::{STRIAE_LOBE_SCRATCH, flags};
use super::shading::{StriaeShading, ask, prepared, vector};
use super::status::{StriaeStatus, guard};
use crate::brdf::Lobe;
use crate::error::Error;
use crate::scattering::{Parameters, SeenZone};

/// A facet of a scratch, or the flat surface, as a shading point shows it. Directions are unit vectors in the local frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeZone {
    /// The zone's normal.
    pub normal: [f32; 3],
    /// Along the scratch, or along the flat surface's polishing lines; at right angles to `normal`.
    pub tangent: [f32; 3],
    /// How often striae_sample() chooses it, of all that is chosen: the share of the pixel that the viewer sees it in.
    /// Scratches of a crowd are chosen by what all of them show on average.
    pub seen: f32,
    /// The share of the pixel in which the viewer sees it lit: its BRDF times cosine, about `normal`, counts so often.
    pub lit: f32,
    /// Number of its base BRDF: striae_zone_brdf().
    pub brdf: u32,
}

/// The scratches of a point as a single lobe: GGX microfacets whose slopes deviate as much along either axis as the
/// seen zones' and those of their own microfacets do together. Of an unscratched point: the surface's own.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeParameters {
    /// The share of what the pixel shows that scratches are, 0 to 1.
    pub coverage: f32,
    /// Along the scratches, where the lobe is narrowest: from the local frame's x towards its y, degrees, 0 up to 180. 0
    /// where no direction stands out.
    pub tangent_deg: f32,
    /// Width alpha of the distribution of slopes along that direction, 0.001 to 1.
    pub alpha_along: f32,
    /// Width across it, from `alpha_along` to 1.
    pub alpha_across: f32,
    /// Alpha of an isotropic lobe as wide: the geometric mean of both.
    pub roughness: f32,
    /// 0 (none) up to 1: 1 less `alpha_along` over `alpha_across`.
    pub anisotropy: f32,
    /// The lobe's unit normal in the local frame: scratches that show one wall lean.
    pub normal: [f32; 3],
}

macro_rules! assert_same_place {
    ($c:ident is $rust:ident: $($field:ident)*) => {
        const _: () = assert!(
            size_of::<$c>() == size_of::<$rust>() && align_of::<$c>() == align_of::<$rust>()
                $(&& core::mem::offset_of!($c, $field) == core::mem::offset_of!($rust, $field))*,
            "the C structure must be the library's own"
        );
    };
}

assert_same_place!(StriaeZone is SeenZone: normal tangent seen lit brdf);
assert_same_place!(StriaeParameters is Parameters:
    coverage tangent_deg alpha_along alpha_across roughness anisotropy normal);

/// The zones that the viewer sees, for renderers that evaluate base BRDFs of their own: what a light counts is the sum of each
/// zone's `lit` times BRDF times cosine about its normal. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light in the local frame, of any length above 0; from below the surface nothing is lit
/// @param zones receives the first `capacity` ones, may be NULL with a capacity of 0; need not be initialised
/// @param capacity how many `zones` can hold: 200 are enough but for crowds
/// @param count receives how many there are, which may be more; the last one is the flat surface. 0 for a point that
///     reflects nothing
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_zones(
    shading: *const StriaeShading,
    light: *const f32,
    zones: *mut StriaeZone,
    capacity: usize,
    count: *mut usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks. A SeenZone is made of numbers for which all bits are
        // valid, and has the same layout as a StriaeZone (asserted above).
        let (shading, light, zones, count) = unsafe {
            (
                prepared(shading)?,
                vector("light", light)?,
                exclusive_array(["zones", "capacity"], zones.cast::<SeenZone>(), capacity)?,
                exclusive("count", count)?,
            )
        };
        *count = shading.zones(light, zones);
        Ok(())
    })
}

/// A zone's base BRDF, as the material had it but for rounding; of the host's own its table. Never allocates, locks or
/// blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param number a zone's `brdf`; 0 is the flat surface's
/// @param brdf receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_zone_brdf(
    shading: *const StriaeShading,
    number: u32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("brdf", brdf), |shading| {
            let accepted = "the number that a zone of this shading has";
            let unknown = Error::number("number", f64::from(number), accepted);
            Ok(shading.zone_brdf(number).ok_or(unknown)?.into())
        })
    }
}

/// The scratches as a single lobe, for materials that take no other: mix it with the surface's by its coverage. Never
/// allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param parameters receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_parameters(
    shading: *const StriaeShading,
    parameters: *mut StriaeParameters,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks; Parameters have the same layout (asserted above).
    unsafe {
        let parameters = parameters.cast::<Parameters>();
        ask(shading, ("parameters", parameters), |shading| {
            Ok(shading.parameters())
        })
    }
}

/// How rough the point is, scratches and surface together. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param roughness receives the alpha of GGX microfacets that spread light about as far, 0.001 to 1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_roughness(
    shading: *const StriaeShading,
    roughness: *mut f32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("roughness", roughness), |shading| {
            Ok(shading.roughness())
        })
    }
}

/// An estimate of the share of light that the point reflects towards the view: the mean of 128 samples, within about 0.05. It
/// costs as much as 128 lights do. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param albedo receives linear RGB
/// cbindgen:ptrs-as-arrays=[[albedo;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_albedo(
    shading: *const StriaeShading,
    albedo: *mut f32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("albedo", albedo.cast::<[f32; 3]>()), |shading| {
            Ok(shading.albedo())
        })
    }
}

/// Which lobes the viewer sees, before one is chosen. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param lobes receives the STRIAE_LOBE flags of all zones together; 0 for a point that reflects nothing
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_lobes(
    shading: *const StriaeShading,
    lobes: *mut u32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("lobes", lobes), |shading| {
            let kinds = [Lobe::Diffuse, Lobe::Glossy, Lobe::Sharp];
            let seen = kinds.into_iter().filter(|lobe| shading.has_lobe(*lobe));
            let all = seen.fold(0, |all, lobe| all | flags(lobe));
            let scratch = all != 0 && shading.coverage() > 0.0;
            Ok(all | if scratch { STRIAE_LOBE_SCRATCH } else { 0 })
        })
    }
}

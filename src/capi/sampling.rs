//! Choosing lights, for C.

use super::handle::{borrowed, exclusive};
use super::shading::{StriaeFrame, StriaeShading};
use super::status::{StriaeStatus, guard};
use crate::brdf::Lobe;
use crate::error::{Error, Result};
use crate::pattern::Frame;
use crate::scattering::{Bounces, Evaluated, Sample, Shading};
use glam::Vec3;

/// striae_set_bounces(): light goes from one zone to the viewer.
pub const STRIAE_BOUNCES_ONE: u32 = 0;
/// striae_set_bounces(): light goes from zone to zone within a scratch, and to the flat surface beside it, until it leaves.
pub const STRIAE_BOUNCES_ALL: u32 = 1;

/// Flag of a lobe: it reflects, as all of them do.
pub const STRIAE_LOBE_REFLECTION: u32 = 1;
/// Flag of a lobe: diffuse (Lambert, Oren-Nayar).
pub const STRIAE_LOBE_DIFFUSE: u32 = 2;
/// Flag of a lobe: about the mirrored view (Phong, microfacets).
pub const STRIAE_LOBE_GLOSSY: u32 = 4;
/// Flag of a glossy lobe less than alpha 0.02 wide, which may be treated like a mirror. Its density is finite all the same.
pub const STRIAE_LOBE_SHARP: u32 = 8;
/// Flag of a lobe: a zone of a scratch; without it the flat surface.
pub const STRIAE_LOBE_SCRATCH: u32 = 16;

/// A light chosen for a view.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeSample {
    /// Unit direction to the light.
    pub light: [f32; 3],
    /// Density of the choice, per steradian; 0 if no light was chosen, which counts as black.
    pub pdf: f32,
    /// BRDF times cosine over `pdf`: what light from there counts, linear RGB.
    pub weight: [f32; 3],
    /// STRIAE_LOBE flags of the zone that was chosen.
    pub lobe: u32,
}

/// What is reflected of a light, and how often the light is chosen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeEvaluated {
    /// BRDF times cosine, linear RGB.
    pub f: [f32; 3],
    /// Density with which striae_sample() chooses the light, per steradian.
    pub pdf: f32,
}

impl StriaeSample {
    pub(super) const NONE: Self = Self {
        light: [0.0; 3],
        pdf: 0.0,
        weight: [0.0; 3],
        lobe: 0,
    };
}

impl From<Sample> for StriaeSample {
    fn from(sample: Sample) -> Self {
        let scratch = if sample.scratch {
            STRIAE_LOBE_SCRATCH
        } else {
            0
        };
        Self {
            light: sample.light,
            pdf: sample.pdf,
            weight: sample.weight,
            lobe: flags(sample.lobe) | scratch,
        }
    }
}

impl From<Evaluated> for StriaeEvaluated {
    fn from(evaluated: Evaluated) -> Self {
        Self {
            f: evaluated.brdf_cos,
            pdf: evaluated.pdf,
        }
    }
}

pub(super) fn flags(lobe: Lobe) -> u32 {
    STRIAE_LOBE_REFLECTION
        | match lobe {
            Lobe::Diffuse => STRIAE_LOBE_DIFFUSE,
            Lobe::Glossy => STRIAE_LOBE_GLOSSY,
            Lobe::Sharp => STRIAE_LOBE_GLOSSY | STRIAE_LOBE_SHARP,
        }
}

/// A prepared point.
///
/// # Safety
/// `shading` is NULL or was written by striae_shade().
pub(super) unsafe fn prepared<'a>(shading: *const StriaeShading) -> Result<&'a Shading> {
    // SAFETY: as promised by the caller; a Shading fits (asserted beside StriaeShading).
    unsafe { borrowed("shading", shading.cast::<Shading>()) }
}

/// A direction.
///
/// # Safety
/// `vector` is NULL or points to three numbers.
pub(super) unsafe fn vector(name: &'static str, vector: *const f32) -> Result<[f32; 3]> {
    // SAFETY: as promised by the caller.
    unsafe { borrowed(name, vector.cast::<[f32; 3]>()) }.copied()
}

/// Says how far a prepared point's light is followed; striae_shade() sets it back to STRIAE_BOUNCES_ONE. Any number of
/// threads at once, each with a shading of its own.
///
/// With all bounces striae_sample() walks through the cross-section, without bias, and striae_eval() adds what zones reflect to
/// one another as if they scattered it evenly: exact for Lambertian zones, about for glossy ones. The density stays that of
/// one bounce, which is all that multiple importance sampling needs.
///
/// @param shading filled in by striae_shade()
/// @param bounces STRIAE_BOUNCES_ONE or STRIAE_BOUNCES_ALL
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_set_bounces(
    shading: *mut StriaeShading,
    bounces: u32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or written by striae_shade(), as the header asks.
        let shading = unsafe { exclusive("shading", shading.cast::<Shading>())? };
        let bounces = match bounces {
            STRIAE_BOUNCES_ONE => Bounces::One,
            STRIAE_BOUNCES_ALL => Bounces::All,
            other => {
                let accepted = "STRIAE_BOUNCES_ONE or STRIAE_BOUNCES_ALL";
                return Err(Error::number("bounces", f64::from(other), accepted));
            }
        };
        shading.set_bounces(bounces);
        Ok(())
    })
}

/// Chooses a light for the view, about as often as it is reflected. Never allocates, locks or blocks; any number of
/// threads at once.
///
/// @code{.c}
/// StriaeSample sample;
/// striae_sample(&shading, (float[3]){next(), next(), next()}, &sample);
/// if (sample.pdf > 0.0f) {
///   const Radiance from = radiance(point, to_world(sample.light));
///   for (int c = 0; c < 3; c++) sum[c] += sample.weight[c] * from.rgb[c];
/// }
/// @endcode
///
/// @param shading filled in by striae_shade()
/// @param u three numbers from 0 up to (not including) 1: the first chooses a zone, as often as the viewer sees it, the
///     others a direction, as often as the zone's base BRDF reflects it
/// @param sample receives the light, in the local frame; a pdf of 0 if there is none
/// cbindgen:ptrs-as-arrays=[[u;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_sample(
    shading: *const StriaeShading,
    u: *const f32,
    sample: *mut StriaeSample,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, u, sample) = unsafe {
            (
                prepared(shading)?,
                vector("u", u)?,
                exclusive("sample", sample)?,
            )
        };
        *sample = shading.sample(u).map_or(StriaeSample::NONE, Into::into);
        Ok(())
    })
}

/// As striae_sample(), with the light in the renderer's frame.
///
/// @param shading filled in by striae_shade()
/// @param frame the point's, from striae_frame()
/// @param u three numbers from 0 up to (not including) 1
/// @param sample receives the light, in the renderer's frame; a pdf of 0 if there is none
/// cbindgen:ptrs-as-arrays=[[u;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_sample_world(
    shading: *const StriaeShading,
    frame: *const StriaeFrame,
    u: *const f32,
    sample: *mut StriaeSample,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, frame, u, sample) = unsafe {
            (
                prepared(shading)?,
                borrowed("frame", frame)?,
                vector("u", u)?,
                exclusive("sample", sample)?,
            )
        };
        *sample = shading.sample(u).map_or(StriaeSample::NONE, Into::into);
        let world = Frame::from(frame).to_world(Vec3::from(sample.light));
        sample.light = world.to_array();
        Ok(())
    })
}

/// The density with which striae_sample() chooses a light. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light in the local frame, of any length above 0
/// @param pdf receives it, per steradian: 0 from below the surface, elsewhere it adds up to 1
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pdf(
    shading: *const StriaeShading,
    light: *const f32,
    pdf: *mut f32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, light, pdf) = unsafe {
            (
                prepared(shading)?,
                vector("light", light)?,
                exclusive("pdf", pdf)?,
            )
        };
        *pdf = shading.pdf(light);
        Ok(())
    })
}

/// The density with which the view would be chosen were the light the view: what striae_pdf() says of the view once the point
/// is prepared for `light`. For paths walked from both ends. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light in the local frame, of any length above 0
/// @param pdf receives it, per steradian
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pdf_reverse(
    shading: *const StriaeShading,
    light: *const f32,
    pdf: *mut f32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, light, pdf) = unsafe {
            (
                prepared(shading)?,
                vector("light", light)?,
                exclusive("pdf", pdf)?,
            )
        };
        *pdf = shading.pdf_reverse(light);
        Ok(())
    })
}

/// striae_eval() and striae_pdf() in one, for little more than one costs. Never allocates, locks or blocks; any number of
/// threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light in the local frame, of any length above 0
/// @param evaluated receives both
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval_pdf(
    shading: *const StriaeShading,
    light: *const f32,
    evaluated: *mut StriaeEvaluated,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, light, evaluated) = unsafe {
            (
                prepared(shading)?,
                vector("light", light)?,
                exclusive("evaluated", evaluated)?,
            )
        };
        *evaluated = shading.eval_pdf(light).into();
        Ok(())
    })
}

/// As striae_eval_pdf(), with the light in the renderer's frame.
///
/// @param shading filled in by striae_shade()
/// @param frame the point's, from striae_frame()
/// @param light direction to the light in the renderer's frame, of any length above 0
/// @param evaluated receives both
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval_pdf_world(
    shading: *const StriaeShading,
    frame: *const StriaeFrame,
    light: *const f32,
    evaluated: *mut StriaeEvaluated,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (shading, frame, light, evaluated) = unsafe {
            (
                prepared(shading)?,
                borrowed("frame", frame)?,
                vector("light", light)?,
                exclusive("evaluated", evaluated)?,
            )
        };
        let local = Frame::from(frame).to_local(Vec3::from(light));
        *evaluated = shading.eval_pdf(local.to_array()).into();
        Ok(())
    })
}

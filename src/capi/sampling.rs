//! Choosing lights, for C.

use super::handle::{borrowed, exclusive};
use super::shading::{StriaeFrame, StriaeShading, ask, vector};
use super::status::{StriaeStatus, guard};
use crate::brdf::Lobe;
use crate::error::Error;
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
    /// Unit direction to the light, away from the surface and above it.
    pub light: [f32; 3],
    /// Density of the choice, per steradian, by whichever zone the light might have been chosen: that of striae_pdf(). Always
    /// finite. 0 if no light was chosen, which counts as black; then all else is 0, too.
    pub pdf: f32,
    /// BRDF times cosine over `pdf`: what light from there counts, linear RGB. With STRIAE_BOUNCES_ALL so on average only.
    pub weight: [f32; 3],
    /// STRIAE_LOBE flags of the zone that was chosen.
    pub lobe: u32,
}

/// What is reflected of a light, and how often the light is chosen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeEvaluated {
    /// BRDF times cosine, linear RGB, as striae_eval() without flags.
    pub f: [f32; 3],
    /// Density with which striae_sample() chooses the light, per steradian.
    pub pdf: f32,
}

impl From<Option<Sample>> for StriaeSample {
    fn from(sample: Option<Sample>) -> Self {
        let Some(sample) = sample else {
            return Self {
                light: [0.0; 3],
                pdf: 0.0,
                weight: [0.0; 3],
                lobe: 0,
            };
        };
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

/// Says how far a prepared point's light is followed; striae_shade() sets it back to STRIAE_BOUNCES_ONE. Never allocates,
/// locks or blocks; any number of threads at once, each with a shading of its own.
///
/// With all bounces striae_sample() walks through the cross-section, without bias, and striae_eval() adds what zones reflect to
/// one another: by its direction the first time (lobes of less than alpha 0.06 as if they were so wide), as if scattered
/// evenly from then on. Exact for Lambertian zones; metals of alpha 0.05 to 0.4 measured within 1 %. A host's own base BRDF
/// passes light on as Lambert's or GGX of its widths would, in its own colour. The density stays that of
/// one bounce, which is all that multiple importance sampling needs. To evaluate then takes many times as long, to sample
/// hardly longer.
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
/// No light is chosen where the view is below the surface, and now and then elsewhere: that light is absorbed, and to sample
/// again instead would gain light. No lobe is so sharp that it has no density, so multiple importance sampling knows no
/// special case:
///
/// @code{.c}
/// StriaeSample sample;
/// striae_sample_world(&shading, &frame, (float[3]){next(), next(), next()}, &sample);
/// if (sample.pdf > 0.0f) {
///   const Hit hit = trace(position, sample.light);
///   const float share = sample.pdf / (sample.pdf + lamp_pdf(&hit));
///   for (int c = 0; c < 3; c++) sum[c] += share * sample.weight[c] * hit.emitted[c];
/// }
/// StriaeEvaluated lit;
/// const Lamp lamp = sample_lamp(position);
/// striae_eval_pdf_world(&shading, &frame, lamp.direction, &lit);
/// for (int c = 0; c < 3; c++) sum[c] += lit.f[c] * lamp.emitted[c] / (lamp.pdf + lit.pdf);
/// @endcode
///
/// @param shading filled in by striae_shade()
/// @param u three numbers from 0 up to (not including) 1, others count as the nearest of them: the first chooses a zone, as
///     often as the viewer sees it, the others a direction, as often as the zone's base BRDF reflects it
/// @param sample receives the light, in the local frame; a pdf of 0 if there is none
/// cbindgen:ptrs-as-arrays=[[u;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_sample(
    shading: *const StriaeShading,
    u: *const f32,
    sample: *mut StriaeSample,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("sample", sample), |shading| {
            Ok(shading.sample(vector("u", u)?).into())
        })
    }
}

/// As striae_sample(), with the light in the renderer's frame.
///
/// @param shading filled in by striae_shade()
/// @param frame the point's, from striae_shade_world() or striae_frame()
/// @param u as for striae_sample()
/// @param sample receives the light, in the renderer's frame; a pdf of 0 if there is none
/// cbindgen:ptrs-as-arrays=[[u;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_sample_world(
    shading: *const StriaeShading,
    frame: *const StriaeFrame,
    u: *const f32,
    sample: *mut StriaeSample,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("sample", sample), |shading| {
            let frame = Frame::from(borrowed("frame", frame)?);
            let chosen = StriaeSample::from(shading.sample(vector("u", u)?));
            let light = frame.to_world(Vec3::from(chosen.light)).to_array();
            Ok(StriaeSample { light, ..chosen })
        })
    }
}

/// The density with which striae_sample() chooses a light. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light in the local frame, of any length above 0
/// @param pdf receives it, per steradian: 0 from below the surface or with no direction (NaN, zero); elsewhere it adds up to
///     1, or with base BRDFs of the host's own to the share of samples that choose a light
/// cbindgen:ptrs-as-arrays=[[light;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pdf(
    shading: *const StriaeShading,
    light: *const f32,
    pdf: *mut f32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("pdf", pdf), |shading| {
            Ok(shading.pdf(vector("light", light)?))
        })
    }
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
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("pdf", pdf), |shading| {
            Ok(shading.pdf_reverse(vector("light", light)?))
        })
    }
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
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("evaluated", evaluated), |shading| {
            Ok(shading.eval_pdf(vector("light", light)?).into())
        })
    }
}

/// As striae_eval_pdf(), with the light in the renderer's frame.
///
/// @param shading filled in by striae_shade()
/// @param frame the point's, from striae_shade_world() or striae_frame()
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
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("evaluated", evaluated), |shading| {
            let frame = Frame::from(borrowed("frame", frame)?);
            let light = frame.to_local(Vec3::from(vector("light", light)?));
            Ok(shading.eval_pdf(light.to_array()).into())
        })
    }
}

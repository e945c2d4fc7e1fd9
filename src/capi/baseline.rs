//! The earlier systems for C.

use super::brdf::StriaeBrdf;
use super::handle::{borrowed, exclusive, make_shared, release, retain};
use super::pattern::StriaePattern;
use super::shading::{StriaePoint, StriaeShading};
use super::status::{StriaeStatus, check_struct_size, guard};
use crate::baseline::{Baseline, Canvas, Highlight, TwoAngles};
use crate::scattering::Shading;

/// Which part of texture space an earlier system paints its scratches on, and how finely. What lies beside it is unscratched.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeCanvas {
    /// Two opposite corners of a rectangle, (u, v), -1e6 to 1e6, the first one lower in both.
    pub area_uv: [[f64; 2]; 2],
    /// Texels in u and in v, each 1 to 32768, 2^30 at most in all.
    pub texels: [u32; 2],
}

/// The one cross-section of MDG01: four zones of equal width, a peak, a groove, and the same peak again. Set struct_size to
/// sizeof(StriaeTwoAngles).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeTwoAngles {
    /// sizeof(StriaeTwoAngles)
    pub struct_size: usize,
    /// Width of all four zones together, mm, 1e-6 to 1e6.
    pub width_mm: f64,
    /// How steeply the peaks rise from the surface, degrees, 0 to 85.
    pub peak_deg: f64,
    /// How steeply the groove falls from their tops, degrees, 0 to 85.
    pub groove_deg: f64,
    /// Base BRDFs of the zones, from left to right.
    pub zones: [StriaeBrdf; 4],
}

/// A surface scratched in the manner of an earlier system, for work side by side. Immutable; any thread may use it;
/// reference-counted.
#[derive(Debug)]
pub struct StriaeBaseline(Baseline);

impl From<&StriaeCanvas> for Canvas {
    fn from(canvas: &StriaeCanvas) -> Self {
        let &StriaeCanvas { area_uv, texels } = canvas;
        Self { area_uv, texels }
    }
}

/// Scratches as Becket and Badler had them (1990): each is a straight line, from where the pattern's starts to where it
/// ends, and reflects evenly in all directions: a random share of light. They are one texel wide; a point shows the texel
/// that it lies in.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default); nor are the other calls named
/// striae_baseline.
///
/// @param pattern the scratches, their surface and its scale; scratches dealt out at random: STRIAE_STYLE_STRAIGHT
/// @param canvas where and how finely they are painted
/// @param lowest least intensity of a scratch, 0 to 1
/// @param highest its most, from `lowest` to 1
/// @param seed another seed, other intensities
/// @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_bb90(
    pattern: *const StriaePattern,
    canvas: *const StriaeCanvas,
    lowest: f32,
    highest: f32,
    seed: u64,
    baseline: *mut *mut StriaeBaseline,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, canvas) =
            unsafe { (borrowed("pattern", pattern)?, borrowed("canvas", canvas)?) };
        let made = Baseline::bb90(&pattern.0, &canvas.into(), [lowest, highest], seed);
        made.map(StriaeBaseline)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("baseline", baseline, make) })
}

/// Scratches as Buchanan and Lalonde had them (1999): each is a straight line, from where the pattern's starts to where it
/// ends; each texel lists those that pass through it, and a point adds the strongest of their highlights to what the surface
/// reflects. All shine alike: by Phong's lobe about the nearest direction to which a thin line mirrors the view, lines being
/// told apart by 2.5 degrees. Such a surface may reflect more light than it gets.
///
/// @param pattern the scratches, their surface and its scale; scratches dealt out at random: STRIAE_STYLE_STRAIGHT
/// @param canvas where and how finely they are listed
/// @param specular the highlight's colour, RGB, each 0 to 1
/// @param exponent of the lobe's cosine, 1 (wide) to 100000 (sharp)
/// @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
/// cbindgen:ptrs-as-arrays=[[specular;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_bl99(
    pattern: *const StriaePattern,
    canvas: *const StriaeCanvas,
    specular: *const f32,
    exponent: f32,
    baseline: *mut *mut StriaeBaseline,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, canvas, specular) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("canvas", canvas)?,
                *borrowed("specular", specular.cast::<[f32; 3]>())?,
            )
        };
        let highlight = Highlight { specular, exponent };
        Baseline::bl99(&pattern.0, &canvas.into(), &highlight).map(StriaeBaseline)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("baseline", baseline, make) })
}

/// Scratches as Merillou, Dischler and Ghazanfarpour had them (2001): painted into an image, one texel wide, all with one
/// symmetric cross-section of two angles. A pixel that holds a painted texel has the scratch in its middle, which takes half
/// of the pixel at most and runs the way that the seven by seven texels about the one nearest to its centre say.
///
/// @param pattern the scratches' paths, their surface and its scale
/// @param canvas where and how finely they are painted
/// @param scratch the cross-section
/// @param baseline receives a handle to release with striae_baseline_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_mdg01(
    pattern: *const StriaePattern,
    canvas: *const StriaeCanvas,
    scratch: *const StriaeTwoAngles,
    baseline: *mut *mut StriaeBaseline,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, canvas, scratch) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("canvas", canvas)?,
                borrowed("scratch", scratch)?,
            )
        };
        let own = size_of::<StriaeTwoAngles>();
        check_struct_size(scratch.struct_size, own, "sizeof(StriaeTwoAngles)")?;
        let [a, b, c, d] = &scratch.zones;
        // SAFETY: tables of host BRDFs are NULL or valid, as the header asks.
        let zones = unsafe { [a.checked()?, b.checked()?, c.checked()?, d.checked()?] };
        let scratch = TwoAngles {
            width_mm: scratch.width_mm,
            peak_deg: scratch.peak_deg,
            groove_deg: scratch.groove_deg,
            zones,
        };
        Baseline::mdg01(&pattern.0, &canvas.into(), &scratch).map(StriaeBaseline)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("baseline", baseline, make) })
}

/// Prepares a point for one viewing direction, as striae_shade() does of a pattern: the shading is evaluated and sampled by
/// the same calls. Never allocates, locks or blocks; any number of threads at once.
///
/// @param baseline the scratches
/// @param point the point
/// @param view direction to the viewer, away from the surface, in the local frame, of any length above 0
/// @param shading receives the result; need not be initialised. Shading into it again replaces what it held
/// cbindgen:ptrs-as-arrays=[[view;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_shade(
    baseline: *const StriaeBaseline,
    point: *const StriaePoint,
    view: *const f32,
    shading: *mut StriaeShading,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks. A Shading is made of numbers for which all bits
        // are valid, and fits into a StriaeShading.
        let (baseline, point, view, shading) = unsafe {
            (
                borrowed("baseline", baseline)?,
                borrowed("point", point)?,
                *borrowed("view", view.cast::<[f32; 3]>())?,
                exclusive("shading", shading.cast::<Shading>())?,
            )
        };
        baseline.0.shade(&point.surface_point(), view, shading)?;
        point.check_footprint()
    })
}

/// Tells how much memory the images or lists take.
///
/// @param baseline the scratches
/// @param bytes receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_memory(
    baseline: *const StriaeBaseline,
    bytes: *mut usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (baseline, bytes) =
            unsafe { (borrowed("baseline", baseline)?, exclusive("bytes", bytes)?) };
        *bytes = baseline.0.memory_bytes();
        Ok(())
    })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_retain(baseline: *const StriaeBaseline) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(baseline) }
}

/// Drops a reference; the last one frees it. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_baseline_release(baseline: *const StriaeBaseline) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(baseline) }
}

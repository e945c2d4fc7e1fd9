//! Whole arrays at once, for C.

use super::handle::{array, borrowed, exclusive_array};
use super::pattern::StriaePattern;
use super::sampling::StriaeSample;
use super::shading::{StriaePoint, StriaeShading, output};
use super::status::{StriaeStatus, guard};
use crate::error::{Error, Result};
use crate::scattering::{Shading, Vectors, set_simd};

/// Vectors that are read, as a structure of arrays. Of arrays of vectors: `{v[0], v[0] + 1, v[0] + 2, 3}` for `float v[][3]`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeVectors {
    /// First components, one of each vector.
    pub x: *const f32,
    /// Second components.
    pub y: *const f32,
    /// Third components.
    pub z: *const f32,
    /// Floats from one vector's component to the next one's, 1 or more: 1 where they are packed.
    pub stride: usize,
}

/// Vectors that are written, as StriaeVectors are read.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeVectorsOut {
    /// First components, one of each vector.
    pub x: *mut f32,
    /// Second components.
    pub y: *mut f32,
    /// Third components.
    pub z: *mut f32,
    /// Floats from one vector's component to the next one's, 1 or more: 1 where they are packed.
    pub stride: usize,
}

/// Samples that are written: what StriaeSample has, as a structure of arrays.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeSamplesOut {
    /// Unit directions to the lights.
    pub light: StriaeVectorsOut,
    /// BRDF times cosine over `pdf`, linear RGB.
    pub weight: StriaeVectorsOut,
    /// Densities per steradian, packed; 0 where no light was chosen.
    pub pdf: *mut f32,
    /// STRIAE_LOBE flags, packed; NULL if they are not wanted.
    pub lobe: *mut u32,
}

/// How many numbers apart the first component of the first vector and the end of the last one's are.
fn length(name: &'static str, stride: usize, count: usize) -> Result<usize> {
    if stride == 0 {
        return Err(Error::count("stride", stride, "1 or more").within(name, 0));
    }
    let last = count.saturating_sub(1).checked_mul(stride);
    let length = last.and_then(|last| last.checked_add(count.min(1)));
    length.ok_or(Error::count(
        "count",
        count,
        "no more vectors than memory can hold",
    ))
}

/// # Safety
/// Each pointer of `vectors` is NULL or points to `count` floats, `stride` apart, that live, unchanged, as long as the call.
unsafe fn vectors<'a>(
    name: &'static str,
    vectors: *const StriaeVectors,
    count: usize,
) -> Result<Vectors<'a>> {
    // SAFETY: as promised by the caller.
    let &StriaeVectors { x, y, z, stride } = unsafe { borrowed(name, vectors)? };
    let length = length(name, stride, count)?;
    // SAFETY: as promised by the caller.
    let component = |pointer| unsafe { array([name, "count"], pointer, length) };
    Ok(Vectors {
        x: component(x)?,
        y: component(y)?,
        z: component(z)?,
        stride,
    })
}

/// Vectors that are written, one after another.
struct Written {
    components: [*mut f32; 3],
    stride: usize,
}

impl Written {
    fn new(name: &'static str, vectors: &StriaeVectorsOut, count: usize) -> Result<Self> {
        let &StriaeVectorsOut { x, y, z, stride } = vectors;
        length(name, stride, count)?;
        let components = [x, y, z];
        if count > 0 && components.iter().any(|component| component.is_null()) {
            return Err(Error::text(
                name,
                "NULL",
                "valid pointers (or a count of 0)",
            ));
        }
        Ok(Self { components, stride })
    }

    /// # Safety
    /// `i` is less than the count, and each component has room for as many floats, `stride` apart, as the header asks.
    unsafe fn set(&self, i: usize, vector: [f32; 3]) {
        for (component, value) in self.components.into_iter().zip(vector) {
            // SAFETY: as promised by the caller. No reference is made: components may be interleaved.
            unsafe { component.add(i * self.stride).write(value) };
        }
    }
}

/// Prepared points, and the same number of vectors for each.
struct Points<'a> {
    shadings: &'a [StriaeShading],
    each: usize,
    vectors: Vectors<'a>,
    count: usize,
}

impl<'a> Points<'a> {
    /// # Safety
    /// As [`vectors`]; `shadings` is NULL or points to as many as `count` asks for, written by striae_shade().
    unsafe fn new(
        shadings: *const StriaeShading,
        each: usize,
        (name, pointer): (&'static str, *const StriaeVectors),
        count: usize,
    ) -> Result<Self> {
        if each == 0 {
            return Err(Error::count("per_shading", each, "1 or more"));
        }
        // SAFETY: as promised by the caller.
        let (shadings, vectors) = unsafe {
            (
                array(["shadings", "count"], shadings, count.div_ceil(each))?,
                vectors(name, pointer, count)?,
            )
        };
        Ok(Self {
            shadings,
            each,
            vectors,
            count,
        })
    }

    /// Calls `work` for each point with its own vectors, the number of their first one, and how many they are.
    fn each(
        &self,
        mut work: impl FnMut(&Shading, Vectors<'a>, usize, usize) -> Result<()>,
    ) -> Result<()> {
        for (i, shading) in self.shadings.iter().enumerate() {
            let first = i * self.each;
            let own = self.each.min(self.count - first);
            // SAFETY: written by striae_shade(); a Shading fits and is aligned (asserted beside StriaeShading).
            let shading = unsafe { &*core::ptr::from_ref(shading).cast::<Shading>() };
            work(shading, self.vectors.from(first), first, own)?;
        }
        Ok(())
    }
}

/// striae_shade() for many points. Never allocates, locks or blocks; any number of threads at once.
///
/// All points are prepared, also those that are refused (as striae_shade() does): the status, and striae_last_error(), are
/// those of the first refused one.
///
/// @param pattern the pattern
/// @param points the points
/// @param point_stride bytes from one point to the next: sizeof(StriaePoint) where they are packed
/// @param views directions to the viewer, in each point's local frame, of any length above 0
/// @param count how many points
/// @param shadings receives the results, packed; need not be initialised
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_shade_many(
    pattern: *const StriaePattern,
    points: *const StriaePoint,
    point_stride: usize,
    views: *const StriaeVectors,
    count: usize,
    shadings: *mut StriaeShading,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, views, shadings) = unsafe {
            (
                borrowed("pattern", pattern)?,
                vectors("views", views, count)?,
                exclusive_array(["shadings", "count"], shadings, count)?,
            )
        };
        let least = size_of::<StriaePoint>();
        if point_stride < least || !point_stride.is_multiple_of(align_of::<StriaePoint>()) {
            let accepted = "a multiple of 8, sizeof(StriaePoint) or more";
            return Err(Error::count("point_stride", point_stride, accepted));
        }
        // SAFETY: the first point, as the header asks; none is looked at where there are none.
        unsafe { array(["points", "count"], points, count.min(1))? };
        let mut outcome = Ok(());
        for (i, shading) in shadings.iter_mut().enumerate() {
            // SAFETY: within the array of points, as the header asks.
            let point = unsafe { &*points.byte_add(i * point_stride) };
            // SAFETY: a Shading is made of numbers for which all bits are valid, and fits into a StriaeShading.
            let shading = unsafe { &mut *core::ptr::from_mut(shading).cast::<Shading>() };
            let shaded = shading.shade(&pattern.0, &point.surface_point(), views.get(i));
            let shaded = shaded.and_then(|()| point.check_footprint());
            outcome = outcome.and(shaded.map_err(|error| error.within("points", i)));
        }
        outcome
    })
}

/// striae_eval() for many lights: of one point several times as fast as one by one, and the same within 1e-5. Never allocates,
/// locks or blocks; any number of threads at once.
///
/// @param shadings points filled in by striae_shade() or striae_shade_many(), packed
/// @param per_shading how many lights each point has, 1 or more, one point's after another's: `count` for one point and all
///     lights, 1 for a light of its own for each point
/// @param lights directions to the lights, in the local frame, of any length above 0
/// @param count how many lights in all
/// @param flags 0 for BRDF times cosine, STRIAE_EVAL_BRDF_ONLY for the BRDF alone
/// @param f receives linear RGB for each light; must not overlap the lights
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval_many(
    shadings: *const StriaeShading,
    per_shading: usize,
    lights: *const StriaeVectors,
    count: usize,
    flags: u32,
    f: *const StriaeVectorsOut,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (points, f) = unsafe {
            (
                Points::new(shadings, per_shading, ("lights", lights), count)?,
                Written::new("f", borrowed("f", f)?, count)?,
            )
        };
        let output = output(flags)?;
        points.each(|shading, lights, first, own| {
            shading.eval_many(&lights, own, output, |i, rgb| {
                // SAFETY: less than count, as the header asks.
                unsafe { f.set(first + i, rgb) };
            })
        })
    })
}

/// striae_eval_pdf() for many lights, as striae_eval_many().
///
/// @param shadings points filled in by striae_shade() or striae_shade_many(), packed
/// @param per_shading how many lights each point has, 1 or more, one point's after another's
/// @param lights directions to the lights, in the local frame, of any length above 0
/// @param count how many lights in all
/// @param f receives BRDF times cosine, linear RGB, for each light; must not overlap the lights
/// @param pdf receives the density for each light, per steradian, packed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval_pdf_many(
    shadings: *const StriaeShading,
    per_shading: usize,
    lights: *const StriaeVectors,
    count: usize,
    f: *const StriaeVectorsOut,
    pdf: *mut f32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (points, f, pdf) = unsafe {
            (
                Points::new(shadings, per_shading, ("lights", lights), count)?,
                Written::new("f", borrowed("f", f)?, count)?,
                exclusive_array(["pdf", "count"], pdf, count)?,
            )
        };
        points.each(|shading, lights, first, own| {
            shading.eval_pdf_many(&lights, own, |i, evaluated| {
                // SAFETY: less than count, as the header asks.
                unsafe { f.set(first + i, evaluated.brdf_cos) };
                pdf[first + i] = evaluated.pdf;
            })
        })
    })
}

/// striae_sample() for many numbers: of one point 1.6 times as fast as one by one, and the same within 1e-5. Never
/// allocates, locks or blocks; any number of threads at once.
///
/// @param shadings points filled in by striae_shade() or striae_shade_many(), packed
/// @param per_shading how many samples each point has, 1 or more, one point's after another's
/// @param u three numbers from 0 up to (not including) 1 for each sample
/// @param count how many samples in all
/// @param samples receives them; must not overlap `u`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_sample_many(
    shadings: *const StriaeShading,
    per_shading: usize,
    u: *const StriaeVectors,
    count: usize,
    samples: *const StriaeSamplesOut,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (points, samples) = unsafe {
            (
                Points::new(shadings, per_shading, ("u", u), count)?,
                borrowed("samples", samples)?,
            )
        };
        let lights = Written::new("samples.light", &samples.light, count)?;
        let weights = Written::new("samples.weight", &samples.weight, count)?;
        // SAFETY: NULL or valid, as the header asks; lobes may be left out.
        let (pdf, lobe) = unsafe {
            let lobes = if samples.lobe.is_null() { 0 } else { count };
            (
                exclusive_array(["samples.pdf", "count"], samples.pdf, count)?,
                exclusive_array(["samples.lobe", "count"], samples.lobe, lobes)?,
            )
        };
        points.each(|shading, u, first, own| {
            shading.sample_many(&u, own, |i, sample| {
                let sample = StriaeSample::from(sample);
                // SAFETY: less than count, as the header asks.
                unsafe {
                    lights.set(first + i, sample.light);
                    weights.set(first + i, sample.weight);
                }
                pdf[first + i] = sample.pdf;
                if let Some(lobe) = lobe.get_mut(first + i) {
                    *lobe = sample.lobe;
                }
            })
        })
    })
}

/// Lets all threads use SIMD instructions where the processor has them (so it is at the start), or keeps them from it, to
/// measure and to compare: results agree within 1e-5.
///
/// @param allowed 0 or 1
#[unsafe(no_mangle)]
pub extern "C" fn striae_set_simd(allowed: u32) -> StriaeStatus {
    guard(|| match allowed {
        0 | 1 => {
            set_simd(allowed == 1);
            Ok(())
        }
        other => Err(Error::number("allowed", f64::from(other), "0 or 1")),
    })
}

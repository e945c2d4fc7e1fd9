//! Shading for C.

use super::handle::{borrowed, exclusive};
use super::pattern::StriaePattern;
use super::status::{StriaeStatus, guard};
use crate::error::{Error, Result};
use crate::pattern::{Footprint, Frame, SurfacePoint};
use crate::scattering::{Output, Shading};
use glam::Vec3;

/// What a pixel covers of the surface around a point.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeFootprint {
    /// Nothing but the point itself.
    Point = 0,
    /// A square along x and y that reaches `radius` scene units from the point on each side.
    Radius = 1,
    /// The parallelogram centred on the point with edges `duv_dx` and `duv_dy`.
    Differentials = 2,
}

/// Flag of striae_eval(): the BRDF alone, without the cosine between light and normal.
pub const STRIAE_EVAL_BRDF_ONLY: u32 = 1;

/// A point of a scratched surface. `dp_du`, `dp_dv` and `normal` are in any one frame of the renderer's, world space say. A
/// footprint is below 1e12 mm long.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaePoint {
    /// Texture coordinates: any finite numbers, not wrapped.
    pub uv: [f64; 2],
    /// Derivative of position by u, scene units. It and `dp_dv` span the tangent plane, at any angle and either way round.
    pub dp_du: [f32; 3],
    /// Derivative of position by v, scene units.
    pub dp_dv: [f32; 3],
    /// Surface normal, of any length above 0.
    pub normal: [f32; 3],
    /// A StriaeFootprint; fields that it does not name are ignored.
    pub footprint: u32,
    /// STRIAE_FOOTPRINT_RADIUS: scene units, above 0.
    pub radius: f32,
    /// STRIAE_FOOTPRINT_DIFFERENTIALS: change of (u, v) by one pixel in x.
    pub duv_dx: [f32; 2],
    /// STRIAE_FOOTPRINT_DIFFERENTIALS: change of (u, v) by one pixel in y. One of both may be 0, as an edge of a line.
    pub duv_dy: [f32; 2],
}

/// A point's local frame in the renderer's: z is the unit normal, x is dp_du made orthogonal to it, y is z cross x.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeFrame {
    /// Along dp_du.
    pub x: [f32; 3],
    /// z cross x.
    pub y: [f32; 3],
    /// The normal.
    pub z: [f32; 3],
}

/// A point seen from one direction: plain data, 8 KiB at most, on the caller's stack. It need not be initialised, owns
/// nothing, outlives its pattern, and may be copied and read by any thread. Write to none of it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeShading {
    /// How much of what the pixel shows belongs to scratches, as seen from `view`, 0 to 1.
    pub coverage: f32,
    /// How many scratches run through the footprint, those included that later ones cut away. Where they are too many to be
    /// looked at one by one, how many cross-sections and directions they were summed up by.
    pub scratch_count: u32,
    /// The library's own.
    pub opaque: [u64; 1023],
}

const _: () = assert!(
    size_of::<Shading>() <= size_of::<StriaeShading>()
        && align_of::<Shading>() <= align_of::<StriaeShading>(),
    "the C structure must hold a Shading"
);

const _: () = assert!(
    size_of::<StriaeShading>() <= 8192,
    "it lives on small stacks"
);

impl StriaePoint {
    /// The point as the library has it; without a known footprint it is a point.
    #[inline(always)]
    pub(super) fn surface_point(&self) -> SurfacePoint {
        let &Self {
            uv,
            dp_du,
            dp_dv,
            normal,
            ..
        } = self;
        let footprint = match self.footprint {
            1 => Footprint::Radius(self.radius),
            2 => {
                let (duv_dx, duv_dy) = (self.duv_dx, self.duv_dy);
                Footprint::Differentials { duv_dx, duv_dy }
            }
            _ => Footprint::Point,
        };
        SurfacePoint {
            uv,
            dp_du,
            dp_dv,
            normal,
            footprint,
        }
    }

    /// Fails where its footprint is none that is known.
    pub(super) fn check_footprint(&self) -> Result<()> {
        if self.footprint <= StriaeFootprint::Differentials as u32 {
            return Ok(());
        }
        let accepted = "a StriaeFootprint, 0 to 2";
        Err(Error::number(
            "footprint",
            f64::from(self.footprint),
            accepted,
        ))
    }
}

impl From<Frame> for StriaeFrame {
    fn from(Frame { x, y, z }: Frame) -> Self {
        Self {
            x: x.to_array(),
            y: y.to_array(),
            z: z.to_array(),
        }
    }
}

impl From<&StriaeFrame> for Frame {
    fn from(frame: &StriaeFrame) -> Self {
        Self {
            x: Vec3::from(frame.x),
            y: Vec3::from(frame.y),
            z: Vec3::from(frame.z),
        }
    }
}

/// A prepared point.
///
/// # Safety
/// `shading` is NULL or was written by striae_shade().
pub(super) unsafe fn prepared<'a>(shading: *const StriaeShading) -> Result<&'a Shading> {
    // SAFETY: as promised by the caller; a Shading fits (asserted above).
    unsafe { borrowed("shading", shading.cast::<Shading>()) }
}

/// A direction, or numbers that choose one.
///
/// # Safety
/// `vector` is NULL or points to three numbers.
pub(super) unsafe fn vector(name: &'static str, vector: *const f32) -> Result<[f32; 3]> {
    // SAFETY: as promised by the caller.
    unsafe { borrowed(name, vector.cast::<[f32; 3]>()) }.copied()
}

/// Asks a prepared point a question, and writes the answer.
///
/// # Safety
/// `shading` is NULL or was written by striae_shade(); `out` is NULL or writable.
pub(super) unsafe fn ask<T>(
    shading: *const StriaeShading,
    (name, out): (&'static str, *mut T),
    question: impl FnOnce(&Shading) -> Result<T>,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: as promised by the caller.
        let answer = question(unsafe { prepared(shading)? })?;
        // SAFETY: the same.
        *unsafe { exclusive(name, out)? } = answer;
        Ok(())
    })
}

/// A point's local frame, in which `view` and `light` are given. Allocates nothing.
///
/// @param point its normal and dp_du count. Without a usable dp_du (zero, or along the normal) x is any tangent.
/// @param frame is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_frame(
    point: *const StriaePoint,
    frame: *mut StriaeFrame,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (point, frame) = unsafe { (borrowed("point", point)?, exclusive("frame", frame)?) };
        *frame = Frame::of(point.normal, point.dp_du)?.into();
        Ok(())
    })
}

/// Turns a vector of the renderer's frame into the local one. Allocates nothing.
///
/// @param frame filled in by striae_frame()
/// @param world the vector, of any length
/// @param local receives it; may be `world` itself
/// cbindgen:ptrs-as-arrays=[[world;3], [local;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_frame_to_local(
    frame: *const StriaeFrame,
    world: *const f32,
    local: *mut f32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks; `world` is copied before `local` is borrowed.
        let (frame, world) = unsafe {
            (
                borrowed("frame", frame)?,
                *borrowed("world", world.cast::<[f32; 3]>())?,
            )
        };
        let turned = Frame::from(frame).to_local(Vec3::from(world));
        // SAFETY: NULL or writable, as the header asks.
        *unsafe { exclusive("local", local.cast::<[f32; 3]>())? } = turned.to_array();
        Ok(())
    })
}

/// Turns a vector of the local frame into the renderer's. Allocates nothing.
///
/// @param frame filled in by striae_frame()
/// @param local the vector, of any length
/// @param world receives it; may be `local` itself
/// cbindgen:ptrs-as-arrays=[[local;3], [world;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_frame_to_world(
    frame: *const StriaeFrame,
    local: *const f32,
    world: *mut f32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks; `local` is copied before `world` is borrowed.
        let (frame, local) = unsafe {
            (
                borrowed("frame", frame)?,
                *borrowed("local", local.cast::<[f32; 3]>())?,
            )
        };
        let turned = Frame::from(frame).to_world(Vec3::from(local));
        // SAFETY: NULL or writable, as the header asks.
        *unsafe { exclusive("world", world.cast::<[f32; 3]>())? } = turned.to_array();
        Ok(())
    })
}

/// Prepares a point for one viewing direction: finds the scratches in its footprint and all that does not
/// depend on the light. Never allocates, locks or blocks; any number of threads at once. 256 KiB of stack suffice.
///
/// A point that is refused leaves a shading that can be used all the same, so that a render goes on: a view that
/// is no direction reflects nothing; a bad normal, uv or derivative gives the unscratched surface; a
/// footprint of zero, infinite or NaN size counts as a point. Only with a NULL argument is nothing written.
/// A view below the surface is no error: it reflects nothing. Where a surface is to be seen from both sides, turn its normal
/// to the viewer's side.
///
/// @param pattern the pattern
/// @param point the point
/// @param view direction to the viewer, away from the surface, in the local frame, of any length above 0
/// @param shading receives the result; need not be initialised. Shading into it again replaces what it held
/// cbindgen:ptrs-as-arrays=[[view;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_shade(
    pattern: *const StriaePattern,
    point: *const StriaePoint,
    view: *const f32,
    shading: *mut StriaeShading,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks. A Shading is made of numbers for which all bits
        // are valid, and fits into a StriaeShading (asserted above).
        let (pattern, point, view, shading) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("point", point)?,
                *borrowed("view", view.cast::<[f32; 3]>())?,
                exclusive("shading", shading.cast::<Shading>())?,
            )
        };
        shading.shade(&pattern.0, &point.surface_point(), view)?;
        point.check_footprint()
    })
}

/// striae_frame() and striae_shade() in one, for a view in the renderer's frame. Never allocates, locks or blocks; any number
/// of threads at once. 256 KiB of stack suffice.
///
/// A point that is refused can be used as after striae_shade(); but a bad normal has no frame: it reflects nothing, and the
/// frame is all zeros, which no light has a direction in.
///
/// @param pattern the pattern
/// @param point the point
/// @param view direction to the viewer, away from the surface, in the renderer's frame, of any length above 0
/// @param frame receives the point's local frame
/// @param shading receives the result; need not be initialised. Shading into it again replaces what it held
/// cbindgen:ptrs-as-arrays=[[view;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_shade_world(
    pattern: *const StriaePattern,
    point: *const StriaePoint,
    view: *const f32,
    frame: *mut StriaeFrame,
    shading: *mut StriaeShading,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks; a Shading as in striae_shade().
        let (pattern, point, view, frame, shading) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("point", point)?,
                *borrowed("view", view.cast::<[f32; 3]>())?,
                exclusive("frame", frame)?,
                exclusive("shading", shading.cast::<Shading>())?,
            )
        };
        let surface_point = point.surface_point();
        let own = match Frame::of(point.normal, point.dp_du) {
            Ok(own) => own,
            Err(error) => {
                *frame = Frame::NONE.into();
                // No view has a direction in it either.
                let _refused = shading.shade(&pattern.0, &surface_point, [0.0; 3]);
                return Err(error);
            }
        };
        *frame = own.into();
        let view = own.to_local(Vec3::from(view)).to_array();
        shading.shade(&pattern.0, &surface_point, view)?;
        point.check_footprint()
    })
}

/// Evaluates a prepared point for one light. Never allocates, locks or blocks; any number of threads at once.
///
/// @param shading filled in by striae_shade()
/// @param light direction to the light, away from the surface, in the local frame, of any length above 0. From
///     below the surface, or with no direction (NaN, zero), f is 0.
/// @param flags 0 for BRDF times cosine, STRIAE_EVAL_BRDF_ONLY for the BRDF alone
/// @param f receives linear RGB, never negative, never NaN
/// cbindgen:ptrs-as-arrays=[[light;3], [f;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval(
    shading: *const StriaeShading,
    light: *const f32,
    flags: u32,
    f: *mut f32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("f", f.cast::<[f32; 3]>()), |shading| {
            let light = vector("light", light)?;
            Ok(shading.eval(light, output(flags)?))
        })
    }
}

/// As striae_eval(), with the light in the renderer's frame.
///
/// @param shading filled in by striae_shade_world(), or striae_shade()
/// @param frame the point's, from the same call, or striae_frame()
/// @param light direction to the light, away from the surface, in the renderer's frame, of any length above 0
/// @param flags as for striae_eval()
/// @param f receives linear RGB, never negative, never NaN
/// cbindgen:ptrs-as-arrays=[[light;3], [f;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_eval_world(
    shading: *const StriaeShading,
    frame: *const StriaeFrame,
    light: *const f32,
    flags: u32,
    f: *mut f32,
) -> StriaeStatus {
    // SAFETY: each is NULL or valid, as the header asks.
    unsafe {
        ask(shading, ("f", f.cast::<[f32; 3]>()), |shading| {
            let frame = Frame::from(borrowed("frame", frame)?);
            let light = frame.to_local(Vec3::from(vector("light", light)?));
            Ok(shading.eval(light.to_array(), output(flags)?))
        })
    }
}

pub(super) fn output(flags: u32) -> Result<Output> {
    match flags {
        0 => Ok(Output::BrdfCos),
        STRIAE_EVAL_BRDF_ONLY => Ok(Output::Brdf),
        other => {
            let accepted = "0 or STRIAE_EVAL_BRDF_ONLY";
            Err(Error::number("flags", f64::from(other), accepted))
        }
    }
}

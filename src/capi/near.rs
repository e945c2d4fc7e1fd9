//! Whether there is anything to shade, for C.

use super::handle::{borrowed, exclusive};
use super::pattern::StriaePattern;
use super::shading::StriaePoint;
use super::status::{StriaeStatus, guard};

/// Whether scratches may matter at a point: for renderers that shade the unscratched surface themselves, and then need neither
/// striae_shade() nor striae_eval() where none is near. Refuses nothing but NULL. Never allocates, locks or blocks; any number of
/// threads at once.
///
/// Where it says no, striae_shade() finds no scratch there, and the point reflects what the pattern's surface material
/// does. Where it says yes there may be none all the same; so it does of most points that striae_shade() refuses.
///
/// @param pattern the pattern
/// @param point the point
/// @param view direction to the viewer, away from the surface, in the renderer's frame (that of the point's normal), of any
///     length above 0. NULL asks for all views at once, as if it were a grazing one
/// @param is_near receives 1 or 0
/// cbindgen:ptrs-as-arrays=[[view;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_near(
    pattern: *const StriaePattern,
    point: *const StriaePoint,
    view: *const f32,
    is_near: *mut u32,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks; a view may be left out.
        let (pattern, point, view, is_near) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("point", point)?,
                view.cast::<[f32; 3]>().as_ref().copied(),
                exclusive("is_near", is_near)?,
            )
        };
        *is_near = u32::from(pattern.0.is_near(&point.surface_point(), view));
        Ok(())
    })
}

//! Meshes that paths are drawn on, for C.

use super::handle::{array, make_shared, release, retain};
use super::status::{StriaeStatus, guard};
use crate::pattern::Surface;

/// A triangle mesh with texture coordinates, for paths that are drawn on it. Immutable; any thread may use it;
/// reference-counted.
#[derive(Debug)]
pub struct StriaeSurface(pub(super) Surface);

/// Makes a surface of a triangle mesh. Where texture space has a seam the vertices are there twice, as renderers have
/// them: those at exactly the same position count as one place of the surface. Either winding will do, also a
/// mixture; charts may be mirrored. Triangles without area, in space or in texture space, are left out.
///
/// @param positions vertex_count positions, scene units, each coordinate -1e7 to 1e7; copied
/// @param uv vertex_count texture coordinates, -1e9 to 1e9; copied
/// @param vertex_count how many vertices
/// @param triangles triangle_count times three vertex indices; copied
/// @param triangle_count how many triangles, below 2^32; one or more must have area
/// @param surface receives a handle to release with striae_surface_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_surface_new(
    positions: *const [f64; 3],
    uv: *const [f64; 2],
    vertex_count: usize,
    triangles: *const [u32; 3],
    triangle_count: usize,
    surface: *mut *mut StriaeSurface,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid for what it counts, as the header asks.
        let (positions, uv, triangles) = unsafe {
            (
                array(["positions", "vertex_count"], positions, vertex_count)?,
                array(["uv", "vertex_count"], uv, vertex_count)?,
                array(["triangles", "triangle_count"], triangles, triangle_count)?,
            )
        };
        Surface::new(positions, uv, triangles).map(StriaeSurface)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("surface", surface, make) })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_surface_retain(surface: *const StriaeSurface) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(surface) }
}

/// Drops a reference; the last one frees the surface. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_surface_release(surface: *const StriaeSurface) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(surface) }
}

//! The scratched surface as triangles, for C.

use super::brdf::StriaeBrdf;
use super::handle::{borrowed, exclusive, make_shared, release, retain};
use super::pattern::StriaePattern;
use super::status::{StriaeStatus, check_struct_size, guard};
use crate::error::Error;
use crate::pattern::{MeshRegion, MeshZone, ReliefMesh};

/// A triangle's `scratch` on the unscratched surface.
pub const STRIAE_NO_SCRATCH: u32 = u32::MAX;

const _: () = assert!(
    STRIAE_NO_SCRATCH == MeshZone::NO_SCRATCH,
    "both say that there is none"
);

/// What part of a pattern becomes triangles, and how closely. Set struct_size to sizeof(StriaeMeshRegion).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeMeshRegion {
    /// sizeof(StriaeMeshRegion)
    pub struct_size: usize,
    /// The rectangle's lowest (u, v), -1e9 to 1e9.
    pub low_uv: [f64; 2],
    /// Its highest (u, v), above the lowest.
    pub high_uv: [f64; 2],
    /// How far the triangles may stray from the relief, mm, 1e-9 to 1000: along straight scratches of steady force they
    /// do not.
    pub tolerance_mm: f64,
    /// Thickness of the plate, mm: 0 for an open surface that ends at the rectangle's border; otherwise, up to 1e6 and more
    /// than the deepest scratch, the triangles close around a solid.
    pub base_mm: f64,
}

/// What a triangle is a part of.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeMeshZone {
    /// Number of its scratch in order of adding, from 0; STRIAE_NO_SCRATCH on the unscratched surface.
    pub scratch: u32,
    /// Number of its base BRDF: striae_relief_mesh_brdf().
    pub brdf: u32,
    /// Unit direction of the scratch's travel in x and y, along which polishing lines run; along x on the unscratched
    /// surface.
    pub travel: [f32; 2],
}

const _: () = assert!(
    size_of::<StriaeMeshZone>() == size_of::<MeshZone>()
        && align_of::<StriaeMeshZone>() == align_of::<MeshZone>()
        && core::mem::offset_of!(StriaeMeshZone, scratch)
            == core::mem::offset_of!(MeshZone, scratch)
        && core::mem::offset_of!(StriaeMeshZone, brdf) == core::mem::offset_of!(MeshZone, brdf)
        && core::mem::offset_of!(StriaeMeshZone, travel) == core::mem::offset_of!(MeshZone, travel),
    "the C structure must be the library's own"
);

/// A mesh's arrays: its own, valid until it is freed. Set struct_size to sizeof(StriaeMeshArrays).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeMeshArrays {
    /// sizeof(StriaeMeshArrays)
    pub struct_size: usize,
    /// (x, y, z) of each vertex, mm: x and y are u and v to the scale of the pattern's units_per_uv, z is up from the
    /// unscratched surface.
    pub positions: *const [f64; 3],
    /// How many vertices.
    pub vertex_count: usize,
    /// Three vertices of each triangle, counter-clockwise from outside.
    pub triangles: *const [u32; 3],
    /// What each triangle is a part of.
    pub zones: *const StriaeMeshZone,
    /// How many triangles.
    pub triangle_count: usize,
    /// How many base BRDFs; number 0 is the unscratched surface's.
    pub brdf_count: usize,
}

/// A region's relief as triangles. Immutable; any thread may use it; reference-counted.
#[derive(Debug)]
pub struct StriaeReliefMesh(pub(super) ReliefMesh);

/// Makes triangles of a region of a pattern, with nothing filtered or summed up: what shading is measured against, and what
/// programs without this library can use. It takes time and memory, some microseconds and a kilobyte for each triangle.
///
/// The mesh is watertight: each edge belongs to two triangles, but for those on the border of an open surface. Where a later
/// scratch cuts an earlier one, and between the facets that close a hard end, heights jump: there walls stand upright, so
/// that all else stays where it is. They count as a part of the later scratch.
///
/// @param pattern the pattern
/// @param region which part, and how closely
/// @param mesh receives a handle to release with striae_relief_mesh_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh(
    pattern: *const StriaePattern,
    region: *const StriaeMeshRegion,
    mesh: *mut *mut StriaeReliefMesh,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, region) =
            unsafe { (borrowed("pattern", pattern)?, borrowed("region", region)?) };
        let own = size_of::<StriaeMeshRegion>();
        check_struct_size(region.struct_size, own, "sizeof(StriaeMeshRegion)")?;
        let region = MeshRegion {
            low_uv: region.low_uv,
            high_uv: region.high_uv,
            tolerance_mm: region.tolerance_mm,
            base_mm: region.base_mm,
        };
        pattern.0.relief_mesh(&region).map(StriaeReliefMesh)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("mesh", mesh, make) })
}

/// Tells a mesh's arrays.
///
/// @param mesh the mesh
/// @param arrays with struct_size set; the rest is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh_arrays(
    mesh: *const StriaeReliefMesh,
    arrays: *mut StriaeMeshArrays,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (mesh, arrays) = unsafe { (borrowed("mesh", mesh)?, exclusive("arrays", arrays)?) };
        let own = size_of::<StriaeMeshArrays>();
        check_struct_size(arrays.struct_size, own, "sizeof(StriaeMeshArrays)")?;
        let mesh = &mesh.0;
        *arrays = StriaeMeshArrays {
            struct_size: own,
            positions: mesh.positions.as_ptr(),
            vertex_count: mesh.positions.len(),
            triangles: mesh.triangles.as_ptr(),
            // A MeshZone has the same layout (asserted above).
            zones: mesh.zones.as_ptr().cast(),
            triangle_count: mesh.triangles.len(),
            brdf_count: mesh.brdfs.len(),
        };
        Ok(())
    })
}

/// A base BRDF of a mesh's zones, as the material had it but for rounding.
///
/// @param mesh the mesh
/// @param number below the arrays' brdf_count; 0 is the unscratched surface's
/// @param brdf receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh_brdf(
    mesh: *const StriaeReliefMesh,
    number: u32,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (mesh, brdf) = unsafe { (borrowed("mesh", mesh)?, exclusive("brdf", brdf)?) };
        let Some(found) = mesh.0.brdfs.get(number as usize) else {
            let accepted = "a number below the arrays' brdf_count";
            return Err(Error::number("number", f64::from(number), accepted));
        };
        *brdf = (*found).into();
        Ok(())
    })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh_retain(mesh: *const StriaeReliefMesh) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(mesh) }
}

/// Drops a reference; the last one frees the mesh. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_relief_mesh_release(mesh: *const StriaeReliefMesh) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(mesh) }
}

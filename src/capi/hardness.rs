//! Hardness maps for C.

use super::handle::{array, make_shared, release, retain};
use super::status::{StriaeStatus, guard};
use crate::error::Error;
use crate::formation::{HardnessMap, Reading};

/// Hardness that varies over a surface. Immutable; any thread may use it; reference-counted.
#[derive(Debug)]
pub struct StriaeHardnessMap(pub(super) HardnessMap);

/// One indentation: where it was made and what it gave.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeReading {
    /// Texture coordinates, -1e9 to 1e9.
    pub uv: [f64; 2],
    /// Vickers hardness, kgf/mm², 0.01 to 20000.
    pub hardness_hv: f64,
}

/// Makes a hardness map from a texture over u and v from 0 to 1: bilinear between texel centres, clamped beyond.
///
/// @param values width times height values, row by row, the first row at v = 1 (as images are stored)
/// @param width texels in a row, 1 or more
/// @param height rows, 1 or more; width times height is 2^28 at most
/// @param from_hv hardness that a value of 0 means, 0.01 to 20000
/// @param to_hv hardness that a value of 1 means, 0.01 to 20000; every value must lead into that range
/// @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_hardness_map_texture(
    values: *const f32,
    width: usize,
    height: usize,
    from_hv: f64,
    to_hv: f64,
    map: *mut *mut StriaeHardnessMap,
) -> StriaeStatus {
    let make = || {
        let count =
            width
                .checked_mul(height)
                .ok_or(Error::count("width", width, "2^28 texels at most"))?;
        // SAFETY: NULL or width times height values, as the header asks.
        let values = unsafe { array(["values", "width x height"], values, count)? };
        HardnessMap::texture(values, width, height, [from_hv, to_hv]).map(StriaeHardnessMap)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("map", map, make) })
}

/// Makes a hardness map from indentation readings: natural-neighbour interpolation, clamped outside their hull.
///
/// @param readings one or more, anywhere; of several at the same place the last counts
/// @param reading_count 1 to 10000000
/// @param map receives a handle to release with striae_hardness_map_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_hardness_map_readings(
    readings: *const StriaeReading,
    reading_count: usize,
    map: *mut *mut StriaeHardnessMap,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or `reading_count` readings, as the header asks.
        let readings = unsafe { array(["readings", "reading_count"], readings, reading_count)? };
        let reading = |r: &StriaeReading| Reading {
            uv: r.uv,
            hardness_hv: r.hardness_hv,
        };
        let readings: Vec<Reading> = readings.iter().map(reading).collect();
        HardnessMap::readings(&readings).map(StriaeHardnessMap)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("map", map, make) })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_hardness_map_retain(map: *const StriaeHardnessMap) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(map) }
}

/// Drops a reference; the last one frees the map. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_hardness_map_release(map: *const StriaeHardnessMap) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(map) }
}

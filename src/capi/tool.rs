//! Tools for C.

use super::handle::{array, make_shared, release, retain};
use super::status::{StriaeStatus, guard};
use crate::error::Error;
use crate::formation::Tool;

/// A scratching tool. Immutable; any thread may use it; reference-counted.
#[derive(Debug)]
pub struct StriaeTool(pub(super) Tool);

/// Tools by name. Where no standard is named, none gives the sizes: they are typical ones of our choosing. No scratch may be
/// deeper than its tool is tall: 2 to 5 mm, the square graver 1.69 mm, the grain 0.125 mm.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeToolPreset {
    /// The diamond of scratch testers: a 120 degree cone with a 0.2 mm tip radius (ISO 6508-2).
    RockwellC = 0,
    /// A square pyramid, 136 degrees between opposite faces (ISO 6507-2). As it stands a face leads; spun by
    /// 45 degrees an edge does.
    Vickers = 1,
    /// A wire nail's point: a cone of 50 degrees in all, blunted to 0.1 mm.
    Nail = 2,
    /// A slotted screwdriver, blade 0.8 x 4 mm (a size of ISO 2380-1), its edge across the travel.
    Screwdriver = 3,
    /// A three-sided pyramid, faces at 65.27 degrees to the axis (ISO 14577-2).
    Berkovich = 4,
    /// A scriber: a 30 degree point, sharp to 0.05 mm.
    Scriber = 5,
    /// A square graver: a 90 degree keel on a 2.4 mm bar.
    SquareGraver = 6,
    /// A round graver: a keel 0.6 mm wide, half a circle.
    RoundGraver = 7,
    /// A flat graver: an edge 0.6 mm wide.
    FlatGraver = 8,
    /// A needle's point: 20 degrees in all, tip radius 0.02 mm.
    Needle = 9,
    /// The worn corner of a key: 90 degrees, tip radius 0.15 mm.
    Key = 10,
    /// A corner of an abrasive grain, 0.125 mm across (the mean of FEPA P120), sharp.
    AbrasiveGrain = 11,
}

/// Makes a cone whose tip is rounded by a sphere.
///
/// @param half_angle_deg angle between flank and axis, 5 to 85
/// @param tip_radius_mm 0 (sharp) to 100
/// @param height_mm 1e-6 to 1000, and taller than the rounded tip; no scratch may be deeper
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_sphero_cone(
    half_angle_deg: f64,
    tip_radius_mm: f64,
    height_mm: f64,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || Tool::sphero_cone(half_angle_deg, tip_radius_mm, height_mm).map(StriaeTool);
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Makes a pyramid, corners at azimuths 360 degrees (i + 1/2) / sides from the right of travel, counter-clockwise.
///
/// @param sides 3 to 64
/// @param angle_deg between opposite faces (each stands at half of it to the axis), 10 to 170
/// @param height_mm 1e-6 to 1000
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_pyramid(
    sides: u32,
    angle_deg: f64,
    height_mm: f64,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || Tool::pyramid(sides, angle_deg, height_mm).map(StriaeTool);
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Makes a wedge: a straight edge across the travel, two faces meeting in it, flat upright ends.
///
/// @param width_mm length of the edge, 1e-6 to 1000
/// @param angle_deg between the faces, 1 to 170
/// @param height_mm 1e-6 to 1000
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_wedge(
    width_mm: f64,
    angle_deg: f64,
    height_mm: f64,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || Tool::wedge(width_mm, angle_deg, height_mm).map(StriaeTool);
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Makes a tool from a triangle mesh. Any mesh will do: non-convex, open, unoriented. z points up, the tip down.
///
/// The lowest point (the middle, if several are lowest) becomes the tip. Where the mesh leans over its own foot, the
/// groove's wall stands upright. From 1e-6 to 1e4 mm across.
///
/// @param positions position_count vertices x, y, z, in units of mm_per_unit; copied
/// @param position_count 1 to 50000000
/// @param triangles triangle_count times three indices into positions; copied
/// @param triangle_count 1 to 50000000
/// @param mm_per_unit 1e-9 to 1e9: 1 for mm, 25.4 for inches, 1000 for metres
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_mesh(
    positions: *const [f64; 3],
    position_count: usize,
    triangles: *const [u32; 3],
    triangle_count: usize,
    mm_per_unit: f64,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or an array of that many, as the header asks.
        let positions =
            unsafe { array(["positions", "position_count"], positions, position_count) }?;
        // SAFETY: likewise.
        let triangles =
            unsafe { array(["triangles", "triangle_count"], triangles, triangle_count) }?;
        Tool::mesh(positions, triangles, mm_per_unit).map(StriaeTool)
    };
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Makes a flat sheet across the travel, such as a ground scraper, from its lower edge. Its lowest point becomes the
/// tip. From 1e-6 to 1e4 mm across.
///
/// @param points_mm point_count corners of the edge in order, x to the right of travel, z up; copied
/// @param point_count 2 to 50000000
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_profile(
    points_mm: *const [f64; 2],
    point_count: usize,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or an array of that many, as the header asks.
        let points_mm = unsafe { array(["points_mm", "point_count"], points_mm, point_count) }?;
        Tool::profile(points_mm).map(StriaeTool)
    };
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Makes a tool by name. From a 3D model: striae_tool_load().
///
/// @param preset a StriaeToolPreset
/// @param tool receives a handle to release with striae_tool_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_preset(
    preset: u32,
    tool: *mut *mut StriaeTool,
) -> StriaeStatus {
    const ALL: [fn() -> Tool; 12] = [
        Tool::rockwell_c,
        Tool::vickers,
        Tool::nail,
        Tool::screwdriver,
        Tool::berkovich,
        Tool::scriber,
        Tool::square_graver,
        Tool::round_graver,
        Tool::flat_graver,
        Tool::needle,
        Tool::key,
        Tool::abrasive_grain,
    ];
    let make = || {
        let accepted = "a StriaeToolPreset, 0 to 11";
        let known = ALL.get(preset as usize);
        known.map(|make| StriaeTool(make())).ok_or(Error::number(
            "preset",
            f64::from(preset),
            accepted,
        ))
    };
    // SAFETY: `tool` is NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("tool", tool, make) })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_retain(tool: *const StriaeTool) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(tool) }
}

/// Drops a reference; the last one frees the tool. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_tool_release(tool: *const StriaeTool) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(tool) }
}

//! Patterns for C.

use super::cross_section::depth_law;
use super::handle::{array, borrowed, exclusive, make_shared, release, retain};
use super::hardness::StriaeHardnessMap;
use super::material::StriaeMaterial;
use super::status::{StriaeStatus, check_struct_size, guard};
use super::surface::StriaeSurface;
use super::tool::StriaeTool;
use crate::error::{Error, Result};
use crate::formation::{Material, Orientation};
use crate::pattern::{Held, Key, Path, Pattern, PatternBuilder, Scratch, Spline, SplineKind};

/// Kinds of path: what its points mean, and how many there must be.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeCurve {
    /// Straight lines from point to point: two points or more. Closed (three or more), the last joins the first.
    Polyline = 0,
    /// Cubic Bezier curves, each starting where the last ends: 3 n + 1 points. Closed, the last one ends at the first
    /// point: 3 n points.
    CubicBezier = 1,
    /// A smooth curve through all points, two or more, closed three or more: the centripetal Catmull-Rom spline, which
    /// neither loops nor overshoots between unevenly spaced points. An open one sets out straight towards its
    /// second point, and arrives likewise. Points that repeat the one before count once.
    CatmullRom = 2,
    /// A uniform cubic B-spline, smooth to its curvature, led by its points and passing through none: four or more;
    /// open, n points give n - 3 curves and both ends lie inside. Closed it is periodic: three or more.
    BSpline = 3,
    /// A cubic B-spline with `knots`. Open: n points, four or more, and n + 4 knots, never descending; the curve runs
    /// from knots[3] to knots[n], clamped to its first and last point where these knots are there four times. (Programs
    /// that state n + 2 knots leave out the first and the last, which move nothing: repeat their neighbours.)
    /// Between the ends a knot may be there three times at most: three times is a corner. Closed it is periodic: n
    /// points, three or more, and n + 1 knots, from the first to its repetition one round later; of a periodic
    /// curve told as an open one, its first three points repeated at its end, leave out those three and the last
    /// six knots.
    NonUniformBSpline = 4,
}

/// What a scratch's spin and azimuth are relative to.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeHeld {
    /// The direction of travel: the hand turns with the path. Azimuth 0 leans forward, 90 to the left.
    ToPath = 0,
    /// The surface: the hand does not turn while the path does. Azimuth 0 leans towards u, 90 towards v.
    ToSurface = 1,
}

/// Force and orientation at one place along a scratch.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeKey {
    /// Share of the path's arc length, 0 to 1, not below the key before.
    pub at: f64,
    /// Normal force, kgf, 0 to 100000: does not count under STRIAE_DEPTH_LAW_STATED.
    pub force_kgf: f64,
    /// Depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
    pub depth_mm: f64,
    /// Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
    pub spin_deg: f64,
    /// Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
    pub tilt_deg: f64,
    /// Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
    pub azimuth_deg: f64,
}

/// One scratch: a tool drawn along a path. Set struct_size to sizeof(StriaeScratch). A scratch ends hard, with the tool's
/// own print, where it is pressed at an open end, and runs out softly where force or depth are 0 there.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeScratch {
    /// sizeof(StriaeScratch)
    pub struct_size: usize,
    /// The tool; the pattern keeps what it needs of it.
    pub tool: *const StriaeTool,
    /// Another hardness and finish than the surface's for this scratch; NULL for the surface's own.
    pub material: *const StriaeMaterial,
    /// A StriaeCurve.
    pub curve: u32,
    /// A StriaeDepthLaw.
    pub depth_law: u32,
    /// A StriaeHeld.
    pub held: u32,
    /// The path's points in texture space, (u, v) each, -1e9 to 1e9; not read with a surface.
    pub points_uv: *const [f64; 2],
    /// How many points, `points_uv` or `points_xyz`: StriaeCurve says how many there must be.
    pub point_count: usize,
    /// Force and orientation along the path, ascending in `at`: linear in arc length between keys, constant
    /// before the first and after the last.
    pub keys: *const StriaeKey,
    /// How many keys, 1 or more.
    pub key_count: usize,
    /// 1: the path ends where it begins; 0: it has two ends.
    pub closed: u32,
    /// Knots of a STRIAE_CURVE_NON_UNIFORM_B_SPLINE, -1e9 to 1e9; NULL for other curves.
    pub knots: *const f64,
    /// How many knots; 0 for other curves.
    pub knot_count: usize,
    /// NULL: the path is `points_uv`. Otherwise the mesh that it is drawn on: `points_xyz`, in space near the
    /// mesh, as in a modeller. The path is the curve's closest points on the mesh, its arc length that on the mesh;
    /// it goes on where texture space has a seam or passes to another chart, mirrored or not. Where it leaves an
    /// open mesh by more than a tenth of a triangle there is no path; arc length goes on where it comes back. Where
    /// the closest point leaps, the path runs straight across the mesh.
    pub surface: *const StriaeSurface,
    /// The path's points in the mesh's own coordinates, -1e9 to 1e9, point_count of them; not read without a surface.
    pub points_xyz: *const [f64; 3],
}

/// Scale of a pattern. Texture space is not wrapped: scratches lie where they were drawn, once, at any (u, v). Set
/// struct_size to sizeof(StriaePatternOptions).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaePatternOptions {
    /// sizeof(StriaePatternOptions)
    pub struct_size: usize,
    /// Millimetres in one scene unit, 1e-9 to 1e9.
    pub mm_per_scene_unit: f64,
    /// Scene units that one unit of u and of v spans, 1e-9 to 1e9 each. Arc length along paths is measured
    /// with it, nothing else: while shading, dp_du and dp_dv count.
    pub units_per_uv: [f64; 2],
}

/// Collects scratches. One thread at a time; whoever made it frees it.
#[derive(Debug)]
pub struct StriaePatternBuilder(pub(super) PatternBuilder);

/// A surface with its scratches. Immutable; any thread may use it; reference-counted.
#[derive(Debug)]
pub struct StriaePattern(pub(super) Pattern);

impl From<&StriaeKey> for Key {
    fn from(key: &StriaeKey) -> Self {
        let &StriaeKey {
            at,
            force_kgf,
            depth_mm,
            spin_deg,
            tilt_deg,
            azimuth_deg,
        } = key;
        let orientation = Orientation {
            spin_deg,
            tilt_deg,
            azimuth_deg,
        };
        Self {
            at,
            force_kgf,
            depth_mm,
            orientation,
        }
    }
}

pub(super) fn held(number: u32) -> Result<Held> {
    match number {
        0 => Ok(Held::ToPath),
        1 => Ok(Held::ToSurface),
        other => {
            let accepted = "a StriaeHeld, 0 to 1";
            Err(Error::number("held", f64::from(other), accepted))
        }
    }
}

/// What of a scratch is not borrowed from its caller.
struct Own {
    material: Option<Material>,
    keys: Vec<Key>,
}

impl StriaeScratch {
    /// # Safety
    /// The pointers are NULL or valid for what they count.
    unsafe fn own(&self) -> Result<Own> {
        check_struct_size(self.struct_size, size_of::<Self>(), "sizeof(StriaeScratch)")?;
        // SAFETY: as promised by the caller.
        let (keys, material) = unsafe {
            (
                array(["keys", "key_count"], self.keys, self.key_count)?,
                self.material.as_ref().map(|m| m.checked()).transpose()?,
            )
        };
        Ok(Own {
            material,
            keys: keys.iter().map(Key::from).collect(),
        })
    }

    /// # Safety
    /// The pointers are NULL or valid for what they count.
    unsafe fn scratch<'a>(&'a self, own: &'a Own) -> Result<Scratch<'a>> {
        // SAFETY: as promised by the caller.
        let (tool, path) = unsafe { (borrowed("tool", self.tool)?, self.path()?) };
        Ok(Scratch {
            tool: &tool.0,
            material: own.material.as_ref(),
            depth_law: depth_law(self.depth_law)?,
            held: held(self.held)?,
            path,
            keys: &own.keys,
        })
    }

    /// # Safety
    /// The pointers are NULL or valid for what they count.
    unsafe fn path(&self) -> Result<Path<'_>> {
        // SAFETY: as promised by the caller.
        let (kind, surface) = unsafe { (self.kind()?, self.surface.as_ref()) };
        let closed = match self.closed {
            0 => false,
            1 => true,
            other => return Err(Error::number("closed", f64::from(other), "0 or 1")),
        };
        let Some(surface) = surface else {
            let names = ["points_uv", "point_count"];
            // SAFETY: as promised by the caller.
            let points = unsafe { array(names, self.points_uv, self.point_count)? };
            return Ok(Path::Spline(Spline {
                kind,
                points,
                closed,
            }));
        };
        let names = ["points_xyz", "point_count"];
        // SAFETY: as promised by the caller.
        let points = unsafe { array(names, self.points_xyz, self.point_count)? };
        Ok(Path::OnSurface {
            surface: &surface.0,
            spline: Spline {
                kind,
                points,
                closed,
            },
        })
    }

    /// # Safety
    /// `knots` is NULL or valid for `knot_count`.
    unsafe fn kind(&self) -> Result<SplineKind<'_>> {
        // SAFETY: as promised by the caller.
        let knots = unsafe { array(["knots", "knot_count"], self.knots, self.knot_count)? };
        let kind = match self.curve {
            0 => SplineKind::Polyline,
            1 => SplineKind::CubicBezier,
            2 => SplineKind::CatmullRom,
            3 => SplineKind::BSpline,
            4 => return Ok(SplineKind::NonUniformBSpline { knots }),
            other => {
                let accepted = "a StriaeCurve, 0 to 4";
                return Err(Error::number("curve", f64::from(other), accepted));
            }
        };
        if knots.is_empty() {
            return Ok(kind);
        }
        let accepted = "0 unless the curve is STRIAE_CURVE_NON_UNIFORM_B_SPLINE";
        Err(Error::count("knot_count", knots.len(), accepted))
    }
}

/// Begins a pattern on an unscratched surface; striae_pattern_builder_load() begins one with all that a file holds.
///
/// @param surface the surface's material (a StriaeSurface is something else: a mesh to draw on)
/// @param options scale
/// @param builder receives a builder to free with striae_pattern_builder_free(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_new(
    surface: *const StriaeMaterial,
    options: *const StriaePatternOptions,
    builder: *mut *mut StriaePatternBuilder,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable, as the header asks.
        let out = unsafe { exclusive("builder", builder)? };
        *out = core::ptr::null_mut();
        // SAFETY: each is NULL or valid, as the header asks.
        let (surface, options) =
            unsafe { (borrowed("surface", surface)?, borrowed("options", options)?) };
        let accepted = "sizeof(StriaePatternOptions)";
        check_struct_size(
            options.struct_size,
            size_of::<StriaePatternOptions>(),
            accepted,
        )?;
        // SAFETY: the material's layers are NULL or valid, as the header asks.
        let surface = unsafe { surface.checked()? };
        let made = PatternBuilder::new(surface, options.mm_per_scene_unit, options.units_per_uv)?;
        *out = Box::into_raw(Box::new(StriaePatternBuilder(made)));
        Ok(())
    })
}

/// Lets the surface's hardness vary: scratches added from now on meet the map along their way instead of the
/// material's own hardness. Scratches with a material of their own keep that one's.
///
/// @param builder the builder; keeps a copy
/// @param map the map
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_set_hardness(
    builder: *mut StriaePatternBuilder,
    map: *const StriaeHardnessMap,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, map) = unsafe { (exclusive("builder", builder)?, borrowed("map", map)?) };
        builder.0.set_hardness(map.0.clone());
        Ok(())
    })
}

/// Adds a scratch on top of those before it: where they cross, it cuts them. Everything is copied; if it is refused, the
/// builder is as it was.
///
/// @param builder the builder
/// @param scratch the scratch
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_add_scratch(
    builder: *mut StriaePatternBuilder,
    scratch: *const StriaeScratch,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, scratch) = unsafe {
            (
                exclusive("builder", builder)?,
                borrowed("scratch", scratch)?,
            )
        };
        // SAFETY: the scratch's pointers are NULL or valid, as the header asks.
        let own = unsafe { scratch.own()? };
        // SAFETY: the same.
        builder.0.add(&unsafe { scratch.scratch(&own)? })
    })
}

/// Adds scratches in their order, prepared on all cores: as striae_pattern_builder_add_scratch() for each, but faster for
/// thousands. If one is refused, the builder is as it was, and the error names its number.
///
/// @param builder the builder
/// @param scratches the scratches, packed
/// @param count how many
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_add_scratches(
    builder: *mut StriaePatternBuilder,
    scratches: *const StriaeScratch,
    count: usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, scratches) = unsafe {
            (
                exclusive("builder", builder)?,
                array(["scratches", "count"], scratches, count)?,
            )
        };
        let numbered = || scratches.iter().enumerate();
        // SAFETY: the scratches' pointers are NULL or valid, as the header asks.
        let own =
            numbered().map(|(i, one)| unsafe { one.own() }.map_err(|e| e.within("scratches", i)));
        let own: Vec<Own> = own.collect::<Result<_>>()?;
        let all = numbered().zip(&own).map(|((i, one), own)| {
            // SAFETY: the same.
            unsafe { one.scratch(own) }.map_err(|e| e.within("scratches", i))
        });
        builder.0.add_all(&all.collect::<Result<Vec<_>>>()?)
    })
}

/// How many scratches were added so far, also by the many: the next one's number, which striae_pattern_query() tells.
///
/// @param builder the builder
/// @param count receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_scratch_count(
    builder: *const StriaePatternBuilder,
    count: *mut usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, count) =
            unsafe { (borrowed("builder", builder)?, exclusive("count", count)?) };
        *count = builder.0.scratch_count();
        Ok(())
    })
}

/// Builds the pattern of all scratches added so far, none being fine, on all cores. The builder stays usable.
///
/// @param builder the builder
/// @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_build(
    builder: *const StriaePatternBuilder,
    pattern: *mut *mut StriaePattern,
) -> StriaeStatus {
    let make = || {
        // SAFETY: NULL or valid, as the header asks.
        let builder = unsafe { borrowed("builder", builder)? };
        Ok(StriaePattern(builder.0.build()))
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("pattern", pattern, make) })
}

/// Frees a builder. Patterns built with it live on. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_free(builder: *mut StriaePatternBuilder) {
    if !builder.is_null() {
        // SAFETY: a live builder that Box::into_raw gave, as the header asks.
        drop(unsafe { Box::from_raw(builder) });
    }
}

/// Tells how much memory a pattern takes: all its arrays. Of an opened one the file's, which processes share.
///
/// @param pattern the pattern
/// @param bytes receives it
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_memory(
    pattern: *const StriaePattern,
    bytes: *mut usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (pattern, bytes) =
            unsafe { (borrowed("pattern", pattern)?, exclusive("bytes", bytes)?) };
        let memory = pattern.0.memory_bytes();
        *bytes = memory.control_points + memory.rest;
        Ok(())
    })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_retain(pattern: *const StriaePattern) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(pattern) }
}

/// Drops a reference; the last one frees the pattern. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_release(pattern: *const StriaePattern) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(pattern) }
}

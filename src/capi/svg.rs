//! Drawings for C.

use super::cross_section::depth_law;
use super::files::path_from;
use super::handle::{borrowed, exclusive};
use super::material::StriaeMaterial;
use super::pattern::{StriaePatternBuilder, held};
use super::status::{StriaeStatus, check_struct_size, guard_any};
use super::tool::StriaeTool;
use crate::files::{FileError, Pressed, SvgPaths, SvgScratches};
use crate::formation::{DepthLaw, Orientation};
use core::ffi::c_char;

/// What scratches are made along a drawing's paths. All zero but struct_size and tool: on the unit square, each as wide
/// as its stroke. Set struct_size to sizeof(StriaeSvgOptions).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeSvgOptions {
    /// sizeof(StriaeSvgOptions)
    pub struct_size: usize,
    /// The tool; the pattern keeps what it needs of it.
    pub tool: *const StriaeTool,
    /// Another hardness and finish than the surface's for these scratches; NULL for the surface's own.
    pub material: *const StriaeMaterial,
    /// Where the drawing's edges come to lie: two opposite corners, (u, v), -1e6 to 1e6, the first one lower in both; all 0
    /// for the unit square. The drawing's top is the area's.
    pub area_uv: [[f64; 2]; 2],
    /// A StriaeDepthLaw.
    pub depth_law: u32,
    /// A StriaeHeld.
    pub held: u32,
    /// Normal force, kgf, 0 to 100000; 0 for what makes each scratch as wide between its two crests as its stroke, at the
    /// material's own hardness.
    pub force_kgf: f64,
    /// Likewise the depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
    pub depth_mm: f64,
    /// Shares of the length over which force or depth rise from 0 and fall back to it, each 0 to 1, together 1 at most.
    pub taper: [f64; 2],
    /// Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
    pub spin_deg: f64,
    /// Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
    pub tilt_deg: f64,
    /// Where the axis leans to, degrees, -3600 to 3600: StriaeHeld says from where.
    pub azimuth_deg: f64,
}

/// Adds a scratch along each stroked path of an SVG drawing; if one of them is refused, the builder is as it was.
///
/// Paths, lines, polylines, polygons, rectangles, circles and ellipses count, where visible, under their transforms; fills,
/// texts, images, clips, masks and dashes do not. A drawing is stretched where the area has other proportions; a stroke's
/// width is then the geometric mean of both directions.
///
/// A file that is missing, no SVG, without a size or without a stroked path, and a scratch that cannot be made, are answered
/// with STRIAE_STATUS_FILE; striae_last_error() then names the file, the line and column or the path, what was found and what
/// is accepted.
///
/// Not in a library that was built without the cargo feature `svg` (it is on by default).
///
/// @param builder the builder
/// @param path the file's path, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param options what scratches are made
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_builder_add_svg(
    builder: *mut StriaePatternBuilder,
    path: *const c_char,
    options: *const StriaeSvgOptions,
) -> StriaeStatus {
    guard_any(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (builder, path, options) = unsafe {
            (
                exclusive("builder", builder)?,
                path_from("path", path)?,
                borrowed("options", options)?,
            )
        };
        let accepted = "sizeof(StriaeSvgOptions)";
        check_struct_size(options.struct_size, size_of::<StriaeSvgOptions>(), accepted)?;
        // SAFETY: NULL or valid, as the header asks.
        let tool = unsafe { borrowed("tool", options.tool)? };
        // SAFETY: NULL or valid with its layers, as the header asks.
        let material = unsafe { options.material.as_ref().map(|m| m.checked()).transpose()? };
        let scratches = SvgScratches {
            material: material.as_ref(),
            depth_law: depth_law(options.depth_law)?,
            held: held(options.held)?,
            pressed: options.pressed(),
            taper: options.taper,
            orientation: Orientation {
                spin_deg: options.spin_deg,
                tilt_deg: options.tilt_deg,
                azimuth_deg: options.azimuth_deg,
            },
            ..SvgScratches::new(&tool.0)
        };
        let area_uv = match options.area_uv {
            [[0.0, 0.0], [0.0, 0.0]] => [[0.0; 2], [1.0; 2]],
            stated => stated,
        };
        let added = SvgPaths::read(path, area_uv)?.add_to(&mut builder.0, &scratches);
        added.map_err(|error: FileError| error.in_file(path))
    })
}

impl StriaeSvgOptions {
    fn pressed(&self) -> Pressed {
        let stated = self.depth_law == DepthLaw::Stated as u32;
        match (stated, self.depth_mm, self.force_kgf) {
            (true, 0.0, _) | (false, _, 0.0) => Pressed::StrokeWidth,
            (true, depth_mm, _) => Pressed::Depth(depth_mm),
            (false, _, force_kgf) => Pressed::Force(force_kgf),
        }
    }
}

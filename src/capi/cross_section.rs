//! Cross-sections for C.

use super::handle::{borrowed, exclusive, make_shared, release, retain};
use super::material::StriaeMaterial;
use super::status::{StriaeStatus, check_struct_size, guard};
use super::tool::StriaeTool;
use crate::error::{Error, Result};
use crate::formation::{CrossSection, DepthLaw, Orientation, Peak, Process, Wanted};

/// Laws that give a groove's depth.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeDepthLaw {
    /// The fit of Bosch et al. 2004, made with a Rockwell C cone in metals; below a force over hardness of
    /// 4.17e-4 mm² it leaves no scratch.
    Bosch2004 = 0,
    /// Scratch hardness (ASTM G171): the groove is sqrt(8 F / (pi HV)) wide between its two crests. Any tool.
    ScratchHardness = 1,
    /// The depth is stated, whatever the force.
    Stated = 2,
}

/// A measure of a scratch that its author wants.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaeWanted {
    /// Depth of the groove below the surface.
    Depth = 0,
    /// Width of the groove at the surface.
    GrooveWidth = 1,
    /// Width between the two crests.
    CrestWidth = 2,
}

/// How a tool is held and pressed. Set struct_size to sizeof(StriaeProcess).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeProcess {
    /// sizeof(StriaeProcess)
    pub struct_size: usize,
    /// A StriaeDepthLaw.
    pub depth_law: u32,
    /// Normal force, kgf, 0 to 100000: does not count under STRIAE_DEPTH_LAW_STATED.
    pub force_kgf: f64,
    /// Depth under load, mm, 0 to 1000: counts under STRIAE_DEPTH_LAW_STATED only.
    pub depth_mm: f64,
    /// Spin about the tool's own axis, counter-clockwise from above, degrees, -3600 to 3600.
    pub spin_deg: f64,
    /// Angle between the tool's axis and the surface normal, degrees, 0 to 85; less than lays its flank on the surface.
    pub tilt_deg: f64,
    /// Where the axis leans to: 0 = forward, 90 = left of travel, degrees, -3600 to 3600.
    pub azimuth_deg: f64,
}

/// One of the two peaks beside a groove.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaePeak {
    /// Slope of the inner flank, degrees.
    pub alpha_deg: f64,
    /// Slope of the outer flank, degrees.
    pub beta_deg: f64,
    /// Height above the surface, mm.
    pub height_mm: f64,
    /// Width of the inner flank, mm.
    pub inner_width_mm: f64,
    /// Width of the outer flank, mm.
    pub outer_width_mm: f64,
}

/// Measures of a cross-section; all 0 where the force left no scratch, lengths after elastic recovery. Set struct_size to
/// sizeof(StriaeCrossSectionInfo).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeCrossSectionInfo {
    /// sizeof(StriaeCrossSectionInfo)
    pub struct_size: usize,
    /// Depth of the groove below the surface, mm.
    pub depth_mm: f64,
    /// Area of the groove below the surface, mm².
    pub groove_area_mm2: f64,
    /// Width of the groove at the surface, mm.
    pub groove_width_mm: f64,
    /// Width between the two crests, mm.
    pub crest_width_mm: f64,
    /// The peak left of travel.
    pub left: StriaePeak,
    /// The peak right of travel.
    pub right: StriaePeak,
    /// How many points striae_cross_section_vertices() has.
    pub vertex_count: usize,
}

/// A scratch's cross-section. Immutable; any thread may use it; reference-counted.
#[derive(Debug)]
pub struct StriaeCrossSection(pub(super) CrossSection);

impl From<Peak> for StriaePeak {
    fn from(peak: Peak) -> Self {
        let Peak {
            alpha_deg,
            beta_deg,
            height_mm,
            inner_width_mm,
            outer_width_mm,
        } = peak;
        Self {
            alpha_deg,
            beta_deg,
            height_mm,
            inner_width_mm,
            outer_width_mm,
        }
    }
}

pub(super) fn depth_law(number: u32) -> Result<DepthLaw> {
    match number {
        0 => Ok(DepthLaw::Bosch2004),
        1 => Ok(DepthLaw::ScratchHardness),
        2 => Ok(DepthLaw::Stated),
        other => Err(Error::number(
            "depth_law",
            f64::from(other),
            "a StriaeDepthLaw, 0 to 2",
        )),
    }
}

impl StriaeProcess {
    fn checked(&self) -> Result<Process> {
        check_struct_size(self.struct_size, size_of::<Self>(), "sizeof(StriaeProcess)")?;
        Ok(Process {
            depth_law: depth_law(self.depth_law)?,
            force_kgf: self.force_kgf,
            depth_mm: self.depth_mm,
            orientation: Orientation {
                spin_deg: self.spin_deg,
                tilt_deg: self.tilt_deg,
                azimuth_deg: self.azimuth_deg,
            },
        })
    }
}

/// Forms the cross-section that a tool, held and pressed so, leaves in a material. A force too small for a scratch is no
/// failure: all measures are 0. One that pushes the tool deeper than it is tall is refused.
///
/// @param tool the tool
/// @param material its hardness, pile-up and recovery count
/// @param process how the tool is held and pressed
/// @param cross_section receives a handle to release with striae_cross_section_release(); NULL on failure
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_cross_section(
    tool: *const StriaeTool,
    material: *const StriaeMaterial,
    process: *const StriaeProcess,
    cross_section: *mut *mut StriaeCrossSection,
) -> StriaeStatus {
    let make = || {
        // SAFETY: each is NULL or valid, as the header asks.
        let (tool, material, process) = unsafe {
            (
                borrowed("tool", tool)?,
                borrowed("material", material)?,
                borrowed("process", process)?,
            )
        };
        // SAFETY: the material's layers are NULL or valid, as the header asks.
        let material = unsafe { material.checked()? };
        CrossSection::form(&tool.0, &process.checked()?, &material).map(StriaeCrossSection)
    };
    // SAFETY: NULL or writable, as the header asks.
    guard(|| unsafe { make_shared("cross_section", cross_section, make) })
}

/// Finds the process that leaves a scratch of a wanted size: the exact inverse of striae_cross_section().
///
/// @param tool the tool
/// @param material the material
/// @param wanted a StriaeWanted
/// @param value_mm how much of it, 1e-9 to 1000, and no more than the tool can leave
/// @param process with struct_size, depth_law and angles set; its force_kgf (0 under STRIAE_DEPTH_LAW_STATED) and
///     depth_mm are written, on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_process_for(
    tool: *const StriaeTool,
    material: *const StriaeMaterial,
    wanted: u32,
    value_mm: f64,
    process: *mut StriaeProcess,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (tool, material, process) = unsafe {
            (
                borrowed("tool", tool)?,
                borrowed("material", material)?,
                exclusive("process", process)?,
            )
        };
        let wanted = match wanted {
            0 => Wanted::Depth(value_mm),
            1 => Wanted::GrooveWidth(value_mm),
            2 => Wanted::CrestWidth(value_mm),
            other => {
                let accepted = "a StriaeWanted, 0 to 2";
                return Err(Error::number("wanted", f64::from(other), accepted));
            }
        };
        // SAFETY: the material's layers are NULL or valid, as the header asks.
        let material = unsafe { material.checked()? };
        let Process {
            depth_law,
            orientation,
            ..
        } = process.checked()?;
        let found = Process::for_wanted(wanted, &tool.0, &material, depth_law, orientation)?;
        (process.force_kgf, process.depth_mm) = (found.force_kgf, found.depth_mm);
        Ok(())
    })
}

/// Measures a cross-section.
///
/// @param cross_section the cross-section
/// @param info with struct_size set; the rest is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_cross_section_info(
    cross_section: *const StriaeCrossSection,
    info: *mut StriaeCrossSectionInfo,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (section, info) = unsafe {
            (
                borrowed("cross_section", cross_section)?,
                exclusive("info", info)?,
            )
        };
        let size = size_of::<StriaeCrossSectionInfo>();
        check_struct_size(info.struct_size, size, "sizeof(StriaeCrossSectionInfo)")?;
        let section = &section.0;
        *info = StriaeCrossSectionInfo {
            struct_size: size,
            depth_mm: section.depth_mm(),
            groove_area_mm2: section.groove_area_mm2(),
            groove_width_mm: section.groove_width_mm(),
            crest_width_mm: section.crest_width_mm(),
            left: section.left().into(),
            right: section.right().into(),
            vertex_count: section.vertices().len(),
        };
        Ok(())
    })
}

/// Writes a cross-section's points (x, z), mm, from left to right of travel; the surface is at z = 0.
///
/// @param cross_section the cross-section
/// @param xz_mm room for `capacity` points; may be NULL, to ask for the count alone
/// @param capacity how many points there is room for; what does not fit is left out
/// @param count receives how many points the cross-section has, also where fewer were written; may be NULL
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_cross_section_vertices(
    cross_section: *const StriaeCrossSection,
    xz_mm: *mut [f64; 2],
    capacity: usize,
    count: *mut usize,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or valid, as the header asks.
        let section = unsafe { borrowed("cross_section", cross_section)? };
        let vertices = section.0.vertices();
        if !xz_mm.is_null() {
            for (i, vertex) in vertices.iter().take(capacity).enumerate() {
                // SAFETY: i is below `capacity`, for which there is room, as the header asks.
                unsafe { xz_mm.add(i).write(vertex.to_array()) };
            }
        }
        if !count.is_null() {
            // SAFETY: not NULL, so writable, as the header asks.
            unsafe { count.write(vertices.len()) };
        }
        Ok(())
    })
}

/// Adds a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_cross_section_retain(cross_section: *const StriaeCrossSection) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { retain(cross_section) }
}

/// Drops a reference; the last one frees the cross-section. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_cross_section_release(cross_section: *const StriaeCrossSection) {
    // SAFETY: NULL or a live handle, as the header asks.
    unsafe { release(cross_section) }
}

//! Pictures of cross-sections for C.

use super::cross_section::StriaeCrossSection;
use super::files::path_from;
use super::handle::borrowed;
use super::status::{StriaeStatus, check_struct_size, guard_any};
use crate::error::{Error, Result};
use crate::files::{Plot, PlotStyle};
use core::ffi::{CStr, c_char};

/// How much a plot says.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub enum StriaePlotStyle {
    /// Axes around the drawing; every zone, area, width and angle labelled.
    Annotated = 0,
    /// To be set under another picture of the same place and width: the drawing fills the image to its edges, its
    /// scales lie within, and nothing but the title is written on it.
    Strip = 1,
}

/// What else a plot is to be. All zero but struct_size: an annotated plot of all there is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaePlotOptions {
    /// sizeof(StriaePlotOptions)
    pub struct_size: usize,
    /// A StriaePlotStyle.
    pub style: u32,
    /// Written at the top, in bold; a strip has room for further lines, in plain. UTF-8, NUL-terminated. NULL for none
    /// of your own.
    pub title: *const c_char,
    /// What is shown across the scratch, from and to (above from), mm, -10000 to 10000; both 0 for what fits.
    pub x_mm: [f64; 2],
    /// What is shown of depths and heights, likewise.
    pub z_mm: [f64; 2],
}

impl StriaePlotOptions {
    /// # Safety
    /// `title` is NULL or points to a NUL-terminated text that lives, unchanged, as long as the plot.
    unsafe fn put_into<'a>(&self, plot: &mut Plot<'a>) -> Result<()> {
        let size = size_of::<Self>();
        check_struct_size(self.struct_size, size, "sizeof(StriaePlotOptions)")?;
        plot.style = match self.style {
            0 => PlotStyle::Annotated,
            1 => PlotStyle::Strip,
            other => {
                let accepted = "a StriaePlotStyle, 0 to 1";
                return Err(Error::number("style", f64::from(other), accepted));
            }
        };
        if !self.title.is_null() {
            // SAFETY: not NULL; the rest as promised by the caller.
            let title: &'a CStr = unsafe { CStr::from_ptr(self.title) };
            let accepted = "a text in UTF-8";
            let title = title.to_str();
            plot.title = Some(title.map_err(|_| Error::text("title", "not UTF-8", accepted))?);
        }
        let shown = |range: [f64; 2]| (range != [0.0; 2]).then_some(range);
        (plot.x_mm, plot.z_mm) = (shown(self.x_mm), shown(self.z_mm));
        Ok(())
    }
}

/// Draws a cross-section into a file: as PNG or as SVG, by the end of the file's name.
///
/// Zones have their colours, lengths are in µm, and the picture says by how much heights are exaggerated. The same
/// cross-section gives the same picture on every machine. A file that cannot be written, and a
/// name that ends otherwise, are answered with STRIAE_STATUS_FILE.
///
/// Not in a library that was built without the cargo feature `files` (it is on by default).
///
/// @param cross_section the cross-section; one without a scratch is a flat line
/// @param path the file's path, ending in .png or .svg, NUL-terminated: any bytes on Unix, UTF-8 elsewhere
/// @param width_px 64 to 8192
/// @param height_px 64 to 8192
/// @param options what else the plot is to be; may be NULL
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_plot_cross_section(
    cross_section: *const StriaeCrossSection,
    path: *const c_char,
    width_px: u32,
    height_px: u32,
    options: *const StriaePlotOptions,
) -> StriaeStatus {
    guard_any(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (section, path, options) = unsafe {
            (
                borrowed("cross_section", cross_section)?,
                path_from("path", path)?,
                options.as_ref(),
            )
        };
        let mut plot = Plot::new(&section.0, width_px, height_px);
        if let Some(options) = options {
            // SAFETY: the title is NULL or NUL-terminated, as the header asks.
            unsafe { options.put_into(&mut plot) }?;
        }
        plot.write(path)
    })
}

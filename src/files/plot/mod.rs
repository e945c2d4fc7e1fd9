//! A cross-section as a picture: drawn once, as SVG, and rasterised from that to PNG.
//!
//! The PNG is the same on every machine: its text is set in Noto Sans, which the library brings along.

mod drawing;
mod labels;
mod png;
mod svg;
mod view;

use super::error::{FileError, Place, Result};
use crate::error::{self, Error, in_range};
use crate::formation::CrossSection;
use std::path::Path;
use view::View;

/// How much a plot says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlotStyle {
    /// Axes around the drawing, every zone, area, width and angle labelled.
    #[default]
    Annotated,
    /// To be set under another picture of the same place and width: the drawing fills the image to its edges,
    /// its scales lie within, and nothing but the title is written on it.
    Strip,
}

/// A picture of a cross-section: the groove, its two peaks, the untouched surface at z = 0. Lengths are in µm.
///
/// Heights are exaggerated by a whole number where there is room for it; the picture says by how much.
///
/// ```
/// use striae::brdf::Metal;
/// use striae::files::Plot;
/// use striae::formation::{CrossSection, Material, Process, Tool};
///
/// let pressed = Process { force_kgf: 2.0, ..Process::default() };
/// let section = CrossSection::form(&Tool::rockwell_c(), &pressed, &Material::metal(Metal::Steel))?;
/// let plot = Plot { title: Some("Rockwell C, 2 kgf, steel"), ..Plot::new(&section, 1200, 800) };
/// assert!(plot.svg()?.contains("µm"));
/// # Ok::<(), striae::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Plot<'a> {
    /// What is drawn.
    pub section: &'a CrossSection,
    /// Pixels, 64 to 8192.
    pub width_px: u32,
    /// Pixels, 64 to 8192.
    pub height_px: u32,
    /// How much is said.
    pub style: PlotStyle,
    /// Written at the top, in bold; a strip has room for further lines, in plain. Without one, an annotated plot has a title
    /// of its own.
    pub title: Option<&'a str>,
    /// What is shown across the scratch, from and to, mm; without, what fits.
    pub x_mm: Option<[f64; 2]>,
    /// What is shown of depths and heights, from and to, mm; without, what fits.
    pub z_mm: Option<[f64; 2]>,
}

impl<'a> Plot<'a> {
    /// An annotated plot that shows all of `section`.
    pub fn new(section: &'a CrossSection, width_px: u32, height_px: u32) -> Self {
        Self {
            section,
            width_px,
            height_px,
            style: PlotStyle::default(),
            title: None,
            x_mm: None,
            z_mm: None,
        }
    }

    /// The plot as SVG. Its parts carry classes: `groove`, `inner`, `outer`, `surface`, `material` and so on.
    ///
    /// Errors: a size or a range out of its range.
    pub fn svg(&self) -> error::Result<String> {
        self.check()?;
        Ok(drawing::draw(self, &View::of(self)))
    }

    /// The plot as a PNG file's content: the SVG's own pixels.
    ///
    /// Errors: as for [`Self::svg`].
    pub fn png(&self) -> error::Result<Vec<u8>> {
        Ok(png::rasterised(&self.svg()?))
    }

    /// Writes the plot to a file: PNG or SVG, by the end of the file's name.
    ///
    /// Errors: as for [`Self::svg`]; a name that ends otherwise; a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let bytes = match extension.to_str() {
            Some("svg") => self.svg()?.into_bytes(),
            Some("png") => self.png()?,
            _ => {
                let found = "a name that ends otherwise";
                let error = FileError::new(Place::Whole, found, "names that end in .png or .svg");
                return Err(error.in_file(path));
            }
        };
        std::fs::write(path, bytes).map_err(|error| {
            let found = format!("cannot be written ({error})");
            FileError::new(Place::Whole, found, "a file that may be written").in_file(path)
        })
    }

    fn check(&self) -> error::Result<()> {
        in_range("width_px", f64::from(self.width_px), 64.0, 8192.0)?;
        in_range("height_px", f64::from(self.height_px), 64.0, 8192.0)?;
        check_shown("x_mm", self.x_mm)?;
        check_shown("z_mm", self.z_mm)
    }
}

fn check_shown(argument: &'static str, shown: Option<[f64; 2]>) -> error::Result<()> {
    let Some([from, to]) = shown else {
        return Ok(());
    };
    for end in [from, to] {
        in_range(argument, end, -1e4, 1e4)?;
    }
    if to - from >= 1e-9 {
        return Ok(());
    }
    let accepted = "two numbers, the second larger by 1e-9 or more";
    Err(Error::number(argument, to, accepted))
}

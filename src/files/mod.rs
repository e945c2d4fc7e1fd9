//! What is read from files: tools as 3D models (OBJ, STL, PLY), hardness as images (PNG, EXR), paths as drawings (SVG,
//! cargo feature `svg`), whole patterns (JSON).
//! What is written to files: patterns, built ones too (to be opened again at once), and cross-sections as pictures (PNG, SVG).
//!
//! A path or bytes in, a [`Tool`](crate::formation::Tool), a [`HardnessMap`](crate::formation::HardnessMap) or a
//! [`FileError`] out. What a file says of itself is
//! checked against its size before it is believed, so that no file, whatever it holds, makes a reader panic
//! or ask for more memory than its size explains.

mod cache;
mod error;
mod image;
mod map;
mod mesh;
mod obj;
pub mod pattern;
mod plot;
mod ply;
mod polygons;
mod read;
mod relief;
mod stl;
#[cfg(feature = "svg")]
mod svg;
mod text;

pub use error::FileError;
pub use image::{hardness_from_bytes, read_hardness};
pub use mesh::{MeshFormat, read_tool, tool_from_bytes};
pub use pattern::{PatternFile, read_pattern};
pub use plot::{Plot, PlotStyle};
#[cfg(feature = "svg")]
pub use svg::{Pressed, SvgPath, SvgPaths, SvgScratches};

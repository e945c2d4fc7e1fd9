//! Tools as 3D models: which reader a file is for, and how much of it is read.

use super::error::{FileError, Place, Result};
use super::read::read;
use super::{obj, ply, stl};
use crate::formation::{Tool, check_unit};
use std::path::Path;

/// How a 3D model is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ: its vertices (`v`) and faces (`f`); all else is passed over.
    Obj,
    /// STL, text or binary, told apart by what the bytes hold.
    Stl,
    /// PLY, text or binary of either byte order: its elements `vertex` and `face`.
    Ply,
}

impl MeshFormat {
    /// By the end of a file's name, in upper or lower case.
    fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("obj") => Ok(Self::Obj),
            Some("stl") => Ok(Self::Stl),
            Some("ply") => Ok(Self::Ply),
            _ => Err(FileError::new(
                Place::Whole,
                "a name that ends otherwise",
                "names that end in .obj, .stl or .ply",
            )),
        }
    }
}

/// A tool from a 3D model: OBJ, STL (text or binary) or PLY (text or binary), by the end of the file's name.
///
/// The file's unit is `mm_per_unit` mm (1e-9 to 1e9): 1 for mm, 25.4 for inches, 1000 for metres. z points up,
/// the tool's tip down; polygons are cut into fans of triangles, and the mesh is then what [`Tool::mesh`] takes.
/// At most 1 GiB.
///
/// Errors: a file that cannot be read, or that is broken, empty, cut short or too large; a vertex that is not
/// finite, or not there; what [`Tool::mesh`] refuses.
pub fn read_tool(path: &Path, mm_per_unit: f64) -> Result<Tool> {
    check_unit(mm_per_unit)?;
    MeshFormat::of(path)
        .and_then(|format| tool_from_bytes(&read(path)?, format, mm_per_unit))
        .map_err(|error| error.in_file(path))
}

/// As [`read_tool`], from a file's content.
pub fn tool_from_bytes(bytes: &[u8], format: MeshFormat, mm_per_unit: f64) -> Result<Tool> {
    check_unit(mm_per_unit)?;
    if bytes.is_empty() {
        return Err(FileError::new(
            Place::Whole,
            "holds no bytes",
            "a 3D model: OBJ, STL or PLY",
        ));
    }
    let polygons = match format {
        MeshFormat::Obj => obj::polygons(bytes),
        MeshFormat::Stl => stl::polygons(bytes),
        MeshFormat::Ply => ply::polygons(bytes),
    };
    polygons?.into_tool(mm_per_unit)
}

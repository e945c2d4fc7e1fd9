//! Whole patterns as files: JSON with tools, materials, scratches and generators by name, `docs/pattern-file.md`.
//!
//! A [`PatternFile`] is the document itself, to be read, changed and written; it makes a
//! [`PatternBuilder`] when asked to. What it holds is checked then, by the rooms that use it.

mod generator;
mod json;
mod material;
mod scratch;
mod tool;

pub use generator::GeneratorEntry;
pub use json::Version;
pub use material::{
    BrdfEntry, FresnelEntry, HardnessEntry, LayerEntry, MaterialEntry, MaterialName, ReadingEntry,
};
pub use scratch::{CurveKind, KeyEntry, ScratchEntry};
pub use tool::{ToolEntry, ToolName};

use super::error::{FileError, Place, Result};
use super::read::read;
use crate::formation::{Material, Tool};
use crate::pattern::PatternBuilder;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// A pattern file: everything that a pattern is built from.
///
/// ```
/// use striae::files::PatternFile;
///
/// let file = PatternFile::parse(r#"{
///     "striae_pattern": 1,
///     "scale": { "mm_per_scene_unit": 1.0, "units_per_uv": [60.0, 40.0] },
///     "surface": "plate",
///     "materials": { "plate": { "like": "titanium" } },
///     "tools": { "nail": { "preset": "nail" } },
///     "scratches": [
///         { "tool": "nail", "points_uv": [[0.1, 0.5], [0.9, 0.5]], "keys": [{ "at": 0.0, "force_kgf": 2.0 }] }
///     ]
/// }"#)?;
/// let pattern = file.builder(".".as_ref())?.build();
/// assert_eq!(pattern.scratch_count(), 1);
/// # Ok::<(), striae::files::FileError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PatternFile {
    /// The form's version.
    pub striae_pattern: Version,
    /// How large things are.
    pub scale: Scale,
    /// The surface's material, a name in `materials`.
    pub surface: String,
    /// How the surface's hardness varies, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<HardnessEntry>,
    /// Materials by name.
    #[serde(deserialize_with = "json::unique")]
    pub materials: BTreeMap<String, MaterialEntry>,
    /// Tools by name.
    #[serde(default, deserialize_with = "json::unique")]
    pub tools: BTreeMap<String, ToolEntry>,
    /// Scratches one by one.
    #[serde(default)]
    pub scratches: Vec<ScratchEntry>,
    /// Scratches by the many, over those and each other.
    #[serde(default)]
    pub generators: Vec<GeneratorEntry>,
}

/// How large things are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// Millimetres in one scene unit, 1e-9 to 1e9.
    pub mm_per_scene_unit: f64,
    /// Scene units that one unit of u and of v spans, 1e-9 to 1e9 each.
    pub units_per_uv: [f64; 2],
}

/// A pattern file's builder: the file read and built in one call. Tools and images are looked for from the file's own
/// folder.
///
/// Errors: as for [`PatternFile::read`] and [`PatternFile::builder`].
pub fn read_pattern(path: &Path) -> Result<PatternBuilder> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let file = PatternFile::read(path)?;
    file.builder(folder).map_err(|error| error.in_file(path))
}

impl PatternFile {
    /// A file of at most 1 GiB.
    ///
    /// Errors: a file that cannot be read, or whose text [`Self::parse`] refuses.
    pub fn read(path: &Path) -> Result<Self> {
        let parsed = read(path).and_then(|bytes| json::parse(&bytes));
        parsed.map_err(|error| error.in_file(path))
    }

    /// From a file's text.
    ///
    /// Errors: a text that is not JSON, another version, a field that is missing, unknown or of another type: with its line,
    /// column and name. Values are checked where they are used, in [`Self::builder`].
    pub fn parse(text: &str) -> Result<Self> {
        json::parse(text.as_bytes())
    }

    /// The file's text. Reading it gives an equal document, to the last bit of every number.
    ///
    /// Errors: a number that is not finite, which JSON has no word for.
    pub fn to_json(&self) -> Result<String> {
        json::text(self)
    }

    /// Writes the file.
    ///
    /// Errors: as for [`Self::to_json`]; a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let written = self.to_json().and_then(|text| {
            std::fs::write(path, text).map_err(|error| {
                let found = format!("cannot be written ({error})");
                FileError::new(Place::Whole, found, "a file that may be written")
            })
        });
        written.map_err(|error| error.in_file(path))
    }

    /// Its scratches, collected and formed. Names of tool and image files are relative to `folder`.
    ///
    /// Errors: a name that is not in the document, a file that cannot be used, a value out of its range; each with the
    /// part of the document that it is in, such as `scratches[12]`.
    pub fn builder(&self, folder: &Path) -> Result<PatternBuilder> {
        let materials = self.made_materials()?;
        let tools = self.made_tools(folder)?;
        let surface = named("surface", &self.surface, &materials, "materials")?;
        let Scale {
            mm_per_scene_unit,
            units_per_uv,
        } = self.scale;
        let mut builder = PatternBuilder::new(surface.clone(), mm_per_scene_unit, units_per_uv)
            .map_err(|error| FileError::within("scale", error))?;
        if let Some(hardness) = &self.hardness {
            let map = hardness.map(folder);
            builder.set_hardness(map.map_err(|error| FileError::within("hardness", error))?);
        }
        for (i, scratch) in self.scratches.iter().enumerate() {
            scratch
                .add_to(&mut builder, &tools, &materials)
                .map_err(|error| FileError::within(format!("scratches[{i}]"), error))?;
        }
        for (i, generator) in self.generators.iter().enumerate() {
            generator
                .add_to(&mut builder, &tools, &materials)
                .map_err(|error| FileError::within(format!("generators[{i}]"), error))?;
        }
        Ok(builder)
    }

    fn made_materials(&self) -> Result<Made<'_, Material>> {
        let made = self.materials.iter().map(|(name, entry)| {
            let material = entry.material();
            let refused = |error| FileError::within(format!("materials.{name}"), error);
            Ok((name.as_str(), material.map_err(refused)?))
        });
        made.collect()
    }

    fn made_tools(&self, folder: &Path) -> Result<Made<'_, Tool>> {
        let made = self.tools.iter().map(|(name, entry)| {
            let refused = |error| FileError::within(format!("tools.{name}"), error);
            Ok((name.as_str(), entry.tool(folder).map_err(refused)?))
        });
        made.collect()
    }
}

/// What has been made of a document's parts, by name.
type Made<'a, T> = BTreeMap<&'a str, T>;

/// What `name`, the value of `field`, stands for among the names in `list`.
fn named<'a, T>(field: &str, name: &str, made: &'a Made<'_, T>, list: &str) -> Result<&'a T> {
    made.get(name).ok_or_else(|| {
        let names: Vec<String> = made.keys().map(|name| format!("\"{name}\"")).collect();
        let accepted = if names.is_empty() {
            format!("a name in {list}, which is empty")
        } else {
            format!("a name in {list}: {}", names.join(", "))
        };
        FileError::new(Place::Whole, format!("{field} is \"{name}\""), accepted)
    })
}

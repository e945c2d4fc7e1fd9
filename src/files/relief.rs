//! Relief meshes written down: Wavefront OBJ as text, PLY in binary.

use super::error::{FileError, Place, Result};
use crate::pattern::{MeshZone, ReliefMesh};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
    PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

impl ReliefMesh {
    /// Writes the mesh to a file, mm: OBJ or PLY, by the end of the file's name.
    ///
    /// An OBJ has a group for each scratch (`scratch_0` on, `surface`) and names a material for each base BRDF (`brdf_0` on).
    /// A PLY (binary, little-endian, coordinates in double precision) has both numbers with each face: `scratch`, -1 on the
    /// unscratched surface, and `brdf`.
    ///
    /// Errors: a name that ends otherwise; a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let write = match extension.to_str() {
            Some("obj") => Self::write_obj,
            Some("ply") => Self::write_ply,
            _ => {
                let found = "a name that ends otherwise";
                let error = FileError::new(Place::Whole, found, "names that end in .obj or .ply");
                return Err(error.in_file(path));
            }
        };
        let written = File::create(path).and_then(|file| {
            let mut out = BufWriter::new(file);
            write(self, &mut out)?;
            out.flush()
        });
        written.map_err(|error| {
            let found = format!("cannot be written ({error})");
            FileError::new(Place::Whole, found, "a file that may be written").in_file(path)
        })
    }

    /// As Wavefront OBJ: scratch by scratch, base BRDF by base BRDF.
    fn write_obj(&self, out: &mut BufWriter<File>) -> io::Result<()> {
        writeln!(out, "# relief of a scratched surface, mm")?;
        for [x, y, z] in &self.positions {
            writeln!(out, "v {x} {y} {z}")?;
        }
        let mut order: Vec<usize> = (0..self.triangles.len()).collect();
        // The surface comes first, its number being that before the first scratch's.
        let key = |&i: &usize| {
            let zone = &self.zones[i];
            (zone.scratch.wrapping_add(1), zone.brdf)
        };
        order.sort_by_key(key);
        let mut last: Option<&MeshZone> = None;
        for i in order {
            let zone = &self.zones[i];
            if last.is_none_or(|last| last.scratch != zone.scratch) {
                match zone.scratch {
                    MeshZone::NO_SCRATCH => writeln!(out, "g surface")?,
                    scratch => writeln!(out, "g scratch_{scratch}")?,
                }
            }
            if last.is_none_or(|last| last.brdf != zone.brdf) {
                writeln!(out, "usemtl brdf_{}", zone.brdf)?;
            }
            last = Some(zone);
            let [a, b, c] = self.triangles[i].map(|corner| u64::from(corner) + 1);
            writeln!(out, "f {a} {b} {c}")?;
        }
        Ok(())
    }

    fn write_ply(&self, out: &mut BufWriter<File>) -> io::Result<()> {
        let scalar = PropertyType::Scalar;
        let mut vertex = ElementDef::new("vertex".into());
        vertex.count = self.positions.len();
        for name in ["x", "y", "z"] {
            let property = PropertyDef::new(name.into(), scalar(ScalarType::Double));
            vertex.properties.add(property);
        }
        let mut face = ElementDef::new("face".into());
        face.count = self.triangles.len();
        let corners = PropertyType::List(ScalarType::UChar, ScalarType::UInt);
        for (name, kind) in [
            ("vertex_indices", corners),
            ("scratch", scalar(ScalarType::Int)),
            ("brdf", scalar(ScalarType::Int)),
        ] {
            face.properties.add(PropertyDef::new(name.into(), kind));
        }
        let mut header = Header::new();
        header.encoding = Encoding::BinaryLittleEndian;
        header
            .comments
            .push("relief of a scratched surface, mm".into());
        header.elements.add(vertex.clone());
        header.elements.add(face.clone());
        let writer = Writer::<Row<'_>>::new();
        writer.write_header(out, &header)?;
        for position in &self.positions {
            writer.write_little_endian_element(out, &Row::Vertex(position), &vertex)?;
        }
        for (triangle, zone) in self.triangles.iter().zip(&self.zones) {
            writer.write_little_endian_element(out, &Row::Face(triangle, zone), &face)?;
        }
        Ok(())
    }
}

/// An element of a PLY file.
enum Row<'m> {
    Vertex(&'m [f64; 3]),
    Face(&'m [u32; 3], &'m MeshZone),
}

impl PropertyAccess for Row<'_> {
    fn new() -> Self {
        Row::Vertex(&[0.0; 3])
    }

    fn set_property(&mut self, _: &str, _: Property) -> PropertyAccessResult {
        PropertyAccessResult::Ignored
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name)?;
        match self {
            Row::Vertex(position) => Some(position[axis]),
            Row::Face(..) => None,
        }
    }

    fn get_list_uint(&self, _: &str) -> Option<&[u32]> {
        match self {
            Row::Face(corners, _) => Some(*corners),
            Row::Vertex(_) => None,
        }
    }

    fn get_int(&self, name: &str) -> Option<i32> {
        let Row::Face(_, zone) = self else {
            return None;
        };
        match name {
            "scratch" => Some(i32::try_from(zone.scratch).unwrap_or(-1)),
            _ => i32::try_from(zone.brdf).ok(),
        }
    }
}

//! What a file's mesh is gathered in, and made a tool from.

use super::error::{FileError, Place, Result};
use crate::formation::{MOST_IN_MESH, Tool};

/// Vertices and triangles, as they are read. Polygons become fans of triangles.
pub(super) struct Polygons {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The highest vertex that a polygon names, and where.
    highest: Option<(u32, Place)>,
    /// What the file's format calls its first vertex.
    first: u32,
}

impl Polygons {
    /// None yet, in a format that counts vertices from `first`.
    pub(super) fn counted_from(first: u32) -> Self {
        Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            highest: None,
            first,
        }
    }

    /// How many vertices were read so far.
    pub(super) fn vertex_count(&self) -> u32 {
        u32::try_from(self.positions.len()).unwrap_or(u32::MAX)
    }

    /// One more vertex.
    pub(super) fn vertex(&mut self, position: [f64; 3], place: Place) -> Result<()> {
        if let Some(bad) = position.iter().find(|value| !value.is_finite()) {
            let found = format!("a coordinate is {bad}");
            return Err(FileError::new(place, found, "finite numbers"));
        }
        room_in(&self.positions, "vertices", place)?;
        self.positions.push(position);
        Ok(())
    }

    /// One more polygon, its corners as numbers of vertices, counted from 0, which may come later.
    pub(super) fn polygon(&mut self, corners: &[u32], place: Place) -> Result<()> {
        let &[hub, second, ref others @ ..] = corners else {
            return Err(too_few(corners, place));
        };
        if others.is_empty() {
            return Err(too_few(corners, place));
        }
        let mut previous = second;
        for &corner in others {
            room_in(&self.triangles, "triangles", place)?;
            self.triangles.push([hub, previous, corner]);
            previous = corner;
        }
        for &corner in corners {
            if self.highest.is_none_or(|(highest, _)| corner > highest) {
                self.highest = Some((corner, place));
            }
        }
        Ok(())
    }

    /// The refusal of a vertex number as it stands in the file.
    pub(super) fn no_such_vertex(&self, number: &str, place: Place) -> FileError {
        let accepted = match self.vertex_count() {
            0 => "a number of a vertex; there are none".to_owned(),
            count => format!("{} to {}", self.first, self.first + (count - 1)),
        };
        FileError::new(
            place,
            format!(
                "a face names the vertex {number}, of {}",
                self.vertex_count()
            ),
            accepted,
        )
    }

    /// The tool. All has been read.
    pub(super) fn into_tool(self, mm_per_unit: f64) -> Result<Tool> {
        let Some((highest, place)) = self.highest else {
            return Err(FileError::new(
                Place::Whole,
                format!("holds no faces, and {} vertices", self.vertex_count()),
                "one face or more",
            ));
        };
        if highest >= self.vertex_count() {
            let number = u64::from(highest) + u64::from(self.first);
            return Err(self.no_such_vertex(&number.to_string(), place));
        }
        Tool::mesh(&self.positions, &self.triangles, mm_per_unit).map_err(FileError::unusable)
    }
}

fn room_in<T>(items: &[T], name: &str, place: Place) -> Result<()> {
    if items.len() < MOST_IN_MESH {
        return Ok(());
    }
    Err(FileError::new(
        place,
        format!("more than {MOST_IN_MESH} {name}"),
        format!("at most {MOST_IN_MESH}"),
    ))
}

fn too_few(corners: &[u32], place: Place) -> FileError {
    let found = format!("a face with {} corners", corners.len());
    FileError::new(place, found, "three corners or more")
}

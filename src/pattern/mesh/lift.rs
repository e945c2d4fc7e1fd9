//! From triangles of the plane to triangles in space: each at its patch's height, with walls where heights jump.

use super::faces::{Face, Faces};
use super::patches::Patches;
use super::{MeshZone, ReliefMesh};
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// Heights at one place that differ by less than this share of the relief's own height are one: they come from
/// patches that meet there.
const SAME_HEIGHT: f64 = 1e-7;

/// Slopes are no steeper than this where a place's own slack is turned into one of height.
const STEEPEST: f64 = 16.0;

/// The mesh of faces and their patches; closed down to `base_mm` below the surface unless that is 0.
pub(super) fn lift(faces: &Faces, patches: &Patches, base_mm: f64) -> ReliefMesh {
    let mut lift = Lift {
        faces,
        patches,
        levels: Levels::new(faces, patches, base_mm),
        crossings: HashMap::new(),
        mesh: ReliefMesh {
            brdfs: patches
                .finishes
                .iter()
                .map(|finish| finish.brdf())
                .collect(),
            ..ReliefMesh::default()
        },
    };
    lift.place_levels();
    for (number, face) in faces.faces.iter().enumerate() {
        lift.add_face(number, face);
    }
    if base_mm > 0.0 {
        lift.add_base(base_mm);
    }
    lift.mesh
}

/// The heights at each place, ascending, each once.
struct Levels {
    /// Where a place's heights start; one more than there are places.
    starts: Vec<usize>,
    heights: Vec<f64>,
    /// Of each face's corners, as places in `heights`.
    of_faces: Vec<[usize; 3]>,
    /// The lowest level on the window's border is the base's.
    is_solid: bool,
}

struct Lift<'a> {
    faces: &'a Faces,
    patches: &'a Patches,
    levels: Levels,
    /// Vertices where two heights along an edge cross, by the edge's places.
    crossings: HashMap<[usize; 2], u32>,
    mesh: ReliefMesh,
}

/// An edge between two faces whose heights differ along it, or at the border of a solid.
struct Jump {
    places: [usize; 2],
    /// Levels at both ends, of the face on the left, then of what is beyond.
    own: [usize; 2],
    other: [usize; 2],
}

impl Levels {
    fn new(faces: &Faces, patches: &Patches, base_mm: f64) -> Self {
        let height = |face: &Face, corner: usize| {
            let patch = face.patch.map(|number| &patches.patches[number]);
            patch.map_or(0.0, |patch| patch.height(faces.places[corner]))
        };
        let all = faces.faces.iter();
        let of_corners: Vec<[f64; 3]> = all
            .map(|face| face.corners.map(|corner| height(face, corner)))
            .collect();
        let relief = of_corners
            .iter()
            .flatten()
            .fold(0.0, |most: f64, z| most.max(z.abs()));
        let same = SAME_HEIGHT * relief + STEEPEST * faces.slack;
        let mut at: Vec<Vec<f64>> = vec![Vec::new(); faces.places.len()];
        for (face, heights) in faces.faces.iter().zip(&of_corners) {
            for i in 0..3 {
                at[face.corners[i]].push(heights[i]);
                if base_mm > 0.0 && face.beyond[i].is_none() {
                    at[face.corners[i]].push(-base_mm);
                    at[face.corners[(i + 1) % 3]].push(-base_mm);
                }
            }
        }
        let (mut starts, mut heights) = (vec![0], Vec::new());
        for here in &mut at {
            here.sort_unstable_by(f64::total_cmp);
            // Each is compared with the lowest of its level, so that levels do not creep.
            let mut lowest = f64::NEG_INFINITY;
            for &z in here.iter() {
                if z > lowest + same {
                    heights.push(z);
                    lowest = z;
                }
            }
            starts.push(heights.len());
        }
        let mut levels = Self {
            starts,
            heights,
            of_faces: Vec::new(),
            is_solid: base_mm > 0.0,
        };
        levels.of_faces = faces
            .faces
            .iter()
            .zip(&of_corners)
            .map(|(face, heights)| [0, 1, 2].map(|i| levels.at(face.corners[i], heights[i])))
            .collect();
        levels
    }

    /// The level at a place that a height belongs to.
    fn at(&self, place: usize, z: f64) -> usize {
        let here = &self.heights[self.starts[place]..self.starts[place + 1]];
        let above = here.partition_point(|level| *level <= z);
        self.starts[place] + above.saturating_sub(1)
    }
}

impl Lift<'_> {
    /// One vertex for each level of each place.
    fn place_levels(&mut self) {
        for (place, at) in self.faces.places.iter().enumerate() {
            for level in self.levels.starts[place]..self.levels.starts[place + 1] {
                let vertex = at.extend(self.levels.heights[level]);
                self.mesh.positions.push(vertex.to_array());
            }
        }
    }

    fn zone(&self, face: &Face) -> MeshZone {
        face.patch.map_or(MeshZone::SURFACE, |number| {
            self.patches.patches[number].zone
        })
    }

    fn order(&self, face: &Face) -> Option<u32> {
        face.patch.map(|number| self.patches.patches[number].order)
    }

    fn push(&mut self, triangle: [u32; 3], zone: MeshZone) {
        self.mesh.triangles.push(triangle);
        self.mesh.zones.push(zone);
    }

    /// Adds a face, and the walls along those of its edges that it is the first one to come to.
    fn add_face(&mut self, number: usize, face: &Face) {
        let own = self.levels.of_faces[number];
        let mut outline: Vec<u32> = Vec::with_capacity(6);
        let mut first_crossing = None;
        for (i, level) in own.into_iter().enumerate() {
            outline.push(vertex(level));
            let Some(jump) = self.jump(number, face, i) else {
                continue;
            };
            let crossing = self.crossing(&jump);
            if let Some(crossing) = crossing {
                first_crossing = first_crossing.or(Some(outline.len()));
                outline.push(crossing);
            }
            let is_first = face.beyond[i].is_none_or(|beyond| number < beyond);
            if is_first {
                let zone = self.wall_zone(face, face.beyond[i]);
                self.add_wall(&jump, crossing, zone);
            }
        }
        // A fan from a point within an edge, if there is one: no triangle of it lies along an edge.
        outline.rotate_left(first_crossing.unwrap_or(0));
        let zone = self.zone(face);
        for i in 1..outline.len() - 1 {
            self.push([outline[0], outline[i], outline[i + 1]], zone);
        }
    }

    /// How heights jump along edge `i` of a face, if they do.
    fn jump(&self, number: usize, face: &Face, i: usize) -> Option<Jump> {
        let next = (i + 1) % 3;
        let places = [face.corners[i], face.corners[next]];
        let own = [i, next].map(|corner| self.levels.of_faces[number][corner]);
        let other = match face.beyond[i] {
            Some(beyond) => {
                let corners = self.faces.faces[beyond].corners;
                let level_at = |place: usize| {
                    let corner = corners.iter().position(|corner| *corner == place)?;
                    Some(self.levels.of_faces[beyond][corner])
                };
                [level_at(places[0])?, level_at(places[1])?]
            }
            None => places.map(|place| self.levels.starts[place]),
        };
        // On an open surface's border the lowest level is some face's own.
        let is_border = face.beyond[i].is_none() && !self.levels.is_solid;
        (own != other && !is_border).then_some(Jump { places, own, other })
    }

    /// Where the two heights along an edge cross, if they do between its ends.
    fn crossing(&mut self, jump: &Jump) -> Option<u32> {
        let rise = |end: usize| {
            let heights = &self.levels.heights;
            heights[jump.own[end]] - heights[jump.other[end]]
        };
        let (from, to) = (rise(0), rise(1));
        if from * to >= 0.0 {
            return None;
        }
        let [a, b] = jump.places;
        if let Some(known) = self.crossings.get(&[a.min(b), a.max(b)]) {
            return Some(*known);
        }
        let share = from / (from - to);
        let point = |end: usize| -> DVec3 {
            let place: DVec2 = self.faces.places[jump.places[end]];
            place.extend(self.levels.heights[jump.own[end]])
        };
        let position = point(0).lerp(point(1), share);
        let number = u32::try_from(self.mesh.positions.len()).unwrap_or(u32::MAX);
        self.mesh.positions.push(position.to_array());
        self.crossings.insert([a.min(b), a.max(b)], number);
        Some(number)
    }

    /// A wall is a part of the later scratch.
    fn wall_zone(&self, face: &Face, beyond: Option<usize>) -> MeshZone {
        let Some(beyond) = beyond else {
            return MeshZone::SURFACE;
        };
        let other = &self.faces.faces[beyond];
        let later = if self.order(other) > self.order(face) {
            other
        } else {
            face
        };
        self.zone(later)
    }

    fn add_wall(&mut self, jump: &Jump, crossing: Option<u32>, zone: MeshZone) {
        let [from, to] = [0, 1].map(|end| steps(jump.own[end], jump.other[end]));
        match crossing {
            Some(crossing) => {
                self.zip(&from, &[crossing], zone);
                self.zip(&[crossing], &to, zone);
            }
            None => self.zip(&from, &to, zone),
        }
    }

    /// Triangles between two upright rows of vertices, each from the face's own level to the other's.
    fn zip(&mut self, from: &[u32], to: &[u32], zone: MeshZone) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < from.len() || j + 1 < to.len() {
            // In step, so that triangles stay as even as they can.
            let is_behind = i * to.len() <= j * from.len();
            if i + 1 < from.len() && (is_behind || j + 1 == to.len()) {
                self.push([to[j], from[i], from[i + 1]], zone);
                i += 1;
            } else {
                self.push([to[j], from[i], to[j + 1]], zone);
                j += 1;
            }
        }
    }

    /// The underside: a fan from the window's middle.
    fn add_base(&mut self, base_mm: f64) {
        let window = self.patches.window;
        let middle = 0.5 * (window.low + window.high);
        let centre = u32::try_from(self.mesh.positions.len()).unwrap_or(u32::MAX);
        self.mesh.positions.push(middle.extend(-base_mm).to_array());
        for face in &self.faces.faces {
            for i in (0..3).filter(|&i| face.beyond[i].is_none()) {
                let ends = [face.corners[i], face.corners[(i + 1) % 3]];
                let [a, b] = ends.map(|place| vertex(self.levels.starts[place]));
                self.mesh.triangles.push([b, a, centre]);
                self.mesh.zones.push(MeshZone::SURFACE);
            }
        }
    }
}

/// Levels from one to another, as vertices.
fn steps(from: usize, to: usize) -> Vec<u32> {
    if from <= to {
        (from..=to).map(vertex).collect()
    } else {
        (to..=from).rev().map(vertex).collect()
    }
}

/// Levels are the first vertices, in their order.
fn vertex(level: usize) -> u32 {
    u32::try_from(level).unwrap_or(u32::MAX)
}

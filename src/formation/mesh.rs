//! Tools as triangle meshes: which of a mesh's edges can carry its lower envelope.

use super::envelope::{Segment, lower_envelope};
use super::outline::{Outline, Piece};
use crate::error::{Error, Result, in_range};
use glam::{DMat3, DVec2, DVec3};
use std::collections::HashMap;

/// Most vertices or triangles of a tool.
pub(crate) const MOST_IN_MESH: usize = 50_000_000;

/// A tool's surface. Its lower envelope along any direction lies on edges; on a closed smooth surface only
/// few of them, those where it turns over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mesh {
    pub(super) vertices: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    edges: Vec<Edge>,
}

/// An edge, and the third corners of its two triangles (the edge's own end where it has not just two).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    ends: [u32; 2],
    corners: [u32; 2],
}

impl Mesh {
    /// A mesh in mm, its lowest point moved to the origin. Vertices at the same place count as one.
    pub(crate) fn from_triangles(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<Self> {
        in_range(
            "triangle_count",
            triangles.len() as f64,
            1.0,
            MOST_IN_MESH as f64,
        )?;
        in_range(
            "position_count",
            vertices.len() as f64,
            1.0,
            MOST_IN_MESH as f64,
        )?;
        let (vertices, number) = welded("positions", vertices)?;
        let mut welded_triangles = Vec::with_capacity(triangles.len());
        let mut sides = Vec::with_capacity(3 * triangles.len());
        for (i, triangle) in triangles.iter().enumerate() {
            let mut corners = [0; 3];
            for (corner, &index) in corners.iter_mut().zip(triangle) {
                *corner = *number.get(index as usize).ok_or_else(|| {
                    let accepted = "indices below position_count";
                    Error::number("", f64::from(index), accepted).within("triangles", i)
                })?;
            }
            welded_triangles.push(corners);
            let [a, b, c] = corners;
            for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                if from != to {
                    sides.push([from.min(to), from.max(to), opposite]);
                }
            }
        }
        sides.sort_unstable();
        let shares_edge = |a: &[u32; 3], b: &[u32; 3]| a[..2] == b[..2];
        let edges = sides.chunk_by(shares_edge).map(|side| {
            let ends = [side[0][0], side[0][1]];
            let corners = if let [a, b] = side {
                [a[2], b[2]]
            } else {
                ends
            };
            Edge { ends, corners }
        });
        Self {
            edges: edges.collect(),
            vertices,
            triangles: welded_triangles,
        }
        .on_its_tip()
    }

    /// A flat sheet across the travel with this lower edge (x to the right, z up, mm), moved likewise.
    pub(crate) fn from_profile(points: &[[f64; 2]]) -> Result<Self> {
        in_range("point_count", points.len() as f64, 2.0, MOST_IN_MESH as f64)?;
        let places: Vec<DVec3> = points.iter().map(|p| DVec3::new(p[0], 0.0, p[1])).collect();
        let (vertices, number) = welded("points_mm", &places)?;
        let edges = number
            .windows(2)
            .filter(|pair| pair[0] != pair[1])
            .map(|pair| {
                let ends = [pair[0], pair[1]];
                Edge {
                    ends,
                    corners: ends,
                }
            });
        Self {
            edges: edges.collect(),
            vertices,
            triangles: Vec::new(),
        }
        .on_its_tip()
    }

    /// Moved so that the middle of its lowest points is the origin.
    fn on_its_tip(mut self) -> Result<Self> {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let used = self
            .edges
            .iter()
            .flat_map(|edge| edge.ends)
            .map(|i| self.vertices[i as usize]);
        let (low, high) = used
            .clone()
            .fold(empty, |(low, high), v| (low.min(v), high.max(v)));
        let size = (high - low).max_element();
        if !(1e-6..=1e4).contains(&size) {
            let accepted = "a tool from 1e-6 to 1e4 mm across";
            return Err(Error::number("size_mm", size.max(0.0), accepted));
        }
        let lowest = used.filter(|v| v.z <= low.z + 1e-9 * size);
        let (sum, count) = lowest.fold((DVec3::ZERO, 0.0), |(sum, n), v| (sum + v, n + 1.0));
        let tip = sum / count;
        self.vertices.iter_mut().for_each(|vertex| *vertex -= tip);
        Ok(self)
    }

    /// The outline of the turned mesh. Where the envelope jumps or has gaps, walls stand upright up to the
    /// tool's top.
    pub(crate) fn outline(&self, rotation: DMat3) -> Option<Outline> {
        let seen: Vec<DVec2> = self
            .vertices
            .iter()
            .map(|&vertex| {
                let turned = rotation * vertex;
                DVec2::new(turned.x, turned.z)
            })
            .collect();
        let segments: Vec<Segment> = self
            .edges
            .iter()
            .filter_map(|edge| edge.on_contour(&seen))
            .collect();
        let envelope = lower_envelope(&segments);
        let top = self
            .edges
            .iter()
            .flat_map(|edge| edge.ends)
            .map(|i| seen[i as usize].y);
        let top = top.fold(f64::NEG_INFINITY, f64::max);
        let mut corners: Vec<DVec2> = Vec::with_capacity(2 * envelope.len() + 2);
        for segment in &envelope {
            let gap = corners.last().is_none_or(|last| last.x < segment.from.x);
            if gap {
                corners.extend(corners.last().map(|last| DVec2::new(last.x, top)));
                corners.push(DVec2::new(segment.from.x, top));
            }
            corners.extend([segment.from, segment.to]);
        }
        corners.push(DVec2::new(corners.last()?.x, top));
        let pieces = corners.windows(2).filter(|pair| pair[0] != pair[1]);
        Some(Outline::new(
            pieces
                .map(|pair| Piece::Line {
                    from: pair[0],
                    to: pair[1],
                })
                .collect(),
        ))
    }
}

impl Edge {
    /// The edge as seen, unless its two triangles lie on both sides of it: then it is inside the tool's
    /// silhouette and cannot be lowest. Edges seen end-on are points of their neighbours.
    fn on_contour(&self, seen: &[DVec2]) -> Option<Segment> {
        let [a, b] = self.ends.map(|i| seen[i as usize]);
        let [side, other] = self.corners.map(|i| (b - a).perp_dot(seen[i as usize] - a));
        if side * other < 0.0 {
            return None;
        }
        let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
        (from.x < to.x).then_some(Segment { from, to })
    }
}

/// The distinct places among `points`, given as the array `name`, and the number of each point's place.
pub(crate) fn welded(name: &'static str, points: &[DVec3]) -> Result<(Vec<DVec3>, Vec<u32>)> {
    let mut places = Vec::new();
    let mut known = HashMap::with_capacity(points.len());
    let mut number = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        for value in point.to_array() {
            in_range("", value, -1e7, 1e7).map_err(|error| error.within(name, i))?;
        }
        // Adding 0 turns -0 into 0.
        let bits = (*point + DVec3::ZERO).to_array().map(f64::to_bits);
        let next = u32::try_from(places.len()).unwrap_or(u32::MAX);
        let place = *known.entry(bits).or_insert(next);
        if place == next {
            places.push(*point);
        }
        number.push(place);
    }
    Ok((places, number))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formation::{Orientation, Tool};
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// A lumpy closed surface: (vertices, triangles), `rings` by `2 rings`.
    fn lump(rings: u32, seed: u64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let mut rng = StdRng::seed_from_u64(seed);
        let spokes = 2 * rings;
        let mut vertices = Vec::new();
        for ring in 0..=rings {
            for spoke in 0..spokes {
                let theta = core::f64::consts::PI * f64::from(ring) / f64::from(rings);
                let phi = core::f64::consts::TAU * f64::from(spoke) / f64::from(spokes);
                let r = 0.5 + 0.2 * rng.random::<f64>();
                let ring_r = r * theta.sin();
                vertices.push(DVec3::new(
                    ring_r * phi.cos(),
                    ring_r * phi.sin(),
                    -r * theta.cos(),
                ));
            }
        }
        let mut triangles = Vec::new();
        for ring in 0..rings {
            for spoke in 0..spokes {
                let at = |r: u32, s: u32| r * spokes + s % spokes;
                let [a, b] = [at(ring, spoke), at(ring, spoke + 1)];
                let [c, d] = [at(ring + 1, spoke), at(ring + 1, spoke + 1)];
                triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
        (vertices, triangles)
    }

    /// Leaving out edges inside the silhouette changes nothing: the envelope of the contour edges is the
    /// envelope of all edges, on non-convex and open meshes.
    #[test]
    fn contour_edges_suffice() {
        for seed in 0..20 {
            let (vertices, mut triangles) = lump(8, seed);
            if seed % 2 == 1 {
                triangles.truncate(triangles.len() - 37);
            }
            let mesh = Mesh::from_triangles(&vertices, &triangles).unwrap();
            let held = Orientation {
                spin_deg: 17.0 * seed as f64,
                tilt_deg: 3.0 * seed as f64,
                azimuth_deg: 71.0 * seed as f64,
            };
            let seen: Vec<DVec2> = mesh
                .vertices
                .iter()
                .map(|&vertex| {
                    let turned = held.rotation() * vertex;
                    DVec2::new(turned.x, turned.z)
                })
                .collect();
            let open = |edge: &Edge| Edge {
                corners: edge.ends,
                ..*edge
            };
            let all: Vec<Segment> = mesh
                .edges
                .iter()
                .filter_map(|edge| open(edge).on_contour(&seen))
                .collect();
            let few: Vec<Segment> = mesh
                .edges
                .iter()
                .filter_map(|edge| edge.on_contour(&seen))
                .collect();
            assert!(few.len() < all.len(), "nothing was left out");
            let area = |segments: &[Segment]| -> f64 {
                let under = |s: &Segment| 0.5 * (s.to.x - s.from.x) * (s.from.y + s.to.y);
                lower_envelope(segments).iter().map(under).sum()
            };
            let (ours, truth) = (area(&few), area(&all));
            assert!(
                (ours - truth).abs() < 1e-12,
                "seed {seed}: {ours} against {truth}"
            );
        }
    }

    /// A pyramid as a mesh leaves what the same pyramid leaves as a convex hull.
    #[test]
    fn pyramid_as_a_mesh() {
        let r = (68_f64.to_radians()).tan() / 45_f64.to_radians().cos();
        let mut vertices = vec![DVec3::ZERO];
        for i in 0..4 {
            let angle = (45.0 + 90.0 * f64::from(i)).to_radians();
            vertices.push(DVec3::new(r * angle.cos(), r * angle.sin(), 1.0));
        }
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
        let mesh = Mesh::from_triangles(&vertices, &triangles).unwrap();
        let held = Orientation {
            spin_deg: 20.0,
            tilt_deg: 8.0,
            azimuth_deg: 130.0,
        };
        let ours = mesh.outline(held.rotation()).unwrap().cut(0.03);
        let hull = Tool::pyramid(4, 136.0, 1.0)
            .unwrap()
            .outline(held)
            .unwrap()
            .cut(0.03);
        assert!(
            (ours.measures.area_mm2 - hull.measures.area_mm2).abs() < 1e-12,
            "area"
        );
        assert!(
            (ours.measures.flank_rad[0] - hull.measures.flank_rad[0]).abs() < 1e-9,
            "flank"
        );
    }
}

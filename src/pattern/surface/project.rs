//! The point of a mesh that is closest to a point of space.

use super::{Side, Surface, Triangle};
use glam::{DVec2, DVec3};
use rstar::{AABB, PointDistance, RTreeObject};

/// A triangle as the tree of all triangles knows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub index: u32,
    pub corners: [DVec3; 3],
}

impl RTreeObject for Face {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b, c] = self.corners;
        AABB::from_corners(a.min(b).min(c).to_array(), a.max(b).max(c).to_array())
    }
}

impl PointDistance for Face {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = DVec3::from(*point);
        at(&self.corners, weights(&self.corners, point)).distance_squared(point)
    }
}

/// A place on the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub triangle: u32,
    pub point: DVec3,
    pub uv: DVec2,
    /// How far beyond the mesh's border its original lies, in units of a triangle's size; 0 over the mesh.
    pub beyond: f64,
}

/// A point of a triangle by the weights of its corners.
fn at(corners: &[DVec3; 3], weights: [f64; 3]) -> DVec3 {
    corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]
}

/// Corner weights of a triangle's closest point (Ericson, Real-Time Collision Detection, section 5.1.5).
fn weights(corners: &[DVec3; 3], p: DVec3) -> [f64; 3] {
    let [a, b, c] = *corners;
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let sum = va + vb + vc;
    [va / sum, vb / sum, vc / sum]
}

impl Surface {
    /// The mesh's closest point.
    pub(super) fn project(&self, point: DVec3) -> Option<Spot> {
        let index = self.tree.nearest_neighbor(&point.to_array())?.index;
        let triangle = self.triangle(index);
        let weights = weights(&triangle.corners, point);
        let closest = at(&triangle.corners, weights);
        let [a, b, c] = triangle.uv;
        Some(Spot {
            triangle: index,
            point: closest,
            uv: a * weights[0] + b * weights[1] + c * weights[2],
            beyond: self.beyond(triangle, weights, point - closest),
        })
    }

    /// How far `away` leads beyond the border, if the closest point lies there.
    fn beyond(&self, triangle: &Triangle, weights: [f64; 3], away: DVec3) -> f64 {
        let corner = (0..3).find(|&k| weights[k] == 1.0);
        let side = (0..3).find(|&k| weights[(k + 2) % 3] == 0.0);
        let borders = match (corner, side) {
            (Some(k), _) => self.on_border[triangle.places[k] as usize],
            (None, Some(k)) => triangle.sides[k] == Side::Border,
            (None, None) => false,
        };
        let sideways = away - triangle.normal * triangle.normal.dot(away);
        if borders {
            sideways.length() / triangle.size()
        } else {
            0.0
        }
    }

    /// The same place as a point of `triangle`, if it is one.
    pub(super) fn seen_from(&self, triangle: u32, spot: &Spot) -> Spot {
        let Triangle { corners, uv, .. } = self.triangle(triangle);
        let weights = weights(corners, spot.point);
        let moved = at(corners, weights).distance(spot.point);
        if triangle == spot.triangle || moved > 1e-9 * self.size {
            return *spot;
        }
        Spot {
            triangle,
            uv: uv[0] * weights[0] + uv[1] * weights[1] + uv[2] * weights[2],
            ..*spot
        }
    }

    /// The point of a triangle that is closest to `point`.
    pub(super) fn closest_in(&self, triangle: u32, point: DVec3) -> DVec3 {
        let corners = &self.triangle(triangle).corners;
        at(corners, weights(corners, point))
    }
}

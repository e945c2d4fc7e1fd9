//! Triangle meshes with texture coordinates, and paths drawn on them carried into texture space.
//!
//! In: a mesh and a curve near it. Out: the curve's projection as smooth cubics in (u, v), parted where texture space
//! is, with arc lengths measured on the mesh. Build time only.

mod fit;
mod project;
mod route;
mod trace;

use crate::error::{Error, Result, in_range};
use crate::formation::welded;
use glam::{DVec2, DVec3};
use project::Face;
use rstar::RTree;
use std::collections::HashMap;

pub(super) use fit::curves;
pub(super) use trace::trace;

/// A triangle mesh with texture coordinates, for paths that are drawn on it. Immutable.
#[derive(Clone, Debug)]
pub struct Surface {
    triangles: Vec<Triangle>,
    tree: RTree<Face>,
    /// Which places lie on the mesh's border.
    on_border: Vec<bool>,
    /// A triangle's mean size, scene units.
    size: f64,
}

/// One triangle, its corners in the order given.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corners: [DVec3; 3],
    uv: [DVec2; 3],
    places: [u32; 3],
    /// What lies across the side from each corner to the next.
    sides: [Side; 3],
    normal: DVec3,
    /// Derivatives of position by u and by v.
    dp: [DVec3; 2],
    /// How far it may lie from the smooth surface it stands for, scene units.
    slack: f64,
}

/// What lies across a triangle's side.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    /// Nothing: the mesh ends.
    Border,
    /// More than one triangle.
    Fork,
    /// Another triangle, and how texture goes on.
    Next(u32, Joint),
}

/// How texture space goes on from a triangle to its neighbour.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Joint {
    /// As if both were one smooth surface.
    Smooth,
    /// Without a gap, yet at a bend that is meant: the surface or its texture turns there.
    Crease,
    /// Elsewhere.
    Seam,
}

/// Neighbours that turn or stretch by more than this (radians, or share of length) meet at a crease.
const CREASE: f64 = 0.6;

/// Half the sagitta of an arc that turns by 1 from one triangle's middle to the next is 1 / 16 of its length: so far a
/// path may stray for smoothness. Neighbours that turn by more than this leave no more freedom.
const MOST_BEND: f64 = 0.3;

impl Surface {
    /// A mesh of vertices with a position (scene units, -1e7 to 1e7) and a (u, v) (-1e9 to 1e9) each. Where
    /// texture space has a seam the vertices are there twice, as renderers have them: those at exactly the same
    /// position count as one place of the surface. Either winding will do, also a mixture; charts may be mirrored.
    ///
    /// Triangles without area, in space or in texture space, are left out.
    ///
    /// Errors: unequal counts, indices without a vertex, values out of range, no triangle with area.
    pub fn new(positions: &[[f64; 3]], uv: &[[f64; 2]], triangles: &[[u32; 3]]) -> Result<Self> {
        if uv.len() != positions.len() {
            let accepted = "as many as there are positions";
            return Err(Error::count("uv_count", uv.len(), accepted));
        }
        for (i, uv) in uv.iter().enumerate() {
            for &value in uv {
                in_range("", value, -1e9, 1e9).map_err(|error| error.within("uv", i))?;
            }
        }
        let points: Vec<DVec3> = positions.iter().copied().map(DVec3::from).collect();
        let (places, number) = welded("positions", &points)?;
        let mut sound = Vec::with_capacity(triangles.len());
        for (i, &indices) in triangles.iter().enumerate() {
            if let Some(&index) = indices.iter().find(|&&k| k as usize >= points.len()) {
                let accepted = "indices below the count of positions";
                return Err(Error::number("", f64::from(index), accepted).within("triangles", i));
            }
            let indices = indices.map(|k| k as usize);
            let uv = indices.map(|k| DVec2::from(uv[k]));
            sound.extend(Triangle::new(indices.map(|k| number[k]), &places, uv));
        }
        if sound.is_empty() || u32::try_from(sound.len()).is_err() {
            let accepted = "1 to 2^32 - 1 triangles with an area in space and in texture space";
            return Err(Error::count("triangle_count", sound.len(), accepted));
        }
        let on_border = join(&mut sound, places.len());
        let size = sound.iter().map(Triangle::size).sum::<f64>() / sound.len() as f64;
        let faces = (0_u32..).zip(&sound);
        let faces = faces.map(|(index, triangle)| Face {
            index,
            corners: triangle.corners,
        });
        Ok(Self {
            tree: RTree::bulk_load(faces.collect()),
            triangles: sound,
            on_border,
            size,
        })
    }

    fn triangle(&self, index: u32) -> &Triangle {
        &self.triangles[index as usize]
    }
}

impl Triangle {
    /// `None` without area in space or in texture space.
    fn new(places: [u32; 3], all: &[DVec3], uv: [DVec2; 3]) -> Option<Self> {
        let corners = places.map(|k| all[k as usize]);
        let (e, f) = (corners[1] - corners[0], corners[2] - corners[0]);
        let (g, h) = (uv[1] - uv[0], uv[2] - uv[0]);
        let longest = e.length_squared().max(f.length_squared());
        let area = e.cross(f);
        let area_uv = g.perp_dot(h);
        let longest_uv = g.length_squared().max(h.length_squared());
        if area.length() <= 1e-12 * longest || area_uv.abs() <= 1e-12 * longest_uv {
            return None;
        }
        Some(Self {
            corners,
            uv,
            places,
            sides: [Side::Border; 3],
            normal: area.try_normalize()?,
            dp: [(e * h.y - f * g.y) / area_uv, (f * g.x - e * h.x) / area_uv],
            slack: 0.0,
        })
    }

    /// The side of a square of its area, twice over.
    fn size(&self) -> f64 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a).length().sqrt()
    }

    fn side(&self, k: usize) -> [usize; 2] {
        [k, (k + 1) % 3]
    }

    fn side_places(&self, k: usize) -> [u32; 2] {
        let [a, b] = self.side(k).map(|k| self.places[k]);
        [a.min(b), a.max(b)]
    }

    /// (u, v) of a place of this triangle's.
    fn uv_of(&self, place: u32) -> DVec2 {
        let corner = self.places.iter().position(|&k| k == place);
        self.uv[corner.unwrap_or(0)]
    }

    /// A step in (u, v) as one in space.
    fn in_space(&self, step: DVec2) -> DVec3 {
        self.dp[0] * step.x + self.dp[1] * step.y
    }

    /// A step in space as one in (u, v).
    fn in_texture(&self, step: DVec3) -> DVec2 {
        let [u, v] = self.dp;
        let n = self.normal;
        let area = u.cross(v).dot(n);
        DVec2::new(step.cross(v).dot(n), u.cross(step).dot(n)) / area
    }

    /// Across side k, out of the triangle, in its plane.
    fn outward(&self, k: usize) -> DVec3 {
        let [a, b] = self.side(k).map(|k| self.corners[k]);
        let across = (b - a).cross(self.normal).normalize_or_zero();
        let inside = self.corners[(k + 2) % 3] - a;
        if across.dot(inside) > 0.0 {
            -across
        } else {
            across
        }
    }
}

/// Finds each side's neighbour. Returns which places lie on the border.
fn join(triangles: &mut [Triangle], places: usize) -> Vec<bool> {
    let mut sides: HashMap<[u32; 2], Vec<(u32, usize)>> = HashMap::new();
    for (index, triangle) in (0_u32..).zip(triangles.iter()) {
        for k in 0..3 {
            let of_side = sides.entry(triangle.side_places(k)).or_default();
            of_side.push((index, k));
        }
    }
    let mut on_border = vec![false; places];
    for (ends, of_side) in sides {
        match of_side[..] {
            [_] => ends.iter().for_each(|&k| on_border[k as usize] = true),
            [a, b] => join_two(triangles, ends, a, b),
            _ => {
                for (index, k) in of_side {
                    triangles[index as usize].sides[k] = Side::Fork;
                }
            }
        }
    }
    on_border
}

fn join_two(triangles: &mut [Triangle], ends: [u32; 2], a: (u32, usize), b: (u32, usize)) {
    let (first, second) = (triangles[a.0 as usize], triangles[b.0 as usize]);
    let extent = |t: &Triangle| (t.uv[1] - t.uv[0]).length() + (t.uv[2] - t.uv[0]).length();
    let gap = |k: u32| first.uv_of(k).distance(second.uv_of(k));
    let apart = ends.into_iter().map(gap).fold(0.0, f64::max);
    let (out, back) = (first.outward(a.1), second.outward(b.1));
    let turn = out.angle_between(-back);
    // How much faster the one moves in texture space than the other, away from their common side.
    let ahead = first.in_space(first.in_texture(out) + second.in_texture(back));
    let bend = turn.max(ahead.length());
    let joint = if apart > 1e-6 * extent(&first).min(extent(&second)) {
        Joint::Seam
    } else if bend > CREASE {
        Joint::Crease
    } else {
        Joint::Smooth
    };
    let smooth = if joint == Joint::Smooth { bend } else { turn };
    let slack = if smooth > CREASE {
        0.0
    } else {
        smooth.min(MOST_BEND) / 16.0
    };
    for ((index, k), (other, _)) in [(a, b), (b, a)] {
        let triangle = &mut triangles[index as usize];
        triangle.sides[k] = Side::Next(other, joint);
        triangle.slack = triangle.slack.max(slack * triangle.size());
    }
}

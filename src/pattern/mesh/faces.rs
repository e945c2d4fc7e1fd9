//! The triangles of the plane, each with the patch that lies on top there.

use super::arrangement::Plan;
use super::patches::{Patches, tree};
use crate::error::{Error, Result};
use glam::DVec2;
use rayon::prelude::*;
use rstar::AABB;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Triangles of the plane that fill the window.
#[derive(Debug)]
pub(super) struct Faces {
    pub places: Vec<DVec2>,
    /// Counter-clockwise.
    pub faces: Vec<Face>,
    /// How far a place may be from where it belongs, mm.
    pub slack: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub corners: [usize; 3],
    /// The number of its patch; none for the unscratched surface.
    pub patch: Option<usize>,
    /// The face on the other side of each edge, from a corner to the next; none on the window's border.
    pub beyond: [Option<usize>; 3],
}

/// Constrained Delaunay triangulation of a plan.
pub(super) fn triangulate(plan: Plan, patches: &Patches) -> Result<Faces> {
    let refused = |_| {
        Error::text(
            "low_uv",
            "too far away or too small",
            "a region to triangulate",
        )
    };
    // Relative to the window: spade refuses numbers that are too small to be squared, and rounds large ones.
    let base = patches.window.low;
    let unit = (patches.window.high - base).max_element();
    let points = plan.places.iter().map(|place| {
        let [x, y] = ((*place - base) / unit).to_array().map(whole);
        Point2::new(x, y)
    });
    let mut crossing = Vec::new();
    let mut cdt: ConstrainedDelaunayTriangulation<Point2<f64>> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(points.collect(), plan.lines, |line| {
            crossing.push(line);
        })
        .map_err(refused)?;
    // Lines that only rounding made cross.
    for [from, to] in crossing {
        let [from, to] = [from, to].map(FixedVertexHandle::from_index);
        cdt.add_constraint_and_split(from, to, |place| place);
    }
    let place = |position: Point2<f64>| base + DVec2::new(position.x, position.y) * unit;
    let places: Vec<DVec2> = cdt.vertices().map(|v| place(v.position())).collect();
    let on_top = OnTop::new(patches, plan.slack);
    let bare = cdt.inner_faces().map(|face| Face {
        corners: face.vertices().map(|vertex| vertex.fix().index()),
        patch: None,
        // Numbers of inner faces follow that of the outer one.
        beyond: face
            .adjacent_edges()
            .map(|edge| edge.rev().face().fix().index().checked_sub(1)),
    });
    let mut faces: Vec<Face> = bare.collect();
    faces.par_iter_mut().for_each(|face| {
        let middle = face
            .corners
            .map(|corner| places[corner])
            .iter()
            .sum::<DVec2>()
            / 3.0;
        face.patch = on_top.at(middle);
    });
    Ok(Faces {
        faces,
        places,
        slack: plan.slack,
    })
}

/// Numbers of no account are 0.
fn whole(x: f64) -> f64 {
    if x.abs() < 1e-15 { 0.0 } else { x }
}

/// Finds the latest patch at a place.
struct OnTop<'a> {
    patches: &'a Patches,
    tree: rstar::RTree<super::patches::Placed>,
    slack: f64,
}

impl<'a> OnTop<'a> {
    fn new(patches: &'a Patches, slack: f64) -> Self {
        let boxes = patches.patches.iter().enumerate();
        let tree = tree(boxes.map(|(i, patch)| (i, patch.corners.map(|p| p.truncate()))));
        Self {
            patches,
            tree,
            slack,
        }
    }

    fn at(&self, place: DVec2) -> Option<usize> {
        let here = AABB::from_corners(
            (place - self.slack).to_array(),
            (place + self.slack).to_array(),
        );
        let near = self.tree.locate_in_envelope_intersecting(&here);
        let holding = near.filter(|placed| {
            let patch = &self.patches.patches[placed.number];
            patch.holds(place, self.slack)
        });
        let latest = holding.max_by_key(|placed| {
            let patch = &self.patches.patches[placed.number];
            // Of two that meet here the one that truly holds the place, if only one does.
            (patch.order, patch.holds(place, 0.0), placed.number)
        });
        latest.map(|placed| placed.number)
    }
}

//! The flat pieces that a relief is made of, in the order in which they were scratched.

use super::{MeshZone, Window};
use crate::brdf::Finish;
use crate::error::{Error, Result};
use crate::pattern::tracks::TrackRef;
use glam::{DVec2, DVec3};
use rstar::{AABB, RTree, RTreeObject};
use std::collections::HashMap;

/// Patches that a region may hold: some gigabytes while they are sorted out.
const MOST_PATCHES: usize = 10_000_000;

/// A triangle of relief.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Counter-clockwise from above.
    pub corners: [DVec3; 3],
    pub zone: MeshZone,
    /// Number of its [`Cover`]: what has a higher one is later.
    pub order: u32,
}

/// What a stretch of scratch or a part of its end covers in all: a convex polygon, counter-clockwise; empty if that is not
/// convex.
#[derive(Clone, Debug)]
pub(super) struct Cover {
    pub corners: Vec<DVec2>,
    pub order: u32,
}

/// Patches within a window.
#[derive(Debug)]
pub(super) struct Patches {
    pub window: Window,
    pub patches: Vec<Patch>,
    pub covers: Vec<Cover>,
    pub finishes: Vec<Finish>,
    next_order: u32,
}

/// What the facets of one scratch's cross-section are made of.
#[derive(Clone, Debug)]
pub(super) struct Skins {
    scratch: u32,
    /// Each layer's lower interface, z, mm, and the number of its finish.
    layers: Vec<(f64, u32)>,
    bulk: u32,
}

/// Which part of a cross-section a facet is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    OuterFlank,
    /// Pushed up from as deep as this, mm.
    InnerFlank(f64),
    Groove,
}

/// Two cross-sections that rails join, each from left to right (or, of a fan, from its middle outward).
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip<'a> {
    pub from: &'a [DVec3],
    pub to: &'a [DVec3],
    pub travel: DVec2,
    /// How many facets before the first one of these there are in the whole cross-section.
    pub skipped: usize,
}

impl Patches {
    pub(super) fn new(surface: Finish, window: Window) -> Self {
        Self {
            window,
            patches: Vec::new(),
            covers: Vec::new(),
            finishes: vec![surface],
            next_order: 0,
        }
    }

    /// How far the deepest patch lies below the surface.
    pub(super) fn deepest_mm(&self) -> f64 {
        let corners = self.patches.iter().flat_map(|patch| patch.corners);
        -corners.fold(0.0, |lowest, corner| corner.z.min(lowest))
    }

    pub(super) fn skins(&mut self, scratch: u32, track: &TrackRef<'_>) -> Skins {
        let layer = |layer: &crate::pattern::tracks::LayerFinish| {
            (f64::from(layer.bottom_mm), self.number(&layer.finish))
        };
        Skins {
            scratch,
            layers: track.layers().iter().map(layer).collect(),
            bulk: self.number(track.bulk()),
        }
    }

    fn number(&mut self, finish: &Finish) -> u32 {
        let known = self.finishes.iter().position(|known| known == finish);
        let number = known.unwrap_or(self.finishes.len());
        if known.is_none() {
            self.finishes.push(*finish);
        }
        u32::try_from(number).unwrap_or(0)
    }

    /// Adds the facets between two cross-sections, unless all of them lie outside the window.
    pub(super) fn push(&mut self, strip: &Strip<'_>, skins: &Skins) -> Result<()> {
        let all = || strip.from.iter().chain(strip.to).map(|p| p.truncate());
        let low = all().fold(DVec2::INFINITY, DVec2::min);
        let high = all().fold(DVec2::NEG_INFINITY, DVec2::max);
        if self.window.misses(low, high) || strip.from.len() < 2 {
            return Ok(());
        }
        if self.patches.len() > MOST_PATCHES {
            let accepted = "a region with less in it, or a larger tolerance_mm";
            return Err(Error::count("triangle_count", self.patches.len(), accepted));
        }
        let order = self.next_order;
        self.next_order += 1;
        let last = strip.from.len() - 1;
        let lowest = strip.from.iter().chain(strip.to).map(|p| p.z);
        let deepest_mm = lowest.fold(0.0, f64::min);
        for k in 0..last {
            let part = match (k + strip.skipped).min(last - 1 - k) {
                0 => Part::OuterFlank,
                1 => Part::InnerFlank(deepest_mm),
                _ => Part::Groove,
            };
            let (a, b) = (strip.from[k], strip.from[k + 1]);
            let (c, d) = (strip.to[k + 1], strip.to[k]);
            for corners in [[a, b, c], [a, c, d]] {
                self.push_in_layers(corners, part, strip.travel, order, skins);
            }
        }
        let corner = |p: DVec3| p.truncate();
        let outline = [strip.from[0], strip.from[last], strip.to[last], strip.to[0]];
        self.covers.push(Cover {
            corners: convex(outline.map(corner)),
            order,
        });
        Ok(())
    }

    fn push_in_layers(
        &mut self,
        corners: [DVec3; 3],
        part: Part,
        travel: DVec2,
        order: u32,
        skins: &Skins,
    ) {
        let mut push = |corners: [DVec3; 3], brdf: u32| {
            if let Some(corners) = counter_clockwise(corners) {
                self.patches.push(Patch {
                    corners,
                    order,
                    zone: MeshZone {
                        scratch: skins.scratch,
                        brdf,
                        travel: travel.as_vec2().to_array(),
                    },
                });
            }
        };
        match part {
            Part::OuterFlank => push(corners, skins.at(0.0)),
            Part::InnerFlank(deepest_mm) => push(corners, skins.at(deepest_mm)),
            Part::Groove => {
                let mut pieces = vec![corners];
                for &(bottom_mm, _) in &skins.layers {
                    pieces = pieces
                        .iter()
                        .flat_map(|piece| cut_at(*piece, bottom_mm))
                        .collect();
                }
                for piece in pieces {
                    let middle = (piece[0] + piece[1] + piece[2]) / 3.0;
                    push(piece, skins.at(middle.z));
                }
            }
        }
    }

    /// All sides of patches, each once, as a part of the latest one.
    pub(super) fn sides(&self) -> Vec<([DVec2; 2], u32)> {
        let mut latest: HashMap<[[u64; 2]; 2], ([DVec2; 2], u32)> = HashMap::new();
        for patch in &self.patches {
            for i in 0..3 {
                let ends = [patch.corners[i], patch.corners[(i + 1) % 3]].map(|p| p.truncate());
                let mut key = ends.map(|p| p.to_array().map(f64::to_bits));
                key.sort_unstable();
                let side = latest.entry(key).or_insert((ends, patch.order));
                side.1 = side.1.max(patch.order);
            }
        }
        let mut sides: Vec<_> = latest.into_iter().collect();
        // A map has no order of its own.
        sides.sort_unstable_by_key(|(key, (_, order))| (*order, *key));
        sides.into_iter().map(|(_, side)| side).collect()
    }
}

impl Skins {
    /// The number of the finish at a height.
    fn at(&self, z_mm: f64) -> u32 {
        let layer = self.layers.iter().find(|(bottom_mm, _)| z_mm >= *bottom_mm);
        layer.map_or(self.bulk, |(_, finish)| *finish)
    }
}

impl Patch {
    /// The height at a place; beside the patch, that at the nearest of its own places or so.
    pub(super) fn height(&self, place: DVec2) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner.truncate());
        let whole = (b - a).perp_dot(c - a);
        let shares = [
            (b - place).perp_dot(c - place),
            (c - place).perp_dot(a - place),
            (a - place).perp_dot(b - place),
        ]
        .map(|part| (part / whole).clamp(0.0, 1.0));
        let sum: f64 = shares.iter().sum();
        let heights = shares.iter().zip(self.corners).map(|(s, p)| s * p.z);
        heights.sum::<f64>() / sum
    }

    /// Whether a place lies on it, or as little as `slack` beside.
    pub(super) fn holds(&self, place: DVec2, slack: f64) -> bool {
        (0..3).all(|i| {
            let [a, b] = [self.corners[i], self.corners[(i + 1) % 3]].map(|p| p.truncate());
            (b - a).perp_dot(place - a) >= -slack * (b - a).length()
        })
    }
}

/// A patch by its number, for a tree of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    low: [f64; 2],
    high: [f64; 2],
    pub number: usize,
}

impl RTreeObject for Placed {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.low, self.high)
    }
}

/// A tree of numbered boxes around points.
pub(super) fn tree<P: IntoIterator<Item = DVec2>>(
    boxes: impl Iterator<Item = (usize, P)>,
) -> RTree<Placed> {
    let placed = boxes.map(|(number, points)| {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let grow = |(low, high): (DVec2, DVec2), p: DVec2| (low.min(p), high.max(p));
        let (low, high) = points.into_iter().fold(empty, grow);
        Placed {
            low: low.to_array(),
            high: high.to_array(),
            number,
        }
    });
    RTree::bulk_load(placed.collect())
}

/// Nothing if it has no area from above.
fn counter_clockwise([a, b, c]: [DVec3; 3]) -> Option<[DVec3; 3]> {
    let area = (b - a).truncate().perp_dot((c - a).truncate());
    match area {
        area if area > 0.0 => Some([a, b, c]),
        area if area < 0.0 => Some([a, c, b]),
        _ => None,
    }
}

/// The corners if they are those of a convex polygon, counter-clockwise.
fn convex(corners: [DVec2; 4]) -> Vec<DVec2> {
    let mut distinct = corners.to_vec();
    distinct.dedup();
    if distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    let count = distinct.len();
    let turns_left = |i: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| distinct[(i + step) % count]);
        (b - a).perp_dot(c - b) > 0.0
    };
    if count >= 3 && (0..count).all(turns_left) {
        distinct
    } else {
        Vec::new()
    }
}

/// A triangle cut at a height into triangles that lie above or below.
fn cut_at(corners: [DVec3; 3], z: f64) -> Vec<[DVec3; 3]> {
    let below = corners.map(|corner| corner.z < z);
    // The corner that has no other on its side.
    let Some(lone) = (0..3).find(|&i| {
        let others = [below[(i + 1) % 3], below[(i + 2) % 3]];
        others[0] == others[1] && others[0] != below[i]
    }) else {
        return vec![corners];
    };
    let [a, b, c] = [0, 1, 2].map(|step| corners[(lone + step) % 3]);
    let crossing = |to: DVec3| a.lerp(to, ((z - a.z) / (to.z - a.z)).clamp(0.0, 1.0));
    let (ab, ac) = (crossing(b), crossing(c));
    vec![[a, ab, ac], [ab, b, c], [ab, c, ac]]
}

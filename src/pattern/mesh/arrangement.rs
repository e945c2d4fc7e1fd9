//! Sides of patches in the plane, less what later scratches cover, split where they meet.

use super::Window;
use super::patches::{Cover, Patches, Placed, tree};
use glam::{DVec2, I64Vec2};
use rayon::prelude::*;
use rstar::{AABB, RTree};
use std::collections::{HashMap, HashSet};

/// Places closer to one another than this share of the window's size are one: far above rounding, far below
/// anything that a cross-section means.
const SAME_PLACE: f64 = 1e-11;

/// What covers a side reaches a quarter of that over its border, so that what is cut there meets it.
const OVER: f64 = 0.25;

/// Long sides are looked up in parts of this share of the window's size, whose boxes hold little else.
const BOX: f64 = 1.0 / 64.0;

/// Places and the straight lines between them, which meet at places only.
#[derive(Debug, Default)]
pub(super) struct Plan {
    pub places: Vec<DVec2>,
    pub lines: Vec<[usize; 2]>,
    /// How far a place may be from where it belongs.
    pub slack: f64,
}

/// Places, each once.
struct Places {
    all: Vec<DVec2>,
    cells: HashMap<I64Vec2, Vec<usize>>,
    same: f64,
    window: Window,
}

/// The plan of all patches, with the window's border.
pub(super) fn arrange(patches: &Patches) -> Plan {
    let window = patches.window;
    let size = (window.high - window.low).length();
    let far = window.low.abs().max(window.high.abs()).max_element();
    let same = (SAME_PLACE * size).max(32.0 * f64::EPSILON * far);
    let mut sides = uncovered(patches, OVER * same);
    let corners = window.corners();
    sides.extend((0..4).map(|i| [corners[i], corners[(i + 1) % 4]]));
    let splits = splits(&sides, same, BOX * size);
    let mut places = Places {
        all: Vec::new(),
        cells: HashMap::new(),
        same,
        window,
    };
    let mut lines = HashSet::new();
    let mut ordered = Vec::new();
    for (side, mut shares) in sides.iter().zip(splits) {
        shares.extend([0.0, 1.0]);
        shares.sort_unstable_by(f64::total_cmp);
        let mut last = None;
        for share in shares {
            let place = places.number(side[0].lerp(side[1], share));
            if let Some(last) = last.filter(|last| *last != place) {
                let line = [place.min(last), place.max(last)];
                if lines.insert(line) {
                    ordered.push(line);
                }
            }
            last = Some(place);
        }
    }
    Plan {
        places: places.all,
        lines: ordered,
        slack: same,
    }
}

/// Sides within the window, less what later patches cover.
fn uncovered(patches: &Patches, over: f64) -> Vec<[DVec2; 2]> {
    let usable = |cover: &Cover| !cover.corners.is_empty();
    let covers: Vec<&Cover> = patches.covers.iter().filter(|c| usable(c)).collect();
    let boxes = covers.iter().enumerate();
    let tree = tree(boxes.map(|(i, cover)| (i, cover.corners.iter().copied())));
    let window = Cover {
        corners: patches.window.corners().to_vec(),
        order: u32::MAX,
    };
    let left = |&(side, order): &([DVec2; 2], u32)| {
        let mut parts: Vec<[f64; 2]> = within(&side, &window, 0.0).into_iter().collect();
        for placed in touched(&tree, side) {
            let cover = covers[placed.number];
            if cover.order <= order {
                continue;
            }
            if let Some(hidden) = within(&side, cover, over) {
                parts = parts.iter().flat_map(|p| without(*p, hidden)).collect();
            }
        }
        let least = 4.0 * over / (side[1] - side[0]).length();
        parts.retain(|[from, to]| to - from > least);
        let place = move |share: f64| side[0].lerp(side[1], share);
        parts.into_iter().map(move |part| part.map(place))
    };
    patches.sides().par_iter().flat_map_iter(left).collect()
}

fn touched(tree: &RTree<Placed>, [a, b]: [DVec2; 2]) -> impl Iterator<Item = &Placed> {
    let around = AABB::from_corners(a.min(b).to_array(), a.max(b).to_array());
    tree.locate_in_envelope_intersecting(&around)
}

/// From which to which share of a side it lies within a polygon that is so much larger all around (Cyrus and Beck
/// 1978).
fn within([a, b]: &[DVec2; 2], cover: &Cover, over: f64) -> Option<[f64; 2]> {
    let corners = &cover.corners;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (i, &p) in corners.iter().enumerate() {
        let edge = (corners[(i + 1) % corners.len()] - p).normalize_or_zero();
        let inside = [a, b].map(|end| edge.perp_dot(*end - p) + over);
        match inside.map(|at| at < 0.0) {
            [true, true] => return None,
            [true, false] => from = from.max(inside[0] / (inside[0] - inside[1])),
            [false, true] => to = to.min(inside[0] / (inside[0] - inside[1])),
            [false, false] => {}
        }
    }
    (from < to).then_some([from, to])
}

/// A part of a side without another.
fn without([from, to]: [f64; 2], hidden: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let rest = [[from, to.min(hidden[0])], [from.max(hidden[1]), to]];
    rest.into_iter().filter(|[from, to]| from < to)
}

/// For each side the shares of its length at which another one meets or crosses it.
fn splits(sides: &[[DVec2; 2]], same: f64, longest: f64) -> Vec<Vec<f64>> {
    let parts = |&[a, b]: &[DVec2; 2]| {
        let count = ((b - a).length() / longest).ceil().clamp(1.0, 1000.0);
        let part = move |i: u32| {
            let ends = [0.0, 1.0].map(|end| a.lerp(b, (f64::from(i) + end) / count));
            [ends[0].min(ends[1]) - same, ends[0].max(ends[1]) + same]
        };
        (0_u32..)
            .take_while(move |i| f64::from(*i) < count)
            .map(part)
    };
    let boxes = sides.iter().enumerate();
    let tree = tree(boxes.flat_map(|(i, side)| parts(side).map(move |part| (i, part))));
    let meet = |(i, side): (usize, &[DVec2; 2])| {
        let mut shares = Vec::new();
        for part in parts(side) {
            for placed in touched(&tree, part) {
                if placed.number != i {
                    meets(side, &sides[placed.number], same, &mut shares);
                }
            }
        }
        shares
    };
    sides.par_iter().enumerate().map(meet).collect()
}

/// Where another side meets or crosses one, as shares of its length.
fn meets([a, b]: &[DVec2; 2], [p, q]: &[DVec2; 2], same: f64, shares: &mut Vec<f64>) {
    let (along, length) = (*b - *a, (*b - *a).length());
    let beside = |place: &DVec2| along.perp_dot(*place - *a) / length;
    let sides = [beside(p), beside(q)];
    let mut ends_here = false;
    for (end, beside) in [p, q].into_iter().zip(sides) {
        let share = along.dot(*end - *a) / (length * length);
        if beside.abs() <= same && share * length > -same && (1.0 - share) * length > -same {
            ends_here = true;
            if share > 0.0 && share < 1.0 {
                shares.push(share);
            }
        }
    }
    if ends_here || (sides[0] < 0.0) == (sides[1] < 0.0) {
        return;
    }
    let other = *q - *p;
    let crosses = [a, b].map(|end| other.perp_dot(*end - *p) / other.length());
    // Where this one ends on the other, that one is split there.
    if crosses.iter().any(|beside| beside.abs() <= same) {
        return;
    }
    if (crosses[0] < 0.0) != (crosses[1] < 0.0) {
        shares.push(crosses[0] / (crosses[0] - crosses[1]));
    }
}

impl Places {
    fn number(&mut self, place: DVec2) -> usize {
        let place = self.on_border(place);
        // Cells so large that what is the same lies in this one or the next, and numbers stay small.
        let cell = |offset: I64Vec2| (place / (4.0 * self.same)).floor().as_i64vec2() + offset;
        for offset in (-1_i64..=1).flat_map(|x| (-1_i64..=1).map(move |y| I64Vec2::new(x, y))) {
            let near = self.cells.get(&cell(offset)).into_iter().flatten();
            for &number in near {
                if self.all[number].distance(place) <= self.same {
                    return number;
                }
            }
        }
        let own = cell(I64Vec2::ZERO);
        self.cells.entry(own).or_default().push(self.all.len());
        self.all.push(place);
        self.all.len() - 1
    }

    /// Places on the window's border lie there exactly: a dent would be filled by a triangle beside the border.
    fn on_border(&self, place: DVec2) -> DVec2 {
        let snap = |x: f64, low: f64, high: f64| match x {
            x if (x - low).abs() <= self.same => low,
            x if (x - high).abs() <= self.same => high,
            x => x,
        };
        let Window { low, high } = self.window;
        DVec2::new(snap(place.x, low.x, high.x), snap(place.y, low.y, high.y))
    }
}

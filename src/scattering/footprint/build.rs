//! Densities of polygons across a scratch, piece by piece.

use super::{Densities, Piece, Weight};
use crate::pattern::{CenterLine, Left, MOST_CORNERS, Region};
use crate::single;
use arrayvec::ArrayVec;
use glam::DVec2;

/// Where the density bends by more than this share of the pixel's weight, it has a corner: from twice as much on in full.
const MOST_BEND: f64 = 0.003;

impl<const MOST: usize> Densities<MOST> {
    /// The density of these regions together across a scratch. Nothing if there is no room.
    pub(crate) fn add_regions(
        &mut self,
        regions: &[Region],
        line: &CenterLine,
        pixel_area: f64,
    ) -> Option<Weight> {
        let first = self.used;
        let per_area = 1.0 / pixel_area;
        for region in regions {
            match region.half_diagonals() {
                Some(halves) if line.is_even() => self.add_whole(halves, line, per_area)?,
                _ => self.add_region(region, line, per_area)?,
            }
        }
        Some(self.weight_from(first))
    }

    /// The same of what is left of them, strip by strip across the scratch, or of all. What found no room takes none.
    pub(crate) fn add_left(
        &mut self,
        regions: &[Region],
        left: Option<&Left>,
        line: &CenterLine,
        pixel_area: f64,
    ) -> Option<Weight> {
        let first = self.used;
        let weight = self
            .add_regions(regions, line, pixel_area)
            .and_then(|weight| match left {
                Some(left) => self.leave(weight, left),
                None => Some(weight),
            });
        if weight.is_none() {
            self.used = first;
        }
        weight
    }

    /// Leaves so much of a weight that was added last.
    fn leave(&mut self, weight: Weight, left: &Left) -> Option<Weight> {
        if left.strips().all(|(_, share)| share == 1.0) {
            return Some(weight);
        }
        let mut whole: ArrayVec<Piece, MOST> = ArrayVec::new();
        whole.try_extend_from_slice(self.pieces(&weight)).ok()?;
        self.used = weight.first;
        for piece in &whole {
            let mut from = piece.from;
            let strips = left.strips();
            for (border, share) in strips.skip_while(|(border, _)| *border <= piece.from) {
                let to = border.min(piece.to);
                if share > 0.0 {
                    *self.pieces.get_mut(self.used as usize)? = piece.part([from, to], share);
                    self.used += 1;
                }
                if to == piece.to {
                    break;
                }
                from = to;
            }
        }
        Some(self.weight_from(weight.first))
    }

    /// A parallelogram around the origin with these half diagonals: as high all along its middle, and falling on both sides.
    fn add_whole(&mut self, halves: [DVec2; 2], line: &CenterLine, per_area: f64) -> Option<()> {
        let across = line.across();
        let middle = -line.origin.dot(across);
        let [a, b] = halves.map(|half| half.dot(across).abs());
        let (inner, outer) = (a.min(b), a.max(b));
        let area = 2.0 * halves[0].perp_dot(halves[1]).abs();
        let density = area * per_area / (inner + outer);
        let places = [-outer, -inner, inner, outer].map(|off| middle + off);
        let slope = 0.5 * density * (outer - inner);
        if outer > inner {
            self.push_weight([places[0], places[1]], slope, 1.0)?;
        }
        self.push_weight([places[1], places[2]], 2.0 * density * inner, 0.0)?;
        if outer > inner {
            self.push_weight([places[2], places[3]], slope, -1.0)?;
        }
        Some(())
    }

    fn add_region(&mut self, region: &Region, line: &CenterLine, per_area: f64) -> Option<()> {
        // Corners by place across and along, counter-clockwise.
        let count = region.corners().len();
        let mut corners = [DVec2::ZERO; MOST_CORNERS];
        let mut leftmost = 0;
        for (i, corner) in region.corners().iter().enumerate() {
            corners[i] = line.place(*corner);
            leftmost = if corners[i].x < corners[leftmost].x {
                i
            } else {
                leftmost
            };
        }
        // From there to the right along the lower and the upper side at once, from corner to corner.
        let (mut lower, mut upper) = (leftmost, leftmost);
        let (mut from, mut heights) = (corners[leftmost].x, [corners[leftmost].y; 2]);
        for _ in 1..count {
            let next_lower = if lower + 1 == count { 0 } else { lower + 1 };
            let next_upper = if upper == 0 { count - 1 } else { upper - 1 };
            let [below, above] = [corners[next_lower], corners[next_upper]];
            let upper_first = above.x <= below.x;
            let to = if upper_first { above.x } else { below.x };
            let there = match upper_first {
                true => [height_at([corners[lower], below], to), above.y],
                false => [below.y, height_at([corners[upper], above], to)],
            };
            if to > from {
                // What lies beside the run is told apart: the density bends there.
                for edge in line.edges_between(from, to) {
                    let share = (edge - from) / (to - from);
                    let at_edge = [0, 1].map(|i| heights[i] + (there[i] - heights[i]) * share);
                    self.add_part([from, edge], [heights, at_edge], line, per_area)?;
                    (from, heights) = (edge, at_edge);
                }
                self.add_part([from, to], [heights, there], line, per_area)?;
                from = to;
            }
            heights = there;
            (lower, upper) = match upper_first {
                true => (lower, next_upper),
                false => (next_lower, upper),
            };
        }
        Some(())
    }

    /// What lies between two places across, and between heights that change evenly from one to the other.
    fn add_part(
        &mut self,
        [from, to]: [f64; 2],
        [heights, there]: [[f64; 2]; 2],
        line: &CenterLine,
        per_area: f64,
    ) -> Option<()> {
        let density = |heights: [f64; 2]| line.span(heights).max(0.0) * per_area;
        let [left, right] = [heights, there].map(density);
        if line.is_even() {
            return self.push([from, to], 0.5 * (left + right), right - left);
        }
        let half = 0.5 * (from + to);
        let inner = [0, 1].map(|i| 0.5 * (heights[i] + there[i]));
        let mean = |places: [f64; 2], heights| {
            let area = line.area(places, heights).max(0.0);
            area * per_area / (places[1] - places[0])
        };
        let middle = density(inner);
        let means = [
            mean([from, half], [heights, inner]),
            mean([half, to], [inner, there]),
        ];
        let (all, rise) = (0.5 * (means[0] + means[1]), right - left);
        let off = (to - from) * (left - 2.0 * middle + right).abs();
        let bend = (off / MOST_BEND - 1.0).clamp(0.0, 1.0);
        if bend == 0.0 {
            return self.push([from, to], all, rise);
        }
        let bent = |straight: f64, curved: f64| straight + (curved - straight) * bend;
        let rises = [middle - left, right - middle].map(|curved| bent(0.5 * rise, curved));
        self.push([from, half], bent(all - 0.25 * rise, means[0]), rises[0])?;
        self.push([half, to], bent(all + 0.25 * rise, means[1]), rises[1])
    }

    /// The same density everywhere, for a pixel that covers `window` of the plane and all relief within it:
    /// the whole-pixel model of the paper's section 4.1.
    pub(crate) fn add_uniform(&mut self, window: [f32; 2]) -> Option<Weight> {
        let density = 1.0 / f64::from(window[1] - window[0]);
        let first = self.used;
        self.push([-1e6, 1e6], density, 0.0)?;
        Some(Weight {
            window,
            ..self.weight_from(first)
        })
    }

    /// A piece with this mean density, which rises by so much on the way.
    fn push(&mut self, [from, to]: [f64; 2], mean: f64, rise: f64) -> Option<()> {
        let skew = (0.5 * rise / mean).clamp(-1.0, 1.0);
        self.push_weight([from, to], mean * (to - from), skew)
    }

    /// A piece of this weight and skew, if it weighs anything.
    #[inline(always)]
    fn push_weight(&mut self, [from, to]: [f64; 2], weight: f64, skew: f64) -> Option<()> {
        if weight > 0.0 {
            *self.pieces.get_mut(self.used as usize)? = Piece {
                from: single(from),
                to: single(to),
                weight: single(weight),
                skew: single(skew),
            };
            self.used += 1;
        }
        Some(())
    }
}

/// The height of an edge at a place; where it stands upright, of its first end.
fn height_at([from, to]: [DVec2; 2], place: f64) -> f64 {
    let run = to.x - from.x;
    let share = if run > 0.0 {
        (place - from.x) / run
    } else {
        0.0
    };
    from.y + (to.y - from.y) * share
}

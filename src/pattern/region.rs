//! What a pixel's box filter covers of the tangent plane: a convex polygon, millimetres.

use glam::DVec2;

/// Corners of a region: each line that cuts a parallelogram adds one at most, as those at a run's ends, along its sides, and
/// four around a later one do.
pub(crate) const MOST_CORNERS: usize = 12;

/// The thinnest footprint, mm. A nanometre is far below what a cross-section means, and keeps a point
/// footprint a polygon like all others.
pub(crate) const THINNEST_MM: f64 = 1e-6;

/// The same as a share of its length.
const THINNEST: f64 = 1e-7;

/// Lines farther away are looked at one by one.
const FARTHEST_MM: f64 = 1e300;

/// A convex polygon, counter-clockwise, relative to the footprint's centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    corners: [DVec2; MOST_CORNERS],
    count: u32,
    /// Whether it is a whole parallelogram around the origin.
    is_whole: bool,
}

impl Region {
    /// The parallelogram around the origin with edges `a` and `b`, at least a nanometre thick.
    #[inline(always)]
    pub(crate) fn parallelogram(a: DVec2, b: DVec2) -> Self {
        let (area, square) = (a.perp_dot(b), a.length_squared().max(b.length_squared()));
        let is_thick = area * area > THINNEST_MM * THINNEST_MM * square
            && area.abs() > THINNEST * square
            && square > THINNEST_MM * THINNEST_MM;
        match is_thick {
            true => Self::whole(a, b, area),
            false => Self::sliver(a, b),
        }
    }

    /// The same of one that may have no thickness, or no size.
    #[inline(never)]
    fn sliver(a: DVec2, b: DVec2) -> Self {
        let (long, short) = if a.length_squared() >= b.length_squared() {
            (a, b)
        } else {
            (b, a)
        };
        let length = long.length();
        let long = if length < THINNEST_MM {
            DVec2::new(THINNEST_MM, 0.0)
        } else {
            long
        };
        let normal = long.perp() / long.length();
        let thick = short.dot(normal);
        let least = THINNEST_MM.max(THINNEST * length);
        // It is thickened across its longer edge.
        let short = if thick.abs() < least {
            short + normal * (least.copysign(thick) - thick)
        } else {
            short
        };
        Self::whole(long, short, long.perp_dot(short))
    }

    /// With edges that span this area: below 0 if the second one lies to the right of the first.
    #[inline(always)]
    fn whole(a: DVec2, b: DVec2, area: f64) -> Self {
        let (p, q) = (0.5 * (a + b), 0.5_f64.copysign(area) * (a - b));
        let mut corners = [DVec2::ZERO; MOST_CORNERS];
        corners[..4].copy_from_slice(&[-p, q, p, -q]);
        Self {
            corners,
            count: 4,
            is_whole: true,
        }
    }

    /// Corners counter-clockwise.
    pub(crate) fn triangle(points: [DVec2; 3]) -> Self {
        let mut corners = [DVec2::ZERO; MOST_CORNERS];
        corners[..3].copy_from_slice(&points);
        Self {
            corners,
            count: 3,
            is_whole: false,
        }
    }

    pub(crate) fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count as usize]
    }

    /// The corners in pairs, once around.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (DVec2, DVec2)> {
        let corners = self.corners();
        let mut last = corners.last().copied().unwrap_or_default();
        let edge = move |corner: &DVec2| (core::mem::replace(&mut last, *corner), *corner);
        corners.iter().map(edge)
    }

    /// Whether it has room for the corners that so many cuts may add.
    pub(crate) fn has_room(&self, cuts: usize) -> bool {
        self.count as usize + cuts <= MOST_CORNERS
    }

    /// From where to where it reaches from a point in a direction.
    #[inline(always)]
    pub(crate) fn extent(&self, origin: DVec2, direction: DVec2) -> [f64; 2] {
        match self.half_diagonals() {
            Some(halves) => {
                let [a, b] = halves.map(|half| half.dot(direction).abs());
                let (middle, reach) = (-origin.dot(direction), if a > b { a } else { b });
                [middle - reach, middle + reach]
            }
            None => self.extent_of_corners(origin, direction),
        }
    }

    fn extent_of_corners(&self, origin: DVec2, direction: DVec2) -> [f64; 2] {
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for at in self
            .corners()
            .iter()
            .map(|corner| (*corner - origin).dot(direction))
        {
            // Written so that each is one instruction.
            from = if at < from { at } else { from };
            to = if at > to { at } else { to };
        }
        [from, to]
    }

    pub(crate) fn area(&self) -> f64 {
        0.5 * self.edges().map(|(a, b)| a.perp_dot(b)).sum::<f64>()
    }

    /// The smaller height of a parallelogram around the origin.
    pub(crate) fn thickness(&self) -> f64 {
        let [a, b] = [self.corners[0], self.corners[1]];
        let longest = (a + b).length_squared().max((a - b).length_squared());
        self.area_of_parallelogram() / longest.sqrt()
    }

    /// The area of a parallelogram around the origin.
    pub(crate) fn area_of_parallelogram(&self) -> f64 {
        2.0 * self.corners[0].perp_dot(self.corners[1]).abs()
    }

    /// How far a parallelogram around the origin reaches from there along the axes.
    pub(crate) fn half_size(&self) -> DVec2 {
        self.corners[0].abs().max(self.corners[1].abs())
    }

    pub(crate) fn centroid(&self) -> DVec2 {
        // Relative to a corner, so that a small polygon far from the origin keeps its digits.
        let base = self.corners[0];
        let (mut area, mut sum) = (0.0, DVec2::ZERO);
        for (a, b) in self.edges().map(|(a, b)| (a - base, b - base)) {
            let cross = a.perp_dot(b);
            area += cross;
            sum += cross * (a + b) / 3.0;
        }
        if area > 0.0 { base + sum / area } else { base }
    }

    /// Keeps the part where (p - origin) · direction >= 0 (Sutherland and Hodgman 1974); false if that is empty.
    pub(crate) fn clip(&mut self, origin: DVec2, direction: DVec2) -> bool {
        let side = |corner: DVec2| (corner - origin).dot(direction);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for side in self.corners().iter().map(|corner| side(*corner)) {
            // Written so that each is one instruction: this is the most frequent call while shading.
            least = if side < least { side } else { least };
            most = if side > most { side } else { most };
        }
        if least >= 0.0 && most.is_finite() {
            return true;
        }
        let (whole, count) = (self.corners, self.count as usize);
        (self.count, self.is_whole) = (0, false);
        if most <= 0.0 || !most.is_finite() {
            return false;
        }
        let mut last = (whole[count - 1], side(whole[count - 1]));
        for &corner in &whole[..count] {
            let next = (corner, side(corner));
            if (last.1 >= 0.0) != (next.1 >= 0.0) {
                self.push(last.0.lerp(next.0, last.1 / (last.1 - next.1)));
            }
            if next.1 >= 0.0 {
                self.push(next.0);
            }
            last = next;
        }
        self.count >= 3 && self.area() > 0.0
    }

    /// The part that [`Self::clip`] keeps, or nothing if that is empty.
    pub(crate) fn clipped(&self, origin: DVec2, direction: DVec2) -> Option<Self> {
        let mut part = *self;
        part.clip(origin, direction).then_some(part)
    }

    /// Keeps the part inside all of these lines, each a point and an inward direction; false if that is empty.
    pub(crate) fn keep(&mut self, lines: &[[DVec2; 2]]) -> bool {
        let mut lines = lines.iter();
        lines.all(|&[origin, inward]| self.clip(origin, inward))
    }

    /// Keeps what it shares with another; false if that is nothing.
    pub(crate) fn keep_within(&mut self, other: &Self) -> bool {
        let mut edges = other.edges();
        edges.all(|(a, b)| self.clip(a, (b - a).perp()))
    }

    /// Half its diagonals, if it is a whole parallelogram around the origin.
    #[inline(always)]
    pub(crate) fn half_diagonals(&self) -> Option<[DVec2; 2]> {
        self.is_whole.then_some([self.corners[0], self.corners[1]])
    }

    /// Whether [`Self::keep`] keeps all of a parallelogram around the origin.
    #[inline(always)]
    pub(crate) fn is_parallelogram_within(&self, lines: &[[DVec2; 2]]) -> bool {
        let [a, b] = [self.corners[0], self.corners[1]];
        let most_beyond = |&[origin, inward]: &[DVec2; 2]| {
            let (a, b) = (a.dot(inward).abs(), b.dot(inward).abs());
            origin.dot(inward) + if a > b { a } else { b }
        };
        // Not where it is endless, nor where it is no number.
        lines.iter().all(|line| {
            let beyond = most_beyond(line);
            (-FARTHEST_MM..=0.0).contains(&beyond)
        })
    }

    /// The part that [`Self::keep`] keeps, or nothing if that is empty.
    pub(crate) fn within(&self, lines: &[[DVec2; 2]]) -> Option<Self> {
        let mut part = *self;
        part.keep(lines).then_some(part)
    }

    /// Whether it lies all on one side of a curve with these control points, and so far away from it.
    pub(crate) fn is_beside(&self, [a, b, c, d]: &[DVec2; 4], away: f64) -> bool {
        let chord = *d - *a;
        let beside = |p: DVec2| chord.perp_dot(p - *a);
        let bends = [beside(*b), beside(*c)];
        let (low, high) = (
            bends[0].min(bends[1]).min(0.0),
            bends[0].max(bends[1]).max(0.0),
        );
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for at in self.corners().iter().map(|corner| beside(*corner)) {
            from = if at < from { at } else { from };
            to = if at > to { at } else { to };
        }
        let away = away * chord.length();
        from > high + away || to < low - away
    }

    pub(crate) fn holds(&self, point: DVec2) -> bool {
        self.edges()
            .all(|(a, b)| (b - a).perp_dot(point - a) >= 0.0)
    }

    /// The part of a segment that lies inside, as shares of it (Cyrus and Beck 1978).
    #[cfg(feature = "files")]
    pub(crate) fn part_of_segment(&self, [a, b]: [DVec2; 2]) -> Option<[f64; 2]> {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (p, q) in self.edges() {
            let edge = q - p;
            let (at_a, at_b) = (edge.perp_dot(a - p), edge.perp_dot(b - p));
            match (at_a < 0.0, at_b < 0.0) {
                (true, true) => return None,
                (true, false) => from = from.max(at_a / (at_a - at_b)),
                (false, true) => to = to.min(at_a / (at_a - at_b)),
                (false, false) => {}
            }
        }
        (to > from).then_some([from, to])
    }

    /// The share of a parallelogram that lies inside.
    pub(crate) fn share_of_cell(&self, corners: [DVec2; 4]) -> f64 {
        if corners.into_iter().all(|corner| self.holds(corner)) {
            return 1.0;
        }
        let middle = 0.5 * (corners[0] + corners[2]);
        let part = self.within(&[0, 1, 2, 3].map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            let inward = (b - a).perp();
            [a, inward * inward.dot(middle - a).signum()]
        }));
        let area = (corners[1] - corners[0])
            .perp_dot(corners[3] - corners[0])
            .abs();
        part.map_or(0.0, |part| (part.area() / area).min(1.0))
    }

    fn push(&mut self, corner: DVec2) {
        if let Some(free) = self.corners.get_mut(self.count as usize) {
            *free = corner;
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two halves of a cut polygon add up to it.
    #[test]
    fn halves_add_up() {
        let whole = Region::parallelogram(DVec2::new(3.0, 0.4), DVec2::new(-0.2, 1.5));
        let (at, along) = (DVec2::new(0.3, 0.1), DVec2::new(0.6, -0.8));
        let parts = [along, -along].map(|side| whole.clipped(at, side).unwrap().area());
        assert!(
            (parts[0] + parts[1] - whole.area()).abs() < 1e-12,
            "{parts:?}"
        );
    }

    /// A point, a line and mirrored edges are all polygons with some area, counter-clockwise.
    #[test]
    fn degenerate_footprints_have_area() {
        let x = DVec2::X;
        for (a, b) in [
            (DVec2::ZERO, DVec2::ZERO),
            (x, DVec2::ZERO),
            (x, x),
            (x, -DVec2::Y),
        ] {
            assert!(Region::parallelogram(a, b).area() > 0.0, "{a} {b}");
        }
    }
}

//! A piece of scratch as a straight strip: where two strips overlap.

use super::raster::cell_number;
use arrayvec::ArrayVec;
use glam::DVec2;

/// A straight strip, mm in the pattern's own scale.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strip {
    pub start: DVec2,
    pub end: DVec2,
    pub half_width: f64,
}

/// Corners of what two strips share.
type Shared = ArrayVec<DVec2, 8>;

/// How one strip covers another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cover {
    /// A place within both strips.
    pub place: DVec2,
    /// The share of each quarter that is covered, in the direction of travel.
    pub quarters: [f64; 4],
}

impl Strip {
    pub(super) fn length(&self) -> f64 {
        self.start.distance(self.end)
    }

    /// Lowest and highest coordinates.
    pub(super) fn bounds(&self) -> [DVec2; 2] {
        let reach = DVec2::splat(self.half_width);
        let (low, high) = (self.start.min(self.end), self.start.max(self.end));
        [low - reach, high + reach]
    }

    fn along(&self) -> DVec2 {
        (self.end - self.start).normalize_or(DVec2::X)
    }

    /// Unit normal, and its product with any place on the centre line.
    pub(super) fn line(&self) -> (DVec2, f64) {
        let normal = self.along().perp();
        (normal, normal.dot(self.start))
    }

    /// What another strip covers of this one, exactly.
    pub(super) fn covered_by(&self, other: &Self) -> Option<Cover> {
        let (along, length, half_width) = (self.along(), self.length(), self.half_width);
        // Along this strip and across.
        let turned = |v: DVec2| DVec2::new(along.dot(v), along.perp_dot(v));
        let ends = [other.start, other.end].map(|end| turned(end - self.start));
        let across = other.half_width * turned(other.along()).perp();
        // Most that lie in one line lie one behind the other.
        let (low, high) = (ends[0].x.min(ends[1].x), ends[0].x.max(ends[1].x));
        if low - across.x.abs() > length || high + across.x.abs() < 0.0 {
            return None;
        }
        let corners = [
            ends[0] - across,
            ends[1] - across,
            ends[1] + across,
            ends[0] + across,
        ];
        let shared = clipped(&Shared::from_iter(corners), |p| p.y + half_width);
        let shared = clipped(&shared, |p| half_width - p.y);
        let shared = clipped(&shared, |p| p.x);
        let shared = clipped(&shared, |p| length - p.x);
        if shared.len() < 3 {
            return None;
        }
        let middle = shared.iter().sum::<DVec2>() / shared.len() as f64;
        let quarter = 0.25 * length;
        let places = [0.0, 1.0, 2.0, 3.0, 4.0].map(|i| i * quarter);
        let before = areas_before(&shared, places);
        let whole = quarter * 2.0 * half_width;
        Some(Cover {
            place: self.start + along * middle.x + along.perp() * middle.y,
            quarters: [0, 1, 2, 3].map(|i| ((before[i + 1] - before[i]) / whole).clamp(0.0, 1.0)),
        })
    }
}

/// Where a strip that crosses another at `place`, up to `half` before and behind as shares of its length, covers it:
/// from one place to another, in quarters. It is a parallelogram, shared out as if it were a rectangle. It counts
/// wholly where the centre lines cross, and not at all where only edges meet at an end: on average these are the same.
pub(super) fn crossed(place: f64, half: f64) -> [f64; 2] {
    let half = (4.0 * half).min(2.0);
    let middle = (4.0 * place).clamp(half, 4.0 - half);
    [middle - half, middle + half]
}

/// Calls `visit` with each quarter that is covered, and the share of it that is.
pub(super) fn for_each_quarter([from, to]: [f64; 2], mut visit: impl FnMut(usize, f64)) {
    let first = cell_number(from).min(3) as usize;
    let mut start = first as f64;
    // Most lie in one.
    if to <= start + 1.0 {
        return visit(first, to - from);
    }
    for quarter in first..4 {
        let share = to.min(start + 1.0) - from.max(start);
        if share > 0.0 {
            visit(quarter, share);
        }
        start += 1.0;
    }
}

/// The part of a convex polygon where `side` is not negative (Sutherland and Hodgman 1974).
fn clipped(polygon: &Shared, side: impl Fn(DVec2) -> f64) -> Shared {
    let mut kept = Shared::new();
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (at_a, at_b) = (side(a), side(b));
        let cut = (at_a >= 0.0) != (at_b >= 0.0);
        let corners = [
            (at_a >= 0.0).then_some(a),
            cut.then(|| a.lerp(b, at_a / (at_a - at_b))),
        ];
        // Rounding of a sliver may give more corners than a polygon can have: such a one has no area.
        for corner in corners.into_iter().flatten() {
            let _ = kept.try_push(corner);
        }
    }
    kept
}

/// The area of a polygon, counter-clockwise, up to each x.
fn areas_before(polygon: &Shared, xs: [f64; 5]) -> [f64; 5] {
    let mut areas = [0.0; 5];
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let slope = (b.y - a.y) / (b.x - a.x);
        for (area, x) in areas.iter_mut().zip(xs) {
            let (from, to) = (a.x.min(x), b.x.min(x));
            if from != to {
                let middle = 0.5 * (from + to) - a.x;
                *area -= (to - from) * (a.y + slope * middle);
            }
        }
    }
    areas
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Region;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    fn any(rng: &mut StdRng) -> Strip {
        let mut point = || DVec2::new(rng.random(), rng.random());
        Strip {
            start: point(),
            end: point(),
            half_width: rng.random::<f64>() * 0.3,
        }
    }

    /// What is covered of all quarters is the area that a polygon clipper finds, and the place lies in both.
    #[test]
    fn covered_area_is_that_of_polygons() {
        let mut rng = StdRng::seed_from_u64(5);
        let mut met = 0;
        for _ in 0..2000 {
            let (a, b) = (any(&mut rng), any(&mut rng));
            let along = |strip: &Strip| (strip.end - strip.start).normalize();
            let whole =
                Region::parallelogram(a.end - a.start, 2.0 * a.half_width * along(&a).perp());
            let middle = 0.5 * (a.start + a.end);
            let across = b.half_width * along(&b).perp();
            let part = whole
                .clipped(b.start - middle, along(&b))
                .and_then(|part| part.clipped(b.end - middle, -along(&b)))
                .and_then(|part| part.clipped(b.start - across - middle, across))
                .and_then(|part| part.clipped(b.start + across - middle, -across));
            let truth = part.map_or(0.0, |part| part.area());
            let cover = a.covered_by(&b);
            let sum: f64 = cover.map_or(0.0, |cover| cover.quarters.iter().sum());
            let ours = sum * 0.5 * a.length() * a.half_width;
            assert!((ours - truth).abs() < 1e-12, "{ours} and {truth}");
            if let Some(Cover { place, .. }) = cover {
                met += 1;
                for strip in [&a, &b] {
                    let (normal, offset) = strip.line();
                    let away = (normal.dot(place) - offset).abs();
                    assert!(away <= strip.half_width + 1e-12, "{place} outside");
                }
            }
        }
        assert!(met > 300, "{met} pairs met");
    }

    /// Over all ways in which two strips may lie, crossings in closed form cover as much as polygons do.
    #[test]
    fn crossings_cover_as_much_on_average() {
        let mut rng = StdRng::seed_from_u64(6);
        let (mut closed, mut exact) = ([0.0; 4], [0.0; 4]);
        let strip = |middle: DVec2, angle: f64, half_width: f64| Strip {
            start: middle - 0.5 * DVec2::from_angle(angle),
            end: middle + 0.5 * DVec2::from_angle(angle),
            half_width,
        };
        let a = strip(DVec2::ZERO, 0.0, 0.02);
        for _ in 0..400_000 {
            let middle = 3.0 * (DVec2::new(rng.random(), rng.random()) - 0.5);
            let b = strip(middle, 0.7, 0.03);
            if let Some(cover) = a.covered_by(&b) {
                (0..4).for_each(|i| exact[i] += cover.quarters[i]);
            }
            let sin = 0.7_f64.sin();
            let place = 0.5 + middle.x - middle.y / 0.7_f64.tan();
            if middle.y.abs() < 0.5 * sin && (0.0..1.0).contains(&place) {
                let covered = crossed(place, b.half_width / (sin * a.length()));
                for_each_quarter(covered, |i, share| closed[i] += share);
            }
        }
        for (closed, exact) in closed.into_iter().zip(exact) {
            let off = closed / exact - 1.0;
            assert!(off.abs() < 0.02, "{closed} and {exact}");
        }
    }
}

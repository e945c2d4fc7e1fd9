//! What lies where relative to a run: across from its centre line, in a run that grows evenly along it.

use super::region::Region;
use crate::lanes::Number;
use crate::single;
use glam::DVec2;

/// Nowhere in a region a run counts as narrower than this share of what it is at its origin.
const NARROWEST: f64 = 0.1;

/// A run's centre line, mm in the local frame around the footprint's centre, and how its cross-section grows along it.
///
/// A run that grows is looked at from the point where it would be nothing: places have the coordinates that they have in its
/// cross-section at the origin, seen from there. All that is straight stays so, and the run's own edges are parallel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CenterLine {
    pub origin: DVec2,
    /// Unit direction of travel there.
    pub travel: DVec2,
    /// How much the cross-section grows by the mm, as a share of what it is at the origin.
    taper: f64,
    /// How far across the edges of a run that grows are; nowhere of one that does not.
    edges: [f64; 2],
}

impl CenterLine {
    /// Of a run that has one cross-section.
    pub(crate) fn even(origin: DVec2, travel: DVec2) -> Self {
        Self {
            origin,
            travel,
            taper: 0.0,
            edges: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// The same of one that grows so much by the mm, between such edges, as far as it lies in a region.
    pub(crate) fn tapering(self, taper: f64, edges: [f64; 2], region: &Region) -> Self {
        let [low, high] = region.extent(self.origin, self.travel);
        let most_by = |mm: f64| (1.0 - NARROWEST) / mm.max(f64::MIN_POSITIVE);
        let bounded = taper.max(-most_by(high)).min(most_by(-low));
        Self {
            // What a damaged file holds may be no number.
            taper: if taper.is_finite() { bounded } else { 0.0 },
            edges,
            ..self
        }
    }

    pub(crate) fn is_even(&self) -> bool {
        self.taper == 0.0
    }

    /// Its edges between two places across, in order.
    pub(crate) fn edges_between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let edges = self.edges.into_iter();
        edges.filter(move |edge| *edge > from && *edge < to)
    }

    /// To the right of travel.
    pub(crate) fn across(&self) -> DVec2 {
        DVec2::new(self.travel.y, -self.travel.x)
    }

    /// A point's place across and along.
    pub(crate) fn place(&self, point: DVec2) -> DVec2 {
        let off = point - self.origin;
        let place = DVec2::new(off.dot(self.across()), off.dot(self.travel));
        if self.is_even() {
            return place;
        }
        place / (1.0 + self.taper * place.y)
    }

    /// How much of the plane lies between two places along, `across` from the centre line, mm² by the mm across.
    pub(crate) fn span(&self, [from, to]: [f64; 2]) -> f64 {
        if self.is_even() {
            return to - from;
        }
        // As wide as the run is there, by its width at the origin.
        let [a, b] = [from, to].map(|along| 1.0 / (1.0 - self.taper * along));
        (to - from) * a * b * 0.5 * (a + b)
    }

    /// The same on several lines.
    #[inline(always)]
    pub(super) fn spans<F: Number>(&self, [from, to]: [F; 2]) -> F {
        if self.is_even() {
            return to - from;
        }
        let taper = single(self.taper);
        let (a, b) = (
            from.like(1.0) / (-from * taper + 1.0),
            to.like(1.0) / (-to * taper + 1.0),
        );
        (to - from) * a * b * (a + b) * 0.5
    }

    /// How much of the plane lies between two places across, and two places along at either, mm².
    pub(crate) fn area(&self, [from, to]: [f64; 2], [first, last]: [[f64; 2]; 2]) -> f64 {
        // As they lie about the origin, by their places.
        let corner =
            |across: f64, along: f64| DVec2::new(across, along) / (1.0 - self.taper * along);
        let up = corner(to, last[1]) - corner(from, first[0]);
        let down = corner(from, first[1]) - corner(to, last[0]);
        0.5 * up.perp_dot(down)
    }

    /// From where to where across a region reaches.
    #[inline(always)]
    pub(crate) fn extent(&self, region: &Region) -> [f64; 2] {
        if self.is_even() {
            return region.extent(self.origin, self.across());
        }
        let across = region.corners().iter().map(|corner| self.place(*corner).x);
        across.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    }

    /// Two places across, as far from the centre line as they come to lie anywhere between two distances along.
    pub(super) fn widest(&self, across: [f64; 2], along: [f64; 2]) -> [f64; 2] {
        let [first, last] = along.map(|along| 1.0 + self.taper * along);
        let [from, to] = across;
        [from.min(0.0), to.max(0.0)].map(|at| at * first.max(last))
    }

    /// The point beside the origin that is so far across.
    pub(super) fn beside(&self, across: f64) -> DVec2 {
        self.origin + self.across() * across
    }

    /// Point and inward direction of two lines along the run, so far across.
    pub(crate) fn sides(&self, [from, to]: [f64; 2]) -> [[DVec2; 2]; 2] {
        let inward = |at: f64| self.across() - self.travel * (self.taper * at);
        [
            [self.beside(from), inward(from)],
            [self.beside(to), -inward(to)],
        ]
    }

    /// How fast one gets to the inner side of a line, a point and an inward direction, on the way along: the same however far
    /// across.
    pub(super) fn approach(&self, [point, inward]: [DVec2; 2]) -> f64 {
        self.travel.dot(inward) + self.taper * (point - self.origin).dot(inward)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How much of the plane lies along lines is told alike in double precision and in single; nothing comes to lie farther
    /// across than the widest place.
    #[test]
    fn tapering_lines_in_single_precision() {
        let region = Region::parallelogram(2.0 * DVec2::X, 2.0 * DVec2::Y);
        for taper in [0.0, 0.3, -0.8] {
            let line = CenterLine::even(DVec2::ZERO, DVec2::from_angle(0.4));
            let line = line.tapering(taper, [-0.1, 0.1], &region);
            let along = region.extent(line.origin, line.travel);
            let widest = line.widest([-0.2, 0.1], along);
            for i in 0..=20 {
                let at = -0.5 + 0.05 * f64::from(i);
                let (exact, found) = (line.span([at, 0.6]), line.spans([single(at), 0.6]));
                assert!(
                    (exact - f64::from(found)).abs() < 1e-5,
                    "{found}, not {exact}"
                );
                // Where its sides are, so far along.
                for (side, widest) in line.sides([-0.2, 0.1]).iter().zip(widest) {
                    let [point, inward] = *side;
                    let place = line.origin + line.travel * at;
                    let across = (point - place).dot(inward) / line.across().dot(inward);
                    assert!(
                        across.abs() <= widest.abs() + 1e-12,
                        "{across}, not {widest}"
                    );
                }
            }
        }
    }
}

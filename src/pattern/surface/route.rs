//! From one place of a mesh to another, triangle by triangle.

use super::project::Spot;
use super::{Joint, Side, Surface, Triangle};
use glam::{DVec2, DVec3};

/// A way over the mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Route {
    pub crossings: Vec<Crossing>,
    /// Scene units.
    pub length: f64,
}

/// Where a route passes from one triangle to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub point: DVec3,
    /// (u, v) as the triangle behind and the one ahead have it.
    pub uv: [DVec2; 2],
    /// The triangle ahead.
    pub triangle: u32,
    pub joint: Joint,
}

/// A route of more triangles is not looked for.
const MOST_TRIANGLES: usize = 20_000;

impl Route {
    pub(super) fn is_smooth(&self) -> bool {
        self.crossings.iter().all(|c| c.joint == Joint::Smooth)
    }
}

impl Surface {
    /// The straight way from `a` to `b`: around their common corner where they coincide, elsewhere the mesh cut by
    /// the plane through both that stands on it. `None` where no such way is.
    pub(super) fn route(&self, a: &Spot, b: &Spot) -> Option<Route> {
        let crossings = if a.triangle == b.triangle {
            Vec::new()
        } else {
            let next = self.step_across(a, b);
            next.or_else(|| self.around(a, b))
                .or_else(|| self.cut(a, b))?
        };
        let (mut length, mut last) = (0.0, a.point);
        for crossing in &crossings {
            length += last.distance(crossing.point);
            last = crossing.point;
        }
        length += last.distance(b.point);
        Some(Route { crossings, length })
    }

    /// The one crossing between neighbours, on the shortest way.
    fn step_across(&self, a: &Spot, b: &Spot) -> Option<Vec<Crossing>> {
        let triangle = self.triangle(a.triangle);
        let leads = |side: &Side| matches!(side, Side::Next(next, _) if *next == b.triangle);
        let k = triangle.sides.iter().position(leads)?;
        let [from, to] = triangle.side(k).map(|k| triangle.corners[k]);
        // Unfolded around their common side the way is a straight line.
        let side = (to - from) / (to - from).length_squared();
        let [i, j] = [a, b].map(|spot| side.dot(spot.point - from));
        let off = |spot: &Spot, share: f64| spot.point.distance(from.lerp(to, share));
        let (before, after) = (off(a, i), off(b, j));
        let share = if before + after > 0.0 {
            (i * after + j * before) / (before + after)
        } else {
            j
        };
        self.crossing(triangle, k, share).map(|c| vec![c])
    }

    /// Unit normal of the plane through both places that stands on the mesh.
    fn upright(&self, a: &Spot, b: &Spot) -> DVec3 {
        let (n, m) = (
            self.triangle(a.triangle).normal,
            self.triangle(b.triangle).normal,
        );
        let up = if n.dot(m) < -0.999 { n - m } else { n + m };
        (b.point - a.point).cross(up).normalize_or_zero()
    }

    /// Leaves a triangle through side k at a share of its length.
    fn crossing(&self, triangle: &Triangle, k: usize, share: f64) -> Option<Crossing> {
        let Side::Next(next, joint) = triangle.sides[k] else {
            return None;
        };
        let share = share.clamp(0.0, 1.0);
        let [i, j] = triangle.side(k);
        let ahead = self.triangle(next);
        let [p, q] = [i, j].map(|k| ahead.uv_of(triangle.places[k]));
        Some(Crossing {
            point: triangle.corners[i].lerp(triangle.corners[j], share),
            uv: [triangle.uv[i].lerp(triangle.uv[j], share), p.lerp(q, share)],
            triangle: next,
            joint,
        })
    }

    /// Along the plane's cut through the mesh, from `a` on towards `b`.
    fn cut(&self, a: &Spot, b: &Spot) -> Option<Vec<Crossing>> {
        let across = self.upright(a, b);
        if across == DVec3::ZERO {
            return None;
        }
        let ahead = b.point - a.point;
        let height = |p: DVec3| across.dot(p - a.point);
        let mut crossings: Vec<Crossing> = Vec::new();
        let (mut index, mut from) = (a.triangle, None);
        while index != b.triangle {
            let triangle = self.triangle(index);
            let leaves = (0..3).filter_map(|k| {
                let [i, j] = triangle.side(k).map(|k| height(triangle.corners[k]));
                let entered = from == Some(triangle.side_places(k));
                let share = i / (i - j);
                ((i < 0.0) != (j < 0.0) && !entered).then_some((k, share))
            });
            let progress = |&(k, share): &(usize, f64)| {
                let [i, j] = triangle.side(k).map(|k| triangle.corners[k]);
                ahead.dot(i.lerp(j, share) - a.point)
            };
            let (k, share) = leaves.max_by(|a, b| progress(a).total_cmp(&progress(b)))?;
            let crossing = self.crossing(triangle, k, share)?;
            from = Some(triangle.side_places(k));
            index = crossing.triangle;
            crossings.push(crossing);
            if crossings.len() > MOST_TRIANGLES || index == a.triangle {
                return None;
            }
        }
        Some(crossings)
    }

    /// Around the corner where both places are, through the fewest triangles that touch it.
    fn around(&self, a: &Spot, b: &Spot) -> Option<Vec<Crossing>> {
        let near = 1e-6 * self.size;
        if a.point.distance(b.point) > near {
            return None;
        }
        let mut reached = vec![(a.triangle, usize::MAX, None)];
        let mut i = 0;
        while reached[i].0 != b.triangle {
            let triangle = self.triangle(reached[i].0);
            for k in 0..3 {
                let Side::Next(next, _) = triangle.sides[k] else {
                    continue;
                };
                let touches = self.closest_in(next, a.point).distance(a.point) <= near;
                if touches && reached.iter().all(|one| one.0 != next) {
                    let [p, q] = triangle.side(k).map(|k| triangle.corners[k]);
                    let share = (a.point - p).dot(q - p) / (q - p).length_squared();
                    reached.push((next, i, self.crossing(triangle, k, share)));
                }
            }
            i += 1;
            if i >= reached.len() || reached.len() > 1000 {
                return None;
            }
        }
        let mut crossings = Vec::new();
        while let (_, before, Some(crossing)) = reached[i] {
            crossings.push(crossing);
            i = before;
        }
        crossings.reverse();
        Some(crossings)
    }
}

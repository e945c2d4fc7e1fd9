//! The print of a tool that stands still: its contact with the surface in plan, and sections through its tip.

use super::envelope::{Segment, lower_envelope};
use super::tool::lower_hull;
use core::f64::consts::TAU;
use glam::{DVec2, DVec3};

/// Corners of the polygon that stands for the contact of a cone; a multiple of 32, so that an upright cone's
/// contact has a corner at each border and middle of eight sectors of the half plane.
const CONE_CORNERS: u32 = 256;

/// Chords of a section through a cone.
const CONE_CHORDS: u32 = 96;

/// Halvings when looking for a cone's rim: to the last digits of a double.
const HALVINGS: u32 = 52;

/// Points this much closer to each other than the tool or its contact is wide count as one.
const SAME: f64 = 1e-10;

/// The lower surface of a turned tool, relative to its tip: the lowest point, the middle of them if several are.
#[derive(Clone, Debug)]
pub(crate) struct Imprint<'a> {
    body: Body<'a>,
    tip: DVec3,
}

#[derive(Clone, Debug)]
enum Body<'a> {
    /// As tall as need be.
    Cone(Cone),
    /// The convex hull of these points.
    Hull(Vec<DVec3>),
    Mesh {
        vertices: Vec<DVec3>,
        triangles: &'a [[u32; 3]],
    },
}

/// A rounded cone whose lowest point is the origin, which lies on its sphere.
#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: DVec3,
    sin: f64,
    cos: f64,
    radius: f64,
}

impl<'a> Imprint<'a> {
    /// A rounded cone about `axis`, which turned about its own foot.
    pub(super) fn cone(axis: DVec3, half_angle_rad: f64, radius: f64) -> Self {
        let (sin, cos) = half_angle_rad.sin_cos();
        let cone = Cone {
            axis,
            sin,
            cos,
            radius,
        };
        Self {
            body: Body::Cone(cone),
            tip: radius * (axis - DVec3::Z),
        }
    }

    /// The convex hull of these points.
    pub(super) fn hull(mut points: Vec<DVec3>) -> Self {
        let tip = move_tip_to_origin(&mut points);
        Self {
            body: Body::Hull(points),
            tip,
        }
    }

    /// Any surface.
    pub(super) fn mesh(mut vertices: Vec<DVec3>, triangles: &'a [[u32; 3]]) -> Self {
        let tip = move_tip_to_origin(&mut vertices);
        Self {
            body: Body::Mesh {
                vertices,
                triangles,
            },
            tip,
        }
    }

    /// The tip relative to the origin that the tool turned about, mm.
    pub(super) fn tip(&self) -> DVec3 {
        self.tip
    }

    /// The front of the contact area (x to the right, y forward, y >= 0), from right to left, when the tool has come
    /// from behind and its tip stands `depth_mm` deep at the origin. Empty where nothing lies ahead of the tip.
    pub(super) fn front(&self, depth_mm: f64) -> Vec<DVec2> {
        // What the tool passed on its way stays cut: ahead of the tip counts how far it reaches at each x.
        let reach = |[a, b]: [DVec2; 2]| {
            let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
            (from.x < to.x).then(|| Segment {
                from: DVec2::new(from.x, -from.y),
                to: DVec2::new(to.x, -to.y),
            })
        };
        let segments: Vec<Segment> = self
            .contact(depth_mm)
            .into_iter()
            .filter_map(reach)
            .collect();
        let line: Vec<DVec2> = wide_parts(lower_envelope(&segments))
            .flat_map(|segment| [segment.from, segment.to])
            .map(|point| DVec2::new(point.x, -point.y))
            .collect();
        let flip = |point: &DVec2| DVec2::new(-point.x, point.y);
        let flipped: Vec<DVec2> = line.iter().rev().map(flip).collect();
        let mut front = right_of_tip(&line);
        front.reverse();
        front.extend(right_of_tip(&flipped).iter().map(flip));
        let size = front.iter().map(|point| point.length()).fold(0.0, f64::max);
        front.dedup_by(|a, b| a.distance(*b) <= SAME * size);
        front
    }

    /// The section from the tip outward in the direction of the unit vector `outward`: points (distance, height above
    /// the tip), mm, from (0, 0) up to `top_mm` at least. Where the tool leans over or ends, a wall stands upright.
    pub(super) fn section(&self, outward: DVec2, top_mm: f64) -> Vec<DVec2> {
        let mut points = vec![DVec2::ZERO];
        match &self.body {
            Body::Cone(cone) => {
                let rim = cone.rim_mm(outward, top_mm);
                points.extend((1..=CONE_CHORDS).map(|i| {
                    let distance = rim * f64::from(i) / f64::from(CONE_CHORDS);
                    DVec2::new(distance, cone.height(distance * outward))
                }));
            }
            Body::Hull(corners) => {
                points.extend(crossed_by_plane(corners, outward));
                points = lower_hull(points);
            }
            Body::Mesh {
                vertices,
                triangles,
            } => {
                let segments = plane_segments(vertices, triangles, outward);
                let envelope = lower_envelope(&segments);
                let seam_mm = SAME * envelope.last().map_or(0.0, |last| last.to.x);
                for segment in wide_parts(envelope) {
                    let last = points.last().copied().unwrap_or_default();
                    if points.len() > 1 && segment.from.x > last.x + seam_mm {
                        points.push(DVec2::new(last.x, top_mm));
                        points.push(DVec2::new(segment.from.x, top_mm));
                    }
                    points.extend([segment.from, segment.to]);
                }
            }
        }
        let last = points.last().copied().unwrap_or_default();
        if last.y < top_mm {
            points.push(DVec2::new(last.x, top_mm));
        }
        points.dedup();
        let mut x = 0.0_f64;
        for point in &mut points {
            x = x.max(point.x);
            point.x = x;
        }
        points
    }

    /// The contact area's border in plan, as segments in any order.
    fn contact(&self, depth_mm: f64) -> Vec<[DVec2; 2]> {
        match &self.body {
            Body::Cone(cone) => {
                let corner = |i: u32| {
                    let angle = TAU * f64::from(i) / f64::from(CONE_CORNERS);
                    let outward = DVec2::from_angle(angle);
                    cone.rim_mm(outward, depth_mm) * outward
                };
                let corners: Vec<DVec2> = (0..CONE_CORNERS).map(corner).collect();
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).map(|(&a, &b)| [a, b]).collect()
            }
            Body::Hull(corners) => {
                let height = |corner: &DVec3| corner.z - depth_mm;
                // Only its front is asked for.
                let places = crossings(corners, &height)
                    .map(|place| DVec2::new(place.x, -place.y))
                    .collect();
                let flip = |point: DVec2| DVec2::new(point.x, -point.y);
                lower_hull(places)
                    .windows(2)
                    .map(|pair| [flip(pair[0]), flip(pair[1])])
                    .collect()
            }
            Body::Mesh {
                vertices,
                triangles,
            } => {
                let heights: Vec<f64> = vertices.iter().map(|v| v.z - depth_mm).collect();
                cut_triangles(vertices, triangles, &heights)
                    .map(|[a, b]| [a.truncate(), b.truncate()])
                    .collect()
            }
        }
    }
}

impl Cone {
    /// Height of the lower surface above the tip; infinite where there is none.
    fn height(&self, place: DVec2) -> f64 {
        let Self {
            axis,
            sin,
            cos,
            radius,
        } = *self;
        let inside = radius * radius - place.length_squared();
        if inside >= 0.0 {
            let below_center = place.extend(-inside.sqrt());
            if below_center.dot(axis) <= -radius * sin {
                // R - sqrt(R² - r²) without cancellation.
                return place.length_squared() / (radius + inside.sqrt()).max(1e-300);
            }
        }
        let apex = DVec3::Z * radius - axis * (radius / sin);
        let foot = place.extend(0.0) - apex;
        let along = foot.dot(axis);
        let square = axis.z * axis.z - cos * cos;
        let linear = along * axis.z - cos * cos * foot.z;
        let rest = along * along - cos * cos * foot.length_squared();
        let root = (linear * linear - square * rest).sqrt();
        let sum = -(linear + root.copysign(linear));
        [sum / square, rest / sum]
            .into_iter()
            .filter(|&z| z.is_finite() && along + z * axis.z >= 0.0)
            .fold(f64::INFINITY, f64::min)
            .max(0.0)
    }

    /// How far from the tip the lower surface stays below a level.
    fn rim_mm(&self, outward: DVec2, level_mm: f64) -> f64 {
        let below = |distance: f64| self.height(distance * outward) <= level_mm;
        let (mut low, mut high) = (0.0, level_mm);
        while below(high) && high < 1e12 {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if below(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }
}

/// Moves the points so that the middle of the lowest is the origin, and returns where it was.
fn move_tip_to_origin(points: &mut [DVec3]) -> DVec3 {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points
        .iter()
        .fold(empty, |(low, high), &p| (low.min(p), high.max(p)));
    let same = 1e-9 * (high - low).max_element();
    let lowest = points.iter().filter(|point| point.z <= low.z + same);
    let (sum, count) = lowest.fold((DVec3::ZERO, 0.0), |(sum, n), p| (sum + *p, n + 1.0));
    let tip = (sum / f64::max(count, 1.0)).truncate().extend(low.z);
    points.iter_mut().for_each(|point| *point -= tip);
    tip
}

/// The part of a line from left to right that lies right of the tip and ahead of it: from x = 0 to y = 0.
fn right_of_tip(line: &[DVec2]) -> Vec<DVec2> {
    let mut part = Vec::new();
    for pair in line.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if to.x < 0.0 {
            continue;
        }
        if part.is_empty() {
            let share = if to.x > from.x {
                -from.x / (to.x - from.x)
            } else {
                1.0
            };
            let start = from.lerp(to, share.clamp(0.0, 1.0));
            if start.y < 0.0 {
                return part;
            }
            part.push(start);
        }
        if to.y < 0.0 {
            let last = part.last().copied().unwrap_or(from);
            part.push(last.lerp(to, last.y / (last.y - to.y)));
            return part;
        }
        part.push(to);
    }
    if let Some(&last) = part.last() {
        part.push(DVec2::new(last.x, 0.0));
    }
    part
}

/// Where the segments between all pairs of points cross the surface on which `side` is 0.
fn crossings(points: &[DVec3], side: &impl Fn(&DVec3) -> f64) -> impl Iterator<Item = DVec3> {
    points.iter().enumerate().flat_map(move |(i, a)| {
        points[i + 1..].iter().flat_map(move |b| {
            let (at_a, at_b) = (side(a), side(b));
            let across = (at_a <= 0.0) != (at_b <= 0.0);
            let crossing = across.then(|| a.lerp(*b, at_a / (at_a - at_b)));
            // An edge that lies in the surface.
            let within = at_a == 0.0 && at_b == 0.0;
            let ends = if within {
                [Some(*a), Some(*b)]
            } else {
                [None; 2]
            };
            crossing.into_iter().chain(ends.into_iter().flatten())
        })
    })
}

/// An envelope without what is seen through seams that rounding leaves between triangles.
fn wide_parts(envelope: Vec<Segment>) -> impl Iterator<Item = Segment> {
    let from_x = envelope.first().map_or(0.0, |first| first.from.x);
    let to_x = envelope.last().map_or(0.0, |last| last.to.x);
    let seam_mm = SAME * (to_x - from_x);
    envelope
        .into_iter()
        .filter(move |segment| segment.to.x - segment.from.x > seam_mm)
}

/// The points of a hull's section, on the outward side.
fn crossed_by_plane(corners: &[DVec3], outward: DVec2) -> Vec<DVec2> {
    let side = |corner: &DVec3| outward.perp_dot(corner.truncate());
    crossings(corners, &side)
        .map(|place| DVec2::new(outward.dot(place.truncate()), place.z))
        .filter(|point| point.x > 0.0)
        .collect()
}

/// The section of a mesh, on the outward side.
fn plane_segments(vertices: &[DVec3], triangles: &[[u32; 3]], outward: DVec2) -> Vec<Segment> {
    let sides: Vec<f64> = vertices
        .iter()
        .map(|vertex| outward.perp_dot(vertex.truncate()))
        .collect();
    cut_triangles(vertices, triangles, &sides)
        .filter_map(|ends| {
            let [a, b] = ends.map(|end| DVec2::new(outward.dot(end.truncate()), end.z));
            let (from, to) = if a.x <= b.x { (a, b) } else { (b, a) };
            if to.x <= 0.0 || from.x >= to.x {
                return None;
            }
            let share = (-from.x / (to.x - from.x)).max(0.0);
            let from = from.lerp(to, share);
            (from.x < to.x).then_some(Segment { from, to })
        })
        .collect()
}

/// Where the triangles cross the surface on which the vertices' `sides` are 0.
fn cut_triangles<'a>(
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    sides: &'a [f64],
) -> impl Iterator<Item = [DVec3; 2]> {
    triangles.iter().filter_map(move |triangle| {
        let [a, b, c] = triangle.map(|i| i as usize);
        let mut crossed = [(a, b), (b, c), (c, a)]
            .into_iter()
            .filter(|&(i, j)| (sides[i] <= 0.0) != (sides[j] <= 0.0))
            // The same place for both triangles at an edge.
            .map(|(i, j)| (i.min(j), i.max(j)))
            .map(|(i, j)| vertices[i].lerp(vertices[j], sides[i] / (sides[i] - sides[j])));
        Some([crossed.next()?, crossed.next()?])
    })
}

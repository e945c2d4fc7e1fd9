//! Scratching tools as analytic families, and the outline each leaves along its travel.
//!
//! Every tool stands with its tip at the origin and its axis along +z, lengths in mm.

use super::imprint::Imprint;
use super::mesh::Mesh;
use super::orientation::Orientation;
use super::outline::{Outline, Piece};
use crate::error::{Error, Result, in_range};
use core::f64::consts::{FRAC_PI_2, TAU};
use glam::{DMat3, DVec2, DVec3};
use std::sync::Arc;

/// A scratching tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// A cone whose tip is rounded by a sphere tangent to it.
    SpheroCone {
        half_angle_rad: f64,
        tip_radius_mm: f64,
        height_mm: f64,
    },
    /// The convex hull of these points.
    Hull(Vec<DVec3>),
    /// Any surface.
    Mesh(Arc<Mesh>),
}

impl Tool {
    /// A cone whose flank stands at `half_angle_deg` (5 to 85) to the axis, its tip rounded to
    /// `tip_radius_mm` (0 to 100, 0 = sharp), `height_mm` tall (1e-6 to 1000).
    pub fn sphero_cone(half_angle_deg: f64, tip_radius_mm: f64, height_mm: f64) -> Result<Self> {
        let half_angle_rad = in_range("half_angle_deg", half_angle_deg, 5.0, 85.0)?.to_radians();
        in_range("tip_radius_mm", tip_radius_mm, 0.0, 100.0)?;
        check_height(height_mm)?;
        let shape = Shape::SpheroCone {
            half_angle_rad,
            tip_radius_mm,
            height_mm,
        };
        if height_mm <= tip_radius_mm * (1.0 - half_angle_rad.sin()) {
            return Err(Error::number(
                "height_mm",
                height_mm,
                "more than the height of the rounded tip, tip_radius_mm (1 - sin half_angle)",
            ));
        }
        Ok(Self { shape })
    }

    /// A pyramid with `sides` faces (3 to 64), opposite faces `angle_deg` apart (10 to 170; each stands
    /// at half of it to the axis), corners at azimuths 360° (i + 1/2) / sides from +x, `height_mm` tall.
    pub fn pyramid(sides: u32, angle_deg: f64, height_mm: f64) -> Result<Self> {
        in_range("sides", f64::from(sides), 3.0, 64.0)?;
        in_range("angle_deg", angle_deg, 10.0, 170.0)?;
        check_height(height_mm)?;
        let step = TAU / f64::from(sides);
        let corner_radius = height_mm * (0.5 * angle_deg.to_radians()).tan() / (0.5 * step).cos();
        let corner = |i: u32| {
            let (sin, cos) = (step * (f64::from(i) + 0.5)).sin_cos();
            DVec3::new(corner_radius * cos, corner_radius * sin, height_mm)
        };
        let points = (0..sides).map(corner).chain([DVec3::ZERO]).collect();
        Ok(Self {
            shape: Shape::Hull(points),
        })
    }

    /// A wedge: a straight edge `width_mm` long (1e-6 to 1000) along x, its two faces meeting at
    /// `angle_deg` (1 to 170), its ends flat and parallel to the axis, `height_mm` tall.
    pub fn wedge(width_mm: f64, angle_deg: f64, height_mm: f64) -> Result<Self> {
        let half_width = 0.5 * in_range("width_mm", width_mm, 1e-6, 1000.0)?;
        in_range("angle_deg", angle_deg, 1.0, 170.0)?;
        check_height(height_mm)?;
        let half_depth = height_mm * (0.5 * angle_deg.to_radians()).tan();
        let end = |x: f64| {
            [
                DVec3::new(x, 0.0, 0.0),
                DVec3::new(x, -half_depth, height_mm),
                DVec3::new(x, half_depth, height_mm),
            ]
        };
        let points = [end(-half_width), end(half_width)].concat();
        Ok(Self {
            shape: Shape::Hull(points),
        })
    }

    /// A triangle mesh: positions in its own unit, `mm_per_unit` mm each (1e-9 to 1e9), three indices a
    /// triangle. Any mesh will do: non-convex, open, unoriented. Its lowest point (the middle, if several are
    /// lowest) becomes the tip. Where it leans over its own foot, the groove's wall stands upright.
    ///
    /// Errors: no triangles, indices out of range, positions not finite, a tool that is smaller than 1e-6 mm or
    /// larger than 1e4 mm across.
    pub fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]], mm_per_unit: f64) -> Result<Self> {
        check_unit(mm_per_unit)?;
        let vertices: Vec<DVec3> = positions
            .iter()
            .map(|&position| DVec3::from(position) * mm_per_unit)
            .collect();
        Ok(Self {
            shape: Shape::Mesh(Arc::new(Mesh::from_triangles(&vertices, triangles)?)),
        })
    }

    /// A flat sheet across the travel, such as a ground scraper: its lower edge as points (x to the right, z up),
    /// mm, two or more. Its lowest point becomes the tip.
    pub fn profile(points_mm: &[[f64; 2]]) -> Result<Self> {
        Ok(Self {
            shape: Shape::Mesh(Arc::new(Mesh::from_profile(points_mm)?)),
        })
    }

    /// The Rockwell C diamond of scratch testers: a 120° cone with a 0.2 mm tip radius (ISO 6508-2).
    pub fn rockwell_c() -> Self {
        Self::preset(Self::sphero_cone(60.0, 0.2, 3.0))
    }

    /// The Vickers diamond: a square pyramid, 136° between opposite faces (ISO 6507-2). As it stands a face
    /// leads; spin it by 45° and an edge leads.
    pub fn vickers() -> Self {
        Self::preset(Self::pyramid(4, 136.0, 3.0))
    }

    /// The Berkovich diamond: a three-sided pyramid, faces at 65.27° to the axis (ISO 14577-2). A face leads.
    pub fn berkovich() -> Self {
        Self::preset(Self::pyramid(3, 2.0 * 65.27, 3.0))
    }

    /// A wire nail: a point of 50° in all, blunted to 0.1 mm. No standard says so; sizes of our choosing.
    pub fn nail() -> Self {
        Self::preset(Self::sphero_cone(25.0, 0.1, 3.0))
    }

    /// A slotted screwdriver's edge across the travel: blade 0.8 x 4 mm, a size of ISO 2380-1, its tip ground flat
    /// 0.8 mm thick; faces at 10° to the axis, an angle of our choosing. Tilt it sideways and one corner scratches.
    pub fn screwdriver() -> Self {
        let (half_width, half_thickness, height) = (2.0, 0.4, 5.0);
        let top = half_thickness + height * 10_f64.to_radians().tan();
        let corners = [(half_thickness, 0.0), (top, height)]
            .into_iter()
            .flat_map(|(y, z)| {
                [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
                    .map(|(side, face)| DVec3::new(side * half_width, face * y, z))
            });
        Self {
            shape: Shape::Hull(corners.collect()),
        }
    }

    /// A scriber: a point of 30° in all, sharp to 0.05 mm. No standard says so; sizes of our choosing.
    pub fn scriber() -> Self {
        Self::preset(Self::sphero_cone(15.0, 0.05, 3.0))
    }

    /// A square graver: two sides of a 2.4 mm square bar that meet in a 90° keel. The bar's size is of our
    /// choosing, the keel's angle is the square's.
    pub fn square_graver() -> Self {
        let half = 2.4 * core::f64::consts::FRAC_1_SQRT_2;
        Self::preset(Self::profile(&[[-half, half], [0.0, 0.0], [half, half]]))
    }

    /// A round graver: a keel 0.6 mm wide, half a circle. A size of our choosing; makers' numbers differ.
    pub fn round_graver() -> Self {
        Self::preset(Self::profile(&round_keel(0.3)))
    }

    /// A flat graver: a straight edge 0.6 mm wide between upright sides. A size of our choosing; makers' numbers
    /// differ.
    pub fn flat_graver() -> Self {
        Self::preset(Self::profile(&[
            [-0.3, 2.0],
            [-0.3, 0.0],
            [0.3, 0.0],
            [0.3, 2.0],
        ]))
    }

    /// A needle's point: a cone of 20° in all, tip radius 0.02 mm. Sizes of our choosing.
    pub fn needle() -> Self {
        Self::preset(Self::sphero_cone(10.0, 0.02, 2.0))
    }

    /// The corner of a key: 90°, worn round to 0.15 mm. Sizes of our choosing.
    pub fn key() -> Self {
        Self::preset(Self::sphero_cone(45.0, 0.15, 2.0))
    }

    /// A corner of an abrasive grain of the mean size of FEPA grit P120, 0.125 mm across: an irregular octahedron of
    /// our choosing, sharp.
    pub fn abrasive_grain() -> Self {
        let half = 0.0625;
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, 0.1, 0.8],
            [-0.85, 0.25, 1.0],
            [0.15, 0.95, 0.9],
            [-0.1, -0.8, 0.75],
            [0.1, -0.05, 2.0],
        ];
        let corners = corners.map(|corner| DVec3::from(corner) * half);
        let faces = [0, 5]
            .into_iter()
            .flat_map(|end| [[1, 3], [3, 2], [2, 4], [4, 1]].map(|[a, b]| [end, a, b]));
        let mesh = Mesh::from_triangles(&corners, &faces.collect::<Vec<_>>());
        Self {
            shape: Shape::Mesh(Arc::new(
                mesh.expect("a preset's sizes lie in their ranges"),
            )),
        }
    }

    fn preset(tool: Result<Self>) -> Self {
        tool.expect("a preset's sizes lie in their ranges")
    }

    /// Of all orientations that are one for this tool, the same one: a cone looks alike from all sides.
    pub(crate) fn plainest(&self, orientation: Orientation) -> Orientation {
        let is_round = matches!(self.shape, Shape::SpheroCone { .. });
        let is_upright = orientation.tilt_deg == 0.0;
        // Angles out of range are kept, to be refused by name.
        match orientation.check() {
            Ok(held) if is_round => Orientation {
                spin_deg: 0.0,
                azimuth_deg: if is_upright { 0.0 } else { held.azimuth_deg },
                ..held
            },
            _ => orientation,
        }
    }

    /// Whether two tools are the same; meshes that share their memory are not compared point by point.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        match (&self.shape, &other.shape) {
            (Shape::Mesh(a), Shape::Mesh(b)) if Arc::ptr_eq(a, b) => true,
            (a, b) => a == b,
        }
    }

    /// The lower envelope of the tool held so, on the plane across its travel.
    pub(crate) fn outline(&self, orientation: Orientation) -> Result<Outline> {
        match &self.shape {
            &Shape::SpheroCone {
                half_angle_rad,
                tip_radius_mm,
                height_mm,
            } => {
                let pieces = cone_pieces(half_angle_rad, tip_radius_mm, height_mm, orientation)?;
                Ok(Outline::new(pieces.to_vec()))
            }
            Shape::Hull(points) => hull_outline(points, orientation),
            Shape::Mesh(mesh) => mesh.outline(orientation.rotation()).ok_or(Error::number(
                "spin_deg",
                orientation.spin_deg,
                "an angle at which the tool is not a flat sheet seen edge-on",
            )),
        }
    }

    /// The tool's lower surface, standing still, in the frame that `turn` brings it to.
    pub(super) fn imprint(&self, turn: DMat3) -> Imprint<'_> {
        match &self.shape {
            &Shape::SpheroCone {
                half_angle_rad,
                tip_radius_mm,
                ..
            } => Imprint::cone(turn * DVec3::Z, half_angle_rad, tip_radius_mm),
            Shape::Hull(points) => {
                Imprint::hull(points.iter().map(|&point| turn * point).collect())
            }
            Shape::Mesh(mesh) => {
                let turned = mesh.vertices.iter().map(|&vertex| turn * vertex);
                Imprint::mesh(turned.collect(), &mesh.triangles)
            }
        }
    }
}

/// Half a circle's lower edge, in steps of 3 degrees, with upright sides above.
fn round_keel(radius: f64) -> Vec<[f64; 2]> {
    let arc = (-30..=30).map(|i| {
        let (sin, cos) = (f64::from(i) * 3.0).to_radians().sin_cos();
        [radius * sin, radius * (1.0 - cos)]
    });
    let side = |x: f64| [[x, 2.0]];
    side(-radius)
        .into_iter()
        .chain(arc)
        .chain(side(radius))
        .collect()
}

/// The unit that a mesh is given in.
pub(crate) fn check_unit(mm_per_unit: f64) -> Result<f64> {
    in_range("mm_per_unit", mm_per_unit, 1e-9, 1e9)
}

fn check_height(height_mm: f64) -> Result<f64> {
    in_range("height_mm", height_mm, 1e-6, 1000.0)
}

/// Left flank, tip, right flank. A plane that contains the travel and touches the cone has an outward
/// normal n = (sin a, -cos a) with n · axis = -sin(half angle); the sphere touches it where the cone does.
fn cone_pieces(
    half_angle_rad: f64,
    radius: f64,
    height_mm: f64,
    orientation: Orientation,
) -> Result<[Piece; 3]> {
    let axis = orientation.rotation() * DVec3::Z;
    let seen = DVec2::new(axis.x, axis.z);
    let spread = (half_angle_rad.sin() / seen.length()).min(1.0).acos();
    let lean = seen.x.atan2(seen.y);
    let flank_rad = [-lean - spread, -lean + spread];
    if spread == 0.0 || flank_rad[0] >= 0.0 || flank_rad[1] <= 0.0 {
        return Err(Error::number(
            "tilt_deg",
            orientation.tilt_deg,
            "less than lays the cone's flank on the surface (90 - half_angle_deg)",
        ));
    }
    // The tool turns about its tip, where the sphere's lowest point is.
    let center = radius * seen;
    let apex = center - seen * radius / half_angle_rad.sin();
    let slant_mm = (height_mm + radius / half_angle_rad.sin() - radius) / half_angle_rad.cos();
    // The generator along which a flank's plane touches the cone, seen along the travel.
    let rim = |angle_rad: f64| {
        let normal = DVec3::new(angle_rad.sin(), 0.0, -angle_rad.cos());
        let outward = (normal + axis * half_angle_rad.sin()) / half_angle_rad.cos();
        let generator = axis * half_angle_rad.cos() + outward * half_angle_rad.sin();
        apex + slant_mm * DVec2::new(generator.x, generator.z)
    };
    let touch = |angle_rad: f64| center + radius * DVec2::new(angle_rad.sin(), -angle_rad.cos());
    let [left, right] = flank_rad.map(|angle: f64| angle.clamp(-FRAC_PI_2, FRAC_PI_2));
    // A flank that leans over its own foot leaves an upright wall.
    let upper = |angle: f64, clamped: f64| {
        let (rim, foot) = (rim(angle), touch(clamped));
        if angle == clamped {
            rim
        } else {
            DVec2::new(foot.x, rim.y.max(foot.y))
        }
    };
    Ok([
        Piece::Line {
            from: upper(flank_rad[0], left),
            to: touch(left),
        },
        Piece::Arc {
            center,
            radius,
            from_rad: left,
            to_rad: right,
        },
        Piece::Line {
            from: touch(right),
            to: upper(flank_rad[1], right),
        },
    ])
}

/// The lower hull of the points seen along the travel. Where an end leans over its own foot, the wall stands
/// upright there, up to the lowest point of the tool's upper rim.
fn hull_outline(points: &[DVec3], orientation: Orientation) -> Result<Outline> {
    let rotation = orientation.rotation();
    let top_mm = points.iter().map(|point| point.z).fold(0.0, f64::max);
    let rim = points.iter().filter(|point| point.z == top_mm);
    let rim_z = rim
        .map(|&point| (rotation * point).z)
        .fold(f64::INFINITY, f64::min);
    let seen = points.iter().map(|&point| rotation * point);
    let mut hull = lower_hull(seen.map(|point| DVec2::new(point.x, point.z)).collect());
    let lowest = hull
        .iter()
        .map(|point| point.y)
        .fold(f64::INFINITY, f64::min);
    if rim_z <= lowest {
        return Err(Error::number(
            "tilt_deg",
            orientation.tilt_deg,
            "less than brings the tool's upper rim down to the surface",
        ));
    }
    let (first, last) = (hull[0], hull[hull.len() - 1]);
    if first.y < rim_z {
        hull.insert(0, DVec2::new(first.x, rim_z));
    }
    if last.y < rim_z {
        hull.push(DVec2::new(last.x, rim_z));
    }
    let line = |pair: &[DVec2]| Piece::Line {
        from: pair[0],
        to: pair[1],
    };
    Ok(Outline::new(hull.windows(2).map(line).collect()))
}

/// The lower convex hull, left to right (Andrew 1979, monotone chain).
pub(super) fn lower_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let turns_left =
        |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 1e-12 * (b - a).length();
    let mut hull: Vec<DVec2> = Vec::new();
    let push = |hull: &mut Vec<DVec2>, point: DVec2| {
        while hull.len() > 1 && !turns_left(hull[hull.len() - 2], hull[hull.len() - 1], point) {
            hull.pop();
        }
        hull.push(point);
    };
    for &point in &points {
        push(&mut hull, point);
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An untilted cone's flanks stand at the complement of its half angle, joined by the tip's arc.
    #[test]
    fn upright_cone_is_symmetric() {
        let cut = Tool::rockwell_c()
            .outline(Orientation::default())
            .unwrap()
            .cut(0.1);
        for flank in cut.measures.flank_rad {
            assert!((flank.to_degrees() - 30.0).abs() < 1e-9, "{flank}");
        }
        assert!(
            (cut.points[0].x + cut.points.last().unwrap().x).abs() < 1e-12,
            "not centred"
        );
    }

    /// A wedge held straight cuts a box: upright ends, flat bottom, as wide as its edge.
    #[test]
    fn upright_wedge_cuts_a_box() {
        let tool = Tool::wedge(0.5, 60.0, 3.0).unwrap();
        let cut = tool.outline(Orientation::default()).unwrap().cut(0.01);
        assert!(
            (cut.measures.width_mm() - 0.5).abs() < 1e-12,
            "{}",
            cut.measures.width_mm()
        );
        assert!(
            (cut.measures.area_mm2 - 0.005).abs() < 1e-12,
            "{}",
            cut.measures.area_mm2
        );
        assert!(
            (cut.measures.flank_rad[0] - FRAC_PI_2).abs() < 1e-9,
            "{:?}",
            cut.measures.flank_rad
        );
    }
}

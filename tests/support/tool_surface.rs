//! A tool's whole surface turned, projected along the travel, and its lowest points taken.

use super::dark_sheet;
use glam::{DMat3, DVec2, DVec3, Vec3Swizzles};
use rand::Rng;
use rand::rngs::StdRng;
use std::f64::consts::TAU;
use striae::formation::{CrossSection, Orientation, Process, Tool};

pub(crate) const TALL_MM: f64 = 3.0;

#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    Cone { half_angle_deg: f64, radius_mm: f64 },
    Pyramid { sides: u32, angle_deg: f64 },
    Wedge { width_mm: f64, angle_deg: f64 },
}

impl Shape {
    pub(crate) fn any(random: &mut StdRng) -> Self {
        match random.random_range(0..3) {
            0 => Self::Cone {
                half_angle_deg: random.random_range(20.0..80.0),
                radius_mm: [0.0, 0.02, 0.2][random.random_range(0..3)],
            },
            1 => Self::Pyramid {
                sides: random.random_range(3..9),
                angle_deg: random.random_range(40.0..165.0),
            },
            _ => Self::Wedge {
                width_mm: random.random_range(0.02..1.0),
                angle_deg: random.random_range(20.0..165.0),
            },
        }
    }

    pub(crate) fn tool(self) -> Tool {
        match self {
            Self::Cone {
                half_angle_deg,
                radius_mm,
            } => Tool::sphero_cone(half_angle_deg, radius_mm, TALL_MM),
            Self::Pyramid { sides, angle_deg } => Tool::pyramid(sides, angle_deg, TALL_MM),
            Self::Wedge {
                width_mm,
                angle_deg,
            } => Tool::wedge(width_mm, angle_deg, TALL_MM),
        }
        .unwrap()
    }

    /// Edges that lie on the surface, dense enough that nothing of it is far below all of them.
    pub(crate) fn edges(self) -> Vec<[DVec3; 2]> {
        let ring = |count: u32, start: f64| {
            (0..count).map(move |i| TAU * (f64::from(i) + start) / f64::from(count))
        };
        match self {
            Self::Cone {
                half_angle_deg,
                radius_mm,
            } => {
                let half = half_angle_deg.to_radians();
                // The generator: up the sphere to where the cone touches it, then up the cone.
                let reach = TAU / 4.0 - half;
                let mut line: Vec<DVec2> = (0..=120)
                    .map(|i| reach * f64::from(i) / 120.0)
                    .map(|angle| radius_mm * DVec2::new(angle.sin(), 1.0 - angle.cos()))
                    .collect();
                let foot = line[120];
                line.push(foot + (TALL_MM - foot.y) * DVec2::new(half.tan(), 1.0));
                let at = |i: usize, k: u32| {
                    let (sin, cos) = (TAU * f64::from(k) / 400.0).sin_cos();
                    DVec3::new(line[i].x * cos, line[i].x * sin, line[i].y)
                };
                // Up each generator, and round from each to the next.
                (0..121)
                    .flat_map(|i| (0..400).map(move |k| (i, k)))
                    .flat_map(|(i, k)| [[at(i, k), at(i + 1, k)], [at(i, k), at(i, k + 1)]])
                    .collect()
            }
            Self::Pyramid { sides, angle_deg } => {
                let apothem = TALL_MM * (0.5 * angle_deg).to_radians().tan();
                let corner = apothem / (0.5 * TAU / f64::from(sides)).cos();
                let corners: Vec<DVec3> = ring(sides, 0.5)
                    .map(|a| DVec3::new(corner * a.cos(), corner * a.sin(), TALL_MM))
                    .collect();
                let next = corners.iter().cycle().skip(1);
                let rim = corners.iter().zip(next).map(|(&a, &b)| [a, b]);
                rim.chain(corners.iter().map(|&c| [DVec3::ZERO, c]))
                    .collect()
            }
            Self::Wedge {
                width_mm,
                angle_deg,
            } => {
                let (x, y) = (
                    0.5 * width_mm,
                    TALL_MM * (0.5 * angle_deg).to_radians().tan(),
                );
                let at = |i: f64, j: f64, z: f64| DVec3::new(i * x, j * y, z);
                let feet = [at(-1.0, 0.0, 0.0), at(1.0, 0.0, 0.0)];
                let top = |i: f64| [at(i, -1.0, TALL_MM), at(i, 1.0, TALL_MM)];
                let [a, b] = top(-1.0);
                let [c, d] = top(1.0);
                let [e, f] = feet;
                vec![
                    [e, f],
                    [e, a],
                    [e, b],
                    [f, c],
                    [f, d],
                    [a, b],
                    [c, d],
                    [a, c],
                    [b, d],
                ]
            }
        }
    }
}

/// Spin about z, then the axis from z towards the azimuth (0 = forward = +y, 90 = left = -x).
pub(crate) fn turn(orientation: &Orientation) -> DMat3 {
    let spin = DMat3::from_rotation_z(orientation.spin_deg.to_radians());
    let (sin, cos) = orientation.azimuth_deg.to_radians().sin_cos();
    let lean = DVec3::Z.cross(DVec3::new(-sin, cos, 0.0));
    DMat3::from_axis_angle(lean.normalize(), orientation.tilt_deg.to_radians()) * spin
}

/// The lowest height over `x` of edges seen along the travel; infinite beside the tool.
pub(crate) fn lowest(edges: &[[DVec2; 2]], x: f64) -> f64 {
    let mut low = f64::INFINITY;
    for [a, b] in edges {
        if (a.x <= x) != (b.x <= x) {
            low = low.min(a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y));
        }
    }
    low
}

/// Where the lowest points rise through the surface on the way from `inside` to `outside`.
pub(crate) fn crossing(edges: &[[DVec2; 2]], inside: f64, outside: f64) -> f64 {
    let (mut low, mut high) = (inside, outside);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if lowest(edges, middle) < 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    low
}

/// A shape, a process and what they leave.
pub(crate) fn any_section(random: &mut StdRng) -> (Shape, Process, CrossSection) {
    loop {
        let shape = Shape::any(random);
        let orientation = Orientation {
            spin_deg: random.random_range(-180.0..180.0),
            tilt_deg: random.random_range(0.0..60.0),
            azimuth_deg: random.random_range(-360.0..360.0),
        };
        let process = Process {
            force_kgf: 10_f64.powf(random.random_range(-0.5..1.5)),
            orientation,
            ..Process::default()
        };
        if let Ok(section) = CrossSection::form(&shape.tool(), &process, &dark_sheet()) {
            return (shape, process, section);
        }
    }
}

/// The same, and the tool's edges as seen along the travel, lifted until the lowest point is at the groove's
/// depth.
pub(crate) fn any_case(random: &mut StdRng) -> (String, CrossSection, Vec<[DVec2; 2]>) {
    let (shape, process, section) = any_section(random);
    let turn = turn(&process.orientation);
    let seen = |p: DVec3| (turn * p).xz();
    let mut edges: Vec<[DVec2; 2]> = shape.edges().iter().map(|e| e.map(seen)).collect();
    let tip = edges
        .iter()
        .flatten()
        .fold(f64::INFINITY, |z, p| z.min(p.y));
    for point in edges.iter_mut().flatten() {
        point.y -= tip + section.depth_mm();
    }
    // What is far above the surface is lowest nowhere that matters.
    edges.retain(|[a, b]| a.y.min(b.y) < 0.5 * section.depth_mm());
    (format!("{shape:?}, {process:?}"), section, edges)
}

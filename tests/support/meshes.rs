//! Meshes with texture coordinates, and places on them found by looking at every triangle.

use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};
use striae::pattern::Surface;

/// A triangle mesh as a renderer has it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) uv: Vec<[f64; 2]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds a grid of `n` by `m` cells over the unit square, each two triangles.
    pub(crate) fn add_grid(
        &mut self,
        [n, m]: [u32; 2],
        place: impl Fn(DVec2) -> DVec3,
        uv: impl Fn(DVec2) -> DVec2,
    ) {
        let first = u32::try_from(self.positions.len()).unwrap();
        for (j, i) in (0..=m).flat_map(|j| (0..=n).map(move |i| (j, i))) {
            let p = DVec2::new(f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
            self.positions.push(place(p).to_array());
            self.uv.push(uv(p).to_array());
        }
        for (j, i) in (0..m).flat_map(|j| (0..n).map(move |i| (j, i))) {
            let a = first + j * (n + 1) + i;
            let [b, c, d] = [a + 1, a + n + 1, a + n + 2];
            self.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }

    /// A torus around z, u the long way round and v the short, with a seam each.
    pub(crate) fn torus(major: f64, minor: f64, cells: [u32; 2]) -> Self {
        let mut mesh = Self::default();
        mesh.add_grid(cells, |p| on_torus(major, minor, p), |p| p);
        // Round and round to the bit: both sides of a seam are at the same place.
        let [n, m] = cells.map(|k| k as usize);
        for j in 0..=m {
            mesh.positions[j * (n + 1) + n] = mesh.positions[j * (n + 1)];
        }
        for i in 0..=n {
            mesh.positions[m * (n + 1) + i] = mesh.positions[i];
        }
        mesh
    }

    /// A sphere by longitude u and latitude v: the rows at its poles are triangles without area.
    pub(crate) fn sphere(radius: f64, cells: [u32; 2]) -> Self {
        let place = |p: DVec2| {
            let (latitude, longitude) = (PI * (p.y - 0.5), TAU * p.x);
            let flat = if p.y == 0.0 || p.y == 1.0 {
                0.0
            } else {
                radius * latitude.cos()
            };
            DVec3::new(
                flat * longitude.cos(),
                flat * longitude.sin(),
                radius * latitude.sin(),
            )
        };
        let mut mesh = Self::default();
        mesh.add_grid(cells, place, |p| p);
        let [n, m] = cells.map(|k| k as usize);
        for j in 0..=m {
            mesh.positions[j * (n + 1) + n] = mesh.positions[j * (n + 1)];
        }
        mesh
    }

    /// A bent panel of a car's body, 1000 by 600 mm, of two charts that meet at x = 0: the right one is mirrored.
    pub(crate) fn panel(cells: u32) -> Self {
        let mut mesh = Self::default();
        let half = |sign: f64| {
            move |p: DVec2| on_panel(DVec2::new(sign * 500.0 * p.x, 600.0 * p.y - 300.0))
        };
        mesh.add_grid([cells, cells], half(-1.0), |p| {
            DVec2::new(0.45 - 0.4 * p.x, 0.1 + 0.4 * p.y)
        });
        mesh.add_grid([cells, cells], half(1.0), |p| {
            DVec2::new(0.95 - 0.4 * p.x, 0.5 + 0.4 * p.y)
        });
        mesh
    }

    /// A cube from -1 to 1, each side a chart of its own.
    pub(crate) fn cube(cells: u32) -> Self {
        let mut mesh = Self::default();
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        for k in 0..6_u32 {
            let axis = axes[k as usize % 3];
            let (a, b) = (axes[(k as usize + 1) % 3], axes[(k as usize + 2) % 3]);
            let sign = if k < 3 { 1.0 } else { -1.0 };
            let corner = DVec2::new(f64::from(k % 3), f64::from(k / 3)) / 3.0;
            mesh.add_grid(
                [cells, cells],
                |p| sign * axis + a * (2.0 * p.x - 1.0) + b * (2.0 * p.y - 1.0),
                |p| corner + 0.3 * p,
            );
        }
        mesh
    }

    pub(crate) fn surface(&self) -> Surface {
        Surface::new(&self.positions, &self.uv, &self.triangles).unwrap()
    }

    fn corners(&self, triangle: &[u32; 3]) -> [DVec3; 3] {
        triangle.map(|k| DVec3::from(self.positions[k as usize]))
    }

    /// The closest point of all triangles.
    pub(crate) fn nearest(&self, p: DVec3) -> DVec3 {
        let on_each = self.triangles.iter().map(|t| closest(self.corners(t), p));
        on_each
            .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            .unwrap()
    }

    /// The places that have this (u, v), within `slack` of a triangle's extent.
    pub(crate) fn places(&self, uv: DVec2, slack: f64) -> Vec<DVec3> {
        let place = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|k| DVec2::from(self.uv[k as usize]));
            let area = (b - a).perp_dot(c - a);
            let w = [
                (b - uv).perp_dot(c - uv) / area,
                (c - uv).perp_dot(a - uv) / area,
                (a - uv).perp_dot(b - uv) / area,
            ];
            let [p, q, r] = self.corners(t);
            w.iter()
                .all(|&w| w >= -slack)
                .then_some(p * w[0] + q * w[1] + r * w[2])
        };
        self.triangles.iter().filter_map(place).collect()
    }
}

pub(crate) fn on_torus(major: f64, minor: f64, p: DVec2) -> DVec3 {
    let (around, across) = (TAU * p.x, TAU * p.y);
    let from_axis = major + minor * across.cos();
    DVec3::new(
        from_axis * around.cos(),
        from_axis * around.sin(),
        minor * across.sin(),
    )
}

/// The panel's height over (x, y) mm.
pub(crate) fn on_panel(p: DVec2) -> DVec3 {
    let z = -p.x * p.x / 3000.0 - p.y * p.y / 1500.0 + p.x * p.y / 6000.0;
    p.extend(z)
}

/// The closest point of a triangle: inside, or of its sides.
fn closest([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let n = (b - a).cross(c - a);
    let sides = [(a, b), (b, c), (c, a)];
    if n != DVec3::ZERO {
        let q = p - n * ((p - a).dot(n) / n.length_squared());
        if sides.iter().all(|&(s, e)| n.cross(e - s).dot(q - s) >= 0.0) {
            return q;
        }
    }
    let on_side = |(s, e): (DVec3, DVec3)| {
        let along = e - s;
        let share = (p - s).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        s + along * share.clamp(0.0, 1.0)
    };
    let on_sides = sides.map(on_side);
    on_sides
        .into_iter()
        .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
        .unwrap()
}

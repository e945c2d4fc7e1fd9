//! Paths drawn on meshes, against their projection found by looking at every triangle.

mod against_projection;
mod anything;
mod charts;
mod leaving;
mod refused;
#[path = "../support/mod.rs"]
mod support;

use glam::{DVec2, DVec3};
use striae::pattern::{Curve, Path, Spline, Surface};
use support::meshes::Mesh;

fn bezier<V>(control: [V; 4], t: f64) -> V
where
    V: Copy + std::ops::Add<Output = V> + std::ops::Mul<f64, Output = V>,
{
    let r = 1.0 - t;
    let [a, b, c, d] = control;
    a * (r * r * r) + b * (3.0 * r * r * t) + c * (3.0 * r * t * t) + d * (t * t * t)
}

fn on_surface<'a>(surface: &'a Surface, spline: Spline<'a, 3>) -> Vec<Curve> {
    let path = Path::OnSurface { surface, spline };
    path.curves(DVec2::ONE).unwrap()
}

fn plate() -> Mesh {
    let mut mesh = Mesh::default();
    let place = |p: DVec2| DVec3::new(100.0 * p.x, 100.0 * p.y, 0.0);
    mesh.add_grid([1, 1], place, |p| p);
    mesh
}

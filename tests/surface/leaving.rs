//! Where a path leaves the mesh, and where its closest point leaps.

use super::support::meshes::Mesh;
use super::support::relative;
use super::{on_surface, plate};
use glam::{DVec2, DVec3};
use striae::pattern::{Path, Spline, SplineKind};

/// Where a path leaves the mesh it ends, and arc length goes on where it comes back.
#[test]
fn borders() {
    let mesh = plate();
    let surface = mesh.surface();
    let points = [
        [20.0, 50.0, 0.0],
        [120.0, 50.0, 0.0],
        [120.0, 80.0, 0.0],
        [50.0, 80.0, 0.0],
    ];
    let curves = on_surface(&surface, Spline::open(SplineKind::Polyline, &points));
    let sum: f64 = curves.iter().map(|curve| curve.length).sum();
    assert!((sum - 130.0).abs() < 1e-3, "{sum}");
    let parted = curves.iter().filter(|curve| !curve.joins).count();
    assert_eq!(parted, 2, "its start and its return");
    let off = [[120.0, 50.0, 0.0], [130.0, 50.0, 0.0]];
    let path = Path::OnSurface {
        surface: &surface,
        spline: Spline::open(SplineKind::Polyline, &off),
    };
    let refused = path.curves(DVec2::ONE).unwrap_err().to_string();
    assert!(
        refused.starts_with("points_xyz is off the surface; accepted"),
        "{refused}"
    );
}

/// Over a valley the closest point leaps from one side to the other: the path runs down and up again.
#[test]
fn leaps() {
    let mut mesh = Mesh::default();
    let valley = |p: DVec2| DVec3::new(20.0 * p.x - 10.0, 10.0 * p.y, (20.0 * p.x - 10.0).abs());
    mesh.add_grid([20, 10], valley, |p| p);
    let points = [[-8.0, 5.0, 9.0], [8.0, 5.2, 9.0]];
    let curves = on_surface(&mesh.surface(), Spline::open(SplineKind::Polyline, &points));
    let sum: f64 = curves.iter().map(|curve| curve.length).sum();
    // Both ends project to x = ±8.5.
    let down_and_up = 17.0 * 2.0_f64.sqrt();
    assert!(relative(sum, down_and_up) < 1e-3, "{sum} of {down_and_up}");
    assert!(
        curves[1..].iter().all(|curve| curve.joins),
        "parted on its way"
    );
}

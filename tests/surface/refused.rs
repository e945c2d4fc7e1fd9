//! Meshes and points that cannot be.

use super::plate;
use glam::DVec2;
use striae::pattern::{Path, Spline, SplineKind, Surface};

/// Meshes that cannot be are refused by name; triangles without area are left out.
#[test]
fn bad_meshes() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.0]];
    let uv = positions.map(|p| [p[0], p[1]]);
    let refused = |positions: &[[f64; 3]], uv: &[[f64; 2]], triangles: &[[u32; 3]]| {
        Surface::new(positions, uv, triangles)
            .unwrap_err()
            .to_string()
    };
    let good = [[0, 1, 2]];
    let mut bad = positions;
    bad[2][1] = f64::NAN;
    let mut bad_uv = uv;
    bad_uv[1][0] = f64::INFINITY;
    for (said, text) in [
        (
            refused(&positions, &uv[..3], &good),
            "uv_count is 3; accepted: as many",
        ),
        (refused(&bad, &uv, &good), "positions[2] is NaN"),
        (refused(&positions, &bad_uv, &good), "uv[1] is inf"),
        (
            refused(&positions, &uv, &[[0, 1, 2], [0, 1, 4]]),
            "triangles[1] is 4; accepted",
        ),
        (
            refused(&positions, &uv, &[]),
            "triangle_count is 0; accepted",
        ),
        (
            refused(&positions, &uv, &[[1, 2, 3], [0, 0, 1]]),
            "triangle_count is 0; accepted",
        ),
        (
            refused(&positions, &[[0.5; 2]; 4], &good),
            "triangle_count is 0; accepted",
        ),
    ] {
        assert!(said.starts_with(text), "{said}, not {text}");
    }
    let kept = Surface::new(&positions, &uv, &[[1, 2, 3], [0, 1, 2]]);
    assert!(kept.is_ok(), "a triangle without area beside a good one");
}

/// Points that are too few, not finite or all in one place are refused by name.
#[test]
fn bad_points() {
    let surface = plate().surface();
    let refused = |points: &[[f64; 3]]| {
        let spline = Spline::open(SplineKind::Polyline, points);
        let surface = &surface;
        let path = Path::OnSurface { surface, spline };
        path.curves(DVec2::ONE).unwrap_err().to_string()
    };
    let nan = [[0.0; 3], [1.0, f64::NAN, 0.0]];
    for (said, text) in [
        (refused(&[]), "point_count is 0"),
        (refused(&nan), "points_xyz[1] is NaN"),
        (refused(&[[50.0; 3]; 3]), "points_xyz is 0; accepted"),
        (
            refused(&[[50.0, 50.0, 1.0], [50.0, 50.0, 9.0]]),
            "points_xyz is",
        ),
    ] {
        assert!(said.starts_with(text), "{said}, not {text}");
    }
}

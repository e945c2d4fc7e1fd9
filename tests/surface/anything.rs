//! Letters around a ring, whatever is drawn near whatever mesh, and a million triangles.

use super::on_surface;
use super::support::inscription::{around_ring, length};
use super::support::meshes::Mesh;
use super::support::random;
use glam::DVec2;
use rand::Rng;
use striae::pattern::{Path, Spline, SplineKind};

/// Stroke letters cut around a ring, as in the paper's Figure 13, are as long on the mesh as they are drawn.
#[test]
fn inscription() {
    let ring = [10.0, 3.0];
    let surface = Mesh::torus(ring[0], ring[1], [128, 64]).surface();
    let strokes = around_ring("STRIAE ROSE TAROT", ring, 2.0, 0.8);
    assert!(strokes.len() > 25, "{} strokes", strokes.len());
    for (points, smooth) in &strokes {
        let kind = if *smooth {
            SplineKind::CatmullRom
        } else {
            SplineKind::Polyline
        };
        let curves = on_surface(&surface, Spline::open(kind, points));
        let sum: f64 = curves.iter().map(|curve| curve.length).sum();
        let most = if *smooth { 1.12 } else { 1.002 };
        let drawn = length(points);
        assert!(
            (0.995..most).contains(&(sum / drawn)),
            "{sum} of {drawn}, {kind:?}"
        );
    }
}

/// Whatever is drawn near whatever mesh, of any size, comes to finite curves that hang together.
#[test]
fn anything_drawn() {
    let mut random = random(71);
    let meshes = [
        (Mesh::cube(1), 2.0),
        (Mesh::cube(3), 2.0),
        (Mesh::sphere(1.0, [12, 6]), 1.5),
        (Mesh::torus(1.0, 0.4, [20, 10]), 1.6),
    ];
    let mut drawn = 0;
    for (mesh, reach) in meshes {
        for size in [1.0, 1e-4, 1e5] {
            let mut sized = mesh.clone();
            for p in &mut sized.positions {
                *p = p.map(|x| x * size);
            }
            let surface = sized.surface();
            for case in 0..40 {
                // Some on a lattice, where closest points lie on edges and corners.
                let mut coordinate = || {
                    let x: f64 = random.random_range(-reach..reach);
                    size * if case % 4 == 0 { x.round() } else { x }
                };
                let points: Vec<[f64; 3]> = (0..4)
                    .map(|_| std::array::from_fn(|_| coordinate()))
                    .collect();
                let kinds = [
                    SplineKind::Polyline,
                    SplineKind::CatmullRom,
                    SplineKind::BSpline,
                ];
                let spline = Spline {
                    kind: kinds[case % 3],
                    points: &points,
                    closed: case % 2 == 0,
                };
                let surface = &surface;
                let path = Path::OnSurface { surface, spline };
                let Ok(curves) = path.curves(DVec2::ONE) else {
                    continue;
                };
                drawn += 1;
                for (i, curve) in curves.iter().enumerate() {
                    let sound = curve.length > 0.0 && curve.length.is_finite();
                    let finite = curve.control.iter().all(|p| p.is_finite());
                    let inside = curve.control.iter().all(|p| p.abs().max_element() < 3.0);
                    assert!(
                        sound && finite && inside,
                        "{spline:?}, {i}: {curve:?} of size {size}"
                    );
                    let before = curves[(i + curves.len() - 1) % curves.len()].control[3];
                    assert!(
                        !curve.joins || before.distance(curve.control[0]) < 1e-6,
                        "{spline:?}: a gap before curve {i}"
                    );
                }
            }
        }
    }
    assert!(drawn > 450, "only {drawn} came to a path");
}

/// How long a mesh of a million triangles and a thousand strokes take.
#[test]
#[ignore = "a measurement: cargo test --release --test surface a_large -- --ignored --nocapture"]
fn a_large_mesh() {
    let ring = [10.0, 3.0];
    let mesh = Mesh::torus(ring[0], ring[1], [1000, 500]);
    let start = std::time::Instant::now();
    let surface = mesh.surface();
    println!(
        "a million triangles: {:.2} s",
        start.elapsed().as_secs_f64()
    );
    let strokes = around_ring("STRIAE", ring, 2.0, 0.1);
    let start = std::time::Instant::now();
    let mut curves = 0;
    for (points, _) in &strokes {
        curves += on_surface(&surface, Spline::open(SplineKind::CatmullRom, points)).len();
    }
    let each = start.elapsed().as_secs_f64() / strokes.len() as f64;
    println!("a stroke: {:.1} ms, {curves} curves in all", 1e3 * each);
    assert!(curves > 0, "nothing drawn");
}

//! Paths drawn on meshes, against their projection found by looking at every triangle.

mod support;

use glam::{DVec2, DVec3};
use rand::Rng;
use std::f64::consts::TAU;
use striae::formation::{DepthLaw, Orientation, Tool};
use striae::pattern::{
    Curve, Footprint, Key, Path, Scratch, Spline, SplineKind, Surface, SurfacePoint,
};
use striae::scattering::{Output, Shading};
use support::inscription::{around_ring, length};
use support::meshes::{Mesh, on_panel, on_torus};
use support::{dark_sheet, random, relative, sheet_of};

/// Cubic Béziers along a smooth curve over 0 to 1, with its tangents at their ends.
fn beziers(curve: impl Fn(f64) -> DVec3, count: u32, closed: bool) -> Vec<[f64; 3]> {
    let h = 1e-5;
    let slope = |t: f64| (curve(t + h) - curve(t - h)) / (2.0 * h);
    let mut points = Vec::new();
    for i in 0..count {
        let [from, to] = [i, i + 1].map(|i| f64::from(i) / f64::from(count));
        let third = (to - from) / 3.0;
        let end = curve(to) - slope(to) * third;
        points.extend([curve(from), curve(from) + slope(from) * third, end]);
    }
    if !closed {
        points.push(curve(1.0));
    }
    points.iter().map(DVec3::to_array).collect()
}

fn bezier<V>(control: [V; 4], t: f64) -> V
where
    V: Copy + std::ops::Add<Output = V> + std::ops::Mul<f64, Output = V>,
{
    let r = 1.0 - t;
    let [a, b, c, d] = control;
    a * (r * r * r) + b * (3.0 * r * r * t) + c * (3.0 * r * t * t) + d * (t * t * t)
}

/// The projection of closed or open Béziers, point by point.
fn projected(mesh: &Mesh, points: &[[f64; 3]], per_curve: u32) -> Vec<DVec3> {
    let count = points.len();
    let at = |i: usize| DVec3::from(points[i % count]);
    let curves = count / 3;
    let mut all = vec![mesh.nearest(at(0))];
    for i in 0..curves {
        let control = [0, 1, 2, 3].map(|k| at(3 * i + k));
        for k in 1..=per_curve {
            let t = f64::from(k) / f64::from(per_curve);
            all.push(mesh.nearest(bezier(control, t)));
        }
    }
    all
}

fn to_line(line: &[DVec3], p: DVec3) -> f64 {
    let side = |pair: &[DVec3]| {
        let along = pair[1] - pair[0];
        let share = (p - pair[0]).dot(along) / along.length_squared().max(1e-300);
        (pair[0] + along * share.clamp(0.0, 1.0)).distance(p)
    };
    line.windows(2).map(side).fold(f64::INFINITY, f64::min)
}

fn on_surface<'a>(surface: &'a Surface, spline: Spline<'a, 3>) -> Vec<Curve> {
    let path = Path::OnSurface { surface, spline };
    path.curves(DVec2::ONE).unwrap()
}

/// Checks place, arc length and order; returns the path's curves.
fn check(name: &str, mesh: &Mesh, points: &[[f64; 3]], closed: bool, most: f64) -> Vec<Curve> {
    let surface = mesh.surface();
    let spline = Spline {
        kind: SplineKind::CubicBezier,
        points,
        closed,
    };
    let curves = on_surface(&surface, spline);
    // Fine where that is cheap: chords must not be what is measured.
    let per_curve = if mesh.triangles.len() < 100 {
        2000
    } else {
        100
    };
    let truth = projected(mesh, points, per_curve);
    let mut worst = 0.0_f64;
    let mut last: Option<DVec3> = None;
    for (i, curve) in curves.iter().enumerate() {
        for k in 0..=8 {
            let uv = bezier(curve.control, f64::from(k) / 8.0);
            // A fit may reach a little over a seam or pole: its place in space is what counts.
            let places = mesh.places(uv, 0.1);
            let away = |p: &DVec3| to_line(&truth, *p);
            let place = places
                .into_iter()
                .min_by(|a, b| away(a).total_cmp(&away(b)))
                .unwrap_or_else(|| panic!("{name}: no place has {uv}"));
            worst = worst.max(away(&place));
            if let (0, Some(last)) = (k, last) {
                let gap = last.distance(place);
                assert!(gap < 2.0 * most, "{name}: a gap of {gap} before curve {i}");
            }
            last = Some(place);
        }
        if i > 0 && curve.joins {
            let gap = curves[i - 1].control[3].distance(curve.control[0]);
            assert!(gap < 1e-9, "{name}: {gap} apart in texture space");
        }
    }
    let sum: f64 = curves.iter().map(|curve| curve.length).sum();
    let chords: f64 = truth.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    println!(
        "{name}: {} curves, {worst:.1e} off, length {sum} of {chords} ({:.1e})",
        curves.len(),
        sum / chords - 1.0
    );
    assert!(worst < most, "{name}: {worst} off");
    assert!(relative(sum, chords) < 1e-3, "{name}: {sum} of {chords}");
    assert!(
        curves.iter().all(|curve| curve.length > 0.0),
        "{name}: shares grow"
    );
    curves
}

/// The largest angle at which curves that join meet, radians (in texture space of these units).
fn worst_kink(curves: &[Curve], units: DVec2) -> f64 {
    let count = curves.len();
    let mut worst = 0.0_f64;
    for i in 0..count {
        let before = &curves[(i + count - 1) % count];
        if curves[i].joins {
            let into = (before.control[3] - before.control[2]) * units;
            let out = (curves[i].control[1] - curves[i].control[0]) * units;
            worst = worst.max(into.perp_dot(out).atan2(into.dot(out)).abs());
        }
    }
    worst
}

/// A wave around a ring, over both seams: closed in space, parted twice as often as it passes one.
#[test]
fn torus() {
    let (major, minor) = (10.0, 3.0);
    let mesh = Mesh::torus(major, minor, [96, 48]);
    let wave = |t: f64| {
        let p = DVec2::new(t + 0.03, 0.1 * (2.0 * TAU * t).sin() + 0.02);
        on_torus(major, minor + 0.05, p)
    };
    let points = beziers(wave, 24, true);
    let curves = check("torus", &mesh, &points, true, 0.01);
    let parted = curves.iter().filter(|curve| !curve.joins).count();
    assert_eq!(parted, 5, "one seam of u, four of v");
    assert!(curves[0].joins, "it closes where no seam is");
    let kink = worst_kink(&curves, DVec2::new(70.0, 19.0));
    assert!(kink < 1e-9, "kinks of {kink}");
    assert!(curves.len() < 200, "{} curves", curves.len());
}

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

/// An S over a bent panel of two charts, one mirrored: smooth in each, parted once.
#[test]
fn panel() {
    for cells in [8, 24, 64] {
        let mesh = Mesh::panel(cells);
        let s = |t: f64| {
            let p = DVec2::new(800.0 * t - 400.0, 150.0 * (TAU * t).sin());
            on_panel(p) + DVec3::new(0.0, 0.0, 0.5)
        };
        let points = beziers(s, 12, false);
        let most = 300.0 / f64::from(cells * cells);
        let name = format!("panel of {cells}");
        let curves = check(&name, &mesh, &points, false, most);
        let parted = curves.iter().filter(|curve| !curve.joins).count();
        assert_eq!(parted, 2, "its start and the seam");
        let kink = worst_kink(&curves, DVec2::new(1200.0, 1500.0));
        assert!(kink < 1e-9, "kinks of {kink}");
    }
}

/// Around a cube, on which every edge is a seam, close to a corner too.
#[test]
fn cube() {
    for cells in [1, 4] {
        let mesh = Mesh::cube(cells);
        for tilt in [0.0, 0.31, 0.8] {
            let round = |t: f64| {
                let (y, x) = (TAU * (t + 0.01)).sin_cos();
                1.5 * DVec3::new(x, y, tilt * x + 0.1 * tilt * y)
            };
            let points = beziers(round, 16, true);
            let name = format!("cube of {cells}, {tilt}");
            let curves = check(&name, &mesh, &points, true, 4e-3);
            let parted = curves.iter().filter(|curve| !curve.joins).count();
            assert!(parted >= 4, "{name}: parted {parted} times");
        }
    }
}

/// Around a sphere, over its seam, and right over and near both poles.
#[test]
fn sphere() {
    let mesh = Mesh::sphere(5.0, [64, 32]);
    let normals = [
        DVec3::new(0.3, 0.1, 1.0),
        DVec3::new(0.02, 1.0, 0.0),
        DVec3::new(0.7, 1.0, 0.02),
    ];
    for normal in normals {
        let a = normal.any_orthogonal_vector().normalize();
        let b = normal.cross(a).normalize();
        let round = |t: f64| {
            let (y, x) = (TAU * (t + 0.013)).sin_cos();
            5.1 * (a * x + b * y)
        };
        let points = beziers(round, 16, true);
        check(&format!("sphere {normal}"), &mesh, &points, true, 0.02);
    }
}

fn plate() -> Mesh {
    let mut mesh = Mesh::default();
    let place = |p: DVec2| DVec3::new(100.0 * p.x, 100.0 * p.y, 0.0);
    mesh.add_grid([1, 1], place, |p| p);
    mesh
}

/// On a plate of two triangles a curve stays what it is: no facets, and few curves.
#[test]
fn flat() {
    let points = [
        [10.0, 10.0, 1.0],
        [30.0, 90.0, 2.0],
        [60.0, -20.0, 0.0],
        [90.0, 80.0, -3.0],
    ];
    let curves = check("plate", &plate(), &points, false, 3e-3);
    assert!(curves.len() <= 32, "{} curves", curves.len());
    assert!(worst_kink(&curves, DVec2::ONE) < 1e-9, "kinks");
}

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

/// On a mirrored chart left and right of travel stay what they are on the mesh: the frame's y is z × x, and travel is
/// measured in it. A tool that leans to one side leaves the same scratch on both sides of the seam.
#[test]
fn mirrored_charts() {
    let mut mesh = Mesh::default();
    let half = |from: f64| move |p: DVec2| DVec3::new(from + 500.0 * p.x, 1000.0 * p.y, 0.0);
    mesh.add_grid([5, 10], half(-500.0), |p| DVec2::new(0.5 * p.x, p.y));
    mesh.add_grid([5, 10], half(0.0), |p| {
        DVec2::new(1.0 + 0.5 * p.x, 1.0 - p.y)
    });
    let surface = mesh.surface();
    let points = [[-400.0, 300.0, 0.0], [400.0, 700.0, 0.0]];
    let lean = Orientation {
        spin_deg: 0.0,
        tilt_deg: 10.0,
        azimuth_deg: 90.0,
    };
    let key = Key {
        orientation: lean,
        ..Key::depth(0.0, 0.1)
    };
    let mut builder = sheet_of(&dark_sheet());
    builder
        .add(&Scratch {
            path: Path::OnSurface {
                surface: &surface,
                spline: Spline::open(SplineKind::Polyline, &points),
            },
            keys: &[key],
            depth_law: DepthLaw::Stated,
            ..Scratch::new(&Tool::vickers())
        })
        .unwrap();
    let pattern = builder.build();
    let radiance = |mirrored: bool, right: f64| {
        let along = if mirrored { 200.0 } else { -200.0 };
        let travel = DVec2::new(2.0, 1.0).normalize();
        let p = DVec2::new(along, 500.0 + 0.5 * along) - right * travel.perp();
        let (uv, dv) = if mirrored {
            (DVec2::new(1.0 + p.x / 1000.0, 1.0 - p.y / 1000.0), -1000.0)
        } else {
            (DVec2::new((p.x + 500.0) / 1000.0, p.y / 1000.0), 1000.0)
        };
        let point = SurfacePoint {
            uv: uv.to_array(),
            dp_du: [1000.0, 0.0, 0.0],
            dp_dv: [0.0, dv, 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Radius(0.03),
        };
        let mut shading = Shading::default();
        shading.shade(&pattern, &point, [0.0, 0.0, 1.0]).unwrap();
        f64::from(shading.eval([0.5, -0.3, 0.8], Output::BrdfCos)[0])
    };
    let mut sides = 0.0_f64;
    for right in [-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2] {
        let (plain, mirrored) = (radiance(false, right), radiance(true, right));
        sides = sides.max(relative(plain, radiance(false, -right)));
        assert!(
            relative(plain, mirrored) < 2e-2,
            "{right} mm to the right: {plain}, mirrored {mirrored}"
        );
    }
    assert!(sides > 0.1, "left and right look alike: {sides}");
}

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

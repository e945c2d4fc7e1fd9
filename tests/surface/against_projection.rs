//! Curves drawn near meshes are their closest points on them, point by point.

use super::support::meshes::{Mesh, on_panel, on_torus};
use super::support::relative;
use super::{bezier, on_surface, plate};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use striae::pattern::{Curve, Spline, SplineKind};

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

/// An S over a bent panel of two charts, one mirrored: smooth in each, parted once.
#[test]
fn panel() {
    for (cells, most) in [(8, 0.3), (24, 0.1), (64, 0.02)] {
        let mesh = Mesh::panel(cells);
        let s = |t: f64| {
            let p = DVec2::new(800.0 * t - 400.0, 150.0 * (TAU * t).sin());
            on_panel(p) + DVec3::new(0.0, 0.0, 0.5)
        };
        let points = beziers(s, 12, false);
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
        check(&format!("sphere {normal}"), &mesh, &points, true, 0.01);
    }
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
    let curves = check("plate", &plate(), &points, false, 1.5e-3);
    assert!(curves.len() <= 32, "{} curves", curves.len());
    let joined = curves[1..].iter().all(|curve| curve.joins);
    assert!(joined, "parted on its way");
    assert!(worst_kink(&curves, DVec2::ONE) < 1e-9, "kinks");
}

//! The same scene told in other units, another place, or another pose looks the same.

mod support;

use glam::{DMat3, DVec2, DVec3, Vec3};
use rand::Rng;
use rand::rngs::StdRng;
use std::f64::consts::TAU;
use striae::formation::Tool;
use striae::pattern::{
    Footprint, Frame, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint,
};
use striae::scattering::{Output, Shading};
use support::{Sheet, any_direction, dark_sheet, random, relative, single, straight};

/// Two crossing scratches in a texture space of its own scale and offset.
fn crossing(mm_per_unit: f64, units_per_uv: f64, offset: f64) -> Pattern {
    let mut builder =
        PatternBuilder::new(dark_sheet(), mm_per_unit, [units_per_uv, units_per_uv]).unwrap();
    let tool = Tool::vickers();
    // In millimetres, as 1000 mm a unit of uv.
    let uv = |mm: [f64; 2]| mm.map(|x| offset + x / (mm_per_unit * units_per_uv));
    for line in [
        [[-300.0, 0.0], [300.0, 10.0]],
        [[-200.0, -250.0], [200.0, 250.0]],
    ] {
        builder
            .add(&Scratch {
                path: Path::Polyline(&line.map(uv)),
                keys: &[Key::force(0.0, 1.0), Key::force(1.0, 3.0)],
                ..Scratch::new(&tool)
            })
            .unwrap();
    }
    builder.build()
}

fn eval(pattern: &Pattern, point: &SurfacePoint, view: [f32; 3], light: [f32; 3]) -> f64 {
    let mut shading = Shading::default();
    shading.shade(pattern, point, view).unwrap();
    f64::from(shading.eval(light, Output::BrdfCos)[0])
}

/// A pixel near the crossing: where, and its edges, mm.
fn any_pixel(random: &mut StdRng) -> [DVec2; 3] {
    let size = 10_f64.powf(random.random_range(-2.0..1.0));
    let mut anywhere = || {
        DVec2::new(
            random.random_range(-1.0..1.0),
            random.random_range(-1.0..1.0),
        )
    };
    let (place, dx) = (0.1 * anywhere(), size * anywhere());
    [place, dx, dx.perp() * 0.6]
}

/// Metres, millimetres or inches a scene unit; one or a million scene units a unit of uv; a texture space that
/// starts elsewhere, also below 0 and above 1.
#[test]
fn units_and_offsets() {
    let mut random = random(51);
    let (mut worst, mut scratched) = (0.0_f64, 0);
    let plain = crossing(1.0, 1000.0, 0.5);
    for (mm, units, offset) in [
        (1000.0, 1.0, 0.5),
        (25.4, 40.0, 0.5),
        (1e-3, 1e6, 0.5),
        (1.0, 1e6, 0.5),
        (1.0, 1000.0, -3.0),
        (1.0, 1000.0, 40.0),
        (1.0, 1.0, 0.0),
    ] {
        let other = crossing(mm, units, offset);
        for _ in 0..60 {
            let [place, dx, dy] = any_pixel(&mut random);
            let (view, light) = (
                any_direction(&mut random, 75.0),
                any_direction(&mut random, 75.0),
            );
            let told = |pattern, mm: f64, units: f64, offset: f64| {
                let uv = |v: DVec2| v / (mm * units);
                let sheet = Sheet {
                    dp_du: [single(units), 0.0, 0.0],
                    dp_dv: [0.0, single(units), 0.0],
                    view,
                    light,
                };
                sheet.pixel(pattern, DVec2::splat(offset) + uv(place), uv(dx), uv(dy))
            };
            let (a, b) = (
                told(&plain, 1.0, 1000.0, 0.5),
                told(&other, mm, units, offset),
            );
            let deviation = (a - b).abs() / a.max(b).max(1e-4);
            worst = worst.max(deviation);
            // The bare sheet reflects 0.002 / π at most.
            scratched += u32::from(a > 1e-3);
            assert!(
                deviation < 1e-3,
                "{a} and {b}: {mm} mm a unit, {units} a uv, from {offset}"
            );
        }
    }
    println!("units and offsets: {worst:.1e}");
    assert!(scratched > 200, "only {scratched} pixels show a scratch");
}

/// A radius is in scene units, whatever they are.
#[test]
fn radius_in_scene_units() {
    for radius_mm in [0.02, 1.0] {
        let f = |mm: f64, units: f64| {
            let size = single(units);
            let point = SurfacePoint {
                uv: [0.5, 0.5 + 0.01 / (mm * units)],
                dp_du: [size, 0.0, 0.0],
                dp_dv: [0.0, size, 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(single(radius_mm / mm)),
            };
            let pattern = crossing(mm, units, 0.5);
            eval(&pattern, &point, [0.1, 0.0, 0.9], [0.3, 0.5, 0.8])
        };
        let (a, b) = (f(1.0, 1000.0), f(1000.0, 1.0));
        assert!(
            relative(a, b) < 1e-4,
            "radius {radius_mm} mm: {a} in mm, {b} in m"
        );
    }
}

/// A rotation that may be anything.
fn any_pose(random: &mut StdRng) -> DMat3 {
    let axis = DVec3::from(std::array::from_fn(|_| random.random_range(-1.0..1.0)));
    DMat3::from_axis_angle(axis.normalize(), random.random_range(0.0..TAU))
}

/// Turned in space, with a normal of any length and a dP/du that is not quite in the surface, a point stays as
/// it is in its own frame.
#[test]
fn poses() {
    let mut random = random(52);
    let pattern = crossing(1.0, 1000.0, 0.5);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let pose = any_pose(&mut random);
        let [place, dx, dy] = any_pixel(&mut random);
        let flat = Sheet::UPRIGHT.point(DVec2::splat(0.5) + place / 1e3, dx / 1e3, dy / 1e3);
        let turned = |v: [f32; 3]| (pose * DVec3::from(v.map(f64::from))).as_vec3();
        let normal = turned(flat.normal);
        let point = SurfacePoint {
            dp_du: (turned(flat.dp_du) + 50.0 * normal).to_array(),
            dp_dv: (turned(flat.dp_dv) - 30.0 * normal).to_array(),
            normal: (normal * random.random_range(1e-3..1e3)).to_array(),
            ..flat
        };
        let (view, light) = (
            any_direction(&mut random, 75.0),
            any_direction(&mut random, 75.0),
        );
        let (a, b) = (
            eval(&pattern, &flat, view, light),
            eval(&pattern, &point, view, light),
        );
        worst = worst.max((a - b).abs() / a.max(b).max(1e-4));
        let frame = Frame::at(&point).unwrap();
        let back = frame.to_world(frame.to_local(Vec3::new(1.0, 2.0, 3.0)));
        assert!(
            back.distance(Vec3::new(1.0, 2.0, 3.0)) < 1e-5,
            "there and back: {back}"
        );
        assert!(
            frame.z.distance(normal) < 1e-5,
            "z is the normal: {frame:?}"
        );
        assert!(
            frame.x.distance(turned([1.0, 0.0, 0.0])) < 1e-5,
            "x is dP/du: {frame:?}"
        );
        assert!(
            frame.y.distance(frame.z.cross(frame.x)) < 1e-6,
            "y is z × x: {frame:?}"
        );
    }
    println!("poses: {worst:.1e}");
    assert!(worst < 1e-3, "a turned sheet differs by {worst}");
}

/// View and light of any length are directions.
#[test]
fn lengths_do_not_matter() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    let edge = 1e-4 * DVec2::X;
    let point = Sheet::UPRIGHT.point(DVec2::splat(0.5), edge, edge.perp());
    let f = |length: f32| {
        let [view, light] =
            [[0.2, 0.3, 0.8], [-0.4, 0.1, 0.5]].map(|w: [f32; 3]| w.map(|x| length * x));
        eval(&pattern, &point, view, light)
    };
    for length in [1e-30, 1e-22, 1e-6, 1e6, 1e22, 1e38] {
        assert!(
            relative(f(length), f(1.0)) < 1e-5,
            "{} at {length:e}, not {}",
            f(length),
            f(1.0)
        );
    }
}

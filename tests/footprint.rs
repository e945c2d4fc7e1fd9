//! Box filters add up: the mean over a pixel's parts is the pixel, at every size, shape and angle.

mod support;

use glam::{DMat2, DVec2};
use rand::Rng;
use rand::rngs::StdRng;
use striae::brdf::Brdf;
use striae::formation::{Material, Orientation, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use striae::scattering::Shading;
use support::{SHEET_MM, Sheet, any_direction, dark_sheet, ggx, lambert, random, relative};
use support::{sheet_of, single, straight};

/// A scratch across the sheet's middle at some angle, its tool leant so that its sides differ.
fn leaning_scratch(material: &Material, angle_rad: f64) -> Pattern {
    let along = 0.45 * DVec2::from_angle(angle_rad);
    let middle = DVec2::splat(0.5);
    let mut builder = sheet_of(material);
    builder
        .add(&Scratch {
            path: Path::Polyline(&[(middle - along).to_array(), (middle + along).to_array()]),
            keys: &[Key {
                orientation: Orientation {
                    tilt_deg: 25.0,
                    azimuth_deg: 70.0,
                    spin_deg: 10.0,
                },
                ..Key::force(0.0, 2.0)
            }],
            ..Scratch::new(&Tool::rockwell_c())
        })
        .unwrap();
    builder.build()
}

/// How wide that scratch is, about, mm.
const WIDTH_MM: f64 = 0.1;

/// An edge-to-edge parallelogram `size` mm long, up to 30 times as long as wide, any way round.
fn any_footprint(random: &mut StdRng, size_mm: f64) -> [DVec2; 2] {
    let long = size_mm / SHEET_MM * DVec2::from_angle(random.random_range(0.0..7.0));
    let shorter = 30_f64.powf(random.random_range(-1.0..0.0));
    let turn = random.random_range(0.3..2.8) * if random.random() { 1.0 } else { -1.0 };
    [long, shorter * DVec2::from_angle(turn).rotate(long)]
}

/// The worst relative difference between pixels and the mean of their parts, footprints of 10^decade of the
/// scratch's width.
fn worst_of_parts(material: &Material, sheet: impl Fn(&mut StdRng) -> Sheet) -> f64 {
    let mut random = random(7);
    let mut worst = 0.0_f64;
    for decade in -3..3 {
        let (mut here, mut report) = (0.0_f64, String::new());
        for case in 0..60 {
            let angle = random.random_range(0.0..6.3);
            let pattern = leaning_scratch(material, angle);
            let sheet = sheet(&mut random);
            let size_mm = WIDTH_MM * 10_f64.powf(f64::from(decade) + random.random_range(0.0..1.0));
            let [dx, dy] = any_footprint(&mut random, size_mm);
            let offset_mm = 0.4 * (WIDTH_MM + size_mm) * random.random_range(-1.0..1.0);
            let uv = DVec2::splat(0.5) + offset_mm / SHEET_MM * DVec2::from_angle(angle).perp();
            let n = random.random_range(2..8);
            let whole = sheet.pixel(&pattern, uv, dx, dy);
            let parts = sheet.mean_of_parts(&pattern, uv, dx, dy, n);
            // Where all is in shadow, nothing is left to be relative to.
            let deviation = (whole - parts).abs() / whole.max(parts).max(1e-4);
            if deviation > here {
                here = deviation;
                report = format!(
                    "case {case}, {n}²: {whole} against {parts}, {size_mm} mm, offset {offset_mm}"
                );
            }
        }
        println!("  10^{decade} widths: {here:.1e} ({report})");
        worst = worst.max(here);
    }
    worst
}

/// A straight scratch, seen and lit from anywhere, over six decades of footprint.
#[test]
fn parts_of_straight_scratches() {
    let worst = worst_of_parts(&dark_sheet(), |random| Sheet {
        view: any_direction(random, 80.0),
        light: any_direction(random, 80.0),
        ..Sheet::UPRIGHT
    });
    println!("straight scratch, matt: {worst:.1e}");
    assert!(worst < 1e-3, "parts differ from the pixel by {worst}");
}

/// The same with highlights, on a sheared and mirrored texture space.
#[test]
fn parts_on_sheared_and_mirrored_uv() {
    let shiny = Material {
        surface: ggx(0.3, 0.5),
        scratched: ggx(0.1, 0.9),
        ..dark_sheet()
    };
    let worst = worst_of_parts(&shiny, |random| {
        let mirror = if random.random() { 1.0 } else { -1.0 };
        Sheet {
            dp_du: [700.0, random.random_range(-400.0..400.0), 0.0],
            dp_dv: [
                random.random_range(-900.0..900.0),
                mirror * random.random_range(500.0..1500.0),
                0.0,
            ],
            view: any_direction(random, 80.0),
            light: any_direction(random, 80.0),
        }
    });
    println!("straight scratch, shiny, sheared: {worst:.1e}");
    assert!(worst < 1e-3, "parts differ from the pixel by {worst}");
}

/// A pixel is where it is whatever texture space does: sheared, mirrored or scaled uv give the same image.
#[test]
fn texture_space_does_not_matter() {
    let mut random = random(8);
    let mut worst = 0.0_f64;
    for _ in 0..60 {
        // World millimetres around the sheet's middle; uv = to_uv · world + 1/2.
        let to_world = SHEET_MM
            * DMat2::from_cols(
                DVec2::new(1.0, 0.0),
                DVec2::new(
                    random.random_range(-1.0..1.0),
                    random.random_range(-2.0..2.0),
                ),
            );
        let from = DVec2::new(random.random_range(-300.0..-200.0), -40.0);
        let to = DVec2::new(random.random_range(200.0..300.0), 40.0);
        let place = DVec2::new(0.0, random.random_range(-0.05..0.05)) + from.midpoint(to);
        let (dx, dy) = (DVec2::new(0.2, 0.05), DVec2::new(-0.03, 0.1));
        let (view, light) = (
            any_direction(&mut random, 75.0),
            any_direction(&mut random, 75.0),
        );
        let radiance = |to_world: DMat2| {
            let uv = |world: DVec2| to_world.inverse() * world + DVec2::splat(0.5);
            let edge = |world: DVec2| to_world.inverse() * world;
            let column = |c: DVec2| [single(c.x), single(c.y), 0.0];
            let line = [uv(from).to_array(), uv(to).to_array()];
            let pattern = straight(&dark_sheet(), &Tool::vickers(), &[(line[0], line[1])], 3.0);
            let sheet = Sheet {
                dp_du: column(to_world.x_axis),
                dp_dv: column(to_world.y_axis),
                view,
                light,
            };
            sheet.pixel(&pattern, uv(place), edge(dx), edge(dy))
        };
        let plain = radiance(SHEET_MM * DMat2::IDENTITY);
        let turned = radiance(to_world);
        worst = worst.max(relative(plain, turned));
    }
    println!("sheared uv against plain uv: {worst:.1e}");
    assert!(worst < 1e-3, "texture space changes the image by {worst}");
}

/// An isotropic radius is the square it says it is, in scene units, and millimetres follow from them.
#[test]
fn radius_is_a_square_in_scene_units() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    let sheet = Sheet::UPRIGHT;
    for radius_mm in [1e-3, 0.05, 4.0] {
        let uv = DVec2::new(0.5, 0.5 + 0.3 * radius_mm / SHEET_MM);
        let edge = 2.0 * radius_mm / SHEET_MM;
        let square = sheet.pixel(&pattern, uv, edge * DVec2::X, edge * DVec2::Y);
        let point = SurfacePoint {
            footprint: Footprint::Radius(single(radius_mm)),
            ..sheet.point(uv, DVec2::ZERO, DVec2::ZERO)
        };
        let by_radius = sheet.radiance(&pattern, &point);
        assert!(
            relative(square, by_radius) < 1e-4,
            "radius {radius_mm}: {by_radius}, not {square}"
        );
    }
}

/// Coverage is the scratch's own width over the footprint's, seen from above: sizes mean millimetres.
#[test]
fn coverage_is_width_over_footprint() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    let coverage = |size_mm: f64| {
        let edge = size_mm / SHEET_MM;
        let point = Sheet::UPRIGHT.point(DVec2::splat(0.5), edge * DVec2::X, edge * DVec2::Y);
        let mut shading = Shading::default();
        shading
            .shade(&pattern, &point, Sheet::UPRIGHT.view)
            .unwrap();
        f64::from(shading.coverage())
    };
    let width_mm = coverage(1.0);
    assert!((0.05..0.5).contains(&width_mm), "{width_mm} mm wide");
    for size_mm in [0.5, 10.0, 300.0] {
        let expected = width_mm / size_mm;
        assert!(
            relative(coverage(size_mm), expected) < 1e-4,
            "{size_mm} mm: {}, not {expected}",
            coverage(size_mm)
        );
    }
}

/// A missing footprint is a point: what a footprint far below the scratch's size gives.
#[test]
fn no_footprint_is_a_point() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::vickers(), &[line], 3.0);
    for i in -20..=20 {
        let uv = DVec2::new(0.5, 0.5 + 0.0031 * f64::from(i) / SHEET_MM);
        let edge = 1e-5 / SHEET_MM;
        let tiny = Sheet::UPRIGHT.pixel(&pattern, uv, edge * DVec2::X, edge * DVec2::Y);
        let point = SurfacePoint {
            footprint: Footprint::Point,
            ..Sheet::UPRIGHT.point(uv, DVec2::ZERO, DVec2::ZERO)
        };
        let ours = Sheet::UPRIGHT.radiance(&pattern, &point);
        assert!(relative(tiny, ours) < 1e-3, "{i}: {ours}, not {tiny}");
    }
}

/// The comparisons can fail: parts of another pixel, or another material, differ.
#[test]
fn differences_are_noticed() {
    let pattern = leaning_scratch(&dark_sheet(), 0.3);
    let sheet = Sheet::UPRIGHT;
    let uv = DVec2::splat(0.5);
    let edge = WIDTH_MM / SHEET_MM;
    let whole = sheet.pixel(&pattern, uv, edge * DVec2::X, edge * DVec2::Y);
    let beside = sheet.mean_of_parts(
        &pattern,
        uv + 0.1 * edge * DVec2::Y,
        edge * DVec2::X,
        edge * DVec2::Y,
        4,
    );
    assert!(
        relative(whole, beside) > 0.01,
        "a shifted pixel looks alike"
    );
    let black: Brdf = lambert(0.0);
    let other = leaning_scratch(
        &Material {
            scratched: black,
            ..dark_sheet()
        },
        0.3,
    );
    let other = sheet.pixel(&other, uv, edge * DVec2::X, edge * DVec2::Y);
    assert!(relative(whole, other) > 0.3, "black scratches look alike");
}

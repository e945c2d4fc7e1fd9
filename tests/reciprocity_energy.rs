//! A pixel of scratches is a BRDF: reciprocal, and never brighter than its light.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::Tool;
use striae::scattering::{CrossFootprint, Output, Shading};
use support::caster::{Finish, any_profile, shade};
use support::{SHEET_MM, Sheet, any_direction, dark_sheet, direction, lambert, random};
use support::{single, straight};

/// Light and view swapped give the same, for any cross-section in a whole pixel: with every facet counted
/// by what is both lit and seen of it, nothing depends on which is which.
#[test]
fn whole_pixels_are_reciprocal() {
    let mut random = random(21);
    let mut worst = 0.0_f64;
    for case in 0..2000 {
        let points = any_profile(&mut random);
        let width = points[points.len() - 1][0] - points[0][0];
        let pixel = CrossFootprint::Whole {
            margin_mm: width * 10_f32.powf(random.random_range(-3.0..2.0)),
        };
        let (l, v) = (
            any_direction(&mut random, 85.0),
            any_direction(&mut random, 85.0),
        );
        let finishes = [
            Finish::Ggx(
                random.random_range(0.05..1.0),
                random.random_range(0.0..1.0),
            ),
            Finish::Lambert(random.random_range(0.0..1.0)),
        ];
        let there = shade(&points, finishes, pixel, l, v, Output::Brdf);
        let back = shade(&points, finishes, pixel, v, l, Output::Brdf);
        let deviation = (there - back).abs() / there.max(back).max(1e-4);
        worst = worst.max(deviation);
        assert!(
            deviation < 1e-4,
            "case {case}: {there} there, {back} back: {points:?}, {pixel:?}, {l:?}, {v:?}"
        );
    }
    println!("reciprocity of whole pixels: {worst:.1e}");
}

/// A box pixel that holds the cross-section, its parallax and its shadows is a whole pixel; there is no
/// other path for it.
#[test]
fn wide_boxes_are_whole_pixels() {
    let mut random = random(22);
    let mut worst = 0.0_f64;
    for _ in 0..500 {
        let points = any_profile(&mut random);
        let width = f64::from(points[points.len() - 1][0] - points[0][0]);
        // At 70 degrees a height of 0.4 widths falls 1.1 widths away.
        let half = 4.0 * width;
        let whole = CrossFootprint::Whole {
            margin_mm: single(half - 0.5 * width),
        };
        let boxed = CrossFootprint::Box {
            center_mm: 0.0,
            extents_mm: [2.0 * half, 1e-9 * width],
        };
        let (l, v) = (
            any_direction(&mut random, 70.0),
            any_direction(&mut random, 70.0),
        );
        let finishes = [Finish::Ggx(0.2, 0.8), Finish::Lambert(0.4)];
        let [a, b] = [whole, boxed].map(|p| shade(&points, finishes, p, l, v, Output::Brdf));
        worst = worst.max((a - b).abs() / a.max(b).max(1e-4));
    }
    println!("wide boxes against whole pixels: {worst:.1e}");
    assert!(worst < 1e-4, "they differ by {worst}");
}

/// What a shaded point reflects of an even white sky: cells of equal cos² and azimuth.
fn albedo(shading: &Shading) -> f64 {
    const RINGS: u32 = 48;
    let mut sum = 0.0;
    for (i, j) in (0..RINGS).flat_map(|i| (0..2 * RINGS).map(move |j| (i, j))) {
        let cos = ((f64::from(i) + 0.5) / f64::from(RINGS)).sqrt();
        let azimuth = 180.0 * (f64::from(j) + 0.5) / f64::from(RINGS);
        let light = direction(cos.acos().to_degrees(), azimuth);
        sum += f64::from(shading.eval(light, Output::Brdf)[0]);
    }
    sum * std::f64::consts::PI / f64::from(2 * RINGS * RINGS)
}

/// White facets in a white sheet reflect no more than they get, whatever the pixel shows of them, and a
/// sheet without a scratch all of it.
#[test]
fn no_light_is_gained() {
    let mut random = random(23);
    let white = lambert(1.0);
    let (mut most, mut least) = (0.0_f64, 1.0_f64);
    for case in 0..60 {
        let points = any_profile(&mut random);
        let width = f64::from(points[points.len() - 1][0] - points[0][0]);
        for zenith in [0.0, 30.0, 60.0, 85.0] {
            let size = width * 10_f64.powf(random.random_range(-2.0..2.0));
            let pixel = CrossFootprint::Box {
                center_mm: 0.5 * (width + size) * random.random_range(-1.0..1.0),
                extents_mm: [size, 0.3 * size],
            };
            let view = direction(zenith, random.random_range(0.0..360.0));
            let mut shading = Shading::default();
            shading
                .shade_cross_section(&points, &white, &white, pixel, view)
                .unwrap();
            let reflected = albedo(&shading);
            assert!(
                reflected < 1.002,
                "case {case}: {reflected} reflected, {points:?}, {pixel:?}, {view:?}"
            );
            most = most.max(reflected);
            least = least.min(reflected);
        }
    }
    println!("white furnace: {least:.3} to {most:.4}");
    assert!(
        most > 0.999,
        "light is lost even beside the scratch: {most}"
    );
    assert!(least < 0.9, "no groove keeps any light: {least}");
}

/// Reciprocity is a property of the whole pixel: a part of a slope is not reciprocal, and the test sees it.
#[test]
fn asymmetry_is_noticed() {
    let pattern = straight(
        &dark_sheet(),
        &Tool::vickers(),
        &[([0.2, 0.5], [0.8, 0.5])],
        3.0,
    );
    let edge = 0.02 / SHEET_MM;
    let uv = DVec2::new(0.5, 0.5 + 0.03 / SHEET_MM);
    let f = |view: [f32; 3], light: [f32; 3]| {
        let sheet = Sheet {
            view,
            light,
            ..Sheet::UPRIGHT
        };
        sheet.pixel(&pattern, uv, edge * DVec2::X, edge * DVec2::Y) / f64::from(light[2])
    };
    let (l, v) = (direction(20.0, 90.0), direction(60.0, -90.0));
    assert!(
        (f(v, l) - f(l, v)).abs() > 0.01 * f(v, l),
        "no difference at all"
    );
}

//! Many scratches in one footprint: none lost, none counted twice, no light gained, nothing jumps.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::{Material, Tool};
use striae::pattern::Pattern;
use striae::scattering::{Output, Shading};
use support::crowd::add;
use support::sheet_of;
use support::{SHEET_MM, Sheet, any_direction, dark_sheet, direction, lambert, random, relative};

/// Pixels of every size anywhere on a comb of unlike strokes, added in no order: fewer than a shading point
/// holds are exact.
#[test]
fn parts_of_combs() {
    let mut random = random(9);
    let pitch_mm = 0.3;
    let mut builder = sheet_of(&dark_sheet());
    for i in 0..60 {
        let shift = pitch_mm * (f64::from(i * 37 % 60) - 30.0);
        let force = random.random_range(0.1..1.5);
        add(&mut builder, &Tool::rockwell_c(), None, shift, 0.0, force);
    }
    let pattern = builder.build();
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let sheet = Sheet {
            view: any_direction(&mut random, 30.0),
            light: any_direction(&mut random, 60.0),
            ..Sheet::UPRIGHT
        };
        let size_mm = pitch_mm * 10_f64.powf(random.random_range(-2.0..0.8));
        let edge = size_mm / SHEET_MM;
        let uv = DVec2::new(0.5, 0.5 + random.random_range(-5.0..5.0) / SHEET_MM);
        let (dx, dy) = (edge * DVec2::X, edge * DVec2::Y);
        let whole = sheet.pixel(&pattern, uv, dx, dy);
        let parts = sheet.mean_of_parts(&pattern, uv, dx, dy, 5);
        worst = worst.max((whole - parts).abs() / whole.max(parts).max(1e-4));
    }
    println!("pixels of a comb: {worst:.1e}");
    assert!(worst < 1e-3, "parts differ from the pixel by {worst}");
}

/// A tangle of `count` strokes through a square of `size_mm`.
fn tangle(material: &Material, count: u32, size_mm: f64, seed: u64) -> Pattern {
    let mut random = random(seed);
    let mut builder = sheet_of(material);
    for _ in 0..count {
        let shift = size_mm * random.random_range(-0.5..0.5);
        let turn = random.random_range(0.0..360.0);
        let force = random.random_range(0.1..3.0);
        add(&mut builder, &Tool::rockwell_c(), None, shift, turn, force);
    }
    builder.build()
}

/// A white sheet under white scratches reflects no more than it gets, however crowded, and never less than
/// nothing.
#[test]
fn no_light_is_gained() {
    let white = Material::new(150.0, lambert(1.0), lambert(1.0));
    let mut most = 0.0_f64;
    for count in [1, 3, 16, 48, 49, 300] {
        let pattern = tangle(&white, count, 1.0, u64::from(count));
        for size_mm in [0.01, 0.3, 1.0, 10.0] {
            for zenith in [0.0, 40.0, 70.0, 85.0] {
                let edge = size_mm / SHEET_MM;
                let point =
                    Sheet::UPRIGHT.point(DVec2::splat(0.5), edge * DVec2::X, edge * DVec2::Y);
                let mut shading = Shading::default();
                shading
                    .shade(&pattern, &point, direction(zenith, 33.0))
                    .unwrap();
                let mut reflected = 0.0;
                // Equal steps of cos² and azimuth: π times the mean of BRDF.
                for (i, j) in (0..32).flat_map(|i| (0..64).map(move |j| (i, j))) {
                    let cos = ((f64::from(i) + 0.5) / 32.0).sqrt();
                    let azimuth = 360.0 * (f64::from(j) + 0.5) / 64.0;
                    let light = direction(cos.acos().to_degrees(), azimuth);
                    let f = f64::from(shading.eval(light, Output::Brdf)[0]);
                    assert!(
                        f.is_finite() && f >= 0.0,
                        "{count} scratches, {size_mm} mm, {zenith}°, light {light:?}: {f}"
                    );
                    reflected += f * std::f64::consts::PI / (32.0 * 64.0);
                }
                assert!(
                    reflected < 1.005,
                    "{count} scratches, {size_mm} mm, {zenith}°: {reflected} reflected"
                );
                most = most.max(reflected);
            }
        }
    }
    println!("white furnace: {most:.4} at most");
    assert!(most > 0.9, "even one scratch swallows light: {most}");
}

/// One more scratch changes a pixel by no more than its own share, at every count, full or not; all together are
/// what their parts say, less than the sum of each alone, for later ones cut earlier ones.
#[test]
fn one_more_scratch_changes_little() {
    let sheet = Sheet {
        view: direction(30.0, 50.0),
        light: direction(40.0, 200.0),
        ..Sheet::UPRIGHT
    };
    let edge = 60.0 / SHEET_MM;
    let mut random = random(6);
    let strokes: Vec<[f64; 3]> = (0..120)
        .map(|_| {
            [
                random.random_range(-24.0..24.0),
                random.random_range(0.0..180.0),
                random.random_range(0.2..2.0),
            ]
        })
        .collect();
    let built = |strokes: &[[f64; 3]]| {
        let mut builder = sheet_of(&dark_sheet());
        for &[shift, turn, force] in strokes {
            add(&mut builder, &Tool::rockwell_c(), None, shift, turn, force);
        }
        builder.build()
    };
    let (dx, dy) = (edge * DVec2::X, edge * DVec2::Y);
    let pixel = |strokes: &[[f64; 3]]| sheet.pixel(&built(strokes), DVec2::splat(0.5), dx, dy);
    let bare = pixel(&[]);
    let mut before = bare;
    let mut all_alone = bare;
    for count in 1..=strokes.len() {
        let alone = pixel(&strokes[count - 1..count]) - bare;
        let after = pixel(&strokes[..count]);
        all_alone += alone;
        assert!(
            (0.3 * alone..3.0 * alone).contains(&(after - before)),
            "stroke {count} adds {}, alone {alone}",
            after - before
        );
        before = after;
    }
    let parts = sheet.mean_of_parts(&built(&strokes), DVec2::splat(0.5), dx, dy, 100);
    println!("120 strokes: {before:.4}, parts {parts:.4}, one by one {all_alone:.4}");
    assert!(relative(before, parts) < 0.03, "{before}, parts {parts}");
    assert!(before < all_alone, "{before}, one by one {all_alone}");
}

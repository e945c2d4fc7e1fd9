//! More scratches near a pixel than a shading point holds: none is lost, and what stands for many is like them.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::{Material, Tool};
use striae::pattern::Pattern;
use striae::scattering::Shading;
use support::crowd::{add, comb, tangle};
use support::sheet_of;
use support::{
    SHEET_MM, Sheet, any_direction, dark_sheet, direction, ggx, lambert, random, relative,
};

fn polished() -> Material {
    Material {
        scratched: ggx(0.01, 0.9),
        ..dark_sheet()
    }
}

fn coverage(pattern: &Pattern, shift_mm: f64, size_mm: f64, view: [f32; 3]) -> f64 {
    let uv = DVec2::new(0.5, 0.5 + shift_mm / SHEET_MM);
    let edge = size_mm / SHEET_MM;
    let point = Sheet::UPRIGHT.point(uv, edge * DVec2::X, edge * DVec2::Y);
    let mut shading = Shading::default();
    shading.shade(pattern, &point, view).unwrap();
    f64::from(shading.coverage())
}

/// A tiny pixel in the middle of each stroke of a comb sees that stroke, whatever else lies near and in
/// whatever order: strokes beside the pixel, which may only throw a shadow into it, must not take its place.
#[test]
fn neighbours_do_not_displace_what_is_seen() {
    let steep = Tool::pyramid(4, 40.0, 5.0).unwrap();
    let mut failed = Vec::new();
    // Pitches a little above the strokes' widths.
    for (name, tool, force_kgf, pitch_mm) in [
        ("nail", &Tool::nail(), 5.0, 0.26),
        ("Vickers", &Tool::vickers(), 5.0, 0.27),
        ("steep pyramid", &steep, 1.0, 0.0102),
    ] {
        for material in [dark_sheet(), polished()] {
            let mut builder = sheet_of(&material);
            // From both ends inwards: the middle ones come last.
            let place = |i: u32| pitch_mm * (f64::from(i) - 20.0);
            for i in (0..41).map(|k| if k % 2 == 0 { k / 2 } else { 40 - k / 2 }) {
                add(&mut builder, tool, None, place(i), 0.0, force_kgf);
            }
            let pattern = builder.build();
            for (i, zenith) in (0..41).flat_map(|i| [0.0, 30.0, 60.0].map(|zenith| (i, zenith))) {
                let view = direction(zenith, 90.0);
                let here = coverage(&pattern, place(i), 0.01 * pitch_mm, view);
                if here < 0.99 {
                    failed.push(format!("{name}, stroke {i}, seen from {zenith}°: {here}"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{} lost: {failed:#?}", failed.len());
}

/// The worst relative difference between a pixel that holds a whole comb and the mean of its parts.
fn worst_of_comb(pattern: &Pattern, comb_mm: f64, parts: u32) -> f64 {
    let mut random = random(5);
    let mut worst = 0.0_f64;
    for _ in 0..12 {
        let sheet = Sheet {
            view: any_direction(&mut random, 60.0),
            light: any_direction(&mut random, 60.0),
            ..Sheet::UPRIGHT
        };
        let (dx, dy) = (0.01 * DVec2::X, 1.1 * comb_mm / SHEET_MM * DVec2::Y);
        let whole = sheet.pixel(pattern, DVec2::splat(0.5), dx, dy);
        // Parts as thin as one stroke, one across the strokes' length.
        let mut mean = 0.0;
        for j in 0..parts {
            let place = (f64::from(j) + 0.5) / f64::from(parts) - 0.5;
            mean += sheet.pixel(
                pattern,
                DVec2::splat(0.5) + place * dy,
                dx,
                dy / f64::from(parts),
            ) / f64::from(parts);
        }
        worst = worst.max(relative(whole, mean));
    }
    worst
}

/// 5, 40, 60 and 400 like strokes side by side: a full shading point stands for all of them.
#[test]
fn no_stroke_is_lost() {
    let mut failed = Vec::new();
    for (name, material) in [("matt", dark_sheet()), ("polished", polished())] {
        for count in [5, 40, 60, 400] {
            let pitch_mm = 0.2;
            let pattern = comb(&material, count, pitch_mm, 0.1);
            let worst = worst_of_comb(&pattern, pitch_mm * f64::from(count), 4 * count);
            println!("{count} like strokes, {name}: {worst:.1e}");
            if worst >= 0.01 {
                failed.push(format!("{count} strokes, {name}: {worst}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Strokes of two finishes and many forces: the aggregate is their mean, not one of them.
#[test]
fn unlike_strokes_are_averaged() {
    let mut failed = Vec::new();
    for count in [5, 40, 60, 400] {
        let black = Material {
            scratched: lambert(0.0),
            ..dark_sheet()
        };
        let mut builder = sheet_of(&dark_sheet());
        let pitch_mm = 0.3;
        for i in 0..count {
            let shift = pitch_mm * (f64::from(i) - 0.5 * f64::from(count - 1));
            let force = 0.1 + 0.2 * f64::from(i * 7 % 11);
            let material = (i % 2 == 1).then_some(&black);
            add(
                &mut builder,
                &Tool::rockwell_c(),
                material,
                shift,
                0.0,
                force,
            );
        }
        let pattern = builder.build();
        let worst = worst_of_comb(&pattern, pitch_mm * f64::from(count), 4 * count);
        println!("{count} unlike strokes: {worst:.1e}");
        if worst >= 0.05 {
            failed.push(format!("{count} strokes: {worst}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A scratch of which a pixel holds a sliver at its edge does not stand for the many inside it, whatever else
/// fills the shading point first.
#[test]
fn a_sliver_does_not_stand_for_many() {
    let bright = Material {
        surface: lambert(0.5),
        ..dark_sheet()
    };
    let sheet = Sheet {
        light: direction(75.0, -90.0),
        ..Sheet::UPRIGHT
    };
    let size_mm = 20.0;
    let edge = size_mm / SHEET_MM;
    let tool = Tool::rockwell_c();
    let pixel = |slivers: bool, many: bool, parts: u32| {
        let mut builder = sheet_of(&bright);
        if slivers {
            // 0.23 mm wide: one part in a thousand of it lies in the pixel.
            let width_mm = 20.0 * coverage(&straight_one(&bright), 0.0, 20.0, [0.0, 0.0, 1.0]);
            let shift = 0.5 * size_mm + 0.499 * width_mm;
            add(&mut builder, &tool, None, -shift, 0.0, 2.0);
        }
        for i in 0..15 {
            add(&mut builder, &tool, None, f64::from(i) - 7.0, 90.0, 0.1);
        }
        if many {
            for i in 0..20 {
                add(
                    &mut builder,
                    &tool,
                    None,
                    0.9 * f64::from(i) - 8.5,
                    0.0,
                    2.0,
                );
            }
        }
        let (dx, dy) = (edge * DVec2::X, edge * DVec2::Y);
        sheet.mean_of_parts(&builder.build(), DVec2::splat(0.5), dx, dy, parts)
    };
    let truth = pixel(true, true, 20);
    for (slivers, many) in [(false, false), (true, false), (false, true), (true, true)] {
        let (whole, parts) = (pixel(slivers, many, 1), pixel(slivers, many, 20));
        println!("sliver {slivers}, many {many}: {whole:.5} against {parts:.5}");
        assert!(
            relative(whole, parts) < 0.05,
            "sliver {slivers}, many {many}: {whole} against {parts}"
        );
    }
    assert!(
        relative(truth, pixel(false, false, 1)) > 0.05,
        "the many do not show"
    );
}

/// Pixels of a dozen or two of wide scratches, each cut into many parts by those that cross it, are like the mean of their
/// parts: what is kept of each, where not all finds room, is what shows.
#[test]
fn wide_scratches_that_cross_find_room() {
    const PIXELS: u32 = 60;
    let (mut random, mut worst, mut sum) = (random(7), 0.0_f64, 0.0);
    for i in 0..PIXELS {
        let pattern = tangle(&dark_sheet(), &mut random);
        let sheet = Sheet {
            view: any_direction(&mut random, 60.0),
            light: any_direction(&mut random, 60.0),
            ..Sheet::UPRIGHT
        };
        let dx = random.random_range(0.4..0.7) / SHEET_MM * DVec2::from_angle(f64::from(i));
        let [whole, parts] =
            [1, 6].map(|n| sheet.mean_of_parts(&pattern, DVec2::splat(0.5), dx, dx.perp(), n));
        let off = relative(whole, parts);
        sum += off * off;
        worst = worst.max(off);
    }
    let rms = (sum / f64::from(PIXELS)).sqrt();
    println!("wide scratches that cross: {worst:.1e} at worst, {rms:.1e} in the mean");
    assert!(
        worst < 0.005 && rms < 0.0015,
        "{worst} at worst, {rms} in the mean"
    );
}

fn straight_one(material: &Material) -> Pattern {
    comb(material, 1, 0.0, 2.0)
}
